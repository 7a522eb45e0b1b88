"""Labels: accuracy, scores of each class, confusion, calibration of confidence."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.truth import Truth
from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.scores import ClassScore, mean, share

__all__ = [
    "UNLABELLED",
    "Bin",
    "Calibration",
    "Confusion",
    "LabelScores",
    "Observation",
    "TaskScores",
    "calibrate",
    "observe_meshes",
    "observe_parts",
    "score_labels",
    "true_labels",
]

UNLABELLED = "unlabelled"
"""The last column of a confusion matrix: no label was given."""

N_BINS = 10
"""Reliability bins of equal width (Guo et al., On Calibration of Modern Neural Networks, 2017, section 2, use 15; a
plant's structure has a few hundred parts, which fill 10)."""

_Task = Callable[["Observation"], tuple[str | None, str | None] | None]


@dataclass(frozen=True)
class Observation:
    """One mesh or part, what it is, and what it was taken for.

    Args:
        structure: the true cluster, or None.
        true_group: of the truth.
        true_name: of the truth, or None where the truth leaves it open.
        group: predicted, or None.
        name: predicted, or None.
        confidence: of the prediction, or None.
    """

    structure: str | None
    true_group: str
    true_name: str | None
    group: str | None
    name: str | None
    confidence: float | None


@dataclass(frozen=True)
class Confusion:
    """How often a true class was taken for another.

    Args:
        labels: true classes (rows), ascending; classes that were only predicted are among them.
        columns: the same, then ``"unlabelled"``.
        counts: ``(n_labels, n_labels + 1)``.
    """

    labels: tuple[str, ...]
    columns: tuple[str, ...]
    counts: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class TaskScores:
    """One labelling task: groups alone, or names together with their groups.

    Args:
        n: how many have a true label.
        n_correct: how many got it.
        n_labelled: how many got any.
        classes: the score of each class that occurs in truth or prediction, ascending by label.
        confusion: of these classes.
    """

    n: int
    n_correct: int
    n_labelled: int
    classes: tuple[ClassScore, ...]
    confusion: Confusion

    @property
    def accuracy(self) -> float | None:
        """The correct share of all, the unlabelled included."""
        return share(self.n_correct, self.n)

    @property
    def accuracy_labelled(self) -> float | None:
        """The correct share of those that got a label."""
        return share(self.n_correct, self.n_labelled)

    @property
    def macro_f1(self) -> float | None:
        """The mean F1 of all classes that occur in truth or prediction (as scikit-learn's ``average="macro"``)."""
        return mean([score.f1 for score in self.classes if score.f1 is not None])


@dataclass(frozen=True)
class LabelScores:
    """All labels at one level.

    Args:
        level: ``"mesh"`` or ``"part"``.
        n: how many have a true group.
        n_unlabelled: how many of them got no label.
        group: groups.
        name: names; right where group and name are.
    """

    level: str
    n: int
    n_unlabelled: int
    group: TaskScores
    name: TaskScores

    @property
    def unlabelled(self) -> float | None:
        """The share that got no label."""
        return share(self.n_unlabelled, self.n)


@dataclass(frozen=True)
class Bin:
    """Parts of like confidence.

    Args:
        low: least confidence; in the bin from the second on only if greater.
        high: greatest confidence, included.
        n: how many parts.
        confidence: their mean confidence, or None.
        accuracy: their correct share, or None.
    """

    low: float
    high: float
    n: int
    confidence: float | None
    accuracy: float | None


@dataclass(frozen=True)
class Calibration:
    """How far confidence can be taken at its word.

    Args:
        task: ``"group"`` or ``"name"``.
        bins: of equal width, ascending.
        ece: expected calibration error: the mean over parts of the gap between accuracy and mean confidence of their
            bin (Guo et al. 2017, equation 3); None without any labelled part.
        mce: the greatest such gap (equation 5).
    """

    task: str
    bins: tuple[Bin, ...]
    ece: float | None
    mce: float | None


def true_labels(truth: Truth) -> list[GivenLabel]:
    """The labels of a truth as somebody gives them to a build: of each mesh whose group it knows."""
    return [GivenLabel(row.mesh, row.group, row.name) for row in truth.meshes if row.group is not None]


def observe_meshes(pairing: Pairing) -> tuple[Observation, ...]:
    """Each mesh with a true group, and the label of the part that holds it.

    Duplicates and hidden meshes that the graph dropped are left out; other lost meshes count as unlabelled.
    """
    lost = set(pairing.lost)
    found = []
    for row in pairing.truth.meshes:
        part = pairing.part_of_mesh.get(row.mesh)
        if row.group is not None and (part is not None or row.mesh in lost):
            found.append(
                _observed(pairing, pairing.structure_of_mesh.get(row.mesh), (row.group, row.name), part),
            )
    return tuple(found)


def observe_parts(pairing: Pairing) -> tuple[Observation, ...]:
    """Each part, and the truth of its largest labelled mesh."""
    found = []
    for part, mesh in pairing.head.items():
        row = pairing.rows[mesh]
        if row.group is not None:
            found.append(_observed(pairing, pairing.structure_of_part(part), (row.group, row.name), part))
    return tuple(found)


def score_labels(level: str, observations: Sequence[Observation]) -> LabelScores:
    """Scores all labels of one level."""
    return LabelScores(
        level=level,
        n=len(observations),
        n_unlabelled=sum(seen.group is None for seen in observations),
        group=_score(observations, _groups),
        name=_score(observations, _names),
    )


def calibrate(task: str, observations: Iterable[Observation], n_bins: int = N_BINS) -> Calibration:
    """Compares confidence with correctness.

    Args:
        task: ``"group"`` or ``"name"``.
        observations: those without a predicted label for the task, or without confidence, take no part.
        n_bins: of equal width over 0..1.
    """
    of_task = {"group": _groups, "name": _names}[task]
    members: list[list[tuple[float, bool]]] = [[] for _ in range(n_bins)]
    for seen in observations:
        pair = of_task(seen)
        if pair is not None and pair[1] is not None and seen.confidence is not None:
            # Rounded first, so that 0.3 in tenths falls into the third bin and not, by rounding noise, the fourth.
            place = math.ceil(round(seen.confidence * n_bins, 9)) - 1
            members[min(max(place, 0), n_bins - 1)].append((seen.confidence, pair[0] == pair[1]))
    bins = tuple(
        Bin(
            low=i / n_bins,
            high=(i + 1) / n_bins,
            n=len(inside),
            confidence=mean([confidence for confidence, _ in inside]),
            accuracy=mean([float(right) for _, right in inside]),
        )
        for i, inside in enumerate(members)
    )
    gaps = [(b.n, abs(b.accuracy - b.confidence)) for b in bins if b.accuracy is not None and b.confidence is not None]
    ece = share(sum(n * gap for n, gap in gaps), sum(n for n, _ in gaps))
    return Calibration(task, bins, ece, max((gap for _, gap in gaps), default=None))


def _observed(pairing: Pairing, structure: str | None, true: tuple[str, str | None], part: str | None) -> Observation:
    label = pairing.label(part) if part is not None else None
    node = pairing.graph.part(part) if part is not None else None
    confidence = node.label.confidence if node is not None and node.label is not None else None
    group, name = label if label is not None else (None, None)
    return Observation(structure, true[0], true[1], group, name, confidence)


def _groups(seen: Observation) -> tuple[str | None, str | None]:
    return seen.true_group, seen.group


def _names(seen: Observation) -> tuple[str | None, str | None] | None:
    """True and predicted name, each with its group; None where the truth leaves the name open."""
    if seen.true_name is None:
        return None
    predicted = f"{seen.group} / {seen.name}" if seen.group is not None and seen.name is not None else None
    return f"{seen.true_group} / {seen.true_name}", predicted


def _score(observations: Sequence[Observation], of_task: _Task) -> TaskScores:
    counts = Counter(pair for seen in observations if (pair := of_task(seen)) is not None)
    true, predicted = Counter[str](), Counter[str]()
    for (right, given), n in counts.items():
        if right is not None:
            true[right] += n
        if given is not None:
            predicted[given] += n
    labels = tuple(sorted({*true, *predicted}))
    columns: tuple[str | None, ...] = (*labels, None)
    return TaskScores(
        n=sum(true.values()),
        n_correct=sum(counts[label, label] for label in labels),
        n_labelled=sum(predicted.values()),
        classes=tuple(ClassScore(true[label], predicted[label], counts[label, label], label) for label in labels),
        confusion=Confusion(
            labels, (*labels, UNLABELLED), tuple(tuple(counts[row, column] for column in columns) for row in labels)
        ),
    )
