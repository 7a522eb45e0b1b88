"""Handwheels: round, flat, far out on a stem; they turn about the axis across which their moments are equal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.model.scene import Floats, Ints
from cadgraph.stages.mechanisms.body import Body, Frame, frame_of, join, unit_vector
from cadgraph.stages.mechanisms.valve import Valve

__all__ = ["Wheel", "find_wheel", "is_geared"]

# Two moments are equal within this share; those of a wheel with a grip within the second, where its rim says the rest.
_EQUAL, _NEARLY = 0.01, 0.3
# A wheel is flat: no higher than this share of its width; one that is called so, this one (a knob is high).
_FLAT, _KNOB = 0.32, 0.8
# It is round: all around it reaches at least this far (cosine of half the angle between eight corners, and waves).
_ROUND = 0.86
# It is open between hub and rim where at most this share of circles there is covered.
_OPEN = 0.62
_BETWEEN = (0.45, 0.55, 0.65)
# Nothing that lies farther out is wider than this share of it, and nothing right below it than this.
_ABOVE, _BELOW = 0.6, 0.85
# On the axis of a straight line it is a flange or a ring.
_COAXIAL = 0.9
# A disc that nothing calls a wheel is as wide as this share of the bore, no higher than this share of its radius, and
# what is below it is narrower than this share of it.
_DISC_WIDE, _DISC_FLAT, _DISC_BELOW = 0.9, 0.45, 0.5
# Of a wheel that is one surface with its shaft, all that lies farther out than this share of its radius is its rim.
_HUB = 0.62
# What is part of it reaches no farther out, is no higher than this share of its radius, and overlaps it by this share.
_WITHIN, _SHORT, _OVERLAP = 1.03, 0.7, 0.2
# It sits beside the stem where its axis passes the line by this share of its radius, and by this much [m].
_BESIDE, _BESIDE_AT_LEAST = 0.35, 0.015
_LEAST, _MOST = 0.012, 1.5  # m; radii of handwheels
_RIM_FROM = 0.84  # of its radius, from where on a wheel is its rim
_CALLED = "handwheel"


@dataclass(frozen=True, eq=False)
class Wheel:
    """A handwheel.

    Args:
        body: what turns.
        frame: its axis, out of the valve, its origin amid its rim.
        rim: radius of the rim's middle [m].
        thickness: half the thickness of the rim [m].
        source: how its axis was found.
    """

    body: Body
    frame: Frame
    rim: float
    thickness: float
    source: str


@dataclass(frozen=True, eq=False)
class _Round:
    """A body that is round about an axis: its frame, its radius, and the heights that it, or its rim, lies between [m].

    It is open between hub and rim, or a disc; its shaft is of one surface with it, or not.
    """

    body: Body
    frame: Frame
    radius: float
    low: float
    high: float
    open: bool
    source: str
    shaft: bool = False


def find_wheel(valve: Valve, bodies: Sequence[Body], pieces: Sequence[Body]) -> Wheel | None:
    """The handwheel of a valve among some bodies.

    Args:
        valve: whole.
        bodies: that may be one, or hold its rim.
        pieces: of all its meshes that are in several.
    """
    called = [body for body in bodies if _CALLED in body.names and not body.pieces]
    # What is called a wheel, and has the shape of one, goes before all others.
    for some in (called, [body for body in bodies if body not in called]):
        rounds = [found for body in some if (found := _round(body, pieces)) is not None]
        standing = [
            turned for found in rounds if _stands_out(turned := _outward(found, valve), valve, pieces, some is called)
        ]
        if standing:
            return _whole(max(standing, key=lambda one: (one.open, one.radius)), bodies)
    return None


def is_geared(wheel: Wheel, valve: Valve) -> bool:
    """Whether a wheel turns the stem by a gear: it sits beside it."""
    if "gearbox" in valve.names:
        return True
    if valve.line is None:
        return False
    gap = valve.line.gap(wheel.frame.origin, wheel.frame.axis)
    return gap > max(_BESIDE * wheel.rim, _BESIDE_AT_LEAST)


def _round(body: Body, pieces: Sequence[Body]) -> _Round | None:
    """A body as a wheel; by its rim where all of it is none, as with a chain in it."""
    called = _CALLED in body.names and not body.pieces
    found = _round_body(body, called)
    if found is not None or not called:
        return found
    rims = [_round_body(one, False) for one in pieces if one.meshes == body.meshes]
    rim = max((one for one in rims if one is not None and one.open), key=lambda one: one.radius, default=None)
    return replace(rim, body=body) if rim is not None else None


def _round_body(body: Body, called: bool) -> _Round | None:
    """A body as a wheel, about any of its axes: the thinnest of a flat one, another of one on its shaft."""
    spread = body.spread
    for k in range(3):
        first, second = (float(spread[other]) for other in range(3) if other != k)
        unequal = (second - first) / max(second, 1e-30)
        if unequal > _NEARLY or (k == 0 and float(spread[0]) > (1.0 if called else 0.5) * first):
            continue
        frame, source = frame_of(body.center, body.axes[k]), "equal moments of inertia"
        if unequal > _EQUAL:
            frame, source = _about_rim(body, frame), "circle of its rim"
        found = _on_axis(body, frame, source, called)
        if found is not None:
            return found
    return None


def _on_axis(body: Body, frame: Frame, source: str, called: bool) -> _Round | None:
    """A body as a wheel about an axis: flat, or a flat rim on a shaft."""
    points = body.points
    away, height = frame.away(points), frame.height(points)
    radius = float(away.max())
    if not _LEAST <= radius <= _MOST:
        return None
    flat = float(np.ptp(height)) <= 2 * radius * (_KNOB if called else _FLAT)
    # On a shaft, all but the rim is near the axis.
    outer = height if flat else height[away > _HUB * radius]
    low, high = float(outer.min()), float(outer.max())
    if high - low > 2 * radius * (_KNOB if called and flat else _FLAT) or not _is_round(frame.flat(points), radius):
        return None
    open_ = float(frame.covered(body.corners, [share * radius for share in _BETWEEN]).mean()) <= _OPEN
    return _Round(body, frame, radius, low, high, open_, source, shaft=not flat)


def _about_rim(body: Body, frame: Frame) -> Frame:
    """The frame about the outermost circle of a body whose moments something else disturbs."""
    for _ in range(3):
        flat = frame.flat(body.points)
        away = np.linalg.norm(flat, axis=1)
        far = _around(flat, away)
        center = _circle(flat[far])
        origin = frame.origin + center @ frame.across
        frame = frame_of(origin, frame.axis)
        rim = body.points[frame.away(body.points) > 0.9 * float(np.median(frame.away(body.points[far])))]
        apart = rim - rim.mean(axis=0)
        normal = np.linalg.eigh(apart.T @ apart)[1][:, 0]
        if abs(float(normal @ frame.axis)) > 0.97:
            frame = frame_of(origin, unit_vector(normal))
    return frame


def _around(flat: Floats, away: Floats) -> Ints:
    """The farthest point in each of some directions."""
    sector = np.floor((np.arctan2(flat[:, 1], flat[:, 0]) + np.pi) / (2 * np.pi) * 24).astype(int)
    order = np.lexsort((-away, sector))
    _, first = np.unique(sector[order], return_index=True)
    found: Ints = order[first]
    return found


def _circle(points: Floats) -> Floats:
    """The middle of the circle through most of some points, ``(2,)``."""
    kept = points
    center = points.mean(axis=0)
    for _ in range(4):
        table = np.column_stack([2 * kept, np.ones(len(kept))])
        center = np.linalg.lstsq(table, (kept**2).sum(axis=1), rcond=None)[0][:2]
        off = np.abs(np.linalg.norm(points - center, axis=1) - np.median(np.linalg.norm(points - center, axis=1)))
        near = points[off <= max(3 * float(np.median(off)), 1e-6)]
        if len(near) < 6:
            break
        kept = near
    found: Floats = center
    return found


def _is_round(flat: Floats, radius: float) -> bool:
    """Whether points reach about as far from their axis in all directions."""
    turns = 2 * np.pi * np.arange(24) / 24
    reach = (flat @ np.array([np.cos(turns), np.sin(turns)])).max(axis=0)
    return float(reach.min()) >= _ROUND * radius


def _outward(found: _Round, valve: Valve) -> _Round:
    """The same with its axis out of the valve."""
    out = float((found.frame.origin - valve.middle) @ found.frame.axis)
    if out >= 0:
        return found
    frame = frame_of(found.frame.origin, -found.frame.axis)
    return replace(found, frame=frame, low=-found.high, high=-found.low)


def _stands_out(found: _Round, valve: Valve, pieces: Sequence[Body], called: bool) -> bool:
    """Whether something round stands out of a valve as a wheel does."""
    line = valve.line
    if _is_about_line(found, valve) or (found.shaft and _holds_line(found, valve)):
        return False
    if called:
        return True
    if line is not None and found.radius < (0.6 if found.open else _DISC_WIDE) * line.bore:
        return False
    if not found.open and (found.high - found.low > _DISC_FLAT * found.radius or line is None):
        return False
    return _is_free(found, valve, pieces)


def _is_about_line(found: _Round, valve: Valve) -> bool:
    """Whether something round is about the straight line through a valve: a flange, a ring."""
    line, frame = valve.line, found.frame
    if line is None or not line.straight or abs(float(frame.axis @ line.way)) <= _COAXIAL:
        return False
    return float(np.linalg.norm(frame.origin - line.foot(frame.origin))) < 0.5 * found.radius


def _is_free(found: _Round, valve: Valve, pieces: Sequence[Body]) -> bool:
    """Whether nothing wide is above something round, nor right below it, but something carries it."""
    frame, margin = found.frame, 0.02 * found.radius
    rest = [p for other in valve.others(found.body, pieces) if len(p := other.dense)]
    if not rest:
        return False
    points = np.concatenate(rest)
    height, away = frame.height(points), frame.away(points)
    if float(away[height > found.high + margin].max(initial=0.0)) > _ABOVE * found.radius:
        return False
    # A disc may be a cover, so that more of what is below it must be slender, but for one on a slender shaft.
    depth, most = (0.06, _BELOW) if found.open or found.shaft else (0.4, _DISC_BELOW)
    below = away[(height < found.low - margin) & (height > found.low - depth * found.radius)]
    return bool((height < found.low).any()) and float(below.max(initial=0.0)) <= most * found.radius


def _holds_line(found: _Round, valve: Valve) -> bool:
    """Whether what a wheel is one surface with reaches down to the line through its valve, as the body does."""
    line = valve.line
    if line is None:
        return True
    if line.gap(found.frame.origin, found.frame.axis) > found.radius:
        return False
    foot = float(found.frame.height(line.foot(found.frame.origin)[None])[0])
    return float(found.frame.height(found.body.points).min()) < foot + line.bore


def _whole(found: _Round, bodies: Sequence[Body]) -> Wheel:
    """A wheel with all that turns with it: hub, spokes, nut."""
    frame, low, high = found.frame, found.low, found.high
    taken = [found.body]
    waiting = [body for body in bodies if body is not found.body and bool(body.pieces) == bool(found.body.pieces)]
    grown = True
    while grown:
        grown = False
        for body in waiting:
            height = frame.height(body.points)
            least, most = float(height.min()), float(height.max())
            overlap = min(high, most) - max(low, least)
            if (
                overlap < _OVERLAP * max(most - least, 1e-4)
                or most - least > max(_SHORT * found.radius, 1.2 * (found.high - found.low))
                or float(frame.away(body.points).max()) > _WITHIN * found.radius
            ):
                continue
            taken.append(body)
            waiting = [other for other in waiting if other is not body]
            low, high, grown = min(low, least), max(high, most), True
            break
    body = join(taken)
    source = found.source
    if len(taken) > 1:
        source += f", {len(taken)} {'pieces' if body.pieces else 'meshes'}"
    rim, thickness = _rim(body, frame, found.radius)
    outer = frame.height(body.points[frame.away(body.points) > _RIM_FROM * found.radius])
    middle = 0.5 * float(outer.min() + outer.max())
    return Wheel(body, frame_of(frame.origin + middle * frame.axis, frame.axis), rim, thickness, source)


def _rim(body: Body, frame: Frame, radius: float) -> tuple[float, float]:
    """The middle circle of the rim and half its thickness [m]."""
    outer = body.points[frame.away(body.points) > _RIM_FROM * radius]
    half = 0.5 * float(np.ptp(frame.height(outer)))
    half = float(np.clip(half, 0.001, 0.25 * radius))
    return radius - half, half
