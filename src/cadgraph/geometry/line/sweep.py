"""Follows tubes through a triangle soup by planes that stay perpendicular to the way they go."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.line.section import MAX_RINGS, ROUND, cut, find_rings, plane_axes
from cadgraph.geometry.mesh.box import principal_axes
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints

__all__ = ["NODE", "essential_nodes", "trace_pieces"]

# Columns of a node: position, outer radius, bore radius (NaN without inner wall), radius followed, direction.
NODE = 9
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
# Steps, as share of the radius: past the next change of the wall, up to just before it, the least one, and how far
# to go on through a side opening.
_PAST, _BEFORE, _LEAST, _COAST = 0.1, 0.02, 0.01, 3.0
# Share of the rays that must still meet the wall to go on through a side opening: an opening as wide as the tube
# leaves half of it.
_HALF = 0.5
# Greatest change of the radius from one section to the next, as a factor: pipe to flange.
_MAX_JUMP = 4.0
# Share of a ring's length whose faces must look the same way to say which way it looks.
_AGREED = 0.5
# A second wall within this factor of the first one's radius is its jacket.
_JACKET = 1.3
# Greatest turn from one section to the next (cosine of 35 degrees).
_MAX_TURN = 0.82


@compiled
def _settle(
    corners: Floats, normals: Floats, center: Floats, axis: Floats, expected: float, limit: float,
    segments: Floats, owners: Ints, ring_of: Ints, rings: Floats,
) -> tuple[int, float, int, float]:  # fmt: skip
    """Moves a section to the middle of its innermost ring and turns it perpendicular to the wall.

    Returns the number of rings, the support at the expected radius, the number of segments, and how flat the
    normals are along the axis.
    """
    u, w, moments = np.empty(3), np.empty(3), np.empty((3, 3))
    axes, values = np.empty((3, 3)), np.empty(3)
    n = n_rings = 0
    support, flatness = 0.0, 1.0
    for turn in range(4):
        plane_axes(axis, u, w)
        n = cut(corners, center, axis, u, w, limit, segments, owners)
        n_rings, met = find_rings(segments, owners, n, normals, axis, u, w, expected, rings, moments, ring_of)
        if turn == 0:
            support = met
        if n_rings == 0:
            break
        for c in range(3):
            center[c] += rings[0, 0] * u[c] + rings[0, 1] * w[c]
        principal_axes(moments, axes, values)
        flatness = values[2] / values[0] if values[0] > 0.0 else 1.0
        # Where the normals do not say which way the wall runs, the old direction stays.
        if values[2] > 0.2 * values[1]:
            break
        cosine = axes[2, 0] * axis[0] + axes[2, 1] * axis[1] + axes[2, 2] * axis[2]
        if abs(cosine) < 0.5:
            break
        moved = np.hypot(rings[0, 0], rings[0, 1])
        turned = 1.0 - abs(cosine)
        for c in range(3):
            axis[c] = axes[2, c] if cosine > 0.0 else -axes[2, c]
        if turned < 1e-14 and moved < 1e-9 * rings[0, 2]:
            break
    return n_rings, support, n, flatness


@compiled
def _ahead(
    corners: Floats, center: Floats, axis: Floats, segments: Floats, owners: Ints, ring_of: Ints, n: int,
    mean_normal: Floats,
) -> tuple[float, float]:  # fmt: skip
    """How far the wall runs on: to its nearest vertex, and along the axis to the end of its faces.

    Also writes the normal of the plane through the far vertices.
    """
    nearest, total, weight = np.inf, 0.0, 0.0
    points = np.zeros((3, 3))
    middle = np.zeros(3)
    for s in range(n):
        if ring_of[s] < 0:
            continue
        t = corners[owners[s]]
        farthest, at = 0.0, 0
        for v in range(0, 9, 3):
            d = (t[v] - center[0]) * axis[0] + (t[v + 1] - center[1]) * axis[1] + (t[v + 2] - center[2]) * axis[2]
            if d > 0.0:
                nearest = min(nearest, d)
                if d > farthest:
                    farthest, at = d, v
        length = np.hypot(segments[s, 2] - segments[s, 0], segments[s, 3] - segments[s, 1])
        total += length * farthest
        weight += length
        for r in range(3):
            p = t[at + r] - center[r]
            middle[r] += length * p
            for c in range(3):
                points[r, c] += length * p * (t[at + c] - center[c])
    if weight == 0.0:
        return 0.0, 0.0
    for r in range(3):
        for c in range(3):
            points[r, c] = points[r, c] / weight - middle[r] * middle[c] / (weight * weight)
    axes, values = np.empty((3, 3)), np.empty(3)
    principal_axes(points, axes, values)
    cosine = axes[2, 0] * axis[0] + axes[2, 1] * axis[1] + axes[2, 2] * axis[2]
    # Only a plane, and one that is crossed, says which way the end looks.
    good = values[2] < 1e-4 * values[1] and abs(cosine) > 0.9
    reach = 0.0
    for c in range(3):
        mean_normal[c] = (axes[2, c] if cosine > 0.0 else -axes[2, c]) if good else axis[c]
        reach += middle[c] / weight * mean_normal[c]
    # Where the axis meets that plane.
    return nearest, reach / abs(cosine) if good else total / weight


@compiled
def _note(node: Floats, center: Floats, axis: Floats, rings: Floats, n_rings: int) -> None:
    """Writes a node.

    A wall that looks inward is the bore, and the next ring the outside; one that looks outward is the outside of a
    solid, and what lies around it is something else. Where faces disagree, an even number of rings has a bore.
    """
    for c in range(3):
        node[c] = center[c]
        node[6 + c] = axis[c]
    hollow = n_rings % 2 == 0
    outer = n_rings - 1
    if abs(rings[0, 3]) > _AGREED:
        hollow = rings[0, 3] < 0.0 and n_rings > 1
        outer = 1 if hollow else 0
        # A lining or jacket close around belongs to the tube.
        if hollow and n_rings == 4 and rings[2, 2] < _JACKET * rings[1, 2]:
            outer = 3
    node[3] = rings[outer, 2]
    node[4] = rings[0, 2] if hollow else np.nan
    node[5] = rings[0, 2]


@compiled
def _march(
    corners: Floats, normals: Floats, start: Floats, nodes: Floats, end: Floats,
    segments: Floats, owners: Ints, ring_of: Ints,
) -> tuple[int, bool]:  # fmt: skip
    """Follows a tube from a node until it ends; writes nodes behind the start and (extension, direction) of the end.

    Returns how many nodes there are, and whether the tube came back to its start.
    """
    center, axis = start[:3].copy(), start[6:9].copy()
    radius, outer = start[5], start[3]
    rings = np.empty((MAX_RINGS, 4))
    probe, heading = np.empty(3), np.empty(3)
    walked = coasted = 0.0
    base, ahead = center.copy(), axis.copy()
    n_nodes = 0
    n_rings, _, n, _ = _settle(corners, normals, center, axis, radius, 6.0 * outer, segments, owners, ring_of, rings)
    gap, extension = _ahead(corners, center, axis, segments, owners, ring_of, n, end[1:4])
    while n_nodes < len(nodes):
        step = gap - _BEFORE * radius if gap > (_PAST + 2 * _BEFORE) * radius else gap + _PAST * radius
        if coasted > 0.0 or not np.isfinite(step):
            step = _PAST * radius
        done = True
        while step >= _LEAST * radius:
            for c in range(3):
                probe[c] = center[c] + step * axis[c]
                heading[c] = axis[c]
            n_rings, support, n, _ = _settle(
                corners, normals, probe, heading, radius, 6.0 * max(outer, radius), segments, owners, ring_of, rings
            )
            forward = sideways = cosine = 0.0
            for c in range(3):
                forward += (probe[c] - center[c]) * axis[c]
                cosine += heading[c] * axis[c]
            for c in range(3):
                sideways += (probe[c] - center[c] - forward * axis[c]) ** 2
            sideways = np.sqrt(sideways)
            whole = n_rings > 0 and cosine > _MAX_TURN and forward > 0.2 * step
            whole = whole and sideways <= 0.25 * radius + 0.5 * step * np.sqrt(max(0.0, 1.0 - cosine * cosine))
            whole = whole and radius / _MAX_JUMP < rings[0, 2] < radius * _MAX_JUMP
            if whole and coasted > 0.0:
                whole = sideways <= 0.1 * radius and abs(rings[0, 2] - radius) <= ROUND * radius
            if whole:
                done = False
                break
            if support >= _HALF and step <= 1.01 * _PAST * radius and coasted < _COAST * radius:
                done = False
                break
            step = 0.5 * step
        if done:
            break
        if not whole:
            coasted += step
            for c in range(3):
                center[c] += step * axis[c]
            continue
        coasted = 0.0
        walked += np.sqrt(((probe - base) ** 2).sum())
        center[:], axis[:] = probe, heading
        base[:], ahead[:] = probe, heading
        _note(nodes[n_nodes], center, axis, rings, n_rings)
        n_nodes += 1
        radius, outer = rings[0, 2], nodes[n_nodes - 1, 3]
        gap, extension = _ahead(corners, center, axis, segments, owners, ring_of, n, end[1:4])
        if n_nodes > 2 and walked > 4.0 * radius and _came_back(center, axis, start, nodes, n_nodes, radius):
            return n_nodes - 1, True
    end[0] = extension
    if n_nodes == len(nodes):
        end[0] = 0.0
    return n_nodes, False


@compiled
def _came_back(center: Floats, axis: Floats, start: Floats, nodes: Floats, n_nodes: int, radius: float) -> bool:
    """Whether the last step led through the section where the walk started."""
    before = now = cosine = away = 0.0
    for c in range(3):
        before += (nodes[n_nodes - 2, c] - start[c]) * start[6 + c]
        now += (center[c] - start[c]) * start[6 + c]
        cosine += axis[c] * start[6 + c]
        away += (center[c] - start[c]) ** 2
    step = now - before
    return bool(before < 0.0 and now >= 0.0 and cosine > 0.5 and np.sqrt(away) < 0.5 * radius + step)


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
    sides = np.array([0, 3, 3, 6, 6, 0])
    best = _FLAT_NORMALS
    for k in range(3 + _N_TURNS):
        if k < 3:
            for c in range(3):
                axis[c] = t[sides[2 * k] + c] - t[sides[2 * k + 1] + c]
            length = np.sqrt((axis**2).sum())
            if not length > 1e-9 * size:
                continue
            axis /= length
        else:
            angle = np.pi * (k - 3) / _N_TURNS
            for c in range(3):
                axis[c] = np.cos(angle) * u[c] + np.sin(angle) * w[c]
        n_across = _cross(corners, middle, axis, normal, size, segments, owners, across)
        for a in range(n_across):
            for c in range(3):
                center[c] = middle[c] - 0.5 * across[a] * normal[c]
            heading = axis.copy()
            radius = 0.5 * abs(across[a])
            n_rings, _, _, flatness = _settle(
                corners, normals, center, heading, 0.0, 6.0 * radius, segments, owners, ring_of, rings
            )
            if n_rings == 0 or flatness >= best:
                continue
            best = flatness
            _note(node, center, heading, rings, n_rings)
        if best < 1e-6:
            break
    return best < _FLAT_NORMALS


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
    middles = np.empty((m, 3))
    for f in range(m):
        for c in range(3):
            middles[f, c] = (corners[f, c] + corners[f, 3 + c] + corners[f, 6 + c]) / 3.0
    nodes = np.empty((_MAX_NODES, NODE))
    starts = np.zeros(_MAX_PIECES + 1, np.int64)
    ends = np.zeros((_MAX_PIECES, 2, 4))
    covered = np.zeros(m, np.bool_)
    failed, n_failed = np.empty((_MAX_TRIES, 3)), 0
    by_area = np.argsort(-areas)
    total, left = areas.sum(), areas.sum()
    node = np.empty(NODE)
    n_pieces = n_tries = 0
    while n_pieces < _MAX_PIECES and n_tries < (_FIRST_TRIES if n_pieces == 0 else _MAX_TRIES):
        if left <= _DONE * total or _MAX_NODES - starts[n_pieces] < 16:
            break
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
        left = 0.0
        for f in range(m):
            if not covered[f]:
                left += areas[f]
    share = 1.0 - left / total if total > 0.0 else 0.0
    return nodes[: starts[n_pieces]].copy(), starts[: n_pieces + 1].copy(), ends[:n_pieces].copy(), share


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
    n_back, closed = _march(corners, normals, node, back, ends[0], segments, owners, ring_of)
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
    n_on, closed = _march(corners, normals, node, nodes[at : at + room], ends[1], segments, owners, ring_of)
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
        length2 = 0.0
        for c in range(3):
            length2 += (values[stop, c] - values[start, c]) ** 2
        limit = tolerance * values[start, 3]
        bends = False
        for k in range(start + 1, stop):
            share = 0.0
            for c in range(3):
                share += (values[k, c] - values[start, c]) * (values[stop, c] - values[start, c])
            share = min(1.0, max(0.0, share / length2)) if length2 > 0.0 else 0.0
            for c in range(5):
                a, b, v = values[start, c], values[stop, c], values[k, c]
                if c == 4 and np.isnan(a) and np.isnan(b) and np.isnan(v):
                    continue
                if not abs(v - a - share * (b - a)) <= limit:
                    bends = True
                    break
            if bends:
                break
        if bends:
            start = stop - 1
            keep[n_kept] = start
            n_kept += 1
    if n > 1:
        keep[n_kept] = n - 1
        n_kept += 1
    return keep[:n_kept]
