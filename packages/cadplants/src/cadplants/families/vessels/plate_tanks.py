"""Tanks of plates and panels, hoppers, drums, fuel tanks, buried tanks."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.exchangers import frame_of
from cadplants.families.vessels.vessel import Tank, apart
from cadplants.families.vessels.vessel_fittings import MANWAYS, Manway, head, head_height, lug, mouth, sides
from cadplants.families.vessels.vesselbuild import branch
from cadplants.families.vessels.vesselfeet import bar, ladder
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, extrude, moved, weld
from cadplants.solids.mesh_ops import loft as skin
from cadplants.solids.polygon import rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLATE_TANKS"]

_SQUARE = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


def _loop(w: float, d: float, z: float) -> Floats:
    """A rectangle on a height [m]."""
    return np.column_stack([_SQUARE * (w, d), np.full(4, z)])


def _frame(w: float, d: float, low: float, high: float, w_in: float, d_in: float) -> Solid:
    """A rectangular frame between two heights, from its outer and its inner sides [m]."""
    return extrude(_SQUARE * (w, d), low, high, (_SQUARE * (w_in, d_in),))


class BucketHopper(Tank, name="tank/bucket hopper", weight=0.9):
    """A bin or bucket hopper: a box or none over a pyramid, open or lidded, on a frame, a gate below."""

    width: float = between(0.7, 1.8, "of the box", "m")
    depth: float = between(0.7, 1.5, "of the box", "m")
    mouth: float = between(0.2, 0.35, "side of the mouth below", "m")
    cone: float = between(0.6, 1.2, "height of the pyramid", "m")
    tall: float = among((0.06, 0.4, 0.8), "height of the box", "m")
    clear: float = between(0.6, 1.1, "from the floor to the mouth", "m")
    lidded: bool = chance(0.5, "a lid with a hatch")
    hatch: Manway = nested(MANWAYS["hatch"], "hatch", when=lambda p: p.lidded)
    braced: bool = chance(0.5, "braces between the posts")

    def build(self, t: Table) -> Model:
        w, d, out, low = self.width, self.depth, self.mouth, self.clear
        z, thick, side = low + self.cone, 0.012, 0.08
        top = z + self.tall
        levels = ((out, out, low), (w, d, z), (w, d, top))
        inner = [_loop(a - 2 * thick, b - 2 * thick, c) for a, b, c in levels[::-1]]
        t.add("shell", weld([skin([*(_loop(*one) for one in levels), *inner], closed=True)]))
        rim = _frame(w + 0.1, d + 0.1, top - 0.012, top, w - 0.001, d - 0.001)
        t.add("shell", rim, _frame(w + 0.07, d + 0.07, z - 0.03, z + 0.03, w - 0.004, d - 0.004))
        if self.lidded:
            t.add("shell", box((w + 0.1, d + 0.1, 0.006), (0, 0, top + 0.003)))
            t.at(0.2 * w, 0, top + 0.006).extend(self.hatch.parts(t.style, 0.2))
        flange = _frame(out + 0.12, out + 0.12, low - 0.012, low, out - 2 * thick, out - 2 * thick)
        apart(t, "nozzle", flange, of="flange")
        grip = rod((out / 2 + 0.4, -0.1, low - 0.018), (out / 2 + 0.4, 0.1, low - 0.018), 0.012, 8)
        t.add("valve", box((out + 0.5, out + 0.06, 0.012), (0.2, 0, low - 0.018)), grip, of="steel")
        wide, deep = w + 0.07, d + 0.07
        x, y = (wide + side) / 2, (deep + side) / 2
        apart(t, "tank leg", frame_of(wide + 2 * side, deep + 2 * side, z + 0.03, side, rails=False))
        beams = [box((wide, side, side), (0, s * y, z - 0.01)) for s in BOTH]
        t.add("beam", *beams, *(box((side, deep, side), (s * x, 0, z - 0.01)) for s in BOTH))
        if self.braced:
            for s in BOTH:
                t.add("brace", bar((-x, s * y, 0.1), (x, s * y, z - 0.1), rounded_rectangle(0.05, 0.01, 0.0)))
        return t.model(kind="hopper")


class BracedPlates(Tank, name="tank/braced plates", weight=0.9):
    """A rectangular tank of corrugated or stiffened plate: wall ribs or waves, a rim, tie bars."""

    width: float = between(1.2, 3.2, "of the tank", "m")
    depth: float = between(0.9, 1.8, "of the tank", "m")
    height: float = between(0.8, 1.8, "of the tank", "m")
    base: float = among((0.12, 0.2), "height of its skids", "m")
    waved: bool = chance(0.5, "corrugated rather than stiffened")
    angles: bool = chance(0.5, "its stiffeners are angles, not channels", when=lambda p: not p.waved)
    lidded: bool = chance(0.5, "a lid with a hatch")
    hatch: Manway = nested(MANWAYS["hatch"], "hatch", when=lambda p: p.lidded)
    low: int = among((40, 50, 80), "nominal size of the nozzle near the bottom", "mm")
    high: int = among((40, 50, 80), "nominal size of the nozzle near the top", "mm")

    def build(self, t: Table) -> Model:
        w, d, base, top, thick = self.width, self.depth, self.base, self.base + self.height, 0.01
        outer = self._waves() if self.waved else _SQUARE * (w, d)
        shell = extrude(outer, base, top, (_SQUARE * (w - 2 * thick, d - 2 * thick),))
        t.add("shell", shell, box((w - 2 * thick + 0.002, d - 2 * thick + 0.002, 0.01), (0, 0, base + 0.005)))
        t.add("shell", _frame(w + 0.16, d + 0.16, top - 0.01, top + 0.01, w - 2 * thick, d - 2 * thick))
        if not self.waved:
            section = section_angle(0.06, 0.006) if self.angles else section_channel(0.08, 0.05, 0.006, 0.006)
            rib = moved(extrude(section - section.mean(axis=0), base, top - 0.01), at(0, -d / 2 - 0.025))
            for x in np.linspace(-0.44, 0.44, max(3, int(w / 0.5))) * w:
                t.at(x).spun("z", np.pi).add("shell", rib)
                t.at(x).add("shell", rib)
        z = base + 0.8 * self.height
        t.add("shell", *(rod((x, -d / 2, z), (x, d / 2, z), 0.015, 8) for x in (-0.25 * w, 0.25 * w)), of="steel")
        apart(t, "tank leg", *(box((0.12, d, base), (x, 0, base / 2)) for x in np.linspace(-0.42, 0.42, 3) * w))
        if self.lidded:
            t.add("shell", box((w + 0.1, d + 0.1, 0.005), (0, 0, top + 0.0125)))
            t.at(0.25 * w, 0, top + 0.015).extend(self.hatch.parts(t.style, 0.25))
        ports: list[Port] = []
        for s, f, dn in ((-1, 0.2, self.low), (1, 0.75, self.high)):
            pose = at(s * w / 2, 0, base + max(0.13, f * self.height)) @ spun("y", s * np.pi / 2)
            ports += branch(t, "plain", dn, pose)
        if top > 1.5:
            up = t.at(-0.2 * w, -d / 2 - 0.17).spun("z", -np.pi / 2)
            up.add("ladder", ladder(0.0, 0.0, top + 0.6, t.style, False, 0.16))
        return t.model(kind="rectangular tank", ports=ports)

    def _waves(self) -> Floats:
        """The outline of corrugated walls."""
        w, d, count = self.width, self.depth, int(self.width / 0.3)
        xs, dent = np.linspace(-w / 2, w / 2, 4 * count + 1)[:-1], np.tile([0.0, 0.0, 0.04, 0.04], count)
        near = np.column_stack([xs, -d / 2 - dent])
        return np.vstack([near, [(w / 2, -d / 2)], -near, [(-w / 2, d / 2)]])


class Sectional(Tank, name="tank/sectional panels", weight=0.7):
    """A sectional water tank of pressed panels (BS 7491): bolted seams, a roof of panels, beams on dwarf walls."""

    across: int = whole(2, 4, "panels along its length")
    deep: int = whole(1, 3, "panels along its depth")
    tiers: int = whole(1, 2, "rows of panels")
    side: float = among(lambda p: (0.5, 1.0) if p.across + p.deep > 5 else (1.0,), "side of a panel", "m")
    smaller: bool = chance(0.4, "its panels' sides are at most 0.75 m", when=lambda p: p.side > 0.75)
    base: float = between(0.35, 0.6, "height of its floor", "m")
    joined: bool = chance(0.5, "the walls are one mesh")
    hatch: Manway = nested(MANWAYS["hatch"], "hatch")

    def build(self, t: Table) -> Model:
        p, base = min(self.side, 0.75) if self.smaller else self.side, self.base
        w, d, h = self.across * p, self.deep * p, self.tiers * p
        xs, ys = (-w / 2 + (np.arange(self.across) + 0.5) * p), (-d / 2 + (np.arange(self.deep) + 0.5) * p)
        loops = ((1, 0.0), (1, 0.012), (0.9, 0.014), (0.6, 0.05), (0.2, 0.055))
        panel, half = moved(lofted([_loop(f * p, f * p, z) for f, z in loops]), spun("x", np.pi / 2)), np.pi / 2
        walls = []
        for z in base + (np.arange(self.tiers) + 0.5) * p:
            for x in xs:
                walls += [moved(panel, at(x, -d / 2, z)), moved(panel, at(x, d / 2, z) @ spun("z", np.pi))]
            for y in ys:
                walls += [moved(panel, at(s * w / 2, y, z) @ spun("z", s * half)) for s in BOTH]
        t.add_each("shell", walls, joined=self.joined, of="dial")
        roof = [moved(panel, at(x, y, base + h) @ spun("x", -half)) for x in xs for y in ys]
        t.add("shell", *roof, of="dial")
        posts = [box((0.06, 0.06, h), (sx * w / 2, sy * d / 2, base + h / 2)) for sx in BOTH for sy in BOTH]
        t.add("shell", box((w + 0.02, d + 0.02, 0.02), (0, 0, base)), *posts, of="steel")
        beam, dwarf = extrude(section_i(0.12, 0.1, 0.006, 0.009), -d / 2 - 0.1, d / 2 + 0.1), base - 0.13
        for x in np.linspace(-w / 2 + 0.06, w / 2 - 0.06, self.across + 1):
            t.at(x, 0, base - 0.07).along("y").add("beam", beam)
        for y in np.linspace(-d / 2, d / 2, max(2, self.deep)):
            t.add("foundation", box((w + 0.2, 0.2, dwarf), (0, y, dwarf / 2)))
        t.at(w / 2 - p / 2, d / 2 - p / 2, base + h + 0.05).extend(self.hatch.parts(t.style, 0.25))
        up = t.at(-w / 2 + p / 2, -d / 2 - 0.17).spun("z", -half)
        up.add("ladder", ladder(0.0, 0.0, base + h + 0.7, t.style, False, 0.17))
        ports = branch(t, "plain", 80, at(w / 2 + 0.05, -d / 2 + p / 2, base + 0.5 * p) @ spun("y", half))
        return t.model(kind="sectional tank", ports=ports)


class Drums(Tank, name="tank/drums", weight=0.9):
    """One to four drums on a pallet or a bunded pallet, or on the bare floor; one with a tap lies on a cradle."""

    form: str = among(("steel", "open head", "plastic"), "how the drums are built")
    lying: bool = chance(0.25, "a single one that lies on a cradle")
    count: int = whole(1, 4, "drums", when=lambda p: not p.lying, otherwise=1)
    base: float = among((0.0, 0.144, 0.3), "height of the pallet", "m", when=lambda p: not p.lying, otherwise=0.0)
    turns: tuple[float, ...] = several(
        number(0, 6),
        lambda p: p.count,
        "how each is turned",
        "rad",
        when=lambda p: not p.lying,
    )

    def build(self, t: Table) -> Model:
        if self.lying:
            self._cradle(t)
            return t.model(kind="drum")
        spots = ((-0.31, -0.31), (0.31, 0.31), (0.31, -0.31), (-0.31, 0.31))
        for (x, y), turn in zip(spots if self.count > 1 else ((0.0, 0.0),), self.turns, strict=False):
            self._drum(t.at(x, y, self.base).spun("z", turn))
        if self.base == 0.3:
            w = 1.3
            feet = [box((w, 0.12, 0.021), (0, y, 0.0105)) for y in (-0.5, 0, 0.5)]
            t.add("skid frame", box((w, w, 0.26), (0, 0, 0.15)), *feet, of="safety")
            t.add("grating", box((w - 0.04, w - 0.04, 0.02), (0, 0, 0.29)))
        elif self.base:
            high = self.base - 0.022
            boards = [box((1.24, 0.14, 0.022), (0, y, self.base - 0.011)) for y in np.linspace(-0.55, 0.55, 6)]
            blocks = [box((0.1, 1.24, high), (x, 0, high / 2)) for x in (-0.55, 0.0, 0.55)]
            t.add("skid frame", *boards, *blocks, of="safety")
        return t.model(kind="drum")

    def _cradle(self, t: Table) -> None:
        """A drum with a tap on a cradle."""
        axis, square = 0.65, rounded_rectangle(0.04, 0.04, 0.0)
        self._drum(t.at(-0.44, 0, axis).along("x"))
        rails = [bar((0, s * 0.3, 0.0067), (0, s * 0.16, axis - 0.245), square, (1, 0, 0)) for s in BOTH]
        for x in (-0.25, 0.25):
            apart(t.at(x), "saddle", *rails, box((0.04, 0.5, 0.04), (0, 0, 0.15)))
        tap = along("x", cylinder(0.014, 0.42, 0.53, 10), 0, 0, axis + 0.18)
        t.add("valve", tap, rod((0.51, 0, axis + 0.14), (0.51, 0, axis + 0.22), 0.012, 8))

    def _drum(self, t: Table) -> None:
        """A 200 l drum (ISO 15750): steel with rolling hoops and bungs, open-head with a ring, or of plastic."""
        r, h, n = 0.292, 0.88, sides(t.style, 0.292)
        wide, bulge = 1.02 * r, 1.035 * r
        if self.form == "plastic":
            wall = outline(0.9 * r, 0.0, r, 0.05)
            for z in (0.24, 0.66):
                wall += outline(r, z, 1.03 * r, z + 0.03, r, z + 0.06)
            wall += outline(0.96 * r, h - 0.06, 0.8 * r, h - 0.03, 0.82 * r, h, 0.7 * r, h, 0.68 * r, h - 0.02)
        else:
            wall = outline(0.95 * r, 0.0, wide, 0.0, wide, 0.018, r, 0.022)
            for z in (0.3, 0.58):
                wall += outline(r, z - 0.02, bulge, z - 0.008, bulge, z + 0.008, r, z + 0.02)
            wall += outline(r, h - 0.022, wide, h - 0.018, wide, h, 0.97 * r, h, 0.965 * r, h - 0.015)
        t.add("shell", turned(wall, n), of="handle" if self.form == "steel" else "motor")
        if self.form == "open head":
            lever = box((0.03, 0.14, 0.02), (1.07 * r, 0, h - 0.01))
            t.add("clamp", ring(r, 1.06 * r, h - 0.025, h + 0.004, n), lever, of="steel")
            return
        bungs, top = [], wall[-1][1]
        for c, x in ((0.033, 0.62 * r), (0.02, -0.62 * r)):
            bung = [cylinder(c, top - 0.005, top + 0.018, 16), hexagon(1.2 * c, top + 0.017, top + 0.026)]
            bungs += [moved(one, at(x)) for one in bung]
        apart(t, "nozzle", *bungs, of="trim")


class Fuel(Tank, name="tank/fuel", weight=0.9):
    """A fuel tank with flat flanged ends (DIN 6608 in small): in a bund tray or not, fill cap, vent, gauge."""

    radius: float = between(0.35, 0.7, "of the shell", "m")
    slender: float = between(2.2, 4.0, "length of the shell / its radius")
    bunded: bool = chance(0.5, "it stands in a bund tray")
    bund: float = between(0.3, 0.8, "height of the tray, but for 0.1 m / radius of the shell", when=lambda p: p.bunded)
    manway: Manway = nested(MANWAYS["hinged"], "manway", when=lambda p: p.radius > 0.5)

    def build(self, t: Table) -> Model:
        r, n, length = self.radius, sides(t.style, self.radius), self.radius * self.slender
        half, axis, floor = length / 2, r + (0.22 if self.bunded else 0.12), 0.1 if self.bunded else 0.0
        lying = t.at(0, 0, axis)
        lying.along("x").add("shell", ring(0.985 * r if t.style.hollow else 0.0, r, -half, half, n))
        end = turned(outline(r, half - 0.001, r, half + 0.008, 0.9 * r, half + 0.02), n)
        for way in ("-x", "x"):
            lying.along(way).add("dished head", end)
        a = np.linspace(np.pi + 0.7, 2 * np.pi - 0.7, 9)
        seat = (r - 0.002) * np.column_stack([np.cos(a), np.sin(a)])
        x1, z1 = seat[-1][0], floor - axis
        plate = moved(extrude(np.vstack([[(-x1, z1), (x1, z1)], seat[::-1]]), -0.04, 0.04), spun("x", np.pi / 2))
        for x in (-0.3 * length, 0.3 * length):
            apart(lying.at(x).spun("z", np.pi / 2), "saddle", plate)
        if self.bunded:
            w, d, h, z = length + 0.3, 2 * r + 0.3, self.bund * r + 0.1, floor - 0.01
            sheets = [box((w, d, 0.01), (0, 0, floor - 0.005))]
            sheets += [box((w, 0.006, h), (0, s * d / 2, z + h / 2)) for s in BOTH]
            sheets += [box((0.006, d, h), (s * w / 2, 0, z + h / 2)) for s in BOTH]
            t.add("tank", *sheets, *(box((w, 0.08, z), (0, s * 0.35 * d, z / 2)) for s in BOTH))
        crown = lying.at(0, 0, r - 0.01)
        fill = [cylinder(0.04, -0.02, 0.1, 14), cylinder(0.055, 0.09, 0.12, 14)]
        apart(crown.at(-0.3 * length), "nozzle", *fill, of="trim")
        vent = rope([(0, 0, -0.02), (0, 0, 0.5), (0.06, 0, 0.56), (0.12, 0, 0.5)], 0.02, 10)
        crown.at(-0.18 * length).add("pipe", vent)
        crown.at(-0.05 * length).add("level gauge", cylinder(0.05, -0.005, 0.06, 16), of="dial")
        if r > 0.5:
            lying.at(0.02 * length + 0.3, 0, r).extend(self.manway.parts(t.style, 0.24, r, 0.02))
        for s in BOTH:
            lying.at(s * 0.42 * length, 0, r).extend(lug("plate", 0.09, t.style, r, 0.01))
        return t.model(kind="fuel tank")


class _Tower(Params):
    """A manhole tower."""

    neck: float = between(0.3, 0.36, "radius", "m")
    tall: float = between(0.3, 0.9, "height over the shell", "m")

    def build(self, t: Table, r: float) -> None:
        """Puts it down on a shell of a radius about the frame's x axis."""
        neck, top, n = self.neck, r + self.tall, t.n(self.neck)
        bands = [ring(0.99 * neck, 1.07 * neck, z, z + 0.04, n) for z in np.linspace(r + 0.08, top - 0.1, 3)]
        apart(t, "manway", ring(0.94 * neck, neck, 0.8 * r, top, n), *bands, of="dial")
        lid = outline(1.1 * neck, top, 1.12 * neck, top + 0.05, 0.9 * neck, top + 0.07)
        apart(t, "manway", turned(lid, n), of="rubber")


def _length(radius: float, slender: float) -> float:
    """Length of a buried tank's shell [m]."""
    return min(radius * slender, 4.0)


class Buried(Tank, name="tank/buried", weight=0.7):
    """An underground tank as delivered: a ribbed shell on a bed or with strap anchors, a manhole tower with its lid."""

    radius: float = between(0.5, 1.1, "of the shell", "m")
    slender: float = between(2.4, 4.5, "length of the shell, at most 4 m / its radius")
    bed: float = between(0.12, 0.3, "thickness of the bed", "m")
    ribs: int = whole(4, 9, "ribs round the shell")
    ends: str = among(("torispherical", "shallow", "2:1"), "heads at its ends")
    spots: int = among((1, 2), "towers", when=lambda p: _length(p.radius, p.slender) > 2, otherwise=1)
    towers: tuple[_Tower, ...] = several(made(_Tower), lambda p: p.spots, "towers")
    straps: int = whole(2, 3, "straps", when=lambda p: p.spots > 1, otherwise=2)

    def build(self, t: Table) -> Model:
        r, n, length = self.radius, sides(t.style, self.radius), _length(self.radius, self.slender)
        bed, pitch = self.bed, length / self.ribs
        axis, neck = bed + r - 0.02, 0.96 * r
        wall = outline(0.99 * r, 0.0)
        for z in pitch * np.arange(self.ribs):
            wall += outline(neck, z + 0.15 * pitch, neck, z + 0.45 * pitch, r, z + 0.55 * pitch, r, z + 0.9 * pitch)
        middle, cap = t.at(0, 0, axis), head(self.ends, 0.97 * r, t.style, n)
        lying = middle.at(-length / 2).along("x")
        lying.add("shell", turned([*wall, (0.97 * r, length)], n), of="dial")
        lying.at(0, 0, length - 0.002).add("dished head", cap, of="dial")
        lying.at(0, 0, 0.002).along("-z").add("dished head", cap, of="dial")
        wide = length + 2 * head_height(self.ends, r) + 0.2
        t.add("foundation", box((wide, 2.2 * r, bed), (0, 0, bed / 2)))
        strap = along("x", ring(0.985 * r, 1.012 * r, -0.03, 0.03, n), 0, 0, axis)
        anchors = [rod((0, s * r, bed - 0.01), (0, s * r, axis), 0.012, 8) for s in BOTH]
        for x in np.linspace(-0.45, 0.45, self.straps) * length:
            t.at(x).add("clamp", strap, *anchors)
        for f, tower in zip((0.0,) if self.spots == 1 else (-0.24, 0.24), self.towers, strict=True):
            tower.build(middle.at(f * length), r)
        for s in BOTH:
            out = middle.at(s * (length / 2 + 0.75 * head_height(self.ends, 0.97 * r)), 0, 0.55 * r)
            out.spun("y", s * np.pi / 2).extend(mouth("fitting", 100, 0.2, t.style, 0.0, 0.3 * r))
        return t.model(kind="buried tank")


PLATE_TANKS = families_of(BucketHopper, BracedPlates, Sectional, Drums, Fuel, Buried)
