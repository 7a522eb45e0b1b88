"""Drawing at random."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

__all__ = ["pick"]

_T = TypeVar("_T")


def pick(rng: np.random.Generator, *items: _T) -> _T:
    """One of some things, all as likely."""
    return items[int(rng.integers(len(items)))]
