"""What stands in the way between two heights, on a grid in plan."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.model.grid import Grid
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["occupied"]

_PLACED = 4096  # meshes that are placed at a time
_MOST = 8  # corners of a triangle that is cut at two heights: five at most, and room for both passes


def occupied(scene: Scene, meshes: Ints, low: float, high: float, grid: Grid) -> Bools:
    """The squares of a grid above or below which some surface lies between two heights.

    Args:
        scene: all meshes.
        meshes: the numbers of those that count.
        low: the lower height [m].
        high: the upper one.
        grid: in plan.

    Returns:
        ``(rows, columns)``; a square counts where a triangle comes over any point of it.
    """
    columns, rows = grid.size
    found = np.zeros((rows, columns), np.bool_)

    def fill(first: int, last: int) -> None:
        # Threads may mark the same square: all of them write that it is one.
        for part, numbers in _in_place(scene, meshes[first:last]):
            _fill(
                readable(part.placed_vertices(), np.float64), readable(part.placed_faces(), np.int32),
                readable(part.vertex_offsets, np.int64), readable(part.face_offsets, np.int64),
                readable(numbers, np.int64), round(float(low), 6), round(float(high), 6), grid.origin[0],
                grid.origin[1], 1.0 / grid.step, found,
            )  # fmt: skip

    for_ranges(fill, scene.face_offsets[meshes + 1] - scene.face_offsets[meshes])
    return found


def _in_place(scene: Scene, meshes: Ints) -> Iterator[tuple[Scene, Ints]]:
    """Scenes that hold the meshes, and their numbers there; where shapes are shared, so few that they can be placed."""
    if scene.placement is None:
        yield scene, meshes
        return
    for start in range(0, len(meshes), _PLACED):
        some = meshes[start : start + _PLACED]
        yield scene.select(some), np.arange(len(some))


@compiled
def _fill(
    vertices: Floats, faces: Faces, vertex_offsets: Ints, face_offsets: Ints, meshes: Ints,
    low: float, high: float, left: float, front: float, scale: float, found: Bools,
) -> None:  # fmt: skip
    """Marks the squares that triangles come over; lengths are counted in squares from the grid's corner."""
    vertices, faces, found = borrow(vertices), borrow(faces), borrow(found)
    here, there = np.empty((_MOST, 3)), np.empty((_MOST, 3))
    for m in range(len(meshes)):
        mesh = meshes[m]
        first, n = vertex_offsets[mesh], vertex_offsets[mesh + 1] - vertex_offsets[mesh]
        for f in range(face_offsets[mesh], face_offsets[mesh + 1]):
            a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
            if min(a, b, c) < 0 or max(a, b, c) >= n:
                continue
            za, zb, zc = _plain(vertices[first + a, 2]), _plain(vertices[first + b, 2]), _plain(vertices[first + c, 2])
            if not (min(za, zb, zc) <= high and max(za, zb, zc) >= low):
                continue
            for k in range(3):
                corner = first + (a if k == 0 else (b if k == 1 else c))
                here[k, 0] = _plain((vertices[corner, 0] - left) * scale)
                here[k, 1] = _plain((vertices[corner, 1] - front) * scale)
                here[k, 2] = za if k == 0 else (zb if k == 1 else zc)
            count = _cut(here, 3, there, low, 1.0)
            count = _cut(there, count, here, high, -1.0)
            _draw(here, count, found)


@compiled
def _plain(value: float) -> float:
    """A value without its last digits: what lies on the border of a square lies there on every machine."""
    return float(np.rint(value * 1e6) / 1e6)


@compiled
def _cut(given: Floats, n: int, kept: Floats, height: float, side: float) -> int:
    """The part of a polygon above a height, or below it where the side is -1; returns how many corners are kept."""
    count = 0
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        a, b = side * (given[i, 2] - height), side * (given[j, 2] - height)
        if a >= 0.0:
            kept[count, 0], kept[count, 1], kept[count, 2] = given[i, 0], given[i, 1], given[i, 2]
            count += 1
        if (a > 0.0 and b < 0.0) or (a < 0.0 and b > 0.0):
            t = a / (a - b)
            kept[count, 0] = given[i, 0] + t * (given[j, 0] - given[i, 0])
            kept[count, 1] = _plain(given[i, 1] + t * (given[j, 1] - given[i, 1]))
            kept[count, 2] = height
            count += 1
    return count


@compiled
def _draw(polygon: Floats, n: int, found: Bools) -> None:
    """Marks the squares that a polygon in plan comes over, row by row."""
    if n == 0:
        return
    bottom, top = polygon[0, 1], polygon[0, 1]
    for i in range(1, n):
        bottom, top = min(bottom, polygon[i, 1]), max(top, polygon[i, 1])
    rows, columns = found.shape
    if not (top >= 0.0 and bottom <= rows):
        return
    for row in range(max(0, int(np.floor(bottom))), min(rows - 1, int(np.floor(top))) + 1):
        least, most = np.inf, -np.inf
        for i in range(n):
            j = i + 1 if i + 1 < n else 0
            x, y, ex, ey = polygon[i, 0], polygon[i, 1], polygon[j, 0], polygon[j, 1]
            if max(y, ey) < row or min(y, ey) > row + 1:
                continue
            # Where this side of the polygon runs within the row.
            s, t = 0.0, 1.0
            if ey != y:
                p, q = (row - y) / (ey - y), (row + 1 - y) / (ey - y)
                s, t = max(0.0, min(p, q)), min(1.0, max(p, q))
            one, other = _plain(x + s * (ex - x)), _plain(x + t * (ex - x))
            least, most = min(least, one, other), max(most, one, other)
        if not (most >= 0.0 and least <= columns):
            continue
        for column in range(max(0, int(np.floor(least))), min(columns - 1, int(np.floor(most))) + 1):
            found[row, column] = True
