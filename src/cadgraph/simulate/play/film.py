"""What a plant does while a timetable is played: its state at every picture of a film."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.simulate.play.timetable import Timetable

if TYPE_CHECKING:
    from cadgraph.hydraulics.process import State
    from cadgraph.hydraulics.settings import Move

__all__ = ["FRAMES_PER_SECOND", "MOST_SECONDS", "Film", "key_times", "play"]

FRAMES_PER_SECOND = 24
MOST_SECONDS = 600.0
"""What is played at most: 14,400 samples of each thing that moves."""

_LONG = 1.0  # s; a quicker move has no middle to look at
_REST = 2.0  # s; several times the lag of a gauge
_APART = 40  # pictures of a strip are at least this fraction of the film apart


class Playable(Protocol):
    """What is needed of a :class:`~cadgraph.hydraulics.process.Process`."""

    @property
    def state(self) -> State:
        """As it is now."""

    def step(self, commands: Mapping[str, float], dt: float) -> State:
        """Goes on by a time [s]."""


@dataclass(frozen=True)
class Film:
    """What a plant did.

    Args:
        states: at each picture, the first before anything is done.
        moves: what was done, by when it began.
        per_second: pictures in a second.
    """

    states: tuple[State, ...]
    moves: tuple[Move, ...]
    per_second: int = FRAMES_PER_SECOND

    @property
    def seconds(self) -> float:
        """How long it takes."""
        return (len(self.states) - 1) / self.per_second

    @property
    def tags(self) -> tuple[str, ...]:
        """Of the valves and pumps that something was done to, in the order of that."""
        return tuple(dict.fromkeys(tag for move in self.moves for tag in move.set))

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of all that turns, sorted."""
        return tuple(sorted(self.states[0].joints))

    def angles(self, joint: str) -> Floats:
        """``(n_pictures,)`` how far something is turned [deg]; 0 is as drawn."""
        return np.array([state.joints[joint] for state in self.states])

    def readings(self, tag: str) -> Floats:
        """``(n_pictures,)`` what a gauge shows; NaN where nobody knows."""
        values = [state.reading.get(tag) for state in self.states]
        return np.array([math.nan if value is None else value for value in values])

    def number(self, time: float) -> int:
        """Of the picture at a time."""
        return max(0, min(round(time * self.per_second), len(self.states) - 1))


def play(process: Playable, timetable: Timetable, seconds: float, per_second: int = FRAMES_PER_SECOND) -> Film:
    """Plays a timetable.

    Args:
        process: goes on from the state that it is in.
        timetable: what is done to it.
        seconds: how long; at most 600 s.
        per_second: pictures in a second.

    Raises:
        ValueError: so long can't be played.
    """
    if not 0 < seconds <= MOST_SECONDS:
        raise ValueError(f"can't play {seconds:g} s; give more than 0 and at most {MOST_SECONDS:g}")
    start = {**process.state.opening, **process.state.speed}
    states = [process.state]
    for number in range(1, round(seconds * per_second) + 1):
        states.append(process.step(timetable.commands(number / per_second, start), 1 / per_second))
    return Film(tuple(states), timetable.moves, per_second)


def key_times(moves: Sequence[Move], seconds: float, least: int = 5, most: int = 5) -> tuple[float, ...]:
    """The times at which one looks to understand what happened: before, amid and after each move, and the end.

    Args:
        moves: what is done, by when it begins.
        seconds: that are played.
        least: how many times at least.
        most: how many at most; the ones in the middle are thinned out.

    Returns:
        Ascending [s], the first 0, the last the end.
    """
    times = [0.0, seconds]
    for move, until in zip(moves, [*(move.at for move in moves), seconds][1:], strict=True):
        if move.over >= _LONG:
            times.append(move.at + move.over / 2)
        # Gauges lag behind: shown is what they say once they have come to rest, if there is time for it.
        end = move.at + move.over
        times.append(end + _REST if end + _REST <= until else max(end, until))
    apart = seconds / _APART
    kept: list[float] = []
    for time in sorted(time for time in times if time <= seconds):
        if kept and time - kept[-1] < apart:
            kept[-1] = kept[-1] if kept[-1] == 0 else time
        else:
            kept.append(time)
    while len(kept) < least:
        gap, first = max((b - a, -a) for a, b in zip(kept, kept[1:], strict=False))
        kept = sorted([*kept, gap / 2 - first])
    while len(kept) > most:
        # The one that stands closest between its neighbours tells least.
        closest = min(range(1, len(kept) - 1), key=lambda k: kept[k + 1] - kept[k - 1])
        del kept[closest]
    return tuple(kept)
