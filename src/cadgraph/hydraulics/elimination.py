"""Many symmetric systems of equations with zeros in the same places, solved side by side.

What is eliminated when is found once: at a time as many unknowns of few neighbours as have nothing to do with each
other. After that every step is a few operations on all systems. Pipe networks are nearly trees: hardly anything fills
in, and there are few steps.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import sparse

__all__ = ["Elimination"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

_FEW = 2  # neighbours of an unknown that may be eliminated beside others, though one with fewer is left


@dataclass(frozen=True)
class _Step:
    """Some unknowns on their way out.

    Args:
        pivots: ``(k,)`` their numbers.
        others: ``(c,)`` the unknowns that their equations still hold, one after the other.
        of: ``(c,)`` which of the pivots' equations each of these stands in.
        column: ``(c,)`` where its coefficient stands.
        first: ``(m,)`` of each product of two coefficients of one equation, the one.
        second: ``(m,)`` and the other.
        cells: ``(t,)`` the coefficients that products are taken off.
        to_cells: ``(t, m)`` which are taken off which.
        rest: ``(r,)`` the unknowns among ``others``, each once.
        to_rest: ``(r, c)`` where they stand.
        to_pivots: ``(k, c)`` which of ``others`` stand in which equation.
    """

    pivots: Ints
    others: Ints
    of: Ints
    column: Ints
    first: Ints
    second: Ints
    cells: Ints
    to_cells: sparse.csr_matrix
    rest: Ints
    to_rest: sparse.csr_matrix
    to_pivots: sparse.csr_matrix


class Elimination:
    """Solves systems that are symmetric and positive definite (LDL' without pivoting).

    Args:
        n: number of unknowns.
        pairs: the unknowns that stand in each other's equations; either way round, repeated at will.
    """

    def __init__(self, n: int, pairs: Iterable[tuple[int, int]]) -> None:
        beside: list[set[int]] = [set() for _ in range(n)]
        for a, b in pairs:
            if a != b:
                beside[a].add(b)
                beside[b].add(a)
        self._cell = {(k, k): k for k in range(n)}
        self._steps: list[_Step] = []
        left = set(range(n))
        while left:
            pivots = _apart(left, beside)
            equations = [sorted(beside[pivot]) for pivot in pivots]
            for pivot, others in zip(pivots, equations, strict=True):
                left.remove(pivot)
                for other in others:
                    beside[other].remove(pivot)
                    beside[other].update(each for each in others if each != other)
            self._steps.append(self._step(pivots, equations))

    def _step(self, pivots: Sequence[int], equations: Sequence[Sequence[int]]) -> _Step:
        others: list[int] = []
        of: list[int] = []
        column: list[int] = []
        products: list[tuple[int, int]] = []
        cells: list[int] = []
        for number, (pivot, equation) in enumerate(zip(pivots, equations, strict=True)):
            start = len(others)
            others += equation
            of += [number] * len(equation)
            column += [self.cell(other, pivot) for other in equation]
            pairs = [(i, j) for i in range(len(equation)) for j in range(i + 1)]
            products += [(start + i, start + j) for i, j in pairs]
            cells += [self.cell(equation[i], equation[j]) for i, j in pairs]
        targets, to_cells = _gathering(cells)
        rest, to_rest = _gathering(others)
        first, second = np.array(products, np.int64).reshape(-1, 2).T
        to_pivots = sparse.csr_matrix((np.ones(len(of)), (of, range(len(of)))), shape=(len(pivots), len(of)))
        return _Step(
            np.array(pivots, np.int64), np.array(others, np.int64), np.array(of, np.int64),
            np.array(column, np.int64), first, second, targets, to_cells, rest, to_rest, to_pivots,
        )  # fmt: skip

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
            right: ``(n, n_systems)`` right sides.

        Returns:
            ``(n, n_systems)``.
        """
        found, kept = right.copy(), []
        for step in self._steps:
            inverse = 1 / cells[step.pivots]
            column = cells[step.column]
            scaled = column * inverse[step.of]
            kept.append((inverse, scaled))
            if len(step.others):
                cells[step.cells] -= step.to_cells @ (column[step.first] * scaled[step.second])
                found[step.rest] -= step.to_rest @ (scaled * found[step.pivots[step.of]])
        for step, (inverse, scaled) in zip(reversed(self._steps), reversed(kept), strict=True):
            found[step.pivots] *= inverse
            if len(step.others):
                found[step.pivots] -= step.to_pivots @ (scaled * found[step.others])
        return found


def _apart(left: set[int], beside: Sequence[set[int]]) -> list[int]:
    """Unknowns with few neighbours of which none is another's, those with the fewest first."""
    ordered = sorted(left, key=lambda k: (len(beside[k]), k))
    most = max(_FEW, len(beside[ordered[0]]))
    chosen: list[int] = []
    taken: set[int] = set()
    for unknown in ordered:
        if len(beside[unknown]) > most:
            break
        if unknown not in taken:
            chosen.append(unknown)
            taken |= beside[unknown]
    return chosen


def _gathering(targets: Sequence[int]) -> tuple[Ints, sparse.csr_matrix]:
    """The numbers that there are, each once, and a matrix that adds up what belongs to each."""
    numbers, at = np.unique(np.array(targets, np.int64), return_inverse=True)
    ones, columns = np.ones(len(targets)), np.arange(len(targets))
    return numbers, sparse.csr_matrix((ones, (at, columns)), shape=(len(numbers), len(targets)))
