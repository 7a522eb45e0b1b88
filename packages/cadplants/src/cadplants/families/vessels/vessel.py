"""Tanks upright and lying: heads, nozzles, manways, legs, skirts, saddles, lugs, level gauges."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model, Part, Port
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["VESSELS", "LevelGauge", "Tank", "apart", "head_profile", "nozzle"]

_HEADS = ("2:1", "torispherical", "hemispherical")


class Tank(Device, place="floor", group="Tank", label="tank", bundle="tank", sizes=(15,)):
    """A tank or vessel on the floor."""


def apart(t: Table, name: str, *solids: Solid, of: str = "") -> None:
    """Puts a part of a vessel down that is bundled with those of its own name."""
    t.bundled(name).add(name, *solids, of=of)


def head_profile(kind: str, r: float, steps: int = 10) -> list[tuple[float, float]]:
    """Radius and height of a head from its rim (r, 0) to its apex [m].

    Ellipsoidal 2:1 and torispherical (crown 1.0 D, knuckle 0.1 D, DIN 28011) heads, half balls, cones, flat ends.
    """
    a = np.linspace(0, np.pi / 2, steps)
    if kind == "hemispherical":
        return [(r * np.cos(t), r * np.sin(t)) for t in a[:-1]] + [(0.0, r)]
    if kind == "torispherical":
        return [(r * np.cos(t) ** 0.6, 0.39 * r * np.sin(t) ** 1.1) for t in a[:-1]] + [(0.0, 0.39 * r)]
    if kind == "conical":
        return [(r, 0.0), (0.95 * r, 0.06 * r), (0.12 * r, 0.75 * r), (0.0, 0.75 * r)]
    if kind == "flat":
        return [(r, 0.0), (r, 0.01), (0.0, 0.01)]
    return [(r * np.cos(t), 0.5 * r * np.sin(t)) for t in a[:-1]] + [(0.0, 0.5 * r)]


def _head(kind: str, r: float, style: ModelingStyle, n: int) -> Solid:
    """A head about z, its rim at 0, its apex up; a sheet where the style models hollow."""
    profile = head_profile(kind, r)
    skirt = 0.06 * r
    outside = [(r, 0.0), *((x, z + skirt) for x, z in profile)]
    if not style.hollow:
        return turned(outside, n)
    wall = max(0.003, 0.012 * r)
    share = 1 - wall / r
    inside = [(x * share, z * share + skirt if z else skirt) for x, z in profile[::-1]]
    inside[0] = (0.0, inside[0][1] if inside[0][1] < outside[-1][1] - 0.5 * wall else outside[-1][1] - wall)
    return weld(
        [revolve([*outside, *inside, (r * share, 0.0), (r, 0.0)][:-1], n), revolve([(r * share, 0.0), (r, 0.0)], n)]
    )


def _shell(r: float, height: float, style: ModelingStyle, n: int) -> Solid:
    return ring(r - max(0.003, 0.012 * r) if style.hollow else 0.0, r, 0.0, height, n)


def nozzle(dn: int, reach: float, style: ModelingStyle, name: str = "nozzle") -> list[Part]:
    """A nozzle about z from -0.03 up to its flange's face at ``reach`` [m]; a lid, bolts and a hinge on a manway."""
    t, n, thick, size = Table(style, "Tank", name), style.round(PIPES[dn].radius), plate_thickness(dn), FLANGES[dn]
    t.add(name, ring(PIPES[dn].bore if style.hollow else 0.0, PIPES[dn].radius, -0.03, reach - 0.5 * thick, n))
    t.at(0, 0, reach).spun("x", np.pi).add(name, disc_flange(dn, style, thick), of="flange")
    if name == "manway":
        t.at(0, 0, reach + 0.002).add(name, disc_flange(dn, style, thick))
        t.add("bolt", bolt_circle(size.n_bolts, size.circle / 2, size.bolt, reach - thick, reach + thick + 0.002))
        x, y, z = 0.55 * size.outer, -0.2 * size.outer, reach + 0.12
        t.add(name, rope([(x, y, reach - 0.03), (x, y, z), (0.0, 0.0, z), (0.0, 0.0, reach + thick)], 0.012, 8))
    return t.parts


class LevelGauge(Params):
    """A sight-glass column between two cocks, or a magnetic level indicator with its flap rail, on an upright shell."""

    stand: float = between(0.1, 0.2, "from the shell to the column", "m")
    glass: bool = chance(0.5, "a sight glass rather than a magnetic indicator")

    def parts(self, r: float, low: float, high: float, style: ModelingStyle) -> list[Part]:
        """The gauge beside +x of a shell of radius ``r``, between two heights [m]."""
        t, out, cocks = Table(style, "Tank", "level gauge"), r + self.stand, []
        column, middle = 0.012 if self.glass else 0.03, (r + out) / 2
        for z in (low, high):
            nut = merge([hexagon(0.045, -0.02, 0.02), ring(0.011, 0.03, -0.05, -0.04, 12)])
            cocks += [along("x", nut, middle, 0, z), rod((middle, 0, z), (middle, -0.09, z), 0.005, 8)]
        t.add("gauge stem", *(rod((r - 0.01, 0, z), (out, 0, z), 0.011, 10) for z in (low, high)), own=True)
        t.add("gauge stem", *cocks, own=True)
        tube = cylinder(column, low - 0.06, high + 0.06, style.round(column))
        if self.glass:
            spots = ((0.022, 0.022), (0.022, -0.022), (-0.022, 0.0))
            guards = [rod((x, y, low - 0.04), (x, y, high + 0.04), 0.004, 6) for x, y in spots]
            guards += [cylinder(0.034, z, z + 0.008, 12) for z in (low - 0.04, high + 0.032)]
            t.at(out).add("sight glass", tube, of="dial", own=True)
            t.at(out).add("level gauge", *guards, own=True)
            return t.parts
        ends = [cylinder(0.05, z, z + 0.015, style.round(0.05)) for z in (low - 0.06, high + 0.045)]
        rail = box((0.012, 0.035, high - low), (column + 0.006, 0, (low + high) / 2))
        flaps = [box((0.004, 0.025, 0.008), (column + 0.0135, 0, z)) for z in np.linspace(low + 0.02, high - 0.02, 16)]
        t.at(out).add("level gauge", tube, *ends, own=True)
        t.at(out).add("level gauge", rail, of="electrical", own=True)
        t.at(out).add("gauge face", *flaps, of="handle", own=True, fine=True)
        return t.parts


class _Nozzle(Params):
    """A nozzle on the side of an upright shell."""

    room: float = given(1.0, "radius of the shell", "m")
    size: int = among(
        lambda p: tuple(dn for dn in (25, 40, 50, 80, 100) if dn == 25 or FLANGES[dn].outer <= 0.8 * p.room),
        "nominal size",
        "mm",
    )
    turn: float = between(0, 0.5, "round the shell from its even place", "rad")
    height: float = between(0.15, 0.85, "over the shell's lower rim / height of the shell")


class _Upright(Tank):
    """An upright vessel with heads, feet, nozzles, maybe a manway, lugs and a level gauge."""

    radius: float = between(0.25, 1.0, "of the shell", "m")
    lower: str = among((*_HEADS, "conical"), "lower head")
    upper: str = among((*_HEADS, "flat"), "upper head")
    feet: str = among(("legs", "legs", "skirt"), "what it stands on")
    slender: float = between(1.0, 3.5, "height of the shell / its radius")
    clear: float = between(0.15, 0.5, "from the floor to the lower head", "m", when=lambda p: p.feet != "none")
    legs: int = among((3, 4), "legs", when=lambda p: p.feet == "legs", otherwise=0)
    section: str = among(("pipe", "angle", "tube"), "of the legs", when=lambda p: p.feet == "legs", otherwise="")
    count: int = whole(1, 3, "nozzles on the side")
    nozzles: tuple[_Nozzle, ...] = several(
        made(_Nozzle, lambda p: {"room": p.radius}), lambda p: p.count, "nozzles on the side"
    )
    topped: bool = chance(0.7, "a nozzle on top")
    manned: bool = chance(0.6, "a manway", when=lambda p: p.radius > 0.5)
    lugs: bool = chance(0.5, "lifting lugs")
    gauged: bool = chance(0.5, "a level gauge", when=lambda p: p.slender * p.radius > 0.6)
    gauge: LevelGauge = nested(LevelGauge, "level gauge", when=lambda p: p.gauged)

    def build(self, t: Table) -> Model:
        r, height, n = self.radius, self.slender * self.radius, t.n(self.radius)
        n = n if n < 24 else max(32, n)
        standing = self.feet != "none"
        base = head_profile(self.lower, r)[-1][1] + 0.06 * r + self.clear if standing else 0.01 + 0.06 * r
        t.at(0, 0, base).add("shell", _shell(r, height, t.style, n))
        t.at(0, 0, base + height).add("dished head", _head(self.upper, r, t.style, n))
        t.at(0, 0, base).spun("x", np.pi).add("dished head", _head(self.lower, r, t.style, n))
        if standing:
            self._stand(t, base, n)
        ports = []
        for k, one in enumerate(self.nozzles):
            dn, angle, z = one.size, 2.2 * k + one.turn, base + height * one.height
            reach = 0.08 + PIPES[dn].radius
            _beside(t, r, z, angle).extend(nozzle(dn, reach, t.style))
            way = np.array([np.cos(angle), np.sin(angle), 0.0])
            ports += [Port(looking(way * (r + reach) + (0, 0, z), way), dn)] if z > 0.6 else []
        top = base + height + head_profile(self.upper, r)[-1][1] + 0.06 * r
        if self.topped:
            dn = 50 if r < 0.6 else 80
            t.at(0, 0, top).extend(nozzle(dn, 0.1, t.style))
            ports.append(Port(looking((0, 0, top + 0.1), (0, 0, 1)), dn))
        if self.manned:
            _beside(t, r, base + 0.5 * height, 5.2).extend(nozzle(300, 0.18, t.style, "manway"))
        if self.lugs:
            corners = np.array(outline(-0.05, 0, 0.05, 0, 0.05, 0.06, 0.02, 0.1, -0.02, 0.1, -0.05, 0.06))
            ear = extrude(corners, -0.006, 0.006, (circle(0.018, 10, (0, 0.065)),))
            for angle in (1.0, 1.0 + np.pi):
                pose = at(0.98 * r, 0, base + height) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2)
                t.spun("z", angle).moved(pose).add("lifting lug", ear, of="tank")
        if self.gauged:
            t.spun("z", 4.2).extend(self.gauge.parts(r, base + 0.2 * height, base + 0.75 * height, t.style))
        return t.model(kind="tank", ports=ports[:3])

    def _stand(self, t: Table, low: float, n: int) -> None:
        """Legs of pipe, angle or square tube with base plates, or a skirt, under the shell's rim [m]."""
        r, side = self.radius, 0.05 + 0.05 * self.radius
        if self.feet == "skirt":
            tube = ring(r - max(0.004, 0.012 * r), r, 0.0, low + 0.02, n)
            apart(t, "skirt", tube, around(box((0.10, 0.02, 0.12), (0.03, 0, 0.08)), 8, r))
            apart(t, "skirt", ring(0.85 * r, 1.12 * r, 0.0, 0.02, n))
            return
        high, thin = low + 0.25 * r, 0.1 * side
        angle = np.array(outline(0, 0, side, 0, side, thin, thin, thin, thin, side, 0, side)) - (0.5 * side, 0.3 * side)
        if self.section == "pipe":
            leg = ring(0.4 * side if t.style.hollow else 0.0, 0.5 * side, 0.0, high, t.n(side))
        else:
            leg = extrude(angle if self.section == "angle" else rounded_rectangle(side, side, thin, 2), 0.0, high)
        for k in range(self.legs):
            under = t.spun("z", 2 * np.pi * k / self.legs + 0.5).at(r + 0.45 * side)
            apart(under, "tank leg", leg)
            under.add("base plate", box((1.8 * side, 1.8 * side, 0.012), (0, 0, 0.006)))


def _beside(t: Table, r: float, z: float, angle: float) -> Table:
    """A table whose z axis looks out of the side of an upright shell."""
    return t.spun("z", angle).at(r, 0, z).along("x")


class Dished(_Upright, name="tank/upright dished", weight=2.5):
    """An upright vessel with dished heads on legs or a skirt."""


class FlatBottom(_Upright, name="tank/flat bottom"):
    """A flat-bottom tank (API 650 in small) with a conical or flat or dished roof, straight on the ground."""

    radius: float = between(0.4, 1.4, "of the shell", "m")
    lower: str = among(("flat",), "lower head")
    upper: str = among(("flat", "conical", "torispherical"), "roof")
    feet: str = among(("none",), "what it stands on")
    slender: float = between(1.0, 2.6, "height of the shell / its radius")


class Column(_Upright, name="tank/column"):
    """A slim column or an expansion vessel."""

    radius: float = between(0.12, 0.4, "of the shell", "m")
    lower: str = among(("2:1",), "lower head")
    upper: str = among(("2:1",), "upper head")
    feet: str = among(("skirt", "legs"), "what it stands on")
    slender: float = between(4, 9, "height of the shell / its radius")


_SIZES, _ABOUT_SIZE = (25, 40, 50, 80), "nominal size of its {} nozzle"


class Horizontal(Tank, name="tank/horizontal", weight=2):
    """A horizontal vessel on two saddles, with nozzles on top, maybe a manway."""

    radius: float = between(0.25, 0.8, "of the shell", "m")
    slender: float = between(2.5, 5.0, "length of the shell / its radius")
    clear: float = between(0.2, 0.5, "from the floor to the shell", "m")
    ends: str = among((*_HEADS, "flat"), "heads at its ends")
    count: int = whole(2, 3, "nozzles on top")
    first: int = among(_SIZES, _ABOUT_SIZE.format("first"), "mm")
    manned: bool = chance(0.6, "a manway in place of the second nozzle", when=lambda p: p.radius > 0.4)
    second: int = among(_SIZES, _ABOUT_SIZE.format("second"), "mm", when=lambda p: not p.manned, otherwise=0)
    third: int = among(_SIZES, _ABOUT_SIZE.format("third"), "mm", when=lambda p: p.count == 3, otherwise=0)

    def build(self, t: Table) -> Model:
        r, length, n = self.radius, self.slender * self.radius, t.n(self.radius)
        axis = r + self.clear
        lying = t.at(0, 0, axis)
        lying.at(-length / 2).along("x").add("shell", _shell(r, length, t.style, n))
        for s in (1, -1):
            lying.at(s * length / 2).spun("y", s * np.pi / 2).add("dished head", _head(self.ends, r, t.style, n))
        a, low = np.linspace(np.pi + 0.5, 2 * np.pi - 0.5, 9), -axis + 0.015
        seat = 1.01 * r * np.column_stack([np.cos(a), np.sin(a)])
        web = extrude(np.vstack([seat, [(0.8 * r, low), (-0.8 * r, low)]])[::-1], -0.01, 0.01)
        tall = axis - 0.8 * r
        ribs = [box((0.14, 0.012, 0.75 * tall), (0, y * r, 0.4 * tall + 0.01)) for y in (-0.7, 0.0, 0.7)]
        foot = box((0.18, 1.7 * r, 0.015), (0, 0, 0.0075))
        up = at(0, 0, axis) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2)
        for x in (-0.3 * length, 0.3 * length):
            apart(t.at(x), "saddle", moved(web, up), *ribs, foot)
        ports = []
        sizes = (self.first, self.second, self.third)[: self.count]
        for k, (x, dn) in enumerate(zip(np.linspace(-0.35, 0.35, self.count) * length, sizes, strict=True)):
            manway = k == 1 and self.manned
            spot = t.at(x, 0, axis + r)
            spot.extend(nozzle(300, 0.12, t.style, "manway") if manway else nozzle(dn, 0.12, t.style))
            ports += [] if manway else [Port(looking((x, 0, axis + r + 0.12), (0, 0, 1)), dn)]
        return t.model(kind="tank", ports=ports)


class Rectangular(Tank, name="tank/rectangular"):
    """A rectangular tank or an IBC: a box with a cap, stiffeners or a cage, on a pallet."""

    width: float = between(0.6, 1.6, "of the box", "m")
    depth: float = between(0.6, 1.1, "of the box", "m")
    height: float = between(0.6, 1.3, "of the box", "m")
    caged: bool = chance(0.5, "a cage of rods rather than stiffeners")

    def build(self, t: Table) -> Model:
        w, d, h, base = self.width, self.depth, self.height, 0.14
        t.add("shell", extrude(rounded_rectangle(w, d, 0.06, 4), base, base + h))
        t.at(0.1 * w).add("manway", cylinder(0.09, base + h, base + h + 0.04, t.n(0.09)), of="rubber")
        if self.caged:
            spots = [(x, s * (d / 2 + 0.01)) for x in np.linspace(0.06 - w / 2, w / 2 - 0.06, 6) for s in BOTH]
            spots += [(s * (w / 2 + 0.01), y) for y in np.linspace(0.06 - d / 2, d / 2 - 0.06, 4) for s in BOTH]
            posts = [rod((x, y, base), (x, y, base + h + 0.02), 0.009, 8) for x, y in spots]
            outer, inner = (
                rounded_rectangle(w + 0.04, d + 0.04, 0.06, 3),
                rounded_rectangle(w + 0.006, d + 0.006, 0.045, 3),
            )
            hoop = extrude(outer, 0, 0.018, (inner,))
            hoops = [moved(hoop, at(0, 0, base + h * s)) for s in (0.1, 0.35, 0.6, 0.85)]
            t.add("tank", *posts, *hoops, of="clamp", own=False)
        else:
            t.add("shell", *(box((w + 0.08, d + 0.08, 0.05), (0, 0, base + h * s)) for s in (0.25, 0.55, 0.85)))
        t.add("tank leg", *(box((w, 0.1, base), (0, y, base / 2)) for y in (-0.4 * d, 0, 0.4 * d)), own=False)
        t.at(0, -d / 2, base + 0.12).along("-y").extend(nozzle(50, 0.1, t.style))
        return t.model(kind="tank")


class Sphere(Tank, name="tank/sphere", weight=0.7):
    """A spherical vessel or an expansion tank on legs."""

    radius: float = between(0.2, 0.6, "of the vessel", "m")
    clear: float = between(0.2, 0.4, "from the floor to the vessel", "m")
    stretch: float = among((1.0, 0.8, 1.3), "height / width")
    seamed: bool = chance(0.5, "a seam round its middle")

    def build(self, t: Table) -> Model:
        r, axis, n = self.radius, self.stretch * self.radius + self.clear, t.n(self.radius)
        t.at(0, 0, axis).add("shell", ball(r, n, self.stretch))
        if self.seamed:
            t.add("shell", ring(0.99 * r, 1.03 * r, axis - 0.02, axis + 0.02, n))
        for k in range(3):
            leg = rod((r, 0.0, 0.01), (0.75 * r, 0.0, axis - 0.3 * r), 0.02, 10)
            apart(t.spun("z", 2 * np.pi * k / 3), "tank leg", leg, moved(cylinder(0.05, 0.0, 0.015, 12), at(r)))
        apart(t, "nozzle", rod((0, 0, self.clear - 0.1), (0, 0, axis), 0.017, 10))
        return t.model(kind="expansion vessel")


VESSELS = families_of(Dished, FlatBottom, Column, Horizontal, Rectangular, Sphere)
