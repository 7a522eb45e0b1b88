"""Valves with operators or bodies of their own: blocks, fusible and quick levers, landing and tank valves."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import drive, stem, wheel
from cadplants.families.valves.parts import (
    MID,
    SMALL,
    bend,
    body,
    bonnet,
    cover,
    hub_radius,
    laid,
    other,
    piece,
    screwed,
)
from cadplants.families.valves.valve import disc_flange, flanged_body, valve_family
from cadplants.family import Family, Model, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["BLOCKS"]


def _block_bleed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A double block and bleed valve in one flanged body (API 6D short): two levers, a bleed needle between."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    length = round(float(rng.uniform(5.5, 7.5)) * r + 2 * thick + 0.08, 6)
    wide = max(1.5 * r + 0.012, 1.02 * hub_radius(dn))
    neck = hub_radius(dn)
    low, high = thick + 0.018 + 0.1 * r, length - thick - 0.018 - 0.1 * r
    shell = flanged_body(dn, style, length, [(neck, low), (wide, low), (wide, high), (neck, high)])
    solids = [shell]
    if rng.random() < 0.5:
        solids.append(
            along("x", extrude(rounded_rectangle(2.1 * wide, 2.1 * wide, 0.3 * wide, 3), low + 0.002, high - 0.002))
        )
        face = 1.05 * wide
    else:
        face = wide
    parts = [body(*solids)]
    boss, top = 0.5 * r + 0.006, face + 0.012 + 0.15 * r
    span = high - low
    for x in (low + 0.22 * span, high - 0.22 * span):
        head = [body(cylinder(boss, 0.8 * face, top, 12)), stem(top - 0.001, top + 0.012, 0.5 * boss, style)]
        parts += placed([*head, *drive(0.0, top + 0.01, 0.7 * r, style, rng, ("lever", "lever", "bar"))], at(x))
    b = 0.009 + 0.03 * r
    way = spun("x", float(rng.choice([-0.5, 0.5, 0.0])) * np.pi)
    mid = at(length / 2) @ way
    bleed = [
        body(hexagon(2.6 * b, 0.8 * wide, face + 2.0 * b)),
        bonnet(
            hexagon(2.0 * b, face + 1.95 * b, face + 3.2 * b), cylinder(0.8 * b, face + 3.1 * b, face + 4.6 * b, 10)
        ),
        piece("gland", hexagon(1.4 * b, face + 4.5 * b, face + 5.2 * b)),
        piece("valve stem", cylinder(0.35 * b, face + 5.1 * b, face + 7.2 * b, 8)),
        *drive(0.0, face + 6.8 * b, b, style, rng, ("bar",)),
    ]
    return Model([*parts, *placed(bleed, mid)], length, kind="ball valve")


def _balancing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flanged balancing valve (EN 558 series 1): slanting or upright bonnet, digit wheel, test points."""
    length, r = FACE_TO_FACE["globe"][dn], PIPES[dn].radius
    neck, thick = hub_radius(dn), plate_thickness(dn)
    wide = max(1.25 * r + 0.006, 1.04 * neck)
    shell = flanged_body(
        dn,
        style,
        length,
        [(neck, thick + 0.05 * length), (wide, 0.4 * length), (wide, 0.6 * length), (neck, 0.95 * length - thick)],
    )
    tilt = float(rng.choice([0.0, 0.6, 0.75]))
    n = style.round(wide)
    rim = 1.1 * wide + 0.008
    clear = (0.5 * FLANGES[dn].outer + 0.012 + rim * np.sin(tilt)) / np.cos(
        tilt
    )  # the slanting cover passes the flange
    seat = max(1.3 * wide, float(clear) + 0.01 + 0.08 * r)
    plate = 0.010 + 0.08 * r
    pose = at((0.5 if tilt == 0 else 0.44) * length) @ spun("y", tilt)
    top = seat + plate
    head = [
        body(cylinder(0.85 * wide, 0.2 * wide, seat - 0.003, n)),
        *cover(rim, seat, plate, int(rng.choice([4, 6, 8])), style),
    ]
    tall, grip = 0.04 + 0.5 * r, 0.03 + 0.45 * r
    head.append(bonnet(turned([(0.6 * wide, top - 0.001), (0.4 * wide, top + tall)], n)))
    m = max(10, style.round(grip))
    knob = [
        turned(
            [
                (0.8 * grip, top + tall - 0.002),
                (grip, top + tall + 0.1 * grip),
                (grip, top + tall + 0.8 * grip),
                (0.7 * grip, top + tall + grip),
            ],
            m,
        )
    ]
    knob.append(
        around(
            box((0.12 * grip, 0.16 * grip, 0.6 * grip), (0, 0, top + tall + 0.45 * grip)),
            int(rng.choice([6, 12])),
            grip,
        )
    )
    head.append(piece("handwheel", merge(knob), color="handle", bundle=""))
    window = box((0.5 * grip, 0.3 * grip, 0.05 * grip), (0, 0.3 * grip, top + tall + 1.0 * grip))
    head.append(piece("position indicator", window, color="dial"))
    parts = [body(shell), *placed(head, pose)]
    lean = float(rng.choice([0.4, 0.9, np.pi / 2]))
    for x in (thick + 0.07 * length, length - thick - 0.07 * length):
        test = [hexagon(0.018, 0.9 * neck, neck + 0.016), cylinder(0.007, neck + 0.01, neck + 0.03, 10)]
        cap = cylinder(0.010, neck + 0.028, neck + 0.055, 10)
        parts += placed([body(*test), bonnet(cap)], at(x) @ spun("x", -lean))
    return Model(parts, length, kind="globe valve")


def _fusible(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire-safe emergency valve (UL 842): spring in its bonnet, a lever held open by a fusible link to a bracket."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.8, 6.2)) * r + 0.035
    wide, n, x = 1.45 * r + 0.004, style.round(1.45 * r), length / 2
    core = [(1.05 * r, 0.12 * length), (wide, 0.36 * length), (wide, 0.64 * length), (1.05 * r, 0.88 * length)]
    parts = [body(screwed(dn, style, length, core), moved(cylinder(0.85 * wide, 0.0, 1.4 * wide, n), at(x)))]
    low, tall = 1.4 * wide, float(rng.uniform(1.2, 2.2)) * wide
    hood = [
        hexagon(2.0 * wide, low - 0.002, low + 0.5 * wide),
        turned([(0.7 * wide, low + 0.4 * wide), (0.65 * wide, low + tall), (0.35 * wide, low + tall + 0.2 * wide)], n),
    ]
    top = low + tall + 0.2 * wide
    parts.append(bonnet(moved(merge(hood), at(x))))
    rise = 0.9 * wide
    parts.append(piece("valve stem", moved(cylinder(0.14 * wide + 0.001, top - 0.002, top + rise, 8), at(x))))
    long = float(rng.uniform(3.2, 5.0)) * wide
    post_x, z = x - 1.2 * wide, top + rise
    arms = [
        box((0.35 * wide, 0.12 * wide, z - low + 0.2 * wide), (post_x, s * 0.25 * wide, (z + low) / 2)) for s in (-1, 1)
    ]
    fork = merge([*arms, box((1.2 * wide, 0.62 * wide, 0.2 * wide), (x - 0.75 * wide, 0, low + 0.1 * wide))])
    parts.append(piece("yoke", fork))
    pin = along("y", cylinder(0.09 * wide, -0.34 * wide, 0.34 * wide, 8), post_x, 0, z)
    bar = box((long, 0.3 * wide, 0.22 * wide), (post_x + long / 2 - 0.2 * wide, 0, z))
    parts += [piece("valve stem", pin), piece("lever", bar, color="handle", bundle="")]
    tip = post_x + long - 0.5 * wide
    foot = min(tip, length - 0.12 * length)
    base = 1.1 * r
    link_low, link_high = base + 0.3 * (z - base), base + 0.62 * (z - base)
    wires = [
        rod((foot, 0, base - 0.003), (tip, 0, link_low + 0.002), 0.06 * wide + 0.0008, 6),
        rod((tip, 0, link_high - 0.002), (tip, 0, z), 0.06 * wide + 0.0008, 6),
    ]
    parts.append(piece("lever", *wires))
    plates = [
        box((0.5 * wide, 0.05 * wide + 0.001, link_high - link_low), (tip, 0, (link_low + link_high) / 2)),
        box((0.4 * wide, 0.09 * wide + 0.001, 0.5 * (link_high - link_low)), (tip, 0, (link_low + link_high) / 2)),
    ]
    parts.append(piece("lever", *plates, color="dial"))
    return Model(parts, round(length, 6), "welded", "shut-off valve")


def _quick(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A quick-opening gate or blow-off valve: sliding stem through a bonnet, a hand lever on links about a fulcrum."""
    length, r = FACE_TO_FACE["gate"][dn], PIPES[dn].radius
    neck, thick = hub_radius(dn), plate_thickness(dn)
    wide, x = max(1.2 * r + 0.006, 1.03 * neck), length / 2
    shell = flanged_body(
        dn,
        style,
        length,
        [(neck, thick + 0.05 * length), (wide, 0.4 * length), (wide, 0.6 * length), (neck, 0.95 * length - thick)],
    )
    n = style.round(wide)
    seat, plate = max(2.0 * r + 0.02, 0.5 * FLANGES[dn].outer + 0.012), 0.009 + 0.08 * r
    flat = bool(rng.integers(2))
    chest = turned([(0.95 * wide, 0.0), (0.95 * wide, seat - 0.003)], n)
    if flat:
        chest = moved(extrude(rounded_rectangle(1.3 * wide, 2.1 * wide, 0.3 * wide, 3), 0.0, seat - 0.003), np.eye(4))
    parts = [
        body(shell, moved(chest, at(x))),
        *placed(cover(1.2 * wide + 0.006, seat, plate, 8, style, flat, 0.3 * r), at(x)),
    ]
    top = seat + plate + 0.3 * r
    box_ = turned([(0.45 * wide, top - 0.3 * r), (0.4 * wide, top + 0.9 * r)], n)
    gland = [
        box((0.5 * wide, 1.5 * wide, 0.010 + 0.05 * r), (0, 0, top + 0.9 * r + 0.004)),
        cylinder(0.3 * wide, top + 0.85 * r, top + 1.3 * r + 0.01, 12),
    ]
    lift = float(rng.uniform(0.8, 1.8)) * r + 0.02
    high = top + 1.3 * r + 0.01 + lift
    parts += [bonnet(moved(box_, at(x))), piece("gland", moved(merge(gland), at(x)))]
    parts.append(piece("valve stem", moved(cylinder(0.004 + 0.09 * r, top, high, 10), at(x))))
    side = float(rng.choice([-1, 1]))
    arm_x, t = x - side * (1.1 * wide + 0.01), 0.004 + 0.05 * r
    stand = [
        box((2.2 * t + 0.25 * wide, 1.2 * t, high - seat), (arm_x, s * 2.2 * t, (high + seat) / 2)) for s in (-1, 1)
    ]
    stand.append(box((0.5 * wide, 7 * t, 0.008 + 0.03 * r), (arm_x, 0, seat + plate / 2)))
    pins = [along("y", cylinder(0.7 * t, -3 * t, 3 * t, 8), px, 0, high - t) for px in (arm_x, x)]
    clevis = box((3 * t, 3.4 * t, 5 * t), (x, 0, high - 1.5 * t))
    parts += [piece("yoke", *stand, color="valve"), piece("valve stem", *pins, clevis)]
    long, tilt = float(rng.uniform(4.0, 6.5)) * wide + 0.1, float(rng.uniform(0.0, 0.25))
    bar = [
        box((long, 1.6 * t, 3.0 * t), (long / 2 - 3 * t, 0, 0)),
        along("x", cylinder(1.6 * t, long - 0.25 * long, long, 10)),
    ]
    turn = at(arm_x, 0, high - t) @ spun("z", 0.0 if side > 0 else np.pi) @ spun("y", -0.2 * tilt)
    parts.append(piece("lever", moved(merge(bar), turn), color="handle", bundle=""))
    return Model(parts, length, kind="gate valve")


def _landing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire landing valve (BS 5041-1): flanged inlet, oblique globe, instantaneous outlet, cap, wheel."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    n, wide = style.round(1.5 * r), 1.45 * r + 0.006
    center = thick + 0.02 + 1.5 * wide
    neck = disc_flange(dn, style, center - 0.4 * wide)
    parts = [body(neck, moved(ball(1.08 * wide, n), at(0, 0, center)))]
    lean = float(rng.choice([0.6, 0.785, np.pi / 2]))
    up = at(0, 0, center) @ spun("x", lean - 0.785 if lean > 1 else -0.15)
    top = 1.5 * wide
    head = [body(turned([(0.85 * wide, 0.3 * wide), (0.85 * wide, top)], n))]
    head += [
        bonnet(
            turned(
                [
                    (1.05 * wide, top - 0.15 * wide),
                    (1.05 * wide, top + 0.2 * wide),
                    (0.55 * wide, top + 0.4 * wide),
                    (0.45 * wide, top + 1.3 * wide),
                ],
                n,
            )
        )
    ]
    head += [piece("gland", hexagon(0.8 * wide, top + 1.25 * wide, top + 1.6 * wide))]
    head += [
        stem(top + 1.55 * wide, top + 2.8 * wide, 0.15 * wide, style),
        wheel(float(rng.uniform(1.4, 2.0)) * wide + 0.01, 0, top + 2.2 * wide, style, rng),
    ]
    parts += placed(head, up)
    mouth = at(0, 0, center) @ spun("x", -lean - 0.5)
    out = turned(
        [
            (0.9 * r, 0.5 * wide),
            (0.9 * r, 1.9 * wide),
            (1.35 * r, 2.0 * wide),
            (1.35 * r, 2.9 * wide),
            (1.15 * r, 3.0 * wide),
        ],
        n,
    )
    lugs = [along("x" if s > 0 else "-x", cylinder(0.18 * r, 1.3 * r, 1.7 * r, 8), 0, 0, 2.5 * wide) for s in (-1, 1)]
    parts.append(body(moved(merge([out, *lugs]), mouth)))
    cap = [cylinder(1.2 * r, 2.99 * wide, 3.4 * wide, n), box((2.2 * r, 0.3 * r, 0.3 * wide), (0, 0, 3.5 * wide))]
    parts.append(other("Pipe assembly", "pipe cap", "rubber", moved(merge(cap), mouth), own=True))
    return Model(laid(parts), kind="globe valve")


def _tank_bottom(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flush tank-bottom valve (DIN 28137 type): pad flange, disc in its mouth, slanting outlet, stem."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    n, wide = style.round(1.4 * r), 1.35 * r + 0.006
    center = thick + 0.3 * FLANGES[dn].outer + wide
    angle = float(rng.choice([0.785, 1.047]))
    parts = [body(disc_flange(dn, style, center), moved(ball(1.12 * wide, n), at(0, 0, center)))]
    reach = 0.62 * FLANGES[dn].outer + 0.5 * wide + thick
    outlet = moved(disc_flange(dn, style, reach), at(0, 0, -reach))
    parts.append(body(moved(outlet, at(0, 0, center) @ spun("x", np.pi - angle))))
    plug = turned([(0.8 * r, -0.0008), (0.95 * r, 0.006), (0.95 * r, 0.3 * r), (0.3 * r, 0.6 * r)], n)
    parts.append(piece("valve disc", plug))
    seat, plate = 1.6 * wide, 0.010 + 0.08 * r
    head = [
        body(cylinder(0.8 * wide, 0.4 * wide, seat - 0.003, n)),
        *cover(1.15 * wide + 0.006, seat, plate, 4, style, bool(rng.integers(2))),
    ]
    top, tall = seat + plate, 0.06 + 1.4 * r
    if rng.random() < 0.7:
        arms = [box((0.02 + 0.1 * r, 0.008 + 0.06 * r, tall), (0, s * 0.6 * wide, top + tall / 2)) for s in (-1, 1)]
        head.append(piece("yoke", *arms, box((0.03 + 0.15 * r, 1.4 * wide, 0.012), (0, 0, top + tall)), color="valve"))
        head.append(piece("gland", cylinder(0.4 * wide, top - 0.001, top + 0.35 * tall, 12)))
        head += [
            stem(top, top + tall + 0.05 + 0.5 * r, 0.005 + 0.1 * r, style),
            wheel(0.04 + 1.1 * r, 0, top + tall + 0.02, style, rng),
        ]
    else:
        can = 1.3 * wide + 0.01
        m = style.round(can)
        head.append(piece("yoke", ring(0.5 * wide, 0.7 * wide, top - 0.001, top + 0.4 * tall, n), color="valve"))
        shape = [
            (can, top + 0.4 * tall),
            (can, top + 0.5 * tall),
            (0.9 * can, top + 0.5 * tall),
            (0.9 * can, top + 1.6 * tall),
            (can, top + 1.6 * tall),
            (can, top + 1.7 * tall),
        ]
        head.append(piece("actuator", turned(shape, m), bundle="actuator"))
        head.append(piece("valve stem", cylinder(0.1 * wide + 0.003, top, top + 0.42 * tall, 8)))
    parts += placed(head, at(0, 0, center) @ spun("x", 0.55))  # away from the outlet
    return Model(laid(parts), kind="tank valve")


def _sampler(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sampling valve between flanges (wafer): a thick ring, its neck with a needle head and a bent spout."""
    size, bore = FLANGES[dn], PIPES[dn].bore
    outer = 0.5 * (size.circle - size.bolt) - 0.0005
    length, n = 0.03 + 0.15 * PIPES[dn].radius, style.round(size.outer / 2)
    length = round(length, 6)
    r = float(rng.uniform(0.008, 0.011))
    stub = box(
        (min(2.6 * r, 0.9 * length), 2.6 * r, 0.5 * size.outer + 0.055 - 0.9 * outer),
        (length / 2, 0, (0.5 * size.outer + 0.055 + 0.9 * outer) / 2),
    )
    parts = [body(along("x", ring(bore, outer, 0.0, length, n)), stub)]
    top = 0.5 * size.outer + 0.055
    head = [
        bonnet(hexagon(2.2 * r, top - 0.001, top + 1.6 * r), cylinder(0.9 * r, top + 1.5 * r, top + 4.0 * r, 12)),
        piece("gland", hexagon(1.6 * r, top + 3.9 * r, top + 4.8 * r)),
    ]
    head.append(piece("valve stem", cylinder(0.35 * r, top + 4.7 * r, top + 7.5 * r, 8)))
    head.append(wheel(0.012 + 2.0 * r, 0, top + 6.4 * r, style, rng)) if rng.random() < 0.6 else head.extend(
        drive(0, top + 7.0 * r, r, style, rng, ("bar", "lever"))
    )
    parts += placed(head, at(length / 2))
    z = 0.5 * size.outer + 0.045
    spout = bend([(length / 2, 1.2 * r, z), (length / 2, 6 * r, z), (length / 2, 6 * r, z - 3.6 * r)], 2.5 * r)
    parts.append(body(rope(spout, 0.6 * r, 12)))
    return Model(parts, length, "wafer", "sampling valve")


_MOST = tuple(dn for dn in MID if dn >= 25)

BLOCKS: tuple[Family, ...] = (
    valve_family("ball valve/double block and bleed", _block_bleed, tuple(dn for dn in MID if dn <= 80)),
    valve_family("globe valve/balancing flanged", _balancing, _MOST),
    valve_family("shut-off valve/fusible link", _fusible, SMALL),
    valve_family("gate valve/quick opening", _quick, tuple(dn for dn in MID if dn <= 100)),
    valve_family("globe valve/fire landing", _landing, (50, 65, 80), "head"),
    valve_family("tank valve/flush bottom", _tank_bottom, _MOST, "head"),
    valve_family("sampling valve/wafer", _sampler, _MOST),
)
