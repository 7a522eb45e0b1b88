"""Labels by a vision-language model, for the pipeline: alone, or where the embedded labeler is unsure."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from cadgraph._io.atomic import write_atomically
from cadgraph.errors import LabelError
from cadgraph.labelers.base import Labeler, Labeling
from cadgraph.labelers.lvlm.answer import Answer, Proposal, Verdict, answer_schema, settle
from cadgraph.labelers.lvlm.asking import Asking, Outcome, Tally
from cadgraph.labelers.lvlm.folder import write_index
from cadgraph.labelers.lvlm.gallery import Gallery
from cadgraph.labelers.lvlm.hint import Hints, neighbors_of
from cadgraph.labelers.lvlm.poll import Poll, poll
from cadgraph.labelers.lvlm.price import Estimate
from cadgraph.labelers.lvlm.prompt import Wording, label_text, system_text, version
from cadgraph.labelers.lvlm.question_groups import QuestionGroup, find_question_groups
from cadgraph.labelers.lvlm.repair import repair
from cadgraph.labelers.lvlm.reply import Question
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label, LvlmEvidence
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["LvlmLabeler", "Way"]

_AGAIN_FACTOR = 1.05  # a second answer with more context wins unless the first was clearly surer
_MESSAGE = 160


@dataclass(frozen=True)
class Way:
    """How parts are asked about.

    Args:
        ask: ``all`` parts, or where the embedded labeler is ``unsure``.
        per: one question for each ``shape`` and role, or for each ``part``.
        votes: members of a kind that are asked about.
        hints: whether prompts say what geometry knows.
        below: ``unsure`` asks where the embedded labeler's confidence is below.
        again_below: answers below this confidence are asked again with what geometry knows; 0: never.
        repair: whether sizes correct gaskets and flanges.
        paper: plain pictures as in the paper.
    """

    ask: Literal["all", "unsure"] = "all"
    per: Literal["shape", "part"] = "shape"
    votes: int = 1
    hints: bool = False
    below: float = 0.8
    again_below: float = 0.5
    repair: bool = True
    paper: bool = False


class LvlmLabeler:
    """Asks a model what parts are.

    Args:
        asking: who is asked, and within which budget.
        way: how.
        embedded: the labeler to begin with, for ``unsure`` and for hints; None for none.
        confirm: shown the estimate before the first question; the run stops where it says no.
        folder: where ``run.json``, ``proposals.json`` and the dry run's index go; None writes nothing.
        gallery: draws the pictures of a scene.

    Attributes:
        proposals: labels that the vocabulary doesn't hold, with how often.
        estimate: of the first round.
    """

    def __init__(
        self,
        asking: Asking,
        way: Way | None = None,
        *,
        embedded: Labeler | None = None,
        confirm: Callable[[Estimate], bool] = lambda _: True,
        folder: Path | None = None,
        gallery: Callable[[Parts], Gallery] | None = None,
    ) -> None:
        self.asking, self.way, self.embedded = asking, way or Way(), embedded
        self.proposals: Counter[tuple[str, str | None, str]] = Counter()
        self.estimate: Estimate | None = None
        self._confirm, self._folder = confirm, folder
        self._gallery = gallery or (lambda parts: Gallery(parts.scene, paper=self.way.paper, size=asking.size))

    @property
    def tally(self) -> Tally:
        """What the run has used."""
        return self.asking.tally

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts (see :class:`~cadgraph.labelers.base.Labeler`).

        Raises:
            LabelError: the estimate was declined, or nobody can be asked.
        """
        base: list[Label | None] = [None] * parts.n_parts
        if self.embedded is not None:
            base = list(self.embedded.label(parts, contacts, vocabulary).answers)
        round_ = _Round(self, parts, contacts, vocabulary, base)
        kinds = self._chosen(find_question_groups(parts, self.way.per), base, parts)
        planned = [round_.questions(kind) for kind in kinds]
        kept, left_out = self._paid(planned)
        self.estimate = self.asking.estimate([q for questions in kept for q in questions], left_out=left_out)
        if not self._confirm(self.estimate):
            raise LabelError("nothing was asked: the estimate was not confirmed")
        try:
            first = round_.ask(kinds[: len(kept)], kept)
            self._again(round_, first)
        finally:
            self.asking.answerer.close()
        labels = self._labels(round_, first, base)
        if self.way.repair:
            labels = repair(labels, parts, round_.near, vocabulary)
        return Labeling.judge(labels, diagnostics=self._report(round_, kinds, len(kept), first))

    def _chosen(
        self, kinds: Sequence[QuestionGroup], base: Sequence[Label | None], parts: Parts
    ) -> list[QuestionGroup]:
        """The kinds to ask about, those first where an answer is worth most: many parts, little known."""

        def doubt(kind: QuestionGroup) -> float:
            if self.way.ask == "all":
                return float(len(kind.parts))
            # The ground is found by its place, not by labels.
            own = [part for part in kind.parts if not parts.ground[part]]
            known = [label.confidence if (label := base[part]) is not None else 0.0 for part in own]
            return sum(1 - c for c in known if c < self.way.below)

        worth = [(doubt(kind), kind) for kind in kinds]
        wanted = [(gain, kind) for gain, kind in worth if gain > 0]
        return [kind for _, kind in sorted(wanted, key=lambda row: (-round(row[0], 9), row[1].parts[0]))]

    def _paid(self, planned: Sequence[list[Question]]) -> tuple[list[list[Question]], int]:
        """Whole kinds that the budget pays for, and how many questions it leaves out."""
        flat = [question for questions in planned for question in questions]
        room = len(self.asking.within_budget(flat))
        kept: list[list[Question]] = []
        used = 0
        for questions in planned:
            if used + len(questions) > room:
                break
            kept.append(questions)
            used += len(questions)
        return kept, len(flat) - used

    def _again(self, round_: _Round, polls: dict[int, _Settled]) -> None:
        """Asks again about kinds whose answer is unsure, with what geometry and the first answers know."""
        if not self.asking.answerer.again or self.way.again_below <= 0:
            return
        unsure = [i for i, each in polls.items() if each.poll.votes and each.poll.confidence < self.way.again_below]
        if not unsure:
            return
        labels = self._labels(round_, polls, round_.base)
        unsure.sort(key=lambda i: (-len(polls[i].kind.parts), polls[i].kind.parts[0]))
        questions = [round_.again(polls[i], labels) for i in unsure]
        paid = self.asking.within_budget(questions)
        for i, outcome in zip(unsure, round_.send(paid), strict=False):
            round_.note(outcome)
            if outcome.answer is None:
                continue
            verdict = settle(outcome.answer, round_.vocabulary)
            before = polls[i]
            if verdict.group is not None and verdict.confidence * _AGAIN_FACTOR >= before.poll.confidence:
                votes = (*before.poll.votes, f"{verdict.group}: {verdict.name or '?'}")
                settled = Poll(verdict.group, verdict.name, verdict.confidence, votes)
                polls[i] = _Settled(before.kind, settled, outcome.question, verdict.seen, again=True)

    def _labels(
        self, round_: _Round, polls: Mapping[int, _Settled], base: Sequence[Label | None]
    ) -> list[Label | None]:
        labels = list(base)
        for each in polls.values():
            if each.poll.group is None:
                continue
            evidence = LvlmEvidence(
                model=self.asking.answerer.name,
                prompt=each.question.prompt,
                question=each.question.id,
                asked=round_.parts.scene.paths[each.question.part],
                repeats=len(each.kind.parts),
                votes=each.poll.votes,
                seen=each.seen,
                again=True if each.again else None,
            )
            label = Label(each.poll.group, each.poll.name, each.poll.confidence, "lvlm", evidence)
            for part in each.kind.parts:
                labels[part] = _joined(base[part], label, self.way)
        return labels

    def _report(
        self, round_: _Round, kinds: Sequence[QuestionGroup], n_asked: int, polls: Mapping[int, _Settled]
    ) -> tuple[Diagnostic, ...]:
        """What has no answer, and what was proposed; the files of the run are written."""
        paths = round_.parts.scene.paths
        diagnostics = []
        by_reason: dict[str, list[str]] = {}
        for reason, kind in round_.unanswered:
            by_reason.setdefault(reason, []).extend(paths[part] for part in kind.parts)
        for reason, meshes in sorted(by_reason.items()):
            message = f"{len(meshes)} parts have no answer of the vision-language model: {reason}"
            diagnostics.append(Diagnostic("lvlm-unanswered", message[:_MESSAGE], tuple(meshes)))
        rest = [paths[part] for kind in kinds[n_asked:] for part in kind.parts]
        if rest:
            message = f"{len(rest)} parts were not asked about: the budget was used where it helps more"
            diagnostics.append(Diagnostic("lvlm-budget", message, tuple(rest)))
        if self.proposals:
            shown = ", ".join(f"{g}: {n}" for g, n, _ in sorted(self.proposals, key=str)[:5])
            message = f"{len(self.proposals)} labels outside the vocabulary were proposed ({shown}...)"
            diagnostics.append(Diagnostic("lvlm-proposals", message[:_MESSAGE]))
        if self._folder is not None:
            self._write(round_, polls)
        return tuple(diagnostics)

    def _write(self, round_: _Round, polls: Mapping[int, _Settled]) -> None:
        if self._folder is None or self.estimate is None:
            return
        tally = self.tally
        record = {
            "model": self.asking.answerer.name,
            "prompt": version("label"),
            "kinds": len(polls),
            "asked": tally.asked,
            "from_cache": tally.known,
            "asked_again_for_form": tally.again,
            "failed": tally.failed,
            "prompt_tokens": tally.prompt_tokens,
            "answer_tokens": tally.answer_tokens,
            "cost_usd": round(tally.cost, 6) if self.asking.price else None,
            "spent_now_usd": round(tally.spent, 6) if self.asking.price else None,
            "estimated_usd": self.estimate.cost,
        }
        write_atomically(self._folder / "run.json", json.dumps(record, indent=1) + "\n")
        rows = [
            {"group": group, "name": name, "reason": reason, "times": times, "source": self.asking.answerer.name}
            for (group, name, reason), times in sorted(self.proposals.items(), key=str)
        ]
        if rows:
            content = {"format": "cadgraph-proposals", "version": 1, "labels": rows}
            write_atomically(self._folder / "proposals.json", json.dumps(content, ensure_ascii=False, indent=1) + "\n")
        if not self.asking.answerer.keeps and self.asking.answerer.name != "folder":
            paths = round_.parts.scene.paths
            write_index(
                self._folder / "questions",
                [(each.question.id, [paths[part] for part in each.kind.parts]) for each in polls.values()],
            )


@dataclass(frozen=True)
class _Settled:
    kind: QuestionGroup
    poll: Poll
    question: Question
    seen: str
    again: bool = False


class _Round:
    """What the questions about one scene have in common."""

    def __init__(
        self, labeler: LvlmLabeler, parts: Parts, contacts: Contacts, vocabulary: Vocabulary,
        base: Sequence[Label | None],
    ) -> None:  # fmt: skip
        self.parts, self.vocabulary, self.base = parts, vocabulary, base
        self.near = neighbors_of(parts, contacts)
        self.unanswered: list[tuple[str, QuestionGroup]] = []
        self._labeler = labeler
        self._gallery = labeler._gallery(parts)
        self._hints = Hints(parts, self.near)
        self._schema = answer_schema(vocabulary)
        self._wordings: dict[str, Wording] = {}

    def questions(self, kind: QuestionGroup) -> list[Question]:
        """About the members that are voted on."""
        way = self._labeler.way
        found = []
        for part in kind.members(way.votes):
            hints = self._hints.lines(part, len(kind.parts), self.base) if way.hints else ()
            found.append(self._question(part, self._wording(part, hints)))
        return found

    def again(self, settled: _Settled, labels: Sequence[Label | None]) -> Question:
        """With more context."""
        part = settled.question.part
        before = settled.poll.name or settled.poll.group
        wording = self._wording(part, self._hints.lines(part, len(settled.kind.parts), labels))
        return self._question(part, replace(wording, before=before))

    def ask(self, kinds: Sequence[QuestionGroup], planned: Sequence[list[Question]]) -> dict[int, _Settled]:
        """What the model says of each kind."""
        outcomes = iter(self.send([question for questions in planned for question in questions]))
        settled: dict[int, _Settled] = {}
        for i, (kind, questions) in enumerate(zip(kinds, planned, strict=True)):
            verdicts: list[Verdict] = []
            asked, reason = questions[0], "it was not asked"
            for _ in questions:
                outcome = next(outcomes)
                self.note(outcome)
                if outcome.answer is not None:
                    asked = outcome.question if not verdicts else asked
                    verdicts.append(settle(outcome.answer, self.vocabulary))
                else:
                    reason = outcome.reason or reason
            if not verdicts:
                self.unanswered.append((reason, kind))
            result = poll(verdicts, len(questions))
            if verdicts and result.group is None:
                self.unanswered.append(("it named no label of the vocabulary", kind))
            seen = next((v.seen for v in verdicts if (v.group, v.name) == (result.group, result.name)), "")
            settled[i] = _Settled(kind, result, asked, seen)
        return settled

    def send(self, questions: Sequence[Question]) -> list[Outcome[Answer]]:
        """Asks."""
        return self._labeler.asking.ask_all(questions, Answer, self._reworded)

    def note(self, outcome: Outcome[Answer]) -> None:
        """Keeps what an answer proposes."""
        if outcome.answer is None:
            return
        proposal: Proposal | None = settle(outcome.answer, self.vocabulary).proposal
        if proposal is not None:
            known = next(
                (key for key in self._labeler.proposals if key[:2] == (proposal.group, proposal.name)),
                (proposal.group, proposal.name, proposal.reason),
            )
            self._labeler.proposals[known] += 1

    def _wording(self, part: int, hints: Sequence[str]) -> Wording:
        measured = self.parts.properties
        long, mid, thin = (float(x) for x in measured.obb_extents[part])
        height = float(measured.aabb[part, 1, 2] - measured.aabb[part, 0, 2])
        mark = self._gallery.mark.name
        return Wording((long, mid, thin), height, self.vocabulary, self._labeler.way.paper, hints, mark=mark)

    def _question(self, part: int, wording: Wording, attempt: int = 0) -> Question:
        question = Question(
            system=system_text(),
            text=label_text(wording),
            schema=self._schema,
            recipe=self._gallery.recipe(part),
            pictures=lambda: self._gallery.pictures(part),
            prompt=version("label"),
            part=part,
            attempt=attempt,
        )
        self._wordings[question.id] = wording
        return question

    def _reworded(self, question: Question, reason: str) -> Question:
        return self._question(question.part, replace(self._wordings[question.id], again=reason), 1)


def _joined(base: Label | None, answer: Label, way: Way) -> Label:
    """The surer of two labels; where both agree on the group only, the group stays and the surer name."""
    if base is None or way.ask == "all":
        return answer
    if base.confidence >= way.below:
        return base
    if base.group == answer.group and (answer.name is None or base.name == answer.name):
        # Two that come to the same by different means are surer than either.
        together = 1 - (1 - base.confidence) * (1 - answer.confidence)
        return answer.model_copy(update={"name": base.name or answer.name, "confidence": min(together, 0.99)})
    return answer if answer.confidence > base.confidence else base
