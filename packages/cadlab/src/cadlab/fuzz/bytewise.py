"""Faults of bytes: what a broken disk, a cut-off copy or a hostile hand does to any file."""

from __future__ import annotations

import random
import struct

__all__ = ["spoil_bytes"]

_WORDS = (0, 1, 2, 0x7F, 0x80, 0xFF, 0x100, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE)
_FLOATS = (float("nan"), float("inf"), -float("inf"), 1e308, -1.0, 1e-320, 0.0, 3.4e38, 1e30)
_MOST = 1 << 18  # bytes that a spoilt file has at most


def spoil_bytes(data: bytes, other: bytes, rng: random.Random) -> bytes:
    """One fault.

    Args:
        data: of a file.
        other: another file of its kind, that pieces are taken from.
        rng: draws what and where.
    """
    if not data:
        return other
    return rng.choice(_FAULTS)(data, other, rng)[:_MOST]


def _flip(data: bytes, _: bytes, rng: random.Random) -> bytes:
    spoilt = bytearray(data)
    for _n in range(rng.choice((1, 1, 2, 8))):
        spoilt[rng.randrange(len(spoilt))] ^= 1 << rng.randrange(8)
    return bytes(spoilt)


def _set(data: bytes, _: bytes, rng: random.Random) -> bytes:
    spoilt = bytearray(data)
    spoilt[rng.randrange(len(spoilt))] = rng.choice((0, 1, 9, 10, 27, 0x7F, 0x80, 0xFF, rng.randrange(256)))
    return bytes(spoilt)


def _truncate(data: bytes, _: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data))]


def _delete(data: bytes, _: bytes, rng: random.Random) -> bytes:
    start, length = _piece(data, rng)
    return data[:start] + data[start + length :]


def _repeat(data: bytes, _: bytes, rng: random.Random) -> bytes:
    start, length = _piece(data, rng)
    return data[:start] + data[start : start + length] * rng.choice((2, 2, 3, 50)) + data[start + length :]


def _insert(data: bytes, _: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.randbytes(rng.choice((1, 2, 4, 17))) + data[at:]


def _splice(data: bytes, other: bytes, rng: random.Random) -> bytes:
    start, length = _piece(other, rng) if other else (0, 0)
    at = rng.randrange(len(data) + 1)
    return data[:at] + other[start : start + length] + data[at + (length if rng.random() < 0.5 else 0) :]


def _cross(data: bytes, other: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data) + 1)] + other[rng.randrange(len(other) + 1) :]


def _word(data: bytes, _: bytes, rng: random.Random) -> bytes:
    """A number in one of the ways that binary formats hold numbers, most often where they align."""
    order = rng.choice("<>")
    number = rng.choice(_WORDS)
    packed = rng.choice(
        (
            struct.pack(order + "I", number),
            struct.pack(order + "Q", number << rng.choice((0, 31))),
            struct.pack(order + "H", number & 0xFFFF),
            struct.pack(order + "f", _single(rng.choice(_FLOATS))),
            struct.pack(order + "d", rng.choice(_FLOATS)),
        )
    )
    at = rng.randrange(len(data))
    at -= at % 4 if rng.random() < 0.8 else 0
    return data[:at] + packed + data[at + len(packed) :]


def _single(number: float) -> float:
    return number if abs(number) <= 3.4e38 or number != number or abs(number) == float("inf") else 3.4e38


def _piece(data: bytes, rng: random.Random) -> tuple[int, int]:
    return rng.randrange(len(data)), rng.choice((1, 2, 4, 8, 16, 64, 256))


_FAULTS = (_flip, _flip, _set, _truncate, _delete, _repeat, _insert, _splice, _cross, _word, _word, _word)
