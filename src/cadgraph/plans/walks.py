"""How far it is from one stop to another, over levels and ways up."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from cadgraph.model.records import Point
from cadgraph.plans.stops import ANYWHERE, Spot, Terrain, spots_of

__all__ = ["Leg", "Walk", "Walks", "anywhere"]

Walk = Callable[[Point, Point], float | None]
"""Length of a walk between two points of a level over its free floor [m]; None where there is none."""


@dataclass(frozen=True)
class Leg:
    """One walk on a level, or one climb.

    Args:
        start: where it begins.
        end: where it ends.
        length: [m]; of a climb the difference in height.
        climb: whether it goes up or down a way.
        estimated: whether the length is that of a straight line.
        blocked: whether no free way was found between the two, so that it is estimated.
    """

    start: Spot
    end: Spot
    length: float
    climb: bool = False
    estimated: bool = False
    blocked: bool = False


class Walks:
    """The shortest ways between spots.

    On a level one walks; from one level to another one climbs the ways between them. A climb counts by its height.

    Args:
        terrain: the levels and ways.
        walk: lengths of walks on a level; None estimates all as straight lines.
    """

    def __init__(self, terrain: Terrain, walk: Walk | None = None) -> None:
        self.terrain = terrain
        self._walk = walk
        self._legs: dict[tuple[Spot, Spot], Leg] = {}
        self._ends = spots_of(terrain.ways.values())
        self._next, self._between = self._over_ways()

    def length(self, start: Spot, end: Spot) -> float:
        """From one spot to another [m]; infinite where no way leads there."""
        return sum(leg.length for leg in legs) if (legs := self.legs(start, end)) is not None else math.inf

    def table(self, spots: Iterable[Spot]) -> list[list[float]]:
        """All lengths between spots, the same both ways [m]."""
        listed = list(spots)
        rows = [[0.0] * len(listed) for _ in listed]
        for i, start in enumerate(listed):
            for k in range(i):
                rows[i][k] = rows[k][i] = self.length(start, listed[k])
        return rows

    def legs(self, start: Spot, end: Spot) -> tuple[Leg, ...] | None:
        """The walks and climbs of the shortest way, none where one is there; None where no way leads there."""
        if start == end:
            return ()
        best = math.inf
        via: tuple[int, int] | None = None
        if start.level == end.level:
            best = self.on_level(start, end).length
        for i in self._at(start.level):
            entry = self.on_level(start, self._ends[i]).length
            for k in self._at(end.level):
                length = entry + self._between[i][k] + self.on_level(self._ends[k], end).length
                if i != k and length < best - 1e-9:
                    best, via = length, (i, k)
        if via is None:
            return None if math.isinf(best) else (self.on_level(start, end),)
        middle = self._chain(*via)
        legs = (self.on_level(start, self._ends[via[0]]), *middle, self.on_level(self._ends[via[1]], end))
        return tuple(leg for leg in legs if leg.start != leg.end)

    def on_level(self, start: Spot, end: Spot) -> Leg:
        """The walk between two spots of a level."""
        if (start, end) in self._legs:
            return self._legs[start, end]
        if (end, start) in self._legs:
            back = self._legs[end, start]
            leg = Leg(start, end, back.length, False, back.estimated, back.blocked)
        else:
            leg = self._measured(start, end)
        self._legs[start, end] = leg
        return leg

    def _measured(self, start: Spot, end: Spot) -> Leg:
        if start.point is None or end.point is None:
            return Leg(start, end, 0.0)
        straight = math.dist(start.point[:2], end.point[:2])
        if self._walk is None or not (start.sure and end.sure):
            return Leg(start, end, straight, estimated=True)
        length = self._walk(start.point, end.point)
        return Leg(start, end, straight if length is None else length, False, length is None, length is None)

    def _at(self, level: str) -> list[int]:
        return [i for i, end in enumerate(self._ends) if end.level == level]

    def _chain(self, first: int, last: int) -> list[Leg]:
        """The walks and climbs between two ends of ways."""
        legs: list[Leg] = []
        while first != last:
            following = self._next[first][last]
            a, b = self._ends[first], self._ends[following]
            legs.append(self.climb(a, b) if a.name == b.name else self.on_level(a, b))
            first = following
        return legs

    def climb(self, start: Spot, end: Spot) -> Leg:
        """The climb from one end of a way to another one of it."""
        heights = [spot.point[2] if spot.point else 0.0 for spot in (start, end)]
        return Leg(start, end, abs(heights[1] - heights[0]), climb=True)

    def _over_ways(self) -> tuple[list[list[int]], list[list[float]]]:
        """Between all ends of ways: which one comes next on the shortest way, and its length (Floyd, Warshall)."""
        n = len(self._ends)
        between = [[math.inf] * n for _ in range(n)]
        following = [list(range(n)) for _ in range(n)]
        for i, a in enumerate(self._ends):
            for k, b in enumerate(self._ends):
                if i == k:
                    between[i][k] = 0.0
                elif a.name == b.name:
                    between[i][k] = self.climb(a, b).length
                elif a.level == b.level:
                    between[i][k] = self.on_level(a, b).length
        for m in range(n):
            for i in range(n):
                for k in range(n):
                    if between[i][m] + between[m][k] < between[i][k] - 1e-9:
                        between[i][k] = between[i][m] + between[m][k]
                        following[i][k] = following[i][m]
        return following, between


def anywhere(terrain: Terrain) -> Spot:
    """The spot of a round that begins and ends anywhere on the ground."""
    return Spot(ANYWHERE, terrain.ground, None)
