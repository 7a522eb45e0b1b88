"""Ways up: flights of treads and ladders, and the levels that they join."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.model.labels import Label
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats

__all__ = ["WayUp", "find_ways"]

_TREAD, _LADDER = "stair tread", "ladder"
_BESIDE = 0.25  # m; treads and pieces of a ladder that are closer than this are of one way
_STEP = 0.45  # m; the highest step from a level onto a way or from a way onto a level
_OFF: dict[str, float] = {"stairs": 0.4, "ladder": 1.0}  # m in plan from a way to a level that it leads to
_LEAST_RISE = 0.25  # m


@dataclass(frozen=True)
class WayUp:
    """Parts that one climbs.

    Args:
        kind: what it is.
        parts: ascending.
        boxes: ``(n, 2, 3)`` of them [m].
    """

    kind: Literal["stairs", "ladder"]
    parts: tuple[int, ...]
    boxes: Floats

    @property
    def low(self) -> float:
        """Where it begins [m]."""
        return float(self.boxes[:, 0, 2].min())

    @property
    def high(self) -> float:
        """Where it ends [m]."""
        return float(self.boxes[:, 1, 2].max())

    def at_height(self, height: float) -> Floats:
        """The boxes ``(n, 2, 3)`` of what is a step from a height, or passes it."""
        near = (self.boxes[:, 0, 2] <= height + _STEP) & (self.boxes[:, 1, 2] >= height - _STEP)
        found: Floats = self.boxes[near]
        return found

    def joins(self, height: float, boxes: Floats | None) -> bool:
        """Whether it leads to or from a level.

        Args:
            height: of the level [m].
            boxes: ``(n, 2, 3)`` of the parts that the level is made of [m]; None for the ground, which is everywhere.
        """
        own = self.at_height(height)
        if boxes is None or not len(own):
            return len(own) > 0
        gap = np.maximum(own[:, None, 0, :2] - boxes[None, :, 1, :2], boxes[None, :, 0, :2] - own[:, None, 1, :2])
        away = np.linalg.norm(np.maximum(gap, 0.0), axis=2)
        return bool(away.min() <= _OFF[self.kind])


def find_ways(parts: Parts, labels: Sequence[Label | None]) -> list[WayUp]:
    """All ways up, by their lowest part: what is called a stair tread or a ladder, with what is close to it.

    Args:
        parts: of the scene.
        labels: of each part.
    """
    names = {part: str(label.name) for part, label in enumerate(labels) if label is not None and label.name}
    members = [part for part, name in sorted(names.items()) if name in (_TREAD, _LADDER)]
    boxes = parts.properties.aabb[members]
    pairs = near_boxes(boxes, _BESIDE) if len(members) > 1 else np.zeros((0, 2), np.int64)
    joined = [(members[a], members[b]) for a, b in pairs.tolist()]
    ways = []
    for found in connected_sets(members, joined):
        kind: Literal["stairs", "ladder"] = "ladder" if any(names[part] == _LADDER for part in found) else "stairs"
        way = WayUp(kind, tuple(sorted(found)), parts.properties.aabb[sorted(found)])
        if way.high - way.low >= _LEAST_RISE:
            ways.append(way)
    return ways
