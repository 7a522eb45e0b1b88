"""Which parts a network can't tell apart, so that it need look at one of them only.

In a large plant most parts repeat, and so do the parts around them: of ten thousand that stand in lines, some hundred
differ. What is said of one holds for all that see the very same numbers, bit by bit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.labelers.embedded.classifier import Inputs, Talk
from cadgraph.model.scene import Floats, Ints, ranges

__all__ = ["Alike", "find_alike"]


@dataclass(frozen=True)
class Alike:
    """Kinds of parts, before neighbours talk and after each round of it.

    Args:
        inputs: of one part of each kind, before the talk.
        talks: of each round, between kinds.
        kinds: ``(n_parts,)`` each, kind of every part: before the talk, after the first round, and so on.
    """

    inputs: Inputs
    talks: tuple[Talk, ...]
    kinds: tuple[Ints, ...]

    @property
    def n_kinds(self) -> int:
        """How many kinds there are after the last round."""
        return int(self.kinds[-1].max(initial=-1)) + 1

    def among_last(self, rounds: int) -> Ints:
        """``(n_kinds,)`` the kind after some rounds that each kind after the last one comes from."""
        kinds = np.zeros(self.n_kinds, np.int64)
        kinds[self.kinds[-1]] = self.kinds[rounds]
        return kinds


def find_alike(inputs: Inputs, sides: Floats, here: Ints, there: Ints, rounds: int) -> Alike:
    """Finds the parts that see the same; arguments as for ``Classifier.scores``.

    Args:
        inputs: of all parts.
        sides: of all contacts from both sides.
        here: part of each, ascending.
        there: its neighbour.
        rounds: of talk.
    """
    # Adding zero turns -0 into 0.
    first, kind = _distinct(np.column_stack([inputs.places + 0.0, inputs.shape.astype(np.float64)]))
    of_kinds = Inputs(inputs.shapes, inputs.shape[first], inputs.places[first])
    _, side = _distinct(sides + 0.0)
    starts = np.searchsorted(here, np.arange(len(inputs.shape) + 1))
    number = np.diff(starts)
    talks, kinds = [], [kind]
    for _ in range(rounds):
        first, after = _told_apart(kind, side, starts, there)
        rows = ranges(starts[first], number[first])
        hearer = np.repeat(np.arange(len(first)), number[first])
        talks.append(Talk(kind[first], hearer, kind[there[rows]], sides[rows]))
        kind = after
        kinds.append(kind)
    return Alike(of_kinds, tuple(talks), tuple(kinds))


def _told_apart(kind: Ints, side: Ints, starts: Ints, there: Ints) -> tuple[Ints, Ints]:
    """Kinds after a round, by the kind before and by what stands around in which order: a part of each, and of all."""
    after, number = np.empty(len(kind), np.int64), np.diff(starts)
    firsts: list[Ints] = [np.zeros(0, np.int64)]
    count = 0
    for many in np.unique(number).tolist():
        parts = np.flatnonzero(number == many)
        around = starts[parts][:, None] + np.arange(many)
        first, found = _distinct(np.column_stack([kind[parts], side[around], kind[there[around]]]))
        after[parts] = count + found
        firsts.append(parts[first])
        count += len(first)
    return np.concatenate(firsts), after


def _distinct(rows: npt.NDArray[Any]) -> tuple[Ints, Ints]:
    """A row of each kind, and the kind of each row."""
    if not len(rows) or not rows.shape[1]:
        return np.zeros(min(len(rows), 1), np.int64), np.zeros(len(rows), np.int64)
    whole = np.ascontiguousarray(rows).view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).reshape(-1)
    _, first, kind = np.unique(whole, return_index=True, return_inverse=True)
    return first, kind.reshape(-1)
