"""Small and light ball valves: sanitary, plastic, multi-port, blocks, cut open."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_lever, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab, span
from cadplants.families.valves.ball import ball_inside, clamped_ends, ferrule, some_turn, stem_top
from cadplants.families.valves.body import (
    metal,
    neck_of,
    packing,
    part_turned,
    trim,
    valve_ball,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["UNIONS"]

Rng = np.random.Generator


def _sanitary(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A sanitary three-piece ball valve with clamp ends, ferrules of the pipe and their clamps; a lever or actuator."""
    radius = PIPES[dn].radius
    stub, core = 0.03, 3.6 * radius + 0.06
    length, x = core + 2 * stub, core / 2 + stub
    big, half = 1.55 * radius + 0.008, 0.9 * radius + 0.008
    n = max(16, style.round(big))
    ends = [ferrule(dn, stub, x - half, style, True), ferrule(dn, x + half, length - stub, style, False)]
    outline = rounded_rectangle(2 * big, 2 * big, 0.4 * big, 4) if rng.random() < 0.5 else circle(1.15 * big, n)
    hole = (circle(0.95 * radius, n),) if style.hollow else ()
    plates = [along("x", slab(outline, *span(x + s * (half - 0.012), x + s * (half + 0.002)), hole)) for s in (-1, 1)]
    block = along("x", slab(circle(1.3 * radius + 0.006, n), x - half + 0.01, x + half - 0.01, hole))
    rods = about_x(
        around(
            merge(
                [
                    cylinder(0.004, x - half - 0.006, x + half + 0.006, 8),
                    hexagon(0.012, x + half + 0.002, x + half + 0.008),
                ]
            ),
            4,
            1.18 * big if len(outline) < 24 else 1.0 * big,
            np.pi / 4,
        )
    )
    parts = [
        metal(merge([*ends, *plates, block]), 0.0, "clamp"),
        bolted(rods),
        *clamped_ends(dn, stub, length, style, rng),
        *stem_top(x, 1.1 * radius, 1.3 * big + 0.01, radius, style, rng),
        *ball_inside(dn, x, style, rng),
        *quarter_turn(
            x, 1.3 * big + 0.014 + 0.2 * radius, radius, style, rng, ("lever", "lever", "vertical", "rack", "motor box")
        ),
    ]
    return Model(parts, round(length, 6), "welded", "ball valve")


def _union_nut(radius: float, low: float, high: float, style: ModelingStyle, rng: Rng, inner: float) -> Solid:
    """A plastic union nut along x with fluted or ribbed sides [m]."""
    count = int(rng.choice([8, 12, 16]))
    turns = np.arange(4 * count) * 2 * np.pi / (4 * count)
    reach = radius * (1 + 0.05 * np.sign(np.cos(count * turns + 0.3)))
    outline = np.column_stack([reach * np.cos(turns), reach * np.sin(turns)])
    holes = (circle(inner, 24),)
    return along("x", slab(outline, low, high, holes))


def _true_union(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A plastic true-union ball valve: socket ends, two union nuts, a tee or wing handle, maybe feet (EN ISO 16135)."""
    radius = PIPES[dn].radius
    x = 2.3 * radius + 0.035
    length, big = 2 * x, 1.55 * radius + 0.010
    n = max(16, style.round(big))
    inner = radius if style.hollow else 0.0
    nut = float(rng.uniform(0.8, 1.1)) * radius + 0.012
    parts = []
    for s in (-1, 1):
        face, start = x + s * x, x + s * (0.95 * radius + 0.004)
        socket = along("x", ring(inner, 1.28 * radius + 0.002, *span(face, start), n))
        parts.append(metal(socket))
        far = start + s * nut
        parts.append(
            Part(
                _union_nut(1.22 * big, *span(start, far), style, rng, 1.3 * radius + 0.002),
                "union",
                "valve",
                BODY,
                "Pipe assembly",
            )
        )
    barrel = along("x", ring(0.9 * inner, big, x - 0.95 * radius - 0.006, x + 0.95 * radius + 0.006, n))
    tower, high = 0.55 * radius + 0.007, big + 0.35 * radius + 0.008
    neck = slab(rounded_rectangle(2.2 * tower, 2 * tower, 0.5 * tower, 3), 0.85 * big, high)
    solids = [barrel, moved(neck, at(x))]
    if rng.random() < 0.4:
        solids.append(box((1.4 * radius, 1.2 * big, 0.3 * big), (x, 0, -1.05 * big)))
    parts = [metal(merge(solids)), *parts, *ball_inside(dn, x, style, rng)]
    rest = [shaft(-0.01, 0.012, 0.6 * tower, style)]
    pick = rng.random()
    if pick < 0.75:
        rest.append(hand_lever(0.05 + 2.2 * radius, 0.003, style, rng, ("tee", "tee", "wing", "notched")))
        parts += placed(rest, at(x, 0, high))
    else:
        parts += placed(rest, at(x, 0, high))
        parts += quarter_turn(x, high + 0.006, radius, style, rng, ("rack", "motor box"))
    return Model(parts, round(length, 6), "welded", "ball valve")


def _multi_port(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A three- or four-way threaded ball valve (L or T bore): a cube or barrel with hexagon ends, lever above."""
    radius = PIPES[dn].radius
    length = 0.04 + 4.0 * radius
    x, big = length / 2, 1.4 * radius + 0.008
    n, end = max(16, style.round(big)), 0.24 * length
    side = moved(hex_end(dn, 0.0, 1.05 * end + 0.3 * big, style), at(-x))
    ways = [0.5] if rng.random() < 0.5 else ([0.5, -0.5] if rng.random() < 0.4 else [-0.5])
    solids = [hex_end(dn, 0.0, end + 0.2 * big, style), hex_end(dn, length - end - 0.2 * big, length, style)]
    solids += [moved(moved(side, spun("z", np.pi + w * np.pi)), at(x)) for w in ways]
    middle = (
        slab(rounded_rectangle(2 * big, 2 * big, 0.25 * big, 3), -big, big)
        if rng.random() < 0.5
        else moved(ball(1.2 * big, n), at())
    )
    solids.append(moved(middle, at(x)))
    if rng.random() < 0.4:
        solids = [
            *solids,
            *(
                along("x", slab(circle(1.15 * big, 8, phase=np.pi / 8), *span(x + s * big, x + s * (big + 0.006))))
                for s in (-1, 1)
            ),
        ]
    high = 1.25 * big + 0.008
    parts = [metal(merge(solids)), *stem_top(x, 0.9 * big, high, radius, style, rng)]
    parts += quarter_turn(x, high + 0.004 + 0.2 * radius, radius, style, rng, ("lever", "lever", "rack", "motor box"))
    return Model(parts, round(length, 6), "welded", "three-way valve")


def _cut_open(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A ball valve cut open for show: part of the body away, polished ball, seats, stem and lever in sight."""
    radius, bore, size = PIPES[dn].radius, PIPES[dn].bore, FLANGES[dn]
    length = FACE_TO_FACE["ball"][dn]
    x, big = length / 2, 1.75 * radius + 0.01
    n = max(8, style.round(big) * 3 // 4)
    neck, back = neck_of(dn)
    lip = float(rng.uniform(1.0, 1.2)) * big
    outer = [
        (size.outer / 2, 0.0),
        (size.outer / 2, back),
        (neck, back),
        (big, 0.3 * length),
        (lip, 0.32 * length),
        (lip, 0.4 * length),
        (big, 0.42 * length),
        (big, 0.7 * length),
        (neck, length - back),
        (size.outer / 2, length - back),
        (size.outer / 2, length),
    ]
    reach, hollow = min(1.3 * bore, 0.3 * length), min(1.5 * bore, 0.93 * big)
    inner = [
        (bore, length),
        (bore, x + reach),
        (hollow, x + 0.8 * reach),
        (hollow, x - 0.8 * reach),
        (bore, x - reach),
        (bore, 0.0),
    ]
    gap = float(rng.uniform(0.4, 0.7)) * np.pi
    shell = about_x(part_turned(np.array(outer + inner), 0.85 * np.pi + 0.5 * gap, 2.85 * np.pi - 0.5 * gap, n))
    turn, ball_ = some_turn(rng), 1.42 * bore * 0.98
    seat = along("x", ring(1.02 * bore, 1.2 * bore, 0.0, 0.15 * bore, max(16, n)))
    far = float(np.sqrt(ball_**2 - (1.1 * bore) ** 2))
    high = max(1.3 * big, 0.5 * size.outer) + 0.01
    boss = 0.35 * radius + 0.008
    rest: list[Part] = [
        metal(ring(0.5 * boss, boss, 0.93 * big, high, 16)),
        shaft(0.95 * ball_, high + 0.015, 0.45 * boss, style),
        *placed(packing(0.45 * boss, style, rng, 1)[0], at(0, 0, high - 0.001)),
        trim(valve_ball(ball_, bore, style, turn), "valve ball"),
        *(Part(moved(seat, at(s)), "gasket", "rubber", BODY, "Pipe assembly") for s in (far, -far - 0.15 * bore)),
    ]
    drive = (
        [hand_lever(0.1 + 2.2 * radius, 0.0, style, rng)]
        if rng.random() < 0.8
        else [hand_wheel(0.05 + radius, 0.0, style, rng)]
    )
    return Model(
        [metal(shell), *placed([*rest, *placed(drive, at(0, 0, high + 1.2 * boss))], at(x))], length, kind="ball valve"
    )


def _blocked(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A high-pressure block ball valve of hydraulics: a square steel block, screwed-in hexagon ends, a bent lever."""
    radius = PIPES[dn].radius
    block, end = 2.4 * radius + 0.02, 1.1 * radius + 0.012
    length, x, bore = block + 2 * end, block / 2 + end, bore_of(dn, style)
    half = 1.35 * radius + 0.006
    core = along("x", slab(rounded_rectangle(2 * half, 2 * half, 0.08 * half, 2), end, end + block))
    ends = [along("x", ring(bore, 1.15 * radius, 0.0, end, 16))]
    ends += [
        along("x", hexagon(2.5 * radius, 0.5 * end, end, bore, 16), 0.0),
        moved(ends[0], at(length - end)),
        along("x", hexagon(2.5 * radius, 0.0, 0.5 * end, bore, 16), length - end),
    ]
    holes = along(
        "y",
        merge([moved(ring(0.004, 0.007, -half - 0.001, half + 0.001, 10), at(0, 0, 0))]),
        x - 0.3 * block,
        0,
        -0.7 * half,
    )
    parts = [metal(merge([core, *ends, holes])), trim(hexagon(1.0 * half, half - 0.001, half + 0.006), "gland", x)]
    stop = cylinder(0.004, half, half + 0.012, 8)
    rest = [
        shaft(half - 0.01, half + 0.02, 0.3 * half, style),
        hand_lever(0.09 + 2.4 * radius, half + 0.007, style, rng, ("bar", "sheet", "tee", "sheet")),
        metal(moved(stop, at(0.7 * half, 0.5 * half))),
    ]
    return Model(
        [*parts, *placed(rest, at(x)), *ball_inside(dn, x, style, rng)], round(length, 6), "welded", "ball valve"
    )


_SMALL = tuple(dn for dn in SIZES if dn <= 50)
_MID = tuple(dn for dn in SIZES if dn <= 150)


UNIONS: tuple[Family, ...] = (
    valve_family("ball valve/sanitary clamp", _sanitary, tuple(dn for dn in SIZES if dn <= 100)),
    valve_family("ball valve/true union", _true_union, tuple(dn for dn in SIZES if dn <= 100)),
    valve_family("ball valve/multi-port", _multi_port, _SMALL),
    valve_family("ball valve/cut open", _cut_open, _MID),
    valve_family("ball valve/block", _blocked, _SMALL),
)
