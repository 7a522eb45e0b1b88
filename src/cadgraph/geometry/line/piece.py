"""One run along a tube as it was swept."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats

__all__ = ["Piece"]


@dataclass
class Piece:
    """One run along a tube.

    Args:
        nodes: ``(n, NODE)`` its sections in order, as ``sweep`` describes them.
        outward: ``(2, 3)`` unit direction out of it at either end.
        extension: ``(2,)`` how far the ends lie beyond the last sections [m].
        closed: whether it returns to its start.
    """

    nodes: Floats
    outward: Floats
    extension: Floats
    closed: bool

    @classmethod
    def of(cls, nodes: Floats, ends: Floats) -> Piece:
        """The run that a sweep found.

        Args:
            nodes: ``(n, NODE)``.
            ends: ``(2, 4)`` extension and direction outward of either end, NaN where the run is closed.
        """
        closed = bool(np.isnan(ends[0, 0]))
        outward = np.stack([-nodes[0, 6:9], nodes[-1, 6:9]])
        if not closed:
            for e, order in enumerate((nodes, nodes[::-1])):
                # In a bend, the plane in which the wall ends tells the direction there better than its last section.
                away = np.linalg.norm(order[:, :3] - order[0, :3], axis=1)
                back = order[min(int(np.searchsorted(away, 2 * order[0, 3])), len(order) - 1)]
                bends = abs(float(back[6:9] @ order[0, 6:9])) < 1 - 4e-5
                if bends and abs(float(ends[e, 1:] @ outward[e])) > 0.9:
                    outward[e] = ends[e, 1:] / np.linalg.norm(ends[e, 1:])
        return cls(nodes, outward, ends[:, 0], closed)

    def tip(self, end: int) -> Floats:
        """The node at one end, 0 or 1."""
        node: Floats = self.nodes[-1 if end else 0]
        return node
