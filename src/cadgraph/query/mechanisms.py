"""What can be turned, pulled and read in a plant: its mechanisms, their joints, and the valves that have none."""

from __future__ import annotations

import re
from dataclasses import dataclass

from cadgraph.model.graph import SceneGraph
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.model.records import Unit

__all__ = ["Immovable", "immovable", "joint_names", "say_handling", "say_mechanism", "say_not_movable"]

_NOT_IN_A_NAME = re.compile(r"[^A-Za-z0-9_]")
_TAKEN = ("base", "joints")  # names of what stands beside the devices in a simulation


@dataclass(frozen=True)
class Immovable:
    """A valve that would be moved by hand, but of which nothing is known to move.

    Args:
        unit: its id.
        tag: as people call it.
        reason: why, in words.
    """

    unit: str
    tag: str
    reason: str


def immovable(graph: SceneGraph) -> tuple[Immovable, ...]:
    """The valves that would be moved by hand, but of which nothing is known to move, in the order of the graph.

    Check and relief valves and valves with an actuator are none of these; nor is anything in graphs that were built
    without mechanisms.

    Args:
        graph: of a plant.
    """
    reasons = [one.message for one in graph.diagnostics if one.code == NOT_MOVABLE]
    return tuple(
        Immovable(unit.id, unit.tag, reason.removeprefix(f"{unit.tag}: "))
        for unit in graph.units()
        if unit.unit_type == "valve" and unit.mechanism is None
        for reason in reasons
        if reason.startswith(f"{unit.tag}: ")
    )


def joint_names(graph: SceneGraph) -> dict[str, str]:
    """The name of the joint of each unit with something that moves, or with a dial that a needle may be drawn on.

    A name is the tag with what is neither a Latin letter nor a digit as ``_``; no two are the same, not even where they
    differ in case only, and each may stand as a name in USD and MJCF.

    Args:
        graph: of a plant.

    Returns:
        Names by the ids of units, in the order of the graph.
    """
    found: dict[str, str] = {}
    taken = {*_TAKEN}
    for unit in graph.units():
        if unit.mechanism is None and unit.dial is None:
            continue
        name = _NOT_IN_A_NAME.sub("_", unit.tag)
        name = f"_{name}" if not name or name[0].isdigit() else name
        free, count = name, 1
        while free.casefold() in taken:
            count += 1
            free = f"{name}_{count}"
        taken.add(free.casefold())
        found[unit.id] = free
    return found


def say_mechanism(unit: Unit) -> str:
    """What can be done at a unit by hand or eye, in words; empty where nothing is known."""
    moves = unit.mechanism
    if moves is None:
        return "read: its dial, without a needle of its own" if "read" in unit.affordances else ""
    if moves.kind == "needle":
        return "read: its needle"
    done = "pull" if "pull" in unit.affordances else "turn"
    stroke = (
        f"open at {moves.open:.4g} degrees, shut at {moves.shut:.4g}" if None not in (moves.open, moves.shut) else ""
    )
    assumed = sorted({text for key in ("open", "limits") if (text := moves.sources.get(key, "")).startswith("assumed")})
    return f"{done}: {moves.kind}, {stroke} from as drawn" + (f" ({'; '.join(assumed)})" if assumed else "")


def say_handling(unit: Unit) -> str:
    """What people can do at a unit, in words for them; empty where nothing is known.

    As in "can be turned: handwheel, radius 0.12 m, about 10 turns to shut".
    """
    moves = unit.mechanism
    if moves is None or moves.kind == "needle":
        dial = "its needle was found" if moves is not None else "its dial has no needle of its own"
        if moves is None and unit.dial is None:
            dial = "where its dial is, is not known"
        return f"can be read: {dial}" if "read" in unit.affordances else ""
    told = [moves.kind, f"radius {moves.radius:.2f} m"]
    if moves.kind == "lever":
        told[1] = f"{moves.radius:.2f} m long"
    if moves.open is not None and moves.shut is not None:
        # It is drawn at 0 degrees.
        aim, way = (moves.shut, "shut") if abs(moves.shut) >= abs(moves.open) else (moves.open, "open")
        told.append(_stroke(abs(aim), assumed="assumed" in moves.sources.get("limits", "")) + f" to {way}")
    return f"can be {'pulled' if 'pull' in unit.affordances else 'turned'}: {', '.join(told)}"


def _stroke(angle: float, assumed: bool) -> str:
    about = "about " if assumed else ""
    return f"{about}{angle / 360:.3g} turns" if angle >= 360 else f"{about}{angle:.0f} degrees"


def say_not_movable(graph: SceneGraph, unit: Unit) -> str:
    """Why nothing of a valve is known to move, in words; empty where something does, or nobody would move it."""
    return next((f"not movable: {one.reason}" for one in immovable(graph) if one.unit == unit.id), "")
