"""Hydrants above and below the ground and in walls, standpipes, monitors."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility, wall
from cadplants.model.family import Family, Model
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
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["HYDRANTS"]

_H = "hydrant"


class _Hydrant(Utility, bundle=_H, grain="structure"):
    """A hydrant."""


class DryBarrel(_Hydrant, name="hydrant/dry barrel", weight=1.2):
    """A dry barrel hydrant (AWWA C502): break flange, barrel, bonnet with its nut, capped nozzles, chains."""

    radius: float = between(0.08, 0.12, "of the barrel", "m")
    height: float = between(0.5, 0.8, "from the break flange to the bonnet", "m")
    fluted: bool = chance(0.4, "its barrel has flutes")
    flutes: int = among((8, 12), "flutes", when=lambda p: p.fluted, otherwise=0)
    count: int = whole(2, 3, "nozzles")
    chained: tuple[bool, ...] = several(yes(0.6), lambda p: p.count, "whether a nozzle's cap is on a chain")
    guarded: bool = chance(0.4, "a guard post beside it")

    def build(self, t: Table) -> Model:
        r, h, low, n = self.radius, self.height, 0.08, t.n(self.radius)
        z = low + h + 0.021
        barrel = outline(1.75 * r, low + 0.026, 1.75 * r, low + 0.05, r, low + 0.055, r, low + 0.62 * h)
        head = outline(1.25 * r, low + 0.68 * h, 1.25 * r, low + h, 1.6 * r, low + h, 1.6 * r, low + h + 0.02)
        solids, caps, chains = [turned([*barrel, *head], n)], [], []
        if self.fluted:
            flute = box((0.1 * r, 0.18 * r, 0.55 * h), (r, 0, low + 0.05 + 0.3 * h))
            solids.append(around(flute, self.flutes))
        nozzles = ((-np.pi / 2, 0.85), (0.0, 0.5), (np.pi, 0.5))
        for (angle, size), chained in zip(nozzles, self.chained, strict=False):
            s, pose = size * r, spun("z", angle) @ at(0, 0, low + 0.84 * h)
            stub = merge([cylinder(1.1 * s, r, 1.5 * r, n), cylinder(1.25 * s, 1.3 * r, 1.42 * r, n)])
            solids.append(moved(along("x", stub), pose))
            lugs = around(box((0.12 * s, 0.2 * s, 0.3 * r), (1.3 * s, 0, 1.67 * r)), 6)
            lid = merge([cylinder(1.3 * s, 1.5 * r, 1.85 * r, n), cylinder(0.3 * s, 1.8 * r, 2.15 * r, 5), lugs])
            caps.append(moved(along("x", lid), pose))
            if chained:
                line = [(1.75 * r, s, -0.6 * s), (1.6 * r, 1.2 * s, -1.6 * s)]
                line += [(1.1 * r, 0.6 * r, -1.2 * s), (0.98 * r, 0.3 * r, -0.9 * s)]
                chains.append(moved(rope(line, 0.004, 5), pose))
        t.add(_H, *solids)
        t.add(_H, cylinder(1.15 * r, 0, low, n), cylinder(1.75 * r, low, low + 0.025, n))
        crown = [(1.2 * r * np.cos(a), 0.025 + 1.1 * r * np.sin(a)) for a in (0.3, 0.6, 0.9, 1.2)]
        top = outline(0.35 * r, 0.025 + 1.1 * r, 0.35 * r, 0.03 + 1.2 * r)
        bonnet = turned([*outline(1.6 * r, 0, 1.6 * r, 0.02, 1.2 * r, 0.025), *crown, *top], n)
        t.at(0, 0, z).add(_H, bonnet, cylinder(0.22 * r, 0.025 + 1.2 * r, 0.025 + 1.7 * r, 5), of="dial")
        t.add(_H, *caps, of="dial")
        t.add(_H, *chains, of="clamp")
        rings = ((low + 0.05, 1.6 * r), (z + 0.02, 1.48 * r))
        t.add("bolt", *(around(hexagon(0.022, q, q + 0.014), 8, far) for q, far in rings))
        if self.guarded:
            t.at(0.6, 0.3).add("post", cylinder(0.06, 0, 0.9, 14), dome(0.06, 0.05, 0.9, 14), of="safety")
        return t.model()


class Standpipe(_Hydrant, name="hydrant/standpipe"):
    """A standpipe with a double head, handwheels and claw caps, in a street box or on a flange."""

    radius: float = between(0.035, 0.055, "of the pipe", "m")
    height: float = between(0.8, 1.2, "of the pipe", "m")
    outlets: int = whole(1, 2, "outlets")
    boxed: bool = chance(0.6, "it stands in an open street box")

    def build(self, t: Table) -> Model:
        r, h, n = self.radius, self.height, t.n(self.radius)
        arm = outline(0, -0.02, 1.2 * r, 0.05, 3.2 * r, 0.05, 4.2 * r, 0.0, 4.6 * r, -0.06)
        bend, high = rope([(x, 0, z) for x, z in arm], 0.85 * r, n), 0.05 + 2.0 * r
        spokes = box((2.4 * r, 0.2 * r, 0.1 * r), (0, 0, high))
        wheel = [cylinder(0.35 * r, 0.05, high, 8), moved(torus(1.2 * r, 0.14 * r, 16, 6), at(0, 0, high)), spokes]
        claws = around(box((0.3 * r, 0.4 * r, 0.3 * r), (1.3 * r, 0, 0.8 * r)), 2)
        cap = merge([cylinder(1.15 * r, 0, 0.5 * r, n), cylinder(1.3 * r, 0.4 * r, r, n), claws])
        poses = [at(0, 0, h) @ spun("z", angle) for angle in (0.4, np.pi - 0.4)[: self.outlets]]
        pipes = ((r, 0.03, h), (1.5 * r, h - 0.05, h + 0.02), (1.25 * r, 0.3 * h, 0.3 * h + 0.02))
        bar = rod((-3 * r, 0, 0.45 * h), (3 * r, 0, 0.45 * h), 0.4 * r, 8)
        foot = [cylinder(1.9 * r, 0.0, 0.02, n), cylinder(1.5 * r, 0.015, 0.06, n)]
        t.add(_H, *(cylinder(*one, n) for one in pipes), *(moved(bend, pose) for pose in poses), bar, *foot)
        wheels = [moved(merge(wheel), pose @ at(2.2 * r)) for pose in poses]
        t.add("handwheel", *wheels, of="rubber", own=True)
        end = at(4.6 * r, 0, -0.05) @ spun("y", np.pi + 0.3)
        t.add(_H, *(moved(cap, pose @ end) for pose in poses), of="trim")
        if self.boxed:
            hole = rounded_rectangle(0.4, 0.26, 0.02, 3)
            t.add(_H, extrude(rounded_rectangle(0.5, 0.36, 0.04, 3), 0.0, 0.03, (hole,)), of="rubber")
            t.add(_H, box((0.4, 0.02, 0.26), (0, 0.188, 0.155)), of="rubber")
            t.add(_H, box((0.42, 0.28, 0.004), (0, 0, 0.002)), of="rubber")
        return t.model()


class WallHydrant(_Hydrant, name="hydrant/wall", weight=1.2):
    """A wall hydrant (EN 671): a cabinet with a reel or a flaked hose, an angle valve."""

    width: float = between(0.55, 0.8, "of the cabinet", "m")
    tall: float = between(0.6, 1.0, "height of the cabinet", "m")
    depth: float = between(0.18, 0.28, "of the cabinet", "m")
    level: float = between(0.5, 0.9, "of the cabinet over the floor", "m")
    opened: float = between(1.2, 2.0, "how far its door is open", "rad")
    reel: bool = chance(0.6, "its hose is on a reel, not flaked")

    def build(self, t: Table) -> Model:
        w, h, d, z = self.width, self.tall, self.depth, self.level
        y, here = -d / 2, t.at(0, 0, z)
        mid = here.at(0, 0, h / 2)
        walls = [box((0.006, d, h), (q * w / 2, y, 0)) for q in BOTH]
        walls += [box((w, d, 0.006), (0, y, q)) for q in (0.003 - h / 2, h / 2 - 0.003)]
        mid.add(_H, *walls, box((w, 0.006, h), (0, -0.003, 0)))
        mid.at(-w / 2, 0.001 - d).spun("z", -self.opened).add(_H, box((w, 0.02, h), (w / 2, 0, 0)))
        if self.reel:
            self._reel(mid.at(0.04 * w, 0, -0.04))
        else:
            folds = [box((0.02, 0.06, 0.6 * h), (x, y, 0.4 * h)) for x in np.linspace(-0.3 * w, 0.1 * w, 7)]
            fold = box((0.4 * w + 0.02, 0.06, 0.02), (-0.1 * w, y, 0.1 * h))
            here.add("hose", *folds, fold, of="dial")
            ends = ((0.2 * w, y), (-0.4 * w, -0.003))
            spokes = [rod((-0.4 * w, y, 0.7 * h), (*end, 0.7 * h), 0.012, 8) for end in ends]
            here.add(_H, *spokes, of="clamp")
        valve = here.at(0.38 * w, y, 0.82 * h)
        stem = along("-y", cylinder(0.012, 0, min(0.08, d / 2), 8))
        valve.add("valve body", ball(0.045, 14), cylinder(0.03, -0.09, 0.0, 14), stem, of="trim")
        spokes = [box((0.09, 0.01, 0.006)), box((0.01, 0.09, 0.006))]
        wheel = valve.at(0, -min(0.075, d / 2 - 0.01)).spun("x", np.pi / 2)
        wheel.add("handwheel", torus(0.045, 0.007, 16, 6), *spokes)
        valve.add("pipe", rod((0, 0, 0.03), (0, 0, 0.18 * h + 0.5), 0.027, 12))
        t.extend([wall(-w, w, z + h + 0.6)])
        return t.model()

    def _reel(self, t: Table) -> None:
        """The reel with its hose, its middle at the origin of the frame."""
        d, r, n = self.depth, 0.36 * min(self.width, self.tall), 24
        cheeks = [cylinder(r, q, q + 0.008, n) for q in (0.03, d - 0.03)]
        t.spun("x", np.pi / 2).add(_H, *cheeks, cylinder(0.06, 0.0, d - 0.02, 14))
        count = max(2, int((d - 0.08) / 0.035))
        coil = moved(torus(0.72 * r, 0.02, n, 6), spun("x", np.pi / 2))
        coils = [moved(coil, at(0, -0.055 - 0.035 * k)) for k in range(count)]
        t.add("hose", *coils, rod((0, -0.06, -0.7 * r), (0, -0.06, 0), 0.015, 8), of="dial")


class Monitor(_Hydrant, name="hydrant/monitor"):
    """A fire monitor on its hydrant riser: swivels, bends, water or foam barrel, tiller or wheel."""

    radius: float = between(0.04, 0.07, "of the riser", "m")
    height: float = between(0.6, 1.1, "of the riser", "m")
    tilt: float = between(0.2, 0.8, "of the barrel", "rad")
    long: float = between(0.5, 1.0, "length of the barrel", "m")
    foam: bool = chance(0.4, "its barrel is for foam")
    tiller: bool = chance(0.6, "it is turned by a tiller, not by a wheel")
    outlets: int = whole(0, 2, "outlets on the riser")

    def build(self, t: Table) -> Model:
        r, h, n = self.radius, self.height, t.n(self.radius)
        rims = ((2.0 * r, 0.0, 0.022), (r, 0.02, h), (1.9 * r, h - 0.05, h - 0.026), (1.9 * r, h - 0.025, h))
        t.add(_H, *(cylinder(*rim, n) for rim in rims))
        s, top = 2.6 * r, t.at(0, 0, h + 0.12 + 4.16 * r)
        bow = outline(0.35, 0.3, 1, 0.5, 1.2, 1, 1, 1.5, 0.2, 1.6, 0, 1.6)
        bend = [(0, 0, h + 0.08), (0, 0, h + 0.12), *((0, y * s, h + 0.12 + z * s) for y, z in bow)]
        joint = along("y", cylinder(1.35 * r, -0.05, 0.06, n), 0, 0, h + 0.12 + 1.6 * s)
        hub = moved(ball(1.3 * r, n), at(0, -0.02, h + 0.12 + 1.6 * s))
        t.add(_H, cylinder(1.35 * r, h, h + 0.09, n), rope(bend, r, n), joint, hub)
        top.at(0, -0.02).spun("y", np.pi / 2 - self.tilt).add(_H, self._barrel(n), of="rubber")
        t.add("bolt", around(hexagon(0.022, 0.022, 0.036), 6, 1.6 * r))
        if self.tiller:
            bar = rope([(-0.6 * r, -0.02, -0.2 * r), (-0.25, -0.02, -0.15), (-0.5, -0.02, -0.12)], 0.012, 8)
            top.add(_H, bar, rod((-0.48, -0.15, -0.12), (-0.48, 0.11, -0.12), 0.012, 8), of="clamp")
        else:
            wheel = [torus(0.09, 0.009, 18, 6), box((0.18, 0.014, 0.008)), cylinder(0.012, -0.1, 0.0, 8)]
            side = t.at(-1.35 * r - 0.09, 0, h + 0.045).spun("y", -np.pi / 2)
            side.add("handwheel", *wheel, of="rubber", own=True)
        out = merge([cylinder(0.7 * r, 0.8 * r, 2.2 * r, n), cylinder(0.95 * r, 2.0 * r, 2.6 * r, n)])
        t.add(_H, *(along(axis, out, 0, 0, 0.55 * h) for axis in ("-x", "x")[: self.outlets]), of="trim")
        return t.model()

    def _barrel(self, n: int) -> Solid:
        r, long = self.radius, self.long
        if self.foam:
            tip = outline(0.9, 0.15, 1.5, 0.2, 1.5, 1, 1.3, 1)
        else:
            tip = outline(0.95, 0.2, 0.7, 0.7, 0.75, 0.72, 1.1, 0.9, 1.1, 1)
        return turned([(r, -0.02), *((x * r, z * long) for x, z in tip)], n)


HYDRANTS: tuple[Family, ...] = families_of(DryBarrel, Standpipe, WallHydrant, Monitor)
