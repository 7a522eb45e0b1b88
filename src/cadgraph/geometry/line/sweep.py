"""Finds every tube of a triangle soup: starts on its largest faces, and follows each both ways."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.line.march import NODE, march, note, settle
from cadgraph.geometry.line.section import MAX_RINGS, cut, plane_axes
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints

__all__ = ["essential_nodes", "trace_pieces"]

_MAX_NODES = 8192
_MAX_PIECES = 32
# Faces tried as starts: before giving up on finding a first tube, and in all.
_FIRST_TRIES = 10
_MAX_TRIES = 60
# Faces whose normals are this close to parallel (cosine of 3 degrees) are alike as starts.
_SAME_DIRECTION = 0.9986
# Directions tried in the plane of a face, beside its sides.
_N_TURNS = 8
# A start must have its normals this flat along the axis (least over greatest eigenvalue; 0 for any exact tube).
_FLAT_NORMALS = 0.03
# No more is looked for when less than this share of the area is left.
_DONE = 0.03


@compiled
def _seed(
    corners: Floats, normals: Floats, face: int, size: float, node: Floats,
    segments: Floats, owners: Ints, ring_of: Ints,
) -> bool:  # fmt: skip
    """Looks for a tube whose wall a face is part of; writes its section there."""
    t, normal = corners[face], normals[face]
    middle = (t[0:3] + t[3:6] + t[6:9]) / 3.0
    u, w, axis, center = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    rings, across = np.empty((MAX_RINGS, 4)), np.empty(8)
    plane_axes(normal, u, w)
    best = _FLAT_NORMALS
    for k in range(3 + _N_TURNS):
        if not _set_axis(axis, k, t, u, w, size):
            continue
        n_across = _cross(corners, middle, axis, normal, size, segments, owners, across)
        for a in range(n_across):
            for c in range(3):
                center[c] = middle[c] - 0.5 * across[a] * normal[c]
            heading = axis.copy()
            radius = 0.5 * abs(across[a])
            n_rings, _, _, flatness = settle(
                corners, normals, center, heading, 0.0, 6.0 * radius, segments, owners, ring_of, rings
            )
            if n_rings == 0 or flatness >= best:
                continue
            best = flatness
            note(node, center, heading, rings, n_rings)
        if best < 1e-6:
            break
    return best < _FLAT_NORMALS


@compiled
def _set_axis(axis: Floats, k: int, t: Floats, u: Floats, w: Floats, size: float) -> bool:
    """Writes the direction that is tried at a number: the sides of a face, then turns in its plane; False for none."""
    if k >= 3:
        angle = np.pi * (k - 3) / _N_TURNS
        for c in range(3):
            axis[c] = np.cos(angle) * u[c] + np.sin(angle) * w[c]
        return True
    for c in range(3):
        axis[c] = t[3 * k + c] - t[3 * ((k + 1) % 3) + c]
    length = np.sqrt((axis**2).sum())
    if not length > 1e-9 * size:
        return False
    axis /= length
    return True


@compiled
def _cross(
    corners: Floats, middle: Floats, axis: Floats, normal: Floats, size: float,
    segments: Floats, owners: Ints, across: Floats,
) -> int:  # fmt: skip
    """Signed distances from a face's middle, against its normal, to the walls opposite in a section; nearest first."""
    side = np.empty(3)
    side[0] = axis[1] * normal[2] - axis[2] * normal[1]
    side[1] = axis[2] * normal[0] - axis[0] * normal[2]
    side[2] = axis[0] * normal[1] - axis[1] * normal[0]
    n = cut(corners, middle, axis, normal, side, size, segments, owners)
    behind, before = np.full(4, np.inf), np.full(4, np.inf)
    for s in range(n):
        y0, y1 = segments[s, 1], segments[s, 3]
        if (y0 >= 0.0) == (y1 >= 0.0):
            continue
        x = segments[s, 0] - y0 * (segments[s, 2] - segments[s, 0]) / (y1 - y0)
        if abs(x) <= 1e-6 * size:
            continue
        row = behind if x < 0.0 else before
        value = abs(x)
        for k in range(4):
            if value < row[k]:
                value, row[k] = row[k], value
    n_across = 0
    for k in range(4):
        if behind[k] < np.inf:
            across[n_across] = behind[k]
            n_across += 1
        if before[k] < np.inf:
            across[n_across] = -before[k]
            n_across += 1
    return n_across


@compiled
def _cover(middles: Floats, nodes: Floats, first: int, last: int, covered: Bools) -> None:
    """Marks the faces whose middle lies within the outer radius of a piece."""
    for f in range(len(middles)):
        if covered[f]:
            continue
        for k in range(first, last - 1):
            a, b = nodes[k], nodes[k + 1]
            bx, by, bz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
            px, py, pz = middles[f, 0] - a[0], middles[f, 1] - a[1], middles[f, 2] - a[2]
            length = np.sqrt(bx * bx + by * by + bz * bz)
            if not length > 0.0:
                continue
            along = (px * bx + py * by + pz * bz) / length
            reach = max(a[3], b[3])
            slack = 0.05 * reach
            if along < -slack or along > length + slack:
                continue
            away = px * px + py * py + pz * pz - along * along
            if away <= (1.05 * reach) ** 2:
                covered[f] = True
                break


@compiled
def _overlaps(nodes: Floats, starts: Ints, n_pieces: int, first: int, last: int) -> bool:
    """Whether most of a new piece runs where another one runs already."""
    if n_pieces == 0:
        return False
    n_shared = 0
    for k in range(first, last):
        shared = False
        for j in range(starts[0], starts[n_pieces]):
            d = cosine = 0.0
            for c in range(3):
                d += (nodes[j, c] - nodes[k, c]) ** 2
                cosine += nodes[j, 6 + c] * nodes[k, 6 + c]
            if d < (0.5 * nodes[k, 5]) ** 2 and abs(cosine) > 0.8:
                shared = True
                break
        n_shared += shared
    return 2 * n_shared > last - first


@compiled
def trace_pieces(corners: Floats, normals: Floats, areas: Floats, size: float) -> tuple[Floats, Ints, Floats, float]:
    """Follows every tube of a mesh.

    Args:
        corners: ``(m, 9)`` triangles with area [m].
        normals: ``(m, 3)`` their unit normals, either sense.
        areas: ``(m,)`` [m2].
        size: longest extent [m].

    Returns:
        Nodes ``(n, NODE)`` of all pieces; where each piece starts ``(n_pieces + 1,)``; for each piece how its two
        ends go on ``(n_pieces, 2, 4)``: extension beyond the node [m] and direction outward, NaN for a closed piece;
        and the share of the area that belongs to the pieces.
    """
    m = len(corners)
    segments, owners, ring_of = np.empty((m, 4)), np.empty(m, np.int64), np.empty(m, np.int64)
    middles = (corners[:, :3] + corners[:, 3:6] + corners[:, 6:]) / 3.0
    nodes = np.empty((_MAX_NODES, NODE))
    starts = np.zeros(_MAX_PIECES + 1, np.int64)
    ends = np.zeros((_MAX_PIECES, 2, 4))
    covered = np.zeros(m, np.bool_)
    failed, n_failed = np.empty((_MAX_TRIES, 3)), 0
    by_area = np.argsort(-areas)
    total, left = areas.sum(), areas.sum()
    node = np.empty(NODE)
    n_pieces = n_tries = 0
    while left > _DONE * total and _has_room(n_pieces, n_tries, starts[n_pieces]):
        face = _next_seed(by_area, normals, covered, failed, n_failed)
        if face < 0:
            break
        n_tries += 1
        failed[n_failed] = normals[face]
        n_failed += 1
        if not _seed(corners, normals, face, size, node, segments, owners, ring_of):
            continue
        first = starts[n_pieces]
        last = _trace_both(corners, normals, node, nodes, first, ends[n_pieces], segments, owners, ring_of)
        if last - first < 2 or _overlaps(nodes, starts, n_pieces, first, last):
            continue
        n_pieces += 1
        n_failed -= 1
        starts[n_pieces] = last
        _cover(middles, nodes, first, last, covered)
        left = _area_left(areas, covered)
    share = 1.0 - left / total if total > 0.0 else 0.0
    return nodes[: starts[n_pieces]].copy(), starts[: n_pieces + 1].copy(), ends[:n_pieces].copy(), share


@compiled
def _has_room(n_pieces: int, n_tries: int, n_nodes: int) -> bool:
    """Whether another piece may be looked for."""
    tries = _FIRST_TRIES if n_pieces == 0 else _MAX_TRIES
    return n_pieces < _MAX_PIECES and n_tries < tries and _MAX_NODES - n_nodes >= 16


@compiled
def _area_left(areas: Floats, covered: Bools) -> float:
    """The area of the faces that no piece covers [m2]."""
    left = 0.0
    for f in range(len(areas)):
        if not covered[f]:
            left += areas[f]
    return left


@compiled
def _next_seed(by_area: Ints, normals: Floats, covered: Bools, failed: Floats, n_failed: int) -> int:
    """The largest face left whose direction has not failed yet: no other place of a flat side will do better."""
    for f in by_area:
        if covered[f]:
            continue
        fresh = True
        for k in range(n_failed):
            cosine = 0.0
            for c in range(3):
                cosine += failed[k, c] * normals[f, c]
            if abs(cosine) > _SAME_DIRECTION:
                fresh = False
                break
        if fresh:
            return int(f)
    return -1


@compiled
def _trace_both(
    corners: Floats, normals: Floats, node: Floats, nodes: Floats, first: int, ends: Floats,
    segments: Floats, owners: Ints, ring_of: Ints,
) -> int:  # fmt: skip
    """Follows a tube both ways from a section and writes one run of nodes; returns where it ends."""
    room = (len(nodes) - first - 4) // 2
    back = np.empty((room, NODE))
    node = node.copy()
    node[6:9] = -node[6:9]
    n_back, closed = march(corners, normals, node, back, ends[0], segments, owners, ring_of)
    node[6:9] = -node[6:9]
    at = first
    for k in range(n_back - 1, -1, -1):
        nodes[at] = back[k]
        nodes[at, 6:9] = -back[k, 6:9]
        at += 1
    nodes[at] = node
    at += 1
    if closed:
        nodes[at] = nodes[first]
        ends[:] = np.nan
        return at + 1
    n_on, closed = march(corners, normals, node, nodes[at : at + room], ends[1], segments, owners, ring_of)
    if closed:
        # This way round was free, so where the other way stuck doesn't matter.
        for k in range(n_on):
            nodes[first + 1 + k] = nodes[at + k]
        nodes[first] = node
        nodes[first + 1 + n_on] = node
        ends[:] = np.nan
        return first + n_on + 2
    at += n_on
    # A node at either end, where the wall ends.
    if ends[0, 0] > 0.0:
        for k in range(at, first, -1):
            nodes[k] = nodes[k - 1]
        at += 1
        for c in range(3):
            nodes[first, c] -= ends[0, 0] * nodes[first, 6 + c]
    if ends[1, 0] > 0.0:
        nodes[at] = nodes[at - 1]
        for c in range(3):
            nodes[at, c] += ends[1, 0] * nodes[at, 6 + c]
        at += 1
    return at


@compiled
def essential_nodes(values: Floats, tolerance: float) -> Ints:
    """Which nodes of a run to keep so that dropping the others moves nothing by more than a share of the radius.

    Args:
        values: ``(n, 5)`` position, outer radius and bore (or NaN) [m].
        tolerance: share of the radius.

    Returns:
        Indices, ascending, the first and the last among them.
    """
    n = len(values)
    keep = np.empty(n, np.int64)
    keep[0] = 0
    n_kept, start = 1, 0
    for stop in range(2, n):
        limit = tolerance * values[start, 3]
        for k in range(start + 1, stop):
            if not _is_between(values, start, stop, k, limit):
                start = stop - 1
                keep[n_kept] = start
                n_kept += 1
                break
    if n > 1:
        keep[n_kept] = n - 1
        n_kept += 1
    return keep[:n_kept]


@compiled
def _is_between(values: Floats, start: int, stop: int, k: int, limit: float) -> bool:
    """Whether a node lies within a limit [m] of the line from one node to another, its radii too."""
    length2 = share = 0.0
    for c in range(3):
        length2 += (values[stop, c] - values[start, c]) ** 2
        share += (values[k, c] - values[start, c]) * (values[stop, c] - values[start, c])
    share = min(1.0, max(0.0, share / length2)) if length2 > 0.0 else 0.0
    for c in range(5):
        a, b, v = values[start, c], values[stop, c], values[k, c]
        without = c == 4 and np.isnan(a) and np.isnan(b) and np.isnan(v)
        if not without and not abs(v - a - share * (b - a)) <= limit:
            return False
    return True
