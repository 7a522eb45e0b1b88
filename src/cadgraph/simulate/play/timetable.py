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
from typing import Any

from cadgraph._io.limits import SCENARIO, read_text_within
from cadgraph._io.strict_yaml import parse_yaml
from cadgraph.errors import ScenarioError
from cadgraph.hydraulics.scenario_file import read_scenario
from cadgraph.hydraulics.settings import Move
from cadgraph.query.network import Network

__all__ = ["Timetable", "read_timetable", "says_more"]

_REMEDY = "give a YAML file with a list 'play' of moves, each with 'at', 'set' and maybe 'over'"
_MOST_MOVES = 1000


@dataclass(frozen=True)
class Timetable:
    """All that is done.

    Args:
        moves: by when they begin.
    """

    moves: tuple[Move, ...]

    @property
    def tags(self) -> tuple[str, ...]:
        """Of all that is moved, in the order in which it begins to."""
        return tuple(dict.fromkeys(tag for move in self.moves for tag in move.set))

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
            own = [move for move in self.moves if tag in move.set and move.at <= time]
            value = start[tag]
            for move, until in zip(own, [*(move.at for move in own[1:]), time], strict=bool(own)):
                share = 1.0 if move.over == 0 else min(1.0, (until - move.at) / move.over)
                # What has come to its end is there to the last digit.
                value = move.set[tag] if share == 1.0 else value + share * (move.set[tag] - value)
                asked[tag] = value
        return asked


def read_timetable(path: str | Path, network: Network) -> Timetable:
    """Reads what is to be done to a plant, and when.

    Args:
        path: a YAML file with a list ``play``; a whole scenario may be in it, too.
        network: that the valves and pumps belong to.

    Raises:
        ScenarioError: it isn't such a file, a value is impossible, or a tag is that of nothing that can be set.
    """
    content = _content(path)
    rows = content.get("play") if isinstance(content, dict) else None
    if not isinstance(rows, list) or not rows:
        raise ScenarioError(f"{path}: no list 'play' in it; {_REMEDY}")
    if len(rows) > _MOST_MOVES:
        raise ScenarioError(f"{path}: {len(rows):,} moves, and at most {_MOST_MOVES:,} are played; leave some out")
    moves = read_scenario(path, network).play
    still = [number for number, move in enumerate(moves, 1) if not move.set]
    if still:
        raise ScenarioError(f"{path}: play: {still[0]}: 'set' names nothing; give a tag and a value, as {{V-003: 0}}")
    return Timetable(moves)


def says_more(path: str | Path) -> bool:
    """Whether a file says more than what is done: what is supposed, too.

    Args:
        path: a YAML file.

    Raises:
        ScenarioError: it isn't one.
    """
    content = _content(path)
    return isinstance(content, dict) and bool(set(content) - {"play"})


def _content(path: str | Path) -> Any:
    return parse_yaml(read_text_within(path, SCENARIO, ScenarioError, _REMEDY), str(path), ScenarioError)
