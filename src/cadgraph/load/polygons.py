"""Polygons to triangles: all at once where a fan does it, ear by ear where not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.ears import clip_ears, double_area
from cadgraph.model.scene import Floats, Ints

__all__ = ["Indices", "Triangles", "triangulate"]

_FLAT = 1e-6  # a fan may hold a triangle this share of the polygon below zero: float32 noise of collinear corners
_NO_TURN = 1e-12  # a corner whose triangle has less than this share of the polygon's area does not turn
_OVERLAP = 1e-4  # triangles that cover this share more than the polygon's area overlap: the polygon crosses itself
_MANY_CORNERS = 16  # polygons up to this size try every corner as the apex of a fan (work grows with the square)

_CHUNK = 16_384  # quads looked at together: their corners, of 1.6 MB, stay in the processor's cache

Indices = npt.NDArray[np.integer]  # of 32 or 64 bits
Points = npt.NDArray[np.floating]
Rows = tuple[Floats, Floats, Floats]
Ring = list[tuple[float, float]]


@dataclass(frozen=True)
class Triangles:
    """Triangles cut from polygons.

    Args:
        corners: ``(n, 3)`` point indices, wound like their polygons.
        polygon: ``(n,)`` the polygon each comes from, ascending.
        twisted: polygons that cross themselves; their triangles are a best effort.
    """

    corners: Indices
    polygon: Ints
    twisted: Ints


def triangulate(points: Points, counts: Indices, starts: Ints, indices: Ints, polygons: Ints) -> Triangles:
    """Cuts polygons into triangles with the same boundary and no new points.

    Convex polygons, and those that some corner sees whole, become fans; the others are clipped ear by ear in the
    plane of their mean normal (Newell). Triangles that use a point twice are left out.

    Args:
        points: ``(n_points, 3)``, finite.
        counts: ``(n,)`` corners of each polygon, at least 3.
        starts: ``(n,)`` where each begins in ``indices``; they don't overlap.
        indices: point indices, in range.
        polygons: ``(n,)`` ascending numbers that the result uses for the polygons.

    Returns:
        The triangles, sorted by polygon.
    """
    corners, owners, twisted = [], [], []
    for n in np.flatnonzero(np.bincount(counts)) if len(counts) else ():
        of_size = np.flatnonzero(counts == n)
        if len(of_size) * n == len(indices):
            rings = indices.reshape(-1, n)
        else:
            rings = indices[starts[of_size, None] + np.arange(n)]
        if n == 3:
            corners.append(rings)
            owners.append(of_size)
            continue
        cut, left = _quad_fans(points, rings) if n == 4 else _fans(points, rings)
        if len(left):
            fan = np.setdiff1d(np.arange(len(rings)), left, assume_unique=True)
            cut, of_fan = cut[fan], of_size[fan]
        else:
            of_fan = of_size
        corners.append(cut.reshape(-1, 3))
        owners.append(np.repeat(of_fan, n - 2))
        for i in left:
            ears, clean = _clip_ears(points[rings[i]].astype(np.float64))
            corners.append(rings[i][ears])
            owners.append(np.full(len(ears), of_size[i]))
            if not clean:
                twisted.append(of_size[i])
    if not corners:
        return Triangles(np.zeros((0, 3), np.int64), np.zeros(0, np.int64), np.zeros(0, np.int64))
    triangle, owner = np.concatenate(corners), np.concatenate(owners)
    if len(owners) > 1:
        order = np.argsort(owner, kind="stable")
        triangle, owner = triangle[order], owner[order]
    a, b, c = np.ascontiguousarray(triangle.T)
    whole = (a != b) & (b != c) & (c != a)
    if not whole.all():
        triangle, owner = triangle[whole], owner[whole]
    return Triangles(triangle, polygons[owner], polygons[np.array(sorted(twisted), np.int64)])


def _quad_fans(points: Points, rings: Ints) -> tuple[Ints, Ints]:
    """``(m, 2, 3)`` triangles along the diagonal that lies inside, and the quads where neither does."""
    triangles = np.take(rings, [0, 1, 2, 0, 2, 3], axis=1)
    left = []
    for start in range(0, len(rings), _CHUNK):
        chunk = slice(start, start + _CHUNK)
        # x, y and z of each corner as rows: long contiguous rows are what numpy is fast on.
        x, y, z = np.take(points, rings[chunk], axis=0).transpose(2, 1, 0).astype(np.float64, order="C")
        bent, second, crossed = _bent_quads(x, y, z)
        triangles[start + bent[second]] = rings[start + bent[second]][:, [1, 2, 3, 1, 3, 0]]
        left.append(start + bent[crossed])
    return triangles.reshape(-1, 2, 3), np.concatenate(left)


def _bent_quads(x: Floats, y: Floats, z: Floats) -> tuple[Ints, npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """The quads whose first diagonal lies outside, which of them the second suits better, and which neither suits.

    Args:
        x: ``(4, n)`` of their corners.
        y: likewise.
        z: likewise.
    """
    across, other = (x[2] - x[0], y[2] - y[0], z[2] - z[0]), (x[3] - x[1], y[3] - y[1], z[3] - z[1])
    normal = _cross3(across, other)
    whole = _dot(normal, normal)
    # Twice the signed areas of the two triangles of a diagonal add up to the whole: the lesser one decides.
    one = _dot(_cross3((x[1] - x[0], y[1] - y[0], z[1] - z[0]), across), normal)
    first = np.minimum(one, whole - one)
    bent = np.flatnonzero(first < -_FLAT * whole)
    x, y, z, whole, first = x[:, bent], y[:, bent], z[:, bent], whole[bent], first[bent]
    other = other[0][bent], other[1][bent], other[2][bent]
    normal = normal[0][bent], normal[1][bent], normal[2][bent]
    one = _dot(_cross3((x[2] - x[1], y[2] - y[1], z[2] - z[1]), other), normal)
    second = np.minimum(one, whole - one)
    return bent, second > first, np.maximum(first, second) < -_FLAT * whole


def _fans(points: Points, rings: Ints) -> tuple[Ints, Ints]:
    """``(m, n - 2, 3)`` fans from the best apex, and the polygons where no apex sees all."""
    n = rings.shape[1]
    at = points[rings].astype(np.float64)
    at -= at[:, :1].copy()
    normal = np.cross(at[:, 1:-1], at[:, 2:]).sum(axis=1)
    floor = -_FLAT * np.einsum("ij,ij->i", normal, normal)
    best, apex = np.full(len(rings), -np.inf), np.zeros(len(rings), np.int64)
    for candidate in range(n if n <= _MANY_CORNERS else 1):
        spokes = np.roll(at, -candidate, axis=1) - at[:, candidate : candidate + 1]
        areas = np.einsum("ijk,ik->ij", np.cross(spokes[:, 1:-1], spokes[:, 2:]), normal)
        worst = areas.min(axis=1)
        # By more than noise: equal apexes must not be told apart by rounding, or a rotated copy gets other triangles.
        better = worst > best - floor * 1e-3
        best, apex = np.where(better, worst, best), np.where(better, candidate, apex)
    turned = rings[np.arange(len(rings))[:, None], (apex[:, None] + np.arange(n)) % n]
    steps = np.arange(1, n - 1)
    triangles = np.stack(
        [np.broadcast_to(turned[:, :1], (len(rings), n - 2)), turned[:, steps], turned[:, steps + 1]], 2
    )
    return triangles, np.flatnonzero(best < floor)


def _cross3(u: Rows, v: Rows) -> Rows:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def _dot(u: Rows, v: Rows) -> Floats:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def _clip_ears(polygon: Floats) -> tuple[npt.NDArray[np.int64], bool]:
    """Triangles ``(n - 2, 3)`` of one polygon as corner numbers, and whether they tile it."""
    ring, total = _flattened(polygon)
    triangles, _ = clip_ears(ring, range(len(ring)), _NO_TURN * total)
    covered = sum(abs(double_area(ring[a], ring[b], ring[c])) for a, b, c in triangles)
    return np.array(triangles, np.int64), abs(covered - total) <= _OVERLAP * total


def _flattened(polygon: Floats) -> tuple[Ring, float]:
    """The corners in the plane of the mean normal, counter-clockwise, and twice their area."""
    at = polygon - polygon[0]
    normal = np.cross(at[1:-1], at[2:]).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0:
        return [(float(x), float(y)) for x, y in at[:, :2]], 0.0
    normal /= length
    side = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    side /= np.linalg.norm(side)
    flat = np.column_stack([at @ side, at @ np.cross(normal, side)])
    return [(float(x), float(y)) for x, y in flat], length
