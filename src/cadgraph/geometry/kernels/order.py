"""Sorting inside kernels, in few lines: numba's own sorts take seconds to compile."""

from __future__ import annotations

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["sort_rows"]

_RUN = 16


@compiled
def sort_rows(rows: Floats, low: int, high: int, spare: Floats) -> None:
    """Sorts rows ``low`` to ``high`` of two columns by the first, in place; equal ones keep their order.

    Args:
        rows: ``(n, 2)``: key, and anything that goes with it (an index is exact up to 2^53). No key is NaN.
        low: the first row to sort.
        high: the end of the rows to sort.
        spare: ``(m, 2)`` workspace, at least as many rows as are sorted.
    """
    for k in range(low + 1, high):
        x, y = rows[k, 0], rows[k, 1]
        # Short runs by insertion, each from its own start.
        start = k - (k - low) % _RUN
        at = k
        while at > start and rows[at - 1, 0] > x:
            rows[at, 0], rows[at, 1] = rows[at - 1, 0], rows[at - 1, 1]
            at -= 1
        rows[at, 0], rows[at, 1] = x, y
    width = _RUN
    while width < high - low:
        first = low
        while first + width < high:
            middle, last = first + width, min(first + 2 * width, high)
            if rows[middle - 1, 0] > rows[middle, 0]:
                for k in range(width):
                    spare[k, 0], spare[k, 1] = rows[first + k, 0], rows[first + k, 1]
                i, j, at = 0, middle, first
                # What is left of the second run when the first is used up is in its place already.
                while i < width:
                    if j < last and rows[j, 0] < spare[i, 0]:
                        rows[at, 0], rows[at, 1] = rows[j, 0], rows[j, 1]
                        j += 1
                    else:
                        rows[at, 0], rows[at, 1] = spare[i, 0], spare[i, 1]
                        i += 1
                    at += 1
            first += 2 * width
        width *= 2
