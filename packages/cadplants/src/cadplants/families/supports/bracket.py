"""Brackets that hold no line: shelves, instrument stands, motor slides, feet."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import (
    Feet,
    Fitting,
    Footing,
    add_bolt,
    add_nuts,
    add_wall,
    few,
    foot_of,
    screwed,
    slab_yz,
    strap,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, ring, rod, rope, turned

__all__ = ["BRACKETS"]

_B = "bracket"
# What pressed down at z presses towards -y here.
_FORWARD = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def _stripped(p: Any) -> bool:
    return bool(p.form != "tubes")


class Shelf(Fitting, name="bracket/shelf", label=_B):
    """Shelf brackets on a wall: strip with a strut, rib, forged scroll, U with cheeks, tube arm."""

    count: int = whole(2, 4, "brackets")
    gap: float = between(0.35, 0.7, "from bracket to bracket", "m")
    reach: float = between(0.15, 0.4, "from the wall to the bracket's end", "m")
    form: str = among(("strut", "rib", "scroll", "cheeks", "tubes"), "how the brackets are made")
    drop: float = between(0.12, 0.35, "height of a bracket", "m", when=_stripped)
    thick: float = among((0.004, 0.006, 0.008), "of a bracket's strip", "m", when=_stripped, otherwise=0.0)
    wide: float = between(0.025, 0.06, "width of a bracket's strip", "m", when=_stripped)
    level: float = between(0.7, 1.6, "height of the shelf", "m")
    wall: float = between(0.1, 0.25, "thickness of the wall", "m")
    stepped: bool = chance(0.5, "the cheeks follow the strip, not a slant", when=lambda p: p.form == "cheeks")
    boarded: bool = chance(0.75, "a board on the brackets")
    board: float = between(-0.02, 0.08, "depth of the board - of the brackets", "m", when=lambda p: p.boarded)

    def build(self, t: Table) -> Model:
        reach, drop, wide, thick, level = self.reach, self.drop, self.wide, self.thick, self.level
        length, tubes = (self.count - 1) * self.gap + 0.3, self.form == "tubes"
        add_wall(t, length + 0.4, self.wall, 0.0, 0.0, level + 0.5)
        strip = [
            box((wide, thick, drop), (0, -thick / 2, -drop / 2)),
            box((wide, reach - thick, thick), (0, -thick - (reach - thick) / 2, -thick / 2)),
        ] if drop else []  # fmt: skip
        solids, half = self._solids(t), (self.count - 1) * self.gap / 2
        for x in np.linspace(-half, half, self.count):
            spot = t.at(float(x), 0, level)
            spot.add(_B, *strip, *solids)
            for z in () if tubes else (-0.03, -0.75 * drop):
                aside = 0.3 * wide if self.form in ("rib", "cheeks") else 0.0
                screwed(spot, 0.008, thick, -aside if z > -0.05 else aside, 0.0, z)
        if self.boarded:
            t.add("plate", box((length, reach + self.board, 0.02), (0, -reach / 2 - 0.01, level + 0.01)))
        return t.model()

    def _solids(self, t: Table) -> list[Solid]:
        """What a bracket is besides its bent strip; all of it of one of tubes."""
        reach, drop, wide, thick = self.reach, self.drop, self.wide, self.thick
        if self.form == "strut":
            return [strap([[0, -thick, -0.88 * drop], [0, -0.85 * reach, -thick]], 0.6 * wide, thick)]
        if self.form == "rib":
            rib = outline(-thick, -thick, -0.9 * reach, -thick, -thick, -0.9 * drop)
            return [slab_yz(rib, -thick / 2, thick / 2)]
        if self.form == "scroll":
            a, curl = np.linspace(0, np.pi / 2, 8), np.linspace(0, 3.6 * np.pi, 28)
            z = -0.95 * drop + 0.93 * drop * np.sin(a)
            bow = np.column_stack([np.zeros(8), -thick - 0.9 * reach * (1 - np.cos(a)), z])
            q = 0.18 * min(reach, drop) * (1 - 0.6 * curl / curl[-1])
            y, z = -0.32 * reach - q * np.cos(curl), -0.33 * drop + q * np.sin(curl)
            scroll = np.column_stack([np.zeros(28), y, z])
            return [strap(bow, 0.5 * wide, thick), strap(scroll, 0.4 * wide, 0.7 * thick)]
        if self.form == "cheeks":
            knee = (-thick - 0.012, -0.92 * drop) if self.stepped else (-0.45 * reach, -0.3 * drop)
            rim = outline(-thick, -thick, -0.92 * reach, -thick, -0.92 * reach, -thick - 0.015)
            rim += [knee, (-thick, -0.92 * drop)]
            return [slab_yz(rim, s * 0.5 * wide - thick / 2, s * 0.5 * wide + thick / 2) for s in BOTH]
        n = few(0.012, t.style)
        arm, stay = (0, -reach, -0.012), (0, -0.8 * reach, -0.018)
        rods = [rod((0, -0.004, -0.012), arm, 0.012, n), rod((0, -0.004, -0.08), stay, 0.008, n)]
        return [box((0.06, 0.006, 0.1), (0, -0.003, -0.04)), *rods]


class InstrumentStand(Fitting, Feet, name="bracket/instrument stand", label=_B, weight=1.5):
    """An instrument stand: a 2 inch post on a foot, a bent plate on it with U-bolts, an instrument."""

    high: float = between(1.0, 1.5, "height of the post", "m")
    side: float = between(0.16, 0.25, "width of the foot", "m")
    foot: Footing = foot_of()
    square: bool = chance(0.25, "the post is square")
    capped: bool = chance(0.5, "a cap on the post")
    drop: float = between(0.08, 0.25, "from the post's end to the plate's middle", "m")
    thick: float = among((0.003, 0.005), "of the plate", "m")
    wide: float = between(0.09, 0.16, "width of the plate", "m")
    tall: float = between(0.09, 0.18, "height of the plate", "m")
    form: str = among(("flat", "L", "U"), "how the plate is bent")
    two: bool = chance(0.6, "two U-bolts")
    instrument: str = among(("junction box", "transmitter", "gauge"), "what is on it")
    size: float = between(0.1, 0.22, "width of the junction box", "m", when=lambda p: p.instrument == "junction box")

    def build(self, t: Table) -> Model:
        r, high, thick, wide, tall = 0.0302, self.high, self.thick, self.wide, self.tall
        n, low, level, front = t.n(r), self.foot.top, high - self.drop, -r - thick
        if self.square:
            t.add("post", extrude(rounded_rectangle(2 * r, 2 * r, 0.004, 2), low, high))
        else:
            t.add("post", ring(r - 0.004 if t.style.hollow else 0, r, low, high, n))
        self.foot.build(t, self.side, 2 * r)
        if self.capped:
            t.add("plate", cylinder(r + 0.003, high, high + 0.004, n))
        plate = [box((wide, thick, tall), (0, -r - thick / 2, level))]
        if self.form == "L":
            plate.append(box((wide, 0.1, thick), (0, front - 0.05, level - tall / 2 + thick / 2)))
        elif self.form == "U":
            x, y = wide / 2 - thick / 2, front - 0.025
            plate += [box((thick, 0.05, tall), (s * x, y, level)) for s in BOTH]
        t.add(_B, *plate)
        for z in (level - 0.3 * tall, level + 0.3 * tall) if self.two else (level,):
            self._u_bolt(t, r, front, z)
        self._instrument(t.at(0, front - (0.05 if self.form == "U" else 0.0), level))
        return t.model()

    def _u_bolt(self, t: Table, r: float, front: float, z: float) -> None:
        """A U-bolt round the post, its nuts in front of the plate [m]."""
        d = 0.008
        leg, end = r + d / 2, front - 2.2 * d
        b = np.linspace(0, np.pi, 11)
        bow = np.column_stack([leg * np.cos(b), leg * np.sin(b), np.full(11, z)])
        if self.square:
            bow = np.array([[leg, leg, z], [-leg, leg, z]])
        t.add("u-bolt", rope(np.vstack([[[leg, end, z]], bow, [[-leg, end, z]]]), d / 2, few(d / 2, t.style)))
        add_nuts(t.moved(_FORWARD), [(s * leg, z, front) for s in BOTH], d)

    def _instrument(self, t: Table) -> None:
        """The instrument, its back on y = 0, its middle on z = 0."""
        if self.instrument == "junction box":
            s, deep = self.size, 0.09
            lid = box((s * 1.03, 0.012, 1.23 * s), (0, -deep + 0.004, 0))
            t.add("junction box", box((s, deep, 1.2 * s), (0, -deep / 2, 0)), lid)
        elif self.instrument == "transmitter":
            q, y = 0.045, -0.06
            n = t.n(q)
            barrel = [along("y", cylinder(q, -0.06, 0.06, n), 0, y)]
            barrel += [along("y", cylinder(1.1 * q, -0.012, 0.012, n), 0, y + s * 0.05) for s in BOTH]
            t.add("transmitter", *barrel, box((0.05, 0.04, 0.1), (0, y, -q - 0.03)), of="gauge")
        else:
            t.along("-y").add("gauge", cylinder(0.05, 0, 0.045, t.n(0.05)))


class MotorSlide(Fitting, name="bracket/motor slide", label=_B):
    """Motor slide rails (DIN 42923): two slotted rails on a base or a slab, tensioning screws, a motor on feet."""

    long: float = between(0.35, 0.7, "length of the rails", "m")
    gap: float = between(0.2, 0.4, "from rail to rail", "m")
    wide: float = between(0.04, 0.07, "width of a rail", "m")
    high: float = between(0.025, 0.05, "height of a rail", "m")
    size: float = among((0.01, 0.012), "diameter of the bolts", "m")
    low: float = among((0.0, 0.1, 0.2), "height of a slab below", "m")
    solid: bool = chance(0.5, "the rails are solid")
    brackets: bool = chance(0.6, "the rails are taken for brackets, not for plates")

    def build(self, t: Table) -> Model:
        length, gap, wide, d, low, top = self.long, self.gap, self.wide, self.size, self.low, self.low + self.high
        if low:
            t.add("foundation", box((length + 0.2, gap + 0.3, low), (0, 0, low / 2)))
        n, rail = few(d, t.style), self._rail(low, top)
        # The screws press on the motor's soles.
        push, nut = cylinder(d / 2, -0.06, 0.29 * length + 0.02, n), hexagon(1.6 * d, 0.05, 0.05 + 0.7 * d)
        for s in BOTH:
            side = t.at(0, s * gap / 2)
            side.add(_B if self.brackets else "plate", rail)
            side.add(_B, box((0.02, wide * 0.5, 0.035), (-0.44 * length, 0, top + 0.0175)))
            screw = [along("x", push), along("-x", nut)]
            side.at(-0.44 * length, 0, top + 0.009).add("screw", *screw, fine=False)
            for q in (-0.4, 0.4) if self.solid else ():
                add_bolt(side.at(q * length * 1.1, 0, top - 0.004), d, 0.004, "none")
        r, foot, inner = 0.32 * gap + 0.02, 0.016, gap / 2 - 0.3 * wide
        for s in BOTH:
            sole = box((0.3 * length, wide, foot), (0.02, s * gap / 2, top + foot / 2))
            t.add(_B, sole, box((0.26 * length, 0.012, 0.7 * r), (0.02, s * inner, top + 0.35 * r)))
            for q in (-0.1, 0.1):
                add_bolt(t.at(0.02 + q * length, s * gap / 2, top), d, foot, "none")
        motor = t.at(0, 0, top + r + 0.02)
        shell = outline(0.6 * r, 0, r, 0.02, r, 0.5 * length, 0.9 * r, 0.56 * length)
        motor.at(-0.24 * length).along("x").add("motor", turned(shell, t.n(r)))
        motor.at(0.3 * length).along("x").add("shaft", cylinder(0.16 * r, 0, 0.18 * length, few(0.1 * r, t.style)))
        if r <= inner:
            size, y = (0.24 * length, inner - 0.75 * r, 0.3 * r), (inner + 0.75 * r) / 2
            t.add("motor", *(box(size, (0.02, s * y, top + 0.5 * r)) for s in BOTH))
        return t.model()

    def _rail(self, low: float, top: float) -> Solid:
        """A rail between two heights."""
        length, wide, d = self.long, self.wide, self.size
        slot = rounded_rectangle(0.62 * length, 1.15 * d, 0.57 * d, 4)
        if self.solid:
            return extrude(rounded_rectangle(length, wide, 0.01, 2), low, top, (slot,))
        # A top with a slot, side walls and end feet.
        tall = top - low - 0.008
        size, y = (0.8 * length, 0.006, tall), wide / 2 - 0.003
        walls = [box(size, (0, q * y, low + tall / 2)) for q in BOTH]
        walls += [box((0.1 * length, wide + 0.02, 0.012), (q * 0.47 * length, 0, low + 0.006)) for q in BOTH]
        return merge([extrude(rounded_rectangle(length, wide, 0.008, 2), top - 0.008, top, (slot,)), *walls])


BRACKETS = families_of(Shelf, InstrumentStand, MotorSlide)
