"""Further sight glasses: hygienic, caged, on machines, above funnels."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.dials import fine_sides
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import FRONT
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model
from cadplants.model.standards import PIPES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["SIGHT_BUILDS", "SIGHT_GLASS", "SightGlass"]

SIGHT_GLASS = "sight glass"


class SightGlass(Device, place="inline", group="Gauge assembly", label=SIGHT_GLASS, bundle=SIGHT_GLASS):
    """A sight glass."""


class Hygienic(SightGlass, name="sight glass/hygienic", sizes=sizes_between(20, 100)):
    """A hygienic sight glass: a bare or caged tube between two ferrules with clamps (DIN 32676), weld ends."""

    long: float = between(2.5, 5, "its length over that of its ends / radius of the pipe")
    caged: bool = chance(0.6, "a cage of bars")
    bars: int = among((3, 4, 6), "of the cage", when=lambda p: p.caged, otherwise=0)

    def build(self, t: Table) -> Model:
        radius, end, bore = t.pipe.radius, 0.035, bore_of(self.dn, t.style)
        length, r, n, lip = round(0.13 + self.long * radius, 6), 1.15 * radius, t.n(radius), 1.25 * radius + 0.008
        stub = turned(outline(radius, 0.0, radius, end - 0.008, lip, end - 0.003, lip, end), n, bore=bore)
        cap = outline(lip, end, lip, end + 0.003, 1.1 * r, end + 0.01, 1.1 * r, end + 0.02)
        metal, line = along("x", merge([turned(cap, n, bore=bore), stub])), t.along("x")
        hoop = ring(0.95 * lip, lip + 0.006, end - 0.007, end + 0.008, n)
        lug, pin = box((0.022, 0.03, 0.013), (lip + 0.012, 0, end)), cylinder(0.004, -0.028, 0.03, 8)
        band = along("x", merge([hoop, lug, along("y", pin, lip + 0.014, 0, end)]))
        flip = at(length) @ spun("z", np.pi)
        t.add(SIGHT_GLASS, metal, moved(metal, flip))
        t.add("clamp", band, moved(band, flip), own=True)
        line.add("gauge glass", ring(0.9 * r, r, end + 0.012, length - end - 0.012, n))
        if self.caged:
            bar = cylinder(0.004, end + 0.014, length - end - 0.014, 8)
            line.add(SIGHT_GLASS, around(bar, self.bars, 1.1 * r + 0.003))
        return t.model(length, "welded", SIGHT_GLASS)


class Ribbed(SightGlass, name="sight glass/ribbed", sizes=sizes_between(most=150)):
    """A tubular sight glass whose two flanges are one casting: long ribs between them leave windows for the tube."""

    long: float = between(2.5, 4.5, "its length over that of its ends / radius of the pipe")
    ribs: int = among((2, 3, 4), "between the flanges")
    wide: float = between(0.4, 0.9, "width of a rib / radius of the glass")

    def build(self, t: Table) -> Model:
        radius, size, low, bore = t.pipe.radius, t.flange, plate_thickness(self.dn), bore_of(self.dn, t.style)
        length, r = round(0.14 + self.long * radius, 6), 1.2 * radius + 0.004
        n, outer = t.n(1.2 * radius), min(1.25 * r + 0.006, size.circle / 2 - 0.6 * size.hole)
        plate = disc_flange(self.dn, t.style, low + 0.012, bore)
        rib = box((0.01, self.wide * r, length - 2 * low), (0, 0, length / 2))
        rings = [ring(0.98 * r, outer + 0.009, z - 0.008, z + 0.008, n) for z in (low + 0.02, length - low - 0.02)]
        middle = [around(rib, self.ribs, outer + 0.004, np.pi / 4), *rings]
        t.add(
            SIGHT_GLASS,
            along("x", plate),
            along("-x", plate, length),
            *(along("x", solid) for solid in middle),
            of="valve",
        )
        t.along("x").add("gauge glass", ring(0.86 * r, r, low + 0.011, length - low - 0.011, n))
        return t.model(length, kind=SIGHT_GLASS)


class _Eye(Params):
    """A bull's eye with a hexagon or a bolted ring."""

    radius: float = between(0.012, 0.03, "of the eye", "m")
    screwed: bool = chance(0.5, "screwed in by a hexagon, not bolted")
    bolts: int = among((3, 4, 6), "of its ring", when=lambda p: not p.screwed, otherwise=0)
    level: float = between(0.3, 0.7, "its height / that of the machine")

    def build(self, t: Table) -> None:
        """Puts it down about z from 0 up."""
        r, n = self.radius, t.n(self.radius)
        if self.screwed:
            t.add(SIGHT_GLASS, hexagon(2.6 * r, 0.0, 0.35 * r))
            t.add(SIGHT_GLASS, cylinder(1.1 * r, 0.35 * r, 0.5 * r, n))
            t.add("gauge glass", dome(0.85 * r, 0.3 * r, 0.5 * r, n), front=FRONT)
        else:
            t.add(SIGHT_GLASS, cylinder(1.6 * r, 0.0, 0.2 * r, n), ring(0.85 * r, 1.15 * r, 0.2 * r, 0.5 * r, n))
            t.add("gauge glass", cylinder(0.84 * r, 0.2 * r, 0.35 * r, n), front=FRONT)
            t.add("bolt", bolt_circle(self.bolts, 1.38 * r, 0.12 * r + 0.002, 0.1 * r, 0.2 * r))


class OilEye(SightGlass, name="sight glass/oil eye", place="floor", sizes=(15,)):
    """Oil sight glasses on a machine's housing: bull's eyes with a hexagon or a screwed ring, and a breather."""

    long: float = between(0.4, 0.9, "length of the housing", "m")
    deep: float = between(0.25, 0.5, "depth of the housing", "m")
    tall: float = between(0.3, 0.6, "height of the housing", "m")
    count: int = whole(1, 3, "bull's eyes")
    eyes: tuple[_Eye, ...] = several(made(_Eye), lambda p: p.count, "bull's eyes")

    def build(self, t: Table) -> Model:
        long, deep, tall = self.long, self.deep, self.tall
        t.add("tank", box((long, deep, tall), (0, deep / 2, tall / 2)))
        for k, eye in enumerate(self.eyes):
            eye.build(t.at((k - (self.count - 1) / 2) * 0.12, 0, eye.level * tall).along("-y"))
        breather = turned(outline(0.03, 0.02, 0.034, 0.05, 0.025, 0.06), 16)
        t.at(0.3 * long, 0.5 * deep, tall).add("pipe cap", cylinder(0.018, 0.0, 0.02, 14), breather, of="rubber")
        return t.model(kind=SIGHT_GLASS)


class Drip(SightGlass, name="sight glass/drip", place="floor", sizes=(15,)):
    """A drip sight: a spout over a funnel on a drain pipe, a glass cylinder and maybe two stays between them."""

    pipe: int = among((25, 40, 50), "nominal size of the drain", "mm")
    high: float = between(0.4, 0.9, "height of the drain", "m")
    wide: float = between(1.8, 2.6, "radius of the funnel / of the drain")
    gap: float = between(0.05, 0.1, "from the funnel to the head", "m")
    feed: float = between(0.3, 0.8, "height of the feed's end over the funnel and the gap", "m")
    stayed: bool = chance(0.5, "two stays between funnel and head")
    metal: str = among(("trim", "handle"), "kind of material")

    def build(self, t: Table) -> Model:
        r, high, gap = PIPES[self.pipe].radius, self.high, self.gap
        wide, n, m = self.wide * r, t.n(2 * r), t.n(r)
        top = high + 1.2 * wide
        end = top + gap
        t.add("pipe", cylinder(r, 0.0, high, m))
        t.add("pipe", cylinder(r, end + 0.058, end + self.feed, m))
        cone = outline(1.15 * r, high - 0.03, 1.15 * r, high, wide, top, 0.93 * wide, top, 0.5 * r, high + 0.01)
        head = outline(wide, end, wide, end + 0.01, 1.15 * r, end + 0.03, 1.15 * r, end + 0.06)
        metal = [
            turned(cone, n),
            turned(head, n),
            cylinder(0.6 * r, top + 0.3 * gap, end + 0.001, fine_sides(r, t.style)),
        ]
        if self.stayed:
            x = 1.02 * wide + 0.002
            metal += [rod((s * x, 0, top - 0.03), (s * x, 0, end + 0.012), 0.003, 8) for s in (-1, 1)]
            metal += [box((0.014, 0.014, 0.01), (s * wide, 0, z)) for s in (-1, 1) for z in (top - 0.006, end + 0.005)]
        t.add(SIGHT_GLASS, *metal, of=self.metal)
        t.add("gauge glass", ring(0.94 * wide, 0.99 * wide, top, end, n))
        return t.model(kind=SIGHT_GLASS)


SIGHT_BUILDS = families_of(Hygienic, Ribbed, OilEye, Drip)
