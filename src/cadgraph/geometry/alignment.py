"""Whether one mesh is another one moved: kernels that find the motion and verify it vertex by vertex."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.parallel import compiled
from cadgraph.parts import Bools
from cadgraph.scene import Faces, Floats, Ints

__all__ = ["align_by_order", "align_sets", "pick_anchors", "weld"]

# How far the summed unit normals at a vertex, each weighted by its corner's angle [rad], may differ. Rounding moves
# them little where edges are long against it (see below); another surface through the same vertices moves them much.
_NORMAL_TOLERANCE = 0.3
# Faces lower than so many times the tolerance say nothing about normals.
_MIN_HEIGHT = 30.0
# Candidate checks before a pair counts as different, beside 2,000 for each vertex: only point clouds in which
# everything looks alike get there.
_MAX_CHECKS = 2_000_000


@compiled
def pick_anchors(points: Floats, anchors: Ints) -> None:
    """Three vertices far apart: the farthest from the first, the farthest from that, the farthest from their line."""
    start = 0
    for turn in range(2):
        best = -1.0
        for k in range(len(points)):
            d = 0.0
            for c in range(3):
                d += (points[k, c] - points[start, c]) ** 2
            if d > best:
                best = d
                anchors[turn] = k
        start = anchors[turn]
    p, q = points[anchors[0]], points[anchors[1]]
    e = q - p
    best = -1.0
    for k in range(len(points)):
        w = points[k] - p
        x, y, z = e[1] * w[2] - e[2] * w[1], e[2] * w[0] - e[0] * w[2], e[0] * w[1] - e[1] * w[0]
        d = x * x + y * y + z * z
        if d > best:
            best = d
            anchors[2] = k


@compiled
def _frame(e: Floats, w: Floats, frame: Floats) -> bool:
    """Orthonormal rows from two vectors; returns whether they span a plane (else the rows are some completion)."""
    length = np.sqrt(e[0] ** 2 + e[1] ** 2 + e[2] ** 2)
    if length == 0.0:
        frame[:] = np.eye(3)
        return False
    for c in range(3):
        frame[0, c] = e[c] / length
    along = w[0] * frame[0, 0] + w[1] * frame[0, 1] + w[2] * frame[0, 2]
    x, y, z = w[0] - along * frame[0, 0], w[1] - along * frame[0, 1], w[2] - along * frame[0, 2]
    span = np.sqrt(x * x + y * y + z * z)
    spans = bool(span > 1e-9 * length)
    if not spans:
        k = np.argmin(np.abs(frame[0]))
        x, y, z = -frame[0, k] * frame[0, 0], -frame[0, k] * frame[0, 1], -frame[0, k] * frame[0, 2]
        if k == 0:
            x += 1.0
        elif k == 1:
            y += 1.0
        else:
            z += 1.0
        span = np.sqrt(x * x + y * y + z * z)
    frame[1, 0], frame[1, 1], frame[1, 2] = x / span, y / span, z / span
    frame[2, 0] = frame[0, 1] * frame[1, 2] - frame[0, 2] * frame[1, 1]
    frame[2, 1] = frame[0, 2] * frame[1, 0] - frame[0, 0] * frame[1, 2]
    frame[2, 2] = frame[0, 0] * frame[1, 1] - frame[0, 1] * frame[1, 0]
    return spans


@compiled
def _turn_between(source: Floats, target: Floats, sense: float, turn: Floats) -> None:
    """The orthogonal matrix that takes the rows of one frame to those of another; ``sense`` -1 mirrors."""
    for r in range(3):
        for c in range(3):
            turn[r, c] = target[0, r] * source[0, c] + target[1, r] * source[1, c] + sense * target[2, r] * source[2, c]


@compiled
def _same_faces(a: Faces, b: Faces) -> bool:
    """Whether two lists hold the same triangles in the same order, whatever their first corner and sense."""
    if len(a) != len(b):
        return False
    for f in range(len(a)):
        i, j, k = a[f, 0], a[f, 1], a[f, 2]
        p, q, r = b[f, 0], b[f, 1], b[f, 2]
        same = i == p and ((j == q and k == r) or (j == r and k == q))
        same = same or (i == q and ((j == p and k == r) or (j == r and k == p)))
        same = same or (i == r and ((j == p and k == q) or (j == q and k == p)))
        if not same:
            return False
    return True


@compiled
def align_by_order(
    a: Floats, faces_a: Faces, anchors: Ints, b: Floats, faces_b: Faces, tolerance: float, turn: Floats, shift: Floats
) -> int:
    """Finds the motion that takes each vertex of ``a`` to the one of the same number in ``b``.

    Args:
        a: ``(n, 3)`` [m].
        faces_a: ``(m, 3)``.
        anchors: ``(3,)`` vertices of ``a`` that fix the motion.
        b: ``(n, 3)`` [m].
        faces_b: ``(m, 3)``.
        tolerance: greatest distance of a vertex from its counterpart [m].
        turn: ``(3, 3)`` output: b = turn a + shift.
        shift: ``(3,)`` output [m].

    Returns:
        1 for a rigid motion, -1 for a motion with a mirror, 0 for none.
    """
    if len(a) != len(b) or not _same_faces(faces_a, faces_b):
        return 0
    frame_a, frame_b = np.empty((3, 3)), np.empty((3, 3))
    _frame(a[anchors[1]] - a[anchors[0]], a[anchors[2]] - a[anchors[0]], frame_a)
    _frame(b[anchors[1]] - b[anchors[0]], b[anchors[2]] - b[anchors[0]], frame_b)
    limit = tolerance * tolerance
    for sense in (1, -1):
        _turn_between(frame_a, frame_b, float(sense), turn)
        for r in range(3):
            shift[r] = b[anchors[0], r]
            for c in range(3):
                shift[r] -= turn[r, c] * a[anchors[0], c]
        fits = True
        for k in range(len(a)):
            d = 0.0
            for r in range(3):
                x = turn[r, 0] * a[k, 0] + turn[r, 1] * a[k, 1] + turn[r, 2] * a[k, 2] + shift[r] - b[k, r]
                d += x * x
            if not d <= limit:
                fits = False
                break
        if fits:
            return sense
    return 0


@compiled
def weld(
    points: Floats, faces: Faces, centroid: Floats, tolerance: float, spots: Floats, normals: Floats, reach: Floats
) -> int:
    """Merges equal positions that faces use, and describes each by what any motion leaves as it is.

    Args:
        points: ``(n, 3)`` [m].
        faces: ``(m, 3)``.
        centroid: ``(3,)`` [m].
        tolerance: rounding of the positions [m].
        spots: ``(n, 3)`` output: distinct positions relative to the centroid [m].
        normals: ``(n, 3)`` output: their unit normals summed with the corner angles as weights, NaN where a face is
            too small to tell.
        reach: ``(n, 2)`` output: distance from the centroid [m] and area of the faces around [m2].

    Returns:
        How many distinct positions there are.
    """
    n = len(points)
    used = np.zeros(n, np.bool_)
    for f in range(len(faces)):
        # A corner that isn't there takes its face out, as in the properties.
        if faces[f].min() >= 0 and faces[f].max() < n:
            for c in range(3):
                used[faces[f, c]] = True
    spot_of = np.full(n, -1, np.int64)
    capacity = 16
    while capacity < 2 * n:
        capacity *= 2
    table = np.full(capacity, -1, np.int64)
    n_spots = 0
    for k in range(n):
        if not used[k]:
            continue
        x, y, z = points[k, 0], points[k, 1], points[k, 2]
        slot = hash((x + 0.0, y + 0.0, z + 0.0)) & (capacity - 1)
        while table[slot] >= 0:
            other = table[slot]
            if points[other, 0] == x and points[other, 1] == y and points[other, 2] == z:
                break
            slot = (slot + 1) & (capacity - 1)
        if table[slot] < 0:
            table[slot] = k
            spot_of[k] = n_spots
            for c in range(3):
                spots[n_spots, c] = points[k, c] - centroid[c]
                normals[n_spots, c] = 0.0
            reach[n_spots, 0] = np.sqrt(spots[n_spots, 0] ** 2 + spots[n_spots, 1] ** 2 + spots[n_spots, 2] ** 2)
            reach[n_spots, 1] = 0.0
            n_spots += 1
        else:
            spot_of[k] = spot_of[table[slot]]
    for f in range(len(faces)):
        if faces[f].min() >= 0 and faces[f].max() < n:
            _add_corners(points, faces[f], spot_of, tolerance, normals, reach)
    return n_spots


@compiled
def _add_corners(points: Floats, face: Faces, spot_of: Ints, tolerance: float, normals: Floats, reach: Floats) -> None:
    normal = np.empty(3)
    u = points[face[1]] - points[face[0]]
    w = points[face[2]] - points[face[0]]
    normal[0], normal[1], normal[2] = u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]
    double = np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    v = w - u
    lengths = np.array([(v * v).sum(), (w * w).sum(), (u * u).sum()])
    longest = np.sqrt(lengths.max())
    if longest == 0.0:
        return
    vague = double <= _MIN_HEIGHT * tolerance * longest
    for c in range(3):
        spot = spot_of[face[c]]
        reach[spot, 1] += 0.5 * double
        if vague:
            normals[spot, :] = np.nan
            continue
        a, b = lengths[(c + 1) % 3], lengths[(c + 2) % 3]
        angle = np.arctan2(double, 0.5 * (a + b - lengths[c]))
        for k in range(3):
            normals[spot, k] += angle * normal[k] / double


@compiled
def _classes(reach: Floats, tolerance: float, strict: bool) -> Ints:
    """How many vertices look like each one: same distance from the centroid and, if strict, same area around."""
    n = len(reach)
    order = np.argsort(reach[:, 0])
    size = np.empty(n, np.int64)
    start = 0
    for k in range(1, n + 1):
        if k < n and reach[order[k], 0] - reach[order[k - 1], 0] <= tolerance:
            continue
        block = order[start:k]
        if strict:
            block = block[np.argsort(reach[block, 1])]
        first = 0
        for i in range(1, len(block) + 1):
            if i < len(block) and (
                not strict
                or reach[block[i], 1] - reach[block[i - 1], 1] <= _area_tolerance(reach[block[i], 1], tolerance)
            ):
                continue
            for j in range(first, i):
                size[block[j]] = i - first
            first = i
        start = k
    return size


@compiled
def _area_tolerance(area: float, tolerance: float) -> float:
    """How much rounding may change the area around a vertex [m2]."""
    return float(1e-3 * area + 8.0 * tolerance * np.sqrt(area) + 1e-12)


@compiled
def _pick_pair(spots: Floats, reach: Floats, size: Ints) -> tuple[int, int]:
    """Two vertices of rare looks that fix a motion about the centroid; the second is -1 if all lie on one line."""
    farthest = reach[:, 0].max()
    first = -1
    for k in range(len(spots)):
        if reach[k, 0] > 0.3 * farthest and (first < 0 or size[k] < size[first]):
            first = k
    second, widest = -1, -1
    widest_sine = 1e-6
    p = spots[first]
    for k in range(len(spots)):
        q = spots[k]
        x, y, z = p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]
        sine = np.sqrt(x * x + y * y + z * z) / (reach[first, 0] * farthest)
        if sine > widest_sine:
            widest, widest_sine = k, sine
        if sine > 0.3 and (second < 0 or size[k] < size[second]):
            second = k
    return first, second if second >= 0 else widest


@compiled
def _grid(spots: Floats, low: Floats, step: Floats, dims: Ints) -> tuple[Ints, Ints]:
    """Sorts points into the cells of a regular grid: starts of each cell, and the points by cell."""
    n = len(spots)
    wanted = min(64, int(np.ceil(n ** (1.0 / 3.0))))
    for c in range(3):
        low[c] = spots[:, c].min()
        span = spots[:, c].max() - low[c]
        dims[c] = wanted if span > 0.0 else 1
        step[c] = span / dims[c] if span > 0.0 else 1.0
    cell = np.empty(n, np.int64)
    starts = np.zeros(dims[0] * dims[1] * dims[2] + 1, np.int64)
    for k in range(n):
        at = 0
        for c in range(3):
            i = min(dims[c] - 1, max(0, int((spots[k, c] - low[c]) / step[c])))
            at = at * dims[c] + i
        cell[k] = at
        starts[at + 1] += 1
    for k in range(1, len(starts)):
        starts[k] += starts[k - 1]
    fill = starts[:-1].copy()
    members = np.empty(n, np.int64)
    for k in range(n):
        members[fill[cell[k]]] = k
        fill[cell[k]] += 1
    return starts, members


@compiled
def _nearest(
    point: Floats, spots: Floats, low: Floats, step: Floats, dims: Ints, starts: Ints, members: Ints, limit: float
) -> int:
    """The nearest point within ``limit``, or -1."""
    first, last = np.empty(3, np.int64), np.empty(3, np.int64)
    for c in range(3):
        first[c] = max(0, int(np.floor((point[c] - limit - low[c]) / step[c])))
        last[c] = min(dims[c] - 1, int(np.floor((point[c] + limit - low[c]) / step[c])))
        # The far edge of the grid belongs to its last cell.
        first[c] = min(first[c], dims[c] - 1)
    found, best = -1, limit * limit
    for i in range(first[0], last[0] + 1):
        for j in range(first[1], last[1] + 1):
            for k in range(first[2], last[2] + 1):
                at = (i * dims[1] + j) * dims[2] + k
                for s in range(starts[at], starts[at + 1]):
                    m = members[s]
                    x, y, z = spots[m, 0] - point[0], spots[m, 1] - point[1], spots[m, 2] - point[2]
                    d = x * x + y * y + z * z
                    if d <= best:
                        found, best = m, d
    return found


@compiled
def _fits(
    turn: Floats, spots_a: Floats, normals_a: Floats, spots_b: Floats, normals_b: Floats, tolerance: float,
    low: Floats, step: Floats, dims: Ints, starts: Ints, members: Ints, taken: Bools, checks: Ints,
) -> bool:  # fmt: skip
    """Whether each vertex of a, turned, is one of b's with a like normal, and none of b's is left over."""
    n = len(spots_a)
    taken[:] = False
    n_taken = 0
    point, normal = np.empty(3), np.empty(3)
    for k in range(n):
        checks[0] += 1
        for r in range(3):
            point[r] = turn[r, 0] * spots_a[k, 0] + turn[r, 1] * spots_a[k, 1] + turn[r, 2] * spots_a[k, 2]
            normal[r] = turn[r, 0] * normals_a[k, 0] + turn[r, 1] * normals_a[k, 1] + turn[r, 2] * normals_a[k, 2]
        m = _nearest(point, spots_b, low, step, dims, starts, members, tolerance)
        if m < 0:
            return False
        along = against = 0.0
        for r in range(3):
            along += (normal[r] - normals_b[m, r]) ** 2
            against += (normal[r] + normals_b[m, r]) ** 2
        # The sense of faces is no part of the shape: CAD has it wrong too often. NaN passes.
        if min(along, against) > _NORMAL_TOLERANCE**2:
            return False
        if not taken[m]:
            taken[m] = True
            n_taken += 1
    return n_taken == n


@compiled
def align_sets(
    spots_a: Floats, normals_a: Floats, reach_a: Floats, spots_b: Floats, normals_b: Floats, reach_b: Floats,
    tolerance: float, sense: int, strict: bool, turn: Floats,
) -> bool:  # fmt: skip
    """Finds the turn about the centroids that takes one set of welded vertices to another, in any order.

    Two vertices of ``a`` of the rarest looks are taken to every pair of ``b`` that looks the same, and each turn
    that follows is verified on all vertices. Parts of any symmetry are found, since any of their poses will do.

    Args:
        spots_a: ``(n, 3)`` and so on: what ``weld`` gives for each side.
        normals_a: see ``spots_a``.
        reach_a: see ``spots_a``.
        spots_b: see ``spots_a``.
        normals_b: see ``spots_a``.
        reach_b: see ``spots_a``.
        tolerance: greatest distance of a vertex from its counterpart [m].
        sense: 1 for a rigid motion, -1 for one with a mirror.
        strict: whether the faces around a vertex must have the same area too, which the diagonal of a flat
            quadrangle can change; without it, symmetric parts take longer.
        turn: ``(3, 3)`` output.

    Returns:
        Whether there is one.
    """
    n = len(spots_a)
    if n != len(spots_b) or n == 0:
        return False
    first, second = _pick_pair(spots_a, reach_a, _classes(reach_a, tolerance, strict))
    low, step, dims = np.empty(3), np.empty(3), np.empty(3, np.int64)
    starts, members = _grid(spots_b, low, step, dims)
    taken = np.empty(n, np.bool_)
    checks = np.zeros(1, np.int64)
    frame_a, frame_b = np.empty((3, 3)), np.empty((3, 3))
    p, q = spots_a[first], spots_a[second] if second >= 0 else spots_a[first]
    _frame(p, q, frame_a)
    apart = np.sqrt(((p - q) ** 2).sum())
    likes_p = _alike(reach_a[first], reach_b, tolerance, strict)
    likes_q = _alike(reach_a[second] if second >= 0 else reach_a[first], reach_b, tolerance, strict)
    for i in likes_p:
        for j in likes_q:
            checks[0] += 1
            if checks[0] > _MAX_CHECKS + 2000 * n:
                return False
            d = np.sqrt(((spots_b[i] - spots_b[j]) ** 2).sum())
            if abs(d - apart) > 2.0 * tolerance:
                continue
            _frame(spots_b[i], spots_b[j], frame_b)
            _turn_between(frame_a, frame_b, float(sense), turn)
            if _fits(
                turn, spots_a, normals_a, spots_b, normals_b, tolerance,
                low, step, dims, starts, members, taken, checks,
            ):  # fmt: skip
                return True
    return False


@compiled
def _alike(look: Floats, reach: Floats, tolerance: float, strict: bool) -> Ints:
    """The vertices that look like a given one."""
    found = np.empty(len(reach), np.int64)
    m = 0
    for k in range(len(reach)):
        if abs(reach[k, 0] - look[0]) > tolerance:
            continue
        if strict and abs(reach[k, 1] - look[1]) > _area_tolerance(look[1], tolerance):
            continue
        found[m] = k
        m += 1
    return found[:m]


@compiled
def fits_in_place(spots_a: Floats, normals_a: Floats, spots_b: Floats, normals_b: Floats, tolerance: float) -> bool:
    """Whether two sets of welded vertices, both relative to one point, coincide without any motion.

    Args:
        spots_a: ``(n, 3)`` [m].
        normals_a: ``(n, 3)`` as from ``weld``.
        spots_b: ``(n, 3)`` [m].
        normals_b: ``(n, 3)``.
        tolerance: greatest distance of a vertex from its counterpart [m].
    """
    n = len(spots_a)
    if n != len(spots_b) or n == 0:
        return False
    low, step, dims = np.empty(3), np.empty(3), np.empty(3, np.int64)
    starts, members = _grid(spots_b, low, step, dims)
    return _fits(
        np.eye(3), spots_a, normals_a, spots_b, normals_b, tolerance,
        low, step, dims, starts, members, np.empty(n, np.bool_), np.zeros(1, np.int64),
    )  # fmt: skip
