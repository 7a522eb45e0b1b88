"""Normals for smooth shading: continuous over coarse cylinders, broken at edges that are sharp."""

from __future__ import annotations

import math
import threading
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.parallel import ZERO, compiled, readable
from cadgraph.model.scene import Ints, Scene

__all__ = ["CREASE_ANGLE", "CornerNormals", "Normals", "corner_normals"]

Singles = npt.NDArray[np.float32]

CREASE_ANGLE = math.radians(42.0)
"""Faces that meet at a lesser angle look like one curved surface. Ours: a pipe of 9 sides (40 degrees) is round, a
chamfer (45 degrees) and a hexagon (60 degrees) keep their edges."""

_MOST_PARTNERS = 24  # beyond so many faces on either side of a corner, more of them no longer change its normal
_FACES_AT_ONCE = 50_000  # of one task: many small meshes go to a thread together


def corner_normals(vertices: npt.ArrayLike, faces: npt.ArrayLike, angle: float = CREASE_ANGLE) -> Singles:
    """A unit normal for each corner of each face: the mean of the faces round it that meet at less than an angle.

    Corners at the same place belong together, whether they share a vertex or not (STEP surfaces don't). Faces are
    weighted by area and corner angle, so that neither the split of a quad nor a fillet beside a large plane shows.
    A neighbour with its sides swapped counts with its normal turned round.

    Args:
        vertices: ``(n, 3)`` of one mesh [m].
        faces: ``(m, 3)`` indices.
        angle: greatest angle between faces that are shaded as one [rad].

    Returns:
        ``(m, 3, 3)`` float32, each on the side of its face's own normal; of a degenerate face zero.
    """
    p = readable(np.asarray(vertices, np.float64).reshape(-1, 3), np.float64)
    f = readable(np.asarray(faces, np.int32).reshape(-1, 3), np.int32)
    result = np.zeros((len(f), 3, 3), np.float32)
    if len(f):
        # Adding zero turns -0 into 0.
        places = (p - p[0]).astype(np.float32) + np.float32(0)
        _corner_normals(p, places.view(np.uint32), f, math.cos(angle), result)
    return result


@compiled
def _corner_normals(vertices: Any, bits: Any, faces: Any, limit: float, result: Any) -> None:
    n = 3 * len(faces)
    normal, weight = np.zeros((len(faces), 3)), np.zeros((len(faces), 3))
    _face_normals(vertices, faces, normal, weight)
    place = np.empty(len(vertices), np.int32)
    n_places = _places(bits, place)
    # The corners at each place, one place after the other, each in the order of the faces.
    start = np.zeros(n_places + 1, np.int32)
    for k in range(n):
        start[place[faces[k // 3, k % 3]] + 1] += 1
    for i in range(n_places):
        start[i + 1] += start[i]
    corners, filled = np.empty(n, np.int32), start.copy()
    for k in range(n):
        at = place[faces[k // 3, k % 3]]
        corners[filled[at]] = k
        filled[at] += 1
    for i in range(n_places):
        first, last = start[i], start[i + 1]
        for a in range(first, last):
            _mean_normal(corners, a, max(first, a - _MOST_PARTNERS), min(last, a + _MOST_PARTNERS + 1), normal, weight,
                         limit, result)  # fmt: skip


@compiled
def _face_normals(vertices: Any, faces: Any, normal: Any, weight: Any) -> None:
    """Unit normals, and the weight of each corner: area times angle."""
    side, length = np.zeros((3, 3)), np.zeros(3)
    for f in range(len(faces)):
        for c in range(3):
            total = 0.0
            for i in range(3):
                step = vertices[faces[f, (c + 1) % 3], i] - vertices[faces[f, c], i]
                side[c, i] = step
                total += step * step
            length[c] = np.sqrt(total)
        x = side[0, 1] * side[1, 2] - side[0, 2] * side[1, 1]
        y = side[0, 2] * side[1, 0] - side[0, 0] * side[1, 2]
        z = side[0, 0] * side[1, 1] - side[0, 1] * side[1, 0]
        area = np.sqrt(x * x + y * y + z * z)
        if not (0.0 < area < np.inf):
            continue
        normal[f, 0], normal[f, 1], normal[f, 2] = x / area, y / area, z / area
        for c in range(3):
            b = (c + 2) % 3
            dot = side[c, 0] * side[b, 0] + side[c, 1] * side[b, 1] + side[c, 2] * side[b, 2]
            cosine = -dot / max(length[c] * length[b], 1e-300)
            weight[f, c] = area * np.arccos(min(1.0, max(-1.0, cosine)))


@compiled
def _places(bits: Any, place: Any) -> int:
    """Numbers the vertices so that those of the same bits get the same number; says how many numbers there are."""
    size = 4
    while size < 2 * len(bits):
        size *= 2
    table = np.full(size, -1, np.int32)
    count: int = ZERO
    for v in range(len(bits)):
        key = np.uint64(0)
        for i in range(3):
            key = (key ^ np.uint64(bits[v, i])) * np.uint64(0x9E3779B97F4A7C15)
            key ^= key >> np.uint64(29)
        at = np.int64(key & np.uint64(size - 1))
        while table[at] >= 0:
            other = table[at]
            if bits[other, 0] == bits[v, 0] and bits[other, 1] == bits[v, 1] and bits[other, 2] == bits[v, 2]:
                break
            at = (at + 1) & (size - 1)
        if table[at] < 0:
            table[at] = v
            place[v] = count
            count += 1
        else:
            place[v] = place[table[at]]
    return count


@compiled
def _mean_normal(
    corners: Any, at: int, first: int, last: int, normal: Any, weight: Any, limit: float, result: Any
) -> None:
    corner = corners[at]
    own = corner // 3
    x, y, z = 0.0, 0.0, 0.0
    for k in range(first, last):
        face, c = corners[k] // 3, corners[k] % 3
        cosine = normal[own, 0] * normal[face, 0] + normal[own, 1] * normal[face, 1] + normal[own, 2] * normal[face, 2]
        if k == at:
            cosine = 1.0
        if abs(cosine) > limit:
            w = weight[face, c] if cosine > 0 else -weight[face, c]
            x, y, z = x + w * normal[face, 0], y + w * normal[face, 1], z + w * normal[face, 2]
    long = np.sqrt(x * x + y * y + z * z)
    if long > 0.0:
        x, y, z = x / long, y / long, z / long
    else:
        x, y, z = normal[own, 0], normal[own, 1], normal[own, 2]
    result[own, corner % 3, 0], result[own, corner % 3, 1], result[own, corner % 3, 2] = x, y, z


class Normals(NamedTuple):
    """Corner normals of a scene's faces; arguments of compiled kernels.

    Args:
        corners: ``(k, 3, 3)`` float32 unit, of the faces of each shape once.
        shift: ``(n_meshes,)`` int64; those of face ``f`` of mesh ``m`` are in row ``f + shift[m]``.
        turn: ``(n_meshes, 3, 3)`` float32, for row vectors, from the shape to the mesh; empty where none is turned.
    """

    corners: Singles
    shift: Ints
    turn: Singles

    def with_plane(self, normal: npt.ArrayLike, face: int) -> Normals:
        """With one more mesh, of a single plane face of this number and normal ``(3,)``."""
        plane = np.broadcast_to(np.asarray(normal, np.float32), (1, 3, 3))
        return Normals(
            np.concatenate([self.corners, plane]),
            np.append(self.shift, len(self.corners) - face),
            np.concatenate([self.turn, np.eye(3, dtype=np.float32)[None]]) if len(self.turn) else self.turn,
        )


class CornerNormals:
    """The corner normals of a scene, worked out shape by shape when a picture first shows it. Safe for threads.

    Args:
        scene: the scene.
        threads: that work them out.
    """

    def __init__(self, scene: Scene, threads: int = 1) -> None:
        self._threads = threads
        self._lock = threading.Lock()
        self._shapes = scene.shapes
        placement = scene.placement
        self._shape = np.arange(scene.n_meshes) if placement is None else placement.shape
        turn = np.zeros((0, 3, 3), np.float32) if placement is None else placement.turn.astype(np.float32)
        self._ready = np.zeros(self._shapes.n, bool)
        corners = np.zeros((len(self._shapes.faces), 3, 3), np.float32)
        shift = self._shapes.face_offsets[:-1][self._shape] - scene.face_offsets[:-1]
        self._normals = Normals(corners, shift, turn)

    def moved(self, scene: Scene, meshes: Ints) -> CornerNormals:
        """Those of the same scene with some meshes elsewhere; what was worked out of the others is kept.

        Args:
            scene: the same meshes in the same order.
            meshes: ``(n,)`` those that may lie elsewhere, ascending.
        """
        other = copy(self)
        other._lock = threading.Lock()
        # What moved is a shape of its own, as it lies now; it is little, and nearly always seen.
        own = [corner_normals(*scene.mesh(mesh)) for mesh in meshes.tolist()]
        rows = np.cumsum([0, *map(len, own)])
        with self._lock:
            other._ready = np.concatenate([self._ready, np.ones(len(own), bool)])
            corners = np.concatenate([self._normals.corners, *own])
        other._shape, shift, turn = self._shape.copy(), self._normals.shift.copy(), self._normals.turn.copy()
        other._shape[meshes] = len(self._ready) + np.arange(len(own))
        shift[meshes] = len(self._normals.corners) + rows[:-1] - scene.face_offsets[:-1][meshes]
        if len(turn):
            turn[meshes] = np.eye(3)
        other._normals = Normals(corners, shift, turn)
        return other

    def ready(self, meshes: npt.NDArray[np.integer[Any]]) -> Normals:
        """The normals of the whole scene, worked out for these meshes at least; not to be changed.

        Args:
            meshes: ``(n,)`` indices, in any order, repeated at will.
        """
        shown = np.zeros(len(self._ready), bool)
        shown[self._shape[meshes]] = True
        if (shown & ~self._ready).any():
            with self._lock:
                self._work_out(np.flatnonzero(shown & ~self._ready))
        return self._normals

    def _work_out(self, shapes: Ints) -> None:
        offsets = self._shapes.face_offsets
        tasks = np.split(shapes, np.flatnonzero(np.diff(np.cumsum(np.diff(offsets)[shapes]) // _FACES_AT_ONCE)) + 1)

        def work_out(chosen: Ints) -> None:
            for shape in chosen.tolist():
                first, last = offsets[shape : shape + 2]
                self._normals.corners[first:last] = corner_normals(*self._shapes.mesh(shape))

        if self._threads == 1 or len(tasks) == 1:
            for task in tasks:
                work_out(task)
        else:
            with ThreadPoolExecutor(self._threads) as pool:
                list(pool.map(work_out, tasks))
        self._ready[shapes] = True
