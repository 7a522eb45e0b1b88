"""How the faces of each mesh meet: angles along their common edges, free edges, pieces and holes."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.components import first_of_component
from cadgraph.geometry.mesh.merge import row_keys
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face

__all__ = ["EDGE_FEATURES", "edge_features"]

_LIMITS = np.radians([1.0, 6.0, 14.0, 26.0, 38.0, 52.0, 68.0, 82.0, 98.0])
"""Borders of the classes of angles: 60 and 90 degrees have classes of their own (nuts, boxes), and so have the sides of
round walls of 6 to 64 sides."""

EDGE_FEATURES: tuple[tuple[str, int], ...] = (("edge angle", 9), ("free edges", 1), ("odd edges", 1), ("pieces", 1),
                                              ("holes", 1))  # fmt: skip
"""Blocks of numbers and their sizes."""

_WELD = 1e-5  # corners closer than this share of the mesh's size are one


def edge_features(scene: Scene) -> Floats:
    """Describes the edges of each mesh, corners in one place being one vertex.

    Args:
        scene: any.

    Returns:
        ``(n_meshes, sum of the sizes in EDGE_FEATURES)``: shares of the length of all edges that are no mere
        subdivision of a plane, by angle; of free edges and of edges with more than two faces; logarithms of the numbers
        of pieces and of handles.
    """
    n, width = scene.n_meshes, sum(size for _, size in EDGE_FEATURES)
    if not n or not len(scene.faces):
        return np.zeros((n, width))
    triangles = scene.triangles()
    owner = mesh_of_face(scene)
    corner = _welded(triangles, owner, n)
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(double, 1e-300)[:, None]
    good = (corner[:, 0] != corner[:, 1]) & (corner[:, 1] != corner[:, 2]) & (corner[:, 0] != corner[:, 2])
    corner, triangles, normals, owner = corner[good], triangles[good], normals[good], owner[good]
    if not len(corner):
        return np.zeros((n, width))
    sides = np.stack([corner, np.roll(corner, -1, axis=1)], axis=2).reshape(-1, 2)
    long = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2).reshape(-1)
    low, high = sides.min(axis=1), sides.max(axis=1)
    order = np.lexsort((high, low))
    start = np.concatenate([[True], (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)])
    edge = np.cumsum(start) - 1
    count = np.bincount(edge)
    first = order[np.nonzero(start)[0]]
    two = np.nonzero(count == 2)[0]
    a, b = first[two] // 3, order[np.nonzero(start)[0][two] + 1] // 3
    cosine = np.clip(np.einsum("ij,ij->i", normals[a], normals[b]), -1, 1)
    # Faces of odd orientation: neighbours that run through their edge in the same sense look the other way.
    same = sides[first[two], 0] == sides[order[np.nonzero(start)[0][two] + 1], 0]
    angle = np.arccos(np.where(same, -cosine, cosine))
    mesh = owner[first // 3]
    rows = np.zeros((n, width))
    kind = np.searchsorted(_LIMITS, angle)  # 0: flat
    there = kind > 0
    np.add.at(rows, (mesh[two][there], kind[there] - 1), long[first[two]][there])
    np.add.at(rows[:, 9], mesh[count == 1], long[first][count == 1])
    np.add.at(rows[:, 10], mesh[count > 2], long[first][count > 2])
    rows[:, :11] /= np.maximum(rows[:, :11].sum(axis=1, keepdims=True), 1e-12)
    rows[:, 11:] = _topology(corner, sides, owner, mesh, n)
    return rows


def _welded(triangles: Floats, owner: Ints, n: int) -> Ints:
    """A number for each place of each mesh, ``(n_faces, 3)``."""
    points = triangles.reshape(-1, 3)
    mesh = np.repeat(owner, 3)
    low, high = np.full((n, 3), np.inf), np.full((n, 3), -np.inf)
    np.minimum.at(low, mesh, points)
    np.maximum.at(high, mesh, points)
    size = np.linalg.norm(np.where(np.isfinite(high - low), high - low, 0), axis=1)
    grid = np.round((points - low[mesh]) / np.maximum(_WELD * size, 1e-9)[mesh, None]).astype(np.int64)
    # Numbered by key: in that order edges are added up, and the model has learnt these sums to the last bit.
    return np.unique(row_keys(grid, mesh), return_inverse=True)[1].reshape(-1, 3)


def _topology(corner: Ints, sides: Ints, owner: Ints, mesh_of_edge: Ints, n: int) -> Floats:
    """Logarithms of the numbers of pieces and of handles (Euler's formula) of each mesh."""
    n_vertices = int(corner.max()) + 1
    piece = first_of_component(n_vertices, sides)
    mesh_of_vertex = np.full(n_vertices, -1)
    mesh_of_vertex[corner.reshape(-1)] = np.repeat(owner, 3)
    used = mesh_of_vertex >= 0
    pieces = np.bincount(mesh_of_vertex[used][np.unique(piece[used], return_index=True)[1]], minlength=n)
    euler = np.bincount(mesh_of_vertex[used], minlength=n) - np.bincount(mesh_of_edge, minlength=n)
    euler = euler + np.bincount(owner, minlength=n)
    handles = np.maximum(pieces - euler / 2, 0)
    return np.column_stack([np.log(np.maximum(pieces, 1)), np.log1p(handles)])
