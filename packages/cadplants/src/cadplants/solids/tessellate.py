"""Polygons out of triangles, as CAD exporters write them: quads, concave outlines, round caps in one piece."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.components import first_of_component
from cadplants.solids.mesh_ops import Solid

__all__ = ["facets"]

_FLAT = 1e-9  # 1 - cosine of the angle between triangles of one polygon: float64 noise of faces that were built flat
_LEVEL = 1e-9  # m; how far their planes may be apart

_Ints = npt.NDArray[np.int32]


def facets(solid: Solid) -> tuple[_Ints, _Ints]:
    """Joins neighbouring triangles in one plane to polygons.

    A flat piece becomes one polygon, convex or not, where one closed way goes round it; one with holes stays in
    triangles, since no format here knows holes. The middle of a fanned cap goes unused.

    Args:
        solid: its triangles may be open, flipped or apart.

    Returns:
        ``(n,)`` how many corners each polygon has, and ``(sum,)`` their indices into the solid's vertices.
    """
    faces = solid.faces.astype(np.int64)
    corners = solid.vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(lengths, 1e-30)[:, None]
    levels = np.einsum("ij,ij->i", normals, corners[:, 0])
    n = len(solid.vertices)
    start, end = faces[:, [0, 1, 2]].ravel(), faces[:, [1, 2, 0]].ravel()
    owner = np.repeat(np.arange(len(faces)), 3)
    forth, back = start * n + end, end * n + start
    order = np.argsort(forth, kind="stable")
    # An edge that is there more than once in one sense is left as a border.
    single = np.unique(forth, return_counts=True)
    once = np.isin(forth, single[0][single[1] == 1])
    at = np.minimum(np.searchsorted(forth[order], back), len(order) - 1)
    mate = order[at]
    paired = (forth[mate] == back) & once & once[mate]
    a, b = owner[paired], owner[mate[paired]]
    level = (np.einsum("ij,ij->i", normals[a], normals[b]) > 1 - _FLAT) & (np.abs(levels[a] - levels[b]) < _LEVEL)
    level &= (lengths[a] > 0) & (lengths[b] > 0)
    group = first_of_component(len(faces), np.column_stack([a[level], b[level]]))
    inner = np.zeros(len(forth), np.bool_)
    inner[np.flatnonzero(paired)[level]] = True
    counts: list[int] = []
    indices: list[int] = []
    border: dict[int, list[tuple[int, int]]] = {}
    members: dict[int, list[int]] = {}
    for face, here in enumerate(group.tolist()):
        members.setdefault(here, []).append(face)
    for edge in np.flatnonzero(~inner).tolist():
        border.setdefault(int(group[owner[edge]]), []).append((int(start[edge]), int(end[edge])))
    for here, triangles in members.items():
        ring = _ring(border.get(here, [])) if len(triangles) > 1 else None
        if ring is None:
            counts += [3] * len(triangles)
            indices += faces[triangles].ravel().tolist()
        else:
            counts.append(len(ring))
            indices += ring
    return np.array(counts, np.int32), np.array(indices, np.int32)


def _ring(edges: list[tuple[int, int]]) -> list[int] | None:
    """The one closed way along all these edges, each corner once; None where there is no such way."""
    following = dict(edges)
    if len(following) != len(edges) or len(edges) < 3:
        return None
    first = edges[0][0]
    ring, here = [first], following[first]
    while here != first:
        if here not in following or len(ring) == len(edges):
            return None
        ring.append(here)
        here = following[here]
    return ring if len(ring) == len(edges) else None
