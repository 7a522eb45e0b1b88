"""Plug, diaphragm and pinch valves of further makes."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.actuation_stroke import LINEAR, yoke_arms
from cadplants.families.valves.ball import clamped_ends, ferrule, part_ring
from cadplants.families.valves.body import (
    bolts_on,
    ended,
    lid_joint,
    metal,
    neck_of,
    oval,
    plate_outline,
    trim,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, lofted, ring, rod, turned, waves
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at

__all__ = ["LININGS"]

Rng = np.random.Generator


def _straight(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A straight-through diaphragm valve: full bore, a long oval joint, a tall bonnet (EN 13397)."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * 1.1
    neck, back = neck_of(dn)
    x, n = length / 2, max(16, style.round(1.6 * radius))
    half_x, half_y = min(0.42 * length, 1.7 * radius + 0.012), 1.25 * radius + 0.014
    seat, plate = max(1.25 * radius + 0.006, 0.0), 0.009 + 0.07 * radius
    kind = str(rng.choice(["oval", "square", "oval", "octagon"]))
    collar, lid, bolts = lid_joint(kind, half_x, half_y, seat, plate, style, rng)
    tray = lofted(
        [
            np.column_stack([oval(half_x * s, half_y * t, n), np.full(n, z)])
            for s, t, z in ((0.5, 0.4, -1.1 * radius), (0.7, 0.8, -0.3 * radius), (0.85, 0.85, seat - 0.5 * plate))
        ]
    )
    seal = slab(plate_outline(kind, 0.99 * half_x, 0.99 * half_y, n), seat, seat + 0.004)
    rise = seat + 0.004 + plate
    high = rise + float(rng.uniform(1.2, 2.0)) * radius + 0.02
    hood = lofted(
        [
            np.column_stack([oval(half_x * s, half_y * t, n), np.full(n, z)])
            for s, t, z in (
                (0.85, 0.85, rise - 0.3 * plate),
                (0.75, 0.8, rise + 0.4 * (high - rise)),
                (0.4, 0.5, rise + 0.75 * (high - rise)),
                (0.3, 0.45, high),
            )
        ]
    )
    slim = 0.005 + 0.08 * radius
    parts = [
        metal(
            merge(
                [
                    ended(
                        dn,
                        style,
                        length,
                        [
                            (neck, back),
                            (1.08 * radius + 0.004, 0.3 * length),
                            (1.08 * radius + 0.004, 0.7 * length),
                            (neck, length - back),
                        ],
                        "flanged",
                    ),
                    moved(merge([tray, collar]), at(x)),
                ]
            )
        ),
        Part(moved(seal, at(x)), "gasket", "rubber", BODY, "Pipe assembly"),
        trim(merge([moved(lid, at(0, 0, 0.004)), hood]), "valve bonnet", x, "valve"),
        *placed([bolts], at(x)),
    ]
    if rng.random() < 0.65:
        parts += placed(
            [
                shaft(-0.01, 0.05 + radius, slim, style, rng),
                hand_wheel(0.04 + 1.2 * radius, 0.012, style, rng, ("spoked", "spoked", "lobed", "dished", "disc")),
            ],
            at(x, 0, high),
        )
        parts.append(
            trim(cylinder(0.8 * slim, high + 0.04 + radius, high + 0.08 + 1.3 * radius, 10), "position indicator", x)
        )
    else:
        parts += placed(LINEAR[str(rng.choice(["piston", "diaphragm"]))](radius, high - 0.002, style, rng), at(x))
    return Model(parts, length, kind="diaphragm valve")


def _aseptic(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An aseptic or plastic diaphragm valve: block body, square joint, clamp, weld or socket ends (EN 13397)."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["clamp", "butt", "socket"]))
    stub = 0.025 if ends == "clamp" else 0.0
    core = 0.06 + 3.2 * radius
    length, x = core + 2 * stub, core / 2 + stub
    half, n = 1.55 * radius + 0.010, max(16, style.round(1.5 * radius))
    if ends == "clamp":
        arms = [ferrule(dn, stub, x, style, True), ferrule(dn, x, length - stub, style, False)]
    else:
        end = radius if ends == "butt" else 1.3 * radius
        bore = PIPES[dn].bore if style.hollow else 0.0
        arms = [along("x", ring(bore, end, 0.0, length, n))]
    seat = 1.1 * radius + 0.006
    outline = rounded_rectangle(2 * half, 2 * half, float(rng.uniform(0.15, 0.6)) * half, 4)
    block = [slab(outline, seat - 0.008 - 0.1 * radius, seat)]
    bottom = [
        np.column_stack([outline * s, np.full(len(outline), z)])
        for s, z in ((0.45, -1.05 * radius), (0.75, -0.2 * radius), (0.9, seat - 0.007 - 0.1 * radius))
    ]
    block.append(lofted(bottom))
    seal = slab(outline * 0.995, seat, seat + 0.003)
    low = seat + 0.003
    lid = [slab(outline, low, low + 0.008 + 0.12 * radius)]
    bolts = bolts_on(outline, 4, seat - 0.008, low + 0.009 + 0.12 * radius, 0.005 + 0.04 * radius)
    step = low + 0.007 + 0.12 * radius
    high = step + float(rng.uniform(1.0, 2.2)) * radius + 0.015
    if rng.random() < 0.5:
        lid.append(turned([(0.95 * half, step), (0.9 * half, 0.5 * (step + high)), (0.55 * half, high)], n))
    else:
        lid.append(slab(outline * 0.85, step, high - 0.004))
        lid.append(cylinder(0.6 * half, high - 0.005, high, n))
    parts = [
        metal(merge([*arms, *(moved(s, at(x)) for s in block)]), 0.0, "clamp"),
        Part(moved(seal, at(x)), "gasket", "rubber", BODY, "Pipe assembly"),
        trim(merge(lid), "valve bonnet", x),
        *placed([bolts], at(x)),
    ]
    if ends == "clamp":
        parts += clamped_ends(dn, stub, length, style, rng)
    if rng.random() < 0.65:
        size = 0.85 * half + 0.008
        parts += placed(
            [
                shaft(-0.004, 0.02 + radius, 0.15 * half, style),
                hand_wheel(size, 0.001, style, rng, ("lobed", "lobed", "spoked", "dished")),
            ],
            at(x, 0, high),
        )
        sight = merge([cylinder(0.1 * half, high + 0.02 + radius, high + 0.03 + 1.4 * radius, 10)])
        parts.append(trim(sight, "position indicator", x, "safety"))
    else:
        parts += (
            quarter_turn(x, high, radius, style, rng, ("vertical",))
            if rng.random() < 0.5
            else placed(LINEAR["piston"](radius, high - 0.001, style, rng), at(x))
        )
    return Model(parts, round(length, 6), "welded", "diaphragm valve")


def _sleeve(length: float, thick: float, sleeve_out: float, flat: float, n: int) -> Solid:
    """A rubber sleeve that is pressed flat in its middle and gives way to the sides [m]."""
    stations = [
        (thick, 1.0),
        (0.25 * length, 1.0),
        (0.42 * length, flat),
        (0.58 * length, flat),
        (0.75 * length, 1.0),
        (length - thick, 1.0),
    ]
    wide = [1 + 0.45 * (1 - s) for _, s in stations]
    return lofted(
        [
            np.column_stack([np.full(n, z), sleeve_out * w * np.cos(t), sleeve_out * s * np.sin(t)])
            for (z, s), w in zip(stations, wide, strict=True)
            for t in [np.arange(n) * 2 * np.pi / n]
        ]
    )


def _pinch_open(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An open-frame pinch valve: a rubber sleeve between two flanges, squeezed by bars in an open yoke."""
    radius = PIPES[dn].radius
    size, thick = FLANGES[dn], plate_thickness(dn)
    length = 0.12 + 4.4 * radius
    x, n = length / 2, max(16, style.round(radius))
    sleeve_out, bore = 1.25 * radius + 0.006, PIPES[dn].bore
    flat = float(rng.uniform(0.3, 1.0))
    inner = bore if style.hollow else 0.0
    ends = [along("x", ring(inner, size.outer / 2, z, z + thick, n)) for z in (0.0, length - thick)]
    tube_ = _sleeve(length, thick, sleeve_out, flat, n)
    bar = 0.05 * length + 0.01
    reach = 1.7 * sleeve_out + 0.01
    up = max(sleeve_out + 0.06, 0.5 * size.outer + 0.02)
    bars = [box((2 * bar, 2 * reach * 0.8, 0.6 * bar), (0, 0, sg * (sleeve_out * flat + 0.3 * bar))) for sg in (-1, 1)]
    if rng.random() < 0.5:
        posts = [cylinder(0.008 + 0.05 * radius, -sleeve_out - 0.7 * bar, up, 10) for _ in (0, 1)]
        posts = [moved(p, at(0, s * reach)) for p, s in zip(posts, (-1, 1), strict=True)]
        beams = [box((2 * bar, 2.3 * reach, 0.02), (0, 0, z)) for z in (up, -sleeve_out * 1.0 - 0.7 * bar)]
    else:
        posts = [
            box((1.6 * bar, 0.014, up + sleeve_out + 0.7 * bar), (0, s * reach, (up - sleeve_out - 0.7 * bar) / 2))
            for s in (-1, 1)
        ]
        beams = [box((1.8 * bar, 2.1 * reach, 0.016), (0, 0, z)) for z in (up, -sleeve_out - 0.7 * bar)]
    ties = (
        [
            rod(
                (0.5 * thick, s * 0.46 * size.outer, 0.1 * size.outer),
                (length - 0.5 * thick, s * 0.46 * size.outer, 0.1 * size.outer),
                0.008,
                8,
            )
            for s in (-1, 1)
        ]
        if rng.random() < 0.6
        else []
    )
    slim = 0.007 + 0.06 * radius
    low = sleeve_out * flat + 0.5 * bar
    parts = [
        metal(merge([*ends, *ties])),
        trim(tube_, "valve body", 0.0, "rubber"),
        trim(merge(bars), "valve disc", x),
        trim(merge([*posts, *beams]), "yoke", x, "steel"),
    ]
    if rng.random() < 0.6:
        parts += placed(
            [shaft(low, up + 0.08 + radius, slim, style, rng), hand_wheel(0.06 + 1.2 * radius, up + 0.012, style, rng)],
            at(x),
        )
    else:
        kind = str(rng.choice(["piston", "ram", "turning"]))
        parts += placed([shaft(low, up + 0.012, slim, style), *LINEAR[kind](radius, up + 0.009, style, rng)], at(x))
    return Model(parts, round(length, 6), kind="pinch valve")


def _casing(length: float, neck: float, back: float, big: float, rng: Rng) -> list[tuple[float, float]]:
    """The outline of an enclosed pinch valve between its flanges: drum, barrel or ringed [m]."""
    kind = int(rng.integers(3))
    if kind == 0:
        return [
            (neck, back),
            (big, back + 0.12 * length),
            (big, length - back - 0.12 * length),
            (neck, length - back),
        ]
    elif kind == 1:
        return [
            (neck, back),
            *[
                (r, float(z))
                for r, z in [
                    (big * (0.8 + 0.2 * np.sin(np.pi * s)), back + s * (length - 2 * back))
                    for s in np.linspace(0.08, 0.92, 9)
                ]
            ],
            (neck, length - back),
        ]
    else:
        return [
            (neck, back),
            *[
                (r, z)
                for z, r in sorted((z, r) for r, z in waves(back + 0.01, length - back - 0.01, 0.92 * big, big, 4))
            ],
            (neck, length - back),
        ]


def _squeezer(half: float, radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """What presses an enclosed sleeve together: a wheel on a yoke, a piston or a ram [m]."""
    tall, slim = 0.05 + 0.9 * radius, 0.006 + 0.06 * radius
    if rng.random() < 0.4:
        return LINEAR[str(rng.choice(["piston", "ram"]))](radius, 0.0, style, rng)
    return [
        yoke_arms(1.3 * half, tall, style, rng),
        shaft(-0.02, tall + 0.06 + 0.5 * radius, slim, style, rng),
        hand_wheel(0.05 + 1.2 * radius, tall + 0.002, style, rng),
    ]


def _pinch_closed(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An enclosed pinch valve: two cast halves bolted along the middle, air-operated or with a wheel above."""
    radius = PIPES[dn].radius
    length = 0.08 + 3.6 * radius
    neck, back = neck_of(dn)
    x, big = length / 2, 1.55 * radius + 0.012
    n = max(16, style.round(big))
    middle = _casing(length, neck, back, big, rng)
    body = [ended(dn, style, length, middle, "flanged")]
    flange_ = (
        slab(rounded_rectangle(length - 2 * back - 0.012, 2 * big + 0.05, 0.02, 3), -0.010, 0.010)
        if rng.random() < 0.7
        else None
    )
    parts: list[Part] = []
    if flange_ is not None:
        body.append(moved(flange_, at(x)))
        one = merge([cylinder(0.005, -0.016, 0.016, 8), hexagon(0.016, 0.010, 0.018), hexagon(0.016, -0.018, -0.010)])
        spots = np.linspace(-0.4, 0.4, int(rng.integers(3, 6))) * (length - 2 * back - 0.012)
        parts.append(bolted(merge([moved(one, at(x + float(p), s * (big + 0.014))) for p in spots for s in (-1, 1)])))
    high = big + 0.02
    if rng.random() < 0.45:
        body.append(
            moved(
                merge(
                    [
                        cylinder(0.016, 0.9 * big, high, 12),
                        hexagon(0.026, high, high + 0.014),
                        cylinder(0.007, high + 0.01, high + 0.04, 8),
                    ]
                ),
                at(x),
            )
        )
        parts.insert(0, metal(merge(body)))
    else:
        seat, half = max(high, 0.5 * FLANGES[dn].outer), 0.55 * big
        tower = merge([cylinder(half, 0.7 * big, seat, n), cylinder(1.4 * half, seat - 0.012, seat, n)])
        parts.insert(0, metal(merge([*body, moved(tower, at(x))])))
        parts += placed(_squeezer(half, radius, style, rng), at(x, 0, seat))
    if style.hollow:
        bore = PIPES[dn].bore
        liner = about_x(
            part_ring([(0.86 * bore, 0.0), (0.985 * bore, 0.0), (0.985 * bore, length), (0.86 * bore, length)], n)
        )
        parts.append(trim(liner, "valve body", 0.0, "rubber"))
    return Model(parts, round(length, 6), kind="pinch valve")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_SMALL = tuple(dn for dn in SIZES if dn <= 100)


LININGS: tuple[Family, ...] = (
    valve_family("diaphragm valve/straight through", _straight, _MID),
    valve_family("diaphragm valve/aseptic", _aseptic, _SMALL, weight=1.5),
    valve_family("pinch valve/open frame", _pinch_open, tuple(dn for dn in SIZES if dn >= 25)),
    valve_family("pinch valve/enclosed", _pinch_closed, tuple(dn for dn in SIZES if dn >= 25)),
)
