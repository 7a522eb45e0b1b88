"""Nominal sizes by the standard tables of outer diameters."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["nominal_size", "sizes_along"]

# Outer diameters [mm] by nominal size DN: EN 10220 series 1 and ISO 4200, and where it differs ASME B36.10M.
_OUTER: tuple[tuple[int, tuple[float, ...]], ...] = (
    (6, (10.2, 10.3)), (8, (13.5, 13.7)), (10, (17.2, 17.1)), (15, (21.3,)), (20, (26.9, 26.7)), (25, (33.7, 33.4)),
    (32, (42.4, 42.2)), (40, (48.3,)), (50, (60.3,)), (65, (76.1, 73.0)), (80, (88.9,)), (90, (101.6,)),
    (100, (114.3,)), (125, (139.7, 141.3)), (150, (168.3,)), (200, (219.1,)), (250, (273.0,)), (300, (323.9, 323.8)),
    (350, (355.6,)), (400, (406.4,)), (450, (457.0,)), (500, (508.0,)), (550, (559.0,)), (600, (610.0,)),
    (700, (711.0,)), (800, (813.0,)), (900, (914.0,)), (1000, (1016.0,)), (1200, (1219.0,)),
)  # fmt: skip
# An outer diameter belongs to a size within this share. Ours: the widest that keeps neighbours apart from DN 15 up
# (DN 300 and 350 differ by 10 %), as drawn pipes are a polygon or a rounded figure.
_TOLERANCE = 0.045


def nominal_size(diameter: float) -> int | None:
    """The nominal size (DN) of a pipe.

    Args:
        diameter: outer diameter [m].

    Returns:
        The size whose outer diameter in EN 10220 or ASME B36.10M is nearest; None where none is within 4.5 %.
    """
    off, size = min((abs(1000 * diameter / outer - 1), size) for size, outers in _OUTER for outer in outers)
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
