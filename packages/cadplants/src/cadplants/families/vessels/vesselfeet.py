"""What vessels stand on and are climbed by: saddles, skirts, legs, ladders, small platforms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.vessels.vessel_fittings import Drum, wrapped
from cadplants.family import Part
from cadplants.mesh_ops import Solid, extrude, merge, moved, revolve, sweep, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import around, box, cylinder, hexagon, ring, rod, torus
from cadplants.transforms import at, spun

__all__ = ["anchors", "bar", "foot_plate", "ladder", "legs", "ringed_rail", "saddle", "skirt"]

_FRAME, _JOINT = "Structural element", "Connection assembly"


def bar(
    start: Sequence[float], end: Sequence[float], section: Floats, up: tuple[float, float, float] = (0.0, 0.0, 1.0)
) -> Solid:
    """A rolled section between two points; ``up`` is where its own x axis looks [m]."""
    return sweep(np.array([start, end], float), section, up=up)


def foot_plate(x: float, y: float, side: float, thick: float = 0.012) -> Solid:
    """A square plate on the floor [m]."""
    return box((side, side, thick), (x, y, thick / 2))


def anchors(points: list[tuple[float, float]], thread: float, grip: float) -> Part:
    """Anchor bolts with their nuts, standing out of the floor."""
    solids = [
        moved(
            merge(
                [cylinder(thread / 2, 0.0, grip + 2.2 * thread, 8), hexagon(1.6 * thread, grip, grip + 0.8 * thread)]
            ),
            at(*p),
        )
        for p in points
    ]
    return Part(merge(solids), "bolt", "fastener", "", _JOINT, True)


# --- saddles, for a vessel along x with its axis at a height ---


def saddle(kind: str, r: float, axis: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """One saddle across x = 0 (DIN 28080, or built as small makers do), the vessel's axis at ``axis`` over the floor.

    ``ribbed`` (wear plate, web, ribs, base), ``block`` (timber or plastic), ``sheet`` (bent sheet), ``concrete`` (a
    pier, maybe with a strap) or ``frame`` (two legs of rolled section with a cradle).
    """
    half = float(rng.uniform(0.85, 1.1))
    if kind == "frame":
        return _frame_saddle(r, axis, style, rng)
    if kind == "concrete":
        wide = float(rng.uniform(0.2, 0.4))
        pier = _cradle(r, axis, 1.15 * r + 0.04, wide, style, 1.1)
        parts = [Part(pier, "saddle", "concrete", "saddle")]
        if rng.random() < 0.5:
            strap = _across(wrapped(r, -0.45, np.pi + 0.9, -0.03, 0.03, 0.006, style), axis)
            parts.append(Part(strap, "clamp", "steel", "", _JOINT))
        return parts
    if kind == "block":
        wide = float(rng.uniform(0.08, 0.2))
        parts = [
            Part(_cradle(r, axis, float(rng.uniform(0.65, 0.95)) * r, wide, style, 0.75), "saddle", "rubber", "saddle")
        ]
        return parts
    if kind == "sheet":
        return _sheet_saddle(r, axis, style, rng)
    wide, thick = 0.10 + 0.1 * r, 0.008 + 0.006 * r
    wear = _across(wrapped(r - 0.002, -np.pi / 2 - half, 2 * half, -0.6 * wide, 0.6 * wide, thick, style), axis)
    web = _cradle(r, axis, 0.9 * r, thick, style, 0.9 * half, 0.5 * thick)
    ribs = []
    for y in np.linspace(-0.8, 0.8, int(rng.integers(2, 5))) * r:
        top = axis - np.sqrt(r * r - y * y) - 0.3 * thick
        ribs.append(box((wide, thick, top), (0, y, top / 2)))
    base = box((1.3 * wide, 2.0 * r, 0.015), (0, 0, 0.0075))
    spots = [(0.0, s * 0.9 * r) for s in (-1, 1)]
    return [
        Part(merge([web, *ribs]), "saddle", "steel", "saddle"),
        Part(wear, "saddle", "steel", "saddle"),
        Part(base, "saddle", "steel", "saddle"),
        anchors(spots, 0.02, 0.015),
    ]


def _across(solid: Solid, axis: float) -> Solid:
    """What was built about z laid about the vessel's axis along x, its -y then downward."""
    return moved(solid, at(0, 0, axis) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2))


def _cradle(
    r: float, axis: float, reach: float, wide: float, style: ModelingStyle, half: float, lift: float = -0.002
) -> Solid:
    """A plate or block across x with a round seat for the vessel, from the floor up."""
    half = min(half, float(np.arcsin(min(0.99, reach / r))) if reach < r else half)
    a = np.linspace(-np.pi / 2 - half, -np.pi / 2 + half, max(5, style.round(r) // 3))
    seat = (r + lift) * np.column_stack([np.cos(a), np.sin(a)])
    edge = max(reach, float(seat[:, 0].max()) + 0.001)
    foot = -axis
    corners = np.array([(edge, seat[-1, 1]), (edge, foot), (-edge, foot), (-edge, seat[0, 1])])
    return _across(extrude(np.vstack([seat, corners])[::-1], -wide / 2, wide / 2), axis)


def _sheet_saddle(r: float, axis: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A saddle folded from one sheet: a box without ribs, its sides flared to the feet, with bent-out flanges."""
    wide, thick, half = 0.08 + 0.12 * r, 0.004, float(rng.uniform(0.6, 0.9))
    seat = _across(wrapped(r - 0.001, -np.pi / 2 - half, 2 * half, -wide / 2, wide / 2, thick, style), axis)
    y, z = r * np.sin(half), axis - r * np.cos(half)
    spread = float(rng.uniform(1.0, 1.35)) * y
    walls = []
    for s in (-1, 1):
        path = np.array([(0, s * y, z), (0, s * spread, thick / 2), (0, s * (spread + 0.06), thick / 2)], float)
        section = np.array(
            [[wide / 2, -thick / 2], [wide / 2, thick / 2], [-wide / 2, thick / 2], [-wide / 2, -thick / 2]]
        )
        walls.append(sweep(path, section, up=(1.0, 0.0, 0.0)))
    spots = [(0.0, s * (spread + 0.035)) for s in (-1, 1)]
    return [Part(merge([seat, *walls]), "saddle", "steel"), anchors(spots, 0.012, thick)]


def _frame_saddle(r: float, axis: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Two legs of angle, channel or tube with a cross bar and a cradle of flat bar."""
    side, half = 0.05 + 0.05 * r, float(rng.uniform(0.7, 1.0))
    wide = 1.4 * side
    strip = _across(wrapped(r - 0.001, -np.pi / 2 - half, 2 * half, -wide / 2, wide / 2, 0.01, style), axis)
    y, top = r * np.sin(0.8 * half), axis - r * np.cos(0.8 * half)
    shapes = (
        section_angle(side, 0.1 * side) - 0.4 * side,
        rounded_rectangle(side, side, 0.0),
        section_i(side, side, 0.07 * side, 0.1 * side),
    )
    section = shapes[int(rng.integers(3))]
    lean = float(rng.choice([0.0, 0.0, 0.3])) * r
    solids, plates = [strip], []
    for s in (-1, 1):
        solids.append(bar((0, s * (y + lean), 0.01), (0, s * y, top), section, (1.0, 0.0, 0.0)))
        plates.append(foot_plate(0, s * (y + lean), 2.0 * side))
    level = float(rng.uniform(0.25, 0.6)) * (axis - r)
    reach = y + lean * (1 - level / top)
    solids.append(bar((0, -reach, level), (0, reach, level), rounded_rectangle(0.7 * side, 0.7 * side, 0.0)))
    return [Part(merge(solids), "saddle", "steel"), *(Part(p, "base plate", "steel", "", _FRAME) for p in plates)]


# --- skirts and legs, under an upright drum ---


def skirt(kind: str, drum: Drum, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A skirt under a drum (DIN 28082): ``open`` (doorways), ``flared`` or ``chairs`` (bolt chairs)."""
    r, low, name = drum.r, drum.low, "skirt"
    wall, thick = max(0.006, 0.012 * r), 0.012 + 0.01 * r
    lap = 0.02 + 0.04 * r
    if kind == "flared":
        foot = r * float(rng.uniform(1.2, 1.5))
        outline = [
            (foot - wall, thick),
            (foot, thick),
            (r + wall, low),
            (r + wall, low + lap),
            (r, low + lap),
            (r, low),
        ]
        cone = weld([revolve(outline, drum.n, closed=True)])
        base = ring(0.88 * foot, 1.15 * foot, 0.0, thick, drum.n)
        return [Part(cone, name, "tank", name), Part(base, name, "tank", name)]
    inner = r - drum.dip - 0.001
    base = ring(0.85 * r, 1.16 * r + 0.03, 0.0, thick, drum.n)
    if kind == "open":
        return [*_open_skirt(inner, low, lap, wall, thick, drum, style, rng), Part(base, name, "tank", name)]
    tube = ring(inner, r + wall, thick, low + lap, drum.n)
    count, tall = int(rng.choice([8, 12, 16])), float(rng.uniform(0.1, 0.2))
    reach = 0.13 * r + 0.03
    webs = merge([box((reach, 0.012, tall), (reach / 2 - 0.01, y, thick + tall / 2)) for y in (-0.04, 0.04)])
    parts = [
        Part(tube, name, "tank", name),
        Part(base, name, "tank", name),
        Part(around(webs, count, r), name, "tank", name),
    ]
    top = thick + tall
    if rng.random() < 0.5:
        parts.append(Part(ring(r, r + reach, top, top + thick, drum.n), name, "tank", name))
    else:
        parts.append(
            Part(around(box((reach, 0.13, thick), (reach / 2, 0, top + thick / 2)), count, r), name, "tank", name)
        )
    a = 2 * np.pi * np.arange(count) / count
    spots = [(float((r + 0.6 * reach) * np.cos(t)), float((r + 0.6 * reach) * np.sin(t))) for t in a]
    return [*parts, anchors(spots, 0.024, top + thick)]


def _open_skirt(
    inner: float,
    low: float,
    lap: float,
    wall: float,
    thick: float,
    drum: Drum,
    style: ModelingStyle,
    rng: np.random.Generator,
) -> list[Part]:
    """A cylindrical skirt with doorways, and pipe sleeves or vents near its top."""
    sill, head = thick + 0.12 * low, thick + 0.6 * low
    count, door = int(rng.integers(1, 4)), float(rng.uniform(0.5, 0.9))
    full = wall + drum.r - inner
    solids = [ring(inner, inner + full, thick, sill, drum.n), ring(inner, inner + full, head, low + lap, drum.n)]
    frames = []
    for k in range(count):
        start = 2 * np.pi * k / count + door / 2
        turn = 2 * np.pi / count - door
        solids.append(wrapped(inner, start, turn, sill, head, full, style))
        for a in (start, start + turn):
            frames.append(moved(box((0.05, 0.012, head - sill), (drum.r, 0, (head + sill) / 2)), spun("z", a)))
    vents = [
        moved(
            ring(0.03, 0.042, -0.06, 0.03, 12), spun("z", a) @ at(drum.r, 0, 0.5 * (head + low)) @ spun("y", np.pi / 2)
        )
        for a in np.arange(4) * np.pi / 2 + 0.3
    ]
    return [Part(merge(solids), "skirt", "tank", "skirt"), Part(merge([*frames, *vents]), "skirt", "tank", "skirt")]


def legs(kind: str, drum: Drum, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Legs under a drum (DIN 28081): ``angle``, ``pipe`` (slanted or upright, on round feet), ``beam`` (braced rolled).

    Also ``bracket`` (lugs that rest on a frame), ``pads`` (short feet under the head) and ``tripod`` (bent flat bars).
    """
    if kind == "bracket":
        return _bracketed(drum, rng)
    count = int(rng.choice([3, 4, 4, 6])) if kind in ("beam", "pipe") else int(rng.choice([3, 4]))
    r, low, side = drum.r, drum.low, 0.045 + 0.06 * drum.r
    lap = 0.1 + 0.25 * r
    name, parts = "tank leg", []
    turns = [2 * np.pi * k / count + 0.5 for k in range(count)]
    out = r - drum.dip
    for turn in turns:
        pose = spun("z", turn)
        if kind == "angle":
            solid = moved(
                extrude(section_angle(side, 0.12 * side), 0.01, low + lap),
                at(out + 1.38 * side) @ spun("z", 0.75 * np.pi),
            )
            solid = merge([solid, box((0.02, 1.6 * side, 1.3 * lap), (out + 0.008, 0, low + 0.65 * lap))])
        elif kind == "pads":
            solid = _short_foot(r, low, side, style)
        elif kind == "pipe":
            solid = rod((out + 0.45 * side, 0, 0.01), (out + 0.45 * side, 0, low + lap), 0.5 * side, style.round(side))
        elif kind == "tripod":
            path = np.array(
                [(out + 0.004, 0, low + lap), (out + 0.004, 0, low), (1.15 * r, 0, 0.06), (1.15 * r + 0.08, 0, 0.006)]
            )
            path[-2:, 2] = (0.006, 0.006)
            solid = sweep(path, rounded_rectangle(1.2 * side, 0.01, 0.0), up=(0.0, 1.0, 0.0))
        else:
            solid = moved(
                extrude(section_i(1.2 * side, 1.1 * side, 0.08 * side, 0.1 * side), 0.01, low + lap),
                at(out + 0.6 * side),
            )
        parts.append(Part(moved(solid, pose), name, "steel", name))
        if kind in ("angle", "beam", "pipe"):
            foot = cylinder(0.9 * side, 0, 0.012, 16) if kind == "pipe" else foot_plate(0, 0, 2.0 * side)
            parts.append(Part(moved(foot, pose @ at(out + 0.6 * side)), "base plate", "steel", "", _FRAME))
    if kind == "beam" and low > 0.35:
        parts += _braces(turns, out + 0.6 * side, low, 0.5 * side, rng)
    return parts


def _short_foot(r: float, low: float, side: float, style: ModelingStyle) -> Solid:
    """A stub under the head with a levelling pad."""
    x = 0.68 * r
    stub = cylinder(0.45 * side, 0.03, low + 0.02, style.round(side))
    pad = merge([cylinder(0.2 * side, 0.01, 0.04, 10), cylinder(0.8 * side, 0, 0.015, 16)])
    return moved(merge([stub, pad]), at(x))


def _braces(turns: list[float], reach: float, low: float, side: float, rng: np.random.Generator) -> list[Part]:
    """Crossed or single braces between neighbouring legs."""
    parts, crossed = [], bool(rng.random() < 0.6)
    section = rounded_rectangle(side, 0.3 * side, 0.0)
    for a, b in zip(turns, [*turns[1:], turns[0]], strict=True):
        p, q = ((reach * np.cos(t), reach * np.sin(t)) for t in (a, b))
        for low_end, high_end in ((p, q), (q, p))[: 2 if crossed else 1]:
            solid = bar((*low_end, 0.15 * low), (*high_end, 0.85 * low), section)
            parts.append(Part(solid, "brace", "steel", "", _FRAME))
    return parts


def _bracketed(drum: Drum, rng: np.random.Generator) -> list[Part]:
    """Brackets (DIN 28083) halfway up the shell that rest on a frame of four columns and beams."""
    r, z = drum.r, drum.low + float(rng.uniform(0.35, 0.6)) * (drum.high - drum.low)
    side, reach = 0.06 + 0.05 * r, 0.1 + 0.12 * r
    depth = 1.6 * reach
    gusset = np.array([[0, 0], [reach, 0], [reach, 0.2 * depth], [0, depth]])
    webs = [moved(extrude(gusset, y, y + 0.008), spun("x", np.pi / 2)) for y in (-0.35 * reach, 0.35 * reach)]
    back = box((0.012 + drum.dip, 1.2 * reach, 1.2 * depth), (0.004 - drum.dip / 2, 0, 0.5 * depth))
    foot = box((reach, reach, 0.012), (0.5 * reach, 0, 0.0))
    one = moved(merge([*webs, back, foot]), at(0, 0, z + 0.006))
    parts = [Part(moved(one, spun("z", k * np.pi / 2) @ at(r)), "tank leg", "steel", "tank leg") for k in range(4)]
    w, tall = r + 0.6 * reach, 1.3 * side
    post = section_i(side, side, 0.08 * side, 0.1 * side)
    for sx in (-1, 1):
        for sy in (-1, 1):
            column = moved(extrude(post, 0.012, z - tall), at(sx * w, sy * w))
            parts.append(Part(column, "column", "steel", "", _FRAME))
            parts.append(Part(foot_plate(sx * w, sy * w, 2 * side), "base plate", "steel", "", _FRAME))
    beam = section_channel(tall, 0.6 * side, 0.1 * side, 0.12 * side)
    for k in range(4):
        solid = bar(
            (w, -w - side / 2, z - tall / 2), (w, w + side / 2, z - tall / 2), beam - [0.3 * side, 0], (-1.0, 0.0, 0.0)
        )
        parts.append(Part(moved(solid, spun("z", k * np.pi / 2)), "beam", "steel", "", _FRAME))
    return parts


# --- access ---


def ladder(x: float, low: float, high: float, style: ModelingStyle, caged: bool, spacers: float) -> list[Part]:
    """A ladder beside a shell (ISO 14122-4) at ``x`` from the axis, its spacers reaching back this far [m]."""
    n, wide = max(6, min(10, style.round(0.02))), 0.4
    solids = [rod((x, s * wide / 2, low), (x, s * wide / 2, high), 0.02, n) for s in (-1, 1)]
    solids += [rod((x, -wide / 2, z), (x, wide / 2, z), 0.011, 6) for z in np.arange(low + 0.25, high - 0.05, 0.28)]
    for z in np.arange(low + 0.4, high - 0.9, 1.5):
        solids += [box((spacers, 0.05, 0.01), (x - spacers / 2, s * wide / 2, z)) for s in (-1, 1)]
    if caged and high - low > 2.8:
        a = np.linspace(-np.pi / 2, np.pi / 2, 9)
        hoop = np.column_stack([x + 0.1 + 0.6 * np.cos(a), 0.36 * np.sin(a), np.zeros(9)])
        hoop = np.vstack([[(x, -wide / 2, 0)], hoop, [(x, wide / 2, 0)]])
        for z in np.arange(low + 2.2, high, 0.8):
            solids.append(sweep(hoop + np.array([0, 0, z]), rounded_rectangle(0.05, 0.006, 0.0), up=(0.0, 0.0, 1.0)))
        for k in (2, 5, 8):
            solids.append(box((0.006, 0.04, high - low - 2.2), (hoop[k, 0], hoop[k, 1], (high + low + 2.2) / 2)))
    return [Part(merge(solids), "ladder", "safety", "", _FRAME)]


def ringed_rail(r: float, low: float, n: int) -> list[Part]:
    """A railing round the edge of a roof: two tubes on posts."""
    rails = [moved(torus(r, 0.02, n, 6), at(0, 0, low + z)) for z in (0.55, 1.1)]
    count = max(6, int(2 * np.pi * r / 1.5))
    posts = around(rod((0, 0, low - 0.03), (0, 0, low + 1.1), 0.02, 8), count, r * np.cos(np.pi / n))
    return [Part(merge([*rails, posts]), "railing", "safety", "", _FRAME)]
