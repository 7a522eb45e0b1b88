"""From probabilities to a label: the likeliest name, or its group alone, and the few that come next."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from cadgraph.model.labels import Guess
from cadgraph.model.scene import Floats

__all__ = ["Likeliest", "likeliest"]

_GUESSES = 5
_LEAST_GUESS = 0.0005


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
    order = np.argsort(-names, kind="stable")[:_GUESSES].tolist()
    guesses = tuple(
        Guess(classes[k][0], classes[k][1], round(float(names[k]), 4))
        for k in order
        if k == order[0] or names[k] >= _LEAST_GUESS
    )
    best, group = order[0], int(np.argmax(groups))
    if names[best] < least <= groups[group]:
        return Likeliest(group_names[group], None, min(1.0, float(groups[group])), guesses)
    return Likeliest(classes[best][0], classes[best][1], min(1.0, float(names[best])), guesses)
