"""A triangle against the boxes of a tree, by separating axes (Akenine-Moeller 2001, with the limit as margin)."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.side import UPRIGHT, Nodes
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.triangle import lay_normal
from cadgraph.model.scene import Floats, Ints

__all__ = ["is_separated", "lay_axes"]


@compiled
def lay_axes(p: Floats, i: int, side: Floats, whole: Ints, all_axes: Floats) -> None:
    """For a triangle in the box axes of a mesh: the axes that can separate it from a box, with its extent on each.

    Args:
        p: rows.
        i: row.
        side: the mesh.
        whole: the mesh.
        all_axes: ``(n, 11, 6)`` takes in its row ``i`` direction (3), least and greatest position (2) and length (1)
            of the normal and of the nine products of a side and a box axis; the last row is the triangle's own box.
    """
    axes = all_axes[i]
    ax, ay, az = _turned(p, i, 0, side, whole)
    bx, by, bz = _turned(p, i, 3, side, whole)
    cx, cy, cz = _turned(p, i, 6, side, whole)
    lay_normal(p, i)
    x, y, z = p[i, 9], p[i, 10], p[i, 11]
    for k in range(3):
        axes[0, k] = side[5 + k, 0] * x + side[5 + k, 1] * y + side[5 + k, 2] * z
    n = 1
    for edge in range(3):
        if edge == 0:
            x, y, z = bx - ax, by - ay, bz - az
        elif edge == 1:
            x, y, z = cx - bx, cy - by, cz - bz
        else:
            x, y, z = ax - cx, ay - cy, az - cz
        axes[n, 0], axes[n, 1], axes[n, 2] = 0.0, z, -y
        axes[n + 1, 0], axes[n + 1, 1], axes[n + 1, 2] = -z, 0.0, x
        axes[n + 2, 0], axes[n + 2, 1], axes[n + 2, 2] = y, -x, 0.0
        n += 3
    for n in range(10):
        x, y, z = axes[n, 0], axes[n, 1], axes[n, 2]
        a = x * ax + y * ay + z * az
        b = x * bx + y * by + z * bz
        c = x * cx + y * cy + z * cz
        axes[n, 3], axes[n, 4] = min(a, b, c), max(a, b, c)
        axes[n, 5] = np.sqrt(x * x + y * y + z * z)
    axes[10, 0], axes[10, 1], axes[10, 2] = min(ax, bx, cx), min(ay, by, cy), min(az, bz, cz)
    axes[10, 3], axes[10, 4], axes[10, 5] = max(ax, bx, cx), max(ay, by, cy), max(az, bz, cz)


@compiled
def _turned(p: Floats, i: int, corner: int, side: Floats, whole: Ints) -> tuple[float, float, float]:
    """A corner of a row in the box axes of a mesh."""
    x, y, z = p[i, corner] - side[4, 0], p[i, corner + 1] - side[4, 1], p[i, corner + 2] - side[4, 2]
    if whole[UPRIGHT]:
        return x, y, z
    return (
        side[5, 0] * x + side[5, 1] * y + side[5, 2] * z,
        side[6, 0] * x + side[6, 1] * y + side[6, 2] * z,
        side[7, 0] * x + side[7, 1] * y + side[7, 2] * z,
    )


@compiled
def is_separated(axes: Floats, nodes: Nodes, node: int, limit: float) -> bool:
    """Whether an axis shows that a triangle is further than ``limit`` from a box."""
    cx, cy, cz = np.float64(nodes[node, 0]), np.float64(nodes[node, 1]), np.float64(nodes[node, 2])
    hx, hy, hz = np.float64(nodes[node, 3]), np.float64(nodes[node, 4]), np.float64(nodes[node, 5])
    x = max(axes[10, 0] - cx - hx, cx - hx - axes[10, 3], 0.0)
    y = max(axes[10, 1] - cy - hy, cy - hy - axes[10, 4], 0.0)
    z = max(axes[10, 2] - cz - hz, cz - hz - axes[10, 5], 0.0)
    if x * x + y * y + z * z > limit * limit:
        return True
    for n in range(10):
        x, y, z = axes[n, 0], axes[n, 1], axes[n, 2]
        at = x * cx + y * cy + z * cz
        reach = abs(x) * hx + abs(y) * hy + abs(z) * hz + limit * axes[n, 5]
        # rounding of the projections, far above what it can be
        reach += 1e-12 * (abs(at) + abs(axes[n, 3]) + abs(axes[n, 4]))
        if axes[n, 3] - at > reach or at - axes[n, 4] > reach:
            return True
    return False
