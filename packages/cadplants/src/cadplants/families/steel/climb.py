"""Ladders: fixed, hooped, ship's, leaning, step ladders, rung irons, mobile steps."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.steel.caster import wheeled
from cadplants.families.steel.floor import panel
from cadplants.families.steel.shape import (
    bar,
    chance_ as chance,
    drawn,
    few_sides,
    filleted,
    floor_family,
    num,
    piece,
    pipe,
    section,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import box, cylinder, ring
from cadplants.transforms import at, spun

__all__ = ["CLIMBS"]


def _rung(kind: str, wide: float, z: float, style: ModelingStyle) -> Solid:
    """A rung about x = 0 at a height: round, square on its edge or flat, a U with teeth, a flat step."""
    a, b = (-wide / 2, 0, z), (wide / 2, 0, z)
    if kind == "round":
        return pipe([a, b], 0.0125, style)
    if kind == "square":
        return bar(a, b, section("square", 0.022, style), (0, 1, 1))
    if kind == "serrated":
        teeth = [box((0.012, 0.026, 0.006), (x, 0, z + 0.012)) for x in np.linspace(-0.4 * wide, 0.4 * wide, 7)]
        return merge([bar(a, b, section("U", 0.026, style), (0, 1, 0)), *teeth])
    return box((wide, 0.08, 0.02), (0, 0, z))


def _side_rails(wide: float, low: float, high: float, rng: np.random.Generator, style: ModelingStyle) -> list[Solid]:
    kind = pick(rng, "flat", "CHS", "L", "RHS", "U")
    one = section(kind, 0.065 if kind in ("flat", "RHS") else 0.048, style)
    return [bar((s * wide / 2, 0, low), (s * wide / 2, 0, high), one, (0, 1, 0)) for s in (-1, 1)]


def _ladder_parts(solids: list[Solid], rng: np.random.Generator, color: str = "safety") -> list[Part]:
    """A ladder as one mesh or in pieces."""
    made = [merge(solids)] if chance(rng, 0.45) else solids
    return [piece(one, "ladder", color, "ladder") for one in made]


def _back(h: float, wide: float, gap: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What a fixed ladder is held by: a wall, a round tower, a pair of columns; and its stand-off brackets."""
    kind, y = int(rng.integers(3)), gap
    parts: list[Part] = []
    if kind == 0:
        parts.append(piece(box((wide + 1.0, 0.2, h), (0, y + 0.1, h / 2)), "wall", "concrete"))
    elif kind == 1:
        r = num(rng, 0.2, 0.6)
        parts.append(piece(moved(cylinder(r, 0, h, few_sides(style, r, 32)), at(0, y + r)), "column", "concrete"))
        y += r - float(np.sqrt(max(r * r - wide * wide / 4, 0.0)))
    else:
        one = drawn(rng, style, 0.14, ("H", "SHS", "U"))
        half = float(one[0][:, 1].max())
        parts += [
            piece(bar((s * wide / 2, y + half, 0), (s * wide / 2, y + half, h), one, (0, 1, 0)), "column")
            for s in (-1, 1)
        ]
    for z in np.linspace(0.35, h - 0.3, max(2, int(h / 1.6))):
        for s in (-1, 1):
            parts.append(piece(box((0.01, y + 0.02, 0.05), (s * (wide / 2 - 0.02), y / 2 - 0.01, z)), "bracket"))
    return parts


def _fixed(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fixed ladder (EN ISO 14122-4): rungs of any kind, walk-through top, on a wall, tower or columns, no cage."""
    h, wide, pitch = num(rng, 1.2, 4.5), num(rng, 0.35, 0.55), num(rng, 0.25, 0.3)
    kind = pick(rng, "round", "square", "serrated", "step")
    solids = _side_rails(wide, 0.0, h, rng, style)
    solids += [_rung(kind, wide, float(z), style) for z in np.arange(pitch, h - 0.05, pitch)]
    top = int(rng.integers(3))
    for s in (-1, 1):
        x = s * wide / 2
        if top == 1:
            bow = [(x, 0, h), (x, 0, h + 0.9), (x, 0.35, h + 0.9), (x, 0.35, h)]
            solids.append(pipe(bow, 0.021, style, 0.15))
        elif top == 2:
            solids.append(pipe([(x, 0, h), (s * 0.32, 0, h + 0.2), (s * 0.32, 0, h + 1.0)], 0.019, style, 0.08))
    if top == 0 and chance(rng, 0.4):
        solids.append(box((0.05, 0.03, h - 0.2), (0, -0.025, h / 2)))
    return Model([*_ladder_parts(solids, rng), *_back(h, wide, num(rng, 0.15, 0.25), style, rng)])


def _hooped(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A ladder with round, square or open hoops of flat bar or tube and three to seven straps (EN ISO 14122-4)."""
    h, wide = num(rng, 2.6, 5.0), num(rng, 0.38, 0.5)
    solids = _side_rails(wide, 0.0, h, rng, style)
    kind = pick(rng, "round", "square", "serrated")
    solids += [_rung(kind, wide, float(z), style) for z in np.arange(0.28, h - 0.05, 0.28)]
    reach, shape = num(rng, 0.6, 0.75), int(rng.integers(3))
    x = 0.35
    path = [(wide / 2, 0), (x, -0.15), (x, -reach), (-x, -reach), (-x, -0.15), (-wide / 2, 0)]
    radius, steps = ((0.34, 6), (0.1, 2), (0.25, 1))[shape]
    corners = np.column_stack([filleted(np.array(path), radius, steps, closed=False)])
    hoop = np.column_stack([corners, np.zeros(len(corners))])
    tubes = chance(rng, 0.3)
    for z in np.linspace(2.2, h, max(2, int((h - 2.2) / 0.8) + 1)):
        if tubes:
            solids.append(moved(pipe(hoop, 0.012, style), at(0, 0, float(z))))
        else:
            solids.append(moved(sweep(hoop, rounded_rectangle(0.04, 0.006, 0.0), up=(0, 0, 1)), at(0, 0, float(z))))
    straps = int(rng.integers(3, 8))
    s = np.cumsum([0, *np.linalg.norm(np.diff(corners, axis=0), axis=1)])
    for t in np.linspace(0.2, 0.8, straps) * s[-1]:
        p = [float(np.interp(t, s, corners[:, k])) for k in (0, 1)]
        solids.append(box((0.03, 0.03, h - 2.2) if tubes else (0.025, 0.012, h - 2.2), (p[0], p[1], (h + 2.2) / 2)))
    return Model([*_ladder_parts(solids, rng), *_back(h, wide, num(rng, 0.15, 0.25), style, rng)])


def _ship(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A ship's or step ladder at 60 to 75 degrees: flat steps between strings, a handrail each side, a landing beam."""
    h, wide, angle = num(rng, 1.0, 3.0), num(rng, 0.45, 0.7), np.radians(num(rng, 60, 75))
    run = h / np.tan(angle)
    one = section(pick(rng, "flat", "U", "RHS"), num(rng, 0.1, 0.16), style)
    parts = [
        piece(bar((0, s * wide / 2, 0), (run, s * wide / 2, h), one), "ladder", "safety", "ladder") for s in (-1, 1)
    ]
    deep, kind = num(rng, 0.08, 0.18), pick(rng, "sheet", "bar", "fold")
    for z in np.arange(0.22, h - 0.1, 0.22):
        step = panel(kind, deep, wide, 0.025, style)
        parts.append(piece(moved(step, at(z / np.tan(angle), 0, z - 0.025)), "stair tread", "clamp", "ladder"))
    for s in (-1, 1) if chance(rng, 0.7) else (1,):
        y = s * (wide / 2 + 0.02)
        off = np.array([-0.25 * np.sin(angle), 0, 0.25 * np.cos(angle)])
        path = [np.array([0.1 * run, y, 0.1 * h]), np.array([0.1 * run, y, 0.1 * h]) + off]
        path += [np.array([run, y, h]) + off, np.array([run, y, h])]
        parts.append(piece(pipe(path, 0.017, style, 0.1), "railing", "handle"))
    edge = drawn(rng, style, 0.14, ("U", "H", "I"))
    parts.append(piece(bar((run + 0.05, -wide, h - 0.07), (run + 0.05, wide, h - 0.07), edge), "beam"))
    parts += [piece(box((0.1, 0.1, h - 0.14), (run + 0.07, s * 0.8 * wide, (h - 0.14) / 2)), "column") for s in (-1, 1)]
    return Model(parts)


def _leaning(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A portable ladder leaning on a wall, single or two overlapped sections (EN 131), with feet; or hung up level."""
    long, wide = num(rng, 1.8, 4.2), num(rng, 0.32, 0.45)
    one = section(pick(rng, "RHS", "timber", "U"), 0.06, style)
    parts, hung = [], chance(rng, 0.25)
    tilt = 0.0 if hung else num(rng, 0.2, 0.35)
    pose = at(0, 0, 0.0) @ spun("x", -tilt)
    for k in range(1 if hung else int(rng.integers(1, 3))):
        low = 0.4 * long * k
        solids = [bar((s * wide / 2, 0, low), (s * wide / 2, 0, low + long), one, (0, 1, 0)) for s in (-1, 1)]
        solids += [
            _rung(pick(rng, "round", "square"), wide, float(z), style)
            for z in np.arange(low + 0.2, low + long - 0.1, 0.28)
        ]
        if k == 0 and not hung:
            solids += [box((0.04, 0.08, 0.03), (s * wide / 2, 0, 0.01)) for s in (-1, 1)]
        move = at(0, -0.06 * k, 0)
        if hung:
            move = at(-long / 2, 0, 1.2) @ spun("y", np.pi / 2)
        parts += _ladder_parts([moved(one_, pose @ move) for one_ in solids], rng, "clamp")
    high = 2.0 if hung else long * np.cos(tilt)
    y = 0.035 if hung else long * np.sin(tilt) + 0.03 * np.cos(tilt)
    parts.append(piece(box((long + 0.4 if hung else 1.6, 0.15, high), (0, y + 0.075, high / 2)), "wall", "concrete"))
    if hung:
        parts += [
            piece(box((0.04, 0.1, 0.03), (x, -0.015, 1.2 - wide / 2 - 0.03)), "bracket")
            for x in (-0.3 * long, 0.3 * long)
        ]
    return Model(parts)


def _steps(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A free-standing step ladder (EN 131): steps between two front stiles, rear struts, a top platform or cap."""
    count, wide = int(rng.integers(2, 8)), num(rng, 0.35, 0.55)
    h, lean = 0.23 * count, num(rng, 0.25, 0.35)
    one = section(pick(rng, "U", "RHS", "timber", "CHS"), 0.05, style)
    joined = chance(rng, 0.4)
    solids, treads = [], []
    for s in (-1, 1):
        solids.append(bar((0, s * (wide / 2 + 0.05), 0), (lean * h, s * wide / 2, h), one))
        solids.append(bar((2.1 * lean * h + 0.1, s * (wide / 2 + 0.03), 0), (lean * h + 0.1, s * wide / 2, h), one))
    for k in range(1, count):
        z = h * k / count
        treads.append(box((0.09, wide + 0.06 * (1 - k / count), 0.025), (lean * z, 0, z)))
    treads.append(box((num(rng, 0.15, 0.35), wide + 0.05, 0.03), (lean * h + 0.05, 0, h + 0.01)))
    solids += [box((0.02, wide, 0.03), (lean * h * (2.1 - 1.1 * f) + 0.1, 0, f * h)) for f in (0.2, 0.6)]
    if chance(rng, 0.4):
        path = [
            (lean * h, -wide / 2, h),
            (lean * h + 0.15, -wide / 2, h + 0.6),
            (lean * h + 0.15, wide / 2, h + 0.6),
            (lean * h, wide / 2, h),
        ]
        solids.append(pipe(path, 0.014, style, 0.08))
    if joined:
        return Model([piece(merge([*solids, *treads]), "ladder", "clamp")])
    return Model(
        [
            *(piece(x, "ladder", "clamp", "ladder") for x in solids),
            *(piece(x, "stair tread", "clamp", "ladder") for x in treads),
        ]
    )


def _irons(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Rung irons cast into a wall, pit or shaft ring (EN 13101): bows one above the other, in one row or staggered."""
    count, wide, reach = int(rng.integers(3, 11)), num(rng, 0.25, 0.4), num(rng, 0.12, 0.2)
    h, r, stagger = 0.3 * count + 0.4, num(rng, 0.009, 0.014), pick(rng, 0.0, 0.0, 0.14)
    parts = []
    if chance(rng, 0.6):
        parts.append(piece(box((1.4, 0.2, h), (0, 0.1, h / 2)), "wall", "concrete"))
    else:
        bend = num(rng, 0.45, 0.7)
        shaft = ring(bend, bend + 0.1, 0, h, few_sides(style, bend, 32))
        parts.append(piece(moved(shaft, at(0, -np.sqrt(bend * bend - wide * wide / 4))), "wall", "concrete"))
    dip = pick(rng, 0.0, 0.03)
    for k in range(count):
        z, x = 0.3 + 0.3 * k, stagger * (-1) ** k
        path = [(-wide / 2, 0.02, z), (-wide / 2, -reach, z), (-wide / 2 + 0.05, -reach, z - dip)]
        path += [(-x_, y_, z_) for x_, y_, z_ in path[::-1]]
        parts.append(piece(moved(pipe(path, r, style, 0.03), at(x)), "ladder"))
    return Model(parts)


def _mobile(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Mobile steps (EN 131-7): a tube frame on casters with treads, a platform and a railing round it."""
    count, wide, r = int(rng.integers(2, 7)), num(rng, 0.5, 0.8), num(rng, 0.04, 0.07)
    go, land = num(rng, 0.19, 0.25), num(rng, 0.4, 0.7)
    run, d = go * count, 0.02
    spots = [(x, s * wide / 2) for x in (0.05, run + land) for s in (-1, 1)]
    parts, low = wheeled(spots, (pick(rng, "swivel", "stem", "fixed"),), r, style, rng)
    h = low + 0.04 + 0.21 * count
    rail = chance(rng, 0.8)
    for s in (-1, 1):
        y = s * wide / 2
        parts.append(piece(pipe([(0, y, low + d), (run + land, y, low + d)], d, style), "ladder", "safety", "ladder"))
        parts.append(piece(pipe([(0.0, y, low + d), (run, y, h)], d, style), "ladder", "safety", "ladder"))
        for x in (run, run + land):
            parts.append(piece(pipe([(x, y, low + d), (x, y, h)], d, style), "post", "safety", "ladder"))
        if rail:
            path = [
                (0.4 * run, y, low + 0.4 * (h - low)),
                (0.4 * run, y, low + 0.4 * (h - low) + 0.8),
                (run, y, h + 0.95),
                (run + land, y, h + 0.95),
                (run + land, y, h),
            ]
            parts.append(piece(pipe(path, 0.8 * d, style, 0.1), "railing", "safety", "ladder"))
    kind = pick(rng, "bar", "sheet", "fold", "perforated")
    for k in range(1, count):
        z = low + (h - low) * k / count
        step = moved(panel(kind, go, wide - 2 * d, 0.025, style), at(run * k / count, 0, z))
        parts.append(piece(step, "stair tread", "clamp", "ladder"))
    parts.append(
        piece(
            moved(panel(kind, land, wide + 2 * d, 0.03, style), at(run + land / 2, 0, h)), "platform", "clamp", "ladder"
        )
    )
    return Model(parts)


CLIMBS: tuple[Family, ...] = (
    floor_family("ladder/fixed", _fixed, 1.2),
    floor_family("ladder/hoops", _hooped, 1.0),
    floor_family("ladder/ship", _ship, 1.0),
    floor_family("ladder/leaning", _leaning, 0.7, "fitting"),
    floor_family("ladder/steps", _steps, 0.8, "fitting"),
    floor_family("ladder/rung irons", _irons, 0.7, "fitting"),
    floor_family("ladder/mobile", _mobile, 0.9, "fitting"),
)
