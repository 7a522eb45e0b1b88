"""How likely each label is for each part, and what a witness who is right so often adds to that."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.labelers.base import Labeling
from cadgraph.labelers.likeliest import Likeliest, likeliest
from cadgraph.model.labels import Guess
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Floats, Ints
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["LabelBeliefs", "shared_weight"]

_ALSO = 0.25  # how often a name is meant by the word for another, over how often that is (ours)
_LOST = 0.05  # share of a labeler's probabilities that goes to all names alike: it may be out of its depth
_ALIKE = 0.6  # how much of several statements about one thing is the same: they mostly share their mistakes


def shared_weight(n: int) -> float:
    """How much each of ``n`` statements that share most of their mistakes counts of what a single one would."""
    return 1 / (1 + _ALIKE * (n - 1))


class LabelBeliefs:
    """How likely each label of a vocabulary is for each part of a scene, as far as is known.

    Args:
        vocabulary: the labels.
        said: what a labeler says to begin with; None begins with nothing.
        n_parts: of the scene.

    Attributes:
        classes: group and name of each column.
        values: ``(n_parts, n_classes)`` probabilities.
        known: ``(n_parts,)`` whether anything is known of a part.
    """

    def __init__(self, vocabulary: Vocabulary, said: Labeling | None, n_parts: int) -> None:
        self.classes = tuple((group, name) for group, content in vocabulary.groups.items() for name in content.names)
        self._rank = {pair: k for k, pair in enumerate(self.classes)}
        self._group = np.array([group for group, _ in self.classes], np.str_)
        self._groups = tuple(dict.fromkeys(group for group, _ in self.classes))
        self._belongs = (self._group[:, None] == np.array(self._groups, np.str_)).astype(np.float64)
        self.values = np.full((n_parts, len(self.classes)), 1 / max(len(self.classes), 1))
        self.known = np.zeros(n_parts, np.bool_)
        if said is not None and self.classes:
            self._begin(said)

    def _begin(self, said: Labeling) -> None:
        """The labeler's probabilities; where it tells none, its label and guesses."""
        mine = np.zeros_like(self.values)
        if said.probabilities is not None:
            for column, pair in enumerate(said.probabilities.classes):
                if pair in self._rank:
                    mine[:, self._rank[pair]] = said.probabilities.values[:, column]
            self.known[:] = mine.sum(axis=1) > 0
        for part in np.flatnonzero(~self.known).tolist():
            answer = said.answers[part]
            if answer is None:
                continue
            for guess in answer.guesses or (Guess(answer.group, answer.name, answer.confidence),):
                self._add(mine[part], guess)
            self.known[part] = True
        total = mine.sum(axis=1, keepdims=True)
        # What belongs to no name may be any of them.
        mine = mine / np.maximum(total, 1.0)
        mine += (1 - np.minimum(total, 1.0)) / len(self.classes)
        self.values = np.where(self.known[:, None], (1 - _LOST) * mine + _LOST / len(self.classes), self.values)

    def _add(self, row: Floats, guess: Guess) -> None:
        if guess.name is not None:
            if (guess.group, guess.name) in self._rank:
                row[self._rank[guess.group, guess.name]] += guess.confidence
        elif (self._group == guess.group).any():
            row[self._group == guess.group] += guess.confidence / (self._group == guess.group).sum()

    def likelihood(
        self,
        group: str,
        name: str | None,
        named: float,
        grouped: float,
        astray: float | None = None,
        also: Sequence[str] = (),
    ) -> Floats:
        """``(n_classes,)`` how likely a statement is made, for each label that may be the true one.

        Args:
            group: that it says.
            name: that it says; None where it says the group alone.
            named: how often such a statement has the right name.
            grouped: how often it has the right group.
            astray: how often a statement with a wrong group says just this; None: as often as any other label.
            also: other names of the group that such a statement means now and then.
        """
        inside = self._group == group
        n_inside = max(int(inside.sum()), 1)
        outside = (1 - grouped) * (1 / max(int((~inside).sum()), 1) if astray is None else astray)
        if name is None:
            return np.asarray(np.where(inside, grouped / n_inside, outside), np.float64)
        # Of the wrong ones some fall on the same group, the rest on all others.
        odd: Floats = np.where(inside, max(grouped - named, 1e-3) / max(n_inside - 1, 1), outside)
        odd[self._ranks(group, also)] = _ALSO * named
        odd[self._rank[group, name]] = named
        return odd

    def _ranks(self, group: str, names: Sequence[str]) -> list[int]:
        """The columns of those names of a group that there are."""
        return [self._rank[group, name] for name in names if (group, name) in self._rank]

    def weigh(self, rows: Ints, logs: Floats) -> None:
        """Multiplies the probabilities of some parts by the likelihood of what was said of them.

        Args:
            rows: the parts.
            logs: ``(n_classes,)`` log-likelihood of all of it.
        """
        joint = np.log(np.maximum(self.values[rows], 1e-12)) + logs
        joint = np.exp(joint - joint.max(axis=1, keepdims=True))
        self.values[rows] = joint / joint.sum(axis=1, keepdims=True)
        self.known[rows] = True

    def group_of(self, part: int) -> str:
        """The likeliest group of a part."""
        return self._groups[int(np.argmax(self.values[part] @ self._belongs))]

    def name_within(self, part: int, group: str, names: Sequence[str], least: float) -> None:
        """Gives some names together at least a share of their group's probability, which stays as it is.

        Args:
            part: which.
            group: of the names.
            names: in that group.
            least: share, 0..1.
        """
        row, inside, mine = self.values[part], self._group == group, self._ranks(group, names)
        total = float(row[inside].sum())
        share = float(row[mine].sum()) / total if total > 0 else 1.0
        if 0 < share < least:
            chosen = row[mine] * (least / share)
            row[inside] *= (1 - least) / (1 - share)
            row[mine] = chosen

    def label_of(self, part: int, least: float) -> Likeliest:
        """The likeliest label of a part, the group alone where only that is likely enough.

        Args:
            part: which; it is known.
            least: confidence of a label.
        """
        row = self.values[part]
        return likeliest(self.classes, row, self._groups, row @ self._belongs, least)

    def sureness(self, parts: Sequence[int]) -> float:
        """How likely the likeliest names of some parts are, on average."""
        return float(self.values[np.asarray(parts, np.int64)].max(axis=1, initial=0.0).mean())

    def probabilities(self) -> Probabilities:
        """For the relations; rows of which nothing is known are 0."""
        return Probabilities(self.classes, np.where(self.known[:, None], self.values, 0.0))
