"""What carries a line from below or from the side: stanchions, chairs, shoes, dummy legs, knees, ribbed brackets."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import Params, among, between, chance, nested, several
from cadplants.builder.table import Table, outline
from cadplants.families.supports.hanger import roller
from cadplants.families.supports.shape import (
    Below,
    Footing,
    Section,
    Standing,
    add_bolt,
    add_nuts,
    add_wall,
    arc_yz,
    few,
    foot_of,
    piecemeal,
    radius,
    section_of,
    slab_yz,
    standing,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import Solid, extrude
from cadplants.solids.polygon import section_i
from cadplants.solids.primitives import BOTH, CORNERS, bar, box, cylinder, hexagon, ring, rope, turned
from cadplants.solids.transforms import spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["STANDS", "Bracket", "Tie"]

_B = "bracket"
_QUARTER = spun("x", np.pi / 2)


def _cradle(r: float, thick: float, length: float, half_angle: float, style: ModelingStyle) -> Solid:
    """A bent plate under a line, this far round on either side [m, rad]."""
    steps = max(5, few(r, style, 24) // 3)
    a = np.linspace(1.5 * np.pi - half_angle, 1.5 * np.pi + half_angle, steps + 1)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    return slab_yz(np.vstack([(r + thick) * unit, (r * unit)[::-1]]), -length / 2, length / 2)


class Tie(Params):
    """What ties a line down on a level plate under it: a U-bolt, a strap, nothing."""

    form: str = among(("none", "u-bolt", "u-bolt", "strap"), "what ties the line down")

    def build(self, t: Table, grip: float) -> None:
        """Puts it down, through a plate of this thickness [m]."""
        r, t = t.pipe.radius, t.bundled("")
        if self.form == "u-bolt":
            d = 0.006 if r < 0.02 else 0.01 if r < 0.06 else 0.016
            _add_bow(t, d, -r - grip - 2.2 * d)
            add_nuts(t, [(0, s * (r + d / 2), -r - grip) for s in BOTH], d)
        elif self.form == "strap":
            thick, ear = 0.003 + 0.01 * r, 0.03
            middle, floor = r + thick / 2, -r + thick / 2
            ends = np.array([[0, middle + ear, floor], [0, middle, floor]])
            path = np.vstack([ends, arc_yz(middle, 0, np.pi, 10), (ends * (1, -1, 1))[::-1]])
            t.add("clamp", strap(path, 0.03 + 0.1 * r, thick))
            for s in BOTH:
                add_bolt(t.at(0, s * (middle + 0.6 * ear), -r), 0.008, thick, "none")


def _add_bow(t: Table, d: float, foot: float) -> None:
    """A U-bolt over the line with legs down to ``foot`` [m]."""
    leg = t.pipe.radius + d / 2
    path = np.vstack([[[0, leg, foot]], arc_yz(leg, 0, np.pi, 10), [[0, -leg, foot]]])
    t.add("u-bolt", rope(path, d / 2, few(d / 2, t.style)))


class Bracket(Standing, bundle=_B, label=_B):
    """What carries a line."""


class Stanchion(Bracket, name="bracket/stanchion"):
    """An adjustable pipe saddle (MSS SP-58 types 36 to 38): cradle, screw with nut, reducer, stanchion."""

    long: float = between(0.5, 1.2, "length of the cradle / the usual one")
    open: float = between(0.25, 0.5, "how far the cradle goes round on either side / half a turn")
    bolted: bool = chance(0.5, "a U-bolt over the line")
    foot: Footing = foot_of()
    share: float = between(0.4, 0.75, "height of the stanchion / of the line's underside")
    neck: float = between(0.02, 0.06, "height of the reducer", "m")

    def build(self, t: Table) -> Model:
        r, n, low = t.pipe.radius, t.n(t.pipe.radius), -self.height
        thick, length, stud, shaft = 0.005 + 0.02 * r, 0.05 + 0.9 * r * self.long, 0.010 + 0.1 * r, 0.022 + 0.2 * r
        t.add(_B, _cradle(r, thick, length, self.open * np.pi, t.style), of="clamp")
        under = -r - thick - 2.2 * stud
        socket = outline(1.1 * stud, under, 1.9 * stud, under, 2.0 * stud, -r - 0.4 * thick)
        t.add(_B, turned(socket, few(stud, t.style)), of="clamp")
        if self.bolted:
            d, ends = 0.008 if r < 0.06 else 0.012, -0.55 * r
            leg = r + d / 2
            _add_bow(t, d, ends - 2 * d)
            lugs = [box((2.6 * d, 2.8 * d, 0.006), (0, s * (leg + 0.1 * d), ends - 0.003)) for s in BOTH]
            t.add(_B, *lugs, of="clamp")
            add_nuts(t, [(0, s * leg, ends - 0.006) for s in BOTH], d, False)
        top = low + self.foot.top
        head = top + max(0.05, (self.height - r - thick) * self.share)
        neck = min(head + self.neck, under)
        t.add("stud", cylinder(stud, head - 0.03, -r - thick - 1.5 * stud, few(stud, t.style)), fine=False)
        t.add("nut", hexagon(3.3 * stud, neck, neck + 1.2 * stud), fine=False)
        t.add("post", ring(0.85 * shaft if t.style.hollow else 0.0, shaft, top, head, n))
        rim, wide = head - 0.3 * shaft, 1.25 * shaft
        t.add(_B, turned(outline(shaft, rim, wide, rim, wide, head, 1.5 * stud, neck), n), of="clamp")
        self.foot.build(t.at(0, 0, low), 3.2 * shaft + 0.08, 2 * shaft)
        return t.model()


class RollerChair(Bracket, name="bracket/roller chair", sizes=SIZES[4:]):
    """A roller chair (MSS SP-58 types 44 to 46): cheeks with an axle and one roll or two, on a plate or on studs."""

    two: bool = chance(0.35, "two plain rolls, not an hourglass")
    gap: float = among((0.0, 0.03, 0.06), "under its plate, on studs", "m")
    below: Below = standing(lambda p: RollerChair.depth(p) + 0.008 + p.gap + (0.01 if p.gap else 0.0))

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the foot of the cheeks [m]."""
        r = radius(p)
        waist = 0.014 + 0.2 * r
        depth = (r + waist) * np.sqrt(0.5) + 1.5 * waist if p.two else r + 2.3 * waist + 0.25 * r
        return float(depth)

    def build(self, t: Table) -> Model:
        r, floor, thick = t.pipe.radius, -self.depth(self), 0.008
        side, deep = self._rolls(t, r, floor) if self.two else self._roll(t, r, floor)
        t.add(_B, box((deep + 0.02, side + 0.08, thick), (0, 0, floor - thick / 2)))
        low = floor - thick - self.gap
        for x, y in [(sx * 0.35 * deep, sy * (side / 2 + 0.02)) for sx, sy in CORNERS]:
            if self.gap:
                t.at(x, y).add("stud", cylinder(0.006, low - 0.01, floor + 0.015, 8), fine=False)
                add_nuts(t, [(x, y, floor - thick)], 0.012, False)
                add_nuts(t.spun("y", np.pi), [(-x, y, -floor)], 0.012, False)
            else:
                add_bolt(t.at(x, y, floor - thick), 0.01, thick, "none")
        if self.gap:
            t.add("base plate", box((deep + 0.04, side + 0.1, 0.01), (0, 0, low - 0.005)))
            low -= 0.01
        self.below.build(t, low, side / 2 + 0.05)
        return t.model()

    def _rolls(self, t: Table, r: float, floor: float) -> tuple[float, float]:
        """Two plain rolls at 45 degrees to the upright; how wide and how long they are with their cheeks [m]."""
        waist, cheek = 0.014 + 0.2 * r, 0.006 + 0.02 * r
        q = float((r + waist) * np.sqrt(0.5))
        half, out = 1.25 * waist, 1.1 * waist
        for s in BOTH:
            lying = t.at(0, s * q, -q).along("x")
            lying.add(_B, cylinder(waist, -half, half, t.n(waist)), of="trim")
            lying.add("bolt", cylinder(0.3 * waist, -half - cheek - 0.006, half + cheek + 0.006, 8))
        top = -q + 0.4 * waist
        right = outline(q + out, floor, q + waist, top, q - waist, top)
        dip = (0, max(-r - 0.6 * waist, floor) - 0.2 * waist)
        side = [(-q - out, floor), *right, dip, (-q + waist, top), (-q - waist, top)]
        for x in (-half - cheek, half):
            t.add(_B, slab_yz(side, x, x + cheek))
        return 2 * (q + out), 2 * (half + cheek)

    def _roll(self, t: Table, r: float, floor: float) -> tuple[float, float]:
        """An hourglass on an axle; how wide and how long it is with its cheeks [m]."""
        waist, half, cheek = 0.014 + 0.2 * r, 0.75 * r + 0.006, 0.006 + 0.02 * r
        wide, z, out = 1.5 * waist + 0.02, -r - waist, half + 0.003
        axle = t.at(0, 0, z)
        axle.add(_B, roller(half, r, waist, t.style), of="trim")
        axle.along("y").add("bolt", cylinder(0.35 * waist, -out - cheek - 0.008, out + cheek + 0.008, 8))
        ear = outline(-wide, floor, wide, floor, 0.5 * wide, z + 0.5 * wide, -0.5 * wide, z + 0.5 * wide)
        for y in (-out - cheek, out):
            t.add(_B, upright(ear, y, y + cheek))
        return 2 * (out + cheek), 2 * wide


class GuidedShoe(Bracket, name="bracket/guided shoe"):
    """A shoe of a split beam, a box or an H on a slide plate between guide angles with hold-down lips (EN 13480-3)."""

    form: str = among(("tee", "box", "H"), "how the shoe is made")
    ribbed: bool = chance(0.5, "gussets", when=lambda p: p.form == "tee")
    slide: float = among((0.0, 0.003, 0.006), "thickness of the slide plate", "m")
    lips: bool = chance(0.6, "the guides hold it down")
    reach: float = between(0.3, 1.0, "length of the guides / 0.6 of the shoe")
    bolted: tuple[bool, ...] = several(yes(0.5), 2, "whether the guide is bolted on, on either side")
    below: Below = standing(lambda p: 1.35 * radius(p) + 0.06 + p.slide + 0.012)

    def build(self, t: Table) -> Model:
        r, thick, plate = t.pipe.radius, 0.008, 0.012
        tall, length, half = 0.06 + 0.35 * r, 0.15 + 0.7 * r, 0.035 + 0.55 * r
        top, base, side = -r - tall, -r - tall - self.slide, 2 * half + 0.2
        t.add(_B, *self._shoe(t, r, top, length, half))
        for x in (-0.4 * length, 0.4 * length) if self.ribbed else ():
            for s in BOTH:
                rib = outline(s * thick / 2, top + thick, s * 0.9 * half, top + thick, s * thick / 2, -r - 0.002)
                t.add("gusset plate", slab_yz(rib, x - 0.004, x + 0.004))
        if self.slide:
            t.add("plate", box((0.7 * length, 2.2 * half, self.slide), (0, 0, top - self.slide / 2)), of="rubber")
        t.add("plate", box((0.8 * length, side, plate), (0, 0, base - plate / 2)))
        reach, high = 0.6 * length * self.reach, self.slide + thick + 0.012
        for s, bolted in zip(BOTH, self.bolted, strict=True):
            y = s * (half + 0.003)
            guide = [box((reach, 0.008, high), (0, y + s * 0.004, base + high / 2))]
            guide.append(box((reach, 0.05, 0.008), (0, y + s * 0.03, base + 0.004)))
            if self.lips:
                guide.append(box((reach, 0.03, 0.008), (0, y - s * 0.007, base + self.slide + thick + 0.008)))
            t.add(_B, *guide)
            if bolted:
                add_bolt(t.at(0, y + s * 0.035, base - plate), 0.01, 0.008 + plate)
        self.below.build(t, base - plate, side / 2)
        return t.model()

    def _shoe(self, t: Table, r: float, top: float, length: float, half: float) -> list[Solid]:
        thick, tall = 0.008, -r - top
        sole = box((length, 2 * half, thick), (0, 0, top + thick / 2))
        if self.form == "tee":  # out of half a beam
            return [box((length, thick, tall + 0.004), (0, 0, top + tall / 2 + 0.002)), sole]
        if self.form == "box":  # two webs
            z = -0.8 * r
            return [*(box((length, thick, z - top), (0, s * 0.62 * r, (z + top) / 2)) for s in BOTH), sole]
        z = top + (tall - 0.005) / 2  # with a bent pad
        web = bar((-length / 2, 0, z), (length / 2, 0, z), section_i(tall - 0.005, 2 * half, 0.006, thick))
        return [web, _cradle(r, 0.006, length + 0.03, 0.3 * np.pi, t.style)]


class DummyLeg(Bracket, name="bracket/dummy leg", sizes=SIZES[3:]):
    """A dummy leg: a stub of pipe or profile welded under the line, with a pad or ribs."""

    wide: float = between(0.55, 0.85, "radius of the leg / of the line")
    foot: Footing = foot_of()
    round: bool = chance(0.7, "the leg is a pipe")
    taken: str = among(("post", "post", "column"), "what the leg is taken for")
    padded: bool = chance(0.5, "a pad between the line and the leg", when=piecemeal, otherwise=True)
    pad: str = among((_B, "clamp"), "what the pad is taken for", when=lambda p: p.padded)
    ribbed: bool = chance(0.4, "ribs on the foot")

    def build(self, t: Table) -> Model:
        r, low = t.pipe.radius, -self.height + self.foot.top
        leg = r * self.wide
        if self.round:
            up = -np.sqrt(r * r - leg * leg) * 0.98 - 0.002
            stub = ring(0.88 * leg if t.style.hollow else 0.0, leg, low, up, t.n(leg))
        else:
            stub = extrude(section_i(1.5 * leg, 1.5 * leg, 0.1 * leg, 0.14 * leg), low, -r + 0.004)
        t.add(self.taken, stub)
        self.foot.build(t.at(0, 0, -self.height), 2 * leg + 0.1, 2 * leg)
        if self.padded:
            t.add(self.pad, _cradle(r, 0.005, 2.4 * leg + 0.03, 0.33 * np.pi, t.style), of="steel", own=False)
        if self.ribbed:
            rib = upright(outline(leg * 0.98, low, leg + 0.04, low, leg * 0.98, low + 0.09), -0.004, 0.004)
            for k in range(4):
                t.spun("z", k * np.pi / 2).add("gusset plate", rib, own=False)
        return t.model()


class Knee(Bracket, name="bracket/knee"):
    """A cantilever off a column with a knee brace or a web, end plates bolted on the flange."""

    size: float = among((0.06, 0.08, 0.1), "height of the arm", "m")
    reach: float = between(0.12, 0.4, "from the line's side to the column", "m")
    section: Section = section_of("section of the arm", flat=True)
    bracket: bool = chance(0.6, "the arm is taken for a bracket, not a beam", when=piecemeal, otherwise=True)
    tall: float = between(0.15, 0.35, "height of the brace or web, where there is room, - radius of the line", "m")
    webbed: bool = chance(0.35, "a web, not a brace")
    cut: str = among(("straight", "clipped", "curved"), "edge of the web", when=lambda p: p.webbed)
    brace: Section = section_of("section of the brace", when=lambda p: not p.webbed)
    short: bool = chance(0.5, "the end plate is at the arm only")
    rise: float = between(0.1, 0.6, "height of the column over the line's axis", "m")
    tie: Tie = nested(Tie, "tie")

    def build(self, t: Table) -> Model:
        r, size, thick, wide, depth = t.pipe.radius, self.size, 0.01, 0.13, 0.14
        reach, under = r + self.reach, -r - size
        section, z = self.section.outline(size, t.style), -r - size / 2
        t.add(_B if self.bracket else "beam", bar((0, -r - 0.06, z), (0, reach, z), *section))
        tall = max(0.08, min(self.tall + r, self.height - r - size - 0.06))
        low = under - tall
        if self.webbed:
            deep = min(0.9 * (reach + r), tall * 1.2)
            tip, toe, a = (reach - deep, under), (reach, low), np.linspace(0, np.pi / 2, 7)
            edge = {
                "straight": [tip, toe],
                "clipped": [tip, (reach - deep, under - 0.02), (reach - 0.02, low), toe],
                "curved": [(reach - deep * np.sin(q), low + tall * (1 - np.cos(q))) for q in a],
            }[self.cut]
            t.add("gusset plate", slab_yz([*edge, (reach, under)], -0.005, 0.005))
        else:
            start, end = (0.0, reach + thick, low + 0.35 * size), (0.0, -0.2 * r, under - 0.2 * size)
            t.add("brace", bar(start, end, *self.brace.outline(0.7 * size, t.style)))
        high, bottom = -r + 0.03, (under - 0.03 if self.short else low - 0.04)
        t.add("plate", box((wide, thick, high - bottom), (0, reach + thick / 2, (high + bottom) / 2)))
        for x in (-0.45, 0.45):
            for q in (high - 0.018, bottom + 0.018):
                add_bolt(t.at(x * (wide - 0.03), reach + thick + 0.01, q).moved(_QUARTER), 0.012, thick + 0.01)
        column = extrude(section_i(depth, 0.15, 0.007, 0.01), -self.height, self.rise)
        t.at(0, reach + thick + depth / 2).add("column", column)
        self.tie.build(t, 0.008)
        return t.model()


class Ribbed(Bracket, name="bracket/ribbed"):
    """An L of plate or casting with one or two triangular ribs, bolted on a wall or a column beside the line."""

    thick: float = among((0.006, 0.008, 0.012), "of the plates", "m")
    wide: float = between(0, 0.05, "width over the usual one", "m")
    reach: float = between(0.02, 0.15, "from the line's side to the wall or column", "m")
    level: bool = chance(0.6, "its back ends at the shelf")
    over: float = between(0.02, 0.06, "height of the back over the shelf", "m", when=lambda p: not p.level)
    cut: str = among(("straight", "clipped", "curved"), "edge of a rib")
    one: bool = chance(0.4, "one rib", when=lambda p: Ribbed.width(p) >= 0.09, otherwise=True)
    cast: bool = chance(0.5, "cast in one piece")
    wall: bool = chance(0.5, "on a wall, not a column")
    tie: Tie = nested(Tie, "tie")

    @staticmethod
    def width(p: Any) -> float:
        """Of the shelf [m]."""
        return 0.05 + 0.4 * radius(p) + p.wide  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, thick, wide = t.pipe.radius, self.thick, self.width(self)
        reach, out, top, tall = r + self.reach, 1.15 * r + 0.015, -r, 0.1 + 1.2 * r
        low, high = top - tall, top + self.over
        solids = [box((wide, reach + out, thick), (0, (reach - out) / 2, top - thick / 2))]
        solids.append(box((wide, thick, high - low), (0, reach - thick / 2, (high + low) / 2)))
        span, x0, z0, z1 = reach - thick + 0.85 * out, reach - thick, top - thick, low + 0.1 * tall
        edge = {
            "straight": [],
            "clipped": [(x0 - span, z0 - 0.01), (x0 - 0.01, z1)],
            "curved": [(x0 - span * (1 - s), z0 - (z0 - z1) * s**2) for s in (0.25, 0.5, 0.75)],
        }[self.cut]
        side = [(x0, z0), (x0 - span, z0), *edge, (x0, z1)]
        xs = (0.0,) if self.one else (-0.4 * wide, 0.4 * wide)
        ribs = [slab_yz(side, x - thick / 2, x + thick / 2) for x in xs]
        t.add(_B, *solids, *(ribs if self.cast else ()))
        for rib in () if self.cast else ribs:
            t.add("gusset plate", rib)
        for s in BOTH:
            for z in (top - thick - 0.03, low + 0.025):
                spot = t.at(s * (0.3 if self.one else 0.22) * wide, reach, z)
                add_bolt(spot.moved(_QUARTER), 0.01, thick, "none")
        if self.wall:
            add_wall(t, 0.8, 0.2, reach, -self.height, 0.6)
        else:
            column = extrude(section_i(0.14, max(0.14, wide), 0.007, 0.01), -self.height, 0.4)
            t.at(0, reach + 0.07).add("column", column)
        self.tie.build(t, thick)
        return t.model()


STANDS = families_of(Stanchion, RollerChair, GuidedShoe, DummyLeg, Knee, Ribbed)
