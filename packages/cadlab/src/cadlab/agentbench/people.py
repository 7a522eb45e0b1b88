"""How people get at units: what is certain, and what a graph says."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Place
from cadgraph.model.scene import Floats
from cadgraph.model.truth import Truth, TruthUnit

__all__ = ["NO_LEVEL", "Reached", "compass", "reach_of_graph", "reach_of_truth"]

_HIGHEST, _ARM = 2.0, 0.9  # m: how high over its floor, and how far beside it, one works at a valve
_CLEAR = 0.15  # m; what is nearer to a limit than this is left open
_ONE_LEVEL = 0.05  # m
_OPERATORS = ("handwheel", "lever")
_FLOORS = ("grating", "deck")
_COMPASS = ("east", "north east", "north", "north west", "west", "south west", "south", "south east")
_OFF = math.radians(10.0)  # a face that is further off the points of the compass is left open

NO_LEVEL = -1.0
"""In place of a height: no level brings one near enough."""


@dataclass(frozen=True)
class Reached:
    """How people get at one unit.

    Args:
        height: of the middle of its handwheel or lever over the ground [m]; None where it has none or nobody knows.
        level: height over the ground of the level that one must climb to [m]; 0 for the ground, ``NO_LEVEL`` where none
            brings one near enough, None where that is not clear.
        facing: point of the compass that its face looks towards; None where it has none or that is not clear.
    """

    height: float | None = None
    level: float | None = None
    facing: str | None = None


def compass(way: Sequence[float]) -> str:
    """The one of eight points of the compass that is nearest to a direction; north is +y."""
    return _COMPASS[round(math.atan2(way[1], way[0]) / (math.pi / 4)) % 8]


def reach_of_truth(truth: Truth, paths: Sequence[str], boxes: Floats) -> dict[str, Reached]:
    """What is certain, by id of the true unit.

    Args:
        truth: of a scene.
        paths: of the meshes of the scene.
        boxes: ``(n_meshes, 2, 3)`` least and greatest corner of each [m].
    """
    row = {path: k for k, path in enumerate(paths)}
    named: dict[str, list[int]] = {}
    for mesh in truth.meshes:
        if mesh.mesh in row:
            named.setdefault(mesh.name or "", []).append(row[mesh.mesh])
    zero = _ground(boxes, named.get("ground", []))
    levels = _levels(boxes, [k for name in _FLOORS for k in named.get(name, ())])
    operators = {k for name in _OPERATORS for k in named.get(name, ())}
    found: dict[str, Reached] = {}
    for unit in truth.units or ():
        members = [row[mesh] for mesh in unit.meshes if mesh in row]
        own = [k for k in members if k in operators] if unit.type == "valve" else []
        if own:
            height = float(boxes[own, 0, 2].min() + boxes[own, 1, 2].max()) / 2
            found[unit.id] = Reached(height - zero, _level(boxes[own], height, zero, levels))
        elif unit.type == "gauge":
            found[unit.id] = Reached(facing=_facing(unit))
    return found


def reach_of_graph(graph: SceneGraph) -> dict[str, Reached]:
    """What a graph says, by id of the unit; empty where it was built without places."""
    places = {place.id: place for place in graph.of_layer(Place)}
    zero = min((place.height for place in places.values() if place.kind == "ground"), default=0.0)
    found: dict[str, Reached] = {}
    for unit in graph.units():
        access = unit.access
        place = places.get(access.place or "") if access is not None else None
        if access is None or place is None:
            continue
        level = NO_LEVEL if access.reach == "out of reach" else place.height - zero
        facing = compass(access.facing) if access.facing is not None else None
        found[unit.id] = Reached(place.height + access.height - zero, level, facing)
    return found


def _ground(boxes: Floats, named: Sequence[int]) -> float:
    """The height of the ground: the top of what is called so, else of what stands lowest."""
    return float(boxes[list(named), 1, 2].max() if named else boxes[:, 0, 2].min())


def _levels(boxes: Floats, floors: Iterable[int]) -> list[tuple[float, Floats]]:
    """Height and boxes ``(n, 2, 3)`` of each level."""
    found: list[tuple[float, list[int]]] = []
    for k in sorted(floors, key=lambda k: float(boxes[k, 1, 2])):
        top = float(boxes[k, 1, 2])
        if found and top - found[-1][0] <= _ONE_LEVEL:
            found[-1][1].append(k)
        else:
            found.append((top, [k]))
    return [(top, boxes[members]) for top, members in found]


def _level(operator: Floats, height: float, zero: float, levels: Sequence[tuple[float, Floats]]) -> float | None:
    """The level from which an operator is worked; None where it isn't clear."""
    if height - zero < _HIGHEST + _CLEAR:
        # Whether there is room to stand on the ground beside it no list of meshes tells.
        return None
    low, high = operator[:, 0, :2].min(axis=0), operator[:, 1, :2].max(axis=0)
    near: list[float] = []
    for top, floors in levels:
        away = min(_apart(low, high, floor[0, :2], floor[1, :2]) for floor in floors)
        over = height - top
        if away > _ARM + _CLEAR + 1.0 or over > _HIGHEST + _CLEAR or over < -_CLEAR:
            continue
        if away > 0.3 or not _CLEAR < over < _HIGHEST - _CLEAR:
            return None
        near.append(top - zero)
    return near[0] if len(near) == 1 else None if near else NO_LEVEL


def _apart(low: Floats, high: Floats, other_low: Floats, other_high: Floats) -> float:
    return float(np.hypot(*np.maximum(0.0, np.maximum(other_low - high, low - other_high))))


def _facing(unit: TruthUnit) -> str | None:
    way = unit.faces
    if way is None or math.hypot(way[0], way[1]) < math.cos(math.radians(30)):
        return None
    angle = math.atan2(way[1], way[0])
    off = abs(angle - round(angle / (math.pi / 4)) * math.pi / 4)
    return compass(way) if off <= _OFF else None
