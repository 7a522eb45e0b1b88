"""Hygienic centrifugal pumps: a flat round casing with clamp ferrules, a shrouded motor, four legs."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, LYING
from cadplants.families.machines.plain_parts import Ferrule, PlainMotor, PlainPort, PlainPump, port_of
from cadplants.model.family import Model, Port
from cadplants.model.standards import PIPES, sizes_between, smaller
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.primitives import BOTH, along, box, cylinder, dome, rod, turned

__all__ = ["PLAIN_HYGIENIC"]


class Hygienic(PlainPump, name="pump/hygienic", sizes=sizes_between(20, 100), weight=2.5):
    """A hygienic centrifugal pump (EN 17088): ferrules in front and at the rim, motor in a shroud of sheet, legs."""

    wide: float = between(2.0, 3.8, "(radius of the casing - 30 mm) / of the suction pipe")
    thick: float = between(0.2, 0.5, "half the width of the casing / its radius")
    front: str = among(("flat", "bevelled", "coned", "stepped"), "form of the casing's front")
    rim: float = among((0.0, 1.06, 1.12, 1.2), "radius of the plate behind it / of the casing; 0: none")
    reach: float = between(0.2, 1.0, "reach of the suction before the casing / its radius")
    rise: float = between(0.3, 1.5, "of the discharge over the shaft, less the radius / radius")
    side: int = among((1, 1, -1, 0), "where the discharge is: left, right, over the shaft")
    suction: PlainPort = port_of(lambda p: p.dn, "suction", kind=Ferrule)
    discharge: PlainPort = port_of(lambda p: smaller(p.dn), "discharge", kind=Ferrule)
    lantern: float = between(0.15, 0.9, "length of the lantern / radius of the casing")
    shrouded: bool = chance(0.75, "the motor is in a shroud")
    end: str = among(("dome", "dome", "bevel", "flat"), "end of the shroud", when=lambda p: p.shrouded)
    motor: PlainMotor = nested(PlainMotor, "motor", when=lambda p: not p.shrouded)
    wired: bool = chance(0.35, "a terminal box on the shroud", when=lambda p: p.shrouded)
    size: float = between(0.75, 1.4, "radius of the motor / of the casing")
    slender: float = between(1.4, 3.2, "length of the motor / its radius")
    lift: float = between(1.15, 2.2, "height of the shaft / radius of motor or casing")
    legs: int = whole(3, 4, "legs")
    leg: float = between(0.05, 0.13, "radius of a leg / of the motor")
    spread: float = between(0.5, 0.95, "from the middle to a leg / radius of the motor")
    soles: float = among((0.0, 1.6, 2.4), "radius of a foot / of the leg; 0: none")
    squared: bool = chance(0.15, "the legs are square")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius * self.wide + 0.03
        half, m, n = self.thick * r, self.size * r, self.n(t, r)
        axis = self.lift * max(r, m)
        ports = self._casing(t, r, axis, n)
        back = half + 0.06 * r
        start = back + self.lantern * r
        cone = outline(0.8 * min(r, m), back - 0.004, 0.7 * min(r, m), start + 0.004)
        lying = t.at(0, 0, axis).along("x")
        lying.add(CASING, turned(cone, n), of="trim")
        length = self.slender * m
        if self.shrouded:
            self._shroud(t.at(0, 0, axis), m, start, length, n)
        else:
            self.motor.build(t.at(start, 0, axis).moved(LYING), m, length, n)
        t.add("pump base", *self._legs(m, start, length, axis, n), own=True)
        return t.model(ports=ports, kind="centrifugal pump")

    def _casing(self, t: Table, r: float, axis: float, n: int) -> tuple[Port, Port]:
        half = self.thick * r
        shapes = {
            "flat": outline(r, -half, r, half),
            "bevelled": outline(0.85 * r, -half, r, -0.5 * half, r, half),
            "coned": outline(0.4 * r, -1.3 * half, r, -0.4 * half, r, half),
            "stepped": outline(0.7 * r, -1.2 * half, 0.7 * r, -half, r, -half, r, half),
        }
        body = [turned(shapes[self.front], n)]
        body += [cylinder(self.rim * r, half - 0.002, half + 0.08 * r, n)] if self.rim else []
        face, pipe = half + self.reach * r + 0.02, PIPES[self.discharge.dn].radius
        aside = self.side * max(0.0, 0.98 * r - pipe)
        high = r + self.rise * r
        foot = 0.1 * r if self.side else 0.6 * r
        one, first = self.suction.build(t, (-face, 0, axis), (-1, 0, 0), face - 0.2 * half, n)
        two, second = self.discharge.build(t, (0, aside, axis + high), (0, 0, 1), high - foot, n)
        t.add(CASING, *(along("x", solid, 0, 0, axis) for solid in body), one, two, of="trim")
        return first, second

    def _shroud(self, t: Table, m: float, start: float, length: float, n: int) -> None:
        t, end = t.bundled("motor"), start + length
        bulge = 0.35 * m
        solids = [cylinder(m, start, end - bulge, n)]
        if self.end == "dome":
            solids.append(dome(m, bulge, end - bulge - 0.001, n))
        elif self.end == "bevel":
            solids = [turned(outline(m, start, m, end - 0.5 * bulge, 0.75 * m, end), n)]
        t.along("x").add("motor", *solids, of="tank")
        if self.wired:
            mid = start + 0.4 * length
            t.add("terminal box", box((0.4 * length, 0.8 * m, 0.4 * m), (mid, 0, 1.1 * m)), of="tank", own=True)

    def _legs(self, m: float, start: float, length: float, axis: float, n: int) -> list[Solid]:
        """Legs below the motor, each with its foot."""
        y, xs = self.spread * m, (start + 0.15 * length, start + 0.8 * length)
        spots = [(x, s * y) for x in xs for s in BOTH]
        if self.legs == 3:
            spots = [(xs[0], -y), (xs[0], y), (xs[1], 0.0)]
        solids, r, sides, flat = [], self.leg * m, max(6, n // 2), m * float(np.cos(np.pi / n))
        for x, side in spots:
            top = axis - float(np.sqrt(max(0.0, flat * flat - side * side))) + 0.05 * m
            solids.append(
                box((2 * r, 2 * r, top), (x, side, top / 2)) if self.squared else _post(x, side, top, r, sides)
            )
            if self.soles:
                solids.append(_post(x, side, 0.008 + 0.3 * r, self.soles * r, sides))
        return solids


def _post(x: float, y: float, top: float, r: float, n: int) -> Solid:
    return rod((x, y, 0), (x, y, top), r, n)


class HygienicInPieces(Hygienic, name="pump/hygienic in pieces", weight=1.2, grain="fitting"):
    """A hygienic centrifugal pump, each a piece of its own."""


PLAIN_HYGIENIC = families_of(Hygienic, HygienicInPieces)
