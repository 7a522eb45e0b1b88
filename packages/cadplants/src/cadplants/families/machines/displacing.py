"""Positive displacement pumps: screws, lobes, hoses, diaphragms, plungers; hand pumps and hydraulic packs."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import among, between, chance
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
)
from cadplants.families.valves.valve import bolt_circle
from cadplants.model.family import Model, Port
from cadplants.model.standards import smaller
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    along,
    around,
    ball,
    box,
    cylinder,
    dome,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["DISPLACING"]


class Cavity(Pump, name="pump/progressive cavity", sizes=(40, 50, 65, 80, 100)):
    """A progressive cavity pump: a long stator tube under tie rods, a suction chamber, lantern, gear motor, base."""

    seat: float = between(0.08, 0.16, "height of the base frame", "m")
    stator: float = between(14, 26, "length of the stator / radius of the pipe")
    hopper: bool = chance(0.25, "a hopper in place of the suction's mouth")
    slender: float = between(2.4, 3.2, "length of the motor / its radius")
    motor: Motor = driven(Motor, "motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, p = self.dn, self.seat, t.pipe.radius
        n, stator, tube, reach = t.n(p * 1.4), self.stator * p, 1.15 * p, dead_room(dn) + 0.03
        axis, room = seat + t.flange.outer / 2 + 0.05, max(6.0 * p, 1.2 * t.flange.outer)
        x, up, back = stator + 0.55 * room, axis + 1.35 * p + dead_room(dn) + 0.02, stator + room + 0.02
        lying = t.at(0, 0, axis).along("x")
        end, first = mouth(dn, t.style, (-reach, 0, axis), (-1, 0, 0), reach + 0.01)
        side, second = mouth(dn, t.style, (x, 0, up), (0, 0, 1), up - axis - 0.6 * p)
        if self.hopper:
            side = _hopper(stator, stator + room, 2.4 * p, axis, axis + 6 * p)
        chamber = [cylinder(1.35 * p, stator, stator + room, n), cylinder(1.7 * p, back - 0.04, back, n)]
        t.add(CASING, end, side, along("x", merge(chamber), 0, 0, axis))
        clamps = [cylinder(1.4 * tube, z, z + 0.03, n) for z in (0.0, stator - 0.03)]
        lying.add(CASING, cylinder(tube, 0.0, stator, n), *clamps, of="trim")
        tie = rod((0, 0, -0.02), (0, 0, stator + 0.02), 0.008, 8)
        lying.add("stud", around(tie, 4, 1.25 * tube, np.pi / 4))
        lantern = outline(1.5 * p, 0, 1.5 * p, 0.02, 1.1 * p, 0.03, 1.1 * p, 4 * p, 1.6 * p, 4.1 * p, 1.6 * p, 4.4 * p)
        lying.at(0, 0, back).add(CASING, turned(lantern, n))
        foot = (0.08, 2.4 * p, axis - seat - 1.1 * p)
        places = (0.25 * stator, 0.8 * stator, x)
        t.add("pump base", *(box(foot, (q, 0, (seat + axis - 1.1 * p) / 2)) for q in places), own=False)
        m, gear = 1.6 * p + 0.02, back + 4.4 * p
        drum = turned(outline(1.5 * m, 0, 1.5 * m, 0.03, 1.1 * m, 0.05, 1.1 * m, 1.4 * m), n)
        case = box((1.2 * m, 1.9 * m, axis - seat), (gear + 0.8 * m, 0, (seat + axis) / 2))
        t.bundled("motor").add("motor", along("x", drum, gear, 0, axis), case)
        self.motor.build(t.at(gear + 1.4 * m, 0, axis).moved(LYING), m, self.slender * m)
        base(t, self.bed, -0.05, gear + 2.5 * m, 2.6 * m, seat, [*places, gear + 0.8 * m])
        return t.model(ports=(first,) if self.hopper else (first, second), kind="progressive cavity pump")


def _hopper(x0: float, x1: float, wide: float, low: float, high: float) -> Solid:
    """An open box over a floor, ``wide`` to each side [m]."""
    mid, tall, z = (x0 + x1) / 2, high - low, (high + low) / 2
    walls = [box((x1 - x0, 0.006, tall), (mid, s * wide, z)) for s in BOTH]
    walls += [box((0.006, 2 * wide, tall), (x, 0, z)) for x in (x0 + 0.003, x1 - 0.003)]
    return merge([*walls, box((x1 - x0, 2 * wide, 0.02), (mid, 0, low))])


class Lobe(Pump, name="pump/rotary lobe", sizes=(40, 50, 65, 80, 100)):
    """A rotary lobe pump: an oval casing with a bolted or clamped front cover, gear case, motor behind."""

    seat: float = between(0.06, 0.15, "height of the base frame", "m")
    upright: bool = chance(0.5, "the rotors lie one over the other")
    level: bool = chance(0.6, "a mouth to each side, not one up")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, s = self.dn, self.seat, 0.04 + 1.4 * t.pipe.radius
        axis, n, start = seat + 2.0 * s, max(4, t.n(s) // 5), 2.8 * s + 0.8 * s
        lying = t.at(0, 0, axis).along("x")
        # The sheet's first axis turns to z.
        wide, tall = (3.2 * s, 1.9 * s) if self.upright else (1.9 * s, 3.2 * s)
        oval = rounded_rectangle(wide, tall, 0.94 * s, n)
        reach = (0.95 if self.upright is self.level else 1.6) * s + dead_room(dn) + 0.02
        ways = ((0, -1, 0), (0, 1, 0)) if self.level else ((0, 0, 1),)
        mouths = [mouth(dn, t.style, (0, reach * y, axis + reach * z), (0, y, z), reach - 0.5 * s) for _, y, z in ways]
        body = [extrude(oval, -0.6 * s, 0.6 * s), extrude(1.12 * oval, -0.7 * s, -0.6 * s)]
        t.add(CASING, *(along("x", one, 0, 0, axis) for one in body), *(solid for solid, _ in mouths), of="trim")
        lying.add(CASING, extrude(1.1 * oval, -0.95 * s, -0.705 * s), of="trim")
        knob = merge([cylinder(0.1 * s, 0, 0.1 * s, 8), ball(0.16 * s, 10)])
        spots = corners(0.75 * s, 0.75 * s)
        t.at(-0.97 * s, 0, axis).add("nut", *(along("-x", knob, 0, y, z) for y, z in spots))
        case = moved(extrude(rounded_rectangle(1.8 * s, 2.6 * s, 0.2 * s, 3), seat, axis + 1.3 * s), at(1.9 * s))
        t.add(CASING, case, box((0.9 * s, 1.8 * s, 2.2 * s), (0.8 * s, 0, axis)))
        eye = t.at(1.9 * s, 0, axis + 1.4 * s).spun("x", np.pi / 2)
        eye.add("lifting lug", torus(0.16 * s, 0.05 * s, 12, 6), of="fastener", own=True, fine=True)
        lying.add("shaft", cylinder(0.2 * s, 2.7 * s, start, 12))
        far, seats = self.drive.build(t, start, axis, seat, min(0.85 * (axis - seat), 1.4 * s))
        base(t, self.bed, 0.9 * s, far, 3.0 * s, seat, [1.9 * s, *seats])
        return t.model(ports=[port for _, port in mouths], kind="rotary lobe pump")


class Hose(Pump, name="pump/peristaltic", sizes=(20, 25, 32, 40, 50, 65)):
    """A peristaltic pump: a round housing with a bolted cover and window, both hose ends to one side, gear motor."""

    spokes: int = among((4, 6, 8), "ribs of the cover")
    level: bool = chance(0.5, "the hose ends aside, not up")
    motor_size: float = between(0.35, 0.55, "radius of the motor, less 1 cm / of the housing")
    slender: float = between(2.4, 3.2, "length of the motor / its radius")
    motor: Motor = driven(Motor, "motor")
    bed: str = among(("beams", "grid", "rim", "sheet"), "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, r, wide, seat = self.dn, 0.1 + 4.0 * t.pipe.radius, 0.06 + 1.5 * t.pipe.radius, 0.05
        n, axis, reach, lever = t.n(r), seat + 1.12 * r + 0.03, 1.12 * r + dead_room(dn) + 0.03, 0.82 * r
        lying, mouths = t.at(0, 0, axis).along("x"), []
        for s in BOTH:
            face, way = ((0, s * lever, axis + reach), (0, 0, 1))
            if self.level:
                face, way = (0, reach, axis + s * lever), (0, 1, 0)
            mouths.append(mouth(dn, t.style, face, way, reach - 0.3 * r))
        house = merge([cylinder(1.05 * r, -wide, wide, n), cylinder(1.12 * r, -wide - 0.02, -wide, n)])
        foot = (2.4 * wide, 0.12 * r + 0.02, axis - seat - 0.6 * r)
        feet = [box(foot, (0, y * 0.7 * r, (seat + axis - 0.6 * r) / 2)) for y in BOTH]
        t.add(CASING, along("x", house, 0, 0, axis), *feet, *(solid for solid, _ in mouths))
        cover = [ring(0.35 * r, 1.1 * r, -wide - 0.035, -wide - 0.021, n)]
        cover.append(cylinder(0.36 * r, -wide - 0.03, -wide - 0.021, n))
        spokes = around(box((0.4 * r, 0.06 * r, 0.02), (0.7 * r, 0, -wide - 0.04)), self.spokes)
        lying.add(CASING, *cover, spokes, of="steel")
        lying.add("bolt", bolt_circle(8, 1.08 * r, 0.01, -wide - 0.035, -wide + 0.0))
        m = self.motor_size * r + 0.01
        gear = outline(1.3 * m, wide, 1.3 * m, wide + 0.03, m, wide + 0.05, m, wide + 1.6 * m)
        lying.bundled("motor").add("motor", turned(gear, n))
        self.motor.build(t.at(wide + 1.6 * m, 0, axis).moved(LYING), m, self.slender * m)
        stay = box((0.05, 0.9 * m, axis - seat - 0.9 * m), (wide + 0.9 * m, 0, (seat + axis - 0.9 * m) / 2))
        t.add("pump base", stay, own=False)
        base(t, self.bed, -1.6 * wide, wide + 2.6 * m, 1.9 * r, seat, [0.0, wide + 0.9 * m])
        return t.model(ports=[port for _, port in mouths], kind="peristaltic pump")


class Clamped(
    Device, name="pump/clamped diaphragm", group=PUMP, label="pump", bundle=CASING, sizes=(15, 25, 40, 50, 80)
):
    """An air-operated diaphragm pump with band clamps or tie bolts: domed chambers, elbows, centre block, muffler."""

    gap: float = between(0.4, 0.6, "from the middle to the chambers / their radius")
    bulge: float = between(0.35, 0.6, "height of the domes / radius")
    ribbed: bool = chance(0.5, "ribs on the domes")
    banded: bool = chance(0.6, "band clamps round the chambers, not tie bolts")

    def build(self, t: Table) -> Model:
        p, ways = t.pipe.radius, ("x", "-x")
        r = 2.2 * p + 0.06
        n, gap = t.n(r), self.gap * r
        axis = max(1.6 * r, 1.3 * r + t.flange.outer / 2) + 0.03
        level = t.at(0, 0, axis)
        manifolds, ports = self._manifolds(t, axis, r, gap)
        t.add(CASING, *manifolds, of="trim")
        bowl = [dome(0.95 * r, self.bulge * r, gap, n)]
        if self.ribbed:
            bowl.append(around(box((0.75 * r, 0.04 * r, 0.3 * r), (0.45 * r, 0, gap + 0.15 * r)), 8))
        for way in ways:
            level.along(way).add(CASING, *bowl)
        air = turned(outline(0.6 * r, 0.5 * gap, 0.95 * r, 0.9 * gap, 0.95 * r, gap), n)
        centre = [box((gap, 0.9 * r, 1.1 * r)), along("y", cylinder(0.35 * r, -0.6 * r, 0.6 * r, n))]
        level.add(CASING, *(along(way, air) for way in ways), *centre, of="steel")
        muffler = outline(0.12 * r, 0.55 * r, 0.22 * r, 0.6 * r, 0.22 * r, 1.2 * r, 0.1 * r, 1.25 * r)
        level.at(0, 0, -0.1 * r).along("y").add(CASING, turned(muffler, n), of="rubber")
        tall = max(0.02, axis - 1.3 * r - 1.15 * p + 0.02)
        feet = [box((0.35 * r, 1.3 * r, tall), (x * (gap + 0.05 * r), 0, tall / 2)) for x in BOTH]
        t.add("pump base", *feet, of="rubber", own=False)
        low, high = gap - 0.05 * r, gap + 0.05 * r
        if self.banded:
            lug = box((0.2 * r, 0.14 * r, 0.14 * r), (1.1 * r, 0, gap))
            for way in ways:
                level.along(way).add("clamp", ring(0.93 * r, 1.06 * r, low, high, n), lug, own=True)
        else:
            level.add(CASING, *(along(way, cylinder(1.06 * r, low, high, n)) for way in ways))
            stud = rod((0, 0, -gap - 0.1 * r), (0, 0, gap + 0.1 * r), 0.03 * r, 6)
            level.along("x").add("stud", around(stud, 8, 0.99 * r))
        return t.model(ports=ports, kind="diaphragm pump")

    def _manifolds(self, t: Table, axis: float, r: float, gap: float) -> tuple[list[Solid], list[Port]]:
        """A bent pipe below and above with the valves' seats and a mouth in front; and the mouths' ports."""
        p, n, front = t.pipe.radius, t.n(r), 0.5 * r + dead_room(self.dn)
        seat = merge([cylinder(1.7 * p, -0.06 * r, 0.06 * r, n), cylinder(1.4 * p, -0.2 * r, 0.2 * r, n)])
        solids, ports = [], []
        for s in BOTH:
            z, x = axis + s * 1.3 * r, gap + 0.25 * r
            half = [(x, 0, axis + s * 0.75 * r), (x, 0, z - s * 0.15 * r), (gap + 0.1 * r, 0, z)]
            solids.append(rope([*((-a, b, c) for a, b, c in half), *half[::-1]], 1.15 * p, n))
            solids += [moved(seat, at(q * x, 0, axis + s * 0.9 * r)) for q in BOTH]
            stub, port = mouth(self.dn, t.style, (0, -front, z), (0, -1, 0), front)
            solids.append(stub)
            ports.append(port)
        return solids, ports


class Triplex(Pump, name="pump/triplex plunger", sizes=(40, 50, 65, 80)):
    """A triplex plunger pump (API 674): crankcase, crosshead frame open above the plungers, fluid end, belt drive."""

    seat: float = between(0.08, 0.16, "height of the base frame", "m")
    motor: Motor = driven(Motor, "motor", standing=True)
    damped: bool = chance(0.6, "a pulsation damper on the fluid end")
    hooded: bool = chance(0.7, "a guard over the belt, not bare wheels")
    bed: str = among(("grid", "beams", "plinth", "rim"), "form of the base frame")

    def build(self, t: Table) -> Model:
        seat, s = self.seat, 0.09 + 1.6 * t.pipe.radius
        wide, axis, x = 2.4 * s, seat + 0.9 * s, 2.6 * s
        ports = self._pump(t, s, axis, wide)
        y, n, level = wide / 2 + 0.2 * s, t.n(s), t.at(0, 0, axis)
        if self.hooded:
            hood = extrude(rounded_rectangle(x + 2.0 * s, 1.9 * s, 0.9 * s, 4), y - 0.03 * s, y + 0.35 * s)
            level.at(x / 2).spun("x", -np.pi / 2).add("coupling guard", hood, own=False)
        else:
            wheel = [ring(0.3 * s, 0.75 * s, 0, 0.25 * s, n), cylinder(0.31 * s, 0.05 * s, 0.2 * s, n)]
            level.at(0.1 * s, y).along("y").add("shaft", *wheel)
            level.at(x, y).along("y").add("shaft", cylinder(0.3 * s, 0, 0.25 * s, n))
        shaft = cylinder(0.16 * s, wide / 2 - 0.02, y + 0.1 * s, 12)
        level.at(0.1 * s).along("y").add("shaft", shaft)
        m, aside = 0.75 * s, level.at(x, y - 0.05 * s)
        self.motor.build(aside.spun("x", np.pi / 2).spun("z", np.pi / 2), m, 2.6 * m, axis - seat)
        base(t, self.bed, -1.9 * s, x + 1.2 * m, 1.6 * wide, seat, [-1.3 * s, 0.0, x - 0.85 * m, x + 0.85 * m])
        return t.model(ports=ports, kind="plunger pump")

    def _pump(self, t: Table, s: float, axis: float, wide: float) -> list[Port]:
        """Fluid end, crankcase, plungers, covers, maybe the damper; the ports of the mouths."""
        dn, level, x, ys = self.dn, t.at(0, 0, axis), -2.2 * s, [k * 0.62 * s for k in (-1, 0, 1)]
        reach = 0.48 * wide + dead_room(dn) + 0.03
        one, first = mouth(dn, t.style, (x, -reach, axis - 0.4 * s), (0, -1, 0), dead_room(dn) + 0.06)
        two, second = mouth(smaller(dn, 2), t.style, (x, reach, axis + 0.3 * s), (0, 1, 0), reach - 0.4 * wide)
        t.add(CASING, box((0.8 * s, 0.95 * wide, 1.3 * s), (x, 0, axis - 0.1 * s)), one, two, of="trim")
        sheet = np.array([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.3], [0.5, 0.85], [-0.6, 0.85], [-0.9, 0.5]]) * s
        case = moved(extrude(sheet, -wide / 2, wide / 2), spun("x", np.pi / 2))
        cover = box((0.06 * s, 0.7 * wide, 1.0 * s), (0.92 * s, 0, -0.3 * s))
        frame = [box((0.9 * s, 0.12 * s, 1.1 * s), (-1.35 * s, y * 0.5 * wide, -0.35 * s)) for y in (-0.94, 0.94)]
        level.add(CASING, case, cover, *frame, box((0.9 * s, wide, 0.1 * s), (-1.35 * s, 0, -0.85 * s)))
        rod_ = merge([cylinder(0.13 * s, 0, 0.95 * s, 12), cylinder(0.22 * s, 0.0, 0.25 * s, 12)])
        level.add("shaft", *(along("x", rod_, -1.83 * s, y) for y in ys))
        plug = merge([hexagon(0.4 * s, 0, 0.16 * s), cylinder(0.24 * s, -0.02, 0.06 * s, 16)])
        cap = hexagon(0.4 * s, -0.02, 0.14 * s)
        plugs = [*(moved(plug, at(x, y, 0.55 * s)) for y in ys), *(along("-x", cap, -2.6 * s, y) for y in ys)]
        level.add(CASING, *plugs, of="fastener")
        if self.damped:
            bulb = moved(ball(0.4 * s, t.n(0.4 * s), 1.2), at(x, 0, 1.2 * s))
            level.add(CASING, bulb, moved(cylinder(0.14 * s, 0, 0.4 * s, 12), at(x, 0, 0.5 * s)), of="handle")
        return [first, second]


DISPLACING = families_of(Cavity, Lobe, Hose, Clamped, Triplex)
