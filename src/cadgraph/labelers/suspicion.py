"""How likely each label of a scene is wrong, and what the part is instead, by all that speaks for and against it.

Four witnesses are weighed against each other. The embedded labeler says how likely each name is, also where somebody
else gave the label: a second opinion. Who gave the label is right as often as that source mostly is; what the lines say
of a part mostly has the right group, but often not the right name. Kin, parts of other shapes that the labeler sees much
alike, mostly have the same name; those that a user has settled count most. And where the lines do not add up, a label
is often the reason.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.labelers.embedded.features import observe
from cadgraph.labelers.embedded.labeler import judge
from cadgraph.labelers.embedded.model import default_model
from cadgraph.model.derived import store_of
from cadgraph.model.labels import CorrectedEvidence, Guess, Label
from cadgraph.model.parts import Bools, Contacts, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Floats, Ints
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Suspicion", "suspect_labels"]

Said = tuple[str, str | None]

# Share of the labeler's probabilities that goes to all names alike: it may be out of its depth.
_LOST = 0.02
# How often a label is right by who gave it, at most; what the embedded labeler says is its own opinion again.
_TRUST = {"author": 0.97, "catalog": 0.97}
_MOST_TRUST, _LEAST_TRUST = 0.9, 0.5
_EXACT_TRUST = 0.98  # of what follows a user's word on the very same shape
_BY_LINES = 0.85  # how often a label that the lines gave has the right group
_RIVALS = 5  # names that a wrong label falls on, about
# Kin: so many other shapes, how fast their word fades with distance, how much they count beside the labeler, and how
# much a user's word among them counts for.
_N_KIN, _NEAR, _KIN_WEIGHT, _DOUBT, _SETTLED = 6, 0.35, 0.3, 0.3, 3.0
_AT_ONCE = 1 << 24  # distances that are worked out together
# How much likelier a label is wrong where the lines don't add up: measured on generated plants, 19 % against 3 %.
_CONTRADICTED = 5.0
# Labels without a name, and parts without a label, as far as the labeler is sure about their name.
_NAMELESS, _UNLABELLED = 0.9, 0.98


@dataclass(frozen=True, eq=False)
class Suspicion:
    """What speaks against the labels of a scene.

    Args:
        classes: group and name of each column.
        values: ``(n_parts, n_classes)`` how likely each part is each of them, all witnesses together.
        wrong: ``(n_parts,)`` how likely the label is wrong; 0 of the ground and of what a user settled.
        opinion: ``(n_parts, n_classes)`` the embedded labeler's probabilities alone.
        kin: ``(n_parts, n_classes)`` share of its kin that have each name.
        points: ``(n_parts, width)`` unit vectors: parts that the labeler sees much alike lie close.
    """

    classes: tuple[tuple[str, str], ...]
    values: Floats
    wrong: Floats
    opinion: Floats
    kin: Floats
    points: Floats

    def guesses(self, part: int, most: int = 5) -> tuple[Guess, ...]:
        """What a part may be, the likeliest first.

        Args:
            part: its number.
            most: how many at most.
        """
        row = self.values[part]
        order = np.argsort(-row, kind="stable")[:most].tolist()
        return tuple(Guess(self.classes[k][0], self.classes[k][1], round(float(row[k]), 4)) for k in order)

    def share(self, rows: Floats, part: int, said: Said) -> float:
        """What one of the witnesses gives to a label: ``opinion`` or ``kin`` as ``rows``; of a group all its names."""
        group, name = said
        columns = [k for k, (g, n) in enumerate(self.classes) if g == group and name in (None, n)]
        return float(rows[part, columns].sum())


def suspect_labels(
    labels: Sequence[Label | None],
    parts: Parts,
    contacts: Contacts,
    vocabulary: Vocabulary,
    opinions: Probabilities | None = None,
    contradicted: Collection[int] = (),
) -> Suspicion:
    """Weighs what speaks for and against each label.

    Args:
        labels: of each part, as they are now.
        parts: with their geometry.
        contacts: pairs of parts that are adjacent.
        vocabulary: the tree that the labels are from.
        opinions: the embedded labeler's probabilities where they are at hand; worked out once if None.
        contradicted: parts at which the lines do not add up.
    """
    classes = tuple((group, name) for group, content in vocabulary.groups.items() for name in content.names)
    column = {said: k for k, said in enumerate(classes)}
    n = parts.n_parts
    if not n or not classes:
        empty = np.zeros((n, len(classes)))
        return Suspicion(classes, empty, np.zeros(n), empty, empty, np.zeros((n, 0)))
    opinion = _opinion(parts, contacts, vocabulary, opinions, column)
    now = np.array([column.get((label.group, label.name or ""), -1) if label else -1 for label in labels], np.int64)
    kin, near = _votes_of_kin(parts, contacts, labels, now, len(classes))
    logs = np.log(opinion) + _KIN_WEIGHT * np.log(
        (kin * near[:, None] + _DOUBT / len(classes)) / (near + _DOUBT)[:, None]
    )
    told = np.flatnonzero(now >= 0)
    trust = np.array([_trust(labels[part]) for part in told.tolist()])
    logs[told, now[told]] += np.where(trust > 0, _odds(np.maximum(trust, 1e-3)), 0.0)
    by_lines = [k for k, label in enumerate(labels) if label is not None and label.source == "network"]
    groups = np.array([group for group, _ in classes], np.str_)
    said = np.array([label.group for k in by_lines if (label := labels[k]) is not None], np.str_)
    logs[by_lines] += np.where(groups == said[:, None], _odds(_BY_LINES), 0.0)
    logs[told, now[told]] -= np.where(np.isin(told, list(contradicted)), np.log(_CONTRADICTED), 0.0)
    values = np.exp(logs - logs.max(axis=1, keepdims=True))
    values /= values.sum(axis=1, keepdims=True)
    wrong = _wrong(labels, parts.ground, values, now)
    return Suspicion(classes, values, wrong, opinion, kin, _points(parts, contacts))


def _wrong(labels: Sequence[Label | None], ground: Bools, values: Floats, now: Ints) -> Floats:
    """``(n_parts,)`` how likely each label is wrong."""
    wrong = 1.0 - np.where(now >= 0, values[np.arange(len(now)), np.maximum(now, 0)], 0.0)
    for part in np.flatnonzero(now < 0).tolist():
        best = float(values[part].max())
        # The surer the labeler is of a name, the more it is worth to be asked for one.
        wrong[part] = (_NAMELESS if labels[part] is not None else _UNLABELLED) * (0.5 + 0.5 * best)
    settled = np.array([label is not None and label.source == "human" for label in labels], np.bool_)
    wrong[settled | ground] = 0.0
    return np.asarray(wrong, np.float64)


def _odds(trust: Floats | float) -> Floats:
    """What a statement that is right so often adds to the logarithm of the odds of what it says."""
    return np.asarray(np.log(_RIVALS * trust / (1.0 - trust)), np.float64)


def _trust(label: Label | None) -> float:
    """How often a label like this is right by who gave it; 0 where that is the network's own opinion again."""
    if label is None or label.source in ("geometry", "network"):
        return 0.0
    evidence = label.evidence
    if isinstance(evidence, CorrectedEvidence) and evidence.match == "exact":
        return _EXACT_TRUST
    return _TRUST.get(label.source, min(max(label.confidence, _LEAST_TRUST), _MOST_TRUST))


def _opinion(
    parts: Parts,
    contacts: Contacts,
    vocabulary: Vocabulary,
    known: Probabilities | None,
    column: dict[tuple[str, str], int],
) -> Floats:
    """``(n_parts, n_classes)`` what the labeler alone holds for possible, never 0."""
    said = known if known is not None else _second_opinion(parts, contacts, vocabulary)
    values = np.zeros((parts.n_parts, len(column)))
    for k, pair in enumerate(said.classes):
        if pair in column:
            values[:, column[pair]] = said.values[:, k]
    total = values.sum(axis=1, keepdims=True)
    values = values / np.maximum(total, 1.0) + np.maximum(1.0 - total, 0.0) / len(column)
    return np.asarray((1 - _LOST) * values + _LOST / len(column), np.float64)


def _second_opinion(parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Probabilities:
    kept = store_of(contacts, "second opinion")
    key = parts, tuple((group, content.names) for group, content in vocabulary.groups.items())
    if key not in kept:
        verdicts = judge(default_model(), observe(parts, contacts), vocabulary)
        kept[key] = Probabilities(verdicts.classes, verdicts.names)
    found: Probabilities = kept[key]
    return found


def _votes_of_kin(
    parts: Parts, contacts: Contacts, labels: Sequence[Label | None], now: Ints, n_classes: int
) -> tuple[Floats, Floats]:
    """``(n_parts, n_classes)`` share of its kin that have each name, and ``(n_parts,)`` how much kin there is."""
    heads, weight = _kin(parts, contacts)
    trust = np.array([_vote(label) for label in labels])
    # A shape has one voice: that of a part of it that a user has settled, else of its first one.
    voice = _voices(parts, trust)[parts.shape[heads]] if heads.size else heads
    weight = weight * np.where(now[voice] >= 0, trust[voice], 0.0)
    votes = np.zeros((parts.n_parts, n_classes))
    rows = np.broadcast_to(np.arange(parts.n_parts)[:, None], heads.shape)
    np.add.at(votes, (rows, np.maximum(now[voice], 0)), weight)
    total = votes.sum(axis=1)
    return votes / np.maximum(total, 1e-12)[:, None], total


def _vote(label: Label | None) -> float:
    if label is None:
        return 0.0
    if label.source == "human":
        return _SETTLED
    return 0.5 if label.likely else 1.0


def _voices(parts: Parts, trust: Floats) -> Ints:
    """``(n_shapes,)`` for each shape the part that speaks for it."""
    order = np.lexsort((np.arange(parts.n_parts), -trust, parts.shape))
    shapes, first = np.unique(parts.shape[order], return_index=True)
    voices = np.full(int(parts.shape.max(initial=-1)) + 1, -1, np.int64)
    voices[shapes] = order[first]
    return voices


def _kin(parts: Parts, contacts: Contacts) -> tuple[Ints, Floats]:
    """``(n_parts, k)`` first parts of the other shapes that are closest to each part, and how much each counts."""
    kept = store_of(contacts, "kin")
    if parts not in kept:
        kept[parts] = _find_kin(parts, contacts)
    found: tuple[Ints, Floats] = kept[parts]
    return found


def _points(parts: Parts, contacts: Contacts) -> Floats:
    kept = store_of(contacts, "points of kinship")
    if parts not in kept:
        kept[parts] = default_model().kinship(observe(parts, contacts)).astype(np.float32)
    found: Floats = kept[parts]
    return found


def _find_kin(parts: Parts, contacts: Contacts) -> tuple[Ints, Floats]:
    points = _points(parts, contacts)
    shapes, first = np.unique(parts.shape, return_index=True)
    k = min(_N_KIN, len(first) - 1)
    heads = np.zeros((parts.n_parts, max(k, 0)), np.int64)
    weight = np.zeros(heads.shape)
    if k < 1:
        return heads, weight
    other, step = points[first], max(1, _AT_ONCE // len(first))
    for low in range(0, parts.n_parts, step):
        rows = slice(low, min(low + step, parts.n_parts))
        squares = np.maximum(2.0 - 2.0 * points[rows] @ other.T, 0.0)
        squares[parts.shape[rows][:, None] == shapes[None]] = np.inf
        nearest = np.argpartition(squares, k - 1, axis=1)[:, :k]
        far = np.take_along_axis(squares, nearest, axis=1)
        heads[rows], weight[rows] = first[nearest], np.exp(-far / _NEAR**2)
    return heads, weight
