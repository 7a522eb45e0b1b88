"""Thermometers, thermowells and temperature sensors."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, STEM, Dial, Gland, Housing, fine_sides
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import BEFORE, Board, Gauge, bent, put
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model
from cadplants.model.standards import PIPES, SIZES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import along, ball, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["HEAT_BUILDS"]

_WELL, _KIND, _SENSOR, _HEAD = "thermowell", "thermometer", "temperature transmitter", "transmitter"
_DESIGNS, _DESIGN, _ELECTRONICS = ("plain", "crimped", "bayonet"), "how its case is made", "electronics"
_TURN = "which way the electronics look"


def _ball_at(radius: float, z: float, style: ModelingStyle) -> Solid:
    """A ball on the axis [m]."""
    return moved(ball(radius, fine_sides(radius, style, 12)), at(0, 0, z))


def _probe(reach: float, r: float, n: int) -> Solid:
    """The part of a well in the flow, from -reach to 0: tapered, stepped or straight [m]."""
    return turned([(0.6 * r, -reach), (r, 0.0)], n)


class _Top(Params):
    """What is screwed on a thermowell: an extension with a head, a bimetal dial, a plug with a chain."""

    form: str = among(("head", "head", "union", "dial", "plug"), "a head, one on a union, a dial, a plug")
    radius: float = between(0.007, 0.012, "of the extension", "m", when=lambda p: p.form != "plug")
    long: float = between(0.03, 0.16, "length of the extension", "m", when=lambda p: p.form != "plug")
    tilt: float = among(
        (0.0, np.pi / 4, np.pi / 2), "of the dial", "rad", when=lambda p: p.form == "dial", otherwise=0.0
    )
    size: float = among(
        (0.063, 0.08, 0.1, 0.13), "diameter of the dial's case", "m", when=lambda p: p.form == "dial", otherwise=0.0
    )
    design: str = among(_DESIGNS, _DESIGN, when=lambda p: p.form == "dial", otherwise="")
    dial: Dial = nested(
        Dial, "case with its dial", fixed=lambda p: {"design": p.design}, when=lambda p: p.form == "dial"
    )
    turn: float = between(0, 6, _TURN, "rad", when=lambda p: p.form in ("head", "union"))
    housing: Housing = nested(Housing, _ELECTRONICS, when=lambda p: p.form in ("head", "union"))

    def build(self, t: Table, low: float) -> Model:
        """Puts it down on a well that ends on a height [m]."""
        r, n, high = self.radius, 12, low + self.long
        if self.form == "plug":
            link, cap = torus(0.005, 0.0013, 8, 5), hexagon(0.03, low - 0.001, low + 0.014)
            places = [at(0.02 + 0.006 * k, 0, low + 0.006 - 0.005 * k) @ spun("x", 1.57 * (k % 2)) for k in range(5)]
            put(t, _WELL, cap, _ball_at(0.009, low + 0.018, t.style), *(moved(link, place) for place in places))
            return t.model(kind=_WELL)
        neck = [cylinder(r, low - 0.002, high, n), hexagon(2.6 * r, low - 0.001, low + 0.012)]
        if self.form == "union":  # nipple, union, nipple
            mid = (low + high) / 2
            neck += [hexagon(4.2 * r, mid - 0.008, mid + 0.012), cylinder(1.7 * r, mid - 0.018, mid + 0.022, n)]
        put(t, _WELL, *neck)
        if self.form == "dial":
            put(t, STEM, _ball_at(0.014, high, t.style))
            # The back of the case sits on a swivel just beyond the neck.
            self.dial.build(t.at(0, 0, high).spun("x", self.tilt).at(0, 0, 0.01), self.size)
            return t.model(kind=_KIND)
        put(t.at(0, 0, high - 0.003).spun("z", self.turn), _HEAD, self.housing.solid(t.style))
        return t.model(kind=_SENSOR)


class _Thermowell(Gauge, label=_WELL, bundle=_WELL):
    """A thermowell on an outlet."""


class _FlangedWell(Gauge, place="head", label=_WELL, bundle=_WELL, sizes=(25, 40, 50, 80)):
    """A thermowell on a flange."""


_ON_WELL = "what is screwed on the well"


class Flanged(_FlangedWell, name="thermowell/flanged", weight=1.5):
    """A flanged thermowell (ASME B40.9, B16.5 flange) with a lagging extension and a head, dial or plug."""

    reach: float = between(0.02, 0.06, "of the well in the flow", "m")
    lag: float = between(0.015, 0.08, "length of the lagging extension", "m")
    top: _Top = nested(_Top, _ON_WELL)

    def build(self, t: Table) -> Model:
        t, thick = t.along("x"), plate_thickness(self.dn)
        flange, probe = disc_flange(self.dn, t.style, thick + 0.001), _probe(self.reach, 0.011, 12)
        t.add(_WELL, flange, probe, cylinder(0.017, thick, thick + self.lag, 16))
        return self.top.build(t, thick + self.lag)


class VanStone(_FlangedWell, name="thermowell/van stone"):
    """A Van Stone thermowell (ASME B40.9): a collar as wide as the raised face under a loose lap flange."""

    top: _Top = nested(_Top, _ON_WELL)

    def build(self, t: Table) -> Model:
        t, size, thick, r = t.along("x"), t.flange, plate_thickness(self.dn), 0.016
        collar, n, end = 0.4 * thick, t.n(size.raised / 2), thick + 0.03
        t.add(_WELL, cylinder(size.raised / 2, 0.0, collar, n), cylinder(r, collar, end, 16), _probe(0.04, 0.011, 12))
        angles = (2 * np.arange(size.n_bolts) + 1) * np.pi / size.n_bolts if t.style.holes else ()
        far = size.circle / 2
        holes = [circle(size.hole / 2, 10, (far * np.cos(a), far * np.sin(a))) for a in angles]
        lap = extrude(circle(size.outer / 2, n), collar, thick, (circle(1.05 * r, 16), *holes))
        t.add("flange", lap, own=True)
        return self.top.build(t, end)


class Welded(_Thermowell, name="thermowell/welded", weight=1.5):
    """A weld-in thermowell (DIN 43772 form 4): a smooth cone through a boss, no hexagon, with its head."""

    radius: float = between(0.009, 0.013, "of the well", "m")
    tall: float = between(0.04, 0.12, "height of the well", "m")
    top: _Top = nested(_Top, _ON_WELL)

    def build(self, t: Table) -> Model:
        r, n = self.radius, t.n(self.radius)
        boss = outline(2.2 * r, 0.0, 2.0 * r, 0.012, 1.3 * r, 0.022)
        t.add(_WELL, turned(boss, n), turned(outline(0.7 * r, -0.03, r, 0.0, r, self.tall), n))
        return self.top.build(t, self.tall)


class Lagging(_Thermowell, name="thermowell/lagging", weight=1.5):
    """A threaded thermowell with a long lagging extension or a two-step hexagon, and what is screwed into it."""

    radius: float = between(0.008, 0.014, "of the well", "m")
    lag: float = between(0.02, 0.11, "length of the lagging extension", "m")
    stepped: bool = chance(0.4, "a second hexagon on it")
    top: _Top = nested(_Top, _ON_WELL)

    def build(self, t: Table) -> Model:
        r, high, n = self.radius, 0.04 + self.lag, t.n(self.radius)
        well = [cylinder(1.25 * r, 0.0, 0.022, n), _probe(0.03, r, n), hexagon(3.4 * r, 0.018, 0.034)]
        well.append(turned(outline(1.5 * r, 0.03, 1.5 * r, high - 0.006, 1.2 * r, high), n))
        if self.stepped:
            well.append(hexagon(3.2 * r, high - 0.004, high + 0.014))
            high += 0.014
        t.add(_WELL, *well)
        return self.top.build(t, high)


class Test(_Thermowell, name="thermowell/test"):
    """A test well with a cap on a chain."""

    radius: float = between(0.009, 0.015, "of the well", "m")
    tall: float = between(0.03, 0.09, "height of the well", "m")
    top: _Top = nested(_Top, _ON_WELL, fixed=lambda _: {"form": "plug"})

    def build(self, t: Table) -> Model:
        r, tall, n = self.radius, self.tall, t.n(self.radius)
        t.add(_WELL, cylinder(1.1 * r, 0.0, tall, n), hexagon(3.2 * r, 0.5 * tall, tall), _probe(0.03, r, n))
        return self.top.build(t, tall)


class Bimetal(Gauge, name="thermometer/bimetal", weight=1.5):
    """A bimetal thermometer: a dial at the back, at the bottom or at every angle on a slim stem (EN 13190)."""

    size: float = among((0.05, 0.063, 0.08, 0.1, 0.13), "diameter of its case", "m")
    tall: float = between(0.03, 0.1, "height of its stem over the nut", "m")
    design: str = among(_DESIGNS, _DESIGN)
    form: int = whole(0, 2, "its stem at the back, at the bottom, on a hinge")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda p: {"design": p.design, "deep": 0.3})
    tilt: float = between(0.2, 1.5, "of the dial on a hinge", "rad", when=lambda p: p.form == 2)

    def build(self, t: Table) -> Model:
        size, top, n, hinge = self.size, self.tall + 0.03, fine_sides(0.01, t.style), []
        if self.form == 0:
            case = t.at(0, 0, top - 0.001)
        elif self.form == 1:
            case = t.at(0, 0.15 * size, top + size / 2 - 0.002).along("-y")
        else:  # a hinge of two discs behind the case
            solids = (cylinder(0.013, -0.02, 0.02, n), hexagon(0.012, 0.02, 0.026))
            hinge = [along("x", solid, 0, 0, top + 0.008) for solid in solids]
            case = t.at(0, 0, top + 0.008).spun("x", self.tilt).at(0, 0, 0.012)
        stem = cylinder(0.0045, 0.025, top, n)
        put(t, STEM, cylinder(0.009, 0.0, 0.02, n), hexagon(0.024, 0.016, 0.03), stem, *hinge)
        self.dial.build(case, size)
        return t.model(kind=_KIND)


class VCase(Gauge, name="thermometer/v-case"):
    """An industrial glass thermometer in a V-shaped brass case (DIN 16181, 16182), straight or at an angle."""

    tall: float = among((0.11, 0.15, 0.2), "height of its case", "m")
    wide: float = between(0.026, 0.038, "width of its case", "m")
    deep: float = between(0.018, 0.028, "depth of its case", "m")
    low: float = between(0.035, 0.06, "height of its stem", "m")
    lean: float = among((0.0, 0.0, np.pi / 2, np.pi / 4), "of its case", "rad")

    def build(self, t: Table) -> Model:
        tall, wide, deep, low, n = self.tall, self.wide, self.deep, self.low, fine_sides(0.009, t.style)
        stem = [cylinder(0.0065, 0, low + 0.004, n), hexagon(0.024, 0.3 * low, 0.3 * low + 0.014)]
        if self.lean:
            stem.append(_ball_at(0.5 * wide, low + 0.4 * wide, t.style))
        put(t, STEM, *stem)
        t = t.at(0, 0, low + (0.4 * wide if self.lean else 0.012)).spun("y", self.lean)
        t, front = t.at(0, 0, 0.01 if self.lean else 0.0), BEFORE
        v = np.array(outline(-0.5, -1, -0.36, -1, 0, -0.2, 0.36, -1, 0.5, -1, 0.12, 0.3, -0.12, 0.3)) * (wide, deep)
        foot = turned(outline(0.25 * wide, -0.012, 0.42 * wide, 0.0, 0.42 * wide, 0.006), n)
        cap = cylinder(0.4 * wide, tall - 0.003, tall + 0.006, n), _ball_at(0.2 * wide, tall + 0.01, t.style)
        t.add(CASE, extrude(v, 0.0, tall), foot, *cap, of="handle")
        scale = box((0.3 * wide, 0.0015, 0.85 * tall), (0, -0.3 * deep, 0.5 * tall))
        t.add("gauge face", scale, front=front)
        glass = rod((0, -0.5 * deep, 0.004), (0, -0.5 * deep, tall - 0.004), 0.003, 8)
        t.add("gauge glass", glass, front=front)
        return t.model(kind=_KIND)


class Capillary(Gauge, name="thermometer/capillary", place="floor"):
    """A dial thermometer on a wall or board, a capillary from it to a bulb in a boss of an upright pipe."""

    size: float = among((0.06, 0.1, 0.16), "diameter of its case", "m")
    middle: float = between(1.1, 1.6, "height of the dial's middle", "m")
    board: Board = nested(Board, "what it is on")
    pipe: int = among((40, 50, 80, 100), "nominal size of the pipe", "mm")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda _: {"design": "plain"})
    out: float = between(0.45, 0.8, "from the dial to the pipe", "m")
    drop: float = between(0.2, 0.6, "from the dial down to the bulb", "m")

    def build(self, t: Table) -> Model:
        size, z, r, x, y = self.size, self.middle, PIPES[self.pipe].radius, self.out, -0.15
        tap, end = z - self.drop, x - r - 0.053
        self.board.build(t, 0.45, z - 0.25, z + 0.2)
        case = t.at(0, 0, z).along("-y")
        self.dial.build(case, size)
        case.add(CASE, cylinder(0.66 * size, 0.0, 0.004, t.n(size / 2)))
        case.add("bolt", bolt_circle(3, 0.59 * size, 0.005, -0.001, 0.004))
        t.at(x, y).add("pipe", cylinder(r, 0.0, z + 0.5, t.n(r)))
        boss = [cylinder(0.016, 0.9 * r, r + 0.02, 12), hexagon(0.026, r + 0.018, r + 0.04)]
        put(t.at(x, y, tap).along("-x"), _WELL, *boss, cylinder(0.007, r, r + 0.055, 10))
        way = [(0, -0.012, z - 0.48 * size), (0, -0.012, z - 0.75 * size), (0.05, -0.04, tap - 0.15)]
        way += [(0.6 * end, y, tap - 0.2), (end - 0.06, y, tap), (end, y, tap)]
        put(t, STEM, bent(way, 0.0025, t.style))
        return t.model(kind=_KIND)


class _Thermocouple(Params):
    """A thermocouple through a furnace wall."""

    out: float = between(0.12, 0.3, "length of the tube outside", "m")
    housing: Housing = nested(Housing, _ELECTRONICS, fixed=lambda _: {"shape": "pot"})
    level: float = between(0.6, 0.8, "its height / of the wall")

    def build(self, t: Table, r: float, deep: float) -> None:
        """Puts it down about z, its tube of a radius, through a wall below 0 [m]."""
        n, out = fine_sides(r, t.style), self.out
        oval = extrude(circle(2.0 * r, 12) * np.array([2.6, 1.0]), 0.0, 0.008)
        screw = along("x", hexagon(0.01, r, r + 0.02), 0, 0, 0.02)
        t.add(_WELL, cylinder(r, -deep - 0.1, out, n), cylinder(1.5 * r, 0.001, 0.03, n), oval, screw)
        put(t.at(0, 0, out - 0.004), _HEAD, self.housing.solid(t.style))
        t.add("bolt", *(moved(hexagon(0.012, 0.008, 0.014), at(s * 3.8 * r)) for s in (-1, 1)), own=False)


class Furnace(_Thermowell, name="thermowell/furnace", place="floor"):
    """Thermocouples in protection tubes through a furnace wall, held by sliding flanges (EN 50446), heads outside."""

    wide: float = between(0.5, 1.2, "width of the wall", "m")
    tall: float = between(1.2, 2.0, "height of the wall", "m")
    deep: float = between(0.15, 0.3, "thickness of the wall", "m")
    count: int = whole(1, 3, "thermocouples")
    radius: float = between(0.0075, 0.013, "of their tubes", "m")
    thermocouples: tuple[_Thermocouple, ...] = several(made(_Thermocouple), lambda p: p.count, "thermocouples")

    def build(self, t: Table) -> Model:
        wide, tall, deep = self.wide, self.tall, self.deep
        t.add("wall", box((wide, deep, tall), (0, deep / 2, tall / 2)))
        for k, one in enumerate(self.thermocouples):
            place = t.at((k - (self.count - 1) / 2) * 0.35 * wide, 0, one.level * tall)
            one.build(place.along("-y"), self.radius, deep)
        return t.model(kind=_SENSOR)


class Conduit(_Thermowell, name="thermowell/conduit"):
    """A thermowell with a nipple-union-nipple extension, an explosion-proof head and a conduit that runs off."""

    high: float = between(0.15, 0.24, "height of the head", "m")
    glanded: bool = chance(0.4, "a cable gland on its other side")
    gland: Gland = nested(Gland, "cable gland", when=lambda p: p.glanded)

    def build(self, t: Table) -> Model:
        high, z, mid = self.high, self.high + 0.05, 0.045 + 0.5 * (self.high - 0.045)
        well = [cylinder(0.013, 0, 0.02, 12), hexagon(0.034, 0.018, 0.045), _probe(0.03, 0.01, 12)]
        neck = [cylinder(0.0107, 0.04, high, 12), hexagon(0.04, mid - 0.01, mid + 0.015)]
        t.add(_WELL, *well, *neck, cylinder(0.017, mid - 0.022, mid + 0.026, 12))
        lid = turned(outline(0.046, 0.02, 0.048, 0.05, 0.04, 0.056), t.n(0.046))
        knobs = [box((0.012, 0.02, 0.012), (s * 0.025, 0, 0.06)) for s in (-1, 1)]
        head = [cylinder(0.02, high - 0.004, high + 0.02, 12), _ball_at(0.045, z, t.style)]
        head += [along("-y", solid, 0, 0, z) for solid in (lid, *knobs)]
        hub = cylinder(0.016, 0.03, 0.06, 12), hexagon(0.032, 0.058, 0.075)
        put(t, _HEAD, *head, *(along("x", solid, 0, 0, z) for solid in hub))
        way = [(0.07, 0, z), (0.16, 0, z), (0.25, 0, high), (0.25, 0.02, high + 0.3)]
        t.add("conduit", bent(way, 0.0107, t.style), of="electrical")
        if self.glanded:
            put(t.at(-0.042, 0, z).along("-x"), _HEAD, self.gland.solid(t.style))
        return t.model(kind=_SENSOR)


class Skin(Gauge, name="transmitter/skin", place="carrier", label=_HEAD, bundle=_HEAD, sizes=SIZES):
    """A skin sensor on a line: a band or hose clamp, a pad, a sheathed cable, a head on a stand-off (no welding)."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    wide: float = between(0.01, 0.025, "width of the band", "m")
    thick: float = between(0.001, 0.003, "thickness of the band", "m")
    headed: bool = chance(0.5, "a head on a stand-off, not a pad with a cable")
    rise: float = between(0.06, 0.14, "height of the head over the band", "m", when=lambda p: p.headed)
    housing: Housing = nested(Housing, _ELECTRONICS, when=lambda p: p.headed)
    turn: float = between(0, 6, _TURN, "rad", when=lambda p: p.headed)

    def build(self, t: Table) -> Model:
        r, wide, top = t.pipe.radius, self.wide, t.pipe.radius + self.thick
        band = along("x", ring(r, top, -wide / 2, wide / 2, t.n(r)))
        t.add("clamp", band, box((wide, 0.03, 0.014), (0, top + 0.012, 0)), own=True)
        t.at(0, top + 0.016).add("screw", cylinder(0.004, -0.018, 0.018, 8), hexagon(0.011, 0.015, 0.022))
        if self.headed:
            high = top + self.rise
            put(t, _WELL, cylinder(0.011, top - 0.001, high, 12), box((wide, 0.05, 0.006), (0, 0, top + 0.003)))
            t.at(0, 0, high - 0.003).spun("z", self.turn).add(_HEAD, self.housing.solid(t.style))
        else:
            pad = box((1.4 * wide, 0.02, 0.01), (0, 0, top + 0.005))
            t.add(_HEAD, pad, along("x", cylinder(0.004, 0.0, 0.05, 8), 0, 0, top + 0.006), of="trim")
            out = [(0.048, 0, top + 0.006), (0.09, 0, top + 0.01), (0.1, 0.03, top + 0.08), (0.08, 0.05, top + 0.2)]
            t.add(_HEAD, bent(out, 0.003, t.style), of="rubber")
        return t.model(kind=_SENSOR)


class CompactTemperature(Gauge, name="transmitter/compact temperature", label=_HEAD, bundle=_HEAD):
    """A compact sensor: a hexagon with a fitting for the stem, a bare stem, a plug (M12) and its cable."""

    tall: float = between(0.04, 0.12, "height of the plug", "m")
    radius: float = between(0.003, 0.005, "of the stem", "m")

    def build(self, t: Table) -> Model:
        z, n = self.tall, fine_sides(0.009, t.style)
        body = [cylinder(0.0095, 0, 0.02, n), hexagon(0.024, 0.016, 0.03), hexagon(0.02, 0.032, 0.044)]
        can = outline(0.008, z, 0.009, z + 0.01, 0.009, z + 0.05, 0.006, z + 0.06)
        t.add(_HEAD, *body, cylinder(self.radius, 0.02, z + 0.02, n), turned(can, n), of="trim")
        lead = rope([(0, 0, z + 0.08), (0, 0, z + 0.12), (0.03, 0, z + 0.16), (0.12, 0, z + 0.1)], 0.003, 8)
        t.add(_HEAD, cylinder(0.0085, z + 0.055, z + 0.085, n), lead, of="rubber")
        return t.model(kind=_SENSOR)


HEAT_BUILDS = families_of(
    Flanged, VanStone, Welded, Lagging, Test, Furnace, Conduit, Bimetal, VCase, Capillary, Skin, CompactTemperature
)
