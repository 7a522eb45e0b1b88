"""Fewer triangles for what is far away: edges are collapsed where that moves the surface least.

Garland and Heckbert, *Surface Simplification Using Quadric Error Metrics* (1997), with every vertex kept where it was
or taken out, so that nothing new has to be stored. A closed surface stays closed, a pipe a pipe: what would change how
the faces hang together is never collapsed (the link condition, Dey et al. 1999).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.geometry.kernels.parallel import ZERO, compiled
from cadgraph.model.scene import Faces, Floats

__all__ = ["simplify"]

_BORDER = 10.0  # how much more an open border counts than the surface: it is what makes a hole
_TURN = 0.25  # cosine of the greatest angle that a face may turn by in one collapse
_BUCKETS = 2048
_BUCKET_BITS = 20  # of a 32-bit float that don't count in the order of collapses
_PASSES = 60


def simplify(vertices: Floats, faces: Faces, most: int, error: float, free: float = 0.0) -> Faces:
    """Takes vertices out of a surface until it has few enough triangles.

    Args:
        vertices: ``(n, 3)`` distinct positions [m].
        faces: ``(m, 3)`` int32 triangles of three different vertices each.
        most: how many triangles are wanted; fewer are left where ``free`` allows it.
        error: how far the surface may be moved, as a mean over what is round a vertex [m]; more triangles are left
            where that would not do.
        free: how far it may be moved although there are few enough already [m].

    Returns:
        ``(k, 3)`` int32 triangles of the same vertices, in the order of the faces that they come from.
    """
    work = np.array(faces, np.int32)
    count = _simplify(np.ascontiguousarray(vertices, np.float64), work, most, error * error, free * free)
    return work[:count]


@compiled
def _simplify(vertices: Any, faces: Any, most: int, limit: float, free: float) -> int:
    """Works on ``faces`` in place; how many of its first rows are left."""
    n = len(vertices)
    count: int = ZERO + len(faces)
    start, around = np.zeros(n + 1, np.int32), np.empty(3 * len(faces), np.int32)
    kind, quadrics = np.zeros(n, np.int8), np.zeros((n, 11))
    onto, mark, touched = np.empty(n, np.int32), np.zeros(n, np.int32), np.zeros(n, np.bool_)
    costs, order = np.empty(3 * len(faces), np.float32), np.empty(3 * len(faces), np.int32)
    bits = costs.view(np.uint32)
    stamp = ZERO
    for turn in range(_PASSES):
        _find_faces(faces, count, start, around)
        if turn == 0:
            _start_quadrics(vertices, faces, count, start, around, kind, quadrics)
        n_costs = _find_costs(vertices, faces, count, start, around, kind, quadrics, limit, costs)
        _sort(bits, 3 * count, order)
        goal = max(count - most, 0)
        last = costs[order[min(goal, max(n_costs - 1, 0))]] * np.float32(1.5)
        for v in range(n):
            onto[v], touched[v] = v, False
        taken = ZERO
        for k in range(n_costs):
            edge = order[k]
            cost = costs[edge]
            if taken >= goal and cost > free:
                break
            if cost > last and cost > free and taken > goal // 6:
                break
            a, b = faces[edge // 3, edge % 3], faces[edge // 3, (edge + 1) % 3]
            if touched[a] or touched[b]:
                continue
            stamp += 2
            gone = _may_collapse(vertices, faces, start, around, onto, mark, a, b, stamp)
            if gone == 0:
                continue
            onto[a] = b
            for i in range(11):
                quadrics[b, i] += quadrics[a, i]
            touched[a], touched[b] = True, True
            taken += gone
        if taken == 0:
            break
        count = _rewrite(faces, count, onto)
    return count


@compiled
def _find_faces(faces: Any, count: int, start: Any, around: Any) -> None:
    """The faces at each vertex: those from ``start[v]`` to ``start[v + 1]`` in ``around``."""
    for v in range(len(start)):
        start[v] = 0
    for f in range(count):
        for c in range(3):
            start[faces[f, c]] += 1
    total = ZERO
    for v in range(len(start)):
        total += start[v]
        start[v] = total
    for f in range(count - 1, -1, -1):
        for c in range(3):
            v = faces[f, c]
            start[v] -= 1
            around[start[v]] = f


@compiled
def _shared(faces: Any, start: Any, around: Any, a: int, b: int) -> int:
    """How many faces have both vertices."""
    found: int = ZERO
    for k in range(start[a], start[a + 1]):
        f = around[k]
        if faces[f, 0] == b or faces[f, 1] == b or faces[f, 2] == b:
            found += 1
    return found


@compiled
def _start_quadrics(vertices: Any, faces: Any, count: int, start: Any, around: Any, kind: Any, quadrics: Any) -> None:
    """Squared distances from the planes round each vertex, and whether it is inside (0), on a border (1) or fixed."""
    normal = np.empty(3)
    for f in range(count):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        area = _normal(vertices, a, b, c, normal)
        for i in range(3):
            _add_plane(vertices, normal, a, area, quadrics, faces[f, i])
    across = np.empty(3)
    for f in range(count):
        for c in range(3):
            a, b = faces[f, c], faces[f, (c + 1) % 3]
            shared = _shared(faces, start, around, a, b)
            if shared == 2:
                continue
            kind[a], kind[b] = max(kind[a], 1 if shared == 1 else 2), max(kind[b], 1 if shared == 1 else 2)
            _normal(vertices, faces[f, 0], faces[f, 1], faces[f, 2], normal)
            x, y, z = (
                vertices[b, 0] - vertices[a, 0],
                vertices[b, 1] - vertices[a, 1],
                vertices[b, 2] - vertices[a, 2],
            )
            long = np.sqrt(x * x + y * y + z * z)
            if long == 0.0:
                continue
            across[0] = (y * normal[2] - z * normal[1]) / long
            across[1] = (z * normal[0] - x * normal[2]) / long
            across[2] = (x * normal[1] - y * normal[0]) / long
            _add_plane(vertices, across, a, _BORDER * long * long, quadrics, a)
            _add_plane(vertices, across, a, _BORDER * long * long, quadrics, b)


@compiled
def _normal(vertices: Any, a: int, b: int, c: int, normal: Any) -> float:
    """The unit normal of a triangle, and its area; zero both where it has none."""
    ax, ay, az = vertices[a, 0], vertices[a, 1], vertices[a, 2]
    ux, uy, uz = vertices[b, 0] - ax, vertices[b, 1] - ay, vertices[b, 2] - az
    vx, vy, vz = vertices[c, 0] - ax, vertices[c, 1] - ay, vertices[c, 2] - az
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    area: float = np.sqrt(x * x + y * y + z * z)
    scale = 1.0 / area if area > 0.0 else 0.0
    normal[0], normal[1], normal[2] = x * scale, y * scale, z * scale
    return 0.5 * area


@compiled
def _add_plane(vertices: Any, normal: Any, at: int, weight: float, quadrics: Any, to: int) -> None:
    x, y, z = normal[0], normal[1], normal[2]
    d = -(x * vertices[at, 0] + y * vertices[at, 1] + z * vertices[at, 2])
    q = quadrics[to]
    q[0] += weight * x * x
    q[1] += weight * y * y
    q[2] += weight * z * z
    q[3] += weight * x * y
    q[4] += weight * y * z
    q[5] += weight * z * x
    q[6] += weight * x * d
    q[7] += weight * y * d
    q[8] += weight * z * d
    q[9] += weight * d * d
    q[10] += weight


@compiled
def _find_costs(
    vertices: Any, faces: Any, count: int, start: Any, around: Any, kind: Any, quadrics: Any, limit: float, costs: Any
) -> int:
    """The cost of moving the first vertex of each edge onto the second; of how many it is within the limit."""
    found: int = ZERO
    for edge in range(3 * count):
        a, b = faces[edge // 3, edge % 3], faces[edge // 3, (edge + 1) % 3]
        costs[edge] = np.inf
        if kind[a] == 2 or (kind[a] == 1 and (kind[b] == 0 or _shared(faces, start, around, a, b) != 1)):
            continue
        x, y, z = vertices[b, 0], vertices[b, 1], vertices[b, 2]
        q = quadrics[a]
        error = x * (q[0] * x + 2.0 * (q[3] * y + q[6])) + y * (q[1] * y + 2.0 * (q[4] * z + q[7]))
        error += z * (q[2] * z + 2.0 * (q[5] * x + q[8])) + q[9]
        if q[10] > 0.0:
            error = abs(error) / q[10]
            if error <= limit:
                costs[edge] = error
                found += 1
    return found


@compiled
def _sort(bits: Any, count: int, order: Any) -> None:
    """The numbers of the costs, the least first, by the leading bits; of equal ones in their order."""
    first = np.zeros(_BUCKETS + 1, np.int32)
    for k in range(count):
        first[(bits[k] >> _BUCKET_BITS) + 1] += 1
    for k in range(_BUCKETS):
        first[k + 1] += first[k]
    for k in range(count):
        bucket = bits[k] >> _BUCKET_BITS
        order[first[bucket]] = k
        first[bucket] += 1


@compiled
def _may_collapse(
    vertices: Any, faces: Any, start: Any, around: Any, onto: Any, mark: Any, a: int, b: int, stamp: int
) -> int:
    """How many faces go if a vertex moves onto another; 0 where it may not."""
    gone: int = ZERO
    gone, joined = _leave(vertices, faces, start, around, onto, mark, a, b, stamp)
    if gone <= 0:
        return 0
    common, others = _arrive(faces, start, around, onto, mark, a, b, stamp)
    # The link condition; with less than three vertices round both nothing but two faces back to back would be left.
    return gone if common == gone and joined + others > 2 else 0


@compiled
def _leave(
    vertices: Any, faces: Any, start: Any, around: Any, onto: Any, mark: Any, a: int, b: int, stamp: int
) -> tuple[int, int]:
    """How many faces round a vertex have the other, and how many further vertices are round it, which get a mark.

    The first is -1 where a face would turn too far if the vertex moved to the other.
    """
    gone: int = ZERO
    joined: int = ZERO
    for k in range(start[a], start[a + 1]):
        f = around[k]
        x, y, z = onto[faces[f, 0]], onto[faces[f, 1]], onto[faces[f, 2]]
        if x == y or y == z or z == x:
            continue
        # The other two in order, whichever corner the vertex itself is.
        y, z = (y, z) if x == a else ((z, x) if y == a else (x, y))
        if b in (y, z):
            gone += 1
        elif _turns(vertices, a, b, y, z):
            return ZERO - 1, joined
        for c in range(2):
            v = y if c == 0 else z
            if v != b and mark[v] != stamp:
                mark[v] = stamp
                joined += 1
    return gone, joined


@compiled
def _arrive(faces: Any, start: Any, around: Any, onto: Any, mark: Any, a: int, b: int, stamp: int) -> tuple[int, int]:
    """How many vertices round the second one have the mark, and how many have not."""
    common: int = ZERO
    others: int = ZERO
    for k in range(start[b], start[b + 1]):
        f = around[k]
        x, y, z = onto[faces[f, 0]], onto[faces[f, 1]], onto[faces[f, 2]]
        if x == y or y == z or z == x:
            continue
        for c in range(3):
            v = x if c == 0 else (y if c == 1 else z)
            if v in (a, b) or mark[v] == stamp + 1:
                continue
            if mark[v] == stamp:
                common += 1
            else:
                others += 1
            mark[v] = stamp + 1
    return common, others


@compiled
def _turns(vertices: Any, a: int, b: int, y: int, z: int) -> bool:
    """Whether a face turns too far when its first vertex moves from one place to another."""
    before, after = np.empty(3), np.empty(3)
    if _normal(vertices, a, y, z, before) == 0.0:
        return False
    _normal(vertices, b, y, z, after)
    cosine: float = before[0] * after[0] + before[1] * after[1] + before[2] * after[2]
    return cosine < _TURN


@compiled
def _rewrite(faces: Any, count: int, onto: Any) -> int:
    """The faces after the collapses, those without area left out; how many there are."""
    kept: int = ZERO
    for f in range(count):
        x, y, z = onto[faces[f, 0]], onto[faces[f, 1]], onto[faces[f, 2]]
        if x != y and y != z and z != x:
            faces[kept, 0], faces[kept, 1], faces[kept, 2] = x, y, z
            kept += 1
    return kept
