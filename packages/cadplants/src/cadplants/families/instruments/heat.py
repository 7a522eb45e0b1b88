"""Thermometers, thermowells and temperature sensors."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import (
    CASE,
    FRAME,
    JOINT,
    STEM,
    bent,
    board,
    dial,
    fine_sides,
    gland,
    headed,
    housing,
    piece,
    screws,
)
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, fronted, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import along, ball, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["HEAT_BUILDS"]

_WELL, _KIND = "thermowell", "thermometer"


def _top_of(low: float, style: ModelingStyle, rng: np.random.Generator, kind: str = "") -> list[Part]:
    """What is screwed on a thermowell: an extension with a head, a bimetal dial, a plug with a chain [m]."""
    r, n = float(rng.uniform(0.007, 0.012)), 12
    kind = kind or str(rng.choice(["head", "head", "union", "dial", "plug"]))
    if kind == "plug":
        cap = merge([hexagon(0.03, low - 0.001, low + 0.014), ball_at(0.009, low + 0.018, style)])
        links = [
            moved(
                torus(0.005, 0.0013, 8, 5), at(0.02 + 0.006 * k, 0, low + 0.006 - 0.005 * k) @ spun("x", 1.57 * (k % 2))
            )
            for k in range(5)
        ]
        return [piece([cap, *links], _WELL, "trim")]
    high = low + float(rng.uniform(0.03, 0.16))
    neck = [cylinder(r, low - 0.002, high, n), hexagon(2.6 * r, low - 0.001, low + 0.012)]
    if kind == "union":  # nipple, union, nipple
        mid = (low + high) / 2
        neck += [hexagon(4.2 * r, mid - 0.008, mid + 0.012), cylinder(1.7 * r, mid - 0.018, mid + 0.022, n)]
    parts = [piece(neck, _WELL, "trim")]
    if kind == "dial":
        tilt = float(rng.choice([0.0, np.pi / 4, np.pi / 2]))
        size = float(rng.choice([0.063, 0.08, 0.1, 0.13]))
        joint = ball_at(0.014, high, style)
        head = dial(size, style, rng, str(rng.choice(["plain", "crimped", "bayonet"])))
        # The back of the case sits on a swivel just beyond the neck.
        pose = at(0, 0, high) @ spun("x", tilt) @ at(0, 0.0, 0.01)
        return [*parts, piece(joint, STEM, "trim"), *placed(head, pose)]
    turn = spun("z", float(rng.uniform(0, 6)))
    parts.append(piece(moved(housing(style, rng), at(0, 0, high - 0.003) @ turn), "transmitter", "valve"))
    return parts


def ball_at(radius: float, z: float, style: ModelingStyle) -> Solid:
    """A ball on the axis [m]."""
    return moved(ball(radius, fine_sides(radius, style, 12)), at(0, 0, z))


def _kind_of(parts: list[Part]) -> str:
    names = {p.name for p in parts}
    return "temperature transmitter" if "transmitter" in names else _KIND if CASE in names else "thermowell"


def _probe(reach: float, r: float, n: int) -> Solid:
    """The part of a well in the flow, from -reach to 0: tapered, stepped or straight [m]."""
    return turned([(0.6 * r, -reach), (r, 0.0)], n)


def _flanged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flanged thermowell (ASME B40.9, B16.5 flange) with a lagging extension and a head, dial or plug."""
    thick = plate_thickness(dn)
    r = 0.011
    well = [disc_flange(dn, style, thick + 0.001), _probe(float(rng.uniform(0.02, 0.06)), r, 12)]
    well.append(cylinder(0.017, thick, thick + float(rng.uniform(0.015, 0.08)), 16))
    high = float(well[-1].vertices[:, 2].max())
    parts = [piece(well, _WELL, "trim"), *_top_of(high, style, rng)]
    return Model(headed(parts), kind=_kind_of(parts))


def _van_stone(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Van Stone thermowell (ASME B40.9): a collar as wide as the raised face under a loose lap flange."""
    size, thick, n = FLANGES[dn], plate_thickness(dn), style.round(FLANGES[dn].raised / 2)
    collar, r = 0.4 * thick, 0.016
    well = [cylinder(size.raised / 2, 0.0, collar, n), cylinder(r, collar, thick + 0.03, 16), _probe(0.04, 0.011, 12)]
    holes = tuple(
        circle(size.hole / 2, 10, (size.circle / 2 * np.cos(a), size.circle / 2 * np.sin(a)))
        for a in (2 * np.arange(size.n_bolts) + 1) * np.pi / size.n_bolts
    )
    lap = extrude(circle(size.outer / 2, n), collar, thick, (circle(1.05 * r, 16), *(holes if style.holes else ())))
    parts = [piece(well, _WELL, "trim"), Part(lap, "flange", "flange", _WELL, "Pipe assembly")]
    parts += _top_of(thick + 0.03, style, rng)
    return Model(headed(parts), kind=_kind_of(parts))


def _welded(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A weld-in thermowell (DIN 43772 form 4): a smooth cone through a boss, no hexagon, with its head."""
    r, tall = float(rng.uniform(0.009, 0.013)), float(rng.uniform(0.04, 0.12))
    n = style.round(r)
    boss = turned([(2.2 * r, 0.0), (2.0 * r, 0.012), (1.3 * r, 0.022)], n)
    well = [boss, turned([(0.7 * r, -0.03), (r, 0.0), (r, tall)], n)]
    parts = [piece(well, _WELL, "trim"), *_top_of(tall, style, rng)]
    return Model(parts, kind=_kind_of(parts))


def _screwed(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded thermowell with a long lagging extension or a two-step hexagon, and what is screwed into it."""
    r, lag = float(rng.uniform(0.008, 0.014)), float(rng.uniform(0.02, 0.11))
    n = style.round(r)
    well = [cylinder(1.25 * r, 0.0, 0.022, n), _probe(0.03, r, n), hexagon(3.4 * r, 0.018, 0.034)]
    well.append(turned([(1.5 * r, 0.03), (1.5 * r, 0.034 + lag), (1.2 * r, 0.04 + lag)], n))
    high = 0.04 + lag
    if rng.random() < 0.4:
        well.append(hexagon(3.2 * r, high - 0.004, high + 0.014))
        high += 0.014
    parts = [piece(well, _WELL, "trim"), *_top_of(high, style, rng)]
    return Model(parts, kind=_kind_of(parts))


def _test(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A test well with a cap on a chain."""
    r, tall = float(rng.uniform(0.009, 0.015)), float(rng.uniform(0.03, 0.09))
    n = style.round(r)
    well = merge([cylinder(1.1 * r, 0.0, tall, n), hexagon(3.2 * r, 0.5 * tall, tall), _probe(0.03, r, n)])
    return Model([piece(well, _WELL, "trim"), *_top_of(tall, style, rng, "plug")], kind="thermowell")


def _bimetal(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bimetal thermometer: a dial at the back, at the bottom or at every angle on a slim stem (EN 13190)."""
    size, tall = float(rng.choice([0.05, 0.063, 0.08, 0.1, 0.13])), float(rng.uniform(0.03, 0.1))
    n, deep = fine_sides(0.01, style), 0.3 * size
    stem_ = [cylinder(0.009, 0.0, 0.02, n), hexagon(0.024, 0.016, 0.03), cylinder(0.0045, 0.025, tall + 0.03, n)]
    design, kind = str(rng.choice(["plain", "crimped", "bayonet"])), int(rng.integers(3))
    head, top = dial(size, style, rng, design, deep), tall + 0.03
    if kind == 0:
        pose = at(0, 0, top - 0.001)
    elif kind == 1:
        pose = at(0, deep / 2, top + size / 2 - 0.002) @ spun("x", np.pi / 2)
    else:  # a hinge of two discs behind the case
        hinge = along("x", cylinder(0.013, -0.02, 0.02, n), 0, 0, top + 0.008)
        stem_ += [hinge, along("x", hexagon(0.012, 0.02, 0.026), 0, 0, top + 0.008)]
        tilt = float(rng.uniform(0.2, 1.5))
        pose = at(0, 0, top + 0.008) @ spun("x", tilt) @ at(0, 0, 0.012)
    return Model([piece(stem_, STEM, "trim"), *placed(head, pose)], kind=_KIND)


def _v_case(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An industrial glass thermometer in a V-shaped brass case (DIN 16181, 16182), straight or at an angle."""
    tall = float(rng.choice([0.11, 0.15, 0.2]))
    wide, deep = float(rng.uniform(0.026, 0.038)), float(rng.uniform(0.018, 0.028))
    low = float(rng.uniform(0.035, 0.06))
    v = np.array([(-0.5 * wide, -deep), (-0.36 * wide, -deep), (0.0, -0.2 * deep), (0.36 * wide, -deep)])
    v = np.vstack([v, [(0.5 * wide, -deep), (0.12 * wide, 0.3 * deep), (-0.12 * wide, 0.3 * deep)]])
    n = fine_sides(0.009, style)
    case = [extrude(v, 0.0, tall), turned([(0.25 * wide, -0.012), (0.42 * wide, 0.0), (0.42 * wide, 0.006)], n)]
    case.append(
        moved(
            merge([cylinder(0.4 * wide, tall - 0.003, tall + 0.006, n), ball_at(0.2 * wide, tall + 0.01, style)]), at()
        )
    )
    glass = rod((0, -0.5 * deep, 0.004), (0, -0.5 * deep, tall - 0.004), 0.003, 8)
    scale = box((0.3 * wide, 0.0015, 0.85 * tall), (0, -0.3 * deep, 0.5 * tall))
    lean = float(rng.choice([0.0, 0.0, np.pi / 2, np.pi / 4]))
    pose = at(0, 0, low + (0.012 if not lean else 0.4 * wide)) @ spun("y", lean) @ at(0, 0, 0.0 if not lean else 0.01)
    stem_ = [cylinder(0.0065, 0, low + 0.004, n), hexagon(0.024, 0.3 * low, 0.3 * low + 0.014)]
    if lean:
        stem_.append(ball_at(0.5 * wide, low + 0.4 * wide, style))
    parts = [piece(stem_, STEM, "trim")]
    head = [
        piece(case, CASE, "handle"),
        piece(scale, "gauge face", "dial", CASE),
        piece(glass, "gauge glass", "dial", CASE),
    ]
    return Model([*parts, *placed(fronted(head, (0.0, -1.0, 0.0)), pose)], kind=_KIND)


def _capillary(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dial thermometer on a wall or board, a capillary from it to a bulb in a boss of an upright pipe."""
    size, z = float(rng.choice([0.06, 0.1, 0.16])), float(rng.uniform(1.1, 1.6))
    parts = board(0.45, z - 0.25, z + 0.2, style, rng)
    n, dn = style.round(size / 2), int(rng.choice([40, 50, 80, 100]))
    head = [*dial(size, style, rng, "plain"), piece(cylinder(0.66 * size, 0.0, 0.004, n), CASE, "gauge")]
    head.append(screws(3, 0.59 * size, 0.005, -0.001, 0.004, CASE))
    parts += placed(head, at(0, 0, z) @ spun("x", np.pi / 2))
    r, x, y = PIPES[dn].radius, float(rng.uniform(0.45, 0.8)), -0.15
    low, high = 0.0, z + 0.5
    parts.append(Part(moved(cylinder(r, low, high, style.round(r)), at(x, y)), "pipe", "pipe", "", "Pipe assembly"))
    tap = z - float(rng.uniform(0.2, 0.6))
    boss = along("-x", merge([cylinder(0.016, 0.9 * r, r + 0.02, 12), hexagon(0.026, r + 0.018, r + 0.04)]), x, y, tap)
    parts.append(piece([boss, along("-x", cylinder(0.007, r, r + 0.055, 10), x, y, tap)], _WELL, "trim"))
    end = x - r - 0.053
    way = [(0, -0.012, z - 0.48 * size), (0, -0.012, z - 0.75 * size), (0.05, -0.04, tap - 0.15)]
    way += [(0.6 * end, y, tap - 0.2), (end - 0.06, y, tap), (end, y, tap)]
    parts.append(piece(bent(way, 0.0025, style), STEM, "trim"))
    return Model(parts, kind=_KIND)


def _furnace(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Thermocouples in protection tubes through a furnace wall, held by sliding flanges (EN 50446), heads outside."""
    wide, tall, deep = float(rng.uniform(0.5, 1.2)), float(rng.uniform(1.2, 2.0)), float(rng.uniform(0.15, 0.3))
    parts = [Part(box((wide, deep, tall), (0, deep / 2, tall / 2)), "wall", "concrete", "", FRAME)]
    count, r = int(rng.integers(1, 4)), float(rng.uniform(0.0075, 0.013))
    n = fine_sides(r, style)
    for k in range(count):
        out = float(rng.uniform(0.12, 0.3))
        tube = [cylinder(r, -deep - 0.1, out, n), cylinder(1.5 * r, 0.001, 0.03, n)]
        oval = np.vstack(
            [
                circle(2.0 * r, 12),
            ]
        )
        ear = extrude(oval * np.array([2.6, 1.0]), 0.0, 0.008)
        tube += [ear, moved(along("x", hexagon(0.01, r, r + 0.02)), at(0, 0, 0.02))]
        bolts = merge([moved(hexagon(0.012, 0.008, 0.014), at(s * 3.8 * r)) for s in (-1, 1)])
        head = moved(housing(style, rng, "pot"), at(0, 0, out - 0.004))
        some = [
            piece(tube, _WELL, "trim"),
            piece(head, "transmitter", "valve"),
            Part(bolts, "bolt", "fastener", "", JOINT, True),
        ]
        parts += placed(
            some, at((k - (count - 1) / 2) * 0.35 * wide, 0, float(rng.uniform(0.6, 0.8)) * tall) @ spun("x", np.pi / 2)
        )
    return Model(parts, kind="temperature transmitter")


def _skin(dn: int, style: ModelingStyle, rng: np.random.Generator, _: float) -> Model:
    """A skin sensor on a line: a band or hose clamp, a pad, a sheathed cable, a head on a stand-off (no welding)."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    wide, thick = float(rng.uniform(0.01, 0.025)), float(rng.uniform(0.001, 0.003))
    band = along("x", ring(r, r + thick, -wide / 2, wide / 2, n))
    lock = box((wide, 0.03, 0.014), (0, r + thick + 0.012, 0))
    screw = along("z", merge([cylinder(0.004, -0.018, 0.018, 8), hexagon(0.011, 0.015, 0.022)]), 0, r + thick + 0.016)
    parts = [
        Part(merge([band, lock]), "clamp", "clamp", "transmitter", JOINT),
        Part(screw, "screw", "fastener", "transmitter", JOINT, True),
    ]
    top = r + thick
    if rng.random() < 0.5:
        high = top + float(rng.uniform(0.06, 0.14))
        post = [cylinder(0.011, top - 0.001, high, 12), box((wide, 0.05, 0.006), (0, 0, top + 0.003))]
        head = moved(housing(style, rng), at(0, 0, high - 0.003) @ spun("z", float(rng.uniform(0, 6))))
        parts += [piece(post, _WELL, "trim"), piece(head, "transmitter", "valve")]
    else:
        pad = [
            box((1.4 * wide, 0.02, 0.01), (0, 0, top + 0.005)),
            along("x", cylinder(0.004, 0.0, 0.05, 8), 0, 0, top + 0.006),
        ]
        out = [(0.048, 0, top + 0.006), (0.09, 0, top + 0.01), (0.1, 0.03, top + 0.08), (0.08, 0.05, top + 0.2)]
        parts += [piece(pad, "transmitter", "trim"), piece(bent(out, 0.003, style), "transmitter", "rubber")]
    return Model(parts, kind="temperature transmitter")


def _compact(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A compact sensor: a hexagon with a fitting for the stem, a bare stem, a plug (M12) and its cable."""
    tall, r = float(rng.uniform(0.04, 0.12)), float(rng.uniform(0.003, 0.005))
    n = fine_sides(0.009, style)
    body = [
        cylinder(0.0095, 0, 0.02, n),
        hexagon(0.024, 0.016, 0.03),
        hexagon(0.02, 0.032, 0.044),
        cylinder(r, 0.02, tall + 0.02, n),
    ]
    body.append(turned([(0.008, tall), (0.009, tall + 0.01), (0.009, tall + 0.05), (0.006, tall + 0.06)], n))
    nut = cylinder(0.0085, tall + 0.055, tall + 0.085, n)
    lead = rope([(0, 0, tall + 0.08), (0, 0, tall + 0.12), (0.03, 0, tall + 0.16), (0.12, 0, tall + 0.1)], 0.003, 8)
    return Model(
        [piece(body, "transmitter", "trim"), piece([nut, lead], "transmitter", "rubber")],
        kind="temperature transmitter",
    )


def _conduit(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermowell with a nipple-union-nipple extension, an explosion-proof head and a conduit that runs off."""
    well = [cylinder(0.013, 0, 0.02, 12), hexagon(0.034, 0.018, 0.045), _probe(0.03, 0.01, 12)]
    high = float(rng.uniform(0.15, 0.24))
    mid = 0.045 + 0.5 * (high - 0.045)
    neck = [
        cylinder(0.0107, 0.04, high, 12),
        hexagon(0.04, mid - 0.01, mid + 0.015),
        cylinder(0.017, mid - 0.022, mid + 0.026, 12),
    ]
    body = merge([cylinder(0.02, high - 0.004, high + 0.02, 12), ball_at(0.045, high + 0.05, style)])
    lid = along("-y", turned([(0.046, 0.02), (0.048, 0.05), (0.04, 0.056)], style.round(0.046)), 0, 0, high + 0.05)
    knobs = along("-y", merge([box((0.012, 0.02, 0.012), (s * 0.025, 0, 0.06)) for s in (-1, 1)]), 0, 0, high + 0.05)
    hub = along("x", merge([cylinder(0.016, 0.03, 0.06, 12), hexagon(0.032, 0.058, 0.075)]), 0, 0, high + 0.05)
    way = [(0.07, 0, high + 0.05), (0.16, 0, high + 0.05), (0.25, 0, high), (0.25, 0.02, high + 0.3)]
    tube = Part(bent(way, 0.0107, style), "conduit", "electrical", "", "Electrical and safety")
    parts = [piece([*well, *neck], _WELL, "trim"), piece([body, lid, knobs, hub], "transmitter", "valve"), tube]
    if rng.random() < 0.4:
        parts.append(piece(along("-x", gland(style, rng), -0.042, 0, high + 0.05), "transmitter", "valve"))
    return Model(parts, kind="temperature transmitter")


def _family(
    name: str,
    build: object,
    place: str = "tap",
    sizes: tuple[int, ...] = (15,),
    whole: str = _WELL,
    weight: float = 1.0,
) -> Family:
    return Family(name, place, "Gauge assembly", whole, build, sizes, weight=weight)  # type: ignore[arg-type]


HEAT_BUILDS: tuple[Family, ...] = (
    _family("thermowell/flanged", _flanged, "head", (25, 40, 50, 80), weight=1.5),
    _family("thermowell/van stone", _van_stone, "head", (25, 40, 50, 80)),
    _family("thermowell/welded", _welded, weight=1.5),
    _family("thermowell/lagging", _screwed, weight=1.5),
    _family("thermowell/test", _test),
    _family("thermowell/furnace", _furnace, "floor"),
    _family("thermowell/conduit", _conduit),
    _family("thermometer/bimetal", _bimetal, whole="gauge", weight=1.5),
    _family("thermometer/v-case", _v_case, whole="gauge"),
    _family("thermometer/capillary", _capillary, "floor", whole="gauge"),
    _family("transmitter/skin", _skin, "carrier", SIZES, "transmitter"),
    _family("transmitter/compact temperature", _compact, whole="transmitter"),
)
