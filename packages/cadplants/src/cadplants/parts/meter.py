"""The flow meter of the presets, along x: inlet face at 0, its transmitter towards +z."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Assembly, Component, Device, Unit
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import face_shell, nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of, flipped
from cadplants.solids.mesh_ops import Branch, Solid, about_x, branched, merge, moved, revolve, shared, stack, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["flow_meter"]


def _meter_length(dn: int) -> float:
    """Face to face [m]: 200 mm up to DN100 and 2.2 diameters above, as ISO 13359 lays down for magnetic flow meters."""
    if dn <= 100:
        return 0.200 if dn <= 80 else 0.250
    return round(max(0.250, 2.0 * PIPES[dn].outer), 3)


@shared
def _meter_solids(dn: int, style: ModelingStyle) -> tuple[Solid, Solid]:
    size, radius, length = FLANGES[dn], PIPES[dn].radius, _meter_length(dn)
    thick, bore, sides = plate_thickness(dn), bore_of(dn, style), style.round(FLANGES[dn].outer / 2)
    neck = 0.5 * size.hub * 0.97
    room = min(thick + nut_room(dn), 0.5 * length - 0.030)
    drum = max(1.25 * radius + 0.012, neck * 1.05)
    profile = [
        (neck, thick),
        (neck, room),
        (drum, room),
        (drum, length - room),
        (neck, length - room),
        (neck, length - thick),
    ]
    top = drum + 0.045 + 0.25 * radius
    stub = min(0.016, 0.4 * (length - 2 * room), 0.6 * drum)
    rise = ((stub, top - 0.010), (stub + 0.010, top - 0.010), (stub + 0.010, top), (0.0, top))
    middle, _ = branched(profile, sides, [Branch(length / 2, np.pi / 2, stub, rise)])
    head = face_shell(dn, sides, neck, bore, style.holes)
    shells = [head, flipped(head, length), middle]
    if bore:
        shells.append(revolve([(bore, length), (bore, 0.0)], sides))
    drum_sides = style.round(0.055)
    case = stack([(top, top + 0.012, circle(0.030, drum_sides)), (top + 0.012, top + 0.075, circle(0.055, drum_sides))])
    lid = weld([revolve([(0, 0), (0.050, 0), (0.050, 0.018), (0.042, 0.026), (0, 0.026)], drum_sides)])
    housing = merge([case, moved(lid, at(0, 0, top + 0.075))])
    return about_x(weld(shells)), housing


def flow_meter(unit: str, dn: int, style: ModelingStyle) -> Device:
    """A flanged magnetic flow meter with its transmitter on top."""
    body, housing = _meter_solids(dn, style)
    length = _meter_length(dn)
    group = "Gauge assembly"
    stand = at(length / 2)
    if style.gauge == "one":
        whole = Component(merge([body, moved(housing, stand)]), group, "gauge", style.color("gauge"), unit=unit)
        parts, contacts = (whole,), ()
        return Device(Assembly(parts, contacts, (Unit(unit, "gauge", "flow meter"),)), length)
    both = (
        Component(body, group, "flow meter", style.color("gauge"), unit=unit),
        Component(housing, group, "transmitter", style.color("valve"), stand, unit),
    )
    return Device(Assembly(both, ((0, 1),), (Unit(unit, "gauge", "flow meter"),)), length)
