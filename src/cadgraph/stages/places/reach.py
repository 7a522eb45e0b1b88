"""How people get at each unit: where they stand, how high it is for them, and from where they read it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.labels import Label
from cadgraph.model.parts import Parts, UnitParts
from cadgraph.model.places import Reach, UnitAccess
from cadgraph.model.scene import Floats
from cadgraph.stages.places.face import Face, face_of
from cadgraph.stages.places.room import nearest_square
from cadgraph.stages.places.sight import is_clear
from cadgraph.stages.places.site import Ground, standing

__all__ = ["find_access"]

REACH = 2.0  # m over the floor that a hand, or an eye that reads, gets to
_ARM = 0.9  # m in plan from where one stands to what one works at
_CHEST = 1.2  # m; where one works at something that has no operator
_LOWEST = -0.05  # m; what lies deeper than this below a floor isn't got at from it
_OPERATORS = ("handwheel", "lever", "gearbox", "actuator")  # of a valve, the surest first
_EYE = (1.2, 1.7)  # m over the floor, of one who bends and one who stands
_READABLE = 3.0  # m over the floor up to which a dial is still read from below
_TURNS = (0.0, 20.0, -20.0, 40.0, -40.0, 60.0, -60.0)  # degrees off the axis of a dial from which it is read
_AWAY = (0.8, 0.6, 1.0, 1.3)  # m from a dial to the eye, in plan
_SURE = 0.6  # a face of less probability may as well look the other way
_Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class _Target:
    """What one works at or reads: its box ``(2, 3)``, and the face of a gauge."""

    box: Floats
    operated: bool
    face: Face | None = None

    def height(self, floor: float) -> float:
        """Of what one works at, over a floor [m]."""
        low, high = float(self.box[0, 2]), float(self.box[1, 2])
        if self.face is not None:
            return float(self.face.point[2]) - floor
        if self.operated:
            return 0.5 * (low + high) - floor
        return min(max(floor + _CHEST, low), high) - floor


@dataclass(frozen=True, eq=False)
class _Look:
    """A way to look at a face: standing on a square of a level, along a line."""

    unit: int
    side: int
    level: int
    square: tuple[int, int]
    start: Floats
    eye: Floats


def find_access(
    units: Sequence[UnitParts], parts: Parts, labels: Sequence[Label | None], levels: Sequence[Ground],
    places: Sequence[int],
) -> tuple[UnitAccess, ...]:  # fmt: skip
    """How people get at units.

    Args:
        units: of the network.
        parts: of the scene.
        labels: of each part.
        levels: with the squares that one gets to, the ground first.
        places: of each level, the number of its place.
    """
    targets = [_target(unit, parts, labels) for unit in units]
    looks = [look for number, target in enumerate(targets) for look in _looks(number, target, levels)]
    starts, eyes = (np.array([getattr(look, end) for look in looks]).reshape(-1, 3) for end in ("start", "eye"))
    clear = is_clear(parts, starts, eyes)
    seen: dict[int, list[_Look]] = {}
    for look, free in zip(looks, clear.tolist(), strict=True):
        if free:
            seen.setdefault(look.unit, []).append(look)
    return tuple(_access(target, seen.get(number, []), levels, places) for number, target in enumerate(targets))


def _target(unit: UnitParts, parts: Parts, labels: Sequence[Label | None]) -> _Target:
    boxes = parts.properties.aabb
    members = list(unit.parts)
    box = np.array([boxes[members, 0].min(axis=0), boxes[members, 1].max(axis=0)])
    if unit.unit_type == "gauge":
        return _Target(box, True, face_of(unit, parts, labels))
    if unit.unit_type != "valve":
        return _Target(box, False)
    for name in _OPERATORS:
        found = [part for part in members if (label := labels[part]) is not None and label.name == name]
        if found:
            return _Target(np.array([boxes[found, 0].min(axis=0), boxes[found, 1].max(axis=0)]), True)
    return _Target(_end_of_stem(unit, box), True)


def _end_of_stem(unit: UnitParts, box: Floats) -> Floats:
    """The box of what sticks out farthest from the line through a valve: its operator, where no part is named so."""
    if not unit.openings:
        return box
    line = np.mean([opening.point for opening in unit.openings], axis=0)
    reach = np.array([line - box[0], box[1] - line])  # towards least and greatest x, y, z
    flow = np.ptp(np.array([opening.point for opening in unit.openings]), axis=0)
    if flow.max() > 0:
        reach[:, int(np.argmax(flow))] = -np.inf
    end, axis = divmod(int(np.argmax(np.round(reach, 6))), 3)
    found = box.copy()
    # The outer fifth of it.
    found[1 - end, axis] = box[end, axis] + (0.2 if end == 0 else -0.2) * (box[1, axis] - box[0, axis])
    return found


def _levels_at(target: _Target, levels: Sequence[Ground], highest: float) -> list[int]:
    """The levels that one gets to from which a target is not too high, the ground first."""
    found = []
    for k, level in enumerate(levels):
        grid, room = level.room.grid, _ARM + 1.0
        low, high = np.array(grid.origin) - room, np.array(grid.origin) + np.array(grid.size) * grid.step + room
        near = (target.box[0, :2] <= high).all() and (target.box[1, :2] >= low).all()
        if near and level.is_reached and _LOWEST <= target.height(level.height) <= highest:
            found.append(k)
    return found


def _looks(number: int, target: _Target, levels: Sequence[Ground]) -> list[_Look]:
    """The ways to look at the face of a gauge, the best first."""
    if target.face is None or not target.face.sides:
        return []
    found = []
    sides = target.face.sides if target.face.sides[0][1] < _SURE else target.face.sides[:1]
    for k in _levels_at(target, levels, _READABLE):
        level = levels[k]
        for side, (direction, _) in enumerate(sides):
            start = target.face.point + 0.02 * direction
            for spot in _spots(target.face.point, direction):
                column, row = level.room.grid.square_of(spot)[0].tolist()
                rows, columns = level.reached.shape
                if not (0 <= row < rows and 0 <= column < columns and level.reached[row, column]):
                    continue
                x, y, z = standing(level.room.grid, level.height, (row, column))
                rise = min(max(float(target.face.point[2]) - z, _EYE[0]), _EYE[1])
                found.append(_Look(number, side, k, (row, column), start, np.array([x, y, z + rise])))
    return found


def _spots(point: Floats, direction: Floats) -> Floats:
    """Where to stand before a face, ``(n, 2)``, the best first; all round it where it looks up or down."""
    level = float(np.hypot(direction[0], direction[1]))
    if level < 0.3:
        turns = np.radians(np.arange(0.0, 360.0, 45.0))
        return np.array(
            [point[:2] + away * np.array([np.cos(t), np.sin(t)]) for away in (0.4, 0.6, 0.8) for t in turns]
        )
    heading = float(np.arctan2(direction[1], direction[0]))
    turns = heading + np.radians(_TURNS)
    return np.array([point[:2] + away * np.array([np.cos(t), np.sin(t)]) for t in turns for away in _AWAY])


def _access(target: _Target, seen: Sequence[_Look], levels: Sequence[Ground], places: Sequence[int]) -> UnitAccess:
    facing, sure = _facing(target, seen)
    near = _levels_at(target, levels, REACH)
    for look in seen:
        if look.level in near:
            return _stood(target, levels, places, look.level, look.square, facing, sure, look)
    for k in near:
        level = levels[k]
        square = nearest_square(level.room, level.reached, target.box[0, :2], target.box[1, :2], _ARM)
        if square is not None:
            return _stood(target, levels, places, k, square, facing, sure, None)
    # Out of reach: told from the highest level below it, at the least from the ground.
    from_afar = seen[0] if seen else None
    below = from_afar.level if from_afar is not None else _below(target, levels)
    square = from_afar.square if from_afar is not None else None
    told = _stood(target, levels, places, below, square, facing, sure, from_afar)
    return UnitAccess(**{**vars(told), "reach": "out of reach"})


def _facing(target: _Target, seen: Sequence[_Look]) -> tuple[Floats | None, float | None]:
    """Which way a face looks and how sure that is: where nothing decides, the side that one can stand before."""
    if target.face is None or not target.face.sides:
        return None, None
    side = seen[0].side if seen else 0
    direction, sure = target.face.sides[side]
    return direction, sure


def _below(target: _Target, levels: Sequence[Ground]) -> int:
    under = [k for k in _levels_at(target, levels, np.inf) if k == 0 or _is_over(target, levels[k])]
    return max(under, key=lambda k: levels[k].height, default=0)


def _is_over(target: _Target, level: Ground) -> bool:
    square = nearest_square(level.room, level.reached, target.box[0, :2], target.box[1, :2], _ARM)
    return square is not None


def _stood(
    target: _Target, levels: Sequence[Ground], places: Sequence[int], k: int, square: tuple[int, int] | None,
    facing: Floats | None, sure: float | None, look: _Look | None,
) -> UnitAccess:  # fmt: skip
    level, face = levels[k], target.face if facing is not None else None
    reach: Reach = "floor" if level.boxes is None else "platform"
    return UnitAccess(
        place=places[k],
        stand=None if square is None else standing(level.room.grid, level.height, square),
        height=target.height(level.height),
        reach=reach,
        facing=None if facing is None else _triple(facing),
        facing_confidence=sure,
        viewpoint=None if look is None else _triple(look.eye),
        face=None if face is None else _triple(face.point),
        face_radius=None if face is None else face.radius,
    )


def _triple(values: Floats) -> _Point:
    x, y, z = values.tolist()
    return x, y, z
