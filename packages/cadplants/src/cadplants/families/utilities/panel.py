"""Control panels and junction boxes: suites, wall boxes, consoles, push buttons, isolators, boxes of many makes."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, gland, h_column, pole, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["PANELS"]

_CP, _JB = "control panel", "junction box"


def _lights(x: float, y: float, z: float, count: int, pitch: float) -> list[Solid]:
    """Pilot lights and buttons in a row on a front that looks to -y."""
    one = merge([cylinder(0.011, -0.002, 0.016, 10), cylinder(0.015, -0.002, 0.006, 12)])
    return [along("-y", one, x + (k - (count - 1) / 2) * pitch, y, z) for k in range(count)]


def _suite(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A suite of cubicles on a plinth (IEC 61439): doors with swing handles, meters, vents, a roof, lifting eyes."""
    count, w, d, h = (
        int(rng.integers(2, 6)),
        float(rng.choice([0.4, 0.6, 0.8])),
        float(rng.choice([0.4, 0.6, 0.8])),
        float(rng.choice([1.8, 2.0, 2.2])),
    )
    low = float(rng.choice([0.1, 0.2]))
    parts = [Part(box((count * w - 0.02, d - 0.05, low), ((count - 1) * w / 2, 0.0, low / 2)), _CP, "rubber", _CP)]
    drawers = rng.random() < 0.35
    for k in range(count):
        x, y = k * w, -d / 2
        parts.append(Part(box((w - 0.003, d, h - low), (x, 0, (h + low) / 2)), _CP, "electrical", _CP))
        if drawers and k:
            rows = int(rng.integers(4, 9))
            step = (h - low - 0.1) / rows
            fronts = [
                box((0.94 * w, 0.015, 0.92 * step), (x, y - 0.0075, low + 0.05 + (q + 0.5) * step)) for q in range(rows)
            ]
            bits = [
                merge(
                    [
                        along("-y", cylinder(0.02, 0, 0.03, 12), x + 0.3 * w, y - 0.014, low + 0.05 + (q + 0.5) * step),
                        box((0.01, 0.02, 0.05), (x + 0.3 * w, y - 0.05, low + 0.05 + (q + 0.5) * step)),
                    ]
                )
                for q in range(rows)
            ]
        else:
            fronts = [box((0.95 * w, 0.018, h - low - 0.08), (x, y - 0.009, (h + low) / 2))]
            bits = [box((0.025, 0.03, 0.16), (x + 0.4 * w, y - 0.031, low + 0.5 * (h - low)))]
            bits += _lights(x, y - 0.018, h - 0.45, int(rng.integers(1, 5)), 0.07)
            if rng.random() < 0.5:
                bits.append(box((0.5 * w, 0.006, 0.3 * w), (x, y - 0.02, h - 0.7)))
            if rng.random() < 0.5:
                bits += [box((0.5 * w, 0.012, 0.008), (x, y - 0.022, low + 0.2 + 0.025 * q)) for q in range(8)]
            if rng.random() < 0.4:
                bits += [box((0.096, 0.02, 0.096), (x + s * 0.15 * w, y - 0.026, h - 0.25)) for s in (-1, 1)]
        parts += [Part(merge(fronts), _CP, "electrical", _CP), Part(merge(bits), _CP, "rubber", _CP)]
    top = pick(rng, "eyes", "roof", "fan", "plain")
    if top == "roof":
        parts.append(
            Part(box((count * w + 0.06, d + 0.1, 0.04), ((count - 1) * w / 2, 0, h + 0.02)), _CP, "electrical", _CP)
        )
    elif top == "eyes":
        rings = [
            moved(
                torus(0.02, 0.005, 12, 6),
                at(k * w + s * (w / 2 - 0.05), q * (d / 2 - 0.05), h + 0.024) @ spun("x", np.pi / 2),
            )
            for k in range(count)
            for s in (-1, 1)
            for q in (-1, 1)
        ]
        parts.append(Part(merge(rings), "lifting lug", "fastener", _CP, "Tank", True))
    elif top == "fan":
        parts.append(
            Part(
                merge([box((0.3, 0.3, 0.08), (k * w, 0, h + 0.04)) for k in range(0, count, 2)]), _CP, "electrical", _CP
            )
        )
    return Model(parts)


def _wall_box(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wall box, maybe with a rain roof: one or two doors, hinges, main switch, lamps, glands and conduits below."""
    w, h, d = float(rng.uniform(0.25, 0.9)), float(rng.uniform(0.3, 1.1)), float(rng.uniform(0.15, 0.3))
    z = float(rng.uniform(0.9, 1.3))
    case = extrude(rounded_rectangle(w, h, float(rng.choice([0.0, 0.02])), 2), 0.0, d)
    case = moved(case, at(0, -0.02, z + h / 2) @ spun("x", np.pi / 2))
    leaves = 2 if w > 0.65 and rng.random() < 0.7 else 1
    doors = [
        box((0.97 * w / leaves, 0.018, 0.97 * h), ((k - (leaves - 1) / 2) * w / leaves, -0.02 - d - 0.009, z + h / 2))
        for k in range(leaves)
    ]
    front = -0.02 - d - 0.018
    bits = [
        rod(
            (-w / 2 + 0.004, -0.02 - d - 0.012, z + q * h - 0.03),
            (-w / 2 + 0.004, -0.02 - d - 0.012, z + q * h + 0.03),
            0.007,
            8,
        )
        for q in (0.15, 0.85)
    ]
    bits += _lights(0, front, z + 0.8 * h, int(rng.integers(1, 5)), 0.05)
    design = int(rng.integers(3))
    if design == 0:
        bits.append(
            merge(
                [
                    box((0.07, 0.01, 0.07), (0.25 * w, front - 0.005, z + 0.5 * h)),
                    along("-y", cylinder(0.025, 0, 0.03, 16), 0.25 * w, front - 0.009, z + 0.5 * h),
                    box((0.012, 0.02, 0.06), (0.25 * w, front - 0.045, z + 0.5 * h)),
                ]
            )
        )
    elif design == 1:
        bits.append(box((0.45 * w, 0.008, 0.3 * h), (0, front - 0.004, z + 0.5 * h)))
    else:
        bits += [box((0.4 * w, 0.012, 0.008), (0, front - 0.004, z + 0.12 * h + 0.02 * q)) for q in range(6)]
    bits += [along("-y", cylinder(0.012, -0.002, 0.012, 10), 0.43 * w, front, z + q * h) for q in (0.3, 0.7)]
    parts = [
        Part(case, _CP, "electrical", _CP),
        Part(merge(doors), _CP, "electrical", _CP),
        Part(merge(bits), _CP, "rubber", _CP),
    ]
    if rng.random() < 0.35:
        roof = np.array(
            [(0.02, h / 2), (-d - 0.1, h / 2), (-d - 0.1, h / 2 + 0.008), (-0.0, h / 2 + 0.09), (0.02, h / 2 + 0.09)]
        ) * (1, 1)
        cap = moved(about_x(extrude(roof[::-1], -w / 2 - 0.04, w / 2 + 0.04)), at(0, -0.02, z + h / 2))
        parts.append(Part(cap, _CP, "electrical", _CP))
    count = int(rng.integers(0, 5))
    for k in range(count):
        x, q = (k - (count - 1) / 2) * 0.8 * w / max(count, 1), float(rng.choice([0.008, 0.0107, 0.0134]))
        parts.append(Part(moved(gland(q), at(x, -0.02 - d / 2, z)), _CP, "rubber", _CP))
        parts.append(
            Part(
                rod((x, -0.02 - d / 2, z - 2.2 * q), (x, -0.02 - d / 2, 0.1), q, 8),
                "cable" if rng.random() < 0.5 else "conduit",
                "rubber",
            )
        )
    if rng.random() < 0.5:
        parts += [
            Part(box((w + 0.1, 0.02, 0.04), (0, -0.01, z + q * h)), "bracket", "clamp", "", JOINT) for q in (0.1, 0.9)
        ]
        parts.append(wall(-w - 0.2, w + 0.2, z + h + 0.4))
    else:
        parts += [
            Part(box((w + 0.1, 0.02, 0.04), (0, -0.01, z + q * h)), "bracket", "clamp", "", JOINT) for q in (0.1, 0.9)
        ]
        parts += [
            Part(box((0.05, 0.05, z + h), (s * 0.45 * w, 0.025, (z + h) / 2)), "post", "clamp", "", FRAME)
            for s in (-1, 1)
        ]
    return Model(parts)


def _console(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A console: desk with sloping top and upright back in one to three bays, or a pedestal with a screen on an arm."""
    if rng.random() < 0.35:
        w, z, n = float(rng.uniform(0.3, 0.6)), float(rng.uniform(1.0, 1.3)), style.round(0.04)
        tilt = float(rng.uniform(0.2, 0.7))
        head = merge(
            [
                box((w, 0.08, 0.7 * w)),
                box((0.88 * w, 0.006, 0.55 * w), (0, -0.042, 0.03 * w)),
                *_lights(0, -0.04, -0.29 * w, 4, 0.15 * w),
            ]
        )
        mast = [
            cylinder(0.03, 0.02, z, n),
            cylinder(0.2, 0, 0.02, style.round(0.2)),
            box((0.06, 0.08, 0.1), (0, -0.02, z + 0.03)),
        ]
        return Model(
            [
                Part(merge(mast), _CP, "clamp", _CP),
                Part(moved(head, at(0, -0.07, z + 0.06) @ spun("x", -tilt)), _CP, "electrical", _CP),
            ]
        )
    bays, w = int(rng.integers(1, 4)), float(rng.choice([0.6, 0.8, 1.0]))
    high, deep, top = float(rng.uniform(0.7, 0.85)), float(rng.uniform(0.7, 0.95)), float(rng.uniform(1.1, 1.5))
    slope, back = float(rng.uniform(0.1, 0.2)), float(rng.uniform(0.15, 0.25))
    plan = np.array(
        [
            (-deep / 2 + 0.15, 0),
            (deep / 2, 0),
            (deep / 2, top),
            (deep / 2 - back, top),
            (deep / 2 - back - 0.08, high + slope),
            (-deep / 2, high),
            (-deep / 2, high - 0.12),
            (-deep / 2 + 0.15, high - 0.2),
        ]
    )
    parts = []
    rise = float(np.arctan2(slope, deep - back - 0.08))
    for k in range(bays):
        x = k * (w + 0.001)
        parts.append(Part(moved(about_x(extrude(plan, -w / 2, w / 2)), at(x)), _CP, "electrical", _CP))
        knobs = [
            moved(
                merge([cylinder(0.012, -0.004, 0.016, 10), cylinder(0.016, -0.004, 0.005, 12)]),
                at(x + (i - 2) * 0.16 * w, 0, 0),
            )
            for i in range(5)
        ]
        mid = (-deep / 2 + deep / 2 - back - 0.08) / 2
        rows = [
            moved(merge(knobs), at(0, mid + q, high + slope / 2 + q * np.tan(rise)) @ spun("x", rise))
            for q in (-0.1, 0.02)[: int(rng.integers(1, 3))]
        ]
        screen = box((0.7 * w, 0.02, 0.25), (x, deep / 2 - back - 0.045, (high + slope + top) / 2 + 0.02))
        door = box((0.9 * w, 0.012, high - 0.35), (x, -deep / 2 + 0.144, (high - 0.2) / 2))
        parts += [Part(merge([*rows, screen]), _CP, "rubber", _CP), Part(door, _CP, "electrical", _CP)]
    return Model(parts)


def _buttons(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A local station: push buttons, an emergency stop, or an isolator with its handle; on a post or a wall."""
    kind, z = pick(rng, "buttons", "stop", "isolator", "pendant"), float(rng.uniform(1.0, 1.4))
    count = 1 if kind in ("stop", "isolator") else int(rng.integers(2, 5))
    w = float(rng.uniform(0.065, 0.09)) if kind != "isolator" else float(rng.uniform(0.12, 0.28))
    h = 0.05 + 0.045 * count if kind != "isolator" else float(rng.uniform(1.2, 1.8)) * w
    d = float(rng.uniform(0.06, 0.1)) if kind != "isolator" else 0.7 * w
    case = moved(extrude(rounded_rectangle(w, h, 0.12 * w, 3), 0.0, 0.7 * d), at(0, 0, z) @ spun("x", np.pi / 2))
    lid = moved(
        extrude(rounded_rectangle(1.03 * w, 1.03 * h, 0.12 * w, 3), 0.7 * d, d), at(0, 0, z) @ spun("x", np.pi / 2)
    )
    bits = []
    for k in range(count):
        q = z + (k - (count - 1) / 2) * 0.045
        if kind == "isolator":
            bits.append(
                merge(
                    [
                        along("-y", cylinder(0.3 * w, 0, 0.1 * w, 20), 0, -d + 0.001, z),
                        box((0.14 * w, 0.16 * w, 0.55 * w), (0, -d - 0.17 * w, z)),
                    ]
                )
            )
        elif kind == "stop" or (k == 0 and rng.random() < 0.4):
            bits.append(
                along(
                    "-y",
                    turned([(0.01, -0.001), (0.01, 0.015), (0.02, 0.018), (0.02, 0.026), (0.014, 0.032)], 16),
                    0,
                    -d,
                    q,
                )
            )
        else:
            bits.append(
                along(
                    "-y",
                    merge(
                        [
                            cylinder(0.015, -0.001, 0.006, 14),
                            cylinder(0.011, -0.001, float(rng.choice([0.01, 0.018])), 12),
                        ]
                    ),
                    0,
                    -d,
                    q,
                )
            )
    foot = moved(gland(0.008), at(0, -0.5 * d, z - h / 2))
    name = _CP
    parts = [
        Part(case, name, "electrical", name),
        Part(lid, name, "safety", name),
        Part(merge(bits), name, "handle", name),
        Part(foot, name, "rubber", name),
    ]
    line = [(0, -0.5 * d, z - h / 2 - 0.019), (0, -0.5 * d, 0.3), (0.05, -0.5 * d, 0.1), (0.1, -0.5 * d, 0.05)]
    parts.append(Part(rope(line, 0.007, 8), "cable", "rubber"))
    if rng.random() < 0.4:
        return Model([*parts, wall(-0.5, 0.5, z + 0.6)])
    if rng.random() < 0.4:
        hood = box((1.4 * w, 1.6 * d, 0.004), (0, -0.6 * d, z + h / 2 + 0.03))
        plate = box((1.4 * w, 0.004, h + 0.1), (0, 0.002, z + 0.0))
        parts.append(Part(merge([hood, plate]), "bracket", "clamp", "", JOINT))
        return Model(
            [
                *parts,
                *(
                    Part(moved(p.solid, at(0, 0.029)), p.name, p.color, "", p.group, p.fine)
                    for p in pole(z + h, 0.025, style, True)
                ),
            ]
        )
    column = h_column(z + 0.8)
    return Model([*parts, column])


def _ex_box(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Terminal boxes on a frame or wall: flameproof with a bolted lid, round with hubs, plastic with lid screws."""
    parts, x = [], 0.0
    z = float(rng.uniform(1.0, 1.5))
    for _k in range(int(rng.integers(1, 4))):
        kind, s = pick(rng, "flameproof", "hubs", "plastic", "pull", "dome"), float(rng.uniform(0.1, 0.26))
        deep = float(rng.uniform(0.5, 0.8)) * s
        x += s
        parts += [Part(moved(p, at(x, -0.02, z)), _JB, c, _JB) for p, c in _box_of(kind, s, deep, style, rng)]
        feet = [
            box((0.03, 0.03, 0.02), (x + sx * 0.3 * s, -0.01, z + sz * 0.3 * s)) for sx in (-1, 1) for sz in (-1, 1)
        ]
        parts.append(Part(merge(feet), "bracket", "clamp", "", JOINT))
        if rng.random() < 0.7:
            q = 0.05 * s + 0.003
            low = z - (0.77 if kind == "hubs" else 0.61) * s
            line = [(x, -0.02 - deep / 2, low), (x, -0.02 - deep / 2, 0.4), (x, -0.02 - deep / 2 - 0.05, 0.15)]
            parts.append(Part(rope(line, q, 8), "cable" if kind != "hubs" else "conduit", "rubber"))
        x += s
    if rng.random() < 0.5:
        return Model([*parts, wall(-0.3, x + 0.3, z + 0.6)])
    posts = [Part(box((0.05, 0.05, z + 0.3), (q, 0.045, (z + 0.3) / 2)), "post", "steel", "", FRAME) for q in (0.0, x)]
    rails = [
        Part(box((x + 0.2, 0.02, 0.06), (x / 2, 0.01, z + q * 0.05)), "bracket", "clamp", "", JOINT) for q in (-1, 1)
    ]
    return Model([*parts, *posts, *rails])


def _box_of(
    kind: str, s: float, deep: float, style: ModelingStyle, rng: np.random.Generator
) -> list[tuple[Solid, str]]:
    """A box about (x, z) whose back is at y = 0 and whose lid looks to -y; glands below or hubs around."""
    front, n = spun("x", np.pi / 2), style.round(s / 2)
    g = moved(gland(0.045 * s), at(0, -deep / 2, -s / 2))
    if kind == "hubs":
        drum = turned(
            [(0.5 * s, 0), (0.5 * s, 0.8 * deep), (0.54 * s, 0.8 * deep), (0.54 * s, deep), (0.3 * s, 1.12 * deep)], n
        )
        hubs = [
            moved(cylinder(0.14 * s, 0.45 * s, 0.78 * s, 12), at(0, -deep / 2, 0) @ spun("y", k * np.pi / 2))
            for k in range(int(rng.integers(2, 5)))
        ]
        hubs.append(moved(cylinder(0.14 * s, 0.45 * s, 0.78 * s, 12), at(0, -deep / 2, 0) @ spun("y", np.pi)))
        return [(merge([moved(drum, front), *hubs]), "clamp")]
    if kind == "dome":
        body = moved(extrude(rounded_rectangle(s, s, 0.2 * s, 3), 0, 0.6 * deep), front)
        cover = moved(
            merge(
                [
                    cylinder(0.44 * s, 0.6 * deep, 0.7 * deep, n),
                    moved(dome(0.4 * s, 0.35 * s, 0.0, n), at(0, 0, 0.7 * deep)),
                    around(box((0.05 * s, 0.06 * s, 0.1 * s), (0.44 * s, 0, 0.7 * deep)), 8),
                ]
            ),
            front,
        )
        return [(merge([body, g]), "clamp"), (cover, "clamp")]
    r = {"flameproof": 0.06, "plastic": 0.1, "pull": 0.0}[kind] * s
    body = moved(extrude(rounded_rectangle(s, s, r, 3), 0.0, 0.75 * deep), front)
    wide = 1.14 if kind == "flameproof" else 1.02
    lid = moved(extrude(rounded_rectangle(wide * s, wide * s, r, 3), 0.75 * deep, deep), front)
    count = int(rng.integers(1, 5)) if kind != "pull" else 0
    glands = [moved(g, at((k - (count - 1) / 2) * 0.8 * s / max(count, 2), 0, 0)) for k in range(count)]
    glands += [moved(g, spun("y", s_ * np.pi / 2)) for s_ in (-1, 1) if rng.random() < 0.3 and kind != "pull"] + [g] * (
        count % 2 == 0
    )
    if kind == "flameproof":
        rim = [(i * 0.53 * s, j * 0.53 * s) for i in (-1, -0.33, 0.33, 1) for j in (-1, 1)] + [
            (i * 0.53 * s, j * 0.53 * s) for i in (-1, 1) for j in (-0.33, 0.33)
        ]
        flange = moved(extrude(rounded_rectangle(wide * s, wide * s, r, 3), 0.6 * deep, 0.74 * deep), front)
        bolts = [along("-y", hexagon(0.06 * s, deep, deep + 0.04 * s), i, 0, j) for i, j in rim]
        return [(merge([body, flange, *glands]), "electrical"), (merge([lid, *bolts]), "electrical")]
    screws = [
        along("-y", cylinder(0.05 * s, 0.7 * deep, deep + 0.004, 10), i * 0.42 * s, 0, j * 0.42 * s)
        for i in (-1, 1)
        for j in (-1, 1)
    ]
    return [(merge([body, *glands]), "electrical"), (merge([lid, *screws]), "electrical")]


PANELS: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "structure", weight)
    for name, build, weight in (
        ("control panel/suite", _suite, 1.2),
        ("control panel/wall box", _wall_box, 1.2),
        ("control panel/console", _console, 1.0),
        ("control panel/local station", _buttons, 1.5),
        ("junction box/makes", _ex_box, 2.0),
    )
)
