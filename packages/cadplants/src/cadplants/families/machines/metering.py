"""Metering and hand pumps, hydraulic power packs."""

from __future__ import annotations

import numpy as np

from cadplants.families.machines.machinery import CASING, LYING, PUMP, dead_room, motor, mouth
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["SMALL"]


def _metering(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A metering pump (API 675): upright motor on a worm gear case with a stroke knob, one or two liquid heads."""
    s = float(rng.uniform(0.07, 0.14))
    n, seat = style.round(s), 0.03
    axis = seat + 1.1 * s
    case = moved(extrude(rounded_rectangle(2.0 * s, 1.7 * s, 0.3 * s, 3), seat, seat + 2.2 * s), at())
    foot = extrude(rounded_rectangle(3.0 * s, 2.2 * s, 0.2 * s, 3), 0, seat)
    knob = along(
        "-x",
        merge(
            [
                cylinder(0.35 * s, 0, 0.3 * s, n),
                cylinder(0.5 * s, 0.3 * s, 0.75 * s, n),
                around(box((0.06 * s, 0.06 * s, 0.4 * s), (0.5 * s, 0, 0.5 * s)), 8),
            ]
        ),
        -0.98 * s,
        0,
        axis,
    )
    parts = [Part(merge([case, foot]), CASING, "pump", CASING), Part(knob, CASING, "rubber", CASING)]
    ports = []
    for k in range(int(rng.integers(1, 3))):
        y = 0.0 if k == 0 else 2.4 * s
        if k:
            second = moved(extrude(rounded_rectangle(2.0 * s, 1.7 * s, 0.3 * s, 3), seat, seat + 2.0 * s), at(0, y))
            parts.append(
                Part(
                    merge([second, moved(extrude(rounded_rectangle(3.0 * s, 2.2 * s, 0.2 * s, 3), 0, seat), at(0, y))]),
                    CASING,
                    "pump",
                    CASING,
                )
            )
            parts.append(Part(along("y", cylinder(0.3 * s, 0.8 * s, 1.6 * s, 12), 0, 0, axis), "shaft", "trim", CASING))
        lantern = turned([(0.7 * s, 0), (0.6 * s, 0.1 * s), (0.6 * s, 0.8 * s), (0.8 * s, 0.9 * s)], n)
        head = turned([(0.9 * s, 0.9 * s), (0.9 * s, 1.35 * s), (0.7 * s, 1.4 * s), (0.7 * s, 1.6 * s)], n)
        bolts = around(hexagon(0.14 * s, 1.35 * s, 1.45 * s), 6, 0.78 * s)
        liquid, x = [along("x", head, 0.95 * s, y, axis)], 0.95 * s + 1.2 * s
        for sign in (-1, 1):
            low, high = (axis - 0.75 * s, axis - 1.02 * s) if sign < 0 else (axis + 0.7 * s, axis + 1.7 * s)
            stack = merge(
                [
                    hexagon(0.5 * s, min(low, high), max(low, high)),
                    cylinder(0.34 * s, min(low, high), max(low, high) + (0.3 * s if sign > 0 else 0), 14),
                ]
            )
            liquid.append(moved(stack, at(x, y)))
        face = axis + 1.9 * s + dead_room(dn)
        stub, port = mouth(dn, style, (x, y, face), (0, 0, 1), dead_room(dn) + 0.01)
        ports.append(port)
        parts += [
            Part(along("x", lantern, 0.95 * s, y, axis), CASING, "pump", CASING),
            Part(merge([*liquid, stub]), CASING, "trim", CASING),
            Part(along("x", bolts, 0.95 * s, y, axis), "bolt", "fastener", CASING, "Connection assembly", True),
        ]
    m = float(rng.uniform(0.75, 0.95)) * s
    top = seat + 2.2 * s
    bell = turned(
        [(0.8 * s, top - 0.01), (0.6 * s, top + 0.15 * s), (1.05 * m, top + 0.35 * s), (1.05 * m, top + 0.45 * s)], n
    )
    parts.append(Part(bell, "motor", "motor", "motor"))
    turn = at(0, 0, top + 0.45 * s) @ spun("z", float(rng.choice([0.5, 1.0, 1.5])) * np.pi)
    parts += placed(motor(m, float(rng.uniform(2.4, 3.2)) * m, style, rng), turn)
    return Model(parts, ports=tuple(ports), kind="metering pump")


def _wing(s: float, n: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wing pump on a wall with its rocking lever."""
    r, z = 0.1 * s, float(rng.uniform(0.8, 1.3))
    disc = along(
        "-y",
        merge(
            [
                cylinder(r, 0, 0.09, n),
                cylinder(1.15 * r, 0.07, 0.085, n),
                around(hexagon(0.016, 0.085, 0.098), 6, 1.07 * r),
            ]
        ),
        0,
        -0.02,
        z,
    )
    necks = [hexagon(0.06 * s, z + 0.9 * r, z + 1.25 * r), hexagon(0.06 * s, z - 1.25 * r, z - 0.9 * r)]
    necks = [moved(x, at(0, -0.065)) for x in necks]
    plate = box((2.4 * r, 0.012, 1.0 * r), (0, -0.014, z))
    bow = [(0, -0.1, z), (0, -0.14, z), (0.1 * s, -0.14, z + 0.22 * s), (0.1 * s, -0.14, z + 0.4 * s)]
    pipe = moved(cylinder(0.017, 0.0, z - 1.2 * r, 12), at(0, -0.065))
    return Model(
        [
            Part(merge([disc, *necks, plate]), CASING, "pump", CASING),
            Part(
                merge([rope(bow, 0.01, 8), along("-y", cylinder(0.02, 0.1, 0.12, 12), 0, -0.01, z)]),
                "lever",
                "handle",
                CASING,
                "Valve assembly",
            ),
            Part(pipe, "pipe", "pipe", "", "Pipe assembly"),
            Part(box((0.8, 0.1, z + 0.6), (0, 0.042, (z + 0.6) / 2)), "wall", "concrete", "", "Structural element"),
        ],
        kind="hand pump",
    )


def _pitcher(s: float, n: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pitcher pump with spout and lever on its suction pipe."""
    r, h = 0.055 * s, 0.35 * s
    low = float(rng.uniform(0.3, 0.7))
    body = [
        turned(
            [
                (1.8 * r, low),
                (1.8 * r, low + 0.02),
                (0.6 * r, low + 0.04),
                (0.6 * r, low + 0.1),
                (r, low + 0.14),
                (r, low + h),
                (1.3 * r, low + h),
                (1.3 * r, low + h + 0.02),
            ],
            n,
        )
    ]
    spout = rope(
        [
            (0.8 * r, 0, low + 0.7 * h),
            (2.6 * r, 0, low + 0.72 * h),
            (3.2 * r, 0, low + 0.6 * h),
            (3.3 * r, 0, low + 0.45 * h),
        ],
        0.4 * r,
        10,
    )
    ear = box((0.8 * r, 0.3 * r, 1.6 * r), (-1.1 * r, 0, low + h + 0.6 * r))
    lever = rope(
        [
            (0.0, 0, low + h + 1.4 * r),
            (-1.3 * r, 0, low + h + 1.3 * r),
            (-3.5 * r, 0, low + h),
            (-4.5 * r, 0, low + 0.3 * h),
        ],
        0.18 * r,
        8,
    )
    bar = cylinder(0.1 * r, low + h, low + h + 1.5 * r, 8)
    pipe = cylinder(0.024, 0.0, low, 12)
    return Model(
        [
            Part(merge([*body, spout, ear]), CASING, "pump", CASING),
            Part(merge([lever, bar]), "lever", "handle", CASING, "Valve assembly"),
            Part(pipe, "pipe", "pipe", "", "Pipe assembly"),
        ],
        kind="hand pump",
    )


def _barrel_pump(s: float, n: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rotary barrel pump screwed into a drum, with a crank."""
    drum = merge(
        [
            cylinder(0.29, 0, 0.88, style.round(0.29)),
            *(moved(torus(0.29, 0.01, style.round(0.29), 6), at(0, 0, z)) for z in (0.012, 0.3, 0.58, 0.868)),
        ]
    )
    z = 1.12
    r = 0.06 * s
    stem = moved(merge([cylinder(0.02, 0.86, z, 12), hexagon(0.07, 0.88, 0.91)]), at(0.17))
    disc = along(
        "-y",
        merge([cylinder(r, -0.04, 0.04, n), cylinder(1.2 * r, -0.045, -0.03, n), cylinder(1.2 * r, 0.03, 0.045, n)]),
        0.17,
        0,
        z + 0.5 * r,
    )
    beak = rope(
        [
            (0.17 + 0.8 * r, 0, z + 0.9 * r),
            (0.17 + 2.5 * r, 0, z + 0.9 * r),
            (0.17 + 3.2 * r, 0, z + 0.2 * r),
            (0.17 + 3.2 * r, 0, z - 0.9 * r),
        ],
        0.017,
        10,
    )
    crank = rope(
        [
            (0.17, -0.04, z + 0.5 * r),
            (0.17, -0.07, z + 0.5 * r),
            (0.02, -0.07, z + 1.9 * r),
            (0.02, -0.17, z + 1.9 * r),
        ],
        0.009,
        8,
    )
    return Model(
        [
            Part(merge([disc, stem, beak]), CASING, "pump", CASING),
            Part(crank, "lever", "handle", CASING, "Valve assembly"),
            Part(drum, "tank", "tank", "", "Tank"),
        ],
        kind="hand pump",
    )


def _hand_pump(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hand pump: a wing pump on a wall, a pitcher pump with spout and lever, or a rotary barrel pump on a drum."""
    kind, s = int(rng.integers(3)), float(rng.uniform(0.8, 1.2))
    n = style.round(0.1 * s)
    if kind == 0:
        return _wing(s, n, style, rng)
    if kind == 1:
        return _pitcher(s, n, style, rng)
    return _barrel_pump(s, n, style, rng)


def _power_pack(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hydraulic power pack: oil tank with level glass, upright or lying motor, bell housing, manifold with valves."""
    w, d, h = float(rng.uniform(0.5, 1.1)), float(rng.uniform(0.4, 0.7)), float(rng.uniform(0.35, 0.6))
    low = 0.08
    top = low + h
    tank = box((w, d, h), (0, 0, low + h / 2))
    deck = box((w + 0.04, d + 0.04, 0.012), (0, 0, top + 0.006))
    feet = [box((0.05, 0.08, low), (sx * 0.42 * w, sy * 0.38 * d, low / 2)) for sx in (-1, 1) for sy in (-1, 1)]
    m, n = float(rng.uniform(0.09, 0.14)), 20
    z = top + 0.012
    parts = [
        Part(merge([tank, deck]), "tank", "motor", "motor", "Tank"),
        Part(merge(feet), "tank leg", "steel", "motor", "Tank"),
    ]
    if rng.random() < 0.55:
        bell = turned(
            [
                (0.8 * m, z),
                (0.8 * m, z + 0.02),
                (0.6 * m, z + 0.03),
                (0.6 * m, z + 0.9 * m),
                (1.02 * m, z + 0.95 * m),
                (1.02 * m, z + m),
            ],
            style.round(m),
        )
        parts.append(Part(moved(bell, at(-0.2 * w)), CASING, "pump", CASING))
        parts += placed(
            motor(m, 2.8 * m, style, rng), at(-0.2 * w, 0, z + m) @ spun("z", float(rng.integers(4)) * np.pi / 2)
        )
    else:
        axis = z + 1.2 * m
        block = merge(
            [
                box((0.7 * m, 1.0 * m, 1.0 * m), (-0.42 * w, 0, axis)),
                along(
                    "x",
                    turned([(0.5 * m, 0), (0.5 * m, 0.4 * m), (0.95 * m, 0.9 * m)], style.round(m)),
                    -0.42 * w + 0.3 * m,
                    0,
                    axis,
                ),
            ]
        )
        parts.append(Part(block, CASING, "pump", CASING))
        parts += placed(motor(m, min(3.0 * m, 0.6 * w), style, rng, 1.2 * m), at(-0.42 * w + 1.2 * m, 0, axis) @ LYING)
        hose = [
            (-0.42 * w, 0.5 * m, axis),
            (-0.42 * w, 0.9 * m, axis),
            (-0.42 * w, 1.1 * m, axis - 0.3 * m),
            (-0.42 * w, 1.1 * m, z - 0.002),
        ]
        parts.append(Part(rope(hose, 0.015, 8), "hose", "rubber", "", "Pipe assembly"))
    x, y = 0.32 * w, -0.2 * d
    block = box((0.12, 0.1, 0.16), (x, y, z + 0.08))
    coils = [
        merge(
            [
                box((0.05, 0.05, 0.05), (x + dx, y, z + 0.185)),
                along("x", cylinder(0.022, 0.025, 0.09, 12), x + dx, y, z + 0.185),
            ]
        )
        for dx in (-0.03,)
    ]
    parts.append(Part(merge([block, *coils]), "valve", "trim", "", "Valve assembly"))
    breather = moved(merge([cylinder(0.02, 0, 0.04, n), cylinder(0.045, 0.04, 0.1, n)]), at(x, 0.3 * d, z - 0.001))
    canister = moved(turned([(0.05, 0), (0.05, 0.2), (0.035, 0.22)], n), at(0.1 * w, 0.33 * d, z - 0.001))
    parts += [Part(breather, "filter", "rubber", "", "Equipment"), Part(canister, "filter", "trim", "", "Equipment")]
    glass = box((0.03, 0.012, 0.55 * h), (0.3 * w, -d / 2 - 0.006, low + 0.5 * h))
    parts.append(Part(glass, "level gauge", "dial", "", "Gauge assembly"))
    return Model(parts, kind="hydraulic power pack")


SMALL: tuple[Family, ...] = (
    Family("pump/metering", "floor", PUMP, "pump", _metering, (15, 20, 25)),
    Family("pump/hand", "floor", PUMP, "pump", _hand_pump, (15,)),
    Family("pump/hydraulic power pack", "floor", PUMP, "pump", _power_pack, (15,)),
)
