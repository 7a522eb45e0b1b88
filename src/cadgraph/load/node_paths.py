"""Paths of the nodes of a tree of names (glTF, and what the STEP library returns): one place for readers and writers.

A path is the names from the root down, each made unique among its siblings: ``/Skid/Valve_1/Body``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from cadgraph.load.packing import unique_name

__all__ = ["MOST_DEEP", "node_paths", "path_name"]

MOST_DEEP = 200
"""Levels of a tree that are walked; ours, far beyond any real assembly."""

_ODD = re.compile(r"[^\w.-]+")
_LONGEST = 200  # characters of a step; ours: names in plants have up to some 80


def path_name(*names: str) -> str:
    """The first of several names that says anything, with ``_`` for all but letters, digits, ``.``, ``-`` and ``_``."""
    cleaned = (_ODD.sub("_", name[: 2 * _LONGEST]).strip("_.")[:_LONGEST] for name in names)
    return next((name for name in cleaned if name), "part")


def node_paths(
    names: Sequence[str], children: Sequence[Sequence[int]], roots: Sequence[int]
) -> Iterator[tuple[str, int, int | None]]:
    """Every node below some roots with its path, parents first.

    Args:
        names: of each node, as steps of paths.
        children: numbers of the nodes right below each node.
        roots: numbers of the nodes to begin at.

    Yields:
        The path, the number of the node, and the number of the node above it, None for a root.

    Raises:
        ValueError: a node is there twice, or has a number that there is none of.
    """
    seen: set[int] = set()
    stack: list[tuple[str, int, int | None, int]] = []

    def enter(numbers: Sequence[int], path: str, above: int | None, depth: int) -> None:
        taken: set[str] = set()
        found = []
        for number in numbers:
            if type(number) is not int or not 0 <= number < len(names):
                raise ValueError(f"there is no node {number!r}")
            if number in seen:
                raise ValueError(f"node {number} stands in the tree twice")
            seen.add(number)
            found.append((f"{path}/{unique_name(names[number], taken)}", number, above, depth))
        stack.extend(reversed(found))

    enter(roots, "", None, 0)
    while stack:
        path, number, above, depth = stack.pop()
        yield path, number, above
        if depth < MOST_DEEP:
            enter(children[number], path, number, depth + 1)
