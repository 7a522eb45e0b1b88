"""Flow meters with registers and counters, and small plastic and brass ones."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.flow import measuring_tube, meter_family
from cadplants.families.instruments.pieces import CASE, JOINT, bent, housing, piece, screws
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, looking, spun
from cadplants.valve_body import bore_of

__all__ = ["COUNTER_BUILDS"]

_NAME = "flow meter"


def _counter(r: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A round register about z from 0 up: a case, a window of figures, maybe an open lid [m]."""
    n, tall = style.round(r), float(rng.uniform(0.5, 1.1)) * r
    case = [turned([(0.9 * r, 0.0), (r, 0.1 * tall), (r, 0.9 * tall), (0.92 * r, tall)], n)]
    if rng.random() < 0.4:
        lid = moved(
            cylinder(r, 0.0, 0.06 * r, n), at(0, 0.95 * r, tall) @ spun("x", float(rng.uniform(0.8, 1.7))) @ at(0, r)
        )
        case += [lid, along("x", cylinder(0.06 * r, -0.3 * r, 0.3 * r, 8), 0, r, tall)]
    face = [
        cylinder(0.85 * r, tall - 0.0005, tall + 0.001, n),
        box((0.8 * r, 0.2 * r, 0.002), (0, 0.3 * r, tall + 0.0015)),
    ]
    return [
        piece(case, CASE, str(rng.choice(["handle", "valve", "electrical"]))),
        piece(face, "gauge face", "dial", CASE),
    ]


def _acrylic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A variable-area meter of clear plastic: a cone or drilled block between union nuts, a scale, a float, stops."""
    radius = PIPES[dn].radius
    length = round(0.16 + float(rng.uniform(5, 9)) * radius, 6)
    r, n = 1.5 * radius + 0.004, style.round(1.5 * radius)
    low = 0.2 * length
    ends = [hex_end(dn, 0, 0.1 * length, style, 8), hex_end(dn, 0.9 * length, length, style, 8)]
    nut = around(box((0.2 * r, 0.3 * r, 0.1 * length), (0, 0, 0.15 * length)), 10, 1.42 * r)
    nut = merge([cylinder(1.45 * r, 0.09 * length, low, n), nut])
    nuts = [along("x", nut), moved(along("x", nut), at(length) @ spun("z", np.pi))]
    if rng.random() < 0.5:
        clear = along("x", turned([(0.95 * r, low - 0.002), (1.25 * r, length - low + 0.002)], n))
    else:
        clear = along("x", extrude(rounded_rectangle(2.6 * r, 2.2 * r, 0.15 * r, 2), low - 0.002, length - low + 0.002))
    place = float(rng.uniform(0.35, 0.65)) * length
    bob = along("x", turned([(0.1 * r, place - 0.4 * r), (0.7 * r, place), (0.7 * r, place + 0.2 * r)], 12))
    # A rod guides the float from end to end.
    bob = merge([bob, along("x", cylinder(0.08 * r, 0.1 * length, 0.9 * length, 8))])
    ticks = [box((0.002, 0.5 * r, 0.001), (x * length, 0, 1.31 * r)) for x in np.linspace(0.28, 0.72, 9)]
    parts = [piece([*ends, *nuts], _NAME, "rubber"), piece(clear, "gauge glass", "dial", _NAME)]
    parts += [
        piece(bob, "gauge needle", "trim", _NAME),
        piece([box((0.5 * length, 0.6 * r, 0.01), (length / 2, 0, 1.255 * r)), *ticks], "gauge face", "dial", _NAME),
    ]
    return Model(parts, length, "welded", _NAME)


def _paddle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A paddle-wheel sensor in a plastic tee or on a saddle: a union nut on a neck, a body, a display or plug."""
    radius = PIPES[dn].radius
    length, n = round(0.09 + 4.2 * radius, 6), style.round(radius)
    r, rise = 0.014 + 0.25 * radius, 1.3 * radius + float(rng.uniform(0.03, 0.06))
    ends = [
        ring(bore_of(dn, style), 1.3 * radius, 0.0, 0.28 * length, n),
        ring(bore_of(dn, style), 1.15 * radius, 0.25 * length, 0.75 * length, n),
        ring(bore_of(dn, style), 1.3 * radius, 0.72 * length, length, n),
    ]
    neck = moved(cylinder(1.1 * r, 0.5 * radius, rise, 16), at(length / 2))
    nut = merge(
        [
            cylinder(1.7 * r, rise - 0.018, rise + 0.006, 18),
            around(box((0.15 * r, 0.3 * r, 0.022), (0, 0, rise - 0.006)), 10, 1.7 * r),
        ]
    )
    parts = [
        piece([*(along("x", e) for e in ends), neck], _NAME, "electrical"),
        piece(moved(nut, at(length / 2)), _NAME, "rubber"),
    ]
    top = rise + float(rng.uniform(0.03, 0.09))
    body: list[Solid] = [cylinder(0.95 * r, rise, top, 16)]
    if rng.random() < 0.5:
        body.append(moved(housing(style, rng, str(rng.choice(["slant", "rectangle", "pot"]))), at(0, 0, top - 0.003)))
    else:
        body.append(
            bent([(0, 0, top - 0.002), (0, 0, top + 0.06), (0.04, 0, top + 0.1), (0.14, 0, top + 0.02)], 0.0035, style)
        )
    return Model([*parts, piece(moved(merge(body), at(length / 2)), "transmitter", "safety")], length, "welded", _NAME)


def _woltman(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Woltman water meter (EN ISO 4064): a cast body with a bolted insert and its register."""
    radius = PIPES[dn].radius
    length = round(0.2 + float(rng.uniform(0.8, 1.6)) * PIPES[dn].outer, 6)
    neck = 0.485 * FLANGES[dn].hub
    body = measuring_tube(
        dn,
        style,
        length,
        [(neck, 0.3 * length), (1.08 * neck, 0.4 * length), (1.08 * neck, 0.6 * length), (neck, 0.7 * length)],
    )
    r, top = 0.045 + 0.5 * radius, 1.2 * neck + 0.015
    n = style.round(r)
    dome_ = [
        cylinder(0.85 * r, 0.3 * radius, top, n),
        cylinder(1.25 * r, top - 0.012, top, n),
        cylinder(1.25 * r, top + 0.001, top + 0.012, n),
    ]
    parts = [piece([body, moved(merge(dome_[:2]), at(length / 2))], _NAME, str(rng.choice(["valve", "gauge", "pump"])))]
    parts.append(piece(moved(dome_[2], at(length / 2)), _NAME, "valve"))
    parts += placed(
        [screws(int(rng.choice([4, 6, 8])), 1.1 * r, 0.01, top - 0.012, top + 0.012, _NAME)], at(length / 2)
    )
    return Model([*parts, *placed(_counter(0.8 * r, style, rng), at(length / 2, 0, top + 0.012))], length, kind=_NAME)


def _displacement(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A displacement meter (piston, vane, oval gear): a round or oval chamber with bolted covers, a counter on it."""
    radius = PIPES[dn].radius
    length = round(0.16 + 4.0 * radius, 6)
    r, half, x = 0.05 + 1.4 * radius, 0.03 + 1.1 * radius, length / 2
    n, upright = style.round(r), bool(rng.random() < 0.5)
    axis = "z" if upright else "-y"
    squash = 1.0 if rng.random() < 0.5 else 0.75
    drum = [
        turned([(0.9 * r, -half), (r, -0.9 * half), (r, 0.9 * half), (0.9 * r, half)], n),
        cylinder(1.12 * r, half - 0.014, half + 0.012, n),
    ]
    oval = np.diag([1.0, squash, 1.0, 1.0])
    chamber = along(axis, moved(merge(drum), oval), x)
    bolts = along(
        axis, moved(screws(int(rng.choice([6, 8, 10])), 1.05 * r, 0.01, half - 0.014, half + 0.012).solid, oval), x
    )
    parts = [piece([measuring_tube(dn, style, length), chamber], _NAME, str(rng.choice(["valve", "gauge", "pump"])))]
    parts.append(Part(bolts, "bolt", "fastener", _NAME, JOINT, True))
    neck = cylinder(0.3 * r, half, half + 0.03, 14)
    if rng.random() < 0.5:  # a tall counter with figure windows, a reset knob and a ticket printer
        wide, tall = 0.14 + 0.3 * radius, float(rng.uniform(0.1, 0.16))
        crate = extrude(rounded_rectangle(wide, 0.8 * wide, 0.1 * wide, 3), 0.0, tall)
        knob = along("x", cylinder(0.018, 0.0, 0.04, 12), 0.49 * wide, 0, 0.5 * tall)
        panes = box((0.7 * wide, 0.004, 0.3 * tall), (0, -0.4 * wide - 0.002, 0.65 * tall))
        if not upright:
            panes = box((0.7 * wide, 0.25 * wide, 0.004), (0, 0.1 * wide, tall + 0.002))
        counter = [piece([crate, knob], CASE, "valve"), piece(panes, "gauge face", "dial", CASE)]
    else:
        counter = _counter(0.6 * r, style, rng)
    head = [piece(neck, _NAME, "gauge"), *placed(counter, at(0, 0, half + 0.029))]
    parts += [Part(along(axis, p.solid, x), p.name, p.color, p.bundle, p.group, p.fine) for p in head]
    return Model(parts, length, kind=_NAME)


def _rotary(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rotary gas meter (EN 12480): a ribbed body of two lobes across the line, gear covers, a counter at one end."""
    radius = PIPES[dn].radius
    length = round(0.15 + 2.2 * radius, 6)
    r, half, x = 0.04 + 0.9 * radius, 0.07 + 1.4 * radius, length / 2
    n = style.round(r)
    lobes = [moved(cylinder(r, -half, half, n), at(0, s * 0.55 * r)) for s in (-1, 1)]
    ribs = [
        moved(cylinder(1.08 * r, z - 0.003, z + 0.003, n), at(0, s * 0.55 * r))
        for s in (-1, 1)
        for z in np.linspace(-0.8, 0.8, 5) * half
    ]
    ends = [
        extrude(rounded_rectangle(1.9 * r, 3.0 * r, 0.9 * r, 5), z, z + 0.03) for z in (-half - 0.029, half - 0.001)
    ]
    core = along("-y", merge([*lobes, *(ribs if rng.random() < 0.6 else []), *ends]), x)
    plates = [
        along("x", disc_flange(dn, style, 0.5 * length, bore_of(dn, style))),
        moved(along("-x", disc_flange(dn, style, 0.5 * length, bore_of(dn, style))), at(length)),
    ]
    parts = [piece([*plates, core], _NAME, "gauge")]
    counter = [
        piece(cylinder(0.4 * r, half + 0.028, half + 0.05, 14), _NAME, "gauge"),
        *placed(_counter(0.6 * r, style, rng), at(0, 0, half + 0.049)),
    ]
    return Model(
        [*parts, *(Part(along("-y", p.solid, x), p.name, p.color, p.bundle, p.group, p.fine) for p in counter)],
        length,
        kind=_NAME,
    )


def _diaphragm(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A diaphragm gas meter (EN 1359): a two-part sheet case on a stand with two connections on its top, a counter."""
    wide, deep, tall = float(rng.uniform(0.22, 0.4)), float(rng.uniform(0.16, 0.28)), float(rng.uniform(0.22, 0.38))
    dn, low = int(rng.choice([25, 32, 40, 50])), float(rng.uniform(0.5, 1.1))
    r = 0.2 * deep
    lower = extrude(rounded_rectangle(wide, deep, r, 4), low, low + 0.62 * tall)
    upper = extrude(rounded_rectangle(0.97 * wide, 0.95 * deep, r, 4), low + 0.62 * tall, low + tall)
    seam = extrude(rounded_rectangle(1.05 * wide, 1.07 * deep, 1.05 * r, 4), low + 0.61 * tall, low + 0.63 * tall)
    z = low + tall
    parts, ports, apart = (
        [piece([lower, upper, seam], _NAME, "electrical")],
        [],
        max(0.3 * wide, 0.5 * FLANGES[dn].outer + 0.008),
    )
    for s in (-1, 1):
        stub = merge(
            [
                cylinder(1.2 * PIPES[dn].radius, z - 0.01, z + 0.05, 16),
                hexagon(3.0 * PIPES[dn].radius, z + 0.01, z + 0.035),
            ]
        )
        end = moved(moved(disc_flange(dn, style, 0.07), spun("x", np.pi)), at(0, 0, z + 0.11))
        ports.append(Port(looking((s * apart, 0, z + 0.11), (0, 0, 1)), dn, len(parts)))
        parts.append(piece(moved(merge([stub, end]), at(s * apart)), _NAME, "trim"))
    view = box((0.35 * wide, 0.03, 0.16 * tall), (0, -0.47 * deep - 0.01, low + 0.82 * tall))
    figures = box((0.28 * wide, 0.002, 0.06 * tall), (0, -0.47 * deep - 0.026, low + 0.82 * tall))
    parts += [piece(view, CASE, "rubber"), piece(figures, "gauge face", "dial", CASE)]
    shelf = box((1.1 * wide, 1.1 * deep, 0.005), (0, 0, low - 0.0025))
    legs = [
        box((0.03, 0.03, low - 0.005), (x * wide, y * deep, (low - 0.005) / 2))
        for x in (-0.5, 0.5)
        for y in (-0.48, 0.48)
    ]
    parts.append(Part(shelf, "plate", "steel", "", "Structural element"))
    parts += [Part(leg, "post", "steel", "", "Structural element") for leg in legs]
    return Model(parts, kind=_NAME, ports=tuple(ports))


def _heat(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A heat meter (EN 1434): a small brass body with union ends, its calculator on top or aslant, sensor cables."""
    radius = PIPES[dn].radius
    length, x = round(0.1 + 2.2 * radius, 6), 0.05 + 1.1 * radius
    body = [
        hex_end(dn, 0, 0.16 * length, style),
        hex_end(dn, 0.84 * length, length, style),
        along("x", cylinder(0.95 * radius, 0.1 * length, 0.9 * length, style.round(radius))),
    ]
    z = 0.8 * radius + 0.02
    body.append(moved(box((0.04, 0.03, z), (0, 0, z / 2)), at(x)))
    wide, deep, tall = (float(rng.uniform(a, b)) for a, b in ((0.075, 0.12), (0.05, 0.09), (0.03, 0.05)))
    lean = at(x, 0, z + 0.01) @ spun("x", float(rng.choice([0.0, 0.6]))) @ at(0, 0, -0.012)
    case = extrude(rounded_rectangle(wide, deep, 0.2 * deep, 4), 0.0, tall)
    view = box((0.6 * wide, 0.35 * deep, 0.002), (0, 0.12 * deep, tall + 0.001))
    key = cylinder(0.006, tall - 0.001, tall + 0.003, 10)
    leads = [
        bent(
            [
                (s * 0.25 * wide, -0.45 * deep, 0.3 * tall),
                (s * 0.25 * wide, -0.8 * deep, 0.3 * tall),
                (s * 0.8 * wide, -0.9 * deep, -0.02),
            ],
            0.002,
            style,
        )
        for s in (-1, 1)
    ]
    head = [
        piece([case, moved(key, at(0, -0.25 * deep)), *leads], "transmitter", "electrical"),
        piece(view, "gauge glass", "dial", "transmitter"),
    ]
    return Model([piece(body, _NAME, "trim"), *placed(head, lean)], length, "welded", _NAME)


def _pickup(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A turbine meter for liquids: a slim tube with a pick-up boss and hexagon, a plug, a small display or a head."""
    radius = PIPES[dn].radius
    length = round(0.1 + float(rng.uniform(2.0, 3.5)) * PIPES[dn].outer, 6)
    parts = [piece(measuring_tube(dn, style, length), _NAME, "gauge")]
    x, top = float(rng.uniform(0.45, 0.55)) * length, radius + float(rng.uniform(0.03, 0.07))
    boss = [
        cylinder(0.016, 0.7 * radius, radius + 0.015, 14),
        hexagon(0.026, radius + 0.012, top),
        cylinder(0.01, top - 0.002, top + 0.02, 12),
    ]
    parts.append(piece(moved(merge(boss), at(x)), _NAME, "trim"))
    if rng.random() < 0.5:
        head: Solid = moved(housing(style, rng), at(0, 0, top + 0.017))
    else:
        head = merge(
            [
                cylinder(0.013, top + 0.012, top + 0.05, 12),
                bent([(0, 0, top + 0.048), (0, 0, top + 0.09), (0.1, 0, top + 0.1), (0.16, 0, top)], 0.004, style),
            ]
        )
    return Model([*parts, piece(moved(head, at(x)), "transmitter", "rubber")], length, kind=_NAME)


_SMALL = tuple(dn for dn in SIZES if dn <= 50)
_SOME = tuple(dn for dn in SIZES if dn <= 150)
COUNTER_BUILDS: tuple[Family, ...] = (
    meter_family("flow meter/clear tube", _acrylic, sizes=_SMALL),
    meter_family("flow meter/paddle wheel", _paddle, sizes=_SMALL),
    meter_family("flow meter/woltman", _woltman, sizes=tuple(dn for dn in SIZES if dn >= 40)),
    meter_family("flow meter/displacement", _displacement, sizes=_SOME),
    meter_family("flow meter/rotary gas", _rotary, sizes=tuple(dn for dn in _SOME if dn >= 25)),
    meter_family("flow meter/diaphragm gas", _diaphragm, "floor", (15,)),
    meter_family("flow meter/heat", _heat, sizes=_SMALL),
    meter_family("flow meter/pick-up", _pickup),
)
