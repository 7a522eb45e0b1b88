"""Drawing at random."""

from __future__ import annotations

import numpy as np

__all__ = ["chance", "num"]


def num(rng: np.random.Generator, low: float, high: float) -> float:
    """A number between two."""
    return float(rng.uniform(low, high))


def chance(rng: np.random.Generator, share: float) -> bool:
    """Whether something happens that happens this often."""
    return bool(rng.random() < share)
