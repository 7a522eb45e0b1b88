"""What is done to valves and pumps, and when: the list ``play`` of a scenario file.

::

    play:
      - at: 2             # s
        over: 10          # s; at once where it is left out
        set: {V-003: 0}   # opening of a valve, or speed of a pump, 0..1
      - at: 20
        set: {P-001: 0}
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from cadgraph._io.limits import TIMETABLE, read_text_within
from cadgraph._io.strict_yaml import parse_yaml
from cadgraph._io.validation_messages import expectation
from cadgraph.errors import FormatError, UnknownNode
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit

__all__ = ["MOST_SECONDS", "Move", "Timetable", "read_timetable"]

MOST_SECONDS = 600.0
"""What is played at most: 14,400 samples of each thing that moves."""

_MOST_MOVES = 1000
_REMEDY = "give a YAML file with a list 'play' of moves, each with 'at', 'set' and maybe 'over'"
_SETTABLE = ("valve", "pump")


@dataclass(frozen=True)
class Move:
    """Something that is done to valves or pumps.

    Args:
        at: when it begins [s].
        over: how long it takes [s]; 0: at once.
        to: where each valve's opening or pump's speed goes, 0..1, by tag.
    """

    at: float
    over: float
    to: Mapping[str, float]

    @property
    def end(self) -> float:
        """When it is done [s]."""
        return self.at + self.over


@dataclass(frozen=True)
class Timetable:
    """All that is done, in the order of time.

    Args:
        moves: by when they begin.
        alone: whether the file that they come from says nothing else, so that the scenario is another file.
    """

    moves: tuple[Move, ...]
    alone: bool = True

    @property
    def tags(self) -> tuple[str, ...]:
        """Of all that is moved, in the order in which it begins to."""
        return tuple(dict.fromkeys(tag for move in self.moves for tag in move.to))

    def commands(self, time: float, start: Mapping[str, float]) -> dict[str, float]:
        """What is asked of each valve and pump at a time.

        A move goes evenly from what was asked of a thing when it begins; one that begins before another has ended
        takes its place.

        Args:
            time: [s].
            start: opening or speed of each before anything is done, by tag.

        Returns:
            By tag, for those that a move was begun for.
        """
        asked: dict[str, float] = {}
        for tag in self.tags:
            own = [move for move in self.moves if tag in move.to and move.at <= time]
            value = start.get(tag, 1.0)
            for move, until in zip(own, [*(move.at for move in own[1:]), time], strict=bool(own)):
                share = 1.0 if move.over == 0 else min(1.0, (until - move.at) / move.over)
                value += share * (move.to[tag] - value)
                asked[tag] = value
        return asked


class _Row(BaseModel):
    model_config = ConfigDict(extra="forbid")

    at: Annotated[float, Field(ge=0, le=MOST_SECONDS, allow_inf_nan=False)]
    over: Annotated[float, Field(ge=0, le=MOST_SECONDS, allow_inf_nan=False)] = 0.0
    to: Annotated[dict[str, Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]], Field(alias="set", min_length=1)]


def read_timetable(path: str | Path, graph: SceneGraph) -> Timetable:
    """Reads what is to be done to a plant, and when.

    Args:
        path: a YAML file with a list ``play``; a whole scenario may be in it, too.
        graph: that the valves and pumps belong to.

    Raises:
        FormatError: it isn't such a file, a value is impossible, or a tag is that of no valve and no pump.
    """
    content = parse_yaml(read_text_within(path, TIMETABLE, FormatError, _REMEDY), str(path), FormatError)
    rows = content.get("play") if isinstance(content, dict) else None
    if not isinstance(rows, list) or not rows:
        raise FormatError(f"{path}: no list 'play' in it; {_REMEDY}")
    if len(rows) > _MOST_MOVES:
        raise FormatError(f"{path}: {len(rows):,} moves, and at most {_MOST_MOVES:,} are played; leave some out")
    moves = [_move(row, f"{path}: move {number}", graph) for number, row in enumerate(rows, 1)]
    return Timetable(tuple(sorted(moves, key=lambda move: move.at)), alone=set(content) == {"play"})


def _move(row: Any, where: str, graph: SceneGraph) -> Move:
    try:
        read = _Row.model_validate(row)
    except ValidationError as error:
        detail = error.errors()[0]
        name = ".".join(str(step) for step in detail["loc"])
        what = "is no field of a move" if detail["type"] == "extra_forbidden" else expectation(detail)
        raise FormatError(f"{where}: {name or 'it'} {what}") from None
    named: dict[str, float] = {}
    for text, value in read.to.items():
        tag = _tag(text, where, graph)
        if tag in named:
            raise FormatError(f"{where}: {tag} is set twice")
        named[tag] = value
    return Move(read.at, read.over, named)


def _tag(text: str, where: str, graph: SceneGraph) -> str:
    try:
        unit = graph.find(text, Unit)
    except UnknownNode as error:
        raise FormatError(f"{where}: {error}") from None
    if not isinstance(unit, Unit) or unit.unit_type not in _SETTABLE:
        raise FormatError(f"{where}: {text} is no valve and no pump, and nothing else can be set")
    return unit.tag
