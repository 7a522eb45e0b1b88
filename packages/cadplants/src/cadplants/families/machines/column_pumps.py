"""Pumps whose casing is more than a volute: with a chamber, a column, a canister, an open front."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import (
    BASES,
    CASING,
    LYING,
    PUMP,
    base,
    dead_room,
    motor,
    mouth,
    train,
    volute,
)
from cadplants.families.valves.valve import disc_flange, flanged_body
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import extrude, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import ELBOW_LONG_RADIUS, FLANGES, PIPES, smaller
from cadplants.transforms import at, looking, spun

__all__ = ["SPECIAL"]


def _self_priming(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A self-priming trash pump: a big chamber, suction high in front, discharge on top, a clean-out cover."""
    s = 0.12 + 2.2 * PIPES[dn].radius
    seat = float(rng.uniform(0.06, 0.15))
    w, d, h = 1.5 * s, 1.5 * s, float(rng.uniform(1.9, 2.3)) * s
    tub = moved(extrude(rounded_rectangle(w, d, 0.35 * s, 4), seat + 0.12 * s, seat + h), at(0, 0, 0))
    axis = seat + 0.85 * s
    belly = along("x", volute(0.62 * s, 0.35 * s, style, 0.3), 0.5 * w + 0.05 * s, 0, axis)
    feet = [box((0.2 * s, d, 0.14 * s), (x * 0.5 * w, 0, seat + 0.07 * s)) for x in (-0.7, 0.7)]
    reach = dead_room(dn) + 0.05
    one, first = mouth(dn, style, (-w / 2 - reach, 0, seat + h - 0.3 * s - 0.02), (-1, 0, 0), reach + 0.1 * s)
    two, second = mouth(dn, style, (0.1 * w, 0, seat + h + reach), (0, 0, 1), reach + 0.05)
    lid = along(
        "-x",
        merge(
            [
                cylinder(0.4 * s, 0, 0.1 * s, style.round(0.4 * s)),
                cylinder(0.3 * s, 0.1 * s, 0.16 * s, style.round(0.3 * s)),
            ]
        ),
        -w / 2 + 0.01,
        0,
        seat + 0.62 * s,
    )
    bar = merge(
        [
            box((0.08 * s, 0.98 * s, 0.14 * s), (-w / 2 - 0.18 * s, 0, seat + 0.62 * s)),
            *(
                rod(
                    (-w / 2 + 0.02, y * 0.44 * s, seat + 0.62 * s),
                    (-w / 2 - 0.32 * s, y * 0.44 * s, seat + 0.62 * s),
                    0.04 * s,
                    8,
                )
                for y in (-1, 1)
            ),
        ]
    )
    plug = moved(
        merge([cylinder(0.16 * s, 0, 0.08 * s, 16), box((0.24 * s, 0.06 * s, 0.08 * s), (0, 0, 0.12 * s))]),
        at(-0.3 * w, 0.25 * d, seat + h - 0.005),
    )
    back = 0.5 * w + 0.38 * s
    house = turned([(0.6 * s, 0), (0.35 * s, 0.2 * s), (0.3 * s, 0.9 * s), (0.22 * s, 0.95 * s)], style.round(s))
    start = back + 1.2 * s
    parts = [
        Part(merge([tub, belly, *feet, one, two]), CASING, "pump", CASING),
        Part(merge([lid, plug]), CASING, "pump", CASING),
        Part(bar, "clamp", "clamp", CASING, "Connection assembly"),
        Part(along("x", house, back - 0.04 * s, 0, axis), CASING, "pump", CASING),
        Part(along("x", cylinder(0.1 * s, back, start, 12), 0, 0, axis), "shaft", "trim", CASING),
    ]
    more, far, seats = train(start, axis, seat, min(0.8 * (axis - seat), 0.7 * s), style, rng)
    bed = base(pick(rng, *BASES), -0.55 * w, far, 1.7 * s, seat, [-0.35 * w, 0.35 * w, *seats], rng)
    return Model([*parts, *more, *bed], ports=(first, second), kind="self-priming pump")


def _turbine(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vertical turbine pump (API 610 VS1): bowls and column below a deck, discharge head and hollow-shaft motor."""
    p, n = PIPES[dn].radius, style.round(PIPES[dn].radius * 1.5)
    deck, half = float(rng.uniform(0.9, 1.8)), 0.25 + 2 * p
    plate = 0.03
    sole = box((3.4 * p + 0.1, 3.4 * p + 0.1, plate), (0, 0, deck + plate / 2))
    grid = [box((2 * half, 0.1, 0.12), (0, s * (1.5 * p + 0.05), deck - 0.06)) for s in (-1, 1)]
    posts = [
        box((0.1, 0.1, deck - 0.12), (sx * (half - 0.05), sy * (1.5 * p + 0.05), (deck - 0.12) / 2))
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    bowl, count = 1.45 * p, int(rng.integers(2, 6))
    step = min(1.1 * p, (0.6 * deck) / count)
    low = 0.08
    bell = turned([(1.6 * p, low), (0.9 * p, low + 0.5 * step), (0.9 * p, low + 0.6 * step)], n)
    bowls = [
        turned([(0.95 * p, z), (bowl, z + 0.4 * step), (bowl, z + 0.6 * step), (0.95 * p, z + step)], n)
        for z in low + 0.6 * step + step * np.arange(count)
    ]
    top = low + (0.6 + count) * step
    column = merge(
        [
            cylinder(p, top - 0.005, deck, n),
            *(cylinder(1.35 * p, z, z + 0.04, n) for z in (top, (top + deck) / 2, deck - 0.04)),
        ]
    )
    z = deck + plate
    head_high = float(rng.uniform(3.5, 5.0)) * p + 0.15
    head = turned([(1.4 * p, z), (1.4 * p, z + 0.03), (1.15 * p, z + 0.03), (1.15 * p, z + 0.6 * head_high)], n)
    face, level = 1.2 * p + dead_room(dn) + 0.06, z + max(0.35 * head_high, FLANGES[dn].outer / 2 + 0.04)
    out, port = mouth(dn, style, (face, 0, level), (1, 0, 0), face - 0.5 * p)
    m = float(rng.uniform(1.2, 1.7)) * p + 0.04
    windows = around(box((0.2 * p, 0.7 * p, 0.42 * head_high), (0, 0, z + 0.79 * head_high)), 4, 0.95 * p, np.pi / 4)
    seat = merge([windows, cylinder(max(m, 1.2 * p), z + head_high - 0.025, z + head_high, n)])
    gland = turned(
        [(0.5 * p, z + 0.6 * head_high), (0.5 * p, z + 0.66 * head_high), (0.3 * p, z + 0.72 * head_high)], n
    )
    shaft = cylinder(0.14 * p, z + 0.5 * head_high, z + head_high, 10)
    long = float(rng.uniform(2.2, 3.2)) * m
    parts = [
        Part(merge([head, out, seat]), CASING, "pump", CASING),
        Part(merge([sole]), "pump base", "steel"),
        Part(merge([bell, *bowls]), CASING, "pump", CASING),
        Part(column, CASING, "pipe", CASING),
        Part(merge([shaft, gland]), "shaft", "trim", CASING),
        *placed(
            motor(m, long, style, rng, 0.0, pick(rng, "cast", "drip", "ex")),
            at(0, 0, z + head_high) @ spun("z", float(rng.uniform(0, 6))),
        ),
        *(Part(x, "beam", "steel", "", "Structural element") for x in grid),
        *(Part(x, "column", "steel", "", "Structural element") for x in posts),
    ]
    if rng.random() < 0.5:
        mesh = ring(1.02 * p, 1.04 * p, z + 0.6 * head_high, z + head_high - 0.025, n)
        parts.append(Part(mesh, "coupling guard", "safety"))
    return Model(parts, ports=(port,), kind="vertical turbine pump")


def _magnetic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A magnetic drive or canned motor pump (API 685, ISO 15783): a plastic or cast front, a canister, no seal."""
    out = smaller(dn)
    s = 0.05 + 1.0 * PIPES[dn].radius
    r, half, n = 1.2 * s, 0.5 * s, style.round(s)
    axis = float(rng.uniform(1.4, 1.8)) * r
    front, rise = half + dead_room(dn) + 0.03, axis + 1.1 * r + dead_room(out)
    suction, first = mouth(dn, style, (-front, 0, axis), (-1, 0, 0), front)
    top, second = mouth(out, style, (0, 0, rise), (0, 0, 1), rise - axis)
    cup = [(0.6 * r, -half), (r, -0.7 * half), (r, 0.8 * half), (1.2 * r, 0.85 * half), (1.2 * r, half + 0.1 * r)]
    house = along("x", turned(cup, n), 0, 0, axis)
    ribs = along("x", around(box((0.5 * r, 0.06 * r, half), (0.95 * r, 0, 0)), 8), 0, 0, axis)
    back = half + 0.1 * r
    m, length = 0.95 * r, float(rng.uniform(2.2, 3.4)) * r
    canned = bool(rng.random() < 0.4)
    parts = [Part(merge([house, ribs, suction, top]), CASING, "pump", CASING)]
    screws = around(hexagon(0.16 * r, back - 0.35 * r, back - 0.2 * r), 6, 1.08 * r)
    parts.append(Part(along("x", screws, 0, 0, axis), "bolt", "fastener", CASING, "Connection assembly", True))
    seat = 0.02
    if canned:
        can = [
            (1.2 * r, 0),
            (1.2 * r, 0.12 * r),
            (m, 0.14 * r),
            (m, length),
            (1.1 * r, length),
            (1.1 * r, length + 0.15 * r),
        ]
        parts.append(Part(along("x", turned(can, n), back, 0, axis), "motor", "motor", "motor"))
        lid = turned([(0.6 * m, 0), (0.6 * m, 0.1 * m), (0.3 * m, 0.2 * m)], n)
        parts.append(Part(along("x", lid, back + length + 0.15 * r, 0, axis), CASING, "pump", CASING))
        loop = [
            (0.3 * r, 0, axis + 1.1 * r),
            (0.3 * r, 0.3 * r, axis + 1.4 * r),
            (back + length, 0.3 * r, axis + 1.4 * r),
            (back + length + 0.07 * r, 0, axis + 1.0 * r),
        ]
        parts.append(Part(rope(loop, 0.06 * r, 8), "pipe", "pipe", "", "Pipe assembly"))
        case = [
            box((0.7 * r, 0.6 * r, 0.5 * r), (back + 0.5 * length, 0, axis + 1.15 * m)),
            box((0.8 * r, 0.7 * r, 0.06 * r), (back + 0.5 * length, 0, axis + 1.4 * m)),
        ]
        parts.append(Part(merge(case), "terminal box", "electrical", "motor"))
        far = back + length
    else:
        bell = [
            (1.2 * r, 0),
            (1.2 * r, 0.12 * r),
            (1.0 * r, 0.15 * r),
            (1.0 * r, 0.9 * r),
            (1.15 * m, 0.95 * r),
            (1.15 * m, 1.05 * r),
        ]
        parts.append(Part(along("x", turned(bell, n), back, 0, axis), CASING, "rubber", CASING))
        parts += placed(motor(m, length, style, rng), at(back + 1.05 * r, 0, axis) @ LYING)
        far = back + 1.05 * r + 0.8 * length
    for x in (0.0, 0.75 * far):
        leg = box((0.25 * r, 1.5 * r, axis - 0.7 * r - seat), (x, 0, (seat + axis - 0.7 * r) / 2))
        parts.append(Part(leg, CASING if x == 0 else "motor", "pump", CASING if x == 0 else "motor"))
    parts += base("rim", -half, far, 2.2 * r, seat, [0.0, 0.75 * far], rng)[:1]
    return Model(parts, ports=(first, second), kind="magnetic drive pump")


def _electronic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A circulator with a permanent magnet motor and its electronics in front (EN 16297), flanged, in the line."""
    radius = PIPES[dn].radius
    r = 0.05 + 1.3 * radius
    length = round(2 * (0.75 * r + dead_room(dn) + 0.02), 6)
    n, x, neck = style.round(r), length / 2, 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.28 * length), (neck, 0.72 * length)])
    house = along(
        "y",
        turned([(0.6 * r, -0.75 * r), (0.95 * r, -0.5 * r), (r, 0.1 * r), (1.1 * r, 0.12 * r), (1.1 * r, 0.3 * r)], n),
        x,
    )
    parts = [Part(merge([body, house]), CASING, "pump", CASING)]
    deep = float(rng.uniform(0.7, 1.3)) * r
    fins = [cylinder(0.98 * r, 0.3 * r + z * deep, 0.3 * r + (z + 0.08) * deep, n) for z in (0.1, 0.3, 0.5, 0.7)]
    can = merge([cylinder(0.85 * r, 0.3 * r, 0.3 * r + deep, n), *(fins if rng.random() < 0.6 else [])])
    parts.append(Part(along("y", can, x), "motor", "motor", "motor"))
    kind, y = int(rng.integers(3)), 0.3 * r + deep
    tall = float(rng.uniform(0.5, 0.9)) * r
    outline = (
        rounded_rectangle(2.1 * r, 1.9 * r, 0.3 * r, 3),
        rounded_rectangle(1.6 * r, 2.6 * r, 0.5 * r, 4),
        circle(1.05 * r, n),
    )[kind]
    head = [extrude(outline, y, y + 0.7 * tall), extrude(0.9 * outline, y + 0.7 * tall, y + tall)]
    screen = box((0.9 * r, 0.6 * r, 0.04 * r), (0, 0, y + tall))
    knob = [moved(cylinder(0.16 * r, y + tall, y + tall + 0.06 * r, 14), at(0, 0.55 * r))]
    gland = moved(
        merge([cylinder(0.09 * r, 0, 0.35 * r, 8), hexagon(0.26 * r, 0, 0.12 * r)]),
        at(0, -0.9 * r, y + 0.35 * tall) @ spun("x", np.pi / 2),
    )
    parts.append(Part(along("y", merge([*head, screen, *knob, gland]), x), "terminal box", "rubber", "motor"))
    return Model(parts, length, kind="circulator")


def _duckfoot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sewage pump in a sump: coupled to a duckfoot bend by its claw, two guide rails, riser, chain, power cable."""
    radius = PIPES[dn].radius
    r = 1.9 * radius + 0.06
    n, tall = style.round(r), float(rng.uniform(2.2, 3.6)) * r
    low = 0.25 * r + 0.05
    axis = low + 0.5 * r
    house = moved(volute(0.95 * r, 0.5 * r, style, 0.35), at(0, 0, axis))
    mouth_ = turned([(0.75 * r, low - 0.25 * r), (0.55 * r, low + 0.1 * r)], n)
    can = turned(
        [
            (0.8 * r, axis + 0.4 * r),
            (0.8 * r, axis + 0.6 * r),
            (0.68 * r, axis + 0.65 * r),
            (0.68 * r, axis + tall),
            (0.6 * r, axis + tall + 0.15 * r),
        ],
        n,
    )
    fins = around(box((0.16 * r, 0.05 * r, 0.7 * tall), (0.72 * r, 0, axis + 0.6 * tall)), int(rng.choice([8, 12, 16])))
    ring_ = torus(0.35 * r, 0.05 * r, 14, 6)
    lift = moved(ring_, at(0, 0, axis + tall + 0.45 * r) @ spun("x", np.pi / 2))
    gland = [moved(cylinder(0.1 * r, axis + tall, axis + tall + 0.35 * r, 10), at(0.35 * r, 0.3 * r))]
    face = 1.4 * r + dead_room(dn)
    stub, _ = mouth(dn, style, (face, 0, axis), (1, 0, 0), face - 0.4 * r)
    claw = box((0.05, FLANGES[dn].outer + 0.1, 0.08), (face - 0.03, 0, axis + FLANGES[dn].outer / 2 + 0.02))
    bend = ELBOW_LONG_RADIUS[dn]
    t = np.linspace(0, np.pi / 2, 7)
    plate, mate = (
        plate_thickness(dn),
        moved(
            disc_flange(dn, style, plate_thickness(dn)), looking((face, 0, axis), (-1, 0, 0)) @ spun("y", -np.pi / 2)
        ),
    )
    path = [
        (face + plate, 0, axis),
        *((face + plate + 0.01 + bend * np.sin(a), 0, axis + bend * (1 - np.cos(a))) for a in t),
    ]
    top = axis + bend + 0.02 + dead_room(dn)
    up, port = mouth(dn, style, (face + plate + 0.01 + bend, 0, top), (0, 0, 1), top - axis - bend + 0.004)
    x_foot = face + plate + 0.6 * bend
    foot = [
        box((1.6 * bend, 1.2 * FLANGES[dn].outer, 0.02), (x_foot, 0, 0.01)),
        box((0.06, 0.8 * FLANGES[dn].outer, axis - 0.3 * radius), (x_foot, 0, (axis - 0.3 * radius) / 2)),
    ]
    rails = [
        rod(
            (face + 0.02, y * 0.3 * FLANGES[dn].outer, axis + FLANGES[dn].outer / 2 + 0.03),
            (face + 0.02, y * 0.3 * FLANGES[dn].outer, top + 1.2),
            0.02,
            8,
        )
        for y in (-1, 1)
    ]
    bracket = box((0.05, FLANGES[dn].outer, 0.06), (face + 0.02, 0, axis + FLANGES[dn].outer / 2 + 0.06))
    stool = around(box((0.12 * r, 0.1 * r, low), (0, 0, low / 2)), 3, 0.7 * r)
    cable = [
        (0.35 * r, 0.3 * r, axis + tall + 0.3 * r),
        (0.4 * r, 0.4 * r, axis + tall + 0.8 * r),
        (0.8 * r, 0.9 * r, top + 0.6),
        (0.9 * r, 1.0 * r, top + 1.2),
    ]
    parts = [
        Part(merge([house, mouth_, stub, claw]), CASING, "pump", CASING),
        Part(merge([can, fins, *gland]), "motor", "motor", "motor"),
        Part(stool, "pump base", "steel"),
        Part(lift, "lifting lug", "clamp", "motor", "Tank"),
        Part(merge([mate, tube(np.array(path), radius, 0.0, n), up, *foot]), "elbow", "pipe", "", "Pipe assembly"),
        *(Part(x, "post", "steel", "", "Structural element") for x in rails),
        Part(bracket, "bracket", "steel", "", "Connection assembly"),
        Part(rope(cable, 0.012, 8), "cable", "rubber", "", "Electrical and safety"),
    ]
    return Model(parts, ports=(port,), kind="sewage pump")


_PUMPS = tuple(
    Family(f"pump/{name}", place, PUMP, "pump", build, sizes)
    for name, place, build, sizes in (
        ("vertical turbine", "floor", _turbine, (80, 100, 125, 150, 200)),
        ("self-priming", "floor", _self_priming, (40, 50, 80, 100)),
        ("magnetic drive", "floor", _magnetic, (20, 25, 32, 40, 50, 65)),
        ("electronic circulator", "inline", _electronic, (32, 40, 50, 65, 80, 100)),
        ("duckfoot", "floor", _duckfoot, (50, 65, 80, 100, 150)),
    )
)
SPECIAL: tuple[Family, ...] = (*_PUMPS,)
