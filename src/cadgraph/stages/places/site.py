"""The places of a plant: its levels, the ways up to them, and which squares of them one gets to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.grid import Grid
from cadgraph.model.labels import Label
from cadgraph.model.parts import Bools, Parts
from cadgraph.model.places import FoundPlace
from cadgraph.model.regions import region_of
from cadgraph.model.scene import Floats
from cadgraph.stages.places.levels import Level, ground_height, level_candidates, plan_box, stands_out
from cadgraph.stages.places.room import Room, ground_room, level_room, nearest_square
from cadgraph.stages.places.ways import WayUp, find_ways

__all__ = ["Ground", "find_site", "standing"]

_LEAST_AREA = 0.25  # m2 on which nothing stands, for a level to count
_TO_LANDING = 1.0  # m in plan from a way to where one stands before it
_Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Ground:
    """What one stands on, as the search goes on: the ground or a level.

    Args:
        height: of its floor [m].
        parts: that it is made of; none needs to be of the ground.
        boxes: ``(n, 2, 3)`` of them [m]; None for the ground, which is everywhere.
        room: its squares.
        reached: ``(rows, columns)`` those that one gets to.
    """

    height: float
    parts: tuple[int, ...]
    boxes: Floats | None
    room: Room
    reached: Bools

    @property
    def is_reached(self) -> bool:
        """Whether one gets to any of it."""
        return bool(self.reached.any())


@dataclass(frozen=True, eq=False)
class _Way:
    """A way up with the levels that it joins, the lowest first, and where one stands on each."""

    way: WayUp
    levels: tuple[int, ...]
    squares: tuple[tuple[int, int], ...]


def find_site(parts: Parts, labels: Sequence[Label | None]) -> tuple[list[FoundPlace], list[Ground], list[int]]:
    """All places, and the levels among them with their squares.

    Args:
        parts: of the scene.
        labels: of each part.

    Returns:
        The places by height, then position; the levels, of which each carries the squares that one gets to, the ground
        first; and the number of each level's place.
    """
    zero = ground_height(parts)
    low, high = plan_box(parts)
    ways = find_ways(parts, labels)
    grounds = _grounds(parts, labels, ways, zero, low, high)
    climbed = _climb(grounds, ways)
    places = [_level_place(g, low, high, zero) for g in grounds] + [_way_place(w, grounds, low, high) for w in climbed]
    # A level is reached from the ways that lead to it, a way from the level that it starts on.
    above = {k: [len(grounds) + n for n, w in enumerate(climbed) if k in w.levels[1:]] for k in range(len(grounds))}
    below = {len(grounds) + n: [w.levels[0]] for n, w in enumerate(climbed)}
    steps = {**above, **below}
    order = sorted(range(len(places)), key=lambda k: _order(places[k]))
    rank = {old: new for new, old in enumerate(order)}
    named = _named_apart([places[k] for k in order])
    found = [
        FoundPlace(**{**vars(place), "reached_from": tuple(sorted(rank[other] for other in steps[old]))})
        for old, place in zip(order, named, strict=True)
    ]
    levels = sorted(range(len(grounds)), key=rank.__getitem__)
    return found, [grounds[k] for k in levels], [rank[k] for k in levels]


def _order(place: FoundPlace) -> tuple[bool, float, bool, _Point, tuple[int, ...]]:
    return place.kind != "ground", round(place.height, 3), place.grid is None, place.box[0], place.parts


def _grounds(
    parts: Parts, labels: Sequence[Label | None], ways: Sequence[WayUp], zero: float, low: Floats, high: Floats
) -> list[Ground]:
    """The ground and all levels, of which nothing but the ground is reached yet."""
    room = ground_room(parts, zero, low, high)
    ground = tuple(np.flatnonzero(parts.ground).tolist())
    found = [Ground(zero, ground, None, room, room.largest())]
    for level in level_candidates(parts, labels, zero):
        boxes = parts.properties.aabb[list(level.parts)]
        if not level.sure and not stands_out(parts, labels, level) and not _climbed(level, boxes, ways):
            continue
        room = level_room(parts, level.height, level.parts)
        if room.area >= _LEAST_AREA and room.open.any():
            found.append(Ground(level.height, level.parts, boxes, room, np.zeros_like(room.open)))
    return found


def _climbed(level: Level, boxes: Floats, ways: Sequence[WayUp]) -> bool:
    """Whether a way up ends at a level, and does not hold its parts as treads of its own."""
    return any(way.joins(level.height, boxes) and way.high >= level.height - 0.5 for way in ways)


def _climb(grounds: list[Ground], ways: Sequence[WayUp]) -> list[_Way]:
    """Which ways lead from a level that one gets to up to others; these are reached from then on, in place."""
    joined = {
        n: sorted((k for k, g in enumerate(grounds) if way.joins(g.height, g.boxes)), key=lambda k: grounds[k].height)
        for n, way in enumerate(ways)
    }
    done: dict[int, _Way] = {}
    waiting = True
    while waiting:
        waiting = False
        for n, levels in joined.items():
            if n in done or len(levels) < 2 or not grounds[levels[0]].is_reached:
                continue
            way = _with_landings(ways[n], levels, grounds)
            if way is not None:
                done[n] = way
                waiting = True
    return [done[n] for n in sorted(done)]


def _with_landings(way: WayUp, levels: Sequence[int], grounds: list[Ground]) -> _Way | None:
    """A way with where one stands on each of its levels; None where it can't be got at or leads nowhere."""
    kept: list[int] = []
    squares: list[tuple[int, int]] = []
    for k in levels:
        here = grounds[k]
        own = way.at_height(here.height)[:, :, :2]
        allowed = here.reached if not kept else here.room.open
        square = nearest_square(here.room, allowed, own[:, 0].min(axis=0), own[:, 1].max(axis=0), _TO_LANDING)
        if square is None and not kept:
            return None
        if square is None or (kept and here.height - grounds[kept[0]].height < 0.2):
            continue
        kept.append(k)
        squares.append(square)
        if len(kept) > 1:
            piece = here.room.of_piece(int(here.room.piece[square]))
            grounds[k] = Ground(here.height, here.parts, here.boxes, here.room, here.reached | piece)
    return _Way(way, tuple(kept), tuple(squares)) if len(kept) > 1 else None


def _level_place(ground: Ground, low: Floats, high: Floats, zero: float) -> FoundPlace:
    is_ground = ground.boxes is None
    room, grid = ground.room, ground.room.grid
    if ground.boxes is None:
        corner = np.array([*grid.origin, ground.height])
        box = corner, corner + np.array([grid.size[0] * grid.step, grid.size[1] * grid.step, 0.0])
    else:
        box = ground.boxes[:, 0].min(axis=0), ground.boxes[:, 1].max(axis=0)
    middle = 0.5 * (box[0] + box[1])
    name = (
        "ground"
        if is_ground
        else f"platform {ground.height - zero:+.2f} m ({region_of(low.tolist(), high.tolist(), middle.tolist())})"
    )
    return FoundPlace(
        kind="ground" if is_ground else "platform",
        name=name,
        height=ground.height,
        area=room.area,
        box=(_triple(box[0]), _triple(box[1])),
        parts=ground.parts,
        grid=grid,
        free=ground.reached if ground.is_reached else room.open,
    )


def _way_place(way: _Way, grounds: Sequence[Ground], low: Floats, high: Floats) -> FoundPlace:
    boxes = way.way.boxes
    box = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    base, top = grounds[way.levels[0]], grounds[way.levels[-1]]
    rise = top.height - base.height
    where = region_of(low.tolist(), high.tolist(), (0.5 * (box[0] + box[1])).tolist())
    landings = [
        standing(grounds[k].room.grid, grounds[k].height, square)
        for k, square in zip(way.levels, way.squares, strict=True)
    ]
    return FoundPlace(
        kind=way.way.kind,
        name=f"{way.way.kind} up {rise:.2f} m ({where})",
        height=top.height,
        low=base.height,
        box=(_triple(box[0]), _triple(box[1])),
        parts=way.way.parts,
        landings=tuple(landings),
    )


def standing(grid: Grid, height: float, square: tuple[int, int]) -> _Point:
    """The middle of a square of a floor."""
    row, column = square
    return (
        grid.origin[0] + grid.step * (column + 0.5),
        grid.origin[1] + grid.step * (row + 0.5),
        height,
    )


def _triple(values: Floats) -> _Point:
    x, y, z = values.tolist()
    return x, y, z


def _named_apart(places: Sequence[FoundPlace]) -> list[FoundPlace]:
    """The places with numbers behind names that several have."""
    names = [place.name for place in places]
    met: dict[str, int] = {}
    found = []
    for place in places:
        met[place.name] = met.get(place.name, 0) + 1
        again = names.count(place.name) > 1
        found.append(FoundPlace(**{**vars(place), "name": f"{place.name} {met[place.name]}"}) if again else place)
    return found
