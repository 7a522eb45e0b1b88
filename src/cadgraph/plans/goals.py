"""What a round is for: gauges to read, valves to close and to open, pumps to stop and to start, in words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, get_args

from cadgraph._io.text import printable, shortened
from cadgraph.errors import AskError
from cadgraph.model.records import Node, Unit

__all__ = ["MOST_GOALS", "VERBS", "Action", "Goal", "Verb", "goals_text", "parse_goals", "shown"]

Action = Literal["read", "close", "open", "stop", "start"]

MOST_GOALS = 200
"""Most goals of a round; the order of more is not looked for."""


@dataclass(frozen=True)
class Verb:
    """What can be done to a unit.

    Args:
        unit_type: that it is done to.
        past: what was done, once it is.
        off: whether the unit is off after it, a valve shut, a pump stopped; None where nothing is turned.
        state: what the unit is after it; ``""`` where nothing is turned.
        back: what undoes it; None likewise.
    """

    unit_type: str
    past: str
    off: bool | None = None
    state: str = ""
    back: Action | None = None


VERBS: Mapping[Action, Verb] = {
    "read": Verb("gauge", "read"),
    "close": Verb("valve", "closed", True, "closed", "open"),
    "open": Verb("valve", "opened", False, "open", "close"),
    "stop": Verb("pump", "stopped", True, "stopped", "start"),
    "start": Verb("pump", "started", False, "running", "stop"),
}
"""What each action is."""

_EXAMPLE = "as in 'read G-003, G-007; stop P-001; close V-002'"
_ANY = "read, close, open, stop or start"
_PLAIN = re.compile(r"[\w.+#/-]+")
# Valves that nobody turns: to ask for it is a mistake, of the one who asks or of a label.
_NOT_BY_HAND = (
    ("check", "closes and opens by itself, nobody turns it by hand"),
    ("relief", "must never be blocked, and opens by itself"),
    ("safety", "must never be blocked, and opens by itself"),
)


@dataclass(frozen=True)
class Goal:
    """One thing to be done.

    Args:
        action: what.
        unit: id of the gauge, valve or pump.
        name: its tag.
        stage: counted from 0; all goals of a stage are done before any of the next, in any order among themselves.
    """

    action: Action
    unit: str
    name: str
    stage: int = 0

    @property
    def verb(self) -> Verb:
        """What the action is."""
        return VERBS[self.action]

    @property
    def turns(self) -> bool:
        """Whether something is turned or switched, and not only read."""
        return self.verb.off is not None


def parse_goals(text: str, find: Callable[[str], Node]) -> tuple[Goal, ...]:
    """Goals from words: ``"read G-003, G-007; close V-002; open V-004"``.

    What stands before a semicolon is done before what stands behind it. Goals divided by commas may be done in any
    order. A verb holds until the next one.

    Args:
        text: what was asked.
        find: the node of a graph with a tag or id; raises where there is none.

    Returns:
        The goals as they stand there, without those that are said twice in a stage.

    Raises:
        CadGraphError: nothing is called so, the verb is none or not for such a unit (a gauge to be closed, a valve to
            be read), a valve to be closed and opened in the same stage or a pump stopped and started, or a check or
            relief valve to be turned by hand.
    """
    goals: list[Goal] = []
    action: Action | None = None
    stage = 0
    for part in text.split(";"):
        before = len(goals)
        for piece in re.split(r",|\s+and\s+", part):
            words = piece.split()
            if not words:
                continue
            said = _verb(words[0])
            action, name = (said, " ".join(words[1:])) if said is not None else (action, " ".join(words))
            if action is None:
                raise AskError(f"{shown(words[0])!r} is no verb; begin with {_ANY}, {_EXAMPLE}")
            if not name:
                raise AskError(f"{action} what? Name a {VERBS[action].unit_type}, {_EXAMPLE}")
            goal = _goal(action, name, find, stage)
            if goal not in goals:
                goals.append(goal)
        stage += len(goals) > before
    _check(goals)
    return tuple(goals)


def goals_text(goals: Iterable[Goal]) -> str:
    """Goals in the words that :func:`parse_goals` reads: with tags, or ids where a tag holds more than a word."""
    stages: dict[int, list[str]] = {}
    for goal in goals:
        name = goal.name if _PLAIN.fullmatch(goal.name) and _verb(goal.name) is None else goal.unit
        stages.setdefault(goal.stage, []).append(f"{goal.action} {name}")
    return "; ".join(", ".join(stages[stage]) for stage in sorted(stages))


def _verb(word: str) -> Action | None:
    return next((action for action in get_args(Action) if action == word.casefold().rstrip(":")), None)


def _goal(action: Action, name: str, find: Callable[[str], Node], stage: int) -> Goal:
    node = find(name)
    name = shown(node.tag if isinstance(node, Unit) else node.id)
    wanted = VERBS[action].unit_type
    if not isinstance(node, Unit) or node.unit_type != wanted:
        what = (node.kind or node.unit_type) if isinstance(node, Unit) else node.layer
        raise AskError(f"{name} is a {shown(what)}, and only a {wanted} can be {VERBS[action].past}")
    kind = (node.kind or "").casefold()
    for word, why in _NOT_BY_HAND:
        if action != "read" and word in kind:
            raise AskError(f"{name} is a {shown(kind)}, which {why}; leave it out, or correct what it is (--device)")
    return Goal(action, node.id, name, stage)


def _check(goals: list[Goal]) -> None:
    if not goals:
        raise AskError(f"no goals; say what to {_ANY}, {_EXAMPLE}")
    if len(goals) > MOST_GOALS:
        raise AskError(f"{len(goals)} goals; at most {MOST_GOALS} go into a round, ask for several")
    done: dict[tuple[str, int], Goal] = {}
    for goal in goals:
        other = done.setdefault((goal.unit, goal.stage), goal)
        if other.action != goal.action:
            raise AskError(
                f"{goal.name} is to be {other.verb.past} and {goal.verb.past} in any order; put a semicolon "
                f"between, as in '{other.action} {goal.name}; {goal.action} {goal.name}'"
            )
    state: dict[str, Goal] = {}
    for goal in goals:
        if goal.verb.back is None:
            continue
        last = state.get(goal.unit)
        if last is not None and last.action == goal.action:
            back = VERBS[goal.verb.back].past
            raise AskError(f"{goal.name} is to be {goal.verb.past} twice without being {back} between")
        state[goal.unit] = goal


def shown(text: str, most: int = 80) -> str:
    """A name from a graph or a question on one line, cut to a length."""
    return shortened(" ".join(printable(text[: 8 * most]).split()), most)
