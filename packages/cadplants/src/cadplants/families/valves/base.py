"""What all families of valves have in common."""

from __future__ import annotations

from cadplants.builder.table import Table
from cadplants.family import Model, Part
from cadplants.mesh_ops import about_x

__all__ = ["HOLLOW", "lying", "standing"]

HOLLOW = "whether insides are modelled"


def lying(t: Table, kind: str) -> Model:
    """What was put down upon z = 0 laid along x, as a device with one flange is."""
    return Model([Part(about_x(p.solid), p.name, p.color, p.bundle, p.group, p.fine) for p in t.parts], kind=kind)


def standing(t: Table, kind: str) -> Model:
    """What was put down on the floor, bodies first: contacts are recorded from the first part."""
    return Model(sorted(t.parts, key=lambda p: p.name != "valve body"), kind=kind)
