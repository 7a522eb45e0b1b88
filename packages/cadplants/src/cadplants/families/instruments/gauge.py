"""Further pressure gauges: on panels and walls, with seals and contacts, square, twin and differential."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import (
    CASE,
    STEM,
    case_of,
    dial,
    face_of,
    fine_sides,
    gauge_family,
    gland,
    headed,
    indicator,
    needle_of,
    piece,
    pointer,
    shank,
    standing,
    t_handle,
    upright,
)
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, fronted, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, torus, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["GAUGE_BUILDS"]

_LOOK = spun("x", np.pi / 2)  # what looks to +z looks to -y
_KIND = "pressure gauge"


def _depth(parts: list[Part]) -> float:
    return float(parts[0].solid.vertices[:, 2].max())


def _plain(tall: float, style: ModelingStyle) -> Part:
    """A nipple from the outlet up."""
    return piece(
        [cylinder(0.0068, 0.0, tall, fine_sides(0.0068, style)), hexagon(0.022, 0.3 * tall, 0.6 * tall)], STEM, "trim"
    )


def _styled(design: str, style: ModelingStyle, rng: np.random.Generator) -> Model:
    tall = float(rng.uniform(0.02, 0.09))
    return Model([_plain(tall, style), *standing(tall, style, rng, design)], kind=_KIND)


def _safety(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A safety-pattern gauge (EN 837-1 S3): deep case, solid front, blow-out back on spacers."""
    return _styled("safety", style, rng)


def _bayonet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A process gauge in stainless steel with a bayonet ring (EN 837-1, 100 and 160 mm as a rule)."""
    return _styled("bayonet", style, rng)


def _cast(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A heavy brass or iron gauge with a screwed, hinged ring, on a gauge cock with a lever (DIN 16262)."""
    tall, n = float(rng.uniform(0.05, 0.08)), fine_sides(0.012, style)
    cock = [cylinder(0.0068, 0.0, tall, n), along("x", turned([(0.014, -0.022), (0.01, 0.022)], n), 0, 0, 0.5 * tall)]
    cock.append(hexagon(0.026, 0.7 * tall, tall))
    bar = rod((-0.026, 0, 0.5 * tall), (-0.026, 0.05, 0.5 * tall - 0.02), 0.004, 8)
    parts = [piece([*cock, bar], STEM, "trim")]
    return Model([*parts, *standing(tall, style, rng, "cast")], kind=_KIND)


def _turret(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A phenolic turret-case gauge with a screwed ring and a flange at its back (ASME B40.100, 4 1/2 in)."""
    tall = float(rng.uniform(0.02, 0.09))
    return Model(
        [_plain(tall, style), *standing(tall, style, rng, "turret", float(rng.choice([0.1, 0.115])))], kind=_KIND
    )


def _filled(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A liquid-filled gauge: crimped ring, domed window, a rubber plug on top, often in a rubber boot."""
    size, tall = float(rng.choice([0.04, 0.05, 0.063, 0.1])), float(rng.uniform(0.015, 0.05))
    n, deep = style.round(size / 2), 0.5 * size
    solid, w = case_of(size, deep, "crimped", style)
    floor = 0.82 * deep
    plug = moved(
        cylinder(0.12 * size, -0.02 * size, 0.08 * size, 12), at(0, 0.5 * size, 0.4 * deep) @ spun("x", -np.pi / 2)
    )
    head = [piece(solid, CASE, "gauge"), piece(face_of(w, floor, style, rng), "gauge face", "dial", CASE)]
    head.append(pointer(needle_of(w, floor + 0.001, rng)))
    head.append(piece(dome(0.98 * w, 0.2 * w, 0.94 * deep, n), "gauge glass", "dial", CASE))
    if rng.random() < 0.5:
        head.append(piece(plug, CASE, "rubber"))
    else:  # a boot with two fat rims
        boot = ring(0.51 * size, 0.58 * size, 0.05 * deep, 0.9 * deep, n)
        rims = [moved(torus(0.57 * size, 0.05 * size, n, 6), at(0, 0, z * deep)) for z in (0.12, 0.85)]
        head.append(piece([boot, *rims], CASE, "rubber"))
    foot = shank(tall - 0.004, tall + 0.03, style, rng, size)
    return Model([_plain(tall, style), foot, *upright(fronted(head), size, tall + 0.028)], kind=_KIND)


def _contact(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A contact gauge: a deep ring, a setting lock in the middle of its window, a junction box at its side."""
    size, tall = float(rng.choice([0.1, 0.16])), float(rng.uniform(0.02, 0.08))
    head = dial(size, style, rng, str(rng.choice(["plain", "bayonet", "safety"])), 0.6 * size)
    deep = _depth(head)
    n = style.round(size / 2)
    head = [p for p in head if p.name != "gauge glass"]
    head.append(piece(cylinder(0.445 * size, 0.93 * deep, 0.95 * deep, n), "gauge glass", "dial", CASE))
    head = fronted(head)
    lock = [
        cylinder(0.09 * size, 0.94 * deep, 1.06 * deep, 12),
        box((0.1 * size, 0.02 * size, 0.02), (0, 0, 1.06 * deep)),
    ]
    head.append(piece(lock, CASE, "trim"))
    wide = float(rng.uniform(0.35, 0.55)) * size
    cable = along("-y", gland(style, rng, 0.016), 0.5 * size + 0.5 * wide, -0.25 * size, 0.4 * deep)
    crate = extrude(rounded_rectangle(wide, 0.5 * size, 0.06 * size, 3), 0.12 * deep, 0.7 * deep)
    head.append(piece([moved(crate, at(0.48 * size + 0.5 * wide)), cable], CASE, "electrical"))
    foot = shank(tall - 0.004, tall + 0.04, style, rng, size)
    turn = float(rng.uniform(0, 6))
    return Model(
        [_plain(tall, style), *placed([foot], spun("z", turn)), *upright(head, size, tall + 0.038, turn)], kind=_KIND
    )


def _square(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge in a square case (96 or 72 mm, DIN 43700), its connection below."""
    side, tall = float(rng.choice([0.072, 0.096, 0.144])), float(rng.uniform(0.02, 0.08))
    head = indicator(side, side, float(rng.uniform(0.35, 0.6)) * side, style, rng)
    foot = shank(tall - 0.004, tall + 0.04, style, rng, side)
    return Model([_plain(tall, style), foot, *upright(head, side, tall + 0.037)], kind=_KIND)


def _smart(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A digital gauge with a rectangular head: a screen, keys, a bumper, on a hexagon."""
    wide, tall = float(rng.uniform(0.07, 0.12)), float(rng.uniform(0.09, 0.16))
    deep, low = float(rng.uniform(0.03, 0.05)), float(rng.uniform(0.03, 0.07))
    outline = rounded_rectangle(wide, tall, 0.12 * wide, 3)
    screen = box((0.75 * wide, 0.4 * tall, 0.0015), (0, 0.2 * tall, deep + 0.00075))
    count = int(rng.integers(2, 5))
    keys = [
        moved(cylinder(0.07 * wide, deep, deep + 0.003, 10), at(x * wide, -y * tall))
        for x in np.linspace(-0.3, 0.3, count)
        for y in ((0.25,) if rng.random() < 0.5 else (0.15, 0.33))
    ]
    head = [piece(extrude(outline, 0, deep), CASE, "electrical"), piece(screen, "gauge glass", "dial", CASE)]
    head.append(piece(keys, CASE, "rubber"))
    if rng.random() < 0.5:
        bumper = extrude(1.08 * outline, 0.2 * deep, 0.8 * deep, (0.995 * outline,))
        head.append(piece(bumper, CASE, "safety"))
    stem = piece([cylinder(0.0068, 0, low, 12), hexagon(0.027, 0.5 * low, low + 0.002)], STEM, "trim")
    return Model([stem, *upright(fronted(head), tall, low + 0.001)], kind=_KIND)


def _sealed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge on a flanged diaphragm seal, maybe with a finned cooling tower (ASME B16.5 flange, EN 837-1 gauge)."""
    thick, n = plate_thickness(dn), style.round(0.03)
    r = 0.47 * PIPES[dn].outer + 0.012
    top = thick + float(rng.uniform(0.01, 0.025))
    seal = [disc_flange(dn, style, thick + 0.002), turned([(1.1 * r, thick), (r, top), (0.012, top + 0.008)], n)]
    if rng.random() < 0.5:
        fins = [
            cylinder(0.016, top + 0.015 + 0.008 * k, top + 0.018 + 0.008 * k, n) for k in range(int(rng.integers(4, 9)))
        ]
        seal += fins
        high = top + 0.015 + 0.008 * len(fins)
    else:
        high = top + float(rng.uniform(0.02, 0.05))
        seal.append(moved(along("x", hexagon(0.008, 0.0, 0.012), 0.8 * r), at(0, 0, thick + 0.006)))
    seal.append(cylinder(0.008, top, high, n))
    return Model(headed([piece(seal, STEM, "trim"), *standing(high, style, rng)]), kind=_KIND)


def _duplex(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A duplex gauge: two connections side by side, two needles on one dial, on a twin nipple with two cocks."""
    size, tall = float(rng.choice([0.1, 0.15, 0.2])), float(rng.uniform(0.05, 0.1))
    head = dial(size, style, rng, str(rng.choice(["plain", "cast"])), 0.4 * size)
    head.append(pointer(needle_of(0.4 * size, 0.82 * 0.4 * size + 0.0045, rng), "handle"))
    apart = 0.22 * size
    span = (1 - np.sqrt(1 - (2 * apart / size / 1.0) ** 2 * 0.25 * 4)) * size / 2 if 2 * apart < size else 0.0
    parts = [piece([cylinder(0.0068, 0, 0.03, 12), box((2 * apart + 0.03, 0.024, 0.022), (0, 0, 0.035))], STEM, "trim")]
    for x in (-apart, apart):
        nut = along("x" if x > 0 else "-x", t_handle(0.04, 0.03), x + (0.009 if x > 0 else -0.009), 0, tall - 0.01)
        leg = merge(
            [
                cylinder(0.006, 0.04, tall + 0.01, 10),
            ]
        )
        body = box((0.02, 0.02, 0.03), (x, 0, tall - 0.01))
        parts.append(piece([moved(leg, at(x)), body, nut], STEM, "trim"))
        parts += placed([shank(tall, tall + 0.034 + span, style, rng, size)], at(x))
    return Model([*parts, *upright(head, size, tall + 0.03)], kind=_KIND)


def _manifold(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge on a block-and-bleed valve: a bar with one or two needle valves and a bleed plug (ASME B1.20.1 ends)."""
    side, tall = float(rng.uniform(0.025, 0.034)), float(rng.uniform(0.08, 0.14))
    body = [cylinder(0.01, 0.0, 0.03, 12), box((side, side, tall - 0.02), (0, 0, 0.01 + tall / 2))]
    wheel = around(cylinder(0.012, 0.04, 0.052, 8), 1) if rng.random() < 0.4 else t_handle(0.055, 0.05)
    body.append(along("x", merge([wheel, cylinder(0.006, 0.0, 0.045, 8)]), 0.48 * side, 0, 0.35 * tall))
    if rng.random() < 0.6:
        body.append(along("-x", t_handle(0.05, 0.04), -0.48 * side, 0, 0.65 * tall))
    body.append(along("-y", hexagon(0.012, 0.0, 0.018), 0, -0.48 * side, 0.7 * tall))
    return Model([piece(body, STEM, "trim"), *standing(tall, style, rng)], kind=_KIND)


GAUGE_BUILDS: tuple[Family, ...] = (
    gauge_family("gauge/safety pattern", _safety),
    gauge_family("gauge/bayonet", _bayonet),
    gauge_family("gauge/cock", _cast),
    gauge_family("gauge/turret", _turret),
    gauge_family("gauge/filled", _filled),
    gauge_family("gauge/contact", _contact),
    gauge_family("gauge/square", _square),
    gauge_family("gauge/screen", _smart),
    gauge_family("gauge/flanged seal", _sealed, "head", (25, 40, 50, 80, 100)),
    gauge_family("gauge/duplex", _duplex),
    gauge_family("gauge/block and bleed", _manifold),
)
