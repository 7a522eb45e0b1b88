"""Clamps beside lines: hose clamps, tube couplers, cable cleats, girder clamps."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.shape import (
    GROUP,
    arc_yz,
    bolt_parts,
    few,
    floor_family,
    framed,
    piece,
    slab_yz,
    strap,
    upright,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.primitives import along, bar, box, cylinder, hexagon, ring
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["COUPLES"]


def _hose_clamp(kind: int, out: float, t: float, wide: float, n: int, twin: bool) -> list[tuple[str, Solid]]:
    """A clamp round x over a hose of radius ``out``: its band, what closes it on top, its screw [m]."""
    band = along("x", ring(out, out + t, -wide / 2, wide / 2, n))
    b = 0.35 * wide + 0.002
    if kind == 0:  # a housing with a screw across
        house = merge(
            [
                box((1.15 * wide, 3.2 * b, 1.5 * b), (0, 0, out + t + 0.7 * b)),
                along("y", cylinder(0.75 * b, -1.6 * b, 1.6 * b, 10), 0, 0, out + t + 1.2 * b),
            ]
        )
        screw = merge(
            [
                along("y", cylinder(0.5 * b, 1.5 * b, 3.4 * b, 8), 0, 0, out + t + 1.2 * b),
                along("y", hexagon(1.5 * b, 2.0 * b, 3.4 * b), 0, 0, out + t + 1.2 * b),
            ]
        )
        solids = [("clamp", merge([band, house])), ("screw", screw)]
    elif kind == 1:  # trunnions and a bolt
        lugs = [
            along("x", cylinder(0.8 * b, -0.6 * wide, 0.6 * wide, 10), 0, q * 2.2 * b, out + t + 0.6 * b)
            for q in (-1, 1)
        ]
        bolt = merge(
            [
                along("y", cylinder(0.35 * b, -3.5 * b, 4 * b, 8), 0, 0, out + t + 0.6 * b),
                along("y", hexagon(1.3 * b, 3.0 * b, 3.7 * b), 0, 0, out + t + 0.6 * b),
            ]
        )
        solids = [("clamp", merge([band, *lugs])), ("bolt", bolt)]
    elif kind == 2:  # pinched ears
        ears = [
            slab_yz(
                [
                    [q * 0.3 * b - b, 0],
                    [q * 0.3 * b + b, 0],
                    [q * 0.1 * b + 0.3 * b, 1.6 * b],
                    [q * 0.1 * b - 0.3 * b, 1.6 * b],
                ],
                -wide / 2,
                wide / 2,
            )
            for q in (0,)
        ]
        ear = moved(merge(ears), at(0, 0, out + 0.5 * t))
        both = [ear, moved(ear, spun("x", np.pi))] if twin else [ear]
        solids = [("clamp", merge([band, *both]))]
    else:  # a doubled wire with a screw block
        wires = [along("x", ring(out, out + 2 * t, q - t, q + t, n)) for q in (-0.35 * wide, 0.35 * wide)]
        block = box((wide, 2 * b, 2 * b), (0, 0, out + 2 * t + 0.8 * b))
        screw = along(
            "y",
            merge([cylinder(0.4 * b, -1.5 * b, 3 * b, 8), cylinder(0.8 * b, 3 * b, 3.6 * b, 8)]),
            0,
            0,
            out + 2 * t + b,
        )
        solids = [("clamp", merge([*wires, block])), ("screw", screw)]
    return solids


def _hose(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hose pushed on the end of a pipe and held by clamps: worm drive (DIN 3017), trunnions, ears, wire."""
    r = PIPES[dn].radius
    n, wall = style.round(r), 0.003 + 0.08 * r
    out, over, reach = r + wall, 1.2 * r + 0.03, float(rng.uniform(4, 12)) * r + 0.05
    swing = float(rng.uniform(0, 0.35)) * reach
    s = np.linspace(0, 1, 9)[1:]
    path = np.vstack(
        [
            np.array([[-over, 0.0, 0.0], [0.0, 0.0, 0.0]]),
            np.column_stack([reach * s, np.zeros(8), -swing * (1 - np.cos(np.pi * s / 2)) * s]),
        ]
    )
    hose = tube(path, out, r if style.hollow else 0.0, n)
    parts = [Part(hose, "hose", "rubber", "", "Pipe assembly")]
    kind, t = int(rng.integers(4)), 0.0008 + 0.008 * r
    wide = 0.009 + 0.06 * r
    for x in (-0.5 * over,) if rng.random() < 0.6 else (-0.7 * over, -0.25 * over):
        turn = at(x) @ spun("x", float(rng.uniform(0, 6)))
        solids = _hose_clamp(kind, out, t, wide, n, bool(rng.random() < 0.6))
        for name, solid in solids:
            parts.append(
                piece(moved(solid, turn), name, "clamp", "clamp" if name == "clamp" else "fastener", name != "clamp")
            )
    return Model(parts)


def _coupler(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A frame of tubes (48.3 mm) in right-angle, swivel and parallel couplers (EN 74)."""
    r = float(rng.choice([0.02415, 0.02415, 0.0169, 0.0213]))
    n = style.round(r)
    high, span = float(rng.uniform(0.9, 1.8)), float(rng.uniform(0.7, 1.5))
    t, wide = 0.006, 1.6 * r
    gap = r + t
    parts: list[Part] = []
    slope = float(rng.choice([0.0, 0.0, 0.5, -0.7]))
    slope = float(np.sign(slope)) * min(abs(slope), float(np.arctan(0.6 * high / span)))
    posts = [0.0, span]
    wall = 0.0032 if style.hollow else r
    for x in posts:
        parts.append(framed(moved(ring(r - wall, r, 0.006, high, n), at(x)), "post"))
        parts.append(framed(box((5 * r, 5 * r, 0.006), (x, 0, 0.003)), "base plate"))
    y = 2 * gap
    levels = [0.85 * high] if slope else sorted({0.9 * high, round(float(rng.uniform(0.3, 0.6)) * high, 3)})
    clamp = []
    steps = max(6, n // 2)
    for q in (0, 1):  # two halves round z, with flanges where the bolt sits
        half = strap(arc_yz(r + t / 2, q * np.pi + 0.06, (q + 1) * np.pi - 0.06, steps), wide, t)
        clamp.append(moved(half, spun("y", np.pi / 2)))
    ears = [box((0.022, 0.006, 0.8 * wide), (r + t + 0.008, q * 0.006, 0)) for q in (-1, 1)]
    pin = cylinder(0.005, -0.5 * wide, 0.5 * wide, 8)
    hinge = moved(
        merge([ring(0.005, 0.01, q * wide / 3 - wide / 6, q * wide / 3 + wide / 6 - 0.001, 8) for q in (-1, 0, 1)]),
        at(-r - t - 0.006),
    )
    one = merge([clamp[0], clamp[1], *ears, hinge])
    screw = merge(
        [
            along("y", cylinder(0.006, -0.03, 0.026, 8), r + t + 0.01),
            along("y", hexagon(0.022, 0.01, 0.02), r + t + 0.01),
            along("y", cylinder(0.012, -0.014, -0.009, 10), r + t + 0.01),
        ]
    )
    for z in levels:
        rise = np.tan(slope) * span if slope else 0.0
        low = z - abs(rise) if rise > 0 else z
        a, b = (
            np.array([-0.15, y, low - 0.15 * np.tan(slope)]),
            np.array([span + 0.15, y, low + rise + 0.15 * np.tan(slope)]),
        )
        parts.append(
            framed(
                bar(a, b, circle(r, n), (circle(r - wall, n),) if style.hollow else ()),
                str(rng.choice(["beam", "railing"])) if not slope else "brace",
            )
        )
        for x in posts:
            zx = low + rise * x / span
            lying = at(x, y, zx) @ spun("y", np.pi / 2 - slope)
            parts += [
                piece(moved(one, at(x, 0, zx)), "clamp", "clamp"),
                piece(moved(one, lying), "clamp", "clamp"),
                piece(moved(pin, at(x - r - t - 0.006, 0, zx)), "bolt", "clamp", "fastener", True),
                piece(moved(screw, at(x, 0, zx)), "bolt", "clamp", "fastener", True),
                piece(moved(screw, lying), "bolt", "clamp", "fastener", True),
            ]
    return Model(parts)


def _cleat_solids(kind: int, q: float, wide: float) -> tuple[list[Solid], list[float], float]:
    """A cleat over cables of radius ``q`` that lie on z = 0, where its bolts go and what they clamp [m]."""
    t = 0.003
    if kind == 0:
        ear, knee = 2 * q + 0.02, np.pi / 6
        right = arc_yz(q + t / 2, -0.25, knee, 4, q, q)
        crown = arc_yz(q + t / 2, knee, np.pi - knee, 6, 0.0, q + np.sqrt(3) * q)
        left = (right * (1, -1, 1))[::-1]
        foot = [[0, 2 * q + t / 2 + 0.002, t / 2], [0, 2 * q + ear, t / 2]]
        path = np.vstack([foot[::-1], right[1:], crown, left[:-1], [[0, -y, z] for _, y, z in foot]])
        solids = [strap(path, wide, t)]
        spots = [-2 * q - 0.6 * ear, 2 * q + 0.6 * ear]
        grip = t
    elif kind == 1:
        a = np.linspace(0, np.pi, 9)
        reach = q + 0.014
        hollow = np.column_stack([q * np.cos(a), q * np.sin(a)])[::-1]
        upper = slab_yz(
            [
                [-reach, 0.0005],
                *hollow[1:-1],
                [reach, 0.0005],
                [reach, 0.6 * q],
                [0.5 * reach, q + 0.006],
                [-0.5 * reach, q + 0.006],
                [-reach, 0.6 * q],
            ],
            -wide / 2,
            wide / 2,
        )
        lower = slab_yz(
            [
                [-reach, -0.0005],
                *(hollow[1:-1] * (1, -1)),
                [reach, -0.0005],
                [reach, -q - 0.004],
                [-reach, -q - 0.004],
            ],
            -wide / 2,
            wide / 2,
        )
        solids = [moved(upper, at(0, 0, q + 0.004)), moved(lower, at(0, 0, q + 0.004))]
        spots, grip = [-reach + 0.006, reach - 0.006], 1.6 * q + 0.004
    else:
        path = np.vstack(
            [
                [[0, q + 0.02, t / 2]],
                [[0, q + t / 2, t / 2]],
                arc_yz(q + t / 2, 0, np.pi, 8, 0.0, q + 0.004),
                [[0, -q - t / 2, t / 2], [0, -q - 0.02, t / 2]],
            ]
        )
        solids = [strap(path, wide, t)]
        spots, grip = [-q - 0.012, q + 0.012], t
    return solids, spots, grip


def _cleat(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cables in cleats (IEC 61914) on a ladder or struts: trefoil of sheet, blocks, straps."""
    q = float(rng.uniform(0.012, 0.032))
    n = few(q, style, 20)
    length, pitch, high = float(rng.uniform(1.0, 2.2)), float(rng.uniform(0.3, 0.5)), float(rng.uniform(0.3, 1.2))
    kind = int(rng.integers(3))
    parts: list[Part] = []
    top = high
    centers = [(-q, q), (q, q), (0.0, q + np.sqrt(3) * q)] if kind == 0 else [(0.0, q + 0.004)]
    rows = [0.0] if kind == 0 else [k * (2 * q + 0.03) for k in range(int(rng.integers(1, 4)))]
    for y0 in rows:
        for y, z in centers:
            cable = along("x", cylinder(q, -length / 2, length / 2, n), 0, y0 + y, top + z)
            parts.append(Part(cable, "cable", "rubber", "", "Electrical and safety"))
    xs = np.arange(-length / 2 + 0.12, length / 2 - 0.08, pitch)
    middle = float(np.mean(rows))
    half = (rows[-1] - rows[0]) / 2 + 3 * q + 0.06
    wide = 0.03 + 0.5 * q
    for x in xs:
        rung = section_channel(0.041, 0.041, 0.0025, 0.0025) @ np.array([[0.0, -1.0], [1.0, 0.0]])
        parts.append(
            framed(
                bar((x, middle - half, top), (x, middle + half, top), rung),
                str(rng.choice(["beam", "beam", "plate"])),
                "clamp",
            )
        )
        for y0 in rows:
            solids, spots, grip = _cleat_solids(kind, q, wide)
            for solid in solids:
                parts.append(
                    piece(
                        moved(solid, at(float(x), y0, top)),
                        "clamp",
                        "clamp",
                        str(rng.choice(["clamp", "clamp", "rubber"])),
                    )
                )
            for y in spots:
                parts += bolt_parts(0.006, grip, at(float(x), y0 + y, top), style, "clamp", "none")
    for s in (-1, 1):
        rail = box((length, 0.004, 0.06), (0, middle + s * (half + 0.002), top - 0.02))
        parts.append(framed(rail, "beam", "clamp"))
        for x in (-0.35 * length, 0.35 * length):
            parts.append(
                framed(box((0.05, 0.05, top - 0.05), (x, middle + s * (half - 0.02), (top - 0.05) / 2)), "post")
            )
    return Model(parts)


def _girder(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two beams that cross, held by clamp jaws and bolts with a plate between them, nothing drilled or welded."""
    h, b = float(rng.choice([0.12, 0.16, 0.2])), float(rng.choice([0.1, 0.14]))
    web, f = 0.006, 0.01
    d = float(rng.choice([0.012, 0.016]))
    length, z = float(rng.uniform(0.8, 1.6)), float(rng.uniform(0.5, 1.2))
    section = section_i(h, b, web, f)
    plate_t = float(rng.choice([0.0, 0.01, 0.015]))
    top = z + h + plate_t
    parts = [framed(bar((-length / 2, 0, z + h / 2), (length / 2, 0, z + h / 2), section), "beam")]
    parts.append(framed(bar((0, -length / 2, top + h / 2), (0, length / 2, top + h / 2), section), "beam"))
    q = b / 2 + 0.7 * d
    if plate_t:
        parts.append(framed(box((2 * q + 3 * d, 2 * q + 3 * d, plate_t), (0, 0, z + h + plate_t / 2)), "plate"))
    grip = 2 * f + plate_t
    form = int(rng.integers(3))
    for sx in (-1, 1):
        for sy in (-1, 1):
            low, high = z + h - f, top + f
            tail = 1.4 * d
            for level, way, turn in (
                (high, 1.0, spun("z", np.pi if sx > 0 else 0.0)),
                (low, -1.0, spun("z", -np.pi / 2 if sy > 0 else np.pi / 2)),
            ):
                # A jaw: its nose on the flange, its tail on the plate or the other flange.
                if form == 0:
                    jaw = upright(
                        [
                            [-tail, -f],
                            [-0.6 * tail, -f],
                            [-0.6 * tail, 0],
                            [1.6 * d, 0],
                            [1.6 * d, 0.5 * d],
                            [0.3 * d, 1.0 * d],
                            [-tail, 0.8 * d],
                        ],
                        -1.1 * d,
                        1.1 * d,
                    )
                elif form == 1:
                    jaw = merge(
                        [
                            box((3.0 * d, 2.4 * d, 0.5 * d), (0.1 * d, 0, 0.25 * d)),
                            box((0.5 * d, 2.4 * d, f), (-tail + 0.25 * d, 0, -f / 2)),
                        ]
                    )
                else:
                    jaw = moved(extrude(rounded_rectangle(3.2 * d, 2.2 * d, 0.9 * d, 3), 0, 0.7 * d), at(0.1 * d))
                mirror = np.diag([1.0, 1.0, way, 1.0])
                parts.append(piece(moved(jaw, at(sx * q, sy * q, level) @ turn @ mirror), "clamp", "clamp"))
            raise_ = {0: 0.8, 1: 0.5, 2: 0.7}[form] * d
            parts += bolt_parts(d, grip + 2 * raise_, at(sx * q, sy * q, low - raise_), style, "clamp")
    for s in (-1, 1):
        x = s * (length / 2 - 0.08)
        parts.append(framed(box((0.1, b, z), (x, 0, z / 2)), str(rng.choice(["post", "column", "foundation"]))))
    return Model(parts)


COUPLES: tuple[Family, ...] = (
    Family("clamp/hose", "end", GROUP, "clamp", _hose, SIZES[:9], "structure"),
    floor_family("clamp/coupler", _coupler, "clamp"),
    floor_family("clamp/cleat", _cleat, "clamp"),
    floor_family("clamp/girder", _girder, "clamp"),
)
