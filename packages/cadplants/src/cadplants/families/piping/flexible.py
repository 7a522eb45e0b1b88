"""Expansion joints of further makes."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    bolting,
    drilled,
    family,
    flat_flange,
    lathe,
    mirrored,
    pipe_x,
    prism,
)
from cadplants.family import Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, torus, waves
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["FLEXIBLES"]

_ME = "expansion joint"
_BACK = spun("z", np.pi)


def _own(solid: Solid, color: str = "trim") -> Part:
    return Part(solid, _ME, color, _ME)


def _waved(low: float, high: float, r: float, depth: float, count: int) -> list[tuple[float, float]]:
    return [(a, x) for a, x in waves(low, high, r, r + depth, count)]


def _ears(
    dn: int, style: ModelingStyle, count: int, x: float, thick: float, length: float, start: float = 0.0
) -> list[Part]:
    """Ears for control rods at both ends, beyond the flanges' rims, and the rods with their nuts."""
    rim = FLANGES[dn].outer / 2
    reach, bolt = rim + 0.02 + 0.05 * rim, 0.008 + 0.03 * rim
    wide = 4 * bolt
    ear = box((thick, reach + 1.5 * bolt - 0.93 * rim, wide), (x, 0.5 * (reach + 1.5 * bolt + 0.93 * rim), 0))
    one = merge([moved(ear, spun("x", start + 2 * np.pi * k / count)) for k in range(count)])
    parts = [_own(one, "steel"), *mirrored([_own(one, "steel")], length)]
    return parts + bolting(count, reach, bolt, x - 0.5 * thick, length - x + 0.5 * thick, style, _ME, at(), start)


def _rubber(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rubber sphere, single or double, between loose flanges (EN 15016 practice), with or without control rods."""
    r, plate = PIPES[dn].radius, plate_thickness(dn)
    n, spheres = style.round(1.5 * r), int(rng.choice([1, 1, 2]))
    depth, long = 0.35 * r + 0.012, (0.9 * r + 0.06) * (1.0 if spheres == 1 else 1.7)
    length = 2 * (plate + 0.012) + long
    low = plate + 0.008
    t = np.linspace(0, np.pi, 7)
    arch: list[tuple[float, float]] = []
    for k in range(spheres):
        a = low + long * k / spheres
        arch += [
            (1.08 * r + depth * float(np.sin(s)), a + 0.004 + (long / spheres - 0.008) * float(1 - np.cos(s)) / 2)
            for s in t
        ]
    bead = 1.35 * r + 0.004
    neck = 1.08 * r
    shape = [
        (bead, 0.0),
        (bead, 0.004),
        (neck, 0.0045),
        (neck, low),
        *arch,
        (neck, length - low),
        (neck, length - 0.0045),
    ]
    body = lathe([*shape, (bead, length - 0.004), (bead, length)], n, bore_of(dn, style))
    if spheres == 2 and rng.random() < 0.7:
        ring_ = moved(torus(1.12 * r + 0.004, 0.06 * r + 0.004, n, 8), at(0.5 * length) @ spun("y", np.pi / 2))
        body = merge([body, ring_])
    loose = [Part(flat_flange(dn, style, 0.0045, plate - 0.0045, 1.081 * r), "flange", "flange", _ME)]
    parts = [_own(body, "rubber"), *loose, *mirrored(loose, length)]
    if rng.random() < 0.45:
        parts += _ears(dn, style, int(rng.choice([2, 3, 4])), 0.5 * plate, 0.7 * plate, length)
    return Model(parts, round(length, 9))


def _bellows_between(dn: int, style: ModelingStyle, rng: np.random.Generator, low: float, high: float) -> Solid:
    """Metal bellows with collars at both ends from one place to another along x."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    depth = float(rng.uniform(0.15, 0.35)) * r + 0.004
    count = max(2, min(10, int((high - low) / (0.25 * r + 0.008))))
    cuff = 0.06 * (high - low)
    return lathe([(1.02 * r, low), *_waved(low + cuff, high - cuff, 1.02 * r, depth, count), (1.02 * r, high)], n, 0.0)


def _hinged(dn: int, style: ModelingStyle, rng: np.random.Generator, gimbal: bool) -> Model:
    """Bellows between pipe ends with a hinge: pairs of arms on rings and pins, or a gimbal ring between them (EJMA)."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, long = float(rng.uniform(0.8, 1.5)) * r + 0.05, float(rng.uniform(1.0, 1.8)) * r + 0.03
    length, mid, outer = 2 * end + long, end + 0.5 * long, 1.5 * r + 0.02
    parts = [_own(_bellows_between(dn, style, rng, end, end + long))]
    ends = [Part(pipe_x(dn, 0.0, end, style), "pipe", "pipe")]
    thick, wide = 0.008 + 0.06 * r, 0.5 * r + 0.02
    plate = lathe([(outer, 0.75 * end - thick), (outer, 0.75 * end)], n, 0.99 * r)
    arms = []
    for side in (-1, 1):
        arm = box(
            (mid - 0.75 * end + 0.5 * wide, thick, wide),
            (0.5 * (mid + 0.75 * end + 0.5 * wide), side * (outer + 0.5 * thick), 0),
        )
        stub = box((2 * thick, outer - 0.9 * r, wide), (0.75 * end - 0.5 * thick, side * 0.5 * (outer + 1.1 * r), 0))
        arms += [arm, stub]
    first = merge([plate, *arms])
    parts.append(_own(first, "steel"))
    back = at(length) @ _BACK @ (spun("x", np.pi / 2) if gimbal else at())
    if gimbal:
        ring_ = lathe(
            [(outer - 0.001, mid - 0.45 * wide), (outer - 0.001, mid + 0.45 * wide)], n, outer - 0.001 - 1.2 * thick
        )
        parts += [_own(ring_, "steel"), _own(moved(first, back), "steel")]
    else:
        inner = [moved(s, np.diag([1.0, (outer - thick) / outer, 1.0, 1.0])) for s in arms]
        parts.append(_own(moved(merge([plate, *inner]), back), "steel"))
    for turn in (0.0, 0.5, 1.0, 1.5) if gimbal else (0.0, 1.0):
        pin = lathe(
            [
                (0.2 * wide, -2.2 * thick),
                (0.2 * wide, 1.5 * thick),
                (0.3 * wide, 1.5 * thick),
                (0.3 * wide, 2.1 * thick),
            ],
            10,
        )
        way = at(mid) @ spun("x", turn * np.pi) @ at(0, outer) @ spun("z", np.pi / 2)
        parts.append(Part(moved(pin, way), "bolt", "fastener", _ME, BOLTED))
    ends += [Part(pipe_x(dn, length - end, length, style), "pipe", "pipe")]
    return Model([ends[0], *parts, ends[1]], round(length, 9), "welded")


def _hinge(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hinged metal expansion joint."""
    return _hinged(dn, style, rng, False)


def _gimbal(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gimbal metal expansion joint."""
    return _hinged(dn, style, rng, True)


def _universal(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tied universal expansion joint: two bellows with a pipe between them, end plates and long tie rods (EJMA)."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, one, mid = 0.8 * r + 0.05, float(rng.uniform(0.8, 1.3)) * r + 0.03, float(rng.uniform(1.5, 4.0)) * r + 0.05
    length = 2 * (end + one) + mid
    thick, outer = 0.01 + 0.07 * r, 1.75 * r + 0.03
    bellows = _bellows_between(dn, style, rng, end, end + one)
    pipes = [
        Part(pipe_x(dn, a, b, style), "pipe", "pipe")
        for a, b in ((0, end), (end + one, end + one + mid), (length - end, length))
    ]
    count = int(rng.choice([2, 3, 4, 4]))
    x, bolt = 0.7 * end, 0.01 + 0.05 * r
    if rng.random() < 0.5:
        plate = lathe([(outer + 1.5 * bolt, x - thick), (outer + 1.5 * bolt, x)], n, 0.99 * r)
    else:
        lug = box(
            (1.5 * thick, outer + 1.5 * bolt - 0.95 * r, 3.5 * bolt),
            (x - 0.5 * thick, 0.5 * (outer + 1.5 * bolt + 0.95 * r), 0),
        )
        web = box((2.5 * thick, outer - 0.95 * r, 0.5 * thick), (x - 0.2 * thick, 0.5 * (outer + 0.95 * r), 0))
        plate = merge([moved(merge([lug, web]), spun("x", 2 * np.pi * k / count)) for k in range(count)])
    own = [_own(bellows), _own(plate, "steel")]
    parts = [
        *pipes,
        *own,
        *mirrored(own, length),
        *bolting(count, outer, bolt, x - 1.25 * thick, length - x + 1.25 * thick, style, _ME, at(), 0.0),
    ]
    return Model(parts, round(length, 9), "welded")


def _lens(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lens compensator: one to three high, sharp waves welded of dished discs."""
    r, n, bore = PIPES[dn].radius, style.round(1.8 * PIPES[dn].radius), bore_of(dn, style)
    count, high, long = (
        int(rng.integers(1, 4)),
        float(rng.uniform(0.5, 0.9)) * r + 0.015,
        float(rng.uniform(0.6, 1.0)) * r + 0.01,
    )
    end = 0.3 * r + 0.02
    shape = [(r, 0.0), (r, end)]
    for k in range(count):
        a = end + k * 1.15 * long
        shape += [(r + 0.15 * high, a + 0.2 * long), (r + 0.95 * high, a + 0.42 * long), (r + high, a + 0.5 * long)]
        shape += [(r + 0.95 * high, a + 0.58 * long), (r + 0.15 * high, a + 0.8 * long), (r, a + long)]
    length = end + count * 1.15 * long - 0.15 * long + end
    return Model([_own(lathe([*shape, (r, length)], n, bore), "pipe")], round(length, 9), "welded")


def _slip(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A slip joint: a pipe sliding in a wider body through a stuffing box whose gland is drawn in by bolts."""
    r, n = PIPES[dn].radius, style.round(1.6 * PIPES[dn].radius)
    slide, body = float(rng.uniform(1.5, 3.5)) * r + 0.06, float(rng.uniform(2.0, 4.0)) * r + 0.1
    wide, flat, thick = 1.25 * r + 0.008, 1.75 * r + 0.03, 0.012 + 0.06 * r
    length = slide + body
    shape = [
        (flat, slide),
        (flat, slide + thick),
        (wide, slide + thick),
        (wide, length - 0.6 * r - 0.02),
        (r, length - 0.1 * r - 0.01),
    ]
    box_ = lathe([*shape, (r, length)], n, bore_of(dn, style))
    gland = lathe(
        [(flat, slide - 2 * thick), (flat, slide - thick), (1.15 * r, slide - thick), (1.15 * r, slide)], n, r
    )
    count = 4 if dn < 100 else 8
    parts = [
        Part(pipe_x(dn, 0.0, slide + 0.2 * body, style), "pipe", "pipe"),
        _own(box_, "valve"),
        _own(gland, "valve"),
    ]
    parts += bolting(count, 0.5 * (flat + wide) + 0.004, 0.1 * r + 0.006, slide - 2 * thick, slide + thick, style, _ME)
    if rng.random() < 0.5:
        foot = box((0.25 * body, 1.6 * wide, 0.5 * wide), (slide + 0.6 * body, 0, -1.2 * wide))
        parts.append(
            Part(
                merge([foot, box((0.4 * body, 2.2 * wide, 0.012), (slide + 0.6 * body, 0, -1.45 * wide))]),
                "bracket",
                "steel",
                "",
                BOLTED,
            )
        )
    return Model(parts, round(length, 9), "welded")


def _fabric(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fabric expansion joint: a wide belt of cloth clamped by flat bars with many bolts on two frames."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, wide = 0.4 * r + 0.03, float(rng.uniform(0.9, 1.6)) * r + 0.1
    length, out = 2 * end + wide, 1.3 * r + 0.03
    sag = pick(rng, -0.04, 0.05, 0.1) * r
    belt = [
        (out, end + 0.001),
        (out + sag, end + 0.3 * wide),
        (out + 1.2 * sag, length / 2),
        (out + sag, length - end - 0.3 * wide),
    ]
    parts = [_own(lathe([*belt, (out, length - end - 0.001)], n, 0.9 * out), "rubber")]
    bar = 0.03 + 0.05 * r
    frame = merge(
        [
            lathe([(r, 0.0), (r, end), (0.97 * out, end), (0.97 * out, end + bar)], n, bore_of(dn, style)),
            lathe([(1.12 * out, end - 0.008), (1.12 * out, end)], n, 0.99 * r),
        ]
    )
    band = lathe([(1.03 * out, end + 0.002), (1.03 * out, end + bar)], n, 0.999 * out)
    side = [Part(frame, "flange", "flange"), Part(band, "clamp", "clamp", "", BOLTED)]
    count = int(rng.integers(6, 13))
    heads = [
        moved(
            prism(0.014, 6, 0.0, 0.01),
            at(end + 0.5 * bar) @ spun("x", 2 * np.pi * k / count) @ at(0, 1.028 * out) @ spun("z", np.pi / 2),
        )
        for k in range(count)
    ]
    side.append(Part(merge(heads), "bolt", "fastener", "", BOLTED, True))
    return Model([side[0], *parts, *side[1:], *mirrored(side, length)], round(length, 9), "welded")


def _dismantling(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dismantling joint (AWWA C219): a flanged body and a flanged spigot in it, a ring between, long tie rods."""
    r, size, plate = PIPES[dn].radius, FLANGES[dn], plate_thickness(dn)
    n, length = style.round(1.4 * r), float(rng.uniform(0.16, 0.24)) + 0.6 * r
    mid, bore = float(rng.uniform(0.45, 0.6)) * length, bore_of(dn, style)
    body = merge(
        [
            flat_flange(dn, style, 0.0, plate, bore),
            lathe([(1.2 * r + 0.006, plate), (1.2 * r + 0.006, mid - 0.01), (1.35 * r + 0.008, mid)], n, r),
        ]
    )
    turns = (2 * np.arange(size.n_bolts) + 1) * np.pi / size.n_bolts
    spots = size.circle / 2 * np.column_stack([np.cos(turns), np.sin(turns)])
    ring_ = drilled(
        circle(size.outer / 2, style.round(size.outer / 2)), mid, mid + plate, r, spots, size.hole / 2, style, n
    )
    spigot = merge(
        [flat_flange(dn, style, length - plate, plate, bore), lathe([(r, 0.3 * mid), (r, length - plate)], n, bore)]
    )
    parts = [_own(body, "valve"), _own(ring_, "valve"), _own(spigot, "valve")]
    nut = []
    for x in (plate, mid - 0.8 * size.bolt, mid + plate, length - plate - 0.8 * size.bolt):
        nut.append(prism(1.6 * size.bolt, 6, x, x + 0.8 * size.bolt))
    shank = lathe([(size.bolt / 2, plate), (size.bolt / 2, length - plate)], 8)
    count, step = size.n_bolts, int(rng.choice([1, 2]))
    poses = [spun("x", float(turns[k])) @ at(0, size.circle / 2) for k in range(0, count, step)]
    one = merge([shank, *nut])
    if style.fasteners in ("set", "flange"):
        return Model(
            [*parts, Part(merge([moved(one, p) for p in poses]), "stud", "fastener", _ME, BOLTED, True)],
            round(length, 9),
        )
    return Model(
        [*parts, *(Part(moved(one, p), "stud", "fastener", _ME, BOLTED, True) for p in poses)], round(length, 9)
    )


def _canned(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An axial expansion joint in a guide tube: a long can round the bellows, rings at its ends, a drain boss."""
    r, n = PIPES[dn].radius, style.round(1.6 * PIPES[dn].radius)
    end, can, wide = float(rng.uniform(0.8, 2.0)) * r + 0.04, float(rng.uniform(2.5, 5.0)) * r + 0.1, 1.4 * r + 0.012
    length = 2 * end + can
    shell = lathe([(wide, end), (wide, end + can)], n, r)
    caps = [lathe([(1.06 * wide, a), (1.06 * wide, a + 0.01)], n, r) for a in (end - 0.004, end + can - 0.006)]
    boss = moved(
        merge([lathe([(0.012, 0.9 * wide), (0.012, wide + 0.02)], 12), prism(0.026, 6, wide + 0.02, wide + 0.034)]),
        at(end + 0.2 * can) @ spun("y", np.pi / 2),
    )
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe"), _own(merge([shell, *caps]), "pipe")]
    if rng.random() < 0.6:
        parts.append(_own(boss, "pipe"))
    return Model(parts, round(length, 9), "welded")


FLEXIBLES: tuple[Family, ...] = (
    family("expansion joint/rubber sphere", _rubber, weight=1.0, grain="structure"),
    family("expansion joint/hinged", _hinge, SIZES[4:]),
    family("expansion joint/gimbal", _gimbal, SIZES[4:]),
    family("expansion joint/tied universal", _universal, SIZES[4:]),
    family("expansion joint/lens", _lens, SIZES[3:]),
    family("expansion joint/slip", _slip, SIZES[2:]),
    family("expansion joint/fabric", _fabric, SIZES[6:]),
    family("expansion joint/dismantling", _dismantling, SIZES[5:], grain="structure"),
    family("expansion joint/guide tube", _canned, SIZES[2:]),
)
