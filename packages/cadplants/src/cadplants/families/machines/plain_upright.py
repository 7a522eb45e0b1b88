"""Upright multistage pumps of plain shapes: a foot with two mouths in line, stages, a head, a motor on top."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, dead_room
from cadplants.families.machines.plain_parts import PlainMotor, PlainPort, PlainPump, Threaded, arched, port_of
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, turned
from cadplants.solids.transforms import spun

__all__ = ["PLAIN_UPRIGHT"]


class _Upright(PlainPump):
    """A multistage pump on its foot, its mouths in one axis or above each other."""

    wide: float = between(1.3, 2.6, "(radius of the stages - 15 mm) / of the pipe")
    tall: float = between(2.0, 9.0, "height of the stages / their radius")
    size: float = between(0.8, 1.5, "radius of the motor / of the stages")
    slender: float = between(1.7, 3.4, "length of the motor / its radius")
    sole: str = among(("square", "round", "cross", "none"), "form of the foot's plate")
    stages: str = among(("plain", "plain", "rings", "banded"), "form of the stages")
    rods: int = among((0, 4, 4, 6), "tie rods along the stages")
    lantern: str = among(("tube", "posts", "cone", "none"), "what is between stages and motor")
    guarded: bool = chance(0.5, "a sheet over the lantern's window", when=lambda p: p.lantern == "posts")
    high: float = between(0.4, 1.1, "height of the lantern / radius of the stages")
    over: float = between(0.01, 0.09, "from the floor to the lower edge of the mouths' pipe", "m")
    motor: PlainMotor = nested(PlainMotor, "motor")

    def put(self, t: Table, mouths: tuple[PlainPort, PlainPort], reach: float, rise: float) -> Model:
        """Puts it down; its mouths reach so far from the axis, the second is so much higher [m]."""
        r, p = t.pipe.radius * self.wide + 0.015, t.pipe.radius
        n, level = self.n(t, r), self.over + 1.35 * p + 0.01
        low = level + rise + 1.4 * p
        solids = [cylinder(1.06 * r, self.over, low, n), *self._sole(r, n)]
        ports = []
        for side, mouth in zip(BOTH, mouths, strict=True):
            spot = (side * (r + reach), 0.0, level + (rise if side > 0 else 0.0))
            solid, port = mouth.build(t, spot, (side, 0, 0), reach + 0.8 * r, n)
            solids.append(solid)
            ports.append(port)
        t.add(CASING, *solids)
        top = low + r * self.tall
        self._stages(t, r, low, top, n)
        seat = self._lantern(t, r, top, n)
        m = self.size * r
        self.motor.build(t.at(0, 0, seat), m, self.slender * m, self.n(t, m))
        return t.model(ports=ports, kind="multistage pump")

    def _sole(self, r: float, n: int) -> list[Solid]:
        """The foot's plate, and the block between it and the casing."""
        thick = min(0.02, 0.6 * self.over)
        if self.sole == "round":
            return [cylinder(1.5 * r, 0, thick, n), cylinder(1.1 * r, 0, self.over + 0.005, n)]
        if self.sole == "square":
            return [box((2.9 * r, 2.9 * r, thick), (0, 0, thick / 2)), cylinder(r, 0, self.over + 0.005, n)]
        if self.sole == "cross":
            ways = ((3.2 * r, 0.8 * r), (0.8 * r, 3.2 * r))
            return [box((x, y, self.over + 0.02), (0, 0, (self.over + 0.02) / 2)) for x, y in ways]
        return [cylinder(r, 0, self.over + 0.005, n)]

    def _stages(self, t: Table, r: float, low: float, top: float, n: int) -> None:
        head = 0.25 * r
        column = [cylinder(0.9 * r, low - 0.005, top - head, n)]
        count = max(2, int((top - low) / (0.6 * r)))
        if self.stages == "rings":
            column += [cylinder(0.98 * r, z, z + 0.35 * r, n) for z in np.linspace(low, top - head - 0.4 * r, count)]
        elif self.stages == "banded":
            column += [cylinder(0.96 * r, z, z + 0.06 * r, n) for z in (low + 0.2 * r, top - head - 0.3 * r)]
        t.add(CASING, *column, of="trim")
        t.add(CASING, cylinder(1.15 * r, top - head - 0.002, top, n))
        if self.rods:
            t.add("stud", around(cylinder(0.07 * r, low - 0.1 * r, top + 0.15 * r, 8), self.rods, 1.05 * r, np.pi / 4))

    def _lantern(self, t: Table, r: float, top: float, n: int) -> float:
        """What the motor stands on; the height of that."""
        if self.lantern == "none":
            return top - 0.002
        m, z = self.size * r, top + self.high * r
        if self.lantern == "posts":
            posts = [box((0.25 * r, 0.7 * r, z - top), (s * 0.7 * r, 0, (z + top) / 2)) for s in BOTH]
            t.add(CASING, *posts, cylinder(max(0.9 * m, r), z - 0.1 * r, z, n))
            t.add("shaft", cylinder(0.18 * r, top - 0.005, z, max(6, n // 2)))
            if self.guarded:
                line = arched(0.78 * r, 0.0, max(5, n // 2))[1:-1]
                sheet = extrude(np.vstack([line, 0.94 * line[::-1]]), top + 0.02, z - 0.1 * r)
                t.add("coupling guard", sheet, moved(sheet, spun("z", np.pi)), own=False)
            return z - 0.002
        shape = outline(0.8 * r, top - 0.002, 0.8 * r, z)
        if self.lantern == "cone":
            shape = outline(r, top - 0.002, 0.8 * m, z)
        t.add(CASING, turned(shape, n))
        return z - 0.002


class Multistage(_Upright, name="pump/plain multistage", sizes=(25, 32, 40, 50, 65, 80, 100), weight=2):
    """An upright multistage pump of plain shapes with two flanges or threads in line at its foot."""

    reach: float = between(0.0, 0.9, "further reach of the mouths / radius of the pipe")
    suction: PlainPort = port_of(lambda p: p.dn, "suction")
    discharge: PlainPort = port_of(lambda p: p.dn, "discharge")

    def build(self, t: Table) -> Model:
        reach = dead_room(self.dn) + self.reach * t.pipe.radius
        return self.put(t, (self.suction, self.discharge), reach, 0.0)


class MultistageInPieces(Multistage, name="pump/multistage in pieces", weight=1.2, grain="fitting"):
    """An upright multistage pump of plain shapes, each a piece of its own."""


class Jockey(_Upright, name="pump/jockey", sizes=(15, 20, 25, 32, 40), weight=1.5):
    """A small upright multistage pump that keeps a fire main under pressure: threaded mouths, level or not."""

    rise: float = among((0.0, 0.0, 1.6, 2.6), "how much higher the discharge is / radius of the pipe")
    reach: float = between(1.0, 3.0, "reach of the mouths / radius of the pipe")
    suction: PlainPort = port_of(lambda p: p.dn, "suction", kind=Threaded)
    discharge: PlainPort = port_of(lambda p: p.dn, "discharge", kind=Threaded)
    plugged: bool = chance(0.4, "a priming plug on its head")

    def build(self, t: Table) -> Model:
        p = t.pipe.radius
        model = self.put(t, (self.suction, self.discharge), self.reach * p + 0.012, self.rise * p)
        if self.plugged:
            r, z = p * self.wide + 0.015, self.over + 2.0 * p
            plug = along("y", hexagon(0.9 * p, 0, 0.5 * p), 0, 1.05 * r - 0.002, z)
            t.add(CASING, plug, of="trim")
        return model


PLAIN_UPRIGHT = families_of(Multistage, MultistageInPieces, Jockey)
