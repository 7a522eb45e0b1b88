"""The basket strainer of the presets, along x: inlet face at 0, its pot hanging below the line, its lid on top."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Assembly, Component, Device
from cadplants.model.standards import FACE_TO_FACE, FLANGES, PIPES
from cadplants.parts.flange import face_shell, nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved, revolve, shared, weld
from cadplants.solids.primitives import around, cylinder, hexagon, rope, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["strainer"]


def _mouth(dn: int, style: ModelingStyle, length: float) -> Solid:
    """A flange with its neck, along x from its face at 0 [m]."""
    neck, bore, sides = 0.485 * FLANGES[dn].hub, bore_of(dn, style), style.round(FLANGES[dn].outer / 2)
    inside = [(bore, length), (bore, 0.0)] if bore else [(0.0, length)]
    outside = [(neck, plate_thickness(dn)), (neck, length)]
    return about_x(weld([face_shell(dn, sides, neck, bore, style.holes), revolve([*outside, *inside], sides)]))


@shared
def _solids(dn: int, style: ModelingStyle) -> tuple[Solid, Solid]:
    """The body along x, and the lid about its own axis with its seat as high as it sits [m]."""
    length, radius, rim = FACE_TO_FACE["globe"][dn], PIPES[dn].radius, 0.5 * FLANGES[dn].outer
    # Well wider than the pipe, as far as the nuts behind the flanges leave room.
    pot = min(1.7 * radius + 0.012, 0.5 * length - plate_thickness(dn) - nut_room(dn))
    plate, collar, sides = 0.009 + 0.06 * radius, 1.22 * pot + 0.012, style.round(pot)
    seat, low, wall = rim + plate + 0.012, -(rim + 0.9 * pot), 0.1 * pot
    profile = [(0.35 * pot, low - 0.3 * pot), (0.8 * pot, low - 0.16 * pot), (pot, low)]
    profile += [(pot, seat - plate), (collar, seat - plate), (collar, seat)]
    if style.hollow:
        profile += [(pot - wall, seat), (pot - wall, low + wall), (0.0, low + wall)]
    drain, top, built = 0.25 * pot, seat + plate, style.devices == "built"
    upright = [turned(profile, sides), hexagon(drain, low - 0.3 * pot - 0.6 * drain, low - 0.3 * pot)]
    lid = [cylinder(collar, seat, top, sides)]
    if built:
        # A lid that is lifted off for cleaning has a handle.
        turns = np.linspace(0.0, np.pi, 7)
        high, wide = top - 0.003, 0.5 * pot
        handle = [(wide * np.cos(a), 0.0, high + 0.7 * wide * np.sin(a)) for a in turns]
        lid.append(rope(handle, 0.06 * pot + 0.002, max(6, sides // 4)))
    if built and style.fasteners != "none":
        flats, circle, count = 0.1 * pot + 0.008, 0.5 * (pot + collar) + 0.002, 8 if dn >= 80 else 6
        lid.append(around(hexagon(flats, top, top + 0.6 * flats), count, circle))
        upright.append(around(hexagon(flats, seat - plate - 0.7 * flats, seat - plate), count, circle))
    mouth = _mouth(dn, style, 0.5 * length)
    body = [mouth, moved(mouth, at(length) @ spun("z", np.pi)), *(moved(piece, at(0.5 * length)) for piece in upright)]
    return merge(body), merge(lid)


def strainer(dn: int, style: ModelingStyle) -> Device:
    """A flanged basket strainer, as long as a globe valve (ASME B16.10): a pot under a bolted lid with a handle."""
    length = FACE_TO_FACE["globe"][dn]
    body, lid = _solids(dn, style)
    group, color, place = "Pipe assembly", style.color("valve"), at(length / 2)
    if style.valve == "one":
        return Device(Assembly((Component(merge([body, moved(lid, place)]), group, "strainer", color),)), length)
    parts = (Component(body, group, "strainer", color), Component(lid, group, "strainer", color, place))
    return Device(Assembly(parts, ((0, 1),)), length)
