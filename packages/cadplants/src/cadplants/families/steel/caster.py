"""Casters and wheels, with the frames, carts and rails that they roll under and on."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    bar,
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
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, turned
from cadplants.transforms import at, spun

__all__ = ["CASTERS", "caster_parts", "wheel", "wheeled"]

Colored = tuple[Solid, str]
WHEELS = ("solid", "tread", "plain", "spoked", "tyre")


def _mirrored(half: list[tuple[float, float]]) -> list[tuple[float, float]]:
    return [*half, *((r, -y) for r, y in reversed(half))]


def wheel(kind: str, r: float, w: float, style: ModelingStyle) -> list[Colored]:
    """A wheel about the y axis: of one piece, with a tread, spoked, with a tyre on a rim, with a groove or flange."""
    n = few_sides(style, r, 28)
    h = w / 2
    if kind == "plain":
        made = [(turned([(0.92 * r, -h), (r, -0.7 * h), (r, 0.7 * h), (0.92 * r, h)], n), "rubber")]
    elif kind == "solid":
        half = [
            (0.3 * r, -1.15 * h),
            (0.3 * r, -0.6 * h),
            (0.68 * r, -0.5 * h),
            (0.7 * r, -h),
            (0.95 * r, -h),
            (r, -0.6 * h),
        ]
        made = [(turned(_mirrored(half), n), "trim")]
    elif kind == "tread":
        core = _mirrored([(0.3 * r, -1.15 * h), (0.34 * r, -0.7 * h), (0.76 * r, -0.8 * h)])
        shoe = along("z", ring(0.76 * r, r, -h, h, n))
        made = [(turned(core, n), "trim"), (shoe, "rubber")]
    elif kind == "spoked":
        rim, hub = ring(0.82 * r, r, -h, h, n), cylinder(0.25 * r, -1.1 * h, 1.1 * h, max(8, n // 2))
        spokes = [
            moved(box((0.65 * r, 0.12 * r, 0.7 * h), (0.53 * r, 0, 0)), spun("z", a))
            for a in np.arange(5) * 2 * np.pi / 5
        ]
        made = [(merge([rim, hub, *spokes]), "trim")]
    elif kind == "tyre":
        well = _mirrored(
            [
                (0.2 * r, -1.2 * h),
                (0.2 * r, -0.3 * h),
                (0.5 * r, -0.25 * h),
                (0.56 * r, -0.75 * h),
                (0.6 * r, -0.75 * h),
            ]
        )
        a = np.linspace(-np.pi * 0.8, np.pi * 0.8, 9)
        tyre = [(0.8 * r + 0.2 * r * np.cos(t), h * np.sin(t)) for t in a]
        made = [
            (turned(well, n), "clamp"),
            (turned([(0.6 * r, -0.55 * h), *tyre[1:-1], (0.6 * r, 0.55 * h)], n), "rubber"),
        ]
    else:
        groove = _mirrored([(0.4 * r, -1.1 * h), (0.4 * r, -h), (r, -h), (r, -0.7 * h), (0.75 * r, -0.05 * h)])
        flange = [
            (0.4 * r, -1.2 * h),
            (0.4 * r, -h),
            (r, -h),
            (r, -0.6 * h),
            (0.85 * r, -0.5 * h),
            (0.82 * r, h),
            (0.4 * r, h),
        ]
        made = [(turned(groove if kind == "groove" else flange, n), "trim")]
    return [(along("y", one), color) for one, color in made]


def _plate(a: float, b: float, thick: float, style: ModelingStyle) -> Solid:
    """A mounting plate under z = 0 with four slots or holes."""
    holes = tuple(circle(0.055 * b, 8, (sx * 0.38 * a, sy * 0.36 * b)) for sx in (-1, 1) for sy in (-1, 1))
    return slab_xy(rounded_rectangle(a, b, 0.1 * b, 2), -thick, 0.0, holes if style.holes else ())


def _sheet_fork(r: float, w: float, trail: float, high: float, t: float) -> Solid:
    """The two cheeks of a swivel fork and their crown, from z = -0.2 r down to the axle."""
    z, top, g = -high + r, -0.3 * r, w / 2 + 0.1 * w
    cheek = [(trail + 0.22 * r, z), (trail + 0.15 * r, z + 0.2 * r), (0.5 * r, top), (-0.5 * r, top)]
    cheek += [(trail - 0.22 * r, z), (trail - 0.12 * r, z - 0.18 * r), (trail + 0.12 * r, z - 0.18 * r)]
    sides = [slab_xz(np.array(cheek), t, s * (g + t / 2)) for s in (-1, 1)]
    return merge([*sides, box((r, 2 * g + 2 * t, t), (0, 0, top + t / 2))])


def _axle(r: float, w: float, trail: float, high: float, style: ModelingStyle) -> Solid:
    reach, d = 0.6 * w + 0.12 * r, 0.1 * r
    n = few_sides(style, d, 10)
    pin = merge([cylinder(d, -reach, reach, n), hexagon(3.4 * d, reach - 0.02 * r, reach + 0.1 * r)])
    return along("y", pin, trail, 0, -high + r)


def _brake(r: float, w: float, high: float) -> Solid:
    """A pedal behind the fork, bent down over the wheel."""
    z = -high + 1.95 * r
    line = [(-0.2 * r, z + 0.02 * r), (-0.75 * r, z + 0.05 * r), (-1.15 * r, z - 0.35 * r)]
    return slab_xz(ribbon(line[::-1], 0.05 * r), 1.22 * w)


def caster_parts(kind: str, r: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A caster that hangs from z = 0 (EN 12532, EN 12533): its parts and its height.

    Args:
        kind: swivel, braked, fixed, heavy, stem, twin, levelling.
        r: radius of the wheel [m].
        style: that models it.
        rng: draws its wheel and proportions.
    """
    w, t = num(rng, 0.45, 0.8) * r, 0.06 * r
    turning = kind != "fixed"
    trail = num(rng, 0.3, 0.7) * r if turning else 0.0
    high = num(rng, 2.45, 2.9) * r
    n = few_sides(style, 0.6 * r)
    design = pick(rng, "solid", "tread", "plain", "tread") if kind != "heavy" else pick(rng, "solid", "spoked", "tread")
    metal: list[Solid] = []
    rest: list[Colored] = []
    if kind in ("swivel", "braked", "levelling"):
        metal += [_plate(2.1 * r, 1.7 * r, t, style), _sheet_fork(r, w, trail, high, t)]
        metal.append(turned([(0.5 * r, -0.3 * r), (0.62 * r, -0.2 * r), (0.62 * r, -0.12 * r), (0.4 * r, -t)], n))
        if kind == "braked":
            rest.append((_brake(r, w, high), "handle"))
        if kind == "levelling":
            foot = turned(
                [(0.5 * r, -high - 0.0), (0.5 * r, -high + 0.15 * r), (0.16 * r, -high + 0.25 * r), (0.16 * r, -t)], n
            )
            rest.append((moved(foot, at(-1.2 * r)), "safety"))
            metal.append(box((1.0 * r, 0.8 * r, 0.12 * r), (-0.9 * r, 0, -t - 0.06 * r)))
    elif kind == "fixed":
        g = w / 2 + 0.1 * w + t / 2
        line = [(-g, -high + 0.82 * r), (-g, -t / 2), (g, -t / 2), (g, -high + 0.82 * r)]
        bow = along("x", _extruded(ribbon(line, t), 0.7 * r))
        metal += [_plate(2.1 * r, 1.7 * r, t, style), moved(bow, at(0, 0, -t))]
    elif kind == "heavy":
        metal += [_plate(2.4 * r, 2.0 * r, 2 * t, style), _sheet_fork(r, w, trail, high, 2 * t)]
        metal.append(cylinder(0.7 * r, -0.3 * r, -2 * t, n))
        metal += [box((0.1 * r, w * 1.2 + 4 * t, 0.25 * r), (s * 0.35 * r, 0, -0.42 * r)) for s in (-1, 1)]
    elif kind == "stem":
        metal.append(_sheet_fork(r, w, trail, high, t))
        metal.append(cylinder(0.3 * r, -0.3 * r, -0.1 * r, n))
        metal.append(
            turned([(0.34 * r, -0.1 * r), (0.34 * r, 0.0), (0.17 * r, 0.0), (0.17 * r, 0.7 * r)], max(6, n // 2))
        )
    else:
        core = box((0.3 * r, 0.2 * r, 1.4 * r), (0.1 * r, 0, -high + 1.5 * r))
        metal += [core, cylinder(0.3 * r, -high + 2.05 * r, 0.0, n), cylinder(0.15 * r, 0.0, 0.7 * r, 6)]
    wheels = [(0.0, w)] if kind != "twin" else [(-0.42 * r, 0.6 * r), (0.42 * r, 0.6 * r)]
    for y, wide in wheels:
        for one, color in wheel(design if kind != "twin" else "plain", r, wide, style):
            rest.append((moved(one, at(trail, y, -high + r)), color))
    axle = _axle(r, w if kind != "twin" else 1.4 * r, trail, high, style)
    if chance(rng, 0.45):
        return [piece(merge([*metal, *(one for one, _ in rest), axle]), "caster", "clamp")], high
    parts = [piece(merge(metal), "caster", "clamp"), *(piece(one, "caster", color) for one, color in rest)]
    return [*parts, piece(axle, "bolt", "fastener", fine=True)], high


def _extruded(outline: Floats, long: float) -> Solid:
    """A prism about z = 0 whose outline's x and y come to lie along y and z once it lies along x."""
    turn = np.column_stack([-outline[:, 1], outline[:, 0]])
    return slab_xy(turn, -long / 2, long / 2)


def wheeled(
    spots: list[tuple[float, float]], kinds: tuple[str, ...], r: float, style: ModelingStyle, rng: np.random.Generator
) -> tuple[list[Part], float]:
    """Casters of one make under some points, each turned its own way; and the height of what they carry."""
    parts: list[Part] = []
    high, seed = 0.0, int(rng.integers(1 << 30))
    for k, (x, y) in enumerate(spots):
        kind = kinds[k % len(kinds)]
        # Each is made from the same draws, so that the wheels of one cart are alike.
        made, high_ = caster_parts(kind, r, style, np.random.default_rng(seed))
        high = high or high_
        turn = 0.0 if kind == "fixed" else num(rng, 0, 6.28)
        parts += placed(made, at(x, y, high) @ spun("z", turn))
        if kind not in ("stem", "twin") and chance(rng, 0.5):
            heads = [
                at(x, y, high) @ spun("z", turn) @ at(sx * 0.8 * r, sy * 0.6 * r, 0.005)
                for sx in (-1, 1)
                for sy in (-1, 1)
            ]
            parts += bolted(heads, 0.1 * r, style, 0.006) if style.fasteners != "pieces" else []
    return parts, high


def _dolly(_: int, style: ModelingStyle, rng: np.random.Generator, kinds: tuple[str, ...]) -> Model:
    """A low dolly or a corner of a frame on plate casters: plate, tube or angle frame, maybe loaded."""
    r = num(rng, 0.03, 0.1)
    a, b = num(rng, 0.4, 1.2) + 4 * r, num(rng, 0.35, 0.8) + 3 * r
    spots = [(sx * (a / 2 - 1.3 * r), sy * (b / 2 - 1.2 * r)) for sx in (-1, 1) for sy in (-1, 1)]
    parts, z = wheeled(spots, kinds, r, style, rng)
    deck = int(rng.integers(3))
    if deck == 0:
        parts.append(
            piece(slab_xy(rounded_rectangle(a, b, num(rng, 0, 0.06), 3), z, z + 0.01), pick(rng, "plate", "skid frame"))
        )
    elif deck == 1:
        one = drawn(rng, style, 2.0 * r, ("SHS", "U"))
        h = r
        parts += [
            piece(bar((-a / 2, s * (b / 2 - 1.2 * r), z + h), (a / 2, s * (b / 2 - 1.2 * r), z + h), one), "skid frame")
            for s in (-1, 1)
        ]
        parts += [
            piece(bar((x, -b / 2 + 1.2 * r, z + h), (x, b / 2 - 1.2 * r, z + h), one), "skid frame")
            for x in (-0.4 * a, 0.4 * a)
        ]
    else:
        pan = [box((a, b, 0.004), (0, 0, z + 0.002))]
        pan += [box((a, 0.004, 0.06), (0, s * (b / 2 + 0.002), z + 0.03)) for s in (-1, 1)]
        pan += [box((0.004, b + 0.008, 0.06), (s * (a / 2 + 0.002), 0, z + 0.03)) for s in (-1, 1)]
        parts.append(piece(merge(pan), "skid frame"))
    return Model(parts)


def _trolley(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tube trolley on stem or twin-wheel casters: uprights with casters in their ends, shelves, a push handle."""
    r, a, b, h = num(rng, 0.025, 0.06), num(rng, 0.5, 1.1), num(rng, 0.4, 0.7), num(rng, 0.5, 1.0)
    spots = [(sx * a / 2, sy * b / 2) for sx in (-1, 1) for sy in (-1, 1)]
    parts, z = wheeled(spots, (pick(rng, "stem", "twin"),), r, style, rng)
    d = max(0.014, 0.4 * r)
    parts += [piece(pipe([(x, y, z), (x, y, z + h)], d, style), "post") for x, y in spots]
    for level in np.linspace(0.1, 1.0, int(rng.integers(2, 4))):
        solid = slab_xy(rounded_rectangle(a + 2 * d, b + 2 * d, 2 * d, 3), z + level * h - 0.012, z + level * h + 0.012)
        parts.append(piece(solid, "plate", "clamp"))
    if chance(rng, 0.6):
        x = a / 2
        path = [
            (x, -b / 2, z + h),
            (x + 0.15, -b / 2, z + h + 0.12),
            (x + 0.15, b / 2, z + h + 0.12),
            (x, b / 2, z + h),
        ]
        parts.append(piece(pipe(path, d, style, 0.05), "railing", "handle"))
    return Model(parts)


def _cart(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cart on big wheels: an axle with two or four rubber-tyred or spoked wheels, a frame, a drawbar or handles."""
    r, a, b = num(rng, 0.1, 0.25), num(rng, 0.8, 1.8), num(rng, 0.5, 0.9)
    w, kind = num(rng, 0.25, 0.45) * r, pick(rng, "tyre", "tyre", "spoked", "tread")
    one = drawn(rng, style, num(rng, 0.04, 0.08), ("SHS", "U", "CHS", "RHS"))
    h = float(np.ptp(one[0][:, 1])) / 2
    z = r + 0.15 * r + h
    parts = [piece(bar((-a / 2, s * b / 2, z), (a / 2, s * b / 2, z), one), "skid frame") for s in (-1, 1)]
    parts += [piece(bar((x, -b / 2, z), (x, b / 2, z), one), "skid frame") for x in np.linspace(-0.45 * a, 0.45 * a, 3)]
    axles = pick(rng, (-0.3 * a,), (-0.32 * a, 0.32 * a))
    for x in axles:
        y = b / 2 + 0.04 + 0.6 * w
        parts.append(
            piece(rod((x, -y - w, r), (x, y + w, r), 0.14 * r, few_sides(style, 0.14 * r, 12)), "caster", "trim")
        )
        for s in (-1, 1):
            parts += [piece(moved(m, at(x, s * y, r)), "caster", c) for m, c in wheel(kind, r, w, style)]
            parts.append(piece(box((0.3 * r, 0.02, 0.3 * r), (x, s * b / 2, r + 0.1 * r)), "bracket"))
    if len(axles) == 1:
        parts += [piece(box((0.04, 0.04, z - h), (0.4 * a, s * b / 2, (z - h) / 2)), "post") for s in (-1, 1)]
        grips = [
            pipe(
                [
                    (a / 2 - 0.1, s * b / 2, z + h),
                    (a / 2 + 0.35, s * b / 2, z + 0.2),
                    (a / 2 + 0.55, s * b / 2, z + 0.2),
                ],
                0.016,
                style,
                0.08,
            )
            for s in (-1, 1)
        ]
        parts += [piece(grip, "railing", "handle") for grip in grips]
    else:
        tie = pipe([(0.45 * a, 0, z), (a / 2 + 0.7, 0, 0.1)], 0.02, style)
        parts.append(piece(tie, "brace", "handle"))
        parts.append(
            piece(
                along("x", ring(0.025, 0.04, -0.012, 0.012, 12), a / 2 + 0.705, 0, 0.09),
                "lifting lug",
                "handle",
            )
        )
    if chance(rng, 0.7):
        parts.append(piece(box((a, b, 0.006), (0, 0, z + h + 0.003)), "plate", "clamp"))
    return Model(parts)


def _rail_wheels(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bogie or transfer car on grooved or flanged wheels that stand on angle, tube or flat-bottomed rails."""
    r, a, b = num(rng, 0.05, 0.14), num(rng, 0.6, 1.6), num(rng, 0.5, 1.2)
    kind = pick(rng, "groove", "flanged")
    w = num(rng, 0.5, 0.9) * r
    tread = 0.75 * r if kind == "groove" else 0.83 * r
    rail = section("CHS", 0.5 * w, style) if kind == "groove" else section(pick(rng, "rail", "square"), 0.7 * r, style)
    base_z = -float(rail[0][:, 1].min())
    top = base_z + float(rail[0][:, 1].max())
    z = top + tread - (0.12 * w if kind == "groove" else 0.0)
    parts = [piece(bar((-a, s * b / 2, base_z), (a, s * b / 2, base_z), rail), "beam") for s in (-1, 1)]
    parts += [
        piece(box((0.1, b + 0.4, 0.06), (x, 0, -0.03)), "beam", "safety") for x in np.linspace(-0.9 * a, 0.9 * a, 4)
    ]
    box_h = num(rng, 1.2, 1.6) * r
    for x in (-0.38 * a, 0.38 * a):
        for s in (-1, 1):
            made = wheel(kind, r, w, style)
            turn = spun("z", 0.0 if s > 0 else np.pi)
            parts += [piece(moved(m, at(x, s * b / 2, z) @ turn), "caster", c) for m, c in made]
            cheeks = [
                box((0.7 * r, 0.01, box_h + 0.3 * r), (x, s * b / 2 + q * (0.62 * w + 0.005), z + box_h / 2 - 0.15 * r))
                for q in (-1, 1)
            ]
            cheeks.append(box((0.7 * r, 1.24 * w + 0.02, 0.01), (x, s * b / 2, z + box_h - 0.005)))
            parts.append(piece(merge(cheeks), "bracket", "clamp"))
            pin = along("y", cylinder(0.12 * r, -0.8 * w, 0.8 * w, 8), x, s * b / 2, z)
            parts.append(piece(pin, "bolt", "fastener", fine=True))
    one = drawn(rng, style, num(rng, 0.08, 0.16), ("U", "H", "RHS", "I"))
    h = float(np.ptp(one[0][:, 1])) / 2
    level = z + box_h + h
    parts += [piece(bar((-a / 2, s * b / 2, level), (a / 2, s * b / 2, level), one), "skid frame") for s in (-1, 1)]
    parts += [piece(bar((x, -b / 2, level), (x, b / 2, level), one), "skid frame") for x in (-0.45 * a, 0.45 * a)]
    if chance(rng, 0.5):
        parts.append(piece(box((a, b + 0.1, 0.008), (0, 0, level + h + 0.004)), "plate", "clamp"))
    return Model(parts)


def _skates(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Machinery skates: boxes with rows of rollers and a swivel pad, under two beams of a load."""
    r, rows = num(rng, 0.03, 0.06), int(rng.integers(2, 5))
    long, wide = (2.2 * rows + 0.6) * r, num(rng, 3.0, 5.0) * r
    high, a, b = 2.9 * r, num(rng, 0.8, 1.8), num(rng, 0.5, 1.0)
    parts: list[Part] = []
    for x in (-a / 2, a / 2):
        for y in (-b / 2, b / 2):
            frame = [box((long, 0.3 * r, 1.6 * r), (x, y + s * wide / 2, 1.6 * r)) for s in (-1, 1)]
            frame.append(box((long, wide + 0.3 * r, 0.3 * r), (x, y, 2.55 * r)))
            rollers = [
                along(
                    "y",
                    cylinder(r, -0.48 * wide, 0.48 * wide, few_sides(style, r, 16)),
                    x + (k - (rows - 1) / 2) * 2.2 * r,
                    y,
                    r,
                )
                for k in range(rows)
            ]
            pad = moved(cylinder(1.4 * r, 2.7 * r, high, few_sides(style, r, 16)), at(x, y))
            if chance(rng, 0.5):
                parts.append(piece(merge([*frame, *rollers, pad]), "caster", "handle"))
            else:
                parts += [
                    piece(merge([*frame, pad]), "caster", "handle"),
                    *(piece(one, "caster", "rubber") for one in rollers),
                ]
    one = drawn(rng, style, num(rng, 0.1, 0.2), ("H", "RHS", "U"))
    h = float(np.ptp(one[0][:, 1])) / 2
    parts += [
        piece(bar((-a / 2 - 0.2, s * b / 2, high + h), (a / 2 + 0.2, s * b / 2, high + h), one), "beam")
        for s in (-1, 1)
    ]
    return Model(parts)


CASTERS: tuple[Family, ...] = (
    floor_family("caster/swivel plate", partial(_dolly, kinds=("swivel", "braked")), 1.5, "fitting"),
    floor_family(
        "caster/fixed and swivel", partial(_dolly, kinds=("fixed", "fixed", "swivel", "braked")), 1.2, "fitting"
    ),
    floor_family("caster/heavy", partial(_dolly, kinds=("heavy",)), 1.0, "fitting"),
    floor_family("caster/levelling", partial(_dolly, kinds=("levelling",)), 0.7, "fitting"),
    floor_family("caster/stem", _trolley, 1.2, "fitting"),
    floor_family("caster/cart wheels", _cart, 1.2, "fitting"),
    floor_family("caster/rail wheels", _rail_wheels, 1.0, "fitting"),
    floor_family("caster/skates", _skates, 0.6, "fitting"),
)
