"""The chunks of a binary RVM file: where they are, how they nest, and their fields as columns.

The layout was found on real files and compared with what the open readers rvmparser and rvmsharp make of it. All is
big endian and a multiple of four bytes, so that a file is an array of words. A chunk: four words with a letter each,
the offset of the next chunk [bytes], a word that is always 1, the version, and the rest of its payload. A string: the
number of its words, then these, padded with zeros.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.load.packing import Notes
from cadgraph.model.scene import Ints

__all__ = ["PARAMETERS", "Chunks", "Words", "find_chunks", "map_words", "read_text"]

Words = npt.NDArray[np.uint32]  # big endian, whatever the machine

PARAMETERS = {1: 7, 2: 3, 3: 4, 4: 3, 5: 2, 6: 2, 7: 9, 8: 2, 9: 1, 10: 2}
"""How many numbers describe each kind of primitive; facet groups (11) have counts and points instead."""

_HEADER = 6  # words of a chunk before its version
_BLOCK = 1 << 22  # words looked at together: 16 MB
_MOST_BYTES = 1 << 32  # the links between chunks have 32 bits
_MOST_LEVELS = 500  # ours: real trees have about ten
_TAGS = ("HEAD", "MODL", "CNTB", "CNTE", "PRIM", "OBST", "INSU", "COLR", "END:")


@dataclass(frozen=True)
class Chunks:
    """All chunks of a file, in its order.

    Args:
        tag: ``(n,)`` number of each: its four letters as the bytes of a number.
        start: ``(n,)`` where its payload begins, with the version [words].
        end: ``(n,)`` where its payload ends [words].
        node: ``(n,)`` number of the innermost node (``CNTB`` chunks, counted from 0) around it; -1: none. A ``CNTB``
            counts as within the node above it.
    """

    tag: Ints
    start: Ints
    end: Ints
    node: Ints

    def of(self, tag: str) -> Ints:
        """The numbers of all chunks with these four letters, ascending."""
        return np.flatnonzero(self.tag == _code(tag))


def map_words(path: Path) -> Words:
    """The words of a file, mapped into memory.

    Raises:
        LoadError: it is larger than its own links can address.
    """
    size = path.stat().st_size
    if size > _MOST_BYTES:
        raise LoadError(f"{path}: larger than the 4 GiB that an RVM file can address; export it in several files")
    # Plain arrays: every look at one that knows of its file costs a microsecond.
    data = np.memmap(path, np.uint8, "r").view(np.ndarray) if size else np.zeros(0, np.uint8)
    return data[: size // 4 * 4].view(">u4")


def find_chunks(words: Words, path: Path, notes: Notes) -> Chunks:
    """Follows the links of a file.

    Where a link is broken, reading goes on at the next chunk that can be recognized (``broken-link``). Unknown kinds
    of chunks are skipped (``unknown-chunk``). What follows ``END:`` is padding.

    Args:
        words: of the file.
        path: of the file, for messages.
        notes: gets what was skipped.

    Raises:
        LoadError: there is no chunk at all, or they nest deeper than in any real file.
    """
    candidates = _candidates(words)
    if not len(candidates) or candidates[0] != 0 or _tags(words, candidates[:1])[0] != _code("HEAD"):
        raise LoadError(f"{path}: no RVM file (it doesn't start with HEAD); export it again")
    at, end = _chain(words, candidates)
    tag = _tags(words, at)
    known = np.isin(tag, [_code(name) for name in _TAGS])
    skipped = np.zeros(0, np.int64)
    if not known.all() or (end[:-1] != at[1:]).any():
        at, end, skipped = _walk(words, candidates)
        tag = _tags(words, at)
    finish = np.flatnonzero(tag == _code("END:"))
    if len(finish):
        at, end, tag = (column[: finish[0] + 1] for column in (at, end, tag))
    else:
        notes.add("cut-short", "the file has no end mark: what follows its last whole part is missing")
    for place in skipped.tolist():
        notes.add("broken-link", f"damaged at byte {place * 4}: went on at the next part that can be recognized")
    for code in np.unique(tag[~np.isin(tag, [_code(name) for name in _TAGS])]).tolist():
        notes.add("unknown-chunk", f"skipped parts of an unknown kind ({_letters(code)!r})")
    return Chunks(tag, at + _HEADER, end, _nodes(tag, path, notes))


def read_text(words: Words, start: int, end: int) -> tuple[bytes, int]:
    """A string, and where it ends [words].

    Args:
        words: of the file.
        start: where its length stands.
        end: of the chunk.

    Raises:
        ValueError: it is longer than its chunk.
    """
    if start >= end:
        raise ValueError("no room for a text")
    stop = start + 1 + int(words[start])
    if stop > end:
        raise ValueError("a text is longer than the part that holds it")
    return words[start + 1 : stop].tobytes().split(b"\0", 1)[0], stop


def _candidates(words: Words) -> Ints:
    """Wherever four letters and room for the rest of a chunk's header are [words]."""
    found = []
    last = len(words) - _HEADER
    for first in range(0, max(last, 0), _BLOCK):
        block = words[first : min(first + _BLOCK + 3, last + 3)].astype(np.uint32)
        letter = (block - np.uint32(ord(":"))) <= np.uint32(ord("Z") - ord(":"))
        found.append(first + np.flatnonzero(letter[:-3] & letter[1:-2] & letter[2:-1] & letter[3:]))
    return np.concatenate(found).astype(np.int64) if found else np.zeros(0, np.int64)


def _chain(words: Words, at: Ints) -> tuple[Ints, Ints]:
    """Of every candidate: where it begins and where its link points, cut at the end of the file [words]."""
    link = words[at + 4].astype(np.int64)
    end = np.where(link % 4 == 0, link // 4, -1)
    # The last chunk may point to where nothing is any more.
    end[-1] = len(words) if end[-1] <= at[-1] else min(int(end[-1]), len(words))
    return at, end


def _walk(words: Words, candidates: Ints) -> tuple[Ints, Ints, Ints]:
    """Link by link: where chunks begin and end, and where a link was broken."""
    following = dict(zip(candidates[:-1].tolist(), candidates[1:].tolist(), strict=True))
    links = dict(zip(candidates.tolist(), words[candidates + 4].tolist(), strict=True))
    known = set(candidates[np.isin(_tags(words, candidates), [_code(name) for name in _TAGS])].tolist())
    starts, ends, broken = [], [], []
    at: int | None = 0
    while at is not None:
        link = links[at]
        to: int | None = link // 4
        if link % 4 or link // 4 <= at or link // 4 not in links:
            to = following.get(at)
            # Only what is surely a chunk counts where no link says so.
            while to is not None and to not in known:
                to = following.get(to)
            if to is not None or link // 4 != len(words):
                broken.append(at)
        starts.append(at)
        ends.append(len(words) if to is None else to)
        at = to
    if broken and _letters(int(_tags(words, np.array(starts[-1:]))[0])) == "END:" and broken[-1] == starts[-1]:
        broken.pop()  # the end mark may point anywhere
    return np.array(starts, np.int64), np.array(ends, np.int64), np.array(broken, np.int64)


def _nodes(tag: Ints, path: Path, notes: Notes) -> Ints:
    opens, closes = tag == _code("CNTB"), tag == _code("CNTE")
    change = np.cumsum(opens.astype(np.int64) - closes)
    # One end too many happens in real files; it must not lift all that follows out of its node.
    lowest = np.minimum(np.minimum.accumulate(change), 0) if len(change) else change
    surplus = -int(lowest[-1]) if len(lowest) else 0
    depth = change - lowest
    if surplus:
        notes.add("unbalanced-tree", f"{surplus} node{'s' if surplus > 1 else ''} closed more than were opened")
    if len(depth) and depth[-1] > 0:
        notes.add("unbalanced-tree", f"the end of {int(depth[-1])} of the nodes is missing")
    if len(depth) and depth.max() > _MOST_LEVELS:
        raise LoadError(f"{path}: its nodes nest deeper than {_MOST_LEVELS} levels; it is damaged, export it again")
    number = np.cumsum(opens) - 1
    inner = np.full(len(tag), -1, np.int64)
    around = np.where(opens, depth - 1, depth)
    for level in range(1, int(depth.max(initial=0)) + 1):
        headers = np.flatnonzero(opens & (depth == level))
        inside = np.flatnonzero(around == level)
        last = np.searchsorted(headers, inside) - 1
        inner[inside[last >= 0]] = number[headers[last[last >= 0]]]
    return inner


def _tags(words: Words, at: Ints) -> Ints:
    tag = np.zeros(len(at), np.int64)
    for i in range(4):
        tag = tag * 256 + words[at + i]
    return tag


def _code(letters: str) -> int:
    return int.from_bytes(letters.encode("ascii"), "big")


def _letters(code: int) -> str:
    return code.to_bytes(4, "big").decode("ascii")
