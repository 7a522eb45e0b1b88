"""Many symmetric systems of equations with zeros in the same places, solved side by side.

The order of elimination is found once, by least degree; after that every step is one operation on all systems. Pipe
networks are nearly trees, so that hardly anything fills in, and a step costs little more than a number each.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Elimination"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]


@dataclass(frozen=True)
class _Step:
    """One unknown on its way out.

    Args:
        pivot: its number.
        others: ``(k,)`` the unknowns that its equation still holds.
        column: ``(k,)`` cells of these in the column of the pivot.
        first: ``(m,)`` for each cell that changes, which of the column's cells comes first in the product.
        second: ``(m,)`` and which comes second.
        cells: ``(m,)`` the cells that change.
    """

    pivot: int
    others: Ints
    column: Ints
    first: Ints
    second: Ints
    cells: Ints


class Elimination:
    """Solves systems that are symmetric and positive definite (LDL' without pivoting).

    Args:
        n: number of unknowns.
        pairs: the unknowns that stand in each other's equations; either way round, repeated at will.
    """

    def __init__(self, n: int, pairs: Iterable[tuple[int, int]]) -> None:
        self.n = n
        beside: list[set[int]] = [set() for _ in range(n)]
        for a, b in pairs:
            if a != b:
                beside[a].add(b)
                beside[b].add(a)
        self._cell = {(k, k): k for k in range(n)}
        self._steps: list[_Step] = []
        left = set(range(n))
        while left:
            pivot = min(left, key=lambda k: (len(beside[k]), k))
            left.remove(pivot)
            others = sorted(beside[pivot])
            for other in others:
                beside[other].remove(pivot)
                beside[other].update(each for each in others if each != other)
            self._steps.append(self._step(pivot, others))

    def _step(self, pivot: int, others: list[int]) -> _Step:
        column = [self.cell(other, pivot) for other in others]
        pairs = [(i, j) for i in range(len(others)) for j in range(i + 1)]
        cells = [self.cell(others[i], others[j]) for i, j in pairs]
        first, second = [i for i, _ in pairs], [j for _, j in pairs]
        return _Step(pivot, *(np.array(each, np.int64) for each in (others, column, first, second, cells)))

    def cell(self, a: int, b: int) -> int:
        """Where the coefficient of one unknown in the equation of another stands; that of itself at its own number."""
        return self._cell.setdefault((max(a, b), min(a, b)), len(self._cell))

    @property
    def size(self) -> int:
        """How many coefficients there are, with those that fill in."""
        return len(self._cell)

    def solve(self, cells: Floats, right: Floats) -> Floats:
        """The unknowns of all systems.

        Args:
            cells: ``(size, n_systems)`` coefficients, each pair once; what fills in is zero. Used up.
            right: ``(n, n_systems)`` or ``(n, n_sides, n_systems)`` right sides. Used up.

        Returns:
            What ``right`` was, now with the unknowns.
        """
        wide = right.ndim == 3
        for step in self._steps:
            pivot = cells[step.pivot]
            np.divide(1.0, pivot, out=pivot)
            if not len(step.others):
                continue
            column = cells[step.column]
            scaled = column * pivot
            cells[step.cells] -= column[step.first] * scaled[step.second]
            cells[step.column] = scaled
            right[step.others] -= (scaled[:, None] if wide else scaled) * right[step.pivot]
        for step in reversed(self._steps):
            here = right[step.pivot]
            here *= cells[step.pivot]
            if len(step.others):
                scaled = cells[step.column]
                here -= ((scaled[:, None] if wide else scaled) * right[step.others]).sum(axis=0)
        return right
