"""Pumps of primitives: casings of cylinders and boxes with snouts, motors beside or over them, at times in one mesh."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import Plates, Snout, cone, disc, dish, lying, plated, rods, snout_of
from cadplants.model.family import Family, Model, Port
from cadplants.model.standards import PIPES, sizes_between, smaller
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import box
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["PRIMITIVE_PUMPS"]


class _Motor(Params):
    """A motor: a cylinder, with a narrower end, a dish or neither."""

    narrowed: bool = chance(0.4, "a narrower end")
    domed: bool = chance(0.35, "a dish at its end")

    def solids(self, r: float, length: float, style: ModelingStyle) -> list[Solid]:
        """About z from 0 up [m]."""
        solids = [disc(r, 0.0, length, style)]
        if self.narrowed:
            solids.append(disc(0.85 * r, length, 1.12 * length, style))
        if self.domed:
            solids.append(dish(r, 0.3 * r, length, style))
        return solids


class _Pump(Device, group="Pump unit", label="pump", bundle="pump casing"):
    """A pump of primitives."""


class CylindersAndBoxes(_Pump, name="pump/cylinders and boxes", sizes=sizes_between(40, 150), weight=4):
    """A pump along x on a base: a flat cylinder or a box with two snouts, a motor, something between them."""

    volute: float = between(1.8, 2.6, "(radius of the casing - 30 mm) / of the suction pipe")
    lift: float = between(0.12, 0.3, "height of the casing's underside", "m")
    reach: float = between(0.8, 1.4, "(reach of the suction - 50 mm) / radius of the casing")
    rise: float = between(0.1, 0.2, "of the discharge over the casing", "m")
    radius: float = between(0.6, 1.0, "radius of the motor / of the casing")
    length: float = between(1.8, 3.0, "length of the motor / radius of the casing")
    thick: float = between(0.35, 0.6, "half the thickness of the casing / its radius")
    boxed: bool = chance(0.25, "the casing is a box")
    coned: bool = chance(0.3, "a cone behind the casing", when=lambda p: not p.boxed)
    suction: Snout = snout_of(lambda p: p.dn, "suction")
    discharge: Snout = snout_of(lambda p: smaller(p.dn), "discharge")
    apart: float = between(0.2, 0.5, "from casing to motor / length of the motor")
    shaft: float = between(0.15, 0.35, "radius of the shaft / of the motor")
    guarded: bool = chance(0.4, "a guard over the coupling")
    motor: _Motor = nested(_Motor, "motor")
    wired: bool = chance(0.4, "a terminal box")
    low: float = between(0.05, 0.12, "height of the base", "m")
    founded: bool = chance(0.5, "a foundation")
    deep: float = between(0.1, 0.4, "depth of the foundation", "m", when=lambda p: p.founded)

    def build(self, t: Table) -> Model:
        style, low, volute = t.style, self.low, t.pipe.radius * self.volute + 0.03
        axis, reach, rise = volute + self.lift, volute * self.reach + 0.05, volute + self.rise
        radius, length, thick = volute * self.radius, volute * self.length, volute * self.thick
        casing = [box((2 * thick, 1.8 * volute, 1.8 * volute))]
        if not self.boxed:
            casing = [lying(disc(volute, -thick, thick, style))]
        if self.coned:
            casing.append(lying(cone(volute, 0.4 * volute, thick, 2.2 * thick, style)))
        casing.append(moved(self.suction.solid(0.0, reach, style), spun("y", -np.pi / 2)))
        casing.append(self.discharge.solid(0.0, rise, style))
        level = t.at(0, 0, axis)
        level.add("pump casing", *casing)
        start = thick + length * self.apart
        level.add("shaft", lying(disc(radius * self.shaft, 0.5 * thick, start, style)))
        if self.guarded:
            guard = (0.7 * (start - thick), 0.9 * radius, 0.9 * radius)
            level.add("coupling guard", box(guard, ((start + thick) / 2, 0, 0)))
        motor = [lying(one, start) for one in self.motor.solids(radius, length, style)]
        level.bundled("motor").add("motor", *motor)
        if self.wired:
            side = box((0.3 * length, 0.5 * radius, 0.5 * radius), (start + 0.5 * length, 0, 1.1 * radius))
            level.bundled("motor").add("terminal box", side)
        left, right = -1.2 * thick, start + length
        plate = box((right - left + 0.1, 2.2 * radius + 0.1, low), ((left + right) / 2, 0, low / 2))
        feet = [box((1.6 * thick, volute, axis - low), (0, 0, (axis + low) / 2))]
        feet.append(box((0.6 * length, 1.4 * radius, axis - low), (start + 0.5 * length, 0, (axis + low) / 2)))
        t.bundled("pump base").add("pump base", plate, *feet)
        if self.founded:
            size = (right - left + 0.3, 2.4 * radius + 0.3, self.deep)
            t.at((left + right) / 2).add("foundation", box(size, (0, 0, -self.deep / 2)))
        ports = (
            Port(looking((-reach, 0, axis), (-1, 0, 0)), self.dn),
            Port(looking((0, 0, axis + rise), (0, 0, 1)), self.discharge.dn),
        )
        return t.model(kind="centrifugal pump", ports=ports)


class MotorOnLine(_Pump, name="pump/motor on line", place="inline", sizes=sizes_between(15, 150), weight=2):
    """A cylinder in the line, with discs at its ends or none, and a motor upright or level on it; at times one mesh."""

    length: float = between(1.2, 2.0, "face to face / outside of the flange")
    wide: float = between(1.3, 2.0, "radius of the casing / of the pipe")
    radius: float = between(0.6, 0.95, "radius of the motor / of the casing")
    tall: float = between(1.5, 3.0, "(length of the motor - 50 mm) / radius of the casing")
    motor: _Motor = nested(_Motor, "motor")
    tilt: float = among((0.0, 0.0, 0.5), "of the motor from upright / half a turn")
    joint: str = among(("flanged", "welded"), "how it sits in its line", when=lambda p: p.dn <= 50, otherwise="flanged")
    plates: Plates = plated(lambda p: p.joint == "flanged")
    lantern: float = among((0.0, 0.0, 0.6, 1.2), "length of a lantern under the motor / radius of the casing")
    wired: bool = chance(0.5, "a terminal box on the motor")
    in_one: bool = chance(0.4, "all of it is one mesh")

    def build(self, t: Table) -> Model:
        r, length, style = t.pipe.radius, round(t.flange.outer * self.length, 6), t.style
        wide = r * self.wide
        middle = moved(disc(wide, -0.8 * r, 1.1 * r, style), at(length / 2))
        plates = self.plates.solids(t, length) if self.plates else []
        casing = [lying(disc(r, 0.0, length, style)), middle, *plates]
        radius, tall, foot = wide * self.radius, wide * self.tall + 0.05, wide * self.lantern
        motor = [moved(one, at(0, 0, foot)) for one in self.motor.solids(radius, tall, style)]
        if foot:
            motor.append(disc(0.7 * radius, 0.0, foot, style))
        if self.wired:
            size = (0.6 * radius, 0.9 * radius, 0.9 * radius)
            motor.append(box(size, (1.15 * radius, 0, foot + 0.5 * tall)))
        up = at(length / 2, 0, r) @ spun("x", self.tilt * np.pi)
        if self.in_one:
            t.add("pump", *casing, *(moved(one, up) for one in motor), of="pump")
        else:
            t.add("pump casing", *casing)
            t.bundled("motor").moved(up).add("motor", *motor)
        return t.model(length, self.joint, "circulator")


class UprightInLine(_Pump, name="pump/upright stages", sizes=sizes_between(15, 100), weight=2):
    """An upright multistage pump: a foot with two snouts in one axis, a tall cylinder, a motor; maybe one mesh."""

    wide: float = between(1.4, 2.4, "(radius of the stages - 20 mm) / of the pipe")
    tall: float = between(2.0, 6.0, "height of the stages / their radius")
    radius: float = between(0.7, 1.2, "radius of the motor / of the stages")
    long: float = between(1.8, 3.0, "length of the motor / its radius")
    reach: float = between(1.2, 2.0, "(from the axis to a face - 50 mm) / radius of the stages")
    low: float = between(0.06, 0.16, "height of the snouts' axis - radius of the pipe", "m")
    rods: int = among((0, 4, 4), "tie rods along the stages")
    square: bool = chance(0.5, "its foot is a square plate")
    snout: Snout = snout_of(lambda p: p.dn, "each side")
    motor: _Motor = nested(_Motor, "motor")
    in_one: bool = chance(0.6, "all of it is one mesh")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        wide, axis = r * self.wide + 0.02, r + self.low
        reach, foot, top = wide * self.reach + 0.05, axis + 1.2 * r, axis + 1.2 * r + wide * self.tall
        plate = box((2.6 * wide, 2.6 * wide, 0.02), (0, 0, 0.01)) if self.square else disc(1.3 * wide, 0.0, 0.02, style)
        casing = [plate, disc(1.05 * wide, 0.02, foot, style), disc(wide, foot, top, style)]
        for side in (1.0, -1.0):
            casing.append(moved(self.snout.solid(0.0, reach, style), at(0, 0, axis) @ spun("y", side * np.pi / 2)))
        casing += rods(self.rods, 1.1 * wide, 0.08 * wide, foot, top, style)
        radius = wide * self.radius
        lantern = disc(0.8 * wide, top, top + 0.6 * wide, style)
        motor = [moved(one, at(0, 0, top + 0.6 * wide)) for one in self.motor.solids(radius, radius * self.long, style)]
        if self.in_one:
            t.add("pump", *casing, lantern, *motor, of="pump")
        else:
            t.add("pump casing", *casing, lantern)
            t.bundled("motor").add("motor", *motor)
        faces = [Port(looking((side * reach, 0, axis), (side, 0, 0)), self.dn) for side in (-1.0, 1.0)]
        return t.model(kind="centrifugal pump", ports=(faces[0], faces[1]))


class CloseCoupled(_Pump, name="pump/close coupled", sizes=sizes_between(25, 100), weight=2):
    """A flat round casing with a snout in front and one beside or on top, the motor flanged to it; maybe one mesh."""

    volute: float = between(1.6, 2.6, "(radius of the casing - 20 mm) / of the pipe")
    thick: float = between(0.5, 0.9, "thickness of the casing / its radius")
    reach: float = between(0.04, 0.14, "of the suction before the casing", "m")
    rise: float = between(0.05, 0.16, "of the discharge over the casing", "m")
    tangent: bool = chance(0.6, "the discharge leaves at the rim, not from the middle")
    rim: float = among((0.0, 1.06, 1.1), "radius of a clamp or flange round the casing / of the casing; 0: none")
    radius: float = between(0.65, 1.1, "radius of the motor / of the casing")
    long: float = between(1.8, 3.4, "length of the motor / its radius")
    lift: float = between(0.1, 0.25, "height of the casing's underside", "m")
    legs: str = among(("legs", "box", "plate"), "what it stands on")
    snout: Snout = snout_of(lambda p: p.dn, "suction")
    other: Snout = snout_of(lambda p: smaller(p.dn), "discharge")
    motor: _Motor = nested(_Motor, "motor")
    wired: bool = chance(0.6, "a terminal box")
    in_one: bool = chance(0.6, "all of it is one mesh")

    def build(self, t: Table) -> Model:
        style, volute = t.style, t.pipe.radius * self.volute + 0.02
        thick, axis = volute * self.thick, volute + self.lift
        aside = (volute - 1.05 * PIPES[self.other.dn].radius) if self.tangent else 0.0
        casing = [lying(disc(volute, 0.0, thick, style))]
        if self.rim:
            casing.append(lying(disc(volute * self.rim, thick - 0.014, thick, style)))
        casing.append(moved(self.snout.solid(-0.5 * thick, self.reach, style), spun("y", -np.pi / 2)))
        up = at(0.5 * thick, aside, 0.0)
        casing.append(moved(self.other.solid(0.0, volute + self.rise, style), up))
        radius = volute * self.radius
        length = radius * self.long
        motor = [lying(disc(0.75 * radius, thick, thick + 0.5 * volute, style))]
        motor += [lying(one, thick + 0.5 * volute) for one in self.motor.solids(radius, length, style)]
        start = thick + 0.5 * volute
        if self.wired:
            motor.append(box((0.4 * length, 0.8 * radius, 0.6 * radius), (start + 0.4 * length, 0, 1.2 * radius)))
        feet = self._feet(t, start, length, radius, axis)
        level = t.at(0, 0, axis)
        if self.in_one:
            level.add("pump", *casing, *motor, *feet, of="pump")
        else:
            level.add("pump casing", *casing)
            level.bundled("motor").add("motor", *motor)
            level.bundled("pump base").add("pump base", *feet)
        ports = (
            Port(looking((-self.reach, 0, axis), (-1, 0, 0)), self.dn),
            Port(looking((0.5 * thick, aside, axis + volute + self.rise), (0, 0, 1)), self.other.dn),
        )
        return t.model(kind="centrifugal pump", ports=ports)

    def _feet(self, t: Table, start: float, length: float, radius: float, axis: float) -> list[Solid]:
        places = [(start + share * length, side * 0.75 * radius) for share in (0.2, 0.8) for side in (1, -1)]
        if self.legs == "legs":
            return [moved(disc(0.12 * radius, -axis, -0.4 * radius, t.style), at(x, y)) for x, y in places]
        if self.legs == "box":
            return [box((0.7 * length, 1.2 * radius, axis), (start + 0.5 * length, 0, -axis / 2))]
        plate = box((1.2 * length, 2.0 * radius, 0.02), (start + 0.5 * length, 0, 0.01 - axis))
        return [plate, *(box((0.1 * radius, 0.4 * radius, axis), (x, y, -axis / 2)) for x, y in places)]


class BoxAndCylinder(_Pump, name="pump/box and cylinder"):
    """A box with a cylinder on or beside it: a dosing or gear pump."""

    length: float = between(0.15, 0.4, "of the box", "m")
    wide: float = between(0.12, 0.3, "of the box", "m")
    high: float = between(0.15, 0.4, "of the box", "m")
    side: float = between(0.1, 0.3, "length of the cylinder beside it", "m")
    top: float = between(0.1, 0.3, "height of the cylinder on it", "m")

    def build(self, t: Table) -> Model:
        a, b, c, style = self.length, self.wide, self.high, t.style
        r = 0.35 * b
        side = lying(disc(r, a / 2, a / 2 + self.side, style), 0, 0, 0.5 * c)
        t.add("pump casing", box((a, b, c), (0, 0, c / 2)), side)
        t.bundled("motor").add("motor", moved(disc(r, 0.0, self.top, style), at(0, 0, c)))
        t.bundled("pump base").add("pump base", box((a + 0.1, b + 0.1, 0.04), (0, 0, -0.02)))
        return t.model(kind="dosing pump")


PRIMITIVE_PUMPS: tuple[Family, ...] = families_of(
    CylindersAndBoxes,
    MotorOnLine,
    UprightInLine,
    CloseCoupled,
    BoxAndCylinder,
)
