"""Levers: long, over the body's cap on one side; they turn about the axis through that cap's middle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.model.scene import Floats
from cadgraph.stages.mechanisms.body import Body, Frame, frame_of, join, middle_of, unit_vector
from cadgraph.stages.mechanisms.valve import Valve

__all__ = ["Lever", "find_lever"]

# A lever is long against its width, and no higher than this share of its length; one that is called so less clearly.
_SLENDER, _CALLED_SLENDER, _HIGH = 2.2, 1.2, 0.55
_LEAST, _MOST = 0.03, 1.6  # m; lengths of levers
# It is lower along the axis that it turns about than this share of its length, and on one side of it by this one.
_LIES, _ASIDE = 0.75, 0.12
# Flat faces are of the cap or of the lever's underside where they look along its axis (cosine), within this of it.
_FLAT, _SNAP = 0.985, 0.82
_NEAR = 25.0  # degrees from the first guess of an axis, beyond which flat faces count little
_FACES = 0.03  # of its surface, so that flat faces say which way its axis is
_PASSES = 0.35  # of its length, by which the axis of a lever may pass the middle of the valve
_OUT = 0.005  # m; from the line to where a lever touches the body, at the least
_MOST_WAYS = 16  # that flat faces look, of which the best is taken
_TOUCH = 0.003  # m; around the closest points, what touches a lever
_TOP = 0.6  # of the height of a valve over its line; levers are above it
_CALLED = "lever"


@dataclass(frozen=True, eq=False)
class Lever:
    """A lever.

    Args:
        body: what turns.
        frame: its axis, out of the valve, its origin at the lever's height.
        way: ``(3,)`` unit vector from the axis to its end.
        length: from the axis to its end [m].
        thickness: half its width where it is gripped [m].
        sources: how axis and pivot were found.
    """

    body: Body
    frame: Frame
    way: Floats
    length: float
    thickness: float
    sources: dict[str, str]


def find_lever(valve: Valve, bodies: Sequence[Body], pieces: Sequence[Body]) -> Lever | None:
    """The lever of a valve among some bodies.

    Args:
        valve: whole.
        bodies: that may be one.
        pieces: of all its meshes that are in several.
    """
    best: tuple[tuple[bool, float], Lever] | None = None
    for body in bodies:
        called = _CALLED in body.names and not body.pieces
        if not _is_long(body, called):
            continue
        still = [one for one in valve.others(body, pieces) if _CALLED not in one.names or one.pieces]
        lever = _lever(body, valve, still)
        if lever is None or not (called or _stands_out(lever, valve, still)):
            continue
        rank = called, lever.length
        if best is None or rank > best[0]:
            best = rank, lever
    if best is None:
        return None
    return _whole(best[1], [body for body in bodies if bool(body.pieces) == bool(best[1].body.pieces)])


def _is_long(body: Body, called: bool) -> bool:
    high, wide, long = np.sort(body.extents).tolist()
    if not _LEAST <= long <= _MOST:
        return False
    return bool(long >= (_CALLED_SLENDER if called else _SLENDER) * wide and high <= _HIGH * long)


def _lever(body: Body, valve: Valve, still: Sequence[Body]) -> Lever | None:
    """A body as a lever, with the axis that it would turn about."""
    if not still:
        return None
    touched = _touched(body, np.concatenate([one.dense for one in still]))
    found = _axis(body, valve, touched, still)
    if found is None:
        return None
    axis, source = found
    long = _long_way(body, axis)
    span = float(np.ptp(body.points @ long))
    if float(np.ptp(body.points @ axis)) > _LIES * span:
        return None
    pivot, how = _pivot(body, axis, touched, still)
    frame = frame_of(pivot, axis)
    middle = float(frame.height(body.center[None])[0])
    frame = frame_of(pivot + middle * axis, axis)
    way = body.center - frame.origin
    way = way - (way @ axis) * axis
    if float(np.linalg.norm(way)) < _ASIDE * span:
        # A bar or a wing, as long on both sides.
        way = long
    way = unit_vector(way)
    across = np.cross(axis, way)
    along, aside = (body.points - frame.origin) @ way, (body.points - frame.origin) @ across
    length = float(along.max())
    if length < 0.45 * span or _misses(frame, length, valve, still):
        return None
    grip = np.abs(aside[along > 0.6 * length])
    return Lever(body, frame, way, length, float(grip.max(initial=0.0)), {"axis": source, "pivot": how})


def _long_way(body: Body, axis: Floats) -> Floats:
    """``(3,)`` unit vector across an axis along which a body is longest."""
    frame = frame_of(body.center, axis)
    flat = frame.flat(body.points)
    turns = np.pi * np.arange(72) / 72
    spans = np.ptp(flat @ np.array([np.cos(turns), np.sin(turns)]), axis=0)
    best = turns[int(np.argmax(np.round(spans, 9)))]
    rough = np.array([np.cos(best), np.sin(best)]) @ frame.across
    # Of three axes square to each other, two at the least are not along this one.
    near = [one for k in range(3) if float(np.linalg.norm(one := body.axes[k] - (body.axes[k] @ axis) * axis)) > 0.5]
    # A principal axis is exact where it lies near what is longest.
    close = max(near, key=lambda one: abs(float(unit_vector(one) @ rough)))
    return unit_vector(close) if abs(float(unit_vector(close) @ rough)) > 0.96 else unit_vector(rough)


def _misses(frame: Frame, length: float, valve: Valve, still: Sequence[Body]) -> bool:
    """Whether an axis passes the body of a valve by far, as the pin of a lever that lifts something does."""
    if valve.line is not None and valve.line.straight:
        return valve.line.gap(frame.origin, frame.axis) > max(_PASSES * length, valve.line.bore)
    return float(frame.away(middle_of(still)[None])[0]) > _PASSES * length + (
        valve.line.bore if valve.line is not None else 0.0
    )


def _touched(body: Body, others: Floats) -> Floats:
    """``(3,)`` where something else touches a body, or comes nearest to it [m]."""
    points = body.dense
    for room in (_TOUCH, 10 * _TOUCH):
        low, high = points.min(axis=0) - room, points.max(axis=0) + room
        near = others[((others >= low) & (others <= high)).all(axis=1)]
        if len(near) > 8:
            others = near
            break
    gaps, _ = cKDTree(others).query(points)
    touching = points[np.asarray(gaps) <= float(np.min(gaps)) + _TOUCH]
    found: Floats = 0.5 * (touching.min(axis=0) + touching.max(axis=0))
    return found


def _axis(body: Body, valve: Valve, touched: Floats, still: Sequence[Body]) -> tuple[Floats, str] | None:
    """The axis of a stem under a lever, out of the valve; None for what lies in the valve's middle."""
    line = valve.line
    out = touched - (line.foot(touched) if line is not None and line.straight else middle_of(still))
    if float(np.linalg.norm(out)) < _OUT:
        return None
    out = unit_vector(out)
    # The flat faces of the bar and of its hub, and of what is under it, which all look the same way, of either sign.
    wide = float(np.sort(body.extents)[1])
    near = [np.linalg.norm(one.corners.mean(axis=1) - touched, axis=1) < 2.5 * wide for one in still]
    normals = np.concatenate([body.normals, *(one.normals[row] for one, row in zip(still, near, strict=True))])
    weights = np.concatenate([body.areas, *(one.areas[row] for one, row in zip(still, near, strict=True))])
    found = _flat_way(normals, weights, out, _FACES * body.area)
    return (found, "square to the lever's plane") if found is not None else (out, "from the valve to its lever")


def _flat_way(normals: Floats, areas: Floats, out: Floats, least: float) -> Floats | None:
    """The way that the largest flat faces look, those next to a guess before others; None where there are none."""
    aligned = normals @ out
    kept = np.abs(aligned) > _SNAP
    normals, areas = normals[kept] * np.sign(aligned[kept])[:, None], areas[kept]
    angle = np.degrees(np.arccos(np.minimum(np.abs(aligned[kept]), 1.0)))
    best: tuple[float, Floats] | None = None
    left = np.ones(len(normals), np.bool_)
    for _ in range(_MOST_WAYS):
        if not left.any():
            break
        seed = normals[left][int(np.argmax(areas[left]))]
        same = normals @ seed > 0.9999
        total = float(areas[same].sum())
        score = total * float(np.exp(-((float(np.average(angle[same], weights=areas[same])) / _NEAR) ** 2)))
        if total >= least and (best is None or score > best[0]):
            best = score, unit_vector(areas[same] @ normals[same])
        left &= ~same
    return best[1] if best is not None else None


def _pivot(body: Body, axis: Floats, touched: Floats, still: Sequence[Body]) -> tuple[Floats, str]:
    """The middle of the cap under a lever; where there is none, of what touches it."""
    frame = frame_of(touched, axis)
    wide = float(np.sort(body.extents)[1])
    best: tuple[float, Floats] | None = None
    for one in still:
        near_it = np.abs(one.corners[:, 0] - touched).max(axis=1) < 4 * wide
        looks = near_it & (np.abs(one.normals @ axis) > _FLAT) if near_it.any() else near_it
        if not looks.any():
            continue
        corners = one.corners[looks]
        height = frame.height(corners.reshape(-1, 3)).reshape(-1, 3).mean(axis=1)
        near = frame.away(corners.mean(axis=1)) < 2 * wide
        for level in np.unique(np.round(height[near], 4)).tolist():
            same = near & (np.abs(height - level) < 2e-4)
            area = one.areas[looks][same]
            spots = corners[same].reshape(-1, 3)
            flat = frame.flat(spots)
            middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
            mean = area @ frame.flat(corners[same].mean(axis=1)) / max(float(area.sum()), 1e-15)
            # A cap is as wide on all sides of its middle, so its corners' and its surface's middles agree.
            if float(np.linalg.norm(middle - mean)) > 0.25 * wide or float(np.linalg.norm(mean)) > 0.75 * wide:
                continue
            off = abs(level) + float(np.linalg.norm(mean))
            if best is None or off < best[0]:
                best = off, mean
    if best is None:
        return touched, "where it touches the body"
    return touched + best[1] @ frame.across, "middle of the body's cap under the lever"


def _stands_out(lever: Lever, valve: Valve, still: Sequence[Body]) -> bool:
    """Whether something long stands over a valve as a lever does, by its shape alone."""
    frame, line = lever.frame, valve.line
    zero = frame.height((line.foot(frame.origin) if line is not None else valve.middle)[None])[0]
    top = max(float(frame.height(one.points).max()) for one in still)
    own = frame.height(lever.body.points)
    if float(own.mean()) - zero < _TOP * (max(top, float(own.max())) - zero):
        return False
    points = np.concatenate([one.dense for one in still])
    carrier = frame.away(points[frame.height(points) > float(own.min())])
    aside = float(np.linalg.norm(lever.body.center - frame.origin))
    reach = max(line.bore if line is not None else 0.0, float(carrier.max(initial=0.0)))
    return aside > _ASIDE * lever.length and lever.length > 1.3 * reach


def _whole(lever: Lever, bodies: Sequence[Body]) -> Lever:
    """A lever with what sits on it: a grip, a knob."""
    low, high = lever.body.points.min(axis=0), lever.body.points.max(axis=0)
    room = 0.6 * lever.thickness + 0.002
    across = np.cross(lever.frame.axis, lever.way)
    on = [lever.body]
    for body in bodies:
        if body is lever.body or not ((body.points >= low - room) & (body.points <= high + room)).all():
            continue
        along = (body.points - lever.frame.origin) @ lever.way
        aside = (body.points - lever.frame.origin) @ across
        if float(along.min()) > 0.2 * lever.length and float(np.abs(aside).max()) <= 2.5 * lever.thickness:
            on.append(body)
    return Lever(join(on), lever.frame, lever.way, lever.length, lever.thickness, lever.sources)
