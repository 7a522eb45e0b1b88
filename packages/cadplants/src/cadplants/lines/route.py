"""Centrelines of runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.solids.transforms import looking, spun

__all__ = ["Route"]


@dataclass(frozen=True, eq=False)
class Route:
    """A centreline with sharp corners.

    Args:
        points: ``(n, 3)`` [m], at least two, no leg of length 0.
        jog: from which to which chainage on the last leg the axis moves aside (an eccentric reducer), and by what
            ``(3,)`` [m].
    """

    points: Floats
    jog: tuple[float, float, tuple[float, float, float]] | None = None

    @property
    def starts(self) -> Floats:
        """``(n,)`` chainage of each point [m]."""
        legs = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(legs)])

    @property
    def directions(self) -> Floats:
        """``(n - 1, 3)`` unit direction of each leg."""
        legs = np.diff(self.points, axis=0)
        unit: Floats = legs / np.linalg.norm(legs, axis=1, keepdims=True)
        return unit

    @property
    def length(self) -> float:
        """Of the whole route [m]."""
        return float(self.starts[-1])

    def leg(self, s: float) -> int:
        """The leg at a chainage."""
        return int(np.clip(np.searchsorted(self.starts, s, side="right") - 1, 0, len(self.points) - 2))

    def point(self, s: float) -> Floats:
        """The point ``(3,)`` at a chainage [m]."""
        leg = self.leg(s)
        result: Floats = self.points[leg] + (s - self.starts[leg]) * self.directions[leg]
        if self.jog is not None:
            low, high, aside = self.jog
            result = result + np.clip((s - low) / (high - low), 0.0, 1.0) * np.array(aside)
        return result

    def frame(self, s: float, roll: float = 0.0) -> Floats:
        """The pose at a chainage: x along the run, z as upright as it can be, then rolled about x [rad]."""
        pose = looking(self.point(s), self.directions[self.leg(s)])
        return pose @ spun("x", roll) if roll else pose
