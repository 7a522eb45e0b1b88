"""Fasteners at work: swing bolts of a cover, T-bolts and nuts of struts, pins and turnbuckles of tension rods."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, each, given, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.fastener import add_piece, head_solid, nut_solid
from cadplants.families.supports.shape import (
    Fitting,
    few,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_i
from cadplants.solids.primitives import BOTH, CORNERS, bar, box, cylinder, dome, ring, rod
from cadplants.solids.transforms import at

__all__ = ["JOINTS"]


class Swing(Fitting, name="bolt/swing", label="bolt"):
    """A round cover on a neck held by swing bolts (DIN 444) in forked lugs, with wing, star, cap or hexagon nuts."""

    radius: float = between(0.1, 0.3, "of the neck", "m")
    high: float = between(0.1, 0.4, "height of the neck", "m")
    size: float = among((0.01, 0.012, 0.016), "diameter of the bolts", "m")
    count: int = among((4, 6, 8, 10), "bolts")
    domed: bool = chance(0.6, "the cover is domed")
    nut: str = among(("wing", "star", "cap", "hex", "knurled", "flange"), "the nuts")

    def build(self, t: Table) -> Model:
        r, high, d, thick, table = self.radius, self.high, self.size, 0.012, t
        n, low, top, t = t.n(r), high - 0.012 - 2.4 * d, high + thick, t.at(0, 0, 0.012)
        rim = r + 0.02
        t.add("manway", ring(r - 0.006, r, 0.0, high, n), ring(r - 0.006, rim, high - 0.012, high, n))
        t.add("plate", cylinder(r + 0.06, -0.012, 0.0, n))
        t.add("manway", cylinder(rim, high, top, n), *([dome(0.95 * r, 0.25 * r, top, n)] if self.domed else []))
        forks = [box((2.4 * d + 0.022, 0.5 * d, 2.2 * d), (-0.011, s * 0.8 * d, low)) for s in BOTH]
        ears = [box((2.2 * d, 0.5 * d, thick), (-0.4 * d, s * 0.85 * d, high + thick / 2)) for s in BOTH]
        head = moved(head_solid("ring", d, t.style), at(0, 0, low - d))
        shank = cylinder(d / 2, low + 0.8 * d, top + (0.8 if self.nut == "cap" else 3.2) * d, few(d / 2, t.style))
        for k in range(self.count):
            spot = t.spun("z", 2 * np.pi * k / self.count).at(rim + 1.1 * d)
            spot.add("bracket", *forks)
            spot.add("bracket", *ears)
            spot.at(0, 0, low).along("y").add("bolt", cylinder(0.4 * d, -1.4 * d, 1.4 * d, 8))
            add_piece(spot, "bolt", head, shank)
            add_piece(spot.at(0, 0, top + 0.002).spun("z", 0.3 * k), "nut", nut_solid(self.nut, d, t.style))
            spot.add("washer", ring(0.54 * d, 1.2 * d, top, top + 0.002, 10))
        return table.model()


class _Fixing(Params):
    """A bolt in the slot of a strut."""

    tee: bool = chance(0.5, "a T-bolt from below, not a channel nut")
    nut: str = among(("hex", "flange", "wing", "lock"), "nut of the T-bolt", when=lambda p: p.tee)
    head: str = among(
        ("hex", "socket", "flange", "thumb"), "head of the screw in the channel nut", when=lambda p: not p.tee
    )

    def build(self, t: Table, d: float, base: float, top: float, wide: float) -> None:
        """Puts it down, through a strut this wide and what is on it, between two heights [m]."""
        n, style = few(d / 2, t.style), t.style
        if self.tee:
            block = box((0.5 * wide, 2.2 * d, 0.6 * d), (0, 0, base - 0.3 * d))
            shank = cylinder(d / 2, base - 0.1 * d, top + 2.4 * d, n)
            add_piece(t.spun("z", np.pi / 2), "bolt", block, shank)
            add_piece(t.at(0, 0, top + 0.002), "nut", nut_solid(self.nut, d, style))
            add_piece(t, "washer", ring(0.54 * d, 1.3 * d, top, top + 0.002, 10))
        else:
            plan = rounded_rectangle(0.9 * (wide - 0.005), 0.02, 0.003, 1)
            add_piece(t.spun("z", np.pi / 2), "nut", extrude(plan, base - 0.009, base, (circle(d / 2, 8),)))
            head = moved(head_solid(self.head, d, style), at(0, 0, top))
            add_piece(t, "bolt", head, cylinder(d / 2, base - 0.014, top, n))


class _OnStrut(Params):
    """What is screwed on a strut."""

    form: str = among(("plate", "angle", "washer", "step"), "what it is")
    fixings: tuple[_Fixing, ...] = several(made(_Fixing), lambda p: 2 if p.form == "plate" else 1, "bolts in the slot")


class Strut(Fitting, name="bolt/strut", label="bolt"):
    """Struts with slots on a frame, plates and angles on them by hammer-head bolts, channel nuts and square washers."""

    long: float = between(0.6, 1.6, "length of the struts", "m")
    count: int = whole(2, 4, "things on the struts")
    size: float = among((0.008, 0.01, 0.012), "diameter of the bolts", "m")
    gap: float = between(0.25, 0.5, "from strut to strut", "m")
    high: float = between(0.3, 1.0, "height of the struts' upper side", "m")
    things: tuple[_OnStrut, ...] = several(made(_OnStrut), lambda p: p.count, "things on them")

    def build(self, t: Table) -> Model:
        table, s, thick, lip, plate = t, 0.041, 0.0025, 0.0095, 0.006
        length, gap, high, t = self.long, self.gap, self.high, t.at(0, 0, 0.006)
        for y in (0.0, gap):
            solids = [box((length, s, thick), (0, y, high - s + thick / 2))]
            solids += [box((length, thick, s), (0, y + q * (s / 2 - thick / 2), high - s / 2)) for q in BOTH]
            solids += [box((length, lip, thick), (0, y + q * (s / 2 - lip / 2), high - thick / 2)) for q in BOTH]
            t.add("beam", *solids, of="clamp")
            for x in (-0.42 * length, 0.42 * length):
                t.add("post", box((s, s, high - s), (x, y, (high - s) / 2)), of="clamp")
                t.add("base plate", box((0.12, 0.12, 0.006), (x, y, -0.003)))
        middle = high + plate / 2
        for x, thing in zip(np.linspace(-0.33 * length, 0.33 * length, self.count), self.things, strict=True):
            spot = t.at(float(x))
            spots = {"plate": (0.0, gap), "washer": (gap,), "step": (-0.01,)}.get(thing.form, (0.0,))
            if thing.form == "plate":
                spot.add("plate", box((0.05, gap + 0.06, plate), (0, gap / 2, middle)))
            elif thing.form == "angle":
                leg = box((plate, 0.05, 0.06), (0.025 - plate / 2, 0, high + 0.03))
                spot.add("bracket", box((0.05, 0.05, plate), (0, 0, middle)), leg, of="clamp")
            elif thing.form == "washer":
                add_piece(spot, "washer", box((0.04, 0.04, plate), (0, gap, middle)))
            else:
                side = outline(-0.06, middle, 0.022, middle, 0.03, high + 0.04, 0.09, high + 0.04)
                spot.add("bracket", strap([(0, y, z) for y, z in side], 0.04, plate), of="clamp")
            for y, fixing in zip(spots, thing.fixings, strict=True):
                fixing.build(spot.at(0, y), self.size, high - thick, high + plate, s)
        return table.model()


class _Rod(Params):
    """A tension rod from a corner to the middle."""

    low: bool = given(False, "from a lower corner")
    turnbuckle: bool = chance(0.7, "a turnbuckle", when=lambda p: p.low)
    place: float = between(0.3, 0.5, "where that is / half the diagonal", when=lambda p: p.turnbuckle)


class TieRods(Fitting, name="gusset plate/tie rods", label="gusset plate"):
    """Crossed tension rods in a bay: fork ends with pins on gusset plates, turnbuckles or a ring where they meet."""

    wide: float = between(1.0, 2.4, "width of the bay", "m")
    high: float = between(1.0, 2.2, "height of the bay", "m")
    size: float = among((0.1, 0.14), "height of the frame's sections", "m")
    rod: float = among((0.012, 0.016, 0.02, 0.024), "diameter of the rods", "m")
    ring: float = among((0.0, 5.0), "radius of a ring in the middle / diameter of the rods; 0: none")
    taken: str = among(("bracket", "clamp"), "what the first fork is taken for")
    rods: tuple[_Rod, ...] = each(
        lambda rng, _, so_far: _Rod.draw(rng, {"low": len(so_far) % 2 == 0}),
        lambda p: 0 if p.ring else 4,
        "rods without a ring",
    )

    def build(self, t: Table) -> Model:
        w, h, size, d = self.wide, self.high, self.size, self.rod
        section = section_i(size, size, 0.06 * size, 0.08 * size)
        for x in (0.0, w):
            t.at(x).add("column", extrude(section @ np.array([[0.0, 1.0], [-1.0, 0.0]]), 0.015, h))
            t.add("base plate", box((size + 0.1, size + 0.1, 0.015), (x, 0, 0.0075)))
        t.add("beam", bar((size / 2, 0, h - size / 2), (w - size / 2, 0, h - size / 2), section))
        radius, low, high = self.ring * d, 0.03, h - size
        x0, x1 = size / 2, w - size / 2
        mid = np.array([(x0 + x1) / 2, 0.0, (low + high) / 2])
        for k, (sx, sz) in enumerate(CORNERS):
            corner = np.array([x0 if sx < 0 else x1, 0.0, low if sz < 0 else high])
            self._rod(t, k, corner, (-sx, -sz), mid, radius)
        if radius:
            loop = ring(radius - 0.8 * d, radius, -0.9 * d, 0.9 * d, t.n(radius, 12))
            t.at(mid[0], 0, mid[2]).along("y").add("plate", loop)
        return t.model()

    def _rod(self, t: Table, k: int, corner: Floats, inward: tuple[int, int], mid: Floats, radius: float) -> None:
        """A gusset in a corner, a fork with a pin on it, a rod towards the middle."""
        d, thick, (sx, sz) = self.rod, 0.7 * self.rod, inward
        g, sides = 4.5 * d + 0.03, few(d / 2, t.style)
        inner = outline(0, 0, g, 0, g, 0.45 * g, 0.45 * g, g, 0, g)
        plate = upright([(corner[0] + sx * a, corner[2] + sz * b) for a, b in inner], -thick / 2, thick / 2)
        t.add("gusset plate", plate)
        hole = corner + np.array([sx * 0.5 * g, 0.0, sz * 0.5 * g])
        span = np.linalg.norm(mid - hole)
        way, aside = (mid - hole) / span, np.array([0, thick / 2 + 0.2 * d, 0])
        cheek = rounded_rectangle(0.4 * d, 1.8 * d, 0)
        fork = [bar(hole - way * 0.8 * d + q * aside, hole + way * 2.6 * d + q * aside, cheek) for q in BOTH]
        fork.append(rod(hole + way * 2.4 * d, hole + way * 5.5 * d, 0.95 * d, few(d, t.style)))
        t.add("bracket" if k else self.taken, *fork, of="steel")
        pin = cylinder(0.5 * d, -thick / 2 - 0.8 * d, thick / 2 + 0.8 * d, sides)
        add_piece(t.at(hole[0], 0, hole[2]).along("y"), "bolt", pin)
        end = mid - way * radius
        t.add("brace", rod(hole + way * 5.0 * d, end, d / 2, sides))
        if radius:
            add_piece(t, "nut", rod(end + way * 1.2 * d, end - way * 0.4 * d, 0.95 * d, 6))
        elif self.rods[k].turnbuckle:
            start = hole + way * self.rods[k].place * span
            add_piece(t, "nut", rod(start, start + way * 8 * d, 0.95 * d, 6))


JOINTS = families_of(Swing, Strut, TieRods)
