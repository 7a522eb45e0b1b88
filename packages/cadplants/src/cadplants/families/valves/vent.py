"""Backflow preventers, air valves, vacuum breakers and tank vents."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import wheel
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
)
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["VENTS"]


def _test_cocks(
    places: list[tuple[float, float]], r: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Part]:
    """Small ball cocks upon a body for testing, each at a place and height."""
    parts: list[Part] = []
    for x, z in places:
        stub = merge(
            [
                cylinder(0.006, z - 0.008, z + 0.012, 8),
                hexagon(0.018, z + 0.008, z + 0.03),
                cylinder(0.007, z + 0.028, z + 0.045, 8),
            ]
        )
        key = box((0.028, 0.004, 0.008), (0.014, 0.012, z + 0.019))
        shank = along("y", cylinder(0.003, 0.0, 0.012, 6), 0, 0, z + 0.019)
        parts += placed([body(stub), piece("lever", key, shank, color="handle", bundle="")], at(x))
    return parts


def _backflow(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A reduced-pressure backflow preventer (EN 12729): two check chests with covers, a relief valve hung between."""
    r = PIPES[dn].radius
    length = float(rng.uniform(5.0, 6.5)) * PIPES[dn].outer + 0.12
    thick, neck = plate_thickness(dn), hub_radius(dn)
    wide = 1.5 * r + 0.012
    middle = [(neck, thick + 0.04 * length), (wide, 0.18 * length), (wide, 0.36 * length),
              (0.85 * wide, 0.42 * length), (0.85 * wide, 0.52 * length), (wide, 0.6 * length), (wide, 0.8 * length),
              (neck, length - thick - 0.04 * length)]  # fmt: skip
    parts = [body(flanged_body(dn, style, length, middle))]
    tilt = float(rng.choice([0.0, 0.0, 0.6]))
    corners, n = bool(rng.integers(2)), style.round(wide)
    seat = (1.35 if tilt == 0 else 1.7) * wide
    for x in (0.27 * length, 0.7 * length):
        pose = at(x) @ spun("y", tilt)
        chest = cylinder(0.92 * wide, 0.0, seat - 0.003, n)
        parts += placed(
            [body(chest), *cover(1.15 * wide + 0.006, seat, 0.008 + 0.1 * r, 8, style, corners, 0.2 * r)], pose
        )
    x = 0.47 * length
    drop = [
        (0.6 * wide, 0.0),
        (0.55 * wide, 1.1 * wide),
        (1.2 * wide, 1.2 * wide),
        (1.2 * wide, 1.5 * wide),
        (0.7 * wide, 1.8 * wide),
        (0.6 * wide, 2.6 * wide),
    ]
    parts.append(body(along("-z", turned(drop, n), x)))
    parts.append(bolting(along("-z", bolt_circle(8, 1.1 * wide, 0.008, 1.22 * wide, 1.48 * wide), x)))
    if rng.random() < 0.5:
        sense = bend(
            [
                (0.3 * length, 0.9 * wide, 0),
                (0.3 * length, 1.9 * wide, -0.2 * wide),
                (x, 1.9 * wide, -1.35 * wide),
                (x, 1.1 * wide, -1.35 * wide),
            ],
            0.3 * wide,
            3,
        )
        parts.append(other("Pipe assembly", "pipe", "pipe", rope(sense, 0.006, 8), own=True))
    parts += _test_cocks(
        [(0.12 * length, 0.98 * neck), (0.47 * length, 0.85 * wide), (0.88 * length, 0.98 * neck)], r, style, rng
    )
    return Model(parts, round(length, 6), kind="backflow preventer")


def _backflow_small(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded backflow preventer (EN 14367 type CA or BA): union ends, slanting or upright caps, a tundish below."""
    r = PIPES[dn].radius
    length = float(rng.uniform(6.0, 8.5)) * r + 0.06
    n, wide = style.round(1.5 * r), 1.45 * r + 0.004
    core = [(1.1 * r, 0.12 * length), (wide, 0.28 * length), (wide, 0.74 * length), (1.1 * r, 0.88 * length)]
    parts = [body(screwed(dn, style, length, core, end=0.14 * length))]
    for x in (0.15 * length, 0.8 * length):
        nut = along("x", hexagon(3.4 * r + 0.006, x, x + 0.07 * length))
        parts.append(other("Pipe assembly", "union", "valve", nut, own=True))
    for x in (0.36 * length, 0.66 * length)[: int(rng.integers(1, 3))]:
        cap = merge([cylinder(0.7 * wide, 0.5 * wide, 1.4 * wide, n), hexagon(1.1 * wide, 1.35 * wide, 1.75 * wide)])
        parts.append(bonnet(moved(cap, at(x))))
    mid = 0.51 * length
    spout = along("-z", turned([(0.5 * wide, 0.0), (0.5 * wide, 1.7 * wide)], n), mid)
    funnel = turned(
        [(1.2 * wide, 1.5 * wide), (1.2 * wide, 2.2 * wide), (0.55 * wide, 3.4 * wide), (0.55 * wide, 4.4 * wide)], n
    )
    legs = merge([box((0.15 * wide, 0.12 * wide, 0.7 * wide), (s * 0.8 * wide, 0, 1.3 * wide)) for s in (-1, 1)])
    parts += [
        body(spout),
        body(along("-z", merge([funnel, legs, box((1.7 * wide, 0.3 * wide, 0.12 * wide), (0, 0, wide))]), mid)),
    ]
    places = [(0.25 * length, 1.0 * r), (mid, 0.95 * wide)][: int(rng.integers(1, 3))]
    parts += _test_cocks(places, r, style, rng)
    return Model(parts, round(length, 6), "welded", "backflow preventer")


def _bowl(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An air and vacuum valve (EN 1074-4): a bowl on a flange, a bolted cover, a cowl, elbow or screen on top."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    wide, tall = float(rng.uniform(1.5, 2.3)) * r + 0.025, float(rng.uniform(1.6, 3.2)) * r + 0.05
    n, low = style.round(wide), thick + 0.015 + 0.2 * r
    if rng.random() < 0.5:
        shell = [(0.9 * hub_radius(dn), low - 0.01), (wide, low + 0.7 * wide), (wide, low + tall)]
    else:
        shell = [(0.6 * wide, low), (wide, low + 0.02), (wide, low + tall)]
    seat = low + tall + 0.003
    plate = 0.01 + 0.05 * wide
    parts = [body(disc_flange(dn, style, low + 0.01), turned(shell, n))]
    parts += cover(1.22 * wide + 0.008, seat, plate, int(rng.choice([4, 6, 8])), style, bool(rng.random() < 0.3))
    top, kind, gap = seat + plate, int(rng.integers(4)), 0.25 * r + 0.008
    if kind == 0:
        legs = around(cylinder(0.005, top - 0.001, top + gap + 0.001, 8), 4, 0.7 * wide)
        parts.append(
            bonnet(
                turned(
                    [(0.9 * wide, top + gap), (0.9 * wide, top + gap + 0.006), (0.3 * wide, top + gap + 0.3 * wide)], n
                ),
                legs,
            )
        )
    elif kind == 1:
        mesh = ring(0.75 * r, 0.8 * r, top - 0.001, top + 2 * gap, n)
        lid = turned([(r, top + 2 * gap), (r, top + 2 * gap + 0.008), (0.5 * r, top + 2 * gap + 0.016)], n)
        posts = around(cylinder(0.003 + 0.03 * r, top - 0.001, top + 2 * gap + 0.001, 8), 3, 0.9 * r)
        parts += [bonnet(lid, posts), other("Pipe assembly", "strainer", "trim", mesh, own=True)]
    elif kind == 2:
        path = bend(
            [(0, 0, top - 0.002), (0, 0, top + 1.4 * r), (0, 1.8 * r, top + 1.4 * r), (0, 1.8 * r, top + 0.6 * r)],
            0.8 * r,
        )
        parts.append(bonnet(rope(path, 0.6 * r, n)))
    else:
        small = turned(
            [(0.35 * wide, top - 0.001), (0.35 * wide, top + 0.6 * wide), (0.15 * wide, top + 0.75 * wide)], n
        )
        nozzle = along("y", hexagon(0.25 * wide + 0.004, 0.3 * wide, 0.5 * wide), 0, 0, top + 0.4 * wide)
        parts.append(bonnet(small, nozzle))
    if rng.random() < 0.4:
        z = low + 0.75 * tall
        cock = [along("y", hexagon(0.02, 0.95 * wide, 0.99 * wide + 0.025), 0, 0, z)]
        parts += [
            body(*cock),
            piece("lever", box((0.05, 0.006, 0.01), (0.015, wide + 0.026, z)), color="handle", bundle=""),
        ]
    return Model(laid(parts), kind="air valve")


def _double(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A double-orifice air valve: a big and a small chamber side by side on one base, covers, an isolating wheel."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    big, small = 1.7 * r + 0.022, float(rng.uniform(0.9, 1.7)) * r + 0.02
    low = thick + 0.02 + 1.1 * r
    n = style.round(big)
    parts = [
        body(
            disc_flange(dn, style, low),
            along("x", cylinder(0.9 * r + 0.01, -big - 0.3 * r, small + 0.3 * r, n), 0, 0, low - 0.2 * r),
        )
    ]
    for x, wide, tall in ((-0.98 * big, big, 2.2 * big), (0.98 * small, small, float(rng.uniform(1.4, 2.2)) * small)):
        shell = turned([(0.6 * wide, low - 0.5 * r), (wide, low + 0.4 * wide), (wide, low + tall - 0.003)], n)
        plate = 0.008 + 0.05 * wide
        one = [body(shell), *cover(1.2 * wide + 0.007, low + tall, plate, 6, style)]
        top = low + tall + plate
        if wide == big:
            one.append(
                bonnet(
                    turned(
                        [
                            (0.8 * r, top - 0.001),
                            (0.8 * r, top + 0.4 * r),
                            (1.0 * r, top + 0.4 * r),
                            (0.9 * r, top + 0.7 * r),
                        ],
                        n,
                    )
                )
            )
        else:
            one.append(
                bonnet(
                    hexagon(0.5 * small, top - 0.001, top + 0.3 * small),
                    cylinder(0.1 * small, top, top + 0.5 * small, 8),
                )
            )
        parts += placed(one, at(x))
    if rng.random() < 0.6:
        z = low - 0.2 * r
        reach = 0.9 * r + 0.01
        shaft = along("-y", cylinder(0.006 + 0.06 * r, 0.0, reach + 0.07 + 0.5 * r, 10), 0, 0, z)
        gland = along("-y", hexagon(0.03 + 0.3 * r, 0.8 * reach, reach + 0.02), 0, 0, z)
        rim = placed([wheel(0.03 + 0.8 * r, 0, reach + 0.05 + 0.4 * r, style, rng)], at(0, 0, z) @ spun("x", np.pi / 2))
        parts += [piece("valve stem", shaft), piece("gland", gland), *rim]
    return Model(laid(parts), kind="air valve")


def _plastic_air(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic combination air valve on an outlet: hexagon base, ribbed barrel, screwed dome, drain elbow."""
    r = float(rng.uniform(0.025, 0.05))
    n, tall = style.round(r), float(rng.uniform(1.5, 3.0)) * r
    base = [
        cylinder(0.009, 0.0, 0.02, n),
        hexagon(0.034, 0.014, 0.034),
        turned([(0.6 * r, 0.032), (1.0 * r, 0.04), (1.0 * r, 0.04 + tall)], n),
    ]
    if rng.random() < 0.6:
        base.append(around(box((0.1 * r, 0.12 * r, 0.9 * tall), (0, 0, 0.04 + 0.5 * tall)), 8, r))
    top = 0.04 + tall
    high = float(rng.uniform(0.5, 1.4)) * r
    crown = [
        turned(
            [
                (1.12 * r, top - 0.008),
                (1.12 * r, top + 0.006),
                (0.9 * r, top + 0.008),
                (0.8 * r, top + high),
                (0.4 * r, top + 1.2 * high),
            ],
            n,
        )
    ]
    side = along(
        "y",
        merge([cylinder(0.3 * r, 0.5 * r, 1.4 * r, n), ring(0.2 * r, 0.34 * r, 1.3 * r, 1.7 * r, n)]),
        0,
        0,
        top + 0.6 * high,
    )
    return Model([body(*base), bonnet(*crown, side)], kind="air valve")


def _vacuum(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vacuum breaker on an outlet: hexagon body, slotted cowl or mushroom cap with a disc beneath."""
    r = float(rng.uniform(0.010, 0.018))
    n, low = style.round(2 * r), 0.018 + 1.4 * r
    stem = [cylinder(0.9 * r, 0.0, 0.024, n), hexagon(2.8 * r, 0.016, low)]
    stem.append(turned([(1.1 * r, low - 0.001), (1.9 * r, low + 1.0 * r), (1.9 * r, low + 1.4 * r)], n))
    top, gap = low + 1.4 * r, float(rng.uniform(0.4, 1.0)) * r
    posts = around(box((0.3 * r, 0.3 * r, gap + 0.002), (0, 0, top + gap / 2)), int(rng.choice([3, 4, 6])), 1.6 * r)
    cap = turned(
        [
            (2.0 * r, top + gap),
            (2.1 * r, top + gap + 0.2 * r),
            (1.5 * r, top + gap + 1.0 * r),
            (0.4 * r, top + gap + 1.2 * r),
        ],
        n,
    )
    disc = cylinder(1.2 * r, top - 0.001, top + 0.3 * r, n)
    return Model([body(*stem), bonnet(posts, cap), piece("valve disc", disc)], kind="vacuum breaker")


def _pallet_hood(wide: float, high: float, n: int, rng: np.random.Generator) -> list[Part]:
    """What closes a pallet chamber above: a weather hood, or a bolted lid with a grip."""
    if rng.random() < 0.5:
        shape = [(1.35 * wide, high - 0.35 * wide), (1.35 * wide, high + 0.15 * wide), (0.5 * wide, high + 0.45 * wide)]
        return [bonnet(turned(shape, n))]
    grip = along("y", rod((0, 0, -0.3 * wide), (0, 0, 0.3 * wide), 0.06 * wide, 6), 0, 0, high + 0.14 * wide)
    screws = around(cylinder(0.004, high - 0.01, high + 0.08 * wide + 0.008, 6), 6, 1.0 * wide)
    return [bonnet(cylinder(1.1 * wide, high - 0.001, high + 0.08 * wide, n), grip), bolting(screws)]


def _breather(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure and vacuum vent on a tank's nozzle (API 2000): two pallet chambers under hoods on a flanged chest."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    wide, n = 1.5 * r + 0.02, style.round(1.5 * r)
    low = thick + 0.02 + 0.3 * r
    span = 1.35 * wide
    chest = [disc_flange(dn, style, low + 0.3 * r)]
    boxy = rng.random() < 0.5
    if boxy:
        chest.append(box((2 * span + 2.0 * wide, 2.0 * wide, 1.3 * wide), (0, 0, low + 0.65 * wide)))
    else:
        chest.append(
            along(
                "x",
                turned(
                    [
                        (0.5 * wide, -span - 0.7 * wide),
                        (0.8 * wide, -span - 0.4 * wide),
                        (0.8 * wide, span + 0.4 * wide),
                        (0.5 * wide, span + 0.7 * wide),
                    ],
                    n,
                ),
                0,
                0,
                low + 0.65 * wide,
            )
        )
    parts = [body(*chest)]
    top = low + 1.2 * wide
    heights = (0.7 * wide, float(rng.uniform(0.7, 1.6)) * wide)
    for sign, tall in zip((-1, 1), heights, strict=True):
        ring_ = turned([(0.85 * wide, top - 0.5 * wide), (0.85 * wide, top + tall)], n)
        high = top + tall
        parts += placed([body(ring_), *_pallet_hood(wide, high, n, rng)], at(sign * span))
    side = 1.0 * wide if boxy else 0.75 * wide
    screen = along("y", ring(0.5 * wide, 0.62 * wide, 0.7 * side, side + 0.2 * wide, n), span, 0, low + 0.65 * wide)
    parts.append(body(screen))
    return Model(laid(parts), kind="breather valve")


def _end_of_line(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An end-of-line vent with a flame arrester (EN ISO 16852): a wide housing of rings, stay bolts, a weather hood."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    wide, n = float(rng.uniform(1.6, 2.2)) * r + 0.02, style.round(1.8 * r)
    low = thick + 0.02 + 0.9 * r
    cone = turned([(hub_radius(dn), thick + 0.01), (wide, low), (1.15 * wide, low), (1.15 * wide, low + 0.014)], n)
    parts = [body(disc_flange(dn, style, thick + 0.015), cone)]
    z, bank = low + 0.014, float(rng.uniform(0.02, 0.04))
    for _k in range(int(rng.integers(1, 4))):
        parts.append(body(cylinder(1.02 * wide, z, z + bank, n)))
        z += bank
    parts.append(body(cylinder(1.15 * wide, z, z + 0.014, n)))
    count, stay = int(rng.choice([4, 6, 8])), 0.005 + 0.02 * wide
    tall = float(rng.uniform(0.5, 1.2)) * wide
    rods = around(
        merge(
            [cylinder(stay, low - 0.012, z + 0.014 + tall, 8), hexagon(3.4 * stay, z + 0.014, z + 0.014 + 1.6 * stay)]
        ),
        count,
        1.09 * wide,
    )
    parts.append(Part(rods, "stud", "fastener", "valve body", "Connection assembly"))
    top = z + 0.014 + tall
    if rng.random() < 0.5:
        hood = turned(
            [
                (1.4 * wide, top - 0.4 * tall),
                (1.4 * wide, top - 0.001),
                (0.6 * wide, top + 0.35 * wide),
                (0.1 * wide, top + 0.45 * wide),
            ],
            n,
        )
    else:
        hood = turned([(1.3 * wide, top - 0.002), (1.3 * wide, top + 0.006), (0.2 * wide, top + 0.3 * wide)], n)
    disc = merge([cylinder(0.8 * wide, z + 0.0135, z + 0.026, n), cylinder(0.05 * wide + 0.003, z + 0.02, top, 8)])
    parts += [bonnet(hood), piece("valve disc", disc)]
    return Model(laid(parts), kind="breather valve")


def _hatch(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An emergency relief hatch on a tank's nozzle (API 2000): a wide seat, a lid on a hinge, a bale handle."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    wide, n = float(rng.uniform(1.15, 1.6)) * r + 0.01, style.round(1.3 * r)
    low = thick + 0.02 + 0.4 * r
    neck = turned([(1.03 * r, thick + 0.005), (1.03 * r, low - 0.01), (wide, low), (wide, low + 0.012)], n)
    seat, t = low + 0.012, 0.01 + 0.05 * r
    lift = float(rng.choice([0.0, 0.0, 0.0, 0.5, 1.2]))
    hinge = (-1.12 * wide, 0.0, seat + 0.5 * t)
    turn = at(*hinge) @ spun("y", -lift) @ at(*(-v for v in hinge))
    lid = [cylinder(1.02 * wide, seat, seat + t, n)]
    if rng.random() < 0.6:
        lid.append(turned([(0.8 * wide, seat + 0.9 * t), (0.5 * wide, seat + 0.35 * wide)], n))
    arm = box((0.4 * wide, 0.3 * wide, 0.6 * t), (-0.98 * wide, 0, seat + 0.8 * t))
    bow = bend(
        [
            (0.3 * wide, -0.3 * wide, seat + 0.5 * t),
            (0.3 * wide, -0.3 * wide, seat + 0.6 * wide),
            (0.3 * wide, 0.3 * wide, seat + 0.6 * wide),
            (0.3 * wide, 0.3 * wide, seat + 0.5 * t),
        ],
        0.12 * wide,
    )
    ears = [
        box((0.3 * wide, 0.1 * wide, 1.6 * t + 0.012), (-1.1 * wide, s * 0.22 * wide, seat - 0.2 * t)) for s in (-1, 1)
    ]
    pin = along("y", cylinder(0.3 * t, -0.35 * wide, 0.35 * wide, 8), *hinge)
    parts = [
        body(disc_flange(dn, style, thick + 0.01), neck, *ears),
        piece("valve disc", moved(merge([*lid, arm]), turn), color="valve"),
        piece("valve stem", pin),
        piece("lever", moved(rope(bow, 0.005 + 0.03 * wide, 8), turn), color="handle", bundle=""),
    ]
    return Model(laid(parts), kind="breather valve")


_WIDE = tuple(dn for dn in SIZES if dn >= 50)

VENTS: tuple[Family, ...] = (
    valve_family("backflow preventer/reduced pressure", _backflow, tuple(dn for dn in SIZES if 50 <= dn <= 200)),
    valve_family("backflow preventer/threaded", _backflow_small, SMALL),
    valve_family("air valve/bowl", _bowl, tuple(dn for dn in MID if dn >= 25), "head"),
    valve_family("air valve/double orifice", _double, tuple(dn for dn in MID if dn >= 40), "head"),
    valve_family("air valve/plastic", _plastic_air, SIZES, "tap"),
    valve_family("vacuum breaker/cowl", _vacuum, SIZES, "tap"),
    valve_family("breather valve/pallet", _breather, _WIDE, "head"),
    valve_family("breather valve/flame arrester", _end_of_line, _WIDE, "head"),
    valve_family("breather valve/hatch", _hatch, tuple(dn for dn in SIZES if dn >= 80), "head", 0.7),
)
