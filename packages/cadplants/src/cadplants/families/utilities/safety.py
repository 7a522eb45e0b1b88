"""Electrical and safety: trays, conduits, boxes, panels, lamps, cameras, signs, extinguishers, hydrants."""

from __future__ import annotations

import numpy as np

from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, lattice, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["SAFETY"]

_GROUP = "Electrical and safety"


def _post(h: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    r = float(rng.uniform(0.02, 0.04))
    pole = (
        cylinder(r, 0.01, h, max(6, style.round(r)))
        if rng.random() < 0.6
        else box((2 * r, 2 * r, h - 0.01), (0, 0, (h + 0.01) / 2))
    )
    foot = box((0.16, 0.16, 0.01), (0, 0, 0.005))
    return [
        Part(pole, "post", "clamp", "", "Structural element"),
        Part(foot, "base plate", "clamp", "", "Structural element"),
    ]


def _tray(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cable tray (IEC 61537): ladder, perforated or wire basket, on posts, with cables in it."""
    length, w, side, z = (
        float(rng.uniform(1.5, 4.0)),
        float(rng.choice([0.1, 0.2, 0.3, 0.45])),
        float(rng.choice([0.05, 0.08, 0.1])),
        float(rng.uniform(0.6, 2.5)),
    )
    kind = int(rng.integers(3))
    if kind == 0:
        rails = [box((length, 0.015, side), (length / 2, s * w / 2, z + side / 2)) for s in (-1, 1)]
        rungs = [box((0.03, w, 0.015), (x, 0, z + 0.02)) for x in np.arange(0.15, length, 0.3)]
        tray = merge([*rails, *rungs])
    elif kind == 1:
        nx, ny = int(np.clip(length / 0.1, 4, 24)), int(np.clip(w / 0.05, 2, 6))
        xs = np.sort(
            np.concatenate([np.linspace(0, length, nx + 1)[:-1], np.linspace(0, length, nx + 1)[:-1] + 0.06, [length]])
        )
        ys = np.sort(
            np.concatenate(
                [
                    np.linspace(-w / 2, w / 2, ny + 1)[:-1],
                    np.linspace(-w / 2, w / 2, ny + 1)[:-1] + 0.6 * w / ny,
                    [w / 2],
                ]
            )
        )
        filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
        filled[::2], filled[:, ::2] = True, True
        filled[-1], filled[:, -1] = True, True
        tray = merge(
            [
                lattice(xs, ys, filled, z, z + 0.0015),
                *(box((length, 0.0015, side), (length / 2, s * w / 2, z + side / 2)) for s in (-1, 1)),
            ]
        )
    else:
        wires = [
            rod((0, y, z + dz), (length, y, z + dz), 0.0025, 6)
            for y, dz in [
                (-w / 2, side),
                (-w / 2, side / 2),
                (w / 2, side / 2),
                (w / 2, side),
                *((y, 0.0) for y in np.linspace(-w / 2, w / 2, 4)),
            ]
        ]
        hoops = [
            rope([(x, -w / 2, z + side), (x, -w / 2, z), (x, w / 2, z), (x, w / 2, z + side)], 0.0025, 6)
            for x in np.arange(0.05, length, 0.1)
        ]
        tray = merge([*wires, *hoops])
    parts = [Part(tray, "cable tray", "clamp")]
    for k in range(int(rng.integers(0, 5))):
        r = float(rng.uniform(0.005, 0.016))
        y = float(rng.uniform(-0.4, 0.4)) * w
        path = [(f * length, y + 0.05 * w * np.sin(3 * f + k), z + 0.03 + r) for f in np.linspace(-0.05, 1.05, 7)]
        parts.append(Part(rope(path, r, max(6, min(12, style.round(r)))), "cable", "rubber"))
    for x in (0.15 * length, 0.85 * length):
        parts.append(
            Part(box((0.05, 0.05, z - 0.03), (x, 0, (z - 0.03) / 2)), "post", "steel", "", "Structural element")
        )
        parts.append(Part(box((0.05, w + 0.1, 0.03), (x, 0, z - 0.015)), "bracket", "steel", "", "Connection assembly"))
    return Model(parts)


def _conduit(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Conduits on a wall with saddles, bends, junction boxes with covers and glands, a flexible tail."""
    r, h = float(rng.choice([0.008, 0.01, 0.0125, 0.016])), float(rng.uniform(1.0, 2.2))
    n = max(6, min(12, style.round(r)))
    wall = box((2.4, 0.15, h + 0.4), (1.0, 0.1, (h + 0.4) / 2))
    parts = [Part(wall, "wall", "concrete", "", "Structural element")]
    for k in range(int(rng.integers(1, 4))):
        x = 0.3 * k
        y = 0.025 - r - 0.005
        a = [
            (x, y, 0.1),
            (x, y, h - 0.15 - 0.1 * k),
            (x + 0.02, y, h - 0.07 - 0.1 * k),
            (x + 0.1, y, h - 0.05 - 0.1 * k),
            (1.7 + 0.1 * k, y, h - 0.05 - 0.1 * k),
        ]
        parts.append(Part(rope(a, r, n), "conduit", "clamp"))
        for z in (0.4, 0.5 * h):
            a_ = np.linspace(0, np.pi, 7)
            band = np.vstack(
                [
                    [(r + 0.02, 0)],
                    (r + 0.002) * np.column_stack([np.cos(a_), np.sin(a_)]),
                    [(-r - 0.02, 0)],
                    [(-r - 0.02, 0.002)],
                ]
            )
            strap = merge(
                [
                    box((2 * r + 0.04, 0.002, 0.015), (x, y + r + 0.001, z)),
                    moved(ring(r, r + 0.002, -0.0075, 0.0075, 12), at(x, y, z)),
                ]
            )
            del band
            parts.append(Part(strap, "clamp", "clamp", "", "Connection assembly"))
        s = float(rng.uniform(0.08, 0.16))
        case = merge(
            [
                box((s, 0.6 * s, s), (1.75 + 0.1 * k + 0.4 * s, 0.025 - 0.3 * s, h - 0.05 - 0.1 * k)),
                box((1.04 * s, 0.1 * s, 1.04 * s), (1.75 + 0.1 * k + 0.4 * s, 0.025 - 0.64 * s, h - 0.05 - 0.1 * k)),
            ]
        )
        parts.append(Part(case, "junction box", "electrical"))
        break_after = rng.random() < 0.5
        if break_after:
            tail = [
                (1.75 + 0.4 * s, 0.025 - 0.3 * s, h - 0.05 - 0.5 * s),
                (1.75 + 0.4 * s, -0.02, h - 0.4),
                (1.9, -0.2, h - 0.7),
                (2.1, -0.3, 0.3),
            ]
            parts.append(Part(rope(tail, 0.8 * r, n), "cable", "rubber"))
            break
    return Model(parts)


def _junction(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A junction box or local control station on a post: lid with screws, glands below, buttons, cables."""
    h, s = float(rng.uniform(0.9, 1.5)), float(rng.uniform(0.08, 0.3))
    d = float(rng.uniform(0.4, 0.7)) * s
    tall = s * float(rng.uniform(0.8, 2.0))
    n = 12
    case = moved(extrude(rounded_rectangle(s, tall, 0.08 * s, 3), 0.0, d), at(0, -0.04, h) @ spun("x", np.pi / 2))
    lid = moved(
        extrude(rounded_rectangle(1.02 * s, 1.02 * tall, 0.08 * s, 3), d, 1.15 * d),
        at(0, -0.04, h) @ spun("x", np.pi / 2),
    )
    glands = [
        moved(
            merge([hexagon(0.026, -0.02, 0.0), cylinder(0.01, -0.035, 0.0, n)]), at(x * s, -0.04 - d / 2, h - tall / 2)
        )
        for x in (-0.25, 0.25)
    ]
    solids = [case, lid, *glands]
    if rng.random() < 0.5:
        solids += [
            along(
                "-y",
                merge([cylinder(0.016, 0, 0.02, n), cylinder(0.02, 0.0, 0.008, n)]),
                0,
                -0.04 - 1.15 * d,
                h + z * tall,
            )
            for z in (-0.25, 0.0, 0.25)
        ]
    name = "junction box"
    cables = [
        Part(
            rope(
                [(x * s, -0.04 - d / 2, h - tall / 2 - 0.03), (x * s, -0.05, h - tall / 2 - 0.2), (x * s, 0.04, 0.15)],
                0.007,
                8,
            ),
            "cable",
            "rubber",
        )
        for x in (-0.25, 0.25)
        if rng.random() < 0.7
    ]
    return Model([*(Part(x, name, "electrical", name) for x in solids), *cables, *_post(h + 0.1, style, rng)])


def _panel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A control panel: a wall box on legs, a desk with a sloping top, or a row of doors with handles and lamps."""
    kind, name = int(rng.integers(3)), "control panel"
    w, d, h = float(rng.uniform(0.4, 1.0)), float(rng.uniform(0.2, 0.4)), float(rng.uniform(0.5, 1.1))
    if kind == 0:
        z = float(rng.uniform(0.6, 1.0))
        case = box((w, d, h), (0, 0, z + h / 2))
        door = box((w - 0.03, 0.015, h - 0.03), (0, -d / 2 - 0.0075, z + h / 2))
        knobs = merge(
            [
                along("-y", cylinder(0.015, 0, 0.02, 12), x * w, -d / 2 - 0.015, z + 0.8 * h)
                for x in (-0.3, -0.1, 0.1, 0.3)
            ]
            + [box((0.3 * w, 0.004, 0.15 * h), (0, -d / 2 - 0.017, z + 0.55 * h))]
        )
        legs = [
            Part(box((0.05, 0.05, z), (sx * 0.4 * w, sy * 0.3 * d, z / 2)), "post", "steel", "", "Structural element")
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
        return Model(
            [
                Part(case, name, "electrical", name),
                Part(door, name, "electrical", name),
                Part(knobs, name, "rubber", name),
                *legs,
            ]
        )
    if kind == 1:
        outline = np.array([[-0.35, 0], [0.35, 0], [0.35, 1.1], [0.1, 1.1], [-0.35, 0.85]])
        desk = extrude(outline, -w, w)
        desk = moved(Solid(desk.vertices[:, [2, 0, 1]], desk.faces), at())
        screen = moved(box((0.5, 0.02, 0.3)), at(0, 0.05, 1.35) @ spun("x", -0.2))
        foot = box((0.06, 0.04, 0.15), (0, 0.1, 1.15))
        return Model([Part(desk, name, "electrical", name), Part(merge([screen, foot]), name, "rubber", name)])
    count = int(rng.integers(2, 5))
    parts = []
    for k in range(count):
        x = 0.62 * k
        case = box((0.6, 0.5, 1.9), (x, 0, 0.95))
        door = box((0.56, 0.015, 1.75), (x, -0.2575, 0.97))
        bits = merge(
            [
                box((0.02, 0.03, 0.14), (x + 0.23, -0.28, 1.0)),
                *(along("-y", cylinder(0.012, 0, 0.015, 10), x + dx, -0.265, 1.65) for dx in (-0.1, 0.0, 0.1)),
                box((0.3, 0.006, 0.2), (x, -0.267, 0.35)),
            ]
        )
        parts += [
            Part(case, name, "electrical", name),
            Part(door, name, "electrical", name),
            Part(bits, name, "rubber", name),
        ]
    return Model(parts)


def _lamp(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lamp: a bulkhead light with a cage, a tube light, a floodlight or a bent-arm street lamp, on a post."""
    kind, name, n = int(rng.integers(4)), "lamp", style.round(0.08)
    h = float(rng.uniform(1.8, 3.5))
    parts = _post(h, style, rng)
    if kind == 0:
        base = turned([(0.09, 0), (0.09, 0.03), (0.07, 0.04)], n)
        glass = dome(0.065, 0.1, 0.04, n)
        cage = merge(
            [
                rope(
                    [
                        (0.08 * np.cos(a), 0.08 * np.sin(a), 0.03),
                        (0.08 * np.cos(a), 0.08 * np.sin(a), 0.1),
                        (0, 0, 0.16),
                    ],
                    0.003,
                    6,
                )
                for a in (0.0, 1.57, 3.14, 4.71)
            ]
            + [moved(torus(0.08, 0.003, 16, 6), at(0, 0, 0.09))]
        )
        pose = at(0, -0.03, h - 0.1) @ spun("x", np.pi / 2)
        parts += [
            Part(moved(base, pose), name, "clamp", name),
            Part(moved(glass, pose), name, "dial", name),
            Part(moved(cage, pose), name, "clamp", name),
        ]
    elif kind == 1:
        body = along("x", extrude(rounded_rectangle(0.1, 0.12, 0.03, 3), -0.6, 0.6), 0, 0, h)
        tubes = [along("x", cylinder(0.013, -0.57, 0.57, 10), 0, y, h - 0.062) for y in (-0.03, 0.03)]
        parts += [Part(body, name, "electrical", name), Part(merge(tubes), name, "dial", name)]
    elif kind == 2:
        head = moved(
            merge(
                [
                    box((0.3, 0.08, 0.22)),
                    *(box((0.28, 0.04, 0.006), (0, 0.05, z)) for z in np.linspace(-0.09, 0.09, 7)),
                    box((0.26, 0.006, 0.18), (0, -0.042, 0)),
                ]
            ),
            at(0, -0.1, h) @ spun("x", 0.6),
        )
        bow = rope([(-0.17, -0.1, h), (-0.17, 0, h - 0.12), (0.17, 0, h - 0.12), (0.17, -0.1, h)], 0.01, 6)
        parts += [Part(merge([head, bow]), name, "rubber", name)]
    else:
        arm = rope(
            [(0, 0, h - 0.05), (0, 0, h + 0.3), (0.1, 0, h + 0.45), (0.5, 0, h + 0.5)], 0.022, max(6, style.round(0.02))
        )
        head = moved(turned([(0.05, 0.0), (0.17, -0.08), (0.17, -0.1)][::-1], n), at(0.55, 0, h + 0.52))
        parts += [Part(arm, name, "clamp", name), Part(head, name, "electrical", name)]
    return Model(parts)


def _camera(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A camera: a bullet in a hood, a dome, or a box, on an arm from a post."""
    kind, name, n, h = int(rng.integers(3)), "camera", style.round(0.04), float(rng.uniform(1.8, 3.0))
    arm = rope([(0, 0, h - 0.05), (0, -0.16, h - 0.05), (0, -0.2, h)], 0.014, 8)
    if kind == 0:
        body = merge(
            [
                along("-y", turned([(0.035, 0), (0.038, 0.15), (0.03, 0.16)], n)),
                box((0.09, 0.22, 0.005), (0, -0.09, 0.042)),
                along("-y", cylinder(0.02, 0.155, 0.165, n)),
            ]
        )
        body = moved(body, at(0, -0.15, h + 0.03) @ spun("x", 0.25))
    elif kind == 1:
        body = moved(
            merge(
                [
                    turned([(0.06, -0.01), (0.065, 0.02), (0.065, 0.06)], n),
                    moved(dome(0.055, 0.055, 0.0, n), spun("x", np.pi)),
                ]
            ),
            at(0, -0.2, h - 0.03),
        )
    else:
        body = moved(
            merge([box((0.08, 0.18, 0.08)), along("-y", cylinder(0.03, 0.085, 0.13, n))]), at(0, -0.22, h + 0.05)
        )
    return Model([Part(body, name, "dial", name), Part(arm, name, "clamp", name), *_post(h, style, rng)])


def _sign(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sign: square, round, triangular or octagonal plate, on a post or on four feet."""
    h, s = float(rng.uniform(1.0, 2.0)), float(rng.uniform(0.12, 0.35))
    kind = int(rng.integers(4))
    outline = (
        rounded_rectangle(2 * s, 1.4 * s, 0.1 * s, 3),
        circle(s, max(12, style.round(s))),
        circle(s, 3, phase=np.pi / 2),
        circle(s, 8, phase=np.pi / 8),
    )[kind]
    plate = moved(extrude(outline, 0.0, 0.003), at(0, -0.042, h) @ spun("x", np.pi / 2))
    return Model([Part(plate, "sign", "safety"), *_post(h + s, style, rng)])


def _extinguisher(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire extinguisher (EN 3): a bottle with a domed shoulder, valve, levers, hose; on the floor or on a wall."""
    name, r = "fire extinguisher", float(rng.uniform(0.05, 0.1))
    n, h = style.round(r), float(rng.uniform(4.0, 6.5)) * r
    low = float(rng.choice([0.0, 0.0, 0.6]))
    body = turned(
        [
            (0.9 * r, low),
            (r, low + 0.1 * r),
            (r, low + h),
            *((r * np.cos(a), low + h + 0.8 * r * np.sin(a)) for a in (0.4, 0.8, 1.2)),
            (0.3 * r, low + h + 0.85 * r),
            (0.3 * r, low + h + 1.0 * r),
        ],
        n,
    )
    top = low + h + 0.98 * r
    valve = merge([hexagon(0.7 * r, top, top + 0.4 * r), cylinder(0.22 * r, top, top + 0.6 * r, 10)])
    levers = [
        box((1.5 * r, 0.25 * r, 0.06 * r), (0.55 * r, 0, top + 0.65 * r)),
        moved(box((1.5 * r, 0.22 * r, 0.06 * r), (0.75 * r, 0, 0)), at(0, 0, top + 0.72 * r) @ spun("y", -0.25)),
    ]
    gauge = along("-y", cylinder(0.2 * r, 0.0, 0.15 * r, 10), 0, -0.3 * r, top + 0.2 * r)
    hose = rope(
        [
            (-0.2 * r, 0, top + 0.25 * r),
            (-1.0 * r, 0, top + 0.3 * r),
            (-1.3 * r, 0, low + 0.8 * h),
            (-1.2 * r, 0, low + 0.25 * h),
        ],
        0.12 * r,
        8,
    )
    nozzle_ = merge([rod((-1.2 * r, 0, low + 0.26 * h), (-1.2 * r, 0, low + 0.1 * h), 0.2 * r, 8)])
    parts = [
        Part(body, name, "handle", name),
        Part(merge([valve, *levers, gauge]), name, "trim", name),
        Part(merge([hose, nozzle_]), name, "rubber", name),
    ]
    if low:
        parts.append(Part(box((0.3, 0.03, 1.5), (0, r + 0.017, 0.75)), "wall", "concrete", "", "Structural element"))
        parts.append(
            Part(
                box((0.5 * r, 0.03, 0.1), (0, r + 0.002, low + 0.8 * h)), "bracket", "steel", "", "Connection assembly"
            )
        )
    return Model(parts)


def _hydrant(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pillar hydrant (EN 14384): a flanged barrel, a bonnet with a pentagon nut, two or three capped outlets."""
    name, r = "hydrant", float(rng.uniform(0.07, 0.12))
    n, h = style.round(r), float(rng.uniform(0.6, 1.0))
    barrel = merge(
        [
            turned(
                [(1.9 * r, 0.0), (1.9 * r, 0.03), (r, 0.04), (r, h), (1.25 * r, h + 0.02), (1.25 * r, h + 0.3 * r)], n
            ),
            *(cylinder(1.25 * r, z, z + 0.03, n) for z in (0.25 * h, 0.25 * h + 0.032)),
        ]
    )
    bonnet = merge(
        [
            moved(dome(1.2 * r, 1.0 * r, h + 0.3 * r, n), at()),
            turned([(0.3 * r, h + 1.2 * r), (0.3 * r, h + 1.5 * r)], 5),
        ]
    )
    outs = []
    for angle, size in ((0.0, 0.75), (np.pi, 0.55), (-np.pi / 2, 0.55))[: int(rng.integers(2, 4))]:
        stub = along(
            "x",
            merge(
                [
                    cylinder(size * r, 0.8 * r, 1.5 * r, n),
                    cylinder(1.2 * size * r, 1.4 * r, 1.75 * r, n),
                    cylinder(0.3 * size * r, 1.7 * r, 2.0 * r, 5),
                ]
            ),
            0,
            0,
            0.82 * h,
        )
        outs.append(moved(stub, spun("z", angle)))
    bolts = around(hexagon(0.024, 0.03, 0.045), 6, 1.6 * r)
    return Model(
        [
            Part(barrel, name, "handle", name),
            Part(bonnet, name, "handle", name),
            Part(merge(outs), name, "handle", name),
            Part(bolts, "bolt", "fastener", name, "Connection assembly", True),
        ]
    )


def _shower(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire hose reel or box: a cabinet with a round reel and a coiled hose."""
    name, r, z = "fire extinguisher", 0.26, 1.0
    reel = [along("y", cylinder(r, y, y + 0.01, style.round(r)), 0, 0, z) for y in (-0.12, 0.02)]
    coil = [
        moved(
            torus(0.8 * r - 0.02 * (k % 2), 0.015, max(12, style.round(r)), 6),
            at(0, -0.1 + 0.03 * k, z) @ spun("x", np.pi / 2),
        )
        for k in range(4)
    ]
    tail = rope([(0.78 * r, -0.05, z), (0.9 * r, -0.1, z - 0.3), (0.6 * r, -0.15, z - 0.5)], 0.013, 8)
    arm = box((0.08, 0.16, 0.4), (0, 0.12, z))
    wall = box((0.9, 0.15, 1.8), (0, 0.275, 0.9))
    return Model(
        [
            Part(merge([*reel, arm]), name, "handle", name),
            Part(merge([*coil, tail]), "hose", "rubber", "", "Pipe assembly"),
            Part(wall, "wall", "concrete", "", "Structural element"),
        ]
    )


def _family(name: str, build: object, weight: float = 1.0) -> Family:
    whole = name.split("/")[0]
    grain = "fitting" if whole in ("cable tray", "conduit", "sign") else "structure"
    return Family(name, "floor", _GROUP, whole, build, (15,), grain, weight)  # type: ignore[arg-type]


SAFETY: tuple[Family, ...] = (
    _family("cable tray/ladder and basket", _tray, 1.5),
    _family("conduit/wall", _conduit),
    _family("junction box/post", _junction),
    _family("control panel/station", _panel, 1.2),
    _family("lamp/head", _lamp),
    _family("camera/post", _camera, 1.5),
    _family("sign/shapes", _sign),
    _family("fire extinguisher/bottle", _extinguisher),
    _family("fire extinguisher/reel", _shower, 0.6),
    _family("hydrant/pillar", _hydrant, 1.5),
)
