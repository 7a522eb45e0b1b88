"""Brackets between machines and frames: hinges, corner angles, mounting feet, lanterns with windows."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.shape import (
    bolt_parts,
    few,
    floor_family,
    footing,
    framed,
    member,
    piece,
    strap,
    upright,
)
from cadplants.families.supports.shape import (
    screwed_parts as screwed,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import around, bar, box, cylinder, ring, turned
from cadplants.transforms import at, spun

__all__ = ["MOUNTS"]

_B = "bracket"
_SAFETY = "Electrical and safety"


def _hinged(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Hinge brackets on a post, column or wall: leaf and strap hinges with pins, a door or gate."""
    high, wide = float(rng.uniform(0.8, 1.9)), float(rng.uniform(0.5, 1.0))
    pin, count = float(rng.choice([0.005, 0.008, 0.012])), int(rng.integers(2, 4))
    n = few(pin, style)
    size = float(rng.choice([0.06, 0.08, 0.1]))
    parts: list[Part] = []
    if rng.random() < 0.7:
        foot, low = footing(size + 0.12, size, style, rng)
        outline, holes = member(size, style, rng, flat=True)
        parts += [*foot, framed(extrude(outline, low, high + 0.15, holes), str(rng.choice(["post", "column"])))]
        edge = float(outline[:, 0].max())
    else:
        parts.append(framed(box((0.5, 0.2, high + 0.3), (-0.25, 0, (high + 0.3) / 2)), "wall", "concrete"))
        edge = 0.0
    knuckle, t, tall = 1.9 * pin, 0.005, float(rng.uniform(0.05, 0.12))
    x = edge + t + knuckle
    reach = float(rng.choice([0.06, 0.3])) * float(rng.uniform(0.8, 1.3))
    leaf_x = x + knuckle + 0.003
    for z in np.linspace(0.2, high - 0.15, count):
        base = box((t, 0.05, 1.25 * tall), (edge + t / 2, 0, z))
        thirds = [z - tall / 2 + tall * q / 3 for q in range(4)]
        fixed = [ring(pin, knuckle, thirds[q], thirds[q + 1] - 0.001, max(8, n)) for q in (0, 2)]
        bridge = [
            box(
                (knuckle + 0.002, 0.8 * knuckle, tall / 3 - 0.001),
                (edge + t + knuckle * 0.3, 0.4 * knuckle + pin * 0.3, (thirds[q] + thirds[q + 1] - 0.001) / 2),
            )
            for q in (0, 2)
        ]
        swing = ring(pin, knuckle, thirds[1], thirds[2] - 0.001, max(8, n))
        arm = box(
            (reach, t, tall / 3 - 0.001),
            (x + 0.8 * knuckle + reach / 2, -knuckle * 0.0, (thirds[1] + thirds[2] - 0.001) / 2),
        )
        bolt = merge(
            [
                cylinder(pin, thirds[0] - 0.004, thirds[3] + 0.002, n),
                cylinder(1.5 * pin, thirds[3], thirds[3] + 0.6 * pin, n),
            ]
        )
        parts += [
            piece(moved(merge([base, *(moved(f, at(x)) for f in fixed), *bridge]), at()), _B, "", "steel"),
            piece(merge([moved(swing, at(x)), arm]), _B, "", "steel"),
            piece(moved(bolt, at(x)), "bolt", "", "fastener", True),
        ]
        for q in (0.4, 0.85):
            parts += screwed(0.006, t, x + 0.8 * knuckle + q * reach, t / 2, float(thirds[1]) + tall / 6, style)
    kind = int(rng.integers(3))
    z0, z1 = 0.08, high
    if kind == 0:
        parts.append(
            framed(
                box((wide, 0.03, z1 - z0), (leaf_x + wide / 2, t / 2 + 0.015, (z0 + z1) / 2)),
                str(rng.choice(["gate", "plate"])),
                "gate",
            )
        )
    else:
        frame = [box((0.04, 0.03, z1 - z0), (leaf_x + q, t / 2 + 0.015, (z0 + z1) / 2)) for q in (0.02, wide - 0.02)]
        frame += [box((wide - 0.08, 0.03, 0.04), (leaf_x + wide / 2, t / 2 + 0.015, z)) for z in (z0 + 0.02, z1 - 0.02)]
        if kind == 2:
            frame += [
                box((0.01, 0.01, z1 - z0 - 0.08), (leaf_x + q, t / 2 + 0.015, (z0 + z1) / 2))
                for q in np.arange(0.12, wide - 0.06, 0.1)
            ]
        parts.append(framed(merge(frame), "gate", "gate"))
    return Model(parts)


def _corner(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A frame of square profiles with corner angles: cast with webs, bent plate, flat T and L plates, screwed on."""
    s = float(rng.choice([0.03, 0.04, 0.045, 0.06, 0.08]))
    w, h = float(rng.uniform(0.4, 1.0)), float(rng.uniform(0.4, 1.2))
    hole = (circle(0.2 * s, 8),) if style.holes else ()
    square = rounded_rectangle(s, s, 0.08 * s, 1)
    parts: list[Part] = []
    feet = bool(rng.random() < 0.5)
    for x in (-w / 2, w / 2):
        parts.append(framed(moved(extrude(square, 0, h, hole), at(x)), "post"))
        if feet:
            parts.append(framed(box((2 * s, 2 * s, 0.008), (x, 0, -0.004)), "base plate"))
    levels = sorted({round(h - s / 2, 6), round(float(rng.uniform(0.25, 0.6)) * h, 6)})
    for z in levels:
        parts.append(framed(bar((-w / 2 + s / 2, 0, z), (w / 2 - s / 2, 0, z), square, hole), "beam"))
    leg, t, d = float(rng.uniform(0.9, 2.2)) * s, 0.12 * s, 0.15 * s
    wide = float(rng.uniform(0.6, 0.98)) * s
    kind = int(rng.integers(4))
    shape: list[list[float]] = [[0, 0], [leg, 0], [leg, t], [t, t], [t, leg], [0, leg]]
    if kind == 0:  # cast, with webs at its sides
        web = upright([[t, t], [leg, t], [leg, 1.5 * t], [1.5 * t, leg], [t, leg]], -0.08 * s, 0.08 * s)
        solid = merge([upright(shape, -wide / 2, wide / 2), *(moved(web, at(0, q * 0.42 * wide)) for q in (-1, 1))])
    elif kind == 1:
        solid = upright(shape, -wide / 2, wide / 2)
    elif kind == 2:
        solid = upright([[0, 0], [leg, 0], [0, leg]], -wide / 2, wide / 2)
    else:  # a flat plate on the face of the joint
        solid = upright(
            [[-0.9 * s, -0.9 * s], [leg, -0.9 * s], [leg, -0.1 * s], [-0.1 * s, leg], [-0.9 * s, leg]],
            -s / 2 - t,
            -s / 2,
        )
    for z in levels:
        for x in (-1, 1):
            flip = np.diag([-float(x), 1.0, -1.0, 1.0]) if z > 0.25 * h else np.diag([-float(x), 1.0, 1.0, 1.0])
            pose = at(x * (w / 2 - s / 2), 0, z + (-s / 2 if z > 0.25 * h else s / 2)) @ flip
            parts.append(piece(moved(solid, pose), _B, "", "clamp"))
            if kind < 2:
                heads = [
                    *bolt_parts(d, t, at(0.6 * leg, 0, 0), style, "", "socket"),
                    *bolt_parts(d, t, at(0, 0, 0.6 * leg) @ spun("y", np.pi / 2), style, "", "socket"),
                ]
                parts += placed([p for p in heads if p.name == "screw"], pose)
            elif kind == 3:
                for q in ((0.65 * leg, -0.5 * s), (-0.5 * s, 0.65 * leg), (-0.5 * s, -0.5 * s)):
                    one = bolt_parts(d, t, at(q[0], -s / 2, q[1]) @ spun("x", np.pi / 2), style, "", "none")
                    parts += placed(one, pose)
    lift = 0.008 if feet else 0.0
    return Model(placed(parts, at(0, 0, lift)))


def _feet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Equipment on mounting feet: a vessel or a cabinet on angles, Z plates or rib feet."""
    size, high = float(rng.uniform(0.2, 0.6)), float(rng.uniform(0.3, 0.9))
    clear = float(rng.uniform(0.08, 0.4))
    t, wide, out = (
        float(rng.choice([0.004, 0.006, 0.01])),
        float(rng.uniform(0.05, 0.1)),
        float(rng.uniform(0.04, 0.08)),
    )
    parts: list[Part] = []
    kind = int(rng.integers(3))
    r = size / 2
    if kind == 0:
        body = box((size, size * 0.8, high), (0, 0, clear + high / 2))
        parts.append(Part(body, "control panel", "electrical", "", _SAFETY))
        spots = [at(sx * r, sy * 0.26 * size) @ spun("z", 0.0 if sx > 0 else np.pi) for sx in (-1, 1) for sy in (-1, 1)]
    else:
        body = turned(
            [(0.3 * r, clear - 0.02), (r, clear + 0.08), (r, clear + high), (0.4 * r, clear + high + 0.4 * r)],
            style.round(r),
        )
        parts.append(Part(body, str(rng.choice(["tank", "tank", "filter"])), "tank", "", "Tank"))
        if parts[-1].name == "filter":
            parts[-1] = Part(body, "filter", "tank", "", "Equipment")
        count = int(rng.integers(3, 5))
        flat = r * float(np.cos(np.pi / style.round(r)))  # the feet reach the sides of a coarse vessel too
        spots = [spun("z", 2 * np.pi * k / count) @ at(flat) for k in range(count)]
    tall = clear + float(rng.uniform(0.1, 0.25)) * high + 0.08
    form = int(rng.integers(3))
    high_ = tall if kind else max(tall, clear + 0.05)
    if form == 0:  # an angle: leg along the body, toe on the floor
        foot = merge(
            [box((t, wide, high_), (t / 2 - 0.001, 0, high_ / 2)), box((out, wide, t), (t + out / 2 - 0.002, 0, t / 2))]
        )
    elif form == 1:  # an angle with two ribs
        rib = upright([[t - 0.001, t], [t + 0.85 * out, t], [t - 0.001, 0.7 * high_]], -t / 2, t / 2)
        foot = merge(
            [
                box((t, wide, high_), (t / 2 - 0.001, 0, high_ / 2)),
                box((out, wide, t), (t + out / 2 - 0.002, 0, t / 2)),
                *(moved(rib, at(0, q * 0.42 * wide)) for q in (-1, 1)),
            ]
        )
    else:  # a bent Z
        pad = [
            [-0.001, 0, high_],
            [-0.001, 0, high_ - 0.05],
            [0.7 * out, 0, 0.35 * high_],
            [0.7 * out, 0, t / 2],
            [1.7 * out, 0, t / 2],
        ]
        foot = strap(np.array(pad) + np.array([t / 2, 0.0, 0.0]), wide, t, (0.0, 1.0, 0.0))
    far = {0: t + 0.6 * out, 1: t + 0.55 * out, 2: 1.35 * out}[form]
    for pose in spots:
        parts.append(piece(moved(foot, pose), _B, "", "steel"))
        for q in (-0.25, 0.25) if form != 1 else (0.0,):
            parts += placed(bolt_parts(0.01, t, at(far, q * wide, 0), style, "", "none"), pose)
    reach = 2 * (r + 2.2 * out) + 0.1
    if rng.random() < 0.5:
        slab = box((reach, reach, 0.1), (0, 0, -0.05))
        parts = placed([*parts, framed(slab, str(rng.choice(["foundation", "plate"])), "concrete")], at(0, 0, 0.1))
    return Model(parts)


def _lantern(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A mount between two flanged things: a bent plate with windows, a U of plate, four spacer posts, a cast cone."""
    r = float(rng.uniform(0.04, 0.12))
    n = style.round(r)
    low, gap, t = float(rng.uniform(0.05, 0.2)), float(rng.uniform(1.0, 2.2)) * r, 0.06 * r + 0.003
    d = 0.12 * r + 0.002
    kind = int(rng.integers(4))
    base = [
        box((3.2 * r, 3.2 * r, low), (0, 0, low / 2)),
        cylinder(0.3 * r, low - 0.001, low + gap, few(0.3 * r, style)),
    ]
    parts = [
        framed(base[0], str(rng.choice(["foundation", "plate"])), "concrete"),
        Part(base[1], "shaft", "trim", "", "Pump unit"),
    ]
    z0, z1 = low, low + gap
    hole = (circle(0.4 * r, n),)
    spots = [(q * r * np.cos(b), q * r * np.sin(b)) for q in (0.78,) for b in np.pi / 4 + np.arange(4) * np.pi / 2]
    if kind == 0:  # a U or a box of plate, open at its sides
        side = 2 * r * 1.05
        plates = [extrude(rounded_rectangle(side, side, 0), z, z + t, hole) for z in (z0, z1 - t)]
        walls = []
        for s in (-1, 1):
            window = rounded_rectangle(0.6 * side, 0.5 * gap, 0.1 * r, 3) + np.array([0.0, (z0 + z1) / 2])
            rim = [[-side / 2, z0 + t], [side / 2, z0 + t], [side / 2, z1 - t], [-side / 2, z1 - t]]
            y = s * (side / 2 - t / 2)
            walls.append(upright(rim, y - t / 2, y + t / 2, (window,)))
        solid = merge([*plates, *walls])
    elif kind == 1:
        solid = merge(
            [
                *(extrude(rounded_rectangle(2.1 * r, 2.1 * r, 0.2 * r, 3), z, z + t, hole) for z in (z0, z1 - t)),
                *(
                    moved(cylinder(0.12 * r, z0 + t, z1 - t, 10), at(0.75 * r * sx, 0.75 * r * sy))
                    for sx in (-1, 1)
                    for sy in (-1, 1)
                ),
            ]
        )
    elif kind == 2:  # cast flanges with ribs between
        disc = [extrude(circle(1.1 * r, n), z, z + 1.6 * t, hole) for z in (z0, z1 - 1.6 * t)]
        leg = box((0.5 * r, 0.16 * r, gap - 3.2 * t), (0.72 * r, 0, (z0 + z1) / 2))
        solid = merge([*disc, around(leg, int(rng.choice([2, 3, 4])), 0.0, 0.0)])
    else:  # a bell: a cone whose quarters are cut away
        wide = [(1.1 * r, z0), (1.1 * r, z0 + 1.6 * t)]
        ribs = upright(
            [[0.55 * r, z1 - 1.6 * t], [0.8 * r, z1 - 1.6 * t], [1.05 * r, z0 + 1.6 * t], [0.6 * r, z0 + 1.6 * t]],
            -0.2 * r,
            0.2 * r,
        )
        solid = merge(
            [
                ring(0.4 * r, 1.1 * r, wide[0][1], wide[1][1], n),
                ring(0.35 * r, 0.85 * r, z1 - 1.6 * t, z1, n),
                around(ribs, 4),
            ]
        )
    parts.append(piece(solid, _B, "", "steel"))
    if kind in (0, 1):
        for x, y in spots if kind == 0 else [(0.0, 0.85 * r), (0.0, -0.85 * r), (0.85 * r, 0.0), (-0.85 * r, 0.0)]:
            parts += bolt_parts(d, t, at(0.8 * x, 0.8 * y, z0), style, "", "none")
    top = [
        turned([(1.05 * r, z1), (1.05 * r, z1 + 1.6 * r), (0.6 * r, z1 + 1.9 * r)], n),
        box((1.9 * r, 1.6 * r, 1.4 * r), (0, 0, z1 + 0.7 * r)),
    ]
    what = int(rng.integers(2))
    parts.append(
        Part(
            top[what],
            *(("motor", "motor") if what == 0 else ("actuator", "motor")),
            "",
            "Pump unit" if what == 0 else "Valve assembly",
        )
    )
    return Model(parts)


MOUNTS: tuple[Family, ...] = (
    floor_family("bracket/hinge", _hinged, _B),
    floor_family("bracket/corner", _corner, _B),
    floor_family("bracket/mounting foot", _feet, _B),
    floor_family("bracket/lantern", _lantern, _B),
)
