"""Whether one mesh is another one moved: kernels that find the motion and verify it vertex by vertex."""

from __future__ import annotations

from math import ceil, floor, sqrt

import numpy as np

from cadgraph.geometry.kernels.order import sort_rows
from cadgraph.geometry.kernels.parallel import ZERO, compiled
from cadgraph.geometry.mesh.weld import weld
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = [
    "align_by_order",
    "align_sets",
    "count_cells",
    "fits_in_place",
    "pick_anchors",
    "weld",
]

# How far the summed unit normals at a vertex, each weighted by its corner's angle [rad], may differ. Rounding moves
# them little where edges are long against it (see below); another surface through the same vertices moves them much.
_NORMAL_TOLERANCE = 0.3
# Candidate checks before a pair counts as different, beside 2,000 for each vertex: only point clouds in which
# everything looks alike get there.
_MAX_CHECKS = 2_000_000


@compiled
def pick_anchors(vertices: Floats, v0: int, v1: int, row: int, anchors: Ints) -> None:
    """Three vertices far apart: the farthest from the first, the farthest from that, the farthest from their line.

    Args:
        vertices: ``(n_vertices, 3)`` [m].
        v0: the first vertex of the mesh.
        v1: the end of its vertices.
        row: where to put the outcome.
        anchors: ``(n, 3)`` output: vertices, counted from ``v0``.
    """
    px, py, pz = vertices[v0, 0], vertices[v0, 1], vertices[v0, 2]
    ex = ey = ez = 0.0
    for turn in range(3):
        best, found = -1.0, v0
        for v in range(v0, v1):
            x, y, z = vertices[v, 0] - px, vertices[v, 1] - py, vertices[v, 2] - pz
            if turn == 2:
                x, y, z = ey * z - ez * y, ez * x - ex * z, ex * y - ey * x
            d = x * x + y * y + z * z
            if d > best:
                best, found = d, v
        anchors[row, turn] = found - v0
        x, y, z = vertices[found, 0], vertices[found, 1], vertices[found, 2]
        if turn == 0:
            px, py, pz = x, y, z
        else:
            ex, ey, ez = x - px, y - py, z - pz


@compiled
def _frame(ex: float, ey: float, ez: float, wx: float, wy: float, wz: float, frame: Floats) -> None:
    """Orthonormal rows from two vectors; some completion of the first where they span no plane."""
    length = sqrt(ex * ex + ey * ey + ez * ez)
    if length == 0.0:
        for r in range(3):
            for c in range(3):
                frame[r, c] = 1.0 if r == c else 0.0
        return
    ex, ey, ez = ex / length, ey / length, ez / length
    along = wx * ex + wy * ey + wz * ez
    x, y, z = wx - along * ex, wy - along * ey, wz - along * ez
    span = sqrt(x * x + y * y + z * z)
    if not span > 1e-9 * length:
        # From the axis that it is farthest from.
        if abs(ex) <= abs(ey) and abs(ex) <= abs(ez):
            x, y, z = 1.0 - ex * ex, -ex * ey, -ex * ez
        elif abs(ey) <= abs(ez):
            x, y, z = -ey * ex, 1.0 - ey * ey, -ey * ez
        else:
            x, y, z = -ez * ex, -ez * ey, 1.0 - ez * ez
        span = sqrt(x * x + y * y + z * z)
    x, y, z = x / span, y / span, z / span
    frame[0, 0], frame[0, 1], frame[0, 2] = ex, ey, ez
    frame[1, 0], frame[1, 1], frame[1, 2] = x, y, z
    frame[2, 0], frame[2, 1], frame[2, 2] = ey * z - ez * y, ez * x - ex * z, ex * y - ey * x


@compiled
def _frame_at(points: Floats, a: int, b: int, c: int, frame: Floats) -> None:
    """The frame of three points: first row from the first to the second, then towards the third."""
    x, y, z = points[a, 0], points[a, 1], points[a, 2]
    _frame(
        points[b, 0] - x,
        points[b, 1] - y,
        points[b, 2] - z,
        points[c, 0] - x,
        points[c, 1] - y,
        points[c, 2] - z,
        frame,
    )


@compiled
def _turn_between(source: Floats, target: Floats, sense: int, turn: Floats) -> None:
    """The orthogonal matrix that takes the rows of one frame to those of another; ``sense`` -1 mirrors."""
    for r in range(3):
        for c in range(3):
            turn[r, c] = target[0, r] * source[0, c] + target[1, r] * source[1, c] + sense * target[2, r] * source[2, c]


@compiled
def _same_faces(faces: Faces, a: int, b: int, n: int) -> bool:
    """Whether the ``n`` triangles from ``a`` and from ``b`` on are the same, whatever their first corner and sense."""
    for f in range(n):
        i, j, k = faces[a + f, 0], faces[a + f, 1], faces[a + f, 2]
        p, q, r = faces[b + f, 0], faces[b + f, 1], faces[b + f, 2]
        same = i == p and ((j == q and k == r) or (j == r and k == q))
        same = same or (i == q and ((j == p and k == r) or (j == r and k == p)))
        same = same or (i == r and ((j == p and k == q) or (j == q and k == p)))
        if not same:
            return False
    return True


@compiled
def align_by_order(
    vertices: Floats, a: int, b: int, n: int, faces: Faces, faces_a: int, faces_b: int, n_faces: int,
    anchors: Ints, row: int, tolerance: float, frame_a: Floats, frame_b: Floats, turn: Floats, shift: Floats,
) -> int:  # fmt: skip
    """Finds the motion that takes each vertex of one mesh to the one of the same number in another.

    Args:
        vertices: ``(n_vertices, 3)`` [m].
        a: where the vertices of the one start.
        b: where the vertices of the other start.
        n: how many vertices each has.
        faces: ``(n_faces, 3)`` vertices, counted from the mesh's first.
        faces_a: where the faces of the one start.
        faces_b: where the faces of the other start.
        n_faces: how many faces each has.
        anchors: ``(n, 3)`` vertices of ``a`` that fix the motion.
        row: which row of ``anchors``.
        tolerance: greatest distance of a vertex from its counterpart [m].
        frame_a: ``(3, 3)`` workspace.
        frame_b: ``(3, 3)`` workspace.
        turn: ``(3, 3)`` output: b = turn a + shift.
        shift: ``(3,)`` output [m].

    Returns:
        1 for a rigid motion, -1 for a motion with a mirror, 0 for none.
    """
    if not _same_faces(faces, faces_a, faces_b, n_faces):
        return 0
    p, q, r = anchors[row, 0], anchors[row, 1], anchors[row, 2]
    _frame_at(vertices, a + p, a + q, a + r, frame_a)
    _frame_at(vertices, b + p, b + q, b + r, frame_b)
    for mirrored in range(2):
        sense = 1 - 2 * mirrored
        _turn_between(frame_a, frame_b, sense, turn)
        for r in range(3):
            shift[r] = vertices[b + p, r]
            for c in range(3):
                shift[r] -= turn[r, c] * vertices[a + p, c]
        fits = True
        for k in range(n):
            d = 0.0
            x, y, z = vertices[a + k, 0], vertices[a + k, 1], vertices[a + k, 2]
            for r in range(3):
                gap = turn[r, 0] * x + turn[r, 1] * y + turn[r, 2] * z + shift[r] - vertices[b + k, r]
                d += gap * gap
            if not d <= tolerance * tolerance:
                fits = False
                break
        if fits:
            return sense
    return 0


@compiled
def _classes(
    reach: Floats, a: int, n: int, tolerance: float, strict: bool, rows: Floats, spare: Floats, size: Ints
) -> None:
    """How many vertices look like each one: same distance from the centroid and, if strict, same area around."""
    for k in range(n):
        rows[k, 0], rows[k, 1] = reach[a + k, 0], k
    sort_rows(rows, ZERO, n, spare)
    start = ZERO
    while start < n:
        end = start + 1
        while end < n and rows[end, 0] - rows[end - 1, 0] <= tolerance:
            end += 1
        if strict:
            for k in range(start, end):
                rows[k, 0] = reach[a + int(rows[k, 1]), 1]
            sort_rows(rows, start, end, spare)
        first = start
        for k in range(start + 1, end + 1):
            if k < end and (not strict or rows[k, 0] - rows[k - 1, 0] <= _area_tolerance(rows[k, 0], tolerance)):
                continue
            for j in range(first, k):
                size[int(rows[j, 1])] = k - first
            first = k
        start = end


@compiled
def _area_tolerance(area: float, tolerance: float) -> float:
    """How much rounding may change the area around a vertex [m2]."""
    return 1e-3 * area + 8.0 * tolerance * sqrt(area) + 1e-12


@compiled
def _pick_pair(spots: Floats, reach: Floats, a: int, n: int, size: Ints) -> tuple[int, int]:
    """Two vertices of rare looks that fix a motion about the centroid; both the same if all lie on one line."""
    farthest = 0.0
    for k in range(n):
        farthest = max(farthest, reach[a + k, 0])
    first = -1
    for k in range(n):
        if reach[a + k, 0] > 0.3 * farthest and (first < 0 or size[k] < size[first]):
            first = k
    first = max(first, 0)
    second, widest = -1, first
    widest_sine = 1e-6
    px, py, pz = spots[a + first, 0], spots[a + first, 1], spots[a + first, 2]
    for k in range(n):
        qx, qy, qz = spots[a + k, 0], spots[a + k, 1], spots[a + k, 2]
        x, y, z = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
        sine = sqrt(x * x + y * y + z * z) / (reach[a + first, 0] * farthest)
        if sine > widest_sine:
            widest, widest_sine = k, sine
        if sine > 0.3 and (second < 0 or size[k] < size[second]):
            second = k
    return first, second if second >= 0 else widest


@compiled
def _cells_along(n: int) -> int:
    """How many cells along each axis there are for ``n`` points."""
    return int(min(64.0, ceil(n ** (1.0 / 3.0))))


@compiled
def count_cells(n: int) -> int:
    """The most cells that ``n`` points are sorted into."""
    return _cells_along(n) ** 3


@compiled
def _cell(x: float, axis: int, grid: Floats) -> int:
    """Which of the cells along an axis a coordinate is in, or nearest to; the far edge belongs to the last one."""
    at, last = floor((x - grid[axis, 0]) / grid[axis, 1]), grid[axis, 2] - 1.0
    if at > last:
        at = last
    return int(at) if at > 0.0 else 0


@compiled
def _sort_cells(spots: Floats, b: int, n: int, grid: Floats, starts: Ints, members: Ints, cells: Ints) -> None:
    """Sorts points into the cells of a regular grid: starts of each cell, and the points by cell.

    Rows of ``grid`` are, for each axis: where it starts, the size of a cell, how many there are.
    """
    wanted = _cells_along(n)
    n_cells = 1
    for c in range(3):
        low = high = spots[b, c]
        for k in range(b, b + n):
            low, high = min(low, spots[k, c]), max(high, spots[k, c])
        grid[c, 0], grid[c, 1], grid[c, 2] = low, 1.0, 1.0
        if high > low:
            grid[c, 1], grid[c, 2] = (high - low) / wanted, wanted
        n_cells *= int(grid[c, 2])
    for k in range(n_cells + 1):
        starts[k] = 0
    for k in range(n):
        at = 0
        for c in range(3):
            at = at * int(grid[c, 2]) + _cell(spots[b + k, c], ZERO + c, grid)
        cells[k] = at
        starts[at] += 1
    for k in range(1, n_cells + 1):
        starts[k] += starts[k - 1]
    # Filled from the back, each start moves down to where its cell begins.
    for step in range(1, n + 1):
        k = n - step
        starts[cells[k]] -= 1
        members[starts[cells[k]]] = k


@compiled
def _nearest(
    x: float, y: float, z: float, spots: Floats, b: int, grid: Floats, starts: Ints, members: Ints, limit: float
) -> int:
    """The nearest point within ``limit``, or -1."""
    found, best = -1, limit * limit
    n_y, n_z = int(grid[1, 2]), int(grid[2, 2])
    x_axis, y_axis, z_axis = ZERO, ZERO + 1, ZERO + 2
    y_low, y_high = _cell(y - limit, y_axis, grid), _cell(y + limit, y_axis, grid)
    z_low, z_high = _cell(z - limit, z_axis, grid), _cell(z + limit, z_axis, grid)
    for i in range(_cell(x - limit, x_axis, grid), _cell(x + limit, x_axis, grid) + 1):
        for j in range(y_low, y_high + 1):
            at = (i * n_y + j) * n_z
            # Cells along the last axis follow each other.
            for s in range(starts[at + z_low], starts[at + z_high + 1]):
                m = members[s]
                u, v, w = spots[b + m, 0] - x, spots[b + m, 1] - y, spots[b + m, 2] - z
                d = u * u + v * v + w * w
                if d <= best:
                    found, best = m, d
    return found


@compiled
def _n_fitting(
    turn: Floats, spots: Floats, normals: Floats, a: int, b: int, n: int, tolerance: float,
    grid: Floats, starts: Ints, members: Ints, taken: Ints,
) -> int:  # fmt: skip
    """How many vertices of a, turned, are one of b's with a like normal; ``n`` only if none of b's is left over."""
    for k in range(n):
        taken[k] = 0
    n_taken = 0
    for k in range(a, a + n):
        x, y, z = spots[k, 0], spots[k, 1], spots[k, 2]
        m = _nearest(
            turn[0, 0] * x + turn[0, 1] * y + turn[0, 2] * z,
            turn[1, 0] * x + turn[1, 1] * y + turn[1, 2] * z,
            turn[2, 0] * x + turn[2, 1] * y + turn[2, 2] * z,
            spots, b, grid, starts, members, tolerance,
        )  # fmt: skip
        if m < 0:
            return k - a
        x, y, z = normals[k, 0], normals[k, 1], normals[k, 2]
        along = against = 0.0
        for r in range(3):
            h = turn[r, 0] * x + turn[r, 1] * y + turn[r, 2] * z
            other = normals[b + m, r]
            along += (h - other) * (h - other)
            against += (h + other) * (h + other)
        # The sense of faces is no part of the shape: CAD has it wrong too often. NaN passes.
        if along > _NORMAL_TOLERANCE**2 and against > _NORMAL_TOLERANCE**2:
            return k - a
        n_taken += 1 - taken[m]
        taken[m] = 1
    return n if n_taken == n else n - 1


@compiled
def align_sets(
    spots: Floats, normals: Floats, reach: Floats, a: int, b: int, n: int, tolerance: float, sense: int, strict: bool,
    rows: Floats, spare: Floats, work: Ints, starts: Ints, frame_a: Floats, frame_b: Floats, grid: Floats, turn: Floats,
) -> bool:  # fmt: skip
    """Finds the turn about the centroids that takes one set of welded vertices to another, in any order.

    Two vertices of ``a`` of the rarest looks are taken to every pair of ``b`` that looks the same, and each turn
    that follows is verified on all vertices. Parts of any symmetry are found, since any of their poses will do.

    Args:
        spots: ``(n_vertices, 3)`` and so on: what ``weld_range`` gives.
        normals: see ``spots``.
        reach: see ``spots``.
        a: where the one set starts.
        b: where the other one starts.
        n: how many each has, at least 1.
        tolerance: greatest distance of a vertex from its counterpart [m].
        sense: 1 for a rigid motion, -1 for one with a mirror.
        strict: whether the faces around a vertex must have the same area too, which the diagonal of a flat
            quadrangle can change; without it, symmetric parts take longer.
        rows: ``(m, 2)`` workspace, ``m`` at least ``n``.
        spare: ``(m, 2)`` workspace.
        work: ``(4, m)`` workspace.
        starts: ``(k,)`` workspace, at least ``count_cells(n) + 1`` long.
        frame_a: ``(3, 3)`` workspace.
        frame_b: ``(3, 3)`` workspace.
        grid: ``(3, 3)`` workspace.
        turn: ``(3, 3)`` output.

    Returns:
        Whether there is one.
    """
    likes_p, likes_q, members, taken = work[0], work[1], work[2], work[3]
    _classes(reach, a, n, tolerance, strict, rows, spare, taken)
    first, second = _pick_pair(spots, reach, a, n, taken)
    _sort_cells(spots, b, n, grid, starts, members, taken)
    p, q = a + first, a + second
    x, y, z = spots[p, 0], spots[p, 1], spots[p, 2]
    u, v, w = spots[q, 0], spots[q, 1], spots[q, 2]
    _frame(x, y, z, u, v, w, frame_a)
    apart = sqrt((x - u) * (x - u) + (y - v) * (y - v) + (z - w) * (z - w))
    n_p = _alike(reach, p, b, n, tolerance, strict, likes_p)
    n_q = _alike(reach, q, b, n, tolerance, strict, likes_q)
    checks = 0
    for at_p in range(n_p):
        i = b + likes_p[at_p]
        x, y, z = spots[i, 0], spots[i, 1], spots[i, 2]
        for at_q in range(n_q):
            checks += 1
            if checks > _MAX_CHECKS + 2000 * n:
                return False
            j = b + likes_q[at_q]
            u, v, w = spots[j, 0], spots[j, 1], spots[j, 2]
            d = sqrt((x - u) * (x - u) + (y - v) * (y - v) + (z - w) * (z - w))
            if abs(d - apart) > 2.0 * tolerance:
                continue
            _frame(x, y, z, u, v, w, frame_b)
            _turn_between(frame_a, frame_b, sense, turn)
            n_fitting = _n_fitting(turn, spots, normals, a, b, n, tolerance, grid, starts, members, taken)
            if n_fitting == n:
                return True
            checks += n_fitting + 1
    return False


@compiled
def _alike(reach: Floats, look: int, b: int, n: int, tolerance: float, strict: bool, found: Ints) -> int:
    """Lists the vertices from ``b`` on that look like a given one; returns how many there are."""
    far, area = reach[look, 0], reach[look, 1]
    m = 0
    for k in range(n):
        if abs(reach[b + k, 0] - far) > tolerance:
            continue
        if strict and abs(reach[b + k, 1] - area) > _area_tolerance(area, tolerance):
            continue
        found[m] = k
        m += 1
    return m


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
    work = np.empty((2, n), np.int64)
    return bool(
        _fits_in_place(
            np.concatenate([spots_a, spots_b]),
            np.concatenate([normals_a, normals_b]),
            n,
            tolerance,
            np.empty((3, 3)),
            np.empty(64**3 + 1, np.int64),
            work[0],
            work[1],
            np.eye(3),
        )
    )


@compiled
def _fits_in_place(
    spots: Floats, normals: Floats, n: int, tolerance: float,
    grid: Floats, starts: Ints, members: Ints, work: Ints, turn: Floats,
) -> bool:  # fmt: skip
    _sort_cells(spots, n, n, grid, starts, members, work)
    return bool(_n_fitting(turn, spots, normals, ZERO, n, n, tolerance, grid, starts, members, work) == n)
