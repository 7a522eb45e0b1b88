"""The network that names parts: a look at each part's shape, then rounds of talk between neighbours.

Plain matrix products, so that nothing but numpy is needed to run it. Training is in ``cadlab.training``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np

from cadgraph.model.scene import Floats, Ints, blocks

__all__ = ["LIMIT", "Classifier", "Inputs", "Talk", "aggregate"]

_ROWS = 2_048  # parts that are looked at at once: what they come to fits a cache
LIMIT = 6.0
"""Standardised inputs are cut off here: what lies farther out was never seen in training."""


@dataclass(frozen=True)
class Inputs:
    """What a network sees of each part by itself.

    Args:
        shapes: ``(n_shapes, n)`` of each distinct shape.
        shape: ``(n_parts,)`` row of ``shapes``.
        places: ``(n_parts, m)`` of each part.
    """

    shapes: Floats
    shape: Ints
    places: Floats


@dataclass(frozen=True)
class Talk:
    """Who hears whom in a round of talk.

    Args:
        own: ``(n,)`` row of each that listens among what the round before came to.
        here: ``(n_sides,)`` who of them hears, ascending.
        there: ``(n_sides,)`` row of who speaks, among what the round before came to.
        sides: ``(n_sides, n_side_inputs)`` how they stand to each other.
    """

    own: Ints
    here: Ints
    there: Ints
    sides: Floats


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

    def scores(self, inputs: Floats | Inputs, sides: Floats, here: Ints, there: Ints) -> Floats:
        """The scores of all classes for each part, before they are made probabilities.

        Args:
            inputs: forms, sizes and places; also as ``(n_parts, n_inputs)`` side by side.
            sides: ``(n_sides, n_side_inputs)`` each contact from both sides, ascending by ``here``.
            here: ``(n_sides,)`` part.
            there: ``(n_sides,)`` its neighbour.

        Returns:
            ``(n_parts, n_classes)``.
        """
        h = self.hidden(inputs)
        return self.answers(h, [Talk(np.arange(len(h)), here, there, sides)] * self.rounds)

    def answers(self, h: Floats, talks: Sequence[Talk]) -> Floats:
        """The scores after neighbours have talked.

        Args:
            h: what ``hidden`` gave.
            talks: of each round.

        Returns:
            ``(n, n_classes)``, ``n`` being how many listen in the last round.
        """
        w = self.weights
        for k in range(self.rounds):
            given = h @ w[f"give{k}"]
            h = _by_rows(len(talks[k].own), partial(self._talk, k, h, given, talks[k]))
        return _by_rows(len(h), lambda some: _plus(h[some] @ w["out"], w["out_b"]))

    def _talk(self, k: int, h: Floats, given: Floats, talk: Talk, some: slice) -> Floats:
        """What some parts come to in a round of talk; ``given`` is what each part says to all of its neighbours."""
        w, own = self.weights, h[talk.own[some]]
        among = slice(*np.searchsorted(talk.here, [some.start, some.start + len(own)]).tolist())
        s = _standard(talk.sides[among], w["side_mean"], w["side_spread"])
        hearer = talk.here[among] - some.start
        said = given[talk.there[among]]
        said += s @ w[f"side{k}"]
        said += (own @ w[f"take{k}"])[hearer]
        said = _relu(_plus(said, w[f"talk_b{k}"]))
        both = np.empty((len(own), own.shape[1] + 2 * said.shape[1]))
        both[:, : own.shape[1]] = own
        both[:, own.shape[1] :] = aggregate(said, hearer, len(own))
        return _plus(_relu(_plus(both @ w[f"join{k}"], w[f"join_b{k}"])), own)

    def hidden(self, inputs: Floats | Inputs) -> Floats:
        """What the look at each part by itself comes to, before neighbours talk, ``(n_parts, width)``, not negative.

        Args:
            inputs: as for ``scores``.
        """
        if not isinstance(inputs, Inputs):
            rows = np.asarray(inputs)
            inputs = Inputs(rows[:, :0], np.zeros(len(rows), np.int64), rows)
        given = inputs
        return _by_rows(len(given.shape), lambda some: self._look(given, some))

    def _look(self, inputs: Inputs, some: slice) -> Floats:
        """Of parts of one shape, what follows from the shape is worked out once."""
        w, n = self.weights, inputs.shapes.shape[1]
        first = _standard(inputs.places[some], w["mean"][n:], w["spread"][n:]) @ w["w0"][n:]
        if n:
            rows, at = np.unique(inputs.shape[some], return_inverse=True)
            of_shapes = _standard(inputs.shapes[rows], w["mean"][:n], w["spread"][:n]) @ w["w0"][:n]
            first += of_shapes[at.reshape(-1)]
        return _relu(_plus(_relu(_plus(first, w["b0"])) @ w["w1"], w["b1"]))


def _by_rows(n: int, act: Callable[[slice], Floats]) -> Floats:
    """What some rows at a time come to, one below the other: all at once would take memory by the number of parts."""
    first = act(slice(0, min(_ROWS, n)))
    if n <= _ROWS:
        return first
    rows = np.empty((n, *first.shape[1:]))
    rows[:_ROWS] = first
    for some in islice(blocks(n, _ROWS), 1, None):
        rows[some] = act(some)
    return rows


def aggregate(said: Floats, here: Ints, n: int) -> Floats:
    """Mean and greatest of what each part heard, side by side; zeros where nobody speaks.

    Args:
        said: ``(n_sides, width)``, not negative.
        here: ``(n_sides,)`` who hears it, ascending.
        n: how many parts.
    """
    width = said.shape[1]
    heard = np.zeros((n, 2 * width))
    if len(here):
        hearers, starts, counts = np.unique(here, return_index=True, return_counts=True)
        heard[hearers, :width] = np.add.reduceat(said, starts, axis=0) / counts[:, None]
        heard[hearers, width:] = np.maximum.reduceat(said, starts, axis=0)
    return heard


def _standard(rows: Floats, mean: Floats, spread: Floats) -> Floats:
    standard = rows - mean
    standard /= spread
    return np.clip(standard, -LIMIT, LIMIT, out=standard)


# Arrays of all parts are large: what nobody else holds is changed in place.


def _plus(values: Floats, more: Floats) -> Floats:
    values += more
    return values


def _relu(values: Floats) -> Floats:
    return np.maximum(values, 0.0, out=values)
