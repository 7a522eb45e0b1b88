"""Flanges and the joints that they make with gaskets and bolts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, gather
from cadplants.model.standards import FLANGES, HEX_NUTS, PIPES, RAISED_FACE, WASHERS
from cadplants.parts.fastener import PROUD, bolt
from cadplants.solids.mesh_ops import Shell, Solid, about_x, loft, merge, moved, planar, reverse, revolve, shared, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "GASKET",
    "bolts",
    "face_shell",
    "flange",
    "flange_length",
    "gasket",
    "nut_circle",
    "nut_room",
    "plate_thickness",
]

GASKET = 0.002  # m, flat ring gasket after ASME B16.21 (1.5 to 3 mm)


def plate_thickness(dn: int) -> float:
    """From the raised face to the back of the flange [m]."""
    return FLANGES[dn].thickness + RAISED_FACE


def nut_room(dn: int) -> float:
    """How far behind a flange its nuts and stud ends need to be kept free [m]."""
    return HEX_NUTS[FLANGES[dn].bolt][1] + WASHERS[FLANGES[dn].bolt][1] + PROUD + 0.003


def nut_circle(dn: int) -> float:
    """Radius of the circle inside all nuts of a joint, with a little air [m]."""
    size = FLANGES[dn]
    return float(size.circle / 2 - max(HEX_NUTS[size.bolt][0] / np.sqrt(3), WASHERS[size.bolt][0] / 2) - 0.002)


def flange_length(dn: int, style: ModelingStyle) -> float:
    """From the raised face to where the pipe begins [m]."""
    if style.flange == "ring":
        return plate_thickness(dn)
    size = FLANGES[dn]
    return RAISED_FACE + (size.neck if style.flange == "neck" else size.slip)


@shared
def face_shell(dn: int, sides: int, back: float, bore: float, drilled: bool = True) -> Shell:
    """The surface of a flange about z from its bore to its back: face at 0, body towards +z.

    Args:
        dn: nominal size.
        sides: of a ring.
        back: radius of the ring left open at the back face [m].
        bore: radius of the ring left open at the raised face; 0 closes it [m].
        drilled: whether it has its bolt holes.
    """
    size = FLANGES[dn]
    raised, outer = size.raised / 2, size.outer / 2
    low, high = RAISED_FACE, RAISED_FACE + size.thickness
    holes: list[Floats] = []
    if drilled:
        steps = max(8, sides // 4)
        for k in range(size.n_bolts):
            angle = (2 * k + 1) * np.pi / size.n_bolts
            center = (size.circle / 2 * np.cos(angle), size.circle / 2 * np.sin(angle))
            holes.append(circle(size.hole / 2, steps, center))
    rim = circle(outer, sides)
    shells = [
        revolve([(bore, 0.0), (raised, 0.0), (raised, low)], sides),
        planar(rim, (circle(raised, sides), *holes), low, up=False),
        revolve([(outer, low), (outer, high)], sides),
        planar(rim, (circle(back, sides), *holes), high),
    ]
    for hole in holes:
        shells.append(reverse(loft([np.column_stack([hole, np.full(len(hole), z)]) for z in (low, high)])))
    return weld(shells)


@shared
def _flange_solid(dn: int, style: ModelingStyle) -> Solid:
    size, pipe = FLANGES[dn], PIPES[dn]
    sides = style.round(size.outer / 2)
    length = flange_length(dn, style)
    bore = pipe.bore if style.hollow else 0.0
    if style.flange == "ring" or style.devices == "primitives":
        profile = [(bore, 0.0), (size.outer / 2, 0.0), *_plain_back(dn, length, style), (bore, length)]
        return about_x(weld([revolve(profile, sides, closed=style.hollow)]))
    back = size.hub / 2
    head = face_shell(dn, sides, back, bore, style.holes)
    if style.flange == "neck":
        land = plate_thickness(dn) + 0.82 * (length - plate_thickness(dn))
        outside = [(back, plate_thickness(dn)), (pipe.radius, land), (pipe.radius, length)]
    else:
        outside = [(back, plate_thickness(dn)), (back, length)]
    inside = [(bore, length), (bore, 0.0)] if style.hollow else [(0.0, length)]
    return about_x(weld([head, revolve([*outside, *inside], sides)]))


def _plain_back(dn: int, length: float, style: ModelingStyle) -> list[tuple[float, float]]:
    """The outline ``(radius, height)`` of the back of a plain disc: nothing, a cone or a cylinder for its hub [m]."""
    size, thick = FLANGES[dn], plate_thickness(dn)
    if style.flange == "ring":
        return [(size.outer / 2, length)]
    hub = max(size.hub / 2, 1.05 * PIPES[dn].radius)
    end = PIPES[dn].radius if style.flange == "neck" else hub
    return [(size.outer / 2, thick), (hub, thick), (end, length)]


def flange(dn: int, style: ModelingStyle, blind: bool = False, grip: float = 0.0) -> Assembly:
    """A flange along x: its raised face at 0 looking to -x, its pipe end towards +x.

    Args:
        dn: nominal size.
        style: that models it.
        blind: whether it is a lid.
        grip: what the bolts of its joint clamp, from its own back on, where this style makes them one mesh with it;
            0: they are left to the other flange [m].
    """
    color = style.color("flange")
    if blind:
        lid = Component(_blind_solid(dn, style), "Pipe assembly", "blind flange", color, family="blind flange")
        return Assembly((lid,))
    solid = (
        _bolted_solid(dn, round(grip, 6), style) if grip and style.fasteners == "flange" else _flange_solid(dn, style)
    )
    return Assembly((Component(solid, "Pipe assembly", "flange", color, family=f"flange/{style.flange}"),))


@shared
def _bolted_solid(dn: int, grip: float, style: ModelingStyle) -> Solid:
    """A flange and all bolts of its joint, their far nuts beyond the other flange."""
    pose = at(plate_thickness(dn)) @ spun("z", np.pi)
    return merge([_flange_solid(dn, style), moved(_bolt_set(dn, grip, style), pose)])


@shared
def _blind_solid(dn: int, style: ModelingStyle) -> Solid:
    size = FLANGES[dn]
    sides = style.round(size.outer / 2)
    if style.devices == "primitives":
        profile = [(0.0, 0.0), (size.outer / 2, 0.0), (size.outer / 2, plate_thickness(dn)), (0.0, plate_thickness(dn))]
        return about_x(weld([revolve(profile, sides)]))
    back = size.hub / 2
    head = face_shell(dn, sides, back, 0.0, style.holes)
    return about_x(weld([head, revolve([(back, plate_thickness(dn)), (0.0, plate_thickness(dn))], sides)]))


@shared
def _gasket_solid(dn: int, style: ModelingStyle) -> Solid:
    size, pipe = FLANGES[dn], PIPES[dn]
    # A hair inside the inner bolt circle of B16.21, so that it does not half touch the facets of the bolts.
    outer = (size.circle - size.bolt) / 2 - 0.0006
    profile = [(pipe.radius, 0.0), (outer, 0.0), (outer, GASKET), (pipe.radius, GASKET)]
    return about_x(weld([revolve(profile, style.round(outer), closed=True)]))


def gasket(dn: int, style: ModelingStyle) -> Assembly:
    """A flat ring gasket from 0 to ``GASKET`` along x, nearly out to the bolts (B16.21); none if the style has none."""
    if not style.gaskets:
        return Assembly()
    return Assembly((Component(_gasket_solid(dn, style), "Pipe assembly", "gasket", style.color("gasket")),))


def bolts(dn: int, grip: float, style: ModelingStyle) -> Assembly:
    """The bolts of a joint along x, their nuts' faces at 0 and ``grip`` [m], straddling the vertical.

    There are none where the style makes them one mesh with a flange.
    """
    size = FLANGES[dn]
    if style.fasteners == "flange":
        return Assembly()
    one = bolt(size.bolt, grip, style)
    turns = [(2 * k + 1) * np.pi / size.n_bolts for k in range(size.n_bolts)]
    poses = [spun("x", turn) @ at(0, size.circle / 2, 0) for turn in turns]
    if style.fasteners == "set":
        return Assembly((replace(one.components[0], solid=_bolt_set(dn, round(grip, 6), style)),))
    return gather(one.placed(pose) for pose in poses)


@shared
def _bolt_set(dn: int, grip: float, style: ModelingStyle) -> Solid:
    """All bolts of a joint as one mesh."""
    size = FLANGES[dn]
    one = bolt(size.bolt, grip, style).components[0].solid
    turns = [(2 * k + 1) * np.pi / size.n_bolts for k in range(size.n_bolts)]
    return merge([moved(one, spun("x", turn) @ at(0, size.circle / 2, 0)) for turn in turns])
