"""Valves, gauges and pumps of primitives, as plant-design systems draw them: cones, cylinders, boxes."""

from __future__ import annotations

import numpy as np

from cadplants.model.contacts import met
from cadplants.model.plant import Assembly, Component, Device, Unit
from cadplants.model.standards import FLANGES, GAUGES, PIPES
from cadplants.solids.mesh_ops import Solid, about_x, box, merge, moved, revolve, shared, weld
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["cylinder", "gauge_of_primitives", "pump_of_primitives", "valve_of_primitives"]

_PLATE = 0.012  # m; thickness of the discs that stand for a device's own flanges


@shared
def cylinder(radius: float, low: float, high: float, sides: int) -> Solid:
    """A solid cylinder about z between two heights [m]."""
    return weld([revolve([(0.0, low), (radius, low), (radius, high), (0.0, high)], sides)])


def valve_of_primitives(
    unit: str, kind: str, dn: int, length: float, wafer: bool, form: int, style: ModelingStyle
) -> Device:
    """A valve drawn as two cones or one cylinder, with a cylinder for its spindle.

    Args:
        unit: its id.
        kind: of valve that it stands for.
        dn: nominal size.
        length: face to face [m].
        wafer: whether it is held between flanges; it is a cylinder then, with its spindle in a mesh of its own.
        form: 0 cones and spindle in one mesh, 1 in three, 2 a cylinder alone, 3 cones with flanges in one mesh.
        style: that models it.
    """
    size, radius = FLANGES[dn], PIPES[dn].radius
    sides = style.round(size.outer / 2)
    spindle = moved(cylinder(0.35 * radius, 0.0, 1.6 * radius + 0.10, sides), at(length / 2))
    if wafer or form == 2:
        barrel = about_x(cylinder(size.raised / 2 * 0.98, 0.0, length, sides))
        solids = [(barrel, "valve body"), (spindle, "valve stem")] if wafer else [(barrel, "valve body")]
    else:
        cone = _cone(size.raised / 2 * 0.96, 0.16 * radius, length / 2, sides, form == 3)
        back = moved(cone, at(length) @ spun("z", np.pi))
        solids = [(cone, "valve body"), (back, "valve body"), (spindle, "valve stem")]
    if form != 1 and not wafer:
        solids = [(merge([solid for solid, _ in solids]), "valve")]
    parts = tuple(
        Component(solid, "Valve assembly", name, style.color("valve"), unit=unit, granularity="pieces")
        for solid, name in solids
    )
    outlet = 1 if len(parts) == 3 else 0
    return Device(met(Assembly(parts, (), (Unit(unit, "valve", kind),))), length, 0, outlet, wafer)


@shared
def _cone(wide: float, narrow: float, length: float, sides: int, flanged: bool) -> Solid:
    """A cone along x from its wide end at 0, maybe with a disc there."""
    rim = [(1.3 * wide, 0.0), (1.3 * wide, _PLATE), (wide, _PLATE)] if flanged else [(wide, 0.0)]
    return about_x(weld([revolve([(0.0, 0.0), *rim, (narrow, length), (0.0, length)], sides)]))


def gauge_of_primitives(
    unit: str, style: ModelingStyle, size: int, height: float, bite: float
) -> tuple[Component, ...]:
    """A gauge upright on z = 0: a rod and a cylinder, or both as one mesh.

    Args:
        unit: id of the unit.
        style: that models it.
        size: nominal size of the case.
        height: from the foot to the bottom of the case [m].
        bite: how deep the rod runs into the case [m].
    """
    gauge = GAUGES[size]
    stand = at(0, gauge.depth / 2, height + gauge.case / 2) @ spun("x", np.pi / 2)
    rod = cylinder(gauge.thread / 2, 0.0, height + bite, 12)
    case = cylinder(gauge.case / 2, 0.0, gauge.depth, style.round(gauge.case / 2))
    if style.gauge == "one":
        parts = [(merge([rod, moved(case, stand)]), IDENTITY, "gauge")]
    else:
        parts = [(rod, IDENTITY, "gauge stem"), (case, stand, "gauge case")]
    return tuple(
        Component(solid, "Gauge assembly", name, style.color("gauge"), pose, unit) for solid, pose, name in parts
    )


def pump_of_primitives(
    dn: int, out: int, lengths: tuple[float, float, float, float, float], axis: float, style: ModelingStyle
) -> list[tuple[Solid, str]]:
    """A pump along x on z = 0 with the faces of the built one: casing, coupling, motor, base.

    Args:
        dn: nominal size of the suction.
        out: of the discharge.
        lengths: from the volute's plane to the suction face and to the discharge face, the volute's radius, the motor's
            radius and length [m].
        axis: height of the shaft [m].
        style: that models it.
    """
    reach, rise, volute, radius, length = lengths
    sides = style.round(volute)
    level = at(0, 0, axis)
    casing = [
        moved(about_x(cylinder(volute, -0.45 * volute, 0.45 * volute, sides)), level),
        moved(about_x(cylinder(PIPES[dn].radius, -reach, -0.45 * volute, sides)), level),
        moved(about_x(cylinder(FLANGES[dn].outer / 2, -reach, -reach + _PLATE, sides)), level),
        moved(cylinder(PIPES[out].radius, 0.0, rise, sides), level),
        moved(cylinder(FLANGES[out].outer / 2, rise - _PLATE, rise, sides), level),
    ]
    low, high = 0.45 * volute, 0.45 * volute + 0.5 * length
    coupling = moved(about_x(cylinder(0.3 * radius, low, high, sides)), level)
    motor = moved(about_x(cylinder(radius, high, high + length, sides)), level)
    left, right = -0.6 * volute, high + length
    height = axis - max(radius, volute) * 0.98
    base = box((right - left, 2.2 * radius, height), ((left + right) / 2, 0.0, height / 2))
    legs = [box((0.6 * volute, 1.2 * radius, axis - height), (0.0, 0.0, (axis + height) / 2))]
    legs.append(box((0.5 * length, 1.2 * radius, axis - height), (high + length / 2, 0.0, (axis + height) / 2)))
    return [
        (merge([*casing, legs[0]]), "pump casing"),
        (coupling, "shaft"),
        (merge([motor, legs[1]]), "motor"),
        (base, "pump base"),
    ]
