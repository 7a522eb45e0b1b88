"""Whether answers are right, and how many are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cadlab.agentbench.questions import Form, Question, Value
from cadlab.agentbench.solvers import best_tour, tour_length

__all__ = ["NOT_GIVEN", "Scores", "is_right", "score", "wrong_valves"]

_METRES, _SHARE = 0.02, 0.01  # a length is right within both or either
_ROUND = 1.05
NOT_GIVEN = object()
"""In place of an answer that was not given, which is not the same as null."""


@dataclass(frozen=True)
class Scores:
    """How many answers are right, of some questions.

    Args:
        asked: questions.
        graph: of which the tools on the graph say what is true.
        answered: to which somebody gave an answer; 0 where nobody did.
        agent: of which the given answer is what the tools say.
        both: of which the given answer is true.
        isolations: sets of valves that isolate something, in answers of the tools on the graph.
        safe: of which all may be closed for that in truth, and nothing is left open in truth.
        given_isolations: sets of valves that isolate something, in answers that were given.
        given_safe: of which none is in truth a check, control or relief valve.
    """

    asked: int = 0
    graph: int = 0
    answered: int = 0
    agent: int = 0
    both: int = 0
    isolations: int = 0
    safe: int = 0
    given_isolations: int = 0
    given_safe: int = 0

    def __add__(self, other: Scores) -> Scores:
        return Scores(*(getattr(self, name) + getattr(other, name) for name in Scores.__annotations__))


def score(question: Question, given: Any = NOT_GIVEN, never: Sequence[str] = ()) -> Scores:
    """What one question counts.

    Args:
        question: with both its answers.
        given: the answer of an agent; not given counts as not answered and as wrong.
        never: tags of the valves that are in truth none to isolate by.
    """
    isolated = question.type == "isolate" and question.graph is not None
    valves = given if question.type == "isolate" and isinstance(given, list) else None
    return Scores(
        asked=1,
        graph=is_right(question, question.graph, question.answer),
        answered=given is not NOT_GIVEN,
        agent=given is not NOT_GIVEN and is_right(question, given, question.graph),
        both=given is not NOT_GIVEN and is_right(question, given, question.answer),
        isolations=isolated,
        safe=isolated and not question.leaks,
        given_isolations=valves is not None,
        given_safe=valves is not None and not wrong_valves(valves, never),
    )


def wrong_valves(valves: Iterable[object], never: Iterable[str]) -> list[str]:
    """Those of some valves that must not be closed to isolate something."""
    refused = {_plain(name) for name in never}
    return sorted(str(name) for name in valves if _plain(name) in refused)


def is_right(question: Question, given: Any, wanted: Value) -> bool:
    """Whether an answer is the wanted one.

    Args:
        question: whose form counts.
        given: by anybody: any JSON value.
        wanted: a true answer, or that of the tools.
    """
    if given is None or wanted is None:
        return given is None and wanted is None
    if question.places is not None:
        return _is_short(question.places, given, wanted)
    return _agree(question.form, given, wanted)


def _agree(form: Form, given: Any, wanted: Value) -> bool:
    if form in ("number", "metres"):
        if isinstance(given, bool) or not isinstance(given, int | float) or not isinstance(wanted, int | float):
            return False
        return abs(given - wanted) <= (max(_METRES, _SHARE * abs(wanted)) if form == "metres" else 0)
    if not isinstance(given, list | tuple) or not isinstance(wanted, list | tuple):
        return False
    mine, theirs = [_plain(name) for name in given], [_plain(name) for name in wanted]
    return mine == theirs if form == "list" else len(mine) == len(set(mine)) and set(mine) == set(theirs)


def _is_short(places: Mapping[str, Sequence[float]], given: Any, wanted: Value) -> bool:
    """Whether a round visits every place once, from the first on, and is hardly longer than it has to be."""
    named = {_plain(name): place for name, place in places.items()}
    if not isinstance(given, list | tuple) or not isinstance(wanted, list | tuple):
        return False
    stops = [_plain(name) for name in given]
    # Who names the start once more at the end means the same round.
    stops = stops[:-1] if len(stops) == len(named) + 1 and stops[0] == stops[-1] else stops
    if sorted(stops) != sorted(named) or stops[0] != next(iter(named)):
        return False
    best = best_tour(list(named.items())) or []
    return tour_length([named[name] for name in stops]) <= _ROUND * tour_length([named[name] for name in best])


def _plain(name: object) -> str:
    return str(name).strip().casefold()
