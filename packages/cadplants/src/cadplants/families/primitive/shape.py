"""What devices of primitives are put together from: cones, cylinders, dishes, boxes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.params import Params, When, among, chance, given, nested
from cadplants.builder.table import Table
from cadplants.model.standards import FLANGES, PIPES
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved, revolve, tube, weld
from cadplants.solids.primitives import cylinder, ring, torus, turned
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "FRAME",
    "Plates",
    "Snout",
    "cone",
    "disc",
    "dish",
    "lying",
    "pipe_piece",
    "plated",
    "rods",
    "sleeve",
    "snout_of",
    "spoked",
    "torus_piece",
    "vessel",
]

FRAME = "Structural element"


def cone(first: float, last: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A solid cone about z from one radius to another between two heights; a radius of 0 is a point [m]."""
    return turned([(first, low), (last, high)], style.round(max(first, last)))


def disc(radius: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A cylinder about z between two heights [m]."""
    return cylinder(radius, low, high, style.round(radius))


def lying(solid: Solid, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
    """What was built about z laid along x, then shifted [m]."""
    return moved(about_x(solid), at(x, y, z))


def dish(radius: float, depth: float, low: float, style: ModelingStyle) -> Solid:
    """A dish about z on the height ``low``, of three or four rings as coarse programs make it [m]."""
    outline = [(r, low + z) for r, z in _dished(radius, depth, style)]
    return turned([(radius, low), *outline, (0.0, low + depth)], style.round(radius))


def vessel(radius: float, low: float, high: float, depth: float, style: ModelingStyle) -> Solid:
    """A cylinder about z with a dish at both ends, one closed body; ``depth`` of the dishes [m]."""
    upper = [(r, high + z) for r, z in _dished(radius, depth, style)]
    lower = [(r, low - (z - high)) for r, z in upper[::-1]]
    outline = [(0.0, low - depth), *lower, (radius, low), (radius, high), *upper, (0.0, high + depth)]
    return weld([revolve(outline, style.round(radius))])


def _dished(radius: float, depth: float, style: ModelingStyle) -> list[tuple[float, float]]:
    """Radius and height of the rings of a dish between its rim and its top [m]."""
    angles = np.linspace(0, np.pi / 2, int(np.clip(style.round(radius) // 5, 3, 8)) + 1)[1:-1]
    return [(radius * float(np.cos(a)), depth * float(np.sin(a))) for a in angles]


def sleeve(inner: float, outer: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A ring about z, solid where the style models no bores [m]."""
    return ring(inner if style.hollow else 0.0, outer, low, high, style.round(outer))


def pipe_piece(dn: int, low: float, high: float, style: ModelingStyle) -> Solid:
    """A piece of pipe about z of a nominal size between two heights [m]."""
    return sleeve(PIPES[dn].bore, PIPES[dn].radius, low, high, style)


class Plates(Params):
    """Discs that stand for a device's own flanges, or none."""

    dn: int = given(0, "nominal size", "mm")
    bare: bool = chance(0.55, "no discs")
    thick: float = among(
        lambda p: (0.01, 0.016, FLANGES[p.dn].thickness), "of a disc", "m", when=lambda p: not p.bare, otherwise=0.0
    )

    def solids(self, t: Table, length: float) -> list[Solid]:
        """The discs of a device along x of a length [m]."""
        if self.bare:
            return []
        thick, radius = min(self.thick, 0.2 * length), t.flange.outer / 2
        return [lying(disc(radius, low, low + thick, t.style)) for low in (0.0, length - thick)]


def plated(when: When | None = None) -> Plates:
    """Discs at the ends of a device in a line, at times none; a parameter."""
    return nested(Plates, "discs at its ends", when=when, fixed=lambda p: {"dn": p.dn})


class Snout(Params):
    """A nozzle: a cylinder with or without a disc at its end."""

    dn: int = given(0, "nominal size", "mm")
    bare: bool = chance(0.2, "no disc")
    thick: float = among(
        lambda p: (0.012, 0.02, FLANGES[p.dn].thickness),
        "of the disc",
        "m",
        when=lambda p: not p.bare,
        otherwise=0.0,
    )

    def solid(self, low: float, face: float, style: ModelingStyle) -> Solid:
        """About z between two heights, its face up [m]."""
        neck = pipe_piece(self.dn, low, face, style)
        if self.bare:
            return neck
        thick = min(self.thick, 0.5 * abs(face - low))
        return merge([neck, disc(FLANGES[self.dn].outer / 2, face - thick, face, style)])


def snout_of(dn: Callable[[Any], int], about: str) -> Snout:
    """A nozzle of a nominal size [mm] that follows from the other parameters; a parameter."""
    return nested(Snout, about, fixed=lambda p: {"dn": dn(p)})


def rods(count: int, far: float, radius: float, low: float, high: float, style: ModelingStyle) -> list[Solid]:
    """Round bars along z at equal steps about it, ``far`` from it, the first half a step from x [m]."""
    bar = disc(radius, low, high, style)
    turns = [2 * np.pi * (k + 0.5) / count for k in range(count)]
    return [moved(bar, at(far * float(np.cos(turn)), far * float(np.sin(turn)))) for turn in turns]


def spoked(radius: float, thick: float, count: int, style: ModelingStyle) -> list[Solid]:
    """A wheel about z in the plane z = 0: its ring, its spokes as bars [m]."""
    sides = int(min(style.round(radius), 24))
    wheel = [torus(radius, thick, sides, 6)]
    for k in range(count):
        turn = 2 * np.pi * k / count
        out = (radius * float(np.cos(turn)), radius * float(np.sin(turn)), 0.0)
        wheel.append(torus_piece([(0.0, 0.0, 0.0), out], 0.6 * thick, 6))
    return wheel


def torus_piece(path: Floats | Sequence[Sequence[float]], radius: float, sides: int, bore: float = 0.0) -> Solid:
    """A round bar or pipe along ``(n, 3)`` points [m]."""
    return tube(np.asarray(path, float), radius, bore, sides)
