"""How the words of ``cadgraph build`` are read: the address of ``--ray`` may be left out."""

from __future__ import annotations

import os
from typing import Any

from typer.core import TyperCommand

__all__ = ["BuildCommand"]

_OPTION, _DEFAULT = "--ray", "local"


class BuildCommand(TyperCommand):
    """A command whose ``--ray`` takes an address or none."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Reads the words of the command, with an address wherever one was left out."""
        return super().parse_args(ctx, with_address(args))


def with_address(words: list[str]) -> list[str]:
    """The words of a command, with the default address behind each ``--ray`` that has none.

    What follows it is another option, or a file that is there: so ``--ray`` may stand before the scenes.
    """
    given: list[str] = []
    for number, word in enumerate(words):
        following = words[number + 1] if number + 1 < len(words) else "-"
        given.append(word)
        if word == _OPTION and (following.startswith("-") or os.path.exists(following)):
            given.append(_DEFAULT)
        elif word == "--":
            return [*given, *words[number + 1 :]]
    return given
