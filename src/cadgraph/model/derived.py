"""What follows from a value alone is worked out once, and kept as long as the value lives."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

__all__ = ["forget", "kept_with", "once_for_each", "store_of"]

# In the value itself: what is kept often leads back to the value, and a table of it would keep both for ever.
_KEPT = "_derived"
_P = ParamSpec("_P")
_R = TypeVar("_R")
_V = TypeVar("_V")


def kept_with(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Keeps what a pure function returns with its first argument.

    The same arguments (the very same objects, not equal ones) give the same result without work; when the first one is
    thrown away, so is what was kept with it. Only for functions that change nothing, on frozen values that are
    compared by identity.

    Args:
        function: takes its arguments by position.
    """

    @wraps(function)
    def once(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        if kwargs:
            return function(*args, **kwargs)
        first, rest = args[0], args[1:]
        known: list[tuple[tuple[Any, ...], _R]] = _kept(first).setdefault(once, [])
        for others, result in known:
            if len(others) == len(rest) and all(a is b for a, b in zip(others, rest, strict=True)):
                return result
        result = function(*args, **kwargs)
        known.append((rest, result))
        return result

    return once


def forget(value: object, function: Callable[..., object]) -> None:
    """Throws away what ``kept_with`` keeps of a function with a value; who asks again waits for it again."""
    _kept(value).pop(function, None)


def once_for_each(function: Callable[[_V], _R]) -> Callable[[_V], _R]:
    """A function that gives the same result for the very same object, for values that can't keep anything themselves.

    Args:
        function: pure. What it was asked of is kept as long as the new one lives.
    """
    known: dict[int, tuple[_V, _R]] = {}

    def once(value: _V) -> _R:
        found = known.get(id(value))
        if found is None:
            # With the value, as another one may get the number of one that is gone.
            found = known[id(value)] = value, function(value)
        return found[1]

    return once


def store_of(value: object, *name: object) -> dict[Any, Any]:
    """A place to keep what follows from single items of a frozen value: its lines, its pairs.

    Args:
        value: frozen, compared by identity; what is kept is thrown away with it.
        name: what is kept there, and the settings that it depends on.
    """
    found: dict[Any, Any] = _kept(value).setdefault(name, {})
    return found


def _kept(value: object) -> dict[Any, Any]:
    found: dict[Any, Any] = vars(value).setdefault(_KEPT, {})
    return found
