"""Control valves with cage trim, of heating plants, and angle valves with pistons."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation_base import hand_wheel, indicator, shaft
from cadplants.families.valves.actuation_stroke import LINEAR, linear, yoke_arms
from cadplants.families.valves.body import (
    ended,
    lid_joint,
    metal,
    neck_of,
    packing,
    room,
    trim,
)  # fmt: skip
from cadplants.families.valves.globe import globe_body, globe_plug
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import disc_flange, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import (
    along,
    ball,
    cylinder,
    dome,
    hexagon,
    ring,
    turned,
)  # fmt: skip
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["CONTROLS"]

Rng = np.random.Generator


def _finned(throat: float, low: float, high: float, n: int, rng: Rng) -> Solid:
    """An extended bonnet: plain for cold service, finned for hot, or ringed [m]."""
    slim, kind = 0.6 * throat, int(rng.integers(3))
    solids = [turned([(slim, low - 0.002), (slim, high)], n)]
    if kind:
        count = int(rng.integers(4, 9))
        wide = throat * float(rng.uniform(0.85, 1.05))
        solids += [
            ring(0.9 * slim, wide, z, z + 0.35 * (high - low) / count, n)
            for z in np.linspace(low + 0.08 * (high - low), 0.88 * high + 0.12 * low, count)
        ]
    return merge(solids)


def _cage(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A cage-guided control valve: heavy body, studded bonnet plain, finned or extended, any actuator (IEC 60534)."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "flanged", "flanged", "butt"]))
    length, x = FACE_TO_FACE["globe"][dn] * float(rng.choice([1.0, 1.1])), FACE_TO_FACE["globe"][dn] / 2
    x, throat = length / 2, float(rng.uniform(1.25, 1.5)) * radius + 0.008
    seat = max(room(dn) * 0.9, 1.8 * radius + 0.02)
    plate, half = 0.012 + 0.12 * radius, throat * 1.35 + 0.01
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "round", "octagon"])), half, half, seat, plate, style, rng)
    n, slim = max(16, style.round(throat)), 0.006 + 0.08 * radius
    top = seat + plate
    high = top + float(rng.choice([0.6, 0.8, 2.5, 4.0])) * radius + 0.015
    hood = merge(
        [lid, _finned(throat, top, high, n, rng), turned([(2.8 * slim, high - 0.004), (2.8 * slim, high + 0.02)], n)]
    )
    body = merge([globe_body(dn, style, rng, length, ends, seat, throat), moved(collar, at(x))])
    parts = [metal(body), trim(hood, "valve bonnet", x, "valve"), *placed([bolts], at(x))]
    gland, _ = packing(slim, style, rng)
    parts += placed(gland, at(x, 0, high + 0.02))
    parts += linear(x, high, radius, style, rng)
    if style.hollow:
        bore = PIPES[dn].bore
        cage = ring(0.95 * bore, 1.1 * bore, 0.0, 1.4 * bore, n)
        parts += [
            trim(cage, "valve body", x),
            trim(globe_plug(0.9 * bore, 2, style, float(rng.uniform(0, 0.7)) * bore), "valve disc", x),
        ]
        parts.append(trim(cylinder(slim, 0.5 * bore, high, 10), "valve stem", x))
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "control valve")


def _control_angle(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An angle control valve: inlet from below, outlet to the side, bonnet with any linear actuator above."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    centre, big = 0.55 * size.outer + 0.05, float(rng.uniform(1.3, 1.6)) * radius + 0.008
    n = max(16, style.round(big))
    outlet = moved(along("y", moved(disc_flange(dn, style, centre), at(0, 0, -centre))), at(centre))
    throat, plate = 1.2 * radius + 0.006, 0.01 + 0.1 * radius
    seat = centre + max(0.52 * size.outer, 1.6 * radius)
    half = 1.4 * throat + 0.008
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "square", "octagon"])), half, half, seat, plate, style, rng)
    if rng.random() < 0.5:
        middle = turned(
            [
                (0.9 * radius, centre - 1.3 * big),
                (big, centre - 0.7 * big),
                (big, centre + 0.9 * big),
                (throat, centre + 1.2 * big),
                (throat, seat),
            ],
            n,
        )
    else:
        middle = merge([moved(ball(big, n), at(0, 0, centre)), cylinder(throat, centre, seat, n)])
    top = seat + plate
    high = top + float(rng.uniform(0.5, 2.5)) * radius + 0.01
    upright = [
        trim(merge([lid, _finned(throat, top, high, n, rng)]), "valve bonnet", 0.0, "valve"),
        bolts,
        *linear(0.0, high, radius, style, rng),
    ]
    body = merge([about_x(merge([disc_flange(dn, style, centre), middle, collar])), outlet])
    lying = [Part(about_x(p.solid), p.name, p.color, p.bundle, p.group, p.fine) for p in upright]
    return Model([metal(body), *lying], kind="control valve")


def _short_piston(
    z: float, reach: float, slim: float, radius: float, n: int, style: ModelingStyle, rng: Rng
) -> list[Part]:
    """A short piston actuator with its air ports and a clear sight dome, its stem from ``reach`` up [m]."""
    half, long = 0.02 + float(rng.uniform(0.8, 1.3)) * radius, 0.04 + float(rng.uniform(1.4, 2.2)) * radius
    kind = int(rng.integers(3))
    can = turned(
        [
            (0.45 * half, z),
            (half, z + 0.15 * half),
            (half, z + long),
            (0.92 * half, z + long + 0.12 * half),
            (0.4 * half, z + long + 0.3 * half),
        ],
        n,
    )
    if kind == 1:
        can = turned(
            [
                (0.6 * half, z),
                (0.6 * half, z + 0.1 * long),
                (half, z + 0.12 * long),
                (half, z + 0.3 * long),
                (0.93 * half, z + 0.32 * long),
                (0.93 * half, z + long),
                (0.4 * half, z + long + 0.08 * long),
            ],
            n,
        )
    if kind == 2:
        can = merge([can, ring(0.95 * half, 1.06 * half, z + 0.45 * long, z + 0.6 * long, n)])
    ports = merge(
        [
            moved(along("x", hexagon(0.018, 0.85 * half, 1.15 * half + 0.008)), at(0, 0, z + f * long))
            for f in (0.3, 0.7)
        ]
    )
    rest = [Part(merge([can, ports]), "actuator", "clamp", "actuator"), shaft(reach, z + 0.02, slim, style)]
    sight = merge(
        [
            cylinder(0.2 * half, z + long, z + long + 0.45 * half, 12),
            dome(0.2 * half, 0.2 * half, z + long + 0.45 * half, 12),
        ]
    )
    rest.append(Part(sight, "position indicator", "dial", "actuator"))
    return rest


def _angle_seat(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """An angle-seat valve: an oblique bonnet that carries a short piston actuator with a clear dome, or a wheel."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["hex", "octagon", "butt", "flanged"]))
    length = (FACE_TO_FACE["globe"][dn] if ends == "flanged" else 0.045 + 4.2 * radius) * float(rng.uniform(0.95, 1.15))
    neck, back = neck_of(dn) if ends == "flanged" else (1.1 * radius, 0.2 * length)
    barrel = [
        (neck, back),
        (1.2 * radius + 0.002, back + 0.1 * length),
        (1.2 * radius + 0.002, length - back - 0.1 * length),
        (neck, length - back),
    ]
    tilt = float(rng.uniform(0.55, 0.85)) * float(rng.choice([1.0, 1.0, -1.0]))
    way = at(0.5 * length - 0.15 * length * np.sign(tilt), 0, 0) @ spun("y", tilt)
    n, throat = max(16, style.round(1.5 * radius)), 1.1 * radius + 0.003
    reach = 2.1 * radius + 0.012 if ends != "flanged" else max(2.2 * radius, 0.75 * FLANGES[dn].outer)
    arm = turned([(throat, 0.0), (throat, reach), (1.15 * throat, reach), (1.15 * throat, reach + 0.004)], n)
    nut = (
        hexagon(2.3 * throat, reach + 0.004, reach + 0.004 + 0.45 * radius)
        if rng.random() < 0.6
        else cylinder(1.2 * throat, reach + 0.004, reach + 0.01 + 0.2 * radius, n)
    )
    top = reach + 0.01 + 0.45 * radius
    slim = 0.004 + 0.09 * radius
    rest: list[Part] = [
        trim(
            merge([nut, turned([(0.7 * throat, top - 0.012), (0.5 * throat, top + 0.5 * radius)], n)]),
            "valve bonnet",
            0.0,
            "valve",
        )
    ]
    z = top + 0.5 * radius
    if rng.random() < 0.7:
        rest += _short_piston(z, reach, slim, radius, n, style, rng)
    else:
        rest += [
            shaft(reach, z + 0.05 + 0.5 * radius, slim, style, rng),
            hand_wheel(0.025 + 1.2 * radius, z + 0.01 + 0.3 * radius, style, rng, ("spoked", "lobed", "disc", "star")),
        ]
    parts = [metal(merge([ended(dn, style, length, barrel, ends), moved(arm, way)])), *placed(rest, way)]
    if style.hollow:
        parts += placed([trim(globe_plug(0.85 * PIPES[dn].bore, 0, style, 0.2 * radius), "valve disc")], way)
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "globe valve")


def _heating(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A two-way or mixing valve of heating plants: compact iron or brass body, a small linear motor on a clamp yoke."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "hex", "octagon"])) if dn <= 50 else "flanged"
    length = FACE_TO_FACE["globe"][dn] * 0.9 if ends == "flanged" else 0.05 + 3.4 * radius
    x, throat = length / 2, 0.9 * radius + 0.008
    seat = max(room(dn) * 0.7, 1.8 * radius + 0.012) if ends == "flanged" else 1.9 * radius + 0.01
    body = [globe_body(dn, style, rng, length, ends, seat, throat)]
    if rng.random() < 0.5:
        reach = 0.5 * length
        if ends == "flanged":
            body.append(moved(disc_flange(dn, style, reach - 0.6 * radius), at(x, 0, -reach)))
        else:
            body.append(
                moved(moved(hex_end(dn, 0.0, 0.3 * length, style), spun("y", np.pi / 2)), at(x, 0, -0.9 * radius - 0.0))
            )
    n = max(16, style.round(throat))
    cap = merge(
        [cylinder(1.15 * throat, seat - 0.003, seat + 0.012, n), hexagon(1.4 * throat, seat + 0.012, seat + 0.03)]
    )
    parts = [metal(merge(body)), trim(cap, "valve bonnet", x, "valve")]
    z, tall = seat + 0.03, 0.05 + 0.6 * radius
    half = 0.018 + 0.35 * radius
    parts += placed(
        [
            yoke_arms(half, tall, style, rng, "actuator"),
            shaft(-0.01, tall, 0.004 + 0.03 * radius, style),
            *LINEAR["motor"](radius, tall, style, rng),
        ],
        at(x, 0, z),
    )
    if rng.random() < 0.4:
        parts += placed([indicator(0.015, style, rng, 3)], at(x, -half - 0.0, z + 0.5 * tall) @ spun("x", np.pi / 2))
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "control valve")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_SMALL = tuple(dn for dn in SIZES if dn <= 65)


CONTROLS: tuple[Family, ...] = (
    valve_family("control valve/cage", _cage, SIZES, weight=2),
    valve_family("control valve/angle", _control_angle, _MID, "head"),
    valve_family("control valve/heating", _heating, tuple(dn for dn in SIZES if dn <= 100)),
    valve_family("angle seat valve/piston", _angle_seat, _SMALL, weight=1.5),
)
