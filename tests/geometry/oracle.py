"""The distance of two triangles by enumerating features, written another way than the kernels it checks.

``distances`` works on many pairs at once in extended precision (where the platform has it): every subset of corners
of each triangle (corner, side, face) spans a flat; for each two flats the closest points follow from the normal
equations in the parameters of the flats, and count where they lie within the subsets. The least of all is the
distance. ``exact_squared`` does the same for one pair in rational numbers, without any rounding.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, product

import numpy as np

SUBSETS = [subset for size in (1, 2, 3) for subset in combinations(range(3), size)]


def exact_squared(first, second):
    """The squared distance of two triangles (3, 3) as a Fraction."""
    p = [[Fraction(float(x)) for x in corner] for corner in first]
    q = [[Fraction(float(x)) for x in corner] for corner in second]
    best = None
    for s, t in product(SUBSETS, SUBSETS):
        if len(s) + len(t) > 5:
            continue  # two faces meet in their sides too
        found = _between_flats([p[k] for k in s], [q[k] for k in t])
        if found is not None and (best is None or found < best):
            best = found
    return best


def _dot(u, v):
    return sum(a * b for a, b in zip(u, v, strict=True))


def _minus(u, v):
    return [a - b for a, b in zip(u, v, strict=True)]


def _between_flats(p, q):
    """Squared distance of the flats through p and q if their closest points are unique and within; else None."""
    axes = [_minus(x, p[0]) for x in p[1:]] + [_minus(q[0], x) for x in q[1:]]
    apart = _minus(q[0], p[0])
    n = len(axes)
    rows = [[_dot(axes[i], axes[j]) for j in range(n)] + [_dot(axes[i], apart)] for i in range(n)]
    for i in range(n):
        pivot = next((k for k in range(i, n) if rows[k][i] != 0), None)
        if pivot is None:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(n):
            if k != i and rows[k][i] != 0:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i], strict=True)]
    shares = [row[n] for row in rows]
    for part in (shares[: len(p) - 1], shares[len(p) - 1 :]):
        if any(x < 0 for x in part) or sum(part) > 1:
            return None
    rest = apart
    for share, axis in zip(shares, axes, strict=True):
        rest = [a - share * b for a, b in zip(rest, axis, strict=True)]
    return _dot(rest, rest)


def distances(first, second):
    """The distances (n,) of pairs of triangles (n, 3, 3)."""
    first = np.asarray(first, np.longdouble)
    second = np.asarray(second, np.longdouble)
    base = first[:, :1]
    p, q = first - base, second - base
    best = np.full(len(p), np.inf, np.longdouble)
    for i, j in product(range(3), range(3)):
        best = np.minimum(best, _norm(p[:, i] - q[:, j]))
        best = np.minimum(best, _point_segment(p[:, i], q[:, j], q[:, (j + 1) % 3]))
        best = np.minimum(best, _point_segment(q[:, i], p[:, j], p[:, (j + 1) % 3]))
        best = np.minimum(best, _segment_segment(p[:, i], p[:, (i + 1) % 3], q[:, j], q[:, (j + 1) % 3]))
    for i in range(3):
        best = np.minimum(best, _point_face(p[:, i], q))
        best = np.minimum(best, _point_face(q[:, i], p))
        best = np.where(_pierces(p[:, i], p[:, (i + 1) % 3], q), 0, best)
        best = np.where(_pierces(q[:, i], q[:, (i + 1) % 3], p), 0, best)
    return best.astype(np.float64)


def _norm(v):
    return np.sqrt((v * v).sum(-1))


def _rows_dot(u, v):
    return (u * v).sum(-1)


def _point_segment(x, a, b):
    along = b - a
    length2 = _rows_dot(along, along)
    share = np.clip(_rows_dot(x - a, along) / np.where(length2 == 0, 1, length2), 0, 1)
    return _norm(x - a - share[:, None] * along)


def _segment_segment(a, b, c, d):
    """Where the common perpendicular of two lines meets both segments inside; infinite elsewhere."""
    u, v, r = b - a, d - c, c - a
    normal = np.cross(u, v)
    n2 = _rows_dot(normal, normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        s = _rows_dot(np.cross(r, v), normal) / n2
        t = _rows_dot(np.cross(r, u), normal) / n2
        inside = (n2 > 0) & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
        gap = np.abs(_rows_dot(r, normal)) / np.sqrt(n2)
    return np.where(inside, gap, np.inf)


def _frame(face):
    """Normal of a face and two more rows: its barycentric gradient directions."""
    u, v = face[:, 1] - face[:, 0], face[:, 2] - face[:, 0]
    return u, v, np.cross(u, v)


def _within(x, face):
    """Whether the projections of points fall into faces, by barycentric coordinates."""
    u, v, normal = _frame(face)
    n2 = _rows_dot(normal, normal)
    r = x - face[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        beta = _rows_dot(np.cross(r, v), normal) / n2
        gamma = _rows_dot(np.cross(u, r), normal) / n2
        return (n2 > 0) & (beta >= 0) & (gamma >= 0) & (beta + gamma <= 1)


def _point_face(x, face):
    _, _, normal = _frame(face)
    with np.errstate(divide="ignore", invalid="ignore"):
        gap = np.abs(_rows_dot(x - face[:, 0], normal)) / _norm(normal)
    return np.where(_within(x, face), gap, np.inf)


def _pierces(a, b, face):
    _, _, normal = _frame(face)
    low, high = _rows_dot(a - face[:, 0], normal), _rows_dot(b - face[:, 0], normal)
    crosses = (low * high < 0) & (_rows_dot(normal, normal) > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = low / (low - high)
    x = a + np.where(crosses, share, 0)[:, None] * (b - a)
    return crosses & _within(x, face)
