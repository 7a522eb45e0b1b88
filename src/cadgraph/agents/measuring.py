"""How far two things are apart."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from cadgraph.agents.answer import Answer, AskError, page_of
from cadgraph.agents.plant import Plant
from cadgraph.model.records import Box, Cluster, Junction, Node, Part, Point, Terminal, Unit
from cadgraph.query.trace import find_way

__all__ = ["box_of", "compass", "measure", "point_of"]

_COMPASS = ("east", "north east", "north", "north west", "west", "south west", "south", "south east")
_SAME = 0.05  # m; ours: what differs by less is level, or right above


def measure(plant: Plant, a: str, b: str) -> Answer:
    """How far one thing is from another, and where it lies from there.

    Args:
        plant: that holds them.
        a: tag, id or mesh of what it is measured from.
        b: of what it is measured to.

    Returns:
        Distances between the middles straight, in plan and in height [m], the gap between the boxes, the point of the
        compass (north is +y), above or below, and the shortest way along the pipes.

    Raises:
        AskError: nothing is called so, or it has no place.
    """
    first, last = plant.find(a), plant.find(b)
    here, there = point_of(first), point_of(last)
    dx, dy, dz = (t - h for h, t in zip(here, there, strict=True))
    plan = math.hypot(dx, dy)
    values = {
        "from": plant.called(first.id),
        "to": plant.called(last.id),
        "straight_m": math.dist(here, there),
        "plan_m": plan,
        "height_m": dz,
        "gap_m": _gap(box_of(first), box_of(last)),
        "compass": compass(dx, dy) if plan > _SAME else None,
        "vertical": "above" if dz > _SAME else "below" if dz < -_SAME else "level",
        **_along(plant, first, last),
    }
    return Answer(page_of([], _told(values), [], 1), values)


def point_of(node: Node) -> Point:
    """Where a node is: the middle of what is solid, the point of a junction or an end [m].

    Raises:
        AskError: it has no one place.
    """
    if isinstance(node, Unit | Part | Cluster):
        return node.centroid
    if isinstance(node, Junction | Terminal):
        return node.point
    raise AskError(f"{node.id} is a {node.layer}, which has no one place; give a unit, a part, a junction or an end")


def box_of(node: Node) -> Box:
    """The box around a node, along the axes [m].

    Raises:
        AskError: it has no one place.
    """
    return node.aabb if isinstance(node, Unit | Part | Cluster) else (point_of(node), point_of(node))


def compass(dx: float, dy: float) -> str:
    """The point of the compass that a direction in plan has; north is +y."""
    return _COMPASS[round(math.atan2(dy, dx) / (math.pi / 4)) % 8]


def _gap(first: Box, last: Box) -> float:
    """Between two boxes [m]; 0 where they touch or overlap."""
    apart = [max(0.0, last[0][k] - first[1][k], first[0][k] - last[1][k]) for k in range(3)]
    return math.hypot(*apart)


def _along(plant: Plant, first: Node, last: Node) -> dict[str, Any]:
    """The way along the pipes, or why none is known."""
    network = plant.network
    ends = [node.id if node.id in network.places else network.owner_of_part(node.id) for node in (first, last)]
    nothing: dict[str, Any] = {"pipe_m": None, "pipe_complete": False, "pipe_doubts": []}
    if ends[0] is None or ends[1] is None:
        return nothing | {"pipe": "not along pipes"}
    for end in ends:
        if end is not None and not network.arcs(end):
            return nothing | {"pipe": f"unknown: no line was found at {plant.called(end)}"}
    found = find_way(network, ends[0], ends[1])
    if not found.steps:
        doubts = [f"{doubt.name}: {doubt.text}" for doubt in found.doubts]
        return nothing | {"pipe": "no way along pipes was found", "pipe_doubts": doubts}
    step = found.steps[-1]
    return {"pipe_m": step.distance, "pipe_complete": not step.at_least, "pipe_doubts": [], "pipe": "found"}


def _told(values: Mapping[str, Any]) -> list[str]:
    height = f"{abs(values['height_m']):.2f} m {values['vertical']}" if values["vertical"] != "level" else "level"
    where = [values["compass"]] if values["compass"] else ["right there in plan"]
    told = [
        f"{values['to']} from {values['from']}: {', '.join([*where, height])}",
        f"straight {values['straight_m']:.2f} m, in plan {values['plan_m']:.2f} m, height {values['height_m']:+.2f} m "
        f"(middle to middle); between the boxes {values['gap_m']:.2f} m",
    ]
    if values["pipe_m"] is None:
        doubts = f"; {len(values['pipe_doubts'])} places where one may have been missed" * bool(values["pipe_doubts"])
        return [*told, f"along pipes: {values['pipe']}{doubts}"]
    least = "" if values["pipe_complete"] else "at least "
    return [*told, f"along pipes {least}{values['pipe_m']:.2f} m"]
