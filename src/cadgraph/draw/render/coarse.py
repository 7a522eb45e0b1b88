"""Meshes with as few triangles as a picture can show: vertices that fall into one cell of a grid become one.

J. Rossignac and P. Borrel, *Multi-resolution 3D approximations for rendering complex scenes* (1993). Each triangle that
is left knows the one that it was, so that it is shaded with the normals of the whole mesh. No mesh loses a dimension: a
pipe thinner than a cell stays a tube.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from cadgraph.geometry.kernels.parallel import ZERO, compiled, readable
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["Coarse", "coarsened"]

_LEAST_CELLS = 3  # along each side of a mesh's box, so that what is round is still one of eight sides
_MOST_CELLS = 2**20  # along each side; a mesh that would need more stays as it is


class Coarse(NamedTuple):
    """Some meshes of a scene, coarsened.

    Args:
        vertices: ``(n, 3)`` [m].
        faces: ``(m, 3)`` int32 indices of these vertices.
        origin: ``(m,)`` int32 the scene's face that each was.
    """

    vertices: Floats
    faces: Faces
    origin: Faces


def coarsened(scene: Scene, meshes: Ints, cell: float, most: float) -> Coarse:
    """Coarsens meshes, each shape once.

    Args:
        scene: the scene.
        meshes: ``(n,)`` ascending indices.
        cell: side of a cell of the grid [m]; no vertex moves further than its diagonal.
        most: meshes larger than this stay as they are [m].
    """
    shape_of, arrays = meshes, scene.shapes
    turn, shift = np.zeros((0, 3, 3)), np.zeros((0, 3))
    if scene.placement is not None:
        shape_of = scene.placement.shape[meshes]
        turn, shift = scene.placement.turn[meshes], scene.placement.shift[meshes]
    used, row = np.unique(shape_of, return_inverse=True)
    n_vertices = int(np.diff(arrays.vertex_offsets)[used].sum())
    n_faces = int(np.diff(arrays.face_offsets)[used].sum())
    vertices, faces = np.empty((n_vertices, 3)), np.empty((n_faces, 3), np.int32)
    kept, ends = np.empty(n_faces, np.int32), np.zeros((len(used) + 1, 2), np.int64)
    _coarsen(
        readable(arrays.vertices, np.float64), readable(arrays.faces, np.int32),
        readable(arrays.vertex_offsets, np.int64), readable(arrays.face_offsets, np.int64), readable(used, np.int64),
        cell, most, vertices, faces, kept, ends,
    )  # fmt: skip
    row = row.reshape(-1).astype(np.int64)
    total = np.diff(ends, axis=0)[row].sum(axis=0)
    placed = Coarse(np.empty((int(total[0]), 3)), np.empty((int(total[1]), 3), np.int32), np.empty(total[1], np.int32))
    _place(
        vertices, faces, kept, ends, row, readable(turn, np.float64), readable(shift, np.float64),
        readable(scene.face_offsets[meshes], np.int64), *placed,
    )  # fmt: skip
    return placed


@compiled
def _coarsen(
    points: Any, corners: Any, first_vertex: Any, first_face: Any, shapes: Any, cell: float, most: float, vertices: Any,
    faces: Any, kept: Any, ends: Any,
) -> None:  # fmt: skip
    """Coarsens shapes, one after the other.

    Args:
        points: ``(n, 3)`` vertices of all shapes.
        corners: ``(m, 3)`` faces of all shapes, indices local to each.
        first_vertex: of each shape.
        first_face: of each shape.
        shapes: ``(k,)`` which of them.
        cell: see :func:`coarsened`.
        most: see there.
        vertices: the outcome: vertices of one shape after the other.
        faces: indices of the shape's own vertices.
        kept: which of the shape's faces each was.
        ends: ``(k + 1, 2)`` where the vertices and the faces of each shape begin.
    """
    n_vertices: int = ZERO
    n_faces: int = ZERO
    box, cells = np.empty((2, 3)), np.empty(3, np.int64)
    for k in range(len(shapes)):
        v0, v1 = first_vertex[shapes[k]], first_vertex[shapes[k] + 1]
        place = np.empty(v1 - v0, np.int32)
        count = _gather(points, v0, v1, _grid(points, v0, v1, cell, most, box, cells), box, cells, place, vertices,
                        n_vertices)  # fmt: skip
        for f in range(first_face[shapes[k]], first_face[shapes[k] + 1]):
            a, b, c = place[corners[f, 0]], place[corners[f, 1]], place[corners[f, 2]]
            if a >= 0 and b >= 0 and c >= 0 and a != b and b != c and c != a:
                faces[n_faces, 0], faces[n_faces, 1], faces[n_faces, 2] = a, b, c
                kept[n_faces] = f - first_face[shapes[k]]
                n_faces += 1
        n_vertices += count
        ends[k + 1, 0], ends[k + 1, 1] = n_vertices, n_faces


@compiled
def _grid(points: Any, v0: int, v1: int, cell: float, most: float, box: Any, cells: Any) -> bool:
    """Writes the box of a shape's finite vertices and the cells along its sides; says whether it is coarsened."""
    coarse = True
    for i in range(3):
        box[0, i], box[1, i] = np.inf, -np.inf
    for v in range(v0, v1):
        if np.isfinite(points[v, 0]) and np.isfinite(points[v, 1]) and np.isfinite(points[v, 2]):
            for i in range(3):
                box[0, i], box[1, i] = min(box[0, i], points[v, i]), max(box[1, i], points[v, i])
    for i in range(3):
        size = box[1, i] - box[0, i]
        coarse &= 0.0 <= size <= min(most, _MOST_CELLS * cell)
        cells[i] = max(np.int64(np.ceil(size / cell)), _LEAST_CELLS) if coarse else 1
    return coarse


@compiled
def _gather(
    points: Any, v0: int, v1: int, coarse: bool, box: Any, cells: Any, place: Any, vertices: Any, start: int
) -> int:
    """Writes the mean of the vertices in each cell, and each vertex's place among them; says how many there are."""
    room = 4
    while room < 2 * (v1 - v0):
        room *= 2
    table = np.full(room if coarse else 0, -1, np.int32)
    keys, many = np.empty(v1 - v0, np.int64), np.zeros(v1 - v0, np.int64)
    count: int = ZERO
    for v in range(v0, v1):
        if not (np.isfinite(points[v, 0]) and np.isfinite(points[v, 1]) and np.isfinite(points[v, 2])):
            place[v - v0] = -1
            continue
        at = count
        if coarse:
            key = ZERO
            for i in range(3):
                size = box[1, i] - box[0, i]
                step = np.int64((points[v, i] - box[0, i]) / size * cells[i]) if size > 0 else ZERO
                key = key * cells[i] + min(step, cells[i] - 1)
            at = _found(table, keys, key, count, room)
        if at == count:
            count += 1
            for i in range(3):
                vertices[start + at, i] = 0.0
        place[v - v0] = at
        many[at] += 1
        for i in range(3):
            vertices[start + at, i] += points[v, i]
    for at in range(count):
        for i in range(3):
            vertices[start + at, i] /= many[at]
    return count


@compiled
def _found(table: Any, keys: Any, key: int, count: int, room: int) -> int:
    """The place of a key, ``count`` for one that is new: it is put there."""
    mixed = np.uint64(key) * np.uint64(0x9E3779B97F4A7C15)
    at = np.int64((mixed ^ (mixed >> np.uint64(32))) & np.uint64(room - 1))
    while table[at] >= 0:
        if keys[table[at]] == key:
            return int(table[at])
        at = (at + 1) & (room - 1)
    table[at], keys[count] = count, key
    return count


@compiled
def _place(
    vertices: Any, faces: Any, kept: Any, ends: Any, row: Any, turn: Any, shift: Any, first_face: Any, to_vertices: Any,
    to_faces: Any, origin: Any,
) -> None:  # fmt: skip
    """Writes the shape of each mesh where the mesh lies; without turns, where it is."""
    v: int = ZERO
    f: int = ZERO
    for k in range(len(row)):
        start, end = ends[row[k]], ends[row[k] + 1]
        for j in range(start[1], end[1]):
            for i in range(3):
                to_faces[f, i] = v + faces[j, i]
            origin[f] = first_face[k] + kept[j]
            f += 1
        for j in range(start[0], end[0]):
            for i in range(3):
                if len(turn):
                    to_vertices[v, i] = (vertices[j, 0] * turn[k, 0, i] + vertices[j, 1] * turn[k, 1, i]
                                         + vertices[j, 2] * turn[k, 2, i] + shift[k, i])  # fmt: skip
                else:
                    to_vertices[v, i] = vertices[j, i]
            v += 1
