"""What a graph holds, and the settings: show, export, config."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import ConfigOption, CorrectedArgument, GraphArgument, SetOption, settings_of
from cadgraph.cli.panels import BUILD, EXPORT, LOOK
from cadgraph.cli.screen import (
    REMEDY,
    counts,
    named,
    note_line,
    out,
    say_json,
    state_lines,
    summary_lines,
    tell_warnings,
)
from cadgraph.config import to_toml

if TYPE_CHECKING:
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query.summary import Summary


@app.command(rich_help_panel=LOOK)
def show(
    graph: CorrectedArgument,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Say what a graph holds, and what to mind: files that don't belong to it, a source that changed since.

    With --json these are in "warnings". Of a run of many scenes each of them is told, with --json by its name.
    """
    names = _scenes_in(graph)
    if not names:
        summary, warnings = _told(graph)
        if as_json:
            say_json(_values(summary, warnings))
            return
        for line in summary_lines(summary):
            out.print(line)
        tell_warnings(warnings)
        return
    of_all = {name: _told(graph / name) for name in names}
    if as_json:
        say_json({name: _values(*told) for name, told in of_all.items()})
        return
    width = max(map(len, names))
    for name, (summary, warnings) in of_all.items():
        units = sum(map(len, summary.units.values()))
        out.print(f"{named(name, width)}  {counts(summary.n_parts, units, summary.n_connected)}")
        tell_warnings(warnings)


def _scenes_in(folder: Path) -> list[str]:
    """The scenes of a run of many; none where a folder holds a graph itself, or is a file."""
    from cadgraph._io.manifest import GRAPH_FILE, MANIFEST, graphs_in
    from cadgraph._io.staging import result_path

    if not folder.is_dir() or any(result_path(folder / name).is_file() for name in (GRAPH_FILE, MANIFEST)):
        return []
    return graphs_in(folder)


def _told(path: Path) -> tuple[Summary, list[str]]:
    """What a graph holds, and what to mind of its folder."""
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query.summary import summarize

    graph = SceneGraph.load(path)
    return summarize(graph), _state(graph, path)


def _values(summary: Summary, warnings: list[str]) -> dict[str, Any]:
    return {**dataclasses.asdict(summary), "warnings": [*summary.warnings, *warnings]}


def _state(graph: SceneGraph, path: Path) -> list[str]:
    """What in the folder of a graph doesn't belong to it, or isn't what was written, in words.

    Args:
        graph: as it was read.
        path: its file, or its folder.

    Raises:
        FormatError: the manifest is damaged.
    """
    from cadgraph._io.manifest import GRAPH_FILE, behind, changed_by_others, of_an_earlier_graph
    from cadgraph.model.source_file import changed_source

    folder = path if path.is_dir() else path.parent
    changed = graph.spoilt_shards()
    if not path.is_dir() and path.name != GRAPH_FILE:
        return state_lines((), changed=changed)
    told = state_lines(of_an_earlier_graph(folder), changed=(*changed_by_others(folder), *changed))
    if behind(folder):
        told.append(
            "corrections.json: not what this graph shows; 'cadgraph build' or 'cadgraph view' brings the graph up to it"
        )
    source = changed_source(graph.source, folder)
    return [*told, f"{source}; {REMEDY}"] if source else told


@app.command(rich_help_panel=EXPORT)
def export(
    graph: GraphArgument,
    to: Annotated[
        str,
        typer.Option(
            "--to",
            metavar="FORMAT",
            help="One of att, csv, dexpi, epanet, gltf, graphml, html, ifc, isometric, json, labels-csv, mjcf, "
            "networkx-json, pcf, shards or usd. 'shards' makes graph.json itself an index of them.",
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="PATH", help="File or folder; beside the graph by default.")
    ] = None,
    source: Annotated[
        Path | None,
        typer.Option(
            "--source",
            metavar="FILE",
            help="For att, gltf, html, ifc, mjcf and usd: the scene itself, where it has moved.",
        ),
    ] = None,
    bake: Annotated[
        bool,
        typer.Option(
            "--bake",
            help="With --to usd: one stage with all that the source refers to, the labels where each prim is defined.",
        ),
    ] = False,
    open_instances: Annotated[
        bool, typer.Option("--open-instances", help="With --bake: open all instances, for renderers that skip them.")
    ] = False,
    scenario: Annotated[
        Path | None,
        typer.Option(
            "--scenario", metavar="FILE", help="For epanet: what to suppose; scenario.yaml of the folder by default."
        ),
    ] = None,
) -> None:
    """Write a graph in another format, as a page to look at, or a copy of its source with the labels in it."""
    from cadgraph.export import write_export
    from cadgraph.hydraulics.settings import SCENARIO
    from cadgraph.model.graph import SceneGraph

    folder = graph if graph.is_dir() else graph.parent
    if scenario is None and to == "epanet" and (folder / SCENARIO).exists():
        scenario = folder / SCENARIO
    written = write_export(
        SceneGraph.load(graph),
        to,
        output or folder,
        source,
        bake=bake,
        open_instances=open_instances,
        scenario=scenario,
        folder=folder,
    )
    for path in written.files:
        out.print(f"wrote {escape(str(path))}")
    for note in written.notes:
        out.print(f"[dim]note[/]  {escape(note_line(note))}")


@app.command("config", rich_help_panel=BUILD)
def config_(
    config: ConfigOption = None,
    settings: SetOption = None,
) -> None:
    """Print the settings in force, with their meaning and source, as TOML."""
    print(to_toml(settings_of(config, settings or [], None)), end="")  # noqa: T201
