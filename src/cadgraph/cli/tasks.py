"""Tasks for robots and agents: tasks."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import SIMULATE
from cadgraph.cli.screen import err, out

_SHOWN = 20  # of what can't be done


@app.command(rich_help_panel=SIMULATE)
def tasks(
    graph: GraphArgument,
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The tasks, e.g. tasks.json.")],
    n: Annotated[int, typer.Option("-n", metavar="N", min=1, max=100_000, help="How many at most.")] = 50,
    seed: Annotated[int, typer.Option("--seed", metavar="SEED", help="Of what is drawn.")] = 0,
    scenario: Annotated[
        Path | None,
        typer.Option("--scenario", metavar="FILE", help="What to suppose; scenario.yaml of the folder by default."),
    ] = None,
    source: Annotated[
        Path | None, typer.Option("--source", metavar="FILE", help="The scene itself, where it has moved.")
    ] = None,
) -> None:
    """Make tasks: read a gauge, close or open a valve and see which gauges change, isolate a pump.

    Each says where to stand, where an eye sees the gauge, which ring a hand grips and along which way it gets there
    without meeting anything, the start, the goal, and a solution that was played through. What can't be done is listed
    with its reasons. The same seed gives the same file.
    """
    from cadgraph.config import restore_config
    from cadgraph.hydraulics.process import Process
    from cadgraph.hydraulics.settings import SCENARIO
    from cadgraph.load import load
    from cadgraph.model.graph import SceneGraph
    from cadgraph.model.source_file import find_source
    from cadgraph.simulate.tasks.choosing import make_tasks

    plant = SceneGraph.load(graph)
    folder = graph if graph.is_dir() else graph.parent
    beside = folder / SCENARIO
    file = scenario or (beside if beside.exists() else None)
    process = Process(plant, file)
    scene = load(find_source(plant.source, folder, source), restore_config(plant.config).load)
    made = make_tasks(plant, scene, process.scenario, seed=seed, n=n)
    made.write(output)
    counts = Counter(task.kind for task in made.tasks)
    told = ", ".join(f"{number} {kind}" for kind, number in sorted(counts.items())) or "none"
    out.print(f"{len(made.tasks)} tasks: {told}")
    if made.left_out:
        out.print(f"{len(made.left_out)} left out, as they can't be done:")
        for one in made.left_out[:_SHOWN]:
            out.print(f"  {escape(one.text)}: {escape('; '.join(one.reasons))}")
        if len(made.left_out) > _SHOWN:
            out.print(f"  and {len(made.left_out) - _SHOWN} more, which the file names too")
    if len(made.tasks) < n:
        out.print(f"[dim]{n} were asked for; this plant has no more that differ[/]")
    supposed = f"as {file} says" if file is not None else "by the defaults; 'cadgraph simulate' writes them to edit"
    err.print(f"wrote {escape(str(output))}; supposed {escape(supposed)} ({made.assumptions} values assumed)")
