"""Two box trees walked together: the kernels behind exact contacts.

A pair of meshes is walked from the two roots, nearer children first, with the least distance found so far as the
limit. Coordinates of triangles are taken relative to the centre of the first mesh, so that they keep their digits
wherever the scene lies.

Boxes of long diagonal slivers are nearly empty, and trees of them let everything through. So a leaf that is much
wider than the node it meets is taken apart: each of its triangles walks the other tree on its own, by a separating-axis
test of triangle against box (Akenine-Moeller 2001, with the limit as margin).
"""

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
    node_girth,
    node_middle2,
    relate,
    rows_gap2,
    turn_side,
)
from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF
from cadgraph.geometry.kernels.triangle import ROW, distance2, lay_normal
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["DEPTH", "closest"]

_OVERSIZED = 8.0  # a leaf this much wider than the node it meets is long is taken apart

_COARSE = 0.8
# So is any leaf this wide compared to the length of its whole tree, if the tree has at least _COARSE_LEAVES of them:
# the faces are then slivers at a slant that no box tells apart.

_COARSE_LEAVES = 12

_TIE = 1e-10
# Once a pair of points is found, others must be closer by this [m] to be of interest: faces that run parallel would
# otherwise be searched for the last bit.

DEPTH = 160  # of the stacks: two trees of at most 2**40 leaves, one waiting node a level


@compiled
def _apart(p: Floats, n_p: int, q: Floats, n_q: int, best: float) -> bool:
    """Whether the normal of the first triangle of ``p`` shows two leaves to be ``best`` (squared) or more apart."""
    n2 = lay_normal(p, 0)
    x, y, z = p[0, 9], p[0, 10], p[0, 11]
    p_low = q_low = np.inf
    p_high = q_high = -np.inf
    for i in range(n_p):
        for k in range(0, 9, 3):
            at = x * p[i, k] + y * p[i, k + 1] + z * p[i, k + 2]
            p_low, p_high = min(p_low, at), max(p_high, at)
    for i in range(n_q):
        for k in range(0, 9, 3):
            at = x * q[i, k] + y * q[i, k + 1] + z * q[i, k + 2]
            q_low, q_high = min(q_low, at), max(q_high, at)
    gap = max(q_low - p_high, p_low - q_high)
    return gap > 0.0 and gap * gap >= best * n2 and n2 > 0.0


@compiled
def _keep(d2: float, stop: float, found: Floats, spare: Floats) -> float:
    """Notes a closer pair of points; returns the bound for the next, or 0 where this one is close enough."""
    for k in range(6):
        found[k] = spare[k]
    found[6] = d2
    if d2 <= stop:
        return 0.0
    size = np.sqrt(d2)
    for k in range(3):
        found[7 + k] = (spare[3 + k] - spare[k]) / size
    less = size - _TIE
    return less * less if less > 0.0 else 0.0


@compiled
def _behind(p: Floats, n_p: int, q: Floats, n_q: int, bound: float, found: Floats) -> bool:
    """Whether two leaves lie ``bound`` (squared) or more apart along the line of the closest points so far.

    Parts that bulge towards each other are told apart by this at once. Leaves the furthest point of each row of ``p``,
    and the nearest of each row of ``q``, along that line in the free column.
    """
    x, y, z = found[7], found[8], found[9]
    high, low = -np.inf, np.inf
    for i in range(n_p):
        a = x * p[i, 0] + y * p[i, 1] + z * p[i, 2]
        b = x * p[i, 3] + y * p[i, 4] + z * p[i, 5]
        c = x * p[i, 6] + y * p[i, 7] + z * p[i, 8]
        p[i, 19] = max(a, b, c)
        high = max(high, p[i, 19])
    for i in range(n_q):
        a = x * q[i, 0] + y * q[i, 1] + z * q[i, 2]
        b = x * q[i, 3] + y * q[i, 4] + z * q[i, 5]
        c = x * q[i, 6] + y * q[i, 7] + z * q[i, 8]
        q[i, 19] = min(a, b, c)
        low = min(low, q[i, 19])
    return low > high and (low - high) * (low - high) >= bound


@compiled
def _lay_line(found: Floats, a: Floats, b: Floats, line: Floats) -> None:
    """Writes the direction of the closest points so far in the box axes of both meshes, and its absolute values."""
    for k in range(3):
        line[0, k] = a[5 + k, 0] * found[7] + a[5 + k, 1] * found[8] + a[5 + k, 2] * found[9]
        line[1, k] = b[5 + k, 0] * found[7] + b[5 + k, 1] * found[8] + b[5 + k, 2] * found[9]
        line[2, k], line[3, k] = abs(line[0, k]), abs(line[1, k])


@compiled
def _node_behind(nodes: Nodes, a: int, b: int, frame: Floats, line: Floats, bound: float) -> bool:
    """Whether two nodes lie ``bound`` (squared) or more apart along the line of the closest points so far."""
    gap = 0.0
    for k in range(3):
        gap += line[0, k] * (frame[6, k] - nodes[a, k]) - line[2, k] * nodes[a, 3 + k]
        gap += line[1, k] * nodes[b, k] - line[3, k] * nodes[b, 3 + k]
    return gap > 0.0 and gap * gap >= bound


@compiled
def _leaves(p: Floats, n_p: int, q: Floats, n_q: int, bound: float, stop: float, found: Floats, spare: Floats) -> float:
    """Looks for triangles of two leaves below a squared distance; returns the new bound."""
    known = found[6] < np.inf
    if known and _behind(p, n_p, q, n_q, bound, found):
        return bound
    if _apart(p, n_p, q, n_q, bound) or _apart(q, n_q, p, n_p, bound):
        return bound
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for j in range(n_q):
        x0, y0, z0 = min(x0, q[j, 13]), min(y0, q[j, 14]), min(z0, q[j, 15])
        x1, y1, z1 = max(x1, q[j, 16]), max(y1, q[j, 17]), max(z1, q[j, 18])
    for i in range(n_p):
        x, y, z = (
            max(p[i, 13] - x1, x0 - p[i, 16]),
            max(p[i, 14] - y1, y0 - p[i, 17]),
            max(p[i, 15] - z1, z0 - p[i, 18]),
        )
        x, y, z = max(x, 0.0), max(y, 0.0), max(z, 0.0)
        if x * x + y * y + z * z >= bound:
            continue
        for j in range(n_q):
            if rows_gap2(p, i, q, j) >= bound:
                continue
            if known:
                gap = q[j, 19] - p[i, 19]
                if gap > 0.0 and gap * gap >= bound:
                    continue
            d2 = distance2(p, i, q, j, bound, spare)
            if d2 < bound:
                bound = _keep(d2, stop, found, spare)
                if bound <= 0.0:
                    return bound
    return bound


@compiled
def _lay_axes(p: Floats, i: int, side: Floats, whole: Ints, all_axes: Floats) -> None:
    """For a triangle in the box axes of a mesh: the axes that can separate it from a box, with its extent on each.

    Args:
        p: rows.
        i: row.
        side: the mesh.
        whole: the mesh.
        all_axes: ``(n, 11, 6)`` takes in its row ``i`` direction (3), least and greatest position (2) and length (1)
            of the normal and of the nine products of a side and a box axis; the last row is the triangle's own box.
    """
    axes = all_axes[i]
    ax, ay, az = _turned(p, i, 0, side, whole)
    bx, by, bz = _turned(p, i, 3, side, whole)
    cx, cy, cz = _turned(p, i, 6, side, whole)
    lay_normal(p, i)
    x, y, z = p[i, 9], p[i, 10], p[i, 11]
    for k in range(3):
        axes[0, k] = side[5 + k, 0] * x + side[5 + k, 1] * y + side[5 + k, 2] * z
    n = 1
    for edge in range(3):
        if edge == 0:
            x, y, z = bx - ax, by - ay, bz - az
        elif edge == 1:
            x, y, z = cx - bx, cy - by, cz - bz
        else:
            x, y, z = ax - cx, ay - cy, az - cz
        axes[n, 0], axes[n, 1], axes[n, 2] = 0.0, z, -y
        axes[n + 1, 0], axes[n + 1, 1], axes[n + 1, 2] = -z, 0.0, x
        axes[n + 2, 0], axes[n + 2, 1], axes[n + 2, 2] = y, -x, 0.0
        n += 3
    for n in range(10):
        x, y, z = axes[n, 0], axes[n, 1], axes[n, 2]
        a = x * ax + y * ay + z * az
        b = x * bx + y * by + z * bz
        c = x * cx + y * cy + z * cz
        axes[n, 3], axes[n, 4] = min(a, b, c), max(a, b, c)
        axes[n, 5] = np.sqrt(x * x + y * y + z * z)
    axes[10, 0], axes[10, 1], axes[10, 2] = min(ax, bx, cx), min(ay, by, cy), min(az, bz, cz)
    axes[10, 3], axes[10, 4], axes[10, 5] = max(ax, bx, cx), max(ay, by, cy), max(az, bz, cz)


@compiled
def _turned(p: Floats, i: int, corner: int, side: Floats, whole: Ints) -> tuple[float, float, float]:
    """A corner of a row in the box axes of a mesh."""
    x, y, z = p[i, corner] - side[4, 0], p[i, corner + 1] - side[4, 1], p[i, corner + 2] - side[4, 2]
    if whole[UPRIGHT]:
        return x, y, z
    return (
        side[5, 0] * x + side[5, 1] * y + side[5, 2] * z,
        side[6, 0] * x + side[6, 1] * y + side[6, 2] * z,
        side[7, 0] * x + side[7, 1] * y + side[7, 2] * z,
    )


@compiled
def _separated(axes: Floats, nodes: Nodes, node: int, limit: float) -> bool:
    """Whether an axis shows that a triangle is further than ``limit`` from a box."""
    cx, cy, cz = np.float64(nodes[node, 0]), np.float64(nodes[node, 1]), np.float64(nodes[node, 2])
    hx, hy, hz = np.float64(nodes[node, 3]), np.float64(nodes[node, 4]), np.float64(nodes[node, 5])
    x = max(axes[10, 0] - cx - hx, cx - hx - axes[10, 3], 0.0)
    y = max(axes[10, 1] - cy - hy, cy - hy - axes[10, 4], 0.0)
    z = max(axes[10, 2] - cz - hz, cz - hz - axes[10, 5], 0.0)
    if x * x + y * y + z * z > limit * limit:
        return True
    for n in range(10):
        x, y, z = axes[n, 0], axes[n, 1], axes[n, 2]
        at = x * cx + y * cy + z * cz
        reach = abs(x) * hx + abs(y) * hy + abs(z) * hz + limit * axes[n, 5]
        # rounding of the projections, far above what it can be
        reach += 1e-12 * (abs(at) + abs(axes[n, 3]) + abs(axes[n, 4]))
        if axes[n, 3] - at > reach or at - axes[n, 4] > reach:
            return True
    return False


@compiled
def _in_reach(p: Floats, n_p: int, nodes: Nodes, node: int, frame: Floats, bound: float) -> bool:
    """Whether the box of any triangle comes within a squared distance of an upright node of the other mesh."""
    cx, cy, cz = frame[6, 0] + nodes[node, 0], frame[6, 1] + nodes[node, 1], frame[6, 2] + nodes[node, 2]
    hx, hy, hz = np.float64(nodes[node, 3]), np.float64(nodes[node, 4]), np.float64(nodes[node, 5])
    for i in range(n_p):
        x = max(p[i, 13] - cx - hx, cx - hx - p[i, 16], 0.0)
        y = max(p[i, 14] - cy - hy, cy - hy - p[i, 17], 0.0)
        z = max(p[i, 15] - cz - hz, cz - hz - p[i, 18], 0.0)
        if x * x + y * y + z * z < bound:
            return True
    return False


@compiled
def _descend(
    nodes: Nodes,
    vertices: Floats,
    faces: Faces,
    side: Floats,
    whole: Ints,
    root: int,
    p: Floats,
    i: int,
    swapped: bool,
    bound: float,
    stop: float,
    found: Floats,
    spare: Floats,
    all_axes: Floats,
    rows: Floats,
    stack: Ints,
) -> float:
    """Looks for a triangle of a subtree below a squared distance from one triangle; returns the new bound.

    Where ``swapped``, the tree is that of the first mesh.
    """
    axes = all_axes[i]
    limit = np.sqrt(bound)
    stack[0] = root
    top = 1
    while top > 0:
        top -= 1
        node = stack[top]
        if _separated(axes, nodes, whole[NODE] + node, limit):
            continue
        if node < whole[LEAVES] - 1:
            stack[top], stack[top + 1] = 2 * node + 2, 2 * node + 1
            top += 2
            continue
        count = load_leaf(vertices, faces, side, whole, node, rows)
        for j in range(count):
            if rows_gap2(p, i, rows, j) >= bound:
                continue
            d2 = distance2(rows, j, p, i, bound, spare) if swapped else distance2(p, i, rows, j, bound, spare)
            if d2 < bound:
                bound = _keep(d2, stop, found, spare)
                if bound <= 0.0:
                    return bound
                limit = np.sqrt(bound)
    return bound


@compiled
def _walk(
    nodes: Nodes,
    vertices: Floats,
    faces: Faces,
    side_a: Floats,
    whole_a: Ints,
    side_b: Floats,
    whole_b: Ints,
    bound: float,
    stop: float,
    found: Floats,
    spare: Floats,
    frame: Floats,
    axes_p: Floats,
    axes_q: Floats,
    p: Floats,
    q: Floats,
    single: Floats,
    stack: Ints,
    own: Ints,
    bounds: Floats,
    line: Floats,
) -> float:
    """Looks for the closest points of two meshes below a squared distance; returns the last bound."""
    nodes, vertices, faces = borrow(nodes), borrow(vertices), borrow(faces)
    side_a, whole_a, side_b, whole_b = borrow(side_a), borrow(whole_a), borrow(side_b), borrow(whole_b)
    found, spare, frame, axes_p = borrow(found), borrow(spare), borrow(frame), borrow(axes_p)
    axes_q = borrow(axes_q)
    p, q, single = borrow(p), borrow(q), borrow(single)
    stack, own, bounds = borrow(stack), borrow(own), borrow(bounds)
    line = borrow(line)
    base_a, base_b, leaves_a, leaves_b = whole_a[NODE], whole_b[NODE], whole_a[LEAVES], whole_b[LEAVES]
    upright = whole_a[UPRIGHT] != 0 and whole_b[UPRIGHT] != 0
    relate(side_a, side_b, frame)
    coarse_a = _COARSE * node_extent(nodes, base_a) if leaves_a >= _COARSE_LEAVES else np.inf
    coarse_b = _COARSE * node_extent(nodes, base_b) if leaves_b >= _COARSE_LEAVES else np.inf
    loaded_a = loaded_b = laid_a = laid_b = -1
    laid = np.inf
    count_a = count_b = 0
    stack[0], stack[1], bounds[0] = 0, 0, node_gap2(nodes, base_a, base_b, frame, upright)
    top = 1
    while top > 0:
        top -= 1
        if bounds[top] >= bound:
            continue
        at_a, at_b = stack[2 * top], stack[2 * top + 1]
        if found[6] < np.inf:
            if found[6] != laid:
                laid = found[6]
                _lay_line(found, side_a, side_b, line)
            if _node_behind(nodes, base_a + at_a, base_b + at_b, frame, line, bound):
                continue
        leaf_a, leaf_b = at_a >= leaves_a - 1, at_b >= leaves_b - 1
        size_a, size_b = node_extent(nodes, base_a + at_a), node_extent(nodes, base_b + at_b)
        split_a = leaf_a and node_girth(nodes, base_a + at_a) > min(_OVERSIZED * size_b, coarse_a)
        girth_b = node_girth(nodes, base_b + at_b)
        split_b = leaf_b and not split_a and girth_b > min(_OVERSIZED * size_a, coarse_b)
        if leaf_a and (leaf_b or split_a) and loaded_a != at_a:
            count_a = load_leaf(vertices, faces, side_a, whole_a, at_a, p)
            loaded_a = at_a
        if upright and leaf_a and leaf_b and not _in_reach(p, count_a, nodes, base_b + at_b, frame, bound):
            continue
        if leaf_b and (leaf_a or split_b) and loaded_b != at_b:
            count_b = load_leaf(vertices, faces, side_b, whole_b, at_b, q)
            loaded_b = at_b
        if split_a:
            for i in range(count_a):
                if laid_a != at_a:
                    _lay_axes(p, i, side_b, whole_b, axes_p)
                bound = _descend(
                    nodes, vertices, faces, side_b, whole_b, at_b,
                    p, i, split_b, bound, stop, found, spare, axes_p, single, own,
                )  # fmt: skip
                if bound <= 0.0:
                    return bound
            laid_a = at_a
        elif split_b:
            for i in range(count_b):
                if laid_b != at_b:
                    _lay_axes(q, i, side_a, whole_a, axes_q)
                bound = _descend(
                    nodes, vertices, faces, side_a, whole_a, at_a,
                    q, i, split_b, bound, stop, found, spare, axes_q, single, own,
                )  # fmt: skip
                if bound <= 0.0:
                    return bound
            laid_b = at_b
        elif leaf_a and leaf_b:
            bound = _leaves(p, count_a, q, count_b, bound, stop, found, spare)
            if bound <= 0.0:
                return bound
        else:
            if leaf_b or (not leaf_a and size_a >= size_b):
                a0, a1, b0, b1 = 2 * at_a + 1, 2 * at_a + 2, at_b, at_b
            else:
                a0, a1, b0, b1 = at_a, at_a, 2 * at_b + 1, 2 * at_b + 2
            gap0 = node_gap2(nodes, base_a + a0, base_b + b0, frame, upright)
            gap1 = node_gap2(nodes, base_a + a1, base_b + b1, frame, upright)
            nearer = gap1 < gap0
            if gap1 == gap0:
                # both overlap: where the middles are closer, surfaces are found to meet sooner
                middle0 = node_middle2(nodes, base_a + a0, base_b + b0, frame, upright)
                nearer = node_middle2(nodes, base_a + a1, base_b + b1, frame, upright) < middle0
            if nearer:
                a0, a1, b0, b1, gap0, gap1 = a1, a0, b1, b0, gap1, gap0
            if gap1 < bound:
                stack[2 * top], stack[2 * top + 1], bounds[top] = a1, b1, gap1
                top += 1
            if gap0 < bound:
                stack[2 * top], stack[2 * top + 1], bounds[top] = a0, b0, gap0
                top += 1
    return bound


@compiled
def closest(
    meshes: Placed, pairs: Ints, first: int, last: int, limit: float, stop: float
) -> tuple[Ints, Floats, Floats]:
    """The closest points of pairs of meshes.

    Args:
        meshes: all meshes.
        pairs: ``(n, 2)``.
        first: row of ``pairs`` to begin with.
        last: row to end before.
        limit: greatest distance [m].
        stop: a distance at which a pair needs no closer look [m].

    Returns:
        For each pair within the limit its row, distance [m] and closest points ``(2, 3)`` [m].
    """
    n = last - first
    row, distance, points = np.empty(n, np.int64), np.empty(n), np.empty((n, 2, 3))
    found, spare, frame, axes, origin = (
        np.empty(10),
        np.empty(6),
        np.empty((7, 3)),
        np.empty((2, LEAF, 11, 6)),
        np.empty(3),
    )
    line, turn = np.empty((4, 3)), np.zeros((3, 3))
    p, q, single = np.empty((LEAF, ROW)), np.empty((LEAF, ROW)), np.empty((LEAF, ROW))
    stack, own, bounds = np.empty(2 * DEPTH, np.int64), np.empty(DEPTH, np.int64), np.empty(DEPTH)
    side_a, side_b, whole_a, whole_b = (
        np.zeros(SIDE),
        np.zeros(SIDE),
        np.empty(WHOLE, np.int64),
        np.empty(WHOLE, np.int64),
    )
    nodes, vertices, faces = meshes.nodes, meshes.vertices, meshes.faces
    # the walk looks for less than this, and the limit itself counts
    limit2 = limit * limit * (1.0 + 1e-15) + 1e-300
    n_found = 0
    for i in range(first, last):
        a, b = pairs[i, 0], pairs[i, 1]
        for k in range(3):
            origin[k] = meshes.centers[a, k]
        lay_side(meshes, a, origin, side_a, whole_a)
        lay_side(meshes, b, origin, side_b, whole_b)
        if whole_a[COUNT] == 0 or whole_b[COUNT] == 0:
            continue
        # where boxes stand askew, work in their axes: long thin triangles then have slim boxes as well
        askew = not (whole_a[UPRIGHT] and whole_b[UPRIGHT])
        if askew:
            own_axes = meshes.axes[a] if not whole_a[UPRIGHT] else meshes.axes[b]
            for k in range(3):
                for m in range(3):
                    turn[k, m] = own_axes[k, m]
            turn_side(side_a, whole_a, turn, frame)
            turn_side(side_b, whole_b, turn, frame)
        found[6] = np.inf
        _walk(
            nodes, vertices, faces, side_a, whole_a, side_b, whole_b, limit2, stop * stop,
            found, spare, frame, axes[0], axes[1], p, q, single, stack, own, bounds, line,
        )  # fmt: skip
        if found[6] < limit2:
            row[n_found] = i
            distance[n_found] = np.sqrt(found[6])
            for k in range(3):
                for m in range(0, 6, 3):
                    x, y, z = found[m], found[m + 1], found[m + 2]
                    at = turn[0, k] * x + turn[1, k] * y + turn[2, k] * z if askew else found[m + k]
                    points[n_found, m // 3, k] = at + origin[k]
            n_found += 1
    return row[:n_found].copy(), distance[:n_found].copy(), points[:n_found].copy()
