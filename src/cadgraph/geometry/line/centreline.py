"""The line along the middle of a tube: straight, bent or branched, with the radius along it."""

from __future__ import annotations

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

    def placed(self, turn: Floats, shift: Floats) -> Branch:
        """The same run in another place: turned by a ``(3, 3)`` rotation, then moved [m]."""
        there = Branch(self.points @ turn.T + shift, self.radius, self.bore, self.closed)
        # A place changes neither its length nor its radii, which are asked for of every line of a plant.
        there.__dict__.update(length=self.length, widest=self.widest, narrowest=self.narrowest)
        return there


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
    def table_of_ends(self) -> Floats:
        """``(n_ends, 9)`` point, direction, radius, bore of each end, and the length of its branch [m]."""
        rows = [(*e.point, *e.direction, e.radius, e.bore, self.branches[e.branch].length) for e in self.ends]
        return np.array(rows, np.float64).reshape(-1, 9)

    def placed(self, turn: Floats, shift: Floats) -> Centreline:
        """The same line in another place.

        Args:
            turn: ``(3, 3)`` rotation.
            shift: ``(3,)`` translation after it [m].
        """
        return Centreline(
            tuple(one.placed(turn, shift) for one in self.branches),
            tuple(
                End(turn @ one.point + shift, turn @ one.direction, one.radius, one.bore, one.branch)
                for one in self.ends
            ),
            tuple(Junction(turn @ one.point + shift, one.branches) for one in self.junctions),
            self.share,
        )


@dataclass(frozen=True)
class NotTube:
    """Why a part has no centreline.

    Args:
        reason: one line for people.
        share: share of the surface that runs along tubes, 0..1.
    """

    reason: str
    share: float = 0.0
