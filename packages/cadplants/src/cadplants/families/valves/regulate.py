"""Pressure reducing, float, thermostatic, mixing and solenoid valves beyond the plain ones."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.parts import (
    MID,
    SMALL,
    bend,
    body,
    bolting,
    bonnet,
    cover,
    hub_radius,
    laid,
    other,
    piece,
    screwed,
    spring,
)
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body, valve_family
from cadplants.family import Family, Model, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["REGULATORS"]

_REDUCING = "pressure reducing valve"


def _globe(dn: int, style: ModelingStyle, swell: float, rng: np.random.Generator) -> tuple[Solid, float, float]:
    """A flanged globe body (EN 558 series 1 lengths), its length and the radius of its middle [m]."""
    length, r = FACE_TO_FACE["globe"][dn], PIPES[dn].radius
    wide, thick, neck = max(swell * r + 0.006, 1.05 * hub_radius(dn)), plate_thickness(dn), hub_radius(dn)
    if rng.random() < 0.5:
        shares = np.linspace(-1, 1, 9)
        reach = length / 2 - thick - 0.08 * length
        middle = [(neck + (wide - neck) * float(np.sqrt(max(0.0, 1 - s * s))), length / 2 + s * reach) for s in shares]
    else:
        middle = [
            (neck, thick + 0.06 * length),
            (wide, 0.38 * length),
            (wide, 0.62 * length),
            (neck, 0.94 * length - thick),
        ]
    return flanged_body(dn, style, length, middle), length, wide


def _filter_bowl(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A domestic pressure reducer (EN 1567): threaded body, tapered spring hood, knob, clear bowl below."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.6, 6.5)) * r + 0.04
    n, wide, x = style.round(1.6 * r), 1.45 * r + 0.006, length / 2
    core = [(1.1 * r, 0.15 * length), (wide, 0.32 * length), (wide, 0.68 * length), (1.1 * r, 0.85 * length)]
    chest = cylinder(1.05 * wide, -1.25 * wide, 1.25 * wide, n)
    parts = [body(screwed(dn, style, length, core), moved(chest, at(x)))]
    low, tall = 1.25 * wide, float(rng.uniform(1.6, 3.2)) * wide
    kind = int(rng.integers(3))
    hood = [
        (1.15 * wide, low - 0.25 * wide),
        (1.15 * wide, low + 0.3 * wide),
        (0.85 * wide, low + 0.45 * wide),
        (0.6 * wide, low + tall),
    ]
    parts.append(bonnet(moved(turned(hood, n), at(x))))
    if kind == 0:
        knob = turned(
            [
                (0.8 * wide, low + tall - 0.002),
                (0.9 * wide, low + tall + 0.1 * wide),
                (0.9 * wide, low + tall + 0.6 * wide),
                (0.7 * wide, low + tall + 0.75 * wide),
            ],
            max(8, n),
        )
        parts.append(piece("handwheel", moved(knob, at(x)), color="handle", bundle=""))
    elif kind == 1:
        screw = [
            cylinder(0.12 * wide, low + tall - 0.002, low + tall + 0.7 * wide, 8),
            hexagon(0.4 * wide, low + tall, low + tall + 0.2 * wide),
        ]
        parts.append(piece("valve stem", moved(merge(screw), at(x))))
    deep = float(rng.uniform(0.6, 2.4)) * wide
    bowl = turned(
        [
            (1.2 * wide, 0.0),
            (1.2 * wide, 0.45 * wide),
            (1.0 * wide, 0.5 * wide),
            (0.9 * wide, 0.5 * wide + deep),
            (0.5 * wide, 0.8 * wide + deep),
        ],
        n,
    )
    parts.append(other("Pipe assembly", "strainer", "dial", along("-z", bowl, x, 0, -1.0 * wide), own=True))
    side = along(
        "y", merge([cylinder(0.4 * wide, 0.6 * wide, 1.3 * wide, 12), hexagon(0.6 * wide, 1.2 * wide, 1.5 * wide)]), x
    )
    parts.append(body(side))
    return Model(parts, round(length, 6), "welded", _REDUCING)


def _dome_loaded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dome-loaded regulator: thick discs bolted above a flanged globe, loading tube."""
    shell, length, wide = _globe(dn, style, 1.3, rng)
    r, x = PIPES[dn].radius, length / 2
    rim = float(rng.uniform(1.5, 2.2)) * wide + 0.015
    low = max(1.15 * wide, 0.5 * FLANGES[dn].outer + 0.008)
    n, thick = style.round(rim), 0.014 + 0.22 * r
    neck = cylinder(0.8 * wide, 0.3 * wide, low + 0.002, n)
    lower = cylinder(rim, low, low + thick, n)
    upper = turned(
        [
            (rim, low + thick),
            (rim, low + 2 * thick),
            (0.85 * rim, low + 2 * thick),
            (0.75 * rim, low + 2.2 * thick + 0.2 * rim),
            (0.3 * rim, low + 2.3 * thick + 0.3 * rim),
        ],
        n,
    )
    bolts = bolt_circle(int(rng.choice([8, 10, 12])), 0.92 * rim, max(0.007, 0.06 * rim), low, low + 2 * thick)
    parts = [body(shell, moved(merge([neck, lower]), at(x))), bonnet(moved(upper, at(x))), bolting(moved(bolts, at(x)))]
    top = low + 2.25 * thick + 0.28 * rim
    fit = [hexagon(0.02, top - 0.008, top + 0.014), cylinder(0.007, top + 0.012, top + 0.03, 8)]
    parts.append(piece("gland", moved(merge(fit), at(x))))
    far = rim + 0.03
    run = [(x, 0, top + 0.028), (x, 0, top + 0.05), (x, -far, top + 0.05), (x, -far, 0.0), (x, -0.6 * wide, 0.0)]
    parts.append(other("Pipe assembly", "pipe", "pipe", rope(bend(run, 0.02), 0.005, 8), own=True))
    if rng.random() < 0.5:
        parts.append(
            bonnet(along("-z", turned([(0.9 * wide, 0.0), (0.9 * wide, 1.3 * wide), (0.4 * wide, 1.5 * wide)], n), x))
        )
    return Model(parts, length, kind=_REDUCING)


def _gas(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gas regulator (EN 334): flat wide diaphragm housing, upright or aside, tower, vent, slam-shut."""
    r = PIPES[dn].radius
    flanged = dn > 50 or bool(rng.random() < 0.4)
    if flanged:
        shell, length, wide = _globe(dn, style, 1.35, rng)
    else:
        length, wide = 4.4 * r + 0.05, 1.45 * r + 0.004
        shell = screwed(
            dn,
            style,
            length,
            [(1.1 * r, 0.15 * length), (wide, 0.35 * length), (wide, 0.65 * length), (1.1 * r, 0.85 * length)],
        )
    rim = float(rng.uniform(1.8, 2.9)) * wide + 0.03
    side = bool(rng.random() < 0.35)
    n, low = style.round(rim), max(1.25 * wide, (0.5 * FLANGES[dn].outer + 0.01) if flanged else 0.0)
    neck = cylinder(0.75 * wide, 0.3 * wide, low + 0.003, n)
    flat = 0.12 * rim
    lower = turned([(0.5 * rim, low), (0.93 * rim, low + flat), (rim, low + flat), (rim, low + 1.3 * flat)], n)
    upper = [
        (rim, low + 1.3 * flat),
        (rim, low + 1.6 * flat),
        (0.93 * rim, low + 1.6 * flat),
        (0.6 * rim, low + 2.6 * flat),
        (0.32 * rim, low + 2.7 * flat),
    ]
    tower = float(rng.uniform(0.6, 1.6)) * rim
    upper += [(0.27 * rim, low + 2.7 * flat + tower)]
    cap = turned(
        [
            (0.3 * rim, low + 2.6 * flat + tower),
            (0.3 * rim, low + 3.4 * flat + tower),
            (0.24 * rim, low + 3.6 * flat + tower),
        ],
        max(8, n),
    )
    bolts = bolt_circle(int(rng.choice([8, 12, 16])), 0.965 * rim, 0.006, low + flat, low + 1.6 * flat)
    vent = along(
        "y",
        merge([hexagon(0.022 + 0.05 * rim, 0.25 * rim, 0.68 * rim), cylinder(0.008, 0.6 * rim, 0.75 * rim, 8)]),
        0,
        0,
        low + 2.75 * flat,
    )
    head = [body(neck, lower), bonnet(turned(upper, n), vent), bonnet(cap), bolting(bolts)]
    x = length / 2
    parts = [body(shell), *placed(head, at(x) @ (spun("x", np.pi / 2) if side else np.eye(4)))]
    if rng.random() < 0.5:
        size = 0.45 * rim
        way = "-z" if not side else "y"
        shut = turned(
            [
                (0.7 * wide, 0.3 * wide),
                (0.7 * wide, 1.25 * wide),
                (size, 1.3 * wide),
                (size, 1.3 * wide + 0.5 * size),
                (0.5 * size, 1.3 * wide + 0.7 * size),
                (0.4 * size, 1.3 * wide + 2.0 * size),
            ],
            n,
        )
        parts.append(piece("actuator", along(way, shut, x), color="valve", bundle="actuator"))
    return Model(parts, round(length, 6), "flanged" if flanged else "welded", _REDUCING)


def _pilot_globe(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pilot-operated diaphragm control valve (waterworks type): globe, domed cover, pilot loop aside."""
    shell, length, wide = _globe(dn, style, 1.4, rng)
    r, x = PIPES[dn].radius, length / 2
    seat, rim, plate = max(1.25 * wide, 0.52 * FLANGES[dn].outer), 1.45 * wide + 0.01, 0.008 + 0.08 * r
    n = style.round(rim)
    neck = turned([(0.9 * wide, 0.3 * wide), (rim, seat - plate - 0.15 * wide), (rim, seat - plate + 0.001)], n)
    parts = [body(shell, moved(neck, at(x)))]
    parts += placed(cover(rim, seat, plate, int(rng.choice([8, 10, 12])), style, False, 0.45 * wide), at(x))
    top = seat + plate + 0.45 * wide
    if rng.random() < 0.5:
        rodlet = cylinder(0.006 + 0.02 * r, top - 0.003, top + 0.06 + 0.3 * r, 8)
        case = ring(0.010 + 0.02 * r, 0.014 + 0.03 * r, top - 0.001, top + 0.05 + 0.3 * r, 12)
        parts.append(piece("position indicator", moved(merge([rodlet, case]), at(x)), color="dial"))
    side = float(rng.choice([-1, 1]))
    y, size, z = side * (rim + 0.05 + 0.1 * r), 0.018 + 0.03 * r, 0.9 * seat
    span, wire = 0.36 * length, 0.006 + 0.01 * r
    hub = 0.8 * hub_radius(dn)
    thick = plate_thickness(dn) + 0.03
    run = [(thick, side * 0.9 * hub, 0.3 * hub), (thick, y, 0.3 * hub), (thick, y, z), (length - thick, y, z),
           (length - thick, y, 0.3 * hub), (length - thick, side * 0.9 * hub, 0.3 * hub)]  # fmt: skip
    parts.append(other("Pipe assembly", "pipe", "pipe", rope(bend(run, 0.02), wire, 8), own=True))
    feed = [
        (x - 0.5 * span, y, z),
        (x - 0.5 * span, y, top - 0.1 * wide),
        (x - 0.1 * wide, side * 0.1 * wide, top - 0.06 * wide),
    ]
    parts.append(other("Pipe assembly", "pipe", "pipe", rope(bend(feed, 0.012), 0.8 * wire, 8), own=True))
    block = [
        along("x", hexagon(2 * size, -1.3 * size, 1.3 * size), x + 0.3 * span, y, z),
        moved(cylinder(0.9 * size, 0, 1.5 * size, 12), at(x + 0.3 * span, y, z)),
    ]
    tall = float(rng.uniform(3.0, 5.0)) * size
    case = turned(
        [
            (1.6 * size, 1.4 * size),
            (1.6 * size, 1.9 * size),
            (0.9 * size, 2.3 * size),
            (0.8 * size, 1.9 * size + tall),
            (0.3 * size, 2.0 * size + tall),
            (0.3 * size, 2.8 * size + tall),
        ],
        12,
    )
    block.append(rod((x + 0.3 * span, side * 0.5 * wide, z), (x + 0.3 * span, y, z), 0.5 * size, 10))
    parts += [body(*block), bonnet(moved(case, at(x + 0.3 * span, y, z)))]
    for k in range(int(rng.integers(0, 3))):
        cx = (thick, length - thick)[k]
        way, start = ("y" if side > 0 else "-y"), 0.7 * hub
        cock = along(way, hexagon(1.7 * size, start, start + 0.3 * hub + 2.2 * size), cx, 0, 0.3 * hub)
        key = box((0.012, 0.012, 3.0 * size), (cx, side * (start + 0.3 * hub + size), 0.3 * hub + 1.8 * size))
        parts += [body(cock), piece("lever", key, color="handle", bundle="")]
    return Model(parts, length, kind="control valve")


def _self_acting(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A self-operated reducing valve: a globe whose springs stand on columns below, over a hanging diaphragm can."""
    shell, length, wide = _globe(dn, style, 1.35, rng)
    r, x, n = PIPES[dn].radius, length / 2, style.round(wide)
    seat = max(1.2 * wide, 0.5 * FLANGES[dn].outer + 0.01)
    parts = [
        body(shell),
        *placed(
            [
                body(cylinder(0.85 * wide, 0, seat - 0.002, n)),
                *cover(1.15 * wide + 0.006, seat, 0.01 + 0.06 * r, 4, style),
            ],
            at(x),
        ),
    ]
    down, tall = seat, float(rng.uniform(2.2, 3.4)) * wide + 0.05
    neck = turned(
        [(0.7 * wide, 0.0), (0.7 * wide, down - 0.01), (0.95 * wide, down - 0.01), (0.95 * wide, down + 0.012)], n
    )
    low = [body(neck)]
    stay = around(cylinder(0.08 * wide + 0.004, down + 0.01, down + tall + 0.002, 8), 2, 0.75 * wide)
    low.append(piece("yoke", stay))
    low.append(piece("valve stem", cylinder(0.1 * wide, down, down + tall + 0.005, 10)))
    if rng.random() < 0.5:
        coils = [spring(0.45 * wide, 0.07 * wide, down + 0.012, down + 0.75 * tall, 6, style)]
    else:
        coils = [
            moved(spring(0.2 * wide, 0.05 * wide, down + 0.012, down + 0.75 * tall, 8, style), at(s * 0.38 * wide, 0))
            for s in (-1, 1)
        ]
    plate = box((1.9 * wide, 0.5 * wide, 0.1 * wide + 0.004), (0, 0, down + 0.75 * tall + 0.05 * wide))
    low.append(piece("valve stem", *coils, plate))
    rim, z = float(rng.uniform(1.3, 2.3)) * wide + 0.03, down + tall
    m = style.round(rim)
    pans = [
        turned([(0.95 * wide, z), (0.9 * rim, z + 0.12 * rim), (rim, z + 0.14 * rim), (rim, z + 0.2 * rim)], m),
        turned(
            [(rim, z + 0.205 * rim), (rim, z + 0.26 * rim), (0.85 * rim, z + 0.3 * rim), (0.4 * rim, z + 0.42 * rim)], m
        ),
    ]
    low.append(
        piece(
            "actuator", *pans, cylinder(0.6 * rim, z + 0.19 * rim, z + 0.22 * rim, m), color="valve", bundle="actuator"
        )
    )
    low.append(bolting(bolt_circle(8, 0.94 * rim, 0.007, z + 0.13 * rim, z + 0.27 * rim)))
    parts += placed(low, at(x) @ spun("x", np.pi))
    start = (0.88 * length - plate_thickness(dn) * 0.5, 0.0, -0.9 * hub_radius(dn))
    line = [start, (start[0], 0, -z - 0.36 * rim), (x, 0, -z - 0.6 * rim), (x, 0, -z - 0.4 * rim)]
    if start[0] - x > rim + 0.01:
        line = [start, (start[0], 0, -z - 0.7 * rim), (x, 0, -z - 0.7 * rim), (x, 0, -z - 0.4 * rim)]
    else:
        line = [
            start,
            (x + 1.2 * rim, 0, -seat),
            (x + 1.2 * rim, 0, -z - 0.7 * rim),
            (x, 0, -z - 0.7 * rim),
            (x, 0, -z - 0.4 * rim),
        ]
    parts.append(other("Pipe assembly", "pipe", "pipe", rope(bend(line, 0.15 * rim), 0.005, 8), own=True))
    return Model(parts, length, kind=_REDUCING)


def _float(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A float valve at the end of a line: angle or balanced body, links, a long arm, a ball or a flat float."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    n, wide = style.round(1.5 * r), 1.35 * r + 0.008
    center = thick + 0.03 + 1.2 * wide
    chest = turned(
        [
            (1.05 * r, thick + 0.01),
            (wide, center - 0.8 * wide),
            (wide, center + 0.9 * wide),
            (0.7 * wide, center + 1.1 * wide),
        ],
        n,
    )
    spout = along("y", ring(0.7 * wide if style.hollow else 0, 0.85 * wide, 0.75 * wide, 1.9 * wide, n), 0, 0, center)
    parts = [body(disc_flange(dn, style, thick + 0.012), chest, spout)]
    lid = cylinder(1.1 * wide, center + 1.0 * wide, center + 1.15 * wide, n)
    parts.append(bonnet(lid))
    pin_z, base = center + 1.55 * wide, center + 1.14 * wide
    fork = [box((0.4 * wide, 0.12 * wide, 0.7 * wide), (0, s * 0.3 * wide, base + 0.34 * wide)) for s in (-1, 1)]
    pin = along("y", cylinder(0.1 * wide, -0.45 * wide, 0.45 * wide, 8), 0, 0, pin_z)
    piston = cylinder(0.12 * wide, base - 0.002, pin_z, 8)
    parts += [body(*fork), piece("valve stem", pin, piston)]
    long, tilt = 0.12 + float(rng.uniform(5.0, 9.0)) * r, float(rng.uniform(-0.5, 0.3))
    turn = at(0, 0, pin_z) @ spun("y", tilt)
    half = 0.004 + 0.05 * r
    if rng.random() < 0.5:
        arm = rod((-0.7 * wide, 0, 0), (long, 0, 0), half, 8)
    else:
        arm = box((long + 0.7 * wide, 1.1 * half, 3 * half), ((long - 0.7 * wide) / 2, 0, 0))
    size = 0.04 + 0.9 * r
    kind = int(rng.integers(3))
    m = style.round(size)
    if kind == 0:
        bob = moved(ball(size, m), at(long + 0.9 * size))
    elif kind == 1:
        bob = moved(
            merge([ball(size, m, 0.8), ring(0.98 * size, 1.05 * size, -0.004, 0.004, m)]), at(long + 0.9 * size)
        )
    else:
        bob = moved(
            turned([(0.85 * size, -0.5 * size), (size, -0.3 * size), (size, 0.3 * size), (0.85 * size, 0.5 * size)], m),
            at(long + 0.9 * size),
        )
    parts.append(piece("lever", moved(arm, turn), bundle=""))
    parts.append(piece("lever", moved(bob, turn), color="handle", bundle=""))
    return Model(laid(parts), kind="float valve")


def _mixing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermostatic mixing valve: a threaded tee with unions, a knob or a capped adjuster over the mixed branch."""
    r = PIPES[dn].radius
    length = float(rng.uniform(5.5, 7.0)) * r + 0.03
    n, wide, x = style.round(1.5 * r), 1.5 * r + 0.003, length / 2
    core = [(1.05 * r, 0.12 * length), (1.25 * r, 0.3 * length), (1.25 * r, 0.7 * length), (1.05 * r, 0.88 * length)]
    barrel = turned([(0.9 * wide, -1.2 * wide), (wide, -0.8 * wide), (wide, 1.4 * wide)], n)
    parts = [body(screwed(dn, style, length, core, end=0.15 * length), moved(barrel, at(x)))]
    if rng.random() < 0.6:
        for low in (0.15 * length, 0.75 * length):
            parts.append(
                other(
                    "Pipe assembly", "union", "valve", along("x", hexagon(3.2 * r, low, low + 0.1 * length)), own=True
                )
            )
    reach = 0.42 * length + 0.6 * wide
    stub = ring(0.9 * r if style.hollow else 0.0, 1.1 * r, 0.8 * wide, reach, n)
    nut = hexagon(3.0 * r, 1.2 * wide, 1.2 * wide + 0.12 * length)
    parts += [body(along("-z", stub, x)), other("Pipe assembly", "union", "valve", along("-z", nut, x), own=True)]
    drop = float(rng.uniform(0.06, 0.25))
    tail = ring(0.85 * r if style.hollow else 0.0, r, reach, reach + drop, n)
    parts.append(other("Pipe assembly", "pipe", "pipe", along("-z", tail, x)))
    top = 1.4 * wide
    if rng.random() < 0.6:
        ribs = int(rng.choice([0, 10, 16]))
        knob = [
            turned(
                [
                    (1.1 * wide, top - 0.002),
                    (1.25 * wide, top + 0.2 * wide),
                    (1.15 * wide, top + 1.3 * wide),
                    (0.8 * wide, top + 1.5 * wide),
                ],
                max(8, n),
            )
        ]
        if ribs:
            knob.append(
                around(box((0.12 * wide, 0.12 * wide, 0.9 * wide), (0, 0, top + 0.75 * wide)), ribs, 1.2 * wide)
            )
        parts.append(piece("handwheel", moved(merge(knob), at(x)), color="rubber", bundle=""))
    else:
        cap = [
            hexagon(1.9 * wide, top - 0.002, top + 0.5 * wide),
            turned([(0.7 * wide, top + 0.4 * wide), (0.6 * wide, top + 1.4 * wide)], n),
        ]
        parts.append(bonnet(moved(merge(cap), at(x))))
    return Model(parts, round(length, 6), "welded", "mixing valve")


REGULATORS: tuple[Family, ...] = (
    valve_family("pressure reducing valve/filter bowl", _filter_bowl, SMALL),
    valve_family("pressure reducing valve/dome loaded", _dome_loaded, MID),
    valve_family("pressure reducing valve/gas", _gas, tuple(dn for dn in SIZES if dn <= 100), weight=1.3),
    valve_family("control valve/pilot loop", _pilot_globe, tuple(dn for dn in SIZES if dn >= 40)),
    valve_family("pressure reducing valve/self-acting", _self_acting, tuple(dn for dn in MID if dn <= 100)),
    valve_family("float valve/arm", _float, MID, "head"),
    valve_family("mixing valve/thermostatic", _mixing, SMALL),
)
