"""The oriented box of a set of points: tight, and the same in any pose.

The least box of a solid has a side flush with a face in all practical cases, and then the other sides follow from the
least rectangle around the shadow along that face's normal (rotating calipers). So a few directions are tried, each
with its exact least rectangle: the normals that carry most area, and the principal axes of the normals and of the
surface (which give the axis of anything round). The axes of the best box are then tried in turn until none improves.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.parallel import compiled
from cadgraph.parts import Bools
from cadgraph.scene import Faces, Floats, Ints

__all__ = ["fit_box", "principal_axes"]

_N_BINS = 12
_N_NORMALS = 4
_N_ROUNDS = 4
# At most so many faces vote on normals; more are sampled evenly.
_MAX_FACES = 4096
# Normals this close (1 - cosine; 1.4e-3 rad) are one: float32 coordinates of small faces scatter as much.
_SAME_NORMAL = 1e-6
# Directions this close (squared sine) are one candidate: the extents change by less than 1e-7 of the size.
_SAME_AXIS = 1e-14
# What each extent is padded with before multiplying, as share of the size, so that flat boxes compare by area.
_FLAT = 1e-6
# Extents this close, as share of the size, count as equal when ordered.
_EQUAL = 1e-7


@compiled
def principal_axes(matrix: Floats, axes: Floats, values: Floats) -> None:
    """Eigenvectors of a symmetric 3 x 3 matrix by Jacobi rotations, as rows of ``axes``, eigenvalues descending."""
    a = matrix.copy()
    v = np.eye(3)
    for _ in range(30):
        off = a[0, 1] * a[0, 1] + a[0, 2] * a[0, 2] + a[1, 2] * a[1, 2]
        diagonal = a[0, 0] * a[0, 0] + a[1, 1] * a[1, 1] + a[2, 2] * a[2, 2]
        if off <= 1e-32 * diagonal:
            break
        for p in range(2):
            for q in range(p + 1, 3):
                if a[p, q] == 0.0:
                    continue
                theta = (a[q, q] - a[p, p]) / (2.0 * a[p, q])
                t = 1.0 / (abs(theta) + np.sqrt(theta * theta + 1.0))
                if theta < 0.0:
                    t = -t
                c = 1.0 / np.sqrt(t * t + 1.0)
                s = t * c
                for k in range(3):
                    akp, akq = a[k, p], a[k, q]
                    a[k, p], a[k, q] = c * akp - s * akq, s * akp + c * akq
                for k in range(3):
                    apk, aqk = a[p, k], a[q, k]
                    a[p, k], a[q, k] = c * apk - s * aqk, s * apk + c * aqk
                for k in range(3):
                    vkp, vkq = v[k, p], v[k, q]
                    v[k, p], v[k, q] = c * vkp - s * vkq, s * vkp + c * vkq
    order = np.argsort(np.array([-a[0, 0], -a[1, 1], -a[2, 2]]))
    for r in range(3):
        values[r] = a[order[r], order[r]]
        for k in range(3):
            axes[r, k] = v[k, order[r]]


@compiled
def fit_box(
    points: Floats, used: Bools, faces: Faces, covariance: Floats, center: Floats, axes: Floats, extents: Floats
) -> None:
    """Writes the oriented box of the used points.

    Args:
        points: ``(n, 3)`` [m].
        used: ``(n,)`` which of them count; at least one, all finite.
        faces: ``(m, 3)`` indices of points; those out of range or with an unused corner are ignored.
        covariance: ``(3, 3)`` second moments of the surface about its centroid [m4], zero if unknown.
        center: ``(3,)`` output [m].
        axes: ``(3, 3)`` output: rows, right-handed, longest extent first. The greatest component of the first and of
            the second is positive.
        extents: ``(3,)`` output: full side lengths [m], descending.
    """
    n_used = 0
    for k in range(len(points)):
        n_used += used[k]
    local = np.empty((n_used, 3))
    origin = np.zeros(3)
    at = 0
    for k in range(len(points)):
        if used[k]:
            if at == 0:
                origin[:] = points[k]
            for c in range(3):
                local[at, c] = points[k, c] - origin[c]
            at += 1
    # The size must not depend on the pose, so that choices between boxes do not either.
    size = 0.0
    for k in range(n_used):
        size = max(size, local[k, 0] ** 2 + local[k, 1] ** 2 + local[k, 2] ** 2)
    size = np.sqrt(size)
    center[:] = origin
    axes[:] = np.eye(3)
    extents[:] = 0.0
    if size == 0.0:
        return

    candidates = np.zeros((_N_NORMALS + 9 + 2 * _N_ROUNDS, 3))
    n_candidates = _propose_axes(points, used, faces, covariance, local, candidates)
    best = np.zeros((3, 3))
    box = np.zeros((3, 3))
    best_cost = np.inf
    tried = 0
    for _ in range(_N_ROUNDS):
        before = best_cost
        while tried < n_candidates:
            cost = _box_along(local, candidates[tried], size, box)
            tried += 1
            # A later candidate must be better by more than rounding, or the pose would decide.
            if cost < best_cost * (1.0 - 1e-12):
                best_cost = cost
                best[:] = box
        if best_cost >= before * (1.0 - 1e-9):
            break
        for r in range(1, 3):
            n_candidates = _add_axis(candidates, n_candidates, best[r])
    _write_box(local, origin, best, size, center, axes, extents)


@compiled
def _add_axis(candidates: Floats, n: int, axis: Floats) -> int:
    """Appends a unit axis unless it's there already; returns how many there are now."""
    length = np.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2)
    if not length > 0.0 or n >= len(candidates):
        return n
    x, y, z = axis[0] / length, axis[1] / length, axis[2] / length
    for k in range(n):
        a, b, c = candidates[k]
        sine = (y * c - z * b) ** 2 + (z * a - x * c) ** 2 + (x * b - y * a) ** 2
        if sine < _SAME_AXIS:
            return n
    candidates[n, 0], candidates[n, 1], candidates[n, 2] = x, y, z
    return n + 1


@compiled
def _propose_axes(
    points: Floats, used: Bools, faces: Faces, covariance: Floats, local: Floats, candidates: Floats
) -> int:
    """Directions worth trying, the most exact first; returns how many."""
    bins = np.zeros((_N_BINS, 5))
    normal_moments = np.zeros((3, 3))
    n_bins = _bin_normals(points, used, faces, bins, normal_moments)
    n = 0
    order = np.argsort(-bins[:n_bins, 3])
    for k in range(min(n_bins, _N_NORMALS)):
        n = _add_axis(candidates, n, bins[order[k], :3])
    axes, values = np.empty((3, 3)), np.empty(3)
    if n_bins > 0:
        principal_axes(normal_moments, axes, values)
        for r in range(2, -1, -1):
            n = _add_axis(candidates, n, axes[r])
        principal_axes(covariance, axes, values)
        for r in range(3):
            n = _add_axis(candidates, n, axes[r])
    if n_bins < 3:
        # Without faces, or with a flat sheet, the points themselves must say.
        spread = np.zeros((3, 3))
        for k in range(len(local)):
            for r in range(3):
                for c in range(3):
                    spread[r, c] += local[k, r] * local[k, c]
        principal_axes(spread, axes, values)
        for r in range(3):
            n = _add_axis(candidates, n, axes[r])
    return n


@compiled
def _bin_normals(points: Floats, used: Bools, faces: Faces, bins: Floats, moments: Floats) -> int:
    """Area by direction of normal, either sense: rows of unit normal, area, area of the face that gave the normal.

    When all rows are taken, the least gives way to a greater newcomer.
    """
    n_bins = last = 0
    step = max(1, len(faces) // _MAX_FACES)
    for f in range(0, len(faces), step):
        i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
        if min(i, j, k) < 0 or max(i, j, k) >= len(points) or not (used[i] and used[j] and used[k]):
            continue
        ux, uy, uz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
        wx, wy, wz = points[k, 0] - points[i, 0], points[k, 1] - points[i, 1], points[k, 2] - points[i, 2]
        x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        area = np.sqrt(x * x + y * y + z * z)
        if not area > 0.0:
            continue
        x, y, z = x / area, y / area, z / area
        moments[0, 0] += area * x * x
        moments[1, 1] += area * y * y
        moments[2, 2] += area * z * z
        moments[0, 1] += area * x * y
        moments[0, 2] += area * x * z
        moments[1, 2] += area * y * z
        found = -1
        for step_b in range(n_bins):
            # Neighbouring faces often share their normal, so start where the last one matched.
            b = last + step_b
            if b >= n_bins:
                b -= n_bins
            if abs(x * bins[b, 0] + y * bins[b, 1] + z * bins[b, 2]) > 1.0 - _SAME_NORMAL:
                found = b
                break
        if found < 0:
            if n_bins < _N_BINS:
                found = n_bins
                n_bins += 1
            else:
                found = int(np.argmin(bins[:, 3]))
                if area <= bins[found, 3]:
                    continue
                bins[found] = 0.0
        last = found
        bins[found, 3] += area
        if area > bins[found, 4]:
            bins[found, 0], bins[found, 1], bins[found, 2], bins[found, 4] = x, y, z, area
    moments[1, 0], moments[2, 0], moments[2, 1] = moments[0, 1], moments[0, 2], moments[1, 2]
    return n_bins


@compiled
def _box_along(local: Floats, axis: Floats, size: float, box: Floats) -> float:
    """The best box with one side along ``axis``: its axes into ``box``, its cost returned."""
    x, y, z = axis
    smallest = np.argmin(np.abs(axis))
    e = np.zeros(3)
    e[smallest] = 1.0
    u = np.array([y * e[2] - z * e[1], z * e[0] - x * e[2], x * e[1] - y * e[0]])
    u /= np.sqrt(u[0] ** 2 + u[1] ** 2 + u[2] ** 2)
    w = np.array([y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]])
    n = len(local)
    flat = np.empty((n, 2))
    low, high = np.inf, -np.inf
    for k in range(n):
        px, py, pz = local[k, 0], local[k, 1], local[k, 2]
        flat[k, 0] = px * u[0] + py * u[1] + pz * u[2]
        flat[k, 1] = px * w[0] + py * w[1] + pz * w[2]
        h = px * x + py * y + pz * z
        low, high = min(low, h), max(high, h)
    hull = _hull(flat)
    c, s, cost = _least_rectangle(hull, size)
    box[0] = axis
    for k in range(3):
        box[1, k] = c * u[k] + s * w[k]
        box[2, k] = -s * u[k] + c * w[k]
    return cost * (high - low + _FLAT * size)


@compiled
def _hull(flat: Floats) -> Floats:
    """The corners ``(n, 2)`` of the convex hull of points in the plane, counter-clockwise."""
    keep = _outside_octagon(flat)
    flat = flat[keep]
    order = np.argsort(flat[:, 0])
    n = len(order)
    # Of the points at one abscissa only the lowest and the highest count; also makes the order of ties irrelevant.
    lower, upper = np.empty((n, 2)), np.empty((n, 2))
    m = 0
    k = 0
    while k < n:
        x = flat[order[k], 0]
        low = high = flat[order[k], 1]
        k += 1
        while k < n and flat[order[k], 0] == x:
            low, high = min(low, flat[order[k], 1]), max(high, flat[order[k], 1])
            k += 1
        lower[m, 0], lower[m, 1], upper[m, 0], upper[m, 1] = x, low, x, high
        m += 1
    n_low = _chain(lower, m, 1.0)
    n_up = _chain(upper, m, -1.0)
    hull = np.empty((n_low + n_up, 2))
    hull[:n_low] = lower[:n_low]
    for k in range(n_up):
        hull[n_low + k] = upper[n_up - 1 - k]
    return hull


@compiled
def _chain(points: Floats, n: int, sign: float) -> int:
    """Keeps the convex chain of points sorted by abscissa, in place; returns its length."""
    m = 0
    for k in range(n):
        while m >= 2:
            cross = (points[m - 1, 0] - points[m - 2, 0]) * (points[k, 1] - points[m - 2, 1]) - (
                points[m - 1, 1] - points[m - 2, 1]
            ) * (points[k, 0] - points[m - 2, 0])
            if sign * cross > 0.0:
                break
            m -= 1
        points[m, 0], points[m, 1] = points[k, 0], points[k, 1]
        m += 1
    return m


@compiled
def _outside_octagon(flat: Floats) -> Ints:
    """Which points can be on the hull: those not inside the octagon of eight extreme points."""
    n = len(flat)
    if n <= 16:
        return np.arange(n)
    ends = np.zeros(8, np.int64)
    best = np.full(8, -np.inf)
    for k in range(n):
        x, y = flat[k, 0], flat[k, 1]
        a, b = x + y, x - y
        if x > best[0]:
            best[0], ends[0] = x, k
        if a > best[1]:
            best[1], ends[1] = a, k
        if y > best[2]:
            best[2], ends[2] = y, k
        if -b > best[3]:
            best[3], ends[3] = -b, k
        if -x > best[4]:
            best[4], ends[4] = -x, k
        if -a > best[5]:
            best[5], ends[5] = -a, k
        if -y > best[6]:
            best[6], ends[6] = -y, k
        if b > best[7]:
            best[7], ends[7] = b, k
    keep = np.empty(n, np.int64)
    m = 0
    for k in range(n):
        x, y = flat[k, 0], flat[k, 1]
        for e in range(8):
            p, q = ends[e], ends[(e + 1) & 7]
            if p == q:
                continue
            cross = (flat[q, 0] - flat[p, 0]) * (y - flat[p, 1]) - (flat[q, 1] - flat[p, 1]) * (x - flat[p, 0])
            if cross <= 0.0:
                keep[m] = k
                m += 1
                break
    return keep[:m]


@compiled
def _least_rectangle(hull: Floats, size: float) -> tuple[float, float, float]:
    """Direction (cosine, sine) and cost of the least rectangle around a convex polygon.

    A least rectangle has a side along an edge; the three other supports only move forward as the edge does.
    """
    n = len(hull)
    best_c, best_s, best = 1.0, 0.0, np.inf
    pad = _FLAT * size
    right = top = left = -1
    for k in range(n):
        ex, ey = hull[(k + 1) % n, 0] - hull[k, 0], hull[(k + 1) % n, 1] - hull[k, 1]
        length = np.sqrt(ex * ex + ey * ey)
        if length <= 1e-9 * size:
            continue
        c, s = ex / length, ey / length
        if right < 0:
            right = top = left = k
            for i in range(n):
                if hull[i, 0] * c + hull[i, 1] * s > hull[right, 0] * c + hull[right, 1] * s:
                    right = i
                if hull[i, 1] * c - hull[i, 0] * s > hull[top, 1] * c - hull[top, 0] * s:
                    top = i
                if hull[i, 0] * c + hull[i, 1] * s < hull[left, 0] * c + hull[left, 1] * s:
                    left = i
        else:
            right = _advance(hull, right, c, s)
            top = _advance(hull, top, -s, c)
            left = _advance(hull, left, -c, -s)
        width = (hull[right, 0] - hull[left, 0]) * c + (hull[right, 1] - hull[left, 1]) * s
        height = (hull[top, 1] - hull[k, 1]) * c - (hull[top, 0] - hull[k, 0]) * s
        cost = (width + pad) * (height + pad)
        if cost < best * (1.0 - 1e-12):
            best_c, best_s, best = c, s, cost
    if best == np.inf:
        best = pad * pad
    return best_c, best_s, best


@compiled
def _advance(hull: Floats, at: int, x: float, y: float) -> int:
    """The next corner from ``at`` on that is farthest along (x, y)."""
    n = len(hull)
    for _ in range(n):
        after = (at + 1) % n
        if hull[after, 0] * x + hull[after, 1] * y < hull[at, 0] * x + hull[at, 1] * y:
            break
        at = after
    return at


@compiled
def _write_box(
    local: Floats, origin: Floats, best: Floats, size: float, center: Floats, axes: Floats, extents: Floats
) -> None:
    """Puts the axes in order, gives them a definite sense, and measures the extents along them."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for k in range(len(local)):
        for r in range(3):
            h = local[k, 0] * best[r, 0] + local[k, 1] * best[r, 1] + local[k, 2] * best[r, 2]
            low[r], high[r] = min(low[r], h), max(high[r], h)
    order = np.arange(3)
    for _ in range(2):
        for r in range(2):
            a, b = order[r], order[r + 1]
            difference = (high[b] - low[b]) - (high[a] - low[a])
            swap = difference > _EQUAL * size
            if abs(difference) <= _EQUAL * size:
                # Equal sides: the one nearer to x comes first, then to y.
                for k in range(2):
                    nearer = abs(best[b, k]) - abs(best[a, k])
                    if abs(nearer) > 1e-6:
                        swap = nearer > 0.0
                        break
            if swap:
                order[r], order[r + 1] = b, a
    for r in range(2):
        row = best[order[r]]
        lead = 0
        for k in range(1, 3):
            if abs(row[k]) > abs(row[lead]) + 1e-6:
                lead = k
        sense = -1.0 if row[lead] < 0.0 else 1.0
        for k in range(3):
            axes[r, k] = sense * row[k] + 0.0
    axes[2] = np.cross(axes[0], axes[1])
    for r in range(3):
        extents[r] = high[order[r]] - low[order[r]]
        middle = 0.5 * (high[order[r]] + low[order[r]])
        for k in range(3):
            center[k] += middle * best[order[r], k]
    # Rounding must not leave a longer side behind a shorter one.
    extents[1] = min(extents[1], extents[0])
    extents[2] = min(extents[2], extents[1])
