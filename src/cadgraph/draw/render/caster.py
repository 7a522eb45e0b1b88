"""Ray casting on chosen meshes of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from cadgraph.draw.render.vector import normalized
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face

__all__ = ["Caster", "Hits"]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]


@dataclass(frozen=True)
class Hits:
    """What rays met first.

    Args:
        face: ``(n,)`` int32 index into the scene's faces, -1 where a ray met nothing.
        u: ``(n,)`` float32 barycentric weight of the face's second corner.
        v: ``(n,)`` float32 barycentric weight of its third corner.
        distance: ``(n,)`` float32 along the ray [m], infinite where it met nothing.
        normal: ``(n, 3)`` float32 unit normal of the face, either way round.
    """

    face: Indices
    u: Singles
    v: Singles
    distance: Singles
    normal: Singles


class Caster:
    """Casts rays at some meshes of a scene. Faces are met from both sides: CAD has flipped ones.

    Coordinates inside are float32 about a local centre, because that is what the ray caster computes in; a scene far
    from its origin keeps its detail. Casting leaves the interpreter free for other threads.

    Args:
        scene: the scene.
        meshes: ``(n,)`` indices of the meshes to cast at; all by default.

    Raises:
        ValueError: these meshes have no finite triangle.
    """

    def __init__(self, scene: Scene, meshes: npt.ArrayLike | None = None) -> None:
        chosen = np.arange(scene.n_meshes) if meshes is None else np.unique(np.asarray(meshes, np.int64))
        all_chosen = len(chosen) == scene.n_meshes
        owner = mesh_of_face(scene)
        wanted = np.zeros(scene.n_meshes, bool)
        wanted[chosen] = True
        indices = scene.global_faces() if all_chosen else scene.global_faces()[wanted[owner]]
        self._face_of_primitive: Ints | None = None if all_chosen else np.flatnonzero(wanted[owner])
        finite = np.asarray(np.isfinite(scene.vertices).all(axis=1))
        if not finite.all():
            sound = finite[indices].all(axis=1)
            indices = indices[sound]
            before = np.arange(len(scene.faces)) if self._face_of_primitive is None else self._face_of_primitive
            self._face_of_primitive = before[sound]
        if not len(indices):
            raise ValueError("no picture of an empty scene: none of its meshes has a triangle with finite corners")
        used = np.zeros(len(scene.vertices), bool)
        used[indices] = True
        vertices = scene.vertices[used]
        if not used.all():
            indices = (np.cumsum(used) - 1)[indices]
        self.low: Floats = vertices.min(axis=0)
        self.high: Floats = vertices.max(axis=0)
        self.center: Floats = (self.low + self.high) / 2
        self._n_faces = len(scene.faces)
        self._tree = EmbreeScene(robust=True)
        self._mesh = TriangleMesh(self._tree, (vertices - self.center).astype(np.float32), indices.astype(np.int32))
        # The first ray makes it build the tree; done here, so that threads find it finished.
        self._tree.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))

    @property
    def faces(self) -> Ints:
        """``(n_primitives,)`` the scene's face behind each triangle that is cast at."""
        return np.arange(self._n_faces) if self._face_of_primitive is None else self._face_of_primitive

    @property
    def diagonal(self) -> float:
        """Of the box round the meshes [m]."""
        return float(np.linalg.norm(self.high - self.low))

    def local(self, points: npt.ArrayLike) -> Singles:
        """World-relative positions ``(n, 3)`` as float32 about the local centre."""
        return (np.asarray(points, np.float64) - self.center).astype(np.float32)

    def first(self, origins: Singles, directions: Singles) -> Hits:
        """What each ray meets first.

        Args:
            origins: ``(n, 3)`` about the local centre (see :meth:`local`).
            directions: ``(n, 3)`` unit vectors.
        """
        found = self._tree.run(np.ascontiguousarray(origins), np.ascontiguousarray(directions), output=1)
        primitive = found["primID"]
        missed = primitive < 0
        face = primitive
        if self._face_of_primitive is not None:
            face = np.where(missed, -1, self._face_of_primitive[primitive]).astype(np.int32)
        normal, _ = normalized(found["Ng"])
        return Hits(face, found["u"], found["v"], np.where(missed, np.float32(np.inf), found["tfar"]), normal)

    def trace(self, origins: Singles, directions: Singles) -> dict[str, Any]:
        """What each ray meets first, as the ray caster says it: for callers that work through the answer themselves.

        Args:
            origins: ``(n, 3)`` about the local centre (see :meth:`local`).
            directions: ``(n, 3)`` unit vectors.

        Returns:
            ``primID`` (index into :attr:`faces`, -1: nothing), ``u``, ``v``, ``tfar`` [m] and ``Ng`` (not of unit
            length), one row for each ray.
        """
        found: dict[str, Any] = self._tree.run(
            np.ascontiguousarray(origins, np.float32), np.ascontiguousarray(directions, np.float32), output=1
        )
        return found

    def blocked(self, origins: Singles, directions: Singles, lengths: Singles) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether anything lies on each ray before the given length [m]; arguments as in :meth:`first`."""
        if not len(origins):
            return np.zeros(0, bool)
        answer = self._tree.run(
            np.ascontiguousarray(origins),
            np.ascontiguousarray(directions),
            dists=np.ascontiguousarray(lengths, np.float32),
            query="OCCLUDED",
        )
        blocked: npt.NDArray[np.bool_] = answer >= 0
        return blocked
