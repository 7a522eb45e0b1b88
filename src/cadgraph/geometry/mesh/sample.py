"""Points spread evenly over surfaces: what a shape looks like, whatever its triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats, Ints

__all__ = ["Samples", "spread_points"]

# The golden ratio's relatives: successive multiples spread evenly over the unit square (R2 sequence, Roberts 2018).
_STEP = (0.7548776662466927, 0.5698402909980532)


@dataclass(frozen=True)
class Samples:
    """Points on meshes, the same number on each.

    Args:
        points: ``(n_meshes, n, 3)`` [m].
        normals: ``(n_meshes, n, 3)`` unit; of either sense where a mesh is not closed.
    """

    points: Floats
    normals: Floats


def spread_points(triangles: Floats, offsets: Ints, count: int, seed: float = 0.5) -> Samples:
    """Spreads points over sets of triangles in proportion to area, without chance.

    Args:
        triangles: ``(n_triangles, 3, 3)`` corners [m].
        offsets: ``(n_sets + 1,)``; set ``i`` owns ``triangles[offsets[i]:offsets[i + 1]]``.
        count: points on each set.
        seed: where in the unit square the sequence starts; of one that starts in the corner, at 0, the first point is
            left out.

    Returns:
        Their points; all at the origin, with a normal of zero, where a set has no area. A triangle with a corner that
        isn't finite has none.
    """
    n = len(offsets) - 1
    if not n or not count or not len(triangles):
        return Samples(np.zeros((n, count, 3)), np.zeros((n, count, 3)))
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    double = np.where(np.isfinite(double), double, 0.0)
    owner = np.repeat(np.arange(n), np.diff(offsets))
    total = np.bincount(owner, weights=double, minlength=n)
    # A running sum in which every mesh takes one unit keeps the resolution that one over the whole scene would lose.
    share = double / np.where(total > 0, total, 1.0)[owner]
    running = np.cumsum(share)
    before = np.concatenate([[0.0], running])[offsets[:-1]]
    within = running - before[owner] + owner
    wanted = (np.arange(n)[:, None] + (np.arange(count) + 0.5) / count).reshape(-1)
    first, last = np.repeat(offsets[:-1], count), np.repeat(offsets[1:] - 1, count)
    face = np.clip(np.searchsorted(within, wanted), first, np.maximum(last, first))
    some = np.repeat(total > 0, count)
    face = np.where(some, face, 0)
    k = np.tile(np.arange(count) + (seed == 0), n)
    u, v = (seed + k * _STEP[0]) % 1.0, (seed + k * _STEP[1]) % 1.0
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    corners = triangles[face]
    points = corners[:, 0] + u[:, None] * (corners[:, 1] - corners[:, 0]) + v[:, None] * (corners[:, 2] - corners[:, 0])
    normals = cross[face] / np.maximum(double[face], 1e-300)[:, None]
    points[~some], normals[~some] = 0.0, 0.0
    return Samples(points.reshape(n, count, 3), normals.reshape(n, count, 3))
