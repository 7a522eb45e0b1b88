"""The line of a fitting from its mouths: the round flat faces and rims at which something joins.

Mouths are found from flat patches, which no way of cutting a shape into triangles changes; so is the line between them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline, End, Junction
from cadgraph.geometry.mesh.axis_hits import hits, in_frame
from cadgraph.model.scene import Floats
from cadgraph.model.shapes import Disc

__all__ = ["Mouth", "are_on_one_axis", "join_mouths", "mouths_of", "run_inward", "turned_outward"]

# A hole below this share of the face's radius, or above the other, is none that tells a bore.
_LEAST_BORE, _MOST_BORE = 0.15, 0.97
# Mouths are opposite each other on one axis where their normals are this parallel (cosine of 5 degrees) and their
# centres off the axis by at most this share of the lesser radius.
_PARALLEL, _OFF_AXIS = 0.996, 0.12
# They share an axis, so that one line stands for both, within this share: an eccentric reducer's do not.
_ONE_AXIS = 0.04
# A branch's axis passes the run's within this share of the run's radius: olets may sit off the middle.
_ECCENTRIC = 0.85
# Feet of branches this near to each other on a run, as share of its radius, are one: a cross.
_ONE_FOOT = 0.25
# Axes of mouths of which no two are opposite meet within this share of the least radius.
_MEET = 0.5
# Corners within this share of a face's radius from its plane are its own.
_LEVEL = 0.03
# Steps of a bend: a chord leaves the arc by less than 0.5 % of the bend's radius.
_BEND_STEP = np.radians(11.25)
# Share of the surface that must lie within this factor of the radius about the line.
_COVERED, _WITHIN = 0.9, 1.15
# A mouth is a flange's, or a socket's, where it is wider than the body by this factor; it ends within this share of
# its radius.
_RIM, _RIM_DEPTH = 1.08, 0.6
# A branch of a run may end within it where it is this wide against the run: flanges of short tees.
_LIKE_RUN = 0.9
# The middle of the surface behind an only mouth lies within this share of its radius from its axis.
_OFF_MIDDLE = 0.2
_LEAST_WAY = 1e-5  # from mouth to mouth or junction [m]
# Faces look away from the line, as those of an outer wall do (cosine).
_AWAY = 0.5


@dataclass(frozen=True)
class Mouth:
    """Where something may join a fitting.

    Args:
        point: ``(3,)`` its middle [m].
        direction: ``(3,)`` unit, outward.
        radius: of its rim [m].
        bore: radius of its hole [m], NaN where there is none.
    """

    point: Floats
    direction: Floats
    radius: float
    bore: float


def turned_outward(discs: Sequence[Disc], triangles: Floats) -> tuple[Disc, ...]:
    """Discs whose normals look away from their part, whichever way its triangles are wound.

    A face with surface before it and none behind it looks the other way; where both are, it stays. What counts is the
    surface nearest to its axis: of a steep cone of long triangles no corner lies behind the narrow face.

    Args:
        discs: round flat faces and rims of one shape.
        triangles: ``(n, 3, 3)`` of the shape [m].
    """
    corners = triangles.reshape(-1, 3)
    turned = []
    for disc in discs:
        offset = corners - disc.center
        height = offset @ disc.normal
        off = np.linalg.norm(offset - height[:, None] * disc.normal, axis=1)
        away = np.abs(height) > _LEVEL * disc.outer + 1e-5
        near = away & (off <= _WITHIN * max(disc.outer, float(off[away].min(initial=np.inf))))
        inward = bool(near.any()) and bool(np.all(height[near] > 0))
        turned.append(replace(disc, normal=-disc.normal) if inward else disc)
    return tuple(turned)


def mouths_of(ports: Sequence[Disc], triangles: Floats) -> list[Mouth]:
    """The mouths of a shape, the widest first; bolts that stand around one are none, nor are the backs of flanges.

    Args:
        ports: the outermost round faces and rims along each axis of the shape.
        triangles: ``(n, 3, 3)`` of the shape [m].
    """
    found = []
    for port in sorted(ports, key=lambda disc: (-disc.outer, *disc.center.tolist())):
        hole = _LEAST_BORE * port.outer < port.inner < _MOST_BORE * port.outer
        found.append(Mouth(port.center, port.normal, port.outer, port.inner if hole else float("nan")))
    found = _without_backs(found, triangles)
    return [mouth for mouth in found if len(found) < 4 or not _stands_around(mouth, found)]


def _without_backs(mouths: list[Mouth], triangles: Floats) -> list[Mouth]:
    """The mouths but for the backs of flanges; a lid has something on one of its faces, too, but a bend has a flange at
    both of its ends.
    """
    if len(mouths) < 4:
        return mouths
    backs = {k for k, mouth in enumerate(mouths) if _is_back(mouth, mouths, triangles)}
    return [mouth for k, mouth in enumerate(mouths) if len(backs) < 2 or k not in backs]


def _is_back(mouth: Mouth, mouths: Sequence[Mouth], triangles: Floats) -> bool:
    """Whether a face is the back of a plate whose front is a mouth: of a flange that a bend is merely stuck into."""
    fronts = [
        other
        for other in mouths
        if float(other.direction @ mouth.direction) < -_PARALLEL
        and _off_axis(mouth, other) <= _ONE_AXIS * mouth.radius
        and abs(other.radius - mouth.radius) <= _ONE_AXIS * mouth.radius
        and 0 < float((other.point - mouth.point) @ other.direction) <= _RIM_DEPTH * mouth.radius
    ]
    return bool(fronts) and _looks_at(mouth, triangles) and not any(_looks_at(front, triangles) for front in fronts)


def _looks_at(mouth: Mouth, triangles: Floats) -> bool:
    """Whether a face has surface of its own shape ahead of its middle."""
    corners = in_frame(triangles, mouth.point, mouth.direction)
    return bool((hits(corners, np.zeros(2)) > _LEVEL * mouth.radius).any())


def _stands_around(mouth: Mouth, mouths: Sequence[Mouth]) -> bool:
    """Whether a mouth is one of several beside and parallel to a wider one: a bolt's."""
    wide = mouths[0]
    if mouth.radius > 0.5 * wide.radius or abs(float(mouth.direction @ wide.direction)) < _PARALLEL:
        return False
    alike = sum(
        abs(other.radius - mouth.radius) <= 0.1 * mouth.radius
        and abs(float(other.direction @ wide.direction)) > _PARALLEL
        for other in mouths
    )
    return alike >= 3


def are_on_one_axis(mouths: Sequence[Mouth]) -> bool:
    """Whether all mouths lie on the axis of the widest one."""
    return all(_off_axis(mouths[0], mouth) <= _ONE_AXIS * mouth.radius + 1e-5 for mouth in mouths[1:])


def _off_axis(one: Mouth, other: Mouth) -> float:
    """How far the middle of a mouth is from the axis of another one [m]; infinite where they look across it."""
    if abs(float(one.direction @ other.direction)) < _PARALLEL:
        return float("inf")
    between = other.point - one.point
    return float(np.linalg.norm(between - float(between @ one.direction) * one.direction))


def run_inward(mouth: Mouth, triangles: Floats) -> Centreline | None:
    """The axis behind the only mouth of a cap, or of an olet that ends in a saddle; None where it stands to one side.

    Args:
        mouth: the only one.
        triangles: ``(n, 3, 3)`` of the shape [m].
    """
    middles, areas, _ = _measure(triangles)
    offset = triangles.reshape(-1, 3) - mouth.point
    behind = offset @ -mouth.direction
    across = offset + behind[:, None] * mouth.direction
    middle = (areas[:, None] * (middles - mouth.point)).sum(axis=0) / max(float(areas.sum()), 1e-300)
    middle += float(middle @ -mouth.direction) * mouth.direction
    radii = np.linalg.norm(across, axis=1)
    length = float(behind.max(initial=0.0))
    if not length > 0 or np.linalg.norm(middle) > _OFF_MIDDLE * mouth.radius or behind.min() < -0.1 * mouth.radius:
        return None
    far = float(radii[behind > length / 2].max(initial=0.0))
    points = np.stack([mouth.point, mouth.point - length * mouth.direction])
    branch = Branch(points, np.array([mouth.radius, far]), np.array([mouth.bore, mouth.bore]))
    ends = (
        End(points[0], mouth.direction, mouth.radius, mouth.bore, 0),
        End(points[1], -mouth.direction, far, mouth.bore, 0),
    )
    return Centreline((branch,), ends, (), 1.0)


def join_mouths(mouths: Sequence[Mouth], triangles: Floats) -> Centreline | None:
    """The line between all mouths of a fitting, or None where its surface does not run along such a line.

    Args:
        mouths: two or more.
        triangles: ``(n, 3, 3)`` of the shape [m].
    """
    if len(mouths) < 2:
        return None
    paths = _two(mouths[0], mouths[1]) if len(mouths) == 2 else _many(mouths, triangles)
    if paths is None or any(np.linalg.norm(path.points[-1] - path.points[0]) < _LEAST_WAY for path in paths):
        return None
    middles, areas, normals = _measure(triangles)
    bodies, covered = _walls(paths, mouths, middles, normals, areas)
    share = float(areas[covered].sum() / max(float(areas.sum()), 1e-300))
    return _assemble(paths, bodies, mouths, share) if share >= _COVERED else None


def _measure(triangles: Floats) -> tuple[Floats, Floats, Floats]:
    """Middle, area and unit normal of each triangle."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    return triangles.mean(axis=1), double / 2, cross / np.maximum(double, 1e-300)[:, None]


@dataclass(frozen=True)
class _Path:
    """A way along the middle.

    Args:
        points: ``(n, 3)`` [m].
        first: mouth that it starts at, -1 for a junction.
        last: mouth that it ends at, -1 for a junction.
    """

    points: Floats
    first: int
    last: int


def _two(a: Mouth, b: Mouth) -> list[_Path] | None:
    """The way from one mouth to the other: straight, an offset, a bend, or a return bend."""
    cosine = float(a.direction @ b.direction)
    if cosine < -_PARALLEL:
        ahead = float((b.point - a.point) @ a.direction)
        return [_Path(np.stack([a.point, b.point]), 0, 1)] if ahead < 0 else None
    points = _return_bend(a, b) if cosine > _PARALLEL else _bend(a, b)
    return None if points is None else [_Path(points, 0, 1)]


def _bend(a: Mouth, b: Mouth) -> Floats | None:
    """Straight, round and straight again where two axes meet inside."""
    s, t, gap = _nearest(a, b)
    if s <= 0 or t <= 0 or gap > _MEET * min(a.radius, b.radius):
        return None
    corner = (a.point - s * a.direction + b.point - t * b.direction) / 2
    # The bend takes all of the shorter leg.
    leg = min(float(np.linalg.norm(corner - a.point)), float(np.linalg.norm(corner - b.point)))
    start, stop = corner + leg * a.direction, corner + leg * b.direction
    turn = np.pi - float(np.arccos(np.clip(a.direction @ b.direction, -1, 1)))
    radius = leg / np.tan(turn / 2)
    across = b.direction - float(a.direction @ b.direction) * a.direction
    across /= np.linalg.norm(across)
    center = start + radius * across
    angles = np.linspace(0, turn, max(2, int(np.ceil(turn / _BEND_STEP))) + 1)[:, None]
    arc = center - radius * np.cos(angles) * across - radius * np.sin(angles) * a.direction
    arc[-1] = stop
    return _distinct(np.concatenate([a.point[None], arc, b.point[None]]))


def _return_bend(a: Mouth, b: Mouth) -> Floats | None:
    """Out, half around, and back where two mouths look the same way."""
    between = b.point - a.point
    ahead = float(between @ a.direction)
    across = between - ahead * a.direction
    width = float(np.linalg.norm(across))
    if width < a.radius + b.radius:
        return None
    start = a.point if ahead >= 0 else a.point + ahead * a.direction
    stop = b.point if ahead <= 0 else b.point - ahead * a.direction
    center, side = (start + stop) / 2, across / width
    angles = np.linspace(0, np.pi, int(np.ceil(np.pi / _BEND_STEP)) + 1)[:, None]
    arc = center - width / 2 * np.cos(angles) * side - width / 2 * np.sin(angles) * a.direction
    arc[0], arc[-1] = start, stop
    return _distinct(np.concatenate([a.point[None], arc, b.point[None]]))


def _distinct(points: Floats) -> Floats:
    apart = np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-7
    kept: Floats = points[np.concatenate([[True], apart])]
    return kept


def _nearest(a: Mouth, b: Mouth) -> tuple[float, float, float]:
    """How far behind two mouths their axes are nearest to each other, and how near [m]."""
    cosine = float(a.direction @ b.direction)
    between = b.point - a.point
    det = max(1 - cosine**2, 1e-12)
    s = -float(between @ (a.direction - cosine * b.direction)) / det
    t = float(between @ (b.direction - cosine * a.direction)) / det
    gap = (b.point - t * b.direction) - (a.point - s * a.direction)
    return s, t, float(np.linalg.norm(gap))


def _many(mouths: Sequence[Mouth], triangles: Floats) -> list[_Path] | None:
    """A run with its branches, or a star where no two mouths are opposite."""
    runs = [
        (min(a.radius, b.radius), float(np.linalg.norm(a.point - b.point)), -i, -j)
        for i, a in enumerate(mouths)
        for j, b in enumerate(mouths[:i])
        if _are_opposite(a, b)
    ]
    if not runs:
        return _star(mouths)
    # Of runs of about one size the longest.
    wide = max(run[0] for run in runs)
    _, _, i, j = max((run for run in runs if run[0] >= 0.9 * wide), key=lambda run: run[1:])
    return _run_with_branches(mouths, -i, -j, triangles)


def _are_opposite(a: Mouth, b: Mouth) -> bool:
    """Whether two mouths look away from each other on one axis."""
    faced = float(a.direction @ b.direction) < 0 and float((b.point - a.point) @ a.direction) < 0
    return faced and _off_axis(a, b) <= _OFF_AXIS * min(a.radius, b.radius) + 1e-4


def _star(mouths: Sequence[Mouth]) -> list[_Path] | None:
    """Ways from all mouths to the point where their axes meet."""
    matrix, right = 1e-9 * np.eye(3), 1e-9 * np.mean([mouth.point for mouth in mouths], axis=0)
    for mouth in mouths:
        across = np.eye(3) - np.outer(mouth.direction, mouth.direction)
        matrix, right = matrix + across, right + across @ mouth.point
    middle = np.linalg.solve(matrix, right)
    for mouth in mouths:
        offset = mouth.point - middle
        ahead = float(offset @ mouth.direction)
        off = float(np.linalg.norm(offset - ahead * mouth.direction))
        if ahead <= 0 or off > _MEET * min(other.radius for other in mouths):
            return None
    return [_Path(np.stack([mouth.point, middle]), k, -1) for k, mouth in enumerate(mouths)]


def _run_with_branches(mouths: Sequence[Mouth], first: int, last: int, triangles: Floats) -> list[_Path] | None:
    a, b = mouths[first], mouths[last]
    length = float(np.linalg.norm(b.point - a.point))
    along = (b.point - a.point) / length
    feet = []
    for k, mouth in enumerate(mouths):
        if k in (first, last) or (_is_within(mouth, a, b) and not _is_flanged(mouth, a, b, triangles)):
            continue
        foot = _foot(mouth, a.point, along, length, max(a.radius, b.radius))
        if foot is None:
            return None
        feet.append((foot, k))
    merged = _merged_feet(feet, _ONE_FOOT * min(a.radius, b.radius))
    stops = [a.point, *(a.point + foot * along for foot, _ in merged), b.point]
    names = [first, *([-1] * len(merged)), last]
    paths = [_Path(np.stack([p, q]), m, n) for p, q, m, n in zip(stops, stops[1:], names, names[1:], strict=False)]
    return paths + [
        _Path(np.stack([mouths[k].point, stop]), k, -1)
        for stop, (_, members) in zip(stops[1:-1], merged, strict=True)
        for k in members
    ]


def _merged_feet(feet: Sequence[tuple[float, int]], reach: float) -> list[tuple[float, list[int]]]:
    """The places of branches along a run with the mouths at each; what is within reach of the first is one [m]."""
    merged: list[tuple[float, list[int]]] = []
    for foot, k in sorted(feet):
        if merged and foot - merged[-1][0] <= reach:
            merged[-1][1].append(k)
        else:
            merged.append((foot, [k]))
    return merged


def _is_within(mouth: Mouth, a: Mouth, b: Mouth) -> bool:
    """Whether a face lies within the run between two mouths: the inner end of a branch that was merely stuck in."""
    length = float(np.linalg.norm(b.point - a.point))
    along = (b.point - a.point) / length
    s = float((mouth.point - a.point) @ along)
    off = float(np.linalg.norm(mouth.point - a.point - s * along))
    inner = min(a.radius, b.radius)
    return bool(_LEVEL * inner < s < length - _LEVEL * inner and off < (1 - _LEVEL) * inner)


def _is_flanged(mouth: Mouth, a: Mouth, b: Mouth, triangles: Floats) -> bool:
    """Whether a face within a run is the flange of a branch as short as the flanges of the run are wide."""
    return mouth.radius >= _LIKE_RUN * min(a.radius, b.radius) and not _looks_at(mouth, triangles)


def _foot(mouth: Mouth, start: Floats, along: Floats, length: float, radius: float) -> float | None:
    """How far along a run a branch's axis meets it [m], or None."""
    cosine = float(mouth.direction @ along)
    if abs(cosine) > 0.95:
        return None
    between = mouth.point - start
    det = 1 - cosine**2
    t = float(between @ (mouth.direction - cosine * along)) / det
    s = float(between @ (along - cosine * mouth.direction)) / det
    gap = float(np.linalg.norm(between - t * mouth.direction - s * along))
    return s if t > 0 and 0 < s < length and gap <= _ECCENTRIC * radius else None


def _walls(
    paths: Sequence[_Path], mouths: Sequence[Mouth], middles: Floats, normals: Floats, areas: Floats
) -> tuple[list[float], np.typing.NDArray[np.bool_]]:
    """The outer radius of the body along each way [m], and which triangles lie within the walls."""
    bodies, covered = [], np.zeros(len(middles), np.bool_)
    distances, directions = zip(*(_apart(path.points, middles) for path in paths), strict=True)
    nearest = np.argmin(np.stack(distances), axis=0)
    for k, (path, distance, direction) in enumerate(zip(paths, distances, directions, strict=True)):
        ends = [mouths[m].radius for m in (path.first, path.last) if m >= 0]
        widest = max(ends, default=max(mouth.radius for mouth in mouths))
        mine = (nearest == k) & (np.einsum("ij,ij->i", normals, direction) > _AWAY) & (distance <= _WITHIN * widest)
        body = _weighted_median(distance[mine], areas[mine]) if mine.any() else widest
        # A face's middle lies within the circle through its corners; at six sides by a seventh.
        body = widest if body * _RIM > 0.86 * widest else body
        bodies.append(body)
        covered |= distance <= _WITHIN * max(body, widest)
    return bodies, covered


def _apart(points: Floats, where: Floats) -> tuple[Floats, Floats]:
    """Distance of some points from a polyline, and the unit direction away from it."""
    best = np.full(len(where), np.inf)
    away = np.zeros_like(where)
    for p, q in zip(points[:-1], points[1:], strict=True):
        step = q - p
        u = np.clip((where - p) @ step / max(float(step @ step), 1e-300), 0, 1)
        offset = where - p - u[:, None] * step
        distance = np.linalg.norm(offset, axis=1)
        nearer = distance < best
        best[nearer] = distance[nearer]
        away[nearer] = offset[nearer] / np.maximum(distance[nearer], 1e-300)[:, None]
    return best, away


def _weighted_median(values: Floats, weights: Floats) -> float:
    order = np.argsort(values, kind="stable")
    total = np.cumsum(weights[order])
    return float(values[order][int(np.searchsorted(total, total[-1] / 2))])


def _assemble(paths: Sequence[_Path], bodies: Sequence[float], mouths: Sequence[Mouth], share: float) -> Centreline:
    branches, ends = [], []
    meeting: dict[bytes, list[int]] = {}
    where: dict[bytes, Floats] = {}
    for k, (path, body) in enumerate(zip(paths, bodies, strict=True)):
        branches.append(_branch(path, body, mouths))
        for m, point in ((path.first, path.points[0]), (path.last, path.points[-1])):
            if m < 0:
                key = (np.round(point, 9) + 0.0).tobytes()
                meeting.setdefault(key, []).append(k)
                where[key] = point
            else:
                one = mouths[m]
                ends.append(End(one.point, one.direction, one.radius, one.bore, k))
    junctions = tuple(Junction(where[key], tuple(members)) for key, members in meeting.items())
    return Centreline(tuple(branches), tuple(ends), junctions, share)


def _branch(path: _Path, body: float, mouths: Sequence[Mouth]) -> Branch:
    """A way with its radius: at its mouths theirs, between them the body's."""
    first, last = (mouths[m] if m >= 0 else None for m in (path.first, path.last))
    start, stop = _radii(first, last, body)
    points, n = path.points, len(path.points)
    walked = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    share = walked / walked[-1]
    bore = np.full(n, np.nan)
    known = [mouth.bore for mouth in (first, last) if mouth is not None]
    if known and np.all(np.isfinite(known)):
        bore = known[0] + share * (known[-1] - known[0])
    radius = start + share * (stop - start)
    if min(start, stop) > _RIM * body / 0.86:
        return _flanged(points, walked, radius, bore, body)
    return Branch(points.copy(), radius, bore)


def _radii(first: Mouth | None, last: Mouth | None, body: float) -> tuple[float, float]:
    """The radii of a way at both ends [m]; at a junction (None) the body's, or that of its mouth if it is less."""
    if first is None:
        return (body, body) if last is None else (min(body, last.radius), last.radius)
    if last is not None:
        return first.radius, last.radius
    return first.radius, first.radius if first.radius <= _RIM * body else min(body, first.radius)


def _flanged(points: Floats, walked: Floats, radius: Floats, bore: Floats, body: float) -> Branch:
    """A way whose ends are wider than its body: flanges or sockets.

    Args:
        points: ``(n, 3)`` [m].
        walked: ``(n,)`` length up to each [m].
        radius: ``(n,)`` as if there were no body [m].
        bore: ``(n,)`` [m], NaN where there is none.
        body: radius of the body [m].
    """
    length = float(walked[-1])
    cuts = [min(_RIM_DEPTH * radius[0], 0.25 * length), length - min(_RIM_DEPTH * radius[-1], 0.25 * length)]
    inner = [s for s in walked.tolist() if cuts[0] < s < cuts[1]]
    stops = np.array([0.0, cuts[0], *inner, cuts[1], length])
    placed = np.stack([np.interp(stops, walked, points[:, c]) for c in range(3)], axis=1)
    wide = np.full(len(stops), body)
    wide[0], wide[-1] = radius[0], radius[-1]
    return Branch(placed, wide, np.interp(stops, walked, bore))
