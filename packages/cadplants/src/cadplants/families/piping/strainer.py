"""Strainers of further makes: Y, tee, basket, duplex, cone, foot, dirt separator, self-cleaning; along x from 0."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.piping.pot import POTS
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    bolting,
    family,
    flat_flange,
    knurled,
    lathe,
    mouth,
    necks,
    pipe_x,
    prism,
    swell_room,
)
from cadplants.family import Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, cylinder, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["STRAINERS"]

_ME = "strainer"
_UP, _DOWN = spun("y", -np.pi / 2), spun("y", np.pi / 2)


def _own(solid: Solid, color: str = "valve") -> Part:
    return Part(solid, _ME, color, _ME)


def _lid(
    radius: float, thick: float, count: int, style: ModelingStyle, rng: np.random.Generator, way: Floats
) -> list[Part]:
    """A bolted lid along x of a pose, its face at 0; plain, dished, with a plug, a ring or a handle on it."""
    n, kind = style.round(radius), int(rng.integers(4))
    flat = [lathe([(radius, 0.0), (radius, thick)], n)]
    if kind == 1:
        flat.append(lathe([(0.55 * radius, 0.9 * thick), (0.45 * radius, 1.7 * thick)], n))
    if kind == 3:
        flat[0] = lathe([(radius, 0.0), (radius, thick), (0.7 * radius, 1.2 * thick), (0.3 * radius, 1.9 * thick)], n)
    parts = [_own(moved(merge(flat), way))]
    if kind in (0, 1):
        high = thick if kind == 0 else 1.7 * thick
        plug = merge([prism(0.4 * radius, _corners(rng), high, high + 0.2 * radius + 0.003)])
        parts.append(Part(moved(plug, way), "pipe cap", "trim", _ME))
    parts += bolting(count, 0.83 * radius, 0.09 * radius + 0.004, -thick, thick, style, _ME, way)
    return parts


def _corners(rng: np.random.Generator) -> int:
    """A square or a hexagon head."""
    return int(rng.choice([4, 6]))


def _y_cast(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cast Y strainer (EN 558 series 1): a long leaning basket housing, ribs, a bolted lid with a plug."""
    length, r = FACE_TO_FACE["globe"][dn], PIPES[dn].radius
    neck = 0.485 * FLANGES[dn].hub
    n, arm = style.round(1.3 * r), max(neck, float(rng.uniform(1.15, 1.4)) * r + 0.004)
    lean = float(rng.uniform(0.6, 1.0))
    swell = float(rng.uniform(1.0, 1.2)) * arm
    body = necks(dn, style, length)
    low = swell_room(dn)
    body.append(lathe([(neck, low), (swell, 0.35 * length), (swell, 0.62 * length), (neck, length - low)], n))
    far = max(1.0 * length * float(rng.uniform(0.55, 0.75)), (0.5 * FLANGES[dn].outer + arm) / np.sin(lean))
    x = 0.38 * length
    if x + far * np.cos(lean) > length + 0.4 * r:
        far = (length + 0.4 * r - x) / np.cos(lean)
    way = at(x) @ spun("y", lean)
    collar, plate = 1.3 * arm + 0.012, 0.012 + 0.07 * r
    body.append(moved(lathe([(arm, 0.0), (0.96 * arm, far - plate)], n), way))
    body.append(moved(lathe([(collar, far - plate), (collar, far)], n), way))
    if rng.random() < 0.5:
        web = box((0.7 * far, 0.12 * r + 0.003, 2.3 * arm), (0.62 * far, 0, 0))
        body.append(moved(web, way))
    parts = [_own(merge(body)), *_lid(collar, plate, 4 if dn < 80 else 8, style, rng, way @ at(far))]
    return Model(parts, round(length, 9))


def _y_fabricated(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Y strainer welded of pipe: a leg at 45 degrees with a flange, a blind flange and a drain."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    slope, plate = 0.25 * np.pi, plate_thickness(dn)
    far = 1.5 * r + 0.75 * FLANGES[dn].outer + 0.04
    begin = 2 * r + 0.02
    length = begin + 0.72 * far + 0.6 * FLANGES[dn].outer * float(rng.uniform(0.6, 1.0)) + 2 * r
    way = at(begin) @ spun("y", slope)
    leg = lathe([(0.985 * r, 0.0), (0.985 * r, far)], n)
    body = merge(
        [pipe_x(dn, 0.0, length, style), moved(leg, way), moved(flat_flange(dn, style, far - plate, plate, 0.0), way)]
    )
    blind = moved(flat_flange(dn, style, far + 0.002, plate, 0.0), way)
    seal = moved(lathe([(1.25 * r, far), (1.25 * r, far + 0.002)], n), way)
    drain = merge(
        [
            prism(0.5 * r + 0.012, 6, far + plate, far + plate + 0.03),
            lathe([(0.2 * r, far + plate), (0.2 * r, far + plate + 0.07)], 12),
        ]
    )
    size = FLANGES[dn]
    parts = [_own(body, "pipe"), _own(blind, "pipe"), Part(seal, "gasket", "gasket", _ME)]
    parts.append(Part(moved(drain, way), "nipple", "pipe", _ME))
    parts += bolting(size.n_bolts, size.circle / 2, size.bolt, far - plate, far + 0.002 + plate, style, _ME, way)
    return Model(parts, round(length, 9), "welded")


def _y_plastic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic Y strainer: union nuts at both ends, a clear cylinder leaning down under a ribbed ring."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    sock, nut = 1.1 * r + 0.012, 1.0 * r + 0.012
    length = 2 * (sock + nut) + 4.0 * r + 0.02
    teeth = int(rng.integers(8, 17))
    body = [lathe([(1.3 * r, sock), (1.3 * r, length - sock)], n)]
    ends = []
    for side in (0, 1):
        pose = at(length) @ spun("z", np.pi) if side else at()
        socket = moved(lathe([(1.22 * r, 0.0), (1.22 * r, sock)], n, bore_of(dn, style)), pose)
        ring_ = moved(knurled(1.75 * r + 0.004, teeth, 0.12 * r, sock, sock + nut, 0.0, n), pose)
        ends += [Part(socket, "union", "handle", _ME), Part(ring_, "union", "handle", _ME)]
    way = at(0.42 * length) @ spun("y", pick(rng, 0.25, 0.3) * np.pi)
    far = 2.2 * r + 0.02
    body.append(moved(lathe([(1.25 * r, 0.0), (1.35 * r, far)], n), way))
    tall = float(rng.uniform(2.0, 3.5)) * r
    cup = [(1.25 * r, far), (1.2 * r, far + tall), (0.9 * r, far + tall + 0.4 * r), (0.3 * r, far + tall + 0.5 * r)]
    parts = [_own(merge(body), "handle"), _own(moved(lathe(cup, n), way), "dial")]
    parts.append(
        _own(moved(knurled(1.8 * r + 0.003, teeth, 0.14 * r, far - 0.35 * r, far + 0.6 * r, 0.0, n), way), "rubber")
    )
    return Model([*parts, *ends], round(length, 9), "welded")


def _y_socket(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A forged Y strainer (ASME B16.11 ends): a leg with a big hexagon cap and a small blow-off plug in it."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    length = float(rng.uniform(4.4, 5.6)) * r + 0.04
    design = str(rng.choice(["socket", "banded", "hex"]))
    room = 0.32 * length
    one = mouth(design, dn, style, 0.0, room)
    ends = [moved(one, at(length - room)), moved(one, at(room) @ spun("z", np.pi))]
    middle = lathe(
        [(1.2 * r, 0.2 * length), (1.35 * r, 0.4 * length), (1.35 * r, 0.6 * length), (1.2 * r, 0.8 * length)], n
    )
    way = at(0.34 * length) @ spun("y", float(rng.uniform(0.7, 0.95)))
    far = float(rng.uniform(0.55, 0.7)) * length + 1.0 * r
    leg = moved(lathe([(1.25 * r, 0.0), (1.2 * r, far)], n), way)
    cap_ = prism(2.6 * r + 0.004, 6, far, far + 0.8 * r + 0.005)
    rim = lathe([(1.6 * r + 0.003, far), (1.6 * r + 0.003, far + 0.2 * r)], n)
    plug = prism(0.8 * r + 0.003, _corners(rng), far + 0.8 * r + 0.005, far + 1.2 * r + 0.009)
    parts = [_own(merge([*ends, middle, leg]), "trim"), _own(moved(merge([cap_, rim]), way), "trim")]
    parts.append(Part(moved(plug, way), "pipe cap", "trim", _ME))
    return Model(parts, round(length, 9), "welded")


def _conical(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A temporary cone strainer between flanges (start-up): a ring with a tab, the cone in the pipe."""
    r, size = PIPES[dn].radius, FLANGES[dn]
    outer, thick = 0.49 * (size.circle - size.bolt), pick(rng, 0.003, 0.005, 0.008)
    n = style.round(outer)
    tab = float(rng.uniform(0.55, 0.8)) * size.outer
    flat = lathe([(outer, 0.0), (outer, thick)], n, 0.9 * PIPES[dn].bore if style.hollow else 0.0)
    ear = extrude(np.array([[0.97 * outer, -0.02], [tab, -0.02], [tab, 0.02], [0.97 * outer, 0.02]]), 0.0, thick)
    ear = moved(ear, spun("y", np.pi / 2))
    ear = moved(ear, spun("x", pick(rng, 0.5, 1.0, 1.5) * np.pi))
    pieces = [flat, ear]
    long = float(rng.uniform(1.0, 2.4)) * r
    if style.hollow:
        a, b = 0.9 * PIPES[dn].bore, 0.9 * PIPES[dn].bore - 0.002
        tip = 0.05 * r if rng.random() < 0.6 else 0.45 * r
        cone = [(a, 0.3 * thick), (a, thick), (tip + 0.002, long), (tip, long), (b - 0.001, 0.3 * thick)]
        pieces.append(about_x(weld([revolve(cone, n, closed=True)])))
    return Model([_own(merge(pieces), "trim")], round(thick, 9), "wafer")


def _foot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A suction strainer on a pipe's end: a bell with ribs, a perforated can with hoops, or a dished basket of bars."""
    r, n = PIPES[dn].radius, style.round(2 * PIPES[dn].radius)
    wide, tall = float(rng.uniform(1.5, 2.2)) * r + 0.01, float(rng.uniform(2.0, 4.5)) * r + 0.03
    sock = 0.8 * r + 0.012
    kind = int(rng.integers(3))
    head = [(1.25 * r + 0.002, 0.0), (1.25 * r + 0.002, sock), (wide, sock + 0.5 * r)]
    far = sock + 0.5 * r
    if kind == 0:
        can = [lathe([*head, (wide, far + tall), (0.8 * wide, far + tall + 0.15 * wide)], n)]
        for k in range(int(rng.integers(2, 5))):
            place = far + tall * (0.1 + 0.28 * k)
            if place < far + tall:
                can.append(lathe([(1.05 * wide, place), (1.05 * wide, place + 0.008)], n, 0.98 * wide))
    elif kind == 1:
        count = int(rng.integers(8, 19))
        one = box((tall + 0.01, 0.05 * wide + 0.001, 0.25 * wide), (far + 0.5 * tall, 0, 0.87 * wide))
        bars = [moved(one, spun("x", 2 * np.pi * k / count)) for k in range(count)]
        disc = lathe([(wide, far + tall), (wide, far + tall + 0.006)], n)
        can = [
            lathe([*head, (wide, far + 0.006)], n),
            *bars,
            disc,
            lathe([(0.7 * wide, far), (0.7 * wide, far + tall)], n),
        ]
    else:
        bell = [
            (1.2 * r, 0.0),
            (1.2 * r, 0.4 * tall),
            (1.45 * r, 0.7 * tall),
            (wide * 1.25, tall),
            (wide * 1.25, 1.05 * tall),
        ]
        count = int(rng.integers(4, 9))
        vane = box((0.6 * tall, 0.006, 0.5 * wide), (0.95 * tall, 0, 0.8 * wide))
        vanes = [moved(vane, spun("x", 2 * np.pi * k / count)) for k in range(count)]
        can = [lathe(bell, n), *vanes, lathe([(1.2 * wide, 1.25 * tall), (1.2 * wide, 1.25 * tall + 0.01)], n)]
    aim = [_own(merge(can), str(rng.choice(["trim", "valve", "pipe"])))]
    return Model(aim)


def _bag(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wide inline strainer: a can of larger size between cones, a clamp ring or flanges round its middle."""
    r, n = PIPES[dn].radius, style.round(2 * PIPES[dn].radius)
    wide, cone = float(rng.uniform(1.7, 2.4)) * r + 0.006, float(rng.uniform(0.8, 2.0)) * r
    tall = float(rng.uniform(2.0, 4.5)) * r + 0.03
    neck, mid = 0.6 * r + 0.012, 0.5 * tall
    length = 2 * (neck + cone) + tall
    x = neck + cone + mid
    half = [(r, 0.0), (r, neck), (wide, neck + cone), (wide, x)]
    thick = 0.006 + 0.1 * r
    outside = [*half[:-1], (wide, x - thick), (1.22 * wide, x - thick), (1.22 * wide, x)]
    bore, room = bore_of(dn, style), 0.9 * wide
    # A can is as thin as the pipe, so that its inside widens with it.
    inside = [(room, x), (room, neck + cone), (bore, neck), (bore, 0.0)]
    first = about_x(weld([revolve([*outside, *inside], n, closed=True)])) if bore else lathe(outside, n)
    second = moved(first, at(length) @ spun("z", np.pi))
    parts = [_own(first, "trim"), _own(second, "trim")]
    if rng.random() < 0.6:
        parts += bolting(8, 1.12 * wide, 0.005 + 0.05 * r, x - thick, x + thick, style, _ME, at())
    else:
        band = lathe([(1.3 * wide, x - 1.3 * thick), (1.3 * wide, x + 1.3 * thick)], n, 1.21 * wide)
        screw = merge([moved(box((0.02, 0.02, 0.05), (0, 0, 0)), at(x, 0, 1.3 * wide + 0.01))])
        parts += [Part(band, "clamp", "clamp", "", BOLTED), Part(screw, "bolt", "fastener", "", BOLTED, True)]
    drain = moved(
        lathe([(0.25 * r, 0.6 * wide), (0.25 * r, 1.25 * wide), (0.35 * r, 1.25 * wide), (0.35 * r, 1.45 * wide)], 12),
        at(x + 0.3 * tall) @ _DOWN,
    )
    parts.append(Part(drain, "nipple", "trim", _ME))
    return Model(parts, round(length, 9), "welded")


def _cartridge(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A water strainer with a clear bowl: a head with two mouths, a hanging bowl under a ribbed ring, a drain."""
    r, n = PIPES[dn].radius, style.round(2 * PIPES[dn].radius)
    bowl, length = 2.0 * r + 0.02, 5.2 * r + 0.06
    x, tall = 0.5 * length, float(rng.uniform(3.0, 6.0)) * r + 0.06
    room = 0.35 * length
    one = mouth(str(rng.choice(["hex", "banded"])), dn, style, 0.0, room)
    ends = [moved(one, at(length - room)), moved(one, at(room) @ spun("z", np.pi))]
    head = moved(cylinder(1.05 * bowl, -1.3 * r, 1.6 * r, n), at(x))
    parts = [_own(merge([*ends, head]), "trim")]
    ring_ = moved(
        knurled(1.25 * bowl, int(rng.integers(12, 25)), 0.08 * bowl, 0.0, 0.8 * r + 0.01, 0.0, n),
        at(x, 0, -1.3 * r) @ _DOWN,
    )
    low = -2.1 * r - 0.01
    glass = [(0.3 * bowl, low - tall), (0.85 * bowl, low - tall + 0.1 * bowl), (bowl, low)]
    parts += [_own(ring_, "rubber"), _own(moved(turned(glass, n), at(x)), "dial")]
    cock = merge(
        [
            cylinder(0.3 * r + 0.003, low - tall - 0.025, low - tall, 10),
            box((0.03, 0.006, 0.01), (0.015, 0, low - tall - 0.018)),
        ]
    )
    parts.append(Part(moved(cock, at(x)), "valve body", "trim", _ME, "Valve assembly"))
    return Model(parts, round(length, 9), "welded")


_MIDDLE = tuple(dn for dn in SIZES if dn <= 200)

STRAINERS: tuple[Family, ...] = POTS + tuple(
    family(f"strainer/{name}", build, sizes, place, weight, "structure")
    for name, build, sizes, place, weight in (
        ("Y cast", _y_cast, SIZES, "inline", 1.5),
        ("Y fabricated", _y_fabricated, SIZES[2:], "inline", 1.0),
        ("Y plastic", _y_plastic, SIZES[:8], "inline", 1.0),
        ("Y forged", _y_socket, SMALL, "inline", 1.0),
        ("cone", _conical, SIZES[3:], "inline", 0.7),
        ("foot", _foot, SIZES[2:], "end", 1.5),
        ("inline can", _bag, _MIDDLE, "inline", 1.0),
        ("bowl", _cartridge, SMALL, "inline", 1.0),
    )
)
