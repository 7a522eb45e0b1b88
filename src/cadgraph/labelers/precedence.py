"""Who has the last word: catalogues over the labeler, given labels over these, a user's corrections over all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cadgraph.config import LabelConfig
from cadgraph.labelers.base import Labeler, apply_given
from cadgraph.labelers.catalog import apply_catalogs
from cadgraph.labelers.corrections import apply_corrections
from cadgraph.labelers.coverage import tell_unknown
from cadgraph.model.catalog import Catalog
from cadgraph.model.corrections import Correction
from cadgraph.model.labels import GivenLabel
from cadgraph.model.parts import Contacts, Label, Parts
from cadgraph.model.scene import Diagnostic, Scene
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Settled", "settle_labels"]


@dataclass(frozen=True)
class Settled:
    """The labels that count.

    Args:
        labels: of each part.
        opinions: what the labeler alone says, but for parts that the user knows: a second opinion on the rest.
        diagnostics: what is to be told.
    """

    labels: tuple[Label | None, ...]
    opinions: tuple[Label | None, ...]
    diagnostics: tuple[Diagnostic, ...]


def settle_labels(
    labels: Sequence[Label | None],
    labeler: Labeler | None,
    catalogs: Sequence[Catalog],
    given: Sequence[GivenLabel],
    corrections: Sequence[Correction],
    scene: Scene,
    parts: Parts,
    contacts: Contacts,
    vocabulary: Vocabulary,
    config: LabelConfig,
) -> Settled:
    """Lays what the user knows over what a labeler said.

    Args:
        labels: of each part, by the labeler.
        labeler: that gave them; what it has to tell is told.
        catalogs: of the user's own parts.
        given: labels of source meshes from outside.
        corrections: of single parts, which spread.
        scene: the source meshes.
        parts: made from them.
        contacts: pairs of parts that are adjacent.
        vocabulary: the labels in use.
        config: how parts get their labels.

    Raises:
        LabelError: a given label names a mesh that is not in the scene.
    """
    told = (*getattr(labeler, "diagnostics", ()), *tell_unknown(labeler, vocabulary))
    known, told_catalogs = apply_catalogs(labels, catalogs, parts, vocabulary)
    named, told_given = apply_given(known, given, scene, parts, config)
    final, told_corrections = apply_corrections(named, corrections, scene, parts, contacts)
    opinions = tuple(
        label if label is not None and _is_known(label) else opinion
        for label, opinion in zip(final, labels, strict=True)
    )
    return Settled(final, opinions, (*told, *told_catalogs, *told_given, *told_corrections))


def _is_known(label: Label) -> bool:
    """Whether a label comes from the user's catalogue or corrections, which no labeler may doubt."""
    return label.source in ("human", "catalog") or "corrected" in label.evidence
