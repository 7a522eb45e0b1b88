"""Levels that one can stand on: gratings, decks and plates that lie side by side at one height."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.model.labels import Label
from cadgraph.model.parts import Bools, Parts
from cadgraph.model.scene import Floats

__all__ = ["Level", "ground_height", "level_candidates", "plan_box", "stands_out"]

_FLOORS = ("grating", "platform")  # names of what is made to be walked on
_MAYBE = ("plate",)  # ... and of what may be
_RAILS = ("railing",)
_SAME_HEIGHT, _SAME_PLACE = 0.05, 0.15  # m; what differs less in height and lies closer together is one level
_LEAST_AREA, _LEAST_WIDTH = 0.25, 0.3  # m2 and m that a level has at least
_LEAST_HEIGHT = 0.3  # m over the ground; below it is a curb or the deck of a skid
_FLAT = 0.06  # m; a plate or an unnamed part that is thicker is no floor
_LEVEL = 0.98  # least upright share of the normal of what is walked on: 11 degrees
_BIN = 0.01  # m; heights of surfaces are counted in steps of this
_RAIL_NEAR, _RAIL_HIGH = 0.3, 0.8  # m; a railing stands this near to its floor, and reaches this high over it


@dataclass(frozen=True)
class Level:
    """Parts whose upper sides make one floor.

    Args:
        height: of the floor [m].
        parts: ascending.
        sure: whether some of them are named so that they must be one; else a railing or a way up has to show it.
    """

    height: float
    parts: tuple[int, ...]
    sure: bool


def ground_height(parts: Parts) -> float:
    """The height that people walk on where no platform is: of the widest ground part, else the least one [m]."""
    boxes = parts.properties.aabb
    ground = np.flatnonzero(parts.ground)
    if len(ground):
        spread = np.prod(boxes[ground, 1, :2] - boxes[ground, 0, :2], axis=1)
        return float(boxes[ground[np.argmax(spread)], 1, 2])
    return float(np.nanmin(boxes[:, 0, 2])) if parts.n_parts else 0.0


def plan_box(parts: Parts) -> tuple[Floats, Floats]:
    """The least and the greatest corner of all that is not the ground, else of everything [m]."""
    boxes = parts.properties.aabb
    boxes = boxes[~parts.ground] if not parts.ground.all() else boxes
    if not len(boxes):
        return np.zeros(3), np.zeros(3)
    return np.nanmin(boxes[:, 0], axis=0), np.nanmax(boxes[:, 1], axis=0)


def level_candidates(parts: Parts, labels: Sequence[Label | None], ground: float) -> list[Level]:
    """What may be a level, by height.

    Args:
        parts: of the scene.
        labels: of each part.
        ground: the height of the ground [m].
    """
    heights: dict[int, float] = {}
    named: set[int] = set()
    flat = _flat(parts)
    for part, label in enumerate(labels):
        if parts.ground[part]:
            continue
        name = label.name if label is not None else None
        if name in _FLOORS:
            height = float(parts.properties.aabb[part, 1, 2]) if flat[part] else _surface(parts, part)
            named.add(part)
        elif flat[part] and (name in _MAYBE or label is None):
            height = float(parts.properties.aabb[part, 1, 2])
        else:
            continue
        if height is not None and height - ground > _LEAST_HEIGHT:
            heights[part] = height
    return [level for level in _merged(parts, heights, named) if _wide_enough(parts, level)]


def _flat(parts: Parts) -> Bools:
    """``(n_parts,)`` which lie level, are thin, and are wide enough to stand on."""
    size = np.diff(parts.properties.aabb, axis=1)[:, 0]
    found: Bools = (
        (size[:, 2] <= _FLAT)
        & (size[:, :2].min(axis=1) >= _LEAST_WIDTH)
        & (np.prod(size[:, :2], axis=1) >= _LEAST_AREA)
    )
    return found


def _surface(parts: Parts, part: int) -> float | None:
    """The height at which most of a part's surface lies level; None where none does [m]."""
    vertices, faces = parts.scene.mesh(part)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    double = np.linalg.norm(normals, axis=1)
    level = np.abs(normals[:, 2]) >= _LEVEL * double
    level &= double > 0
    if not level.any():
        return None
    bins = np.round(a[level, 2] / _BIN).astype(np.int64)
    rows, row = np.unique(bins, return_inverse=True)
    areas = np.bincount(row, 0.5 * double[level])
    # A floor has an upper and a lower side; people stand on the upper one.
    most = np.flatnonzero(areas >= 0.7 * areas.max())
    best = max(k for k in most if rows[k] - rows[np.argmax(areas)] <= _FLAT / _BIN)
    return float(rows[best] * _BIN) if areas[best] >= 0.5 * _LEAST_AREA else None


def _merged(parts: Parts, heights: Mapping[int, float], named: set[int]) -> list[Level]:
    members = sorted(heights)
    boxes = parts.properties.aabb[members].copy()
    boxes[:, :, 2] = np.array([heights[part] for part in members])[:, None]
    pairs = near_boxes(boxes, _SAME_PLACE) if len(members) else np.zeros((0, 2), np.int64)
    joined = [
        (members[a], members[b])
        for a, b in pairs.tolist()
        if abs(heights[members[a]] - heights[members[b]]) <= _SAME_HEIGHT
    ]
    levels = [
        Level(max(heights[part] for part in found), tuple(sorted(found)), not named.isdisjoint(found))
        for found in connected_sets(members, joined)
    ]
    return sorted(levels, key=lambda level: (level.height, level.parts))


def _wide_enough(parts: Parts, level: Level) -> bool:
    boxes = parts.properties.aabb[list(level.parts)]
    low, high = boxes[:, 0, :2].min(axis=0), boxes[:, 1, :2].max(axis=0)
    area = np.prod(boxes[:, 1, :2] - boxes[:, 0, :2], axis=1).sum()
    return bool((high - low).min() >= _LEAST_WIDTH and area >= _LEAST_AREA)


def stands_out(parts: Parts, labels: Sequence[Label | None], level: Level) -> bool:
    """Whether a railing along a level shows that it is one."""
    boxes = parts.properties.aabb
    rails = [part for part, label in enumerate(labels) if label is not None and label.name in _RAILS]
    if not rails:
        return False
    own = boxes[list(level.parts)]
    low, high = own[:, 0, :2].min(axis=0) - _RAIL_NEAR, own[:, 1, :2].max(axis=0) + _RAIL_NEAR
    at = boxes[rails]
    over = at[:, 1, 2] - level.height
    beside = ((at[:, 0, :2] <= high) & (at[:, 1, :2] >= low)).all(axis=1)
    return bool((beside & (over >= _RAIL_HIGH) & (over <= 2 * _RAIL_HIGH)).any())
