"""Plug, diaphragm and pinch valves of further makes."""

from __future__ import annotations

import numpy as np

from cadgraph.environment.families.actuation import bolted, hand_lever, hand_wheel, put, quarter_turn, shaft
from cadgraph.environment.families.actuation_hand import slab
from cadgraph.environment.families.actuation_stroke import LINEAR, yoke_arms
from cadgraph.environment.families.drive import BODY
from cadgraph.environment.families.isolating_ball import clamp_ring, ferrule, part_ring
from cadgraph.environment.families.isolating_body import (
    bolts_on, ended, lid_joint, metal, neck_of, oval, packing, plate_outline, room, trim,
)  # fmt: skip
from cadgraph.environment.families.valve import disc_flange
from cadgraph.environment.family import Family, Model, Part
from cadgraph.environment.flange import plate_thickness
from cadgraph.environment.form import along, around, box, cylinder, dome, hexagon, lofted, ring, rod, turned, waves
from cadgraph.environment.frame import at, spun
from cadgraph.environment.hand import Hand
from cadgraph.environment.polygon import circle, rounded_rectangle
from cadgraph.environment.solid import Solid, about_x, merge, moved
from cadgraph.environment.standard import FACE_TO_FACE, FLANGES, PIPES, SIZES

__all__ = ["LININGS"]

Rng = np.random.Generator


def _taper(radius: float, low: float, high: float, port: float, n: int) -> Solid:
    """A tapered plug about z, its port as a flat pocket on each side [m]."""
    return turned([(0.82 * radius, low), (radius, high), (0.5 * radius, high + 0.02), (0.4 * radius, high + 0.5 * port)], n)


def _lubricated(dn: int, hand: Hand, rng: Rng) -> Model:
    """A lubricated plug valve: rectangular waist, bolted gland plate, grease fitting in the square head, wrench (API 599)."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * float(rng.uniform(1.0, 1.3))
    neck, back = neck_of(dn)
    x, big = length / 2, 1.3 * radius + 0.010
    n = max(16, hand.round(big))
    middle = [(neck, back), (1.05 * radius + 0.006, back + 0.15 * length), (1.05 * radius + 0.006, length - back - 0.15 * length), (neck, length - back)]
    low, high = -1.35 * radius - 0.008, 1.45 * radius + 0.012
    kind = int(rng.integers(3))
    if kind == 0:
        loops = [(0.75 * big, low), (0.8 * big, 0.0), (big, high)]
        chest = lofted([np.column_stack([circle(r, n), np.full(n, z)]) for r, z in loops])
    elif kind == 1:
        chest = slab(rounded_rectangle(1.7 * big, 2.1 * big, 0.35 * big, 3), low, high)
    else:
        chest = lofted([np.column_stack([oval(0.8 * big * s, 1.15 * big * s, n), np.full(n, z)]) for s, z in ((0.8, low), (1.0, 0.3 * low), (1.0, high))])
    plate = 0.010 + 0.07 * radius
    collar, lid, bolts = lid_joint(str(rng.choice(["round", "oval", "square", "octagon"])), 1.1 * big, 1.3 * big, high, plate, hand, rng)
    top, half = high + plate, 0.3 * radius + 0.006
    body = merge([ended(dn, hand, length, middle, "flanged"), moved(merge([chest, collar]), at(x))])
    parts = [metal(body), trim(lid, "valve bonnet", x, "valve"), *put([bolts], at(x))]
    gland, tall = packing(0.8 * half, hand, rng, int(rng.choice([0, 2])))
    head = merge([cylinder(half, -0.01, 2.2 * half, 12), box((1.7 * half, 1.7 * half, 2.2 * half), (0, 0, 3.2 * half))])
    grease = merge([hexagon(0.02, 4.2 * half, 4.2 * half + 0.012), cylinder(0.005, 4.2 * half, 4.2 * half + 0.03, 8), dome(0.005, 0.005, 4.2 * half + 0.03, 8)])
    parts += put([*gland, Part(merge([head, grease]), "valve stem", "trim", BODY)], at(x, 0, top))
    pick = rng.random()
    if pick < 0.55:
        parts += put([hand_lever(0.14 + 2.8 * radius, 2.3 * half, hand, rng, ("spanner", "bar", "cast"))], at(x, 0, top))
    elif pick < 0.9:
        parts += quarter_turn(x, top + 2.2 * half, radius, hand, rng, ("worm", "worm", "scotch", "rack"))
    if rng.random() < 0.4:
        parts.append(trim(merge([cylinder(0.4 * big, low - 0.012, low + 0.004, 14), hexagon(0.5 * big, low - 0.025, low - 0.012)]), "valve bonnet", x, "valve"))
    if hand.hollow:
        parts.append(trim(_taper(0.95 * radius, -1.1 * radius, 1.1 * radius, radius, n), "valve disc", x))
    return Model(parts, round(length, 6), kind="plug valve")


def _eccentric(dn: int, hand: Hand, rng: Rng) -> Model:
    """An eccentric plug valve for sewage: bulging half-round body, bolted cover with a bearing hub, lever, nut or gear."""
    radius = PIPES[dn].radius
    length = 0.09 + 2.0 * radius
    neck, back = neck_of(dn)
    x, big = length / 2, 1.35 * radius + 0.012
    n = max(16, hand.round(big))
    body = [ended(dn, hand, length, [(neck, back), (1.1 * radius + 0.005, x), (neck, length - back)], "flanged")]
    hump = merge([cylinder(min(big, 0.47 * length), -1.1 * radius - 0.01, 1.15 * radius + 0.012, n)])
    body.append(moved(hump, at(x, 0.35 * radius)))
    seat, plate = 1.15 * radius + 0.016, 0.012 + 0.06 * radius
    wide = min(big, 0.47 * length) * 1.12
    collar, lid, bolts = lid_joint("round", wide, wide, seat + plate, plate, hand, rng)
    body.append(moved(collar, at(x, 0.35 * radius)))
    hub = 0.22 * radius + 0.014
    high = max(seat + 2 * plate + 0.02, room(dn))
    cover = merge([lid, turned([(1.6 * hub, seat + 2 * plate - 0.003), (hub, high - 0.01), (1.7 * hub, high - 0.008), (1.7 * hub, high)], n)])
    foot = moved(cylinder(1.2 * hub, -1.1 * radius - 0.03, -1.0 * radius, 14), at(x, 0.2 * radius))
    pose = at(x, 0.2 * radius, high)
    parts = [metal(merge([*body, foot])), trim(moved(cover, at(0, 0.35 * radius)), "valve bonnet", x, "valve"), *put([bolts], at(x, 0.35 * radius))]
    parts += put([shaft(-0.02, 0.04, 0.5 * hub, hand)], pose)
    pick = rng.random()
    if pick < 0.3:
        nut = box((0.05, 0.05, 0.05), (0, 0, 0.06))
        parts += put([Part(nut, "valve stem", "trim", BODY)], pose)
    elif pick < 0.5:
        parts += put([hand_lever(0.12 + 2.4 * radius, 0.01, hand, rng, ("bar", "cast", "spanner"))], pose)
    else:
        parts += put(quarter_turn(0, 0.004, radius, hand, rng, ("worm", "worm", "bevel", "multi-turn", "scotch")), pose)
    if hand.hollow:
        plug = np.array([(1.05 * radius * np.cos(t), 1.05 * radius * np.sin(t)) for t in np.linspace(0.25, 2.9, 12)] + [(0.5 * radius * np.cos(t), 0.6 * radius * np.sin(t)) for t in np.linspace(2.9, 0.25, 6)])
        turn = spun("z", float(rng.choice([0.0, -0.5])) * np.pi)
        parts.append(trim(moved(slab(plug, -0.8 * radius, 0.8 * radius), turn), "valve disc", x))
    return Model(parts, round(length, 6), kind="plug valve")


def _multi_plug(dn: int, hand: Hand, rng: Rng) -> Model:
    """A sleeved multi-port plug valve: flanges at three or four sides of a round chest, a square top cover, wrench."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * 1.25
    neck, back = neck_of(dn)
    x, big = length / 2, 1.35 * radius + 0.012
    n = max(16, hand.round(big))
    low, high = -1.3 * radius - 0.01, 1.4 * radius + 0.012
    chest = turned([(0.85 * big, low), (0.9 * big, 0.8 * low), (big, high)], n)
    body = [ended(dn, hand, length, [(neck, back), (1.05 * radius + 0.004, 0.4 * length), (1.05 * radius + 0.004, 0.6 * length), (neck, length - back)], "flanged"), moved(chest, at(x))]
    for way in ("y", "-y") if rng.random() < 0.3 else ("y",):
        side = moved(disc_flange(dn, hand, x - 0.7 * radius), at(0, 0, -x))
        body.append(moved(along("-y" if way == "y" else "y", side), at(x)))
    plate = 0.012 + 0.06 * radius
    collar, lid, bolts = lid_joint(str(rng.choice(["square", "round"])), 1.2 * big, 1.2 * big, high, plate, hand, rng)
    top, slim = high + plate, 0.25 * radius + 0.006
    adjust = merge([moved(hexagon(0.014, top, top + 0.012), at(0.6 * big * np.cos(t), 0.6 * big * np.sin(t))) for t in (0.5, 2.6, 4.7)])
    parts = [metal(merge([*body, moved(collar, at(x))])), trim(lid, "valve bonnet", x, "valve"), *put([bolts, bolted(adjust), shaft(-0.2 * radius, top + 2.5 * slim, slim, hand)], at(x))]
    stop = merge([cylinder(1.9 * slim, top + 0.004, top + 0.01, 16), box((0.02, 3.2 * slim, 0.006), (1.6 * slim, 0, top + 0.007))])
    parts.append(trim(stop, "position indicator", x))
    if rng.random() < 0.6:
        parts += put([hand_lever(0.12 + 2.2 * radius, top + 0.012, hand, rng, ("spanner", "bar", "sheet", "cast"))], at(x))
    else:
        parts += quarter_turn(x, top + 0.012, radius, hand, rng, ("worm", "rack", "motor box", "scotch"))
    return Model(parts, round(length, 6), kind="plug valve")


def _straight(dn: int, hand: Hand, rng: Rng) -> Model:
    """A straight-through diaphragm valve: a full-bore body with a long oval joint, a tall bonnet, wheel or cylinder (EN 13397)."""
    radius = PIPES[dn].radius
    length = FACE_TO_FACE["gate"][dn] * 1.1
    neck, back = neck_of(dn)
    x, n = length / 2, max(16, hand.round(1.6 * radius))
    half_x, half_y = min(0.42 * length, 1.7 * radius + 0.012), 1.25 * radius + 0.014
    seat, plate = max(1.25 * radius + 0.006, 0.0), 0.009 + 0.07 * radius
    kind = str(rng.choice(["oval", "square", "oval", "octagon"]))
    collar, lid, bolts = lid_joint(kind, half_x, half_y, seat, plate, hand, rng)
    tray = lofted([np.column_stack([oval(half_x * s, half_y * t, n), np.full(n, z)]) for s, t, z in ((0.5, 0.4, -1.1 * radius), (0.7, 0.8, -0.3 * radius), (0.85, 0.85, seat - 0.5 * plate))])
    seal = slab(plate_outline(kind, 0.99 * half_x, 0.99 * half_y, n), seat, seat + 0.004)
    rise = seat + 0.004 + plate
    high = rise + float(rng.uniform(1.2, 2.0)) * radius + 0.02
    hood = lofted([np.column_stack([oval(half_x * s, half_y * t, n), np.full(n, z)]) for s, t, z in ((0.85, 0.85, rise - 0.3 * plate), (0.75, 0.8, rise + 0.4 * (high - rise)), (0.4, 0.5, rise + 0.75 * (high - rise)), (0.3, 0.45, high))])
    slim = 0.005 + 0.08 * radius
    parts = [
        metal(merge([ended(dn, hand, length, [(neck, back), (1.08 * radius + 0.004, 0.3 * length), (1.08 * radius + 0.004, 0.7 * length), (neck, length - back)], "flanged"), moved(merge([tray, collar]), at(x))])),
        Part(moved(seal, at(x)), "gasket", "rubber", BODY, "Pipe assembly"),
        trim(merge([moved(lid, at(0, 0, 0.004)), hood]), "valve bonnet", x, "valve"), *put([bolts], at(x)),
    ]  # fmt: skip
    if rng.random() < 0.65:
        parts += put([shaft(-0.01, 0.05 + radius, slim, hand, rng), hand_wheel(0.04 + 1.2 * radius, 0.012, hand, rng, ("spoked", "spoked", "lobed", "dished", "disc"))], at(x, 0, high))
        parts.append(trim(cylinder(0.8 * slim, high + 0.04 + radius, high + 0.08 + 1.3 * radius, 10), "position indicator", x))
    else:
        parts += put(LINEAR[str(rng.choice(["piston", "diaphragm"]))](radius, high - 0.002, hand, rng), at(x))
    return Model(parts, length, kind="diaphragm valve")


def _aseptic(dn: int, hand: Hand, rng: Rng) -> Model:
    """An aseptic or plastic diaphragm valve: forged block body with square joint, clamp, weld or socket ends (EN 13397)."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["clamp", "butt", "socket"]))
    stub = 0.025 if ends == "clamp" else 0.0
    core = 0.06 + 3.2 * radius
    length, x = core + 2 * stub, core / 2 + stub
    half, n = 1.55 * radius + 0.010, max(16, hand.round(1.5 * radius))
    if ends == "clamp":
        arms = [ferrule(dn, stub, x, hand, True), ferrule(dn, x, length - stub, hand, False)]
    else:
        end = radius if ends == "butt" else 1.3 * radius
        bore = PIPES[dn].bore if hand.hollow else 0.0
        arms = [along("x", ring(bore, end, 0.0, length, n))]
    seat = 1.1 * radius + 0.006
    outline = rounded_rectangle(2 * half, 2 * half, float(rng.uniform(0.15, 0.6)) * half, 4)
    block = [slab(outline, seat - 0.008 - 0.1 * radius, seat)]
    bottom = [np.column_stack([outline * s, np.full(len(outline), z)]) for s, z in ((0.45, -1.05 * radius), (0.75, -0.2 * radius), (0.9, seat - 0.007 - 0.1 * radius))]
    block.append(lofted(bottom))
    seal = slab(outline * 0.995, seat, seat + 0.003)
    low = seat + 0.003
    lid = [slab(outline, low, low + 0.008 + 0.12 * radius)]
    bolts = bolts_on(outline, 4, seat - 0.008, low + 0.009 + 0.12 * radius, 0.005 + 0.04 * radius)
    step = low + 0.007 + 0.12 * radius
    high = step + float(rng.uniform(1.0, 2.2)) * radius + 0.015
    if rng.random() < 0.5:
        lid.append(turned([(0.95 * half, step), (0.9 * half, 0.5 * (step + high)), (0.55 * half, high)], n))
    else:
        lid.append(slab(outline * 0.85, step, high - 0.004))
        lid.append(cylinder(0.6 * half, high - 0.005, high, n))
    parts = [
        metal(merge([*arms, *(moved(s, at(x)) for s in block)]), 0.0, "clamp"),
        Part(moved(seal, at(x)), "gasket", "rubber", BODY, "Pipe assembly"),
        trim(merge(lid), "valve bonnet", x), *put([bolts], at(x)),
    ]  # fmt: skip
    if ends == "clamp":
        parts += [Part(ferrule(dn, 0.0, stub - 0.001, hand, False), "coupling", "pipe", "", "Pipe assembly"), Part(ferrule(dn, length - stub + 0.001, length, hand, True), "coupling", "pipe", "", "Pipe assembly"), clamp_ring(dn, stub, hand, rng), clamp_ring(dn, length - stub, hand, rng)]
    if rng.random() < 0.65:
        size = 0.85 * half + 0.008
        parts += put([shaft(-0.004, 0.02 + radius, 0.15 * half, hand), hand_wheel(size, 0.001, hand, rng, ("lobed", "lobed", "spoked", "dished"))], at(x, 0, high))
        sight = merge([cylinder(0.1 * half, high + 0.02 + radius, high + 0.03 + 1.4 * radius, 10)])
        parts.append(trim(sight, "position indicator", x, "safety"))
    else:
        parts += quarter_turn(x, high, radius, hand, rng, ("vertical",)) if rng.random() < 0.5 else put(LINEAR["piston"](radius, high - 0.001, hand, rng), at(x))
    return Model(parts, round(length, 6), "welded", "diaphragm valve")


def _pinch_open(dn: int, hand: Hand, rng: Rng) -> Model:
    """An open-frame pinch valve: a rubber sleeve between two flanges, squeezed by bars in an open yoke, wheel or cylinder."""
    radius = PIPES[dn].radius
    size, thick = FLANGES[dn], plate_thickness(dn)
    length = 0.12 + 4.4 * radius
    x, n = length / 2, max(16, hand.round(radius))
    sleeve_out, bore = 1.25 * radius + 0.006, PIPES[dn].bore
    squeeze = float(rng.uniform(0.3, 1.0))
    inner = bore if hand.hollow else 0.0
    flat = float(squeeze)
    ends = [along("x", ring(inner, size.outer / 2, z, z + thick, n)) for z in (0.0, length - thick)]
    stations = [(thick, 1.0), (0.25 * length, 1.0), (0.42 * length, flat), (0.58 * length, flat), (0.75 * length, 1.0), (length - thick, 1.0)]
    wide = [1 + 0.45 * (1 - s) for _, s in stations]
    tube_ = lofted([np.column_stack([np.full(n, z), sleeve_out * w * np.cos(t), sleeve_out * s * np.sin(t)]) for (z, s), w in zip(stations, wide, strict=True) for t in [np.arange(n) * 2 * np.pi / n]])
    bar = 0.05 * length + 0.01
    reach = 1.7 * sleeve_out + 0.01
    up = max(sleeve_out + 0.06, 0.5 * size.outer + 0.02)
    bars = [box((2 * bar, 2 * reach * 0.8, 0.6 * bar), (0, 0, sg * (sleeve_out * flat + 0.3 * bar))) for sg in (-1, 1)]
    if rng.random() < 0.5:
        posts = [cylinder(0.008 + 0.05 * radius, -sleeve_out - 0.7 * bar, up, 10) for _ in (0, 1)]
        posts = [moved(p, at(0, s * reach)) for p, s in zip(posts, (-1, 1), strict=True)]
        beams = [box((2 * bar, 2.3 * reach, 0.02), (0, 0, z)) for z in (up, -sleeve_out * 1.0 - 0.7 * bar)]
    else:
        posts = [box((1.6 * bar, 0.014, up + sleeve_out + 0.7 * bar), (0, s * reach, (up - sleeve_out - 0.7 * bar) / 2)) for s in (-1, 1)]
        beams = [box((1.8 * bar, 2.1 * reach, 0.016), (0, 0, z)) for z in (up, -sleeve_out - 0.7 * bar)]
    ties = [rod((0.5 * thick, s * 0.46 * size.outer, 0.1 * size.outer), (length - 0.5 * thick, s * 0.46 * size.outer, 0.1 * size.outer), 0.008, 8) for s in (-1, 1)] if rng.random() < 0.6 else []
    slim = 0.007 + 0.06 * radius
    low = sleeve_out * flat + 0.5 * bar
    parts = [
        metal(merge([*ends, *ties])), trim(tube_, "valve body", 0.0, "rubber"), trim(merge(bars), "valve disc", x),
        trim(merge([*posts, *beams]), "yoke", x, "steel"),
    ]  # fmt: skip
    if rng.random() < 0.6:
        parts += put([shaft(low, up + 0.08 + radius, slim, hand, rng), hand_wheel(0.06 + 1.2 * radius, up + 0.012, hand, rng)], at(x))
    else:
        kind = str(rng.choice(["piston", "ram", "turning"]))
        parts += put([shaft(low, up + 0.012, slim, hand), *LINEAR[kind](radius, up + 0.009, hand, rng)], at(x))
    return Model(parts, round(length, 6), kind="pinch valve")


def _pinch_closed(dn: int, hand: Hand, rng: Rng) -> Model:
    """An enclosed pinch valve: two cast halves bolted along the middle, air-operated, or with a wheel and a bonnet above."""
    radius = PIPES[dn].radius
    length = 0.08 + 3.6 * radius
    neck, back = neck_of(dn)
    x, big = length / 2, 1.55 * radius + 0.012
    n = max(16, hand.round(big))
    kind = int(rng.integers(3))
    if kind == 0:
        middle = [(neck, back), (big, back + 0.12 * length), (big, length - back - 0.12 * length), (neck, length - back)]
    elif kind == 1:
        middle = [(neck, back), *[(r, float(z)) for r, z in [(big * (0.8 + 0.2 * np.sin(np.pi * s)), back + s * (length - 2 * back)) for s in np.linspace(0.08, 0.92, 9)]], (neck, length - back)]
    else:
        middle = [(neck, back), *[(r, z) for z, r in sorted((z, r) for r, z in waves(back + 0.01, length - back - 0.01, 0.92 * big, big, 4))], (neck, length - back)]
    body = [ended(dn, hand, length, middle, "flanged")]
    flange_ = slab(rounded_rectangle(length - 2 * back - 0.012, 2 * big + 0.05, 0.02, 3), -0.010, 0.010) if rng.random() < 0.7 else None
    parts: list[Part] = []
    if flange_ is not None:
        body.append(moved(flange_, at(x)))
        one = merge([cylinder(0.005, -0.016, 0.016, 8), hexagon(0.016, 0.010, 0.018), hexagon(0.016, -0.018, -0.010)])
        spots = np.linspace(-0.4, 0.4, int(rng.integers(3, 6))) * (length - 2 * back - 0.012)
        parts.append(bolted(merge([moved(one, at(x + float(p), s * (big + 0.014))) for p in spots for s in (-1, 1)])))
    high = big + 0.02
    if rng.random() < 0.45:
        body.append(moved(merge([cylinder(0.016, 0.9 * big, high, 12), hexagon(0.026, high, high + 0.014), cylinder(0.007, high + 0.01, high + 0.04, 8)]), at(x)))
        parts.insert(0, metal(merge(body)))
    else:
        seat = max(high, 0.5 * FLANGES[dn].outer)
        half, tall, slim = 0.55 * big, 0.05 + 0.9 * radius, 0.006 + 0.06 * radius
        body.append(moved(merge([cylinder(half, 0.7 * big, seat, n), cylinder(1.4 * half, seat - 0.012, seat, n)]), at(x)))
        parts.insert(0, metal(merge(body)))
        if rng.random() < 0.6:
            parts += put([yoke_arms(1.3 * half, tall, hand, rng), shaft(-0.02, tall + 0.06 + 0.5 * radius, slim, hand, rng), hand_wheel(0.05 + 1.2 * radius, tall + 0.002, hand, rng)], at(x, 0, seat))
        else:
            parts += put(LINEAR[str(rng.choice(["piston", "ram"]))](radius, seat, hand, rng), at(x))
    if hand.hollow:
        bore = PIPES[dn].bore
        liner = about_x(part_ring([(0.86 * bore, 0.0), (0.985 * bore, 0.0), (0.985 * bore, length), (0.86 * bore, length)], n))
        parts.append(trim(liner, "valve body", 0.0, "rubber"))
    return Model(parts, round(length, 6), kind="pinch valve")


def _tap(dn: int, hand: Hand, rng: Rng) -> Model:
    """A bib cock on a pipe's end: a turned body, a downward spout with a hose thread, a lever, cross, tee or wing."""
    radius = PIPES[dn].radius
    reach, big, n = 0.05 + 2.2 * radius, 1.2 * radius + 0.003, max(12, hand.round(radius))
    nut = along("x", hexagon(2.5 * radius + 0.004, 0.0, 0.014))
    tube_ = along("x", turned([(1.0 * radius, 0.0), (0.9 * radius, 0.5 * reach), (big, 0.55 * reach), (big, 0.8 * reach), (0.7 * radius, reach)], n))
    drop = float(rng.uniform(1.6, 3.0)) * radius + 0.01
    path = [(0.7 * reach, 0, 0), (reach, 0, -0.1 * radius), (reach + 0.7 * radius, 0, -0.8 * radius), (reach + 0.8 * radius, 0, -drop)]
    from_ = [rod(path[k], path[k + 1], 0.68 * radius, n) for k in range(3)]
    lip = moved(turned([(0.85 * radius, -drop - 0.012), (0.85 * radius, -drop + 0.004), (0.68 * radius, -drop + 0.008)], n), at(reach + 0.8 * radius))
    x = 0.67 * reach
    high = big + float(rng.uniform(0.3, 1.4)) * radius + 0.006
    parts = [metal(merge([nut, tube_, *from_, lip, moved(cylinder(0.75 * radius, 0.0, high, n), at(x))]))]
    cap = merge([hexagon(1.8 * radius, high - 0.004, high + 0.4 * radius), turned([(0.7 * radius, high + 0.4 * radius), (0.4 * radius, high + 0.9 * radius)], n)])
    parts.append(trim(cap, "valve bonnet", x, "valve"))
    top = high + 0.9 * radius
    rest = [shaft(-0.004, 0.012, 0.2 * radius + 0.001, hand)]
    if rng.random() < 0.5:
        rest.append(hand_lever(0.04 + 2.0 * radius, 0.002, hand, rng, ("wing", "sheet", "tee", "loop", "bar")))
    else:
        rest.append(hand_wheel(0.016 + 0.9 * radius, 0.003, hand, rng, ("cross", "lobed", "star", "spoked", "disc")))
    return Model([*parts, *put(rest, at(x, 0, top))], kind="tap")


_MID = tuple(dn for dn in SIZES if dn <= 200)
_BIG = tuple(dn for dn in SIZES if dn >= 50)
_SMALL = tuple(dn for dn in SIZES if dn <= 100)


def _family(name: str, build: object, sizes: tuple[int, ...], place: str = "inline", weight: float = 1.0) -> Family:
    return Family(name, place, "Valve assembly", "valve", build, sizes, weight=weight)  # type: ignore[arg-type]


LININGS: tuple[Family, ...] = (
    _family("plug valve/lubricated", _lubricated, _MID),
    _family("plug valve/eccentric", _eccentric, _BIG),
    _family("plug valve/multi-port", _multi_plug, _MID),
    _family("diaphragm valve/straight through", _straight, _MID),
    _family("diaphragm valve/aseptic", _aseptic, _SMALL, weight=1.5),
    _family("pinch valve/open frame", _pinch_open, tuple(dn for dn in SIZES if dn >= 25)),
    _family("pinch valve/enclosed", _pinch_closed, tuple(dn for dn in SIZES if dn >= 25)),
    _family("bib tap/spout", _tap, tuple(dn for dn in SIZES if dn <= 50), "end"),
)
