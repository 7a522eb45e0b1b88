"""Clamps on lines: two-bolt, riser, strap, split ring, cushion, anchor, block, clip."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import one_of, yes
from cadplants.builder.params import Params, among, between, chance, nested, several
from cadplants.builder.table import Table
from cadplants.families.supports.shape import (
    Below,
    Fitting,
    Overhead,
    Standing,
    add_bolt,
    add_wall,
    arc_yz,
    few,
    hung,
    radius,
    slab_yz,
    standing,
    strap,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.solids.primitives import BOTH, along, bar, box, cylinder, hexagon, ring
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["CLAMPS", "add_halves", "half_band"]

_SMALL = sizes_between(most=100)
_HALF, _QUARTER = spun("x", np.pi), spun("x", np.pi / 2)


def half_band(inner: float, thick: float, wide: float, ear: float, style: ModelingStyle, gap: float = 0.004) -> Solid:
    """The upper half of a bent band round a line with two flat level ears, half a gap over the middle [m]."""
    middle = inner + thick / 2
    first = float(np.arcsin(min(0.5, (gap / 2 + thick / 2) / middle)))
    steps = max(6, few(inner, style, 32) // 2)
    bent = arc_yz(middle, first, np.pi - first, steps)
    z = float(bent[0][2])
    return strap(np.vstack([[[0, middle + ear, z]], bent, [[0, -middle - ear, z]]]), wide, thick)


def add_halves(t: Table, half: Solid, *names: str) -> None:
    """The upper half of a clamp and its like below, each with its name."""
    for name, pose in zip(names or ("clamp", "clamp"), (IDENTITY, _HALF), strict=True):
        t.add(name, moved(half, pose), of="clamp")


class _Band(Params):
    """The band of a clamp (DIN 3567, MSS SP-58)."""

    thick: float = among((0.003, 0.005, 0.006), "of the band; 4 mm more for thick lines", "m")
    wide: float = between(0.6, 1.4, "width of the band - 25 mm / quarter of the line's radius")
    ear: float = between(0, 0.02, "length of an ear - 2.6 bolts", "m")

    def sizes(self, r: float) -> tuple[float, float, float, float]:
        """Thickness, width, ears and bolt for a pipe of this radius [m]."""
        bolt = 0.006 if r < 0.02 else 0.01 if r < 0.06 else 0.016
        return self.thickness(r), 0.025 + 0.25 * r * self.wide, 2.6 * bolt + self.ear, bolt

    def thickness(self, r: float) -> float:
        """Of the band [m]."""
        return self.thick + (0.004 if r > 0.07 else 0.0)


class _Clamp(Standing, bundle="clamp", label="clamp"):
    """A clamp that holds a line."""


class _Banded(_Clamp):
    """A clamp with a band."""

    band: _Band = nested(_Band, "band")


class TwoBolt(_Banded, name="clamp/two-bolt"):
    """A two-bolt clamp whose halves stand left and right (MSS SP-58 type 4), its lower ears on a blade of a bracket."""

    blade: float = among((0.006, 0.008, 0.01), "thickness of the blade", "m")
    heads: tuple[str, ...] = several(one_of("hex", "flange"), 2, "heads of the bolts, lower first")
    drop: float = between(0.02, 0.1, "from the ears to the bracket's foot", "m")
    web: float = between(0.8, 1.3, "width of the blade / of the band")
    below: Below = standing(lambda p: TwoBolt.depth(p) + 0.01)

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the bracket's foot [m]."""
        r = radius(p)
        thick, _, ear, _ = p.band.sizes(r)
        return r + thick + ear + p.drop  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, blade, foot = t.pipe.radius, self.blade, -self.depth(self)
        thick, wide, ear, d = self.band.sizes(r)
        lying = t.moved(_QUARTER)
        add_halves(lying, half_band(r, thick, wide, ear, t.style, blade))
        for s, head in zip(BOTH, self.heads, strict=True):
            z = s * (r + thick + 0.6 * ear)
            add_bolt(t.at(0, blade / 2 + thick, z).moved(_QUARTER), d, blade + 2 * thick, head)
        top = -r - thick - 0.1 * ear
        t.add("bracket", box((wide * self.web, blade, top - foot), (0, 0, (foot + top) / 2)), own=False)
        t.add("plate", box((0.1 + 0.3 * r, 0.08 + 0.5 * r, 0.01), (0, 0, foot - 0.005)))
        self.below.build(t, foot - 0.01, 0.04 + 0.25 * r)
        return t.model()


class Riser(Fitting, name="clamp/riser", bundle="clamp", label="clamp", sizes=SIZES, grain="structure"):
    """A riser clamp (MSS SP-58 type 8): two halves with long ears on a slab or on beams, round a riser."""

    band: _Band = nested(_Band, "band", fixed=lambda _: {"ear": 0.0})
    ear: float = between(0.08, 0.2, "length of an ear - radius of the line", "m")
    level: float = between(0.5, 1.2, "height of what the clamp lies on", "m")
    high: float = between(1.5, 2.2, "height of the line's end", "m")
    second: tuple[bool, ...] = several(yes(0.3), 2, "a second bolt through the ears on either side")
    slab: bool = chance(0.5, "on a slab, not on beams")
    deep: float = between(0.1, 0.2, "thickness of the slab", "m", when=lambda p: p.slab)
    taken: str = among(("platform", "foundation"), "what the slab is taken for", when=lambda p: p.slab)
    sleeve: bool = chance(0.6, "a sleeve through the slab", when=lambda p: p.slab)
    size: float = among((0.08, 0.1, 0.14), "height of the beams", "m", when=lambda p: not p.slab)

    def build(self, t: Table) -> Model:
        r, n, level = t.pipe.radius, t.n(t.pipe.radius), self.level
        (thick, wide, _, d), ear = self.band.sizes(r), r + self.ear
        clamp = t.at(0, 0, level + wide / 2).spun("y", np.pi / 2)
        add_halves(clamp, half_band(r, thick, wide, ear, t.style, 0.008))
        for s, second in zip(BOTH, self.second, strict=True):
            for share in (0.15, 0.5) if second else (0.15,):
                y = s * (r + thick + 1.2 * d + share * ear)
                add_bolt(clamp.at(0, y, -0.004 - thick), d, 0.008 + 2 * thick)
        t.add("pipe", ring(t.pipe.bore if t.style.hollow else 0.0, r, 0.0, self.high, n))
        if self.slab:
            side = 2 * (r + ear) + 0.3
            slab = extrude(rounded_rectangle(side, side, 0), level - self.deep, level, (circle(r + 0.03, n),))
            t.add(self.taken, slab, of="concrete")
            if self.sleeve:
                t.add("pipe", ring(r + 0.02, r + 0.028, level - self.deep, level, n))
            return t.model()
        size, span, y = self.size, 0.5 + r, r + thick + 0.7 * ear
        outline, z = section_i(size, 0.5 * size, 0.006, 0.008), level - size / 2
        post = extrude(rounded_rectangle(0.06, 0.06, 0.004, 1), 0, level - size)
        for s in BOTH:
            t.add("beam", bar((-span, s * y, z), (span, s * y, z), outline))
            for x in BOTH:
                t.at(x * (span - 0.03), s * y).add("post", post)
        return t.model()


class Strap(_Banded, name="clamp/strap"):
    """A one-hole or two-hole strap over the line (MSS SP-58 type 26) on a wall, a plate, a post or a beam."""

    one: bool = chance(0.4, "with one hole")
    head: str = among(("none", "carriage", "hex"), "heads of the bolts")
    mold: bool = chance(0.3, "a pad beside the line")
    on: str = among(("wall", "plate", "steel"), "what it is screwed on")
    wall: float = between(0.1, 0.3, "thickness of the wall", "m", when=lambda p: p.on == "wall")
    over: float = between(0.2, 0.8, "height of the wall over the strap", "m", when=lambda p: p.on == "wall")
    long: float = between(0.6, 1.5, "length of the wall", "m", when=lambda p: p.on == "wall")
    below: Below = standing(lambda p: radius(p) + (0.01 if p.on == "plate" else 0.0), when=lambda p: p.on != "wall")

    def build(self, t: Table) -> Model:
        r, on_wall = t.pipe.radius, self.on == "wall"
        thick, wide, ear, d = self.band.sizes(r)
        thick, own = 0.5 * thick, t.moved(_QUARTER) if on_wall else t
        middle, floor = r + thick / 2, -r + thick / 2
        half, steps = middle + ear, max(6, few(r, t.style, 32) // 2)
        left = [[0, -middle, floor * 0.2]] if self.one else [[0, -middle, floor], [0, -half, floor]]
        path = np.vstack([[[0, half, floor], [0, middle, floor]], arc_yz(middle, 0, np.pi, steps), left])
        own.add("clamp", strap(path, wide, thick))
        for s in (1,) if self.one else (1, -1):
            add_bolt(own.at(0, s * (middle + 0.55 * ear), -r), min(d, 0.01), thick, self.head)
        if self.mold:
            own.add("clamp", box((wide, 0.004, 0.3 * r), (0, middle + 0.002, -0.5 * r)))
        if on_wall:
            add_wall(t, self.long, self.wall, r, -self.height, half + self.over)
            return t.model()
        deep = 0.01 if self.on == "plate" else 0.0
        if deep:
            t.add("plate", box((wide + 0.05, 2 * half + 0.02, deep), (0, 0, -r - deep / 2)))
        self.below.build(t, -r - deep, half)
        return t.model()


class SplitRing(_Clamp, name="clamp/split ring"):
    """A ring in two halves with a threaded boss on a stud, rubber lined or bare, off a flange plate on wall or post."""

    lined: bool = chance(0.6, "lined with rubber")
    pad: float = between(0.003, 0.007, "thickness of the lining", "m", when=lambda p: p.lined)
    thick: float = between(0, 0.001, "thickness of the ring over the usual one", "m")
    lips: bool = chance(0.6, "the lining reaches over the edges", when=lambda p: p.lined)
    heads: tuple[str, ...] = several(one_of("socket", "none", "hex"), 2, "heads of the bolts")
    hexagonal: bool = chance(0.5, "the boss is hexagonal")
    reach: float = between(0.03, 0.25, "length of the stud", "m")
    round: bool = chance(0.5, "the flange plate is round")
    taken: str = among(("bracket", "clamp"), "what the flange plate is taken for")
    wall: bool = chance(0.5, "off a wall")
    high: bool = chance(0.4, "hangs from above", when=lambda p: not p.wall)
    over: Overhead = hung(0.05, when=lambda p: p.high)
    below: Below = standing(lambda p: SplitRing.depth(p), when=lambda p: not p.wall and not p.high)

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the back of the flange plate [m]."""
        return 1.012 * radius(p) + p.pad + 0.0015 + p.thick + p.reach + 0.005  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, low = t.pipe.radius, -self.depth(self)
        inner, thick, wide = r + self.pad, 0.0015 + 0.012 * r + self.thick, 0.02 + 0.1 * r
        ear, base, reach = 0.014 + 0.05 * r, -inner - thick, low + 0.005
        own = t.moved(_QUARTER if self.wall else _HALF) if self.wall or self.high else t
        add_halves(own, half_band(inner, thick, wide, ear, t.style, 0.006))
        if self.lined:
            n, rim = t.n(r), 0.55 * wide
            solids = [ring(r, inner, -0.5 * wide, 0.5 * wide, n)]
            if self.lips:
                solids += [ring(r, inner + 0.7 * thick, s * rim - 0.0015, s * rim + 0.0015, n) for s in BOTH]
            own.along("x").add("clamp", *solids, of="rubber")
        for s, head in zip(BOTH, self.heads, strict=True):
            spot = own.at(0, s * (inner + thick + 0.55 * ear), -0.003 - thick)
            add_bolt(spot, 0.005 + 0.02 * r, 0.006 + 2 * thick, head)
        boss = hexagon(0.016 + 0.04 * r, base - 0.014, base + 0.001)
        if not self.hexagonal:
            boss = cylinder(0.008 + 0.02 * r, base - 0.014, base + 0.001, 10)
        own.add("nut", boss, fine=False)
        own.add("stud", cylinder(0.004 + 0.012 * r, reach, base - 0.002, few(0.006, t.style)), fine=False)
        flange = extrude(circle(0.03 + 0.05 * r, 16), low, reach)
        own.add(self.taken, flange if self.round else box((0.03, 0.09, 0.005), (0, 0, reach - 0.0025)), of="steel")
        for s in BOTH:
            add_bolt(own.at(0, s * 0.024, low), 0.006, 0.005, "none")
        if self.wall:
            add_wall(t, 0.7, 0.15, -low, -self.height, 0.6)
        elif self.high:
            self.over.build(t, -low)
        else:
            self.below.build(t, low, 0.06)
        return t.model()


class Cushion(_Clamp, name="clamp/cushion"):
    """A cushion clamp on a strut (41 mm channel): two shells hooked into its slot, one screw on top, an insert."""

    pad: float = among((0.0, 0.003, 0.005), "thickness of the insert", "m")
    head: str = among(("hex", "socket", "carriage"), "head of the screw")
    reach: float = between(0, 0.3, "how far the strut reaches past the clamp and 80 mm", "m")
    wall: bool = chance(0.35, "the strut is on a wall")
    below: Below = standing(lambda p: 1.01 * radius(p) + p.pad + 0.0055 + 0.041, when=lambda p: not p.wall)

    def build(self, t: Table) -> Model:
        r, wide, gap, s = t.pipe.radius, 0.032, 0.008, 0.041
        inner, thick, lug = r + self.pad, 0.0025 + 0.01 * r, 0.022 + 0.04 * r
        own = t.moved(_QUARTER) if self.wall else t
        middle, steps = inner + thick / 2, max(6, few(r, t.style, 28) // 2)
        lean = float(np.arcsin(min(0.6, (gap / 2 + thick / 2) / middle)))
        bent = arc_yz(middle, -np.pi / 2 + lean, np.pi / 2 - lean, steps)
        y = float(bent[-1][1])
        shell = strap(np.vstack([[[0, y, -inner - 0.016]], bent, [[0, y, inner + lug]]]), wide, thick)
        for k, pose in ((1, IDENTITY), (-1, spun("z", np.pi))):
            own.add("clamp", moved(shell, pose), box((wide, 0.012, 0.004), (0, k * (y + 0.005), -inner - 0.014)))
        hole = own.at(0, y + thick / 2, inner + 0.6 * lug).moved(_QUARTER)
        add_bolt(hole, 0.006 + 0.02 * r, 2 * y + thick, self.head)
        if self.pad:
            own.add("clamp", along("x", ring(r, inner, -0.6 * wide, 0.6 * wide, t.n(r))), of="rubber")
        top, reach = -inner - thick - 0.003, inner + 0.08 + self.reach
        c = section_channel(s, s, 0.0025, 0.0025) @ np.array([[0.0, 1.0], [-1.0, 0.0]]) - np.array([0.0, s])
        lips = [box((0.009, 2 * reach, 0.0025), (q * 0.016, 0, top - 0.00125)) for q in BOTH]
        own.add("beam", bar((0, -reach, top), (0, reach, top), c), *lips, of="clamp")
        if self.wall:
            add_wall(t, 0.8, 0.15, s - top, -self.height, 0.6 + reach)
        else:
            self.below.build(t, top - s, reach - 0.05)
        return t.model()


class Anchor(_Banded, name="clamp/anchor", sizes=SIZES[4:]):
    """A heavy fixed point: a wide clamp with four bolts or six on a welded chair with ribs (DIN 3567, EN 13480-3)."""

    band: _Band = nested(_Band, "band", fixed=lambda _: {"wide": 1.0})
    four: bool = chance(0.7, "four bolts, not six")
    heads: tuple[str, ...] = several(one_of("hex", "stud"), lambda p: 4 if p.four else 6, "heads of the bolts")
    drop: float = between(0.05, 0.15, "from the clamp to the chair's foot", "m")
    below: Below = standing(lambda p: Anchor.depth(p) + 0.012)

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the chair's foot [m]."""
        return radius(p) + 1.3 * p.band.thickness(radius(p)) + p.drop  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, wall, foot = t.pipe.radius, 0.008, -self.depth(self)
        thick, _, ear, d = self.band.sizes(r)
        thick, ear, length = 1.3 * thick, 1.1 * ear, 0.09 + 0.7 * r
        add_halves(t, half_band(r, thick, length, ear, t.style, 0.006))
        spots = [
            (x * length, s * (r + thick + 0.55 * ear))
            for x in ((-0.36, 0.36) if self.four else (-0.38, 0.0, 0.38))
            for s in BOTH
        ]
        for (x, y), head in zip(spots, self.heads, strict=True):
            add_bolt(t.at(x, y, -0.003 - thick), d, 0.006 + 2 * thick, head)
        inset, top = r * 0.72, -r - thick + 0.002
        webs = [box((length, wall, -0.69 * r - foot), (0, s * inset, (foot - 0.69 * r) / 2)) for s in BOTH]
        across = [box((wall, 2 * inset, top - foot), (x * length, 0, (foot + top) / 2)) for x in (-0.3, 0.3)]
        t.add("bracket", *webs, *across, own=False)
        t.add("base plate", box((length + 0.04, 2 * r + 0.1, 0.012), (0, 0, foot - 0.006)))
        self.below.build(t, foot - 0.012, r + 0.05)
        return t.model()


class Block(_Clamp, name="clamp/block", sizes=_SMALL):
    """A block clamp (DIN 3015): two plastic halves, cover plate, two bolts, weld plate; single or twin."""

    twin: bool = chance(0.3, "for two lines", when=lambda p: radius(p) < 0.03)
    covered: bool = chance(0.75, "a cover plate")
    plain: tuple[bool, ...] = several(yes(0.6), lambda p: 1 if p.twin else 2, "hexagon heads on the bolts")
    sole: float = between(0, 0.04, "length of the weld plate over the block", "m")
    below: Below = standing(lambda p: Block.high(p) + 0.006)

    @staticmethod
    def high(p: Any) -> float:
        """Height of a half [m]."""
        return 1.15 * radius(p) + 0.006

    def build(self, t: Table) -> Model:
        r, high, twin = t.pipe.radius, self.high(self), self.twin
        wide, (d, plate) = 0.03 if r < 0.03 else 0.045 + 0.2 * r, (0.006, 0.004) if r < 0.04 else (0.01, 0.008)
        reach = 1.25 * r + 0.012 + 1.6 * d
        step, a = 2 * reach + 0.004, np.linspace(0, np.pi, max(6, few(r, t.style, 28) // 2) + 1)[::-1]
        bore, y1 = (r + 0.0003) * np.column_stack([np.cos(a), np.sin(a)]), reach + (step if twin else 0.0)
        outline = [[-reach, 0.0008], *bore, *(bore + np.array([step, 0.0]) if twin else ()), [y1, 0.0008]]
        outline += [[y1, 0.8 * high], [y1 - 0.2 * high, high], [-reach + 0.2 * high, high], [-reach, 0.8 * high]]
        body = slab_yz(outline, -wide / 2, wide / 2)
        for pose in (IDENTITY, np.diag([1.0, 1, -1, 1])):
            t.add("clamp", moved(body, pose), of="electrical")
        middle, long, grip = (y1 - reach) / 2, y1 + reach, 2 * high + (plate if self.covered else 0.0)
        if self.covered:
            t.add("clamp", box((wide, long - 0.4 * high, plate), (0, middle, high + plate / 2)), of="steel")
        for y, plain in zip((step / 2,) if twin else (-reach + 1.3 * d, y1 - 1.3 * d), self.plain, strict=True):
            add_bolt(t.at(0, y, -high), d, grip, "none" if plain else "socket", ("bolt", "screw"))
        if twin:
            t.add("pipe", along("x", ring(t.pipe.bore if t.style.hollow else 0.0, r, -0.2, 0.2, t.n(r)), 0, step))
        t.add("plate", box((wide + 0.004, long + self.sole, 0.006), (0, middle, -high - 0.003)))
        self.below.build(t, -high - 0.006, y1)
        return t.model()


class Clip(_Clamp, name="clamp/clip", sizes=_SMALL):
    """A plastic snap clip, open on top or with a hinged strap, screwed on a wall or a rail."""

    open: float = between(0.15, 0.3, "half the angle that is open / half a turn")
    closed: bool = chance(0.4, "closed by a strap")
    drop: float = between(0.004, 0.02, "from the ring to the wall or rail", "m")
    beads: bool = chance(0.5, "beads along the edges")
    wall: bool = chance(0.5, "on a wall")
    below: Below = standing(lambda p: Clip.depth(p), when=lambda p: not p.wall)

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the wall or rail [m]."""
        return 1.04 * radius(p) + 0.0025 + p.drop  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, gap, base = t.pipe.radius, self.open * np.pi, -self.depth(self)
        thick, wide, own = 0.0025 + 0.04 * r, 0.016 + 0.2 * r, t.moved(_QUARTER) if self.wall else t
        a = np.linspace(np.pi / 2 + gap, 2.5 * np.pi - gap, max(12, few(r, t.style, 28)))
        unit = np.column_stack([np.cos(a), np.sin(a)])
        top = -r - 0.3 * thick
        solids = [slab_yz([*(r + thick) * unit, *r * unit[::-1]], -wide / 2, wide / 2)]
        solids.append(box((wide, 1.3 * r + 0.012, top - base), (0, 0, (base + top) / 2)))
        if self.beads:
            bead, rim = along("x", cylinder(0.9 * thick, -wide / 2, wide / 2, 8)), r + 0.5 * thick
            solids += [moved(bead, at(0, s * rim * np.sin(gap), rim * np.cos(gap))) for s in BOTH]
        own.add("clamp", *solids, of="rubber")
        if self.closed:
            over = arc_yz(r + thick, np.pi / 2 - gap - 0.25, np.pi / 2 + gap + 0.25, 6)
            own.add("clamp", strap(over, wide, 0.8 * thick), of="rubber")
        add_bolt(own.at(0, 0, base), 0.005, 0.003, "none")
        if self.wall:
            add_wall(t, 0.5, 0.12, -base, -self.height, 0.5)
        else:
            self.below.build(t, base, r + 0.03)
        return t.model()


CLAMPS = families_of(TwoBolt, Riser, Strap, SplitRing, Cushion, Anchor, Block, Clip)
