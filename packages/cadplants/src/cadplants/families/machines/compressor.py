"""Compressors with their drives and receivers."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import PUMP, base, dead_room, foreign, motor, mouth, train, volute
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["COMPRESSORS"]

_EQ = "Equipment"


def _piston(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A piston compressor (two cylinders in V or in line) with finned barrels, on a standing or lying tank."""
    eq, r = "compressor", float(rng.uniform(0.2, 0.3))
    n, upright = style.round(r), bool(rng.random() < 0.5)
    tall = float(rng.uniform(3.5, 5.0)) * r
    shell = merge(
        [
            cylinder(r, 0, tall, n),
            moved(dome(r, 0.4 * r, 0.0, n), at(0, 0, tall)),
            moved(dome(r, 0.4 * r, 0.0, n), spun("x", np.pi)),
        ]
    )
    if upright:
        low = 0.4 * r + 0.12
        vessel = moved(shell, at(0, 0, low))
        legs = [
            merge([box((0.06, 0.02, low + 0.15), (0, 0, (low + 0.15) / 2)), box((0.12, 0.12, 0.012), (0, 0, 0.006))])
            for _ in range(3)
        ]
        feet = merge([moved(x, spun("z", k * 2.0944) @ at(r)) for k, x in enumerate(legs)])
        z = low + tall + 0.42 * r
        prop = [box((0.05, 0.9 * r, 0.42 * r), (x * 0.6 * r, 0, z - 0.21 * r)) for x in (-1, 1)]
    else:
        low = r + 0.14
        vessel = along("x", moved(shell, at(0, 0, -tall / 2)), 0, 0, low)
        feet = merge([box((0.08, 1.2 * r, low - 0.7 * r), (x * 0.4 * tall, 0, (low - 0.7 * r) / 2)) for x in (-1, 1)])
        z = low + r + 0.05
        prop = [box((0.06, 0.5 * r, 0.2 * r + 0.05), (x * 0.6 * r, 0, z - 0.1 * r - 0.025)) for x in (-1, 1)]
    deck = box((3.0 * r, 1.5 * r, 0.02), (0.2 * r, 0, z + 0.01))
    z += 0.02
    x0, c = -0.6 * r, 0.5 * r
    crank = along(
        "y", extrude(rounded_rectangle(1.0 * c * 2, 1.5 * c, 0.5 * c, 4), -0.55 * c, 0.55 * c), x0, 0, z + 0.75 * c
    )
    barrel = merge(
        [
            cylinder(0.45 * c, 0, 1.6 * c, 16),
            *(
                extrude(rounded_rectangle(1.3 * c, 1.2 * c, 0.2 * c, 2), q * c, (q + 0.07) * c)
                for q in (0.7, 0.9, 1.1, 1.3)
            ),
            extrude(rounded_rectangle(1.2 * c, 1.1 * c, 0.1 * c, 2), 1.5 * c, 1.95 * c),
        ]
    )
    vee = bool(rng.random() < 0.6)
    spots = (
        [at(x0, 0, z + 0.8 * c) @ spun("y", t) for t in (-0.6, 0.6)]
        if vee
        else [at(x0 + s * 0.65 * c, 0, z + 0.8 * c) for s in (-1, 1)]
    )
    filters = [
        moved(
            cylinder(0.35 * c, -0.6 * c, -0.2 * c, 14),
            p @ at(0, -0.6 * c, 1.75 * c) @ spun("x", np.pi / 2) @ at(0, 0, 0.3 * c),
        )
        for p in spots
    ]
    pipe = [
        (x0 + 0.3 * c, 0.4 * c, z + 2.4 * c),
        (x0 + 1.8 * c, 0.5 * c, z + 2.4 * c),
        (x0 + 2.2 * c, 0.5 * c, z + 1.2 * c),
        (x0 + 2.2 * c, 0.5 * c, z - 0.01),
    ]
    fly, my = 0.85 * c, 0.75 * c
    wheel = along(
        "y",
        merge(
            [
                ring(0.75 * fly, fly, 0, 0.3 * c, n),
                cylinder(0.25 * fly, 0, 0.3 * c, 12),
                around(box((0.6 * fly, 0.2 * fly, 0.1 * c), (0.5 * fly, 0, 0.15 * c)), 5),
            ]
        ),
        x0,
        -my - 0.3 * c,
        z + 0.95 * c,
    )
    m = 0.34 * r
    mx, mz = 0.95 * r, z + 1.2 * m
    reach = float(np.hypot(mx - x0, mz - z - 0.95 * c))
    tilt = float(np.arctan2(mz - z - 0.95 * c, mx - x0))
    hood = extrude(rounded_rectangle(reach + 2.4 * c, 2.1 * c, 1.0 * c, 4), -0.03 * c, 0.4 * c)
    hood = moved(
        hood, at((x0 + mx) / 2, -my - 0.02 * c, (mz + z + 0.95 * c) / 2) @ spun("x", np.pi / 2) @ spun("z", tilt)
    )
    drive = foreign(
        placed(
            motor(m, 1.15 * r, style, rng, 1.2 * m),
            at(mx, -my + 0.02 * c, mz) @ spun("x", -np.pi / 2) @ spun("z", -np.pi / 2),
        )
    )
    parts = [
        Part(vessel, eq, "tank", eq),
        Part(merge([feet, *prop, deck]), eq, "steel", eq),
        Part(merge([crank, *(moved(barrel, p) for p in spots), *filters]), eq, "pump", eq),
        Part(rope(pipe, 0.05 * c, 8), "pipe", "pipe", eq, "Pipe assembly"),
        Part(along("y", cylinder(0.1 * c, -my - 0.35 * c, 0, 10), x0, 0, z + 0.95 * c), "shaft", "trim", eq, PUMP),
        *drive,
    ]
    parts.append(
        Part(hood, "coupling guard", "safety", "", PUMP) if rng.random() < 0.7 else Part(wheel, eq, "trim", eq)
    )
    switch = box((0.1, 0.08, 0.12), (mx - 1.6 * m, 0.6 * r, z + 0.06))
    parts.append(Part(switch, "junction box", "rubber", "", "Electrical and safety"))
    return Model(parts, kind="piston compressor")


def _cabinet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A screw compressor in its cabinet: doors with handles, louvres, exhaust hood, panel, skid."""
    eq = "compressor"
    w, d, h = (float(rng.uniform(*span)) for span in ((0.8, 2.6), (0.7, 1.3), (0.9, 1.9)))
    low = 0.1
    case = moved(extrude(rounded_rectangle(w, d, float(rng.choice([0.0, 0.04, 0.1])), 3), low, low + h), at())
    skid = [box((w, 0.12, low), (0, s * (d / 2 - 0.06), low / 2)) for s in (-1, 1)]
    count = int(np.clip(round(w / 0.6), 1, 4))
    doors, slats, handles = [], [], []
    step = w / count
    for k in range(count):
        x = -w / 2 + (k + 0.5) * step
        doors.append(box((0.94 * step, 0.016, 0.88 * h), (x, -d / 2 - 0.008, low + 0.5 * h)))
        handles.append(box((0.03, 0.03, 0.12), (x + 0.38 * step, -d / 2 - 0.03, low + 0.55 * h)))
        if k % 2 or count == 1:
            zs = np.linspace(0.12, 0.4, 8) if rng.random() < 0.5 else np.linspace(0.6, 0.85, 6)
            blade = moved(box((0.7 * step, 0.03, 0.004)), spun("x", 0.6))
            slats += [moved(blade, at(x, -d / 2 - 0.022, low + q * h)) for q in zs]
    roof = pick(rng, "hood", "fan", "duct", "plain")
    top = low + h
    extra = []
    if roof == "hood":
        extra = [
            box((0.5 * w, 0.6 * d, 0.15), (0.15 * w, 0, top + 0.075)),
            box((0.55 * w, 0.65 * d, 0.02), (0.15 * w, 0, top + 0.16)),
        ]
    elif roof == "fan":
        r = 0.35 * min(w, d)
        extra = [moved(ring(0.94 * r, r, 0, 0.08, style.round(r)), at(0.1 * w, 0, top))]
        extra += [
            moved(ring(k * r - 0.005, k * r, 0.06, 0.066, style.round(r)), at(0.1 * w, 0, top))
            for k in (0.25, 0.5, 0.75)
        ]
        extra += [
            box((1.9 * r, 0.012, 0.01), (0.1 * w, 0, top + 0.063)),
            box((0.012, 1.9 * r, 0.01), (0.1 * w, 0, top + 0.063)),
            moved(cylinder(0.2 * r, 0, 0.06, 12), at(0.1 * w)),
        ]
        extra[-1] = moved(cylinder(0.2 * r, top, top + 0.06, 12), at(0.1 * w))
    elif roof == "duct":
        extra = [
            box((0.4 * w, 0.5 * d, 0.8), (0.1 * w, 0, top + 0.4)),
            box((0.46 * w, 0.56 * d, 0.03), (0.1 * w, 0, top + 0.8)),
        ]
    panel = merge(
        [
            box((0.26, 0.03, 0.18), (-0.5 * w + 0.4 * step, -d / 2 - 0.031, low + 0.75 * h)),
            box((0.14, 0.006, 0.09), (-0.5 * w + 0.4 * step, -d / 2 - 0.048, low + 0.76 * h)),
        ]
    )
    parts = [
        Part(merge([case, *extra]), eq, "motor", eq),
        Part(merge(skid), eq, "steel", eq),
        Part(merge(doors), eq, "electrical", eq),
        Part(merge([*handles, *slats]), eq, "rubber", eq),
        Part(panel, "control panel", "rubber", "", "Electrical and safety"),
    ]
    reach = dead_room(50) + 0.06
    stub, port = mouth(50, style, (w / 2 + reach, 0.2 * d, low + 0.6 * h), (1, 0, 0), reach + 0.01)
    parts[0] = Part(merge([case, *extra, stub]), eq, "motor", eq)
    return Model(parts, ports=(port,), kind="screw compressor")


def _pots(eq: str, r: float, n: int, parts: list[Part], rng: np.random.Generator) -> Model:
    """Hermetic pots in a row on rubber feet and rails."""
    for k in range(int(rng.integers(1, 4))):
        x, h = 3.2 * r * k, float(rng.uniform(2.4, 4.2)) * r
        pot = [
            (0.75 * r, 0.09),
            (r, 0.09 + 0.3 * r),
            (r, 0.09 + 0.7 * h),
            (1.05 * r, 0.09 + 0.7 * h),
            (1.05 * r, 0.09 + 0.74 * h),
            (r, 0.09 + 0.74 * h),
            (0.95 * r, 0.09 + 0.85 * h),
            (0.6 * r, 0.09 + h),
        ]
        base_ = [
            box((2.4 * r, 2.4 * r, 0.008), (x, 0, 0.0865)),
            *(moved(cylinder(0.02, 0.03, 0.08, 10), at(x + sx * r, sy * r)) for sx in (-1, 1) for sy in (-1, 1)),
        ]
        stubs = [
            rope(
                [(x + 0.9 * r, 0, 0.09 + 0.4 * h), (x + 1.5 * r, 0, 0.09 + 0.4 * h), (x + 1.5 * r, 0, 0.2 + h)],
                0.018,
                8,
            ),
            rope([(x, 0, 0.08 + h), (x, 0, 0.15 + h), (x, 0.9 * r, 0.2 + h)], 0.011, 8),
        ]
        lid = box((0.14 * h, 0.6 * r, 0.4 * r), (x, -1.05 * r, 0.09 + 0.5 * h))
        parts += [
            Part(moved(turned(pot, n), at(x)), eq, "rubber", eq),
            Part(merge(base_), eq, "steel", eq),
            Part(merge(stubs), eq, "trim", eq),
            Part(lid, "terminal box", "electrical", eq, PUMP),
        ]
    rails = [box((3.2 * r * k + 3 * r, 0.04, 0.03), (1.6 * r * k, s * r, 0.015)) for s in (-1, 1)]
    return Model(
        [*parts, Part(merge(rails), "skid frame", "steel", "", "Structural element")], kind="hermetic compressor"
    )


def _semi_hermetic(eq: str, r: float, n: int, parts: list[Part], rng: np.random.Generator) -> Model:
    """A semi-hermetic block with banks of heads and its stop valves."""
    s, low = 2.0 * r, 0.08
    axis = low + 0.8 * s
    barrel = along(
        "x",
        turned(
            [
                (0.7 * s, -1.6 * s),
                (0.75 * s, -1.5 * s),
                (0.7 * s, -1.4 * s),
                (0.7 * s, 0.2 * s),
                (0.85 * s, 0.25 * s),
                (0.85 * s, 1.3 * s),
                (0.6 * s, 1.4 * s),
            ],
            n,
        ),
        0,
        0,
        axis,
    )
    banks = []
    for t in (-0.7, 0.0, 0.7)[: int(rng.integers(2, 4))]:
        head = merge(
            [
                box((0.9 * s, 0.6 * s, 0.5 * s), (0.75 * s, 0, 0.95 * s)),
                *(
                    box((0.95 * s, 0.03 * s, 0.14 * s), (0.75 * s, q * s, 1.25 * s))
                    for q in (-0.22, -0.11, 0, 0.11, 0.22)
                ),
            ]
        )
        banks.append(moved(head, at(0, 0, axis) @ spun("x", t)))
    feet = [box((0.2 * s, 1.3 * s, 0.35 * s), (x * s, 0, low + 0.1 * s)) for x in (-1.1, 0.9)]
    lid = merge(
        [
            box((0.7 * s, 0.4 * s, 0.6 * s), (-0.8 * s, -0.7 * s, axis)),
            box((0.75 * s, 0.04 * s, 0.65 * s), (-0.8 * s, -0.92 * s, axis)),
        ]
    )
    valves = [
        moved(
            merge([cylinder(0.12 * s, 0, 0.35 * s, 12), hexagon(0.3 * s, 0.25 * s, 0.5 * s)]),
            at(x * s, 0, axis + z * s),
        )
        for x, z in ((-1.0, 0.65), (1.25, 0.75))
    ]
    rails = [box((3.4 * s, 0.1, low), (-0.1 * s, y * 0.5 * s, low / 2)) for y in (-1, 1)]
    parts = [
        Part(merge([barrel, *banks, *feet]), eq, "pump", eq),
        Part(merge(valves), eq, "trim", eq),
        Part(lid, "terminal box", "electrical", eq, PUMP),
    ]
    return Model(
        [*parts, Part(merge(rails), "skid frame", "steel", "", "Structural element")], kind="semi-hermetic compressor"
    )


def _hermetic(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Refrigerant compressors: hermetic pots (scroll or piston), or a semi-hermetic block with finned heads."""
    eq = "compressor"
    parts: list[Part] = []
    r = float(rng.uniform(0.07, 0.13))
    n = style.round(r)
    if rng.random() < 0.6:
        return _pots(eq, r, n, parts, rng)
    return _semi_hermetic(eq, r, n, parts, rng)


def _turbo(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A centrifugal compressor (API 617): one volute or two on an integral gear case, axial inlets, motor on a skid."""
    eq, r = "compressor", 0.12 + 1.8 * PIPES[dn].radius
    seat = float(rng.uniform(0.15, 0.3))
    axis = seat + 1.65 * r
    case = [
        box((1.3 * r, 2.6 * r, axis - seat + 0.55 * r), (0, 0, (seat + axis + 0.55 * r) / 2)),
        box((1.4 * r, 2.8 * r, 0.12 * r), (0, 0, axis)),
    ]
    case += [
        moved(hexagon(0.12 * r, 0.05 * r, 0.13 * r), at(x * 0.66 * r, y * 1.34 * r, axis))
        for x in (-1, 1)
        for y in (-1, -0.35, 0.35, 1)
    ]
    volutes, ports = [], []
    for k in range(int(rng.integers(1, 3))):
        y, sign = (0.95 * r, 1) if k else (0.0, -1)
        centre = sign * r
        house = along("x", volute((0.8 if k else 1.0) * r, 0.36 * r, style, 0.35), centre, y, axis)
        face = centre + sign * (0.5 * r + dead_room(dn) + 0.05)
        if k == 0:
            inlet, port = mouth(dn, style, (face, y, axis), (sign, 0, 0), abs(face - centre))
            volutes.append(inlet)
            ports.append(port)
        up = axis + 1.35 * r + dead_room(dn) + 0.03
        if k == 0:
            out, port = mouth(dn, style, (centre, y, up), (0, 0, 1), up - axis - 0.5 * r)
            volutes.append(out)
            ports.append(port)
        volutes.append(house)
    parts = [Part(merge([*volutes]), eq, "pump", eq), Part(merge(case), eq, "motor", eq)]
    y_drive = -0.35 * r if len(volutes) > 3 else 0.0
    start = 1.0 * r
    parts.append(Part(along("x", cylinder(0.14 * r, 0.6 * r, start, 12), 0, y_drive, axis), "shaft", "trim", eq, PUMP))
    more, far, seats = train(
        start, axis, seat, min(1.1 * r, 0.9 * (axis - seat)), style, rng, pick(rng, "cast", "cooled", "ex", "drip")
    )
    more = placed(foreign(more), at(0, y_drive))
    bed = base(pick(rng, "beams", "grid", "rim"), -1.2 * r, far, 3.6 * r, seat, [-0.3 * r, 0.3 * r, *seats], rng)
    frame = [Part(x.solid, "skid frame", "steel", "", "Structural element") for x in bed]
    return Model([*parts, *more, *frame], ports=tuple(ports), kind="centrifugal compressor")


COMPRESSORS: tuple[Family, ...] = (
    Family("compressor/piston V", "floor", _EQ, "compressor", _piston, (15,)),
    Family("compressor/louvred cabinet", "floor", _EQ, "compressor", _cabinet, (15,)),
    Family("compressor/hermetic", "floor", _EQ, "compressor", _hermetic, (15,)),
    Family("compressor/centrifugal", "floor", _EQ, "compressor", _turbo, (80, 100, 125, 150)),
)
