"""Putting the questions of a set to a model, one after another, each in a conversation of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from cadgraph._io.progress import Progress, quiet
from cadgraph.agents.ask import Limits, Model, ask
from cadgraph.agents.plant import Plant
from cadgraph.errors import AskError, CadGraphError
from cadgraph.labelers.lvlm.price import Price
from cadlab.agentbench.question_file import QuestionSet, write_answers
from cadlab.agentbench.questions import GUIDE, Question

__all__ = ["Ask", "ModelAsked", "prompt_of", "run_questions"]

Ask = Callable[[Plant, str], Any]
"""Asks something about a plant and returns the answer as a plain JSON value, None where it is unknown."""

_IN_A_ROW = 3  # questions without an answer after which a model can't be asked at all


class ModelAsked:
    """A language model with the tools; counts what it takes.

    Args:
        model: that is asked.
        limits: of each question in steps and tokens, of all together in cost.
        price: of the model; needed for a limit on cost.
    """

    def __init__(self, model: Model, limits: Limits | None = None, price: Price | None = None) -> None:
        self._model, self._limits, self._price = model, limits or Limits(), price
        self.asked = self.calls = self.prompt_tokens = self.answer_tokens = 0
        self.cost: float | None = 0.0 if price is not None else None

    def __call__(self, plant: Plant, question: str) -> Any:
        """The value of the model's answer.

        Raises:
            CadGraphError: it gave none, or the limit on cost is reached.
        """
        limits, left = self._limits, self.left
        if left is not None:
            if left <= 0:
                raise AskError(f"the limit of ${limits.cost:g} is reached (--max-cost)")
            limits = replace(limits, cost=left)
        told = ask(plant, question, self._model, limits, price=self._price)
        self.asked += 1
        self.calls += len(told.calls)
        self.prompt_tokens += told.prompt_tokens
        self.answer_tokens += told.answer_tokens
        if self.cost is not None:
            self.cost += told.cost or 0.0
        return told.value

    @property
    def left(self) -> float | None:
        """US dollars that may still be spent; None where that isn't limited."""
        return None if self._limits.cost is None else self._limits.cost - (self.cost or 0.0)

    def tally(self) -> str:
        """What it took, in words."""
        cost = "" if self.cost is None else f", ${self.cost:.4f}"
        return f"{self.asked} answers, {self.calls} calls, {self.prompt_tokens:,} + {self.answer_tokens:,} tokens{cost}"


def prompt_of(question: Question) -> str:
    """What a model is asked: the guide and the question with the form of its answer."""
    return f'{GUIDE}\nQuestion (the value of the answer is a "{question.form}"): {question.text}'


def run_questions(
    questions: QuestionSet,
    plants: Path,
    asked: Ask,
    output: Path,
    *,
    known: Mapping[str, Any] | None = None,
    most: int | None = None,
    progress: Progress = quiet,
) -> dict[str, Any]:
    """Puts questions to a model and keeps its answers, after each of them.

    Args:
        questions: of a set.
        plants: folder with a folder for each plant, as the set was made.
        asked: the model.
        output: file of answers that is written.
        known: answers that need not be asked for again.
        most: questions that are asked at most; all if None.
        progress: called with the id of a question and the share of all that is done.

    Returns:
        All answers by id of the question; one to which no answer came is left out.

    Raises:
        FormatError: the graph of a plant is missing.
        CadGraphError: no answer came to several questions in a row; what was answered before stands in the file.
    """
    answers = dict(known or {})
    open_ones = [question for question in questions.questions if question.id not in answers][:most]
    opened: dict[str, Plant] = {}
    failed = 0
    for number, question in enumerate(open_ones):
        progress(question.id, number / len(open_ones))
        if question.plant not in opened:
            # One at a time: a plant takes memory, and questions about one stand together.
            opened = {question.plant: Plant.open(plants / question.plant)}
        try:
            answers[question.id] = asked(opened[question.plant], prompt_of(question))
        except CadGraphError:
            failed += 1
            if failed == _IN_A_ROW:
                raise
            continue
        failed = 0
        write_answers(output, answers)
    write_answers(output, answers)
    progress("done", 1.0)
    return answers
