"""What all families of valves have in common."""

from __future__ import annotations

import numpy as np

from cadplants.builder.table import Table
from cadplants.model.family import Model, placed

__all__ = ["HOLLOW", "LAID", "lying", "standing"]

HOLLOW = "whether insides are modelled"
LAID = np.eye(4)[[2, 0, 1, 3]]
"""A pose that lays what stands on z = 0 along x, what pointed to y up, as ``about_x`` does."""


def lying(t: Table, kind: str) -> Model:
    """What was put down upon z = 0 laid along x, as a device with one flange is."""
    return Model(placed(t.parts, LAID), kind=kind)


def standing(t: Table, kind: str) -> Model:
    """What was put down on the floor, bodies first: contacts are recorded from the first part."""
    return Model(sorted(t.parts, key=lambda p: p.name != "valve body"), kind=kind)
