"""What flows and what gauges show: simulate."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import SIMULATE
from cadgraph.cli.screen import err, out, say_json

_PLAYED = 30.0  # s of a timetable, if nothing else is said


@app.command(rich_help_panel=SIMULATE)
def simulate(
    graph: GraphArgument,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="TAG=SHARE",
            help="What happens when a valve is 0 (shut) to 1 (open), a pump 0 (stopped) to 1. May be repeated.",
        ),
    ] = None,
    scenario: Annotated[
        Path | None,
        typer.Option("--scenario", metavar="FILE", help="What to suppose; scenario.yaml of the folder by default."),
    ] = None,
    play: Annotated[
        Path | None,
        typer.Option(
            "--play",
            metavar="FILE",
            help="A timetable: a YAML file with a list play of moves, each with at [s], over [s] and set "
            "({V-003: 0}). Writes animation.usda, animation.png and animation.gif into the folder.",
        ),
    ] = None,
    seconds: Annotated[
        float | None, typer.Option("--seconds", show_default=f"{_PLAYED:g}", help="With --play: how long, at most 600.")
    ] = None,
    needles: Annotated[
        bool, typer.Option("--needles", help="Draw a needle in simulation.usda on every dial that has none.")
    ] = False,
    source: Annotated[
        Path | None, typer.Option("--source", metavar="FILE", help="The scene itself, where it has moved.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
) -> None:
    """Work out what flows, what every gauge shows, and what happens when valves are turned and pumps stopped.

    What the graph doesn't know is supposed: the fluid, the pumps, how far valves are open, what the ends of pipes do.
    The first run writes all of that into scenario.yaml of the folder, each value with its reason; edit it and run
    again. An edited file is never written over. What is assumed is counted below the table.

    With --play a timetable is played: what moves, and what gauges show, as time samples over simulation.usda that every
    USD viewer shows, as a strip of pictures and as a GIF. A FILE that says more than what is done is the scenario, too.

    Without --set, the plant is also written as a stage with physics that simulators open: simulation.usda, where
    wheels, levers and needles turn about joints called as the tags of their units, with devices.json, their table.
    """
    from cadgraph.cli.playing import play_timetable, say_played, show_film, supposed_by
    from cadgraph.cli.staging import say_stage, write_stage_beside
    from cadgraph.hydraulics.process import Process
    from cadgraph.hydraulics.text import change_lines, standing, standing_lines, state_values

    commands = _commands(changes or [])
    length = _played(play, commands, seconds)
    scenario = scenario if play is None else supposed_by(play, scenario)
    folder = graph if graph.is_dir() else graph.parent
    with _writing(folder, scenario, commands):
        process, file, written = _open(graph, scenario, Process)
        before, values = standing(process), state_values(process)
        if commands:
            process.steady(commands)
        film = None if play is None else play_timetable(process, play, length)
        stage = None if commands else write_stage_beside(graph, source, needles)
    shown = None if film is None else show_film(film, process, source, folder)
    changed = bool(commands) or film is not None
    if as_json:
        told = _values(process, file, values, commands, changed) | (stage or {}) | (shown or {})
        say_json(told)
        return
    for line in change_lines(process, before) if changed else standing_lines(process):
        out.print(escape(line))
    if stage is not None:
        say_stage(stage)
    if shown is not None:
        out.print()
        say_played(shown)
    _tell_assumed(process, file, written)


def _played(play: Path | None, commands: dict[str, float], seconds: float | None) -> float:
    """How long a timetable is played [s], once it is clear that one is, if any."""
    if play is not None and commands:
        raise ValueError("--play and --set: give one of them; what --set says can stand in the timetable, at: 0")
    if seconds is not None and play is None:
        raise ValueError("--seconds goes with --play")
    return _PLAYED if seconds is None else seconds


def _writing(folder: Path, scenario: Path | None, commands: dict[str, float]) -> AbstractContextManager[Any]:
    """All that is written comes into the folder together; whoever only asks what a change does keeps nobody out."""
    from cadgraph._io.run_folder import coming_into
    from cadgraph.hydraulics.settings import SCENARIO

    asks = commands and (scenario is not None or (folder / SCENARIO).exists())
    return nullcontext() if asks else coming_into(folder)


def _commands(changes: Sequence[str]) -> dict[str, float]:
    found: dict[str, float] = {}
    for change in changes:
        name, equals, text = change.rpartition("=")
        try:
            found[name.strip()] = float(text)
        except ValueError:
            equals = ""
        if not equals or not name.strip():
            raise ValueError(f"--set {change}: expected TAG=SHARE, e.g. V-003=0")
    return found


def _open(graph: Path, scenario: Path | None, process: Any) -> tuple[Any, Path, bool]:
    """A process, the file that says what it supposes, and whether that was written just now."""
    from cadgraph.hydraulics.scenario_file import write_scenario
    from cadgraph.hydraulics.settings import SCENARIO

    folder = graph if graph.is_dir() else graph.parent
    file = scenario or folder / SCENARIO
    if scenario is not None or file.exists():
        from cadgraph.model.graph import SceneGraph

        return process(SceneGraph.load(graph), file), file, False
    made = process(graph)
    write_scenario(made.scenario, file)
    return made, file, True


def _tell_assumed(process: Any, file: Path, written: bool) -> None:
    from cadgraph.hydraulics.text import assumption_lines

    out.print()
    for line in assumption_lines(process):
        out.print(f"[dim]{escape(line)}[/]")
    told = f"wrote {file}: each value with its reason; edit it and run again" if written else f"supposed as {file} says"
    err.print(escape(told))


def _values(
    process: Any, file: Path, before: dict[str, Any], commands: dict[str, float], changed: bool
) -> dict[str, Any]:
    from cadgraph.hydraulics.text import assumed_values, state_values

    values: dict[str, Any] = {"scenario": str(file)}
    if changed:
        values |= {"set": commands, "before": before, "after": state_values(process)}
    else:
        values["state"] = before
    return values | {"assumed": assumed_values(process.scenario)}
