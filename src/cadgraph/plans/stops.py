"""Where one stands to work at a unit, and the ways up between levels, as a graph says so."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Place, Point, ReachedFrom, Unit

__all__ = ["ANYWHERE", "Spot", "Stop", "Terrain", "Way", "spots_of", "worked_at"]

_REACH = 2.0  # m above where one stands, as in the reach of a unit; what is lower is out of reach for another reason

ANYWHERE = ""
"""Name of a spot that is anywhere on the ground: where a round begins and ends for which no start was given."""


@dataclass(frozen=True)
class Spot:
    """A point to stand at.

    Args:
        name: id of the unit or way that it is at; :data:`ANYWHERE`.
        level: id of the level; ``""`` for the ground of a graph that has no place for it.
        point: on the floor [m]; None for :data:`ANYWHERE`.
        sure: whether one is known to stand there.
    """

    name: str
    level: str
    point: Point | None
    sure: bool = True


@dataclass(frozen=True)
class Way:
    """Stairs or a ladder.

    Args:
        place: its node.
        ends: where one stands to enter or leave it, one for each level that it joins, the lowest first.
    """

    place: Place
    ends: tuple[Spot, ...]


@dataclass(frozen=True)
class Stop:
    """Where one works at a unit.

    Args:
        unit: its node.
        spot: where one stands; below the unit where that isn't known.
        aid: why it takes a ladder, a lift or some other access; None where it takes none, as far as is known.
        unsure: what isn't known, in words.
    """

    unit: Unit
    spot: Spot
    aid: str | None
    unsure: tuple[str, ...]


class Terrain:
    """The levels and ways of a graph.

    Args:
        graph: the finished graph; one that was built without places has neither, and is said to.
    """

    def __init__(self, graph: SceneGraph) -> None:
        self.graph = graph
        self.places = {place.id: place for place in graph.of_layer(Place)}
        self.ground = next((place.id for place in self.places.values() if place.kind == "ground"), "")
        self.ways = self._ways()
        self.reached = self._reached()

    @property
    def known(self) -> bool:
        """Whether the graph was built with places."""
        return bool(self.places)

    @property
    def ground_found(self) -> bool:
        """Whether a mesh was taken for the ground; else it is thought where the plant is lowest."""
        place = self.places.get(self.ground)
        return place is None or bool(place.parts)

    def name(self, level: str) -> str:
        """A level in words."""
        if level == self.ground or level not in self.places:
            return "ground" if self.ground_found else "lowest point of the plant"
        return self.places[level].name

    def stop(self, unit: Unit) -> Stop:
        """Where one works at a unit."""
        access = unit.access
        below = (unit.centroid[0], unit.centroid[1], self._height(self.ground))
        if access is None:
            why = "where to stand and whether it is within reach is not known"
            return Stop(unit, Spot(unit.id, self.ground, below, sure=False), None, (why,))
        level = access.place if access.place in self.places else self.ground
        unsure = [] if access.place in self.places else ["the level that it is reached from is not known"]
        if level == self.ground and not self.ground_found:
            unsure.append("no ground was found: heights are over the lowest point of the plant")
        aid = None
        # What is only read needs no hand at it.
        read = unit.unit_type == "gauge" and access.viewpoint is not None
        if access.reach == "out of reach" and not read:
            aid = f"its {worked_at(unit)} is {access.height:.1f} m above the {self.name(level)}, out of reach"
            if access.height <= _REACH:
                aid += ": no free place to stand near it was found"
        if level not in self.reached:
            aid = f"no way up to {self.name(level)} was found"
            level = self.ground
        stand, sure = access.stand, access.stand is not None and level == access.place
        if stand is None or not sure:
            stand = (unit.centroid[0], unit.centroid[1], self._height(level))
            if aid is None:
                unsure.append("where to stand is not known")
        return Stop(unit, Spot(unit.id, level, stand, sure), aid, tuple(unsure))

    def _height(self, level: str) -> float:
        return self.places[level].height if level in self.places else 0.0

    def _ways(self) -> dict[str, Way]:
        """All ways that join two levels or more, by id."""
        joins: dict[str, list[tuple[float, str]]] = {}
        for edge in self.graph.of_kind(ReachedFrom):
            for way, level in ((edge.target, edge.source), (edge.source, edge.target)):
                if _is_way(self.places.get(way)) and level in self.places and not _is_way(self.places[level]):
                    joins.setdefault(way, []).append((self._height(level), level))
        found = {}
        for name in sorted(joins):
            place = self.places[name]
            levels = sorted(set(joins[name]))
            if min(levels)[0] > self._foot(place) + 0.5 and self._starts_on_ground(place):
                levels = [(self._height(self.ground), self.ground), *levels]
            if len(levels) > 1:
                found[name] = Way(place, tuple(self._end(place, height, level) for height, level in levels))
        return found

    def _foot(self, way: Place) -> float:
        return way.low if way.low is not None else self._height(self.ground)

    def _starts_on_ground(self, way: Place) -> bool:
        return abs(self._foot(way) - self._height(self.ground)) <= 0.5

    def _end(self, way: Place, height: float, level: str) -> Spot:
        """Where one enters or leaves a way at a level; the middle of the way where it has no landing there."""
        near = [point for point in way.landings if abs(point[2] - height) <= 0.5]
        if near:
            return Spot(way.id, level, min(near, key=lambda point: abs(point[2] - height)))
        (x0, y0, _), (x1, y1, _) = way.aabb
        return Spot(way.id, level, ((x0 + x1) / 2, (y0 + y1) / 2, height), sure=False)

    def _reached(self) -> frozenset[str]:
        """Ids of the levels that one gets to from the ground."""
        found, more = {self.ground}, True
        while more:
            joined = {end.level for way in self.ways.values() if _levels(way) & found for end in way.ends}
            more = not joined <= found
            found |= joined
        return frozenset(found)


def _is_way(place: Place | None) -> bool:
    return place is not None and place.kind in ("stairs", "ladder")


def _levels(way: Way) -> set[str]:
    return {end.level for end in way.ends}


def worked_at(unit: Unit) -> str:
    """What of a unit a height is told of: what one reads or turns, as far as it was found."""
    if unit.unit_type == "gauge":
        return "face"
    return "middle" if unit.mechanism is None else "operator"


def spots_of(ways: Iterable[Way]) -> list[Spot]:
    """All ends of ways, in order."""
    return [end for way in ways for end in way.ends]
