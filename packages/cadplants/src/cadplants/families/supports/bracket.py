"""Brackets that hold no line: shelves, instrument stands, motor slides, feet."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.shape import (
    bolt_parts,
    few,
    floor_family,
    footing,
    framed,
    nut_parts,
    piece,
    slab_yz,
    strap,
)
from cadplants.families.supports.shape import (
    screwed_parts as screwed,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.transforms import at

__all__ = ["BRACKETS"]

_B = "bracket"
_SAFETY = "Electrical and safety"


def _wall(rng: np.random.Generator, width: float, height: float, depth: float = 0.0) -> Part:
    """A wall behind y = 0 on the floor [m]."""
    thick = depth or float(rng.uniform(0.1, 0.25))
    return framed(box((width, thick, height), (0, thick / 2, height / 2)), "wall", "concrete")


def _shelf(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Shelf brackets on a wall: strip with a strut, rib, forged scroll, U with cheeks, tube arm."""
    count, gap = int(rng.integers(2, 5)), float(rng.uniform(0.35, 0.7))
    reach, drop = float(rng.uniform(0.15, 0.4)), float(rng.uniform(0.12, 0.35))
    t, wide, level = (
        float(rng.choice([0.004, 0.006, 0.008])),
        float(rng.uniform(0.025, 0.06)),
        float(rng.uniform(0.7, 1.6)),
    )
    kind = int(rng.integers(5))
    length = (count - 1) * gap + 0.3
    parts = [_wall(rng, length + 0.4, level + 0.5)]
    ell = merge(
        [box((wide, t, drop), (0, -t / 2, -drop / 2)), box((wide, reach - t, t), (0, -t - (reach - t) / 2, -t / 2))]
    )
    a = np.linspace(0, np.pi / 2, 8)
    if kind == 0:
        strut = strap([[0, -t, -0.88 * drop], [0, -0.85 * reach, -t]], 0.6 * wide, t)
        solid = merge([ell, strut])
    elif kind == 1:
        solid = merge([ell, slab_yz([[-t, -t], [-0.9 * reach, -t], [-t, -0.9 * drop]], -t / 2, t / 2)])
    elif kind == 2:
        bow = np.column_stack([np.zeros(8), -t - 0.9 * reach * (1 - np.cos(a)), -0.95 * drop + 0.93 * drop * np.sin(a)])
        curl = np.linspace(0, 3.6 * np.pi, 28)
        q = 0.18 * min(reach, drop) * (1 - 0.6 * curl / curl[-1])
        scroll = np.column_stack([np.zeros(28), -0.32 * reach - q * np.cos(curl), -0.33 * drop + q * np.sin(curl)])
        solid = merge([ell, strap(bow, 0.5 * wide, t), strap(scroll, 0.4 * wide, 0.7 * t)])
    elif kind == 3:
        rim = [
            [-t, -t],
            [-0.92 * reach, -t],
            [-0.92 * reach, -t - 0.015],
            *([-t - 0.85 * reach * (1 - np.sin(b)), -t - 0.9 * drop * (1 - np.cos(b))] for b in a[::-1][1:-1]),
            [-t, -0.92 * drop],
        ]
        rim = (
            [rim[0], rim[1], rim[2], [-t - 0.012, -0.92 * drop], rim[-1]]
            if rng.random() < 0.5
            else [rim[0], rim[1], rim[2], [-0.45 * reach, -0.3 * drop], rim[-1]]
        )
        solid = merge([ell, *(slab_yz(rim, s * 0.5 * wide - t / 2, s * 0.5 * wide + t / 2) for s in (-1, 1))])
    else:
        n = few(0.012, style)
        solid = merge(
            [
                box((0.06, 0.006, 0.1), (0, -0.003, -0.04)),
                rod((0, -0.004, -0.012), (0, -reach, -0.012), 0.012, n),
                rod((0, -0.004, -0.08), (0, -0.8 * reach, -0.018), 0.008, n),
            ]
        )
    xs = np.linspace(-(count - 1) * gap / 2, (count - 1) * gap / 2, count)
    for x in xs:
        parts.append(piece(moved(solid, at(float(x), 0, level)), _B, "", "steel"))
        for z in (-0.03, -0.75 * drop) if kind < 4 else (-0.075, -0.0):
            if kind < 4:
                parts += screwed(
                    0.008,
                    t,
                    float(x) + (0.3 * wide if kind in (1, 3) else 0.0) * (-1 if z > -0.05 else 1),
                    0.0,
                    level + z,
                    style,
                )
    if rng.random() < 0.75:
        board = box((length, reach + float(rng.uniform(-0.02, 0.08)), 0.02), (0, -reach / 2 - 0.01, level + 0.01))
        parts.append(framed(board, "plate"))
    return Model(parts)


def _stanchion(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An instrument stand: a 2 inch post on a foot, a bent plate on it with U-bolts, an instrument."""
    r, high = 0.0302, float(rng.uniform(1.0, 1.5))
    foot, low = footing(float(rng.uniform(0.16, 0.25)), 2 * r, style, rng)
    square = bool(rng.random() < 0.25)
    n = style.round(r)
    post = (
        extrude(rounded_rectangle(2 * r, 2 * r, 0.004, 2), low, high)
        if square
        else ring(r - 0.004 if style.hollow else 0, r, low, high, n)
    )
    parts = [framed(post, "post"), *foot]
    if rng.random() < 0.5:
        parts.append(framed(cylinder(r + 0.003, high, high + 0.004, n), "plate"))
    level, t, d = high - float(rng.uniform(0.08, 0.25)), float(rng.choice([0.003, 0.005])), 0.008
    wide, tall = float(rng.uniform(0.09, 0.16)), float(rng.uniform(0.09, 0.18))
    front = -r - t
    back = box((wide, t, tall), (0, -r - t / 2, level))
    shape = int(rng.integers(3))
    if shape == 0:
        plate = back
    elif shape == 1:  # an L
        plate = merge([back, box((wide, 0.1, t), (0, front - 0.05, level - tall / 2 + t / 2))])
    else:  # a hat or U
        plate = merge([back, *(box((t, 0.05, tall), (s * (wide / 2 - t / 2), front - 0.025, level)) for s in (-1, 1))])
    parts.append(piece(plate, _B, "", "steel"))
    for z in (level - 0.3 * tall, level + 0.3 * tall) if rng.random() < 0.6 else (level,):
        leg = r + d / 2
        if square:
            path = np.array([[leg, front - 2.2 * d, z], [leg, leg, z], [-leg, leg, z], [-leg, front - 2.2 * d, z]])
        else:
            b = np.linspace(0, np.pi, 11)
            path = np.vstack(
                [
                    [[leg, front - 2.2 * d, z]],
                    np.column_stack([leg * np.cos(b), leg * np.sin(b), np.full(11, z)]),
                    [[-leg, front - 2.2 * d, z]],
                ]
            )
        parts.append(piece(rope(path, d / 2, few(d / 2, style)), "u-bolt"))
        # What presses down at z of the helper presses towards -y here.
        nuts = nut_parts([(s * leg, z, front) for s in (-1, 1)], d, style)
        parts += placed(nuts, np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]))
    body_y = front - (0.05 if shape == 2 else 0.0)
    kind = int(rng.integers(3))
    if kind == 0:
        s = float(rng.uniform(0.1, 0.22))
        deep = 0.09
        case = merge(
            [
                box((s, deep, 1.2 * s), (0, body_y - deep / 2, level)),
                box((s * 1.03, 0.012, 1.23 * s), (0, body_y - deep + 0.004, level)),
            ]
        )
        parts.append(Part(case, "junction box", "electrical", "", _SAFETY))
    elif kind == 1:
        q = 0.045
        barrel = along("y", cylinder(q, -0.06, 0.06, style.round(q)), 0, body_y - 0.06, level)
        lids = [
            along("y", cylinder(1.1 * q, -0.012, 0.012, style.round(q)), 0, body_y - 0.06 + s * 0.05, level)
            for s in (-1, 1)
        ]
        neck = box((0.05, 0.04, 0.1), (0, body_y - 0.06, level - q - 0.03))
        parts.append(Part(merge([barrel, *lids, neck]), "transmitter", "gauge", "", "Gauge assembly"))
    else:
        q = 0.05
        face = along("-y", cylinder(q, 0, 0.045, style.round(q)), 0, body_y, level)
        parts.append(Part(face, "gauge", "gauge", "", "Gauge assembly"))
    return Model(parts)


def _slide(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Motor slide rails (DIN 42923): two slotted rails on a base or a slab, tensioning screws, a motor on feet."""
    length, gap = float(rng.uniform(0.35, 0.7)), float(rng.uniform(0.2, 0.4))
    wide, high, d = float(rng.uniform(0.04, 0.07)), float(rng.uniform(0.025, 0.05)), float(rng.choice([0.01, 0.012]))
    low = float(rng.choice([0.0, 0.1, 0.2]))
    parts: list[Part] = []
    if low:
        parts.append(framed(box((length + 0.2, gap + 0.3, low), (0, 0, low / 2)), "foundation", "concrete"))
    slot = rounded_rectangle(0.62 * length, 1.15 * d, 0.57 * d, 4)
    solid = rng.random() < 0.5
    name = _B if rng.random() < 0.6 else "plate"
    for s in (-1, 1):
        if solid:
            rail = extrude(rounded_rectangle(length, wide, 0.01, 2), low, low + high, (slot,))
        else:  # a top with a slot, side walls and end feet
            top = extrude(rounded_rectangle(length, wide, 0.008, 2), low + high - 0.008, low + high, (slot,))
            sides = [
                box((0.8 * length, 0.006, high - 0.008), (0, q * (wide / 2 - 0.003), low + (high - 0.008) / 2))
                for q in (-1, 1)
            ]
            ends = [box((0.1 * length, wide + 0.02, 0.012), (q * 0.47 * length, 0, low + 0.006)) for q in (-1, 1)]
            rail = merge([top, *sides, *ends])
        shifted = moved(rail, at(0, s * gap / 2))
        parts.append(piece(shifted, _B, "", "steel") if name == _B else framed(shifted, name))
        stop = box((0.02, wide * 0.5, 0.035), (-0.44 * length, s * gap / 2, low + high + 0.0175))
        push = merge(
            [
                along("x", cylinder(d / 2, -0.06, 0.08, few(d, style)), -0.44 * length, s * gap / 2, low + high + 0.02),
                along("-x", hexagon(1.6 * d, 0.05, 0.05 + 0.7 * d), -0.44 * length, s * gap / 2, low + high + 0.02),
            ]
        )
        parts += [piece(stop, _B, "", "steel"), piece(push, "screw", "", "fastener")]
        for q in (-0.4, 0.4):
            if solid:
                parts += bolt_parts(d, 0.004, at(q * length * 1.1, s * gap / 2, low + high - 0.004), style, "", "none")
    top_z = low + high
    r, foot_t = 0.32 * gap + 0.02, 0.012
    axis = top_z + r + 0.02
    for s in (-1, 1):
        foot = merge(
            [
                box((0.3 * length, wide, foot_t), (0.02, s * gap / 2, top_z + foot_t / 2)),
                box((0.26 * length, 0.012, 0.7 * r), (0.02, s * (gap / 2 - 0.3 * wide), top_z + 0.35 * r)),
            ]
        )
        parts.append(piece(foot, _B, "", "steel"))
        for q in (-0.1, 0.1):
            parts += bolt_parts(d, foot_t, at(0.02 + q * length, s * gap / 2, top_z), style, "", "none")
    body = along(
        "x",
        turned([(0.6 * r, 0), (r, 0.02), (r, 0.5 * length), (0.9 * r, 0.56 * length)], style.round(r)),
        -0.24 * length,
        0,
        axis,
    )
    shaft = along("x", cylinder(0.16 * r, 0, 0.18 * length, few(0.1 * r, style)), 0.3 * length, 0, axis)
    parts += [Part(body, "motor", "motor", "", "Pump unit"), Part(shaft, "shaft", "trim", "", "Pump unit")]
    if r > gap / 2 - 0.3 * wide:
        return Model(parts)
    pads = [
        box(
            (0.24 * length, gap / 2 - 0.3 * wide - 0.75 * r, 0.3 * r),
            (0.02, s * (gap / 2 - 0.3 * wide + 0.75 * r) / 2, top_z + 0.5 * r),
        )
        for s in (-1, 1)
    ]
    parts.append(Part(merge(pads), "motor", "motor", "", "Pump unit"))
    return Model(parts)


BRACKETS: tuple[Family, ...] = (
    floor_family("bracket/shelf", _shelf, _B),
    floor_family("bracket/instrument stand", _stanchion, _B, 1.5),
    floor_family("bracket/motor slide", _slide, _B),
)
