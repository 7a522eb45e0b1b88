"""The separate solids in one bag of triangles, told apart by the edges that their triangles share."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.components import first_of_component
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["split_bodies", "split_shells"]

_Edges = tuple[Ints, Ints, Bools]

_BROKEN = 4  # a surface comes in more pieces than this, on average: the triangles of surfaces alternate in the file


def split_bodies(points: npt.NDArray[np.floating], faces: Faces) -> list[Ints]:
    """The triangles of each solid of one product, where all are closed.

    Where solids touch along an edge, four triangles meet there; converters write solid after solid, so the first two of
    them belong together. A closed shell that faces inward is a void and stays with the smallest solid around it.

    Args:
        points: ``(n, 3)``, each place once.
        faces: ``(m, 3)`` in the order of the converter.

    Returns:
        Triangle numbers of each solid, in the order of their first triangle; one entry with all triangles where they
        can't be told apart with certainty (open surfaces, for example).
    """
    whole = [np.arange(len(faces))]
    shells, closed = _shells(faces, _edges(faces, len(points)))
    if len(closed) < 2 or not closed.all():
        return whole
    volumes = _volumes(points, faces, shells, len(closed))
    owner, certain = _with_voids(points, faces, shells, closed, volumes)
    return _members(owner) if certain else whole


def split_shells(points: npt.NDArray[np.floating], faces: Faces) -> list[Ints]:
    """The triangles of each connected surface, open or closed, of a whole scene in one mesh.

    Like ``split_bodies``, but open surfaces are told apart, too. Where the triangles of different surfaces alternate in
    the file, edges with more than two triangles are paired by the wedges of material between these instead.

    Args:
        points: ``(n, 3)``, each place once.
        faces: ``(m, 3)`` in the order of the file.

    Returns:
        Triangle numbers of each surface, in the order of their first triangle.
    """
    edges = _edges(faces, len(points))
    twice = _used_twice(edges[0])
    certain, of_certain = _shells(faces, (edges[0][twice], edges[1][twice], edges[2][twice]))
    interleaved = np.count_nonzero(np.diff(certain)) > _BROKEN * len(of_certain)
    shells, closed = _shells(faces, _by_wedge(points, faces, edges) if interleaved else edges)
    volumes = _volumes(points, faces, shells, len(closed))
    inside_out = np.count_nonzero(volumes[closed] <= 0) > np.count_nonzero(closed) / 2
    return _members(_with_voids(points, faces, shells, closed, -volumes if inside_out else volumes)[0])


def _members(owner: Ints) -> list[Ints]:
    order = np.argsort(owner, kind="stable")
    cuts = np.flatnonzero(np.diff(owner[order])) + 1
    return sorted(np.split(order, cuts), key=lambda triangles: int(triangles[0]))


def _edges(faces: Faces, n_points: int) -> _Edges:
    """All uses of edges, those of one edge together in the order of the file: the edge's key, the triangle that uses
    it, and whether it does so from the lower to the higher point.
    """
    m = len(faces)
    start, end = faces.T.reshape(-1).astype(np.int64), np.roll(faces, -1, axis=1).T.reshape(-1).astype(np.int64)
    owner = np.tile(np.arange(m), 3)
    key = np.minimum(start, end) * n_points + np.maximum(start, end)
    order = np.lexsort((owner, key))
    return key[order], owner[order], (start < end)[order]


def _used_twice(key: Ints) -> Bools:
    """Of each use whether its edge has exactly two."""
    same = key[1:] == key[:-1]
    before, after = np.concatenate([[False], same]), np.concatenate([same, [False]])
    more = np.zeros(len(key), np.bool_)
    more[2:] |= before[2:] & before[1:-1]
    more[:-2] |= after[:-2] & after[1:-1]
    more[1:-1] |= before[1:-1] & after[1:-1]
    used: Bools = (before | after) & ~more
    return used


def _by_wedge(points: npt.NDArray[np.floating], faces: Faces, edges: _Edges) -> _Edges:
    """The uses of each edge in another order: around it, so that the two that enclose material follow each other."""
    key, owner, forward = edges
    n_points = len(points)
    low, high = key // n_points, key % n_points
    third = faces[owner].sum(axis=1, dtype=np.int64) - low - high
    p = points.astype(np.float64)
    along = p[high] - p[low]
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    side = np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)])
    side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-300)
    out = p[third] - p[low]
    # Counter-clockwise about the edge: a backward triangle has material after it, a forward one before it.
    angle = np.arctan2((out * np.cross(along, side)).sum(axis=1), (out * side).sum(axis=1))
    order = np.lexsort((angle, key))
    key, owner, forward = key[order], owner[order], forward[order]
    # Each edge begins with a backward use; where its first is forward, that goes last.
    first = np.concatenate([[True], key[1:] != key[:-1]])
    run = np.cumsum(first) - 1
    rank = np.arange(len(key)) - np.flatnonzero(first)[run]
    rank = np.where((rank == 0) & forward, np.bincount(run)[run], rank)
    order = np.lexsort((rank, key))
    return key[order], owner[order], forward[order]


def _shells(faces: Faces, edges: _Edges) -> tuple[Ints, Bools]:
    """The connected surface that each triangle belongs to, ``0..n - 1``, and whether each of them is closed.

    Triangles hang together at an edge that two of them use; of more uses, each two that follow each other.
    """
    m = len(faces)
    key, owner, forward = edges
    if not m:
        return np.zeros(0, np.int64), np.zeros(0, np.bool_)
    first = np.flatnonzero(np.concatenate([[True], key[1:] != key[:-1]]))
    length = np.diff(np.append(first, len(key)))
    rank = np.arange(len(key)) - np.repeat(first, length)
    even = np.flatnonzero((rank % 2 == 0) & (rank + 1 < np.repeat(length, length)))
    shells = first_of_component(m, np.column_stack([owner[even], owner[even + 1]]))
    number, shell = np.unique(shells, return_inverse=True)
    shell = shell.reshape(-1).astype(np.int64)
    # Closed: every edge an even number of times, its uses in pairs of opposite sense.
    paired = np.zeros(len(key), np.bool_)
    opposite = even[forward[even] != forward[even + 1]]
    paired[opposite], paired[opposite + 1] = True, True
    closed = np.ones(len(number), np.bool_)
    closed[shell[owner[~paired]]] = False
    return shell, closed


def _volumes(points: npt.NDArray[np.floating], faces: Faces, shells: Ints, n: int) -> Floats:
    """``(n,)`` what each shell encloses, as far as it is closed; negative where it faces inward."""
    corners = points[faces].astype(np.float64) - points.mean(axis=0)
    volumes: Floats = np.bincount(shells, np.linalg.det(corners) / 6, n).astype(np.float64)
    return volumes


def _with_voids(
    points: npt.NDArray[np.floating], faces: Faces, shells: Ints, closed: Bools, volumes: Floats
) -> tuple[Ints, bool]:
    """The shells with each void in the number of the smallest solid around it; and whether each void has one."""
    n = len(closed)
    corners = points[faces].astype(np.float64)
    low: Floats = np.full((n, 3), np.inf)
    high: Floats = np.full((n, 3), -np.inf)
    np.minimum.at(low, shells, corners.min(axis=1))
    np.maximum.at(high, shells, corners.max(axis=1))
    owner = np.arange(n)
    solids = np.flatnonzero(closed & (volumes > 0))
    certain = True
    for void in np.flatnonzero(closed & (volumes <= 0)):
        around = solids[(low[solids] <= low[void]).all(axis=1) & (high[solids] >= high[void]).all(axis=1)]
        if len(around):
            owner[void] = around[np.argmin(volumes[around])]
        else:
            certain = False
    return owner[shells], certain
