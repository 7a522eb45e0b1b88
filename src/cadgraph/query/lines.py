"""The line list: the pipes between what divides them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeVar

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.query.network import Arc, Flow, Network

__all__ = ["Line", "find_lines"]

_Number = TypeVar("_Number", int, float)
LineFlow = Literal["forward", "backward", "none", "unknown", "contradictory"]

_NUMBERS = 10_000
_GRID = 0.1  # m; lines that join no unit are told apart by place, to this
# m; off the round numbers that plants are drawn in, which would lie on the edge between two squares of that grid.
_OFF = 0.0137


@dataclass(frozen=True)
class Line:
    """A maximal run of connections without a branch.

    Args:
        tag: stable: made from what it joins, not from its place in the list.
        start: id of the node that it starts at, upstream where the direction is known.
        end: id of the node that it ends at.
        start_name: the tag of that node.
        end_name: the tag of that node.
        start_port: nozzle at the start.
        end_port: nozzle at the end.
        through: ids of what stands in it, in order from the start; instruments on taps at their place.
        through_names: their tags.
        beside: ids of the valves among them that stand on a tap or on the side of the line: what flows passes them by.
        length: along the centreline [m]; None where no part of it is known.
        whole: False where a part of the length is unknown.
        sizes: nominal sizes (DN) in order from the start, each change once.
        diameters: bores in the same manner [m].
        flow: of the whole line; ``forward`` is from start to end, ``none`` leads to a blind end.
        reasons: why the flow is so, each once.
        confidence: the least of its connections.
        system: id of the system.
        arcs: its connections in order; taps are not among them.
    """

    tag: str
    start: str
    end: str
    start_name: str
    end_name: str
    start_port: str | None
    end_port: str | None
    through: tuple[str, ...]
    through_names: tuple[str, ...]
    beside: tuple[str, ...]
    length: float | None
    whole: bool
    sizes: tuple[int, ...]
    diameters: tuple[float, ...]
    flow: LineFlow
    reasons: tuple[str, ...]
    confidence: float | None
    system: str | None
    arcs: tuple[Arc, ...]

    @property
    def through_words(self) -> tuple[str, ...]:
        """The tags of what stands in it, in brackets those of valves beside it: ``(V-001)``."""
        named = zip(self.through, self.through_names, strict=True)
        return tuple(f"({name})" if place in self.beside else name for place, name in named)

    @property
    def size(self) -> str:
        """Nominal sizes as they are written: ``80``, or ``80/50`` where it changes."""
        return "/".join(str(size) for size in self.sizes)


def find_lines(graph: SceneGraph | Network, at: str | None = None) -> list[Line]:
    """All lines of a graph, or those at one of its units.

    A line runs on through valves, gauges and the junctions of instrument taps. It ends at everything else: a junction
    of three or more pipes, a terminal, a tank, pump or other equipment, and a valve with other than two connections. A
    ring with nothing that divides it is one line from its first unit to itself.

    Args:
        graph: the finished graph, or its network.
        at: tag or id of a unit, junction or terminal that the lines begin at, end at or run through; of an instrument
            on a tap those that it is tapped from.

    Returns:
        The lines by system, start and end.

    Raises:
        Unconnected: no line was found at that unit, which is a ``ValueError``: that is no answer.
        ValueError: nothing is called so.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    if at is None:
        return _all_lines(network)
    place = network.find(at)
    if not network.arcs(place):
        raise network.unconnected(place, "which lines it is in")
    lines = _all_lines(network)
    own = [line for line in lines if place in (line.start, line.end, *line.through)]
    foot = _foot(network, place)
    return own or [line for line in lines if foot in (line.start, line.end, *(arc.end for arc in line.arcs))]


def _foot(network: Network, place: str) -> str:
    """Where the tap that a node hangs on branches off."""
    seen = {place}
    onward = [arc for arc in network.arcs(place) if network.is_tap(arc)]
    while onward:
        place = onward[0].end
        seen.add(place)
        if not network.is_gauge(place) and not network.is_valve(place):
            break
        onward = [arc for arc in network.arcs(place) if network.is_tap(arc) and arc.end not in seen]
    return place


def _all_lines(network: Network) -> list[Line]:
    used: set[int] = set()
    runs: list[list[Arc]] = []
    # First from what divides, then the rings that hold nothing of the kind.
    for place in sorted(network.places, key=lambda place: (not divides(network, place), tag_key(network.name(place)))):
        for arc in network.main_arcs(place):
            if arc.index not in used:
                runs.append(_run(network, arc, used))
    lines = _tagged(network, [_flowing(run) for run in runs])
    return sorted(lines, key=_order)


def divides(network: Network, place: str) -> bool:
    """Whether lines end at a node."""
    passes = network.unit_type(place) in (None, "valve", "gauge")
    return not passes or len(network.main_arcs(place)) != 2


def _run(network: Network, arc: Arc, used: set[int]) -> list[Arc]:
    """From one arc on to what divides; the arcs are taken out of what is left."""
    run = [arc]
    used.add(arc.index)
    while not divides(network, arc.end):
        onward = [other for other in network.main_arcs(arc.end) if other.index not in used]
        if not onward:
            break
        arc = onward[0]
        used.add(arc.index)
        run.append(arc)
    return run


def _flowing(run: list[Arc]) -> list[Arc]:
    """The run turned so that it goes with the flow, where the flow is known."""
    flows = {arc.flow for arc in run}
    return [arc.back for arc in reversed(run)] if "against" in flows and "along" not in flows else run


def _tagged(network: Network, runs: list[list[Arc]]) -> list[Line]:
    """Lines with numbers made from what they join, so that a line added elsewhere renumbers nothing as a rule.

    Of lines that come to the same number all but the first take the next free one, which such a line may change.
    """
    keys = [_key(network, run) for run in runs]
    order = sorted(range(len(runs)), key=lambda i: (keys[i], _place_key(network, runs[i])))
    taken: set[int] = set()
    lines: dict[int, Line] = {}
    for i in order:
        number = int.from_bytes(hashlib.sha256(keys[i].encode("utf-8", "surrogatepass")).digest()[:4], "big")
        number %= max(_NUMBERS, 4 * len(runs))
        while number in taken:
            number = (number + 1) % max(_NUMBERS, 4 * len(runs))
        taken.add(number)
        lines[i] = _line(network, f"L-{number:04d}", runs[i])
    return [lines[i] for i in range(len(runs))]


def _key(network: Network, run: list[Arc]) -> str:
    """What a line's number is made from: the units at its ends and its valves; its gauges, its place where none is."""
    ends = [p for p in (run[0].start, run[-1].end) if isinstance(network.places[p], Unit)]
    inside = [arc.end for arc in run[:-1]]
    named = [p for p in ends + inside if not network.is_gauge(p) and isinstance(network.places[p], Unit)]
    named = named or [p for p in ends + inside if isinstance(network.places[p], Unit)]
    # The nozzles tell two lines between the same two units apart.
    ports = sorted(p for p in (run[0].start_port, run[-1].end_port) if p) if named else []
    return "|".join(sorted(network.name(p) for p in named) + ports) or _place_key(network, run)


def _place_key(network: Network, run: list[Arc]) -> str:
    ends = []
    for place in (run[0].start, run[-1].end):
        node = network.places[place]
        point = node.centroid if isinstance(node, Unit) else node.point
        ends.append(",".join(f"{round((c + _OFF) / _GRID) + 0:+08d}" for c in point))
    return "|".join(sorted(ends))


def _beside(network: Network, run: list[Arc], through: list[str]) -> tuple[str, ...]:
    """The valves of a run that stand on a tap, or on its side."""
    within = {arc.end for arc in run[:-1]}
    valves = [place for place in through if network.unit_type(place) == "valve"]
    return tuple(place for place in valves if place not in within or network.stands_aside(place))


def _line(network: Network, tag: str, run: list[Arc]) -> Line:
    through = [*network.instruments(run[0].start)] if _carries_start(network, run) else []
    for arc in run[:-1]:
        through.append(arc.end)
        through.extend(network.instruments(arc.end))
    through = [place for place in through if isinstance(network.places[place], Unit)]
    lengths = [arc.length for arc in run]
    known = [length for length in lengths if length is not None]
    flows = {arc.flow for arc in run}
    confidences = [arc.edge.confidence for arc in run if arc.edge.confidence is not None]
    return Line(
        tag=tag,
        start=run[0].start,
        end=run[-1].end,
        start_name=network.name(run[0].start),
        end_name=network.name(run[-1].end),
        start_port=run[0].start_port,
        end_port=run[-1].end_port,
        through=tuple(through),
        through_names=tuple(network.name(place) for place in through),
        beside=_beside(network, run, through),
        length=sum(known) if known else None,
        whole=len(known) == len(lengths),
        sizes=tuple(_changes(size for arc in run for size in arc.sizes)),
        diameters=tuple(_changes(arc.edge.diameter for arc in run)),
        flow=_flow_of(flows, all(network.is_dead(arc) for arc in run)),
        reasons=tuple(dict.fromkeys(arc.edge.reason for arc in run if arc.edge.reason)),
        confidence=min(confidences) if confidences else None,
        system=network.system(run[0].start),
        arcs=tuple(run),
    )


def _carries_start(network: Network, run: list[Arc]) -> bool:
    """Whether the line is a ring that starts at a junction of instrument taps, which then stand in it."""
    return run[0].start == run[-1].end and not divides(network, run[0].start)


def _flow_of(flows: set[Flow], dead: bool) -> LineFlow:
    if "along" in flows and "against" in flows:
        return "contradictory"
    # Nothing branches off a line, so what flows in one part of it flows in all.
    if "along" in flows:
        return "forward"
    if "against" in flows:
        return "backward"
    return "none" if dead else "unknown"


def _changes(values: Iterable[_Number | None]) -> list[_Number]:
    found: list[_Number] = []
    for value in values:
        if value is not None and (not found or found[-1] != value):
            found.append(value)
    return found


def _order(line: Line) -> tuple[object, ...]:
    ends = tag_key(line.start_name), tag_key(line.start_port or ""), tag_key(line.end_name)
    return tag_key(line.system or "~"), *ends, tag_key(line.end_port or ""), line.tag
