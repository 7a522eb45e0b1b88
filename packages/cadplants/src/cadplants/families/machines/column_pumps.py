"""Pumps whose casing is more than a volute: with a chamber, a column, a canister, an open front."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    BASES,
    CASING,
    LYING,
    PUMP,
    Motor,
    Pump,
    Train,
    base,
    corners,
    dead_room,
    driven,
    mouth,
    volute,
)
from cadplants.families.valves.valve import disc_flange, flanged_body
from cadplants.model.family import Model, Port
from cadplants.model.standards import ELBOW_LONG_RADIUS, smaller
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import extrude, merge, moved, tube
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, looking, spun

__all__ = ["SPECIAL"]


class SelfPriming(Pump, name="pump/self-priming", sizes=(40, 50, 80, 100)):
    """A self-priming trash pump: a big chamber, suction high in front, discharge on top, a clean-out cover."""

    seat: float = between(0.06, 0.15, "height of the base frame", "m")
    tall: float = between(1.9, 2.3, "height of the chamber / size of the casing")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, s = self.dn, self.seat, 0.12 + 2.2 * t.pipe.radius
        w, h, axis = 1.5 * s, self.tall * s, seat + 0.85 * s
        tub = extrude(rounded_rectangle(w, w, 0.35 * s, 4), seat + 0.12 * s, seat + h)
        belly = along("x", volute(0.62 * s, 0.35 * s, t.style, 0.3), 0.5 * w + 0.05 * s, 0, axis)
        feet = [box((0.2 * s, w, 0.14 * s), (x * 0.5 * w, 0, seat + 0.07 * s)) for x in (-0.7, 0.7)]
        reach = dead_room(dn) + 0.05
        one, first = mouth(dn, t.style, (-w / 2 - reach, 0, seat + h - 0.3 * s - 0.02), (-1, 0, 0), reach + 0.1 * s)
        two, second = mouth(dn, t.style, (0.1 * w, 0, seat + h + reach), (0, 0, 1), reach + 0.05)
        t.add(CASING, tub, belly, *feet, one, two)
        front, z = -w / 2, seat + 0.62 * s
        lid = [cylinder(0.4 * s, 0, 0.1 * s, t.n(0.4 * s)), cylinder(0.3 * s, 0.1 * s, 0.16 * s, t.n(0.3 * s))]
        plug = merge([cylinder(0.16 * s, 0, 0.08 * s, 16), box((0.24 * s, 0.06 * s, 0.08 * s), (0, 0, 0.12 * s))])
        t.add(
            CASING, along("-x", merge(lid), front + 0.01, 0, z), moved(plug, at(-0.3 * w, 0.25 * w, seat + h - 0.005))
        )
        bars = [rod((front + 0.02, y * 0.44 * s, z), (front - 0.32 * s, y * 0.44 * s, z), 0.04 * s, 8) for y in BOTH]
        t.add("clamp", box((0.08 * s, 0.98 * s, 0.14 * s), (front - 0.18 * s, 0, z)), *bars, own=True)
        back = 0.5 * w + 0.38 * s
        start = back + 1.2 * s
        house = turned([(a * s, b * s) for a, b in outline(0.6, 0, 0.35, 0.2, 0.3, 0.9, 0.22, 0.95)], t.n(s))
        lying = t.at(0, 0, axis).along("x")
        lying.at(0, 0, back - 0.04 * s).add(CASING, house)
        lying.add("shaft", cylinder(0.1 * s, back, start, 12))
        far, seats = self.drive.build(t, start, axis, seat, min(0.8 * (axis - seat), 0.7 * s))
        base(t, self.bed, -0.55 * w, far, 1.7 * s, seat, [-0.35 * w, 0.35 * w, *seats])
        return t.model(ports=(first, second), kind="self-priming pump")


class Turbine(Pump, name="pump/vertical turbine", sizes=(80, 100, 125, 150, 200)):
    """A vertical turbine pump (API 610 VS1): bowls and column below a deck, discharge head and hollow-shaft motor."""

    deck: float = between(0.9, 1.8, "height of the deck", "m")
    bowls: int = whole(2, 5, "bowls")
    head: float = between(3.5, 5.0, "height of the discharge head, less 15 cm / radius of the pipe")
    motor_size: float = between(1.2, 1.7, "radius of the motor, less 4 cm / of the pipe")
    slender: float = between(2.2, 3.2, "length of the motor / its radius")
    frame: str = among(("cast", "drip", "ex"), "how the motor's frame is made")
    motor: Motor = driven(Motor, "motor")
    turn: float = between(0, 6, "which way the motor's terminal box looks", "rad")
    guarded: bool = chance(0.5, "a mesh round the head's windows")

    def build(self, t: Table) -> Model:
        dn, p, deck = self.dn, t.pipe.radius, self.deck
        n, half, z = t.n(p * 1.5), 0.25 + 2 * p, self.deck + 0.03
        high, m = self.head * p + 0.15, self.motor_size * p + 0.04
        head = outline(1.4 * p, z, 1.4 * p, z + 0.03, 1.15 * p, z + 0.03, 1.15 * p, z + 0.6 * high)
        face, level = 1.2 * p + dead_room(dn) + 0.06, z + max(0.35 * high, t.flange.outer / 2 + 0.04)
        out, port = mouth(dn, t.style, (face, 0, level), (1, 0, 0), face - 0.5 * p)
        windows = around(box((0.2 * p, 0.7 * p, 0.42 * high), (0, 0, z + 0.79 * high)), 4, 0.95 * p, np.pi / 4)
        t.add(CASING, turned(head, n), out, windows, cylinder(max(m, 1.2 * p), z + high - 0.025, z + high, n))
        side = 3.4 * p + 0.1
        t.add("pump base", box((side, side, 0.03), (0, 0, deck + 0.03 / 2)), own=False)
        low, step = 0.08, min(1.1 * p, (0.6 * deck) / self.bowls)
        bell = turned(outline(1.6 * p, low, 0.9 * p, low + 0.5 * step, 0.9 * p, low + 0.6 * step), n)
        bowl = [(a * p, b * step) for a, b in outline(0.95, 0, 1.45, 0.4, 1.45, 0.6, 0.95, 1)]
        lows = low + 0.6 * step + step * np.arange(self.bowls)
        t.add(CASING, bell, *(turned([(a, q + b) for a, b in bowl], n) for q in lows))
        top = low + (0.6 + self.bowls) * step
        rims = [cylinder(1.35 * p, q, q + 0.04, n) for q in (top, (top + deck) / 2, deck - 0.04)]
        t.add(CASING, cylinder(p, top - 0.005, deck, n), *rims, of="pipe")
        gland = turned(outline(0.5 * p, z + 0.6 * high, 0.5 * p, z + 0.66 * high, 0.3 * p, z + 0.72 * high), n)
        t.add("shaft", cylinder(0.14 * p, z + 0.5 * high, z + high, 10), gland)
        self.motor.build(t.at(0, 0, z + high).spun("z", self.turn), m, self.slender * m)
        for s in BOTH:
            t.add("beam", box((2 * half, 0.1, 0.12), (0, s * (1.5 * p + 0.05), deck - 0.06)))
        for x, y in corners(half - 0.05, 1.5 * p + 0.05):
            t.add("column", box((0.1, 0.1, deck - 0.12), (x, y, (deck - 0.12) / 2)))
        if self.guarded:
            mesh = ring(1.02 * p, 1.04 * p, z + 0.6 * high, z + high - 0.025, n)
            t.add("coupling guard", mesh, own=False)
        return t.model(ports=(port,), kind="vertical turbine pump")


class Magnetic(Pump, name="pump/magnetic drive", sizes=(20, 25, 32, 40, 50, 65)):
    """A magnetic drive or canned motor pump (API 685, ISO 15783): a plastic or cast front, a canister, no seal."""

    high: float = between(1.4, 1.8, "height of the shaft / radius of the casing")
    slender: float = between(2.2, 3.4, "length of the motor / radius of the casing")
    canned: bool = chance(0.4, "the motor is in a can of its own")
    motor: Motor = driven(Motor, "motor", when=lambda p: not p.canned)

    def build(self, t: Table) -> Model:
        dn, out, s = self.dn, smaller(self.dn), 0.05 + 1.0 * t.pipe.radius
        r, half, n, seat = 1.2 * s, 0.5 * s, t.n(s), 0.02
        axis, length = self.high * r, self.slender * r
        level, back = t.at(0, 0, axis), half + 0.1 * r
        front, rise = half + dead_room(dn) + 0.03, axis + 1.1 * r + dead_room(out)
        suction, first = mouth(dn, t.style, (-front, 0, axis), (-1, 0, 0), front)
        top, second = mouth(out, t.style, (0, 0, rise), (0, 0, 1), rise - axis)
        cup = outline(0.6 * r, -half, r, -0.7 * half, r, 0.8 * half, 1.2 * r, 0.85 * half, 1.2 * r, back)
        ribs = around(box((0.5 * r, 0.06 * r, half), (0.95 * r, 0, 0)), 8)
        t.add(CASING, *(along("x", one, 0, 0, axis) for one in (turned(cup, n), ribs)), suction, top)
        level.along("x").add("bolt", around(hexagon(0.16 * r, back - 0.35 * r, back - 0.2 * r), 6, 1.08 * r))
        if self.canned:
            far = back + length
            self._can(level, r, back, far, n)
        else:
            m = 0.95 * r
            bell = outline(
                1.2 * r, 0, 1.2 * r, 0.12 * r, r, 0.15 * r, r, 0.9 * r, 1.15 * m, 0.95 * r, 1.15 * m, 1.05 * r
            )
            level.at(back).along("x").add(CASING, turned(bell, n), of="rubber")
            self.motor.build(level.at(back + 1.05 * r).moved(LYING), m, length)
            far = back + 1.05 * r + 0.8 * length
        for x, name in ((0.0, CASING), (0.75 * far, "motor")):
            leg = box((0.25 * r, 1.5 * r, axis - 0.7 * r - seat), (x, 0, (seat + axis - 0.7 * r) / 2))
            t.bundled(name).add(name, leg, of="pump")
        base(t, "rim", -half, far, 2.2 * r, seat, [])
        return t.model(ports=(first, second), kind="magnetic drive pump")

    def _can(self, t: Table, r: float, back: float, end: float, n: int) -> None:
        """A canned motor along x from its back to its end, its lid, a flushing pipe over it, the terminal box on it."""
        m, motor, shape = 0.95 * r, t.bundled("motor"), outline(1.2 * r, back, 1.2 * r, back + 0.12 * r)
        shape += outline(m, back + 0.14 * r, m, end, 1.1 * r, end, 1.1 * r, end + 0.15 * r)
        motor.along("x").add("motor", turned(shape, n))
        lid = turned(outline(0.6 * m, 0, 0.6 * m, 0.1 * m, 0.3 * m, 0.2 * m), n)
        t.at(end + 0.15 * r).along("x").add(CASING, lid)
        loop = [(0.3 * r, 0, 1.1 * r), (0.3 * r, 0.3 * r, 1.4 * r), (end, 0.3 * r, 1.4 * r), (end + 0.07 * r, 0, r)]
        t.add("pipe", rope(loop, 0.06 * r, 8))
        mid = (back + end) / 2
        case, lid = (
            box((0.7 * r, 0.6 * r, 0.5 * r), (mid, 0, 1.15 * m)),
            box((0.8 * r, 0.7 * r, 0.06 * r), (mid, 0, 1.4 * m)),
        )
        motor.add("terminal box", case, lid, of="electrical")


class Electronic(
    Device,
    name="pump/electronic circulator",
    place="inline",
    group=PUMP,
    label="pump",
    bundle=CASING,
    sizes=(32, 40, 50, 65, 80, 100),
):
    """A circulator with a permanent magnet motor and its electronics in front (EN 16297), flanged, in the line."""

    deep: float = between(0.7, 1.3, "length of the motor / radius of the casing")
    finned: bool = chance(0.6, "the motor has fins")
    head: int = whole(0, 2, "form of the electronics: wide, tall, round")
    tall: float = between(0.5, 0.9, "depth of the electronics / radius of the casing")

    def build(self, t: Table) -> Model:
        radius, neck = t.pipe.radius, 0.485 * t.flange.hub
        r = 0.05 + 1.3 * radius
        length = round(2 * (0.75 * r + dead_room(self.dn) + 0.02), 6)
        n, x, deep, tall = t.n(r), length / 2, self.deep * r, self.tall * r
        body = flanged_body(self.dn, t.style, length, [(neck, 0.28 * length), (neck, 0.72 * length)])
        house = outline(0.6, -0.75, 0.95, -0.5, 1, 0.1, 1.1, 0.12, 1.1, 0.3)
        t.add(CASING, body, along("y", turned([(a * r, b * r) for a, b in house], n), x))
        low, y = 0.3 * r, 0.3 * r + deep
        fins = [cylinder(0.98 * r, low + z * deep, low + (z + 0.08) * deep, n) for z in (0.1, 0.3, 0.5, 0.7)]
        front = t.bundled("motor").at(x).along("y")
        front.add("motor", cylinder(0.85 * r, low, y, n), *(fins if self.finned else []))
        sheet = (
            rounded_rectangle(2.1 * r, 1.9 * r, 0.3 * r, 3),
            rounded_rectangle(1.6 * r, 2.6 * r, 0.5 * r, 4),
            circle(1.05 * r, n),
        )[self.head]
        head = [extrude(sheet, y, y + 0.7 * tall), extrude(0.9 * sheet, y + 0.7 * tall, y + tall)]
        screen = box((0.9 * r, 0.6 * r, 0.04 * r), (0, 0, y + tall))
        knob = moved(cylinder(0.16 * r, y + tall, y + tall + 0.06 * r, 14), at(0, 0.55 * r))
        gland = merge([cylinder(0.09 * r, 0, 0.35 * r, 8), hexagon(0.26 * r, 0, 0.12 * r)])
        gland = along("-y", gland, 0, -(0.94, 1.29, 1.0)[self.head] * r, y + 0.35 * tall)
        front.add("terminal box", *head, screen, knob, gland, of="rubber")
        return t.model(length, kind="circulator")


class Duckfoot(Device, name="pump/duckfoot", group=PUMP, label="pump", bundle=CASING, sizes=(50, 65, 80, 100, 150)):
    """A sewage pump in a sump: coupled to a duckfoot bend by its claw, two guide rails, a power cable."""

    tall: float = between(2.2, 3.6, "height of the motor / radius of the casing")
    fins: int = among((8, 12, 16), "fins of the motor")

    def build(self, t: Table) -> Model:
        dn, radius, outer = self.dn, t.pipe.radius, t.flange.outer
        r = 1.9 * radius + 0.06
        n, tall, low = t.n(r), self.tall * r, 0.25 * r + 0.05
        axis, face = low + 0.5 * r, 1.4 * r + dead_room(dn)
        house = moved(volute(0.95 * r, 0.5 * r, t.style, 0.35), at(0, 0, axis))
        mouth_ = turned(outline(0.75 * r, low - 0.25 * r, 0.55 * r, low + 0.1 * r), n)
        stub, _ = mouth(dn, t.style, (face, 0, axis), (1, 0, 0), face - 0.4 * r)
        claw = box((0.05, outer + 0.1, 0.08), (face - 0.03, 0, axis + outer / 2 + 0.02))
        t.add(CASING, house, mouth_, stub, claw)
        end = axis + tall
        can = outline(0.8 * r, axis + 0.4 * r, 0.8 * r, axis + 0.6 * r, 0.68 * r, axis + 0.65 * r, 0.68 * r, end)
        fins = around(box((0.16 * r, 0.05 * r, 0.7 * tall), (0.72 * r, 0, axis + 0.6 * tall)), self.fins)
        gland = moved(cylinder(0.1 * r, end, end + 0.35 * r, 10), at(0.35 * r, 0.3 * r))
        motor = t.bundled("motor")
        motor.add("motor", turned([*can, (0.6 * r, end + 0.15 * r)], n), fins, gland)
        t.add("pump base", around(box((0.12 * r, 0.1 * r, low), (0, 0, low / 2)), 3, 0.7 * r), own=False)
        lift = motor.at(0, 0, end + 0.45 * r).spun("x", np.pi / 2)
        lift.add("lifting lug", torus(0.35 * r, 0.05 * r, 14, 6), own=True)
        port, top = self._bend(t, axis, face, n)
        for side in BOTH:
            y, z = side * 0.3 * outer, axis + outer / 2 + 0.03
            t.add("post", rod((face + 0.02, y, z), (face + 0.02, y, top + 1.2), 0.02, 8))
        t.add("bracket", box((0.05, outer, 0.06), (face + 0.02, 0, axis + outer / 2 + 0.06)))
        cable = [(0.35 * r, 0.3 * r, end + 0.3 * r), (0.4 * r, 0.4 * r, end + 0.8 * r)]
        cable += [(0.8 * r, 0.9 * r, top + 0.6), (0.9 * r, 1.0 * r, top + 1.2)]
        t.add("cable", rope(cable, 0.012, 8))
        return t.model(ports=(port,), kind="sewage pump")

    def _bend(self, t: Table, axis: float, face: float, n: int) -> tuple[Port, float]:
        """The bend on its foot behind the pump's face; its port, and the height of that."""
        dn, radius, bend, thick = self.dn, t.pipe.radius, ELBOW_LONG_RADIUS[self.dn], plate_thickness(self.dn)
        mate = moved(disc_flange(dn, t.style, thick), looking((face, 0, axis), (-1, 0, 0)) @ spun("y", -np.pi / 2))
        start = face + thick
        path = [(start, 0, axis)]
        path += [
            (start + 0.01 + bend * np.sin(a), 0, axis + bend * (1 - np.cos(a))) for a in np.linspace(0, np.pi / 2, 7)
        ]
        top = axis + bend + 0.02 + dead_room(dn)
        up, port = mouth(dn, t.style, (start + 0.01 + bend, 0, top), (0, 0, 1), top - axis - bend + 0.004)
        x, tall = start + 0.6 * bend, axis - 0.3 * radius
        foot = [box((1.6 * bend, 1.2 * t.flange.outer, 0.02), (x, 0, 0.01))]
        foot.append(box((0.06, 0.8 * t.flange.outer, tall), (x, 0, tall / 2)))
        t.add("elbow", mate, tube(np.array(path), radius, 0.0, n), up, *foot)
        return port, top


SPECIAL = families_of(Turbine, SelfPriming, Magnetic, Electronic, Duckfoot)
