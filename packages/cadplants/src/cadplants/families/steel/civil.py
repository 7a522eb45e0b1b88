"""Foundations and walls: blocks, rings, pile caps, plinths; masonry, clad walls, bunds, retaining walls."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    bar,
    base,
    bolted,
    chance_ as chance,
    drawn,
    few_sides,
    floor_family,
    num,
    piece,
    rect,
    ribbon,
    section,
    slab_xy,
    slab_xz,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, loft, merge, moved, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, cylinder, ring, turned
from cadplants.transforms import at, spun

__all__ = ["CIVIL"]


def _frustum(low: Floats, high: Floats, z: tuple[float, float]) -> Solid:
    """A solid between two outlines of as many corners at two heights."""
    loops = [np.column_stack([one, np.full(len(one), h)]) for one, h in zip((low, high), z, strict=True)]
    ends = [loops[0].mean(axis=0, keepdims=True), loops[1].mean(axis=0, keepdims=True)]
    return weld([loft([ends[0], *loops, ends[1]])])


def _plinth(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Equipment plinths: chamfered, battered, with a step or recess, round; with grout, sole plates and anchors."""
    a, b, h, kind = num(rng, 0.4, 2.4), num(rng, 0.3, 1.4), num(rng, 0.08, 0.8), int(rng.integers(5))
    chamfer = min(0.03, 0.3 * h)
    if kind == 0:
        solid = merge(
            [
                extrude(rect(a, b), 0, h - chamfer),
                _frustum(rect(a, b), rect(a - 2 * chamfer, b - 2 * chamfer), (h - chamfer, h)),
            ]
        )
    elif kind == 1:
        solid = _frustum(rect(a + 0.4 * h, b + 0.4 * h), rect(a, b), (0, h))
    elif kind == 2:
        solid = slab_xz([(-a / 2, 0), (a / 2, 0), (a / 2, h), (0, h), (0, 0.6 * h), (-a / 2, 0.6 * h)], b)
    elif kind == 3:
        r = a / 2
        solid, b = turned([(r, 0), (r, h - chamfer), (r - chamfer, h)], few_sides(style, r, 40)), a
    else:
        pit = (rect(0.5 * a, 0.4 * b),)
        solid = extrude(rect(a, b), 0, h, pit)
    parts = [piece(solid, "foundation", "concrete")]
    if chance(rng, 0.4):
        parts.append(
            piece(box((a + 0.8, b + 0.8, 0.15), (0, 0, -0.075)), pick(rng, "ground", "foundation"), "concrete")
        )
    shift = 0.25 * a if kind == 2 else 0.0
    spots = [(shift + sx * 0.3 * a * (0.6 if kind == 2 else 1), sy * 0.32 * b) for sx in (-1, 1) for sy in (-1, 1)]
    top = int(rng.integers(4))
    if top == 0:
        parts += bolted([at(x, y, h) for x, y in spots], pick(rng, 0.012, 0.016, 0.02), style, 0.03)
    elif top == 1 and kind != 4:
        parts += [piece(box((0.16, 0.12, 0.02), (x, y, h + 0.01)), "base plate") for x, y in spots]
        parts += bolted([at(x, y, h + 0.02) for x, y in spots], 0.014, style, 0.02)
    elif top == 2 and kind < 2:
        parts.append(piece(box((0.8 * a, 0.8 * b, 0.03), (0, 0, h + 0.015)), "foundation", "ground"))
        parts.append(piece(box((0.74 * a, 0.74 * b, 0.015), (0, 0, h + 0.0375)), "base plate"))
    return Model(parts)


def _footing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Footings of columns: pad with pedestal, sloped pad, socket, pile cap on piles; a stub column with its plate."""
    a, kind = num(rng, 0.8, 2.0), int(rng.integers(4))
    p, deep = num(rng, 0.3, 0.5), num(rng, 0.25, 0.5)
    h = deep + num(rng, 0.2, 0.7)
    solids: list[Solid] = [box((a, a, deep), (0, 0, deep / 2))]
    parts: list[Part] = []
    if kind == 1:
        solids = [
            box((a, a, 0.6 * deep), (0, 0, 0.3 * deep)),
            _frustum(rect(a, a), rect(1.2 * p, 1.2 * p), (0.6 * deep, deep)),
        ]
    if kind == 3:
        n = few_sides(style, 0.15, 24)
        parts = [
            piece(moved(cylinder(0.15, -1.0, 0.0, n), at(x * 0.3 * a, y * 0.3 * a)), "foundation", "concrete")
            for x in (-1, 1)
            for y in (-1, 1)
        ]
    if kind == 2:
        solids.append(extrude(rect(1.6 * p, 1.6 * p), deep, h, (rect(1.05 * p, 1.05 * p),)))
        parts.append(piece(box((0.95 * p, 0.95 * p, num(rng, 1.0, 2.5)), (0, 0, deep + 0.5)), "column", "concrete"))
        top = parts[-1].solid.vertices
        top[:, 2] += deep - top[:, 2].min()
    else:
        solids.append(extrude(pick(rng, rect(p, p), circle(p / 2, few_sides(style, p / 2, 32))), deep, h))
        one = drawn(rng, style, 0.5 * p, ("H", "SHS", "CHS", "I"))
        plates, z = base(0, 0, (0.8 * p, 0.8 * p), style, rng, h)
        parts += [*plates, piece(bar((0, 0, z), (0, 0, z + num(rng, 0.3, 1.5)), one, (0, 1, 0)), "column")]
    made = [merge(solids)] if chance(rng, 0.5) else solids
    return Model([*(piece(one_, "foundation", "concrete") for one_ in made), *parts])


def _ring_base(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tank's base: a ring wall with sand, an octagon or round slab, chairs and anchors round it (API 650)."""
    r, h, kind = num(rng, 0.6, 2.0), num(rng, 0.15, 0.6), int(rng.integers(3))
    n = few_sides(style, r, 48)
    w = num(rng, 0.2, 0.4)
    if kind == 0:
        parts = [piece(ring(r - w / 2, r + w / 2, 0, h, n), "foundation", "concrete")]
        parts.append(piece(cylinder(r - w / 2, 0, h - 0.02, n), "ground", "ground"))
    elif kind == 1:
        parts = [piece(cylinder(r + w, 0, h, 8), "foundation", "concrete")]
    else:
        parts = [
            piece(
                turned([(r + w, 0), (r + w, 0.5 * h), (r + 0.3 * w, 0.5 * h), (r + 0.3 * w, h)], n),
                "foundation",
                "concrete",
            )
        ]
    if chance(rng, 0.6):
        count = int(rng.integers(6, 13))
        angles = np.arange(count) * 2 * np.pi / count
        reach = r
        poses = [spun("z", float(t)) @ at(reach, 0, h) for t in angles]
        parts += [piece(moved(box((0.12, 0.12, 0.012), (0, 0, 0.006)), pose), "base plate") for pose in poses]
        parts += bolted([pose @ at(0, 0, 0.012) for pose in poses], 0.02, style, 0.012)
    return Model(parts)


def _strip(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Sleepers and strips: a row of sleepers, an upturned T strip, a raft with ribs, precast blocks under a beam."""
    long, count, kind = num(rng, 0.6, 2.0), int(rng.integers(2, 5)), int(rng.integers(4))
    w, h, gap = num(rng, 0.15, 0.5), num(rng, 0.15, 0.5), num(rng, 0.8, 1.6)
    parts: list[Part] = []
    for k in range(count):
        x = k * gap
        if kind == 0:
            shape = [(x - w / 2, 0), (x + w / 2, 0), (x + 0.4 * w, h), (x - 0.4 * w, h)]
            parts.append(piece(slab_xz(shape, long), "foundation", "concrete"))
            if chance(rng, 0.6):
                parts.append(piece(box((0.1, 0.8 * long, 0.01), (x, 0, h + 0.005)), "plate"))
        elif kind == 1:
            shape = [
                (x - w, 0),
                (x + w, 0),
                (x + w, 0.4 * h),
                (x + 0.4 * w, 0.4 * h),
                (x + 0.4 * w, h),
                (x - 0.4 * w, h),
                (x - 0.4 * w, 0.4 * h),
                (x - w, 0.4 * h),
            ]
            parts.append(piece(slab_xz(shape, long), "foundation", "concrete"))
        elif kind == 2:
            parts.append(piece(box((w, long, h), (x, 0, h / 2)), "foundation", "concrete"))
        else:
            parts.append(piece(_frustum(rect(1.4 * w, 1.4 * w, x), rect(w, w, x), (0, h)), "foundation", "concrete"))
    if kind == 2:
        parts.append(
            piece(box((count * gap, long + 0.2, 0.2), ((count - 1) * gap / 2, 0, -0.1)), "foundation", "concrete")
        )
    if kind in (2, 3):
        one = drawn(rng, style, num(rng, 0.1, 0.2), ("H", "U", "RHS"))
        z = h - float(one[0][:, 1].min())
        parts.append(piece(bar((-0.2, 0, z), ((count - 1) * gap + 0.2, 0, z), one), pick(rng, "beam", "skid frame")))
    return Model(parts)


# --- walls ---


def _brick(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Masonry: courses of blocks (one mesh or block by block) with pilasters and coping."""
    long, h, t = num(rng, 1.0, 3.5), num(rng, 0.5, 2.6), pick(rng, 0.115, 0.175, 0.24)
    block = (pick(rng, 0.4, 0.5), 0.2) if chance(rng, 0.7) else (0.25, 0.125)
    rows, solids = max(2, int(h / block[1])), []
    if rows * long / block[0] > 90:
        block = (block[0] * 2, block[1] * 2)
        rows = max(2, int(h / block[1]))
    for k in range(rows):
        edges = [0.0, *np.arange(block[0] * (0.5 if k % 2 else 1.0), long - 0.02, block[0]), long]
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            solids.append(box((b - a - 0.002, t, block[1] - 0.001), ((a + b) / 2, 0, (k + 0.5) * block[1])))
    top = rows * block[1]
    parts = [piece(one, "wall", "concrete", "wall") for one in ([merge(solids)] if chance(rng, 0.8) else solids)]
    for x in np.linspace(0.15, long - 0.15, int(rng.integers(0, 4))):
        parts.append(piece(box((0.3, t + 0.2, top), (x, 0, top / 2)), pick(rng, "wall", "column"), "concrete"))
    if chance(rng, 0.6):
        parts.append(piece(slab_xy(rect(long + 0.06, t + 0.1, long / 2), top, top + 0.05), "wall", "ground", "wall"))
    parts.append(piece(box((long + 0.3, t + 0.3, 0.2), (long / 2, 0, -0.1)), "foundation", "concrete"))
    return Model(parts)


def _panel_wall(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hall's wall: posts and rails clad with trapezoidal or sandwich sheet, upright or level, with door or window."""
    count, w, h = int(rng.integers(1, 4)), num(rng, 1.2, 2.4), num(rng, 2.0, 3.5)
    long = count * w
    post = drawn(rng, style, num(rng, 0.1, 0.2), ("H", "I", "SHS", "C"))
    y = float(post[0][:, 1].min())
    parts: list[Part] = []
    for k in range(count + 1):
        plates, z = base(k * w, 0, (0.25, 0.28), style, rng)
        parts += [*plates, piece(bar((k * w, 0, z), (k * w, 0, h), post, (0, 1, 0)), "column")]
    rail, deep = section(pick(rng, "C", "Z", "U"), 0.12, style), 0.06
    parts += [
        piece(bar((0, y - deep, z), (long, y - deep, z), rail, (0, 1, 0)), "beam", "clamp")
        for z in (0.3, h / 2, h - 0.15)
    ]
    face, kind = y - 2 * deep, int(rng.integers(3))
    if kind == 0:
        xs = np.linspace(0, long, 2 * max(8, int(long / 0.12)) + 1)
        line = np.column_stack([xs, face - 0.022 - 0.018 * np.where(np.arange(len(xs)) % 4 < 2, 1, -1)])
        parts.append(piece(extrude(ribbon(line, 0.001), 0.05, h), "wall", "fence"))
    elif kind == 1:
        width = long / max(2, int(long / 0.6))
        for k in range(max(2, int(long / 0.6))):
            parts.append(
                piece(
                    box((width - 0.004, 0.08, h - 0.05), ((k + 0.5) * width, face - 0.04, h / 2)),
                    "wall",
                    "fence",
                    "wall",
                )
            )
    else:
        hole = (rect(0.9, 0.8, long / 2, 0.6 * h),) if long > 1.4 else ()
        parts.append(piece(slab_xz(rect(long, h, long / 2, h / 2), 0.1, face - 0.05, hole), "wall", "concrete"))
        if hole and chance(rng, 0.6):
            parts.append(piece(slab_xz(rect(0.9, 0.8, long / 2, 0.6 * h), 0.02, face - 0.05), "plate", "dial"))
    return Model(parts)


def _bund(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bund: low walls round a slab with a sump and a kerb or ramp, rectangular, L-shaped or round."""
    a, b, h, t = num(rng, 1.2, 4.0), num(rng, 1.0, 3.0), num(rng, 0.15, 1.0), num(rng, 0.1, 0.25)
    kind = int(rng.integers(3))
    if kind == 2:
        r = a / 2
        n = few_sides(style, r, 48)
        parts = [
            piece(ring(r - t, r, 0, h, n), "wall", "concrete"),
            piece(cylinder(r + 0.1, -0.15, 0, n), "ground", "concrete"),
        ]
        return Model(parts)
    outline, inner = rect(a, b), rect(a - 2 * t, b - 2 * t)
    if kind == 1:
        outline = np.array([[0, 0], [a, 0], [a, 0.5 * b], [0.5 * a, 0.5 * b], [0.5 * a, b], [0, b]]) - np.array(
            [a / 2, b / 2]
        )
        inner = np.array(
            [[t, t], [a - t, t], [a - t, 0.5 * b - t], [0.5 * a - t, 0.5 * b - t], [0.5 * a - t, b - t], [t, b - t]]
        ) - np.array([a / 2, b / 2])
    parts = []
    if chance(rng, 0.5):
        parts.append(piece(extrude(outline, 0, h, (inner,)), "wall", "concrete"))
    else:
        for k in range(len(outline)):
            p, q = outline[k], outline[(k + 1) % len(outline)]
            u, v = inner[k], inner[(k + 1) % len(inner)]
            parts.append(piece(extrude(np.array([p, q, v, u]), 0, h), "wall", "concrete", "wall"))
    parts.append(piece(box((a + 0.3, b + 0.3, 0.15), (0, 0, -0.075)), "ground", "concrete"))
    if chance(rng, 0.5):
        parts.append(piece(box((0.7, 0.06, 0.02), (-a / 4, -b / 2 - 0.03, h - 0.01)), "plate"))
    return Model(parts)


def _retaining(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Concrete walls: L elements, battered, with buttresses, a corner, a pipe opening, a curved stretch."""
    long, h, t, kind = num(rng, 1.0, 3.0), num(rng, 0.6, 2.6), num(rng, 0.12, 0.3), int(rng.integers(4))
    parts: list[Part] = []
    if kind == 0:
        foot = num(rng, 0.4, 0.9) * h
        shape = np.array([(0, 0), (foot, 0), (foot, t), (t, t), (0.8 * t, h), (0, h)])
        count = max(1, int(long))
        for k in range(count):
            solid = moved(slab_xz(shape, long / count - 0.006), at(0, (k + 0.5) * long / count))
            parts.append(piece(solid, "wall", "concrete"))
    elif kind == 1:
        wall = [slab_xz(rect(long, h, long / 2, h / 2), t)]
        rib = [(0, 0), (0.5 * h, 0), (0.05, h), (0, h)]
        wall += [
            moved(slab_xz(rib, 0.15), at(x, t / 2) @ spun("z", np.pi / 2)) for x in np.linspace(0.2, long - 0.2, 3)
        ]
        parts += [piece(one, "wall", "concrete", "wall") for one in ([merge(wall)] if chance(rng, 0.5) else wall)]
    elif kind == 2:
        r = num(rng, 1.0, 3.0)
        a = np.linspace(0, min(long / r, 2.5), 13)
        unit = np.column_stack([np.cos(a), np.sin(a)])
        parts.append(piece(slab_xy(np.vstack([(r + t) * unit, r * unit[::-1]]), 0, h), "wall", "concrete"))
    else:
        corner = np.array([[0, 0], [long, 0], [long, t], [t, t], [t, 0.7 * long], [0, 0.7 * long]])
        if chance(rng, 0.5):
            parts.append(piece(slab_xy(corner, 0, h), "wall", "concrete"))
        else:
            n = few_sides(style, 0.15, 24)
            hole = (circle(0.15, n, (0.5 * long, 0.5 * h)),)
            parts.append(piece(slab_xz(rect(long, h, long / 2, h / 2), t, t / 2, hole), "wall", "concrete"))
            parts.append(piece(box((t, 0.7 * long - t, h), (t / 2, 0.35 * long + t / 2, h / 2)), "wall", "concrete"))
    return Model(parts)


CIVIL: tuple[Family, ...] = (
    floor_family("foundation/plinth", _plinth, 1.4, "fitting"),
    floor_family("foundation/footing", _footing, 1.2, "fitting"),
    floor_family("foundation/ring", _ring_base, 0.8, "fitting"),
    floor_family("foundation/strip", _strip, 1.0, "fitting"),
    floor_family("wall/masonry", _brick),
    floor_family("wall/clad", _panel_wall, 1.0, "fitting"),
    floor_family("wall/bund", _bund, 1.0, "fitting"),
    floor_family("wall/retaining", _retaining),
)
