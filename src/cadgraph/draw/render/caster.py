"""Ray casting on chosen meshes of a scene."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.coarse import coarsened
from cadgraph.geometry.visibility.rays import Hits, ray_tree
from cadgraph.model.scene import Floats, Scene

__all__ = ["Caster", "TwoCasters"]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]


class Caster:
    """Casts rays at some meshes of a scene. Faces are met from both sides: CAD has flipped ones.

    Coordinates inside are float32 about a local centre, because that is what the ray caster computes in; a scene far
    from its origin keeps its detail. Casting leaves the interpreter free for other threads.

    Args:
        scene: the scene.
        meshes: ``(n,)`` indices of the meshes to cast at; all by default.
        cell: what is smaller needn't be told apart [m], see :func:`~cadgraph.draw.render.coarse.coarsened`; 0 casts at
            the meshes as they are.
        most: meshes larger than this are cast at as they are, too [m].

    Raises:
        ValueError: these meshes have no finite triangle.
    """

    def __init__(self, scene: Scene, meshes: npt.ArrayLike | None = None, cell: float = 0.0, most: float = 0.0) -> None:
        vertices, indices, self._faces = _soup(scene, meshes, cell, most)
        if not len(indices):
            raise ValueError("no picture of an empty scene: none of its meshes has a triangle with finite corners")
        used = np.zeros(len(vertices), bool)
        used[indices] = True
        if not used.all():
            vertices, indices = vertices[used], (np.cumsum(used, dtype=np.int32) - np.int32(1))[indices]
        self.low: Floats = vertices.min(axis=0)
        self.high: Floats = vertices.max(axis=0)
        self.center: Floats = (self.low + self.high) / 2
        self._tree = ray_tree(vertices - self.center, indices)

    @property
    def diagonal(self) -> float:
        """Of the box round the meshes [m]."""
        return float(np.linalg.norm(self.high - self.low))

    def local(self, points: npt.ArrayLike) -> Singles:
        """World-relative positions ``(n, 3)`` as float32 about the local centre."""
        return (np.asarray(points, np.float64) - self.center).astype(np.float32)

    def first(self, origins: Singles, directions: Singles) -> Hits:
        """What each ray meets first; faces are those of the scene.

        Args:
            origins: ``(n, 3)`` about the local centre (see :meth:`local`).
            directions: ``(n, 3)`` unit vectors.
        """
        found = self._tree.first(origins, directions)
        if self._faces is None:
            return found
        return found._replace(face=np.where(found.face >= 0, self._faces[found.face], np.int32(-1)))

    def blocked(self, origins: Singles, directions: Singles, lengths: Singles) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether anything lies on each ray before the given length [m]; arguments as in :meth:`first`."""
        return self._tree.blocked(origins, directions, lengths)


class TwoCasters(Caster):
    """Casts rays at two groups of meshes of a scene as if they were one; only the second has moved since the first.

    Coordinates, and all sizes that light depends on, are those of the first, so that pictures of one scene with some
    of it in different places are lit alike.

    Args:
        still: casts at what stays.
        moved: casts at what was moved.
    """

    def __init__(self, still: Caster, moved: Caster) -> None:
        self._still, self._moved = still, moved
        self.low, self.high, self.center = still.low, still.high, still.center
        self._shift = (still.center - moved.center).astype(np.float32)

    def first(self, origins: Singles, directions: Singles) -> Hits:
        """What each ray meets first."""
        still = self._still.first(origins, directions)
        moved = self._moved.first(origins + self._shift, directions)
        nearer = (moved.face >= 0) & ((still.face < 0) | (moved.distance < still.distance))
        return Hits(
            *(np.where(nearer if b.ndim == 1 else nearer[:, None], b, a) for a, b in zip(still, moved, strict=True))
        )

    def blocked(self, origins: Singles, directions: Singles, lengths: Singles) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether anything lies on each ray before the given length [m]."""
        return self._still.blocked(origins, directions, lengths) | self._moved.blocked(
            origins + self._shift, directions, lengths
        )


def _soup(
    scene: Scene, meshes: npt.ArrayLike | None, cell: float, most: float
) -> tuple[Floats, Indices, Indices | None]:
    """The vertices and finite triangles to cast at, and the scene's face behind each (None: all, in order)."""
    chosen = None if meshes is None else np.unique(np.asarray(meshes, np.int64))
    if cell > 0:
        return coarsened(scene, np.arange(scene.n_meshes) if chosen is None else chosen, cell, most)
    part, faces = scene, None
    if chosen is not None:
        part = scene.select(chosen)
        shift = scene.face_offsets[chosen] - part.face_offsets[:-1]
        faces = (np.arange(part.n_triangles) + np.repeat(shift, np.diff(part.face_offsets))).astype(np.int32)
    indices, vertices = part.short_global_faces(), part.vertices
    finite = np.asarray(np.isfinite(vertices).all(axis=1))
    if not finite.all():
        sound = finite[indices].all(axis=1)
        indices = indices[sound]
        faces = np.flatnonzero(sound).astype(np.int32) if faces is None else faces[sound]
    return vertices, indices, faces
