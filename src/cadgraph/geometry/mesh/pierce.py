"""Where a regular grid of lines pierces a surface: samples that depend on the shape and not on its triangles.

Lines run along the three axes of a mesh's oriented box, as many across each side of the box. By Cauchy's formula for
projected areas, the sum of cell area x |cosine| over the points of all three directions is the surface area; so points
weighted in this way give integrals over the surface. Cutting triangles up, merging coplanar ones or listing them in
another order leaves every point where it was.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cadgraph.geometry.kernels.gather import gather
from cadgraph.geometry.kernels.order import sort_rows
from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["Piercings", "pierce"]

_FLAT = 1e-3  # extents below this share of the longest count as that much, so that sheets have cells
_SAME = 2e-6  # points on one line closer than this share of the box's diagonal are one: doubled faces, common edges


@dataclass(frozen=True)
class Piercings:
    """Points where lines go through meshes, mesh after mesh.

    Args:
        points: ``(n, 3)`` [m].
        normals: ``(n, 3)`` unit, as the triangles are oriented.
        weights: ``(n,)`` the area that each point stands for [m2].
        gaps: ``(n, 2)`` the lesser and the greater way to the surface on either side, along the line and times the
            cosine between line and normal [m]; inf where nothing follows.
        slant: ``(n,)`` that cosine, without its sign.
        offsets: ``(n_meshes + 1,)``; mesh ``i`` owns the rows ``offsets[i]:offsets[i + 1]``.
    """

    points: Floats
    normals: Floats
    weights: Floats
    gaps: Floats
    slant: Floats
    offsets: Ints


def pierce(scene: Scene, properties: Properties, lines: int) -> Piercings:
    """Sends a grid of lines through each mesh.

    Args:
        scene: any; triangles that are not finite are left out.
        properties: of its meshes; their oriented boxes carry the grids.
        lines: across each side of the box; ``3 * lines ** 2`` in all. Multiples of 4 keep lines away from the halves
            and quarters of a shape, where its edges tend to lie.

    Returns:
        The points, ordered by line and then along it.
    """
    extents = np.maximum(properties.obb_extents, _FLAT * properties.obb_extents[:, :1])
    meshes = _Meshes(
        readable(scene.vertices, np.float64), readable(scene.global_faces(), np.int32),
        readable(scene.face_offsets, np.int64), readable(properties.obb_center, np.float64),
        readable(properties.obb_axes, np.float64),
        readable(np.where(np.isfinite(extents), extents, 0.0), np.float64),
    )  # fmt: skip

    def kernel(first: int, last: int) -> tuple[Floats, Ints]:
        room = np.zeros(last - first, np.int64)
        _count(first, last, meshes, lines, room)
        rows = np.empty((int(room.sum()), 10))
        kept = np.zeros(last - first, np.int64)
        if len(rows):
            spare = np.empty((int(room.max()), 2))
            found = np.empty((int(room.max()), 2))
            _fill(first, last, meshes, lines, found, spare, rows, kept)
        return rows[: int(kept.sum())], kept

    ranges = gather(kernel, np.diff(meshes.starts) + 1)
    rows = np.concatenate([r for r, _ in ranges]) if ranges else np.zeros((0, 10))
    counts = np.concatenate([k for _, k in ranges]) if ranges else np.zeros(scene.n_meshes, np.int64)
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    return Piercings(rows[:, 0:3], rows[:, 3:6], rows[:, 6], rows[:, 7:9], rows[:, 9], offsets)


class _Meshes(NamedTuple):
    """Triangles, those of mesh ``i`` from ``starts[i]`` on, and the box that carries each mesh's grid."""

    vertices: Floats
    faces: Faces
    starts: Ints
    center: Floats
    axes: Floats
    extents: Floats


@compiled
def _corner(meshes: _Meshes, vertex: int, mesh: int, k: int) -> float:
    """A coordinate of a vertex along a side of the box, 0 to 1 across it."""
    x = meshes.vertices[vertex, 0] - meshes.center[mesh, 0]
    y = meshes.vertices[vertex, 1] - meshes.center[mesh, 1]
    z = meshes.vertices[vertex, 2] - meshes.center[mesh, 2]
    along = x * meshes.axes[mesh, k, 0] + y * meshes.axes[mesh, k, 1] + z * meshes.axes[mesh, k, 2]
    place: float = along / meshes.extents[mesh, k] + 0.5
    return place


@compiled
def _cross(meshes: _Meshes, face: int, mesh: int, lines: int, k: int, found: Floats, at: int) -> int:
    """Writes the points of one triangle on the lines along side ``k``; their number.

    ``found`` gets the place along the line, and triangle and line in one number; with no room at all, the points are
    only counted.
    """
    i, j = (k + 1) % 3, (k + 2) % 3
    a, b, c = meshes.faces[face, 0], meshes.faces[face, 1], meshes.faces[face, 2]
    x0, y0 = _corner(meshes, a, mesh, i), _corner(meshes, a, mesh, j)
    x1, y1 = _corner(meshes, b, mesh, i), _corner(meshes, b, mesh, j)
    x2, y2 = _corner(meshes, c, mesh, i), _corner(meshes, c, mesh, j)
    double = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    # Written so that what is not finite is left out.
    if not (abs(double) > 1e-13 and abs(double) < 1e13):
        return 0
    z0, z1, z2 = _corner(meshes, a, mesh, k), _corner(meshes, b, mesh, k), _corner(meshes, c, mesh, k)
    low_x, high_x = min(x0, min(x1, x2)), max(x0, max(x1, x2))
    low_y, high_y = min(y0, min(y1, y2)), max(y0, max(y1, y2))
    first_x, last_x = max(0, int(low_x * lines - 0.5)), min(lines - 1, int(high_x * lines - 0.5 + 1e-6))
    first_y, last_y = max(0, int(low_y * lines - 0.5)), min(lines - 1, int(high_y * lines - 0.5 + 1e-6))
    count = 0
    for p in range(first_x, last_x + 1):
        x = (p + 0.5) / lines
        for q in range(first_y, last_y + 1):
            y = (q + 0.5) / lines
            u = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / double
            v = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / double
            if u < -1e-9 or v < -1e-9 or u + v > 1 + 1e-9:
                continue
            if len(found) > 0:
                found[at + count, 0] = z0 + u * (z1 - z0) + v * (z2 - z0)
                found[at + count, 1] = float(face) * (lines * lines) + float(p * lines + q)
            count += 1
    return count


@compiled
def _count(first: int, last: int, meshes: _Meshes, lines: int, room: Ints) -> None:
    """How many points each mesh has, doubled ones included."""
    nothing = np.empty((0, 2))
    for mesh in range(first, last):
        if meshes.extents[mesh, 0] > 0:
            for face in range(meshes.starts[mesh], meshes.starts[mesh + 1]):
                for k in range(3):
                    room[mesh - first] += _cross(meshes, face, mesh, lines, k, nothing, 0)


@compiled
def _fill(
    first: int, last: int, meshes: _Meshes, lines: int, found: Floats, spare: Floats, rows: Floats, kept: Ints
) -> None:
    """Writes the points of each mesh, ordered by line and along it, doubled ones once."""
    at = 0
    heads = np.zeros(lines * lines + 1, np.int64)
    for mesh in range(first, last):
        if not meshes.extents[mesh, 0] > 0:
            continue
        begin = at
        for k in range(3):
            n = 0
            for face in range(meshes.starts[mesh], meshes.starts[mesh + 1]):
                n += _cross(meshes, face, mesh, lines, k, found, n)
            _by_line(found, n, heads, spare)
            low = 0
            for line in range(lines * lines):
                high = heads[line]
                if high > low:
                    sort_rows(spare, low, high, found)
                    at = _write_line(meshes, mesh, lines, k, spare, low, high, rows, at)
                low = high
        kept[mesh - first] = at - begin


@compiled
def _by_line(found: Floats, n: int, heads: Ints, spare: Floats) -> None:
    """Copies ``n`` points line by line, those of line ``i`` up to the row ``heads[i]``: a counting sort."""
    cells = len(heads) - 1
    for c in range(cells + 1):
        heads[c] = 0
    for r in range(n):
        heads[int(found[r, 1] % cells) + 1] += 1
    for c in range(cells):
        heads[c + 1] += heads[c]
    for r in range(n):
        c = int(found[r, 1] % cells)
        spare[heads[c], 0], spare[heads[c], 1] = found[r, 0], found[r, 1]
        heads[c] += 1


@compiled
def _write_line(
    meshes: _Meshes, mesh: int, lines: int, k: int, spare: Floats, low: int, high: int, rows: Floats, at: int
) -> int:
    """Writes the points of one line; the next free row."""
    i, j = (k + 1) % 3, (k + 2) % 3
    vertices, faces, axes, extents = meshes.vertices, meshes.faces, meshes.axes, meshes.extents
    cells = lines * lines
    cell = extents[mesh, i] * extents[mesh, j] / cells
    diagonal = np.sqrt(extents[mesh, 0] ** 2 + extents[mesh, 1] ** 2 + extents[mesh, 2] ** 2)
    begin = at
    for r in range(low, high):
        place = spare[r, 0]
        face = int(spare[r, 1] // cells)
        spot = int(spare[r, 1] % cells)
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        e0 = vertices[b, 0] - vertices[a, 0]
        e1 = vertices[b, 1] - vertices[a, 1]
        e2 = vertices[b, 2] - vertices[a, 2]
        f0 = vertices[c, 0] - vertices[a, 0]
        f1 = vertices[c, 1] - vertices[a, 1]
        f2 = vertices[c, 2] - vertices[a, 2]
        n0, n1, n2 = e1 * f2 - e2 * f1, e2 * f0 - e0 * f2, e0 * f1 - e1 * f0
        size = np.sqrt(n0 * n0 + n1 * n1 + n2 * n2)
        if not size > 0:
            continue
        n0, n1, n2 = n0 / size, n1 / size, n2 / size
        slant = abs(n0 * axes[mesh, k, 0] + n1 * axes[mesh, k, 1] + n2 * axes[mesh, k, 2])
        x = ((spot // lines) + 0.5) / lines - 0.5
        y = ((spot % lines) + 0.5) / lines - 0.5
        if at > begin and (place - rows[at - 1, 7]) * extents[mesh, k] < _SAME * diagonal:
            # Of the faces that meet here the one that looks most along the line counts.
            if slant <= rows[at - 1, 9] + 1e-9:
                continue
            at -= 1
            place = rows[at, 7]
        for d in range(3):
            rows[at, d] = (
                meshes.center[mesh, d]
                + x * extents[mesh, i] * axes[mesh, i, d]
                + y * extents[mesh, j] * axes[mesh, j, d]
                + (place - 0.5) * extents[mesh, k] * axes[mesh, k, d]
            )
        rows[at, 3], rows[at, 4], rows[at, 5] = n0, n1, n2
        rows[at, 6] = cell * slant
        rows[at, 7], rows[at, 9] = place, slant
        at += 1
    # Places become ways to the neighbours on the line.
    before = np.inf
    for r in range(begin, at):
        after = np.inf if r + 1 == at else (rows[r + 1, 7] - rows[r, 7]) * extents[mesh, k]
        rows[r, 8] = max(before, after) * rows[r, 9]
        rows[r, 7] = min(before, after) * rows[r, 9]
        before = after
    return at
