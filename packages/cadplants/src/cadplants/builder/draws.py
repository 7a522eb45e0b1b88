"""What each of several values is drawn by, for ``several``: a number, a choice, a chance, a piece."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numpy as np

from cadplants.builder.params import Params, When

__all__ = ["made", "number", "of_form", "one_of", "yes"]

Rng = np.random.Generator
T = TypeVar("T")
P = TypeVar("P", bound=Params)


def yes(share: float) -> Callable[[Rng, Any], bool]:
    """Draws whether one of several things is so, that is so this often."""
    return lambda rng, _: bool(rng.random() < share)


def number(low: float, high: float) -> Callable[[Rng, Any], float]:
    """Draws a number of one of several things, all between two as likely."""
    return lambda rng, _: float(rng.uniform(low, high))


def one_of(*items: T) -> Callable[[Rng, Any], T]:
    """Draws which of some things one of several is, all as likely."""
    return lambda rng, _: items[int(rng.integers(len(items)))]


def made(piece: type[P], fixed: Callable[[Any], Mapping[str, Any]] = lambda _: {}) -> Callable[[Rng, Any], P]:
    """Draws one of several pieces, with what the fields before set of it."""
    return lambda rng, p: piece.draw(rng, fixed(p))


def of_form(*forms: str) -> When:
    """Tells whether something is of one of these forms, by its field ``form``: a ``when``."""
    return lambda p: p.form in forms
