"""The exact distance of two triangles, degenerate ones included.

A triangle may be a proper one, a segment (collinear corners) or a point (equal corners); the distance is that of
the closed sets. Kernels work on rows of a scratch array, one triangle each, so that a leaf of a tree is loaded once
and met by many others. Coordinates are to be relative to a point close by: what is small enough to be near then
keeps a precision of about 1e-16 times its own size.

The closest points of two triangles are at a corner over a face, on a side each, or where a side pierces a face
(Ericson, Real-Time Collision Detection, 5.1; the early ends follow from convexity). Near-parallel sides and
slivers, on which the textbook formulas lose half of the digits, take a slower way.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["ROW", "TOLERANCE", "distance2", "lay_normal", "prepare", "triangle_distances"]

TOLERANCE = 1e-9
"""Distances up to this are 0, and a gap this much over a limit still counts, to absorb rounding [m]."""

ROW = 20
"""Length of a row: three corners (9), normal (3), its squared length or -1 while unknown (1), box (6), one free."""

_FLAT = 1e-10
# A triangle of less height than this [m] is covered by its sides within half of it, far below TOLERANCE.

_SLIVER = 1e-8
# Below this squared sine of the angle between two sides, plain cross products lose more than four digits.

_PARALLEL = 1e-6
# Likewise for the squared sine of the angle between two sides of different triangles.


@compiled
def _product_difference(a: float, b: float, c: float, d: float) -> float:
    """``a * b - c * d`` with the rounding errors of the products made good (Dekker 1971)."""
    split = 134217729.0
    p = a * b
    t = split * a
    a_high = t - (t - a)
    a_low = a - a_high
    t = split * b
    b_high = t - (t - b)
    b_low = b - b_high
    p_error = ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low
    q = c * d
    t = split * c
    c_high = t - (t - c)
    c_low = c - c_high
    t = split * d
    d_high = t - (t - d)
    d_low = d - d_high
    q_error = ((c_high * d_high - q) + c_high * d_low + c_low * d_high) + c_low * d_low
    return (p - q) + (p_error - q_error)


@compiled
def _lost(a: float, b: float) -> float:
    """What rounding took from ``a - b`` (Knuth's exact difference)."""
    difference = a - b
    virtual = difference - a
    return (a - (difference - virtual)) - (b + virtual)


@compiled
def _sliver_normal(
    rows: Floats, i: int, ux: float, uy: float, uz: float, vx: float, vy: float, vz: float
) -> tuple[float, float, float]:
    """The normal of row ``i`` with the rounding errors of its sides and of their product made good."""
    ax, ay, az = _lost(rows[i, 3], rows[i, 0]), _lost(rows[i, 4], rows[i, 1]), _lost(rows[i, 5], rows[i, 2])
    bx, by, bz = _lost(rows[i, 6], rows[i, 0]), _lost(rows[i, 7], rows[i, 1]), _lost(rows[i, 8], rows[i, 2])
    return (
        _product_difference(uy, vz, uz, vy) + ((ay * vz - az * vy) + (uy * bz - uz * by)),
        _product_difference(uz, vx, ux, vz) + ((az * vx - ax * vz) + (uz * bx - ux * bz)),
        _product_difference(ux, vy, uy, vx) + ((ax * vy - ay * vx) + (ux * by - uy * bx)),
    )


@compiled
def prepare(rows: Floats, i: int) -> None:
    """Fills the box of row ``i`` from its corners, and marks its normal as not known yet."""
    rows[i, 12] = -1.0
    for k in range(3):
        a, b, c = rows[i, k], rows[i, 3 + k], rows[i, 6 + k]
        rows[i, 13 + k] = min(a, b, c)
        rows[i, 16 + k] = max(a, b, c)


@compiled
def lay_normal(rows: Floats, i: int) -> float:
    """Fills the normal of row ``i``, unless known; returns its squared length, 0 for a degenerate triangle."""
    if rows[i, 12] >= 0.0:
        return float(rows[i, 12])
    ux, uy, uz = rows[i, 3] - rows[i, 0], rows[i, 4] - rows[i, 1], rows[i, 5] - rows[i, 2]
    vx, vy, vz = rows[i, 6] - rows[i, 0], rows[i, 7] - rows[i, 1], rows[i, 8] - rows[i, 2]
    wx, wy, wz = vx - ux, vy - uy, vz - uz
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    n2 = nx * nx + ny * ny + nz * nz
    u2, v2, w2 = ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz, wx * wx + wy * wy + wz * wz
    if n2 < _SLIVER * u2 * v2:
        nx, ny, nz = _sliver_normal(rows, i, ux, uy, uz, vx, vy, vz)
        n2 = nx * nx + ny * ny + nz * nz
    if not (n2 > _FLAT * _FLAT * max(u2, v2, w2) and n2 > 1e-26 * u2 * v2):
        n2 = 0.0
    rows[i, 9], rows[i, 10], rows[i, 11], rows[i, 12] = nx, ny, nz, n2
    return float(n2)


@compiled
def _over(rows: Floats, i: int, x: float, y: float, z: float) -> bool:
    """Whether a point lies over the face of row ``i``, seen along its normal."""
    nx, ny, nz = rows[i, 9], rows[i, 10], rows[i, 11]
    for k in range(0, 9, 3):
        m = k + 3 if k < 6 else 0
        ex, ey, ez = rows[i, m] - rows[i, k], rows[i, m + 1] - rows[i, k + 1], rows[i, m + 2] - rows[i, k + 2]
        px, py, pz = x - rows[i, k], y - rows[i, k + 1], z - rows[i, k + 2]
        if nx * (ey * pz - ez * py) + ny * (ez * px - ex * pz) + nz * (ex * py - ey * px) < 0.0:
            return False
    return True


@compiled
def _corner_over_face(
    faces: Floats, i: int, corners: Floats, j: int, k: int, height: float, out: Floats, face_at: int
) -> bool:
    """If corner ``k`` of row ``j`` lies over the face of row ``i``: writes it and its foot, and says so."""
    x, y, z = corners[j, 3 * k], corners[j, 3 * k + 1], corners[j, 3 * k + 2]
    if not _over(faces, i, x, y, z):
        return False
    share = height / faces[i, 12]
    out[face_at] = x - share * faces[i, 9]
    out[face_at + 1] = y - share * faces[i, 10]
    out[face_at + 2] = z - share * faces[i, 11]
    out[3 - face_at], out[4 - face_at], out[5 - face_at] = x, y, z
    return True


@compiled
def _pierced(faces: Floats, i: int, sides: Floats, j: int, h0: float, h1: float, h2: float, out: Floats) -> bool:
    """Whether a side of row ``j``, with these heights of its corners, goes through the face of row ``i``."""
    for k in range(3):
        low = h0 if k == 0 else (h1 if k == 1 else h2)
        high = h1 if k == 0 else (h2 if k == 1 else h0)
        if not ((low < 0.0 and high > 0.0) or (low > 0.0 and high < 0.0)):
            continue
        share = low / (low - high)
        a, b = 3 * k, 3 * ((k + 1) % 3)
        x = sides[j, a] + share * (sides[j, b] - sides[j, a])
        y = sides[j, a + 1] + share * (sides[j, b + 1] - sides[j, a + 1])
        z = sides[j, a + 2] + share * (sides[j, b + 2] - sides[j, a + 2])
        if _over(faces, i, x, y, z):
            out[0], out[1], out[2], out[3], out[4], out[5] = x, y, z, x, y, z
            return True
    return False


@compiled
def _clamp(x: float) -> float:
    return min(max(x, 0.0), 1.0)


@compiled
def _side_gap2(p: Floats, i: int, a: int, b: int, q: Floats, j: int) -> float:
    """Squared distance of the box of the side from corner ``a`` to ``b`` of row ``i`` from the box of row ``j``."""
    x = max(min(p[i, a], p[i, b]) - q[j, 16], q[j, 13] - max(p[i, a], p[i, b]), 0.0)
    y = max(min(p[i, a + 1], p[i, b + 1]) - q[j, 17], q[j, 14] - max(p[i, a + 1], p[i, b + 1]), 0.0)
    z = max(min(p[i, a + 2], p[i, b + 2]) - q[j, 18], q[j, 15] - max(p[i, a + 2], p[i, b + 2]), 0.0)
    return float(x * x + y * y + z * z)


@compiled
def _sides(p: Floats, i: int, q: Floats, j: int, best: float, out: Floats) -> float:
    """The least squared distance below ``best`` between the sides of two triangles."""
    gap0, gap1, gap2 = _side_gap2(q, j, 0, 3, p, i), _side_gap2(q, j, 3, 6, p, i), _side_gap2(q, j, 6, 0, p, i)
    for k in range(3):
        a, b, c = 3 * k, 3 * ((k + 1) % 3), 3 * ((k + 2) % 3)
        if _side_gap2(p, i, a, b, q, j) >= best:
            continue
        ax, ay, az = p[i, a], p[i, a + 1], p[i, a + 2]
        ux, uy, uz = p[i, b] - ax, p[i, b + 1] - ay, p[i, b + 2] - az
        uu = ux * ux + uy * uy + uz * uz
        for m in range(3):
            d, e, f = 3 * m, 3 * ((m + 1) % 3), 3 * ((m + 2) % 3)
            if (gap0 if m == 0 else (gap1 if m == 1 else gap2)) >= best:
                continue
            dx, dy, dz = q[j, d], q[j, d + 1], q[j, d + 2]
            vx, vy, vz = q[j, e] - dx, q[j, e + 1] - dy, q[j, e + 2] - dz
            rx, ry, rz = dx - ax, dy - ay, dz - az
            vv = vx * vx + vy * vy + vz * vz
            uv = ux * vx + uy * vy + uz * vz
            ur = ux * rx + uy * ry + uz * rz
            vr = vx * rx + vy * ry + vz * rz
            s = 0.0
            det = uu * vv - uv * uv
            if det > _PARALLEL * uu * vv:
                s = _clamp((ur * vv - uv * vr) / det)
            elif uu > 0.0 and vv > 0.0:
                nx = _product_difference(uy, vz, uz, vy)
                ny = _product_difference(uz, vx, ux, vz)
                nz = _product_difference(ux, vy, uy, vx)
                det = nx * nx + ny * ny + nz * nz
                if det > 0.0:
                    s = nx * (ry * vz - rz * vy) + ny * (rz * vx - rx * vz) + nz * (rx * vy - ry * vx)
                    s = _clamp(s / det)
            t = (s * uv - vr) / vv if vv > 0.0 else 0.0
            if not 0.0 < t < 1.0:
                t = _clamp(t)
                s = _clamp((ur + t * uv) / uu) if uu > 0.0 else 0.0
            wx, wy, wz = rx + t * vx - s * ux, ry + t * vy - s * uy, rz + t * vz - s * uz
            found = wx * wx + wy * wy + wz * wz
            if found < best:
                best = found
                fx, fy, fz = ax + s * ux, ay + s * uy, az + s * uz
                gx, gy, gz = dx + t * vx, dy + t * vy, dz + t * vz
                out[0], out[1], out[2], out[3], out[4], out[5] = fx, fy, fz, gx, gy, gz
                # The slab between the two points has a triangle on each side: nothing can be closer. The margin is
                # the rounding of the line between the points.
                margin = 4e-15 * (uu + vv + rx * rx + ry * ry + rz * rz)
                if (p[i, c] - fx) * wx + (p[i, c + 1] - fy) * wy + (p[i, c + 2] - fz) * wz < -margin and (
                    q[j, f] - gx
                ) * wx + (q[j, f + 1] - gy) * wy + (q[j, f + 2] - gz) * wz > margin:
                    return best
    return best


@compiled
def _height(rows: Floats, i: int, corners: Floats, j: int, k: int) -> float:
    """Height of corner ``k`` of row ``j`` over the plane of row ``i``, times the length of its normal."""
    return float(
        rows[i, 9] * (corners[j, k] - rows[i, 0])
        + rows[i, 10] * (corners[j, k + 1] - rows[i, 1])
        + rows[i, 11] * (corners[j, k + 2] - rows[i, 2])
    )


@compiled
def _faces(
    faces: Floats, i: int, corners: Floats, j: int, h0: float, h1: float, h2: float, best: float, out: Floats, at: int
) -> float:
    """The least squared distance below ``best`` of corners of row ``j`` over the face of row ``i``."""
    for k in range(3):
        h = h0 if k == 0 else (h1 if k == 1 else h2)
        if h * h < best * faces[i, 12] and _corner_over_face(faces, i, corners, j, k, h, out, at):
            best = h * h / faces[i, 12]
    return best


@compiled
def _nearest_corner(h0: float, h1: float, h2: float) -> int:
    """Which corner is closest to a plane that all are on the same side of, given their heights; -1: not so."""
    if not ((h0 > 0.0 and h1 > 0.0 and h2 > 0.0) or (h0 < 0.0 and h1 < 0.0 and h2 < 0.0)):
        return -1
    a0, a1, a2 = abs(h0), abs(h1), abs(h2)
    return 0 if a0 <= a1 and a0 <= a2 else (1 if a1 <= a2 else 2)


@compiled
def distance2(p: Floats, i: int, q: Floats, j: int, limit2: float, out: Floats) -> float:
    """The squared distance of row ``i`` of ``p`` and row ``j`` of ``q``, if below a limit.

    Args:
        p: prepared rows.
        i: row.
        q: prepared rows.
        j: row.
        limit2: squared limit [m2].
        out: ``(6,)`` takes the closest points, on the first and on the second, if below the limit.

    Returns:
        The squared distance [m2], or ``limit2`` where it is not below.
    """
    best = limit2
    p0 = p1 = p2 = q0 = q1 = q2 = 0.0
    np2 = lay_normal(p, i)
    if np2 > 0.0:
        q0, q1, q2 = _height(p, i, q, j, 0), _height(p, i, q, j, 3), _height(p, i, q, j, 6)
        k = _nearest_corner(q0, q1, q2)
        if k >= 0:
            h = q0 if k == 0 else (q1 if k == 1 else q2)
            if h * h >= best * np2:
                return limit2
            if _corner_over_face(p, i, q, j, k, h, out, 0):
                return h * h / np2
    nq2 = lay_normal(q, j)
    if nq2 > 0.0:
        p0, p1, p2 = _height(q, j, p, i, 0), _height(q, j, p, i, 3), _height(q, j, p, i, 6)
        k = _nearest_corner(p0, p1, p2)
        if k >= 0:
            h = p0 if k == 0 else (p1 if k == 1 else p2)
            if h * h >= best * nq2:
                return limit2
            if _corner_over_face(q, j, p, i, k, h, out, 3):
                return h * h / nq2
    if np2 > 0.0:
        if _pierced(p, i, q, j, q0, q1, q2, out):
            return 0.0
        best = _faces(p, i, q, j, q0, q1, q2, best, out, 0)
    if nq2 > 0.0:
        if _pierced(q, j, p, i, p0, p1, p2, out):
            return 0.0
        best = _faces(q, j, p, i, p0, p1, p2, best, out, 3)
    return _sides(p, i, q, j, best, out)


@compiled
def _distances(first: Floats, second: Floats, distance: Floats, points: Floats) -> None:
    p, q, out, base = np.empty((1, ROW)), np.empty((1, ROW)), np.empty(6), np.empty(3)
    for n in range(len(first)):
        for k in range(3):
            base[k] = first[n, 0, k]
        for k in range(9):
            p[0, k] = first[n, k // 3, k % 3] - base[k % 3]
            q[0, k] = second[n, k // 3, k % 3] - base[k % 3]
        prepare(p, 0)
        prepare(q, 0)
        distance[n] = np.sqrt(distance2(p, 0, q, 0, np.inf, out))
        for k in range(6):
            points[n, k // 3, k % 3] = out[k] + base[k % 3]


def triangle_distances(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """The distances of pairs of triangles.

    Args:
        first: ``(n, 3, 3)`` corners of the first of each pair [m].
        second: ``(n, 3, 3)`` corners of the second of each pair [m].

    Returns:
        ``(n,)`` distances [m], and ``(n, 2, 3)`` a closest point on each [m].

    Raises:
        ValueError: the shapes differ or are not ``(n, 3, 3)``.
    """
    if first.shape != second.shape or first.shape[1:] != (3, 3):
        raise ValueError(f"need two arrays of shape (n, 3, 3), got {first.shape} and {second.shape}")
    distance, points = np.empty(len(first)), np.empty((len(first), 2, 3))
    _distances(np.ascontiguousarray(first, np.float64), np.ascontiguousarray(second, np.float64), distance, points)
    return distance, points
