"""The tools that agents use, each as a command: overview, find, describe, neighbors, route, what-if, measure..."""

from __future__ import annotations

import inspect
import itertools
import re
from collections.abc import Callable
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import typer
from pydantic.fields import FieldInfo

from cadgraph.agents.sql.schema import TABLES
from cadgraph.agents.tools import TOOLS, Tool
from cadgraph.cli.application import app
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import ASK, NETWORK
from cadgraph.cli.screen import say, say_json

_PANELS = {"neighbors": NETWORK, "route": NETWORK, "what_if": NETWORK}
"""The groups of the help that commands belong to, but for those among what agents ask."""

_THING = "a tag (V-003), an id or a mesh path"
_HELPS = {
    "id": f"Of what: {_THING}.",
    "start": f"Where the way begins: {_THING}.",
    "end": f"Where the way ends: {_THING}.",
    "a": f"From what: {_THING}.",
    "b": f"To what: {_THING}.",
    "target": f"What to get at: {_THING}.",
    "system": "Only of this system, e.g. system-001.",
    "by": "What counts as next.",
    "reach": "Only what is reached from there.",
    "sort": "What comes first.",
    "page": "Which page of a long answer, counted from 1.",
}
"""What arguments mean that models need no words for."""

_QUERY = """Count, list and join by one SQLite SELECT.

Ways along pipes are asked for by trace, route, isolate and what-if. What is null is unknown; metres; z is up, y north.
The tables, whose columns docs/query.md explains:

"""
_JSON = Annotated[bool, typer.Option("--json", help="Print the whole answer as JSON.")]


def _register(tool: Tool) -> None:
    """Makes a command of a tool, unless there is one of that name, which then says the same without pages."""
    name = tool.name.replace("_", "-")
    own = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    if name not in own:
        # In the list of commands the first sentence says enough; the rest is told by --help.
        short = re.split(r"[.;:](?:\s|$)", tool.description, maxsplit=1)[0] + "."
        panel = _PANELS.get(tool.name, ASK)
        app.command(name, help=_help(tool), short_help=short, rich_help_panel=panel)(_command(tool))


def _help(tool: Tool) -> str:
    """What a person is told of a tool: as a model is, but that each table has a line of its own."""
    if tool.name != "query":
        return tool.description
    return _QUERY + "\n".join(f"- {name}: {', '.join(table.columns)}" for name, table in TABLES.items())


def _command(tool: Tool) -> Callable[..., None]:
    def run(graph: Path, as_json: bool, **arguments: Any) -> None:
        from cadgraph.agents.plant import Plant

        answer = tool.ask(Plant.open(graph), {key: value for key, value in arguments.items() if value is not None})
        if as_json:
            say_json(answer.values)
        else:
            say(straight(answer.text))

    only = inspect.Parameter.KEYWORD_ONLY
    parameters = [
        inspect.Parameter("graph", only, annotation=GraphArgument),
        *(_parameter(each) for each in tool.parameters.values()),
        inspect.Parameter("as_json", only, default=False, annotation=_JSON),
    ]
    command: Any = run
    command.__signature__ = inspect.Signature(parameters)
    command.__annotations__ = {each.name: each.annotation for each in parameters}
    result: Callable[..., None] = command
    return result


def _parameter(given: inspect.Parameter) -> inspect.Parameter:
    """A parameter of a tool as an argument of its command, or as an option where it has a default."""
    kind, text = _type_and_text(given.annotation)
    text = _sentence(text) or _HELPS.get(given.name, "")
    only, metavar = inspect.Parameter.KEYWORD_ONLY, given.name.upper()
    if given.default is inspect.Parameter.empty:
        argument = typer.Argument(metavar=f"{metavar}..." if kind == list[str] else metavar, help=text)
        return inspect.Parameter(given.name, only, annotation=Annotated[kind, argument])
    flag = f"--{given.name.replace('_', '-')}"
    if kind is bool:
        return inspect.Parameter(
            given.name, only, default=False, annotation=Annotated[bool, typer.Option(flag, help=text)]
        )
    choices = get_args(given.annotation) if get_origin(given.annotation) is Literal else ()
    metavar = "|".join(map(str, choices)) or metavar
    option = typer.Option(flag, metavar=metavar, help=text, show_default=bool(given.default))
    if kind == list[str]:
        return inspect.Parameter(given.name, only, default=None, annotation=Annotated[list[str] | None, option])
    return inspect.Parameter(given.name, only, default=given.default, annotation=Annotated[kind, option])


def _type_and_text(annotation: Any) -> tuple[Any, str]:
    """What a command line takes for an annotation of a tool, and its help."""
    notes: tuple[Any, ...] = ()
    if get_origin(annotation) is Annotated:
        annotation, *found = get_args(annotation)
        notes = tuple(found)
    text = next((note.description or "" for note in notes if isinstance(note, FieldInfo)), "")
    if get_origin(annotation) is Literal:
        return str, text
    if get_origin(annotation) in (Union, UnionType):
        several = [each for each in get_args(annotation) if each is not NoneType]
        return (list[str] if list[str] in several else several[0]), text
    return annotation, text


def _sentence(text: str) -> str:
    """Words for a model as a person reads them in a help: with a capital and a full stop."""
    return text and text[0].upper() + text[1:] + "." * (text[-1] not in ".!?")


def straight(text: str) -> str:
    """An answer with straight columns in place of its tabs, as a terminal shows them best."""
    rows = [line.split("\t") for line in text.split("\n")]
    told: list[str] = []
    for is_table, block in itertools.groupby(rows, key=lambda cells: len(cells) > 1):
        table = list(block)
        # What stands last in its row makes no column wider.
        widths = [max((len(c[i]) for c in table if len(c) > i + 1), default=0) for i in range(max(map(len, table)))]
        for cells in table if is_table else ():
            padded = (cell.ljust(width) for cell, width in zip(cells, widths, strict=False))
            told.append("  ".join(padded).rstrip())
        told += [] if is_table else [cells[0] for cells in table]
    return "\n".join(told)


for _tool in TOOLS:
    _register(_tool)
