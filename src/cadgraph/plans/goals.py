"""What a round is for: gauges to read, valves to close and to open, pumps to stop and to start, in words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, get_args

from cadgraph._io.text import printable, shortened
from cadgraph.errors import AskError
from cadgraph.model.records import Node, Unit

__all__ = ["MOST_GOALS", "OFF", "PAST", "STATES", "Action", "Goal", "goals_text", "parse_goals", "shown"]

Action = Literal["read", "close", "open", "stop", "start"]

MOST_GOALS = 200
"""Most goals of a round; the order of more is not looked for."""

PAST: Mapping[Action, str] = {
    "read": "read",
    "close": "closed",
    "open": "opened",
    "stop": "stopped",
    "start": "started",
}
"""What is done of each goal, once it is done."""

OFF: Mapping[Action, bool] = {"close": True, "open": False, "stop": True, "start": False}
"""Whether what is turned is off after it: a valve shut, a pump stopped."""

STATES: Mapping[Action, str] = {"close": "closed", "open": "open", "stop": "stopped", "start": "running"}
"""What it is after it."""

_EXAMPLE = "as in 'read G-003, G-007; stop P-001; close V-002'"
_BACK: Mapping[Action, Action] = {"close": "open", "open": "close", "stop": "start", "start": "stop"}
_VERBS = "read, close, open, stop or start"
_PLAIN = re.compile(r"[\w.+#/-]+")
_DONE_AT = {"read": "gauge", "close": "valve", "open": "valve", "stop": "pump", "start": "pump"}
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
                raise AskError(f"{shown(words[0])!r} is no verb; begin with {_VERBS}, {_EXAMPLE}")
            if not name:
                raise AskError(f"{action} what? Name a {_DONE_AT[action]}, {_EXAMPLE}")
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
    wanted = _DONE_AT[action]
    if not isinstance(node, Unit) or node.unit_type != wanted:
        what = (node.kind or node.unit_type) if isinstance(node, Unit) else node.layer
        raise AskError(f"{name} is a {shown(what)}, and only a {wanted} can be {PAST[action]}")
    kind = (node.kind or "").casefold()
    for word, why in _NOT_BY_HAND:
        if action != "read" and word in kind:
            raise AskError(f"{name} is a {shown(kind)}, which {why}; leave it out, or correct what it is (--device)")
    return Goal(action, node.id, name, stage)


def _check(goals: list[Goal]) -> None:
    if not goals:
        raise AskError(f"no goals; say what to {_VERBS}, {_EXAMPLE}")
    if len(goals) > MOST_GOALS:
        raise AskError(f"{len(goals)} goals; at most {MOST_GOALS} go into a round, ask for several")
    done: dict[tuple[str, int], Goal] = {}
    for goal in goals:
        other = done.setdefault((goal.unit, goal.stage), goal)
        if other.action != goal.action:
            raise AskError(
                f"{goal.name} is to be {PAST[other.action]} and {PAST[goal.action]} in any order; put a semicolon "
                f"between, as in '{other.action} {goal.name}; {goal.action} {goal.name}'"
            )
    state: dict[str, Goal] = {}
    for goal in goals:
        if goal.action == "read":
            continue
        last = state.get(goal.unit)
        if last is not None and last.action == goal.action:
            raise AskError(
                f"{goal.name} is to be {PAST[goal.action]} twice without being {PAST[_BACK[goal.action]]} between"
            )
        state[goal.unit] = goal


def shown(text: str, most: int = 80) -> str:
    """A name from a graph or a question on one line, cut to a length."""
    return shortened(" ".join(printable(text[: 8 * most]).split()), most)
