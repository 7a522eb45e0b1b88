"""What moves a valve, standing on z = 0 about its stem: gearboxes, cylinders, diaphragms, motors, indicators."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from cadplants.families.valves.actuation_base import hand_lever, hand_wheel, indicator, quarter, shaft
from cadplants.families.valves.actuation_gear import bevel, worm
from cadplants.families.valves.actuation_hand import cylinder_at, slab, span
from cadplants.families.valves.drive import BODY
from cadplants.family import Part, placed
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, rod, turned
from cadplants.transforms import at, spun

__all__ = ["quarter_turn"]

Rng = np.random.Generator
Maker = Callable[[float, ModelingStyle, Rng], list[Part]]


# --- position indicators ---


def mount(half: float, tall: float, rng: Rng) -> Part:
    """The bracket between valve and actuator (ISO 5211): a bent U, two plates, a square tube or four pillars."""
    kind, t = int(rng.integers(4)), 0.004 + 0.05 * half
    plates = [box((2 * half, 1.6 * half, t), (0, 0, z)) for z in (t / 2, tall - t / 2)]
    if kind == 3:
        sides = [cylinder(0.16 * half, 0.0, tall, 10)]
        legs = [moved(sides[0], at(a * 0.75 * half, b * 0.6 * half)) for a in (-1, 1) for b in (-1, 1)]
    else:
        deep = (1.6, 1.0, 1.6)[kind] * half
        legs = [box((2 * half, t, tall), (0, s * 0.5 * deep, tall / 2)) for s in (-1, 1)]
        if kind == 2:
            legs = [box((t, 1.6 * half, tall), (s * 0.95 * half, 0, tall / 2)) for s in (-1, 1)]
    return Part(merge([*plates, *legs]), "yoke", "steel", BODY)


# --- quarter turn ---


def _rack(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A rack-and-pinion actuator: an extruded profile with end caps, an air pad, stop screws, an indicator."""
    half = float(rng.uniform(0.85, 1.2)) * (0.028 + 0.36 * radius)
    reach, kind = float(rng.uniform(1.6, 3.0)) * half, int(rng.integers(3))
    if kind == 0:
        section = rounded_rectangle(2 * half, 2.2 * half, 0.5 * half, 3)
    elif kind == 1:
        section = circle(1.15 * half, 8, phase=np.pi / 8)
    else:
        section = circle(1.1 * half, max(16, style.round(half)))
    tube_ = along("x", slab(section, -reach, reach), 0, 0, half)
    caps = [
        along("x", slab(section * f, *span(s * reach, s * (reach + w))), 0, 0, half)
        for s in (-1, 1)
        for f, w in ((1.04, 0.3 * half), (0.75, 0.45 * half))
    ]
    pad = box((0.9 * half, 0.3 * half, 0.7 * half), (0, 1.2 * half, half))
    foot = cylinder(0.7 * half, -0.02 * half, 0.3 * half, 16)
    screws = merge(
        [rod((s * 0.3 * half, -1.1 * half, half), (s * 0.3 * half, -1.6 * half, half), 0.1 * half, 8) for s in (-1, 1)]
    )
    parts = [
        Part(
            merge([tube_, *caps, pad, foot, screws]), "actuator", "clamp" if rng.random() < 0.5 else "motor", "actuator"
        )
    ]
    crown = cylinder(0.3 * half, 1.9 * half, 2.25 * half, 12)
    parts.append(replace(parts[0], solid=crown))
    if rng.random() < 0.85:
        parts += placed([indicator(0.5 * half, style, rng)], at(0, 0, 2.25 * half))
    if rng.random() < 0.4:
        coil = merge(
            [box((0.05, 0.05, 0.07), (0, 1.35 * half + 0.025, half)), cylinder_at(0.014, half + 0.03, half + 0.09, 0.0)]
        )
        parts.append(Part(coil, "actuator", "electrical", "actuator"))
    tall = float(rng.uniform(0.5, 1.6)) * half + 0.01
    return placed(
        [mount(0.9 * half, tall, rng), shaft(0.0, tall, 0.2 * half, style), *placed(parts, at(0, 0, tall))],
        quarter(rng),
    )


def _scotch(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A scotch yoke actuator: a housing with a lid, a long pressure cylinder with tie rods, a spring can or none."""
    half = 0.05 + 0.55 * radius
    n, reach, wide = (
        max(16, style.round(half)),
        float(rng.uniform(2.0, 3.6)) * half,
        float(rng.uniform(0.6, 0.95)) * half,
    )
    housing = slab(rounded_rectangle(2.4 * half, 1.9 * half, 0.15 * half, 2), 0.0, 1.2 * half)
    lid = slab(rounded_rectangle(2.6 * half, 2.1 * half, 0.2 * half, 2), 1.1 * half, 1.3 * half)
    can = along("x", turned([(wide, 0.0), (wide, reach)], n), 1.2 * half, 0, 0.65 * half)
    square = rounded_rectangle(2.2 * wide, 2.2 * wide, 0.2 * wide, 2)
    plates = [along("x", slab(square, z, z + 0.12 * half), 1.2 * half, 0, 0.65 * half) for z in (0.0, reach)]
    rods = [
        rod(
            (1.2 * half, a * 0.95 * wide, 0.65 * half + b * 0.95 * wide),
            (1.4 * half + reach, a * 0.95 * wide, 0.65 * half + b * 0.95 * wide),
            0.06 * half,
            6,
        )
        for a in (-1, 1)
        for b in (-1, 1)
    ]
    solids = [housing, lid, can, *plates, *rods]
    kind = int(rng.integers(3))
    if kind == 0:
        long = float(rng.uniform(1.5, 3.0)) * half
        solids.append(
            along(
                "-x",
                turned(
                    [
                        (0.85 * wide, 0.0),
                        (0.85 * wide, 0.9 * long),
                        (0.4 * wide, long),
                        (0.12 * wide, long),
                        (0.12 * wide, 1.2 * long),
                    ],
                    n,
                ),
                -1.2 * half,
                0,
                0.65 * half,
            )
        )
    elif kind == 1:
        solids += [moved(s, spun("z", np.pi)) for s in (can, *plates, *rods)]
    else:
        solids.append(
            along("-x", turned([(0.4 * half, 0.0), (0.3 * half, 0.3 * half)], n), -1.2 * half, 0, 0.65 * half)
        )
    tall = 0.5 * half
    parts = [
        Part(merge(solids), "actuator", "motor", "actuator"),
        *placed([indicator(0.3 * half, style, rng)], at(0, 0, 1.3 * half)),
    ]
    return placed(
        [mount(0.9 * half, tall, rng), shaft(0.0, tall, 0.22 * half, style), *placed(parts, at(0, 0, tall))],
        quarter(rng),
    )


def _vertical(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A slim upright pneumatic cylinder, as on sanitary valves: polished, waisted, with an indicator on top."""
    half, tall = 0.022 + 0.45 * radius, 0.11 + 1.6 * radius
    n = max(16, style.round(half))
    waist = float(rng.uniform(0.85, 1.0)) * half
    can = turned(
        [
            (0.5 * half, 0.0),
            (half, 0.08 * tall),
            (half, 0.18 * tall),
            (waist, 0.2 * tall),
            (waist, 0.8 * tall),
            (half, 0.82 * tall),
            (half, 0.93 * tall),
            (0.5 * half, tall),
        ],
        n,
    )
    low = 0.03 + 0.3 * radius
    yoke = merge(
        [box((0.25 * half, 1.2 * half, low), (s * 0.6 * half, 0, low / 2)) for s in (-1, 1)]
        + [cylinder(0.85 * half, low - 0.004, low + 0.003, n), cylinder(0.8 * half, 0.0, 0.004, n)]
    )
    ports = merge([rod((0, 0.8 * waist, z * tall), (0, 1.4 * half, z * tall), 0.007, 8) for z in (0.3, 0.7)])
    parts = [
        Part(moved(merge([can, ports]), at(0, 0, low)), "actuator", "clamp", "actuator"),
        Part(yoke, "yoke", "clamp", BODY),
    ]
    return [
        *parts,
        shaft(0.0, low, 0.16 * half, style),
        *placed([indicator(0.45 * half, style, rng)], at(0, 0, low + tall)),
    ]


def _motor_box(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A quarter-turn electric actuator: a compact box with ribbed lid, glands, indicator glass, hand crank or wheel."""
    half = float(rng.uniform(0.85, 1.2)) * (0.05 + 0.32 * radius)
    deep, tall = float(rng.uniform(0.7, 1.0)) * half, float(rng.uniform(1.2, 2.0)) * half
    corner = float(rng.uniform(0.1, 0.6)) * deep
    case = slab(rounded_rectangle(2.2 * half, 2 * deep, corner, 3), 0.25 * half, tall)
    split = slab(rounded_rectangle(2.35 * half, 2.15 * deep, corner, 3), 0.55 * tall, 0.62 * tall)
    lid = slab(rounded_rectangle(1.6 * half, 1.5 * deep, corner, 3), tall, tall + 0.15 * half)
    solids = [case, split, lid, cylinder(0.6 * half, 0.0, 0.3 * half, 16)]
    if rng.random() < 0.4:
        solids += [
            box((0.06 * half, 2.3 * deep, 0.35 * tall), (s * half, 0, 0.4 * tall)) for s in np.linspace(-0.8, 0.8, 5)
        ]
    solids += [
        along("-x", hexagon(0.022, 1.05 * half, 1.1 * half + 0.025), 0, s * 0.4 * deep, 0.45 * tall) for s in (-1, 1)
    ]
    parts = [Part(merge(solids), "actuator", "motor", "actuator")]
    parts += placed([indicator(0.4 * half, style, rng, 3)], at(0.3 * half, 0, tall + 0.15 * half))
    if rng.random() < 0.6:
        side = [shaft(0.0, 0.45 * half, 0.08 * half, style), hand_wheel(0.75 * half, 0.4 * half, style, rng)]
        parts += placed(side, at(-0.3 * half, -1.0 * deep, 0.35 * tall) @ spun("x", np.pi / 2))
    return placed(parts, quarter(rng))


def _multi_turn(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A multi-turn electric actuator shaped like an elbow: gear case, motor to one side, controls to the other."""
    half = float(rng.uniform(0.9, 1.15)) * (0.06 + 0.4 * radius)
    n, z = max(16, style.round(half)), 0.9 * half
    body = turned(
        [
            (0.95 * half, 0.0),
            (0.95 * half, 0.15 * half),
            (0.7 * half, 0.3 * half),
            (0.75 * half, 1.5 * half),
            (0.5 * half, 1.7 * half),
        ],
        n,
    )
    motor = along(
        "x",
        turned(
            [
                (0.62 * half, 0.0),
                (0.62 * half, 1.6 * half),
                (0.56 * half, 1.65 * half),
                (0.56 * half, 2.4 * half),
                (0.4 * half, 2.5 * half),
            ],
            n,
        ),
        0.4 * half,
        0,
        z,
    )
    fins = [
        along("x", slab(circle(0.66 * half, n), f * half, (f + 0.06) * half), 0.4 * half, 0, z)
        for f in (0.5, 0.75, 1.0, 1.25)
    ]
    panel = slab(rounded_rectangle(1.5 * half, 1.5 * half, 0.5 * half, 3), 0.5 * half, 1.5 * half)
    if rng.random() < 0.5:
        control = along("-x", panel, 0.1 * half, 0, z)
    else:
        control = along(
            "-x", turned([(0.8 * half, 0.6 * half), (0.8 * half, 1.3 * half), (0.7 * half, 1.5 * half)], n), 0, 0, z
        )
    glass = along("-x", cylinder(0.35 * half, 1.35 * half, 1.6 * half, 16), 0, 0, z + 0.1 * half)
    cover = turned(
        [(0.2 * half, 1.65 * half), (0.2 * half, float(rng.uniform(1.9, 4.0)) * half), (0.1 * half, 4.1 * half)], 10
    )
    parts = [Part(merge([body, motor, *fins, control, cover]), "actuator", "motor", "actuator")]
    parts.append(Part(glass, "position indicator", "dial", "actuator"))
    side = [shaft(0.0, 0.55 * half, 0.12 * half, style), hand_wheel(0.9 * half, 0.5 * half, style, rng)]
    parts += placed(side, at(0, -0.6 * half, z) @ spun("x", np.pi / 2))
    return placed(parts, quarter(rng))


def _electrohydraulic(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """An electrohydraulic actuator: a box with a cylinder below, a motor and an oil bottle on it."""
    half = 0.06 + 0.4 * radius
    n = max(16, style.round(half))
    base = along(
        "x",
        turned(
            [
                (0.5 * half, -1.8 * half),
                (0.55 * half, -1.7 * half),
                (0.55 * half, 1.7 * half),
                (0.5 * half, 1.8 * half),
            ],
            n,
        ),
        0,
        0,
        0.55 * half,
    )
    block = box((1.4 * half, 1.3 * half, 1.1 * half), (0, 0, 0.55 * half))
    cabin = box((2.0 * half, 1.3 * half, 1.2 * half), (0.3 * half, 0, 1.7 * half))
    bottle = moved(
        turned([(0.25 * half, 1.1 * half), (0.25 * half, 2.4 * half), (0.1 * half, 2.6 * half)], 12),
        at(-1.0 * half, 0, -0.2 * half),
    )
    stand = moved(box((0.7 * half, 0.6 * half, 0.3 * half)), at(-1.0 * half, 0, 0.95 * half))
    door = box((0.02 * half, 1.0 * half, 0.9 * half), (1.31 * half, 0, 1.7 * half))
    parts = [Part(merge([base, block, cabin, door, bottle, stand]), "actuator", "motor", "actuator")]
    tall = 0.4 * half
    return placed(
        [mount(0.7 * half, tall, rng), shaft(0.0, tall, 0.2 * half, style), *placed(parts, at(0, 0, tall))],
        quarter(rng),
    )


_QUARTERS: dict[str, Maker] = {
    "worm": worm, "bevel": bevel, "rack": _rack, "scotch": _scotch, "vertical": _vertical, "motor box": _motor_box,
    "multi-turn": _multi_turn, "electrohydraulic": _electrohydraulic,
}  # fmt: skip


def quarter_turn(
    x: float, z: float, radius: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = ()
) -> list[Part]:
    """One of some operators on a stem at ``x`` whose pad is on the height ``z``, scaled by the pipe's radius [m].

    Args:
        x: of the stem [m].
        z: of the pad [m].
        radius: of the pipe [m].
        style: that models it.
        rng: of its proportions.
        kinds: to draw from: ``lever`` or those of actuators and gears; all by default.
    """
    kind = str(rng.choice(kinds or ("lever", "lever", *_QUARTERS)))
    if kind == "lever" or (radius < 0.022 and kind in ("worm", "bevel", "scotch", "multi-turn", "electrohydraulic")):
        parts = [hand_lever(float(rng.uniform(0.9, 1.4)) * (0.09 + 2.2 * radius), 0.0, style, rng)]
    else:
        parts = _QUARTERS[kind](radius, style, rng)
    return placed(parts, at(x, 0, z))
