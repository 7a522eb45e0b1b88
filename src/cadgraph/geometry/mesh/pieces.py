"""Pieces of a mesh: what hangs together by corners in the same place."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
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
    corners = np.ascontiguousarray(vertices, np.float64)
    found = np.empty(len(faces), np.int64)
    order = np.lexsort(corners.T)
    _number_pieces(corners, order, np.ascontiguousarray(faces, np.int64), found)
    return found


@compiled
def _number_pieces(vertices: Floats, order: Ints, faces: Ints, found: Ints) -> None:
    """Joins corners by their places and by the triangles, then numbers what is joined."""
    n = len(vertices)
    # The corner that stands for all in one place, or -1; then a forest in which all of a piece have one root.
    root, number = np.full(n, -1, np.int64), np.full(n, -1, np.int64)
    before = -1
    for v in order:
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        if not abs(x) + abs(y) + abs(z) < np.inf:
            continue
        # Zeros have a sign, which is no other place: equal as numbers.
        same = before >= 0 and vertices[before, 0] == x and vertices[before, 1] == y and vertices[before, 2] == z
        root[v] = root[before] if same else v
        before = v
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        if min(a, b, c) < 0 or max(a, b, c) >= n or root[a] < 0 or root[b] < 0 or root[c] < 0:
            found[f] = -1
            continue
        found[f] = 0
        a, b, c = _root(root, a), _root(root, b), _root(root, c)
        root[b] = a
        root[_root(root, c)] = a
    count = 0
    for f in range(len(faces)):
        if found[f] < 0:
            continue
        a = _root(root, faces[f, 0])
        if number[a] < 0:
            number[a] = count
            count += 1
        found[f] = number[a]


@compiled
def _root(root: Ints, at: int) -> int:
    while root[at] != at:
        root[at] = root[root[at]]
        at = root[at]
    return at
