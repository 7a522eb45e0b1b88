"""The lengths of straights, and the ways of those that run along no axis."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cadgraph.draw.isometric.legs import Leg, project, straights
from cadgraph.draw.isometric.sheet import COS, SIN, Isometric, Spot, between, meet, off

__all__ = ["draw_dimensions", "draw_skews"]

_DIMENSION = 26.0  # a dimension line stands so far from its pipe
_WORSE = 6  # so much worse than another dimension it is to cross a pipe
_STRAIGHT = 0.98  # of a direction's length along one axis, from which on it runs along that


def draw_dimensions(sheet: Isometric, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """The length of each straight, from corner to corner, beside it."""
    n_pipes = len(sheet.solid)
    for start, stop in straights(legs):
        a, b = spots[start], spots[stop]
        length = math.dist(legs[start].start, legs[stop - 1].end) * 1000
        if math.dist(a, b) > 20:
            across, reach = _side(sheet, a, b, n_pipes)
            first, last = off(a, across, reach), off(b, across, reach)
            sheet.line([off(a, across, 6), off(a, across, reach + 5)], "d")
            sheet.line([off(b, across, 6), off(b, across, reach + 5)], "d")
            sheet.line([first, last], "d")
            sheet.text(between(first, last, 0.5), [f"{length:.0f}"], across)


def _side(sheet: Isometric, a: Spot, b: Spot, n_pipes: int) -> tuple[Spot, float]:
    """Which way from a pipe, along one of the axes, and how far, a dimension line and its ends cross least.

    Args:
        sheet: with pipes and symbols, and with the dimensions before this one.
        a: where the pipe begins.
        b: where it ends.
        n_pipes: how many of what is solid on the sheet is no dimension: to cross one of these is worse.
    """
    along = ((b[0] - a[0]) / math.dist(a, b), (b[1] - a[1]) / math.dist(a, b))
    axes = ((0.0, 1.0), (COS, SIN), (COS, -SIN))
    # First up or down beside what lies, east or west beside what stands.
    ways = [(x * sign, y * sign) for x, y in axes if abs(x * along[1] - y * along[0]) > 0.4 for sign in (1.0, -1.0)]
    found = []
    for reach in (_DIMENSION, 1.8 * _DIMENSION, 2.6 * _DIMENSION):
        for number, way in enumerate(ways):
            points = [*_along(off(a, way, reach), off(b, way, reach))]
            points += [point for end in (a, b) for point in _along(off(end, way, 11), off(end, way, reach + 5))]
            boxes = [(x - 3, y - 3, x + 3, y + 3) for x, y in points]
            crossed = sum(
                _WORSE * any(meet(box, other) for other in sheet.solid[:n_pipes])
                + any(meet(box, other) for other in sheet.solid[n_pipes:])
                for box in boxes
            )
            found.append((crossed, reach, number, way))
    _, reach, _, way = min(found)
    return way, reach


def _along(a: Spot, b: Spot) -> list[Spot]:
    """Points between two, six apart."""
    steps = max(2, math.ceil(math.dist(a, b) / 6))
    return [between(a, b, k / steps) for k in range(steps + 1)]


def draw_skews(sheet: Isometric, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """Beside each straight that runs along none of the axes, the way along them from its start to its end."""
    for first, last in straights(legs):
        a, b = spots[first], spots[last]
        vector = [y - x for x, y in zip(legs[first].start, legs[last - 1].end, strict=True)]
        length = math.hypot(*vector)
        if math.dist(a, b) <= 20 or max(map(abs, vector)) > _STRAIGHT * length:
            continue
        dx, dy = project(vector, sheet.turned)
        share = math.dist(a, b) / (math.hypot(dx, dy) or 1.0)
        way = [a]
        for axis in sorted(range(3), key=lambda axis: -abs(vector[axis])):
            own = [0.0, 0.0, 0.0]
            own[axis] = vector[axis] * share
            if abs(vector[axis]) > 0.05 * length:
                way.append(off(way[-1], project(own, sheet.turned), 1.0))
        sheet.line(way, "k")
