"""Flow meters with registers and counters, and small plastic and brass ones."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, Housing
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.flow import NAME, FlowMeter, measuring_tube
from cadplants.families.instruments.pieces import BEFORE, FRONT, bent, put
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES, PIPES, sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, ring, turned
from cadplants.solids.transforms import at, looking, spun

__all__ = ["COUNTER_BUILDS"]

_SMALL = sizes_between(most=50)
_CAST, _METAL = ("valve", "gauge", "pump"), "kind of material"


class _Counter(Params):
    """A round register about z from 0 up: a case, a window of figures, maybe an open lid."""

    tall: float = between(0.5, 1.1, "height / radius")
    lid: bool = chance(0.4, "an open lid")
    lean: float = between(0.8, 1.7, "how far the lid is open", "rad", when=lambda p: p.lid)
    metal: str = among(("handle", "valve", "electrical"), _METAL)

    def build(self, t: Table, r: float) -> None:
        """Puts it down, of a radius [m]."""
        n, tall, t = t.n(r), self.tall * r, t.bundled(CASE)
        case = [turned(outline(0.9 * r, 0.0, r, 0.1 * tall, r, 0.9 * tall, 0.92 * r, tall), n)]
        if self.lid:
            pose = at(0, 0.95 * r, tall) @ spun("x", self.lean) @ at(0, r)
            case += [moved(cylinder(r, 0.0, 0.06 * r, n), pose)]
            case += [along("x", cylinder(0.06 * r, -0.3 * r, 0.3 * r, 8), 0, r, tall)]
        t.add(CASE, *case, of=self.metal)
        figures = box((0.8 * r, 0.2 * r, 0.002), (0, 0.3 * r, tall + 0.0015))
        t.add("gauge face", cylinder(0.85 * r, tall - 0.0005, tall + 0.001, n), figures, front=FRONT)


class ClearTube(FlowMeter, name="flow meter/clear tube", sizes=_SMALL):
    """A variable-area meter of clear plastic: a cone or drilled block between union nuts, a scale, a float, stops."""

    long: float = between(5, 9, "its length over 0.16 m / radius of the pipe")
    cone: bool = chance(0.5, "a cone, not a block")
    level: float = between(0.35, 0.65, "place of its float / length")

    def build(self, t: Table) -> Model:
        radius, line = t.pipe.radius, t.along("x")
        length, r, n = round(0.16 + self.long * radius, 6), 1.5 * radius + 0.004, t.n(1.5 * radius)
        low, high, place = 0.2 * length, 0.8 * length, self.level * length
        ends = [hex_end(self.dn, a * length, b * length, t.style, 8) for a, b in ((0, 0.1), (0.9, 1))]
        grip = around(box((0.2 * r, 0.3 * r, 0.1 * length), (0, 0, 0.15 * length)), 10, 1.42 * r)
        bore = bore_of(self.dn, t.style)
        nut = along("x", merge([ring(bore, 1.45 * r, 0.09 * length, low, n), grip]))
        t.add(NAME, *ends, nut, moved(nut, at(length) @ spun("z", np.pi)), of="rubber")
        if self.cone:
            clear = turned(outline(0.95 * r, low - 0.002, 1.25 * r, high + 0.002), n, bore=0.8 * r if bore else 0.0)
        else:
            block, holes = rounded_rectangle(2.6 * r, 2.2 * r, 0.15 * r, 2), (circle(0.8 * r, n),) if bore else ()
            clear = extrude(block, low - 0.002, high + 0.002, holes)
        line.add("gauge glass", clear)
        # A rod guides the float from end to end.
        bob = turned(outline(0.1 * r, place - 0.4 * r, 0.7 * r, place, 0.7 * r, place + 0.2 * r), 12)
        line.add("gauge needle", bob, cylinder(0.08 * r, 0.1 * length, 0.9 * length, 8), of="trim")
        ticks = [box((0.002, 0.5 * r, 0.001), (x * length, 0, 1.31 * r)) for x in np.linspace(0.28, 0.72, 9)]
        t.add("gauge face", box((0.5 * length, 0.6 * r, 0.01), (length / 2, 0, 1.255 * r)), *ticks, front=FRONT)
        return t.model(length, "welded", NAME)


class PaddleWheel(FlowMeter, name="flow meter/paddle wheel", sizes=_SMALL):
    """A paddle-wheel sensor in a plastic tee or on a saddle: a union nut on a neck, a body, a display or plug."""

    neck: float = between(0.03, 0.06, "height of the neck over 1.3 radii of the pipe", "m")
    tall: float = between(0.03, 0.09, "height of the body over the neck", "m")
    headed: bool = chance(0.5, "electronics on it, not a cable")
    shape: str = among(("slant", "rectangle", "pot"), "how they are made", when=lambda p: p.headed, otherwise="")
    housing: Housing = nested(Housing, "electronics", fixed=lambda p: {"shape": p.shape}, when=lambda p: p.headed)

    def build(self, t: Table) -> Model:
        radius, bore = t.pipe.radius, bore_of(self.dn, t.style)
        length, n = round(0.09 + 4.2 * radius, 6), t.n(radius)
        r, rise, middle = 0.014 + 0.25 * radius, 1.3 * radius + self.neck, t.at(length / 2)
        top = rise + self.tall
        steps = ((1.3, 0.0, 0.28), (1.15, 0.25, 0.75), (1.3, 0.72, 1.0))
        ends = [along("x", ring(bore, q * radius, a * length, b * length, n), -length / 2) for q, a, b in steps]
        middle.add(NAME, *ends, cylinder(1.1 * r, 0.5 * radius, rise, 16), of="electrical")
        grip = around(box((0.15 * r, 0.3 * r, 0.022), (0, 0, rise - 0.006)), 10, 1.7 * r)
        middle.add(NAME, cylinder(1.7 * r, rise - 0.018, rise + 0.006, 18), grip, of="rubber")
        if self.headed:
            head = moved(self.housing.solid(t.style), at(0, 0, top - 0.003))
        else:
            way = [(0, 0, top - 0.002), (0, 0, top + 0.06), (0.04, 0, top + 0.1), (0.14, 0, top + 0.02)]
            head = bent(way, 0.0035, t.style)
        put(middle, "transmitter", cylinder(0.95 * r, rise, top, 16), head, of="safety")
        return t.model(length, "welded", NAME)


class Woltman(FlowMeter, name="flow meter/woltman", sizes=sizes_between(40)):
    """A Woltman water meter (EN ISO 4064): a cast body with a bolted insert and its register."""

    long: float = between(0.8, 1.6, "its length over 0.2 m / diameter of the pipe")
    metal: str = among(_CAST, _METAL)
    bolts: int = among((4, 6, 8), "of the insert")
    counter: _Counter = nested(_Counter, "register")

    def build(self, t: Table) -> Model:
        radius, neck = t.pipe.radius, 0.485 * t.flange.hub
        length = round(0.2 + self.long * t.pipe.outer, 6)
        wide, r, top = 1.08 * neck, 0.045 + 0.5 * radius, 1.2 * neck + 0.015
        middle = outline(neck, 0.3 * length, wide, 0.4 * length, wide, 0.6 * length, neck, 0.7 * length)
        n, up = t.n(r), t.at(length / 2)
        chest = merge([cylinder(0.85 * r, 0.3 * radius, top, n), cylinder(1.25 * r, top - 0.012, top, n)])
        body = measuring_tube(self.dn, t.style, length, middle)
        t.add(NAME, body, moved(chest, at(length / 2)), of=self.metal)
        up.add(NAME, cylinder(1.25 * r, top + 0.001, top + 0.012, n), of="valve")
        up.add("bolt", bolt_circle(self.bolts, 1.1 * r, 0.01, top - 0.012, top + 0.012))
        self.counter.build(up.at(0, 0, top + 0.012), 0.8 * r)
        return t.model(length, kind=NAME)


class Displacement(FlowMeter, name="flow meter/displacement", sizes=sizes_between(most=150)):
    """A displacement meter (piston, vane, oval gear): a round or oval chamber with bolted covers, a counter on it."""

    upright: bool = chance(0.5, "its chamber stands upright")
    disc: bool = chance(0.5, "its chamber is round, not oval")
    bolts: int = among((6, 8, 10), "of the cover")
    metal: str = among(_CAST, _METAL)
    printer: bool = chance(0.5, "a tall counter with a reset knob and a ticket printer")
    tall: float = between(0.1, 0.16, "height of that counter", "m", when=lambda p: p.printer)
    counter: _Counter = nested(_Counter, "register", when=lambda p: not p.printer)

    def build(self, t: Table) -> Model:
        radius, axis = t.pipe.radius, "z" if self.upright else "-y"
        length, r, half = round(0.16 + 4.0 * radius, 6), 0.05 + 1.4 * radius, 0.03 + 1.1 * radius
        n, line, oval = t.n(r), t.at(length / 2).along(axis), np.diag([1.0, 1.0 if self.disc else 0.75, 1.0, 1.0])
        drum = turned(outline(0.9 * r, -half, r, -0.9 * half, r, 0.9 * half, 0.9 * r, half), n)
        chamber = merge([drum, cylinder(1.12 * r, half - 0.014, half + 0.012, n)])
        body = measuring_tube(self.dn, t.style, length)
        t.add(NAME, body, along(axis, moved(chamber, oval), length / 2), of=self.metal)
        line.add("bolt", moved(bolt_circle(self.bolts, 1.05 * r, 0.01, half - 0.014, half + 0.012), oval))
        line.add(NAME, cylinder(0.3 * r, half, half + 0.03, 14))
        top = line.at(0, 0, half + 0.029)
        if self.printer:
            self._printer(top.bundled(CASE), 0.14 + 0.3 * radius)
        else:
            self.counter.build(top, 0.6 * r)
        return t.model(length, kind=NAME)

    def _printer(self, t: Table, wide: float) -> None:
        tall = self.tall
        crate = extrude(rounded_rectangle(wide, 0.8 * wide, 0.1 * wide, 3), 0.0, tall)
        knob = along("x", cylinder(0.018, 0.0, 0.04, 12), 0.49 * wide, 0, 0.5 * tall)
        t.add(CASE, crate, knob, of="valve")
        panes, front = box((0.7 * wide, 0.004, 0.3 * tall), (0, -0.4 * wide - 0.002, 0.65 * tall)), BEFORE
        if not self.upright:
            panes, front = box((0.7 * wide, 0.25 * wide, 0.004), (0, 0.1 * wide, tall + 0.002)), FRONT
        t.add("gauge face", panes, front=front)


class RotaryGas(FlowMeter, name="flow meter/rotary gas", sizes=sizes_between(25, 150)):
    """A rotary gas meter (EN 12480): a ribbed body of two lobes across the line, gear covers, a counter at one end."""

    ribbed: bool = chance(0.6, "ribs round its lobes")
    counter: _Counter = nested(_Counter, "register")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r, half = round(0.15 + 2.2 * radius, 6), 0.04 + 0.9 * radius, 0.07 + 1.4 * radius
        n, head = t.n(r), t.at(length / 2).along("-y")
        solids = [moved(cylinder(r, -half, half, n), at(0, s * 0.55 * r)) for s in (-1, 1)]
        if self.ribbed:
            heights = np.linspace(-0.8, 0.8, 5) * half
            ribs = merge([cylinder(1.08 * r, z - 0.003, z + 0.003, n) for z in heights])
            solids += [moved(ribs, at(0, s * 0.55 * r)) for s in (-1, 1)]
        cover = rounded_rectangle(1.9 * r, 3.0 * r, 0.9 * r, 5)
        solids += [extrude(cover, z, z + 0.03) for z in (-half - 0.029, half - 0.001)]
        plate = disc_flange(self.dn, t.style, 0.5 * length, bore_of(self.dn, t.style))
        plates = along("x", plate), along("-x", plate, length)
        t.add(NAME, *plates, along("-y", merge(solids), length / 2))
        head.add(NAME, cylinder(0.4 * r, half + 0.028, half + 0.05, 14))
        self.counter.build(head.at(0, 0, half + 0.049), 0.6 * r)
        return t.model(length, kind=NAME)


class DiaphragmGas(FlowMeter, name="flow meter/diaphragm gas", place="floor", sizes=(15,)):
    """A diaphragm gas meter (EN 1359): a two-part sheet case on a stand with two connections on its top, a counter."""

    wide: float = between(0.22, 0.4, "width of its case", "m")
    deep: float = between(0.16, 0.28, "depth of its case", "m")
    tall: float = between(0.22, 0.38, "height of its case", "m")
    mouth: int = among((25, 32, 40, 50), "nominal size of its connections", "mm")
    low: float = between(0.5, 1.1, "height of its stand", "m")

    def build(self, t: Table) -> Model:
        wide, deep, tall, low = self.wide, self.deep, self.tall, self.low
        r, z, pipe = 0.2 * deep, low + tall, PIPES[self.mouth].radius
        case = [
            extrude(rounded_rectangle(a * wide, b * deep, c * r, 4), low + d * tall, low + e * tall)
            for a, b, c, d, e in ((1, 1, 1, 0, 0.62), (0.97, 0.95, 1, 0.62, 1), (1.05, 1.07, 1.05, 0.61, 0.63))
        ]
        t.add(NAME, *case, of="electrical")
        apart, ports = max(0.3 * wide, 0.5 * FLANGES[self.mouth].outer + 0.008), []
        for x in (-apart, apart):
            ports.append(Port(looking((x, 0, z + 0.11), (0, 0, 1)), self.mouth, len(t.parts)))
            stub = [cylinder(1.2 * pipe, z - 0.01, z + 0.05, 16), hexagon(3.0 * pipe, z + 0.01, z + 0.035)]
            t.at(x).add(NAME, *stub, along("-z", disc_flange(self.mouth, t.style, 0.07), 0, 0, z + 0.11), of="trim")
        y, high, case_ = -0.47 * deep, low + 0.82 * tall, t.bundled(CASE)
        case_.add(CASE, box((0.35 * wide, 0.03, 0.16 * tall), (0, y - 0.01, high)), of="rubber")
        case_.add("gauge face", box((0.28 * wide, 0.002, 0.06 * tall), (0, y - 0.026, high)), front=BEFORE)
        t.add("plate", box((1.1 * wide, 1.1 * deep, 0.005), (0, 0, low - 0.0025)))
        leg = low - 0.005
        for x in (-0.5, 0.5):
            for y in (-0.48, 0.48):
                t.add("post", box((0.03, 0.03, leg), (x * wide, y * deep, leg / 2)))
        return t.model(kind=NAME, ports=ports)


class HeatMeter(FlowMeter, name="flow meter/heat", sizes=_SMALL):
    """A heat meter (EN 1434): a small brass body with union ends, its calculator on top or aslant, sensor cables."""

    wide: float = between(0.075, 0.12, "width of the calculator", "m")
    deep: float = between(0.05, 0.09, "depth of the calculator", "m")
    tall: float = between(0.03, 0.05, "height of the calculator", "m")
    lean: float = among((0.0, 0.6), "of the calculator", "rad")

    def build(self, t: Table) -> Model:
        radius, wide, deep, tall = t.pipe.radius, self.wide, self.deep, self.tall
        length, x, z = round(0.1 + 2.2 * radius, 6), 0.05 + 1.1 * radius, 0.8 * radius + 0.02
        ends = [hex_end(self.dn, a * length, b * length, t.style) for a, b in ((0, 0.16), (0.84, 1))]
        tube = along("x", cylinder(0.95 * radius, 0.1 * length, 0.9 * length, t.n(radius)))
        t.add(NAME, *ends, tube, box((0.04, 0.03, z), (x, 0, z / 2)), of="trim")
        head = t.bundled("transmitter").at(x, 0, z + 0.01).spun("x", self.lean).at(0, 0, -0.012)
        solids = [extrude(rounded_rectangle(wide, deep, 0.2 * deep, 4), 0.0, tall)]
        solids.append(moved(cylinder(0.006, tall - 0.001, tall + 0.003, 10), at(0, -0.25 * deep)))
        for s in (-1, 1):
            near = [(s * 0.25 * wide, y * deep, 0.3 * tall) for y in (-0.45, -0.8)]
            solids.append(bent([*near, (s * 0.8 * wide, -0.9 * deep, -0.02)], 0.002, t.style))
        head.add("transmitter", *solids, of="electrical")
        head.add("gauge glass", box((0.6 * wide, 0.35 * deep, 0.002), (0, 0.12 * deep, tall + 0.001)), front=FRONT)
        return t.model(length, "welded", NAME)


class PickUp(FlowMeter, name="flow meter/pick-up"):
    """A turbine meter for liquids: a slim tube with a pick-up boss and hexagon, a plug, a small display or a head."""

    long: float = between(2.0, 3.5, "its length over 0.1 m / diameter of the pipe")
    spot: float = between(0.45, 0.55, "where the pick-up is / length")
    rise: float = between(0.03, 0.07, "height of the pick-up over the tube", "m")
    headed: bool = chance(0.5, "electronics on it, not a cable")
    housing: Housing = nested(Housing, "electronics", when=lambda p: p.headed)

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, top = round(0.1 + self.long * t.pipe.outer, 6), radius + self.rise
        t.add(NAME, measuring_tube(self.dn, t.style, length))
        t = t.at(self.spot * length)
        boss = [cylinder(0.016, 0.7 * radius, radius + 0.015, 14), hexagon(0.026, radius + 0.012, top)]
        t.add(NAME, *boss, cylinder(0.01, top - 0.002, top + 0.02, 12), of="trim")
        if self.headed:
            head: list[Solid] = [moved(self.housing.solid(t.style), at(0, 0, top + 0.017))]
        else:
            way = [(0, 0, top + 0.048), (0, 0, top + 0.09), (0, -0.1, top + 0.1), (0, -0.16, top)]
            head = [cylinder(0.013, top + 0.012, top + 0.05, 12), bent(way, 0.004, t.style)]
        put(t, "transmitter", *head, of="rubber")
        return t.model(length, kind=NAME)


COUNTER_BUILDS = families_of(ClearTube, PaddleWheel, Woltman, Displacement, RotaryGas, DiaphragmGas, HeatMeter, PickUp)
