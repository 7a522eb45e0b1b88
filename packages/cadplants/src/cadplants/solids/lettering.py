"""Raised letters of fourteen strokes, as on dials, plates and signs; each letter is a mesh of its own."""

from __future__ import annotations

from cadgraph.model.scene import Floats
from cadplants.solids.mesh_ops import Solid, box, merge, moved, shared
from cadplants.solids.transforms import at, spun

__all__ = ["letters"]

# Strokes of a letter 2 wide and 4 high: from x, y to x, y.
_STROKES: dict[str, tuple[float, float, float, float]] = {
    "a": (0, 4, 2, 4), "b": (2, 4, 2, 2), "c": (2, 2, 2, 0), "d": (0, 0, 2, 0), "e": (0, 0, 0, 2), "f": (0, 2, 0, 4),
    "g": (0, 2, 1, 2), "h": (1, 2, 2, 2), "i": (0, 4, 1, 2), "j": (1, 4, 1, 2), "k": (2, 4, 1, 2), "l": (1, 2, 0, 0),
    "m": (1, 2, 1, 0), "n": (1, 2, 2, 0),
}  # fmt: skip

_LETTERS = {
    "0": "abcdef", "1": "bc", "2": "abghed", "3": "abhcd", "4": "fghbc", "5": "afghcd", "6": "afedcgh", "7": "abc",
    "8": "abcdefgh", "9": "abcdfgh", "A": "abcefgh", "B": "abcdjmh", "C": "afed", "D": "abcdjm", "E": "afedgh",
    "F": "afegh", "G": "afedch", "H": "fbecgh", "I": "adjm", "J": "bcde", "K": "fegkn", "L": "fed", "M": "fbecik",
    "N": "fbecin", "O": "abcdef", "P": "abfegh", "R": "abfeghn", "S": "afghcd", "T": "ajm", "U": "fedcb", "V": "fekl",
    "W": "fbecln", "X": "ikln", "Y": "ikm", "Z": "akld", "-": "gh", "/": "kl",
}  # fmt: skip


@shared
def _letter(letter: str, height: float, thick: float) -> Solid:
    """A letter in the plane z = 0 from its lower left corner, ``thick`` high; strokes are bars across each other."""
    step, half = height / 4, 0.07 * height
    bars = []
    for name in _LETTERS[letter]:
        x0, y0, x1, y1 = (value * step for value in _STROKES[name])
        length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
        # No bar ends in the plane of another's side: they run a little into each other.
        bar = box((length + 1.6 * half, 2 * half, thick), (length / 2, 0, thick / 2))
        slope = 0.0 if y0 == y1 else _angle(x1 - x0, y1 - y0)
        bars.append(moved(bar, at(x0, y0) @ spun("z", slope)))
    return merge(bars)


def _angle(x: float, y: float) -> float:
    from math import atan2

    return atan2(y, x)


def letters(text: str, height: float, thick: float) -> list[tuple[Solid, Floats]]:
    """The letters of a text about the origin in the plane z = 0, with where they stand.

    Args:
        text: of capitals, figures, hyphens, slashes; anything else is a space.
        height: of a capital [m].
        thick: how far they rise [m].
    """
    pitch = 0.78 * height
    low = -(len(text) * pitch - 0.28 * height) / 2
    return [
        (_letter(letter, round(height, 6), thick), at(low + k * pitch, -height / 2))
        for k, letter in enumerate(text)
        if letter in _LETTERS
    ]
