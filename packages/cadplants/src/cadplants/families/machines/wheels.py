"""Impellers on their own and in a pump that is cut open."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import CASING, PUMP, base, slab
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, ring, turned
from cadplants.transforms import at, spun

__all__ = ["WHEELS"]


def _wheel(kind: str, r: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[Solid, float]:
    """An impeller about z, its hub from 0 up; and its height."""
    n, count = style.round(r), int(rng.integers(3, 9))
    wide = float(rng.uniform(0.18, 0.4)) * r
    wrap = float(rng.uniform(0.8, 1.9))
    a = np.linspace(0, 1, 9)
    line = np.column_stack([(0.34 + 0.65 * a) * r * np.cos(wrap * a), (0.34 + 0.65 * a) * r * np.sin(wrap * a)])
    turn = np.array([[np.cos(0.07), np.sin(0.07)], [-np.sin(0.07), np.cos(0.07)]])
    vane = extrude(np.vstack([line, (line @ turn)[::-1]]), 0.03 * r, wide)
    hub = ring(0.12 * r, 0.26 * r, 0.0, wide + 0.15 * r, n)
    back = ring(0.12 * r, r, 0.0, 0.05 * r, n)
    if kind == "closed":
        front = ring(0.48 * r, r, wide - 0.01 * r, wide + 0.05 * r, n)
        lip = ring(0.46 * r, 0.56 * r, wide, wide + 0.28 * r, n)
        return merge([back, around(vane, count), front, lip, hub]), wide + 0.28 * r
    if kind == "double":
        half = merge(
            [
                around(vane, count),
                ring(0.48 * r, r, wide - 0.01 * r, wide + 0.05 * r, n),
                ring(0.46 * r, 0.54 * r, wide, wide + 0.2 * r, n),
            ]
        )
        whole = merge(
            [
                half,
                moved(half, spun("x", np.pi)),
                ring(0.12 * r, r, -0.03 * r, 0.03 * r, n),
                ring(0.12 * r, 0.24 * r, -wide, wide, n),
            ]
        )
        return moved(whole, at(0, 0, wide + 0.2 * r)), 2 * wide + 0.4 * r
    if kind == "propeller":
        blade = moved(box((0.75 * r, 0.5 * r, 0.05 * r), (0.6 * r, 0, 0)), at(0, 0, 0.25 * r) @ spun("x", 0.5))
        return merge(
            [
                around(blade, int(rng.integers(3, 6))),
                ring(0.12 * r, 0.3 * r, 0.0, 0.5 * r, n),
                around(box((0.02 * r, 0.1 * r, 0.5 * r), (0.3 * r, 0, 0.25 * r)), 3),
            ]
        ), 0.5 * r
    if kind == "vortex":
        flat = box((0.7 * r, 0.07 * r, wide), (0.6 * r, 0, wide / 2 + 0.02 * r))
        return merge([back, around(flat, count + 2), hub]), wide + 0.15 * r
    if kind == "peripheral":
        tooth = box((0.12 * r, 0.03 * r, 0.16 * r), (0.94 * r, 0, 0.08 * r))
        return merge(
            [
                ring(0.12 * r, 0.9 * r, 0.04 * r, 0.12 * r, n),
                around(tooth, 28),
                ring(0.12 * r, 0.25 * r, 0.0, 0.16 * r, n),
            ]
        ), 0.16 * r
    return merge([back, around(vane, count), hub]), wide + 0.15 * r


def _wheels(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Impellers on arbors of a rack or lying on a table: open, closed, double, vortex, peripheral, propeller."""
    parts, x = [], 0.0
    level = float(rng.uniform(0.6, 1.0))
    kinds = [
        pick(rng, "open", "closed", "double", "propeller", "vortex", "peripheral")
        for _ in range(int(rng.integers(1, 4)))
    ]
    for kind in kinds:
        r = float(rng.uniform(0.06, 0.22))
        wheel, tall = _wheel(kind, r, style, rng)
        x += r + 0.05
        lying = rng.random() < 0.5
        if lying:
            parts.append(Part(moved(wheel, at(x, 0, level)), "impeller", "trim"))
        else:
            rise = level + 1.25 * r
            parts.append(Part(moved(along("y", wheel), at(x, -tall / 2, rise)), "impeller", "trim"))
            arbor = turned(
                [
                    (0.118 * r, -0.9 * r - tall),
                    (0.118 * r, 0.7 * tall),
                    (0.08 * r, 0.72 * tall),
                    (0.08 * r, 1.2 * tall),
                ],
                16,
            )
            parts.append(Part(along("y", arbor, x, 0, rise), "shaft", "trim"))
            foot = box((0.6 * r, 0.12 * r, rise - level + 0.1 * r), (x, -tall - 0.7 * r, (rise + level + 0.1 * r) / 2))
            parts.append(Part(foot, "bracket", "steel", "", "Connection assembly"))
        x += r + 0.05
    top = box((x + 0.1, 0.7, 0.03), (x / 2, -0.05, level - 0.015))
    legs = [box((0.05, 0.05, level - 0.03), (a, b, (level - 0.03) / 2)) for a in (0.0, x) for b in (-0.33, 0.23)]
    parts.append(Part(top, "plate", "steel", "", "Structural element"))
    parts += [Part(leg, "post", "steel", "", "Structural element") for leg in legs]
    return Model(parts, kind="impeller")


def _cutaway(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cutaway pump for teaching: half of a casing round an open impeller on its shaft, bearing bracket, stand."""
    r, seat = float(rng.uniform(0.1, 0.2)), float(rng.choice([0.03, 0.08, 0.7]))
    n, axis = style.round(r), seat + 1.9 * r
    wheel, tall = _wheel(pick(rng, "open", "closed", "vortex"), 0.85 * r, style, rng)
    half, t = tall / 2 + 0.06 * r, 0.08 * r
    a = np.linspace(np.pi, 2 * np.pi, max(9, n // 2))
    outer = np.column_stack([np.cos(a), np.sin(a)]) * (1.3 * r)
    inner = np.column_stack([np.cos(a), np.sin(a)]) * (1.05 * r)
    rim = slab(np.vstack([outer, inner[::-1]]), -half, half)
    cheek = slab(np.vstack([outer, 0.3 / 1.3 * outer[::-1]]), half, half + t)
    front = slab(np.vstack([outer, 0.5 / 1.3 * outer[::-1]]), -half - t, -half)
    shell = moved(merge([rim, cheek, front]), at(0, 0, axis))
    back = half + t
    bracket = turned(
        [
            (0.32 * r, back - t),
            (0.32 * r, back + 0.3 * r),
            (0.45 * r, back + 0.35 * r),
            (0.45 * r, back + 1.6 * r),
            (0.2 * r, back + 1.65 * r),
        ],
        n,
    )
    foot = [
        box((0.6 * r, 1.2 * r, axis - seat - 1.1 * r), (0, 0, (seat + axis - 1.1 * r) / 2)),
        box((0.2 * r, 0.6 * r, axis - seat - 0.35 * r), (back + 1.3 * r, 0, (seat + axis - 0.35 * r) / 2)),
    ]
    shaft = along("x", cylinder(0.1 * r, -half, back + 2.3 * r, 14), 0, 0, axis)
    parts = [
        Part(merge([shell, *foot[:1]]), CASING, "pump", CASING),
        Part(merge([along("x", bracket, 0, 0, axis), foot[1]]), CASING, "pump", CASING),
        Part(along("-x", moved(wheel, at(0, 0, -tall / 2)), 0, 0, axis), "impeller", "trim"),
        Part(shaft, "shaft", "trim"),
        *base(
            pick(rng, "grid", "beams", "sheet", "rim") if seat > 0.05 else "rim",
            -r,
            back + 2.2 * r,
            2.2 * r,
            min(seat, 0.1),
            [0.0, back + 1.3 * r],
            rng,
        ),
    ]
    if seat > 0.5:
        table = [
            box((back + 3.4 * r, 2.3 * r, 0.04), ((back + 1.2 * r) / 2, 0, seat - 0.12)),
            *(
                box((0.05, 0.05, seat - 0.14), (x, y * r, (seat - 0.14) / 2))
                for x in (-r, back + 2.1 * r)
                for y in (-1, 1)
            ),
        ]
        parts[-1:] = placed(parts[-1:], at(0, 0, seat - 0.1))
        parts += [Part(x, "post" if k else "plate", "steel", "", "Structural element") for k, x in enumerate(table)]
    return Model(parts, kind="centrifugal pump")


WHEELS: tuple[Family, ...] = (
    Family("pump/cutaway", "floor", PUMP, "pump", _cutaway, (15,)),
    Family("impeller/bench", "floor", PUMP, "impeller", _wheels, (15,), "fitting", 1.5),
)
