"""Valves whose gland, nuts, studs and stem stand round one axis, and valves of a sleeve on the pipe."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    cone,
    disc,
    lying,
    spoked,
)
from cadplants.model.family import Family, Model
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import extrude, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["SPINDLES_ALIKE"]

_BODY = "valve body"


class _Packing(Params):
    """A packing gland round a stem about z: a round or six-sided ring, a follower with two studs, a cap nut."""

    wide: float = between(1.8, 2.6, "radius / of the stem")
    high: float = between(1.0, 2.6, "height / radius of the stem")
    form: str = among(("ring", "nut", "nut with a collar", "follower"), "how it is made")

    def build(self, t: Table, stem: float, z: float) -> float:
        """Puts it down on a height; the height of its top [m].

        Args:
            t: with the frame.
            stem: radius of the stem [m].
            z: [m].
        """
        bore = 1.04 * stem if t.style.hollow else 0.0
        wide, high = stem * self.wide, stem * self.high
        n, t = t.n(wide), t.at(0, 0, z)
        if self.form != "follower":
            solids = {
                "ring": [ring(bore, wide, 0.0, high, n)],
                "nut": [hexagon(2 * wide, 0.0, high, bore, n)],
                "nut with a collar": [
                    ring(bore, wide, 0.0, high, n),
                    hexagon(2.4 * wide, 0.4 * high, 0.9 * high, bore, n),
                ],
            }
            t.add("gland", *solids[self.form])
            return z + high
        plate = extrude(circle(0.7 * wide, 12) * (4.2, 1.3), 0.0, 0.5 * high, (circle(bore, 12),) if bore else ())
        t.add("gland", plate, ring(bore, 0.8 * wide, -0.4 * high, 0.0, n))
        bolt = 0.35 * stem + 0.0015
        for s in BOTH if t.style.fasteners != "none" else ():
            here = t.at(s * 1.9 * wide)
            here.add("stud", cylinder(bolt, -high, 1.4 * high, 8))
            here.add("nut", hexagon(3.2 * bolt, 0.5 * high, 0.5 * high + 1.6 * bolt))
        return z + 0.5 * high


class _Yoke(Params):
    """Two columns and a bridge about z: round like studs, or flat."""

    round_: bool = chance(0.5, "its columns are round")
    apart: bool = chance(0.4, "columns and bridge are a mesh each")

    def build(self, t: Table, low: float, high: float, reach: float) -> None:
        """Puts it down between two heights [m]; ``reach``: from the axis to a column."""
        w = 0.16 * reach + 0.002
        if self.round_:
            columns = [moved(cylinder(0.7 * w, low, high, min(t.n(w), 16)), at(s * reach)) for s in BOTH]
        else:
            columns = [box((w, 1.8 * w, high - low), (s * reach, 0, (low + high) / 2)) for s in BOTH]
        bridge = moved(cylinder(reach * 0.5, 0.0, 1.6 * w, t.n(reach)), at(0, 0, high - 1.6 * w))
        across = merge([bridge, box((2 * reach, 1.6 * w, w), (0, 0, high - w))])
        t.add_each("yoke", (*columns, across), joined=not self.apart)


class _Wheel(Params):
    """A handwheel in one mesh, or its ring, hub and spokes apart."""

    spokes: int = whole(3, 6, "spokes")
    one: bool = chance(0.6, "it is one mesh")

    def build(self, t: Table, radius: float, z: float) -> None:
        """Puts it down on a height [m]."""
        thick, t = 0.09 * radius, t.bundled("handwheel").at(0, 0, z)
        solids = [*spoked(radius, thick, self.spokes, t.style), disc(0.2 * radius, -thick, 1.4 * thick, t.style)]
        t.add_each("handwheel", solids, joined=self.one, own=True)


class _Spindle(Device, place="inline", group="Valve assembly", label="valve", bundle=_BODY):
    """A valve whose parts stand round its stem."""


class GlandInYoke(_Spindle, name="gate valve/gland in yoke", sizes=sizes_between(25, 400), weight=2.0):
    """A flanged valve whose stem rises through a gland and a yoke, with studs round its bonnet at times."""

    fasteners: str = styled("bolt", "how fasteners are modelled")
    length: float = between(0.9, 1.3, "(face to face - 40 mm) / outside of the flange")
    packing: _Packing = nested(_Packing, "gland")
    yoke: _Yoke = nested(_Yoke, "yoke")
    rise: float = between(0.3, 2.2, "of the stem over the yoke / radius of the pipe")
    wheel: _Wheel = nested(_Wheel, "handwheel")
    nut: bool = chance(0.5, "a nut holds the handwheel")
    studs: int = among((4, 6, 8), "studs round its bonnet", when=lambda p: p.fasteners != "none", otherwise=0)

    def build(self, t: Table) -> Model:
        r, rim, thick, style = t.pipe.radius, t.flange.outer / 2, t.flange.thickness, t.style
        length, stem = round(2 * rim * self.length + 0.04, 6), 0.16 * r + 0.003
        top = 1.6 * r + thick
        ends = [(1.15 * r, 0.0, length), (rim, 0.0, thick), (rim, length - thick, length)]
        bowl = [(1.2 * r, -1.3 * r), (1.4 * r, 0.0), (1.0 * r, 1.6 * r)]
        upper = [turned(bowl, t.n(1.4 * r)), disc(1.5 * r, 1.6 * r, top, style)]
        bodies = [*(lying(disc(*end, style)) for end in ends), *(moved(one, at(length / 2)) for one in upper)]
        t.add(_BODY, *bodies)
        table, t = t, t.at(length / 2)
        lid = top + thick
        t.add("valve bonnet", disc(1.5 * r, top, lid, style), cone(r, 2.6 * stem, lid, lid + 0.6 * r, style))
        z = self.packing.build(t, stem, lid + 0.6 * r)
        bridge = z + 0.9 * r + 0.03
        self.yoke.build(t, lid, bridge, 1.1 * r)
        t.add("valve stem", disc(stem, top, bridge + r * self.rise, style))
        self.wheel.build(t, 1.3 * r + 0.04, bridge + 0.02)
        if self.nut:
            low, bore = bridge + 0.03 + 0.1 * r, 1.02 * stem if style.hollow else 0.0
            t.add("nut", hexagon(4.6 * stem, low, low + 0.01 + stem, bore))
        for k in range(self.studs):
            stud = cylinder(0.08 * r + 0.002, 1.6 * r - 0.4 * thick, top + 1.6 * thick, 8)
            t.spun("z", 0.4 + 2 * np.pi * k / self.studs).at(1.28 * r).add("stud", stud)
        return table.model(length, kind="gate valve")


class PackingNut(_Spindle, name="globe valve/packing nut", sizes=sizes_between(15, 50), weight=2.0):
    """A small screwed valve with a six-sided or round packing gland round a thin stem, and a wheel or a bar."""

    length: float = between(4.0, 6.0, "(face to face - 10 mm) / radius of the pipe")
    sides: int = among((6, 8), "of its ends")
    packing: _Packing = nested(_Packing, "gland")
    rise: float = between(0.8, 2.0, "of the stem over the gland / radius of the pipe")
    wheeled: bool = chance(0.6, "a handwheel, not a bar")
    wheel: _Wheel = nested(_Wheel, "handwheel", when=lambda p: p.wheeled)

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        length, stem = round(r * self.length + 0.01, 6), 0.2 * r + 0.002
        ends = [(0.0, 0.3 * length), (0.7 * length, length)]
        hub = turned([(r, -1.1 * r), (1.3 * r, 0.0), (0.9 * r, 1.5 * r)], t.n(1.3 * r))
        solids = [lying(cylinder(1.3 * r, *end, self.sides)) for end in ends]
        t.add(_BODY, *solids, moved(hub, at(length / 2)), lying(disc(1.05 * r, 0.0, length, style)))
        table, t = t, t.at(length / 2)
        z = self.packing.build(t, stem, 1.5 * r)
        tip = z + r * self.rise
        t.add("valve stem", disc(stem, r, tip, style))
        if self.wheeled:
            self.wheel.build(t, 1.2 * r + 0.015, tip - 0.1 * r)
        else:
            bar = box((4.0 * r + 0.04, 0.9 * r, 0.2 * r), (1.4 * r, 0, tip - 0.1 * r))
            t.bundled("lever").add("lever", bar, own=True)
            t.add("nut", hexagon(3.4 * stem, tip, tip + stem))
        return table.model(length, "welded", "globe valve")


class SleeveWheel(_Spindle, name="valve/sleeve with spoked wheel", weight=1.5):
    """A sleeve on the pipe with a rod and a wheel whose ring, hub and spokes are apart, beside or over the line."""

    length: float = between(2.0, 4.0, "(length - 20 mm) / radius of the pipe")
    wide: float = between(1.1, 1.6, "radius of the sleeve / of the pipe")
    rimmed: bool = chance(0.5, "a rim at either end")
    rise: float = between(0.04, 0.15, "of the wheel over the sleeve", "m")
    reach: float = between(0.05, 0.12, "radius of the wheel - of the sleeve", "m")
    thick: float = between(0.006, 0.014, "radius of the wheel's ring", "m")
    spokes: int = whole(3, 6, "spokes")
    barred: bool = chance(0.4, "its spokes are thick square bars")
    turn: float = among((0.0, 0.5, -0.5), "where the wheel stands about the line / half a turn")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        length, wide = round(r * self.length + 0.02, 6), r * self.wide
        rims = [(1.25 * wide, low, low + 0.1 * length) for low in (0.0, 0.9 * length)] if self.rimmed else []
        t.add(_BODY, *(lying(disc(*one, style)) for one in [(wide, 0.0, length), *rims]))
        table, t = t, t.at(length / 2).spun("x", self.turn * np.pi)
        rise, radius, thick = wide + self.rise, wide + self.reach, self.thick
        t.add("valve stem", disc(0.2 * r + 0.004, 0.8 * wide, rise, style))
        wheel = spoked(radius, thick, self.spokes, style)
        if self.barred:
            bar = box((radius, thick, thick), (radius / 2, 0, 0))
            wheel[1:] = [moved(bar, spun("z", 2 * np.pi * k / self.spokes)) for k in range(self.spokes)]
        for one in (*wheel, disc(0.18 * radius, -2 * thick, 2 * thick, style)):
            t.bundled("handwheel").at(0, 0, rise).add("handwheel", one, own=True)
        return table.model(length, "welded", "valve")


class SleeveBar(_Spindle, name="ball valve/sleeve with bar", sizes=sizes_between(15, 50)):
    """A sleeve or a block with a bar: no flanges of its own, the bar along or across the line."""

    length: float = between(2.4, 4.0, "(length - 20 mm) / radius of the pipe")
    block: bool = chance(0.5, "its middle is a block")
    reach: float = between(0.04, 0.12, "length of the bar - 3 radii of the pipe", "m")
    turn: float = among((0.0, 0.5, 1.0), "which way the bar points / half a turn")
    tilt: float = among((0.0, 0.3), "of the bar", "rad")
    knob: bool = chance(0.4, "a knob at the bar's end")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        length, top, reach = round(r * self.length + 0.02, 6), 1.6 * r + 0.02, 3 * r + self.reach
        if self.block:
            middle = box((0.6 * length, 2.5 * r, 2.5 * r), (length / 2, 0, 0))
        else:
            middle = lying(disc(1.5 * r, 0.2 * length, 0.8 * length, style))
        t.add(_BODY, lying(disc(1.2 * r, 0.0, length, style)), middle)
        t.at(length / 2).add("valve stem", disc(0.25 * r + 0.003, r, top, style))
        bars = [box((reach, 0.7 * r, 0.006), (0.45 * reach, 0, 0))]
        if self.knob:
            bars.append(moved(rod((0, 0, -0.03), (0, 0, 0.03), 0.012, 8), at(0.9 * reach)))
        bar = t.bundled("lever").at(length / 2, 0, top).spun("z", self.turn * np.pi).spun("y", -self.tilt)
        bar.add("lever", *bars, own=True)
        return t.model(length, "welded", "ball valve")


SPINDLES_ALIKE: tuple[Family, ...] = families_of(GlandInYoke, PackingNut, SleeveWheel, SleeveBar)
