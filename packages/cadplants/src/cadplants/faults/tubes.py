"""The pipes of a finished plant as tubes along their lines, whose ends can be moved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadplants.faults.chainage import Axis
from cadplants.model.plant import Component, Plant
from cadplants.solids.mesh_ops import Solid

__all__ = ["Joint", "Tube", "find_joints", "find_tubes", "trimmed"]

_AT_END = 0.002  # m; corners of a pipe this near to its end move with it: unevenness, a slanted cut
_OUTSIDE = ("Connection assembly", "Structural element", "Electrical and safety", "")
"""Groups of what holds or covers a pipe without being in its line."""


@dataclass(frozen=True, eq=False)
class Tube:
    """A pipe of a finished plant.

    Args:
        axis: of its line.
        low: chainage of its first end [m].
        high: of its other end.
        radius: greatest distance of its skin from its axis at the first end [m].
        corners: indices of the vertices at its first and at its other end.
        ways: unit directions ``(3,)`` of the line at both.
    """

    axis: Axis
    low: float
    high: float
    radius: float
    corners: tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]
    ways: tuple[Floats, Floats]

    @property
    def length(self) -> float:
        """From end to end along the axis [m]."""
        return self.high - self.low


@dataclass(frozen=True)
class Joint:
    """A pipe's end and what it meets in its line.

    Args:
        pipe: index of the component.
        end: 0 or 1, the end at ``low`` or at ``high``.
        partner: index of what it meets.
    """

    pipe: int
    end: int
    partner: int


def find_tubes(plant: Plant) -> dict[int, Tube]:
    """The pipes that lie on a line, by component."""
    axes = {line.id: Axis(line.points) for line in plant.lines}
    outer = {line.id: line.outer for line in plant.lines}
    return {
        i: _straight(component, axes[component.line], outer[component.line]) or _bent(component, axes[component.line])
        for i, component in enumerate(plant.components)
        if component.name == "pipe" and component.line in axes
    }


def _straight(component: Component, axis: Axis, outer: float) -> Tube | None:
    """A pipe along its own x axis; None where it is bent."""
    x, across = component.solid.vertices[:, 0], np.hypot(*component.solid.vertices[:, 1:].T)
    if across.max() > 0.55 * outer + _AT_END:
        return None
    ends = [component.pose[:3, :3] @ (end, 0.0, 0.0) + component.pose[:3, 3] for end in (x.min(), x.max())]
    corners = [np.flatnonzero(x < x.min() + _AT_END), np.flatnonzero(x > x.max() - _AT_END)]
    s = axis.along(np.array(ends))
    if s[0] > s[1]:
        ends, corners, s = ends[::-1], corners[::-1], s[::-1]
    way = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    low, high = float(s[0]), float(s[1])
    return Tube(axis, low, high, float(across.max()), (corners[0], corners[1]), (way, way))


def _bent(component: Component, axis: Axis) -> Tube:
    """A pipe with bends, which end some way before its ends."""
    places = component.vertices
    s = axis.along(places)
    low, high = float(s.min()), float(s.max())
    first, last = np.flatnonzero(s < low + _AT_END), np.flatnonzero(s > high - _AT_END)
    radius = float(np.linalg.norm(places[first] - axis.point(low), axis=1).max())
    return Tube(axis, low, high, radius, (first, last), (axis.way(low + 1e-6), axis.way(high - 1e-6)))


def find_joints(plant: Plant, tubes: Mapping[int, Tube]) -> list[Joint]:
    """What the ends of the pipes meet in their lines; neither supports nor branch outlets nor what covers a pipe."""
    joints = []
    for a, b in plant.contacts:
        for pipe, partner in ((a, b), (b, a)):
            other = plant.components[partner]
            if pipe not in tubes or other.group in _OUTSIDE or other.name == "branch outlet":
                continue
            tube, places = tubes[pipe], other.vertices
            box = places.min(axis=0), places.max(axis=0)
            gaps = [_outside(tube.axis.point(s), *box) for s in (tube.low, tube.high)]
            if min(gaps) < tube.radius:
                joints.append(Joint(pipe, int(gaps[1] < gaps[0]), partner))
    return joints


def _outside(point: Floats, low: Floats, high: Floats) -> float:
    return float(np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0.0)))


def trimmed(component: Component, tube: Tube, first: float, last: float) -> Component:
    """The pipe with so much taken off its ends, or put on where negative [m]; as it is where nothing would be left."""
    if tube.length - first - last < _AT_END or tube.length < 2 * _AT_END:
        return component
    places = component.vertices
    places[tube.corners[0]] += first * tube.ways[0]
    places[tube.corners[1]] -= last * tube.ways[1]
    back = np.linalg.inv(component.pose)
    return replace(component, solid=Solid(places @ back[:3, :3].T + back[:3, 3], component.solid.faces))
