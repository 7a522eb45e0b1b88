"""What of a plant can be moved by hand, what joints of it are called, and what can't be moved, and why."""

from __future__ import annotations

import re
from dataclasses import dataclass

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit

__all__ = ["Immovable", "immovable", "joint_names"]


@dataclass(frozen=True)
class Immovable:
    """A unit that nothing was found at to turn.

    Args:
        unit: its id.
        tag: its tag.
        reason: why, in words.
    """

    unit: str
    tag: str
    reason: str


def immovable(graph: SceneGraph) -> tuple[Immovable, ...]:
    """The valves and gauges without a mechanism, in the order of the graph."""
    return tuple(
        Immovable(unit.id, unit.tag, "no wheel, lever or needle was found")
        for unit in graph.of_layer(Unit)
        if unit.mechanism is None and unit.unit_type in ("valve", "gauge")
    )


def joint_names(graph: SceneGraph) -> dict[str, str]:
    """The joint of each unit, by its id: its tag with ``_`` for what USD allows in no name, unique in the graph."""
    names: dict[str, str] = {}
    taken: set[str] = set()
    for unit in graph.of_layer(Unit):
        name = re.sub(r"[^A-Za-z0-9_]", "_", unit.tag) or "_"
        free, number = name, 2
        while free in taken:
            free, number = f"{name}_{number}", number + 1
        taken.add(free)
        names[unit.id] = free
    return names
