"""The straight pieces of a line, and where they lie on the sheet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

from cadgraph.draw.isometric.sheet import COS, SIN, Spot, between
from cadgraph.model.records import Point
from cadgraph.query.piped_line import Component

__all__ = ["Leg", "corner", "legs_of", "project", "straights", "untangled"]

# Drawn lengths: a component always has the same, a pipe's grows with the logarithm of its length.
_LENGTHS = {"flange": 7.0, "gasket": 3.0, "blind flange": 7.0, "valve": 30.0, "reducer": 24.0, "instrument": 30.0}
_CLOSE = 12.0  # legs that come nearer than this are drawn apart
_LEG, _OTHER = 16.0, 24.0


@dataclass(frozen=True)
class Leg:
    """A straight piece of a component: all of it, or one side of an elbow."""

    component: Component
    start: Point
    end: Point
    drawn: float
    half: int = 0  # 1 and 2: before and after the corner of what turns


def legs_of(components: Sequence[Component]) -> list[Leg]:
    """The legs of components in a row; what turns has two."""
    legs = []
    for each in components:
        if math.dist(each.start, each.end) == 0 and each.centre in (None, each.start):
            continue
        if each.centre is not None and (each.angle or each.kind in ("tee", "cross")):
            legs.append(Leg(each, each.start, each.centre, _LEG, 1))
            legs.append(Leg(each, each.centre, each.end, _LEG, 2))
        else:
            legs.append(Leg(each, each.start, each.end, _drawn(each)))
    return [leg for leg in legs if math.dist(leg.start, leg.end) > 0] or legs


def _drawn(component: Component) -> float:
    if component.kind == "pipe":
        return 30.0 + 45.0 * math.log1p(component.length / 0.4)
    return _LENGTHS.get(component.kind, _OTHER)


def untangled(legs: Sequence[Leg]) -> tuple[list[Spot], bool]:
    """Places of the legs on the sheet, and whether it is turned.

    Drawn longer along one axis or another where they would lie on each other. Half way between two axes, what lies
    would seem to stand: then the plant is seen from the other side.
    """
    factors = list(product((1.0, 1.4, 1.9), repeat=3))
    ways = [(_spots(legs, each, turned), turned) for turned in (False, True) for each in factors]

    def worth(item: tuple[int, tuple[list[Spot], bool]]) -> tuple[int, int, int]:
        number, (spots, _) = item
        return _mistaken(legs, spots), _tangles(legs, spots), number

    return min(enumerate(ways), key=worth)[1]


def _mistaken(legs: Sequence[Leg], spots: Sequence[Spot]) -> int:
    """How many legs seem to stand, but don't."""
    count = 0
    for leg, a, b in zip(legs, spots, spots[1:], strict=False):
        rise, length = abs(leg.end[2] - leg.start[2]), math.dist(leg.start, leg.end)
        count += length > 0 and rise < 0.5 * length and abs(b[0] - a[0]) < 0.2 * math.dist(a, b)
    return count


def _tangles(legs: Sequence[Leg], spots: Sequence[Spot]) -> int:
    """How many samples of legs lie close to one of another leg that isn't its neighbour."""
    cells: dict[tuple[int, int], list[int]] = {}
    for i, (a, b) in enumerate(pairwise(spots)):
        steps = max(1, math.ceil(math.dist(a, b) / _CLOSE))
        for k in range(steps):
            x, y = between(a, b, (k + 0.5) / steps)
            cells.setdefault((round(x / _CLOSE), round(y / _CLOSE)), []).append(i)
    return sum(max(found) - min(found) > 2 for found in cells.values())


def _spots(legs: Sequence[Leg], factors: Sequence[float], turned: bool) -> list[Spot]:
    """Where the legs begin on the sheet, and where the last one ends.

    Args:
        legs: in order.
        factors: by which pipes along x, y and z are drawn longer.
        turned: whether north is to the upper left.
    """
    spots = [(0.0, 0.0)]
    for leg in legs:
        vector = tuple(b - a for a, b in zip(leg.start, leg.end, strict=True))
        dx, dy = project(vector, turned)
        length = math.dist(leg.start, leg.end) or 1.0
        main = max(range(3), key=lambda axis: abs(vector[axis]))
        drawn = leg.drawn * (factors[main] if leg.component.kind == "pipe" else 1.0)
        x, y = spots[-1]
        spots.append((x + dx / length * drawn, y + dy / length * drawn))
    return spots


def project(vector: Sequence[float], turned: bool) -> Spot:
    """A way in the plant on the sheet, its length kept to scale."""
    x, y, z = vector
    if turned:
        x, y = -y, x
    return (x + y) * COS, (x - y) * SIN - z


def straights(legs: Sequence[Leg]) -> Iterator[tuple[int, int]]:
    """The first leg of each straight and the one after its last."""
    start = 0
    for i in range(1, len(legs) + 1):
        if i == len(legs) or _turns(legs[start], legs[i]):
            yield start, i
            start = i


def _turns(one: Leg, other: Leg) -> bool:
    a = tuple(y - x for x, y in zip(one.start, one.end, strict=True))
    b = tuple(y - x for x, y in zip(other.start, other.end, strict=True))
    lengths = math.hypot(*a) * math.hypot(*b)
    return lengths > 0 and sum(x * y for x, y in zip(a, b, strict=True)) / lengths < 0.98


def corner(legs: Sequence[Leg], i: int) -> Point:
    """Where a leg begins in the plant; behind the last, where that ends [m]."""
    return legs[i].start if i < len(legs) else legs[-1].end
