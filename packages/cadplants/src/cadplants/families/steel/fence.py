"""Fences and gates: palisade, mesh, chain-link, sheet, timber, guards; swing, sliding, boom, turnstile."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.steel.caster import wheel
from cadplants.families.steel.shape import (
    bar,
    base,
    bolted,
    chance_ as chance,
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
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, box, cylinder, dome, ring, rod
from cadplants.transforms import at, spun

__all__ = ["FENCES"]


def _whole(solids: list[Solid], name: str, color: str, rng: np.random.Generator, share: float = 0.65) -> list[Part]:
    """One mesh, or as many as there are pieces."""
    return [piece(one, name, color, name) for one in ([merge(solids)] if chance(rng, share) else solids)]


def _posts(
    xs: list[float], h: float, style: ModelingStyle, rng: np.random.Generator, kinds: tuple[str, ...]
) -> tuple[list[Part], float]:
    """Posts in the ground, on plates or in concrete; and half their width along x."""
    one, foot = section(pick(rng, *kinds), num(rng, 0.045, 0.09), style), int(rng.integers(3))
    parts: list[Part] = []
    for x in xs:
        low = 0.0
        if foot == 0:
            plates, low = base(x, 0, (0.16, 0.16), style, rng)
            parts += plates
        elif foot == 1:
            parts.append(piece(moved(cylinder(0.15, -0.3, 0.0, 10), at(x)), "foundation", "concrete"))
        parts.append(piece(bar((x, 0, low), (x, 0, h), one, (0, 1, 0)), "post", "fence", "fence"))
        if chance(rng, 0.3):
            parts.append(piece(box((0.1, 0.1, 0.01), (x, 0, h + 0.005)), "plate", "fence", "fence"))
    return parts, max(-float(one[0][:, 0].min()), float(one[0][:, 0].max()))


def _mesh(w: float, low: float, high: float, pitch: tuple[float, float], r: float = 0.0025) -> list[Solid]:
    """Welded wires over x from 0 to ``w`` between two heights; at most some dozens each way."""
    up = np.linspace(0.01, w - 0.01, int(np.clip(w / pitch[0], 4, 36)))
    wires = [box((2 * r, 2 * r, high - low), (x, 0, (low + high) / 2)) for x in up]
    levels = np.linspace(low + 0.02, high - 0.02, int(np.clip((high - low) / pitch[1], 3, 24)))
    return [*wires, *(box((w, 2 * r, 2 * r), (w / 2, 2 * r, z)) for z in levels)]


def _palisade(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Palisade (BS 1722-12): pressed pales with pointed, notched or round heads on two angle rails between posts."""
    count, w, h = int(rng.integers(1, 3)), num(rng, 1.5, 2.75), num(rng, 1.5, 2.6)
    parts, half = _posts([k * w for k in range(count + 1)], h - 0.1, style, rng, ("I", "H", "SHS"))
    head, wide = int(rng.integers(3)), 0.065
    tops = {0: [(wide / 2, h - 0.08), (0, h), (-wide / 2, h - 0.08)], 1: [(wide / 2, h), (0, h - 0.06), (-wide / 2, h)]}
    shape = [
        (-wide / 2, 0.05),
        (wide / 2, 0.05),
        *tops.get(head, [(wide / 2, h - 0.03), (0.01, h), (-0.01, h), (-wide / 2, h - 0.03)]),
    ]
    pale, y = slab_xz(shape, 0.003), -0.004 - half
    for k in range(count):
        solids = [
            bar((k * w, -half + 0.0115, z), ((k + 1) * w, -half + 0.0115, z), section("L", 0.05, style))
            for z in (0.3, h - 0.35)
        ]
        solids += [moved(pale, at(x, y)) for x in np.arange(k * w + 0.1, (k + 1) * w - 0.05, 0.15)]
        parts += _whole(solids, "fence", "fence", rng)
    return Model(parts)


def _folded_mesh(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Welded mesh panels with single or double wires, clamped to square posts (EN 10223-7)."""
    count, w, h = int(rng.integers(1, 4)), num(rng, 1.2, 2.5), num(rng, 0.8, 2.4)
    parts, half = _posts([k * w for k in range(count + 1)], h + 0.05, style, rng, ("SHS", "RHS", "CHS"))
    y = -half - 0.008
    for k in range(count):
        solids = [moved(one, at(k * w + 0.005, y)) for one in _mesh(w - 0.01, 0.05, h, (0.06, 0.2))]
        for z in np.linspace(0.25, h - 0.2, int(rng.integers(2, 5))) if chance(rng, 0.6) else ():
            solids.append(box((w - 0.02, 0.006, 0.006), ((k + 0.5) * w, y - 0.005, z)))
        parts += _whole(solids, "fence", "fence", rng, 0.85)
    for k in range(count + 1):
        parts += [piece(box((0.05, 0.02, 0.03), (k * w, y, z)), "clamp", "trim") for z in (0.25, h - 0.2)]
    return Model(parts)


def _chain_link(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Chain-link on round posts with line wires, raking stays and arms with barbed wire (BS 1722-1)."""
    count, w, h = int(rng.integers(1, 3)), num(rng, 1.5, 2.5), num(rng, 1.2, 2.4)
    long, pitch = count * w, num(rng, 0.12, 0.2)
    parts, half = _posts([k * w for k in range(count + 1)], h + 0.1, style, rng, ("CHS", "L", "SHS"))
    strands, y = [], -half - 0.002
    for way in (-1, 1):
        for c in np.arange(-h, long + h, pitch):
            lo, hi = (max(0.0, c), min(long, c + h)) if way > 0 else (max(0.0, c - h), min(long, c))
            if hi - lo > 0.05:
                z = (lo - c, hi - c) if way > 0 else (c - lo, c - hi)
                strands.append(rod((lo, y, 0.04 + z[0]), (hi, y + 0.003 * way, 0.04 + z[1]), 0.002, 4))
    strands += [rod((0, y, z), (long, y, z), 0.003, 5) for z in (0.06, h / 2, h)]
    parts.append(piece(merge(strands), "fence", "fence", "fence"))
    if chance(rng, 0.6):
        for x, s in ((0.0, 1), (long, -1)):
            parts.append(
                piece(
                    pipe([(x + s * half, 0, 0.75 * h), (x + s * 0.6 * h, 0, 0)], 0.019, style),
                    "brace",
                    "fence",
                    "fence",
                )
            )
    if chance(rng, 0.5):
        wires = [
            rod((0, -0.12 * k, h + 0.1 + 0.1 * k), (long, -0.12 * k, h + 0.1 + 0.1 * k), 0.003, 5) for k in (1, 2, 3)
        ]
        parts.append(piece(merge(wires), "fence", "fence", "fence"))
        parts += [
            piece(rod((k * w, 0, h + 0.06), (k * w, -0.37, h + 0.41), 0.018, 8), "post", "fence", "fence")
            for k in range(count + 1)
        ]
    return Model(parts)


def _sheeted(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A screen of trapezoidal sheet, boards, slats or precast planks between posts."""
    count, w, h = int(rng.integers(1, 4)), num(rng, 1.2, 2.4), num(rng, 1.0, 2.4)
    kind = pick(rng, "trapeze", "upright", "level", "louvre", "precast")
    kinds = {"precast": ("H",), "upright": ("timber", "SHS"), "level": ("timber", "H")}.get(kind, ("SHS", "H", "U"))
    parts, half = _posts([k * w for k in range(count + 1)], h + 0.05, style, rng, kinds)
    color = {"precast": "concrete", "upright": "safety", "level": "safety"}.get(kind, "fence")
    for k in range(count):
        a, b = k * w, (k + 1) * w
        solids: list[Solid] = []
        if kind == "trapeze":
            xs = np.arange(a, b + 0.001, (w) / max(6, int(w / 0.06)))
            line = np.column_stack([xs, -half - 0.02 - 0.035 * ((np.arange(len(xs)) // 2) % 2)])
            solids.append(extrude(ribbon(line, 0.0015), 0.05, h))
            solids += [box((w, 0.03, 0.04), ((a + b) / 2, -half - 0.003, z)) for z in (0.3, h - 0.2)]
        elif kind == "upright":
            solids += [
                box((0.1, 0.022, h - 0.1), (x, -half - 0.041, h / 2)) for x in np.arange(a + 0.06, b - 0.03, 0.12)
            ]
            solids += [box((w, 0.05, 0.08), ((a + b) / 2, -half - 0.01, z)) for z in (0.3, h - 0.3)]
        elif kind == "level":
            solids += [box((w, 0.03, 0.14), ((a + b) / 2, -half - 0.015, z)) for z in np.arange(0.15, h, 0.16)]
        elif kind == "louvre":
            blade = [
                moved(box((w - 2 * half, 0.09, 0.003)), at((a + b) / 2, 0, z) @ spun("x", 0.7))
                for z in np.arange(0.12, h, 0.09)
            ]
            solids += blade
        else:
            solids += [box((w - 0.02, 0.04, 0.3), ((a + b) / 2, 0, z + 0.15)) for z in np.arange(0.0, h - 0.25, 0.301)]
        parts += _whole(solids, "fence", color, rng)
    return Model(parts)


def _guard(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A machine guard (EN ISO 14120): framed panels of mesh, sheet or clear plate off the floor, maybe with a door."""
    count, h, low = int(rng.integers(1, 5)), num(rng, 1.2, 2.2), num(rng, 0.1, 0.2)
    ws = [num(rng, 0.5, 1.5) for _ in range(count)]
    xs = [0.0, *(float(x) for x in np.cumsum(ws))]
    parts, half = _posts(xs, h, style, rng, ("SHS", "RHS"))
    tube, fill = section(pick(rng, "SHS", "L", "CHS"), 0.025, style), pick(rng, "mesh", "mesh", "sheet", "clear")
    door = int(rng.integers(count)) if chance(rng, 0.5) else -1
    for k, w in enumerate(ws):
        a, b = xs[k] + half, xs[k + 1] - half
        solids = [bar((a, 0, z), (b, 0, z), tube) for z in (low, h - 0.03)]
        solids += [bar((x, 0, low), (x, 0, h - 0.03), tube, (0, 1, 0)) for x in (a + 0.013, b - 0.013)]
        if fill == "mesh":
            solids += [moved(one, at(a)) for one in _mesh(w - 2 * half, low, h - 0.03, (0.05, 0.1), 0.0015)]
        else:
            solids.append(
                box((b - a, 0.002 if fill == "sheet" else 0.006, h - low - 0.03), ((a + b) / 2, 0, (h + low) / 2))
            )
        name = "gate" if k == door else "fence"
        parts += _whole(solids, name, "safety" if fill != "clear" else "dial", rng, 0.85)
        if k == door:
            parts.append(piece(box((0.03, 0.06, 0.12), (b - 0.02, -0.04, 1.0)), "bracket", "handle"))
            parts += [
                piece(moved(cylinder(0.012, 0, 0.07, 8), at(a, -0.03, z)), "bracket") for z in (low + 0.2, h - 0.3)
            ]
    return Model(parts)


def _barrier(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Movable barriers: crowd control hoops with bars, or site fence panels in rubber or concrete feet."""
    site, count = chance(rng, 0.5), int(rng.integers(1, 4))
    w, h = (num(rng, 2.0, 3.0), num(rng, 1.8, 2.1)) if site else (num(rng, 1.5, 2.3), 1.1)
    r, parts = num(rng, 0.014, 0.021), []
    for k in range(count):
        a, b, low = k * (w + 0.06), k * (w + 0.06) + w, 0.1 if site else 0.18
        frame = [(a, 0, 0.02 if site else low), (a, 0, h), (b, 0, h), (b, 0, 0.02 if site else low)]
        solids = [pipe(frame, r, style, 0.0 if site else 0.15), pipe([(a, 0, low), (b, 0, low)], r, style)]
        if site:
            solids += [moved(one, at(a)) for one in _mesh(w, low, h, (0.1, 0.25))]
        else:
            solids += [rod((x, 0, low), (x, 0, h), 0.006, 6) for x in np.arange(a + 0.12, b - 0.05, 0.12)]
            solids += [
                pipe([(x, -0.25, 0.01), (x, -0.2, 0.1), (x, 0, low), (x, 0.2, 0.1), (x, 0.25, 0.01)], 0.012, style)
                for x in (a + 0.3, b - 0.3)
            ]
        parts += _whole(solids, "fence", "fence", rng, 0.9)
        if site:
            parts += [
                piece(box((0.25, 0.6, 0.12), (x, 0, 0.06)), pick(rng, "base plate", "foundation"), "rubber")
                for x in (a, b)
            ]
    return Model(parts)


# --- gates ---


def _leaf(a: float, b: float, low: float, high: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """A framed leaf between two x: tubes or angles, filled with bars, mesh, sheet, slats or a diagonal."""
    one, kind = section(pick(rng, "SHS", "CHS", "RHS", "L"), num(rng, 0.035, 0.06), style), int(rng.integers(5))
    solids = [bar((a, 0, z), (b, 0, z), one) for z in (low, high)]
    solids += [bar((x, 0, low), (x, 0, high), one, (0, 1, 0)) for x in (a, b)]
    w, h = b - a, high - low
    if kind == 0:
        solids += [rod((x, 0, low), (x, 0, high), 0.008, 6) for x in np.arange(a + 0.12, b - 0.05, 0.12)]
    elif kind == 1:
        solids += [moved(m, at(a)) for m in _mesh(w, low, high, (0.06, 0.15))]
    elif kind == 2:
        solids.append(box((w, 0.003, h), ((a + b) / 2, 0.01, (low + high) / 2)))
    elif kind == 3:
        solids += [bar((a, 0, z), (b, 0, z), section("CHS", 0.03, style)) for z in np.linspace(low, high, 6)[1:-1]]
    if kind in (1, 3, 4):
        solids.append(bar((a, 0.0, low), (b, 0.0, high), section("flat" if kind == 1 else "CHS", 0.03, style)))
    return solids


def _swing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A swing gate of one or two leaves, open or shut, with stout posts, hinges, drop bolt and latch."""
    leaves, w, h = int(rng.integers(1, 3)), num(rng, 0.8, 2.0), num(rng, 0.9, 2.2)
    total, low = leaves * w + 0.02 * (leaves - 1), num(rng, 0.04, 0.12)
    parts, half = _posts([0.0, total + 0.18], h + 0.1, style, rng, ("SHS", "SHS", "H", "CHS"))
    for k in range(leaves):
        swing, mirror = pick(rng, 0.0, 0.0, num(rng, 0.2, 1.5)), k == 1
        solids = _leaf(0.06, w, low, h, style, rng)
        pin = [moved(cylinder(0.012, -0.05, 0.07, 8), at(0.02, 0, z)) for z in (low + 0.2, h - 0.25)]
        pin += [box((0.06, 0.012, 0.03), (0.02, 0, z)) for z in (low + 0.2, h - 0.25)]
        pose = at(half - 0.01) @ spun("z", swing)
        if mirror:
            pose = at(total + 0.18 - half + 0.01) @ np.diag([-1.0, 1.0, 1.0, 1.0]) @ spun("z", swing)
        parts += [piece(moved(p.solid, pose), "gate", "gate", "gate") for p in _whole(solids, "gate", "gate", rng)]
        parts.append(piece(moved(merge(pin), pose), "bracket", "steel"))
        if chance(rng, 0.6):
            parts.append(
                piece(
                    moved(box((0.12, 0.05, 0.16), (w - 0.05, 0, 1.0 if h > 1.2 else 0.6 * h)), pose),
                    "bracket",
                    "handle",
                )
            )
        if chance(rng, 0.4):
            parts.append(
                piece(moved(rod((w - 0.04, -0.04, 0.0), (w - 0.04, -0.04, 0.5), 0.008, 6), pose), "bolt", "fastener")
            )
    return Model(parts)


def _sliding(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sliding gate: a leaf on grooved wheels and a floor rail, or cantilevered on roller boxes, with guide portal."""
    w, h, r = num(rng, 1.8, 4.0), num(rng, 1.0, 2.0), num(rng, 0.04, 0.07)
    low = 1.9 * r + 0.03
    parts = _whole(_leaf(0, w, low + 0.03, h, style, rng), "gate", "gate", rng)
    if chance(rng, 0.6):
        parts.append(piece(bar((-0.5, 0, 0.01), (w + 0.8 * w, 0, 0.01), section("CHS", 0.02, style)), "beam"))
        for x in (0.15, w - 0.15):
            parts += [
                piece(moved(m, at(x, 0, 0.02 + 0.78 * r)), "caster", c) for m, c in wheel("groove", r, 0.6 * r, style)
            ]
            parts.append(
                piece(box((1.6 * r, 0.5 * r + 0.02, 0.3 * r + 0.04), (x, 0, low + 0.01 - 0.15 * r)), "bracket")
            )
    else:
        parts.append(
            piece(
                bar((-0.3 * w, 0, low - 0.02), (w, 0, low - 0.02), section("RHS", 0.08, style)), "gate", "gate", "gate"
            )
        )
        for x in (-0.25 * w, 0.2):
            parts.append(piece(box((0.3, 0.16, low - 0.06), (x, 0, (low - 0.06) / 2)), "foundation", "concrete"))
    post = section("SHS", 0.08, style)
    for s in (-1, 1):
        parts.append(piece(bar((0.3, s * 0.14, 0), (0.3, s * 0.14, h + 0.12), post), "post", "fence"))
        parts.append(piece(moved(cylinder(0.03, h - 0.05, h + 0.12, 12), at(0.3, s * 0.065)), "caster", "rubber"))
    parts.append(piece(box((0.08, 0.36, 0.08), (0.3, 0, h + 0.16)), "beam", "fence"))
    parts.append(piece(bar((w + 0.09, 0, 0), (w + 0.09, 0, h + 0.1), section("SHS", 0.12, style)), "post", "fence"))
    return Model(parts)


def _boom(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A boom barrier: a housing on a plinth, an arm with or without skirt, a fork post to rest on; up or down."""
    long, h, lift = num(rng, 2.0, 4.5), num(rng, 0.85, 1.05), pick(rng, 0.0, 0.0, num(rng, 0.3, 1.4))
    parts = [piece(box((0.45, 0.45, 0.1), (0, 0, 0.05)), "foundation", "concrete")]
    parts.append(
        piece(box((0.32, 0.28, h + 0.1), (0, 0, 0.1 + (h + 0.1) / 2)), pick(rng, "control panel", "post"), "safety")
    )
    arm = bar((-0.3, 0, 0), (long, 0, 0), section(pick(rng, "CHS", "RHS", "SHS"), 0.08, style))
    solids = [arm, along("y", cylinder(0.1, -0.04, 0.04, few_sides(style, 0.1)))]
    if chance(rng, 0.4):
        solids += [rod((x, 0, -0.03), (x, 0, -0.6), 0.006, 6) for x in np.arange(0.3, long, 0.15)]
        solids.append(rod((0.3, 0, -0.6), (long - 0.05, 0, -0.6), 0.008, 6))
    if chance(rng, 0.4):
        solids.append(box((0.2, 0.12, 0.2), (-0.35, 0, 0)))
    pose = at(0.05, -0.18, h) @ spun("y", -lift)
    parts += [piece(moved(p.solid, pose), "gate", "gate", "gate") for p in _whole(solids, "gate", "gate", rng)]
    if lift == 0.0:
        x = long - 0.1
        parts.append(piece(box((0.08, 0.08, h - 0.045), (x, -0.18, (h - 0.045) / 2)), "post", "safety"))
    return Model(parts)


def _turnstile(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A turnstile: full height with combs in a cage, waist high with three arms, or a kissing gate of tubes."""
    parts: list[Part] = []
    if chance(rng, 0.6):
        h, r = num(rng, 1.9, 2.3), num(rng, 0.55, 0.7)
        n = few_sides(style, 0.05, 14)
        solids = [cylinder(0.05, 0.0, h, n)]
        wings = int(rng.integers(3, 5))
        for k in range(wings):
            solids += [
                moved(rod((0.04, 0, z), (r, 0, z), 0.018, 8), spun("z", 2 * np.pi * k / wings))
                for z in np.linspace(0.25, h - 0.2, 9)
            ]
        parts += _whole(solids, "gate", "gate", rng)
        a = np.linspace(0.5, 2.6, 9)
        cage = [
            rod(
                (1.06 * r * np.cos(t), 1.06 * r * np.sin(t), 0),
                (1.06 * r * np.cos(t), 1.06 * r * np.sin(t), h),
                0.014,
                8,
            )
            for t in a
        ]
        parts += _whole(cage, "fence", "fence", rng)
        parts.append(
            piece(
                slab_xy([(-1.1 * r, -0.2), (1.1 * r, -0.2), (1.1 * r, 1.15 * r), (-1.1 * r, 1.15 * r)], h, h + 0.08),
                "plate",
                "fence",
            )
        )
        parts += [piece(box((0.08, 0.08, h), (s * 1.05 * r, -0.15, h / 2)), "post", "fence") for s in (-1, 1)]
        return Model(parts)
    parts.append(piece(box((0.25, 0.9, 0.98), (0, 0, 0.49)), pick(rng, "post", "gate"), "clamp"))
    hub = along("x", dome(0.08, 0.06, 0.0, few_sides(style, 0.08, 16)), 0.125, 0, 0.85)
    arms = [
        pipe([(0.15, 0, 0.85), (0.25, 0.5 * np.cos(t), 0.85 + 0.45 * np.sin(t))], 0.019, style)
        for t in (np.pi / 2 + 2.094, np.pi / 2 + 4.189)
    ]
    arms.append(pipe([(0.15, 0, 0.85), (0.65, 0, 0.87)], 0.019, style))
    parts += _whole([hub, *arms], "gate", "trim", rng)
    parts.append(piece(box((0.04, 0.9, 0.98), (0.8, 0, 0.49)), "fence", "clamp"))
    return Model(parts)


def _safety_gate(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A self-closing gate in a railing (ISO 14122-3): a bow of tube or a framed leaf on spring hinges between posts."""
    w, h, r = num(rng, 0.6, 1.1), num(rng, 0.95, 1.1), 0.021
    xs = [-num(rng, 0.5, 1.2), 0.0, w + 0.08, w + 0.08 + num(rng, 0.5, 1.2)]
    parts: list[Part] = []
    for x in xs:
        plates, low = base(x, 0, (0.1, 0.1), style, rng)
        parts += [*plates, piece(pipe([(x, 0, low), (x, 0, h)], r, style), "post", "safety")]
    for a, b in ((xs[0], xs[1]), (xs[2], xs[3])):
        parts += [piece(pipe([(a, 0, z), (b, 0, z)], r, style), "railing", "safety") for z in (0.5 * h, h)]
    bow = [(0.07, 0, h - 0.02), (w, 0, h - 0.02), (w, 0, 0.45 * h), (0.07, 0, 0.45 * h)]
    solids = [
        pipe([*bow, (0.07, 0, h - 0.036)], 0.016, style),
        pipe([(0.07, 0, 0.7 * h), (w, 0, 0.7 * h)], 0.012, style),
    ]
    if chance(rng, 0.3):
        solids.append(box((w - 0.1, 0.004, 0.4 * h), (w / 2 + 0.03, 0, 0.7 * h)))
    swing = pick(rng, 0.0, num(rng, 0.3, 1.4))
    pose = spun("z", swing)
    parts += [piece(moved(p.solid, pose), "gate", "gate", "gate") for p in _whole(solids, "gate", "gate", rng)]
    for z in (0.5 * h, h - 0.06):
        hinge = merge([ring(r, 1.5 * r, z - 0.03, z + 0.03, 12), moved(box((0.06, 0.012, 0.05), (0.05, 0, z)), pose)])
        parts.append(piece(hinge, "bracket", "clamp"))
    stop = [at(w + 0.08 - r - 0.001, -0.012, 0.7 * h) @ spun("y", -np.pi / 2)]
    return Model([*parts, *bolted(stop, 0.008, style, 0.005)])


FENCES: tuple[Family, ...] = (
    floor_family("fence/palisade", _palisade),
    floor_family("fence/welded mesh", _folded_mesh, 1.2),
    floor_family("fence/chain link", _chain_link),
    floor_family("fence/screen", _sheeted),
    floor_family("fence/guard", _guard, 1.2, "fitting"),
    floor_family("fence/movable", _barrier, 0.8, "fitting"),
    floor_family("gate/swing", _swing, 1.3, "fitting"),
    floor_family("gate/sliding", _sliding, 1.0, "fitting"),
    floor_family("gate/boom", _boom, 0.8, "fitting"),
    floor_family("gate/turnstile", _turnstile, 0.7, "fitting"),
    floor_family("gate/railing", _safety_gate, 1.0, "fitting"),
)
