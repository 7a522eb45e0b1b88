"""Plug valves of further makes, and bib taps."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_lever, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.body import (
    ended,
    lid_joint,
    metal,
    neck_of,
    oval,
    packing,
    room,
    trim,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.valve import disc_flange, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, dome, hexagon, lofted, rod, turned
from cadplants.standards import FACE_TO_FACE, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["PLUGS"]

Rng = np.random.Generator


def _taper(radius: float, low: float, high: float, port: float, n: int) -> Solid:
    """A tapered plug about z, its port as a flat pocket on each side [m]."""
    return turned(
        [(0.82 * radius, low), (radius, high), (0.5 * radius, high + 0.02), (0.4 * radius, high + 0.5 * port)], n
    )


def _lubricated(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A lubricated plug valve: a tapered chest, bolted gland plate, grease fitting in the square head (API 599)."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * float(rng.uniform(1.0, 1.3))
    neck, back = neck_of(dn)
    x, big = length / 2, 1.3 * radius + 0.010
    n = max(16, style.round(big))
    middle = [
        (neck, back),
        (1.05 * radius + 0.006, back + 0.15 * length),
        (1.05 * radius + 0.006, length - back - 0.15 * length),
        (neck, length - back),
    ]
    low, high = -1.35 * radius - 0.008, 1.45 * radius + 0.012
    kind = int(rng.integers(3))
    if kind == 0:
        loops = [(0.75 * big, low), (0.8 * big, 0.0), (big, high)]
        chest = lofted([np.column_stack([circle(r, n), np.full(n, z)]) for r, z in loops])
    elif kind == 1:
        chest = slab(rounded_rectangle(1.7 * big, 2.1 * big, 0.35 * big, 3), low, high)
    else:
        chest = lofted(
            [
                np.column_stack([oval(0.8 * big * s, 1.15 * big * s, n), np.full(n, z)])
                for s, z in ((0.8, low), (1.0, 0.3 * low), (1.0, high))
            ]
        )
    plate = 0.010 + 0.07 * radius
    collar, lid, bolts = lid_joint(
        str(rng.choice(["round", "oval", "square", "octagon"])), 1.1 * big, 1.3 * big, high, plate, style, rng
    )
    top, half = high + plate, 0.3 * radius + 0.006
    body = merge([ended(dn, style, length, middle, "flanged"), moved(merge([chest, collar]), at(x))])
    parts = [metal(body), trim(lid, "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    gland, _ = packing(0.8 * half, style, rng, int(rng.choice([0, 2])))
    head = merge([cylinder(half, -0.01, 2.2 * half, 12), box((1.7 * half, 1.7 * half, 2.2 * half), (0, 0, 3.2 * half))])
    grease = merge(
        [
            hexagon(0.02, 4.2 * half, 4.2 * half + 0.012),
            cylinder(0.005, 4.2 * half, 4.2 * half + 0.03, 8),
            dome(0.005, 0.005, 4.2 * half + 0.03, 8),
        ]
    )
    parts += placed([*gland, Part(merge([head, grease]), "valve stem", "trim", BODY)], at(x, 0, top))
    pick = rng.random()
    if pick < 0.55:
        parts += placed(
            [hand_lever(0.14 + 2.8 * radius, 2.3 * half, style, rng, ("spanner", "bar", "cast"))], at(x, 0, top)
        )
    elif pick < 0.9:
        parts += quarter_turn(x, top + 2.2 * half, radius, style, rng, ("worm", "worm", "scotch", "rack"))
    if rng.random() < 0.4:
        parts.append(
            trim(
                merge(
                    [cylinder(0.4 * big, low - 0.012, low + 0.004, 14), hexagon(0.5 * big, low - 0.025, low - 0.012)]
                ),
                "valve bonnet",
                x,
                "valve",
            )
        )
    if style.hollow:
        parts.append(trim(_taper(0.95 * radius, -1.1 * radius, 1.1 * radius, radius, n), "valve disc", x))
    return Model(parts, round(length, 6), kind="plug valve")


def _eccentric(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An eccentric plug valve for sewage: bulging half-round body, bolted cover with a bearing hub."""
    radius = PIPES[dn].radius
    length = 0.09 + 2.0 * radius
    neck, back = neck_of(dn)
    x, big = length / 2, 1.35 * radius + 0.012
    n = max(16, style.round(big))
    body = [ended(dn, style, length, [(neck, back), (1.1 * radius + 0.005, x), (neck, length - back)], "flanged")]
    hump = merge([cylinder(min(big, 0.47 * length), -1.1 * radius - 0.01, 1.15 * radius + 0.012, n)])
    body.append(moved(hump, at(x, 0.35 * radius)))
    seat, plate = 1.15 * radius + 0.016, 0.012 + 0.06 * radius
    wide = min(big, 0.47 * length) * 1.12
    collar, lid, bolts = lid_joint("round", wide, wide, seat + plate, plate, style, rng)
    body.append(moved(collar, at(x, 0.35 * radius)))
    hub = 0.22 * radius + 0.014
    high = max(seat + 2 * plate + 0.02, room(dn))
    cover = merge(
        [
            lid,
            turned(
                [
                    (1.6 * hub, seat + 2 * plate - 0.003),
                    (hub, high - 0.01),
                    (1.7 * hub, high - 0.008),
                    (1.7 * hub, high),
                ],
                n,
            ),
        ]
    )
    foot = moved(cylinder(1.2 * hub, -1.1 * radius - 0.03, -1.0 * radius, 14), at(x, 0.2 * radius))
    pose = at(x, 0.2 * radius, high)
    parts = [
        metal(merge([*body, foot])),
        trim(moved(cover, at(0, 0.35 * radius)), "valve bonnet", x, "valve"),
        *placed([bolts], at(x, 0.35 * radius)),
    ]
    parts += placed([shaft(-0.02, 0.04, 0.5 * hub, style)], pose)
    pick = rng.random()
    if pick < 0.3:
        nut = box((0.05, 0.05, 0.05), (0, 0, 0.06))
        parts += placed([Part(nut, "valve stem", "trim", BODY)], pose)
    elif pick < 0.5:
        parts += placed([hand_lever(0.12 + 2.4 * radius, 0.01, style, rng, ("bar", "cast", "spanner"))], pose)
    else:
        parts += placed(
            quarter_turn(0, 0.004, radius, style, rng, ("worm", "worm", "bevel", "multi-turn", "scotch")), pose
        )
    if style.hollow:
        plug = np.array(
            [(1.05 * radius * np.cos(t), 1.05 * radius * np.sin(t)) for t in np.linspace(0.25, 2.9, 12)]
            + [(0.5 * radius * np.cos(t), 0.6 * radius * np.sin(t)) for t in np.linspace(2.9, 0.25, 6)]
        )
        turn = spun("z", float(rng.choice([0.0, -0.5])) * np.pi)
        parts.append(trim(moved(slab(plug, -0.8 * radius, 0.8 * radius), turn), "valve disc", x))
    return Model(parts, round(length, 6), kind="plug valve")


def _multi_plug(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A sleeved multi-port plug valve: flanges at three or four sides of a round chest, a square top cover, wrench."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * 1.25
    neck, back = neck_of(dn)
    x, big = length / 2, 1.35 * radius + 0.012
    n = max(16, style.round(big))
    low, high = -1.3 * radius - 0.01, 1.4 * radius + 0.012
    chest = turned([(0.85 * big, low), (0.9 * big, 0.8 * low), (big, high)], n)
    body = [
        ended(
            dn,
            style,
            length,
            [
                (neck, back),
                (1.05 * radius + 0.004, 0.4 * length),
                (1.05 * radius + 0.004, 0.6 * length),
                (neck, length - back),
            ],
            "flanged",
        ),
        moved(chest, at(x)),
    ]
    for way in ("y", "-y") if rng.random() < 0.3 else ("y",):
        side = moved(disc_flange(dn, style, x - 0.7 * radius), at(0, 0, -x))
        body.append(moved(along("-y" if way == "y" else "y", side), at(x)))
    plate = 0.012 + 0.06 * radius
    collar, lid, bolts = lid_joint(str(rng.choice(["square", "round"])), 1.2 * big, 1.2 * big, high, plate, style, rng)
    top, slim = high + plate, 0.25 * radius + 0.006
    adjust = merge(
        [
            moved(hexagon(0.014, top, top + 0.012), at(0.6 * big * np.cos(t), 0.6 * big * np.sin(t)))
            for t in (0.5, 2.6, 4.7)
        ]
    )
    parts = [
        metal(merge([*body, moved(collar, at(x))])),
        trim(lid, "valve bonnet", x, "valve"),
        *placed([bolts, bolted(adjust), shaft(-0.2 * radius, top + 2.5 * slim, slim, style)], at(x)),
    ]
    stop = merge(
        [
            cylinder(1.9 * slim, top + 0.004, top + 0.01, 16),
            box((0.02, 3.2 * slim, 0.006), (1.6 * slim, 0, top + 0.007)),
        ]
    )
    parts.append(trim(stop, "position indicator", x))
    if rng.random() < 0.6:
        parts += placed(
            [hand_lever(0.12 + 2.2 * radius, top + 0.012, style, rng, ("spanner", "bar", "sheet", "cast"))], at(x)
        )
    else:
        parts += quarter_turn(x, top + 0.012, radius, style, rng, ("worm", "rack", "motor box", "scotch"))
    return Model(parts, round(length, 6), kind="plug valve")


def _tap(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A bib cock on a pipe's end: a turned body, a downward spout with a hose thread, a lever, cross, tee or wing."""
    radius = PIPES[dn].radius
    reach, big, n = 0.05 + 2.2 * radius, 1.2 * radius + 0.003, max(12, style.round(radius))
    nut = along("x", hexagon(2.5 * radius + 0.004, 0.0, 0.014))
    tube_ = along(
        "x",
        turned(
            [
                (1.0 * radius, 0.0),
                (0.9 * radius, 0.5 * reach),
                (big, 0.55 * reach),
                (big, 0.8 * reach),
                (0.7 * radius, reach),
            ],
            n,
        ),
    )
    drop = float(rng.uniform(1.6, 3.0)) * radius + 0.01
    path = [
        (0.7 * reach, 0, 0),
        (reach, 0, -0.1 * radius),
        (reach + 0.7 * radius, 0, -0.8 * radius),
        (reach + 0.8 * radius, 0, -drop),
    ]
    from_ = [rod(path[k], path[k + 1], 0.68 * radius, n) for k in range(3)]
    lip = moved(
        turned([(0.85 * radius, -drop - 0.012), (0.85 * radius, -drop + 0.004), (0.68 * radius, -drop + 0.008)], n),
        at(reach + 0.8 * radius),
    )
    x = 0.67 * reach
    high = big + float(rng.uniform(0.3, 1.4)) * radius + 0.006
    parts = [metal(merge([nut, tube_, *from_, lip, moved(cylinder(0.75 * radius, 0.0, high, n), at(x))]))]
    cap = merge(
        [
            hexagon(1.8 * radius, high - 0.004, high + 0.4 * radius),
            turned([(0.7 * radius, high + 0.4 * radius), (0.4 * radius, high + 0.9 * radius)], n),
        ]
    )
    parts.append(trim(cap, "valve bonnet", x, "valve"))
    top = high + 0.9 * radius
    rest = [shaft(-0.004, 0.012, 0.2 * radius + 0.001, style)]
    if rng.random() < 0.5:
        rest.append(hand_lever(0.04 + 2.0 * radius, 0.002, style, rng, ("wing", "sheet", "tee", "loop", "bar")))
    else:
        rest.append(hand_wheel(0.016 + 0.9 * radius, 0.003, style, rng, ("cross", "lobed", "star", "spoked", "disc")))
    return Model([*parts, *placed(rest, at(x, 0, top))], kind="tap")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_BIG = tuple(dn for dn in SIZES if dn >= 50)


PLUGS: tuple[Family, ...] = (
    valve_family("plug valve/lubricated", _lubricated, _MID),
    valve_family("plug valve/eccentric", _eccentric, _BIG),
    valve_family("plug valve/multi-port", _multi_plug, _MID),
    valve_family("bib tap/spout", _tap, tuple(dn for dn in SIZES if dn <= 50), "end"),
)
