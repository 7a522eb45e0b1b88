"""Nominal sizes by the standard tables of outer diameters."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from cadgraph.model.standards import outer_diameters

__all__ = ["PIPES", "nominal_size", "sizes_along", "table_of"]

PIPES, _HYGIENIC = "pipes", ("hygienic_tubes", "hygienic_tubes_inch")

# An outer diameter belongs to a size within this share. Ours: the widest that keeps neighbours apart from DN 15 up
# (DN 300 and 350 differ by 10 %), as drawn pipes are a polygon or a rounded figure.
_TOLERANCE = 0.045
# Tubes for food and pharmacy have outer diameters of their own, of which some lie between two sizes of pipes, or near
# one: they count where this share of a plant's length is as wide as these within this share of it, and no more than
# that one as wide as pipes. What is as wide as both (76 mm, 101.6 mm) says neither, but must not be too much. Ours.
_EXACT, _MOSTLY, _HARDLY, _ENOUGH = 0.006, 0.6, 0.2, 0.3
_MOST_KEPT = 1 << 16  # diameters; pipes of a plant have few


@lru_cache(maxsize=_MOST_KEPT)
def nominal_size(diameter: float, table: str = PIPES) -> int | None:
    """The nominal size (DN) of a pipe.

    Args:
        diameter: outer diameter [m].
        table: that sizes are of, as :func:`table_of` gives it.

    Returns:
        The size whose outer diameter in EN 10220 or ASME B36.10M is nearest, or of hygienic tubes in EN 10357 or
        ASME BPE; None where none is within 4.5 %.
    """
    off, size = min((abs(diameter / outer - 1), size) for size, outer in outer_diameters(table))
    return size if off <= _TOLERANCE else None


def table_of(pieces: Iterable[tuple[float, float]]) -> str:
    """The table that the sizes of a plant are of: that of pipes, but where most of them are hygienic tubes.

    Args:
        pieces: length and outer diameter of each piece of pipe of the plant [m].
    """
    known = list(pieces)
    total = sum(length for length, _ in known)
    for table in _HYGIENIC:
        both = tube = pipe = 0.0
        for length, diameter in known:
            as_tube, as_pipe = _is_exactly(diameter, table), _is_exactly(diameter, PIPES)
            both += length * (as_tube and as_pipe)
            tube += length * (as_tube and not as_pipe)
            pipe += length * (as_pipe and not as_tube)
        told = total - both
        if tube > _MOSTLY * told and pipe <= _HARDLY * told and tube >= _ENOUGH * total > 0:
            return table
    return PIPES


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
