"""What all families of valves have in common."""

from __future__ import annotations

from cadplants.builder.table import Table
from cadplants.family import Model, Part
from cadplants.mesh_ops import about_x
from cadplants.standards import SIZES

__all__ = ["BOTH", "HOLLOW", "lying", "sized", "standing"]

BOTH = (-1, 1)
HOLLOW = "whether insides are modelled"


def sized(least: int = 0, most: int = 10_000) -> tuple[int, ...]:
    """The nominal sizes between two [mm]."""
    return tuple(dn for dn in SIZES if least <= dn <= most)


def lying(t: Table, kind: str) -> Model:
    """What was put down upon z = 0 laid along x, as a device with one flange is."""
    return Model([Part(about_x(p.solid), p.name, p.color, p.bundle, p.group, p.fine) for p in t.parts], kind=kind)


def standing(t: Table, kind: str) -> Model:
    """What was put down on the floor, bodies first: contacts are recorded from the first part."""
    return Model(sorted(t.parts, key=lambda p: p.name != "valve body"), kind=kind)
