"""Names in a file to steps of a path."""

from __future__ import annotations

import re

from cadgraph._io.text import shortened
from cadgraph.model.facts import Fact

__all__ = ["Names", "clipped", "name_fact", "path_step", "step_text"]

_LONGEST = 200  # characters of one step; ours: names in plants have up to some 80
_LONGEST_VALUE = 1000  # characters of a fact; ours: a description is a line


class Names:
    """Names that are taken, among siblings or all over; quick however often the same one is asked for."""

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._last: dict[str, int] = {}

    def take(self, name: str) -> str:
        """The name, or the first of ``name_1``, ``name_2``... that isn't taken; it is taken afterwards."""
        free = name
        while free in self._taken:
            self._last[name] = self._last.get(name, 0) + 1
            free = f"{name}_{self._last[name]}"
        self._taken.add(free)
        return free


def step_text(name: str) -> str:
    """What of a name can stand in a path: letters, digits, ``_``, ``.`` and ``-``, the rest ``_``; maybe nothing."""
    return re.sub(r"[^\w.-]+", "_", name).strip("_.")


def path_step(name: object, otherwise: str) -> str:
    """One step of a path from whatever name a file gives: letters, digits, ``_``, ``.`` and ``-``, the rest ``_``.

    Args:
        name: as in the file; only text counts.
        otherwise: the step where nothing of the name is left.
    """
    text = name if isinstance(name, str) else ""
    return step_text(text[: 2 * _LONGEST])[:_LONGEST] or otherwise


def name_fact(path: str, name: object, where: str) -> tuple[Fact, ...]:
    """The name as it stands in the file, where the last step of the path doesn't tell it already."""
    if not isinstance(name, str) or not name.strip() or path.rpartition("/")[2] == name:
        return ()
    return (Fact(path, "name", clipped(name), where),)


def clipped(value: str) -> str:
    """A value of a fact; what is longer than any sensible one ends in an ellipsis."""
    return shortened(value.strip(), _LONGEST_VALUE)
