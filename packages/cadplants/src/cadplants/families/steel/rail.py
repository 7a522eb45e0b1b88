"""Railings and posts: welded bays, side-fixed, with infill, chains, curved, of clamps, on walls, crash barriers."""

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
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, ball, box, cylinder, dome, ring, rod, torus, turned
from cadplants.transforms import at, spun

__all__ = ["RAILS"]


def _floor(length: float, rng: np.random.Generator) -> tuple[list[Part], float]:
    """What a railing along x from 0 stands on: the floor, a kerb, a slab, an edge beam; and the height of its top."""
    kind = int(rng.integers(4))
    if kind == 0:
        return [], 0.0
    if kind == 1:
        return [piece(box((length + 0.2, 0.2, 0.15), (length / 2, 0, 0.075)), "foundation", "concrete")], 0.15
    if kind == 2:
        return [piece(box((length + 0.3, 1.2, 0.2), (length / 2, 0.5, 0.1)), "ground", "concrete")], 0.2
    return [piece(box((length + 0.1, 0.1, 0.2), (length / 2, 0, 0.1)), "beam")], 0.2


def _kick(length: float, z: float, rng: np.random.Generator) -> list[Part]:
    """A toe plate 10 mm over the floor (ISO 14122-3), plain or folded, or none."""
    if chance(rng, 0.4):
        return []
    h, t = pick(rng, 0.1, 0.12, 0.15), pick(rng, 0.003, 0.005)
    return [piece(box((length, t, h), (length / 2, 0.025, z + 0.01 + h / 2)), "railing", "safety", "railing")]


def _bay(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Welded bays of bent tube: bows from foot to foot with rails in them, on base plates (ISO 14122-3)."""
    count, w = int(rng.integers(1, 4)), num(rng, 0.8, 2.0)
    h, r = num(rng, 0.9, 1.2), pick(rng, 0.017, 0.021, 0.024)
    floor, z = _floor(count * w, rng)
    parts, rails = floor, int(rng.integers(1, 4))
    joined, bend = chance(rng, 0.5), pick(rng, 0.0, 0.1, 0.2)
    for k in range(count):
        a, b = k * w + 0.04, (k + 1) * w - 0.04
        plates, low = base(a, 0, (0.1, 0.08), style, rng, z)
        parts += plates
        parts.append(piece(box((0.1, 0.08, low - z), (b, 0, (z + low) / 2)), "base plate"))
        solids = [pipe([(a, 0, low), (a, 0, z + h), (b, 0, z + h), (b, 0, low)], r, style, bend, 0.003)]
        for j in range(rails):
            level = z + h * (j + 1) / (rails + 1)
            solids.append(pipe([(a + r, 0, level), (b - r, 0, level)], 0.8 * r, style))
        if joined:
            parts.append(piece(merge(solids), "railing", "safety", "railing"))
        else:
            parts += [piece(one, "railing", "safety", "railing") for one in solids]
    return Model([*parts, *_kick(count * w, z, rng)])


def _side_fixed(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Posts of flat, angle, tube or channel bolted to the side of an edge beam, with rails through or before them."""
    length, h = num(rng, 1.2, 4.0), num(rng, 0.95, 1.15)
    edge = drawn(rng, style, num(rng, 0.14, 0.24), ("U", "RHS", "U", "H"))
    deep = float(np.ptp(edge[0][:, 1]))
    face = float(-edge[0][:, 0].min())
    z = num(rng, 0.0, 1.0) + 0.15
    parts = [piece(bar((0, 0, z + deep / 2), (length, 0, z + deep / 2), edge), "beam")]
    parts += [
        piece(box((0.12, 0.12, z), (x, 0, z / 2)), pick(rng, "column", "foundation")) for x in (0.1, length - 0.1)
    ]
    kind = pick(rng, "flat", "L", "SHS", "CHS", "U")
    one, size = section(kind, 0.06, style), 0.03
    y = -face - size - 0.008
    for x in np.linspace(0.06, length - 0.06, max(2, int(length / 1.1) + 1)):
        parts.append(piece(bar((x, y, z + 0.03), (x, y, z + deep + h), one, (0, 1, 0)), "post", "safety", "railing"))
        parts.append(piece(box((0.08, 0.008, deep), (x, -face - 0.004, z + 0.5 * deep)), "plate"))
        turn = spun("x", np.pi / 2)
        parts += bolted([at(x + s * 0.025, -face - 0.008, z + 0.5 * deep) @ turn for s in (-1, 1)], 0.012, style, 0.01)
    rail = section(pick(rng, "CHS", "SHS", "L", "flat"), 0.045, style)
    top = z + deep + h
    for level in (top, *np.linspace(z + deep, top, int(rng.integers(3, 5)))[1:-1]):
        shift = 0.0 if level == top else pick(rng, size, 0.0)
        parts.append(
            piece(bar((0, y + shift, level), (length, y + shift, level), rail), "railing", "safety", "railing")
        )
    if chance(rng, 0.6):
        kick = box((length, 0.005, 0.1), (length / 2, y + size + 0.0025, z + deep + 0.06))
        parts.append(piece(kick, "railing", "safety", "railing"))
    return Model(parts)


def _fill(kind: str, w: float, h: float, style: ModelingStyle) -> list[Solid]:
    """What fills a frame of this width and height from the origin in x and z: bars, wires, sheet, glass, slats."""
    if kind == "bars":
        return [rod((x, 0, 0), (x, 0, h), 0.006, few_sides(style, 0.006, 8)) for x in np.arange(0.1, w - 0.05, 0.11)]
    if kind == "wires":
        return [rod((0, 0, z), (w, 0, z), 0.003, 6) for z in np.arange(0.1, h, 0.1)]
    if kind == "mesh":
        upright = [rod((x, 0, 0), (x, 0, h), 0.002, 4) for x in np.linspace(0, w, int(w / 0.07) + 2)[1:-1]]
        return [
            merge(
                [
                    *upright,
                    *(rod((0, 0.003, z), (w, 0.003, z), 0.002, 4) for z in np.linspace(0, h, int(h / 0.07) + 2)[1:-1]),
                ]
            )
        ]
    if kind == "sheet":
        holes = tuple(
            circle(0.012, 6, (x, z)) for x in np.arange(0.1, w - 0.08, 0.12) for z in np.arange(0.1, h - 0.08, 0.12)
        )
        return [slab_xz([(0, 0), (w, 0), (w, h), (0, h)], 0.002, 0.0, holes if style.holes else ())]
    if kind == "glass":
        return [box((w - 0.04, 0.012, h - 0.02), (w / 2, 0, h / 2))]
    if kind == "cross":
        return [rod((0, 0, 0), (w, 0, h), 0.01, 8), rod((0, 0.015, h), (w, 0.015, 0), 0.01, 8)]
    return [box((w, 0.02, 0.09), (w / 2, 0, z)) for z in np.arange(0.08, h, 0.13)]


def _infill(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A balustrade: posts, top and bottom rail, filled with bars, wires, mesh, sheet, glass, slats or a cross."""
    count, w, h = int(rng.integers(1, 4)), num(rng, 0.8, 1.6), num(rng, 0.9, 1.2)
    floor, z = _floor(count * w, rng)
    kind = pick(rng, "bars", "bars", "wires", "mesh", "sheet", "glass", "slats", "cross")
    post = drawn(rng, style, num(rng, 0.035, 0.06), ("SHS", "CHS", "flat", "square"))
    half = float(np.ptp(post[0][:, 0])) / 2
    parts, top = floor, section(pick(rng, "CHS", "SHS", "flat", "timber"), 0.045, style)
    lows = []
    for k in range(count + 1):
        plates, low = base(k * w, 0, (0.11, 0.09), style, rng, z)
        lows.append(low)
        parts += [*plates, piece(bar((k * w, 0, low), (k * w, 0, z + h), post, (0, 1, 0)), "post", "safety", "railing")]
    high = z + h + float(np.ptp(top[0][:, 1])) / 2
    parts.append(piece(bar((-half, 0, high), (count * w + half, 0, high), top), "railing", "safety", "railing"))
    joined = chance(rng, 0.5)
    for k in range(count):
        a, wide = k * w + half, w - 2 * half
        frame = (
            []
            if kind in ("glass", "wires", "slats")
            else [bar((a, 0, z + 0.1), (a + wide, 0, z + 0.1), section("SHS", 0.03, style))]
        )
        solids = [*frame, *(moved(one, at(a, 0, z + 0.1)) for one in _fill(kind, wide, h - 0.1, style))]
        color = "dial" if kind == "glass" else "safety"
        made = [merge(solids)] if joined else solids
        parts += [piece(one, "railing", color, "railing") for one in made]
        if kind == "glass":
            parts += [
                piece(box((0.05, 0.03, 0.04), (x, 0, z + f * h)), "clamp")
                for x in (a + 0.01, a + wide - 0.01)
                for f in (0.3, 0.8)
            ]
    return Model(parts)


def _links(a: Floats, b: Floats, sag: float, style: ModelingStyle) -> Solid:
    """A chain that hangs between two points, its links long rings turned by quarters."""
    count = max(8, int(np.linalg.norm(b - a) / 0.07))
    s = np.linspace(0, 1, count + 1)
    path = a + s[:, None] * (b - a) - np.outer(4 * sag * s * (1 - s), [0, 0, 1])
    links = []
    for k in range(count):
        p, q = path[k], path[k + 1]
        x = (q - p) / np.linalg.norm(q - p)
        z = np.cross(x, [0.0, 1.0, 0.0])
        pose = np.eye(4)
        pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, (0, 1, 0), z, (p + q) / 2
        long = float(np.linalg.norm(q - p)) / 2
        link = moved(torus(1.0, 0.16, 8, 5), np.diag([long * 1.05, 0.022, 0.022, 1.0]))
        links.append(moved(link, pose @ spun("x", np.pi / 2 * (k % 2))))
    return merge(links)


def _chained(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Posts with ball or flat tops on plates or weighted feet, joined by chains, ropes or a belt."""
    count, w, h = int(rng.integers(2, 5)), num(rng, 0.9, 1.8), num(rng, 0.8, 1.1)
    r, kind = num(rng, 0.02, 0.045), pick(rng, "chain", "chain", "rope", "belt")
    n, top, parts = few_sides(style, r, 16), int(rng.integers(3)), []
    weighted = chance(rng, 0.5)
    for k in range(count):
        x = k * w
        if weighted:
            foot = turned([(5 * r, 0), (5 * r, 0.02), (2 * r, 0.05), (r, 0.06)], n)
            parts.append(piece(moved(foot, at(x)), "base plate", "rubber"))
            low = 0.06
        else:
            plates, low = base(x, 0, (6 * r, 6 * r), style, rng)
            parts += plates
        shaft = [cylinder(r, low, h, n)]
        shaft.append(
            moved(ball(1.4 * r, n), at(0, 0, h + 0.8 * r))
            if top == 0
            else dome(r, 0.6 * r, h, n)
            if top == 1
            else cylinder(1.3 * r, h, h + 0.01, n)
        )
        parts.append(piece(moved(merge(shaft), at(x)), "post", "safety"))
    for level in (0.9 * h, *((0.5 * h,) if chance(rng, 0.5) else ())):
        for k in range(count - 1):
            a, b = np.array([k * w + r, 0, level]), np.array([(k + 1) * w - r, 0, level])
            if kind == "chain":
                parts.append(piece(_links(a, b, 0.1 * w, style), "railing", "safety"))
            elif kind == "rope":
                s = np.linspace(0, 1, 9)
                path = a + s[:, None] * (b - a) - np.outer(0.4 * w * s * (1 - s), [0, 0, 1])
                parts.append(piece(pipe(path, 0.012, style), "railing", "safety"))
            else:
                parts.append(piece(box((w - 2 * r, 0.002, 0.05), ((a[0] + b[0]) / 2, 0, level)), "railing", "safety"))
    return Model(parts)


def _curved(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A railing on an arc, as round a tank's roof or a pit: rails swept round, posts radial, a bent toe plate."""
    radius, turn = num(rng, 0.8, 2.5), num(rng, 0.8, 4.5)
    h, r = num(rng, 0.95, 1.15), pick(rng, 0.017, 0.021, 0.024)
    steps = max(8, int(turn * 8))
    a = np.linspace(0, turn, steps + 1)

    def round_at(z: float, reach: float) -> Floats:
        return np.column_stack([reach * np.cos(a), reach * np.sin(a), np.full(len(a), z)])

    parts = [piece(pipe(round_at(h, radius), r, style, 0.0, 0.003), "railing", "safety", "railing")]
    for level in np.linspace(0, h, int(rng.integers(3, 5)))[1:-1]:
        parts.append(piece(pipe(round_at(float(level), radius), 0.75 * r, style), "railing", "safety", "railing"))
    n = few_sides(style, r, 14)
    one = section(pick(rng, "CHS", "flat", "L"), 2 * r, style)
    for angle in np.linspace(0, turn, max(3, int(radius * turn / 1.0) + 1)):
        x, y = radius * np.cos(angle), radius * np.sin(angle)
        parts.append(piece(bar((x, y, 0.008), (x, y, h - 0.5 * r), one, (-y, x, 0)), "post", "safety", "railing"))
        parts.append(piece(moved(cylinder(0.05, 0, 0.008, n), at(x, y)), "base plate"))
    if chance(rng, 0.6):
        flat = rounded_rectangle(0.1, 0.004, 0.0)
        solid = sweep(round_at(0.06, radius - r - 0.002), flat, up=(0, 0, 1))
        parts.append(piece(solid, "railing", "safety", "railing"))
    if chance(rng, 0.5):
        rim = np.vstack([round_at(0, radius + 0.15)[:, :2], round_at(0, radius - 0.3)[::-1, :2]])
        if turn < 6:
            parts.append(piece(slab_xy(rim, -0.05, 0.0), pick(rng, "platform", "foundation"), "concrete"))
    return Model(parts)


def _clamped(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A railing of tubes in cast clamps (key clamps): tees, crosses and feet with grub screws; corner or straight."""
    count, w, h, r = int(rng.integers(1, 4)), num(rng, 0.9, 1.6), num(rng, 0.9, 1.1), pick(rng, 0.017, 0.0212, 0.0242)
    n, levels = few_sides(style, r, 14), (0.5 * h, h)
    parts: list[Part] = []
    joined = chance(rng, 0.4)
    solids: list[Solid] = []
    for k in range(count + 1):
        x = k * w
        foot = moved(merge([cylinder(2.6 * r, 0, 0.008, n), cylinder(1.35 * r, 0.008, 0.06, n)]), at(x))
        parts.append(piece(foot, "base plate", "clamp"))
        solids.append(rod((x, 0, 0.06), (x, 0, h + 0.7 * r), r, n))
        for z in levels:
            sleeve = [moved(cylinder(1.35 * r, -1.5 * r, 1.5 * r, n), at(x, 0, z))]
            sleeve.append(along("x", cylinder(1.3 * r, -2.4 * r * (k > 0), 2.4 * r * (k < count), n), x, 0, z))
            parts.append(piece(merge(sleeve), "clamp", "clamp"))
    for z in levels:
        solids += [rod((k * w + 1.2 * r, 0, z), ((k + 1) * w - 1.2 * r, 0, z), r, n) for k in range(count)]
    names = ["post"] * (count + 1) + ["railing"] * (len(solids) - count - 1)
    if joined:
        parts.append(piece(merge(solids), "railing", "clamp"))
    else:
        parts += [piece(one, name, "clamp", "railing") for one, name in zip(solids, names, strict=True)]
    return Model(parts)


def _on_wall(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A handrail on brackets on a wall, level or rising, its ends bent to the wall."""
    length, rise = num(rng, 1.0, 3.5), pick(rng, 0.0, 0.0, 0.4) * num(rng, 0.8, 1.2)
    r, y, z = pick(rng, 0.017, 0.021, 0.025), -0.09, num(rng, 0.85, 1.0)
    tall = z + rise * length + num(rng, 0.2, 1.5)
    parts = [piece(box((length + 0.4, 0.15, tall), (length / 2, 0.075, tall / 2)), "wall", "concrete")]

    def level(x: float) -> float:
        return z + rise * x

    ends = chance(rng, 0.6)
    path = [(0, y, level(0)), (length, y, level(length))]
    if ends:
        path = [(0.0, 0.0, level(0)), *path, (length, 0.0, level(length))]
    parts.append(piece(pipe(path, r, style, 0.06, 0.003), "railing", "handle"))
    for x in np.linspace(0.15, length - 0.15, max(2, int(length / 0.9) + 1)):
        top = level(x) - r
        arm = pipe([(x, 0, top - 0.06), (x, y, top - 0.06), (x, y, top + 0.3 * r)], 0.007, style, 0.04)
        parts.append(
            piece(
                merge([arm, along("y", cylinder(0.03, -0.006, 0.0, few_sides(style, 0.03, 14)), x, 0, top - 0.06)]),
                "bracket",
            )
        )
    return Model(parts)


def _barrier(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Impact protection: floor hoops of thick tube, a W-beam on posts (EN 1317), or plank rails between stout posts."""
    kind, count, w = int(rng.integers(3)), int(rng.integers(1, 4)), num(rng, 0.8, 2.0)
    parts: list[Part] = []
    if kind == 0:
        r, h = num(rng, 0.03, 0.06), num(rng, 0.35, 1.0)
        for k in range(count):
            a, b = k * (w + 0.3), k * (w + 0.3) + w
            for x in (a, b):
                plates, low = base(x, 0, (5 * r, 5 * r), style, rng)
                parts += plates
            solids = [pipe([(a, 0, 0.008), (a, 0, h), (b, 0, h), (b, 0, 0.008)], r, style, 3 * r, 0.004)]
            if chance(rng, 0.5):
                solids.append(pipe([(a, 0, 0.5 * h), (b, 0, 0.5 * h)], 0.8 * r, style))
            parts.append(piece(merge(solids), "railing", "safety"))
        return Model(parts)
    h, length = num(rng, 0.6, 0.9), count * w
    stout = drawn(rng, style, num(rng, 0.08, 0.14), ("U", "H", "SHS", "C"))
    face = float(-stout[0][:, 1].min())
    for k in range(count + 1):
        plates, low = base(k * w, 0, (0.25, 0.25), style, rng)
        parts += [*plates, piece(bar((k * w, 0, low), (k * w, 0, h), stout, (0, 1, 0)), "post", "safety")]
    if kind == 1:
        wave = [
            (0.0, -0.155),
            (0.0, -0.13),
            (0.08, -0.1),
            (0.08, -0.06),
            (0.0, -0.02),
            (0.0, 0.02),
            (0.08, 0.06),
            (0.08, 0.1),
            (0.0, 0.13),
            (0.0, 0.155),
        ]
        line = ribbon(wave, 0.003, 0.01, 2)
        y = -face - 0.0015
        rail = moved(
            along("x", slab_xy(np.column_stack([-line[:, 1], line[:, 0]]), -0.3, length + 0.3)),
            at(0, y, h - 0.16) @ spun("x", np.pi),
        )
        parts.append(piece(rail, "railing", "clamp"))
    else:
        plank = section(pick(rng, "U", "RHS", "timber", "flat"), num(rng, 0.12, 0.25), style)
        near = float(plank[0][:, 0].max())
        y = -face - near
        for z in np.linspace(0.2, h - 0.1, int(rng.integers(1, 4))):
            parts.append(piece(bar((-0.1, y, z), (length + 0.1, y, z), plank), "railing", "safety"))
    return Model(parts)


def _bollards(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Bollards: steel tubes with dome, cap or concrete fill, on plates or cast in, with bands or hoops."""
    count, w, h, r = int(rng.integers(1, 5)), num(rng, 0.6, 1.5), num(rng, 0.5, 1.3), num(rng, 0.045, 0.11)
    n, top, cast, parts = few_sides(style, r, 24), int(rng.integers(4)), chance(rng, 0.4), []
    bands = chance(rng, 0.4)
    for k in range(count):
        low = 0.0
        if cast:
            parts.append(piece(box((5 * r, 5 * r, 0.2), (k * w, 0, -0.1)), "foundation", "concrete"))
        else:
            plates, low = base(k * w, 0, (3.4 * r, 3.4 * r), style, rng)
            parts += plates
        ends = {
            0: [(r, h - r), (0.7 * r, h - 0.3 * r), (0, h)],
            1: [(r, h)],
            2: [(r, h - 0.03), (1.1 * r, h - 0.03), (1.1 * r, h)],
        }
        shape = [
            (r, low),
            *ends.get(top, [(r, h - 0.1), (0.85 * r, h - 0.1), (0.85 * r, h - 0.07), (r, h - 0.07), (r, h)]),
        ]
        parts.append(piece(moved(turned(shape, n), at(k * w)), "post", "safety"))
        if bands:
            parts.append(piece(moved(ring(r, r + 0.002, 0.6 * h, 0.6 * h + 0.1, n), at(k * w)), "sign", "dial"))
    return Model(parts)


def _posts(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Lone posts of any section on plates, in sockets or on the side of a plinth, with caps, arms or a small panel."""
    parts: list[Part] = []
    for k in range(int(rng.integers(1, 4))):
        x, size, h = 0.9 * k, num(rng, 0.03, 0.1), num(rng, 0.4, 2.2)
        kind = pick(rng, "SHS", "RHS", "CHS", "L", "U", "flat", "strut", "round", "T", "timber")
        one = section(kind, size, style)
        low, foot = 0.0, int(rng.integers(3))
        if foot == 0:
            plates, low = base(x, 0, (size + 0.08, size + 0.08), style, rng)
            parts += plates
        elif foot == 1:
            parts.append(piece(box((4 * size, 4 * size, 0.12), (x, 0, -0.06)), "foundation", "concrete"))
        else:
            side = float(-one[0][:, 1].min())
            parts.append(piece(box((0.4, 0.3, 0.5), (x, side + 0.15, 0.25)), "foundation", "concrete"))
        parts.append(piece(bar((x, 0, low), (x, 0, h), one, (0, 1, 0)), "post"))
        top = int(rng.integers(4))
        if top == 0:
            parts.append(piece(box((size + 0.06, size + 0.06, 0.008), (x, 0, h + 0.004)), "plate"))
        elif top == 1:
            parts.append(
                piece(
                    box((0.25, 0.003, 0.2), (x, float(one[0][:, 1].min()) - 0.0015, h - 0.12)),
                    pick(rng, "sign", "plate"),
                    "dial",
                )
            )
        elif top == 2:
            parts.append(piece(box((0.3, 0.04, 0.006), (x, 0, h + 0.003)), "bracket"))
    return Model(parts)


RAILS: tuple[Family, ...] = (
    floor_family("railing/bent bays", _bay, 1.2),
    floor_family("railing/side fixed", _side_fixed),
    floor_family("railing/infill", _infill, 1.5),
    floor_family("railing/chain", _chained, 0.8, "fitting"),
    floor_family("railing/curved", _curved),
    floor_family("railing/clamped tubes", _clamped, 0.8, "fitting"),
    floor_family("railing/wall", _on_wall, 0.8, "fitting"),
    floor_family("railing/barrier", _barrier, 1.0, "fitting"),
    floor_family("post/bollard", _bollards, 0.8, "fitting"),
    floor_family("post/stand", _posts, 1.2, "fitting"),
)
