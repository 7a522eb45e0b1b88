"""Nominal sizes by the standard tables of outer diameters."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from cadgraph.model.standards import outer_diameters

__all__ = ["nominal_size", "sizes_along"]

# An outer diameter belongs to a size within this share. Ours: the widest that keeps neighbours apart from DN 15 up
# (DN 300 and 350 differ by 10 %), as drawn pipes are a polygon or a rounded figure.
_TOLERANCE = 0.045
_MOST_KEPT = 1 << 16  # diameters; pipes of a plant have few


@lru_cache(maxsize=_MOST_KEPT)
def nominal_size(diameter: float) -> int | None:
    """The nominal size (DN) of a pipe.

    Args:
        diameter: outer diameter [m].

    Returns:
        The size whose outer diameter in EN 10220 or ASME B36.10M is nearest; None where none is within 4.5 %.
    """
    off, size = min((abs(diameter / outer - 1), size) for size, outer in outer_diameters())
    return size if off <= _TOLERANCE else None


def sizes_along(pieces: Sequence[tuple[float, float]]) -> tuple[int, ...]:
    """The sizes that a run has one after the other.

    Args:
        pieces: length and outer diameter of each piece of pipe along the run [m].

    Returns:
        Each size where it begins; a piece without nominal size, and what is shorter than it is wide, says nothing.
    """
    found: list[int] = []
    for length, diameter in pieces:
        size = nominal_size(diameter) if length >= diameter else None
        if size is not None and (not found or found[-1] != size):
            found.append(size)
    return tuple(found)
