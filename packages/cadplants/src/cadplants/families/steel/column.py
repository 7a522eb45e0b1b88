"""Columns: laced, built up, stiffened, of concrete and timber, poles."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    bar,
    base,
    chance_ as chance,
    drawn,
    few_sides,
    flat,
    floor_family,
    num,
    piece,
    pipe,
    section,
    slab_xy,
    slab_xz,
    span_of,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import box, cylinder, turned
from cadplants.transforms import at, spun

__all__ = ["COLUMNS"]


def _capped(x: float, y: float, z: float, size: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A cap plate with its bolts or a short beam on it, or nothing."""
    kind = int(rng.integers(3))
    if kind == 0:
        return []
    cap = [piece(box((size, size, 0.015), (x, y, z + 0.0075)), "plate")]
    if kind == 2:
        one = drawn(rng, style, num(rng, 0.1, 0.2), ("H", "I", "U"))
        z_ = z + 0.015 - span_of(one)[2]
        cap.append(piece(bar((x - 0.6, y, z_), (x + 0.6, y, z_), one), "beam"))
    return cap


def _laced(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A built-up column: two channels or four angles with lacing bars or batten plates (EN 1993-1-1, 6.4)."""
    h, w = num(rng, 1.5, 4.5), num(rng, 0.18, 0.4)
    four, battens = chance(rng, 0.4), chance(rng, 0.5)
    d = w if four else num(rng, 0.1, 0.2)
    parts, low = base(0, 0, (w + 0.15, d + 0.15), style, rng)
    if four:
        leg = section("L", 0.25 * w, style)[0] + (0.28 * 0.25 * w, 0.125 * w)
        for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            turn = {(-1, -1): 0.0, (1, -1): 0.5, (1, 1): 1.0, (-1, 1): 1.5}[(sx, sy)]
            one = moved(extrude(leg, low, h), at(sx * w / 2, sy * d / 2) @ spun("z", turn * np.pi))
            parts.append(piece(one, "column", bundle="column"))
    else:
        shape = section("U", d, style)[0] + (0.16 * d, 0)
        for s in (-1, 1):
            one = moved(extrude(shape, low, h), at(s * w / 2) @ spun("z", 0.0 if s < 0 else np.pi))
            parts.append(piece(one, "column", bundle="column"))
    count = int(np.clip(h / (0.9 * w), 3, 10))
    zs = np.linspace(low + 0.05, h - 0.05, count + 1)
    for k, (za, zb) in enumerate(zip(zs[:-1], zs[1:], strict=True)):
        for s in (-1, 1):
            y, x = s * (d / 2 + 0.004), w / 2 - 0.02
            if battens:
                parts.append(piece(box((w, 0.008, 0.35 * (zb - za)), (0, y, (za + zb) / 2)), "plate", bundle="column"))
            else:
                flip = x if (k + (s > 0)) % 2 else -x
                parts.append(
                    piece(flat((-flip, y, za), (flip, y, zb), 0.008, 0.04, (0, 1, 0)), "brace", bundle="column")
                )
    return Model([*parts, *_capped(0, 0, h, max(w, d) + 0.08, style, rng)])


def _stiffened(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A steel column on a stiffened base: gussets between shaft and plate, grout and a concrete pedestal."""
    h, size = num(rng, 0.8, 4.0), num(rng, 0.1, 0.3)
    one = drawn(rng, style, size, ("H", "SHS", "CHS", "I"))
    low, parts = 0.0, []
    side = 2.0 * size
    if chance(rng, 0.6):
        low = num(rng, 0.15, 0.6)
        parts.append(
            piece(slab_xy(rounded_rectangle(side + 0.2, side + 0.2, 0.03, 1), 0, low), "foundation", "concrete")
        )
        if chance(rng, 0.5):
            parts.append(piece(box((side + 0.04, side + 0.04, 0.03), (0, 0, low + 0.015)), "foundation", "ground"))
            low += 0.03
    plates, low = base(0, 0, (side, side), style, rng, low)
    parts += [*plates, piece(bar((0, 0, low), (0, 0, h + low), one, (1, 0, 0)), "column", bundle="column")]
    x0, x1, y0, y1 = span_of(one)
    reach, tall = 0.45 * size, num(rng, 0.6, 1.4) * size
    shape = [(0, 0), (reach, 0), (reach, 0.2 * tall), (0.25 * reach, tall), (0, tall)]
    for turn, edge in ((0, y1), (1, x1), (2, -y0), (3, -x0)):
        gusset = moved(slab_xz(shape, 0.01), spun("z", turn * np.pi / 2) @ at(edge, 0, low))
        parts.append(piece(gusset, "gusset plate", bundle="column"))
    return Model([*parts, *_capped(0, 0, h + low, size + 0.1, style, rng)])


def _concrete_column(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A concrete column: square with chamfers, round, octagonal, with a corbel, a mushroom head or a steel shoe."""
    h, a = num(rng, 1.2, 4.0), num(rng, 0.2, 0.6)
    n = few_sides(style, a / 2, 32)
    kind = int(rng.integers(4))
    shape = [
        rounded_rectangle(a, a * pick(rng, 1.0, 1.5), 0.02, 1),
        circle(a / 2, n),
        circle(a / 2, 8),
        circle(a / 2, n),
    ][kind]
    head = turned([(a / 2, 0), (a / 2, h - 0.3), (a, h), (a, h + 0.1)], n)
    shaft = head if kind == 3 else extrude(shape, 0, h)
    parts = [piece(shaft, "column", "concrete", "column")]
    if kind == 0 and chance(rng, 0.6):
        corbel = slab_xz(
            [(a / 2, h - 0.7), (a / 2 + 0.3, h - 0.45), (a / 2 + 0.3, h - 0.25), (a / 2, h - 0.25)], 0.8 * a
        )
        parts.append(piece(corbel, "column", "concrete", "column"))
        one = drawn(rng, style, 0.2, ("H", "I"))
        z = h - 0.25 + 0.1
        parts.append(piece(bar((a / 2 + 0.15, -1.0, z), (a / 2 + 0.15, 1.0, z), one), "beam"))
    if chance(rng, 0.5):
        parts.append(piece(box((2 * a + 0.3, 2 * a + 0.3, 0.25), (0, 0, -0.125)), "foundation", "concrete"))
    return Model(parts)


def _pole(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tapered or stepped pole column (EN 40), pipe column with flanges, or a telescopic shoring prop (EN 1065)."""
    h, r = num(rng, 1.5, 4.5), num(rng, 0.05, 0.12)
    n = few_sides(style, r, 24)
    kind = int(rng.integers(3))
    parts, low = base(0, 0, (5 * r, 5 * r), style, rng)
    if kind == 0:
        parts.append(piece(turned([(1.4 * r, low), (0.6 * r, h)], pick(rng, 8, n)), "column", bundle="column"))
    elif kind == 1:
        parts.append(
            piece(turned([(r, low), (r, h / 2), (0.7 * r, h / 2 + 0.1), (0.7 * r, h)], n), "column", bundle="column")
        )
        parts.append(piece(moved(cylinder(1.8 * r, 0, 0.015, n), at(0, 0, h)), "plate"))
    else:
        r *= 0.45
        parts.append(piece(cylinder(r, low, 0.6 * h, n), "column", bundle="column"))
        parts.append(piece(cylinder(0.8 * r, 0.6 * h, h, n), "column", bundle="column"))
        parts.append(piece(moved(cylinder(1.5 * r, 0, 0.06, n), at(0, 0, 0.6 * h - 0.05)), "nut", "handle"))
        parts.append(
            piece(pipe([(-0.08, 0, 0.6 * h + 0.1), (0.08, 0, 0.6 * h + 0.1)], 0.007, style), "bolt", "fastener")
        )
        parts.append(piece(box((0.13, 0.13, 0.006), (0, 0, h + 0.003)), "plate"))
    return Model([*parts, *(_capped(0, 0, h, 2 * r + 0.1, style, rng) if kind == 0 else [])])


def _built_column(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A welded column: cruciform, double I, box of plates, a T pair; or a tapered portal leg with a haunch."""
    h, a = num(rng, 1.5, 4.0), num(rng, 0.15, 0.35)
    parts, low = base(0, 0, (a + 0.14, a + 0.14), style, rng)
    kind = int(rng.integers(4))
    solids: list[Solid]
    if kind == 0:
        shape = [(a / 2, -0.01), (a / 2, 0.01), (0.01, 0.01), (0.01, a / 2), (-0.01, a / 2), (-0.01, 0.01)]
        shape += [(-x, -y) for x, y in shape]
        solids = [extrude(np.array(shape), low, h)]
    elif kind == 1:
        one = section("I", a, style)
        solids = [moved(extrude(one[0], low, h), at(s * 0.25 * a)) for s in (-1, 1)]
    elif kind == 2:
        t = 0.012
        tall, mid = h - low, (h + low) / 2
        solids = [box((a, t, tall), (0, s * (a - t) / 2, mid)) for s in (-1, 1)]
        solids += [box((t, a - 2 * t, tall), (s * 0.3 * a, 0, mid)) for s in (-1, 1)]
    else:
        t, top = 0.012, 1.8 * a
        solids = [slab_xz([(-a / 2, low), (a / 2, low), (top - a / 2, h), (-a / 2, h)], t)]
        solids.append(box((t, 0.8 * a, h - low), (-a / 2 - t / 2, 0, (h + low) / 2)))
        solids.append(slab_xz([(a / 2, low), (a / 2 + t, low), (top - a / 2 + t, h), (top - a / 2, h)], 0.8 * a))
    parts += [piece(one_, "column", bundle="column") for one_ in ([merge(solids)] if chance(rng, 0.5) else solids)]
    return Model([*parts, *_capped(0, 0, h, a + 0.1, style, rng)])


def _timber_post_frame(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Timber columns in steel shoes with a beam, knee braces and dowels."""
    w, h, a = num(rng, 1.2, 3.0), num(rng, 1.6, 2.6), pick(rng, 0.1, 0.14, 0.2)
    square = section("square", a, style)
    parts: list[Part] = []
    for x in (0.0, w):
        parts.append(piece(box((a + 0.08, a + 0.04, 0.008), (x, 0, 0.004)), "base plate"))
        parts += [piece(box((a, 0.006, 0.25), (x, s * (a / 2 + 0.003), 0.133)), "bracket", bundle="") for s in (-1, 1)]
        parts.append(piece(bar((x, 0, 0.008), (x, 0, h), square), "column", "safety"))
    parts.append(piece(bar((-0.3, 0, h + a / 2), (w + 0.3, 0, h + a / 2), square), "beam", "safety"))
    thin = section("timber", 0.7 * a, style)
    for x, s in ((0.0, 1), (w, -1)):
        parts.append(piece(bar((x + s * a / 2, 0, h - 0.5), (x + s * (a / 2 + 0.5), 0, h), thin), "brace", "safety"))
    return Model(parts)


COLUMNS: tuple[Family, ...] = (
    floor_family("column/laced", _laced),
    floor_family("column/stiffened base", _stiffened, 1.2),
    floor_family("column/concrete", _concrete_column, 0.8, "fitting"),
    floor_family("column/pole", _pole, 1.0, "fitting"),
    floor_family("column/built up", _built_column, 1.0, "fitting"),
    floor_family("column/timber", _timber_post_frame, 0.6, "fitting"),
)
