"""Fittings of primitives: cones, crossed cylinders, discs, pieces of a torus."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.primitive.shape import (
    Plates,
    cone,
    disc,
    dish,
    lying,
    pipe_piece,
    plated,
    sleeve,
    torus_piece,
)
from cadplants.model.family import Family, Model
from cadplants.model.standards import (
    ELBOW_LONG_RADIUS,
    PIPES,
    REDUCER_LENGTH,
    TEE_CENTER_TO_END,
    sizes_between,
    smaller,
)
from cadplants.solids.mesh_ops import Solid, loft, merge, moved, revolve, weld
from cadplants.solids.primitives import ball, box, cylinder, torus
from cadplants.solids.transforms import arc, at, spun

__all__ = ["PRIMITIVE_FITTINGS"]

_SMALL, _ABOVE_SMALLEST = sizes_between(15, 65), sizes_between(20, 400)
_TAP_RADIUS = 0.03  # m: of a small pipe; outlets sink into it as far as their foot needs
_SIDES = "sides; 0: round"
_TURNS = (0.0, np.pi)  # of the arms about the run


class _Fitting(Device, place="inline", group="Pipe assembly"):
    """A fitting of primitives."""


class BareCone(_Fitting, name="reducer/bare cone", label="reducer", bundle="reducer", sizes=_ABOVE_SMALLEST, weight=2):
    """A bare cone from one size to another."""

    lifted: ClassVar[float] = 0.0

    steps: int = whole(1, 3, "how many nominal sizes smaller the other end is")
    stretch: float = among((0.6, 1.0, 1.0, 1.4), "length / that of the standard")

    def build(self, t: Table) -> Model:
        other = smaller(self.dn, self.steps)
        first, last = t.pipe, PIPES[other]
        length, n, rise = REDUCER_LENGTH[self.dn] * self.stretch, t.n(first.radius), first.radius - last.radius
        rise *= self.lifted

        def circle_at(x: float, radius: float, lift: float) -> Floats:
            angles = np.arange(n) * 2 * np.pi / n
            return np.column_stack([np.full(n, x), radius * np.cos(angles), lift + radius * np.sin(angles)])

        ends = [circle_at(0.0, first.radius, 0.0), circle_at(length, last.radius, rise)]
        if t.style.hollow:
            inside = [circle_at(length, last.bore, rise), circle_at(0.0, first.bore, 0.0)]
            solid = weld([loft([*ends, *inside], closed=True)])
        else:
            middles = [ring.mean(axis=0, keepdims=True) for ring in ends]
            solid = weld([loft([middles[0], *ends, middles[1]])])
        t.add("reducer", solid, of="pipe")
        return t.model(length, "welded", dn=0 if self.lifted else other)


class SlantedCone(BareCone, name="reducer/slanted cone", weight=1.0):
    """A bare cone from one size to another with one flat side."""

    lifted = 1.0


class CrossedTee(_Fitting, name="tee/crossed cylinders", label="tee", bundle="tee", weight=3):
    """Crossed cylinders, each with closed ends, or a snout on a run: a tee in one mesh."""

    steps: int = whole(0, 2, "how many nominal sizes smaller the branch is")
    crossed: bool = chance(0.5, "the branch begins at the axis of the run", when=lambda p: p.steps, otherwise=True)
    flared: tuple[bool, ...] = several(yes(0.3), 1, "whether the branch is a cone")

    def build(self, t: Table) -> Model:
        branch, reach = smaller(self.dn, self.steps), TEE_CENTER_TO_END[self.dn]
        run, r = t.pipe.radius, PIPES[branch].radius
        foot = min(1.25 * r, max(r, 0.9 * run))
        solids = [lying(pipe_piece(self.dn, 0.0, 2 * reach, t.style))]
        for turn, flared in zip(_TURNS, self.flared, strict=False):
            # A branch that begins higher up is within the run all round.
            start = 0.0 if self.crossed else 0.9 * float(np.sqrt(run**2 - (foot if flared else r) ** 2))
            flare = cone(foot, r, start, reach, t.style)
            arm = flare if flared else pipe_piece(branch, start, reach, t.style)
            solids.append(moved(arm, at(reach) @ spun("x", turn)))
        t.add(self.label, *solids, of="pipe")
        return t.model(2 * reach, "welded")


class CrossedCross(CrossedTee, name="cross/crossed cylinders", label="cross", bundle="cross", weight=1.0):
    """Crossed cylinders, each with closed ends, or two snouts on a run: a cross in one mesh."""

    flared: tuple[bool, ...] = several(yes(0.3), 2, "whether each branch is a cone")


class BallTee(_Fitting, name="tee/ball with ends", label="tee", bundle="tee", sizes=_SMALL):
    """A ball with thick screwed ends on three sides; some ends are six- or eight-sided."""

    arms: ClassVar[int] = 1

    reach: float = between(2.0, 2.8, "(from the middle to an end - 8 mm) / radius of the pipe")
    end: float = between(1.25, 1.5, "radius of its ends / of the pipe")
    sides: int = among((6, 8, 0), _SIDES)
    band: float = between(0.8, 1.2, "length of its ends / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        reach, end, band = round(r * self.reach + 0.008, 6), r * self.end, r * self.band
        sides = self.sides or t.n(end)
        solids = [lying(disc(1.1 * r, 0.0, 2 * reach, style)), moved(ball(1.35 * r, t.n(1.35 * r)), at(reach))]
        solids += [lying(cylinder(end, low, low + band, sides)) for low in (0.0, 2 * reach - band)]
        for turn in _TURNS[: self.arms]:
            upright = merge([disc(1.1 * r, 0.0, reach, style), cylinder(end, reach - band, reach, sides)])
            solids.append(moved(upright, at(reach) @ spun("x", turn)))
        t.add(self.label, *solids, of="pipe")
        return t.model(2 * reach, "welded")


class BallCross(BallTee, name="cross/ball with ends", label="cross", bundle="cross"):
    """A ball with thick screwed ends on four sides; some ends are six- or eight-sided."""

    arms = 2


class ShortCylinder(_Fitting, name="coupling/short cylinder", label="coupling", bundle="coupling"):
    """A short thicker cylinder, round or six-sided."""

    length: float = between(1.2, 3.0, "(length - 10 mm) / radius of the pipe")
    wide: float = between(1.15, 1.5, "radius / of the pipe")
    sides: int = among((6, 8, 0, 0), _SIDES)

    def build(self, t: Table) -> Model:
        length, wide = round(t.pipe.radius * self.length + 0.01, 6), t.pipe.radius * self.wide
        t.add(self.label, *(lying(one) for one in self.cylinders(t, length, wide)), of="pipe")
        return t.model(length, "welded")

    def cylinders(self, t: Table, length: float, wide: float) -> list[Solid]:
        """What it is made of, about z [m]."""
        return [cylinder(wide, 0.0, length, self.sides or t.n(wide))]


class ThreeCylinders(ShortCylinder, name="union/three cylinders", label="union", bundle="union", sizes=_SMALL):
    """A union: a short thicker cylinder with a nut round its middle."""

    nut: int = among((6, 8, 0), "sides of the nut; 0: round")

    def cylinders(self, t: Table, length: float, wide: float) -> list[Solid]:
        nut = cylinder(1.25 * wide, 0.3 * length, 0.7 * length, self.nut or t.n(wide))
        return [*super().cylinders(t, length, wide), nut]


class Cap(_Fitting, name="pipe cap/cylinder", place="end", label="pipe cap", bundle="pipe cap", weight=2):
    """A cylinder with a flat or dished end, or a dish alone."""

    wide: float = among((1.0, 1.0, 1.15), "radius / of the pipe")
    skirt: float = between(0.2, 1.0, "length of the cylinder / radius of the pipe")
    alone: bool = chance(0.4, "a dish alone")
    dished: bool = chance(0.5, "the cylinder's end is dished", when=lambda p: not p.alone)

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        wide, skirt = r * self.wide, r * self.skirt
        solids = [] if self.alone else [disc(wide, 0.0, skirt, t.style)]
        if self.alone:
            solids.append(dish(r, 0.55 * r, 0.0, t.style))
        elif self.dished:
            solids.append(dish(wide, 0.5 * wide, skirt, t.style))
        t.add("pipe cap", *map(lying, solids))
        return t.model(joint="welded")


class TorusPiece(_Fitting, name="elbow/piece of torus", place="end", label="elbow", bundle="elbow", weight=2):
    """A piece of a torus at the end of a line, 45 or 90 degrees."""

    bend: float = among((0.67, 1.0, 1.0), "radius of the bend / of a long one")
    turn: float = among((0.25, 0.5, 0.5), "angle / half a turn")
    roll: float = between(0, 2 * np.pi, "about the line", "rad")

    def build(self, t: Table) -> Model:
        size, turn = t.pipe, self.turn * np.pi
        radius = max(ELBOW_LONG_RADIUS[self.dn] * self.bend, 1.05 * size.radius)
        reach = radius * float(np.tan(turn / 2))
        last = (reach + reach * float(np.cos(turn)), reach * float(np.sin(turn)), 0.0)
        n = t.n(size.radius)
        path = arc((0.0, 0.0, 0.0), (reach, 0.0, 0.0), last, max(2, round(n * turn / (2 * np.pi))))
        bore = size.bore if t.style.hollow and size.bore < radius else 0.0
        t.spun("x", self.roll).add("elbow", torus_piece(path, size.radius, n, bore))
        return t.model(joint="welded")


class PlainDisc(_Fitting, name="blind flange/plain disc", place="head", label="blind flange", bundle="blind flange"):
    """A plain disc as wide as a flange on a flange; at times with a low boss."""

    thick: float = between(0.7, 1.4, "thickness / of a flange")
    boss: bool = chance(0.25, "a low boss on it")

    def build(self, t: Table) -> Model:
        size, thick = t.flange, t.flange.thickness * self.thick
        bosses = [lying(disc(size.raised / 2 * 0.7, thick, 1.4 * thick, t.style))] if self.boss else []
        t.add("blind flange", lying(disc(size.outer / 2, 0.0, thick, t.style)), *bosses)
        return t.model(joint="welded")


class SlantedCylinder(_Fitting, name="strainer/slanted cylinder", label="strainer", bundle="strainer", weight=2):
    """A run, with discs at its ends or none, and a slanted or upright cylinder with a lid out of its side."""

    length: float = between(1.1, 1.7, "face to face / outside of the flange")
    wide: float = between(1.0, 1.4, "radius / of the pipe")
    turn: float = among((0.62, 0.7, 0.75, 0.75, 0.8, 1.0), "of the cylinder from upright / half a turn")
    straight: bool = chance(0.6, "the run is no cone")
    plates: Plates = plated()
    foot: float = between(0.32, 0.55, "where the cylinder begins / face to face")
    leg: float = between(0.75, 1.35, "radius of the cylinder / of the pipe")
    far: float = between(2.6, 3.8, "(length of the cylinder - 30 mm) / radius of the pipe")
    lid: float = among((1.0, 1.15, 1.35, 1.6), "radius of its lid / of the cylinder")
    drain: str = among(("none", "none", "plug", "stub", "cock"), "what is in the lid")

    def build(self, t: Table) -> Model:
        r, length, style = t.pipe.radius, round(t.flange.outer * self.length, 6), t.style
        wide = r * self.wide
        body = disc(wide, 0.0, length, style) if self.straight else cone(wide, 1.3 * wide, 0.0, length, style)
        way = at(length * self.foot) @ spun("y", self.turn * np.pi)
        leg = [moved(one, way) for one in self.cylinder(t, r * self.leg, r * self.far + 0.03)]
        t.add("strainer", lying(body), *leg, *self.plates.solids(t, length), of="valve")
        return t.model(length)

    def cylinder(self, t: Table, leg: float, far: float) -> list[Solid]:
        """The cylinder of a radius and length, its lid and what drains it, about z [m]."""
        style, thick = t.style, 0.1 * leg + 0.008
        end = far + thick
        solids = [disc(leg, 0.0, far, style), disc(leg * self.lid, far, end, style)]
        if self.drain == "plug":
            solids.append(cylinder(0.35 * leg, end, end + 0.25 * leg + 0.005, 6))
        elif self.drain in ("stub", "cock"):
            long = 0.8 * leg + 0.03
            solids.append(disc(0.25 * leg, end, end + long, style))
            if self.drain == "cock":
                solids.append(disc(0.4 * leg, end + 0.25 * long, end + 0.75 * long, style))
                solids.append(box((1.6 * leg, 0.25 * leg, 0.1 * leg), (0.5 * leg, 0, end + 0.95 * long)))
        return solids


class Discs(_Fitting, name="expansion joint/discs", label="expansion joint", bundle="expansion joint", weight=1.2):
    """A thicker cylinder, a row of discs, or a row of rings between two ends, at times with discs and tie rods."""

    length: float = between(0.7, 1.4, "face to face / outside of the flange")
    form: str = among(("cylinder", "discs", "rings"), "what is between its ends")
    wide: float = between(1.2, 1.6, "radius of that / of the pipe", when=lambda p: p.form != "rings")
    count: int = whole(3, 7, "discs or rings", when=lambda p: p.form != "cylinder")
    plates: Plates = plated()
    rods: int = among((0, 0, 2, 3, 4), "tie rods from disc to disc", when=lambda p: not p.plates.bare, otherwise=0)

    def build(self, t: Table) -> Model:
        r, length, style = t.pipe.radius, round(t.flange.outer * self.length, 6), t.style
        wide, solids = r * self.wide, [sleeve(t.pipe.bore, r, 0.0, length, style)]
        if self.form == "cylinder":
            solids.append(disc(wide, 0.2 * length, 0.8 * length, style))
        else:
            places = np.linspace(0.25, 0.75, self.count) * length
            thick = 0.25 * (places[1] - places[0])
            for z in map(float, places):
                bead = moved(torus(r + thick, thick, min(t.n(wide), 24), 6), at(0, 0, z))
                solids.append(disc(wide, z - thick, z + thick, style) if self.form == "discs" else bead)
        rod, rim = 0.02 * t.flange.outer + 0.003, 0.45 * t.flange.outer
        for turn in (2 * np.pi * k / self.rods for k in range(self.rods)):
            x, y = rim * float(np.sin(turn)), rim * float(np.cos(turn))
            solids.append(moved(disc(rod, 0.0, length, style), at(x, y)))
        t.add("expansion joint", *map(lying, solids), *self.plates.solids(t, length), of="pipe")
        return t.model(length)


class _Snout(Params):
    """A branch outlet on z = 0, sunk a little: a cone, a cylinder or one with a flared foot."""

    foot: float = between(0.010, 0.03, "radius of its foot", "m")
    high: float = between(0.015, 0.06, "height", "m")
    form: str = among(("cone", "cylinder", "flared"), "how it is made")
    top: float = between(0.5, 0.9, "radius of its top / of its foot")

    def solid(self, t: Table) -> Solid:
        """The outlet."""
        foot, high = min(self.foot, 0.85 * _TAP_RADIUS), self.high
        sunk, top = 0.6 * foot**2 / _TAP_RADIUS + 0.0005, foot * self.top
        if self.form == "cone":
            return cone(foot, top, -sunk, high, t.style)
        if self.form == "cylinder":
            return disc(top, -sunk, high, t.style)
        corners = outline(0, -sunk, foot, -sunk, foot, 0.1 * high, top, 0.45 * high, top, high, 0, high)
        return weld([revolve(corners, t.n(foot))])


class Outlet(
    _Fitting, name="branch outlet/snout", place="tap", label="branch outlet", bundle="branch outlet", weight=3
):
    """A snout on an outlet, with a plug, a piece of pipe or a blank disc on it."""

    snout: _Snout = nested(_Snout, "outlet")
    end: str = among(("pipe", "cap", "disc", "open"), "what is on it")
    long: float = between(0.05, 0.4, "length of the pipe", "m", when=lambda p: p.end == "pipe")

    def build(self, t: Table) -> Model:
        solid, high, style = self.snout.solid(t), self.snout.high, t.style
        top = float(np.hypot(*solid.vertices[solid.vertices[:, 2] > high - 1e-9][:, :2].T).max())
        t.add("branch outlet", solid)
        if self.end == "pipe":
            t.add("pipe", disc(0.9 * top, high, high + self.long, style), own=False)
        elif self.end == "cap":
            t.add("pipe cap", disc(1.2 * top, high, high + 1.2 * top, style), own=False)
        elif self.end == "disc":
            t.add("blind flange", disc(2.6 * top, high, high + 0.8 * top, style), own=False)
        return t.model()


class DiscAndCone(_Fitting, name="flange/disc and cone", label="flange", bundle="flange", weight=1.5):
    """Two discs with cones or cylinders for their hubs, back to back on a short neck."""

    more: float = between(0.02, 0.08, "length - 3 thicknesses of a flange", "m")
    hub: float = between(1.1, 1.4, "radius of the hubs / of the pipe")
    coned: bool = chance(0.5, "the hubs are cones")

    def build(self, t: Table) -> Model:
        r, rim, thick, style = t.pipe.radius, t.flange.outer / 2, t.flange.thickness, t.style
        length, hub = round(3 * thick + self.more, 6), r * self.hub
        if self.coned:
            hubs = [cone(hub, r, thick, 0.5 * length, style), cone(r, hub, 0.5 * length, length - thick, style)]
        else:
            hubs = [disc(hub, thick, 0.45 * length, style), disc(hub, 0.55 * length, length - thick, style)]
        for low, one in zip((0.0, length - thick), hubs, strict=True):
            t.add("flange", lying(disc(rim, low, low + thick, style)), lying(one))
        t.add("pipe", lying(pipe_piece(self.dn, 0.4 * length, 0.6 * length, style)))
        return t.model(length, split=True)


class ThinDisc(_Fitting, name="flange/thin disc", label="flange", bundle="flange", weight=1.2):
    """Thin discs, one or two face to face, round a running pipe."""

    rim: float = between(0.8, 1.05, "outside / of a flange")
    count: int = whole(1, 2, "discs")
    thick: float = between(0.004, 0.02, "of a disc", "m")
    gap: float = among((0.0, 0.0, 0.002, 0.004), "between the discs", "m", when=lambda p: p.count > 1, otherwise=0.0)

    def build(self, t: Table) -> Model:
        rim, thick, length = t.flange.outer / 2 * self.rim, self.thick, round(0.06 + 2 * self.thick, 6)
        t.bundled("pipe").add("pipe", lying(pipe_piece(self.dn, 0.0, length, t.style)))
        for k in range(self.count):
            low = 0.03 + k * (thick + self.gap)
            bore = t.pipe.radius if t.style.hollow else 0.0
            t.add("flange", lying(sleeve(bore, rim, low, low + thick, t.style)))
        return t.model(length, "welded")


PRIMITIVE_FITTINGS: tuple[Family, ...] = families_of(
    BareCone,
    SlantedCone,
    CrossedTee,
    CrossedCross,
    BallTee,
    BallCross,
    ShortCylinder,
    ThreeCylinders,
    DiscAndCone,
    ThinDisc,
    SlantedCylinder,
    Discs,
    Cap,
    TorusPiece,
    PlainDisc,
    Outlet,
)
