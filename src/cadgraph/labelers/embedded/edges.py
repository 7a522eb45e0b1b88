"""How the faces of each mesh meet: how much of its surface turns at which angles, inward or outward."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.mesh.merge import row_keys
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face

__all__ = ["EDGE_FEATURES", "edge_features"]

_CLASSES = np.radians([15.0, 45.0, 60.0, 75.0, 90.0, 120.0, 160.0])
"""Middles of the classes of angles: whatever is smooth, and 45, 60 and 90 degrees by themselves (nuts, boxes)."""
_FOLDED = np.radians(170.0)
_FLAT = np.radians(0.2)  # faces that meet at less than this are one plane, cut up

EDGE_FEATURES: tuple[tuple[str, int], ...] = (
    ("bend", len(_CLASSES)), ("hollow bend", 2), ("bend in all", 1),
)  # fmt: skip
"""Blocks of numbers and their sizes."""

_WELD = 1e-5  # corners closer than this share of the mesh's size are one


def edge_features(scene: Scene, properties: Properties) -> Floats:
    """Describes the edges of each mesh, corners in one place being one vertex and equal triangles one.

    An edge counts by its length times the angle by which the surface turns there: a round wall turns by as much
    whatever the number of its sides, and what only cuts up a plane doesn't turn at all.

    Args:
        scene: any.
        properties: of its meshes.

    Returns:
        ``(n_meshes, sum of the sizes in EDGE_FEATURES)``: shares of all turning by angle; shares that turn inward,
        smoothly and sharply (of meshes that are not closed the lesser of inward and outward); half of ``log(1 + x)``
        of all turning over the size of the box.
    """
    n, width = scene.n_meshes, sum(size for _, size in EDGE_FEATURES)
    rows = np.zeros((n, width))
    corner, triangles, owner = _distinct(scene)
    if not len(corner):
        return rows
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals = cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None]
    sides = np.stack([corner, np.roll(corner, -1, axis=1)], axis=2).reshape(-1, 2)
    long = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2).reshape(-1)
    low, high = sides.min(axis=1), sides.max(axis=1)
    order = np.lexsort((high, low))
    start = np.concatenate([[True], (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)])
    head = np.nonzero(start)[0]
    count = np.diff(np.append(head, len(order)))
    first = order[head]
    mesh, size = owner[first // 3], np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-12)
    two = np.nonzero(count == 2)[0]
    angle, inward = _turns(sides, normals, triangles, first[two], order[head[two] + 1], properties, owner)
    bent = angle > _FLAT
    turn = (long[first[two]] * angle)[bent]
    at = mesh[two][bent]
    place = np.clip(np.interp(angle[bent], _CLASSES, np.arange(len(_CLASSES))), 0, len(_CLASSES) - 1)
    below = np.minimum(place.astype(np.int64), len(_CLASSES) - 2)
    np.add.at(rows, (at, below), turn * (1 - (place - below)))
    np.add.at(rows, (at, below + 1), turn * (place - below))
    k = len(_CLASSES)
    smooth = np.clip(1 - place, 0, 1)
    np.add.at(rows[:, k], at, turn * smooth * inward[bent])
    np.add.at(rows[:, k + 1], at, turn * (1 - smooth) * inward[bent])
    total = rows[:, :k].sum(axis=1)
    rows[:, : k + 2] /= np.maximum(total, 1e-12)[:, None]
    unsure = ~properties.closed
    halves = np.stack([rows[:, 0], 1 - rows[:, 0]], axis=1)
    for column in (0, 1):
        mine = rows[:, k + column]
        rows[:, k + column] = np.where(unsure, np.minimum(mine, np.abs(halves[:, column] - mine)), mine)
    rows[:, k + 2] = np.log1p(total / (np.pi * size)) / 2
    return rows


def _distinct(scene: Scene) -> tuple[Ints, Floats, Ints]:
    """Places of the corners ``(n, 3)``, corners ``(n, 3, 3)`` and mesh of each triangle that has an area, once each."""
    if not len(scene.faces):
        return np.zeros((0, 3), np.int64), np.zeros((0, 3, 3)), np.zeros(0, np.int64)
    triangles, owner = scene.triangles(), mesh_of_face(scene)
    corner = _welded(triangles, owner, scene.n_meshes)
    good = (corner[:, 0] != corner[:, 1]) & (corner[:, 1] != corner[:, 2]) & (corner[:, 0] != corner[:, 2])
    corner, triangles, owner = corner[good], triangles[good], owner[good]
    if len(corner):
        once = np.sort(np.unique(row_keys(np.sort(corner, axis=1), owner), return_index=True)[1])
        corner, triangles, owner = corner[once], triangles[once], owner[once]
    return corner, triangles, owner


def _turns(
    sides: Ints, normals: Floats, triangles: Floats, one: Ints, other: Ints, properties: Properties, owner: Ints
) -> tuple[Floats, Floats]:
    """The angle by which the surface turns at edges of two faces [rad], and how far that is inward (0 or 1)."""
    a, b = one // 3, other // 3
    # Faces of odd orientation: neighbours that run through their edge in the same sense look the other way.
    sense = np.where(sides[one, 0] == sides[other, 0], -1.0, 1.0)
    cosine = np.clip(np.einsum("ij,ij->i", normals[a], normals[b]) * sense, -1, 1)
    # arccos is blunt near 0: the sine of small angles is exact.
    sine = np.linalg.norm(np.cross(normals[a], normals[b]), axis=1)
    angle = np.arctan2(sine, cosine)
    # The third corner of the other face lies above the plane of this one: a hollow.
    third = triangles[b, (other % 3 + 2) % 3] - triangles[a, 0]
    above = np.einsum("ij,ij->i", third, normals[a]) > 0
    inside_out = properties.closed[owner[a]] & (properties.volume[owner[a]] < 0)
    # A face folded back onto its neighbour is neither; between faces of odd orientation nobody knows.
    inward = ((above != inside_out) & (angle < _FOLDED)).astype(np.float64)
    return angle, np.where(sense < 0, 0.5, inward)


def _welded(triangles: Floats, owner: Ints, n: int) -> Ints:
    """A number for each place of each mesh, ``(n_faces, 3)``."""
    points = triangles.reshape(-1, 3)
    mesh = np.repeat(owner, 3)
    low, high = np.full((n, 3), np.inf), np.full((n, 3), -np.inf)
    np.minimum.at(low, mesh, points)
    np.maximum.at(high, mesh, points)
    size = np.linalg.norm(np.where(np.isfinite(high - low), high - low, 0), axis=1)
    grid = np.round((points - low[mesh]) / np.maximum(_WELD * size, 1e-9)[mesh, None]).astype(np.int64)
    return np.unique(row_keys(grid, mesh), return_inverse=True)[1].reshape(-1, 3)
