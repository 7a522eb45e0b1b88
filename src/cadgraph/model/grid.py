"""A grid of squares in plan, and which of its squares are free, as runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats, Ints

__all__ = ["Grid", "from_runs", "to_runs"]

_Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Grid:
    """Squares in plan.

    Args:
        origin: ``(x, y)`` of the corner where both are least [m].
        step: side of a square [m].
        size: squares along x, squares along y.
    """

    origin: tuple[float, float]
    step: float
    size: tuple[int, int]

    @classmethod
    def over(cls, low: npt.ArrayLike, high: npt.ArrayLike, step: float, most: int) -> Grid:
        """A grid over a box in plan; its corner is at whole steps, and its step is doubled until it has few squares.

        Args:
            low: ``(x, y, ...)`` least corner [m].
            high: likewise the greatest.
            step: side of a square [m].
            most: squares that it may have.
        """
        least, greatest = np.asarray(low, np.float64)[:2], np.asarray(high, np.float64)[:2]
        while True:
            # Rounded: what lies on a line of the grid stays on it whatever the machine's last digits.
            first, last = np.floor(np.round(least / step, 6)), np.ceil(np.round(greatest / step, 6))
            columns, rows = (max(1, int(n)) for n in last - first)
            if columns * rows <= most:
                return cls((float(first[0] * step), float(first[1] * step)), step, (columns, rows))
            step *= 2

    def square_of(self, points: npt.ArrayLike) -> Ints:
        """``(n, 2)`` column and row of points ``(n, 2 or 3)`` [m]; beyond the grid they are out of its size."""
        at = np.asarray(points, np.float64).reshape(len(np.atleast_2d(points)), -1)[:, :2]
        found: Ints = np.floor(np.round((at - self.origin) / self.step, 6)).astype(np.int64)
        return found

    def centers(self) -> tuple[Floats, Floats]:
        """The x of the columns' middles and y of the rows' [m]."""
        columns, rows = (np.arange(n, dtype=np.float64) + 0.5 for n in self.size)
        xs: Floats = (self.origin[0] + self.step * columns).astype(np.float64)
        ys: Floats = (self.origin[1] + self.step * rows).astype(np.float64)
        return xs, ys


def to_runs(free: _Bools) -> tuple[int, ...]:
    """The lengths of runs of squares, row by row: those that are not free first, then free ones, by turns.

    Args:
        free: ``(rows, columns)``.
    """
    flat = np.concatenate([[False], free.ravel()])
    turns = np.flatnonzero(flat[1:] != flat[:-1])
    bounds = np.concatenate([[0], turns, [free.size]])
    lengths: list[int] = np.diff(bounds).tolist()
    return tuple(lengths) if free.size else ()


def from_runs(runs: Sequence[int], size: tuple[int, int]) -> _Bools:
    """Which squares are free, from their runs.

    Args:
        runs: as :func:`to_runs` makes them.
        size: squares along x, squares along y.

    Returns:
        ``(rows, columns)``.
    """
    kinds = np.arange(len(runs)) % 2 == 1
    free: _Bools = np.repeat(kinds, np.asarray(runs, np.int64)).reshape(size[1], size[0])
    return free
