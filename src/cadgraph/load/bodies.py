"""The separate solids in one bag of triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.components import first_of_component
from cadgraph.model.scene import Faces, Ints

__all__ = ["split_bodies"]


def split_bodies(points: npt.NDArray[np.floating], faces: Faces) -> list[Ints]:
    """The triangles of each solid.

    Two solids of one product are told apart where each is closed and faces outward. Where solids touch along an edge,
    four triangles meet there; converters write solid after solid, so the first two of them belong together. A closed
    shell that faces inward is a void and stays with the smallest solid around it.

    Args:
        points: ``(n, 3)``, each place once.
        faces: ``(m, 3)`` in the order of the converter.

    Returns:
        Triangle numbers of each solid, in the order of their first triangle; one entry with all triangles where they
        can't be told apart with certainty (open surfaces, for example).
    """
    whole = [np.arange(len(faces))]
    shells, closed = _shells(faces, len(points))
    n = int(shells.max()) + 1 if len(shells) else 0
    if n < 2 or not closed:
        return whole
    corners = points[faces].astype(np.float64) - points.mean(axis=0)
    volumes = np.bincount(shells, np.linalg.det(corners) / 6, n)
    low = np.full((n, 3), np.inf)
    high = np.full((n, 3), -np.inf)
    np.minimum.at(low, shells, corners.min(axis=1))
    np.maximum.at(high, shells, corners.max(axis=1))
    owner = np.arange(n)
    solids = np.flatnonzero(volumes > 0)
    for void in np.flatnonzero(volumes <= 0):
        around = solids[(low[solids] <= low[void]).all(axis=1) & (high[solids] >= high[void]).all(axis=1)]
        if not len(around):
            return whole
        owner[void] = around[np.argmin(volumes[around])]
    bodies = [np.flatnonzero(owner[shells] == solid) for solid in solids]
    return sorted(bodies, key=lambda triangles: int(triangles[0]))


def _shells(faces: Faces, n_points: int) -> tuple[Ints, bool]:
    """The connected surface that each triangle belongs to, and whether all are closed."""
    m = len(faces)
    start, end = faces.T.reshape(-1).astype(np.int64), np.roll(faces, -1, axis=1).T.reshape(-1).astype(np.int64)
    owner = np.tile(np.arange(m), 3)
    key = np.minimum(start, end) * n_points + np.maximum(start, end)
    order = np.lexsort((owner, key))
    key, owner, forward = key[order], owner[order], (start < end)[order]
    if len(key) % 2:
        return np.zeros(m, np.int64), False
    a, b = slice(0, None, 2), slice(1, None, 2)
    # Every edge an even number of times, its uses in pairs of opposite sense: closed.
    if (key[a] != key[b]).any() or (forward[a] == forward[b]).any():
        return np.zeros(m, np.int64), False
    shells = first_of_component(m, np.column_stack([owner[a], owner[b]]))
    return np.unique(shells, return_inverse=True)[1], True
