"""Angles of joints and what they mean: how far a valve is open, what a needle shows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from numbers import Real

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.query.mechanisms import joint_names

__all__ = ["Joints"]

_SWEEP = 270.0  # degrees of a dial, from half past seven clockwise


class Joints:
    """The joints of a plant.

    Args:
        graph: the finished graph, with what moves at its units.
    """

    def __init__(self, graph: SceneGraph) -> None:
        names = joint_names(graph)
        self._units = {names[unit.id]: unit for unit in graph.of_layer(Unit) if unit.id in names}

    def openings(self, joints: Mapping[str, float]) -> dict[str, float]:
        """How far valves are open, by tag.

        Args:
            joints: angles [deg] by name.

        Raises:
            ValueError: no joint is called so, or an angle is no number.
        """
        found = {}
        given: Mapping[str, object] = joints
        for name, angle in given.items():
            unit = self._units.get(name)
            if unit is None:
                raise ValueError(f"no joint is called {name!r}; there are {', '.join(self._units) or 'none'}")
            if not isinstance(angle, Real) or not math.isfinite(float(angle)):
                raise ValueError(f"joint {name}: {angle} is no angle")
            moves = unit.mechanism
            if moves is None or moves.open is None or moves.shut is None or moves.open == moves.shut:
                continue
            found[unit.tag] = min(max((float(angle) - moves.shut) / (moves.open - moves.shut), 0.0), 1.0)
        return found

    def angles(
        self,
        opening: Mapping[str, float],
        reading: Mapping[str, float | None],
        span: Mapping[str, float | None],
    ) -> dict[str, float]:
        """The angle of each joint [deg], by name.

        Args:
            opening: of valves, by tag.
            reading: of gauges, by tag.
            span: at the end of their scales, by tag.
        """
        found = {}
        for name, unit in self._units.items():
            moves = unit.mechanism
            if moves is not None and moves.open is not None and moves.shut is not None:
                if unit.tag in opening:
                    found[name] = moves.shut + opening[unit.tag] * (moves.open - moves.shut)
                continue
            shown, end = reading.get(unit.tag), span.get(unit.tag)
            share = 0.0 if shown is None or not end else min(max(shown / end, 0.0), 1.0)
            # Needles turn clockwise as they rise, so that a scale begins at the greatest angle.
            least, greatest = moves.limits if moves is not None else (-_SWEEP, 0.0)
            found[name] = greatest - share * (greatest - least)
        return found
