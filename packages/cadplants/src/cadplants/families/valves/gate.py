"""Gate valves beyond bronze and rising stem: cast, pressure seal, waterworks, conduit, forged, sluices and slides."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation_base import hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.actuation_stroke import linear, screwed_up
from cadplants.families.valves.body import (
    bolts_on,
    chest,
    ended,
    lid_joint,
    metal,
    neck_of,
    oval,
    packing,
    room,
    trim,
    wedge,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, lofted, ring, turned
from cadplants.standards import FACE_TO_FACE, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["GATES", "resilient"]

Rng = np.random.Generator


def _ribs(rng: Rng, count: int, reach: float, inner: float, low: float, high: float, thick: float) -> Solid:
    """Upright ribs between a plate and a neck, as three-cornered plates [m]."""
    outline = np.array([(inner, low), (reach, low), (inner, high)])
    one = moved(slab(outline, -thick / 2, thick / 2), spun("x", np.pi / 2))
    return around(one, count, 0.0, float(rng.choice([0.0, np.pi / 4])))


def _hood(outline_a: float, outline_b: float, throat: float, low: float, high: float, n: int) -> Solid:
    """A bonnet that narrows from an oval to a round stuffing box [m]."""
    loops = [
        (outline_a, outline_b, low),
        (0.85 * outline_a, 0.8 * outline_b, low + 0.35 * (high - low)),
        (throat, throat, low + 0.65 * (high - low)),
        (throat, throat, high),
    ]
    return lofted([np.column_stack([oval(a, b, n), np.full(n, z)]) for a, b, z in loops])


def _cast(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A cast wedge gate valve, bolted bonnet round, oval or square, ribs, outside screw and yoke (API 600, EN 1984)."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "flanged", "butt"]))
    length = FACE_TO_FACE["gate"][dn] * (1.0 if ends == "flanged" else 1.15)
    neck, back = neck_of(dn)
    x, n = length / 2, max(16, style.round(1.5 * radius))
    a, b = float(rng.uniform(0.62, 0.95)) * radius + 0.012, float(rng.uniform(1.35, 1.6)) * radius + 0.012
    a = min(a, 0.4 * length)
    barrel = [
        (neck, back + 0.05 * length),
        (1.05 * radius + 0.008, 0.3 * length),
        (1.05 * radius + 0.008, 0.7 * length),
        (neck, 0.95 * length - back),
    ]
    seat = max(room(dn) + 0.01, 1.75 * radius + 0.03)
    seat *= float(rng.uniform(1.0, 1.15))
    plate, kind = 0.009 + 0.09 * radius, str(rng.choice(["round", "oval", "oval", "square"]))
    pa, pb = (b * 1.25,) * 2 if kind == "round" else (a + 0.014 + 0.25 * radius, b * 1.22 + 0.008)
    collar, lid, bolts = lid_joint(kind, pa, pb, seat, plate, style, rng)
    hollow = chest(-1.35 * radius - 0.01, seat - 0.5 * plate, a, b, n, 1.6 * radius, float(rng.uniform(0.9, 1.05)))
    slim, top = 0.006 + 0.075 * radius, seat + plate + float(rng.uniform(0.5, 1.1)) * radius + 0.02
    hood = merge([lid, _hood(0.9 * a, 0.85 * b, 2.6 * slim, seat + 0.5 * plate, top, n)])
    if rng.random() < 0.5:
        hood = merge([hood, _ribs(rng, 4, 0.9 * pa, 1.5 * slim, seat + plate, top - 0.01, 0.006 + 0.05 * radius)])
    body = [ended(dn, style, length, barrel, ends), moved(merge([hollow, collar]), at(x))]
    if rng.random() < 0.4:
        body.append(
            moved(
                merge([box((2 * a + 0.01, 0.012, 2.2 * radius), (0, s * 0.4 * b, 0.2 * radius)) for s in (-1, 1)]),
                at(x),
            )
        )
    gland, tall = packing(slim, style, rng)
    rise = float(rng.choice([0.0, 1.1, 2.1])) * PIPES[dn].bore
    parts = [metal(merge(body)), trim(hood, "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    if style.hollow:
        parts.append(wedge(dn, x, 0.5 * length - back, rise, style))
    yoke = float(rng.uniform(1.5, 2.4)) * radius + 0.06 + tall
    wheel = float(rng.uniform(0.9, 1.3)) * (0.05 + 1.15 * radius)
    if rng.random() < 0.75:
        parts += placed(screwed_up(max(3.4 * slim, 0.6 * b), yoke, wheel, slim, style, rng), at(x, 0, top))
        parts += placed(gland, at(x, 0, top + 0.004))
    else:
        parts += placed(
            [*gland, shaft(-0.3 * radius, tall + 0.06, slim, style, rng), hand_wheel(wheel, tall + 0.02, style, rng)],
            at(x, 0, top),
        )
    return Model(parts, length, "flanged" if ends == "flanged" else "welded", "gate valve")


def _pressure_seal(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A high-pressure gate valve with a pressure-seal bonnet: a thick round bottle, welded ends, a yoke clamped on."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * float(rng.uniform(1.2, 1.5))
    x, big = length / 2, 1.55 * radius + 0.015
    n = style.round(big)
    barrel = [
        (1.1 * radius, 0.12 * length),
        (1.35 * radius + 0.004, 0.25 * length),
        (1.35 * radius + 0.004, 0.75 * length),
        (1.1 * radius, 0.88 * length),
    ]
    high = float(rng.uniform(2.6, 3.4)) * radius + 0.04
    bottle = turned(
        [
            (0.4 * big, -1.5 * radius - 0.01),
            (0.85 * big, -1.35 * radius),
            (big, -0.9 * radius),
            (big, 0.8 * radius),
            (0.88 * big, 1.2 * radius),
            (0.88 * big, high - 0.5 * radius),
            (1.12 * big, high - 0.45 * radius),
            (1.12 * big, high),
        ],
        n,
    )
    cap = turned(
        [
            (0.7 * big, high - 0.01),
            (0.7 * big, high + 0.02),
            (0.35 * big, high + 0.25 * radius),
            (0.33 * big, high + 0.9 * radius),
        ],
        n,
    )
    ring_ = ring(0.72 * big, 0.95 * big, high, high + 0.012 + 0.06 * radius, n)
    slim, top = 0.007 + 0.09 * radius, high + 0.9 * radius
    studs = bolts_on(circle(0.95 * big, n), 6, high, high + 0.014 + 0.06 * radius, 0.008 + 0.05 * radius)
    parts = [
        metal(merge([ended(dn, style, length, barrel, "butt"), moved(bottle, at(x))])),
        *placed([trim(merge([cap, ring_]), "valve bonnet", 0.0, "valve"), studs], at(x)),
    ]
    gland, tall = packing(slim, style, rng, int(rng.choice([0, 2, 3])))
    clamp = merge(
        [
            cylinder(1.2 * big, high - 0.3 * radius, high - 0.08 * radius, n),
            *(box((0.02, 0.4 * big, 0.2 * radius), (s * 1.22 * big, 0, high - 0.19 * radius)) for s in (-1, 1)),
        ]
    )
    parts += placed(gland, at(x, 0, top))
    yoke = top - high + tall + 1.6 * radius + 0.08
    parts.append(trim(clamp, "yoke", x, "valve"))
    parts += placed(screwed_up(1.12 * big, yoke, 0.07 + 1.5 * radius, slim, style, rng), at(x, 0, high))
    if style.hollow:
        parts.append(wedge(dn, x, 0.3 * length, float(rng.choice([0.0, 1.8])) * PIPES[dn].bore, style))
    return Model(parts, round(length, 6), "welded", "gate valve")


def _spindle(radius: float, slim: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """What works a waterworks valve: a square cap, a handwheel or an extension with its cap [m]."""
    rest = [shaft(-slim, 4.0 * slim, slim, style)]
    kind_ = rng.random()
    square = merge(
        [
            lofted(
                [
                    np.column_stack([rounded_rectangle(2 * h, 2 * h, 0.3 * h, 2), np.full(12, z)])
                    for h, z in ((2.0 * slim, slim), (1.6 * slim, 5 * slim))
                ]
            ),
            cylinder(2.4 * slim, 0.8 * slim, 1.2 * slim, 14),
        ]
    )
    if kind_ < 0.4:
        rest.append(Part(square, "valve stem", "trim", BODY))
    elif kind_ < 0.8:
        rest.append(hand_wheel(0.06 + 1.1 * radius, 1.5 * slim, style, rng, ("spoked", "spoked", "dished", "disc")))
    else:
        reach = float(rng.uniform(0.4, 0.9))
        tube = merge([cylinder(1.8 * slim, slim, slim + reach, 12), cylinder(2.6 * slim, 0.5 * slim, 6 * slim, 12)])
        sleeve = turned([(4.0 * slim, 3 * slim), (3.0 * slim, 9 * slim), (3.0 * slim, reach - 0.05)], 14)
        rest += [
            Part(merge([tube, sleeve]), "valve stem", "trim", BODY),
            *placed([Part(square, "valve stem", "trim", BODY)], at(0, 0, reach)),
        ]
    return rest


def resilient(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A resilient-seated waterworks gate valve: smooth body, oval bonnet, square cap, wheel or spindle (EN 1171)."""
    radius = PIPES[dn].radius
    length = 0.15 + 0.0008 * dn * float(rng.choice([1.0, 1.9]))  # EN 558 series 14 and 15
    length = max(length, 0.14 + 0.1 * radius)
    neck, back = neck_of(dn)
    x, n = length / 2, max(16, style.round(1.5 * radius))
    a, b = min(0.30 * length, 0.8 * radius + 0.02), 1.3 * radius + 0.016
    seat = max(room(dn), 1.45 * radius + 0.03)
    barrel = [
        (neck, back),
        (1.12 * radius + 0.006, 0.35 * length),
        (1.12 * radius + 0.006, 0.65 * length),
        (neck, length - back),
    ]
    hollow = chest(-1.2 * radius - 0.008, seat, a, b, n, 1.4 * radius)
    kind, plate = str(rng.choice(["oval", "square", "octagon"])), 0.010 + 0.07 * radius
    collar, lid, bolts = lid_joint(kind, a + 0.012 + 0.12 * radius, b + 0.012 + 0.1 * radius, seat, plate, style, rng)
    high = seat + plate + 0.9 * radius + 0.02
    loops = [
        (0.95 * a, 0.95 * b, seat + 0.5 * plate),
        (0.9 * a, 0.85 * b, seat + 0.55 * (high - seat)),
        (0.6 * a, 0.5 * b, high - 0.1 * radius),
        (0.45 * a, 0.4 * a, high),
    ]
    hood = lofted([np.column_stack([oval(p, q, n), np.full(n, z)]) for p, q, z in loops])
    slim = 0.008 + 0.06 * radius
    box_ = turned(
        [
            (3.0 * slim, high - 0.02),
            (3.0 * slim, high + 1.2 * slim),
            (2.2 * slim, high + 1.6 * slim),
            (2.0 * slim, high + 3.0 * slim),
        ],
        n,
    )
    top = high + 3.0 * slim
    foot = box((0.8 * length - 2 * back, 0.8 * radius, 0.02), (x, 0, -1.25 * radius)) if rng.random() < 0.5 else None
    pieces = [
        ended(dn, style, length, barrel, "flanged"),
        moved(merge([hollow, collar]), at(x)),
        *([foot] if foot else []),
    ]
    parts = [metal(merge(pieces)), trim(merge([lid, hood, box_]), "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    if rng.random() < 0.5:
        parts.append(trim(merge([cylinder(2.6 * slim, top, top + 0.8 * slim, n)]), "gland", x))
    rest = _spindle(radius, slim, style, rng)
    parts += placed(rest, at(x, 0, top))
    if style.hollow:
        parts.append(wedge(dn, x, 0.9 * a, float(rng.choice([0.0, 1.0])) * radius, style))
    return Model(parts, round(length, 6), kind="gate valve")


def _girdles(half_x: float, half_y: float, down: float, up: float, radius: float, rng: Rng) -> list[Solid]:
    """What sits on a flat chest: ribs around it, a drain below and vents beside it [m]."""
    solids = []
    if rng.random() < 0.6:
        levels = np.linspace(-0.85 * down, 0.8 * up, int(rng.integers(3, 7)))
        solids += [box((2 * half_x + 0.016, 2 * half_y + 0.016, 0.012), (0, 0, float(z))) for z in levels]
    if rng.random() < 0.5:
        drain = turned([(0.3 * radius, 0.0), (0.3 * radius, 0.02), (0.12 * radius, 0.03)], 12)
        solids.append(along("-z", drain, 0, 0, -down))
        vent = hexagon(0.03, half_y - 0.002, half_y + 0.03)
        solids += [along("y", vent, 0, 0, s * 0.6 * up) for s in (-1, 1)]
    return solids


def _conduit(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A slab or through-conduit gate valve: a tall flat chest above and below the bore, covers bolted on (API 6D)."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * 1.2
    neck, back = neck_of(dn)
    x = length / 2
    half_x, half_y = 0.45 * radius + 0.02, 1.3 * radius + 0.012
    up, down = max(2.5 * radius + 0.03, room(dn) + 0.01), float(rng.choice([1.3, 2.4, 2.6])) * radius + 0.02
    if rng.random() < 0.6:
        outline = rounded_rectangle(2 * half_x, 2 * half_y, 0.25 * half_x, 2)
    else:
        outline = oval(half_x * 1.15, half_y, 20)
    box_ = slab(outline, -down, up)
    plate = 0.010 + 0.1 * radius
    collar, lid, bolts = lid_joint(
        "square" if len(outline) < 14 else "oval",
        half_x + 0.014 + 0.2 * radius,
        half_y + 0.014 + 0.18 * radius,
        up,
        plate,
        style,
        rng,
    )
    solids = [
        ended(
            dn,
            style,
            length,
            [
                (neck, back),
                (1.15 * radius + 0.006, 0.3 * length),
                (1.15 * radius + 0.006, 0.7 * length),
                (neck, length - back),
            ],
            "flanged",
        ),
        moved(merge([box_, collar]), at(x)),
    ]
    solids += [moved(one, at(x)) for one in _girdles(half_x, half_y, down, up, radius, rng)]
    slim, top = 0.008 + 0.08 * radius, up + plate
    crown = turned(
        [(0.5 * half_y, top - 0.002), (0.35 * half_y, top + 0.3 * radius), (2.6 * slim, top + 0.6 * radius + 0.01)], 20
    )
    parts = [metal(merge(solids)), trim(merge([lid, crown]), "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    gland, tall = packing(slim, style, rng)
    high = top + 0.6 * radius + 0.01
    if rng.random() < 0.7:
        parts += placed(gland, at(x, 0, high))
        parts += placed(
            screwed_up(3.6 * slim + 0.3 * radius, tall + 2.0 * radius + 0.08, 0.08 + 1.4 * radius, slim, style, rng),
            at(x, 0, high),
        )
    else:
        parts += linear(x, high, radius, style, rng, ("piston", "ram", "turning"))
    if style.hollow:
        gate = box((0.5 * half_x, 1.8 * half_y, 2.4 * radius), (x, 0, float(rng.choice([0.0, 1.0])) * 1.1 * radius))
        parts.append(trim(gate, "valve disc"))
    return Model(parts, round(length, 6), kind="gate valve")


def _welded_cap(big: float, seat: float, high: float, radius: float, n: int, rng: Rng) -> Solid:
    """A bonnet welded or screwed into a forged body, maybe with a hexagon [m]."""
    cap = turned(
        [
            (0.95 * big, seat),
            (1.05 * big, seat + 0.1 * radius),
            (0.9 * big, seat + 0.7 * radius),
            (0.6 * big, high - 0.004),
            (0.55 * big, high),
        ],
        n,
    )
    if rng.random() < 0.5:
        cap = merge([cap, hexagon(2.1 * big, seat + 0.002, seat + 0.5 * radius)])
    return cap


def _forged(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A compact forged gate or globe valve, bolted or welded bonnet, socket, threaded or butt ends (API 602)."""
    radius = PIPES[dn].radius
    length, ends = 0.055 + 3.2 * radius, str(rng.choice(["socket", "socket", "hex", "octagon", "butt"]))
    x, big = length / 2, 1.35 * radius + 0.006
    n = style.round(big)
    barrel = [(1.2 * radius, 0.2 * length), (big, 0.36 * length), (big, 0.64 * length), (1.2 * radius, 0.8 * length)]
    seat = 1.9 * radius + 0.02
    chest_ = slab(
        rounded_rectangle(1.9 * big, 2.1 * big, 0.5 * big, 3) if rng.random() < 0.5 else circle(big, n),
        -1.2 * radius - 0.004,
        seat,
    )
    slim, plate = 0.004 + 0.09 * radius, 0.008 + 0.1 * radius
    solids, parts = [ended(dn, style, length, barrel, ends), moved(chest_, at(x))], []
    if rng.random() < 0.6:
        kind = str(rng.choice(["round", "square"]))
        collar, lid, bolts = lid_joint(kind, 1.55 * big, 1.55 * big, seat, plate, style, rng)
        solids.append(moved(collar, at(x)))
        cap = merge(
            [
                lid,
                turned(
                    [
                        (1.0 * big, seat + 0.5 * plate),
                        (0.9 * big, seat + plate + 0.3 * radius),
                        (2.4 * slim, seat + plate + 0.5 * radius + 0.006),
                    ],
                    n,
                ),
            ]
        )
        parts += placed([bolts], at(x))
        high = seat + plate + 0.5 * radius + 0.006
    else:
        high = seat + 1.3 * radius + 0.012
        cap = _welded_cap(big, seat, high, radius, n, rng)
    parts = [metal(merge(solids)), trim(cap, "valve bonnet", x, "valve"), *parts]
    gland, tall = packing(slim, style, rng)
    parts += placed(gland, at(x, 0, high))
    wheel, yoke = float(rng.uniform(0.85, 1.2)) * (0.035 + 1.6 * radius), tall + 0.05 + 1.3 * radius
    parts += placed(screwed_up(max(3.6 * slim, 0.8 * big), yoke, min(wheel, 0.079), slim, style, rng), at(x, 0, high))
    if style.hollow:
        plug = rng.random() < 0.5 and ends in ("socket", "butt")
        inside = (
            wedge(dn, x, 0.8 * radius, 0.0, style)
            if plug
            else trim(
                turned(
                    [
                        (0.5 * radius, 0.1 * radius),
                        (0.75 * radius, 0.3 * radius),
                        (0.75 * radius, 0.6 * radius),
                        (0.3 * radius, radius),
                        (0.3 * radius, seat + 0.004),
                    ],
                    16,
                ),
                "valve disc",
                x,
            )
        )
        parts.append(inside)
    return Model(parts, round(length, 6), "welded", "gate valve")


_MID = tuple(dn for dn in SIZES if dn >= 40)
_SMALL = tuple(dn for dn in SIZES if dn <= 50)


GATES: tuple[Family, ...] = (
    valve_family("gate valve/cast wedge", _cast, SIZES, weight=1.5),
    valve_family("gate valve/pressure seal", _pressure_seal, _MID),
    valve_family("gate valve/resilient seated", resilient, _MID),
    valve_family("gate valve/through conduit", _conduit, _MID),
    valve_family("gate valve/forged", _forged, _SMALL),
)
