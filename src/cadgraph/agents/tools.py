"""The list of tools: the command line, the server and the assistant are all made from it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, ValidationError, create_model

from cadgraph.agents import approaching, asking_sql, describing, looking, measuring, planning, walking
from cadgraph.agents.answer import BEHIND, CHANGED, Answer, AskError, among, cell, did_you_mean
from cadgraph.agents.plant import Plant

__all__ = ["TOOLS", "Tool", "tool_named"]


@dataclass(frozen=True)
class Tool:
    """A question that can be asked of a plant.

    Args:
        name: as a server lists it; the command has ``-`` for ``_``.
        description: for a model: what it answers and what not, in at most 60 words.
        run: the function; its first parameter is the plant, the others have annotations and plain values.
    """

    name: str
    description: str
    run: Callable[..., Answer]

    @cached_property
    def parameters(self) -> Mapping[str, inspect.Parameter]:
        """The parameters but for the plant, by name, with types as pydantic takes them, their descriptions included."""
        hints = get_type_hints(self.run, include_extras=True)
        own = list(inspect.signature(self.run).parameters.values())[1:]
        return {each.name: each.replace(annotation=_described(hints[each.name])) for each in own}

    @cached_property
    def _arguments(self) -> type[BaseModel]:
        fields: dict[str, Any] = {
            name: (each.annotation, Field() if each.default is each.empty else each.default)
            for name, each in self.parameters.items()
        }
        return create_model(self.name, __config__=ConfigDict(extra="forbid", allow_inf_nan=False), **fields)

    @cached_property
    def schema(self) -> dict[str, Any]:
        """The arguments as a JSON schema, as small as it can be."""
        full = self._arguments.model_json_schema()
        properties = {name: _short(each) for name, each in full.get("properties", {}).items()}
        schema: dict[str, Any] = {"type": "object", "properties": properties}
        return schema | ({"required": full["required"]} if full.get("required") else {})

    def ask(self, plant: Plant, arguments: Mapping[str, Any]) -> Answer:
        """Runs the tool with arguments of anybody.

        Args:
            plant: that is asked about.
            arguments: by name, as plain values.

        Raises:
            CadGraphError: the arguments are wrong (:class:`~cadgraph.errors.AskError`), or there is no answer.
        """
        answer = self.run(plant, **self.checked(arguments))
        behind, changed = plant.graph.lacks_corrections, plant.graph.changed_source
        text = "\n".join((answer.text, *[BEHIND] * behind, *[CHANGED] * bool(changed)))
        minded = {"behind_corrections": True} if behind else {}
        return Answer(text, {**answer.values, **minded, **({"changed_source": changed} if changed else {})})

    def checked(self, arguments: Mapping[str, Any]) -> dict[str, Any]:
        """The arguments that the function takes, of those that anybody gave.

        Args:
            arguments: by name, as plain values.

        Raises:
            AskError: one is wrong; the message says which, and what is there instead.
        """
        for name in arguments:
            if name not in self.parameters:
                raise AskError(f"{self.name} has no argument {cell(name)!r}; {did_you_mean(name, self.parameters)}")
        try:
            values = self._arguments.model_validate(dict(arguments))
        except ValidationError as error:
            first = error.errors(include_url=False, include_context=False, include_input=False)[0]
            where = ".".join(str(step) for step in first["loc"])
            raise AskError(f"{self.name}: {cell(where)}: {cell(first['msg'], 200)}") from None
        return {name: getattr(values, name) for name in self.parameters}


def tool_named(name: str) -> Tool:
    """The tool of this name.

    Raises:
        AskError: there is none; the message names the nearest ones.
    """
    named = {tool.name: tool for tool in TOOLS}
    return named[among(name, named, "tool")]


def _described(annotation: Any) -> Any:
    """``Annotated[T, "text"]`` with the text as the description that pydantic knows."""
    if get_origin(annotation) is not Annotated:
        return annotation
    bare, *notes = get_args(annotation)
    text = next((note for note in notes if isinstance(note, str)), None)
    return Annotated[bare, Field(description=text)] if text else annotation


def _short(schema: Mapping[str, Any]) -> dict[str, Any]:
    """The schema of an argument without what its name and its description say: title, default, that it may be null."""
    kept = {key: value for key, value in schema.items() if key not in ("title", "default")}
    choices = [choice for choice in kept.get("anyOf", ()) if choice.get("type") != "null"]
    return kept | ({"anyOf": choices} if choices else {})


TOOLS: tuple[Tool, ...] = (
    Tool(
        "overview",
        "Sum up: extent, units by kind, systems, what is not known.",
        looking.overview,
    ),
    Tool(
        "find",
        "List and count units (or parts, junctions, ends), with places in m; distances straight.",
        looking.find,
    ),
    Tool("describe", "Describe one thing: kind, place, ports, parts, what turns.", describing.describe),
    Tool(
        "neighbors",
        "List what is next along pipes (units, ends), or touches.",
        walking.neighbors,
    ),
    Tool(
        "trace",
        "List what it feeds (downstream) or what feeds it (upstream), in order, with distances along pipes.",
        walking.trace,
    ),
    Tool("route", "Find the shortest way along pipes, either way of flow.", walking.route),
    Tool(
        "isolate",
        "List valves to close so nothing can flow to a unit. Repeat its doubts and what stays open: people act on it.",
        walking.isolate,
    ),
    Tool(
        "what_if",
        "Say what loses its supply when valves are closed. About flow, not safety: for opening a unit use "
        "isolate. UNKNOWN stays unknown. SIMULATED rests on assumptions.",
        walking.what_if,
    ),
    Tool("lines", "List lines: from, to, length, DN, flow, what stands in each line in order.", walking.lines),
    Tool(
        "measure",
        "Measure distances: straight, in plan, height, compass, above or below, along pipes.",
        measuring.measure,
    ),
    Tool(
        "approach",
        "Say how to get at a unit: ways, where to stand, operator height, where a gauge is seen from.",
        approaching.approach,
    ),
    Tool("query", asking_sql.DESCRIPTION, asking_sql.query),
    Tool(
        "plan",
        "Plan a checked, short round to read gauges and turn valves: ways, ladders, what steps cut off. "
        "Repeat ! and ?.",
        planning.plan,
    ),
)
"""All tools, in the order that they are listed in."""
