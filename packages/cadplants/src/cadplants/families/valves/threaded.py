"""Small valves with threaded or socket ends: the pipe reaches their hexagons; along x from 0, stem towards +z."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import BODY, drive, stem, wheel
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, ball, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["THREADED", "hex_end"]


def hex_end(dn: int, low: float, high: float, style: ModelingStyle, corners: int = 6) -> Solid:
    """The wrench end of a threaded fitting along x: six or eight flats (ISO 7-1 thread inside where it is hollow)."""
    radius = PIPES[dn].radius
    flats = 2 * (1.12 * radius + 0.003)
    outline = circle(flats / 2 / np.cos(np.pi / corners), corners, phase=np.pi / corners)
    holes = (circle(radius * 0.98, max(8, style.round(radius))),) if style.hollow else ()
    return along("x", extrude(outline, low, high, holes))


def _threaded(
    dn: int, style: ModelingStyle, rng: np.random.Generator, length: float, swell: float
) -> tuple[list[Part], float]:
    """Two wrench ends and a middle between them; also the middle's radius [m]."""
    radius = PIPES[dn].radius
    end, bulge = 0.24 * length, swell * radius + 0.004
    corners = int(rng.choice([6, 6, 8]))
    n = style.round(bulge)
    kind = int(rng.integers(3))
    if kind == 0:
        profile = [
            (1.1 * radius, 0.8 * end),
            (bulge, 1.3 * end),
            (bulge, length - 1.3 * end),
            (1.1 * radius, length - 0.8 * end),
        ]
    elif kind == 1:
        shares = np.linspace(-1, 1, 9)
        reach = length / 2 - 0.7 * end
        profile = [(max(0.3, np.sqrt(1 - s * s)) * bulge, length / 2 + s * reach) for s in shares]
    else:
        profile = [
            (bulge, 0.9 * end),
            (bulge, 0.62 * length),
            (1.12 * bulge, 0.62 * length),
            (1.12 * bulge, 0.7 * length),
            (0.95 * bulge, length - 0.9 * end),
        ]
    middle = along("x", turned(profile, n))
    solid = merge([hex_end(dn, 0.0, end, style, corners), middle, hex_end(dn, length - end, length, style, corners)])
    return [Part(solid, BODY, "valve", BODY)], bulge


def _ball(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A two-piece threaded ball valve with a lever, a wing or a small actuator, maybe a mounting pad (ISO 5211)."""
    radius = PIPES[dn].radius
    length = float(rng.uniform(3.4, 4.6)) * radius + 0.025
    parts, bulge = _threaded(dn, style, rng, length, 1.3)
    x, boss, top = length / 2, 0.45 * radius + 0.003, bulge + 0.25 * radius + 0.004
    parts.append(Part(moved(cylinder(boss, 0.6 * bulge, top, style.round(boss)), at(x)), BODY, "valve", BODY))
    if rng.random() < 0.4:
        half = 1.5 * boss
        holes = tuple(circle(0.15 * half, 8, (sx * 0.7 * half, sy * 0.7 * half)) for sx in (-1, 1) for sy in (-1, 1))
        pad = extrude(rounded_rectangle(2 * half, 2 * half, 0.3 * half, 3), top - 0.004, top, holes)
        parts.append(Part(moved(pad, at(x)), BODY, "valve", BODY))
    parts.append(stem(top, top + 0.008, 0.5 * boss, style, x))
    nut = Part(
        moved(hexagon(1.3 * boss, top + 0.008, top + 0.013), at(x)),
        "nut",
        "fastener",
        BODY,
        "Connection assembly",
        True,
    )
    parts += [
        nut,
        *drive(
            x, top + 0.006, radius, style, rng, ("lever", "lever", "lever", "wing", "wing", "pneumatic", "electric")
        ),
    ]
    return Model(parts, round(length, 6), "welded", "ball valve")


def _three_piece(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A three-piece ball valve: two ends and a middle block between square plates held by four bolts."""
    radius = PIPES[dn].radius
    length, half = 5.0 * radius + 0.03, 1.55 * radius + 0.006
    plate = 0.2 * radius + 0.006
    mid = 0.7 * radius + 0.006
    x, n = length / 2, style.round(radius)
    square = rounded_rectangle(2 * half, 2 * half, 0.35 * half, 3)
    bore = (circle(0.9 * radius, n),) if style.hollow else ()
    ends = []
    for sign in (-1, 1):
        low = x + sign * mid
        flat = extrude(square, min(low, low + sign * plate), max(low, low + sign * plate), bore)
        far = low + sign * plate
        neck = ring(
            0.9 * radius if style.hollow else 0.0, 1.25 * radius, min(far, x + sign * x), max(far, x + sign * x), n
        )
        ends.append(along("x", merge([flat, neck])))
    core = along("x", ring(0.9 * radius if style.hollow else 0.0, 1.35 * radius, x - mid, x + mid, n))
    one = merge(
        [
            cylinder(0.1 * radius + 0.002, x - mid - plate - 0.008, x + mid + plate + 0.008, 8),
            hexagon(0.4 * radius + 0.006, x + mid + plate, x + mid + plate + 0.005),
        ]
    )
    bolts = along("x", merge([moved(one, at(sx * 0.75 * half, sy * 0.75 * half)) for sx in (-1, 1) for sy in (-1, 1)]))
    boss, top = 0.5 * radius + 0.003, 1.35 * radius + 0.3 * radius + 0.004
    parts = [
        Part(core, BODY, "valve", BODY),
        *(Part(end, BODY, "valve", BODY) for end in ends),
        Part(moved(cylinder(boss, 1.1 * radius, top, 12), at(x)), BODY, "valve", BODY),
        Part(bolts, "bolt", "fastener", BODY, "Connection assembly", True),
        stem(top, top + 0.01, 0.5 * boss, style, x),
        *drive(x, top + 0.008, radius, style, rng, ("lever", "lever", "pneumatic", "electric")),
    ]
    return Model(parts, round(length, 6), "welded", "ball valve")


def _bronze(dn: int, style: ModelingStyle, rng: np.random.Generator, tall: float, kind: str) -> Model:
    """A threaded bronze gate or globe valve: union bonnet, packing nut, wheel."""
    radius = PIPES[dn].radius
    length = float(rng.uniform(3.2, 4.4)) * radius + 0.025
    parts, bulge = _threaded(dn, style, rng, length, 1.35)
    x, n = length / 2, style.round(bulge)
    rise = bulge + tall * radius
    neck = turned([(0.85 * bulge, 0.4 * bulge), (0.8 * bulge, rise)], n)
    nut = merge(
        [hexagon(1.9 * bulge, rise, rise + 0.35 * radius + 0.004), cylinder(0.5 * bulge, rise, rise + 1.2 * radius, n)]
    )
    gland = hexagon(0.9 * bulge, rise + 1.1 * radius, rise + 1.5 * radius + 0.004)
    top = rise + 1.5 * radius + 0.004
    parts += [
        Part(moved(neck, at(x)), BODY, "valve", BODY),
        Part(moved(nut, at(x)), "valve bonnet", "valve", BODY),
        Part(moved(gland, at(x)), "gland", "trim", BODY),
        stem(top, top + 0.02 + 1.2 * radius, 0.003 + 0.12 * radius, style, x),
        wheel(0.02 + 1.3 * radius, x, top + 0.01 + 0.8 * radius, style, rng),
    ]
    return Model(parts, round(length, 6), "welded", kind)


def _gate(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _bronze(dn, style, rng, 1.2, "gate valve")


def _globe(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _bronze(dn, style, rng, 0.3, "globe valve")


def _needle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A needle valve: a block of bar or a hexagon, a bonnet nut, a T bar or a knob."""
    radius = PIPES[dn].radius
    length, half = 4.0 * radius + 0.03, 1.2 * radius + 0.003
    x = length / 2
    if rng.random() < 0.5:
        body = box((length, 2 * half, 2.2 * half), (x, 0, 0.2 * half))
    else:
        body = merge(
            [along("x", hexagon(2 * half, 0.0, length)), moved(cylinder(0.9 * half, 0.0, 1.3 * half, 12), at(x))]
        )
    bonnet = merge([hexagon(1.7 * half, 1.25 * half, 2.1 * half), cylinder(0.55 * half, 2.0 * half, 3.2 * half, 12)])
    packing = hexagon(1.2 * half, 3.1 * half, 3.6 * half)
    parts = [
        Part(body, BODY, "valve", BODY),
        Part(moved(bonnet, at(x)), "valve bonnet", "trim", BODY),
        Part(moved(packing, at(x)), "gland", "trim", BODY),
        stem(3.5 * half, 5.2 * half, 0.28 * half, style, x),
    ]
    if rng.random() < 0.6:
        parts += drive(x, 4.8 * half, radius, style, rng, ("bar",))
    else:
        parts.append(wheel(1.5 * half + 0.005, x, 4.6 * half, style, rng))
    return Model(parts, round(length, 6), "welded", "needle valve")


def _check(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded check valve: spring type in a cylinder, or swing type with a screwed cap."""
    radius = PIPES[dn].radius
    length = 3.6 * radius + 0.03
    parts, bulge = _threaded(dn, style, rng, length, 1.3)
    if rng.random() < 0.5:
        tilt = float(rng.choice([0.0, 0.5]))
        cap_ = merge(
            [
                cylinder(0.8 * bulge, 0.3 * bulge, 1.35 * bulge, style.round(bulge)),
                hexagon(1.2 * bulge, 1.35 * bulge, 1.65 * bulge),
            ]
        )
        parts.append(Part(moved(cap_, at(length / 2) @ spun("y", tilt)), "valve bonnet", "valve", BODY))
    return Model(parts, round(length, 6), "welded", "check valve")


def _solenoid(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A solenoid valve: a threaded body with a coil on a tube and a plug with its cable gland."""
    radius = PIPES[dn].radius
    length = 3.6 * radius + 0.03
    parts, bulge = _threaded(dn, style, rng, length, 1.3)
    x, side = length / 2, 0.03 + 0.35 * radius
    flat = box((1.9 * bulge, 1.9 * bulge, 0.25 * bulge), (x, 0, 1.0 * bulge))
    low = 1.1 * bulge
    tube = cylinder(0.25 * side, low, low + 1.7 * side, 12)
    coil = moved(
        extrude(rounded_rectangle(1.1 * side, side, 0.15 * side, 3), low + 0.2 * side, low + 1.4 * side), np.eye(4)
    )
    plug = merge(
        [
            box((0.6 * side, 0.5 * side, 0.5 * side), (0.8 * side, 0, low + 0.8 * side)),
            along("x", hexagon(0.35 * side, 0, 0.3 * side), 1.1 * side, 0, low + 0.8 * side),
        ]
    )
    nut = hexagon(0.6 * side, low + 1.4 * side, low + 1.55 * side)
    parts += [
        Part(flat, "valve bonnet", "valve", BODY),
        Part(moved(tube, at(x)), "valve stem", "trim", BODY),
        Part(moved(merge([coil, plug]), at(x)), "actuator", "rubber", "actuator"),
        Part(moved(nut, at(x)), "nut", "fastener", "actuator", "Connection assembly", True),
    ]
    return Model(parts, round(length, 6), "welded", "solenoid valve")


def _y_small(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A balancing valve: threaded, slanting bonnet, a big plastic knob, two test points."""
    radius = PIPES[dn].radius
    length = 4.6 * radius + 0.035
    parts, bulge = _threaded(dn, style, rng, length, 1.25)
    way = at(0.5 * length) @ spun("y", 0.78)
    neck = turned([(0.8 * bulge, 0.0), (0.75 * bulge, 2.2 * bulge), (0.6 * bulge, 2.3 * bulge)], style.round(bulge))
    knob = turned(
        [
            (1.1 * bulge, 2.3 * bulge),
            (1.2 * bulge, 2.4 * bulge),
            (1.2 * bulge, 3.6 * bulge),
            (1.0 * bulge, 3.8 * bulge),
        ],
        max(10, style.round(bulge)),
    )
    tests = [
        rod((length * s, 0.3 * bulge, 0.5 * bulge), (length * s, 1.6 * bulge, 1.2 * bulge), 0.16 * bulge, 8)
        for s in (0.3, 0.7)
    ]
    parts += [
        Part(moved(neck, way), "valve bonnet", "valve", BODY),
        Part(moved(knob, way), "handwheel", "handle"),
        *(Part(test, BODY, "trim", BODY) for test in tests),
    ]
    return Model(parts, round(length, 6), "welded", "globe valve")


def _relief(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded safety valve upright on a tap or a pipe's end: along x from its inlet, outlet aside, cap or knob."""
    radius = PIPES[dn].radius
    n, bulge = style.round(1.4 * radius), 1.4 * radius + 0.004
    inlet = merge([cylinder(0.9 * radius, 0.0, 0.015, n), hexagon(2.3 * radius + 0.004, 0.012, 0.026 + 0.3 * radius)])
    low = 0.024 + 0.3 * radius
    chamber = turned([(0.9 * bulge, low), (bulge, low + 0.5 * bulge), (bulge, low + 2.0 * bulge)], n)
    side = along(
        "y",
        merge([cylinder(1.0 * radius, 0.0, 1.6 * bulge, n), hexagon(2.4 * radius + 0.004, 1.4 * bulge, 2.1 * bulge)]),
        0,
        0,
        low + bulge,
    )
    tall = float(rng.uniform(2.0, 4.0)) * bulge
    top = low + 2.0 * bulge
    bonnet = turned([(0.85 * bulge, top), (0.75 * bulge, top + tall)], n)
    parts = [
        Part(merge([inlet, chamber, side]), BODY, "valve", BODY),
        Part(merge([bonnet, hexagon(1.7 * bulge, top, top + 0.4 * bulge)]), "valve bonnet", "valve", BODY),
    ]
    if rng.random() < 0.5:
        knob = turned(
            [(0.9 * bulge, top + tall), (1.0 * bulge, top + tall + 0.3 * bulge), (0.95 * bulge, top + tall + bulge)],
            max(8, n),
        )
        parts.append(Part(knob, "handwheel", "handle"))
    else:
        arm = rod((0, -0.2 * bulge, top + tall), (0, 2.4 * bulge, top + 0.8 * tall), 0.15 * bulge, 8)
        parts.append(
            Part(merge([arm, cylinder(0.4 * bulge, top + tall, top + tall + 0.5 * bulge, n)]), "lever", "handle")
        )
    return Model(parts, kind="relief valve")


def _relief_tap(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _relief(int(rng.choice([15, 20, 25])), style, rng)


def _vent(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An automatic air vent: a float chamber on a nipple with a small cap."""
    r, n = float(rng.uniform(0.018, 0.04)), style.round(0.03)
    body = turned(
        [
            (0.009, 0.0),
            (0.009, 0.02),
            (r, 0.03),
            (r, 0.03 + 2.4 * r),
            (0.5 * r, 0.03 + 2.9 * r),
            (0.3 * r, 0.03 + 3.0 * r),
        ],
        n,
    )
    cap_ = moved(cylinder(0.3 * r, 0.0, 0.5 * r, 10), at(0.4 * r, 0, 0.03 + 2.8 * r))
    return Model(
        [Part(merge([body, ball(0.001, 6)][:1]), BODY, "valve", BODY), Part(cap_, "valve bonnet", "trim", BODY)],
        kind="air vent",
    )


def _cock(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A drain or sampling cock on an outlet: hexagon body, spout aside, a wing or lever."""
    r, n = float(rng.uniform(0.008, 0.014)), 12
    body = merge(
        [cylinder(0.8 * r, 0.0, 0.02, n), hexagon(2.4 * r, 0.015, 0.015 + 1.6 * r), cylinder(r, 0.015, 0.03 + 4 * r, n)]
    )
    spout = merge([rod((0, 0, 0.02 + 2.2 * r), (0, 4 * r, 0.02 + 1.4 * r), 0.7 * r, n), ball(0.5 * r, 6)][:1])
    head = drive(0.0, 0.03 + 4 * r, r, style, rng, ("wing", "lever", "bar"))
    return Model([Part(merge([body, spout]), BODY, "trim", BODY), *head], kind="sampling valve")


_SMALL = tuple(dn for dn in SIZES if dn <= 50)


def _family(
    name: str, build: object, place: str = "inline", weight: float = 1.0, sizes: tuple[int, ...] = _SMALL
) -> Family:
    return Family(name, place, "Valve assembly", "valve", build, sizes, weight=weight)  # type: ignore[arg-type]


THREADED: tuple[Family, ...] = (
    _family("ball valve/threaded", _ball, weight=3),
    _family("ball valve/three-piece", _three_piece, weight=1.5),
    _family("gate valve/threaded", _gate, weight=1.5),
    _family("globe valve/threaded", _globe, weight=1.5),
    _family("needle valve/bar stock", _needle, sizes=(15, 20, 25)),
    _family("check valve/threaded", _check, weight=1.5),
    _family("solenoid valve/threaded", _solenoid),
    _family("globe valve/balancing", _y_small),
    _family("relief valve/threaded", _relief_tap, "tap", sizes=SIZES),
    _family("air vent/float", _vent, "tap", sizes=SIZES),
    _family("sampling valve/cock", _cock, "tap", sizes=SIZES),
)
