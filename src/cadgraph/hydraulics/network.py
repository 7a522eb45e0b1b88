"""The network of a graph under a scenario: points with a pressure, and links that something flows through."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
import numpy.typing as npt

from cadgraph.hydraulics.laws import CREEP, Friction, area
from cadgraph.hydraulics.settings import GRAVITY, PumpSetting, Scenario, ValveSetting
from cadgraph.model.records import Junction, Point, Terminal, Unit
from cadgraph.query.duty import moves_by_itself
from cadgraph.query.network import Arc, Network

__all__ = ["OUTSIDE", "SINK_PRESSURE", "Circuit", "LinkKind", "Nozzle", "bore_at", "ports_at", "resistance_of"]

OUTSIDE = "outside"
"""The port of a valve that leads into the open."""
SINK_PRESSURE = 3.0
"""Pressure at which a sink takes the flow that its setting says [bar]."""
SHORTEST = 0.05  # m; of a connection, so that none is without loss
UNKNOWN_LENGTH = 1.0  # m
UNKNOWN_BORE = 0.05  # m
THROUGH_LOSS = 1.0  # of entering or leaving a unit that the flow passes
NOZZLE_LOSS = 0.5  # of a sharp-edged entrance; Crane, Technical Paper 410
_DOES = {"hand": "is moved by hand", "check": "checks", "relief": "relieves"}  # what a valve does, by its duty
_SLIGHTEST = 1e-3  # loss coefficient, so that every link has a slope

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]


class LinkKind(IntEnum):
    """What a link stands for."""

    PIPE = 0
    THROUGH = 1
    VALVE = 2
    CHECK = 3
    RELIEF = 4
    PUMP = 5
    OUTLET = 6
    NOZZLE = 7


_ONE_WAY = (LinkKind.CHECK, LinkKind.RELIEF, LinkKind.PUMP, LinkKind.OUTLET)


@dataclass(frozen=True)
class Nozzle:
    """Where a pipe joins a tank.

    Args:
        tag: of the tank.
        port: of the tank.
        link: number of the link from the pipe into the tank.
        node: number of the node whose head is that of the tank.
        height: of the nozzle in the plant [m].
    """

    tag: str
    port: str
    link: int
    node: int
    height: float


@dataclass(frozen=True)
class Circuit:
    """The network as arrays; n_nodes, n_links.

    Args:
        nodes: their ids: those of junctions, ends and gauges as in the graph, of other units with their ports
            (``unit-7:N1``).
        height: (n_nodes,) in the plant [m].
        points: (n_nodes,) where they are.
        fixed: (n_nodes,) whether the head is given.
        head: (n_nodes,) the given head [m]; NaN where none is, or where it follows a level.
        kind: (n_links,) :class:`LinkKind`.
        start: (n_links,) number of the node that a positive flow leaves.
        end: (n_links,) number of the node that it enters.
        length: (n_links,) of pipe [m].
        diameter: (n_links,) bore [m].
        loss: (n_links,) loss coefficient of bends, valves when open, nozzles.
        square: (n_links,) head per square of the flow that is lost beside friction, valves open [s2/m5].
        offset: (n_links,) head that is lost before anything flows [m]; negative for pumps at full speed.
        creep: (n_links,) flows below which losses are linear [m3/s].
        one_way: (n_links,) whether nothing flows from end to start.
        to_air: (n_links,) whether a link leads into the open.
        owner: id of the graph's node that each link belongs to; ``""`` for pipes.
        connection: (n_links,) number of the connection in the graph, -1 where there is none.
        friction: of the pipes.
        tags: of valves and pumps: their links, by tag.
        gauges: of each gauge with a line, by tag: the number of its node.
        nozzles: of all tanks.
        remarks: on what could not be represented.
        assumed: how many lengths and bores had to be assumed, by what.
    """

    nodes: tuple[str, ...]
    height: Floats
    points: tuple[Point, ...]
    fixed: Bools
    head: Floats
    kind: Ints
    start: Ints
    end: Ints
    length: Floats
    diameter: Floats
    loss: Floats
    square: Floats
    offset: Floats
    creep: Floats
    one_way: Bools
    to_air: Bools
    owner: tuple[str, ...]
    connection: Ints
    friction: Friction
    tags: Mapping[str, tuple[int, ...]]
    gauges: Mapping[str, int]
    nozzles: tuple[Nozzle, ...]
    remarks: tuple[str, ...]
    assumed: Mapping[str, int]

    def node_of_gauge(self, tag: str) -> str:
        """The name of a gauge's node; empty where it has no line.

        Args:
            tag: of the gauge.
        """
        return self.nodes[self.gauges[tag]] if tag in self.gauges else ""

    @classmethod
    def of(cls, network: Network, scenario: Scenario) -> Circuit:
        """The network of a graph.

        Args:
            network: of the finished graph.
            scenario: that names all of its valves, pumps, ends, tanks and gauges.
        """
        return _Laying(network, scenario).circuit()


def ports_at(network: Network, place: str) -> dict[str, tuple[Arc, ...]]:
    """The connections of a node by its ports, in the order of the file; one that names none is a port of its own.

    Args:
        network: of the graph.
        place: id of the node.
    """
    found: dict[str, list[Arc]] = {}
    for arc in sorted(network.arcs(place), key=lambda arc: (arc.index, not arc.forward)):
        found.setdefault(_port_of(arc), []).append(arc)
    return {port: tuple(arcs) for port, arcs in sorted(found.items(), key=lambda item: item[0])}


def bore_at(network: Network, place: str) -> float | None:
    """The smallest bore of what joins a node [m]; None where no bore is known."""
    known = [bore for arc in network.arcs(place) if (bore := _bore(arc)) is not None]
    return min(known, default=None)


def resistance_of(loss: float, bore: float) -> float:
    """Head per square of the flow [s2/m5] of a loss coefficient.

    Args:
        loss: the coefficient.
        bore: that it refers to [m].
    """
    return loss / (2 * GRAVITY * (math.pi / 4 * bore * bore) ** 2)


def _port_of(arc: Arc) -> str:
    """The name of the port that a connection leaves by, else one of its own."""
    return arc.start_port or f"#{arc.index}{'' if arc.forward else 'b'}"


def _bore(arc: Arc) -> float | None:
    if arc.sizes:
        return min(arc.sizes) / 1000
    return arc.edge.diameter if arc.edge.diameter else None


def _turning(path: Sequence[Point]) -> float:
    """How far a polyline turns in all, in units of 90 degrees."""
    steps = np.diff(np.asarray(path, float), axis=0) if len(path) > 2 else np.zeros((0, 3))
    lengths = np.linalg.norm(steps, axis=1)
    along = steps[lengths > 1e-9] / lengths[lengths > 1e-9, None]
    if len(along) < 2:
        return 0.0
    cosines = np.clip(np.einsum("ij,ij->i", along[:-1], along[1:]), -1, 1)
    return float(np.arccos(cosines).sum() / (np.pi / 2))


@dataclass
class _Laying:
    """Lays the links; numbers are given in the order of the graph."""

    network: Network
    scenario: Scenario
    nodes: dict[str, int] = field(default_factory=dict)
    points: list[Point] = field(default_factory=list)
    head: dict[int, float] = field(default_factory=dict)
    open_air: list[int] = field(default_factory=list)
    links: list[tuple[LinkKind, int, int, float, float, float, str, int]] = field(default_factory=list)
    square: dict[int, float] = field(default_factory=dict)
    offset: dict[int, float] = field(default_factory=dict)
    tags: dict[str, tuple[int, ...]] = field(default_factory=dict)
    gauges: dict[str, int] = field(default_factory=dict)
    nozzles: list[Nozzle] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    assumed: dict[str, int] = field(default_factory=dict)

    def circuit(self) -> Circuit:
        for place, node in self.network.places.items():
            if not self.network.arcs(place):
                continue
            if isinstance(node, Junction | Terminal):
                self._node(place, node.point)
                if isinstance(node, Terminal):
                    self._end(place, node)
            else:
                self._unit(place, node)
        for index in range(len(self.network.edges)):
            self._pipe(Arc(index, self.network.edges[index], True))
        return self._arrays()

    def _node(self, name: str, point: Point) -> int:
        if name not in self.nodes:
            self.nodes[name] = len(self.nodes)
            self.points.append(point)
        return self.nodes[name]

    def _link(
        self, kind: LinkKind, start: int, end: int, bore: float, loss: float, owner: str, length: float = 0.0
    ) -> int:
        self.links.append((kind, start, end, length, bore, loss, owner, -1))
        return len(self.links) - 1

    def _assume(self, what: str) -> None:
        self.assumed[what] = self.assumed.get(what, 0) + 1

    # Where things are

    def _port_point(self, place: str, port: str, arcs: Sequence[Arc]) -> Point:
        node = self.network.places[place]
        if isinstance(node, Unit):
            for own in node.ports:
                if own.name == port:
                    return own.point
        if arcs and arcs[0].path:
            return arcs[0].path[0]
        return node.centroid if isinstance(node, Unit) else node.point

    def _port_node(self, place: str, port: str, arcs: Sequence[Arc]) -> int:
        return self._node(f"{place}:{port}", self._port_point(place, port, arcs))

    def _bore_of(self, place: str) -> float:
        return bore_at(self.network, place) or UNKNOWN_BORE

    def _at(self, place: str, arc: Arc) -> int:
        """The node that an end of a connection joins."""
        if place in self.nodes:
            return self.nodes[place]
        return self.nodes[f"{place}:{_port_of(arc)}"]

    def _middle(self, place: str, ends: Sequence[int]) -> int:
        """A node amid the ports of a unit."""
        x, y, z = np.mean([self.points[end] for end in ends], axis=0).tolist()
        return self._node(f"{place}:middle", (x, y, z))

    def _outside(self, place: str, point: Point) -> int:
        """A node in the open, at atmospheric pressure."""
        node = self._node(f"{place}:{OUTSIDE}", point)
        self.head[node] = point[2]
        self.open_air.append(node)
        return node

    # What stands in the lines

    def _unit(self, place: str, node: Unit) -> None:
        ports = ports_at(self.network, place)
        if node.unit_type == "gauge":
            self._gauge(place, node, ports)
        elif node.unit_type == "valve" and node.tag in self.scenario.valves:
            self._heed_kind(place, node, ports, self.scenario.valves[node.tag])
            self._valve(place, node, ports, self.scenario.valves[node.tag])
        elif node.unit_type == "pump" and node.tag in self.scenario.pumps:
            self._pump(place, node, ports, self.scenario.pumps[node.tag])
        elif node.unit_type == "tank" and node.tag in self.scenario.tanks:
            self._tank(place, node, ports)
        else:
            self._passage(place, ports)

    def _gauge(self, place: str, node: Unit, ports: Mapping[str, tuple[Arc, ...]]) -> None:
        """A gauge takes no head from what passes it: all of its ports are one node."""
        port, arcs = next(iter(ports.items()))
        self.gauges[node.tag] = self._node(place, self._port_point(place, port, arcs))

    def _heed_kind(self, place: str, node: Unit, ports: Mapping[str, tuple[Arc, ...]], setting: ValveSetting) -> None:
        """Says where a scenario has a valve do what one of its kind doesn't: it may be older than the kind."""
        by_kind = moves_by_itself(self.network, place, len(ports)) or "hand"
        if node.kind is not None and setting.duty != by_kind:
            self.remarks.append(
                f"{node.tag} is a {node.kind} by the graph, and {_DOES[setting.duty]} in the scenario: take it out of "
                "the scenario to follow the graph"
            )

    def _valve(self, place: str, node: Unit, ports: Mapping[str, tuple[Arc, ...]], setting: ValveSetting) -> None:
        bore, names = self._bore_of(place), list(ports)
        ends = [self._port_node(place, port, ports[port]) for port in names]
        if len(ends) > 2:
            self._crossing(place, node, ends, setting, bore)
            return
        if len(ends) == 1:
            if setting.duty == "check":
                self.remarks.append(f"{node.tag} is a check valve with nothing behind it: left out")
                return
            ends.append(self._outside(place, self.points[ends[0]]))
            names.append(OUTSIDE)
        if setting.duty != "hand":
            out = setting.towards
            if out is not None and out in ports and (_runs(ports[out], outward=False) or self._flows_back(ports, out)):
                self.remarks.append(
                    f"{node.tag} lets out at {out} in the scenario, and by the graph it flows the other way: take it "
                    "out of the scenario to follow the graph"
                )
            if out == names[0]:
                ends.reverse()
        kind = {"check": LinkKind.CHECK, "relief": LinkKind.RELIEF}.get(setting.duty, LinkKind.VALVE)
        loss = setting.k + (1.0 if OUTSIDE in names else 0.0)  # what leaves keeps no speed
        link = self._link(kind, ends[0], ends[1], bore, max(loss, _SLIGHTEST), place)
        if setting.duty == "relief":
            self.offset[link] = self.scenario.head(setting.pressure or 0.0)
        self.tags[node.tag] = (link,)

    @staticmethod
    def _flows_back(ports: Mapping[str, tuple[Arc, ...]], out: str) -> bool:
        """Whether it is known to flow out at the other port of a valve than the one that it lets out at."""
        others = [arcs for port, arcs in ports.items() if port != out]
        return not _runs(ports[out], outward=True) and any(_runs(arcs, outward=True) for arcs in others)

    def _crossing(self, place: str, node: Unit, ends: Sequence[int], setting: ValveSetting, bore: float) -> None:
        """A valve of three or more ports: each opens into a middle, and shutting it shuts all."""
        middle = self._middle(place, ends)
        if setting.duty != "hand":
            self.remarks.append(f"{node.tag} has {len(ends)} ports, so it is taken for a valve that is moved by hand")
        else:
            self.remarks.append(
                f"{node.tag} has {len(ends)} ports, and shut is taken for all of them; such a valve leaves one open as "
                "a rule"
            )
        self.tags[node.tag] = tuple(
            self._link(LinkKind.VALVE, end, middle, bore, max(setting.k / 2, _SLIGHTEST), place) for end in ends
        )

    def _pump(self, place: str, node: Unit, ports: Mapping[str, tuple[Arc, ...]], setting: PumpSetting) -> None:
        sides = {
            True: [p for p in ports if p in setting.suction],
            False: [p for p in ports if p not in setting.suction],
        }
        if not all(sides.values()):
            self.remarks.append(f"{node.tag} has a line on one side only: it moves nothing")
            for port, arcs in ports.items():
                self._port_node(place, port, arcs)
            return
        turned = [port for drawing, of in sides.items() for port in of if _runs(ports[port], outward=drawing)]
        if turned:
            self.remarks.append(
                f"{node.tag} draws at {', '.join(setting.suction)} in the scenario, and by the graph it flows the "
                f"other way at {', '.join(turned)}: take its suction out of the scenario to follow the graph"
            )
        ends = []
        for drawing in (True, False):
            nodes = [self._port_node(place, port, ports[port]) for port in sides[drawing]]
            for other in nodes[1:]:
                self._link(LinkKind.THROUGH, nodes[0], other, self._bore_of(place), THROUGH_LOSS, place)
            ends.append(nodes[0])
        flow = setting.flow / 3600
        link = self._link(LinkKind.PUMP, ends[0], ends[1], self._bore_of(place), 0.0, place)
        self.offset[link] = -4 / 3 * setting.head
        self.square[link] = setting.head / 3 / flow**2
        self.tags[node.tag] = (link,)

    def _tank(self, place: str, node: Unit, ports: Mapping[str, tuple[Arc, ...]]) -> None:
        for port, arcs in ports.items():
            point = self._port_point(place, port, arcs)
            bore = _bore(arcs[0]) or UNKNOWN_BORE
            inner = self._node(f"{place}:{port}:inside", point)
            self.head[inner] = math.nan
            link = self._link(LinkKind.NOZZLE, self._port_node(place, port, arcs), inner, bore, NOZZLE_LOSS, place)
            self.nozzles.append(Nozzle(node.tag, port, link, inner, point[2]))

    def _passage(self, place: str, ports: Mapping[str, tuple[Arc, ...]]) -> None:
        """Anything else lets pass between all of its ports."""
        ends = [self._port_node(place, port, arcs) for port, arcs in ports.items()]
        if len(ends) < 2:
            return
        self._assume("loss of equipment that the flow passes (1 velocity head at each port)")
        middle = self._middle(place, ends)
        for end in ends:
            self._link(LinkKind.THROUGH, end, middle, self._bore_of(place), THROUGH_LOSS, place)

    def _end(self, place: str, node: Terminal) -> None:
        setting = self.scenario.ends.get(place)
        if setting is None or setting.role == "blind":
            return
        here, height = self.nodes[place], node.point[2]
        if _runs(self.network.arcs(place), outward=setting.role == "sink"):
            self.remarks.append(
                f"{place} is a {setting.role} in the scenario, and by the graph it flows the other way there: take it "
                "out of the scenario to follow the graph"
            )
        if setting.role == "source":
            self.head[here] = height + self.scenario.head(setting.pressure or 0.0)
            return
        flow = (setting.flow or 1.0) / 3600
        link = self._link(LinkKind.OUTLET, here, self._outside(place, node.point), self._bore_of(place), 0.0, place)
        self.square[link] = self.scenario.head(SINK_PRESSURE) / flow**2

    def _pipe(self, arc: Arc) -> None:
        bore, length = _bore(arc), arc.length
        if bore is None:
            known = [bore_at(self.network, place) for place in (arc.start, arc.end)]
            bore = min((each for each in known if each is not None), default=UNKNOWN_BORE)
            self._assume("bore of pipes of unknown size (that of the next one, else 50 mm)")
        if length is None:
            length = UNKNOWN_LENGTH
            self._assume("length of pipes of unknown length (1 m)")
        ends = [self._at(each.start, each) for each in (arc, arc.back)]
        loss = max(self.scenario.pipes.bend * _turning(arc.path), _SLIGHTEST)
        self.links.append((LinkKind.PIPE, ends[0], ends[1], max(length, SHORTEST), bore, loss, "", arc.index))

    # As arrays

    def _arrays(self) -> Circuit:
        kind, start, end, length, diameter, loss, owner, connection = (
            map(list, zip(*self.links, strict=True)) if self.links else ([] for _ in range(8))
        )
        n = len(self.links)
        kinds, bores = np.array(kind, np.int64), np.array(diameter, float)
        losses = np.array(loss, float)
        square = losses / (2 * GRAVITY * area(bores) ** 2)
        offset = np.zeros(n)
        for link, value in self.square.items():
            square[link] = value
        for link, value in self.offset.items():
            offset[link] = value
        fixed = np.zeros(len(self.nodes), bool)
        head = np.full(len(self.nodes), math.nan)
        for node, value in self.head.items():
            fixed[node], head[node] = True, value
        lengths = np.array(length, float)
        return Circuit(
            nodes=tuple(self.nodes),
            height=np.array([point[2] for point in self.points]),
            points=tuple(self.points),
            fixed=fixed,
            head=head,
            kind=kinds,
            start=np.array(start, np.int64),
            end=np.array(end, np.int64),
            length=lengths,
            diameter=bores,
            loss=losses,
            square=square,
            offset=offset,
            creep=area(bores) * CREEP,
            one_way=np.isin(kinds, _ONE_WAY) | np.isin(np.array(end, np.int64), self.open_air),
            to_air=np.isin(np.array(end, np.int64), self.open_air),
            owner=tuple(str(each) for each in owner),
            connection=np.array(connection, np.int64),
            friction=Friction.of(lengths, bores, self.scenario.pipes.roughness, self.scenario.fluid.viscosity),
            tags=self.tags,
            gauges=self.gauges,
            nozzles=tuple(self.nozzles),
            remarks=tuple(self.remarks),
            assumed=self.assumed,
        )


def _runs(arcs: Sequence[Arc], *, outward: bool) -> bool:
    """Whether it is known to flow away from where connections start, or towards it, and through none the other way."""
    flows = {arc.flow for arc in arcs} - {"unknown"}
    return flows == {"along" if outward else "against"}
