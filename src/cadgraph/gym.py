"""A plant as an environment of Gymnasium: gauges and levels are seen, valves and pumps are moved (``cadgraph[gym]``).

::

    import gymnasium
    import cadgraph.gym

    env = gymnasium.make("cadgraph/Plant-v0", graph="out", task=cadgraph.gym.ReachReading("G-005", 2.5))
    many = gymnasium.make_vec("cadgraph/Plant-v0", 1000, "vector_entry_point", graph="out")

One environment stands on a :class:`~cadgraph.hydraulics.process.Process`, many on one
:class:`~cadgraph.hydraulics.batch.ProcessBatch`: one solution for all of them.
"""

from __future__ import annotations

import copy
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.errors import MissingExtra
from cadgraph.hydraulics.batch import ProcessBatch
from cadgraph.hydraulics.process import MOST_SECONDS, Process
from cadgraph.hydraulics.settings import Scenario
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Unit
from cadgraph.query.network import Network

try:
    import gymnasium
    from gymnasium import spaces
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError as _error:
    raise MissingExtra("a plant as an environment of Gymnasium", "gym") from _error

__all__ = ["Isolate", "KeepLevel", "Moment", "PlantEnv", "PlantVectorEnv", "ReachReading", "Task"]

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

UNKNOWN = -1.0
"""What is observed of a gauge whose reading nobody knows: all others show from 0 to 1."""
_STILL = 1e-6  # m3/s
_LEAST_OPENING = 0.2  # of valves in the beginning, where these are drawn by lot
_SHUFFLED = 0.5  # share of the valves that are then not as the scenario says
_DONE = 1.0  # reward for having done it; each step costs at most as much


@dataclass(frozen=True)
class Moment:
    """What a task judges by, of one plant or many.

    Args:
        reading: ``(n, n_gauges)`` in the order of the scenario; NaN where nobody knows.
        level: ``(n, n_tanks)`` likewise [m].
        flow: ``(n, n_connections)`` as numbered in the graph [m3/s].
        shut_in: ``(n, n_nodes)`` whether nothing of known pressure reaches a node of the circuit.
        speed: ``(n, n_pumps)`` of pumps.
    """

    reading: Floats
    level: Floats
    flow: Floats
    shut_in: Bools
    speed: Floats


class Task(ABC):
    """What is to be done, and how well a moment is for it."""

    @abstractmethod
    def bind(self, process: Process) -> None:
        """Finds in a plant what the task speaks of.

        Args:
            process: of the plant.

        Raises:
            ValueError: it isn't there, or the goal can't be.
        """

    @abstractmethod
    def judge(self, moment: Moment) -> tuple[Floats, Bools, Bools]:
        """How well a moment is.

        Args:
            moment: of n plants.

        Returns:
            Rewards ``(n,)``; whether it is done ``(n,)``, whether it has failed ``(n,)``: either ends the episode.
        """


class ReachReading(Task):
    """A gauge is to show a value. Each step costs the distance, as share of the span.

    Args:
        gauge: its tag.
        reading: that it is to show, in its unit.
        within: how near it has to come, as share of the span.
    """

    def __init__(self, gauge: str, reading: float, within: float = 0.02) -> None:
        self.gauge, self.reading, self.within = gauge, reading, within
        self._row, self._span = 0, 1.0

    def bind(self, process: Process) -> None:
        """Finds the gauge."""
        gauges = list(process.scenario.gauges)
        tag = _tag(process, self.gauge)
        span = process.scenario.gauges[tag].span if tag in gauges else None
        if span is None:
            raise ValueError(f"{self.gauge} is no gauge that shows anything; there are {', '.join(gauges) or 'none'}")
        if not 0 <= self.reading <= span:
            raise ValueError(f"{tag} can't show {self.reading:g}: its scale goes from 0 to {span:g}")
        self._row, self._span = gauges.index(tag), span

    def judge(self, moment: Moment) -> tuple[Floats, Bools, Bools]:
        """How near the reading is."""
        away = np.abs(moment.reading[:, self._row] - self.reading) / self._span
        away = np.where(np.isnan(away), 1.0, away)
        done = away <= self.within
        return np.where(done, _DONE, -away), done, np.zeros(len(done), bool)


class Isolate(Task):
    """A unit is to be cut off: nothing of known pressure reaches any of its ports, and it stands still.

    Each step costs the share of its lines that are not cut off, and the share of the flow elsewhere that is lost.

    Args:
        unit: its tag.
    """

    def __init__(self, unit: str) -> None:
        self.unit = unit
        self._nodes: list[int] = []
        self._own: list[int] = []
        self._pump: int | None = None
        self._usual = np.zeros(0)

    def bind(self, process: Process) -> None:
        """Finds the unit's ports."""
        network, circuit = process.network, process.balance.circuit
        place = network.find(self.unit)
        node = network.places[place]
        self._nodes = [
            number for number, name in enumerate(circuit.nodes)
            if name == place or (name.startswith(f"{place}:") and not name.endswith((":outside", ":inside", ":middle")))
        ]  # fmt: skip
        if not self._nodes:
            raise ValueError(f"no line was found at {self.unit}, so it can't be isolated")
        tag = node.tag if isinstance(node, Unit) else node.id
        pumps = list(process.scenario.pumps)
        self._pump = pumps.index(tag) if tag in pumps else None
        edges = network.graph.of_kind(Connected)
        self._own = [number for number, edge in enumerate(edges) if place in (edge.source, edge.target)]
        self._usual = np.abs(_flows(process.state.flow, len(edges)))
        self._usual[self._own] = 0.0

    def judge(self, moment: Moment) -> tuple[Floats, Bools, Bools]:
        """How far it is cut off."""
        reached = 1 - moment.shut_in[:, self._nodes].mean(axis=1)
        still = np.abs(moment.flow[:, self._own]).max(axis=1, initial=0.0) < _STILL
        runs = np.zeros(len(reached)) if self._pump is None else (moment.speed[:, self._pump] > 0).astype(float)
        done: Bools = (reached == 0) & still & (runs == 0)
        kept = np.minimum(np.abs(moment.flow), self._usual).sum(axis=1)
        lost = 1 - kept / self._usual.sum() if self._usual.sum() > 0 else np.zeros(len(done))
        cost = 0.5 * reached + 0.25 * runs + 0.25 * lost
        return np.where(done, _DONE - 0.25 * lost, -cost), done, np.zeros(len(done), bool)


class KeepLevel(Task):
    """The level of a tank is to be kept until time is up; running dry or over is failure.

    Dry it is when it is empty, or down to the lowest of the openings that something is known to flow out of: what
    draws from there gets nothing any more. Each step earns up to 1, the less the further away the level is.

    Args:
        tank: its tag.
        level: to keep [m]; that of the beginning if None.
    """

    def __init__(self, tank: str, level: float | None = None) -> None:
        self.tank, self.level = tank, level
        self._row, self._goal, self._dry, self._height = 0, 0.0, 0.0, 1.0

    def bind(self, process: Process) -> None:
        """Finds the tank."""
        tanks, tag = list(process.scenario.tanks), _tag(process, self.tank)
        if tag not in tanks:
            raise ValueError(f"{self.tank} is no tank; there are {', '.join(tanks) or 'none'}")
        setting = process.scenario.tanks[tag]
        self._row, self._height = tanks.index(tag), setting.height
        outlets = [nozzle.height for nozzle in process.balance.outlets(tag)]
        self._dry = max(0.0, min(outlets, default=setting.bottom) - setting.bottom)
        self._goal = setting.level if self.level is None else self.level
        if not self._dry < self._goal < setting.height:
            raise ValueError(
                f"{tag} can't be kept at {self._goal:g} m: it feeds what it flows out to from {self._dry:g} to "
                f"{setting.height:g} m"
            )

    def judge(self, moment: Moment) -> tuple[Floats, Bools, Bools]:
        """How near the level is."""
        level = moment.level[:, self._row]
        failed = (level <= self._dry) | (level >= self._height)
        away = np.abs(level - self._goal) / self._height
        return np.where(failed, -_DONE, 1 - away), np.zeros(len(level), bool), failed


@dataclass(frozen=True)
class _Shape:
    """What is seen and moved of a plant, in which order.

    Args:
        valves: tags of those that are moved.
        pumps: likewise.
        gauges: tags of those that show anything.
        rows: ``(n_gauges,)`` where they stand among all gauges.
        spans: ``(n_gauges,)`` what is at the end of their scales.
        tanks: tags of the tanks.
        heights: ``(n_tanks,)`` of the tanks [m].
        opening: ``(n_valves,)`` in the beginning.
    """

    valves: tuple[str, ...]
    pumps: tuple[str, ...]
    gauges: tuple[str, ...]
    rows: npt.NDArray[np.int64]
    spans: Floats
    tanks: tuple[str, ...]
    heights: Floats
    opening: Floats

    @classmethod
    def of(cls, process: Process) -> _Shape:
        gauges = process.scenario.gauges
        shown = [tag for tag, gauge in gauges.items() if gauge.measures != "nothing" and gauge.span]
        return cls(
            tuple(process.balance.hand), tuple(process.balance.speed), tuple(shown),
            np.array([list(gauges).index(tag) for tag in shown], np.int64),
            np.array([gauges[tag].span for tag in shown], float),
            tuple(process.scenario.tanks),
            np.array([tank.height for tank in process.scenario.tanks.values()]),
            np.array([process.balance.opening[tag] for tag in process.balance.hand]),
        )  # fmt: skip

    @property
    def observed_names(self) -> tuple[str, ...]:
        """Tags in the order of what is observed."""
        return (*self.gauges, *self.tanks)

    @property
    def moved_names(self) -> tuple[str, ...]:
        """Tags in the order of actions."""
        return (*self.valves, *self.pumps)

    def action_space(self) -> spaces.Box:
        return spaces.Box(0.0, 1.0, (len(self.valves) + len(self.pumps),), np.float32)

    def observation_space(self) -> spaces.Box:
        return spaces.Box(UNKNOWN, 1.0, (len(self.gauges) + len(self.heights),), np.float32)

    def observed(self, moment: Moment) -> npt.NDArray[np.float32]:
        """``(n, n_observed)`` readings as shares of spans, then levels as shares of heights."""
        shown = moment.reading[:, self.rows] / self.spans
        seen = np.concatenate([np.where(np.isnan(shown), UNKNOWN, shown), moment.level / self.heights], axis=1)
        clipped: npt.NDArray[np.float32] = np.clip(seen, UNKNOWN, 1.0).astype(np.float32)
        return clipped

    def drawn(self, lot: np.random.Generator, n: int) -> Floats:
        """``(n, n_valves)`` openings to begin with: about half of the valves are not as the scenario says."""
        size = (n, len(self.valves))
        other = lot.uniform(_LEAST_OPENING, 1.0, size)
        return np.where(lot.random(size) < _SHUFFLED, other, self.opening)


def _bound(task: Task | None, process: Process) -> Task | None:
    """A copy of a task that is bound to a plant: a task may be given to several."""
    own = copy.deepcopy(task)
    if own is not None:
        own.bind(process)
    return own


def _check(process: Process, dt: float, seconds: float, task: object) -> None:
    if task is not None and not isinstance(task, Task):
        raise ValueError(f"task: give a Task, as ReachReading(gauge, value), not {task!r:.60}")
    if not process.balance.hand and not process.balance.speed:
        raise ValueError("nothing can be moved in this plant: it has no valve and no pump with a line")
    if not (0 < dt <= MOST_SECONDS and dt <= seconds < math.inf):
        raise ValueError(
            f"dt {dt}, seconds {seconds}: give a step above 0 s, at most {MOST_SECONDS:g} s, and an end not before it"
        )


class PlantEnv(gymnasium.Env[npt.NDArray[np.float32], npt.NDArray[np.float32]]):
    """One plant.

    Observed are the readings of gauges as shares of their spans, -1 where nobody knows, and the levels of tanks as
    shares of their heights, in the order of the scenario; ``info`` names them. An action says how far each valve is to
    be open, 0 to 1, then the speed of each pump; valves take their time to get there.

    Args:
        graph: the finished graph, its network, or the folder that it lies in.
        scenario: as of :class:`~cadgraph.hydraulics.process.Process`.
        task: what is to be done; without one all rewards are 0.
        dt: how long a step takes [s].
        seconds: after which the episode is cut off.
        shuffle: whether about half of the valves begin elsewhere than the scenario says, by lot.
        render_mode: none is known.

    Raises:
        ValueError: nothing can be moved, or the task speaks of what isn't there.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012 - as Gymnasium has it

    def __init__(
        self,
        graph: SceneGraph | Network | str | Path,
        scenario: Scenario | str | Path | None = None,
        task: Task | None = None,
        *,
        dt: float = 1.0,
        seconds: float = 120.0,
        shuffle: bool = True,
        render_mode: None = None,
    ) -> None:
        self.process = Process(graph, scenario)
        """The plant, for reading."""
        _check(self.process, dt, seconds, task)
        self.task = _bound(task, self.process)
        self.dt, self.seconds, self.shuffle, self.render_mode = dt, seconds, shuffle, render_mode
        self._shape = _Shape.of(self.process)
        self._n_connections = len(self.process.network.graph.of_kind(Connected))
        self.action_space = self._shape.action_space()
        self.observation_space = self._shape.observation_space()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float32], dict[str, Any]]:
        """Begins anew.

        Args:
            seed: of the lot.
            options: none is known.
        """
        super().reset(seed=seed)
        # Anew from the ground, so that nothing of what was before is in the last digits.
        self.process = Process(self.process.network, self.process.scenario)
        if self.shuffle:
            opening = self._shape.drawn(self.np_random, 1)[0]
            self.process.steady(dict(zip(self._shape.valves, opening.tolist(), strict=True)))
        return self._shape.observed(self._moment())[0], self._info()

    def step(
        self, action: npt.NDArray[np.float32]
    ) -> tuple[npt.NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Moves valves and pumps, and goes on by ``dt``.

        Args:
            action: ``(n_valves + n_pumps,)`` from 0 to 1.

        Raises:
            ValueError: it has another shape, or a number is out of range.
        """
        tags = self._shape.moved_names
        values = _fitting(action, (len(tags),)).tolist()
        self.process.step(dict(zip(tags, values, strict=True)), self.dt)
        moment = self._moment()
        reward, done, failed = _judged(self.task, moment)
        over = self.process.state.time >= self.seconds - self.dt / 2
        ended = bool(done[0] | failed[0])
        info = self._info() | {"success": bool(done[0])}
        return self._shape.observed(moment)[0], float(reward[0]), ended, over and not ended, info

    def _moment(self) -> Moment:
        state, process = self.process.state, self.process
        readings = [math.nan if value is None else value for value in state.reading.values()]
        return Moment(
            np.array([readings]),
            np.array([list(state.level.values())]).reshape(1, -1),
            _flows(state.flow, self._n_connections)[None],
            process.solution.shut_in[None],
            np.array([list(state.speed.values())]).reshape(1, -1),
        )

    def _info(self) -> dict[str, Any]:
        state = self.process.state
        return {
            "observed": list(self._shape.observed_names),
            "moved": list(self._shape.moved_names),
            "opening": dict(state.opening),
            "remarks": list(state.remarks),
            "time": state.time,
        }


class PlantVectorEnv(VectorEnv[npt.NDArray[np.float32], npt.NDArray[np.float32], npt.NDArray[Any]]):
    """Many plants of one graph and one scenario, solved together; what ends begins anew at the next step.

    Args:
        num_envs: how many.
        graph: as of :class:`PlantEnv`, as are all others.
        scenario: likewise.
        task: likewise.
        dt: likewise.
        seconds: likewise.
        shuffle: likewise.
        render_mode: likewise.

    Raises:
        ValueError: as of :class:`PlantEnv`.
    """

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int,
        graph: SceneGraph | Network | str | Path,
        scenario: Scenario | str | Path | None = None,
        task: Task | None = None,
        *,
        dt: float = 1.0,
        seconds: float = 120.0,
        shuffle: bool = True,
        render_mode: None = None,
    ) -> None:
        self.num_envs = num_envs
        self.plants = ProcessBatch(graph, scenario, num_envs)
        """The plants, for reading."""
        _check(self.plants.process, dt, seconds, task)
        self.task = _bound(task, self.plants.process)
        self.dt, self.seconds, self.shuffle, self.render_mode = dt, seconds, shuffle, render_mode
        self._shape = _Shape.of(self.plants.process)
        self.single_action_space = self._shape.action_space()
        self.single_observation_space = self._shape.observation_space()
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._ended = np.zeros(num_envs, bool)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float32], dict[str, Any]]:
        """Begins anew, all plants.

        Args:
            seed: of the lot of all plants together.
            options: none is known.

        Returns:
            What is observed, ``(num_envs, n_observed)``, and what names its columns and those of actions:
            ``info["observed"][0]``, ``info["moved"][0]``.

        Raises:
            ValueError: a seed for each plant.
        """
        if isinstance(seed, list):
            raise ValueError("one seed for all plants is needed, not one for each")
        super().reset(seed=seed)
        self._begin(np.arange(self.num_envs))
        self._ended[:] = False
        # An entry for each plant, as wrappers of Gymnasium expect it.
        named: dict[str, Any] = {"observed": self._shape.observed_names, "moved": self._shape.moved_names}
        info = {key: np.fromiter([list(names)] * self.num_envs, object) for key, names in named.items()}
        return self._shape.observed(self._moment()), info

    def step(
        self, actions: npt.NDArray[np.float32]
    ) -> tuple[npt.NDArray[np.float32], npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """Moves valves and pumps of all plants, and goes on by ``dt``; those that have ended begin anew instead.

        Args:
            actions: ``(num_envs, n_valves + n_pumps)`` from 0 to 1.

        Raises:
            ValueError: they have another shape, or a number is out of range.
        """
        n_valves = len(self._shape.valves)
        values = _fitting(actions, (self.num_envs, n_valves + len(self._shape.pumps)))
        anew = self._ended.copy()
        self.plants.step(values[:, :n_valves], values[:, n_valves:], self.dt)
        if anew.any():
            self._begin(np.flatnonzero(anew))
        moment = self._moment()
        reward, done, failed = _judged(self.task, moment)
        over = self.plants.time >= self.seconds - self.dt / 2
        ended = (done | failed) & ~anew
        cut = over & ~ended & ~anew
        self._ended = ended | cut
        info = {"success": done & ~anew}
        return self._shape.observed(moment), np.where(anew, 0.0, reward), ended, cut, info

    def _begin(self, plants: npt.NDArray[np.int64]) -> None:
        self.plants.reset(plants)
        if self.shuffle:
            opening = np.full((self.num_envs, len(self._shape.valves)), np.nan)
            opening[plants] = self._shape.drawn(self.np_random, len(plants))
            self.plants.steady(opening, plants=plants)

    def _moment(self) -> Moment:
        plants = self.plants
        return Moment(plants.reading, plants.level, plants.flow, plants.shut_in, plants.speed)


def _fitting(action: npt.ArrayLike, shape: tuple[int, ...]) -> Floats:
    """An action as numbers, where it has the shape of one."""
    values: Floats = np.asarray(action, float)
    if values.shape != shape:
        raise ValueError(
            f"an action has the shape {shape}, a number for each valve, then each pump; not {values.shape}"
        )
    return values


def _judged(task: Task | None, moment: Moment) -> tuple[Floats, Bools, Bools]:
    if task is not None:
        return task.judge(moment)
    n = len(moment.flow)
    return np.zeros(n), np.zeros(n, bool), np.zeros(n, bool)


def _tag(process: Process, name: str) -> str:
    node = process.network.places[process.network.find(name)]
    return node.tag if isinstance(node, Unit) else node.id


def _flows(flow: Mapping[int, float], n: int) -> Floats:
    found = np.zeros(n)
    found[list(flow)] = list(flow.values())
    return found


gymnasium.register(
    id="cadgraph/Plant-v0", entry_point="cadgraph.gym:PlantEnv", vector_entry_point="cadgraph.gym:PlantVectorEnv"
)
