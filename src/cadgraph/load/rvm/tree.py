"""The nodes of an RVM file: names, types told by default names, and paths."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.load.naming import Names, step_text
from cadgraph.load.packing import Notes
from cadgraph.load.rvm.chunks import Chunks, Words
from cadgraph.model.scene import Ints

__all__ = ["NO_PLANT", "Tree", "decode", "read_tree"]

NO_PLANT = ("DRAWING", "WELD")
"""Types, as default names tell them, that are no part of the plant: drawn frames, and welds, which lie within pipes."""

# What an element without a name is called: "VALVE 1 of BRANCH 2 of PIPE /100-B-1".
_DEFAULT = re.compile(r"([A-Z][A-Z ]*?) (\d+) of ([A-Z][A-Z ]*?)(?: \d+ of |(?= /))")
_MOST_TEXT = 500_000_000  # characters of all paths together; ours: a million nodes of real depth have 8e7


@dataclass(frozen=True)
class Tree:
    """All nodes, parents before what is below them.

    Args:
        names: ``(n,)`` as in the file.
        words: ``(n,)`` the type that the default name of the node, or of one below it, tells; empty: none.
        told_below: ``(n,)`` whether it is that of one below.
        parent: ``(n,)`` number of the node above; -1: none.
        material: ``(n,)`` number of the colour.
        paths: ``(n,)`` unique.
        left_out: ``(n,)`` whether it is no part of the plant, or below such a node.
        chunk: ``(n,)`` number of the chunk of each.
    """

    names: list[str]
    words: list[str]
    told_below: list[bool]
    parent: Ints
    material: Ints
    paths: list[str]
    left_out: npt.NDArray[np.bool_]
    chunk: Ints

    def path_of(self, node: int) -> str:
        """The path of a node, ``/`` for what is in none."""
        return self.paths[node] if node >= 0 else "/"

    def has_children(self) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether there is a node below each."""
        found = np.zeros(len(self.names), bool)
        found[self.parent[self.parent >= 0]] = True
        return found


def read_tree(words: Words, chunks: Chunks, where: str, notes: Notes) -> tuple[Tree, Names]:
    """Reads all nodes.

    Args:
        words: of the file.
        chunks: of the file.
        where: the file, for messages.
        notes: gets what was damaged.

    Returns:
        The nodes, and all their paths, for names that are still to be made.

    Raises:
        LoadError: all paths together would fill the memory.
    """
    at = chunks.of("CNTB")
    start, end = chunks.start[at] + 1, chunks.end[at]
    stop = np.where(start < end, start + 1 + words[np.minimum(start, len(words) - 1)], end + 1)
    broken = np.flatnonzero(stop > end)
    # After the name come three numbers of a place that nothing refers to.
    colored = np.flatnonzero(stop + 3 < end)
    material = np.zeros(len(at), np.int64)
    material[colored] = words[stop[colored] + 3]
    stop[broken] = start[broken] + 1
    names: list[str] = []
    guessed = False
    raw = words.view(np.uint8).data
    for first, last in zip((4 * start + 4).tolist(), (4 * stop).tolist(), strict=True):
        name, was_guessed = decode(bytes(raw[first:last]).partition(b"\0")[0])
        guessed |= was_guessed
        names.append(name)
    if guessed:
        notes.add("encoding-guessed", "some names are no UTF-8; read as Windows-1252")
    parent = chunks.node[at]
    told = [_DEFAULT.match(name) if " of " in name else None for name in names]
    kinds = [match[1] if match else "" for match in told]
    below = [False] * len(names)
    for i, match in enumerate(told):
        above = int(parent[i])
        if match and above >= 0 and not kinds[above] and names[above] and names[i].endswith(names[above]):
            kinds[above], below[above] = match[3], True
    steps = [_step(name, match) for name, match in zip(names, told, strict=True)]
    paths, taken = _paths(steps, parent, where)
    for i in broken.tolist():
        notes.add("broken-node", "its name is damaged; it got another one", paths[i])
    left_out = np.array([kind in NO_PLANT and not inferred for kind, inferred in zip(kinds, below, strict=True)], bool)
    for i, above in enumerate(parent.tolist()):
        if above >= 0 and left_out[above]:
            left_out[i] = True
    return Tree(names, kinds, below, parent, material, paths, left_out, at), taken


def decode(raw: bytes) -> tuple[str, bool]:
    """A text of the file, and whether its encoding had to be guessed."""
    try:
        return raw.decode("utf-8"), False
    except UnicodeDecodeError:
        return raw.decode("cp1252", "replace"), True


def _step(name: str, told: re.Match[str] | None) -> str:
    # What follows "of" is the path above.
    own = f"{told[1]}_{told[2]}" if told else name
    return step_text(own) or "node"


def _paths(steps: list[str], parent: Ints, where: str) -> tuple[list[str], Names]:
    lengths: list[int] = []
    above = parent.tolist()
    for step, up in zip(steps, above, strict=True):
        lengths.append(1 + len(step) + (lengths[up] if up >= 0 else 0))
    if sum(lengths) > _MOST_TEXT:
        raise LoadError(f"{where}: the names of its nodes add up to paths beyond all measure; it is damaged")
    paths: list[str] = []
    taken = Names()
    for step, up in zip(steps, above, strict=True):
        paths.append(taken.take(f"{paths[up] if up >= 0 else ''}/{step}"))
    return paths, taken
