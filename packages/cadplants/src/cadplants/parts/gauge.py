"""Pressure gauges after EN 837-1."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Assembly, Component, Turning, Unit, gather, turned_front
from cadplants.model.standards import GAUGES
from cadplants.parts.primitive_devices import gauge_of_primitives
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, shared, stack, tube, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import IDENTITY, arc, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["pressure_gauge", "side_gauge"]

_NIPPLE = 0.00685  # m, radius of a DN8 pipe (ASME B36.10M)
# What is read looks up in the frame of the case; a gauge in one mesh stands upright, its dial towards -y.
_FRONTS = {
    "gauge": (0.0, -1.0, 0.0),
    "gauge case": (0.0, 0.0, 1.0),
    "gauge face": (0.0, 0.0, 1.0),
    "gauge needle": (0.0, 0.0, 1.0),
}
_BITE = 0.0003  # m; the square of the stem runs this deep into the round case


@shared
def _case_solids(size: int, needle_angle: float, style: ModelingStyle) -> tuple[Solid, Solid, Solid]:
    """Case, dial and needle about z, front towards +z."""
    gauge = GAUGES[size]
    outer, bezel, depth = gauge.case / 2, gauge.bezel / 2, gauge.depth
    sides = style.round(bezel)
    inner, floor = outer - 0.003, depth - 0.009
    lip = depth - 0.010
    case = weld(
        [
            revolve(
                [
                    (0, 0), (outer - 0.002, 0), (outer, 0.002), (outer, lip), (bezel, lip + 0.001),
                    (bezel, depth - 0.0015), (bezel - 0.0015, depth), (inner + 0.001, depth), (inner, depth - 0.001),
                    (inner, floor), (0, floor),
                ],
                sides,
            )
        ]
    )  # fmt: skip
    dial = extrude(circle(inner - 0.0004, sides), floor, floor + 0.001)
    length, tail, wide = 0.78 * inner, 0.25 * inner, 0.035 * inner
    outline = np.array(
        [
            [-tail, -2 * wide],
            [0, -1.5 * wide],
            [length, -0.2 * wide],
            [length, 0.2 * wide],
            [0, 1.5 * wide],
            [-tail, 2 * wide],
        ]
    )
    needle = extrude(outline, floor + 0.001, floor + 0.0022)
    return case, dial, moved(needle, spun("z", needle_angle))


@shared
def _stem_solid(size: int, length: float, style: ModelingStyle) -> Solid:
    """The nipple from 0 up and the square of the gauge's connection."""
    gauge = GAUGES[size]
    square = gauge.square / 2
    corners = np.array([[square, -square], [square, square], [-square, square], [-square, -square]])
    flats = gauge.reach * 0.33
    hexagon = circle(_NIPPLE * 1.55, 6)
    nipple = circle(_NIPPLE, max(12, min(style.round(_NIPPLE), 20)))
    return stack(
        [
            (0.0, 0.012, hexagon),
            (0.012, length - flats - 0.006, nipple),
            (length - flats - 0.006, length - 0.006, corners),
            (length - 0.006, length, circle(min(square * 0.98, 0.0066), 12)),
        ]
    )


@shared
def _whole_solid(size: int, height: float, style: ModelingStyle) -> Solid:
    gauge = GAUGES[size]
    stand = at(0, gauge.depth / 2, height + gauge.case / 2) @ spun("x", np.pi / 2)
    case, dial, _ = _case_solids(size, 0.0, style)
    return merge([_stem_solid(size, height + _BITE, style), moved(case, stand), moved(dial, stand)])


def pressure_gauge(
    unit: str, style: ModelingStyle, size: int = 63, height: float = 0.075, turn: float = 0.0, needle: float = 2.2
) -> Assembly:
    """A pressure gauge standing on z = 0 with its connection pointing down, its dial towards -y.

    Args:
        unit: id of the unit.
        style: that models it.
        size: nominal size of the case, 63, 100 or 160.
        height: from the foot of the stem to the bottom of the case [m].
        turn: of the dial about z [rad].
        needle: angle of the needle [rad].

    Returns:
        Stem, case, dial and needle; or stem and case; or all as one mesh.
    """
    gauge = GAUGES[size]
    if style.devices == "primitives":
        drawn = gauge_of_primitives(unit, style, size, height, _BITE)
        units = (Unit(unit, "gauge", "pressure gauge"),)
        return Assembly(drawn, ((0, 1),) if len(drawn) > 1 else (), units).placed(spun("z", turn))
    stem = _stem_solid(size, round(height + _BITE, 9), style)
    stand = at(0, gauge.depth / 2, height + gauge.case / 2) @ spun("x", np.pi / 2)
    case, dial, pointer = _case_solids(size, round(needle, 3), style)
    if style.gauge == "one":
        parts = [(_whole_solid(size, round(height, 6), style), IDENTITY, "gauge", "gauge")]
    elif style.gauge == "few":
        parts = [(stem, IDENTITY, "gauge stem", "trim"), (merge([case, dial]), stand, "gauge case", "gauge")]
    else:
        parts = [
            (stem, IDENTITY, "gauge stem", "trim"),
            (case, stand, "gauge case", "gauge"),
            (dial, stand, "gauge face", "dial"),
            (pointer, stand, "gauge needle", "needle"),
        ]
    # In the frame of the case; a gauge in one mesh has that of its foot.
    middle = Turning("dial", point=(0.0, 0.0, gauge.depth - 0.008))
    turning = {
        "gauge": middle.placed(stand),
        "gauge case": middle if style.gauge == "few" else None,
        "gauge needle": Turning("needle", point=middle.point),
    }
    components = tuple(
        Component(
            s, "Gauge assembly", name, style.color(c), pose, unit, front=_FRONTS.get(name), turns=turning.get(name)
        )
        for s, pose, name, c in parts
    )
    contacts = tuple((i, i + 1) for i in range(len(components) - 1))
    return Assembly(components, contacts, (Unit(unit, "gauge", "pressure gauge"),)).placed(spun("z", turn))


@shared
def _siphon_solid(out: float, rise: float, style: ModelingStyle) -> Solid:
    bend = 0.024
    corner = np.array([0.0, 0.0, out])
    path = np.vstack(
        [
            [[0.0, 0.0, 0.0]],
            arc((0.0, 0.0, out - bend), corner, (bend, 0.0, out), 6),
            [[rise, 0.0, out]],
        ]
    )
    return tube(path, _NIPPLE, 0.0, max(12, min(style.round(_NIPPLE), 20)))


def side_gauge(
    unit: str,
    style: ModelingStyle,
    size: int = 63,
    out: float = 0.09,
    rise: float = 0.05,
    turn: float = 0.0,
    needle: float = 2.2,
) -> Assembly:
    """A pressure gauge beside a vertical pipe: from z = 0 out along z, then up along x.

    Args:
        unit: id of the unit.
        style: that models it.
        size: nominal size of the case.
        out: how far it stands off [m].
        rise: from that axis to the foot of the gauge's stem [m].
        turn: of the dial about its stem [rad]; 0 looks to -y.
        needle: angle of the needle [rad].
    """
    stand = at(rise, 0.0, out) @ spun("y", np.pi / 2)
    gauge = pressure_gauge(unit, style, size, 0.045, turn, needle).placed(stand)
    solid = _siphon_solid(round(out, 6), round(rise, 6), style)
    if style.gauge == "one":
        whole = merge([solid, moved(gauge.components[0].solid, gauge.components[0].pose)])
        front = turned_front(gauge.components[0].front, gauge.components[0].pose)
        inner = gauge.components[0].turns
        turns = inner.placed(gauge.components[0].pose) if inner is not None else None
        one = Component(whole, "Gauge assembly", "gauge", style.color("gauge"), unit=unit, front=front, turns=turns)
        return Assembly((one,), (), gauge.units)
    pipe = Component(solid, "Gauge assembly", "siphon", style.color("trim"), unit=unit)
    return gather([Assembly((pipe,)), gauge], [(0, 1)])
