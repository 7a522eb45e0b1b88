"""Whether an eye sees a point: nothing of the plant is in between."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.visibility.clear import clear_between
from cadgraph.model.derived import store_of
from cadgraph.model.parts import Bools, Parts
from cadgraph.model.scene import Floats

__all__ = ["is_clear"]


def is_clear(parts: Parts, starts: Floats, ends: Floats) -> Bools:
    """Which straight lines meet nothing.

    Args:
        parts: of the scene.
        starts: ``(n, 3)`` [m].
        ends: ``(n, 3)`` [m].

    Returns:
        ``(n,)``.
    """
    if not len(starts):
        return np.zeros(0, np.bool_)
    boxes = parts.properties.aabb
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    near = np.zeros(parts.n_parts, np.bool_)
    # Lines come in bundles; the boxes of some hundred at a time are compared with those of all parts.
    for first in range(0, len(low), 256):
        some = slice(first, first + 256)
        least, most = low[some].min(axis=0), high[some].max(axis=0)
        near |= ((boxes[:, 0] <= most) & (boxes[:, 1] >= least)).all(axis=1)
    kept = store_of(parts, "lines of sight")
    key = near.tobytes(), starts.tobytes(), ends.tobytes()
    if key not in kept:
        kept.clear()
        kept[key] = clear_between(parts.scene, np.flatnonzero(near), starts, ends)
    found: Bools = kept[key]
    return found
