"""What an answer in words rests on: the tags in it, and the calls of tools that returned them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cadgraph.agents.answer import cell
from cadgraph.agents.plant import Plant
from cadgraph.model.names import loose_tag

__all__ = ["Call", "Support", "is_plain", "support_of", "value_of"]

_MARK = re.compile(r"^[ \t*_`>#]*ANSWER[ \t*_`]*:[ \t*_`]*", re.MULTILINE)
_FENCE = re.compile(r"\A[\s`*]*(?:json\b)?[\s`*]*")
_TAG = re.compile(r"(?<![\w-])[A-Za-z]{1,9}-\d[\w-]*\b")  # what looks like a tag, be it one or not
_NUMBER = re.compile(r"(?<![\w.])\d{1,15}(?:\.\d{1,15})?(?![\d.]*\d)")
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
        reckoned: numbers with a decimal point that neither a call nor the question has, rounded or not.
    """

    shown: Mapping[str, tuple[int, ...]]
    unsupported: tuple[str, ...]
    absent: tuple[str, ...]
    reckoned: tuple[str, ...] = ()


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


def support_of(plant: Plant, text: str, declared: Sequence[str], calls: Sequence[Call], question: str = "") -> Support:
    """Finds what shows the tags and the numbers of an answer.

    A tag is shown by a call whose answer names it; calls that failed show nothing, but that there is no such tag.

    Args:
        plant: that was asked about.
        text: of the answer.
        declared: tags that the answer says it rests on.
        calls: that were made.
        question: whose numbers need no call.
    """
    answers = [call for call in calls if not call.failed and call.repeats is None]
    shown: dict[str, tuple[int, ...]] = {}
    unsupported: list[str] = []
    absent: list[str] = []
    for tag, is_there in _named_in(plant, text, declared).items():
        by = tuple(call.number for call in answers if _holds(call.text, tag))
        tried = any(call.failed and _holds(json.dumps(dict(call.arguments), ensure_ascii=False), tag) for call in calls)
        if is_there and by:
            shown[tag] = by
        elif not is_there and tried:
            absent.append(tag)
        else:
            unsupported.append(tag)
    reckoned = _reckoned(text, (question, *(call.text for call in answers)))
    return Support(shown, tuple(unsupported), tuple(absent), reckoned)


def _reckoned(text: str, sources: Iterable[str]) -> tuple[str, ...]:
    """Numbers with decimals in a text that are none of the sources' numbers, rounded to as many decimals."""
    known = [float(number) for source in sources for number in _NUMBER.findall(source)]
    found = dict.fromkeys(number for number in _NUMBER.findall(text) if "." in number)
    return tuple(
        number
        for number in found
        if not any(abs(float(number) - each) <= 0.5001 * 10.0 ** -len(number.partition(".")[2]) for each in known)
    )


def _named_in(plant: Plant, text: str, declared: Iterable[str]) -> dict[str, bool]:
    """The tags that an answer names, in their order, and whether the plant has them."""
    names = plant.names
    # A name without a digit may be a plain word of the answer; it counts where the answer says that it is a tag.
    at = {
        name: where
        for name in names
        if name in text and any(letter.isdigit() for letter in name) and (where := _place(text, name)) >= 0
    }
    loose = _Loose(names)
    for match in _TAG.finditer(text):
        at.setdefault(loose.known(match[0]), match.start())
    found = sorted(at, key=lambda name: (at[name], name))
    found += [known for tag in declared if tag and (known := loose.known(tag)) not in at]
    return {name: name in names for name in dict.fromkeys(found)}


class _Loose:
    """Names by what is alike in their spellings."""

    def __init__(self, names: Set[str]) -> None:
        self._names = names

    def known(self, tag: str) -> str:
        """A tag as answers show it, however loosely it is spelt; the same where there is none, or several."""
        if tag in self._names:
            return tag
        alike = self._alike.get(loose_tag(tag), ())
        return alike[0] if len(alike) == 1 else tag

    @cached_property
    def _alike(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for name in self._names:
            found.setdefault(loose_tag(name), []).append(name)
        return found


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
