"""Braced frames, racks and gantries, and loose plates: rods with turnbuckles, K and X braces, back-to-back angles."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.caster import wheeled
from cadplants.families.steel.shape import (
    Section,
    bar,
    base,
    bolted,
    chance_ as chance,
    drawn,
    few_sides,
    flat,
    floor_family,
    lug,
    num,
    piece,
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    span_of,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import box, cylinder, rod
from cadplants.transforms import at, looking, spun

__all__ = ["BRACES"]


def _bay(w: float, h: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """Two columns on base plates and a beam between or on them; half a column's width and the beam's underside."""
    column = drawn(rng, style, num(rng, 0.1, 0.2), ("H", "SHS", "I", "CHS"))
    beam = drawn(rng, style, num(rng, 0.1, 0.22), ("I", "H", "RHS", "U"))
    half = float(column[0][:, 0].max())
    parts: list[Part] = []
    for x in (0.0, w):
        plates, z = base(x, 0, (2 * half + 0.14, 2 * half + 0.14), style, rng)
        parts += [*plates, piece(bar((x, 0, z), (x, 0, h), column, (0, 1, 0)), "column")]
    _x0, _x1, y0, y1 = span_of(beam)
    if chance(rng, 0.5):
        parts.append(piece(bar((-0.15, 0, h - y0), (w + 0.15, 0, h - y0), beam), "beam"))
        return parts, half, h
    parts.append(piece(bar((half, 0, h - y1), (w - half, 0, h - y1), beam), "beam"))
    return parts, half, h - (y1 - y0)


def _corner(x: float, z: float, sx: int, sz: int, size: float, rng: np.random.Generator) -> Solid:
    """A gusset plate in a corner: triangle, chamfered or rectangular; about y = 0."""
    kind = int(rng.integers(3))
    shape = [
        [(0, 0), (size, 0), (0, size)],
        [(0, 0), (size, 0), (size, 0.35 * size), (0.35 * size, size), (0, size)],
        [(0, 0), (size, 0), (size, 0.8 * size), (0, 0.8 * size)],
    ][kind]
    one = slab_xz(shape, 0.01)
    return moved(moved(one, np.diag([float(sx), 1.0, float(sz), 1.0])), at(x, 0, z))


def _rod_brace(a: Floats, b: Floats, r: float, y: float, style: ModelingStyle) -> list[Part]:
    """A tie rod with forks at its ends and a turnbuckle (EN 1090 practice)."""
    a, b = a + np.array([0, y, 0]), b + np.array([0, y, 0])
    x = (b - a) / np.linalg.norm(b - a)
    middle = (a + b) / 2
    pose = looking(middle, x) @ spun("y", np.pi / 2)
    frame = [moved(box((1.6 * r, 1.2 * r, 12 * r)), at(s * 2.0 * r)) for s in (-1, 1)]
    frame += [moved(cylinder(2.2 * r, -2 * r, 2 * r, 8), at(0, 0, s * 6 * r)) for s in (-1, 1)]
    parts = [piece(pipe(np.array([a + 3 * r * x, b - 3 * r * x]), r, style), "brace")]
    parts.append(piece(moved(merge(frame), pose), "brace", "clamp"))
    for end, s in ((a, 1), (b, -1)):
        fork = looking(end + s * 3 * r * x, x) @ spun("y", np.pi / 2)
        parts.append(piece(moved(cylinder(2 * r, -4 * r, 4 * r, 8), fork), "bracket", "clamp"))
    return parts


def _double_angle(a: Floats, b: Floats, leg: float, style: ModelingStyle) -> list[Solid]:
    """Two angles back to back with a gusset's thickness and packs between them."""
    one = section("L", leg, style)[0] + np.array([0.28 * leg, 0.0])
    left = np.column_stack([-one[:, 0], one[:, 1]])[::-1]
    solids = [bar(a, b, (one + np.array([0.006, 0]), ())), bar(a, b, (left - np.array([0.006, 0]), ()))]
    for f in (0.3, 0.7):
        p = a + f * (b - a)
        solids.append(moved(box((0.05, 0.012, 0.8 * leg)), looking(p, b - a)))
    return solids


def _braced(_: int, style: ModelingStyle, rng: np.random.Generator, layout: str) -> Model:
    """A braced bay (EN 1993-1-8 details): X, K, V, single or knee braces on gusset plates with bolts."""
    w, h = num(rng, 1.2, 3.2), num(rng, 1.6, 3.4)
    parts, half, top = _bay(w, h, style, rng)
    g, low = num(rng, 0.14, 0.26), 0.05
    corners: list[tuple[float, float, int, int]] = []
    lines: list[tuple[Floats, Floats]] = []

    def end(x: float, z: float, sx: int, sz: int) -> Floats:
        corners.append((x, z, sx, sz))
        return np.array([x + sx * 0.35 * g, 0.0, z + sz * 0.35 * g])

    if layout == "X":
        lines.append((end(half, low, 1, 1), end(w - half, top, -1, -1)))
        lines.append((end(w - half, low, -1, 1), end(half, top, 1, -1)))
    elif layout == "single":
        lines.append((end(half, low, 1, 1), end(w - half, top, -1, -1)))
    elif layout == "K":
        apex = np.array([w / 2, 0.0, top - 0.4 * g])
        parts.append(
            piece(
                slab_xz(
                    [(w / 2 - g, top - 0.7 * g), (w / 2 + g, top - 0.7 * g), (w / 2 + g, top), (w / 2 - g, top)], 0.01
                ),
                "gusset plate",
            )
        )
        lines += [
            (end(half, low, 1, 1), apex - np.array([0.3 * g, 0, 0])),
            (end(w - half, low, -1, 1), apex + np.array([0.3 * g, 0, 0])),
        ]
    else:
        d = min(0.8, 0.3 * w, 0.3 * h)
        lines += [
            (np.array([half, 0, top - d]), np.array([half + d, 0, top])),
            (np.array([w - half, 0, top - d]), np.array([w - half - d, 0, top])),
        ]
    parts += [piece(_corner(x, z, sx, sz, g, rng), "gusset plate") for x, z, sx, sz in corners]
    kind = (
        pick(rng, "rod", "angles", "tube", "flat", "angle") if layout != "knee" else pick(rng, "tube", "angle", "flat")
    )
    one = section({"tube": pick(rng, "CHS", "SHS")}.get(kind, "L"), num(rng, 0.05, 0.09), style)
    for k, (a, b) in enumerate(lines):
        y = 0.012 * (-1) ** k if layout == "X" else 0.0
        if kind == "rod":
            parts += _rod_brace(a, b, num(rng, 0.008, 0.014), 1.2 * y, style)
        elif kind == "angles":
            solids = _double_angle(a, b, num(rng, 0.05, 0.07), style)
            parts += [piece(s, "brace") for s in ([merge(solids)] if chance(rng, 0.4) else solids)]
        elif kind == "flat":
            parts.append(piece(moved(flat(a, b, 0.06, 0.008), at(0, 0.009 * (-1) ** k)), "brace"))
        elif kind == "angle":
            shift = -0.005 - one[0][:, 0].max() if layout != "knee" else 0.0
            parts.append(piece(moved(bar(a, b, one), at(0, float(shift) * (-1) ** k)), "brace"))
        else:
            parts.append(piece(bar(a, b, one), "brace"))
    if kind != "rod":
        spots = [at(x + sx * 0.3 * g, -0.005, z + sz * 0.3 * g) @ spun("x", np.pi / 2) for x, z, sx, sz in corners]
        parts += bolted(spots, 0.014, style, 0.012, True)
    return Model(parts)


def _rack(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bay of a pipe rack: two frames with tiers, cantilevers, struts, braces; some pipes on the tiers."""
    w, d, h = num(rng, 1.2, 3.0), num(rng, 1.2, 3.0), num(rng, 1.8, 3.8)
    column, beam = (
        drawn(rng, style, num(rng, 0.12, 0.2), ("H", "SHS")),
        drawn(rng, style, num(rng, 0.1, 0.2), ("H", "I", "U")),
    )
    strut = drawn(rng, style, num(rng, 0.08, 0.14), ("SHS", "U", "I"))
    half, y1 = float(column[0][:, 0].max()), span_of(beam)[3]
    levels = np.linspace(h, 0.45 * h, int(rng.integers(1, 4)))
    arm = pick(rng, 0.0, num(rng, 0.4, 0.8))
    parts: list[Part] = []
    for y in (0.0, d):
        for x in (0.0, w):
            plates, z = base(x, y, (0.3, 0.3), style, rng)
            parts += [*plates, piece(bar((x, y, z), (x, y, h), column, (0, 1, 0)), "column")]
        for level in levels:
            parts.append(piece(bar((half, y, level - y1), (w - half, y, level - y1), beam), "beam"))
            if arm:
                parts.append(piece(bar((w + half, y, level - y1), (w + half + arm, y, level - y1), beam), "beam"))
    back = float(column[0][:, 1].max())
    for x in (0.0, w):
        z = 0.7 * h
        parts.append(piece(bar((x, back, z), (x, d - back, z), strut), "beam"))
        if chance(rng, 0.6):
            thin = section(pick(rng, "L", "CHS", "flat"), 0.05, style)
            parts.append(piece(bar((x, back, 0.15), (x, d - back, z - 0.06), thin), "brace"))
    for level in levels:
        for x in np.arange(0.3, w - 0.2, 0.4):
            if chance(rng, 0.5):
                r = pick(rng, 0.03, 0.057, 0.084)
                run = pipe([(x, -0.4, level + r), (x, d + 0.4, level + r)], r, style, 0.0, 0.004)
                parts.append(Part(run, "pipe", "pipe", "", "Pipe assembly"))
    return Model(parts)


def _gantry(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lifting gantry or tripod: splayed legs with ties, a runway beam with an eye or trolley, on casters or feet."""
    w, h, d = num(rng, 1.2, 3.0), num(rng, 1.6, 3.0), num(rng, 0.8, 1.4)
    leg = drawn(rng, style, num(rng, 0.06, 0.1), ("SHS", "CHS", "U", "L"))
    parts: list[Part] = []
    if chance(rng, 0.3):
        r = 0.4 * h
        for k in range(3):
            x, y = r * np.cos(2.0944 * k), r * np.sin(2.0944 * k)
            parts.append(piece(bar((x, y, 0.01), (0.08 * x / r, 0.08 * y / r, h), leg), "column"))
            parts.append(piece(moved(cylinder(0.09, 0, 0.01, 14), at(x, y)), "base plate"))
            x2, y2 = r * np.cos(2.0944 * (k + 1)), r * np.sin(2.0944 * (k + 1))
            if chance(rng, 0.8):
                parts.append(piece(rod((0.6 * x, 0.6 * y, 0.4 * h), (0.6 * x2, 0.6 * y2, 0.4 * h), 0.015, 10), "brace"))
        parts.append(piece(cylinder(0.16, h, h + 0.02, 20), "plate"))
        parts.append(piece(moved(moved(lug(style, 0.08, 0.015), spun("x", np.pi)), at(0, 0, h)), "lifting lug"))
        return Model(parts)
    low = 0.01
    spots = [(x, s * d / 2) for x in (0.0, w) for s in (-1, 1)]
    if chance(rng, 0.6):
        parts, low = wheeled(spots, (pick(rng, "swivel", "heavy", "braked"),), num(rng, 0.05, 0.09), style, rng)
    else:
        parts = [piece(box((0.2, 0.2, 0.01), (x, y, 0.005)), "base plate") for x, y in spots]
    deep = float(np.ptp(leg[0][:, 1])) / 2
    for x in (0.0, w):
        parts.append(piece(bar((x, -d / 2 - 0.1, low + deep), (x, d / 2 + 0.1, low + deep), leg), "beam"))
        parts += [piece(bar((x, s * d / 2, low + 2 * deep), (x, s * 0.06, h), leg), "column") for s in (-1, 1)]
        parts.append(piece(bar((x, -0.3 * d, 0.45 * h), (x, 0.3 * d, 0.45 * h), leg), pick(rng, "brace", "beam")))
        parts.append(piece(box((0.2, 0.3, 0.015), (x, 0, h + 0.0075)), "plate"))
    one = drawn(rng, style, num(rng, 0.12, 0.24), ("I", "IPN", "H"))
    z = h + 0.015 - span_of(one)[2]
    parts.append(piece(bar((-0.3, 0, z), (w + 0.3, 0, z), one), "beam"))
    if chance(rng, 0.6):
        parts.append(
            piece(moved(moved(lug(style, 0.08, 0.02), spun("x", np.pi)), at(w * 0.4, 0, h + 0.015)), "lifting lug")
        )
    if chance(rng, 0.5):
        parts += [
            piece(
                bar(
                    (s * 0.0 if s > 0 else w, 0, h - 0.5),
                    (0.5 if s > 0 else w - 0.5, 0, h + 0.015),
                    section("SHS", 0.05, style),
                ),
                "brace",
            )
            for s in (-1, 1)
        ]
    return Model(parts)


def _small_frame(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Small supports: T-posts, goalposts, wall brackets with braces, trapeze of strut channel on threaded rods."""
    kind, h, w = int(rng.integers(4)), num(rng, 0.4, 1.6), num(rng, 0.4, 1.4)
    one: Section = drawn(rng, style, num(rng, 0.05, 0.12), ("SHS", "U", "L", "strut", "H", "CHS"))
    y0 = span_of(one)[2]
    parts: list[Part] = []
    if kind < 2:
        for x in (0.0,) if kind == 0 else (-0.42 * w, 0.42 * w):
            plates, z = base(x, 0, (0.16, 0.16), style, rng)
            parts += [*plates, piece(bar((x, 0, z), (x, 0, h), one, (0, 1, 0)), pick(rng, "column", "post"))]
        parts.append(piece(bar((-w / 2, 0, h - y0), (w / 2, 0, h - y0), one), "beam"))
        if kind == 0 and chance(rng, 0.6):
            thin = section("L", 0.035, style)
            parts += [piece(bar((0, 0, h - 0.3 * w), (s * 0.35 * w, 0, h), thin), "brace") for s in (-1, 1)]
    elif kind == 2:
        parts.append(piece(box((1.2, 0.2, h + 0.8), (0, 0.1, (h + 0.8) / 2)), "wall", "concrete"))
        for x in (-0.3, 0.3):
            parts.append(piece(box((0.12, 0.01, 0.22), (x, -0.005, h - 0.05)), "plate"))
            parts.append(piece(bar((x, -0.01, h), (x, -w, h), one), "beam"))
            drop = min(0.6 * w, 0.7 * h)
            parts.append(
                piece(
                    bar((x, 0, h - drop), (x, -0.75 * w, h + y0), section(pick(rng, "L", "flat", "SHS"), 0.04, style)),
                    "brace",
                )
            )
            poses = [at(x + s * 0.045, -0.01, h + t) @ spun("x", np.pi / 2) for s in (-1, 1) for t in (-0.13, 0.03)]
            parts += bolted(poses, 0.01, style, 0.01)
    else:
        top, n = h + 1.0, 8
        over = drawn(rng, style, 0.14, ("H", "I"))
        parts += [
            piece(bar((s * w, 0, 0), (s * w, 0, top - span_of(over)[3]), section("SHS", 0.08, style)), "column")
            for s in (-1, 1)
        ]
        parts.append(piece(bar((-w, 0, top), (w, 0, top), over), "beam"))
        parts += [
            piece(
                rod((s * 0.4 * w, 0, h + 2 * y0 - 0.04), (s * 0.4 * w, 0, top + span_of(over)[2]), 0.006, n),
                "stud",
                "fastener",
            )
            for s in (-1, 1)
        ]
        parts.append(piece(bar((-w / 2, 0, h + y0), (w / 2, 0, h + y0), one), pick(rng, "beam", "bracket")))
    return Model(parts)


def _plates(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Loose plates: blank, drilled, clipped, round, ribbed or bent; lying, stacked or on a wall."""
    parts: list[Part] = []
    for k in range(int(rng.integers(3, 7))):
        a, b, t = num(rng, 0.1, 0.9), num(rng, 0.08, 0.6), pick(rng, 0.004, 0.008, 0.012, 0.02)
        y, kind = 0.9 * k, int(rng.integers(6))
        c = 0.2 * min(a, b)
        if kind == 0:
            outline = rounded_rectangle(a, b, pick(rng, 0.0, 0.3 * c), 3)
        elif kind == 1:
            outline = np.array(
                [
                    [-a / 2, -b / 2],
                    [a / 2 - c, -b / 2],
                    [a / 2, -b / 2 + c],
                    [a / 2, b / 2],
                    [-a / 2 + c, b / 2],
                    [-a / 2, b / 2 - c],
                ]
            )
        elif kind == 2:
            outline = circle(b / 2, few_sides(style, b / 2, 40))
        elif kind == 3:
            outline = np.array(
                [[-a / 2, -b / 2], [a / 2, -b / 2], [a / 2, -0.1 * b], [-0.1 * a, b / 2], [-a / 2, b / 2]]
            )
        else:
            outline = np.zeros((0, 2))
        if kind >= 4:
            line = (
                [(-a / 2, 0.0), (a / 4, 0.0), (a / 2, 0.4 * a)]
                if kind == 4
                else [(-a / 2, 0.5 * c), (-a / 2, 0.0), (a / 2, 0.0), (a / 2, c)]
            )
            solid = slab_xz(ribbon(np.array(line), t, 2 * t, 3), b)
            parts.append(piece(moved(solid, at(0, y, t / 2)), pick(rng, "plate", "plate", "bracket"), "clamp"))
            continue
        d = 0.06 * min(a, b)
        spots = [(sx * 0.28 * (b if kind == 2 else a), sy * 0.28 * b) for sx in (-1, 1) for sy in (-1, 1)]
        holes = tuple(circle(d, 10, spot) for spot in spots) if chance(rng, 0.6) and kind != 3 else ()
        flat_ = slab_xy(outline, 0, t, holes)
        lean = int(rng.integers(4))
        if lean == 0:
            pose = at(0, y + 0.1, b / 2) @ spun("x", np.pi / 2)
            parts.append(piece(box((a + 0.3, 0.15, b + 0.3), (0, y + 0.175, (b + 0.3) / 2)), "wall", "concrete"))
            parts.append(piece(moved(flat_, pose), "plate"))
        elif lean == 1:
            count = int(rng.integers(2, 6))
            parts += [piece(moved(flat_, at(num(rng, -0.02, 0.02), y, i * t)), "plate") for i in range(count)]
        else:
            parts.append(piece(moved(flat_, at(0, y)), "plate"))
            if lean == 2 and kind in (0, 1):
                parts += [piece(box((0.7 * a, 0.008, 0.06), (0, y + s * 0.18 * b, t + 0.03)), "plate") for s in (-1, 1)]
    return Model(parts)


BRACES: tuple[Family, ...] = (
    floor_family("brace/crossed", partial(_braced, layout="X"), 1.3, "fitting"),
    floor_family("brace/chevron", partial(_braced, layout="K"), 1.2, "fitting"),
    floor_family("brace/diagonal", partial(_braced, layout="single"), 1.0, "fitting"),
    floor_family("brace/knee", partial(_braced, layout="knee"), 1.0, "fitting"),
    Family("frame/pipe rack", "floor", "Structural element", "beam", _rack, (15,), "fitting", 1.2),
    Family("frame/gantry", "floor", "Structural element", "beam", _gantry, (15,), "fitting", 1.0),
    Family("frame/small support", "floor", "Structural element", "beam", _small_frame, (15,), "fitting", 1.2),
    floor_family("plate/loose", _plates, 1.2, "fitting"),
)
