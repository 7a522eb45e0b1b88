"""Parts that need only one question: of one shape, in one role."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.model.parts import Parts

__all__ = ["QuestionGroup", "find_question_groups"]

_SLENDER = 2.0  # from this ratio of the two longest extents on, a part has a long axis that can stand or lie
_UPRIGHT, _LEVEL = math.cos(math.radians(20)), math.cos(math.radians(70))
_COLOR_STEPS = 15  # of a channel: two paints that differ by less look alike


@dataclass(frozen=True)
class QuestionGroup:
    """Parts of the same shape, attitude and colour.

    The same bar is a column where it stands and a beam where it lies; the same ring is a nozzle's flange in the paint
    of a tank and a line's in that of the line.

    Args:
        parts: indices, ascending.
    """

    parts: tuple[int, ...]

    def members(self, count: int) -> tuple[int, ...]:
        """Up to ``count`` of the parts, spread evenly over all."""
        n = len(self.parts)
        count = min(count, n)
        places = {round(i * (n - 1) / max(count - 1, 1)) for i in range(count)}
        return tuple(self.parts[place] for place in sorted(places))


def find_question_groups(parts: Parts, per: Literal["shape", "part"] = "shape") -> tuple[QuestionGroup, ...]:
    """Groups parts by what one question can settle.

    Args:
        parts: with their shapes.
        per: ``"part"`` makes every part a kind of its own, as the paper asks.

    Returns:
        Every part with a triangle in exactly one, by their first parts.
    """
    drawn = np.diff(parts.scene.face_offsets) > 0
    if per == "part":
        return tuple(QuestionGroup((i,)) for i in range(parts.n_parts) if drawn[i])
    extents, axes = parts.properties.obb_extents, parts.properties.obb_axes
    steep = np.abs(axes[:, 0, 2])
    attitude = np.where(steep > _UPRIGHT, 1, np.where(steep < _LEVEL, 2, 3))
    attitude[~(extents[:, 0] > _SLENDER * extents[:, 1])] = 0
    colors = np.where(np.isfinite(parts.scene.colors), np.round(parts.scene.colors * _COLOR_STEPS), -1).astype(int)
    found: dict[tuple[int, ...], list[int]] = {}
    for i in range(parts.n_parts):
        if drawn[i]:
            found.setdefault((int(parts.shape[i]), int(attitude[i]), *colors[i].tolist()), []).append(i)
    return tuple(QuestionGroup(tuple(members)) for members in found.values())
