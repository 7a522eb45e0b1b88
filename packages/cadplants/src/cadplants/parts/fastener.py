"""Stud bolts with nuts, U-bolts with their brackets."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Assembly, Component
from cadplants.model.standards import HEX_NUTS, PIPES, WASHERS
from cadplants.solids.mesh_ops import Solid, about_x, box, extrude, merge, moved, shared, stack, sweep
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["PROUD", "SUPPORT_REACH", "bolt", "clamping", "pipe_support"]

PROUD = 0.003  # m; a stud stands this far out of its nut: about two threads


@shared
def _bolt_solids(diameter: float, grip: float, sides: int, whole: bool) -> tuple[Solid, ...]:
    """Along x, clamping what lies between 0 and ``grip``; one solid, or stud, nut, washer."""
    across, thick = HEX_NUTS[diameter]
    shank = circle(diameter / 2, sides)
    hexagon = circle(across / np.sqrt(3), 6)
    if whole:
        low, high = -thick - PROUD, grip + thick + PROUD
        levels = [(low, -thick, shank), (-thick, 0.0, hexagon), (0.0, grip, shank), (grip, grip + thick, hexagon)]
        return (about_x(stack([*levels, (grip + thick, high, shank)])),)
    outer, flat = WASHERS[diameter]
    end = flat + thick + PROUD
    stud = extrude(shank, -end, grip + end)
    nut = extrude(hexagon, 0.0, thick, (shank,))
    washer = extrude(circle(outer / 2, max(16, sides)), 0.0, flat, (circle(diameter / 2 + 0.0008, sides),))
    return tuple(about_x(solid) for solid in (stud, nut, washer))


def bolt(diameter: float, grip: float, style: ModelingStyle) -> Assembly:
    """A stud bolt with two heavy hex nuts along x; it clamps what lies between 0 and ``grip`` [m].

    Returns:
        One component; or stud, two nuts, two washers where the style models every piece (see ``clamping``); none where
        it models no fasteners.
    """
    if style.fasteners == "none":
        return Assembly()
    sides = min(style.round(diameter / 2), 12)
    color, group = style.color("fastener"), "Connection assembly"
    if style.fasteners != "pieces":
        (solid,) = _bolt_solids(diameter, round(grip, 6), sides, True)
        return Assembly((Component(solid, group, "bolt", color),))
    stud, nut, washer = _bolt_solids(diameter, round(grip, 6), sides, False)
    flat, thick = WASHERS[diameter][1], HEX_NUTS[diameter][1]
    return Assembly(
        (
            Component(stud, group, "stud", color),
            Component(nut, group, "nut", color, at(-flat - thick)),
            Component(nut, group, "nut", color, at(grip + flat)),
            Component(washer, group, "washer", color, at(-flat)),
            Component(washer, group, "washer", color, at(grip)),
        ),
        ((0, 1), (0, 2), (1, 3), (2, 4)),
    )


def clamping(studs: range, style: ModelingStyle) -> list[tuple[int, int]]:
    """Which components of some bolts press on the near and on the far flange, for each bolt.

    Args:
        studs: indices of the components that ``bolt`` made, one bolt after the other.
        style: that modelled them.
    """
    if style.fasteners == "pieces":
        return [(i + 3, i + 4) for i in range(studs.start, studs.stop, 5)]
    return [(i, i) for i in studs]


SUPPORT_REACH = 0.026  # m; from what carries the bracket to the skin of the pipe
_PLATE = 0.006
_GRIP = 0.0002  # m; a tight U-bolt bites this deep


@shared
def _support_solids(dn: int, sides: int) -> tuple[Solid, Solid]:
    """Bracket and U-bolt; the pipe runs along x through the origin, the carrier lies towards +y."""
    radius = PIPES[dn].radius
    rod = 0.004 if dn <= 40 else 0.005 if dn <= 100 else 0.008
    leg = radius + rod - _GRIP
    nut = rod * 1.6
    height = 2 * (leg + nut + 0.008)
    holes = tuple(circle(rod + 0.0008, sides, (z, 0.0)) for z in (leg, -leg))
    outline = np.array([[height / 2, -0.025], [height / 2, 0.025], [-height / 2, 0.025], [-height / 2, -0.025]])
    # The plate's normal is y; its outline is drawn in (z, x).
    plate = extrude(outline, radius, radius + _PLATE, holes)
    plate = Solid(plate.vertices[:, [1, 2, 0]], plate.faces)
    back = radius + SUPPORT_REACH
    half = max(0.006, leg - nut - 0.004)
    spacer = box((0.036, back - radius - _PLATE + 0.0005, 2 * half), (0, (back + radius + _PLATE - 0.0005) / 2, 0))
    angles = np.linspace(np.pi / 2, -np.pi / 2, 13)
    bow = np.column_stack([np.zeros(13), -leg * np.cos(angles), leg * np.sin(angles)])
    tip = radius + _PLATE + 2.4 * rod
    path = np.vstack([[0, tip, leg], bow, [0, tip, -leg]])
    rod_solid = sweep(path, circle(rod, 12), up=(1.0, 0.0, 0.0))
    nuts = []
    for z in (leg, -leg):
        ring = extrude(circle(nut / np.cos(np.pi / 6), 6), 0.0, 1.6 * rod, (circle(rod, 12),))
        ring = Solid(ring.vertices[:, [1, 2, 0]], ring.faces)
        nuts.append(moved(ring, at(0, radius + _PLATE, z)))
    return merge([plate, spacer]), merge([rod_solid, *nuts])


def pipe_support(dn: int, style: ModelingStyle) -> Assembly:
    """A U-bolt on a bracket; the pipe lies along x through the origin, the carrier's face at y = radius + 26 mm.

    Returns:
        Bracket, then U-bolt with its nuts as one mesh.
    """
    bracket, bow = _support_solids(dn, 12)
    return Assembly(
        (
            Component(bracket, "Connection assembly", "bracket", style.color("steel")),
            Component(bow, "Connection assembly", "u-bolt", style.color("clamp")),
        ),
        ((0, 1),),
    )
