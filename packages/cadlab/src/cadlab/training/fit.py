"""Training of one network with torch; needed by ``make train`` only."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import nn

from cadgraph.labelers.embedded.classifier import LIMIT, Classifier
from cadgraph.labelers.embedded.surroundings import (
    PLACE_FEATURES,
    SCENE_FEATURES,
    SIDE_FEATURES,
    UP_FEATURES,
    UP_SIDES,
)
from cadgraph.model.scene import Floats, Ints
from cadlab.training.example import Example

__all__ = ["Recipe", "fit"]

_NEAR = ("neighbors", "alike around one", "held most", "alike touching", "borne")
"""What parts without neighbours have none of."""


@dataclass(frozen=True)
class Recipe:
    """How a network is made and trained.

    Args:
        hidden: width of the first layer.
        width: of what is known of a part.
        talk: of what neighbours say.
        rounds: of talk.
        epochs: times each plant is looked at.
        batch: plants at a time.
        rate: greatest learning rate.
        decay: of the weights.
        dropout: of what is known, and of inputs (a third of it).
        noise: added to standardised inputs.
        alone: share of the parts that are shown without neighbours.
        scattered: share of the plants whose parts are all shown without neighbours.
        deaf: share of the contacts that are left out.
        scale: spread of the logarithm of a random scale for each plant.
        sizeless: share of the plants that are shown without absolute sizes.
        upless: share of the plants that are shown without what depends on where up is.
        sceneless: share of the plants that are shown without what is known of the scene as a whole.
        smoothing: of the labels.
        balance: exponent of the frequency by which rare names weigh more.
    """

    hidden: int = 512
    width: int = 192
    talk: int = 48
    rounds: int = 3
    epochs: int = 14
    batch: int = 8
    rate: float = 2e-3
    decay: float = 0.02
    dropout: float = 0.3
    noise: float = 0.15
    alone: float = 0.2
    scattered: float = 0.15
    deaf: float = 0.15
    scale: float = 0.15
    sizeless: float = 0.15
    upless: float = 0.15
    sceneless: float = 0.25
    smoothing: float = 0.03
    balance: float = 0.5


class _Net(nn.Module):
    def __init__(self, n_inputs: int, n_sides: int, n_classes: int, recipe: Recipe) -> None:
        super().__init__()
        r = recipe
        self.recipe = r
        self.first, self.second = nn.Linear(n_inputs, r.hidden), nn.Linear(r.hidden, r.width)
        self.give = nn.ModuleList(nn.Linear(r.width, r.talk, bias=False) for _ in range(r.rounds))
        self.take = nn.ModuleList(nn.Linear(r.width, r.talk, bias=False) for _ in range(r.rounds))
        self.side = nn.ModuleList(nn.Linear(n_sides, r.talk) for _ in range(r.rounds))
        self.join = nn.ModuleList(nn.Linear(r.width + 2 * r.talk, r.width) for _ in range(r.rounds))
        self.out = nn.Linear(r.width, n_classes)
        self.drop, self.drop_in = nn.Dropout(r.dropout), nn.Dropout(r.dropout / 3)

    def forward(
        self, x: torch.Tensor, s: torch.Tensor, here: torch.Tensor, there: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor]:
        h = torch.relu(self.second(self.drop(torch.relu(self.first(self.drop_in(x))))))
        alone = self.out(self.drop(h))
        for give, take, side, join in zip(self.give, self.take, self.side, self.join, strict=True):
            said = torch.relu(give(h)[there] + side(s) + take(h)[here])
            index = here[:, None].expand_as(said)
            empty = torch.zeros(len(h), said.shape[1])
            mean = empty.scatter_reduce(0, index, said, "mean", include_self=False)
            most = empty.scatter_reduce(0, index, said, "amax", include_self=False)
            h = h + self.drop(torch.relu(join(torch.cat([h, mean, most], dim=1))))
        return self.out(self.drop(h)), alone


def fit(
    examples: Sequence[Example],
    classes: Sequence[str],
    recipe: Recipe,
    seed: int,
    told: Callable[[str], None] = lambda _: None,
) -> Classifier:
    """Trains one network.

    Args:
        examples: plants; parts whose label is not among the classes are seen, but not learnt from.
        classes: ``group/name``.
        recipe: how.
        seed: of the first weights, of the order and of what is left out.
        told: how far it is.
    """
    torch.manual_seed(seed)
    rng = np.random.default_rng([seed, 41])
    rank = {name: i for i, name in enumerate(classes)}
    targets = [np.array([rank.get(str(name), -1) for name in e.label]) for e in examples]
    weights = _weights(examples, targets, len(classes), recipe.balance)
    columns = _Columns.of(examples[0])
    mean, spread = _moments(np.vstack([_inputs(e) for e in examples]))
    side_mean, side_spread = _moments(np.vstack([e.sides for e in examples]))
    net = _Net(len(mean), len(side_mean), len(classes), recipe)
    steps = recipe.epochs * -(-len(examples) // recipe.batch)
    optimizer = torch.optim.AdamW(net.parameters(), recipe.rate, weight_decay=recipe.decay)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, recipe.rate, steps, pct_start=0.15)
    loss_of = nn.CrossEntropyLoss(reduction="none", label_smoothing=recipe.smoothing)
    net.train()
    for epoch in range(recipe.epochs):
        order, losses = rng.permutation(len(examples)), []
        for start in range(0, len(order), recipe.batch):
            x, s, here, there, y, w = _batch(
                [examples[i] for i in order[start : start + recipe.batch]],
                [targets[i] for i in order[start : start + recipe.batch]],
                [weights[i] for i in order[start : start + recipe.batch]],
                (mean, spread, side_mean, side_spread),
                columns, recipe, rng,
            )  # fmt: skip
            joint, alone = net(x, s, here, there)
            known = y >= 0
            loss = loss_of(joint[known], y[known]) + 0.3 * loss_of(alone[known], y[known])
            total = (loss * w[known]).sum() / w[known].sum().clamp(min=1e-9)
            optimizer.zero_grad()
            total.backward()
            nn.utils.clip_grad_norm_(net.parameters(), 2.0)
            optimizer.step()
            schedule.step()
            losses.append(total.item())
        told(f"epoch {epoch + 1} of {recipe.epochs}: loss {np.mean(losses):.3f}")
    return Classifier(
        {"mean": mean, "spread": spread, "side_mean": side_mean, "side_spread": side_spread, **_arrays(net)},
        recipe.rounds,
    )


@dataclass(frozen=True)
class _Columns:
    """Where some inputs stand among those of parts, and of sides."""

    sizes: slice
    near: Ints
    up: Ints
    scene: Ints
    up_sides: Ints

    @classmethod
    def of(cls, e: Example) -> _Columns:
        first = e.forms.shape[1] + e.sizes.shape[1]

        def places(names: Sequence[str]) -> Ints:
            return np.array([first + PLACE_FEATURES.index(name) for name in names], np.int64)

        return cls(
            slice(e.forms.shape[1], first), places(_NEAR), places(UP_FEATURES), places(SCENE_FEATURES),
            np.array([SIDE_FEATURES.index(name) for name in UP_SIDES], np.int64),
        )  # fmt: skip


def _inputs(e: Example) -> Floats:
    return np.hstack([e.forms[e.shape], e.sizes[e.shape], e.places]).astype(np.float64)


def _moments(values: Floats) -> tuple[Floats, Floats]:
    mean, spread = values.mean(axis=0), values.std(axis=0)
    return mean, np.where(spread > 1e-6, spread, 1.0)


def _weights(examples: Sequence[Example], targets: Sequence[Ints], n: int, balance: float) -> list[Floats]:
    """Each shape of a plant counts by the root of its repeats, and rare names more than common ones."""
    per_part = []
    for e in examples:
        repeats = np.bincount(e.shape)[e.shape]
        per_part.append(1 / np.sqrt(repeats))
    total = np.zeros(n)
    for y, w in zip(targets, per_part, strict=True):
        np.add.at(total, y[y >= 0], w[y >= 0])
    share = np.maximum(total / max(total.sum(), 1e-9), 1e-4)
    by_class = share**-balance
    return [w * by_class[np.maximum(y, 0)] for y, w in zip(targets, per_part, strict=True)]


def _batch(
    examples: Sequence[Example],
    targets: Sequence[Ints],
    weights: Sequence[Floats],
    moments: tuple[Floats, Floats, Floats, Floats],
    columns: _Columns,
    recipe: Recipe,
    rng: np.random.Generator,
) -> tuple[torch.Tensor, ...]:
    """Plants side by side, with some of what is known left out at random."""
    mean, spread, side_mean, side_spread = moments
    xs, ss, heres, theres, shift = [], [], [], [], 0
    for e in examples:
        x = _inputs(e)
        x[:, columns.sizes] += rng.normal(0, recipe.scale)
        alone = rng.random(len(x)) < recipe.alone
        scattered = rng.random() < recipe.scattered
        if scattered:
            alone[:] = True
        x[np.ix_(alone, columns.near)] = 0.0
        x = np.clip((x - mean) / spread, -LIMIT, LIMIT) + rng.normal(0, recipe.noise, x.shape)
        if rng.random() < recipe.sizeless:
            x[:, columns.sizes] = 0.0
        upless = rng.random() < recipe.upless
        if upless:
            x[:, columns.up] = 0.0
        if scattered or rng.random() < recipe.sceneless:
            x[:, columns.scene] = 0.0
        kept = ~alone[e.here] & ~alone[e.there] & (rng.random(len(e.here)) > recipe.deaf)
        s = np.clip((e.sides[kept] - side_mean) / side_spread, -LIMIT, LIMIT)
        s = s + rng.normal(0, recipe.noise, s.shape)
        if upless:
            s[:, columns.up_sides] = 0.0
        ss.append(s)
        xs.append(x)
        heres.append(e.here[kept] + shift)
        theres.append(e.there[kept] + shift)
        shift += len(x)
    as_float = [torch.from_numpy(np.vstack(rows).astype(np.float32)) for rows in (xs, ss)]
    as_int = [torch.from_numpy(np.concatenate(rows)) for rows in (heres, theres, targets)]
    return (*as_float, *as_int, torch.from_numpy(np.concatenate(weights).astype(np.float32)))


def _arrays(net: _Net) -> dict[str, Floats]:
    def matrix(layer: nn.Module) -> Floats:
        return np.asarray(layer.weight.detach().numpy().T, np.float64)

    def bias(layer: nn.Module) -> Floats:
        return np.asarray(layer.bias.detach().numpy(), np.float64)

    arrays = {"w0": matrix(net.first), "b0": bias(net.first), "w1": matrix(net.second), "b1": bias(net.second)}
    for k in range(net.recipe.rounds):
        arrays |= {
            f"give{k}": matrix(net.give[k]), f"take{k}": matrix(net.take[k]), f"side{k}": matrix(net.side[k]),
            f"talk_b{k}": bias(net.side[k]), f"join{k}": matrix(net.join[k]), f"join_b{k}": bias(net.join[k]),
        }  # fmt: skip
    return arrays | {"out": matrix(net.out), "out_b": bias(net.out)}
