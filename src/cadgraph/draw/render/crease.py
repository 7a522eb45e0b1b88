"""Normals for smooth shading: continuous over coarse cylinders, broken at edges that are sharp."""

from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.vector import dot
from cadgraph.model.scene import Scene

__all__ = ["CREASE_ANGLE", "CornerNormals", "corner_normals"]

Singles = npt.NDArray[np.float32]

CREASE_ANGLE = math.radians(42.0)
"""Faces that meet at a lesser angle look like one curved surface. Ours: a pipe of 9 sides (40 degrees) is round, a
chamfer (45 degrees) and a hexagon (60 degrees) keep their edges."""

_MOST_PARTNERS = 24  # beyond so many faces on either side of a corner, more of them no longer change its normal
_FACES_AT_ONCE = 400_000


def corner_normals(
    vertices: npt.ArrayLike, faces: npt.ArrayLike, owner: npt.ArrayLike | None = None, angle: float = CREASE_ANGLE
) -> Singles:
    """A unit normal for each corner of each face: the mean of the faces round it that meet at less than an angle.

    Corners at the same place belong together, whether they share a vertex or not (STEP surfaces don't). Faces are
    weighted by area and corner angle, so that neither the split of a quad nor a fillet beside a large plane shows.
    A neighbour with its sides swapped counts with its normal turned round.

    Args:
        vertices: ``(n, 3)`` [m].
        faces: ``(m, 3)`` indices.
        owner: ``(m,)`` the mesh of each face; corners of different meshes don't mix. All one mesh by default.
        angle: greatest angle between faces that are shaded as one [rad].

    Returns:
        ``(m, 3, 3)`` float32, each on the side of its face's own normal; of a degenerate face zero.
    """
    f = np.asarray(faces, np.int64).reshape(-1, 3)
    p = np.asarray(vertices, np.float64).reshape(-1, 3)
    if not len(f):
        return np.zeros((0, 3, 3), np.float32)
    corners = (p[f] - p[f[0, 0]]).astype(np.float32)
    flat, weights = _face_normals(corners)
    place = _places(corners.reshape(-1, 3), np.zeros(len(f), np.int64) if owner is None else np.asarray(owner))
    order = np.argsort(place, kind="stable")
    place = place[order]
    normals, weights = flat[order // 3], weights.reshape(-1)[order]
    total = normals * weights[:, None]
    limit = math.cos(angle)
    for step in range(1, min(_MOST_PARTNERS, len(place) - 1) + 1):
        first = np.flatnonzero(place[:-step] == place[step:])
        if not len(first):
            break
        second = first + step
        cosine = dot(normals[first], normals[second])
        smooth = np.abs(cosine) > limit
        first, second, sign = first[smooth], second[smooth], np.sign(cosine[smooth])
        total[first] += normals[second] * (sign * weights[second])[:, None]
        total[second] += normals[first] * (sign * weights[first])[:, None]
    length = np.sqrt(dot(total, total))
    sound = length > 1e-12
    total = np.where(sound[:, None], total / np.where(sound, length, 1)[:, None], normals)
    result = np.empty_like(total)
    result[order] = total
    return result.reshape(-1, 3, 3)


def _face_normals(corners: Singles) -> tuple[Singles, Singles]:
    """Unit normals ``(m, 3)`` and area-times-angle weights ``(m, 3)`` of triangles ``(m, 3, 3)``."""
    sides = np.roll(corners, -1, axis=1) - corners
    normal = np.cross(sides[:, 0], sides[:, 1])
    twice_area = np.sqrt(dot(normal, normal))
    unit = normal / np.where(twice_area > 0, twice_area, 1)[:, None]
    length = np.sqrt(dot(sides, sides))
    back = np.roll(sides, 1, axis=1)
    cosine = -dot(sides, back) / np.maximum(length * np.roll(length, 1, axis=1), 1e-30)
    angle = np.arccos(np.clip(cosine, -1, 1))
    # Scaled to about one, so that float32 sums neither vanish nor overflow for the size of a bolt or of a site.
    mean_area = max(float(twice_area.mean()), 1e-30)
    return unit.astype(np.float32), (angle * (twice_area / mean_area)[:, None]).astype(np.float32)


def _places(corners: Singles, owner: npt.NDArray[np.int64]) -> npt.NDArray[np.uint64]:
    """A number for each corner, equal for corners of one mesh at one place (a 64-bit hash)."""
    bits = (corners + np.float32(0)).view(np.uint32).astype(np.uint64)
    place = np.repeat(owner.astype(np.uint64), 3) * np.uint64(0x9E3779B97F4A7C15)
    for axis in range(3):
        place = (place ^ bits[:, axis]) * np.uint64(0xBF58476D1CE4E5B9)
        place ^= place >> np.uint64(29)
    return place


class CornerNormals:
    """The corner normals of a scene, worked out mesh by mesh when a picture first shows them. Safe for threads.

    Args:
        scene: the scene.
        angle: crease angle [rad].
    """

    def __init__(self, scene: Scene, angle: float = CREASE_ANGLE) -> None:
        self._scene = scene
        self._angle = angle
        self._ready = np.zeros(scene.n_meshes, bool)
        self._normals = np.empty((scene.n_triangles, 3, 3), np.float32)
        self._lock = threading.Lock()

    def at(self, faces: npt.NDArray[np.int32], meshes: npt.NDArray[np.int32], u: Singles, v: Singles) -> Singles:
        """Interpolated normals ``(n, 3)``, not of unit length.

        Args:
            faces: ``(n,)`` indices into the scene's faces.
            meshes: ``(n,)`` the meshes that own them.
            u: ``(n,)`` barycentric weight of the second corner.
            v: ``(n,)`` barycentric weight of the third corner.
        """
        corners = self.ready(meshes)[faces]
        w = (1 - u - v)[:, None]
        normals: Singles = corners[:, 0] * w + corners[:, 1] * u[:, None] + corners[:, 2] * v[:, None]
        return normals

    def ready(self, meshes: npt.NDArray[np.integer[Any]]) -> Singles:
        """``(n_faces, 3, 3)`` the normals of the whole scene, worked out for these meshes at least; not to be changed.

        Args:
            meshes: ``(n,)`` indices, in any order, repeated at will.
        """
        shown = np.zeros(len(self._ready), bool)
        shown[meshes] = True
        if (shown & ~self._ready).any():
            with self._lock:
                self._work_out(np.flatnonzero(shown & ~self._ready))
        return self._normals

    def _work_out(self, meshes: npt.NDArray[np.int64]) -> None:
        counts = np.diff(self._scene.face_offsets)[meshes]
        batch = np.cumsum(counts) // _FACES_AT_ONCE
        for number in np.unique(batch):
            chosen = meshes[batch == number]
            scene = self._scene.select(chosen)
            owner = np.repeat(np.arange(len(chosen)), np.diff(scene.face_offsets))
            normals = corner_normals(scene.vertices, scene.global_faces(), owner, self._angle)
            for i, mesh in enumerate(chosen):
                first, last = self._scene.face_offsets[mesh : mesh + 2]
                self._normals[first:last] = normals[scene.face_offsets[i] : scene.face_offsets[i + 1]]
            self._ready[chosen] = True
