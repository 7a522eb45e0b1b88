"""The records of levels and ways up, and of how people get at units."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph.model.grid import to_runs
from cadgraph.model.places import FoundPlace, UnitAccess
from cadgraph.model.records import Access, Contains, Edge, FreeFloor, Place, ReachedFrom, Unit, points
from cadgraph.model.scene import Floats
from cadgraph.stages.assemble.results import Results, in_world, rounded

__all__ = ["access_of", "level_records", "reached_edges"]


def access_of(results: Results, number: int) -> Access | None:
    """How people get at a unit; None where it was not looked for."""
    if results.reached is None:
        return None
    found: UnitAccess = results.reached.access[number]
    origin = results.scene.origin
    return Access(
        place=None if found.place is None else _place_id(found.place),
        stand=None if found.stand is None else in_world(found.stand, origin),
        height=rounded(found.height),
        reach=found.reach,
        facing=None if found.facing is None else points(found.facing)[0],
        facing_confidence=None if found.facing_confidence is None else round(found.facing_confidence, 6),
        viewpoint=None if found.viewpoint is None else in_world(found.viewpoint, origin),
    )


def _place_id(number: int) -> str:
    return f"place-{number + 1:03d}"


def level_records(results: Results, part_ids: Sequence[str]) -> list[Place]:
    """Levels and ways up."""
    found = results.reached.places if results.reached is not None else ()
    return [_place(number, place, results.scene.origin, part_ids) for number, place in enumerate(found)]


def _place(number: int, place: FoundPlace, origin: Floats, part_ids: Sequence[str]) -> Place:
    lift = float(origin[2])
    floor = None
    if place.grid is not None and place.free is not None:
        (x, y), grid = place.grid.origin, place.grid
        corner = round(x + float(origin[0]), 9), round(y + float(origin[1]), 9)
        floor = FreeFloor(origin=corner, step=grid.step, size=grid.size, runs=to_runs(place.free))
    return Place(
        id=_place_id(number),
        kind=place.kind,
        name=place.name,
        height=rounded(place.height + lift),
        low=None if place.low is None else rounded(place.low + lift),
        area=rounded(place.area),
        aabb=(in_world(place.box[0], origin), in_world(place.box[1], origin)),
        parts=tuple(part_ids[part] for part in place.parts),
        floor=floor,
        landings=tuple(in_world(landing, origin) for landing in place.landings),
    )


def reached_edges(results: Results, levels: Sequence[Place], units: Sequence[Unit]) -> list[Edge]:
    """What is reached from each level, and from where one gets to the levels and the ways up."""
    found = results.reached.places if results.reached is not None else ()
    edges: list[Edge] = [
        Contains(source=unit.access.place, target=unit.id)
        for unit in units
        if unit.access is not None and unit.access.place is not None and unit.access.reach != "out of reach"
    ]
    edges += [
        ReachedFrom(source=levels[number].id, target=levels[other].id)
        for number, place in enumerate(found)
        for other in place.reached_from
    ]
    return edges
