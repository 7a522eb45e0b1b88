"""Backflow preventers, air valves, vacuum breakers and tank vents."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    lying,
)
from cadplants.families.valves.drive import Wheel
from cadplants.families.valves.parts import SMALL, bend, cover, hub_radius, threaded_run
from cadplants.families.valves.valve import Valve, bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import merge
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, rope, turned

__all__ = ["VENTS"]


def _test_cock(t: Table) -> None:
    """A small ball cock for testing, upon z = 0."""
    stub = [cylinder(0.006, -0.008, 0.012, 8), hexagon(0.018, 0.008, 0.03), cylinder(0.007, 0.028, 0.045, 8)]
    t.add("valve body", *stub)
    shank = along("y", cylinder(0.003, 0.0, 0.012, 6), 0, 0, 0.019)
    t.add("lever", box((0.028, 0.004, 0.008), (0.014, 0.012, 0.019)), shank)


class Backflow(Valve, name="backflow preventer/reduced pressure", sizes=sizes_between(50, 200)):
    """A reduced-pressure backflow preventer (EN 12729): two check chests with covers, a relief valve hung between."""

    long: float = between(5.0, 6.5, "length / diameter of the pipe")
    tilt: float = among((0.0, 0.0, 0.6), "of the chests, downstream", "rad")
    square: bool = among((False, True), "the covers are square")
    sensed: bool = chance(0.5, "a pipe from the inlet to the relief valve")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.outer + 0.12
        neck, end, w = hub_radius(t.dn), plate_thickness(t.dn) + 0.04 * length, 1.5 * r + 0.012
        marks = ((w, 0.18), (w, 0.36), (0.85 * w, 0.42), (0.85 * w, 0.52), (w, 0.6), (w, 0.8))
        middle = [(neck, end), *((a, f * length) for a, f in marks), (neck, length - end)]
        t.add("valve body", flanged_body(t.dn, t.style, length, middle))
        n, seat = t.n(w), (1.35 if self.tilt == 0 else 1.7) * w
        for x in (0.27 * length, 0.7 * length):
            up = t.at(x).spun("y", self.tilt)
            up.add("valve body", cylinder(0.92 * w, 0.0, seat - 0.003, n))
            up.extend(cover(1.15 * w + 0.006, seat, 0.008 + 0.1 * r, 8, t.style, self.square, 0.2 * r))
        x = 0.47 * length
        drop, hung = ((0.6, 0), (0.55, 1.1), (1.2, 1.2), (1.2, 1.5), (0.7, 1.8), (0.6, 2.6)), t.at(x).along("-z")
        hung.add("valve body", turned([(a * w, z * w) for a, z in drop], n))
        hung.add("bolt", bolt_circle(8, 1.1 * w, 0.008, 1.22 * w, 1.48 * w))
        if self.sensed:
            ways = ((0.3 * length, 0.9, 0), (0.3 * length, 1.9, -0.2), (x, 1.9, -1.35), (x, 1.1, -1.35))
            t.add("pipe", rope(bend([(a, y * w, z * w) for a, y, z in ways], 0.3 * w, 3), 0.006, 8), own=True)
        for f, z in ((0.12, 0.98 * neck), (0.47, 0.85 * w), (0.88, 0.98 * neck)):
            _test_cock(t.at(f * length, 0, z))
        return t.model(round(length, 6), kind="backflow preventer")


class ThreadedBackflow(Valve, name="backflow preventer/threaded", sizes=SMALL):
    """A threaded backflow preventer (EN 14367 type CA or BA): union ends, slanting or upright caps, a tundish below."""

    long: float = between(6.0, 8.5, "length / radius of the pipe")
    caps: int = whole(1, 2, "screwed caps")
    cocks: int = whole(1, 2, "test cocks")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.06
        n, w, mid = t.n(1.5 * r), 1.45 * r + 0.004, 0.51 * length
        marks = ((1.1 * r, 0.12), (w, 0.28), (w, 0.74), (1.1 * r, 0.88))
        t.add("valve body", threaded_run(t, length, *marks, end=0.14))
        for x in (0.15 * length, 0.8 * length):
            t.at(x).along("x").add("union", hexagon(3.4 * r + 0.006, 0, 0.07 * length), of="valve", own=True)
        for x in (0.36 * length, 0.66 * length)[: self.caps]:
            cap = cylinder(0.7 * w, 0.5 * w, 1.4 * w, n)
            t.at(x).add("valve bonnet", cap, hexagon(1.1 * w, 1.35 * w, 1.75 * w))
        hung = t.at(mid).along("-z")
        hung.add("valve body", cylinder(0.5 * w, 0.0, 1.7 * w, n))
        funnel = turned(outline(1.2 * w, 1.5 * w, 1.2 * w, 2.2 * w, 0.55 * w, 3.4 * w, 0.55 * w, 4.4 * w), n)
        legs = [box((0.15 * w, 0.12 * w, 0.7 * w), (s * 0.8 * w, 0, 1.3 * w)) for s in BOTH]
        hung.add("valve body", funnel, *legs, box((1.7 * w, 0.3 * w, 0.12 * w), (0, 0, w)))
        for x, z in ((0.25 * length, r), (mid, 0.95 * w))[: self.cocks]:
            _test_cock(t.at(x, 0, z))
        return t.model(round(length, 6), "welded", "backflow preventer")


class AirBowl(Valve, name="air valve/bowl", place="head", sizes=sizes_between(25, 200)):
    """An air and vacuum valve (EN 1074-4): a bowl on a flange, a bolted cover, a cowl, elbow or screen on top."""

    wide: float = between(1.5, 2.3, "radius of the bowl / of the pipe")
    tall: float = between(1.6, 3.2, "height of the bowl / radius of the pipe")
    conical: bool = chance(0.5, "the bowl widens from the flange's neck")
    bolts: int = among((4, 6, 8), "of a round cover")
    square: bool = chance(0.3, "its cover is square, with four bolts")
    top: str = among(("cowl", "screen", "elbow", "nozzle"), "what lets the air out")
    cock: bool = chance(0.4, "a test cock on the bowl")

    def build(self, t: Table) -> Model:
        r, w, tall = t.pipe.radius, self.wide * t.pipe.radius + 0.025, self.tall * t.pipe.radius + 0.05
        n, low = t.n(w), plate_thickness(t.dn) + 0.015 + 0.2 * r
        foot = outline(0.9 * hub_radius(t.dn), low - 0.01, w, low + 0.7 * w)
        shell = foot if self.conical else outline(0.6 * w, low, w, low + 0.02)
        t.add("valve body", disc_flange(t.dn, t.style, low + 0.01), turned([*shell, (w, low + tall)], n))
        seat, plate = low + tall + 0.003, 0.01 + 0.05 * w
        t.extend(cover(1.22 * w + 0.008, seat, plate, self.bolts, t.style, self.square))
        self._top(t.at(0, 0, seat + plate), w, n)
        if self.cock:
            z = low + 0.75 * tall
            t.at(0, 0, z).along("y").add("valve body", hexagon(0.02, 0.95 * w, w + 0.025))
            t.add("lever", box((0.05, 0.006, 0.01), (0.015, w + 0.026, z)))
        return lying(t, "air valve")

    def _top(self, t: Table, w: float, n: int) -> None:
        """What lets the air out, on a cover on z = 0, over a bowl of this radius."""
        r, gap = t.pipe.radius, 0.25 * t.pipe.radius + 0.008
        if self.top == "cowl":
            legs = around(cylinder(0.005, -0.001, gap + 0.001, 8), 4, 0.7 * w)
            t.add("valve bonnet", turned(outline(0.9 * w, gap, 0.9 * w, gap + 0.006, 0.3 * w, gap + 0.3 * w), n), legs)
        elif self.top == "screen":
            high = 2 * gap
            posts = around(cylinder(0.003 + 0.03 * r, -0.001, high + 0.001, 8), 3, 0.9 * r)
            t.add("valve bonnet", turned(outline(r, high, r, high + 0.008, 0.5 * r, high + 0.016), n), posts)
            t.add("strainer", ring(0.75 * r, 0.8 * r, -0.001, high, n), of="trim", own=True)
        elif self.top == "elbow":
            path = [(0, 0, -0.002), (0, 0, 1.4 * r), (0, 1.8 * r, 1.4 * r), (0, 1.8 * r, 0.6 * r)]
            t.add("valve bonnet", rope(bend(path, 0.8 * r), 0.6 * r, n))
        else:
            small = turned(outline(0.35 * w, -0.001, 0.35 * w, 0.6 * w, 0.15 * w, 0.75 * w), n)
            t.add("valve bonnet", small, along("y", hexagon(0.25 * w + 0.004, 0.3 * w, 0.5 * w), 0, 0, 0.4 * w))


class DoubleOrifice(Valve, name="air valve/double orifice", place="head", sizes=sizes_between(40, 200)):
    """A double-orifice air valve: a big and a small chamber side by side on one base, covers, an isolating wheel."""

    small: float = between(0.9, 1.7, "radius of the small chamber / of the pipe")
    tall: float = between(1.4, 2.2, "height of the small chamber / its radius")
    isolated: bool = chance(0.6, "a wheel that shuts it off")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.isolated)

    def build(self, t: Table) -> Model:
        r, big, small = t.pipe.radius, 1.7 * t.pipe.radius + 0.022, self.small * t.pipe.radius + 0.02
        n, low, reach = t.n(big), plate_thickness(t.dn) + 0.02 + 1.1 * r, 0.9 * r + 0.01
        base = along("x", cylinder(reach, -big - 0.3 * r, small + 0.3 * r, n), 0, 0, low - 0.2 * r)
        t.add("valve body", disc_flange(t.dn, t.style, low), base)
        for x, w, tall in ((-0.98 * big, big, 2.2 * big), (0.98 * small, small, self.tall * small)):
            up, plate = t.at(x), 0.008 + 0.05 * w
            up.add("valve body", turned(outline(0.6 * w, low - 0.5 * r, w, low + 0.4 * w, w, low + tall - 0.003), n))
            up.extend(cover(1.2 * w + 0.007, low + tall, plate, 6, t.style))
            top = low + tall + plate
            if w == big:
                marks = ((0.8 * r, -0.001), (0.8 * r, 0.4 * r), (1.0 * r, 0.4 * r), (0.9 * r, 0.7 * r))
                up.add("valve bonnet", turned([(a, top + z) for a, z in marks], n))
            else:
                nozzle = cylinder(0.1 * small, top, top + 0.5 * small, 8)
                up.add("valve bonnet", hexagon(0.5 * small, top - 0.001, top + 0.3 * small), nozzle)
        if self.isolated:
            side = t.at(0, 0, low - 0.2 * r)
            out = side.along("-y")
            out.add("valve stem", cylinder(0.006 + 0.06 * r, 0.0, reach + 0.07 + 0.5 * r, 10))
            out.add("gland", hexagon(0.03 + 0.3 * r, 0.8 * reach, reach + 0.02))
            self.wheel.build(side.spun("x", np.pi / 2), 0.03 + 0.8 * r, reach + 0.05 + 0.4 * r)
        return lying(t, "air valve")


class _Pallet(Params):
    """A pallet chamber's end: a weather hood, or a bolted lid with a grip."""

    hooded: bool = chance(0.5, "a weather hood rather than a bolted lid")

    def build(self, t: Table, w: float, n: int) -> None:
        """Puts it down on z = 0, for a chamber scaled by ``w`` [m]."""
        if self.hooded:
            hood = outline(1.35 * w, -0.35 * w, 1.35 * w, 0.15 * w, 0.5 * w, 0.45 * w)
            t.add("valve bonnet", turned(hood, n))
            return
        grip = along("y", rod((0, 0, -0.3 * w), (0, 0, 0.3 * w), 0.06 * w, 6), 0, 0, 0.14 * w)
        t.add("valve bonnet", cylinder(1.1 * w, -0.001, 0.08 * w, n), grip)
        t.add("bolt", around(cylinder(0.004, -0.01, 0.08 * w + 0.008, 6), 6, 1.0 * w))


class Breather(Valve, name="breather valve/pallet", place="head", sizes=sizes_between(50)):
    """A pressure and vacuum vent on a tank's nozzle (API 2000): two pallet chambers under hoods on a flanged chest."""

    boxy: bool = chance(0.5, "the chest is a box, not a barrel")
    tall: float = between(0.7, 1.6, "height of the pressure chamber / radius of the chambers")
    ends: tuple[_Pallet, ...] = several(made(_Pallet), 2, "ends of the chambers")

    def build(self, t: Table) -> Model:
        r, w = t.pipe.radius, 1.5 * t.pipe.radius + 0.02
        n, low, span = t.n(1.5 * r), plate_thickness(t.dn) + 0.02 + 0.3 * r, 1.35 * w
        if self.boxy:
            chest = box((2 * span + 2.0 * w, 2.0 * w, 1.3 * w), (0, 0, low + 0.65 * w))
        else:
            half = ((0.5 * w, -span - 0.7 * w), (0.8 * w, -span - 0.4 * w))
            barrel = turned([*half, *((a, -x) for a, x in half[::-1])], n)
            chest = along("x", barrel, 0, 0, low + 0.65 * w)
        t.add("valve body", disc_flange(t.dn, t.style, low + 0.3 * r), chest)
        for side, tall, end in zip(BOTH, (0.7 * w, self.tall * w), self.ends, strict=True):
            up = t.at(side * span, 0, low + 1.2 * w)
            up.add("valve body", cylinder(0.85 * w, -0.5 * w, tall, n))
            end.build(up.at(0, 0, tall), w, n)
        face = 1.0 * w if self.boxy else 0.75 * w
        screen = t.at(span, 0, low + 0.65 * w).along("y")
        screen.add("valve body", ring(0.5 * w, 0.62 * w, 0.7 * face, face + 0.2 * w, n))
        return lying(t, "breather valve")


class FlameArrester(Valve, name="breather valve/flame arrester", place="head", sizes=sizes_between(50)):
    """An end-of-line vent with a flame arrester (EN ISO 16852): a wide housing of rings, stay bolts, a weather hood."""

    wide: float = between(1.6, 2.2, "radius of the housing / of the pipe")
    bank: float = between(0.02, 0.04, "height of a ring of the arrester", "m")
    banks: int = whole(1, 3, "rings of the arrester")
    stays: int = among((4, 6, 8), "stay bolts")
    tall: float = between(0.5, 1.2, "from the housing to the hood / radius of the housing")
    deep: bool = chance(0.5, "a deep hood rather than a flat one")

    def build(self, t: Table) -> Model:
        r, thick, w = t.pipe.radius, plate_thickness(t.dn), self.wide * t.pipe.radius + 0.02
        n, low = t.n(1.8 * r), thick + 0.02 + 0.9 * r
        cone = outline(hub_radius(t.dn), thick + 0.01, w, low, 1.15 * w, low, 1.15 * w, low + 0.014)
        t.add("valve body", disc_flange(t.dn, t.style, thick + 0.015), turned(cone, n))
        up = t.at(0, 0, low + 0.014)
        for k in range(self.banks):
            up.add("valve body", cylinder(1.02 * w, k * self.bank, (k + 1) * self.bank, n))
        high, stay, tall = self.banks * self.bank, 0.005 + 0.02 * w, self.tall * w
        end = up.at(0, 0, high)
        end.add("valve body", cylinder(1.15 * w, 0, 0.014, n))
        bolt = [cylinder(stay, -high - 0.026, 0.014 + tall, 8), hexagon(3.4 * stay, 0.014, 0.014 + 1.6 * stay)]
        end.add("stud", around(merge(bolt), self.stays, 1.09 * w), fine=False, own=True)
        marks = ((1.4 * w, -0.4 * tall), (1.4 * w, -0.001), (0.6 * w, 0.35 * w), (0.1 * w, 0.45 * w))
        hood = marks if self.deep else outline(1.3 * w, -0.002, 1.3 * w, 0.006, 0.2 * w, 0.3 * w)
        end.at(0, 0, 0.014 + tall).add("valve bonnet", turned(hood, n))
        spindle = cylinder(0.05 * w + 0.003, 0.02, 0.014 + tall, 8)
        end.add("valve disc", cylinder(0.8 * w, 0.0135, 0.026, n), spindle)
        return lying(t, "breather valve")


class Hatch(Valve, name="breather valve/hatch", place="head", sizes=sizes_between(80), weight=0.7):
    """An emergency relief hatch on a tank's nozzle (API 2000): a wide seat, a lid on a hinge, a bale handle."""

    wide: float = between(1.15, 1.6, "radius of the seat / of the pipe")
    lift: float = among((0.0, 0.0, 0.0, 0.5, 1.2), "how far the lid is open", "rad")
    domed: bool = chance(0.6, "a dome on the lid")

    def build(self, t: Table) -> Model:
        r, thick, w = t.pipe.radius, plate_thickness(t.dn), self.wide * t.pipe.radius + 0.01
        n, low, plate = t.n(1.3 * r), thick + 0.02 + 0.4 * r, 0.01 + 0.05 * r
        neck = outline(1.03 * r, thick + 0.005, 1.03 * r, low - 0.01, w, low, w, low + 0.012)
        seat = low + 0.012
        ears = [
            box((0.3 * w, 0.1 * w, 1.6 * plate + 0.012), (-1.1 * w, s * 0.22 * w, seat - 0.2 * plate)) for s in BOTH
        ]
        t.add("valve body", disc_flange(t.dn, t.style, thick + 0.01), turned(neck, n), *ears)
        hinge = t.at(-1.12 * w, 0.0, seat + 0.5 * plate)
        leaf = hinge.spun("y", -self.lift).at(1.12 * w, 0.0, -0.5 * plate)
        lid = [cylinder(1.02 * w, 0, plate, n)]
        lid += [turned(outline(0.8 * w, 0.9 * plate, 0.5 * w, 0.35 * w), n)] if self.domed else []
        leaf.add("valve disc", *lid, box((0.4 * w, 0.3 * w, 0.6 * plate), (-0.98 * w, 0, 0.8 * plate)), of="valve")
        hinge.along("y").add("valve stem", cylinder(0.3 * plate, -0.35 * w, 0.35 * w, 8))
        ways = ((-0.3 * w, 0.5 * plate), (-0.3 * w, 0.6 * w), (0.3 * w, 0.6 * w), (0.3 * w, 0.5 * plate))
        leaf.add("lever", rope(bend([(0.3 * w, y, z) for y, z in ways], 0.12 * w), 0.005 + 0.03 * w, 8))
        return lying(t, "breather valve")


class PlasticAir(Valve, name="air valve/plastic", place="tap"):
    """A plastic combination air valve on an outlet: hexagon base, ribbed barrel, screwed dome, drain elbow."""

    barrel: float = between(0.025, 0.05, "radius of the barrel", "m")
    tall: float = between(1.5, 3.0, "height of the barrel / its radius")
    ribbed: bool = chance(0.6, "ribs along the barrel")
    rise: float = between(0.5, 1.4, "height of the dome / radius of the barrel")

    def build(self, t: Table) -> Model:
        r, n, tall, rise = self.barrel, t.n(self.barrel), self.tall * self.barrel, self.rise * self.barrel
        top = 0.04 + tall
        barrel = turned(outline(0.6 * r, 0.032, 1.0 * r, 0.04, 1.0 * r, top), n)
        ribs = [around(box((0.1 * r, 0.12 * r, 0.9 * tall), (0, 0, 0.04 + 0.5 * tall)), 8, r)] if self.ribbed else []
        t.add("valve body", cylinder(0.009, 0.0, 0.02, n), hexagon(0.034, 0.014, 0.034), barrel, *ribs)
        crown = outline(1.12 * r, -0.008, 1.12 * r, 0.006, 0.9 * r, 0.008, 0.8 * r, rise, 0.4 * r, 1.2 * rise)
        out = merge([cylinder(0.3 * r, 0.5 * r, 1.4 * r, n), ring(0.2 * r, 0.34 * r, 1.3 * r, 1.7 * r, n)])
        t.at(0, 0, top).add("valve bonnet", turned(crown, n), along("y", out, 0, 0, 0.6 * rise))
        return t.model(kind="air valve")


class VacuumBreaker(Valve, name="vacuum breaker/cowl", place="tap"):
    """A vacuum breaker on an outlet: hexagon body, slotted cowl or mushroom cap with a disc beneath."""

    thread: float = between(0.010, 0.018, "radius of its thread", "m")
    gap: float = between(0.4, 1.0, "height of the slot under the cap / radius of the thread")
    posts: int = among((3, 4, 6), "posts that hold the cap")

    def build(self, t: Table) -> Model:
        r, low, gap = self.thread, 0.018 + 1.4 * self.thread, self.gap * self.thread
        n, up = t.n(2 * r), t.at(0, 0, 0.018 + 2.8 * self.thread)
        cup = turned(outline(1.1 * r, low - 0.001, 1.9 * r, low + 1.0 * r, 1.9 * r, low + 1.4 * r), n)
        t.add("valve body", cylinder(0.9 * r, 0.0, 0.024, n), hexagon(2.8 * r, 0.016, low), cup)
        posts = around(box((0.3 * r, 0.3 * r, gap + 0.002), (0, 0, gap / 2)), self.posts, 1.6 * r)
        cap = outline(2.0 * r, gap, 2.1 * r, gap + 0.2 * r, 1.5 * r, gap + 1.0 * r, 0.4 * r, gap + 1.2 * r)
        up.add("valve bonnet", posts, turned(cap, n))
        up.add("valve disc", cylinder(1.2 * r, -0.001, 0.3 * r, n))
        return t.model(kind="vacuum breaker")


VENTS = families_of(
    Backflow, ThreadedBackflow, AirBowl, DoubleOrifice, PlasticAir, VacuumBreaker, Breather, FlameArrester, Hatch
)
