"""Where a line along an axis goes through triangles."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats

__all__ = ["hits", "in_frame"]


def in_frame(triangles: Floats, point: Floats, axis: Floats) -> Floats:
    """Triangles in a frame with its origin at a point and its third axis along a direction.

    Args:
        triangles: ``(n, 3, 3)`` corners [m].
        point: ``(3,)`` [m].
        axis: ``(3,)`` unit vector.
    """
    across = np.linalg.svd(axis[None])[2][1:]
    found: Floats = (triangles - point) @ np.vstack([across, axis]).T
    return found


def hits(corners: Floats, place: Floats) -> Floats:
    """``(k,)`` the heights at which a line along the third axis goes through triangles [m].

    Args:
        corners: ``(n, 3, 3)`` of the triangles [m].
        place: ``(2,)`` where the line stands across that axis [m].
    """
    a, b, c = (corners[:, k, :2] for k in range(3))
    u, v, w = b - a, c - a, place - a
    twice = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    flat = np.abs(twice) <= 1e-15
    twice = np.where(flat, 1.0, twice)
    s = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / twice
    t = (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / twice
    hit = ~flat & (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9)
    z = corners[:, :, 2]
    found: Floats = (z[:, 0] + s * (z[:, 1] - z[:, 0]) + t * (z[:, 2] - z[:, 0]))[hit]
    return found
