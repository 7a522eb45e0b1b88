"""Shapes that supports share: bars, straps, bows, bolts, feet, and what stands below or hangs above a line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.family import Build, Family, Part, placed
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import bar, box, cylinder, dome, hexagon, ring, rope, torus
from cadplants.standards import SIZES
from cadplants.transforms import at, spun

__all__ = [
    "FRAME",
    "GROUP",
    "arc_yz",
    "below",
    "bolt_parts",
    "bow",
    "carrier",
    "coarse",
    "eye",
    "few",
    "floor_family",
    "footing",
    "framed",
    "member",
    "nut_parts",
    "overhead",
    "piece",
    "screwed",
    "slab_yz",
    "strap",
    "upright",
]

GROUP, FRAME = "Connection assembly", "Structural element"
Point = Sequence[float]


def coarse(style: ModelingStyle) -> bool:
    """Whether the style makes one mesh of a support: then feet keep no bolts and ribs of their own."""
    return style.grain("structure") == "one"


def few(radius: float, style: ModelingStyle, most: int = 12) -> int:
    """Sides of a thin round bar."""
    return int(np.clip(style.round(radius), 6, most))


def piece(solid: Solid, name: str, bundle: str = "", color: str = "clamp", fine: bool = False) -> Part:
    """A part of the connection itself."""
    return Part(solid, name, color, bundle, "", fine)


def framed(solid: Solid, name: str, color: str = "steel") -> Part:
    """A part of the structure around it."""
    return Part(solid, name, color, "", FRAME)


def slab_yz(outline: Floats | Sequence[Point], low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A plate across the line: its outline in (y, z), thick along x [m]."""
    return about_x(extrude(_wound(outline), low, high, holes))


def upright(outline: Floats | Sequence[Point], low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A plate along the line: its outline in (x, z), thick along y from ``low`` to ``high`` [m]."""
    return moved(extrude(_wound(outline), -high, -low, holes), spun("x", np.pi / 2))


def _wound(outline: Floats | Sequence[Point]) -> Floats:
    """The outline counter-clockwise."""
    points = np.asarray(outline, float)
    x, y = points.T
    return points if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0 else points[::-1]


def strap(path: Floats | Sequence[Point], wide: float, thick: float, up: Point = (1.0, 0.0, 0.0)) -> Solid:
    """A flat bar bent along a path, its width along ``up`` [m]."""
    w, t = wide / 2, thick / 2
    return sweep(np.asarray(path, float), np.array([[w, -t], [w, t], [-w, t], [-w, -t]]), up=up)


def arc_yz(radius: float, first: float, last: float, steps: int, y: float = 0.0, z: float = 0.0) -> Floats:
    """``(steps + 1, 3)`` points of an arc across the line; angles from +y towards +z [rad]."""
    a = np.linspace(first, last, steps + 1)
    return np.column_stack([np.zeros(steps + 1), y + radius * np.cos(a), z + radius * np.sin(a)])


def bow(leg: float, foot: float, thick: float, style: ModelingStyle, other: float | None = None) -> Solid:
    """A U of round bar over a line: half a circle of this radius and legs down to ``foot`` [m]."""
    steps = max(6, few(leg, style, 24) // 2)
    path = [[0, leg, foot], *arc_yz(leg, 0, np.pi, steps), [0, -leg, foot if other is None else other]]
    return rope(path, thick, few(thick, style))


def nut_parts(
    spots: Sequence[Point], d: float, style: ModelingStyle, bundle: str = "", washer: bool = True, twice: bool = False
) -> list[Part]:
    """Nuts that press down from each spot: washer, nut (ISO 4032 proportions), maybe a lock nut behind it [m]."""
    parts = []
    n = few(d, style)
    flat = 0.16 * d if washer else 0.0
    for spot in spots:
        pose = at(*spot) @ spun("x", np.pi)
        if washer:
            flats = ring(0.55 * d, 1.05 * d, 0, flat, n)
            parts.append(piece(moved(flats, pose), "washer", bundle, "fastener", True))
        high = flat + 0.85 * d
        parts.append(piece(moved(hexagon(1.6 * d, flat, high, d / 2, n), pose), "nut", bundle, "fastener", True))
        if twice:
            lock = hexagon(1.6 * d, high, high + 0.5 * d, d / 2, n)
            parts.append(piece(moved(lock, pose), "nut", bundle, "fastener", True))
    return parts


def bolt_parts(
    d: float,
    grip: float,
    pose: Floats,
    style: ModelingStyle,
    bundle: str = "",
    head: str = "hex",
    color: str = "fastener",
) -> list[Part]:
    """A bolt along z that clamps what lies between 0 and ``grip``; its head on top, its nut below [m].

    Args:
        d: diameter.
        grip: clamped thickness.
        pose: where z = 0 is its under side.
        style: one mesh, or bolt, nut, washers where it models every piece.
        bundle: of the parts.
        head: ``hex`` (ISO 4014), ``stud``, ``socket`` (ISO 4762), ``carriage`` (ISO 8677), ``flange`` (EN 1665) or
            ``none`` (no nut either: a hex head only, screwed in).
        color: of the parts.
    """
    n, flat = few(d, style), 0.16 * d
    shank = cylinder(d / 2, -1.35 * d if head != "none" else -0.2 * d, grip + 0.1 * d, n)
    nut = hexagon(1.55 * d, -flat - 0.85 * d, -flat, d / 2, n)
    tops = {
        "hex": hexagon(1.55 * d, grip + flat, grip + flat + 0.65 * d),
        "none": hexagon(1.55 * d, grip, grip + 0.65 * d),
        "socket": cylinder(0.75 * d, grip, grip + d, n),
        "carriage": dome(1.1 * d, 0.55 * d, grip, n),
        "flange": merge([hexagon(1.5 * d, grip, grip + 0.8 * d), cylinder(1.1 * d, grip, grip + 0.2 * d, n)]),
        "stud": cylinder(d / 2, grip, grip + 1.35 * d, n),
    }
    name = "stud" if head == "stud" else "screw" if head == "socket" else "bolt"
    solids = [(name, merge([shank, tops[head]]))]
    if head != "none":
        solids += [("nut", nut), ("washer", ring(0.55 * d, d, -flat, 0, n))]
    if head in ("hex", "stud"):
        solids.append(("washer", ring(0.55 * d, d, grip, grip + flat, n)))
    if head == "stud":
        solids.append(("nut", hexagon(1.55 * d, grip + flat, grip + flat + 0.85 * d, d / 2, n)))
    if style.fasteners != "pieces":
        solids = [("bolt" if name == "stud" else name, merge([s for _, s in solids]))]
    return [Part(moved(s, pose), label, color, bundle, "", True) for label, s in solids]


def member(
    size: float, style: ModelingStyle, rng: np.random.Generator, flat: bool = False
) -> tuple[Floats, tuple[Floats, ...]]:
    """The section of a bar this high (EN 10365, EN 10056, EN 10210 proportions), its top and bottom at +-size/2 [m]."""
    kind = int(rng.integers(4 if flat else 7))
    wall = 0.05 * size + 0.001
    inner = (rounded_rectangle(size - 2 * wall, size - 2 * wall, wall, 2),) if style.hollow else ()
    if kind == 0:
        return section_i(size, size, 0.05 * size, 0.08 * size), ()
    if kind == 1:
        return section_i(size, 0.55 * size, 0.04 * size, 0.06 * size), ()
    if kind == 2:
        return section_channel(size, 0.5 * size, 0.07 * size, 0.09 * size) - (0.25 * size, 0), ()
    if kind == 3:
        return rounded_rectangle(size, size, float(rng.choice([0.0, 2 * wall])), 3), inner
    if kind == 4:
        return np.array([1.0, -1.0]) * section_angle(size, 0.1 * size)[::-1] - (0.3 * size, -size / 2), ()
    n = style.round(size / 2)
    if kind == 5:
        # A corner on top, so that what lies on a coarse tube touches it.
        bore = (circle(size / 2 - wall, n, phase=np.pi / 2),) if style.hollow else ()
        return circle(size / 2, n, phase=np.pi / 2), bore
    strut = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (0.5 - 0.18, 0.5), (0.5 - 0.18, 0.32), (0.5 - 0.06, 0.32)]
    strut += [(0.44, -0.44), (-0.44, -0.44), (-0.44, 0.32), (-0.32, 0.32), (-0.32, 0.5), (-0.5, 0.5)]
    return size * np.array(strut), ()


def footing(side: float, shaft: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A base plate for a shaft of this width on z = 0, and its top [m]: square, round, slotted, stiffened, on grout."""
    parts: list[Part] = []
    thick = float(rng.choice([0.006, 0.01, 0.015, 0.02]))
    low = 0.0
    if rng.random() < 0.3:
        low = float(rng.uniform(0.02, 0.08))
        parts.append(framed(box((side + 0.06, side + 0.06, low), (0, 0, low / 2)), "foundation", "concrete"))
    reach, hole = side / 2 - 0.02, float(rng.choice([0.006, 0.008, 0.01]))
    round_ = bool(rng.random() < 0.25)
    outline = (
        circle(side / 2 * 1.1, max(12, style.round(side / 2)))
        if round_
        else rounded_rectangle(side, side, float(rng.choice([0.0, 0.01])), 3)
    )
    reach = 0.72 * reach if round_ else reach
    spots = [(sx * reach, sy * reach) for sx in (-1, 1) for sy in (-1, 1)]
    holes: tuple[Floats, ...] = ()
    if style.holes:
        slot = rounded_rectangle(2 * hole, 3.4 * hole, 0.99 * hole, 3)
        oval = rng.random() < 0.3 and not round_
        holes = tuple(slot + s if oval else circle(hole, 8, s) for s in spots)
    parts.append(framed(extrude(outline, low, low + thick, holes), "base plate"))
    top = low + thick
    if coarse(style):
        return parts, top
    if rng.random() < 0.6:
        screw = merge([cylinder(0.9 * hole, -0.0, top + 3.2 * hole, 8), hexagon(3.0 * hole, top, top + 1.6 * hole)])
        parts += [Part(moved(screw, at(*s)), "bolt", "fastener", "", GROUP, True) for s in spots]
    if rng.random() < 0.3 and side - shaft > 0.05:
        leg = (side - shaft) / 2 - 0.003
        rib = upright([[0, 0], [leg, 0], [leg, 0.01], [0.01, 1.3 * leg], [0, 1.3 * leg]], -0.004, 0.004)
        for k in range(4):
            pose = spun("z", k * np.pi / 2) @ at(shaft / 2, 0, top)
            parts.append(Part(moved(rib, pose), "gusset plate", "steel", "", GROUP))
    return parts, top


def _leg(
    x: float, y: float, low: float, high: float, size: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Part]:
    """A post or column between two heights with its foot."""
    foot, top = footing(size + float(rng.uniform(0.06, 0.14)), size, style, rng)
    outline, holes = member(size, style, rng, flat=bool(rng.random() < 0.7))
    shaft = moved(extrude(outline, low + top, high, holes), at(x, y))
    name = "column" if len(outline) == 12 else "post"
    return [framed(shaft, name), *placed(foot, at(x, y, low))]


def _pair(y: float, low: float, high: float, size: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Two legs alike, left and right of the line."""
    seed = int(rng.integers(1 << 30))
    return [p for s in (-1, 1) for p in _leg(0, s * y, low, high, size, style, np.random.default_rng(seed))]


def below(top: float, height: float, half: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What a support stands on, from the floor at ``-height`` up to a level face at ``top``.

    A post with a head plate, a portal, a T, an arm off a column or a wall, a concrete block [m].
    """
    low, size = -height, float(rng.choice([0.05, 0.06, 0.08, 0.1, 0.12]))
    free = top - low
    kind = int(rng.integers(6))
    if free < 0.3 or kind == 0:
        wide, deep = 2 * half + float(rng.uniform(0.1, 0.3)), float(rng.uniform(0.15, 0.4))
        return [framed(extrude(rounded_rectangle(deep, wide, 0.01, 1), low, top), "foundation", "concrete")]
    if kind == 1:
        thick = float(rng.choice([0.006, 0.01, 0.012]))
        head = box((max(0.1, size + 0.04), 2 * half + 0.06, thick), (0, 0, top - thick / 2))
        return [framed(head, "plate"), *_leg(0, 0, low, top - thick, size, style, rng)]
    span = half + float(rng.uniform(0.12, 0.5))
    outline, holes = member(size, style, rng)
    arm = bar((0, -span, top - size / 2), (0, span, top - size / 2), outline, holes)
    if kind == 2:
        legs = _pair(span - size / 2, low, top - size, size, style, rng)
        return [framed(arm, "beam"), *legs]
    if kind == 3:
        return [framed(arm, "beam"), *_leg(0, 0, low, top - size, size, style, rng)]
    y = span + 0.06
    if kind == 4:
        column = extrude(section_i(0.12, 0.12, 0.006, 0.009), low, top + float(rng.uniform(0.1, 0.8)))
        arm = bar((0, -half - 0.05, top - size / 2), (0, y - 0.06, top - size / 2), outline, holes)
        return [framed(arm, "beam"), framed(moved(column, at(0, y)), "column")]
    thick = float(rng.uniform(0.12, 0.25))
    wall = box((float(rng.uniform(0.5, 1.2)), thick, free + 0.5), (0, y + thick / 2 + 0.01, (low + top + 0.5) / 2))
    plate = box((size + 0.1, 0.01, size + 0.1), (0, y + 0.005, top - size / 2))
    arm = bar((0, -half - 0.05, top - size / 2), (0, y, top - size / 2), outline, holes)
    return [framed(arm, "beam"), framed(plate, "plate"), framed(wall, "wall", "concrete")]


def overhead(low: float, height: float, half: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What a hanger hangs from: a beam with its under side at ``low``, along or across, alone or on legs [m]."""
    size = float(rng.choice([0.08, 0.1, 0.14, 0.18]))
    outline, holes = member(size, style, rng, flat=True)
    span = half + float(rng.uniform(0.2, 0.6))
    along_ = rng.random() < 0.3 and half < 0.04
    a, b = ((-span, 0.0), (span, 0.0)) if along_ else ((0.0, -span), (0.0, span))
    parts = [framed(bar((*a, low + size / 2), (*b, low + size / 2), outline, holes), "beam")]
    kind = int(rng.integers(3)) if height < 3.0 else 0
    if kind == 1 and not along_:
        parts += _pair(span - size / 2, -height, low, size, style, rng)
    elif kind == 2 and not along_:
        column = extrude(section_i(0.14, 0.14, 0.007, 0.01), -height, low + size + 0.02)
        parts.append(framed(moved(column, at(0, span + 0.07)), "column"))
    return parts


def eye(radius: float, thick: float, style: ModelingStyle) -> Solid:
    """A ring of round bar standing across y, about the origin [m]."""
    return moved(torus(radius, thick, few(radius, style, 20), few(thick, style, 8)), spun("x", np.pi / 2))


def carrier(name: str, build: object, sizes: tuple[int, ...] = SIZES, weight: float = 1.0) -> Family:
    """A family that holds a line."""
    return Family(name, "carrier", GROUP, name.split("/")[0], build, sizes, "structure", weight)  # type: ignore[arg-type]


def screwed(
    d: float, grip: float, x: float, y: float, z: float, style: ModelingStyle, head: str = "none"
) -> list[Part]:
    """A bolt whose head shows towards -y, through a plate in front of ``y`` [m]."""
    return bolt_parts(d, grip, at(x, y, z) @ spun("x", np.pi / 2), style, "", head)


def floor_family(name: str, build: Build, whole: str, weight: float = 1.0) -> Family:
    """A family of fittings that stand on the floor with what they hold together."""
    return Family(name, "floor", GROUP, whole, build, (15,), "fitting", weight)
