"""Handrails of bent tube: like pipes with elbows, in one mesh or in single tubes."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import among, between, chance, several
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    FRAME,
    disc,
    torus_piece,
)
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import ball, box
from cadplants.solids.transforms import arc, at
from cadplants.styles.modeling_style import ModelingStyle

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


class _Rail(Device, group=FRAME, label="railing", bundle="railing", sizes=(15,), grain="fitting"):
    """A handrail of tube."""


class _Bent(_Rail, weight=1.5):
    """Bows of tube from floor to floor, a top rail that turns round corners, knee rails that end at posts."""

    one: ClassVar[bool] = True

    length: float = between(1.0, 4.0, "length", "m")
    height: float = between(0.9, 1.15, "of the top rail", "m")
    tube: float = among((0.0169, 0.021, 0.024, 0.03), "radius of the tube", "m")
    bend: float = among((2.5, 4.0, 6.0), "radius of the bends / of the tube")
    cornered: bool = among((False, True), "it goes on round a corner")
    side: float = between(0.8, 2.0, "length round the corner", "m", when=lambda p: p.cornered)
    single: bool = chance(0.7, "one knee rail, not two")
    knobs: bool = chance(0.25, "balls where the knee rail meets the first post")
    plates: bool = chance(0.5, "plates under its ends")

    def build(self, t: Table) -> Model:
        length, high, r, side = self.length, self.height, self.tube, self.side
        corners = [(0.0, 0.0, 0.0), (0.0, 0.0, high), (length, 0.0, high)]
        corners += [(length, side, high), (length, side, 0.0)] if side else [(length, 0.0, 0.0)]
        solids = [_tube(corners, r, t.style, self.bend * r)]
        for x in np.linspace(0, length, int(length / 1.2) + 2)[1:-1]:
            solids.append(_tube([(float(x), 0.0, 0.0), (float(x), 0.0, high)], r, t.style))
        for share in (0.5,) if self.single else (0.35, 0.7):
            z = share * high
            solids.append(_tube([(0.0, 0.0, z), (length, 0.0, z)], 0.9 * r, t.style))
            if side:
                solids.append(_tube([(length, 0.0, z), (length, side, z)], 0.9 * r, t.style))
        if self.knobs:
            solids += [moved(ball(1.5 * r, 12), at(0, 0, share * high)) for share in (0.5, 0.98)]
        t.add_each("railing", solids, joined=self.one)
        for x, y in ((0.0, 0.0), (length, side)) if self.plates else ():
            t.at(x, y).add("base plate", disc(2.6 * r, -0.01, 0.0, t.style), own=False)
        return t.model()


class BentInOne(_Bent, name="railing/bent in one mesh"):
    """A railing of bent tubes, all in one mesh."""


class BentInTubes(_Bent, name="railing/bent in single tubes"):
    """A railing of bent tubes, each a mesh."""

    one = False


class Lone(_Rail, name="railing/lone bent tube"):
    """A handrail of one bent tube: both ends turn down, back or to the wall; level, or slanted beside stairs."""

    length: float = between(0.6, 3.5, "length", "m")
    slope: float = among((0.0, 0.0, 0.7), "rise / length")
    tube: float = among((0.0169, 0.021, 0.024), "radius of the tube", "m")
    bend: float = among((2.5, 4.0), "radius of the bends / of the tube")
    end: float = between(0.16, 0.3, "length of what turns away", "m")
    low: float = between(0.8, 1.1, "height of its lower end", "m")
    way: str = among(("down", "wall", "back", "loop"), "where its ends turn")

    def build(self, t: Table) -> Model:
        length, r, end, low, way = self.length, self.tube, self.end, self.low, self.way
        top = low + self.slope * length
        y, z = (end, 0.0) if way == "wall" else (0.0, -end)
        corners = [(0.0, y, low + z), (0.0, 0.0, low), (length, 0.0, top), (length, y, top + z)]
        if way == "loop":
            corners = [(0.5 * length, 0.0, (low + top) / 2 - end), *corners]
        t.add("railing", _tube(corners, r, t.style, min(self.bend * r, 0.4 * end)))
        for share in (0.2, 0.8):
            x, z = share * length, low + share * (top - low)
            if way == "wall":
                arm = [(x, 0.0, z - r), (x, 0.0, z - 3 * r), (x, end, z - 3 * r)]
                t.add("bracket", _tube(arm, 0.4 * r, t.style))
            else:
                t.add("post", _tube([(x, 0.0, 0.0), (x, 0.0, z)], r, t.style), of="safety")
        if way == "wall":
            wall = box((length + 0.4, 0.1, top + 0.6), (length / 2, end + 0.05, (top + 0.6) / 2))
            t.add("wall", wall, own=False)
        return t.model()


class RoundStair(_Rail, name="railing/round a stair"):
    """Handrails round the landing and along the flight of a stair, each a bent tube or straight tubes end to end."""

    going: float = between(1.5, 3.0, "of the flight", "m")
    rise: float = between(1.0, 2.2, "of the flight", "m")
    width: float = between(0.7, 1.1, "of the flight", "m")
    tube: float = among((0.0169, 0.021, 0.024), "radius of the tubes", "m")
    bent: tuple[bool, ...] = several(
        yes(0.5),
        4,
        "whether each of the four rails is bent, not cut, at the landing",
    )
    one: bool = chance(0.3, "all rails are one mesh")

    def build(self, t: Table) -> Model:
        going, rise, wide, r = self.going, self.rise, self.width, self.tube
        solids, bent = [], iter(self.bent)
        for y in (0.0, wide):
            for high in (0.5, 1.0):
                corners = [(0.0, y, high), (going, y, rise + high), (going + 1.0, y, rise + high)]
                solids.append(_tube(corners, r, t.style, 0.12 if next(bent) else 0.0))
            for x, z in ((0.0, 0.0), (0.5 * going, 0.5 * rise), (going, rise), (going + 1.0, rise)):
                solids.append(_tube([(x, y, z), (x, y, z + 1.0)], r, t.style))
        solids.append(_tube([(going + 1.0, 0.0, rise + 1.0), (going + 1.0, wide, rise + 1.0)], r, t.style))
        t.add_each("railing", solids, joined=self.one)
        t.add("platform", box((1.0, wide, 0.04), (going + 0.5, wide / 2, rise - 0.02)), of="steel", own=False)
        for k in range(1, 6):
            t.add("stair tread", box((0.24, wide, 0.03), (going * k / 6, wide / 2, rise * k / 6)), own=False)
        return t.model()


RAILS_ALIKE: tuple[Family, ...] = families_of(BentInOne, BentInTubes, Lone, RoundStair)
