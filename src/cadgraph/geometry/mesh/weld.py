"""Distinct positions of a mesh, each with what any motion leaves as it is: its distance, normal and area around."""

from __future__ import annotations

from math import atan2, floor, nan, sqrt

import numpy as np

from cadgraph.geometry.kernels.key import key_position
from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["weld", "weld_range"]

# Faces lower than so many times the tolerance say nothing about normals.
_MIN_HEIGHT = 30.0
# Positions are looked up in cells so many times the tolerance wide: most lie well within one.
_CELL = 8.0


@compiled
def _weld(
    vertices: Floats, v0: int, n: int, faces: Faces, f0: int, f1: int,
    x0: float, y0: float, z0: float, tolerance: float, spot_of: Ints, table: Ints,
    spots: Floats, normals: Floats, reach: Floats,
) -> int:  # fmt: skip
    """Merges positions of faces that rounding alone keeps apart; describes each by what any motion leaves as it is.

    Args:
        vertices: ``(n_vertices, 3)`` [m].
        v0: the first vertex of the mesh.
        n: how many vertices it has.
        faces: ``(n_faces, 3)`` vertices, counted from the mesh's first.
        f0: the first face of the mesh.
        f1: the end of its faces.
        x0: the centroid [m].
        y0: see ``x0``.
        z0: see ``x0``.
        tolerance: rounding of the positions [m].
        spot_of: ``(m,)`` workspace, at least ``n`` long.
        table: ``(m,)`` workspace, at least ``max(16, 4 n)`` long.
        spots: ``(n_vertices, 3)`` output from row ``v0`` on: distinct positions relative to the centroid [m].
        normals: ``(n_vertices, 3)`` output: their unit normals summed with the corner angles as weights, NaN where a
            face is too small to tell.
        reach: ``(n_vertices, 2)`` output: distance from the centroid [m] and area of the faces around [m2].

    Returns:
        How many distinct positions there are.
    """
    for k in range(n):
        spot_of[k] = -1
    for f in range(f0, f1):
        # A corner that isn't there takes its face out, as in the properties.
        if _is_whole(faces, f, n):
            for c in range(3):
                spot_of[faces[f, c]] = 0
    capacity = 16
    while capacity < 2 * n:
        capacity *= 2
    for slot in range(capacity):
        table[slot] = -1
    end = v0
    for k in range(n):
        if spot_of[k] < 0:
            continue
        x, y, z = vertices[v0 + k, 0] - x0, vertices[v0 + k, 1] - y0, vertices[v0 + k, 2] - z0
        spot = _spot_near(x, y, z, vertices, x0, y0, z0, tolerance, table, capacity)
        if spot < 0:
            table[-1 - spot] = v0 + k
            spot = end
            for c in range(3):
                spots[end, c], normals[end, c] = 0.0, 0.0
            reach[end, 0], reach[end, 1] = 0.0, 0.0
            end += 1
        else:
            spot = spot_of[spot - v0]
        spot_of[k] = spot
        spots[spot, 0] += x
        spots[spot, 1] += y
        spots[spot, 2] += z
        reach[spot, 0] += 1.0
    for spot in range(v0, end):
        # The mean, which no order of the vertices changes.
        for c in range(3):
            spots[spot, c] /= reach[spot, 0]
        reach[spot, 0] = sqrt(spots[spot, 0] ** 2 + spots[spot, 1] ** 2 + spots[spot, 2] ** 2)
    for f in range(f0, f1):
        if _is_whole(faces, f, n):
            _add_corners(vertices, v0, faces, f, spot_of, tolerance, normals, reach)
    return end - v0


@compiled
def _spot_near(
    x: float, y: float, z: float, vertices: Floats, x0: float, y0: float, z0: float, tolerance: float,
    table: Ints, capacity: int,
) -> int:  # fmt: skip
    """The vertex in a table of cells that a position coincides with; else -1 less the slot where it belongs."""
    cell = _CELL * tolerance
    home = -1
    for i in range(floor((x - tolerance) / cell), floor((x + tolerance) / cell) + 1):
        for j in range(floor((y - tolerance) / cell), floor((y + tolerance) / cell) + 1):
            for m in range(floor((z - tolerance) / cell), floor((z + tolerance) / cell) + 1):
                key = key_position(np.uint64(i), np.uint64(j), np.uint64(m))
                slot = int(np.int64(key & np.uint64(capacity - 1)))
                while table[slot] >= 0:
                    other = table[slot]
                    u, v, w = vertices[other, 0] - x0 - x, vertices[other, 1] - y0 - y, vertices[other, 2] - z0 - z
                    if u * u + v * v + w * w <= tolerance * tolerance:
                        return int(other)
                    slot = (slot + 1) & (capacity - 1)
                if i == floor(x / cell) and j == floor(y / cell) and m == floor(z / cell):
                    home = slot
    return -1 - home


@compiled
def weld_range(
    vertices: Floats, faces: Faces, v_offsets: Ints, f_offsets: Ints, centroid: Floats, tolerance: Floats,
    meshes: Ints, low: int, high: int, spots: Floats, normals: Floats, reach: Floats, n_spots: Ints,
) -> None:  # fmt: skip
    """Welds those of a range of meshes, each into rows of its own vertices.

    Args:
        vertices: ``(n_vertices, 3)`` of all meshes [m].
        faces: ``(n_faces, 3)`` vertices, counted from the mesh's first.
        v_offsets: ``(n + 1,)`` where the vertices of each mesh start.
        f_offsets: ``(n + 1,)`` where the faces of each mesh start.
        centroid: ``(n, 3)`` [m].
        tolerance: ``(n,)`` rounding of the positions [m].
        meshes: which ones.
        low: the first of ``meshes``.
        high: the end of the range.
        spots: ``(n_vertices, 3)`` output: distinct positions relative to the centroid [m].
        normals: ``(n_vertices, 3)`` output: their unit normals summed with the corner angles as weights, NaN where a
            face is too small to tell.
        reach: ``(n_vertices, 2)`` output: distance from the centroid [m] and area of the faces around [m2].
        n_spots: ``(n,)`` output: how many distinct positions there are.
    """
    n_most = 4
    for k in range(low, high):
        n_most = max(n_most, v_offsets[meshes[k] + 1] - v_offsets[meshes[k]])
    spot_of, table = np.empty(n_most, np.int64), np.empty(4 * n_most, np.int64)
    for k in range(low, high):
        i = meshes[k]
        v0 = v_offsets[i]
        n_spots[i] = _weld(
            vertices, v0, v_offsets[i + 1] - v0, faces, f_offsets[i], f_offsets[i + 1],
            centroid[i, 0], centroid[i, 1], centroid[i, 2], tolerance[i], spot_of, table, spots, normals, reach,
        )  # fmt: skip


def weld(
    points: Floats, faces: Faces, centroid: Floats, tolerance: float, spots: Floats, normals: Floats, reach: Floats
) -> int:
    """Welds one mesh by itself; see ``weld_range``. Returns how many distinct positions there are."""
    vertices, n_spots = readable(points, np.float64), np.zeros(1, np.int64)
    ends = [readable(np.array([0, len(rows)]), np.int64) for rows in (points, faces)]
    weld_range(
        vertices, readable(faces, np.int32), ends[0], ends[1],
        readable(centroid[None], np.float64), readable(np.array([tolerance]), np.float64),
        np.zeros(1, np.int64), 0, 1, spots, normals, reach, n_spots,
    )  # fmt: skip
    return int(n_spots[0])


@compiled
def _is_whole(faces: Faces, f: int, n: int) -> bool:
    """Whether all corners of a face are among ``n`` vertices."""
    i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
    return bool(i >= 0 and j >= 0 and k >= 0 and i < n and j < n and k < n)


@compiled
def _add_corners(
    vertices: Floats, v0: int, faces: Faces, f: int, spot_of: Ints, tolerance: float, normals: Floats, reach: Floats
) -> None:
    """Adds a face to the normals and areas of its corners."""
    i, j, k = v0 + faces[f, 0], v0 + faces[f, 1], v0 + faces[f, 2]
    x, y, z = vertices[i, 0], vertices[i, 1], vertices[i, 2]
    ux, uy, uz = vertices[j, 0] - x, vertices[j, 1] - y, vertices[j, 2] - z
    wx, wy, wz = vertices[k, 0] - x, vertices[k, 1] - y, vertices[k, 2] - z
    nx, ny, nz = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
    double = sqrt(nx * nx + ny * ny + nz * nz)
    vx, vy, vz = wx - ux, wy - uy, wz - uz
    # Squared sides, each opposite to its corner.
    a, b, c = vx * vx + vy * vy + vz * vz, wx * wx + wy * wy + wz * wz, ux * ux + uy * uy + uz * uz
    longest = sqrt(max(a, b, c))
    if longest == 0.0:
        return
    vague = double <= _MIN_HEIGHT * tolerance * longest
    for corner in range(3):
        spot = spot_of[faces[f, corner]]
        reach[spot, 1] += 0.5 * double
        if vague:
            normals[spot, 0] = nan
        else:
            angle = atan2(double, 0.5 * (b + c - a))
            normals[spot, 0] += angle * nx / double
            normals[spot, 1] += angle * ny / double
            normals[spot, 2] += angle * nz / double
        a, b, c = b, c, a
