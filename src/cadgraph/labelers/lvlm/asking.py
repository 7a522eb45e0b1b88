"""A run of questions that survives: cached, budgeted, several at once, asked again once if an answer is no use."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel

from cadgraph.labelers.lvlm.answer import Malformed, plain_words, read
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.folder import some, write_question
from cadgraph.labelers.lvlm.manner import sent
from cadgraph.labelers.lvlm.price import ANSWER_TOKENS, Estimate, Price, question_tokens
from cadgraph.labelers.lvlm.profile import Profile
from cadgraph.labelers.lvlm.reply import Answerer, Hasty, Question, Reply, Watchful, key_of
from cadgraph.model.diagnostic import Diagnostic

__all__ = ["Asking", "Budget", "Outcome", "Tally"]

_Model = TypeVar("_Model", bound=BaseModel)
_MESSAGE = 400  # characters of a finding
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
        resumed: of all, those that an earlier run had sent without hearing of them again.
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
    resumed: int = 0


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
        model: whose answers the estimate counts on; the answerer's own name if empty.
        profile: what is known of the model and its server, for the estimate and the record of the run.
        answer: tokens that an answer may have.
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
    model: str = ""
    profile: Profile | None = None
    answer: int = 600
    tally: Tally = field(default_factory=Tally)

    def __post_init__(self) -> None:
        self._lock = threading.Lock()
        self._drawing = threading.Semaphore(_DRAWING)
        self._tokens: dict[str, int] = {}
        self._used_questions = self._on_the_way = 0
        self._promised = 0.0
        self._failures: list[tuple[str, Question]] = []

    def tokens(self, question: Question) -> int:
        """About how many tokens a question takes."""
        known = self._tokens.get(question.id)
        if known is not None:
            return known
        self._tokens[question.id] = total = self._words(question) + int(self._picture_tokens(question))
        return total

    def _words(self, question: Question) -> int:
        return question_tokens(question.system, question.text, question.schema, self.n_pictures)

    def _picture_tokens(self, question: Question) -> float:
        """As the profile counts them, where it does, or the price table."""
        if self.profile is not None and self.profile.tokens is not None:
            manner = replace(self.profile.manner, level=self._level(question))
            return self.profile.picture_tokens(self.n_pictures, self.size, manner)
        return self.n_pictures * (self.price.image_tokens(self.size, self.size, self.detail) if self.price else 0.0)

    def _level(self, question: Question) -> int:
        """How much smaller the pictures of a question are sent than they are drawn; see ``manner.LEVELS``."""
        if self.profile is None:
            return 0
        return self.profile.level(self._words(question), self.n_pictures, self.size, self.answer)

    def _shrunk(self, questions: Iterable[Question]) -> str:
        """What a small context costs, in words; empty where all pictures are sent as they are drawn."""
        level = max((self._level(question) for question in questions), default=0)
        if not level:
            return ""
        side, shown = sent(level, self.n_pictures)
        return (
            f"; its context has room for {shown} of {self.n_pictures} pictures at {side} px only: "
            "say how large it is with --set lvlm.context=N"
        )

    def cost(self, question: Question) -> float:
        """About what a question costs, in US dollars; 0 without a price."""
        return self.price.cost(self.tokens(question), ANSWER_TOKENS) if self.price else 0.0

    def within_budget(self, questions: Sequence[Question]) -> Sequence[Question]:
        """The first of these questions that what is left of the budget pays for."""
        cost = self.tally.cost
        kept: list[Question] = []
        ids: set[str] = set()
        for question in questions:
            if question.id not in ids:
                cost += self.cost(question)
                if self.budget.cost is not None and cost > self.budget.cost:
                    break
                if self.budget.questions is not None and self._used_questions + len(ids) >= self.budget.questions:
                    break
                ids.add(question.id)
            kept.append(question)
        return kept

    def estimate(self, questions: Sequence[Question], *, left_out: int = 0) -> Estimate:
        """What these questions will need; those that the cache answers cost nothing."""
        model = self.model or self.answerer.name
        keys = {key_of(question, model, self.detail): question for question in questions}
        known = self.cache.known(keys)
        tokens = [self.tokens(question) for key, question in keys.items() if key not in known]
        total, answers = sum(tokens), ANSWER_TOKENS * len(tokens)
        return Estimate(
            questions=len(tokens),
            known=len(keys) - len(tokens),
            prompt_tokens=total,
            answer_tokens=answers,
            cost=self.price.cost(total, answers) if self.price else None,
            model=model,
            left_out=left_out,
            resumed=len(self.cache.on_the_way(keys)),
            profile=self.profile.told + self._shrunk(keys.values()) if self.profile else "",
        )

    def ask_all(
        self, questions: Sequence[Question], model: type[_Model], again: Callable[[Question, str], Question]
    ) -> list[Outcome[_Model]]:
        """Asks, several at a time; what is asked twice in the same words and pictures is asked once.

        Args:
            questions: within the budget.
            model: what answers must be.
            again: words a question anew after an answer that was no use, given why.

        Returns:
            Their outcomes, in the order of the questions.
        """
        once = {question.id: question for question in reversed(questions)}
        if len(once) < len(questions):
            first = list(dict.fromkeys(question.id for question in questions))
            found = dict(zip(first, self.ask_all([once[each] for each in first], model, again), strict=True))
            return [found[question.id] for question in questions]
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
        except BaseException:
            if isinstance(self.answerer, Hasty):
                self.answerer.hurry()
            raise
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
            self._failures.append((reason, question))
        return Outcome(question, None, reason)

    def findings(self) -> tuple[Diagnostic, ...]:
        """What became of questions that failed, by name, and what whoever answers them has to say beside."""
        by_reason: dict[str, set[str]] = {}
        for reason, question in self._failures:
            by_reason.setdefault(reason, set()).add(question.called)
        found = []
        for reason, names in sorted(by_reason.items()):
            few = some(sorted(names), 3)
            n = len(names)
            found.append(Diagnostic("lvlm-failed", f"{n} question{'s' * (n != 1)} failed, {reason}: {few}"[:_MESSAGE]))
        if isinstance(self.answerer, Watchful):
            found += self.answerer.findings()
        return tuple(found)

    def record(self) -> dict[str, object]:
        """What a run's record says beside its questions: who was asked in which way."""
        return {
            "profile": self.profile.to_json() if self.profile else None,
            "manner": self.answerer.told() if isinstance(self.answerer, Hasty) else None,
            "sent_before_without_an_answer": self.tally.resumed,
        }

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
            reply = self._sent(question) if self.answerer.keeps else self.answerer.ask(question)
        finally:
            # In one step, or another question slips in between what is on the way and what is used.
            with self._lock:
                self._on_the_way -= 1
                self._promised -= cost
                self._used_questions += reply is not None and reply.error is None
        return reply

    def _sent(self, question: Question) -> Reply:
        """Asks, with a note in the cache from before the question leaves until its answer is kept."""
        key, name = key_of(question, self.answerer.name, self.detail), self.answerer.name
        with self._lock:
            self.tally.resumed += bool(self.cache.on_the_way([key]))
        self.cache.sending(key, name)
        reply: Reply | None = None
        try:
            reply = self.answerer.ask(question)
        finally:
            if reply is None or (reply.error is not None and not reply.lost):
                self.cache.settled(key)
        if reply.error is None and not reply.waiting:
            self.cache.put(key, name, reply)
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


def _drawn(question: Question) -> Question:
    """The same question with its pictures drawn, whoever wants them drawn again."""
    pictures = question.pictures()
    for picture in pictures:
        picture.draw()
    return replace(question, pictures=lambda: pictures)
