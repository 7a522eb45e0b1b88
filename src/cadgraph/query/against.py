"""What stands against a piece of a network without being joined to it, and would be if a label were wrong.

A valve welded onto the side of a pipe, a nozzle that got no label, a ring between a tank and its line that is taken for
a clamp: the network has a gap there, and an answer about the piece would pass over what lies behind it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.ports import least_ports
from cadgraph.model.records import CUT, Part, Terminal, Unit
from cadgraph.model.vocabulary import FASTENERS
from cadgraph.query.network import Network

__all__ = ["Against", "is_gauge_by_place", "standing_against"]

_STEPS = 3  # so many loose parts at most lead from a piece to what stands against it
_NEAR = 0.005  # [m]; how far beyond its own radius an end lies from what it stands against at most
_DEVICES = frozenset({"valve", "pump"})
_PIPE = "pipe"
_MAYBE = 0.3  # of what a part without a label may be, the least probability that counts
_BODIES = frozenset({None, "valve", "valve body", "pump", "pump casing"})


@dataclass(frozen=True)
class Against:
    """Something that stands against a piece of a network.

    Args:
        inner: id of the part of the piece.
        over: ids of the loose parts that lie between, maybe none.
        place: id of the unit or end outside; None where a part that is likely a valve, a pump or a pipe is in none.
        part: id of the part of it.
    """

    inner: str
    over: tuple[str, ...]
    place: str | None
    part: str


def standing_against(network: Network, home: Mapping[str, str], places: Collection[str]) -> list[Against]:
    """The units with too few lines, and the ends of other lines, that stand against a piece of a network.

    Args:
        network: of a finished graph.
        home: the parts of the piece, each with the node that it belongs to.
        places: ids of the nodes of the piece.

    Returns:
        Each once, by the shortest way there, in the order of the parts.
    """
    return list(_Search(network, home, frozenset(places)).found())


def is_gauge_by_place(network: Network, place: str) -> bool:
    """Whether a gauge at the end of a line, or on something without a line, is one only because of where it stands: its
    shape did not say so.
    """
    node = network.places[place]
    ends = len(network.arcs(place)) <= 1 or network.stands_aside(place)
    if not isinstance(node, Unit) or not network.is_gauge(place) or not ends:
        return False
    labels = [label for part in node.parts if (label := network.graph.part(part).label) is not None]
    former = [label.evidence.before for label in labels if label.source == "network" and label.evidence is not None]
    return len(former) == len(labels) and any(one is None or one.group != labels[0].group for one in former)


@dataclass(frozen=True)
class _Search:
    network: Network
    home: Mapping[str, str]
    places: frozenset[str]

    @cached_property
    def _functional(self) -> frozenset[str]:
        """The groups of piping and of devices."""
        trees = self.network.graph.vocabulary
        return frozenset(name for name, tree in trees.items() if tree.get("connector") or tree.get("unit"))

    @cached_property
    def _cut(self) -> frozenset[frozenset[str]]:
        """The pairs of parts of which a user says that they don't join."""
        joints = self.network.open_joints
        return frozenset(frozenset((joint.first, joint.second)) for joint in joints if joint.reasons == (CUT,))

    @cached_property
    def _ends_at(self) -> dict[str, list[Terminal]]:
        """The ends outside that a part carries or lies against."""
        found: dict[str, list[Terminal]] = {}
        for place, node in self.network.places.items():
            if isinstance(node, Terminal) and node.kind != "blind" and place not in self.places:
                for part in {*node.parts, *(arc.via[0] for arc in self.network.arcs(place) if arc.via)}:
                    found.setdefault(part, []).append(node)
        return found

    def found(self) -> Iterator[Against]:
        told: set[str] = set()
        seen, nodes = set(self.home), self.network.graph.nodes
        front: list[tuple[str, str, tuple[str, ...]]] = [(part, part, ()) for part in sorted(self.home)]
        while front:
            onward = []
            for here, inner, over in front:
                before = nodes.get(here)
                if not isinstance(before, Part):
                    continue
                for other in self.network.graph.neighbors(before):
                    if other.id in seen or frozenset((here, other.id)) in self._cut:
                        continue
                    for place in self._stands(other, before):
                        if place not in told:
                            told.add(place)
                            yield Against(inner, over, place, other.id)
                    if not self._is_loose(other):
                        continue
                    seen.add(other.id)
                    # A pipe that stands against the piece itself has a joint that was judged.
                    if self._is_device(other) or (over and self._is_pipe(other)):
                        yield Against(inner, over, None, other.id)
                    elif len(over) < _STEPS:
                        onward.append((other.id, inner, (*over, other.id)))
            front = onward

    def _is_loose(self, part: Part) -> bool:
        """Whether a part is in no network and may belong into one: nobody is sure that it is something else."""
        if part.ground or part.id in self.network.carried:
            return False
        label = part.label
        if label is None:
            return True
        functional, holds = label.group in self._functional, label.name in FASTENERS
        return functional or not holds if label.likely else functional and not holds

    def _is_device(self, part: Part) -> bool:
        """Whether a loose part is likely all of a valve or a pump, or its body, or may be where it has no label."""
        if part.label is not None:
            return self._is_body(part.label.group, part.label.name)
        return _guessed(part, self._is_body)

    def _is_body(self, group: str, name: str | None) -> bool:
        """Whether a label is that of a valve or a pump, or of its body."""
        return self.network.graph.vocabulary.get(group, {}).get("unit") in _DEVICES and name in _BODIES

    def _is_pipe(self, part: Part) -> bool:
        """Whether a loose part is likely a pipe, or where it has no label may be some piece of piping or a device."""
        if part.label is not None:
            return part.label.name == _PIPE
        return _guessed(part, lambda group, _: group in self._functional)

    def _stands(self, part: Part, before: Part) -> Iterator[str]:
        """What a part belongs to that the piece may go on in: a unit that lacks a line, or an end that lies here."""
        owner = self.network.owner_of_part(part.id)
        unit = self.network.places[owner] if owner is not None else None
        if isinstance(unit, Unit) and unit.id not in self.places and self._lacks(unit):
            yield unit.id
        for end in self._ends_at.get(part.id, ()):
            if _lies_at(self.network, end, before):
                yield end.id

    def _lacks(self, unit: Unit) -> bool:
        """Whether a unit that no line joins to the piece has fewer lines than its kind needs; gauges end lines, but for
        those that are some only because a line ends at them.
        """
        network = self.network
        if any(arc.end in self.places for arc in network.arcs(unit.id)):
            return False
        if network.is_gauge(unit.id):
            return is_gauge_by_place(network, unit.id)
        return network.ports_in_use(unit.id) < least_ports(unit.unit_type, unit.kind)


def _guessed(part: Part, is_meant: Callable[[str, str | None], bool]) -> bool:
    """Whether the guesses about a part that are meant weigh enough together."""
    return sum(guess.confidence for guess in part.guesses if is_meant(guess.group, guess.name)) >= _MAYBE


def _lies_at(network: Network, end: Terminal, part: Part) -> bool:
    """Whether an end lies in the box around a part, or its own radius from it."""
    sizes = [arc.edge.diameter for arc in network.arcs(end.id) if arc.edge.diameter]
    reach = 0.5 * max(sizes, default=0.0) + _NEAR
    low, high = np.asarray(part.aabb)
    point = np.asarray(end.point)
    return bool((point >= low - reach).all() and (point <= high + reach).all())
