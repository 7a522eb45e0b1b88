"""What a unit is joined to and why, and what it might be joined to: all that the graph holds, in one place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from cadgraph.model.graph import SceneGraph
from cadgraph.model.ports import least_ports, port_word
from cadgraph.model.records import Part, Point, SourceFact, Unit
from cadgraph.query.network import Arc, Network
from cadgraph.query.told_facts import fact_rows, fact_values
from cadgraph.query.told_joint import ToldJoint, name_part, say_joint, tell_joint

__all__ = ["PortInUse", "UnitExplanation", "UnitPart", "explain_unit"]

_MOST_TOLD = 12  # parts, in words
_MOST_JOINTS = 6  # joints that were not made, in words


@dataclass(frozen=True)
class UnitPart:
    """A part of a unit, a junction or an end.

    Args:
        part: id.
        mesh: source path of its largest mesh.
        label: its name label, else its group, or None.
    """

    part: str
    mesh: str
    label: str | None


@dataclass(frozen=True)
class PortInUse:
    """A way out of a unit.

    Args:
        port: its name, or None where the graph names none.
        to: tags of the nodes that the connections there lead to; empty where there is none.
        lengths: of these connections [m], or None.
        sizes: nominal size (DN) of each where it leaves, or None.
        confidences: of each, or None.
        joints: that were made there, the surest first.
    """

    port: str | None
    to: tuple[str, ...]
    lengths: tuple[float | None, ...]
    sizes: tuple[int | None, ...]
    confidences: tuple[float | None, ...]
    joints: tuple[ToldJoint, ...]


@dataclass(frozen=True)
class UnitExplanation:
    """What a unit, a junction or an end is, and what it is joined to.

    Args:
        place: id.
        name: its tag.
        what: its kind, else its type.
        unit_type: of a unit, else None.
        parts: that it is made of, or that meet there.
        system: id of the connected network, or None.
        ports: ways out of it, in order.
        least: how many lines a unit of its kind needs; None for what is no unit.
        used: how many it has.
        mounted_at: tags of the units that it sits at, where it has no line; several where it can't be told which.
        joints: that were made at it but at none of its ports.
        open_joints: that were not made at it, the likeliest first.
        recorded: whether the graph names joints at all.
        facts: what the source file says of nodes above several of its parts.
    """

    place: str
    name: str
    what: str
    unit_type: str | None
    parts: tuple[UnitPart, ...]
    system: str | None
    ports: tuple[PortInUse, ...]
    least: int | None
    used: int
    mounted_at: tuple[str, ...]
    joints: tuple[ToldJoint, ...]
    open_joints: tuple[ToldJoint, ...]
    recorded: bool
    facts: tuple[SourceFact, ...] = ()

    @property
    def missing(self) -> int:
        """How many lines it lacks for its kind."""
        return max(0, (self.least or 0) - self.used)

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {**asdict(self), "missing": self.missing, "facts": fact_values(self.facts)}

    def lines(self) -> list[tuple[str, str]]:
        """The explanation as pairs of a heading and a text."""
        kind = f" ({self.unit_type})" if self.unit_type not in (None, self.what) else ""
        rows = [("unit" if self.unit_type else "place", f"{self.name}, {self.what}{kind}")]
        rows += [("parts", _said_parts(self.parts)), ("system", self.system or "none")]
        for port in self.ports:
            rows.append((f"{self._word} {port.port}" if port.port else self._word, _said_port(port)))
            rows += [("", say_joint(joint)) for joint in port.joints]
        rows += [("joined", say_joint(joint)) for joint in self.joints]
        rows += [("mounted at", " or ".join(self.mounted_at))] if self.mounted_at else []
        return rows + self._lacking_rows() + fact_rows(self.facts)

    def _lacking_rows(self) -> list[tuple[str, str]]:
        """What is missing for its kind, and what might be joined to it."""
        rows: list[tuple[str, str]] = []
        if self.unit_type == "gauge" and self.mounted_at and not self.open_joints:
            return rows  # a gauge on a vessel or a device needs no line
        if self.missing:
            has = f"{self.used or 'none'} of {self.least} {self._word}s"
            rows.append(("missing", f"{has} with a line: {self.missing} more would make a whole {self.what}"))
        rows += [("not joined", say_joint(joint)) for joint in self.open_joints[:_MOST_JOINTS]]
        more = len(self.open_joints) - _MOST_JOINTS
        rows += [("", f"and {more} more; --json has them all")] if more > 0 else []
        if not self.recorded:
            rows.append(("note", "the graph names no joints: build it anew to see why"))
        elif self.missing and not self.open_joints:
            rows.append(("not joined", "nothing was found near it that its line could go on in"))
        return rows

    @property
    def _word(self) -> str:
        return port_word(self.unit_type) if self.unit_type else "way"


def explain_unit(graph: SceneGraph | Network, which: str) -> UnitExplanation:
    """Gathers what a unit, a junction or an end of a line is joined to, and what it might be.

    Args:
        graph: the finished graph, or its network.
        which: tag or id, or a part or path of a mesh that belongs to it.

    Raises:
        UnknownNode: the graph has nothing of that name.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    place = network.find(which)
    node = network.places[place]
    told = _told(network, frozenset(node.parts))
    ports, elsewhere = _ports(network, place, [joint for joint in told if joint.made])
    return UnitExplanation(
        place=place,
        name=network.name(place),
        what=network.what(place),
        unit_type=network.unit_type(place),
        parts=tuple(_part(network.graph.part(part)) for part in node.parts),
        system=network.system(place),
        ports=ports,
        least=least_ports(node.unit_type, node.kind) if isinstance(node, Unit) else None,
        used=network.ports_in_use(place),
        mounted_at=tuple(map(network.name, network.mounted_at(place))),
        joints=elsewhere,
        open_joints=tuple(joint for joint in told if not joint.made),
        recorded=bool(network.graph.joints()),
        facts=node.facts if isinstance(node, Unit) else (),
    )


def _told(network: Network, own: frozenset[str]) -> list[ToldJoint]:
    """The joints between some parts and others, the surest first."""
    joints = [joint for joint in network.graph.joints() if (joint.first in own) != (joint.second in own)]
    joints.sort(key=lambda joint: (-joint.score, joint.first, joint.second, joint.point))
    return [tell_joint(network, joint, own) for joint in joints]


def _part(part: Part) -> UnitPart:
    return UnitPart(part.id, part.meshes[0], name_part(part))


@dataclass(frozen=True)
class _Way:
    """A port with the connections there, or a connection that names no port."""

    port: str | None
    point: Point | None
    arcs: tuple[Arc, ...]

    def leads_over(self, part: str) -> bool:
        """Whether a connection here begins with a part."""
        return any(arc.via[:1] == (part,) for arc in self.arcs)

    def away(self, point: Point) -> float:
        """How far a point is from where it begins [m]."""
        starts = [self.point] if self.point is not None else [arc.path[0] for arc in self.arcs if arc.path]
        return min((math.dist(point, start) for start in starts), default=math.inf)


def _ports(
    network: Network, place: str, made: Sequence[ToldJoint]
) -> tuple[tuple[PortInUse, ...], tuple[ToldJoint, ...]]:
    """The ways out of a node with the joints at each, and the joints that are at none of them."""
    ways = _ways(network, place)
    at: dict[int, list[ToldJoint]] = {}
    for joint in made:
        at.setdefault(_way_of(joint, ways), []).append(joint)
    ports = tuple(
        PortInUse(
            port=way.port,
            to=tuple(network.name(arc.end) for arc in way.arcs),
            lengths=tuple(arc.length for arc in way.arcs),
            sizes=tuple(arc.sizes[0] if arc.sizes else None for arc in way.arcs),
            confidences=tuple(arc.edge.confidence for arc in way.arcs),
            joints=tuple(at.get(k, ())),
        )
        for k, way in enumerate(ways)
    )
    return ports, tuple(at.get(_NOWHERE, ()))


_NOWHERE = -1


def _ways(network: Network, place: str) -> list[_Way]:
    """The ports of a unit with the connections there, then each connection that names no port."""
    node = network.places[place]
    points = {port.name: port.point for port in node.ports} if isinstance(node, Unit) else {}
    named: dict[str, list[Arc]] = {name: [] for name in points}
    unnamed: list[_Way] = []
    for arc in network.arcs(place):
        if arc.start_port is None:
            unnamed.append(_Way(None, None, (arc,)))
        else:
            named.setdefault(arc.start_port, []).append(arc)
    return [*(_Way(name, points.get(name), tuple(arcs)) for name, arcs in named.items()), *unnamed]


def _way_of(joint: ToldJoint, ways: Sequence[_Way]) -> int:
    """The number of the way that a joint is on: that over its other part, else the nearest port; -1 for none."""
    among = [k for k, way in enumerate(ways) if way.leads_over(joint.far)]
    among = among or [k for k, way in enumerate(ways) if way.leads_over(joint.near) or way.point is not None]
    return min(among, key=lambda k: ways[k].away(joint.point), default=_NOWHERE)


def _said_parts(parts: Sequence[UnitPart]) -> str:
    names = [f"{part.part} ({part.label or 'unlabelled'})" for part in parts[:_MOST_TOLD]]
    more = len(parts) - _MOST_TOLD
    return (", ".join(names) + (f" and {more} more" if more > 0 else "")) or "none"


def _said_port(port: PortInUse) -> str:
    if not port.to:
        return "no line was found here"
    told = []
    for name, length, size, confidence in zip(port.to, port.lengths, port.sizes, port.confidences, strict=True):
        facts = [f"DN {size}"] if size is not None else []
        facts += [f"{length:.2f} m"] if length is not None else []
        facts += [f"{confidence:.0%} sure"] if confidence is not None else []
        told.append(f"to {name}" + (f" ({', '.join(facts)})" if facts else ""))
    return ", ".join(told)
