"""cadgraph agentbench: make a set of questions, score answers, run a model."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph.cli.screen import bars, out

__all__ = ["agentbench"]

agentbench = typer.Typer(
    name="agentbench",
    help="Measure how well agents answer questions about generated plants, whose answers can be proved.",
    no_args_is_help=True,
)
SetArgument = Annotated[Path, typer.Argument(metavar="SET", help="What 'make' wrote: set.jsonl, or its folder.")]


@agentbench.command("make")
def make_command(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Gets set.jsonl, questions.jsonl and plants.")],
    seed: Annotated[int, typer.Option(min=0, help="Of plants and questions.")] = 0,
    each: Annotated[int, typer.Option(min=1, help="Most questions of a type about a plant.")] = 3,
    preset: Annotated[list[str] | None, typer.Option(help="A generated plant; again for more. All by default.")] = None,
    labels: Annotated[
        list[str] | None, typer.Option(help="Which labels the graphs are built with: true, embedded; both by default.")
    ] = None,
) -> None:
    """Generate plants, build their graphs, and write questions with their answers."""
    from cadlab.agentbench.making import DEFAULT_PRESETS, LABELS, make_set
    from cadlab.agentbench.report import to_markdown

    unknown = [name for name in labels or () if name not in LABELS]
    if unknown:
        raise ValueError(f"--labels {unknown[0]}: give {' or '.join(LABELS)}")
    chosen = [name for name in LABELS if name in (labels or LABELS)]
    with bars() as progress:
        made = make_set(folder, seed, preset or DEFAULT_PRESETS, chosen, each, progress)
    out.print(f"wrote {escape(str(folder))}: {len(made.questions)} questions about {len(made.plants)} plants")
    out.print(escape(to_markdown(made)))


@agentbench.command("score")
def score_command(
    questions: SetArgument,
    answers: Annotated[
        Path | None, typer.Option(metavar="FILE", help="An agent's answers; without them the graph alone is scored.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
    show: Annotated[bool, typer.Option("--misses", help="Print every question that is answered wrongly.")] = False,
) -> None:
    """Score the graph against the truth, and an agent against both."""
    from cadlab.agentbench.question_file import read_answers, read_set
    from cadlab.agentbench.report import misses, to_json, to_markdown

    asked = read_set(questions)
    given = read_answers(answers, asked) if answers is not None else None
    text = json.dumps(to_json(asked, given), indent=1) if as_json else to_markdown(asked, given)
    print("\n".join([text, "", *misses(asked, given)]) if show and not as_json else text)  # noqa: T201


@agentbench.command("run")
def run_command(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="What 'make' wrote, with its plants.")],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="The answers; those in it aren't asked for again.")
    ],
    model: Annotated[str, typer.Option(metavar="NAME", help="Of the model, as its server knows it.")],
    base_url: Annotated[
        str, typer.Option(metavar="URL", help="A compatible server: vLLM, Ollama... OpenAI's own if left out.")
    ] = "",
    key_variable: Annotated[
        str, typer.Option(metavar="NAME", help="Environment variable that holds the key.")
    ] = "OPENAI_API_KEY",
    max_questions: Annotated[
        int | None, typer.Option(min=1, show_default="no limit", help="Ask so many at most.")
    ] = None,
    max_steps: Annotated[int, typer.Option(min=2, max=100, help="Turns of the model for a question at most.")] = 12,
    max_tokens: Annotated[int, typer.Option(min=1000, help="Sent and answered for a question in all.")] = 40_000,
    max_cost: Annotated[
        float | None, typer.Option(min=0.0, show_default="no limit", help="At most so many US dollars in all.")
    ] = None,
    prices: Annotated[str, typer.Option(metavar="FILE", help="A price table (YAML); else the built-in one.")] = "",
    timeout: Annotated[float, typer.Option(min=1.0, help="Give up on one try after [s].")] = 120.0,
) -> None:
    """Put the questions to a model with the tools in process, keep its answers, and score them."""
    from cadgraph.agents.ask import Limits
    from cadgraph.labelers.lvlm.address import is_local
    from cadgraph.labelers.lvlm.price import read_price
    from cadgraph.labelers.lvlm.talk import Talker
    from cadlab.agentbench.question_file import read_answers, read_set
    from cadlab.agentbench.report import to_markdown
    from cadlab.agentbench.runner import ModelAsked, run_questions

    asked = read_set(folder)
    known = read_answers(output, asked) if output.exists() else {}
    talker = Talker(model, base_url=base_url, key_variable=key_variable, timeout=timeout, wait=timeout)
    price = read_price(model, prices, local=is_local(talker.address))
    told = ModelAsked(talker, Limits(max_steps, max_tokens, max_cost), price)
    plants = (folder if folder.is_dir() else folder.parent) / "plants"
    try:
        with bars() as progress:
            given = run_questions(asked, plants, told, output, known=known, most=max_questions, progress=progress)
    finally:
        talker.close()
        out.print(f"[dim]{escape(model)}:[/] {told.tally()}")
    out.print(escape(to_markdown(asked, given)))
