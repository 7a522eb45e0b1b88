"""The connections between units, junctions and terminals, ready to be walked."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

from cadgraph._io.text import tag_key
from cadgraph.model.records import Connected, Junction, Node, Point, Terminal, Unit

__all__ = ["Arc", "Direction", "Flow", "Follow", "Pipework", "Place", "check_direction"]

Flow = Literal["along", "against", "unknown"]
Direction = Literal["downstream", "upstream"]
Place = Unit | Junction | Terminal

_FILLED = frozenset({"tank", "pump", "equipment"})  # what holds or moves what is in the lines
_WIDEST_TAP = 80  # DN; instruments are tapped by 15 to 50, level transmitters with a remote seal by up to 80


@dataclass(frozen=True)
class Arc:
    """One connection, walked one way.

    Args:
        index: of the connection, among all of the network.
        edge: the connection.
        forward: whether it is walked from its source to its target.
    """

    index: int
    edge: Connected
    forward: bool

    @property
    def start(self) -> str:
        """Id of the node that is left."""
        return self.edge.source if self.forward else self.edge.target

    @property
    def end(self) -> str:
        """Id of the node that is reached."""
        return self.edge.target if self.forward else self.edge.source

    @property
    def start_port(self) -> str | None:
        """The port that is left by."""
        return self.edge.source_port if self.forward else self.edge.target_port

    @property
    def end_port(self) -> str | None:
        """The port that is entered by."""
        return self.edge.target_port if self.forward else self.edge.source_port

    @property
    def flow(self) -> Flow:
        """Whether the flow goes the way that is walked."""
        if self.edge.direction == "unknown":
            return "unknown"
        return "along" if (self.edge.direction == "forward") == self.forward else "against"

    @property
    def via(self) -> tuple[str, ...]:
        """Ids of the parts between, in the order that it is walked."""
        return self.edge.via if self.forward else self.edge.via[::-1]

    @property
    def path(self) -> tuple[Point, ...]:
        """The centreline in the order that it is walked."""
        return self.edge.path if self.forward else self.edge.path[::-1]

    @property
    def sizes(self) -> tuple[int, ...]:
        """Nominal sizes (DN) in the order that it is walked, each change once; empty where none is known."""
        found = self.edge.sizes or ((self.edge.size,) if self.edge.size is not None else ())
        return found if self.forward else found[::-1]

    @property
    def length(self) -> float | None:
        """Along the centreline [m]; of the polyline where no length is given, None where that is missing too."""
        if self.edge.length is not None:
            return self.edge.length
        steps = pairwise(self.edge.path)
        return sum(math.dist(a, b) for a, b in steps) if len(self.edge.path) > 1 else None

    @property
    def back(self) -> Arc:
        """The same connection, walked the other way."""
        return Arc(self.index, self.edge, not self.forward)


Follow = Callable[[Arc], bool]


class Pipework:
    """All ``connected`` edges of a graph with their nodes.

    Args:
        nodes: of the graph, in the order of the file.
        edges: connections, in the order of the file.
    """

    def __init__(self, nodes: Iterable[Node], edges: Iterable[Connected]) -> None:
        self.places: Mapping[str, Place] = {n.id: n for n in nodes if isinstance(n, Unit | Junction | Terminal)}
        """Everything that can stand in a line: all units, junctions and terminals by id, in the order of the file."""
        self.edges: tuple[Connected, ...] = tuple(edges)

    @cached_property
    def _arcs(self) -> dict[str, tuple[Arc, ...]]:
        found: dict[str, list[Arc]] = {place: [] for place in self.places}
        for index, edge in enumerate(self.edges):
            for arc in (Arc(index, edge, True), Arc(index, edge, False)):
                found[arc.start].append(arc)
        return {place: tuple(sorted(arcs, key=self._order)) for place, arcs in found.items()}

    def arcs(self, place: str) -> tuple[Arc, ...]:
        """The connections that leave a node, in the natural order of what they lead to.

        A connection from a node to itself is there twice, once each way.
        """
        return self._arcs[place]

    def name(self, place: str) -> str:
        """What people call a node: the tag of a unit, else the id."""
        node = self.places[place]
        return node.tag if isinstance(node, Unit) else node.id

    def what(self, place: str) -> str:
        """What a node is, in words: its kind where that is known, else its type."""
        node = self.places[place]
        if isinstance(node, Unit):
            return node.kind or node.unit_type
        if isinstance(node, Terminal):
            return {"open": "open end", "blind": "blind end", "unknown": "end of pipe"}[node.kind]
        return node.layer

    def unit_type(self, place: str) -> str | None:
        """The type of a unit; None for junctions and terminals."""
        node = self.places[place]
        return node.unit_type if isinstance(node, Unit) else None

    def is_gauge(self, place: str) -> bool:
        """Whether a node is an instrument, which hangs at its line and carries no flow."""
        return self.unit_type(place) == "gauge"

    def is_valve(self, place: str) -> bool:
        """Whether a node is a valve of any kind."""
        return self.unit_type(place) == "valve"

    # Instruments and dead ends

    @cached_property
    def _taps(self) -> frozenset[int]:
        return frozenset(
            index
            for place in self.places
            if self.is_gauge(place) and len(self.arcs(place)) == 1 and not self.ends_line(place)
            for index in self._tap_from(self.arcs(place)[0])
        )

    def ends_line(self, place: str) -> bool:
        """Whether a gauge is all that was found at the end of a line too wide for a tap (more than DN 80).

        What is taken for a gauge there may be something else, and the line may go on behind it.
        """
        arcs = self.arcs(place)
        return self.is_gauge(place) and len(arcs) == 1 and max(arcs[0].sizes, default=0) > _WIDEST_TAP

    def is_tap(self, arc: Arc) -> bool:
        """Whether a connection leads to nothing but an instrument.

        It carries no flow: its direction means nothing, and it doesn't divide the line that it branches
        from. That is a gauge at the end of a branch, with the valves and gauges between it and the branching.
        """
        return arc.index in self._taps

    @cached_property
    def _dead(self) -> frozenset[int]:
        found: set[int] = set()
        for place, node in self.places.items():
            if isinstance(node, Terminal) and node.kind == "blind" and len(self.arcs(place)) == 1:
                found.update(arc.index for arc in self._back_from(self.arcs(place)[0]))
        return frozenset(found)

    def is_dead(self, arc: Arc) -> bool:
        """Whether a connection leads to nothing but a blind end, so that nothing flows there."""
        return arc.index in self._dead

    def _back_from(self, arc: Arc) -> list[Arc]:
        """From an end back over valves and gauges to where the line branches off."""
        way = [arc]
        while (self.is_valve(arc.end) or self.is_gauge(arc.end)) and len(self.arcs(arc.end)) == 2:
            onward = [other for other in self.arcs(arc.end) if other.index != arc.index]
            if not onward:
                break
            arc = onward[0]
            way.append(arc)
        return way

    def _tap_from(self, arc: Arc) -> list[int]:
        """The connections from a gauge at an end back to where it branches off."""
        way = self._back_from(arc)
        last = way[-1].end
        # A run that ends in a gauge without having branched off anything is a line of its own, not a tap.
        branches_off = isinstance(self.places[last], Junction) or self._is_vessel(last)
        return [step.index for step in way] if branches_off else []

    def _is_vessel(self, place: str) -> bool:
        return isinstance(self.places[place], Unit) and not self.is_valve(place) and not self.is_gauge(place)

    # Walking

    def follower(self, direction: Direction | None, through_unknown: bool = False) -> Follow:
        """Whether a connection is walked: with the flow, or against it; those of instruments either way.

        Args:
            direction: which way; None walks every connection both ways.
            through_unknown: whether connections of unknown direction are walked both ways.
        """
        if direction is None:
            return lambda arc: True
        wanted = {"along" if direction == "downstream" else "against", *(("unknown",) if through_unknown else ())}
        return lambda arc: self.is_tap(arc) or arc.flow in wanted

    def shortest(self, start: str, follows: Follow) -> tuple[dict[str, float], dict[str, tuple[Arc, ...]]]:
        """The shortest way along the pipes to everything that can be reached.

        An unknown length counts as none. Of ways of the same length the one of fewer connections is taken, of those
        the first in the natural order of tags (Dijkstra's algorithm).

        Args:
            start: id of where it begins.
            follows: whether a connection is walked.

        Returns:
            The distance [m] and the connections in order, by id of the node; the start included.
        """
        distances: dict[str, float] = {}
        ways: dict[str, tuple[Arc, ...]] = {}
        queue: list[tuple[float, int, int, str, Arc | None]] = [(0.0, 0, 0, start, None)]
        count = 0
        while queue:
            distance, steps, _, place, last = heapq.heappop(queue)
            if place in distances:
                continue
            distances[place] = distance
            ways[place] = () if last is None else (*ways[last.start], last)
            for arc in self.arcs(place):
                if arc.end not in distances and follows(arc):
                    count += 1
                    heapq.heappush(queue, (distance + (arc.length or 0.0), steps + 1, count, arc.end, arc))
        return distances, ways

    def units_around(self, start: str, follows: Follow) -> set[str]:
        """Ids of the units that are reached without another unit between; junctions are walked through."""
        found: set[str] = set()
        seen, waiting = {start}, [start]
        while waiting:
            for arc in self.arcs(waiting.pop()):
                if arc.end in seen or not follows(arc):
                    continue
                seen.add(arc.end)
                if isinstance(self.places[arc.end], Unit):
                    found.add(arc.end)
                else:
                    waiting.append(arc.end)
        return found

    def ports_in_use(self, place: str) -> int:
        """How many ports of a unit have a line; a connection that names no port counts as a port of its own.

        A gauge that sits on a tap of a run stands in it by one port with two connections, which count each. What leads
        from a vessel or a machine to nothing but an instrument is no line of it.
        """
        arcs = self.arcs(place)
        if self.is_gauge(place):
            return len(arcs)
        if self.unit_type(place) in _FILLED:
            arcs = tuple(arc for arc in arcs if not self.is_tap(arc))
        named = {arc.start_port for arc in arcs if arc.start_port is not None}
        return len(named) + sum(arc.start_port is None for arc in arcs)

    def stands_aside(self, place: str) -> bool:
        """Whether a unit sits on the side of a run, where what flows passes it by.

        It stands in the run by one port with several connections, as a gauge on a tap does: a valve there closes what
        lies behind its other side, not the run.
        """
        arcs = self.arcs(place)
        ports = {arc.start_port for arc in arcs}
        return isinstance(self.places[place], Unit) and len(arcs) > 1 and len(ports) == 1 and None not in ports

    def _order(self, arc: Arc) -> tuple[object, ...]:
        return tag_key(self.name(arc.end)), tag_key(arc.start_port or ""), arc.index, arc.forward


def check_direction(direction: str | None) -> None:
    """Makes sure that a direction is one.

    Raises:
        ValueError: it is neither ``downstream`` nor ``upstream`` nor None.
    """
    if direction not in (None, "downstream", "upstream"):
        raise ValueError(f"direction {direction!r}: give 'downstream', 'upstream', or None for both ways")
