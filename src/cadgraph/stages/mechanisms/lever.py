"""Levers: long, over the body's cap on one side; they turn about the axis through that cap's middle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.model.scene import Floats
from cadgraph.stages.mechanisms.body import Body, Frame, frame_of, join, unit_vector
from cadgraph.stages.mechanisms.valve import Valve

__all__ = ["Lever", "find_lever"]

# A lever is long against its width, and no higher than this share of its length; one that is called so less clearly.
_SLENDER, _CALLED_SLENDER, _HIGH = 2.2, 1.2, 0.55
_LEAST, _MOST = 0.03, 1.6  # m; lengths of levers
# It lies across the axis that it turns about (sine), on one side of it by this share of its length.
_LIES, _ASIDE = 0.45, 0.12
# Flat faces are of the cap or of the lever's underside where they look along its axis (cosine), within this of it.
_FLAT, _SNAP = 0.985, 0.97
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
    axis, source = _axis(body, valve, touched)
    if abs(float(axis @ body.axes[2])) > _LIES:
        return None
    pivot, how = _pivot(body, axis, touched, still)
    frame = frame_of(pivot, axis)
    middle = float(frame.height(body.center[None])[0])
    frame = frame_of(pivot + middle * axis, axis)
    way = body.center - frame.origin
    way = way - (way @ axis) * axis
    if float(np.linalg.norm(way)) < _ASIDE * float(body.extents.max()):
        # A bar or a wing, as long on both sides.
        way = body.axes[2] - (body.axes[2] @ axis) * axis
    way = unit_vector(way)
    across = np.cross(axis, way)
    along, aside = (body.points - frame.origin) @ way, (body.points - frame.origin) @ across
    length = float(along.max())
    if length < 0.5 * float(body.extents.max()):
        return None
    grip = np.abs(aside[along > 0.6 * length])
    return Lever(body, frame, way, length, float(grip.max(initial=0.0)), {"axis": source, "pivot": how})


def _touched(body: Body, others: Floats) -> Floats:
    """``(3,)`` where something else touches a body, or comes nearest to it [m]."""
    points = body.dense
    gaps, _ = cKDTree(others).query(points)
    near = points[gaps <= float(gaps.min()) + _TOUCH]
    found: Floats = 0.5 * (near.min(axis=0) + near.max(axis=0))
    return found


def _axis(body: Body, valve: Valve, touched: Floats) -> tuple[Floats, str]:
    """The axis of a stem under a lever, out of the valve."""
    line = valve.line
    out = touched - (line.foot(touched) if line is not None else valve.middle)
    guess = body.axes[0] if abs(float(body.axes[0] @ out)) > 0.5 * float(np.linalg.norm(out)) else unit_vector(out)
    if line is not None and line.straight:
        # The stem of a quarter turn is square to the line.
        square = guess - (guess @ line.way) * line.way
        guess = unit_vector(square) if float(np.linalg.norm(square)) > 0.5 else unit_vector(out)
    if float(guess @ out) < 0:
        guess = -guess
    flat = np.abs(body.normals @ guess) > _SNAP
    if not flat.any():
        return guess, "from the line to where it touches the body"
    # The flat faces of the bar, the largest first: those that look the same way, of either sign.
    seed = body.normals[flat][int(np.argmax(body.areas[flat]))]
    same = np.abs(body.normals @ seed) > 0.9999
    turned = body.normals[same] * np.sign(body.normals[same] @ guess)[:, None]
    mean = unit_vector(body.areas[same] @ turned)
    if float(body.areas[same].sum()) < 0.1 * body.area:
        return guess, "from the line to where it touches the body"
    return mean, "square to the lever's plane"


def _pivot(body: Body, axis: Floats, touched: Floats, still: Sequence[Body]) -> tuple[Floats, str]:
    """The middle of the cap under a lever; where there is none, of what touches it."""
    frame = frame_of(touched, axis)
    wide = float(np.sort(body.extents)[1])
    best: tuple[float, Floats] | None = None
    for one in still:
        looks = np.abs(one.normals @ axis) > _FLAT
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
