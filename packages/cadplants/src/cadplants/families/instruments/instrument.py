"""Gauges and other instruments on an outlet (upright on z = 0) or in a line (along x from 0)."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, STEM, upright
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.flow import NAME, FlowMeter
from cadplants.families.instruments.pieces import BEFORE, FRONT, Gauge, put
from cadplants.families.instruments.sight import SIGHT_GLASS, SightGlass
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import SIZES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved, tube
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import arc, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["INSTRUMENTS"]

_SIZES = (0.04, 0.05, 0.063, 0.08, 0.1, 0.16, 0.25)  # m, EN 837-1 nominal sizes of cases
_SIZE, _DIAL, _HEAD, _WELL = "diameter of its case", "case with its dial", "transmitter", "thermowell"
_SOME = sizes_between(most=150)


class _Dial(Params):
    """A case with bezel, face, needle and maybe glass."""

    deep: float = between(0.35, 0.6, "depth of the case / diameter")
    lip: float = between(1.0, 1.1, "radius of the bezel / of the case")
    reading: float = between(0, 6.3, "where the needle points", "rad")
    glazed: bool = chance(0.5, "has a window")
    flanged: bool = chance(0.2, "a flange round the case")

    def build(self, t: Table, size: float) -> None:
        """Puts it down about z, its front towards +z and its back at 0, its case of a diameter [m]."""
        r, n, d, lip, wall = size / 2, t.n(size / 2), self.deep * size, self.lip * size / 2, 0.92 * size / 2
        floor, wide, t = 0.8 * d, 0.035 * r, t.bundled(CASE)
        side = outline(0.9 * r, 0.0, r, 0.06 * d, r, 0.75 * d, lip, 0.77 * d, lip, 0.96 * d, 0.98 * lip, d)
        t.add(CASE, turned([*side, (wall, d), (wall, floor)], n))
        t.add("gauge face", cylinder(0.98 * wall, floor, floor + 0.001, n), front=FRONT)
        hand = np.array(outline(-0.25 * r, -wide, 0.75 * r, -0.3 * wide, 0.75 * r, 0.3 * wide, -0.25 * r, wide))
        pointer = merge(
            [extrude(hand, floor + 0.0015, floor + 0.0025), cylinder(0.07 * r, floor + 0.001, floor + 0.004, 10)]
        )
        t.add("gauge needle", moved(pointer, spun("z", self.reading)), turns=Turning("needle"), front=FRONT)
        if self.glazed:
            t.add("gauge glass", cylinder(0.985 * wall, 0.9 * d, 0.9 * d + 0.002, n), front=FRONT)
        if self.flanged:
            t.add(CASE, ring(0.98 * r, 1.35 * r, 0.7 * d, 0.7 * d + 0.003, n))


def _distinct(*pieces: Floats | list[tuple[float, float, float]]) -> Floats:
    path = np.vstack([np.asarray(piece, float) for piece in pieces])
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-6])
    return np.asarray(path[keep])


class _Mount(Params):
    """What a gauge stands on."""

    form: int = whole(0, 5, "nipple, coil siphon, U siphon, needle valve, diaphragm seal, snubber")
    tall: float = between(0.03, 0.1, "height of a nipple", "m", when=lambda p: p.form == 0)
    reach: float = between(0.025, 0.04, "radius of a coil", "m", when=lambda p: p.form == 1)
    plate: float = between(0.03, 0.055, "radius of a seal", "m", when=lambda p: p.form == 4)

    def build(self, t: Table) -> Table:
        """Puts it down; returns the table where it ends."""
        r, n = 0.0068, max(6, min(16, t.style.round(0.007)))
        if self.form == 0:
            put(t, STEM, cylinder(r, 0, self.tall, n))
            return t.at(0, 0, self.tall)
        if self.form == 1:  # a coil siphon (DIN 16282, form trumpet)
            return self._coil(t, r, n)
        if self.form == 2:
            first = arc((0, 0, 0.02), (0, 0, 0.05), (0.03, 0, 0.05), 4)
            second = arc((0.04, 0, 0.05), (0.07, 0, 0.05), (0.07, 0, 0.08), 4)
            path = _distinct([(0, 0, 0), (0, 0, 0.02)], first, second, [(0.07, 0, 0.13)])
            put(t, "siphon", tube(path, r, 0.0, n))
            return t.at(0.07, 0, 0.13)
        if self.form == 3:  # a shut-off needle valve under the gauge
            valve = [hexagon(0.028, 0.03, 0.07), cylinder(r, 0.0, 0.1, n)]
            bar = rod((0.048, -0.025, 0.05), (0.048, 0.025, 0.05), 0.003, 8)
            put(t, STEM, *valve, along("x", cylinder(0.009, 0.0, 0.045, n), 0, 0, 0.05), bar)
            return t.at(0, 0, 0.1)
        if self.form == 4:  # a diaphragm seal: two flanges with bolts
            p, m = self.plate, t.n(self.plate)
            lower = turned(outline(0.6 * p, 0.025, p, 0.03, p, 0.045), m)
            upper = turned(outline(p, 0.046, p, 0.06, 0.4 * p, 0.066, 0.3 * p, 0.08), m)
            put(t, STEM, cylinder(r, 0.0, 0.03, n), lower, upper)
            t.bundled(STEM).add("bolt", bolt_circle(6, 0.85 * p, 0.006, 0.03, 0.06))
            return t.at(0, 0, 0.08)
        snubber = [cylinder(r, 0.0, 0.02, n), hexagon(0.024, 0.018, 0.04), cylinder(0.011, 0.04, 0.06, n)]
        put(t, STEM, *snubber, cylinder(r, 0.06, 0.075, n))
        return t.at(0, 0, 0.075)

    def _coil(self, t: Table, r: float, n: int) -> Table:
        reach, a, top = self.reach, np.linspace(0, 2 * np.pi, 17), 0.075 + 2 * self.reach
        rise = 0.03 + reach - reach * np.cos(a) + np.linspace(0, 0.006, 17)
        loop = np.column_stack([reach * np.sin(a), 0.022 * a / (2 * np.pi), rise])
        put(t, "siphon", tube(np.vstack([[0, 0, 0], loop, [0, 0.022, top - 0.015]]), r, 0.0, n))
        put(t.at(0, 0.022), "siphon", hexagon(0.022, top - 0.025, top))
        return t.at(0, 0.022, top)


class Bottom(Gauge, name="gauge/bottom", sizes=SIZES, weight=4):
    """A gauge with its connection below, on a nipple, siphon, needle valve, diaphragm seal or snubber."""

    size: float = among(_SIZES, _SIZE, "m")
    mount: _Mount = nested(_Mount, "what it stands on")
    hexagonal: bool = chance(0.3, "its wrench flats are hexagonal, not square")
    dial: _Dial = nested(_Dial, _DIAL)
    turn: float = between(0, 6.3, "which way its dial looks", "rad")

    def build(self, t: Table) -> Model:
        wide, low, high = 0.014 if self.size < 0.08 else 0.022, -0.004, 0.03
        t, span = self.mount.build(t).spun("z", self.turn), 0.034
        flats = (
            hexagon(wide, low + 0.4 * span, high)
            if self.hexagonal
            else box((wide, wide, 0.6 * span), (0, 0, low + 0.7 * span))
        )
        put(t, STEM, cylinder(0.42 * wide, low, low + 0.5 * span, 12), flats)
        self.dial.build(upright(t, self.size, 0.028, self.dial.deep * self.size), self.size)
        return t.model(kind="pressure gauge")


class Back(Gauge, name="gauge/back", sizes=SIZES, weight=2):
    """A gauge or bimetal thermometer with its connection at the back: its dial looks up, or to the side of an elbow."""

    size: float = among(_SIZES, _SIZE, "m")
    tall: float = between(0.03, 0.12, "height of its stem", "m")
    dial: _Dial = nested(_Dial, _DIAL)
    tilt: float = among((0.0, 0.0, 0.5 * np.pi, 0.25 * np.pi), "of its dial", "rad")
    pressure: bool = chance(0.5, "a pressure gauge, not a thermometer")

    def build(self, t: Table) -> Model:
        size, tall, n = self.size, self.tall, 12
        put(t, STEM, cylinder(0.0068, 0.0, tall, n), hexagon(0.022, 0.3 * tall, 0.3 * tall + 0.014))
        place = t.at(0, 0, tall)
        if self.tilt:
            end = (0, -0.02 - 0.3 * size, tall + 0.02 + 0.1 * size)
            put(t, STEM, tube(np.array([[0, 0, tall - 0.002], [0, 0, tall + 0.02], end]), 0.0068, 0.0, n))
            place = t.at(*end).spun("x", self.tilt)
        self.dial.build(place, size)
        return t.model(kind="pressure gauge" if self.pressure else "thermometer")


class Digital(Gauge, name="gauge/digital", sizes=SIZES):
    """A digital gauge: a round or square case with a small display and buttons, on a hexagon."""

    side: float = among((0.06, 0.08, 0.1), "width of its case", "m")
    tall: float = between(0.03, 0.06, "height of its stem", "m")
    disc: bool = chance(0.5, "its case is round")

    def build(self, t: Table) -> Model:
        side, tall, deep = self.side, self.tall, 0.45 * self.side
        put(t, STEM, cylinder(0.0068, 0, tall, 12), hexagon(0.024, 0.4 * tall, tall + 0.004))
        shape = circle(side / 2, t.n(side)) if self.disc else rounded_rectangle(side, side, 0.15 * side, 4)
        t, key = upright(t, side, tall, deep), cylinder(0.05 * side, deep, deep + 0.003, 8)
        t.add(CASE, extrude(shape, 0, deep), of="electrical")
        t.add("gauge glass", box((0.6 * side, 0.3 * side, 0.002), (0, 0.1 * side, deep + 0.001)), front=FRONT)
        t.add(CASE, *(moved(key, at(x * side, -0.25 * side)) for x in (-0.2, 0.0, 0.2)), of="rubber")
        return t.model(kind="pressure gauge")


class _Drum(Params):
    """A two-chamber transmitter housing about x with covers, on a neck."""

    radius: float = between(0.038, 0.055, "of the drum", "m")
    both: bool = chance(0.5, "a cable gland on either side")

    def solid(self, style: ModelingStyle) -> Solid:
        """All of it as one mesh on z = 0."""
        r, n = self.radius, style.round(self.radius)
        cover = turned(outline(1.12 * r, 0.85 * r, 1.15 * r, 0.95 * r, 1.15 * r, 1.45 * r, 1.0 * r, 1.55 * r), n)
        body = [along("x", cylinder(r, -0.9 * r, 0.9 * r, n)), along("x", cover), along("-x", cover)]
        gland = merge([cylinder(0.28 * r, 0.8 * r, 1.35 * r, 10), hexagon(0.7 * r, 1.2 * r, 1.5 * r)])
        glands = [along(axis, gland, 0, 0, 0.2 * r) for axis in (("y", "-y") if self.both else ("y",))]
        return moved(merge([*body, cylinder(0.55 * r, -1.35 * r, -0.5 * r, n), *glands]), at(0, 0, 1.35 * r))


class _Pot(Params):
    """A connection head on z = 0 (DIN 43729 form B): a pot with a slanting or round lid, a cable gland."""

    radius: float = between(0.028, 0.045, "of the pot", "m")
    lean: float = among((0.0, 0.25), "of the lid", "rad")

    def solid(self, style: ModelingStyle) -> Solid:
        """All of it as one mesh."""
        r, n = self.radius, style.round(0.035)
        pot = turned(outline(0.45 * r, 0.0, 0.5 * r, 0.4 * r, r, 0.7 * r, r, 1.4 * r), n)
        lid = turned(outline(1.08 * r, 0.0, 1.08 * r, 0.35 * r, 0.8 * r, 0.6 * r), n)
        lid = moved(lid, at(0, 0, 1.4 * r) @ spun("y", self.lean))
        gland = merge([cylinder(0.25 * r, 0.8 * r, 1.5 * r, 10), hexagon(0.65 * r, 1.2 * r, 1.5 * r)])
        return merge([pot, lid, along("x", gland, 0, 0, r)])


class TwoChamber(Gauge, name="transmitter/two-chamber", label=_HEAD, bundle=_HEAD, sizes=SIZES, weight=1.5):
    """A pressure transmitter: process connection, a sensor barrel or a pair of flanges with bolts, the housing."""

    barrel: bool = chance(0.5, "a sensor barrel, not a pair of flanges")
    tall: float = between(0.04, 0.1, "height of the barrel", "m", when=lambda p: p.barrel)
    housing: _Drum = nested(_Drum, "electronics")
    turn: float = between(0, 6, "which way they look", "rad")

    def build(self, t: Table) -> Model:
        top = 0.04 + self.tall if self.barrel else 0.16
        if self.barrel:
            barrel = cylinder(0.02, 0.038, top, t.n(0.02))
            t.add(_HEAD, cylinder(0.0068, 0, 0.02, 12), hexagon(0.027, 0.018, 0.04), barrel, of="trim")
        else:
            flats = [box((0.022, 0.1, 0.075), (s * 0.018, 0, 0.08)) for s in (-1, 1)]
            t.add(_HEAD, *flats, cylinder(0.035, 0.1, top, t.n(0.035)), cylinder(0.0068, 0.0, 0.06, 12), of="trim")
            bolt = merge([cylinder(0.005, -0.04, 0.04, 8), hexagon(0.016, 0.03, 0.04)])
            bolts = [moved(bolt, at(x * 0.028, y * 0.04)) for x in (-1, 1) for y in (-1, 1)]
            t.at(0, 0, 0.08).along("x").add("bolt", *bolts)
        t.at(0, 0, top - 0.004).spun("z", self.turn).add(_HEAD, self.housing.solid(t.style))
        return t.model(kind="pressure transmitter")


class Compact(Gauge, name="transmitter/compact", label=_HEAD, bundle=_HEAD, sizes=SIZES):
    """A small transmitter or switch: hexagon, slim can, plug (DIN EN 175301-803) or cable."""

    radius: float = between(0.011, 0.02, "of the can", "m")
    tall: float = between(0.04, 0.1, "height of the can", "m")
    plugged: bool = chance(0.5, "a plug, not a bare cable")

    def build(self, t: Table) -> Model:
        r, z = self.radius, 0.03 + self.tall
        body = [cylinder(0.0068, 0, 0.015, 12), hexagon(2.2 * r, 0.013, 0.03), cylinder(r, 0.028, z, t.n(r, most=16))]
        t.add(_HEAD, *body, of="trim")
        if self.plugged:
            plug = [
                box((0.028, 0.028, 0.03), (0, 0, z + 0.014)),
                along("x", cylinder(0.009, 0.0, 0.03, 10), 0, 0, z + 0.014),
            ]
        else:
            plug = [rope([(0, 0, z - 0.002), (0, 0, z + 0.03), (0.02, 0, z + 0.05), (0.08, 0, z + 0.04)], 0.004, 8)]
        t.add(_HEAD, *plug, of="rubber")
        return t.model(kind="pressure transmitter")


class WellHead(Gauge, name="thermowell/head", label=_WELL, bundle=_WELL, sizes=SIZES, weight=1.5):
    """A thermowell with its extension and connection head, or with a bimetal dial."""

    radius: float = between(0.008, 0.014, "of the well", "m")
    reach: float = between(0.03, 0.07, "of the well in the flow", "m")
    flanged: bool = chance(0.35, "a flange on it")
    long: float = between(0.03, 0.15, "length of the extension", "m")
    headed: bool = chance(0.7, "a connection head, not a dial")
    head: _Pot = nested(_Pot, "connection head", when=lambda p: p.headed)
    size: float = among(
        (0.08, 0.1, 0.125), "diameter of the dial's case", "m", when=lambda p: not p.headed, otherwise=0.0
    )
    dial: _Dial = nested(_Dial, _DIAL, when=lambda p: not p.headed)
    tilt: float = among((0.0, 0.0, 0.6), "of the dial", "rad", when=lambda p: not p.headed, otherwise=0.0)

    def build(self, t: Table) -> Model:
        r, n, top = self.radius, 14, 0.045 + self.long
        well = [turned(outline(0.5 * r, -self.reach, 0.7 * r, 0.0, 1.2 * r, 0.004, 1.2 * r, 0.02), n)]
        well.append(hexagon(3.2 * r, 0.018, 0.045))
        if self.flanged:
            well.append(moved(disc_flange(25, t.style, plate_thickness(25)), at(0, 0, 0.05)))
        t.add(_WELL, *well)
        t.add(_WELL, cylinder(0.9 * r, 0.04, top, n), hexagon(2.6 * r, top - 0.02, top - 0.005))
        if self.headed:
            put(t.at(0, 0, top - 0.003), _HEAD, self.head.solid(t.style))
            return t.model(kind="temperature transmitter")
        self.dial.build(t.at(0, 0, top - 0.002).spun("x", self.tilt), self.size)
        return t.model(kind="thermometer")


class GlassThermometer(Gauge, name="thermometer/glass", sizes=SIZES):
    """An industrial glass thermometer: a flat upright case with a scale and a tube (DIN 16195)."""

    tall: float = between(0.11, 0.22, "height of its case", "m")
    wide: float = between(0.03, 0.045, "width of its case", "m")

    def build(self, t: Table) -> Model:
        tall, wide = self.tall, self.wide
        put(t, STEM, cylinder(0.006, 0, 0.04, 12), hexagon(0.024, 0.03, 0.05))
        t = upright(t, tall, 0.048, 0.018)
        t.add(CASE, extrude(rounded_rectangle(wide, tall, 0.4 * wide, 4), 0.0, 0.018), of="handle")
        t.add("gauge face", box((0.5 * wide, 0.8 * tall, 0.001), (0, 0, 0.0185)), front=FRONT)
        t.add("gauge glass", rod((0, -0.42 * tall, 0.02), (0, 0.42 * tall, 0.02), 0.003, 8), front=FRONT)
        return t.model(kind="thermometer")


def _meter(t: Table, form: int, ratio: float) -> tuple[float, float]:
    """The measuring tube of a meter in a line, plain or a drum; its length and the height of its top."""
    radius, neck = t.pipe.radius, 0.485 * t.flange.hub
    length = max(0.2, ratio * t.pipe.outer + 0.08)
    low, drum = plate_thickness(t.dn) + min(nut_room(t.dn), 0.2 * length), (1.05, 1.45, 1.7)[form] * radius + 0.006
    drum = max(1.06 * neck, drum)
    if form == 0:
        middle = [(neck, 0.3 * length), (neck, 0.7 * length)]
    else:
        middle = [(neck, low), (drum, low + 0.001), (drum, length - low - 0.001), (neck, length - low)]
    t.add(NAME, flanged_body(t.dn, t.style, length, middle))
    return round(length, 6), drum if form else neck


_RATIO = "its length over 80 mm / diameter of the pipe"


class _Post(Params):
    """A post on a meter."""

    rise: float = between(0.03, 0.09, "height over the meter and a fifth of the pipe's radius", "m")
    radius: float = between(0.012, 0.022, "of the post", "m")
    turn: float = among((0.0, 1.5708), "which way what it carries looks", "rad")

    def build(self, t: Table, top: float) -> Table:
        """Puts it down about z on a meter this high [m]; returns the table where it ends."""
        r, rise = self.radius, top + self.rise + 0.2 * t.pipe.radius
        t.add(NAME, cylinder(r, 0.8 * top, rise, 12), cylinder(1.8 * r, rise - 0.006, rise, 12))
        return t.at(0, 0, rise - 0.002).spun("z", self.turn)


class Drum(FlowMeter, name="flow meter/drum", weight=1.5):
    """A magnetic meter: a drum between flanges, a post with a housing or a box."""

    form: int = among((1, 2), "a slim drum, a wide one")
    headed: bool = chance(0.6, "a two-chamber housing, not a box")
    ratio: float = between(1.6, 2.6, _RATIO)
    post: _Post = nested(_Post, "post")
    housing: _Drum = nested(_Drum, "housing", when=lambda p: p.headed)

    def build(self, t: Table) -> Model:
        length, top = _meter(t, self.form, self.ratio)
        end = self.post.build(t.at(length / 2), top)
        if self.headed:
            put(end, _HEAD, self.housing.solid(t.style))
        else:
            case = box((0.14, 0.1, 0.16), (0, 0, 0.08)), box((0.09, 0.004, 0.06), (0, -0.052, 0.1))
            put(end, _HEAD, *case, of="electrical")
        return t.model(length, kind=NAME)


class Vortex(FlowMeter, name="flow meter/vortex"):
    """A vortex meter: a plain tube between flanges, a post with a housing."""

    ratio: float = between(1.6, 2.6, _RATIO)
    post: _Post = nested(_Post, "post")
    housing: _Drum = nested(_Drum, "housing")

    def build(self, t: Table) -> Model:
        length, top = _meter(t, 0, self.ratio)
        put(self.post.build(t.at(length / 2), top), _HEAD, self.housing.solid(t.style))
        return t.model(length, kind=NAME)


class Turbine(FlowMeter, name="flow meter/turbine"):
    """A turbine or water meter: a round register with a lid on the tube."""

    form: int = among((0, 1), "a plain tube, a drum")
    ratio: float = between(1.6, 2.6, _RATIO)
    lid: bool = chance(0.4, "an open lid")

    def build(self, t: Table) -> Model:
        length, top = _meter(t, self.form, self.ratio)
        r, t = 0.035 + 0.35 * t.pipe.radius, t.at(length / 2)
        n, case = t.n(r), t.bundled(CASE)
        t.add(NAME, cylinder(0.8 * r, 0.6 * top, top + 0.02, n))
        low, high = outline(r, top + 0.01, 1.05 * r, top + 0.03), outline(1.05 * r, top + 0.06, 0.95 * r, top + 0.075)
        case.add(CASE, turned([*low, *high], n), of="handle")
        case.add("gauge face", cylinder(0.9 * r, top + 0.0752, top + 0.077, n), front=FRONT)
        if self.lid:
            lid = case.at(0, 0.9 * r, top + 0.08).spun("x", 1.0).at(0, 0.9 * r)
            lid.add(CASE, cylinder(1.05 * r, 0.0, 0.006, n), of="handle")
        return t.model(length, kind=NAME)


class Water(FlowMeter, name="flow meter/water", sizes=(15, 20, 25, 32, 40)):
    """A small threaded water meter."""

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r = 0.11 + 3.0 * radius, 0.03 + 0.9 * radius
        n, ends = t.n(r), [hex_end(self.dn, a * length, b * length, t.style) for a, b in ((0, 0.15), (0.85, 1))]
        pipe = along("x", cylinder(1.05 * radius, 0.1 * length, 0.9 * length, n))
        chamber = moved(turned(outline(0.7 * r, -0.6 * r, r, -0.3 * r, r, 0.5 * r), n), at(length / 2))
        t.add(NAME, ends[0], pipe, ends[1], chamber, of="trim")
        case = t.at(length / 2).bundled(CASE)
        case.add(CASE, turned(outline(1.05 * r, 0.5 * r, 1.05 * r, 0.95 * r, 0.95 * r, 1.05 * r), n), of="handle")
        case.add("gauge face", cylinder(0.88 * r, 1.05 * r, 1.06 * r, n), front=FRONT)
        return t.model(round(length, 6), "welded", NAME)


class Coriolis(FlowMeter, name="flow meter/coriolis", sizes=_SOME):
    """A Coriolis meter: two bent tubes in a case below the line, a manifold with flanges, a housing on top."""

    square: bool = chance(0.6, "two bent tubes, not a round case")
    housing: _Drum = nested(_Drum, "housing")

    def build(self, t: Table) -> Model:
        radius, neck = t.pipe.radius, 0.485 * t.flange.hub
        length, rise = 0.3 + 8 * radius, 0.05 + radius
        body = flanged_body(self.dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        t.add(NAME, body, moved(cylinder(0.022, 0.0, rise + 0.01, 12), at(length / 2)))
        t.add(NAME, self._tubes(t, length))
        put(t.at(length / 2, 0, rise), _HEAD, self.housing.solid(t.style))
        return t.model(round(length, 6), kind=NAME)

    def _tubes(self, t: Table, length: float) -> Solid:
        radius, n = t.pipe.radius, t.n(t.pipe.radius)
        a, b, r, drop = 0.24 * length, 0.76 * length, 0.8 * radius + 0.004, 0.15 + 4.5 * radius
        if self.square:
            bend = 0.3 * (b - a)
            first = arc((a, 0, -drop + bend), (a, 0, -drop), (a + bend, 0, -drop), 5)
            second = arc((b - bend, 0, -drop), (b, 0, -drop), (b, 0, -drop + bend), 5)
            one = tube(_distinct([(a, 0, 0)], first, second, [(b, 0, 0)]), r, 0.0, n)
            return merge([moved(one, at(0, s * 1.15 * r, 0)) for s in (-1, 1)])
        angles = np.linspace(np.pi, 2 * np.pi, 12)
        bow = np.column_stack([(a + b) / 2 + 0.6 * (b - a) * np.cos(angles), 0.8 * drop * np.sin(angles)])
        return along("-y", extrude(np.vstack([bow, [(b, 0.4 * radius), (a, 0.4 * radius)]]), -1.6 * r, 1.6 * r))


class Rotameter(FlowMeter, name="flow meter/rotameter", sizes=_SOME):
    """A variable-area meter in a line: flanges, a glass cone between them, or a metal tube with an indicator box."""

    glass: bool = chance(0.5, "a glass cone, not a metal tube with an indicator box")

    def build(self, t: Table) -> Model:
        radius, n, low = t.pipe.radius, t.n(t.pipe.radius), plate_thickness(self.dn)
        length, line = 0.25 + 2 * radius, t.along("x")
        plate = disc_flange(self.dn, t.style, low + 0.03, bore_of(self.dn, t.style))
        line.add(NAME, plate)
        t.at(length).along("-x").add(NAME, plate)
        if self.glass:
            cone = outline(0.9 * radius, low + 0.028, 1.15 * radius, length - low - 0.028)
            line.add("gauge glass", turned(cone, n, bore=0.83 * radius if t.style.hollow else 0.0))
            t.add("stud", about_x(around(cylinder(0.005, low, length - low, 8), 4, 1.7 * radius, np.pi / 4)))
            bob = outline(0.2 * radius, 0.45 * length, 0.8 * radius, 0.5 * length, 0.8 * radius, 0.53 * length)
            line.add("gauge needle", turned(bob, n), of="trim")
        else:
            line.add(NAME, ring(bore_of(self.dn, t.style), radius, low + 0.02, length - low - 0.02, n))
            case = t.at(length / 2, -radius).bundled(CASE)
            case.add(CASE, box((0.12, 0.06, 0.14), (0, -0.03, 0)), of="valve")
            case.add("gauge face", box((0.09, 0.003, 0.11), (0, -0.0615, 0)), front=BEFORE)
        return t.model(round(length, 6), kind=NAME)


class Orifice(FlowMeter, name="flow meter/orifice"):
    """An orifice plate with its handle between flanges (ISO 5167)."""

    def build(self, t: Table) -> Model:
        size, n = t.flange, t.n(t.flange.circle / 2)
        thick, outer = 0.003 + 0.01 * t.pipe.radius, 0.49 * (size.circle - size.bolt)
        handle = box((0.1 + 0.2 * outer, 0.03, thick), (outer + 0.04, 0, thick / 2))
        plate = merge([ring(0.6 * t.pipe.bore, outer, 0, thick, n), handle])
        t.spun("x", np.pi / 2).add(NAME, about_x(plate), of="trim", own=False)
        return t.model(round(thick, 6), "wafer", NAME)


class FlangedSight(SightGlass, name="sight glass/flanged", sizes=_SOME):
    """A sight glass in a line: a body with two round windows, or a glass tube between flanges with rods."""

    windowed: bool = chance(0.55, "a body with two windows, not a glass tube")

    def build(self, t: Table) -> Model:
        return t.model(self._windows(t) if self.windowed else self._tube(t), kind=SIGHT_GLASS)

    def _windows(self, t: Table) -> float:
        radius, n, neck = t.pipe.radius, t.n(1.4 * t.pipe.radius), 0.485 * t.flange.hub
        length, reach = 0.12 + 3.6 * radius, max(1.5 * radius, 1.15 * neck) + 0.015
        body = flanged_body(self.dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        port = [cylinder(1.1 * radius + 0.004, -reach, reach, n)]
        port += [ring(radius, 1.6 * radius + 0.01, s * reach - 0.008, s * reach + 0.008, n) for s in (-1, 1)]
        t.add(SIGHT_GLASS, body, *(along("y", solid, length / 2) for solid in port), of="valve")
        panes = [cylinder(radius, s * reach - 0.006, s * reach + 0.006, n) for s in (-1, 1)]
        across = t.at(length / 2).along("-y")
        across.add("gauge glass", *panes[::-1], front=FRONT)
        far, thread = 1.3 * radius + 0.006, 0.004 + 0.05 * radius
        across.add("bolt", *(bolt_circle(6, far, thread, s * reach - 0.008, s * reach + 0.008) for s in (-1, 1)))
        return round(length, 6)

    def _tube(self, t: Table) -> float:
        radius, low, n = t.pipe.radius, plate_thickness(self.dn), t.n(1.4 * t.pipe.radius)
        length, plate = 0.1 + 3 * radius, disc_flange(self.dn, t.style, low + 0.004, bore_of(self.dn, t.style))
        t.add(SIGHT_GLASS, along("x", plate), along("-x", plate, length))
        t.along("x").add("gauge glass", ring(radius, 1.2 * radius, low, length - low, n))
        t.add("stud", about_x(around(cylinder(0.006, low, length - low, 8), 4, 0.9 * t.flange.circle / 2, 0)))
        return round(length, 6)


INSTRUMENTS = families_of(
    Bottom, Back, Digital, TwoChamber, Compact, WellHead, GlassThermometer, Drum, Vortex, Turbine, Water, Coriolis,
    Rotameter, Orifice, FlangedSight,
)  # fmt: skip
