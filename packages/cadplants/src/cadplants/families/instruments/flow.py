"""Flow meters in a line, on an outlet, on a pipe's outside and on the floor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.families.instruments.pieces import JOINT, STEM, bent, gland, housing, piece, t_handle
from cadplants.families.instruments.pressure import differential_cell
from cadplants.families.valves.valve import flanged_body
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["FLOW_BUILDS", "measuring_tube", "meter_family"]

_NAME = "flow meter"
Outline = Sequence[tuple[float, float]]


def measuring_tube(
    dn: int, style: ModelingStyle, length: float, middle: Outline | None = None, throat: Outline = ()
) -> Solid:
    """A measuring tube between flanges; its middle as wide as a pipe and its bore straight unless given [m]."""
    r = 1.02 * PIPES[dn].radius
    low = plate_thickness(dn) + min(0.7 * nut_room(dn), 0.15 * length)
    return flanged_body(dn, style, length, middle or [(r, low), (r, length - low)], throat)


def _electronics(
    x: float, top: float, style: ModelingStyle, rng: np.random.Generator, shape: str = "", clear: float = 0.0
) -> list[Part]:
    """A post at ``x`` from inside a body this high up, ``clear`` and more over it, with a transmitter's housing [m]."""
    rise, r = top + clear + float(rng.uniform(0.03, 0.12)), float(rng.uniform(0.011, 0.02))
    post = [cylinder(r, 0.8 * top, rise, 14)]
    if rng.random() < 0.4:
        post.append(cylinder(1.7 * r, rise - 0.01, rise, 14))
    head = moved(
        housing(style, rng, shape), at(x, 0, rise - 0.002) @ spun("z", float(rng.choice([0.0, np.pi / 2, np.pi])))
    )
    return [piece(moved(merge(post), at(x)), _NAME, "gauge"), piece(head, "transmitter", "valve")]


def _impulse(first: float, second: float, r: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Two tappings on top of a tube of radius ``r``, their valves, and a differential transmitter over them [m]."""
    high = r + float(rng.uniform(0.09, 0.16))
    parts, mid = [], (first + second) / 2
    ends = []
    for x, s in ((first, -1), (second, 1)):
        boss = [
            cylinder(0.016, 0.7 * r, r + 0.014, 12),
            cylinder(0.0068, r, r + 0.05, 10),
            box((0.024, 0.024, 0.03), (0, 0, r + 0.045)),
        ]
        boss.append(along("-y", t_handle(0.045, 0.04), 0, -0.011, r + 0.045))
        parts.append(piece(moved(merge(boss), at(x)), STEM, "trim"))
        ends.append(
            bent(
                [
                    (x, 0, r + 0.058),
                    (x, 0, high - 0.02),
                    (mid + 0.02 * s, 0, high - 0.005),
                    (mid + 0.02 * s, 0, high + 0.02),
                ],
                0.0065,
                style,
            )
        )
    parts.append(piece(ends, STEM, "trim"))
    cell, top = differential_cell(style, rng, bool(rng.random() < 0.5))
    head = piece(
        moved(housing(style, rng, str(rng.choice(["double", "single"]))), at(0, 0, top)), "transmitter", "valve"
    )
    return [*parts, *placed([*cell, head], at(mid, 0, high + 0.015))]


def _ultrasonic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An inline ultrasonic meter: slanting transducer pockets on both sides of a spool, cables, a box on a neck."""
    radius = PIPES[dn].radius
    length = round(0.22 + float(rng.uniform(3.5, 6)) * radius, 6)
    parts = [piece(measuring_tube(dn, style, length), _NAME, "gauge")]
    r, lean = 0.012 + 0.1 * radius, float(rng.uniform(0.6, 0.9))
    pocket = merge(
        [
            cylinder(r, 0.5 * radius, 1.5 * radius + 0.04, 14),
            hexagon(2.3 * r, 1.5 * radius + 0.035, 1.5 * radius + 0.055),
        ]
    )
    paths = 1 if dn < 80 else int(rng.integers(1, 4))
    for k in range(paths):
        z = (k - (paths - 1) / 2) * 0.5 * radius
        for s, side in ((-1, 1), (1, -1)):
            pose = (
                at(length / 2 + s * 0.25 * radius, 0, z) @ spun("z", 0.0 if side > 0 else np.pi) @ spun("x", -np.pi / 2)
            )
            parts.append(piece(moved(pocket, pose @ spun("y", -lean)), _NAME, "trim"))
    return Model(
        [*parts, *_electronics(length / 2, radius, style, rng, str(rng.choice(["rectangle", "double", "pot"])))],
        length,
        kind=_NAME,
    )


def _clamp_on(dn: int, style: ModelingStyle, rng: np.random.Generator, _: float) -> Model:
    """A clamp-on ultrasonic meter: two transducers on a rail or apart, bands round the pipe, cables to a small box."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    tall, wide, long = float(rng.uniform(0.02, 0.04)), float(rng.uniform(0.018, 0.03)), float(rng.uniform(0.035, 0.06))
    apart = float(rng.uniform(0.045, 0.07))
    # Feet that fit the round pipe: a block let into its skin by a hair would do, so its foot is a saddle of two bars.
    body = merge(
        [
            box((long, wide, tall), (0, 0, r + 0.003 + tall / 2)),
            box((0.8 * long, min(wide, 0.6 * r), 0.004), (0, 0, r + 0.0015)),
        ]
    )
    z_form = bool(rng.random() < 0.4)
    pods = [moved(body, at(s * apart) @ spun("x", np.pi if z_form and s > 0 else 0.0)) for s in (-1, 1)]
    parts = [piece(pods, _NAME, str(rng.choice(["gauge", "electrical", "rubber"])))]
    bands = [along("x", ring(r, r + 0.0012, -0.006, 0.006, n), s * apart) for s in (-1, 1)]
    lock = [box((0.014, 0.012, 0.02), (s * apart, r + 0.006, 0)) for s in (-1, 1)]
    parts.append(Part(merge([*bands, *lock]), "clamp", "clamp", _NAME, JOINT))
    top = r + tall + 0.002
    if not z_form and rng.random() < 0.6:
        rail = [box((2 * apart + long + 0.02, 0.004, 0.02), (0, s * (wide / 2 + 0.002), r + 0.012)) for s in (-1, 1)]
        parts.append(piece(rail, _NAME, "steel"))
    lead = [(-apart, 0, top), (-apart, 0, top + 0.05), (-0.2 * apart, 0, top + 0.07), (0, 0, top + 0.14)]
    parts.append(piece(bent(lead, 0.003, style), _NAME, "rubber"))
    crate = moved(housing(style, rng, "rectangle"), at(0, 0, top + 0.135))
    # The box stands on a strip that a third band holds behind it.
    strip = box((0.025, 0.004, top + 0.19), (0, r + 0.0022, (top + 0.19) / 2))
    arm = box((0.025, r + 0.004, 0.004), (0, (r + 0.004) / 2, top + 0.137))
    hold = along("x", ring(r, r + 0.0012, -0.008, 0.008, n))
    parts.append(Part(merge([strip, arm, hold]), "bracket", "clamp", "", JOINT))
    return Model([*parts, piece(crate, "transmitter", "electrical")], kind=_NAME)


def _wedge(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wedge meter: a tube with a V let into its top, a tapping on either side of it, a differential transmitter."""
    radius = PIPES[dn].radius
    length = round(0.34 + 5 * radius, 6)
    a = 0.8 * radius
    v = extrude(np.array([(-a, 1.15 * radius), (0.0, 0.3 * radius), (a, 1.15 * radius)]), -0.6 * radius, 0.6 * radius)
    v = moved(v, at(length / 2) @ spun("x", np.pi / 2))
    parts = [piece([measuring_tube(dn, style, length), v], _NAME, "gauge")]
    off = 0.05 + 1.2 * radius
    return Model([*parts, *_impulse(length / 2 - off, length / 2 + off, 1.15 * radius, style, rng)], length, kind=_NAME)


def _cone(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cone meter: a plain spool with a tapping before the cone and one at it, a differential transmitter above."""
    radius = PIPES[dn].radius
    length = round(0.3 + 4.5 * radius, 6)
    low = plate_thickness(dn) + 0.03
    parts = [piece(measuring_tube(dn, style, length), _NAME, "gauge")]
    parts.append(
        piece(along("x", ring(1.0 * radius, 1.12 * radius, low, low + 0.02, style.round(radius))), _NAME, "trim")
    )
    return Model([*parts, *_impulse(length / 2 - 0.035, length / 2 + 0.035, radius, style, rng)], length, kind=_NAME)


def _venturi(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Venturi tube (ISO 5167-4): 21 degree inlet cone, throat, long 7 to 15 degree outlet, maybe annular chambers."""
    radius = PIPES[dn].radius
    throat, low = float(rng.uniform(0.45, 0.7)) * radius + 0.003, plate_thickness(dn) + 0.04
    inlet, outlet = (
        (radius - throat) / np.tan(np.radians(10.5)),
        (radius - throat) / np.tan(np.radians(rng.uniform(5, 7.5))),
    )
    a, b = low + 1.0 * radius, low + 1.0 * radius + inlet
    c = b + 2 * throat + 0.02
    length = round(float(c + outlet + low + 0.01), 6)
    r = 1.02 * radius
    middle = [(r, low), (r, a), (1.1 * throat, b), (1.1 * throat, c), (r, length - low)]
    # Its bore narrows with it, so that a straight one would break through.
    bore, neck = PIPES[dn].bore, 0.85 * throat
    narrow = [(bore, a), (neck, b), (neck, c), (bore, length - low)]
    parts = [
        piece(measuring_tube(dn, style, length, [(float(p), float(q)) for p, q in middle], narrow), _NAME, "gauge")
    ]
    mid = (b + c) / 2
    chambers = [(0.5 * (low + a), r), (mid, 1.1 * throat)]
    if rng.random() < 0.6:
        for x, q in chambers:
            half = 0.3 * throat + 0.008
            parts.append(
                piece(along("x", ring(0.98 * q, 1.25 * q + 0.006, x - half, x + half, style.round(q))), _NAME, "gauge")
            )
    for x, q in chambers:
        tap = [
            cylinder(0.012, 0.9 * q, 1.3 * radius + 0.03, 12),
            hexagon(0.03, 1.3 * radius + 0.02, 1.3 * radius + 0.045),
            along("-y", t_handle(0.05, 0.045), 0, -0.01, 1.3 * radius + 0.034),
        ]
        parts.append(piece(moved(merge(tap), at(float(x))), STEM, "trim"))
    return Model(parts, length, kind=_NAME)


def _nozzle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flow nozzle or carrier ring between flanges (ISO 5167-3): a thick ring with two tappings and a cell above."""
    size, n = FLANGES[dn], style.round(FLANGES[dn].circle / 2)
    outer, thick = 0.49 * (size.circle - size.bolt), float(rng.uniform(0.04, 0.08))
    body = [
        along("x", ring(0.8 * PIPES[dn].bore, outer, 0.0, thick, n)),
        along("x", ring(0.5 * PIPES[dn].bore, 0.85 * PIPES[dn].bore, 0.2 * thick, 0.6 * thick, n)),
    ]
    rise = size.outer / 2 + float(rng.uniform(0.03, 0.09))
    lines = [rod((x * thick, 0, outer - 0.004), (x * thick, 0, rise), 0.0055, 10) for x in (0.22, 0.78)]
    block = box((thick + 0.03, 0.05, 0.05), (thick / 2, 0, rise + 0.02))
    handles = [along("-y", t_handle(0.05, 0.045), x * thick, -0.024, rise + 0.02) for x in (0.1, 0.9)]
    parts = [piece(body, _NAME, "trim"), piece([*lines, block, *handles], STEM, "trim")]
    cell, top = differential_cell(style, rng, bool(rng.random() < 0.6))
    head = piece(moved(housing(style, rng, "double"), at(0, 0, top)), "transmitter", "valve")
    return Model([*parts, *placed([*cell, head], at(thick / 2, 0, rise + 0.0445))], round(thick, 6), "wafer", _NAME)


def _pitot(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An averaging pitot bar: a weld boss, a nut or a flange pair, a head with two valves and a cell."""
    out, n = float(rng.uniform(0.06, 0.14)), 14
    body = [turned([(0.026, 0.0), (0.02, 0.02), (0.016, 0.024)], n), cylinder(0.009, -0.04, out, n)]
    if rng.random() < 0.5:
        body += [hexagon(0.036, 0.022, 0.045), hexagon(0.032, 0.048, 0.065)]
    else:
        plates = [extrude(rounded_rectangle(0.09, 0.09, 0.01, 2), z, z + 0.012) for z in (0.024, 0.05)]
        rods = [moved(cylinder(0.005, 0.015, 0.075, 8), at(x, y)) for x in (-0.033, 0.033) for y in (-0.033, 0.033)]
        body += [*plates, *rods]
    high = out + 0.02
    body.append(box((0.08, 0.03, 0.045), (0, 0, high)))
    body += [along(a, t_handle(0.05, 0.045), s * 0.039, 0, high) for a, s in (("x", 1), ("-x", -1))]
    parts = [piece(body, _NAME, "trim")]
    cell, top = differential_cell(style, rng, bool(rng.random() < 0.7))
    head = piece(
        moved(housing(style, rng, str(rng.choice(["double", "single"]))), at(0, 0, top)), "transmitter", "valve"
    )
    parts += placed([*cell, head], at(0, 0, high + 0.022))
    return Model(placed(parts, spun("z", float(rng.choice([0.0, np.pi / 2])))), kind=_NAME)


def _thermal(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermal mass meter to push in: a ball valve, a compression fitting, a long graduated rod, a housing."""
    long, r, n = float(rng.uniform(0.12, 0.35)), float(rng.uniform(0.006, 0.0105)), 12
    parts: list[Part] = []
    low = 0.01
    if rng.random() < 0.6:
        valve = [
            cylinder(0.013, 0.0, 0.075, n),
            hexagon(0.034, 0.006, 0.02),
            hexagon(0.034, 0.056, 0.07),
            cylinder(0.021, 0.02, 0.056, n),
        ]
        lever = [
            along("y", cylinder(0.005, 0.018, 0.036, 8), 0, 0, 0.038),
            box((0.11, 0.005, 0.018), (0.045, 0.036, 0.038)),
        ]
        parts = [
            Part(merge(valve), "valve body", "valve", _NAME, "Valve assembly"),
            Part(merge(lever), "lever", "handle", _NAME, "Valve assembly"),
        ]
        low = 0.073
    shaft = [
        cylinder(r, 0.0, low + long, n),
        hexagon(3.6 * r, low - 0.001, low + 0.016),
        hexagon(3.2 * r, low + 0.018, low + 0.034),
    ]
    head = moved(housing(style, rng), at(0, 0, low + long - 0.003) @ spun("z", float(rng.uniform(0, 6))))
    return Model([*parts, piece(shaft, _NAME, "trim"), piece(head, "transmitter", "valve")], kind=_NAME)


def _wafer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A magnetic or vortex meter as a wafer between the flanges: a short drum inside the bolts, a neck, a housing."""
    size = FLANGES[dn]
    outer, length = 0.485 * (size.circle - size.bolt), round(float(rng.uniform(0.06, 0.1)) + 0.5 * PIPES[dn].radius, 6)
    n, bore = style.round(outer), 0.95 * PIPES[dn].bore
    if rng.random() < 0.5:
        body = ring(bore, outer, 0.0, length, n)
        solids = [about_x(body)]
    else:
        solids = [
            about_x(ring(bore, q, a * length, b * length, n))
            for q, a, b in ((outer, 0.0, 0.14), (0.88 * outer, 0.13, 0.87), (outer, 0.86, 1.0))
        ]
    return Model(
        [piece(solids, _NAME, "gauge"), *_electronics(length / 2, outer, style, rng, "", size.outer / 2 - outer)],
        length,
        "wafer",
        _NAME,
    )


def _clamshell(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A magnetic meter in a boxy or eight-sided casing with a seam, a terminal box on its top."""
    radius = PIPES[dn].radius
    length = round(max(0.2, float(rng.uniform(2.2, 3.2)) * PIPES[dn].outer + 0.06), 6)
    low = plate_thickness(dn) + min(nut_room(dn), 0.2 * length)
    reach = 1.45 * radius + 0.01
    if rng.random() < 0.5:
        casing = extrude(rounded_rectangle(2 * reach, 2 * reach, 0.3 * reach, 3), low, length - low)
    else:
        casing = turned([(1.08 * reach, low), (1.08 * reach, length - low)], 8, np.pi / 8)
    seam = box((length - 2 * low, 2.36 * reach, 0.006), (length / 2, 0, 0))
    parts = [piece([measuring_tube(dn, style, length), along("x", casing), seam], _NAME, "gauge")]
    wide, tall = float(rng.uniform(0.07, 0.12)), float(rng.uniform(0.04, 0.07))
    z = 0.95 * reach
    crate = [
        cylinder(0.02, 0.8 * z, z + 0.03, 12),
        box((wide, wide, tall), (0, 0, z + 0.028 + tall / 2)),
        box((1.04 * wide, 1.04 * wide, 0.006), (0, 0, z + 0.03 + tall)),
    ]
    crate += [
        along("-y", gland(style, rng), x * wide, -0.5 * wide + 0.001, z + 0.028 + 0.4 * tall) for x in (-0.25, 0.25)
    ]
    return Model([*parts, piece(moved(merge(crate), at(length / 2)), "transmitter", "electrical")], length, kind=_NAME)


def _straight(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A straight-tube or slim Coriolis meter: a long case with end cones or a belly, a housing on a neck."""
    radius = PIPES[dn].radius
    length = round(0.35 + float(rng.uniform(8, 12)) * radius, 6)
    low, neck, r = plate_thickness(dn) + 0.05, 0.485 * FLANGES[dn].hub, 1.7 * radius + 0.015
    middle = [(0.9 * neck, low), (r, low + 0.8 * r), (r, length - low - 0.8 * r), (0.9 * neck, length - low)]
    if rng.random() < 0.4:
        middle = [
            (0.9 * neck, low),
            (0.9 * r, low + 0.5 * r),
            (1.15 * r, length / 2),
            (0.9 * r, length - low - 0.5 * r),
            (0.9 * neck, length - low),
        ]
    parts = [piece(measuring_tube(dn, style, length, middle), _NAME, "trim")]
    if rng.random() < 0.5:
        bands = [
            along("x", ring(0.95 * r, 1.06 * r, s * length, s * length + 0.012, style.round(r))) for s in (0.4, 0.6)
        ]
        parts.append(piece(bands, _NAME, "trim"))
    return Model([*parts, *_electronics(length / 2, 1.1 * r, style, rng)], length, kind=_NAME)


def meter_family(
    name: str, build: object, place: str = "inline", sizes: tuple[int, ...] = SIZES, weight: float = 1.0
) -> Family:
    """A family of flow meters."""
    return Family(name, place, "Gauge assembly", _NAME, build, sizes, weight=weight)  # type: ignore[arg-type]


_SMALL = tuple(dn for dn in SIZES if dn <= 50)
_SOME = tuple(dn for dn in SIZES if dn <= 150)
FLOW_BUILDS: tuple[Family, ...] = (
    meter_family("flow meter/ultrasonic", _ultrasonic),
    meter_family("flow meter/clamp-on", _clamp_on, "carrier"),
    meter_family("flow meter/wedge", _wedge),
    meter_family("flow meter/cone", _cone),
    meter_family("flow meter/venturi", _venturi),
    meter_family("flow meter/nozzle", _nozzle, sizes=tuple(dn for dn in SIZES if dn >= 25)),
    meter_family("flow meter/pitot bar", _pitot, "tap", (15,)),
    meter_family("flow meter/thermal insertion", _thermal, "tap", (15,)),
    meter_family("flow meter/wafer", _wafer),
    meter_family("flow meter/boxy remote", _clamshell),
    meter_family("flow meter/straight coriolis", _straight, sizes=_SOME),
)
