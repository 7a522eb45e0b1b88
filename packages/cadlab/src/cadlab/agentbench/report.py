"""The table of a set: graph against truth, and an agent against both, for each type of question."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from cadlab.agentbench.question_file import QuestionSet
from cadlab.agentbench.questions import TYPES, Question
from cadlab.agentbench.score import NOT_GIVEN, Scores, is_right, score
from cadlab.markdown import table

__all__ = ["misses", "scores_of", "to_json", "to_markdown"]

Given = Mapping[str, Any]
_ALL = "all"


def scores_of(questions: QuestionSet, given: Given | None = None) -> dict[tuple[str, str], Scores]:
    """The scores by type of question and labels; of all types under ``all``.

    Args:
        questions: of a set.
        given: an agent's answers by id of the question; None where there is no agent.
    """
    plants = {plant.name: plant for plant in questions.plants}
    found: dict[tuple[str, str], Scores] = {}
    for question in questions.questions:
        plant = plants[question.plant]
        answer = NOT_GIVEN if given is None else given.get(question.id, NOT_GIVEN)
        counted = score(question, answer, plant.never)
        for name in (question.type, _ALL):
            key = (name, plant.labels)
            found[key] = found.get(key, Scores()) + counted
    return found


def to_markdown(questions: QuestionSet, given: Given | None = None) -> str:
    """The table: right ones of all, by type and labels."""
    found = scores_of(questions, given)
    labels = list(dict.fromkeys(plant.labels for plant in questions.plants))
    columns = ["graph"] if given is None else ["graph", "agent", "both"]
    heads = ["questions", *(f"{column}, {label} labels" for label in labels for column in columns)]
    rows = []
    for name in [*(type_.name for type_ in TYPES), _ALL]:
        counted = [found.get((name, label), Scores()) for label in labels]
        if any(one.asked for one in counted):
            cells = [_share(getattr(one, column), one.asked) for one in counted for column in columns]
            rows.append([f"**{name}**" if name == _ALL else name, *cells])
    lines = table(heads, rows, numbers=True)
    lines += ["", "graph: the tools on the graph against the truth."]
    if given is not None:
        lines += ["agent: the answers given, against the tools on the graph; both: against the truth.", ""]
        lines.append(f"{sum(one.answered for (name, _), one in found.items() if name == _ALL)} answers were given.")
    return "\n".join([*lines, "", *_safety(questions, found, given)])


def _safety(questions: QuestionSet, found: Mapping[tuple[str, str], Scores], given: Given | None) -> list[str]:
    lines = []
    for label in dict.fromkeys(plant.labels for plant in questions.plants):
        plants = [plant for plant in questions.plants if plant.labels == label]
        safe, n = sum(plant.safe for plant in plants), sum(plant.isolations for plant in plants)
        lines.append(
            f"- {label} labels: the graph says of {n} units which valves isolate them; {safe} of these sets "
            "hold in truth: no check, control or relief valve in them, nothing left open"
        )
        if given is not None:
            one = found.get(("isolate", label), Scores())
            lines.append(
                f"- {label} labels: {one.given_safe} of {one.given_isolations} sets of valves that were answered are "
                "free of check, control and relief valves"
            )
    return lines


def to_json(questions: QuestionSet, given: Given | None = None) -> dict[str, Any]:
    """The same as plain values."""
    found = scores_of(questions, given)
    rows = [
        {"type": name, "labels": label, **{key: getattr(one, key) for key in Scores.__annotations__}}
        for (name, label), one in found.items()
    ]
    return {"format": "cadgraph-agentbench-scores", "version": 1, "seed": questions.seed, "scores": rows}


def misses(questions: QuestionSet, given: Given | None = None) -> list[str]:
    """A paragraph for each question that the graph, or an agent, answers wrongly."""
    told = []
    for question in questions.questions:
        answer = NOT_GIVEN if given is None else given.get(question.id, NOT_GIVEN)
        wrong = answer is not NOT_GIVEN and not is_right(question, answer, question.answer)
        if wrong or not is_right(question, question.graph, question.answer) or question.leaks:
            told.append("\n".join(_miss(question, answer)))
    return told


def _miss(question: Question, answer: Any) -> Iterable[str]:
    yield f"{question.id}: {question.text}"
    yield f"  true   {json.dumps(question.answer, ensure_ascii=False)}"
    yield f"  graph  {json.dumps(question.graph, ensure_ascii=False)}"
    if answer is not NOT_GIVEN:
        yield f"  given  {json.dumps(answer, ensure_ascii=False)}"
    if question.leaks:
        yield f"  UNSAFE {json.dumps(list(question.leaks), ensure_ascii=False)}"


def _share(right: int, asked: int) -> str:
    return f"{right}/{asked}" if asked else ""
