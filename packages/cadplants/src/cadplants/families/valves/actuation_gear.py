"""Gearboxes on a stem: worm and bevel, with wheels, chainwheels, cranks and squares."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.families.valves.actuation_base import bolted, hand_wheel, indicator, quarter, shaft
from cadplants.families.valves.actuation_hand import cylinder_at, slab
from cadplants.family import Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.plant import Turning
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["bevel", "worm"]

Rng = np.random.Generator


def _input(size: float, reach: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """What turns a gear's input shaft, which leaves along +z: a wheel, a chainwheel and chain, a square, a crank."""
    kind = rng.random()
    rod_ = shaft(-0.01, reach + 0.02, 0.08 * size + 0.003, style)
    if kind < 0.6:
        rim = hand_wheel(size, reach, style, rng)
        return [rod_, replace(rim, turns=Turning("gear operator", point=(0.0, 0.0, reach)))]
    if kind < 0.8:
        n = max(16, style.round(size))
        groove = ring(0.86 * size, 0.96 * size, reach, reach + 0.03, n)
        teeth = around(box((0.12 * size, 0.012, 0.05), (0, 0, reach + 0.015)), 10, size)
        web = around(
            rod((0, 0, reach + 0.015), (0.9 * size, 0, reach + 0.015), 0.05 * size, 6), int(rng.integers(3, 6))
        )
        hub = cylinder(0.15 * size, reach, reach + 0.04, 12)
        # The wheel stands upright beside the case: its chain hangs along the local -x.
        drop, out = float(rng.uniform(0.5, 1.2)), size
        path = [
            (0.0, -out, reach + 0.015),
            (-drop, -out, reach + 0.015),
            (-drop - 0.08, -0.5 * out, reach + 0.015),
            (-drop - 0.08, 0.5 * out, reach + 0.015),
            (-drop, out, reach + 0.015),
            (0.0, out, reach + 0.015),
        ]
        return [rod_, Part(merge([groove, teeth, web, hub, rope(path, 0.004, 6)]), "handwheel", "handle")]
    if kind < 0.9:
        return [
            rod_,
            Part(box((0.22 * size, 0.22 * size, 0.05), (0, 0, reach + 0.02)), "valve stem", "trim", "gearbox"),
        ]
    return [rod_, Part(moved(_crank(size), at(0, 0, reach)), "lever", "handle")]


def _crank(size: float) -> Solid:
    arm = box((size, 0.12 * size, 0.06 * size), (0.45 * size, 0, 0.05 * size))
    return merge(
        [
            arm,
            cylinder(0.14 * size, 0.0, 0.16 * size, 12),
            cylinder_at(0.07 * size, 0.02 * size, 0.6 * size, 0.88 * size),
        ]
    )


def worm(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A worm gearbox: a round, pear-shaped or square case with a stop boss, its shaft to the side."""
    half = float(rng.uniform(0.85, 1.2)) * (0.04 + 0.34 * radius)
    n, tall = max(16, style.round(half)), float(rng.uniform(0.7, 1.1)) * half
    kind = int(rng.integers(3))
    if kind == 0:
        case = turned([(half, 0.0), (half, 0.6 * tall), (0.85 * half, 0.8 * tall), (0.5 * half, tall)], n)
    elif kind == 1:
        turns = np.linspace(0.6 * np.pi, 1.75 * np.pi, 12)
        pear = [(half * float(np.cos(t)), half * float(np.sin(t))) for t in turns]
        case = slab(np.array([*pear, (1.1 * half, -0.7 * half), (1.1 * half, 0.6 * half)]), 0.0, 0.85 * tall)
        case = merge([case, cylinder(0.6 * half, 0.85 * tall, tall, n)])
    else:
        case = slab(rounded_rectangle(2.1 * half, 2.0 * half, 0.3 * half, 3), 0.0, 0.8 * tall)
        case = merge([case, turned([(0.8 * half, 0.8 * tall), (0.7 * half, tall)], n)])
    x, z = 0.75 * half, 0.45 * tall
    tunnel = along(
        "y",
        turned(
            [(0.28 * half, -1.1 * half), (0.36 * half, -0.8 * half), (0.36 * half, 0.8 * half), (0.22 * half, half)], 12
        ),
        x,
        0,
        z,
    )
    screws = around(hexagon(0.012 + 0.05 * half, 0.6 * tall, tall), 4, 0.9 * half, 0.8)
    parts = [Part(merge([case, tunnel]), "gearbox", "valve", "gearbox"), bolted(screws, "gearbox")]
    drive = _input(
        float(rng.uniform(0.8, 1.3)) * (0.05 + 0.8 * radius), float(rng.uniform(0.3, 1.4)) * half, style, rng
    )
    parts += placed(drive, at(x, -1.05 * half, z) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2))
    if rng.random() < 0.75:
        parts.append(replace(placed([indicator(0.4 * half, style, rng)], at(0, 0, tall))[0], bundle="gearbox"))
    return placed(parts, quarter(rng))


def bevel(radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A bevel gearbox: a bell on the stem with a cone to the side, a stem cover pipe above."""
    half = 0.045 + 0.4 * radius
    n = max(16, style.round(half))
    bell = turned(
        [
            (1.1 * half, 0.0),
            (1.1 * half, 0.15 * half),
            (0.8 * half, 0.3 * half),
            (0.95 * half, 0.9 * half),
            (0.9 * half, 1.3 * half),
            (0.4 * half, 1.5 * half),
        ],
        n,
    )
    cone = along(
        "-y",
        turned(
            [(0.75 * half, 0.3 * half), (0.5 * half, 1.2 * half), (0.55 * half, 1.3 * half), (0.55 * half, 1.5 * half)],
            n,
        ),
        0,
        0,
        0.75 * half,
    )
    parts = [Part(merge([bell, cone]), "gearbox", "valve", "gearbox")]
    if rng.random() < 0.6:
        cover = turned(
            [
                (0.22 * half, 1.45 * half),
                (0.22 * half, 1.5 * half + float(rng.uniform(1, 4)) * half),
                (0.1 * half, 5.8 * half),
            ],
            12,
        )
        parts.append(Part(cover, "gearbox", "trim", "gearbox"))
    drive = _input(0.06 + 0.9 * radius, 0.35 * half, style, rng)
    return placed(
        [*parts, *placed(drive, at(0, -1.5 * half, 0.75 * half) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2))],
        quarter(rng),
    )
