"""Stairs: spiral, of concrete, on strings or a spine, folded, step-overs."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.steel.floor import panel
from cadplants.families.steel.shape import (
    bar,
    base,
    chance_ as chance,
    few_sides,
    flat,
    floor_family,
    num,
    piece,
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, cylinder, dome, ring
from cadplants.transforms import at, spun

__all__ = ["STAIRS"]


def _spiral(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spiral stair: wedge treads round a column, balusters and a winding handrail (EN ISO 14122-3 going)."""
    radius, rise, count = num(rng, 0.6, 1.1), num(rng, 0.18, 0.22), int(rng.integers(6, 15))
    step, core = 2 * np.pi / pick(rng, 12, 14, 16), num(rng, 0.05, 0.09)
    h = rise * count
    n = few_sides(style, core, 24)
    plates, low = base(0, 0, (5 * core, 5 * core), style, rng)
    parts = [
        *plates,
        piece(moved(cylinder(core, low, h + 1.0, n), at()), "column"),
        piece(dome(core, 0.5 * core, h + 1.0, n), "plate"),
    ]
    a = np.linspace(0, step * 1.1, 5)
    wedge = np.vstack(
        [0.9 * core * np.column_stack([np.cos(a), np.sin(a)])[::-1], radius * np.column_stack([np.cos(a), np.sin(a)])]
    )
    solid = slab_xy(wedge, -0.03, 0.0)
    if chance(rng, 0.5):
        solid = merge([solid, ring(0.98 * core, 1.3 * core, -0.2, 0.001, n)])
    for k in range(count):
        pose = at(0, 0, rise * (k + 1)) @ spun("z", step * k)
        parts.append(piece(moved(solid, pose), "stair tread", pick(rng, "steel", "steel", "clamp")))
        x, y = (radius - 0.03) * np.cos(step * (k + 0.5)), (radius - 0.03) * np.sin(step * (k + 0.5))
        parts.append(
            piece(pipe([(x, y, rise * (k + 1)), (x, y, rise * (k + 1.5) + 0.95)], 0.01, style), "post", "safety")
        )
    t = np.linspace(0.5, count - 0.5, 2 * count)
    path = np.column_stack(
        [(radius - 0.03) * np.cos(step * t), (radius - 0.03) * np.sin(step * t), rise * (t + 1.0) + 0.95]
    )
    parts.append(piece(pipe(path, 0.021, style), "railing", "safety"))
    return Model(parts)


def _concrete_flight(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A concrete flight in one piece, solid or as a sloped slab, maybe with cheek walls, nosings and a railing."""
    count, rise, go, wide = int(rng.integers(2, 10)), num(rng, 0.15, 0.19), num(rng, 0.25, 0.32), num(rng, 0.7, 1.6)
    outline = [(0.0, 0.0)]
    for k in range(count):
        outline += [(k * go, (k + 1) * rise), ((k + 1) * go, (k + 1) * rise)]
    run, h = count * go, count * rise
    under = [(run, 0.0)] if chance(rng, 0.5) or count < 4 else [(run, h - 0.2), (0.35, 0.0)]
    solid = slab_xz(np.array([*outline, *under][::-1]), wide)
    parts = [piece(solid, "stair tread", "concrete")]
    if chance(rng, 0.35):
        cheek = [(-0.1, 0), (run, 0), (run, h + 0.15), (-0.1, 0.15)]
        parts += [piece(slab_xz(cheek, 0.15, s * (wide / 2 + 0.075)), "wall", "concrete") for s in (-1, 1)]
    elif under[0][1] > 0:
        parts.append(piece(box((0.3, wide, h - 0.2), (run - 0.15 + 0.3, 0, (h - 0.2) / 2)), "wall", "concrete"))
    if chance(rng, 0.4):
        parts += [
            piece(box((0.05, wide, 0.004), (k * go + 0.025, 0, (k + 1) * rise + 0.002)), "plate", "clamp")
            for k in range(count)
        ]
    if chance(rng, 0.6):
        y = wide / 2 - 0.06
        ends = [(0.5 * go, y, rise + 0.9), (run - 0.5 * go, y, h + 0.9)]
        parts.append(piece(pipe(ends, 0.021, style), "railing", "safety"))
        for k in sorted({0, count // 2, count - 1}):
            x = (k + 0.5) * go
            parts.append(
                piece(pipe([(x, y, (k + 1) * rise), (x, y, (k + 1) * rise + 0.9)], 0.019, style), "post", "safety")
            )
    return Model(parts)


def _flight(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A steel flight: channel, plate, tube or toothed strings or one spine; treads with end plates, nosings."""
    count, rise, go, wide = int(rng.integers(3, 11)), num(rng, 0.16, 0.21), num(rng, 0.22, 0.28), num(rng, 0.6, 1.2)
    run, h = count * go, count * rise
    slope = np.arctan2(rise, go)
    kind = pick(rng, "U", "flat", "RHS", "toothed", "spine")
    parts: list[Part] = []
    if kind == "toothed":
        teeth = [(k * go + d, (k + e) * rise - 0.03) for k in range(count) for d, e in ((0.0, 1), (go, 1))]
        low = [(run, h - 0.25), (0.0, -0.0)]
        for s in (-1, 1):
            parts.append(piece(slab_xz(np.array([*teeth, *low][::-1]), 0.012, s * (wide / 2 - 0.1)), "beam"))
    elif kind == "spine":
        one = section(pick(rng, "RHS", "SHS", "CHS", "H"), num(rng, 0.12, 0.2), style)
        drop = float(one[0][:, 1].max()) / np.cos(slope)
        parts.append(piece(bar((0.0, 0, rise - drop - 0.12), (run - go, 0, h - drop - 0.12), one), "beam"))
    else:
        one = section(kind, num(rng, 0.16, 0.22), style)
        parts += [piece(bar((0, s * wide / 2, 0), (run, s * wide / 2, h), one), "beam") for s in (-1, 1)]
    tread, deep = pick(rng, "bar", "fold", "sheet", "perforated", "planks"), go + 0.02
    more = 0.024 if tread in ("fold", "planks", "sheet") else 0.0
    for k in range(count):
        x, z = (k + 0.5) * go, (k + 1) * rise - 0.03
        solids = [moved(panel(tread, deep, wide - 0.02, 0.03, style), at(x, 0, z))]
        if chance(rng, 0.5):
            solids.append(box((0.03, wide - 0.02, 0.006), (x - deep / 2 + 0.015, 0, z + 0.033)))
        if kind in ("U", "flat", "RHS"):
            solids += [box((deep, 0.004, 0.06), (x, s * (wide / 2 - 0.012), z)) for s in (-1, 1)]
        if kind == "spine":
            parts.append(piece(box((0.15, 0.3, 0.125 + more), (x - go / 2, 0, z - 0.0625 + more / 2)), "bracket"))
        parts.append(piece(merge(solids), "stair tread", "clamp"))
    if chance(rng, 0.7):
        for s in (-1, 1) if chance(rng, 0.6) else (1,):
            y = s * (wide / 2 - (0.1 if kind == "toothed" else 0.0))
            path = [(0.02, y, 0.95), (run, y, h + 0.95), (run + 0.2, y, h + 0.95)]
            parts.append(piece(pipe(path, 0.021, style, 0.1), "railing", "safety"))
            for f in np.linspace(0.08, 0.95, max(2, count // 3)):
                z = f * h + (0.0 if kind in ("U", "flat", "RHS") else 0.1)
                parts.append(piece(pipe([(f * run, y, z), (f * run, y, f * h + 0.95)], 0.019, style), "post", "safety"))
    return Model(parts)


def _crossover(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A step-over or a low step block: treads up one or both sides of a small platform, folded or framed."""
    count, rise, go, wide = int(rng.integers(1, 5)), num(rng, 0.17, 0.23), num(rng, 0.22, 0.28), num(rng, 0.5, 0.9)
    land, both, h = num(rng, 0.4, 1.2), chance(rng, 0.6), 0.0
    h = rise * (count + 1)
    kind = pick(rng, "bar", "sheet", "perforated", "fold")
    parts = [piece(moved(panel(kind, land, wide, 0.03, style), at(0, 0, h - 0.03)), "platform", "clamp")]
    one = section(pick(rng, "flat", "U", "RHS"), 0.12, style)
    for way in (-1, 1) if both else (1,):
        foot = way * (land / 2 + go * count)
        for s in (-1, 1):
            parts.append(piece(bar((foot, s * wide / 2, 0.05), (way * land / 2, s * wide / 2, h - 0.05), one), "beam"))
        for k in range(count):
            x = way * (land / 2 + go * (count - k - 0.5))
            parts.append(
                piece(
                    moved(panel(kind, go, wide, 0.03, style), at(x, 0, rise * (k + 1) - 0.03)), "stair tread", "clamp"
                )
            )
    for x in (-land / 2, land / 2):
        for s in (-1, 1):
            leg = section("SHS", 0.04, style)
            parts.append(piece(bar((x, s * wide / 2, 0), (x, s * wide / 2, h - 0.03), leg), "column"))
    if chance(rng, 0.6):
        for s in (-1, 1):
            y = s * wide / 2
            path = [
                (-land / 2, y, h - 0.03),
                (-land / 2, y, h + 0.95),
                (land / 2, y, h + 0.95),
                (land / 2, y, h - 0.03),
            ]
            parts.append(piece(pipe(path, 0.019, style, 0.12), "railing", "safety"))
    return Model(parts)


def _zigzag(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Steps folded from one plate (zigzag), with or without side strings."""
    count, rise, go, wide = int(rng.integers(2, 8)), num(rng, 0.16, 0.2), num(rng, 0.24, 0.3), num(rng, 0.6, 1.1)
    line = [(0.0, 0.0)]
    for k in range(count):
        line += [(k * go, (k + 1) * rise), ((k + 1) * go, (k + 1) * rise)]
    thick = pick(rng, 0.005, 0.008, 0.06)
    parts = [
        piece(slab_xz(ribbon(np.array(line), thick), wide), "stair tread", "steel" if thick < 0.02 else "concrete")
    ]
    run, h = count * go, count * rise
    if chance(rng, 0.6):
        for s in (-1, 1):
            plate = flat((0, s * (wide / 2 + 0.005), 0.08), (run, s * (wide / 2 + 0.005), h + 0.08), 0.28, 0.01)
            parts.append(piece(plate, "beam"))
    parts.append(
        piece(
            box((0.2, wide, h - thick / 2), (run - 0.1, 0, (h - thick / 2) / 2)),
            pick(rng, "wall", "foundation"),
            "concrete",
        )
    )
    return Model(parts)


STAIRS: tuple[Family, ...] = (
    floor_family("stairs/spiral", _spiral, 1.0, "fitting"),
    floor_family("stairs/concrete", _concrete_flight, 0.8, "fitting"),
    floor_family("stairs/strings and spine", _flight, 1.5, "fitting"),
    floor_family("stairs/step over", _crossover, 1.0, "fitting"),
    floor_family("stairs/zigzag", _zigzag, 0.7, "fitting"),
)
