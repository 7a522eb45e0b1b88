"""The directions that most of a mesh's area faces."""

from __future__ import annotations

from math import sqrt

from cadgraph.geometry.kernels.parallel import ZERO, compiled
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats

__all__ = ["N_BINS", "bin_normals"]

N_BINS = 12
"""How many directions are told apart."""

# At most so many faces vote on normals; more are sampled evenly.
_MAX_FACES = 4096
# Normals this close (1 - cosine; 1.4e-3 rad) are one: float32 coordinates of small faces scatter as much.
_SAME_NORMAL = 1e-6


@compiled
def _normal(
    vertices: Floats, used: Bools, faces: Faces, face: int, v0: int, n_vertices: int
) -> tuple[float, float, float, float]:
    """The unit normal of a face and twice its area; area 0 where it has none, or a vertex that doesn't count."""
    i, j, k = faces[face, 0], faces[face, 1], faces[face, 2]
    if i < 0 or j < 0 or k < 0 or i >= n_vertices or j >= n_vertices or k >= n_vertices:
        return 0.0, 0.0, 0.0, 0.0
    i, j, k = v0 + i, v0 + j, v0 + k
    if not (used[i] and used[j] and used[k]):
        return 0.0, 0.0, 0.0, 0.0
    x, y, z = vertices[i, 0], vertices[i, 1], vertices[i, 2]
    ux, uy, uz = vertices[j, 0] - x, vertices[j, 1] - y, vertices[j, 2] - z
    wx, wy, wz = vertices[k, 0] - x, vertices[k, 1] - y, vertices[k, 2] - z
    x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
    area = sqrt(x * x + y * y + z * z)
    if not area > 0.0:
        return 0.0, 0.0, 0.0, 0.0
    return x / area, y / area, z / area, area


@compiled
def _bin_of(bins: Floats, n_bins: int, last: int, x: float, y: float, z: float) -> int:
    """The row of a direction, either sense; -1 where there is none.

    Neighbouring faces often share their normal, so the search starts where the last one matched.
    """
    b = last
    for _ in range(n_bins):
        if abs(x * bins[b, 0] + y * bins[b, 1] + z * bins[b, 2]) > 1.0 - _SAME_NORMAL:
            return b
        b += 1
        if b == n_bins:
            b = 0
    return -1


@compiled
def _free_bin(bins: Floats, n_bins: int) -> int:
    """The next row, or where all are taken the one of the least area."""
    if n_bins < N_BINS:
        return int(n_bins)
    least = 0
    for b in range(1, N_BINS):
        if bins[b, 3] < bins[least, 3]:
            least = b
    return least


@compiled
def bin_normals(
    vertices: Floats,
    used: Bools,
    faces: Faces,
    v0: int,
    n_vertices: int,
    f0: int,
    f1: int,
    bins: Floats,
    moments: Floats,
) -> int:
    """Area by direction of normal, either sense: rows of unit normal, area, area of the face that gave the normal.

    When all rows are taken, the least gives way to a greater newcomer.
    """
    xx = yy = zz = xy = xz = yz = 0.0
    n_bins = last = ZERO
    step = max(1, (f1 - f0) // _MAX_FACES)
    for f in range(f0, f1, step):
        x, y, z, area = _normal(vertices, used, faces, f, v0, n_vertices)
        if not area > 0.0:
            continue
        xx += area * x * x
        yy += area * y * y
        zz += area * z * z
        xy += area * x * y
        xz += area * x * z
        yz += area * y * z
        found = _bin_of(bins, n_bins, last, x, y, z)
        if found < 0:
            found = _free_bin(bins, n_bins)
            if found == n_bins:
                n_bins += 1
            elif area <= bins[found, 3]:
                continue
            bins[found, 3] = bins[found, 4] = 0.0
        last = found
        bins[found, 3] += area
        if area > bins[found, 4]:
            bins[found, 0], bins[found, 1], bins[found, 2], bins[found, 4] = x, y, z, area
    moments[0, 0], moments[1, 1], moments[2, 2] = xx, yy, zz
    moments[0, 1] = moments[1, 0] = xy
    moments[0, 2] = moments[2, 0] = xz
    moments[1, 2] = moments[2, 1] = yz
    return int(n_bins)
