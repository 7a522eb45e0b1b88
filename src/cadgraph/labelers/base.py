"""What a labeler is, and what it hands back."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

from cadgraph.config import LabelConfig
from cadgraph.errors import LabelError
from cadgraph.model.derived import once_for_each
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Guess, Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = ["LEAST_CONFIDENCE", "AskingLabeler", "Labeler", "Labeling", "Probabilities", "label_parts"]

LEAST_CONFIDENCE = 0.5
"""Of a label, where neither the settings nor the labeler say."""

_OF_USERS = ("human", "repeat")  # sources of corrections
_EXAMPLES = 20  # so many labels, and so many meshes of each, are named


@dataclass(frozen=True, eq=False)
class Labeling:
    """What a labeler says of the parts of a scene.

    Args:
        labels: of each part, None where it isn't sure enough.
        guesses: of each part that has no label for that reason what it may be, the likeliest first.
        answers: of each part the likeliest label, however unsure; ``labels`` are those that are sure enough.
        thresholds: least confidence of a label of each part.
        sure: least confidence of one that is sure, of all or of each part; those below are marked as likely.
        probabilities: of all names, where the labeler knows them.
        diagnostics: what is to be reported about it.
    """

    labels: tuple[Label | None, ...]
    guesses: tuple[tuple[Guess, ...], ...]
    answers: tuple[Label | None, ...]
    thresholds: tuple[float, ...]
    probabilities: Probabilities | None = None
    diagnostics: tuple[Diagnostic, ...] = ()
    sure: float | tuple[float, ...] = 0.0

    @classmethod
    def judge(
        cls,
        answers: Sequence[Label | None],
        threshold: float | Sequence[float] = LEAST_CONFIDENCE,
        probabilities: Probabilities | None = None,
        diagnostics: Sequence[Diagnostic] = (),
        sure: float | Sequence[float] = 0.0,
    ) -> Labeling:
        """Tells sure labels, likely ones and mere guesses by their confidence.

        Args:
            answers: of each part the likeliest label, None where there is none.
            threshold: least confidence of a label: of all, or of each part.
            probabilities: of all names, where they are known.
            diagnostics: what is to be reported.
            sure: least confidence of a label that is sure: of all, or of each part.
        """
        least, least_sure = _each(threshold, len(answers)), _each(sure, len(answers))
        # An answer that many parts share stays one object.
        changed = once_for_each(_with_other_mark)

        def marked(label: Label, limit_of_sure: float) -> Label:
            return label if label.likely == (label.confidence < limit_of_sure) else changed(label)

        labels = tuple(
            marked(a, limit_of_sure) if a is not None and a.confidence >= limit else None
            for a, limit, limit_of_sure in zip(answers, least, least_sure, strict=True)
        )
        guesses = tuple(
            (answer.guesses or (Guess(answer.group, answer.name, answer.confidence),))
            if answer is not None and label is None
            else ()
            for answer, label in zip(answers, labels, strict=True)
        )
        return cls(labels, guesses, tuple(answers), least, probabilities, tuple(diagnostics), least_sure)

    @classmethod
    def empty(cls, n_parts: int) -> Labeling:
        """Nobody says anything about any of ``n_parts`` parts."""
        return cls.judge([None] * n_parts)


def _each(value: float | Sequence[float], n_parts: int) -> tuple[float, ...]:
    """A threshold of each part."""
    return tuple(value) if isinstance(value, Sequence) else (value,) * n_parts


def _with_other_mark(label: Label) -> Label:
    return label.model_copy(update={"likely": not label.likely})


class Labeler(Protocol):
    """Whatever can say what parts are."""

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts.

        Args:
            parts: with their geometry.
            contacts: pairs of parts that are adjacent.
            vocabulary: the labels to choose from.

        Returns:
            What it says of each part; ``Labeling.judge`` makes it of the likeliest labels.
        """
        ...


@runtime_checkable
class AskingLabeler(Labeler, Protocol):
    """One that asks somebody else, who may not answer.

    Attributes:
        only_asks: whether no answer can come in this run, so that no result follows from it.
        former: gives the labels of a finished graph, which parts without an answer keep.
        contradictions: says at which parts the network contradicts labels.
    """

    only_asks: bool
    former: Labeler | None
    contradictions: Callable[[Sequence[Label | None], Probabilities], Collection[int]] | None


def label_parts(
    labeler: Labeler | None, parts: Parts, contacts: Contacts, vocabulary: Vocabulary, config: LabelConfig
) -> Labeling:
    """Asks a labeler; labels that the vocabulary does not hold are left out (``unknown-label``).

    Args:
        labeler: None says nothing.
        parts: with their geometry.
        contacts: pairs of parts that are adjacent.
        vocabulary: the labels to choose from.
        config: the least confidence, in place of the labeler's own.

    Raises:
        LabelError: the labeler answers for another number of parts, speaks for the user, or gives evidence that no file
            can hold.
    """
    if labeler is None:
        return Labeling.empty(parts.n_parts)
    said = _as_labeling(labeler.label(parts, contacts, vocabulary))
    if len(said.labels) != parts.n_parts:
        raise LabelError(f"the labeler gave {len(said.labels)} answers for {parts.n_parts} parts")
    _check_answers(said.answers, parts)
    held = [answer if answer is not None and vocabulary.holds(*answer.said) else None for answer in said.answers]
    least = said.thresholds if config.min_confidence is None else config.min_confidence
    sure = said.sure if config.sure_confidence is None else config.sure_confidence
    told = (*said.diagnostics, *_unknown(said.answers, held, parts))
    judged = Labeling.judge(held, least, said.probabilities, told, sure)
    # What a labeler holds for possible without an answer of its own stays.
    guesses = tuple(
        known if answer is None else mine
        for answer, known, mine in zip(said.answers, said.guesses, judged.guesses, strict=True)
    )
    return replace(judged, guesses=guesses)


def _check_answers(said: Sequence[Label | None], parts: Parts) -> None:
    """Makes sure that labels can be written, and that none says that the user gave it."""
    checked: set[int] = set()
    for part, answer in enumerate(said):
        if answer is None:
            continue
        if answer.source in _OF_USERS:
            raise LabelError(
                f"the labeler calls the source of its label of {parts.scene.paths[part]} {answer.source!r}, like a "
                "user's correction; take a word of your own"
            )
        extra = answer.evidence.model_extra
        if extra and id(extra) not in checked:
            checked.add(id(extra))
            try:
                json.dumps(extra, allow_nan=False)
            except (TypeError, ValueError) as error:
                raise LabelError(
                    f"the labeler's evidence of {parts.scene.paths[part]} can't be written ({error}); give numbers, "
                    "texts, lists and dicts of these"
                ) from error


def _unknown(said: Sequence[Label | None], held: Sequence[Label | None], parts: Parts) -> list[Diagnostic]:
    """What is to be said of each label that was left out."""
    left: dict[str, list[int]] = {}
    for part, (answer, kept) in enumerate(zip(said, held, strict=True)):
        if answer is not None and kept is None:
            left.setdefault(spell_label(*answer.said), []).append(part)
    return [
        Diagnostic(
            "unknown-label",
            f"the labeler says {label!r} of {len(of)} part{'s'[: len(of) != 1]}, which the vocabulary doesn't hold: "
            "left out; spell it as there, or add it to a vocabulary of your own",
            tuple(parts.scene.paths[part] for part in of[:_EXAMPLES]),
        )
        for label, of in sorted(left.items())[:_EXAMPLES]
    ]


def _as_labeling(said: Labeling | Sequence[Label | None]) -> Labeling:
    """What a labeler says, also where it speaks in the manner of version 0.1.0."""
    if isinstance(said, Labeling):
        return said
    warnings.warn(
        "a labeler that returns a list of labels is deprecated; return Labeling.judge(labels)",
        DeprecationWarning,
        stacklevel=3,
    )
    return Labeling.judge(said)
