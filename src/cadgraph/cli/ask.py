"""A question in words, answered by a language model that calls the tools: ask."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer
from rich.markup import escape

from cadgraph.cli.agents import straight
from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import ASK
from cadgraph.cli.screen import err, out, say_json
from cadgraph.errors import AskError

if TYPE_CHECKING:
    from cadgraph.agents.ask import Told
    from cadgraph.agents.evidence import Call

_LINES = 12  # of what a tool said that --verbose shows


_Model = Annotated[
    str, typer.Option("--model", metavar="NAME", help="Of the model, as its server knows it.", show_default=False)
]
_Url = Annotated[
    str,
    typer.Option(
        "--base-url",
        metavar="URL",
        help="A compatible server: vLLM, Ollama, LM Studio, Azure... OpenAI's own if left out.",
        show_default=False,
    ),
]
_Key = Annotated[str, typer.Option("--key-variable", metavar="NAME", help="Environment variable that holds the key.")]
_Steps = Annotated[int, typer.Option("--max-steps", min=2, max=100, help="Turns of the model at most.")]
_Tokens = Annotated[int, typer.Option("--max-tokens", min=1000, help="Sent and answered in all, as the server counts.")]
_Cost = Annotated[
    float | None,
    typer.Option(
        "--max-cost",
        min=0.0,
        show_default="no limit",
        help="At most so many US dollars, by the price table.",
    ),
]
_Prices = Annotated[
    str,
    typer.Option(
        "--prices", metavar="FILE", help="A price table (YAML); the built-in one if left out.", show_default=False
    ),
]
_Timeout = Annotated[
    float, typer.Option("--timeout", min=1.0, help="Give up on one try, or a wait that is asked for, after [s].")
]


@app.command(rich_help_panel=ASK)
def ask(
    graph: GraphArgument,
    question: Annotated[str, typer.Argument(metavar="QUESTION", help="In words, e.g. 'which valves isolate P-001?'.")],
    model: _Model = "",
    base_url: _Url = "",
    key_variable: _Key = "OPENAI_API_KEY",
    max_steps: _Steps = 12,
    max_tokens: _Tokens = 40_000,
    max_cost: _Cost = None,
    prices: _Prices = "",
    timeout: _Timeout = 120.0,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Show each step.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the answer, its calls and its cost as JSON.")] = False,
) -> None:
    """Have a language model answer a question by calling the tools; says what each tag in the answer rests on.

    Ends with 0 where the model came to an end by itself and calls returned every tag that it names, with 1 where a
    limit ended it or a tag is unsupported, and with 2 where there is no answer. Numbers that no call returned are
    named; what else it says are the model's words: the calls are listed, so that they can be looked up.
    """
    from cadgraph.agents.ask import Limits
    from cadgraph.agents.ask import ask as ask_model
    from cadgraph.agents.plant import Plant
    from cadgraph.agents.tools import TOOLS
    from cadgraph.labelers.lvlm.address import is_local
    from cadgraph.labelers.lvlm.price import read_price
    from cadgraph.labelers.lvlm.talk import Talker

    if not model:
        verbs = ", ".join(tool.name.replace("_", "-") for tool in TOOLS)
        raise AskError(
            "no model to ask: name one with --model, and its server with --base-url; without a model ask with the "
            f"commands {verbs}, each as 'cadgraph COMMAND FOLDER ...'"
        )
    plant = Plant.open(graph)
    talker = Talker(model, base_url=base_url, key_variable=key_variable, timeout=timeout, wait=timeout)
    price = read_price(model, prices, local=is_local(talker.address))
    limits = Limits(max_steps, max_tokens, max_cost)
    try:
        told = ask_model(plant, question, talker, limits, price=price, note=_show if verbose else None)
    finally:
        talker.close()
    if as_json:
        say_json(told.values())
    else:
        _tell(told)
    if not told.sound:
        raise typer.Exit(1)


def _show(step: int, call: Call) -> None:
    """A step of the model, on standard error."""
    again = f" [dim]as call {call.repeats}[/]" if call.repeats else ""
    err.print(f"[dim]step {step}, call {call.number}:[/] [bold]{escape(str(call))}[/]{again}")
    lines = [] if call.repeats else straight(call.text).split("\n")
    for line in lines[:_LINES]:
        err.print(f"    {escape(line)}")
    if len(lines) > _LINES:
        err.print(f"    [dim]{len(lines) - _LINES} more lines[/]")


def _tell(told: Told) -> None:
    """The answer, what it rests on, and what it doesn't."""
    out.print(escape(told.text))
    out.print()
    support = told.support
    rows = [("mind", f"[bold]{escape(told.limit)} ended it; the answer may lack something[/]")] if told.limit else []
    if support.unsupported:
        tags = escape(", ".join(support.unsupported))
        rows.append(("unsupported", f"[bold]{tags}[/]: no call returned this; don't rely on it"))
    if support.absent:
        rows.append(("not there", f"{escape(', '.join(support.absent))}: the plant has nothing of that name"))
    if support.reckoned:
        numbers = escape(", ".join(support.reckoned))
        rows.append(("reckoned", f"{numbers}: no call returned this number; the model made it"))
    by_calls: dict[tuple[int, ...], list[str]] = {}
    for tag, by in support.shown.items():
        by_calls.setdefault(by, []).append(tag)
    for by, tags_of in by_calls.items():
        calls = f"call{'s' * (len(by) > 1)} {', '.join(map(str, by))}"
        rows.append(("rests on", f"{escape(', '.join(tags_of))}: {calls}"))
    rows += [
        (f"call {call.number}", f"{escape(str(call))} [dim]{escape(call.verdict)}[/]")
        for call in told.calls
        if call.repeats is None
    ]
    cost = f", ${told.cost:.4f}" if told.cost else ""
    steps = f"{told.steps} steps, {told.prompt_tokens:,} + {told.answer_tokens:,} tokens{cost}"
    rows.append(("asked", f"{escape(told.model)}: {steps}"))
    for name, text in rows:
        out.print(f"[dim]{name:<15}[/]{text}")
