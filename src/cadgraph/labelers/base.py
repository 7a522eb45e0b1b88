"""Labelling: what each part is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from cadgraph.config import LabelConfig
from cadgraph.errors import LabelError
from cadgraph.model.labels import GivenLabel
from cadgraph.model.parts import Contacts, Guess, Label, Parts
from cadgraph.model.scene import Diagnostic, Scene
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Labeled", "Labeler", "apply_given", "label_parts", "labeler_of"]

LEAST_CONFIDENCE = 0.5
"""Of a label, where neither the settings nor the labeler say."""


class Labeler(Protocol):
    """Whatever can say what parts are.

    A labeler may have an attribute ``least_confidence``: labels below it are guesses unless the settings
    say otherwise; and ``diagnostics``: what is to be told once it has labelled.
    """

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Sequence[Label | None]:
        """Labels parts.

        Args:
            parts: with their geometry.
            contacts: pairs of parts that are adjacent.
            vocabulary: the labels to choose from.

        Returns:
            For each part its label, or None where it isn't known.
        """
        ...


@dataclass(frozen=True)
class Labeled:
    """What a labeler said.

    Args:
        labels: of each part, None where it isn't sure enough.
        guesses: of each part that has no label for that reason, the likeliest first.
    """

    labels: tuple[Label | None, ...]
    guesses: tuple[tuple[Guess, ...], ...]


def labeler_of(config: LabelConfig) -> Labeler | None:
    """The labeler that is set; None if labels come from outside only.

    Raises:
        LabelError: the trained model is damaged.
    """
    if config.labeler == "none":
        return None
    from cadgraph.labelers.embedded.labeler import EmbeddedLabeler

    return EmbeddedLabeler()


def label_parts(
    labeler: Labeler | None, parts: Parts, contacts: Contacts, vocabulary: Vocabulary, config: LabelConfig
) -> Labeled:
    """Asks a labeler, and keeps what it is sure enough of and the vocabulary holds.

    Raises:
        LabelError: the labeler answers for another number of parts.
    """
    if labeler is None:
        return Labeled((None,) * parts.n_parts, ((),) * parts.n_parts)
    answers = labeler.label(parts, contacts, vocabulary)
    if len(answers) != parts.n_parts:
        raise LabelError(f"the labeler gave {len(answers)} answers for {parts.n_parts} parts")
    if config.use_names:
        from cadgraph.labelers.name_hints import weigh_words

        answers = weigh_words(answers, parts, vocabulary)
    least = config.min_confidence
    if least is None:
        least = float(getattr(labeler, "least_confidence", LEAST_CONFIDENCE))
    held = [
        answer if answer is not None and vocabulary.holds(answer.group, answer.name) else None for answer in answers
    ]
    labels = tuple(answer if answer is not None and answer.confidence >= least else None for answer in held)
    guesses = tuple(
        _guesses(answer) if answer is not None and label is None else ()
        for answer, label in zip(held, labels, strict=True)
    )
    return Labeled(labels, guesses)


def _guesses(answer: Label) -> tuple[Guess, ...]:
    return answer.guesses or (Guess(answer.group, answer.name, answer.confidence),)


def apply_given(
    labels: Sequence[Label | None],
    given: Sequence[GivenLabel],
    scene: Scene,
    parts: Parts,
    config: LabelConfig,
) -> tuple[tuple[Label | None, ...], tuple[Diagnostic, ...]]:
    """Lays labels from outside over those of the labeler; a part takes that of its largest labelled mesh.

    Args:
        labels: of each part so far.
        given: labels of source meshes.
        scene: the source meshes.
        parts: made from them, each part's meshes the largest first.
        config: whether given labels overrule.

    Returns:
        The labels of each part, and what is to be told.

    Raises:
        LabelError: a label names a mesh that is not in the scene.
    """
    rank = {path: i for i, path in enumerate(scene.paths)}
    by_mesh: dict[int, GivenLabel] = {}
    for label in given:
        if label.mesh not in rank:
            raise LabelError(
                f"labels: {label.mesh!r} is not a mesh of {scene.source.path or 'the scene'}; "
                "remove the row or correct its path"
            )
        by_mesh[rank[label.mesh]] = label
    result = list(labels)
    outvoted: list[str] = []
    for part, meshes in enumerate(parts.meshes):
        found = [by_mesh[mesh] for mesh in meshes if mesh in by_mesh]
        if not found or (result[part] is not None and not config.overrule):
            continue
        first = found[0]
        result[part] = Label(first.group, first.name, 1.0, "author", {"mesh": first.mesh})
        outvoted += [label.mesh for label in found if (label.group, label.name) != (first.group, first.name)]
    if not outvoted:
        return tuple(result), ()
    message = "meshes with another given label than the largest mesh of their part, whose label counts"
    return tuple(result), (Diagnostic("label-outvoted", message, tuple(outvoted)),)
