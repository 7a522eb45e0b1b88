"""What a labeler holds for possible and what a model answers, made into one: probabilities times likelihoods."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from cadgraph._io.limits import ACCURACIES
from cadgraph.errors import LabelError
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.likeliest import Likeliest, likeliest
from cadgraph.labelers.lvlm.answer import Verdict
from cadgraph.labelers.lvlm.tables import checked, read_table, where_of
from cadgraph.model.labels import Guess
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Accuracy", "Beliefs", "read_accuracy"]

_LOST = 0.05  # share of a labeler's probabilities that goes to all names alike: it may be out of its depth
_TYPICAL, _SLOPE = 0.85, 0.5  # what models usually say of themselves; how much of another odds is believed
_LEAST, _MOST = 0.02, 0.98
_ALIKE = 0.6  # how much of several answers about one kind is the same: a mistake is mostly made of the shape


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class _Own(_Strict):
    name: float = Field(gt=0, lt=1)
    group: float = Field(gt=0, lt=1)


class _Shares(_Strict):
    name: float = Field(gt=0, lt=1)
    group: float = Field(gt=0, lt=1)
    groups: Mapping[str, _Own] = Field(default_factory=dict)


@dataclass(frozen=True)
class Accuracy:
    """How often a model's answers are right.

    Args:
        name: share of answers whose name is right.
        group: share whose group is.
        groups: both, for answers that say one of these groups.
        confused: pairs of names between which half of the wrong answers fall.
        entry: of the table that it is from.
    """

    name: float = 0.85
    group: float = 0.93
    groups: Mapping[str, tuple[float, float]] | None = None
    confused: tuple[tuple[str, str], ...] = ()
    entry: str = "default"

    def of(self, group: str) -> tuple[float, float]:
        """Share of right names and of right groups among answers that say a group."""
        return (self.groups or {}).get(group, (self.name, self.group))


def read_accuracy(model: str, file: str | Path = "", *, paper: bool = False) -> Accuracy:
    """How often a model is right, from a table: the entry with the longest key that begins its name, or the default.

    Args:
        model: its name.
        file: another table; the built-in one if empty.
        paper: whether it is shown the paper's pictures.

    Raises:
        LabelError: the table can't be read or is malformed.
    """
    where, table = where_of(file, ACCURACIES), read_table(file, "accuracy.yaml", ACCURACIES)
    if not isinstance(table, Mapping) or "default" not in table:
        raise LabelError(f"{where}: no entry 'default'; see the built-in one for its layout")
    keys = [k for k in table if isinstance(k, str) and k not in ("default", "confused", "paper")]
    key = max((k for k in keys if model.startswith(k)), key=len, default="paper" if paper else "default")
    shares = checked(_Shares, table.get(key, table["default"]), where, key)
    pairs = table.get("confused") or []
    if not isinstance(pairs, list) or not all(isinstance(p, list) and len(p) == 2 for p in pairs):
        raise LabelError(f"{where}: confused: give pairs of names")
    groups = {group: (own.name, own.group) for group, own in shares.groups.items()}
    return Accuracy(shares.name, shares.group, groups, tuple((str(a), str(b)) for a, b in pairs), key)


class Beliefs:
    """How likely each label of a vocabulary is for each part of a scene, as far as is known.

    Args:
        vocabulary: the labels.
        said: what a labeler says to begin with; None begins with nothing.
        n_parts: of the scene.
        accuracy: of the model whose answers are to be believed.
    """

    def __init__(self, vocabulary: Vocabulary, said: Labeling | None, n_parts: int, accuracy: Accuracy) -> None:
        self.classes = tuple((group, name) for group, content in vocabulary.groups.items() for name in content.names)
        self._rank = {pair: k for k, pair in enumerate(self.classes)}
        self._group = np.array([group for group, _ in self.classes], np.str_)
        self._groups = tuple(dict.fromkeys(group for group, _ in self.classes))
        self._belongs = (self._group[:, None] == np.array(self._groups, np.str_)).astype(np.float64)
        self._accuracy = accuracy
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

    def believe(self, parts: Sequence[int], verdicts: Sequence[Verdict]) -> None:
        """Takes the answers about a kind into account.

        Several answers about parts of one shape mostly share their mistakes; so each counts for less the more there
        are.

        Args:
            parts: of that kind.
            verdicts: in the terms of the vocabulary; those without a group say nothing.
        """
        told = [verdict for verdict in verdicts if verdict.group is not None]
        if not told or not self.classes:
            return
        weight = 1 / (1 + _ALIKE * (len(told) - 1))
        logs = np.zeros(len(self.classes))
        for verdict in told:
            logs += weight * np.log(self._likelihood(verdict))
        rows = np.asarray(parts, np.int64)
        joint = np.log(np.maximum(self.values[rows], 1e-12)) + logs
        joint = np.exp(joint - joint.max(axis=1, keepdims=True))
        self.values[rows] = joint / joint.sum(axis=1, keepdims=True)
        self.known[rows] = True

    def _likelihood(self, verdict: Verdict) -> Floats:
        """How likely an answer is to be given, for each label that may be the true one."""
        group = verdict.group or ""
        name, in_group = self._accuracy.of(group)
        name, in_group = _believed(name, verdict.confidence), _believed(in_group, verdict.confidence)
        inside = self._group == group
        n_inside, n_outside = max(int(inside.sum()), 1), max(int((~inside).sum()), 1)
        if verdict.name is None:
            return np.asarray(np.where(inside, in_group / n_inside, (1 - in_group) / n_outside), np.float64)
        # Of the wrong ones some fall on names that are often confused; the rest on the same group, and on all others.
        odd: Floats = np.where(inside, max(in_group - name, 1e-3) / max(n_inside - 1, 1), (1 - in_group) / n_outside)
        rivals = {b for a, b in self._accuracy.confused if a == verdict.name}
        rivals |= {a for a, b in self._accuracy.confused if b == verdict.name}
        near = [k for k, (_, each) in enumerate(self.classes) if each in rivals]
        if near:
            odd = odd / 2
            odd[near] += (1 - name) / 2 / len(near)
        odd[self._rank[group, verdict.name]] = name
        return odd

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


def _believed(share: float, confidence: float) -> float:
    """How often an answer is right that is given with a confidence: surer than usual counts a little more."""
    said = min(max(confidence, _LEAST), _MOST)
    odds = _logit(share) + _SLOPE * (_logit(said) - _logit(_TYPICAL))
    return min(max(1 / (1 + math.exp(-odds)), _LEAST), 0.995)


def _logit(share: float) -> float:
    return math.log(share / (1 - share))
