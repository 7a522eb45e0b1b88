"""Pressure reducing, float, thermostatic, mixing and solenoid valves beyond the plain ones."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    lying,
)
from cadplants.families.valves.parts import MID, SMALL, bend, cover, hub_radius, spring, threaded_run
from cadplants.families.valves.valve import Valve, bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import FACE_TO_FACE, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at

__all__ = ["REGULATORS"]

_REDUCING = "pressure reducing valve"
_LONG = "length / radius of the pipe"
_RIM = "radius of the diaphragm's rim / of the body"


class _Globe(Params):
    """A flanged globe body (EN 558 series 1 lengths)."""

    barrel: bool = chance(0.5, "shaped like a barrel rather than tapered to both ends")

    def solid(self, t: Table, swell: float) -> tuple[Solid, float, float]:
        """The body along x, its length and the radius of its middle, for a middle of so many pipe radii [m]."""
        length, neck, thick = FACE_TO_FACE["globe"][t.dn], hub_radius(t.dn), plate_thickness(t.dn)
        w, end = max(swell * t.pipe.radius + 0.006, 1.05 * neck), thick + 0.06 * length
        middle = outline(neck, end, w, 0.38 * length, w, 0.62 * length, neck, length - end)
        if self.barrel:
            reach = length / 2 - thick - 0.08 * length
            shares = [(float(s), float(np.sqrt(max(0.0, 1 - s * s)))) for s in np.linspace(-1, 1, 9)]
            middle = [(neck + (w - neck) * bulge, length / 2 + s * reach) for s, bulge in shares]
        return flanged_body(t.dn, t.style, length, middle), length, w


class FilterBowl(Valve, name="pressure reducing valve/filter bowl", sizes=SMALL):
    """A domestic pressure reducer (EN 1567): threaded body, tapered spring hood, knob, clear bowl below."""

    long: float = between(4.6, 6.5, _LONG)
    tall: float = between(1.6, 3.2, "height of the hood / radius of the body")
    top: str = among(("knob", "screw", "bare"), "what the hood carries")
    deep: float = between(0.6, 2.4, "depth of the bowl / radius of the body")

    def build(self, t: Table) -> Model:
        r, length, w = t.pipe.radius, self.long * t.pipe.radius + 0.04, 1.45 * t.pipe.radius + 0.006
        n, low, tall, deep = t.n(1.6 * r), 1.25 * w, self.tall * w, self.deep * w
        run = threaded_run(t, length, (1.1 * r, 0.15), (w, 0.32), (w, 0.68), (1.1 * r, 0.85))
        t.add("valve body", run, moved(cylinder(1.05 * w, -low, low, n), at(length / 2)))
        mid = t.at(length / 2)
        up, end = mid.at(0, 0, low), mid.at(0, 0, low + tall)
        hood = outline(1.15 * w, -0.25 * w, 1.15 * w, 0.3 * w, 0.85 * w, 0.45 * w, 0.6 * w, tall)
        up.add("valve bonnet", turned(hood, n))
        if self.top == "knob":
            knob = outline(0.8 * w, -0.002, 0.9 * w, 0.1 * w, 0.9 * w, 0.6 * w, 0.7 * w, 0.75 * w)
            end.add("handwheel", turned(knob, max(8, n)))
        elif self.top == "screw":
            end.add("valve stem", cylinder(0.12 * w, -0.002, 0.7 * w, 8), hexagon(0.4 * w, 0, 0.2 * w))
        marks = (
            (1.2 * w, 0.0),
            (1.2 * w, 0.45 * w),
            (w, 0.5 * w),
            (0.9 * w, 0.5 * w + deep),
            (0.5 * w, 0.8 * w + deep),
        )
        mid.at(0, 0, -w).along("-z").add("strainer", turned(marks, n), of="dial", own=True)
        mid.along("y").add("valve body", cylinder(0.4 * w, 0.6 * w, 1.3 * w, 12), hexagon(0.6 * w, 1.2 * w, 1.5 * w))
        return t.model(round(length, 6), "welded", _REDUCING)


class DomeLoaded(Valve, name="pressure reducing valve/dome loaded", sizes=MID):
    """A dome-loaded regulator: thick discs bolted above a flanged globe, loading tube."""

    globe: _Globe = nested(_Globe, "body")
    rim: float = between(1.5, 2.2, "radius of the discs / of the body")
    bolts: int = among((8, 10, 12), "of the discs")
    capped: bool = chance(0.5, "a cap below the body")

    def build(self, t: Table) -> Model:
        shell, length, w = self.globe.solid(t, 1.3)
        x, rim, low = length / 2, self.rim * w + 0.015, max(1.15 * w, 0.5 * t.flange.outer + 0.008)
        n, thick, mid = t.n(rim), 0.014 + 0.22 * t.pipe.radius, t.at(x)
        neck = [cylinder(0.8 * w, 0.3 * w, low + 0.002, n), cylinder(rim, low, low + thick, n)]
        t.add("valve body", shell, *(moved(s, at(x)) for s in neck))
        up, high = mid.at(0, 0, low), 2 * thick
        dome = outline(rim, thick, rim, high, 0.85 * rim, high, 0.75 * rim, 1.1 * high + 0.2 * rim)
        up.add("valve bonnet", turned([*dome, (0.3 * rim, 1.15 * high + 0.3 * rim)], n))
        up.add("bolt", bolt_circle(self.bolts, 0.92 * rim, max(0.007, 0.06 * rim), 0, high))
        top, far = low + 2.25 * thick + 0.28 * rim, rim + 0.03
        mid.at(0, 0, top).add("gland", hexagon(0.02, -0.008, 0.014), cylinder(0.007, 0.012, 0.03, 8))
        line = [(0, 0, top + 0.028), (0, 0, top + 0.05), (0, -far, top + 0.05), (0, -far, 0.0), (0, -0.6 * w, 0.0)]
        mid.add("pipe", rope(bend(line, 0.02), 0.005, 8), own=True)
        if self.capped:
            cap = turned(outline(0.9 * w, 0.0, 0.9 * w, 1.3 * w, 0.4 * w, 1.5 * w), n)
            mid.along("-z").add("valve bonnet", cap)
        return t.model(length, kind=_REDUCING)


class GasRegulator(Valve, name="pressure reducing valve/gas", sizes=sizes_between(15, 100), weight=1.3):
    """A gas regulator (EN 334): flat wide diaphragm housing, upright or aside, tower, vent, slam-shut."""

    flanged: bool = chance(0.4, "flanged rather than screwed", when=lambda p: p.dn <= 50, otherwise=True)
    globe: _Globe = nested(_Globe, "flanged body", when=lambda p: p.flanged)
    rim: float = between(1.8, 2.9, _RIM)
    aside: bool = chance(0.35, "the diaphragm stands aside, not above")
    tower: float = between(0.6, 1.6, "height of the spring's tower / radius of the diaphragm's rim")
    bolts: int = among((8, 12, 16), "of the diaphragm's housing")
    shut: bool = chance(0.5, "a slam-shut device")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        if self.flanged:
            shell, length, w = self.globe.solid(t, 1.35)
            low = 0.5 * t.flange.outer + 0.01
        else:
            length, w, low = 4.4 * r + 0.05, 1.45 * r + 0.004, 0.0
            shell = threaded_run(t, length, (1.1 * r, 0.15), (w, 0.35), (w, 0.65), (1.1 * r, 0.85))
        t.add("valve body", shell)
        rim, low = self.rim * w + 0.03, max(1.25 * w, low)
        n, flat, tower, mid = t.n(rim), 0.12 * rim, self.tower * rim, t.at(length / 2)
        head = mid.spun("x", np.pi / 2) if self.aside else mid
        pan = outline(0.5 * rim, low, 0.93 * rim, low + flat, rim, low + flat, rim, low + 1.3 * flat)
        head.add("valve body", cylinder(0.75 * w, 0.3 * w, low + 0.003, n), turned(pan, n))
        up = head.at(0, 0, low)
        marks = ((1, 1.3), (1, 1.6), (0.93, 1.6), (0.6, 2.6), (0.32, 2.7))
        vent = [hexagon(0.022 + 0.05 * rim, 0.25 * rim, 0.68 * rim), cylinder(0.008, 0.6 * rim, 0.75 * rim, 8)]
        cone = turned([*((a * rim, z * flat) for a, z in marks), (0.27 * rim, 2.7 * flat + tower)], n)
        up.add("valve bonnet", cone, *(along("y", s, 0, 0, 2.75 * flat) for s in vent))
        cap = outline(0.3 * rim, 2.6 * flat, 0.3 * rim, 3.4 * flat, 0.24 * rim, 3.6 * flat)
        up.at(0, 0, tower).add("valve bonnet", turned(cap, max(8, n)))
        up.add("bolt", bolt_circle(self.bolts, 0.965 * rim, 0.006, flat, 1.6 * flat))
        if self.shut:
            size, base = 0.45 * rim, 1.3 * w
            foot = ((0.7 * w, 0.3 * w), (0.7 * w, 1.25 * w), (size, base), (size, base + 0.5 * size))
            tip = ((0.5 * size, base + 0.7 * size), (0.4 * size, base + 2.0 * size))
            way = mid.along("y" if self.aside else "-z").bundled("actuator")
            way.add("actuator", turned([*foot, *tip], n), of="valve", own=True)
        return t.model(round(length, 6), "flanged" if self.flanged else "welded", _REDUCING)


class PilotLoop(Valve, name="control valve/pilot loop", sizes=sizes_between(40)):
    """A pilot-operated diaphragm control valve (waterworks type): globe, domed cover, pilot loop aside."""

    globe: _Globe = nested(_Globe, "body")
    bolts: int = among((8, 10, 12), "of its cover")
    shown: bool = chance(0.5, "a rod in a glass shows where the diaphragm is")
    side: int = among(BOTH, "side of the pilot loop")
    tall: float = between(3.0, 5.0, "height of the pilot / size of the pilot")
    cocks: int = whole(0, 2, "cocks where the loop leaves the body")

    def build(self, t: Table) -> Model:
        shell, length, w = self.globe.solid(t, 1.4)
        r, x, side, style = t.pipe.radius, length / 2, self.side, t.style
        seat, rim, plate = max(1.25 * w, 0.52 * t.flange.outer), 1.45 * w + 0.01, 0.008 + 0.08 * r
        neck = outline(0.9 * w, 0.3 * w, rim, seat - plate - 0.15 * w, rim, seat - plate + 0.001)
        t.add("valve body", shell, moved(turned(neck, t.n(rim)), at(x)))
        t.at(x).extend(cover(rim, seat, plate, self.bolts, style, False, 0.45 * w))
        top = seat + plate + 0.45 * w
        if self.shown:
            rodlet = cylinder(0.006 + 0.02 * r, -0.003, 0.06 + 0.3 * r, 8)
            case = ring(0.010 + 0.02 * r, 0.014 + 0.03 * r, -0.001, 0.05 + 0.3 * r, 12)
            t.at(x, 0, top).add("position indicator", rodlet, case, of="dial")
        y, size, z = side * (rim + 0.05 + 0.1 * r), 0.018 + 0.03 * r, 0.9 * seat
        wire, hub, end = 0.006 + 0.01 * r, 0.8 * hub_radius(t.dn), plate_thickness(t.dn) + 0.03
        half = [(end, side * 0.9 * hub, 0.3 * hub), (end, y, 0.3 * hub), (end, y, z)]
        line = [*half, *((length - a, b, c) for a, b, c in half[::-1])]
        t.add("pipe", rope(bend(line, 0.02), wire, 8), own=True)
        far = x - 0.18 * length
        feed = [(far, y, z), (far, y, top - 0.1 * w), (x - 0.1 * w, side * 0.1 * w, top - 0.06 * w)]
        t.add("pipe", rope(bend(feed, 0.012), 0.8 * wire, 8), own=True)
        pilot, tall = t.at(x + 0.3 * (0.36 * length), y, z), self.tall * size
        block = [along("x", hexagon(2 * size, -1.3 * size, 1.3 * size)), cylinder(0.9 * size, 0, 1.5 * size, 12)]
        pilot.add("valve body", *block, rod((0, side * 0.5 * w - y, 0), (0, 0, 0), 0.5 * size, 10))
        marks = ((1.6, 1.4, 0), (1.6, 1.9, 0), (0.9, 2.3, 0), (0.8, 1.9, tall), (0.3, 2.0, tall), (0.3, 2.8, tall))
        pilot.add("valve bonnet", turned([(a * size, b * size + c) for a, b, c in marks], 12))
        for cx in (end, length - end)[: self.cocks]:
            cock, start = t.at(cx, 0, 0.3 * hub).along("y" if side > 0 else "-y"), 0.7 * hub
            cock.add("valve body", hexagon(1.7 * size, start, start + 0.3 * hub + 2.2 * size))
            key = (cx, side * (start + 0.3 * hub + size), 0.3 * hub + 1.8 * size)
            t.add("lever", box((0.012, 0.012, 3.0 * size), key))
        return t.model(length, kind="control valve")


class SelfActing(Valve, name="pressure reducing valve/self-acting", sizes=sizes_between(15, 100)):
    """A self-operated reducing valve: a globe whose springs stand on columns below, over a hanging diaphragm can."""

    globe: _Globe = nested(_Globe, "body")
    tall: float = between(2.2, 3.4, "height of the columns / radius of the body")
    single: bool = chance(0.5, "one spring about the stem rather than two beside it")
    rim: float = between(1.3, 2.3, _RIM)

    def build(self, t: Table) -> Model:
        shell, length, w = self.globe.solid(t, 1.35)
        r, x, n, style = t.pipe.radius, length / 2, t.n(w), t.style
        seat, mid = max(1.2 * w, 0.5 * t.flange.outer + 0.01), t.at(length / 2)
        t.add("valve body", shell)
        mid.add("valve body", cylinder(0.85 * w, 0, seat - 0.002, n))
        mid.extend(cover(1.15 * w + 0.006, seat, 0.01 + 0.06 * r, 4, style))
        tall, rim = self.tall * w + 0.05, self.rim * w + 0.03
        hung = mid.spun("x", np.pi)
        low, spring_top = hung.at(0, 0, seat), 0.75 * tall
        neck = outline(0.7 * w, 0.0, 0.7 * w, seat - 0.01, 0.95 * w, seat - 0.01, 0.95 * w, seat + 0.012)
        hung.add("valve body", turned(neck, n))
        stays = around(cylinder(0.08 * w + 0.004, 0.01, tall + 0.002, 8), 2, 0.75 * w)
        low.add("yoke", stays, of="trim")
        low.add("valve stem", cylinder(0.1 * w, 0, tall + 0.005, 10))
        if self.single:
            coils = [spring(0.45 * w, 0.07 * w, 0.012, spring_top, 6, style)]
        else:
            coils = [moved(spring(0.2 * w, 0.05 * w, 0.012, spring_top, 8, style), at(s * 0.38 * w)) for s in BOTH]
        plate = box((1.9 * w, 0.5 * w, 0.1 * w + 0.004), (0, 0, spring_top + 0.05 * w))
        low.add("valve stem", *coils, plate)
        can, m, z = low.at(0, 0, tall), t.n(rim), seat + tall
        pan = turned([(0.95 * w, 0), *((a * rim, b * rim) for a, b in ((0.9, 0.12), (1, 0.14), (1, 0.2)))], m)
        lid = turned([(a * rim, b * rim) for a, b in ((1, 0.205), (1, 0.26), (0.85, 0.3), (0.4, 0.42))], m)
        middle = cylinder(0.6 * rim, 0.19 * rim, 0.22 * rim, m)
        can.bundled("actuator").add("actuator", pan, lid, middle, of="valve", own=True)
        can.add("bolt", bolt_circle(8, 0.94 * rim, 0.007, 0.13 * rim, 0.27 * rim))
        first = 0.88 * length - plate_thickness(t.dn) * 0.5
        aside, deep = max(x + 1.2 * rim, first + 0.4 * rim), -z - 0.7 * rim
        # Where the can is wider than the body the line passes it outside.
        way = [(first, 0, deep)] if first - x > rim + 0.01 else [(first, 0, -seat), (aside, 0, -seat), (aside, 0, deep)]
        line = [(first, 0.0, -0.9 * hub_radius(t.dn)), *way, (x, 0, deep), (x, 0, -z - 0.4 * rim)]
        t.add("pipe", rope(bend(line, 0.15 * rim), 0.005, 8), own=True)
        return t.model(length, kind=_REDUCING)


class FloatValve(Valve, name="float valve/arm", place="head", sizes=MID):
    """A float valve at the end of a line: angle or balanced body, links, a long arm, a ball or a flat float."""

    long: float = between(5.0, 9.0, "length of the arm / radius of the pipe")
    tilt: float = between(-0.5, 0.3, "of the arm, downwards", "rad")
    is_round: bool = chance(0.5, "the arm is round, not flat")
    shape: str = among(("ball", "seamed ball", "flat"), "shape of the float")

    def build(self, t: Table) -> Model:
        r, thick, w = t.pipe.radius, plate_thickness(t.dn), 1.35 * t.pipe.radius + 0.008
        n, axis, half, size = t.n(1.5 * r), thick + 0.03 + 1.2 * w, 0.004 + 0.05 * r, 0.04 + 0.9 * r
        chest = outline(1.05 * r, thick + 0.01, w, axis - 0.8 * w, w, axis + 0.9 * w, 0.7 * w, axis + 1.1 * w)
        spout = ring(0.7 * w if t.style.hollow else 0, 0.85 * w, 0.75 * w, 1.9 * w, n)
        flange = disc_flange(t.dn, t.style, thick + 0.012)
        t.add("valve body", flange, turned(chest, n), along("y", spout, 0, 0, axis))
        up = t.at(0, 0, axis)
        up.add("valve bonnet", cylinder(1.1 * w, 1.0 * w, 1.15 * w, n))
        fork = [box((0.4 * w, 0.12 * w, 0.7 * w), (0, s * 0.3 * w, axis + 1.14 * w + 0.34 * w)) for s in BOTH]
        pin = along("y", cylinder(0.1 * w, -0.45 * w, 0.45 * w, 8), 0, 0, 1.55 * w)
        t.add("valve body", *fork)
        up.add("valve stem", pin, cylinder(0.12 * w, 1.14 * w - 0.002, 1.55 * w, 8))
        long, arm = 0.12 + self.long * r, up.at(0, 0, 1.55 * w).spun("y", self.tilt)
        flat = box((long + 0.7 * w, 1.1 * half, 3 * half), ((long - 0.7 * w) / 2, 0, 0))
        arm.add("lever", rod((-0.7 * w, 0, 0), (long, 0, 0), half, 8) if self.is_round else flat, of="trim")
        m = t.n(size)
        if self.shape == "flat":
            bob = [turned([(a * size, b * size) for a, b in ((0.85, -0.5), (1, -0.3), (1, 0.3), (0.85, 0.5))], m)]
        elif self.shape == "ball":
            bob = [ball(size, m)]
        else:
            bob = [ball(size, m, 0.8), ring(0.98 * size, 1.05 * size, -0.004, 0.004, m)]
        arm.at(long + 0.9 * size).add("lever", *bob)
        return lying(t, "float valve")


class MixingValve(Valve, name="mixing valve/thermostatic", sizes=SMALL):
    """A thermostatic mixing valve: a threaded tee with unions, a knob or a capped adjuster over the mixed branch."""

    long: float = between(5.5, 7.0, _LONG)
    unions: bool = chance(0.6, "union nuts at both ends")
    drop: float = between(0.06, 0.25, "length of the pipe below", "m")
    knob: bool = chance(0.6, "a knob rather than a capped adjuster")
    ribs: int = among((0, 10, 16), "ribs of the knob", when=lambda p: p.knob, otherwise=0)

    def build(self, t: Table) -> Model:
        r, length, w = t.pipe.radius, self.long * t.pipe.radius + 0.03, 1.5 * t.pipe.radius + 0.003
        n, mid, bore = t.n(1.5 * r), t.at(length / 2), float(t.style.hollow)
        run = threaded_run(t, length, (1.05 * r, 0.12), (1.25 * r, 0.3), (1.25 * r, 0.7), (1.05 * r, 0.88), end=0.15)
        barrel = turned(outline(0.9 * w, -1.2 * w, w, -0.8 * w, w, 1.4 * w), n)
        t.add("valve body", run, moved(barrel, at(length / 2)))
        for f in (0.15, 0.75) if self.unions else ():
            t.at(f * length).along("x").add("union", hexagon(3.2 * r, 0, 0.1 * length), of="valve", own=True)
        down, reach = mid.along("-z"), 0.42 * length + 0.6 * w
        down.add("valve body", ring(0.9 * r * bore, 1.1 * r, 0.8 * w, reach, n))
        down.add("union", hexagon(3.0 * r, 1.2 * w, 1.2 * w + 0.12 * length), of="valve", own=True)
        down.add("pipe", ring(0.85 * r * bore, r, reach, reach + self.drop, n))
        up = mid.at(0, 0, 1.4 * w)
        if self.knob:
            knob = outline(1.1 * w, -0.002, 1.25 * w, 0.2 * w, 1.15 * w, 1.3 * w, 0.8 * w, 1.5 * w)
            rib = box((0.12 * w, 0.12 * w, 0.9 * w), (0, 0, 0.75 * w))
            ribs = [around(rib, self.ribs, 1.2 * w)] if self.ribs else []
            up.add("handwheel", turned(knob, max(8, n)), *ribs, of="rubber", turns=Turning("handwheel"))
        else:
            cap = turned(outline(0.7 * w, 0.4 * w, 0.6 * w, 1.4 * w), n)
            up.add("valve bonnet", hexagon(1.9 * w, -0.002, 0.5 * w), cap)
        return t.model(round(length, 6), "welded", "mixing valve")


REGULATORS = families_of(FilterBowl, DomeLoaded, GasRegulator, PilotLoop, SelfActing, FloatValve, MixingValve)
