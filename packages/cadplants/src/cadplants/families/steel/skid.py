"""Skid frames: welded, folded, caged, palletised; with lifting eyes, fork pockets, drip trays, posts and feet."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    Section,
    bar,
    bolted,
    chance_ as chance,
    drawn,
    few_sides,
    floor_family,
    lug,
    num,
    piece,
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    slab_yz,
    span_of,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, lattice, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, ring, turned
from cadplants.transforms import at, spun

__all__ = ["SKIDS"]


def _frame(a: float, b: float, one: Section, ties: int, z: float) -> tuple[list[Solid], float]:
    """Two runners along x, ends and cross members between them, from ``z`` up; and the height of their top [m]."""
    x0, x1, y0, y1 = span_of(one)
    level, half = z - y0, (x1 - x0) / 2
    outer = bar((a / 2, b / 2, level), (-a / 2, b / 2, level), one)
    # The other runner is its mirror image, so that channels turn their backs outward on both sides.
    runners = [outer, moved(outer, np.diag([1.0, -1.0, 1.0, 1.0]))]
    reach = b / 2 - half
    for x in np.linspace(-a / 2 + half, a / 2 - half, ties):
        runners.append(bar((x, -reach, level), (x, reach, level), one))
    return runners, z + y1 - y0


def _deck(a: float, b: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What lies on a frame: nothing, a plate, a plate with openings, a grating, a chequered plate."""
    kind = int(rng.integers(5))
    if kind == 0:
        return []
    if kind == 3:
        nx, ny = int(np.clip(a / 0.1, 4, 14)), int(np.clip(b / 0.04, 5, 20))
        xs = (
            np.sort(np.concatenate([np.linspace(0, a - 0.006, nx + 1), np.linspace(0, a - 0.006, nx + 1) + 0.006]))
            - a / 2
        )
        ys = (
            np.sort(np.concatenate([np.linspace(0, b - 0.004, ny + 1), np.linspace(0, b - 0.004, ny + 1) + 0.004]))
            - b / 2
        )
        filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
        filled[::2], filled[:, ::2] = True, True
        return [piece(lattice(xs, ys, filled, z, z + 0.03), "grating", "clamp")]
    holes = (
        tuple(circle(num(rng, 0.03, 0.08), few_sides(style, 0.08), (s * 0.25 * a, 0.0)) for s in (-1, 1))
        if kind == 2
        else ()
    )
    name = pick(rng, "plate", "skid frame")
    return [
        piece(
            slab_xy(rounded_rectangle(a, b, 0.0), z, z + 0.008, holes),
            name,
            "steel",
            "skid frame" if name != "plate" else "",
        )
    ]


def _lugs(a: float, b: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Lifting eyes on top of the corners, or trunnions of pipe at the sides, or none."""
    kind, size = int(rng.integers(3)), num(rng, 0.06, 0.11)
    corners = [(sx, sy) for sx in (-1, 1) for sy in (-1, 1)]
    if kind == 0:
        return []
    if kind == 1:
        return [
            piece(moved(lug(style, size, 0.015), at(sx * (a / 2 - 0.09), sy * b / 2, z)), "lifting lug")
            for sx, sy in corners
        ]
    n = few_sides(style, 0.04, 16)
    stub = merge([cylinder(0.04, 0, 0.1, n), ring(0.03, 0.06, 0.1, 0.112, n)])
    return [
        piece(along("y" if sy > 0 else "-y", stub, sx * 0.35 * a, sy * b / 2, z - 0.08), "lifting lug")
        for sx, sy in corners
    ]


def _payload(
    a: float, b: float, z: float, style: ModelingStyle, rng: np.random.Generator, decked: bool = True
) -> list[Part]:
    """Steel that stands on a skid: a panel stand, an upright frame, plinths, a railing bow; or nothing."""
    kind = int(rng.integers(5)) if decked else pick(rng, 0, 3)
    if kind == 0:
        return []
    one = drawn(rng, style, num(rng, 0.05, 0.08), ("SHS", "U", "L", "CHS", "strut"))
    h = num(rng, 0.6, 1.8)
    if kind == 1:
        x = 0.35 * a
        parts = [piece(bar((x, y, z), (x, y, z + h), one), "post") for y in (-0.3 * b, 0.3 * b)]
        return [
            *parts,
            piece(box((0.004, 0.7 * b, 0.5 * h), (x - span_of(one)[2] + 0.002, 0, z + 0.7 * h)), "plate", "clamp"),
        ]
    if kind == 2:
        xs, ys = (-0.44 * a, 0.44 * a), (-0.42 * b, 0.42 * b)
        parts = [piece(bar((x, y, z), (x, y, z + h), one), "column") for x in xs for y in ys]
        level = z + h + span_of(one)[3]
        parts += [piece(bar((xs[0], y, level), (xs[1], y, level), one), "beam") for y in ys]
        parts += [piece(bar((x, ys[0], level), (x, ys[1], level), one), "beam") for x in xs]
        if chance(rng, 0.5):
            parts += [piece(bar((xs[0], y, z), (xs[1], y, z + h), section("L", 0.04, style)), "brace") for y in ys]
        return parts
    if kind == 3:
        level, xs = z - span_of(one)[2], (-0.2 * a, 0.2 * a)
        return [piece(bar((x, -0.5 * b, level), (x, 0.5 * b, level), one), "beam") for x in xs]
    path = [
        (-0.4 * a, -0.45 * b, z),
        (-0.4 * a, -0.45 * b, z + h),
        (0.4 * a, -0.45 * b, z + h),
        (0.4 * a, -0.45 * b, z),
    ]
    return [piece(pipe(path, 0.021, style, 0.12), "railing", "safety")]


def _welded(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A skid of welded I, channel or hollow sections with cross members and sledge ends (common package practice)."""
    a, b = num(rng, 1.0, 4.0), num(rng, 0.6, 2.0)
    one = drawn(rng, style, num(rng, 0.08, 0.22), ("H", "I", "U", "RHS", "SHS", "IPN"))
    solids, top = _frame(a, b, one, int(rng.integers(2, 6)), 0.0)
    if chance(rng, 0.35):
        toe = [(0, 0.0), (0.25, 0.6 * top), (0.25, top), (0, top)]
        for s in (-1, 1):
            for sy in (-1, 1):
                nose = moved(slab_xz(toe, 0.06), at(s * a / 2, sy * b / 2) @ spun("z", 0 if s > 0 else np.pi))
                solids.append(nose)
    if chance(rng, 0.3):
        parts = [piece(merge(solids), "skid frame", bundle="skid frame")]
    else:
        parts = [piece(one_, "skid frame", bundle="skid frame") for one_ in solids]
    deck = _deck(a, b, top, style, rng)
    high = max([top, *(float(p.solid.vertices[:, 2].max()) for p in deck)])
    parts += [*deck, *_lugs(a, b, top, style, rng), *_payload(a, b, high, style, rng, bool(deck))]
    if chance(rng, 0.4):
        spots = [
            at(sx * (a / 2 - 0.08), sy * (b / 2 + 0.06 - span_of(one)[0]), 0.012) for sx in (-1, 1) for sy in (-1, 1)
        ]
        parts += [piece(moved(box((0.12, 0.12, 0.012), (0, 0, -0.006)), spot), "base plate") for spot in spots]
        parts += bolted(spots, 0.016, style, 0.012)
    return Model(parts)


def _forked(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A channel frame with forklift pockets (hollow sections through the runners) and a deck."""
    a, b = num(rng, 0.8, 2.4), num(rng, 0.7, 1.5)
    h = num(rng, 0.12, 0.2)
    one = section(pick(rng, "U", "RHS"), h, style)
    runners, top = _frame(a, b, one, 2, 0.0)
    pocket_h, pocket_w = 0.6 * h, pick(rng, 0.15, 0.2)
    pocket = rounded_rectangle(pocket_w, pocket_h, 0.0)
    hole = (rounded_rectangle(pocket_w - 0.016, pocket_h - 0.016, 0.0),)
    reach, apart = b / 2 - span_of(one)[0] + 0.01, min(0.28 * a, 0.45)
    solids = [*runners, *(bar((x, -reach, h / 2), (x, reach, h / 2), (pocket, hole)) for x in (-apart, apart))]
    parts = [piece(one_, "skid frame", bundle="skid frame") for one_ in solids]
    deck = _deck(a, b, top, style, rng)
    high = max([top, *(float(p.solid.vertices[:, 2].max()) for p in deck)])
    return Model([*parts, *deck, *_payload(a, b, high, style, rng, bool(deck))])


def _cage(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A frame of a box: base of tubes, corner columns, top rails, braces; or with ISO 1161 corners."""
    a, b, h = num(rng, 0.6, 3.0), num(rng, 0.5, 1.6), num(rng, 0.6, 2.2)
    iso = chance(rng, 0.4)
    size = num(rng, 0.06, 0.12)
    one = drawn(rng, style, size, ("SHS", "SHS", "L", "U") if not iso else ("SHS",))
    half = size / 2
    c = 0.162 if iso else 0.0
    parts: list[Part] = []
    xs, ys = (-a / 2, a / 2), (-b / 2, b / 2)
    low, high = (c / 2, h - c / 2) if iso else (half, h - half)
    for x in xs:
        for y in ys:
            ends = (c, h - c) if iso else (2 * half, h - 2 * half)
            parts.append(piece(bar((x, y, ends[0]), (x, y, ends[1]), one), "column"))
            if iso:
                for z in (c / 2, h - c / 2):
                    casting = [box((c, c, c), (x, y, z))]
                    casting.append(box((0.08, c + 0.004, 0.05), (x, y, z)))
                    parts.append(piece(merge(casting), "lifting lug" if z > c else "skid frame", "clamp"))
    g = c / 2 if iso else 0.0
    for z, name in ((low, "skid frame"), (high, "beam")):
        parts += [piece(bar((xs[0] + g, y, z), (xs[1] - g, y, z), one), name) for y in ys]
        parts += [piece(bar((x, ys[0] + max(g, half), z), (x, ys[1] - max(g, half), z), one), name) for x in xs]
    for x in np.linspace(xs[0], xs[1], int(rng.integers(2, 5)))[1:-1]:
        parts.append(piece(bar((x, ys[0] + half, low), (x, ys[1] - half, low), one), "skid frame"))
    if chance(rng, 0.5):
        thin = section(pick(rng, "flat", "L", "CHS"), 0.04, style)
        parts += [piece(bar((xs[0] + half, y, low + half), (xs[1] - half, y, high - half), thin), "brace") for y in ys]
    if chance(rng, 0.4):
        z = low + half
        parts.append(piece(box((a - size, b - size, 0.006), (0, 0, z - 0.004)), "plate", "clamp"))
    return Model(parts)


def _tray(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A drip tray as a base: a folded pan on feet or runners with a grating or bearers in it and a drain."""
    a, b, deep = num(rng, 0.6, 2.4), num(rng, 0.5, 1.4), num(rng, 0.06, 0.25)
    low, t = num(rng, 0.05, 0.15), 0.004
    lip = ribbon(
        [
            (-b / 2 - 0.02, deep - 0.02),
            (-b / 2, deep),
            (-b / 2, 0),
            (b / 2, 0),
            (b / 2, deep),
            (b / 2 + 0.02, deep - 0.02),
        ],
        t,
        0.01,
        2,
    )
    solids = [moved(slab_yz(lip, a, 0.0), at(0, 0, low))]
    solids += [box((t, b + t, deep), (s * (a / 2 + t / 2), 0, low + deep / 2)) for s in (-1, 1)]
    parts = [piece(merge(solids), "skid frame", bundle="skid frame")]
    if chance(rng, 0.5):
        parts += [
            piece(box((0.06, 0.06, low), (sx * 0.42 * a, sy * 0.4 * b, low / 2 - t / 2)), "post", bundle="")
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
    else:
        runner = box((a, 0.06, low - t / 2), (0, 0, (low - t / 2) / 2))
        parts += [piece(moved(runner, at(0, s * 0.38 * b)), "skid frame", bundle="skid frame") for s in (-1, 1)]
    parts += [
        piece(box((0.05, b - t, deep - 0.03), (x, 0, low + (deep - 0.03) / 2)), "beam")
        for x in np.linspace(-0.35 * a, 0.35 * a, 3)
    ]
    parts += [p for p in _deck(a - 0.03, b - 0.03, low + deep - 0.03, style, rng) if p.name != "skid frame"]
    return Model(parts)


def _pallet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pallet: timber (EN 13698-1), steel with a folded deck, or plastic with nine feet."""
    a, b = pick(rng, (1.2, 0.8), (1.2, 1.0), (0.8, 0.6), (1.1, 1.1))
    kind = int(rng.integers(3))
    solids: list[Solid] = []
    color = "safety" if kind == 0 else "clamp" if kind == 1 else "motor"
    if kind == 0:
        wide = pick(rng, 0.1, 0.145)
        ys = np.linspace(-b / 2 + wide / 2, b / 2 - wide / 2, 3)
        solids += [box((a, 0.1, 0.022), (0, y, 0.011)) for y in ys]
        solids += [box((0.145, 0.1, 0.078), (x, y, 0.061)) for x in (-a / 2 + 0.0725, 0, a / 2 - 0.0725) for y in ys]
        solids += [box((0.145, b, 0.022), (x, 0, 0.111)) for x in (-a / 2 + 0.0725, 0, a / 2 - 0.0725)]
        solids += [box((a, wide, 0.022), (0, y, 0.133)) for y in np.linspace(-b / 2 + wide / 2, b / 2 - wide / 2, 5)]
        top = 0.144
    elif kind == 1:
        hat = ribbon([(-0.09, 0.1), (-0.05, 0.1), (-0.05, 0.0), (0.05, 0.0), (0.05, 0.1), (0.09, 0.1)], 0.003)
        solids += [moved(slab_yz(hat, a), at(0, y, 0.0015)) for y in (-b / 2 + 0.09, 0, b / 2 - 0.09)]
        solids.append(box((a, b, 0.003), (0, 0, 0.1045)))
        top = 0.106
    else:
        foot = turned([(0.06, 0), (0.075, 0.11)], pick(rng, 4, 12), np.pi / 4)
        solids += [moved(foot, at(x, y)) for x in (-0.42 * a, 0, 0.42 * a) for y in (-0.4 * b, 0, 0.4 * b)]
        solids.append(slab_xy(rounded_rectangle(a, b, 0.04, 3), 0.11, 0.15))
        top = 0.15
    joined = chance(rng, 0.4)
    parts = (
        [piece(merge(solids), "skid frame", color)]
        if joined
        else [piece(s, "skid frame", color, "skid frame") for s in solids]
    )
    return Model([*parts, *_payload(0.9 * a, 0.9 * b, top, style, rng)])


def _folded(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A base of one sheet: a bent channel plate with flanges, holes and slots, on rubber feet (small units)."""
    a, b, h, t = num(rng, 0.4, 1.6), num(rng, 0.25, 0.7), num(rng, 0.05, 0.12), num(rng, 0.003, 0.008)
    foot = num(rng, 0.02, 0.05)
    line = [(b / 2 - foot, 0), (b / 2, 0), (b / 2, h), (-b / 2, h), (-b / 2, 0), (-b / 2 + foot, 0)]
    outward = chance(rng, 0.5)
    if outward:
        line = [(b / 2 + foot, 0), (b / 2, 0), (b / 2, h), (-b / 2, h), (-b / 2, 0), (-b / 2 - foot, 0)]
    low = pick(rng, 0.0, 0.025, 0.06) + t / 2
    parts = [piece(moved(slab_yz(ribbon(line, t, 0.012, 2), a), at(0, 0, low)), "skid frame", bundle="skid frame")]
    for s in (-1, 1):
        parts.append(
            piece(
                box((0.004, b - 2 * t, h - t), (s * (a / 2 - 0.03), 0, low + h / 2)), "skid frame", bundle="skid frame"
            )
        )
    y = b / 2 + (foot / 2 if outward else -foot / 2)
    for sx in (-1, 1):
        for sy in (-1, 1):
            if low > 0.02:
                puck = turned([(0.02, 0), (0.024, 0.3 * low), (0.016, low - t / 2)], few_sides(style, 0.02, 14))
                parts.append(piece(moved(puck, at(sx * 0.42 * a, sy * y)), "base plate", "rubber"))
    for x in (-0.25 * a, 0.2 * a):
        parts.append(piece(box((0.15 * a, 0.5 * b, 0.03), (x, 0, low + h + t / 2 + 0.015)), "plate", "steel"))
    return Model(parts)


def _sledge(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sledge: runners of pipe with mitred ends or of timber, cross pipes, a deck and a tow bar (field units)."""
    a, b, r = num(rng, 1.2, 4.0), num(rng, 0.8, 1.8), num(rng, 0.05, 0.11)
    parts: list[Part] = []
    timber = chance(rng, 0.3)
    for s in (-1, 1):
        if timber:
            toe = [
                (-a / 2, 0.6 * r),
                (-a / 2 + 0.2, 0),
                (a / 2 - 0.2, 0),
                (a / 2, 0.6 * r),
                (a / 2, 2 * r),
                (-a / 2, 2 * r),
            ]
            runner = slab_xz(toe, 1.6 * r, s * b / 2)
        else:
            path = [
                (-a / 2 - 0.25, s * b / 2, r + 0.25),
                (-a / 2, s * b / 2, r),
                (a / 2, s * b / 2, r),
                (a / 2 + 0.25, s * b / 2, r + 0.25),
            ]
            runner = pipe(path, r, style, 0.15, 0.1 * r)
        parts.append(piece(runner, "skid frame", "safety" if timber else "steel", "skid frame"))
    tie = section("timber" if timber else "CHS", 1.4 * r, style)
    for x in np.linspace(-0.45 * a, 0.45 * a, int(rng.integers(3, 6))):
        z = 2 * r + 0.7 * r if timber else r
        reach = b / 2 + (0.1 if timber else -0.9 * r)
        parts.append(
            piece(bar((x, -reach, z), (x, reach, z), tie), "skid frame", "safety" if timber else "steel", "skid frame")
        )
    if not timber:
        parts.append(
            piece(
                pipe([(a / 2 + 0.2, -b / 2, r + 0.2), (a / 2 + 0.2, b / 2, r + 0.2)], 0.7 * r, style),
                "skid frame",
                bundle="skid frame",
            )
        )
    top = 3.4 * r if timber else 2 * r
    deck = _deck(0.95 * a, b, top, style, rng)
    high = max([top, *(float(p.solid.vertices[:, 2].max()) for p in deck)])
    return Model([*parts, *deck, *_payload(0.9 * a, b, high, style, rng, bool(deck))])


def _table(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small equipment frame or machine table: legs with feet, rails, a top plate, shelves, knee or cross braces."""
    a, b, h = num(rng, 0.35, 1.6), num(rng, 0.3, 0.9), num(rng, 0.3, 1.1)
    one = drawn(rng, style, num(rng, 0.03, 0.07), ("SHS", "SHS", "L", "CHS", "U"))
    half, foot = float(np.ptp(one[0][:, 1])) / 2, pick(rng, 0.0, 0.05)
    parts: list[Part] = []
    for sx in (-1, 1):
        for sy in (-1, 1):
            x, y = sx * a / 2, sy * b / 2
            parts.append(piece(bar((x, y, foot or 0.008), (x, y, h), one), "column"))
            n = few_sides(style, 0.03, 16)
            levelling = [(0.03, 0), (0.03, 0.008), (0.009, 0.016), (0.009, 0.042), (half, 0.042), (half, 0.05)]
            if foot:
                parts.append(piece(moved(turned(levelling, n), at(x, y)), "base plate", "trim"))
                parts.append(
                    piece(moved(cylinder(0.007, 0.01, foot + 0.01, 8), at(x, y)), "stud", "fastener", fine=True)
                )
            else:
                parts.append(piece(box((2 * half + 0.06, 2 * half + 0.06, 0.008), (x, y, 0.004)), "base plate"))
    for z in (h - half, *((0.25 * h,) if chance(rng, 0.6) else ())):
        parts += [
            piece(bar((-a / 2 + 0.4 * half, s * b / 2, z), (a / 2 - 0.4 * half, s * b / 2, z), one), "beam")
            for s in (-1, 1)
        ]
        parts += [
            piece(bar((s * a / 2, -b / 2 + 0.4 * half, z), (s * a / 2, b / 2 - 0.4 * half, z), one), "beam")
            for s in (-1, 1)
        ]
    if chance(rng, 0.4):
        thin = section(pick(rng, "flat", "L", "round"), 0.03, style)
        parts += [
            piece(bar((-a / 2, s * b / 2, 0.3 * h), (a / 2, s * b / 2, h - 2 * half), thin), "brace") for s in (-1, 1)
        ]
    if chance(rng, 0.7):
        parts.append(piece(box((a + 2 * half + 0.02, b + 2 * half + 0.02, 0.01), (0, 0, h + 0.005)), "plate", "clamp"))
    return Model(parts)


def _inertia(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A grouted skid: channels round a concrete fill on a plinth, bolted down, with sole plates; an inertia base."""
    a, b, h = num(rng, 0.8, 2.4), num(rng, 0.5, 1.3), num(rng, 0.1, 0.2)
    low = num(rng, 0.1, 0.4) if chance(rng, 0.7) else 0.06
    one = section("U", h, style)
    solids, top = _frame(a, b, one, 2, low)
    parts = [piece(s, "skid frame", bundle="skid frame") for s in solids]
    parts.append(piece(box((a - 0.75 * h, b + 0.2 * h, 0.9 * h), (0, 0, low + 0.46 * h)), "foundation", "concrete"))
    if low > 0.06:
        parts.append(piece(slab_xy(rounded_rectangle(a + 0.3, b + 0.3, 0.02, 1), 0, low), "foundation", "concrete"))
    else:
        spring = merge([cylinder(0.04, 0, low, 10), cylinder(0.05, 0, 0.012, 10)])
        parts += [
            piece(moved(spring, at(sx * 0.4 * a, sy * b / 2)), "base plate", "rubber")
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
    for x in (-0.25 * a, 0.25 * a):
        parts.append(piece(box((0.2 * a, 0.6 * b, 0.02), (x, 0, top - 0.08 * h + 0.01)), "plate"))
    return Model(parts)


SKIDS: tuple[Family, ...] = (
    floor_family("skid frame/welded", _welded, 2.0),
    floor_family("skid frame/fork pockets", _forked, 1.3),
    floor_family("skid frame/cage", _cage, 1.3, "fitting"),
    floor_family("skid frame/drip tray", _tray, 1.2),
    floor_family("skid frame/pallet", _pallet, 0.8),
    floor_family("skid frame/folded", _folded, 1.0),
    floor_family("skid frame/sledge", _sledge, 1.0),
    floor_family("skid frame/grouted", _inertia, 0.8),
    floor_family("frame/table", _table, 1.5, "fitting"),
)
