"""Kernels on rays and surface points of single meshes."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.side import LEAVES, NODE, SIDE, WHOLE, Nodes, Placed, lay_side, load_leaf
from cadgraph.geometry.contact.walk import DEPTH
from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF
from cadgraph.geometry.kernels.triangle import ROW
from cadgraph.geometry.mesh.sample import spread_points
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["enclosure", "sample_points"]


def sample_points(meshes: Placed, first: int, last: int, points: Floats) -> None:
    """Fills points spread evenly over the area of each mesh, the same on every call.

    Args:
        meshes: all meshes.
        first: mesh to begin with.
        last: mesh to end before.
        points: ``(n_meshes, n, 3)`` takes them [m]; NaN where a mesh has no area.
    """
    counts = meshes.counts[first:last]
    offsets = np.concatenate([[0], np.cumsum(counts)])
    rows = np.arange(offsets[-1]) + np.repeat(meshes.face_offsets[first:last] - offsets[:-1], counts)
    corners = meshes.faces[rows] + np.repeat(meshes.vertex_offsets[first:last], counts)[:, None]
    samples = spread_points(meshes.vertices[corners], offsets, points.shape[1])
    has_area = (samples.normals != 0).any(axis=(1, 2), keepdims=True)
    points[first:last] = np.where(has_area, samples.points, np.nan)


@compiled
def _missed(
    nodes: Nodes, node: int, x: float, y: float, z: float, dx: float, dy: float, dz: float
) -> bool:  # fmt: skip
    """Whether a ray, in the box axes, misses a node."""
    low, high = 0.0, np.inf
    for k in range(3):
        start = (x if k == 0 else (y if k == 1 else z)) - nodes[node, k]
        slope = dx if k == 0 else (dy if k == 1 else dz)
        half = np.float64(nodes[node, 3 + k])
        if abs(slope) < 1e-300:
            if abs(start) > half:
                return True
            continue
        a, b = (-half - start) / slope, (half - start) / slope
        low, high = max(low, min(a, b)), min(high, max(a, b))
    return low > high * (1.0 + 1e-12)


@compiled
def _crossings(
    nodes: Nodes, vertices: Floats, faces: Faces, side: Floats, whole: Ints,
    x: float, y: float, z: float, dx: float, dy: float, dz: float, rows: Floats, stack: Ints,
) -> tuple[int, int]:  # fmt: skip
    """How often a ray crosses a mesh, and how much more often outwards than inwards."""
    bx, by, bz = _turn(side, x - side[4, 0], y - side[4, 1], z - side[4, 2])
    ex, ey, ez = _turn(side, dx, dy, dz)
    hits = outwards = 0
    stack[0], top = 0, 1
    while top > 0:
        top -= 1
        node = stack[top]
        if _missed(nodes, whole[NODE] + node, bx, by, bz, ex, ey, ez):
            continue
        if node < whole[LEAVES] - 1:
            stack[top], stack[top + 1] = 2 * node + 2, 2 * node + 1
            top += 2
            continue
        for i in range(load_leaf(vertices, faces, side, whole, node, rows)):
            sense = _crossed(rows, i, x, y, z, dx, dy, dz)
            if sense != 0:
                hits += 1
                outwards += sense
    return hits, outwards


@compiled
def _turn(side: Floats, x: float, y: float, z: float) -> tuple[float, float, float]:
    return (
        side[5, 0] * x + side[5, 1] * y + side[5, 2] * z,
        side[6, 0] * x + side[6, 1] * y + side[6, 2] * z,
        side[7, 0] * x + side[7, 1] * y + side[7, 2] * z,
    )


@compiled
def _crossed(p: Floats, i: int, x: float, y: float, z: float, dx: float, dy: float, dz: float) -> int:
    """1 where a ray leaves through a triangle, -1 where it enters, 0 where it misses (Moeller and Trumbore 1997)."""
    ux, uy, uz = p[i, 3] - p[i, 0], p[i, 4] - p[i, 1], p[i, 5] - p[i, 2]
    vx, vy, vz = p[i, 6] - p[i, 0], p[i, 7] - p[i, 1], p[i, 8] - p[i, 2]
    hx, hy, hz = dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx
    det = ux * hx + uy * hy + uz * hz
    if det == 0.0:
        return 0
    sx, sy, sz = x - p[i, 0], y - p[i, 1], z - p[i, 2]
    s = (sx * hx + sy * hy + sz * hz) / det
    if not 0.0 <= s <= 1.0:
        return 0
    qx, qy, qz = sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux
    t = (dx * qx + dy * qy + dz * qz) / det
    if t < 0.0 or s + t > 1.0:
        return 0
    if not vx * qx + vy * qy + vz * qz > 0.0 and det > 0.0:
        return 0
    if not vx * qx + vy * qy + vz * qz < 0.0 and det < 0.0:
        return 0
    # det is minus the direction along the normal
    return 1 if det < 0.0 else -1


@compiled
def _judge(senses: Ints, n: int) -> tuple[int, int]:
    """The most frequent of the first ``n`` values, and how often it comes."""
    best, most = 0, 0
    for i in range(n):
        count = 0
        for j in range(n):
            if senses[j] == senses[i]:
                count += 1
        if count > most:
            best, most = senses[i], count
    return best, most


@compiled
def _enclosed(
    nodes: Nodes, vertices: Floats, faces: Faces, side: Floats, whole: Ints, points: Floats, mesh: int, origin: Floats,
    directions: Floats, cover: float, least: float, agreement: float, rows: Floats, stack: Ints, senses: Ints,
    result: Floats,
) -> None:  # fmt: skip
    """Judges the points of one mesh against another; see ``enclosure``."""
    nodes, vertices, faces, side, whole = borrow(nodes), borrow(vertices), borrow(faces), borrow(side), borrow(whole)
    points, directions, rows, stack = borrow(points), borrow(directions), borrow(rows), borrow(stack)
    n, n_rays = points.shape[1], len(directions)
    enclosed = within = decided = 0
    for k in range(n):
        # what is left can't make it mostly enclosed any more
        if enclosed + n - k < least * n:
            result[0] = -1.0
            return
        x, y, z = points[mesh, k, 0] - origin[0], points[mesh, k, 1] - origin[1], points[mesh, k, 2] - origin[2]
        missed = 0
        for m in range(n_rays):
            hits, senses[m] = _crossings(
                nodes, vertices, faces, side, whole,
                x, y, z, directions[m, 0], directions[m, 1], directions[m, 2], rows, stack,
            )  # fmt: skip
            if hits == 0:
                missed += 1
                if missed > (1.0 - cover) * n_rays:
                    break
        if missed > (1.0 - cover) * n_rays:
            continue
        enclosed += 1
        sense, count = _judge(senses, n_rays)
        if count >= agreement * n_rays:
            decided += 1
            if sense != 0:
                within += 1
    result[0] = enclosed / n
    result[1] = within / n if decided == enclosed else np.nan


@compiled
def enclosure(
    meshes: Placed, pairs: Ints, first: int, last: int, points: Floats, directions: Floats, cover: float,
    least: float, agreement: float,
) -> Floats:  # fmt: skip
    """How far the points of meshes are enclosed by others.

    Args:
        meshes: all meshes.
        pairs: ``(n, 2)`` inner, outer.
        first: row to begin with.
        last: row to end before.
        points: ``(n_meshes, n_points, 3)`` [m].
        directions: ``(n_rays, 3)`` unit, the same for every point.
        cover: share of rays that must hit the outer mesh for a point to be enclosed.
        least: share of enclosed points below which a pair is left, with a share of -1.
        agreement: share of rays that must agree for a point to count as decided.

    Returns:
        ``(last - first, 2)`` share of points enclosed, and of points within the material; the latter is NaN where the
        rays of an enclosed point don't agree.
    """
    result = np.empty((last - first, 2))
    side, whole, origin = np.zeros(SIDE), np.empty(WHOLE, np.int64), np.empty(3)
    rows, stack, senses = np.empty((LEAF, ROW)), np.empty(DEPTH, np.int64), np.empty(len(directions), np.int64)
    nodes, vertices, faces = meshes.nodes, meshes.vertices, meshes.faces
    for i in range(first, last):
        for k in range(3):
            origin[k] = meshes.centers[pairs[i, 1], k]
        lay_side(meshes, pairs[i, 1], origin, side, whole)
        _enclosed(
            nodes, vertices, faces, side, whole, points, pairs[i, 0], origin, directions, cover, least, agreement,
            rows, stack, senses, result[i - first],
        )  # fmt: skip
    return result
