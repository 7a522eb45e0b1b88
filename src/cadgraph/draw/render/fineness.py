"""How small a thing has to be told apart in a picture of very many."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import Camera
from cadgraph.model.scene import Floats, Ints, MeshArrays, Scene, turned_boxes

__all__ = ["Fineness"]

Bools = npt.NDArray[np.bool_]

_MANY = 2_000_000  # triangles up to which meshes are drawn as they are
_USUAL = 4000.0  # cells along the diagonal of what a picture shows all of: some three for each pixel
_LARGE = 0.125  # meshes of so large a share of that diagonal are drawn as they are


class Fineness:
    """Sizes of cells to coarsen the meshes of a scene by; those for the same arguments are the same.

    Args:
        scene: the scene.
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    def many(self, meshes: Ints | None) -> bool:
        """Whether these meshes (all if None) have so many triangles that coarsening them pays."""
        counts = np.diff(self._scene.face_offsets)
        return int(counts.sum() if meshes is None else counts[meshes].sum()) > _MANY

    def usual(self, meshes: Ints | None) -> float:
        """The cell that does for pictures that show all of these meshes (all if None) [m]."""
        return self._diagonal(meshes) / _USUAL

    def steps(self, meshes: Ints | None, cell: float | None) -> tuple[float, float]:
        """The cell to take, and up to which size meshes are coarsened [m].

        Few different cells are ever taken, so that pictures share what is made by them.

        Args:
            meshes: which; all if None.
            cell: about what would do [m]; None: the usual one.
        """
        if (cell is not None and not cell > 0) or not self.many(meshes):
            return 0.0, 0.0
        usual = self.usual(meshes)
        if not usual > 0:
            return 0.0, 0.0
        finer = 0 if cell is None else max(0, round(math.log2(usual / cell)))
        return usual / 2**finer, _LARGE * self._diagonal(meshes)

    def wanted(self, camera: Camera, meshes: Ints | None, share: float) -> float:
        """What covers so much of a pixel in the picture of that of these meshes which is nearest [m].

        Args:
            camera: of the picture.
            meshes: which; all if None.
            share: of a pixel.
        """
        if not self.many(meshes):
            return 0.0
        depth, inside = self._depths(camera, meshes)
        low, high = self._boxes if meshes is None else (self._boxes[0][meshes], self._boxes[1][meshes])
        counted = inside & (np.linalg.norm(high - low, axis=1) <= _LARGE * self._diagonal(meshes))
        nearest = float(depth[counted].min()) if counted.any() else 0.0
        return max(0.0, share * camera.pixel_size * nearest)

    def in_sight(self, camera: Camera) -> Ints:
        """``(n,)`` the meshes that a picture may show."""
        return np.flatnonzero(self._depths(camera, None)[1])

    def _depths(self, camera: Camera, meshes: Ints | None) -> tuple[Floats, Bools]:
        """Depth of the nearest corner of each mesh's box [m], and whether the box may be in the picture."""
        low, high = self._boxes if meshes is None else (self._boxes[0][meshes], self._boxes[1][meshes])
        middle, half = (low + high) / 2 - camera.eye, (high - low) / 2
        wide = camera.half_height * camera.width / camera.height
        inside: Bools = np.asarray(np.isfinite(half).all(axis=1))
        for side, slope in ((camera.right, wide), (-camera.right, wide), (camera.up, camera.half_height),
                            (-camera.up, camera.half_height), (np.zeros(3), 1.0)):  # fmt: skip
            normal = side + slope * camera.forward
            inside &= middle @ normal + half @ np.abs(normal) >= 0
        depth: Floats = middle @ camera.forward - half @ np.abs(camera.forward)
        return depth, inside

    def _diagonal(self, meshes: Ints | None) -> float:
        low, high = self._boxes if meshes is None else (self._boxes[0][meshes], self._boxes[1][meshes])
        sound = np.isfinite(high - low).all(axis=1)
        if not sound.any():
            return 0.0
        return float(np.linalg.norm(high[sound].max(axis=0) - low[sound].min(axis=0)))

    @cached_property
    def _boxes(self) -> tuple[Floats, Floats]:
        """``(n_meshes, 3)`` least and greatest corners [m], at least as large as the meshes; of empty ones infinite."""
        low, high = _boxes(self._scene.shapes)
        placement = self._scene.placement
        if placement is None:
            return low, high
        return turned_boxes(low[placement.shape], high[placement.shape], placement.turn, placement.shift)


def _boxes(arrays: MeshArrays) -> tuple[Floats, Floats]:
    """Least and greatest corners of the finite vertices of meshes; infinite where there are none."""
    low, high = np.full((arrays.n, 3), np.inf), np.full((arrays.n, 3), -np.inf)
    filled = np.flatnonzero(np.diff(arrays.vertex_offsets))
    if len(filled):
        sound = np.asarray(np.isfinite(arrays.vertices).all(axis=1))[:, None]
        starts = arrays.vertex_offsets[:-1][filled]
        low[filled] = np.minimum.reduceat(np.where(sound, arrays.vertices, np.inf), starts)
        high[filled] = np.maximum.reduceat(np.where(sound, arrays.vertices, -np.inf), starts)
    return low, high
