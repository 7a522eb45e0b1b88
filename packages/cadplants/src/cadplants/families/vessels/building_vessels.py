"""Small vessels of buildings and workshops: expansion vessels, hydrophores, buffers, gas bottles."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.vessel import Tank, apart
from cadplants.families.vessels.vessel_fittings import Drum, head_height, sides
from cadplants.families.vessels.vesselbuild import branch, put_vessel
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, moved, sweep
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.solids.transforms import spun

__all__ = ["BUILDING_VESSELS"]


def _half(r: float, tall: float) -> float:
    """Half the height of a membrane vessel [m]."""
    return max(0.01, tall / 2 - 0.6 * r) + 0.6 * r


def _bladder(r: float, tall: float, n: int) -> Solid:
    """A membrane vessel: two deep-drawn halves with a seam round the middle."""
    a = np.linspace(0, np.pi / 2, 7)
    deep, end = 0.6 * r, _half(r, tall)
    half = end - deep
    wall = [(r * np.sin(t), -half - deep * np.cos(t)) for t in a[1:]]
    wall += outline(r, -0.02, 1.035 * r, -0.015, 1.035 * r, 0.015, r, 0.02)
    wall += [(r * np.cos(t), half + deep * np.sin(t)) for t in a[:-1]]
    return turned([(0.0, -end), *wall, (0.0, end)], n)


class ExpansionOnFeet(Tank, name="tank/expansion on feet"):
    """A membrane expansion vessel (EN 13831) on three bent feet or a ring, its connection below, gas valve on top."""

    radius: float = between(0.18, 0.5, "of the vessel", "m")
    slender: float = between(1.8, 4.0, "height of the vessel / its radius")
    clear: float = between(0.12, 0.25, "from the floor to the vessel", "m")
    red: bool = chance(0.5, "it is painted red")
    footed: bool = chance(0.6, "three feet rather than a ring")
    covered: bool = chance(0.4, "a cover on top")

    def build(self, t: Table) -> Model:
        r, tall, low, n = self.radius, self.radius * self.slender, self.clear, sides(t.style, self.radius)
        top, high = low + tall, low + 0.5 * r
        t.at(0, 0, low + tall / 2).add("shell", _bladder(r, tall, n), of="handle" if self.red else "tank")
        if self.footed:
            sheet = box((0.006, 0.35 * r, high), (0.93 * r, 0, high / 2))
            foot = box((0.12, 0.35 * r, 0.006), (0.93 * r + 0.04, 0, 0.003))
            for k in range(3):
                apart(t.spun("z", 2.1 * k), "tank leg", sheet, foot, of="tank")
        else:
            apart(t, "skirt", ring(0.86 * r, 0.9 * r, 0.0, low + 0.35 * r, n))
        stub = [cylinder(0.017, low - 0.06, low + 0.05, 10), hexagon(0.045, low - 0.06, low - 0.03)]
        apart(t, "nozzle", *stub, of="trim")
        path = [(0, 0, low - 0.05), (0, 0, 0.05), (1.5 * r, 0, 0.05)]
        t.spun("z", 1.05).add("pipe", rope(path, 0.0134, 10))
        cap = [cylinder(0.03, top - 0.01, top + 0.025, 12), cylinder(0.008, top, top + 0.04, 8)]
        apart(t, "nozzle", *cap, of="rubber")
        if self.covered:
            apart(t, "manway", cylinder(0.3 * r, top - 0.01, top + 0.012, n), of="flange")
        return t.model(kind="expansion vessel")


class ExpansionOnWall(Tank, name="tank/expansion on wall", weight=0.8):
    """A small expansion vessel on a wall: upright or flat, held by a bracket with a strap, a hose or pipe below."""

    radius: float = between(0.12, 0.24, "of the vessel", "m")
    flat: bool = chance(0.35, "it is flat rather than upright")
    slender: float = between(1.6, 2.6, "height / radius", when=lambda p: not p.flat, otherwise=0.7)
    height: float = between(1.2, 1.7, "of its middle", "m")
    hose: bool = chance(0.5, "a hose rather than a pipe below")
    red: bool = chance(0.5, "it is painted red")

    def build(self, t: Table) -> Model:
        r, tall, n = self.radius, self.radius * self.slender, sides(t.style, self.radius)
        z, gap, half = self.height, 0.05, _half(self.radius, self.radius * self.slender)
        middle, vessel = t.at(0, 0, z), _bladder(r, tall, n)
        face, bottom = (half - 0.002, z - r) if self.flat else (r + gap, z - half)
        if self.flat:
            vessel = moved(vessel, spun("x", np.pi / 2))
            straps = [box((0.05, half, 0.004), (0, half / 2, r + 0.001))]
            straps.append(box((0.05, 0.004, 0.1), (0, half - 0.002, r + 0.04)))
        else:
            straps = [box((0.06, gap + 0.02, 0.16), (0, r + gap / 2, 0.05))]
            straps.append(box((0.16, 0.008, 0.22), (0, face - 0.004, 0.05)))
            straps.append(ring(0.97 * r, 1.015 * r, 0.04, 0.07, n))
        middle.add("shell", vessel, of="handle" if self.red else "dial")
        stub = [cylinder(0.012, bottom - 0.05, bottom + 0.02, 10), hexagon(0.03, bottom - 0.05, bottom - 0.02)]
        apart(t, "nozzle", *stub, of="trim")
        middle.add("bracket", *straps)
        path = [(0, 0, bottom - 0.04), (0, 0, bottom - 0.2), (0.3, 0, bottom - 0.2), (0.3, 0, 0.0)]
        t.add("hose" if self.hose else "pipe", rope(path, 0.012, 10))
        t.add("wall", box((1.4, 0.12, 2.2), (0, face + 0.06, 1.1)))
        return t.model(kind="expansion vessel")


class Hydrophore(Tank, name="tank/hydrophore", weight=0.8):
    """A domestic pressure tank lying on two bent feet, with a jet pump on a bracket on its back and a hose."""

    radius: float = between(0.15, 0.27, "of the shell", "m")
    slender: float = between(1.6, 3.0, "length of the shell / its radius")

    def build(self, t: Table) -> Model:
        r, length, n = self.radius, self.radius * self.slender, sides(t.style, self.radius)
        axis, end = r + 0.09, length / 2 + head_height("torispherical", r)
        lying, high = t.at(-length / 2, 0, axis).along("x"), axis - 0.8 * r
        put_vessel(lying, Drum(r, 0.0, length, n), "torispherical", "torispherical")
        corners = ((-0.9, 0.003), (-0.75, 0.003), (-0.55, high), (0.55, high), (0.75, 0.003), (0.9, 0.003))
        path = np.array([(0, y * r, z) for y, z in corners])
        foot = sweep(path, rounded_rectangle(0.05, 0.005, 0.0), up=(1.0, 0.0, 0.0))
        for x in (-0.28 * length, 0.28 * length):
            apart(t.at(x), "saddle", foot, of="tank")
        stub = [cylinder(0.4 * r, -0.02, 0.012, n), cylinder(0.016, 0.0, 0.06, 10)]
        apart(t.at(end, 0, axis).along("x"), "nozzle", *stub, of="flange")
        deck = axis + r + 0.05
        ends = [box((0.004, 0.16, 0.07), (s * 0.25 * length, 0, deck - 0.037)) for s in BOTH]
        t.add("bracket", box((0.6 * length, 0.16, 0.004), (0, 0, deck - 0.002)), *ends, of="tank")
        high = deck + 0.085
        self._pump(t.at(0, 0, high))
        run, over = end + 0.15, high + 0.16
        hose = [(-0.08, 0, high + 0.07), (-0.08, 0, over), (run, 0, over), (run, 0, axis), (end + 0.05, 0, axis)]
        t.add("hose", rope(hose, 0.016, 10))
        return t.model(kind="pressure tank")

    def _pump(self, t: Table) -> None:
        """A jet pump about x."""
        pump = t.bundled("pump")
        casing = turned(outline(0.05, -0.13, 0.085, -0.11, 0.085, -0.02, 0.06, 0.0), 20)
        motor = [cylinder(0.062, -0.005, 0.14, 20), around(box((0.012, 0.004, 0.12), (0.066, 0, 0.07)), 14)]
        seat = box((0.1, 0.1, 0.05), (0.05, 0, -0.061))
        cover = turned(outline(0.07, 0.13, 0.07, 0.19, 0.055, 0.2), 20)
        pump.along("x").add("pump casing", casing, own=True)
        pump.add("motor", *(along("x", one) for one in motor), seat, of="pump", own=True)
        pump.along("x").add("motor fan cover", cover, of="pump", own=True)


class Buffer(Tank, name="tank/insulated buffer"):
    """An insulated buffer or hot-water cylinder: a foam jacket with a seam strip, a lid, connections in rosettes."""

    radius: float = between(0.28, 0.6, "of the jacket", "m")
    tall: float = between(1.1, 2.1, "height of the jacket", "m")
    foot: float = among((0.0, 0.05, 0.1), "height of its feet", "m")
    flat: bool = chance(0.6, "its lid is flat, not domed")
    dark: bool = chance(0.5, "its lid is of dark plastic")
    side: float = among((0.0, np.pi), "where its connections are", "rad")
    levels: int = whole(3, 5, "heights with connections")
    columns: tuple[int, ...] = several(
        lambda rng, _: int(rng.integers(1, 3)), lambda p: p.levels, "connections on each height"
    )
    flanged: bool = chance(0.6, "its connections are flanged, not threaded")
    hatched: bool = chance(0.6, "a hatch")
    dials: int = whole(0, 2, "thermometers")
    legs: bool = chance(0.6, "three feet rather than a ring", when=lambda p: p.foot > 0)

    def build(self, t: Table) -> Model:
        r, tall, foot, n = self.radius, self.tall, self.foot, sides(t.style, self.radius)
        drum = Drum(r, foot, foot + tall, n)
        t.add("shell", cylinder(r, foot, drum.high, n), of="dial")
        cap = turned(outline(1.02 * r, 0, 1.02 * r, 0.04, 0.97 * r, 0.06), n)
        lid = cap if self.flat else dome(1.01 * r, 0.12, 0.0, n)
        t.at(0, 0, drum.high).add("dished head", lid, of="rubber" if self.dark else "dial")
        t.spun("z", 2.4).add("shell", box((0.012, 0.06, tall), (r + 0.004, 0, foot + tall / 2)), of="electrical")
        ports, rosette, stub = [], ring(0.021, 0.045, -drum.dip, 0.006, 16), cylinder(0.021, -0.05, 0.06, 12)
        for z, count in zip(np.linspace(0.15, 0.9, self.levels) * tall + foot, self.columns, strict=True):
            for pose in [drum.side(a, float(z)) for a in (self.side, self.side + 0.5)[:count]]:
                apart(t.moved(pose), "nozzle", rosette, *([] if self.flanged else [stub]), of="trim")
                if self.flanged:
                    port = branch(t, "plain", 32, pose, r, drum.dip)
                    ports += port if z > 0.6 else []
        if self.hatched:
            hatch = [cylinder(0.11, -drum.dip - 0.02, 0.03, 24), around(hexagon(0.024, 0.03, 0.045), 8, 0.09)]
            apart(t.moved(drum.side(4.7, foot + 0.25 * tall)), "manway", *hatch, of="flange")
        for f in (0.4, 0.75)[: self.dials]:
            t.moved(drum.side(4.7, foot + f * tall)).add("gauge", cylinder(0.035, -0.01, 0.02, 16), of="dial")
        if foot and self.legs:
            apart(t, "tank leg", around(cylinder(0.035, 0.0, foot + 0.002, 10), 3, 0.75 * r), of="rubber")
        elif foot:
            apart(t, "skirt", ring(0.85 * r, 0.93 * r, 0.0, foot + 0.002, n), of="steel")
        return t.model(kind="buffer tank", ports=ports[:: max(1, len(ports) - 1)])


class Bottles(Tank, name="tank/gas bottles", weight=0.8):
    """Gas bottles (10 to 50 l) in a rack: a frame with chains round them, maybe on a plate."""

    bottle: tuple[float, float] = among(
        ((0.115, 1.6), (0.102, 1.0), (0.07, 0.9), (0.15, 0.6)), "radius and height of a bottle", "m"
    )
    count: int = whole(1, 5, "bottles in a row")
    ranks: int = among((1, 1, 2), "bottles one behind the other")
    gap: float = between(0.02, 0.12, "between bottles", "m")
    capped: bool = chance(0.4, "caps on the valves")
    base: float = among((0.0, 0.06), "thickness of the plate below", "m")

    def build(self, t: Table) -> Model:
        (r, tall), base = self.bottle, self.base
        pitch, side = 2 * r + self.gap, 0.04
        for row in range(self.ranks):
            for x in (np.arange(self.count) - (self.count - 1) / 2) * pitch:
                self._bottle(t.at(x, -row * pitch, base).spun("z", -np.pi / 2))
        w, deep = self.count * pitch + 0.1, (self.ranks - 1) * pitch
        if base:
            t.add("skid frame", box((w, deep + pitch + 0.1, base), (0, -deep / 2, base / 2)))
        for s in BOTH:
            t.add("post", box((side, side, 1.1 * tall), (s * (w / 2 - side / 2), r + side / 2, 0.55 * tall)))
        levels, front = [base + f * tall for f in (0.3, 0.65)], -deep - r - 0.006
        t.add("beam", *(box((w, 0.02, 0.05), (0, r + 0.01, z)) for z in levels))
        for z in levels:
            chain = [(-w / 2, r, z), (-w / 2, front, z), (w / 2, front, z), (w / 2, r, z)]
            t.add("clamp", rope(chain, 0.006, 6))
        return t.model(kind="gas bottle")

    def _bottle(self, t: Table) -> None:
        """A gas bottle (EN ISO 9809) about z: round shoulder, collar, a valve or a valve cap, a concave foot."""
        r, tall = self.bottle
        n, neck, top = t.n(r, 12), 0.028 + 0.06 * r, tall - 0.2 * r
        a = np.linspace(0, np.pi / 2, 6)
        wall = outline(0.94 * r, 0.0, r, 0.03)
        wall += [(neck + (r - neck) * np.cos(one), tall - r + 0.8 * r * np.sin(one)) for one in a]
        collar = cylinder(1.25 * neck, top - 0.01, top + 0.03, 16)
        t.add("shell", turned([*wall, (neck, top + 0.01)], n), collar, of="handle")
        if self.capped:
            cap = outline(0.04, top + 0.02, 0.045, top + 0.1, 0.03, top + 0.16, 0.0, top + 0.165)
            t.add("tank", turned(cap, 16), of="trim")
            return
        spout = along("x", cylinder(0.012, 0.0, 0.045, 10), 0, 0, top + 0.05)
        wheel = [cylinder(0.028, top + 0.1, top + 0.12, 12), cylinder(0.006, top + 0.08, top + 0.11, 8)]
        t.add("valve", cylinder(0.014, top + 0.02, top + 0.09, 10), spout, *wheel)


BUILDING_VESSELS = families_of(ExpansionOnFeet, ExpansionOnWall, Hydrophore, Buffer, Bottles)
