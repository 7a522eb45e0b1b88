"""Counts, and the shares that follow from them. A share of nothing is None, never 0 or 1."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["ClassScore", "Score", "mean", "share"]


def share(part: float, whole: float) -> float | None:
    """``part / whole``; None of nothing."""
    return part / whole if whole else None


def mean(values: list[float]) -> float | None:
    """The mean; None of nothing."""
    return share(sum(values), len(values))


@dataclass(frozen=True)
class Score:
    """How well a predicted set agrees with the true one.

    Args:
        n_true: size of the true set.
        n_predicted: size of the predicted set.
        n_correct: how many are in both.
    """

    n_true: int
    n_predicted: int
    n_correct: int

    @property
    def precision(self) -> float | None:
        """The correct share of the predicted."""
        return share(self.n_correct, self.n_predicted)

    @property
    def recall(self) -> float | None:
        """The found share of the true."""
        return share(self.n_correct, self.n_true)

    @property
    def f1(self) -> float | None:
        """The harmonic mean of precision and recall: 2 correct / (true + predicted)."""
        return share(2 * self.n_correct, self.n_true + self.n_predicted)


@dataclass(frozen=True)
class ClassScore(Score):
    """The score of one class; ``n_true`` is its support.

    Args:
        label: the class: a group, or ``group / name``.
    """

    label: str = ""
