"""The pipes of a finished plant as tubes along their lines, whose ends can be moved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.chainage import Axis
from cadplants.mesh_ops import Solid
from cadplants.plant import Component, Plant

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
        radius: greatest distance of its skin from its axis at the ends [m].
    """

    axis: Axis
    low: float
    high: float
    radius: float

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
    """The pipes that lie on a line, by component; not those whose mesh is torn into loose triangles."""
    axes = {line.id: Axis(line.points) for line in plant.lines}
    tubes = {}
    for i, component in enumerate(plant.components):
        if component.name == "pipe" and component.line in axes:
            axis = axes[component.line]
            places = component.vertices
            s = axis.along(places)
            low, high = float(s.min()), float(s.max())
            at_low = places[s < low + _AT_END]
            radius = float(np.linalg.norm(at_low - axis.point(low), axis=1).max())
            tubes[i] = Tube(axis, low, high, radius)
    return tubes


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
    s = tube.axis.along(places)
    places[s < tube.low + _AT_END] += first * tube.axis.way(tube.low + 1e-6)
    places[s > tube.high - _AT_END] -= last * tube.axis.way(tube.high - 1e-6)
    back = np.linalg.inv(component.pose)
    return replace(component, solid=Solid(places @ back[:3, :3].T + back[:3, 3], component.solid.faces))
