"""The command line: one command per verb, no logic."""

from __future__ import annotations

import dataclasses
import json
import sys
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from cadgraph import __version__
from cadgraph.atomic import ensure_writable
from cadgraph.config import Config, read_config, to_toml
from cadgraph.errors import CadGraphError

__all__ = ["app", "main", "plants"]

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Turns an unlabelled CAD scene into a semantic 3D scene graph: what each part is, what it touches, which "
    "structure it belongs to, and how valves, gauges, pumps and tanks hang together along the pipes.",
    epilog="Start with **cadgraph demo**, then **cadgraph build SCENE -o FOLDER**.",
)
plants = typer.Typer(no_args_is_help=True, help="Generated test plants with their ground truth.")
app.add_typer(plants, name="environment")
_out = Console(highlight=False, soft_wrap=True)
_err = Console(stderr=True, highlight=False, soft_wrap=True)

ConfigOption = Annotated[
    Path | None, typer.Option("--config", metavar="FILE", help="Settings as TOML; 'cadgraph config' prints them all.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Change one setting, e.g. cluster.eps=0.02. May be repeated."),
]
MethodOption = Annotated[str | None, typer.Option("--method", help="How to decide what touches: exact or paper.")]
GraphArgument = Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote, or a graph.json.")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command line; ends the process with 0, with 2 on bad input or arguments, with 130 on Ctrl-C."""
    try:
        app(arguments)
    except (CadGraphError, ValueError) as error:
        _err.print(f"[bold red]error:[/] {escape(_one_line(error))}")
        sys.exit(2)
    except KeyboardInterrupt:
        _err.print("stopped; nothing half-written was left, the same command starts anew")
        sys.exit(130)


@app.callback(invoke_without_command=True)
def _root(version: Annotated[bool, typer.Option("--version", help="Print the version and stop.")] = False) -> None:
    if version:
        _out.print(f"cadgraph {__version__}")
        raise typer.Exit


@app.command()
def build(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A CAD scene: USD (usd, usda, usdc, usdz) or STEP.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where the results go.")],
    labels: Annotated[
        Path | None, typer.Option("--labels", metavar="FILE", help="Labels from outside: JSON, CSV or a truth file.")
    ] = None,
    vocabulary: Annotated[
        Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree, as YAML.")
    ] = None,
    ground: Annotated[
        list[str] | None,
        typer.Option("--ground", metavar="PATH", help="A mesh that is the ground, or 'none'. May be repeated."),
    ] = None,
    method: MethodOption = None,
    config: ConfigOption = None,
    settings: SetOption = None,
    report: Annotated[bool, typer.Option("--report/--no-report", help="Draw pictures and write report.html.")] = True,
) -> None:
    """Turn a CAD scene into a scene graph, a USD label layer and a report."""
    from cadgraph.job import run

    changes = [*(settings or [])]
    chosen = _settings(config, changes, method)
    if ground:
        find = "none" if ground == ["none"] else "named"
        chosen = chosen.replace({"ground.find": find, "ground.meshes": [] if find == "none" else ground})
    with _bars() as progress:
        outcome = run(scene, output, chosen, labels=labels, vocabulary=vocabulary, report=report, progress=progress)
    _tell(outcome)


@app.command()
def demo(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where the results go.")] = Path(
        "demo"
    ),
    config: ConfigOption = None,
    settings: SetOption = None,
) -> None:
    """Generate a small plant skid with meaningless names, and turn it into a scene graph."""
    from cadgraph.environment import make_skid, write_usd
    from cadgraph.job import run

    chosen = _settings(config, settings or [], None)
    scene = ensure_writable(output) / "skid.usdc"
    write_usd(make_skid(), scene)
    with _bars() as progress:
        outcome = run(scene, output, chosen, progress=progress)
    _tell(outcome)


@app.command()
def show(
    graph: GraphArgument,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Say what a graph holds."""
    from cadgraph.graph import SceneGraph
    from cadgraph.summary import summarize

    summary = summarize(SceneGraph.load(graph))
    if as_json:
        print(json.dumps(dataclasses.asdict(summary), ensure_ascii=False, indent=1))  # noqa: T201
        return
    for line in _lines(summary):
        _out.print(line)


@app.command()
def export(
    graph: GraphArgument,
    to: Annotated[str, typer.Option("--to", metavar="FORMAT", help="graphml, csv or networkx-json.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="PATH", help="File or folder; beside the graph by default.")
    ] = None,
) -> None:
    """Write a graph in another format."""
    from cadgraph.export import export_graph
    from cadgraph.graph import SceneGraph

    for path in export_graph(SceneGraph.load(graph), to, output or (graph if graph.is_dir() else graph.parent)):
        _out.print(f"wrote {escape(str(path))}")


@app.command("config")
def config_(
    config: ConfigOption = None,
    settings: SetOption = None,
) -> None:
    """Print the settings in force, with their meaning and source, as TOML."""
    print(to_toml(_settings(config, settings or [], None)), end="")  # noqa: T201


@app.command()
def evaluate(
    graph: GraphArgument,
    truth: Annotated[Path, typer.Argument(metavar="TRUTH", help="What is known for certain: a truth file (JSON).")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FOLDER", help="Also write Markdown, JSON and figures.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
) -> None:
    """Say how well a graph agrees with the truth: labels, units, relations, structures, contacts, confidence."""
    from cadgraph.evaluate import evaluate_files, to_json, to_markdown

    evaluation = evaluate_files(graph, truth, output)
    print(json.dumps(to_json(evaluation), indent=1) if as_json else to_markdown(evaluation))  # noqa: T201


@app.command()
def reproduce(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where page and pictures go.")],
    preset: Annotated[str, typer.Option(help="The generated plant to run on.")] = "field",
    seed: Annotated[int, typer.Option(min=0, help="Of the plant.")] = 0,
    quick: Annotated[bool, typer.Option("--quick", help="One small plant and small pictures.")] = False,
) -> None:
    """Run the paper's experiments in its mode and in ours, and put the figures side by side."""
    from cadgraph.reproduce import reproduce as run_experiments

    with _bars() as progress:
        page = run_experiments(output, preset=preset, seed=seed, quick=quick, progress=progress)
    _out.print(f"wrote {escape(str(page))}")


@plants.command("make")
def make_plant(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The scene, e.g. field.usdc.")],
    preset: Annotated[str, typer.Option(help="skid, riser, tank, pumps, rack or field.")] = "skid",
    seed: Annotated[int, typer.Option(min=0, help="Of everything that varies.")] = 0,
    hand: Annotated[
        str | None, typer.Option(help="In whose style it is modelled; the preset's own by default.")
    ] = None,
    spoilt: Annotated[
        float,
        typer.Option(min=0, max=1, help="Share of meshes with each modelling sin: there twice, hidden, inside out..."),
    ] = 0.0,
    unit: Annotated[float, typer.Option(help="Metres in one authored unit.")] = 0.001,
    up: Annotated[str, typer.Option(help="Authored up axis, Y or Z.")] = "Z",
    instances: Annotated[bool, typer.Option("--instances", help="Repeated shapes as native instances.")] = False,
) -> None:
    """Generate a plant as USD with meaningless names, and its ground truth beside it."""
    from cadgraph.environment import Sins, UsdStyle, make, write_usd

    if up not in ("Y", "Z"):
        raise ValueError(f"--up {up}: give Y or Z")
    sins = Sins(duplicates=spoilt, hidden=spoilt, flipped=spoilt, soup=spoilt, degenerate=spoilt)
    plant = make(preset, seed, hand, sins if spoilt else None)
    axis: Literal["Y", "Z"] = "Y" if up == "Y" else "Z"
    truth = write_usd(plant, output, UsdStyle(meters_per_unit=unit, up_axis=axis, instances=instances))
    _out.print(f"wrote {escape(str(output))} and {escape(str(truth))}")


@plants.command("truth-from-usd")
def truth_of(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A USD file that carries labels.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The truth file (JSON).")],
    vocabulary: Annotated[Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree.")] = None,
) -> None:
    """Read the labels of a USD file into a truth file."""
    from cadgraph.evaluate import truth_from_usd
    from cadgraph.vocabulary import read_vocabulary

    truth = truth_from_usd(scene, read_vocabulary(vocabulary) if vocabulary else None)
    truth.save(output)
    _out.print(f"wrote {escape(str(output))}: {len(truth.meshes or ()):,} labelled meshes")


def _settings(file: Path | None, changes: Sequence[str], method: str | None) -> Config:
    """Defaults, then the file, then flags."""
    chosen = read_config(file) if file else Config()
    values: dict[str, Any] = {}
    for change in changes:
        name, equals, text = change.partition("=")
        if not equals:
            raise ValueError(f"--set {change}: expected NAME=VALUE, e.g. cluster.eps=0.02")
        values[name.strip()] = _value(text.strip())
    if method is not None:
        values["method"] = method
    return chosen.replace(values) if values else chosen


def _value(text: str) -> Any:
    """A TOML value; what is none is taken as text, so that words need no quotes."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


@contextmanager
def _bars() -> Iterator[Any]:
    """A progress bar for each stage."""
    columns = (TextColumn("{task.description:<14}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=_err) as bars:
        tasks: dict[str, TaskID] = {}

        def told(stage: str, share: float) -> None:
            if stage not in tasks:
                tasks[stage] = bars.add_task(stage, total=1.0)
            bars.update(tasks[stage], completed=share)

        yield told


def _tell(outcome: Any) -> None:
    """Says what was found and what to open next."""
    from cadgraph.summary import summarize

    for line in _lines(summarize(outcome.graph)):
        _out.print(line)
    names = {"report": "look at", "picture": "picture", "graph": "the graph", "labels": "in a simulator"}
    for purpose, words in names.items():
        if purpose in outcome.files:
            _out.print(f"[dim]{words:<15}[/][bold]{escape(str(outcome.files[purpose]))}[/]")


def _lines(summary: Any) -> list[str]:
    groups = ", ".join(f"{escape(group)} {n}" for group, n in summary.groups.items()) or "none"
    units = ", ".join(f"{len(tags)} {escape(kind)}{'s' * (len(tags) != 1)}" for kind, tags in summary.units.items())
    found = ", ".join(f"{escape(code)} {n}" for code, n in summary.diagnostics.items()) or "none"
    rows = (
        ("source", f"{escape(summary.source)}: {summary.n_meshes:,} meshes, {summary.n_triangles:,} triangles"),
        ("parts", f"{summary.n_parts:,}, {summary.n_labelled:,} of them labelled"),
        ("labels", groups),
        ("structures", f"{summary.n_clusters:,}, {summary.n_pipe_systems:,} of them pipe systems"),
        ("touching", f"{summary.n_adjacent:,} pairs of parts"),
        ("units", units or "none"),
        ("relations", f"{summary.n_related:,} between units"),
        ("diagnostics", found),
    )
    return [f"[dim]{name:<15}[/]{text}" for name, text in rows]


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
