"""Facet groups (kind 11): polygons with holes to triangles.

A group is the number of its polygons; a polygon the number of its contours, the first one its outline; a contour the
number of its corners; a corner a point [mm] and a normal.
"""

from __future__ import annotations

from typing import NamedTuple

import mapbox_earcut
import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.load.polygons import triangulate
from cadgraph.load.rvm.chunks import Words
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["triangles_of"]

_WELD = 1e-3  # [mm] corners closer than this are one: what float32 leaves of equal points in real files
_FAN_CORNERS = 16  # outlines up to this size are cut all at once where a fan does it
_BEYOND = 1e12  # [mm] no point of a plant


class _Polygon(NamedTuple):
    first: int  # corner
    ends: list[int]  # of each contour, counted from the first corner


def triangles_of(words: Words) -> tuple[Floats, Faces]:
    """The triangles of one group.

    Polygons are cut in their own plane and joined where their corners coincide. Where these then close a solid, they
    are right as they are wound, but for turning it inside out; else each is turned so that it agrees with its normals,
    which real files also hold the wrong way round.

    Args:
        words: of the group, from the number of its polygons on.

    Returns:
        Points ``(n, 3)`` [mm] and triangles ``(m, 3)``; maybe none.

    Raises:
        ValueError: a count is larger than what follows, or a point is not finite.
    """
    polygons, at = _polygons(words)
    if not len(at):
        return np.zeros((0, 3)), np.zeros((0, 3), np.int32)
    values = words[at[:, None] + np.arange(6)].view(">f4").astype(np.float64)
    points, normals = values[:, :3] + 0.0, values[:, 3:]
    if not (np.abs(points) < _BEYOND).all():
        raise ValueError("a point is not finite")
    first, place = weld_points(points, _WELD)
    cut, owner = _cut(points, polygons)
    faces = _whole(place[cut])
    if _is_closed(faces, len(first)):
        faces = faces[:, ::-1] if _volume(points[first], faces) < 0 else faces
    else:
        faces = _whole(place[_agreeing(points, np.where(np.isfinite(normals), normals, 0), cut, owner)])
    used, renumbered = np.unique(faces, return_inverse=True)
    return points[first[used]], renumbered.reshape(-1, 3).astype(np.int32)


def _polygons(words: Words) -> tuple[list[_Polygon], Ints]:
    """All polygons, and where each of their corners stands [words]."""
    values = words.tolist() if len(words) < 64 else words
    total = len(words)
    if not total:
        raise ValueError("it has no room for its polygons")
    n_polygons, at = int(values[0]), 1
    if n_polygons > total:
        raise ValueError(f"it claims {n_polygons} polygons, more than its part of the file can hold")
    polygons, corners, n_corners = [], [], 0
    for _ in range(n_polygons):
        if at >= total:
            raise ValueError("it ends amid its polygons")
        n_contours, at = int(values[at]), at + 1
        if n_contours > total - at:
            raise ValueError(f"a polygon claims {n_contours} contours, more than its part of the file can hold")
        polygon = _Polygon(n_corners, [])
        for _ in range(n_contours):
            if at >= total:
                raise ValueError("it ends amid a polygon")
            n, at = int(values[at]), at + 1
            if 6 * n > total - at:
                raise ValueError(f"a contour claims {n} corners, more than its part of the file can hold")
            corners.append(at + 6 * np.arange(n))
            n_corners, at = n_corners + n, at + 6 * n
            polygon.ends.append(n_corners - polygon.first)
        polygons.append(polygon)
    return polygons, np.concatenate(corners).astype(np.int64) if corners else np.zeros(0, np.int64)


def _cut(points: Floats, polygons: list[_Polygon]) -> tuple[Ints, Ints]:
    """Triangles of all polygons, ``(m, 3)`` corner numbers wound as in the file, and the polygon of each."""
    sizes = np.array([polygon.ends[0] if len(polygon.ends) == 1 else 0 for polygon in polygons], np.int64)
    simple = np.flatnonzero((sizes >= 3) & (sizes <= _FAN_CORNERS))
    counts = sizes[simple]
    starts = np.cumsum(counts) - counts
    firsts = np.array([polygon.first for polygon in polygons], np.int64)
    corners = np.repeat(firsts[simple] - starts, counts) + np.arange(int(counts.sum()))
    made = triangulate(points, counts, starts, corners, simple)
    triangles, owner = [made.corners.astype(np.int64).reshape(-1, 3)], [made.polygon]
    for number, polygon in enumerate(polygons):
        if len(polygon.ends) > 1 or (polygon.ends and polygon.ends[0] > _FAN_CORNERS):
            triangles.append(_ears(points, polygon))
            owner.append(np.full(len(triangles[-1]), number))
    return np.concatenate(triangles), np.concatenate(owner).astype(np.int64)


def _whole(faces: Ints) -> Ints:
    """The triangles with three different corners."""
    a, b, c = faces.T
    kept: Ints = faces[(a != b) & (b != c) & (c != a)]
    return kept


def _is_closed(faces: Ints, n_points: int) -> bool:
    """Whether every edge is used as often one way as the other."""
    start, end = faces[:, [0, 1, 2]].reshape(-1), faces[:, [1, 2, 0]].reshape(-1)
    return bool(np.array_equal(np.sort(start * n_points + end), np.sort(end * n_points + start)))


def _volume(points: Floats, faces: Ints) -> float:
    a, b, c = (points[faces[:, i]] - points[0] for i in range(3))
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6


def _agreeing(points: Floats, normals: Floats, faces: Ints, owner: Ints) -> Ints:
    """The triangles, those of a polygon turned over together where it looks against its normals."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    against = np.einsum("ij,ij->i", np.cross(b - a, c - a), normals[faces].sum(axis=1))
    turned = np.bincount(owner, against)[owner] < 0 if len(faces) else np.zeros(0, bool)
    out: Ints = np.where(turned[:, None], faces[:, ::-1], faces)
    return out


def _ears(points: Floats, polygon: _Polygon) -> Ints:
    """Triangles of a polygon with holes or many corners."""
    n = polygon.ends[-1]
    if n < 3 or polygon.ends[0] < 3:
        return np.zeros((0, 3), np.int64)
    at = points[polygon.first : polygon.first + n]
    outline = at[: polygon.ends[0]] - at[0]
    # The mean normal (Newell); that of the outline, whatever its holes.
    normal = np.cross(outline, np.roll(outline, -1, axis=0)).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0:
        return np.zeros((0, 3), np.int64)
    normal /= length
    side = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    side /= np.linalg.norm(side)
    flat: npt.NDArray[np.float64] = np.column_stack([(at - at[0]) @ side, (at - at[0]) @ np.cross(normal, side)])
    ends = np.array(polygon.ends, np.uint32)
    triangles = mapbox_earcut.triangulate_float64(np.ascontiguousarray(flat), ends).reshape(-1, 3).astype(np.int64)
    # The library turns its triangles one way, whichever way the outline goes.
    corner = flat[triangles]
    u, v = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    clockwise = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
    out: Ints = polygon.first + np.where(clockwise[:, None], triangles[:, ::-1], triangles)
    return out
