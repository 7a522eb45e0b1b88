"""Wafer butterfly valves along x, between two flanges, stem towards +z."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Device
from cadplants.model.standards import FACE_TO_FACE, FLANGES, PIPES
from cadplants.parts.operator import handwheel, lever_solid
from cadplants.parts.valve_body import Piece, assemble
from cadplants.solids.mesh_ops import Branch, Solid, about_x, branched, extrude, moved, revolve, shared, stack, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["butterfly_valve"]


@shared
def _solids(dn: int, style: ModelingStyle) -> tuple[Solid, Solid, Solid, float]:
    """Body, disc, stem; and the height of the stem's top."""
    size, pipe, length = FLANGES[dn], PIPES[dn], FACE_TO_FACE["butterfly"][dn]
    outer = (size.circle - size.bolt) / 2 - 0.0015
    sides = style.round(outer)
    neck = min(0.40 * length, 0.5 * outer)
    pad = neck + 0.012 + 0.06 * pipe.radius
    top = 0.5 * size.outer + 0.020 + 0.30 * pipe.radius
    rise = ((neck, top - 0.012), (pad, top - 0.012), (pad, top), (0.0, top))
    ring, _ = branched([(outer, 0.0), (outer, length)], sides, [Branch(length / 2, np.pi / 2, neck, rise)])
    inside = [(outer, length), (pipe.bore, length), (pipe.bore, 0.0), (outer, 0.0)]
    body = about_x(weld([ring, revolve(inside, sides)]))
    reach = pipe.bore + 0.0002
    edge, middle = 0.0025, 0.004 + 0.05 * pipe.bore
    profile = [(0, -middle), (0.5 * reach, -middle), (reach, -edge), (reach, edge), (0.5 * reach, middle), (0, middle)]
    disc = weld([revolve(profile, sides)])
    # Open, its plane along the flow; where pipes are modelled solid it would run into them and stands shut.
    turned = spun("x", -np.pi / 2) if style.hollow else spun("y", np.pi / 2)
    disc = moved(disc, at(length / 2) @ turned)
    shaft = 0.42 * neck
    stem = stack([(top, top + 0.010, circle(shaft * 1.6, 6)), (top + 0.010, top + 0.030, circle(shaft, 12))])
    return body, disc, stem, top + 0.030


def butterfly_valve(unit: str, dn: int, style: ModelingStyle, gearbox: bool | None = None, spokes: int = 4) -> Device:
    """A wafer butterfly valve, open, with a lever, or with a gearbox and a handwheel from DN200 on by default."""
    body, disc, stem, top = _solids(dn, style)
    length = FACE_TO_FACE["butterfly"][dn]
    stand = at(length / 2)
    pieces: list[Piece] = [
        (body, IDENTITY, "valve body", "valve"),
        (disc, IDENTITY, "valve disc", "trim"),
        (stem, stand, "valve stem", "trim"),
    ]
    contacts = [(0, 1), (0, 2), (2, 3)]
    if gearbox if gearbox is not None else dn >= 200:
        box, shaft, wheel, side, out = _gear_solids(dn, spokes)
        foot = stand @ at(0, 0, top)
        pieces += [(box, foot, "gearbox", "valve"), (shaft, foot @ side, "valve stem", "trim")]
        pieces.append((wheel, foot @ side @ at(0, 0, out), "handwheel", "handle"))
        contacts += [(3, 4), (4, 5)]
    else:
        pieces.append(
            (lever_solid(0.14 + 1.4 * PIPES[dn].radius, 0.016, 0.006), stand @ at(0, 0, top), "lever", "handle")
        )
    device = assemble(pieces, "butterfly valve", unit, style, tuple(contacts), 0, length)
    return Device(device.assembly, length, 0, 0, wafer=True)


@shared
def _gear_solids(dn: int, spokes: int) -> tuple[Solid, Solid, Solid, Floats, float]:
    """Gearbox on z = 0, input shaft and wheel about z of a frame that looks to +y; that frame and the wheel's place."""
    half = 0.045 + 0.15 * PIPES[dn].radius
    box = extrude(rounded_rectangle(2 * half, 1.6 * half, 0.3 * half, 4), 0.0, 0.9 * half)
    side = at(0.3 * half, 0.8 * half, 0.45 * half) @ spun("x", -np.pi / 2)
    shaft = extrude(circle(0.009, 12), 0.0, 0.09)
    wheel = handwheel(0.07 + 0.5 * PIPES[dn].radius, 0.009, spokes, 0.02, 0.02, 0.009, 40)
    return box, shaft, wheel, side, 0.065
