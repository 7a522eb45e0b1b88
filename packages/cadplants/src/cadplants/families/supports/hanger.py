"""Hangers under beams: clevis, band, roller, trapeze, spring can, constant box, turnbuckle, chain, hook, beam clamp."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.shape import (
    arc_yz,
    bolt_parts,
    carrier,
    eye,
    few,
    framed,
    member,
    nut_parts,
    overhead,
    piece,
    slab_yz,
    strap,
    upright,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import section_channel, section_i
from cadplants.primitives import along, around, bar, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["HANGERS", "hanger_rod", "roller"]

_NAME = "pipe hanger"


def _rod_d(r: float) -> float:
    """Diameter of the rod for a pipe of this radius (MSS SP-58 table 3) [m]."""
    return 0.010 if r < 0.035 else 0.012 if r < 0.06 else 0.016 if r < 0.1 else 0.022


def hanger_rod(d: float, low: float, high: float, style: ModelingStyle, y: float = 0.0) -> Part:
    """A threaded rod along z [m]."""
    return piece(moved(cylinder(d / 2, low, high, few(d / 2, style)), at(0, y)), "stud", _NAME, "fastener")


def _nut(d: float, z: float, style: ModelingStyle, y: float = 0.0, up: bool = True) -> Part:
    """A nut on a rod; it sits on ``z`` or hangs under it [m]."""
    low, high = (z, z + 0.85 * d) if up else (z - 0.85 * d, z)
    return piece(moved(hexagon(1.6 * d, low, high, d / 2, few(d / 2, style)), at(0, y)), "nut", _NAME, "fastener", True)


def _attached(
    d: float, z: float, height: float, style: ModelingStyle, rng: np.random.Generator, half: float = 0.0
) -> list[Part]:
    """How a rod that ends at ``z`` holds on above: a plate, a welded lug, a beam clamp, a channel."""
    kind = int(rng.integers(4))
    if kind == 0:  # a washer plate and nuts under a beam
        plate = box((0.06 + d, 0.06 + d, 0.008), (0, 0, z + 0.004))
        return [_nut(d, z, style, up=False), framed(plate, "plate"), *overhead(z + 0.008, height, half, style, rng)]
    if kind == 1:  # an eye nut on a lug that is welded to a beam
        ring_ = moved(eye(1.5 * d, 0.45 * d, style), at(0, 0, z + 1.3 * d) @ spun("z", np.pi / 2))
        t, w = 0.5 * d + 0.004, 2.2 * d
        top = z + 5.5 * d
        half_lug = [[0.5 * w, z + 1.7 * d], [w, z + 2.9 * d], [w, top]]
        lug = upright([*half_lug, *([-a, b] for a, b in half_lug[::-1])], -t / 2, t / 2)
        pin = along("y", cylinder(0.5 * d, -1.3 * d, 1.3 * d, few(d, style)), 0, 0, z + 2.35 * d)
        return [
            piece(ring_, "nut", _NAME, "fastener"),
            piece(lug, str(rng.choice([_NAME, "bracket"])), _NAME, "steel"),
            piece(pin, "bolt", _NAME, "fastener", True),
            *overhead(top, height, half, style, rng),
        ]
    if kind == 2:  # a C clamp that bites on the flange of a beam
        flange, b = 0.01, float(rng.choice([0.08, 0.1, 0.14]))
        jaw = [[-0.02, z - 0.004], [0.02, z - 0.004], [0.02, z + 0.012], [0.0, z + 0.02], [0.0, z + 0.021 + flange]]
        jaw += [[0.02, z + 0.021 + flange], [0.02, z + 0.04 + flange], [-0.02, z + 0.04 + flange]]
        c = slab_yz(jaw, -0.015, 0.015)
        bite = z + 0.021
        screw = merge(
            [
                cylinder(0.005, z + 0.015 + flange, z + 0.05 + flange, 8),
                hexagon(0.015, z + 0.05 + flange, z + 0.06 + flange),
            ]
        )
        edge = b / 2 - 0.012
        web = 0.006
        section = section_i(0.14, b, web, flange) + np.array([0.0, 0.07])
        solid = moved(bar((-0.6, 0, 0), (0.6, 0, 0), section), at(0, edge, bite))
        return [
            piece(c, "clamp", _NAME, "clamp"),
            piece(moved(screw, at(0, 0.012, 0)), "screw", _NAME, "fastener", True),
            _nut(d, z - 0.004, style, up=False),
            framed(solid, "beam"),
        ]
    # a channel on edge whose flange the rod goes through
    outline = section_channel(0.1, 0.05, 0.006, 0.008) - np.array([0.025, -0.05])
    beam = bar((0, -0.5 - half, z - 0.012), (0, 0.5 + half, z - 0.012), outline)
    return [_nut(d, z - 0.004, style), _nut(d, z - 0.012, style, up=False), framed(beam, "beam")]


def _clevis(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An adjustable clevis of one bent strap with a cross bolt and a yoke (MSS SP-58 type 1)."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    shield = bool(rng.random() < 0.4)
    rim = r + (0.002 if shield else 0.0)
    wide, thick = 0.022 + 0.12 * r, 0.003 + 0.01 * r
    up = float(rng.uniform(1.2, 1.9)) * r + 0.025
    steps = max(6, few(r, style, 28) // 2)
    lower = strap(
        np.vstack(
            [[[0, -rim - thick / 2, up]], arc_yz(rim + thick / 2, np.pi, 2 * np.pi, steps), [[0, rim + thick / 2, up]]]
        ),
        wide,
        thick,
    )
    half = rim - 0.001
    top = up + float(rng.uniform(0.02, 0.06)) + d
    pin_z = up - 0.012
    neck = float(rng.uniform(0.25, 0.6)) * half
    yoke = strap(
        [
            [0, -half + thick / 2, pin_z - 0.012],
            [0, -half + thick / 2, pin_z + 0.01],
            [0, -neck, top],
            [0, neck, top],
            [0, half - thick / 2, pin_z + 0.01],
            [0, half - thick / 2, pin_z - 0.012],
        ],
        wide,
        thick,
    )
    reach = rim + thick
    parts = [piece(lower, _NAME, _NAME), piece(yoke, _NAME, _NAME)]
    parts += bolt_parts(0.8 * d, 2 * reach, at(0, -reach, pin_z) @ spun("x", -np.pi / 2), style, _NAME)
    if shield:
        half_ = arc_yz(r + 0.001, 1.1 * np.pi, 1.9 * np.pi, steps)
        parts.append(piece(strap(half_, 4 * wide, 0.002), _NAME, _NAME, "pipe"))
    drop = float(rng.uniform(0.15, 0.7))
    parts += [
        hanger_rod(d, top - 0.6 * d - thick, top + drop, style),
        _nut(d, top + thick / 2, style),
        _nut(d, top - thick / 2, style, up=False),
    ]
    return Model([*parts, *_attached(d, top + drop, height, style, rng)])


def _swivel(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A swivel ring band: a pear-shaped strap with a knurled or hexagonal insert nut on top (MSS SP-58 type 10)."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    wide, thick = 0.016 + 0.1 * r, 0.0015 + 0.008 * r
    top = 1.55 * r + 0.02
    flat = 1.1 * d
    lean = float(rng.uniform(0.15, 0.3)) * np.pi
    middle = r + thick / 2
    bent = arc_yz(middle, np.pi - lean, 2 * np.pi + lean, max(8, few(r, style, 30)))
    band = strap(
        np.vstack(
            [
                [[0, -flat * 0.9, top]],
                [[0, -flat, top - 0.3 * d]],
                bent,
                [[0, flat, top - 0.3 * d]],
                [[0, flat * 0.9, top]],
            ]
        ),
        wide,
        thick,
    )
    cap = ring(0.52 * d, flat + 0.001, top - 0.002, top + thick, max(8, few(d, style)))
    insert = (
        turned(
            [(0.9 * d, top - 0.9 * d), (0.9 * d, top - 0.3 * d), (0.7 * d, top), (0.7 * d, top + 0.7 * d)],
            few(d, style),
        )
        if rng.random() < 0.6
        else hexagon(1.6 * d, top - 0.8 * d, top + 0.6 * d)
    )
    drop = float(rng.uniform(0.15, 0.8))
    parts = [
        piece(merge([band, cap]), _NAME, _NAME),
        piece(insert, "nut", _NAME, "fastener"),
        hanger_rod(d, top, top + drop, style),
        _nut(d, top + 0.75 * d, style),
    ]
    return Model([*parts, *_attached(d, top + drop, height, style, rng)])


def _three_bolt(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A three-bolt clamp (MSS SP-58 type 3): long upper ears, their load bolt carries an eye rod."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    thick, wide, blade = 0.005 + 0.02 * r, 0.03 + 0.22 * r, 1.0 * d
    ear = 2.6 * d
    half = half_band(r, thick, wide, ear, style, blade)
    stand = spun("x", np.pi / 2)
    parts = [
        piece(moved(half, m), _NAME if rng.random() < 0.5 else "clamp", _NAME)
        for m in (stand, stand @ spun("x", np.pi))
    ]
    arm = 4.0 * d + float(rng.uniform(0.02, 0.08))
    start, end = r + thick + 0.8 * ear, r + thick + ear + arm
    for s in (-1, 1):
        y = s * (blade / 2 + thick / 2)
        link = box((wide, thick, end - start + 0.2 * ear), (0, y, (start + end + 0.2 * ear) / 2))
        parts[0 if s < 0 else 1] = piece(merge([parts[0 if s < 0 else 1].solid, link]), parts[0].name, _NAME)
    for z in (-r - thick - 0.55 * ear, r + thick + 0.5 * ear, end - 0.5 * d):
        pose = at(0, blade / 2 + thick, z) @ spun("x", np.pi / 2)
        parts += bolt_parts(0.85 * d, blade + 2 * thick, pose, style, _NAME)
    loop_z = end - 0.5 * d + 0.6 * d
    parts.append(piece(moved(eye(1.0 * d, 0.5 * d, style), at(0, 0, loop_z) @ np.eye(4)), "nut", _NAME, "fastener"))
    drop = float(rng.uniform(0.2, 0.7))
    parts.append(hanger_rod(d, loop_z + 0.8 * d, loop_z + drop, style))
    parts.append(_nut(d, loop_z + 1.4 * d, style))
    return Model([*parts, *_attached(d, loop_z + drop, height, style, rng)])


def roller(half: float, r: float, waist: float, style: ModelingStyle) -> Solid:
    """A roller along y: an hourglass for a pipe of radius ``r``, this thin at its waist [m]."""
    steps = np.linspace(-1, 1, 9)
    reach = np.minimum(np.abs(steps) * half, 0.9 * r)
    rim = waist + r - np.sqrt(r**2 - reach**2)
    shape = [(float(q), float(s * half)) for q, s in zip(rim, steps, strict=True)]
    return along("y", turned(shape, max(8, style.round(waist))))


def _rolling(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A roller hanger: a yoke on one rod (MSS SP-58 type 43) or an axle between two rods (type 41)."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    waist, half = 0.012 + 0.22 * r, 0.72 * r + 0.006
    axle_z = -r - waist
    axle = 0.5 * d
    parts = [piece(moved(roller(half, r, waist, style), at(0, 0, axle_z)), _NAME, _NAME, "trim")]
    drop = r + float(rng.uniform(0.15, 0.6))
    two = bool(rng.random() < 0.5)
    out = max(r + 0.008, half + 0.004) + (d if two else 0.004)
    pin = along("y", cylinder(axle, -out - d, out + d, few(axle, style)), 0, 0, axle_z)
    parts.append(piece(pin, "bolt", _NAME, "fastener"))
    if two:
        for s in (-1, 1):
            if rng.random() < 0.8:
                loop = moved(eye(0.5 * d + 0.4 * d, 0.4 * d, style), at(0, s * out, axle_z))
                parts.append(piece(loop, "nut", _NAME, "fastener"))
            parts += [hanger_rod(d, axle_z + axle, drop, style, s * out), _nut(d, drop, style, s * out, up=False)]
        return Model([*parts, *overhead(drop, height, out, style, rng)])
    thick, wide = 0.004 + 0.015 * r, 0.03 + 0.15 * r
    top = r + 0.02 + 0.3 * r
    path = [
        [0, -out, axle_z - 0.015],
        [0, -out, 0.5 * r],
        [0, -0.5 * out, top],
        [0, 0.5 * out, top],
        [0, out, 0.5 * r],
        [0, out, axle_z - 0.015],
    ]
    parts += [
        piece(strap(path, wide, thick), _NAME, _NAME),
        hanger_rod(d, top - 1.4 * d, top + drop, style),
        _nut(d, top + thick / 2, style),
        _nut(d, top - thick / 2, style, up=False),
    ]
    return Model([*parts, *_attached(d, top + drop, height, style, rng)])


def _trapeze(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A trapeze: strut, angle, channel or tube on two rods (MSS SP-58 type 59), the line on it under a strap or a U."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    size = float(rng.choice([0.041, 0.041, 0.05, 0.06, 0.08]))
    out = r + float(rng.uniform(0.06, 0.4))
    outline, holes = member(size, style, rng)
    low = -r - size
    trap = bar((0, -out - 0.04, -r - size / 2), (0, out + 0.04, -r - size / 2), outline, holes)
    parts: list[Part] = [piece(trap, _NAME, "") if rng.random() < 0.4 else framed(trap, "beam")]
    drop = r + float(rng.uniform(0.1, 0.7))
    double = bool(rng.random() < 0.25)
    for s in (-1, 1):
        y = s * out
        parts.append(hanger_rod(d, low - 2 * d, drop, style, y))
        flat = box((0.041, 0.041, 0.005), (0, y, low - 0.0025))
        parts.append(piece(flat, "washer", _NAME, "fastener", True))
        parts += [_nut(d, low - 0.005, style, y, up=False), _nut(d, -r, style, y), _nut(d, drop, style, y, up=False)]
    if double:
        z = low - r - float(rng.uniform(0.1, 0.3))
        parts.append(framed(bar((0, -out - 0.04, z), (0, out + 0.04, z), outline, holes), "beam"))
        parts += [hanger_rod(d, z - 0.03, low - 2 * d, style, s * out) for s in (-1, 1)]
    hold = int(rng.integers(3))
    t = 0.003
    if hold == 0:
        path = np.vstack(
            [
                [[0, r + 0.03, -r + t / 2]],
                [[0, r + t / 2, -r + t / 2]],
                arc_yz(r + t / 2, 0, np.pi, 10),
                [[0, -r - t / 2, -r + t / 2]],
                [[0, -r - 0.03, -r + t / 2]],
            ]
        )
        parts.append(piece(strap(path, 0.03, t), "clamp"))
    elif hold == 1:
        u = 0.4 * d
        path = np.vstack([[[0, r + u, low - 0.02]], arc_yz(r + u, 0, np.pi, 10), [[0, -r - u, low - 0.02]]])
        parts.append(piece(rope(path, u, few(u, style)), "u-bolt"))
        parts += nut_parts([(0, s * (r + u), low) for s in (-1, 1)], 2 * u, style)
    return Model([*parts, *overhead(drop, height, out, style, rng)])


def _spring(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A variable spring hanger (MSS SP-58 type 51): a can or a caged coil, a turnbuckle, a clamp."""
    r = PIPES[dn].radius
    d = _rod_d(r)
    thick, wide, ear = 0.005 + 0.02 * r, 0.03 + 0.2 * r, 2.6 * d
    stand = spun("x", np.pi / 2)
    half = half_band(r, thick, wide, ear, style, d)
    parts = [piece(moved(half, m), "clamp", _NAME) for m in (stand, stand @ spun("x", np.pi))]
    for s in (-1, 1):
        parts += bolt_parts(
            0.85 * d, d + 2 * thick, at(0, d / 2 + thick, s * (r + thick + 0.55 * ear)) @ stand, style, _NAME
        )
    z = r + thick + 0.9 * ear
    parts.append(piece(moved(eye(d, 0.5 * d, style), at(0, 0, z)), "nut", _NAME, "fastener"))
    turn = z + float(rng.uniform(0.05, 0.2))
    buckle = 7 * d
    parts += [hanger_rod(d, z + 0.7 * d, turn + 1.5 * d, style), *_turnbuckle(d, turn, turn + buckle, style)]
    low = turn + buckle + float(rng.uniform(0.04, 0.15))
    can, tall = 0.035 + 0.4 * r + float(rng.uniform(0, 0.03)), 0.14 + r + float(rng.uniform(0, 0.2))
    n = max(12, style.round(can))
    parts.append(hanger_rod(d, turn + buckle - 1.5 * d, low + 0.02, style))
    if rng.random() < 0.6:
        shell = turned([(can, low + 0.004), (can, low + tall)], n)
        lids = [cylinder(1.08 * can, q, q + 0.008, n) for q in (low, low + tall)]
        slot = box((0.006, 0.022, 0.55 * tall), (can, 0, low + 0.45 * tall))
        solids = [shell, *lids, slot]
    else:  # an open frame: a coil between plates on tie rods
        steps = 8 * 12
        a = np.linspace(0, 2 * np.pi * 6, steps)
        coil = np.column_stack(
            [0.72 * can * np.cos(a), 0.72 * can * np.sin(a), np.linspace(low + 0.02, low + tall - 0.02, steps)]
        )
        ties = around(cylinder(0.006, low, low + tall, 6), 3, 1.0 * can)
        solids = [rope(coil, 0.09 * can, 6), ties, *(cylinder(1.2 * can, q, q + 0.008, n) for q in (low, low + tall))]
    parts.append(piece(merge(solids), _NAME, _NAME, "motor"))
    if rng.random() < 0.5:
        plate = box((0.002, 0.03, 0.05), (can + 0.001 + 0.003, 0, low + 0.85 * tall))
        parts.append(piece(plate, _NAME, _NAME, "dial", True))
    top = low + tall + 0.008
    kind = int(rng.integers(3))
    if kind == 0:
        return Model([*parts, *overhead(top, height, can, style, rng)])
    if kind == 1:  # two lugs and a pin
        lugs = [box((0.05, 0.008, 0.06), (0, s * 0.014, top + 0.03)) for s in (-1, 1)]
        ear_ = box((0.05, 0.02, 0.07), (0, 0, top + 0.06))
        pin = along("y", cylinder(0.008, -0.03, 0.03, 10), 0, 0, top + 0.04)
        parts += [
            piece(merge(lugs), _NAME, _NAME),
            piece(ear_, "bracket", _NAME, "steel"),
            piece(pin, "bolt", _NAME, "fastener"),
        ]
        return Model([*parts, *overhead(top + 0.095, height, can, style, rng)])
    up = top + float(rng.uniform(0.1, 0.4))
    parts += [hanger_rod(d, top - 0.01, up, style), _nut(d, top, style)]
    return Model([*parts, *_attached(d, up, height, style, rng)])


def _turnbuckle(d: float, low: float, high: float, style: ModelingStyle) -> list[Part]:
    """A turnbuckle: two flanks between two threaded bosses (MSS SP-58 type 13)."""
    n = few(d, style)
    bosses = [cylinder(0.95 * d, low, low + 1.4 * d, n), cylinder(0.95 * d, high - 1.4 * d, high, n)]
    flanks = [
        rod((0, s * 0.85 * d, low + 0.6 * d), (0, s * 0.85 * d, high - 0.6 * d), 0.36 * d, few(0.4 * d, style, 8))
        for s in (-1, 1)
    ]
    return [piece(merge([*bosses, *flanks]), _NAME, _NAME, "fastener")]


HANGERS: tuple[Family, ...] = (
    carrier("pipe hanger/clevis", _clevis),
    carrier("pipe hanger/swivel ring", _swivel, SIZES[:10]),
    carrier("pipe hanger/three-bolt", _three_bolt),
    carrier("pipe hanger/roller", _rolling, SIZES[4:]),
    carrier("pipe hanger/trapeze", _trapeze, weight=1.5),
    carrier("pipe hanger/spring can", _spring, SIZES[4:]),
)
