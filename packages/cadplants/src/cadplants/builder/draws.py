"""What fields are drawn by: each of several values, for ``several``; pieces of some makes; of what form one is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any, TypeVar, cast

import numpy as np

from cadplants.builder.params import Params, Source, When, among

__all__ = ["made", "number", "of_form", "of_makes", "one_of", "own_stream", "yes"]

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


def own_stream(source: Source, _: Any) -> Rng:
    """A stream from one number of a field's source, for pieces that are drawn apart from the device: a ``stream``."""
    return np.random.default_rng(int(source.rng.integers(1 << 30)))


def of_form(*forms: str) -> When:
    """Tells whether something is of one of these forms, by its field ``form``: a ``when``."""
    return lambda p: p.form in forms


@cache
def of_makes(
    kind: type[P], makes: tuple[str, ...], fit: Callable[[tuple[str, ...], float], Sequence[str]] | None = None
) -> type[P]:
    """A class of pieces as another, whose field ``make`` is drawn from some makes only.

    Args:
        kind: the class.
        makes: to draw from; what stands twice is twice as likely.
        fit: which of them there are in their place for a field ``radius`` [m]; they themselves if None.
    """
    choices = makes if fit is None else lambda p: fit(makes, p.radius)
    make = among(choices, kind.fields()["make"].about)
    said = {"make": make, "__annotations__": {"make": "str"}, "__doc__": kind.__doc__, "__module__": kind.__module__}
    return cast(type[P], type(kind.__name__, (kind,), said))
