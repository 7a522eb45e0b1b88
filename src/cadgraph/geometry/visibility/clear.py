"""Straight lines between points: which of them meet no surface."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.broad import box_trees
from cadgraph.geometry.contact.pairs import plain
from cadgraph.geometry.kernels.parallel import for_ranges, readable
from cadgraph.geometry.kernels.tree import build_forest
from cadgraph.geometry.visibility.occlusion import are_blocked
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["clear_between"]

_END = 1e-3  # m; what is met this close to the end of a line doesn't count


def clear_between(scene: Scene, meshes: Ints, starts: Floats, ends: Floats) -> Bools:
    """Which lines meet no surface.

    Args:
        scene: all meshes.
        meshes: the numbers of those that count.
        starts: ``(n, 3)`` where the lines begin [m].
        ends: ``(n, 3)`` where they end.

    Returns:
        ``(n,)``.
    """
    blocked = np.zeros(len(starts), np.bool_)
    if not len(starts) or not len(meshes):
        return ~blocked
    trees = build_forest(scene.select(meshes))
    known, tops = plain(trees), box_trees(trees.boxes)
    first_ends, last_ends = readable(starts, np.float64), readable(ends, np.float64)
    for_ranges(
        lambda first, last: are_blocked(known, tops, first, last, first_ends, last_ends, _END, blocked),
        np.ones(len(starts), np.int64),
    )
    return ~blocked
