"""Light and special supports of lines: strut arm, folded sheet, tripod, spring base, cradle on a sleeper, L frame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.shape import (
    arc_yz,
    below,
    bolt_parts,
    carrier,
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
from cadplants.families.supports.stand import tie
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, lattice, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_i
from cadplants.primitives import along, bar, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["ARMS"]

_B = "bracket"


def _backing(
    y: float, height: float, high: float, wide: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Part]:
    """A wall or a column whose face stands at ``y`` beside the line [m]."""
    if rng.random() < 0.5:
        thick = float(rng.uniform(0.1, 0.25))
        solid = box((float(rng.uniform(0.5, 1.2)), thick, height + high), (0, y + thick / 2, (high - height) / 2))
        return [framed(solid, "wall", "concrete")]
    if rng.random() < 0.6:
        column = extrude(section_i(0.14, max(0.12, wide), 0.007, 0.01), -height, high)
        return [framed(moved(column, at(0, y + 0.07)), "column")]
    side = max(0.08, wide)
    foot, top = footing(side + 0.12, side, style, rng)
    post = extrude(rounded_rectangle(side, side, 0.005, 2), top - height, high)
    return [framed(moved(post, at(0, y + side / 2)), "post"), *placed(foot, at(0, y + side / 2, -height))]


def _strut_arm(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A cantilever arm of slotted strut (41 mm) welded on a slotted back plate, maybe with a rib."""
    r, s = PIPES[dn].radius, float(rng.choice([0.021, 0.041, 0.041, 0.062]))
    reach, tip = r + float(rng.uniform(0.1, 0.35)), r + float(rng.uniform(0.06, 0.2))
    top, t = -r, 0.0025
    length = reach + tip
    count = max(3, int(length / 0.05))
    xs = np.array([-0.0205, -0.006, 0.006, 0.0205])
    edges = np.linspace(-tip, reach, 2 * count + 2)
    filled = np.ones((3, 2 * count + 1), bool)
    filled[1, 1::2] = not (style.holes and rng.random() < 0.7)
    back = lattice(xs, edges, filled, top - t, top)
    sides = [box((t, length, s), (q * (0.0205 - t / 2), (reach - tip) / 2, top - s / 2)) for q in (-1, 1)]
    lips = [box((0.009, length, t), (q * 0.016, (reach - tip) / 2, top - s + t / 2)) for q in (-1, 1)]
    arm = [back, *sides, *lips]
    tall, wide = s + float(rng.uniform(0.06, 0.14)), float(rng.choice([0.045, 0.12]))
    slot = rounded_rectangle(0.012, 0.028, 0.0059, 3)
    mid = top - s / 2
    spots = [(0.0, mid + q * (tall / 2 - 0.02)) for q in (-1, 1)] if wide < 0.1 else [(q * 0.045, mid) for q in (-1, 1)]
    plate = upright(
        rounded_rectangle(wide, tall, 0.005, 1) + np.array([0.0, mid]),
        reach,
        reach + 0.008,
        tuple(slot + np.array(p) for p in spots) if style.holes else (),
    )
    parts = [piece(merge([*arm, plate]), _B, _B, "clamp")]
    if rng.random() < 0.35:
        rib = slab_yz([[reach, top - s], [reach - 0.1, top - s], [reach, mid - tall / 2]], -0.003, 0.003)
        parts.append(piece(rib, "gusset plate", _B, "clamp"))
    for x, z in spots:
        parts += bolt_parts(0.01, 0.008, at(x, reach + 0.008, z) @ spun("x", np.pi / 2), style, _B, "none")
    if rng.random() < 0.4:
        cap = box((0.043, 0.004, s + 0.002), (0, -tip - 0.002, top - s / 2))
        parts.append(piece(cap, _B, _B, "rubber", True))
    return Model([*parts, *tie(dn, t, style, rng), *_backing(reach + 0.008, height, 0.4, wide, style, rng)])


def _folded(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A support folded of sheet: a hat, a Z, a C or an inverted U with a notch, screwed on what is below."""
    r = PIPES[dn].radius
    t, wide = float(rng.choice([0.002, 0.003, 0.005])), 0.03 + 0.4 * r + float(rng.uniform(0, 0.04))
    tall, half, lip = float(rng.uniform(0.03, 0.15)), r + float(rng.uniform(0.02, 0.05)), 0.03
    top, low = -r - t / 2, -r - t - tall
    kind = int(rng.integers(4))
    base = low + t / 2
    if kind == 0:
        lean = float(rng.choice([0.0, 0.015]))
        path = [
            [-half - lip - lean, base],
            [-half - lean, base],
            [-half, top],
            [half, top],
            [half + lean, base],
            [half + lean + lip, base],
        ]
        feet = [-half - lean - 0.6 * lip, half + lean + 0.6 * lip]
    elif kind == 1:
        path = [[-half - lip, base], [-half, base], [-half, top], [half, top]]
        feet = [-half - 0.6 * lip]
    elif kind == 2:
        path = [[half, base], [-half, base], [-half, top], [half, top]]
        feet = [0.3 * half]
    else:
        path = [[half, base], [-half, base], [-half, top], [half, top], [half, base + 0.4 * tall]]
        feet = [-0.5 * half]
    sheet = strap([[0, y, z] for y, z in path], wide, t)
    parts = [piece(sheet, _B, _B, "clamp")]
    for y in feet:
        for x in (-0.3 * wide, 0.3 * wide) if wide > 0.05 else (0.0,):
            parts += bolt_parts(0.006, t, at(x, y, low), style, _B, str(rng.choice(["none", "socket"])))
    if rng.random() < 0.4:
        ribs = [
            slab_yz(
                [[-half + t / 2, top - t / 2], [-half + 0.7 * tall, top - t / 2], [-half + t / 2, top - 0.7 * tall]],
                x - t / 2,
                x + t / 2,
            )
            for x in (-0.35 * wide, 0.35 * wide)
        ]
        parts += [piece(q, "gusset plate", _B, "clamp") for q in ribs]
    return Model([*parts, *tie(dn, t, style, rng), *below(low, height, half + lip, style, rng)])


def _tripod(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A pipe stand on three or four splayed legs with a telescopic column and a V head, a roller head or a cradle."""
    r = PIPES[dn].radius
    n = few(0.02, style)
    v = float(rng.uniform(0.6, 0.9))  # half the angle of the V
    t = 0.006 + 0.01 * r
    wide = 0.05
    vertex = -(r / np.sin(v))
    flank = r / np.tan(v) + 0.4 * r + 0.01
    side = [
        [0, vertex],
        [flank * np.sin(v), vertex + flank * np.cos(v)],
        [flank * np.sin(v) + t * np.cos(v), vertex + flank * np.cos(v) - t * np.sin(v)],
        [0, vertex - t / np.sin(v)],
    ]
    head = slab_yz([*side[:3], side[3], *([-y, z] for y, z in side[2:0:-1])], -wide / 2, wide / 2)
    low = vertex - t / np.sin(v)
    free = low + height
    parts = [piece(head, _B, _B, "steel")]
    inner, outer = 0.012 + 0.05 * r, 0.018 + 0.06 * r
    knee = -height + 0.7 * free
    parts.append(framed(cylinder(inner, knee - 0.1 * free, low + 0.002, n), "post"))
    parts.append(
        framed(ring(0.9 * outer if style.hollow else 0, outer, -height + 0.25 * free, knee, max(n, 8)), "post")
    )
    if rng.random() < 0.5:
        parts.append(piece(hexagon(3 * outer, knee, knee + 0.02), "nut", _B, "fastener"))
    else:
        pin = along("y", cylinder(0.005, -1.6 * outer, 1.6 * outer, 8), 0, 0, knee - 0.02)
        parts.append(piece(pin, "screw", _B, "fastener", True))
    spread, count = max(0.15, 0.35 * free), int(rng.integers(3, 5))
    leg_r = 0.45 * outer + 0.004
    for k in range(count):
        pose = spun("z", 2 * np.pi * k / count + 0.4)
        leg = rod((outer * 0.9, 0, knee - 0.15 * free), (spread, 0, -height + 0.006), leg_r, few(leg_r, style))
        brace = rod(
            (outer * 0.9, 0, -height + 0.27 * free),
            (spread * 0.75, 0, -height + 0.006 + (knee - 0.15 * free + height) * 0.25),
            0.6 * leg_r,
            6,
        )
        shoe = cylinder(2.2 * leg_r, 0, 0.008, few(0.02, style))
        parts += [
            framed(moved(leg, pose), "brace"),
            framed(moved(brace, pose), "brace"),
            framed(moved(shoe, pose @ at(spread, 0, -height)), "base plate"),
        ]
    return Model(parts)


def _springy(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A variable spring base (MSS SP-58 type F): a can on a flange, a load column, a shoe on it."""
    r = PIPES[dn].radius
    can, tall = 0.045 + 0.4 * r, 0.1 + 0.6 * r + float(rng.uniform(0, 0.1))
    n = max(12, style.round(can))
    shoe = float(rng.uniform(0.0, 0.08))
    parts: list[Part] = []
    top = -r - shoe
    if shoe > 0.02:
        web = merge(
            [
                box((1.2 * can, 0.008, shoe - 0.006), (0, 0, -r - shoe / 2 + 0.004)),
                box((1.4 * can, 1.4 * can, 0.008), (0, 0, top + 0.004)),
            ]
        )
        parts.append(piece(web, _B, _B, "steel"))
    else:
        top = -r
    plate = 0.012
    parts.append(
        piece(
            cylinder(0.9 * can, top - plate, top, n)
            if rng.random() < 0.5
            else box((1.7 * can, 1.7 * can, plate), (0, 0, top - plate / 2)),
            _B,
            _B,
            "steel",
        )
    )
    out = float(rng.uniform(0.02, 0.08))
    lid = top - plate - out
    parts.append(piece(cylinder(0.4 * can, lid - 0.02, top - plate, few(0.02, style)), _B, _B, "trim"))
    foot = lid - tall
    shell = turned([(can, foot + 0.01), (can, lid - 0.008), (1.05 * can, lid - 0.008), (1.05 * can, lid)], n)
    solids = [shell]
    if rng.random() < 0.6:
        solids.append(box((0.006, 0.02, 0.5 * tall), (can, 0, foot + 0.5 * tall)))
    side = 2 * can + 0.08
    base = extrude(
        rounded_rectangle(side, side, 0.008, 2) if rng.random() < 0.6 else circle(0.6 * side, n), foot, foot + 0.01
    )
    parts += [piece(merge(solids), _B, _B, "motor"), framed(base, "base plate")]
    q = side / 2 - 0.022
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts += bolt_parts(0.01, 0.01, at(sx * q * 0.9, sy * q * 0.9, foot), style, _B, "none")
    return Model([*parts, *below(foot, height, side / 2, style, rng)])


def _cradled(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A welded cradle: a wrapper plate on a web with ribs and a sole, a strap on studs over it."""
    r = PIPES[dn].radius
    open_, t = float(rng.uniform(0.28, 0.45)) * np.pi, 0.006
    wide, tall = 0.06 + 0.5 * r, 0.05 + 0.4 * r + float(rng.uniform(0, 0.08))
    a = np.linspace(1.5 * np.pi - open_, 1.5 * np.pi + open_, 11)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    wrap = slab_yz(np.vstack([(r + t) * unit, (r * unit)[::-1]]), -wide / 2, wide / 2)
    low = -r - t - tall
    rim = (r + 0.5 * t) * unit
    half = float(rim[-1][0])
    foot = half + float(rng.uniform(-0.2, 0.3)) * half
    web = slab_yz([*rim, [foot, low + 0.008], [-foot, low + 0.008]], -0.004, 0.004)
    sole = box((wide, 2 * foot + 0.05, 0.008), (0, 0, low + 0.004))
    parts = [piece(merge([wrap, web, sole]), _B, _B, "steel")]
    name = "gusset plate" if rng.random() < 0.6 else _B
    for y in (0.0,) if r < 0.04 else (-0.5 * half, 0.5 * half):
        z = -np.sqrt((r + 0.5 * t) ** 2 - y**2)
        rib = upright(
            [[-wide / 2, low + 0.008], [wide / 2, low + 0.008], [0.45 * wide, z], [-0.45 * wide, z]],
            y - 0.003,
            y + 0.003,
        )
        parts.append(piece(rib, name, _B, "steel"))
    if rng.random() < 0.5:
        thick, ear = 0.005, 0.04
        band = half_band(r, thick, 0.5 * wide, ear, style, 0.01)
        parts.append(piece(band, "clamp", _B))
        for s in (-1, 1):
            y = s * (r + thick + 0.55 * ear)
            z = low + 0.008
            parts.append(piece(moved(cylinder(0.005, z, 0.03, 8), at(0, y)), "stud", _B, "fastener"))
            parts += placed(nut_parts([(0, -y, -0.011)], 0.01, style, _B), spun("x", np.pi))
        sole2 = box((0.5 * wide, 2 * (r + ear) + 0.05, 0.008), (0, 0, low - 0.004))
        parts.append(framed(sole2, "plate"))
        for s in (-1, 1):
            stub = box((0.02, 0.02, 0.008), (0, s * (r + thick + 0.55 * ear), low + 0.004))
            parts.append(piece(stub, "nut", _B, "fastener"))
        return Model([*parts, *below(low - 0.008, height, foot + 0.04, style, rng)])
    for s in (-1, 1):
        for x in (-0.3, 0.3):
            parts += bolt_parts(0.01, 0.008, at(x * wide, s * (foot + 0.012), low), style, _B, "none")
    return Model([*parts, *below(low, height, foot + 0.04, style, rng)])


def _ell(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An L or goal post of one bent or mitred profile on the floor with corner gussets, or a gallows over the line."""
    r = PIPES[dn].radius
    size = float(rng.choice([0.05, 0.06, 0.08]))
    out = r + float(rng.uniform(0.08, 0.3))
    outline, holes = member(size, style, rng, flat=True)
    over = bool(rng.random() < 0.4)
    z = 1.3 * r + float(rng.uniform(0.14, 0.35)) if over else -r - size / 2
    foot, top = footing(size + 0.12, size, style, rng)
    post = moved(extrude(outline, top - height, z + size / 2, holes), at(0, out))
    arm = bar((0, -r - 0.06, z), (0, out - float(outline[:, 1].max()), z), outline, holes)
    parts = [framed(post, "post"), framed(arm, "beam"), *placed(foot, at(0, out, -height))]
    leg, inner = float(rng.uniform(0.06, 0.14)), out - float(outline[:, 1].max())
    leg = min(leg, 0.9 * inner)
    corner = [[inner, z - size / 2], [inner - leg, z - size / 2], [inner, z - size / 2 - leg]]
    if rng.random() < 0.5:
        corner = [
            corner[0],
            corner[1],
            [inner - leg, z - size / 2 - 0.012],
            [inner - 0.012, z - size / 2 - leg],
            corner[2],
        ]
    parts.append(piece(slab_yz(corner, -0.004, 0.004), "gusset plate", "", "steel"))
    if not over:
        return Model([*parts, *tie(dn, 0.006, style, rng)])
    d = 0.01
    low, up = 1.25 * r + 0.01, z - size / 2
    bolt_top = up
    lean = float(np.arcsin((r + 0.002) / (low + 0.02)))  # where the legs leave the line as tangents
    hanger = arc_yz(r + 0.002, np.pi - lean, 2 * np.pi + lean, 16)
    loop = np.vstack([[[0, -0.006, low + 0.02]], hanger, [[0, 0.006, low + 0.02]]])
    parts += [
        piece(strap(loop, 0.03, 0.004), "pipe hanger", "hanger"),
        piece(cylinder(d / 2, low, bolt_top, 8), "stud", "hanger", "fastener"),
        piece(hexagon(0.018, low + 0.022, low + 0.03), "nut", "hanger", "fastener", True),
        piece(hexagon(0.018, bolt_top - 0.009, bolt_top), "nut", "hanger", "fastener", True),
    ]
    parts = [Part(p.solid, p.name, p.color, "", "", p.fine) if p.bundle == "hanger" else p for p in parts]
    return Model(parts)


ARMS: tuple[Family, ...] = (
    carrier("bracket/strut arm", _strut_arm),
    carrier("bracket/folded", _folded),
    carrier("bracket/tripod", _tripod),
    carrier("bracket/spring base", _springy, SIZES[3:]),
    carrier("bracket/cradle", _cradled),
    # Its hanger and its gusset are far apart: one mesh of both would be no bracket.
    replace(carrier("bracket/gallows", _ell), grain="fitting"),
)
