from __future__ import annotations

import numpy as np

from cadplants.families.valves.parts import (
    MID,
    bend,
    body,
    bonnet,
    branch,
    cover,
    hub_radius,
    laid,
    other,
    piece,
    spring,
)
from cadplants.families.valves.valve import disc_flange, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rope, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["RELIEFS"]


def _angle_body(dn: int, out: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A safety valve's body upon its inlet flange: chest, outlet to +y, bonnet seat; also seat and chest radius [m]."""
    r, n = PIPES[dn].radius, style.round(1.7 * PIPES[out].radius)
    wide = max(1.05 * PIPES[out].radius, 1.4 * r) + 0.006
    center = 0.5 * FLANGES[out].outer + plate_thickness(dn) + 0.015 + 0.3 * r
    reach = center * float(rng.uniform(0.85, 1.05)) + 0.3 * wide
    neck = disc_flange(dn, style, center - 0.7 * wide)
    seat = center + wide * float(rng.uniform(0.95, 1.25))
    low = (0.9 * hub_radius(dn), center - 1.15 * wide)
    if rng.random() < 0.5:
        shell = turned([low, (wide, center - 0.5 * wide), (wide, seat - 0.003)], n)
    else:
        low = (0.7 * wide, center - 1.0 * wide)
        shell = turned(
            [low, (1.1 * wide, center - 0.2 * wide), (1.1 * wide, center + 0.2 * wide), (0.8 * wide, seat - 0.003)], n
        )
    solids = [neck, shell, branch(out, style, reach, "y", (0, 0, center))]
    if rng.random() < 0.5:
        solids.append(box((0.012 + 0.1 * r, 0.6 * reach, 0.7 * wide), (0, 0.45 * reach, center - 0.95 * wide)))
    if rng.random() < 0.3:
        solids.append(along("-y", hexagon(0.3 * r + 0.014, 0.8 * wide, 1.1 * wide + 0.012), 0, 0, center - 0.3 * wide))
    return [body(*solids)], seat, wide


def _sizes(dn: int, rng: np.random.Generator) -> int:
    return SIZES[min(SIZES.index(dn) + int(rng.integers(1, 3)), len(SIZES) - 1)]


def _cap(top: float, wide: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A safety valve's cap upon a height: closed, open lever in a fork, or packed lever on a shaft."""
    n, tall = style.round(0.5 * wide), 1.1 * wide
    kind = int(rng.integers(3))
    if kind == 0:
        return [
            bonnet(cylinder(0.55 * wide, top - 0.001, top + tall, n), hexagon(0.7 * wide, top + tall, top + 1.3 * tall))
        ]
    stout = turned(
        [
            (0.6 * wide, top - 0.001),
            (0.6 * wide, top + 0.25 * tall),
            (0.5 * wide, top + 0.3 * tall),
            (0.5 * wide, top + tall),
        ],
        n,
    )
    side, long = float(rng.choice([-1, 1])), float(rng.uniform(2.5, 4.5)) * wide
    if kind == 1:
        fork = [
            box((0.1 * wide, 0.5 * wide, 0.6 * tall), (s * 0.25 * wide, -side * 0.3 * wide, top + 1.15 * tall))
            for s in (-1, 1)
        ]
        pin = along("x", cylinder(0.07 * wide, -0.34 * wide, 0.34 * wide, 8), 0, -side * 0.35 * wide, top + 1.3 * tall)
        path = [
            (0, -side * 0.5 * wide, top + 1.3 * tall),
            (0, side * 0.5 * long, top + 1.2 * tall),
            (0, side * 0.7 * long, top - 0.3 * long),
        ]
        grip = rope(bend(path, 0.12 * long), 0.13 * wide, 8)
        return [bonnet(stout, *fork), piece("valve stem", pin), piece("lever", grip, color="handle", bundle="")]
    boss = along("x", cylinder(0.3 * wide, 0.2 * wide, 0.7 * wide, 12), 0, 0, top + 0.65 * tall)
    shaft = along("x", cylinder(0.1 * wide, 0.4 * wide, 1.05 * wide, 8), 0, 0, top + 0.65 * tall)
    gland = along("x", hexagon(0.4 * wide, 0.7 * wide, 0.82 * wide), 0, 0, top + 0.65 * tall)
    arm = box((0.12 * wide, long, 0.35 * wide), (0.95 * wide, side * 0.44 * long, top + 0.65 * tall))
    return [
        bonnet(stout, boss),
        piece("valve stem", shaft),
        piece("gland", gland),
        piece("lever", arm, color="handle", bundle=""),
    ]


def _full_lift(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A full-lift safety valve (EN ISO 4126-1) with a closed bonnet, ribbed body and a cap of three kinds."""
    parts, seat, wide = _angle_body(dn, _sizes(dn, rng), style, rng)
    plate, n = 0.01 + 0.1 * wide, style.round(wide)
    parts += cover(1.35 * wide + 0.008, seat, plate, int(rng.choice([4, 6, 8])), style, bool(rng.random() < 0.3))
    low, tall = seat + plate, float(rng.uniform(2.2, 4.2)) * wide
    slim = float(rng.uniform(0.62, 0.9)) * wide
    hood = [
        (1.0 * wide, low - 0.001),
        (slim, low + 0.35 * wide),
        (slim, low + 0.75 * tall),
        (0.55 * wide, low + 0.92 * tall),
        (0.55 * wide, low + tall),
    ]
    solids = [turned(hood, n)]
    if rng.random() < 0.35:
        solids.append(around(box((0.5 * slim, 0.12 * slim, 0.5 * tall), (slim, 0, low + 0.45 * tall)), 4))
    parts += [bonnet(*solids), *_cap(low + tall, wide, style, rng)]
    return Model(laid(parts), kind="relief valve")


def _open_bonnet(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A steam safety valve with an open bonnet: a frame of two or four arms about its visible spring, lever."""
    parts, seat, wide = _angle_body(dn, _sizes(dn, rng), style, rng)
    plate, n = 0.01 + 0.1 * wide, style.round(wide)
    parts += cover(1.3 * wide + 0.008, seat, plate, 4, style)
    low, tall = seat + plate, float(rng.uniform(2.4, 3.8)) * wide
    slim = 0.95 * wide
    count = int(rng.choice([2, 4]))
    arm = box((0.16 * wide, 0.34 * wide, tall), (slim, 0, low + tall / 2))
    head = turned(
        [(1.1 * slim, low + tall - 0.2 * wide), (1.1 * slim, low + tall), (0.6 * wide, low + tall + 0.2 * wide)], n
    )
    parts.append(piece("yoke", around(arm, count, 0.0, float(rng.choice([0, 0.785]))), head, color="valve"))
    coil = spring(0.55 * wide, 0.1 * wide, low + 0.15 * wide, low + tall - 0.3 * wide, int(rng.integers(4, 7)), style)
    washers = [cylinder(0.7 * wide, z, z + 0.12 * wide, n) for z in (low + 0.05 * wide, low + tall - 0.32 * wide)]
    stem = cylinder(0.14 * wide, seat, low + tall + 0.5 * wide, 10)
    parts += [piece("valve stem", coil, *washers, stem), *_cap(low + tall + 0.2 * wide, wide, style, rng)]
    return Model(laid(parts), kind="relief valve")


def _pilot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pilot-operated safety valve (API 526 ends): flat cap, a pilot with its own spring case aside, sense lines."""
    parts, seat, wide = _angle_body(dn, _sizes(dn, rng), style, rng)
    plate = 0.02 + 0.2 * wide
    rim = 1.3 * wide + 0.008
    parts += cover(rim, seat, plate, int(rng.choice([6, 8, 12])), style)
    top, size = seat + plate, 0.018 + 0.16 * wide
    side = float(rng.choice([-1, 1]))
    if rng.random() < 0.5:
        x, y, z = 0.0, 0.0, top
        post = cylinder(0.4 * size, top - 0.001, top + size, 12)
    else:
        x, y, z = side * (rim + 1.2 * size), 0.0, seat
        post = along(
            "x" if side > 0 else "-x", cylinder(0.4 * size, rim - 0.004, rim + 0.6 * size, 12), 0, 0, seat + plate / 2
        )
        z = seat - size
    block = box((2 * size, 1.8 * size, 2.4 * size), (x, y, z + 2.0 * size))
    n = style.round(size)
    case = turned(
        [
            (0.9 * size, z + 3.2 * size),
            (0.9 * size, z + 3.6 * size),
            (0.6 * size, z + 3.9 * size),
            (0.55 * size, z + 6.5 * size),
        ],
        n,
    )
    screw = merge(
        [cylinder(0.3 * size, z + 6.4 * size, z + 7.6 * size, 10), hexagon(0.9 * size, z + 6.5 * size, z + 6.9 * size)]
    )
    parts += [body(block), body(post), bonnet(moved(case, at(x, y))), bonnet(moved(screw, at(x, y)))]
    wire = 0.004 + 0.02 * wide
    foot = plate_thickness(dn) + 0.012
    run = [
        (x, y - 0.9 * size, z + 1.4 * size),
        (x, y - 2.2 * size - rim, z + 1.4 * size),
        (0.0, -rim - 2.2 * size, foot),
        (0.0, -0.7 * PIPES[dn].radius, foot),
    ]
    if abs(x) > 0:
        run[2] = (x, -rim - 2.2 * size, foot)
        run.insert(3, (0.0, -rim - 2.2 * size, foot))
    parts.append(other("Pipe assembly", "pipe", "pipe", rope(bend(run, 1.0 * size, 3), wire, 8), own=True))
    nuts = [along("-y", hexagon(4 * wire, 0, 4 * wire), x, y - 0.88 * size, z + 1.4 * size)]
    parts.append(piece("gland", *nuts))
    return Model(laid(parts), kind="relief valve")


def _thermal(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermal relief valve on an outlet: hexagon body, threaded side outlet with a bent tail pipe, sealed cap."""
    r = float(rng.uniform(0.009, 0.014))
    n, tall = style.round(1.4 * r), float(rng.uniform(3.0, 6.0)) * r
    low = 0.012 + 1.2 * r
    chest = [
        cylinder(0.85 * r, 0.0, 0.02, n),
        hexagon(2.6 * r, 0.012, 0.012 + 1.3 * r),
        cylinder(1.35 * r, low, low + 2.8 * r, n),
    ]
    chest.append(along("y", hexagon(2.6 * r, 1.0 * r, 2.6 * r), 0, 0, low + 1.4 * r))
    top = low + 2.8 * r
    neck = [hexagon(2.7 * r, top - 0.001, top + 0.8 * r), cylinder(1.1 * r, top, top + tall, n)]
    crown = [
        hexagon(1.7 * r, top + tall, top + tall + 1.2 * r),
        cylinder(0.7 * r, top + tall - 0.002, top + tall + 2 * r, n),
    ]
    parts = [body(*chest), bonnet(*neck), bonnet(*crown)]
    if rng.random() < 0.6:
        drop = float(rng.uniform(0.1, 0.35))
        path = [(0, 2.5 * r, low + 1.4 * r), (0, 5 * r, low + 1.4 * r), (0, 5 * r, low - drop)]
        hollow = 0.75 * r if style.hollow else 0.0
        parts.append(other("Pipe assembly", "pipe", "pipe", tube(bend(path, 1.6 * r), 0.9 * r, hollow, n)))
    if rng.random() < 0.4:
        loop = rope([(1.0 * r, 0, top + 0.5 * tall), (2.0 * r, 0, top + 0.3 * tall), (1.1 * r, 0, top)], 0.0012, 5)
        parts.append(
            piece(
                "position indicator",
                loop,
                moved(cylinder(0.5 * r, -0.001, 0.001, 10), at(2.0 * r, 0, top + 0.3 * tall)),
            )
        )
    return Model(parts, kind="relief valve")


def _heater(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A temperature-and-pressure valve of a water heater: brass body, spout aside, spring dome, test flap on top."""
    r = float(rng.uniform(0.010, 0.015))
    n = style.round(1.5 * r)
    solids = [cylinder(0.9 * r, 0.0, 0.022, n), hexagon(2.7 * r, 0.018, 0.018 + 1.2 * r)]
    low = 0.018 + 1.1 * r
    solids.append(
        turned(
            [
                (1.2 * r, low),
                (1.6 * r, low + 0.8 * r),
                (1.6 * r, low + 2.6 * r),
                (1.9 * r, low + 2.7 * r),
                (1.9 * r, low + 3.1 * r),
            ],
            n,
        )
    )
    solids += [
        along(
            "y",
            merge([cylinder(1.15 * r, 1.2 * r, 2.8 * r, n), ring(0.8 * r, 1.4 * r, 2.6 * r, 3.8 * r, n)]),
            0,
            0,
            low + 1.5 * r,
        )
    ]
    top = low + 3.1 * r
    if rng.random() < 0.5:
        dome = turned(
            [(1.8 * r, top - 0.001), (1.8 * r, top + 0.4 * r), (1.2 * r, top + 1.6 * r), (0.5 * r, top + 2.0 * r)], n
        )
        high = top + 2.0 * r
    else:
        dome = turned([(1.5 * r, top - 0.001), (1.3 * r, top + 3 * r), (0.9 * r, top + 3.2 * r)], n)
        high = top + 3.2 * r
    pin = cylinder(0.25 * r, high - 0.002, high + 1.0 * r, 8)
    flap = moved(
        box((0.9 * r, 4.2 * r, 0.16 * r), (0, 1.3 * r, 0)),
        at(0, 0, high + 0.7 * r) @ spun("x", float(rng.uniform(-0.4, 0.1))),
    )
    return Model(
        [body(*solids), bonnet(dome), piece("valve stem", pin), piece("lever", flap, color="handle", bundle="")],
        kind="relief valve",
    )


def _spring_lever(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A weight-loaded safety valve as on old boilers: a long lever across the seat with a sliding weight, a guide."""
    parts, seat, wide = _angle_body(dn, _sizes(dn, rng), style, rng)
    plate = 0.01 + 0.08 * wide
    parts += cover(1.3 * wide + 0.006, seat, plate, 4, style)
    top, long = seat + plate, float(rng.uniform(7.0, 11.0)) * wide
    height = top + 1.1 * wide
    way = float(rng.choice([0.0, 1.5708, 3.1416]))
    pivot = merge(
        [box((0.4 * wide, 0.12 * wide, 1.5 * wide), (-0.9 * wide, s * 0.2 * wide, top + 0.74 * wide)) for s in (-1, 1)]
    )
    guide = merge(
        [box((0.3 * wide, 0.1 * wide, 2.0 * wide), (1.0 * wide, s * 0.2 * wide, top + 0.99 * wide)) for s in (-1, 1)]
    )
    stem = cylinder(0.14 * wide, top - 0.001, height, 10)
    bar = box((long, 0.26 * wide, 0.4 * wide), (long / 2 - 1.2 * wide, 0, height))
    place = long * float(rng.uniform(0.55, 0.8)) - 1.2 * wide
    size = float(rng.uniform(0.9, 1.4)) * wide
    load = along("y", cylinder(size, -0.5 * wide, 0.5 * wide, style.round(size)), place, 0, height - 0.3 * wide)
    if rng.random() < 0.5:
        load = merge(
            [
                box((0.2 * wide, 0.5 * wide, 0.6 * wide), (place, 0, height)),
                moved(
                    turned([(0.4 * size, 0.0), (size, 0.4 * size), (size, 1.8 * size)], style.round(size)),
                    at(place, 0, height - 0.2 * wide) @ spun("x", np.pi),
                ),
            ]
        )
    pin = along("y", cylinder(0.1 * wide, -0.4 * wide, 0.4 * wide, 8), -0.9 * wide, 0, height)
    top_parts = [
        bonnet(pivot, guide),
        piece("valve stem", stem, pin),
        piece("lever", bar, color="handle", bundle=""),
        piece("lever", load, color="handle", bundle=""),
    ]
    return Model(laid([*parts, *placed(top_parts, spun("z", way))]), kind="relief valve")


def _rupture(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rupture disc in its holder (EN ISO 4126-2): two rings between flanges, domed disc, hook, tag, cap screws."""
    size, bore = FLANGES[dn], PIPES[dn].bore
    outer, n = 0.5 * (size.circle - size.bolt) - 0.0005, style.round(size.outer / 2)
    low, high = 0.02 + 0.08 * PIPES[dn].outer, 0.016 + 0.06 * PIPES[dn].outer
    length = round(low + high + 0.001, 6)
    rings = [along("x", ring(bore, outer, 0.0, low, n)), along("x", ring(bore, outer, low + 0.001, length, n))]
    angles = np.linspace(0, np.pi / 2, 4)
    swell = [(max(0.98 * bore * np.cos(a), 0.0), low + 0.0005 + 0.35 * bore * np.sin(a)) for a in angles[:-1]]
    disc = turned([(outer - 0.001, low), (outer - 0.001, low + 0.001), *swell, (0.08 * bore, low + 0.35 * bore)], n)
    parts = [body(rings[0]), body(rings[1]), piece("valve disc", along("x", disc))]
    tag = moved(
        box((0.001, 0.03 + 0.1 * bore, 0.04 + 0.1 * bore), (low + 0.0005, 0, outer + 0.019 + 0.05 * bore)),
        spun("x", float(rng.uniform(-0.3, 0.3))),
    )
    parts.append(piece("position indicator", tag, color="dial"))
    if rng.random() < 0.6:
        path = [
            (0.4 * low, 0, 0.9 * outer),
            (0.4 * low, 0, size.outer / 2 + 0.01),
            (-0.03, 0, size.outer / 2 + 0.01),
            (-0.03, 0, size.outer / 2 - 0.01),
        ]
        parts.append(piece("valve body", moved(rope(path, 0.004, 8), spun("x", 2.4))))
    screw = merge([box((length * 0.9, 0.012, 0.004), (length / 2, s * (outer + 0.001), 0)) for s in (-1, 1)])
    parts.append(Part(screw, "screw", "fastener", "valve body", "Connection assembly", True))
    return Model(parts, length, "wafer", "rupture disc")


RELIEFS: tuple[Family, ...] = (
    valve_family("relief valve/full lift", _full_lift, MID, "head", 1.5),
    valve_family("relief valve/open bonnet", _open_bonnet, MID, "head"),
    valve_family("relief valve/pilot", _pilot, tuple(dn for dn in MID if dn >= 25), "head"),
    valve_family("relief valve/weight loaded", _spring_lever, MID, "head", 0.7),
    valve_family("relief valve/thermal", _thermal, SIZES, "tap"),
    valve_family("relief valve/water heater", _heater, SIZES, "tap"),
    valve_family("rupture disc/holder", _rupture, tuple(dn for dn in SIZES if dn >= 25)),
)
