"""What each part may be, for the decisions of the network: the labeler's probabilities rather than its answers."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.derived import store_of
from cadgraph.model.labels import Label
from cadgraph.model.parts import Bools
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Floats, blocks
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["LEAST", "Beliefs", "beliefs_of"]

LEAST = 1e-3
"""No probability counts for less where odds are made of it."""

# Who can't be overruled by what lies around a part: the user, and the file where it is asked.
_KNOWN = frozenset({"human", "repeat", "catalog", "author", "file"})
_ROWS = 4_096  # parts at once, whose rows stay in the processor's cache


@dataclass(frozen=True, eq=False)
class Beliefs:
    """How likely each name is for each part, and whose word may be doubted.

    Args:
        classes: group and name of each column; the name is None for what is only known by group.
        values: ``(n_parts, n_classes)``; what is missing to 1 in a row is nothing that the vocabulary knows.
        open: ``(n_parts,)`` whether nobody but the labeler says what the part is.
    """

    classes: tuple[tuple[str, str | None], ...]
    values: Floats
    open: Bools

    def of_groups(self, groups: Collection[str], without: Collection[str | None] = ()) -> Floats:
        """``(n_parts,)`` how likely each part is of some groups, names that are left out not counted."""
        # Asked for every body of a plant, of the same few groups.
        known = store_of(self, "of groups")
        key = frozenset(groups), frozenset(without)
        if key not in known:
            columns = [k for k, (group, name) in enumerate(self.classes) if group in groups and name not in without]
            known[key] = _sum_of(self.values, columns)
            known[key].setflags(write=False)
        total: Floats = known[key]
        return total

    def of_name(self, name: str) -> Floats:
        """``(n_parts,)`` how likely each part is called so, in whatever group."""
        return _sum_of(self.values, [k for k, (_, one) in enumerate(self.classes) if one == name])


def _sum_of(values: Floats, columns: Sequence[int]) -> Floats:
    """The sum of some columns in each row."""
    total = np.empty(len(values))
    for some in blocks(len(values), _ROWS):
        values[some, columns].sum(axis=1, out=total[some])
    return total


def beliefs_of(labels: Sequence[Label | None], probabilities: Probabilities | None, vocabulary: Vocabulary) -> Beliefs:
    """What the labeler holds for possible, and for certain what others say.

    Args:
        labels: of each part, None where it has none.
        probabilities: of the labeler; without them labels and their guesses have to do.
        vocabulary: the tree of labels.
    """
    classes = _classes_of(vocabulary)
    column = {said: k for k, said in enumerate(classes)}
    values = _values_of(probabilities, len(labels), column)
    is_open = np.array([label is None or label.source not in _KNOWN for label in labels], np.bool_)
    for part, label in enumerate(labels):
        # A vision-language model's answer, too, counts by its confidence where the network is asked.
        if label is None or (is_open[part] and label.source == "geometry" and probabilities is not None):
            continue
        values[part] = _row_of(_said(label) if is_open[part] else [(label.said, 1.0)], column)
    return Beliefs(classes, values, is_open)


def _row_of(
    said: Sequence[tuple[tuple[str, str | None], float]], column: Mapping[tuple[str, str | None], int]
) -> Floats:
    """``(n_classes,)`` how sure each class is; what the vocabulary doesn't know is left out."""
    row = np.zeros(len(column))
    for one, confidence in said:
        if one in column:
            row[column[one]] += confidence
    return row


def _classes_of(vocabulary: Vocabulary) -> tuple[tuple[str, str | None], ...]:
    """Every name of the vocabulary with its group, then the groups without a name."""
    named: list[tuple[str, str | None]] = [(g, n) for g, held in vocabulary.groups.items() for n in held.names]
    return (*named, *((group, None) for group in vocabulary.groups))


def _values_of(
    probabilities: Probabilities | None, n_parts: int, column: Mapping[tuple[str, str | None], int]
) -> Floats:
    """``(n_parts, n_classes)`` the labeler's probabilities; what the vocabulary doesn't know is left out."""
    values = np.zeros((n_parts, len(column)))
    if probabilities is not None:
        known = [k for k, said in enumerate(probabilities.classes) if said in column]
        columns = [column[probabilities.classes[k]] for k in known]
        for some in blocks(n_parts, _ROWS):
            values[some, columns] = probabilities.values[some, known]
    return values


def _said(label: Label) -> list[tuple[tuple[str, str | None], float]]:
    """What a label guesses and how sure it is of each; itself where it guesses nothing."""
    return [(guess.said, guess.confidence) for guess in label.guesses] or [(label.said, label.confidence)]
