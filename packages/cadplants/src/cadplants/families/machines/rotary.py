"""Centrifugal pumps in further constructions, with their drives."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import (
    BASES,
    CASING,
    GUARDS,
    LYING,
    PUMP,
    anchors,
    base,
    coupling,
    dead_room,
    guard,
    motor,
    mouth,
    volute,
)
from cadplants.families.valves.valve import bolt_circle, flanged_body
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import FLANGES, PIPES, smaller
from cadplants.transforms import at, spun

__all__ = ["ROTARY", "train"]

_BOLTS = "Connection assembly"


def train(
    x: float, axis: float, seat: float, r: float, style: ModelingStyle, rng: np.random.Generator, kind: str = ""
) -> tuple[list[Part], float, list[float]]:
    """Coupling, guard and motor behind a machine's shaft that ends at ``x``; where the motor ends; seats along x."""
    gap = float(rng.uniform(0.7, 1.4)) * r
    far, length = x + gap, float(rng.uniform(2.5, 3.6)) * r
    parts = [coupling(0.42 * r, x + 0.02 * gap, far - 0.05 * gap, axis, style)]
    if rng.random() < 0.85:
        parts.append(guard(pick(rng, *GUARDS), 0.56 * r, x + 0.04 * gap, far - 0.04 * gap, axis, seat, style))
    parts += placed(motor(r, length, style, rng, axis - seat, kind), at(far, 0, axis) @ LYING)
    return parts, far + length, [x + gap / 2, far + 0.2 * length, far + 0.66 * length]


def _split_case(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A double-suction pump with axially split casing (API 610 BB1): mouths to both sides, a bearing at each end."""
    out = smaller(dn)
    s = 0.07 + 1.5 * PIPES[dn].radius
    r, half, n = s * float(rng.uniform(1.0, 1.25)), 0.9 * s, style.round(s)
    seat = float(rng.uniform(0.1, 0.22))
    axis = seat + 1.35 * r
    chambers = along(
        "x",
        turned(
            [
                (0.4 * r, -1.35 * half), (0.8 * r, -1.1 * half), (0.8 * r, -0.45 * half), (r, -0.35 * half),
                (r, 0.35 * half), (0.8 * r, 0.45 * half), (0.8 * r, 1.1 * half), (0.4 * r, 1.35 * half),
            ],
            n,
        ),
        0, 0, axis,
    )  # fmt: skip
    split = moved(extrude(rounded_rectangle(2.7 * half, 2.25 * r, 0.5 * r, 4), -0.09 * r, 0.09 * r), at(0, 0, axis))
    nuts = [
        moved(hexagon(0.13 * r, 0.09 * r, 0.2 * r), at(x * half, y * 1.02 * r, axis))
        for x in (-0.9, -0.3, 0.3, 0.9)
        for y in (-1, 1)
    ]
    drop = axis - float(rng.choice([0.0, 0.25])) * r
    reach = r + dead_room(dn) + 0.06
    suction, first = mouth(dn, style, (0, -reach, drop), (0, -1, 0), reach - 0.35 * r)
    discharge, second = mouth(out, style, (0, reach, drop), (0, 1, 0), reach - 0.35 * r)
    feet = [
        box((0.4 * half, 1.5 * r, axis - seat - 0.5 * r), (s_ * 0.7 * half, 0, (seat + axis - 0.5 * r) / 2))
        for s_ in (-1, 1)
    ]
    house = turned(
        [
            (0.3 * r, 1.3 * half),
            (0.3 * r, 1.7 * half),
            (0.45 * r, 1.75 * half),
            (0.45 * r, 2.2 * half),
            (0.25 * r, 2.25 * half),
        ],
        n,
    )
    arms = [box((0.5 * half, 0.5 * r, 0.2 * r), (x * 1.5 * half, 0, axis - 0.35 * r)) for x in (-1, 1)]
    bearings = merge([along("x", house, 0, 0, axis), along("-x", house, 0, 0, axis), *arms])
    end = 2.5 * half
    parts = [
        Part(merge([chambers, split, suction, discharge, *feet]), CASING, "pump", CASING),
        Part(merge(nuts), "nut", "fastener", CASING, _BOLTS, True),
        Part(bearings, CASING, "pump", CASING),
        Part(along("x", cylinder(0.12 * r, -2.28 * half, end, 12), 0, 0, axis), "shaft", "trim", CASING),
    ]
    m = min(0.85 * (axis - seat), float(rng.uniform(0.8, 1.2)) * r)
    more, far, seats = train(end, axis, seat, m, style, rng, "cooled" if dn > 150 and rng.random() < 0.5 else "")
    wide = 2.5 * max(m, 0.8 * r)
    bed = base(pick(rng, *BASES), -2.0 * half, far, wide, seat, [-0.7 * half, 0.7 * half, *seats], rng)
    bolts = anchors([(x, y * 0.46 * wide) for x in (-1.7 * half, far - 0.1) for y in (-1, 1)], seat)
    return Model([*parts, *more, *bed, *bolts], ports=(first, second), kind="double-suction pump")


def _back_pull_out(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A standard pump (EN ISO 2858): spiral casing on feet, bearing bracket with oiler and foot, spacer, base frame."""
    out = smaller(dn, int(rng.integers(1, 3)))
    s = 0.06 + 1.3 * PIPES[dn].radius
    r, half, n = s * float(rng.uniform(1.0, 1.5)), 0.5 * s + 0.3 * PIPES[out].outer, style.round(s)
    seat, growth = float(rng.uniform(0.08, 0.2)), float(rng.uniform(0.2, 0.4))
    axis = seat + (1.08 + growth) * r + 0.02
    turn = float(rng.choice([0.0, np.pi]))
    house = along("x", moved(volute(r, half, style, growth), spun("z", turn)), 0, 0, axis)
    side = 0.0 if rng.random() < 0.5 else (0.75 * r if turn else -0.75 * r)
    rise = axis + (1 + growth) * r + dead_room(out) + 0.03
    front = half + dead_room(dn) + 0.03
    suction, first = mouth(dn, style, (-front, 0, axis), (-1, 0, 0), front - 0.4 * half)
    top, second = mouth(out, style, (0, side, rise), (0, 0, 1), rise - axis - 0.5 * r)
    cover = along(
        "x",
        merge(
            [
                cylinder(1.02 * r, 0.8 * half, 0.95 * half, n),
                bolt_circle(8, 0.92 * r, 0.03 * r + 0.004, 0.8 * half, 0.95 * half),
            ]
        ),
        0,
        0,
        axis,
    )
    feet = [
        box((0.7 * half, 0.3 * r, axis - seat - 0.3 * r), (0, y * 0.75 * r, (seat + axis - 0.3 * r) / 2))
        for y in (-1, 1)
    ]
    back, long = 0.95 * half, float(rng.uniform(1.6, 2.4)) * r
    lantern = turned(
        [(0.8 * r, back), (0.55 * r, back + 0.15 * long), (0.32 * r, back + 0.3 * long), (0.32 * r, back + 0.4 * long)],
        n,
    )
    bearing = turned([(0.42 * r, back + 0.4 * long), (0.42 * r, back + 0.9 * long), (0.3 * r, back + 0.95 * long)], n)
    ribs = (
        []
        if rng.random() < 0.5
        else [around(box((0.95 * r, 0.03 * r, 0.4 * long), (0.2 * r, 0, back + 0.7 * long)), 6)]
    )
    stay = box((0.08 * long, 0.5 * r, axis - seat - 0.3 * r), (back + 0.85 * long, 0, (seat + axis - 0.3 * r) / 2))
    oiler = moved(
        merge(
            [
                cylinder(0.03 * r + 0.004, 0, 0.3 * r, 8),
                turned([(0.08 * r, 0.3 * r), (0.1 * r, 0.5 * r), (0.05 * r, 0.55 * r)], 12),
            ]
        ),
        at(back + 0.65 * long, 0, axis + 0.4 * r),
    )
    parts = [
        Part(merge([house, suction, top, cover, *feet]), CASING, "pump", CASING),
        Part(merge([along("x", merge([lantern, bearing, *ribs]), 0, 0, axis), stay, oiler]), CASING, "pump", CASING),
        Part(
            along("x", cylinder(0.12 * r, back + 0.1 * long, back + 1.15 * long, 12), 0, 0, axis),
            "shaft",
            "trim",
            CASING,
        ),
    ]
    m = min(0.85 * (axis - seat), float(rng.uniform(0.8, 1.3)) * r)
    more, far, seats = train(back + 1.12 * long, axis, seat, m, style, rng)
    wide = 2.6 * max(m, 0.8 * r)
    bed = base(pick(rng, "grid", "grid", *BASES), -0.6 * half, far, wide, seat, [0.0, back + 0.85 * long, *seats], rng)
    return Model([*parts, *more, *bed], ports=(first, second), kind="centrifugal pump")


def _block(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A close-coupled block pump (EN 733): motor on the casing's lantern, feet below."""
    out = smaller(dn)
    s = 0.05 + 1.2 * PIPES[dn].radius
    r, half, n = s * float(rng.uniform(1.0, 1.3)), 0.35 * s + 0.35 * PIPES[out].outer, style.round(s)
    axis = float(rng.uniform(1.35, 1.6)) * r + 0.02
    pressed = rng.random() < 0.4
    if pressed:
        shape = [
            (0.75 * r, -half),
            (0.95 * r, -0.85 * half),
            (r, -0.6 * half),
            (r, 0.75 * half),
            (1.12 * r, 0.76 * half),
            (1.12 * r, half),
        ]
        house = along("x", turned(shape, n), 0, 0, axis)
    else:
        house = along("x", volute(0.95 * r, half, style, 0.3), 0, 0, axis)
    front, rise = half + dead_room(dn) + 0.02, axis + 1.3 * r + dead_room(out)
    suction, first = mouth(dn, style, (-front, 0, axis), (-1, 0, 0), front - 0.3 * half)
    top, second = mouth(out, style, (0, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
    m, back = float(rng.uniform(0.75, 1.05)) * r, half + 0.5 * r
    lantern = [cylinder(0.95 * r, 0.8 * half, half + 0.04 * r, n), cylinder(1.0 * m, back - 0.08 * r, back, n)]
    posts = around(box((0.22 * r, 0.4 * r, 0.5 * r), (0, 0, half + 0.22 * r)), 4, 0.66 * min(r, m), np.pi / 4)
    parts = [
        Part(merge([house, suction, top]), CASING, "pump", CASING),
        Part(along("x", merge([*lantern, posts]), 0, 0, axis), CASING, "pump", CASING),
        Part(along("x", cylinder(0.14 * r, half - 0.05, back, 12), 0, 0, axis), "shaft", "trim", CASING),
    ]
    length = float(rng.uniform(2.3, 3.2)) * m
    parts += placed(motor(m, length, style, rng, 0.0), at(back, 0, axis) @ LYING)
    if rng.random() < 0.5:
        leg = box((0.3 * half + 0.03, 1.2 * r, axis - 0.75 * r), (0, 0, (axis - 0.75 * r) / 2))
        parts.append(
            Part(merge([leg, box((0.8 * half + 0.05, 1.7 * r, 0.015), (0, 0, 0.0075))]), CASING, "pump", CASING)
        )
        foot = box((0.12 * length, 1.3 * m, axis - 0.75 * m), (back + 0.6 * length, 0, (axis - 0.75 * m) / 2))
        parts.append(Part(foot, "motor", "motor", "motor"))
    else:
        bow = [box((0.05, 0.05, axis - 0.6 * r), (back - 0.04 * r, y * 0.7 * m, (axis - 0.6 * r) / 2)) for y in (-1, 1)]
        parts.append(
            Part(merge([*bow, box((0.3 * r, 1.9 * m, 0.02), (back - 0.04 * r, 0, 0.01))]), "pump base", "steel")
        )
    return Model(parts, ports=(first, second), kind="block pump")


def _vertical_inline(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vertical in-line pump (API 610 OH3/OH4): volute in the line, lantern with windows, coupling, motor on top."""
    radius = PIPES[dn].radius
    r = float(rng.uniform(1.8, 2.4)) * radius + 0.05
    length = round(2 * (0.8 * r + dead_room(dn) + 0.04), 6)
    n, x, neck = style.round(r), length / 2, 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
    house = moved(volute(0.85 * r, radius + 0.02, style, 0.3), at(x))
    low = 1.05 * radius + 0.02
    lid = merge(
        [
            cylinder(0.9 * r, low - 0.02, low + 0.02, n),
            bolt_circle(8, 0.78 * r, 0.04 * radius + 0.006, low - 0.02, low + 0.02),
        ]
    )
    parts = [Part(merge([body, house]), CASING, "pump", CASING), Part(moved(lid, at(x)), CASING, "pump", CASING)]
    m, tall = float(rng.uniform(0.75, 1.1)) * r, float(rng.uniform(1.0, 1.9)) * r
    z0, z1 = low + 0.02, low + 0.02 + tall
    if rng.random() < 0.5:
        plates = [box((0.06 * r, 1.1 * r, tall), (s * 0.62 * r, 0, (z0 + z1) / 2)) for s in (-1, 1)]
        lantern = merge([*plates, cylinder(1.05 * m, z1 - 0.02, z1, n), cylinder(0.75 * r, z0, z0 + 0.02, n)])
    else:
        posts = around(cylinder(0.08 * r, z0, z1, 8), 4, 0.66 * r, np.pi / 4)
        lantern = merge([posts, cylinder(1.05 * m, z1 - 0.02, z1, n), cylinder(0.8 * r, z0, z0 + 0.015, n)])
    parts.append(Part(moved(lantern, at(x)), CASING, "pump", CASING))
    hub = [
        (0.25 * r, z0 + 0.3 * tall),
        (0.25 * r, z0 + 0.5 * tall),
        (0.2 * r, z0 + 0.52 * tall),
        (0.25 * r, z0 + 0.54 * tall),
        (0.25 * r, z0 + 0.75 * tall),
    ]
    parts.append(
        Part(moved(merge([cylinder(0.1 * r, z0 - 0.01, z1, 10), turned(hub, n)]), at(x)), "shaft", "trim", CASING)
    )
    if rng.random() < 0.7:
        shell = ring(0.4 * r, 0.42 * r, z0 + 0.015, z1 - 0.02, n)
        slots = around(box((0.02 * r, 0.1 * r, 0.6 * tall), (0.42 * r, 0, (z0 + z1) / 2)), 8)
        parts.append(Part(moved(merge([shell, slots]), at(x)), "coupling guard", "safety"))
    parts += placed(
        motor(m, float(rng.uniform(2.4, 3.4)) * m, style, rng),
        at(x, 0, z1) @ spun("z", float(rng.integers(4)) * np.pi / 2),
    )
    return Model(parts, length, kind="in-line pump")


def _barrel(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A barrel pump (API 610 BB5): a thick cylinder hung at its centreline, a studded end cover, both mouths up."""
    out = smaller(dn)
    r = 0.1 + 1.6 * PIPES[dn].radius
    half, n, seat = (
        float(rng.uniform(1.8, 2.8)) * r + FLANGES[dn].outer * 0.6,
        style.round(r),
        float(rng.uniform(0.15, 0.3)),
    )
    axis = seat + 1.5 * r
    cover = 1.3 * r
    barrel = turned([(0.95 * r, -half), (r, -0.95 * half), (r, 0.8 * half), (cover, 0.82 * half), (cover, half)], n)
    lid = turned(
        [(cover, half + 0.002), (cover, half + 0.35 * r), (0.7 * r, half + 0.36 * r), (0.7 * r, half + 0.5 * r)], n
    )
    studs = bolt_circle(int(rng.choice([10, 12, 16])), 1.14 * r, 0.13 * r, 0.82 * half, half + 0.35 * r)
    rise = axis + r + dead_room(dn) + 0.03
    first_face, first = mouth(dn, style, (-0.55 * half, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
    second_face, second = mouth(out, style, (0.45 * half, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
    ears = [box((0.35 * half, 2.7 * r, 0.25 * r), (x * half, 0, axis - 0.12 * r)) for x in (-0.6, 0.5)]
    stands = [
        box((0.3 * half, 0.35 * r, axis - seat - 0.24 * r), (x * half, y * 1.15 * r, (seat + axis - 0.24 * r) / 2))
        for x in (-0.6, 0.5)
        for y in (-1, 1)
    ]
    house = turned([(0.45 * r, 0), (0.45 * r, 0.3 * r), (0.6 * r, 0.32 * r), (0.6 * r, 1.0 * r), (0.3 * r, 1.1 * r)], n)
    ends = merge([along("x", house, half + 0.48 * r, 0, axis), along("-x", house, -half + 0.02, 0, axis)])
    start = half + 1.9 * r
    parts = [
        Part(merge([along("x", barrel, 0, 0, axis), first_face, second_face, *ears]), CASING, "pump", CASING),
        Part(along("x", lid, 0, 0, axis), CASING, "pump", CASING),
        Part(along("x", studs, 0, 0, axis), "stud", "fastener", CASING, _BOLTS, True),
        Part(ends, CASING, "pump", CASING),
        Part(along("x", cylinder(0.16 * r, half + 1.4 * r, start, 12), 0, 0, axis), "shaft", "trim", CASING),
        Part(merge(stands), "pump base", "steel"),
    ]
    more, far, seats = train(start, axis, seat, 0.95 * r + 0.02, style, rng, pick(rng, "cast", "cooled", "ex"))
    bed = base(
        pick(rng, "beams", "grid", "plinth", "rim"), -half, far, 3.0 * r, seat, [-0.6 * half, 0.5 * half, *seats], rng
    )
    return Model([*parts, *more, *bed], ports=(first, second), kind="barrel pump")


def _ring_section(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A ring-section multistage pump (ISO 5199): stages between two end casings under tie bolts, bearings outside."""
    out = smaller(dn)
    r = 0.06 + 1.5 * PIPES[dn].radius
    n, seat, count = style.round(r), float(rng.uniform(0.08, 0.2)), int(rng.integers(3, 9))
    axis = seat + 1.5 * r
    step, end = float(rng.uniform(0.3, 0.5)) * r, 0.55 * FLANGES[dn].outer + 0.02
    half = count * step / 2
    stages = [ring(0.3 * r, 1.02 * r, -half + k * step, -half + (k + 0.8) * step, n) for k in range(count)]
    core = cylinder(0.92 * r, -half, half, n)
    drums = []
    for sign in (-1, 1):
        drum = turned([(1.12 * r, half), (1.12 * r, half + end), (0.6 * r, half + end + 0.2 * r)], n)
        drums.append(along("x" if sign > 0 else "-x", drum, 0, 0, axis))
        drums.append(
            box((0.7 * end, 1.9 * r, axis - seat - 0.7 * r), (sign * (half + end / 2), 0, (seat + axis - 0.7 * r) / 2))
        )
    level = bool(rng.random() < 0.5)
    rise = 1.12 * r + dead_room(dn) + 0.02
    mid = half + end / 2
    one, first = (
        mouth(dn, style, (-mid, -rise, axis), (0, -1, 0), rise - 0.5 * r)
        if level
        else mouth(dn, style, (-mid, 0, axis + rise), (0, 0, 1), rise - 0.5 * r)
    )
    two, second = mouth(out, style, (mid, 0, axis + rise), (0, 0, 1), rise - 0.5 * r)
    ties = around(
        rod((0, 0, -half - end - 0.03), (0, 0, half + end + 0.03), 0.045 * r + 0.003, 8), 8, 1.07 * r, np.pi / 8
    )
    house = turned(
        [(0.3 * r, 0), (0.3 * r, 0.35 * r), (0.48 * r, 0.37 * r), (0.48 * r, 0.9 * r), (0.3 * r, 0.95 * r)], n
    )
    where = half + end + 0.18 * r
    start = where + 1.3 * r
    parts = [
        Part(merge([*drums, one, two]), CASING, "pump", CASING),
        Part(along("x", merge([core, *stages]), 0, 0, axis), CASING, "pump", CASING),
        Part(along("x", ties, 0, 0, axis), "stud", "fastener", CASING, _BOLTS, True),
        Part(merge([along("x", house, where, 0, axis), along("-x", house, -where, 0, axis)]), CASING, "pump", CASING),
        Part(along("x", cylinder(0.13 * r, where, start, 12), 0, 0, axis), "shaft", "trim", CASING),
    ]
    m = min(0.9 * (axis - seat), float(rng.uniform(1.0, 1.35)) * r)
    more, far, seats = train(start, axis, seat, m, style, rng)
    bed = base(pick(rng, *BASES), -where - 0.5 * r, far, 2.5 * m, seat, [-mid, mid, *seats], rng)
    return Model([*parts, *more, *bed], ports=(first, second), kind="multistage pump")


ROTARY: tuple[Family, ...] = tuple(
    Family(f"pump/{name}", place, PUMP, "pump", build, sizes)
    for name, place, build, sizes in (
        ("split case", "floor", _split_case, (65, 80, 100, 125, 150, 200, 250)),
        ("back pull-out", "floor", _back_pull_out, (40, 50, 65, 80, 100, 125, 150)),
        ("block", "floor", _block, (32, 40, 50, 65, 80, 100)),
        ("vertical in-line", "inline", _vertical_inline, (40, 50, 65, 80, 100, 125, 150)),
        ("barrel", "floor", _barrel, (50, 65, 80, 100, 125)),
        ("ring section", "floor", _ring_section, (40, 50, 65, 80, 100)),
    )
)
