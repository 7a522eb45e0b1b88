"""The line along the middle of a tube: straight, bent or branched, with the radius along it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.geometry.line.sweep import essential_nodes, trace_pieces
from cadgraph.geometry.mesh.properties import DEGENERATE_RATIO
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Floats, Scene

__all__ = ["Branch", "Centreline", "End", "Junction", "NotTube", "trace_centrelines"]

# Least share of the surface that must run along tubes. Ours: an equal tee with a thick collar keeps 0.8.
MIN_SHARE = 0.7
# Least share of the length along which the radius changes by less than so much for each unit of length: a reducer
# tapers by up to 0.6, a sphere by more over half of its length.
MIN_STEADY_SHARE = 0.6
MAX_TAPER = 0.6
# Two ends meet where their axes pass each other within this share of the lesser radius, ...
_MEET = 0.5
# ... at most so many radii ahead, and unless they point the same way (cosine).
_MAX_REACH = 3.0
_PARALLEL = 0.8
# Joints this close, as share of the lesser radius, are one.
_SAME_JOINT = 0.25
# Nodes this close to the line between their neighbours, as share of the radius, say nothing.
_STRAIGHT = 1e-3


@dataclass(frozen=True)
class Branch:
    """One run of a centreline between ends or junctions.

    Args:
        points: ``(n, 3)`` [m]; the first equals the last where ``closed``.
        radius: ``(n,)`` outer radius, of the circle through the corners of the section [m].
        bore: ``(n,)`` radius of the inner wall [m], NaN where there is none.
        closed: whether it returns to its start, as the rim of a handwheel does.
    """

    points: Floats
    radius: Floats
    bore: Floats
    closed: bool = False

    @property
    def length(self) -> float:
        """Length along the line [m]."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())


@dataclass(frozen=True)
class End:
    """A free end of a centreline.

    Args:
        point: ``(3,)`` [m].
        direction: ``(3,)`` unit vector outward.
        radius: outer radius [m].
        bore: radius of the inner wall [m], NaN where there is none.
        branch: index of its branch.
    """

    point: Floats
    direction: Floats
    radius: float
    bore: float
    branch: int


@dataclass(frozen=True)
class Junction:
    """A point where three or more branches meet.

    Args:
        point: ``(3,)`` [m].
        branches: indices of the branches that start or end there; one that does both is named twice.
    """

    point: Floats
    branches: tuple[int, ...]


@dataclass(frozen=True)
class Centreline:
    """The centreline of a tube-like part.

    Args:
        branches: at least one.
        ends: the free ends, by branch.
        junctions: where branches meet.
        share: share of the surface that runs along the branches, 0..1.
    """

    branches: tuple[Branch, ...]
    ends: tuple[End, ...]
    junctions: tuple[Junction, ...]
    share: float

    @property
    def length(self) -> float:
        """Length of all branches [m]."""
        return sum(branch.length for branch in self.branches)


@dataclass(frozen=True)
class NotTube:
    """Why a part has no centreline.

    Args:
        reason: one line for people.
        share: share of the surface that runs along tubes, 0..1.
    """

    reason: str
    share: float = 0.0


def trace_centrelines(
    scene: Scene, properties: Properties, workers: int | None = None
) -> tuple[Centreline | NotTube, ...]:
    """Finds the centreline of each mesh that is a tube.

    Planes are swept along the tube, each perpendicular to its wall and centred on it, so neither open ends, caps,
    soup nor triangles that span the whole length matter. A wall may turn by 35 degrees from one section to the next;
    where it turns more sharply (mitres), or other tubes join, the pieces are put together by where their axes meet.

    Args:
        scene: any.
        properties: of its meshes.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        One result for each mesh.
    """
    results: list[Centreline | NotTube] = [NotTube("it has no area")] * scene.n_meshes

    def trace(first: int, last: int) -> None:
        for i in range(first, last):
            if properties.area[i] > 0:
                results[i] = _trace_mesh(scene, i, float(properties.obb_extents[i, 0]), bool(properties.volume[i] < 0))

    for_ranges(trace, np.diff(scene.face_offsets), workers)
    return tuple(results)


def _trace_mesh(scene: Scene, index: int, size: float, inward: bool) -> Centreline | NotTube:
    vertices, faces = scene.mesh(index)
    inside = np.all((faces >= 0) & (faces < len(vertices)), axis=1)
    corners = vertices[faces[inside]]
    corners = corners[np.isfinite(corners).all(axis=(1, 2))]
    sides = corners[:, [1, 2, 0]] - corners
    double = np.cross(sides[:, 0], -sides[:, 2])
    if inward:
        double = -double
    area = np.linalg.norm(double, axis=1)
    real = area > DEGENERATE_RATIO * np.square(sides).sum(axis=2).max(axis=1, initial=0.0)
    # Near the origin, so that far-out parts lose no digits.
    origin = corners[0, 0].copy()
    nodes, starts, ends, share = trace_pieces(
        np.ascontiguousarray((corners[real] - origin).reshape(-1, 9)),
        np.ascontiguousarray(double[real] / area[real, None]),
        np.ascontiguousarray(area[real] / 2),
        size,
    )
    if len(starts) == 1:
        return NotTube("no section of it is round")
    nodes[:, :3] += origin
    pieces = [_Piece.of(nodes[a:b], end) for a, b, end in zip(starts[:-1], starts[1:], ends, strict=True)]
    if share < MIN_SHARE:
        return NotTube(f"only {share:.0%} of its surface runs along tubes", share)
    if _steady_share(pieces) < MIN_STEADY_SHARE:
        return NotTube("its radius changes along most of its length", share)
    return _stitch(pieces, share)


@dataclass
class _Piece:
    """One run as swept, with the directions outward at both ends and how far beyond the last section these lie."""

    nodes: Floats
    outward: Floats
    extension: Floats
    closed: bool

    @classmethod
    def of(cls, nodes: Floats, ends: Floats) -> _Piece:
        closed = bool(np.isnan(ends[0, 0]))
        outward = np.stack([-nodes[0, 6:9], nodes[-1, 6:9]])
        if not closed:
            for e, order in enumerate((nodes, nodes[::-1])):
                # In a bend, the plane in which the wall ends tells the direction there better than its last section.
                away = np.linalg.norm(order[:, :3] - order[0, :3], axis=1)
                back = order[min(int(np.searchsorted(away, 2 * order[0, 3])), len(order) - 1)]
                bends = abs(float(back[6:9] @ order[0, 6:9])) < 1 - 4e-5
                if bends and abs(float(ends[e, 1:] @ outward[e])) > 0.9:
                    outward[e] = ends[e, 1:] / np.linalg.norm(ends[e, 1:])
        return cls(nodes, outward, ends[:, 0], closed)

    def tip(self, end: int) -> Floats:
        node: Floats = self.nodes[-1 if end else 0]
        return node


def _steady_share(pieces: Sequence[_Piece]) -> float:
    steady = total = 0.0
    for piece in pieces:
        steps = np.linalg.norm(np.diff(piece.nodes[:, :3], axis=0), axis=1)
        # The followed radius may jump where a solid pipe meets its flange; that is a point, not a taper.
        taper = np.abs(np.diff(piece.nodes[:, 5]))
        steady += float(steps[taper <= MAX_TAPER * steps].sum())
        total += float(steps.sum())
    return steady / total if total > 0 else 0.0


def _stitch(pieces: list[_Piece], share: float) -> Centreline:
    """Puts pieces together where their axes meet, and cuts them where others branch off."""
    open_ends = [(p, e) for p, piece in enumerate(pieces) if not piece.closed for e in (0, 1)]
    targets: dict[tuple[int, int], Floats] = {}
    cuts: list[tuple[int, Floats]] = []
    # A loop is cut where it was begun, so whatever comes near there joins there.
    known = [piece.nodes[0, :3] + 0.0 for piece in pieces if piece.closed]
    for group in _meeting_ends(pieces, open_ends):
        tips = [pieces[p].tip(e) for p, e in group]
        where = _common_point([tip[:3] for tip in tips], [pieces[p].outward[e] for p, e in group])
        others = set(range(len(pieces))) - {p for p, _ in group}
        through = [(q, near) for q in sorted(others) if (near := _on_middle(pieces[q], where)) is not None]
        # Two branches that face each other across a run do not make one: all meet in its middle.
        where = _snap(through[0][1] if through else where, min(float(tip[3]) for tip in tips), known)
        cuts += [(q, where) for q, _ in through]
        targets.update(dict.fromkeys(group, where))
    for p, e in open_ends:
        tap = None if (p, e) in targets else _tap(pieces, p, e)
        if tap is not None:
            targets[p, e] = _snap(tap[1], float(pieces[p].tip(e)[3]), known)
            cuts.append((tap[0], targets[p, e]))
    for q, r, where in _crossings(pieces):
        point = _snap(where, min(float(pieces[k].tip(0)[3]) for k in (q, r)), known)
        cuts += [(q, point), (r, point)]
    runs: list[Floats] = []
    joints: dict[bytes, list[int]] = {}
    free: list[tuple[int, int, int]] = []
    for p, piece in enumerate(pieces):
        nodes = piece.nodes[:, :6] + 0.0
        for e, row in ((0, 0), (1, -1)):
            if (p, e) in targets:
                nodes = _retarget(nodes, row, targets[p, e])
        own = {where.tobytes(): where for q, where in cuts if q == p}
        parts = _split(nodes, list(own.values()))
        for k, part in enumerate(parts):
            for e, row in ((0, 0), (1, -1)):
                at_piece_end = (k == 0 and e == 0) or (k == len(parts) - 1 and e == 1)
                if at_piece_end and (p, e) not in targets and not piece.closed:
                    free.append((p, e, len(runs)))
                    continue
                if not piece.closed or len(parts) > 1 or own:
                    joints.setdefault(part[row, :3].tobytes(), []).append(len(runs))
            runs.append(part)
    return _assemble(pieces, runs, joints, free, share)


def _snap(point: Floats, radius: float, known: list[Floats]) -> Floats:
    """The joint that is already there, or a new one: tubes that reach one place do so with rounding."""
    for joint in known:
        if np.linalg.norm(joint - point) <= _SAME_JOINT * radius:
            return joint
    # -0.0 would make another key.
    known.append(point + 0.0)
    return known[-1]


def _meeting_ends(pieces: list[_Piece], open_ends: list[tuple[int, int]]) -> list[list[tuple[int, int]]]:
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


def _ends_meet(a: _Piece, end_a: int, b: _Piece, end_b: int) -> bool:
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


def _common_point(tips: list[Floats], directions: list[Floats]) -> Floats:
    """The point nearest to all axes, and among those on parallel axes the one nearest to the tips."""
    matrix, right = 1e-6 * np.eye(3), 1e-6 * np.mean(tips, axis=0)
    for tip, direction in zip(tips, directions, strict=True):
        across = (np.eye(3) - np.outer(direction, direction)) / len(tips)
        matrix = matrix + across
        right = right + across @ tip
    return np.asarray(np.linalg.solve(matrix, right), np.float64)


def _tap(pieces: list[_Piece], p: int, e: int) -> tuple[int, Floats] | None:
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


def _on_middle(piece: _Piece, point: Floats) -> Floats | None:
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


def _crossings(pieces: list[_Piece]) -> list[tuple[int, int, Floats]]:
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


def _retarget(nodes: Floats, row: int, target: Floats) -> Floats:
    """Lets a run end in a point: its nodes beyond that point go, and the point comes."""
    inner = nodes if row == 0 else nodes[::-1]
    heading = inner[0, :3] - inner[min(2, len(inner) - 1), :3]
    keep = (inner[:, :3] - target) @ heading < 0
    first = int(np.argmax(keep)) if keep.any() else len(inner) - 1
    tip = inner[first].copy()
    tip[:3] = target
    inner = np.concatenate([tip[None], inner[first:]])
    return inner if row == 0 else inner[::-1]


def _split(nodes: Floats, cuts: list[Floats]) -> list[Floats]:
    """Cuts a run at points on it."""
    if not cuts:
        return [nodes]
    steps = np.linalg.norm(np.diff(nodes[:, :3], axis=0), axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    places = []
    for where in cuts:
        offset = where - nodes[:-1, :3]
        u = np.clip((offset * np.diff(nodes[:, :3], axis=0)).sum(axis=1) / np.maximum(steps**2, 1e-300), 0, 1)
        gaps = np.linalg.norm(offset - u[:, None] * np.diff(nodes[:, :3], axis=0), axis=1)
        k = int(np.argmin(gaps))
        places.append((float(walked[k] + u[k] * steps[k]), k, tuple(where)))
    parts, begin = [], nodes[:1]
    at = 1
    for place_on, k, place in sorted(places):
        if place_on <= 0.0 or place_on >= walked[-1]:
            continue
        joint = nodes[k].copy()
        joint[:3] = place
        parts.append(np.concatenate([begin, nodes[at : k + 1], joint[None]]))
        begin, at = joint[None], max(at, k + 1)
    parts.append(np.concatenate([begin, nodes[at:]]))
    return parts


def _assemble(
    pieces: list[_Piece],
    runs: list[Floats],
    joints: dict[bytes, list[int]],
    free: list[tuple[int, int, int]],
    share: float,
) -> Centreline:
    """Joins runs that meet two and two into branches, and makes junctions of the rest."""
    closed = [False] * len(runs)
    for p, piece in enumerate(pieces):
        if piece.closed and len(pieces) == len(runs):
            closed[p] = True
    final = list(range(len(runs)))
    junction_runs: list[tuple[Floats, list[int]]] = []
    for key, members in joints.items():
        point = np.frombuffer(key)
        a, b = (final[members[0]], final[members[1]]) if len(members) == 2 else (0, 0)
        if len(members) == 2 and a != b:
            first = runs[a] if np.array_equal(runs[a][-1, :3], point) else runs[a][::-1]
            second = runs[b] if np.array_equal(runs[b][0, :3], point) else runs[b][::-1]
            runs[a] = np.concatenate([first, second[1:]])
            final = [a if f == b else f for f in final]
        elif len(members) == 2:
            closed[a] = True
        elif len(members) > 2:
            junction_runs.append((point.copy(), members))
    kept = sorted(set(final))
    number = {run: k for k, run in enumerate(kept)}
    branches = tuple(_branch(runs[k], closed[k]) for k in kept)
    ends = tuple(
        End(tip[:3].copy(), pieces[p].outward[e], float(tip[3]), float(tip[4]), number[final[run]])
        for p, e, run in free
        for tip in [pieces[p].tip(e)]
    )
    junctions = tuple(
        Junction(point, tuple(sorted(number[final[run]] for run in members))) for point, members in junction_runs
    )
    return Centreline(branches, tuple(sorted(ends, key=lambda end: end.branch)), junctions, float(share))


def _branch(nodes: Floats, closed: bool) -> Branch:
    nodes = nodes[essential_nodes(np.ascontiguousarray(nodes[:, :5]), _STRAIGHT)]
    return Branch(nodes[:, :3].copy(), nodes[:, 3].copy(), nodes[:, 4].copy(), closed)
