"""Rounds: plan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import SIMULATE
from cadgraph.cli.screen import err, say, say_json

if TYPE_CHECKING:
    from cadgraph.agents.plant import Plant


@app.command(rich_help_panel=SIMULATE)
def plan(
    graph: GraphArgument,
    goals: Annotated[
        str, typer.Argument(metavar="[GOALS]", help="E.g. 'read G-003, G-007; close V-002'.", show_default=False)
    ] = "",
    start: Annotated[
        str, typer.Option("--start", metavar="TAG", help="Begin and end there; by default anywhere on the ground.")
    ] = "",
    check: Annotated[
        Path | None,
        typer.Option("--check", metavar="FILE", help="Instead of making a round, check one: JSON as --json prints."),
    ] = None,
    pddl: Annotated[
        Path | None,
        typer.Option("--pddl", metavar="FOLDER", help="Write domain, problem and the round for planners there."),
    ] = None,
    page: Annotated[
        int | None, typer.Option("--page", metavar="N", help="Only this page, as agents read it; all by default.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
) -> None:
    """Plan a round: what to read, turn and stop, in the order that is shortest, and what each step needs and changes.

    Gauges are read, valves closed and opened, pumps stopped and started. What stands before a semicolon is done before
    what stands behind it; what commas divide is done in any order. The round says where to walk, climb and stand, what
    takes a ladder or lift, what closing cuts off, and what isn't known.

    With --check: plays a round through that anybody made, a file with "goals" and "steps" (each "do" and "at"), and
    lists the rules that it breaks; ends with 1 if there are any.
    """
    from cadgraph.agents.plant import Plant

    if check is not None and pddl is not None:
        raise ValueError("--check and --pddl: give one of them")
    plant = Plant.open(graph)
    if check is not None:
        _check(plant, check, goals, start, page or 1, as_json)
        return
    from cadgraph._io.atomic import write_atomically
    from cadgraph.agents.answer import page_of
    from cadgraph.agents.planning import make_plan, pddl_files
    from cadgraph.plans.text import round_values

    planned = make_plan(plant, goals, start)
    if pddl is not None:
        pddl.mkdir(parents=True, exist_ok=True)
        for name, text in pddl_files(planned).items():
            write_atomically(pddl / name, text)
        err.print(f"wrote {escape(str(pddl))}: {', '.join(pddl_files(planned))}")
    if as_json:
        values = round_values(planned.known, planned.made, planned.faults)
        say_json(values)
        return
    head, rows = planned.lines()
    say("\n".join([*head, *rows]) if page is None else page_of(head, rows, [], page))


def _check(plant: Plant, file: Path, goals: str, start: str, page: int, as_json: bool) -> None:
    from cadgraph._io.limits import PLAN, read_text_within
    from cadgraph.agents.planning import check
    from cadgraph.plans.written import read_written

    text = read_text_within(file, PLAN, ValueError, "give a round as 'cadgraph plan --json' prints it")
    answer = check(plant, read_written(text, str(file)), goals, start, page)
    if as_json:
        say_json(answer.values)
    else:
        say(answer.text)
    if not answer.values["keeps_rules"]:
        raise typer.Exit(1)
