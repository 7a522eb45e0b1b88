"""Gate and swing check valves along x: inlet face at 0, bonnet towards +z."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Device
from cadplants.model.standards import FACE_TO_FACE, FLANGES, PIPES
from cadplants.parts.flange import face_shell, nut_room, plate_thickness
from cadplants.parts.operator import Topworks, topworks
from cadplants.parts.valve_body import Piece, assemble, bore_of, flipped
from cadplants.solids.mesh_ops import Branch, Solid, about_x, branched, revolve, shared, weld
from cadplants.solids.transforms import IDENTITY, at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["check_valve", "gate_valve"]


def _swollen(dn: int, length: float, bulge: float, flat: float) -> list[tuple[float, float]]:
    """Radius and height of a body that swells behind the nuts; ``flat`` is the share of the swelling that is level."""
    thick, neck = plate_thickness(dn), 0.5 * FLANGES[dn].hub * 0.97
    reach = length / 2 - thick - 0.7 * nut_room(dn)
    profile = [(neck, thick), (neck, length / 2 - reach)]
    for share in (-1.0, -0.5, 0.0):
        angle = share * np.pi / 2
        profile.append(
            (neck + (bulge - neck) * np.cos(angle), length / 2 - reach * (flat - (1 - flat) * np.sin(angle)))
        )
    profile = profile[:2] + profile[3:]
    return profile + [(radius, length - z) for radius, z in reversed(profile)]


def _cast_body(
    dn: int, length: float, bulge: float, throat: float, collar: float, seat: float, plate: float, style: ModelingStyle
) -> Solid:
    """A flanged body with a round neck that ends in a flange at height ``seat``."""
    sides, bore = style.round(FLANGES[dn].outer / 2), bore_of(dn, style)
    rise = ((throat, seat - plate), (collar, seat - plate), (collar, seat), (0.0, seat))
    middle, _ = branched(_swollen(dn, length, bulge, 0.5), sides, [Branch(length / 2, np.pi / 2, throat, rise)])
    head = face_shell(dn, sides, 0.5 * FLANGES[dn].hub * 0.97, bore, style.holes)
    shells = [head, flipped(head, length), middle]
    if bore:
        shells.append(revolve([(bore, length), (bore, 0.0)], sides))
    return about_x(weld(shells))


def _neck_room(dn: int, length: float) -> float:
    """The widest that a bonnet flange can be between the nuts of both ends [m]."""
    return length / 2 - plate_thickness(dn) - nut_room(dn) + 0.004


@shared
def _gate_solids(dn: int, style: ModelingStyle, spokes: int, design: str) -> tuple[Solid, Topworks]:
    radius, length = PIPES[dn].radius, FACE_TO_FACE["gate"][dn]
    bulge = 1.32 * radius + 0.007
    throat = min(0.86 * bulge, 0.62 * _neck_room(dn, length) + 0.006)
    collar = throat + 0.008 + 0.16 * radius
    plate = 0.009 + 0.07 * radius
    # The bonnet's flange clears the nuts of the ends: it sits above the flanges.
    seat = max(bulge + 0.8 * radius, 0.5 * FLANGES[dn].outer + plate + 0.002)
    body = _cast_body(dn, length, bulge, throat, collar, seat, plate, style)
    wheel = min(0.055 + 1.35 * radius, 0.32)
    return body, topworks(seat, collar, plate, radius, style, spokes, wheel, 0.012 + 1.6 * radius, 1.25, design)


def gate_valve(
    unit: str, dn: int, style: ModelingStyle, spokes: int = 5, turn: float = 0.0, wheel: str = "round"
) -> Device:
    """A flanged wedge gate valve with outside screw and yoke and a rising stem (ASME B16.34 pattern), open."""
    body, top = _gate_solids(dn, style, spokes, wheel)
    length = FACE_TO_FACE["gate"][dn]
    pieces: list[Piece] = [(body, IDENTITY, "valve body", "valve"), *top.pieces(at(length / 2), turn)]
    return assemble(pieces, "gate valve", unit, style, Topworks.contacts, 0, length)


@shared
def _cover_solids(dn: int, length: float, style: ModelingStyle) -> tuple[Solid, Solid]:
    """A flanged body along x with a bolted cover, and the cover about its own axis."""
    radius = PIPES[dn].radius
    bulge = 1.36 * radius + 0.007
    throat = min(0.88 * bulge, 0.7 * _neck_room(dn, length) + 0.004)
    collar = throat + 0.008 + 0.14 * radius
    plate = 0.009 + 0.06 * radius
    seat = max(bulge + 0.42 * radius, 0.5 * FLANGES[dn].outer + plate + 0.002)
    body = _cast_body(dn, length, bulge, throat, collar, seat, plate, style)
    dome = 0.5 * throat
    shape = [(0, seat), (collar, seat), (collar, seat + plate), (dome * 1.25, seat + plate)]
    shape += [(dome, seat + plate * 1.6), (0.0, seat + plate * 1.6)]
    return body, weld([revolve(shape, style.round(collar))])


def check_valve(unit: str, dn: int, style: ModelingStyle) -> Device:
    """A flanged swing check valve with a bolted cover; it lets flow pass along +x only."""
    length = FACE_TO_FACE["check"][dn]
    body, cover = _cover_solids(dn, length, style)
    pieces: list[Piece] = [
        (body, IDENTITY, "valve body", "valve"),
        (cover, at(length / 2), "valve bonnet", "valve"),
    ]
    return assemble(pieces, "check valve", unit, style, ((0, 1),), 0, length)
