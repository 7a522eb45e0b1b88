"""Places along the centreline of a run, by arc length."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.scene import Floats

__all__ = ["Axis"]


@dataclass(frozen=True, eq=False)
class Axis:
    """A centreline of straight pieces.

    Args:
        points: ``(n, 3)`` its corners in order [m].
    """

    points: Floats

    @cached_property
    def starts(self) -> Floats:
        """``(n,)`` chainage of each corner [m]."""
        return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1))])

    def point(self, s: float) -> Floats:
        """The point ``(3,)`` at a chainage [m]."""
        place: Floats = np.array([np.interp(s, self.starts, self.points[:, axis]) for axis in range(3)])
        return place

    def way(self, s: float) -> Floats:
        """The unit direction ``(3,)`` at a chainage."""
        leg = int(np.clip(np.searchsorted(self.starts, s, side="right") - 1, 0, len(self.points) - 2))
        step = self.points[leg + 1] - self.points[leg]
        unit: Floats = step / np.linalg.norm(step)
        return unit

    def between(self, low: float, high: float) -> Floats:
        """``(n, 3)`` the piece of the line from one chainage to another, with the corners on it [m]."""
        inner = (self.starts > low + 1e-6) & (self.starts < high - 1e-6)
        return np.vstack([self.point(low), self.points[inner], self.point(high)])

    def along(self, places: Floats) -> Floats:
        """``(k,)`` chainage of what on the line is nearest to each place [m].

        Args:
            places: ``(k, 3)`` [m].
        """
        low, way = self.points[:-1], np.diff(self.points, axis=0)
        squares = np.maximum(np.einsum("lj,lj->l", way, way), 1e-18)
        share = np.clip(np.einsum("klj,lj->kl", places[:, None] - low, way) / squares, 0, 1)
        away = np.linalg.norm(places[:, None] - (low + share[..., None] * way), axis=2)
        best, row = away.argmin(axis=1), np.arange(len(places))
        found: Floats = self.starts[best] + share[row, best] * np.sqrt(squares[best])
        return found
