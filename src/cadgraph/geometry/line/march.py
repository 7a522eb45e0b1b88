"""Follows one tube through a triangle soup by planes that stay perpendicular to the way it goes."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.line.section import MAX_RINGS, ROUND, cut, find_rings, plane_axes
from cadgraph.geometry.mesh.box import principal_axes
from cadgraph.model.scene import Floats, Ints

__all__ = ["NODE", "march", "note", "settle"]

# Columns of a node: position, outer radius, bore radius (NaN without inner wall), radius followed, direction.
NODE = 9
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
def settle(
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
        turned = _turn_to(axis, axes[2])
        moved = np.hypot(rings[0, 0], rings[0, 1])
        if turned > 0.5 or (turned < 1e-14 and moved < 1e-9 * rings[0, 2]):
            break
    return n_rings, support, n, flatness


@compiled
def _turn_to(axis: Floats, other: Floats) -> float:
    """Turns an axis to another one of either sense, and returns by how much: 1 less the cosine; not by more than a half
    of that.
    """
    cosine = other[0] * axis[0] + other[1] * axis[1] + other[2] * axis[2]
    if abs(cosine) >= 0.5:
        for c in range(3):
            axis[c] = other[c] if cosine > 0.0 else -other[c]
    return float(1.0 - abs(cosine))


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
        near, farthest, at = _corners_ahead(t, center, axis)
        nearest = min(nearest, near)
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
    reach = _reach_of_plane(points, middle, weight, axis, mean_normal)
    return nearest, total / weight if np.isnan(reach) else reach


@compiled
def _corners_ahead(t: Floats, center: Floats, axis: Floats) -> tuple[float, float, int]:
    """Of a triangle's corners that lie ahead how far the nearest and the farthest are, and which that is."""
    nearest, farthest, at = np.inf, 0.0, 0
    for v in range(0, 9, 3):
        d = (t[v] - center[0]) * axis[0] + (t[v + 1] - center[1]) * axis[1] + (t[v + 2] - center[2]) * axis[2]
        if d > 0.0:
            nearest = min(nearest, d)
            if d > farthest:
                farthest, at = d, v
    return nearest, farthest, at


@compiled
def _reach_of_plane(points: Floats, middle: Floats, weight: float, axis: Floats, mean_normal: Floats) -> float:
    """How far along the axis the plane through some points lies, whose normal it writes; NaN where they are in none."""
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
    return float(reach / abs(cosine)) if good else np.nan


@compiled
def note(node: Floats, center: Floats, axis: Floats, rings: Floats, n_rings: int) -> None:
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
def _continues(
    center: Floats, axis: Floats, probe: Floats, heading: Floats, found: float, radius: float, step: float,
    coasted: float,
) -> bool:  # fmt: skip
    """Whether a section ahead, as it settled with the radius found, is the next one of the same tube."""
    forward = sideways = cosine = 0.0
    for c in range(3):
        forward += (probe[c] - center[c]) * axis[c]
        cosine += heading[c] * axis[c]
    for c in range(3):
        sideways += (probe[c] - center[c] - forward * axis[c]) ** 2
    sideways = np.sqrt(sideways)
    whole = cosine > _MAX_TURN and forward > 0.2 * step
    whole = whole and sideways <= 0.25 * radius + 0.5 * step * np.sqrt(max(0.0, 1.0 - cosine * cosine))
    whole = whole and radius / _MAX_JUMP < found < radius * _MAX_JUMP
    if whole and coasted > 0.0:
        whole = sideways <= 0.1 * radius and abs(found - radius) <= ROUND * radius
    return bool(whole)


@compiled
def _advance(
    corners: Floats, normals: Floats, center: Floats, axis: Floats, radius: float, outer: float, gap: float,
    coasted: float, probe: Floats, heading: Floats, segments: Floats, owners: Ints, ring_of: Ints, rings: Floats,
) -> tuple[float, int, int]:  # fmt: skip
    """Looks for the next section, nearer and nearer, and writes its middle and direction.

    Returns the step that was taken, 0 where the tube ends; the number of rings, 0 where it only coasts through a side
    opening; and the number of segments.
    """
    step = _first_step(gap, radius, coasted)
    while step >= _LEAST * radius:
        for c in range(3):
            probe[c] = center[c] + step * axis[c]
            heading[c] = axis[c]
        n_rings, support, n, _ = settle(
            corners, normals, probe, heading, radius, 6.0 * max(outer, radius), segments, owners, ring_of, rings
        )
        if n_rings > 0 and _continues(center, axis, probe, heading, rings[0, 2], radius, step, coasted):
            return step, n_rings, n
        if support >= _HALF and step <= 1.01 * _PAST * radius and coasted < _COAST * radius:
            return step, 0, n
        step = 0.5 * step
    return 0.0, 0, 0


@compiled
def _first_step(gap: float, radius: float, coasted: float) -> float:
    """How far ahead the next section is looked for first [m]: before the wall's next corners, or just past them."""
    step = gap - _BEFORE * radius if gap > (_PAST + 2 * _BEFORE) * radius else gap + _PAST * radius
    return step if coasted <= 0.0 and np.isfinite(step) else _PAST * radius


@compiled
def march(
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
    base = center.copy()
    n_nodes = 0
    _, _, n, _ = settle(corners, normals, center, axis, radius, 6.0 * outer, segments, owners, ring_of, rings)
    gap, extension = _ahead(corners, center, axis, segments, owners, ring_of, n, end[1:4])
    while n_nodes < len(nodes):
        step, n_rings, n = _advance(
            corners, normals, center, axis, radius, outer, gap, coasted, probe, heading,
            segments, owners, ring_of, rings,
        )  # fmt: skip
        if step == 0.0:
            break
        if n_rings == 0:
            coasted += step
            for c in range(3):
                center[c] += step * axis[c]
            continue
        coasted = 0.0
        walked += np.sqrt(((probe - base) ** 2).sum())
        center[:], axis[:] = probe, heading
        base[:] = probe
        note(nodes[n_nodes], center, axis, rings, n_rings)
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
