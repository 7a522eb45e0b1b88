"""Structures: profiles, frames, ladders, gratings, railings, fences, walls, foundations, skids, casters."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, lattice, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import along, ball, bar, box, cylinder, hexagon, rod, turned
from cadplants.transforms import at, spun

__all__ = ["FRAMES", "profile"]

_GROUP = "Structural element"


def profile(rng: np.random.Generator, style: ModelingStyle, big: float = 0.2) -> tuple[Floats, tuple[Floats, ...]]:
    """The outline of a rolled or hollow section (proportions of EN 10365, EN 10056, EN 10210) and its hole."""
    h = float(rng.uniform(0.25, 1.0)) * big
    kind = int(rng.integers(6))
    if kind == 0:
        return section_i(h, h, 0.05 * h, 0.07 * h), ()
    if kind == 1:
        return section_i(h, 0.5 * h, 0.03 * h, 0.045 * h), ()
    if kind == 2:
        return section_channel(h, 0.45 * h, 0.06 * h, 0.08 * h) - (0.2 * h, 0), ()
    if kind == 3:
        return section_angle(0.6 * h, 0.06 * h) - 0.2 * h, ()
    if kind == 4:
        inner = (rounded_rectangle(0.66 * h, 0.66 * h, 0.05 * h, 2),) if style.hollow else ()
        return rounded_rectangle(0.75 * h, 0.75 * h, float(rng.choice([0.0, 0.08])) * h, 3), inner
    n = style.round(0.35 * h)
    return circle(0.35 * h, n), ((circle(0.31 * h, n),) if style.hollow else ())


def _portal(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bay of a steel frame: columns on base plates, beams, braces (crossed, single, knee), gusset plates, anchors."""
    w, d, h = (float(rng.uniform(*span)) for span in ((1.2, 3.0), (1.0, 2.5), (1.8, 3.5)))
    up, up_hole = profile(rng, style, 0.22)
    across, across_hole = profile(rng, style, 0.2)
    thin, thin_hole = profile(rng, style, 0.1)
    deep = float(np.ptp(across[:, 1])) / 2
    parts: list[Part] = []
    for x in (0.0, w):
        for y in (0.0, d):
            side = float(np.ptp(up, axis=0).max()) + 0.12
            parts.append(Part(bar((x, y, 0.015), (x, y, h), up, up_hole), "column", "steel"))
            parts.append(Part(box((side, side, 0.015), (x, y, 0.0075)), "base plate", "steel"))
            if rng.random() < 0.5:
                bolt = merge([cylinder(0.008, 0.0, 0.05, 8), hexagon(0.024, 0.015, 0.028)])
                parts += [
                    Part(
                        moved(bolt, at(x + sx * 0.4 * side, y + sy * 0.4 * side)),
                        "bolt",
                        "fastener",
                        "",
                        "Connection assembly",
                        True,
                    )
                    for sx in (-1, 1)
                    for sy in (-1, 1)
                ]
            if rng.random() < 0.4:
                parts.append(Part(box((side + 0.15, side + 0.15, 0.2), (x, y, -0.1)), "foundation", "concrete"))
    for y in (0.0, d):
        parts.append(Part(bar((0, y, h + deep), (w, y, h + deep), across, across_hole), "beam", "steel"))
    for x in np.linspace(0, w, int(rng.integers(2, 5))):
        parts.append(
            Part(
                bar(
                    (x, 0, h + 2.0 * deep + float(np.ptp(thin[:, 1])) / 2),
                    (x, d, h + 2.0 * deep + float(np.ptp(thin[:, 1])) / 2),
                    thin,
                    thin_hole,
                ),
                "beam",
                "steel",
            )
        )
    kind = int(rng.integers(3))
    y = -float(np.ptp(up[:, 1])) * 0.1
    if kind == 0:
        lines = [((0.0, y, 0.2), (w, y, h - 0.2)), ((0.0, y - 0.06, h - 0.2), (w, y - 0.06, 0.2))]
    elif kind == 1:
        lines = [((0.0, y, 0.2), (w, y, h - 0.2))]
    else:
        lines = [((0.0, y, h - 0.6), (0.5, y, h)), ((w, y, h - 0.6), (w - 0.5, y, h))]
    for start, end in lines:
        parts.append(Part(bar(start, end, 0.8 * thin, tuple(0.8 * hole for hole in thin_hole)), "brace", "steel"))
        side = 0.16
        gusset = extrude(
            np.array([[0, 0], [side, 0], [side, 0.3 * side], [0.3 * side, side], [0, side]]), -0.004, 0.004
        )
        turn = 1.0 if end[0] > start[0] else -1.0
        parts.append(
            Part(
                moved(
                    gusset,
                    at(start[0], start[1], start[2] - 0.02) @ np.diag([turn, 1.0, 1.0, 1.0]) @ spun("x", np.pi / 2),
                ),
                "gusset plate",
                "steel",
                "",
                "Connection assembly",
            )
        )
    if rng.random() < 0.4:
        z = h + 2.0 * deep + float(np.ptp(thin[:, 1]))
        parts.append(
            Part(
                box((w + 0.1, d + 0.1, 0.008), (w / 2, d / 2, z + 0.004)),
                str(rng.choice(["platform", "plate"])),
                "steel",
            )
        )
    return Model(parts)


def _ladder(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fixed ladder (ISO 14122-4): stiles, rungs every 250 to 300 mm, with a safety cage or without, wall brackets."""
    h, wide = float(rng.uniform(2.0, 4.5)), float(rng.uniform(0.35, 0.5))
    n, pitch = max(6, min(12, style.round(0.015))), float(rng.uniform(0.25, 0.3))
    flat = bool(rng.random() < 0.5)
    stiles = [
        box((0.012, 0.06, h), (s * wide / 2, 0, h / 2))
        if flat
        else rod((s * wide / 2, 0, 0), (s * wide / 2, 0, h), 0.02, n)
        for s in (-1, 1)
    ]
    rungs = [rod((-wide / 2, 0, z), (wide / 2, 0, z), 0.011, n) for z in np.arange(pitch, h - 0.02, pitch)]
    parts = [
        *(Part(s, "ladder", "safety", "ladder") for s in stiles),
        *(Part(r, "ladder", "safety", "ladder") for r in rungs),
    ]
    if h > 2.6 and rng.random() < 0.65:
        a = np.linspace(-0.35, np.pi + 0.35, 13)
        hoop = np.column_stack([0.38 * np.cos(a), -0.36 - 0.36 * np.sin(a), np.zeros(13)])
        hoop = np.vstack([[wide / 2, 0, 0], hoop, [-wide / 2, 0, 0]])
        section = np.array([[0.003, -0.02], [0.003, 0.02], [-0.003, 0.02], [-0.003, -0.02]])
        for z in np.arange(2.2, h + 0.01, 0.7):
            parts.append(Part(moved(sweep(hoop, section), at(0, 0, float(z))), "ladder", "safety", "ladder"))
        for k in (1, 4, 7, 10, 13):
            x, y, _z = hoop[k]
            parts.append(Part(box((0.03, 0.005, h - 2.2), (x, y, (h + 2.2) / 2)), "ladder", "safety", "ladder"))
    for z in (0.4, h - 0.4):
        parts += [
            Part(box((0.01, 0.2, 0.05), (s * wide / 2, 0.12, z)), "bracket", "steel", "", "Connection assembly")
            for s in (-1, 1)
        ]
    return Model(parts)


def grating(w: float, d: float, thick: float, rng: np.random.Generator) -> tuple[str, Solid]:
    """A floor panel with its name: bars as one lattice or one by one, a plain slab, a chequer plate."""
    kind = int(rng.integers(4))
    if kind == 0:
        nx, ny = int(np.clip(w / 0.034, 4, 30)), int(np.clip(d / 0.1, 3, 12))
        xs = np.sort(np.concatenate([np.linspace(0, w, nx + 1), np.linspace(0, w, nx + 1)[:-1] + 0.003, [w + 0.003]]))
        ys = np.sort(np.concatenate([np.linspace(0, d, ny + 1), np.linspace(0, d, ny + 1)[:-1] + 0.005, [d + 0.005]]))
        filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
        filled[::2], filled[:, ::2] = True, True
        return "grating", moved(lattice(xs, ys, filled, 0.0, thick), at(-w / 2, -d / 2))
    if kind == 1:
        bars = [
            box((0.005, d, thick), (x, 0, thick / 2)) for x in np.linspace(-w / 2, w / 2, int(np.clip(w / 0.04, 4, 26)))
        ]
        cross = [
            box((w, 0.006, 0.006), (0, y, thick - 0.004))
            for y in np.linspace(-d / 2, d / 2, int(np.clip(d / 0.1, 3, 12)))
        ]
        return "grating", merge([*bars, *cross])
    if kind == 2:
        return "grating", box((w, d, 0.3 * thick), (0, 0, 0.85 * thick))
    lugs = merge(
        [
            moved(box((0.03, 0.006, 0.002)), at(x, y, thick + 0.001) @ spun("z", 0.7854 * (1 if (i + j) % 2 else -1)))
            for i, x in enumerate(np.linspace(-0.45 * w, 0.45 * w, 9))
            for j, y in enumerate(np.linspace(-0.45 * d, 0.45 * d, 9))
        ]
    )
    return "plate", merge([box((w, d, 0.006), (0, 0, thick - 0.003)), lugs])


def _rail(length: float, pose: Floats, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A railing along x (ISO 14122-3): posts, top rail, knee rail, toe board; ball joints or mitred ends."""
    n, h = max(6, min(16, style.round(0.022))), float(rng.uniform(0.95, 1.15))
    square = bool(rng.random() < 0.3)

    def tube_of(a: tuple[float, float, float], b: tuple[float, float, float], r: float) -> Solid:
        if not square:
            return rod(a, b, r, n)
        return bar(a, b, rounded_rectangle(1.8 * r, 1.8 * r, 0.0), ())

    count = max(2, int(length / 1.2) + 1)
    xs = np.linspace(0, length, count)
    solids = [
        ("railing", tube_of((0, 0, h), (length, 0, h), 0.021)),
        ("railing", tube_of((0, 0, 0.5 * h), (length, 0, 0.5 * h), 0.014)),
    ]
    solids += [("post", tube_of((x, 0, 0), (x, 0, h), 0.021)) for x in xs]
    if rng.random() < 0.3:
        solids += [("railing", tube_of((x, 0, 0.08), (x, 0, h), 0.007)) for x in np.arange(0.12, length, 0.14)]
    if rng.random() < 0.5:
        solids.append(("railing", box((length, 0.005, 0.1), (length / 2, 0.025, 0.06))))
    if rng.random() < 0.3:
        solids += [("railing", moved(ball(0.03, 10), at(x, 0, h))) for x in xs]
    parts = [
        Part(moved(s, pose), "railing" if name == "railing" else "post", "safety", "railing") for name, s in solids
    ]
    if rng.random() < 0.5:
        parts += [Part(moved(box((0.08, 0.08, 0.01), (x, 0, 0.005)), pose), "base plate", "steel") for x in xs]
    return parts


def _railing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    parts = _rail(float(rng.uniform(1.0, 3.0)), np.eye(4), style, rng)
    if rng.random() < 0.5:
        parts += _rail(float(rng.uniform(0.8, 2.0)), spun("z", np.pi / 2), style, rng)
    return Model(parts)


def _stairs(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flight of stairs: two stringers of channel or flat, treads of grating, plate or chequer, a handrail."""
    rise, go, wide = float(rng.uniform(0.16, 0.21)), float(rng.uniform(0.21, 0.28)), float(rng.uniform(0.6, 1.0))
    count = int(rng.integers(4, 9))
    run, height = go * count, rise * count
    slope = np.hypot(run, height)
    parts = []
    flat = rng.random() < 0.5
    outline = rounded_rectangle(0.01, 0.2, 0.0) if flat else section_channel(0.18, 0.05, 0.006, 0.008)
    for s in (-1, 1):
        solid = bar((0, s * wide / 2, 0.0), (run, s * wide / 2, height), outline, ())
        parts.append(Part(solid, "beam", "steel"))
    kind_rng = np.random.default_rng(int(rng.integers(1 << 30)))
    kind = int(kind_rng.integers(3))
    for k in range(count):
        x, z = (k + 0.5) * go, (k + 1) * rise - 0.04
        if kind == 0:
            tread = box((go + 0.02, wide - 0.02, 0.03), (x, 0, z))
        elif kind == 1:
            tread = merge(
                [box((0.005, wide - 0.02, 0.03), (x + dx, 0, z)) for dx in np.linspace(-go / 2, go / 2, 7)]
                + [box((go, 0.005, 0.03), (x, y, z)) for y in np.linspace(-wide / 2 + 0.02, wide / 2 - 0.02, 5)]
            )
        else:
            tread = merge(
                [
                    box((go + 0.02, wide - 0.02, 0.005), (x, 0, z)),
                    box((0.005, wide - 0.02, 0.04), (x - go / 2 - 0.01, 0, z - 0.02)),
                ]
            )
        parts.append(Part(tread, "stair tread", "steel"))
    if rng.random() < 0.7:
        n = max(6, style.round(0.02))
        for s in (-1, 1):
            y = s * wide / 2
            parts.append(Part(rod((0, y, 0.95), (run, y, height + 0.95), 0.02, n), "railing", "safety", "railing"))
            parts += [
                Part(
                    rod((f * run, y, f * height), (f * run, y, f * height + 0.95), 0.02, n), "post", "safety", "railing"
                )
                for f in (0.05, 0.5, 0.95)
            ]
    del slope
    return Model(parts)


def _platform(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A platform: columns, edge beams, a floor of grating panels or plate, railings on some sides."""
    w, d, h = (float(rng.uniform(*span)) for span in ((1.2, 2.6), (0.9, 1.8), (0.4, 2.4)))
    up, up_hole = profile(rng, style, 0.16)
    edge, edge_hole = profile(rng, style, 0.16)
    deep = float(np.ptp(edge[:, 1]))
    parts = [
        Part(bar((sx * w / 2, sy * d / 2, 0.0), (sx * w / 2, sy * d / 2, h - deep), up, up_hole), "column", "steel")
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    z = h - deep / 2 - float(edge[:, 1].max() + edge[:, 1].min()) / 2
    parts += [
        Part(bar((-w / 2, s * d / 2, z), (w / 2, s * d / 2, z), edge, edge_hole), "beam", "steel") for s in (-1, 1)
    ]
    parts += [
        Part(bar((s * w / 2, -d / 2, z), (s * w / 2, d / 2, z), edge, edge_hole), "beam", "steel") for s in (-1, 1)
    ]
    panels = int(rng.integers(1, 4))
    whole = rng.random() < 0.3
    if whole:
        parts.append(Part(box((w, d, 0.012), (0, 0, h + 0.006)), "platform", "clamp"))
    for k in range(0 if whole else panels):
        name, solid = grating(w / panels - 0.004, d, 0.03, rng)
        parts.append(Part(moved(solid, at(-w / 2 + (k + 0.5) * w / panels, 0, h)), name, "clamp"))
    if h > 0.5:
        parts += _rail(w, at(-w / 2, d / 2, h + 0.03), style, rng)
        if rng.random() < 0.6:
            parts += _rail(d, at(-w / 2, -d / 2, h + 0.03) @ spun("z", np.pi / 2), style, rng)
    return Model(parts)


def _grating(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Gratings on a low frame of angles."""
    w, d = float(rng.uniform(0.8, 2.0)), float(rng.uniform(0.5, 1.2))
    name, solid = grating(w, d, float(rng.choice([0.025, 0.03, 0.04])), rng)
    parts = [Part(moved(solid, at(0, 0, 0.1)), name, "clamp")]
    for s in (-1, 1):
        parts.append(
            Part(
                bar((-w / 2, s * d / 2, 0.07), (w / 2, s * d / 2, 0.07), section_angle(0.05, 0.005) * (1, 1), ()),
                "beam",
                "steel",
            )
        )
    parts += [
        Part(box((0.05, 0.05, 0.07), (sx * w / 2, sy * d / 2, 0.035)), "post", "steel")
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    return Model(parts)


def _mesh_fence(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A panel fence of welded wire, planks or sheet between posts, maybe with a gate leaf and its hinges."""
    length, h = float(rng.uniform(1.5, 2.6)), float(rng.uniform(1.0, 2.2))
    n = max(6, min(12, style.round(0.02)))
    posts = [
        Part(
            rod((x, 0, 0), (x, 0, h + 0.1), 0.03, n)
            if rng.random() < 0.5
            else box((0.06, 0.04, h + 0.1), (x, 0, (h + 0.1) / 2)),
            "post",
            "fence",
        )
        for x in (0.0, length)
    ]
    kind = int(rng.integers(3))
    if kind == 0:
        wires = [rod((x, 0, 0.05), (x, 0, h), 0.003, 6) for x in np.arange(0.06, length - 0.03, 0.08)]
        wires += [rod((0.03, 0.004, z), (length - 0.03, 0.004, z), 0.004, 6) for z in np.linspace(0.08, h - 0.05, 8)]
    elif kind == 1:
        wires = [box((length - 0.06, 0.02, 0.12), (length / 2, 0, z)) for z in np.arange(0.15, h, 0.18)]
    else:
        wires = [
            box((length - 0.06, 0.003, h - 0.1), (length / 2, 0, h / 2 + 0.05)),
            *(box((length - 0.06, 0.03, 0.04), (length / 2, 0.015, z)) for z in (0.2, h - 0.1)),
        ]
    parts = [*posts, Part(merge(wires), "fence", "fence")]
    if rng.random() < 0.6:
        leaf = [rod((length + 0.08, 0, z), (length + 1.0, 0, z), 0.02, n) for z in (0.1, h)] + [
            rod((x, 0, 0.1), (x, 0, h), 0.02, n) for x in (length + 0.08, length + 1.0)
        ]
        fill = (
            [rod((length + 0.08, 0, 0.1), (length + 1.0, 0, h), 0.015, n)]
            if rng.random() < 0.5
            else [rod((x, 0, 0.1), (x, 0, h), 0.008, 6) for x in np.arange(length + 0.2, length + 0.95, 0.12)]
        )
        parts.append(Part(merge([*leaf, *fill]), "gate", "gate"))
        hinge = [moved(cylinder(0.014, 0, 0.08, 10), at(length + 0.05, 0, z)) for z in (0.25, h - 0.3)]
        parts.append(Part(merge(hinge), "bracket", "steel", "", "Connection assembly"))
    return Model(parts)


def _civil(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Concrete: a stepped foundation with anchor bolts, a wall (maybe with an opening), a kerb, a plinth."""
    kind = int(rng.integers(3))
    if kind == 0:
        a, b = float(rng.uniform(0.5, 1.4)), float(rng.uniform(0.4, 1.0))
        solids = [box((a + 0.3, b + 0.3, 0.2), (0, 0, 0.1)), box((a, b, 0.4), (0, 0, 0.4))]
        bolt = merge([cylinder(0.01, -0.05, 0.1, 8), hexagon(0.03, 0.02, 0.036)])
        anchors = [
            Part(
                moved(bolt, at(sx * 0.35 * a, sy * 0.35 * b, 0.6)), "bolt", "fastener", "", "Connection assembly", True
            )
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
        plate = Part(box((0.8 * a, 0.8 * b, 0.02), (0, 0, 0.61)), "base plate", "steel")
        return Model([Part(merge(solids), "foundation", "concrete"), plate, *anchors])
    length, h, t = float(rng.uniform(1.5, 4.0)), float(rng.uniform(1.0, 3.0)), float(rng.uniform(0.1, 0.3))
    if kind == 1:
        outline = np.array([[0, 0], [length, 0], [length, h], [0, h]])
        holes = (
            (
                np.array(
                    [
                        [0.3 * length, 0.35 * h],
                        [0.6 * length, 0.35 * h],
                        [0.6 * length, 0.75 * h],
                        [0.3 * length, 0.75 * h],
                    ]
                ),
            )
            if rng.random() < 0.5
            else ()
        )
        wall = moved(extrude(outline, -t / 2, t / 2, holes), spun("x", np.pi / 2))
        return Model(
            [
                Part(wall, "wall", "concrete"),
                Part(box((length + 0.2, t + 0.4, 0.2), (length / 2, 0, -0.1)), "foundation", "concrete"),
            ]
        )
    kerbs = [box((length, 0.12, 0.15), (length / 2, s * 0.8, 0.075)) for s in (-1, 1)] + [
        box((0.12, 1.6, 0.15), (x, 0, 0.075)) for x in (0.06, length - 0.06)
    ]
    slab = box((length, 1.72, 0.1), (length / 2, 0, -0.05))
    return Model([Part(merge(kerbs), "wall", "concrete"), Part(slab, "foundation", "concrete")])


def _skid(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A skid frame of sections with lifting eyes or fork pockets, on casters or feet."""
    w, d = float(rng.uniform(1.2, 2.6)), float(rng.uniform(0.7, 1.4))
    outline, holes = profile(rng, style, 0.16)
    deep = float(np.ptp(outline[:, 1]))
    wheels = bool(rng.random() < 0.55)
    r = float(rng.uniform(0.04, 0.09))
    low = 2.6 * r if wheels else 0.0
    z = low - float(outline[:, 1].min())
    runners = [bar((-w / 2, s * d / 2, z), (w / 2, s * d / 2, z), outline, holes) for s in (-1, 1)]
    ties = [
        bar((x, -d / 2, z), (x, d / 2, z), 0.95 * outline, tuple(0.95 * hole for hole in holes))
        for x in np.linspace(-w / 2 + 0.05, w / 2 - 0.05, int(rng.integers(3, 6)))
    ]
    parts = [Part(s, "skid frame", "steel", "skid frame") for s in (*runners, *ties)]
    if rng.random() < 0.5:
        parts.append(
            Part(
                box((w, d, 0.006), (0, 0, low + deep + 0.003)),
                "plate" if rng.random() < 0.5 else "skid frame",
                "steel",
                "",
            )
        )
    if wheels:
        n = style.round(r)
        for sx in (-1, 1):
            for sy in (-1, 1):
                x, y = sx * 0.4 * w, sy * d / 2
                turn = spun("z", float(rng.uniform(0, 6)))
                tread = moved(
                    along("y", turned([(0.9 * r, -0.3 * r), (r, -0.2 * r), (r, 0.2 * r), (0.9 * r, 0.3 * r)], n)),
                    at(0.4 * r, 0, r),
                )
                fork = merge(
                    [box((0.9 * r, 0.05 * r + 0.003, 1.5 * r), (0.25 * r, s * 0.42 * r, 1.55 * r)) for s in (-1, 1)]
                    + [
                        box((1.6 * r, 1.4 * r, 0.08 * r), (0, 0, low - 0.04 * r)),
                        cylinder(0.5 * r, 2.25 * r, low - 0.05 * r, max(8, n)),
                        box((0.9 * r, 0.95 * r, 0.06 * r), (0.15 * r, 0, 2.28 * r)),
                    ]
                )
                axle = along("y", cylinder(0.1 * r, -0.55 * r, 0.55 * r, 8), 0.4 * r, 0, r)
                pose = at(x, y) @ turn
                parts += [
                    Part(moved(fork, pose), "caster", "clamp", "caster"),
                    Part(moved(tread, pose), "caster", "rubber", "caster"),
                    Part(moved(axle, pose), "bolt", "fastener", "caster", "Connection assembly", True),
                ]
    return Model(parts)


def _stock(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Sections of any length lying and standing, plates with holes and without."""
    parts = []
    for k in range(int(rng.integers(3, 7))):
        outline, holes = profile(rng, style, float(rng.uniform(0.08, 0.3)))
        length = float(np.exp(rng.uniform(np.log(0.3), np.log(5.0))))
        upright = rng.random() < 0.4
        name = "column" if upright else "beam"
        half = float(-outline[:, 1].min())
        solid = (
            moved(extrude(outline, 0.0, length, holes), at(0, 0.45 * k))
            if upright
            else bar((0.5, 0.45 * k, half), (0.5 + length, 0.45 * k, half), outline, holes)
        )
        parts.append(Part(solid, name, "steel"))
        if upright:
            side = float(np.ptp(outline, axis=0).max()) + 0.1
            hole = (
                tuple(circle(0.007, 10, (sx * 0.4 * side, sy * 0.4 * side)) for sx in (-1, 1) for sy in (-1, 1))
                if rng.random() < 0.5
                else ()
            )
            parts.append(
                Part(
                    moved(
                        extrude(rounded_rectangle(side, side, float(rng.choice([0.0, 0.01])), 2), -0.012, 0.0, hole),
                        at(0, 0.45 * k),
                    ),
                    "base plate",
                    "steel",
                )
            )
            if rng.random() < 0.5:
                parts.append(
                    Part(
                        moved(extrude(rounded_rectangle(side, side, 0.0), length, length + 0.01), at(0, 0.45 * k)),
                        "plate",
                        "steel",
                    )
                )
    return Model(parts)


def _family(name: str, build: object, weight: float = 1.0) -> Family:
    whole = name.split("/")[0]
    grain = "structure" if whole in ("ladder", "platform") else "fitting"
    return Family(name, "floor", _GROUP, whole, build, (15,), grain, weight)  # type: ignore[arg-type]


FRAMES: tuple[Family, ...] = (
    _family("frame/bay", _portal, 2),
    _family("ladder/cage", _ladder, 1.5),
    _family("railing/tubular", _railing),
    _family("stairs/flight", _stairs, 1.5),
    _family("platform/bay", _platform, 2.5),
    _family("grating/panel", _grating),
    _family("fence/panel", _mesh_fence, 1.5),
    _family("foundation/concrete", _civil, 1.5),
    _family("skid frame/wheeled", _skid, 3),
    _family("profile/stock", _stock, 1.5),
)
