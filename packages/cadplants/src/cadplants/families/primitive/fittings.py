"""Fittings of primitives: cones, crossed cylinders, discs, pieces of a torus."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import (
    cone,
    disc,
    dish,
    family,
    lying,
    part,
    pipe_piece,
    sized,
    sleeve,
    torus_piece,
)
from cadplants.family import Family, Model
from cadplants.mesh_ops import Solid, loft, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import ball, cylinder, torus
from cadplants.standards import ELBOW_LONG_RADIUS, FLANGES, PIPES, REDUCER_LENGTH, TEE_CENTER_TO_END, smaller
from cadplants.transforms import arc, at, spun

__all__ = ["PRIMITIVE_FITTINGS"]

_PIPE = "Pipe assembly"
_TAP_RADIUS = 0.03  # m: of a small pipe; outlets sink into it as far as their foot needs


def _one(name: str, length: float, *solids: Solid, joint: str = "welded", color: str = "pipe") -> Model:
    return Model([part(name, *solids, color=color, bundle=name)], length, joint)


def _reducer(dn: int, style: ModelingStyle, rng: np.random.Generator, eccentric: bool = False) -> Model:
    """A bare cone from one size to another, straight or with one flat side."""
    other = smaller(dn, int(rng.integers(1, 4)))
    first, last = PIPES[dn], PIPES[other]
    length = REDUCER_LENGTH[dn] * pick(rng, 0.6, 1.0, 1.0, 1.4)
    n, rise = style.round(first.radius), (first.radius - last.radius) * (1 if eccentric else 0)

    def ring_at(x: float, radius: float, lift: float) -> Floats:
        angles = np.arange(n) * 2 * np.pi / n
        return np.column_stack([np.full(n, x), radius * np.cos(angles), lift + radius * np.sin(angles)])

    ends = [ring_at(0.0, first.radius, 0.0), ring_at(length, last.radius, rise)]
    if style.hollow:
        inside = [ring_at(length, last.bore, rise), ring_at(0.0, first.bore, 0.0)]
        solid = weld([loft([*ends, *inside], closed=True)])
    else:
        middles = [ring.mean(axis=0, keepdims=True) for ring in ends]
        solid = weld([loft([middles[0], *ends, middles[1]])])
    return replace(_one("reducer", length, solid), dn=0 if eccentric else other)


def _tee(dn: int, style: ModelingStyle, rng: np.random.Generator, arms: int = 1) -> Model:
    """Crossed cylinders, each with closed ends, or a snout on a run: a tee or a cross in one mesh."""
    branch = smaller(dn, int(rng.integers(0, 3)))
    reach = TEE_CENTER_TO_END[dn]
    solids = [lying(pipe_piece(dn, 0.0, 2 * reach, style))]
    start = 0.0 if chance(rng, 0.5) else 0.8 * PIPES[dn].radius
    for turn in (0.0, np.pi)[:arms]:
        arm = pipe_piece(branch, start, reach, style)
        if chance(rng, 0.3):
            arm = cone(PIPES[branch].radius * 1.25, PIPES[branch].radius, start, reach, style)
        solids.append(moved(arm, at(reach) @ spun("x", turn)))
    return _one("tee" if arms == 1 else "cross", 2 * reach, *solids)


def _screwed(dn: int, style: ModelingStyle, rng: np.random.Generator, arms: int = 1) -> Model:
    """A ball with thick screwed ends on three or four sides; some ends are six- or eight-sided."""
    r = PIPES[dn].radius
    reach, end = round(r * num(rng, 2.0, 2.8) + 0.008, 6), r * num(rng, 1.25, 1.5)
    sides, band = pick(rng, 6, 8, style.round(end)), r * num(rng, 0.8, 1.2)
    solids = [lying(disc(1.1 * r, 0.0, 2 * reach, style)), moved(ball(1.35 * r, style.round(1.35 * r)), at(reach))]
    solids += [lying(cylinder(end, 0.0, band, sides)), lying(cylinder(end, 2 * reach - band, 2 * reach, sides))]
    for turn in (0.0, np.pi)[:arms]:
        upright = merge([disc(1.1 * r, 0.0, reach, style), cylinder(end, reach - band, reach, sides)])
        solids.append(moved(upright, at(reach) @ spun("x", turn)))
    return _one("tee" if arms == 1 else "cross", 2 * reach, *solids)


def _coupling(dn: int, style: ModelingStyle, rng: np.random.Generator, name: str = "coupling") -> Model:
    """A short thicker cylinder, round or six-sided; of a union, three in a row."""
    r = PIPES[dn].radius
    length, wide = round(r * num(rng, 1.2, 3.0) + 0.01, 6), r * num(rng, 1.15, 1.5)
    sides = pick(rng, 6, 8, style.round(wide), style.round(wide))
    if name == "coupling":
        return _one(name, length, lying(cylinder(wide, 0.0, length, sides)))
    nut = cylinder(1.25 * wide, 0.3 * length, 0.7 * length, pick(rng, 6, 8, style.round(wide)))
    return _one(name, length, lying(cylinder(wide, 0.0, length, sides)), lying(nut))


def _cap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cylinder with a flat or dished end, or a dish alone."""
    r = PIPES[dn].radius
    wide, skirt = r * pick(rng, 1.0, 1.0, 1.15), r * num(rng, 0.2, 1.0)
    if chance(rng, 0.4):
        return _one("pipe cap", 0.0, lying(dish(r, 0.55 * r, 0.0, style)))
    solids = [lying(disc(wide, 0.0, skirt, style))]
    if chance(rng, 0.5):
        solids.append(lying(dish(wide, 0.5 * wide, skirt, style)))
    return _one("pipe cap", 0.0, *solids)


def _elbow(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A piece of a torus at the end of a line, 45 or 90 degrees or a return."""
    size, radius = PIPES[dn], ELBOW_LONG_RADIUS[dn] * pick(rng, 0.67, 1.0, 1.0)
    radius = max(radius, 1.05 * size.radius)
    turn = pick(rng, 0.25, 0.5, 0.5) * np.pi
    reach = radius * float(np.tan(turn / 2))
    last = (reach + reach * float(np.cos(turn)), reach * float(np.sin(turn)), 0.0)
    steps = max(2, round(style.round(size.radius) * turn / (2 * np.pi)))
    path = arc((0.0, 0.0, 0.0), (reach, 0.0, 0.0), last, steps)
    bore = size.bore if style.hollow and size.bore < radius else 0.0
    solid = torus_piece(path, size.radius, style.round(size.radius), bore)
    return _one("elbow", 0.0, moved(solid, spun("x", num(rng, 0, 2 * np.pi))))


def _blind(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plain disc as wide as a flange on a flange; at times with a low boss."""
    size = FLANGES[dn]
    thick = size.thickness * num(rng, 0.7, 1.4)
    solids = [lying(disc(size.outer / 2, 0.0, thick, style))]
    if chance(rng, 0.25):
        solids.append(lying(disc(size.raised / 2 * 0.7, thick, 1.4 * thick, style)))
    return _one("blind flange", 0.0, *solids, color="flange")


def _strainer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A run with a slanted or upright cylinder out of its side."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 1.1, 1.7), 6)
    wide = r * num(rng, 1.0, 1.4)
    turn = pick(rng, 0.75, 0.75, 1.0) * np.pi
    leg = merge([disc(wide, 0.0, 3.2 * r + 0.03, style), disc(1.35 * wide, 3.2 * r, 3.5 * r + 0.04, style)])
    body = disc(wide, 0.0, length, style) if chance(rng, 0.6) else cone(wide, 1.3 * wide, 0, length, style)
    solids = [lying(body), moved(leg, at(length / 2) @ spun("y", turn))]
    return _one("strainer", length, *solids, joint="flanged", color="valve")


def _bellows(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thicker cylinder, a row of discs, or a row of rings between two ends."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 0.7, 1.4), 6)
    core = lying(sleeve(PIPES[dn].bore, r, 0.0, length, style))
    kind, wide = int(rng.integers(3)), r * num(rng, 1.2, 1.6)
    if kind == 0:
        return _one(
            "expansion joint", length, core, lying(disc(wide, 0.2 * length, 0.8 * length, style)), joint="flanged"
        )
    places = np.linspace(0.25, 0.75, int(rng.integers(3, 8))) * length
    thick = 0.25 * (places[1] - places[0])
    sides = min(style.round(wide), 24)
    rings = [
        disc(wide, float(z) - thick, float(z) + thick, style)
        if kind == 1
        else moved(torus(r + thick, thick, sides, 6), at(0, 0, float(z)))
        for z in places
    ]
    return _one("expansion joint", length, core, *(lying(one) for one in rings), joint="flanged")


def _snout(style: ModelingStyle, rng: np.random.Generator) -> tuple[Solid, float]:
    """A branch outlet on z = 0, sunk a little, and its height [m]: a cone, a cylinder or one with a flared foot."""
    foot = min(num(rng, 0.010, 0.03), 0.85 * _TAP_RADIUS)
    high, sunk, kind = num(rng, 0.015, 0.06), 0.6 * foot**2 / _TAP_RADIUS + 0.0005, int(rng.integers(3))
    top = foot * num(rng, 0.5, 0.9)
    if kind == 0:
        return cone(foot, top, -sunk, high, style), high
    if kind == 1:
        return disc(top, -sunk, high, style), high
    outline = [(0.0, -sunk), (foot, -sunk), (foot, 0.1 * high), (top, 0.45 * high), (top, high), (0.0, high)]
    return weld([revolve(outline, style.round(foot))]), high


def _outlet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A snout on an outlet, with a plug, a piece of pipe or a blank disc on it."""
    solid, high = _snout(style, rng)
    top = float(np.hypot(*solid.vertices[solid.vertices[:, 2] > high - 1e-9][:, :2].T).max())
    parts = [part("branch outlet", solid, color="pipe", bundle="branch outlet")]
    kind = int(rng.integers(4))
    if kind == 0:
        parts.append(part("pipe", disc(0.9 * top, high, high + num(rng, 0.05, 0.4), style), color="pipe"))
    elif kind == 1:
        parts.append(part("pipe cap", disc(1.2 * top, high, high + 1.2 * top, style), color="pipe"))
    elif kind == 2:
        parts.append(part("blind flange", disc(2.6 * top, high, high + 0.8 * top, style), color="flange"))
    return Model(parts)


def _flange_pair(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two discs with cones or cylinders for their hubs, back to back on a short neck, or one disc alone."""
    r, rim = PIPES[dn].radius, FLANGES[dn].outer / 2
    thick = FLANGES[dn].thickness
    length = round(3 * thick + num(rng, 0.02, 0.08), 6)
    hub = r * num(rng, 1.1, 1.4)
    if chance(rng, 0.5):
        hubs = [cone(hub, r, thick, 0.5 * length, style), cone(r, hub, 0.5 * length, length - thick, style)]
    else:
        hubs = [disc(hub, thick, 0.45 * length, style), disc(hub, 0.55 * length, length - thick, style)]
    first = merge([disc(rim, 0.0, thick, style), hubs[0]])
    last = merge([disc(rim, length - thick, length, style), hubs[1]])
    parts = [part("flange", lying(one), color="flange", bundle="flange") for one in (first, last)]
    parts.append(part("pipe", lying(pipe_piece(dn, 0.4 * length, 0.6 * length, style)), color="pipe", bundle="flange"))
    return Model(parts, length, split=True)


def _thin_flange(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Thin discs, one or two face to face, round a running pipe."""
    rim, count = FLANGES[dn].outer / 2 * num(rng, 0.8, 1.05), int(rng.integers(1, 3))
    thick = num(rng, 0.004, 0.02)
    length = round(0.06 + 2 * thick, 6)
    gap = pick(rng, 0.0, 0.0, 0.002, 0.004)
    parts = [part("pipe", lying(pipe_piece(dn, 0.0, length, style)), color="pipe", bundle="pipe")]
    for k in range(count):
        low = 0.03 + k * (thick + gap)
        bore = PIPES[dn].radius if style.hollow else 0.0
        parts.append(part("flange", lying(sleeve(bore, rim, low, low + thick, style)), color="flange", bundle="flange"))
    return Model(parts, length, "welded")


_SMALL = sized(15, 65)

PRIMITIVE_FITTINGS: tuple[Family, ...] = (
    family("reducer/bare cone", "inline", _PIPE, _reducer, sizes=sized(20, 400), weight=2),
    family("reducer/slanted cone", "inline", _PIPE, partial(_reducer, eccentric=True), sizes=sized(20, 400)),
    family("tee/crossed cylinders", "inline", _PIPE, _tee, weight=3),
    family("cross/crossed cylinders", "inline", _PIPE, partial(_tee, arms=2)),
    family("tee/ball with ends", "inline", _PIPE, _screwed, sizes=_SMALL),
    family("cross/ball with ends", "inline", _PIPE, partial(_screwed, arms=2), sizes=_SMALL),
    family("coupling/short cylinder", "inline", _PIPE, _coupling),
    family("union/three cylinders", "inline", _PIPE, partial(_coupling, name="union"), sizes=_SMALL),
    family("flange/disc and cone", "inline", _PIPE, _flange_pair, weight=1.5),
    family("flange/thin disc", "inline", _PIPE, _thin_flange, weight=1.2),
    family("strainer/slanted cylinder", "inline", _PIPE, _strainer, weight=0.7),
    family("expansion joint/discs", "inline", _PIPE, _bellows, weight=0.6),
    family("pipe cap/cylinder", "end", _PIPE, _cap, weight=2),
    family("elbow/piece of torus", "end", _PIPE, _elbow, weight=2),
    family("blind flange/plain disc", "head", _PIPE, _blind),
    family("branch outlet/snout", "tap", _PIPE, _outlet, weight=3),
)
