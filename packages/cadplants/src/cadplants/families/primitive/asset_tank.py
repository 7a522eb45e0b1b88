"""A tank of a kit: its nozzles are stubs with a flange, collar or ferrule in the same mesh."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.asset_ends import Look
from cadplants.families.primitive.shape import disc, dish, lying
from cadplants.model.family import Family, Model, Port
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import moved
from cadplants.solids.primitives import box, cylinder
from cadplants.solids.transforms import at, spun

__all__ = ["KIT_TANKS"]


class _Stub(Params):
    """A nozzle: a stub with what is at its end."""

    dn: int = among((15, 25, 25, 40, 50, 50, 80, 100, 150), "nominal size", "mm")
    place: str = among(("side", "side", "top", "below"), "where it is")
    around: float = between(0.0, 6.28, "where it is about the tank", "rad")
    share: float = between(0.12, 0.88, "its height / that of the shell", when=lambda p: p.place == "side")
    off: float = between(0.0, 0.6, "from the axis / radius of the tank", when=lambda p: p.place != "side")
    reach: float = between(0.5, 3.5, "(how far it stands out - that of its rim - 20 mm) / radius of the pipe")
    bare: bool = chance(0.15, "nothing at its end")
    lid: bool = chance(0.2, "a blind flange on it", when=lambda p: not p.bare)

    def pose(self, radius: float, low: float, high: float, depths: tuple[float, float]) -> Floats:
        """Where it leaves a tank, x outward, from the depths of the dishes below and above its shell [m]."""
        turn, off = spun("z", self.around), self.off * radius
        bulge = float(np.sqrt(1 - self.off**2))
        if self.place == "side":
            return turn @ at(radius, 0, low + self.share * (high - low))
        if self.place == "top":
            return turn @ at(off, 0, high + depths[1] * bulge) @ spun("y", -np.pi / 2)
        return turn @ at(off, 0, low - depths[0] * bulge) @ spun("y", np.pi / 2)


class KitTank(Device, name="tank/of a kit", group="Tank", label="tank", weight=2.5):
    """An upright drum on legs or a block, with two to six nozzles, each a stub with its flange in one mesh."""

    look: Look = nested(Look, "how its nozzles are drawn")
    sides: int = among((0, 0, 8, 12, 16, 24, 32), "sides of its shell; 0: as the style has them")
    radius: float = between(0.2, 1.0, "radius", "m")
    stretch: float = between(0.8, 4.0, "height of the shell / radius")
    top: float = among((0.0, 0.25, 0.5, 1.0), "depth of the upper dish / radius; 0: flat")
    bottom: float = among((0.25, 0.5, 1.0), "depth of the lower dish / radius")
    lift: float = between(0.25, 0.8, "of the lower dish over the floor", "m")
    legs: int = whole(3, 4, "legs")
    squared: bool = chance(0.4, "legs are square")
    leg: float = between(0.05, 0.14, "half the width of a leg / radius")
    count: int = whole(2, 6, "nozzles")
    nozzles: tuple[_Stub, ...] = several(made(_Stub), lambda p: p.count, "its nozzles")

    def build(self, t: Table) -> Model:
        radius, depths = self.radius, (self.bottom * self.radius, self.top * self.radius)
        low = self.lift + depths[0]
        high, n = low + self.stretch * radius, self.sides or t.n(radius, 8)
        t.add("shell", cylinder(radius, low, high, n))
        lower = moved(dish(radius, depths[0], 0.0, t.style), spun("x", np.pi))
        t.add("dished head", moved(lower, at(0, 0, low)))
        if depths[1]:
            t.add("dished head", dish(radius, depths[1], high, t.style))
        half, far = self.leg * radius, 0.9 * radius
        for k in range(self.legs):
            tall = low + 0.08 * radius
            there = t.spun("z", 2 * np.pi * (k + 0.5) / self.legs).at(far)
            leg = (
                box((2 * half, 2 * half, tall), (0, 0, 0.5 * tall)) if self.squared else disc(half, 0.0, tall, t.style)
            )
            there.add("tank leg", leg)
        # Flats of the shell lie inside its circle.
        dip = radius * (1 - float(np.cos(np.pi / n))) + 0.01
        ports = [self._nozzle(t, one, one.pose(radius, low, high, depths), dip) for one in self.nozzles]
        return t.model(kind="tank", ports=[port for port in ports if port is not None])

    def _nozzle(self, t: Table, one: _Stub, pose: Floats, dip: float) -> Port | None:
        """Puts a nozzle down; where a line can be joined to it, if one can."""
        r, look = PIPES[one.dn].radius, self.look
        curved = 0.0 if one.place == "side" and r > self.radius else min(r * r / self.radius, r) + one.off * r
        sunk, out = dip + curved, one.reach * r + look.depth(r) + 0.02
        there = t.moved(pose)
        there.at(-sunk).add("nozzle", look.straight(t.style, r, sunk + out, (False, not one.bare)))
        part = len(t.parts) - 1
        if one.lid:
            lid = lying(disc(look.rim.wide * r, out, out + look.rim.plate(r), t.style))
            there.add("blind flange", lid, of="flange")
        if one.lid or one.place == "below":
            return None
        return Port(there.frame @ at(out), one.dn, part)


KIT_TANKS: tuple[Family, ...] = families_of(KitTank)
