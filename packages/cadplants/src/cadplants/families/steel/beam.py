"""Beams and trusses: rolled, welded, cold-formed, castellated, of timber and concrete."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    ROLLED,
    Section,
    bar,
    base,
    bolted,
    chance,
    drawn,
    few_sides,
    floor_family,
    mirrored,
    num,
    piece,
    propped,
    section,
    slab_xz,
    slab_yz,
    span_of,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import box
from cadplants.transforms import at, spun

__all__ = ["BEAMS"]


def _laid(parts: list[Part], top: float) -> list[Part]:
    """Parts built on z = 0 lifted onto what carries them."""
    return [Part(moved(p.solid, at(0, 0, top)), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]


def _on_props(parts: list[Part], length: float, wide: float, style: ModelingStyle, rng: np.random.Generator) -> Model:
    props, top = propped(length, wide, style, rng)
    return Model([*_laid(parts, top), *props])


def _end_plates(length: float, one: Section, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """End plates, cleats or nothing at the ends of a beam along x."""
    x0, x1, y0, y1 = span_of(one)
    kind = int(rng.integers(3))
    if kind == 0:
        return []
    parts: list[Part] = []
    for x, s in ((0.0, -1), (length, 1)):
        w, h = x1 - x0 + 0.03, y1 - y0
        if kind == 1:
            edge = [[x0 - 0.015, y0], [x1 + 0.015, y0], [x1 + 0.015, y1], [x0 - 0.015, y1]]
            outline = np.array(edge) + np.array([0, z])
            spots = [(float(outline[0, 0]) + u * w, z + y0 + v * h) for u in (0.15, 0.85) for v in (0.25, 0.75)]
            holes = tuple(circle(0.008, 8, spot) for spot in spots) if style.holes and h > 0.07 else ()
            parts.append(piece(slab_yz(outline, 0.012, x + s * 0.006, holes), "plate"))
        else:
            parts.append(piece(box((0.06, 0.01, 0.6 * h), (x + s * 0.03 - s * 0.02, x1 + 0.005, z)), "plate"))
    return parts


def _plain_beam(
    _: int, style: ModelingStyle, rng: np.random.Generator, kinds: tuple[str, ...], long: float = 6.0
) -> Model:
    """One to three sections side by side on props (EN 10365, EN 10210, EN 10162)."""
    length, parts = num(rng, 0.6, long), []
    size, count = num(rng, 0.08, 0.32), int(rng.integers(1, 4))
    one = drawn(rng, style, size, kinds)
    x0, x1, y0, _y1 = span_of(one)
    pitch = (x1 - x0) * num(rng, 1.0, 2.0) + 0.004
    for k in range(count):
        y = (k - (count - 1) / 2) * pitch
        parts.append(piece(bar((0, y, -y0), (length, y, -y0), one), "beam"))
    if count == 1:
        parts += _end_plates(length, one, -y0, style, rng)
    return _on_props(parts, length, (count - 1) * pitch + x1 - x0, style, rng)


def _castellated(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A castellated or cellular beam: an I section whose web has hexagonal or round openings."""
    length, h = num(rng, 2.0, 6.0), num(rng, 0.25, 0.6)
    b, f, t = 0.45 * h, 0.05 * h, max(0.006, 0.025 * h)
    count = int(np.clip(length / (1.1 * h), 3, 12))
    xs = (np.arange(count) + 0.5) * length / count
    n = 6 if chance(rng, 0.5) else few_sides(style, 0.32 * h, 16)
    holes = tuple(circle(0.31 * h, n, (float(x), h / 2)) for x in xs)
    web = slab_xz([(0, f), (length, f), (length, h - f), (0, h - f)], t, 0.0, holes)
    flanges = [box((length, b, f), (length / 2, 0, z)) for z in (f / 2, h - f / 2)]
    if chance(rng, 0.6):
        parts = [piece(merge([web, *flanges]), "beam")]
    else:
        parts = [piece(one, "beam", bundle="beam") for one in (web, *flanges)]
    return _on_props(parts, length, b, style, rng)


def _girder(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A welded plate girder, straight, haunched or tapered, with stiffeners; one web or a box of two."""
    length, h = num(rng, 1.5, 6.0), num(rng, 0.3, 0.9)
    b, f, t = num(rng, 0.35, 0.6) * h, 0.02, 0.01
    low = h * pick(rng, 1.0, 1.0, 0.55, 0.7)
    shape = pick(rng, "taper", "ridge", "haunch") if low < h else "plain"
    side = {
        "plain": [(length, h), (0, h)],
        "taper": [(length, low), (0, h)],
        "ridge": [(length, low), (length / 2, h), (0, low)],
        "haunch": [(length, h), (0.75 * length, low), (0.25 * length, low), (0, h)],
    }[shape]
    webs = [0.0] if chance(rng, 0.7) else [-0.3 * b, 0.3 * b]
    solids = [slab_xz(np.array([(0, f), (length, f), *side]), t, y) for y in webs]
    solids.append(box((length, b, f), (length / 2, 0, f / 2)))
    for (xa, za), (xb, zb) in zip(side[:-1], side[1:], strict=True):
        solids.append(slab_xz([(xb, zb), (xa, za), (xa, za + f), (xb, zb + f)], b))
    joined = chance(rng, 0.5)
    parts = [piece(merge(solids), "beam")] if joined else [piece(one, "beam", bundle="beam") for one in solids]
    if len(webs) == 1 and chance(rng, 0.75):
        xs = np.linspace(0.01, length - 0.01, int(rng.integers(2, 7)))
        tops = np.interp(xs, [p[0] for p in side[::-1]], [p[1] for p in side[::-1]])
        ribs = [
            box((0.01, b / 2 - t / 2 - 0.01, z - f - 0.005), (x, s * (b / 4 + t / 4 - 0.005), (z + f - 0.005) / 2))
            for x, z in zip(xs, tops, strict=True)
            for s in (-1, 1)
        ]
        parts += [piece(rib, "plate", bundle="beam") for rib in ribs]
    return _on_props(parts, length, b, style, rng)


def _crane_runway(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A crane runway: an I or box girder on columns with brackets, a rail (DIN 536) with clips and an end stop."""
    length, h = num(rng, 2.5, 6.0), num(rng, 0.25, 0.5)
    girder = drawn(rng, style, h, ("H", "I", "RHS"))
    rail = section(pick(rng, "rail", "rail", "square"), num(rng, 0.05, 0.12), style)
    _a, _b, r0, r1 = span_of(rail)
    parts = [piece(bar((0, 0, h / 2), (length, 0, h / 2), girder), "beam")]
    parts.append(piece(bar((0, 0, h - r0), (length, 0, h - r0), rail), "beam"))
    foot = 0.5 * (span_of(rail)[1] - span_of(rail)[0])
    for x in np.arange(0.3, length - 0.2, 0.6):
        parts += [piece(box((0.06, 0.05, 0.015), (x, s * (foot + 0.02), h + 0.0075)), "clamp") for s in (-1, 1)]
    if chance(rng, 0.7):
        parts.append(piece(box((0.02, 0.12, r1 - r0 + 0.15), (length - 0.01, 0, h + (r1 - r0 + 0.15) / 2)), "plate"))
    return _on_props(parts, length, span_of(girder)[1] * 2, style, rng)


def _cold_roof(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cold-formed purlins (Z, lipped C, hat) bolted to cleats on two rafters on short columns."""
    length, depth = num(rng, 1.5, 4.0), num(rng, 1.0, 3.0)
    rafter = drawn(rng, style, num(rng, 0.12, 0.25), ("H", "I", "U", "RHS"))
    purlin = drawn(rng, style, num(rng, 0.12, 0.25), ("Z", "C", "Z"))
    deep, (_a, _b, low, high) = span_of(rafter)[3], span_of(purlin)
    props, top = propped(depth, 0.15, style, rng)
    parts: list[Part] = []
    for x in (0.15 * length, 0.85 * length):
        parts.append(piece(bar((x, 0, top + deep), (x, depth, top + deep), rafter), "beam"))
        parts += [
            Part(moved(p.solid, at(x) @ spun("z", np.pi / 2)), p.name, p.color, "", p.group, p.fine) for p in props
        ]
    z = top + 2 * deep
    for y in np.linspace(0.15, depth - 0.15, int(rng.integers(2, 5))):
        parts.append(piece(bar((0, y, z - low), (length, y, z - low), purlin), "beam", "clamp"))
        if chance(rng, 0.7):
            for x in (0.15 * length, 0.85 * length):
                cleat = box((0.08, 0.006, 0.8 * (high - low)), (x, y - 0.006, z + 0.4 * (high - low)))
                parts.append(piece(cleat, "bracket"))
    return Model(parts)


def _web_lines(kind: str, length: float, h: float, bays: int) -> list[tuple[Floats, Floats]]:
    """The diagonals and posts of a truss between the chords at z = 0 and h."""
    xs = np.linspace(0, length, bays + 1)
    low = [np.array([x, 0, 0]) for x in xs]
    high = [np.array([x, 0, h]) for x in xs]
    if kind == "warren":
        middles = [np.array([(a + b) / 2, 0, h]) for a, b in zip(xs[:-1], xs[1:], strict=True)]
        return [line for k, m in enumerate(middles) for line in ((low[k], m), (m, low[k + 1]))]
    lines = [(low[k], high[k]) for k in range(1, bays)]
    lines += [
        (low[k], high[k + 1]) if (k < bays / 2) == (kind == "howe") else (high[k], low[k + 1]) for k in range(bays)
    ]
    return lines


def _truss(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lattice girder (Warren, Howe or Pratt) of angles, tees or tubes, with gusset plates or bare."""
    length, h = num(rng, 2.0, 6.0), num(rng, 0.3, 0.9)
    bays = int(np.clip(length / h, 3, 9))
    chord = drawn(rng, style, num(rng, 0.06, 0.12), ("SHS", "CHS", "T", "L", "U"))
    web = drawn(rng, style, num(rng, 0.035, 0.055), ("SHS", "CHS", "L", "flat", "round"))
    lines = _web_lines(pick(rng, "warren", "howe", "pratt"), length, h, bays)
    chords = [bar((0, 0, 0), (length, 0, 0), chord, (0, 0, -1)), bar((0, 0, h), (length, 0, h), chord)]
    ends = [bar((x, 0, 0), (x, 0, h), web, (0, 1, 0)) for x in (0.04, length - 0.04)]
    solids = [bar(a, b, web, (0, 1, 0)) for a, b in lines]
    if chance(rng, 0.3):
        parts = [piece(merge([*chords, *ends, *solids]), "beam")]
    else:
        parts = [piece(one, "beam", bundle="beam") for one in chords]
        parts += [piece(one, "brace", bundle="beam") for one in (*ends, *solids)]
    if chance(rng, 0.4):
        spots = {(round(float(p[0]), 4), float(p[2])) for line in lines for p in line}
        g = 0.09
        for x, z in sorted(spots):
            s = 1 if z == 0 else -1
            shape = [(x - g, z), (x + g, z), (x + 0.6 * g, z + s * g), (x - 0.6 * g, z + s * g)]
            parts.append(piece(slab_xz(shape if s > 0 else shape[::-1], 0.008), "gusset plate", bundle="beam"))
    return _on_props(_laid(parts, span_of(chord)[3]), length, 0.12, style, rng)


def _roof_truss(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pitched truss of timber or angles: bottom chord, rafters, king post and struts, with nail or gusset plates."""
    length, timber = num(rng, 2.5, 6.0), chance(rng, 0.5)
    h = length * num(rng, 0.15, 0.35)
    chord = section("timber" if timber else pick(rng, "L", "SHS", "T"), 0.12 if timber else 0.07, style)
    web = section("timber" if timber else "L", 0.09 if timber else 0.045, style)
    feet = (np.array([0.0, 0, 0]), np.array([length, 0, 0]))
    ridge, middle = np.array([length / 2, 0, h]), np.array([length / 2, 0, 0.0])
    lines = [(feet[0], feet[1], "beam", chord), (feet[0], ridge, "beam", chord), (feet[1], ridge, "beam", chord)]
    lines.append((middle, ridge, "brace", web))
    for foot in feet:
        lines.append((middle, (foot + ridge) / 2, "brace", web))
        if chance(rng, 0.5):
            lines.append(((foot + middle) / 2, (foot + ridge) / 2, "brace", web))
    color = "safety" if timber else "steel"
    parts = [piece(bar(a, b, one, (0, 0.01, 1)), name, color, "beam") for a, b, name, one in lines]
    if chance(rng, 0.7):
        parts += [
            piece(
                box(
                    (0.22, 0.004, 0.14),
                    (
                        float(p[0]),
                        (span_of(chord)[1] + 0.002) if s > 0 else span_of(chord)[0] - 0.002,
                        float(p[2]) + 0.02,
                    ),
                ),
                "plate",
                "clamp",
                "beam",
            )
            for p in (*feet, ridge)
            for s in (-1, 1)
        ]
    return _on_props(_laid(parts, span_of(chord)[3]), length, 0.15, style, rng)


def _heavy_beam(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Concrete beams (rectangular, T, I with chamfers, L ledge) or sawn timbers, on props."""
    length, h = num(rng, 1.5, 5.0), num(rng, 0.15, 0.6)
    kind = int(rng.integers(5))
    b = 0.5 * h
    shapes = [
        rounded_rectangle(b, h, 0.015, 1) + np.array([0, h / 2]),
        mirrored([(0.4 * b, 0), (0.5 * b, 0.7 * h), (b, 0.72 * h), (b, h)]),
        mirrored([(b, 0), (b, 0.2 * h), (0.3 * b, 0.35 * h), (0.3 * b, 0.75 * h), (1.2 * b, 0.85 * h), (1.2 * b, h)]),
        np.array([(-b, 0), (b, 0), (b, 0.4 * h), (0.3 * b, 0.4 * h), (0.3 * b, h), (-b, h)]),
        rounded_rectangle(0.6 * h, h, 0.0) + np.array([0, h / 2]),
    ]
    solid = bar((0, 0, 0), (length, 0, 0), (shapes[kind], ()))
    parts = [piece(solid, "beam", "safety" if kind == 4 else "concrete")]
    return _on_props(parts, length, float(np.ptp(shapes[kind][:, 0])), style, rng)


def _stack(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A store of profiles: layers of beams or tubes between battens, or on a cantilever rack."""
    length, parts = num(rng, 1.0, 5.0), []
    one = drawn(rng, style, num(rng, 0.06, 0.2), (*ROLLED, "L", "T", "C", "strut"))
    x0, x1, y0, y1 = span_of(one)
    wide, tall = x1 - x0 + 0.003, y1 - y0
    columns, layers, batten = int(rng.integers(2, 6)), int(rng.integers(1, 4)), pick(rng, 0.05, 0.08)
    for k in range(layers):
        z = k * (tall + batten)
        for x in (0.15 * length, 0.85 * length):
            parts.append(piece(box((batten, columns * wide + 0.1, batten), (x, 0, z + batten / 2)), "beam", "safety"))
        for j in range(columns):
            shift, y = num(rng, -0.05, 0.05), (j - (columns - 1) / 2) * wide - (x0 + x1) / 2
            z_ = z + batten - y0
            parts.append(piece(bar((shift, y, z_), (length + shift, y, z_), one), "beam"))
    return Model(parts)


def _cantilever(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A beam cantilevered from a wall or column by an end plate, with a knee brace, a hoist eye or a trolley rail."""
    reach, z = num(rng, 0.5, 2.5), num(rng, 1.2, 2.8)
    one = drawn(rng, style, num(rng, 0.08, 0.2), ("H", "I", "IPN", "U", "SHS"))
    x0, x1, y0, y1 = span_of(one)
    parts: list[Part] = []
    if chance(rng, 0.5):
        parts.append(piece(box((0.2, 1.4, z + 0.8), (-0.1, 0, (z + 0.8) / 2)), "wall", "concrete"))
    else:
        shaft = drawn(rng, style, 0.2, ("H", "SHS"))
        plates, low = base(-0.1, 0, (0.32, 0.32), style, rng)
        parts += [*plates, piece(bar((-0.1, 0, low), (-0.1, 0, z + 0.5), shaft, (1, 0, 0)), "column")]
    w, h = x1 - x0 + 0.08, y1 - y0 + 0.1
    parts.append(piece(box((0.015, w, h), (0.0075, 0, z)), "plate"))
    spots = [
        at(0.015, sy * (w / 2 - 0.02), z + sz * (h / 2 - 0.025)) @ spun("y", np.pi / 2)
        for sy in (-1, 1)
        for sz in (-1, 1)
    ]
    parts += bolted(spots, 0.014, style, 0.015)
    parts.append(piece(bar((0.015, 0, z), (reach, 0, z), one), "beam"))
    if chance(rng, 0.6):
        knee, drop = drawn(rng, style, 0.06, ("L", "SHS", "CHS", "flat")), min(0.6 * reach, 0.8)
        parts.append(piece(bar((0.0, 0, z + y0 - drop), (drop, 0, z + y0), knee), "brace"))
    return Model(parts)


BEAMS: tuple[Family, ...] = (
    floor_family("beam/rolled", partial(_plain_beam, kinds=ROLLED), 1.2, "fitting"),
    floor_family(
        "beam/thin sections",
        partial(_plain_beam, kinds=("C", "Z", "strut", "hat", "L", "LL", "T"), long=4.0),
        1.0,
        "fitting",
    ),
    floor_family("beam/castellated", _castellated),
    floor_family("beam/plate girder", _girder),
    floor_family("beam/crane runway", _crane_runway, 0.8, "fitting"),
    floor_family("beam/purlins", _cold_roof, 0.8, "fitting"),
    floor_family("beam/lattice", _truss, 1.2),
    floor_family("beam/pitched truss", _roof_truss, 0.7),
    floor_family("beam/concrete or timber", _heavy_beam, 0.8, "fitting"),
    floor_family("beam/stack", _stack, 0.8, "fitting"),
    floor_family("beam/cantilever", _cantilever, 1.0, "fitting"),
)
