"""Lamps and beacons on walls, posts, masts and beams."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import GROUP, JOINT, back, beam_over, h_column, hanger, pole, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["LIGHTS"]

_L = "lamp"


def _linear(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Linear luminaires (waterproof, 0.6 to 1.5 m) end to end under a beam on rods, or slanting on a post's bracket."""
    long, w, t = float(rng.choice([0.6, 1.2, 1.5])), float(rng.uniform(0.08, 0.18)), float(rng.uniform(0.05, 0.1))
    n = max(3, style.round(0.05) // 4)
    body = about_x(extrude(rounded_rectangle(w, 0.5 * t, 0.2 * t, 2) + np.array((0.0, 0.25 * t)), -long / 2, long / 2))
    a = np.linspace(np.pi, 2 * np.pi, n + 2)
    cover = about_x(
        extrude(np.column_stack([0.46 * w * np.cos(a), 0.5 * t * np.sin(a)]), -0.98 * long / 2, 0.98 * long / 2)
    )
    clips = [
        box((0.02, 1.04 * w, 0.012), (q * long, 0, 0.0)) for q in np.linspace(-0.44, 0.44, int(rng.integers(2, 6)))
    ]
    ends = [
        along("x" if s > 0 else "-x", hexagon(0.03, -0.002, 0.02), s * long / 2, 0, 0.25 * t)
        for s in (-1, 1)[: int(rng.integers(0, 3))]
    ]
    z, parts = float(rng.uniform(2.2, 3.2)), []
    if rng.random() < 0.6:
        count, drop = int(rng.integers(1, 3)), float(rng.choice([0.0, 0.3, 0.6]))
        for k in range(count):
            p = at(k * (long + 0.1), 0, z)
            parts += [
                Part(moved(merge([body, *clips, *ends]), p), _L, "electrical", _L),
                Part(moved(cover, p), _L, "dial", _L),
            ]
            for q in (-0.35, 0.35):
                x = k * (long + 0.1) + q * long
                if drop:
                    parts.append(
                        Part(hanger(x, 0, z + 0.5 * t - 0.004, z + 0.5 * t + drop), "stud", "fastener", "", JOINT)
                    )
                else:
                    parts.append(
                        Part(box((0.04, 0.6 * w, 0.02), (x, 0, z + 0.5 * t + 0.01)), "bracket", "clamp", "", JOINT)
                    )
        return Model([*parts, *beam_over(-long, count * (long + 0.1) - 0.2, z + 0.5 * t + (drop or 0.02))])
    tilt = float(rng.uniform(0.0, 0.6))
    r = 0.025
    pose = at(0, -0.3, z) @ spun("x", -tilt)
    parts = [
        Part(moved(merge([body, *clips, *ends]), pose), _L, "electrical", _L),
        Part(moved(cover, pose), _L, "dial", _L),
    ]
    seat = (pose @ np.array([0.0, 0.0, 0.5 * t, 1.0]))[:3]
    arm = rope([(0, 0, z - 0.3), (0, -0.1, z + 0.1), (0, float(seat[1]), float(seat[2]) + 0.012)], 0.016, 8)
    foot = moved(box((0.1, 0.06, 0.012)), pose @ at(0, 0, 0.5 * t + 0.005))
    parts.append(Part(merge([arm, foot]), "bracket", "clamp", "", JOINT))
    return Model([*parts, *pole(z, r, style)])


def _flood(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Floodlights with fins and a yoke, one to four on a mast's crossbar, or one on a wall."""
    count = int(rng.choice([1, 2, 2, 3, 4]))
    z = float(rng.uniform(2.5, 5.0)) if count > 1 else float(rng.uniform(1.8, 3.0))
    parts, pitch = [], 0.5
    for k in range(count):
        w, h, d = float(rng.uniform(0.2, 0.4)), float(rng.uniform(0.16, 0.35)), float(rng.uniform(0.05, 0.14))
        x, y, tilt = (k - (count - 1) / 2) * pitch, -0.12 - d - h / 2, float(rng.uniform(0.2, 0.9))
        body = [box((w, d, h)), box((1.05 * w, 0.02, 1.05 * h), (0, -d / 2, 0))]
        fins = [box((0.9 * w, 0.05, 0.005), (0, d / 2 + 0.02, q * h)) for q in np.linspace(-0.42, 0.42, 7)]
        if rng.random() < 0.5:
            fins = [box((0.005, 0.05, 0.9 * h), (q * w, d / 2 + 0.02, 0)) for q in np.linspace(-0.42, 0.42, 9)]
        glass = box((0.92 * w, 0.008, 0.92 * h), (0, -d / 2 - 0.013, 0))
        pose = at(x, y, z) @ spun("x", tilt)
        yoke = [box((0.008, 0.04, 0.04), (s * (w / 2 + 0.012), 0, 0)) for s in (-1, 1)]
        bow = [
            (x - w / 2 - 0.012, y, z),
            (x - w / 2 - 0.012, -0.014, z),
            (x + w / 2 + 0.012, -0.014, z),
            (x + w / 2 + 0.012, y, z),
        ]
        pad = box((0.1, 0.016, 0.05), (x, -0.008, z))
        parts += [
            Part(moved(merge([*body, *fins, *yoke]), pose), _L, "rubber", _L),
            Part(moved(glass, pose), _L, "dial", _L),
            Part(merge([rope(bow, 0.008, 6), pad]), _L, "clamp", _L),
        ]
    if count == 1:
        return Model([*parts, *back(z + 0.4, style, rng, 0.4)])
    bar = box((count * pitch, 0.06, 0.06), (0, 0.03, z))
    r = 0.05
    mast = [
        Part(moved(p.solid, at(0, 0.06 + r)), p.name, p.color, "", p.group, p.fine) for p in pole(z + 0.2, r, style)
    ]
    return Model([*parts, Part(bar, "bracket", "steel", "", JOINT), *mast])


def _bulkhead(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bulkhead light on a wall: oval or round with a cage or a hood, or a well glass on a bracket; conduit to it."""
    kind, z = pick(rng, "oval", "round", "well glass", "hood"), float(rng.uniform(1.8, 2.4))
    s, front = float(rng.uniform(0.07, 0.13)), spun("x", np.pi / 2)
    n = style.round(s)
    conduit = Part(rod((0, -0.02, z + 0.8 * s), (0, -0.02, z + 0.7), 0.0107, 8), "conduit", "clamp")
    if kind == "well glass":
        y = -0.25
        arm = [(0, 0.0, z + 0.1), (0, y + 0.08, z + 0.14), (0, y, z + 0.12), (0, y, z + 0.02)]
        cap = turned([(0.35 * s, 0.04), (0.75 * s, 0.0), (0.8 * s, -0.05), (0.25 * s, -0.06)][::-1], n)
        glass = turned([(0.3 * s, -0.05 - 2.0 * s), (0.6 * s, -0.05 - 1.8 * s), (0.65 * s, -0.05)], n)
        wires = [
            rope(
                [
                    (0.72 * s * np.cos(a), 0.72 * s * np.sin(a), -0.04),
                    (0.72 * s * np.cos(a), 0.72 * s * np.sin(a), -0.05 - 1.8 * s),
                    (0.1 * s * np.cos(a), 0.1 * s * np.sin(a), -0.06 - 2.1 * s),
                ],
                0.004,
                5,
            )
            for a in np.arange(4) * np.pi / 2
        ]
        hoop = moved(torus(0.72 * s, 0.004, 16, 5), at(0, 0, -0.05 - s))
        place = at(0, y, z)
        plate = box((0.1, 0.01, 0.1), (0, -0.005, z + 0.1))
        parts = [
            Part(moved(cap, place), _L, "electrical", _L),
            Part(moved(glass, place), _L, "dial", _L),
            Part(moved(merge([*wires, hoop]), place), _L, "clamp", _L),
            Part(merge([rope(arm, 0.014, 8), plate]), _L, "clamp", _L),
        ]
        if rng.random() < 0.5:
            shade = turned([(2.2 * s, -0.05), (2.25 * s, -0.045), (0.6 * s, 0.045)], n)
            parts.append(Part(moved(shade, place), _L, "electrical", _L))
        return Model([*parts, *back(z + 0.8, style, rng)])
    stretch = 1.6 if kind == "oval" else 1.0
    scale = np.diag([1.0, 1.0, stretch, 1.0])
    base_ = moved(merge([cylinder(s, 0, 0.04, n), cylinder(1.06 * s, 0.035, 0.05, n)]), front)
    glass = moved(dome(0.9 * s, 0.8 * s, 0.05, n), front)
    cage = [
        rope(
            [
                (0.97 * s * np.cos(a), 0.97 * s * np.sin(a), 0.045),
                (0.97 * s * np.cos(a), 0.97 * s * np.sin(a), 0.05 + 0.5 * s),
                (0, 0, 0.07 + 0.9 * s),
            ],
            0.004,
            5,
        )
        for a in np.arange(4) * np.pi / 2
    ]
    cage.append(moved(torus(0.97 * s, 0.004, 20, 5), at(0, 0, 0.05 + 0.4 * s)))
    pose = at(0, 0, z) @ scale
    parts = [Part(moved(base_, pose), _L, "electrical", _L), Part(moved(glass, pose), _L, "dial", _L)]
    if kind == "hood":
        a = np.linspace(0, np.pi, 9)
        arch = np.vstack(
            [
                1.1 * s * np.column_stack([np.cos(a), np.sin(a)]),
                1.06 * s * np.column_stack([np.cos(a), np.sin(a)])[::-1],
            ]
        )
        parts.append(Part(moved(extrude(arch, 0.0, 0.08 + 0.8 * s), pose @ front), _L, "electrical", _L))
    else:
        parts.append(Part(moved(merge(cage), pose @ front), _L, "clamp", _L))
    return Model([*parts, conduit, *([wall(-0.5, 0.5, z + 0.8)] if rng.random() < 0.6 else [h_column(z + 0.8, 0.24)])])


def _high_bay(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """High bay lights: a bell reflector or a finned LED disc with its gear, hung from a beam."""
    parts, count, high = [], int(rng.integers(1, 4)), float(rng.uniform(3.0, 4.5))
    kind = pick(rng, "bell", "disc")
    r, drop = float(rng.uniform(0.15, 0.28)), float(rng.uniform(0.2, 0.8))
    n = style.round(r)
    for k in range(count):
        if kind == "bell":
            gear = turned([(0.3 * r, 0), (0.42 * r, 0.1 * r), (0.42 * r, 0.9 * r), (0.2 * r, 1.05 * r)], n)
            a = np.linspace(0.15, 1.0, 6)
            outer = [(0.3 * r + 0.7 * r * q**0.7, -1.1 * r * q) for q in a][::-1]
            shade = turned([*outer, (0.3 * r, 0.02)], n)
            lens = cylinder(0.96 * r, -1.13 * r, -1.1 * r, n)
            solids = [(merge([gear]), "electrical"), (shade, "clamp"), (lens, "dial")]
            top = 1.05 * r
        else:
            body = turned([(0.95 * r, 0.0), (r, 0.05 * r), (r, 0.2 * r), (0.5 * r, 0.25 * r)], n)
            fins = around(box((0.5 * r, 0.015 * r + 0.002, 0.3 * r), (0.7 * r, 0, 0.3 * r)), int(rng.choice([16, 24])))
            driver = turned([(0.42 * r, 0.24 * r), (0.45 * r, 0.3 * r), (0.45 * r, 0.75 * r), (0.3 * r, 0.8 * r)], n)
            solids = [(merge([body, fins, driver]), "electrical"), (cylinder(0.9 * r, -0.03 * r, 0.001, n), "dial")]
            top = 0.8 * r
        z = high - drop - top
        parts += [Part(moved(s, at(1.2 * k, 0, z)), _L, c, _L) for s, c in solids]
        eye = moved(torus(0.025, 0.006, 12, 6), at(1.2 * k, 0, z + top + 0.022) @ spun("x", np.pi / 2))
        parts.append(Part(eye, _L, "clamp", _L))
        parts.append(
            Part(
                rod((1.2 * k, 0, z + top + 0.04), (1.2 * k, 0, high + 0.001), 0.007, 8),
                "pipe hanger",
                "clamp",
                "",
                JOINT,
            )
        )
        parts.append(
            Part(
                rope(
                    [
                        (1.2 * k + 0.5 * r * 0.3, 0, z + top - 0.02),
                        (1.2 * k + 0.1, 0, z + top + 0.1),
                        (1.2 * k + 0.12, 0, high + 0.002),
                    ],
                    0.006,
                    6,
                ),
                "cable",
                "rubber",
            )
        )
    return Model([*parts, *beam_over(-0.6, 1.2 * count - 0.6, high)])


def _tower(s: float, n: int, z: float, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Coloured lamps in a stack on a cabinet."""
    r, count = 0.03 * s, int(rng.integers(2, 6))
    solids, q = [cylinder(1.1 * r, 0, 0.03, n)], 0.03
    rods = cylinder(0.4 * r, -0.25, 0.0, 10)
    lights = []
    for _k in range(count):
        lights.append(cylinder(r, q, q + 1.6 * r, n))
        solids.append(cylinder(1.04 * r, q + 1.6 * r, q + 1.75 * r, n))
        q += 1.75 * r
    solids.append(dome(r, 0.4 * r, q, n))
    case = [
        box((0.5, 0.3, 0.7), (0, 0, 1.05)),
        box((0.47, 0.02, 0.66), (0, -0.16, 1.05)),
        box((0.1, 0.1, 0.7), (0, 0, 0.35)),
        box((0.35, 0.3, 0.02), (0, 0, 0.01)),
    ]
    pose = at(0.15, 0.05, 1.65)
    return Model(
        [
            Part(moved(merge([*solids, rods]), pose), _L, "rubber", _L),
            *(
                Part(moved(x, pose), _L, c, _L)
                for x, c in zip(lights, ("handle", "safety", "gate", "dial", "motor"), strict=False)
            ),
            Part(merge(case), "control panel", "electrical"),
        ]
    )


def _exit_light(s: float, n: int, z: float, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An exit or emergency light on a wall, maybe with two heads."""
    w, h = 0.3 * s, 0.15 * s
    body, face = box((w, 0.05, h), (0, -0.025, z)), box((0.95 * w, 0.006, 0.9 * h), (0, -0.053, z))
    heads = [
        along("-y", turned([(0.03, 0.0), (0.05, 0.05), (0.05, 0.06)], n), q * (w / 2 - 0.03), -0.04, z + h / 2 + 0.05)
        for q in (-1, 1)
    ]
    necks = [
        rod((q * (w / 2 - 0.03), -0.03, z + h / 2 - 0.01), (q * (w / 2 - 0.03), -0.045, z + h / 2 + 0.03), 0.01, 8)
        for q in (-1, 1)
    ]
    return Model(
        [
            Part(merge([body, *(heads + necks if rng.random() < 0.6 else [])]), _L, "electrical", _L),
            Part(face, _L, "gate", _L),
            wall(-0.6, 0.6, z + 0.6),
        ]
    )


def _flashing(s: float, n: int, z: float, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A caged beacon on a bracket, maybe with a horn below."""
    r = 0.06 * s
    base_ = merge(
        [
            box((2.6 * r, 2.4 * r, 0.03), (0, -1.2 * r, z)),
            box((2.2 * r, 0.02, 1.6 * r), (0, -0.01, z - 0.6 * r)),
            moved(cylinder(1.1 * r, 0.01, 0.04, n), at(0, -1.2 * r, z)),
        ]
    )
    glass = moved(turned([(r, 0.035), (r, 0.035 + 1.6 * r), (0.8 * r, 0.035 + 2.0 * r)], n), at(0, -1.2 * r, z))
    cage = [
        rope(
            [
                (1.06 * r * np.cos(a), 1.06 * r * np.sin(a) - 1.2 * r, z + 0.03),
                (1.06 * r * np.cos(a), 1.06 * r * np.sin(a) - 1.2 * r, z + 0.04 + 1.9 * r),
                (0, -1.2 * r, z + 0.05 + 2.2 * r),
            ],
            0.003,
            5,
        )
        for a in np.arange(4) * np.pi / 2
    ]
    horn = along(
        "-y",
        merge(
            [
                turned([(0.5 * r, 0), (0.55 * r, 0.8 * r), (1.3 * r, 1.9 * r), (1.3 * r, 2.0 * r)], n),
                cylinder(0.8 * r, -0.01, 0.4 * r, n),
            ]
        ),
        0,
        -0.01,
        z - 2.6 * r,
    )
    pad = box((2.2 * r, 0.02, 1.8 * r), (0, -0.01, z - 2.6 * r))
    parts = [Part(base_, _L, "electrical", _L), Part(glass, _L, "handle", _L), Part(merge(cage), _L, "clamp", _L)]
    if rng.random() < 0.6:
        parts.append(Part(merge([horn, pad]), _L, "handle", _L))
    return Model([*parts, *back(z + 0.6, style, rng)])


def _beacon(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Signal lamps: a beacon with a horn on a wall, a stack of coloured lamps on a stem, a traffic or exit light."""
    kind, s = pick(rng, "beacon", "stack", "exit"), float(rng.uniform(0.8, 1.4))
    n, z = style.round(0.05), float(rng.uniform(1.6, 2.4))
    if kind == "stack":
        return _tower(s, n, z, style, rng)
    if kind == "exit":
        return _exit_light(s, n, z, style, rng)
    return _flashing(s, n, z, style, rng)


LIGHTS: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "structure", weight)
    for name, build, weight in (
        ("lamp/linear", _linear, 1.0),
        ("lamp/floodlight", _flood, 1.0),
        ("lamp/bulkhead", _bulkhead, 1.0),
        ("lamp/high bay", _high_bay, 1.0),
        ("lamp/signal", _beacon, 1.0),
    )
)
