"""Many plants of one kind in time, each with its own valves, pumps and levels: one solution for all of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from cadgraph.hydraulics.balance import SHUT, flow_share
from cadgraph.hydraulics.batch_solve import BatchSolver, Conditions, Solutions
from cadgraph.hydraulics.process import LONGEST, MOST_SECONDS, SETTLED, STALE, Process
from cadgraph.hydraulics.settings import Scenario
from cadgraph.model.graph import SceneGraph
from cadgraph.query.network import Network

__all__ = ["ProcessBatch"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]


class ProcessBatch:
    """Many plants of one graph and one scenario; each goes its own way, as one :class:`Process` would.

    Results are those of a loop over :class:`~cadgraph.hydraulics.process.Process`: flows and readings agree within
    1e-6 of their units. Where nothing but the past says which pressure a pipe without flow holds, behind check valves,
    the last digits may decide it otherwise.

    Args:
        graph: the finished graph, its network, or where it lies.
        scenario: as of :class:`~cadgraph.hydraulics.process.Process`.
        count: how many plants.

    Raises:
        ValueError: there is none.
        FormatError: there is no graph, or it does not follow the format.
        ScenarioError: the scenario names what is not there, or values that can't be.
    """

    def __init__(
        self, graph: SceneGraph | Network | str | Path, scenario: Scenario | str | Path | None = None, count: int = 1
    ) -> None:
        if count < 1:
            raise ValueError(f"{count} plants: give at least 1")
        self.process = Process(graph, scenario)
        """One plant as all are in the beginning."""
        self.count = count
        balance = self.process.balance
        self.valves = tuple(balance.hand)
        """Tags of the valves that are moved by hand, in the order of the columns of openings."""
        self.pumps = tuple(balance.speed)
        """Tags of the pumps, in the order of the columns of speeds."""
        self.gauges = tuple(self.process.scenario.gauges)
        """Tags of the gauges, in the order of the columns of readings."""
        self.tanks = tuple(balance.level)
        """Tags of the tanks, in the order of the columns of levels."""
        self._solver = BatchSolver(balance.circuit)
        self._constants()
        self.time = np.zeros(count)
        """``(count,)`` since the beginning [s]."""
        self._opening, self._target, self._speed, self._level, self._solved_level, self._shown, self._measured = (
            np.zeros((size, count))
            for size in (
                *(2 * [len(self.valves)]), len(self.pumps), *(2 * [len(self.tanks)]), *(2 * [len(self.gauges)])
            )
        )  # fmt: skip
        self._changed = np.zeros(count, bool)
        self._solution = self._first(count)
        self.reset()

    # What a plant is like

    @property
    def opening(self) -> Floats:
        """``(count, n_valves)`` how far valves are open, 0 to 1; a copy, as all of these."""
        return self._opening.T.copy()

    @property
    def speed(self) -> Floats:
        """``(count, n_pumps)`` of pumps, as share of the full speed."""
        return self._speed.T.copy()

    @property
    def level(self) -> Floats:
        """``(count, n_tanks)`` of tanks above their bottoms [m]."""
        return self._level.T.copy()

    @property
    def reading(self) -> Floats:
        """``(count, n_gauges)`` what gauges show, in their units and on their scales; NaN where nobody knows."""
        shown: Floats = np.clip(self._shown, 0.0, self._span[:, None]).T.copy()
        return shown

    @property
    def flow(self) -> Floats:
        """``(count, n_connections)`` what flows through the graph's connections [m3/s], from source to target."""
        circuit = self.process.balance.circuit
        flow = np.zeros((self.count, int(circuit.connection.max(initial=-1)) + 1))
        pipes = np.flatnonzero(circuit.connection >= 0)
        flow[:, circuit.connection[pipes]] = self._solution.flow[pipes].T
        return flow

    @property
    def cavitating(self) -> Bools:
        """``(count, n_pumps)`` whether a pump gets less than it draws."""
        found = np.zeros((self.count, len(self.pumps)), bool)
        for column, tag in enumerate(self.pumps):
            links = self.process.balance.circuit.tags.get(tag, ())
            found[:, column] = self._solution.cavitating[np.isin(self._solver.pumps, links)].any(axis=0)
        return found

    @property
    def shut_in(self) -> Bools:
        """``(count, n_nodes)`` whether nothing of known head reaches a node of the circuit."""
        return self._solution.shut_in.T.copy()

    # Time

    def reset(self, plants: npt.ArrayLike | None = None) -> None:
        """Takes plants back to the beginning.

        Args:
            plants: ``(n,)`` their numbers, or ``(count,)`` which; all by default.
        """
        chosen, balance, state = self._chosen(plants), self.process.balance, self.process.state
        parts = (
            (self._opening, [balance.opening[tag] for tag in self.valves]),
            (self._target, [balance.opening[tag] for tag in self.valves]),
            (self._speed, [balance.speed[tag] for tag in self.pumps]),
            (self._level, [state.level[tag] for tag in self.tanks]),
            (self._solved_level, [state.level[tag] for tag in self.tanks]),
            (self._shown, self._measured_first),
            (self._measured, self._measured_first),
        )
        for array, values in parts:
            array[:, chosen] = np.array(values, float)[:, None]
        self.time[chosen], self._changed[chosen] = 0.0, False
        self._solution.put(chosen, self._first(len(chosen)))

    def step(
        self, opening: npt.ArrayLike | None = None, speed: npt.ArrayLike | None = None, dt: float = 1 / 60
    ) -> None:
        """Goes on in time, all plants alike.

        Args:
            opening: ``(count, n_valves)`` where valves are to move to; NaN leaves one to what it was told before.
            speed: ``(count, n_pumps)`` what speeds pumps get at once; NaN leaves one as it is.
            dt: how long [s].

        Raises:
            ValueError: values of another shape, or outside 0 to 1; a time that is not above 0, or above 3600.
        """
        if not 0 < dt <= MOST_SECONDS:
            raise ValueError(f"dt {dt}: give a time above 0 s, and at most {MOST_SECONDS:g} s")
        wanted = self._told(opening, self._target, "opening")
        speeds = self._told(speed, self._speed, "speed")
        self._changed |= (speeds != self._speed).any(axis=0)
        self._target, self._speed = wanted, speeds
        pieces = max(1, int(np.ceil(dt / LONGEST - 1e-9)))
        for _ in range(pieces):
            self._advance(dt / pieces)

    def steady(
        self,
        opening: npt.ArrayLike | None = None,
        speed: npt.ArrayLike | None = None,
        plants: npt.ArrayLike | None = None,
    ) -> None:
        """Takes plants to where everything has come to rest but the levels of tanks, in no time.

        Args:
            opening: ``(count, n_valves)`` how far valves are open; NaN leaves one to what it was told before.
            speed: ``(count, n_pumps)`` what speeds pumps get; NaN leaves one as it is.
            plants: ``(n,)`` numbers of plants, or ``(count,)`` which; all by default.

        Raises:
            ValueError: values of another shape, or outside 0 to 1.
        """
        chosen = self._chosen(plants)
        self._target[:, chosen] = self._told(opening, self._target, "opening")[:, chosen]
        self._speed[:, chosen] = self._told(speed, self._speed, "speed")[:, chosen]
        self._opening[:, chosen] = self._target[:, chosen]
        if len(chosen):
            self._solve(chosen)
            self._shown[:, chosen] = self._measured[:, chosen]

    def _chosen(self, plants: npt.ArrayLike | None) -> Ints:
        return np.arange(self.count)[slice(None) if plants is None else np.asarray(plants)]

    def _told(self, values: npt.ArrayLike | None, now: Floats, what: str) -> Floats:
        if values is None:
            return now
        given = np.asarray(values, float).T
        if given.shape != now.shape:
            raise ValueError(f"{what}: an array of shape {now.T.shape} is needed, not {given.T.shape}")
        if ((given < 0) | (given > 1)).any():
            raise ValueError(f"{what}: give numbers from 0 (shut, stopped) to 1 (open, full speed)")
        return np.where(np.isnan(given), now, given)

    def _advance(self, dt: float) -> None:
        """One short step."""
        self.time += dt
        away = self._target - self._opening
        most = np.where(self._travel > dt * 1e-9, dt / np.maximum(self._travel, dt * 1e-9), 1.0)[:, None]
        moved = np.where(np.abs(away) <= most, self._target, self._opening + np.copysign(most, away))
        self._changed |= (away != 0).any(axis=0)
        self._opening = np.where(away != 0, moved, self._opening)
        self._fill(dt)
        plants = np.flatnonzero(self._changed)
        if len(plants):
            self._solve(plants)
        self._lag(dt)

    def _fill(self, dt: float) -> None:
        """Moves the levels by what flowed."""
        for row, (area, height, links) in enumerate(self._vessels):
            flow = self._solution.flow[links].sum(axis=0)
            level = np.clip(self._level[row] + flow * dt / area, 0.0, height)
            self._level[row] = level
            gone = self._solved_level[row]
            at_end = ((level == 0.0) | (level == height)) & (gone != level)
            if links:
                self._changed |= at_end | (np.abs(level - gone) > STALE)

    def _lag(self, dt: float) -> None:
        """Moves the needles."""
        away = self._shown - self._measured
        with np.errstate(invalid="ignore"):
            at_once = np.isnan(away) | (np.abs(away) < SETTLED) | (self._delay <= 0)[:, None]
        rate = np.exp(-dt / np.maximum(self._delay, 1e-300))[:, None]
        self._shown = np.where(at_once, self._measured, self._measured + away * rate)

    # One state of some plants

    def _solve(self, plants: Ints) -> None:
        given, to_air = self._conditions(plants)
        solution = self._solver.solve(given, self._solution.of(plants))
        self._solution.put(plants, solution)
        emptied = self._solver.reach.emptied(solution.head, solution.flow, solution.open, to_air)
        self._measured[:, plants] = self._measure(plants, solution, emptied)
        self._solved_level[:, plants] = self._level[:, plants]
        self._changed[plants] = False

    def _conditions(self, plants: Ints) -> tuple[Conditions, Bools]:
        """What some plants stand under, and which of their links lead into the open."""
        circuit, scenario = self.process.balance.circuit, self.process.scenario
        n, tall = len(plants), np.ones((1, len(plants)))
        square, offset = circuit.square[:, None] * tall, circuit.offset[:, None] * tall
        shut = np.zeros(square.shape, bool)
        one_way = np.repeat(circuit.one_way[:, None], n, axis=1)
        for row, tag in enumerate(self.valves):
            opening = self._opening[row, plants]
            for link in circuit.tags.get(tag, ()):
                shut[link] = opening <= SHUT
                square[link] /= flow_share(opening, self.process.balance.hand[tag].characteristic) ** 2
        for row, tag in enumerate(self.pumps):
            speed = self._speed[row, plants]
            for link in circuit.tags.get(tag, ()):
                one_way[link] = speed > SHUT
                offset[link] *= np.where(speed > SHUT, speed**2, 0.0)
        to_air = circuit.to_air[:, None] & ~shut
        head = self._solution.head[:, plants]
        head[circuit.fixed] = circuit.head[circuit.fixed][:, None]
        for nozzle in circuit.nozzles:
            tank, level = scenario.tanks[nozzle.tag], self._level[self.tanks.index(nozzle.tag), plants]
            surface = tank.bottom + level
            one_way[nozzle.link] = (level <= 0) | (nozzle.height >= surface)
            to_air[nozzle.link] = one_way[nozzle.link] & (tank.pressure == 0)
            head[nozzle.node] = np.maximum(surface, nozzle.height) + scenario.head(tank.pressure)
        floor = circuit.height + scenario.head(scenario.fluid.vapour)
        loop_head = circuit.height + scenario.head(scenario.pipes.loop_pressure)
        return Conditions(square, offset, shut, one_way, head, floor[:, None], loop_head[:, None]), to_air

    def _measure(self, plants: Ints, solution: Solutions, emptied: Bools) -> Floats:
        """``(n_gauges, n)`` what gauges would show without lag and without the end of a scale."""
        balance, scenario = self.process.balance, self.process.scenario
        found = np.full((len(self.gauges), len(plants)), np.nan)
        for row, tag in enumerate(self.gauges):
            gauge, node = scenario.gauges[tag], balance.circuit.gauges.get(tag)
            if gauge.measures == "level":
                if tag in balance.places.tank_of:
                    found[row] = self._level[self.tanks.index(balance.places.tank_of[tag]), plants]
            elif node is None:
                continue
            elif gauge.measures == "pressure":
                pressure = scenario.pressure(1.0) * (solution.head[node] - balance.circuit.height[node])
                found[row] = np.where(emptied[node], 0.0, np.maximum(pressure, scenario.fluid.vapour))
            elif gauge.measures == "flow":
                links = balance.places.links_at_gauge(tag)
                found[row] = np.abs(solution.flow[links]).max(axis=0) * 3600 if len(links) > 1 else 0.0
        return found

    # What never changes

    def _constants(self) -> None:
        process, scenario = self.process, self.process.scenario
        balance = process.balance
        self._travel = np.array([balance.hand[tag].travel or 0.0 for tag in self.valves])
        self._delay = np.array([scenario.gauges[tag].lag for tag in self.gauges])
        spans = [scenario.gauges[tag].span for tag in self.gauges]
        self._span = np.array([np.inf if span is None else span for span in spans])
        values = [balance.measure(tag) for tag in self.gauges]
        self._measured_first = [np.nan if value is None else value for value in values]
        links = {tag: [n.link for n in balance.circuit.nozzles if n.tag == tag] for tag in self.tanks}
        self._vessels = [(scenario.tanks[tag].area, scenario.tanks[tag].height, links[tag]) for tag in self.tanks]

    def _first(self, n: int) -> Solutions:
        """The state of the beginning, for so many plants."""
        return self._solver.several(self.process.solution, n)
