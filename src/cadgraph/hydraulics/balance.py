"""A plant at rest: what flows and which pressure stands where, valves, pumps and levels being as they are."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from cadgraph.hydraulics.network import Circuit, LinkKind, Nozzle
from cadgraph.hydraulics.scenario import guess_scenario, tanks_of_gauges, with_pressures
from cadgraph.hydraulics.settings import Characteristic, Scenario
from cadgraph.hydraulics.solve import Condition, Solution, Solver
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.query.network import Network

__all__ = ["LEAST", "SHUT", "STILL", "Balance", "complete", "default_scenario", "flow_share"]

Floats = npt.NDArray[np.float64]

SHUT = 1e-3
"""Opening of a valve at and below which nothing passes, and speed at and below which a pump stands still; ours."""
STILL = 1e-8  # m3/s
LEAST = 1e-4  # share of the flow coefficient of a valve that is not shut
_RATIO = 50.0  # of an equal percentage valve between open and nearly shut; IEC 60534-2-4 allows any, 50 is usual


def default_scenario(graph: SceneGraph | Network) -> Scenario:
    """What is supposed of a graph where nobody says otherwise, each value with its reason.

    Args:
        graph: the finished graph, or its network.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    return complete(network, guess_scenario(network))


def complete(network: Network, scenario: Scenario) -> Scenario:
    """A scenario with the set pressures of relief valves and the spans of gauges that it leaves open.

    Args:
        network: of the graph.
        scenario: what else is supposed.
    """
    # Relief valves stay shut while one looks which pressures there are.
    open_ones = [tag for tag, valve in scenario.valves.items() if valve.duty == "relief" and valve.pressure is None]
    shut = {tag: scenario.valves[tag].model_copy(update={"pressure": 1000.0}) for tag in open_ones}
    trial = Balance(network, scenario.model_copy(update={"valves": {**scenario.valves, **shut}}))
    trial.solve()
    measured = {tag: trial.measure(tag) for tag, gauge in scenario.gauges.items() if gauge.span is None}
    return with_pressures(scenario, {tag: trial.difference(tag) for tag in open_ones}, measured)


def flow_share(opening: npt.ArrayLike, characteristic: Characteristic | None) -> Floats:
    """The flow coefficient of a valve as a share of the open one.

    Args:
        opening: of it, 0 to 1; of any shape.
        characteristic: how it follows.

    Returns:
        Of the same shape.
    """
    share = np.asarray(opening, float)
    if characteristic == "equal percentage":
        share = np.expm1(share * math.log(_RATIO)) / (_RATIO - 1)
    elif characteristic == "ball":
        share = np.sin(math.pi / 2 * share) ** 3
    passed: Floats = np.maximum(share, LEAST)
    return passed


class Balance:
    """A plant at rest.

    Args:
        network: of the graph.
        scenario: that names all of its valves, pumps, ends, tanks and gauges.
    """

    def __init__(self, network: Network, scenario: Scenario) -> None:
        self.scenario = scenario
        self.circuit = Circuit.of(network, scenario)
        self.places = _Places(network, self.circuit)
        self.hand = {tag: valve for tag, valve in scenario.valves.items() if valve.duty == "hand"}
        self.opening = {tag: 1.0 if valve.opening is None else valve.opening for tag, valve in self.hand.items()}
        self.speed = {tag: pump.running for tag, pump in scenario.pumps.items()}
        self.level = {tag: min(tank.level, tank.height) for tag, tank in scenario.tanks.items()}
        self._solver = Solver(self.circuit)
        self._heads = np.where(self.circuit.fixed, self.circuit.head, np.nan)
        self._solution: Solution | None = None
        self._emptied: frozenset[int] = frozenset()
        self._to_air = np.zeros(len(self.circuit.kind), bool)

    @property
    def solution(self) -> Solution:
        """The flows and heads that were solved last."""
        return self._solution if self._solution is not None else self.solve()

    def solve(self) -> Solution:
        """Solves for openings, speeds and levels as they are now."""
        self._solution = self._solver.solve(self.condition(), self._solution)
        self._heads = self._solution.head.copy()
        self._emptied = self._find_emptied()
        return self._solution

    def _find_emptied(self) -> frozenset[int]:
        """Nodes that nothing flows at and that air has got to, as they lie above what stands in the pipe below them."""
        circuit, solution = self.circuit, self.solution
        with np.errstate(invalid="ignore"):
            low = solution.head < circuit.height + LEAST
        still = np.abs(solution.flow) < STILL
        inlets = np.flatnonzero(self._to_air & still & low[circuit.start])
        if not len(inlets):
            return frozenset()
        beside: dict[int, list[int]] = {}
        for link in np.flatnonzero(still & solution.open & low[circuit.start] & low[circuit.end]):
            a, b = int(circuit.start[link]), int(circuit.end[link])
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
        seen = set(circuit.start[inlets].tolist())
        waiting = list(seen)
        while waiting:
            for there in beside.get(waiting.pop(), ()):
                if there not in seen:
                    seen.add(there)
                    waiting.append(there)
        return frozenset(seen)

    def difference(self, tag: str) -> float | None:
        """The pressure before a valve or pump above that behind it [bar]; None where either is unknown.

        Args:
            tag: of the unit.
        """
        links = self.circuit.tags.get(tag)
        if not links:
            return None
        heads = self.solution.head
        drop = float(heads[self.circuit.start[links[0]]] - heads[self.circuit.end[links[0]]])
        return None if math.isnan(drop) else self.scenario.pressure(drop)

    def through(self, tag: str) -> float:
        """What flows through a valve or pump [m3/s].

        Args:
            tag: of the unit.

        Raises:
            ValueError: nothing flows through what is called so.
        """
        links = self.circuit.tags.get(tag)
        if not links:
            raise ValueError(f"{tag}: no valve and no pump of the network; 'cadgraph lines' lists what stands in it")
        flows = self.solution.flow[list(links)]
        return float(flows[0] if len(flows) == 1 else np.abs(flows).sum() / 2)

    def condition(self) -> Condition:
        """What the network stands under now."""
        circuit, scenario = self.circuit, self.scenario
        square, offset = circuit.square.copy(), circuit.offset.copy()
        shut, one_way = np.zeros(len(square), bool), circuit.one_way.copy()
        for tag, opening in self.opening.items():
            for link in circuit.tags.get(tag, ()):
                shut[link] = opening <= SHUT
                square[link] /= flow_share(opening, self.hand[tag].characteristic) ** 2
        for tag, speed in self.speed.items():
            for link in circuit.tags.get(tag, ()):
                # Through one that stands still it flows either way, against what its curve loses.
                one_way[link] = speed > SHUT
                offset[link] *= speed**2 if speed > SHUT else 0.0
        head = self._heads.copy()
        head[circuit.fixed] = circuit.head[circuit.fixed]
        self._to_air = circuit.to_air & ~shut
        for nozzle in circuit.nozzles:
            tank, level = scenario.tanks[nozzle.tag], self.level[nozzle.tag]
            surface = tank.bottom + level
            # A nozzle above the surface, or of an empty tank, lets in and not out.
            one_way[nozzle.link] = level <= 0 or nozzle.height >= surface
            self._to_air[nozzle.link] = one_way[nozzle.link] and tank.pressure == 0
            head[nozzle.node] = max(surface, nozzle.height) + scenario.head(tank.pressure)
        return Condition(
            square=square,
            offset=offset,
            shut=shut,
            one_way=one_way,
            head=head,
            floor=circuit.height + scenario.head(scenario.fluid.vapour),
            loop_head=circuit.height + scenario.head(scenario.pipes.loop_pressure),
        )

    def pressure_at(self, node: int) -> float | None:
        """The pressure at a node [bar(g)], not below that at which the fluid boils; None where it is unknown.

        Args:
            node: its number.
        """
        head = float(self.solution.head[node])
        if math.isnan(head):
            return None
        if node in self._emptied:
            return 0.0
        return max(self.scenario.pressure(head - float(self.circuit.height[node])), self.scenario.fluid.vapour)

    def outlets(self, tag: str) -> list[Nozzle]:
        """The nozzles of a tank that something is known to flow out of."""
        return [n for n in self.circuit.nozzles if n.tag == tag and (tag, n.port) in self.places.outlets]

    def measure(self, tag: str) -> float | None:
        """What a gauge would show if it had no lag and no end of its scale, in its unit; None where nobody knows.

        Args:
            tag: of the gauge.
        """
        gauge, node = self.scenario.gauges[tag], self.circuit.gauges.get(tag)
        if gauge.measures == "level":
            tank = self.places.tank_of.get(tag)
            return None if tank is None else self.level[tank]
        if node is None:
            return None
        if gauge.measures == "pressure":
            return self.pressure_at(node)
        if gauge.measures == "flow":
            return self.places.flow_at(tag, self.solution.flow) * 3600
        return None


class _Places:
    """Where in the arrays of a network the things are that a state tells of.

    Args:
        network: of the graph.
        circuit: made of it.
    """

    def __init__(self, network: Network, circuit: Circuit) -> None:
        inner = {nozzle.node for nozzle in circuit.nozzles}
        self.told = {
            name: node
            for node, name in enumerate(circuit.nodes)
            if node not in inner and not name.endswith((":outside", ":middle"))
        }
        pipes = np.flatnonzero(circuit.kind == LinkKind.PIPE)
        self._links = pipes
        self._numbers = circuit.connection[pipes].tolist()
        self.tag_of = {link: tag for tag, links in circuit.tags.items() for link in links}
        self._tank_links: dict[str, list[int]] = {}
        for nozzle in circuit.nozzles:
            self._tank_links.setdefault(nozzle.tag, []).append(nozzle.link)
        joined: dict[int, list[int]] = {}
        for link in pipes.tolist():
            for node in dict.fromkeys((int(circuit.start[link]), int(circuit.end[link]))):
                joined.setdefault(node, []).append(link)
        self.outlets = {
            (node.tag, arc.start_port)
            for place, node in network.places.items()
            if isinstance(node, Unit) and node.unit_type == "tank"
            for arc in network.arcs(place)
            if arc.flow == "along"
        }
        """Tags of tanks with those of their ports that something is known to flow out of."""
        self._at_gauge = {tag: joined.get(node, []) for tag, node in circuit.gauges.items()}
        self.tank_of = tanks_of_gauges(network)

    def flows(self, flow: Floats) -> dict[int, float]:
        """Flows by number of the connection."""
        return dict(zip(self._numbers, flow[self._links].tolist(), strict=True))

    def inflow(self, flow: Floats) -> dict[str, float]:
        """What flows into each tank [m3/s], by tag."""
        return {tag: float(flow[links].sum()) for tag, links in self._tank_links.items()}

    def links_at_gauge(self, tag: str) -> list[int]:
        """The pipes that join at a gauge."""
        return self._at_gauge[tag]

    def flow_at(self, tag: str, flow: Floats) -> float:
        """What flows past a gauge [m3/s]."""
        links = self._at_gauge[tag]
        return float(np.abs(flow[links]).max()) if len(links) > 1 else 0.0
