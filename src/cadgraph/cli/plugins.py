"""Commands that other packages bring: each names itself in the entry points ``cadgraph.commands``."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import typer

from cadgraph.cli.panels import EVALUATE, OTHERS
from cadgraph.errors import MissingPackage

__all__ = ["KNOWN", "add_installed"]

KNOWN = {"agentbench": "cadlab", "environment": "cadplants", "evaluate": "cadlab", "reproduce": "cadlab"}
"""The package that brings each of the commands that are part of this repository but not of the product."""


def add_installed(app: typer.Typer) -> None:
    """Adds the commands of the installed packages; those of ``KNOWN`` that are missing say how to get them.

    Args:
        app: the application; the commands that it has keep their names, also those that were added before.
    """
    own = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    own |= {group.name for group in app.registered_groups}
    found = {point.name: point for point in entry_points(group="cadgraph.commands") if point.name not in own}
    for name in sorted((KNOWN.keys() - own) | found.keys()):
        if name in found:
            _add(app, name, found[name])
        else:
            everything = {"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []}
            app.command(name, hidden=True, context_settings=everything)(_missing(name, KNOWN[name]))


def _add(app: typer.Typer, name: str, point: EntryPoint) -> None:
    command: Any = point.load()
    panel = EVALUATE if name in KNOWN else OTHERS
    if isinstance(command, typer.Typer):
        app.add_typer(command, name=name, rich_help_panel=panel)
    else:
        app.command(name, rich_help_panel=panel)(command)


def _missing(name: str, package: str) -> Callable[[typer.Context], None]:
    def refuse(context: typer.Context) -> None:
        raise MissingPackage(name, package)

    return refuse
