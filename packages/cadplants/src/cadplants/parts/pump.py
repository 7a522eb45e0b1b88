"""Horizontal end-suction centrifugal pumps with motor, coupling guard and baseplate (ISO 2858 proportions)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.contacts import met
from cadplants.model.plant import Assembly, Component, Unit
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import face_shell, plate_thickness
from cadplants.parts.primitive_devices import pump_of_primitives
from cadplants.solids.mesh_ops import (
    Branch,
    Solid,
    about_x,
    box,
    branched,
    extrude,
    merge,
    moved,
    revolve,
    shared,
    weld,
)
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Pump", "pump"]


@dataclass(frozen=True)
class Pump:
    """A finished pump.

    Args:
        assembly: casing first.
        suction: frame of the suction face, x outward.
        discharge: frame of the discharge face, x outward.
    """

    assembly: Assembly
    suction: Floats
    discharge: Floats


@dataclass(frozen=True)
class _Size:
    """Lengths [m] after ISO 2858, scaled by the suction nozzle: shaft height, faces from the volute's plane, motor."""

    shaft: float
    reach: float
    rise: float
    volute: float
    half: float
    motor: float
    motor_length: float


def _size(dn: int) -> _Size:
    scale = (PIPES[dn].outer / 0.0889) ** 0.6
    return _Size(
        0.16 * scale, 0.10 * scale + 0.02, 0.20 * scale + 0.02, 0.115 * scale, 0.045 * scale, 0.10 * scale, 0.30 * scale
    )


@shared
def _casing_solid(dn: int, out: int, style: ModelingStyle) -> Solid:
    """Volute about x, suction towards -x, discharge towards +z, the shaft's axis on x; the volute's plane at x = 0."""
    size = _size(dn)
    sides = style.round(size.volute)
    suction, discharge = FLANGES[dn], FLANGES[out]
    thick = plate_thickness(dn)
    neck = 0.5 * suction.hub
    bore, out_bore = (PIPES[dn].bore, PIPES[out].bore) if style.hollow else (0.0, 0.0)
    h = size.half
    profile = [(neck, -size.reach + thick), (neck * 1.02, -h * 1.35), (0.80 * size.volute, -h)]
    profile += [(size.volute, -0.55 * h), (size.volute, 0.55 * h), (0.80 * size.volute, h)]
    tail = [(0.80 * size.volute, h), (0.62 * size.volute, 1.12 * h), (0.0, 1.12 * h)]
    back = 0.5 * discharge.hub
    plate = plate_thickness(out)
    foot = min(0.5 * h, PIPES[out].radius) * 0.95
    rise = (
        (max(foot, 0.9 * PIPES[out].radius), size.volute + 0.35 * (size.rise - size.volute)),
        (back, size.rise - plate),
    )
    body, (rim,) = branched(profile, sides, [Branch(0.0, np.pi / 2, foot, rise)])
    face = moved(face_shell(dn, sides, neck, bore, style.holes), at(0, 0, -size.reach))
    shells = [face, body, revolve(tail, sides)]
    if bore:
        shells.append(revolve([(0.0, -0.2 * h), (bore, -0.2 * h), (bore, -size.reach)], sides))
    main = about_x(weld([*shells, _lid(rim)]))
    # The discharge flange stands on the neck's rim, which has corners of its own; it is a shell of its own.
    head = _disc_flange(out, style, back, out_bore, plate)
    return merge([main, moved(head, at(0, 0, size.rise))])


def _lid(rim: Floats) -> Solid:
    """Closes a branch's last loop."""
    count = len(rim)
    k = np.arange(count)
    faces = np.column_stack([k, (k + 1) % count, np.full(count, count)])
    return Solid(np.vstack([rim, rim.mean(axis=0)]), faces.astype(np.int32))


@shared
def _disc_flange(dn: int, style: ModelingStyle, back: float, bore: float, thick: float) -> Solid:
    """A flange with its face at z = 0 looking up, its back closed; a recess shows where the bore is."""
    sides = style.round(FLANGES[dn].outer / 2)
    head = face_shell(dn, sides, back, bore, style.holes)
    inside = [revolve([(bore, 0.6 * thick), (bore, 0.0)], sides)] if bore else []
    floor = [revolve([(0.0, 0.6 * thick), (bore, 0.6 * thick)], sides)] if bore else []
    lid = revolve([(back, thick), (0.0, thick)], sides)
    return moved(weld([head, *inside, *floor, lid]), spun("x", np.pi))


@shared
def _motor_solids(radius: float, length: float, sides: int, fins: int) -> tuple[Solid, Solid, Solid, Solid]:
    """Motor along x from 0 with cooling fins and feet's height aside, fan cover, terminal box, and its shaft end."""
    inner = 0.86 * radius
    root, tip = inner, radius
    outline = []
    for k in range(fins):
        a = 2 * np.pi * k / fins
        w = 2 * np.pi / fins
        for share, r in ((0.0, root), (0.55, root), (0.60, tip), (0.95, tip)):
            outline.append((r * np.cos(a + share * w), r * np.sin(a + share * w)))
    ribbed = about_x(extrude(np.array(outline), 0.12 * length, 0.80 * length))
    cap = [(0, 0), (0.7 * radius, 0), (radius, 0.04 * length), (radius, 0.12 * length), (0, 0.12 * length)]
    front = about_x(weld([revolve(cap, sides)]))
    body = merge([ribbed, front])
    cover_shape = [(0, 0.80 * length), (radius * 1.02, 0.80 * length), (radius * 1.02, 0.96 * length)]
    cover_shape += [(0.85 * radius, length), (0, length)]
    cover = about_x(weld([revolve(cover_shape, sides)]))
    terminal = box(
        (0.32 * length, 0.9 * radius, 0.5 * radius), (0.38 * length, 0, radius + 0.25 * radius - 0.12 * radius)
    )
    shaft = about_x(extrude(circle(0.17 * radius, 16), -0.25 * length, 0.0))
    return body, cover, terminal, shaft


def pump(unit: str, dn: int, out: int, style: ModelingStyle) -> Pump:
    """A pump along x on z = 0: suction towards -x, discharge upward, motor towards +x.

    Args:
        unit: its id.
        dn: nominal size of the suction.
        out: of the discharge.
        style: that models it.
    """
    size = _size(dn)
    base = 0.11
    axis = base + size.shaft
    h, radius, length = size.half, size.motor, size.motor_length
    group = "Pump unit"
    body, cover, terminal, shaft = _motor_solids(round(radius, 6), round(length, 6), style.round(radius), 28)
    gap = 0.30 * length
    bearing_end = 1.12 * h + 0.9 * length * 0.6
    motor_at = at(bearing_end + gap, 0, axis)
    bearing = _bearing_solid(dn, style)
    guard = _guard_solid(round(0.62 * radius, 6), round(gap - 0.008, 6), size.shaft)
    plate, feet, motor_feet = _base_solids(dn, round(bearing_end + gap + length, 6), base)
    color = style.color
    whole = [
        Component(_casing_solid(dn, out, style), group, "pump casing", color("pump"), at(0, 0, axis)),
        Component(bearing, group, "pump casing", color("pump"), at(1.12 * h, 0, axis)),
        Component(shaft, group, "shaft", color("trim"), motor_at),
        Component(guard, group, "coupling guard", color("safety"), at(bearing_end + 0.004, 0, axis)),
        Component(body, group, "motor", color("motor"), motor_at),
        Component(cover, group, "motor fan cover", color("motor"), motor_at),
        Component(terminal, group, "terminal box", color("motor"), motor_at),
        Component(plate, group, "pump base", color("steel")),
        Component(feet, group, "pump base", color("pump")),
        Component(motor_feet, group, "motor", color("motor")),
    ]
    contacts: tuple[tuple[int, int], ...] = ((0, 1), (2, 4), (4, 5), (4, 6), (3, 7), (7, 8), (0, 8), (7, 9), (4, 9))
    if style.devices == "primitives":
        lengths = (size.reach, size.rise, size.volute, radius, length)
        some = pump_of_primitives(dn, out, lengths, axis, style)
        whole = [Component(solid, group, name, color("pump")) for solid, name in some]
        contacts = met(Assembly(tuple(whole))).contacts
    if style.valve == "one":
        solid = merge([moved(c.solid, c.pose) for c in whole])
        whole, contacts = [Component(solid, group, "pump", color("pump"))], ()
    owned = tuple(Component(c.solid, c.group, c.name, c.color, c.pose, unit) for c in whole)
    assembly = Assembly(owned, contacts, (Unit(unit, "pump", "centrifugal pump"),))
    return Pump(
        assembly,
        looking((-size.reach, 0.0, axis), (-1.0, 0.0, 0.0)),
        looking((0.0, 0.0, axis + size.rise), (0.0, 0.0, 1.0)),
    )


@shared
def _bearing_solid(dn: int, style: ModelingStyle) -> Solid:
    """The bearing bracket behind the volute, along x from 0."""
    size = _size(dn)
    length = 0.9 * size.motor_length * 0.6
    r = size.volute
    profile = [(0, 0), (0.62 * r, 0), (0.62 * r, 0.08 * length), (0.40 * r, 0.25 * length), (0.36 * r, 0.9 * length)]
    profile += [(0.42 * r, 0.92 * length), (0.42 * r, length), (0, length)]
    return about_x(weld([revolve(profile, style.round(r))]))


@shared
def _guard_solid(radius: float, length: float, drop: float) -> Solid:
    """A sheet bent over the coupling, its legs down to z = -``drop``, along x."""
    angles = np.linspace(0.0, np.pi, 17)
    arch = np.column_stack([np.cos(angles), np.sin(angles)])
    outer = np.vstack([[[radius, -drop]], radius * arch, [[-radius, -drop]]])
    thin = radius - 0.002
    inner = np.vstack([[[thin, -drop]], thin * arch, [[-thin, -drop]]])[::-1]
    return about_x(extrude(np.concatenate([outer, inner]), 0.0, length))


@shared
def _base_solids(dn: int, reach: float, height: float) -> tuple[Solid, Solid, Solid]:
    """Baseplate with its top at ``height``, feet of the casing, feet of the motor."""
    size = _size(dn)
    low, high = -0.6 * size.volute, reach + 0.04
    width = 2.2 * size.motor + 0.08
    middle = (low + high) / 2
    plate = extrude(rounded_rectangle(high - low, width, 0.02, 3), 0.0, height)
    plate = moved(plate, at(middle, 0, 0))
    axis = height + size.shaft
    foot = box((1.3 * size.half, 0.9 * size.volute, axis - height - 0.93 * size.volute + 0.002))
    foot = moved(foot, at(0, 0, (height + axis - 0.93 * size.volute + 0.002) / 2))
    start = reach - size.motor_length
    top = axis - 0.80 * size.motor
    block = box((0.10 * size.motor_length, 1.7 * size.motor, top - height))
    places = [at(start + s * size.motor_length, 0, (top + height) / 2) for s in (0.22, 0.70)]
    feet = [moved(block, place) for place in places]
    return plate, foot, merge(feet)
