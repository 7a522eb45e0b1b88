"""Which valves cut a unit off: the first question before anybody opens it."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from cadgraph._io.text import tag_key
from cadgraph.errors import Unconnected
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal
from cadgraph.query.doubt import Doubt, few_ports, open_sides
from cadgraph.query.lines import find_lines
from cadgraph.query.network import Arc, Network

__all__ = ["Closing", "Isolation", "Opening", "find_isolation"]

# What stands for more than a hand-operated shut-off: a control valve may leak and moves by itself, so that rules of
# lockout and tagout (OSHA 29 CFR 1910.147, EN ISO 14118) don't take it for an isolating device.
_NOT_ISOLATING = ("control",)
_CHECK = "check"
PASSED_OVER = "is a check valve: passed over"
_RELIEF = ("relief", "safety")


@dataclass(frozen=True)
class Closing:
    """A valve to close.

    Args:
        place: its id.
        name: its tag.
        what: its kind, or ``valve``.
        port: nozzle of the unit that it is reached by.
        distance: along the pipes from the unit [m].
        line: tag of the line that it stands in, on the side of the unit.
        automatic: whether it is a check valve, which closes by itself.
    """

    place: str
    name: str
    what: str
    port: str | None
    distance: float
    line: str | None
    automatic: bool = False


@dataclass(frozen=True)
class Opening:
    """A way to the unit that no valve closes.

    Args:
        place: id of where it leads.
        name: tag of that.
        what: what that is.
        port: nozzle of the unit that it is reached by.
        distance: along the pipes from the unit [m].
        why: what is wrong with it, in words.
    """

    place: str
    name: str
    what: str
    port: str | None
    distance: float
    why: str


@dataclass(frozen=True)
class Isolation:
    """The answer.

    Args:
        target: id of what is to be isolated.
        name: its tag.
        valves: to close, the nearest first.
        openings: what can't be isolated.
        doubts: what may feed the unit without having been found: units of the section with fewer lines than their kind
            needs, and joints at it that were not made although much speaks for them.
        shut_off: ids of the units that lie in the isolated section too, the nearest first.
        shut_off_names: their tags.
        lines: tags of the lines in the section, wholly or in part.
        connections: numbers of the graph's connections in the section.
        remarks: what the reader should know, a sentence each.
    """

    target: str
    name: str
    valves: tuple[Closing, ...]
    openings: tuple[Opening, ...]
    doubts: tuple[Doubt, ...]
    shut_off: tuple[str, ...]
    shut_off_names: tuple[str, ...]
    lines: tuple[str, ...]
    connections: tuple[int, ...]
    remarks: tuple[str, ...]

    @property
    def isolated(self) -> bool | None:
        """Whether the valves isolate the unit wholly; None where nobody can tell."""
        if self.openings:
            return False
        return None if self.doubts else True


@dataclass(frozen=True)
class _Reached:
    distance: float
    arc: Arc  # that it was reached by
    port: str | None


def find_isolation(
    graph: SceneGraph | Network, target: str, *, check_valves: bool = False, fewest: bool = False
) -> Isolation:
    """The valves that isolate a unit, on every one of its ports.

    By default the nearest valve on every way out, so that as little as possible is shut off with it; a valve behind
    which nothing can flow (a blind end, an instrument) need not be closed, one of which only one side is known must.
    Control valves never count as isolating, relief valves are taken for closed and never asked to be blocked. A tank is
    a source: the section ends there, valve or not.

    Args:
        graph: the finished graph, or its network.
        target: tag or id.
        check_valves: whether a check valve counts that the flow leaves the unit through.
        fewest: rather the smallest set of valves (a minimum node cut between the unit and all tanks and open ends),
            the nearest of those, although it may shut off more.

    Raises:
        Unconnected: no line was found at the unit, which is a ``ValueError``: that doesn't say that nothing feeds it.
        ValueError: nothing is called so.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    start = network.find(target)
    if not network.arcs(start):
        raise Unconnected(network.name(start), "what isolates it")
    section = _close_off(network, start, check_valves, fewest)
    line_of = {arc.index: line.tag for line in find_lines(network) for arc in line.arcs}
    inside = [place for place in section.inside() if network.unit_type(place) not in (None, "tank")]
    return Isolation(
        target=section.start,
        name=network.name(section.start),
        valves=tuple(
            _closing(network, place, section.reached[place], line_of)
            for place in section.nearest
            if place in section.needed
        ),
        openings=tuple(
            opening
            for place in section.inside()
            if (opening := _opening(network, place, section.reached[place])) is not None
        ),
        doubts=open_sides(network, _own(network, section), "feeds"),
        shut_off=tuple(inside),
        shut_off_names=tuple(network.name(place) for place in inside),
        lines=_lines(network, section, line_of),
        connections=_connections(network, section),
        remarks=_remarks(network, section, check_valves),
    )


@dataclass(frozen=True)
class _Section:
    """What is cut off.

    Args:
        start: the unit to be isolated.
        reached: all that something can come from to it, the walls included.
        nearest: the same, the nearest first.
        walls: where the section ends.
        region: the nodes within, the start included.
        needed: the walls that have to be closed.
    """

    start: str
    reached: Mapping[str, _Reached]
    nearest: tuple[str, ...]
    walls: frozenset[str]
    region: frozenset[str]
    needed: tuple[str, ...]

    def inside(self) -> list[str]:
        """The nodes within but for the start, the nearest first."""
        return [place for place in self.nearest if place in self.region]


def _close_off(network: Network, start: str, check_valves: bool, fewest: bool) -> _Section:
    """Finds the walls around a unit: the nearest barriers, or the fewest."""
    barriers = {place for place in network.places if place != start and _isolates(network, place)}
    if fewest:
        barriers = _smallest(network, start, barriers, check_valves)
    reached, walls = _flood(network, start, barriers, check_valves)
    region = {start, *(place for place in reached if place not in walls)}
    needed = [place for place in walls if not _is_relief(network, place) and _is_fed(network, place, region, walls)]
    nearest = sorted(reached, key=lambda place: (reached[place].distance, tag_key(network.name(place))))
    return _Section(start, reached, tuple(nearest), frozenset(walls), frozenset(region), tuple(needed))


def _own(network: Network, section: _Section) -> list[str]:
    """The nodes of a section, the start first, without tanks beside it, whose other lines don't belong to it."""
    return [section.start, *(place for place in section.inside() if network.unit_type(place) != "tank")]


def _lines(network: Network, section: _Section, line_of: Mapping[int, str]) -> tuple[str, ...]:
    """The tags of the lines of a section; the pipes at a tank beside it don't belong to it."""
    tags = {line_of[index] for index in _connections(network, section) if index in line_of}
    return tuple(sorted(tags, key=tag_key))


def _connections(network: Network, section: _Section) -> tuple[int, ...]:
    return tuple(sorted({arc.index for place in _own(network, section) for arc in network.arcs(place)}))


def _kind(network: Network, place: str) -> str:
    return network.what(place).casefold() if network.is_valve(place) else ""


def _is_relief(network: Network, place: str) -> bool:
    return any(word in _kind(network, place) for word in _RELIEF)


def _isolates(network: Network, place: str) -> bool:
    kind = _kind(network, place)
    return bool(kind) and not any(word in kind for word in (*_NOT_ISOLATING, _CHECK, *_RELIEF))


def _holds_back(network: Network, arc: Arc) -> bool:
    """Whether an arc away from the unit enters a check valve against which nothing comes back."""
    if _CHECK not in _kind(network, arc.end):
        return False
    # The flow through a valve is one: known on its far side, it is known on this one.
    beyond = any(onward.flow == "along" for onward in network.arcs(arc.end) if onward.index != arc.index)
    return arc.flow == "along" or (arc.flow == "unknown" and beyond)


def _flood(
    network: Network, start: str, barriers: set[str], check_valves: bool
) -> tuple[dict[str, _Reached], set[str]]:
    """All that something can come from to the unit, with the distance, and the walls where that ends."""
    reached: dict[str, _Reached] = {}
    walls: set[str] = set()
    settled: set[str] = set()
    queue: list[tuple[float, int, str, str | None, Arc | None]] = [(0.0, 0, start, None, None)]
    count = 0
    while queue:
        distance, _, place, port, arc = heapq.heappop(queue)
        if place in settled:
            continue
        settled.add(place)
        if arc is not None:
            reached[place] = _Reached(distance, arc, port)
            blocked = check_valves and _holds_back(network, arc)
            if place in barriers or blocked or _is_relief(network, place):
                walls.add(place)
                continue
            if network.unit_type(place) == "tank":
                continue
        for onward in network.arcs(place):
            count += 1
            entry = onward.start_port if arc is None else port
            heapq.heappush(queue, (distance + (onward.length or 0.0), count, onward.end, entry, onward))
    return reached, walls


def _is_fed(network: Network, wall: str, region: Collection[str], walls: Collection[str]) -> bool:
    """Whether anything behind a valve could flow to it: an end that isn't blind, a tank, a pump, other equipment.

    What lies behind a valve of which only one side is known, nobody knows.
    """
    if few_ports(network, wall) is not None:
        return True
    seen, stack = {wall}, [arc.end for arc in network.arcs(wall)]
    while stack:
        place = stack.pop()
        if place in seen or place in region or place in walls:
            continue
        seen.add(place)
        node = network.places[place]
        if isinstance(node, Terminal):
            if node.kind != "blind":
                return True
            continue
        if network.unit_type(place) not in (None, "valve", "gauge") or few_ports(network, place) is not None:
            return True
        stack += [arc.end for arc in network.arcs(place)]
    return False


def _smallest(network: Network, start: str, barriers: set[str], check_valves: bool) -> set[str]:
    """The smallest set of barriers between the unit and all sources that barriers can keep off."""
    import networkx

    reached, _ = _flood(network, start, barriers, check_valves)
    sources = [(p, "out") for p in network.places if p != start and _is_source(network, p) and p not in reached]
    # A valve of which only one side is known keeps off what may lie behind it.
    sources += [(p, "in") for p in network.places if p in barriers and few_ports(network, p) is not None]
    flow: networkx.DiGraph[tuple[str, str]] = networkx.DiGraph()
    origin, sink = ("", "all sources"), (start, "in")
    flow.add_nodes_from((origin, sink))
    for place in network.places:
        if place in barriers:
            flow.add_edge((place, "in"), (place, "out"), capacity=1)
        elif not _is_relief(network, place) and network.unit_type(place) != "tank":
            flow.add_edge((place, "in"), (place, "out"))
        for arc in network.arcs(place):
            # What flows to the unit walks the arc's way; a check valve lets it out only the way it opens.
            if not (check_valves and _holds_back(network, arc.back)):
                flow.add_edge((arc.start, "out"), (arc.end, "in"))
    flow.add_edges_from((origin, source) for source in sources)
    # Seen from the unit, so that of equally small sets the nearest one is found.
    # The set is small where there is one, which this algorithm is quick at.
    augment = networkx.algorithms.flow.shortest_augmenting_path
    _, (_, near) = networkx.minimum_cut(flow, origin, sink, flow_func=augment)
    return {place for place in barriers if (place, "out") in near and (place, "in") not in near}


def _is_source(network: Network, place: str) -> bool:
    node = network.places[place]
    return network.unit_type(place) == "tank" or (isinstance(node, Terminal) and node.kind != "blind")


def _closing(network: Network, place: str, reached: _Reached, line_of: Mapping[int, str]) -> Closing:
    return Closing(
        place=place,
        name=network.name(place),
        what=network.what(place),
        port=reached.port,
        distance=reached.distance,
        line=line_of.get(reached.arc.index),
        automatic=_CHECK in _kind(network, place),
    )


def _opening(network: Network, place: str, reached: _Reached) -> Opening | None:
    node = network.places[place]
    if network.unit_type(place) == "tank":
        why = "no valve between; empty it, or isolate it as well"
    elif isinstance(node, Terminal) and node.kind == "open":
        why = "open end with no valve before it"
    elif isinstance(node, Terminal) and node.kind == "unknown":
        why = "end of the modelled pipe with no valve before it; what follows is not known"
    else:
        return None
    return Opening(place, network.name(place), network.what(place), reached.port, reached.distance, why)


def _remarks(network: Network, section: _Section, check_valves: bool) -> tuple[str, ...]:
    places = sorted((section.region | section.walls) - {section.start}, key=lambda place: tag_key(network.name(place)))
    told = [
        f"{network.name(place)} {remark}"
        for place in places
        if (remark := _remark(network, section, place, check_valves)) is not None
    ]
    guessed = sorted((network.name(p) for p in section.needed if network.what(p) == "valve"), key=tag_key)
    if guessed:
        told.append(f"{', '.join(guessed)}: kind not known, taken for shut-off valves")
    return tuple(told)


def _remark(network: Network, section: _Section, place: str, check_valves: bool) -> str | None:
    """What should be known about a node of the section or at its end, if anything."""
    kind, arc = _kind(network, place), section.reached[place].arc
    if place in section.walls:
        if _is_relief(network, place):
            return "is a relief valve: taken for closed, not to be blocked"
        if few_ports(network, place) is not None:
            return "has a line on one side only: what lies behind it is not known"
        needless = place not in section.needed and not network.is_tap(arc)
        return "need not be closed: nothing can flow from behind it" if needless else None
    if _CHECK in kind and not check_valves:
        return PASSED_OVER
    if _CHECK in kind and arc.flow == "unknown":
        return "is a check valve, but which way it lets through is not known"
    if any(word in kind for word in _NOT_ISOLATING):
        return "is a control valve: not counted as isolating"
    return None
