"""Centrelines as polylines: where along them a point lies, what turns and what runs straight."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from cadgraph.model.records import Point

__all__ = ["Polyline", "Stretch", "add", "angle", "apex", "dot", "minus", "times", "unit"]

_SAME = 1e-7  # m; points nearer than this are one
_STRAIGHT = math.radians(2.0)  # ours: less than any fitting turns, more than a centreline found in triangles wavers
_ONE_BEND = math.radians(
    120
)  # ours: fittings turn by 90 degrees at most, pulled bends of more come as one piece rarely
_OFF_PLANE = 0.15  # ours: sine of the angle by which one bend may leave its plane


def minus(a: Point, b: Point) -> Point:
    """The vector from ``b`` to ``a``."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def add(a: Point, b: Point) -> Point:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def times(a: Point, factor: float) -> Point:
    """A vector, longer by a factor."""
    return a[0] * factor, a[1] * factor, a[2] * factor


def dot(a: Point, b: Point) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a: Point) -> Point:
    """The vector of length 1 in the same direction; of no length, it stays."""
    length = math.hypot(*a)
    return times(a, 1 / length) if length > 0 else a


def angle(a: Point, b: Point) -> float:
    """The angle between two vectors [rad]."""
    cross = _cross(a, b)
    return math.atan2(math.hypot(*cross), dot(a, b))


def _cross(a: Point, b: Point) -> Point:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def apex(start: Point, along: Point, end: Point, back: Point) -> Point | None:
    """Where the straights on both sides of a bend would meet: the point between the two that is nearest to both.

    Args:
        start: of the bend.
        along: unit vector of the straight before it.
        end: of the bend.
        back: unit vector of the straight after it.

    Returns:
        None where they are nearly parallel, or the point lies behind the start or beyond the end.
    """
    b, w = dot(along, back), minus(start, end)
    d, e = dot(along, w), dot(back, w)
    det = 1 - b * b
    if det < 1e-4:
        return None
    first, second = (b * e - d) / det, (e - b * d) / det
    if first <= 0 or second >= 0:
        return None
    return times(add(add(start, times(along, first)), add(end, times(back, second))), 0.5)


@dataclass(frozen=True)
class Stretch:
    """A piece of a centreline.

    Args:
        start: where it begins along the line [m].
        end: where it ends [m].
        turns: whether it is a bend.
    """

    start: float
    end: float
    turns: bool


@dataclass(frozen=True)
class Polyline:
    """A line through points.

    Args:
        points: at least one, in order, no two neighbours the same.
    """

    points: tuple[Point, ...]

    @classmethod
    def through(cls, points: Sequence[Point]) -> Polyline:
        """The line through some points; repeated ones count once."""
        kept: list[Point] = []
        for point in points:
            if not kept or math.dist(kept[-1], point) > _SAME:
                kept.append(point)
        return cls(tuple(kept))

    @cached_property
    def stations(self) -> tuple[float, ...]:
        """How far along each point is [m]."""
        found = [0.0]
        for a, b in pairwise(self.points):
            found.append(found[-1] + math.dist(a, b))
        return tuple(found)

    @property
    def length(self) -> float:
        """Of the whole line [m]."""
        return self.stations[-1]

    def at(self, station: float) -> Point:
        """The point so far along [m]; the ends for what is beyond them."""
        if len(self.points) == 1 or station <= 0:
            return self.points[0]
        if station >= self.length:
            return self.points[-1]
        i = min(bisect_right(self.stations, station), len(self.points) - 1)
        before, after = self.stations[i - 1], self.stations[i]
        share = (station - before) / (after - before)
        return add(self.points[i - 1], times(minus(self.points[i], self.points[i - 1]), share))

    def nearest(self, point: Point, start: float = 0.0, end: float = math.inf) -> tuple[float, float]:
        """The station between two stations that is nearest to a point, and its distance from it [m]."""
        low, high = max(0.0, start), min(self.length, end)
        best = (math.dist(self.at(low), point), low)
        for i, (a, b) in enumerate(pairwise(self.points)):
            first, last = max(low, self.stations[i]), min(high, self.stations[i + 1])
            if last < first:
                continue
            way = minus(b, a)
            along = self.stations[i] + dot(minus(point, a), way) / math.hypot(*way)
            station = min(max(along, first), last)
            best = min(best, (math.dist(self.at(station), point), station))
        return best[1], best[0]

    def direction(self, start: float, end: float) -> Point:
        """The unit vector of the chord between two stations."""
        return unit(minus(self.at(end), self.at(start)))

    def between(self, start: float, end: float) -> tuple[Point, ...]:
        """The points of the piece between two stations, both ends included."""
        inner = [p for p, s in zip(self.points, self.stations, strict=True) if start + _SAME < s < end - _SAME]
        return (self.at(start), *inner, self.at(end))

    def stretches(self, start: float, end: float, diameter: float) -> tuple[Stretch, ...]:
        """The piece between two stations as straights and single bends, in order.

        Args:
            start: where it begins [m].
            end: where it ends [m].
            diameter: of the pipe [m]; what is shorter between two turns belongs to the bend.
        """
        piece = Polyline.through(_simple(self.between(start, end), max(1e-4, 5e-4 * diameter)))
        if len(piece.points) < 3:
            return (Stretch(start, end, False),)
        # The simplified line is a little shorter; stations are those of the line itself.
        stations = [start]
        for point in piece.points[1:-1]:
            stations.append(self.nearest(point, stations[-1], end)[0])
        stations.append(end)
        ways = [unit(minus(b, a)) for a, b in pairwise(piece.points)]
        long = [b - a >= diameter for a, b in pairwise(stations)]
        found: list[Stretch] = []
        i = 0
        while i < len(ways):
            if long[i]:
                found.append(Stretch(stations[i], stations[i + 1], False))
                i += 1
                continue
            j = i
            while j < len(ways) and not long[j]:
                j += 1
            before, after = ways[max(0, i - 1)], ways[min(j, len(ways) - 1)]
            found.extend(_bends(stations[i : j + 1], ways[i:j], before, after))
            i = j
        return _joined(found, self)


def _bends(stations: Sequence[float], ways: Sequence[Point], before: Point, after: Point) -> list[Stretch]:
    """A run of short segments as bends of one turn each; as a straight where it hardly turns.

    Args:
        stations: where the segments begin, and the end of the last.
        ways: their directions.
        before: direction of what comes before them.
        after: direction of what comes after them.
    """
    own = [before, *ways, after]
    turned = sum(angle(a, b) for a, b in pairwise(own))
    if turned < _STRAIGHT:
        return [Stretch(stations[0], stations[-1], False)]
    if len(ways) > 2 and (turned > _ONE_BEND or _leaves_plane(own)):
        lengths = [b - a for a, b in pairwise(stations)]
        middle = max(range(1, len(ways) - 1), key=lambda k: (lengths[k], -abs(k - (len(ways) - 1) / 2)))
        # In the middle of the longest segment one bend ends and the next begins.
        half = (stations[middle] + stations[middle + 1]) / 2
        return [
            *_bends([*stations[: middle + 1], half], ways[: middle + 1], before, ways[middle]),
            *_bends([half, *stations[middle + 1 :]], ways[middle:], ways[middle], after),
        ]
    return [Stretch(stations[0], stations[-1], True)]


def _leaves_plane(ways: Sequence[Point]) -> bool:
    normals = [_cross(a, b) for a, b in pairwise(ways) if angle(a, b) > _STRAIGHT]
    if len(normals) < 2:
        return False
    main = unit(normals[0])
    return any(dot(unit(normal), main) < math.sqrt(1 - _OFF_PLANE**2) for normal in normals[1:])


def _joined(found: Sequence[Stretch], line: Polyline) -> tuple[Stretch, ...]:
    """Straights in one direction after each other are one."""
    joined: list[Stretch] = []
    for stretch in found:
        last = joined[-1] if joined else None
        if last is not None and not last.turns and not stretch.turns:
            ways = line.direction(last.start, last.end), line.direction(stretch.start, stretch.end)
            if angle(*ways) < _STRAIGHT:
                joined[-1] = Stretch(last.start, stretch.end, False)
                continue
        joined.append(stretch)
    return tuple(joined)


def _simple(points: Sequence[Point], tolerance: float) -> list[Point]:
    """The fewest of the points that all others are within a distance of (Douglas and Peucker, 1973)."""
    kept = {0, len(points) - 1}
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        way = minus(points[last], points[first])
        squared = dot(way, way)
        worst, where = tolerance, -1
        for i in range(first + 1, last):
            off = minus(points[i], points[first])
            share = min(1.0, max(0.0, dot(off, way) / squared)) if squared else 0.0
            distance = math.dist(off, times(way, share))
            if distance > worst:
                worst, where = distance, i
        if where >= 0:
            kept.add(where)
            spans += [(first, where), (where, last)]
    return [points[i] for i in sorted(kept)]
