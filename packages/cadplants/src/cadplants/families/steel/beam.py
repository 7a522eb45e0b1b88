"""Beams and trusses: rolled, welded, cold-formed, castellated, of timber and concrete."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import number, yes
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.shape import (
    ROLLED,
    RUNWAYS,
    Base,
    Props,
    Section,
    Structure,
    bar,
    bolts,
    few_sides,
    flat,
    lug,
    mirrored,
    section,
    slab_xz,
    slab_yz,
    span_of,
    trolley,
)
from cadplants.model.family import Model
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, box
from cadplants.solids.transforms import at, spun

__all__ = ["BEAMS"]

_ON = "what it lies on"


class _Plain(Structure, grain="fitting"):
    """One to three sections side by side on props (EN 10365, EN 10210, EN 10162)."""

    length: float = between(0.6, 6.0, "of a beam", "m")
    size: float = between(0.08, 0.32, "height of the section", "m")
    count: int = whole(1, 3, "beams side by side")
    shape: str = among(ROLLED, "section")
    pitch: float = between(
        1.0, 2.0, "from beam to beam / width of the section", when=lambda p: p.count > 1, otherwise=1.0
    )
    ends: str = among(("bare", "plates", "cleats"), "what is at the ends of one beam", when=lambda p: p.count == 1)
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        one, up = section(self.shape, self.size, t.style), t.at(0, 0, self.props.top)
        x0, x1, y0, _y1 = span_of(one)
        pitch, last = (x1 - x0) * self.pitch + 0.004, self.count - 1
        for k in range(self.count):
            y = (k - last / 2) * pitch
            up.add("beam", bar((0, y, -y0), (self.length, y, -y0), one))
        self._ends(up, one, -y0)
        self.props.build(t, self.length, last * pitch + x1 - x0)
        return t.model()

    def _ends(self, t: Table, one: Section, z: float) -> None:
        """End plates, cleats or nothing at the ends of a beam along x."""
        x0, x1, y0, y1 = span_of(one)
        w, h = x1 - x0 + 0.03, y1 - y0
        for x, s in ((0.0, -1), (self.length, 1)):
            if self.ends == "plates":
                edge = [(x0 - 0.015, y0), (x1 + 0.015, y0), (x1 + 0.015, y1), (x0 - 0.015, y1)]
                spots = [(x0 - 0.015 + u * w, z + y0 + v * h) for u in (0.15, 0.85) for v in (0.25, 0.75)]
                holes = tuple(circle(0.008, 8, spot) for spot in spots) if t.style.holes and h > 0.07 else ()
                t.add("plate", slab_yz(np.array(edge) + np.array([0, z]), 0.012, x + s * 0.006, holes))
            elif self.ends == "cleats":
                t.add("plate", box((0.06, 0.01, 0.6 * h), (x + s * 0.01, x1 + 0.005, z)))


class Rolled(_Plain, name="beam/rolled", weight=1.2):
    """Rolled or hollow sections side by side on props (EN 10365, EN 10210)."""


class Thin(_Plain, name="beam/thin sections"):
    """Cold-formed sections, angles or tees side by side on props (EN 10162)."""

    length: float = between(0.6, 4.0, "of a beam", "m")
    shape: str = among(("C", "Z", "strut", "hat", "L", "LL", "T"), "section")


class Castellated(Structure, name="beam/castellated"):
    """A castellated or cellular beam: an I section whose web has hexagonal or round openings."""

    length: float = between(2.0, 6.0, "of the beam", "m")
    high: float = between(0.25, 0.6, "height of the section", "m")
    hexagons: bool = chance(0.5, "its openings are hexagons, not round")
    joined: bool = chance(0.6, "web and flanges in one mesh")
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        length, h, up = self.length, self.high, t.at(0, 0, self.props.top).bundled("beam")
        b, f, count = 0.45 * h, 0.05 * h, int(np.clip(length / (1.1 * h), 3, 12))
        n = 6 if self.hexagons else few_sides(t.style, 0.32 * h, 16)
        holes = tuple(circle(0.31 * h, n, (float(x), h / 2)) for x in (np.arange(count) + 0.5) * length / count)
        web = slab_xz([(0, f), (length, f), (length, h - f), (0, h - f)], max(0.006, 0.025 * h), 0.0, holes)
        flanges = [box((length, b, f), (length / 2, 0, z)) for z in (f / 2, h - f / 2)]
        (up.bundled("") if self.joined else up).add_each("beam", (web, *flanges), joined=self.joined)
        self.props.build(t, length, b)
        return t.model()


class Girder(Structure, name="beam/plate girder"):
    """A welded plate girder, straight, haunched or tapered, with stiffeners; one web or a box of two."""

    length: float = between(1.5, 6.0, "of the girder", "m")
    high: float = between(0.3, 0.9, "its greatest height", "m")
    wide: float = between(0.35, 0.6, "width of a flange / height")
    low: float = among((1.0, 1.0, 0.55, 0.7), "least height / greatest")
    form: str = among(
        ("taper", "ridge", "haunch"), "how its height changes", when=lambda p: p.low < 1, otherwise="plain"
    )
    single: bool = chance(0.7, "one web, not two")
    joined: bool = chance(0.5, "in one mesh")
    stiff: bool = chance(0.75, "with stiffeners", when=lambda p: p.single)
    ribs: int = whole(2, 6, "pairs of stiffeners", when=lambda p: p.stiff)
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        length, h, low, up = self.length, self.high, self.high * self.low, t.at(0, 0, self.props.top).bundled("beam")
        b, f, thick = self.wide * h, 0.02, 0.01
        side = {
            "plain": [(length, h), (0, h)],
            "taper": [(length, low), (0, h)],
            "ridge": [(length, low), (length / 2, h), (0, low)],
            "haunch": [(length, h), (0.75 * length, low), (0.25 * length, low), (0, h)],
        }[self.form]
        webs = [0.0] if self.single else [-0.3 * b, 0.3 * b]
        solids = [slab_xz(np.array([(0, f), (length, f), *side]), thick, y) for y in webs]
        solids.append(box((length, b, f), (length / 2, 0, f / 2)))
        for (xa, za), (xb, zb) in zip(side[:-1], side[1:], strict=True):
            solids.append(slab_xz([(xb, zb), (xa, za), (xa, za + f), (xb, zb + f)], b))
        (up.bundled("") if self.joined else up).add_each("beam", solids, joined=self.joined)
        xs = np.linspace(0.01, length - 0.01, self.ribs)
        for x, z in zip(xs, np.interp(xs, *np.array(side[::-1], float).T), strict=True):
            deep = b / 2 - thick / 2 - 0.01
            for s in BOTH:
                middle = (x, s * (b / 4 + thick / 4 - 0.005), (z + f - 0.005) / 2)
                up.add("plate", box((0.01, deep, z - f - 0.005), middle))
        self.props.build(t, length, b)
        return t.model()


class CraneRunway(Structure, name="beam/crane runway", weight=0.8, grain="fitting"):
    """A crane runway: an I or box girder on columns with brackets, a rail (DIN 536) with clips and an end stop."""

    length: float = between(2.5, 6.0, "of the girder", "m")
    high: float = between(0.25, 0.5, "height of the girder", "m")
    girder: str = among(("H", "I", "RHS"), "section of the girder")
    rail: str = among(("rail", "rail", "square"), "section of the rail")
    tall: float = between(0.05, 0.12, "height of the rail", "m")
    stop: bool = chance(0.7, "an end stop")
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        length, h, up = self.length, self.high, t.at(0, 0, self.props.top)
        girder, rail = section(self.girder, h, t.style), section(self.rail, self.tall, t.style)
        left, right, r0, r1 = span_of(rail)
        up.add("beam", bar((0, 0, h / 2), (length, 0, h / 2), girder))
        up.add("beam", bar((0, 0, h - r0), (length, 0, h - r0), rail))
        foot = 0.5 * (right - left) + 0.02
        for x in np.arange(0.3, length - 0.2, 0.6):
            clips = [box((0.06, 0.05, 0.015), (x, s * foot, h + 0.0075)) for s in BOTH]
            up.add_each("clamp", clips, of="steel")
        if self.stop:
            tall = r1 - r0 + 0.15
            up.add("plate", box((0.02, 0.12, tall), (length - 0.01, 0, h + tall / 2)))
        self.props.build(t, length, span_of(girder)[1] * 2)
        return t.model()


class Purlins(Structure, name="beam/purlins", weight=0.8, grain="fitting"):
    """Cold-formed purlins (Z, lipped C, hat) bolted to cleats on two rafters on short columns."""

    length: float = between(1.5, 4.0, "of a purlin", "m")
    depth: float = between(1.0, 3.0, "length of a rafter", "m")
    rafter_size: float = between(0.12, 0.25, "height of a rafter", "m")
    rafter: str = among(("H", "I", "U", "RHS"), "section of the rafters")
    purlin_size: float = between(0.12, 0.25, "height of a purlin", "m")
    purlin: str = among(("Z", "C", "Z"), "section of the purlins")
    props: Props = nested(Props, "what a rafter lies on")
    count: int = whole(2, 4, "purlins")
    cleats: tuple[bool, ...] = several(yes(0.7), lambda p: p.count, "whether a purlin has cleats")

    def build(self, t: Table) -> Model:
        rafter, purlin = (
            section(self.rafter, self.rafter_size, t.style),
            section(self.purlin, self.purlin_size, t.style),
        )
        length, depth, top, deep = self.length, self.depth, self.props.top, span_of(rafter)[3]
        (_a, _b, low, high), ends = span_of(purlin), (0.15 * length, 0.85 * length)
        for x in ends:
            t.add("beam", bar((x, 0, top + deep), (x, depth, top + deep), rafter))
            self.props.build(t.at(x).spun("z", np.pi / 2), depth, 0.15)
        z, tall = top + 2 * deep, high - low
        for y, cleats in zip(np.linspace(0.15, depth - 0.15, self.count), self.cleats, strict=True):
            t.add("beam", bar((0, y, z - low), (length, y, z - low), purlin), of="clamp")
            for x in ends if cleats else ():
                t.add("bracket", box((0.08, 0.006, 0.8 * tall), (x, y - 0.006, z + 0.4 * tall)))
        return t.model()


def _web_lines(kind: str, length: float, h: float, bays: int) -> list[tuple[Floats, Floats]]:
    """The diagonals and posts of a truss between the chords at z = 0 and h."""
    xs = np.linspace(0, length, bays + 1)
    low = [np.array([x, 0, 0]) for x in xs]
    high = [np.array([x, 0, h]) for x in xs]
    if kind == "warren":
        middles = [np.array([(a + b) / 2, 0, h]) for a, b in zip(xs[:-1], xs[1:], strict=True)]
        return [line for k, m in enumerate(middles) for line in ((low[k], m), (m, low[k + 1]))]
    lines = [(low[k], high[k]) for k in range(1, bays)]
    lines += [
        (low[k], high[k + 1]) if (k < bays / 2) == (kind == "howe") else (high[k], low[k + 1]) for k in range(bays)
    ]
    return lines


class Lattice(Structure, name="beam/lattice", weight=1.2):
    """A lattice girder (Warren, Howe or Pratt) of angles, tees or tubes, with gusset plates or bare."""

    length: float = between(2.0, 6.0, "of the girder", "m")
    high: float = between(0.3, 0.9, "between the axes of its chords", "m")
    chord_size: float = between(0.06, 0.12, "height of a chord's section", "m")
    chord: str = among(("SHS", "CHS", "T", "L", "U"), "section of the chords")
    web_size: float = between(0.035, 0.055, "height of a diagonal's section", "m")
    web: str = among(("SHS", "CHS", "L", "flat", "round"), "section of the diagonals")
    layout: str = among(("warren", "howe", "pratt"), "of the diagonals")
    joined: bool = chance(0.3, "in one mesh")
    gussets: bool = chance(0.4, "with gusset plates")
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        length, h = self.length, self.high
        chord, web = section(self.chord, self.chord_size, t.style), section(self.web, self.web_size, t.style)
        lines = _web_lines(self.layout, length, h, int(np.clip(length / h, 3, 9)))
        up = t.at(0, 0, self.props.top).at(0, 0, span_of(chord)[3]).bundled("beam")
        chords = [bar((0, 0, 0), (length, 0, 0), chord, (0, 0, -1)), bar((0, 0, h), (length, 0, h), chord)]
        webs = [bar((x, 0, 0), (x, 0, h), web, (0, 1, 0)) for x in (0.04, length - 0.04)]
        webs += [bar(a, b, web, (0, 1, 0)) for a, b in lines]
        if self.joined:
            up.bundled("").add("beam", *chords, *webs)
        else:
            up.add_each("beam", chords)
            up.add_each("brace", webs)
        spots = {(round(float(p[0]), 4), float(p[2])) for line in lines for p in line} if self.gussets else ()
        for x, z in sorted(spots):
            g, s = 0.09, 1 if z == 0 else -1
            wide = [float(np.clip(x + k * g, 0.0, length)) for k in (-1.0, 1.0, 0.6, -0.6)]
            shape = list(zip(wide, (z, z, z + s * g, z + s * g), strict=True))
            up.add("gusset plate", slab_xz(shape if s > 0 else shape[::-1], 0.008), own=True)
        self.props.build(t, length, 0.12)
        return t.model()


class Pitched(Structure, name="beam/pitched truss", weight=0.7):
    """A pitched truss of timber or angles: bottom chord, rafters, king post and struts, with nail or gusset plates."""

    length: float = between(2.5, 6.0, "of the bottom chord", "m")
    timber: bool = chance(0.5, "of timber, not steel")
    pitch: float = between(0.15, 0.35, "height / length")
    steel: str = among(("L", "SHS", "T"), "section of steel chords", when=lambda p: not p.timber)
    second: bool = chance(0.5, "a second strut in each half")
    plated: bool = chance(0.7, "with plates at feet and ridge")
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        length, timber = self.length, self.timber
        chord = section("timber" if timber else self.steel, 0.12 if timber else 0.07, t.style)
        web = section("timber" if timber else "L", 0.09 if timber else 0.045, t.style)
        feet = (np.array([0.0, 0, 0]), np.array([length, 0, 0]))
        ridge, middle = np.array([length / 2, 0, length * self.pitch]), np.array([length / 2, 0, 0.0])
        chords = [(feet[0], feet[1]), (feet[0], ridge), (feet[1], ridge)]
        struts = [(middle, ridge)]
        for foot in feet:
            struts += [(middle, (foot + ridge) / 2), ((foot + middle) / 2, (foot + ridge) / 2)][: 1 + self.second]
        x0, x1, _y0, y1 = span_of(chord)
        up = t.at(0, 0, self.props.top).at(0, 0, y1).bundled("beam")
        for name, lines, one in (("beam", chords, chord), ("brace", struts, web)):
            up.add_each(name, [bar(a, b, one, (0, 0.01, 1)) for a, b in lines], of="safety" if timber else "steel")
        for p in (*feet, ridge) if self.plated else ():
            for y in (x0 - 0.002, x1 + 0.002):
                up.add("plate", box((0.22, 0.004, 0.14), (float(p[0]), y, float(p[2]) + 0.02)), of="clamp")
        self.props.build(t, length, 0.15)
        return t.model()


class Heavy(Structure, name="beam/concrete or timber", weight=0.8, grain="fitting"):
    """Concrete beams (rectangular, T, I with chamfers, L ledge) or sawn timbers, on props."""

    length: float = between(1.5, 5.0, "of the beam", "m")
    high: float = between(0.15, 0.6, "height of the beam", "m")
    form: str = among(("rectangle", "T", "I", "ledge", "timber"), "concrete of a section, or timber")
    props: Props = nested(Props, _ON)

    def build(self, t: Table) -> Model:
        h, b = self.high, 0.5 * self.high
        i_half = [(b, 0), (b, 0.2 * h), (0.3 * b, 0.35 * h), (0.3 * b, 0.75 * h), (1.2 * b, 0.85 * h), (1.2 * b, h)]
        shape = {
            "rectangle": rounded_rectangle(b, h, 0.015, 1) + np.array([0, h / 2]),
            "T": mirrored([(0.4 * b, 0), (0.5 * b, 0.7 * h), (b, 0.72 * h), (b, h)]),
            "I": mirrored(i_half),
            "ledge": np.array([(-b, 0), (b, 0), (b, 0.4 * h), (0.3 * b, 0.4 * h), (0.3 * b, h), (-b, h)]),
            "timber": rounded_rectangle(0.6 * h, h, 0.0) + np.array([0, h / 2]),
        }[self.form]
        solid = bar((0, 0, 0), (self.length, 0, 0), (shape, ()))
        t.at(0, 0, self.props.top).add("beam", solid, of="safety" if self.form == "timber" else "concrete")
        self.props.build(t, self.length, float(np.ptp(shape[:, 0])))
        return t.model()


def _on_rack(p: Any) -> bool:
    return bool(p.racked)


class Stack(Structure, name="beam/stack", weight=0.8, grain="fitting"):
    """A store of profiles: layers of beams or tubes between battens, or on the arms of a cantilever rack."""

    length: float = between(1.0, 5.0, "of a profile", "m")
    size: float = between(0.06, 0.2, "height of the section", "m")
    shape: str = among((*ROLLED, "L", "T", "C", "strut"), "section")
    columns: int = whole(2, 5, "profiles side by side")
    layers: int = whole(1, 3, "one above the other")
    racked: bool = chance(0.4, "on a cantilever rack, not between battens")
    batten: float = among((0.05, 0.08), "side of a batten", "m", when=lambda p: not p.racked)
    upright: str = among(("I", "H", "SHS"), "section of the rack's uprights", when=_on_rack)
    pitch: float = between(
        0.15, 0.4, "free height over the profiles on an arm", "m", when=lambda p: p.racked and p.layers > 1
    )
    shifts: tuple[float, ...] = several(
        number(-0.05, 0.05), lambda p: p.layers * p.columns, "how far a profile lies out of line", "m"
    )

    def build(self, t: Table) -> Model:
        length, one = self.length, section(self.shape, self.size, t.style)
        x0, x1, y0, y1 = span_of(one)
        wide = x1 - x0 + 0.003
        lows = self._rack(t, y1 - y0, wide) if self.racked else self._battens(t, y1 - y0, wide)
        for k, low in enumerate(lows):
            for j, x in enumerate(self.shifts[k * self.columns : (k + 1) * self.columns]):
                y = (j - (self.columns - 1) / 2) * wide - (x0 + x1) / 2
                t.add("beam", bar((x, y, low - y0), (length + x, y, low - y0), one))
        return t.model()

    def _battens(self, t: Table, tall: float, wide: float) -> list[float]:
        """Puts battens down under each layer; the heights of their tops [m]."""
        b, lows = self.batten, [k * (tall + self.batten) for k in range(self.layers)]
        for z in lows:
            for x in (0.15 * self.length, 0.85 * self.length):
                t.add("beam", box((b, self.columns * wide + 0.1, b), (x, 0, z + b / 2)), of="safety")
        return [z + b for z in lows]

    def _rack(self, t: Table, tall: float, wide: float) -> list[float]:
        """Puts uprights with feet, arms with stops and bracing down; the heights of the arms' tops [m]."""
        deep, arm, half = self.columns * wide + 0.06, 0.09, 0.09
        lows = [0.35 + k * (tall + self.pitch + arm) for k in range(self.layers)]
        back, top, front = -deep / 2 - half, lows[-1] + tall + 0.15, deep / 2
        shaft, thin = section(self.upright, 2 * half, t.style), section("I", arm, t.style)
        xs = [float(x) for x in np.linspace(0.12, 0.88, 2 if self.length < 3 else 3) * self.length]
        for x in xs:
            t.add("column", bar((x, back, 0), (x, back, top), shaft, (0, 1, 0)))
            t.add("beam", bar((x, -deep / 2, half), (x, front + 0.1, half), shaft))
            arms = [bar((x, -deep / 2, z - arm / 2), (x, front, z - arm / 2), thin) for z in lows]
            t.add_each("bracket", arms, of="steel")
            t.add_each("plate", [box((0.05, 0.01, arm + 0.06), (x, front + 0.005, z - arm / 2 + 0.03)) for z in lows])
        tie, side = section("SHS", 0.05, t.style), span_of(shaft)[1]
        for a, b in itertools.pairwise(xs):
            a, b = a + side, b - side
            t.add_each("brace", [bar((a, back, z), (b, back, z), tie) for z in (0.15, top - 0.1)])
        a, b = xs[0] + side, xs[1] - side
        for (z, up), y in zip(((0.2, top - 0.15), (top - 0.15, 0.2)), (back - 0.004, back + 0.004), strict=True):
            t.add("brace", flat((a, y, z), (b, y, up), 0.05, 0.006))
        return lows


class Cantilever(Structure, name="beam/cantilever", grain="fitting"):
    """A beam cantilevered from a wall or column by an end plate, with a knee brace, a hoist eye or a trolley."""

    reach: float = between(0.5, 2.5, "of the beam", "m")
    height: float = between(1.2, 2.8, "of the beam's middle", "m")
    size: float = between(0.08, 0.2, "height of the section", "m")
    shape: str = among(("H", "I", "IPN", "U", "SHS"), "section")
    wall: bool = chance(0.5, "on a wall, not a column")
    shaft: str = among(("H", "SHS"), "section of the column", when=lambda p: not p.wall)
    base: Base = nested(Base, "base plate", when=lambda p: not p.wall)
    braced: bool = chance(0.6, "with a knee brace")
    brace: str = among(("L", "SHS", "CHS", "flat"), "section of the brace", when=lambda p: p.braced)
    carries: str = among(
        lambda p: ("nothing", "eye", "trolley")[: 3 if p.shape in RUNWAYS else 2], "what hangs at its end"
    )

    def build(self, t: Table) -> Model:
        z, one = self.height, section(self.shape, self.size, t.style)
        x0, x1, y0, y1 = span_of(one)
        if self.wall:
            t.add("wall", box((0.2, 1.4, z + 0.8), (-0.1, 0, (z + 0.8) / 2)))
        else:
            low = self.base.build(t.at(-0.1), 0.32, 0.32)
            shaft = section(self.shaft, 0.2, t.style)
            t.add("column", bar((-0.1, 0, low), (-0.1, 0, z + 0.5), shaft, (1, 0, 0)))
        w, h = x1 - x0 + 0.08, y1 - y0 + 0.1
        here = t.at(0, (x0 + x1) / 2, z)
        here.add("plate", box((0.015, w, h), (0.0075, 0, 0)))
        spots = [at(0.015, sy * (w / 2 - 0.02), sz * (h / 2 - 0.025)) @ spun("y", np.pi / 2) for sy, sz in CORNERS]
        bolts(here, spots, 0.014, 0.015)
        t.add("beam", bar((0.015, 0, z), (self.reach, 0, z), one))
        if self.carries == "eye":
            t.at(self.reach - 0.1, 0, z + y0).spun("x", np.pi).add("lifting lug", lug(t.style, 0.07, 0.015), of="steel")
        elif self.carries == "trolley":
            t.add("plate", box((0.01, 2 * x1, y1 - y0 + 0.02), (self.reach + 0.005, 0, z)))
            trolley(t.at(self.reach - 0.7 * self.size, 0, z), self.size, self.shape)
        if self.braced:
            drop, knee = min(0.5 * self.reach, 0.8), section(self.brace, 0.06, t.style)
            t.add("brace", bar((0.0, 0, z + y0 - drop), (drop, 0, z + y0), knee))
        return t.model()


BEAMS = families_of(Rolled, Thin, Castellated, Girder, CraneRunway, Purlins, Lattice, Pitched, Heavy, Stack, Cantilever)
