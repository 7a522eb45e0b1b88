"""Pieces of a mesh: what hangs together by corners in the same place."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["pieces_of"]


def pieces_of(vertices: Floats, faces: Faces) -> Ints:
    """The piece of a mesh that each of its triangles belongs to.

    Corners are in the same place where their coordinates are equal, whether or not they share a vertex.

    Args:
        vertices: ``(n, 3)`` [m].
        faces: ``(m, 3)`` vertices of each triangle.

    Returns:
        ``(m,)`` numbers of pieces from 0 on, in the order of their first triangles; -1 for triangles with a corner that
        isn't there or is not finite.
    """
    there = np.asarray(((faces >= 0) & (faces < len(vertices))).all(axis=1))
    finite = np.asarray(np.isfinite(vertices).all(axis=1))
    there[there] = finite[faces[there]].all(axis=1)
    found = np.full(len(faces), -1, np.int64)
    rows = faces[there]
    if not len(rows):
        return found
    # Zeros have a sign, which is no other place.
    used, corner = np.unique(rows, return_inverse=True)
    _, place = np.unique(vertices[used] + 0.0, axis=0, return_inverse=True)
    corners = place.reshape(-1)[corner.reshape(-1, 3)]
    pairs = np.concatenate([corners[:, :2], corners[:, 1:]])
    n = int(corners.max()) + 1
    joined = connected_components(coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n)))[1]
    of_face = joined[corners[:, 0]]
    _, first, number = np.unique(of_face, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    found[there] = rank[number.reshape(-1)]
    return found
