"""Compressors with their drives and receivers."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import number, yes
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    Driven,
    Motor,
    Train,
    base,
    corners,
    dead_room,
    driven,
    mouth,
    volute,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["COMPRESSORS"]

_NAME = "compressor"


class Piston(Driven, name="compressor/piston V", group="Equipment", label=_NAME, bundle=_NAME, sizes=(15,)):
    """A piston compressor (two cylinders in V or in line) with finned barrels, on a standing or lying tank."""

    radius: float = between(0.2, 0.3, "of the tank", "m")
    upright: bool = chance(0.5, "the tank stands")
    slender: float = between(3.5, 5.0, "length of the tank's shell / its radius")
    vee: bool = chance(0.6, "the cylinders are in V")
    motor: Motor = driven(Motor, "motor", standing=True)
    hooded: bool = chance(0.7, "a guard over the belt, not a bare wheel")

    def build(self, t: Table) -> Model:
        r, n = self.radius, t.n(self.radius)
        z = self._tank(t, r, n) + 0.02
        left, c = -0.6 * r, 0.5 * r
        y, axis = -0.75 * c, z + 0.95 * c
        self._block(t, left, c, z)
        shaft = cylinder(0.1 * c, y - 0.35 * c, 0, 10)
        t.at(left, 0, axis).along("y").add("shaft", shaft, own=True)
        m = 0.34 * r
        x, high = 0.95 * r, z + 1.2 * m
        drive = t.at(x, y + 0.02 * c, high).spun("x", -np.pi / 2).spun("z", -np.pi / 2)
        self.motor.build(drive, m, 1.15 * r, 1.2 * m)
        if self.hooded:
            reach, tilt = float(np.hypot(x - left, high - axis)), float(np.arctan2(high - axis, x - left))
            hood = extrude(rounded_rectangle(reach + 2.4 * c, 2.1 * c, 1.0 * c, 4), -0.03 * c, 0.4 * c)
            middle = t.at((left + x) / 2, y - 0.02 * c, (high + axis) / 2)
            middle.spun("x", np.pi / 2).spun("z", tilt).add("coupling guard", hood)
        else:
            fly = 0.85 * c
            spokes = around(box((0.6 * fly, 0.2 * fly, 0.1 * c), (0.5 * fly, 0, 0.15 * c)), 5)
            wheel = [ring(0.75 * fly, fly, 0, 0.3 * c, n), cylinder(0.25 * fly, 0, 0.3 * c, 12), spokes]
            t.at(left, y - 0.3 * c, axis).along("y").add(_NAME, *wheel, of="trim")
        t.add("junction box", box((0.1, 0.08, 0.12), (x - 1.6 * m, 0.6 * r, z + 0.06)), of="rubber")
        return t.model(kind="piston compressor")

    def _tank(self, t: Table, r: float, n: int) -> float:
        """The tank on its feet with a deck on it; the height of that."""
        tall, cap = self.slender * r, dome(r, 0.4 * r, 0.0, n)
        shell = [cylinder(r, 0, tall, n), moved(cap, at(0, 0, tall)), moved(cap, spun("x", np.pi))]
        if self.upright:
            low = 0.4 * r + 0.12
            t.at(0, 0, low).add(_NAME, *shell, of="tank")
            leg = [box((0.06, 0.02, low + 0.15), (0, 0, (low + 0.15) / 2)), box((0.12, 0.12, 0.012), (0, 0, 0.006))]
            feet = [moved(merge(leg), spun("z", k * 2.0944) @ at(r)) for k in range(3)]
            z = low + tall + 0.42 * r
            prop = (0.05, 0.9 * r, 0.42 * r)
        else:
            low = r + 0.14
            t.at(-tall / 2, 0, low).along("x").add(_NAME, *shell, of="tank")
            foot = (0.08, 1.2 * r, low - 0.7 * r)
            feet = [box(foot, (x * 0.4 * tall, 0, foot[2] / 2)) for x in BOTH]
            z = low + r + 0.05
            prop = (0.06, 0.5 * r, 0.2 * r + 0.05)
        props = [box(prop, (x * 0.6 * r, 0, z - prop[2] / 2)) for x in BOTH]
        t.add(_NAME, *feet, *props, box((3.0 * r, 1.5 * r, 0.02), (0.2 * r, 0, z + 0.01)), of="steel")
        return z

    def _block(self, t: Table, x: float, c: float, z: float) -> None:
        """Crankcase and cylinders with their filters on a deck, and the pipe down."""
        case = extrude(rounded_rectangle(1.0 * c * 2, 1.5 * c, 0.5 * c, 4), -0.55 * c, 0.55 * c)
        fin, head = rounded_rectangle(1.3 * c, 1.2 * c, 0.2 * c, 2), rounded_rectangle(1.2 * c, 1.1 * c, 0.1 * c, 2)
        fins = [extrude(fin, q * c, (q + 0.07) * c) for q in (0.7, 0.9, 1.1, 1.3)]
        barrel = merge([cylinder(0.45 * c, 0, 1.6 * c, 16), *fins, extrude(head, 1.5 * c, 1.95 * c)])
        spots = [at(x, 0, z + 0.8 * c) @ spun("y", a) for a in (-0.6, 0.6)]
        if not self.vee:
            spots = [at(x + s * 0.65 * c, 0, z + 0.8 * c) for s in BOTH]
        strainer = cylinder(0.35 * c, -0.6 * c, -0.2 * c, 14)
        strainer = moved(strainer, at(0, -0.6 * c, 1.75 * c) @ spun("x", np.pi / 2) @ at(0, 0, 0.3 * c))
        solids = [moved(one, pose) for one in (barrel, strainer) for pose in spots]
        t.add(_NAME, along("y", case, x, 0, z + 0.75 * c), *solids, of="pump")
        pipe = [(0.3, 0.4, 2.4), (1.8, 0.5, 2.4), (2.2, 0.5, 1.2)]
        path = [*((x + a * c, b * c, z + d * c) for a, b, d in pipe), (x + 2.2 * c, 0.5 * c, z - 0.01)]
        t.add("pipe", rope(path, 0.05 * c, 8), own=True)


class _Cooling(Device, group="Equipment", label=_NAME, bundle=_NAME, sizes=(15,)):
    """A compressor whose motor is in its case."""


class Cabinet(_Cooling, name="compressor/louvred cabinet"):
    """A screw compressor in its cabinet: doors with handles, louvres, exhaust hood, panel, skid."""

    width: float = between(0.8, 2.6, "of the cabinet", "m")
    depth: float = between(0.7, 1.3, "of the cabinet", "m")
    height: float = between(0.9, 1.9, "of the cabinet", "m")
    corner: float = among((0.0, 0.04, 0.1), "radius of the cabinet's corners", "m")
    louvres: tuple[bool, ...] = several(
        yes(0.5),
        lambda p: max(1, _doors(p.width) // 2),
        "whether the louvres are low in a door, of each door that has some",
    )
    roof: str = among(("hood", "fan", "duct", "plain"), "what is on the roof")

    def build(self, t: Table) -> Model:
        w, d, h, low = self.width, self.depth, self.height, 0.1
        count = _doors(w)
        step, front, reach = w / count, -d / 2, dead_room(50) + 0.06
        stub, port = mouth(50, t.style, (w / 2 + reach, 0.2 * d, low + 0.6 * h), (1, 0, 0), reach + 0.01)
        case = extrude(rounded_rectangle(w, d, self.corner, 3), low, low + h)
        t.add(_NAME, case, *self._roof(t, low + h), stub, of="motor")
        t.add(_NAME, *(box((w, 0.12, low), (0, s * (d / 2 - 0.06), low / 2)) for s in BOTH), of="steel")
        xs = [-w / 2 + (k + 0.5) * step for k in range(count)]
        doors = [box((0.94 * step, 0.016, 0.88 * h), (x, front - 0.008, low + 0.5 * h)) for x in xs]
        t.add(_NAME, *doors, of="electrical")
        handles = [box((0.03, 0.03, 0.12), (x + 0.38 * step, front - 0.03, low + 0.55 * h)) for x in xs]
        blade, slats = moved(box((0.7 * step, 0.03, 0.004)), spun("x", 0.6)), []
        for x, is_low in zip(xs if count == 1 else xs[1::2], self.louvres, strict=True):
            zs = np.linspace(0.12, 0.4, 8) if is_low else np.linspace(0.6, 0.85, 6)
            slats += [moved(blade, at(x, front - 0.022, low + q * h)) for q in zs]
        t.add(_NAME, *handles, *slats, of="rubber")
        x = -0.5 * w + 0.4 * step
        panel = box((0.26, 0.03, 0.18), (x, front - 0.031, low + 0.75 * h))
        t.add("control panel", panel, box((0.14, 0.006, 0.09), (x, front - 0.048, low + 0.76 * h)), of="rubber")
        return t.model(ports=(port,), kind="screw compressor")

    def _roof(self, t: Table, top: float) -> list[Solid]:
        """What is on the roof: a hood, a fan under a guard, a duct, nothing."""
        w, d = self.width, self.depth
        if self.roof == "hood":
            hood = box((0.5 * w, 0.6 * d, 0.15), (0.15 * w, 0, top + 0.075))
            return [hood, box((0.55 * w, 0.65 * d, 0.02), (0.15 * w, 0, top + 0.16))]
        if self.roof == "fan":
            r = 0.35 * min(w, d)
            hoops = [(0.94 * r, r, 0.0, 0.08), *((k * r - 0.005, k * r, 0.06, 0.066) for k in (0.25, 0.5, 0.75))]
            solids = [ring(*hoop, t.n(r)) for hoop in hoops]
            solids += [box((1.9 * r, 0.012, 0.01), (0, 0, 0.063)), box((0.012, 1.9 * r, 0.01), (0, 0, 0.063))]
            return [moved(one, at(0.1 * w, 0, top)) for one in (*solids, cylinder(0.2 * r, 0, 0.06, 12))]
        if self.roof == "duct":
            duct = box((0.4 * w, 0.5 * d, 0.8), (0.1 * w, 0, top + 0.4))
            return [duct, box((0.46 * w, 0.56 * d, 0.03), (0.1 * w, 0, top + 0.8))]
        return []


def _doors(width: float) -> int:
    """How many doors a cabinet has; every second has louvres, or the only one."""
    return int(np.clip(round(width / 0.6), 1, 4))


class Pots(Params):
    """Hermetic pots in a row on rubber feet and rails."""

    kind = "pots"
    count: int = whole(1, 3, "pots")
    slender: tuple[float, ...] = several(number(2.4, 4.2), lambda p: p.count, "height of each pot / its radius")

    def build(self, t: Table, r: float) -> Model:
        """Puts them down; ``r``: radius of a pot [m]."""
        low = 0.09
        for k, slender in enumerate(self.slender):
            up, h = t.at(3.2 * r * k), slender * r
            pot = outline(0.75 * r, low, r, low + 0.3 * r)
            pot += outline(r, low + 0.7 * h, 1.05 * r, low + 0.7 * h, 1.05 * r, low + 0.74 * h, r, low + 0.74 * h)
            pot += outline(0.95 * r, low + 0.85 * h, 0.6 * r, low + h)
            up.add(_NAME, turned(pot, t.n(r)), of="rubber")
            feet = [moved(cylinder(0.02, 0.03, 0.084, 10), at(x, y)) for x, y in corners(r, r)]
            up.add(_NAME, box((2.4 * r, 2.4 * r, 0.008), (0, 0, 0.0865)), *feet, of="steel")
            suction = [(0.9 * r, 0, low + 0.4 * h), (1.5 * r, 0, low + 0.4 * h), (1.5 * r, 0, 0.2 + h)]
            discharge = [(0, 0, 0.08 + h), (0, 0, 0.15 + h), (0, 0.9 * r, 0.2 + h)]
            up.add(_NAME, rope(suction, 0.018, 8), rope(discharge, 0.011, 8), of="trim")
            terminals = box((0.14 * h, 0.6 * r, 0.4 * r), (0, -1.05 * r, low + 0.5 * h))
            up.add("terminal box", terminals, of="electrical", own=True)
        mid = 1.6 * r * (self.count - 1)
        t.add("skid frame", *(box((2 * mid + 3 * r, 0.04, 0.03), (mid, s * r, 0.015)) for s in BOTH))
        return t.model(kind="hermetic compressor")


class SemiHermetic(Params):
    """A semi-hermetic block with banks of heads and its stop valves."""

    kind = "semi-hermetic block"
    banks: int = whole(2, 3, "banks of cylinders")

    def build(self, t: Table, r: float) -> Model:
        """Puts it down; ``r``: half its size [m]."""
        s, low = 2.0 * r, 0.08
        axis = low + 0.8 * s
        shape = outline(0.7, -1.6, 0.75, -1.5, 0.7, -1.4, 0.7, 0.2, 0.85, 0.25, 0.85, 1.3, 0.6, 1.4)
        barrel = along("x", turned([(a * s, b * s) for a, b in shape], t.n(r)), 0, 0, axis)
        fin, places = (0.95 * s, 0.03 * s, 0.14 * s), (-0.22, -0.11, 0, 0.11, 0.22)
        head = box((0.9 * s, 0.6 * s, 0.5 * s), (0.75 * s, 0, 0.95 * s))
        head = merge([head, *(box(fin, (0.75 * s, q * s, 1.25 * s)) for q in places)])
        banks = [moved(head, at(0, 0, axis) @ spun("x", a)) for a in (-0.7, 0.0, 0.7)[: self.banks]]
        feet = [box((0.2 * s, 1.3 * s, 0.35 * s), (x * s, 0, low + 0.1 * s)) for x in (-1.1, 0.9)]
        t.add(_NAME, barrel, *banks, *feet, of="pump")
        valve = merge([cylinder(0.12 * s, 0, 0.35 * s, 12), hexagon(0.3 * s, 0.25 * s, 0.5 * s)])
        valves = [moved(valve, at(x * s, 0, axis + z * s)) for x, z in ((-1.0, 0.65), (1.25, 0.75))]
        t.add(_NAME, *valves, of="trim")
        case = box((0.7 * s, 0.4 * s, 0.6 * s), (-0.8 * s, -0.7 * s, axis))
        lid = box((0.75 * s, 0.04 * s, 0.65 * s), (-0.8 * s, -0.92 * s, axis))
        t.add("terminal box", case, lid, of="electrical", own=True)
        t.add("skid frame", *(box((3.4 * s, 0.1, low), (-0.1 * s, y * 0.5 * s, low / 2)) for y in BOTH))
        return t.model(kind="semi-hermetic compressor")


class Hermetic(_Cooling, name="compressor/hermetic"):
    """Refrigerant compressors: hermetic pots (scroll or piston), or a semi-hermetic block with finned heads."""

    radius: float = between(0.07, 0.13, "of a pot, or half the size of a block", "m")
    potted: bool = chance(0.6, "in hermetic pots")
    pots: Pots = nested(Pots, "the pots", when=lambda p: p.potted)
    block: SemiHermetic = nested(SemiHermetic, "the block", when=lambda p: not p.potted)

    def build(self, t: Table) -> Model:
        return self.pots.build(t, self.radius) if self.potted else self.block.build(t, self.radius)


class Turbo(
    Driven, name="compressor/centrifugal", group="Equipment", label=_NAME, bundle=_NAME, sizes=(80, 100, 125, 150)
):
    """A centrifugal compressor (API 617): one volute or two on an integral gear case, axial inlets, motor on a skid."""

    seat: float = between(0.15, 0.3, "height of the skid", "m")
    stages: int = whole(1, 2, "volutes")
    frame: str = among(("cast", "cooled", "ex", "drip"), "how the motor's frame is made")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(("beams", "grid", "rim"), "form of the skid")

    def build(self, t: Table) -> Model:
        dn, seat, r = self.dn, self.seat, 0.12 + 1.8 * t.pipe.radius
        axis = seat + 1.65 * r
        face, up = -1.5 * r - dead_room(dn) - 0.05, axis + 1.35 * r + dead_room(dn) + 0.03
        inlet, first = mouth(dn, t.style, (face, 0, axis), (-1, 0, 0), abs(face + r))
        outlet, second = mouth(dn, t.style, (-r, 0, up), (0, 0, 1), up - axis - 0.5 * r)
        solids = [inlet, outlet, along("x", volute(r, 0.36 * r, t.style, 0.35), -r, 0, axis)]
        if self.stages > 1:
            solids.append(along("x", volute(0.8 * r, 0.36 * r, t.style, 0.35), r, 0.95 * r, axis))
        t.add(_NAME, *solids, of="pump")
        case = [box((1.3 * r, 2.6 * r, axis - seat + 0.55 * r), (0, 0, (seat + axis + 0.55 * r) / 2))]
        case.append(box((1.4 * r, 2.8 * r, 0.12 * r), (0, 0, axis)))
        nut, ys = hexagon(0.12 * r, 0.05 * r, 0.13 * r), (-1, -0.35, 0.35, 1)
        t.add(_NAME, *case, *(moved(nut, at(x * 0.66 * r, y * 1.34 * r, axis)) for x in BOTH for y in ys), of="motor")
        aside = t.at(0, -0.35 * r if self.stages > 1 else 0.0)
        aside.at(0, 0, axis).along("x").add("shaft", cylinder(0.14 * r, 0.6 * r, r, 12), own=True)
        far, seats = self.drive.build(aside, r, axis, seat, min(1.1 * r, 0.9 * (axis - seat)))
        base(t, self.bed, -1.2 * r, far, 3.6 * r, seat, [-0.3 * r, 0.3 * r, *seats], "skid frame")
        return t.model(ports=(first, second), kind="centrifugal compressor")


COMPRESSORS = families_of(Piston, Cabinet, Hermetic, Turbo)
