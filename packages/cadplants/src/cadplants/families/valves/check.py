"""Further check valves: along x from 0 in a line, or bolted on the last flange of one."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.parts import (
    BIG,
    MID,
    SMALL,
    body,
    bolting,
    bonnet,
    cage,
    cover,
    hub_radius,
    laid,
    other,
    piece,
    screwed,
    spring,
    thread_nut,
)
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body, valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import (
    along,
    around,
    ball,
    box,
    cylinder,
    hexagon,
    lofted,
    ring,
    rod,
    turned,
)
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["CHECKS"]


def _weighted(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A swing check valve (EN 12334) with its shaft led out to a lever: cast, disc or bar weights on it."""
    length, r = FACE_TO_FACE["check"][dn], PIPES[dn].radius
    neck, thick = hub_radius(dn), plate_thickness(dn)
    bulge = max(1.15 * neck, 1.35 * r + 0.008)
    middle = [(bulge, thick + 0.2 * length), (bulge, length - thick - 0.12 * length)]
    x, n = 0.48 * length, style.round(bulge)
    seat = max(1.25 * bulge, 0.48 * FLANGES[dn].outer)
    throat = float(rng.uniform(0.8, 0.95)) * bulge
    parts = [
        body(flanged_body(dn, style, length, middle), moved(cylinder(throat, 0.3 * bulge, seat - 0.004, n), at(x))),
        *placed(
            cover(
                1.2 * throat + 0.006, seat, 0.01 + 0.08 * r, 8, style, bool(rng.integers(2)), rng.choice([0, 0.3]) * r
            ),
            at(x),
        ),
    ]
    side = float(rng.choice([-1, 1]))
    px, pz, reach = x - 0.45 * throat, 0.72 * seat, 1.25 * throat + 0.02
    boss = along("y" if side > 0 else "-y", cylinder(0.2 * throat + 0.006, 0.5 * throat, reach, 12), px, 0, pz)
    pin = rod((px, side * 0.4 * throat, pz), (px, side * (reach + 0.035 + 0.1 * r), pz), 0.005 + 0.09 * r, 10)
    gland = along("y" if side > 0 else "-y", hexagon(0.3 * throat + 0.012, reach, reach + 0.012), px, 0, pz)
    parts += [body(boss), piece("valve stem", pin), piece("gland", gland)]
    far, y = 0.07 + 2.6 * r, side * (reach + 0.02 + 0.05 * r)
    tilt = float(rng.uniform(-0.7, 0.5))
    pose = at(px, y, pz) @ spun("y", tilt)
    half = 0.006 + 0.08 * r
    arm = merge([box((far, 0.4 * half + 0.004, 2 * half), (far / 2 - half, 0, 0)),
                 along("y", cylinder(2 * half, -0.9 * half, 0.9 * half, 12))])  # fmt: skip
    parts.append(piece("lever", moved(arm, pose), color="handle", bundle=""))
    parts += placed(_counter(far, r, half, style, rng), pose)
    if style.hollow:
        disc = moved(cylinder(0.93 * PIPES[dn].bore, -0.004, 0.004 + 0.03 * r, n), at(px) @ spun("y", np.pi / 2))
        parts.append(piece("valve disc", disc))
    return Model(parts, length, kind="check valve")


def _counter(far: float, r: float, half: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What loads a lever along x: a cast weight, discs, or two bars."""
    kind = rng.random()
    size = 0.02 + 0.5 * r
    if kind < 0.4:
        return [piece("lever", box((1.3 * size, size, 1.6 * size), (0.85 * far, 0, 0)), color="handle", bundle="")]
    discs = [along("y", cylinder(size, -0.012 - 0.2 * r, 0.012 + 0.2 * r, style.round(size)), 0.85 * far)]
    if kind < 0.6:
        discs.append(along("y", cylinder(0.7 * size, -0.02 - 0.4 * r, 0.02 + 0.4 * r, style.round(size)), 0.85 * far))
    elif kind < 0.8:
        discs = [box((0.5 * size, 0.8 * size, 2.4 * size), (k * far, 0, 0)) for k in (0.6, 0.95)]
    return [piece("lever", *discs, color="handle", bundle="")]


def _tilting(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tilting-disc check valve (API 594 type): two halves in a slanting joint, short body, inspection cap aside."""
    length, r = FACE_TO_FACE["gate"][dn] * float(rng.uniform(1.0, 1.3)), PIPES[dn].radius
    neck, n = hub_radius(dn), style.round(1.5 * r)
    bulge = 1.3 * neck + 0.004
    thick = plate_thickness(dn)
    middle = [(neck, thick + 0.05 * length), (bulge, 0.42 * length), (bulge, 0.58 * length)]
    middle.append((neck, length - thick - 0.05 * length))
    tilt = float(rng.uniform(0.15, 0.35))
    collar, plate = 1.0 * bulge + 0.018 + 0.1 * r, 0.008 + 0.05 * r
    pose = at(length / 2) @ spun("y", np.pi / 2 + tilt)
    joint = [body(moved(cylinder(collar, z, z + plate, n), pose)) for z in (-plate, 0.0)]
    bolts = bolt_circle(max(6, 2 * int(collar / 0.03)), collar - 0.008, 0.007 + 0.02 * r, -plate, plate)
    parts = [body(flanged_body(dn, style, length, middle)), *joint, bolting(moved(bolts, pose))]
    boss = along("y", cylinder(0.3 * r + 0.006, 0.5 * bulge, collar + 0.012, 12), 0.5 * length + 0.2 * r, 0, 0.3 * r)
    cap = along("y", hexagon(0.6 * r + 0.02, collar + 0.012, collar + 0.022), 0.5 * length + 0.2 * r, 0, 0.3 * r)
    parts += [body(boss), bonnet(cap)]
    if rng.random() < 0.5:
        finger = rod((0, 0, 0), (0.6 * r + 0.02, 0, 0.5 * r), 0.004, 6)
        parts.append(piece("position indicator", moved(finger, at(0.5 * length + 0.2 * r, collar + 0.02, 0.3 * r))))
    if style.hollow:
        shape = [
            (0.4 * r, -0.06 * r),
            (0.93 * PIPES[dn].bore, -0.01 * r),
            (0.93 * PIPES[dn].bore, 0.03 * r),
            (0.3 * r, 0.2 * r),
        ]
        parts.append(piece("valve disc", moved(turned(shape, n), pose)))
    return Model(parts, round(length, 6), kind="check valve")


def _dual_plate(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dual-plate check valve (API 594): lugs, or short with flanges; two half discs, pins, springs, plugs."""
    size, bore, r = FLANGES[dn], PIPES[dn].bore, PIPES[dn].radius
    length = {True: 1.0, False: 1.5}[dn < 100] * 0.6 * PIPES[dn].outer + 0.025
    lugged = bool(rng.random() < 0.6)
    outer, n = 0.49 * (size.circle - size.bolt), style.round(size.outer / 2)
    if lugged:
        low, high = (0.0, length) if rng.random() < 0.5 else (0.2 * length, 0.8 * length)
        lug = ring(0.52 * size.bolt, 1.05 * size.bolt, low, high, 10)
        shell = merge(
            [ring(bore, outer, 0.0, length, n), around(lug, size.n_bolts, size.circle / 2, np.pi / size.n_bolts)]
        )
        solid = about_x(shell)
    else:
        solid = flanged_body(dn, style, length, [(1.15 * hub_radius(dn), 0.5 * length)])
    parts = [body(solid)]
    edge = outer if lugged else 1.1 * hub_radius(dn)
    for x in (0.4 * length, 0.62 * length):
        plug = along("z", hexagon(0.12 * r + 0.012, 0.96 * edge, edge + 0.01), x)
        parts.append(piece("valve bonnet", plug))
    if rng.random() < 0.4 and dn >= 80:
        eye = along("y", ring(0.008, 0.014, -0.004, 0.004, 12), 0.5 * length, 0, edge + 0.012)
        parts.append(Part(eye, "lifting lug", "fastener", "valve body", "Tank", True))
    if style.hollow:
        t = np.linspace(0.06, np.pi - 0.06, 10)
        half = 0.96 * bore * np.column_stack([np.cos(t), np.sin(t)])
        swing = float(rng.choice([0.0, 0.3, 1.1]))
        for k in (0, 1):
            plate = moved(extrude(half, 0.0, 0.004 + 0.04 * r), spun("x", swing) @ at(0, 0.01 * r))
            parts.append(piece("valve disc", along("x", moved(plate, spun("z", k * np.pi)), 0.4 * length)))
        pin = cylinder(0.05 * bore + 0.002, -bore - 0.002, bore + 0.002, 8)
        parts.append(piece("valve stem", moved(pin, at(0.4 * length) @ spun("z", 0.0))))
    return Model(parts, round(length, 6), "wafer" if lugged else "flanged", "check valve")


def _piston(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A forged piston check valve (API 602): a straight round chest with a bolted or welded flat cover."""
    r = PIPES[dn].radius
    flanged = bool(rng.random() < 0.5)
    length = FACE_TO_FACE["check"][dn] if flanged else 4.2 * r + 0.045
    x, chest = length / 2, 1.35 * r + 0.008
    seat = max(2.0 * r + 0.02, 0.5 * FLANGES[dn].outer + 0.006 if flanged else 0.0)
    n = style.round(chest)
    if flanged:
        run = flanged_body(dn, style, length, [(hub_radius(dn), 0.5 * length)])
    else:
        end = [
            (1.5 * r + 0.003, 0.0),
            (1.5 * r + 0.003, 0.3 * length),
            (1.2 * r, 0.36 * length),
            (1.2 * r, 0.64 * length),
        ]
        end += [(1.5 * r + 0.003, 0.7 * length), (1.5 * r + 0.003, length)]
        run = along("x", turned(end, n, bore=bore_of(dn, style)))
    tower = moved(turned([(0.8 * chest, -1.1 * chest), (chest, -0.7 * chest), (chest, seat - 0.003)], n), at(x))
    parts = [body(run, tower)]
    kind = int(rng.integers(3))
    if kind < 2:
        parts += placed(
            cover(1.25 * chest + 0.008, seat, 0.008 + 0.1 * r, 4 + 2 * int(rng.integers(2)), style, kind == 1), at(x)
        )
        top = seat + 0.008 + 0.1 * r
    else:
        top = seat + 0.6 * chest
        parts.append(bonnet(moved(merge([cylinder(1.05 * chest, seat - 0.003, seat + 0.01, n),
                                         hexagon(1.7 * chest, seat, top)]), at(x))))  # fmt: skip
    if rng.random() < 0.3:
        parts.append(piece("valve stem", moved(cylinder(0.004 + 0.05 * r, top - 0.002, top + 0.02, 8), at(x))))
    return Model(parts, round(length, 6), "flanged" if flanged else "welded", "check valve")


def _nozzle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An axial nozzle check valve: a venturi body, ribs before a torpedo, a sliding disc on a guide with its spring."""
    r, bore = PIPES[dn].radius, PIPES[dn].bore
    length = float(rng.uniform(1.8, 2.6)) * PIPES[dn].outer + 0.06
    thick, neck = plate_thickness(dn), hub_radius(dn)
    wide = max(1.35 * r, 1.12 * neck)
    middle = [
        (neck, thick + 0.1 * length),
        (wide, 0.45 * length),
        (wide, 0.6 * length),
        (neck, length - thick - 0.1 * length),
    ]
    parts = [body(flanged_body(dn, style, length, middle))]
    if rng.random() < 0.5:
        ribs = around(box((0.3 * wide, 0.02 + 0.03 * r, 0.5 * length), (0.97 * wide, 0, 0.5 * length)), 6)
        parts.append(body(along("x", ribs)))
    if style.hollow:
        n = style.round(0.6 * r)
        torpedo = turned([(0.08 * r, 0.15 * length), (0.45 * bore, 0.35 * length), (0.5 * bore, 0.45 * length)], n)
        vanes = around(
            box((0.6 * bore, 0.05 * r, 0.2 * length), (0.72 * bore, 0, 0.33 * length)), int(rng.integers(3, 6))
        )
        plate = turned([(0.88 * bore, 0.5 * length), (0.88 * bore, 0.53 * length), (0.2 * bore, 0.62 * length)], n)
        guide = cylinder(0.12 * bore, 0.4 * length, 0.78 * length, 10)
        parts += [
            body(along("x", torpedo), along("x", vanes)),
            piece("valve disc", along("x", plate)),
            piece("valve stem", along("x", guide)),
        ]
    return Model(parts, round(length, 6), kind="check valve")


def _disc(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A stainless disc check valve between flanges (EN 558 series 49): short ring, cams, disc, a cross behind."""
    size, bore = FLANGES[dn], PIPES[dn].bore
    length = 0.012 + 0.3 * PIPES[dn].outer
    edge, n = 0.49 * (size.circle - size.bolt), style.round(size.outer / 2)
    outer = max(1.12 * PIPES[dn].radius, float(rng.uniform(0.72, 0.9)) * edge)
    shell = [ring(0.9 * bore, outer, 0.0, 0.35 * length, n), ring(1.0 * bore, 0.5 * (outer + bore), 0.0, length, n)]
    shell.append(ring(1.0 * bore, outer, 0.85 * length, length, n))
    count = int(rng.choice([3, 4]))
    cam = box((1.05 * (edge - outer) + 0.004, 0.2 * outer, 0.25 * length), ((edge - outer) / 2, 0, 0.14 * length))
    shell.append(around(cam, count, outer - 0.002, np.pi / count))
    parts = [body(along("x", merge(shell)))]
    if rng.random() < 0.4:
        stop = rod((0.3 * length, 0, outer), (0.3 * length, 0, edge + 0.012), 0.003, 6)
        parts.append(piece("valve stem", merge([stop, moved(ball(0.006, 8), at(0.3 * length, 0, edge + 0.012))])))
    plate = turned([(0.95 * bore, 0.36 * length), (0.95 * bore, 0.44 * length), (0.2 * bore, 0.5 * length)], n)
    cross = [
        box((2.1 * bore, 0.14 * bore, 0.1 * length), (0, 0, 0.9 * length)),
        box((0.14 * bore, 2.1 * bore, 0.1 * length), (0, 0, 0.9 * length)),
    ]
    coil = spring(0.25 * bore, 0.0012, 0.46 * length, 0.87 * length, 3, style)
    parts += [piece("valve disc", along("x", plate)), piece("valve stem", along("x", merge([*cross, coil])))]
    return Model(parts, round(length, 6), "wafer", "check valve")


def _foot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A foot valve at a suction pipe's end: body with a guided disc, strainer basket of bars, sheet or cast slots."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    wide, tall = float(rng.uniform(1.4, 1.9)) * r + 0.008, float(rng.uniform(1.2, 2.2)) * r + 0.02
    start = thick + 0.02 + 0.3 * r
    n = style.round(wide)
    shell = turned([(1.05 * r, thick + 0.005), (wide, start + 0.4 * r), (wide, start + 0.4 * r + tall)], n)
    high = start + 0.4 * r + tall
    parts = [body(disc_flange(dn, style, start), shell)]
    lip = 1.12 * wide
    parts.append(body(cylinder(lip, high - 0.012, high, n)))
    deep, kind = float(rng.uniform(1.0, 2.6)) * wide, int(rng.integers(3))
    collar = cylinder(lip, high, high + 0.01, n)
    if kind == 0:
        basket = merge([collar, cage(0.95 * wide, high + 0.005, high + deep, 16, 4, style)])
    elif kind == 1:
        rows = [ring(0.75 * wide, 0.92 * wide, z, z + 0.05 * deep, n) for z in high + np.linspace(0.1, 0.9, 7) * deep]
        posts = around(box((0.1 * wide, 0.12 * wide, 0.95 * deep), (0, 0, high + 0.48 * deep)), 4, 0.83 * wide)
        basket = merge([collar, *rows, posts, cylinder(0.92 * wide, high + 0.95 * deep, high + deep, n)])
    else:
        cone = turned(
            [(0.95 * wide, high + 0.005), (0.9 * wide, high + 0.3 * deep), (0.5 * wide, high + 0.7 * deep)], n
        )
        ribs = around(box((0.1 * wide, 0.06 * wide, 0.3 * deep), (0.92 * wide, 0, high + 0.16 * deep)), 12)
        basket = merge([collar, cone, ribs])
    parts.append(other("Pipe assembly", "strainer", "trim", basket, own=True))
    if rng.random() < 0.6:
        parts.append(bolting(bolt_circle(6, 1.04 * wide, 0.006, high - 0.012, high + 0.01)))
    if rng.random() < 0.3:
        arm = rod((0.8 * wide, 0, start + 0.4 * r), (1.9 * wide, 0, start + 0.2 * r), 0.006, 8)
        parts.append(piece("lever", arm, color="handle", bundle=""))
    return Model(laid(parts), kind="foot valve")


def _flap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flap valve at an outfall (EN 12334 practice): a slanting round or square flap, hinge, arms, weight."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    tilt, reach = float(rng.uniform(0.05, 0.3)), 0.02 + 0.5 * r
    n, wide = style.round(1.3 * r), 1.25 * r + 0.01
    neck = disc_flange(dn, style, thick + 0.7 * reach)
    top = thick + reach
    pose = at(0, 0, top) @ spun("x", tilt)
    round_ = bool(rng.integers(2))
    plate = 0.008 + 0.04 * r
    seat = cylinder(wide, -plate, 0.0, n) if round_ else square_plate(wide, -plate, 0.0)
    upper = np.column_stack([circle(1.1 * r, 16), np.zeros(16)]) @ pose[:3, :3].T + pose[:3, 3]
    mid = lofted([np.column_stack([circle(1.05 * r, 16), np.full(16, thick)]), upper])
    parts = [body(neck, mid, moved(seat, pose))]
    lid = cylinder(0.97 * wide, 0.0, plate, n) if round_ else square_plate(0.97 * wide, 0.0, plate)
    extra = [box((0.12 * wide, 1.7 * wide, 0.6 * plate), (s * 0.4 * wide, 0.1 * wide, 1.2 * plate)) for s in (-1, 1)]
    if rng.random() < 0.5:
        extra.append(turned([(0.6 * wide, 0.8 * plate), (0.3 * wide, 2.2 * plate)], n))
    parts.append(piece("valve disc", moved(merge([lid, *extra]), pose), color="valve"))
    high = 1.12 * wide
    ears = [box((0.1 * wide, 0.35 * wide, 3.4 * plate), (s * 0.6 * wide, 0.98 * wide, 0.6 * plate)) for s in (-1, 1)]
    arms = [box((0.12 * wide, 0.4 * wide, 0.8 * plate), (s * 0.4 * wide, 0.96 * wide, 1.2 * plate)) for s in (-1, 1)]
    pin = along("x", cylinder(0.45 * plate, -0.75 * wide, 0.75 * wide, 8), 0, high - 0.02 * wide, 1.2 * plate)
    parts += [
        body(moved(merge(ears), pose)),
        piece("valve stem", moved(pin, pose)),
        piece("lever", moved(merge(arms), pose), color="valve"),
    ]
    if rng.random() < 0.35:
        load = rod((0, 0.4 * wide, plate), (0, 1.5 * wide, 3.0 * wide * 0.5), 0.5 * plate, 8)
        bob = moved(ball(0.22 * wide, 12), at(0, 1.5 * wide, 1.5 * wide))
        parts.append(piece("lever", moved(merge([load, bob]), pose), color="handle", bundle=""))
    return Model(laid(parts), kind="flap valve")


def square_plate(half: float, low: float, high: float) -> Solid:
    """A square plate with round corners about z [m]."""
    return extrude(rounded_rectangle(2 * half, 2 * half, 0.15 * half, 3), low, high)


def _duckbill(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A duckbill check valve: a rubber cuff with its own flange or clamped on a spigot, flattening to a slit."""
    r, thick = PIPES[dn].radius, plate_thickness(dn)
    long, k = float(rng.uniform(2.5, 4.5)) * r + 0.03, 24
    ring_ = circle(1.0, k)
    start = 0.03 + 0.5 * r
    loops = []
    for t in np.linspace(0, 1, 9):
        wide, thin = 1.12 * r * (1 + 0.42 * t**1.5), 1.12 * r * (1 - t) ** 0.8 + 0.008 + 0.03 * r
        loops.append(np.column_stack([ring_ * (wide, thin), np.full(k, thick + start + t * long)]))
    cuff = turned([(1.12 * r + 0.004, thick), (1.12 * r + 0.004, thick + start)], style.round(r))
    bill = lofted(loops)
    fins = [box((0.16 * r, 0.3 * r, 0.6 * long), (0, s * 0.5 * r, thick + start + 0.3 * long)) for s in (-1, 1)]
    rubber = [cuff, bill, *(fins if rng.random() < 0.5 else [])]
    parts = [body(disc_flange(dn, style, thick + 0.3 * start)), piece("valve disc", *rubber, color="rubber")]
    for z in (0.4, 0.75)[: int(rng.integers(1, 3))]:
        z = thick + z * start
        band = merge([ring(1.12 * r + 0.0035, 1.12 * r + 0.006, z - 0.007, z + 0.007, style.round(r)),
                      box((0.02, 0.03, 0.012), (1.12 * r + 0.012, 0, z))])  # fmt: skip
        parts.append(other("Connection assembly", "clamp", "clamp", band, own=True))
    return Model(laid(parts), kind="duckbill valve")


def _ball_y(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded ball check valve in Y pattern (sewage type): slanting bolted or screwed cap, rubber ball."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.4, 5.4)) * r + 0.035
    core = [(1.05 * r, 0.15 * length), (1.35 * r, 0.35 * length), (1.35 * r, 0.65 * length), (1.05 * r, 0.85 * length)]
    # Flow pushes the ball off its seat into the branch, which leans downstream therefore.
    tilt = -float(rng.uniform(-0.9, -0.55))
    pose = at(0.4 * length) @ spun("y", tilt)
    wide, reach, n = 1.5 * r + 0.003, 2.7 * r + 0.008, style.round(1.5 * r)
    arm = turned([(0.9 * wide, 0.0), (wide, 0.4 * reach), (wide, reach - 0.003)], n)
    parts = [body(screwed(dn, style, length, core), moved(arm, pose))]
    if rng.random() < 0.6:
        parts += placed(
            cover(1.25 * wide + 0.006, reach, 0.007 + 0.05 * r, 4, style, bool(rng.integers(2)), 0.3 * r), pose
        )
    else:
        cap = merge([cylinder(1.12 * wide, reach - 0.01, reach + 0.3 * r, n), hexagon(wide, reach, reach + 0.7 * r)])
        parts.append(bonnet(moved(cap, pose)))
    if style.hollow:
        parts.append(piece("valve ball", moved(ball(0.95 * r, n), at(0.45 * length)), color="rubber"))
    return Model(parts, round(length, 6), "welded", "check valve")


def _plastic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic non-return valve (EN ISO 16137): a clear or grey cylinder between two ribbed union nuts."""
    r = PIPES[dn].radius
    length = float(rng.uniform(4.5, 6.5)) * r + 0.03
    n, wide = style.round(1.6 * r), 1.5 * r + 0.003
    shell = [
        ring(0.9 * r if style.hollow else 0.0, 1.22 * r, 0.0, length, n),
        cylinder(wide, 0.3 * length, 0.7 * length, n),
    ]
    nuts = []
    ribs = int(rng.choice([0, 12, 16]))
    for low in (0.1 * length, 0.68 * length):
        nuts.append(along("x", thread_nut(3.1 * r + 0.006, low, low + 0.22 * length, style, ribs)))
    rings = [cylinder(1.1 * wide, 0.48 * length, 0.52 * length, n)] if rng.random() < 0.5 else []
    parts = [
        body(along("x", merge([*shell, *rings]))),
        *(other("Pipe assembly", "union", "valve", nut, own=True) for nut in nuts),
    ]
    return Model(parts, round(length, 6), "welded", "check valve")


_FOUR = tuple(dn for dn in SIZES if FLANGES[dn].n_bolts == 4)

CHECKS: tuple[Family, ...] = (
    valve_family("check valve/weighted lever", _weighted, BIG, weight=1.5),
    valve_family("check valve/tilting disc", _tilting, BIG),
    valve_family("check valve/dual plate", _dual_plate, BIG),
    valve_family("check valve/piston", _piston, MID),
    valve_family("check valve/nozzle", _nozzle, BIG),
    valve_family("check valve/disc", _disc, _FOUR),
    valve_family("foot valve/strainer", _foot, MID, "head"),
    valve_family("flap valve/hinged", _flap, BIG, "head"),
    valve_family("duckbill valve/cuff", _duckbill, BIG, "head", 0.7),
    valve_family("check valve/ball threaded", _ball_y, SMALL),
    valve_family("check valve/plastic union", _plastic, SMALL),
)
