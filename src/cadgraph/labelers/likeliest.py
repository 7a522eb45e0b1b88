"""From probabilities to a label: the likeliest name, or its group alone, and the few that come next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from cadgraph.model.labels import Guess
from cadgraph.model.scene import Floats

__all__ = ["Likeliest", "likeliest", "likeliest_of_all"]

_GUESSES = 5
_LEAST_GUESS = 0.0005
_AT_ONCE = 4096  # parts: sorting all at once would take memory by their number


class Likeliest(NamedTuple):
    """What a part most likely is.

    Args:
        group: of the label.
        name: in that group, or None where only the group is likely enough.
        confidence: how likely that is, 0..1.
        guesses: the likeliest names, the first of them first.
    """

    group: str
    name: str | None
    confidence: float
    guesses: tuple[Guess, ...]

    @property
    def said(self) -> tuple[str, str | None]:
        """Group and name."""
        return self.group, self.name


def likeliest(
    classes: Sequence[tuple[str, str]], names: Floats, group_names: Sequence[str], groups: Floats, least: float
) -> Likeliest:
    """The likeliest name; only its group where no name is likely enough but the group is.

    Args:
        classes: group and name of each of ``names``.
        names: ``(n_classes,)`` probabilities of one part.
        group_names: of ``groups``.
        groups: ``(n_groups,)`` their probabilities.
        least: confidence of a label.
    """
    return next(likeliest_of_all(classes, names[None], group_names, groups[None], [least]))


def likeliest_of_all(
    classes: Sequence[tuple[str, str]],
    names: Floats,
    group_names: Sequence[str],
    groups: Floats,
    least: Sequence[float],
) -> Iterator[Likeliest]:
    """What ``likeliest`` says of each part; guesses that are equal are one object, as most are in a large scene.

    Args:
        classes: group and name of each column of ``names``.
        names: ``(n_parts, n_classes)`` probabilities.
        group_names: of the columns of ``groups``.
        groups: ``(n_parts, n_groups)`` probabilities.
        least: confidence of a label of each part.
    """
    known: dict[tuple[int, float], Guess] = {}

    def guess(k: int, confidence: float) -> Guess:
        key = k, round(confidence, 4)
        found = known.get(key)
        if found is None:
            found = known[key] = Guess(*classes[k], key[1])
        return found

    for start in range(0, len(names), _AT_ONCE):
        some, those = names[start : start + _AT_ONCE], groups[start : start + _AT_ONCE]
        order = np.argsort(-some, axis=1, kind="stable")[:, :_GUESSES]
        rows = (
            order.tolist(), np.take_along_axis(some, order, axis=1).tolist(), those.argmax(axis=1).tolist(),
            those.max(axis=1).tolist(), least[start : start + _AT_ONCE],
        )  # fmt: skip
        for best, likely, group, together, limit in zip(*rows, strict=True):
            guesses = tuple(guess(k, p) for k, p in zip(best, likely, strict=True) if k == best[0] or p >= _LEAST_GUESS)
            if likely[0] < limit <= together:
                yield Likeliest(group_names[group], None, min(1.0, together), guesses)
            else:
                own_group, name = classes[best[0]]
                yield Likeliest(own_group, name, min(1.0, likely[0]), guesses)
