"""Bends of lines: where a centreline that was found in triangles begins and ends to turn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from cadgraph.model.records import Point
from cadgraph.query.piped_line import Component
from cadgraph.query.polyline import Polyline, add, angle, dot, minus, times, unit

__all__ = ["TURN", "arc_tangents", "bend_radius", "fitted", "tangent"]

TURN = 0.05
"""What turns by less runs straight through [rad]; ours."""

_FAR, _CLOSE = 0.05, 0.005  # m; ours: over which a straight beside a bend is measured, if need be over less
_LEG = 1e-3  # m; ours: what is less of a pipe beside a bend is none: a centreline found in triangles wavers as much


def fitted(pieces: Sequence[Component], radii: Sequence[float | None]) -> Iterator[Component]:
    """Pipes and bends, each bend from tangent point to tangent point.

    Where a centreline begins to turn is seen late, as it turns little at first; how far its middle stays off the corner
    tells the radius, and with it where the bend begins and ends. What that moves, the pipes beside it give or take.

    Args:
        pieces: in order, each beginning where the one before ends.
        radii: of each piece that is a bend [m], else None.
    """
    found: list[Component] = []
    for i, (piece, radius) in enumerate(zip(pieces, radii, strict=True)):
        onward = pieces[i + 1] if i + 1 < len(pieces) else None
        if piece.centre is None or radius is None:
            # What the bend before it took or left.
            start = found[-1].end if found else piece.start
            found.append(replace(piece, start=start, length=math.dist(start, piece.end)))
            continue
        before, after = minus(piece.start, piece.centre), minus(piece.end, piece.centre)
        room = [math.hypot(*before), math.hypot(*after)]
        if found and found[-1].kind == "pipe":
            room[0] += max(0.0, found[-1].length - _LEG)
        if onward is not None and onward.kind == "pipe":
            room[1] += max(0.0, onward.length - _LEG)
        leg = min(radius * math.tan(piece.angle / 2), *room)
        start = add(piece.centre, times(unit(before), leg))
        end = add(piece.centre, times(unit(after), leg))
        if found and found[-1].kind == "pipe":
            found[-1] = replace(found[-1], end=start, length=math.dist(found[-1].start, start))
        elif math.hypot(*before) - leg > _LEG:
            found.append(_straight(piece, piece.start, start))
        else:
            start = piece.start
        found.append(replace(piece, start=start, end=end, length=leg / math.tan(piece.angle / 2) * piece.angle))
        if onward is None or onward.kind != "pipe":
            if math.hypot(*after) - leg > _LEG:
                found.append(_straight(piece, end, piece.end))
            else:
                found[-1] = replace(found[-1], end=piece.end)
    yield from found


def bend_radius(line: Polyline, start: float, end: float, bend: Component) -> float | None:
    """Radius of a bend by how far its corner lies off the centreline [m]; None of what isn't one."""
    if bend.centre is None:
        return None
    _, distance = line.nearest(bend.centre, start, end)
    return distance / (1 / math.cos(bend.angle / 2) - 1)


def _straight(piece: Component, start: Point, end: Point) -> Component:
    return replace(piece, kind="pipe", start=start, end=end, centre=None, angle=0.0, length=math.dist(start, end))


def tangent(line: Polyline, station: float, side: int) -> Point | None:
    """The direction of a line beside a bend, forward; None where it isn't straight there.

    Args:
        line: the centreline.
        station: where the bend begins or ends [m].
        side: -1 for what comes before it, 1 for what comes after it.
    """

    def way(reach: float, which: int = side) -> Point | None:
        other = min(max(station + which * reach, 0.0), line.length)
        if abs(other - station) < reach / 2:
            return None
        return line.direction(min(station, other), max(station, other))

    far, near, across = way(_FAR), way(_CLOSE), way(_CLOSE, -side)
    if near is None:
        return None
    if far is not None and angle(far, near) < TURN / 2:
        return far
    # A short straight between two bends, which were divided in the midst of it.
    return near if across is not None and angle(near, across) < TURN / 2 else None


def arc_tangents(start: Point, middle: Point, end: Point) -> tuple[Point, Point] | None:
    """The tangents at the ends of the circle through three points; None where they lie in line."""
    a, b = minus(middle, start), minus(end, middle)
    chord = minus(end, start)
    if angle(a, b) < TURN / 2:
        return None
    # The chords to any point of an arc turn by half of what the arc turns by, each tangent from the chord by half, too.
    half = angle(a, b)
    way = unit(chord)
    side = unit(minus(a, times(way, dot(a, way))))
    along, across = times(way, math.cos(half)), times(side, math.sin(half))
    return add(along, across), minus(along, across)
