"""What the source file says of a part or a unit, as it is told."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cadgraph._io.text import printable, shortened
from cadgraph.model.records import SourceFact

__all__ = ["fact_rows", "fact_values"]

_MOST_TOLD = 20  # in words
_LONGEST = 200  # characters of a value, in words


def fact_rows(facts: Sequence[SourceFact]) -> list[tuple[str, str]]:
    """Facts as pairs of a heading and a text on one line, in the order of the graph; a count of what is too much."""
    rows = [("" if i else "file says", _say(fact)) for i, fact in enumerate(facts[:_MOST_TOLD])]
    more = len(facts) - _MOST_TOLD
    return rows + ([("", f"and {more} more; --json has them all")] if more > 0 else [])


def fact_values(facts: Sequence[SourceFact]) -> list[dict[str, Any]]:
    """Facts as plain values, all of them."""
    return [fact.model_dump() for fact in facts]


def _say(fact: SourceFact) -> str:
    place = f"{fact.where}, of {fact.path}" if fact.path else fact.where
    return f"{_short(fact.key)} {_short(fact.value)} ({_short(place)})"


def _short(text: str) -> str:
    return shortened(printable(text), _LONGEST)
