"""From a scene to a graph: build, demo."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cadgraph.cli.application import app
from cadgraph.cli.asking import AskingOptions, asks
from cadgraph.cli.options import (
    USE_METADATA,
    AssetRootOption,
    ConfigOption,
    MetadataOption,
    MethodOption,
    ScaleOption,
    SetOption,
    StrictOption,
    UnitOption,
    UpOption,
    read_flows,
    settings_of,
)
from cadgraph.cli.screen import bars, tell, tell_next

if TYPE_CHECKING:
    from cadgraph.model.graph import SceneGraph


@app.command()
@asks
def build(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A CAD scene: USD, STEP, IFC, RVM, glTF, OBJ, STL...")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where the results go.")],
    asking: AskingOptions,
    labels: Annotated[
        Path | None, typer.Option("--labels", metavar="FILE", help="Labels from outside: JSON, CSV or a truth file.")
    ] = None,
    vocabulary: Annotated[
        Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree, as YAML.")
    ] = None,
    catalog: Annotated[
        list[Path] | None,
        typer.Option("--catalog", metavar="FILE", help="A catalogue of your own parts. May be repeated."),
    ] = None,
    ground: Annotated[
        list[str] | None,
        typer.Option("--ground", metavar="PATH", help="A mesh that is the ground, or 'none'. May be repeated."),
    ] = None,
    flow: Annotated[
        list[str] | None,
        typer.Option(
            "--flow",
            metavar="FLOW",
            help="What flows where, as 'P-001 -> T-001', or a file of such lines. May be repeated.",
        ),
    ] = None,
    unit: UnitOption = None,
    scale: ScaleOption = None,
    up: UpOption = None,
    asset_roots: AssetRootOption = None,
    strict: StrictOption = False,
    use_metadata: MetadataOption = False,
    method: MethodOption = None,
    config: ConfigOption = None,
    settings: SetOption = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
    workers: Annotated[
        int, typer.Option("--workers", min=1, help="Processes that share the analysis of a big site, tile by tile.")
    ] = 1,
    tiles: Annotated[
        int | None, typer.Option("--tiles", min=1, help="Tiles that the site is cut into; by its size if not given.")
    ] = None,
) -> None:
    """Turn a CAD scene into a scene graph, a USD label layer and a report."""
    from cadgraph.session.run import run

    changes = [*(settings or [])]
    chosen = settings_of(config, changes, method, unit, up, scale=scale, strict=strict, asset_roots=asset_roots)
    if ground:
        find = "none" if ground == ["none"] else "named"
        chosen = chosen.replace({"ground.find": find, "ground.meshes": [] if find == "none" else ground})
    if flow:
        chosen = chosen.replace({"relate.flow": (*chosen.relate.flow, *read_flows(flow))})
    if catalog:
        chosen = chosen.replace({"label.catalogs": [str(file) for file in catalog]})
    if use_metadata:
        chosen = chosen.replace(USE_METADATA)
    before, chosen = chosen, asking.settings(chosen)
    with bars(() if report else ("draw report",)) as progress:
        labeler = asking.labeler(chosen, output, progress)
        outcome = run(
            scene,
            output,
            asking.stored(chosen, before),
            labels=labels,
            vocabulary=vocabulary,
            labeler=labeler,
            report=report,
            progress=progress,
            workers=workers,
            tiles=tiles,
        )
    tell(outcome)
    asking.tell(labeler, outcome.graph)


@app.command()
def demo(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where the results go.")] = Path(
        "demo"
    ),
    config: ConfigOption = None,
    settings: SetOption = None,
) -> None:
    """Build the scene graph of a small plant that comes with cadgraph: two tanks, two pumps, valves and gauges."""
    from cadgraph.session.demo import copy_demo_scene
    from cadgraph.session.run import run

    chosen = settings_of(config, settings or [], None)
    scene = copy_demo_scene(output)
    with bars() as progress:
        outcome = run(scene, output, chosen, progress=progress)
    tell(outcome)
    tell_next(_questions(outcome.graph, output))


def _questions(graph: SceneGraph, folder: Path) -> list[str]:
    """Commands to try on a graph, with tags that are in it."""
    from cadgraph.query import trace

    pumps = [pump for pump in graph.units("pump") if graph.connections(pump)]
    commands = [f"cadgraph view {folder}", f"cadgraph lines {folder}"]
    valves = {unit.tag for unit in graph.units("valve")}
    for pump in pumps[:1]:
        feeding = [step.name for step in trace(graph, pump.tag, "upstream").steps if step.name in valves]
        commands += [f"cadgraph trace {folder} {valve} --downstream" for valve in feeding[-1:]]
        commands.append(f"cadgraph isolate {folder} {pump.tag}")
        # What a robot would turn, and what its gauges would show.
        commands += [f"cadgraph simulate {folder} --set {valve}=0" for valve in feeding[-1:]]
    return [*commands, f"cadgraph simulate {folder}"]
