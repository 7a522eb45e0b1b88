"""What holds the disc or ball of a valve, and so is its body."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.stages.relate.piping import RelateInput
from cadgraph.stages.relate.role import Roles

__all__ = ["holds_disc"]

# What closes a valve lies within its body, but for so much [m], or this share of it, where the body is in halves.
_CLOSES, _OUT, _HALF = frozenset({"valve disc", "valve ball"}), 0.002, 0.55


def holds_disc(given: RelateInput, roles: Roles, part: int) -> bool:
    """Whether the disc or ball of a valve touches a part and lies within it, or half of it does."""
    boxes = given.parts.properties.aabb
    low, high = boxes[part]
    discs = [other for other in given.neighbors.get(part, ()) if roles.names[other] in _CLOSES]
    return any(
        bool(np.all(boxes[disc].mean(axis=0) >= low - _OUT) and np.all(boxes[disc].mean(axis=0) <= high + _OUT))
        and bool(np.all(_sticks_out(boxes[disc], boxes[part]) <= np.maximum(_HALF * np.ptp(boxes[disc], axis=0), _OUT)))
        for disc in discs
    )


def _sticks_out(inner: Floats, outer: Floats) -> Floats:
    """``(3,)`` by how much a box is outside of another one along each axis [m]."""
    out: Floats = np.maximum(np.maximum(outer[0] - inner[0], inner[1] - outer[1]), 0.0)
    return out
