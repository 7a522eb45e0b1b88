"""What a tool says: a text that fits into the window of a language model, in pages, and the whole as plain values.

Names in a graph come from a CAD file of anybody. They are data: each is put on one line without anything that moves a
cursor or turns a text round, and cut to a length.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cadgraph._io.manifest import LACKING
from cadgraph._io.text import printable, shortened
from cadgraph.errors import AskError

__all__ = [
    "BEHIND", "BUDGET", "CHANGED", "OUTDATED", "Answer", "AskError", "among", "cell", "did_you_mean", "page_of", "row",
    "tokens",
]  # fmt: skip

BUDGET = 1500
"""Most tokens of an answer, as :func:`tokens` counts them."""

_BYTES_PER_TOKEN = 1.9  # measured: ids and coordinates take about two characters a token, unlike prose with four
BEHIND = f"mind\t{LACKING}"
"""The last line of an answer from a graph that its folder holds corrections for that it doesn't show."""
OUTDATED = "the file of the scene changed since this graph was built: build it again"
CHANGED = f"mind\t{OUTDATED}"
"""Likewise from a graph whose source isn't what it was made from any more."""
_NOTE = f"{BEHIND}\n{CHANGED}\npage 9999 of 9999; next: page=9999"  # as long as the last lines of a page can be
_NEAR = 3  # names offered where one is not found
_MOST_LISTED = 12  # names that an error lists


@dataclass(frozen=True)
class Answer:
    """What a tool says.

    Args:
        text: for a model and a person: at most :data:`BUDGET` tokens. Columns are divided by tabs. Where there is more,
            its last line says so: "page 1 of 3; next: page=2".
        values: the whole answer, all pages, as plain JSON values; lengths in metres.
    """

    text: str
    values: Mapping[str, Any]


def tokens(text: str) -> int:
    """How many tokens a text takes at most, whatever the model: its bytes divided by 1.9."""
    return math.ceil(_size(text) / _BYTES_PER_TOKEN)


def cell(text: object, most: int = 80) -> str:
    """A text from a graph on one line.

    Args:
        text: anything; None is ``""``.
        most: characters that are kept; what is cut ends in "…".

    Returns:
        The text with a blank in place of control characters, line breaks, tabs, and all that is invisible or changes
        the direction of writing; blanks in a row are one.
    """
    if text is None:
        return ""
    # Only so much is looked at that a name of a million characters costs nothing.
    return shortened(" ".join(printable(str(text)[: 8 * most + 8]).split()), most)


def row(*cells: object) -> str:
    """Cells as a line of a table, divided by tabs, which no cell holds; empty ones at the end are left out."""
    return "\t".join(cell(each) for each in cells).rstrip("\t")


def page_of(head: Sequence[str], rows: Sequence[str], foot: Sequence[str], page: int) -> str:
    """One page of an answer, with what stands on all of them.

    Rows are divided so that each page keeps within the budget: none is lost, none is there twice. What of head and foot
    is too long to stand on every page stands once, before or after the rows; so does a row that fills a page.

    Args:
        head: lines at the top of each page.
        rows: of all pages.
        foot: lines at the bottom of each page.
        page: counted from 1.

    Raises:
        AskError: there is no such page.
    """
    room = int(BUDGET * _BYTES_PER_TOKEN) - _size(_NOTE)
    top, below = _fitting(head, room // 3)
    bottom, above = _fitting(foot[::-1], room // 3)
    room -= sum(_size(line) + 1 for line in (*top, *bottom))
    pages: list[list[str]] = [[]]
    used = 0
    for line in (piece for each in (*below, *rows, *above[::-1]) for piece in _pieces(each, room)):
        if used + _size(line) + 1 > room:
            pages.append([])
            used = 0
        pages[-1].append(line)
        used += _size(line) + 1
    if not 1 <= page <= len(pages):
        raise AskError(f"there is no page {page}; this answer has {_count(len(pages), 'page')}, counted from 1")
    last = []
    if len(pages) > 1:
        last = [f"page {page} of {len(pages)}" + (f"; next: page={page + 1}" if page < len(pages) else "")]
    return "\n".join((*top, *pages[page - 1], *bottom[::-1], *last))


def among(value: str, known: Iterable[str], what: str) -> str:
    """The one of some words that is meant, whatever its capitals, with a blank for ``-`` and ``_``.

    Args:
        value: as it was given.
        known: what there is.
        what: they are, in words: ``"type"``.

    Raises:
        AskError: it is none of them; the nearest ones are named.
    """
    words = {_plain(word): word for word in known}
    if _plain(value) in words:
        return words[_plain(value)]
    raise AskError(f"no {what} {cell(value)!r} here; {did_you_mean(value, words.values())}")


def did_you_mean(value: str, known: Iterable[str]) -> str:
    """What may have been meant by a word, else what there is."""
    words = {_plain(word): cell(word) for word in known}
    near = difflib.get_close_matches(_plain(value), words, _NEAR)
    near = near or [word for word in words if _plain(value) and f" {_plain(value)}" in f" {word}"][:_NEAR]
    if near:
        return f"did you mean {', '.join(words[word] for word in near)}?"
    listed = list(words.values())[:_MOST_LISTED]
    more = f" and {len(words) - len(listed)} more" if len(words) > len(listed) else ""
    return f"there is {', '.join(listed)}{more}" if listed else "there is none"


def _plain(word: str) -> str:
    return " ".join(cell(word).casefold().replace("-", " ").replace("_", " ").split())


def _fitting(lines: Sequence[str], room: int) -> tuple[list[str], list[str]]:
    """The first lines, as many as fit, and the rest."""
    for n in range(len(lines), 0, -1):
        if sum(_size(line) + 1 for line in lines[:n]) <= room:
            return list(lines[:n]), list(lines[n:])
    return [], list(lines)


def _pieces(line: str, room: int) -> Iterable[str]:
    """A line, or pieces of it where it is longer than a page."""
    while _size(line) + 1 > room:
        # A character has four bytes at most.
        most = max(1, room // 4 - 1)
        yield line[:most]
        line = line[most:]
    yield line


def _size(text: str) -> int:
    return len(text.encode("utf-8", "surrogatepass"))


def _count(n: int, noun: str) -> str:
    return f"{n} {noun}{'s' * (n != 1)}"
