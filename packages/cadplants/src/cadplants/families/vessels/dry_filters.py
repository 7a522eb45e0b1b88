"""Filters without a pressure vessel: air filter boxes, spin-on cans, filter presses."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.exchangers import equipment_mouth, frame_of
from cadplants.families.vessels.vessel_fittings import sides
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES
from cadplants.solids.mesh_ops import Solid, extrude, merge
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, lofted, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["DRY_FILTERS"]


class _Filter(Device, place="floor", group="Equipment", label="filter", bundle="filter", sizes=(15,)):
    """A filter that stands on the floor."""


class AirBox(_Filter, name="filter/air box"):
    """An air filter box in a duct: a sheet case with a door and clasps, a pleated face, round or square collars."""

    width: float = between(0.4, 1.0, "of the case, across the air", "m")
    height: float = between(0.4, 1.0, "of the case", "m")
    depth: float = between(0.3, 0.7, "of the case, along the air", "m")
    low: float = between(0.1, 0.8, "height of the case's underside", "m")
    pleated: bool = chance(0.5, "an open pleated face in place of the inlet's collar")
    rounds: tuple[bool, ...] = several(
        yes(0.5),
        lambda p: 1 if p.pleated else 2,
        "whether the collar is round rather than a square hood, inlet first",
    )

    def build(self, t: Table) -> Model:
        w, h, d, low, middle = self.width, self.height, self.depth, self.low, self.low + self.height / 2
        clasps = [box((0.03, 0.03, 0.06), (0.36 * d, -w / 2 - 0.025, low + f * h)) for f in (0.25, 0.75)]
        t.add("filter", box((d, w, h), (0, 0, middle)), of="clamp")
        t.add("filter", box((0.75 * d, 0.02, 0.85 * h), (0, -w / 2 - 0.01, middle)), *clasps, of="clamp")
        if self.pleated:
            t.add("filter", self._pleats())
            rails = [box((0.05, w, 0.06 * h), (-d / 2 - 0.025, 0, low + f * h)) for f in (0.03, 0.97)]
            t.add("filter", *rails, of="clamp")
        for s, is_round in zip((1,) if self.pleated else BOTH, self.rounds, strict=True):
            t.at(0, 0, middle).along("x" if s > 0 else "-x").add("filter", *self._collar(t, is_round), of="clamp")
        if low > 0.2:
            t.add("skid frame", frame_of(d, w, low + 0.01, 0.04, rails=False))
        else:
            t.add("skid frame", *(box((d, 0.06, low), (0, s * 0.4 * w, low / 2)) for s in BOTH))
        gauge = cylinder(0.03, w / 2 - 0.005, w / 2 + 0.02, 14)
        t.at(-0.43 * d, 0, low + 0.9 * h).along("-y").add("gauge", gauge, of="dial")
        return t.model(kind="air filter")

    def _pleats(self) -> Solid:
        """The pleated sheet in the inlet's face."""
        front = -self.depth / 2
        ys = np.linspace(-0.44 * self.width, 0.44 * self.width, 2 * int(self.width / 0.05) + 1)
        folds = np.column_stack([front - 0.002 - 0.04 * (np.arange(len(ys)) % 2), ys])
        back = [(front + 0.01, ys[0]), (front + 0.01, ys[-1])]
        return extrude(np.vstack([folds[::-1], back]), self.low + 0.06 * self.height, self.low + 0.94 * self.height)

    def _collar(self, t: Table, is_round: bool) -> list[Solid]:
        """A spigot with a bead, or a hood that narrows, about z from the case's middle."""
        w, h, face = self.width, self.height, self.depth / 2
        if is_round:
            r = 0.32 * min(w, h)
            n = t.n(r)
            return [cylinder(r, face - 0.005, face + 0.12, n), cylinder(1.08 * r, face + 0.05, face + 0.06, n)]
        square = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
        steps = ((1.0, face - 0.002), (0.6, face + 0.25))
        return [lofted([np.column_stack([square * f * (h, w), np.full(4, z)]) for f, z in steps])]


class SpinOn(_Filter, name="filter/spin-on"):
    """Spin-on oil or fuel filters: cans with a fluted end under a cast head, on a bracket on a post."""

    count: int = whole(1, 3, "cans side by side")
    radius: float = between(0.035, 0.065, "of a can", "m")
    slender: float = between(2.4, 4.5, "height of a can / its radius")
    height: float = between(0.7, 1.2, "of the head's underside", "m")

    def build(self, t: Table) -> Model:
        r, z, pitch = self.radius, self.height, 2.4 * self.radius
        low, n = z - r * self.slender, sides(t.style, r)
        half, back, axis = (self.count - 1) * pitch / 2 + r, 0.9 * r, z + 0.45 * r
        xs = (np.arange(self.count) - (self.count - 1) / 2) * pitch
        can = outline(0.8 * r, low, 0.92 * r, low + 0.12 * r, 0.92 * r, low + 0.4 * r, r, low + 0.5 * r, r, z - 0.012)
        can += outline(1.04 * r, z - 0.01, 1.04 * r, z)
        flutes = around(rod((0, 0, low + 0.05 * r), (0, 0, low + 0.42 * r), 0.08 * r, 6), 12, 0.9 * r)
        for x in xs:
            t.at(x).add("filter", turned(can, n), flutes, of="handle")
        block = box(((self.count - 1) * pitch + 2 * r, 1.8 * r, 0.9 * r), (0, 0, axis))
        caps = [along("z", cylinder(0.98 * r, z - 0.001, z + 0.3 * r, n), x) for x in xs]
        t.add("filter", block, *caps, of="trim")
        nuts = [hexagon(0.034, s * (half + 0.02) - 0.012, s * (half + 0.02) + 0.012) for s in BOTH]
        t.at(0, 0, axis).along("x").add("nut", *nuts, own=False, fine=False)
        for s in BOTH:
            t.add("pipe", rod((s * (half - 0.01), 0, axis), (s * (half + 0.12), 0, axis), 0.013, 10))
        t.add("bracket", box((1.6 * half, 0.008, 2.2 * r), (0, back + 0.004, z + 0.3 * r)))
        t.add("post", box((0.06, 0.06, z + 1.4 * r), (0, back + 0.038, (z + 1.4 * r) / 2)))
        t.add("base plate", box((0.2, 0.2, 0.01), (0, back + 0.038, 0.005)))
        return t.model(kind="oil filter")


class Press(_Filter, name="filter/press", weight=0.8):
    """A filter press: a stack of square plates with handles between two heads on side bars, a hydraulic ram, legs."""

    width: float = between(0.35, 0.7, "of a plate", "m")
    axis: float = between(0.6, 0.8, "height of the plates' middle", "m")
    count: int = whole(8, 23, "plates")
    step: float = between(0.035, 0.06, "from plate to plate", "m")
    stroke: float = between(0.3, 0.6, "of the ram", "m")
    joined: bool = chance(0.6, "the plates are one mesh")

    def build(self, t: Table) -> Model:
        w, z, stack = self.width, self.axis, self.count * self.step
        end, side = 0.12 + stack + self.stroke, w / 2 + 0.04
        heads = [box((0.06, w + 0.2, 1.05 * w), (x, 0, z)) for x in (0.03, 0.06 + stack + 0.03)]
        yoke = box((0.08, w + 0.2, 0.9 * w), (end + 0.04, 0, z))
        bars = [box((end, 0.03, 0.08), (end / 2, s * (w / 2 + 0.075), z - 0.035)) for s in BOTH]
        t.add("filter", *heads, yoke, *bars, of="steel")
        plates = [self._plate(0.06 + (k + 0.5) * self.step) for k in range(self.count)]
        for solid in [merge(plates)] if self.joined else plates:
            t.add("filter", solid)
        ram = [cylinder(0.04, 0.12 + stack - 0.001, end, 14), cylinder(0.09, end + 0.07, end + 0.5, 18)]
        t.at(0, 0, z).along("x").add("filter", *ram, of="motor")
        t.add("filter", box((stack, w, 0.03), (0.06 + stack / 2, 0, z - 0.5 * w - 0.016)), of="clamp")
        tall = z - 0.4 * w
        legs = [box((0.08, 0.08, tall), (x, s * side, tall / 2)) for x in (0.04, end + 0.04) for s in BOTH]
        t.add("tank leg", *legs, own=True)
        ports: list[Port] = []
        dn = 25 if FLANGES[40].outer > 0.4 * w else 40
        for aside in (0.0, 0.3 * w):
            ports += equipment_mouth(t, dn, at(0, aside, z + aside) @ spun("y", -np.pi / 2))
        return t.model(kind="filter press", ports=ports)

    def _plate(self, x: float) -> Solid:
        """A plate with its two handles, on its place along the bars [m]."""
        w, z = self.width, self.axis
        grips = [box((0.5 * self.step, 0.1, 0.03), (x, s * (w / 2 + 0.04), z + 0.02)) for s in BOTH]
        return merge([box((0.85 * self.step, w, w), (x, 0, z)), *grips])


DRY_FILTERS = families_of(AirBox, SpinOn, Press)
