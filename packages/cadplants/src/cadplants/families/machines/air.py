"""Blowers and fans, compressors, and a motor with its gear, with what they stand on."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import (
    BASES,
    LYING,
    PUMP,
    base,
    dead_room,
    foreign,
    motor,
    mouth,
    slab,
    train,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, torus, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["AIR"]

_EQ = "Equipment"


def _scroll(r: float, wide: float, style: ModelingStyle, growth: float) -> Solid:
    """A sheet fan housing about z, blowing to +y on its +x side, rims at its cheeks."""
    a = np.linspace(0, 1.5 * np.pi, max(12, style.round(r)))
    spiral = (r * (1 + growth * (1 - a / (1.5 * np.pi))))[:, None] * np.column_stack([np.cos(a), np.sin(a)])
    # From the cut-off over the back down to the mouth, which lies on the +x side.
    turned_ = spiral[::-1] * np.array([1.0, -1.0])
    outer = r * (1 + growth)
    mouth_ = np.array([(outer, 1.2 * r), (0.25 * r, 1.2 * r)])
    outline = np.vstack([turned_, mouth_])
    area = np.sum(outline[:, 0] * np.roll(outline[:, 1], -1) - outline[:, 1] * np.roll(outline[:, 0], -1))
    if area < 0:
        outline = outline[::-1]
    rims = [extrude(outline * 1.05, z - 0.004, z + 0.004) for z in (-wide / 2, wide / 2)]
    lip = box((1.05 * (outer - 0.15 * r), 0.02, 1.2 * wide), ((outer + 0.25 * r) / 2, 1.25 * r, 0))
    return merge([extrude(outline, -wide / 2, wide / 2), *rims, lip])


def _belt_fan(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A radial fan with a belt drive or on the motor's shaft: scroll with rims, inlet cone, pedestal, damped frame."""
    eq, r = "blower", float(rng.uniform(0.18, 0.4))
    wide, growth = float(rng.uniform(0.5, 1.1)) * r, float(rng.uniform(0.25, 0.55))
    n, axis = style.round(r), (1.25 + growth) * r + 0.2
    house = _scroll(r, wide, style, growth)
    quarter = int(rng.integers(3))
    stand = at(0, 0, axis) @ spun("x", np.pi / 2)
    house = moved(house, stand @ spun("z", -quarter * np.pi / 2))
    inlet = [(0.55 * r, 0), (0.62 * r, 0.12 * r), (0.8 * r, 0.2 * r), (0.8 * r, 0.22 * r)]
    cone = moved(turned(inlet, n), stand @ at(0, 0, wide / 2))
    parts = [Part(merge([house, cone]), eq, "motor", eq)]
    if rng.random() < 0.4:
        mesh = [moved(torus(k * r, 0.006, n, 4), stand @ at(0, 0, wide / 2 + 0.24 * r)) for k in (0.2, 0.4, 0.6, 0.78)]
        bars = [
            box((1.56 * r, 0.008, 0.008), (0, -wide / 2 - 0.235 * r, axis)),
            box((0.008, 0.008, 1.56 * r), (0, -wide / 2 - 0.235 * r, axis)),
        ]
        parts.append(Part(merge([*mesh, *bars]), eq, "clamp", eq))
    deep = float(rng.uniform(1.5, 2.0)) * r
    low = 0.14
    y0 = wide / 2 + 0.005
    rails = [box((0.08, wide + deep, 0.08), (s * 0.9 * r, deep / 2, low)) for s in (-1, 1)]
    rails += [box((1.8 * r, 0.08, 0.08), (0, y, low)) for y in (-0.4 * wide, y0 + 0.3 * r, y0 + 0.8 * deep)]
    pads = [
        moved(cylinder(0.05, 0, low - 0.035, 12), at(sx * 0.9 * r, y))
        for sx in (-1, 1)
        for y in (-0.4 * wide, wide / 2 + 0.85 * deep)
    ]
    legs = [
        box((0.06, 0.04, axis - 0.45 * r - low), (x, s * wide / 2 + s * 0.02, (axis - 0.45 * r + low) / 2))
        for x in (-0.85 * r, 0.85 * r)
        for s in (-1, 1)
    ]
    seat = low + 0.04
    parts.append(Part(merge([*rails, *legs]), eq, "steel", eq))
    parts.append(Part(merge(pads), eq, "rubber", eq))
    m = 0.3 * r + 0.02
    if rng.random() < 0.55:
        high = axis - seat - 0.14 * r
        ped = slab(
            np.array([(y0 + 0.1 * r, 0), (y0 + 0.9 * deep, 0), (y0 + 0.7 * deep, high), (y0 + 0.1 * r, high)])
            + np.array((0.0, seat)),
            -0.35 * r,
            0.35 * r,
        )
        blocks = [box((0.4 * r, 0.2 * r, 0.3 * r), (0, y0 + y * deep, axis)) for y in (0.2, 0.55)]
        shaft = along("y", cylinder(0.06 * r, y0 - 0.02, y0 + 1.05 * deep, 12), 0, 0, axis)
        mx, mz = 1.25 * r, seat + 1.25 * m
        far = y0 + 0.85 * deep
        out = y0 + 1.0 * deep
        tilt = float(np.arctan2(mz - axis, mx))
        reach = float(np.hypot(mx, mz - axis))
        hood = moved(
            extrude(rounded_rectangle(reach + 0.9 * r, 0.85 * r, 0.42 * r, 4), -0.06, 0.06),
            at(mx / 2, out, (axis + mz) / 2) @ spun("x", np.pi / 2) @ spun("z", tilt),
        )
        table = box((0.9 * r, 0.8 * deep, 0.02), (1.25 * r, y0 + 0.45 * deep, seat - 0.01))
        beams = [box((0.8 * r, 0.06, 0.06), (1.25 * r, y0 + y * deep, seat - 0.05)) for y in (0.15, 0.75)]
        post = [
            box((0.06, 0.06, seat - 0.08), (1.25 * r + 0.3 * r, y0 + y * deep, (seat - 0.08) / 2)) for y in (0.15, 0.75)
        ]
        parts += [
            Part(merge([ped, *blocks]), eq, "steel", eq),
            Part(shaft, "shaft", "trim", eq, PUMP),
            Part(hood, "coupling guard", "safety", "", PUMP),
            Part(merge([table, *beams, *post]), eq, "steel", eq),
        ]
        pose = at(mx, far + 0.05, mz) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2)
        parts += foreign(placed(motor(m, min(2.8 * m, 0.7 * deep), style, rng, mz - seat), pose))
        parts.append(Part(along("y", cylinder(0.15 * m, far, out, 10), mx, 0, mz), "shaft", "trim", "motor", PUMP))
        return Model(parts, kind="radial fan")
    block = box((2.2 * m, 0.8 * deep, axis - seat - 1.25 * m), (0, y0 + 0.45 * deep, (axis + seat - 1.25 * m) / 2))
    parts.append(Part(block, eq, "steel", eq))
    pose = at(0, y0 + 0.04, axis) @ spun("x", -np.pi / 2) @ spun("z", -np.pi / 2)
    parts += foreign(placed(motor(m, 2.8 * m, style, rng, 1.25 * m), pose))
    parts.append(
        Part(along("y", cylinder(0.15 * m, y0 - 0.03, y0 + 0.05, 10), 0, 0, axis), "shaft", "trim", "motor", PUMP)
    )
    return Model(parts, kind="radial fan")


def _roots(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Roots blower: an oval ribbed casing with gear cases, silencers above and below or aside, filter, belt guard."""
    eq, s = "blower", 0.1 + 0.9 * PIPES[dn].radius
    seat = float(rng.uniform(0.3, 0.5)) + 1.2 * s
    axis, long = seat + 1.3 * s, float(rng.uniform(2.0, 3.2)) * s
    oval = rounded_rectangle(3.1 * s, 1.9 * s, 0.94 * s, 5)
    upright = bool(rng.random() < 0.5)
    turn = along("x", extrude(oval, -long / 2, long / 2))
    pose = at(0, 0, axis) @ spun("x", 0.0 if upright else np.pi / 2)
    ribs = [along("x", extrude(1.06 * oval, x - 0.01, x + 0.01)) for x in np.linspace(-0.42, 0.42, 5) * long]
    ends = [along(a, extrude(0.92 * oval, long / 2, long / 2 + 0.5 * s)) for a in ("x", "-x")]
    caps = [
        along(
            "x",
            turned([(0.5 * s, long / 2 + 0.5 * s), (0.5 * s, long / 2 + 0.6 * s), (0.3 * s, long / 2 + 0.7 * s)], 16),
            0,
            0,
            y,
        )
        for y in (-0.7 * s, 0.7 * s)
    ]
    body = moved(merge([turn, *ribs, *ends, *caps]), pose)
    half = (0.95 if not upright else 1.55) * s
    feet = [
        box((0.2 * s, 1.6 * s, axis - seat - 0.5 * half), (x * 0.4 * long, 0, (seat + axis - 0.5 * half) / 2))
        for x in (-1, 1)
    ]
    p, n = PIPES[dn].radius, style.round(2.2 * p_(dn))
    can = float(rng.uniform(2.0, 2.8)) * p
    tall = float(rng.uniform(5, 8)) * p + 0.1
    z = axis + half - 0.02
    drum = turned(
        [
            (p, z),
            (p, z + 0.08),
            (can, z + 0.1 + 0.5 * p),
            (can, z + 0.1 + tall),
            (p, z + 0.12 + tall + 0.4 * p),
            (p, z + 0.22 + tall),
        ],
        n,
    )
    hat = [
        cylinder(1.5 * p, z + 0.2 + tall, z + 0.22 + tall + 1.6 * p, n),
        cylinder(1.7 * p, z + 0.22 + tall + 1.6 * p, z + 0.24 + tall + 1.6 * p, n),
    ]
    hat += [cylinder(1.56 * p, z + 0.2 + tall + k * p, z + 0.21 + tall + k * p, n) for k in (0.3, 0.6, 0.9, 1.2)]
    low = seat - 0.11
    silencer = along(
        "x",
        turned([(0.6 * can, -0.62 * long), (can, -0.55 * long), (can, 0.75 * long), (0.6 * can, 0.85 * long)], n),
        0,
        0,
        0,
    )
    can_z = max(can + 0.02, low - can)
    drop = rod((0, 0, axis - 0.6 * half), (0, 0, can_z), p, n)
    face, port = mouth(dn, style, (-0.62 * long - dead_room(dn) - 0.05, 0, can_z), (-1, 0, 0), dead_room(dn) + 0.06)
    m = 1.05 * s
    gap = 2.4 * s
    frame = [box((long + 1.6 * s, 0.08, 0.1), (0, y, seat - 0.05)) for y in (-0.75 * s, 0.75 * s)]
    frame += [box((0.1, gap + 2.6 * m, 0.1), (x * 0.4 * long, gap / 2, seat - 0.05)) for x in (-1, 1)]
    posts = [
        box((0.08, 0.08, seat - 0.1), (x * 0.4 * long, y, (seat - 0.1) / 2))
        for x in (-1, 1)
        for y in (-max(can, 0.75 * s) - 0.06, gap + m)
    ]
    across = [box((0.08, 0.08, 0.08), (x * 0.4 * long, -max(can, 0.75 * s) - 0.04, seat - 0.05)) for x in (-1, 1)]
    mz = seat + 1.3 * m
    length = min(2.6 * m, long)
    drive_x = -long / 2 - 0.8 * s
    reach = float(np.hypot(gap, mz - axis))
    hood = slab(rounded_rectangle(reach + 2.0 * s, 1.7 * s, 0.8 * s, 4), -0.07, 0.07)
    hood = moved(hood, at(drive_x, gap / 2, (axis + mz) / 2) @ spun("x", float(np.arctan2(mz - axis, gap))))
    parts = [
        Part(merge([body, *feet]), eq, "pump", eq),
        Part(merge([drum]), eq, "tank", eq),
        Part(merge(hat), "filter", "electrical", eq, ""),
        Part(merge([moved(silencer, at(0, 0, can_z)), drop, face]), eq, "tank", eq),
        Part(merge([*frame, *posts, *across]), eq, "steel", eq),
        Part(hood, "coupling guard", "safety", "", PUMP),
        Part(along("x", cylinder(0.15 * s, drive_x, -long / 2, 12), 0, 0, axis), "shaft", "trim", eq, PUMP),
        Part(
            along("x", cylinder(0.15 * s, drive_x, -length / 2 + 0.05, 12), 0, gap, mz), "shaft", "trim", "motor", PUMP
        ),
    ]
    parts += foreign(placed(motor(m, length, style, rng, mz - seat), at(-length / 2, gap, mz) @ LYING))
    return Model(parts, ports=(port,), kind="Roots blower")


def p_(dn: int) -> float:
    """Outside radius of a pipe [m]."""
    return PIPES[dn].radius


def _side_channel(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A side channel blower: a flat ring housing with a fat rim, two silencer boxes to its foot, a motor."""
    eq, r = "blower", float(rng.uniform(0.14, 0.28))
    n, axis = style.round(r), 1.2 * r + 0.03
    a = np.linspace(-np.pi / 2, np.pi / 2, 7)
    rim = [(0.82 * r + 0.2 * r * np.cos(t), 0.2 * r * np.sin(t)) for t in a]
    stages = int(rng.integers(1, 3))
    wheel = [
        turned([(0.5 * r, z - 0.2 * r), *((x, y + z) for x, y in rim), (0.5 * r, z + 0.2 * r)], n)
        for z in (np.arange(stages) * 0.42 * r)
    ]
    ribs = around(box((0.55 * r, 0.03 * r, 0.06 * r), (0.6 * r, 0, -0.2 * r)), int(rng.choice([6, 8, 12])))
    cap = turned([(0.35 * r, -0.3 * r), (0.5 * r, -0.15 * r)], n)
    house = moved(merge([*wheel, ribs, cap]), at(0, 0, axis) @ spun("y", np.pi / 2))
    boxes = []
    depth = 0.5 * r + 0.42 * r * (stages - 1)
    for s in (-1, 1):
        outline = rounded_rectangle(0.75 * r, 0.6 * r, 0.12 * r, 3)
        boxes.append(moved(extrude(outline, 0.03, axis - 0.5 * r), at(0.3 * depth - 0.1 * r, s * 0.7 * r)))
        boxes.append(
            along(
                "y" if s > 0 else "-y",
                cylinder(0.2 * r, 0, 0.28 * r, 16),
                0.3 * depth - 0.1 * r,
                s * 0.98 * r,
                0.03 + 0.28 * r,
            )
        )
        boxes.append(
            along(
                "y" if s > 0 else "-y",
                hexagon(0.52 * r, 0.2 * r, 0.4 * r),
                0.3 * depth - 0.1 * r,
                s * 0.98 * r,
                0.03 + 0.28 * r,
            )
        )
    foot = box((depth + 0.4 * r, 2.1 * r, 0.03), (0.2 * r + 0.3 * depth, 0, 0.015))
    m = float(rng.uniform(0.5, 0.65)) * r
    x = 0.2 * r + 0.42 * r * (stages - 1)
    parts = [Part(merge([house, *boxes, foot]), eq, "trim", eq)]
    parts += foreign(
        placed(
            motor(m, float(rng.uniform(2.2, 3.0)) * m, style, rng, 0.0, pick(rng, "cast", "square")),
            at(x - 0.01, 0, axis) @ LYING,
        )
    )
    return Model(parts, kind="side channel blower")


def _axial(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An axial duct fan: a flanged round casing with the motor on struts inside, blades, guard; on feet or hung."""
    eq, r = "blower", float(rng.uniform(0.2, 0.5))
    n, long = style.round(r), float(rng.uniform(0.8, 1.6)) * r
    hung = rng.random() < 0.35
    axis = 1.25 * r + 0.1 if not hung else float(rng.uniform(2.0, 2.6))
    case = [
        ring(0.97 * r, r, -long / 2, long / 2, n),
        *(ring(0.97 * r, 1.13 * r, z - 0.005, z + 0.005, n) for z in (-long / 2 + 0.005, long / 2 - 0.005)),
    ]
    box_ = box((0.25 * r, 0.35 * r, 0.25 * r), (0, 0.7 * r, 0.7 * r))
    blade = moved(
        box((0.6 * r, 0.22 * r, 0.015 * r + 0.002), (0.63 * r, 0, 0)), at(0, 0, -0.35 * long) @ spun("x", 0.6)
    )
    hub = merge([cylinder(0.36 * r, -0.43 * long, -0.25 * long, n), around(blade, int(rng.integers(4, 9)))])
    struts = around(box((0.66 * r, 0.02, 0.15 * r), (0.64 * r, 0, 0.2 * long)), 4, 0.0, np.pi / 4)
    lay = at(0, 0, axis) @ spun("y", np.pi / 2)
    parts = [
        Part(moved(merge([*case, struts]), lay), eq, "clamp", eq),
        Part(moved(hub, lay), "impeller", "trim", eq, PUMP),
    ]
    m = 0.34 * r
    parts += foreign(
        placed(
            motor(m, 0.85 * long, style, rng, 0.0, pick(rng, "cast", "smooth", "square"))[:2],
            at(-0.25 * long, 0, axis) @ LYING,
        )
    )
    parts.append(Part(moved(box_, at(0, 0, axis) @ spun("x", 0.0)), "terminal box", "electrical", "motor", PUMP))
    if rng.random() < 0.6:
        mesh = [moved(torus(k * r, 0.004 + 0.006 * r, n, 4), at(0, 0, -long / 2)) for k in (0.25, 0.5, 0.75, 0.98)]
        wires = [moved(box((2 * r, 0.008, 0.008), (0, 0, -long / 2)), spun("z", t)) for t in (0.0, 1.05, 2.09)]
        parts.append(Part(moved(merge([*mesh, *wires]), lay), eq, "safety", eq))
    if hung:
        lug = [
            box((0.05, 0.06, 0.04), (x * 0.3 * long, y * 0.7 * r, axis + 0.72 * r)) for x in (-1, 1) for y in (-1, 1)
        ]
        parts.append(Part(merge(lug), eq, "clamp", eq))
        high = axis + 1.6 * r
        for x in (-1, 1):
            for y in (-1, 1):
                parts.append(
                    Part(
                        rod(
                            (x * 0.3 * long, y * 0.7 * r, axis + 0.72 * r),
                            (x * 0.3 * long, y * 0.7 * r, high),
                            0.006,
                            8,
                        ),
                        "stud",
                        "fastener",
                        "",
                        "Connection assembly",
                    )
                )
        parts.append(
            Part(box((1.2 * long + 0.3, 2.2 * r, 0.1), (0, 0, high + 0.05)), "beam", "steel", "", "Structural element")
        )
        parts.append(Part(box((0.1, 2.5 * r, 0.1), (0, 0, high + 0.15)), "beam", "steel", "", "Structural element"))
        parts += [
            Part(moved(s, at(0, 0, 0)), "column", "steel", "", "Structural element")
            for s in (box((0.1, 0.1, high + 0.2), (0, y * (1.25 * r + 0.05), (high + 0.2) / 2)) for y in (-1, 1))
        ]
    else:
        foot = [box((0.15, 2.1 * r, 0.012), (x * 0.3 * long, 0, 0.006)) for x in (-1, 1)]
        foot += [
            box((0.05, 0.28 * r, axis - 0.68 * r), (x * 0.3 * long, y * 0.86 * r, (axis - 0.68 * r) / 2))
            for x in (-1, 1)
            for y in (-1, 1)
        ]
        parts.append(Part(merge(foot), "bracket", "steel", eq, "Connection assembly"))
    return Model(parts, kind="axial fan")


def _geared_motor(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A motor that drives a gearbox through a guarded coupling, on a base frame: what a conveyor or mixer has."""
    r = float(rng.uniform(0.08, 0.25))
    seat, s = float(rng.uniform(0.06, 0.25)), float(rng.uniform(1.0, 1.5)) * r
    axis = seat + 1.25 * max(r, s)
    case = [
        box((1.8 * s, 1.5 * s, axis - seat + 0.3 * s), (0, 0, (seat + axis + 0.3 * s) / 2)),
        box((1.9 * s, 1.9 * s, 0.14 * s), (0, 0, axis)),
    ]
    case += [moved(cylinder(0.3 * s, 0, 0.3 * s, 14), at(0.3 * s, 0, axis + 0.28 * s))]
    bearing = along("x", cylinder(0.45 * s, 0.85 * s, 1.05 * s, style.round(s)), 0, 0, axis)
    slow = along(
        "-x",
        merge(
            [
                cylinder(0.5 * s, 0.85 * s, 1.1 * s, style.round(s)),
                cylinder(0.2 * s, 1.0 * s, 2.2 * s, 14),
                box((0.06 * s, 0.1 * s, 0.8 * s), (0.2 * s, 0, 1.7 * s)),
            ]
        ),
        0,
        0,
        axis,
    )
    fins = [box((1.5 * s, 1.56 * s, 0.04 * s), (0, 0, seat + k * (axis - seat))) for k in (0.3, 0.45, 0.6)]
    start = 1.5 * s
    parts = [
        Part(merge([*case, bearing, *fins]), "gearbox", "motor", "motor", "Valve assembly"),
        Part(slow, "shaft", "trim", "motor"),
        Part(along("x", cylinder(0.16 * r, 1.0 * s, start, 12), 0, 0, axis), "shaft", "trim", "motor"),
    ]
    more, far, seats = train(
        start, axis, seat, r, style, rng, pick(rng, "cast", "square", "drip", "ex", "smooth", "cooled")
    )
    bed = base(pick(rng, *BASES), -1.1 * s, far, 2.5 * max(r, 0.8 * s), seat, [-0.5 * s, 0.5 * s, *seats], rng)
    return Model([*more, *parts, *bed], kind="motor")


AIR: tuple[Family, ...] = (
    Family("blower/belt fan", "floor", _EQ, "blower", _belt_fan, (15,), weight=1.5),
    Family("blower/Roots", "floor", _EQ, "blower", _roots, (50, 65, 80, 100, 125, 150)),
    Family("blower/side channel", "floor", _EQ, "blower", _side_channel, (40,)),
    Family("blower/axial", "floor", _EQ, "blower", _axial, (15,)),
    Family("motor/geared", "floor", PUMP, "motor", _geared_motor, (15,), weight=1.5),
)
