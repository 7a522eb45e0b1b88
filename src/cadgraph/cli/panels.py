"""What the help shows: the groups of commands and their order, and flags without a type."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup

__all__ = [
    "ASK", "BUILD", "CORRECT", "EVALUATE", "EXPORT", "LABEL", "LOOK", "NETWORK", "OTHERS", "PANELS", "SIMULATE", "Root",
]  # fmt: skip

BUILD = "Build"
LOOK = "Look"
CORRECT = "Correct"
LABEL = "Label with a model, or from your own parts"
NETWORK = "Ask the network of pipes"
ASK = "Ask what is where, as agents do"
SIMULATE = "Plan and simulate"
EXPORT = "Export and compare"
EVALUATE = "Evaluate, and generate test plants"
OTHERS = "Of other packages"

PANELS = (BUILD, LOOK, CORRECT, LABEL, NETWORK, ASK, SIMULATE, EXPORT, EVALUATE, OTHERS)
"""All groups, in the order of the help."""


class Root(TyperGroup):
    """The command that has all others: it lists them by group, and shows no type of flags, which says nothing."""

    def list_commands(self, ctx: Any) -> list[str]:
        """The names of all commands, group by group; within one in the order in which they were registered."""
        return sorted(super().list_commands(ctx), key=self._place)

    def _place(self, name: str) -> int:
        panel = getattr(self.commands[name], "rich_help_panel", None)
        return PANELS.index(panel) if panel in PANELS else len(PANELS)

    def get_params(self, ctx: Any) -> Any:
        """Its own options, of which flags show no type."""
        return _hushed(super().get_params(ctx))

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """A command, whose flags show no type."""
        found = super().get_command(ctx, cmd_name)
        if found is not None:
            _hush(found, ctx)
        return found


def _hush(command: Any, ctx: Any) -> None:
    """Takes the types of flags out of the help of a command and of all below it."""
    _hushed(command.get_params(ctx))
    for inner in getattr(command, "commands", {}).values():
        _hush(inner, ctx)


def _hushed(options: list[Any]) -> list[Any]:
    for option in options:
        if getattr(option, "is_flag", False) and option.metavar is None:
            option.metavar = ""
    return options
