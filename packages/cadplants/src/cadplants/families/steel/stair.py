"""Stairs: spiral, of concrete, on strings or a spine, folded, step-overs."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import one_of, yes
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.floor import panel
from cadplants.families.steel.shape import (
    Base,
    Structure,
    bar,
    few_sides,
    pipe,
    raking,
    rect,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    span_of,
    strings,
)
from cadplants.model.family import Model
from cadplants.solids.primitives import BOTH, CORNERS, box, cylinder, dome, ring

__all__ = ["STAIRS"]


class Spiral(Structure, name="stairs/spiral", grain="fitting"):
    """A spiral stair: wedge treads round a column, balusters and a winding handrail (EN ISO 14122-3 going)."""

    radius: float = between(0.6, 1.1, "of the stair", "m")
    rise: float = between(0.18, 0.22, "of a step", "m")
    count: int = whole(6, 14, "steps")
    per_turn: int = among((12, 14, 16), "steps all the way round")
    core: float = between(0.05, 0.09, "radius of the column", "m")
    base: Base = nested(Base, "base plate")
    collared: bool = chance(0.5, "the treads have collars round the column")
    metals: tuple[str, ...] = several(
        one_of("steel", "steel", "clamp"), lambda p: p.count, "kind of material of a tread"
    )

    def build(self, t: Table) -> Model:
        r, rise, core, step = self.radius, self.rise, self.core, 2 * np.pi / self.per_turn
        h, n, edge = rise * self.count, few_sides(t.style, core, 24), self.radius - 0.03
        low = self.base.build(t, 5 * core, 5 * core)
        t.add("column", cylinder(core, low, h + 1.0, n))
        t.add("plate", dome(core, 0.5 * core, h + 1.0, n))
        a = np.linspace(0, step * 1.1, 5)
        unit = np.column_stack([np.cos(a), np.sin(a)])
        tread = [slab_xy(np.vstack([0.9 * core * unit[::-1], r * unit]), -0.03, 0.0)]
        tread += [ring(0.98 * core, 1.3 * core, -0.2, 0.001, n)] if self.collared else []
        for k, metal in enumerate(self.metals):
            here = t.at(0, 0, rise * (k + 1)).spun("z", step * k)
            here.add("stair tread", *tread, of=metal)
            x, y = edge * np.cos(step * (k + 0.5)), edge * np.sin(step * (k + 0.5))
            ends = [(x, y, rise * (k + 1)), (x, y, rise * (k + 1.5) + 0.95)]
            t.add("post", pipe(ends, 0.01, t.style), of="safety")
        s = np.linspace(0.5, self.count - 0.5, 2 * self.count)
        path = np.column_stack([edge * np.cos(step * s), edge * np.sin(step * s), rise * (s + 1.0) + 0.95])
        t.add("railing", pipe(path, 0.021, t.style))
        return t.model()


class ConcreteFlight(Structure, name="stairs/concrete", weight=0.8, grain="fitting"):
    """A concrete flight in one piece, solid or as a sloped slab, maybe with cheek walls, nosings and a railing."""

    count: int = whole(2, 9, "steps")
    rise: float = between(0.15, 0.19, "of a step", "m")
    going: float = between(0.25, 0.32, "of a step", "m")
    width: float = between(0.7, 1.6, "of the flight", "m")
    solid: bool = chance(0.5, "solid, not a sloped slab", when=lambda p: p.count > 3, otherwise=True)
    cheeked: bool = chance(0.35, "with cheek walls")
    nosed: bool = chance(0.4, "with nosings")
    railed: bool = chance(0.6, "with a railing")

    def build(self, t: Table) -> Model:
        n, rise, go, wide = self.count, self.rise, self.going, self.width
        run, h = n * go, n * rise
        steps = [(0.0, 0.0), *((x, (k + 1) * rise) for k in range(n) for x in (k * go, (k + 1) * go))]
        under = [(run, 0.0)] if self.solid else [(run, h - 0.2), (0.35, 0.0)]
        t.add("stair tread", slab_xz(np.array([*steps, *under][::-1]), wide), of="concrete")
        if self.cheeked:
            cheek = [(-0.1, 0), (run, 0), (run, h + 0.15), (-0.1, 0.15)]
            t.add_each("wall", [slab_xz(cheek, 0.15, s * (wide / 2 + 0.075)) for s in BOTH])
        elif not self.solid:
            t.add("wall", box((0.3, wide, h - 0.2), (run + 0.15, 0, (h - 0.2) / 2)))
        if self.nosed:
            nosings = [box((0.05, wide, 0.004), (k * go + 0.025, 0, (k + 1) * rise + 0.002)) for k in range(n)]
            t.add_each("plate", nosings, of="clamp")
        if self.railed:
            y = wide / 2 - 0.06
            t.add("railing", pipe([(0.5 * go, y, rise + 0.9), (run - 0.5 * go, y, h + 0.9)], 0.021, t.style))
            feet = [((k + 0.5) * go, y, (k + 1) * rise) for k in sorted({0, n // 2, n - 1})]
            posts = [pipe([(x, y, z), (x, y, z + 0.9)], 0.019, t.style) for x, y, z in feet]
            t.add_each("post", posts, of="safety")
        return t.model()


def _stringed(p: Any) -> bool:
    return p.string in ("U", "flat", "RHS")


def _lift(p: Any) -> float:
    """How far the axes of strings, which run through the middles of the treads, are over the line of their edges."""
    return float(p.rise / 2 - 0.03) if _stringed(p) else 0.0


class SteelFlight(Structure, name="stairs/strings and spine", weight=1.5, grain="fitting"):
    """A steel flight: channel, plate, tube or toothed strings or one spine; treads with end plates, nosings."""

    count: int = whole(3, 10, "steps")
    rise: float = between(0.16, 0.21, "of a step", "m")
    going: float = between(0.22, 0.28, "of a step", "m")
    width: float = between(0.6, 1.2, "of the flight", "m")
    string: str = among(("U", "flat", "RHS", "toothed", "spine"), "section of the strings, or toothed ones, or a spine")
    spine: str = among(("RHS", "SHS", "CHS", "H"), "section of the spine", when=lambda p: p.string == "spine")
    size: float = between(
        lambda p: 0.12 if p.string == "spine" else 0.16,
        lambda p: 0.2 if p.string == "spine" else 0.22,
        "height of a string or the spine",
        "m",
        when=lambda p: p.string != "toothed",
    )
    tread: str = among(("bar", "fold", "sheet", "perforated", "planks"), "how the treads are made")
    nosed: tuple[bool, ...] = several(yes(0.5), lambda p: p.count, "whether a tread has a nosing")
    railed: bool = chance(0.7, "with a railing")
    both: bool = chance(0.6, "a railing on both sides, not on one", when=lambda p: p.railed)

    def build(self, t: Table) -> Model:
        n, rise, go, wide, string = self.count, self.rise, self.going, self.width, self.string
        self._strings(t, n * go, n * rise)
        tread, deep = self.tread, go + 0.02
        more = 0.024 if tread in ("fold", "planks", "sheet") else 0.0
        solid = panel(tread, deep, wide - 0.02, 0.03, t.style)
        ends = [box((deep, 0.004, 0.06), (0, s * (wide / 2 - 0.012), 0)) for s in BOTH if _stringed(self)]
        nosing = box((0.03, wide - 0.02, 0.006), (-deep / 2 + 0.015, 0, 0.033))
        for k, nosed in enumerate(self.nosed):
            here = t.at((k + 0.5) * go, 0, (k + 1) * rise - 0.03)
            if string == "spine":
                here.add("bracket", box((0.15, 0.3, 0.125 + more), (-go / 2, 0, -0.0625 + more / 2)))
            here.add("stair tread", solid, *([nosing] if nosed else []), *ends, of="clamp")
        if self.railed:
            self._rails(t.at(0, 0, _lift(self)), n * go, n * rise)
        return t.model()

    def _strings(self, t: Table, run: float, h: float) -> None:
        """What carries the treads, over a run and a height [m]."""
        n, rise, go, y = self.count, self.rise, self.going, self.width / 2
        if self.string == "toothed":
            teeth = [(k * go + d, (k + 1) * rise - 0.03) for k in range(n) for d in (0.0, go)]
            shape = np.array([*teeth, (run, h - 0.25), (0.0, 0.0)][::-1])
            t.add_each("beam", [slab_xz(shape, 0.012, s * (y - 0.1)) for s in BOTH])
        elif self.string == "spine":
            one = section(self.spine, self.size, t.style)
            drop = span_of(one)[3] / np.cos(np.arctan2(rise, go)) + 0.12
            t.add("beam", bar((0.0, 0, rise - drop), (run - go, 0, h - drop), one))
        else:
            one = section(self.string, self.size, t.style)
            strings(t, one, [s * y for s in BOTH], run, h, _lift(self))

    def _rails(self, t: Table, run: float, h: float) -> None:
        """Railings, over a run and a height [m]."""
        for s in BOTH if self.both else (1,):
            y = s * (self.width / 2 - (0.1 if self.string == "toothed" else 0.0))
            path = [(0.02, y, 0.95), (run, y, h + 0.95), (run + 0.2, y, h + 0.95)]
            t.add("railing", pipe(path, 0.021, t.style, 0.1))
            for f in np.linspace(0.08, 0.95, max(2, self.count // 3)):
                low = f * h + (0.0 if _stringed(self) else 0.1)
                t.add("post", pipe([(f * run, y, low), (f * run, y, f * h + 0.95)], 0.019, t.style), of="safety")


class StepOver(Structure, name="stairs/step over", grain="fitting"):
    """A step-over or a low step block: treads up one or both sides of a small platform, folded or framed."""

    count: int = whole(1, 4, "steps up a side")
    rise: float = between(0.17, 0.23, "of a step", "m")
    going: float = between(0.22, 0.28, "of a step", "m")
    width: float = between(0.5, 0.9, "of the steps", "m")
    land: float = between(0.4, 1.2, "length of the platform", "m")
    both: bool = chance(0.6, "steps on both sides, not on one")
    tread: str = among(("bar", "sheet", "perforated", "fold"), "how treads and platform are made")
    string: str = among(("flat", "U", "RHS"), "section of the strings")
    railed: bool = chance(0.6, "a railing on either side")

    def build(self, t: Table) -> Model:
        n, rise, go, wide, x = self.count, self.rise, self.going, self.width, self.land / 2
        h, y = rise * (n + 1), wide / 2
        t.at(0, 0, h - 0.03).add("platform", panel(self.tread, 2 * x, wide, 0.03, t.style))
        one, leg = section(self.string, 0.12, t.style), section("SHS", 0.04, t.style)
        tread = panel(self.tread, go, wide, 0.03, t.style)
        for way in BOTH if self.both else (1,):
            # A string's axis runs from 50 mm over the floor to as far below the platform's top.
            foot = way * (x + go * n * (h - 0.05) / (h - 0.1))
            t.add_each("beam", [raking((foot, s * y, 0.0), (way * x, s * y, h - 0.05), one) for s in BOTH])
            for k in range(n):
                here = t.at(way * (x + go * (n - k - 0.5)), 0, rise * (k + 1) - 0.03)
                here.add("stair tread", tread, of="clamp")
        t.add_each("column", [bar((sx * x, sy * y, 0), (sx * x, sy * y, h - 0.03), leg) for sx, sy in CORNERS])
        for s in BOTH if self.railed else ():
            path = [(x_, s * y, z) for x_, z in ((-x, h - 0.03), (-x, h + 0.95), (x, h + 0.95), (x, h - 0.03))]
            t.add("railing", pipe(path, 0.019, t.style, 0.12))
        return t.model()


class Zigzag(Structure, name="stairs/zigzag", weight=0.7, grain="fitting"):
    """Steps folded from one plate (zigzag), with or without side strings."""

    count: int = whole(2, 7, "steps")
    rise: float = between(0.16, 0.2, "of a step", "m")
    going: float = between(0.24, 0.3, "of a step", "m")
    width: float = between(0.6, 1.1, "of the steps", "m")
    thick: float = among((0.005, 0.008, 0.06), "thickness of the plate, or of concrete", "m")
    stringed: bool = chance(0.6, "with side strings")
    back: str = among(("wall", "foundation"), "what is behind it")

    def build(self, t: Table) -> Model:
        n, rise, go, wide, thick = self.count, self.rise, self.going, self.width, self.thick
        run, h, y = n * go, n * rise, wide / 2 + 0.005
        line = [(0.0, 0.0), *((x, (k + 1) * rise) for k in range(n) for x in (k * go, (k + 1) * go))]
        of = "steel" if thick < 0.02 else "concrete"
        t.add("stair tread", slab_xz(ribbon(np.array(line), thick), wide), of=of)
        if self.stringed:
            strings(t, (rect(0.01, 0.28), ()), [s * y for s in BOTH], run, h, 0.06)
        tall = h - thick / 2
        t.add(self.back, box((0.2, wide, tall), (run - 0.1, 0, tall / 2)))
        return t.model()


STAIRS = families_of(Spiral, ConcreteFlight, SteelFlight, StepOver, Zigzag)
