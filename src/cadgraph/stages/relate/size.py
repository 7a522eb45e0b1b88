"""Nominal sizes by the standard tables of outer diameters."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from cadgraph.model.standards import outer_diameters

__all__ = ["PIPES", "nominal_size", "sizes_along", "table_of"]

PIPES, _HYGIENIC = "pipes", "hygienic_tubes"

# An outer diameter belongs to a size within this share. Ours: the widest that keeps neighbours apart from DN 15 up
# (DN 300 and 350 differ by 10 %), as drawn pipes are a polygon or a rounded figure.
_TOLERANCE = 0.045
# Tubes for food and pharmacy have outer diameters of their own, of which one lies between two sizes of pipes, or near
# another one: they count where this share of a plant's length is as wide as these within this share of it, and no more
# than that one as wide as pipes. Ours.
_EXACT, _MOSTLY, _HARDLY = 0.006, 0.6, 0.2
_MOST_KEPT = 1 << 16  # diameters; pipes of a plant have few


@lru_cache(maxsize=_MOST_KEPT)
def nominal_size(diameter: float, table: str = PIPES) -> int | None:
    """The nominal size (DN) of a pipe.

    Args:
        diameter: outer diameter [m].
        table: that sizes are of, as :func:`table_of` gives it.

    Returns:
        The size whose outer diameter in EN 10220 or ASME B36.10M is nearest, or of hygienic tubes in EN 10357; None
        where none is within 4.5 %.
    """
    off, size = min((abs(diameter / outer - 1), size) for size, outer in outer_diameters(table))
    return size if off <= _TOLERANCE else None


def table_of(pieces: Iterable[tuple[float, float]]) -> str:
    """The table that the sizes of a plant are of: that of pipes, but where most of them are hygienic tubes.

    Args:
        pieces: length and outer diameter of each piece of pipe of the plant [m].
    """
    total = hygienic = usual = 0.0
    for length, diameter in pieces:
        total += length
        hygienic += length * _is_exactly(diameter, _HYGIENIC)
        usual += length * _is_exactly(diameter, PIPES)
    return _HYGIENIC if hygienic > _MOSTLY * total and usual <= _HARDLY * total else PIPES


@lru_cache(maxsize=_MOST_KEPT)
def _is_exactly(diameter: float, table: str) -> bool:
    return any(abs(diameter / outer - 1) <= _EXACT for _, outer in outer_diameters(table))


def sizes_along(pieces: Sequence[tuple[float, float]], table: str = PIPES) -> tuple[int, ...]:
    """The sizes that a run has one after the other.

    Args:
        pieces: length and outer diameter of each piece of pipe along the run [m].
        table: that sizes are of.

    Returns:
        Each size where it begins; a piece without nominal size, and what is shorter than it is wide, says nothing.
    """
    found: list[int] = []
    for length, diameter in pieces:
        size = nominal_size(diameter, table) if length >= diameter else None
        if size is not None and (not found or found[-1] != size):
            found.append(size)
    return tuple(found)
