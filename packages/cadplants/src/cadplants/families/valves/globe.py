"""Globe and control valves of further makes: bellows, cage trim, angle, oblique, needle, cryogenic, cut open."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation_base import hand_lever, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.actuation_stroke import screwed_up
from cadplants.families.valves.body import (
    bolts_on,
    ended,
    lid_joint,
    metal,
    neck_of,
    oval,
    packing,
    part_turned,
    room,
    trim,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import along, ball, box, cylinder, hexagon, lofted, ring, torus, turned, waves  # fmt: skip
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at
from cadplants.valve_body import bore_of

__all__ = ["GLOBES", "globe_body", "globe_plug"]

Rng = np.random.Generator


def globe_body(dn: int, style: ModelingStyle, rng: Rng, length: float, ends: str, seat: float, throat: float) -> Solid:
    """A globe's body up to the height ``seat``: a bowl, a barrel or a box with a waist below its collar [m]."""
    radius, (neck, back) = PIPES[dn].radius, neck_of(dn)
    low = back if ends == "flanged" else 0.12 * length
    neck = neck if ends == "flanged" else 1.1 * radius
    belly = float(rng.uniform(1.3, 1.6)) * radius + 0.006
    middle = [
        (neck, low),
        (1.15 * radius + 0.003, 0.28 * length),
        (1.15 * radius + 0.003, 0.72 * length),
        (neck, length - low),
    ]
    n, kind = max(16, style.round(belly)), int(rng.integers(4))
    if kind == 0:
        bowl = moved(ball(belly, n, float(rng.uniform(0.9, 1.2))), at(0, 0, float(rng.uniform(-0.25, 0.1)) * belly))
    elif kind == 1:
        bowl = turned(
            [
                (0.5 * belly, -1.2 * belly),
                (0.9 * belly, -1.0 * belly),
                (belly, -0.5 * belly),
                (belly, 0.6 * belly),
                (0.8 * belly, belly),
            ],
            n,
        )
    elif kind == 2:
        bowl = along("y", cylinder(1.05 * belly, -0.9 * belly, 0.9 * belly, n))
    else:
        loops = [(0.8, -1.15), (1.0, -0.9), (1.0, 0.6), (0.75, 1.05)]
        bowl = lofted(
            [np.column_stack([oval(1.35 * belly * s, belly * s, n), np.full(n, z * belly)]) for s, z in loops]
        )
    tower = turned([(throat, 0.0), (throat, seat - 0.002)], n)
    if rng.random() < 0.25:
        drain = merge([cylinder(0.25 * belly, -1.4 * belly, 0.0, 10), hexagon(0.4 * belly, -1.6 * belly, -1.4 * belly)])
        bowl = merge([bowl, drain])
    return merge([ended(dn, style, length, middle, ends), moved(merge([bowl, tower]), at(length / 2))])


def globe_plug(radius: float, shape: int, style: ModelingStyle, lift: float) -> Solid:
    """A globe's plug on its seat at z = 0: flat disc, cone, parabolic body or a cage's piston [m]."""
    n = max(12, style.round(radius))
    if shape == 0:
        profile = [
            (0.7 * radius, 0.0),
            (radius, 0.1 * radius),
            (radius, 0.35 * radius),
            (0.4 * radius, 0.5 * radius),
            (0.4 * radius, 0.9 * radius),
        ]
    elif shape == 1:
        profile = [
            (0.05 * radius, -0.9 * radius),
            (0.5 * radius, -0.35 * radius),
            (0.95 * radius, 0.0),
            (radius, 0.2 * radius),
            (0.4 * radius, 0.4 * radius),
            (0.4 * radius, radius),
        ]
    else:
        profile = [
            (0.2 * radius, -0.8 * radius),
            (0.7 * radius, -0.6 * radius),
            (0.9 * radius, 0.0),
            (radius, 0.05 * radius),
            (radius, 0.9 * radius),
        ]
    return moved(turned(profile, n), at(0, 0, lift))


def _bellows(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A bellows-sealed globe valve: long bonnet or open bellows in a yoke (EN 13709, EN 558 series 1)."""
    radius = PIPES[dn].radius
    length = {True: FACE_TO_FACE["globe"][dn], False: 0.12 + 2.2 * radius * 2}[bool(rng.random() < 0.6)]
    x, throat = length / 2, 1.25 * radius + 0.006
    seat = max(room(dn) + 0.005, 2.0 * radius + 0.02)
    plate, half = 0.009 + 0.08 * radius, throat * 1.4 + 0.006
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "round", "square"])), half, half, seat, plate, style, rng)
    n, slim = max(16, style.round(throat)), 0.005 + 0.085 * radius
    top, high = seat + plate, seat + plate + float(rng.uniform(1.6, 3.0)) * radius + 0.04
    open_ = rng.random() < 0.4
    bell = waves(top + 0.01, high - 0.01, 0.45 * throat, 0.62 * throat, 7)
    if open_:
        hood = merge(
            [
                lid,
                *(
                    box((0.25 * throat, 0.16 * throat, high - top + 0.006), (0, s * 0.82 * throat, (top + high) / 2))
                    for s in (-1, 1)
                ),
                cylinder(throat, high - 0.012, high + 0.004, n),
            ]
        )
    else:
        hood = merge(
            [
                lid,
                turned(
                    [
                        (throat, top - 0.002),
                        (0.75 * throat, top + 0.25 * (high - top)),
                        (0.72 * throat, high - 0.012),
                        (0.9 * throat, high - 0.01),
                        (0.9 * throat, high + 0.004),
                    ],
                    n,
                ),
            ]
        )
    body = merge([globe_body(dn, style, rng, length, "flanged", seat, throat), moved(collar, at(x))])
    parts = [metal(body), trim(hood, "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    if open_ or style.hollow:
        parts.append(trim(turned(bell, max(12, n // 2)), "valve stem", x))
    gland, tall = packing(slim, style, rng)
    wheel = 0.04 + 1.25 * radius
    parts += placed(gland, at(x, 0, high + 0.004))
    if rng.random() < 0.5:
        parts += placed(
            screwed_up(max(0.8 * throat, 3.5 * slim), tall + 0.04 + radius, wheel, slim, style, rng),
            at(x, 0, high + 0.004),
        )
    else:
        parts += placed(
            [shaft(-0.02, tall + 0.05, slim, style, rng), hand_wheel(wheel, tall + 0.008, style, rng)],
            at(x, 0, high + 0.004),
        )
        parts += placed(
            [
                trim(
                    merge(
                        [
                            cylinder(0.8 * slim, tall + 0.05, tall + 0.1, 10),
                            cylinder(2.6 * slim, tall + 0.06, tall + 0.066, 14),
                        ]
                    ),
                    "position indicator",
                )
            ],
            at(x, 0, high + 0.004),
        )
    if style.hollow:
        parts.append(trim(globe_plug(0.9 * PIPES[dn].bore, int(rng.integers(3)), style, 0.1 * radius), "valve disc", x))
    return Model(parts, round(length, 6), kind="globe valve")


def _needle(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A needle valve from bar stock: a hexagon, square, round or forged tee body, screwed bonnet, tee bar or knob."""
    radius = PIPES[dn].radius
    length, kind = 0.03 + 3.2 * radius, int(rng.integers(4))
    big, x, n, bore = 1.25 * radius + 0.003, length / 2, 16, bore_of(dn, style)
    if kind == 0:
        body = along("x", slab(circle(1.15 * big, 6, phase=np.pi / 6), 0.0, length, (circle(bore, n),) if bore else ()))
    elif kind == 1:
        body = merge(
            [
                box((0.9 * length, 2 * big, 2.1 * big), (x, 0, 0.05 * big)),
                along("x", ring(bore, 1.05 * radius, 0.0, length, n)),
            ]
        )
    elif kind == 2:
        body = merge(
            [along("x", ring(bore, big, 0.0, length, n)), box((1.6 * big, 1.9 * big, 1.6 * big), (x, 0, 0.3 * big))]
        )
    else:
        body = merge(
            [
                hex_end(dn, 0.0, 0.3 * length, style),
                hex_end(dn, 0.7 * length, length, style),
                along("x", cylinder(0.85 * big, 0.25 * length, 0.75 * length, n)),
                moved(cylinder(0.9 * big, -0.6 * big, 1.3 * big, n), at(x)),
            ]
        )
    top = 1.1 * big
    hex_ = hexagon(1.5 * big, top - 0.002, top + 0.6 * big)
    nut = hexagon(1.15 * big, top + 0.75 * big, top + 1.15 * big)
    column = cylinder(0.5 * big, top, top + 1.7 * big, 12)
    slim, z = 0.0025 + 0.1 * radius, top + 1.7 * big
    parts = [metal(body), trim(merge([hex_, column]), "valve bonnet", x, "valve"), trim(nut, "gland", x)]
    rest = [shaft(-0.6 * big, 0.03 + radius, slim, style, rng)]
    pick = rng.random()
    if pick < 0.4:
        rest.append(hand_lever(0.03 + 2.0 * radius, 0.01, style, rng, ("tee",)))
    elif pick < 0.85:
        rest.append(
            hand_wheel(0.011 + 0.8 * radius, 0.008, style, rng, ("lobed", "lobed", "star", "disc", "cross", "spoked"))
        )
    else:
        rest += [
            Part(torus(0.6 * big, 0.12 * big, 16, 6), "handwheel", "handle"),
            hand_wheel(0.02 + radius, 0.015, style, rng, ("spoked",)),
        ]
        rest.pop(1)
    parts += placed(rest, at(x, 0, z))
    if rng.random() < 0.3:
        flat = box((0.5 * length, 3.2 * big, 0.004), (x, 0, -1.0 * big - 0.002))
        parts.append(Part(flat, "bracket", "steel", BODY, "Connection assembly"))
    return Model(parts, round(length, 6), "welded", "needle valve")


def _cryogenic(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A cryogenic globe valve: a slender body, a very long bonnet pipe with a drip plate, a yoke far above."""
    radius = PIPES[dn].radius
    length = 0.07 + 4.2 * radius
    x, throat = length / 2, 0.95 * radius + 0.004
    n, slim = max(16, style.round(throat)), 0.004 + 0.08 * radius
    seat = 1.7 * radius + 0.02
    body = globe_body(dn, style, rng, length, str(rng.choice(["butt", "socket"])), seat, throat)
    reach = seat + float(rng.uniform(0.2, 0.45))
    tube = [
        turned(
            [
                (1.25 * throat, seat),
                (1.25 * throat, seat + 0.012),
                (0.7 * throat, seat + 0.03),
                (0.7 * throat, reach),
                (1.1 * throat, reach + 0.003),
                (1.1 * throat, reach + 0.016),
            ],
            n,
        )
    ]
    if rng.random() < 0.6:
        tube.append(
            cylinder(
                float(rng.uniform(2.0, 3.5)) * throat,
                seat + 0.4 * (reach - seat),
                seat + 0.4 * (reach - seat) + 0.003,
                n,
            )
        )
    gland, tall = packing(slim, style, rng)
    rest = [*gland, *screwed_up(1.1 * throat, tall + 0.04 + 1.2 * radius, 0.035 + 1.2 * radius, slim, style, rng)]
    bolts = bolts_on(circle(1.2 * throat, n), 6, seat - 0.008, seat + 0.012, 0.006)
    flange_ = cylinder(1.25 * throat, seat - 0.01, seat, n)
    parts = [
        metal(merge([body, moved(flange_, at(x))])),
        trim(merge(tube), "valve bonnet", x, "valve"),
        *placed([bolts], at(x)),
        *placed(rest, at(x, 0, reach + 0.016)),
    ]
    return Model(parts, round(length, 6), "welded", "globe valve")


def _cut_open(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A globe valve cut open for show: a quarter of body and bonnet away, plug, seat ring and stem in sight."""
    radius, bore = PIPES[dn].radius, PIPES[dn].bore
    length = FACE_TO_FACE["globe"][dn]
    x, big = length / 2, 1.6 * radius + 0.008
    n, size = max(6, style.round(big) * 3 // 4), FLANGES[dn]
    neck, back = neck_of(dn)
    outer = [
        (size.outer / 2, 0.0),
        (size.outer / 2, back),
        (neck, back),
        (big, 0.3 * length),
        (big, 0.7 * length),
        (neck, length - back),
        (size.outer / 2, length - back),
        (size.outer / 2, length),
    ]
    inner = [
        (bore, length),
        (bore, 0.65 * length),
        (0.86 * big, 0.6 * length),
        (0.86 * big, 0.4 * length),
        (bore, 0.35 * length),
        (bore, 0.0),
    ]
    gap = float(rng.uniform(0.25, 0.5)) * np.pi
    # About x angles go from +y over +z: the gap opens towards -y and up.
    shell = about_x(part_turned(np.array(outer + inner), 0.8 * np.pi + 0.5 * gap, 2.8 * np.pi - 0.5 * gap, n))
    seat = max(room(dn), 1.9 * radius)
    bonnet = part_turned(
        np.array(
            [
                (0.5 * big, big * 0.7),
                (0.8 * big, big * 0.7),
                (0.8 * big, seat),
                (1.3 * big, seat),
                (1.3 * big, seat + 0.02),
                (0.5 * big, seat + 0.05),
                (0.5 * big, seat + 0.06 + radius),
                (0.28 * big, seat + 0.06 + radius),
                (0.28 * big, seat),
                (0.5 * big, seat),
            ]
        ),
        -0.3 * np.pi,
        1.3 * np.pi,
        n,
    )
    slim = 0.005 + 0.08 * radius
    high = seat + 0.06 + radius
    rest = [
        trim(bonnet, "valve bonnet", 0.0, "valve"),
        trim(globe_plug(0.9 * bore, int(rng.integers(3)), style, 0.05 * radius), "valve disc"),
        trim(ring(0.6 * bore, 1.0 * bore, -0.25 * bore, 0.0, n), "valve body"),
        shaft(0.3 * bore, high + 0.06 + radius, slim, style, rng),
        *placed(packing(slim, style, rng)[0], at(0, 0, high)),
        hand_wheel(0.04 + 1.2 * radius, high + 0.03 + 0.6 * radius, style, rng),
    ]
    return Model([metal(shell), *placed(rest, at(x))], length, kind="globe valve")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_SMALL = tuple(dn for dn in SIZES if dn <= 65)


GLOBES: tuple[Family, ...] = (
    valve_family("globe valve/bellows seal", _bellows, _MID),
    valve_family("needle valve/bar stock", _needle, tuple(dn for dn in SIZES if dn <= 40)),
    valve_family("globe valve/cryogenic", _cryogenic, _SMALL),
    valve_family("globe valve/cut open", _cut_open, _MID, weight=0.6),
)
