"""Plate heat exchangers of plain shapes: two end plates with a block or plates between them, bars, bolts, mouths."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table
from cadplants.families.machines.plain_parts import BOLTED, Faceted, PlainPort
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, rod

__all__ = ["PLATE_STACKS"]

_NAME = "heat exchanger"


class _Mouth(PlainPort):
    """A mouth of a plate exchanger."""

    form: str = among((*BOLTED, "thread", "stub", "stub"), "what is at its end")


class _Stack(
    Faceted, place="floor", group="Equipment", label=_NAME, bundle=_NAME, sizes=(20, 25, 32, 40, 50, 65, 80, 100)
):
    """A gasketed plate exchanger of plain shapes."""

    wide: float = between(4.2, 7.5, "width of the plates / of the pipe")
    tall: float = between(1.7, 3.4, "height of the plates / their width")
    deep: float = between(0.25, 1.6, "length of the pack / width of the plates")
    low: float = between(0.02, 0.25, "from the floor to the plates / their height")
    ends: float = among((0.012, 0.02, 0.035, 0.05), "thickness of the end plates", "m")
    more: float = between(0.0, 0.2, "how much wider the end plates are than the pack / width")
    pack: str = among(("block", "block", "plates", "ribs"), "the pack: a block, plates one by one, a block with ribs")
    count: int = whole(6, 36, "plates of the pack", when=lambda p: p.pack != "block")
    spaced: float = between(0.4, 1.0, "thickness of a plate / pitch", when=lambda p: p.pack == "plates")
    bars: str = among(("rods", "flats", "none"), "the carrying bars")
    beyond: float = among(
        (0.0, 0.3, 0.8, 1.4), "the bars behind the pack / its length", when=lambda p: p.bars != "none", otherwise=0.0
    )
    column: bool = chance(0.7, "a column at the far end of the bars", when=lambda p: p.beyond > 0)
    ties: int = among((0, 2, 3, 4, 5), "tie bolts on each side")
    nuts: bool = chance(0.6, "nuts on them", when=lambda p: p.ties)
    feet: str = among(("down", "blocks", "angles"), "what it stands on")
    behind: bool = chance(0.2, "two of the mouths are on the far plate")
    mouth: _Mouth = nested(_Mouth, "the mouths", fixed=lambda p: {"dn": p.dn})
    reach: float = between(0.05, 0.16, "length of a mouth", "m")

    def build(self, t: Table) -> Model:
        w = max(2 * self.wide * t.pipe.radius, 1.15 * t.flange.outer / 0.5)
        h, deep, thick = self.tall * w, self.deep * w, self.ends
        z = self.low * h
        wide, far = w * (1 + self.more) + 0.02, thick + deep
        plates = [self._plate(x, wide, h, z) for x in (thick / 2, far + thick / 2)]
        mouths, ports = self._mouths(t, w, h, z, far + thick)
        front = [m for m, p in zip(mouths, ports, strict=True) if p.frame[0, 0] < 0]
        back = [m for m, p in zip(mouths, ports, strict=True) if p.frame[0, 0] > 0]
        t.add(_NAME, plates[0], *front, *self._feet(wide, h, z, thick / 2), of="valve")
        more = self._feet(wide, h, z, far + thick / 2) if self.feet != "down" and not self.column else []
        t.add(_NAME, plates[1], *back, *more, of="valve")
        self._pack(t, w, h, z, far)
        self._bars(t, w, h, z, far + thick)
        self._ties(t, wide, h, z, far + thick)
        return t.model(kind="plate heat exchanger", ports=ports)

    def _plate(self, x: float, wide: float, h: float, z: float) -> Solid:
        return box((self.ends, wide, h * 1.04), (x, 0, z + h / 2))

    def _mouths(self, t: Table, w: float, h: float, z: float, end: float) -> tuple[list[Solid], list[Port]]:
        """Four mouths at the corners, those below at times behind; the ports on the first plate come first."""
        solids, ports, n = [], [], self.n(t, t.pipe.radius)
        y, up = 0.27 * w, min(0.14 * h + 0.25 * t.flange.outer, 0.3 * h)
        for level, s in ((z + h - up, 1), (z + h - up, -1), (z + up, 1), (z + up, -1)):
            back = self.behind and level < z + h / 2
            x, way = (end + self.reach, 1) if back else (-self.reach, -1)
            solid, port = self.mouth.build(t, (x, s * y, level), (way, 0, 0), self.reach + 0.5 * self.ends, n)
            solids.append(solid)
            ports.append(Port(port.frame, port.dn, 1 if back else 0))
        return solids, ports

    def _feet(self, wide: float, h: float, z: float, x: float) -> list[Solid]:
        if self.feet == "down":
            return [box((self.ends, wide, z + 0.02 * h), (x, 0, (z + 0.02 * h) / 2))]
        if self.feet == "blocks":
            return [box((2 * self.ends + 0.02, 0.2 * wide, z), (x, s * 0.38 * wide, z / 2)) for s in BOTH]
        flats = [box((4 * self.ends + 0.04, 0.16 * wide, 0.01), (x, s * 0.4 * wide, 0.005)) for s in BOTH]
        return [
            *flats,
            *(box((0.01, 0.16 * wide, z + 0.02 * h), (x, s * 0.4 * wide, (z + 0.02 * h) / 2)) for s in BOTH),
        ]

    def _pack(self, t: Table, w: float, h: float, z: float, far: float) -> None:
        low, mid = self.ends, z + h / 2
        if self.pack == "block":
            t.add(_NAME, box((far - low, w, 0.96 * h), ((far + low) / 2, 0, mid)), of="trim")
            return
        step = (far - low) / self.count
        xs = low + step * (np.arange(self.count) + 0.5)
        share = self.spaced if self.pack == "plates" else 0.5
        plates = [box((share * step, w, 0.96 * h), (float(x), 0, mid)) for x in xs]
        if self.pack == "ribs":
            plates.append(box((far - low, 0.96 * w, 0.93 * h), ((far + low) / 2, 0, mid)))
            t.add(_NAME, *plates, of="trim")
        else:
            t.add_each(_NAME, plates, of="trim", joined=self.count > 16)

    def _bars(self, t: Table, w: float, h: float, z: float, end: float) -> None:
        """The carrying bars above and below, and the column at their end."""
        if self.bars == "none":
            return
        far, side = end + self.beyond * self.deep * w, 0.03 + 0.06 * w
        levels = (z + h + 0.3 * side, z + 0.01 * h)
        if self.bars == "rods":
            bars = [rod((0, 0, level), (far, 0, level), 0.35 * side, self.n(t, side)) for level in levels]
        else:
            bars = [box((far, 0.5 * side, side), (far / 2, 0, level)) for level in levels]
        t.add_each(_NAME, bars, of="steel")
        if self.column:
            tall = z + h + side
            t.add(_NAME, box((1.2 * side, 1.6 * side, tall), (far, 0, tall / 2)), of="steel")

    def _ties(self, t: Table, wide: float, h: float, z: float, end: float) -> None:
        if not self.ties:
            return
        r, out, n = 0.006 + 0.012 * wide, 0.25 * self.deep * wide * 0.3 + 0.03, self.n(t, 0.02)
        y = wide / 2 + 0.2 * r
        spots = [(s * y, z + h * float(f)) for s in BOTH for f in np.linspace(0.1, 0.9, self.ties)]
        ends = [box((0.6 * self.ends, 4 * r, 4 * r), (x, y, level)) for y, level in spots for x in (0.3 * self.ends,)]
        ties = [along("x", cylinder(r, -out, end + out, n), 0, y, level) for y, level in spots]
        t.add_each("stud", ties, own=False)
        if self.nuts:
            nut = hexagon(3.4 * r, 0, 1.6 * r)
            for way, x in (("-x", 0.0), ("x", end)):
                t.add("nut", *(along(way, nut, x, y, level) for y, level in spots))
        else:
            t.add(_NAME, *ends, of="valve")


class Stack(_Stack, name="heat exchanger/plain plates", weight=1.2):
    """A plate exchanger of plain shapes, as finely as the style has equipment."""


class StackInPieces(_Stack, name="heat exchanger/plates in pieces", weight=1.5, grain="fitting"):
    """A plate exchanger of plain shapes, each a piece of its own."""


PLATE_STACKS = families_of(Stack, StackInPieces)
