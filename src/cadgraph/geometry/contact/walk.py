"""Two box trees walked together: the kernels behind exact contacts.

A pair of meshes is walked from the two roots, nearer children first, with the least distance found so far as the
limit. Coordinates of triangles are taken relative to the centre of the first mesh, so that they keep their digits
wherever the scene lies.

Boxes of long diagonal slivers are nearly empty, and trees of them let everything through. So a leaf that is much
wider than the node it meets is taken apart: each of its triangles walks the other tree on its own, by a separating-axis
test of triangle against box (Akenine-Moeller 2001, with the limit as margin).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cadgraph.geometry.contact.leaf import compare_leaves, keep_closer
from cadgraph.geometry.contact.separation import is_separated, lay_axes
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
from cadgraph.geometry.kernels.parallel import ZERO, compiled
from cadgraph.geometry.kernels.tree import LEAF
from cadgraph.geometry.kernels.triangle import ROW, distance2
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["DEPTH", "closest"]

_OVERSIZED = 8.0  # a leaf this much wider than the node it meets is long is taken apart

# So is any leaf this wide compared to the length of its whole tree, if the tree has at least this many of them: the
# faces are then slivers at a slant that no box tells apart.
_COARSE, _COARSE_LEAVES = 0.8, 12

DEPTH = 160  # of the stacks: two trees of at most 2**40 leaves, one waiting node a level


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


class _Mesh(NamedTuple):
    """One of the two meshes of a walk, with the leaf of it that is loaded.

    Args:
        nodes: boxes of all trees.
        vertices: vertices of all trees [m].
        faces: triangles of all trees.
        side: ``SIDE`` the mesh, as ``lay_side`` writes it.
        whole: ``(WHOLE,)`` likewise.
        rows: ``(LEAF, ROW)`` triangles of the loaded leaf.
        held: ``(3,)`` the loaded leaf, its number of triangles, and the leaf that ``axes`` are of; -1 for none.
        axes: ``(LEAF, 11, 6)`` of each triangle of a leaf, as ``lay_axes`` writes them.
    """

    nodes: Nodes
    vertices: Floats
    faces: Faces
    side: Floats
    whole: Ints
    rows: Floats
    held: Ints
    axes: Floats


class _Search(NamedTuple):
    """What a walk writes to.

    Args:
        found: ``(10,)`` the closest points so far (6) [m], their squared distance, and the direction from the first to
            the second.
        spare: ``(6,)`` another pair of points [m].
        frame: ``(7, 3)`` pose of the second mesh's boxes in the axes of the first's.
        line: ``(4, 3)`` that direction in the box axes of both meshes.
        single: ``(LEAF, ROW)`` triangles of a leaf that one triangle meets.
        stack: ``(2 * DEPTH,)`` pairs of nodes that wait.
        bounds: ``(DEPTH,)`` lower bounds of their squared distances.
        own: ``(DEPTH,)`` nodes that wait for one triangle.
    """

    found: Floats
    spare: Floats
    frame: Floats
    line: Floats
    single: Floats
    stack: Ints
    bounds: Floats
    own: Ints


# What is done with a pair of nodes: one is opened, two leaves are compared, or an oversized leaf is taken apart.
_OPEN_FIRST, _OPEN_SECOND, _COMPARE, _FIRST_APART, _SECOND_APART = range(5)


@compiled
def _descend(
    tree: _Mesh, root: int, p: Floats, i: int, axes: Floats, swapped: bool, bound: float, stop: float, work: _Search
) -> float:
    """Looks for a triangle of a subtree below a squared distance from one triangle; returns the new bound.

    Where ``swapped``, the tree is that of the first mesh.
    """
    nodes, vertices, faces, side, whole = tree.nodes, tree.vertices, tree.faces, tree.side, tree.whole
    found, spare, rows, stack = work.found, work.spare, work.single, work.own
    limit = np.sqrt(bound)
    stack[0] = root
    top = 1
    while top > 0:
        top -= 1
        node = stack[top]
        if is_separated(axes, nodes, whole[NODE] + node, limit):
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
                bound = keep_closer(d2, stop, found, spare)
                if bound <= 0.0:
                    return bound
                limit = np.sqrt(bound)
    return bound


@compiled
def _take_apart(
    wide: _Mesh, at: int, tree: _Mesh, root: int, swapped: bool, bound: float, stop: float, work: _Search
) -> float:
    """Lets each triangle of the loaded leaf walk a subtree of the other mesh; returns the new bound."""
    laid = wide.held[2] == at
    for i in range(wide.held[1]):
        if not laid:
            lay_axes(wide.rows, i, tree.side, tree.whole, wide.axes)
        bound = _descend(tree, root, wide.rows, i, wide.axes[i], swapped, bound, stop, work)
        if bound <= 0.0:
            return bound
    wide.held[2] = at
    return bound


@compiled
def _hold(mesh: _Mesh, at: int) -> None:
    """Loads the triangles of a leaf, unless they are loaded."""
    if mesh.held[0] != at:
        mesh.held[1] = load_leaf(mesh.vertices, mesh.faces, mesh.side, mesh.whole, at, mesh.rows)
        mesh.held[0] = at


@compiled
def _coarse_girth(mesh: _Mesh) -> float:
    """How wide a leaf of a mesh has to be to be taken apart whatever it meets."""
    if mesh.whole[LEAVES] < _COARSE_LEAVES:
        return np.inf
    return _COARSE * node_extent(mesh.nodes, mesh.whole[NODE])


@compiled
def _next_step(nodes: Nodes, a: int, b: int, leaf_a: bool, leaf_b: bool, coarse_a: float, coarse_b: float) -> int:
    """What is done with two nodes; of two that can be opened the longer is."""
    if not leaf_a and not leaf_b:
        return _OPEN_FIRST if node_extent(nodes, a) >= node_extent(nodes, b) else _OPEN_SECOND
    if leaf_a and node_girth(nodes, a) > min(_OVERSIZED * node_extent(nodes, b), coarse_a):
        return _FIRST_APART
    if leaf_b and node_girth(nodes, b) > min(_OVERSIZED * node_extent(nodes, a), coarse_b):
        return _SECOND_APART
    if leaf_a and leaf_b:
        return _COMPARE
    return _OPEN_FIRST if leaf_b else _OPEN_SECOND


@compiled
def _open(
    nodes: Nodes,
    base_a: int,
    base_b: int,
    at_a: int,
    at_b: int,
    first: bool,
    upright: bool,
    bound: float,
    frame: Floats,
    stack: Ints,
    bounds: Floats,
    top: int,
) -> int:
    """Puts the two children of one node, each with the other node, on the stack, the nearer on top.

    Returns:
        How many pairs wait; none is put there whose boxes are too far apart.
    """
    if first:
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
    return top


@compiled
def _walk(a: _Mesh, b: _Mesh, bound: float, stop: float, work: _Search) -> float:
    """Looks for the closest points of two meshes below a squared distance; returns the last bound."""
    a = _Mesh(
        borrow(a.nodes), borrow(a.vertices), borrow(a.faces), borrow(a.side), borrow(a.whole),
        borrow(a.rows), borrow(a.held), borrow(a.axes),
    )  # fmt: skip
    b = _Mesh(
        borrow(b.nodes), borrow(b.vertices), borrow(b.faces), borrow(b.side), borrow(b.whole),
        borrow(b.rows), borrow(b.held), borrow(b.axes),
    )  # fmt: skip
    work = _Search(
        borrow(work.found), borrow(work.spare), borrow(work.frame), borrow(work.line), borrow(work.single),
        borrow(work.stack), borrow(work.bounds), borrow(work.own),
    )  # fmt: skip
    nodes, base_a, base_b = a.nodes, a.whole[NODE], b.whole[NODE]
    deep_a, deep_b = a.whole[LEAVES] - 1, b.whole[LEAVES] - 1
    found, spare, frame, line = work.found, work.spare, work.frame, work.line
    side_a, rows_a, held_a = a.side, a.rows, a.held
    side_b, rows_b, held_b = b.side, b.rows, b.held
    stack, bounds = work.stack, work.bounds
    upright = a.whole[UPRIGHT] != 0 and b.whole[UPRIGHT] != 0
    relate(side_a, side_b, frame)
    coarse_a, coarse_b = _coarse_girth(a), _coarse_girth(b)
    held_a[0] = held_a[2] = held_b[0] = held_b[2] = -1
    laid = np.inf
    stack[0], stack[1], bounds[0] = 0, 0, node_gap2(nodes, base_a, base_b, frame, upright)
    top = ZERO + 1
    while top > 0 and bound > 0.0:
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
        leaf_a, leaf_b = at_a >= deep_a, at_b >= deep_b
        step = _next_step(nodes, base_a + at_a, base_b + at_b, leaf_a, leaf_b, coarse_a, coarse_b)
        if step <= _OPEN_SECOND:
            first = step == _OPEN_FIRST
            top = _open(nodes, base_a, base_b, at_a, at_b, first, upright, bound, frame, stack, bounds, top)
            continue
        if leaf_a:
            _hold(a, at_a)
            if leaf_b and upright and not _in_reach(rows_a, held_a[1], nodes, base_b + at_b, frame, bound):
                continue
        if step == _FIRST_APART:
            bound = _take_apart(a, at_a, b, at_b, step == _SECOND_APART, bound, stop, work)
            continue
        _hold(b, at_b)
        if step == _SECOND_APART:
            bound = _take_apart(b, at_b, a, at_a, step == _SECOND_APART, bound, stop, work)
        else:
            bound = compare_leaves(rows_a, held_a[1], rows_b, held_b[1], bound, stop, found, spare)
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
    origin, turn = np.empty(3), np.zeros((3, 3))
    one, other = _new_mesh(meshes), _new_mesh(meshes)
    work = _Search(
        found=np.empty(10),
        spare=np.empty(6),
        frame=np.empty((7, 3)),
        line=np.empty((4, 3)),
        single=np.empty((LEAF, ROW)),
        stack=np.empty(2 * DEPTH, np.int64),
        bounds=np.empty(DEPTH),
        own=np.empty(DEPTH, np.int64),
    )
    # the walk looks for less than this, and the limit itself counts
    limit2 = limit * limit * (1.0 + 1e-15) + 1e-300
    n_found = 0
    for i in range(first, last):
        a, b = pairs[i, 0], pairs[i, 1]
        for k in range(3):
            origin[k] = meshes.centers[a, k]
        lay_side(meshes, a, origin, one.side, one.whole)
        lay_side(meshes, b, origin, other.side, other.whole)
        if one.whole[COUNT] == 0 or other.whole[COUNT] == 0:
            continue
        # where boxes stand askew, work in their axes: long thin triangles then have slim boxes as well
        askew = not (one.whole[UPRIGHT] and other.whole[UPRIGHT])
        if askew:
            own_axes = meshes.axes[a] if not one.whole[UPRIGHT] else meshes.axes[b]
            for k in range(3):
                for m in range(3):
                    turn[k, m] = own_axes[k, m]
            turn_side(one.side, one.whole, turn, work.frame)
            turn_side(other.side, other.whole, turn, work.frame)
        found = work.found
        found[6] = np.inf
        _walk(one, other, limit2, stop * stop, work)
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


@compiled
def _new_mesh(meshes: Placed) -> _Mesh:
    """Room for one mesh of a walk."""
    return _Mesh(
        meshes.nodes,
        meshes.vertices,
        meshes.faces,
        np.zeros(SIDE),
        np.empty(WHOLE, np.int64),
        np.empty((LEAF, ROW)),
        np.empty(3, np.int64),
        np.empty((LEAF, 11, 6)),
    )
