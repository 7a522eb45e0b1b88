"""What geometry knows of each distinct shape of a scene, before anything has a label."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats, Ints

__all__ = ["PARALLEL", "Disc", "Facts", "ShapeAnalysis", "is_round"]

PARALLEL = np.cos(np.radians(4.0))
"""Axes can be one line where the cosine between them is at least this."""


@dataclass(frozen=True)
class Disc:
    """A round flat face, or the round rim of an opening.

    Args:
        center: ``(3,)`` [m].
        normal: ``(3,)`` unit, out of the part.
        outer: radius of its rim [m].
        inner: radius of its hole; ``outer`` for a mere rim, 0 for a full face [m].
        sides: corners of the rim.
        area: [m2].
    """

    center: Floats
    normal: Floats
    outer: float
    inner: float
    sides: int
    area: float


@dataclass(frozen=True)
class Facts:
    """One shape, measured where it occurs first.

    Args:
        discs: its round flat faces.
        ports: of these the outermost along each axis and sense.
        center: ``(3,)`` a point on its main axis [m].
        axis: ``(3,)`` unit.
        low: least coordinate along the axis from ``center`` [m].
        high: greatest coordinate [m].
        radius: greatest distance from the axis [m].
        turned: share of the area that a surface of revolution about the axis could have.
        sides: corners around the axis at the greatest radius; 0 where they leave a wide gap.
        outer: ``(n_slices,)`` greatest radius of each slice along the axis [m].
        inner: ``(n_slices,)`` least [m].
        bore: radius of the opening along the whole axis of a body of revolution, 0 where there is none or faces
            don't tell inside from outside [m].
        tube: length of the centreline if it is a tube or bar of one round section between two ports, else 0 [m].
        rim: share of the area that lies beyond 0.72 of the radius.
        spokes: number of arms between hub and rim; 0 where that zone is filled, or empty.
        section: ``(3,)`` extents of the oriented box, descending [m].
        fill: enclosed volume over that of the box; 0 where open.
        extruded: side of the oriented box (0 is the longest) along which the cross-section stays the same, or -1.
    """

    discs: tuple[Disc, ...]
    ports: tuple[Disc, ...]
    center: Floats
    axis: Floats
    low: float
    high: float
    radius: float
    turned: float
    sides: int
    outer: Floats
    inner: Floats
    bore: float
    tube: float
    rim: float
    spokes: int
    section: Floats
    fill: float
    extruded: int

    @property
    def length(self) -> float:
        """Along the axis [m]."""
        return self.high - self.low

    @property
    def round(self) -> bool:
        """Whether it is a body of revolution, but for bolt holes and the like."""
        return is_round(self.turned, self.sides)

    @property
    def bent(self) -> bool:
        """Whether it is a tube that turns."""
        if not self.tube:
            return False
        first, second = self.ports
        apart = float(np.linalg.norm(first.center - second.center))
        return bool(first.normal @ second.normal > -PARALLEL) or self.tube > 1.1 * apart


def is_round(turned: float, sides: int) -> bool:
    """Whether so much turned area and so many corners around make a body of revolution."""
    return turned > 0.85 and sides >= 5


@dataclass(frozen=True)
class ShapeAnalysis:
    """The distinct shapes of a scene, and where each occurs.

    Args:
        facts: of each distinct shape, at its first occurrence.
        first: ``(n_shapes,)`` the mesh that each was measured on.
        shape: ``(n_meshes,)`` row of the two above.
        turn: ``(n_meshes, 3, 3)`` rotation from the first mesh of its shape to the mesh.
        shift: ``(n_meshes, 3)`` translation [m]: a point ``x`` of the first mesh lies at ``turn @ x + shift``.
    """

    facts: tuple[Facts, ...]
    first: Ints
    shape: Ints
    turn: Floats
    shift: Floats
