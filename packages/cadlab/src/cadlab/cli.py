"""How good it is: evaluate, reproduce."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph.cli.options import GraphArgument
from cadgraph.cli.screen import bars, out


def evaluate(
    graph: GraphArgument,
    truth: Annotated[Path, typer.Argument(metavar="TRUTH", help="What is known for certain: a truth file (JSON).")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FOLDER", help="Also write Markdown, JSON and figures.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
) -> None:
    """Say how well a graph agrees with the truth: labels, units, relations, structures, contacts, confidence."""
    from cadlab.evaluate import evaluate_files, to_json, to_markdown

    evaluation = evaluate_files(graph, truth, output)
    print(json.dumps(to_json(evaluation), indent=1) if as_json else to_markdown(evaluation))  # noqa: T201


def reproduce(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FOLDER", help="Where page and pictures go.")],
    preset: Annotated[str, typer.Option(help="The generated plant to run on.")] = "field",
    seed: Annotated[int, typer.Option(min=0, help="Of the plant.")] = 0,
    quick: Annotated[bool, typer.Option("--quick", help="One small plant and small pictures.")] = False,
) -> None:
    """Run the paper's experiments in its mode and in ours, and put the figures side by side."""
    from cadlab.reproduce import reproduce as run_experiments

    with bars() as progress:
        page = run_experiments(output, preset=preset, seed=seed, quick=quick, progress=progress)
    out.print(f"wrote {escape(str(page))}")
