"""Couplings of further makes: grooved, clamp band, sleeve with bolts, cam lever, claw, quick, adaptor, hygienic."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    bolting,
    counter,
    family,
    flat_flange,
    grooved,
    knurled,
    lathe,
    pipe_x,
    prism,
)
from cadplants.family import Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, cylinder, rod, torus
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import IDENTITY, at, spun
from cadplants.valve_body import bore_of

__all__ = ["COUPLINGS", "half_band"]

_ME = "coupling"
_BACK = spun("z", np.pi)


def _own(solid: Solid, color: str = "trim") -> Part:
    return Part(solid, _ME, color, _ME)


def half_band(inner: float, outer: float, low: float, high: float, sides: int, turn: float = np.pi) -> Solid:
    """The upper half of a ring about x, or another share of it [m]."""
    rest = 0.5 * (np.pi - turn)
    angles = np.linspace(rest + 0.015, np.pi - rest - 0.015, max(6, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return about_x(extrude(np.concatenate([outer * unit, inner * unit[::-1]]), low, high))


def _ends(dn: int, style: ModelingStyle, length: float, gap: float = 0.004) -> list[Part]:
    """Two pieces of pipe that nearly meet in the middle of a coupling."""
    half = 0.5 * length - 0.5 * gap
    return [Part(pipe_x(dn, a, b, style), "pipe", "pipe") for a, b in ((0.0, half), (length - half, length))]


def _grooved(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A grooved coupling of two housings and two bolts over the ends of two pipes (AWWA C606)."""
    length = 0.1 + float(rng.uniform(0.5, 2.5)) * PIPES[dn].outer
    parts = _ends(dn, style, length)
    pose = at(0.5 * length) @ spun("x", pick(rng, 0.0, 0.25, 0.5) * np.pi)
    return Model([*parts, *grooved(dn, style, pose, bool(rng.random() < 0.5))], round(length, 9), "welded")


def _banded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A clamp-band coupling of stainless sheet with folded edges, closed by two screws in two bars (Straub type)."""
    r, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    width, thick = float(rng.uniform(0.7, 1.1)) * r + 0.045, 0.002 + 0.02 * r
    outer = r + 0.006 + 0.06 * r
    length = width + float(rng.uniform(0.06, 0.3))
    mid, low, high = 0.5 * length, 0.5 * (length - width), 0.5 * (length + width)
    bead = 0.12 * width
    shape = [(0.93 * outer, low), (outer, low + bead), (outer, high - bead), (0.93 * outer, high)]
    inner = r * 1.0005
    parts = [*_ends(dn, style, length, 0.01), _own(lathe(shape, n, inner))]
    wrap = [lathe([(outer + thick, low + bead), (outer + thick, high - bead)], n, outer - 0.0003)]
    bar, lift = 0.1 * r + 0.005, outer + thick + 0.05 * r + 0.004
    side = bar * 1.3 + 0.003
    for s in (-1, 1):
        wrap.append(rod((low + bead, s * side, lift), (high - bead, s * side, lift), bar, 10))
    roll = at() @ spun("x", pick(rng, 0.0, 0.5, 1.0) * np.pi)
    parts.append(_own(moved(merge(wrap), roll)))
    for share in (-0.25, 0.25) if rng.random() < 0.8 else (0.0,):
        way = roll @ at(mid + share * width, 0, lift) @ spun("z", np.pi / 2)
        parts += bolting(1, 0.0, 0.5 * bar + 0.003, -side - bar, side + bar, style, _ME, way)
    return Model(parts, round(length, 9), "welded")


def _lobed(radius: float, ears: int, reach: float, wide: float, bore: float, low: float, high: float, n: int) -> Solid:
    """A follower ring with an ear for each bolt, along x."""
    angles = np.linspace(0, 2 * np.pi, max(n, 12 * ears), endpoint=False)
    phase = np.abs((angles * ears / (2 * np.pi) + 0.5) % 1.0 - 0.5) * 2 * np.pi / ears
    r = np.where(phase < wide, reach, radius + (reach - radius) * np.exp(-((np.maximum(phase - wide, 0) * 8) ** 2)))
    return about_x(extrude(np.column_stack([r * np.cos(angles), r * np.sin(angles)]), low, high, (circle(bore, n),)))


def _sleeve_bolts(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bolted sleeve coupling (AWWA C219): a middle ring, two follower rings, long bolts from one to the other."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    width, thick = float(rng.uniform(1.2, 2.2)) * r + 0.07, 0.01 + 0.06 * r
    length = width + float(rng.uniform(0.08, 0.3))
    count = int(rng.choice([2, 3, 4])) if dn <= 80 else int(rng.choice([4, 6, 8]))
    bolt = 0.008 + 0.04 * r
    sleeve = 1.08 * r + 0.008
    low, high = 0.5 * (length - width), 0.5 * (length + width)
    shape = [
        (1.12 * sleeve, low + thick),
        (sleeve, low + 2 * thick),
        (sleeve, high - 2 * thick),
        (1.12 * sleeve, high - thick),
    ]
    parts = [*_ends(dn, style, length, 0.01), _own(lathe(shape, n, r), "valve")]
    circle_ = 1.15 * sleeve + 1.1 * bolt
    for place in (low, high - thick):
        ring = _lobed(1.15 * sleeve, count, circle_ + 1.1 * bolt, 1.2 * bolt / circle_, r, place, place + thick, n)
        parts.append(_own(ring, "valve"))
    parts += bolting(count, circle_, bolt, low, high, style, _ME, IDENTITY, 0.0)
    return Model(parts, round(length, 9), "welded")


def _cam(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cam and groove coupling (EN 14420-7): an adapter in a coupler with two cam levers and finger rings."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    end, cup, male = 0.9 * r + 0.012, 1.1 * r + 0.02, 0.7 * r + 0.012
    length, bore = 2 * end + cup + male, bore_of(dn, style)
    design = int(rng.integers(2))
    grip = (
        prism(2.7 * r + 0.004, int(rng.choice([6, 8])), 0.0, end, bore, n)
        if design
        else lathe([(1.2 * r, 0.0), (1.25 * r, end)], n, bore)
    )
    outer = 1.45 * r + 0.006
    coupler = merge([grip, lathe([(1.2 * r, 0.9 * end), (outer, end), (outer, end + cup)], n, bore)])
    x = end + 0.65 * cup
    ears = []
    levers = []
    a = float(rng.choice([0.0, 0.0, 0.9]))
    for s in (-1, 1):
        ears += [
            box((0.3 * cup, 0.35 * r + 0.006, 0.004 + 0.05 * r), (x, s * (outer + 0.12 * r), z * 0.3 * r))
            for z in (-1, 1)
        ]
        lever = merge(
            [
                _pin(0.22 * r + 0.003, 0.5 * r),
                box((0.9 * cup + end, 0.12 * r + 0.003, 0.45 * r), (-0.5 * (0.9 * cup + end), 0.1 * r, 0)),
                moved(
                    torus(0.25 * r + 0.006, 0.002 + 0.02 * r, 12, 6),
                    at(-1.0 * (0.9 * cup + end) - 0.2 * r, 0.1 * r) @ spun("x", np.pi / 2),
                ),
            ]
        )
        flip = np.diag([1.0, float(s), 1.0, 1.0])
        levers.append(moved(lever, at(x, s * (outer + 0.2 * r)) @ flip @ spun("z", -a)))
    adapter = [(1.15 * r, end + cup - 0.2 * r), (1.15 * r, length - end), (1.3 * r, length - end), (1.3 * r, length)]
    roll = spun("x", pick(rng, 0.0, 0.5) * np.pi)
    parts = [_own(merge([coupler, *ears])), _own(lathe(adapter, n, bore))]
    parts += [Part(one, "lever", "handle", _ME, "Valve assembly") for one in levers]
    parts = [Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]
    return Model(parts, round(length, 9), "welded")


def _pin(radius: float, tall: float) -> Solid:
    """A pin about z [m]."""
    return cylinder(radius, -0.5 * tall, 0.5 * tall, 10)


def _storz(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A claw coupling (DIN 14301 Storz, or with two claws): two alike halves, each with lugs round its ring."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    tail_, ring_ = float(rng.uniform(0.9, 1.8)) * r + 0.02, 0.45 * r + 0.014
    length, lugs = 2 * (tail_ + ring_), int(rng.choice([2, 2, 3, 4]))
    outer = 1.5 * r + 0.01
    half = [lathe([(1.15 * r, 0.0), (1.1 * r, tail_), (outer, tail_), (outer, tail_ + ring_)], n, bore_of(dn, style))]
    for k in range(lugs):
        lug = box((1.3 * ring_, 0.3 * r + 0.01, 0.8 * r), (tail_ + 0.75 * ring_, outer, 0))
        half.append(moved(lug, spun("x", 2 * np.pi * k / lugs)))
    one = merge(half)
    if rng.random() < 0.5:
        ribs = [
            lathe([(1.2 * r, tail_ * k), (1.2 * r, tail_ * k + 0.08 * tail_)], n, 1.08 * r) for k in (0.2, 0.45, 0.7)
        ]
        one = merge([one, *ribs])
    turn = spun("x", np.pi / lugs)
    return Model([_own(one), _own(moved(one, at(length) @ _BACK @ turn))], round(length, 9), "welded")


def _quick(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A quick coupling (ISO 7241): a plug in a socket with a sliding knurled sleeve, hexagons at both ends."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    hexa, body = 0.8 * r + 0.01, float(rng.uniform(2.2, 3.2)) * r + 0.02
    length, bore = 2 * hexa + body + 0.6 * r, bore_of(dn, style)
    split = hexa + 0.72 * body
    socket = merge(
        [
            prism(2.5 * r + 0.005, 6, 0.0, hexa, bore, n),
            lathe([(1.3 * r, 0.9 * hexa), (1.45 * r, hexa), (1.45 * r, split)], n, bore),
        ]
    )
    long = float(rng.uniform(0.3, 0.5)) * body
    if rng.random() < 0.5:
        sleeve = knurled(
            1.75 * r + 0.002, int(rng.integers(12, 24)), 0.08 * r, split - long, split + 0.1 * r, 1.4 * r, n
        )
    else:
        low, high = split - long, split + 0.1 * r
        shape = [
            (1.75 * r, low),
            (1.75 * r, low + 0.2 * long),
            (1.6 * r, low + 0.3 * long),
            (1.6 * r, high - 0.3 * long),
        ]
        sleeve = lathe([*shape, (1.75 * r, high - 0.2 * long), (1.75 * r, high)], n, 1.4 * r)
    plug = [
        (1.1 * r, split - 0.2 * r),
        (1.1 * r, split + 0.5 * r),
        (1.35 * r, split + 0.5 * r),
        (1.35 * r, length - hexa),
    ]
    male = merge([lathe(plug, n, bore), prism(2.5 * r + 0.005, 6, length - hexa, length, bore, n)])
    return Model([_own(socket), _own(sleeve), _own(male)], round(length, 9), "welded")


def _adaptor(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flange adaptor (AWWA C219): a flanged sleeve over a plain pipe, pressed by a follower ring with bolts."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    lead, plate = float(rng.uniform(0.05, 0.2)), plate_thickness(dn)
    body, thick = float(rng.uniform(0.7, 1.2)) * r + 0.05, 0.01 + 0.05 * r
    face = lead + thick + body
    sleeve = 1.08 * r + 0.008
    solid = merge(
        [
            lathe([(1.15 * sleeve, lead + thick + 0.004), (sleeve, lead + 2 * thick), (sleeve, face - plate)], n, r),
            flat_flange(dn, style, face - plate, plate, r),
        ]
    )
    count, bolt = (4 if dn <= 100 else 6), 0.008 + 0.03 * r
    out = 1.15 * sleeve + 1.1 * bolt
    ring = _lobed(1.15 * sleeve, count, out + 1.1 * bolt, 1.2 * bolt / out, r, lead, lead + thick, n)
    parts = [Part(pipe_x(dn, 0.0, face - 0.02, style), "pipe", "pipe"), _own(solid, "valve"), _own(ring, "valve")]
    parts += bolting(count, out, bolt, lead, min(face - plate, lead + 3 * thick), style, _ME, IDENTITY, 0.0)
    counted, more = counter(dn, style, at(face))
    return Model([*parts, *counted], round(face + more, 9), "welded")


def _hygienic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hygienic clamp joint (ISO 2852): two ferrules, a seal, a hinged clamp of two halves with a wing nut."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    long, rim = float(rng.uniform(0.6, 1.2)) * r + 0.012, 1.18 * r + 0.009
    length = 2 * long + 0.002
    ferrule = lathe([(r, 0.0), (r, long - 0.006), (rim, long - 0.003), (rim, long)], n, bore_of(dn, style))
    parts = [_own(ferrule), _own(moved(ferrule, at(length) @ _BACK))]
    parts.append(Part(lathe([(rim, long), (rim, long + 0.002)], n, r), "gasket", "gasket", _ME))
    wide, outer, mid = 0.016 + 0.06 * r, rim + 0.005 + 0.04 * r, 0.5 * length
    half = half_band(rim, outer, mid - 0.5 * wide, mid + 0.5 * wide, n)
    lug = box((wide, 0.35 * r + 0.008, 0.012), (mid, outer + 0.12 * r, 0.008))
    hinge = moved(cylinder(0.005, -0.5 * wide, 0.5 * wide, 8), at(mid, -outer - 0.003) @ spun("y", np.pi / 2))
    upper, lower = (
        merge([half, lug]),
        merge([moved(half, spun("x", np.pi)), moved(lug, np.diag([1.0, 1.0, -1.0, 1.0])), hinge]),
    )
    parts += [Part(s, "clamp", "clamp", "clamp", BOLTED) for s in (upper, lower)]
    y = outer + 0.15 * r
    wing = [
        cylinder(0.003, -0.022, 0.03, 8),
        cylinder(0.008, 0.014, 0.026, 10),
        box((0.045, 0.005, 0.016), (0, 0, 0.03)),
    ]
    parts.append(Part(moved(merge(wing), at(mid, y)), "nut", "fastener", "clamp", BOLTED, True))
    roll = spun("x", float(rng.uniform(0, 6)))
    parts = [Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]
    return Model(parts, round(length, 9), "welded")


def _irrigation(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic compression fitting (ISO 17885): a barrel between two conical nuts with coarse ribs."""
    r, n = PIPES[dn].radius, style.round(1.6 * PIPES[dn].radius)
    nut, middle = float(rng.uniform(1.5, 2.2)) * r + 0.015, 0.8 * r + 0.01
    length, teeth = 2 * nut + middle, int(rng.integers(8, 15))
    one = merge(
        [
            lathe(
                [(1.25 * r, 0.0), (1.5 * r + 0.003, 0.55 * nut), (1.6 * r + 0.003, nut)], n, r if style.hollow else 0.0
            ),
            knurled(1.85 * r + 0.004, teeth, 0.22 * r, 0.5 * nut, nut, 1.3 * r, n),
        ]
    )
    body = lathe(
        [
            (1.45 * r, 0.8 * nut),
            (1.45 * r, nut),
            (1.5 * r, nut),
            (1.5 * r, nut + middle),
            (1.45 * r, nut + middle),
            (1.45 * r, length - 0.8 * nut),
        ],
        n,
    )
    return Model(
        [_own(body, "rubber"), _own(one, "handle"), _own(moved(one, at(length) @ _BACK), "handle")],
        round(length, 9),
        "welded",
    )


def _tube_fitting(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tube fitting (ISO 8434-1): a hexagon body and a hexagon nut with a chamfer on each side."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    nut, hexa, gap = 1.1 * r + 0.008, 0.5 * r + 0.004, 0.4 * r + 0.003
    length = 2 * (nut + gap) + hexa
    thread = lathe([(1.1 * r, 0.5 * nut), (1.1 * r, length - 0.5 * nut)], n)
    body = merge([thread, prism(2.5 * r + 0.005, 6, nut + gap, nut + gap + hexa)])
    bored = 0.99 * r if style.hollow else 0.0
    cone = lathe([(1.12 * r, 0.0), (1.3 * r, 0.25 * nut)], n, bored)
    one = merge([cone, prism(2.6 * r + 0.006, 6, 0.25 * nut, nut, bored, n)])
    ends = [moved(one, spun("x", float(rng.uniform(0, 1)))), moved(one, at(length) @ _BACK)]
    return Model([_own(body), *(Part(s, "nut", "trim", _ME, BOLTED) for s in ends)], round(length, 9), "welded")


def _repair(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A repair clamp: a stainless shell round the pipe, drawn together along a bar by a row of bolts."""
    r, n = PIPES[dn].radius, style.round(1.1 * PIPES[dn].radius)
    count = int(rng.integers(2, 6))
    width = 0.055 * count + 0.02
    length = width + float(rng.uniform(0.1, 0.4))
    low, thick = 0.5 * (length - width), 0.004 + 0.02 * r
    shell = lathe([(r + thick, low), (r + thick, low + width)], n, r)
    bars = [box((width, 0.014, 0.03), (0.5 * length, s * 0.016, r + thick + 0.012)) for s in (-1, 1)]
    webs = [
        box((0.02, 0.02, 0.016), (low + width * (k + 0.5) / count, s * 0.03, r + thick + 0.004))
        for k in range(count)
        for s in (-1, 1)
    ]
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe"), _own(shell), _own(merge([*bars, *webs]))]
    for k in range(count):
        way = at(low + width * (k + 0.5) / count, 0, r + thick + 0.017) @ spun("z", np.pi / 2)
        parts += bolting(1, 0.0, 0.01, -0.023, 0.023, style, _ME, way)
    return Model(parts, round(length, 9), "welded")


def _plastic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic sleeve: glued with a lip at each end, or an electrofusion one with two terminals (ISO 4427-3)."""
    r, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    length, outer = float(rng.uniform(2.2, 3.6)) * r + 0.02, 1.2 * r + 0.002
    bore = bore_of(dn, style)
    if rng.random() < 0.5:
        lip = 0.1 * length
        shape = [(1.08 * outer, 0.0), (1.08 * outer, lip), (outer, lip), (outer, length - lip)]
        return Model(
            [_own(lathe([*shape, (1.08 * outer, length - lip), (1.08 * outer, length)], n, bore), "handle")],
            round(length, 9),
            "welded",
        )
    pieces = [
        lathe(
            [(0.95 * outer, 0.0), (1.1 * outer, 0.15 * length), (1.1 * outer, 0.85 * length), (0.95 * outer, length)],
            n,
            bore,
        )
    ]
    for x in (0.22 * length, 0.78 * length):
        pieces.append(moved(cylinder(0.006 + 0.03 * r, outer, 1.12 * outer + 0.014, 10), at(x)))
    return Model([_own(merge(pieces), "rubber")], round(length, 9), "welded")


_MIDDLE = tuple(dn for dn in SIZES if dn <= 100)

COUPLINGS: tuple[Family, ...] = (
    family("coupling/grooved", _grooved, SIZES[2:], weight=1.0),
    family("coupling/clamp band", _banded, SIZES[3:]),
    family("coupling/sleeve with bolts", _sleeve_bolts, SIZES[4:]),
    family("coupling/cam lever", _cam, _MIDDLE, grain="structure"),
    family("coupling/claw", _storz, _MIDDLE, grain="structure"),
    family("coupling/quick", _quick, SMALL, grain="structure"),
    family("coupling/flange adaptor", _adaptor, SIZES[5:]),
    family("coupling/hygienic clamp", _hygienic, _MIDDLE, grain="structure"),
    family("coupling/plastic compression", _irrigation, _MIDDLE, grain="structure"),
    family("coupling/tube fitting", _tube_fitting, SMALL, grain="structure"),
    family("coupling/repair clamp", _repair, SIZES[4:]),
    family("coupling/plastic sleeve", _plastic, SIZES[:12]),
)
