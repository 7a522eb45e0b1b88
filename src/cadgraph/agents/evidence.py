"""What an answer in words rests on: the tags in it, and the calls of tools that returned them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cadgraph.agents.answer import AskError, cell
from cadgraph.agents.plant import Plant

__all__ = ["Call", "Support", "is_plain", "support_of", "value_of"]

_MARK = re.compile(r"^[ \t*_`>#]*ANSWER[ \t*_`]*:[ \t*_`]*", re.MULTILINE)
_FENCE = re.compile(r"\A[\s`*]*(?:json\b)?[\s`*]*")
_TAG = re.compile(r"(?<![\w-])[A-Za-z]{1,9}-\d[\w-]*\b")  # what looks like a tag, be it one or not
_SHOUTED = re.compile(r"[A-Z]{3,}\b[ :]")  # how tools begin a line of doubt
_MOST_HEADS = 4  # first lines of an answer that may hold its doubts
_MOST_TAGS = 500  # that an answer can name in its last line


@dataclass(frozen=True)
class Call:
    """A tool that was run for a question.

    Args:
        number: counted from 1.
        tool: its name.
        arguments: as they were given.
        text: what it said, as far as the model saw it; of a call that failed, why.
        failed: whether it was no answer.
        repeats: number of the call that was the same, and whose answer stood.
    """

    number: int
    tool: str
    arguments: Mapping[str, Any]
    text: str
    failed: bool = False
    repeats: int | None = None

    def __str__(self) -> str:
        given = (f"{cell(name, 40)}={json.dumps(value, ensure_ascii=False)}" for name, value in self.arguments.items())
        return f"{cell(self.tool)}({cell(', '.join(given), 200)})"

    @property
    def verdict(self) -> str:
        """The first line of what it said, with the lines of doubt that follow it at once."""
        first, *others = self.text.split("\n")[:_MOST_HEADS]
        return "; ".join(cell(line, 200) for line in (first, *(line for line in others if _SHOUTED.match(line))))


@dataclass(frozen=True)
class Support:
    """Which tags an answer names, and what shows them.

    Args:
        shown: of each tag that a call returned, the numbers of those calls.
        unsupported: tags that no call returned.
        absent: tags that were looked for and that the plant has not.
    """

    shown: Mapping[str, tuple[int, ...]]
    unsupported: tuple[str, ...]
    absent: tuple[str, ...]


def value_of(text: str) -> tuple[str, Any, tuple[str, ...]]:
    """Takes an answer apart: the words, and what stands behind ``ANSWER:`` as JSON.

    Args:
        text: of a model.

    Returns:
        The words without that line; its value, None where it is unknown or there is none; the tags that it names.
    """
    marks = list(_MARK.finditer(text))
    if not marks:
        return text.strip(), None, ()
    words, rest = text[: marks[-1].start()].strip(), text[marks[-1].end() :]
    told = _first_json(rest)
    if not isinstance(told, dict):
        told = told if is_plain(told) else cell(repr(told), 500)
        return words or _said(told), told, ()
    named = told.get("tags")
    tags = tuple(cell(tag) for tag in named[:_MOST_TAGS] if isinstance(tag, str)) if isinstance(named, list) else ()
    value = told.get("value")
    value = value if is_plain(value) else cell(repr(value), 500)
    return words or _said(value), value, tags


def is_plain(value: Any) -> bool:
    """Whether a value is a text, a finite number, true, false, null, or a list of such."""
    if isinstance(value, list):
        return all(not isinstance(each, list) and is_plain(each) for each in value)
    return value is None or isinstance(value, str | int) or (isinstance(value, float) and math.isfinite(value))


def support_of(plant: Plant, text: str, declared: Sequence[str], calls: Sequence[Call]) -> Support:
    """Finds what shows the tags of an answer.

    A tag is shown by a call whose answer names it; calls that failed show nothing, but that there is no such tag.

    Args:
        plant: that was asked about.
        text: of the answer.
        declared: tags that the answer says it rests on.
        calls: that were made.
    """
    shown: dict[str, tuple[int, ...]] = {}
    unsupported: list[str] = []
    absent: list[str] = []
    for tag, is_there in _named_in(plant, text, declared).items():
        by = tuple(call.number for call in calls if not call.failed and _holds(call.text, tag))
        tried = any(call.failed and _holds(json.dumps(dict(call.arguments), ensure_ascii=False), tag) for call in calls)
        if is_there and by:
            shown[tag] = by
        elif not is_there and tried:
            absent.append(tag)
        else:
            unsupported.append(tag)
    return Support(shown, tuple(unsupported), tuple(absent))


def _named_in(plant: Plant, text: str, declared: Iterable[str]) -> dict[str, bool]:
    """The tags that an answer names, in their order, and whether the plant has them."""
    names = plant.names
    # A name without a digit may be a plain word of the answer; it counts where the answer says that it is a tag.
    at = {
        name: where
        for name in names
        if name in text and any(letter.isdigit() for letter in name) and (where := _place(text, name)) >= 0
    }
    for match in _TAG.finditer(text):
        at.setdefault(_known(plant, match[0]), match.start())
    found = sorted(at, key=lambda name: (at[name], name))
    found += [known for tag in declared if tag and (known := _known(plant, tag)) not in at]
    return {name: name in names for name in dict.fromkeys(found)}


def _known(plant: Plant, tag: str) -> str:
    """A tag as answers show it, however loosely it is spelt; the same where there is none."""
    if tag in plant.names:
        return tag
    try:
        return plant.called(plant.find(tag).id)
    except AskError:
        return tag


def _holds(text: str, name: str) -> bool:
    return name in text and _place(text, name) >= 0


def _place(text: str, name: str) -> int:
    """Where a name stands in a text as a word of its own; -1 where it doesn't."""
    found = re.search(rf"(?<![\w-]){re.escape(name)}(?!-?\w)", text)
    return found.start() if found else -1


def _first_json(text: str) -> Any:
    """The JSON that a text begins with; the text's first line where it begins with none."""
    try:
        return json.JSONDecoder().raw_decode(_FENCE.sub("", text))[0]
    except (ValueError, RecursionError):
        return cell(text.strip().partition("\n")[0].strip("`* "), 500) or None


def _said(value: Any) -> str:
    if value is None:
        return "Unknown."
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)
