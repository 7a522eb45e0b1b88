"""Hangers of other kinds: constant box, hook, chain, band, saddle on two rods, hinged ring."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.hanger import hanger_rod
from cadplants.families.supports.shape import (
    arc_yz,
    bolt_parts,
    carrier,
    eye,
    few,
    framed,
    overhead,
    piece,
    slab_yz,
    strap,
    upright,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, dome, hexagon, rod, rope
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["SLINGS"]

_NAME = "pipe hanger"


def _nut(d: float, low: float, style: ModelingStyle, y: float = 0.0) -> Part:
    solid = hexagon(1.6 * d, low, low + 0.85 * d, d / 2, few(d / 2, style))
    return piece(moved(solid, at(0, y)), "nut", _NAME, "fastener", True)


def _ceiling(z: float, d: float, height: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """The end of a rod at ``z``: a flange plate with screws, or a bracket plate, on a beam or a concrete slab [m]."""
    t, r = 0.006, 0.03 + 1.2 * d
    round_ = rng.random() < 0.5
    plate = extrude(
        circle(r, max(10, style.round(r))) if round_ else rounded_rectangle(2.6 * r, 1.4 * r, 0.005, 2), z, z + t
    )
    boss = hexagon(1.7 * d, z - 1.5 * d, z + 0.001)
    parts = [piece(merge([plate, boss]), str(rng.choice(["bracket", _NAME])), _NAME, "steel")]
    for x in (-0.7 * r, 0.7 * r) if round_ else (-r, r):
        parts += bolt_parts(0.006, t, at(x, 0, z + t) @ spun("x", np.pi), style, _NAME, "none")
    if rng.random() < 0.4:
        wide, thick = float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.1, 0.2))
        slab = box((wide, wide, thick), (0, 0, z + t + thick / 2))
        return [*parts, framed(slab, "platform", "concrete")]
    return [*parts, *overhead(z + t, height, 0.0, style, rng)]


def _constant(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A constant hanger (MSS SP-58 type 54): a frame with a lever, a lying spring can, a rod, a clamp."""
    r = PIPES[dn].radius
    d, k = 0.012 + 0.06 * r, 1.0 + 3.0 * r
    thick, wide, ear = 0.005 + 0.02 * r, 0.03 + 0.2 * r, 3 * d
    half = half_band(r, thick, wide, ear, style, d)
    stand = spun("x", np.pi / 2)
    parts = [piece(moved(half, m), "clamp", _NAME) for m in (stand, stand @ spun("x", np.pi))]
    for s in (-1, 1):
        pose = at(0, d / 2 + thick, s * (r + thick + 0.55 * ear)) @ stand
        parts += bolt_parts(0.9 * d, d + 2 * thick, pose, style, _NAME)
    loop = r + thick + 0.8 * ear
    low = loop + float(rng.uniform(0.15, 0.5))
    parts += [
        piece(moved(eye(d, 0.5 * d, style), at(0, 0, loop)), "nut", _NAME, "fastener"),
        hanger_rod(d, loop + 0.8 * d, low + 0.05 * k, style),
    ]
    tall, back = 0.22 * k, 0.2 * k * float(rng.uniform(0.8, 1.2))
    side = [
        [0.05 * k, low],
        [0.07 * k, low + 0.4 * tall],
        [-0.02 * k, low + tall],
        [-back, low + tall],
        [-back, low + 0.35 * tall],
        [-0.06 * k, low],
    ]
    t, gap = 0.006, 0.03 * k
    plates = [upright(side, s * gap - t / 2, s * gap + t / 2) for s in (-1, 1)]
    spring = 0.075 * k
    reach = 0.35 * k * float(rng.uniform(0.8, 1.4))
    n = max(10, style.round(spring))
    if rng.random() < 0.6:
        can = along("-x", cylinder(spring, 0, reach, n), -back + 0.002, 0, low + 0.65 * tall)
    else:
        z0 = low + 0.65 * tall - spring
        can = box((reach, 2 * spring, 2 * spring), (-back + 0.002 - reach / 2, 0, z0 + spring))
    lid = along("-x", cylinder(1.08 * spring, reach - 0.008, reach, n), -back + 0.002, 0, low + 0.65 * tall)
    lever = upright(
        [
            [0.02 * k, low + 0.02],
            [0.02 * k, low + 0.08 * k],
            [-0.12 * k, low + 0.65 * tall],
            [-0.14 * k, low + 0.5 * tall],
            [-0.02 * k, low + 0.01],
        ],
        -0.008,
        0.008,
    )
    pins = [
        along("y", cylinder(0.012 * k, -gap - 0.012, gap + 0.012, 10), x, 0, z)
        for x, z in ((0.0, low + 0.05 * k), (-0.11 * k, low + 0.6 * tall))
    ]
    parts.append(piece(merge([*plates, can, lid]), _NAME, _NAME, "motor"))
    parts.append(piece(lever, _NAME, _NAME, "trim"))
    parts += [piece(p, "bolt", _NAME, "fastener", True) for p in pins]
    top = low + tall
    lug = box((back * 0.7, 2 * gap, 0.012), (-back / 2, 0, top + 0.006))
    parts.append(framed(lug, "plate"))
    if rng.random() < 0.4:
        parts.append(
            piece(
                box((0.04, 0.001, 0.07), (-0.03 * k, -gap - t / 2 - 0.0005, low + 0.3 * tall)),
                _NAME,
                _NAME,
                "dial",
                True,
            )
        )
    return Model([*parts, *placed(overhead(top + 0.012, height, 0.12, style, rng), at(-back / 2))])


def _hooked(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A J hanger (MSS SP-58 type 5): an open hook of strap or round bar under a rod or beside a beam."""
    r = PIPES[dn].radius
    d, t, wide = 0.008 + 0.05 * r, 0.003 + 0.012 * r, 0.018 + 0.15 * r
    steps = max(8, few(r, style, 24))
    if rng.random() < 0.55:
        middle = r + t / 2
        end = float(rng.uniform(1.9, 2.2)) * np.pi
        up = r + float(rng.uniform(0.02, 0.06))
        bent = arc_yz(middle, np.pi, end, steps)
        if rng.random() < 0.6:  # bent over the line to a hole for the rod
            path = np.vstack([[[0, 0.9 * d, up], [0, -middle, up]], bent])
            body = strap(path, wide, t)
            start = up - t / 2
            nuts = [_nut(d, start + t, style), _nut(d, start - 0.85 * d, style)]
        else:  # straight on, screwed to the side of the rod's plate
            path = np.vstack([[[0, -middle, up + 3 * d]], bent])
            body = strap(path, wide, t)
            parts = [piece(body, _NAME, _NAME)]
            z = up + 2.2 * d
            y = -middle + t / 2
            post = 0.06
            beam = box((float(rng.uniform(0.5, 1.0)), post, 0.12), (0, y + post / 2, z + 0.01))
            for q in (-0.6, 0.6):
                parts += bolt_parts(
                    0.6 * d,
                    t,
                    at(0, y - t, z + q * d) @ spun("x", -np.pi / 2) @ at(0, 0, t) @ spun("x", np.pi),
                    style,
                    _NAME,
                    "none",
                )
            return Model([*parts, framed(beam, "beam")])
        start_rod = start - d
    else:
        thick = 0.5 * d
        middle = r + thick
        bent = arc_yz(middle, np.pi * 0.75, 2 * np.pi + 0.15, steps)
        knee = [0, 0, 1.6 * r + 0.03]
        body = rope(np.vstack([[[0, 0, knee[2] + 3 * d], knee], bent]), thick, few(thick, style))
        start_rod = knee[2] + 1.5 * d
        link = hexagon(1.7 * d, knee[2] + 1.2 * d, knee[2] + 4.5 * d)
        nuts = [piece(link, "nut", _NAME, "fastener")]
    top = start_rod + float(rng.uniform(0.15, 0.7))
    return Model(
        [piece(body, _NAME, _NAME), *nuts, hanger_rod(d, start_rod, top, style), *_ceiling(top, d, height, style, rng)]
    )


def _chained(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A line in a sling of chain or wire rope with a shackle, a hook or thimble clips below an eye on a beam."""
    r = PIPES[dn].radius
    d = 0.006 + 0.025 * r
    low = 1.5 * r + 0.05
    lean = float(np.arcsin((r + d / 2) / low))  # where the legs leave the line as tangents
    sling = arc_yz(r + d / 2, np.pi - lean, 2 * np.pi + lean, max(10, few(r, style, 24)))
    round_ = np.vstack([[[0, -0.4 * d, low]], sling, [[0, 0.4 * d, low]]])
    wide = float(rng.choice([0.0, 0.03]))
    body = strap(round_, 0.02 + wide, 0.5 * d) if rng.random() < 0.4 else rope(round_, d / 2, few(d / 2, style))
    parts = [piece(body, _NAME, _NAME, "trim")]
    parts.append(
        piece(moved(eye(1.6 * d, 0.5 * d, style), at(0, 0, low + 1.2 * d) @ spun("z", np.pi / 2)), _NAME, _NAME, "trim")
    )
    z = low + 3.0 * d
    top = z + float(rng.uniform(0.15, 0.6))
    if rng.random() < 0.6:  # links, each turned a quarter
        pitch, w, n = 3.0 * d, 0.9 * d, few(0.4 * d, style, 8)
        count = min(16, max(2, int((top - z) / pitch)))
        a = np.linspace(0, np.pi, 5)
        half = np.column_stack([w * np.cos(a), np.zeros(5), 0.8 * pitch - w + w * np.sin(a)])
        link = np.vstack([half, half[::-1] * (1, 1, -1)])
        section = circle(0.42 * d, n)
        link_solid = sweep(link, section, closed=True, up=(0.0, 1.0, 0.0))
        links = [
            moved(link_solid, at(0, 0, z + (k + 0.2) * pitch) @ spun("z", (k % 2) * np.pi / 2)) for k in range(count)
        ]
        parts.append(piece(merge(links), _NAME, _NAME, "trim"))
        top = z + (count - 0.8) * pitch + 0.8 * pitch
    else:  # wire rope with clips
        parts.append(piece(rod((0, 0, z - 1.5 * d), (0, 0, top), 0.4 * d, few(0.4 * d, style)), _NAME, _NAME, "trim"))
        for q in range(3):
            clip = box((2.2 * d, 1.4 * d, 0.9 * d), (0, 0, z + (1 + 2.5 * q) * d))
            parts.append(piece(clip, "clamp", _NAME, "fastener", True))
    parts.append(
        piece(moved(eye(1.5 * d, 0.5 * d, style), at(0, 0, top + d) @ spun("z", np.pi / 2)), "bolt", _NAME, "fastener")
    )
    parts.append(piece(cylinder(0.6 * d, top + 2.6 * d, top + 5 * d, few(d, style)), "bolt", _NAME, "fastener"))
    return Model([*parts, *overhead(top + 5 * d, height, 0.0, style, rng)])


def _banded(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A band looped under the line and screwed together above it: on a joist or with a foot on a beam."""
    r = PIPES[dn].radius
    t, wide = 0.0012 + 0.006 * r, 0.017 + 0.1 * r
    middle = r + t / 2
    steps = max(8, few(r, style, 28) // 2)
    low = arc_yz(middle, np.pi, 2 * np.pi, steps)
    d = 0.006
    high = 1.5 * r + 0.09 + float(rng.uniform(0.0, 0.45))
    parts: list[Part] = []
    if rng.random() < 0.5:  # both ends straight up to both sides of a joist
        body = strap(np.vstack([[[0, -middle, high + 0.08]], low, [[0, middle, high + 0.08]]]), wide, t)
        joist = box((float(rng.uniform(0.5, 1.2)), 2 * r, 0.15), (0, 0, high + 0.075))
        parts += [piece(body, _NAME, _NAME), framed(joist, "beam")]
        for s in (-1, 1):
            for z in (high + 0.02, high + 0.06):
                pose = at(0, s * r, z) @ spun("x", -s * np.pi / 2)
                parts += bolt_parts(d, t, pose, style, _NAME, "none")
        return Model(parts)
    near = 1.5 * r + 0.02
    lean = float(np.arcsin(middle / near))
    low = arc_yz(middle, np.pi - lean, 2 * np.pi + lean, 2 * steps)
    path = np.vstack(
        [
            [[0, -t / 2 - 0.0005, high], [0, -t / 2 - 0.0005, near]],
            low,
            [[0, t / 2 + 0.0005, near], [0, t / 2 + 0.0005, near + 0.05]],
        ]
    )
    parts.append(piece(strap(path, wide, t), _NAME, _NAME))
    parts += bolt_parts(d, 2 * t + 0.001, at(0, -t - 0.0005, near + 0.025) @ spun("x", -np.pi / 2), style, _NAME)
    foot = strap(
        [[0, -t / 2 - 0.0005, high - 0.02], [0, -t / 2 - 0.0005, high + t / 2], [0, -0.05, high + t / 2]], wide, t
    )
    parts.append(piece(foot, str(rng.choice(["bracket", _NAME])), _NAME))
    parts += bolt_parts(d, t, at(0, -0.035, high + t) @ spun("x", np.pi), style, _NAME, "none")
    return Model([*parts, *overhead(high + t, height, 0.0, style, rng)])


def _two_rod(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A saddle plate hung on two rods: a bent cradle with ears, a flat bar with stops, a V."""
    r = PIPES[dn].radius
    d, t = 0.008 + 0.05 * r, 0.005 + 0.015 * r
    wide, ear = 0.03 + 0.25 * r, 3.2 * d
    kind = int(rng.integers(3))
    if kind == 0:
        body = moved(half_band(r, t, wide, ear, style, 0.002), spun("x", np.pi))
        level, y = -0.001, r + t + 0.55 * ear
    elif kind == 1:
        body = merge(
            [
                box((wide, 2 * (r + ear), t), (0, 0, -r - t / 2)),
                *(box((wide, 0.005, 0.3 * r), (0, s * (r + 0.0025), -0.85 * r)) for s in (-1, 1)),
            ]
        )
        level, y = -r, r + 0.6 * ear
    else:
        v = [
            [0, -1.3 * r - t],
            [r + ear, -0.2 * r - t],
            [r + ear, -0.2 * r],
            [r + 0.2 * ear, -0.2 * r],
            [0, -1.41421 * r],
        ]
        flank = [[-a, b] for a, b in v[3:0:-1]]
        solid = slab_yz([[0, -1.41421 * r - t], v[1], v[2], v[3], [0, -1.41421 * r], *flank], -wide / 2, wide / 2)
        body, level, y = solid, -0.2 * r, r + 0.6 * ear
    parts = [piece(body, _NAME if rng.random() < 0.75 else "bracket", _NAME)]
    top = r + float(rng.uniform(0.1, 0.6))
    for s in (-1, 1):
        parts += [
            hanger_rod(d, level - t - 1.6 * d, top, style, s * y),
            _nut(d, level, style, s * y),
            _nut(d, level - t - 0.85 * d, style, s * y),
            _nut(d, top - 0.85 * d, style, s * y),
        ]
    return Model([*parts, *overhead(top, height, y, style, rng)])


def _hinged_ring(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A split ring with a hinge and a latch (MSS SP-58 type 11) under a socket, a ball joint above."""
    r = PIPES[dn].radius
    d = 0.008 + 0.04 * r
    n = few(r, style, 28)
    t, wide = 0.006 + 0.02 * r, 0.014 + 0.06 * r
    bolt_y = r + t + 0.55 * d
    upper = strap(arc_yz(r + t / 2, 0.04, np.pi - 0.04, max(8, n // 2)), wide, t)
    lower = strap(arc_yz(r + t / 2, np.pi + 0.04, 2 * np.pi - 0.04, max(8, n // 2)), wide, t)
    lugs = [box((wide, 2.2 * d, 0.9 * d), (0, r + t + 0.7 * d, s * 0.5 * d)) for s in (-1, 1)]
    knuckle = along("x", cylinder(0.7 * d, -0.5 * wide, 0.5 * wide, few(d, style)), 0, -r - t - 0.3 * d, 0)
    socket = cylinder(0.9 * d, r + 0.5 * t, r + t + 1.6 * d, few(d, style))
    parts = [
        piece(merge([upper, lugs[1], socket]), _NAME, _NAME),
        piece(merge([lower, lugs[0], knuckle]), _NAME, _NAME),
        *bolt_parts(0.6 * d, 1.9 * d, at(0, bolt_y + 0.3 * d, -0.95 * d), style, _NAME, "none"),
    ]
    z = r + t + 1.2 * d
    top = z + float(rng.uniform(0.15, 0.7))
    parts.append(hanger_rod(d, z, top, style))
    if rng.random() < 0.5:
        parts.append(_nut(d, r + t + 1.6 * d, style))
    if rng.random() < 0.5:
        return Model([*parts, *_ceiling(top, d, height, style, rng)])
    joint = merge(
        [
            dome(1.6 * d, 1.8 * d, top - 0.2 * d, few(d, style)),
            cylinder(2.4 * d, top + 1.4 * d, top + 2.0 * d, few(2 * d, style)),
        ]
    )
    parts.append(piece(joint, "bracket", _NAME, "steel"))
    return Model([*parts, *overhead(top + 2.0 * d, height, 0.0, style, rng)])


SLINGS: tuple[Family, ...] = (
    carrier("pipe hanger/constant", _constant, SIZES[5:]),
    carrier("pipe hanger/hook", _hooked),
    carrier("pipe hanger/chain", _chained),
    carrier("pipe hanger/band", _banded),
    carrier("pipe hanger/two-rod saddle", _two_rod),
    carrier("pipe hanger/hinged ring", _hinged_ring, SIZES[:10]),
)
