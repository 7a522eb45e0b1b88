"""Whether a task is done: by the states that the plant went through, never by what somebody says of them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from cadgraph.hydraulics.balance import SHUT
from cadgraph.hydraulics.process import Process, State
from cadgraph.hydraulics.settings import Scenario
from cadgraph.model.graph import SceneGraph
from cadgraph.query.network import Network
from cadgraph.simulate.tasks.records import Task

__all__ = ["Answer", "Result", "begin", "changed_gauges", "check"]

Answer = float | Collection[str] | None
"""What is told at the end of a task: a reading, or tags of gauges; None where nothing is asked for."""

_CLOSE = 1e-3  # of an opening or a speed
_STILL = 1e-6  # m3/s


@dataclass(frozen=True)
class Result:
    """Of a check.

    Args:
        done: whether the task is done.
        reasons: why not, a sentence each; none where it is.
    """

    done: bool
    reasons: tuple[str, ...]


def begin(task: Task, graph: SceneGraph | Network, scenario: Scenario) -> Process:
    """A process at the start of a task.

    Args:
        task: of this plant.
        graph: the finished graph, or its network.
        scenario: that the task was made with.

    Raises:
        ValueError: the task names valves or pumps that this plant or scenario hasn't.
    """
    process = Process(graph, scenario)
    process.steady({**task.start.opening, **task.start.speed})
    return process


def check(task: Task, history: Sequence[State], answer: Answer = None) -> Result:
    """Whether a task is done.

    Args:
        task: what was to be done.
        history: states of a :class:`~cadgraph.hydraulics.process.Process`, from the start of the task to its end.
        answer: what is told at the end.
    """
    if not history:
        return Result(False, ("no state was given: what was done, nobody knows",))
    reasons = (*_begins(task, history), *_state_reached(task, history[0], history[-1]), *_told(task, history, answer))
    return Result(not reasons, reasons)


def changed_gauges(task: Task, first: State, last: State, share: float = 1.0) -> tuple[str, ...]:
    """The gauges that fell or rose, as the task asks, by at least a share of what counts; by tag."""
    sense = -1.0 if task.goal.gauges == "fall" else 1.0
    found = []
    for tag, least in task.goal.least.items():
        before, after = first.reading.get(tag), last.reading.get(tag)
        if before is not None and after is not None and sense * (after - before) >= share * least:
            found.append(tag)
    return tuple(sorted(found))


def _begins(task: Task, history: Sequence[State]) -> Iterator[str]:
    first = history[0]
    if any(later.time < earlier.time for earlier, later in zip(history, history[1:], strict=False)):
        yield "the states are not in the order of time"
    for wanted, found, what in (
        (task.start.opening, first.opening, "open"),
        (task.start.speed, first.speed, "of its speed"),
    ):
        for tag, value in wanted.items():
            here = found.get(tag)
            if here is None or abs(here - value) > _CLOSE:
                found_ = f"{tag} is {_share(here)} {what}, not {_share(value)}"
                yield f"the first state is not the start of the task: {found_}"


def _state_reached(task: Task, first: State, last: State) -> Iterator[str]:
    goal = task.goal
    for tag, value in goal.opening.items():
        here = last.opening.get(tag)
        reached = here is not None and (here <= SHUT if value <= SHUT else here >= value - _CLOSE)
        if not reached:
            yield f"{tag} is {_share(here)} open, not {_share(value)}"
    for tag in goal.stopped:
        if last.speed.get(tag, 1.0) > SHUT:
            yield f"{tag} still runs"
    flowing = [number for number in goal.still if not abs(last.flow.get(number, math.inf)) <= _STILL]
    if flowing:
        most = max(abs(last.flow.get(number, math.inf)) for number in flowing) * 3600
        yield f"{task.tag}: {len(flowing)} of its connections still carry up to {most:.3g} m3/h"
    fed = [node for node in goal.shut_in if node not in last.shut_in]
    if fed:
        yield f"{task.tag}: a known pressure still reaches {len(fed)} of its {len(goal.shut_in)} ports"
    if goal.untouched:
        yield from _moved_too(task, last)


def _moved_too(task: Task, last: State) -> Iterator[str]:
    for wanted, found in ((task.start.opening, last.opening), (task.start.speed, last.speed)):
        for tag, value in wanted.items():
            if tag not in task.goal.opening and tag not in task.goal.stopped:
                here = found.get(tag)
                if here is None or abs(here - value) > _CLOSE:
                    yield f"{tag} was moved as well: from {_share(value)} to {_share(here)}"


def _told(task: Task, history: Sequence[State], answer: Answer) -> Iterator[str]:
    goal, last = task.goal, history[-1]
    if goal.reading is not None:
        yield from _reading_told(goal.reading, goal.tolerance, last.reading.get(goal.reading), answer)
    if goal.gauges is None:
        return
    if answer is None or isinstance(answer, int | float | str):
        yield f"no gauges were told that {goal.gauges}; give their tags, none where there are none"
        return
    told = set(answer)
    missed = set(changed_gauges(task, history[0], last)) - told
    wrong = told - set(changed_gauges(task, history[0], last, share=0.2))
    verb = "falls" if goal.gauges == "fall" else "rises"
    yield from (f"{tag} {verb} and was not told" for tag in sorted(missed))
    yield from (f"{tag} was told, but does not {goal.gauges}" for tag in sorted(wrong))


def _reading_told(tag: str, tolerance: float, shown: float | None, answer: Answer) -> Iterator[str]:
    if shown is None:
        yield f"what {tag} shows, nobody knows"
    elif isinstance(answer, bool) or not isinstance(answer, int | float) or not math.isfinite(answer):
        yield f"no reading of {tag} was told; give a number"
    elif abs(answer - shown) > tolerance:
        yield f"{tag} shows {shown:.4g}, not {answer:.4g}"


def _share(value: float | None) -> str:
    return "nobody knows how far" if value is None else f"{value:.3g}"
