"""What is flanged to what on the axis of a line: devices of which one follows another without a pipe between."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.stages.relate.joint import Ends, ahead_of

__all__ = ["FlatContacts", "bodies_between", "heads_for"]

FlatContacts: TypeAlias = Mapping[tuple[int, int], tuple[Floats, Floats]]
"""Pairs of parts that meet in a flat round area, with its middle [m] and its normal."""

# Of a flange that a line heads for: share of its radius that it is off the axis, cosine between normal and axis.
_ON_AXIS, _SQUARE_ON = 0.35, 0.95


def heads_for(ends: Ends, row: int, middle: Floats, normal: Floats) -> bool:
    """Whether an end looks at a flat face, straight on."""
    ahead = ahead_of(ends, row, middle)
    aside = float(np.linalg.norm(middle - ends.point[row] - ahead * ends.direction[row]))
    square = abs(float(normal @ ends.direction[row])) >= _SQUARE_ON
    return ahead > 0 and aside <= _ON_AXIS * float(ends.radius[row]) and square


def bodies_between(
    ends: Ends, mounts: Mapping[int, Sequence[int]], flat: FlatContacts, others: Collection[int]
) -> dict[int, int]:
    """Parts at which no line ends, but that flat contacts on its axis lead through to another line's end, or device.

    Args:
        ends: of all lines.
        mounts: rows of the ends at each part.
        flat: contacts of the parts.
        others: parts of other devices.

    Returns:
        For each such part the row of an end on that axis.
    """
    found: dict[int, int] = {}
    for body, rows in sorted(mounts.items()):
        for row in rows:
            chain = list(_following(ends, row, body, flat))
            met = [part in others or _is_met(ends, row, mounts.get(part, ())) for part in chain]
            last = met.index(True) if True in met else 0
            found |= {part: row for part in chain[:last] if part not in mounts}
    return found


def _following(ends: Ends, row: int, body: int, flat: FlatContacts) -> Iterator[int]:
    """The parts that follow a body on the axis of an end, each flanged to the one before it."""
    here, at = body, 0.0
    while True:
        ahead = [
            (far, there)
            for pair, (middle, normal) in flat.items()
            if here in pair and (far := ahead_of(ends, row, middle)) > at and heads_for(ends, row, middle, normal)
            for there in pair
            if there != here
        ]
        if not ahead:
            return
        at, here = min(ahead)
        yield here


def _is_met(ends: Ends, row: int, others: Sequence[int]) -> bool:
    """Whether one of some ends looks towards another one."""
    return any(float(ends.direction[row] @ ends.direction[other]) <= -_SQUARE_ON for other in others)
