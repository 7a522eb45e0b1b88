"""Valves of heating and gas plants: rotary mixers, zone valves, gas blocks, distributors, cistern and bleed valves."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import wheel
from cadplants.families.valves.parts import (
    SMALL,
    bend,
    body,
    bolting,
    bonnet,
    fronted,
    other,
    piece,
    screwed,
    square,
)
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["HEATING"]

_FRAME, _PIPE, _FIX = "Structural element", "Pipe assembly", "Connection assembly"


def _rotary(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rotary three- or four-way heating mixer: flat round chest, screwed cover, knob or servomotor."""
    r = PIPES[dn].radius
    length = float(rng.uniform(5.2, 6.4)) * r + 0.025
    x, wide, deep = length / 2, 1.9 * r + 0.006, 1.25 * r + 0.004
    n = style.round(wide)
    core = [(1.15 * r, 0.12 * length), (1.15 * r, 0.88 * length)]
    chest = along("y", cylinder(wide, -deep, deep, n), x)
    solids = [screwed(dn, style, length, core, end=0.16 * length), chest]
    ways = ["-z"] if rng.random() < 0.6 else ["-z", "z"]
    for way in ways:
        solids.append(
            along(
                way,
                merge(
                    [
                        cylinder(1.15 * r, 0.5 * wide, 0.45 * length, n),
                        hexagon(2.4 * r + 0.006, 0.36 * length, 0.5 * length),
                    ]
                ),
                x,
            )
        )
    parts = [body(*solids)]
    for way in ways:
        tail = ring(
            0.85 * r if style.hollow else 0.0, r, 0.5 * length - 0.001, 0.5 * length + float(rng.uniform(0.08, 0.3)), n
        )
        parts.append(other(_PIPE, "pipe", "pipe", along(way, tail, x)))
    lid = cylinder(0.95 * wide, deep, deep + 0.006, n)
    screws = around(cylinder(0.004, deep + 0.0055, deep + 0.010, 6), 4, 0.8 * wide, 0.785)
    head = [bonnet(lid), bolting(screws), piece("valve stem", cylinder(0.005, deep + 0.002, deep + 0.03, 8))]
    low = deep + 0.006
    if rng.random() < 0.5:
        scale = cylinder(0.8 * wide, low - 0.0005, low + 0.002, n)
        knob = [
            turned([(0.5 * wide, low + 0.002), (0.45 * wide, low + 0.02), (0.35 * wide, low + 0.024)], max(8, n)),
            box((0.9 * wide, 0.22 * wide, 0.012), (0.45 * wide, 0, low + 0.012)),
        ]
        turn = spun("z", float(rng.uniform(0, 6)))
        head += [
            piece("position indicator", scale, color="dial"),
            piece("lever", moved(merge(knob), turn), color="handle", bundle=""),
        ]
    else:
        w, h, d = float(rng.uniform(0.07, 0.09)), float(rng.uniform(0.08, 0.13)), float(rng.uniform(0.06, 0.09))
        case = moved(extrude(rounded_rectangle(w, h, 0.008, 3), low + 0.012, low + 0.012 + d), at(0, 0.15 * h))
        foot = cylinder(0.018, low - 0.001, low + 0.013, 12)
        dial = merge(
            [cylinder(0.016, low + 0.011 + d, low + 0.026 + d, 12), box((0.03, 0.006, 0.006), (0, 0, low + 0.028 + d))]
        )
        head += [
            piece("actuator", case, foot, color="rubber", bundle="actuator"),
            piece("position indicator", dial, color="handle", bundle="actuator"),
        ]
    parts += placed(head, at(x) @ spun("x", np.pi / 2))
    return Model(parts, round(length, 6), "welded", "mixing valve")


def _zone(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A motorised zone valve: brass body with wrench ends, a motor box with a manual lever, a cable."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.8, 6.2)) * r + 0.03
    x, wide, n = length / 2, 1.45 * r + 0.003, style.round(1.4 * r)
    core = [(1.1 * r, 0.14 * length), (wide, 0.34 * length), (wide, 0.66 * length), (1.1 * r, 0.86 * length)]
    low = 1.35 * wide
    parts = [body(screwed(dn, style, length, core), moved(cylinder(0.8 * wide, 0.0, low, n), at(x)))]
    plate = box((0.07, 0.062, 0.002), (x, 0, low + 0.001))
    w, d, h = float(rng.uniform(0.08, 0.11)), float(rng.uniform(0.06, 0.075)), float(rng.uniform(0.045, 0.085))
    box_ = moved(
        extrude(rounded_rectangle(w, d, 0.006, 3), low + 0.002, low + 0.002 + h),
        at(x + float(rng.uniform(-0.1, 0.1)) * w),
    )
    parts += [bonnet(plate), piece("actuator", box_, color="clamp", bundle="actuator")]
    if rng.random() < 0.5:
        can = along("y", cylinder(0.024, 0.0, d / 2 + 0.02, style.round(0.024)), x, 0, low + 0.5 * h)
        parts.append(piece("actuator", can, bundle="actuator"))
    slot = merge(
        [
            box((0.004, 0.02, 0.006), (x + 0.62 * w, 0, low + 0.3 * h)),
            box((0.3 * w, 0.006, 0.004), (x + 0.5 * w, 0, low + 0.3 * h)),
        ]
    )
    parts.append(piece("lever", slot, color="handle", bundle=""))
    far = x - 0.5 * w
    cable = bend(
        [(far + 0.01, 0, low + 0.5 * h), (far - 0.05, 0, low + 0.5 * h), (far - 0.05, 0, low + 0.5 * h + 0.25)], 0.03
    )
    if rng.random() < 0.7:
        parts.append(other("Electrical and safety", "cable", "rubber", tube(cable, 0.004, 0.0, 8)))
    parts.append(piece("valve stem", moved(cylinder(0.005, low - 0.004, low + 0.004, 8), at(x))))
    return Model(parts, round(length, 6), "welded", "control valve")


def _gas_block(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gas valve block of a burner train (EN 161): square end plates, a cast block, coils, a governor."""
    r = PIPES[dn].radius
    half, plate = 1.7 * r + 0.012, 0.010 + 0.05 * r
    length = round(float(rng.uniform(6.0, 8.0)) * r + 0.09, 6)
    bore = 0.9 * r if style.hollow else 0.0
    ends = [along("x", square(half, z, z + plate, bore, style)) for z in (0.0, length - plate)]
    tall = 1.9 * half
    core = box((length - 2 * plate + 0.002, 1.5 * half, tall), (length / 2, 0, 0.1 * half))
    parts = [body(*ends, core)]
    top = 0.1 * half + tall / 2
    size = 0.03 + 0.35 * r
    for k, x in enumerate((0.3 * length, 0.7 * length)):
        if k == 1 and rng.random() < 0.5:
            pan = turned(
                [
                    (0.6 * size, top - 0.001),
                    (1.3 * size, top + 0.3 * size),
                    (1.3 * size, top + 0.5 * size),
                    (0.5 * size, top + 0.9 * size),
                    (0.45 * size, top + 3 * size),
                    (0.3 * size, top + 3.2 * size),
                ],
                style.round(size),
            )
            parts.append(bonnet(moved(pan, at(x))))
            continue
        high = float(rng.uniform(2.0, 3.2)) * size
        if rng.random() < 0.5:
            coil = square(0.95 * size, top, top + high)
        else:
            coil = merge(
                [
                    cylinder(0.95 * size, top, top + high, style.round(size)),
                    cylinder(0.6 * size, top + high - 0.001, top + high + 0.2 * size, 12),
                ]
            )
        plug = box((0.5 * size, 1.0 * size, 0.7 * size), (0, 1.3 * size, top + 0.5 * high))
        parts.append(piece("actuator", moved(merge([coil, plug]), at(x)), color="rubber", bundle="actuator"))
    for x in np.linspace(0.25, 0.75, int(rng.integers(2, 4))) * length:
        nipple = along(
            "-y",
            merge(
                [
                    hexagon(0.016, 0.74 * half, 0.75 * half + 0.008),
                    cylinder(0.0045, 0.75 * half, 0.75 * half + 0.018, 8),
                ]
            ),
            float(x),
            0,
            -0.3 * half,
        )
        parts.append(piece("gland", nipple))
    if rng.random() < 0.6:
        switch = box((0.05, 0.045, 0.06), (length / 2, 0.75 * half + 0.022, -0.2 * half))
        parts.append(other("Gauge assembly", "transmitter", "electrical", switch))
    return Model(parts, length, "welded", "solenoid valve")


def _distributor(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A floor-heating distributor: a bar on brackets at a wall, valves with caps or thermal heads, loops."""
    count, high = int(rng.integers(3, 8)), float(rng.uniform(0.5, 0.9))
    pitch, r = 0.05, float(rng.choice([0.0167, 0.021]))
    wide, n = count * pitch + 0.06, style.round(0.02)
    wall = box((wide + 0.4, 0.1, high + 0.5), (wide / 2, 0.11, (high + 0.5) / 2))
    parts = [other(_FRAME, "wall", "concrete", wall)]
    kind = int(rng.integers(3))
    bundles = {"actuator": "actuator", "handwheel": "", "valve bonnet": "valve body"}
    row = int(rng.integers(2))
    y, z = 0.0, high + 0.2 * row
    bar = along("x", cylinder(r, 0.0, wide, n), 0, y, z)
    stubs, heads = [bar], []
    for k in range(count):
        x = 0.055 + k * pitch
        stubs.append(moved(cylinder(0.011, -r - 0.03, 0.0, 10), at(x, y, z)))
        stubs.append(moved(hexagon(0.026, -r - 0.045, -r - 0.022), at(x, y, z)))
        stubs.append(moved(hexagon(0.024, 0.6 * r, r + 0.014), at(x, y, z)))
        shape = (
            [(0.013, r + 0.013), (0.019, r + 0.02), (0.019, r + 0.05), (0.015, r + 0.06)]
            if row
            else [(0.009, r + 0.013), (0.008, r + 0.06), (0.004, r + 0.064)]
        )
        if kind == 2:
            shape = [(0.016, r + 0.013), (0.016, r + 0.028), (0.010, r + 0.031)]
        heads.append(moved(turned(shape, 12), at(x, y, z)))
        loop = np.array([[x, y, z - r - 0.04], [x, y, 0.0]])
        parts.append(other(_PIPE, "pipe", "pipe", tube(loop, 0.008, 0.006 if style.hollow else 0.0, 8)))
    name = "actuator" if row and kind < 2 else "handwheel" if row or kind == 2 else "valve bonnet"
    parts.append(body(*stubs))
    parts += [piece(name, head, color="dial", bundle=bundles[name]) for head in heads]
    entry = along("-x", merge([hexagon(2.4 * r, -0.001, 0.03), cylinder(1.0 * r, 0.0, 0.034, n)]), 0, y, z)
    key = merge(
        [
            box((0.012, 0.012, 0.03), (-0.017, y, z + r + 0.012)),
            box((0.07, 0.016, 0.006), (-0.04, y, z + r + 0.028)),
        ]
    )
    parts += [body(entry), piece("lever", key, color="handle", bundle="")]
    lead = tube(
        np.array([[-0.033, y, z], [-0.033 - float(rng.uniform(0.1, 0.3)), y, z]]),
        0.9 * r,
        0.8 * r if style.hollow else 0.0,
        n,
    )
    parts.append(other(_PIPE, "pipe", "pipe", lead))
    for x in (0.02, wide - 0.02):
        level = high + 0.2 * row
        rail = [box((0.02, 0.004, 0.16), (x, 0.058, level)), box((0.02, 0.058, 0.006), (x, 0.029, level - r - 0.0028))]
        parts.append(other(_FIX, "bracket", "clamp", *rail))
    return Model(fronted(parts), kind="control valve")


def _cistern(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cistern with a float valve (BS 1212): shank through its wall, arm and ball inside, supply pipe outside."""
    wide, deep, tall = float(rng.uniform(0.5, 0.9)), float(rng.uniform(0.35, 0.6)), float(rng.uniform(0.35, 0.6))
    base, t = float(rng.choice([0.0, 0.3, 0.8])), 0.006
    r, n = float(rng.choice([0.0107, 0.0134])), style.round(0.02)
    z = base + tall - 0.07
    sides = [
        box((wide, deep, t), (0, 0, base + t / 2)),
        *(box((t, deep, tall), (s * (wide - t) / 2, 0, base + tall / 2)) for s in (-1, 1)),
    ]
    sides += [box((wide, t, tall), (0, s * (deep - t) / 2, base + tall / 2)) for s in (-1, 1)]
    parts = [other("Tank", "tank", "tank", merge(sides))]
    if base:
        legs = [
            box((0.04, 0.04, base), (sx * (wide / 2 - 0.04), sy * (deep / 2 - 0.04), base / 2))
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
        parts.append(other("Tank", "tank leg", "steel", merge(legs)))
    x = -wide / 2
    shank = along("x", cylinder(r, -0.04, 0.05, n), x, 0, z)
    nuts = [along("x", hexagon(2.9 * r, low, low + 0.008), x, 0, z) for low in (-0.008, t)]
    block = merge(
        [
            along("x", turned([(1.1 * r, 0.045), (1.5 * r, 0.06), (1.5 * r, 0.09), (0.9 * r, 0.1)], n), x, 0, z),
            along("-z", cylinder(0.8 * r, 0.0, 3 * r, 10), x + 0.075, 0, z),
        ]
    )
    ears = [box((0.03, 0.003, 0.03), (x + 0.108, s * 0.007, z + 0.004)) for s in (-1, 1)]
    parts += [body(shank, block, *ears), Part(merge(nuts), "nut", "fastener", "valve body", _FIX)]
    pin = along("y", cylinder(0.0025, -0.012, 0.012, 8), x + 0.115, 0, z + 0.006)
    long = min(float(rng.uniform(0.2, 0.35)), wide - 0.32)
    tilt, size = float(rng.uniform(0.1, 0.5)), float(rng.uniform(0.045, 0.06))
    pose = at(x + 0.115, 0, z + 0.006) @ spun("y", tilt)
    arm = rod((-0.02, 0, 0), (long, 0, 0), 0.0035, 8)
    float_ = moved(ball(size, style.round(size), float(rng.choice([1.0, 1.0, 0.7]))), at(long + 0.9 * size))
    parts += [
        piece("valve stem", pin),
        piece("lever", moved(arm, pose), bundle=""),
        piece("lever", moved(float_, pose), color="handle", bundle=""),
    ]
    path = bend([(x - 0.03, 0, z), (x - 0.1, 0, z), (x - 0.1, 0, 0.0)], 0.03)
    parts += [
        other(_PIPE, "union", "trim", along("-x", hexagon(2.7 * r, 0.028, 0.048), x, 0, z)),
        other(_PIPE, "pipe", "pipe", tube(path, 0.9 * r, 0.75 * r if style.hollow else 0.0, n)),
    ]
    return Model(fronted(parts), kind="float valve")


def _bleed(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bleed valve on an outlet: one hexagon, a screw down its top with a T or wing, a barbed tube aside."""
    r = float(rng.uniform(0.007, 0.012))
    tall = float(rng.uniform(3.0, 5.0)) * r
    low = 0.012
    core = [cylinder(0.85 * r, 0.0, 0.014, 12), hexagon(2.4 * r, low, low + tall)]
    top = low + tall
    way = spun("y", float(rng.choice([0.0, 0.0, 0.35])))
    barb = turned(
        [
            (0.4 * r, 0.9 * r),
            (0.4 * r, 2.2 * r),
            (0.55 * r, 2.3 * r),
            (0.4 * r, 3.0 * r),
            (0.55 * r, 3.1 * r),
            (0.35 * r, 3.9 * r),
        ],
        10,
    )
    core.append(moved(along("x", barb), at(0, 0, low + 0.6 * tall) @ way))
    parts = [body(*core)]
    neck = float(rng.uniform(0.3, 1.2)) * r
    if rng.random() < 0.5:
        parts.append(
            bonnet(hexagon(1.9 * r, top - 0.001, top + neck), cylinder(0.7 * r, top, top + neck + 0.4 * r, 12))
        )
        neck += 0.4 * r
    parts.append(piece("valve stem", cylinder(0.4 * r, top - 0.001, top + neck + 1.2 * r, 8)))
    z = top + neck + 0.9 * r
    kind = int(rng.integers(3))
    if kind == 0:
        parts.append(
            piece("lever", along("x", cylinder(0.25 * r, -2.2 * r, 2.2 * r, 8), 0, 0, z), color="handle", bundle="")
        )
    elif kind == 1:
        wing = merge(
            [
                cylinder(0.7 * r, z - 0.4 * r, z + 0.6 * r, 10),
                *(box((1.6 * r, 0.3 * r, 1.2 * r), (s * 1.2 * r, 0, z + 0.3 * r)) for s in (-1, 1)),
            ]
        )
        parts.append(piece("lever", wing, color="handle", bundle=""))
    else:
        parts.append(wheel(0.014 + 1.3 * r, 0, z, style, rng))
    return Model(parts, kind="bleed valve")


HEATING: tuple[Family, ...] = (
    valve_family("mixing valve/rotary", _rotary, SMALL),
    valve_family("control valve/zone", _zone, tuple(dn for dn in SMALL if dn <= 32)),
    valve_family("solenoid valve/gas block", _gas_block, SMALL),
    valve_family("control valve/distributor", _distributor, SMALL, "floor", 0.6),
    valve_family("float valve/cistern", _cistern, SMALL, "floor"),
    valve_family("bleed valve/hexagon", _bleed, SIZES, "tap"),
)
