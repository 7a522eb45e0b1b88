"""Globe and control valves of further makes: bellows, cage trim, angle, oblique, needle, cryogenic, cut open."""

from __future__ import annotations

import numpy as np

from cadgraph.environment.families.actuation import bolted, hand_lever, hand_wheel, indicator, put, shaft
from cadgraph.environment.families.actuation_hand import slab
from cadgraph.environment.families.actuation_stroke import LINEAR, linear, screwed_up, yoke_arms
from cadgraph.environment.families.drive import BODY
from cadgraph.environment.families.isolating_body import (
    bolts_on, ended, lid_joint, metal, neck_of, oval, packing, part_turned, room, trim,
)  # fmt: skip
from cadgraph.environment.families.small import hex_end
from cadgraph.environment.families.valve import disc_flange
from cadgraph.environment.family import Family, Model, Part
from cadgraph.environment.form import (
    along, around, ball, box, cylinder, dome, hexagon, lofted, ring, rod, torus, turned, waves,
)  # fmt: skip
from cadgraph.environment.frame import at, spun
from cadgraph.environment.hand import Hand
from cadgraph.environment.polygon import circle, rounded_rectangle
from cadgraph.environment.solid import Solid, about_x, merge, moved
from cadgraph.environment.standard import FACE_TO_FACE, FLANGES, PIPES, SIZES

__all__ = ["GLOBES"]

Rng = np.random.Generator


def _globe_body(dn: int, hand: Hand, rng: Rng, length: float, ends: str, seat: float, throat: float) -> Solid:
    """A globe's body up to the height ``seat``: a bowl, a barrel or a box with a waist below its collar [m]."""
    radius, (neck, back) = PIPES[dn].radius, neck_of(dn)
    low = back if ends == "flanged" else 0.12 * length
    neck = neck if ends == "flanged" else 1.1 * radius
    belly = float(rng.uniform(1.3, 1.6)) * radius + 0.006
    middle = [(neck, low), (1.15 * radius + 0.003, 0.28 * length), (1.15 * radius + 0.003, 0.72 * length), (neck, length - low)]
    n, kind = max(16, hand.round(belly)), int(rng.integers(4))
    if kind == 0:
        bowl = moved(ball(belly, n, float(rng.uniform(0.9, 1.2))), at(0, 0, float(rng.uniform(-0.25, 0.1)) * belly))
    elif kind == 1:
        bowl = turned([(0.5 * belly, -1.2 * belly), (0.9 * belly, -1.0 * belly), (belly, -0.5 * belly), (belly, 0.6 * belly), (0.8 * belly, belly)], n)
    elif kind == 2:
        bowl = along("y", cylinder(1.05 * belly, -0.9 * belly, 0.9 * belly, n))
    else:
        loops = [(0.8, -1.15), (1.0, -0.9), (1.0, 0.6), (0.75, 1.05)]
        bowl = lofted([np.column_stack([oval(1.35 * belly * s, belly * s, n), np.full(n, z * belly)]) for s, z in loops])
    tower = turned([(throat, 0.0), (throat, seat - 0.002)], n)
    if rng.random() < 0.25:
        drain = merge([cylinder(0.25 * belly, -1.4 * belly, 0.0, 10), hexagon(0.4 * belly, -1.6 * belly, -1.4 * belly)])
        bowl = merge([bowl, drain])
    return merge([ended(dn, hand, length, middle, ends), moved(merge([bowl, tower]), at(length / 2))])


def _plug(radius: float, shape: int, hand: Hand, lift: float) -> Solid:
    """A globe's plug on its seat at z = 0: flat disc, cone, parabolic body or a cage's piston [m]."""
    n = max(12, hand.round(radius))
    if shape == 0:
        profile = [(0.7 * radius, 0.0), (radius, 0.1 * radius), (radius, 0.35 * radius), (0.4 * radius, 0.5 * radius), (0.4 * radius, 0.9 * radius)]
    elif shape == 1:
        profile = [(0.05 * radius, -0.9 * radius), (0.5 * radius, -0.35 * radius), (0.95 * radius, 0.0), (radius, 0.2 * radius), (0.4 * radius, 0.4 * radius), (0.4 * radius, radius)]
    else:
        profile = [(0.2 * radius, -0.8 * radius), (0.7 * radius, -0.6 * radius), (0.9 * radius, 0.0), (radius, 0.05 * radius), (radius, 0.9 * radius)]
    return moved(turned(profile, n), at(0, 0, lift))


def _bellows(dn: int, hand: Hand, rng: Rng) -> Model:
    """A bellows-sealed globe valve: long bonnet or open bellows in a yoke, non-rotating stem (EN 13709, EN 558 series 1)."""
    radius = PIPES[dn].radius
    length = {True: FACE_TO_FACE["globe"][dn], False: 0.12 + 2.2 * radius * 2}[bool(rng.random() < 0.6)]
    x, throat = length / 2, 1.25 * radius + 0.006
    seat = max(room(dn) + 0.005, 2.0 * radius + 0.02)
    plate, half = 0.009 + 0.08 * radius, throat * 1.4 + 0.006
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "round", "square"])), half, half, seat, plate, hand, rng)
    n, slim = max(16, hand.round(throat)), 0.005 + 0.085 * radius
    top, high = seat + plate, seat + plate + float(rng.uniform(1.6, 3.0)) * radius + 0.04
    open_ = rng.random() < 0.4
    bell = waves(top + 0.01, high - 0.01, 0.45 * throat, 0.62 * throat, 7)
    if open_:
        hood = merge([lid, *(box((0.25 * throat, 0.16 * throat, high - top + 0.006), (0, s * 0.82 * throat, (top + high) / 2)) for s in (-1, 1)), cylinder(throat, high - 0.012, high + 0.004, n)])
    else:
        hood = merge([lid, turned([(throat, top - 0.002), (0.75 * throat, top + 0.25 * (high - top)), (0.72 * throat, high - 0.012), (0.9 * throat, high - 0.01), (0.9 * throat, high + 0.004)], n)])
    body = merge([_globe_body(dn, hand, rng, length, "flanged", seat, throat), moved(collar, at(x))])
    parts = [metal(body), trim(hood, "valve bonnet", x, "valve"), *put([bolts], at(x))]
    if open_ or hand.hollow:
        parts.append(trim(turned(bell, max(12, n // 2)), "valve stem", x))
    gland, tall = packing(slim, hand, rng)
    wheel = 0.04 + 1.25 * radius
    parts += put(gland, at(x, 0, high + 0.004))
    if rng.random() < 0.5:
        parts += put(screwed_up(max(0.8 * throat, 3.5 * slim), tall + 0.04 + radius, wheel, slim, hand, rng), at(x, 0, high + 0.004))
    else:
        parts += put([shaft(-0.02, tall + 0.05, slim, hand, rng), hand_wheel(wheel, tall + 0.008, hand, rng)], at(x, 0, high + 0.004))
        parts += put([trim(merge([cylinder(1.8 * slim, tall + 0.05, tall + 0.1, 10)]), "position indicator")], at(x, 0, high + 0.004))
    if hand.hollow:
        parts.append(trim(_plug(0.9 * PIPES[dn].bore, int(rng.integers(3)), hand, 0.1 * radius), "valve disc", x))
    return Model(parts, round(length, 6), kind="globe valve")


def _finned(throat: float, low: float, high: float, n: int, rng: Rng) -> Solid:
    """An extended bonnet: plain for cold service, finned for hot, or ringed [m]."""
    slim, kind = 0.6 * throat, int(rng.integers(3))
    solids = [turned([(slim, low - 0.002), (slim, high)], n)]
    if kind:
        count = int(rng.integers(4, 9))
        wide = throat * float(rng.uniform(0.85, 1.05))
        solids += [ring(0.9 * slim, wide, z, z + 0.35 * (high - low) / count, n) for z in np.linspace(low + 0.08 * (high - low), 0.88 * high + 0.12 * low, count)]
    return merge(solids)


def _cage(dn: int, hand: Hand, rng: Rng) -> Model:
    """A cage-guided control valve: heavy globe body, studded bonnet plain, finned or extended; any actuator (IEC 60534)."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "flanged", "flanged", "butt"]))
    length, x = FACE_TO_FACE["globe"][dn] * float(rng.choice([1.0, 1.1])), FACE_TO_FACE["globe"][dn] / 2
    x, throat = length / 2, float(rng.uniform(1.25, 1.5)) * radius + 0.008
    seat = max(room(dn) * 0.9, 1.8 * radius + 0.02)
    plate, half = 0.012 + 0.12 * radius, throat * 1.35 + 0.01
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "round", "octagon"])), half, half, seat, plate, hand, rng)
    n, slim = max(16, hand.round(throat)), 0.006 + 0.08 * radius
    top = seat + plate
    high = top + float(rng.choice([0.6, 0.8, 2.5, 4.0])) * radius + 0.015
    hood = merge([lid, _finned(throat, top, high, n, rng), turned([(2.8 * slim, high - 0.004), (2.8 * slim, high + 0.02)], n)])
    body = merge([_globe_body(dn, hand, rng, length, ends, seat, throat), moved(collar, at(x))])
    parts = [metal(body), trim(hood, "valve bonnet", x, "valve"), *put([bolts], at(x))]
    gland, tall = packing(slim, hand, rng)
    parts += put(gland, at(x, 0, high + 0.02))
    parts += linear(x, high, radius, hand, rng)
    if hand.hollow:
        bore = PIPES[dn].bore
        cage = ring(0.95 * bore, 1.1 * bore, 0.0, 1.4 * bore, n)
        parts += [trim(cage, "valve body", x), trim(_plug(0.9 * bore, 2, hand, float(rng.uniform(0, 0.7)) * bore), "valve disc", x)]
        parts.append(trim(cylinder(slim, 0.5 * bore, high, 10), "valve stem", x))
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "control valve")


def _control_angle(dn: int, hand: Hand, rng: Rng) -> Model:
    """An angle control valve: inlet from below, outlet to the side, bonnet with any linear actuator above."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    centre, big = 0.55 * size.outer + 0.05, float(rng.uniform(1.3, 1.6)) * radius + 0.008
    n = max(16, hand.round(big))
    outlet = moved(along("y", moved(disc_flange(dn, hand, centre), at(0, 0, -centre))), at(centre))
    throat, plate = 1.2 * radius + 0.006, 0.01 + 0.1 * radius
    seat = centre + max(0.52 * size.outer, 1.6 * radius)
    half = 1.4 * throat + 0.008
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "square", "octagon"])), half, half, seat, plate, hand, rng)
    if rng.random() < 0.5:
        middle = turned([(0.9 * radius, centre - 1.3 * big), (big, centre - 0.7 * big), (big, centre + 0.9 * big), (throat, centre + 1.2 * big), (throat, seat)], n)
    else:
        middle = merge([moved(ball(big, n), at(0, 0, centre)), cylinder(throat, centre, seat, n)])
    top = seat + plate
    high = top + float(rng.uniform(0.5, 2.5)) * radius + 0.01
    upright = [
        trim(merge([lid, _finned(throat, top, high, n, rng)]), "valve bonnet", 0.0, "valve"), bolts,
        *linear(0.0, high, radius, hand, rng),
    ]  # fmt: skip
    body = merge([about_x(merge([disc_flange(dn, hand, centre), middle, collar])), outlet])
    lying = [Part(about_x(p.solid), p.name, p.color, p.bundle, p.group, p.fine) for p in upright]
    return Model([metal(body), *lying], kind="control valve")


def _angle_seat(dn: int, hand: Hand, rng: Rng) -> Model:
    """An angle-seat valve: an oblique bonnet that carries a short piston actuator with a clear dome, or a wheel."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["hex", "octagon", "butt", "flanged"]))
    length = (FACE_TO_FACE["globe"][dn] if ends == "flanged" else 0.045 + 4.2 * radius) * float(rng.uniform(0.95, 1.15))
    neck, back = neck_of(dn) if ends == "flanged" else (1.1 * radius, 0.2 * length)
    barrel = [(neck, back), (1.2 * radius + 0.002, back + 0.1 * length), (1.2 * radius + 0.002, length - back - 0.1 * length), (neck, length - back)]
    tilt = float(rng.uniform(0.55, 0.85)) * float(rng.choice([1.0, 1.0, -1.0]))
    way = at(0.5 * length - 0.15 * length * np.sign(tilt), 0, 0) @ spun("y", tilt)
    n, throat = max(16, hand.round(1.5 * radius)), 1.1 * radius + 0.003
    reach = 2.1 * radius + 0.012 if ends != "flanged" else max(2.2 * radius, 0.75 * FLANGES[dn].outer)
    arm = turned([(throat, 0.0), (throat, reach), (1.15 * throat, reach), (1.15 * throat, reach + 0.004)], n)
    nut = hexagon(2.3 * throat, reach + 0.004, reach + 0.004 + 0.45 * radius) if rng.random() < 0.6 else cylinder(1.2 * throat, reach + 0.004, reach + 0.01 + 0.2 * radius, n)
    top = reach + 0.01 + 0.45 * radius
    slim = 0.004 + 0.09 * radius
    rest: list[Part] = [trim(merge([nut, turned([(0.7 * throat, top - 0.012), (0.5 * throat, top + 0.5 * radius)], n)]), "valve bonnet", 0.0, "valve")]
    z = top + 0.5 * radius
    if rng.random() < 0.7:
        half, long = 0.02 + float(rng.uniform(0.8, 1.3)) * radius, 0.04 + float(rng.uniform(1.4, 2.2)) * radius
        kind = int(rng.integers(3))
        can = turned([(0.45 * half, z), (half, z + 0.15 * half), (half, z + long), (0.92 * half, z + long + 0.12 * half), (0.4 * half, z + long + 0.3 * half)], n)
        if kind == 1:
            can = turned([(0.6 * half, z), (0.6 * half, z + 0.1 * long), (half, z + 0.12 * long), (half, z + 0.3 * long), (0.93 * half, z + 0.32 * long), (0.93 * half, z + long), (0.4 * half, z + long + 0.08 * long)], n)
        if kind == 2:
            can = merge([can, ring(0.95 * half, 1.06 * half, z + 0.45 * long, z + 0.6 * long, n)])
        ports = merge([moved(along("x", hexagon(0.018, 0.85 * half, 1.15 * half + 0.008)), at(0, 0, z + f * long)) for f in (0.3, 0.7)])
        rest += [Part(merge([can, ports]), "actuator", "clamp", "actuator"), shaft(reach, z + 0.02, slim, hand)]
        sight = merge([cylinder(0.2 * half, z + long, z + long + 0.45 * half, 12), dome(0.2 * half, 0.2 * half, z + long + 0.45 * half, 12)])
        rest.append(Part(sight, "position indicator", "dial", "actuator"))
    else:
        rest += [shaft(reach, z + 0.05 + 0.5 * radius, slim, hand, rng), hand_wheel(0.025 + 1.2 * radius, z + 0.01 + 0.3 * radius, hand, rng, ("spoked", "lobed", "disc", "star"))]
    parts = [metal(merge([ended(dn, hand, length, barrel, ends), moved(arm, way)])), *put(rest, way)]
    if hand.hollow:
        parts += put([trim(_plug(0.85 * PIPES[dn].bore, 0, hand, 0.2 * radius), "valve disc")], way)
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "globe valve")


def _needle(dn: int, hand: Hand, rng: Rng) -> Model:
    """A needle valve from bar stock: a hexagon, square, round or forged tee body, screwed bonnet, tee bar or knob."""
    radius = PIPES[dn].radius
    length, kind = 0.03 + 3.2 * radius, int(rng.integers(4))
    big, x, n = 1.25 * radius + 0.003, length / 2, 16
    if kind == 0:
        body = along("x", slab(circle(1.15 * big, 6, phase=np.pi / 6), 0.0, length))
    elif kind == 1:
        body = merge([box((0.9 * length, 2 * big, 2.1 * big), (x, 0, 0.05 * big)), along("x", cylinder(1.05 * radius, 0.0, length, n))])
    elif kind == 2:
        body = merge([along("x", cylinder(big, 0.0, length, n)), box((1.6 * big, 1.9 * big, 1.6 * big), (x, 0, 0.3 * big))])
    else:
        body = merge([hex_end(dn, 0.0, 0.3 * length, hand), hex_end(dn, 0.7 * length, length, hand), along("x", cylinder(0.85 * big, 0.25 * length, 0.75 * length, n)), moved(cylinder(0.9 * big, -0.6 * big, 1.3 * big, n), at(x))])
    top = 1.1 * big
    hex_ = hexagon(1.5 * big, top - 0.002, top + 0.6 * big)
    nut = hexagon(1.15 * big, top + 0.75 * big, top + 1.15 * big)
    column = cylinder(0.5 * big, top, top + 1.7 * big, 12)
    slim, z = 0.0025 + 0.1 * radius, top + 1.7 * big
    parts = [metal(body), trim(merge([hex_, column]), "valve bonnet", x, "valve"), trim(nut, "gland", x)]
    rest = [shaft(-0.6 * big, 0.03 + radius, slim, hand, rng)]
    pick = rng.random()
    if pick < 0.4:
        rest.append(hand_lever(0.03 + 2.0 * radius, 0.01, hand, rng, ("tee",)))
    elif pick < 0.85:
        rest.append(hand_wheel(0.011 + 0.8 * radius, 0.008, hand, rng, ("lobed", "lobed", "star", "disc", "cross", "spoked")))
    else:
        rest += [Part(torus(0.6 * big, 0.12 * big, 16, 6), "handwheel", "handle"), hand_wheel(0.02 + radius, 0.015, hand, rng, ("spoked",))]
        rest.pop(1)
    parts += put(rest, at(x, 0, z))
    if rng.random() < 0.3:
        flat = box((0.5 * length, 3.2 * big, 0.004), (x, 0, -1.0 * big - 0.002))
        parts.append(Part(flat, "bracket", "steel", BODY, "Connection assembly"))
    return Model(parts, round(length, 6), "welded", "needle valve")


def _cryogenic(dn: int, hand: Hand, rng: Rng) -> Model:
    """A cryogenic globe valve: a slender body, a very long bonnet pipe with a drip plate, a yoke far above."""
    radius = PIPES[dn].radius
    length = 0.07 + 4.2 * radius
    x, throat = length / 2, 0.95 * radius + 0.004
    n, slim = max(16, hand.round(throat)), 0.004 + 0.08 * radius
    seat = 1.7 * radius + 0.02
    body = _globe_body(dn, hand, rng, length, str(rng.choice(["butt", "socket"])), seat, throat)
    reach = seat + float(rng.uniform(0.2, 0.45))
    tube = [turned([(1.25 * throat, seat), (1.25 * throat, seat + 0.012), (0.7 * throat, seat + 0.03), (0.7 * throat, reach), (1.1 * throat, reach + 0.003), (1.1 * throat, reach + 0.016)], n)]
    if rng.random() < 0.6:
        tube.append(cylinder(float(rng.uniform(2.0, 3.5)) * throat, seat + 0.4 * (reach - seat), seat + 0.4 * (reach - seat) + 0.003, n))
    gland, tall = packing(slim, hand, rng)
    rest = [*gland, *screwed_up(1.1 * throat, tall + 0.04 + 1.2 * radius, 0.035 + 1.2 * radius, slim, hand, rng)]
    bolts = bolts_on(circle(1.2 * throat, n), 6, seat - 0.008, seat + 0.012, 0.006)
    flange_ = cylinder(1.25 * throat, seat - 0.01, seat, n)
    parts = [metal(merge([body, moved(flange_, at(x))])), trim(merge(tube), "valve bonnet", x, "valve"), *put([bolts], at(x)), *put(rest, at(x, 0, reach + 0.016))]
    return Model(parts, round(length, 6), "welded", "globe valve")


def _cut_open(dn: int, hand: Hand, rng: Rng) -> Model:
    """A globe valve cut open for show: a quarter of body and bonnet away, plug, seat ring and stem in sight."""
    radius, bore = PIPES[dn].radius, PIPES[dn].bore
    length = FACE_TO_FACE["globe"][dn]
    x, big = length / 2, 1.6 * radius + 0.008
    n, size = max(6, hand.round(big) * 3 // 4), FLANGES[dn]
    neck, back = neck_of(dn)
    outer = [(size.outer / 2, 0.0), (size.outer / 2, back), (neck, back), (big, 0.3 * length), (big, 0.7 * length), (neck, length - back), (size.outer / 2, length - back), (size.outer / 2, length)]
    inner = [(bore, length), (bore, 0.65 * length), (0.86 * big, 0.6 * length), (0.86 * big, 0.4 * length), (bore, 0.35 * length), (bore, 0.0)]
    gap = float(rng.uniform(0.25, 0.5)) * np.pi
    # About x angles go from +y over +z: the gap opens towards -y and up.
    shell = about_x(part_turned(np.array(outer + inner), 0.8 * np.pi + 0.5 * gap, 2.8 * np.pi - 0.5 * gap, n))
    seat = max(room(dn), 1.9 * radius)
    bonnet = part_turned(np.array([(0.5 * big, big * 0.7), (0.8 * big, big * 0.7), (0.8 * big, seat), (1.3 * big, seat), (1.3 * big, seat + 0.02), (0.5 * big, seat + 0.05), (0.5 * big, seat + 0.06 + radius), (0.28 * big, seat + 0.06 + radius), (0.28 * big, seat), (0.5 * big, seat)]), -0.3 * np.pi, 1.3 * np.pi, n)
    slim = 0.005 + 0.08 * radius
    high = seat + 0.06 + radius
    rest = [
        trim(bonnet, "valve bonnet", 0.0, "valve"), trim(_plug(0.9 * bore, int(rng.integers(3)), hand, 0.05 * radius), "valve disc"),
        trim(ring(0.6 * bore, 1.0 * bore, -0.25 * bore, 0.0, n), "valve body"), shaft(0.3 * bore, high + 0.06 + radius, slim, hand, rng),
        *put(packing(slim, hand, rng)[0], at(0, 0, high)), hand_wheel(0.04 + 1.2 * radius, high + 0.03 + 0.6 * radius, hand, rng),
    ]  # fmt: skip
    return Model([metal(shell), *put(rest, at(x))], length, kind="globe valve")


def _heating(dn: int, hand: Hand, rng: Rng) -> Model:
    """A two-way or mixing valve of heating plants: compact iron or brass body, a small linear motor on a clamp yoke."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "hex", "octagon"])) if dn <= 50 else "flanged"
    length = FACE_TO_FACE["globe"][dn] * 0.9 if ends == "flanged" else 0.05 + 3.4 * radius
    x, throat = length / 2, 0.9 * radius + 0.008
    seat = max(room(dn) * 0.7, 1.8 * radius + 0.012) if ends == "flanged" else 1.9 * radius + 0.01
    body = [_globe_body(dn, hand, rng, length, ends, seat, throat)]
    if rng.random() < 0.5:
        reach = 0.5 * length
        if ends == "flanged":
            body.append(moved(disc_flange(dn, hand, reach - 0.6 * radius), at(x, 0, -reach)))
        else:
            body.append(moved(moved(hex_end(dn, 0.0, 0.3 * length, hand), spun("y", np.pi / 2)), at(x, 0, -0.9 * radius - 0.0)))
    n = max(16, hand.round(throat))
    cap = merge([cylinder(1.15 * throat, seat - 0.003, seat + 0.012, n), hexagon(1.4 * throat, seat + 0.012, seat + 0.03)])
    parts = [metal(merge(body)), trim(cap, "valve bonnet", x, "valve")]
    z, tall = seat + 0.03, 0.05 + 0.6 * radius
    half = 0.018 + 0.35 * radius
    parts += put([yoke_arms(half, tall, hand, rng, "actuator"), shaft(-0.01, tall, 0.004 + 0.03 * radius, hand), *LINEAR["motor"](radius, tall, hand, rng)], at(x, 0, z))
    if rng.random() < 0.4:
        parts += put([indicator(0.015, hand, rng, 3)], at(x, -half - 0.0, z + 0.5 * tall) @ spun("x", np.pi / 2))
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "control valve")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_SMALL = tuple(dn for dn in SIZES if dn <= 65)


def _family(name: str, build: object, sizes: tuple[int, ...], place: str = "inline", weight: float = 1.0) -> Family:
    return Family(name, place, "Valve assembly", "valve", build, sizes, weight=weight)  # type: ignore[arg-type]


GLOBES: tuple[Family, ...] = (
    _family("globe valve/bellows seal", _bellows, _MID),
    _family("control valve/cage", _cage, SIZES, weight=2),
    _family("control valve/angle", _control_angle, _MID, "head"),
    _family("control valve/heating", _heating, tuple(dn for dn in SIZES if dn <= 100)),
    _family("angle seat valve/piston", _angle_seat, _SMALL, weight=1.5),
    _family("needle valve/bar stock", _needle, tuple(dn for dn in SIZES if dn <= 40)),
    _family("globe valve/cryogenic", _cryogenic, _SMALL),
    _family("globe valve/cut open", _cut_open, _MID, weight=0.6),
)
