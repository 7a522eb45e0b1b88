"""What is known of a plant, in one form for the truth and for a graph, so that the same solvers run on both."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Junction, Point, Terminal
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth, TruthUnit
from cadgraph.query.doubt import few_ports, likely_joints
from cadgraph.query.duty import duty_of
from cadgraph.query.network import Network
from cadlab.agentbench.people import Reached, reach_of_graph, reach_of_truth
from cadlab.evaluate.pairing import pair
from cadlab.evaluate.units import match_units

__all__ = ["Fact", "Facts", "Link", "facts_of_graph", "facts_of_truth"]

Flow = Literal["along", "against", "unknown"]
_SHUTTING = ("ball", "gate", "globe", "butterfly", "plug", "needle", "diaphragm")
_NOT_SHUTTING = ("check", "control", "relief", "safety", "three-way")  # "ball check valve"
# What a truth knows that no geometry shows, so that no question may rest on it: where a run comes from, and which way a
# swing check valve lets through, which the generator draws the same from both sides. Behind a pump it shows.
_NOT_IN_GEOMETRY = ("comes from a well", "a valve in it lets flow pass one way only")
_TURNED: dict[Flow, Flow] = {"along": "against", "against": "along", "unknown": "unknown"}

_Row = tuple[str, str, float | None, Literal["forward", "backward", "unknown"]]
"""Ids of both ends, length [m], direction of the flow."""


@dataclass(frozen=True)
class Fact:
    """A unit, a branching or the end of a pipe.

    Args:
        id: unique in its plant.
        name: the tag that the graph calls it by. A true unit that the graph lacks has a name that no tag is like.
        type: of a unit (``valve``, ``pump``...), else ``junction``, ``open``, ``blind`` or ``end``: an end of which
            nobody knows whether it is open.
        kind: of a unit, or None.
        middle: of a unit, the middle of its surface [m]; None where it isn't known.
        shuts: whether it is a valve to isolate by: closed by hand, and known to shut off.
        short: whether it has fewer lines than its kind needs, so that something may lead to it that was not found.
        aside: whether it sits on the side of a run, all lines on one port: closing it doesn't close the run.
    """

    id: str
    name: str
    type: str
    kind: str | None = None
    middle: Point | None = None
    shuts: bool = False
    short: bool = False
    aside: bool = False

    @property
    def is_relief(self) -> bool:
        """Whether it is a valve that is shut anyway and must not be blocked."""
        return self.type == "valve" and any(word in (self.kind or "") for word in ("relief", "safety"))

    @property
    def is_unit(self) -> bool:
        """Whether it is one that has a tag."""
        return self.type not in ("junction", "open", "blind", "end")

    @property
    def is_equipment(self) -> bool:
        """Whether it is a unit that neither shuts nor measures: a pump, a tank..."""
        return self.is_unit and self.type not in ("valve", "gauge")


@dataclass(frozen=True)
class Link:
    """A connection as it is left from one of its ends.

    Args:
        number: of the connection; both its sides have the same.
        end: id of what it leads to.
        length: along the centreline [m]; None where it isn't known.
        flow: whether the flow goes the way that is walked.
    """

    number: int
    end: str
    length: float | None
    flow: Flow


@dataclass(frozen=True)
class Facts:
    """A plant as far as questions go.

    Args:
        nodes: by id.
        links: what leaves each node.
        loose: pairs of nodes between which there may be a connection that was not found.
        reached: how people get at each unit, where anything is known of that.
    """

    nodes: Mapping[str, Fact]
    links: Mapping[str, tuple[Link, ...]]
    loose: tuple[tuple[str | None, str | None], ...] = ()
    reached: Mapping[str, Reached] = field(default_factory=dict)

    @cached_property
    def units(self) -> tuple[Fact, ...]:
        """All units, by name."""
        return tuple(sorted((node for node in self.nodes.values() if node.is_unit), key=lambda unit: unit.name))

    @cached_property
    def _by_name(self) -> dict[str, str]:
        return {unit.name: unit.id for unit in self.units}

    def reach_of(self, name: str) -> Reached:
        """How people get at the unit of this name, as far as that is known."""
        return self.reached.get(self.id_of(name), Reached())

    def id_of(self, name: str) -> str:
        """The id of the unit of this name.

        Raises:
            KeyError: there is none.
        """
        return self._by_name[name]

    @cached_property
    def dead(self) -> frozenset[int]:
        """Numbers of the connections that lead to nothing but gauges and blind ends, so that nothing flows there."""
        open_links = {node: {link.number for link in links} for node, links in self.links.items()}
        ends = {link.number: (node, link.end) for node, links in self.links.items() for link in links}
        waiting = [node for node in self.nodes if self._may_be_dead(node) and len(open_links[node]) == 1]
        found: set[int] = set()
        while waiting:
            node = waiting.pop()
            for number in list(open_links[node]):
                found.add(number)
                for end in ends[number]:
                    open_links[end].discard(number)
                    if len(open_links[end]) == 1 and self._may_pass_dead(end):
                        waiting.append(end)
        return frozenset(found)

    def _may_be_dead(self, node: str) -> bool:
        return self.nodes[node].type in ("gauge", "blind")

    def _may_pass_dead(self, node: str) -> bool:
        # A valve before a gauge or a blind end carries nothing either; what has but one line in all isn't dead.
        return self.nodes[node].type in ("gauge", "valve", "junction") and len(self.links[node]) > 1

    @cached_property
    def taps(self) -> frozenset[int]:
        """Numbers of the connections of gauges that hang beside a line, their root valves included."""
        found: set[int] = set()
        for gauge in self.nodes.values():
            if gauge.type == "gauge" and len(self.links[gauge.id]) == 1:
                found |= self._tap(gauge.id)
        return frozenset(found)

    def _tap(self, gauge: str) -> set[int]:
        link = self.links[gauge][0]
        numbers = {link.number}
        node = self.nodes[link.end]
        while node.type in ("gauge", "valve") and len(self.links[node.id]) == 2:
            onward = [other for other in self.links[node.id] if other.number not in numbers]
            if not onward:
                break
            numbers.add(onward[0].number)
            node = self.nodes[onward[0].end]
        # A run that ends in a gauge without having branched off anything is a line of its own.
        return numbers if node.type == "junction" or node.is_equipment else set()


def facts_of_truth(truth: Truth, scene: Scene, graph: SceneGraph) -> Facts:
    """What is known for certain, with the tags that a graph of the same scene uses.

    Args:
        truth: of the scene.
        scene: that both are of.
        graph: whose tags are used: those of the units that stand for the true ones.
    """
    tag_of = {graph_unit.id: graph_unit.tag for graph_unit in graph.units()}
    match = match_units(pair(graph, truth))
    called = {true: tag_of[unit] for unit, true in match.true_of.items()}
    measured = measure(scene)
    row = {path: i for i, path in enumerate(scene.paths)}
    nodes: dict[str, Fact] = {}
    for unit in truth.units or ():
        index = np.array([row[mesh] for mesh in unit.meshes if mesh in row], np.int64)
        name = called.get(unit.id, f"({unit.tag or unit.id}: not in the graph)")
        middle = _middle(measured.centroid[index] + scene.origin, measured.area[index]) if len(index) else None
        nodes[unit.id] = Fact(unit.id, name, unit.type, unit.kind, middle, _shuts(unit))
    for point in truth.points:
        type_ = "junction" if point.kind == "junction" else point.end or "end"
        nodes[point.id] = Fact(point.id, point.id, type_)
    rows: list[_Row] = [
        (one.source, one.target, one.length, "unknown" if one.reason in _NOT_IN_GEOMETRY else one.direction)
        for one in truth.connections or ()
    ]
    boxes = measured.aabb + scene.origin
    return Facts(nodes, _links(nodes, rows), reached=reach_of_truth(truth, scene.paths, boxes))


def _shuts(unit: TruthUnit) -> bool:
    kind = unit.kind or ""
    refused = any(word in kind for word in _NOT_SHUTTING)
    return unit.type == "valve" and not refused and any(word in kind for word in _SHUTTING)


def facts_of_graph(graph: SceneGraph) -> Facts:
    """What a graph says, and where it says that something may be missing."""
    network = Network(graph)
    nodes: dict[str, Fact] = {}
    connected = list(graph.of_kind(Connected))
    ports: dict[str, list[str | None]] = {unit.id: [] for unit in graph.units()}
    for one in connected:
        for unit_id, port in ((one.source, one.source_port), (one.target, one.target_port)):
            ports.setdefault(unit_id, []).append(port)
    for unit in graph.units():
        short = few_ports(network, unit.id) is not None
        shuts = duty_of(network, unit.id) in ("shuts off", "likely")
        used = ports[unit.id]
        aside = len(used) > 1 and used[0] is not None and set(used) == {used[0]}
        nodes[unit.id] = Fact(unit.id, unit.tag, unit.unit_type, unit.kind, unit.centroid, shuts, short, aside)
    for junction in graph.of_layer(Junction):
        nodes[junction.id] = Fact(junction.id, junction.id, "junction")
    for terminal in graph.of_layer(Terminal):
        type_ = "end" if terminal.kind == "unknown" else terminal.kind
        nodes[terminal.id] = Fact(terminal.id, terminal.id, type_)
    rows: list[_Row] = [(one.source, one.target, one.length, one.direction) for one in connected]
    loose = tuple((_holder(network, j.first), _holder(network, j.second)) for j in likely_joints(network))
    return Facts(nodes, _links(nodes, rows), loose, reach_of_graph(graph))


def _holder(network: Network, part: str) -> str | None:
    """The node that a part belongs to, else one that its line starts from."""
    owner = network.owner_of_part(part)
    if owner is not None:
        return owner
    return next((edge.source for edge in network.edges if part in edge.via), None)


def _middle(
    centroids: np.ndarray[tuple[int, int], np.dtype[np.float64]], areas: np.ndarray[tuple[int], np.dtype[np.float64]]
) -> Point:
    weights = areas if areas.sum() > 0 else np.ones(len(areas))
    x, y, z = np.average(centroids, axis=0, weights=weights).tolist()
    return x, y, z


def _links(nodes: Mapping[str, Fact], rows: list[_Row]) -> dict[str, tuple[Link, ...]]:
    found: dict[str, list[Link]] = {node: [] for node in nodes}
    said: dict[str, Flow] = {"forward": "along", "backward": "against", "unknown": "unknown"}
    for number, (source, target, length, direction) in enumerate(rows):
        flow = said[direction]
        found[source].append(Link(number, target, length, flow))
        found[target].append(Link(number, source, length, _TURNED[flow]))
    return {node: tuple(links) for node, links in found.items()}
