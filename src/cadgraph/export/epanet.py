"""The network of a plant as an input file of EPANET 2.2, for tools of water networks (EPANET, WNTR, QGIS).

Keywords and units follow the EPANET 2.2 Users Manual, appendix C. Lengths are m, bores mm, flows m3/h.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import networkx
import numpy as np

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import file_name, printable
from cadgraph.hydraulics.balance import Balance
from cadgraph.hydraulics.network import LinkKind
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.settings import GRAVITY, SCENARIO, Scenario
from cadgraph.hydraulics.solve import Condition
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.query.network import Network

__all__ = ["InputFile", "write_epanet"]

_WATER = 1.1e-5 * 0.3048**2  # m2/s; the viscosity that EPANET's is relative to
_STUB = 0.01  # m; length of a pipe that stands for what lets pass one way only
_LONGEST = 28  # characters of a name; EPANET takes 31
_AREA = math.pi / 4


def write_epanet(
    graph: SceneGraph, path: str | Path, scenario: Scenario | str | Path | None = None
) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes a plant as ``.inp``, as it stands at the beginning of a scenario.

    Args:
        graph: the finished graph.
        path: the file.
        scenario: what is supposed, or the file that says so; None: ``scenario.yaml`` beside the file that is written
            where there is one, else the defaults.

    Returns:
        The file, and notes: ``scenario`` (what was supposed), ``relief-shut`` (EPANET has none), ``pump-open`` (one
        that stands still lets pass, which a closed one of EPANET doesn't), ``tank-inlet`` (one above the level,
        written as a reservoir), ``no-source`` (pieces without a known pressure) and ``shut-in``, where EPANET makes
        pressures up.

    Raises:
        ScenarioError: the scenario can't be used.
        OutputError: the file can't be written.
    """
    target = Path(path)
    beside = target.parent / SCENARIO
    found = beside if scenario is None and beside.exists() else scenario
    process = Process(graph, found)
    said = f"as {found} says" if isinstance(found, str | Path) else "as given" if found else "all of it supposed anew"
    notes = [Diagnostic("scenario", f"openings, pumps and pressures {said}", ())]
    plant = InputFile(process.network, process.balance)
    notes += plant.notes()
    write_atomically(target, "\n".join(plant.lines()) + "\n")
    return target, tuple(notes)


class InputFile:
    """The sections of the file, and the names in it: ``nodes`` and ``links`` in the order of the circuit's.

    Args:
        network: of the graph.
        balance: the plant at rest.
    """

    def __init__(self, network: Network, balance: Balance) -> None:
        self.network, self.balance = network, balance
        self.condition: Condition = balance.condition()
        circuit = balance.circuit
        self.nodes = _names(self._called(name) for name in circuit.nodes)
        self.links = _names(
            network.name(owner) if owner else f"pipe-{circuit.connection[i] + 1}"
            for i, owner in enumerate(circuit.owner)
        )
        self.tanks: dict[str, int] = {}
        self.tank_node: dict[int, int] = {}
        for nozzle in circuit.nozzles:
            if not self.condition.one_way[nozzle.link]:
                first = self.tanks.setdefault(nozzle.tag, nozzle.node)
                self.tank_node[nozzle.node] = first
                self.nodes[nozzle.node] = self.nodes[first]

        self.stand_ins = self._without_head()

    def _without_head(self) -> dict[int, str]:
        """A node of each piece of network that has no given head, and the name of a reservoir to join it to."""
        circuit = self.balance.circuit
        pieces: networkx.Graph[int] = networkx.Graph()
        pieces.add_nodes_from(range(len(circuit.nodes)))
        pieces.add_edges_from(zip(circuit.start.tolist(), circuit.end.tolist(), strict=True))
        lost = [min(piece) for piece in networkx.connected_components(pieces) if not circuit.fixed[list(piece)].any()]
        return {node: f"stand-in-{number}" for number, node in enumerate(sorted(lost), 1)}

    def _called(self, name: str) -> str:
        place, colon, port = name.partition(":")
        return f"{self.network.name(place)}{'.' if colon else ''}{port}"

    def lines(self) -> Iterator[str]:
        """The whole file."""
        yield from ("[TITLE]", f"{_plain(file_name(self.network.graph.source.path))}, written by cadgraph", "")
        for title, rows in (
            ("JUNCTIONS", self._junctions()),
            ("RESERVOIRS", self._reservoirs()),
            ("TANKS", self._tanks()),
            ("PIPES", self._pipes()),
            ("PUMPS", self._pumps()),
            ("VALVES", self._valves()),
            ("CURVES", self._curves()),
            ("STATUS", self._status()),
            ("OPTIONS", self._options()),
            ("COORDINATES", self._coordinates()),
        ):
            yield f"[{title}]"
            yield from rows
            yield ""
        yield "[END]"

    def notes(self) -> Iterator[Diagnostic]:
        """What is to be said of it."""
        circuit, condition = self.balance.circuit, self.condition
        reliefs = [circuit.owner[link] for link in self._of(LinkKind.RELIEF)]
        if reliefs:
            names = ", ".join(self.network.name(place) for place in reliefs)
            yield Diagnostic("relief-shut", f"{names}: EPANET has no relief valve, so it is written shut", ())
        still = [circuit.owner[link] for link in self._pumps_that(run=False)]
        if still:
            names = ", ".join(self.network.name(place) for place in still)
            yield Diagnostic("pump-open", f"{names}: stands still, and is written as a valve that lets pass", ())
        for nozzle in circuit.nozzles:
            if condition.one_way[nozzle.link]:
                text = f"{nozzle.tag}.{nozzle.port} lies above the level: written as a reservoir at its height"
                yield Diagnostic("tank-inlet", text, ())
        if self.stand_ins:
            text = (
                f"nothing of known pressure is joined to {len(self.stand_ins)} pieces of the network; each got a "
                "reservoir 'stand-in', which EPANET needs: what stands there says nothing"
            )
            yield Diagnostic("no-source", text, ())
        if (self.balance.solution.shut_in & ~np.isnan(self.balance.solution.head)).any():
            text = "valves shut in some places: the pressures that EPANET gives there are made up"
            yield Diagnostic("shut-in", text, ())

    def _of(self, *kinds: LinkKind) -> list[int]:
        return [i for i, kind in enumerate(self.balance.circuit.kind) if kind in kinds]

    # Nodes

    def _junctions(self) -> Iterator[str]:
        circuit = self.balance.circuit
        for i in range(len(circuit.nodes)):
            if not circuit.fixed[i]:
                yield f" {self.nodes[i]}\t{circuit.height[i]:.6f}\t0"

    def _reservoirs(self) -> Iterator[str]:
        for i in range(len(self.balance.circuit.nodes)):
            if self.balance.circuit.fixed[i] and i not in self.tank_node:
                yield f" {self.nodes[i]}\t{self.condition.head[i]:.6f}"
        for node, name in self.stand_ins.items():
            yield f" {name}\t{self.balance.circuit.height[node]:.6f}"

    def _tanks(self) -> Iterator[str]:
        scenario = self.balance.scenario
        for tag, node in self.tanks.items():
            tank = scenario.tanks[tag]
            # The air above the surface counts as so much more height.
            bottom = tank.bottom + scenario.head(tank.pressure)
            across = math.sqrt(tank.area / _AREA)
            row = (bottom, self.balance.level[tag], 0.0, tank.height, across, 0.0)
            yield f" {self.nodes[node]}\t" + "\t".join(f"{value:.6f}" for value in row)

    def _coordinates(self) -> Iterator[str]:
        circuit = self.balance.circuit
        for i, point in enumerate(circuit.points):
            if i not in self.tank_node or self.tank_node[i] == i:
                yield f" {self.nodes[i]}\t{point[0]:.4f}\t{point[1]:.4f}"

    # Links

    def _ends(self, link: int) -> str:
        circuit = self.balance.circuit
        ends = [int(circuit.start[link]), int(circuit.end[link])]
        return "\t".join(self.nodes[end] for end in ends)

    def _coefficient(self, link: int) -> float:
        """The loss coefficient of a link as it stands."""
        bore = self.balance.circuit.diameter[link]
        return float(self.condition.square[link] * 2 * GRAVITY * (_AREA * bore * bore) ** 2)

    def _pipes(self) -> Iterator[str]:
        circuit = self.balance.circuit
        roughness = self.balance.scenario.pipes.roughness * 1000
        for link in self._of(*(kind for kind in LinkKind if kind is not LinkKind.PUMP)):
            if circuit.kind[link] != LinkKind.PIPE and not self._is_stub(link):
                continue
            length = circuit.length[link] or _STUB
            shut = circuit.kind[link] == LinkKind.RELIEF or self.condition.shut[link]
            status = "Closed" if shut else "CV" if self.condition.one_way[link] else "Open"
            values = f"{length:.6f}\t{circuit.diameter[link] * 1000:.4f}\t{roughness:g}\t{self._coefficient(link):.8g}"
            yield f" {self.links[link]}\t{self._ends(link)}\t{values}\t{status}"
        for node, name in self.stand_ins.items():
            yield f" {name}\t{name}\t{self.nodes[node]}\t{_STUB:.6f}\t100\t{roughness:g}\t0\tOpen"

    def _is_stub(self, link: int) -> bool:
        """Whether a link is no pipe, but written as one, as only pipes let pass one way only."""
        kind = self.balance.circuit.kind[link]
        return bool(kind not in (LinkKind.PIPE, LinkKind.PUMP) and self.condition.one_way[link])

    def _pumps(self) -> Iterator[str]:
        circuit = self.balance.circuit
        for link in self._pumps_that(run=True):
            speed = self.balance.speed[self.network.name(circuit.owner[link])]
            yield f" {self.links[link]}\t{self._ends(link)}\tHEAD curve-{self.links[link]}\tSPEED {speed:g}"

    def _pumps_that(self, run: bool) -> list[int]:
        """The pumps that run, or those that stand still: these let pass, which EPANET's closed ones don't."""
        return [link for link in self._of(LinkKind.PUMP) if self.condition.one_way[link] == run]

    def _valves(self) -> Iterator[str]:
        circuit = self.balance.circuit
        for link in [*self._of(LinkKind.VALVE, LinkKind.THROUGH, LinkKind.NOZZLE), *self._pumps_that(run=False)]:
            if not self._is_stub(link):
                loss = self._coefficient(link)
                yield (
                    f" {self.links[link]}\t{self._ends(link)}\t{circuit.diameter[link] * 1000:.4f}\tTCV\t{loss:.8g}\t0"
                )

    def _curves(self) -> Iterator[str]:
        circuit = self.balance.circuit
        for link in self._pumps_that(run=True):
            pump = self.balance.scenario.pumps[self.network.name(circuit.owner[link])]
            yield f" curve-{self.links[link]}\t{pump.flow:.6f}\t{pump.head:.6f}"

    def _status(self) -> Iterator[str]:
        for link in self._of(LinkKind.VALVE):
            if self.condition.shut[link] and not self._is_stub(link):
                yield f" {self.links[link]}\tClosed"

    def _options(self) -> Iterator[str]:
        fluid = self.balance.scenario.fluid
        yield " Units\tCMH"
        yield " Headloss\tD-W"
        yield f" Specific Gravity\t{fluid.density / 1000:g}"
        yield f" Viscosity\t{fluid.viscosity / _WATER:.8g}"
        yield " Trials\t200"
        yield " Accuracy\t0.0000001"
        yield " Unbalanced\tContinue 50"


def _plain(text: str) -> str:
    """Text that can't open a section or a comment."""
    return printable(text).replace("[", "(").replace("]", ")").replace(";", ",")


def _names(wanted: Iterable[str]) -> list[str]:
    """Names as EPANET takes them, no two alike."""
    found: list[str] = []
    taken: set[str] = set()
    for text in wanted:
        plain = re.sub(r"[^A-Za-z0-9_.-]", "_", text)[:_LONGEST] or "_"
        name, number = plain, 2
        while name.casefold() in taken:
            tail = f"-{number}"
            name, number = plain[: _LONGEST - len(tail)] + tail, number + 1
        taken.add(name.casefold())
        found.append(name)
    return found
