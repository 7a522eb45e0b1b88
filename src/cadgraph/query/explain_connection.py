"""Why two units are connected, or what is missing between them: the joints on the way, made or not."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Joint, Part, Unit
from cadgraph.query.network import Arc, Network
from cadgraph.query.told_joint import ToldJoint, name_part, say_joint, tell_joint

if TYPE_CHECKING:
    import networkx

__all__ = ["ConnectionExplanation", "Nearest", "explain_connection"]

# A gauge stands in a run by the joints of its leg, which the connection doesn't name: so many are followed (ours).
_MOST_STEPS = 6
_IMPOSSIBLE = 1e-6  # a joint of no score is still likelier than none at all


@dataclass(frozen=True)
class Nearest:
    """The two parts of two pieces that are nearest to each other, where no joint between these was ever thought of.

    Args:
        first: id of the part on the one side.
        second: id of the part on the other side.
        what: label of each, or None.
        meshes: source path of the largest mesh of each.
        distance: between their surfaces where they touch or nearly do, else between their boxes [m].
        touching: whether they are in contact by the settings of the graph.
    """

    first: str
    second: str
    what: tuple[str | None, str | None]
    meshes: tuple[str, str]
    distance: float
    touching: bool


@dataclass(frozen=True)
class ConnectionExplanation:
    """Why two units are connected, or not.

    Args:
        start: tag of the one.
        end: tag of the other.
        connected: whether there is a way along the pipes.
        way: tags of the nodes on the shortest way, both ends included; empty where there is none.
        length: of the way along the centrelines [m], or None.
        joints: that were made on the way, in order from the start.
        unnamed: how many steps from part to part on the way the graph names no joint for.
        open_joints: where there is no way: the joints that would make one if they were made, the likeliest together,
            in order from the start. Empty where none was thought of.
        nearest: where there is no way and no such joint: the parts that are nearest to each other; None without parts.
        recorded: whether the graph names joints at all.
        mounted: tag of the one that has no line and of the other, that it is mounted at; None where none is.
    """

    start: str
    end: str
    connected: bool = False
    way: tuple[str, ...] = ()
    length: float | None = None
    joints: tuple[ToldJoint, ...] = ()
    unnamed: int = 0
    open_joints: tuple[ToldJoint, ...] = ()
    nearest: Nearest | None = None
    recorded: bool = True
    mounted: tuple[str, str] | None = None

    @property
    def weakest(self) -> ToldJoint | None:
        """The least sure joint of the way, or of those that would make one; the first of several."""
        return min(self.joints or self.open_joints, key=lambda joint: joint.score, default=None)

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        weakest = self.weakest
        return {**asdict(self), "weakest": None if weakest is None else asdict(weakest)}

    def lines(self) -> list[tuple[str, str]]:
        """The explanation as pairs of a heading and a text."""
        rows = self._way_rows() if self.connected else self._gap_rows()
        if not self.recorded:
            rows.append(("note", "the graph names no joints: build it anew to see why"))
        return rows

    def _way_rows(self) -> list[tuple[str, str]]:
        over = f", by way of {', '.join(self.way[1:-1])}" if len(self.way) > 2 else ""
        long = f", {self.length:.2f} m" if self.length is not None else ""
        rows = [("connected", f"{self.start} - {self.end}{long}{over}")]
        rows += [(f"joint {number}", say_joint(joint)) for number, joint in enumerate(self.joints, 1)]
        if self.weakest is not None and len(self.joints) > 1:
            number = self.joints.index(self.weakest) + 1
            rows.append(("weakest", f"joint {number}, {self.weakest.score:.0%}"))
        if self.unnamed and self.recorded:
            rows.append(("note", f"of {self.unnamed} steps from part to part on the way no joint is named"))
        return rows

    def _gap_rows(self) -> list[tuple[str, str]]:
        rows = [("separate", f"no way along the pipes leads from {self.start} to {self.end}")]
        rows += [("mounted", f"{self.mounted[0]} is mounted at {self.mounted[1]}")] if self.mounted else []
        rows += [("not joined", say_joint(joint)) for joint in self.open_joints]
        if self.joints:
            rows += [("joined", say_joint(joint)) for joint in self.joints]
            rows.append(("note", "they are joined part by part, but no run of pipe was made of that"))
        elif not self.open_joints and not self.mounted:
            rows.append(("between", _said_nearest(self.nearest)))
        return rows


def explain_connection(graph: SceneGraph | Network, start: str, end: str) -> ConnectionExplanation:
    """Says why two units are connected, or what is missing between them.

    Where a way along the pipes leads from one to the other these are its joints in order. Where none does, the parts
    that hang together by connections and joints are taken as pieces, and the joints that were not made are looked
    through for those that join the piece of the one to that of the other, by way of further pieces if need be, with the
    greatest product of their scores.

    Args:
        graph: the finished graph, or its network.
        start: tag or id of a unit, junction or end, or a part or path of a mesh that belongs to it.
        end: the same of the other.

    Raises:
        UnknownNode: the graph has nothing of that name.
        ValueError: both are the same.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    first, last = network.find(start), network.find(end)
    if first == last:
        raise ValueError(f"{start} and {end} are both {network.name(first)}: give two different ones")
    blank = ConnectionExplanation(
        start=network.name(first),
        end=network.name(last),
        recorded=bool(network.graph.joints()),
        mounted=_mounted(network, first, last) or _mounted(network, last, first),
    )
    search = _Search(network)
    distances, ways = network.shortest(first, network.follower(None))
    if last not in ways:
        return search.between(blank, first, last)
    joints, unnamed = search.along(first, ways[last])
    return replace(
        blank,
        connected=True,
        way=(network.name(first), *(network.name(arc.end) for arc in ways[last])),
        length=None if any(arc.length is None for arc in ways[last]) else distances[last],
        joints=joints,
        unnamed=unnamed,
    )


def _mounted(network: Network, one: str, other: str) -> tuple[str, str] | None:
    """The tags of both if the first has no line and is mounted at the other."""
    return (network.name(one), network.name(other)) if other in network.mounted_at(one) else None


class _Search:
    """Looks for joints in a graph.

    Args:
        network: of the graph.
    """

    def __init__(self, network: Network) -> None:
        self._network = network
        self._made: dict[str, list[Joint]] = {}
        for joint in network.graph.joints():
            if joint.made:
                self._made.setdefault(joint.first, []).append(joint)
                self._made.setdefault(joint.second, []).append(joint)

    def along(self, first: str, way: Sequence[Arc]) -> tuple[tuple[ToldJoint, ...], int]:
        """The joints that were made on a way in order, and for how many steps none is named."""
        found: list[ToldJoint] = []
        unnamed = 0
        for here, there, through in self._steps(first, way):
            if here & there:
                continue
            joints = self._chain(here, there, here | there | through) or self._chain(here, there, None)
            unnamed += not joints
            found += self._told(joints, here)
        return tuple(_without_detours(found)), unnamed

    def _steps(self, first: str, way: Sequence[Arc]) -> Iterator[tuple[set[str], set[str], set[str]]]:
        """From each part on the way to the next: the parts here, those there, and those that may lie between."""
        here, through = self._parts(first), set[str]()
        for arc in way:
            for part in arc.via:
                yield here, {part}, through
                here, through = {part}, set()
            if isinstance(self._network.places[arc.end], Unit):
                yield here, self._parts(arc.end), through
                here, through = self._parts(arc.end), set()
            else:
                through = through | self._parts(arc.end)
        if through:
            yield here, through, through

    def _parts(self, place: str) -> set[str]:
        return set(self._network.places[place].parts)

    def _chain(self, here: set[str], there: set[str], within: set[str] | None, most: int = _MOST_STEPS) -> list[Joint]:
        """The fewest joints that lead from some parts to others, over some parts or over any; empty if none do."""
        came: dict[str, tuple[str, Joint] | None] = dict.fromkeys(sorted(here))
        queue = deque((part, 0) for part in came)
        while queue:
            part, steps = queue.popleft()
            if part in there:
                return _back(came, part)
            if steps == most:
                continue
            for joint in self._made.get(part, ()):
                other = joint.second if joint.first == part else joint.first
                if other not in came and (within is None or other in within):
                    came[other] = part, joint
                    queue.append((other, steps + 1))
        return []

    @cached_property
    def _pieces(self) -> Mapping[str, int]:
        """Of each node and part the number of the piece that it is in."""
        import networkx

        network = self._network
        held: networkx.Graph[str] = networkx.Graph()
        held.add_nodes_from(part.id for part in network.graph.parts())
        held.add_nodes_from(network.places)
        held.add_edges_from((place, part) for place, node in network.places.items() for part in node.parts)
        held.add_edges_from((edge.source, end) for edge in network.edges for end in (*edge.via, edge.target))
        held.add_edges_from((joint.first, joint.second) for joint in network.graph.joints(made=True))
        return _numbered(networkx.connected_components(held))

    def between(self, blank: ConnectionExplanation, first: str, last: str) -> ConnectionExplanation:
        """The explanation with what is missing between two nodes that no way joins."""
        pieces, here = self._pieces, self._parts(first)
        if pieces[first] == pieces[last]:
            chain = self._chain(here, self._parts(last), None, most=len(pieces))
            return replace(blank, joints=self._told(chain, here))
        missing = self._missing(pieces[first], pieces[last])
        if not missing:
            return replace(blank, nearest=self._nearest(pieces[first], pieces[last]))
        told: list[ToldJoint] = []
        piece = pieces[first]
        for joint in missing:
            near = {part for part in (joint.first, joint.second) if pieces[part] == piece}
            told.append(tell_joint(self._network, joint, near))
            piece = pieces[told[-1].far]
        return replace(blank, open_joints=tuple(told))

    def _told(self, joints: Iterable[Joint], here: set[str]) -> tuple[ToldJoint, ...]:
        """Joints that follow each other from some parts on."""
        told: list[ToldJoint] = []
        for joint in joints:
            told.append(tell_joint(self._network, joint, here))
            here = {told[-1].far}
        return tuple(told)

    def _missing(self, first: int, last: int) -> list[Joint]:
        """The joints that were not made on the likeliest way from one piece to another."""
        import networkx

        apart: networkx.Graph[int] = networkx.Graph()
        apart.add_nodes_from((first, last))
        for joint in sorted(self._network.open_joints, key=lambda j: (-j.score, j.first, j.second, j.point)):
            ends = self._pieces[joint.first], self._pieces[joint.second]
            if ends[0] != ends[1] and not apart.has_edge(*ends):
                apart.add_edge(*ends, weight=-math.log(max(joint.score, _IMPOSSIBLE)), joint=joint)
        try:
            way: list[int] = networkx.dijkstra_path(apart, first, last, weight="weight")
        except networkx.NetworkXNoPath:
            return []
        return [apart.edges[a, b]["joint"] for a, b in zip(way, way[1:], strict=False)]

    def _nearest(self, first: int, last: int) -> Nearest | None:
        """The parts of two pieces that touch, else those whose boxes are nearest to each other."""
        graph = self._network.graph
        touching = [edge for edge in graph.of_kind(Adjacent) if self._joins(edge, first, last)]
        if touching:
            edge = min(touching, key=lambda e: (e.distance, e.source, e.target))
            ends = graph.part(edge.source), graph.part(edge.target)
            a, b = ends if self._pieces[edge.source] == first else ends[::-1]
            return _nearest_of(a, b, edge.distance, True)
        sides = [[part for part in graph.parts() if self._pieces[part.id] == piece] for piece in (first, last)]
        return _nearest_boxes(*sides) if all(sides) else None

    def _joins(self, edge: Adjacent, first: int, last: int) -> bool:
        return {self._pieces[edge.source], self._pieces[edge.target]} == {first, last}


def _without_detours(joints: Iterable[ToldJoint]) -> list[ToldJoint]:
    """Joints without those that only lead aside and back, as up and down the leg of a gauge that stands in the run."""
    kept: list[ToldJoint] = []
    for joint in joints:
        kept.append(joint)
        met = [number for number, earlier in enumerate(kept) if joint.far in (earlier.near, earlier.far)]
        if met[0] < len(kept) - 1:
            been = met[0] + (kept[met[0]].far == joint.far)
            del kept[been:]
    return kept


def _nearest_boxes(first: Sequence[Part], last: Sequence[Part]) -> Nearest:
    """The two parts, one of each list, whose boxes are nearest to each other; the first of several."""
    boxes = np.array([part.aabb for part in last])
    found: list[tuple[float, int, int]] = []
    for row, part in enumerate(first):
        low, high = np.array(part.aabb)
        gaps = np.maximum(0.0, np.maximum(boxes[:, 0] - high, low - boxes[:, 1]))
        distances = np.linalg.norm(gaps, axis=1)
        found.append((float(distances.min()), row, int(distances.argmin())))
    distance, row, column = min(found)
    return _nearest_of(first[row], last[column], distance, False)


def _numbered(pieces: Iterable[Iterable[str]]) -> dict[str, int]:
    return {name: number for number, names in enumerate(pieces) for name in names}


def _back(came: Mapping[str, tuple[str, Joint] | None], part: str) -> list[Joint]:
    """The joints that led to a part, in order."""
    joints: list[Joint] = []
    step = came[part]
    while step is not None:
        joints.append(step[1])
        step = came[step[0]]
    return joints[::-1]


def _nearest_of(first: Part, last: Part, distance: float, touching: bool) -> Nearest:
    what = name_part(first), name_part(last)
    return Nearest(first.id, last.id, what, (first.meshes[0], last.meshes[0]), distance, touching)


def _said_nearest(nearest: Nearest | None) -> str:
    if nearest is None:
        return "nothing was found between them, and not both have parts"
    first, last = (
        f"{part} ({what or 'unlabelled'})"
        for part, what in zip((nearest.first, nearest.second), nearest.what, strict=True)
    )
    if nearest.touching:
        apart = f"{1000 * nearest.distance:.1f} mm apart" if nearest.distance > 0 else "touching"
        return f"nothing was found that joins them; nearest are {first} and {last}, {apart}, which carry no common line"
    apart = f"{nearest.distance:.2f} m apart"
    return f"nothing was found between them; nearest are {first} and {last}, whose boxes are {apart}"
