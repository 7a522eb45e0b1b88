"""The network that names parts: a look at each part's shape, then rounds of talk between neighbours.

Plain matrix products, so that nothing but numpy is needed to run it. Training is in ``cadlab.training``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from cadgraph.model.scene import Floats, Ints

__all__ = ["LIMIT", "Classifier", "aggregate"]

_ROWS = 16_384  # parts that are looked at at once
LIMIT = 6.0
"""Standardised inputs are cut off here: what lies farther out was never seen in training."""


@dataclass(frozen=True)
class Classifier:
    """Weights of one network.

    Args:
        weights: ``mean``, ``spread`` ``(n_inputs,)`` of the inputs of parts, ``side_mean``, ``side_spread`` of those of
            neighbours; ``w0, b0, w1, b1`` of the look at the shape; for each round ``k`` the matrices ``give<k>``,
            ``side<k>``, ``take<k>``, ``talk_b<k>`` of the talk and ``join<k>``, ``join_b<k>`` of what is made of it;
            ``out``, ``out_b`` of the answer.
        rounds: of talk.
    """

    weights: Mapping[str, Floats]
    rounds: int

    def scores(self, inputs: Floats, sides: Floats, here: Ints, there: Ints) -> Floats:
        """The scores of all classes for each part, before they are made probabilities.

        Args:
            inputs: ``(n_parts, n_inputs)`` forms, sizes and places side by side.
            sides: ``(n_sides, n_side_inputs)`` each contact from both sides, ascending by ``here``.
            here: ``(n_sides,)`` part.
            there: ``(n_sides,)`` its neighbour.

        Returns:
            ``(n_parts, n_classes)``.
        """
        w = self.weights
        h = self.hidden(inputs)
        for k in range(self.rounds):
            given = h @ w[f"give{k}"]
            h = _by_rows(len(h), partial(self._talk, k, h, given, sides, here, there))
        return _by_rows(len(h), lambda some: h[some] @ w["out"] + w["out_b"])

    def _talk(self, k: int, h: Floats, given: Floats, sides: Floats, here: Ints, there: Ints, some: slice) -> Floats:
        """What some parts come to in a round of talk; ``given`` is what each part says to all of its neighbours."""
        w, own = self.weights, h[some]
        among = slice(*np.searchsorted(here, [some.start, some.start + len(own)]).tolist())
        s = np.clip((sides[among] - w["side_mean"]) / w["side_spread"], -LIMIT, LIMIT)
        hearer = here[among] - some.start
        said = _relu(given[there[among]] + s @ w[f"side{k}"] + (own @ w[f"take{k}"])[hearer] + w[f"talk_b{k}"])
        heard = aggregate(said, hearer, len(own))
        talked: Floats = own + _relu(np.hstack([own, heard]) @ w[f"join{k}"] + w[f"join_b{k}"])
        return talked

    def hidden(self, inputs: Floats) -> Floats:
        """What the look at each part by itself comes to, before neighbours talk, ``(n_parts, width)``, not negative.

        Args:
            inputs: as for ``scores``.
        """
        return _by_rows(len(inputs), lambda some: self._look(inputs[some]))

    def _look(self, inputs: Floats) -> Floats:
        w = self.weights
        x = np.clip((inputs - w["mean"]) / w["spread"], -LIMIT, LIMIT)
        return _relu(_relu(x @ w["w0"] + w["b0"]) @ w["w1"] + w["b1"])


def _by_rows(n: int, act: Callable[[slice], Floats]) -> Floats:
    """What some rows at a time come to, one below the other: all at once would take memory by the number of parts."""
    if n <= _ROWS:
        return act(slice(0, n))
    return np.concatenate([act(slice(start, min(start + _ROWS, n))) for start in range(0, n, _ROWS)])


def aggregate(said: Floats, here: Ints, n: int) -> Floats:
    """Mean and greatest of what each part heard, side by side; zeros where nobody speaks.

    Args:
        said: ``(n_sides, width)``, not negative.
        here: ``(n_sides,)`` who hears it, ascending.
        n: how many parts.
    """
    width = said.shape[1]
    total, most = np.zeros((n, width)), np.zeros((n, width))
    if len(here):
        hearers, starts, counts = np.unique(here, return_index=True, return_counts=True)
        total[hearers] = np.add.reduceat(said, starts, axis=0) / counts[:, None]
        most[hearers] = np.maximum.reduceat(said, starts, axis=0)
    return np.hstack([total, most])


def _relu(values: Floats) -> Floats:
    positive: Floats = np.maximum(values, 0.0)
    return positive
