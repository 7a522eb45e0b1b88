"""End-suction pumps of plain shapes: casing, bearing housing, shaft, guard, motor and bed, each one simple solid."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, LYING, dead_room
from cadplants.families.machines.plain_parts import PlainBed, PlainGuard, PlainMotor, PlainPort, PlainPump, port_of
from cadplants.model.family import Model, Port
from cadplants.model.standards import PIPES, smaller
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, lofted, turned

__all__ = ["PLAIN_PUMPS"]

_BEARINGS = ("cylinder", "cylinder", "stepped", "cone", "box", "lantern")


def _snail(r: float, half: float, growth: float, n: int) -> Solid:
    """A flat spiral about z that widens by a share of its radius [m]."""
    a = np.linspace(0, 2 * np.pi, max(8, n), endpoint=False)
    rim = (r * (1 + growth * a / (2 * np.pi)))[:, None] * np.column_stack([np.cos(a), np.sin(a)])
    loops = [np.column_stack([f * rim, np.full(len(a), z)]) for f, z in ((0.9, -half), (1, 0.0), (0.9, half))]
    return lofted(loops)


class _EndSuction(PlainPump, sizes=(25, 32, 40, 50, 65, 80, 100, 125, 150)):
    """An end-suction pump: a casing about x with a mouth in front and one up."""

    wide: float = between(1.6, 3.0, "(radius of the casing - 40 mm) / of the suction pipe")
    thick: float = between(0.22, 0.55, "half the width of the casing / its radius")
    casing: str = among(("drum", "drum", "bevelled", "stepped", "snail", "doubled"), "form of the casing")
    aside: float = among((0.0, 0.0, 0.6, 0.8, -0.6), "from the shaft's line to the discharge / radius")
    lift: float = between(1.1, 1.9, "height of the shaft over the bed / radius of the casing")
    front: float = between(0.0, 0.8, "further reach of the suction / radius of the casing")
    up: float = between(0.0, 0.9, "further rise of the discharge / radius of the casing")
    suction: PlainPort = port_of(lambda p: p.dn, "suction")
    discharge: PlainPort = port_of(lambda p: smaller(p.dn), "discharge")
    foot: str = among(("block", "plate", "legs", "none"), "what the casing stands on")

    def radius(self, t: Table) -> float:
        """Of the casing [m]."""
        return t.pipe.radius * self.wide + 0.04

    def put_casing(self, t: Table, r: float, axis: float, seat: float) -> tuple[Port, Port]:
        """Puts the casing down about an axis along x, its middle over 0; its ports."""
        half, n = self.thick * r, self.n(t, r)
        back = PIPES[self.discharge.dn].radius * self.discharge.wide
        aside = float(np.clip(self.aside * r, back - r, r - back)) if r > back else 0.0
        reach, rise = dead_room(self.dn) + self.front * r, dead_room(self.discharge.dn) + self.up * r
        level = float(np.sqrt(max(0.0, r * r - (abs(aside) + 0.7 * back) ** 2)))
        spot = (-half - reach, 0.0, axis), (0.0, aside, axis + r + rise)
        one, first = self.suction.build(t, spot[0], (-1, 0, 0), reach + half, n)
        two, second = self.discharge.build(t, spot[1], (0, 0, 1), r + rise - 0.5 * level, n)
        body = [along("x", solid, 0, 0, axis) for solid in self._body(r, half, n)]
        t.add(CASING, *body, one, two, *self._foot(r, half, axis, seat))
        return first, second

    def _body(self, r: float, half: float, n: int) -> list[Solid]:
        """About z, its front down."""
        if self.casing == "snail":
            return [_snail(0.85 * r, half, 0.18, n), cylinder(0.7 * r, -half, 1.15 * half, n)]
        if self.casing == "doubled":
            return [cylinder(r, -0.5 * half, half, n), cylinder(0.75 * r, -half, 1.1 * half, n)]
        shapes = {
            "drum": outline(r, -half, r, half),
            "bevelled": outline(0.72 * r, -half, r, -0.5 * half, r, 0.5 * half, 0.8 * r, half),
            "stepped": outline(0.6 * r, -half, 0.6 * r, -0.6 * half, r, -0.6 * half, r, half),
        }
        return [turned(shapes[self.casing], n)]

    def _foot(self, r: float, half: float, axis: float, seat: float) -> list[Solid]:
        tall = axis - seat - 0.6 * r
        if self.foot == "none" or tall <= 0:
            return []
        z = seat + tall / 2
        if self.foot == "block":
            return [box((1.4 * half, r, tall), (0, 0, z))]
        if self.foot == "legs":
            return [box((half, 0.3 * r, tall), (0, s * 0.6 * r, z)) for s in BOTH]
        sole = box((2 * half, 1.6 * r, 0.06 * r), (0, 0, seat + 0.03 * r))
        return [sole, box((0.4 * half, 0.9 * r, tall), (0, 0, z))]


class Coupled(_EndSuction, name="pump/plain end suction", weight=3):
    """A frame-mounted end-suction pump of plain shapes: bearing housing, shaft, coupling guard, motor, bed."""

    bearing: str = among(_BEARINGS, "form of the bearing housing")
    deep: float = between(0.5, 1.9, "length of the bearing housing / radius of the casing")
    slim: float = between(0.3, 0.62, "radius of the bearing housing / of the casing")
    apart: bool = chance(0.6, "the bearing housing is a piece of its own")
    size: float = between(0.55, 1.2, "radius of the motor / of the casing")
    slender: float = between(2.0, 4.2, "length of the motor / its radius")
    gap: float = between(0.5, 1.7, "from the bearing housing to the motor / radius of the motor")
    shaft: float = between(0.1, 0.26, "radius of the shaft / of the motor")
    guarded: bool = chance(0.93, "a coupling guard")
    hidden: bool = chance(0.12, "no shaft is modelled below the guard", when=lambda p: p.guarded)
    hubs: bool = chance(0.45, "hubs of a coupling on the shaft", when=lambda p: not p.hidden)
    guard: PlainGuard = nested(PlainGuard, "coupling guard", when=lambda p: p.guarded)
    motor: PlainMotor = nested(PlainMotor, "motor")
    bed: PlainBed = nested(PlainBed, "bed")

    def build(self, t: Table) -> Model:
        r, seat = self.radius(t), self.bed.seat
        axis, half = seat + self.lift * r, self.thick * r
        ports = self.put_casing(t, r, axis, seat)
        end = self._bearing(t, r, half, axis, seat)
        m = min(self.size * r, 0.94 * (axis - seat))
        far, n = end + self.gap * m, self.n(t, m)
        rod = [cylinder(self.shaft * m, end - 0.02, far + 0.02, n)]
        if self.hubs:
            mid, thick = (end + far) / 2, 0.12 * (far - end)
            wide = 2.0 * self.shaft * m
            rod += [
                cylinder(wide, mid + s * 0.6 * thick - thick / 2, mid + s * 0.6 * thick + thick / 2, n) for s in BOTH
            ]
        t.at(0, 0, axis).along("x").add("shaft", *([] if self.hidden else rod))
        if self.guarded:
            self.guard.build(t, end, far, axis, seat, m, n)
        length = self.slender * m
        self.motor.build(t.at(far, 0, axis).moved(LYING), m, length, n, axis - seat)
        self.bed.build(t, -half, far + 0.9 * length, 1.7 * max(m, 0.8 * r))
        return t.model(ports=ports, kind="centrifugal pump")

    def _bearing(self, t: Table, r: float, half: float, axis: float, seat: float) -> float:
        """Puts the bearing housing down behind the casing; where it ends."""
        b, long, n = self.slim * r, self.deep * r, self.n(t, self.slim * r)
        if self.bearing == "box":
            solids = [extrude(rounded_rectangle(1.8 * b, 1.8 * b, 0.15 * b, 2), 0, long)]
        elif self.bearing == "lantern":
            solids = [cylinder(1.3 * b, 0, 0.18 * long, n), cylinder(b, 0.8 * long, long, n)]
            solids += [box((0.3 * b, 0.4 * b, 0.7 * long), (s * 0.75 * b, 0, 0.48 * long)) for s in BOTH]
            solids.append(cylinder(0.35 * b, 0, long, n))
        else:
            shapes = {
                "cylinder": outline(b, 0, b, long),
                "stepped": [
                    (f * b, z * long) for f, z in outline(1.4, 0, 1.4, 0.15, 1, 0.15, 1, 0.85, 1.2, 0.85, 1.2, 1)
                ],
                "cone": outline(min(0.9 * r, 1.6 * b), 0, 0.8 * b, 0.6 * long, 0.8 * b, long),
            }
            solids = [turned(shapes[self.bearing], n)]
        where = t.at(half - 0.005, 0, axis)
        end, tall = half - 0.005 + long, axis - seat - 0.6 * b
        bracket = box((0.1 * long, 0.9 * b, tall), (0.85 * long, 0, -0.6 * b - tall / 2))
        lying = [along("x", one) for one in solids]
        if self.apart:
            where.add(CASING, *lying, bracket, own=True)
        else:
            first = t.parts[0]
            joined = merge([first.solid, *(moved(one, where.frame) for one in (*lying, bracket))])
            t.parts[0] = type(first)(joined, first.name, first.color, first.bundle)
        return end


class CoupledInPieces(Coupled, name="pump/end suction in pieces", weight=2.5, grain="fitting"):
    """A frame-mounted end-suction pump of plain shapes, each a piece of its own."""


class Monobloc(_EndSuction, name="pump/plain monobloc", weight=2):
    """A close-coupled pump of plain shapes: the motor is flanged to the casing, with a lantern or without."""

    size: float = between(0.6, 1.15, "radius of the motor / of the casing")
    slender: float = between(1.9, 3.6, "length of the motor / its radius")
    lantern: float = among((0.0, 0.3, 0.6, 0.9), "length of the lantern / radius of the casing")
    plate: float = among((0.0, 1.08, 1.2), "radius of a plate between casing and motor / of the casing; 0: none")
    motor: PlainMotor = nested(PlainMotor, "motor")
    standing: bool = chance(0.6, "the motor has feet")
    bedded: bool = chance(0.6, "it stands on a bed")
    bed: PlainBed = nested(PlainBed, "bed", when=lambda p: p.bedded)

    def build(self, t: Table) -> Model:
        r, seat = self.radius(t), self.bed.seat if self.bedded else 0.0
        axis, half = seat + self.lift * r, self.thick * r
        ports = self.put_casing(t, r, axis, seat)
        m, x = min(self.size * r, 0.94 * (axis - seat)), half
        n, more = self.n(t, r), []
        if self.plate:
            more.append(cylinder(self.plate * r, half - 0.01, half + 0.08 * r, n))
            x += 0.07 * r
        if self.lantern:
            more.append(cylinder(0.75 * m, x - 0.005, x + self.lantern * r, n))
            x += self.lantern * r
        if more:
            t.at(0, 0, axis).along("x").add(CASING, *more)
        length = self.slender * m
        self.motor.build(t.at(x - 0.002, 0, axis).moved(LYING), m, length, n, axis - seat if self.standing else 0.0)
        if self.bedded:
            self.bed.build(t, -half, x + 0.9 * length, 1.7 * max(m, 0.8 * r))
        return t.model(ports=ports, kind="centrifugal pump")


PLAIN_PUMPS = families_of(Coupled, CoupledInPieces, Monobloc)
