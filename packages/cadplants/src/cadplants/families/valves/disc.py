"""Butterfly valves of further makes: triple offset, waterworks, mono-flange, hygienic, plastic, high performance."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import put_stem
from cadplants.families.valves.actuation_hand import Handlever, levers, slab, span
from cadplants.families.valves.ball import ClampedEnds, ferrule, part_ring
from cadplants.families.valves.body import Blade, Packing, TurnedBlade, bolts_on, ended, neck_of, plate_outline
from cadplants.families.valves.valve import BIG, Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, PIPES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["DISCS"]

_LARGE = sizes_between(50)
_DISC = "disc"


class _Neck(Params):
    """A neck up to a mounting pad: slim, stout, or a two-storey yoke."""

    form: str = among(("slim", "stout", "yoke"), "how it is made")
    pad: str = among(("square", "round", "octagon"), "outline of its pad")

    def solids(self, t: Table, low: float, high: float, slim: float) -> list[Solid]:
        """The neck about z between two heights, of a radius [m]."""
        n, thick = t.n(slim, 12), self.thick(slim)
        if self.form == "slim":
            solids = [turned(outline(1.3 * slim, low, slim, low + 0.3 * (high - low), slim, high - thick), n)]
        elif self.form == "stout":
            solids = [slab(rounded_rectangle(1.8 * slim, 2.6 * slim, 0.6 * slim, 3), low, high - thick)]
        else:
            step, rim = low + 0.45 * (high - low), 1.9 * slim
            solids = [turned(outline(1.3 * slim, low, 1.1 * slim, step, rim, step, rim, step + thick), n)]
            post = (0.5 * slim, 0.7 * slim, high - step)
            solids += [box(post, (0, s * 1.4 * slim, (high + step - thick) / 2)) for s in BOTH]
        return [*solids, slab(plate_outline(self.pad, 2.2 * slim, 2.2 * slim, n), high - thick, high)]

    def thick(self, slim: float) -> float:
        """Thickness of its pad [m]."""
        return 0.008 + 0.1 * slim

    def put_bolts(self, t: Table, high: float, slim: float) -> None:
        """Puts down the pad's bolts [m]."""
        edge = plate_outline(self.pad, 2.2 * slim, 2.2 * slim, t.n(slim, 12))
        t.extend([bolts_on(edge, 4, high - self.thick(slim), high + 0.004, 0.006 + 0.08 * slim)])


class Triple(Valve, name="butterfly valve/triple offset", sizes=_LARGE):
    """A triple-offset butterfly valve: long double-flanged body (EN 558 series 14), bearing cover, gland, gear."""

    hollow: bool = styled(True, "whether insides are modelled")
    form: str = among(("short", "long"), "its length")
    wall: float = between(1.12, 1.3, "radius of its body / of its bore")
    high: float = between(0.03, 0.1, "height of its pad over the flanges, of a small pipe", "m")
    neck: _Neck = nested(_Neck, "neck")
    bottom: float = between(0.85, 1.05, "depth of its foot / radius of the flanges")
    gland: Packing = nested(Packing, "gland")
    disc: TurnedBlade = nested(TurnedBlade, _DISC, when=lambda p: p.hollow)
    footed: bool = chance(0.4, "two feet below it")
    operator: Any = operator("worm", "worm", "scotch", "multi-turn", "electrohydraulic", "rack")

    def build(self, t: Table) -> Model:
        radius, size, bore, thick = self.radius, t.flange, t.pipe.bore, plate_thickness(self.dn)
        length = 0.127 + 0.2 * radius * 2 if self.form == "short" else 0.15 + 0.9 * radius
        x, n, neck = 0.45 * length, t.n(size.outer / 2, 16), neck_of(self.dn)[0]
        wall, low = min(self.wall * bore + 0.006, 0.95 * neck + 0.01), thick + 0.12 * length
        middle = outline(neck, thick, wall, low, wall, length - low, neck, length - thick)
        slim, high = 0.16 * radius + 0.012, 0.5 * size.outer + self.high + 0.2 * radius
        bottom, rim = 0.5 * size.outer * self.bottom, 1.8 * slim
        tower = self.neck.solids(t, 0.9 * wall, high, slim)
        tower += [cylinder(1.2 * slim, -bottom, -0.9 * bore, 16), cylinder(rim, -bottom - 0.012, -bottom, 16)]
        t.add("valve body", ended(self.dn, t.style, length, middle, "flanged"), *(moved(one, at(x)) for one in tower))
        screws = around(hexagon(0.012, -bottom - 0.034, -bottom - 0.026), 4, 1.35 * slim)
        top = t.at(x, 0, high)
        t.at(x).add("valve bonnet", cylinder(rim, -bottom - 0.026, -bottom - 0.012, 16), screws)
        self.neck.put_bolts(t.at(x), high, slim)
        self.gland.build(top, 0.4 * slim)
        put_stem(top, 0.0, 0.05 + 0.2 * radius, 0.4 * slim)
        if self.hollow:
            self.disc.build(t.at(x), bore)
            seat = ring(0.94 * bore, 1.002 * bore, x - 0.06 * bore, x + 0.06 * bore, n)
            t.add("valve body", about_x(seat), of="trim")
        if self.footed:
            foot, deep = (0.5 * length, 0.02, bottom - 0.7 * wall), -0.5 * (bottom + 0.7 * wall)
            t.add("valve body", *(box(foot, (length / 2, s * 0.6 * wall, deep)) for s in BOTH))
        self.operator.build(t.at(x, 0, high + 0.012))
        return t.model(round(length, 6), kind="butterfly valve")


class Waterworks(Valve, name="butterfly valve/waterworks", sizes=_LARGE):
    """A waterworks butterfly valve: ribbed double-flanged shell with bosses and feet, dished disc, gear (EN 593)."""

    hollow: bool = styled(True, "whether insides are modelled")
    ribs: int = among((4, 6, 8), "ribs round its shell")
    belted: bool = chance(0.5, "a belt round its shell")
    side: float = among((0.0, np.pi / 2, -np.pi / 2), "where its shaft points, from upward", "rad")
    footed: bool = chance(0.6, "two feet below it")
    operator: Any = operator("worm", "worm", "bevel", "multi-turn", "scotch", "lever")
    disc: Blade = nested(Blade, _DISC, when=lambda p: p.hollow)
    turn: float = among(
        (0.0, 0.4 * np.pi, np.pi / 2), "of its disc, from shut", "rad", when=lambda p: p.hollow, otherwise=0.0
    )

    def build(self, t: Table) -> Model:
        radius, size, bore, thick = self.radius, t.flange, t.pipe.bore, plate_thickness(self.dn)
        length, wall = 0.13 + 0.45 * radius, 1.06 * bore + 0.008
        x, n = length / 2, t.n(size.outer / 2, 16)
        neck, reach = min(neck_of(self.dn)[0], 1.02 * wall), 0.44 * size.outer
        middle = outline(neck, thick, wall, 0.5 * length, neck, length - thick)
        solids = [ended(self.dn, t.style, length, middle, "flanged")]
        rib = (length - 1.6 * thick, 0.008 + 0.04 * radius, reach - 0.95 * wall)
        one = box(rib, (x, 0, (reach + 0.95 * wall) / 2))
        solids += [moved(one, spun("x", (k + 0.5) * 2 * np.pi / self.ribs)) for k in range(self.ribs)]
        if self.belted:
            solids.append(about_x(ring(0.96 * wall, 1.1 * wall, 0.42 * length, 0.58 * length, n)))
        slim, high, pose = 0.2 * radius + 0.014, 0.52 * size.outer + 0.02, at(x) @ spun("x", self.side)
        above = outline(1.6 * slim, 0.95 * wall, 1.3 * slim, high - 0.03, 2 * slim, high - 0.018, 2 * slim, high)
        below = outline(1.2 * slim, -0.48 * size.outer, 1.5 * slim, -0.46 * size.outer, 1.6 * slim, -0.95 * wall)
        solids += [moved(turned(side, 20), pose) for side in (above, below)]
        if self.footed:
            foot, low = (0.02, 0.8 * size.outer * 0.7, 0.02), thick / 2 + 0.006
            solids += [box(foot, (z, 0, -0.5 * size.outer + 0.01)) for z in (low, length - low)]
        t.add("valve body", *solids)
        turned_table = t.moved(pose)
        top = turned_table.at(0, 0, high)
        put_stem(top, 0.0, 0.02, 0.5 * slim)
        top.add("bolt", around(hexagon(0.016, 0.0, 0.01), 4, 1.6 * slim, 0.7))
        self.operator.build(top.at(0, 0, 0.005))
        if self.hollow:
            turned_table.spun("z", self.turn).add("valve disc", self.disc.solid(bore, t.style))
        return t.model(round(length, 6), kind="butterfly valve")


class MonoFlange(Valve, name="butterfly valve/mono-flange", sizes=BIG):
    """A mono-flange or U-section butterfly valve: one wide drilled plate round a rubber-lined ring (EN 593)."""

    single: bool = chance(0.5, "one wide plate, not two")
    neck: _Neck = nested(_Neck, "neck")
    disc: TurnedBlade = nested(TurnedBlade, _DISC)
    operator: Any = operator("worm", "rack", "lever", "motor box", "scotch")

    def build(self, t: Table) -> Model:
        radius, size, bore, count = self.radius, t.flange, t.pipe.bore, t.flange.n_bolts
        length, n = FACE_TO_FACE["butterfly"][self.dn], t.n(size.outer / 2, 16)
        holes: tuple[Floats, ...] = (circle(1.1 * bore, n),)
        if t.style.holes:
            a, r = np.pi / count + np.arange(count) * 2 * np.pi / count, size.circle / 2
            holes += tuple(circle(0.55 * size.bolt, 8, (r * np.cos(k), r * np.sin(k))) for k in a)
        thin = 0.22 * length
        spots = [(0.06 * length, 0.06 * length + thin), (0.94 * length - thin, 0.94 * length)]
        if self.single:
            spots = [(0.32 * length, 0.68 * length)]
        solids = [along("x", slab(circle(size.outer / 2, n), low, high, holes)) for low, high in spots]
        rim = 0.47 * (size.circle - size.bolt)
        solids.append(about_x(ring(1.05 * bore, rim, 0.04 * length, 0.96 * length, n)))
        slim, high = min(0.32 * length, 0.16 * radius + 0.012), 0.5 * size.outer + 0.035 + 0.3 * radius
        tower = self.neck.solids(t, 0.48 * size.outer, high, slim)
        t.add("valve body", *solids, *(moved(one, at(length / 2)) for one in tower))
        liner = outline(1, 0, 1.22, 0, 1.22, 0.05, 1.06, 0.06, 1.06, 0.94, 1.22, 0.95, 1.22, 1, 1, 1)
        t.add("valve body", about_x(part_ring([(r * bore, z * length) for r, z in liner], n)), of="rubber")
        t = t.at(length / 2)
        self.neck.put_bolts(t, high, slim)
        self.disc.build(t, bore)
        put_stem(t.at(0, 0, high), 0.0, 0.012, 0.45 * slim)
        self.operator.build(t.at(0, 0, high + 0.006))
        return t.model(length, "wafer", "butterfly valve")


class Hygienic(Valve, name="butterfly valve/hygienic", sizes=sizes_between(25, 150)):
    """A hygienic butterfly valve: two polished halves, weld or clamp ends, a squeeze lever or a cylinder."""

    hollow: bool = styled(True, "whether insides are modelled")
    clamped: bool = chance(0.5, "its ends are clamped, not welded")
    core: float = among((0.05, 0.075), "length of its body, of a small pipe", "m")
    bolts: int = among((2, 4), "bolts of its halves")
    disc: TurnedBlade = nested(TurnedBlade, _DISC, when=lambda p: p.hollow)
    clamps: ClampedEnds = nested(ClampedEnds, "clamps", when=lambda p: p.clamped)
    levered: bool = chance(0.6, "a squeeze lever over its index plate, not an actuator")
    lever: Handlever = nested(levers("notched", "notched", "sheet", "bar"), "that lever", when=lambda p: p.levered)
    operator: Any = operator("vertical", "vertical", "rack", when=lambda p: not p.levered)

    def build(self, t: Table) -> Model:
        radius, bore, stub = self.radius, t.pipe.bore, 0.03 if self.clamped else 0.0
        core = self.core + 0.5 * radius
        length, x, half, n = core + 2 * stub, core / 2 + stub, 0.012 + 0.08 * radius, t.n(1.4 * radius, 16)
        big, inner = 1.3 * radius + 0.009, bore if t.style.hollow else 0.0
        solids = []
        for low, high, face in ((stub, x, True), (x, length - stub, False)):
            plain = along("x", ring(inner, radius, low, high, n))
            solids.append(ferrule(self.dn, low, high, t.style, face) if self.clamped else plain)
        end = 0.98 * radius
        side = [(end, 1), (0.85 * big, 1), (big, 0.7), (big, 0.08), (0.97 * big, 0.06)]
        waist = [*((r, x - z * half) for r, z in side), *((r, x + z * half) for r, z in side[::-1])]
        solids.append(about_x(part_ring(waist, n)))
        boss, high = 0.2 * radius + 0.007, big + 0.014
        t.add("valve body", *solids, along("z", cylinder(boss, 0.95 * radius, high, 16), x), of="clamp")
        bolt = [cylinder(0.007, x - 1.0 * half, x + 1.0 * half, 12), hexagon(0.011, x + half, x + half + 0.005)]
        t.add("bolt", about_x(around(merge(bolt), self.bolts, 1.02 * big, np.pi / 4)))
        put_stem(t.at(x), high - 0.004, high + 0.012, 0.6 * boss)
        if self.hollow:
            self.disc.build(t.at(x), bore)
        if self.clamped:
            self.clamps.build(t, self.dn, stub, length)
        top = t.at(x, 0, high)
        if self.levered:  # over an index plate
            pegs = [
                box((0.004, 0.004, 0.006), (2.0 * boss * np.cos(a), 2.0 * boss * np.sin(a), 0.005))
                for a in np.linspace(0, 1.57, 4)
            ]
            top.add("position indicator", slab(circle(2.2 * boss, 16), 0.001, 0.004), *pegs)
            self.lever.build(top, 0.09 + 1.3 * radius, 0.008)
        else:
            self.operator.build(top.at(0, 0, 0.002))
        return t.model(round(length, 6), "welded", "butterfly valve")


class Plastic(Valve, name="butterfly valve/plastic", sizes=BIG):
    """A plastic wafer butterfly valve: a moulded ribbed body, a notched handle over a ratchet plate."""

    disc: TurnedBlade = nested(TurnedBlade, _DISC)
    levered: bool = chance(0.75, "a lever, not a gear or an actuator")
    lever: Handlever = nested(levers("notched", "notched", "cast"), "lever", when=lambda p: p.levered)
    operator: Any = operator("worm", "rack", "motor box", when=lambda p: not p.levered)

    def build(self, t: Table) -> Model:
        radius, size, bore = self.radius, t.flange, t.pipe.bore
        length, n, outer = FACE_TO_FACE["butterfly"][self.dn], t.n(size.outer / 2, 16), 0.5 * size.outer
        x, free = length / 2, size.circle - size.bolt
        skin = outline(bore, 0, 0.47 * free, 0, 0.47 * free, length, bore, length)
        solids = [about_x(part_ring(skin, n)), about_x(ring(0.4 * free, outer, 0.4 * length, 0.6 * length, n))]
        solids.append(about_x(ring(0.95 * outer, outer, 0.1 * length, 0.9 * length, n)))
        rib = box((0.8 * length, 0.006, outer - 0.45 * free), (x, 0, (outer + 0.45 * free) / 2))
        solids += [moved(rib, spun("x", a)) for a in np.arange(2 * size.n_bolts) * np.pi / size.n_bolts]
        slim, high = 0.18 * radius + 0.011, outer + 0.03 + 0.35 * radius
        tower = [slab(rounded_rectangle(1.7 * slim, 2.4 * slim, 0.4 * slim, 3), 0.97 * outer, high)]
        web = (0.8 * slim, 0.005, high - 0.98 * outer)
        tower += [box(web, (0, s * 1.5 * slim, (high + 0.98 * outer) / 2)) for s in BOTH]
        tower.append(box((2.2 * slim, 3.6 * slim, 0.01), (0, 0, high - 0.005)))
        t.add("valve body", *solids, *(moved(one, at(x)) for one in tower))
        t = t.at(x)
        self.disc.build(t, bore)
        put_stem(t, high - 0.01, high + 0.02, 0.4 * slim)
        if self.levered:
            a, reach = np.linspace(-0.2, 1.8, 21), 0.04 + 0.9 * radius
            r = reach * np.where(np.arange(21) % 2, 1.0, 0.93)
            back = np.array([(-1.6, 0.8), (-1.6, -1.2)]) * slim
            ratchet = np.vstack([np.column_stack([r * np.cos(a), r * np.sin(a)]), back])
            t.add("position indicator", slab(ratchet, high, high + 0.006))
            self.lever.build(t, 0.12 + 1.6 * radius, high + 0.01)
        else:
            self.operator.build(t.at(0, 0, high))
        return t.model(length, "wafer", "butterfly valve")


class Damper(Valve, name="butterfly valve/duct damper", sizes=sizes_between(80)):
    """A single-blade damper in a short duct piece: bead ends, shaft right through, quadrant lever."""

    long: float = between(1.2, 2.4, "length / radius of the duct")
    beaded: bool = chance(0.6, "beads at its ends")
    disc: TurnedBlade = nested(TurnedBlade, "blade")
    levered: bool = chance(0.65, "a lever, not an actuator")
    lever: Handlever = nested(levers("sheet", "bar", "sheet"), "lever", when=lambda p: p.levered)
    operator: Any = operator(
        "motor box", "rack", radius=lambda p: 0.8 * PIPES[p.dn].radius, when=lambda p: not p.levered
    )

    def build(self, t: Table) -> Model:
        radius, bore = self.radius, t.pipe.bore
        length, n = self.long * radius + 0.05, t.n(radius, 16)
        x, high, slim, reach = length / 2, radius + 0.02, 0.005 + 0.03 * radius, 0.04 + 0.5 * radius
        solids = [about_x(ring(bore, radius, 0.0, length, n))]
        if self.beaded:
            solids += [about_x(ring(0.995 * radius, radius + 0.012, z, z + 0.004, n)) for z in (0.02, length - 0.024)]
        for s in BOTH:
            solids.append(along("z", cylinder(0.012 + 0.05 * radius, *span(s * 0.98 * radius, s * high), 12), x))
        t.add("valve body", *solids)
        t = t.at(x)
        self.disc.build(t, bore)
        put_stem(t, -radius - 0.03, high + 0.02, slim)
        if self.levered:
            a = np.linspace(-0.3, 2.0, 14)
            arc = np.column_stack([np.cos(a), np.sin(a)]) * reach
            plate = np.vstack([arc, np.array([(-0.6, 0.3), (-0.4, -0.4), (0.6, -0.5)]) * reach])
            slot = np.vstack([0.85 * arc[2:-2], 0.72 * arc[-3:1:-1]])
            t.add("position indicator", slab(plate, high, high + 0.003, (slot,)))
            self.lever.build(t, 1.5 * reach + 0.03, high + 0.006)
            nut = cylinder(0.004, high - 0.004, high + 0.02, 8)
            t.at(0.78 * reach).add("bolt", nut, box((0.025, 0.004, 0.012), (0, 0, high + 0.02)))
        else:
            t.add("yoke", cylinder(0.5 * reach, high - 0.002, high + 0.003, n), of="steel")
            self.operator.build(t.at(0, 0, high + 0.003))
        return t.model(round(length, 6), "welded", "butterfly valve")


DISCS = families_of(Triple, Waterworks, MonoFlange, Hygienic, Plastic, Damper)
