"""A run of questions that survives: cached, budgeted, several at once, asked again once if an answer is no use."""

from __future__ import annotations

import hashlib
import json
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel

from cadgraph.labelers.lvlm.answer import Malformed, plain_words, read
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.folder import write_question
from cadgraph.labelers.lvlm.price import ANSWER_TOKENS, Estimate, Price, text_tokens
from cadgraph.labelers.lvlm.reply import Answerer, Question, Reply

__all__ = ["Asking", "Budget", "Outcome", "Tally", "key_of"]

_Model = TypeVar("_Model", bound=BaseModel)
_DRAWING = max(1, min(8, os.cpu_count() or 1))  # pictures drawn at a time: more would only fill memory


@dataclass(frozen=True)
class Budget:
    """What a whole run may use, answers from the cache included; so the same command gives the same labels.

    Args:
        questions: at most so many.
        cost: at most so many US dollars.
    """

    questions: int | None = None
    cost: float | None = None


@dataclass
class Tally:
    """What a run has used so far.

    Args:
        asked: questions sent in this run.
        known: answered by the cache.
        again: of all, those that were asked again because the first answer was no use.
        failed: without a usable answer.
        prompt_tokens: as the server counted, of all.
        answer_tokens: likewise.
        cost: of all, in US dollars; 0 without a price.
        spent: of those sent in this run.
        total: questions planned.
    """

    asked: int = 0
    known: int = 0
    again: int = 0
    failed: int = 0
    prompt_tokens: int = 0
    answer_tokens: int = 0
    cost: float = 0.0
    spent: float = 0.0
    total: int = 0


@dataclass(frozen=True)
class Outcome(Generic[_Model]):
    """What became of a question.

    Args:
        question: as it was asked last.
        answer: checked, or None.
        reason: why there is no answer, or None.
        waiting: whether it may still come another way.
    """

    question: Question
    answer: _Model | None
    reason: str | None = None
    waiting: bool = False


@dataclass
class Asking:
    """Sees questions through.

    Args:
        answerer: who is asked.
        cache: of answers.
        price: of the model, or None.
        budget: of the whole run.
        concurrency: questions at a time.
        detail: of the pictures.
        size: side of a picture [px].
        n_pictures: of a question.
        keep: where questions and replies are kept for audit, or None.
        note: called after each answer.
    """

    answerer: Answerer
    cache: Cache
    price: Price | None = None
    budget: Budget = Budget()
    concurrency: int = 8
    detail: str = "high"
    size: int = 512
    n_pictures: int = 6
    keep: Path | None = None
    note: Callable[[Tally], None] | None = None
    tally: Tally = field(default_factory=Tally)

    def __post_init__(self) -> None:
        self._lock = threading.Lock()
        self._drawing = threading.Semaphore(_DRAWING)
        self._tokens: dict[str, int] = {}
        self._used_questions = self._on_the_way = 0
        self._promised = 0.0

    def tokens(self, question: Question) -> int:
        """About how many tokens a question takes."""
        known = self._tokens.get(question.id)
        if known is not None:
            return known
        pictures = self.n_pictures * (self.price.image_tokens(self.size, self.size, self.detail) if self.price else 0.0)
        captions = 10 * self.n_pictures
        schema = text_tokens(json.dumps(question.schema)) // 2
        words = text_tokens(question.system) + text_tokens(question.text)
        self._tokens[question.id] = total = int(pictures + captions + words + schema)
        return total

    def cost(self, question: Question) -> float:
        """About what a question costs, in US dollars; 0 without a price."""
        return self.price.cost(self.tokens(question), ANSWER_TOKENS) if self.price else 0.0

    def within_budget(self, questions: Sequence[Question]) -> Sequence[Question]:
        """The first of these questions that what is left of the budget pays for."""
        cost = self.tally.cost
        kept: list[Question] = []
        for question in questions:
            cost += self.cost(question)
            if self.budget.cost is not None and cost > self.budget.cost:
                break
            if self.budget.questions is not None and self._used_questions + len(kept) >= self.budget.questions:
                break
            kept.append(question)
        return kept

    def estimate(self, questions: Sequence[Question], *, left_out: int = 0) -> Estimate:
        """What these questions will need; those that the cache answers cost nothing."""
        new = [
            question
            for question in questions
            if self.cache.get(key_of(question, self.answerer.name, self.detail)) is None
        ]
        tokens = [self.tokens(question) for question in new]
        total, answers = sum(tokens), ANSWER_TOKENS * len(tokens)
        cost = self.price.cost(total, answers) if self.price else None
        return Estimate(len(new), len(questions) - len(new), total, answers, cost, self.answerer.name, left_out)

    def ask_all(
        self, questions: Sequence[Question], model: type[_Model], again: Callable[[Question, str], Question]
    ) -> list[Outcome[_Model]]:
        """Asks, several at a time.

        Args:
            questions: within the budget.
            model: what answers must be.
            again: words a question anew after an answer that was no use, given why.

        Returns:
            Their outcomes, in the order of the questions.
        """
        self.tally.total += len(questions)
        outcomes: list[Outcome[_Model] | None] = [None] * len(questions)
        pool = ThreadPoolExecutor(max(1, self.concurrency))
        pending: dict[Future[Outcome[_Model]], int] = {}
        ahead = iter(enumerate(questions))
        try:
            for place, question in ahead:
                pending[pool.submit(self._one, question, model, again)] = place
                if len(pending) >= 2 * self.concurrency:
                    self._collect(pending, outcomes)
            while pending:
                self._collect(pending, outcomes)
        finally:
            # On Ctrl-C, or where it makes no sense to go on: what waits is dropped, what is kept stays kept.
            pool.shutdown(wait=True, cancel_futures=True)
        return [outcome for outcome in outcomes if outcome is not None]

    def _collect(self, pending: dict[Future[Outcome[_Model]], int], outcomes: list[Outcome[_Model] | None]) -> None:
        done, _ = wait(pending, return_when=FIRST_COMPLETED)
        for future in done:
            outcomes[pending.pop(future)] = future.result()
            if self.note is not None:
                self.note(replace(self.tally))

    def _one(
        self, question: Question, model: type[_Model], again: Callable[[Question, str], Question]
    ) -> Outcome[_Model]:
        reason = ""
        for attempt in (0, 1):
            asked = question if attempt == 0 else again(question, reason)
            if attempt and not self.answerer.again and self._cached(asked) is None:
                break
            reply = self._reply(asked)
            if reply.waiting:
                return Outcome(asked, None, "waiting for its answer", waiting=True)
            if reply.error is not None:
                return self._failed(asked, reply.error)
            if reply.refusal is not None:
                reason = f"the model refused: {plain_words(reply.refusal)[:120]}"
            else:
                try:
                    return Outcome(asked, read(reply.text, model))
                except Malformed as error:
                    reason = str(error)
            question = asked
            with self._lock:
                self.tally.again += attempt == 0
        return self._failed(question, f"no usable answer: {reason}")

    def _failed(self, question: Question, reason: str) -> Outcome[_Model]:
        with self._lock:
            self.tally.failed += 1
        return Outcome(question, None, reason)

    def _asked(self, question: Question) -> Reply:
        """Asks unless the budget is used up: an estimate may have been too low, and second tries come on top."""
        cost = self.cost(question)
        with self._lock:
            over = (
                self.budget.questions is not None and self._used_questions + self._on_the_way >= self.budget.questions
            )
            if self.budget.cost is not None and self.tally.cost + self._promised + cost > self.budget.cost:
                over = True
            if over:
                return Reply(None, error="not asked: the budget is used up")
            self._on_the_way += 1
            self._promised += cost
        reply: Reply | None = None
        try:
            reply = self.answerer.ask(question)
        finally:
            # In one step, or another question slips in between what is on the way and what is used.
            with self._lock:
                self._on_the_way -= 1
                self._promised -= cost
                self._used_questions += reply is not None and reply.error is None
        return reply

    def _cached(self, question: Question) -> Reply | None:
        return self.cache.get(key_of(question, self.answerer.name, self.detail))

    def _reply(self, question: Question) -> Reply:
        reply = self._cached(question)
        known = reply is not None
        if reply is None:
            # Drawing is the only part that takes memory and processors; answers are waited for outside.
            drawn = question
            if self.answerer.looks or self.keep is not None:
                with self._drawing:
                    drawn = _drawn(question)
            reply = self._asked(drawn)
            if self.answerer.keeps and reply.error is None and not reply.waiting:
                self.cache.put(key_of(question, self.answerer.name, self.detail), self.answerer.name, reply)
            if self.keep is not None:
                write_question(self.keep, drawn, reply=reply)
        cost = self.price.cost(reply.prompt_tokens, reply.answer_tokens, batch=reply.batch) if self.price else 0.0
        with self._lock:
            self._used_questions += known and reply.error is None
            self.tally.known += known
            self.tally.asked += not known and not reply.waiting and reply.error is None
            self.tally.prompt_tokens += reply.prompt_tokens
            self.tally.answer_tokens += reply.answer_tokens
            self.tally.cost += cost
            self.tally.spent += 0.0 if known else cost
        return reply


def key_of(question: Question, model: str, detail: str) -> str:
    """What the answer to a question is known by: its content, the model, and how closely it looks."""
    return hashlib.sha256(json.dumps([question.id, model, detail]).encode()).hexdigest()


def _drawn(question: Question) -> Question:
    """The same question with its pictures drawn, whoever wants them drawn again."""
    pictures = question.pictures()
    for picture in pictures:
        picture.draw()
    return replace(question, pictures=lambda: pictures)
