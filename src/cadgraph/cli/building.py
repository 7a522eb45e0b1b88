"""From a scene to a graph: build, demo."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cadgraph._io.atomic import ensure_writable
from cadgraph.cli.application import app
from cadgraph.cli.asking import AskingOptions, asks
from cadgraph.cli.options import ConfigOption, MethodOption, SetOption, read_flows, settings_of
from cadgraph.cli.screen import bars, tell
from cadgraph.errors import OutputError


@app.command()
@asks
def build(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A CAD scene: USD (usd, usda, usdc, usdz) or STEP.")],
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
    method: MethodOption = None,
    config: ConfigOption = None,
    settings: SetOption = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
) -> None:
    """Turn a CAD scene into a scene graph, a USD label layer and a report."""
    from cadgraph.session.run import run

    changes = [*(settings or [])]
    chosen = settings_of(config, changes, method)
    if ground:
        find = "none" if ground == ["none"] else "named"
        chosen = chosen.replace({"ground.find": find, "ground.meshes": [] if find == "none" else ground})
    if flow:
        chosen = chosen.replace({"relate.flow": (*chosen.relate.flow, *read_flows(flow))})
    if catalog:
        chosen = chosen.replace({"label.catalogs": [str(file) for file in catalog]})
    chosen = asking.settings(chosen)
    with bars() as progress:
        labeler = asking.labeler(chosen, output, progress)
        outcome = run(
            scene,
            output,
            chosen,
            labels=labels,
            vocabulary=vocabulary,
            labeler=labeler,
            report=report,
            progress=progress,
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
    """Generate a small plant skid with meaningless names, and turn it into a scene graph."""
    from importlib import import_module

    from cadgraph.session.run import run

    chosen = settings_of(config, settings or [], None)
    scene = ensure_writable(output) / "skid.usdc"
    if scene.exists() and not scene.with_name("skid.truth.json").exists():
        raise OutputError(f"{scene}: not written by cadgraph, so it is left alone; choose another output folder")
    plants = import_module("cadplants")
    plants.write_usd(plants.make_skid(), scene)
    with bars() as progress:
        outcome = run(scene, output, chosen, progress=progress)
    tell(outcome)
