"""Who has the last word: catalogues over the labeler and the file, given labels over these, corrections over all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.config import LabelConfig
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.catalog import apply_catalogs
from cadgraph.labelers.corrections import apply_corrections
from cadgraph.labelers.file import lay_file
from cadgraph.labelers.given import apply_given
from cadgraph.model.analysis import Analysis
from cadgraph.model.catalog import Catalog
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.edits import Correction, Edit
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.labels import CorrectedEvidence, FormerLabel, GeometryEvidence, Guess, Label
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["SettledLabels", "lay_corrections", "lay_known", "settle_labels"]

_GROUND = "ground"  # the name of the ground in the vocabulary


@dataclass(frozen=True, eq=False)
class SettledLabels:
    """The labels that count.

    Args:
        labels: of each part.
        guesses: of each part that nobody is sure about, the likeliest first.
        opinions: what the labeler alone says, but for parts that the user knows: a second opinion on the rest.
        diagnostics: what is to be reported.
        probabilities: what the labeler holds for possible, where it knows.
    """

    labels: tuple[Label | None, ...]
    guesses: tuple[tuple[Guess, ...], ...]
    opinions: tuple[Label | None, ...]
    diagnostics: tuple[Diagnostic, ...] = ()
    probabilities: Probabilities | None = None


def settle_labels(
    labeling: Labeling,
    analysis: Analysis,
    vocabulary: Vocabulary,
    config: LabelConfig,
    *,
    catalogs: Sequence[Catalog] = (),
    given: Sequence[GivenLabel] = (),
    corrections: Sequence[Edit] = (),
) -> SettledLabels:
    """Lays what the user knows over what a labeler said.

    Args:
        labeling: what it said.
        analysis: of the scene.
        vocabulary: the labels in use.
        config: how parts get their labels.
        catalogs: of the user's own parts.
        given: labels of source meshes from outside.
        corrections: in force; those of labels count here, and spread.

    Raises:
        LabelError: a given label names a mesh that is not in the scene.
    """
    known = lay_known(labeling, analysis, vocabulary, config, catalogs, given)
    return lay_corrections(known, labeling, analysis, corrections)


def lay_known(
    labeling: Labeling,
    analysis: Analysis,
    vocabulary: Vocabulary,
    config: LabelConfig,
    catalogs: Sequence[Catalog],
    given: Sequence[GivenLabel],
) -> SettledLabels:
    """The labels before any correction; see ``settle_labels``."""
    told = lay_file(labeling, analysis, vocabulary, config)
    known, from_catalogs = apply_catalogs(
        _lay_ground(told.labels, analysis, vocabulary), catalogs, analysis.parts, vocabulary
    )
    named, from_outside = apply_given(known, given, analysis.scene, analysis.parts, config)
    diagnostics = (*told.diagnostics, *from_catalogs, *from_outside)
    opinions = _opinions(named, labeling)
    return SettledLabels(named, told.guesses, opinions, diagnostics, told.probabilities)


def lay_corrections(
    known: SettledLabels, labeling: Labeling, analysis: Analysis, corrections: Sequence[Edit]
) -> SettledLabels:
    """The labels with corrections over what ``lay_known`` returned."""
    of_labels = [edit for edit in corrections if isinstance(edit, Correction)]
    labels, found = apply_corrections(known.labels, of_labels, analysis.scene, analysis.parts, analysis.contacts)
    opinions = _opinions(labels, labeling)
    return SettledLabels(labels, known.guesses, opinions, (*known.diagnostics, *found), known.probabilities)


def _lay_ground(labels: Sequence[Label | None], analysis: Analysis, vocabulary: Vocabulary) -> tuple[Label | None, ...]:
    """The ground is called so, where the vocabulary has a name for it: it is found by its place, not by its shape."""
    group = next((group for group in vocabulary.groups if vocabulary.holds(group, _GROUND)), None)
    if group is None:
        return tuple(labels)
    found = analysis.found_ground
    laid = list(labels)
    for part in np.flatnonzero(analysis.parts.ground).tolist():
        by_itself = found is None or any(found[mesh] for mesh in analysis.parts.meshes[part])
        why = "large, flat and lowest, under all else" if by_itself else "a user said so"
        evidence = GeometryEvidence(why=why, before=FormerLabel.of(labels[part]))
        laid[part] = Label(group, _GROUND, 1.0, "geometry", evidence)
    return tuple(laid)


def _opinions(labels: Sequence[Label | None], labeling: Labeling) -> tuple[Label | None, ...]:
    return tuple(
        label if label is not None and _is_known(label) else opinion
        for label, opinion in zip(labels, labeling.labels, strict=True)
    )


def _is_known(label: Label) -> bool:
    """Whether a label comes from the user's catalogue or corrections, which no labeler may doubt."""
    return label.source == "catalog" or isinstance(label.evidence, CorrectedEvidence)
