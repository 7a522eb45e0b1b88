"""Tags by position, and kinds of units."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from cadgraph._io.text import natural_key
from cadgraph.model.parts import Parts, UnitParts
from cadgraph.stages.relate.algorithm import LETTERS
from cadgraph.stages.relate.piping import Group

__all__ = ["tag_units"]

# Units are numbered by the cell of a grid that their middle lies in [m]: what moves less keeps its number. Borders lie
# where no designer puts things, so that rounding does not carry a unit across.
_CELL, _SHIFT = 0.5, 0.01737


def tag_units(parts: Parts, groups: Sequence[Group]) -> tuple[UnitParts, ...]:
    """Numbers units by where they stand: along x, then y, then z.

    Args:
        parts: of the scene.
        groups: the parts of each unit.

    Returns:
        The units by tag (``G-001``, ``V-001``...). Names, paths, the order of meshes and moves of a few millimetres
        don't change them.
    """
    boxes = parts.properties.aabb + parts.scene.origin
    rows = []
    for group in groups:
        index = np.asarray(group.parts)
        middle = (boxes[index, 0].min(axis=0) + boxes[index, 1].max(axis=0)) / 2
        cell = np.floor((middle + _SHIFT) / _CELL)
        key = (*cell.tolist(), *np.round(middle, 2).tolist(), *middle.tolist())
        rows.append((group.unit_type, key, group))
    counts: Counter[str] = Counter()
    units = []
    for unit_type, _, group in sorted(rows, key=lambda row: (row[0], row[1], row[2].parts)):
        counts[unit_type] += 1
        letter = LETTERS.get(unit_type, unit_type[:3].upper())
        units.append(UnitParts(unit_type, f"{letter}-{counts[unit_type]:03d}", group.parts))
    return tuple(sorted(units, key=lambda unit: natural_key(unit.tag)))
