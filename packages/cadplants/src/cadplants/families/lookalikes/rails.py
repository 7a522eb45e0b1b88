"""Handrails of bent tube: like pipes with elbows, in one mesh or in single tubes."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import FRAME, disc, family, part, torus_piece
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import ball, box
from cadplants.transforms import arc, at

__all__ = ["RAILS_ALIKE"]


def _rounded(points: list[tuple[float, float, float]], bend: float, steps: int) -> Floats:
    """A path with its corners rounded to a radius [m]."""
    path = [np.array(points[:1], float)]
    for before, corner, after in zip(points[:-2], points[1:-1], points[2:], strict=True):
        a, p, b = (np.array(q, float) for q in (before, corner, after))
        first, last = (a - p) / np.linalg.norm(a - p), (b - p) / np.linalg.norm(b - p)
        turn = float(np.arccos(np.clip(-first @ last, -1, 1)))
        reach = bend * float(np.tan(turn / 2))
        path.append(arc(p + reach * first, p, p + reach * last, steps))
    path.append(np.array(points[-1:], float))
    joined = np.concatenate(path)
    keep = np.concatenate([[True], np.linalg.norm(np.diff(joined, axis=0), axis=1) > 1e-6])
    return np.asarray(joined[keep], np.float64)


def _tube(points: list[tuple[float, float, float]], r: float, style: ModelingStyle, bend: float = 0.0) -> Solid:
    """A bent tube, hollow where the style models bores [m]."""
    path = _rounded(points, bend, style.bend(bend + r)) if bend and len(points) > 2 else np.array(points, float)
    return torus_piece(path, r, min(style.round(r), 24), 0.85 * r if style.hollow else 0.0)


def _given(solids: list[Solid], one: bool, name: str = "railing") -> list[Part]:
    groups = [solids] if one else [[solid] for solid in solids]
    return [part(name, *some, color="safety", bundle="railing") for some in groups]


def _bent(_: int, style: ModelingStyle, rng: np.random.Generator, one: bool) -> Model:
    """Bows of tube from floor to floor, a top rail that turns round corners, knee rails that end at posts."""
    length, high, r = num(rng, 1.0, 4.0), num(rng, 0.9, 1.15), pick(rng, 0.0169, 0.021, 0.024, 0.03)
    bend = r * pick(rng, 2.5, 4.0, 6.0)
    side = pick(rng, 0.0, num(rng, 0.8, 2.0))
    corners = [(0.0, 0.0, 0.0), (0.0, 0.0, high), (length, 0.0, high)]
    corners += [(length, side, high), (length, side, 0.0)] if side else [(length, 0.0, 0.0)]
    solids = [_tube(corners, r, style, bend)]
    for x in np.linspace(0, length, int(length / 1.2) + 2)[1:-1]:
        solids.append(_tube([(float(x), 0.0, 0.0), (float(x), 0.0, high)], r, style))
    for share in (0.5,) if chance(rng, 0.7) else (0.35, 0.7):
        solids.append(_tube([(0.0, 0.0, share * high), (length, 0.0, share * high)], 0.9 * r, style))
        if side:
            solids.append(_tube([(length, 0.0, share * high), (length, side, share * high)], 0.9 * r, style))
    if chance(rng, 0.25):
        solids += [moved(ball(1.5 * r, 12), at(0, 0, share * high)) for share in (0.5, 0.98)]
    plates = []
    if chance(rng, 0.5):
        for x in (0.0, length):
            y = side if x else 0.0
            plates.append(part("base plate", moved(disc(2.6 * r, -0.01, 0.0, style), at(x, y)), color="steel"))
    return Model([*_given(solids, one), *plates])


def _lone(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A handrail of one bent tube: both ends turn down, back or to the wall; level, or slanted beside stairs."""
    length, slope, r = num(rng, 0.6, 3.5), pick(rng, 0.0, 0.0, 0.7), pick(rng, 0.0169, 0.021, 0.024)
    bend, end = r * pick(rng, 2.5, 4.0), num(rng, 0.16, 0.3)
    low = num(rng, 0.8, 1.1)
    top = low + slope * length
    way = pick(rng, "down", "wall", "back", "loop")
    off = {"down": (0.0, 0.0, -end), "wall": (0.0, end, 0.0), "back": (0.0, 0.0, -end), "loop": (0.0, 0.0, -end)}[way]
    first, last = (0.0, 0.0, low), (length, 0.0, top)
    corners = [(off[0], off[1], low + off[2]), first, last, (length + off[0], off[1], top + off[2])]
    if way == "loop":
        corners = [(0.5 * length, 0.0, (low + top) / 2 - end), corners[0], first, last, corners[-1]]
    solids = [_tube(corners, r, style, min(bend, 0.22 * end))]
    parts = _given(solids, True)
    for share in (0.2, 0.8):
        x, z = share * length, low + share * (top - low)
        if way == "wall":
            arm = _tube([(x, 0.0, z - r), (x, 0.0, z - 3 * r), (x, end, z - 3 * r)], 0.4 * r, style)
            parts.append(part("bracket", arm, color="steel", group="Connection assembly"))
        else:
            parts.append(part("post", _tube([(x, 0.0, 0.0), (x, 0.0, z)], r, style), color="safety", bundle="railing"))
    if way == "wall":
        wall = box((length + 0.4, 0.1, top + 0.6), (length / 2, end + 0.05, (top + 0.6) / 2))
        parts.append(part("wall", wall, color="concrete"))
    return Model(parts)


def _tower(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Handrails round the landing and along the flight of a stair, each a bent tube or straight tubes end to end."""
    going, rise, wide = num(rng, 1.5, 3.0), num(rng, 1.0, 2.2), num(rng, 0.7, 1.1)
    r, bend = pick(rng, 0.0169, 0.021, 0.024), 0.12
    solids = []
    for y in (0.0, wide):
        for high in (0.5, 1.0):
            corners = [(0.0, y, high), (going, y, rise + high), (going + 1.0, y, rise + high)]
            solids.append(_tube(corners, r, style, bend if chance(rng, 0.5) else 0.0))
        for x, z in ((0.0, 0.0), (0.5 * going, 0.5 * rise), (going, rise), (going + 1.0, rise)):
            solids.append(_tube([(x, y, z), (x, y, z + 1.0)], r, style))
    end = [(going + 1.0, 0.0, rise + 1.0), (going + 1.0, wide, rise + 1.0)]
    solids.append(_tube(end, r, style))
    parts = _given(solids, chance(rng, 0.3))
    landing = box((1.0, wide, 0.04), (going + 0.5, wide / 2, rise - 0.02))
    parts.append(part("platform", landing, color="steel"))
    for k in range(1, 6):
        tread = box((0.24, wide, 0.03), (going * k / 6, wide / 2, rise * k / 6))
        parts.append(part("stair tread", tread, color="steel"))
    return Model(parts)


RAILS_ALIKE: tuple[Family, ...] = (
    family("railing/bent in one mesh", "floor", FRAME, partial(_bent, one=True), "railing", (15,), 1.5, "fitting"),
    family("railing/bent in single tubes", "floor", FRAME, partial(_bent, one=False), "railing", (15,), 1.5, "fitting"),
    family("railing/lone bent tube", "floor", FRAME, _lone, "railing", (15,), 1.0, "fitting"),
    family("railing/round a stair", "floor", FRAME, _tower, "railing", (15,), 1.0, "fitting"),
)
