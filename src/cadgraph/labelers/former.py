"""The labels of a finished graph, given again: who gave them can't be asked, or costs money."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import numpy as np

from cadgraph.config import Config
from cadgraph.labelers.base import AskingLabeler, Labeler, Labeling
from cadgraph.labelers.beliefs import LabelBeliefs
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import FileEvidence, GeometryEvidence, Label, LvlmEvidence
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.records import Part
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["FormerLabeler", "former_labeler", "settings_with"]

_OF_LABELERS = ("lvlm-", "unknown-label")  # how the codes of what labelers report begin
_LAID = ("author", "catalog")  # sources of labels that are laid over those of any labeler, and are laid anew


def settings_with(config: Config, labeler: Labeler | None) -> Config:
    """The settings as a graph keeps them: whether they alone say who labels it again.

    Args:
        config: that were given.
        labeler: that was given beside them; None for the one that is set.
    """
    if labeler is None or isinstance(labeler, EmbeddedLabeler | AskingLabeler | FormerLabeler):
        return config
    return config.replace({"label.labeler": "own"})


def former_labeler(graph: SceneGraph, config: Config) -> Labeler | None:
    """What labels a finished graph again as it was: None where the labeler of the settings says the same anew.

    Args:
        graph: finished.
        config: its settings.
    """
    asked = config.lvlm.ask
    if config.label.labeler == "own":
        return FormerLabeler(graph, probable=False)
    if asked == "never":
        return None
    # As it was when the model was asked.
    return FormerLabeler(graph, labeler_of(config.label) if asked == "unsure" or config.lvlm.hints else None)


class FormerLabeler:
    """Gives the labels of a finished graph again, as its labeler gave them: before the network, the file and the user.

    Args:
        graph: finished.
        base: the labeler that the one of the graph began with; its probabilities count for the parts of which both say
            the same. None: how likely each label is follows from the graph's labels and guesses alone.
        probable: whether it says how likely all names are; where the labeler of the graph did not, nor must this one.
    """

    def __init__(self, graph: SceneGraph, base: Labeler | None = None, *, probable: bool = True) -> None:
        self._graph, self._base, self._probable = graph, base, probable

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts; see ``cadgraph.labelers.base.Labeler``."""
        base = Labeling.empty(parts.n_parts) if self._base is None else self._base.label(parts, contacts, vocabulary)
        former = [self._graph.part_with(parts.scene.paths[i]) for i in range(parts.n_parts)]
        answers = [
            base.answers[i] if part is None or _is_laid(part) else _former_label(part, bool(parts.ground[i]))
            for i, part in enumerate(former)
        ]
        # Whether one was sure is known of each: it may have come from another labeler than the next.
        sure = tuple(inf if answer is not None and answer.likely else 0.0 for answer in answers)
        guesses = tuple(
            part.guesses if part is not None and answer is None else ()
            for part, answer in zip(former, answers, strict=True)
        )
        # What asking came to still holds: nobody is asked now.
        told = [note for note in self._graph.diagnostics if note.code.startswith(_OF_LABELERS)]
        said = replace(Labeling.judge(answers, 0.0, None, told, sure), guesses=guesses)
        return replace(said, probabilities=self._probabilities(base, said, vocabulary)) if self._probable else said

    def _probabilities(self, base: Labeling, said: Labeling, vocabulary: Vocabulary) -> Probabilities:
        """The base's own where the graph says what it says, else what the graph's labels and guesses leave open."""
        n_parts = len(said.answers)
        known = LabelBeliefs(vocabulary, base, n_parts)
        other = LabelBeliefs(vocabulary, said, n_parts)
        differs = [_in_short(a) != _in_short(b) for a, b in zip(base.labels, said.labels, strict=True)]
        rows = np.flatnonzero(np.array(differs, np.bool_) & other.known)
        known.values[rows], known.known[rows] = other.values[rows], True
        return known.probabilities()


def _in_short(label: Label | None) -> tuple[str, str | None, float] | None:
    return None if label is None else (*label.said, round(label.confidence, 6))


def _is_laid(part: Part) -> bool:
    return part.label is not None and part.label.source in _LAID


def _former_label(part: Part, ground: bool) -> Label | None:
    """What the labeler said of a part, before anything else took its label's place, as its being the ground."""
    label = part.label
    if label is None:
        return None
    evidence = label.evidence
    if isinstance(evidence, GeometryEvidence) and evidence.file is not None:
        # The file has its say anew.
        without = {"confidence": evidence.file.without, "evidence": evidence.model_copy(update={"file": None})}
        return label.model_copy(update=without)
    if isinstance(evidence, LvlmEvidence) or (evidence.before is None and not ground and _is_of_labeler(label)):
        # Where sizes corrected a model's answer, that is the labeler's own work.
        return label.model_copy(update={"guesses": part.guesses})
    old = evidence.before
    if old is None:
        return None
    kept = {} if old.why is None else {"why": old.why}
    confidence = 0.0 if old.confidence is None else old.confidence
    return Label(old.group, old.name, confidence, old.source or "", kept, likely=bool(old.likely))


def _is_of_labeler(label: Label) -> bool:
    """Whether a label that replaced none is the labeler's, not one that was given where the labeler had none."""
    return label.source not in ("network", "human", "repeat") and not isinstance(label.evidence, FileEvidence)
