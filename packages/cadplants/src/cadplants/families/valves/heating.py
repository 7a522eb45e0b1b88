"""Valves of heating and gas plants: rotary mixers, zone valves, gas blocks, distributors, cistern and bleed valves."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import number
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    standing,
)
from cadplants.families.valves.drive import Wheel
from cadplants.families.valves.parts import SMALL, bend, square, threaded_run
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import Solid, extrude, moved, tube
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["HEATING"]

_LONG = "length / radius of the pipe"


class Rotary(Valve, name="mixing valve/rotary", sizes=SMALL):
    """A rotary three- or four-way heating mixer: flat round chest, screwed cover, knob or servomotor."""

    long: float = between(5.2, 6.4, _LONG)
    three: bool = chance(0.6, "three ways, not four")
    tails: tuple[float, ...] = several(
        number(0.08, 0.3), lambda p: 1 if p.three else 2, "lengths of the pipes across", "m"
    )
    knob: bool = chance(0.5, "a knob on a scale rather than a servomotor")
    turn: float = between(0, 6, "where the knob points", "rad", when=lambda p: p.knob)
    width: float = between(0.07, 0.09, "of the servomotor", "m", when=lambda p: not p.knob)
    height: float = between(0.08, 0.13, "of the servomotor", "m", when=lambda p: not p.knob)
    depth: float = between(0.06, 0.09, "of the servomotor", "m", when=lambda p: not p.knob)

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.025
        mid, w, deep, ways = t.at(length / 2), 1.9 * r + 0.006, 1.25 * r + 0.004, ("-z", "z")[: len(self.tails)]
        n, inner = t.n(w), 0.85 * r if t.style.hollow else 0.0
        run = threaded_run(t, length, (1.15 * r, 0.12), (1.15 * r, 0.88), end=0.16)
        solids = [run, along("y", cylinder(w, -deep, deep, n), length / 2)]
        for way in ways:
            stub = cylinder(1.15 * r, 0.5 * w, 0.45 * length, n), hexagon(2.4 * r + 0.006, 0.36 * length, 0.5 * length)
            solids += [along(way, solid, length / 2) for solid in stub]
        t.add("valve body", *solids)
        for way, long in zip(ways, self.tails, strict=True):
            mid.along(way).add("pipe", ring(inner, r, 0.5 * length - 0.001, 0.5 * length + long, n))
        head = mid.spun("x", np.pi / 2).at(0, 0, deep)
        head.add("valve bonnet", cylinder(0.95 * w, 0, 0.006, n))
        head.add("bolt", around(cylinder(0.004, 0.0055, 0.010, 6), 4, 0.8 * w, 0.785))
        head.add("valve stem", cylinder(0.005, 0.002, 0.03, 8))
        head = head.at(0, 0, 0.006)
        if self.knob:
            head.add("position indicator", cylinder(0.8 * w, -0.0005, 0.002, n), of="dial")
            grip = turned(outline(0.5 * w, 0.002, 0.45 * w, 0.02, 0.35 * w, 0.024), max(8, n))
            tip = box((0.9 * w, 0.22 * w, 0.012), (0.45 * w, 0, 0.012))
            head.spun("z", self.turn).add("lever", grip, tip, turns=Turning("lever"))
        else:
            wide, high, top, motor = self.width, self.height, 0.012 + self.depth, head.bundled("actuator")
            case = moved(extrude(rounded_rectangle(wide, high, 0.008, 3), 0.012, top), at(0, 0.15 * high))
            motor.add("actuator", case, cylinder(0.018, -0.001, 0.013, 12), of="rubber", own=True)
            dial = [cylinder(0.016, top - 0.001, top + 0.014, 12), box((0.03, 0.006, 0.006), (0, 0, top + 0.016))]
            motor.add("position indicator", *dial, of="handle", own=True)
        return t.model(round(length, 6), "welded", "mixing valve")


class Zone(Valve, name="control valve/zone", sizes=sizes_between(15, 32)):
    """A motorised zone valve: brass body with wrench ends, a motor box with a manual lever, a cable."""

    long: float = between(4.8, 6.2, _LONG)
    width: float = between(0.08, 0.11, "of the motor's box, along the pipe", "m")
    depth: float = between(0.06, 0.075, "of the motor's box, across the pipe", "m")
    height: float = between(0.045, 0.085, "of the motor's box", "m")
    shift: float = between(-0.1, 0.1, "of the box along the pipe / its width")
    can: bool = chance(0.5, "the motor stands out aside")
    cabled: bool = chance(0.7, "a cable leads away")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.03
        x, wide, n = length / 2, 1.45 * r + 0.003, t.n(1.4 * r)
        marks = ((1.1 * r, 0.14), (wide, 0.34), (wide, 0.66), (1.1 * r, 0.86))
        run = threaded_run(t, length, *marks)
        low, w, d, h = 1.35 * wide, self.width, self.depth, self.height
        t.add("valve body", run, moved(cylinder(0.8 * wide, 0.0, low, n), at(x)))
        up = t.at(x, 0, low)
        up.add("valve bonnet", box((0.07, 0.062, 0.002), (0, 0, 0.001)))
        motor = up.bundled("actuator")
        case = extrude(rounded_rectangle(w, d, 0.006, 3), 0.002, 0.002 + h)
        motor.at(self.shift * w).add("actuator", case, of="clamp", own=True)
        if self.can:
            can = cylinder(0.024, 0.0, d / 2 + 0.02, t.n(0.024))
            motor.at(0, 0, 0.5 * h).along("y").add("actuator", can, of="trim", own=True)
        slot = box((0.004, 0.02, 0.006), (0.62 * w, 0, 0.3 * h)), box((0.3 * w, 0.006, 0.004), (0.5 * w, 0, 0.3 * h))
        up.add("lever", *slot)
        if self.cabled:
            far, z = (self.shift - 0.5) * w - 0.05, 0.5 * h
            cable = bend([(far + 0.06, 0, z), (far, 0, z), (far, 0, z + 0.25)], 0.03)
            up.add("cable", tube(cable, 0.004, 0.0, 8))
        up.add("valve stem", cylinder(0.005, -0.004, 0.004, 8))
        return t.model(round(length, 6), "welded", "control valve")


class _Coil(Params):
    """A solenoid's coil, upright."""

    tall: float = between(2.0, 3.2, "height / size of the coils")
    angular: bool = chance(0.5, "square rather than round")

    def solids(self, t: Table, size: float) -> list[Solid]:
        """The coil on z = 0, with its plug."""
        high = self.tall * size
        if self.angular:
            coil = [square(0.95 * size, 0, high)]
        else:
            nut = cylinder(0.6 * size, high - 0.001, high + 0.2 * size, 12)
            coil = [cylinder(0.95 * size, 0, high, t.n(size)), nut]
        return [*coil, box((0.5 * size, 1.0 * size, 0.7 * size), (0, 1.3 * size, 0.5 * high))]


class GasBlock(Valve, name="solenoid valve/gas block", sizes=SMALL):
    """A gas valve block of a burner train (EN 161): square end plates, a cast block, coils, a governor."""

    long: float = between(6.0, 8.0, _LONG)
    first: _Coil = nested(_Coil, "coil of the first valve")
    governed: bool = chance(0.5, "a governor in place of the second coil")
    second: _Coil = nested(_Coil, "coil of the second valve", when=lambda p: not p.governed)
    nipples: int = whole(2, 3, "test nipples")
    switch: bool = chance(0.6, "a pressure switch")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        half, plate, length = 1.7 * r + 0.012, 0.010 + 0.05 * r, round(self.long * r + 0.09, 6)
        bore, tall, size = 0.9 * r if t.style.hollow else 0.0, 1.9 * half, 0.03 + 0.35 * r
        ends = [along("x", square(half, z, z + plate, bore, t.style)) for z in (0.0, length - plate)]
        core = box((length - 2 * plate + 0.002, 1.5 * half, tall), (length / 2, 0, 0.1 * half))
        t.add("valve body", *ends, core)
        up = t.at(0, 0, 0.1 * half + tall / 2)
        for x, coil in ((0.3, self.first), (0.7, self.second)):
            if coil:
                head = up.at(x * length).bundled("actuator")
                head.add("actuator", *coil.solids(t, size), of="rubber", own=True)
        if self.governed:
            marks = ((1.3, 0.3), (1.3, 0.5), (0.5, 0.9), (0.45, 3), (0.3, 3.2))
            pan = turned([(0.6 * size, -0.001), *((a * size, z * size) for a, z in marks)], t.n(size))
            up.at(0.7 * length).add("valve bonnet", pan)
        for f in np.linspace(0.25, 0.75, self.nipples):
            face = t.at(float(f) * length, 0, -0.3 * half).along("-y").at(0, 0, 0.75 * half)
            face.add("gland", hexagon(0.016, -0.01 * half, 0.008), cylinder(0.0045, 0, 0.018, 8))
        if self.switch:
            spot = (length / 2, 0.75 * half + 0.022, -0.2 * half)
            t.add("transmitter", box((0.05, 0.045, 0.06), spot), of="electrical")
        return t.model(length, "welded", "solenoid valve")


class Distributor(Valve, name="control valve/distributor", place="floor", sizes=SMALL, weight=0.6):
    """A floor-heating distributor: a bar on brackets at a wall, valves with caps or thermal heads, loops."""

    count: int = whole(3, 7, "loops")
    high: float = between(0.5, 0.9, "height of the lower bar", "m")
    bar: float = among((0.0167, 0.021), "radius of the bar", "m")
    heads: str = among(("thermal", "slim", "hand"), "heads of the valves")
    upper: bool = among((False, True), "the bar is the upper one of two")
    lead: float = between(0.1, 0.3, "length of the pipe that leads to it", "m")

    def build(self, t: Table) -> Model:
        r, wide, n = self.bar, self.count * 0.05 + 0.06, t.n(0.02)
        z, hollow = self.high + 0.2 * self.upper, float(t.style.hollow)
        t.add("wall", box((wide + 0.4, 0.1, self.high + 0.5), (wide / 2, 0.11, (self.high + 0.5) / 2)))
        bar, solids = t.at(0, 0, z), [along("x", cylinder(r, 0.0, wide, n))]
        spots = [0.055 + k * 0.05 for k in range(self.count)]
        for x in spots:
            stub = cylinder(0.011, -r - 0.03, 0.0, 10), hexagon(0.026, -r - 0.045, -r - 0.022)
            solids += [moved(solid, at(x)) for solid in (*stub, hexagon(0.024, 0.6 * r, r + 0.014))]
            t.at(x).add("pipe", tube(np.array([[0, 0, z - r - 0.04], [0, 0, 0.0]]), 0.008, 0.006 * hollow, 8))
        bar.add("valve body", *solids)
        if self.heads == "hand":
            name, shape = "handwheel", outline(0.016, 0.013, 0.016, 0.028, 0.010, 0.031)
        elif self.upper:
            name, shape = "actuator", outline(0.013, 0.013, 0.019, 0.02, 0.019, 0.05, 0.015, 0.06)
        else:
            name, shape = "valve bonnet", outline(0.009, 0.013, 0.008, 0.06, 0.004, 0.064)
        bundled = bar.bundled("actuator") if name == "actuator" else bar
        for x in spots:
            turning = Turning("handwheel") if name == "handwheel" else None
            bundled.at(x, 0, r).add(name, turned(shape, 12), of="dial", own=turning is None, turns=turning)
        bar.along("-x").add("valve body", hexagon(2.4 * r, -0.001, 0.03), cylinder(1.0 * r, 0.0, 0.034, n))
        key = box((0.012, 0.012, 0.03), (-0.017, 0, 0.012)), box((0.07, 0.016, 0.006), (-0.04, 0, 0.028))
        bar.at(0, 0, r).add("lever", *key, turns=Turning("lever", point=(-0.017, 0.0, 0.0)))
        lead = np.array([[-0.033, 0, 0], [-0.033 - self.lead, 0, 0]])
        bar.add("pipe", tube(lead, 0.9 * r, 0.8 * r * hollow, n))
        for x in (0.02, wide - 0.02):
            rail = box((0.02, 0.004, 0.16), (x, 0.058, 0)), box((0.02, 0.058, 0.006), (x, 0.029, -r - 0.0028))
            bar.add("bracket", *rail, of="clamp")
        return standing(t, "control valve")


class Cistern(Valve, name="float valve/cistern", place="floor", sizes=SMALL):
    """A cistern with a float valve (BS 1212): shank through its wall, arm and ball inside, supply pipe outside."""

    width: float = between(0.5, 0.9, "of the cistern", "m")
    depth: float = between(0.35, 0.6, "of the cistern", "m")
    height: float = between(0.35, 0.6, "of the cistern", "m")
    base: float = among((0.0, 0.3, 0.8), "height of its legs", "m")
    shank: float = among((0.0107, 0.0134), "radius of the shank", "m")
    long: float = between(0.2, 0.35, "length of the arm, where the cistern has room", "m")
    tilt: float = between(0.1, 0.5, "of the arm, downwards", "rad")
    size: float = between(0.045, 0.06, "radius of the float", "m")
    squat: float = among((1.0, 1.0, 0.7), "height of the float / its width")

    def build(self, t: Table) -> Model:
        wide, deep, tall, base, wall, r, n = (
            self.width,
            self.depth,
            self.height,
            self.base,
            0.006,
            self.shank,
            t.n(0.02),
        )
        high = base + tall / 2
        sides = [box((wall, deep, tall), (s * (wide - wall) / 2, 0, high)) for s in BOTH]
        sides += [box((wide, wall, tall), (0, s * (deep - wall) / 2, high)) for s in BOTH]
        t.add("tank", box((wide, deep, wall), (0, 0, base + wall / 2)), *sides)
        if base:
            corners = [(a * (wide / 2 - 0.04), b * (deep / 2 - 0.04)) for a in BOTH for b in BOTH]
            t.add("tank leg", *(box((0.04, 0.04, base), (x, y, base / 2)) for x, y in corners))
        inlet = t.at(-wide / 2, 0, base + tall - 0.07)
        nose = turned(outline(1.1 * r, 0.045, 1.5 * r, 0.06, 1.5 * r, 0.09, 0.9 * r, 0.1), n)
        spout = along("-z", cylinder(0.8 * r, 0.0, 3 * r, 10), 0.075)
        ears = [box((0.03, 0.003, 0.03), (0.108, s * 0.007, 0.004)) for s in BOTH]
        inlet.add("valve body", along("x", cylinder(r, -0.04, 0.05, n)), along("x", nose), spout, *ears)
        nuts = [hexagon(2.9 * r, low, low + 0.008) for low in (-0.008, wall)]
        inlet.along("x").add("nut", *nuts, fine=False, own=True)
        hinge = inlet.at(0.115, 0, 0.006)
        hinge.along("y").add("valve stem", cylinder(0.0025, -0.012, 0.012, 8))
        arm, long = hinge.spun("y", self.tilt), min(self.long, wide - 0.32)
        arm.add("lever", rod((-0.02, 0, 0), (long, 0, 0), 0.0035, 8), of="trim")
        arm.at(long + 0.9 * self.size).add("lever", ball(self.size, t.n(self.size), self.squat))
        inlet.along("-x").add("union", hexagon(2.7 * r, 0.028, 0.048))
        path = bend([(-0.03, 0, 0), (-0.1, 0, 0), (-0.1, 0, 0.07 - base - tall)], 0.03)
        inlet.add("pipe", tube(path, 0.9 * r, 0.75 * r if t.style.hollow else 0.0, n))
        return standing(t, "float valve")


class Bleed(Valve, name="bleed valve/hexagon", place="tap"):
    """A bleed valve on an outlet: one hexagon, a screw down its top with a T or wing, a barbed tube aside."""

    thread: float = between(0.007, 0.012, "radius of its thread", "m")
    tall: float = between(3.0, 5.0, "height of the hexagon / radius of the thread")
    lean: float = among((0.0, 0.0, 0.35), "of the tube downwards", "rad")
    neck: float = between(0.3, 1.2, "height of the nut / radius of the thread")
    nut: bool = chance(0.5, "a nut round the screw")
    top: str = among(("bar", "wing", "wheel"), "what turns the screw")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.top == "wheel")

    def build(self, t: Table) -> Model:
        r, low, tall, neck = self.thread, 0.012, self.tall * self.thread, self.neck * self.thread
        marks = ((0.4, 0.9), (0.4, 2.2), (0.55, 2.3), (0.4, 3.0), (0.55, 3.1), (0.35, 3.9))
        barb = along("x", turned([(a * r, x * r) for a, x in marks], 10))
        barb = moved(barb, at(0, 0, low + 0.6 * tall) @ spun("y", self.lean))
        t.add("valve body", cylinder(0.85 * r, 0.0, 0.014, 12), hexagon(2.4 * r, low, low + tall), barb)
        up = t.at(0, 0, low + tall)
        if self.nut:
            up.add("valve bonnet", hexagon(1.9 * r, -0.001, neck), cylinder(0.7 * r, 0, neck + 0.4 * r, 12))
            neck += 0.4 * r
        up.add("valve stem", cylinder(0.4 * r, -0.001, neck + 1.2 * r, 8))
        up = up.at(0, 0, neck + 0.9 * r)
        if self.top == "bar":
            up.add("lever", along("x", cylinder(0.25 * r, -2.2 * r, 2.2 * r, 8)), turns=Turning("lever"))
        elif self.top == "wing":
            wings = [box((1.6 * r, 0.3 * r, 1.2 * r), (s * 1.2 * r, 0, 0.3 * r)) for s in BOTH]
            up.add("lever", cylinder(0.7 * r, -0.4 * r, 0.6 * r, 10), *wings, turns=Turning("lever"))
        else:
            self.wheel.build(up, 0.014 + 1.3 * r)
        return t.model(kind="bleed valve")


HEATING = families_of(Rotary, Zone, GasBlock, Distributor, Cistern, Bleed)
