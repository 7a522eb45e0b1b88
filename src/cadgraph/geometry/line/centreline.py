"""The line along the middle of a tube: straight, bent or branched, with the radius along it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.scene import Floats

__all__ = ["Branch", "Centreline", "End", "Junction", "NotTube"]


@dataclass(frozen=True, eq=False)
class Branch:
    """One run of a centreline between ends or junctions.

    Args:
        points: ``(n, 3)`` [m]; the first equals the last where ``closed``.
        radius: ``(n,)`` outer radius, of the circle through the corners of the section [m].
        bore: ``(n,)`` radius of the inner wall [m], NaN where there is none.
        closed: whether it returns to its start, as the rim of a handwheel does.
    """

    points: Floats
    radius: Floats
    bore: Floats
    closed: bool = False

    @cached_property
    def length(self) -> float:
        """Length along the line [m]."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    @cached_property
    def widest(self) -> float:
        """The greatest outer radius along it [m]."""
        return float(self.radius.max())

    @cached_property
    def narrowest(self) -> float:
        """The least outer radius along it [m]."""
        return float(self.radius.min())

    def placed(self, turns: Floats, shifts: Floats) -> Iterator[Branch]:
        """The same run in other places; arguments as for ``Centreline.placed``."""
        # A place changes neither its length nor its radii, which are asked for of every line of a plant.
        known = {"length": self.length, "widest": self.widest, "narrowest": self.narrowest}
        for points in np.matmul(self.points, turns.transpose(0, 2, 1)) + shifts[:, None]:
            there = Branch(points, self.radius, self.bore, self.closed)
            there.__dict__.update(known)
            yield there


@dataclass(frozen=True)
class End:
    """A free end of a centreline.

    Args:
        point: ``(3,)`` [m].
        direction: ``(3,)`` unit vector outward.
        radius: outer radius [m].
        bore: radius of the inner wall [m], NaN where there is none.
        branch: index of its branch.
    """

    point: Floats
    direction: Floats
    radius: float
    bore: float
    branch: int


@dataclass(frozen=True)
class Junction:
    """A point where three or more branches meet.

    Args:
        point: ``(3,)`` [m].
        branches: indices of the branches that start or end there; one that does both is named twice.
    """

    point: Floats
    branches: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Centreline:
    """The centreline of a tube-like part.

    Args:
        branches: at least one.
        ends: the free ends, by branch.
        junctions: where branches meet.
        share: share of the surface that runs along the branches, 0..1.
    """

    branches: tuple[Branch, ...]
    ends: tuple[End, ...]
    junctions: tuple[Junction, ...]
    share: float

    @cached_property
    def length(self) -> float:
        """Length of all branches [m]."""
        return sum(branch.length for branch in self.branches)

    @cached_property
    def narrowest(self) -> float:
        """The least outer radius along all branches [m]."""
        return min(branch.narrowest for branch in self.branches)

    @cached_property
    def branch_of_end(self) -> tuple[int, ...]:
        """The number of the branch that each free end is of."""
        return tuple(end.branch for end in self.ends)

    @property
    def n_ends(self) -> int:
        """The number of free ends."""
        return len(self.table_of_ends)

    @property
    def radii(self) -> list[float]:
        """The outer radius of each free end [m]."""
        radii: list[float] = self.table_of_ends[:, 6].tolist()
        return radii

    @cached_property
    def table_of_ends(self) -> Floats:
        """``(n_ends, 9)`` point, direction, radius, bore of each end, and the length of its branch [m]."""
        rows = [(*e.point, *e.direction, e.radius, e.bore, self.branches[e.branch].length) for e in self.ends]
        return np.array(rows, np.float64).reshape(-1, 9)

    def placed(self, turns: Floats, shifts: Floats) -> Iterator[Centreline]:
        """The same line in other places; each lies where it would if it were placed by itself, to the last bit.

        Args:
            turns: ``(n, 3, 3)`` rotations.
            shifts: ``(n, 3)`` translations after them [m].
        """
        # A place changes none of these.
        known = {
            "share": self.share, "length": self.length, "narrowest": self.narrowest,
            "branch_of_end": self.branch_of_end, "junctions": (),
        }  # fmt: skip
        branches = zip(*(branch.placed(turns, shifts) for branch in self.branches), strict=True)
        tables = _moved(self.table_of_ends, turns, shifts)
        for turn, shift, own, table in zip(turns, shifts, branches, tables, strict=True):
            there = object.__new__(_Placed)
            vars(there).update(known, branches=own, table_of_ends=table)
            if self.junctions:
                junctions = tuple(Junction(turn @ one.point + shift, one.branches) for one in self.junctions)
                vars(there).update(junctions=junctions)
            yield there


class _Placed(Centreline):
    """A line in another place. A plant has as many as pipes: objects of their ends are made where somebody asks."""

    @cached_property
    def ends(self) -> tuple[End, ...]:
        """The free ends, by branch."""
        rows = zip(self.table_of_ends, self.branch_of_end, strict=True)
        return tuple(End(row[:3], row[3:6], float(row[6]), float(row[7]), branch) for row, branch in rows)


def _moved(ends: Floats, turns: Floats, shifts: Floats) -> Floats:
    """A table of ends with their points and directions elsewhere, for each place."""
    moved = np.repeat(ends[None], len(turns), axis=0)
    # One product for each, so that an end lies where it would by itself to the last bit.
    moved[:, :, :3] = (turns[:, None] @ ends[None, :, :3, None])[..., 0] + shifts[:, None]
    moved[:, :, 3:6] = (turns[:, None] @ ends[None, :, 3:6, None])[..., 0]
    return moved


@dataclass(frozen=True)
class NotTube:
    """Why a part has no centreline.

    Args:
        reason: one line for people.
        share: share of the surface that runs along tubes, 0..1.
    """

    reason: str
    share: float = 0.0
