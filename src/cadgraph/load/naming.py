"""Names in a file to steps of a path."""

from __future__ import annotations

import re

from cadgraph.model.facts import Fact

__all__ = ["clipped", "name_fact", "path_step"]

_LONGEST = 200  # characters of one step; ours: names in plants have up to some 80
_LONGEST_VALUE = 1000  # characters of a fact; ours: a description is a line


def path_step(name: object, otherwise: str) -> str:
    """One step of a path from whatever name a file gives: letters, digits, ``_``, ``.`` and ``-``, the rest ``_``.

    Args:
        name: as in the file; only text counts.
        otherwise: the step where nothing of the name is left.
    """
    text = name if isinstance(name, str) else ""
    return re.sub(r"[^\w.-]+", "_", text[: 2 * _LONGEST]).strip("_.")[:_LONGEST] or otherwise


def name_fact(path: str, name: object, where: str) -> tuple[Fact, ...]:
    """The name as it stands in the file, where the last step of the path doesn't tell it already."""
    if not isinstance(name, str) or not name.strip() or path.rpartition("/")[2] == name:
        return ()
    return (Fact(path, "name", clipped(name), where),)


def clipped(value: str) -> str:
    """A value of a fact; what is longer than any sensible one ends in an ellipsis."""
    value = value.strip()
    return value if len(value) <= _LONGEST_VALUE else value[:_LONGEST_VALUE] + "…"
