"""Kernels that ask whether points on meshes can be seen from far away, and points from each other.

The trees over the faces of each mesh are those of the contact search, and a tree over the boxes of the meshes stands
above them. What stopped one ray is asked first about the next, since that mostly stops it too.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.broad import BoxTrees
from cadgraph.geometry.contact.side import Nodes, Placed
from cadgraph.geometry.contact.walk import DEPTH
from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF, first_face
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["are_blocked", "count_seen"]

# The golden ratio's relatives: successive multiples spread evenly over the unit square (R2 sequence, Roberts 2018).
_STEP_U, _STEP_V = 0.7548776662466927, 0.5698402909980532
_SLACK = 1e-9  # triangles count as this much larger, in shares of their sides, so that no ray slips through an edge
_LEVEL = 1e-30  # a ray's slope that is less counts as this


@compiled
def count_seen(
    meshes: Placed, tops: BoxTrees, first: int, last: int, n_points: int, directions: Floats, off: float,
    first_only: bool, seen: Ints,
) -> None:  # fmt: skip
    """Counts the points of each mesh from which a ray gets out.

    Args:
        meshes: all meshes.
        tops: trees over their boxes.
        first: mesh to begin with.
        last: mesh to end before.
        n_points: points on each, spread evenly over its area.
        directions: ``(n, 3)`` of the rays, unit.
        off: how far from the surface rays start, on the side that they go to [m].
        first_only: stop at the first such point of a mesh.
        seen: ``(n_meshes,)`` takes the numbers.
    """
    largest = 0
    for mesh in range(first, last):
        largest = max(largest, meshes.counts[mesh])
    running, points, normals = np.empty(largest), np.empty((n_points, 3)), np.empty((n_points, 3))
    stack, below, ray = np.empty(DEPTH, np.int64), np.empty(DEPTH, np.int64), np.empty((4, 3))
    out = np.empty(n_points, np.bool_)
    for mesh in range(first, last):
        seen[mesh] = 0
        if not _spread(
            meshes.vertices, meshes.faces, meshes.vertex_offsets[mesh], meshes.face_offsets[mesh], meshes.counts[mesh],
            running, points, normals,
        ):  # fmt: skip
            continue
        seen[mesh] = _seen_of(meshes, tops, mesh, points, normals, directions, off, first_only, stack, below, ray, out)


@compiled
def are_blocked(
    meshes: Placed, tops: BoxTrees, first: int, last: int, starts: Floats, ends: Floats, spare: float, blocked: Bools
) -> None:
    """Finds out which straight lines between points meet a mesh.

    Args:
        meshes: all meshes.
        tops: trees over their boxes.
        first: line to begin with.
        last: line to end before.
        starts: ``(n, 3)`` [m].
        ends: ``(n, 3)`` [m].
        spare: what is met so close to the end of a line doesn't count [m].
        blocked: ``(n,)`` takes the answers.
    """
    stack, below, ray = np.empty(DEPTH, np.int64), np.empty(DEPTH, np.int64), np.empty((4, 3))
    before = -1
    for i in range(first, last):
        length = 0.0
        for k in range(3):
            ray[0, k], ray[1, k] = starts[i, k], ends[i, k] - starts[i, k]
            length += ray[1, k] * ray[1, k]
        length = np.sqrt(length)
        blocked[i] = False
        if not spare < length < np.inf:
            continue
        for k in range(3):
            ray[1, k] /= length
        if before < 0 or not _stops(meshes, before, ray, length - spare, below):
            before = _in_the_way(meshes, tops, ray, length - spare, stack, below)
        blocked[i] = before >= 0


@compiled
def _seen_of(
    meshes: Placed, tops: BoxTrees, mesh: int, points: Floats, normals: Floats, directions: Floats, off: float,
    first_only: bool, stack: Ints, below: Ints, ray: Floats, out: Bools,
) -> int:  # fmt: skip
    count, before = 0, mesh
    n_points = len(points)
    for p in range(n_points):
        out[p] = False
    # Directions jump around, so that most points are settled by the first few.
    for d in range(len(directions)):
        x, y, z = directions[d, 0], directions[d, 1], directions[d, 2]
        for p in range(n_points):
            if out[p]:
                continue
            facing = normals[p, 0] * x + normals[p, 1] * y + normals[p, 2] * z
            side = off if facing > 0.0 else (-off if facing < 0.0 else 0.0)
            for k in range(3):
                ray[0, k] = points[p, k] + side * normals[p, k]
                ray[1, k] = directions[d, k]
            if before >= 0 and _stops(meshes, before, ray, np.inf, below):
                continue
            if before != mesh and _stops(meshes, mesh, ray, np.inf, below):
                before = mesh
                continue
            stopped_by = _in_the_way(meshes, tops, ray, np.inf, stack, below)
            if stopped_by >= 0:
                before = stopped_by
                continue
            out[p] = True
            count += 1
            if first_only:
                return count
    return count


@compiled
def _spread(
    vertices: Floats, faces: Faces, v0: int, f0: int, n: int, running: Floats, points: Floats, normals: Floats
) -> bool:
    """Spreads points over faces in proportion to area, without chance; False where there is no area."""
    total = 0.0
    for f in range(n):
        ux, uy, uz, wx, wy, wz = _sides(vertices, faces, v0, f0 + f)
        x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        area = np.sqrt(x * x + y * y + z * z)
        total += area if area < np.inf else 0.0
        running[f] = total
    if not 0.0 < total < np.inf:
        return False
    count = len(points)
    f = 0
    for p in range(count):
        wanted = total * (p + 0.5) / count
        while f < n - 1 and running[f] < wanted:
            f += 1
        ux, uy, uz, wx, wy, wz = _sides(vertices, faces, v0, f0 + f)
        x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        length = max(np.sqrt(x * x + y * y + z * z), 1e-300)
        u, v = (0.5 + p * _STEP_U) % 1.0, (0.5 + p * _STEP_V) % 1.0
        if u + v > 1.0:
            u, v = 1.0 - u, 1.0 - v
        a = v0 + faces[f0 + f, 0]
        points[p, 0] = vertices[a, 0] + u * ux + v * wx
        points[p, 1] = vertices[a, 1] + u * uy + v * wy
        points[p, 2] = vertices[a, 2] + u * uz + v * wz
        normals[p, 0], normals[p, 1], normals[p, 2] = x / length, y / length, z / length
    return True


@compiled
def _sides(
    vertices: Floats, faces: Faces, v0: int, face: int
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """Two sides of a face, from its first corner."""
    a, b, c = v0 + faces[face, 0], v0 + faces[face, 1], v0 + faces[face, 2]
    return (
        vertices[b, 0] - vertices[a, 0],
        vertices[b, 1] - vertices[a, 1],
        vertices[b, 2] - vertices[a, 2],
        vertices[c, 0] - vertices[a, 0],
        vertices[c, 1] - vertices[a, 1],
        vertices[c, 2] - vertices[a, 2],
    )


@compiled
def _in_the_way(meshes: Placed, tops: BoxTrees, ray: Floats, reach: float, stack: Ints, below: Ints) -> int:
    """A mesh that a ray meets before its end, or -1."""
    boxes, nodes = borrow(tops.boxes), borrow(tops.nodes)
    sx, sy, sz = _inverse(ray[1, 0]), _inverse(ray[1, 1]), _inverse(ray[1, 2])
    x, y, z = ray[0, 0], ray[0, 1], ray[0, 2]
    for group in range(len(tops.class_offsets) - 1):
        b0, n = tops.class_offsets[group], tops.class_offsets[group + 1] - tops.class_offsets[group]
        base = tops.node_offsets[group]
        if n == 0:
            continue
        n_leaves = (n + LEAF - 1) // LEAF
        stack[0], top = 0, 1
        while top > 0:
            top -= 1
            node = stack[top]
            if _passes_box(nodes, base + node, x, y, z, sx, sy, sz, reach):
                continue
            if node < n_leaves - 1:
                stack[top], stack[top + 1] = 2 * node + 2, 2 * node + 1
                top += 2
                continue
            start = first_face(node, n_leaves)
            for b in range(b0 + start, b0 + min(start + LEAF, n)):
                if _passes_box(boxes, b, x, y, z, sx, sy, sz, reach):
                    continue
                if _stops(meshes, tops.members[b], ray, reach, below):
                    return int(tops.members[b])
    return -1


@compiled
def _inverse(slope: float) -> float:
    return 1.0 / (slope if abs(slope) > _LEVEL else _LEVEL)


@compiled
def _passes_box(
    boxes: Floats, i: int, x: float, y: float, z: float, sx: float, sy: float, sz: float, reach: float
) -> bool:  # fmt: skip
    """Whether a ray meets nothing of a box given by its corners."""
    a, b = (boxes[i, 0, 0] - x) * sx, (boxes[i, 1, 0] - x) * sx
    low, high = min(a, b), max(a, b)
    a, b = (boxes[i, 0, 1] - y) * sy, (boxes[i, 1, 1] - y) * sy
    low, high = max(low, min(a, b)), min(high, max(a, b))
    a, b = (boxes[i, 0, 2] - z) * sz, (boxes[i, 1, 2] - z) * sz
    low, high = max(low, min(a, b)), min(high, max(a, b))
    room = _SLACK * (1.0 + abs(high))
    return bool(low > high + room or high < -room or low > reach + room)


@compiled
def _stops(meshes: Placed, mesh: int, ray: Floats, reach: float, stack: Ints) -> bool:
    """Whether a ray meets a mesh before its end; rows 2 and 3 of the ray are overwritten."""
    nodes, vertices, faces = borrow(meshes.nodes), borrow(meshes.vertices), borrow(meshes.faces)
    n, v0, f0, base = (
        meshes.counts[mesh], meshes.vertex_offsets[mesh], meshes.face_offsets[mesh], meshes.node_offsets[mesh],
    )  # fmt: skip
    n_leaves = (n + LEAF - 1) // LEAF
    x, y, z = ray[0, 0], ray[0, 1], ray[0, 2]
    dx, dy, dz = ray[1, 0], ray[1, 1], ray[1, 2]
    cx, cy, cz = x - meshes.centers[mesh, 0], y - meshes.centers[mesh, 1], z - meshes.centers[mesh, 2]
    ray[2, 0], ray[2, 1], ray[2, 2], ray[3, 0], ray[3, 1], ray[3, 2] = cx, cy, cz, dx, dy, dz
    if not meshes.upright[mesh]:
        for k in range(3):
            ax, ay, az = meshes.axes[mesh, k, 0], meshes.axes[mesh, k, 1], meshes.axes[mesh, k, 2]
            ray[2, k] = ax * cx + ay * cy + az * cz
            ray[3, k] = ax * dx + ay * dy + az * dz
    bx, by, bz = ray[2, 0], ray[2, 1], ray[2, 2]
    sx, sy, sz = _inverse(ray[3, 0]), _inverse(ray[3, 1]), _inverse(ray[3, 2])
    stack[0], top = 0, 1
    while top > 0:
        top -= 1
        node = stack[top]
        if _passes_node(nodes, base + node, bx, by, bz, sx, sy, sz, reach):
            continue
        if node < n_leaves - 1:
            stack[top], stack[top + 1] = 2 * node + 2, 2 * node + 1
            top += 2
            continue
        start = first_face(node, n_leaves)
        for f in range(f0 + start, f0 + min(start + LEAF, n)):
            if _meets(vertices, faces, v0, f, x, y, z, dx, dy, dz, reach):
                return True
    return False


@compiled
def _passes_node(
    nodes: Nodes, i: int, x: float, y: float, z: float, sx: float, sy: float, sz: float, reach: float
) -> bool:  # fmt: skip
    """Whether a ray meets nothing of a box given by its centre and half extents."""
    at, half = (np.float64(nodes[i, 0]) - x) * sx, np.float64(nodes[i, 3]) * abs(sx)
    low, high = at - half, at + half
    at, half = (np.float64(nodes[i, 1]) - y) * sy, np.float64(nodes[i, 4]) * abs(sy)
    low, high = max(low, at - half), min(high, at + half)
    at, half = (np.float64(nodes[i, 2]) - z) * sz, np.float64(nodes[i, 5]) * abs(sz)
    low, high = max(low, at - half), min(high, at + half)
    room = _SLACK * (1.0 + abs(high))
    return bool(low > high + room or high < -room or low > reach + room)


@compiled
def _meets(
    vertices: Floats, faces: Faces, v0: int, face: int, x: float, y: float, z: float, dx: float, dy: float, dz: float,
    reach: float,
) -> bool:  # fmt: skip
    """Whether a ray meets a face before its end, from either side (Moeller and Trumbore 1997)."""
    a = v0 + faces[face, 0]
    ux, uy, uz, vx, vy, vz = _sides(vertices, faces, v0, face)
    hx, hy, hz = dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx
    det = ux * hx + uy * hy + uz * hz
    if det == 0.0:
        return False
    px, py, pz = x - vertices[a, 0], y - vertices[a, 1], z - vertices[a, 2]
    s = (px * hx + py * hy + pz * hz) / det
    if not -_SLACK <= s <= 1.0 + _SLACK:
        return False
    qx, qy, qz = py * uz - pz * uy, pz * ux - px * uz, px * uy - py * ux
    t = (dx * qx + dy * qy + dz * qz) / det
    if not (t >= -_SLACK and s + t <= 1.0 + _SLACK):
        return False
    return bool(0.0 < (vx * qx + vy * qy + vz * qz) / det < reach)
