"""What instruments are put together from: dials, shanks, housings, boxes, and posts, boards and vessels to hold them.

Devices stand on z = 0 about the z axis unless a function says otherwise; their fronts look to -y.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.family import Build, Family, Part, fronted, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.plant import Turning
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = [
    "CASE",
    "FRAME",
    "JOINT",
    "STEM",
    "STYLES",
    "TANK",
    "bent",
    "board",
    "bolted",
    "case_of",
    "dial",
    "face_of",
    "fine_sides",
    "gauge_family",
    "gland",
    "headed",
    "housing",
    "indicator",
    "needle_of",
    "piece",
    "pointer",
    "screws",
    "shank",
    "stand",
    "standing",
    "t_handle",
    "upright",
    "vessel",
]

FRAME, JOINT, TANK = "Structural element", "Connection assembly", "Tank"
CASE, STEM = "gauge case", "gauge stem"
STYLES = ("plain", "safety", "crimped", "cast", "bayonet", "turret")
UPRIGHT = spun("x", np.pi / 2)  # what looks to +z then looks to -y, its y axis up


def piece(solid: Solid | Sequence[Solid], name: str, color: str, bundle: str = "") -> Part:
    """A part of a gauge, of the bundle that its name says by default."""
    return Part(solid if isinstance(solid, Solid) else merge(list(solid)), name, color, bundle or name)


def pointer(solid: Solid, color: str = "needle") -> Part:
    """The needle of a dial about z."""
    return replace(piece(solid, "gauge needle", color, CASE), turns=Turning("needle"))


def headed(parts: Sequence[Part]) -> list[Part]:
    """What stands upright on its flange, as a head on the end of a line: z becomes x."""
    return placed(parts, spun("y", np.pi / 2))


def fine_sides(radius: float, style: ModelingStyle, most: int = 16) -> int:
    """Sides of a small round thing."""
    return max(6, min(most, style.round(radius)))


def screws(count: int, radius: float, thread: float, low: float, high: float, bundle: str = "") -> Part:
    """Hexagon bolts about z through what lies between two heights [m]."""
    solid = bolt_circle(count, radius, thread, low, high)
    return Part(solid, "bolt", "fastener", bundle, JOINT, True)


# --- dials ---


def case_of(size: float, depth: float, design: str, style: ModelingStyle) -> tuple[Solid, float]:
    """A round case about z, its back on 0 and its front towards +z, and the radius of its opening [m]."""
    r, d, n = size / 2, depth, style.round(size / 2)
    w, floor = 0.9 * r, 0.82 * d
    hollow = [(w, d), (w, floor)]
    extra: list[Solid] = []
    if design == "safety":  # a solid front, and a disc at the back that blows out
        outline = [(0.96 * r, 0.0), (r, 0.03 * d), (r, 0.86 * d), (1.07 * r, 0.87 * d), (1.07 * r, d)]
        extra = [cylinder(0.86 * r, -0.003, 0.0005, n), around(box((0.12 * r, 0.2 * r, 0.005)), 3, 0.8 * r)]
    elif design == "crimped":
        outline = [(0.8 * r, 0.0), (0.94 * r, 0.05 * d), (r, 0.2 * d), (r, 0.62 * d), (1.05 * r, 0.74 * d)]
        outline += [(1.06 * r, 0.9 * d), (1.0 * r, d)]
    elif design == "cast":
        outline = [(0.72 * r, 0.0), (0.78 * r, 0.12 * d), (r, 0.26 * d), (r, 0.58 * d), (1.13 * r, 0.6 * d)]
        outline += [(1.13 * r, 0.97 * d), (1.09 * r, d)]
        extra = [around(cylinder(0.05 * r, 0.9 * d, 1.05 * d, 8), 4, 1.03 * r, np.pi / 4)]
        extra.append(moved(along("y", cylinder(0.06 * r, -0.2 * r, 0.2 * r, 8)), at(1.16 * r, 0, 0.75 * d)))
    elif design == "bayonet":
        outline = [(0.94 * r, 0.0), (r, 0.06 * d), (r, 0.7 * d), (1.05 * r, 0.71 * d), (1.05 * r, 0.98 * d)]
        outline += [(1.02 * r, d)]
        extra = [around(box((0.1 * r, 0.22 * r, 0.2 * d), (0, 0, 0.84 * d)), 4, 1.06 * r, 0.3)]
    elif design == "turret":  # a ring screwed on, a flange at the back
        outline = [(1.2 * r, 0.0), (1.2 * r, 0.06 * d), (r, 0.08 * d), (0.97 * r, 0.62 * d), (1.06 * r, 0.64 * d)]
        outline += [(1.1 * r, 0.95 * d), (1.02 * r, d)]
        extra = [around(box((0.06 * r, 0.1 * r, 0.26 * d), (0, 0, 0.8 * d)), 12, 1.08 * r)]
    else:
        outline = [(0.9 * r, 0.0), (r, 0.06 * d), (r, 0.76 * d), (1.06 * r, 0.78 * d), (1.06 * r, 0.97 * d)]
        outline += [(1.03 * r, d)]
    return merge([turned([*outline, *hollow], n), *extra]), w


def face_of(radius: float, low: float, style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A round dial plate, its scale raised, or bare [m]."""
    plate = cylinder(0.985 * radius, low, low + 0.001, style.round(radius))
    if rng.random() < 0.5:
        return plate
    count, long = int(rng.choice([7, 11, 13])), float(rng.uniform(0.1, 0.2)) * radius
    tick = box((long, 0.03 * radius, 0.0006), (0.85 * radius - long / 2, 0, low + 0.0012))
    ticks = [moved(tick, spun("z", float(a))) for a in np.linspace(-np.pi / 4, 1.25 * np.pi, count)]
    return merge([plate, *ticks])


def needle_of(radius: float, low: float, rng: np.random.Generator) -> Solid:
    """A pointer about z: tapered, straight, with a weight or an arrow, at some reading [m]."""
    r, kind = radius, int(rng.integers(4))
    wide = float(rng.uniform(0.025, 0.05)) * r
    if kind == 0:
        outline = [(-0.25, -wide), (0.78, -0.2 * wide), (0.78, 0.2 * wide), (-0.25, wide)]
    elif kind == 1:
        outline = [(-0.1, -0.6 * wide), (0.82, -0.6 * wide), (0.82, 0.6 * wide), (-0.1, 0.6 * wide)]
    elif kind == 2:
        outline = [(-0.3, -3 * wide), (-0.18, -3 * wide), (-0.12, -0.7 * wide), (0.8, -0.15 * wide)]
        outline += [(0.8, 0.15 * wide), (-0.12, 0.7 * wide), (-0.18, 3 * wide), (-0.3, 3 * wide)]
    else:
        outline = [(-0.2, -0.7 * wide), (0.6, -0.5 * wide), (0.6, -2.2 * wide), (0.84, 0.0)]
        outline += [(0.6, 2.2 * wide), (0.6, 0.5 * wide), (-0.2, 0.7 * wide)]
    # Widths are of r already, lengths are not.
    shape = np.array([(x * r, y) for x, y in outline])
    hub = cylinder(float(rng.uniform(0.06, 0.12)) * r, low, low + 0.0035, 10)
    flat = extrude(shape, low + 0.0005, low + 0.0015)
    return moved(merge([flat, hub]), spun("z", float(rng.uniform(-0.7, 3.9))))


def dial(
    size: float, style: ModelingStyle, rng: np.random.Generator, design: str = "", deep: float = 0.0
) -> list[Part]:
    """Case, face, needle and maybe glass of an instrument with a round dial (EN 837-1 sizes).

    Args:
        size: diameter of the case [m].
        style: that models it.
        rng: draws what is open.
        design: one of ``STYLES``; drawn where empty.
        deep: depth of the case [m]; drawn where 0.
    """
    design = design or str(rng.choice(STYLES))
    if not deep:
        deep = size * float(rng.uniform(0.5, 0.8) if design == "safety" else rng.uniform(0.28, 0.55))
    solid, w = case_of(size, deep, design, style)
    floor = 0.82 * deep
    parts = [piece(solid, CASE, "gauge"), piece(face_of(w, floor, style, rng), "gauge face", "dial", CASE)]
    parts.append(pointer(needle_of(w, floor + 0.001, rng)))
    if rng.random() < 0.15:  # a drag style
        parts.append(piece(needle_of(0.9 * w, floor + 0.0035, rng), "gauge needle", "handle", CASE))
    if rng.random() < 0.6:
        n = style.round(w)
        flat = cylinder(0.99 * w, 0.93 * deep, 0.93 * deep + 0.002, n)
        glass = flat if rng.random() < 0.7 else dome(0.99 * w, 0.12 * w, 0.95 * deep, n)
        parts.append(piece(glass, "gauge glass", "dial", CASE))
    return fronted(parts)


def upright(parts: Sequence[Part], size: float, top: float, turn: float = 0.0) -> list[Part]:
    """A dial set upright on the height ``top``, centred over the z axis, turned about it."""
    depth = float(parts[0].solid.vertices[:, 2].max())
    return placed(parts, spun("z", turn) @ at(0, depth / 2, top + size / 2) @ UPRIGHT)


def shank(low: float, high: float, style: ModelingStyle, rng: np.random.Generator, size: float = 0.1) -> Part:
    """Thread, wrench flats and maybe a collar of a connection about z (G 1/4 or G 1/2) [m]."""
    square = 0.014 if size < 0.08 else 0.022
    span, n = high - low, fine_sides(0.4 * square, style)
    solids = [cylinder(0.45 * square, low, low + 0.6 * span, n)]
    if rng.random() < 0.6:
        solids.append(box((square, square, 0.5 * span), (0, 0, high - 0.25 * span)))
    else:
        solids.append(hexagon(square, high - 0.6 * span, high - 0.25 * span))
        solids.append(cylinder(0.42 * square, high - 0.3 * span, high, n))
    if rng.random() < 0.3:
        solids.append(cylinder(0.62 * square, low + 0.3 * span, low + 0.4 * span, n))
    return piece(solids, STEM, "trim")


def standing(
    top: float, style: ModelingStyle, rng: np.random.Generator, design: str = "", size: float = 0.0
) -> list[Part]:
    """A gauge with its connection below, on what ends at the height ``top`` [m]."""
    size = size or float(rng.choice([0.05, 0.063, 0.08, 0.1, 0.1, 0.16]))
    span = 0.03 + 0.12 * size
    foot = shank(top - 0.004, top + span, style, rng, size)
    turn = float(rng.uniform(0, 6.28))
    return [*placed([foot], spun("z", turn)), *upright(dial(size, style, rng, design), size, top + span - 0.002, turn)]


# --- heads ---


def gland(style: ModelingStyle, rng: np.random.Generator, thread: float = 0.02) -> Solid:
    """A cable gland or plug about z from 0 up (EN 62444), maybe with a stub of cable [m]."""
    n, r = fine_sides(thread / 2, style, 12), thread / 2
    nut = merge([hexagon(2.5 * r, 0.0, 0.5 * r), hexagon(2.4 * r, 0.9 * r, 1.7 * r), cylinder(r, 0.0, 2.2 * r, n)])
    kind = rng.random()
    if kind < 0.4:
        return nut
    if kind < 0.6:
        return merge([cylinder(1.1 * r, 0.0, 0.4 * r, n), hexagon(0.9 * r, 0.3 * r, 0.8 * r)])
    long = float(rng.uniform(2, 8)) * thread
    path = [(0, 0, 2 * r), (0, 0, 2 * r + 0.4 * long), (0, -0.1 * long, 2 * r + 0.7 * long), (0, -0.3 * long, long)]
    return merge([nut, rope(path, 0.45 * r, 8)])


def housing(style: ModelingStyle, rng: np.random.Generator, shape: str = "") -> Solid:
    """A transmitter's electronics on z = 0: one or two chambers, a pot, a rectangular or slanted head.

    Args:
        style: that models it.
        rng: draws what is open.
        shape: ``single``, ``double``, ``pot``, ``rectangle``, ``slant`` or drawn.
    """
    shape = shape or str(rng.choice(["single", "double", "pot", "rectangle", "slant"]))
    r = float(rng.uniform(0.034, 0.052))
    n, neck = style.round(r), cylinder(0.45 * r, 0.0, 0.5 * r, 12)
    if shape == "pot":  # a can about z with a screwed lid, maybe with a window
        body = turned([(0.5 * r, 0.2 * r), (r, 0.45 * r), (r, 1.7 * r), (1.1 * r, 1.7 * r), (1.1 * r, 2.2 * r)], n)
        ribs = around(box((0.14 * r, 0.2 * r, 0.4 * r), (0, 0, 1.95 * r)), 8, 1.1 * r)
        out = moved(along("x", gland(style, rng), 0.9 * r, 0, r), spun("z", float(rng.uniform(0, 6))))
        return merge([neck, body, ribs, out])
    if shape == "rectangle":
        wide, deep, tall = (float(rng.uniform(a, b)) for a, b in ((0.09, 0.15), (0.06, 0.1), (0.08, 0.14)))
        block = extrude(rounded_rectangle(wide, tall, 0.12 * tall, 3), 0.0, deep)
        lid = extrude(rounded_rectangle(0.96 * wide, 0.96 * tall, 0.1 * tall, 3), deep + 0.001, deep + 0.012)
        view = box((0.5 * wide, 0.3 * tall, 0.002), (0, 0.15 * tall, deep + 0.0128))
        outs = [along("-y", gland(style, rng), x, -0.5 * tall + 0.001, 0.4 * deep) for x in (-0.3 * wide, 0.3 * wide)]
        up = at(0, 0.5 * deep, 0.4 * r + 0.5 * tall) @ UPRIGHT
        return merge([neck, moved(merge([block, lid, view, *outs]), up)])
    if shape == "slant":  # a pot whose window leans to the reader
        body = turned([(0.5 * r, 0.2 * r), (0.9 * r, 0.4 * r), (0.9 * r, 1.5 * r), (0.5 * r, 1.9 * r)], n)
        lid = turned([(1.0 * r, 0.0), (1.08 * r, 0.1 * r), (1.08 * r, 0.5 * r), (0.9 * r, 0.6 * r)], n)
        lean = moved(lid, at(0, -0.2 * r, 1.3 * r) @ spun("x", np.pi / 4))
        return merge([neck, body, lean, along("y", gland(style, rng), 0, 0.8 * r, 0.9 * r)])
    # A drum about x with screwed covers at one end or both.
    low, high = (-1.3 * r, 0.9 * r) if shape == "single" else (-1.0 * r, 1.0 * r)
    body = along("x", turned([(0.8 * r, low), (r, low + 0.15 * r), (r, high), (0.8 * r, high + 0.05 * r)], n))
    cover = turned([(1.12 * r, 0.0), (1.15 * r, 0.1 * r), (1.15 * r, 0.55 * r), (1.0 * r, 0.65 * r)], n)
    covers = [along("x", cover, high - 0.1 * r)]
    if shape == "double":
        covers.append(along("-x", cover, low + 0.1 * r))
    sides = ("y", "-y") if rng.random() < 0.5 else ("y",)
    outs = [along(a, gland(style, rng), 0, 0.9 * r * (1 if a == "y" else -1), 0.1 * r) for a in sides]
    return merge([neck, moved(merge([body, *covers, *outs]), at(0, 0, 1.35 * r))])


def indicator(wide: float, tall: float, deep: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A square case about z with its back on 0: bezel, face, a needle [m]."""
    outline = rounded_rectangle(wide, tall, float(rng.uniform(0.0, 0.15)) * tall, 3)
    back = extrude(0.94 * outline, 0.0, 0.7 * deep)
    frame = extrude(outline, 0.68 * deep, deep, (0.86 * outline,))
    face = extrude(0.855 * outline, 0.7 * deep, 0.7 * deep + 0.0015)
    r = 0.4 * min(wide, tall)
    needle = needle_of(r, 0.7 * deep + 0.0015, rng)
    parts = [piece([back, frame], CASE, "gauge"), piece(face, "gauge face", "dial", CASE)]
    parts.append(pointer(needle))
    if rng.random() < 0.5:
        parts.append(piece(extrude(0.855 * outline, 0.92 * deep, 0.96 * deep), "gauge glass", "dial", CASE))
    return fronted(parts)


def t_handle(reach: float, wide: float, radius: float = 0.004) -> Solid:
    """A needle valve's bonnet, spindle and cross bar about z from 0 to ``reach`` [m]."""
    body = [hexagon(5 * radius, 0.0, 0.35 * reach), cylinder(radius, 0.3 * reach, reach, 8)]
    return merge([*body, rod((-wide / 2, 0, reach), (wide / 2, 0, reach), 0.8 * radius, 8)])


def bent(points: Sequence[Sequence[float]], radius: float, style: ModelingStyle) -> Solid:
    """A small tube through corners that are cut twice, so that its bends look round [m]."""
    path = [np.asarray(p, float) for p in points]
    for _ in range(2):
        cut = [path[0]]
        for a, b, c in zip(path[:-2], path[1:-1], path[2:], strict=True):
            # Cut no more than 3 diameters: long legs stay straight.
            for p in (a, c):
                step = p - b
                long = float(np.linalg.norm(step))
                cut.append(b + step / long * min(0.3 * long, 5 * radius))
        path = [*cut, path[-1]]
    return rope(np.array(path), radius, fine_sides(radius, style, 10))


# --- what instruments are mounted on ---


def stand(height: float, style: ModelingStyle, rng: np.random.Generator, radius: float = 0.0302) -> list[Part]:
    """A pipe stand about z (two inches by default) on a base plate [m]."""
    side = float(rng.uniform(0.15, 0.3))
    base = box((side, side, 0.01), (0, 0, 0.005))
    n = style.round(radius)
    if rng.random() < 0.3:
        base = cylinder(side / 2, 0.0, 0.01, style.round(side / 2))
    post = turned([(radius, 0.01), (radius, height - 0.004), (0.8 * radius, height)], n)
    return [Part(post, "post", "steel", "", FRAME), Part(base, "base plate", "steel", "", FRAME)]


def board(wide: float, low: float, high: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Something to mount on, its front in y = 0 looking to -y: a wall, or a panel on posts [m]."""
    if rng.random() < 0.4:
        deep = float(rng.uniform(0.08, 0.2))
        tall = high + float(rng.uniform(0.1, 0.6))
        return [Part(box((wide + 0.4, deep, tall), (0, deep / 2, tall / 2)), "wall", "concrete", "", FRAME)]
    thick, w = float(rng.choice([0.003, 0.006, 0.012])), float(rng.choice([0.04, 0.05, 0.06]))
    sheet = box((wide, thick, high - low), (0, thick / 2, (low + high) / 2))
    parts = [Part(sheet, "plate", "electrical", "", FRAME)]
    places = (0.0,) if wide < 0.25 else (-wide / 2 + w, wide / 2 - w)
    for x in places:
        post = extrude(rounded_rectangle(w, w, 0.1 * w, 2), 0.01, high)
        parts.append(Part(moved(post, at(x, thick + w / 2)), "post", "steel", "", FRAME))
        foot = box((2.5 * w, 2.5 * w, 0.01), (x, thick + w / 2, 0.005))
        parts.append(Part(foot, "base plate", "steel", "", FRAME))
    return parts


def vessel(
    low: float, high: float, dn: int, style: ModelingStyle, rng: np.random.Generator, flanged: bool = True
) -> tuple[list[Part], float]:
    """A small upright vessel beside the origin with two nozzles towards +x whose faces are in x = 0.

    Args:
        low: height of the lower nozzle [m].
        high: of the upper one.
        dn: of the nozzles.
        style: that models it.
        rng: draws what is open.
        flanged: whether the nozzles end in flanges; else in bosses.

    Returns:
        Its parts, and the place of its axis [m].
    """
    radius, reach = float(rng.uniform(0.15, 0.35)), float(rng.uniform(0.09, 0.15))
    n, x = style.round(radius), -radius - reach
    bottom, top = low - 0.06 - 0.1 * radius, high + 0.08
    shell = cylinder(radius, bottom, top, n)
    parts = [Part(moved(shell, at(x)), "shell", "tank", "", TANK)]
    lid = dome(radius, 0.45 * radius, 0.0, n) if rng.random() < 0.6 else cylinder(1.06 * radius, 0.0, 0.015, n)
    parts.append(Part(moved(lid, at(x, 0, top)), "dished head", "tank", "", TANK))
    under = dome(radius, 0.4 * radius, 0.0, n)
    parts.append(Part(moved(under, at(x, 0, bottom) @ spun("x", np.pi)), "dished head", "tank", "", TANK))
    leg = moved(box((0.04, 0.04, bottom + 0.05), (0, 0, (bottom + 0.05) / 2)), at(0.98 * radius + 0.01))
    for k in range(3):
        turn = at(x) @ spun("z", np.pi / 3 + k * 2 * np.pi / 3)
        parts.append(Part(moved(leg, turn), "tank leg", "steel", "", TANK))
    for z in (low, high):
        if flanged:
            nozzle = along("-x", disc_flange(dn, style, reach + 0.02), 0, 0, z)
        else:
            nozzle = along("-x", cylinder(1.35 * PIPES[dn].radius, 0.0, reach + 0.02, style.round(0.02)), 0, 0, z)
        parts.append(Part(nozzle, "nozzle", "tank", "", TANK))
    return parts, x


def bolted(dn: int, z: float, style: ModelingStyle, pad: float = 0.002) -> list[Part]:
    """Gasket and bolts of a joint in x = 0 on the height ``z``, a flange on either side."""
    size, plate, n = FLANGES[dn], plate_thickness(dn), style.round(FLANGES[dn].raised / 2)
    bolts = bolt_circle(size.n_bolts, size.circle / 2, size.bolt, -plate, plate + pad)
    disc = ring(PIPES[dn].radius, size.raised / 2, 0.0, pad, n)
    return [
        Part(along("x", disc, 0, 0, z), "gasket", "gasket", "", "Pipe assembly"),
        Part(along("x", bolts, 0, 0, z), "bolt", "fastener", "", JOINT, True),
    ]


def hole(radius: float, style: ModelingStyle) -> Floats:
    """The outline of a small round hole."""
    return circle(radius, fine_sides(radius, style))


def gauge_family(
    name: str, build: Build, place: str = "tap", sizes: tuple[int, ...] = (15,), weight: float = 1.0
) -> Family:
    """A family of gauges."""
    return Family(name, place, "Gauge assembly", "gauge", build, sizes, weight=weight)
