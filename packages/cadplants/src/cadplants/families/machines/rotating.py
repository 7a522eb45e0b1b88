"""Pumps, compressors and blowers with their motors, on the floor or in a line."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, given, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    CASING,
    LYING,
    PUMP,
    Driven,
    Pump,
    corners,
    driven,
)
from cadplants.families.valves.valve import disc_flange, flanged_body
from cadplants.model.family import Model, Port
from cadplants.model.standards import smaller
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle, section_channel
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
from cadplants.solids.transforms import at, looking, spun

__all__ = ["ROTATING"]

_MID = (40, 50, 65, 80, 100)


class RibbedMotor(Params):
    """An electric motor (IEC 60072 proportions) with fins all round or a smooth frame."""

    fine: bool = given(True, "whether it is modelled with all its fins")
    fins: int = among(lambda p: (0, 16, 24, 36) if p.fine else (0, 0, 16), "fins round its frame")
    meshed: bool = chance(0.3, "its fan cover ends in wire hoops, where it is modelled finely")
    turn: int = among((0, 0, 1, -1), "quarter turns of its terminal box")
    eye: bool = chance(0.4, "a lifting eye sits on it")

    def build(self, t: Table, r: float, length: float, feet: float = 0.0) -> None:
        """Puts it down about z from 0, its fan end up, its x axis up where it lies.

        Args:
            t: with the frame.
            r: radius over the fins [m].
            length: with the fan cover [m].
            feet: height of the axis over the floor; 0 for a flange-mounted motor [m].
        """
        t, n, low, high = t.bundled("motor"), t.n(r), 0.10 * length, 0.78 * length
        frame = [cylinder(0.86 * r if self.fins else r, low, high, n)]
        frame.append(turned(outline(0.45 * r, 0, 0.95 * r, 0.03 * length, 0.95 * r, 0.11 * length), n))
        if self.fins:
            size = (0.16 * r, max(0.002, 0.03 * r), 0.92 * (high - low))
            frame.append(around(box(size, (0.92 * r, 0, (low + high) / 2)), self.fins, 0.0, np.pi / self.fins))
        t.add("motor", *frame, own=True)
        hood = [turned(outline(r, 0.765 * length, r, 0.95 * length, 0.85 * r, length), n)]
        if self.meshed and n >= 12:
            hood = [turned(outline(r, 0.765 * length, r, 0.97 * length), n)]
            hood += [moved(torus(0.25 * k * r, 0.02 * r, n, 4), at(0, 0, 0.985 * length)) for k in (1, 2, 3)]
        t.add("motor fan cover", *hood, own=True)
        wide, tall = 0.7 * r, 0.3 * length
        case = box((0.45 * r, wide, tall), (1.08 * r, 0, 0.36 * length))
        lid = box((0.08 * r, 1.1 * wide, 1.08 * tall), (1.32 * r, 0, 0.36 * length))
        t.spun("z", self.turn * np.pi / 2).add("terminal box", case, lid, own=True)
        t.add("shaft", cylinder(0.16 * r, -0.3 * length, 0.02 * length, 12), own=True)
        if feet:
            foot = (feet - 0.6 * r, 1.9 * r, 0.1 * length)
            t.add("motor", *(box(foot, (-(feet + 0.6 * r) / 2, 0, z * length)) for z in (0.2, 0.66)), own=True)
        if self.eye:
            eye = moved(torus(0.14 * r, 0.035 * r, 12, 6), at(1.1 * r, 0, 0.62 * length) @ spun("x", np.pi / 2))
            stud = along("x", cylinder(0.06 * r, 0.8 * r, 0.96 * r, 8), 0, 0, 0.62 * length)
            t.add("lifting lug", eye, stud, of="fastener", own=True, fine=True)


def _plate(kind: int, length: float, width: float, height: float) -> list[Solid]:
    """A base plate: a block, a tray, or two channels under a plate."""
    if kind == 0:
        return [extrude(rounded_rectangle(length, width, 0.02, 3), 0.0, height)]
    lid = box((length, width, 0.012), (0, 0, height - 0.006))
    if kind == 1:
        return [lid, *(box((length, 0.012, height), (0, s * (width / 2 - 0.006), height / 2)) for s in BOTH)]
    rail = about_x(extrude(section_channel(height - 0.012, 0.4 * height + 0.01, 0.006, 0.008), -length / 2, length / 2))
    pose = at(0, width / 2, (height - 0.012) / 2) @ spun("z", np.pi)
    return [lid, moved(rail, at(0, -width / 2, (height - 0.012) / 2)), moved(rail, pose)]


_PLATES = "a block, a tray, two channels under a plate"


def _port(face: tuple[float, float, float], way: tuple[float, float, float], dn: int) -> Port:
    return Port(looking(face, way), dn)


class EndSuction(Pump, name="pump/end suction frame", sizes=(40, 50, 65, 80, 100, 125, 150), weight=3):
    """A close-coupled or frame-mounted end-suction pump (EN 733): volute, discharge up, motor behind, guard."""

    wide: float = between(0.85, 1.2, "radius of the casing / that by its nominal size")
    seat: float = among((0.02, 0.08, 0.12), "height of the base plate", "m")
    aside: float = among((0.0, 0.55), "from the shaft's line to the discharge / radius")
    close: bool = chance(0.4, "the motor is flanged to the casing")
    guarded: bool = chance(0.75, "a guard over the coupling", when=lambda p: not p.close)
    motor: RibbedMotor = driven(RibbedMotor, "motor")
    plate: int = whole(0, 2, _PLATES, when=lambda p: p.seat > 0.05)
    bolted: bool = chance(0.5, "anchor bolts in the base plate")

    def build(self, t: Table) -> Model:
        dn, out, seat, s = self.dn, smaller(self.dn), self.seat, (t.pipe.outer / 0.0889) ** 0.6
        r, half, axis = 0.13 * s * self.wide, 0.045 * s, seat + 0.17 * s
        n, lying = t.n(r), t.at(0, 0, axis).along("x")
        shape = outline(0.7 * r, -half, r, -0.6 * half, r, 0.6 * half, 0.75 * r, half, 0.6 * r, 1.5 * half)
        reach, rise, offset = 0.11 * s + 0.03, 0.2 * s + 0.03, self.aside * r
        suction = moved(along("x", disc_flange(dn, t.style, reach)), at(-reach))
        discharge = moved(along("-z", disc_flange(out, t.style, rise - 0.3 * r)), at(0, offset, rise))
        t.at(0, 0, axis).add(CASING, along("x", turned(shape, n)), suction, discharge)
        motor, length, start = 0.1 * s, 0.34 * s, 1.5 * half
        if self.close:
            lantern = outline(0.75 * r, 0, 0.8 * motor, 0.25 * length, 0.95 * motor, 0.3 * length)
            lying.at(0, 0, start).add(CASING, turned(lantern, n))
            far = start + 0.3 * length
        else:
            shape = outline(0.55, 0, 0.4, 0.1, 0.35, 0.6, 0.42, 0.62, 0.42, 0.7)
            lying.at(0, 0, start).add(CASING, turned([(a * r, b * length) for a, b in shape], n))
            mid = start + 0.7 * length
            hub = [cylinder(0.3 * motor, 0, 0.15 * length, n), cylinder(0.42 * motor, 0.04 * length, 0.11 * length, n)]
            lying.at(0, 0, mid + 0.05 * length).add("shaft", *hub)
            if self.guarded:
                guard = about_x(extrude(_arch(0.62 * motor, axis - seat), 0.0, 0.22 * length))
                t.at(mid + 0.01 * length, 0, axis).add("coupling guard", guard, own=False)
            far = mid + 0.27 * length
        self.motor.build(t.at(far, 0, axis).moved(LYING), motor, length, axis - seat)
        if axis - seat > 0.75 * r:
            tall = axis - seat - 0.7 * r
            t.add(CASING, box((1.2 * half, 1.1 * r, tall), (0, 0, seat + tall / 2)))
        end, wide = far + length, max(motor, 0.8 * r)
        plate = _plate(self.plate, end + 0.7 * r, 2.3 * wide, seat)
        t.at((end - 0.5 * r) / 2).add("pump base", *plate, own=False)
        if self.bolted:
            bolt = merge([cylinder(0.008, seat - 0.01, seat + 0.03, 8), hexagon(0.024, seat, seat + 0.014)])
            for x, y in ((0.1, 1), (0.1, -1), (0.9, 1), (0.9, -1)):
                t.at(x * end, y * 0.95 * wide).add("bolt", bolt, own=False)
        ports = _port((-reach, 0, axis), (-1, 0, 0), dn), _port((0, offset, axis + rise), (0, 0, 1), out)
        return t.model(ports=ports, kind="centrifugal pump")


def _arch(r: float, below: float) -> Floats:
    """The outline of a sheet bent over a shaft, its legs down, in (y, z)."""
    a = np.linspace(0, np.pi, 13)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    lines = [np.vstack([[(q, -below)], q * unit, [(-q, -below)]]) for q in (r, 0.96 * r)]
    return np.vstack([lines[0], lines[1][::-1]])


class Inline(Pump, name="pump/inline", place="inline", sizes=(32, 40, 50, 65, 80, 100), weight=1.2):
    """An inline pump: flanges in one axis, the volute between them, the motor upright on a lantern."""

    wide: float = between(1.5, 2.0, "radius of the casing, less 3 cm / of the pipe")
    slender: float = between(2.4, 3.2, "length of the motor / its radius")
    motor: RibbedMotor = driven(RibbedMotor, "motor")

    def build(self, t: Table) -> Model:
        radius, neck = t.pipe.radius, 0.485 * t.flange.hub
        length = max(0.24, 5.0 * radius + 0.1)
        body = flanged_body(self.dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        r = self.wide * radius + 0.03
        n, z, motor, aside = t.n(r), radius + 0.03, 0.8 * r + 0.01, at(length / 2, 0.15 * r)
        shape = outline(0.7 * r, -0.8 * radius - 0.01, r, -0.5 * radius, r, 0.7 * radius, 0.85 * r, radius + 0.01)
        t.add(CASING, body, moved(turned([*shape, (0.85 * r, radius + 0.03)], n), aside))
        up = t.moved(aside)
        up.add(CASING, turned(outline(0.85 * r, z, 0.55 * r, z + 0.4 * r, 0.9 * motor, z + 0.9 * r), n))
        self.motor.build(up.at(0, 0, z + 0.9 * r), motor, self.slender * motor)
        return t.model(round(length, 6), kind="inline pump")


class Circulator(
    Device, group=PUMP, label="pump", bundle=CASING, name="pump/circulator", place="inline", sizes=(20, 25, 32, 40, 50)
):
    """A wet-rotor circulator: a small volute in the line, a round motor can to the side with a square control box."""

    behind: bool = chance(0.6, "the control box is on the end of the motor, not on its side")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r = 0.13 + 2.5 * radius, 0.035 + 1.1 * radius
        n, x = t.n(r), length / 2
        ends = outline(1.5, 0, 1.5, 0.12, 1.1, 0.14, 1.1, 0.86, 1.5, 0.88, 1.5, 1)
        body = turned([(a * radius, b * length) for a, b in ends], n, bore=bore_of(self.dn, t.style))
        volute = turned(outline(0.8 * r, -0.5 * r, r, -0.3 * r, r, 0.35 * r), n)
        t.add(CASING, along("x", body), along("y", volute, x))
        can = turned(outline(0.95 * r, 0.35 * r, 0.85 * r, 0.5 * r, 0.8 * r, 1.8 * r, 0.7 * r, 1.95 * r), n)
        motor = t.bundled("motor")
        motor.at(x).along("y").add("motor", can, of="handle")
        control = (1.4 * r, 0.8 * r, 1.3 * r), (x, 1.9 * r, 0.1 * r)
        if not self.behind:
            control = (r, 0.9 * r, 0.7 * r), (x, r, 1.1 * r)
        motor.add("terminal box", box(*control), of="rubber")
        return t.model(round(length, 6), "welded", "circulator")


class Multistage(Pump, name="pump/multistage", sizes=_MID, weight=1.5):
    """A vertical multistage pump: a foot with two flanges in line, a slim barrel with tie rods, lantern, motor."""

    tall: float = between(0.3, 0.9, "height of the barrel", "m")
    guarded: bool = chance(0.6, "a sheet in the lantern's window")
    slender: float = between(2.2, 3.0, "length of the motor / its radius")
    motor: RibbedMotor = driven(RibbedMotor, "motor")

    def build(self, t: Table) -> Model:
        dn, radius, tall = self.dn, t.pipe.radius, self.tall
        r = 1.9 * radius + 0.04
        n, centre, reach = t.n(r), 0.06 + 1.2 * radius + 0.3 * t.flange.outer, 0.12 + 2.4 * radius
        neck, low = 0.485 * t.flange.hub, centre + 0.06
        body = flanged_body(dn, t.style, 2 * reach, [(neck, 0.5 * reach), (neck, 1.5 * reach)])
        foot = turned(outline(1.5 * r, 0, 1.5 * r, 0.02, 1.05 * r, 0.04, 1.05 * r, low), n)
        t.add(CASING, moved(body, at(-reach, 0, centre)), foot)
        t.add(CASING, cylinder(0.85 * r, low, low + tall, n), of="trim")
        t.add("stud", around(cylinder(0.006, low - 0.02, low + tall + 0.02, 8), 4, 0.97 * r, np.pi / 4))
        z, motor = low + tall + 0.04, 1.15 * r
        posts = [box((0.25 * r, 0.9 * r, 0.9 * r), (s * 0.75 * r, 0, z + 0.45 * r)) for s in BOTH]
        head, plate = cylinder(1.1 * r, low + tall, z, n), cylinder(motor, z + 0.9 * r, z + 0.9 * r + 0.015, n)
        t.add(CASING, head, *posts, plate)
        t.add("shaft", cylinder(0.2 * r, z, z + 0.9 * r, 10))
        if self.guarded:
            a = np.linspace(0.3, np.pi - 0.3, 9)
            bow = r * np.column_stack([np.cos(a), np.sin(a)])
            sheet = extrude(np.vstack([0.7 * bow, 0.67 * bow[::-1]]), z + 0.1 * r, z + 0.8 * r)
            t.add("coupling guard", sheet, own=False)
        self.motor.build(t.at(0, 0, z + 0.9 * r + 0.013), motor, self.slender * motor)
        ports = [_port((s * reach, 0, centre), (s, 0, 0), dn) for s in BOTH]
        return t.model(ports=ports, kind="multistage pump")


class Gear(Pump, name="pump/gear", sizes=(25, 32, 40, 50, 65)):
    """A gear or lobe pump: an oblong block with ports on both sides, a shaft to a geared motor on a base."""

    motor: RibbedMotor = driven(RibbedMotor, "motor")
    plate: int = whole(0, 2, _PLATES)

    def build(self, t: Table) -> Model:
        dn, s, seat = self.dn, 1.6 * t.pipe.radius + 0.05, 0.08
        axis, reach = seat + 1.5 * s, 1.5 * s + 0.05
        level = t.at(0, 0, axis)
        oval = rounded_rectangle(1.6 * s, 2.6 * s, 0.75 * s, 6)
        block = [along("x", extrude(oval, -0.8 * s, 0.8 * s)), along("x", extrude(0.9 * oval, -1.1 * s, 1.05 * s))]
        mouth = disc_flange(dn, t.style, reach)
        heads = [moved(along(way, mouth), at(0, y * reach)) for way, y in (("y", -1), ("-y", 1))]
        level.add(CASING, *block, *heads)
        bolt = hexagon(0.3 * s, 1.05 * s, 1.15 * s)
        level.along("x").add("bolt", *(moved(bolt, at(x * 0.55 * s, y * s)) for x in BOTH for y in (-1, 0, 1)))
        hubs = [cylinder(0.5 * s, low * s, (low + 0.35) * s, 14) for low in (1.6, 2.0)]
        level.along("x").add("shaft", cylinder(0.2 * s, 1.0 * s, 2.4 * s, 12), *hubs)
        gearbox = [
            box((1.4 * s, 1.6 * s, 2.0 * s), (3.3 * s, 0, 0)),
            along("x", cylinder(0.7 * s, 2.4 * s, 2.7 * s, 14)),
        ]
        level.bundled("motor").add("motor", *gearbox)
        self.motor.build(level.at(3.95 * s).moved(LYING), 0.9 * s, 3.0 * s, axis - seat)
        for x, low in ((0, s), (3.3 * s, 0.95 * s)):
            tall = axis - seat - low
            t.add("pump base", box((1.2 * s, 1.2 * s, tall), (x, 0, seat + tall / 2)), own=False)
        t.at(3.0 * s).add("pump base", *_plate(self.plate, 8.5 * s, 2.6 * s, seat), own=False)
        return t.model(ports=[_port((0, y * reach, axis), (0, y, 0), dn) for y in BOTH], kind="gear pump")


class _Undriven(Device, group=PUMP, label="pump", bundle=CASING):
    """A pump whose motor is in its casing, or that has none."""


class Diaphragm(_Undriven, name="pump/diaphragm", sizes=(15, 20, 25, 40, 50)):
    """An air-operated double-diaphragm pump: two round chambers, manifolds above and below, feet."""

    def build(self, t: Table) -> Model:
        dn, radius = self.dn, t.pipe.radius
        r = 2.4 * radius + 0.06
        n, gap, axis, front = t.n(r), 0.45 * r, 1.35 * r + 0.04, 0.6 * r + 0.05
        reach, level, ways = gap + 0.4 * r, t.at(0, 0, axis), ("x", "-x")
        chamber = moved(turned(outline(r, 0, r, 0.12 * r, 0.75 * r, 0.35 * r, 0.25 * r, 0.55 * r), n), at(0, 0, gap))
        rim = cylinder(1.08 * r, gap - 0.06 * r, gap + 0.06 * r, n)
        level.add(CASING, *(along(way, chamber) for way in ways), *(along(way, rim) for way in ways))
        level.add(CASING, box((2 * gap, 0.9 * r, 0.9 * r)), box((0.6 * gap, 1.3 * r, 0.4 * r)), of="steel")
        pipes, heads = [], []
        for s in BOTH:
            z = s * 1.15 * r
            pipes.append(along("x", cylinder(1.1 * radius, -reach, reach, n), 0, 0, z))
            pipes += [rod((x * reach, 0, z), (x * reach, 0, s * 0.6 * r), 1.1 * radius, n) for x in BOTH]
            pipes += [moved(ball(1.15 * radius, n), at(x * reach, 0, z)) for x in BOTH]
            heads.append(moved(along("y", disc_flange(dn, t.style, front)), at(0, -front, z)))
        level.add(CASING, *pipes, *heads, of="trim")
        feet = [box((0.25 * r, 0.9 * r, 0.03), (x * (gap + 0.2 * r), 0, 0.015)) for x in BOTH]
        legs = [box((0.15 * r, 0.15 * r, axis - r), (x * (gap + 0.2 * r), 0, (axis - r) / 2)) for x in BOTH]
        t.add("pump base", *feet, *legs, own=False)
        clamps = around(hexagon(0.12 * r, gap - 0.1 * r, gap + 0.1 * r), 8, 1.04 * r)
        level.add("bolt", *(along(way, clamps) for way in ways))
        ports = [_port((0, -front, axis + s * 1.15 * r), (0, -1, 0), dn) for s in BOTH]
        return t.model(ports=ports, kind="diaphragm pump")


class Dosing(_Undriven, name="pump/dosing", sizes=(15,)):
    """A dosing pump: a box with a keypad, a round head aside with small valves above and below, thin tubes."""

    size: float = between(0.8, 1.3, "of all of it / 20 cm")

    def build(self, t: Table) -> Model:
        s, x = self.size, 0.122 * self.size
        case = extrude(rounded_rectangle(0.2 * s, 0.12 * s, 0.02, 3), 0.02, 0.17 * s)
        knob = moved(cylinder(0.02 * s, 0.17 * s, 0.19 * s, 14), at(-0.04 * s))
        panel = box((0.1 * s, 0.004, 0.06 * s), (-0.01, -0.061 * s, 0.1 * s))
        t.bundled("motor").add("motor", case, knob, panel, of="pump")
        screws = around(hexagon(0.012, 0.14 * s, 0.15 * s), 4, 0.035 * s, 0.78)
        head = merge([cylinder(0.045 * s, 0.1 * s, 0.145 * s, t.n(0.045)), screws])
        valves = merge([hexagon(0.025 * s, 0.01 * s, 0.045 * s), hexagon(0.025 * s, 0.135 * s, 0.17 * s)])
        tubes = rope([(x, 0, 0.16 * s), (x, 0, 0.24 * s), (0.2 * s, 0, 0.3 * s)], 0.005, 8)
        t.add(CASING, along("x", head, 0, 0, 0.09 * s), moved(valves, at(x)), tubes, of="trim")
        t.add("pump base", box((0.22 * s, 0.14 * s, 0.02), (0, 0, 0.01)), of="rubber", own=False)
        return t.model(kind="dosing pump")


class Submersible(_Undriven, name="pump/submersible", sizes=_MID):
    """A submersible pump: a volute on feet, the motor upright above, discharge elbow, handle, cable."""

    tall: float = between(1.8, 3.0, "height of the motor / radius of the casing")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        r = 2.0 * radius + 0.05
        n, tall, thick = t.n(r), self.tall * r, plate_thickness(self.dn)
        feet = around(box((0.15 * r, 0.15 * r, 0.12 * r), (0, 0, 0.06 * r)), 3, 0.8 * r)
        volute = turned(outline(r, 0.1 * r, 1.25 * r, 0.2 * r, 1.25 * r, 0.7 * r, 0.85 * r, 0.85 * r), n)
        reach = 1.3 * r + 0.25 * r
        x, top = reach + 0.3 * r, 1.3 * r + thick
        path = [(1.0 * r, 0, 0.45 * r), (reach, 0, 0.45 * r), (x, 0, 0.75 * r), (x, 0, 1.3 * r)]
        head = moved(disc_flange(self.dn, t.style, thick), at(x, 0, top) @ spun("x", np.pi))
        t.add(CASING, feet, volute, rope(path, 1.05 * radius, n), head)
        can = outline(0.8 * r, 0.8 * r, 0.8 * r, 0.8 * r + tall, 0.65 * r, 0.95 * r + tall, 0.3 * r, 1.0 * r + tall)
        bow = [(x * r, 0, z * r + tall) for x, z in outline(-0.4, 0.95, -0.4, 1.25, 0.4, 1.25, 0.4, 0.95)]
        t.bundled("motor").add("motor", turned(can, n), rope(bow, 0.05 * r, 8))
        cable = [(0, 0.3 * r, r + tall - 0.05 * r), (0, 0.4 * r, 1.5 * r + tall), (0.2 * r, 1.2 * r, 2.2 * r + tall)]
        t.add("cable", rope(cable, 0.008, 8))
        return t.model(ports=[_port((x, 0, top), (0, 0, 1), self.dn)], kind="submersible pump")


class LaidImpeller(_Undriven, name="pump/impeller", sizes=(15,), weight=1.2):
    """An impeller laid out beside a pump: two shrouds or one, curved vanes, a hub; on a shaft."""

    radius: float = between(0.05, 0.2, "of the wheel", "m")
    vanes: int = whole(4, 7, "vanes")
    closed: bool = chance(0.4, "a second shroud in front")

    def build(self, t: Table) -> Model:
        r = self.radius
        n, a = t.n(r), np.linspace(0, 1.2, 7)
        line = np.column_stack([(0.3 + 0.68 * a / 1.2) * r * np.cos(a), (0.3 + 0.68 * a / 1.2) * r * np.sin(a)])
        back = line[::-1] @ np.array([[np.cos(0.08), np.sin(0.08)], [-np.sin(0.08), np.cos(0.08)]])
        vane = extrude(np.vstack([line, back]), 0.045 * r, 0.25 * r)
        wheel = [
            ring(0.12 * r, r, 0.0, 0.05 * r, n),
            around(vane, self.vanes),
            ring(0.12 * r, 0.28 * r, 0.0, 0.35 * r, n),
        ]
        if self.closed:
            wheel.append(ring(0.45 * r, r, 0.25 * r, 0.3 * r, n))
        lying = t.at(0, 0, r).along("x")
        lying.add("impeller", *wheel, own=False)
        shaft = outline(0.11, -0.9, 0.11, 0.4, 0.08, 0.4, 0.08, 0.5)
        step = outline(0.16, -2.5, 0.16, -0.9, 0.13, -0.9, 0.13, -0.1)
        solids = [turned([(x * r, z * r) for x, z in shape], max(8, n)) for shape in (shaft, step)]
        lying.add("shaft", *solids, own=False)
        t.add("pump base", box((0.3 * r, 0.6 * r, 0.84 * r), (-1.8 * r, 0, 0.42 * r)), own=False)
        return t.model(kind="centrifugal pump")


class Packaged(
    Driven,
    name="compressor/packaged",
    group="Equipment",
    label="compressor",
    bundle="compressor",
    sizes=(15,),
    weight=1.6,
):
    """A piston compressor on its air receiver, or a screw compressor's cabinet with grilles."""

    piston: bool = chance(0.55, "a piston compressor on its receiver")
    radius: float = between(0.18, 0.32, "of the receiver", "m", when=lambda p: p.piston)
    slender: float = between(3.0, 4.5, "length of the receiver / its radius", when=lambda p: p.piston)
    motor: RibbedMotor = driven(RibbedMotor, "motor", when=lambda p: p.piston)
    width: float = between(1.0, 2.2, "of the cabinet", "m", when=lambda p: not p.piston)
    depth: float = between(0.7, 1.1, "of the cabinet", "m", when=lambda p: not p.piston)
    height: float = between(1.0, 1.8, "of the cabinet", "m", when=lambda p: not p.piston)

    def build(self, t: Table) -> Model:
        if self.piston:
            self._on_receiver(t)
        else:
            self._cabinet(t)
        return t.model(kind="compressor")

    def _on_receiver(self, t: Table) -> None:
        r, name = self.radius, "compressor"
        length, n, axis = self.slender * r, t.n(r), r + 0.14
        end = dome(r, 0.35 * r, 0.0, n)
        ends = [moved(end, at(0, 0, length / 2)), moved(end, at(0, 0, -length / 2) @ spun("x", np.pi))]
        t.at(0, 0, axis).along("x").add(name, cylinder(r, -length / 2, length / 2, n), *ends, of="tank")
        leg = (0.05, 0.25 * r, 0.16 + 0.2 * r)
        legs = [box(leg, (x, y, leg[2] / 2)) for x, y in corners(0.4 * length, 0.6 * r)]
        t.add(name, *legs, box((0.8 * length, 1.2 * r, 0.02), (0, 0, axis + r + 0.02)), of="steel")
        left, z = -0.25 * length, axis + r + 0.03
        fins = [cylinder(0.34 * r, 0.15 * r * k, 0.15 * r * k + 0.05 * r, 14) for k in range(1, 6)]
        head = merge([cylinder(0.25 * r, 0, 0.8 * r, 14), *fins])
        heads = [moved(head, at(left, 0, z + 0.6 * r) @ spun("x", a)) for a in (-0.5, 0.5)]
        t.add(name, box((0.5 * r, 0.6 * r, 0.7 * r), (left, 0, z + 0.35 * r)), *heads, of="pump")
        wheel = ring(0.3 * r, 0.75 * r, 0.0, 0.12 * r, n)
        t.at(left, 0.35 * r, z + 0.45 * r).along("y").add(name, wheel, of="trim")
        pose = at(0.25 * length, 0.3 * r, z + 0.4 * r) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2)
        self.motor.build(t.moved(pose), 0.4 * r, 1.1 * r)

    def _cabinet(self, t: Table) -> None:
        w, d, h, name = self.width, self.depth, self.height, "compressor"
        hood = box((0.4 * w, 0.5 * d, 0.12), (0.2 * w, 0, h + 0.06))
        t.add(name, box((w, d, h - 0.1), (0, 0, 0.1 + (h - 0.1) / 2)), hood, of="motor")
        t.add(name, *(box((w, 0.1, 0.1), (0, s * (d / 2 - 0.05), 0.05)) for s in BOTH), of="steel")
        slots = [box((0.35 * w, 0.01, 0.012), (0.25 * w, -d / 2 - 0.004, 0.5 * h + 0.03 * k)) for k in range(8)]
        door = box((0.45 * w, 0.015, 0.8 * h), (-0.24 * w, -d / 2 - 0.007, 0.1 + 0.42 * h))
        t.add(name, *slots, door, of="electrical")
        t.add("control panel", box((0.2, 0.03, 0.15), (-0.24 * w, -d / 2 - 0.02, 0.75 * h)), of="rubber")


class Radial(Driven, name="blower/radial", group="Equipment", label="blower", bundle="blower", sizes=(15,), weight=1.6):
    """A radial fan: a spiral housing with an inlet cone and a square outlet, its motor on a frame."""

    radius: float = between(0.2, 0.45, "of the wheel", "m")
    wide: float = between(0.35, 0.7, "width of the housing / radius")
    motor: RibbedMotor = driven(RibbedMotor, "motor")

    def build(self, t: Table) -> Model:
        r, wide = self.radius, self.wide * self.radius
        n, axis = t.n(r), 1.45 * r + 0.05
        a = np.linspace(0, 2 * np.pi, max(14, n), endpoint=False)
        spiral = (0.85 + 0.5 * a / (2 * np.pi))[:, None] * r * np.column_stack([np.cos(a), np.sin(a)])
        house = extrude(spiral, -wide / 2, wide / 2)
        outlet = box((0.5 * r, 0.9 * r, wide), (1.08 * r, 0.42 * r, 0))
        lip = box((0.6 * r, 0.03, 1.12 * wide), (1.08 * r, 0.88 * r, 0))
        cone = turned(outline(0.5 * r, 0, 0.62 * r, 0.25 * r, 0.66 * r, 0.25 * r, 0.66 * r, 0.28 * r), n)
        solids = house, outlet, lip, moved(cone, at(0, 0, wide / 2 - 0.01))
        t.at(0, 0, axis).spun("x", np.pi / 2).add("blower", *solids, of="motor")
        tall, y = axis - 0.3 * r, 0.5 * wide
        frame = [box((0.08, 1.2 * r + wide, 0.06), (s * 0.6 * r, 0.4 * r, 0.03)) for s in BOTH]
        frame += [box((0.06, 0.06, tall), (s * 0.6 * r, y + 0.1, tall / 2)) for s in BOTH]
        t.add("blower", *frame, box((1.3 * r, 0.8 * r, 0.02), (0, y + 0.45 * r, tall)), of="steel")
        pose = at(0, y + 0.02, axis) @ spun("x", -np.pi / 2) @ spun("z", -np.pi / 2)
        self.motor.build(t.moved(pose), 0.28 * r, 0.8 * r)
        return t.model(kind="blower")


ROTATING = families_of(
    EndSuction, Inline, Circulator, Multistage, Gear, Diaphragm, Dosing, Submersible, LaidImpeller, Packaged, Radial
)
