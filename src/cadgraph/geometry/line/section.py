"""Cross-sections of a triangle soup: what a plane cuts, and the rings around a point of it.

Nothing here needs to know which triangles are neighbours, so soup, open ends and doubled faces do no harm.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats, Ints

__all__ = ["MAX_RINGS", "N_RAYS", "ROUND", "cut", "find_rings", "plane_axes"]

N_RAYS = 64
MAX_RINGS = 4
# How far a ring's points may lie off its circle, as share of the radius: the sides of a hexagon are 0.134 inside
# the circle through its corners, those of a square 0.293.
ROUND = 0.15
# Share of the rays that must meet a ring for it to count as whole; a seam may let one or two slip through.
_WHOLE = 0.95
# Hits closer than this share of their distance are one: the same wall twice.
_DOUBLE = 1e-4
# Rings share a centre within this share of the inner radius.
_CONCENTRIC = 0.25


@compiled
def plane_axes(normal: Floats, u: Floats, w: Floats) -> None:
    """Two unit vectors that with the unit normal form a right-handed frame."""
    k = np.argmin(np.abs(normal))
    e = np.zeros(3)
    e[k] = 1.0
    u[0] = normal[1] * e[2] - normal[2] * e[1]
    u[1] = normal[2] * e[0] - normal[0] * e[2]
    u[2] = normal[0] * e[1] - normal[1] * e[0]
    length = np.sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
    for c in range(3):
        u[c] /= length
    w[0] = normal[1] * u[2] - normal[2] * u[1]
    w[1] = normal[2] * u[0] - normal[0] * u[2]
    w[2] = normal[0] * u[1] - normal[1] * u[0]


@compiled
def cut(
    corners: Floats, center: Floats, normal: Floats, u: Floats, w: Floats, limit: float, segments: Floats, owners: Ints
) -> int:
    """Cuts triangles with a plane.

    Args:
        corners: ``(m, 9)`` triangles [m].
        center: ``(3,)`` a point of the plane, the origin of its coordinates [m].
        normal: ``(3,)`` unit normal.
        u: ``(3,)`` first axis in the plane.
        w: ``(3,)`` second axis in the plane.
        limit: segments wholly farther from the centre along an axis are left out [m].
        segments: ``(m, 4)`` output: two ends in the plane [m].
        owners: ``(m,)`` output: the triangle of each.

    Returns:
        How many segments there are.
    """
    n = 0
    offset = center[0] * normal[0] + center[1] * normal[1] + center[2] * normal[2]
    for f in range(len(corners)):
        t = corners[f]
        a = t[0] * normal[0] + t[1] * normal[1] + t[2] * normal[2] - offset
        b = t[3] * normal[0] + t[4] * normal[1] + t[5] * normal[2] - offset
        c = t[6] * normal[0] + t[7] * normal[1] + t[8] * normal[2] - offset
        above_a, above_b, above_c = a >= 0.0, b >= 0.0, c >= 0.0
        if above_a == above_b and above_b == above_c:
            continue
        # The corner that is alone on its side, and the two others.
        if above_b == above_c:
            i, j, k, p, q, r = 0, 3, 6, a, b, c
        elif above_a == above_c:
            i, j, k, p, q, r = 3, 6, 0, b, c, a
        else:
            i, j, k, p, q, r = 6, 0, 3, c, a, b
        s, v = p / (p - q), p / (p - r)
        x0 = y0 = x1 = y1 = 0.0
        for e in range(3):
            first = t[i + e] + s * (t[j + e] - t[i + e]) - center[e]
            second = t[i + e] + v * (t[k + e] - t[i + e]) - center[e]
            x0 += first * u[e]
            y0 += first * w[e]
            x1 += second * u[e]
            y1 += second * w[e]
        if min(abs(x0), abs(x1)) > limit or min(abs(y0), abs(y1)) > limit:
            continue
        segments[n, 0], segments[n, 1], segments[n, 2], segments[n, 3] = x0, y0, x1, y1
        owners[n] = f
        n += 1
    return n


@compiled
def _cast(segments: Floats, n: int, x: float, y: float, hits: Floats, counts: Ints) -> None:
    """Where evenly spaced rays from (x, y) meet the segments: the nearest few distances of each ray, ascending."""
    hits[:] = np.inf
    counts[:] = 0
    pitch = 2.0 * np.pi / N_RAYS
    for s in range(n):
        x0, y0, x1, y1 = segments[s, 0] - x, segments[s, 1] - y, segments[s, 2] - x, segments[s, 3] - y
        start = np.arctan2(y0, x0)
        turn = np.arctan2(y1, x1) - start
        if turn > np.pi:
            turn -= 2.0 * np.pi
        elif turn < -np.pi:
            turn += 2.0 * np.pi
        if turn < 0.0:
            start, turn = start + turn, -turn
        # Rays stand at odd angles, so that they miss the corners of regular polygons.
        first = int(np.ceil(start / pitch - 0.37))
        last = int(np.floor((start + turn) / pitch - 0.37))
        cross = x0 * y1 - y0 * x1
        for k in range(first, last + 1):
            angle = (k + 0.37) * pitch
            slope = np.cos(angle) * (y1 - y0) - np.sin(angle) * (x1 - x0)
            if slope == 0.0:
                continue
            t = cross / slope
            if not t > 0.0:
                continue
            if _insert(hits[k % N_RAYS], t):
                counts[k % N_RAYS] = min(counts[k % N_RAYS] + 1, MAX_RINGS)


@compiled
def _insert(row: Floats, t: float) -> bool:
    """Puts a distance into an ascending row that keeps the least few; not if it is there already, or too great."""
    at = 0
    while at < MAX_RINGS and row[at] < t * (1.0 - _DOUBLE):
        at += 1
    if at == MAX_RINGS or row[at] <= t * (1.0 + _DOUBLE):
        return False
    for m in range(MAX_RINGS - 1, at, -1):
        row[m] = row[m - 1]
    row[at] = t
    return True


@compiled
def _fit_circle(hits: Floats, level: int, circle: Floats) -> float:
    """Least-squares circle (Kasa 1976) through one hit of each ray; returns the greatest deviation over the radius."""
    pitch = 2.0 * np.pi / N_RAYS
    n = 0
    sx = sy = sxx = syy = sxy = sz = sxz = syz = 0.0
    for k in range(N_RAYS):
        t = hits[k, level]
        if t == np.inf:
            continue
        x, y = t * np.cos((k + 0.37) * pitch), t * np.sin((k + 0.37) * pitch)
        z = x * x + y * y
        n += 1
        sx += x
        sy += y
        sxx += x * x
        syy += y * y
        sxy += x * y
        sz += z
        sxz += x * z
        syz += y * z
    if n < 3:
        return np.inf
    mx, my, mz = sx / n, sy / n, sz / n
    cxx, cyy, cxy = sxx / n - mx * mx, syy / n - my * my, sxy / n - mx * my
    cxz, cyz = sxz / n - mx * mz, syz / n - my * mz
    det = cxx * cyy - cxy * cxy
    if not det > 1e-12 * mz * mz:
        return np.inf
    a = 0.5 * (cxz * cyy - cyz * cxy) / det
    b = 0.5 * (cyz * cxx - cxz * cxy) / det
    radius = np.sqrt(max(mz - 2.0 * (a * mx + b * my) + a * a + b * b, 0.0))
    if not radius > 0.0:
        return np.inf
    circle[0], circle[1], circle[2] = a, b, radius
    worst = 0.0
    for k in range(N_RAYS):
        t = hits[k, level]
        if t < np.inf:
            x, y = t * np.cos((k + 0.37) * pitch) - a, t * np.sin((k + 0.37) * pitch) - b
            worst = max(worst, abs(np.sqrt(x * x + y * y) - radius))
    return float(worst / radius)


@compiled
def find_rings(
    segments: Floats, owners: Ints, n: int, normals: Floats, axis: Floats, u: Floats, w: Floats,
    expected: float, rings: Floats, moments: Floats, ring_of: Ints,
) -> tuple[int, float]:  # fmt: skip
    """Finds the concentric rings around the origin of a section.

    Args:
        segments: ``(m, 4)`` as from ``cut``.
        owners: ``(m,)`` their triangles.
        n: how many of them count.
        normals: ``(k, 3)`` unit normals of all triangles.
        axis: ``(3,)`` normal of the plane.
        u: ``(3,)`` first axis in the plane.
        w: ``(3,)`` second axis in the plane.
        expected: radius that the innermost ring should have [m], or 0.
        rings: ``(MAX_RINGS, 4)`` output: centre in the plane and radius of the circle through the corners [m], and
            which way the wall looks, 1 outward, -1 inward; innermost first.
        moments: ``(3, 3)`` output: covariance of the normals of the innermost ring, turned outward.
        ring_of: ``(m,)`` output: the ring of each segment, or -1.

    Returns:
        How many whole rings there are, and the share of the rays that meet something at the expected radius.
    """
    hits = np.empty((N_RAYS, MAX_RINGS))
    counts = np.empty(N_RAYS, np.int64)
    _cast(segments, n, 0.0, 0.0, hits, counts)
    support = _count_support(hits, counts, expected) if expected > 0.0 else 0
    n_rings = 0
    circle = np.empty(3)
    for level in range(MAX_RINGS):
        if (counts > level).sum() < _WHOLE * N_RAYS or _fit_circle(hits, level, circle) > ROUND:
            break
        if level > 0 and np.hypot(circle[0] - rings[0, 0], circle[1] - rings[0, 1]) > _CONCENTRIC * rings[0, 2]:
            break
        rings[level, :3] = circle
        n_rings += 1
    ring_of[:n] = -1
    if n_rings > 0:
        _assign(segments, n, hits, counts, n_rings, ring_of)
        _measure_rings(segments, owners, n, normals, u, w, n_rings, rings, moments, ring_of)
    return n_rings, support / N_RAYS


@compiled
def _count_support(hits: Floats, counts: Ints, expected: float) -> int:
    """How many rays meet something at an expected radius [m]."""
    support = 0
    for k in range(N_RAYS):
        for level in range(counts[k]):
            if abs(hits[k, level] - expected) <= ROUND * expected:
                support += 1
                break
    return support


@compiled
def _assign(segments: Floats, n: int, hits: Floats, counts: Ints, n_rings: int, ring_of: Ints) -> None:
    """Gives each segment to the ring that the nearest ray meets at its distance."""
    pitch = 2.0 * np.pi / N_RAYS
    for s in range(n):
        x, y = 0.5 * (segments[s, 0] + segments[s, 2]), 0.5 * (segments[s, 1] + segments[s, 3])
        distance = np.hypot(x, y)
        k = int(np.round(np.arctan2(y, x) / pitch - 0.37)) % N_RAYS
        best = 0.08 * distance
        for level in range(min(n_rings, counts[k])):
            gap = abs(hits[k, level] - distance)
            if gap < best:
                best = gap
                ring_of[s] = level


@compiled
def _measure_rings(
    segments: Floats, owners: Ints, n: int, normals: Floats, u: Floats, w: Floats, n_rings: int,
    rings: Floats, moments: Floats, ring_of: Ints,
) -> None:  # fmt: skip
    """Centre of each ring as the centroid of its outline, radius as that of its farthest corner."""
    sums = _outlines(segments, n, n_rings, ring_of)
    for level in range(n_rings):
        if sums[level, 0] > 0.0:
            rings[level, 0] = sums[level, 1] / sums[level, 0]
            rings[level, 1] = sums[level, 2] / sums[level, 0]
            rings[level, 2] = 0.0
        rings[level, 3] = 0.0
    moments[:] = 0.0
    mean = np.zeros(3)
    total = 0.0
    for s in range(n):
        level = ring_of[s]
        if level < 0:
            continue
        for end in range(0, 4, 2):
            away = np.hypot(segments[s, end] - rings[level, 0], segments[s, end + 1] - rings[level, 1])
            rings[level, 2] = max(rings[level, 2], away)
        length = np.hypot(segments[s, 2] - segments[s, 0], segments[s, 3] - segments[s, 1])
        normal = normals[owners[s]]
        sense = _sense(segments[s], rings[level], normal, u, w)
        rings[level, 3] += sense * length / sums[level, 0]
        if level == 0:
            total += length
            for r in range(3):
                mean[r] += length * sense * normal[r]
                for c in range(3):
                    moments[r, c] += length * normal[r] * normal[c]
    if total > 0.0:
        _center(moments, mean, total)


@compiled
def _outlines(segments: Floats, n: int, n_rings: int, ring_of: Ints) -> Floats:
    """``(n_rings, 3)`` length of each ring [m] and its middle in the plane times that."""
    sums = np.zeros((n_rings, 3))
    for s in range(n):
        level = ring_of[s]
        if level < 0:
            continue
        length = np.hypot(segments[s, 2] - segments[s, 0], segments[s, 3] - segments[s, 1])
        sums[level, 0] += length
        sums[level, 1] += length * 0.5 * (segments[s, 0] + segments[s, 2])
        sums[level, 2] += length * 0.5 * (segments[s, 1] + segments[s, 3])
    return sums


@compiled
def _sense(segment: Floats, ring: Floats, normal: Floats, u: Floats, w: Floats) -> float:
    """Whether a wall looks away from the middle of its ring, 1, or towards it, -1."""
    x = 0.5 * (segment[0] + segment[2]) - ring[0]
    y = 0.5 * (segment[1] + segment[3]) - ring[1]
    outward = 0.0
    for c in range(3):
        outward += normal[c] * (x * u[c] + y * w[c])
    return 1.0 if outward >= 0.0 else -1.0


@compiled
def _center(moments: Floats, mean: Floats, total: float) -> None:
    """Turns weighted sums of products into a covariance."""
    for r in range(3):
        for c in range(3):
            moments[r, c] = moments[r, c] / total - mean[r] * mean[c] / (total * total)
