"""Gauges and other instruments on an outlet (upright on z = 0) or in a line (along x from 0)."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.family import Family, Model, Part, fronted, placed
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.plant import Turning
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import arc, at, spun
from cadplants.valve_body import bore_of

__all__ = ["INSTRUMENTS"]

_GROUP = "Gauge assembly"
_CASE, _STEM = "gauge case", "gauge stem"
_SIZES = (0.04, 0.05, 0.063, 0.08, 0.1, 0.16, 0.25)  # m, EN 837-1 nominal sizes of cases


def _dial(size: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A case about z, its front towards +z and its back at 0: bezel, face, needle, glass."""
    r, n = size / 2, style.round(size / 2)
    depth = float(rng.uniform(0.35, 0.6)) * size
    lip = float(rng.uniform(1.0, 1.1)) * r
    floor = 0.8 * depth
    wall = 0.92 * r
    profile = [
        (0.9 * r, 0.0),
        (r, 0.06 * depth),
        (r, 0.75 * depth),
        (lip, 0.77 * depth),
        (lip, 0.96 * depth),
        (0.98 * lip, depth),
        (wall, depth),
        (wall, floor),
    ]
    parts = [Part(turned(profile, n), _CASE, "gauge", _CASE)]
    parts.append(Part(cylinder(0.98 * wall, floor, floor + 0.001, n), "gauge face", "dial", _CASE))
    wide = 0.035 * r
    hand_ = np.array([[-0.25 * r, -wide], [0.75 * r, -0.3 * wide], [0.75 * r, 0.3 * wide], [-0.25 * r, wide]])
    pointer = merge(
        [extrude(hand_, floor + 0.0015, floor + 0.0025), cylinder(0.07 * r, floor + 0.001, floor + 0.004, 10)]
    )
    pointer = moved(pointer, spun("z", float(rng.uniform(0, 6.3))))
    parts.append(Part(pointer, "gauge needle", "needle", _CASE, turns=Turning("needle")))
    if rng.random() < 0.5:
        parts.append(Part(cylinder(0.985 * wall, 0.9 * depth, 0.9 * depth + 0.002, n), "gauge glass", "dial", _CASE))
    if rng.random() < 0.2:
        flat = ring(0.98 * r, 1.35 * r, 0.7 * depth, 0.7 * depth + 0.003, n)
        parts.append(Part(flat, _CASE, "gauge", _CASE))
    return fronted(parts)


def _shank(low: float, high: float, square: float, style: ModelingStyle, hexagonal: bool) -> Part:
    """The wrench flats and thread of a connection about z [m]."""
    flats = (
        hexagon(square, low + 0.4 * (high - low), high)
        if hexagonal
        else box((square, square, 0.6 * (high - low)), (0, 0, low + 0.7 * (high - low)))
    )
    return Part(merge([cylinder(0.42 * square, low, low + 0.5 * (high - low), 12), flats]), _STEM, "trim", _STEM)


def _mount(style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """What a gauge stands on (shank, siphon, needle valve, diaphragm seal, snubber), and the height of its top."""
    kind = int(rng.integers(6))
    r, n = 0.0068, max(6, min(16, style.round(0.007)))
    if kind == 0:
        tall = float(rng.uniform(0.03, 0.1))
        return [Part(cylinder(r, 0, tall, n), _STEM, "trim", _STEM)], tall
    if kind == 1:  # a coil siphon (DIN 16282, form trumpet)
        reach = float(rng.uniform(0.025, 0.04))
        t = np.linspace(0, 2 * np.pi, 17)
        loop = np.column_stack([reach * np.sin(t), 0.022 * t / (2 * np.pi), 0.03 + reach - reach * np.cos(t)])
        path = np.vstack([[0, 0, 0], loop, [0, 0.022, 0.06 + 2 * reach]])
        path[1:-1, 2] += np.linspace(0, 0.006, 17)
        parts = placed([Part(tube(path, r, 0.0, n), "siphon", "trim", "siphon")], np.eye(4))
        nut = moved(hexagon(0.022, 0.05 + 2 * reach, 0.075 + 2 * reach), at(0, 0.022, 0))
        return [*parts, Part(nut, "siphon", "trim", "siphon")], 0.075 + 2 * reach
    if kind == 2:  # a U siphon
        a, b, deep = 0.0, 0.07, 0.05
        path = np.vstack(
            [
                [[a, 0, 0], [a, 0, 0.02]],
                arc((a, 0, 0.02), (a, 0, 0.05), (a + 0.03, 0, 0.05), 4),
                arc((b - 0.03, 0, 0.05), (b, 0, 0.05), (b, 0, 0.08), 4),
                [[b, 0, 0.08 + deep]],
            ]
        )
        return [Part(tube(_distinct(path), r, 0.0, n), "siphon", "trim", "siphon")], 0.08 + deep
    if kind == 3:  # a shut-off needle valve under the gauge
        block = merge(
            [
                hexagon(0.028, 0.03, 0.07),
                cylinder(r, 0.0, 0.1, n),
                along("x", cylinder(0.009, 0.0, 0.045, n), 0, 0, 0.05),
            ]
        )
        bar = rod((0.048, -0.025, 0.05), (0.048, 0.025, 0.05), 0.003, 8)
        return [Part(merge([block, bar]), _STEM, "trim", _STEM)], 0.1
    if kind == 4:  # a diaphragm seal: two flanges with bolts
        plate = float(rng.uniform(0.03, 0.055))
        seal = merge(
            [
                cylinder(r, 0.0, 0.03, n),
                turned([(0.6 * plate, 0.025), (plate, 0.03), (plate, 0.045)], style.round(plate)),
                turned([(plate, 0.046), (plate, 0.06), (0.4 * plate, 0.066), (0.3 * plate, 0.08)], style.round(plate)),
            ]
        )
        bolts = bolt_circle(6, 0.85 * plate, 0.006, 0.03, 0.06)
        return [
            Part(seal, _STEM, "trim", _STEM),
            Part(bolts, "bolt", "fastener", _STEM, "Connection assembly", True),
        ], 0.08
    snub = merge(
        [
            cylinder(r, 0.0, 0.02, n),
            hexagon(0.024, 0.018, 0.04),
            cylinder(0.011, 0.04, 0.06, n),
            cylinder(r, 0.06, 0.075, n),
        ]
    )
    return [Part(snub, _STEM, "trim", _STEM)], 0.075


def _distinct(path: Floats) -> Floats:
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-6])
    return np.asarray(path[keep])


def _top(parts: list[Part]) -> tuple[float, float]:
    """Where the axis of the highest part goes on: x and y of its uppermost points."""
    best = max(parts, key=lambda p: float(p.solid.vertices[:, 2].max()))
    points = best.solid.vertices[best.solid.vertices[:, 2] > best.solid.vertices[:, 2].max() - 1e-6]
    x, y = points.mean(axis=0)[:2]
    return float(x), float(y)


def _bottom_gauge(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    size = float(rng.choice(_SIZES))
    parts, top = _mount(style, rng)
    x, y = _top(parts)
    square = 0.014 if size < 0.08 else 0.022
    shank = _shank(top - 0.004, top + 0.03, square, style, bool(rng.random() < 0.3))
    case = _dial(size, style, rng)
    depth = float(case[0].solid.vertices[:, 2].max())
    stand = at(0, depth / 2, top + 0.028 + size / 2) @ spun("x", np.pi / 2)
    head = [shank, *placed(case, stand)]
    turn = spun("z", float(rng.uniform(0, 6.3)))
    return Model([*parts, *placed(head, at(x, y) @ turn)], kind="pressure gauge")


def _back_gauge(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge or bimetal thermometer with its connection at the back: its dial looks up, or to the side of an elbow."""
    size = float(rng.choice(_SIZES))
    tall, n = float(rng.uniform(0.03, 0.12)), 12
    parts = [
        Part(
            merge([cylinder(0.0068, 0.0, tall, n), hexagon(0.022, 0.3 * tall, 0.3 * tall + 0.014)]),
            _STEM,
            "trim",
            _STEM,
        )
    ]
    case = _dial(size, style, rng)
    tilt = float(rng.choice([0.0, 0.0, 0.5, 0.25])) * np.pi
    if tilt:
        path = np.array([[0, 0, tall - 0.002], [0, 0, tall + 0.02], [0, -0.02 - 0.3 * size, tall + 0.02 + 0.1 * size]])
        parts.append(Part(tube(path, 0.0068, 0.0, n), _STEM, "trim", _STEM))
        pose = at(*path[-1]) @ spun("x", tilt)
    else:
        pose = at(0, 0, tall)
    return Model([*parts, *placed(case, pose)], kind="pressure gauge" if rng.random() < 0.5 else "thermometer")


def _digital(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A digital gauge: a round or square case with a small display and buttons, on a hexagon."""
    side = float(rng.choice([0.06, 0.08, 0.1]))
    tall = float(rng.uniform(0.03, 0.06))
    depth = 0.45 * side
    parts = [
        Part(merge([cylinder(0.0068, 0, tall, 12), hexagon(0.024, 0.4 * tall, tall + 0.004)]), _STEM, "trim", _STEM)
    ]
    shape = circle(side / 2, style.round(side)) if rng.random() < 0.5 else rounded_rectangle(side, side, 0.15 * side, 4)
    pose = at(0, depth / 2, tall + side / 2) @ spun("x", np.pi / 2)
    screen = box((0.6 * side, 0.3 * side, 0.002), (0, 0.1 * side, depth + 0.001))
    keys = merge(
        [moved(cylinder(0.05 * side, depth, depth + 0.003, 8), at(x * side, -0.25 * side)) for x in (-0.2, 0.0, 0.2)]
    )
    head = [
        Part(extrude(shape, 0, depth), _CASE, "electrical", _CASE),
        Part(screen, "gauge glass", "dial", _CASE),
        Part(keys, _CASE, "rubber", _CASE),
    ]
    parts += placed(fronted(head), pose)
    return Model(parts, kind="pressure gauge")


def _housing(style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A two-chamber transmitter housing about x on its middle, with covers and a neck down to z = -1.1 r."""
    r = float(rng.uniform(0.038, 0.055))
    n = style.round(r)
    body = along("x", cylinder(r, -0.9 * r, 0.9 * r, n))
    covers = [
        along(a, turned([(1.12 * r, 0.85 * r), (1.15 * r, 0.95 * r), (1.15 * r, 1.45 * r), (1.0 * r, 1.55 * r)], n))
        for a in ("x", "-x")
    ]
    neck = cylinder(0.55 * r, -1.35 * r, -0.5 * r, n)
    glands = [
        along(a, merge([cylinder(0.28 * r, 0.8 * r, 1.35 * r, 10), hexagon(0.7 * r, 1.2 * r, 1.5 * r)]), 0, 0, 0.2 * r)
        for a in (("y", "-y") if rng.random() < 0.5 else ("y",))
    ]
    return moved(merge([body, *covers, neck, *glands]), at(0, 0, 1.35 * r))


def _head(style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A connection head on z = 0 (DIN 43729 form B): a pot with a slanting or round lid, a cable gland."""
    r, n = float(rng.uniform(0.028, 0.045)), style.round(0.035)
    pot = turned([(0.45 * r, 0.0), (0.5 * r, 0.4 * r), (r, 0.7 * r), (r, 1.4 * r)], n)
    lid = turned([(1.08 * r, 1.4 * r), (1.08 * r, 1.75 * r), (0.8 * r, 2.0 * r)], n)
    lid = moved(lid, at(0, 0, 1.4 * r) @ spun("y", float(rng.choice([0.0, 0.25]))) @ at(0, 0, -1.4 * r))
    gland = along("x", merge([cylinder(0.25 * r, 0.8 * r, 1.5 * r, 10), hexagon(0.65 * r, 1.2 * r, 1.5 * r)]), 0, 0, r)
    return merge([pot, lid, gland])


def _pressure_transmitter(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure transmitter: process connection, a sensor barrel or a pair of flanges with bolts, the housing."""
    parts: list[Part] = []
    if rng.random() < 0.5:
        tall = float(rng.uniform(0.04, 0.1))
        barrel = merge(
            [
                cylinder(0.0068, 0, 0.02, 12),
                hexagon(0.027, 0.018, 0.04),
                cylinder(0.02, 0.038, 0.04 + tall, style.round(0.02)),
            ]
        )
        parts.append(Part(barrel, "transmitter", "trim", "transmitter"))
        z = 0.04 + tall
    else:
        side = 0.06
        flat = [box((0.022, 0.1, 0.075), (s * 0.018, 0, 0.08)) for s in (-1, 1)]
        bolts = along(
            "x",
            merge(
                [
                    moved(
                        merge([cylinder(0.005, -0.04, 0.04, 8), hexagon(0.016, 0.03, 0.04)]), at(sx * 0.028, sy * 0.04)
                    )
                    for sx in (-1, 1)
                    for sy in (-1, 1)
                ]
            ),
            0,
            0,
            0.08,
        )
        cell = cylinder(0.035, 0.1, 0.1 + side, style.round(0.035))
        foot = cylinder(0.0068, 0.0, 0.06, 12)
        parts.append(Part(merge([*flat, cell, foot]), "transmitter", "trim", "transmitter"))
        parts.append(Part(bolts, "bolt", "fastener", "transmitter", "Connection assembly", True))
        z = 0.16
    parts.append(
        Part(
            moved(_housing(style, rng), at(0, 0, z - 0.004) @ spun("z", float(rng.uniform(0, 6)))),
            "transmitter",
            "valve",
            "transmitter",
        )
    )
    return Model(parts, kind="pressure transmitter")


def _compact_transmitter(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small transmitter or switch: hexagon, slim can, plug (DIN EN 175301-803) or cable."""
    r, tall, n = float(rng.uniform(0.011, 0.02)), float(rng.uniform(0.04, 0.1)), 16
    body = merge(
        [
            cylinder(0.0068, 0, 0.015, 12),
            hexagon(2.2 * r, 0.013, 0.03),
            cylinder(r, 0.028, 0.03 + tall, min(n, style.round(r))),
        ]
    )
    z = 0.03 + tall
    if rng.random() < 0.5:
        plug = merge(
            [box((0.028, 0.028, 0.03), (0, 0, z + 0.014)), along("x", cylinder(0.009, 0.0, 0.03, 10), 0, 0, z + 0.014)]
        )
    else:
        plug = rope([(0, 0, z - 0.002), (0, 0, z + 0.03), (0.02, 0, z + 0.05), (0.08, 0, z + 0.04)], 0.004, 8)
    return Model(
        [Part(body, "transmitter", "trim", "transmitter"), Part(plug, "transmitter", "rubber", "transmitter")],
        kind="pressure transmitter",
    )


def _thermowell(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermowell with its extension and connection head, or with a bimetal dial."""
    r, reach = float(rng.uniform(0.008, 0.014)), float(rng.uniform(0.03, 0.07))
    n = 14
    well = merge(
        [
            turned([(0.5 * r, -reach), (0.7 * r, 0.0), (1.2 * r, 0.004), (1.2 * r, 0.02)], n),
            hexagon(3.2 * r, 0.018, 0.045),
        ]
    )
    if rng.random() < 0.35:
        flat = moved(disc_flange(25, style, plate_thickness(25)), at(0, 0, 0.05))
        well = merge([well, flat])
    top = 0.045 + float(rng.uniform(0.03, 0.15))
    neck = merge([cylinder(0.9 * r, 0.04, top, n), hexagon(2.6 * r, top - 0.02, top - 0.005)])
    parts = [Part(well, "thermowell", "trim", "thermowell"), Part(neck, "thermowell", "trim", "thermowell")]
    if rng.random() < 0.7:
        parts.append(Part(moved(_head(style, rng), at(0, 0, top - 0.003)), "transmitter", "valve", "transmitter"))
        kind = "temperature transmitter"
    else:
        parts += placed(
            _dial(float(rng.choice([0.08, 0.1, 0.125])), style, rng),
            at(0, 0, top - 0.002) @ spun("x", float(rng.choice([0.0, 0.0, 0.6]))),
        )
        kind = "thermometer"
    return Model(parts, kind=kind)


def _glass_thermometer(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An industrial glass thermometer: a V-shaped or flat case with a tube, straight or at an angle (DIN 16195)."""
    tall, wide = float(rng.uniform(0.11, 0.22)), float(rng.uniform(0.03, 0.045))
    stem_ = merge([cylinder(0.006, 0, 0.04, 12), hexagon(0.024, 0.03, 0.05)])
    case = extrude(rounded_rectangle(wide, tall, 0.4 * wide, 4), 0.0, 0.018)
    glass = rod((0, -0.42 * tall, 0.02), (0, 0.42 * tall, 0.02), 0.003, 8)
    pose = at(0, 0.009, 0.048 + tall / 2) @ spun("x", np.pi / 2)
    return Model(
        [
            Part(stem_, _STEM, "trim", _STEM),
            *placed(fronted([Part(case, _CASE, "handle", _CASE), Part(glass, "gauge glass", "dial", _CASE)]), pose),
        ],
        kind="thermometer",
    )


def _meter_body(dn: int, style: ModelingStyle, rng: np.random.Generator, kind: int) -> tuple[list[Part], float, float]:
    """The measuring tube of a meter in a line: parts, length, height of its top."""
    size, radius = FLANGES[dn], PIPES[dn].radius
    length = max(0.2, float(rng.uniform(1.6, 2.6)) * PIPES[dn].outer + 0.08)
    low, neck = plate_thickness(dn) + min(nut_room(dn), 0.2 * length), 0.485 * size.hub
    drum = max(1.06 * neck, (1.05, 1.45, 1.7)[kind] * radius + 0.006)
    if kind == 0:
        middle = [(neck, 0.3 * length), (neck, 0.7 * length)]
    else:
        middle = [(neck, low), (drum, low + 0.001), (drum, length - low - 0.001), (neck, length - low)]
    name = "flow meter"
    return (
        [Part(flanged_body(dn, style, length, middle), name, "gauge", name)],
        round(length, 6),
        drum if kind else neck,
    )


def _inline_meter(dn: int, style: ModelingStyle, rng: np.random.Generator, kind: int, head: bool) -> Model:
    parts, length, top = _meter_body(dn, style, rng, kind)
    x, name = length / 2, "flow meter"
    rise = top + float(rng.uniform(0.03, 0.09)) + 0.2 * PIPES[dn].radius
    r = float(rng.uniform(0.012, 0.022))
    post = merge([cylinder(r, 0.8 * top, rise, 12), cylinder(1.8 * r, rise - 0.006, rise, 12)])
    parts.append(Part(moved(post, at(x)), name, "gauge", name))
    pose = at(x, 0, rise - 0.002) @ spun("z", float(rng.choice([0.0, 1.5708])))
    solid = (
        _housing(style, rng)
        if head
        else merge([box((0.14, 0.1, 0.16), (0, 0, 0.08)), box((0.09, 0.004, 0.06), (0, -0.052, 0.1))])
    )
    parts.append(Part(moved(solid, pose), "transmitter", "valve" if head else "electrical", "transmitter"))
    return Model(parts, length, kind="flow meter")


def _magnetic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _inline_meter(dn, style, rng, int(rng.choice([1, 2])), bool(rng.random() < 0.6))


def _vortex(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _inline_meter(dn, style, rng, 0, True)


def _turbine(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A turbine or water meter: a round register with a lid on the tube."""
    parts, length, top = _meter_body(dn, style, rng, int(rng.choice([0, 1])))
    x, r = length / 2, 0.035 + 0.35 * PIPES[dn].radius
    n = style.round(r)
    neck = cylinder(0.8 * r, 0.6 * top, top + 0.02, n)
    register = turned([(r, top + 0.01), (1.05 * r, top + 0.03), (1.05 * r, top + 0.06), (0.95 * r, top + 0.075)], n)
    parts += [
        Part(moved(neck, at(x)), "flow meter", "gauge", "flow meter"),
        Part(moved(register, at(x)), _CASE, "handle", _CASE),
    ]
    if rng.random() < 0.6:
        parts.append(Part(moved(cylinder(0.9 * r, top + 0.0752, top + 0.077, n), at(x)), "gauge face", "dial", _CASE))
    else:
        lid = moved(cylinder(1.05 * r, 0.0, 0.006, n), at(x, 0.9 * r, top + 0.08) @ spun("x", 1.0) @ at(0, 0.9 * r, 0))
        parts.append(Part(lid, _CASE, "handle", _CASE))
    return Model(parts, length, kind="flow meter")


def _water_meter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small threaded water meter."""
    radius = PIPES[dn].radius
    length, r = 0.11 + 3.0 * radius, 0.03 + 0.9 * radius
    n, x = style.round(r), length / 2
    body = merge(
        [
            hex_end(dn, 0, 0.15 * length, style),
            along("x", cylinder(1.05 * radius, 0.1 * length, 0.9 * length, n)),
            hex_end(dn, 0.85 * length, length, style),
            moved(turned([(0.7 * r, -0.6 * r), (r, -0.3 * r), (r, 0.5 * r)], n), at(x)),
        ]
    )
    dial = turned([(1.05 * r, 0.5 * r), (1.05 * r, 0.95 * r), (0.95 * r, 1.05 * r)], n)
    return Model(
        [
            Part(body, "flow meter", "trim", "flow meter"),
            Part(moved(dial, at(x)), _CASE, "handle", _CASE),
            Part(moved(cylinder(0.88 * r, 1.05 * r, 1.06 * r, n), at(x)), "gauge face", "dial", _CASE),
        ],
        round(length, 6),
        "welded",
        "flow meter",
    )


def _coriolis(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Coriolis meter: two bent tubes in a case below the line, a manifold with flanges, a housing on top."""
    radius = PIPES[dn].radius
    length = 0.3 + 8 * radius
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
    drop, n = 0.15 + 4.5 * radius, style.round(radius)
    a, b, r = 0.24 * length, 0.76 * length, 0.8 * radius + 0.004
    if rng.random() < 0.6:
        bend = 0.3 * (b - a)
        path = np.vstack(
            [
                [[a, 0, 0]],
                arc((a, 0, -drop + bend), (a, 0, -drop), (a + bend, 0, -drop), 5),
                arc((b - bend, 0, -drop), (b, 0, -drop), (b, 0, -drop + bend), 5),
                [[b, 0, 0]],
            ]
        )
        tubes = merge([moved(tube(_distinct(path), r, 0.0, n), at(0, s * 1.15 * r, 0)) for s in (-1, 1)])
    else:
        angles = np.linspace(np.pi, 2 * np.pi, 12)
        outline = np.column_stack([(a + b) / 2 + 0.5 * (b - a) * 1.2 * np.cos(angles), 0.8 * drop * np.sin(angles)])
        tubes = moved(
            extrude(np.vstack([outline, [(b, 0.4 * radius), (a, 0.4 * radius)]]), -1.6 * r, 1.6 * r),
            spun("x", np.pi / 2),
        )
    rise = 0.05 + radius
    top = moved(_housing(style, rng), at(length / 2, 0, rise))
    post = moved(cylinder(0.022, 0.0, rise + 0.01, 12), at(length / 2))
    return Model(
        [
            Part(merge([body, post]), "flow meter", "gauge", "flow meter"),
            Part(tubes, "flow meter", "gauge", "flow meter"),
            Part(top, "transmitter", "valve", "transmitter"),
        ],
        round(length, 6),
        kind="flow meter",
    )


def _rotameter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A variable-area meter in a line: flanges, a glass cone between them, or a metal tube with an indicator box."""
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    length, low = 0.25 + 2 * radius, plate_thickness(dn)
    plates = [
        along("x", disc_flange(dn, style, low + 0.03, bore_of(dn, style))),
        moved(along("-x", disc_flange(dn, style, low + 0.03, bore_of(dn, style))), at(length)),
    ]
    parts = [Part(solid, "flow meter", "gauge", "flow meter") for solid in plates]
    if rng.random() < 0.5:
        cone = along("x", turned([(0.9 * radius, low + 0.028), (1.15 * radius, length - low - 0.028)], n))
        bars = around(cylinder(0.005, low, length - low, 8), 4, 1.7 * radius, np.pi / 4)
        float_ = along(
            "x", turned([(0.2 * radius, 0.45 * length), (0.8 * radius, 0.5 * length), (0.8 * radius, 0.53 * length)], n)
        )
        parts += [
            Part(cone, "gauge glass", "dial", "flow meter"),
            Part(about_x(bars), "stud", "fastener", "flow meter", "Connection assembly", True),
            Part(float_, "gauge needle", "trim", "flow meter"),
        ]
    else:
        tube_ = along("x", cylinder(radius, low + 0.02, length - low - 0.02, n))
        case = box((0.12, 0.06, 0.14), (length / 2, -radius - 0.03, 0))
        parts += [
            Part(tube_, "flow meter", "gauge", "flow meter"),
            Part(case, _CASE, "valve", _CASE),
            Part(box((0.09, 0.003, 0.11), (length / 2, -radius - 0.0615, 0)), "gauge face", "dial", _CASE),
        ]
    return Model(parts, round(length, 6), kind="flow meter")


def _orifice(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An orifice plate with its handle between flanges (ISO 5167)."""
    size, n = FLANGES[dn], style.round(FLANGES[dn].circle / 2)
    thick, outer = 0.003 + 0.01 * PIPES[dn].radius, 0.49 * (size.circle - size.bolt)
    plate = merge(
        [
            ring(0.6 * PIPES[dn].bore, outer, 0, thick, n),
            box((0.1 + 0.2 * outer, 0.03, thick), (outer + 0.04, 0, thick / 2)),
        ]
    )
    return Model(
        [Part(moved(about_x(plate), spun("x", np.pi / 2)), "flow meter", "trim")],
        round(thick, 6),
        "wafer",
        "flow meter",
    )


def _sight_glass(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sight glass in a line: a body with two round windows, or a glass tube between flanges with rods."""
    radius = PIPES[dn].radius
    n, neck = style.round(1.4 * radius), 0.485 * FLANGES[dn].hub
    name = "sight glass"
    if rng.random() < 0.55:
        length = 0.12 + 3.6 * radius
        body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        reach = max(1.5 * radius, 1.15 * neck) + 0.015
        port = along(
            "y",
            merge(
                [
                    cylinder(1.1 * radius + 0.004, -reach, reach, n),
                    *(
                        ring(1.0 * radius, 1.6 * radius + 0.01, s * reach - 0.008, s * reach + 0.008, n)
                        for s in (-1, 1)
                    ),
                ]
            ),
            length / 2,
        )
        panes = along("y", cylinder(1.0 * radius, -reach - 0.006, reach + 0.006, n), length / 2)
        return Model(
            [Part(merge([body, port]), name, "valve", name), Part(panes, "gauge glass", "dial", name)],
            round(length, 6),
            kind="sight glass",
        )
    length, low = 0.1 + 3 * radius, plate_thickness(dn)
    plates = merge(
        [
            along("x", disc_flange(dn, style, low + 0.004, bore_of(dn, style))),
            moved(along("-x", disc_flange(dn, style, low + 0.004, bore_of(dn, style))), at(length)),
        ]
    )
    pane = along("x", ring(radius, 1.2 * radius, low, length - low, n))
    rods = about_x(around(cylinder(0.006, low, length - low, 8), 4, 0.9 * FLANGES[dn].circle / 2, 0))
    return Model(
        [
            Part(plates, name, "trim", name),
            Part(pane, "gauge glass", "dial", name),
            Part(rods, "stud", "fastener", name, "Connection assembly", True),
        ],
        round(length, 6),
        kind="sight glass",
    )


def _family(
    name: str,
    build: object,
    place: str = "tap",
    sizes: tuple[int, ...] = SIZES,
    whole: str = "gauge",
    weight: float = 1.0,
) -> Family:
    return Family(name, place, _GROUP, whole, build, sizes, weight=weight)  # type: ignore[arg-type]


_SOME = tuple(dn for dn in SIZES if dn <= 150)

INSTRUMENTS: tuple[Family, ...] = (
    _family("gauge/bottom", _bottom_gauge, weight=4),
    _family("gauge/back", _back_gauge, weight=2),
    _family("gauge/digital", _digital),
    _family("transmitter/two-chamber", _pressure_transmitter, whole="transmitter", weight=1.5),
    _family("transmitter/compact", _compact_transmitter, whole="transmitter"),
    _family("thermowell/head", _thermowell, whole="thermowell", weight=1.5),
    _family("thermometer/glass", _glass_thermometer),
    _family("flow meter/drum", _magnetic, "inline", whole="flow meter", weight=1.5),
    _family("flow meter/vortex", _vortex, "inline", whole="flow meter"),
    _family("flow meter/turbine", _turbine, "inline", whole="flow meter"),
    _family("flow meter/water", _water_meter, "inline", (15, 20, 25, 32, 40), "flow meter"),
    _family("flow meter/coriolis", _coriolis, "inline", _SOME, "flow meter"),
    _family("flow meter/rotameter", _rotameter, "inline", _SOME, "flow meter"),
    _family("flow meter/orifice", _orifice, "inline", SIZES, "flow meter"),
    _family("sight glass/flanged", _sight_glass, "inline", _SOME, "sight glass"),
)
