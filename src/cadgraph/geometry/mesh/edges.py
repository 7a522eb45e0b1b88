"""Which corners of triangles are one, and which sides are one edge."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cadgraph.geometry.kernels.distinct import in_groups, number_rows
from cadgraph.model.scene import Floats, Ints

__all__ = ["Edges", "edges_of", "places_of"]


class Edges(NamedTuple):
    """The edges of triangles, in the order in which they come first.

    Args:
        starts: ``(n_edges + 1,)`` where the sides at each edge start.
        sides: ``(3 * n_faces,)`` sides, numbered by face and corner: side ``3 * f + k`` goes from corner ``k`` of face
            ``f`` to the next one. They ascend within each edge.
    """

    starts: Ints
    sides: Ints

    @property
    def sizes(self) -> Ints:
        """``(n_edges,)`` how many sides each edge has."""
        sizes: Ints = np.diff(self.starts)
        return sizes


def places_of(cells: Floats, owner: Ints) -> Ints:
    """Welds corners that lie in one cell of a grid.

    Args:
        cells: ``(3 * n_faces, 3)`` of each corner, in cells.
        owner: ``(n_faces,)`` mesh of each face; those of two are never one.

    Returns:
        ``(n_faces, 3)`` the place of each corner, as a number of its own.
    """
    rows = np.empty((len(cells), 4), np.int64)
    rows[:, :3], rows[:, 3] = np.round(cells), np.repeat(owner, 3)
    return number_rows(rows)[1].reshape(-1, 3)


def edges_of(corner: Ints) -> Edges:
    """Finds the edges of triangles.

    Args:
        corner: ``(n_faces, 3)`` the place of each corner, as a number of its own.
    """
    ends = np.stack([corner, np.roll(corner, -1, axis=1)], axis=2).reshape(-1, 2)
    ends.sort(axis=1)
    first, edge = number_rows(ends)
    return Edges(*in_groups(edge, len(first)))
