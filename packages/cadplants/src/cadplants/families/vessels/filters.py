"""Further filters: housings with swing lids, cartridges, sand, duplex, backwash, air and oil filters."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.exchangers import equipment_family, equipment_mouth, feet_of
from cadplants.families.vessels.vessel_fittings import Drum, head, head_height, manway, mouth, renamed, sides
from cadplants.families.vessels.vesselfeet import legs, skirt
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import (
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["FILTERS"]

_NAME, _FRAME, _JOINT, _PIPE, _VALVE = (
    "filter",
    "Structural element",
    "Connection assembly",
    "Pipe assembly",
    "Valve assembly",
)


def _swing_lid(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bag filter with a lid on a davit or hinge: three or four eye nuts, side inlet, bottom outlet, tripod legs."""
    r, tall = float(rng.uniform(0.11, 0.3)), float(rng.uniform(0.5, 1.0))
    n = sides(style, r)
    low = 0.35 + float(rng.uniform(0.1, 0.3)) + head_height("2:1", r)
    drum = Drum(r, low, low + tall, n)
    high = drum.high
    rim = ring(0.97 * r, 1.3 * r, high - 0.03, high, n)
    bowl = merge([drum.solid(style), moved(head("2:1", r, style, n), at(0, 0, low) @ spun("x", np.pi)), rim])
    top = [
        (1.3 * r, high),
        (1.3 * r, high + 0.03),
        (0.9 * r, high + 0.035),
        (0.5 * r, high + 0.3 * r),
        (0.0, high + 0.34 * r),
    ]
    handle = [
        (0.4 * r, -0.06, high + 0.2 * r),
        (0.4 * r, -0.06, high + 0.4 * r + 0.04),
        (0.4 * r, 0.06, high + 0.4 * r + 0.04),
        (0.4 * r, 0.06, high + 0.2 * r),
    ]
    lid = merge([turned(top, n), rope(handle, 0.008, 8)])
    eye = merge(
        [
            rod((0, 0, high - 0.07), (0, 0, high + 0.09), 0.009, 8),
            hexagon(0.03, high + 0.03, high + 0.05),
            moved(torus(0.025, 0.006, 12, 6), at(0, 0, high + 0.115) @ spun("x", np.pi / 2)),
        ]
    )
    hinge = merge(
        [
            box((0.1, 0.05, 0.02), (1.3 * r + 0.02, 0, high + 0.015)),
            along("y", cylinder(0.012, -0.05, 0.05, 8), 1.3 * r + 0.06, 0, high),
            box((0.07, 0.08, 0.02), (1.3 * r + 0.02, 0, high - 0.015)),
        ]
    )
    parts = [
        Part(bowl, _NAME, "trim", _NAME),
        Part(lid, _NAME, "trim", _NAME),
        Part(around(eye, int(rng.choice([3, 4, 6])), 1.2 * r, 0.5), "bolt", "fastener", _NAME, _JOINT, True),
        Part(hinge, _NAME, "trim", _NAME),
    ]
    parts += feet_of(legs(str(rng.choice(["pipe", "tripod", "angle"])), drum, style, rng), _NAME)
    dn = 50 if r > 0.16 else 25
    some, ports = equipment_mouth(_NAME, dn, drum.side(np.pi, low + 0.8 * tall), style, r, drum.dip)
    bottom = low - head_height("2:1", r)
    if rng.random() < 0.5:
        below = mouth("plain", dn, 0.15, style, 0.0, 0.02)
        parts += placed(renamed(below, _NAME), at(0, 0, bottom) @ spun("x", np.pi))
    else:
        more, port = equipment_mouth(_NAME, dn, drum.side(0.0, low + 0.12 * tall), style, r, drum.dip)
        some, ports = some + more, ports + port
    return Model([*parts, *some], ports=tuple(ports), kind="bag filter")


def _multi_round(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A multi-cartridge housing: a polished hood on a base pan with a V-clamp or wing nuts, mouths below."""
    r, tall = float(rng.uniform(0.09, 0.25)), float(rng.choice([0.3, 0.55, 0.8, 1.05]))
    n, low = sides(style, r), float(rng.uniform(0.25, 0.45))
    seam = low + 0.12
    pan = turned([(0.6 * r, low), (r, low + 0.06), (r, seam - 0.012), (1.08 * r, seam - 0.01), (1.08 * r, seam)], n)
    crown = float(rng.uniform(0.25, 0.6)) * r
    hood = turned(
        [
            (1.08 * r, seam),
            (1.08 * r, seam + 0.01),
            (r, seam + 0.012),
            (r, seam + tall),
            (0.8 * r, seam + tall + 0.7 * crown),
            (0.3 * r, seam + tall + crown),
            (0.0, seam + tall + crown),
        ],
        n,
    )
    parts = [Part(pan, _NAME, "trim", _NAME), Part(hood, _NAME, "trim", _NAME)]
    if rng.random() < 0.55:
        band = ring(0.99 * r, 1.14 * r, seam - 0.018, seam + 0.018, n)
        lock = merge(
            [
                box((0.05, 0.05, 0.03), (1.16 * r + 0.01, 0, seam)),
                rod((1.16 * r, -0.06, seam), (1.16 * r, 0.06, seam), 0.006, 8),
                moved(ring(0.008, 0.025, -0.004, 0.004, 12), at(1.16 * r, 0.065, seam) @ spun("x", np.pi / 2)),
            ]
        )
        parts.append(Part(merge([band, lock]), "clamp", "trim", _NAME, _JOINT))
    else:
        wing = merge(
            [rod((0, 0, seam - 0.04), (0, 0, seam + 0.06), 0.006, 8), box((0.01, 0.06, 0.014), (0, 0, seam + 0.035))]
        )
        parts.append(Part(around(wing, int(rng.choice([4, 6, 8])), 1.07 * r), "bolt", "fastener", _NAME, _JOINT, True))
    vent = merge(
        [
            cylinder(0.008, seam + tall + crown - 0.005, seam + tall + crown + 0.05, 8),
            box((0.05, 0.008, 0.008), (0, 0, seam + tall + crown + 0.045)),
        ]
    )
    parts.append(Part(vent, _NAME, "trim", _NAME))
    dn = 50 if r > 0.17 else 25
    ports: list[Port] = []
    for a in (0.0, np.pi):
        pose = spun("z", a) @ at(0.92 * r, 0, low + 0.05) @ spun("y", np.pi / 2)
        some, port = equipment_mouth(_NAME, dn, pose, style, 0.0, 0.2 * r)
        parts += some
        ports += port
    foot = merge([rod((0, 0, 0), (0, 0, low + 0.05), 0.014, 8), cylinder(0.035, 0, 0.008, 12)])
    parts.append(Part(around(foot, 3, 0.8 * r, np.pi / 6 + 0.5), "tank leg", "trim", _NAME, "Tank"))
    return Model(parts, ports=tuple(ports), kind="cartridge filter")


def _sand(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sand filter as pools have it: a plastic ball on a plinth, a six-way valve beside or on top."""
    r, name = float(rng.uniform(0.2, 0.5)), _NAME
    n, stretch, low = sides(style, r), float(rng.uniform(0.9, 1.3)), 0.12
    z = low + stretch * r
    a = np.linspace(-np.pi / 2, np.pi / 2, 15)
    outline = [(r * np.cos(t), z + stretch * r * np.sin(t)) for t in a]
    outline[0], outline[-1] = (0.0, outline[0][1]), (0.0, outline[-1][1])
    seam = ring(0.98 * r, 1.03 * r, z - 0.015, z + 0.015, n)
    plinth = turned([(0.85 * r, 0.0), (0.75 * r, 0.06), (0.7 * r, low + 0.25 * r)], n)
    parts = [
        Part(merge([turned(outline, n), seam]), name, "tank", name),
        Part(plinth, name, "rubber", name),
    ]
    top = z + stretch * r
    side = bool(rng.random() < 0.5)
    if side:
        lid = merge(
            [
                cylinder(0.42 * r, top - 0.06 * r, top + 0.05, n),
                around(box((0.03, 0.03, 0.03), (0, 0, top + 0.03)), 8, 0.42 * r),
                dome(0.38 * r, 0.1 * r, top + 0.049, n),
            ]
        )
        parts.append(Part(lid, name, "dial", name))
    else:
        parts.append(Part(cylinder(0.3 * r, top - 0.05 * r, top + 0.06, n), name, "dial", name))
    head_ = turned([(0.07, 0.0), (0.085, 0.02), (0.085, 0.12), (0.1, 0.125), (0.1, 0.145), (0.05, 0.165)], 20)
    lever = merge([box((0.22, 0.03, 0.02), (0.06, 0, 0.175)), cylinder(0.02, 0.16, 0.19, 10)])
    ports_ = [rod((0.0, 0, 0.06), (0.14 * np.cos(t), 0.14 * np.sin(t), 0.06), 0.03, 10) for t in (0.0, 2.1, 4.2)]
    if side:
        pose = at(r + 0.22, 0, z - 0.08)
        arms = [
            rod((0.9 * r, 0, z - 0.02 + s * 0.12 * stretch), (r + 0.22, 0, z - 0.02 + s * 0.12 * stretch), 0.03, 12)
            for s in (-1, 1)
        ]
        column = cylinder(0.045, z - 0.02 - 0.16 * stretch, z + 0.0 + 0.16 * stretch, 12)
        parts.append(Part(merge([*arms, moved(column, at(r + 0.22))]), "pipe", "dial", name, _PIPE))
        pose = at(r + 0.22, 0, z + 0.16 * stretch - 0.01)
    else:
        pose = at(0, 0, top + 0.059)
    parts.append(Part(moved(merge([head_, *ports_]), pose), "valve body", "rubber", name, _VALVE))
    parts.append(Part(moved(lever, pose), "lever", "rubber", name, _VALVE))
    if rng.random() < 0.6:
        dial = moved(cylinder(0.025, 0.0, 0.03, 14), pose @ at(0, 0, 0.08) @ spun("x", np.pi / 2) @ at(0, 0, 0.08))
        parts.append(Part(dial, "gauge", "dial", "", "Gauge assembly"))
    return Model(parts, kind="sand filter")


def _media(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure media filter (sand, carbon, softener): a dished vessel with face piping of five valves in front."""
    r = float(rng.uniform(0.3, 0.7))
    n, height = sides(style, r), r * float(rng.uniform(1.4, 2.8))
    low = head_height("torispherical", r) + 0.3
    drum = Drum(r, low, low + height, n)
    body = merge(
        [
            drum.solid(style),
            moved(head("torispherical", r, style, n), at(0, 0, drum.high)),
            moved(head("torispherical", r, style, n), at(0, 0, low) @ spun("x", np.pi)),
        ]
    )
    parts = [Part(body, _NAME, "tank", _NAME)]
    parts += feet_of(
        legs(str(rng.choice(["pipe", "angle"])), drum, style, rng)
        if rng.random() < 0.7
        else skirt("open", drum, style, rng),
        _NAME,
    )
    size = 0.14 if r < 0.5 else 0.2
    parts += renamed(
        placed(
            manway("swing" if rng.random() < 0.5 else "oval", size, style, rng, r, drum.dip),
            drum.side(1.9, low + 0.75 * height),
        ),
        _NAME,
    )
    dn = int(rng.choice([40, 50, 65]))
    pr, x = PIPES[dn].radius, r + 0.35
    top, bottom = drum.high + head_height("torispherical", r), low - head_height("torispherical", r)
    upper = [(0, 0, top - 0.03), (0, 0, top + 0.16), (x, 0, top + 0.16), (x, 0, 0.5 * (low + drum.high))]
    lower = [(0, 0, bottom + 0.03), (0, 0, bottom - 0.12), (x, 0, bottom - 0.12), (x, 0, 0.5 * (low + drum.high))]
    k = style.round(pr)
    parts += [Part(rope(path, pr, k), "pipe", "pipe", "", _PIPE) for path in (upper, lower)]
    for z in np.linspace(low + 0.1 * height, drum.high - 0.1 * height, int(rng.integers(2, 5))):
        branch = rod((x, 0, z), (x, 0.55, z), pr, k)
        parts.append(Part(branch, "pipe", "pipe", "", _PIPE))
        disc = merge(
            [
                along("y", cylinder(1.7 * pr + 0.02, 0.2, 0.25, k), x, 0, z),
                rod((x, 0.225, z), (x + 2 * pr + 0.1, 0.225, z), 0.012, 8),
            ]
        )
        cap = along("x", cylinder(1.3 * pr + 0.02, 2 * pr + 0.08, 2 * pr + 0.2, 16), x, 0.225, z)
        parts.append(Part(disc, "valve body", "valve", "valve", _VALVE))
        parts.append(Part(cap, "actuator", "motor", "valve", _VALVE))
    return Model(parts, kind="media filter")


def _pot(r: float, low: float, tall: float, n: int) -> tuple[Solid, Solid]:
    """A pot with a drain below, and its lid with a handle."""
    top = low + tall
    outline = [(0.5 * r, low - 0.3 * r), (0.9 * r, low - 0.1 * r), (r, low), (r, top - 0.03)]
    pot = turned([*outline, (1.22 * r, top - 0.03), (1.22 * r, top)], n)
    drain = cylinder(0.014, low - 0.3 * r - 0.04, low - 0.28 * r, 8)
    cover = turned([(1.22 * r, top), (1.22 * r, top + 0.025), (0.6 * r, top + 0.03), (0.5 * r, top + 0.06)], n)
    grip = [(-0.3 * r, 0, top + 0.05), (-0.3 * r, 0, top + 0.1), (0.3 * r, 0, top + 0.1), (0.3 * r, 0, top + 0.05)]
    return merge([pot, drain]), merge([cover, rope(grip, 0.006, 6)])


def _duplex(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A duplex filter: two pots with bolted lids, change-over valves between them on one lever or wheel."""
    dn = int(rng.choice([25, 40, 50, 80]))
    pr = PIPES[dn].radius
    r = 1.6 * pr + float(rng.uniform(0.04, 0.09))
    tall, n, gap = r * float(rng.uniform(2.2, 4.0)), sides(style, r), 1.25 * r + pr + 0.03
    low = 0.25
    pots, lids = [], []
    count = int(rng.choice([4, 6, 8]))
    for s in (-1, 1):
        pot, lid = _pot(r, low, tall, n)
        pots.append(moved(pot, at(0, s * gap)))
        lids.append(moved(lid, at(0, s * gap)))
    ring_of = bolt_circle(count, 1.12 * r, 0.012, low + tall - 0.03, low + tall + 0.025)
    bolts = [moved(ring_of, at(0, s * gap)) for s in (-1, 1)]
    parts = [*(Part(p, _NAME, "valve", _NAME) for p in pots), *(Part(p, _NAME, "valve", _NAME) for p in lids)]
    parts.append(Part(merge(bolts), "bolt", "fastener", _NAME, _JOINT, True))
    ports: list[Port] = []
    spindle = []
    k = style.round(pr)
    for z, s in ((low + 0.25 * tall, -1), (low + 0.72 * tall, 1)):
        cock = merge(
            [
                cylinder(1.5 * pr, z - 1.7 * pr, z + 1.7 * pr, k),
                along("y", cylinder(1.15 * pr, -gap + 0.9 * r, gap - 0.9 * r, k), 0, 0, z),
            ]
        )
        parts.append(Part(cock, _NAME, "valve", _NAME))
        some, port = equipment_mouth(_NAME, dn, at(s * 1.3 * pr, 0, z) @ spun("y", s * np.pi / 2), style, 0.0, 0.2 * pr)
        parts += some
        ports += port
        spindle.append(cylinder(0.012 + 0.1 * pr, z, low + tall + 0.12, 10))
    bar = box((0.035, 0.3 + 2 * r, 0.012), (0, 0.1 + 0.6 * r, low + tall + 0.12))
    if rng.random() < 0.5:
        bar = merge(
            [
                moved(torus(0.8 * r, 0.01, 20, 6), at(0, 0, low + tall + 0.12)),
                box((1.6 * r, 0.02, 0.01), (0, 0, low + tall + 0.12)),
                box((0.02, 1.6 * r, 0.01), (0, 0, low + tall + 0.12)),
            ]
        )
        parts.append(Part(bar, "handwheel", "handle", _NAME, _VALVE))
    else:
        parts.append(Part(bar, "lever", "handle", _NAME, _VALVE))
    parts.append(Part(merge(spindle), "valve stem", "trim", _NAME, _VALVE))
    feet = [
        merge(
            [box((0.05, 0.05, low + 0.1), (x, s * gap, (low + 0.1) / 2)), box((0.1, 0.1, 0.008), (x, s * gap, 0.004))]
        )
        for s in (-1, 1)
        for x in (-r, r)
    ]
    parts.append(Part(merge(feet), "tank leg", "steel", _NAME, "Tank"))
    return Model(parts, ports=tuple(ports), kind="duplex filter")


def _backwash(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A battery of disc filters that backwash: plastic bells with clamps between two manifolds, valves below."""
    count, r = int(rng.integers(2, 6)), float(rng.choice([0.1, 0.13]))
    dn, n = int(rng.choice([80, 100, 150])), sides(style, 0.12)
    pr, pitch = PIPES[dn].radius, 2 * r + float(rng.uniform(0.08, 0.16))
    low, tall, k = 0.45 + pr, float(rng.uniform(0.35, 0.6)), style.round(PIPES[dn].radius)
    span, off = (count - 1) * pitch, r + pr
    bell = turned(
        [
            (1.05 * r, low + 0.2),
            (1.05 * r, low + 0.24),
            (r, low + 0.25),
            (0.95 * r, low + 0.2 + 0.8 * tall),
            (0.5 * r, low + 0.2 + tall),
            (0.0, low + 0.21 + tall),
        ],
        n,
    )
    base = merge(
        [
            turned([(0.06, low + 0.05), (r, low + 0.15), (1.05 * r, low + 0.16), (1.05 * r, low + 0.2)], n),
            rod((0, -off, low), (0, 0, low + 0.12), 0.045, 10),
            rod((0, off, low), (0, 0, low + 0.12), 0.045, 10),
        ]
    )
    band = ring(r, 1.12 * r, low + 0.185, low + 0.215, n)
    parts: list[Part] = []
    for x in (np.arange(count) - (count - 1) / 2) * pitch:
        parts += [
            Part(moved(bell, at(x)), _NAME, "rubber", _NAME),
            Part(moved(base, at(x)), _NAME, "rubber", _NAME),
            Part(moved(band, at(x)), "clamp", "trim", "", _JOINT),
            Part(moved(cylinder(0.06, low + 0.0, low + 0.055, 14), at(x)), "valve", "rubber", "", _VALVE),
        ]
    ports: list[Port] = []
    for s in (-1, 1):
        main = along("x", cylinder(pr, -span / 2 - 0.25, span / 2 + 0.25, k), 0, s * off, low)
        parts.append(Part(main, "pipe", "pipe", "", _PIPE))
        some, port = equipment_mouth(_NAME, dn, at(-span / 2 - 0.24, s * off, low) @ spun("y", -np.pi / 2), style)
        parts += [Part(p.solid, "flange" if i else "pipe", "flange", "", _PIPE) for i, p in enumerate(some)]
        ports += port
    for x in (-0.35 * span - 0.1, 0.35 * span + 0.1):
        stand = [box((0.05, 0.05, low - pr + 0.01), (x, s * off, (low - pr + 0.01) / 2)) for s in (-1, 1)]
        parts.append(Part(merge([*stand, box((0.05, 2 * off, 0.05), (x, 0, 0.1))]), "skid frame", "steel", "", _FRAME))
    return Model(parts, ports=tuple(ports), kind="disc filter")


FILTERS: tuple[Family, ...] = (
    equipment_family("filter/swing lid", _swing_lid, 1.0),
    equipment_family("filter/multi-round", _multi_round, 1.0),
    equipment_family("filter/sand ball", _sand, 1.0),
    equipment_family("filter/media vessel", _media, 0.9),
    equipment_family("filter/duplex", _duplex, 1.0),
    equipment_family("filter/disc battery", _backwash, 0.9),
)
