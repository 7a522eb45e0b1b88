"""Where runs along tubes meet: end to end, end to middle, or across each other."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.line.piece import Piece
from cadgraph.model.scene import Floats

__all__ = ["common_point", "find_crossings", "find_tap", "group_meeting_ends", "point_on_middle"]

# Two ends meet where their axes pass each other within this share of the lesser radius, ...
_MEET = 0.5
# ... at most so many radii ahead, and unless they point the same way (cosine).
_MAX_REACH = 3.0
_PARALLEL = 0.8


def group_meeting_ends(pieces: list[Piece], open_ends: list[tuple[int, int]]) -> list[list[tuple[int, int]]]:
    """Groups of two or more ends whose axes run into each other."""
    group_of = list(range(len(open_ends)))
    for i, (p, e) in enumerate(open_ends):
        for j in range(i):
            q, f = open_ends[j]
            if p != q and _ends_meet(pieces[p], e, pieces[q], f):
                old, new = group_of[i], group_of[j]
                group_of = [new if g == old else g for g in group_of]
    groups: dict[int, list[tuple[int, int]]] = {}
    for end, g in zip(open_ends, group_of, strict=True):
        groups.setdefault(g, []).append(end)
    return [group for group in groups.values() if len(group) > 1]


def _ends_meet(a: Piece, end_a: int, b: Piece, end_b: int) -> bool:
    tip_a, tip_b, d, g = a.tip(end_a), b.tip(end_b), a.outward[end_a], b.outward[end_b]
    greater, lesser = max(tip_a[3], tip_b[3]), min(tip_a[3], tip_b[3])
    cosine = float(d @ g)
    between = tip_b[:3] - tip_a[:3]
    if cosine > _PARALLEL or np.linalg.norm(between) > 2 * _MAX_REACH * greater:
        return False
    if cosine < -0.99:
        along = float(between @ d)
        offset = float(np.linalg.norm(between - along * d))
        return bool(offset < _MEET * lesser and -greater < along < _MAX_REACH * greater)
    # The points where the two lines are nearest to each other.
    s = float(between @ (d - cosine * g)) / (1 - cosine**2)
    t = float(between @ (cosine * d - g)) / (1 - cosine**2)
    offset = float(np.linalg.norm(tip_a[:3] + s * d - tip_b[:3] - t * g))
    # A swept tip may lie beyond the corner, but only where its last faces ran on: at the outside of a mitre.
    low_a = -a.extension[end_a] - 0.25 * lesser
    low_b = -b.extension[end_b] - 0.25 * lesser
    high = _MAX_REACH * greater
    return bool(offset < _MEET * lesser and low_a < s < high and low_b < t < high)


def common_point(tips: list[Floats], directions: list[Floats]) -> Floats:
    """The point nearest to all axes, and among those on parallel axes the one nearest to the tips."""
    matrix, right = 1e-6 * np.eye(3), 1e-6 * np.mean(tips, axis=0)
    for tip, direction in zip(tips, directions, strict=True):
        across = (np.eye(3) - np.outer(direction, direction)) / len(tips)
        matrix = matrix + across
        right = right + across @ tip
    return np.asarray(np.linalg.solve(matrix, right), np.float64)


def find_tap(pieces: list[Piece], p: int, e: int) -> tuple[int, Floats] | None:
    """Where the axis of an end runs into the middle of another piece: that piece and the point."""
    tip, direction = pieces[p].tip(e), pieces[p].outward[e]
    best: tuple[float, int, Floats] | None = None
    for q, piece in enumerate(pieces):
        if q == p:
            continue
        a, b = piece.nodes[:-1], piece.nodes[1:]
        reach = np.maximum(a[:, 3], b[:, 3])
        step = b[:, :3] - a[:, :3]
        length2 = np.maximum(np.square(step).sum(axis=1), 1e-300)
        # Nearest points of the ray and each segment: the free optimum, clamped to the segment, then the ray's.
        between = a[:, :3] - tip[:3]
        along = step @ direction
        det = np.maximum(length2 - along**2, 1e-12 * length2)
        u = np.clip(((between @ direction) * along - (between * step).sum(axis=1)) / det, 0.0, 1.0)
        s = np.clip((between + u[:, None] * step) @ direction, -reach, 1.5 * reach + tip[3])
        u = np.clip(((s[:, None] * direction - between) * step).sum(axis=1) / length2, 0.0, 1.0)
        gaps = np.linalg.norm(between + u[:, None] * step - s[:, None] * direction, axis=1)
        k = int(np.argmin(gaps))
        if gaps[k] < _MEET * reach[k] and (best is None or gaps[k] < best[0]):
            best = (float(gaps[k]), q, a[k, :3] + u[k] * step[k])
    return None if best is None else best[1:]


def point_on_middle(piece: Piece, point: Floats) -> Floats | None:
    """The point of a run that is nearest to another point, if that lies near its line and away from its ends."""
    step = np.diff(piece.nodes[:, :3], axis=0)
    offset = point - piece.nodes[:-1, :3]
    u = np.clip((offset * step).sum(axis=1) / np.maximum(np.square(step).sum(axis=1), 1e-300), 0.0, 1.0)
    near = piece.nodes[:-1, :3] + u[:, None] * step
    gaps = np.linalg.norm(near - point, axis=1)
    k = int(np.argmin(gaps))
    radius = float(piece.nodes[k, 3])
    away = min(float(np.linalg.norm(near[k] - piece.tip(e)[:3])) for e in (0, 1))
    if gaps[k] < _MEET * radius and (piece.closed or away > radius):
        found: Floats = near[k]
        return found
    return None


def find_crossings(pieces: list[Piece]) -> list[tuple[int, int, Floats]]:
    """Pairs of pieces that run through each other, and where: a cross fitting."""
    found = []
    for q, second in enumerate(pieces):
        for p, first in enumerate(pieces[:q]):
            inner, outer = first.nodes[1:-1], second.nodes[1:-1]
            if not len(inner) or not len(outer):
                continue
            reach = min(float(inner[:, 3].max()), float(outer[:, 3].max()))
            if np.any(inner[:, :3].min(axis=0) - reach > outer[:, :3].max(axis=0)) or np.any(
                outer[:, :3].min(axis=0) - reach > inner[:, :3].max(axis=0)
            ):
                continue
            where = _crossing(first.nodes, second.nodes)
            if where is not None:
                found.append((p, q, where))
    return found


def _crossing(first: Floats, second: Floats) -> Floats | None:
    """The point where two runs pass through each other away from their ends, or None."""
    for k in range(len(first) - 1):
        a, d = first[k, :3], first[k + 1, :3] - first[k, :3]
        b, e = second[:-1, :3], np.diff(second[:, :3], axis=0)
        dd, ee, de = float(d @ d), np.square(e).sum(axis=1), e @ d
        det = dd * ee - de**2
        crossing = det > 0.25 * dd * ee
        safe = np.where(crossing, det, 1.0)
        between = b - a
        s = ((between @ d) * ee - (between * e).sum(axis=1) * de) / safe
        t = ((between @ d) * de - (between * e).sum(axis=1) * dd) / safe
        gap = np.linalg.norm(between + t[:, None] * e - s[:, None] * d, axis=1)
        reach = _MEET * np.minimum(first[k, 3], second[:-1, 3])
        point = a + s[:, None] * d
        hit = crossing & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1) & (gap < reach)
        for tip in (first[0], first[-1], second[0], second[-1]):
            hit &= np.linalg.norm(point - tip[:3], axis=1) > np.maximum(first[k, 3], second[:-1, 3])
        if hit.any():
            where: Floats = point[int(np.argmax(hit))]
            return where
    return None
