"""Hangers of other kinds: constant box, hook, chain, band, saddle on two rods, hinged ring."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, given
from cadplants.builder.table import Table, outline
from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.hanger import Hanger, add_eye, add_nut, add_rod, add_upright_clamp
from cadplants.families.supports.shape import (
    Feet,
    Overhead,
    add_bolt,
    arc_yz,
    eye,
    few,
    hung,
    piece_of,
    radius,
    slab_yz,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import Solid, extrude, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, dome, hexagon, rod, rope
from cadplants.solids.transforms import at, spun

__all__ = ["SLINGS"]

_NAME = "pipe hanger"


class _Ceiling(Feet):
    """The end of a rod: a flange plate with screws, or a bracket plate, on a beam or a concrete slab."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    round: bool = chance(0.5, "the plate is round")
    taken: str = among(("bracket", _NAME), "what the plate is taken for")
    slab: bool = chance(0.4, "on a slab, not on a beam")
    wide: float = between(0.5, 1.2, "width of the slab", "m", when=lambda p: p.slab)
    thick: float = between(0.1, 0.2, "thickness of the slab", "m", when=lambda p: p.slab)
    over: Overhead = hung(when=lambda p: not p.slab)

    def build(self, t: Table, d: float, z: float) -> None:
        """Puts it down, on a rod of diameter ``d`` that ends at ``z`` [m]."""
        thick, r = 0.006, 0.03 + 1.2 * d
        shape = circle(r, t.n(r, 10)) if self.round else rounded_rectangle(2.6 * r, 1.4 * r, 0.005, 2)
        t.add(self.taken, extrude(shape, z, z + thick), hexagon(1.7 * d, z - 1.5 * d, z + 0.001), of="steel")
        for x in (-0.7 * r, 0.7 * r) if self.round else (-r, r):
            add_bolt(t.at(x, 0, z + thick).spun("x", np.pi), 0.006, thick, "none")
        if self.slab:
            slab = box((self.wide, self.wide, self.thick), (0, 0, z + thick + self.thick / 2))
            t.add("platform", slab, of="concrete")
        else:
            self.over.build(t, z + thick)


def _ceiling(when: Any = None) -> _Ceiling:
    """A field: what a rod ends at."""
    return piece_of(_Ceiling, "what the rod ends at", "height", "holes", "structure", when=when)


class Constant(Hanger, name="pipe hanger/constant", sizes=SIZES[5:]):
    """A constant hanger (MSS SP-58 type 54): a frame with a lever, a lying spring can, a rod, a clamp."""

    drop: float = between(0.15, 0.5, "from the eye to the frame", "m")
    back: float = between(0.8, 1.2, "length of the frame / the usual one")
    reach: float = between(0.8, 1.4, "length of the can / the usual one")
    round: bool = chance(0.6, "the can is round")
    plated: bool = chance(0.4, "a name plate")
    over: Overhead = hung(0.12)

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        d, k = 0.012 + 0.06 * r, 1.0 + 3.0 * r
        add_upright_clamp(t, d, 3 * d, 0.9 * d)
        loop = r + 0.005 + 0.02 * r + 2.4 * d
        low, tall, back, thick, gap = loop + self.drop, 0.22 * k, 0.2 * k * self.back, 0.006, 0.03 * k
        add_eye(t.at(0, 0, loop), d, 0.5 * d)
        add_rod(t, d, loop + 0.8 * d, low + 0.05 * k)
        top = low + tall
        side = outline(0.05 * k, low, 0.07 * k, low + 0.4 * tall, -0.02 * k, top, -back, top, -back, low + 0.35 * tall)
        side.append((-0.06 * k, low))
        plates = [upright(side, s * gap - thick / 2, s * gap + thick / 2) for s in BOTH]
        spring, reach, x, z = 0.075 * k, 0.35 * k * self.reach, -back + 0.002, low + 0.65 * tall
        n = t.n(spring, 10)
        can = box((reach, 2 * spring, 2 * spring), (x - reach / 2, 0, z))
        if self.round:
            can = along("-x", cylinder(spring, 0, reach, n), x, 0, z)
        lid = along("-x", cylinder(1.08 * spring, reach - 0.008, reach, n), x, 0, z)
        t.add(_NAME, *plates, can, lid, of="motor")
        lever = outline(0.02 * k, low + 0.02, 0.02 * k, low + 0.08 * k, -0.12 * k, z, -0.14 * k, low + 0.5 * tall)
        t.add(_NAME, upright([*lever, (-0.02 * k, low + 0.01)], -0.008, 0.008), of="trim")
        for px, pz in ((0.0, low + 0.05 * k), (-0.11 * k, low + 0.6 * tall)):
            t.at(px, 0, pz).along("y").add("bolt", cylinder(0.012 * k, -gap - 0.012, gap + 0.012, 10))
        t.add("plate", box((back * 0.7, 2 * gap, 0.012), (-back / 2, 0, top + 0.006)))
        if self.plated:
            place = (-0.03 * k, -gap - thick / 2 - 0.0005, low + 0.3 * tall)
            t.add(_NAME, box((0.04, 0.001, 0.07), place), of="dial", fine=True)
        self.over.build(t.at(-back / 2), top + 0.012)
        return t.model()


class Hook(Hanger, name="pipe hanger/hook"):
    """A J hanger (MSS SP-58 type 5): an open hook of strap or round bar under a rod or beside a beam."""

    flat: bool = chance(0.55, "of strap, not of round bar")
    end: float = between(1.9, 2.2, "where the hook ends / half a turn", when=lambda p: p.flat)
    up: float = between(0.02, 0.06, "height of the strap over the line", "m", when=lambda p: p.flat)
    bent: bool = chance(0.6, "bent over the line to a hole for the rod", when=lambda p: p.flat)
    beam: float = between(
        0.5, 1.0, "length of the beam that it is screwed to", "m", when=lambda p: p.flat and not p.bent
    )
    drop: float = between(0.15, 0.7, "length of the rod", "m", when=lambda p: p.bent or not p.flat)
    above: _Ceiling = _ceiling(when=lambda p: p.bent or not p.flat)

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        d, thick, wide, steps = 0.008 + 0.05 * r, 0.003 + 0.012 * r, 0.018 + 0.15 * r, max(8, few(r, t.style, 24))
        up, middle = r + self.up, r + thick / 2
        if not self.flat:
            knee, bar = 1.6 * r + 0.03, 0.5 * d
            bent = arc_yz(r + bar, np.pi * 0.75, 2 * np.pi + 0.15, steps)
            t.add(_NAME, rope(np.vstack([[[0, 0, knee + 3 * d], [0, 0, knee]], bent]), bar, few(bar, t.style)))
            t.add("nut", hexagon(1.7 * d, knee + 1.2 * d, knee + 4.5 * d), fine=False)
            start = knee + 1.5 * d
        else:
            bent = arc_yz(middle, np.pi, self.end * np.pi, steps)
            first = [[0, 0.9 * d, up], [0, -middle, up]] if self.bent else [[0, -middle, up + 3 * d]]
            t.add(_NAME, strap(np.vstack([first, bent]), wide, thick))
            if not self.bent:  # straight on, screwed to the side of a beam
                z, y = up + 2.2 * d, -middle + thick / 2
                for q in (-0.6, 0.6):
                    pose = spun("x", -np.pi / 2) @ at(0, 0, thick) @ spun("x", np.pi)
                    add_bolt(t.at(0, y - thick, z + q * d).moved(pose), 0.6 * d, thick, "none")
                t.add("beam", box((self.beam, 0.06, 0.12), (0, y + 0.03, z + 0.01)))
                return t.model()
            add_nut(t, d, up + thick / 2)
            add_nut(t, d, up - thick / 2, up=False)
            start = up - thick / 2 - d
        add_rod(t, d, start, start + self.drop)
        self.above.build(t, d, start + self.drop)
        return t.model()


class Chain(Hanger, name="pipe hanger/chain"):
    """A line in a sling of chain or wire rope with a shackle, a hook or thimble clips below an eye on a beam."""

    flat: bool = chance(0.4, "the sling is flat")
    wide: float = among((0.0, 0.03), "width of the sling over 20 mm", "m", when=lambda p: p.flat, otherwise=0.0)
    drop: float = between(0.15, 0.6, "length of the chain or rope", "m")
    links: bool = chance(0.6, "a chain, not a rope")
    over: Overhead = hung()

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        d, low, quarter = 0.006 + 0.025 * r, 1.5 * r + 0.05, np.pi / 2
        lean = float(np.arcsin((r + d / 2) / low))  # where the legs leave the line as tangents
        sling = arc_yz(r + d / 2, np.pi - lean, 2 * np.pi + lean, max(10, few(r, t.style, 24)))
        path = np.vstack([[[0, -0.4 * d, low]], sling, [[0, 0.4 * d, low]]])
        body = strap(path, 0.02 + self.wide, 0.5 * d) if self.flat else rope(path, d / 2, few(d / 2, t.style))
        t.add(_NAME, body, of="trim")
        t.at(0, 0, low + 1.2 * d).spun("z", quarter).add(_NAME, eye(1.6 * d, 0.5 * d, t.style), of="trim")
        z = low + 3.0 * d
        top = z + self.drop
        if self.links:
            pitch = 3.0 * d
            count = min(16, max(2, int((top - z) / pitch)))
            link = _link(pitch, 0.9 * d, d, few(0.4 * d, t.style, 8))
            poses = [at(0, 0, z + (k + 0.2) * pitch) @ spun("z", (k % 2) * quarter) for k in range(count)]
            t.add(_NAME, *(moved(link, pose) for pose in poses), of="trim")
            top = z + (count - 0.8) * pitch + 0.8 * pitch
        else:  # wire rope with clips
            t.add(_NAME, rod((0, 0, z - 1.5 * d), (0, 0, top), 0.4 * d, few(0.4 * d, t.style)), of="trim")
            for q in range(3):
                clip = box((2.2 * d, 1.4 * d, 0.9 * d), (0, 0, z + (1 + 2.5 * q) * d))
                t.add("clamp", clip, of="fastener", fine=True)
        add_eye(t.at(0, 0, top + d).spun("z", quarter), 1.5 * d, 0.5 * d, "bolt")
        t.add("bolt", cylinder(0.6 * d, top + 2.6 * d, top + 5 * d, few(d, t.style)), fine=False)
        self.over.build(t, top + 5 * d)
        return t.model()


def _link(pitch: float, wide: float, d: float, sides: int) -> Solid:
    """A link of a chain of round bar, upright in the plane y = 0 [m]."""
    a = np.linspace(0, np.pi, 5)
    half = np.column_stack([wide * np.cos(a), np.zeros(5), 0.8 * pitch - wide + wide * np.sin(a)])
    path = np.vstack([half, half[::-1] * (1, 1, -1)])
    return sweep(path, circle(0.42 * d, sides), closed=True, up=(0.0, 1.0, 0.0))


class Band(Hanger, name="pipe hanger/band"):
    """A band looped under the line and screwed together above it: on a joist or with a foot on a beam."""

    high: float = between(0.0, 0.45, "length of the band over the line over the usual one", "m")
    joist: bool = chance(0.5, "up both sides of a joist")
    long: float = between(0.5, 1.2, "length of the joist", "m", when=lambda p: p.joist)
    taken: str = among(("bracket", _NAME), "what the foot is taken for", when=lambda p: not p.joist)
    over: Overhead = hung(when=lambda p: not p.joist)

    def build(self, t: Table) -> Model:
        r, d = t.pipe.radius, 0.006
        thick, wide, steps = 0.0012 + 0.006 * r, 0.017 + 0.1 * r, max(8, few(r, t.style, 28) // 2)
        middle, high = r + thick / 2, 1.5 * r + 0.09 + self.high
        if self.joist:
            low, tip = arc_yz(middle, np.pi, 2 * np.pi, steps), high + 0.08
            t.add(_NAME, strap(np.vstack([[[0, -middle, tip]], low, [[0, middle, tip]]]), wide, thick))
            t.add("beam", box((self.long, 2 * r, 0.15), (0, 0, high + 0.075)))
            for s in BOTH:
                for z in (high + 0.02, high + 0.06):
                    add_bolt(t.at(0, s * r, z).spun("x", -s * np.pi / 2), d, thick, "none")
            return t.model()
        near, y = 1.5 * r + 0.02, thick / 2 + 0.0005
        lean = float(np.arcsin(middle / near))
        low = arc_yz(middle, np.pi - lean, 2 * np.pi + lean, 2 * steps)
        t.add(
            _NAME,
            strap(np.vstack([[[0, -y, high], [0, -y, near]], low, [[0, y, near], [0, y, near + 0.05]]]), wide, thick),
        )
        add_bolt(t.at(0, -thick - 0.0005, near + 0.025).spun("x", -np.pi / 2), d, 2 * thick + 0.001)
        foot = [[0, -y, high - 0.02], [0, -y, high + thick / 2], [0, -0.05, high + thick / 2]]
        t.add(self.taken, strap(foot, wide, thick), of="clamp")
        add_bolt(t.at(0, -0.035, high + thick).spun("x", np.pi), d, thick, "none")
        self.over.build(t, high + thick)
        return t.model()


class TwoRod(Hanger, name="pipe hanger/two-rod saddle"):
    """A saddle plate hung on two rods: a bent cradle with ears, a flat bar with stops, a V."""

    form: str = among(("cradle", "bar", "vee"), "how it is made")
    hanger: bool = chance(0.75, "the saddle is taken for a pipe hanger, not a bracket")
    drop: float = between(0.1, 0.6, "from the top of the line to the end of the rods", "m")
    over: Overhead = hung(lambda p: TwoRod.out(p))

    @staticmethod
    def out(p: Any) -> float:
        """From the line's axis to a rod [m]."""
        r = radius(p)
        ear, thick = 3.2 * (0.008 + 0.05 * r), 0.005 + 0.015 * r
        return r + thick + 0.55 * ear if p.form == "cradle" else r + 0.6 * ear

    def build(self, t: Table) -> Model:
        r, y = t.pipe.radius, self.out(self)
        d, thick, wide = 0.008 + 0.05 * r, 0.005 + 0.015 * r, 0.03 + 0.25 * r
        ear, top = 3.2 * d, r + self.drop
        if self.form == "cradle":
            solids, level = [moved(half_band(r, thick, wide, ear, t.style, 0.002), spun("x", np.pi))], -0.001
        elif self.form == "bar":
            solids, level = [box((wide, 2 * (r + ear), thick), (0, 0, -r - thick / 2))], -r
            solids += [box((wide, 0.005, 0.3 * r), (0, s * (r + 0.0025), -0.85 * r)) for s in BOTH]
        else:
            level, tip = -0.2 * r, -1.41421 * r
            flank = outline(r + ear, level - thick, r + ear, level, r + 0.2 * ear, level)
            left = [(-a, b) for a, b in flank[::-1]]
            solids = [slab_yz([(0, tip - thick), *flank, (0, tip), *left], -wide / 2, wide / 2)]
        t.add(_NAME if self.hanger else "bracket", *solids, of="clamp")
        for s in BOTH:
            side = t.at(0, s * y)
            add_rod(side, d, level - thick - 1.6 * d, top)
            add_nut(side, d, level)
            add_nut(side, d, level - thick, up=False)
            add_nut(side, d, top, up=False)
        self.over.build(t, top)
        return t.model()


class HingedRing(Hanger, name="pipe hanger/hinged ring", sizes=SIZES[:10]):
    """A split ring with a hinge and a latch (MSS SP-58 type 11) under a socket, a ball joint above."""

    drop: float = between(0.15, 0.7, "from the ring to the end of the rod", "m")
    nut: bool = chance(0.5, "a nut on the socket")
    plate: bool = chance(0.5, "a plate above, not a ball joint")
    above: _Ceiling = _ceiling(when=lambda p: p.plate)
    over: Overhead = hung(when=lambda p: not p.plate)

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        d, n, thick, wide = 0.008 + 0.04 * r, max(8, few(r, t.style, 28) // 2), 0.006 + 0.02 * r, 0.014 + 0.06 * r
        sides, rim = few(d, t.style), r + thick
        halves = [strap(arc_yz(r + thick / 2, a + 0.04, a + np.pi - 0.04, n), wide, thick) for a in (0, np.pi)]
        lugs = [box((wide, 2.2 * d, 0.9 * d), (0, rim + 0.7 * d, s * 0.5 * d)) for s in (1, -1)]
        knuckle = along("x", cylinder(0.7 * d, -0.5 * wide, 0.5 * wide, sides), 0, -rim - 0.3 * d, 0)
        socket = cylinder(0.9 * d, r + 0.5 * thick, rim + 1.6 * d, sides)
        for half, lug, end in zip(halves, lugs, (socket, knuckle), strict=True):
            t.add(_NAME, half, lug, end)
        add_bolt(t.at(0, rim + 0.85 * d, -0.95 * d), 0.6 * d, 1.9 * d, "none")
        z = rim + 1.2 * d
        top = z + self.drop
        add_rod(t, d, z, top)
        if self.nut:
            add_nut(t, d, rim + 1.6 * d)
        if self.plate:
            self.above.build(t, d, top)
        else:
            ball = dome(1.6 * d, 1.8 * d, top - 0.2 * d, sides)
            t.add("bracket", ball, cylinder(2.4 * d, top + 1.4 * d, top + 2.0 * d, few(2 * d, t.style)))
            self.over.build(t, top + 2.0 * d)
        return t.model()


SLINGS = families_of(Constant, Hook, Chain, Band, TwoRod, HingedRing)
