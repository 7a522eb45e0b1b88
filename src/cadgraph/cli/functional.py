"""Questions to the functional graph: lines, trace, isolate, diagram, compare."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import EXPORT, LOOK, NETWORK
from cadgraph.cli.screen import err, out, say, say_json

JsonOption = Annotated[bool, typer.Option("--json", help="Print as JSON.")]


@app.command(rich_help_panel=NETWORK)
def lines(
    graph: GraphArgument,
    file: Annotated[Path | None, typer.Argument(metavar="[FILE]", help="With --csv or --json: write there.")] = None,
    of: Annotated[
        str | None, typer.Option("--of", metavar="TAG", help="Only the lines at this unit, e.g. P-001.")
    ] = None,
    as_csv: Annotated[bool, typer.Option("--csv", help="As CSV, for a spreadsheet.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Print the line list: from, to, length, nominal size, direction, and the valves and gauges in order.

    A line runs on through valves, gauges and the taps of gauges; it ends at junctions, open or blind ends, tanks,
    pumps and other equipment. Its number is made from what it joins, so that a line added elsewhere renumbers nothing.

    Units at which no line was found are named below the list, and so are those with fewer lines than their kind needs.
    Ends with 1 where no line was found at any unit.
    """
    from cadgraph.export.tables import table_bytes
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query import Network, find_lines
    from cadgraph.query.text import gap_lines, line_rows, line_table, line_values

    _check_form(file, as_csv, as_json)
    network = Network(SceneGraph.load(graph))
    found = find_lines(network, of)
    if as_csv:
        _deliver(table_bytes(line_rows(found)), file, len(found))
    elif as_json:
        _deliver(_json_bytes([line_values(line) for line in found]), file, len(found))
    else:
        _print(out, line_table(found))
    if of is None:
        # Beside the list, so that what reads it as CSV or JSON meets nothing else.
        _print(err if as_csv or as_json else out, (f"note: {text}" for text in gap_lines(network)))
    if not found and network.graph.units():
        raise typer.Exit(1)


def _check_form(file: Path | None, as_csv: bool, as_json: bool) -> None:
    if as_csv and as_json:
        raise ValueError("--csv and --json: give one of them")
    if file is not None and not (as_csv or as_json):
        raise ValueError(f"{file}: say --csv or --json to write a file")


def _json_bytes(values: Any) -> bytes:
    return (json.dumps(values, ensure_ascii=False, indent=1) + "\n").encode()


def _print(screen: Console, texts: Iterable[str]) -> None:
    for text in texts:
        screen.print(escape(text))


def _deliver(content: bytes, file: Path | None, n_lines: int) -> None:
    """Writes a line list to a file, or prints it."""
    from cadgraph._io.atomic import write_atomically

    if file is None:
        say(content.decode("utf-8-sig").replace("\r\n", "\n"), end="")
        return
    write_atomically(file, content)
    out.print(f"wrote {escape(str(file))}: {n_lines:,} lines")


@app.command(rich_help_panel=NETWORK)
def trace(
    graph: GraphArgument,
    tag: Annotated[str, typer.Argument(metavar="TAG", help="Where to begin, e.g. V-003.")],
    downstream: Annotated[bool, typer.Option("--downstream", help="Follow the flow (the default).")] = False,
    upstream: Annotated[bool, typer.Option("--upstream", help="Go against the flow.")] = False,
    to: Annotated[str | None, typer.Option("--to", metavar="TAG", help="The shortest way to this one.")] = None,
    unknown: Annotated[
        bool, typer.Option("--unknown", help="Also follow connections whose direction of flow is unknown, both ways.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Say what lies downstream or upstream of a unit, or on the way to another, in order with distances.

    A way to another unit goes along the pipes whichever way they flow; with --downstream or --upstream only with or
    against the flow. A unit at which no line was found gets no answer (exit status 2), and what may have been missed on
    the way is told.
    """
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query import Network, find_way
    from cadgraph.query import trace as follow
    from cadgraph.query.text import trace_lines, trace_values, way_lines

    if downstream and upstream:
        raise ValueError("--downstream and --upstream: give one of them")
    network = Network(SceneGraph.load(graph))
    if to is not None:
        if unknown:
            raise ValueError("--unknown goes with --downstream or --upstream, not with --to")
        found = find_way(network, tag, to, "downstream" if downstream else "upstream" if upstream else None)
        text = way_lines(found, tag, to)
    else:
        found = follow(network, tag, "upstream" if upstream else "downstream", through_unknown=unknown)
        text = trace_lines(found)
    _show(text, trace_values(found), as_json)


@app.command(rich_help_panel=NETWORK)
def isolate(
    graph: GraphArgument,
    tag: Annotated[str, typer.Argument(metavar="TAG", help="What to isolate, e.g. P-001.")],
    check_valves: Annotated[
        bool, typer.Option("--check-valves", help="Count check valves that hold back what could flow to it.")
    ] = False,
    fewest: Annotated[
        bool, typer.Option("--fewest", help="The fewest valves, even if more is shut off; by default the nearest.")
    ] = False,
    assume_shutoff: Annotated[
        bool, typer.Option("--assume-shutoff", help="Count valves of unknown kind; each then is a doubt.")
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="End with 1 where the unit can't be isolated for sure.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """List the valves that isolate a unit on every port, what can't be isolated, and what is shut off with it.

    Only valves count whose kind is known to shut off; check, control and relief valves don't, and those of unknown kind
    are named apart. What may feed the unit without having been found is told: ports without a line, and joints that
    were not made. A unit at which no line was found gets no answer (exit status 2).
    """
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query import find_isolation
    from cadgraph.query.text import isolation_lines, isolation_values

    found = find_isolation(
        SceneGraph.load(graph), tag, check_valves=check_valves, fewest=fewest, assume_shutoff=assume_shutoff
    )
    _show(isolation_lines(found), isolation_values(found), as_json)
    if strict and not found.isolated:
        raise typer.Exit(1)


@app.command(rich_help_panel=LOOK)
def diagram(
    graph: GraphArgument,
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The drawing, e.g. plant.svg.")],
    system: Annotated[
        str | None, typer.Option("--system", metavar="ID", help="Only this system, e.g. system-001; all by default.")
    ] = None,
) -> None:
    """Draw the functional graph as a schematic (SVG), in the manner of a piping and instrumentation diagram."""
    from cadgraph._io.atomic import write_atomically
    from cadgraph.draw.schematic import draw_diagram
    from cadgraph.model.graph import SceneGraph

    if output.suffix.lower() != ".svg":
        raise ValueError(f"{output}: a diagram is written as SVG; give a file that ends in .svg")
    write_atomically(output, draw_diagram(SceneGraph.load(graph), system))
    out.print(f"wrote {escape(str(output))}")


@app.command(rich_help_panel=EXPORT)
def compare(
    graph: GraphArgument,
    plan: Annotated[
        Path | None, typer.Argument(metavar="[PLAN]", help="The P&ID as Proteus XML (DEXPI).", show_default=False)
    ] = None,
    source: Annotated[
        bool, typer.Option("--source", help="Instead of a plan: what the source itself says is joined to what.")
    ] = False,
    mapping: Annotated[
        Path | None,
        typer.Option("--map", metavar="FILE", help="CSV with a tag of the plan and the plant's tag in each line."),
    ] = None,
    by_network: Annotated[
        bool, typer.Option("--by-network", help="Don't go by tags: the plan counts in a way of its own.")
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="End with 1 where anything differs or can't be told apart.")
    ] = False,
    as_json: JsonOption = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write the answer there.")
    ] = None,
) -> None:
    """Compare a plant with its P&ID (units, connections, order along the lines, directions, kinds), or with its source.

    Units are matched as --map says, then by tag, then by their place in the network with a figure that says how sure
    that is; what can't be matched is listed.

    With --source: which connections and directions the graph and the ports or branches of its IFC or RVM file have in
    common, and which only one of both has. What can't be compared is listed.
    """
    if source:
        _compare_source(graph, (plan, mapping, by_network or None), strict, as_json, output)
        return
    if plan is None:
        raise ValueError(
            "give the plan to compare with, a Proteus XML file, or --source for what the source itself says"
        )
    from cadgraph._io.limits import MAPPING, read_text_within
    from cadgraph.export.dexpi import read_dexpi
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query.compare import compare as compare_graphs
    from cadgraph.query.compare import read_mapping
    from cadgraph.query.text import comparison_lines, comparison_values

    given = {}
    if mapping is not None:
        remedy = "give a CSV file with the plan's tag and the plant's tag in each line"
        given = read_mapping(read_text_within(mapping, MAPPING, ValueError, remedy), str(mapping))
    found = compare_graphs(SceneGraph.load(graph), read_dexpi(plan), given, by_tag=not by_network)
    lines = comparison_lines(found) if output is None else comparison_lines(found, most=10**9)
    _tell_comparison(lines, comparison_values(found), found.verdict, as_json, output)
    if strict and not (found.agrees and found.complete):
        raise typer.Exit(1)


def _compare_source(graph: Path, others: tuple[object, ...], strict: bool, as_json: bool, output: Path | None) -> None:
    """The comparison of a graph with what its source says."""
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query.compare_source import compare_source
    from cadgraph.query.source_text import source_lines, source_values

    if any(other is not None for other in others):
        raise ValueError("--source compares with the source alone; leave out the plan, --map and --by-network")
    found = compare_source(SceneGraph.load(graph))
    lines = source_lines(found) if output is None else source_lines(found, most=10**9)
    _tell_comparison(lines, source_values(found), lines[-1], as_json, output)
    if strict and not (found.agrees and found.complete):
        raise typer.Exit(1)


def _tell_comparison(
    lines: list[str], values: dict[str, Any], outcome: str, as_json: bool, output: Path | None
) -> None:
    """Prints a comparison, or writes it into a file and prints the outcome."""
    from cadgraph._io.atomic import write_atomically

    if output is None:
        _show(lines, values, as_json)
        return
    text = json.dumps(values, ensure_ascii=False, indent=1) if as_json else "\n".join(lines)
    write_atomically(output, f"{text}\n")
    out.print(f"wrote {escape(str(output))}: {escape(outcome)}")


def _show(text: list[str], values: dict[str, Any], as_json: bool) -> None:
    if as_json:
        say_json(values)
        return
    _print(out, text)
