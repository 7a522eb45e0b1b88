"""Strainers with an upright pot: tee, basket, duplex, dirt separator, self-cleaning; along x from 0."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    bolting,
    family,
    lathe,
    mouth,
    necks,
    prism,
    swell_room,
)
from cadplants.family import Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import around, box, cylinder, dome, hexagon, rod, torus, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["POTS"]

_ME = "strainer"
_UP, _DOWN = spun("y", -np.pi / 2), spun("y", np.pi / 2)


def _own(solid: Solid, color: str = "valve") -> Part:
    return Part(solid, _ME, color, _ME)


def _tee_type(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A T strainer: a welded or cast tee with flanges in the line, a lid with handles on its upright mouth."""
    n, size = style.round(PIPES[dn].radius), FLANGES[dn]
    wide = float(rng.uniform(1.0, 1.5)) * 0.485 * size.hub
    length = max(size.outer, 2.6 * wide) + 2 * swell_room(dn)
    x, high = 0.5 * length, max(0.5 * size.outer, wide) + swell_room(dn) + 0.02
    plate, collar = plate_thickness(dn), max(0.5 * size.outer, 1.35 * wide + 0.015)
    low = -float(rng.uniform(1.0, 1.6)) * wide
    pot = turned(
        [(0.5 * wide, low - 0.3 * wide), (wide, low), (wide, high - plate), (collar, high - plate), (collar, high)], n
    )
    parts = [_own(merge([*necks(dn, style, length), moved(pot, at(x))]))]
    way = at(x, 0, high) @ _UP
    count = 8 if dn > 80 else 6
    seal = moved(lathe([(0.75 * collar, 0.0), (0.75 * collar, 0.002)], n), way)
    parts.append(Part(seal, "gasket", "gasket", _ME))
    parts.append(_own(moved(lathe([(collar, 0.002), (collar, 0.002 + plate)], n), way)))
    parts += bolting(count, 0.86 * collar, 0.06 * collar + 0.006, -plate, plate + 0.002, style, _ME, way)
    for side in (-1, 1):
        a = np.linspace(0, np.pi, 7)
        top = high + plate
        path = np.column_stack([x + 0.05 * np.cos(a), np.full(7, side * 0.3 * collar), top + 0.045 * np.sin(a)])
        handle = merge([rod(p, q, 0.006, 8) for p, q in zip(path[:-1], path[1:], strict=True)])
        parts.append(_own(handle, "handle"))
    drain = moved(lathe([(0.014, 0.0), (0.014, 0.05)], 12), at(x, 0, low - 0.25 * wide) @ _DOWN)
    plug = moved(prism(0.03, 6, 0.05, 0.065), at(x, 0, low - 0.25 * wide) @ _DOWN)
    return Model([*parts, _own(drain), Part(plug, "pipe cap", "trim", _ME)], round(length, 9))


def _quick_basket(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A basket strainer on three legs: a tall pot, a lid under swing bolts or a yoke with a hand screw."""
    r, size = PIPES[dn].radius, FLANGES[dn]
    pot = float(rng.uniform(1.8, 2.6)) * r + 0.03
    n = style.round(pot)
    length = 2 * pot + 2 * swell_room(dn) + 0.04
    x, high = 0.5 * length, max(1.4 * r, 0.5 * size.outer) + 0.04
    low, thick = -float(rng.uniform(2.2, 3.6)) * pot, 0.012 + 0.06 * pot
    shell = [(0.3 * pot, low - 0.3 * pot), (0.8 * pot, low - 0.18 * pot), (pot, low), (pot, high - thick)]
    shell += [(1.22 * pot, high - thick), (1.22 * pot, high)]
    out = mouth("flanged", dn, style, 0.4 * pot, 0.5 * length)
    body = [moved(turned(shell, n), at(x)), moved(out, at(x)), moved(out, at(x) @ spun("z", np.pi))]
    parts = [_own(merge(body), "tank")]
    lid = [turned([(1.22 * pot, high), (1.22 * pot, high + thick)], n)]
    if rng.random() < 0.5:
        lid.append(dome(0.85 * pot, 0.3 * pot, high + 0.9 * thick, n))
    parts.append(_own(moved(merge(lid), at(x)), "tank"))
    if rng.random() < 0.55:
        one = merge(
            [
                cylinder(0.03 * pot + 0.004, high - 2 * thick, high + 1.8 * thick, 8),
                moved(
                    torus(0.09 * pot + 0.008, 0.025 * pot + 0.003, 12, 6),
                    at(0, 0, high + 1.8 * thick + 0.1 * pot) @ spun("x", np.pi / 2),
                ),
            ]
        )
        eye = around(one, int(rng.choice([4, 6])), 1.16 * pot, 0.4)
        parts.append(Part(moved(eye, at(x)), "bolt", "fastener", _ME, BOLTED, True))
    else:
        top = high + thick + 0.3 * pot
        beam = box((0.22 * pot, 2.7 * pot, 0.18 * pot), (x, 0, top + 0.25 * pot))
        posts = [
            box(
                (0.2 * pot, 0.1 * pot, top + 0.25 * pot - high + 2 * thick),
                (x, s * 1.3 * pot, 0.5 * (top + 0.25 * pot + high - 2 * thick)),
            )
            for s in (-1, 1)
        ]
        screw = cylinder(0.07 * pot, high + thick, top + 0.7 * pot, 10)
        bar = rod((x - 0.6 * pot, 0, top + 0.65 * pot), (x + 0.6 * pot, 0, top + 0.65 * pot), 0.04 * pot, 8)
        parts.append(_own(merge([beam, *posts, moved(screw, at(x)), bar]), "handle"))
    legs = merge(
        [
            box((0.05, 0.008, 0.9 * pot + 0.1), (0, 0, low - 0.45 * pot - 0.0)),
            box((0.09, 0.09, 0.01), (0, 0, low - 0.9 * pot - 0.055)),
        ]
    )
    for k in range(3):
        turn = at(x) @ spun("z", 0.5 + 2 * np.pi * k / 3) @ at(pot)
        parts.append(Part(moved(legs, turn), "tank leg", "steel", _ME, "Tank"))
    return Model(parts, round(length, 9))


def _duplex(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A duplex strainer: two pots beside the line, a change-over valve with a lever, lids with T screws."""
    r = PIPES[dn].radius
    pot = float(rng.uniform(1.6, 2.1)) * r + 0.025
    n = style.round(pot)
    length = max(3.0 * pot, 2.6 * r + 0.06) + 2 * swell_room(dn)
    x, gap = 0.5 * length, 1.35 * pot + 1.1 * r
    high, low = 1.2 * r + 0.35 * pot + 0.02, -2.4 * pot
    body = [*necks(dn, style, length), lathe([(1.5 * r, x - 1.3 * r), (1.5 * r, x + 1.3 * r)], n)]
    body[2] = moved(cylinder(1.6 * r + 0.01, -1.5 * r, high + 0.2 * pot, n), at(x))
    cross = moved(lathe([(1.1 * r, -gap), (1.1 * r, gap)], n), at(x) @ spun("z", np.pi / 2))
    parts = [_own(merge([*body, cross]))]
    for side in (-1, 1):
        shell = [
            (0.5 * pot, low - 0.2 * pot),
            (pot, low),
            (pot, high - 0.15 * pot),
            (1.2 * pot, high - 0.15 * pot),
            (1.2 * pot, high),
        ]
        where = at(x, side * gap)
        parts.append(_own(moved(turned(shell, n), where)))
        lid = [turned([(1.2 * pot, high), (1.2 * pot, high + 0.14 * pot), (0.4 * pot, high + 0.3 * pot)], n)]
        bar = rod((-0.6 * pot, 0, high + 0.75 * pot), (0.6 * pot, 0, high + 0.75 * pot), 0.06 * pot, 8)
        lid += [cylinder(0.1 * pot, high + 0.2 * pot, high + 0.8 * pot, 8), bar]
        parts.append(_own(moved(merge(lid), where)))
        plug = hexagon(0.5 * pot, low - 0.38 * pot, low - 0.2 * pot)
        parts.append(Part(moved(plug, where), "pipe cap", "trim", _ME))
    top = high + 0.2 * pot
    stem = cylinder(0.25 * r + 0.004, top, top + 0.5 * r + 0.03, 10)
    turn = pick(rng, 0.5, -0.5, 0.25) * np.pi
    lever = merge(
        [
            cylinder(0.5 * r + 0.008, top + 0.3 * r + 0.01, top + 0.5 * r + 0.03, 12),
            box((0.18 + 3 * r, 0.03 + 0.2 * r, 0.012), (0.09 + 1.5 * r, 0, top + 0.4 * r + 0.02)),
        ]
    )
    parts += [
        _own(moved(stem, at(x)), "trim"),
        Part(moved(lever, at(x) @ spun("z", turn)), "lever", "handle", "", "Valve assembly"),
    ]
    return Model(parts, round(length, 9))


def _separator(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dirt separator: an upright vessel with dished ends across the line, a drain cock, a vent or plug."""
    r, size = PIPES[dn].radius, FLANGES[dn]
    pot = float(rng.uniform(1.7, 2.3)) * r + 0.02
    n = style.round(pot)
    length = 2 * pot + 2 * swell_room(dn) + float(rng.uniform(0.02, 0.1))
    x, tall, deep = (
        0.5 * length,
        float(rng.uniform(1.0, 2.2)) * pot + 0.4 * size.outer,
        float(rng.uniform(1.5, 3.5)) * pot,
    )
    a = np.linspace(0, np.pi / 2, 6)
    bottom = [(max(0.05, np.sin(t)) * pot, -deep - 0.5 * pot * np.cos(t)) for t in a]
    top = [(max(0.05, np.cos(t)) * pot, tall + 0.5 * pot * np.sin(t)) for t in a]
    parts = [_own(merge([*necks(dn, style, length), moved(turned([*bottom, *top], n), at(x))]), "tank")]
    if rng.random() < 0.5:
        collar = [turned([(1.25 * pot, -deep * 0.6), (1.25 * pot, -deep * 0.6 + 0.03)], n)]
        parts[0] = _own(merge([parts[0].solid, moved(collar[0], at(x))]), "tank")
        way = at(x, 0, -deep * 0.6 + 0.015) @ _UP
        parts += bolting(12, 1.17 * pot, 0.012, -0.015, 0.015, style, _ME, way)
    low = -deep - 0.48 * pot
    drain = merge([cylinder(0.012, low - 0.05, low, 10), hexagon(0.03, low - 0.075, low - 0.045)])
    parts.append(Part(moved(drain, at(x)), "valve body", "trim", _ME, "Valve assembly"))
    lever = box((0.09, 0.018, 0.004), (x + 0.04, 0.02, low - 0.06))
    parts.append(Part(lever, "lever", "handle", _ME, "Valve assembly"))
    high = tall + 0.48 * pot
    vent = (
        cylinder(0.02, high + 0.02, high + 0.07, 12)
        if rng.random() < 0.5
        else hexagon(0.035, high + 0.012, high + 0.03)
    )
    parts.append(Part(moved(merge([vent, cylinder(0.01, high, high + 0.022, 10)]), at(x)), "nipple", "trim", _ME))
    return Model(parts, round(length, 9))


def _self_cleaning(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A self-cleaning strainer: a housing with a bolted head, a gear motor on it and a flush outlet below."""
    r, size = PIPES[dn].radius, FLANGES[dn]
    pot = float(rng.uniform(1.9, 2.6)) * r + 0.04
    n = style.round(pot)
    length = 2 * pot + 2 * swell_room(dn) + 0.05
    x, plate = 0.5 * length, 0.018 + 0.05 * pot
    low, high = -float(rng.uniform(1.6, 2.6)) * pot, max(1.3 * r, 0.5 * size.outer) + 0.05
    cone = 0.7 * pot
    shell = [(0.25 * pot, low - cone - 0.08), (0.25 * pot, low - cone), (pot, low), (pot, high - plate)]
    shell += [(1.2 * pot, high - plate), (1.2 * pot, high)]
    parts = [_own(merge([*necks(dn, style, length), moved(turned(shell, n), at(x))]), "tank")]
    way = at(x, 0, high) @ _UP
    lid = lathe([(1.2 * pot, 0.0), (1.2 * pot, plate), (0.4 * pot, 1.4 * plate)], n)
    parts.append(_own(moved(lid, way), "tank"))
    parts += bolting(12 if dn > 80 else 8, 1.1 * pot, 0.012 + 0.02 * pot, -plate, plate, style, _ME, way)
    q, base = 0.35 * pot + 0.02, high + 1.4 * plate
    gear = merge(
        [cylinder(0.7 * q, base, base + 0.5 * q, 14), box((2.0 * q, 1.8 * q, 1.2 * q), (0, 0, base + 1.1 * q))]
    )
    parts.append(Part(moved(gear, at(x)), "gearbox", "motor", "", "Valve assembly"))
    tall = float(rng.uniform(2.0, 3.2)) * q
    motor = merge(
        [
            cylinder(0.85 * q, base + 1.7 * q, base + 1.7 * q + tall, 20),
            cylinder(0.9 * q, base + 1.7 * q + tall, base + 2.1 * q + tall, 20),
        ]
    )
    fins = around(box((0.12 * q, 0.05 * q, 0.8 * tall), (0, 0, base + 1.7 * q + 0.45 * tall)), 16, 0.87 * q)
    parts.append(Part(moved(merge([motor, fins]), at(x)), "motor", "motor", "", "Pump unit"))
    parts.append(
        Part(
            moved(box((0.8 * q, 0.6 * q, 0.8 * q), (1.1 * q, 0, base + 1.7 * q + 0.5 * tall)), at(x)),
            "terminal box",
            "motor",
            "",
            "Pump unit",
        )
    )
    for k in range(int(rng.choice([0, 3, 4]))):
        turn = at(x) @ spun("z", 0.6 + 2 * np.pi * k / 4) @ at(0.97 * pot)
        leg = box((0.05, 0.05, cone + 0.3), (0, 0, low - 0.5 * cone - 0.1))
        parts.append(Part(moved(leg, turn), "tank leg", "steel", "", "Tank"))
    return Model(parts, round(length, 9))


_MIDDLE = tuple(dn for dn in SIZES if dn <= 200)

POTS: tuple[Family, ...] = tuple(
    family(f"strainer/{name}", build, sizes, "inline", weight, "structure")
    for name, build, sizes, weight in (
        ("tee", _tee_type, SIZES[3:], 1.0),
        ("basket on legs", _quick_basket, _MIDDLE[3:], 1.0),
        ("duplex", _duplex, _MIDDLE[2:], 1.0),
        ("dirt separator", _separator, _MIDDLE[3:], 1.0),
        ("self-cleaning", _self_cleaning, _MIDDLE[5:], 1.0),
    )
)
