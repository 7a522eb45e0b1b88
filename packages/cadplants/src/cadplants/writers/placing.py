"""What every format needs of a plant: shapes that are shared, placed without mirroring, in a unit and up axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.components import first_of_component
from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.model.scene import Faces, Floats
from cadplants.model.plant import Plant
from cadplants.solids.mesh_ops import Solid, moved

__all__ = ["Frame", "Placed", "centroid", "is_closed", "place", "shells"]

_WELD = 1e-9  # m; corners closer than this are in one place
_EXACT = 1e-9  # of the square of a length: rounding of turns
_TO_Y = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class Frame:
    """The coordinates of a file.

    Args:
        meters_per_unit: length of one of its units [m].
        up_axis: ``"Y"`` or ``"Z"``.
    """

    meters_per_unit: float
    up_axis: str

    def pose(self, pose: Floats) -> Floats:
        """A rigid pose of the plant in this unit and up axis; it stays rigid."""
        result = pose.copy()
        result[:3, 3] /= self.meters_per_unit
        return np.asarray(_TO_Y @ result if self.up_axis == "Y" else result, np.float64)

    def points(self, solid: Solid) -> Floats:
        """The corners of a shape in this unit, in its own axes."""
        return np.asarray(solid.vertices / self.meters_per_unit, np.float64)


@dataclass(frozen=True, eq=False)
class Placed:
    """A component as most formats know it.

    Args:
        solid: its shape [m]; components of one shape share it, mirrored ones share another.
        shape: number of that shape, from 0.
        pose: ``(4, 4)`` world from local coordinates, rigid and right-handed.
    """

    solid: Solid
    shape: int
    pose: Floats


def place(plant: Plant) -> list[Placed]:
    """The components of a plant in their order; what is stretched or mirrored gets a shape of its own.

    Some modelling styles stretch a shape by its pose, which most formats have no word for.
    """
    shapes: dict[tuple[int, tuple[float, ...]], tuple[int, Solid]] = {}
    placed = []
    for component in plant.components:
        turn, stretch = _rigid(component.pose[:3, :3])
        key = (id(component.solid), tuple(np.round(stretch, 12).ravel().tolist()))
        if key not in shapes:
            change = np.eye(4)
            change[:3, :3] = stretch
            plain = np.array_equal(stretch, np.eye(3))
            shapes[key] = (len(shapes), component.solid if plain else moved(component.solid, change))
        pose = component.pose.copy()
        pose[:3, :3] = turn
        number, solid = shapes[key]
        placed.append(Placed(solid, number, pose))
    return placed


def _rigid(linear: Floats) -> tuple[Floats, Floats]:
    """A turn, and what is left to do before it (polar decomposition): ``turn @ stretch`` is ``linear``."""
    turn, stretch = linear, np.eye(3)
    if np.abs(linear.T @ linear - stretch).max() > _EXACT:
        u, sizes, v = np.linalg.svd(linear)
        turn, stretch = u @ v, v.T @ np.diag(sizes) @ v
    if np.linalg.det(turn) < 0:
        flip = np.diag([-1.0, 1.0, 1.0])
        turn, stretch = turn @ flip, flip @ stretch
    return turn, stretch


def shells(solid: Solid) -> list[Solid]:
    """The connected pieces of a mesh, in the order of their first triangles.

    They are joined by the corners that they share; by those in one place only where the mesh is not closed as it is,
    since closed pieces that touch are pieces all the same.
    """
    if not is_closed(solid):
        first, corner_of = weld_points(solid.vertices, _WELD)
        solid = Solid(solid.vertices[first], corner_of[solid.faces].astype(np.int32))
    faces = solid.faces.astype(np.int64)
    links = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]]])
    piece = first_of_component(len(solid.vertices), links)[faces[:, 0]]
    wholes = []
    for one in dict.fromkeys(piece.tolist()):
        used, corners = np.unique(faces[piece == one], return_inverse=True)
        wholes.append(Solid(solid.vertices[used], corners.reshape(-1, 3).astype(np.int32)))
    return wholes


def is_closed(solid: Solid) -> bool:
    """Whether every edge is there once in each sense."""
    faces = solid.faces.astype(np.int64)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    n = len(solid.vertices)
    forth, back = edges[:, 0] * n + edges[:, 1], edges[:, 1] * n + edges[:, 0]
    return len(np.unique(forth)) == len(forth) and bool(np.array_equal(np.sort(forth), np.sort(back)))


def centroid(vertices: Floats, faces: Faces) -> Floats:
    """``(3,)`` the centre of a surface by area; the corners' mean where it has none."""
    corners = vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not areas.sum() > 0:
        return np.asarray(vertices.mean(axis=0), np.float64)
    return np.asarray(np.average(corners.mean(axis=1), axis=0, weights=areas), np.float64)
