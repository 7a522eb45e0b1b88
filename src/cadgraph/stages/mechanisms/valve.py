"""What is known of a valve before anything of it is found to move: its bodies, and the line through it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.parts import UnitParts
from cadgraph.model.scene import Floats
from cadgraph.stages.mechanisms.body import Body, middle_of, unit_vector

__all__ = ["Line", "Valve", "line_of"]

_STRAIGHT = 0.9  # cosine between the ways out of two openings that are of one line


@dataclass(frozen=True, eq=False)
class Line:
    """The line through a valve.

    Args:
        point: ``(3,)`` amid the valve [m].
        way: ``(3,)`` unit vector along it.
        straight: whether it goes straight through; else it ends in the valve, or turns in it.
        bore: radius [m], or 0 where unknown.
    """

    point: Floats
    way: Floats
    straight: bool
    bore: float

    def foot(self, point: Floats) -> Floats:
        """``(3,)`` the nearest point of the line [m]."""
        found: Floats = self.point + ((point - self.point) @ self.way) * self.way
        return found

    def gap(self, point: Floats, axis: Floats) -> float:
        """How far an axis passes the line [m]."""
        square = np.cross(self.way, axis)
        apart = point - self.point
        if float(np.linalg.norm(square)) < 1e-6:
            return float(np.linalg.norm(apart - (apart @ self.way) * self.way))
        return abs(float(apart @ unit_vector(square)))


@dataclass(frozen=True, eq=False)
class Valve:
    """A valve.

    Args:
        unit: with its openings.
        bodies: its meshes.
        line: through it; None where no line joins it.
        size: nominal size of its lines (DN), or None.
    """

    unit: UnitParts
    bodies: tuple[Body, ...]
    line: Line | None
    size: int | None

    @cached_property
    def names(self) -> frozenset[str]:
        """What labels call its parts."""
        return frozenset().union(*(body.names for body in self.bodies))

    @cached_property
    def middle(self) -> Floats:
        """``(3,)`` amid it: on its line, else of its surface [m]."""
        if self.line is not None:
            return self.line.point
        return middle_of(self.bodies)

    def others(self, moving: Body, pieces: Sequence[Body]) -> list[Body]:
        """All that does not move with a body: other meshes, and other pieces of the one mesh."""
        rest = [body for body in self.bodies if not set(body.meshes) & set(moving.meshes)]
        if moving.pieces:
            rest += [one for one in pieces if one.meshes == moving.meshes and one.pieces[0] not in moving.pieces]
        return rest


def line_of(unit: UnitParts) -> Line | None:
    """The line through the openings of a unit; None where nothing joins it, or says which way."""
    openings = unit.openings
    if not openings:
        return None
    points = np.array([opening.point for opening in openings], np.float64)
    bore = min((o.diameter / 2 for o in openings if o.diameter is not None), default=0.0)
    ways = [unit_vector(np.asarray(o.direction, np.float64)) for o in openings if o.direction is not None]
    if len(openings) == 2:
        span = points[1] - points[0]
        if float(np.linalg.norm(span)) > 1e-6:
            way = unit_vector(span)
            straight = all(abs(float(way @ one)) > _STRAIGHT for one in ways)
            if straight:
                return Line(points.mean(axis=0), way, True, bore)
    opposite = [(a, b) for a in range(len(ways)) for b in range(a) if float(ways[a] @ ways[b]) < -_STRAIGHT]
    if len(ways) == len(openings) and len(openings) > 2 and opposite:
        a, b = opposite[0]
        return Line(0.5 * (points[a] + points[b]), unit_vector(points[a] - points[b]), True, bore)
    return Line(points[0], ways[0], False, bore) if ways else None
