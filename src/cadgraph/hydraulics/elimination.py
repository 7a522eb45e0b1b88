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

__all__ = ["Elimination", "Factors"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

_FEW = 2  # neighbours of an unknown that may be eliminated beside others, though one with fewer is left


@dataclass(frozen=True)
class _Sums:
    """Which numbers are taken off which: in turns, so that none is changed twice in one.

    Args:
        turns: for each turn, ``(k,)`` what is changed, and ``(k,)`` by which.
    """

    turns: tuple[tuple[Ints, Ints], ...]

    @classmethod
    def of(cls, targets: Sequence[int]) -> _Sums:
        """Those that take the numbers 0, 1... off these."""
        turns: list[tuple[list[int], list[int]]] = []
        met: dict[int, int] = {}
        for number, target in enumerate(targets):
            turn = met.get(target, 0)
            met[target] = turn + 1
            if turn == len(turns):
                turns.append(([], []))
            turns[turn][0].append(target)
            turns[turn][1].append(number)
        return cls(tuple((np.array(to, np.int64), np.array(by, np.int64)) for to, by in turns))

    def take(self, values: Floats, off: Floats) -> None:
        """Takes values ``(n, ...)`` off rows of an array, in place."""
        for to, by in self.turns:
            off[to] -= values[by]


@dataclass(frozen=True)
class _Step:
    """Some unknowns on their way out.

    Args:
        pivots: ``(k,)`` their numbers.
        others: ``(c,)`` the unknowns that their equations still hold, one after the other.
        of: ``(c,)`` which of the pivots' equations each of these stands in.
        owner: ``(c,)`` the pivot of that equation.
        column: ``(c,)`` where its coefficient stands.
        first: ``(m,)`` of each product of two coefficients of one equation, the one.
        second: ``(m,)`` and the other.
        off_cells: what products are taken off.
        off_others: what equations are taken off on the way down.
        off_pivots: and on the way back.
    """

    pivots: Ints
    others: Ints
    of: Ints
    owner: Ints
    column: Ints
    first: Ints
    second: Ints
    off_cells: _Sums
    off_others: _Sums
    off_pivots: _Sums


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
        first, second = np.array(products, np.int64).reshape(-1, 2).T
        owner = [pivots[number] for number in of]
        return _Step(
            np.array(pivots, np.int64), np.array(others, np.int64), np.array(of, np.int64), np.array(owner, np.int64),
            np.array(column, np.int64), first, second, _Sums.of(cells), _Sums.of(others), _Sums.of(owner),
        )  # fmt: skip

    def cell(self, a: int, b: int) -> int:
        """Where the coefficient of one unknown in the equation of another stands; that of itself at its own number."""
        return self._cell.setdefault((max(a, b), min(a, b)), len(self._cell))

    @property
    def size(self) -> int:
        """How many coefficients there are, with those that fill in."""
        return len(self._cell)

    def factors(self, cells: Floats) -> Factors:
        """All systems made ready to be solved.

        Args:
            cells: ``(size, n_systems)`` coefficients, each pair once; what fills in is zero. Used up.
        """
        kept = []
        for step in self._steps:
            inverse = 1 / cells[step.pivots]
            column = cells[step.column]
            scaled = column * inverse[step.of]
            kept.append((step, inverse, scaled))
            step.off_cells.take(column[step.first] * scaled[step.second], cells)
        return Factors(kept)


class Factors:
    """Systems that are ready to be solved, see :meth:`Elimination.factors`."""

    def __init__(self, kept: Sequence[tuple[_Step, Floats, Floats]]) -> None:
        self._kept = kept

    def of(self, systems: Ints) -> Factors:
        """Those of some systems."""
        return Factors([(step, inverse[:, systems], scaled[:, systems]) for step, inverse, scaled in self._kept])

    def solve(self, right: Floats) -> Floats:
        """The unknowns ``(n, n_systems)`` of all systems.

        Args:
            right: ``(n, n_systems)`` right sides.
        """
        found = right.copy()
        for step, _, scaled in self._kept:
            step.off_others.take(scaled * found[step.owner], found)
        for step, inverse, scaled in reversed(self._kept):
            found[step.pivots] *= inverse
            step.off_pivots.take(scaled * found[step.others], found)
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
