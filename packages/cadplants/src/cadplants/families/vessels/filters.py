"""Further filters: housings with swing lids, cartridges, sand, duplex, backwash, air and oil filters."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.exchangers import Equipment, equipment_mouth, feet_of
from cadplants.families.vessels.vessel_fittings import (
    MANWAYS,
    Drum,
    Manway,
    handle,
    head,
    head_height,
    mouth,
    renamed,
    sides,
)
from cadplants.families.vessels.vesselbuild import branch
from cadplants.families.vessels.vesselfeet import FEET, Feet
from cadplants.model.family import Model, Port
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import (
    BOTH,
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["FILTERS"]

_NAME = "filter"


class _Filter(Equipment, label=_NAME, bundle=_NAME, weight=1.0):
    """A filter on the floor."""


class SwingLid(_Filter, name="filter/swing lid"):
    """A bag filter with a lid on a davit or hinge: three or four eye nuts, side inlet, bottom outlet, tripod legs."""

    radius: float = between(0.11, 0.3, "of the bowl", "m")
    tall: float = between(0.5, 1.0, "height of the bowl", "m")
    clear: float = between(0.1, 0.3, "from the floor to the bowl, but for 0.35 m", "m")
    bolts: int = among((3, 4, 6), "eye bolts")
    feet: str = among(("pipe", "tripod", "angle"), "legs")
    legs: Feet = nested(
        lambda _, p: FEET[p.feet], "legs", fixed=lambda p: {"clear": 0.35 + p.clear + head_height("2:1", p.radius)}
    )
    below: bool = chance(0.5, "its outlet is below, not on the side")

    def build(self, t: Table) -> Model:
        r, n, deep = self.radius, sides(t.style, self.radius), head_height("2:1", self.radius)
        low = 0.35 + self.clear + deep
        drum, high, wide = Drum(r, low, low + self.tall, n), low + self.tall, 1.3 * r
        bottom = moved(head("2:1", r, t.style, n), at(0, 0, low) @ spun("x", np.pi))
        t.add(_NAME, drum.solid(t.style), bottom, ring(0.97 * r, wide, high - 0.03, high, n), of="trim")
        crown = t.at(0, 0, high)
        lid = outline(wide, 0, wide, 0.03, 0.9 * r, 0.035, 0.5 * r, 0.3 * r, 0.0, 0.34 * r)
        grip = handle(0.4 * r, 0.06, 0.2 * r, 0.4 * r + 0.04, 0.008, 8)
        crown.add(_NAME, turned(lid, n), grip, of="trim")
        eye = [rod((0, 0, -0.07), (0, 0, 0.09), 0.009, 8), hexagon(0.03, 0.03, 0.05)]
        eye.append(moved(torus(0.025, 0.006, 12, 6), at(0, 0, 0.115) @ spun("x", np.pi / 2)))
        crown.add("bolt", around(merge(eye), self.bolts, 1.2 * r, 0.5))
        hinge = [box((0.1, 0.05, 0.02), (0.02, 0, 0.015)), along("y", cylinder(0.012, -0.05, 0.05, 8), 0.06)]
        crown.at(wide).add(_NAME, *hinge, box((0.07, 0.08, 0.02), (0.02, 0, -0.015)), of="trim")
        t.extend(feet_of(self.legs.parts(drum, t.style), _NAME))
        dn = 50 if r > 0.16 else 25
        if self.below:
            t.at(0, 0, low - deep).along("-z").extend(renamed(mouth("plain", dn, 0.15, t.style, 0.0, 0.02), _NAME))
        ports = equipment_mouth(t, dn, drum.side(np.pi, low + 0.8 * self.tall), r, drum.dip)
        if not self.below:
            ports += equipment_mouth(t, dn, drum.side(0.0, low + 0.12 * self.tall), r, drum.dip)
        return t.model(kind="bag filter", ports=ports)


class MultiRound(_Filter, name="filter/multi-round"):
    """A multi-cartridge housing: a polished hood on a base pan with a V-clamp or wing nuts, mouths below."""

    radius: float = between(0.09, 0.25, "of the hood", "m")
    tall: float = among((0.3, 0.55, 0.8, 1.05), "height of the hood", "m")
    clear: float = between(0.25, 0.45, "from the floor to the pan", "m")
    crown: float = between(0.25, 0.6, "height of the hood's dome / its radius")
    banded: bool = chance(0.55, "a V-clamp rather than wing nuts")
    bolts: int = among((4, 6, 8), "wing nuts", when=lambda p: not p.banded, otherwise=0)

    def build(self, t: Table) -> Model:
        r, low, n, wide = self.radius, self.clear, sides(t.style, self.radius), 1.08 * self.radius
        tall, crown, closing = self.tall, self.crown * r, t.at(0, 0, low + 0.12)
        pan = outline(0.6 * r, -0.12, r, -0.06, r, -0.012, wide, -0.01, wide, 0)
        closing.add(_NAME, turned(pan, n), of="trim")
        hood = outline(wide, 0, wide, 0.01, r, 0.012, r, tall, 0.8 * r, tall + 0.7 * crown)
        hood += outline(0.3 * r, tall + crown, 0.0, tall + crown)
        closing.add(_NAME, turned(hood, n), of="trim")
        if self.banded:
            x = 1.16 * r
            lock = [box((0.05, 0.05, 0.03), (x + 0.01, 0, 0)), rod((x, -0.06, 0), (x, 0.06, 0), 0.006, 8)]
            lock.append(moved(ring(0.008, 0.025, -0.004, 0.004, 12), at(x, 0.065) @ spun("x", np.pi / 2)))
            closing.add("clamp", ring(0.99 * r, 1.14 * r, -0.018, 0.018, n), *lock, of="trim", own=True)
        else:
            wing = [rod((0, 0, -0.04), (0, 0, 0.06), 0.006, 8), box((0.01, 0.06, 0.014), (0, 0, 0.035))]
            closing.add("bolt", around(merge(wing), self.bolts, 1.07 * r))
        vent = [cylinder(0.008, -0.005, 0.05, 8), box((0.05, 0.008, 0.008), (0, 0, 0.045))]
        closing.at(0, 0, tall + crown).add(_NAME, *vent, of="trim")
        ports: list[Port] = []
        for a in (0.0, np.pi):
            pose = spun("z", a) @ at(0.92 * r, 0, low + 0.05) @ spun("y", np.pi / 2)
            ports += equipment_mouth(t, 50 if r > 0.17 else 25, pose, 0.0, 0.2 * r)
        foot = merge([rod((0, 0, 0), (0, 0, low + 0.05), 0.014, 8), cylinder(0.035, 0, 0.008, 12)])
        t.add("tank leg", around(foot, 3, 0.8 * r, np.pi / 6 + 0.5), of="trim", own=True)
        return t.model(kind="cartridge filter", ports=ports)


class SandBall(_Filter, name="filter/sand ball"):
    """A sand filter as pools have it: a plastic ball on a plinth, a six-way valve beside or on top."""

    radius: float = between(0.2, 0.5, "of the ball", "m")
    stretch: float = between(0.9, 1.3, "height of the ball / its width")
    beside: bool = chance(0.5, "its valve is beside, not on top")
    gauged: bool = chance(0.6, "a gauge on the valve")

    def build(self, t: Table) -> Model:
        r, n, stretch, low = self.radius, sides(t.style, self.radius), self.stretch, 0.12
        z, top = low + stretch * r, low + 2 * stretch * r
        a = np.linspace(-np.pi / 2, np.pi / 2, 15)[1:-1]
        wall = [(0.0, low), *((r * np.cos(one), z + stretch * r * np.sin(one)) for one in a), (0.0, top)]
        t.add(_NAME, turned(wall, n), ring(0.98 * r, 1.03 * r, z - 0.015, z + 0.015, n), of="tank")
        plinth = outline(0.85 * r, 0.0, 0.75 * r, 0.06, 0.7 * r, low + 0.25 * r)
        t.add(_NAME, turned(plinth, n), of="rubber")
        crown, valve = t.at(0, 0, top), t.at(0, 0, top + 0.059)
        if self.beside:
            knobs = around(box((0.03, 0.03, 0.03), (0, 0, 0.03)), 8, 0.42 * r)
            crown.add(_NAME, cylinder(0.42 * r, -0.06 * r, 0.05, n), knobs, dome(0.38 * r, 0.1 * r, 0.049, n))
            x, middle, half = r + 0.22, z - 0.02, 0.16 * stretch
            levels = [middle + s * 0.12 * stretch for s in BOTH]
            arms = [rod((0.9 * r, 0, level), (x, 0, level), 0.03, 12) for level in levels]
            column = moved(cylinder(0.045, middle - half, z + half, 12), at(x))
            t.add("pipe", *arms, column, of="dial", own=True)
            valve = t.at(x, 0, z + half - 0.01)
        else:
            crown.add(_NAME, cylinder(0.3 * r, -0.05 * r, 0.06, n))
        body = turned(outline(0.07, 0.0, 0.085, 0.02, 0.085, 0.12, 0.1, 0.125, 0.1, 0.145, 0.05, 0.165), 20)
        ways = [rod((0.0, 0, 0.06), (0.14 * np.cos(w), 0.14 * np.sin(w), 0.06), 0.03, 10) for w in (0.0, 2.1, 4.2)]
        valve.add("valve body", body, *ways, of="rubber", own=True)
        lever = box((0.22, 0.03, 0.02), (0.06, 0, 0.175)), cylinder(0.02, 0.16, 0.19, 10)
        valve.add("lever", *lever, of="rubber", own=True)
        if self.gauged:
            valve.at(0, 0, 0.08).along("-y").add("gauge", cylinder(0.025, 0.08, 0.11, 14), of="dial")
        return t.model(kind="sand filter")


class MediaVessel(_Filter, name="filter/media vessel", weight=0.9):
    """A pressure media filter (sand, carbon, softener): a dished vessel with face piping of valves in front."""

    radius: float = between(0.3, 0.7, "of the shell", "m")
    slender: float = between(1.4, 2.8, "height of the shell / its radius")
    legged: bool = chance(0.7, "on legs rather than a skirt")
    feet: str = among(("pipe", "angle"), "legs", when=lambda p: p.legged, otherwise="open")
    stand: Feet = nested(
        lambda _, p: FEET[p.feet],
        "what it stands on",
        fixed=lambda p: {"clear": head_height("torispherical", p.radius) + 0.3},
    )
    swing: bool = chance(0.5, "its manway has swing bolts rather than bridges")
    manway: Manway = nested(lambda _, p: MANWAYS["swing" if p.swing else "oval"], "manway")
    pipe: int = among((40, 50, 65), "nominal size of the piping", "mm")
    valves: int = whole(2, 4, "valves")

    def build(self, t: Table) -> Model:
        r, n, deep = self.radius, sides(t.style, self.radius), head_height("torispherical", self.radius)
        low, height, pr, x = deep + 0.3, r * self.slender, PIPES[self.pipe].radius, self.radius + 0.35
        drum, cap = Drum(r, low, low + height, n), head("torispherical", r, t.style, n)
        heads = moved(cap, at(0, 0, drum.high)), moved(cap, at(0, 0, low) @ spun("x", np.pi))
        t.add(_NAME, drum.solid(t.style), *heads, of="tank")
        t.extend(feet_of(self.stand.parts(drum, t.style), _NAME))
        manway = self.manway.parts(t.style, 0.14 if r < 0.5 else 0.2, r, drum.dip)
        t.moved(drum.side(1.9, low + 0.75 * height)).extend(renamed(manway, _NAME))
        k, middle = t.n(pr), 0.5 * (low + drum.high)
        for end, s, over in ((drum.high + deep, 1, 0.16), (low - deep, -1, 0.12)):
            z = end + s * over
            t.add("pipe", rope([(0, 0, end - s * 0.03), (0, 0, z), (x, 0, z), (x, 0, middle)], pr, k))
        t, reach = t.bundled("valve").at(x), 2 * pr + 0.1
        disc = [along("y", cylinder(1.7 * pr + 0.02, 0.2, 0.25, k)), rod((0, 0.225, 0), (reach, 0.225, 0), 0.012, 8)]
        cap = cylinder(1.3 * pr + 0.02, reach - 0.02, reach + 0.1, 16)
        for z in np.linspace(low + 0.1 * height, drum.high - 0.1 * height, self.valves):
            level = t.at(0, 0, z)
            level.add("pipe", rod((0, 0, 0), (0, 0.55, 0), pr, k))
            level.add("valve body", *disc, own=True)
            level.at(0, 0.225).along("x").add("actuator", cap, own=True)
        return t.model(kind="media filter")


class Duplex(_Filter, name="filter/duplex"):
    """A duplex filter: two pots with bolted lids, change-over valves between them on one lever or wheel."""

    pipe: int = among((25, 40, 50, 80), "nominal size of its mouths", "mm")
    wall: float = between(0.04, 0.09, "radius of a pot, but for 1.6 of the pipe's", "m")
    slender: float = between(2.2, 4.0, "height of a pot / its radius")
    bolts: int = among((4, 6, 8), "bolts of a lid")
    wheeled: bool = chance(0.5, "a wheel rather than a lever")

    def build(self, t: Table) -> Model:
        dn, pr = self.pipe, PIPES[self.pipe].radius
        r, low, k = 1.6 * pr + self.wall, 0.25, t.n(pr)
        tall, n, gap = r * self.slender, sides(t.style, r), 1.25 * r + pr + 0.03
        top, rim, wide = low + tall, low + tall - 0.03, 1.22 * r
        pot = turned(outline(0.5 * r, low - 0.3 * r, 0.9 * r, low - 0.1 * r, r, low, r, rim, wide, rim, wide, top), n)
        drain = cylinder(0.014, low - 0.3 * r - 0.04, low - 0.28 * r, 8)
        cover = turned(outline(wide, top, wide, top + 0.025, 0.6 * r, top + 0.03, 0.5 * r, top + 0.06), n)
        x = 0.3 * r
        grip = rope([(-x, 0, top + 0.05), (-x, 0, top + 0.1), (x, 0, top + 0.1), (x, 0, top + 0.05)], 0.006, 6)
        for solids in ((pot, drain), (cover, grip)):
            for s in BOTH:
                t.at(0, s * gap).add(_NAME, *solids, of="valve")
        bolts = bolt_circle(self.bolts, 1.12 * r, 0.012, rim, top + 0.025)
        t.add("bolt", *(moved(bolts, at(0, s * gap)) for s in BOTH))
        ports: list[Port] = []
        levels = ((low + 0.25 * tall, -1), (low + 0.72 * tall, 1))
        cross = along("y", cylinder(1.15 * pr, 0.9 * r - gap, gap - 0.9 * r, k))
        for z, s in levels:
            t.at(0, 0, z).add(_NAME, cylinder(1.5 * pr, -1.7 * pr, 1.7 * pr, k), cross, of="valve")
            ports += equipment_mouth(t, dn, at(s * 1.3 * pr, 0, z) @ spun("y", s * np.pi / 2), 0.0, 0.2 * pr)
        over = t.at(0, 0, top + 0.12)
        if self.wheeled:
            spokes = box((1.6 * r, 0.02, 0.01)), box((0.02, 1.6 * r, 0.01))
            over.add("handwheel", torus(0.8 * r, 0.01, 20, 6), *spokes, own=True)
        else:
            over.add("lever", box((0.035, 0.3 + 2 * r, 0.012), (0, 0.1 + 0.6 * r, 0)), own=True)
        t.add("valve stem", *(cylinder(0.012 + 0.1 * pr, z, top + 0.12, 10) for z, _ in levels), own=True)
        foot = [box((0.05, 0.05, low + 0.1), (0, 0, (low + 0.1) / 2)), box((0.1, 0.1, 0.008), (0, 0, 0.004))]
        spots = [at(x, s * gap) for s in BOTH for x in (-r, r)]
        t.add("tank leg", *(moved(one, spot) for spot in spots for one in foot), own=True)
        return t.model(kind="duplex filter", ports=ports)


class DiscBattery(_Filter, name="filter/disc battery", weight=0.9):
    """A battery of disc filters that backwash: plastic bells with clamps between two manifolds, valves below."""

    count: int = whole(2, 5, "filters")
    radius: float = among((0.1, 0.13), "of a bell", "m")
    pipe: int = among((80, 100, 150), "nominal size of the manifolds", "mm")
    gap: float = between(0.08, 0.16, "between bells", "m")
    tall: float = between(0.35, 0.6, "height of a bell", "m")

    def build(self, t: Table) -> Model:
        r, n, pr, tall = self.radius, sides(t.style, 0.12), PIPES[self.pipe].radius, self.tall
        wide, low, off, pitch = 1.05 * r, 0.45 + pr, r + pr, 2 * r + self.gap
        half, k = (self.count - 1) * pitch / 2, t.n(pr)
        bell = outline(wide, 0.2, wide, 0.24, r, 0.25, 0.95 * r, 0.2 + 0.8 * tall, 0.5 * r, 0.2 + tall, 0, 0.21 + tall)
        base = [turned(outline(0.06, 0.05, r, 0.15, wide, 0.16, wide, 0.2), n)]
        base += [rod((0, s * off, 0), (0, 0, 0.12), 0.045, 10) for s in BOTH]
        for x in (np.arange(self.count) - (self.count - 1) / 2) * pitch:
            spot = t.at(x, 0, low)
            spot.add(_NAME, turned(bell, n), of="rubber")
            spot.add(_NAME, *base, of="rubber")
            spot.add("clamp", ring(r, 1.12 * r, 0.185, 0.215, n), of="trim")
            spot.add("valve", cylinder(0.06, 0.0, 0.055, 14), of="rubber")
        ports: list[Port] = []
        for s in BOTH:
            t.at(0, s * off, low).along("x").add("pipe", cylinder(pr, -half - 0.25, half + 0.25, k))
            end = Table(t.style, "Tank")
            ports += branch(end, "plain", self.pipe, at(-half - 0.24, s * off, low) @ spun("y", -np.pi / 2))
            for i, part in enumerate(end.parts):
                t.add("flange" if i else "pipe", part.solid, of="flange")
        tall = low - pr + 0.01
        stand = [box((0.05, 0.05, tall), (0, s * off, tall / 2)) for s in BOTH]
        for x in (-0.7 * half - 0.1, 0.7 * half + 0.1):
            t.at(x).add("skid frame", *stand, box((0.05, 2 * off, 0.05), (0, 0, 0.1)))
        return t.model(kind="disc filter", ports=ports)


FILTERS = families_of(SwingLid, MultiRound, SandBall, MediaVessel, Duplex, DiscBattery)
