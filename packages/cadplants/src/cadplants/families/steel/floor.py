"""Gratings and platforms: floor panels of every kind, trench covers, round and mobile platforms, mezzanines."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.caster import wheeled
from cadplants.families.steel.shape import (
    bar,
    base,
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
    slab_yz,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, lattice, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, cylinder, ring
from cadplants.transforms import at, spun

__all__ = ["FLOORS", "panel"]

PANELS = ("bar", "bar", "pressed", "expanded", "perforated", "sheet", "planks")


def _grid(
    w: float, d: float, thick: float, pitch: tuple[float, float], bars: tuple[float, float], most: int = 18
) -> Solid:
    """A lattice of bars about the origin, its underside at z = 0."""

    def lines(span: float, step: float, bar_: float) -> Floats:
        count = int(np.clip(round(span / step), 2, most))
        low = np.linspace(0, span - bar_, count + 1)
        return np.sort(np.concatenate([low, low + bar_])) - span / 2

    xs, ys = lines(w, pitch[0], bars[0]), lines(d, pitch[1], bars[1])
    filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
    filled[::2], filled[:, ::2] = True, True
    return lattice(xs, ys, filled, 0.0, thick)


def panel(kind: str, w: float, d: float, thick: float, style: ModelingStyle, most: int = 18) -> Solid:
    """A floor panel ``w`` by ``d`` about the origin on z = 0, with at most so many bars each way.

    Bars after DIN 24537 (33 mm pitch), planks after DIN 24539; ``fold`` is a tread of folded sheet.
    """
    coarse = 2.0 if style.sides[1] <= 12 else 1.0
    if kind == "bar":
        return _grid(w, d, thick, (0.04 * coarse, 0.1 * coarse), (0.004, 0.006), most)
    if kind == "pressed":
        return _grid(w, d, thick, (0.06 * coarse, 0.06 * coarse), (0.004, 0.004), most)
    if kind == "perforated":
        holes = _grid(w, d, 0.2 * thick, (0.06 * coarse, 0.06 * coarse), (0.03, 0.03), most)
        rims = [box((w, 0.004, thick), (0, s * (d / 2 - 0.002), thick / 2)) for s in (-1, 1)]
        return merge([moved(holes, at(0, 0, 0.8 * thick)), *rims])
    if kind == "expanded":
        return _expanded(w, d, thick, coarse)
    if kind == "planks":
        count = max(1, round(d / 0.2))
        wide = d / count
        y = wide / 2 - 0.003
        line = ribbon([(y, 0.0015), (y, thick - 0.0015), (-y, thick - 0.0015), (-y, 0.0015)], 0.003)
        return merge([moved(slab_yz(line, w), at(0, (k + 0.5) * wide - d / 2)) for k in range(count)])
    if kind == "fold":
        x = w / 2
        line = ribbon([(x, 0.0), (x, thick - 0.002), (-x, thick - 0.002), (-x, 0.0)], 0.004)
        return slab_xz(line, d)
    studs = [
        moved(box((0.03, 0.006, 0.003), (0, 0, thick)), at(x, y) @ spun("z", 0.7854 * (-1) ** (i + j)))
        for i, x in enumerate(np.linspace(-0.42 * w, 0.42 * w, int(np.clip(w / 0.08, 2, 9))))
        for j, y in enumerate(np.linspace(-0.42 * d, 0.42 * d, int(np.clip(d / 0.08, 2, 9))))
    ]
    plate = box((w, d, 0.2 * thick), (0, 0, 0.9 * thick))
    rims = [box((w, 0.004, 0.8 * thick), (0, s * (d / 2 - 0.002), 0.4 * thick)) for s in (-1, 1)]
    return merge([plate, *rims, *studs]) if coarse < 2 else merge([plate, *rims])


def _expanded(w: float, d: float, thick: float, coarse: float) -> Solid:
    """Expanded metal in a frame of flats: two sets of crossed strands."""
    strands = []
    slope, pitch = 0.5, 0.07 * coarse
    for way in (-1, 1):
        for c in np.arange(-w / 2 - slope * d / 2, w / 2 + slope * d / 2, max(pitch, (w + d) / 30)):
            ys = np.array([-d / 2, d / 2])
            lo, hi = sorted(((-w / 2 - c) / (way * slope), (w / 2 - c) / (way * slope)))
            ys = np.clip(ys, lo, hi)
            if ys[1] - ys[0] < 0.03:
                continue
            a, b = (c + way * slope * ys[0], ys[0], 0.6 * thick), (c + way * slope * ys[1], ys[1], 0.6 * thick)
            strands.append(_strand(np.array(a), np.array(b), 0.3 * thick, 0.004))
    rims = [box((w, 0.005, thick), (0, s * (d / 2 - 0.0025), thick / 2)) for s in (-1, 1)]
    rims += [box((0.005, d - 0.01, thick), (s * (w / 2 - 0.0025), 0, thick / 2)) for s in (-1, 1)]
    return merge([*strands, *rims])


def _strand(a: Floats, b: Floats, tall: float, thick: float) -> Solid:
    turn = float(np.arctan2(b[1] - a[1], b[0] - a[0]))
    middle = (a + b) / 2
    return moved(box((float(np.linalg.norm(b - a)), thick, tall)), at(*middle) @ spun("z", turn))


def _name(kind: str) -> str:
    return "plate" if kind == "sheet" else "grating"


def _panels(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Floor panels side by side on bearers, with clips; or a stack of them on battens."""
    kind, w, d = pick(rng, *PANELS), num(rng, 0.4, 1.2), num(rng, 0.4, 1.2)
    thick = pick(rng, 0.025, 0.03, 0.04)
    solid = panel(kind, w, d, thick, style, 12)
    if chance(rng, 0.3):
        parts = [piece(box((0.08, d, 0.08), (s * 0.3 * w, 0, 0.04)), "beam", "safety") for s in (-1, 1)]
        turns = [num(rng, -0.03, 0.03) for _ in range(int(rng.integers(2, 5)))]
        step = thick + (0.003 if kind == "sheet" else 0.0)
        return Model(
            [
                *parts,
                *(
                    piece(moved(solid, at(0, 0, 0.08 + k * step) @ spun("z", a)), _name(kind), "clamp")
                    for k, a in enumerate(turns)
                ),
            ]
        )
    count = int(rng.integers(1, 4))
    one = drawn(rng, style, num(rng, 0.06, 0.12), ("L", "U", "SHS", "I", "T"))
    high = float(np.ptp(one[0][:, 1]))
    parts = []
    for k in range(count):
        parts.append(piece(moved(solid, at((k + 0.5) * (w + 0.005), 0, high)), _name(kind), "clamp"))
    z = -float(one[0][:, 1].min())
    parts += [piece(bar((0, s * 0.4 * d, z), (count * (w + 0.005), s * 0.4 * d, z), one), "beam") for s in (-1, 1)]
    if chance(rng, 0.5) and kind in ("bar", "pressed"):
        clip = box((0.05, 0.02, 0.003), (0, 0, high + thick + 0.0015))
        parts += [
            piece(moved(clip, at((k + f) * (w + 0.005), s * 0.4 * d)), "clamp", "trim")
            for k in range(count)
            for f in (0.15, 0.85)
            for s in (-1, 1)
        ]
    return Model(parts)


def _trench(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A floor with a trench or sump under gratings in an angle frame, or a round cover; slab, walls of the trench."""
    kind, thick = pick(rng, "bar", "pressed", "perforated", "sheet"), 0.03
    a, b, t = num(rng, 0.8, 2.4), num(rng, 0.2, 0.6), num(rng, 0.1, 0.2)
    deep = num(rng, 0.2, 0.5)
    big = np.array(
        [
            [-a / 2 - 0.4, -b / 2 - 0.4],
            [a / 2 + 0.4, -b / 2 - 0.4],
            [a / 2 + 0.4, b / 2 + 0.4],
            [-a / 2 - 0.4, b / 2 + 0.4],
        ]
    )
    if chance(rng, 0.3):
        r = 0.5 * b + 0.15
        n = few_sides(style, r, 32)
        parts = [piece(slab_xy(big + np.sign(big) * 0.1, -t, 0, (circle(r, n),)), "ground", "concrete")]
        parts.append(piece(ring(r - 0.05, r, -t, -thick, n), "beam"))
        bars = [
            box((0.006, 2 * np.sqrt(max((r - 0.01) ** 2 - x * x, 0.0001)), thick), (x, 0, -thick / 2))
            for x in np.linspace(-0.85 * r, 0.85 * r, 12)
        ]
        return Model([*parts, piece(merge([*bars, ring(r - 0.012, r - 0.004, -thick, 0, n)]), "grating", "clamp")])
    opening = np.array([[-a / 2, -b / 2], [a / 2, -b / 2], [a / 2, b / 2], [-a / 2, b / 2]])
    parts = [piece(slab_xy(big, -t, 0, (opening,)), "ground", "concrete")]
    walls = [box((a, 0.08, deep), (0, s * (b / 2 + 0.04), -t - deep / 2)) for s in (-1, 1)]
    walls += [box((0.08, b + 0.16, deep), (s * (a / 2 + 0.04), 0, -t - deep / 2)) for s in (-1, 1)]
    walls.append(box((a + 0.16, b + 0.16, 0.08), (0, 0, -t - deep - 0.04)))
    parts.append(piece(merge(walls), "foundation", "concrete"))
    for s in (-1, 1):
        angle = [
            box((a, 0.004, thick), (0, s * (b / 2 - 0.002), -thick / 2)),
            box((a, 0.03, 0.004), (0, s * (b / 2 - 0.015), -thick - 0.002)),
        ]
        parts.append(piece(merge(angle), "beam"))
    count = int(rng.integers(1, 4))
    for k in range(count):
        cover = panel(kind, a / count - 0.006, b - 0.012, thick, style)
        parts.append(piece(moved(cover, at(-a / 2 + (k + 0.5) * a / count, 0, -thick)), _name(kind), "clamp"))
    return Model(parts)


def _bow(xs: tuple[float, float], y: float, z: float, style: ModelingStyle) -> list[Part]:
    """A railing along x over a floor: two posts, a handrail and a knee rail."""
    parts = [piece(pipe([(x, y, z), (x, y, z + 1.05)], 0.019, style), "post", "safety", "platform") for x in xs]
    rails = [pipe([(xs[0], y, z + h), (xs[1], y, z + h)], r, style) for h, r in ((1.05, 0.021), (0.55, 0.015))]
    return [*parts, *(piece(one, "railing", "safety", "platform") for one in rails)]


def _ring_platform(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A platform round a silo, tank or chimney: sectors of plate or one ring on brackets, railing outside."""
    r, w, h = num(rng, 0.4, 1.2), num(rng, 0.6, 0.9), num(rng, 1.0, 2.5)
    turn = pick(rng, 2 * np.pi, num(rng, 1.5, 4.0))
    full = turn > 6
    n = few_sides(style, r, 40)
    parts = [piece(cylinder(r, 0, h + num(rng, 0.2, 1.5), n), pick(rng, "wall", "column"), "concrete")]
    count = max(2, int(turn / 0.8))
    step = turn / count
    a = np.linspace(0.003, step - 0.003, 5)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    outline = np.vstack([(r + 0.01) * unit[::-1], (r + w) * unit])
    one_mesh = chance(rng, 0.4)
    sectors = [moved(extrude(outline, h - 0.03, h), spun("z", k * step)) for k in range(count)]
    if one_mesh and full:
        parts.append(piece(ring(r + 0.005, r + w, h - 0.03, h, n), "platform", "clamp", "platform"))
    else:
        name = pick(rng, "platform", "plate", "grating")
        parts += [piece(one, name, "clamp", "platform") for one in sectors]
    shape = [(r - 0.02, h - 0.03), (r - 0.02, h - 0.35), (r + 0.05, h - 0.35), (r + w, h - 0.1), (r + w, h - 0.03)]
    for k in range(count + (0 if full else 1)):
        parts.append(piece(moved(slab_xz(shape, 0.012), spun("z", k * step)), "bracket"))
        x, y = (r + w - 0.03) * np.cos(k * step), (r + w - 0.03) * np.sin(k * step)
        parts.append(piece(pipe([(x, y, h - 0.03), (x, y, h + 1.05)], 0.019, style), "post", "safety", "platform"))
    t = np.linspace(0, turn, 6 * count + 1)
    for z, thick in ((1.05, 0.021), (0.55, 0.015)):
        path = np.column_stack([(r + w - 0.03) * np.cos(t), (r + w - 0.03) * np.sin(t), np.full(len(t), h + z)])
        parts.append(piece(pipe(path if not full else path[:-2], thick, style), "railing", "safety", "platform"))
    return Model(parts)


def _solid_platform(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A platform of one piece: folded plate, ribbed plate or slab; on legs, brackets or blocks."""
    w, d, h = num(rng, 0.8, 2.8), num(rng, 0.6, 1.6), num(rng, 0.15, 2.2)
    kind = int(rng.integers(3))
    deep = num(rng, 0.06, 0.15)
    solids = [box((w, d, 0.008), (0, 0, h - 0.004))]
    if kind < 2:
        solids += [box((w, 0.006, deep), (0, s * (d / 2 - 0.003), h - 0.008 - deep / 2)) for s in (-1, 1)]
        solids += [box((0.006, d - 0.012, deep), (s * (w / 2 - 0.003), 0, h - 0.008 - deep / 2)) for s in (-1, 1)]
    if kind == 1:
        solids += [
            box((0.008, d - 0.012, 0.7 * deep), (x, 0, h - 0.008 - 0.35 * deep))
            for x in np.linspace(-0.3 * w, 0.3 * w, 4)
        ]
    if kind == 2:
        solids, deep = [box((w, d, deep), (0, 0, h - deep / 2))], deep - 0.008
    parts = [piece(merge(solids), "platform", pick(rng, "clamp", "steel", "concrete"), "platform")]
    foot, low = int(rng.integers(3)), h - 0.008 - deep
    if foot == 0 or low < 0.15:
        parts += [piece(box((0.2, d, low), (s * 0.35 * w, 0, low / 2)), "foundation", "concrete") for s in (-1, 1)]
    elif foot == 1:
        one = drawn(rng, style, 0.07, ("SHS", "CHS", "L", "U"))
        for sx in (-1, 1):
            for sy in (-1, 1):
                plates, z = base(sx * (w / 2 - 0.08), sy * (d / 2 - 0.08), (0.15, 0.15), style, rng)
                x, y = sx * (w / 2 - 0.08), sy * (d / 2 - 0.08)
                parts += [*plates, piece(bar((x, y, z), (x, y, low), one), "column")]
    else:
        parts.append(piece(box((w + 0.4, 0.2, h + 0.8), (0, d / 2 + 0.1, (h + 0.8) / 2)), "wall", "concrete"))
        shape = [(d / 2, low), (-d / 2 + 0.1, low), (-d / 2 + 0.1, low - 0.04), (d / 2, low - min(0.5, 0.8 * low))]
        parts += [piece(moved(slab_yz(shape, 0.012), at(x)), "bracket") for x in (-0.35 * w, 0.35 * w)]
    if h > 0.5 and chance(rng, 0.7):
        parts += _bow((-w / 2 + 0.05, w / 2 - 0.05), -d / 2 + 0.05, h, style)
    return Model(parts)


def _mezzanine(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A mezzanine bay: columns, girders, joists on or between them, panels or one floor, kick plate and railing."""
    w, d, h = num(rng, 2.0, 4.5), num(rng, 1.5, 3.0), num(rng, 2.0, 3.2)
    column, girder = (
        drawn(rng, style, num(rng, 0.1, 0.2), ("H", "SHS", "CHS")),
        drawn(rng, style, num(rng, 0.16, 0.28), ("I", "H", "U", "RHS")),
    )
    joist = drawn(rng, style, num(rng, 0.1, 0.16), ("C", "Z", "I", "U"))
    parts: list[Part] = []
    xs = np.linspace(0, w, int(rng.integers(2, 4)))
    for x in xs:
        for y in (0.0, d):
            plates, z = base(float(x), y, (0.3, 0.3), style, rng)
            parts += [*plates, piece(bar((x, y, z), (x, y, h), column), "column")]
    g0, g1 = float(girder[0][:, 1].min()), float(girder[0][:, 1].max())
    parts += [piece(bar((-0.15, y, h - g0), (w + 0.15, y, h - g0), girder), "beam") for y in (0.0, d)]
    top = h + g1 - g0
    j0, j1 = float(joist[0][:, 1].min()), float(joist[0][:, 1].max())
    parts += [
        piece(bar((x, -0.1, top - j0), (x, d + 0.1, top - j0), joist), "beam", "clamp")
        for x in np.linspace(0, w, int(rng.integers(4, 8)))
    ]
    floor = top + j1 - j0
    if chance(rng, 0.5):
        parts.append(piece(box((w + 0.3, d + 0.2, 0.03), (w / 2, d / 2, floor + 0.015)), "platform", "ground"))
    else:
        kind, count = pick(rng, "bar", "sheet", "planks", "pressed"), int(rng.integers(2, 4))
        wide = (w + 0.3) / count
        tile = panel(kind, wide - 0.004, d + 0.2, 0.03, style, 11)
        parts += [
            piece(moved(tile, at(-0.15 + (k + 0.5) * wide, d / 2, floor)), _name(kind), "clamp") for k in range(count)
        ]
    parts += _bow((0.0, w), -0.05, floor + 0.03, style)
    if chance(rng, 0.5):
        knee = section(pick(rng, "L", "SHS"), 0.06, style)
        parts += [piece(bar((0, y, h - 0.6), (0.6, y, h), knee), "brace") for y in (0.0, d)]
    return Model(parts)


def _tower(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A mobile scaffold tower (EN 1004): ladder frames, diagonal braces, a deck with a rail, casters or foot plates."""
    a, b, h, r = num(rng, 1.2, 2.2), num(rng, 0.7, 1.3), num(rng, 1.6, 3.2), num(rng, 0.06, 0.09)
    parts: list[Part] = []
    spots = [(x, y) for x in (0.0, a) for y in (0.0, b)]
    if chance(rng, 0.7):
        parts, low = wheeled(spots, ("stem",), r, style, rng)
    else:
        low = 0.012
        parts = [piece(box((0.15, 0.15, 0.012), (x, y, 0.006)), "base plate") for x, y in spots]
    for x in (0.0, a):
        parts += [
            piece(pipe([(x, y, low), (x, y, h + 1.0)], 0.024, style, 0, 0.003), "column", "clamp") for y in (0.0, b)
        ]
        rungs = [pipe([(x, 0, z), (x, b, z)], 0.019, style) for z in np.arange(low + 0.3, h + 1.0, 0.5)]
        parts += [piece(one, "ladder", "clamp") for one in ([merge(rungs)] if chance(rng, 0.5) else rungs)]
    for y, s in ((-0.03, 1), (b + 0.03, -1)):
        ends = (low + 0.2, h - 0.2) if s > 0 else (h - 0.2, low + 0.2)
        parts.append(piece(pipe([(0, y, ends[0]), (a, y, ends[1])], 0.017, style), "brace", "clamp"))
        parts += [piece(pipe([(0, y, h + z), (a, y, h + z)], 0.017, style), "railing", "clamp") for z in (0.5, 0.98)]
    parts.append(piece(box((a, b - 0.05, 0.05), (a / 2, b / 2, h)), "platform", "safety"))
    return Model(parts)


FLOORS: tuple[Family, ...] = (
    floor_family("grating/panels", _panels, 1.5, "fitting"),
    floor_family("grating/trench", _trench, 1.0, "fitting"),
    floor_family("platform/ring", _ring_platform, 1.2),
    floor_family("platform/solid", _solid_platform, 1.3),
    floor_family("platform/mezzanine", _mezzanine, 1.0, "fitting"),
    floor_family("platform/scaffold", _tower, 0.8, "fitting"),
)
