"""Rounds for planners: a domain and a problem in PDDL, and a round as a plan for them.

The domain is plain STRIPS with types and action costs (``:action-costs``, as in the planning competitions since 2008),
which most planners read. Lengths are whole millimetres, as planners want whole numbers for costs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.resources import files

from cadgraph.plans.changes import off_before
from cadgraph.plans.goals import Goal
from cadgraph.plans.round import Round, Survey
from cadgraph.plans.stops import Spot
from cadgraph.plans.text import doubt_lines, supposed_lines

__all__ = ["domain_text", "plan_text", "problem_text"]

# What a valve or a pump is, on and off.
_STATES = {"valve": ("is-open", "is-shut"), "pump": ("runs", "is-stopped")}
_RESERVED = {"and", "or", "not", "either", "object", "number", "define", "none", "assign", "increase", "forall", "when"}


def domain_text() -> str:
    """The domain, the same for all plants and rounds."""
    return files("cadgraph.plans").joinpath("domain.pddl").read_text(encoding="utf-8")


def problem_text(known: Survey, planned: Round) -> str:
    """What is asked of a planner: the same goals, over the same ways.

    A round that begins anywhere on the ground begins at a spot of its own, from which nothing is far, and may end at
    any spot on the ground.

    Args:
        known: what was looked up for the goals.
        planned: the round that was made for them.
    """
    names = _Names(known, planned.goals)
    lines = [
        *(f"; {_ascii(text)}" for text in (*doubt_lines(known, planned), *supposed_lines(planned))),
        "(define (problem round)",
        "  (:domain cadgraph-round)",
        "  (:objects",
        *(f"    {' '.join(listed)} - {kind}" for kind, listed in names.objects().items() if listed),
        "  )",
        "  (:init",
        *(f"    {fact}" for fact in _facts(known, planned.goals, names)),
        "    (= (total-cost) 0)",
        "  )",
        "  (:goal (ended))",
        "  (:metric minimize (total-cost)))",
    ]
    return "\n".join(lines) + "\n"


def plan_text(known: Survey, planned: Round) -> str:
    """A round as a plan that solves its problem, one action a line, as validators read it."""
    names = _Names(known, planned.goals)
    left = {stage: sum(goal.stage == stage for goal in planned.goals) for stage in names.stages}
    here, stage = known.start, names.stages[0]
    lines: list[str] = []
    for step in planned.steps:
        if step.do in ("walk", "climb"):
            spot = next(s for s in names.spots if (s.name, s.level) == (step.target, step.level))
            lines.append(f"({step.do} {names.spots[here]} {names.spots[spot]})")
            here = spot
        elif step.goal is None:
            lines.append(f"(set-up {names.units[step.target]} {names.spots[here]})")
        else:
            goal = step.goal
            while stage != goal.stage:
                following = names.stages[names.stages.index(stage) + 1]
                lines.append(f"(next-stage {_stage(stage)} {_stage(following)})")
                stage = following
            counts = f"{_count(left[stage])} {_count(left[stage] - 1)}"
            task = f"task-{planned.goals.index(goal) + 1}"
            lines.append(
                f"({goal.action} {task} {names.units[goal.unit]} {names.spots[here]} {_stage(stage)} {counts})"
            )
            left[stage] -= 1
    lines.append(f"(end {names.spots[here]} {_stage(stage)})")
    return "\n".join(lines) + f"\n; cost = {sum(_mm(step.length) for step in planned.steps)}\n"


@dataclass(frozen=True)
class _Names:
    """What units and spots are called in PDDL: letters, digits and dashes, each name once.

    Args:
        known: stops and ways.
        goals: all goals.
    """

    known: Survey
    goals: Sequence[Goal]

    @cached_property
    def units(self) -> dict[str, str]:
        """By id."""
        found: dict[str, str] = {}
        taken = set(_RESERVED)
        for goal in self.goals:
            if goal.unit not in found:
                found[goal.unit] = _free(re.sub(r"[^a-z0-9]+", "-", goal.name.casefold()).strip("-"), taken)
        return found

    @cached_property
    def spots(self) -> dict[Spot, str]:
        """By spot: the start, where one works, the ends of ways."""
        found: dict[Spot, str] = {self.known.start: "the-start"}
        taken = {"the-start"}
        for goal in self.goals:
            found.setdefault(self.known.stops[goal.unit].spot, _free(f"at-{self.units[goal.unit]}", taken))
        for way in self.known.terrain.ways.values():
            for number, end in enumerate(way.ends):
                found[end] = _free(f"{'foot' if number == 0 else f'head-{number}'}-of-{_plain(way.place.id)}", taken)
        return found

    @cached_property
    def stages(self) -> list[int]:
        """All stages, in order."""
        return sorted({goal.stage for goal in self.goals})

    def objects(self) -> dict[str, list[str]]:
        """All objects by their type."""
        most = max(sum(goal.stage == stage for goal in self.goals) for stage in self.stages)
        graph = self.known.network.graph
        found: dict[str, list[str]] = {"gauge": [], "valve": [], "pump": []}
        for unit, name in self.units.items():
            found[graph.unit(unit).unit_type].append(name)
        return {
            "spot": list(self.spots.values()),
            **found,
            "task": [f"task-{number}" for number in range(1, len(self.goals) + 1)],
            "stage": [_stage(stage) for stage in self.stages],
            "count": [_count(number) for number in range(1, most + 1)],
        }


def _facts(known: Survey, goals: Sequence[Goal], names: _Names) -> Iterator[str]:
    yield f"(at {names.spots[known.start]})"
    yield from _ways(known, names)
    off = off_before(goals)
    for unit, name in names.units.items():
        stop = known.stops[unit]
        yield f"(works-at {name} {names.spots[stop.spot]})"
        yield f"(within-reach {name})" if stop.aid is None else f"(out-of-reach {name})"
        turned = next((goal for goal in goals if goal.unit == unit and goal.turns), None)
        if turned is not None:
            yield f"({_STATES[turned.verb.unit_type][unit in off]} {name})"
    for number, goal in enumerate(goals, start=1):
        yield f"(to-{goal.action} task-{number} {names.units[goal.unit]})"
        yield f"(belongs task-{number} {_stage(goal.stage)})"
    yield f"(now {_stage(names.stages[0])})"
    for before, after in zip(names.stages, names.stages[1:], strict=False):
        yield f"(follows {_stage(before)} {_stage(after)})"
    yield f"(last {_stage(names.stages[-1])})"
    amounts = [sum(goal.stage == stage for goal in goals) for stage in names.stages]
    for stage, amount in zip(names.stages, amounts, strict=True):
        yield f"(left {_stage(stage)} {_count(amount)})"
    for number in range(max(amounts)):
        yield f"(one-less {_count(number)} {_count(number + 1)})"


def _ways(known: Survey, names: _Names) -> Iterator[str]:
    start, listed = known.start, list(names.spots)
    for a in listed:
        for b in listed:
            climbed = a.name == b.name and a.name in known.terrain.ways
            if a == b or b.point is None or not (climbed or a.level == b.level):
                continue  # nobody walks back to a start that is anywhere: all would be near it
            leg = known.walks.climb(a, b) if climbed else known.walks.on_level(a, b)
            yield f"({'climbable' if climbed else 'walkable'} {names.spots[a]} {names.spots[b]})"
            yield f"(= (distance {names.spots[a]} {names.spots[b]}) {_mm(leg.length)})"
    for spot in listed:
        if spot == start if start.point is not None else spot.level == start.level and spot != start:
            yield f"(may-end-at {names.spots[spot]})"


def _free(wanted: str, taken: set[str]) -> str:
    """A name that begins with a letter and that nothing else has."""
    name = wanted if wanted[:1].isalpha() and wanted.isascii() else f"x-{wanted}".rstrip("-")
    number, found = 1, name
    while found in taken:
        number += 1
        found = f"{name}-{number}"
    taken.add(found)
    return found


def _plain(text: str) -> str:
    return re.sub(r"[^a-z0-9]+", "-", text.casefold()).strip("-")


def _ascii(text: str) -> str:
    return " ".join(text.encode("ascii", "replace").decode().split())


def _stage(number: int) -> str:
    return f"stage-{number + 1}"


def _count(number: int) -> str:
    return f"count-{number}" if number else "none"


def _mm(length: float) -> int:
    return round(1000 * length)
