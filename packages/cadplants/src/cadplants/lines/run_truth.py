"""The truth of a run: its centreline, what follows what along it, and which way it flows where physics says so."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Literal

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.lines.run import Run
from cadplants.model.plant import Assembly, Connection, Line, Point
from cadplants.model.standards import PIPES

__all__ = ["ONE_WAY", "course"]

ONE_WAY = ("check valve", "relief valve", "safety valve")
"""Kinds of devices that let nothing pass from their outlet to their inlet."""

_CHORDS = 8  # of a bend of 90 degrees

_Flow = tuple[Literal["forward", "backward", "unknown"], str]


def course(run: Run, one_way: Mapping[str, bool]) -> Assembly:
    """Terminals, junctions, the centreline, and the connections between consecutive nodes of a run.

    Args:
        run: as it was laid.
        one_way: ids of the devices that let flow pass one way only: whether that is along the run.
    """
    nodes = _nodes(run)
    points = [_point(item.junction, "junction", run.route.point(item.s)) for item in run.inline if item.junction]
    for s, node, end, name in ((0.0, run.nodes[0], 0, "start"), (run.route.length, run.nodes[1], 1, "end")):
        if not node:
            node = f"{run.tag}/{name}"
            blind = run.ends[end] in ("blind", "plate")
            points.append(_point(node, "terminal", run.route.point(s), "blind" if blind else "open"))
        nodes.append((s, node))
    nodes.sort()
    pairs = list(zip(nodes[:-1], nodes[1:], strict=True))
    flows = _flows(run, [name for _, name in nodes], one_way)
    lengths = [_along(run, low, high) for (low, _), (high, _) in pairs]
    lengths[0], lengths[-1] = lengths[0] + run.arms[0], lengths[-1] + run.arms[1]
    connections = tuple(
        Connection(a, b, run.tag, length, run.dn_at(low) / 1000, direction, reason)
        for ((low, a), (_, b)), (direction, reason), length in zip(pairs, flows, lengths, strict=True)
    )
    outer = max(PIPES[run.dn_at(s)].outer for s in (0.0, *(item.s for item in run.inline)))
    line = Line(run.tag, centreline(run), outer)
    return Assembly(points=tuple(points), connections=connections, lines=(line,))


def _nodes(run: Run) -> list[tuple[float, str]]:
    """Chainage and id of the units and junctions of a run."""
    nodes = [(item.s, item.unit or item.junction) for item in run.inline if item.unit or item.junction]
    return nodes + [(tap.s, tap.unit) for tap in run.taps if tap.unit]


def _flows(run: Run, names: list[str], one_way: Mapping[str, bool]) -> list[_Flow]:
    """The flow of each connection; it is one from branch to branch, and none where a blind end closes the way."""
    junctions = {item.junction for item in run.inline if item.junction}
    borders = [0, *(i for i in range(1, len(names) - 1) if names[i] in junctions), len(names) - 1]
    flows: list[_Flow] = []
    for low, high in zip(borders[:-1], borders[1:], strict=True):
        ways = {one_way[name] for name in names[low : high + 1] if name in one_way}
        dead = (low == 0 and _is_dead(run, 0)) or (high == len(names) - 1 and _is_dead(run, 1))
        flows += [("unknown", "") if dead else _flow(run, ways)] * (high - low)
    return flows


def _flow(run: Run, ways: Collection[bool]) -> _Flow:
    """The flow of a way through which something can pass; ``ways`` of its devices that let flow pass one way only."""
    if run.flow != "unknown":
        return "forward" if run.flow == "forward" else "backward", run.reason
    if len(ways) != 1:
        return "unknown", ""
    return "forward" if True in ways else "backward", "a valve in it lets flow pass one way only"


def _is_dead(run: Run, end: int) -> bool:
    """Whether nothing can leave at an end (0 or 1)."""
    return not run.nodes[end] and run.ends[end] in ("blind", "plate")


def centreline(run: Run) -> Floats:
    """``(n, 3)`` the axis of a run with its bends, whose chords have their ends on it [m]."""
    points, ways = run.route.points, run.route.directions
    path = [points[0] - run.arms[0] * ways[0]]
    for corner in range(1, len(points) - 1):
        before, after = ways[corner - 1], ways[corner]
        turn = float(np.arccos(np.clip(before @ after, -1, 1)))
        tangent = run.tangent(corner)
        radius = tangent / np.tan(turn / 2)
        inward = after - before * (after @ before)
        inward = inward / np.linalg.norm(inward)
        start = points[corner] - tangent * before
        chords = max(2, round(_CHORDS * turn / (np.pi / 2)))
        for angle in np.linspace(0, turn, chords + 1):
            path.append(start + radius * (np.sin(angle) * before + (1 - np.cos(angle)) * inward))
    if run.route.jog is not None:
        path += [run.route.point(s) for s in run.route.jog[:2]]
    path.append(run.route.point(run.route.length) + run.arms[1] * ways[-1])
    return np.array(path)


def _point(name: str, kind: str, place: Floats, end: str = "") -> Point:
    x, y, z = (float(value) for value in place)
    return Point(name, kind, (x, y, z), end)


def _along(run: Run, low: float, high: float) -> float:
    """Length of the real centreline between two chainages: bends cut the corners [m]."""
    length = high - low
    directions = run.route.directions
    for corner in range(1, len(run.route.points) - 1):
        s, tangent = run.route.starts[corner], run.tangent(corner)
        if low < s < high:
            turn = float(np.arccos(np.clip(directions[corner - 1] @ directions[corner], -1, 1)))
            length -= 2 * tangent - tangent / np.tan(turn / 2) * turn
    return float(length)
