"""Drawing at random."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

__all__ = ["chance", "num", "pick"]

_T = TypeVar("_T")


def pick(rng: np.random.Generator, *items: _T) -> _T:
    """One of some things, all as likely."""
    return items[int(rng.integers(len(items)))]


def num(rng: np.random.Generator, low: float, high: float) -> float:
    """A number between two."""
    return float(rng.uniform(low, high))


def chance(rng: np.random.Generator, share: float) -> bool:
    """Whether something happens that happens this often."""
    return bool(rng.random() < share)
