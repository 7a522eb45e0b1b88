"""Flanged valves along x: inlet face at 0, stem towards +z."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadplants.model.plant import Device
from cadplants.model.standards import FACE_TO_FACE, FLANGES, PIPES
from cadplants.parts.butterfly import butterfly_valve
from cadplants.parts.flange import face_shell, nut_circle, nut_room, plate_thickness
from cadplants.parts.gate import check_valve, gate_valve
from cadplants.parts.operator import Topworks, actuator_solids, lever_solid, topworks
from cadplants.parts.valve_body import Piece, assemble, bore_of, flipped
from cadplants.solids.mesh_ops import (
    Branch,
    Solid,
    about_x,
    branched,
    revolve,
    shared,
    stack,
    weld,
)
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["VALVES", "ball_valve", "globe_valve", "valve_length"]


def valve_length(kind: str, dn: int) -> float:
    """Face to face [m] of a ``ball``, ``gate``, ``globe``, ``check`` or ``butterfly`` valve (ASME B16.10)."""
    return FACE_TO_FACE[kind][dn]


# --- ball valves ---


@shared
def _ball_solids(dn: int, style: ModelingStyle, build: str, straight: bool) -> tuple[Solid, Solid, Solid, Solid, float]:
    """Body, end piece, stem with gland, lever (about its foot); and the height of the lever's underside."""
    size, radius, length = FLANGES[dn], PIPES[dn].radius, valve_length("ball", dn)
    thick, bore = plate_thickness(dn), bore_of(dn, style)
    sides = style.round(size.outer / 2)
    neck, barrel = 0.5 * size.hub * 0.98, min(1.55 * radius + 0.006, 0.44 * size.outer)
    split, rim, web = 0.62 * length, min(barrel + 0.011, 0.485 * size.outer), 0.08 * length
    if build == "barrel":
        rim, web = barrel * 0.93, 0.03 * length
    center = 0.40 * length
    boss = min(0.36 * radius + 0.006, 0.16 * length)
    top = barrel + 0.35 * radius + 0.006
    room = thick + nut_room(dn)
    outside = [(neck, thick), (neck, room - 0.004), (barrel, room), (barrel, split - web)]
    middle, _ = branched(outside, sides, [Branch(center, np.pi / 2, boss, ((boss, top), (0.0, top)))])
    ring = [(barrel, split - web), (rim, split - web), (rim, split), (bore, split)]
    body = [face_shell(dn, sides, neck, bore, style.holes), middle, revolve(ring, sides)]
    room = length - room
    end_neck = [(bore, split), (rim, split), (rim, split + web), (neck, min(split + 2.0 * web, room))]
    end_neck += [(neck, length - thick)]
    end = [flipped(face_shell(dn, sides, neck, bore, style.holes), length), revolve(end_neck, sides)]
    if bore:
        body.append(revolve([(bore, split), (bore, 0.0)], sides))
        end.append(revolve([(bore, length), (bore, split)], sides))
    shank = 0.45 * boss
    lift = 0.3 * radius + 0.010
    stem = stack(
        [
            (top, top + 0.3 * lift, circle(0.82 * boss, 6)),
            (top + 0.3 * lift, top + lift, circle(shank, 12)),
        ]
    )
    lever = lever_solid(0.10 + 2.6 * radius, 0.010 + 0.30 * radius, 0.006, straight)
    return about_x(weld(body)), about_x(weld(end)), stem, lever, top + lift


def ball_valve(
    unit: str, dn: int, style: ModelingStyle, turn: float = 0.0, lever: str = "cranked", build: str = "two-piece"
) -> Device:
    """A flanged ball valve with a lever.

    Args:
        unit: its id.
        dn: nominal size.
        style: that models it.
        turn: of the lever about the stem [rad]; 0 is open.
        lever: its style, see ``Make``; or ``actuator``.
        build: of the body, see ``Make``.
    """
    body, end, stem, arm, height = _ball_solids(dn, style, build, lever == "straight")
    stand = at(0.40 * valve_length("ball", dn))
    pose = stand @ at(0, 0, height)
    pieces: list[Piece] = [(body, IDENTITY, "valve body", "valve"), (stem, stand, "valve stem", "trim")]
    contacts = [(0, 1), (1, 2)]
    if lever == "actuator":
        block, knob = actuator_solids(PIPES[dn].radius)
        pieces += [(block, pose, "actuator", "trim"), (knob, pose, "position indicator", "handle")]
        contacts.append((2, 3))
    else:
        pieces.append((arm, pose @ spun("z", turn), "lever", "handle"))
    outlet = len(pieces)
    pieces.append((end, IDENTITY, "valve body", "valve"))
    contacts.append((0, outlet))
    return assemble(pieces, "ball valve", unit, style, tuple(contacts), outlet, valve_length("ball", dn))


# --- globe valves ---


@shared
def _globe_solids(dn: int, style: ModelingStyle, spokes: int, design: str, build: str) -> tuple[Solid, Topworks]:
    """Body, and what stands on it."""
    size, radius, length = FLANGES[dn], PIPES[dn].radius, valve_length("globe", dn)
    thick, bore = plate_thickness(dn), bore_of(dn, style)
    sides = style.round(size.outer / 2)
    neck, bulge = 0.5 * size.hub * 0.97, 1.5 * radius + 0.008
    half = length / 2 - thick
    # Small sizes swell only behind the nuts.
    reach = 0.86 * half if bulge < nut_circle(dn) else length / 2 - thick - nut_room(dn)
    swell = [(neck, thick), (neck, length / 2 - 1.05 * reach)]
    for share in np.linspace(-0.85, 0.85, 11):
        full = (1 - share**2) ** 0.5 if build == "sphere" else min(1.0, 4.0 * (1 - abs(share)))
        swell.append((neck + (bulge - neck) * full, length / 2 + share * reach))
    swell += [(neck, length / 2 + 1.05 * reach), (neck, length - thick)]
    throat = 0.80 * bulge
    collar = throat + min(0.016, max(0.006, length / 2 - thick - nut_room(dn) - throat))
    seat = bulge + 0.28 * radius + 0.010
    plate = 0.010 + 0.06 * radius
    rise = ((throat, seat - plate), (collar, seat - plate), (collar, seat), (0.0, seat))
    middle, _ = branched(swell, sides, [Branch(length / 2, np.pi / 2, throat, rise)])
    head = face_shell(dn, sides, neck, bore, style.holes)
    body = [head, flipped(head, length), middle]
    if bore:
        body.append(revolve([(bore, length), (bore, 0.0)], sides))
    top = topworks(seat, collar, plate, radius, style, spokes, min(0.050 + 1.45 * radius, 0.30), design=design)
    return about_x(weld(body)), top


def globe_valve(
    unit: str,
    dn: int,
    style: ModelingStyle,
    spokes: int = 5,
    turn: float = 0.0,
    wheel: str = "round",
    build: str = "sphere",
) -> Device:
    """A flanged globe valve with bolted bonnet, outside yoke and handwheel.

    Args:
        unit: its id.
        dn: nominal size.
        style: that models it.
        spokes: of the wheel.
        turn: of the wheel [rad].
        wheel: its style, see ``Make``.
        build: of the body, see ``Make``.
    """
    body, top = _globe_solids(dn, style, spokes, wheel, build)
    length = valve_length("globe", dn)
    pieces: list[Piece] = [(body, IDENTITY, "valve body", "valve"), *top.pieces(at(length / 2), turn)]
    return assemble(pieces, "globe valve", unit, style, Topworks.contacts, 0, length)


VALVES: dict[str, Callable[..., Device]] = {
    "ball": ball_valve,
    "butterfly": butterfly_valve,
    "check": check_valve,
    "gate": gate_valve,
    "globe": globe_valve,
}
