"""The oriented box of a set of points: tight, and the same in any pose.

The least box of a solid has a side flush with a face in all practical cases, and then the other sides follow from the
least rectangle around the shadow along that face's normal (rotating calipers). So a few directions are tried, each
with its exact least rectangle: the normals that carry most area, and the principal axes of the normals and of the
surface (which give the axis of anything round). The axes of the best box are then tried in turn until none improves.
"""

from __future__ import annotations

from math import inf, sqrt

import numpy as np

from cadgraph.geometry.kernels.order import sort_rows
from cadgraph.geometry.kernels.parallel import ZERO, compiled
from cadgraph.geometry.mesh.normals import N_BINS, bin_normals
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["fit_boxes", "order_boxes", "principal_axes"]

_N_NORMALS = 4
_N_ROUNDS = 4
_N_CANDIDATES = _N_NORMALS + 9 + 2 * _N_ROUNDS
# Directions this close (squared sine) are one candidate: the extents change by less than 1e-7 of the size.
_SAME_AXIS = 1e-14
# What each extent is padded with before multiplying, as share of the size, so that flat boxes compare by area.
_FLAT = 1e-6
# Extents this close, as share of the size, count as equal when ordered.
_EQUAL = 1e-7
# Components of unit vectors this close count as equal.
_EQUAL_COMPONENT = 1e-6


@compiled
def principal_axes(matrix: Floats, axes: Floats, values: Floats) -> None:
    """Eigenvectors of a symmetric 3 x 3 matrix by Jacobi rotations, as rows of ``axes``, eigenvalues descending.

    ``axes`` may be the matrix itself.
    """
    a = np.empty((3, 3))
    for r in range(3):
        for k in range(3):
            a[r, k] = matrix[r, k]
            axes[r, k] = 1.0 if r == k else 0.0
    for _ in range(30):
        off = a[0, 1] * a[0, 1] + a[0, 2] * a[0, 2] + a[1, 2] * a[1, 2]
        diagonal = a[0, 0] * a[0, 0] + a[1, 1] * a[1, 1] + a[2, 2] * a[2, 2]
        if off <= 1e-32 * diagonal:
            break
        for turn in range(3):
            p, q = (turn >> 1), 2 - (turn == 0)
            apq = a[p, q]
            if apq == 0.0:
                continue
            theta = (a[q, q] - a[p, p]) / (2.0 * apq)
            t = 1.0 / (abs(theta) + sqrt(theta * theta + 1.0))
            if theta < 0.0:
                t = -t
            c = 1.0 / sqrt(t * t + 1.0)
            s = t * c
            for k in range(3):
                x, y = a[k, p], a[k, q]
                a[k, p], a[k, q] = c * x - s * y, s * x + c * y
            for k in range(3):
                x, y = a[p, k], a[q, k]
                a[p, k], a[q, k] = c * x - s * y, s * x + c * y
                x, y = axes[p, k], axes[q, k]
                axes[p, k], axes[q, k] = c * x - s * y, s * x + c * y
    for r in range(3):
        values[r] = a[r, r]
    # Bubble sort; equal ones keep their order.
    for turn in range(3):
        r = turn & 1
        if values[r + 1] > values[r]:
            values[r], values[r + 1] = values[r + 1], values[r]
            for k in range(3):
                axes[r, k], axes[r + 1, k] = axes[r + 1, k], axes[r, k]


@compiled
def fit_boxes(
    vertices: Floats,
    used: Bools,
    faces: Faces,
    v_offsets: Ints,
    f_offsets: Ints,
    covariance: Floats,
    first: int,
    last: int,
    origin: Floats,
    sizes: Floats,
    rows: Floats,
    bounds: Floats,
) -> None:
    """Finds the oriented boxes of a range of meshes, as ``order_boxes`` wants them; nothing where no vertex is used.

    Args:
        vertices: ``(n_vertices, 3)`` of all meshes [m].
        used: ``(n_vertices,)`` which of them count; all those are finite.
        faces: ``(n_faces, 3)`` indices of vertices of their own mesh; those out of range or with an unused corner are
            ignored.
        v_offsets: ``(n + 1,)`` where the vertices of each mesh start.
        f_offsets: ``(n + 1,)`` where the faces of each mesh start.
        covariance: ``(n, 3, 3)`` second moments of each surface about its centroid [m4], zero if unknown.
        first: the first mesh.
        last: the end of the range.
        origin: ``(n, 3)`` output: the first used vertex [m].
        sizes: ``(n,)`` output: how far the used vertices are from it at most [m]; if 0, there are no axes.
        rows: ``(n, 3, 3)`` output: axes as rows, in any order and sense.
        bounds: ``(n, 2, 3)`` output: lowest and highest extent along each of them, from the origin [m].
    """
    n_most = 0
    for i in range(first, last):
        n_most = max(n_most, v_offsets[i + 1] - v_offsets[i])
    local, flat, spare = np.empty((n_most, 3)), np.empty((n_most, 2)), np.empty((n_most, 2))
    hull = np.empty((2 * n_most, 2))
    candidates, bins, ends = np.empty((_N_CANDIDATES, 3)), np.empty((N_BINS, 5)), np.empty((8, 3))
    moments, values = np.empty((3, 3)), np.empty(3)
    best, box = np.empty((3, 3)), np.empty((3, 3))
    for i in range(first, last):
        v0 = v_offsets[i]
        n = ZERO
        ox = oy = oz = size = 0.0
        for v in range(v0, v_offsets[i + 1]):
            if not used[v]:
                continue
            x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
            if n == 0:
                ox, oy, oz = x, y, z
            x, y, z = x - ox, y - oy, z - oz
            local[n, 0], local[n, 1], local[n, 2] = x, y, z
            n += 1
            # The size must not depend on the pose, so that choices between boxes do not either.
            size = max(size, x * x + y * y + z * z)
        if n == 0:
            continue
        origin[i, 0], origin[i, 1], origin[i, 2] = ox, oy, oz
        sizes[i] = size = sqrt(size)
        if size == 0.0:
            continue
        n_bins = bin_normals(
            vertices, used, faces, v0, v_offsets[i + 1] - v0, f_offsets[i], f_offsets[i + 1], bins, moments
        )
        n_candidates = _propose_axes(bins, n_bins, moments, covariance, i, local, n, values, candidates)
        best_cost = inf
        tried = ZERO
        for _ in range(_N_ROUNDS):
            before = best_cost
            while tried < n_candidates:
                cost = _box_along(local, n, candidates, tried, size, flat, spare, hull, ends, box)
                tried += 1
                # A later candidate must be better by more than rounding, or the pose would decide.
                if cost < best_cost * (1.0 - 1e-12):
                    best_cost = cost
                    for r in range(3):
                        for c in range(3):
                            best[r, c] = box[r, c]
            if best_cost >= before * (1.0 - 1e-9):
                break
            for r in range(1, 3):
                n_candidates = _add_axis(candidates, n_candidates, best, r)
        _span(local, n, best, i, rows, bounds)


@compiled
def _add_axis(candidates: Floats, n: int, rows: Floats, row: int) -> int:
    """Appends a row as a unit axis unless it's there already; returns how many there are now."""
    x, y, z = rows[row, 0], rows[row, 1], rows[row, 2]
    length = sqrt(x * x + y * y + z * z)
    if not length > 0.0 or n >= _N_CANDIDATES:
        return n
    x, y, z = x / length, y / length, z / length
    for k in range(n):
        a, b, c = candidates[k, 0], candidates[k, 1], candidates[k, 2]
        u, v, w = y * c - z * b, z * a - x * c, x * b - y * a
        if u * u + v * v + w * w < _SAME_AXIS:
            return n
    candidates[n, 0], candidates[n, 1], candidates[n, 2] = x, y, z
    return n + 1


@compiled
def _propose_axes(
    bins: Floats,
    n_bins: int,
    moments: Floats,
    covariance: Floats,
    i: int,
    local: Floats,
    n_points: int,
    values: Floats,
    candidates: Floats,
) -> int:
    """Directions worth trying, the most exact first; returns how many."""
    n = ZERO
    for _ in range(min(n_bins, _N_NORMALS)):
        most = 0
        for b in range(1, n_bins):
            if bins[b, 3] > bins[most, 3]:
                most = b
        n = _add_axis(candidates, n, bins, most)
        bins[most, 3] = -1.0
    # Without faces, or with a flat sheet, the points themselves must say.
    for source in range(0 if n_bins > 0 else 2, 3 if n_bins < 3 else 2):
        if source == 2:
            for r in range(3):
                for c in range(3):
                    moments[r, c] = 0.0
            for k in range(n_points):
                for r in range(3):
                    for c in range(3):
                        moments[r, c] += local[k, r] * local[k, c]
        if source == 1:
            for r in range(3):
                for c in range(3):
                    moments[r, c] = covariance[i, r, c]
        principal_axes(moments, moments, values)
        for r in range(3):
            # Of the normals the direction that fewest have comes first: the axis of anything round.
            n = _add_axis(candidates, n, moments, 2 - r if source == 0 else r)
    return int(n)


@compiled
def _box_along(
    local: Floats,
    n: int,
    candidates: Floats,
    row: int,
    size: float,
    flat: Floats,
    spare: Floats,
    hull: Floats,
    ends: Floats,
    box: Floats,
) -> float:
    """The best box with one side along a candidate: its axes into ``box``, its cost returned."""
    x, y, z = candidates[row, 0], candidates[row, 1], candidates[row, 2]
    ex, ey, ez = 0.0, 0.0, 0.0
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        ex = 1.0
    elif abs(y) <= abs(z):
        ey = 1.0
    else:
        ez = 1.0
    ux, uy, uz = y * ez - z * ey, z * ex - x * ez, x * ey - y * ex
    length = sqrt(ux * ux + uy * uy + uz * uz)
    ux, uy, uz = ux / length, uy / length, uz / length
    wx, wy, wz = y * uz - z * uy, z * ux - x * uz, x * uy - y * ux
    low, high = inf, -inf
    for k in range(n):
        px, py, pz = local[k, 0], local[k, 1], local[k, 2]
        flat[k, 0] = px * ux + py * uy + pz * uz
        flat[k, 1] = px * wx + py * wy + pz * wz
        h = px * x + py * y + pz * z
        low, high = min(low, h), max(high, h)
    n_flat = _outside_octagon(flat, n, ends) if n > 16 else n
    sort_rows(flat, ZERO, n_flat, spare)
    n_hull = _hull(flat, n_flat, spare, hull)
    c, s, cost = _least_rectangle(hull, n_hull, size)
    box[0, 0], box[0, 1], box[0, 2] = x, y, z
    box[1, 0], box[1, 1], box[1, 2] = c * ux + s * wx, c * uy + s * wy, c * uz + s * wz
    box[2, 0], box[2, 1], box[2, 2] = -s * ux + c * wx, -s * uy + c * wy, -s * uz + c * wz
    return cost * (high - low + _FLAT * size)


@compiled
def _outside_octagon(flat: Floats, n: int, ends: Floats) -> int:
    """Keeps the points that can be on the hull, those not inside the octagon of eight extreme points; how many."""
    for e in range(8):
        ends[e, 2] = -inf
    for k in range(n):
        x, y = flat[k, 0], flat[k, 1]
        for e in range(4):
            h = x if e == 0 else x + y if e == 1 else y if e == 2 else y - x
            if h > ends[e, 2]:
                ends[e, 0], ends[e, 1], ends[e, 2] = x, y, h
            if -h > ends[e + 4, 2]:
                ends[e + 4, 0], ends[e + 4, 1], ends[e + 4, 2] = x, y, -h
    m = 0
    for k in range(n):
        x, y = flat[k, 0], flat[k, 1]
        for e in range(8):
            px, py, qx, qy = ends[e, 0], ends[e, 1], ends[(e + 1) & 7, 0], ends[(e + 1) & 7, 1]
            if (qx - px) * (y - py) - (qy - py) * (x - px) <= 0.0 and (px != qx or py != qy):
                flat[m, 0], flat[m, 1] = x, y
                m += 1
                break
    return m


@compiled
def _hull(flat: Floats, n: int, upper: Floats, hull: Floats) -> int:
    """The corners of the convex hull of points sorted by abscissa, counter-clockwise; returns how many."""
    n_low = n_up = ZERO
    k = 0
    while k < n:
        # Of the points at one abscissa only the lowest and the highest count; makes the order of ties irrelevant too.
        x = flat[k, 0]
        low = high = flat[k, 1]
        k += 1
        while k < n and flat[k, 0] == x:
            low, high = min(low, flat[k, 1]), max(high, flat[k, 1])
            k += 1
        n_low = _add_corner(hull, n_low, x, low, 1.0)
        n_up = _add_corner(upper, n_up, x, high, -1.0)
    for k in range(n_up):
        hull[n_low + k, 0], hull[n_low + k, 1] = upper[n_up - 1 - k, 0], upper[n_up - 1 - k, 1]
    return int(n_low + n_up)


@compiled
def _add_corner(chain: Floats, n: int, x: float, y: float, sign: float) -> int:
    """Adds a point to a convex chain, less the corners that it makes concave; returns the new length."""
    while n >= 2:
        ax, ay, bx, by = chain[n - 2, 0], chain[n - 2, 1], chain[n - 1, 0], chain[n - 1, 1]
        if sign * ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) > 0.0:
            break
        n -= 1
    chain[n, 0], chain[n, 1] = x, y
    return n + 1


@compiled
def _least_rectangle(hull: Floats, n: int, size: float) -> tuple[float, float, float]:
    """Direction (cosine, sine) and cost of the least rectangle around a convex polygon.

    A least rectangle has a side along an edge; the three other supports only move forward as the edge does.
    """
    best_c, best_s, best = 1.0, 0.0, inf
    pad = _FLAT * size
    right = top = left = ZERO - 1
    for k in range(n):
        after = k + 1 if k + 1 < n else 0
        ex, ey = hull[after, 0] - hull[k, 0], hull[after, 1] - hull[k, 1]
        length = sqrt(ex * ex + ey * ey)
        if length <= 1e-9 * size:
            continue
        c, s = ex / length, ey / length
        if right < 0:
            right = top = left = k
            for i in range(n):
                x, y = hull[i, 0], hull[i, 1]
                if x * c + y * s > hull[right, 0] * c + hull[right, 1] * s:
                    right = i
                if y * c - x * s > hull[top, 1] * c - hull[top, 0] * s:
                    top = i
                if x * c + y * s < hull[left, 0] * c + hull[left, 1] * s:
                    left = i
        else:
            right = _advance(hull, n, right, c, s)
            top = _advance(hull, n, top, -s, c)
            left = _advance(hull, n, left, -c, -s)
        width = (hull[right, 0] - hull[left, 0]) * c + (hull[right, 1] - hull[left, 1]) * s
        height = (hull[top, 1] - hull[k, 1]) * c - (hull[top, 0] - hull[k, 0]) * s
        cost = (width + pad) * (height + pad)
        if cost < best * (1.0 - 1e-12):
            best_c, best_s, best = c, s, cost
    if best == inf:
        best = pad * pad
    return best_c, best_s, best


@compiled
def _advance(hull: Floats, n: int, at: int, x: float, y: float) -> int:
    """The next corner from ``at`` on that is farthest along (x, y)."""
    reach = hull[at, 0] * x + hull[at, 1] * y
    for _ in range(n):
        after = at + 1 if at + 1 < n else 0
        next_reach = hull[after, 0] * x + hull[after, 1] * y
        if next_reach < reach:
            break
        at, reach = after, next_reach
    return at


@compiled
def _span(local: Floats, n: int, best: Floats, i: int, rows: Floats, bounds: Floats) -> None:
    """Writes the axes of a box and the extent of the points along each."""
    for r in range(3):
        x, y, z = best[r, 0], best[r, 1], best[r, 2]
        rows[i, r, 0], rows[i, r, 1], rows[i, r, 2] = x, y, z
        low, high = inf, -inf
        for k in range(n):
            h = local[k, 0] * x + local[k, 1] * y + local[k, 2] * z
            low, high = min(low, h), max(high, h)
        bounds[i, 0, r], bounds[i, 1, r] = low, high


def order_boxes(origin: Floats, sizes: Floats, rows: Floats, bounds: Floats) -> tuple[Floats, Floats, Floats]:
    """Puts the axes of boxes in order and gives them a definite sense.

    Args:
        origin: ``(n, 3)`` what ``fit_boxes`` gives [m].
        sizes: ``(n,)`` see ``origin``.
        rows: ``(n, 3, 3)`` see ``origin``.
        bounds: ``(n, 2, 3)`` see ``origin``.

    Returns:
        The centers ``(n, 3)`` [m]; the axes ``(n, 3, 3)`` as rows, right-handed, longest extent first, the greatest
        component of the first and of the second positive; and the extents ``(n, 3)``, full side lengths [m],
        descending.
    """
    n = len(sizes)
    order, every = np.tile(np.arange(3), (n, 1)), np.arange(n)
    spans = bounds[:, 1] - bounds[:, 0]
    for first in (0, 1, 0, 1):
        a, b = order[:, first], order[:, first + 1]
        difference = spans[every, b] - spans[every, a]
        # Equal sides: the one nearer to x comes first, then to y.
        nearer = np.abs(rows[every, b, :2]) - np.abs(rows[every, a, :2])
        tells = np.abs(nearer) > _EQUAL_COMPONENT
        is_nearer = np.where(tells[:, 0], nearer[:, 0], np.where(tells[:, 1], nearer[:, 1], 0.0)) > 0.0
        swap = np.where(np.abs(difference) <= _EQUAL * sizes, is_nearer, difference > 0.0)
        order[swap, first : first + 2] = order[swap, first : first + 2][:, ::-1]
    rows = np.take_along_axis(rows, order[:, :, None], axis=1)
    bounds = np.take_along_axis(bounds, order[:, None, :], axis=2)
    center = origin.copy()
    for r in range(3):
        center += (0.5 * (bounds[:, 1, r] + bounds[:, 0, r]))[:, None] * rows[:, r]
    axes = np.empty((n, 3, 3))
    for r in range(2):
        length, lead = np.abs(rows[:, r]), np.zeros(n, np.int64)
        for k in (1, 2):
            lead[length[:, k] > length[every, lead] + _EQUAL_COMPONENT] = k
        # Adding 0 makes -0 to 0.
        axes[:, r] = np.where(rows[every, r, lead] < 0.0, -1.0, 1.0)[:, None] * rows[:, r] + 0.0
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    # Rounding must not leave a longer side behind a shorter one.
    return center, axes, np.minimum.accumulate(bounds[:, 1] - bounds[:, 0], axis=1)
