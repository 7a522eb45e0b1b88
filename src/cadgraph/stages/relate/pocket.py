"""Ends of lines at which a fitting is closed in itself: the pot of a strainer, the holes of its bolts."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from cadgraph.stages.relate.attach import Attachments
from cadgraph.stages.relate.joint import Ends

__all__ = ["closed_ends"]

# Both mouths of a fitting are as wide within this share; they lie on one axis within this many radii.
_AS_WIDE, _ASIDE = 0.1, 0.5


def closed_ends(found: Attachments, fittings: Collection[int], lids: Collection[int]) -> frozenset[int]:
    """The free ends of fittings of two mouths that are neither of these, and in which no bore is seen.

    A fitting that two lines go on from has no other mouth; where one line does, what lies opposite and is as wide is
    the other mouth. Of one by itself nobody knows.

    Args:
        found: what joins what.
        fittings: the parts.
        lids: parts that close what they are joined to; these fittings may be lids of each other, too.

    Returns:
        Rows of these ends.
    """
    joined = list(found.joined())
    rows_joined = {row for row, _ in joined}
    leading = {row for row, other in joined if other not in fittings and other not in lids}
    closed: set[int] = set()
    for part in fittings:
        rows = found.ends.of_part.get(part, ())
        mouths = [row for row in rows if row in leading]
        closed.update(_beside(found.ends, mouths, [row for row in rows if row not in rows_joined]))
    return frozenset(closed)


def _beside(ends: Ends, mouths: Sequence[int], free: Sequence[int]) -> Sequence[int]:
    """The free ends of a fitting that are no mouth of it, by those that lines go on from."""
    other = _opposite(ends, mouths[0], free) if len(mouths) == 1 else None
    if len(mouths) + (other is not None) < 2:
        return ()
    # A bore leads on, whatever the fitting is called.
    return [row for row in free if row != other and np.isnan(ends.bore[row])]


def _opposite(ends: Ends, mouth: int, rows: Sequence[int]) -> int | None:
    """The end that looks the other way on the axis of a mouth, and is as wide; the farthest of several."""
    axis, radius = ends.direction[mouth], float(ends.radius[mouth])
    found: list[tuple[float, int]] = []
    for row in rows:
        apart = ends.point[row] - ends.point[mouth]
        along = -float(apart @ axis)
        aside = float(((apart + along * axis) ** 2).sum() ** 0.5)
        alike = abs(float(ends.radius[row]) - radius) <= _AS_WIDE * radius
        if alike and along > 0 and aside <= _ASIDE * radius and float(ends.direction[row] @ axis) < -0.9:
            found.append((along, row))
    return max(found)[1] if found else None
