"""Heat exchangers, radiators, boilers, burners, filters, separators; mostly one mesh or few."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle, flanged_body
from cadplants.families.vessels.exchangers import Equipment
from cadplants.families.vessels.radiators import wall_behind
from cadplants.families.vessels.vessel import head_profile, nozzle
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    CORNERS,
    along,
    around,
    box,
    cylinder,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, looking, spun

__all__ = ["EQUIPMENT"]

_HEX, _RAD, _BOILER = "heat exchanger", "radiator", "boiler"
_BURNER, _FILTER, _SEPARATOR = "burner", "filter", "separator"


class _Exchanger(Equipment, label=_HEX, bundle=_HEX, weight=1.0):
    """A heat exchanger."""


class ShellTube(_Exchanger, name="heat exchanger/shell-and-tube", weight=2):
    """A shell-and-tube exchanger (TEMA): a shell with two nozzles, channel and cover flanges, saddles."""

    radius: float = between(0.12, 0.4, "of the shell", "m")
    slender: float = between(5, 10, "length of the shell / its radius")
    clear: float = between(0.25, 0.5, "from the floor to the shell", "m")
    flat: bool = chance(0.5, "the channel ends in a flat cover, not a dished head")
    end: str = among(("2:1", "torispherical", "flat"), "head at the other end")
    size: int = among((50, 80, 100), "nominal size of the nozzles", "mm", when=lambda p: p.radius > 0.2, otherwise=40)

    def build(self, t: Table) -> Model:
        r, n, half, axis = self.radius, t.n(self.radius), self.slender * self.radius / 2, self.radius + self.clear
        collar, plate, channel, lying = 1.2 * r + 0.02, 0.03 + 0.05 * r, 0.9 * r + 0.1, at(0, 0, axis)
        pair = [cylinder(collar, -plate, 0, n), cylinder(collar, 0.004, plate + 0.004, n)]
        shell = [along("x", cylinder(r, -half, half, n), 0, 0, axis)]
        shell += [along("x", one, x, 0, axis) for x in (-half, half) for one in pair]
        reach, aside = 0.1 + 0.2 * FLANGES[self.size].outer, -half - 0.5 * channel
        ports = []
        for x, s in ((-0.7 * half, 1), (0.7 * half, -1), (aside, 1), (aside, -1)):
            pose = lying @ at(x, 0, s * r) @ spun("x", 0.0 if s > 0 else np.pi)
            shell += [moved(p.solid, pose) for p in nozzle(self.size, reach, t.style)]
            ports += [Port(looking((x, 0, axis + r + reach), (0, 0, 1)), self.size)] if s > 0 else []
        t.add(_HEX, *shell, of="tank")
        cover, far = cylinder(collar, 0, plate, n), turned(head_profile(self.end, r), n)
        near = cover if self.flat else turned(head_profile("2:1", r), n)
        ends = [along("-x", cylinder(r, half, half + channel, n)), along("-x", near, -half - channel)]
        t.at(0, 0, axis).add(_HEX, *ends, along("x", far, half + plate), of="tank")
        tall = axis - 0.6 * r
        foot = [box((0.02, 1.6 * r, tall), (0, 0, tall / 2)), box((0.2, 1.7 * r, 0.015), (0, 0, 0.0075))]
        t.add("saddle", *(moved(one, at(x)) for x in (-0.45 * half, 0.45 * half) for one in foot), own=True)
        bolts = bolt_circle(max(8, int(30 * r)), 1.1 * r + 0.01, 0.016, -plate, plate + 0.004)
        t.add("bolt", *(along("x", bolts, x, 0, axis) for x in (-half, half)))
        return t.model(kind="shell-and-tube heat exchanger", ports=ports)


class Plate(_Exchanger, name="heat exchanger/plate", weight=1.5):
    """A gasketed plate exchanger: a fixed plate, a stack of thin ones, a pressure plate, carrying bars, tie bolts."""

    width: float = between(0.25, 0.6, "of the plates", "m")
    tall: float = between(0.7, 1.6, "height of the plates", "m")
    stack: float = between(0.2, 0.8, "length of the stack", "m")
    size: int = among(
        lambda p: tuple(dn for dn in (40, 50, 65, 80) if FLANGES[dn].outer < 0.55 * p.width),
        "nominal size of the mouths",
        "mm",
    )

    def build(self, t: Table) -> Model:
        wide, tall, stack, thick, low = self.width, self.tall, self.stack, 0.035, 0.05
        high, end, dn = low + tall, stack + 0.45, self.size
        ends = [box((thick, wide * 1.15, high), (0, 0, high / 2))]
        ends.append(box((thick, wide * 1.15, tall), (thick + stack, 0, low + tall / 2)))
        ports = []
        for s in BOTH:
            y = s * 0.28 * wide
            for f in (0.14, 0.86):
                pose = at(-thick / 2, y, low + f * tall) @ spun("y", -np.pi / 2)
                ends += [moved(p.solid, pose) for p in nozzle(dn, 0.12, t.style)]
            ports.append(Port(looking((-thick / 2 - 0.12, y, low + 0.86 * tall), (-1, 0, 0)), dn))
        t.add(_HEX, *ends, of="valve")
        count = int(np.clip(stack / 0.02, 8, 40))
        step, mid = stack / count, low + tall / 2
        xs, sides = thick / 2 + (np.arange(count) + 0.5) * step, (1.0, 0.97)
        t.add(_HEX, *(box((step, sides[k % 2] * wide, 0.95 * tall), (x, 0, mid)) for k, x in enumerate(xs)), of="trim")
        rails = [rod((0, 0, z), (end, 0, z), 0.02, 10) for z in (high + 0.02, low - 0.005)]
        t.add(_HEX, *rails, box((0.06, 0.12, high + 0.06), (end, 0, (high + 0.06) / 2)), of="steel")
        spots = [(s * 0.54 * wide, low + f * tall) for s in BOTH for f in (0.15, 0.5, 0.85)]
        ties = [rod((-0.05, y, z), (stack + thick + 0.08, y, z), 0.012, 8) for y, z in spots]
        t.add("stud", *ties, *(along("x", hexagon(0.035, -0.045, -0.02), 0, y, z) for y, z in spots))
        return t.model(kind="plate heat exchanger", ports=ports)


class Brazed(_Exchanger, name="heat exchanger/brazed"):
    """A brazed plate exchanger: a small ribbed brick with four threaded stubs, on a bracket."""

    width: float = between(0.08, 0.2, "of the plates", "m")
    tall: float = between(0.2, 0.5, "height of the plates", "m")
    deep: float = between(0.05, 0.25, "length of the stack", "m")

    def build(self, t: Table) -> Model:
        wide, tall, deep, lift = self.width, self.tall, self.deep, 0.15
        shape, count = rounded_rectangle(wide, tall, 0.25 * wide, 4), max(4, int(deep / 0.01))
        step = deep / count
        ribs = [extrude((1.0 if k % 2 else 0.96) * shape, k * step, (k + 1) * step) for k in range(count)]
        stub = merge([cylinder(0.017, 0, 0.04, 12), hexagon(0.042, 0.0, 0.008)])
        stubs = [moved(stub, at(sx * 0.28 * wide, sy * 0.36 * tall, deep - 0.001)) for sx, sy in CORNERS]
        t.at(0, 0, lift + tall / 2).along("-y").add(_HEX, *ribs, *stubs, of="trim")
        high = lift + 0.3 * tall
        t.add("bracket", box((wide, 0.004, high), (0, 0.002, high / 2)), box((wide, 0.12, 0.006), (0, 0, 0.003)))
        return t.model(kind="plate heat exchanger")


class AirCooled(_Exchanger, name="heat exchanger/air cooled"):
    """A finned cooler: a bundle of thin fins between headers, a round fan shroud on top, legs."""

    width: float = between(0.8, 1.8, "of the bundle", "m")
    depth: float = between(0.6, 1.2, "of the bundle", "m")
    height: float = between(0.12, 0.25, "of the bundle", "m")
    low: float = between(0.5, 1.0, "from the floor to the bundle", "m")

    def build(self, t: Table) -> Model:
        w, d, h, low = self.width, self.depth, self.height, self.low
        top, middle, small = low + h, low + h / 2, min(w, d)
        heads = [box((0.08, d + 0.04, h + 0.06), (s * (w / 2 + 0.02), 0, middle)) for s in BOTH]
        mouth, turn = nozzle(40, 0.1, t.style), spun("y", -np.pi / 2)
        spots = [at(-w / 2 - 0.06, y, middle) @ turn for y in (-0.3 * d, 0.3 * d)]
        t.add(_HEX, *heads, *(moved(p.solid, spot) for spot in spots for p in mouth), of="tank")
        t.add(_HEX, *(box((0.004, d, h), (x, 0, middle)) for x in np.linspace(-0.45 * w, 0.45 * w, 36)), of="trim")
        blades = around(box((0.3 * small, 0.08, 0.006), (0.2 * small, 0, 0)), 5)
        hub = cylinder(0.08 * small, top + 0.09, top + 0.22, 16)
        shroud = ring(0.38 * small, 0.42 * small, top + 0.1, top + 0.25, t.n(0.4))
        hood = box((w, d, 0.1), (0, 0, top + 0.05))
        t.add("blower", hood, shroud, hub, moved(blades, at(0, 0, top + 0.2)), of="clamp")
        t.add("column", *(box((0.06, 0.06, top), (sx * (w / 2 + 0.02), sy * d / 2, top / 2)) for sx, sy in CORNERS))
        ports = [Port(looking((-w / 2 - 0.16, y, middle), (-1, 0, 0)), 40) for y in (-0.3 * d, 0.3 * d)]
        return t.model(kind="air cooler", ports=ports)


class PanelRadiator(Equipment, name="radiator/panel", label=_RAD, bundle=_RAD, weight=1.2):
    """A panel radiator (EN 442): one or two ribbed plates with convector fins between, a grille and side covers."""

    width: float = among((0.6, 0.8, 1.0, 1.4, 1.8), "of the panels", "m")
    height: float = among((0.3, 0.5, 0.6, 0.9), "of the panels", "m")
    panels: int = among((1, 2, 2, 3), "panels")
    covered: bool = chance(0.6, "a grille and side covers")

    def build(self, t: Table) -> Model:
        w, h, count, low, gap = self.width, self.height, self.panels, 0.12, 0.05
        steps, middle, deep = int(w / 0.0333), (count - 1) * gap / 2, (count - 1) * gap + 0.02
        xs, wave = np.linspace(-w / 2, w / 2, 4 * steps + 1), np.tile([0.0, 0.0, 0.006, 0.006], steps)
        front = np.column_stack([xs, -0.004 - np.append(wave, 0.0)])
        panel = extrude(np.vstack([front, [(w / 2, 0.004), (-w / 2, 0.004)]]), low, low + h)
        t.add(_RAD, *(moved(panel, at(0, k * gap)) for k in range(count)))
        spots = [(x, gap / 2 + j * gap) for x in np.linspace(-0.48 * w, 0.48 * w, 24) for j in range(count - 1)]
        t.add(_RAD, *(box((0.001, 0.88 * gap, 0.85 * h), (x, y, low + h / 2)) for x, y in spots))
        if self.covered:
            t.add(_RAD, box((w, deep, 0.012), (0, middle, low + h + 0.006)))
            t.add(_RAD, *(box((0.004, deep, h), (s * w / 2, middle, low + h / 2)) for s in BOTH))
        ends = [(s, low + f * h) for s in BOTH for f in (0.06, 0.94)]
        t.add(_RAD, *(rod((s * w / 2, 0, z), (s * (w / 2 + 0.03), 0, z), 0.011, 10) for s, z in ends), of="trim")
        t.add("bracket", *(box((0.03, 0.06, low), (s * 0.35 * w, deep / 2, low / 2)) for s in BOTH))
        return t.model(kind="radiator")


class ColumnRadiator(Equipment, name="radiator/column", label=_RAD, bundle=_RAD, weight=1.2):
    """A column radiator: sections of two to four upright tubes between hubs, with feet; or a towel ladder."""

    height: float = among((0.5, 0.6, 0.9, 1.5, 1.8), "of its tubes", "m")
    sectioned: bool = chance(0.7, "of sections rather than a towel ladder")
    count: int = whole(5, 13, "sections", when=lambda p: p.sectioned)
    columns: int = whole(2, 4, "columns of a section", when=lambda p: p.sectioned)
    width: float = among((0.45, 0.6), "of a towel ladder", "m", when=lambda p: not p.sectioned, otherwise=0.0)

    def build(self, t: Table) -> Model:
        n, low, top = t.n(0.0125, 6, 12), 0.1, 0.1 + self.height
        if not self.sectioned:
            for x in (-self.width / 2, self.width / 2):
                t.add(_RAD, rod((x, 0, low), (x, 0, top), 0.018, n))
            x, zs = self.width / 2, np.linspace(low + 0.05, top - 0.05, int(self.height / 0.06))
            t.add(_RAD, *(rod((-x, -0.01, z), (x, -0.01, z), 0.011, n) for z in zs if (z * 7) % 1.0 > 0.2))
            holders = [rod((s * x, 0, z), (s * x, 0.09, z), 0.009, 8) for s in BOTH for z in (low + 0.1, top - 0.1)]
            t.add("bracket", *holders, of="trim")
            t.extend([wall_behind(self.width + 0.8, top + 0.4, 0.09)])
            return t.model(kind="radiator")
        pitch, gap, deep, hubs = 0.046, 0.036, (self.columns - 1) * 0.036, (low + 0.02, top - 0.02)
        section = [rod((0, c * gap, low + 0.03), (0, c * gap, top - 0.03), 0.0125, n) for c in range(self.columns)]
        section += [box((0.036, deep + 0.05, 0.05), (0, deep / 2, z)) for z in hubs]
        for k in range(self.count):
            t.at(k * pitch).add(_RAD, *section)
        for z in hubs:
            t.add(_RAD, rod((-0.04, deep / 2, z), (self.count * pitch, deep / 2, z), 0.017, n))
        foot, xs = (0.02, deep + 0.04, low), (0, (self.count - 1) * pitch)
        t.add(_RAD, *(box(foot, (x, deep / 2, low / 2)) for x in xs))
        return t.model(kind="radiator")


class Packaged(Equipment, name="boiler/packaged", label=_BOILER, bundle=_BOILER, weight=1.8):
    """A fire-tube boiler with a burner, or a cabinet boiler with a flue."""

    fire_tube: bool = chance(0.5, "a fire-tube boiler rather than a cabinet")
    radius: float = between(0.4, 0.8, "of the drum", "m", when=lambda p: p.fire_tube)
    slender: float = between(2.2, 3.2, "length of the drum / its radius", when=lambda p: p.fire_tube)
    width: float = between(0.45, 0.9, "of the cabinet", "m", when=lambda p: not p.fire_tube)
    depth: float = between(0.4, 1.0, "of the cabinet", "m", when=lambda p: not p.fire_tube)
    height: float = between(0.8, 1.6, "of the cabinet", "m", when=lambda p: not p.fire_tube)

    def build(self, t: Table) -> Model:
        return self._drum(t) if self.fire_tube else self._cabinet(t)

    def _drum(self, t: Table) -> Model:
        r, n, length, axis = self.radius, t.n(self.radius), self.slender * self.radius, self.radius + 0.25
        half, lift = length / 2, 0.26 + 0.3 * r
        drum = [along("x", cylinder(r, -half, half, n))]
        drum += [along("x", cylinder(1.06 * r, x - 0.06, x + 0.06, n)) for x in (-half, half)]
        drum.append(along("-x", ring(0.5 * r, 0.8 * r, half + 0.05, half + 0.1, n)))
        drum.append(moved(cylinder(0.22 * r, 0.9 * r, 2.3 * r, n), at(0.35 * length)))
        for x in (-0.2 * length, 0.05 * length):
            drum += [moved(p.solid, at(x, 0, r)) for p in nozzle(80, 0.2, t.style)]
        t.at(0, 0, axis).add(_BOILER, *drum)
        skid = [box((0.9 * length, 0.12, lift), (0, s * 0.5 * r, lift / 2)) for s in BOTH]
        t.add(_BOILER, *skid, box((0.7 * length, 0.5 * r, 0.02), (0, 0, axis + 1.02 * r)), of="steel")
        _burner(t.bundled(_BURNER).at(-half - 0.05, 0, axis).spun("z", np.pi), 0.32 * r)
        return t.model(kind="boiler", ports=[Port(looking((-0.2 * length, 0, axis + r + 0.2), (0, 0, 1)), 80)])

    def _cabinet(self, t: Table) -> Model:
        w, d, h = self.width, self.depth, self.height
        case = extrude(rounded_rectangle(w, d, 0.03, 3), 0.06, h)
        flue = moved(cylinder(0.07, h - 0.01, h + 0.6, t.n(0.07)), at(0.2 * w, 0.2 * d))
        stubs = [moved(cylinder(0.021, h - 0.01, h + 0.08, 12), at(x * w, 0.25 * d)) for x in (-0.35, -0.2, -0.05)]
        t.add(_BOILER, case, box((0.9 * w, 0.9 * d, 0.06), (0, 0, 0.03)), flue, *stubs, of="dial")
        door = box((0.85 * w, 0.02, 0.5 * h), (0, -d / 2 - 0.01, 0.4 * h))
        t.add(_BOILER, door, box((0.8 * w, 0.03, 0.15 * h), (0, -d / 2 - 0.015, 0.82 * h)), of="electrical")
        return t.model(kind="boiler")


def _burner(t: Table, r: float) -> None:
    """A forced-draught burner about x, its flange at 0 and its head towards -x, its fan housing towards +x."""
    n = t.n(r)
    head = [along("x", cylinder(1.1 * r, 0.0, 0.02, n)), along("-x", cylinder(0.6 * r, 0.0, 0.8 * r, n))]
    house = box((1.6 * r, 1.5 * r, 1.7 * r), (0.85 * r, 0, 0))
    t.add(_BURNER, *head, house, along("y", cylinder(1.15 * r, -0.55 * r, 0.55 * r, n), 0.9 * r, 0, 0.15 * r))
    motor = turned(outline(0.45 * r, 0.5 * r, 0.45 * r, 1.6 * r, 0.35 * r, 1.7 * r), n)
    control = box((0.8 * r, 0.5 * r, 0.6 * r), (1.1 * r, -0.9 * r, 0.4 * r))
    t.add(_BURNER, along("y", motor, 0.9 * r, 0, 0.15 * r), control, of="motor")
    x, y, z = 0.25 * r, -0.3 * r, -1.5 * r
    t.add(_BURNER, rope([(x, y, -0.8 * r), (x, y, z), (x, -2.5 * r, z)], 0.16 * r, 10), of="pipe")


class ForcedDraught(Equipment, name="burner/forced draught", label=_BURNER, bundle=_BURNER, weight=1.5):
    """A forced-draught burner on a stand."""

    radius: float = between(0.1, 0.25, "of its flange, but for a tenth", "m")

    def build(self, t: Table) -> Model:
        r, lift, tall = self.radius, 1.8 * self.radius + 0.3, self.radius + 0.3
        _burner(t.at(0, 0, lift), r)
        stand = [box((0.06, 1.2 * r, tall), (0.8 * r, 0, tall / 2)), box((0.5, 1.4 * r, 0.02), (0.8 * r, 0, 0.01))]
        t.add("bracket", *stand)
        return t.model(kind="burner")


class FilterHousing(Equipment, name="filter/housing", label=_FILTER, bundle=_FILTER, weight=1.5):
    """A bag or cartridge filter: a bowl on legs, a lid under swing bolts with a vent, two mouths on the side."""

    radius: float = between(0.1, 0.3, "of the bowl", "m")
    tall: float = between(0.4, 1.0, "height of the bowl", "m")
    bag: bool = chance(0.6, "for bags, with a flat lid")

    def build(self, t: Table) -> Model:
        r, n, tall, low, wide = self.radius, t.n(self.radius), self.tall, 0.3 + 0.5 * self.radius, 1.2 * self.radius
        top, crown = low + tall, head_profile("flat" if self.bag else "2:1", r)
        bowl = [(x, low + 0.5 * r - z) for x, z in head_profile("2:1", r)[::-1]]
        t.add(_FILTER, turned([*bowl, *outline(r, top, wide, top, wide, top + 0.03)], n), of="trim")
        lid = [*outline(wide, 0.033, wide, 0.06), *((x, z + 0.06) for x, z in crown)]
        vent = merge([cylinder(0.01, 0, 0.06, 10), hexagon(0.024, 0.03, 0.05)])
        closing = t.at(0, 0, top)
        closing.add(_FILTER, turned(lid, n), moved(vent, at(0.3 * r, 0, crown[-1][1] + 0.055)), of="trim")
        eye = moved(torus(0.02, 0.005, 10, 6), at(0, 0, 0.11) @ spun("x", np.pi / 2))
        closing.add("bolt", around(merge([rod((0, 0, -0.06), (0, 0, 0.1), 0.008, 8), eye]), 4, wide))
        high = low + 0.3 * tall
        leg = merge([box((0.05, 0.05, high), (0, 0, high / 2)), box((0.1, 0.1, 0.01), (0, 0, 0.005))])
        t.add("tank leg", around(leg, 3, r + 0.02), own=True)
        dn, ports = 50 if r > 0.15 else 25, []
        for s, z in ((1, low + 0.85 * tall), (-1, low + 0.2 * tall)):
            side = t.spun("z", 0.0 if s > 0 else np.pi).at(r, 0, z).along("x")
            for part in nozzle(dn, 0.12, t.style):
                side.add(_FILTER, part.solid, of="trim")
            ports.append(Port(looking((s * (r + 0.12), 0, z), (s, 0, 0)), dn))
        return t.model(kind="bag filter" if self.bag else "cartridge filter", ports=ports)


class FilterBowl(
    Equipment, name="filter/bowl", place="inline", label=_FILTER, bundle=_FILTER, sizes=(15, 20, 25, 32, 40), weight=1.2
):
    """A small cartridge or air filter in a line: a head with two ends and a bowl below."""

    deep: float = among((2.0, 4.0, 6.0), "depth of the bowl / radius of the head")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r = 0.09 + 3 * radius, 0.035 + 1.1 * radius
        n, deep, middle = t.n(r), self.deep * r, t.at(length / 2)
        head = turned(outline(r, -0.4 * r, 1.08 * r, -0.3 * r, 1.08 * r, 0.7 * r, 0.9 * r, 0.9 * r), n)
        run = along("x", ring(bore_of(self.dn, t.style), 1.3 * radius, 0, length, t.n(radius)))
        t.add(_FILTER, run, moved(head, at(length / 2)), of="rubber")
        middle.add(_FILTER, turned(outline(0.6 * r, -deep, 0.9 * r, -0.93 * deep, 0.98 * r, -0.4 * r), n))
        middle.add(_FILTER, hexagon(0.3 * r + 0.006, -deep - 0.015, -deep + 0.01), of="trim")
        return t.model(round(length, 6), "welded", "cartridge filter")


class Cyclone(Equipment, name="separator/cyclone", label=_SEPARATOR, bundle=_SEPARATOR, weight=1.5):
    """A cyclone: a cylinder over a long cone, a tangential inlet, a pipe out of the top, legs."""

    radius: float = between(0.15, 0.5, "of the cylinder", "m")
    low: float = between(0.3, 0.6, "from the floor to the cone", "m")

    def build(self, t: Table) -> Model:
        r, n, low, cone = self.radius, t.n(self.radius), self.low, self.low + 2.4 * self.radius
        top, inner, outer = cone + 1.4 * r, 0.45 * r, 0.6 * r
        inlet = cone + 0.89 * r
        body = turned(outline(0.2 * r, low, 0.25 * r, low + 0.05, r, cone, r, top), n)
        pipe = outline(inner, top - 0.01, inner, top + outer, outer, top + outer, outer, top + 0.63 * r)
        mouth = [box((1.4 * r, 0.4 * r, 0.8 * r), (-0.8 * r, 0.78 * r, inlet))]
        mouth.append(box((0.03, 0.55 * r, 0.95 * r), (-1.5 * r, 0.78 * r, inlet)))
        t.add(_SEPARATOR, body, turned(pipe, n), *mouth)
        t.add(_SEPARATOR, turned(outline(0.32 * r, low - 0.25, 0.32 * r, low + 0.02), n))
        spots = [(1.05 * r * np.cos(a), 1.05 * r * np.sin(a)) for a in (0.6, 2.7, 4.7)]
        t.add("tank leg", *(rod((x, y, 0), (x, y, cone + 0.28 * r), 0.03, 8) for x, y in spots))
        return t.model(kind="cyclone separator")


class InLineSeparator(
    Equipment,
    name="separator/inline",
    place="inline",
    label=_SEPARATOR,
    bundle=_SEPARATOR,
    sizes=sizes_between(25, 150),
    weight=1.0,
):
    """An in-line air or steam separator: an upright bulb across the line with a vent above and a drain below."""

    up: float = between(1.2, 2.5, "height of the bulb over the line's axis / its radius")
    down: float = between(1.2, 3.0, "depth of the bulb under the line's axis / its radius")

    def build(self, t: Table) -> Model:
        r = 1.7 * t.pipe.radius + 0.03
        length = 2 * (r + plate_thickness(self.dn) + nut_room(self.dn) + 0.01)
        neck, up, down = 0.485 * t.flange.hub, self.up * r, self.down * r
        body = flanged_body(self.dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        bulb = outline(0.2 * r, -down - 0.5 * r, 0.7 * r, -down - 0.3 * r, r, -down)
        bulb += outline(r, up, 0.7 * r, up + 0.3 * r, 0.2 * r, up + 0.5 * r)
        t.add(_SEPARATOR, body, moved(turned(bulb, t.n(r)), at(length / 2)))
        vent = hexagon(0.05, up + 0.45 * r, up + 0.45 * r + 0.04)
        drain = cylinder(0.014, -down - 0.5 * r - 0.06, -down - 0.4 * r, 10)
        t.at(length / 2).add(_SEPARATOR, vent, drain, of="trim")
        return t.model(round(length, 6), kind="separator")


EQUIPMENT = families_of(
    ShellTube,
    Plate,
    Brazed,
    AirCooled,
    PanelRadiator,
    ColumnRadiator,
    Packaged,
    ForcedDraught,
    FilterHousing,
    FilterBowl,
    Cyclone,
    InLineSeparator,
)
