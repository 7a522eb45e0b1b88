"""Blowers and fans, compressors, and a motor with its gear, with what they stand on."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    BASES,
    LYING,
    PUMP,
    Driven,
    Motor,
    Train,
    base,
    corners,
    dead_room,
    driven,
    mouth,
    slab,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["AIR"]


class _Blower(Driven, group="Equipment", label="blower", bundle="blower", sizes=(15,)):
    """A blower or fan with its motor."""


def _scroll(r: float, wide: float, style: ModelingStyle, growth: float) -> list[Solid]:
    """A sheet fan housing about z, blowing to +y on its +x side, rims at its cheeks."""
    a = np.linspace(0, 1.5 * np.pi, max(12, style.round(r)))
    spiral = (r * (1 + growth * (1 - a / (1.5 * np.pi))))[:, None] * np.column_stack([np.cos(a), np.sin(a)])
    # From the cut-off over the back down to the mouth, which lies on the +x side.
    outer = r * (1 + growth)
    sheet = np.vstack([spiral[::-1] * np.array([1.0, -1.0]), [(outer, 1.2 * r), (0.25 * r, 1.2 * r)]])
    if np.sum(sheet[:, 0] * np.roll(sheet[:, 1], -1) - sheet[:, 1] * np.roll(sheet[:, 0], -1)) < 0:
        sheet = sheet[::-1]
    rims = [extrude(sheet * 1.05, z - 0.004, z + 0.004) for z in (-wide / 2, wide / 2)]
    lip = box((1.05 * (outer - 0.15 * r), 0.02, 1.2 * wide), ((outer + 0.25 * r) / 2, 1.25 * r, 0))
    return [extrude(sheet, -wide / 2, wide / 2), *rims, lip]


class BeltFan(_Blower, name="blower/belt fan", weight=1.5):
    """A radial fan with a belt drive or on the motor's shaft: scroll with rims, inlet cone, pedestal, damped frame."""

    radius: float = between(0.18, 0.4, "of the wheel", "m")
    wide: float = between(0.5, 1.1, "width of the housing / radius")
    growth: float = between(0.25, 0.55, "of the housing's radius round the wheel / radius")
    quarter: int = whole(0, 2, "quarter turns of the housing")
    meshed: bool = chance(0.4, "wire mesh in front of the inlet")
    deep: float = between(1.5, 2.0, "length of the frame behind the housing / radius")
    belted: bool = chance(0.55, "a belt drives it")
    motor: Motor = driven(Motor, "motor", standing=True)

    def build(self, t: Table) -> Model:
        r, wide = self.radius, self.wide * self.radius
        n, axis = t.n(r), (1.25 + self.growth) * r + 0.2
        stand = spun("x", np.pi / 2)
        turn = spun("z", -self.quarter * np.pi / 2)
        inlet = turned(outline(0.55 * r, 0, 0.62 * r, 0.12 * r, 0.8 * r, 0.2 * r, 0.8 * r, 0.22 * r), n)
        house = moved(merge(_scroll(r, wide, t.style, self.growth)), turn)
        t.at(0, 0, axis).moved(stand).add("blower", house, moved(inlet, at(0, 0, wide / 2)), of="motor")
        if self.meshed:
            z = wide / 2 + 0.24 * r
            mesh = [moved(torus(k * r, 0.006, n, 4), stand @ at(0, 0, z)) for k in (0.2, 0.4, 0.6, 0.78)]
            y = -wide / 2 - 0.235 * r
            bars = [box((1.56 * r, 0.008, 0.008), (0, y, 0)), box((0.008, 0.008, 1.56 * r), (0, y, 0))]
            t.at(0, 0, axis).add("blower", *mesh, *bars, of="clamp")
        deep, low = self.deep * r, 0.14
        y0 = wide / 2 + 0.005
        rails = [box((0.08, wide + deep, 0.08), (s * 0.9 * r, deep / 2, low)) for s in BOTH]
        rails += [box((1.8 * r, 0.08, 0.08), (0, y, low)) for y in (-0.4 * wide, y0 + 0.3 * r, y0 + 0.8 * deep)]
        leg, mid = (0.06, 0.04, axis - 0.45 * r - low), (axis - 0.45 * r + low) / 2
        legs = [box(leg, (x, y, mid)) for x, y in corners(0.85 * r, wide / 2 + 0.02)]
        t.add("blower", *rails, *legs, of="steel")
        pad = cylinder(0.05, 0, low - 0.035, 12)
        spots = [(x * 0.9 * r, y) for x in BOTH for y in (-0.4 * wide, wide / 2 + 0.85 * deep)]
        t.add("blower", *(moved(pad, at(x, y)) for x, y in spots), of="rubber")
        if self.belted:
            self._belt(t, axis, low + 0.04, y0, deep)
        else:
            m, seat = 0.3 * r + 0.02, low + 0.04
            tall, middle = axis - seat - 1.25 * m, (axis + seat - 1.25 * m) / 2
            t.add("blower", box((2.2 * m, 0.8 * deep, tall), (0, y0 + 0.45 * deep, middle)), of="steel")
            pose = at(0, y0 + 0.04, axis) @ spun("x", -np.pi / 2) @ spun("z", -np.pi / 2)
            self.motor.build(t.moved(pose), m, 2.8 * m, 1.25 * m)
            shaft = cylinder(0.15 * m, y0 - 0.03, y0 + 0.05, 10)
            t.bundled("motor").at(0, 0, axis).along("y").add("shaft", shaft, own=True)
        return t.model(kind="radial fan")

    def _belt(self, t: Table, axis: float, seat: float, y0: float, deep: float) -> None:
        """A pedestal with the shaft's bearings, a belt guard, the motor on a table aside."""
        r, m = self.radius, 0.3 * self.radius + 0.02
        high, x, z = axis - seat - 0.14 * r, 1.25 * r, seat + 1.25 * m
        far, out = y0 + 0.85 * deep, y0 + 1.0 * deep
        sheet = outline(y0 + 0.1 * r, 0, y0 + 0.9 * deep, 0, y0 + 0.7 * deep, high, y0 + 0.1 * r, high)
        pedestal = slab(np.array(sheet) + np.array((0.0, seat)), -0.35 * r, 0.35 * r)
        blocks = [box((0.4 * r, 0.2 * r, 0.3 * r), (0, y0 + y * deep, axis)) for y in (0.2, 0.55)]
        t.add("blower", pedestal, *blocks, of="steel")
        shaft = cylinder(0.06 * r, y0 - 0.02, y0 + 1.05 * deep, 12)
        t.at(0, 0, axis).along("y").add("shaft", shaft, own=True)
        tilt, reach = float(np.arctan2(z - axis, x)), float(np.hypot(x, z - axis))
        hood = extrude(rounded_rectangle(reach + 0.9 * r, 0.85 * r, 0.42 * r, 4), -0.06, 0.06)
        t.at(x / 2, out, (axis + z) / 2).spun("x", np.pi / 2).spun("z", tilt).add("coupling guard", hood)
        table = [box((0.9 * r, 0.8 * deep, 0.02), (x, y0 + 0.45 * deep, seat - 0.01))]
        table += [box((0.8 * r, 0.06, 0.06), (x, y0 + y * deep, seat - 0.05)) for y in (0.15, 0.75)]
        post = (0.06, 0.06, seat - 0.08)
        table += [box(post, (x + 0.3 * r, y0 + y * deep, (seat - 0.08) / 2)) for y in (0.15, 0.75)]
        t.add("blower", *table, of="steel")
        pose = at(x, far + 0.05, z) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2)
        self.motor.build(t.moved(pose), m, min(2.8 * m, 0.7 * deep), z - seat)
        t.bundled("motor").at(x, 0, z).along("y").add("shaft", cylinder(0.15 * m, far, out, 10), own=True)


class Roots(_Blower, name="blower/Roots", sizes=(50, 65, 80, 100, 125, 150)):
    """A Roots blower: an oval ribbed casing with gear cases, silencers above and below or aside, filter, belt guard."""

    high: float = between(0.3, 0.5, "height of its frame, by its nominal size less", "m")
    long: float = between(2.0, 3.2, "length of the casing / radius of a rotor")
    upright: bool = chance(0.5, "its rotors lie one beside the other")
    can: float = between(2.0, 2.8, "radius of the silencers / of the pipe")
    tall: float = between(5, 8, "height of the upper silencer / radius of the pipe")
    motor: Motor = driven(Motor, "motor", standing=True)

    def build(self, t: Table) -> Model:
        dn, p, s = self.dn, t.pipe.radius, 0.1 + 0.9 * t.pipe.radius
        seat, long = self.high + 1.2 * s, self.long * s
        axis, half = seat + 1.3 * s, (0.95 if not self.upright else 1.55) * s
        oval = rounded_rectangle(3.1 * s, 1.9 * s, 0.94 * s, 5)
        body = [along("x", extrude(oval, -long / 2, long / 2))]
        body += [along("x", extrude(1.06 * oval, x - 0.01, x + 0.01)) for x in np.linspace(-0.42, 0.42, 5) * long]
        body += [along(a, extrude(0.92 * oval, long / 2, long / 2 + 0.5 * s)) for a in ("x", "-x")]
        cap = turned([(a * s, long / 2 + b * s) for a, b in outline(0.5, 0.5, 0.5, 0.6, 0.3, 0.7)], 16)
        body += [along("x", cap, 0, 0, y) for y in (-0.7 * s, 0.7 * s)]
        body = [moved(one, at(0, 0, axis) @ spun("x", 0.0 if self.upright else np.pi / 2)) for one in body]
        foot = (0.2 * s, 1.6 * s, axis - seat - 0.5 * half)
        feet = [box(foot, (x * 0.4 * long, 0, (seat + axis - 0.5 * half) / 2)) for x in BOTH]
        t.add("blower", *body, *feet, of="pump")
        can = self.can * p
        self._filter(t, can, axis + half - 0.02)
        n, z = t.n(2.2 * p), max(can + 0.02, seat - 0.11 - can)
        drum = turned(outline(0.6 * can, -0.62 * long, can, -0.55 * long, can, 0.75 * long, 0.6 * can, 0.85 * long), n)
        drop = rod((0, 0, axis - 0.6 * half), (0, 0, z), p, n)
        face, port = mouth(dn, t.style, (-0.62 * long - dead_room(dn) - 0.05, 0, z), (-1, 0, 0), dead_room(dn) + 0.06)
        t.add("blower", along("x", drum, 0, 0, z), drop, face, of="tank")
        self._drive(t, axis, seat, long, max(can, 0.75 * s))
        return t.model(ports=(port,), kind="Roots blower")

    def _filter(self, t: Table, can: float, z: float) -> None:
        """The upper silencer and the filter on it."""
        p, n, tall = t.pipe.radius, t.n(2.2 * t.pipe.radius), self.tall * t.pipe.radius + 0.1
        drum = outline(p, z, p, z + 0.08, can, z + 0.1 + 0.5 * p, can, z + 0.1 + tall, p, z + 0.12 + tall + 0.4 * p)
        t.add("blower", turned([*drum, (p, z + 0.22 + tall)], n), of="tank")
        low, top = z + 0.2 + tall, z + 0.22 + tall + 1.6 * p
        hat = [cylinder(1.5 * p, low, top, n), cylinder(1.7 * p, top, top + 0.02, n)]
        hat += [cylinder(1.56 * p, low + k * p, low + k * p + 0.01, n) for k in (0.3, 0.6, 0.9, 1.2)]
        t.add("filter", *hat, of="electrical")

    def _drive(self, t: Table, axis: float, seat: float, long: float, front: float) -> None:
        """The frame, the motor beside the casing, and the belt guard over both shafts."""
        s = 0.1 + 0.9 * t.pipe.radius
        m, gap = 1.05 * s, 2.4 * s
        z, length, x = seat + 1.3 * m, min(2.6 * m, long), -long / 2 - 0.8 * s
        frame = [box((long + 1.6 * s, 0.08, 0.1), (0, y, seat - 0.05)) for y in (-0.75 * s, 0.75 * s)]
        frame += [box((0.1, gap + 2.6 * m, 0.1), (q * 0.4 * long, gap / 2, seat - 0.05)) for q in BOTH]
        post = (0.08, 0.08, seat - 0.1)
        frame += [box(post, (q * 0.4 * long, y, post[2] / 2)) for q in BOTH for y in (-front - 0.06, gap + m)]
        frame += [box((0.08, 0.08, 0.08), (q * 0.4 * long, -front - 0.04, seat - 0.05)) for q in BOTH]
        t.add("blower", *frame, of="steel")
        hood = slab(rounded_rectangle(float(np.hypot(gap, z - axis)) + 2.0 * s, 1.7 * s, 0.8 * s, 4), -0.07, 0.07)
        tilt = float(np.arctan2(z - axis, gap))
        t.at(x, gap / 2, (axis + z) / 2).spun("x", tilt).add("coupling guard", hood)
        t.at(0, 0, axis).along("x").add("shaft", cylinder(0.15 * s, x, -long / 2, 12), own=True)
        shaft = cylinder(0.15 * s, x, -length / 2 + 0.05, 12)
        t.bundled("motor").at(0, gap, z).along("x").add("shaft", shaft, own=True)
        self.motor.build(t.at(-length / 2, gap, z).moved(LYING), m, length, z - seat)


class SideChannel(_Blower, name="blower/side channel", sizes=(40,)):
    """A side channel blower: a flat ring housing with a fat rim, two silencer boxes to its foot, a motor."""

    radius: float = between(0.14, 0.28, "of the housing", "m")
    stages: int = whole(1, 2, "stages")
    ribs: int = among((6, 8, 12), "ribs on the housing's cover")
    motor_size: float = between(0.5, 0.65, "radius of the motor / of the housing")
    slender: float = between(2.2, 3.0, "length of the motor / its radius")
    frame: str = among(("cast", "square"), "how the motor's frame is made")
    motor: Motor = driven(Motor, "motor")

    def build(self, t: Table) -> Model:
        r, more = self.radius, 0.42 * self.radius * (self.stages - 1)
        n, axis = t.n(r), 1.2 * r + 0.03
        rim = [(0.82 * r + 0.2 * r * np.cos(a), 0.2 * r * np.sin(a)) for a in np.linspace(-np.pi / 2, np.pi / 2, 7)]
        wheel = [
            turned([(0.5 * r, z - 0.2 * r), *((x, y + z) for x, y in rim), (0.5 * r, z + 0.2 * r)], n)
            for z in np.arange(self.stages) * 0.42 * r
        ]
        ribs = around(box((0.55 * r, 0.03 * r, 0.06 * r), (0.6 * r, 0, -0.2 * r)), self.ribs)
        cap = turned(outline(0.35 * r, -0.3 * r, 0.5 * r, -0.15 * r), n)
        house = moved(merge([*wheel, ribs, cap]), at(0, 0, axis) @ spun("y", np.pi / 2))
        depth = 0.5 * r + more
        x, z, boxes = 0.3 * depth - 0.1 * r, 0.03 + 0.28 * r, []
        silencer = extrude(rounded_rectangle(0.75 * r, 0.6 * r, 0.12 * r, 3), 0.03, axis - 0.5 * r)
        for s, way in ((-1, "-y"), (1, "y")):
            boxes.append(moved(silencer, at(x, s * 0.7 * r)))
            boxes += [
                along(way, one, x, s * 0.98 * r, z)
                for one in (cylinder(0.2 * r, 0, 0.28 * r, 16), hexagon(0.52 * r, 0.2 * r, 0.4 * r))
            ]
        foot = box((depth + 0.4 * r, 2.1 * r, 0.03), (0.2 * r + 0.3 * depth, 0, 0.015))
        t.add("blower", house, *boxes, foot, of="trim")
        m = self.motor_size * r
        self.motor.build(t.at(0.2 * r + more - 0.01, 0, axis).moved(LYING), m, self.slender * m)
        return t.model(kind="side channel blower")


class Axial(_Blower, name="blower/axial"):
    """An axial duct fan: a flanged round casing with the motor on struts inside, blades, guard; on feet or hung."""

    radius: float = between(0.2, 0.5, "of the casing", "m")
    long: float = between(0.8, 1.6, "length of the casing / radius")
    hung: bool = chance(0.35, "it hangs on rods")
    high: float = between(2.0, 2.6, "height of its axis, where it hangs", "m", when=lambda p: p.hung)
    blades: int = whole(4, 8, "blades")
    frame: str = among(("cast", "smooth", "square"), "how the motor's frame is made")
    motor: Motor = driven(Motor, "motor", bare=True)
    guarded: bool = chance(0.6, "a wire guard in front")

    def build(self, t: Table) -> Model:
        r, long = self.radius, self.long * self.radius
        n, axis = t.n(r), self.high if self.hung else 1.25 * r + 0.1
        level = t.at(0, 0, axis)
        lying = level.along("x")
        case = [ring(0.97 * r, r, -long / 2, long / 2, n)]
        case += [ring(0.97 * r, 1.13 * r, z - 0.005, z + 0.005, n) for z in (-long / 2 + 0.005, long / 2 - 0.005)]
        struts = around(box((0.66 * r, 0.02, 0.15 * r), (0.64 * r, 0, 0.2 * long)), 4, 0.0, np.pi / 4)
        lying.add("blower", *case, struts, of="clamp")
        blade = box((0.6 * r, 0.22 * r, 0.015 * r + 0.002), (0.63 * r, 0, 0))
        blades = around(moved(blade, at(0, 0, -0.35 * long) @ spun("x", 0.6)), self.blades)
        lying.add("impeller", cylinder(0.36 * r, -0.43 * long, -0.25 * long, n), blades, own=True)
        self.motor.build(level.at(-0.25 * long).moved(LYING), 0.34 * r, 0.85 * long)
        terminals = box((0.25 * r, 0.35 * r, 0.25 * r), (0, 0.7 * r, 0.7 * r))
        level.bundled("motor").add("terminal box", terminals, of="electrical", own=True)
        if self.guarded:
            hoop = 0.004 + 0.006 * r
            mesh = [moved(torus(k * r, hoop, n, 4), at(0, 0, -long / 2)) for k in (0.25, 0.5, 0.75, 0.98)]
            wire = box((2 * r, 0.008, 0.008), (0, 0, -long / 2))
            lying.add("blower", *mesh, *(moved(wire, spun("z", a)) for a in (0.0, 1.05, 2.09)), of="safety")
        if self.hung:
            self._hang(t, axis, long)
        else:
            tall = axis - 0.68 * r
            foot = [box((0.15, 2.1 * r, 0.012), (x * 0.3 * long, 0, 0.006)) for x in BOTH]
            foot += [box((0.05, 0.28 * r, tall), (x, y, tall / 2)) for x, y in corners(0.3 * long, 0.86 * r)]
            t.add("bracket", *foot, own=True)
        return t.model(kind="axial fan")

    def _hang(self, t: Table, axis: float, long: float) -> None:
        """Lugs with rods under a beam on columns."""
        r, low, high = self.radius, axis + 0.72 * self.radius, axis + 1.6 * self.radius
        spots = corners(0.3 * long, 0.7 * r)
        t.add("blower", *(box((0.05, 0.06, 0.04), (x, y, low)) for x, y in spots), of="clamp")
        for x, y in spots:
            t.add("stud", rod((x, y, low), (x, y, high), 0.006, 8), own=False, fine=False)
        t.add("beam", box((1.2 * long + 0.3, 2.2 * r, 0.1), (0, 0, high + 0.05)))
        t.add("beam", box((0.1, 2.5 * r, 0.1), (0, 0, high + 0.15)))
        for s in BOTH:
            t.add("column", box((0.1, 0.1, high + 0.2), (0, s * (1.25 * r + 0.05), (high + 0.2) / 2)))


class Geared(Driven, name="motor/geared", group=PUMP, label="motor", bundle="motor", sizes=(15,), weight=1.5):
    """A motor that drives a gearbox through a guarded coupling, on a base frame: what a conveyor or mixer has."""

    radius: float = between(0.08, 0.25, "of the motor", "m")
    seat: float = between(0.06, 0.25, "height of the base frame", "m")
    size: float = between(1.0, 1.5, "of the gearbox / radius")
    frame: str = among(("cast", "square", "drip", "ex", "smooth", "cooled"), "how the motor's frame is made")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        r, seat, s = self.radius, self.seat, self.size * self.radius
        axis, start = seat + 1.25 * max(r, s), 1.5 * s
        far, seats = self.drive.build(t, start, axis, seat, r)
        lying, n = t.at(0, 0, axis).along("x"), t.n(s)
        case = [
            box((1.8 * s, 1.5 * s, axis - seat + 0.3 * s), (0, 0, (seat + axis + 0.3 * s) / 2)),
            box((1.9 * s, 1.9 * s, 0.14 * s), (0, 0, axis)),
            moved(cylinder(0.3 * s, 0, 0.3 * s, 14), at(0.3 * s, 0, axis + 0.28 * s)),
            along("x", cylinder(0.45 * s, 0.85 * s, 1.05 * s, n), 0, 0, axis),
        ]
        fins = [box((1.5 * s, 1.56 * s, 0.04 * s), (0, 0, seat + k * (axis - seat))) for k in (0.3, 0.45, 0.6)]
        t.add("gearbox", *case, *fins, of="motor", own=True)
        slow = [cylinder(0.5 * s, 0.85 * s, 1.1 * s, n), cylinder(0.2 * s, 1.0 * s, 2.2 * s, 14)]
        key = box((0.06 * s, 0.1 * s, 0.8 * s), (0.2 * s, 0, 1.7 * s))
        t.at(0, 0, axis).along("-x").add("shaft", *slow, key)
        lying.add("shaft", cylinder(0.16 * r, 1.0 * s, start, 12))
        base(t, self.bed, -1.1 * s, far, 2.5 * max(r, 0.8 * s), seat, [-0.5 * s, 0.5 * s, *seats])
        return t.model(kind="motor")


AIR = families_of(BeltFan, Roots, SideChannel, Axial, Geared)
