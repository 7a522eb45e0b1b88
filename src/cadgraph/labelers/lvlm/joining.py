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
from cadgraph.labelers.beliefs import LabelBeliefs, shared_weight
from cadgraph.labelers.lvlm.answer import Verdict
from cadgraph.labelers.lvlm.tables import checked, read_table, where_of
from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Accuracy", "Beliefs", "read_accuracy"]

_TYPICAL, _SLOPE = 0.85, 0.5  # what models usually say of themselves; how much of another odds is believed
_LEAST, _MOST = 0.02, 0.98


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


class Beliefs(LabelBeliefs):
    """How likely each label of a vocabulary is for each part of a scene, by a labeler and a model's answers.

    Args:
        vocabulary: the labels.
        said: what a labeler says to begin with; None begins with nothing.
        n_parts: of the scene.
        accuracy: of the model whose answers are to be believed.
    """

    def __init__(self, vocabulary: Vocabulary, said: Labeling | None, n_parts: int, accuracy: Accuracy) -> None:
        super().__init__(vocabulary, said, n_parts)
        self._accuracy = accuracy

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
        weight = shared_weight(len(told))
        logs = np.zeros(len(self.classes))
        for verdict in told:
            logs += weight * np.log(self._likelihood(verdict))
        self.weigh(np.asarray(parts, np.int64), logs)

    def _likelihood(self, verdict: Verdict) -> Floats:
        """How likely an answer is to be given, for each label that may be the true one."""
        group = verdict.group or ""
        name, in_group = self._accuracy.of(group)
        name, in_group = _believed(name, verdict.confidence), _believed(in_group, verdict.confidence)
        odd = self.likelihood(group, verdict.name, name, in_group)
        if verdict.name is None:
            return odd
        # Of the wrong ones half fall on names that are often confused.
        rivals = {b for a, b in self._accuracy.confused if a == verdict.name}
        rivals |= {a for a, b in self._accuracy.confused if b == verdict.name}
        near = [k for k, (_, each) in enumerate(self.classes) if each in rivals]
        if near:
            odd = odd / 2
            odd[near] += (1 - name) / 2 / len(near)
            odd[self._rank[group, verdict.name]] = name
        return odd


def _believed(share: float, confidence: float) -> float:
    """How often an answer is right that is given with a confidence: surer than usual counts a little more."""
    said = min(max(confidence, _LEAST), _MOST)
    odds = _logit(share) + _SLOPE * (_logit(said) - _logit(_TYPICAL))
    return min(max(1 / (1 + math.exp(-odds)), _LEAST), 0.995)


def _logit(share: float) -> float:
    return math.log(share / (1 - share))
