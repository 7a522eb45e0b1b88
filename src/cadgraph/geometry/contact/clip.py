"""Kernels of contact regions: the parts of near triangles that face each other."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.side import (
    COUNT,
    LEAVES,
    NODE,
    SIDE,
    UPRIGHT,
    WHOLE,
    Nodes,
    Placed,
    lay_side,
    load_leaf,
    node_extent,
    node_gap2,
    relate,
    rows_gap2,
)
from cadgraph.geometry.contact.walk import DEPTH
from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF
from cadgraph.geometry.kernels.triangle import ROW, lay_normal
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["ALIGNED", "FACING", "MOMENTS", "SIDES", "contact_measures"]

MOMENTS = 14
"""Columns of a measure: weight, its first (3) and second moments (6), normals (3), weight within the near gap."""

FACING, ALIGNED, SIDES = range(3)
"""Rows of measures: faces turned to each other, faces turned the same way, sides over faces."""


@compiled
def _clip(polygon: Floats, n: int, spare: Floats, x: float, y: float, z: float, offset: float) -> int:
    """Cuts a polygon to where ``(x, y, z) . p + offset >= 0``; returns its new number of corners.

    A corner is position (3) and gap (1).
    """
    kept = 0
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        a = x * polygon[i, 0] + y * polygon[i, 1] + z * polygon[i, 2] + offset
        b = x * polygon[j, 0] + y * polygon[j, 1] + z * polygon[j, 2] + offset
        if a >= 0.0:
            for k in range(4):
                spare[kept, k] = polygon[i, k]
            kept += 1
        if (a > 0.0 and b < 0.0) or (a < 0.0 and b > 0.0):
            share = a / (a - b)
            for k in range(4):
                spare[kept, k] = polygon[i, k] + share * (polygon[j, k] - polygon[i, k])
            kept += 1
    for i in range(kept):
        for k in range(4):
            polygon[i, k] = spare[i, k]
    return kept


@compiled
def _clip_gap(polygon: Floats, n: int, spare: Floats, sign: float, limit: float) -> int:
    """Cuts a polygon to where ``sign * gap <= limit``; returns its new number of corners."""
    kept = 0
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        a, b = limit - sign * polygon[i, 3], limit - sign * polygon[j, 3]
        if a >= 0.0:
            for k in range(4):
                spare[kept, k] = polygon[i, k]
            kept += 1
        if (a > 0.0 and b < 0.0) or (a < 0.0 and b > 0.0):
            share = a / (a - b)
            for k in range(4):
                spare[kept, k] = polygon[i, k] + share * (polygon[j, k] - polygon[i, k])
            kept += 1
    for i in range(kept):
        for k in range(4):
            polygon[i, k] = spare[i, k]
    return kept


@compiled
def _add(sums: Floats, kind: int, weight: float, x: float, y: float, z: float) -> None:
    """Adds a weighted point to the moments of a measure."""
    sums[kind, 0] += weight
    sums[kind, 1] += weight * x
    sums[kind, 2] += weight * y
    sums[kind, 3] += weight * z
    sums[kind, 4] += weight * x * x
    sums[kind, 5] += weight * x * y
    sums[kind, 6] += weight * x * z
    sums[kind, 7] += weight * y * y
    sums[kind, 8] += weight * y * z
    sums[kind, 9] += weight * z * z


@compiled
def _measure(
    polygon: Floats, n: int, share: float, nx: float, ny: float, nz: float, sums: Floats, kind: int, moments: bool
) -> float:
    """The area of a flat polygon times ``share``; adds its moments, halfway over the gap, if asked to."""
    total = 0.0
    for i in range(1, n - 1):
        ux, uy, uz = polygon[i, 0] - polygon[0, 0], polygon[i, 1] - polygon[0, 1], polygon[i, 2] - polygon[0, 2]
        vx, vy, vz = (
            polygon[i + 1, 0] - polygon[0, 0],
            polygon[i + 1, 1] - polygon[0, 1],
            polygon[i + 1, 2] - polygon[0, 2],
        )
        x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        weight = 0.5 * share * np.sqrt(x * x + y * y + z * z)
        total += weight
        if not moments:
            continue
        # a third of the area on the middle of each side: exact up to second moments
        for side in range(3):
            a = 0 if side == 0 else (i if side == 1 else i + 1)
            b = i if side == 0 else (i + 1 if side == 1 else 0)
            half = 0.25 * (polygon[a, 3] + polygon[b, 3])
            _add(
                sums,
                kind,
                weight / 3.0,
                0.5 * (polygon[a, 0] + polygon[b, 0]) + half * nx,
                0.5 * (polygon[a, 1] + polygon[b, 1]) + half * ny,
                0.5 * (polygon[a, 2] + polygon[b, 2]) + half * nz,
            )
    return total


@compiled
def _faces(
    p: Floats, i: int, q: Floats, j: int, sign: float, reach: float, near: float, sums: Floats,
    polygon: Floats, spare: Floats,
) -> None:  # fmt: skip
    """Adds what row ``j`` covers of row ``i``, as seen along the normal of row ``i``.

    ``sign`` is 1 where row ``i`` belongs to the first mesh, -1 where to the second.
    """
    p2, q2 = lay_normal(p, i), lay_normal(q, j)
    if p2 <= 0.0 or q2 <= 0.0:
        return
    size = np.sqrt(p2)
    nx, ny, nz = p[i, 9] / size, p[i, 10] / size, p[i, 11] / size
    cosine = (nx * q[j, 9] + ny * q[j, 10] + nz * q[j, 11]) / np.sqrt(q2)
    if abs(cosine) < 1e-6:
        return
    middle = 0.0
    for corner in range(3):
        x, y, z = q[j, 3 * corner], q[j, 3 * corner + 1], q[j, 3 * corner + 2]
        gap = nx * (x - p[i, 0]) + ny * (y - p[i, 1]) + nz * (z - p[i, 2])
        polygon[corner, 0], polygon[corner, 1], polygon[corner, 2] = x - gap * nx, y - gap * ny, z - gap * nz
        polygon[corner, 3] = gap
        middle += gap
    n = _clip_gap(polygon, 3, spare, 1.0, reach)
    n = _clip_gap(polygon, n, spare, -1.0, reach)
    for side in range(3):
        if n < 3:
            return
        a, b = 3 * side, 3 * ((side + 1) % 3)
        ex, ey, ez = p[i, b] - p[i, a], p[i, b + 1] - p[i, a + 1], p[i, b + 2] - p[i, a + 2]
        x, y, z = ny * ez - nz * ey, nz * ex - nx * ez, nx * ey - ny * ex
        n = _clip(polygon, n, spare, x, y, z, -(x * p[i, a] + y * p[i, a + 1] + z * p[i, a + 2]))
    if n < 3:
        return
    kind = FACING if cosine < 0.0 else ALIGNED
    # tilted faces count by what they show of themselves
    weight = _measure(polygon, n, abs(cosine), nx, ny, nz, sums, kind, True)
    if kind == ALIGNED and middle < 0.0:
        sign = -sign
    sums[kind, 10] += sign * weight * nx
    sums[kind, 11] += sign * weight * ny
    sums[kind, 12] += sign * weight * nz
    n = _clip_gap(polygon, n, spare, 1.0, near)
    n = _clip_gap(polygon, n, spare, -1.0, near)
    sums[kind, 13] += _measure(polygon, n, abs(cosine), nx, ny, nz, sums, kind, False)


@compiled
def _sides(p: Floats, i: int, q: Floats, j: int, sign: float, reach: float, sums: Floats) -> None:
    """Adds the parts of the sides of row ``j`` that lie over row ``i`` within reach."""
    p2 = lay_normal(p, i)
    if p2 <= 0.0:
        return
    size = np.sqrt(p2)
    nx, ny, nz = p[i, 9] / size, p[i, 10] / size, p[i, 11] / size
    for k in range(3):
        a, b = 3 * k, 3 * ((k + 1) % 3)
        sx, sy, sz = q[j, a], q[j, a + 1], q[j, a + 2]
        dx, dy, dz = q[j, b] - sx, q[j, b + 1] - sy, q[j, b + 2] - sz
        low, high = 0.0, 1.0
        height = nx * (sx - p[i, 0]) + ny * (sy - p[i, 1]) + nz * (sz - p[i, 2])
        rise = nx * dx + ny * dy + nz * dz
        for plane in range(5):
            if plane < 3:
                c, d = 3 * plane, 3 * ((plane + 1) % 3)
                ex, ey, ez = p[i, d] - p[i, c], p[i, d + 1] - p[i, c + 1], p[i, d + 2] - p[i, c + 2]
                x, y, z = ny * ez - nz * ey, nz * ex - nx * ez, nx * ey - ny * ex
                start = x * (sx - p[i, c]) + y * (sy - p[i, c + 1]) + z * (sz - p[i, c + 2])
                slope = x * dx + y * dy + z * dz
            elif plane == 3:
                start, slope = reach + height, rise
            else:
                start, slope = reach - height, -rise
            if slope > 0.0:
                low = max(low, -start / slope)
            elif slope < 0.0:
                high = min(high, -start / slope)
            elif start < 0.0:
                high = -1.0
        if high <= low:
            continue
        length = (high - low) * np.sqrt(dx * dx + dy * dy + dz * dz)
        # both ends and four times the middle: exact up to second moments
        for step in range(3):
            at = low + 0.5 * step * (high - low)
            weight = length * (4.0 if step == 1 else 1.0) / 6.0
            _add(sums, SIDES, weight, sx + at * dx, sy + at * dy, sz + at * dz)
        over = sign if height + 0.5 * (low + high) * rise >= 0.0 else -sign
        sums[SIDES, 10] += over * length * nx
        sums[SIDES, 11] += over * length * ny
        sums[SIDES, 12] += over * length * nz
        sums[SIDES, 13] += length


@compiled
def _region(
    nodes: Nodes, vertices: Floats, faces: Faces, side_a: Floats, whole_a: Ints, side_b: Floats, whole_b: Ints,
    reach: float, near: float, sums: Floats, frame: Floats, p: Floats, q: Floats, polygon: Floats, spare: Floats,
    stack: Ints,
) -> None:  # fmt: skip
    """Adds all measures of two meshes."""
    nodes, vertices, faces, sums, frame = borrow(nodes), borrow(vertices), borrow(faces), borrow(sums), borrow(frame)
    side_a, whole_a, side_b, whole_b = borrow(side_a), borrow(whole_a), borrow(side_b), borrow(whole_b)
    p, q, polygon, spare, stack = borrow(p), borrow(q), borrow(polygon), borrow(spare), borrow(stack)
    base_a, base_b, leaves_a, leaves_b = whole_a[NODE], whole_b[NODE], whole_a[LEAVES], whole_b[LEAVES]
    upright = whole_a[UPRIGHT] != 0 and whole_b[UPRIGHT] != 0
    relate(side_a, side_b, frame)
    reach2 = reach * reach
    loaded_a, count_a = -1, 0
    stack[0], stack[1] = 0, 0
    top = 1
    while top > 0:
        top -= 1
        at_a, at_b = stack[2 * top], stack[2 * top + 1]
        if node_gap2(nodes, base_a + at_a, base_b + at_b, frame, upright) > reach2:
            continue
        leaf_a, leaf_b = at_a >= leaves_a - 1, at_b >= leaves_b - 1
        if leaf_a and leaf_b:
            if loaded_a != at_a:
                count_a = load_leaf(vertices, faces, side_a, whole_a, at_a, p)
                loaded_a = at_a
            count_b = load_leaf(vertices, faces, side_b, whole_b, at_b, q)
            for i in range(count_a):
                for j in range(count_b):
                    if rows_gap2(p, i, q, j) <= reach2:
                        _faces(p, i, q, j, 1.0, reach, near, sums, polygon, spare)
                        _faces(q, j, p, i, -1.0, reach, near, sums, polygon, spare)
                        _sides(p, i, q, j, 1.0, reach, sums)
                        _sides(q, j, p, i, -1.0, reach, sums)
        elif leaf_b or (not leaf_a and node_extent(nodes, base_a + at_a) >= node_extent(nodes, base_b + at_b)):
            stack[2 * top], stack[2 * top + 1] = 2 * at_a + 2, at_b
            stack[2 * top + 2], stack[2 * top + 3] = 2 * at_a + 1, at_b
            top += 2
        else:
            stack[2 * top], stack[2 * top + 1] = at_a, 2 * at_b + 2
            stack[2 * top + 2], stack[2 * top + 3] = at_a, 2 * at_b + 1
            top += 2


@compiled
def contact_measures(
    meshes: Placed, pairs: Ints, distance: Floats, points: Floats, first: int, last: int, reach: float, slack: float
) -> Floats:
    """The measures of contacts.

    Args:
        meshes: all meshes.
        pairs: ``(n, 2)``.
        distance: ``(n,)`` [m].
        points: ``(n, 2, 3)`` closest points [m].
        first: row to begin with.
        last: row to end before.
        reach: greatest gap that belongs to the region [m].
        slack: least range of gaps over which the region is measured [m].

    Returns:
        ``(last - first, 3, MOMENTS)``, positions relative to the first closest point. The near gap is that of the
        closest points and a quarter of what is left up to ``reach``.
    """
    found = np.zeros((last - first, 3, MOMENTS))
    frame, polygon, spare, origin = np.empty((7, 3)), np.empty((12, 4)), np.empty((12, 4)), np.empty(3)
    p, q, stack = np.empty((LEAF, ROW)), np.empty((LEAF, ROW)), np.empty(4 * DEPTH, np.int64)
    side_a, side_b, whole_a, whole_b = (
        np.zeros(SIDE),
        np.zeros(SIDE),
        np.empty(WHOLE, np.int64),
        np.empty(WHOLE, np.int64),
    )
    nodes, vertices, faces = meshes.nodes, meshes.vertices, meshes.faces
    for i in range(first, last):
        for k in range(3):
            origin[k] = points[i, 0, k]
        lay_side(meshes, pairs[i, 0], origin, side_a, whole_a)
        lay_side(meshes, pairs[i, 1], origin, side_b, whole_b)
        if whole_a[COUNT] == 0 or whole_b[COUNT] == 0:
            continue
        span = max(reach - distance[i], slack)
        _region(
            nodes, vertices, faces, side_a, whole_a, side_b, whole_b, distance[i] + span, distance[i] + 0.25 * span,
            found[i - first], frame, p, q, polygon, spare, stack,
        )  # fmt: skip
    return found
