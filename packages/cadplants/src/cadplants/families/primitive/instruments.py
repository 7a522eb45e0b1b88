"""Instruments of primitives: rods with discs, cylinders and boxes, siphons as bent bars."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import disc, family, lying, part, sized, torus_piece
from cadplants.family import Family, Model, Part, fronted, placed
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, cylinder, ring
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["PRIMITIVE_INSTRUMENTS", "case_parts"]

_GAUGE, _STEM, _CASE = "Gauge assembly", "gauge stem", "gauge case"


def case_parts(
    radius: float, style: ModelingStyle, rng: np.random.Generator, ringed: bool, detail: bool = True
) -> list[Part]:
    """A round case about z, its front towards +z: solid or a ring, with a face, a needle and a glass or without [m].

    Args:
        radius: of the case [m].
        style: that models it.
        rng: of its parts.
        ringed: whether the case is an open ring, with a back or without.
        detail: whether it may have more than its case.
    """
    deep, n = radius * num(rng, 0.35, 0.9), style.round(radius)
    wall = radius * num(rng, 0.06, 0.2)
    floor = 0.0
    if ringed:
        solids = [ring(radius - wall, radius, 0.0, deep, n)]
        if chance(rng, 0.6):
            floor = 0.2 * deep
            solids.append(cylinder(radius - 0.5 * wall, 0.0, floor, n))
        if chance(rng, 0.4):
            solids.append(ring(radius - wall, 1.06 * radius, 0.85 * deep, 1.04 * deep, n))
    else:
        solids = [cylinder(radius, 0.0, deep, n)]
        floor = deep
    parts = [part(_CASE, *solids, color="gauge", bundle=_CASE)]
    if not detail:
        return parts
    inner = radius - wall if ringed else 0.92 * radius
    thin = max(0.0008, 0.02 * radius)
    if ringed or chance(rng, 0.5):
        parts.append(part("gauge face", cylinder(inner, floor, floor + thin, n), color="dial", bundle=_CASE))
    if chance(rng, 0.6):
        bar = moved(box((0.9 * inner, 0.06 * inner, thin), (0.3 * inner, 0, 0)), spun("z", num(rng, 0, 2 * np.pi)))
        hub = cylinder(0.09 * inner, -0.5 * thin, 1.5 * thin, 8)
        needle = moved(merge([bar, hub]), at(0, 0, floor + 2 * thin))
        parts.append(part("gauge needle", needle, color="needle", bundle=_CASE))
    if chance(rng, 0.6):
        low = max(0.85 * deep if ringed else floor, floor + 3.6 * thin)
        parts.append(part("gauge glass", cylinder(inner, low, low + 1.5 * thin, n), color="dial", bundle=_CASE))
    return fronted(parts)


def _upright(parts: list[Part], height: float, deep: float, rng: np.random.Generator) -> list[Part]:
    """A case about z turned to look level, its axis at a height [m]."""
    return placed(parts, spun("z", num(rng, 0, 2 * np.pi)) @ at(0, deep, height) @ spun("x", np.pi / 2))


def _stem(height: float, style: ModelingStyle, rng: np.random.Generator) -> Part:
    """A rod up from z = 0, at times with a square or a six-sided piece [m]."""
    r = num(rng, 0.005, 0.011)
    solids = [cylinder(r, 0.0, height, min(style.round(r), 12))]
    kind = int(rng.integers(4))
    if kind == 1:
        solids.append(cylinder(1.8 * r, 0.1 * height, 0.35 * height, 6))
    elif kind == 2:
        solids.append(box((2.6 * r, 2.6 * r, 0.35 * height), (0, 0, 0.6 * height)))
    return part(_STEM, *solids, color="trim", bundle=_STEM)


def _gauge(_: int, style: ModelingStyle, rng: np.random.Generator, ringed: bool = False) -> Model:
    """A rod and a round case upright on it."""
    radius, rise = pick(rng, 0.025, 0.0315, 0.05, 0.05, 0.08), num(rng, 0.02, 0.1)
    case = _upright(
        case_parts(radius, style, rng, ringed, ringed or chance(rng, 0.5)), rise + radius, 0.3 * radius, rng
    )
    return Model([_stem(rise + 0.1 * radius, style, rng), *case], kind="pressure gauge")


def _path(kind: str, reach: float, high: float) -> Floats:
    """The middle line of a siphon from the origin up [m]."""
    if kind == "pigtail":
        turns = np.linspace(np.pi, -np.pi, 17)
        low = 0.3 * high + reach
        loop = np.column_stack(
            [reach + reach * np.cos(turns), np.linspace(0, 0.8 * reach, 17), low + reach * np.sin(turns)]
        )
        return np.vstack([[(0.0, 0.0, 0.0)], loop, [(0.0, 0.8 * reach, low + reach + 0.4 * high)]])
    first = np.linspace(np.pi, 0.0, 7)
    over = np.column_stack([reach + reach * np.cos(first), np.zeros(7), high + reach * np.sin(first)])
    second = np.linspace(np.pi, 2 * np.pi, 7)
    under = np.column_stack([3 * reach + reach * np.cos(second), np.zeros(7), 0.4 * high + reach * np.sin(second)])
    return np.vstack([[(0.0, 0.0, 0.0)], over, under, [(4 * reach, 0.0, 1.3 * high)]])


def _siphon(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str = "u") -> Model:
    """A bent bar as a siphon, with a gauge of a rod and a case on its end, or only a screwed end."""
    r = num(rng, 0.005, 0.0105)
    path = _path(kind, r * num(rng, 3.0, 5.5), num(rng, 0.08, 0.2))
    n = min(style.round(r), 16)
    solids = [torus_piece(path, r, n, 0.7 * r if style.hollow else 0.0)]
    x, y, z = (float(v) for v in path[-1])
    if chance(rng, 0.5):
        solids.append(moved(cylinder(1.7 * r, -0.02, 0.0, 6), at(x, y, z)))
    parts = [part("siphon", *solids, color="trim", bundle="siphon")]
    gauge = _gauge(15, style, rng, chance(rng, 0.5))
    # A hair of air or of overlap, as screwed pieces are drawn.
    return Model([*parts, *placed(gauge.parts, at(x, y, z + pick(rng, 0.0, 0.0, -0.004)))], kind="pressure gauge")


def _transmitter(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rod with a level cylinder or a box on it."""
    rise, size = num(rng, 0.03, 0.12), num(rng, 0.03, 0.06)
    if chance(rng, 0.6):
        head = lying(disc(size, -1.1 * size, 1.1 * size, style), 0, 0, rise + size)
    else:
        head = box((2 * size, 1.4 * size, 2 * size), (0, 0, rise + size))
    whole = merge([head, box((1.6 * size, 1.2 * size, 0.5 * rise), (0, 0, 0.6 * rise))]) if chance(rng, 0.4) else head
    name = "transmitter"
    rod = _stem(rise + 0.2 * size, style, rng)
    return Model([rod, part(name, whole, color="gauge", bundle=name)], kind="pressure transmitter")


def _thermowell(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rod with a short wide cylinder or a dome-less head across it."""
    rise, size = num(rng, 0.05, 0.18), num(rng, 0.025, 0.045)
    rod = disc(num(rng, 0.006, 0.012), 0.0, rise, style)
    turn = pick(rng, 0.0, 0.3, 0.5) * np.pi
    head = moved(disc(size, 0.0, 1.4 * size, style), at(0, 0, rise) @ spun("y", turn))
    if turn:
        head = moved(disc(size, -0.7 * size, 0.7 * size, style), at(0, 0, rise + 0.5 * size) @ spun("y", turn))
    return Model(
        [
            part("thermowell", rod, color="gauge", bundle="thermowell"),
            part("transmitter", head, color="gauge", bundle="thermowell"),
        ]
    )


def _meter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cylinder along the line with a box or a cylinder on a neck."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 0.8, 1.6) + 0.04, 6)
    wide = r * num(rng, 1.0, 1.5)
    body = lying(disc(wide, 0.0, length, style))
    size = num(rng, 0.04, 0.09)
    neck = disc(0.35 * size, 0.0, wide + size, style)
    top = wide + 1.6 * size
    head = box((2 * size, 1.5 * size, 1.6 * size), (0, 0, top))
    if chance(rng, 0.5):
        head = lying(disc(0.8 * size, -size, size, style), 0, 0, top)
    parts = [part("flow meter", body, color="gauge", bundle="flow meter")]
    upper = moved(merge([neck, head]), at(length / 2))
    parts.append(part("transmitter", upper, color="gauge", bundle="flow meter"))
    return Model(parts, length, kind="flow meter")


def _sight(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cylinder along the line with a short one across."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 0.8, 1.3), 6)
    across = moved(disc(0.9 * r, -1.5 * r, 1.5 * r, style), at(length / 2) @ spun("x", np.pi / 2))
    solid = merge([lying(disc(r * num(rng, 1.0, 1.3), 0.0, length, style)), across])
    return Model([part("sight glass", solid, color="gauge", bundle="sight glass")], length, kind="sight glass")


def _level(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An upright rod or box beside two level stubs, on a plate or a post."""
    high, r = num(rng, 0.4, 1.5), num(rng, 0.012, 0.03)
    low = num(rng, 0.2, 0.8)
    column = disc(r, low, low + high, style) if chance(rng, 0.6) else box((2 * r, 3 * r, high), (0, 0, low + high / 2))
    arms = [lying(disc(0.6 * r, -0.2, 0.0, style), 0, 0, low + share * high) for share in (0.1, 0.9)]
    post = box((0.05, 0.05, low + high + 0.1), (-0.225, 0, (low + high + 0.1) / 2))
    post_part = part("post", post, color="steel", group="Structural element")
    return Model(
        [part("level gauge", column, *arms, color="gauge", bundle="level gauge"), post_part], kind="level gauge"
    )


PRIMITIVE_INSTRUMENTS: tuple[Family, ...] = (
    family("gauge/rod and disc", "tap", _GAUGE, _gauge, weight=3),
    family("gauge/ring case", "tap", _GAUGE, partial(_gauge, ringed=True), weight=2),
    family("siphon/bent bar", "tap", _GAUGE, _siphon, "gauge"),
    family("siphon/looped bar", "tap", _GAUGE, partial(_siphon, kind="pigtail"), "gauge"),
    family("transmitter/cylinder or box", "tap", _GAUGE, _transmitter, weight=1.5),
    family("thermowell/rod", "tap", _GAUGE, _thermowell, "thermowell"),
    family("flow meter/cylinder", "inline", _GAUGE, _meter, sizes=sized(15, 300), weight=2),
    family("sight glass/crossed cylinders", "inline", _GAUGE, _sight, weight=0.6),
    family("level gauge/rod", "floor", _GAUGE, _level),
)
