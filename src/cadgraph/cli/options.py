"""Options that several commands share, and the settings they make."""

from __future__ import annotations

import tomllib
import warnings
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape

from cadgraph._io.limits import FLOWS, read_text_within
from cadgraph._io.text import printable
from cadgraph.cli.screen import REMEDY, err
from cadgraph.config import Config, read_config
from cadgraph.errors import CadGraphError

__all__ = [
    "USE_METADATA",
    "AssetRootOption",
    "ConfigOption",
    "CorrectedArgument",
    "GraphArgument",
    "MetadataOption",
    "MethodOption",
    "ScaleOption",
    "SetOption",
    "StrictOption",
    "UnitOption",
    "UpOption",
    "WhoOption",
    "WhyOption",
    "read_flows",
    "settings_of",
    "values_of",
]

ConfigOption = Annotated[
    Path | None, typer.Option("--config", metavar="FILE", help="Settings as TOML; 'cadgraph config' prints them all.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Change one setting, e.g. cluster.eps=0.02. May be repeated."),
]
MetadataOption = Annotated[
    bool,
    typer.Option(
        "--use-metadata", help="Let what the file says of its parts count beside geometry: classes, names, joints."
    ),
]
MethodOption = Annotated[
    str | None,
    typer.Option("--method", metavar="exact|paper", show_default=Config().method, help="How to decide what touches."),
]
UnitOption = Annotated[
    str | None,
    typer.Option("--unit", metavar="UNIT", help="Unit of the file's lengths, whatever it says: m, cm, mm, in, ft..."),
]
UpOption = Annotated[
    str | None, typer.Option("--up", metavar="AXIS", help="Up axis of the file, whatever it says: X, Y or Z.")
]
WhoOption = Annotated[str | None, typer.Option("--who", metavar="NAME", help="Who says so; your user name if none.")]
WhyOption = Annotated[str, typer.Option("--why", metavar="TEXT", help="The reason, for the list of corrections.")]
AssetRootOption = Annotated[
    list[str] | None,
    typer.Option(
        "--asset-root",
        metavar="DIR",
        help="Folder that a USD scene may bring files from beside its own, counted from there: .. May be repeated.",
    ),
]
ScaleOption = Annotated[
    float | None,
    typer.Option(
        "--scale", metavar="FACTOR", help="Multiply the file's lengths, in the unit it says (metres if none)."
    ),
]
StrictOption = Annotated[
    bool, typer.Option("--strict", help="Refuse a file of which geometry is lost: damaged, unreadable or not found.")
]
_GRAPH = "What 'cadgraph build' wrote, or a graph.json."


def _heed_changes(graph: Path) -> Path:
    """Says beside every answer that the graph it is given from lacks corrections, or that its source has changed."""
    from cadgraph._io.manifest import GRAPH_FILE, LACKING, behind
    from cadgraph._io.staging import result_path
    from cadgraph.model.source_file import changed_since, source_at_head

    with suppress(CadGraphError):  # what is wrong with the graph is told when it is read
        if behind(graph if graph.is_dir() else graph.parent):
            err.print(f"mind: {escape(str(graph))}: {LACKING}")
        file = result_path(graph / GRAPH_FILE) if graph.is_dir() else graph
        source = source_at_head(file)
        if source is not None and (changed := changed_since(source, file)):
            err.print(f"mind: {escape(printable(changed))}; {REMEDY}")
    return graph


GraphArgument = Annotated[Path, typer.Argument(metavar="FOLDER", help=_GRAPH, callback=_heed_changes)]
CorrectedArgument = Annotated[Path, typer.Argument(metavar="FOLDER", help=_GRAPH)]
"""Of commands that look at corrections themselves."""


USE_METADATA = {"label.use_metadata": True, "relate.use_metadata": True}
"""The settings that ``--use-metadata`` makes."""


def settings_of(
    file: Path | None,
    changes: Sequence[str],
    method: str | None,
    unit: str | None = None,
    up: str | None = None,
    *,
    scale: float | None = None,
    strict: bool = False,
    asset_roots: Sequence[str] | None = None,
) -> Config:
    """Defaults, then the file, then flags; a setting of an earlier version is told."""
    values = values_of(changes)
    flags = {
        "method": method,
        "load.unit": unit,
        "load.up": up.upper() if up else None,
        "load.asset_roots": tuple(asset_roots) if asset_roots else None,
        "load.scale": scale,
        "load.strict": strict or None,
    }
    values |= {name: value for name, value in flags.items() if value is not None}
    with warnings.catch_warnings(record=True) as old:
        warnings.simplefilter("always", DeprecationWarning)
        chosen = read_config(file) if file else Config()
        chosen = chosen.replace(values) if values else chosen
    for note in dict.fromkeys(str(one.message) for one in old):
        err.print(f"[dim]{escape(note)}[/]")
    return chosen


def values_of(changes: Sequence[str]) -> dict[str, Any]:
    """Settings and their values, of ``NAME=VALUE`` each."""
    values: dict[str, Any] = {}
    for change in changes:
        name, equals, text = change.partition("=")
        if not equals:
            raise ValueError(f"--set {change}: expected NAME=VALUE, e.g. cluster.eps=0.02")
        values[name.strip()] = _value(text.strip())
    return values


def read_flows(given: Sequence[str]) -> tuple[str, ...]:
    """Statements of flow: those given, and the lines of files that are named in their place.

    Raises:
        ValueError: what has no arrow is no file that can be read.
    """
    flows: list[str] = []
    for one in given:
        if "->" in one:
            flows.append(one)
            continue
        try:
            text = read_text_within(one, FLOWS, ValueError, "give a text file of lines as 'P-001 -> T-001'")
        except ValueError as error:
            raise ValueError(
                f"--flow {one}: no flow as 'P-001 -> T-001', and no text file of such lines ({error})"
            ) from None
        lines = (line.partition("#")[0].strip() for line in text.splitlines())
        flows += [line for line in lines if line]
    return tuple(flows)


def _value(text: str) -> Any:
    """A TOML value; what is none is taken as text, so that words need no quotes."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text
