"""How good a network is on plants whose parts are known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.labelers.embedded.labeler import spread
from cadgraph.labelers.embedded.model import STRANGE, Model
from cadgraph.model.scene import Floats, Ints
from cadlab.training.example import Example, Texts

__all__ = [
    "Answers",
    "Scores",
    "answer",
    "calibration_error",
    "error_of_families",
    "joined",
    "least_confidence",
    "score",
    "temperature",
]

_BINS = 15
_NO_LABEL = ("", "/")  # of what the truth doesn't name, such as insulation


@dataclass(frozen=True)
class Answers:
    """What a network says of many parts, and what these are.

    Args:
        truth: ``(n,)`` ``group/name``.
        name: ``(n,)`` the likeliest.
        group: ``(n,)`` the likeliest.
        confidence: ``(n,)`` of the name.
        group_confidence: ``(n,)`` of the group.
        family: ``(n,)`` of the part.
        style: ``(n,)`` its style.
    """

    truth: Texts
    name: Texts
    group: Texts
    confidence: Floats
    group_confidence: Floats
    family: Texts
    style: Texts

    def where(self, chosen: npt.NDArray[np.bool_]) -> Answers:
        """Those of some parts."""
        return Answers(**{key: getattr(self, key)[chosen] for key in Answers.__annotations__})

    @property
    def strange(self) -> npt.NDArray[np.bool_]:
        """``(n,)`` whether each part belongs to no plant, so that it is to stay open."""
        found: npt.NDArray[np.bool_] = self.truth == STRANGE
        return found

    @property
    def sureness(self) -> Floats:
        """``(n,)`` by which it is decided whether a part gets a label: the confidence of its name, or of its group."""
        return np.maximum(self.confidence, self.group_confidence)

    @property
    def true_group(self) -> Texts:
        """``(n,)`` group of what each part is."""
        return np.array([str(text).split("/")[0] for text in self.truth], np.str_)


@dataclass(frozen=True)
class Scores:
    """Figures of one trial.

    Args:
        parts: how many.
        name: share named right, whatever the confidence.
        group: share put into the right group.
        macro: mean F1 over the names that occur.
        ece: expected calibration error of the names' confidence.
        kept: share that gets a label at the model's threshold.
        precision: share of these that are put into the right group.
    """

    parts: int
    name: float
    group: float
    macro: float
    ece: float
    kept: float
    precision: float


def answer(
    model: Model,
    examples: Sequence[Example],
    repeats: bool = True,
    change: Callable[[Example], Example] = lambda example: example,
) -> Answers:
    """Asks a model about all parts that have a label.

    Args:
        model: any.
        examples: plants; of none there are no answers.
        repeats: whether repeats of one shape agree among themselves.
        change: what is done to each plant before.
    """
    classes = np.array(model.classes, np.str_)
    groups_of = [text.split("/")[0] for text in model.classes]
    groups = np.array(list(dict.fromkeys(groups_of)), np.str_)
    belongs = np.array([[group == own for group in groups] for own in groups_of], np.float64)
    rows: list[tuple[npt.NDArray[np.generic], ...]] = []
    for original in examples:
        e = change(original)
        inputs = np.hstack([e.forms[e.shape], e.sizes[e.shape], e.places]).astype(np.float64)
        scores = np.zeros((len(inputs), len(classes)))
        for member in model.members:
            scores += member.scores(inputs, e.sides.astype(np.float64), e.here, e.there)
        p = model.pooled(scores)
        p = spread(p, e.shape) if repeats else p
        told = p.copy()
        told[:, classes == STRANGE] = 0.0  # never an answer, but it takes its share of the confidence
        by_group = told @ belongs
        kept = ~e.ground & ~np.isin(e.label, _NO_LABEL)
        rows.append(
            tuple(
                values[kept]
                for values in (
                    e.label, classes[told.argmax(axis=1)], groups[by_group.argmax(axis=1)], told.max(axis=1),
                    by_group.max(axis=1), e.family, e.style,
                )
            )
        )  # fmt: skip
    if not rows:
        text, number = np.empty(0, np.str_), np.empty(0)
        return Answers(text, text, text, number, number, text, text)
    columns = [np.concatenate(column) for column in zip(*rows, strict=True)]
    return Answers(**dict(zip(Answers.__annotations__, columns, strict=True)))


def score(answers: Answers, threshold: float) -> Scores:
    """Figures over some parts, strangers left out."""
    answers = answers.where(~answers.strange)
    n = len(answers.truth)
    if not n:
        return Scores(0, *[float("nan")] * 6)
    right = answers.name == answers.truth
    kept = answers.sureness >= threshold
    return Scores(
        n, float(right.mean()), float((answers.group == answers.true_group).mean()), _macro(answers),
        calibration_error(answers.confidence, right), float(kept.mean()),
        float((answers.group == answers.true_group)[kept].mean()) if kept.any() else float("nan"),
    )  # fmt: skip


def error_of_families(answers: Answers) -> tuple[float, float]:
    """Standard errors of the shares of groups and of names that are right, had other families been held out: the parts
    of one family are right or wrong together (the cluster-robust error of a mean).

    Args:
        answers: about any parts, strangers left out.
    """
    answers = answers.where(~answers.strange)
    family = np.unique(answers.family, return_inverse=True)[1].reshape(-1)

    def error(right: npt.NDArray[np.bool_]) -> float:
        off = np.bincount(family, weights=right - right.mean()) if len(right) else np.zeros(1)
        return float(np.sqrt((off**2).sum()) / max(len(right), 1))

    return error(answers.group == answers.true_group), error(answers.name == answers.truth)


def _macro(answers: Answers) -> float:
    true, said = Counter(answers.truth.tolist()), Counter(answers.name.tolist())
    both = Counter(answers.truth[answers.truth == answers.name].tolist())
    return float(np.mean([2 * both[name] / (true[name] + said[name]) for name in true]))


def calibration_error(confidence: Floats, right: npt.NDArray[np.bool_]) -> float:
    """Expected calibration error over 15 even bins of confidence (Guo et al. 2017)."""
    place: Ints = np.minimum((confidence * _BINS).astype(np.int64), _BINS - 1)
    count = np.bincount(place, minlength=_BINS)
    gap = np.abs(
        np.bincount(place, weights=confidence, minlength=_BINS)
        - np.bincount(place, weights=right.astype(float), minlength=_BINS)
    )
    return float(gap.sum() / max(count.sum(), 1))


def least_confidence(answers: Answers, precision: float, by_group: bool = False) -> float:
    """The least threshold above which at least this share of the answers is right; just below 1 if there is none.

    Args:
        answers: about any parts; strangers are never right.
        precision: 0..1.
        by_group: whether the group counts, and its confidence, in place of the name.
    """
    confidence = answers.group_confidence if by_group else answers.confidence
    order = np.argsort(-confidence, kind="stable")
    right = (answers.group == answers.true_group if by_group else answers.name == answers.truth)[order]
    share = np.cumsum(right) / np.arange(1, len(right) + 1)
    good = np.nonzero(share >= precision)[0]
    return float(confidence[order[good[-1]]]) if len(good) else 0.999


def joined(*answers: Answers) -> Answers:
    """Several answers as one."""
    return Answers(**{name: np.concatenate([getattr(a, name) for a in answers]) for name in Answers.__annotations__})


def temperature(ask: Callable[[float], Answers]) -> float:
    """The temperature, of a grid, that makes confidence agree best with how often names are right.

    Args:
        ask: what a model says at a temperature.
    """
    grid = np.geomspace(0.4, 2.5, 12)
    errors = []
    for value in grid:
        told = ask(float(value))
        errors.append(calibration_error(told.confidence, told.name == told.truth))
    return float(grid[int(np.argmin(errors))])
