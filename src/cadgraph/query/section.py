"""The section around a unit that valves cut off: how far what flows can come, and where that has to end."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Literal

from cadgraph._io.text import tag_key
from cadgraph.model.records import Terminal
from cadgraph.query.doubt import few_ports
from cadgraph.query.duty import duty_of
from cadgraph.query.network import Arc, Network

__all__ = ["Reached", "Rules", "Section", "close_off", "is_fed", "is_source", "lets_through"]


@dataclass(frozen=True)
class Reached:
    """How a node is reached from the unit.

    Args:
        distance: along the pipes from the unit [m].
        arc: that it was reached by.
        port: of the unit, that the way begins at.
    """

    distance: float
    arc: Arc
    port: str | None


@dataclass(frozen=True)
class Rules:
    """Which valves of a network are relied on."""

    network: Network
    check_valves: bool
    assume_shutoff: bool

    def passes(self, place: str) -> bool:
        """Whether something comes through a node that is no barrier: past what sits on the side of a run it does."""
        network = self.network
        return network.stands_aside(place) or not (_is_relief(network, place) or network.unit_type(place) == "tank")

    def isolates(self, place: str) -> bool:
        """Whether a valve counts as shutting off."""
        duty = duty_of(self.network, place)
        return duty in ("shuts off", "likely") or (self.assume_shutoff and duty == "unknown")

    def holds_back(self, arc: Arc) -> bool:
        """Whether an arc away from the unit enters a check valve that counts, against which nothing comes back."""
        if not self.check_valves or duty_of(self.network, arc.end) != "check" or self.network.stands_aside(arc.end):
            return False
        return lets_through(self.network, arc) == "along"


@dataclass(frozen=True)
class Section:
    """What is cut off.

    Args:
        start: the unit to be isolated.
        reached: all that something can come from to it, the walls included.
        nearest: the same, the nearest first.
        walls: where the section ends.
        region: the nodes within, the start included.
        needed: the walls that have to be closed, and the valves on the sides of runs within that shut off.
        left: the nodes within once these are closed, the nearest first, without the start: with what lies behind walls
            that need not be closed, which are open.
        ports_to: the start's ports that each node can be reached from without a closed valve on the way.
    """

    start: str
    reached: Mapping[str, Reached]
    nearest: tuple[str, ...]
    walls: frozenset[str]
    region: frozenset[str]
    needed: tuple[str, ...]
    left: tuple[str, ...]
    ports_to: Mapping[str, tuple[str, ...]]

    def inside(self) -> list[str]:
        """The nodes within but for the start, the nearest first."""
        return [place for place in self.nearest if place in self.region]

    def way(self, place: str) -> list[str]:
        """The nodes between the start and a node, from the start on."""
        found: list[str] = []
        step = self.reached[place].arc.start
        while step != self.start:
            found.append(step)
            step = self.reached[step].arc.start
        return found[::-1]


def close_off(network: Network, start: str, rules: Rules, fewest: bool) -> Section:
    """Finds the walls around a unit.

    Args:
        network: of a finished graph.
        start: id of the unit.
        rules: which valves are relied on.
        fewest: whether the smallest set of valves is asked for in place of the nearest on every way.
    """
    closing = {place for place in network.places if place != start and rules.isolates(place)}
    barriers = {place for place in closing if not network.stands_aside(place)}
    if fewest:
        barriers = _smallest(network, start, barriers, rules)
    reached, walls = _flood(network, start, barriers, rules)
    region = {start, *(place for place in reached if place not in walls)}
    needed = [
        place for place in walls if not _is_relief(network, place) and is_fed(network, start, place, region, walls)
    ]
    # What a valve on the side of a run leads to was not found; nobody knows whether it feeds.
    needed += [place for place in reached if place in region and place in closing and network.stands_aside(place)]
    # What need not be closed stays open, and what lies behind it hangs together with the unit.
    open_to, shut = _flood(network, start, barriers.intersection(needed), rules)
    left = [place for place in _by_distance(network, open_to) if place not in shut]
    return Section(
        start=start,
        reached=reached,
        nearest=_by_distance(network, reached),
        walls=frozenset(walls),
        region=frozenset(region),
        needed=tuple(needed),
        left=tuple(left),
        ports_to=_ports_to(network, start, barriers, rules),
    )


def _ports_to(network: Network, start: str, barriers: set[str], rules: Rules) -> dict[str, tuple[str, ...]]:
    """The ports of the unit from which each node is reached, the barriers included; not on a way through the unit."""
    found: dict[str, list[str]] = {}
    ports = dict.fromkeys(arc.start_port for arc in network.arcs(start) if arc.start_port is not None)
    for port in sorted(ports, key=tag_key):
        reached, _ = _flood(network, start, barriers, rules, port)
        for place in reached:
            found.setdefault(place, []).append(port)
    return {place: tuple(named) for place, named in found.items()}


def _by_distance(network: Network, reached: Mapping[str, Reached]) -> tuple[str, ...]:
    return tuple(sorted(reached, key=lambda place: (reached[place].distance, tag_key(network.name(place)))))


def _flood(
    network: Network, start: str, barriers: set[str], rules: Rules, by: str | None = None
) -> tuple[dict[str, Reached], set[str]]:
    """All that something can come from to the unit (by one port if given), how far off, and the walls where it ends."""
    reached: dict[str, Reached] = {}
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
            reached[place] = Reached(distance, arc, port)
            if place in barriers or rules.holds_back(arc) or not rules.passes(place):
                if network.unit_type(place) != "tank":
                    walls.add(place)
                continue
        for onward in network.arcs(place):
            if arc is None and by is not None and onward.start_port != by:
                continue
            count += 1
            entry = onward.start_port if arc is None else port
            heapq.heappush(queue, (distance + (onward.length or 0.0), count, onward.end, entry, onward))
    return reached, walls


def is_fed(network: Network, start: str, wall: str, region: Collection[str], walls: Collection[str]) -> bool:
    """Whether anything behind a valve could flow to it: an end that isn't blind, a tank, a pump, other equipment.

    What lies behind a valve of which only one side is known, nobody knows.
    """
    if few_ports(network, wall) is not None:
        return True
    seen, stack = {wall}, [arc.end for arc in network.arcs(wall)]
    while stack:
        place = stack.pop()
        if place in seen or place == start:
            continue
        if network.unit_type(place) == "tank":
            # Also one that another way leads to, which is told as open: somebody may close that way by other means.
            return True
        if place in region or place in walls:
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


def _smallest(network: Network, start: str, barriers: set[str], rules: Rules) -> set[str]:
    """The smallest set of barriers between the unit and all that may feed or drive it and that barriers can keep off:
    also pumps and other equipment, as for the nearest valves.
    """
    import networkx

    reached, _ = _flood(network, start, barriers, rules)
    sources = [(p, "out") for p in network.places if p != start and _drives(network, p) and p not in reached]
    # A valve of which only one side is known keeps off what may lie behind it.
    sources += [(p, "in") for p in network.places if p in barriers and few_ports(network, p) is not None]
    flow: networkx.DiGraph[tuple[str, str]] = networkx.DiGraph()
    origin, sink = ("", "all sources"), (start, "in")
    flow.add_nodes_from((origin, sink))
    for place in network.places:
        if place in barriers:
            flow.add_edge((place, "in"), (place, "out"), capacity=1)
        elif rules.passes(place):
            flow.add_edge((place, "in"), (place, "out"))
        for arc in network.arcs(place):
            # What flows to the unit walks the arc's way; a check valve lets it out only the way it opens.
            if not rules.holds_back(arc.back):
                flow.add_edge((arc.start, "out"), (arc.end, "in"))
    flow.add_edges_from((origin, source) for source in sources)
    # Seen from the unit, so that of equally small sets the nearest one is found.
    # The set is small where there is one, which this algorithm is quick at.
    augment = networkx.algorithms.flow.shortest_augmenting_path
    _, (_, near) = networkx.minimum_cut(flow, origin, sink, flow_func=augment)
    return {place for place in barriers if (place, "out") in near and (place, "in") not in near}


def _drives(network: Network, place: str) -> bool:
    """Whether a node may feed, or make what is there flow."""
    return is_source(network, place) or network.unit_type(place) not in (None, "valve", "gauge")


def lets_through(network: Network, arc: Arc) -> Literal["along", "against"] | None:
    """Which way a valve lets through that a connection leads to: the flow through it is one, known on either side; None
    where nothing is known, or the two sides contradict each other.

    Args:
        network: of a finished graph.
        arc: that leads to the valve.
    """
    flows = {arc.flow, *(onward.flow for onward in network.main_arcs(arc.end) if onward.index != arc.index)}
    if {"along", "against"} <= flows:
        return None
    return "along" if "along" in flows else "against" if "against" in flows else None


def is_source(network: Network, place: str) -> bool:
    """Whether a node may feed: a tank, or an end that isn't blind."""
    node = network.places[place]
    return network.unit_type(place) == "tank" or (isinstance(node, Terminal) and node.kind != "blind")


def _is_relief(network: Network, place: str) -> bool:
    return duty_of(network, place) == "relief"
