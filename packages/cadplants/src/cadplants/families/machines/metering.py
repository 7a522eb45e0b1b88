"""Metering and hand pumps, hydraulic power packs."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, LYING, PUMP, Motor, Pump, corners, dead_room, driven, mouth
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, rope, torus, turned
from cadplants.solids.transforms import at

__all__ = ["SMALL"]


class Metering(Pump, name="pump/metering", sizes=(15, 20, 25)):
    """A metering pump (API 675): upright motor on a worm gear case with a stroke knob, one or two liquid heads."""

    size: float = between(0.07, 0.14, "half the length of the gear case", "m")
    heads: int = whole(1, 2, "liquid heads")
    motor_size: float = between(0.75, 0.95, "radius of the motor / size")
    turn: int = among((1, 2, 3), "quarter turns of the motor")
    slender: float = between(2.4, 3.2, "length of the motor / its radius")
    motor: Motor = driven(Motor, "motor")

    def build(self, t: Table) -> Model:
        s, seat = self.size, 0.03
        n, axis, top = t.n(s), seat + 1.1 * s, seat + 2.2 * s
        sheet, sole = rounded_rectangle(2.0 * s, 1.7 * s, 0.3 * s, 3), rounded_rectangle(3.0 * s, 2.2 * s, 0.2 * s, 3)
        foot = extrude(sole, 0, seat)
        t.add(CASING, extrude(sheet, seat, top), foot)
        grip = around(box((0.06 * s, 0.06 * s, 0.4 * s), (0.5 * s, 0, 0.5 * s)), 8)
        knob = [cylinder(0.35 * s, 0, 0.3 * s, n), cylinder(0.5 * s, 0.3 * s, 0.75 * s, n), grip]
        t.at(-0.98 * s, 0, axis).along("-x").add(CASING, *knob, of="rubber")
        ports = []
        for k in range(self.heads):
            if k:
                t.at(0, 2.4 * s).add(CASING, extrude(sheet, seat, seat + 2.0 * s), foot)
                t.at(0, 0, axis).along("y").add("shaft", cylinder(0.3 * s, 0.8 * s, 1.6 * s, 12))
            ports.append(self._head(t, 2.4 * s * k, axis, n))
        m, motor = self.motor_size * s, t.bundled("motor")
        bell = outline(0.8 * s, top - 0.01, 0.6 * s, top + 0.15 * s, 1.05 * m, top + 0.35 * s, 1.05 * m, top + 0.45 * s)
        motor.add("motor", turned(bell, n))
        up = t.at(0, 0, top + 0.45 * s).spun("z", self.turn * np.pi / 2)
        self.motor.build(up, m, self.slender * m)
        return t.model(ports=ports, kind="metering pump")

    def _head(self, t: Table, y: float, axis: float, n: int) -> Port:
        """A liquid head on its lantern, with its valves and a mouth up; the port of that."""
        s = self.size
        lying, x, face = t.at(0.95 * s, y, axis).along("x"), 0.95 * s + 1.2 * s, axis + 1.9 * s + dead_room(self.dn)
        lying.add(CASING, turned(outline(0.7 * s, 0, 0.6 * s, 0.1 * s, 0.6 * s, 0.8 * s, 0.8 * s, 0.9 * s), n))
        head = turned([(a * s, b * s) for a, b in outline(0.9, 0.9, 0.9, 1.35, 0.7, 1.4, 0.7, 1.6)], n)
        liquid = [along("x", head, 0.95 * s, y, axis)]
        for low, high, more in ((-1.02, -0.75, 0), (0.7, 1.7, 0.3)):
            low, high = axis + low * s, axis + high * s
            liquid += [
                moved(one, at(x, y))
                for one in (hexagon(0.5 * s, low, high), cylinder(0.34 * s, low, high + more * s, 14))
            ]
        stub, port = mouth(self.dn, t.style, (x, y, face), (0, 0, 1), dead_room(self.dn) + 0.01)
        t.add(CASING, *liquid, stub, of="trim")
        lying.add("bolt", around(hexagon(0.14 * s, 1.35 * s, 1.45 * s), 6, 0.78 * s))
        return port


class Wing(Params):
    """A wing pump on a wall with its rocking lever."""

    kind = "wing pump"
    height: float = between(0.8, 1.3, "of the pump's middle", "m")

    def build(self, t: Table, s: float, n: int) -> None:
        """Puts it down; ``s``: its size / that of a common one."""
        r, z = 0.1 * s, self.height
        disc = [cylinder(r, 0, 0.09, n), cylinder(1.15 * r, 0.07, 0.085, n)]
        disc.append(around(hexagon(0.016, 0.085, 0.098), 6, 1.07 * r))
        necks = [(z + 0.9 * r, z + 1.25 * r), (z - 1.25 * r, z - 0.9 * r)]
        solids = [moved(hexagon(0.06 * s, *neck), at(0, -0.065)) for neck in necks]
        t.add(CASING, along("-y", merge(disc), 0, -0.02, z), *solids, box((2.4 * r, 0.012, 1.0 * r), (0, -0.014, z)))
        bow = [(0, -0.1, z), (0, -0.14, z), (0.1 * s, -0.14, z + 0.22 * s), (0.1 * s, -0.14, z + 0.4 * s)]
        t.add("lever", rope(bow, 0.01, 8), along("-y", cylinder(0.02, 0.1, 0.12, 12), 0, -0.01, z), own=True)
        t.at(0, -0.065).add("pipe", cylinder(0.017, 0.0, z - 1.2 * r, 12))
        t.add("wall", box((0.8, 0.1, z + 0.6), (0, 0.042, (z + 0.6) / 2)))


class Pitcher(Params):
    """A pitcher pump with spout and lever on its suction pipe."""

    kind = "pitcher pump"
    low: float = between(0.3, 0.7, "height of its foot", "m")

    def build(self, t: Table, s: float, n: int) -> None:
        """Puts it down; ``s``: its size / that of a common one."""
        r, h, low = 0.055 * s, 0.35 * s, self.low
        top = low + h
        body = outline(1.8 * r, low, 1.8 * r, low + 0.02, 0.6 * r, low + 0.04, 0.6 * r, low + 0.1, r, low + 0.14)
        body += outline(r, top, 1.3 * r, top, 1.3 * r, top + 0.02)
        spout = [(x * r, 0, low + z * h) for x, z in outline(0.8, 0.7, 2.6, 0.72, 3.2, 0.6, 3.3, 0.45)]
        ear = box((0.8 * r, 0.3 * r, 1.6 * r), (-1.1 * r, 0, top + 0.6 * r))
        t.add(CASING, turned(body, n), rope(spout, 0.4 * r, 10), ear)
        lever = [
            (0.0, 0, top + 1.4 * r),
            (-1.3 * r, 0, top + 1.3 * r),
            (-3.5 * r, 0, top),
            (-4.5 * r, 0, low + 0.3 * h),
        ]
        t.add("lever", rope(lever, 0.18 * r, 8), cylinder(0.1 * r, top, top + 1.5 * r, 8), own=True)
        t.add("pipe", cylinder(0.024, 0.0, low, 12))


class OnDrum(Params):
    """A rotary barrel pump screwed into a drum, with a crank."""

    kind = "barrel pump"

    def build(self, t: Table, s: float, n: int) -> None:
        """Puts it down; ``s``: its size / that of a common one."""
        r, x, z, sides = 0.06 * s, 0.17, 1.12, t.n(0.29)
        rims = [cylinder(1.2 * r, -0.045, -0.03, n), cylinder(1.2 * r, 0.03, 0.045, n)]
        disc = along("-y", merge([cylinder(r, -0.04, 0.04, n), *rims]), x, 0, z + 0.5 * r)
        stem = [moved(one, at(x)) for one in (cylinder(0.02, 0.86, z, 12), hexagon(0.07, 0.88, 0.91))]
        beak = [(x + a * r, 0, z + b * r) for a, b in outline(0.8, 0.9, 2.5, 0.9, 3.2, 0.2, 3.2, -0.9)]
        t.add(CASING, disc, *stem, rope(beak, 0.017, 10))
        crank = [
            (x, -0.04, z + 0.5 * r),
            (x, -0.07, z + 0.5 * r),
            (0.02, -0.07, z + 1.9 * r),
            (0.02, -0.17, z + 1.9 * r),
        ]
        t.add("lever", rope(crank, 0.009, 8), own=True)
        hoops = [moved(torus(0.29, 0.01, sides, 6), at(0, 0, q)) for q in (0.012, 0.3, 0.58, 0.868)]
        t.add("tank", cylinder(0.29, 0, 0.88, sides), *hoops)


_HAND_PUMPS: tuple[type[Wing] | type[Pitcher] | type[OnDrum], ...] = (Wing, Pitcher, OnDrum)


class Hand(Device, name="pump/hand", group=PUMP, label="pump", bundle=CASING, sizes=(15,)):
    """A hand pump: a wing pump on a wall, a pitcher pump with spout and lever, or a rotary barrel pump on a drum."""

    form: int = whole(0, 2, "a wing pump, a pitcher pump, a barrel pump")
    size: float = between(0.8, 1.2, "its size / that of a common one")
    pump: Wing | Pitcher | OnDrum = nested(lambda _, p: _HAND_PUMPS[p.form], "the pump")

    def build(self, t: Table) -> Model:
        self.pump.build(t, self.size, t.n(0.1 * self.size))
        return t.model(kind="hand pump")


class PowerPack(Pump, name="pump/hydraulic power pack", sizes=(15,)):
    """A hydraulic power pack: oil tank with level glass, upright or lying motor, bell housing, manifold with valves."""

    width: float = between(0.5, 1.1, "of the tank", "m")
    depth: float = between(0.4, 0.7, "of the tank", "m")
    height: float = between(0.35, 0.6, "of the tank", "m")
    motor_size: float = between(0.09, 0.14, "radius of the motor", "m")
    upright: bool = chance(0.55, "the motor stands")
    motor: Motor = driven(Motor, "motor that stands", when=lambda p: p.upright)
    turn: int = whole(0, 3, "quarter turns of the motor", when=lambda p: p.upright)
    lying: Motor = driven(Motor, "motor that lies", when=lambda p: not p.upright, standing=True)

    def build(self, t: Table) -> Model:
        w, d, h, low = self.width, self.depth, self.height, 0.08
        z, tank = low + h + 0.012, t.bundled("motor")
        deck = box((w + 0.04, d + 0.04, 0.012), (0, 0, low + h + 0.006))
        tank.add("tank", box((w, d, h), (0, 0, low + h / 2)), deck, of="motor", own=True)
        feet = [box((0.05, 0.08, low), (x, y, low / 2)) for x, y in corners(0.42 * w, 0.38 * d)]
        tank.add("tank leg", *feet, own=True)
        self._drive(t, z)
        x, y, n = 0.32 * w, -0.2 * d, 20
        coil = (
            box((0.05, 0.05, 0.05), (x - 0.03, y, z + 0.185)),
            along("x", cylinder(0.022, 0.025, 0.09, 12), x - 0.03, y, z + 0.185),
        )
        t.add("valve", box((0.12, 0.1, 0.16), (x, y, z + 0.08)), *coil)
        breather = [cylinder(0.02, 0, 0.04, n), cylinder(0.045, 0.04, 0.1, n)]
        t.at(x, 0.3 * d, z - 0.001).add("filter", *breather, of="rubber")
        canister = turned(outline(0.05, 0, 0.05, 0.2, 0.035, 0.22), n)
        t.at(0.1 * w, 0.33 * d, z - 0.001).add("filter", canister, of="trim")
        t.add("level gauge", box((0.03, 0.012, 0.55 * h), (0.3 * w, -d / 2 - 0.006, low + 0.5 * h)), of="dial")
        return t.model(kind="hydraulic power pack")

    def _drive(self, t: Table, z: float) -> None:
        """The motor with its pump on the deck."""
        w, m, n = self.width, self.motor_size, t.n(self.motor_size)
        if self.upright:
            up = t.at(-0.2 * w, 0, z)
            bell = outline(0.8 * m, 0, 0.8 * m, 0.02, 0.6 * m, 0.03, 0.6 * m, 0.9 * m, 1.02 * m, 0.95 * m, 1.02 * m, m)
            up.add(CASING, turned(bell, n))
            self.motor.build(up.at(0, 0, m).spun("z", self.turn * np.pi / 2), m, 2.8 * m)
            return
        x, axis = -0.42 * w, z + 1.2 * m
        cone = turned(outline(0.5 * m, 0, 0.5 * m, 0.4 * m, 0.95 * m, 0.9 * m), n)
        t.at(x, 0, axis).add(CASING, box((0.7 * m, 1.0 * m, 1.0 * m)), along("x", cone, 0.3 * m))
        self.lying.build(t.at(x + 1.2 * m, 0, axis).moved(LYING), m, min(3.0 * m, 0.6 * w), 1.2 * m)
        hose = [(x, 0.5 * m, axis), (x, 0.9 * m, axis), (x, 1.1 * m, axis - 0.3 * m), (x, 1.1 * m, z - 0.002)]
        t.add("hose", rope(hose, 0.015, 8))


SMALL = families_of(Metering, Hand, PowerPack)
