"""Fasteners at work: swing bolts of a cover, T-bolts and nuts of struts, pins and turnbuckles of tension rods."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.fastener import head_solid, nut_solid
from cadplants.families.supports.shape import few, floor_family, framed, piece, strap, upright
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_i
from cadplants.primitives import along, bar, box, cylinder, dome, ring, rod
from cadplants.transforms import at, spun

__all__ = ["JOINTS"]


def _swing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A round cover on a neck held by swing bolts (DIN 444) in forked lugs, with wing, star, cap or hexagon nuts."""
    r, high = float(rng.uniform(0.1, 0.3)), float(rng.uniform(0.1, 0.4))
    n = style.round(r)
    d, count = float(rng.choice([0.01, 0.012, 0.016])), int(rng.choice([4, 6, 8, 10]))
    t = 0.012
    neck = ring(r - 0.006, r, 0.0, high, n)
    parts = [
        Part(merge([neck, ring(r - 0.006, r + 0.02, high - 0.012, high, n)]), "manway", "tank", "", "Tank"),
        framed(cylinder(r + 0.06, -0.012, 0.0, n), "plate"),
    ]
    lid = [cylinder(r + 0.02, high, high + t, n)]
    if rng.random() < 0.6:
        lid.append(dome(0.95 * r, 0.25 * r, high + t, n))
    parts.append(Part(merge(lid), "manway", "tank", "", "Tank"))
    out = r + 0.02 + 1.1 * d
    nut = str(rng.choice(["wing", "star", "cap", "hex", "knurled", "flange"]))
    low = high - 0.012 - 2.4 * d
    for k in range(count):
        pose = spun("z", 2 * np.pi * k / count) @ at(out)
        forks = merge([box((2.4 * d + 0.022, 0.5 * d, 2.2 * d), (-0.011, s * 0.8 * d, low)) for s in (-1, 1)])
        ears = merge([box((2.2 * d, 0.5 * d, t), (-0.4 * d, s * 0.85 * d, high + t / 2)) for s in (-1, 1)])
        pin = along("y", cylinder(0.4 * d, -1.4 * d, 1.4 * d, 8), 0, 0, low)
        head = moved(head_solid("ring", d, style), at(0, 0, low - d))
        shank = cylinder(
            d / 2, low + 0.8 * d, high + t + 3.2 * d if nut not in ("cap",) else high + t + 0.8 * d, few(d / 2, style)
        )
        parts += [
            piece(moved(forks, pose), "bracket", "", "steel"),
            piece(moved(ears, pose), "bracket", "", "steel"),
            piece(moved(pin, pose), "bolt", "", "fastener", True),
            piece(moved(merge([head, shank]), pose), "bolt", "", "fastener"),
            piece(
                moved(nut_solid(nut, d, style), pose @ at(0, 0, high + t + 0.002) @ spun("z", 0.3 * k)),
                "nut",
                "",
                "fastener",
            ),
            piece(moved(ring(0.54 * d, 1.2 * d, high + t, high + t + 0.002, 10), pose), "washer", "", "fastener", True),
        ]
    return Model(placed(parts, at(0, 0, 0.012)))


def _slotted(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Struts with slots on a frame, plates and angles on them by hammer-head bolts, channel nuts and square washers."""
    s, t = 0.041, 0.0025
    length, count, d = float(rng.uniform(0.6, 1.6)), int(rng.integers(2, 5)), float(rng.choice([0.008, 0.01, 0.012]))
    gap, high = float(rng.uniform(0.25, 0.5)), float(rng.uniform(0.3, 1.0))
    lip = 0.0095
    parts: list[Part] = []
    for y in (0.0, gap):
        sides = [box((length, t, s), (0, y + q * (s / 2 - t / 2), high - s / 2)) for q in (-1, 1)]
        lips = [box((length, lip, t), (0, y + q * (s / 2 - lip / 2), high - t / 2)) for q in (-1, 1)]
        parts.append(framed(merge([box((length, s, t), (0, y, high - s + t / 2)), *sides, *lips]), "beam", "clamp"))
        for x in (-0.42 * length, 0.42 * length):
            parts.append(framed(box((s, s, high - s), (x, y, (high - s) / 2)), "post", "clamp"))
            parts.append(framed(box((0.12, 0.12, 0.006), (x, y, -0.003)), "base plate"))
    for x in np.linspace(-0.33 * length, 0.33 * length, count):
        kind = int(rng.integers(4))
        ty = 0.006
        if kind == 0:
            parts.append(framed(box((0.05, gap + 0.06, ty), (x, gap / 2, high + ty / 2)), "plate"))
            spots = [0.0, gap]
        elif kind == 1:
            angle = merge(
                [
                    box((0.05, 0.05, ty), (x, 0, high + ty / 2)),
                    box((ty, 0.05, 0.06), (x + 0.025 - ty / 2, 0, high + 0.03)),
                ]
            )
            parts.append(piece(angle, "bracket", "", "clamp"))
            spots = [0.0]
        elif kind == 2:
            parts.append(piece(box((0.04, 0.04, ty), (x, gap, high + ty / 2)), "washer", "", "fastener"))
            spots = [gap]
        else:
            path = [
                [0, -0.06, high + ty / 2],
                [0, 0.022, high + ty / 2],
                [0, 0.03, high + 0.04],
                [0, 0.09, high + 0.04],
            ]
            parts.append(piece(moved(strap(path, 0.04, ty), at(float(x))), "bracket", "", "clamp"))
            spots = [-0.01]
        for y in spots:
            base = high - t
            pose = at(float(x), y, 0)
            if rng.random() < 0.5:  # a T-bolt from below, its nut on top
                tee = merge(
                    [
                        box((0.5 * s, 2.2 * d, 0.6 * d), (0, 0, base - 0.3 * d)),
                        cylinder(d / 2, base - 0.1 * d, high + ty + 2.4 * d, few(d / 2, style)),
                    ]
                )
                tee = moved(tee, spun("z", np.pi / 2))
                nut = moved(
                    nut_solid(str(rng.choice(["hex", "flange", "wing", "lock"])), d, style), at(0, 0, high + ty + 0.002)
                )
                named = [
                    ("bolt", tee),
                    ("nut", nut),
                    ("washer", ring(0.54 * d, 1.3 * d, high + ty, high + ty + 0.002, 10)),
                ]
            else:  # a channel nut from below, a screw from above
                block = extrude(
                    rounded_rectangle(0.9 * (s - 2 * t), 0.02, 0.003, 1), base - 0.009, base, (circle(d / 2, 8),)
                )
                bolt = merge(
                    [
                        moved(
                            head_solid(str(rng.choice(["hex", "socket", "flange", "thumb"])), d, style),
                            at(0, 0, high + ty),
                        ),
                        cylinder(d / 2, base - 0.014, high + ty, few(d / 2, style)),
                    ]
                )
                named = [("nut", moved(block, spun("z", np.pi / 2))), ("bolt", bolt)]
            parts += [piece(moved(solid, pose), name, "", "fastener") for name, solid in named]
    return Model(placed(parts, at(0, 0, 0.006)))


def _tie_rods(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Crossed tension rods in a bay: fork ends with pins on gusset plates, turnbuckles or a ring where they meet."""
    w, h, size = float(rng.uniform(1.0, 2.4)), float(rng.uniform(1.0, 2.2)), float(rng.choice([0.1, 0.14]))
    d = float(rng.choice([0.012, 0.016, 0.02, 0.024]))
    section = section_i(size, size, 0.06 * size, 0.08 * size)
    parts: list[Part] = []
    for x in (0.0, w):
        parts.append(framed(moved(extrude(section @ np.array([[0.0, 1.0], [-1.0, 0.0]]), 0.015, h), at(x)), "column"))
        parts.append(framed(box((size + 0.1, size + 0.1, 0.015), (x, 0, 0.0075)), "base plate"))
    parts.append(framed(bar((size / 2, 0, h - size / 2), (w - size / 2, 0, h - size / 2), section), "beam"))
    g, t = 4.5 * d + 0.03, 0.7 * d
    ring_r = float(rng.choice([0.0, 5.0])) * d
    low, high = 0.03, h - size
    x0, x1 = size / 2, w - size / 2
    mid = np.array([(x0 + x1) / 2, 0.0, (low + high) / 2])
    for sx in (-1, 1):
        for sz in (-1, 1):
            corner = np.array([x0 if sx < 0 else x1, 0.0, low if sz < 0 else high])
            inner: list[list[float]] = [[0, 0], [g, 0], [g, 0.45 * g], [0.45 * g, g], [0, g]]
            plate = upright([[corner[0] - sx * a, corner[2] - sz * b] for a, b in inner], -t / 2, t / 2)
            parts.append(piece(plate, "gusset plate", "", "steel"))
            hole = corner + np.array([-sx * 0.5 * g, 0.0, -sz * 0.5 * g])
            way = (mid - hole) / np.linalg.norm(mid - hole)
            cheeks = [
                bar(
                    hole - way * 0.8 * d + np.array([0, q * (t / 2 + 0.2 * d), 0]),
                    hole + way * 2.6 * d + np.array([0, q * (t / 2 + 0.2 * d), 0]),
                    rounded_rectangle(0.4 * d, 1.8 * d, 0),
                )
                for q in (-1, 1)
            ]
            neck = rod(hole + way * 2.4 * d, hole + way * 5.5 * d, 0.95 * d, few(d, style))
            parts.append(
                piece(
                    merge([*cheeks, neck]),
                    str(rng.choice(["bracket", "clamp"])) if sz < 0 and sx < 0 else "bracket",
                    "",
                    "steel",
                )
            )
            pin = along(
                "y", cylinder(0.5 * d, -t / 2 - 0.8 * d, t / 2 + 0.8 * d, few(d / 2, style)), hole[0], 0, hole[2]
            )
            parts.append(piece(pin, "bolt", "", "fastener"))
            end = mid - way * ring_r
            parts.append(framed(rod(hole + way * 5.0 * d, end, d / 2, few(d / 2, style)), "brace"))
            if ring_r:
                parts.append(piece(rod(end + way * 1.2 * d, end - way * 0.4 * d, 0.95 * d, 6), "nut", "", "fastener"))
            elif rng.random() < 0.7 and sz < 0:
                a = hole + way * float(rng.uniform(0.3, 0.5)) * np.linalg.norm(mid - hole)
                parts.append(piece(rod(a, a + way * 8 * d, 0.95 * d, 6), "nut", "", "fastener"))
    if ring_r:
        loop = along(
            "y", ring(ring_r - 0.8 * d, ring_r, -0.9 * d, 0.9 * d, max(12, style.round(ring_r))), mid[0], 0, mid[2]
        )
        parts.append(framed(loop, "plate"))
    return Model(parts)


JOINTS: tuple[Family, ...] = (
    floor_family("bolt/swing", _swing, "bolt"),
    floor_family("bolt/strut", _slotted, "bolt"),
    floor_family("gusset plate/tie rods", _tie_rods, "gusset plate"),
)
