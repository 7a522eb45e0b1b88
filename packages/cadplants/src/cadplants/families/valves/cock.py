"""Cocks, taps and needle valves of real plants: drains, sampling points, hose taps, gas cocks, small ball valves."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import drive, wheel
from cadplants.families.valves.parts import (
    BODY,
    MID,
    SMALL,
    bend,
    body,
    bonnet,
    chain,
    cover,
    hub_radius,
    other,
    piece,
    screwed,
    square,
)
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import flanged_body, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["COCKS"]


def _angle_seat(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An angle seat valve: a threaded or welded run, a slanting neck, a round piston actuator with a sight cap."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.6, 6.5)) * r + 0.035
    core = [(1.05 * r, 0.12 * length), (1.3 * r, 0.35 * length), (1.3 * r, 0.65 * length), (1.05 * r, 0.88 * length)]
    if rng.random() < 0.6:
        run = screwed(dn, style, length, core, int(rng.choice([6, 8])))
    else:
        outline = [(1.0 * r, 0.0), *core, (1.0 * r, length)]
        run = along("x", turned(outline, style.round(1.3 * r), bore=bore_of(dn, style)))
    pose = at(0.5 * length) @ spun("y", float(rng.choice([-0.785, 0.785, 0.65])))
    n, wide = style.round(1.6 * r), 1.15 * r + 0.002
    neck = turned([(wide, 0.0), (wide, 2.2 * r), (0.85 * wide, 2.4 * r)], n)
    parts = [body(run, moved(neck, pose))]
    low = 2.4 * r
    if rng.random() < 0.6:
        nut = hexagon(2.1 * wide, low - 0.5 * r, low + 0.3 * r)
        tall = 0.4 * r
    else:
        nut, tall = turned([(0.6 * wide, low - 0.001), (0.6 * wide, low + 1.4 * r)], n), 1.4 * r
    parts.append(bonnet(moved(nut, pose)))
    base, rim, high = (
        low + 0.8 * tall,
        float(rng.uniform(1.6, 2.4)) * r + 0.012,
        float(rng.uniform(2.6, 4.0)) * r + 0.03,
    )
    m = style.round(rim)
    can = [
        (0.7 * rim, base),
        (rim, base + 0.12 * high),
        (rim, base + 0.5 * high),
        (1.04 * rim, base + 0.5 * high),
        (1.04 * rim, base + 0.58 * high),
        (rim, base + 0.58 * high),
        (0.95 * rim, base + 0.9 * high),
        (0.55 * rim, base + high),
    ]
    ports = [
        along(
            "y",
            merge([cylinder(0.008, 0.8 * rim, 1.05 * rim + 0.004, 10), hexagon(0.014, rim, rim + 0.012)]),
            0,
            0,
            base + k * high,
        )
        for k in (0.22, 0.75)
    ]
    parts.append(piece("actuator", moved(merge([turned(can, m), *ports]), pose), color="rubber", bundle="actuator"))
    cap = turned(
        [(0.3 * rim, base + high - 0.002), (0.28 * rim, base + 1.12 * high), (0.15 * rim, base + 1.17 * high)], 12
    )
    parts.append(piece("position indicator", moved(cap, pose), color="dial", bundle="actuator"))
    parts.append(piece("valve stem", moved(cylinder(0.25 * r, 0.0, base + 0.01, 8), pose)))
    return Model(parts, round(length, 6), "welded", "angle seat valve")


def _solenoid(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flanged solenoid valve: globe body, square or round piston cover, coil with cable plug on or beside it."""
    length, r = FACE_TO_FACE["globe"][dn], PIPES[dn].radius
    wide, neck = 1.3 * r + 0.008, hub_radius(dn)
    wide = max(wide, 1.03 * neck)
    shell = flanged_body(dn, style, length, [(wide, 0.35 * length), (wide, 0.65 * length)])
    x, n = length / 2, style.round(wide)
    seat, plate = max(1.15 * wide, 0.45 * FLANGES[dn].outer), 0.012 + 0.15 * r
    chest = cylinder(0.9 * wide, 0.3 * wide, seat - 0.003, n)
    parts = [
        body(shell, moved(chest, at(x))),
        *placed(cover(1.15 * wide + 0.006, seat, plate, 6, style, bool(rng.integers(2))), at(x)),
    ]
    top, size = seat + plate, float(rng.uniform(0.018, 0.03)) + 0.1 * r
    px = x if rng.random() < 0.6 else x + 0.5 * wide
    tube_ = cylinder(0.3 * size, top - 0.001, top + 2.4 * size, 12)
    if rng.random() < 0.5:
        coil = cylinder(size, top + 0.4 * size, top + 2.1 * size, style.round(size))
    else:
        coil = square(0.95 * size, top + 0.4 * size, top + 2.0 * size)
    plug = [
        box((0.8 * size, 0.8 * size, 0.8 * size), (1.3 * size, 0, top + 1.2 * size)),
        along("x", hexagon(0.5 * size, 1.6 * size, 2.1 * size), 0, 0, top + 1.2 * size),
    ]
    cable = bend(
        [(2.05 * size, 0, top + 1.2 * size), (3.5 * size, 0, top + 1.2 * size), (3.5 * size, 0, top + 4 * size)], size
    )
    parts += [
        piece("valve stem", moved(tube_, at(px))),
        piece("actuator", moved(merge([coil, *plug]), at(px)), color="rubber", bundle="actuator"),
    ]
    if rng.random() < 0.5:
        parts.append(other("Electrical and safety", "cable", "rubber", moved(rope(cable, 0.004, 8), at(px))))
    parts.append(
        Part(
            moved(hexagon(0.9 * size, top + 2.0 * size, top + 2.25 * size), at(px)),
            "nut",
            "fastener",
            "actuator",
            "Connection assembly",
            True,
        )
    )
    return Model(parts, length, kind="solenoid valve")


def _mini(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A mini ball valve of hexagon or square bar with a one-sided plastic key, a screwdriver slot or a T key."""
    r = PIPES[dn].radius
    length, half = float(rng.uniform(3.0, 4.2)) * r + 0.018, 1.25 * r + 0.002
    x, n = length / 2, style.round(r)
    holes = (circle(0.98 * r, max(8, n)),) if style.hollow else ()
    kind = int(rng.integers(3))
    if kind == 0:
        bar = along("x", extrude(circle(half / np.cos(np.pi / 6), 6, phase=np.pi / 6), 0.0, length, holes))
    elif kind == 1:
        bar = along("x", extrude(rounded_rectangle(2 * half, 2 * half, 0.25 * half, 2), 0.0, length, holes))
    else:
        bar = merge(
            [
                hex_end(dn, 0.0, 0.5 * length, style),
                along("x", ring(0.98 * r if style.hollow else 0.0, 1.2 * half, 0.35 * length, 0.6 * length, n)),
                along("x", ring(0.98 * r if style.hollow else 0.0, 1.1 * r, 0.6 * length, length, n)),
            ]
        )
        x = 0.46 * length
    neck, top = 0.5 * r + 0.002, 1.25 * half + 0.003
    parts = [body(bar, moved(cylinder(neck, 0.9 * half if kind < 2 else half, top, 12), at(x)))]
    turn = at(x, 0, top) @ spun("z", float(rng.choice([0.0, 1.5708, 3.1416])))
    design, long, key = int(rng.integers(3)), 1.8 * half + 0.012, 0.45 * half + 0.003
    if design == 0:
        grip = [
            cylinder(1.1 * key, 0, 0.8 * key, 12),
            box((long, 1.3 * key, 0.7 * key), (0.4 * long, 0, 0.45 * key)),
            box((0.3 * long, 1.7 * key, 0.8 * key), (0.75 * long, 0, 0.45 * key)),
        ]
    elif design == 1:
        grip = [cylinder(0.8 * key, 0, key, 12), box((0.5 * key, 1.6 * long, 1.8 * key), (0, 0, 1.6 * key))]
    else:
        grip = [cylinder(1.3 * key, 0, 0.5 * key, 12), box((0.3 * key, 2.2 * key, 0.7 * key), (0, 0, 0.5 * key))]
    parts.append(piece("valve stem", moved(cylinder(0.5 * neck, -0.003, 0.4 * key, 8), turn)))
    parts.append(piece("lever", moved(merge(grip), turn), color="handle", bundle=""))
    return Model(parts, round(length, 6), "welded", "ball valve")


def _gas_cock(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A taper plug cock for gas (EN 331 forerunner): waisted body, plug through it, wing or square head, nut below."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.2, 5.4)) * r + 0.025
    n, wide, x = style.round(1.3 * r), 1.25 * r + 0.003, length / 2
    core = [(1.1 * r, 0.15 * length), (0.95 * r, 0.3 * length), (0.95 * r, 0.7 * length), (1.1 * r, 0.85 * length)]
    chest = turned([(0.9 * wide, -1.35 * wide), (1.12 * wide, 1.35 * wide)], n)
    parts = [body(screwed(dn, style, length, core), moved(chest, at(x)))]
    below = [
        cylinder(0.7 * wide, -1.45 * wide, -1.34 * wide, n),
        hexagon(0.9 * wide, -1.8 * wide, -1.44 * wide),
        cylinder(0.25 * wide, -2.0 * wide, -1.7 * wide, 8),
    ]
    parts.append(Part(moved(merge(below), at(x)), "nut", "fastener", BODY, "Connection assembly"))
    top = 1.34 * wide
    plug = turned([(0.85 * wide, top), (0.75 * wide, top + 0.3 * wide), (0.4 * wide, top + 0.5 * wide)], n)
    parts.append(piece("valve disc", moved(plug, at(x))))
    turn, high = at(x) @ spun("z", float(rng.choice([0.0, 1.5708]))), top + 0.45 * wide
    kind = int(rng.integers(3))
    if kind == 0:
        reach = float(rng.uniform(1.6, 2.4)) * wide
        shape = np.array(
            [
                [-0.35 * wide, 0],
                [0.35 * wide, 0],
                [0.45 * wide, 0.3 * wide],
                [reach, 0.55 * wide],
                [reach, 1.2 * wide],
                [0.3 * wide, 0.95 * wide],
                [-0.3 * wide, 0.95 * wide],
                [-reach, 1.2 * wide],
                [-reach, 0.55 * wide],
                [-0.45 * wide, 0.3 * wide],
            ]
        )
        grip = moved(extrude(shape, -0.13 * wide, 0.13 * wide), at(0, 0, high) @ spun("x", np.pi / 2))
        parts.append(piece("lever", moved(grip, turn), color="handle", bundle=""))
    elif kind == 1:
        parts.append(
            piece("valve stem", moved(box((0.7 * wide, 0.7 * wide, 0.9 * wide), (0, 0, high + 0.44 * wide)), turn))
        )
    else:
        bar = rod((-0.5 * wide, 0, high + 0.35 * wide), (4.5 * wide, 0, high + 0.6 * wide), 0.22 * wide, 8)
        eye = cylinder(0.6 * wide, high - 0.002, high + 0.7 * wide, 12)
        parts.append(piece("lever", moved(merge([bar, eye]), turn), color="handle", bundle=""))
    return Model(parts, round(length, 6), "welded", "plug valve")


def _stop_cock(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A stop cock (EN 1213): round body with compression nuts or wrench ends, headwork with crutch or cross head."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.6, 6.0)) * r + 0.03
    n, wide, x = style.round(1.4 * r), 1.4 * r + 0.003, length / 2
    core = [(1.05 * r, 0.12 * length), (wide, 0.4 * length), (wide, 0.6 * length), (1.05 * r, 0.88 * length)]
    parts = [body(screwed(dn, style, length, core, end=0.16 * length))]
    if rng.random() < 0.5:
        for low in (0.02 * length, 0.86 * length):
            nut = along("x", hexagon(3.0 * r + 0.004, low, low + 0.12 * length))
            parts.append(other("Pipe assembly", "union", "valve", nut, own=True))
    pose = at(x) @ spun("y", float(rng.choice([0.0, 0.0, 0.7])))
    neck, low = cylinder(0.75 * wide, 0.0, 1.4 * wide, n), 1.4 * wide
    head = [hexagon(1.5 * wide, low - 0.1 * wide, low + 0.5 * wide), cylinder(0.5 * wide, low, low + 1.1 * wide, n)]
    nut = hexagon(0.9 * wide, low + 1.05 * wide, low + 1.5 * wide)
    top = low + 1.5 * wide
    parts += [body(moved(neck, pose)), bonnet(moved(merge(head), pose)), piece("gland", moved(nut, pose))]
    parts.append(piece("valve stem", moved(cylinder(0.2 * wide, top - 0.001, top + 1.0 * wide, 8), pose)))
    z, reach, kind = top + 0.9 * wide, float(rng.uniform(1.2, 1.7)) * wide, int(rng.integers(3))
    if kind == 0:
        grip = [
            rod((-reach, 0, z), (reach, 0, z), 0.2 * wide, 8),
            cylinder(0.35 * wide, z - 0.4 * wide, z + 0.1 * wide, 10),
        ]
    elif kind == 1:
        arms = [
            rod((0, 0, z), (reach * np.cos(a), reach * np.sin(a), z), 0.16 * wide, 8) for a in np.arange(4) * np.pi / 2
        ]
        knobs = around(ball(0.26 * wide, 10), 4, reach)
        grip = [
            *arms,
            moved(knobs, at(0, 0, z)),
            turned([(0.4 * wide, z - 0.4 * wide), (0.5 * wide, z + 0.1 * wide), (0.3 * wide, z + 0.3 * wide)], 12),
        ]
    else:
        angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        lobed = (reach * (0.85 + 0.15 * np.cos(3 * angles)))[:, None] * np.column_stack(
            [np.cos(angles), np.sin(angles)]
        )
        grip = [
            extrude(lobed, z - 0.2 * wide, z + 0.4 * wide),
            cylinder(0.4 * wide, z - 0.5 * wide, z - 0.15 * wide, 12),
        ]
    parts.append(
        piece("handwheel", moved(merge(grip), pose @ spun("z", float(rng.uniform(0, 3)))), color="handle", bundle="")
    )
    return Model(parts, round(length, 6), "welded", "globe valve")


def _drain(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A boiler drain cock on an outlet: squat body, square key or lever, ribbed hose tail with a cap on a chain."""
    r, n = float(rng.uniform(0.009, 0.014)), 12
    low = 0.014
    chest = [
        cylinder(0.85 * r, 0.0, 0.02, n),
        hexagon(2.5 * r, low, low + 1.1 * r),
        turned([(1.1 * r, low + r), (1.6 * r, low + 2.0 * r), (1.6 * r, low + 3.2 * r), (1.1 * r, low + 3.8 * r)], n),
    ]
    z = low + 2.6 * r
    way = spun("x", float(rng.uniform(-0.5, 0.15)))
    tail = [(1.0 * r, 1.2 * r), (1.0 * r, 2.2 * r)]
    for k in range(int(rng.integers(3, 6))):
        tail += [(1.15 * r, 2.2 * r + 0.8 * k * r), (0.85 * r, 3.0 * r + 0.8 * k * r - 0.02 * r)]
    chest.append(moved(along("y", turned(tail, n)), at(0, 0, z) @ way))
    parts = [body(*chest)]
    top = low + 3.8 * r
    kind = int(rng.integers(3))
    if kind == 0:
        parts.append(piece("valve stem", box((1.1 * r, 1.1 * r, 1.6 * r), (0, 0, top + 0.78 * r))))
    else:
        parts.append(piece("gland", hexagon(1.6 * r, top - 0.001, top + 0.8 * r)))
        parts += drive(0.0, top + 0.8 * r, 0.8 * r, style, rng, ("lever", "bar") if kind == 1 else ("wing",))
    if rng.random() < 0.6:
        far = tail[-1][1]
        cap = moved(along("y", turned([(1.25 * r, far - 0.3 * r), (1.25 * r, far + 1.2 * r)], n)), at(0, 0, z) @ way)
        end = (moved(Solid(np.array([[0, far, 1.2 * r]]), np.zeros((0, 3), np.int32)), at(0, 0, z) @ way)).vertices[0]
        parts.append(bonnet(cap, chain((0, 1.5 * r, low + 2.4 * r), end, 1.6 * r, 0.0009)))
    return Model(parts, kind="drain valve")


def _gauge_valve(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge root valve on an outlet: a tall multiport bar with plugs, its bonnet aside with a T bar, a capped top."""
    r = float(rng.uniform(0.010, 0.015))
    tall = float(rng.uniform(7.0, 11.0)) * r
    square_ = bool(rng.integers(2))
    bar = square(1.25 * r, 0.014, 0.014 + tall) if square_ else hexagon(2.5 * r, 0.014, 0.014 + tall)
    parts = [body(bar, cylinder(0.85 * r, 0.0, 0.016, 12))]
    top = 0.014 + tall
    ways = {"x": 0.62, "-x": 0.62, "y": 0.85, "-y": 0.85}
    for way, share in list(ways.items())[: int(rng.integers(1, 5))]:
        plug = merge([hexagon(1.4 * r, 1.05 * r, 1.7 * r), cylinder(0.6 * r, r, 1.2 * r, 10)])
        parts.append(bonnet(along(way, plug, 0, 0, 0.014 + share * tall)))
    pose = at(0, 0, 0.014 + 0.3 * tall) @ spun("y", float(rng.choice([0.5, 0.32])) * np.pi)
    head = [hexagon(1.9 * r, 1.1 * r, 2.6 * r), cylinder(0.7 * r, 2.5 * r, 4.2 * r, 12)]
    stalk = [cylinder(0.32 * r, 4.1 * r, 6.4 * r, 8)]
    parts += [
        bonnet(moved(merge(head), pose)),
        piece("gland", moved(hexagon(1.1 * r, 3.9 * r, 4.5 * r), pose)),
        piece("valve stem", moved(merge(stalk), pose)),
    ]
    grip = (
        drive(0.0, 5.8 * r, r, style, rng, ("bar",))
        if rng.random() < 0.6
        else [wheel(0.012 + 1.4 * r, 0, 5.6 * r, style, rng)]
    )
    parts += placed(grip, pose)
    parts.append(bonnet(hexagon(2.0 * r, top - 0.001, top + 0.9 * r), cylinder(1.0 * r, top, top + 1.2 * r, 12)))
    return Model(parts, kind="needle valve")


def _needle_angle(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An angle needle valve on an outlet: a forged or bar elbow, bonnet upright, a tube from its side."""
    r = float(rng.uniform(0.008, 0.013))
    n, z = 12, 0.012 + 2.2 * r
    if rng.random() < 0.5:
        core = box((2.4 * r, 2.4 * r, 3.6 * r), (0, 0, z))
    else:
        core = merge(
            [cylinder(1.35 * r, 0.012, z + 1.8 * r, style.round(1.35 * r)), moved(ball(1.6 * r, 12), at(0, 0, z))]
        )
    side = along("y", merge([cylinder(0.9 * r, 0.8 * r, 2.2 * r, n), hexagon(2.1 * r, 2.0 * r, 3.4 * r)]), 0, 0, z)
    parts = [body(cylinder(0.85 * r, 0, 0.02, n), core, side)]
    top = z + 1.8 * r
    parts.append(
        bonnet(hexagon(2.0 * r, top - 0.001, top + 1.2 * r), cylinder(0.75 * r, top + 1.1 * r, top + 2.6 * r, n))
    )
    parts.append(piece("gland", hexagon(1.4 * r, top + 2.5 * r, top + 3.2 * r)))
    parts.append(piece("valve stem", cylinder(0.33 * r, top + 3.1 * r, top + 5.4 * r, 8)))
    if rng.random() < 0.5:
        parts.append(wheel(0.012 + float(rng.uniform(1.4, 2.2)) * r, 0, top + 4.6 * r, style, rng))
    else:
        parts += drive(0.0, top + 5.0 * r, r, style, rng, ("bar",))
    far, rise = float(rng.uniform(0.08, 0.2)), float(rng.choice([-0.15, 0.15, 0.25]))
    path = bend([(0, 3.2 * r, z), (0, far, z), (0, far, z + rise), (far, far, z + rise)], 0.02)
    parts.append(other("Pipe assembly", "pipe", "pipe", tube(path, 0.5 * r, 0.35 * r if style.hollow else 0.0, n)))
    return Model(parts, kind="needle valve")


COCKS: tuple[Family, ...] = (
    valve_family("angle seat valve/piston", _angle_seat, SMALL),
    valve_family("solenoid valve/flanged", _solenoid, tuple(dn for dn in MID if dn <= 100)),
    valve_family("ball valve/mini", _mini, tuple(dn for dn in SMALL if dn <= 25)),
    valve_family("plug valve/gas cock", _gas_cock, SMALL),
    valve_family("globe valve/stop cock", _stop_cock, SMALL),
    valve_family("drain valve/hose tail", _drain, SIZES, "tap"),
    valve_family("needle valve/multiport", _gauge_valve, SIZES, "tap"),
    valve_family("needle valve/angle", _needle_angle, SIZES, "tap"),
)
