"""Faults of JSON documents: values of another type or an absurd size, keys lost, doubled or new, rows moved."""

from __future__ import annotations

import json
import random
from typing import Any

from cadlab.fuzz.tokens import WORDS

__all__ = ["spoil_json", "spoil_tree"]

_NUMBERS = (
    float("nan"), float("inf"), -float("inf"), 1e308, -1e308, 1e-320, -1, 0, 1, 2, 0.5, -0.0, 2**31 - 1, 2**31,
    -(2**31) - 1, 2**32, 2**53 + 1, 2**63, 2**64, 10**400, 1_000_000,
)  # fmt: skip
_OTHERS: tuple[Any, ...] = (
    None,
    True,
    False,
    "",
    [],
    {},
    [[]],
    [None],
    {"": None},
    ["a"] * 3,
    [1e308] * 16,
    "1",
    [0, 0, 0],
)


def spoil_json(text: str, other: str, rng: random.Random) -> str:
    """The text of a document with one fault in its tree; of what is no JSON any more, as it is."""
    try:
        tree, source = json.loads(text), json.loads(other)
    except (ValueError, RecursionError):
        return text
    return as_text(spoil_tree(tree, source, rng), rng)


def as_text(tree: Any, rng: random.Random) -> str:
    """A document as text; half of them keep letters beyond ASCII as they are, where these can be written at all."""
    text = json.dumps(tree, ensure_ascii=True)
    if rng.random() < 0.5:
        plain = json.dumps(tree, ensure_ascii=False)
        return text if any("\ud800" <= letter <= "\udfff" for letter in plain) else plain
    return text


def spoil_tree(tree: Any, other: Any, rng: random.Random) -> Any:
    """One fault in plain values, which are changed in place where they can be.

    Args:
        tree: the content of a document.
        other: that of another one of its kind, which values are taken from.
        rng: draws what and where.
    """
    places = list(_places(tree))
    if not places:
        return _value(None, rng)
    holder, key = rng.choice(places)
    kind = rng.randrange(9)
    if kind == 0:
        del holder[key]
    elif kind == 1:
        _move(holder, key, rng)
    elif kind == 2:
        there, that = rng.choice(places)
        holder[key], there[that] = there[that], _copy(holder[key])
    elif kind == 3:
        found = list(_places(other))
        there, that = rng.choice(found) if found else (holder, key)
        holder[key] = _copy(there[that])
    elif kind == 4:
        holder[key] = _nested(holder[key], rng)
    else:
        holder[key] = _value(holder[key], rng)
    return tree


def _places(tree: Any) -> Any:
    """Every (holder, key) of a tree."""
    waiting = [tree]
    while waiting:
        holder = waiting.pop()
        keys = list(holder) if isinstance(holder, dict) else range(len(holder)) if isinstance(holder, list) else ()
        for key in keys:
            yield holder, key
            waiting.append(holder[key])


def _move(holder: Any, key: Any, rng: random.Random) -> None:
    if isinstance(holder, dict):
        holder[rng.choice((*WORDS, *holder))] = holder.pop(key) if rng.random() < 0.5 else _copy(holder[key])
    else:
        holder[key:key] = [_copy(holder[key])] * rng.choice((1, 1, 2, 300))


def _nested(value: Any, rng: random.Random) -> Any:
    for _ in range(rng.choice((1, 2, 30, 400))):
        value = [value] if rng.random() < 0.5 else {"a": value}
    return value


def _value(old: Any, rng: random.Random) -> Any:
    """Mostly of the same type, as others are soon refused."""
    if isinstance(old, bool) or old is None or rng.random() < 0.3:
        return _copy(rng.choice((*_OTHERS, *_NUMBERS[:8], *WORDS[:8])))
    if isinstance(old, int | float):
        return rng.choice((*_NUMBERS, old + 1, -old, old * 1000))
    if isinstance(old, str):
        return rng.choice((*WORDS, old + " ", old.upper(), old[:-1], old * 3))
    return _copy(rng.choice(_OTHERS))


def _copy(value: Any) -> Any:
    """A deep copy without recursion to fall over; what is too deep is lost."""
    try:
        return json.loads(json.dumps(value))
    except (ValueError, RecursionError):
        return None
