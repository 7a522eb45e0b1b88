"""Faults of texts: numbers, words, brackets and lines of a file are swapped, lost, doubled or made absurd."""

from __future__ import annotations

import random
import re

__all__ = ["NUMBERS", "WORDS", "spoil_text"]

NUMBERS = (
    "nan", "NaN", "inf", "-inf", "1e308", "-1e308", "1e400", "1e-320", "-1", "0", "-0.0", "1", "2147483647",
    "2147483648", "-2147483649", "4294967296", "9223372036854775807", "9223372036854775808", "18446744073709551616",
    "1" * 400, "0.1.2", "1e", "0x10", "1_000", "٣", "--1", "1,5",
)  # fmt: skip
"""That a reader may meet where it expects a sound one."""

WORDS = (
    "", "a", "/", "..", "../..", "/dev/zero", "a\x1b[31mred", "a\nb", "a\r", "\x00", "\ud800", "\ufeff", "\u202e",
    "%s%n", "{0}", "[bold]", "<b>&amp;", "null", "true", "None", "~", "*", "$", "x" * 5000, "é" * 300, "\U0001f600",
    "http://localhost:1/a", "file:///etc/hosts", "#1", "&a", "!!python/object:os.system", "@a.usda@",
)  # fmt: skip
"""That a reader may meet where it expects a name."""

_TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\n]|\'\')*\'|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|\w+|\s+|.', re.DOTALL
)
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_DEEP = (50, 1000, 20000)
_MOST = 1 << 18  # characters that a spoilt text has at most


def spoil_text(text: str, other: str, rng: random.Random) -> str:
    """One fault.

    Args:
        text: of a file.
        other: another one of its kind, that lines are taken from.
        rng: draws what and where.
    """
    if rng.random() < 0.3:
        return _spoil_lines(text, other, rng)[:_MOST]
    tokens = _TOKEN.findall(text)
    if not tokens:
        return other
    rng.choice(_FAULTS)(tokens, rng)
    return "".join(tokens)[:_MOST]


def _spoil_lines(text: str, other: str, rng: random.Random) -> str:
    lines, others = text.splitlines(keepends=True) or [""], other.splitlines(keepends=True) or [""]
    at, there = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(7):
        case 0:
            del lines[at]
        case 1:
            lines.insert(there, lines[at])
        case 2:
            lines[at], lines[there] = lines[there], lines[at]
        case 3:
            lines[at] = rng.choice(others)
        case 4:
            del lines[min(at, there) : max(at, there)]
        case 5:
            lines[at:at] = others[: rng.randrange(len(others) + 1)][-20:]
        case _:
            lines[at] = lines[at] * rng.choice((10, 1000))
    return "".join(lines)


def _number(tokens: list[str], rng: random.Random) -> None:
    where = [i for i, token in enumerate(tokens) if _NUMBER.fullmatch(token)]
    for at in rng.sample(where, min(len(where), rng.choice((1, 1, 1, 3)))):
        tokens[at] = rng.choice(NUMBERS)


def _other_number(tokens: list[str], rng: random.Random) -> None:
    """A number that stands elsewhere in the file: references to the wrong thing, and in circles."""
    where = [i for i, token in enumerate(tokens) if _NUMBER.fullmatch(token)]
    if where:
        tokens[rng.choice(where)] = tokens[rng.choice(where)]


def _word(tokens: list[str], rng: random.Random) -> None:
    where = [i for i, token in enumerate(tokens) if token[0] in "\"'" or token[0].isalpha()]
    if where:
        at = rng.choice(where)
        quote = tokens[at][0] if tokens[at][0] in "\"'" else ""
        tokens[at] = quote + rng.choice(WORDS) + quote


def _other_word(tokens: list[str], rng: random.Random) -> None:
    where = [i for i, token in enumerate(tokens) if token[0] in "\"'" or token[0].isalpha()]
    if where:
        tokens[rng.choice(where)] = tokens[rng.choice(where)]


def _lose(tokens: list[str], rng: random.Random) -> None:
    at = rng.randrange(len(tokens))
    del tokens[at : at + rng.choice((1, 1, 2, 7))]


def _double(tokens: list[str], rng: random.Random) -> None:
    at, n = rng.randrange(len(tokens)), rng.choice((1, 2, 7, 30))
    tokens[at:at] = tokens[at : at + n] * rng.choice((1, 1, 3, 100))


def _swap(tokens: list[str], rng: random.Random) -> None:
    a, b = rng.randrange(len(tokens)), rng.randrange(len(tokens))
    tokens[a], tokens[b] = tokens[b], tokens[a]


def _nest(tokens: list[str], rng: random.Random) -> None:
    """Brackets within brackets, more than a reader by recursion has room for."""
    opening, closing = rng.choice((("(", ")"), ("[", "]"), ("{", "}"), ("<a>", "</a>"), ('{"a":', "}"), ("- ", "")))
    depth, at = rng.choice(_DEEP), rng.randrange(len(tokens))
    tokens[at] = opening * depth + tokens[at] + (closing * depth if rng.random() < 0.7 else "")


_FAULTS = (_number, _number, _number, _other_number, _word, _word, _other_word, _lose, _double, _swap, _nest)
