"""The rules of a round, played through step by step, of a round made here or by somebody else.

1. One begins at the start, or anywhere on the ground, and ends there.
2. A walk stays on a level. Its length is not less than the shortest one's.
3. A way is climbed from one of its ends to another.
4. A gauge is read, a valve turned and a pump stopped where one works at it; what takes a ladder or lift has had it
   set up.
5. Only what is asked is done, each goal once, and all of a stage before any of the next.
6. A valve that is closed on the round isn't closed again before it was opened, and the other way round; a pump
   likewise.
7. All goals are done at the end.
8. A step that names its unit besides its id names the one with that id.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from cadgraph.model.records import Unit
from cadgraph.plans.changes import off_before
from cadgraph.plans.goals import Goal
from cadgraph.plans.round import Doing, Round, Survey
from cadgraph.plans.stops import Spot, Stop

__all__ = ["Fault", "Move", "check_moves", "check_round", "moves_of"]

_LESS = 0.08, 0.02  # of a length, as walks over squares are so much longer than they must be; and m, by rounding


@dataclass(frozen=True)
class Move:
    """A step as anybody may have written it.

    Args:
        do: what.
        target: id of the unit or way.
        level: id of the level that a climb leads to; None where the way has one other end only.
        length: of a walk or climb [m]; None where it isn't said.
        named: the tag that stands beside the target, where that is the tag of something else.
    """

    do: Doing
    target: str
    level: str | None = None
    length: float | None = None
    named: str | None = None


@dataclass(frozen=True)
class Fault:
    """A rule that a round breaks.

    Args:
        step: counted from 1; None for the round as a whole.
        text: what is wrong.
    """

    step: int | None
    text: str


def moves_of(planned: Round) -> tuple[Move, ...]:
    """The steps of a round without what is only told."""
    return tuple(Move(step.do, step.target, step.level, step.length) for step in planned.steps)


def check_round(known: Survey, planned: Round) -> tuple[Fault, ...]:
    """Plays a round through.

    Args:
        known: what was looked up for its goals.
        planned: the round.

    Returns:
        The rules that it breaks; empty where it keeps them all.
    """
    return check_moves(known, planned.goals, moves_of(planned), planned.length)


def check_moves(
    known: Survey, goals: Sequence[Goal], moves: Sequence[Move], length: float | None = None
) -> tuple[Fault, ...]:
    """Plays steps through that anybody may have written.

    After a fault it goes on as if the step had been right, so that one mistake isn't told many times.

    Args:
        known: what was looked up for the goals.
        goals: what is asked.
        moves: the steps.
        length: of the whole [m], as it is said to be; None where it isn't said.

    Returns:
        The rules that the steps break, in order.
    """
    game = _Game(known, goals)
    for number, move in enumerate(moves, start=1):
        game.number = number
        game.play(move)
    game.number = None
    game.finish(length)
    return tuple(game.faults)


@dataclass
class _Game:
    """Where one is, and what has been done.

    Args:
        known: stops and ways.
        goals: all goals.
    """

    known: Survey
    goals: Sequence[Goal]
    number: int | None = None
    faults: list[Fault] = field(default_factory=list)
    off: dict[str, bool] = field(default_factory=dict)
    set_up: set[str] = field(default_factory=set)
    done: set[Goal] = field(default_factory=set)
    walked: float = 0.0

    def __post_init__(self) -> None:
        self.here = self.known.start
        off = off_before(self.goals)
        self.off |= {goal.unit: goal.unit in off for goal in self.goals if goal.turns}

    def play(self, move: Move) -> None:
        """One step."""
        if move.named not in (None, move.target):
            self._wrong(f"it names {move.named}, but is at {self._name(move.target)}")
        if move.do == "walk":
            self._walk(move)
        elif move.do == "climb":
            self._climb(move)
        elif move.do == "set up":
            if (stop := self._standing_at(move)) is not None:
                self.set_up.add(stop.unit.id)
        else:
            self._act(move)

    def finish(self, length: float | None) -> None:
        """What must be so at the end."""
        for goal in self.goals:
            if goal not in self.done:
                self._wrong(f"{goal.name} is not {goal.verb.past}")
        start = self.known.start
        if start.point is None:
            if self.here.level != start.level:
                self._wrong(f"it ends on {self._level(self.here)}, not on the ground")
        elif self.here != start:
            self._wrong(f"it does not end where it begins, at {self._name(start.name)}")
        if length is not None and _shorter(length, self.walked):
            self._wrong(
                f"it says that it is {length:.2f} m long, which is less than its steps take: {self.walked:.2f} m"
            )

    def _walk(self, move: Move) -> None:
        spot = self._spot(move.target)
        if spot is None:
            self._wrong(f"nothing to walk to is called {move.target!r} here")
            return
        if spot.level != self.here.level:
            self._wrong(
                f"{self._name(move.target)} is on {self._level(spot)}, one stands on {self._level(self.here)}: "
                "climb before walking there"
            )
            self.here = spot
            return
        self._go(spot, self.known.walks.on_level(self.here, spot).length, move)

    def _climb(self, move: Move) -> None:
        way = self.known.terrain.ways.get(move.target)
        if way is None:
            self._wrong(f"no way up is called {move.target!r}")
            return
        others = [end for end in way.ends if end != self.here and move.level in (None, end.level)]
        if self.here not in way.ends:
            self._wrong(f"one is not at an end of {move.target}: walk there before climbing")
            self.here = others[-1] if others else self.here
        elif len(others) != 1:
            self._wrong(f"{move.target} leads to {len(others)} such levels from here: say to which level one climbs")
        else:
            self._go(others[0], self.known.walks.climb(self.here, others[0]).length, move)

    def _go(self, spot: Spot, least: float, move: Move) -> None:
        if move.length is not None and _shorter(move.length, least):
            self._wrong(f"it says {move.length:.2f} m to {self._name(move.target)}, but that takes {least:.2f} m")
        # A longer way than the shortest is one's own choice.
        self.walked += max(least, move.length or 0.0)
        self.here = spot

    def _act(self, move: Move) -> None:
        stop = self._standing_at(move)
        if stop is None:
            return
        name = self._name(move.target)
        asked = [goal for goal in self.goals if (goal.action, goal.unit) == (move.do, move.target)]
        goal = min((goal for goal in asked if goal not in self.done), key=lambda goal: goal.stage, default=None)
        if goal is None:
            self._wrong(f"{name}: to {move.do} it {'again' if asked else ''} is not asked".replace("  ", " "))
            return
        for other in self.goals:
            if other.stage < goal.stage and other not in self.done:
                self._wrong(f"{move.do} {name} comes before {other.action} {other.name}, which is asked to come first")
        if stop.aid is not None and move.target not in self.set_up:
            self._wrong(f"{name} takes a ladder or lift, which was not set up: {stop.aid}")
        if goal.verb.off is not None:
            if self.off.get(move.target) is goal.verb.off:
                self._wrong(f"{name} is {goal.verb.state} already")
            self.off[move.target] = goal.verb.off
        self.done.add(goal)

    def _standing_at(self, move: Move) -> Stop | None:
        """The stop of the unit of a step, if there is one; told where one doesn't stand there."""
        stop = self._stop(move.target)
        if stop is None:
            self._wrong(f"no unit is called {move.target!r}")
        elif self.here != stop.spot:
            self._wrong(f"one does not stand at {self._name(move.target)}: walk there before")
            self.here = stop.spot
        return stop

    def _stop(self, unit: str) -> Stop | None:
        if unit in self.known.stops:
            return self.known.stops[unit]
        node = self.known.network.graph.nodes.get(unit)
        return self.known.terrain.stop(node) if isinstance(node, Unit) else None

    def _spot(self, target: str) -> Spot | None:
        """Where a walk to a unit or a way leads: of a way to its end on this level, else to its lowest."""
        way = self.known.terrain.ways.get(target)
        if way is not None:
            return next((end for end in way.ends if end.level == self.here.level), way.ends[0])
        stop = self._stop(target)
        return stop.spot if stop is not None else None

    def _name(self, place: str) -> str:
        return self.known.network.name(place) if place in self.known.network.places else place

    def _level(self, spot: Spot) -> str:
        return f"the {self.known.terrain.name(spot.level)}"

    def _wrong(self, text: str) -> None:
        self.faults.append(Fault(self.number, text))


def _shorter(said: float, least: float) -> bool:
    share, rounding = _LESS
    return said < least - max(rounding, share * least)
