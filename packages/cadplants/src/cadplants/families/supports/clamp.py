"""Clamps on lines: two-bolt, riser, strap, split ring, cushion, anchor, block, clip."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.shape import (
    GROUP,
    arc_yz,
    below,
    bolt_parts,
    carrier,
    few,
    framed,
    overhead,
    piece,
    slab_yz,
    strap,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.primitives import along, bar, box, cylinder, hexagon, ring
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["CLAMPS", "half_band"]

_SMALL = tuple(dn for dn in SIZES if dn <= 100)


def half_band(inner: float, thick: float, wide: float, ear: float, style: ModelingStyle, gap: float = 0.004) -> Solid:
    """The upper half of a bent band round a line with two flat level ears, half a gap over the middle [m]."""
    middle = inner + thick / 2
    first = float(np.arcsin(min(0.5, (gap / 2 + thick / 2) / middle)))
    steps = max(6, few(inner, style, 32) // 2)
    bent = arc_yz(middle, first, np.pi - first, steps)
    z = float(bent[0][2])
    return strap(np.vstack([[[0, middle + ear, z]], bent, [[0, -middle - ear, z]]]), wide, thick)


def _sizes(r: float, rng: np.random.Generator) -> tuple[float, float, float, float]:
    """Thickness, width, ears and bolt of a band for a pipe of this radius (DIN 3567, MSS SP-58) [m]."""
    thick = float(rng.choice([0.003, 0.005, 0.006])) + (0.004 if r > 0.07 else 0.0)
    bolt = 0.006 if r < 0.02 else 0.01 if r < 0.06 else 0.016
    return thick, 0.025 + 0.25 * r * float(rng.uniform(0.6, 1.4)), 2.6 * bolt + float(rng.uniform(0, 0.02)), bolt


def _two_bolt(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A two-bolt clamp whose halves stand left and right (MSS SP-58 type 4), its lower ears on a blade of a bracket."""
    r = PIPES[dn].radius
    thick, wide, ear, d = _sizes(r, rng)
    blade = float(rng.choice([0.006, 0.008, 0.01]))
    half = half_band(r, thick, wide, ear, style, blade)
    pose = spun("x", np.pi / 2)
    parts = [piece(moved(half, m), "clamp", "clamp") for m in (pose, pose @ spun("x", np.pi))]
    for s in (-1, 1):
        z = s * (r + thick + 0.6 * ear)
        hole = at(0, blade / 2 + thick, z) @ spun("x", np.pi / 2)
        parts += bolt_parts(d, blade + 2 * thick, hole, style, "clamp", str(rng.choice(["hex", "flange"])))
    foot = -r - thick - ear - float(rng.uniform(0.02, 0.1))
    web = box(
        (wide * float(rng.uniform(0.8, 1.3)), blade, -r - thick - 0.1 * ear - foot),
        (0, 0, (foot - r - thick - 0.1 * ear) / 2),
    )
    sole = box((0.1 + 0.3 * r, 0.08 + 0.5 * r, 0.01), (0, 0, foot - 0.005))
    parts += [piece(web, "bracket", "", "steel"), framed(sole, "plate")]
    return Model([*parts, *below(foot - 0.01, height, 0.04 + 0.25 * r, style, rng)])


def _riser(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A riser clamp (MSS SP-58 type 8): two halves with long ears on a slab or on beams, round a riser."""
    pipe = PIPES[dn]
    r, n = pipe.radius, style.round(pipe.radius)
    thick, wide, ear, d = _sizes(r, rng)
    ear = r + float(rng.uniform(0.08, 0.2))
    level, high = float(rng.uniform(0.5, 1.2)), float(rng.uniform(1.5, 2.2))
    half = half_band(r, thick, wide, ear, style, 0.008)
    stand = at(0, 0, level + wide / 2) @ spun("y", np.pi / 2)
    parts = [piece(moved(half, stand @ m), "clamp", "clamp") for m in (np.eye(4), spun("x", np.pi))]
    for s in (-1, 1):
        for share in (0.15, 0.5) if rng.random() < 0.3 else (0.15,):
            y = s * (r + thick + 1.2 * d + share * ear)
            parts += bolt_parts(d, 0.008 + 2 * thick, stand @ at(0, y, -0.004 - thick), style, "clamp")
    run = ring(pipe.bore if style.hollow else 0.0, r, 0.0, high, n)
    parts.append(Part(run, "pipe", "pipe", "", "Pipe assembly"))
    if rng.random() < 0.5:
        side, deep = 2 * (r + ear) + 0.3, float(rng.uniform(0.1, 0.2))
        slab = extrude(rounded_rectangle(side, side, 0), level - deep, level, (circle(r + 0.03, n),))
        parts.append(framed(slab, str(rng.choice(["platform", "foundation"])), "concrete"))
        if rng.random() < 0.6:
            parts.append(
                Part(ring(r + 0.02, r + 0.028, level - deep, level + 0.0, n), "pipe", "pipe", "", "Pipe assembly")
            )
        sides = (-1, 1)
    else:
        size, span = float(rng.choice([0.08, 0.1, 0.14])), 0.5 + r
        sides = (-1, 1)
        y = r + thick + 0.7 * ear
        outline = section_i(size, 0.5 * size, 0.006, 0.008)
        for s in sides:
            parts.append(
                framed(bar((-span, s * y, level - size / 2), (span, s * y, level - size / 2), outline), "beam")
            )
            for t in (-1, 1):
                post = extrude(rounded_rectangle(0.06, 0.06, 0.004, 1), 0, level - size)
                parts.append(framed(moved(post, at(t * (span - 0.03), s * y)), "post"))
    return Model(parts)


def _strapped(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A one-hole or two-hole strap over the line (MSS SP-58 type 26) on a wall, a plate, a post or a beam."""
    r = PIPES[dn].radius
    thick, wide, ear, d = _sizes(r, rng)
    thick = 0.5 * thick
    d = min(d, 0.01)
    one = bool(rng.random() < 0.4)
    middle, floor = r + thick / 2, -r + thick / 2
    steps = max(6, few(r, style, 32) // 2)
    right = [[0, middle + ear, floor], [0, middle, floor]]
    left = [[0, -middle, floor * 0.2]] if one else [[0, -middle, floor], [0, -middle - ear, floor]]
    path = np.vstack([right, arc_yz(middle, 0, np.pi, steps), left])
    parts = [piece(strap(path, wide, thick), "clamp", "clamp")]
    head = str(rng.choice(["none", "carriage", "hex"]))
    for s in (1,) if one else (1, -1):
        parts += bolt_parts(d, thick, at(0, s * (middle + 0.55 * ear), -r), style, "clamp", head)
    if rng.random() < 0.3:
        mold = box((wide, 0.004, 0.3 * r), (0, middle + 0.002, -0.5 * r))
        parts.append(piece(mold, "clamp", "clamp"))
    turn = int(rng.integers(3))
    half = middle + ear
    if turn == 0:
        thick_, low, high = float(rng.uniform(0.1, 0.3)), -height, half + float(rng.uniform(0.2, 0.8))
        wall = box((float(rng.uniform(0.6, 1.5)), thick_, high - low), (0, r + thick_ / 2, (low + high) / 2))
        return Model([*placed(parts, spun("x", np.pi / 2)), framed(wall, "wall", "concrete")])
    if turn == 1:
        deep = 0.01
        plate = box((wide + 0.05, 2 * half + 0.02, deep), (0, 0, -r - deep / 2))
        return Model([*parts, framed(plate, "plate"), *below(-r - deep, height, half, style, rng)])
    return Model([*parts, *below(-r, height, half, style, rng)])


def _split_ring(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A ring in two halves with a threaded boss on a stud, rubber lined or bare, off a flange plate on wall or post."""
    r = PIPES[dn].radius
    lined = bool(rng.random() < 0.6)
    pad = float(rng.uniform(0.003, 0.007)) if lined else 0.0
    thick, wide = 0.0015 + 0.012 * r + float(rng.uniform(0, 0.001)), 0.02 + 0.1 * r
    inner, ear = r + pad, 0.014 + 0.05 * r
    half = half_band(inner, thick, wide, ear, style, 0.006)
    parts = [piece(moved(half, m), "clamp", "clamp") for m in (np.eye(4), spun("x", np.pi))]
    if lined:
        n = style.round(r)
        solids = [ring(r, inner, -0.5 * wide, 0.5 * wide, n)]
        if rng.random() < 0.6:  # lips over the edges of the band
            solids += [
                ring(r, inner + 0.7 * thick, s * 0.55 * wide - 0.0015, s * 0.55 * wide + 0.0015, n) for s in (-1, 1)
            ]
        parts.append(piece(along("x", merge(solids)), "clamp", "clamp", "rubber"))
    d = 0.005 + 0.02 * r
    for s in (-1, 1):
        pose = at(0, s * (inner + thick + 0.55 * ear), -0.003 - thick)
        parts += bolt_parts(d, 0.006 + 2 * thick, pose, style, "clamp", str(rng.choice(["socket", "none", "hex"])))
    base = -inner - thick
    boss = (
        hexagon(0.016 + 0.04 * r, base - 0.014, base + 0.001)
        if rng.random() < 0.5
        else cylinder(0.008 + 0.02 * r, base - 0.014, base + 0.001, 10)
    )
    reach = base - float(rng.uniform(0.03, 0.25))
    rod = cylinder(0.004 + 0.012 * r, reach, base - 0.002, few(0.006, style))
    flange = (
        extrude(circle(0.03 + 0.05 * r, 16), reach - 0.005, reach)
        if rng.random() < 0.5
        else box((0.03, 0.09, 0.005), (0, 0, reach - 0.0025))
    )
    parts += [
        piece(boss, "nut", "clamp", "fastener"),
        piece(rod, "stud", "clamp", "fastener"),
        piece(flange, str(rng.choice(["bracket", "clamp"])), "clamp", "steel"),
    ]
    for s in (-1, 1):
        parts += bolt_parts(0.006, 0.005, at(0, s * 0.024, reach - 0.005), style, "clamp", "none")
    low = reach - 0.005
    if rng.random() < 0.5:
        wall = box((0.7, 0.15, height + 0.6), (0, 0.075 - low, (0.6 - height) / 2))
        return Model([*placed(parts, spun("x", np.pi / 2)), framed(wall, "wall", "concrete")])
    if rng.random() < 0.4:
        return Model([*placed(parts, spun("x", np.pi)), *overhead(-low, height, 0.05, style, rng)])
    return Model([*parts, *below(low, height, 0.06, style, rng)])


def _cushion(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A cushion clamp on a strut (41 mm channel): two shells hooked into its slot, one screw on top, an insert."""
    r = PIPES[dn].radius
    pad = float(rng.choice([0.0, 0.003, 0.005]))
    inner, thick, wide = r + pad, 0.0025 + 0.01 * r, 0.032
    gap = 0.008
    lug = 0.022 + 0.04 * r
    middle, steps = inner + thick / 2, max(6, few(r, style, 28) // 2)
    lean = float(np.arcsin(min(0.6, (gap / 2 + thick / 2) / middle)))
    bent = arc_yz(middle, -np.pi / 2 + lean, np.pi / 2 - lean, steps)
    y = float(bent[-1][1])
    path = np.vstack([[[0, y, -inner - 0.016]], bent, [[0, y, inner + lug]]])
    shell = strap(path, wide, thick)
    parts = [piece(moved(shell, m), "clamp", "clamp") for m in (np.eye(4), spun("z", np.pi))]
    hooks = [box((wide, 0.012, 0.004), (0, s * (y + 0.005), -inner - 0.014)) for s in (-1, 1)]
    parts = [Part(merge([p.solid, h]), p.name, p.color, p.bundle) for p, h in zip(parts, hooks[::-1], strict=True)]
    pose = at(0, y + thick / 2, inner + 0.6 * lug) @ spun("x", np.pi / 2)
    parts += bolt_parts(
        0.006 + 0.02 * r, 2 * y + thick, pose, style, "clamp", str(rng.choice(["hex", "socket", "carriage"]))
    )
    if pad:
        parts.append(
            piece(along("x", ring(r, inner, -0.6 * wide, 0.6 * wide, style.round(r))), "clamp", "clamp", "rubber")
        )
    top, s = -inner - thick - 0.003, 0.041
    reach = inner + 0.08 + float(rng.uniform(0, 0.3))
    c = section_channel(s, s, 0.0025, 0.0025) @ np.array([[0.0, 1.0], [-1.0, 0.0]]) - np.array([0.0, s])
    lips = [box((0.009, 2 * reach, 0.0025), (q * 0.016, 0, top - 0.00125)) for q in (-1, 1)]
    rail = merge([bar((0, -reach, top), (0, reach, top), c), *lips])
    parts.append(framed(rail, "beam", "clamp"))
    if rng.random() < 0.35:
        wall = box((0.8, 0.15, height + 0.6 + reach), (0, 0.075 + s - top, (0.6 + reach - height) / 2))
        return Model([*placed(parts, spun("x", np.pi / 2)), framed(wall, "wall", "concrete")])
    return Model([*parts, *below(top - s, height, reach - 0.05, style, rng)])


def _anchor(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A heavy fixed point: a wide clamp with four bolts or six on a welded chair with ribs (DIN 3567, EN 13480-3)."""
    r = PIPES[dn].radius
    thick, _, ear, d = _sizes(r, rng)
    thick, ear = 1.3 * thick, 1.1 * ear
    length = 0.09 + 0.7 * r
    half = half_band(r, thick, length, ear, style, 0.006)
    upper = piece(half, "clamp", "clamp")
    lower = piece(moved(half, spun("x", np.pi)), "clamp", "clamp")
    parts = [upper, lower]
    for x in (-0.36, 0.36) if rng.random() < 0.7 else (-0.38, 0.0, 0.38):
        for s in (-1, 1):
            pose = at(x * length, s * (r + thick + 0.55 * ear), -0.003 - thick)
            parts += bolt_parts(d, 0.006 + 2 * thick, pose, style, "clamp", str(rng.choice(["hex", "stud"])))
    foot = -r - thick - float(rng.uniform(0.05, 0.15))
    wall = 0.008
    inset = r * 0.72
    webs = [box((length, wall, -0.69 * r - foot), (0, s * inset, (foot - 0.69 * r) / 2)) for s in (-1, 1)]
    across = [
        box((wall, 2 * inset, -r - thick - foot + 0.002), (x * length, 0, (foot - r - thick + 0.002) / 2))
        for x in (-0.3, 0.3)
    ]
    sole = box((length + 0.04, 2 * r + 0.1, 0.012), (0, 0, foot - 0.006))
    parts += [piece(merge([*webs, *across]), "bracket", "", "steel"), framed(sole, "base plate")]
    return Model([*parts, *below(foot - 0.012, height, r + 0.05, style, rng)])


def _block(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A block clamp (DIN 3015): two plastic halves, cover plate, two bolts, weld plate; single or twin."""
    r = PIPES[dn].radius
    wide, half = 0.03 if r < 0.03 else 0.045 + 0.2 * r, r + 0.012 + 0.25 * r
    twin = bool(rng.random() < 0.3 and r < 0.03)
    d = 0.006 if r < 0.04 else 0.01
    reach = half + 1.6 * d
    steps = max(6, few(r, style, 28) // 2)
    a = np.linspace(0, np.pi, steps + 1)
    hollow = np.column_stack([(r + 0.0003) * np.cos(a), (r + 0.0003) * np.sin(a)])
    high = r + 0.006 + 0.15 * r
    step = 2 * reach + 0.004
    y1 = reach + (step if twin else 0.0)
    shift = np.array([step, 0.0])
    bores = [*hollow[::-1], *((hollow + shift)[::-1])] if twin else list(hollow[::-1])
    outline = [
        [-reach, 0.0008],
        *bores,
        [y1, 0.0008],
        [y1, 0.8 * high],
        [y1 - 0.2 * high, high],
        [-reach + 0.2 * high, high],
        [-reach, 0.8 * high],
    ]
    body = slab_yz(outline, -wide / 2, wide / 2)
    parts = [piece(moved(body, m), "clamp", "clamp", "electrical") for m in (np.eye(4), np.diag([1.0, 1, -1, 1]))]
    middle, long_ = (y1 - reach) / 2, y1 + reach
    t = 0.004 if r < 0.04 else 0.008
    if rng.random() < 0.75:
        cover = box((wide, long_ - 0.4 * high, t), (0, middle, high + t / 2))
        parts.append(piece(cover, "clamp", "clamp", "steel"))
        grip = 2 * high + t
    else:
        grip = 2 * high
    spots = [-reach + 1.3 * d, y1 - 1.3 * d] if not twin else [step / 2]
    for y in spots:
        pose = at(0, y, -high)
        screw = bolt_parts(d, grip, pose, style, "clamp", "none" if rng.random() < 0.6 else "socket")
        parts += [p for p in screw if p.name in ("bolt", "screw")]
    if twin:
        second = along("x", ring(PIPES[dn].bore if style.hollow else 0.0, r, -0.2, 0.2, style.round(r)), 0, step, 0)
        parts.append(Part(second, "pipe", "pipe", "", "Pipe assembly"))
    sole = box((wide + 0.004, long_ + float(rng.uniform(0, 0.04)), 0.006), (0, middle, -high - 0.003))
    parts.append(framed(sole, "plate"))
    return Model([*parts, *below(-high - 0.006, height, y1, style, rng)])


def _clip(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A plastic snap clip, open on top or with a hinged strap, screwed on a wall or a rail."""
    r = PIPES[dn].radius
    thick, wide = 0.0025 + 0.04 * r, 0.016 + 0.2 * r
    open_ = float(rng.uniform(0.15, 0.3)) * np.pi
    closed = bool(rng.random() < 0.4)
    a = np.linspace(np.pi / 2 + open_, 2.5 * np.pi - open_, max(12, few(r, style, 28)))
    far = (r + thick) * np.column_stack([np.cos(a), np.sin(a)])
    near = r * np.column_stack([np.cos(a), np.sin(a)])
    base = -r - thick - float(rng.uniform(0.004, 0.02))
    foot = box((wide, 1.3 * r + 0.012, -r - 0.3 * thick - base), (0, 0, (base - r - 0.3 * thick) / 2))
    solids = [slab_yz([*far, *near[::-1]], -wide / 2, wide / 2), foot]
    if rng.random() < 0.5:
        solids += [
            moved(
                cylinder(0.9 * thick, -wide / 2, wide / 2, 8),
                at(0, s * (r + 0.5 * thick) * np.sin(open_), (r + 0.5 * thick) * np.cos(open_)) @ spun("y", np.pi / 2),
            )
            for s in (-1, 1)
        ]
    parts = [piece(merge(solids), "clamp", "clamp", "rubber")]
    if closed:
        over = arc_yz(r + thick, np.pi / 2 - open_ - 0.25, np.pi / 2 + open_ + 0.25, 6)
        parts.append(piece(strap(over, wide, 0.8 * thick), "clamp", "clamp", "rubber"))
    parts += bolt_parts(0.005, 0.003, at(0, 0, base), style, "clamp", "none")[:1]
    if rng.random() < 0.5:
        wall = box((0.5, 0.12, height + 0.5), (0, 0.06 - base, (0.5 - height) / 2))
        return Model([*placed(parts, spun("x", np.pi / 2)), framed(wall, "wall", "concrete")])
    return Model([*parts, *below(base, height, r + 0.03, style, rng)])


CLAMPS: tuple[Family, ...] = (
    carrier("clamp/two-bolt", _two_bolt),
    Family("clamp/riser", "floor", GROUP, "clamp", _riser, SIZES, "structure"),
    carrier("clamp/strap", _strapped),
    carrier("clamp/split ring", _split_ring),
    carrier("clamp/cushion", _cushion),
    carrier("clamp/anchor", _anchor, SIZES[4:]),
    carrier("clamp/block", _block, _SMALL),
    carrier("clamp/clip", _clip, _SMALL),
)
