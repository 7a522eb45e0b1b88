"""The network that names parts: a look at each part's shape, then rounds of talk between neighbours.

Plain matrix products, so that nothing but numpy is needed to run it. Training is in ``cadlab.training``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats, Ints

__all__ = ["LIMIT", "Classifier", "aggregate"]

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
        s = np.clip((sides - w["side_mean"]) / w["side_spread"], -LIMIT, LIMIT)
        h = self.hidden(inputs)
        for k in range(self.rounds):
            said = _relu((h @ w[f"give{k}"])[there] + s @ w[f"side{k}"] + (h @ w[f"take{k}"])[here] + w[f"talk_b{k}"])
            heard = aggregate(said, here, len(h))
            h = h + _relu(np.hstack([h, heard]) @ w[f"join{k}"] + w[f"join_b{k}"])
        scores: Floats = h @ w["out"] + w["out_b"]
        return scores

    def hidden(self, inputs: Floats) -> Floats:
        """What the look at each part by itself comes to, before neighbours talk, ``(n_parts, width)``, not negative.

        Args:
            inputs: as for ``scores``.
        """
        w = self.weights
        x = np.clip((inputs - w["mean"]) / w["spread"], -LIMIT, LIMIT)
        return _relu(_relu(x @ w["w0"] + w["b0"]) @ w["w1"] + w["b1"])


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
