"""Level gauges beside small vessels, and level instruments on a flange."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import (
    CASE,
    JOINT,
    TANK,
    dial,
    fine_sides,
    gland,
    headed,
    housing,
    piece,
    screws,
    t_handle,
    vessel,
)
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["LEVEL_BUILDS"]

_NAME, _KIND, _PAD = "level gauge", "level gauge", 0.002


def _heights(rng: np.random.Generator, least: float = 0.35, most: float = 1.1) -> tuple[float, float]:
    low = float(rng.uniform(0.35, 0.6))
    return low, low + float(rng.uniform(least, most))


def _beside(low: float, high: float, dn: int, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A vessel with two flanged nozzles to x = 0, and the joints there."""
    return vessel(low, high, dn, style, rng)


def _arms(low: float, high: float, dn: int, x: float, style: ModelingStyle) -> list[Solid]:
    """Two flanges in x = 2 mm with necks out to ``x``."""
    return [along("x", disc_flange(dn, style, x - _PAD), _PAD, 0, z) for z in (low, high)]


def _magnetic(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A magnetic bypass indicator: a chamber between two flanges, a column of flags strapped to it, a drain flange."""
    low, high = _heights(rng)
    dn, r = int(rng.choice([15, 20, 25])), 0.0302
    x, n = float(rng.uniform(0.1, 0.15)), style.round(r)
    bottom, top = low - float(rng.uniform(0.12, 0.2)), high + float(rng.uniform(0.1, 0.2))
    chamber = [moved(cylinder(r, bottom, top, n), at(x)), *_arms(low, high, dn, x, style)]
    if rng.random() < 0.6:  # flanged ends
        chamber += [moved(cylinder(0.065, z - 0.009, z + 0.009, n), at(x)) for z in (bottom + 0.02, bottom + 0.04)]
    else:
        chamber.append(moved(turned([(r, top), (0.7 * r, top + 0.018), (0.2 * r, top + 0.022)], n), at(x)))
    plug = moved(
        merge([cylinder(0.0107, bottom - 0.04, bottom + 0.005, 12), hexagon(0.03, bottom - 0.05, bottom - 0.03)]), at(x)
    )
    wide = float(rng.uniform(0.028, 0.05))
    y, mid, long = -r - 0.012, (low + high) / 2, high - low
    rail = box((wide, 0.024, long + 0.06), (x, y, mid))
    count = min(28, max(8, int(long / 0.04)))
    flags = [
        box((0.5 * wide, 0.004, 0.6 * long / count), (x, y - 0.0139, low + (k + 0.5) * long / count))
        for k in range(count)
    ]
    straps = [moved(ring(r, r + 0.002, z, z + 0.01, n), at(x)) for z in (low + 0.15 * long, mid, low + 0.85 * long)]
    parts = [
        piece([*chamber, plug], _NAME, "trim"),
        piece(rail, CASE, "gauge", _NAME),
        piece(flags, "gauge face", "handle", _NAME),
    ]
    parts.append(Part(merge(straps), "clamp", "clamp", _NAME, JOINT))
    if rng.random() < 0.4:  # a transmitter's rod along the other side
        bar = moved(
            merge([cylinder(0.007, low, high + 0.12, 10), moved(housing(style, rng, "pot"), at(0, 0, high + 0.1))]),
            at(x + r + 0.007),
        )
        parts.append(piece(bar, "transmitter", "valve"))
    return Model([*_beside(low, high, dn, style, rng), *parts], kind=_KIND)


def _cock(x: float, z: float, up: int, style: ModelingStyle, rng: np.random.Generator, wheel: bool) -> Solid:
    """A gauge cock or offset valve about the pipe's axis, its gauge end at x, its spindle away from the glass [m]."""
    body = [
        box((0.04, 0.036, 0.036), (x, 0, z)),
        moved(hexagon(0.034, -0.045, -0.015) if up < 0 else hexagon(0.034, 0.015, 0.045), at(x, 0, z)),
    ]
    spindle = cylinder(0.008, 0.015, 0.055, 10)
    if wheel:
        grip = merge([cylinder(0.03, 0.05, 0.06, fine_sides(0.03, style)), hexagon(0.012, 0.058, 0.068)])
    else:
        grip = rod((0, 0, 0.05), (0.0, 0.06, 0.05), 0.005, 8)
    body.append(along("x", merge([spindle, grip]), x, 0, z))
    return merge(body)


def _reflex(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A reflex or transparent gauge: steel frames with long glasses bolted in sections, two cocks (DIN 7081 glass)."""
    sections, each = int(rng.integers(1, 5)), float(rng.choice([0.19, 0.25, 0.32]))
    low = float(rng.uniform(0.35, 0.6))
    body = sections * each
    high, dn = low + body + 0.14, int(rng.choice([15, 20, 25]))
    x, wide, deep = 0.1, float(rng.uniform(0.045, 0.065)), float(rng.uniform(0.04, 0.06))
    wheel = bool(rng.random() < 0.6)
    metal = [
        *_arms(low, high, dn, x, style),
        _cock(x, low, 1, style, rng, wheel),
        _cock(x, high, -1, style, rng, wheel),
    ]
    metal.append(moved(cylinder(0.01, low, high, 10), at(x)))
    both = bool(rng.random() < 0.4)
    panes, bolts = [], []
    for k in range(sections):
        z = low + 0.07 + (k + 0.5) * each
        frame = rounded_rectangle(wide, 0.97 * each, 0.3 * wide, 3)
        slot = rounded_rectangle(0.4 * wide, 0.85 * each, 0.18 * wide, 3)
        up = at(x, 0, z) @ spun("x", np.pi / 2)
        metal.append(moved(extrude(frame, -deep / 2, 0.0), up))
        metal.append(moved(extrude(frame, 0.0, deep / 2, (slot,)), up))
        panes.append(moved(extrude(0.99 * slot, 0.0, deep / 2 - 0.006), up))
        if both:
            panes.append(moved(extrude(0.9 * slot, -deep / 2 - 0.001, -deep / 2 + 0.01), up))
        nut = merge(
            [cylinder(0.005, -deep / 2 - 0.006, deep / 2 + 0.01, 8), hexagon(0.016, deep / 2, deep / 2 + 0.008)]
        )
        for s in (-1, 1):
            for t in np.linspace(-0.42, 0.42, max(3, int(each / 0.06))):
                bolts.append(moved(nut, up @ at(s * 0.37 * wide, t * each)))
    if rng.random() < 0.5:
        metal.append(
            moved(merge([cylinder(0.008, low - 0.06, low, 10), hexagon(0.024, low - 0.065, low - 0.04)]), at(x))
        )
    parts = [piece(metal, _NAME, "trim"), piece(panes, "gauge glass", "dial", _NAME)]
    parts.append(Part(merge(bolts), "bolt", "fastener", _NAME, JOINT, True))
    return Model([*_beside(low, high, dn, style, rng), *parts], kind=_KIND)


def _tubular(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tubular gauge glass between two screwed cocks, with guard rods (13 to 20 mm)."""
    low, high = _heights(rng, 0.2, 0.8)
    parts = vessel(low, high, 15, style, rng, False)
    x, r, wheel = float(rng.uniform(0.05, 0.09)), float(rng.uniform(0.0065, 0.01)), bool(rng.random() < 0.5)
    metal = [along("x", cylinder(0.0095, 0.0, x, 12), 0, 0, z) for z in (low, high)]
    metal += [along("x", hexagon(0.028, 0.004, 0.02), 0, 0, z) for z in (low, high)]
    metal += [_cock(x, low, 1, style, rng, wheel), _cock(x, high, -1, style, rng, wheel)]
    metal += [
        moved(hexagon(0.02, 0.0, 0.02), at(x, 0, high + 0.016)),
        along("-y", t_handle(0.05, 0.04), x, -0.017, low - 0.006),
    ]
    metal.append(moved(cylinder(0.006, low - 0.06, low - 0.01, 10), at(x)))
    glass = moved(cylinder(r, low + 0.03, high - 0.03, fine_sides(r, style)), at(x))
    parts += [piece(metal, _NAME, "trim"), piece(glass, "gauge glass", "dial", _NAME)]
    if rng.random() < 0.75:
        count = int(rng.choice([2, 3, 4]))
        bars = around(cylinder(0.0035, low + 0.024, high - 0.024, 8), count, 0.02, np.pi / 4)
        rings = [ring(r + 0.006, 0.026, z, z + 0.006, 12) for z in (low + 0.026, high - 0.032)]
        parts.append(piece(moved(merge([bars, *rings]), at(x)), _NAME, "clamp"))
    return Model(parts, kind=_KIND)


def _board(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A float-and-board gauge on a tank: a rope over two pulleys on the roof, a pointer before a long scale."""
    radius, tall = float(rng.uniform(0.6, 1.2)), float(rng.uniform(1.6, 3.0))
    n = style.round(radius)
    wall = [Part(cylinder(radius, 0.0, tall, n), "shell", "tank", "", TANK)]
    wall.append(Part(cylinder(1.03 * radius, tall, tall + 0.012, n), "dished head", "tank", "", TANK))
    wide, y = float(rng.uniform(0.1, 0.25)), -radius - 0.08
    scale = box((wide, 0.012, 0.88 * tall), (0, y, 0.48 * tall))
    feet = [box((0.5 * wide, 0.09, 0.03), (0, y + 0.05, s * tall)) for s in (0.12, 0.48, 0.84)]
    ticks = [box((0.5 * wide, 0.001, 0.008), (-0.2 * wide, y - 0.0064, s * tall)) for s in np.linspace(0.08, 0.88, 15)]
    parts = [Part(merge(feet), "bracket", "steel", "", JOINT), piece([scale, *ticks], "gauge face", "dial", _NAME)]
    pulley = along("x", merge([cylinder(0.035, -0.004, 0.004, 16), cylinder(0.008, -0.02, 0.02, 8)]))
    z, inner, y = tall + 0.09, -0.6 * radius, y - 0.024
    posts = [box((0.05, 0.04, 0.1), (0, inner, tall + 0.06)), box((0.05, 0.04, 0.1), (0, -0.93 * radius, tall + 0.06))]
    posts.append(box((0.03, 0.13 * radius + 0.06, 0.012), (0, -radius - 0.02, tall + 0.08)))
    # The rope runs on top of the pulleys and down before the board.
    stop = float(rng.uniform(0.15, 0.75)) * tall
    way = [(0, inner, tall + 0.01), (0, inner, z + 0.035), (0, y + 0.035, z + 0.035), (0, y, z), (0, y, stop)]
    metal = [*posts, moved(pulley, at(0, inner + 0.03, z)), moved(pulley, at(0, y + 0.035, z))]
    pointer = [box((0.7 * wide, 0.01, 0.03), (0.05 * wide, y + 0.008, stop)), box((0.06, 0.03, 0.05), (0, y, stop))]
    parts += [piece([*metal, rope(way, 0.003, 8)], _NAME, "trim"), piece(pointer, "gauge needle", "handle", _NAME)]
    return Model([*wall, *parts], kind=_KIND)


def _displacer(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A displacer or float chamber beside a vessel: two flanged arms, a bolted top, a torque arm and transmitter."""
    low, high = _heights(rng, 0.3, 0.8)
    dn, r = int(rng.choice([25, 40, 50])), float(rng.uniform(0.05, 0.085))
    x, n = r + float(rng.uniform(0.08, 0.13)), style.round(r)
    bottom, top = low - 0.06, high + 0.05
    lid = top + 0.024
    outline = [(0.3 * r, bottom - 0.4 * r), (r, bottom), (r, top), (1.7 * r, top), (1.7 * r, lid)]
    outline += [(1.7 * r, lid + 0.024), (0.8 * r, lid + 0.024), (0.8 * r, lid + 0.1), (0.4 * r, lid + 0.12)]
    chamber = [moved(turned(outline, n), at(x)), *_arms(low, high, dn, x, style)]
    chamber.append(moved(cylinder(0.0107, bottom - 0.4 * r - 0.05, bottom - 0.3 * r, 12), at(x)))
    parts = [piece(chamber, _NAME, "valve")]
    parts += placed([screws(int(rng.choice([8, 12])), 1.45 * r, 0.016, top, lid + 0.024, _NAME)], at(x))
    z, side = lid + 0.065, str(rng.choice(["y", "-y", "x"]))
    arm = merge([cylinder(0.022, 0.0, 0.8 * r + 0.1, 14), cylinder(0.036, 0.8 * r + 0.09, 0.8 * r + 0.11, 14)])
    head = moved(housing(style, rng), at(0, 0, 0.8 * r + 0.105))
    if rng.random() < 0.5:
        head = moved(
            merge([box((0.14, 0.14, 0.1), (0, 0, 0.05)), gland_on(0.07, style, rng)]), at(0, 0, 0.8 * r + 0.108)
        )
    parts.append(piece(along(side, arm, x, 0, z), _NAME, "valve"))
    parts.append(piece(along(side, head, x, 0, z), "transmitter", "electrical"))
    return Model([*_beside(low, high, dn, style, rng), *parts], kind="level transmitter")


def gland_on(reach: float, style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A gland out of a box's side [m]."""
    return along("x", gland(style, rng), reach - 0.001, 0, 0.05)


def _neck(dn: int, tall: float, r: float, style: ModelingStyle) -> list[Solid]:
    thick = plate_thickness(dn)
    return [disc_flange(dn, style, thick + 0.001), cylinder(r, thick, thick + tall, style.round(r))]


def _radar(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A radar gauge on a flange: a neck with cooling ribs or a wave guide, a housing, a horn or rod below the face."""
    tall, r = float(rng.uniform(0.04, 0.15)), float(rng.uniform(0.015, 0.03))
    solids, thick = _neck(dn, tall, r, style), plate_thickness(dn)
    if rng.random() < 0.4:
        solids += [cylinder(1.5 * r, thick + s * tall, thick + (s + 0.08) * tall, 16) for s in (0.2, 0.4, 0.6, 0.8)]
    wide = 0.45 * PIPES[dn].bore
    if rng.random() < 0.6:
        solids.append(turned([(wide, -0.12), (0.4 * wide, -0.03), (0.4 * wide, 0.001)], 16))
    else:
        solids.append(turned([(0.2 * wide, -0.1), (0.6 * wide, -0.02), (0.6 * wide, 0.001)], 16))
    head = moved(housing(style, rng), at(0, 0, thick + tall - 0.002) @ spun("z", float(rng.uniform(0, 6))))
    return Model(headed([piece(solids, _NAME, "trim"), piece(head, "transmitter", "valve")]), kind="level transmitter")


def _ultrasonic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An ultrasonic gauge: a fat plastic body, cone or stepped can screwed in a flange, its lid flat or slanting."""
    thick, r = plate_thickness(dn), float(rng.uniform(0.03, 0.048))
    n, tall = style.round(r), float(rng.uniform(0.08, 0.16))
    plate = [disc_flange(dn, style, thick + 0.001), cylinder(0.42 * PIPES[dn].bore, -0.03, 0.001, n)]
    kind, z = int(rng.integers(3)), thick
    if kind == 0:
        body = turned([(0.7 * r, z), (0.7 * r, z + 0.02), (1.3 * r, z + 0.6 * tall), (1.3 * r, z + tall)], n)
    elif kind == 1:
        body = turned(
            [
                (0.8 * r, z),
                (0.8 * r, z + 0.3 * tall),
                (1.2 * r, z + 0.35 * tall),
                (1.2 * r, z + tall),
                (r, z + 1.1 * tall),
            ],
            n,
        )
    else:
        case = extrude(rounded_rectangle(2.6 * r, 2.0 * r, 0.4 * r, 3), z + 0.35 * tall, z + tall)
        body = merge([cylinder(0.8 * r, z, z + 0.4 * tall, n), case])
    out = along("x", gland(style, rng), 1.1 * r, 0, z + 0.75 * tall)
    view = box((1.0 * r, 0.6 * r, 0.003), (0, 0, z + 1.1 * tall if kind == 1 else z + tall + 0.001))
    nut = hexagon(2.2 * r, z - 0.001, z + 0.014)
    parts = [
        piece([*plate, nut], _NAME, "trim"),
        piece([body, out], "transmitter", "electrical"),
        piece(view, CASE, "dial"),
    ]
    return Model(headed(parts), kind="level transmitter")


def _fork(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vibrating-fork or rod switch on a flange: an extension, tines or a capacitance rod below, a small head."""
    thick, tall = plate_thickness(dn), float(rng.uniform(0.03, 0.1))
    r = min(0.0107, 0.3 * PIPES[dn].bore)
    solids = [*_neck(dn, tall, 0.012, style), hexagon(0.036, thick, thick + 0.018), cylinder(r, -0.08, 0.001, 12)]
    if rng.random() < 0.7:
        solids += [box((0.004, 0.7 * r, 0.05), (s * 0.6 * r, 0, -0.1)) for s in (-1, 1)]
    else:
        solids.append(cylinder(0.5 * r, -0.14, -0.078, 10))
    head = moved(housing(style, rng, str(rng.choice(["pot", "slant", "single"]))), at(0, 0, thick + tall - 0.002))
    return Model(headed([piece(solids, _NAME, "trim"), piece(head, "transmitter", "valve")]), kind="level switch")


def _swing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dial gauge of a tank's float arm: a small flange or oval head with screws, a dial that lies on it."""
    thick, size = plate_thickness(dn), float(rng.choice([0.05, 0.08, 0.1]))
    high = thick + float(rng.uniform(0.008, 0.03))
    solids = [disc_flange(dn, style, thick + 0.001), cylinder(0.3 * size, thick, high + 0.001, 14)]
    arm = [cylinder(0.005, -0.05, 0.001, 8), rod((0, 0, -0.048), (0.3 * PIPES[dn].bore, 0, -0.09), 0.004, 8)]
    head = placed(dial(size, style, rng, str(rng.choice(["plain", "turret", "crimped"])), 0.025), at(0, 0, high))
    return Model(headed([piece([*solids, *arm], _NAME, "trim"), *head]), kind=_KIND)


def _side_float(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A float switch for a side flange: a switch box behind it, square flange or round, a float on an arm in front."""
    thick = plate_thickness(dn)
    wide, tall, deep = (float(rng.uniform(a, b)) for a, b in ((0.08, 0.12), (0.09, 0.15), (0.06, 0.1)))
    low = thick + float(rng.uniform(0.02, 0.05))
    solids = [disc_flange(dn, style, thick + 0.001), cylinder(0.025, thick, low + 0.001, 14)]
    solids += [cylinder(0.006, -0.07, 0.001, 8), moved(cylinder(0.36 * PIPES[dn].bore, -0.14, -0.065, 14), at())]
    case = extrude(rounded_rectangle(wide, tall, 0.1 * wide, 3), low, low + deep)
    lid = extrude(rounded_rectangle(1.04 * wide, 1.04 * tall, 0.1 * wide, 3), low + 0.75 * deep, low + deep + 0.008)
    out = along("-y", gland(style, rng), 0, -0.5 * tall + 0.001, low + 0.4 * deep)
    parts = [piece(solids, _NAME, "valve"), piece([case, lid, out], "transmitter", "electrical")]
    return Model(headed(parts), kind="level switch")


def _column(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An oil-level column on a machine's reservoir: two banjo bolts, a clear bar with a guard, maybe a thermometer."""
    long, wide = float(rng.uniform(0.08, 0.3)), float(rng.uniform(0.025, 0.04))
    size = (float(rng.uniform(0.4, 0.8)), float(rng.uniform(0.3, 0.5)), long + float(rng.uniform(0.15, 0.3)))
    sump = Part(box(size, (0, size[1] / 2, size[2] / 2)), "tank", "tank", "", TANK)
    z = 0.5 * size[2]
    x = float(rng.uniform(-0.25, 0.25)) * size[0]
    back = extrude(rounded_rectangle(wide, long + 0.05, 0.3 * wide, 3), 0.0, 0.008)
    walls = [box((0.004, long + 0.02, 0.02), (s * 0.45 * wide, 0, 0.016)) for s in (-1, 1)]
    glass = extrude(rounded_rectangle(0.6 * wide, long - 0.03, 0.25 * wide, 3), 0.008, 0.024)
    ends = [moved(cylinder(0.42 * wide, 0.0, 0.022, 14), at(0, s * long / 2)) for s in (-1, 1)]
    bolts = [moved(hexagon(0.017, 0.022, 0.03), at(0, s * long / 2)) for s in (-1, 1)]
    parts = [piece([back, *walls, *ends], _NAME, "electrical"), piece(glass, "gauge glass", "dial", _NAME)]
    parts.append(Part(merge(bolts), "screw", "fastener", _NAME, JOINT, True))
    return Model([sump, *placed(parts, at(x, 0, z) @ spun("x", np.pi / 2))], kind=_KIND)


def _family(
    name: str, build: object, place: str = "floor", sizes: tuple[int, ...] = (15,), weight: float = 1.0
) -> Family:
    return Family(name, place, "Gauge assembly", _NAME, build, sizes, weight=weight)  # type: ignore[arg-type]


_HEADS = (50, 65, 80, 100, 150)
LEVEL_BUILDS: tuple[Family, ...] = (
    _family("level gauge/magnetic", _magnetic, weight=1.5),
    _family("level gauge/reflex", _reflex, weight=1.5),
    _family("level gauge/tubular", _tubular, weight=1.5),
    _family("level gauge/board", _board),
    _family("level gauge/displacer", _displacer),
    _family("level gauge/column", _column),
    _family("level gauge/radar", _radar, "head", _HEADS),
    _family("level gauge/ultrasonic", _ultrasonic, "head", _HEADS),
    _family("level gauge/fork", _fork, "head", (25, 40, 50, 80)),
    _family("level gauge/swing dial", _swing, "head", (40, 50, 80)),
    _family("level gauge/side float", _side_float, "head", (65, 80, 100)),
)
