"""Tasks of a plant, drawn by a seed, each played through before it is kept."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass

from cadgraph.errors import Unconnected
from cadgraph.hydraulics.balance import SHUT
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.settings import Scenario
from cadgraph.hydraulics.text import assumed_values
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part, Place, Unit
from cadgraph.model.scene import Scene
from cadgraph.query.isolate import find_isolation
from cadgraph.query.mechanisms import say_not_movable
from cadgraph.query.network import Network
from cadgraph.simulate.tasks.checking import begin, changed_gauges, check
from cadgraph.simulate.tasks.hands import Hands
from cadgraph.simulate.tasks.records import Goal, LeftOut, Solution, Start, Stop, Task, TaskKind, TaskList

__all__ = ["make_tasks"]

_ROUNDS = 10  # starts that are drawn at most: a small plant has no more tasks that differ
_TOLERANCE = 0.02  # of the span of a gauge, within which a reading counts as read
_COUNTS = 0.01  # of its span, by which a gauge has to change to count
_REACH = 2.0  # m above where one stands, as in the reach of a unit
_SURE = 0.8  # a facing of less confidence is told as a doubt
_OPENINGS = (0.0, 0.25, 0.5, 0.75)  # that valves stand at in a drawn start
_NEVER_ISOLATED = ("valve", "gauge", "tank")
_TEXTS = {
    "read": "read {}",
    "close": "close {} and see which gauges fall",
    "open": "open {} and see which gauges rise",
    "isolate": "isolate {}",
}


def make_tasks(graph: SceneGraph, scene: Scene, scenario: Scenario, *, seed: int = 0, n: int = 50) -> TaskList:
    """Tasks that can be done in a plant, and what can't be, with the reasons.

    The first tasks begin with the plant as the scenario has it, each unit once for each kind of task; where more are
    asked for, valves stand elsewhere and pumps still at their start. Each is kept only if its own solution passes the
    check. The same arguments give the same tasks.

    Args:
        graph: the finished graph, with places and mechanisms.
        scene: that it was made from, all meshes.
        scenario: what is supposed of the plant.
        seed: of what is drawn.
        n: how many tasks at most.

    Raises:
        ValueError: ``n`` is below 1.
    """
    if n < 1:
        raise ValueError(f"n={n}: ask for at least one task")
    maker = _Maker(graph, Hands(scene), scenario)
    draw = random.Random(seed)
    candidates = maker.candidates()
    draw.shuffle(candidates)
    tasks: list[Task] = []
    known: set[str] = set()
    left_out: dict[str, tuple[str, ...]] = {}
    for number in range(_ROUNDS):
        for kind, unit in candidates:
            if len(tasks) >= n and number:
                break
            start = maker.drawn_start(draw, shut=unit.tag if kind == "open" else None) if number else maker.start()
            made = maker.make(f"task-{len(tasks) + 1:03d}", kind, unit, start)
            if isinstance(made, LeftOut):
                if not number:
                    left_out[made.text] = made.reasons
            elif made is not None and len(tasks) < n and _key(made) not in known and not (number and _is_dull(made)):
                known.add(_key(made))
                tasks.append(made)
    return TaskList(
        seed=seed,
        source_sha256=graph.source.sha256,
        assumptions=len(assumed_values(scenario)),
        tasks=tuple(tasks),
        left_out=tuple(LeftOut(text=text, reasons=left_out[text]) for text in sorted(left_out)),
    )


def _is_dull(task: Task) -> bool:
    """Whether nothing is to be seen in it."""
    return task.goal.gauges is not None and not task.solution.answer


def _key(task: Task) -> str:
    return task.model_dump_json(include={"kind", "unit", "start"})


@dataclass(frozen=True)
class _Wanted:
    """What a task asks for, and one way to do it."""

    goal: Goal
    moves: dict[str, float]
    at: tuple[Unit, ...]
    remarks: tuple[str, ...] = ()


class _Maker:
    """Makes tasks of one plant.

    Args:
        graph: the finished graph.
        hands: ways for a hand in it.
        scenario: what is supposed.
    """

    def __init__(self, graph: SceneGraph, hands: Hands, scenario: Scenario) -> None:
        self._graph = graph
        self._network = Network(graph)
        self._hands = hands
        self._scenario = scenario
        self._process = Process(self._network, scenario)
        self._units = {unit.tag: unit for unit in graph.of_layer(Unit)}
        self._stops: dict[str, Stop | tuple[str, ...]] = {}

    def candidates(self) -> list[tuple[TaskKind, Unit]]:
        """All that may be a task."""
        found: list[tuple[TaskKind, Unit]] = []
        for unit in self._graph.of_layer(Unit):
            if unit.unit_type == "gauge":
                found.append(("read", unit))
            elif unit.tag in self._process.balance.hand:
                found += [("close", unit), ("open", unit)]
            elif unit.unit_type not in _NEVER_ISOLATED and unit.ports:
                found.append(("isolate", unit))
        return found

    def start(self) -> Start:
        """The plant as the scenario has it."""
        balance = self._process.balance
        return Start(
            opening={tag: round(balance.opening[tag], 6) for tag in sorted(balance.hand)},
            speed={tag: round(speed, 6) for tag, speed in sorted(balance.speed.items())},
        )

    def drawn_start(self, draw: random.Random, shut: str | None = None) -> Start:
        """The plant with a valve or two elsewhere, or a pump that stands still, and one valve shut."""
        first = self.start()
        opening, speed = dict(first.opening), dict(first.speed)
        for tag in draw.sample(sorted(opening), min(len(opening), draw.randint(1, 2))):
            opening[tag] = draw.choice(_OPENINGS)
        if speed and draw.random() < 0.3:
            speed[draw.choice(sorted(speed))] = 0.0
        if shut is not None:
            opening[shut] = 0.0
        return Start(opening=opening, speed=speed)

    def make(self, name: str, kind: TaskKind, unit: Unit, start: Start) -> Task | LeftOut | None:
        """A task, or why it is none; None where all is done at its start already."""
        text = _TEXTS[kind].format(unit.tag)
        if kind in ("close", "open") and abs(start.opening[unit.tag] - (kind == "open")) <= SHUT:
            return None
        wanted = self._wanted(kind, unit, start)
        if not isinstance(wanted, _Wanted):
            return LeftOut(text=text, reasons=wanted)
        stops = [self._stop(each) for each in wanted.at]
        missing = tuple(reason for stop in stops if not isinstance(stop, Stop) for reason in stop)
        if missing:
            return LeftOut(text=text, reasons=missing)
        task = Task(
            id=name,
            kind=kind,
            text=text,
            unit=unit.id,
            tag=unit.tag,
            start=start,
            goal=wanted.goal,
            stops=tuple(stop for stop in stops if isinstance(stop, Stop)),
            remarks=wanted.remarks,
            solution=Solution(set=wanted.moves),
        )
        return self._played(task)

    def _played(self, task: Task) -> Task | LeftOut | None:
        """The task with what has to be told at its end, once its own solution has passed the check."""
        process = begin(task, self._network, self._scenario)
        first = process.state
        if task.kind == "isolate" and check(task, (first,)).done:
            return None
        last = process.steady(task.solution.set)
        answer: float | tuple[str, ...] | None = None
        if task.goal.reading is not None:
            shown = last.reading.get(task.goal.reading)
            if shown is None:
                return LeftOut(text=task.text, reasons=(f"what {task.tag} shows, nobody knows",))
            answer = round(shown, 6)
        elif task.goal.gauges is not None:
            answer = changed_gauges(task, first, last)
        result = check(task, (first, last), answer)
        if not result.done:
            return LeftOut(text=task.text, reasons=tuple(f"tried, and {reason}" for reason in result.reasons))
        return task.model_copy(update={"solution": Solution(set=task.solution.set, answer=answer)})

    # What each kind asks for

    def _wanted(self, kind: TaskKind, unit: Unit, start: Start) -> _Wanted | tuple[str, ...]:
        if kind == "read":
            return self._reading(unit)
        if kind == "isolate":
            return self._isolating(unit, start)
        aim = 0.0 if kind == "close" else 1.0
        goal = Goal(opening={unit.tag: aim}, gauges="fall" if kind == "close" else "rise", least=self._least())
        return _Wanted(goal, {unit.tag: aim}, (unit,))

    def _reading(self, unit: Unit) -> _Wanted | tuple[str, ...]:
        gauge = self._scenario.gauges.get(unit.tag)
        if gauge is None or gauge.measures == "nothing" or gauge.span is None:
            return (f"{unit.tag}: what it measures, or its scale, is not known",)
        return _Wanted(Goal(reading=unit.tag, tolerance=round(_TOLERANCE * gauge.span, 9)), {}, (unit,))

    def _isolating(self, unit: Unit, start: Start) -> _Wanted | tuple[str, ...]:
        try:
            found = find_isolation(self._network, unit.id)
        except Unconnected as error:
            return (str(error),)
        if found.openings:
            return tuple(f"{one.name}: {one.why}" for one in found.openings)
        valves = [self._graph.nodes[one.place] for one in found.valves]
        units = tuple(node for node in valves if isinstance(node, Unit))
        fixed = [one.tag for one in units if one.tag not in self._process.balance.hand]
        if not units:
            return ("no valve can be shut by hand",)
        if fixed:
            return (f"{', '.join(fixed)} would have to be shut, which nobody moves by hand",)
        doubts = tuple(f"unsure by the graph: {doubt.text}" for doubt in found.doubts)
        return self._shutting_off(unit, units, unit.tag in start.speed, doubts)

    def _shutting_off(self, unit: Unit, valves: tuple[Unit, ...], is_pump: bool, doubts: tuple[str, ...]) -> _Wanted:
        goal = Goal(
            still=tuple(sorted({arc.index for arc in self._network.arcs(unit.id)})),
            shut_in=tuple(name for name in self._process.state.pressure if _is_of(name, unit)),
            stopped=(unit.tag,) if is_pump else (),
            untouched=False,
        )
        moves = {one.tag: 0.0 for one in valves}
        if not is_pump:
            return _Wanted(goal, moves, valves, doubts)
        switched = f"{unit.tag} is stopped from where it is switched, which is not in the plant"
        return _Wanted(goal, {**moves, unit.tag: 0.0}, valves, (*doubts, switched))

    def _least(self) -> dict[str, float]:
        return {
            tag: round(_COUNTS * gauge.span, 9)
            for tag, gauge in sorted(self._scenario.gauges.items())
            if gauge.span is not None and gauge.measures != "nothing"
        }

    # Where to stand and how to get at it

    def _stop(self, unit: Unit) -> Stop | tuple[str, ...]:
        """Where one works at a unit, or why nobody can."""
        if unit.id not in self._stops:
            self._stops[unit.id] = self._find_stop(unit)
        return self._stops[unit.id]

    def _find_stop(self, unit: Unit) -> Stop | tuple[str, ...]:
        reasons = tuple(self._out_of_reach(unit))
        access = unit.access
        if access is None or reasons:
            return reasons
        if unit.unit_type == "gauge":
            remarks = () if (access.facing_confidence or 0.0) >= _SURE else ("which way its face looks is not sure",)
            return Stop(
                unit=unit.id, tag=unit.tag, does="read", place=access.place, stand=access.stand,
                viewpoint=access.viewpoint, remarks=remarks,
            )  # fmt: skip
        mechanism = unit.mechanism
        if mechanism is None:
            actuated = "it is moved by an actuator, not by hand" if self._has_actuator(unit) else ""
            missing = "its wheel or lever was not found"
            return (f"{unit.tag}: {actuated or say_not_movable(self._graph, unit) or missing}",)
        ring, hand, tried = self._hands.find(mechanism, access.stand)
        if hand is None:
            return (f"{unit.tag}: a hand meets something on each of {tried} ways to its {mechanism.kind}",)
        piece = "its own body was not looked at as an obstacle, as it is one mesh with what moves"
        return Stop(
            unit=unit.id, tag=unit.tag, does="pull" if mechanism.kind == "lever" else "turn", place=access.place,
            stand=access.stand, ring=ring, hand=hand, remarks=(piece,) if mechanism.pieces else (),
        )  # fmt: skip

    def _has_actuator(self, unit: Unit) -> bool:
        nodes = (self._graph.nodes[part] for part in unit.parts)
        labels = (node.label for node in nodes if isinstance(node, Part))
        return any(label is not None and label.name == "actuator" for label in labels)

    def _out_of_reach(self, unit: Unit) -> Iterator[str]:
        access = unit.access
        if access is None:
            yield f"{unit.tag}: where to stand is not known, as the graph was built without places"
        elif unit.unit_type == "gauge":
            if access.viewpoint is None or access.stand is None:
                yield f"{unit.tag}: no place to stand was found from which its face is seen"
        elif access.reach == "out of reach" or access.stand is None:
            place = self._graph.nodes.get(access.place or "")
            level = place.name if isinstance(place, Place) else "ground"
            why = "" if access.height > _REACH else ": no free place to stand near it was found"
            yield f"{unit.tag}: {access.height:.1f} m above the {level}, out of reach{why}"


def _is_of(name: str, unit: Unit) -> bool:
    """Whether a node of the process belongs to a unit."""
    return name == unit.id or name.startswith(f"{unit.id}:")
