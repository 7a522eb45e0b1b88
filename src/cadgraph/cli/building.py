"""From a scene to a graph: build, demo."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from cadgraph._io.garbage import collector_paused
from cadgraph._io.text import printable
from cadgraph.cli.application import app
from cadgraph.cli.asking import AskingOptions, asks
from cadgraph.cli.build_command import BuildCommand
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
from cadgraph.cli.panels import BUILD
from cadgraph.cli.screen import bars, err, named, out, tell, tell_built, tell_next
from cadgraph.config import Config
from cadgraph.errors import CadGraphError

if TYPE_CHECKING:
    from cadgraph.model.graph import SceneGraph


@app.command(cls=BuildCommand, rich_help_panel=BUILD)
@asks()
def build(
    scenes: Annotated[
        list[Path],
        typer.Argument(
            metavar="SCENE",
            help="A CAD scene: USD, STEP, IFC, RVM, glTF, OBJ, STL... Of several, each goes into FOLDER/NAME.",
        ),
    ],
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
            metavar="A -> B",
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
        int | None,
        typer.Option(
            "--workers",
            min=1,
            show_default="1; with --ray all processors",
            help="Processes that share the analysis of a big site, tile by tile, or many scenes.",
        ),
    ] = None,
    tiles: Annotated[
        int | None, typer.Option("--tiles", min=1, show_default="by its size", help="Tiles that the site is cut into.")
    ] = None,
    ray: Annotated[
        str | None,
        typer.Option(
            "--ray",
            metavar="ADDRESS",
            help="Do this on a Ray cluster: HOST:PORT, auto, or one started here (local, or no address).",
        ),
    ] = None,
) -> None:
    """Turn CAD scenes into scene graphs, USD label layers and reports."""
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
    if len(scenes) > 1:
        if tiles is not None:
            raise ValueError("--tiles cuts one scene; of several each is built as a whole")
        if chosen.lvlm.ask != "never":
            raise ValueError("a model is asked about one scene at a time; build them one by one, or --labeler embedded")
        _build_many(
            scenes, output, chosen, labels=labels, vocabulary=vocabulary, report=report, workers=workers, ray=ray
        )
        return
    from cadgraph.session.run import run

    # To look through a large graph for what nobody holds takes seconds, and the process is about to end: the graph goes
    # before the collector is on again.
    with collector_paused():
        with bars(() if report else ("draw report",)) as progress:
            labeler = asking.labeler(chosen, output, progress)
            outcome = run(
                scenes[0],
                output,
                asking.stored(chosen, before),
                labels=labels,
                vocabulary=vocabulary,
                labeler=labeler,
                report=report,
                progress=progress,
                workers=workers,
                tiles=tiles,
                ray=ray,
            )
        tell(outcome)
        asking.tell(labeler, outcome.graph)
        del outcome


def _build_many(scenes: list[Path], output: Path, config: Config, **more: Any) -> None:
    """Builds each scene into a folder of its own, and says of each what became of it.

    Raises:
        CadGraphError: one failed; all others are built.
    """
    from cadgraph.session.many import build_many

    width = max(len(scene.stem) for scene in scenes)
    built = build_many(scenes, output, config, **more, told=lambda one: tell_built(one, width))
    failed = [one for one in built if one.state == "failed"]
    if failed:
        for one in failed:
            err.print(f"{named(one.name, width)}  {escape(printable(one.reason))}")
        raise CadGraphError(
            f"{len(failed)} of {len(built)} scenes failed; the same command goes on with them, and keeps the others"
        )
    out.print(f"[dim]{len(built)} scenes[/]  [bold]{escape(str(output))}[/]")


@app.command(rich_help_panel=BUILD)
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
