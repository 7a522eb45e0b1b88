"""Further heat exchangers and cooling towers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made, one_of
from cadplants.builder.params import among, between, chance, several
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.vessel_fittings import head, renamed, sides
from cadplants.families.vessels.vesselbuild import branch
from cadplants.families.vessels.vesselfeet import SADDLES, Saddle
from cadplants.model.family import Model, Part, Port
from cadplants.model.standards import FLANGES, PIPES
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["EXCHANGERS", "Equipment", "equipment_mouth", "feet_of", "frame_of"]

_NAME = "heat exchanger"


class Equipment(Device, place="floor", group="Equipment", sizes=(15,), weight=0.8):
    """A piece of equipment on the floor."""


class _Exchanger(Equipment, label=_NAME, bundle=_NAME):
    """A heat exchanger."""


def equipment_mouth(t: Table, dn: int, pose: Floats, r: float = 0.0, dip: float = 0.0) -> list[Port]:
    """Sets a flanged mouth on a piece of equipment, as a part of it; its port."""
    mouth = Table(t.style, "Tank")
    ports = branch(mouth, "plain", dn, pose, r, dip)
    t.extend(renamed(mouth.parts, t.bundle))
    return ports


def feet_of(parts: Sequence[Part], name: str) -> list[Part]:
    """Saddles, skirts or legs under a piece of equipment of this name: they stay parts of tanks."""
    return [p if p.group else Part(p.solid, p.name, p.color, name, "Tank") for p in parts]


def frame_of(w: float, d: float, h: float, side: float, low: float = 0.0, rails: bool = True) -> Solid:
    """Four posts of square tube with rails round their tops and feet."""
    x, y = (w - side) / 2, (d - side) / 2
    posts = [box((side, side, h), (sx * x, sy * y, low + h / 2)) for sx in BOTH for sy in BOTH]
    for z in (low + h - side / 2, low + 0.12 * h) if rails else ():
        posts += [box((w, side, side), (0, s * y, z)) for s in BOTH]
        posts += [box((side, d, side), (s * x, 0, z)) for s in BOTH]
    return merge(posts)


def _girth(r: float, thick: float, n: int) -> tuple[list[Solid], Solid]:
    """A pair of girth flanges about z with their bolts."""
    wide = 1.14 * r + 0.03
    bolts = bolt_circle(int(np.clip(40 * r, 8, 28)), 0.5 * (r + wide) + 0.004, 0.014, -thick, thick)
    return [cylinder(wide, -thick, 0.0, n), cylinder(wide, 0.003, thick, n)], bolts


class Kettle(_Exchanger, name="heat exchanger/kettle"):
    """A kettle reboiler (TEMA K): a wide shell with a sloping cone down to the bundle's flange, a channel, saddles."""

    radius: float = between(0.3, 0.7, "of the shell", "m")
    narrow: float = between(0.5, 0.7, "radius of the bundle's flange / of the shell")
    slender: float = between(2.5, 4.0, "length of the shell / its radius")
    clear: float = between(0.3, 0.5, "from the floor to the shell", "m")
    tops: tuple[int, ...] = several(one_of(40, 50, 80), 2, "nominal sizes of the mouths on the shell", "mm")
    saddles: tuple[Saddle, ...] = several(made(SADDLES["ribbed"]), 2, "saddles")

    def build(self, t: Table) -> Model:
        r, small, n = self.radius, self.radius * self.narrow, sides(t.style, self.radius)
        half, cone, axis = r * self.slender / 2, 0.45 * r + 0.1, r + self.clear
        low = self.clear + small  # the bundle's axis: both shells lie flush below
        a = np.arange(n) * 2 * np.pi / n
        ringed = np.column_stack([np.zeros(n), np.cos(a), np.sin(a)])
        steps = ((small, -half - cone, low), (r, -half, axis), (r, half, axis))
        t.add(_NAME, lofted([radius * ringed + (x, 0, z) for radius, x, z in steps]), of="tank")
        t.at(half, 0, axis).along("x").add(_NAME, head("2:1", r, t.style, n), of="tank")
        thick, x, deep = 0.02 + 0.05 * small, -half - cone - 0.04, 0.9 * small + 0.1
        pair, bolts = _girth(small, thick, n)
        lying = t.at(x, 0, low).along("x")
        lying.add(_NAME, cylinder(small, -0.005, 0.045, n), *pair, of="flange")
        cover = cylinder(1.14 * small + 0.03, deep, deep + thick, n)
        t.at(x, 0, low).along("-x").add(_NAME, cylinder(small, 0, deep, n), cover, of="tank")
        lying.add("bolt", bolts)
        ports: list[Port] = []
        dip, aside = r * (1 - np.cos(np.pi / n)), x - 0.5 * deep
        for px, dn in zip((-0.5 * half, 0.4 * half), self.tops, strict=True):
            ports += equipment_mouth(t, dn, at(px, 0, axis + r), r, dip)
        ports += equipment_mouth(t, 40, at(aside, 0, low + small), small, dip)
        equipment_mouth(t, 40, at(aside, 0, low - small) @ spun("x", np.pi), small, dip)
        for px, saddle in zip((-0.6 * half, 0.6 * half), self.saddles, strict=True):
            t.at(px).extend(feet_of(saddle.parts(r, axis, t.style), _NAME))
        return t.model(kind="kettle reboiler", ports=ports)


class UTube(_Exchanger, name="heat exchanger/u-tube"):
    """A U-tube exchanger on a wall frame or on feet: a slim shell, a square or round channel box, a dished far end."""

    radius: float = between(0.06, 0.16, "of the shell", "m")
    slender: float = between(7, 14, "length of the shell / its radius")
    axis: float = between(0.5, 1.0, "height of its axis", "m")
    square: bool = chance(0.5, "its channel is square, not round")

    def build(self, t: Table) -> Model:
        r, axis, n = self.radius, self.axis, sides(t.style, self.radius)
        length, lying = r * self.slender, t.at(0, 0, axis)
        half, deep = length / 2, 2.2 * r + 0.05
        cap = moved(head("torispherical", r, t.style, n), at(0, 0, half))
        lying.along("x").add(_NAME, cylinder(r, -half, half, n), cap, of="tank")
        pair, bolts = _girth(r, 0.02, n)
        flange = lying.at(-half).along("x")
        flange.add(_NAME, *pair, of="flange")
        if self.square:
            chest = [box((deep, 2.2 * r, 2.4 * r), (-deep / 2, 0, 0))]
            chest.append(box((0.02, 2.6 * r, 2.8 * r), (-deep - 0.01, 0, 0)))
        else:
            tubes = cylinder(r, -deep, 0, n), cylinder(1.25 * r, -deep - 0.02, -deep, n)
            chest = [along("x", one) for one in tubes]
        lying.at(-half).add(_NAME, *chest, of="valve")
        flange.add("bolt", bolts)
        dn, x, out = 25 if r < 0.1 else 40, -half - deep / 2, 1.2 * r if self.square else r
        ports: list[Port] = []
        for px, s, reach in ((x, 1, out), (x, -1, out), (-0.32 * length, 1, r), (0.38 * length, 1, r)):
            pose = at(px, 0, axis + s * reach) @ spun("x", 0.0 if s > 0 else np.pi)
            port = equipment_mouth(t, dn, pose, 0.0 if reach != r else r, 0.01)
            ports += port if s > 0 else []
        tall = axis - 0.9 * r
        post = [box((0.06, 1.4 * r, tall), (0, 0, tall / 2)), box((0.14, 2.2 * r, 0.01), (0, 0, 0.005))]
        for px in (-0.25 * length, 0.3 * length):
            t.at(px).add("post", *post)
            lying.at(px).along("x").add("clamp", ring(r, 1.05 * r + 0.003, -0.02, 0.02, n), of="steel")
        return t.model(kind="U-tube heat exchanger", ports=ports)


class DoublePipe(_Exchanger, name="heat exchanger/double-pipe"):
    """A double-pipe exchanger: jacketed pipes above each other, return bends of the inner pipe, jumpers, a frame."""

    pipes: tuple[int, int] = among(
        ((80, 50), (65, 40), (50, 25), (100, 65)), "nominal sizes of the outer and inner pipe", "mm"
    )
    tiers: int = among((2, 2, 4, 6), "pipes above each other")
    length: float = between(1.4, 3.2, "of the jackets", "m")
    base: float = between(0.3, 0.6, "height of the lowest pipe", "m")

    def build(self, t: Table) -> Model:
        ro, ri = (PIPES[dn].radius for dn in self.pipes)
        rows, half, inner = self.tiers, self.length / 2, self.pipes[1]
        pitch, n = max(4.4 * ri, 2.6 * ro), t.n(ro)
        zs = self.base + pitch * np.arange(rows)
        near = turned(outline(ri, -half - 0.5 * ro, ro, -half), n)
        jacket = [cylinder(ro, -half, half, n), near, turned(outline(ro, half, ri, half + 0.5 * ro), n)]
        t.add(_NAME, *(along("x", one, 0, 0, float(z)) for z in zs for one in jacket), of="tank")
        a, bends = np.linspace(-np.pi / 2, np.pi / 2, 9), []
        for k in range(rows - 1):
            way = np.column_stack([half + ro + pitch / 2 * np.cos(a), np.zeros(9), zs[k] + pitch / 2 * (1 + np.sin(a))])
            path = np.vstack([[(half, 0, zs[k])], way, [(half, 0, zs[k + 1])]])
            bends.append(rope(path * ((1, -1)[k % 2], 1, 1), ri, n))
        t.add(_NAME, *bends, of="pipe")
        xs = [(-1) ** k * -0.84 * half for k in range(rows - 1)]
        t.add(_NAME, *(along("z", cylinder(0.6 * ri, zs[k], zs[k + 1], n), x) for k, x in enumerate(xs)), of="pipe")
        ports: list[Port] = []
        last = -1 if rows % 2 == 0 else 1
        for z, way_out in ((zs[0], -1), (zs[-1], last)):
            pose = at(way_out * (half + 0.4 * ro), 0, z) @ spun("y", way_out * np.pi / 2)
            ports += equipment_mouth(t, inner, pose)
        ports += equipment_mouth(t, inner, at(-0.84 * half * last, 0, zs[-1] + ro), ro)
        high = zs[-1] + ro + 0.05
        stand = [box((0.05, 0.05, high), (0, s * (ro + 0.035), high / 2)) for s in BOTH]
        stand += [box((0.05, 2 * ro + 0.12, 0.03), (0, 0, z - ro - 0.0145)) for z in zs]
        for x in (-0.6 * half, 0.6 * half):
            t.at(x).add("column", *stand)
        return t.model(kind="double-pipe heat exchanger", ports=ports)


class Spiral(_Exchanger, name="heat exchanger/spiral"):
    """A spiral exchanger: a short wide drum between two covers with hook bolts all round, on two trunnion stands."""

    radius: float = between(0.3, 0.65, "of the drum", "m")
    deep: float = between(0.7, 1.5, "length of the drum / its radius")
    clear: float = between(0.3, 0.5, "from the floor to the drum", "m")
    ribbed: bool = chance(0.6, "ribs on the covers")

    def build(self, t: Table) -> Model:
        r, n, axis = self.radius, sides(t.style, self.radius), self.radius + self.clear
        half = r * self.deep / 2
        gap, lying = half + 0.03, t.at(0, 0, axis)
        rims = [ring(r - 0.01, 1.08 * r, x - 0.02, x + 0.02, n) for x in (0.02 - half, half - 0.02)]
        lying.along("x").add(_NAME, cylinder(r, -half, half, n), *rims, of="tank")
        cover = turned(outline(1.07 * r, half, 1.07 * r, gap, 0.2 * r, gap), n)
        rib = (0.06, 0.015, 1.9 * r)
        ribs = [box(rib, (s * (gap + 0.02), y, 0)) for s in BOTH for y in (-0.35 * r, 0.35 * r)]
        lying.add(_NAME, along("-x", cover), along("x", cover), *(ribs if self.ribbed else ()), of="tank")
        hook = merge([rod((0, 0, half - 0.06), (0, 0, gap + 0.05), 0.008, 6), hexagon(0.03, gap, gap + 0.02)])
        hooks = around(hook, int(np.clip(26 * r, 8, 16)), 1.05 * r)
        lying.add("bolt", along("-x", hooks), along("x", hooks))
        ports: list[Port] = []
        spots = [(at(0, -s * 0.5 * r, axis + 0.866 * r) @ spun("x", s * np.pi / 6), r) for s in BOTH]
        spots += [(at(s * gap, 0, axis) @ spun("y", s * np.pi / 2), 0.0) for s in (1, -1)]
        for pose, curve in spots:
            ports += equipment_mouth(t, 80 if r > 0.45 else 50, pose, curve, 0.01)
        stand = np.array([(-0.25 * r, 0), (0.25 * r, 0), (0.1 * r, axis), (-0.1 * r, axis)])
        sheet = moved(extrude(stand, -0.01, 0.01), spun("x", np.pi / 2))
        pin = cylinder(0.06 * r + 0.01, r - 0.02, 1.1 * r + 0.03, 12)
        for s in BOTH:
            y = s * (1.1 * r + 0.012)
            trunnion = along("y" if s > 0 else "-y", pin, 0, 0, axis)
            t.add("bracket", moved(sheet, at(0, y)), trunnion, box((0.6 * r, 0.14, 0.012), (0, y, 0.006)))
        return t.model(kind="spiral heat exchanger", ports=ports)


_CUT = np.array(outline(-0.5, 0.05, -0.4, 0, 0.4, 0, 0.5, 0.05, 0.5, 0.95, 0.4, 1, -0.4, 1, -0.5, 0.95))
_YZX = np.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)  # what lies flat stands across x


class LongPlate(_Exchanger, name="heat exchanger/plate on long bar"):
    """A gasketed plate exchanger with a half-empty carrying bar: thin plates with cut corners, all mouths in front."""

    width: float = between(0.3, 0.7, "of the plates", "m")
    tall: float = between(1.0, 2.0, "height of the plates", "m")
    rail: float = between(1.2, 2.6, "length of the carrying bar", "m")
    filled: float = between(0.25, 0.6, "length of the stack / of the carrying bar")
    joined: bool = chance(0.6, "the plates are one mesh")
    size: int = among(
        lambda p: [dn for dn in (40, 50, 65, 80, 100) if FLANGES[dn].outer < 0.5 * p.width] or [25],
        "nominal size of the mouths",
        "mm",
    )

    def build(self, t: Table) -> Model:
        wide, tall, rail, thick, low = self.width, self.tall, self.rail, 0.04, 0.12
        stack, high, end = rail * self.filled, low + self.tall, rail + 0.04
        count = int(np.clip(stack / 0.016, 10, 60))
        step, face = stack / count, thick + stack
        levels = [low + f * tall for f in (0.12, 0.37, 0.63, 0.88)]
        spots = [(s * 0.57 * wide, z) for s in BOTH for z in levels]
        feet = [box((0.12, 1.1 * wide, 0.09), (thick / 2, 0, 0.045))]
        for x, scale, more in ((0.0, 1.08, feet), (face, 1.05, [])):
            ears = [box((thick, 0.12 * wide, 0.06), (x + thick / 2, y, z)) for y, z in spots]
            t.add(_NAME, self._sheet(x, thick, scale), *more, *ears, of="valve")
        sections = ((0.06, 0.1, high + 0.1), (0.05, 0.05, low - 0.05))
        bars = [box((end, deep, thickness), (end / 2, 0, z)) for deep, thickness, z in sections]
        post = box((0.05, 0.3 * wide, high + 0.15), (end, 0, (high + 0.15) / 2))
        t.add(_NAME, *bars, post, box((0.2, 0.5 * wide, 0.012), (end, 0, 0.006)), of="steel")
        nut = hexagon(0.045, face + thick - 0.005, face + thick + 0.03)
        rods = [rod((-0.03, y, z), (face + 0.35, y, z), 0.014, 8) for y, z in spots]
        t.add("stud", *rods, *(along("x", nut, 0, y, z) for y, z in spots))
        sheets = [self._sheet(thick + k * step, step, 0.93 if k % 2 else 0.95) for k in range(count)]
        for solid in [merge(sheets)] if self.joined else sheets:
            t.add(_NAME, solid, of="trim")
        ports: list[Port] = []
        for s in BOTH:
            for z in (levels[0], levels[-1]):
                ports += equipment_mouth(t, self.size, at(0, s * 0.27 * wide, z) @ spun("y", -np.pi / 2))
        return t.model(kind="plate heat exchanger", ports=ports)

    def _sheet(self, x: float, deep: float, scale: float) -> Solid:
        """A plate with cut corners on its place along the bar [m]."""
        plate = extrude(scale * _CUT * (self.width, self.tall), 0.0, deep)
        return moved(plate, at(x, 0, 0.12 + (1 - scale) * self.tall / 2) @ _YZX)


class DryCooler(_Exchanger, name="heat exchanger/dry cooler"):
    """A dry cooler of A or V shape (EN 1048): two sloped finned bundles, fans between their tops, headers, a frame."""

    width: float = between(1.6, 3.2, "of the bundles", "m")
    depth: float = between(0.9, 1.4, "of the frame", "m")
    height: float = between(0.9, 1.5, "of the bundles", "m")
    low: float = between(0.3, 1.2, "from the floor to the bundles", "m")
    vee: bool = chance(0.5, "the bundles lean outward")
    fans: int = among((1, 2, 3), "fans")
    size: int = among((40, 50, 65), "nominal size of the mouths", "mm")

    def build(self, t: Table) -> Model:
        w, d, h, low, thick, count = self.width, self.depth, self.height, self.low, 0.12, 40
        lean = float(np.arctan2(0.38 * d, h)) * (1 if self.vee else -1)
        bundle = [box((0.5 * w / count, thick, h), (x, 0, 0)) for x in np.linspace(-0.48 * w, 0.48 * w, count)]
        bundle += [rod((-0.5 * w, 0, z), (0.5 * w, 0, z), 0.012, 6) for z in np.linspace(-0.45, 0.45, 6) * h]
        ends = [rod((x, 0, -0.48 * h), (x, 0, 0.48 * h), 0.04, 12) for x in (-0.5 * w - 0.02, 0.5 * w + 0.02)]
        for s in BOTH:
            leaning = t.at(0, s * 0.27 * d, low + h / 2).spun("x", -s * lean)
            leaning.add(_NAME, *bundle, of="trim")
            for solid in ends:
                leaning.add(_NAME, solid, of="pipe")
        top = low + h / 2 + 0.5 * h * np.cos(lean) + 0.5 * thick * abs(np.sin(lean)) + 0.055
        self._fans(t.at(0, 0, top))
        tall, x = top - 0.06, w / 2 + 0.06
        for sx in BOTH:
            for sy in BOTH:
                t.add("column", box((0.07, 0.07, tall), (sx * x, sy * 0.5 * d, tall / 2)))
        for s in BOTH if low > 0.5 else ():
            t.add("brace", rod((s * x, -0.5 * d, 0.1), (s * x, 0.5 * d, low), 0.015, 6))
        ports: list[Port] = []
        y = (0.42 if self.vee else 0.12) * d
        for s in BOTH:
            pose = at(-0.5 * w - 0.04, s * y, low + 0.85 * h) @ spun("y", -np.pi / 2)
            ports += equipment_mouth(t, self.size, pose)
        return t.model(kind="dry cooler", ports=ports)

    def _fans(self, t: Table) -> None:
        """The deck with its fans under 0."""
        w, d, fans = self.width, self.depth, self.fans
        r = 0.4 * min(w / fans, d)
        n = t.n(r)
        places = [at(x) for x in (np.arange(fans) - (fans - 1) / 2) * w / fans]
        shroud = ring(r, 1.05 * r, 0, 0.14, n)
        t.add(_NAME, box((w + 0.12, 1.1 * d, 0.06), (0, 0, -0.03)), *(moved(shroud, p) for p in places), of="clamp")
        blades = around(moved(box((0.75 * r, 0.25 * r, 0.008), (0.58 * r, 0, 0)), spun("x", 0.5)), 5)
        fan = [cylinder(0.25 * r, -0.002, 0.1, 16), moved(blades, at(0, 0, 0.07))]
        fan += [ring(f * r, f * r + 0.008, 0.135, 0.143, n) for f in (0.4, 0.7)]
        fan += [box((2.02 * r, 0.012, 0.008), (0, 0, 0.139)), box((0.012, 2.02 * r, 0.008), (0, 0, 0.139))]
        t.add("blower", *(moved(merge(fan), p) for p in places), of="clamp")


EXCHANGERS = families_of(Kettle, UTube, DoublePipe, Spiral, LongPlate, DryCooler)
