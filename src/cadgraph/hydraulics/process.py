"""A plant in time: what its gauges show when its valves are turned and its pumps started and stopped."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from numbers import Real
from pathlib import Path

from cadgraph.hydraulics.balance import Balance, default_scenario
from cadgraph.hydraulics.joints import Joints
from cadgraph.hydraulics.remarks import TRICKLE, remarks_of
from cadgraph.hydraulics.scenario_file import read_scenario
from cadgraph.hydraulics.settings import SCENARIO, Scenario
from cadgraph.hydraulics.solve import Solution
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.query.network import Network

__all__ = ["Process", "State"]

STALE = 1e-3  # m; a level that has moved less changes no pressure
LONGEST = 1.0  # s; of a step that is worked out at once
SETTLED = 1e-6  # of a reading, in its unit
MOST_SECONDS = 3600.0  # s; of one step, which is worked out second by second


@dataclass(frozen=True)
class State:
    """A moment.

    Args:
        time: since the beginning [s].
        pressure: [bar(g)] by node: the id of a junction, end or gauge, the id and port of another unit
            (``unit-7:N1``); None where nothing of known pressure ever reached it.
        flow: [m3/s] by number of the connection in the graph, positive from its source to its target.
        reading: what each gauge shows, in its unit and on its scale, by tag; None where nobody knows.
        level: of each tank above its bottom [m], by tag.
        opening: of each valve, by tag; of check and relief valves 1 where they let something through, else 0.
        speed: of each pump as a share of its full speed, by tag.
        shut_in: nodes that nothing of known pressure reaches; they keep the pressure that they had.
        cavitating: tags of pumps that get less than they draw.
        joints: angle of each joint that moves [deg], by its name.
        remarks: what is to be said of it, a sentence each.
    """

    time: float
    pressure: Mapping[str, float | None]
    flow: Mapping[int, float]
    reading: Mapping[str, float | None]
    level: Mapping[str, float]
    opening: Mapping[str, float]
    speed: Mapping[str, float]
    shut_in: frozenset[str]
    cavitating: tuple[str, ...]
    joints: Mapping[str, float] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()


class Process:
    """A plant in time, each moment a steady state: levels, valves and needles move between them; no water hammer.

    Args:
        graph: the finished graph, its network, or where it lies.
        scenario: what is supposed, or the file that says so; None: ``scenario.yaml`` beside the graph where it is
            given by its place and there is one, else the defaults.

    Raises:
        FormatError: there is no graph, or it does not follow the format.
        ScenarioError: the scenario names what is not there, or values that can't be.
    """

    def __init__(self, graph: SceneGraph | Network | str | Path, scenario: Scenario | str | Path | None = None) -> None:
        if isinstance(graph, str | Path):
            path = Path(graph)
            beside = (path if path.is_dir() else path.parent) / SCENARIO
            scenario = beside if scenario is None and beside.exists() else scenario
            graph = SceneGraph.load(path)
        self.network = graph if isinstance(graph, Network) else Network(graph)
        if scenario is None:
            scenario = default_scenario(self.network)
        elif not isinstance(scenario, Scenario):
            scenario = read_scenario(scenario, self.network)
        self.scenario: Scenario = scenario
        """What is supposed."""
        self.balance = Balance(self.network, scenario)
        """The plant at rest, as valves, pumps and levels are now."""
        self._joints = Joints(self.network.graph)
        self._time = 0.0
        self._target = dict(self.balance.opening)
        self._solved_level = dict(self.balance.level)
        self._shown: dict[str, float | None] = {}
        self._measured: dict[str, float | None] = {}
        self._changed = False
        self._state = self._settle()

    @property
    def state(self) -> State:
        """The moment that it has come to."""
        return self._state

    @property
    def solution(self) -> Solution:
        """The flows and heads of the network at that moment."""
        return self.balance.solution

    def step(self, commands: Mapping[str, float] | None = None, dt: float = 1 / 60) -> State:
        """Goes on in time.

        Args:
            commands: where valves are to move to (0 shut, 1 open) and what speed pumps get at once (0 to 1), by tag or
                id. A valve moves as fast as its travel time allows, this step and those after it.
            dt: how long [s].

        Returns:
            The moment after it.

        Raises:
            ValueError: nothing is called so, it can't be moved, or a value can't be.
        """
        self._command(commands or {})
        length: object = dt
        if not isinstance(length, Real) or not 0 < float(length) <= MOST_SECONDS:
            raise ValueError(f"dt {dt}: give a time above 0 s, and at most {MOST_SECONDS:g} s")
        pieces = max(1, math.ceil(dt / LONGEST - 1e-9))
        for _ in range(pieces):
            self._advance(dt / pieces)
        return self._state

    def steady(self, commands: Mapping[str, float] | None = None) -> State:
        """Goes to where everything has come to rest but the levels of tanks, in no time.

        Args:
            commands: as in :meth:`step`.

        Raises:
            ValueError: nothing is called so, it can't be moved, or a value can't be.
        """
        self._command(commands or {})
        self.balance.opening.update(self._target)
        self._state = self._settle()
        return self._state

    def from_joints(self, joints: Mapping[str, float]) -> None:
        """Takes over how far a simulator has turned the valves; the next step works out what follows.

        Args:
            joints: angles [deg] by name of the joint; those of needles are left out of account.

        Raises:
            ValueError: no joint is called so, or an angle is no number.
        """
        for tag, opening in self._joints.openings(joints).items():
            if tag in self.balance.hand:
                self._changed |= self.balance.opening[tag] != opening
                self._target[tag] = self.balance.opening[tag] = opening

    def joints(self) -> dict[str, float]:
        """Angles of all joints [deg], by name: of valves as far as they are open, of needles by what they show."""
        return dict(self._state.joints)

    # Commands

    def _command(self, commands: Mapping[str, float]) -> None:
        """Takes over commands, all of them or none."""
        if not isinstance(commands, Mapping):
            raise ValueError(f"commands: give values by tag, {{'V-001': 0}}, not {reprlib.repr(commands)}")
        found: dict[str, float] = {}
        for name, value in commands.items():
            tag = self._tag(name)
            found[tag] = _share(tag, value)
        for tag, value in found.items():
            if tag in self.balance.speed:
                self._changed |= self.balance.speed[tag] != value
                self.balance.speed[tag] = value
            else:
                self._target[tag] = value

    def _tag(self, name: str) -> str:
        if name in self.balance.hand or name in self.balance.speed:
            return name
        node = self.network.places[self.network.find(name)]
        tag = node.tag if isinstance(node, Unit) else node.id
        if tag in self.balance.hand or tag in self.balance.speed:
            return tag
        if tag in self.scenario.valves:
            raise ValueError(f"{tag} is a {self.scenario.valves[tag].duty} valve: it moves by itself, nobody turns it")
        why = "it has no line" if isinstance(node, Unit) and node.unit_type in ("valve", "pump") else "it does not move"
        raise ValueError(f"{tag} can't be set, as {why}; set valves and pumps")

    # Time

    def _advance(self, dt: float) -> None:
        """One short step."""
        self._time += dt
        for tag, target in self._target.items():
            here = self.balance.opening[tag]
            if here != target:
                travel = self.balance.hand[tag].travel or 0.0
                most = dt / travel if travel > dt * 1e-9 else 1.0
                self.balance.opening[tag] = (
                    target if abs(target - here) <= most else here + math.copysign(most, target - here)
                )
                self._changed = True
        self._changed |= self._fill(dt)
        if self._changed:
            self._solve()
            self._lag(dt)
            self._state = self._make_state()
        elif self._lag(dt):
            self._state = replace(
                self._state, time=self._time, level=self._levels(), reading=self._readings(), joints=self._angles()
            )
        else:
            self._state = replace(self._state, time=self._time, level=self._levels())

    def _levels(self) -> Mapping[str, float]:
        return dict(self.balance.level) if self.balance.level else self._state.level

    def _fill(self, dt: float) -> bool:
        """Moves the levels by what flowed; whether one has moved so far that pressures change."""
        inflow = self.balance.places.inflow(self.balance.solution.flow)
        far = False
        for tag, flow in inflow.items():
            tank = self.scenario.tanks[tag]
            level = min(max(self.balance.level[tag] + flow * dt / tank.area, 0.0), tank.height)
            self.balance.level[tag] = level
            at_end = level in (0.0, tank.height) and self._solved_level[tag] != level
            far |= at_end or abs(level - self._solved_level[tag]) > STALE
        return far

    def _settle(self) -> State:
        """Solves, with every needle where it comes to rest."""
        self._solve()
        self._shown = dict(self._measured)
        return self._make_state()

    def _lag(self, dt: float) -> bool:
        """Moves the needles; whether any has moved."""
        moved = False
        for tag, wanted in self._measured.items():
            here = self._shown[tag]
            if wanted == here:
                continue
            moved, gauge = True, self.scenario.gauges[tag]
            if wanted is None or here is None or abs(wanted - here) < SETTLED or gauge.lag <= 0:
                self._shown[tag] = wanted
            else:
                self._shown[tag] = wanted + (here - wanted) * math.exp(-dt / gauge.lag)
        return moved

    # One state

    def _solve(self) -> None:
        self.balance.solve()
        self._measured = {tag: self.balance.measure(tag) for tag in self.scenario.gauges}
        self._solved_level = dict(self.balance.level)
        self._changed = False

    def _readings(self) -> dict[str, float | None]:
        found: dict[str, float | None] = {}
        for tag, gauge in self.scenario.gauges.items():
            value = self._shown.get(tag)
            found[tag] = None if value is None else min(max(value, 0.0), gauge.span or math.inf)
        return found

    def _angles(self) -> dict[str, float]:
        spans = {tag: gauge.span for tag, gauge in self.scenario.gauges.items()}
        return self._joints.angles(self.balance.opening, self._readings(), spans)

    def _make_state(self) -> State:
        circuit, solution = self.balance.circuit, self.balance.solution
        opening = dict(self.balance.opening)
        for tag, valve in self.scenario.valves.items():
            if valve.duty != "hand":
                links = list(circuit.tags.get(tag, ()))
                opening[tag] = float(bool(links) and bool((solution.flow[links] > TRICKLE).any()))
        cavitating = tuple(sorted(self.balance.places.tag_of[link] for link in solution.cavitating))
        return State(
            time=self._time,
            pressure={name: self.balance.pressure_at(node) for name, node in self.balance.places.told.items()},
            flow=self.balance.places.flows(solution.flow),
            reading=self._readings(),
            level=dict(self.balance.level),
            opening={tag: opening[tag] for tag in self.scenario.valves if tag in opening},
            speed=dict(self.balance.speed),
            shut_in=frozenset(name for name, node in self.balance.places.told.items() if solution.shut_in[node]),
            cavitating=cavitating,
            joints=self._angles(),
            remarks=tuple(self._remarks(cavitating)),
        )

    def _remarks(self, cavitating: tuple[str, ...]) -> Iterator[str]:
        gauges = self.scenario.gauges
        unknown = sum(gauges[tag].measures == "pressure" for tag, value in self._measured.items() if value is None)
        return remarks_of(self.balance, cavitating, unknown)


def _share(tag: str, value: object) -> float:
    """How far open or how fast, once it is sure to be a number that can be."""
    if isinstance(value, bool) or not isinstance(value, Real) or not 0 <= float(value) <= 1:
        raise ValueError(f"{tag}={value}: give a number from 0 (shut, stopped) to 1 (open, full speed)")
    return float(value)
