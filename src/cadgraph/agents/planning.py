"""Rounds: an order for what is to be read, closed and opened, by which ways, and what each step changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Annotated

from cadgraph.agents.answer import Answer, AskError, page_of
from cadgraph.agents.plant import Plant
from cadgraph.model.records import Unit
from cadgraph.plans.goals import Goal, parse_goals
from cadgraph.plans.pddl import domain_text, plan_text, problem_text
from cadgraph.plans.round import Round, Survey, make_round, survey
from cadgraph.plans.rules import Fault, check_moves, check_round
from cadgraph.plans.text import doubt_lines, fault_lines, head_lines, round_values, step_lines, supposed_lines
from cadgraph.plans.written import WrittenRound
from cadgraph.query.places import walk

__all__ = ["Planned", "check", "make_plan", "pddl_files", "plan"]


@dataclass(frozen=True)
class Planned:
    """A round with what it was made from.

    Args:
        known: stops, ways, and lengths between them.
        made: the round.
        faults: rules that it breaks; none, unless something is wrong with cadgraph.
    """

    known: Survey
    made: Round
    faults: tuple[Fault, ...]

    def lines(self) -> tuple[list[str], list[str]]:
        """Its head and its rows: what isn't known, the steps, what it supposes."""
        rows = [*doubt_lines(self.known, self.made), *step_lines(self.known, self.made), *supposed_lines(self.made)]
        return head_lines(self.known, self.made, self.faults), rows


def plan(
    plant: Plant,
    goals: Annotated[str, "'read G-003; stop P-001; close V-002'; ';' orders"],
    start: Annotated[str, "unit to begin and end at"] = "",
    page: int = 1,
) -> Answer:
    """An ordered round that reaches all goals: where to walk, climb and stand, what each step needs and changes.

    Args:
        plant: to go round.
        goals: what to read, close, open, stop and start; what stands before a semicolon is done before the rest.
        start: tag or id of the unit where it begins and ends; anywhere on the ground if empty.
        page: counted from 1.

    Returns:
        What isn't known first, then the steps; lengths in metres.

    Raises:
        AskError: nothing is called so, or it can't be done there.
    """
    made = make_plan(plant, goals, start)
    head, rows = made.lines()
    return Answer(page_of(head, rows, [], page), round_values(made.known, made.made, made.faults))


def make_plan(plant: Plant, goals: str, start: str = "") -> Planned:
    """The round that :func:`plan` tells of.

    Raises:
        AskError: nothing is called so, or it can't be done there.
    """
    asked = parse_goals(goals, plant.find)
    known = _survey(plant, asked, start)
    made = make_round(known, asked, known.start.name or None)
    return Planned(known, made, check_round(known, made))


def check(plant: Plant, written: WrittenRound, goals: str = "", start: str = "", page: int = 1) -> Answer:
    """Plays a round through that somebody else made, and says which rules it breaks.

    Args:
        plant: that it goes through.
        written: the round.
        goals: what it is for; what the round says itself if empty.
        start: where it begins and ends, likewise.
        page: counted from 1.

    Raises:
        AskError: neither says what it is for, nothing is called so, or it can't be done there.
    """
    asked = parse_goals(goals or written.goals, plant.find)
    known = _survey(plant, asked, start or written.start or "")
    faults = check_moves(known, asked, written.moves(plant.find), written.length_m)
    best = make_round(known, asked, known.start.name or None)
    values = {"keeps_rules": not faults, "faults": fault_lines(faults), "shortest_known_m": best.length}
    found = f"breaks {len(faults)} rules" if len(faults) != 1 else "breaks a rule"
    head = [f"the round of {len(written.steps)} steps {found if faults else 'keeps all rules'}"]
    foot = [f"the best round that is known takes {best.length:.1f} m"]
    return Answer(page_of(head, fault_lines(faults), foot, page), values)


def pddl_files(made: Planned) -> dict[str, str]:
    """The files for planners by name: domain, problem, and the round as a plan that solves it."""
    return {
        "domain.pddl": domain_text(),
        "problem.pddl": problem_text(made.known, made.made),
        "plan.pddl": plan_text(made.known, made.made),
    }


def _survey(plant: Plant, goals: Sequence[Goal], start: str) -> Survey:
    # Without places nothing is known of the floor, so that walks are straight lines, and are said to be.
    steps = partial(walk, plant.graph) if plant.has_places else None
    return survey(plant.network, goals, _start(plant, start), steps)


def _start(plant: Plant, start: str) -> str | None:
    if not start:
        return None
    node = plant.find(start)
    if not isinstance(node, Unit):
        raise AskError(f"{node.id} is a {node.layer}; a round begins at a unit, or anywhere on the ground")
    return node.id
