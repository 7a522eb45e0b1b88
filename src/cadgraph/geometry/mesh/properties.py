"""Area, volume, centroid, boxes and inertia of every mesh of a scene, in one pass."""

from __future__ import annotations

from dataclasses import replace
from math import inf, sqrt

import numpy as np

from cadgraph.geometry.kernels.key import NO_KEY, Keys, key_position, mix
from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.geometry.mesh.box import fit_boxes, order_boxes
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Faces, Floats, Ints, MeshArrays, Placement, Scene

__all__ = ["DEGENERATE_RATIO", "measure"]

# A triangle lower than this share of its longest side has no area. Ours: float32 rounding alone leaves 6e-8, and a
# genuine sliver of 16 m x 1 um still has 6e-8.
DEGENERATE_RATIO = 1e-8


def measure(scene: Scene, workers: int | None = None, boxes: bool = True) -> Properties:
    """Measures all meshes.

    Faces that refer to a vertex that isn't there or isn't finite are left out and counted. A mesh without area has
    the mean of its vertices as centroid; one without a finite vertex has NaN positions, zero extents and the
    identity as axes. Shapes that meshes share are measured once.

    Args:
        scene: of any size, maybe empty.
        workers: threads; all processors by default. The outcome does not depend on it.
        boxes: whether to fit oriented boxes, which takes most of the time; without, they are the axis-aligned ones.

    Returns:
        One row for each mesh.
    """
    found, used = _measured(scene.shapes, workers, boxes)
    if scene.placement is None:
        return found
    return _placed(found, scene.shapes, used, scene.placement, workers, boxes)


def _measured(meshes: MeshArrays, workers: int | None, boxes: bool) -> tuple[Properties, Bools]:
    """The properties of meshes as they lie in their arrays, and ``(n_vertices,)`` which vertices make a surface."""
    n = meshes.n
    vertices, faces = readable(meshes.vertices, np.float64), readable(meshes.faces, np.int32)
    v_offsets, f_offsets = readable(meshes.vertex_offsets, np.int64), readable(meshes.face_offsets, np.int64)
    bits = vertices.view(np.uint64)
    sums = np.zeros((n, 2))
    closed = np.zeros(n, np.bool_)
    centroid = np.full((n, 3), np.nan)
    aabb = np.full((n, 2, 3), np.nan)
    counts = np.zeros((n, 2), np.int64)
    origin, size = np.full((n, 3), np.nan), np.zeros(n)
    rows, bounds = np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 2, 3))

    covariance = np.zeros((n, 3, 3))
    used = np.zeros(len(vertices), np.bool_)

    def kernel(first: int, last: int) -> None:
        _sum_meshes(
            vertices, bits, faces, v_offsets, f_offsets, first, last,
            used, sums, closed, centroid, aabb, covariance, counts,
        )  # fmt: skip
        if boxes:
            fit_boxes(vertices, used, faces, v_offsets, f_offsets, covariance, first, last, origin, size, rows, bounds)

    n_vertices, n_faces = np.diff(v_offsets), np.diff(f_offsets)
    for_ranges(kernel, n_vertices + n_faces, workers)
    if not boxes:
        obb_center, obb_axes, obb_extents = _upright_boxes(aabb)
    else:
        obb_center, obb_axes, obb_extents = order_boxes(origin, size, rows, bounds)
    # From second moments to the inertia tensor: the trace on the diagonal, less the moments.
    inertia = 0.0 - covariance
    diagonal = np.arange(3)
    inertia[:, diagonal, diagonal] += (covariance[:, 0, 0] + covariance[:, 1, 1] + covariance[:, 2, 2])[:, None]
    found = Properties(
        area=sums[:, 0].copy(),
        volume=sums[:, 1].copy(),
        closed=closed,
        centroid=centroid,
        aabb=aabb,
        obb_center=obb_center,
        obb_axes=obb_axes,
        obb_extents=obb_extents,
        inertia=inertia,
        n_triangles=n_faces.astype(np.int64),
        n_degenerate=counts[:, 0].copy(),
        n_nonfinite=counts[:, 1].copy(),
    )
    return found, used


def _placed(
    found: Properties, shapes: MeshArrays, used: Bools, placement: Placement, workers: int | None, boxes: bool
) -> Properties:
    """The properties of meshes from those of the shapes that they share."""
    rows, turn, shift = placement.shape, placement.turn, placement.shift
    one = found.select(rows)
    n = len(rows)
    aabb = np.full((n, 2, 3), np.nan)
    vertices, offsets = readable(shapes.vertices, np.float64), readable(shapes.vertex_offsets, np.int64)

    def kernel(first: int, last: int) -> None:
        _bound_meshes(vertices, used, offsets, rows, turn, shift, first, last, aabb)

    for_ranges(kernel, np.diff(offsets)[rows], workers)
    if boxes:
        half = 0.5 * one.obb_extents
        center, axes, extents = order_boxes(
            _moved(one.obb_center, turn, shift), one.obb_extents[:, 0], one.obb_axes @ turn, np.stack([-half, half], 1)
        )
    else:
        center, axes, extents = _upright_boxes(aabb)
    return replace(
        one,
        centroid=_moved(one.centroid, turn, shift),
        aabb=aabb,
        obb_center=center,
        obb_axes=axes,
        obb_extents=extents,
        inertia=turn.transpose(0, 2, 1) @ one.inertia @ turn,
    )


def _moved(points: Floats, turn: Floats, shift: Floats) -> Floats:
    moved: Floats = np.einsum("ni,nik->nk", points, turn) + shift
    return moved


@compiled
def _bound_meshes(
    vertices: Floats,
    used: Bools,
    offsets: Ints,
    rows: Ints,
    turn: Floats,
    shift: Floats,
    first: int,
    last: int,
    aabb: Floats,
) -> None:
    """The least and the greatest corner of a range of placed meshes; NaN where no vertex makes a surface."""
    for i in range(first, last):
        for k in range(3):
            low, high = inf, -inf
            for v in range(offsets[rows[i]], offsets[rows[i] + 1]):
                if used[v]:
                    x = (
                        vertices[v, 0] * turn[i, 0, k]
                        + vertices[v, 1] * turn[i, 1, k]
                        + vertices[v, 2] * turn[i, 2, k]
                        + shift[i, k]
                    )
                    low, high = min(low, x), max(high, x)
            if low <= high:
                aabb[i, 0, k], aabb[i, 1, k] = low, high


def _upright_boxes(aabb: Floats) -> tuple[Floats, Floats, Floats]:
    """Axis-aligned boxes as oriented ones: centres, axes, extents."""
    sides = np.nan_to_num(aabb[:, 1] - aabb[:, 0])
    order = np.argsort(-sides, axis=1, kind="stable")
    axes = np.eye(3)[order]
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return 0.5 * (aabb[:, 0] + aabb[:, 1]), axes, np.take_along_axis(sides, order, axis=1)


@compiled
def _sum_meshes(
    vertices: Floats,
    bits: Keys,
    faces: Faces,
    v_offsets: Ints,
    f_offsets: Ints,
    first: int,
    last: int,
    used: Bools,
    sums: Floats,
    closed: Bools,
    centroid: Floats,
    aabb: Floats,
    covariance: Floats,
    counts: Ints,
) -> None:
    """All but the oriented boxes of a range of meshes; also the second moments, and which vertices make the shape."""
    n_most = 0
    for i in range(first, last):
        n_most = max(n_most, v_offsets[i + 1] - v_offsets[i])
    keys = np.empty(n_most, np.uint64)
    for i in range(first, last):
        v0, v1 = v_offsets[i], v_offsets[i + 1]
        anchor = _key_vertices(vertices, bits, v0, v1, i, keys, counts)
        if anchor < 0:
            continue
        closed[i] = _sum_faces(
            vertices, keys, faces, v0, v1, f_offsets[i], f_offsets[i + 1], anchor, i,
            used, sums, centroid, covariance, counts,
        )  # fmt: skip
        _bound(vertices, keys, v0, v1, i, used, sums[i, 0] == 0.0, centroid, aabb)


@compiled
def _key_vertices(vertices: Floats, bits: Keys, v0: int, v1: int, i: int, keys: Keys, counts: Ints) -> int:
    """Gives equal positions equal keys, 0 where not finite; returns the first finite vertex or -1."""
    anchor = -1
    for v in range(v0, v1):
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        # Of anything that isn't finite the difference from itself is NaN.
        if x - x + (y - y) + (z - z) == 0.0:
            if anchor < 0:
                anchor = v
            keys[v - v0] = key_position(bits[v, 0], bits[v, 1], bits[v, 2])
        else:
            counts[i, 1] += 1
            keys[v - v0] = NO_KEY
    return anchor


@compiled
def _edge_key(a: np.uint64, b: np.uint64) -> np.uint64:
    """A number for a directed edge; that of the opposite direction is its negative."""
    if a == b:
        return NO_KEY
    if a < b:
        return mix(mix(a) ^ b)
    return NO_KEY - mix(mix(b) ^ a)


@compiled
def _sum_faces(
    vertices: Floats,
    keys: Keys,
    faces: Faces,
    v0: int,
    v1: int,
    f0: int,
    f1: int,
    anchor: int,
    mesh: int,
    used: Bools,
    sums: Floats,
    centroid: Floats,
    covariance: Floats,
    counts: Ints,
) -> bool:
    """Adds up area, volume, centroid and second moments; returns whether there is area and all edges cancel.

    Positions are taken relative to a vertex of the mesh, so that far-out meshes lose no digits. Second moments of a
    triangle: area / 12 * (sum of p p^T of its corners + s s^T, s the sum of its corners); exact for any triangle.
    The edges cancel where their keys, positive one way and negative the other, sum to 0 modulo 2^64: a false 0 has
    a chance of 5e-20, which is what spares us a table of edges.
    """
    n_vertices, n_skipped = v1 - v0, 0
    ox, oy, oz = vertices[anchor, 0], vertices[anchor, 1], vertices[anchor, 2]
    area = volume = 0.0
    mx = my = mz = 0.0
    sx = sy = sz = 0.0
    xx = yy = zz = xy = xz = yz = 0.0
    edges = NO_KEY
    for f in range(f0, f1):
        i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
        if i < 0 or j < 0 or k < 0 or i >= n_vertices or j >= n_vertices or k >= n_vertices:
            n_skipped += 1
            continue
        key_i, key_j, key_k = keys[i], keys[j], keys[k]
        if key_i == NO_KEY or key_j == NO_KEY or key_k == NO_KEY:
            n_skipped += 1
            continue
        edges += _edge_key(key_i, key_j) + _edge_key(key_j, key_k) + _edge_key(key_k, key_i)
        i, j, k = v0 + i, v0 + j, v0 + k
        used[i] = used[j] = used[k] = True
        ax, ay, az = vertices[i, 0] - ox, vertices[i, 1] - oy, vertices[i, 2] - oz
        bx, by, bz = vertices[j, 0] - ox, vertices[j, 1] - oy, vertices[j, 2] - oz
        cx, cy, cz = vertices[k, 0] - ox, vertices[k, 1] - oy, vertices[k, 2] - oz
        ux, uy, uz = bx - ax, by - ay, bz - az
        wx, wy, wz = cx - ax, cy - ay, cz - az
        nx, ny, nz = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        double = sqrt(nx * nx + ny * ny + nz * nz)
        ex, ey, ez = wx - ux, wy - uy, wz - uz
        longest = max(ux * ux + uy * uy + uz * uz, wx * wx + wy * wy + wz * wz, ex * ex + ey * ey + ez * ez)
        if double <= DEGENERATE_RATIO * longest:
            n_skipped += 1
        a = 0.5 * double
        tx, ty, tz = ax + bx + cx, ay + by + cy, az + bz + cz
        area += a
        mx += a * tx
        my += a * ty
        mz += a * tz
        sx += nx
        sy += ny
        sz += nz
        volume += ax * nx + ay * ny + az * nz
        xx += a * (ax * ax + bx * bx + cx * cx + tx * tx)
        yy += a * (ay * ay + by * by + cy * cy + ty * ty)
        zz += a * (az * az + bz * bz + cz * cz + tz * tz)
        xy += a * (ax * ay + bx * by + cx * cy + tx * ty)
        xz += a * (ax * az + bx * bz + cx * cz + tx * tz)
        yz += a * (ay * az + by * bz + cy * cz + ty * tz)
    counts[mesh, 0] += n_skipped
    sums[mesh, 0] = area
    if area > 0.0:
        gx, gy, gz = mx / (3.0 * area), my / (3.0 * area), mz / (3.0 * area)
        centroid[mesh, 0], centroid[mesh, 1], centroid[mesh, 2] = ox + gx, oy + gy, oz + gz
        sums[mesh, 1] = (volume - (gx * sx + gy * sy + gz * sz)) / 6.0
        covariance[mesh, 0, 0] = max(xx / 12.0 - area * gx * gx, 0.0)
        covariance[mesh, 1, 1] = max(yy / 12.0 - area * gy * gy, 0.0)
        covariance[mesh, 2, 2] = max(zz / 12.0 - area * gz * gz, 0.0)
        covariance[mesh, 0, 1] = covariance[mesh, 1, 0] = xy / 12.0 - area * gx * gy
        covariance[mesh, 0, 2] = covariance[mesh, 2, 0] = xz / 12.0 - area * gx * gz
        covariance[mesh, 1, 2] = covariance[mesh, 2, 1] = yz / 12.0 - area * gy * gz
    return area > 0.0 and edges == NO_KEY


@compiled
def _bound(
    vertices: Floats,
    keys: Keys,
    v0: int,
    v1: int,
    mesh: int,
    used: Bools,
    needs_mean: bool,
    centroid: Floats,
    aabb: Floats,
) -> None:
    """The axis-aligned box of the used vertices, and their mean where faces gave no centroid."""
    n_used = 0
    for v in range(v0, v1):
        n_used += used[v]
    if n_used == 0:
        # Only faces make a surface, but a mesh without any still has a place.
        for v in range(v0, v1):
            used[v] = keys[v - v0] != NO_KEY
            n_used += used[v]
    for c in range(3):
        low, high = inf, -inf
        for v in range(v0, v1):
            if used[v]:
                low, high = min(low, vertices[v, c]), max(high, vertices[v, c])
        aabb[mesh, 0, c], aabb[mesh, 1, c] = low, high
        if needs_mean:
            shift = 0.0
            for v in range(v0, v1):
                if used[v]:
                    shift += vertices[v, c] - low
            centroid[mesh, c] = low + shift / n_used
