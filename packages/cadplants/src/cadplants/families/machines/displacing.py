"""Positive displacement pumps: screws, lobes, hoses, diaphragms, plungers; hand pumps and hydraulic packs."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import BASES, CASING, LYING, PUMP, base, dead_room, motor, mouth, train
from cadplants.families.valves.valve import bolt_circle
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import FLANGES, PIPES, smaller
from cadplants.transforms import at, spun

__all__ = ["DISPLACING"]


def _cavity(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A progressive cavity pump: a long stator tube under tie rods, a suction chamber, lantern, gear motor, base."""
    p, n = PIPES[dn].radius, style.round(PIPES[dn].radius * 1.4)
    seat = float(rng.uniform(0.08, 0.16))
    axis = seat + FLANGES[dn].outer / 2 + 0.05
    tube_r, stator = 1.15 * p, float(rng.uniform(14, 26)) * p
    reach = dead_room(dn) + 0.03
    end, first = mouth(dn, style, (-reach, 0, axis), (-1, 0, 0), reach + 0.01)
    clamps = [cylinder(1.4 * tube_r, z, z + 0.03, n) for z in (0.0, stator - 0.03)]
    barrel = along("x", merge([cylinder(tube_r, 0.0, stator, n), *clamps]), 0, 0, axis)
    ties = along(
        "x", around(rod((0, 0, -0.02), (0, 0, stator + 0.02), 0.008, 8), 4, 1.25 * tube_r, np.pi / 4), 0, 0, axis
    )
    room = max(6.0 * p, 1.2 * FLANGES[dn].outer)
    chamber = [
        cylinder(1.35 * p, stator, stator + room, n),
        cylinder(1.7 * p, stator + room - 0.02, stator + room + 0.02, n),
    ]
    x = stator + 0.55 * room
    up = axis + 1.35 * p + dead_room(dn) + 0.02
    side, second = mouth(dn, style, (x, 0, up), (0, 0, 1), up - axis - 0.6 * p)
    hopper = rng.random() < 0.25
    if hopper:
        wide = 2.4 * p
        top = axis + 6 * p
        walls = [box((room, 0.006, top - axis), (stator + room / 2, s * wide, (top + axis) / 2)) for s in (-1, 1)]
        walls += [
            box((0.006, 2 * wide, top - axis), (q, 0, (top + axis) / 2))
            for q in (stator + 0.003, stator + room - 0.003)
        ]
        side = merge([*walls, box((room, 2 * wide, 0.02), (stator + room / 2, 0, axis))])
    lantern = turned(
        [(1.5 * p, 0.0), (1.5 * p, 0.02), (1.1 * p, 0.03), (1.1 * p, 4 * p), (1.6 * p, 4.1 * p), (1.6 * p, 4.4 * p)], n
    )
    back = stator + room + 0.02
    feet = [
        box((0.08, 2.4 * p, axis - seat - 1.1 * p), (q, 0, (seat + axis - 1.1 * p) / 2))
        for q in (0.25 * stator, 0.8 * stator, x)
    ]
    parts = [
        Part(merge([end, side, along("x", merge(chamber), 0, 0, axis)]), CASING, "pump", CASING),
        Part(barrel, CASING, "trim", CASING),
        Part(ties, "stud", "fastener", CASING, "Connection assembly", True),
        Part(along("x", lantern, back, 0, axis), CASING, "pump", CASING),
        Part(merge(feet), "pump base", "steel"),
    ]
    m = 1.6 * p + 0.02
    box_x = back + 4.4 * p
    gear = [along("x", turned([(1.5 * m, 0), (1.5 * m, 0.03), (1.1 * m, 0.05), (1.1 * m, 1.4 * m)], n), box_x, 0, axis)]
    gear.append(box((1.2 * m, 1.9 * m, axis - seat), (box_x + 0.8 * m, 0, (seat + axis) / 2)))
    parts.append(Part(merge(gear), "motor", "motor", "motor"))
    length = float(rng.uniform(2.4, 3.2)) * m
    parts += placed(motor(m, length, style, rng), at(box_x + 1.4 * m, 0, axis) @ LYING)
    stations = [0.25 * stator, 0.8 * stator, x, box_x + 0.8 * m]
    parts += base(pick(rng, *BASES), -0.05, box_x + 2.5 * m, 2.6 * m, seat, stations, rng)
    return Model(parts, ports=(first,) if hopper else (first, second), kind="progressive cavity pump")


def _lobe(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rotary lobe pump: an oval casing with a bolted or clamped front cover, gear case, motor behind."""
    s = 0.04 + 1.4 * PIPES[dn].radius
    seat = float(rng.uniform(0.06, 0.15))
    axis = seat + 2.0 * s
    n = style.round(s)
    oval = rounded_rectangle(3.2 * s, 1.9 * s, 0.94 * s, max(4, n // 5))
    outline = oval if rng.random() < 0.5 else rounded_rectangle(1.9 * s, 3.2 * s, 0.94 * s, max(4, n // 5))
    upright = outline is not oval  # the sheet's first axis turns to z
    body = along("x", extrude(outline, -0.6 * s, 0.6 * s), 0, 0, axis)
    flange = along("x", extrude(1.12 * outline, -0.7 * s, -0.6 * s), 0, 0, axis)
    cover = along("x", extrude(1.1 * outline, -0.95 * s, -0.705 * s), 0, 0, axis)
    knobs = [
        along(
            "-x",
            merge([cylinder(0.1 * s, 0, 0.1 * s, 8), ball(0.16 * s, 10)]),
            -0.97 * s,
            y * 0.75 * s,
            axis + z * 0.75 * s,
        )
        for y in (-1, 1)
        for z in (-1, 1)
    ]
    level = bool(rng.random() < 0.6)
    wide = (1.6 if upright == level else 0.95) * s
    reach = wide + dead_room(dn) + 0.02
    ways = ((0, -1, 0), (0, 1, 0)) if level else ((0, 0, 1),)
    mouths = [mouth(dn, style, (0, reach * w[1], axis + reach * w[2]), w, reach - 0.5 * s) for w in ways]
    case = moved(extrude(rounded_rectangle(1.8 * s, 2.6 * s, 0.2 * s, 3), seat, axis + 1.3 * s), at(1.9 * s))
    neck = box((0.9 * s, 1.8 * s, 2.2 * s), (0.8 * s, 0, axis))
    eye = moved(torus(0.16 * s, 0.05 * s, 12, 6), at(1.9 * s, 0, axis + 1.4 * s) @ spun("x", np.pi / 2))
    start = 2.8 * s + 0.8 * s
    offset = 0.0
    parts = [
        Part(merge([body, flange, *(m for m, _ in mouths)]), CASING, "trim", CASING),
        Part(cover, CASING, "trim", CASING),
        Part(merge(knobs), "nut", "fastener", CASING, "Connection assembly", True),
        Part(merge([case, neck]), CASING, "pump", CASING),
        Part(eye, "lifting lug", "fastener", CASING, "Tank", True),
        Part(along("x", cylinder(0.2 * s, 2.7 * s, start, 12), 0, offset, axis), "shaft", "trim", CASING),
    ]
    more, far, seats = train(start, axis, seat, min(0.85 * (axis - seat), 1.4 * s), style, rng)
    bed = base(pick(rng, *BASES), 0.9 * s, far, 3.0 * s, seat, [1.9 * s, *seats], rng)
    return Model([*parts, *more, *bed], ports=tuple(p for _, p in mouths), kind="rotary lobe pump")


def _hose_pump(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A peristaltic pump: a round housing with a bolted cover and window, both hose ends to one side, gear motor."""
    r = 0.1 + 4.0 * PIPES[dn].radius
    n, wide, seat = style.round(r), 0.06 + 1.5 * PIPES[dn].radius, 0.05
    axis = seat + 1.12 * r + 0.03
    house = [cylinder(1.05 * r, -wide, wide, n), cylinder(1.12 * r, -wide - 0.02, -wide, n)]
    cover = [
        ring(0.35 * r, 1.1 * r, -wide - 0.035, -wide - 0.021, n),
        cylinder(0.36 * r, -wide - 0.03, -wide - 0.021, n),
    ]
    spokes = around(box((0.4 * r, 0.06 * r, 0.02), (0.7 * r, 0, -wide - 0.04)), int(rng.choice([4, 6, 8])))
    pose = at(0, 0, axis) @ spun("y", np.pi / 2)
    level = bool(rng.random() < 0.5)
    reach = 1.12 * r + dead_room(dn) + 0.03
    lever = 0.82 * r
    mouths = []
    for s in (-1, 1):
        if level:
            mouths.append(mouth(dn, style, (0, reach, axis + s * lever), (0, 1, 0), reach - 0.3 * r))
        else:
            mouths.append(mouth(dn, style, (0, s * lever, axis + reach), (0, 0, 1), reach - 0.3 * r))
    feet = [
        box((2.4 * wide, 0.12 * r + 0.02, axis - seat - 0.6 * r), (0, y * 0.7 * r, (seat + axis - 0.6 * r) / 2))
        for y in (-1, 1)
    ]
    screws = moved(bolt_circle(8, 1.08 * r, 0.01, -wide - 0.035, -wide + 0.0), pose)
    m = float(rng.uniform(0.35, 0.55)) * r + 0.01
    gear = merge([turned([(1.3 * m, wide), (1.3 * m, wide + 0.03), (m, wide + 0.05), (m, wide + 1.6 * m)], n)])
    parts = [
        Part(merge([moved(merge(house), pose), *feet, *(x for x, _ in mouths)]), CASING, "pump", CASING),
        Part(moved(merge([*cover, spokes]), pose), CASING, "steel", CASING),
        Part(screws, "bolt", "fastener", CASING, "Connection assembly", True),
        Part(moved(gear, pose), "motor", "motor", "motor"),
        *placed(motor(m, float(rng.uniform(2.4, 3.2)) * m, style, rng), at(wide + 1.6 * m, 0, axis) @ LYING),
    ]
    stay = box((0.05, 0.9 * m, axis - seat - 0.9 * m), (wide + 0.9 * m, 0, (seat + axis - 0.9 * m) / 2))
    parts.append(Part(stay, "pump base", "steel"))
    x1 = wide + 2.6 * m
    parts += base(
        pick(rng, "beams", "grid", "rim", "sheet"), -1.6 * wide, x1, 1.9 * r, seat, [0.0, wide + 0.9 * m], rng
    )
    return Model(parts, ports=tuple(p for _, p in mouths), kind="peristaltic pump")


def _clamped_diaphragm(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An air-operated diaphragm pump with band clamps or tie bolts: domed chambers, elbows, centre block, muffler."""
    p = PIPES[dn].radius
    r = 2.2 * p + 0.06
    n, gap = style.round(r), float(rng.uniform(0.4, 0.6)) * r
    axis = max(1.6 * r, 1.3 * r + FLANGES[dn].outer / 2) + 0.03
    bowl = dome(0.95 * r, float(rng.uniform(0.35, 0.6)) * r, gap, n)
    air = turned([(0.6 * r, 0.5 * gap), (0.95 * r, 0.9 * gap), (0.95 * r, gap)], n)
    band = ring(0.93 * r, 1.06 * r, gap - 0.05 * r, gap + 0.05 * r, n)
    lug = box((0.2 * r, 0.14 * r, 0.14 * r), (1.1 * r, 0, gap))
    centre = [
        box((gap, 0.9 * r, 1.1 * r), (0, 0, axis)),
        along("y", cylinder(0.35 * r, -0.6 * r, 0.6 * r, n), 0, 0, axis),
    ]
    ribbed = rng.random() < 0.5
    if ribbed:
        bowl = merge([bowl, around(box((0.75 * r, 0.04 * r, 0.3 * r), (0.45 * r, 0, gap + 0.15 * r)), 8)])
    front = 0.5 * r + dead_room(dn)
    parts = []
    manifolds, ports = [], []
    for s in (-1, 1):
        z = axis + s * 1.3 * r
        line = [
            (-gap - 0.25 * r, 0, axis + s * 0.75 * r),
            (-gap - 0.25 * r, 0, z - s * 0.15 * r),
            (-gap - 0.1 * r, 0, z),
            (gap + 0.1 * r, 0, z),
            (gap + 0.25 * r, 0, z - s * 0.15 * r),
            (gap + 0.25 * r, 0, axis + s * 0.75 * r),
        ]
        manifolds.append(rope(line, 1.15 * p, n))
        seats = [
            moved(
                merge([cylinder(1.7 * p, -0.06 * r, 0.06 * r, n), cylinder(1.4 * p, -0.2 * r, 0.2 * r, n)]),
                at(x * (gap + 0.25 * r), 0, axis + s * 0.9 * r),
            )
            for x in (-1, 1)
        ]
        manifolds += seats
        stub, port = mouth(dn, style, (0, -front, z), (0, -1, 0), front)
        manifolds.append(stub)
        ports.append(port)
    muffler = along(
        "y",
        turned([(0.12 * r, 0.55 * r), (0.22 * r, 0.6 * r), (0.22 * r, 1.2 * r), (0.1 * r, 1.25 * r)], n),
        0,
        0,
        axis - 0.1 * r,
    )
    low = axis - 1.3 * r - 1.15 * p
    feet = [
        box((0.35 * r, 1.3 * r, max(0.02, low + 0.02)), (x * (gap + 0.05 * r), 0, max(0.02, low + 0.02) / 2))
        for x in (-1, 1)
    ]
    parts = [
        Part(merge(manifolds), CASING, "trim", CASING),
        *(Part(along(a, bowl, 0, 0, axis), CASING, "pump", CASING) for a in ("x", "-x")),
        Part(merge([*(along(a, air, 0, 0, axis) for a in ("x", "-x")), *centre]), CASING, "steel", CASING),
        Part(muffler, CASING, "rubber", CASING),
        Part(merge(feet), "pump base", "rubber"),
    ]
    if rng.random() < 0.6:
        parts += [
            Part(along(a, merge([band, lug]), 0, 0, axis), "clamp", "clamp", CASING, "Connection assembly")
            for a in ("x", "-x")
        ]
    else:
        studs = around(rod((0, 0, -gap - 0.1 * r), (0, 0, gap + 0.1 * r), 0.03 * r, 6), 8, 0.99 * r)
        rims = [along(a, cylinder(1.06 * r, gap - 0.05 * r, gap + 0.05 * r, n), 0, 0, axis) for a in ("x", "-x")]
        parts.append(Part(merge(rims), CASING, "pump", CASING))
        parts.append(Part(along("x", studs, 0, 0, axis), "stud", "fastener", CASING, "Connection assembly", True))
    return Model(parts, ports=tuple(ports), kind="diaphragm pump")


def _triplex(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A triplex plunger pump (API 674): crankcase, crosshead frame open above the plungers, fluid end, belt drive."""
    out = smaller(dn, 2)
    s = 0.09 + 1.6 * PIPES[dn].radius
    seat = float(rng.uniform(0.08, 0.16))
    pitch = 0.62 * s
    wide, axis = 2.4 * s, seat + 0.9 * s
    case = moved(
        extrude(
            np.array([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.3], [0.5, 0.85], [-0.6, 0.85], [-0.9, 0.5]]) * s,
            -wide / 2,
            wide / 2,
        ),
        at(0, 0, axis) @ spun("x", np.pi / 2),
    )
    cover = box((0.06 * s, 0.7 * wide, 1.0 * s), (0.92 * s, 0, axis - 0.3 * s))
    frame = [box((0.9 * s, 0.12 * s, 1.1 * s), (-1.35 * s, y * 0.5 * wide, axis - 0.35 * s)) for y in (-0.94, 0.94)]
    frame.append(box((0.9 * s, wide, 0.1 * s), (-1.35 * s, 0, axis - 0.85 * s)))
    fluid = box((0.8 * s, 0.95 * wide, 1.3 * s), (-2.2 * s, 0, axis - 0.1 * s))
    rods = [
        along(
            "x",
            merge([cylinder(0.13 * s, 0, 0.95 * s, 12), cylinder(0.22 * s, 0.0, 0.25 * s, 12)]),
            -1.83 * s,
            k * pitch,
            axis,
        )
        for k in (-1, 0, 1)
    ]
    covers = [
        moved(
            merge([hexagon(0.4 * s, 0, 0.16 * s), cylinder(0.24 * s, -0.02, 0.06 * s, 16)]),
            at(-2.2 * s, k * pitch, axis + 0.55 * s),
        )
        for k in (-1, 0, 1)
    ]
    caps = [along("-x", hexagon(0.4 * s, -0.02, 0.14 * s), -2.6 * s, k * pitch, axis) for k in (-1, 0, 1)]
    reach = 0.48 * wide + dead_room(dn) + 0.03
    one, first = mouth(dn, style, (-2.2 * s, -reach, axis - 0.4 * s), (0, -1, 0), dead_room(dn) + 0.06)
    two, second = mouth(out, style, (-2.2 * s, reach, axis + 0.3 * s), (0, 1, 0), reach - 0.4 * wide)
    damper = [
        moved(ball(0.4 * s, style.round(0.4 * s), 1.2), at(-2.2 * s, 0, axis + 1.2 * s)),
        cylinder(0.14 * s, 0, 0.4 * s, 12),
    ]
    damper[1] = moved(damper[1], at(-2.2 * s, 0, axis + 0.5 * s))
    sheave, n = 0.75 * s, style.round(s)
    y = wide / 2 + 0.2 * s
    m = 0.75 * s
    mx = 2.6 * s
    belt = [
        Part(
            along(
                "y",
                merge([ring(0.3 * s, sheave, 0, 0.25 * s, n), cylinder(0.31 * s, 0.05 * s, 0.2 * s, n)]),
                0.1 * s,
                y,
                axis,
            ),
            "shaft",
            "trim",
            CASING,
        )
    ]
    hood = rounded_rectangle(mx + 2.0 * s, 1.9 * s, 0.9 * s, 4)
    belt.append(
        Part(
            moved(extrude(hood, y - 0.03 * s, y + 0.35 * s), at(mx / 2, 0, axis) @ spun("x", -np.pi / 2)),
            "coupling guard",
            "safety",
        )
    )
    length = 2.6 * m
    drive = placed(
        motor(m, length, style, rng, axis - seat),
        at(mx, y - 0.05 * s, axis) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2),
    )
    parts = [
        Part(merge([fluid, one, two]), CASING, "trim", CASING),
        Part(merge([case, cover, *frame]), CASING, "pump", CASING),
        Part(merge(rods), "shaft", "trim", CASING),
        Part(merge([*covers, *caps]), CASING, "fastener", CASING),
        *([Part(merge(damper), CASING, "handle", CASING)] if rng.random() < 0.6 else []),
        *(
            belt[1:]
            if rng.random() < 0.7
            else [belt[0], Part(along("y", cylinder(0.3 * s, 0, 0.25 * s, n), mx, y, axis), "shaft", "trim", CASING)]
        ),
        Part(
            along("y", cylinder(0.16 * s, wide / 2 - 0.02, y + 0.1 * s, 12), 0.1 * s, 0, axis), "shaft", "trim", CASING
        ),
        *drive,
    ]
    parts += base(
        pick(rng, "grid", "beams", "plinth", "rim"), -1.9 * s, mx + 1.2 * m, 1.6 * wide, seat, [-1.3 * s, 0.0, mx], rng
    )
    return Model(parts, ports=(first, second), kind="plunger pump")


DISPLACING: tuple[Family, ...] = tuple(
    Family(f"pump/{name}", "floor", PUMP, "pump", build, sizes)
    for name, build, sizes in (
        ("progressive cavity", _cavity, (40, 50, 65, 80, 100)),
        ("rotary lobe", _lobe, (40, 50, 65, 80, 100)),
        ("peristaltic", _hose_pump, (20, 25, 32, 40, 50, 65)),
        ("clamped diaphragm", _clamped_diaphragm, (15, 25, 40, 50, 80)),
        ("triplex plunger", _triplex, (40, 50, 65, 80)),
    )
)
