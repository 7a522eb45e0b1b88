"""What carries a line from below or from the side: stanchions, chairs, shoes, knees, arms, sheets, tripods, springs."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.hanger import roller
from cadplants.families.supports.shape import (
    arc_yz,
    below,
    bolt_parts,
    carrier,
    coarse,
    few,
    footing,
    framed,
    member,
    nut_parts,
    piece,
    slab_yz,
    strap,
    upright,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import section_i
from cadplants.primitives import along, bar, box, cylinder, hexagon, ring, rope, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["STANDS", "tie"]

_B = "bracket"


def _cradle(r: float, thick: float, length: float, half_angle: float, style: ModelingStyle) -> Solid:
    """A bent plate under a line, this far round on either side [m, rad]."""
    steps = max(5, few(r, style, 24) // 3)
    a = np.linspace(1.5 * np.pi - half_angle, 1.5 * np.pi + half_angle, steps + 1)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    return slab_yz(np.vstack([(r + thick) * unit, (r * unit)[::-1]]), -length / 2, length / 2)


def tie(dn: int, grip: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What ties a line down on a level plate of this thickness under it: a U-bolt, a strap, nothing [m]."""
    r = PIPES[dn].radius
    kind = int(rng.integers(4))
    if kind == 0:
        return []
    if kind < 3:
        d = 0.006 if r < 0.02 else 0.01 if r < 0.06 else 0.016
        leg = r + d / 2
        path = np.vstack([[[0, leg, -r - grip - 2.2 * d]], arc_yz(leg, 0, np.pi, 10), [[0, -leg, -r - grip - 2.2 * d]]])
        spots = [(0, s * leg, -r - grip) for s in (-1, 1)]
        return [piece(rope(path, d / 2, few(d / 2, style)), "u-bolt"), *nut_parts(spots, d, style)]
    t, ear = 0.003 + 0.01 * r, 0.03
    middle, floor = r + t / 2, -r + t / 2
    sides = [[0, middle + ear, floor], [0, middle, floor]]
    path = np.vstack([sides, arc_yz(middle, 0, np.pi, 10), [[0, -y, z] for _, y, z in sides[::-1]]])
    parts = [piece(strap(path, 0.03 + 0.1 * r, t), "clamp")]
    for s in (-1, 1):
        parts += bolt_parts(0.008, t, at(0, s * (middle + 0.6 * ear), -r), style, "", "none")
    return parts


def _stanchion(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An adjustable pipe saddle (MSS SP-58 types 36 to 38): cradle, screw with nut, reducer, stanchion."""
    r = PIPES[dn].radius
    n, thick, length = style.round(r), 0.005 + 0.02 * r, 0.05 + 0.9 * r * float(rng.uniform(0.5, 1.2))
    low = -height
    free = height - r - thick
    stud, shaft = 0.010 + 0.1 * r, 0.022 + 0.2 * r
    parts = [piece(_cradle(r, thick, length, float(rng.uniform(0.25, 0.5)) * np.pi, style), _B, _B)]
    socket = turned(
        [(1.1 * stud, -r - thick - 2.2 * stud), (1.9 * stud, -r - thick - 2.2 * stud), (2.0 * stud, -r - 0.4 * thick)],
        few(stud, style),
    )
    parts.append(piece(socket, _B, _B))
    if rng.random() < 0.5:
        d = 0.008 if r < 0.06 else 0.012
        leg = r + d / 2
        ends = -0.55 * r
        path = np.vstack([[[0, leg, ends - 2 * d]], arc_yz(leg, 0, np.pi, 10), [[0, -leg, ends - 2 * d]]])
        parts.append(piece(rope(path, d / 2, few(d / 2, style)), "u-bolt", _B))
        lugs = [box((2.6 * d, 2.8 * d, 0.006), (0, s * (leg + 0.1 * d), ends - 0.003)) for s in (-1, 1)]
        parts.append(piece(merge(lugs), _B, _B))
        parts += nut_parts([(0, s * leg, ends - 0.006) for s in (-1, 1)], d, style, _B, False)
    foot, top = footing(3.2 * shaft + 0.08, 2 * shaft, style, rng)
    head = low + top + max(0.05, free * float(rng.uniform(0.4, 0.75)))
    neck = min(head + float(rng.uniform(0.02, 0.06)), -r - thick - 2.2 * stud)
    parts.append(piece(cylinder(stud, head - 0.03, -r - thick - 1.5 * stud, few(stud, style)), "stud", _B, "fastener"))
    parts.append(piece(hexagon(3.3 * stud, neck, neck + 1.2 * stud), "nut", _B, "fastener"))
    tube = ring(0.85 * shaft if style.hollow else 0.0, shaft, low + top, head, n)
    collar = turned(
        [
            (1.0 * shaft, head - 0.3 * shaft),
            (1.25 * shaft, head - 0.3 * shaft),
            (1.25 * shaft, head),
            (1.5 * stud, neck),
        ],
        n,
    )
    parts += [framed(tube, "post"), piece(collar, _B, _B), *placed(foot, at(0, 0, low))]
    return Model(parts)


def _chair(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A roller chair (MSS SP-58 types 44 to 46): cheeks with an axle and one roll or two, on a plate or on studs."""
    r = PIPES[dn].radius
    waist, half = 0.014 + 0.2 * r, 0.75 * r + 0.006
    two = bool(rng.random() < 0.35)
    wide, cheek = 1.5 * waist + 0.02, 0.006 + 0.02 * r
    parts: list[Part] = []
    if two:  # two plain rolls at 45 degrees to the upright
        q = (r + waist) * np.sqrt(0.5)
        z, length = -q, 2.5 * waist
        for s in (-1, 1):
            roll = along("x", cylinder(waist, -length / 2, length / 2, style.round(waist)), 0, s * q, z)
            pin = along(
                "x", cylinder(0.3 * waist, -length / 2 - cheek - 0.006, length / 2 + cheek + 0.006, 8), 0, s * q, z
            )
            parts += [piece(roll, _B, _B, "trim"), piece(pin, "bolt", _B, "fastener", True)]
        floor = z - 1.5 * waist
        outline = [
            [-q - 1.1 * waist, floor],
            [q + 1.1 * waist, floor],
            [q + 1.0 * waist, z + 0.4 * waist],
            [q - waist, z + 0.4 * waist],
        ]
        outline += [[-q + waist, z + 0.4 * waist], [-q - 1.0 * waist, z + 0.4 * waist]]
        outline = [*outline[:4], [0, max(-r - 0.6 * waist, floor) - 0.2 * waist], *outline[4:]]
        parts += [piece(slab_yz(outline, x, x + cheek), _B, _B, "steel") for x in (-length / 2 - cheek, length / 2)]
        side, deep = 2 * (q + 1.1 * waist), length + 2 * cheek
    else:
        z = -r - waist
        parts.append(piece(moved(roller(half, r, waist, style), at(0, 0, z)), _B, _B, "trim"))
        out = half + 0.003
        pin = along("y", cylinder(0.35 * waist, -out - cheek - 0.008, out + cheek + 0.008, 8), 0, 0, z)
        parts.append(piece(pin, "bolt", _B, "fastener", True))
        floor = z - 1.3 * waist - 0.25 * r
        ear = [[-wide, floor], [wide, floor], [0.5 * wide, z + 0.5 * wide], [-0.5 * wide, z + 0.5 * wide]]
        parts += [piece(upright(ear, y, y + cheek), _B, _B, "steel") for y in (-out - cheek, out)]
        side, deep = 2 * (out + cheek), 2 * wide
    t = 0.008
    parts.append(piece(box((deep + 0.02, side + 0.08, t), (0, 0, floor - t / 2)), _B, _B, "steel"))
    gap = float(rng.choice([0.0, 0.03, 0.06]))
    spots = [(sx * 0.35 * deep, sy * (side / 2 + 0.02)) for sx in (-1, 1) for sy in (-1, 1)]
    low = floor - t - gap
    for x, y in spots:
        if gap:
            parts.append(piece(moved(cylinder(0.006, low - 0.01, floor + 0.015, 8), at(x, y)), "stud", _B, "fastener"))
            parts += nut_parts([(x, y, floor - t)], 0.012, style, _B, False)
            parts += placed(nut_parts([(-x, y, -floor)], 0.012, style, _B, False), spun("y", np.pi))
        else:
            parts += bolt_parts(0.01, t, at(x, y, floor - t), style, _B, "none")
    if gap:
        parts.append(framed(box((deep + 0.04, side + 0.1, 0.01), (0, 0, low - 0.005)), "base plate"))
        low -= 0.01
    return Model([*parts, *below(low, height, side / 2 + 0.05, style, rng)])


def _guided(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A shoe of a split beam, a box or an H on a slide plate between guide angles with hold-down lips (EN 13480-3)."""
    r = PIPES[dn].radius
    tall, length, half = 0.06 + 0.35 * r, 0.15 + 0.7 * r, 0.035 + 0.55 * r
    top = -r - tall
    t = 0.008
    kind = int(rng.integers(3))
    if kind == 0:  # a T out of half a beam
        shoe = merge(
            [
                box((length, t, tall + 0.004), (0, 0, top + tall / 2 + 0.002)),
                box((length, 2 * half, t), (0, 0, top + t / 2)),
            ]
        )
    elif kind == 1:  # two webs
        z = -0.8 * r
        webs = [box((length, t, z - top), (0, s * 0.62 * r, (z + top) / 2)) for s in (-1, 1)]
        shoe = merge([*webs, box((length, 2 * half, t), (0, 0, top + t / 2))])
    else:  # an H with a bent pad
        pad = _cradle(r, 0.006, length + 0.03, 0.3 * np.pi, style)
        section = section_i(tall - 0.005, 2 * half, 0.006, t)
        web = bar((-length / 2, 0, top + (tall - 0.005) / 2), (length / 2, 0, top + (tall - 0.005) / 2), section)
        shoe = merge([web, pad])
    parts = [piece(shoe, _B, _B, "steel")]
    if kind < 2 and rng.random() < 0.5:
        for x in (-0.4 * length, 0.4 * length):
            for s in (-1, 1) if kind == 0 else ():
                corners = [[s * t / 2, top + t], [s * 0.9 * half, top + t], [s * t / 2, -r - 0.002]]
                parts.append(piece(slab_yz(corners, x - 0.004, x + 0.004), "gusset plate", _B, "steel"))
    slide = float(rng.choice([0.0, 0.003, 0.006]))
    if slide:
        pads = [box((0.7 * length, 2.2 * half, slide), (0, 0, top - slide / 2))]
        parts.append(framed(merge(pads), "plate", "rubber"))
    base, thick = top - slide, 0.012
    side = 2 * half + 0.2
    parts.append(framed(box((0.8 * length, side, thick), (0, 0, base - thick / 2)), "plate"))
    lip = bool(rng.random() < 0.6)
    reach = 0.6 * length * float(rng.uniform(0.3, 1.0))
    for s in (-1, 1):
        y = s * (half + 0.003)
        upright_ = box((reach, 0.008, slide + t + 0.012), (0, y + s * 0.004, base + (slide + t + 0.012) / 2))
        solids = [upright_, box((reach, 0.05, 0.008), (0, y + s * 0.03, base + 0.004))]
        if lip:
            solids.append(box((reach, 0.03, 0.008), (0, y - s * 0.007, base + slide + t + 0.008)))
        parts.append(piece(merge(solids), _B, "guide", "steel"))
        if rng.random() < 0.5:
            parts += bolt_parts(0.01, 0.008 + thick, at(0, y + s * 0.035, base - thick), style, "guide")
    parts = [p if p.bundle != "guide" else Part(p.solid, p.name, p.color, _B, "", p.fine) for p in parts]
    return Model([*parts, *below(base - thick, height, side / 2, style, rng)])


def _trunnion(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A dummy leg: a stub of pipe or profile welded under the line, with a pad or ribs."""
    r = PIPES[dn].radius
    leg = r * float(rng.uniform(0.55, 0.85))
    n = style.round(leg)
    foot, top = footing(2 * leg + 0.1, 2 * leg, style, rng)
    low = -height + top
    up = -np.sqrt(r * r - leg * leg) * 0.98 - 0.002
    if rng.random() < 0.7:
        stub = ring(0.88 * leg if style.hollow else 0.0, leg, low, up, n)
    else:
        stub = extrude(section_i(1.5 * leg, 1.5 * leg, 0.1 * leg, 0.14 * leg), low, -r + 0.004)
    parts = [framed(stub, str(rng.choice(["post", "post", "column"]))), *placed(foot, at(0, 0, -height))]
    if coarse(style) or rng.random() < 0.5:
        parts.append(
            piece(_cradle(r, 0.005, 2.4 * leg + 0.03, 0.33 * np.pi, style), str(rng.choice([_B, "clamp"])), "", "steel")
        )
    if rng.random() < 0.4:
        t = 0.008
        ribs = upright([[leg * 0.98, low], [leg + 0.04, low], [leg * 0.98, low + 0.09]], -t / 2, t / 2)
        parts += [piece(moved(ribs, spun("z", k * np.pi / 2)), "gusset plate", "", "steel") for k in range(4)]
    return Model(parts)


def _knee(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A cantilever off a column with a knee brace or a web, end plates bolted on the flange."""
    r = PIPES[dn].radius
    size, depth = float(rng.choice([0.06, 0.08, 0.1])), 0.14
    reach = r + float(rng.uniform(0.12, 0.4))
    t = 0.01
    outline, holes = member(size, style, rng, flat=True)
    z = -r - size / 2
    arm = bar((0, -r - 0.06, z), (0, reach, z), outline, holes)
    parts: list[Part] = [piece(arm, _B, _B, "steel") if coarse(style) or rng.random() < 0.6 else framed(arm, "beam")]
    tall = max(0.08, min(float(rng.uniform(0.15, 0.35)) + r, height - r - size - 0.06))
    low = -r - size - tall
    wide = 0.13
    if rng.random() < 0.35:  # a web plate instead of a brace, straight, clipped or curved
        deep = min(0.9 * (reach + r), tall * 1.2)
        a = np.linspace(0, np.pi / 2, 7)
        shapes = (
            [[reach - deep, -r - size], [reach, low], [reach, -r - size]],
            [
                [reach - deep, -r - size],
                [reach - deep, -r - size - 0.02],
                [reach - 0.02, low],
                [reach, low],
                [reach, -r - size],
            ],
            [*([reach - deep * np.sin(q), low + tall * (1 - np.cos(q))] for q in a), [reach, -r - size]],
        )
        web = slab_yz(shapes[int(rng.integers(3))], -0.005, 0.005)
        parts.append(piece(web, "gusset plate", _B, "steel"))
    else:
        thin, gap = member(0.7 * size, style, rng)
        start, end = (0.0, reach + t, low + 0.35 * size), (0.0, -0.2 * r, -r - size - 0.2 * size)
        parts.append(framed(bar(start, end, thin, gap), "brace"))
    plates = [(-r + 0.03, -r - size - 0.03)] if rng.random() < 0.5 else [(-r + 0.03, low - 0.04)]
    for high, bottom in plates:
        parts.append(framed(box((wide, t, high - bottom), (0, reach + t / 2, (high + bottom) / 2)), "plate"))
        for x in (-0.45, 0.45):
            for q in (high - 0.018, bottom + 0.018):
                parts += bolt_parts(
                    0.012, t + 0.01, at(x * (wide - 0.03), reach + t + 0.01, q) @ spun("x", np.pi / 2), style, _B
                )
    column = extrude(section_i(depth, 0.15, 0.007, 0.01), -height, float(rng.uniform(0.1, 0.6)))
    parts.append(framed(moved(column, at(0, reach + t + depth / 2)), "column"))
    return Model([*parts, *tie(dn, 0.008, style, rng)])


def _ribbed(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An L of plate or casting with one or two triangular ribs, bolted on a wall or a column beside the line."""
    r = PIPES[dn].radius
    t, wide = float(rng.choice([0.006, 0.008, 0.012])), 0.05 + 0.4 * r + float(rng.uniform(0, 0.05))
    reach, out = r + float(rng.uniform(0.02, 0.15)), 1.15 * r + 0.015
    top, tall = -r, 0.1 + 1.2 * r
    low = top - tall
    high = top if rng.random() < 0.6 else top + float(rng.uniform(0.02, 0.06))
    shelf = box((wide, reach + out, t), (0, (reach - out) / 2, top - t / 2))
    back = box((wide, t, high - low), (0, reach - t / 2, (high + low) / 2))
    span = reach - t + 0.85 * out
    corner, tip, toe = [reach - t, top - t], [reach - t - span, top - t], [reach - t, low + 0.1 * tall]
    form = int(rng.integers(3))
    outline = [corner, tip, toe] if form == 0 else [corner, tip, [tip[0], tip[1] - 0.01], [toe[0] - 0.01, toe[1]], toe]
    if form == 2:
        outline = [
            corner,
            tip,
            *([corner[0] - span * (1 - s), corner[1] - (corner[1] - toe[1]) * s**2] for s in (0.25, 0.5, 0.75)),
            toe,
        ]
    xs = (0.0,) if wide < 0.09 or rng.random() < 0.4 else (-0.4 * wide, 0.4 * wide)
    ribs = [slab_yz(outline, x - t / 2, x + t / 2) for x in xs]
    cast = rng.random() < 0.5
    if cast:
        parts = [piece(merge([shelf, back, *ribs]), _B, _B, "steel")]
    else:
        parts = [piece(merge([shelf, back]), _B, _B, "steel"), *(piece(s, "gusset plate", _B, "steel") for s in ribs)]
    d = 0.01
    for s in (-1, 1):
        for z in (top - t - 0.03, low + 0.025):
            x = s * 0.3 * wide if len(xs) == 1 else s * 0.22 * wide
            parts += bolt_parts(d, t, at(x, reach, z) @ spun("x", np.pi / 2), style, _B, "none")
    if rng.random() < 0.5:
        wall = box((0.8, 0.2, height + 0.6), (0, reach + 0.1, (0.6 - height) / 2))
        parts.append(framed(wall, "wall", "concrete"))
    else:
        column = extrude(section_i(0.14, max(0.14, wide), 0.007, 0.01), -height, 0.4)
        parts.append(framed(moved(column, at(0, reach + 0.07)), "column"))
    return Model([*parts, *tie(dn, t, style, rng)])


STANDS: tuple[Family, ...] = (
    carrier("bracket/stanchion", _stanchion),
    carrier("bracket/roller chair", _chair, SIZES[4:]),
    carrier("bracket/guided shoe", _guided),
    carrier("bracket/dummy leg", _trunnion, SIZES[3:]),
    carrier("bracket/knee", _knee),
    carrier("bracket/ribbed", _ribbed),
)
