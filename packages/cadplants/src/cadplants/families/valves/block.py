"""Valves with operators or bodies of their own: blocks, fusible and quick levers, landing and tank valves."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    lying,
)
from cadplants.families.valves.drive import Wheel, drive_of, put_spindle
from cadplants.families.valves.parts import SMALL, bend, cover, hub_radius, threaded_run
from cadplants.families.valves.valve import Valve, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import FACE_TO_FACE, PIPES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at

__all__ = ["BLOCKS"]

_LONG = "length / radius of the pipe"


def _short(dn: int) -> float:
    """What the small operators of a block are scaled by [m]."""
    return 0.7 * PIPES[dn].radius


def _bleeder(dn: int) -> float:
    """The size of a bleed needle [m]."""
    return 0.009 + 0.03 * PIPES[dn].radius


def _swollen(t: Table, length: float, wide: float) -> Solid:
    """A flanged body along x that widens to its middle."""
    neck, end = hub_radius(t.dn), plate_thickness(t.dn) + 0.05 * length
    middle = outline(neck, end, wide, 0.4 * length, wide, 0.6 * length, neck, length - end)
    return flanged_body(t.dn, t.style, length, middle)


class BlockBleed(Valve, name="ball valve/double block and bleed", sizes=sizes_between(15, 80)):
    """A double block and bleed valve in one flanged body (API 6D short): two levers, a bleed needle between."""

    long: float = between(5.5, 7.5, _LONG)
    square: bool = chance(0.5, "its middle is square")
    first: Any = drive_of("lever", "lever", "bar", radius=lambda p: _short(p.dn))
    second: Any = drive_of("lever", "lever", "bar", radius=lambda p: _short(p.dn))
    turn: float = among((-np.pi / 2, np.pi / 2, 0.0), "of the bleed needle about the pipe", "rad")
    bleed: Any = drive_of("bar", radius=lambda p: _bleeder(p.dn))

    def build(self, t: Table) -> Model:
        r, thick, neck, b = t.pipe.radius, plate_thickness(t.dn), hub_radius(t.dn), _bleeder(t.dn)
        length, w = round(self.long * r + 2 * thick + 0.08, 6), max(1.5 * r + 0.012, 1.02 * neck)
        low = thick + 0.018 + 0.1 * r
        high = length - thick - 0.018 - 0.1 * r
        solids = [flanged_body(t.dn, t.style, length, outline(neck, low, w, low, w, high, neck, high))]
        if self.square:
            block = extrude(rounded_rectangle(2.1 * w, 2.1 * w, 0.3 * w, 3), low + 0.002, high - 0.002)
            solids.append(along("x", block))
        t.add("valve body", *solids)
        face = 1.05 * w if self.square else w
        boss, top, span = 0.5 * r + 0.006, face + 0.012 + 0.15 * r, high - low
        for x, lever in ((low + 0.22 * span, self.first), (high - 0.22 * span, self.second)):
            up = t.at(x)
            up.add("valve body", cylinder(boss, 0.8 * face, top, 12))
            put_spindle(up, top - 0.001, top + 0.012, 0.5 * boss)
            lever.build(up.at(0, 0, top + 0.01))
        out = t.at(length / 2).spun("x", self.turn)
        out.add("valve body", hexagon(2.6 * b, 0.8 * w, face + 2.0 * b))
        out = out.at(0, 0, face)
        out.add("valve bonnet", hexagon(2.0 * b, 1.95 * b, 3.2 * b), cylinder(0.8 * b, 3.1 * b, 4.6 * b, 10))
        out.add("gland", hexagon(1.4 * b, 4.5 * b, 5.2 * b))
        out.add("valve stem", cylinder(0.35 * b, 5.1 * b, 7.2 * b, 8))
        self.bleed.build(out.at(0, 0, 6.8 * b))
        return t.model(length, kind="ball valve")


class FlangedBalancing(Valve, name="globe valve/balancing flanged", sizes=sizes_between(25, 200)):
    """A flanged balancing valve (EN 558 series 1): slanting or upright bonnet, digit wheel, test points."""

    tilt: float = among((0.0, 0.6, 0.75), "of the bonnet, downstream", "rad")
    bolts: int = among((4, 6, 8), "of the cover")
    ribs: int = among((6, 12), "of the digit wheel")
    lean: float = among((0.4, 0.9, np.pi / 2), "of the test points aside", "rad")

    def build(self, t: Table) -> Model:
        length, r, neck = FACE_TO_FACE["globe"][t.dn], t.pipe.radius, hub_radius(t.dn)
        w, tilt = max(1.25 * r + 0.006, 1.04 * neck), self.tilt
        n, rim, plate = t.n(w), 1.1 * w + 0.008, 0.010 + 0.08 * r
        # The slanting cover passes the flange.
        clear = float((0.5 * t.flange.outer + 0.012 + rim * np.sin(tilt)) / np.cos(tilt))
        seat = max(1.3 * w, clear + 0.01 + 0.08 * r)
        t.add("valve body", _swollen(t, length, w))
        head = t.at((0.5 if tilt == 0 else 0.44) * length).spun("y", tilt)
        head.add("valve body", cylinder(0.85 * w, 0.2 * w, seat - 0.003, n))
        head.extend(cover(rim, seat, plate, self.bolts, t.style))
        tall, g = 0.04 + 0.5 * r, 0.03 + 0.45 * r
        head.at(0, 0, seat + plate).add("valve bonnet", turned(outline(0.6 * w, -0.001, 0.4 * w, tall), n))
        top = seat + plate + tall
        knob = outline(0.8 * g, top - 0.002, g, top + 0.1 * g, g, top + 0.8 * g, 0.7 * g, top + g)
        rib = box((0.12 * g, 0.16 * g, 0.6 * g), (0, 0, top + 0.45 * g))
        head.add("handwheel", turned(knob, t.n(g, 10)), around(rib, self.ribs, g), turns=Turning("handwheel"))
        head.add("position indicator", box((0.5 * g, 0.3 * g, 0.05 * g), (0, 0.3 * g, top + 1.0 * g)), of="dial")
        for x in (plate_thickness(t.dn) + 0.07 * length, length - plate_thickness(t.dn) - 0.07 * length):
            test = t.at(x).spun("x", -self.lean)
            test.add(
                "valve body", hexagon(0.018, 0.9 * neck, neck + 0.016), cylinder(0.007, neck + 0.01, neck + 0.03, 10)
            )
            test.add("valve bonnet", cylinder(0.010, neck + 0.028, neck + 0.055, 10))
        return t.model(length, kind="globe valve")


class Fusible(Valve, name="shut-off valve/fusible link", sizes=SMALL):
    """A fire-safe emergency valve (UL 842): spring in its bonnet, a lever held open by a fusible link to a bracket."""

    long: float = between(4.8, 6.2, _LONG)
    tall: float = between(1.2, 2.2, "height of the bonnet / radius of the body")
    lever: float = between(3.2, 5.0, "length of the lever / radius of the body")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.035
        w, n, x = 1.45 * r + 0.004, t.n(1.45 * r), length / 2
        marks = ((1.05 * r, 0.12), (w, 0.36), (w, 0.64), (1.05 * r, 0.88))
        run = threaded_run(t, length, *marks)
        t.add("valve body", run, moved(cylinder(0.85 * w, 0.0, 1.4 * w, n), at(x)))
        low, long, up = 1.4 * w, self.lever * w, t.at(x)
        top = low + self.tall * w
        hood = turned(outline(0.7 * w, low + 0.4 * w, 0.65 * w, top, 0.35 * w, top + 0.2 * w), n)
        up.add("valve bonnet", hexagon(2.0 * w, low - 0.002, low + 0.5 * w), hood)
        top += 0.2 * w
        z, post = top + 0.9 * w, x - 1.2 * w
        up.add("valve stem", cylinder(0.14 * w + 0.001, top - 0.002, z, 8))
        size = (0.35 * w, 0.12 * w, z - low + 0.2 * w)
        arms = [box(size, (post, s * 0.25 * w, (z + low) / 2)) for s in BOTH]
        fork = box((1.2 * w, 0.62 * w, 0.2 * w), (x - 0.75 * w, 0, low + 0.1 * w))
        t.add("yoke", *arms, fork, of="trim")
        t.at(post, 0, z).along("y").add("valve stem", cylinder(0.09 * w, -0.34 * w, 0.34 * w, 8))
        t.at(post, 0, z).add("lever", box((long, 0.3 * w, 0.22 * w), (long / 2 - 0.2 * w, 0, 0)))
        tip, base, wire = post + long - 0.5 * w, 1.1 * r, 0.06 * w + 0.0008
        foot, lower, upper = min(tip, 0.88 * length), base + 0.3 * (z - base), base + 0.62 * (z - base)
        t.add(
            "lever",
            rod((foot, 0, base - 0.003), (tip, 0, lower + 0.002), wire, 6),
            rod((tip, 0, upper - 0.002), (tip, 0, z), wire, 6),
            of="trim",
            own=True,
        )
        tall, middle = upper - lower, t.at(tip, 0, (lower + upper) / 2)
        plates = ((0.5 * w, 0.05 * w + 0.001, tall), (0.4 * w, 0.09 * w + 0.001, 0.5 * tall))
        middle.add("lever", *map(box, plates), of="dial", own=True)
        return t.model(round(length, 6), "welded", "shut-off valve")


class QuickOpening(Valve, name="gate valve/quick opening", sizes=sizes_between(15, 100)):
    """A quick-opening gate or blow-off valve: sliding stem through a bonnet, a hand lever on links about a fulcrum."""

    flat: bool = among((False, True), "a flat chest under a square cover")
    lift: float = between(0.8, 1.8, "how far the stem stands out / radius of the pipe")
    side: int = among(BOTH, "side of the lever along the pipe")
    long: float = between(4.0, 6.5, "length of the lever / radius of the body")
    tilt: float = between(0.0, 0.05, "of the lever, upwards", "rad")

    def build(self, t: Table) -> Model:
        length, r = FACE_TO_FACE["gate"][t.dn], t.pipe.radius
        w, x, side = max(1.2 * r + 0.006, 1.03 * hub_radius(t.dn)), length / 2, self.side
        n, seat, plate = t.n(w), max(2.0 * r + 0.02, 0.5 * t.flange.outer + 0.012), 0.009 + 0.08 * r
        chest = cylinder(0.95 * w, 0.0, seat - 0.003, n)
        if self.flat:
            chest = extrude(rounded_rectangle(1.3 * w, 2.1 * w, 0.3 * w, 3), 0.0, seat - 0.003)
        t.add("valve body", _swollen(t, length, w), moved(chest, at(x)))
        t.at(x).extend(cover(1.2 * w + 0.006, seat, plate, 8, t.style, self.flat, 0.3 * r))
        top = seat + plate + 0.3 * r
        up, high = t.at(x, 0, top), top + 1.3 * r + 0.01 + self.lift * r + 0.02
        up.add("valve bonnet", turned(outline(0.45 * w, -0.3 * r, 0.4 * w, 0.9 * r), n))
        bridge = box((0.5 * w, 1.5 * w, 0.010 + 0.05 * r), (0, 0, 0.9 * r + 0.004))
        up.add("gland", bridge, cylinder(0.3 * w, 0.85 * r, 1.3 * r + 0.01, 12))
        up.add("valve stem", cylinder(0.004 + 0.09 * r, 0, high - top, 10))
        far, bar = x - side * (1.1 * w + 0.01), 0.004 + 0.05 * r
        size = (2.2 * bar + 0.25 * w, 1.2 * bar, high - seat)
        stand = [box(size, (far, s * 2.2 * bar, (high + seat) / 2)) for s in BOTH]
        t.add("yoke", *stand, box((0.5 * w, 7 * bar, 0.008 + 0.03 * r), (far, 0, seat + plate / 2)))
        pins = [along("y", cylinder(0.7 * bar, -3 * bar, 3 * bar, 8), a, 0, high - bar) for a in (far, x)]
        t.add("valve stem", *pins, box((3 * bar, 3.4 * bar, 5 * bar), (x, 0, high - 1.5 * bar)))
        long = self.long * w + 0.1
        grip = along("x", cylinder(1.6 * bar, long - 0.25 * long, long, 10))
        lever = t.at(far, 0, high - bar).spun("z", 0.0 if side > 0 else np.pi).spun("y", -self.tilt)
        shank = box((long, 1.6 * bar, 3.0 * bar), (long / 2 - 3 * bar, 0, 0))
        lever.add("lever", shank, grip, turns=Turning("lever", (0.0, -1.0, 0.0)))
        return t.model(length, kind="gate valve")


class Landing(Valve, name="globe valve/fire landing", place="head", sizes=(50, 65, 80)):
    """A fire landing valve (BS 5041-1): flanged inlet, oblique globe, instantaneous outlet, cap, wheel."""

    lean: float = among((0.6, 0.785, np.pi / 2), "of the outlet", "rad")
    size: float = between(1.4, 2.0, "radius of the wheel / of the globe")
    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        r, w = t.pipe.radius, 1.45 * t.pipe.radius + 0.006
        n, axis, top = t.n(1.5 * r), plate_thickness(t.dn) + 0.02 + 1.5 * w, 1.5 * w
        globe = moved(ball(1.08 * w, n), at(0, 0, axis))
        t.add("valve body", disc_flange(t.dn, t.style, axis - 0.4 * w), globe)
        up = t.at(0, 0, axis).spun("x", self.lean - 0.785 if self.lean > 1 else -0.15)
        up.add("valve body", turned(outline(0.85 * w, 0.3 * w, 0.85 * w, top), n))
        up = up.at(0, 0, top)
        hood = outline(1.05 * w, -0.15 * w, 1.05 * w, 0.2 * w, 0.55 * w, 0.4 * w, 0.45 * w, 1.3 * w)
        up.add("valve bonnet", turned(hood, n))
        up.add("gland", hexagon(0.8 * w, 1.25 * w, 1.6 * w))
        put_spindle(up, 1.55 * w, 2.8 * w, 0.15 * w)
        self.wheel.build(up, self.size * w + 0.01, 2.2 * w)
        mouth = t.at(0, 0, axis).spun("x", -self.lean - 0.5)
        marks = ((0.9, 0.5), (0.9, 1.9), (1.35, 2.0), (1.35, 2.9), (1.15, 3.0))
        lug = cylinder(0.18 * r, 1.3 * r, 1.7 * r, 8)
        lugs = [along(way, lug, 0, 0, 2.5 * w) for way in ("-x", "x")]
        mouth.add("valve body", turned([(a * r, z * w) for a, z in marks], n), *lugs)
        grip = box((2.2 * r, 0.3 * r, 0.3 * w), (0, 0, 3.5 * w))
        mouth.add("pipe cap", cylinder(1.2 * r, 2.99 * w, 3.4 * w, n), grip, of="rubber", own=True)
        return lying(t, "globe valve")


class TankBottom(Valve, name="tank valve/flush bottom", place="head", sizes=sizes_between(25, 200)):
    """A flush tank-bottom valve (DIN 28137 type): pad flange, disc in its mouth, slanting outlet, stem."""

    angle: float = among((0.785, 1.047), "of the outlet from the tank's axis", "rad")
    square: bool = among((False, True), "its cover is square")
    by_hand: bool = chance(0.7, "a wheel on a yoke rather than a cylinder")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.by_hand)

    def build(self, t: Table) -> Model:
        r, thick, outer = t.pipe.radius, plate_thickness(t.dn), t.flange.outer
        n, w = t.n(1.4 * r), 1.35 * r + 0.006
        axis, reach = thick + 0.3 * outer + w, 0.62 * outer + 0.5 * w + thick
        t.add("valve body", disc_flange(t.dn, t.style, axis), moved(ball(1.12 * w, n), at(0, 0, axis)))
        mid = t.at(0, 0, axis)
        mid.spun("x", np.pi - self.angle).at(0, 0, -reach).add("valve body", disc_flange(t.dn, t.style, reach))
        t.add("valve disc", turned(outline(0.8 * r, -0.0008, 0.95 * r, 0.006, 0.95 * r, 0.3 * r, 0.3 * r, 0.6 * r), n))
        seat, plate, head = 1.6 * w, 0.010 + 0.08 * r, mid.spun("x", 0.55)  # away from the outlet
        head.add("valve body", cylinder(0.8 * w, 0.4 * w, seat - 0.003, n))
        head.extend(cover(1.15 * w + 0.006, seat, plate, 4, t.style, self.square))
        head, tall, slim = head.at(0, 0, seat + plate), 0.06 + 1.4 * r, 0.005 + 0.1 * r
        if self.by_hand:
            arms = [box((0.02 + 0.1 * r, 0.008 + 0.06 * r, tall), (0, s * 0.6 * w, tall / 2)) for s in BOTH]
            head.add("yoke", *arms, box((0.03 + 0.15 * r, 1.4 * w, 0.012), (0, 0, tall)))
            head.add("gland", cylinder(0.4 * w, -0.001, 0.35 * tall, 12))
            put_spindle(head, 0, tall + 0.05 + 0.5 * r, slim)
            self.wheel.build(head, 0.04 + 1.1 * r, tall + 0.02)
        else:
            can = 1.3 * w + 0.01
            head.add("yoke", ring(0.5 * w, 0.7 * w, -0.001, 0.4 * tall, n))
            marks = ((1, 0.4), (1, 0.5), (0.9, 0.5), (0.9, 1.6), (1, 1.6), (1, 1.7))
            shape = turned([(a * can, z * tall) for a, z in marks], t.n(can))
            head.bundled("actuator").add("actuator", shape, of="trim", own=True)
            head.add("valve stem", cylinder(0.1 * w + 0.003, 0, 0.42 * tall, 8))
        return lying(t, "tank valve")


class WaferSampler(Valve, name="sampling valve/wafer", sizes=sizes_between(25, 200)):
    """A sampling valve between flanges (wafer): a thick ring, its neck with a needle head and a bent spout."""

    size: float = between(0.008, 0.011, "radius of the needle's body", "m")
    wheeled: bool = chance(0.6, "a wheel rather than a bar or lever")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.wheeled)
    drive: Any = drive_of("bar", "lever", radius=lambda p: p.size, when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        size, r, length = t.flange, self.size, round(0.03 + 0.15 * t.pipe.radius, 6)
        outer, n, top = 0.5 * (size.circle - size.bolt) - 0.0005, t.n(size.outer / 2), 0.5 * size.outer + 0.055
        neck = box((min(2.6 * r, 0.9 * length), 2.6 * r, top - 0.9 * outer), (length / 2, 0, (top + 0.9 * outer) / 2))
        t.add("valve body", along("x", ring(t.pipe.bore, outer, 0.0, length, n)), neck)
        up = t.at(length / 2, 0, top)
        up.add("valve bonnet", hexagon(2.2 * r, -0.001, 1.6 * r), cylinder(0.9 * r, 1.5 * r, 4.0 * r, 12))
        up.add("gland", hexagon(1.6 * r, 3.9 * r, 4.8 * r))
        up.add("valve stem", cylinder(0.35 * r, 4.7 * r, 7.5 * r, 8))
        if self.wheeled:
            self.wheel.build(up, 0.012 + 2.0 * r, 6.4 * r)
        else:
            self.drive.build(up.at(0, 0, 7.0 * r))
        spout = bend([(0, 1.2 * r, -0.01), (0, 6 * r, -0.01), (0, 6 * r, -0.01 - 3.6 * r)], 2.5 * r)
        up.add("valve body", rope(spout, 0.6 * r, 12))
        return t.model(length, "wafer", "sampling valve")


BLOCKS = families_of(BlockBleed, FlangedBalancing, Fusible, QuickOpening, Landing, TankBottom, WaferSampler)
