"""Labels by a vision-language model, for the pipeline: alone, or where the embedded labeler is unsure."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from cadgraph._io.atomic import write_atomically
from cadgraph.errors import LabelError
from cadgraph.labelers.base import LEAST_CONFIDENCE, Labeler, Labeling
from cadgraph.labelers.lvlm.answer import Answer, Proposal, Verdict, answer_schema, settle
from cadgraph.labelers.lvlm.asking import Asking, Outcome, Tally
from cadgraph.labelers.lvlm.choosing import choose, in_stages
from cadgraph.labelers.lvlm.folder import write_index
from cadgraph.labelers.lvlm.gallery import Gallery
from cadgraph.labelers.lvlm.hint import Hints, neighbors_of
from cadgraph.labelers.lvlm.joining import Accuracy, Beliefs
from cadgraph.labelers.lvlm.price import Estimate
from cadgraph.labelers.lvlm.prompt import Wording, label_text, system_text, version
from cadgraph.labelers.lvlm.question_groups import QuestionGroup, find_question_groups
from cadgraph.labelers.lvlm.repair import repair
from cadgraph.labelers.lvlm.reply import Question
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label, LvlmEvidence
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["LvlmLabeler", "Way"]

_Planned = Mapping[QuestionGroup, list[Question]]
"""What is to be asked about each kind, in this order."""

_MESSAGE = 160
_SURE = 0.8  # a label is sure from this confidence on, where no labeler says its own


@dataclass(frozen=True)
class Way:
    """How parts are asked about.

    Args:
        ask: ``all`` parts, or where the embedded labeler is ``unsure``.
        per: one question for each ``shape`` and role, or for each ``part``.
        votes: members of a kind that are asked about.
        hints: whether prompts say what geometry knows.
        staged: whether small parts are asked about after large ones, with the labels of what they touch.
        below: ``unsure`` asks where the embedded labeler's confidence is below.
        again_below: answers below this confidence are asked again with what geometry knows; 0: never.
        repair: whether sizes correct gaskets and flanges.
        paper: plain pictures as in the paper.
    """

    ask: Literal["all", "unsure"] = "all"
    per: Literal["shape", "part"] = "shape"
    votes: int = 1
    hints: bool = False
    staged: bool = True
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
        accuracy: how often the answers are right; what is usual if None.
        only_asks: whether no answer can come in this run: a dry run, or requests for a batch.
        only: ids of the questions that somebody was asked, to whom this run leaves all others; None asks all.

    Attributes:
        former: gives the labels of a finished graph, which parts without an answer keep; None for none.
        contradictions: says at which parts the network contradicts labels; None for nobody.
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
        accuracy: Accuracy | None = None,
        only_asks: bool = False,
        only: Collection[str] | None = None,
    ) -> None:
        self.asking, self.way, self.embedded = asking, way or Way(), embedded
        self.proposals: Counter[tuple[str, str | None, str]] = Counter()
        self.estimate: Estimate | None = None
        self.accuracy, self.only_asks = accuracy or Accuracy(), only_asks
        self.former: Labeler | None = None
        self.contradictions: Callable[[Sequence[Label | None], Probabilities], Collection[int]] | None = None
        self._confirm, self._folder, self._only = confirm, folder, only
        self._gallery = gallery or (lambda parts: Gallery(parts.scene, paper=self.way.paper, size=asking.size))

    @property
    def tally(self) -> Tally:
        """What the run has used."""
        return self.asking.tally

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts (see :class:`~cadgraph.labelers.base.Labeler`).

        Raises:
            LabelError: the estimate was declined, nobody can be asked, or no question has an answer.
        """
        said = None if self.embedded is None else self.embedded.label(parts, contacts, vocabulary)
        former = None if self.former is None else self.former.label(parts, contacts, vocabulary)
        round_ = _Round(self, parts, contacts, vocabulary, said)
        below = None if self.way.ask == "all" else self.way.below
        kinds = choose(find_question_groups(parts, self.way.per), round_.base, parts, round_.near, vocabulary, below)
        planned, left_out = self._paid(self._wanted({kind: round_.questions(kind) for kind in kinds}))
        self.estimate = self.asking.estimate([q for each in planned.values() for q in each], left_out=left_out)
        if not self._confirm(self.estimate):
            raise LabelError("nothing was asked: the estimate was not confirmed")
        try:
            settled = self._ask(round_, planned)
            self._again(round_, settled)
            self._doubted(round_, settled)
        except BaseException as stop:
            if self.tally.asked:
                stop.add_note("the answers that came are kept, the same command goes on from there")
            raise
        finally:
            self.asking.answerer.close()
        self._refuse_silence(round_, settled)
        labels = round_.labels(settled, former)
        if self.way.repair:
            labels = repair(labels, parts, round_.near, vocabulary)
        diagnostics = self._report(round_, [kind for kind in kinds if kind not in planned], settled)
        thresholds = round_.thresholds(labels, settled)
        sure = _SURE if said is None else said.sure
        return Labeling.judge(labels, thresholds, round_.beliefs.probabilities(), diagnostics, sure)

    def _ask(self, round_: _Round, planned: _Planned) -> dict[QuestionGroup, _Settled]:
        """Large parts first; small ones then, with the labels of what they touch."""
        if not (self.way.staged and self.asking.answerer.again):
            return round_.ask(planned)
        large, small = in_stages(list(planned), round_.parts)
        settled = round_.ask({kind: planned[kind] for kind in large})
        labels = round_.labels(settled, None)
        return settled | round_.ask({kind: round_.questions(kind, labels) for kind in small})

    def _wanted(self, planned: _Planned) -> _Planned:
        """The kinds that somebody was asked about: a folder or its settings may name fewer than there are.

        Raises:
            LabelError: nobody was asked any of these questions.
        """
        if not self._only:
            return planned
        # An index names one question of each kind, also where several are voted on.
        found = {kind: each for kind, each in planned.items() if any(one.id in self._only for one in each)}
        if planned and not found:
            raise LabelError(
                f"none of the {len(self._only):,} questions there is one about this graph as it is set; "
                "write them anew with 'cadgraph ask-folder'"
            )
        return found

    def _paid(self, planned: _Planned) -> tuple[_Planned, int]:
        """Whole kinds that the budget pays for, and how many questions it leaves out."""
        flat = [question for questions in planned.values() for question in questions]
        room = len(self.asking.within_budget(flat))
        kept: dict[QuestionGroup, list[Question]] = {}
        used = 0
        for kind, questions in planned.items():
            if used + len(questions) > room:
                break
            kept[kind] = questions
            used += len(questions)
        return kept, len(flat) - used

    def _again(self, round_: _Round, settled: dict[QuestionGroup, _Settled]) -> None:
        """Asks again about kinds whose label is unsure, with what geometry and the first answers know."""
        if not self.asking.answerer.again or self.way.again_below <= 0:
            return
        unsure = [each for each in settled.values() if each.verdicts and self._is_unsure(round_, each)]
        unsure.sort(key=lambda each: (-len(each.kind.parts), each.kind.parts[0]))
        labels = round_.labels(settled, None)
        self._more(round_, settled, [(each, round_.again(each, labels)) for each in unsure])

    def _is_unsure(self, round_: _Round, settled: _Settled) -> bool:
        """Whether the label of a kind is, or the model itself is and nobody else knows better."""
        sureness = round_.beliefs.sureness(settled.kind.parts)
        own = max(verdict.confidence for verdict in settled.verdicts)
        return sureness < self.way.again_below or (own < self.way.again_below and sureness < self.way.below)

    def _doubted(self, round_: _Round, settled: dict[QuestionGroup, _Settled]) -> None:
        """Asks about parts at places where the network contradicts the labels: those that nobody was asked about."""
        if self.contradictions is None or not self.asking.answerer.again or self.way.ask == "all":
            return
        labels = round_.labels(settled, None)
        doubts = self.contradictions(labels, round_.beliefs.probabilities())
        asked = {part for kind in settled for part in kind.parts}
        kinds = [
            kind
            for kind in find_question_groups(round_.parts, self.way.per)
            if any(part in doubts for part in kind.parts) and not asked & set(kind.parts)
        ]
        kinds.sort(key=lambda kind: (-sum(part in doubts for part in kind.parts), kind.parts[0]))
        planned = [(kind, round_.about(kind, labels)) for kind in kinds]
        self._more(round_, settled, [(_Settled(kind, question), question) for kind, question in planned])

    def _more(
        self, round_: _Round, settled: dict[QuestionGroup, _Settled], planned: Sequence[tuple[_Settled, Question]]
    ) -> None:
        paid = self.asking.within_budget([question for _, question in planned])
        for (before, _), outcome in zip(planned, round_.send(paid), strict=False):
            verdict = round_.note(outcome)
            if verdict is None:
                continue
            again = bool(before.verdicts)
            # It was asked with more to go by: it counts in full beside the first.
            round_.beliefs.believe(before.kind.parts, [verdict])
            settled[before.kind] = replace(
                before, question=outcome.question, verdicts=(*before.verdicts, verdict), again=again
            )

    def _refuse_silence(self, round_: _Round, settled: Mapping[QuestionGroup, _Settled]) -> None:
        """A run without any answer must not pass for one.

        Raises:
            LabelError: questions were asked, none was answered, and none can be any more.
        """
        if self.only_asks or not settled or any(each.verdicts for each in settled.values()):
            return
        reasons = Counter(reason for reason, _ in round_.unanswered)
        reason = reasons.most_common(1)[0][0] if reasons else "none came"
        count = "the question" if len(settled) == 1 else f"any of the {len(settled):,} questions"
        findings = (one for one in self.asking.findings() if one.code.startswith("lvlm-answers"))
        strays = "".join(f"; {finding.message}" for finding in findings)
        raise LabelError(
            f"no answer to {count} ({reason}){strays}; nothing was changed; see to the answers or the server and run it"
            " again"
        )

    def _report(
        self, round_: _Round, left_out: Sequence[QuestionGroup], settled: Mapping[QuestionGroup, _Settled]
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
        rest = [paths[part] for kind in left_out for part in kind.parts]
        if rest:
            why = "the questions there are about others" if self._only else "the budget was used where it helps more"
            message = f"{len(rest)} parts were not asked about: {why}"
            diagnostics.append(Diagnostic("lvlm-budget", message, tuple(rest)))
        if self.proposals:
            shown = ", ".join(f"{g}: {n}" for g, n, _ in sorted(self.proposals, key=str)[:5])
            message = f"{len(self.proposals)} labels outside the vocabulary were proposed ({shown}...)"
            diagnostics.append(Diagnostic("lvlm-proposals", message[:_MESSAGE]))
        diagnostics += self.asking.findings()
        if self._folder is not None:
            self._write(round_, settled)
        return tuple(diagnostics)

    def _write(self, round_: _Round, settled: Mapping[QuestionGroup, _Settled]) -> None:
        if self._folder is None or self.estimate is None:
            return
        tally = self.tally
        record = {
            "model": self.asking.answerer.name,
            "prompt": version("label"),
            "kinds": len(settled),
            "asked": tally.asked,
            "from_cache": tally.known,
            "asked_again_for_form": tally.again,
            "failed": tally.failed,
            "prompt_tokens": tally.prompt_tokens,
            "answer_tokens": tally.answer_tokens,
            "cost_usd": round(tally.cost, 6) if self.asking.price else None,
            "spent_now_usd": round(tally.spent, 6) if self.asking.price else None,
            "estimated_usd": self.estimate.cost,
            **self.asking.record(),
        }
        write_atomically(self._folder / "run.json", json.dumps(record, indent=1) + "\n")
        rows = [
            {"group": group, "name": name, "reason": reason, "times": times, "source": self.asking.answerer.name}
            for (group, name, reason), times in sorted(self.proposals.items(), key=str)
        ]
        if rows:
            content = {"format": "cadgraph-proposals", "version": 1, "labels": rows}
            write_atomically(self._folder / "proposals.json", json.dumps(content, ensure_ascii=False, indent=1) + "\n")
        if self.only_asks and not self.asking.answerer.keeps:
            paths = round_.parts.scene.paths
            write_index(
                getattr(self.asking.answerer, "folder", self._folder / "questions"),
                [(each.question.id, [paths[part] for part in each.kind.parts]) for each in settled.values()],
            )


@dataclass(frozen=True)
class _Settled:
    kind: QuestionGroup
    question: Question
    verdicts: tuple[Verdict, ...] = ()
    again: bool = False

    @property
    def votes(self) -> tuple[str, ...]:
        """What each answer says."""
        return tuple(f"{v.group or '?'}: {v.name or '?'}" for v in self.verdicts)

    def seen(self, said: tuple[str, str | None]) -> str | None:
        """What an answer of this label saw; None where no answer says so."""
        alike = (v.seen for v in self.verdicts if v.group == said[0] and (said[1] is None or v.name in (said[1], None)))
        return next(alike, None)


class _Round:
    """What the questions about one scene have in common, and what is believed so far."""

    def __init__(
        self, labeler: LvlmLabeler, parts: Parts, contacts: Contacts, vocabulary: Vocabulary, said: Labeling | None
    ) -> None:
        self.parts, self.vocabulary = parts, vocabulary
        self.base: Sequence[Label | None] = [None] * parts.n_parts if said is None else said.answers
        self._least = (LEAST_CONFIDENCE,) * parts.n_parts if said is None else said.thresholds
        self.beliefs = Beliefs(vocabulary, said, parts.n_parts, labeler.accuracy)
        self.near = neighbors_of(parts, contacts)
        self.unanswered: list[tuple[str, QuestionGroup]] = []
        self._labeler = labeler
        self._gallery = labeler._gallery(parts)
        self._hints = Hints(parts, self.near)
        self._schema = answer_schema(vocabulary)
        self._wordings: dict[str, Wording] = {}

    def questions(self, kind: QuestionGroup, labels: Sequence[Label | None] | None = None) -> list[Question]:
        """About the members that are voted on; with labels, with those of what they touch."""
        way = self._labeler.way
        found = []
        for part in kind.members(way.votes):
            hints = self._hints.lines(part, len(kind.parts), self.base) if way.hints else ()
            if labels is not None and not hints:
                hints = self._hints.around(part, labels)
            found.append(self._question(part, self._wording(part, hints)))
        return found

    def again(self, settled: _Settled, labels: Sequence[Label | None]) -> Question:
        """With more context."""
        part = settled.question.part
        label = labels[part]
        before = None if label is None else label.name or label.group
        wording = self._wording(part, self._hints.lines(part, len(settled.kind.parts), labels))
        return self._question(part, replace(wording, before=before))

    def about(self, kind: QuestionGroup, labels: Sequence[Label | None]) -> Question:
        """About a part where the network does not add up."""
        part = kind.parts[0]
        return self._question(part, self._wording(part, self._hints.lines(part, len(kind.parts), labels)))

    def ask(self, planned: _Planned) -> dict[QuestionGroup, _Settled]:
        """What the model says of each kind; what follows from it is believed."""
        outcomes = iter(self.send([question for questions in planned.values() for question in questions]))
        settled: dict[QuestionGroup, _Settled] = {}
        for kind, questions in planned.items():
            verdicts: list[Verdict] = []
            asked, reason = questions[0], "it was not asked"
            for _ in questions:
                outcome = next(outcomes)
                verdict = self.note(outcome)
                if verdict is not None:
                    asked = outcome.question if not verdicts else asked
                    verdicts.append(verdict)
                else:
                    reason = outcome.reason or reason
            if not verdicts:
                self.unanswered.append((reason, kind))
            elif all(verdict.group is None for verdict in verdicts):
                self.unanswered.append(("it named no label of the vocabulary", kind))
            self.beliefs.believe(kind.parts, verdicts)
            settled[kind] = _Settled(kind, asked, tuple(verdicts))
        return settled

    def labels(self, settled: Mapping[QuestionGroup, _Settled], former: Labeling | None) -> list[Label | None]:
        """The label of each part: what is believed of it where there is an answer; else as it was.

        Args:
            settled: what was asked and answered.
            former: the labels of a finished graph, for parts without an answer; or None.
        """
        labels = list(self.base)
        if former is not None:
            answered = _answered(settled)
            for part, label in enumerate(former.labels):
                # What was paid for once, and what nobody knows better, stays.
                if part not in answered and label is not None and (labels[part] is None or _asked_for(label)):
                    labels[part] = label
        for each in settled.values():
            if any(verdict.group is not None for verdict in each.verdicts):
                for part in each.kind.parts:
                    labels[part] = self._label(part, each)
        return labels

    def _label(self, part: int, settled: _Settled) -> Label:
        found = self.beliefs.label_of(part, self._least[part])
        seen, before = settled.seen(found.said), self.base[part]
        if seen is None and before is not None and before.said == found.said:
            # The answer was outweighed.
            return before.model_copy(update={"confidence": found.confidence, "guesses": found.guesses})
        evidence = LvlmEvidence(
            model=self._labeler.asking.answerer.name,
            prompt=settled.question.prompt,
            question=settled.question.id,
            asked=self.parts.scene.paths[settled.question.part],
            repeats=len(settled.kind.parts),
            votes=settled.votes,
            seen=seen or "",
            again=True if settled.again else None,
        )
        return Label(found.group, found.name, found.confidence, "lvlm", evidence, found.guesses)

    def thresholds(self, labels: Sequence[Label | None], settled: Mapping[QuestionGroup, _Settled]) -> list[float]:
        """The least confidence of each label: none for what stays from a finished graph."""
        least = list(self._least)
        answered = _answered(settled)
        for part, label in enumerate(labels):
            if label is not None and part not in answered and label is not self.base[part]:
                least[part] = 0.0
        return least

    def send(self, questions: Sequence[Question]) -> list[Outcome[Answer]]:
        """Asks."""
        return self._labeler.asking.ask_all(questions, Answer, self._reworded)

    def note(self, outcome: Outcome[Answer]) -> Verdict | None:
        """An answer in the terms of the vocabulary; what it proposes is kept."""
        if outcome.answer is None:
            return None
        verdict = settle(outcome.answer, self.vocabulary)
        proposal: Proposal | None = verdict.proposal
        if proposal is not None:
            known = next(
                (key for key in self._labeler.proposals if key[:2] == (proposal.group, proposal.name)),
                (proposal.group, proposal.name, proposal.reason),
            )
            self._labeler.proposals[known] += 1
        return verdict

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
            about=self.parts.scene.paths[part],
        )
        self._wordings[question.id] = wording
        return question

    def _reworded(self, question: Question, reason: str) -> Question:
        return self._question(question.part, replace(self._wordings[question.id], again=reason), 1)


def _answered(settled: Mapping[QuestionGroup, _Settled]) -> set[int]:
    """The parts with an answer."""
    return {part for each in settled.values() if each.verdicts for part in each.kind.parts}


def _asked_for(label: Label) -> bool:
    """Whether a label came from a model, as it is or mended by sizes."""
    return label.source in ("lvlm", "context")
