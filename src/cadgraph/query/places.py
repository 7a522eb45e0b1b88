"""Where people get to in a plant: its levels, the ways up, how they get at a unit, and how far it is to walk."""

from __future__ import annotations

import heapq
import math
from collections import deque
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from cadgraph.model.derived import kept_with
from cadgraph.model.graph import SceneGraph
from cadgraph.model.grid import Grid, from_runs
from cadgraph.model.records import Access, FreeFloor, Place, Point, ReachedFrom, Unit
from cadgraph.model.regions import region_of
from cadgraph.model.scene import Floats, Ints

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["access_of", "levels", "region", "stand_at", "walk", "way_to"]

_ON = 0.3  # m; a point this far over or under a floor, or beside its free squares, is on it
_ARM = 0.9  # m in plan from where one stands to what one works at
_LOWEST = -0.05  # m; what lies deeper than this below a floor isn't got at from it
_KEPT = 256  # starts of walks whose lengths to everywhere are kept


def levels(graph: SceneGraph) -> list[Place]:
    """What one can stand on, by height: the ground first; empty where the graph was built without places."""
    return [place for place in graph.of_layer(Place) if place.kind in ("ground", "platform")]


def way_to(graph: SceneGraph, place: Place | str) -> tuple[Place, ...]:
    """The levels and ways up from the ground to a place, itself included, with the fewest of them.

    Args:
        graph: with places.
        place: a level or a way up, or its id.

    Returns:
        Empty where no way up to it is known.

    Raises:
        KeyError: the graph has no such place.
    """
    goal = place if isinstance(place, Place) else graph.find(place, Place)
    above: dict[str, list[str]] = {}
    for edge in graph.of_kind(ReachedFrom):
        above.setdefault(edge.target, []).append(edge.source)
    ground = [one.id for one in graph.of_layer(Place) if one.kind == "ground"]
    came: dict[str, str | None] = dict.fromkeys(ground)
    waiting = deque(ground)
    while waiting and goal.id not in came:
        here = waiting.popleft()
        for other in above.get(here, ()):
            if other not in came:
                came[other] = here
                waiting.append(other)
    steps: list[Place] = []
    here_: str | None = goal.id if goal.id in came else None
    while here_ is not None:
        node = graph.nodes[here_]
        steps += [node] if isinstance(node, Place) else []
        here_ = came[here_]
    return tuple(steps[::-1])


def access_of(graph: SceneGraph, unit: Unit | str) -> Access | None:
    """How people get at a unit; None where the graph was built without places.

    Args:
        graph: that holds it.
        unit: itself, its tag or id.

    Raises:
        KeyError: the graph has no such unit.
    """
    return (unit if isinstance(unit, Unit) else graph.unit(unit)).access


def region(graph: SceneGraph, point: Sequence[float]) -> str:
    """The ninth of the plan that a point is in: ``north east``, ``south``, ``middle``; north is +y.

    Args:
        graph: whose parts but for the ground make up the plan.
        point: ``(x, y, ...)`` [m].
    """
    low, high = _plan(graph)
    return region_of(low, high, point)


@kept_with
def _plan(graph: SceneGraph) -> tuple[Point, Point]:
    boxes = [part.aabb for part in graph.parts() if not part.ground] or [part.aabb for part in graph.parts()]
    if not boxes:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    low, high = np.array(boxes)[:, 0].min(axis=0).tolist(), np.array(boxes)[:, 1].max(axis=0).tolist()
    return tuple(low), tuple(high)


def stand_at(graph: SceneGraph, unit: Unit, reach: float) -> tuple[Place, Point] | None:
    """Where one can stand to work at a unit with another reach than the one that its access was found with.

    Args:
        graph: with places.
        unit: with access.
        reach: how high over the floor one gets [m].

    Returns:
        The level, the ground before others, and the nearest free square of it within 0.9 m in plan; None where there
        is none.
    """
    access = unit.access
    below = graph.nodes.get(access.place or "") if access is not None else None
    if access is None or not isinstance(below, Place):
        return None
    height = below.height + access.height
    for level in levels(graph):
        if not _LOWEST <= height - level.height <= reach or not way_to(graph, level):
            continue
        floor = _walks(graph).floor(level.id)
        point = floor.nearest(unit.aabb[0], unit.aabb[1], _ARM) if floor is not None else None
        if point is not None:
            return level, point
    return None


def walk(graph: SceneGraph, a: Sequence[float], b: Sequence[float]) -> float | None:
    """How far it is to walk from one standing point to another, over the free squares of levels and the ways up.

    Args:
        graph: with places.
        a: ``(x, y, z)`` on a floor [m].
        b: likewise.

    Returns:
        [m], up to 8 % more than the shortest way on a floor, since steps go along squares and across their corners;
        None where a point is on no floor, or no free way is known.
    """
    return _walks(graph).length(a, b)


class _Floor:
    """The free squares of a level, each with those beside it."""

    def __init__(self, floor: FreeFloor, height: float) -> None:
        self.grid = Grid(floor.origin, floor.step, floor.size)
        self.height = height
        self.free = from_runs(floor.runs, floor.size)
        self._number = np.full(self.free.shape, -1, np.int64)
        self._number[self.free] = np.arange(int(self.free.sum()))
        self._links = self._linked()
        self._far: dict[int, Floats] = {}

    def _linked(self) -> csr_array[Any, tuple[int, int]]:
        from scipy.sparse import csr_array

        n: int = int(self.free.sum())
        ends: list[Ints] = []
        costs: list[Floats] = []
        number = self._number
        columns, rows = self.grid.size
        for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
            a = number[: rows - down, max(0, -right) : columns - max(0, right)]
            b = number[down:, max(0, right) : columns - max(0, -right)]
            both = (a >= 0) & (b >= 0)
            ends.append(np.column_stack([a[both], b[both]]))
            costs.append(np.full(int(both.sum()), self.grid.step * math.hypot(down, right)))
        pairs = np.concatenate(ends)
        return csr_array((np.concatenate(costs), (pairs[:, 0], pairs[:, 1])), shape=(n, n))

    def square(self, point: Sequence[float]) -> int | None:
        """The number of the free square that a point on the floor is on, or that is nearest to it; None if none is."""
        if abs(point[2] - self.height) > _ON:
            return None
        found = self._nearest(point, point, _ON)
        return None if found is None else int(self._number[found])

    def nearest(self, low: Sequence[float], high: Sequence[float], most: float) -> Point | None:
        """The middle of the free square that is nearest to a box in plan, at most so far from it [m]."""
        found = self._nearest(low, high, most)
        if found is None:
            return None
        xs, ys = self.grid.centers()
        return float(xs[found[1]]), float(ys[found[0]]), self.height

    def _nearest(self, low: Sequence[float], high: Sequence[float], most: float) -> tuple[int, int] | None:
        first = np.maximum(self.grid.square_of([low[0] - most, low[1] - most])[0], 0)
        last = np.minimum(self.grid.square_of([high[0] + most, high[1] + most])[0], np.array(self.grid.size) - 1)
        if (last < first).any():
            return None
        rows, columns = slice(first[1], last[1] + 1), slice(first[0], last[0] + 1)
        xs, ys = self.grid.centers()
        dx = np.maximum(np.maximum(low[0] - xs[columns], xs[columns] - high[0]), 0.0)
        dy = np.maximum(np.maximum(low[1] - ys[rows], ys[rows] - high[1]), 0.0)
        away = np.round(np.hypot(dx[None, :], dy[:, None]), 6)
        away[~self.free[rows, columns] | (away > most)] = np.inf
        row, column = divmod(int(np.argmin(away)), away.shape[1])
        if not np.isfinite(away[row, column]):
            return None
        return int(first[1]) + row, int(first[0]) + column

    def far(self, start: int) -> Floats:
        """The lengths of the shortest walks from a free square to all others [m]; infinite where none leads."""
        if start not in self._far:
            from scipy.sparse.csgraph import dijkstra

            if len(self._far) >= _KEPT:
                self._far.pop(next(iter(self._far)))
            self._far[start] = dijkstra(self._links, directed=False, indices=[start])[0]
        return self._far[start]


class _Walks:
    """The floors of a plant, and the ways up between them."""

    def __init__(self, graph: SceneGraph) -> None:
        self._places = {place.id: place for place in levels(graph)}
        self._floors: dict[str, _Floor] = {}
        self._ways = [place for place in graph.of_layer(Place) if len(place.landings) > 1]

    def floor(self, level: str) -> _Floor | None:
        """The floor of a level; None where it has none."""
        place = self._places[level]
        if place.floor is None or not place.floor.runs:
            return None
        if level not in self._floors:
            self._floors[level] = _Floor(place.floor, place.height)
        return self._floors[level]

    def length(self, a: Sequence[float], b: Sequence[float]) -> float | None:
        """Of the shortest walk between two points [m]; None where none is known."""
        ends = [self._spot(a), self._spot(b)]
        if ends[0] is None or ends[1] is None:
            return None
        spots = [ends[0], ends[1]]
        climbs: dict[int, list[tuple[int, float]]] = {}
        for way in self._ways:
            landed = [(spot, point) for point in way.landings if (spot := self._spot(point)) is not None]
            numbers = [len(spots) + k for k in range(len(landed))]
            spots += [spot for spot, _ in landed]
            for i, (_, start) in zip(numbers, landed, strict=True):
                climbs[i] = [(k, math.dist(start, end)) for k, (_, end) in zip(numbers, landed, strict=True) if k != i]
        return self._shortest(spots, climbs)

    def _spot(self, point: Sequence[float]) -> tuple[str, int] | None:
        """The level and the free square of it that a point is on."""
        for level in self._places:
            floor = self.floor(level)
            square = floor.square(point) if floor is not None else None
            if square is not None:
                return level, square
        return None

    def _shortest(self, spots: Sequence[tuple[str, int]], climbs: dict[int, list[tuple[int, float]]]) -> float | None:
        """From the first spot to the second, walking on levels and climbing between landings."""
        best = {0: 0.0}
        waiting = [(0.0, 0)]
        while waiting:
            length, here = heapq.heappop(waiting)
            if here == 1:
                return length
            if length > best[here]:
                continue
            level, square = spots[here]
            floor = self.floor(level)
            far = floor.far(square) if floor is not None else np.zeros(0)
            steps = [(k, float(far[spot])) for k, (other, spot) in enumerate(spots) if other == level and k != here]
            for there, more in (*steps, *climbs.get(here, ())):
                if length + more < best.get(there, math.inf):
                    best[there] = length + more
                    heapq.heappush(waiting, (length + more, there))
        return None


@kept_with
def _walks(graph: SceneGraph) -> _Walks:
    return _Walks(graph)
