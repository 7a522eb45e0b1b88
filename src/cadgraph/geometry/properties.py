"""Area, volume, centroid, boxes and inertia of every mesh of a scene, in one pass."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.box import fit_box
from cadgraph.geometry.parallel import compiled, for_ranges
from cadgraph.parts import Bools, Properties
from cadgraph.scene import Faces, Floats, Ints, Scene

__all__ = ["DEGENERATE_RATIO", "measure"]

# A triangle lower than this share of its longest side has no area. Ours: float32 rounding alone leaves 6e-8, and a
# genuine sliver of 16 m x 1 um still has 6e-8.
DEGENERATE_RATIO = 1e-8

_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)
_SEED = np.uint64(0x9E3779B97F4A7C15)
_S27, _S30, _S31 = np.uint64(27), np.uint64(30), np.uint64(31)
_ZERO = np.uint64(0)


def measure(scene: Scene, workers: int | None = None) -> Properties:
    """Measures all meshes.

    Faces that refer to a vertex that isn't there or isn't finite are left out and counted. A mesh without area has
    the mean of its vertices as centroid; one without a finite vertex has NaN positions, zero extents and the
    identity as axes.

    Args:
        scene: of any size, maybe empty.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        One row for each mesh.
    """
    n = scene.n_meshes
    vertices = np.ascontiguousarray(scene.vertices, np.float64)
    faces = np.ascontiguousarray(scene.faces, np.int32)
    v_offsets = np.ascontiguousarray(scene.vertex_offsets, np.int64)
    f_offsets = np.ascontiguousarray(scene.face_offsets, np.int64)
    sums = np.zeros((n, 2))
    closed = np.zeros(n, np.bool_)
    centroid = np.full((n, 3), np.nan)
    aabb = np.full((n, 2, 3), np.nan)
    inertia = np.zeros((n, 3, 3))
    counts = np.zeros((n, 2), np.int64)
    obb_center = np.full((n, 3), np.nan)
    obb_axes = np.tile(np.eye(3), (n, 1, 1))
    obb_extents = np.zeros((n, 3))

    def kernel(first: int, last: int) -> None:
        _measure_range(
            vertices, vertices.view(np.uint64), faces, v_offsets, f_offsets, first, last,
            sums, closed, centroid, aabb, inertia, counts, obb_center, obb_axes, obb_extents,
        )  # fmt: skip

    n_vertices, n_faces = np.diff(v_offsets), np.diff(f_offsets)
    for_ranges(kernel, n_vertices + n_faces, workers)
    return Properties(
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


@compiled
def _measure_range(
    vertices: Floats,
    bits: np.ndarray[tuple[int, ...], np.dtype[np.uint64]],
    faces: Faces,
    v_offsets: Ints,
    f_offsets: Ints,
    first: int,
    last: int,
    sums: Floats,
    closed: Bools,
    centroid: Floats,
    aabb: Floats,
    inertia: Floats,
    counts: Ints,
    obb_center: Floats,
    obb_axes: Floats,
    obb_extents: Floats,
) -> None:
    for i in range(first, last):
        v0, v1, f0, f1 = v_offsets[i], v_offsets[i + 1], f_offsets[i], f_offsets[i + 1]
        points = vertices[v0:v1]
        keys = np.empty(v1 - v0, np.uint64)
        anchor = _key_vertices(points, bits[v0:v1], keys, counts[i])
        if anchor < 0:
            continue
        used = np.zeros(v1 - v0, np.bool_)
        covariance = np.zeros((3, 3))
        balanced = _sum_faces(points, keys, faces[f0:f1], anchor, used, sums[i], centroid[i], covariance, counts[i])
        closed[i] = balanced and sums[i, 0] > 0.0
        if not used.any():
            # Only faces make a surface, but a mesh without any still has a place.
            for k in range(v1 - v0):
                used[k] = keys[k] != _ZERO
        _bound(points, used, sums[i, 0] == 0.0, centroid[i], aabb[i])
        trace = covariance[0, 0] + covariance[1, 1] + covariance[2, 2]
        for r in range(3):
            for c in range(3):
                inertia[i, r, c] = (trace if r == c else 0.0) - covariance[r, c]
        fit_box(points, used, faces[f0:f1], covariance, obb_center[i], obb_axes[i], obb_extents[i])


@compiled
def _mix(x: np.uint64) -> np.uint64:
    """The finaliser of splitmix64: each bit of the input moves each bit of the output."""
    x = (x ^ (x >> _S30)) * _MIX_1
    x = (x ^ (x >> _S27)) * _MIX_2
    return x ^ (x >> _S31)


@compiled
def _key_vertices(
    points: Floats,
    bits: np.ndarray[tuple[int, ...], np.dtype[np.uint64]],
    keys: np.ndarray[tuple[int, ...], np.dtype[np.uint64]],
    counts: Ints,
) -> int:
    """Gives equal positions equal keys, 0 where not finite; returns the first finite vertex or -1."""
    anchor = -1
    for k in range(len(points)):
        if not (np.isfinite(points[k, 0]) and np.isfinite(points[k, 1]) and np.isfinite(points[k, 2])):
            counts[1] += 1
            keys[k] = _ZERO
            continue
        if anchor < 0:
            anchor = k
        key = _SEED
        for c in range(3):
            # -0.0 and 0.0 are one position
            key = _mix(key ^ (bits[k, c] if points[k, c] != 0.0 else _ZERO))
        keys[k] = key if key != _ZERO else _SEED
    return anchor


@compiled
def _edge_key(a: np.uint64, b: np.uint64) -> np.uint64:
    """A number for a directed edge; that of the opposite direction is its negative."""
    if a == b:
        return _ZERO
    if a < b:
        return _mix(_mix(a) ^ b)
    return _ZERO - _mix(_mix(b) ^ a)


@compiled
def _sum_faces(
    points: Floats,
    keys: np.ndarray[tuple[int, ...], np.dtype[np.uint64]],
    faces: Faces,
    anchor: int,
    used: Bools,
    sums: Floats,
    centroid: Floats,
    covariance: Floats,
    counts: Ints,
) -> bool:
    """Adds up area, volume, centroid and second moments; returns whether all edges cancel.

    Positions are taken relative to a vertex of the mesh, so that far-out meshes lose no digits. Second moments of a
    triangle: area / 12 * (sum of p p^T of its corners + s s^T, s the sum of its corners); exact for any triangle.
    The edges cancel where their keys, positive one way and negative the other, sum to 0 modulo 2^64: a false 0 has
    a chance of 5e-20, which is what spares us a table of edges.
    """
    n_vertices = len(points)
    ox, oy, oz = points[anchor, 0], points[anchor, 1], points[anchor, 2]
    area = volume = 0.0
    mx = my = mz = 0.0
    sx = sy = sz = 0.0
    xx = yy = zz = xy = xz = yz = 0.0
    edges = _ZERO
    for f in range(len(faces)):
        i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
        if min(i, j, k) < 0 or max(i, j, k) >= n_vertices:
            counts[0] += 1
            continue
        key_i, key_j, key_k = keys[i], keys[j], keys[k]
        if key_i == _ZERO or key_j == _ZERO or key_k == _ZERO:
            counts[0] += 1
            continue
        used[i] = used[j] = used[k] = True
        edges += _edge_key(key_i, key_j) + _edge_key(key_j, key_k) + _edge_key(key_k, key_i)
        ax, ay, az = points[i, 0] - ox, points[i, 1] - oy, points[i, 2] - oz
        bx, by, bz = points[j, 0] - ox, points[j, 1] - oy, points[j, 2] - oz
        cx, cy, cz = points[k, 0] - ox, points[k, 1] - oy, points[k, 2] - oz
        ux, uy, uz = bx - ax, by - ay, bz - az
        wx, wy, wz = cx - ax, cy - ay, cz - az
        nx, ny, nz = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        double = np.sqrt(nx * nx + ny * ny + nz * nz)
        ex, ey, ez = wx - ux, wy - uy, wz - uz
        longest = max(ux * ux + uy * uy + uz * uz, wx * wx + wy * wy + wz * wz, ex * ex + ey * ey + ez * ez)
        if double <= DEGENERATE_RATIO * longest:
            counts[0] += 1
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
    sums[0] = area
    if area > 0.0:
        gx, gy, gz = mx / (3.0 * area), my / (3.0 * area), mz / (3.0 * area)
        centroid[0], centroid[1], centroid[2] = ox + gx, oy + gy, oz + gz
        sums[1] = (volume - (gx * sx + gy * sy + gz * sz)) / 6.0
        covariance[0, 0] = max(xx / 12.0 - area * gx * gx, 0.0)
        covariance[1, 1] = max(yy / 12.0 - area * gy * gy, 0.0)
        covariance[2, 2] = max(zz / 12.0 - area * gz * gz, 0.0)
        covariance[0, 1] = covariance[1, 0] = xy / 12.0 - area * gx * gy
        covariance[0, 2] = covariance[2, 0] = xz / 12.0 - area * gx * gz
        covariance[1, 2] = covariance[2, 1] = yz / 12.0 - area * gy * gz
    return bool(edges == _ZERO)


@compiled
def _bound(points: Floats, used: Bools, needs_mean: bool, centroid: Floats, aabb: Floats) -> None:
    """The axis-aligned box of the used vertices, and their mean where faces gave no centroid."""
    aabb[0, :] = np.inf
    aabb[1, :] = -np.inf
    n_used = 0
    for k in range(len(points)):
        if used[k]:
            n_used += 1
            for c in range(3):
                aabb[0, c] = min(aabb[0, c], points[k, c])
                aabb[1, c] = max(aabb[1, c], points[k, c])
    if needs_mean:
        for c in range(3):
            shift = 0.0
            for k in range(len(points)):
                if used[k]:
                    shift += points[k, c] - aabb[0, c]
            centroid[c] = aabb[0, c] + shift / n_used
