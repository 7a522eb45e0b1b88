"""Light and special supports of lines: strut arm, folded sheet, tripod, spring base, cradle on a sleeper, L frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import one_of
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.shape import (
    Below,
    Feet,
    Footing,
    Section,
    add_bolt,
    add_nuts,
    add_wall,
    arc_yz,
    few,
    foot_of,
    piece_of,
    radius,
    section_of,
    slab_yz,
    standing,
    strap,
    upright,
)
from cadplants.families.supports.stand import Bracket, Tie
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import extrude, lattice
from cadplants.solids.polygon import circle, rounded_rectangle, section_i
from cadplants.solids.primitives import BOTH, CORNERS, bar, box, cylinder, hexagon, ring, rod, turned

__all__ = ["ARMS"]

_B = "bracket"


class _Backing(Feet):
    """A wall, a column or a post beside the line."""

    wall: bool = chance(0.5, "a wall")
    thick: float = between(0.1, 0.25, "of the wall", "m", when=lambda p: p.wall)
    long: float = between(0.5, 1.2, "of the wall", "m", when=lambda p: p.wall)
    column: bool = chance(0.6, "a column, not a post", when=lambda p: not p.wall)
    foot: Footing = foot_of("foot of the post", when=lambda p: not p.wall and not p.column)

    def build(self, t: Table, y: float, low: float, high: float, wide: float) -> None:
        """Puts it down, its face at ``y``, between two heights, for what is this wide [m]."""
        if self.wall:
            add_wall(t, self.long, self.thick, y, low, high)
        elif self.column:
            t.at(0, y + 0.07).add("column", extrude(section_i(0.14, max(0.12, wide), 0.007, 0.01), low, high))
        else:
            side = max(0.08, wide)
            t = t.at(0, y + side / 2)
            t.add("post", extrude(rounded_rectangle(side, side, 0.005, 2), self.foot.top + low, high))
            self.foot.build(t.at(0, 0, low), side + 0.12, side)


class StrutArm(Bracket, name="bracket/strut arm"):
    """A cantilever arm of slotted strut (41 mm) welded on a slotted back plate, maybe with a rib."""

    strut: float = among((0.021, 0.041, 0.041, 0.062), "height of the strut", "m")
    reach: float = between(0.1, 0.35, "from the line's side to the back plate", "m")
    tip: float = between(0.06, 0.2, "from the line's side to the strut's end", "m")
    slotted: bool = chance(0.7, "the strut is slotted", when=lambda p: p.holes)
    tall: float = between(0.06, 0.14, "height of the back plate - of the strut", "m")
    wide: float = among((0.045, 0.12), "width of the back plate", "m")
    ribbed: bool = chance(0.35, "a rib")
    capped: bool = chance(0.4, "a cap on the strut's end")
    tie: Tie = nested(Tie, "tie")
    backing: _Backing = piece_of(_Backing, "what it is bolted on", "holes", "structure")

    def build(self, t: Table) -> Model:
        r, s, top, thick, wide = t.pipe.radius, self.strut, -t.pipe.radius, 0.0025, self.wide
        reach, tip, mid, tall = r + self.reach, r + self.tip, top - s / 2, s + self.tall
        length, y = reach + tip, (reach - tip) / 2
        count = max(3, int(length / 0.05))
        filled = np.ones((3, 2 * count + 1), bool)
        filled[1, 1::2] = not self.slotted
        edges = np.linspace(-tip, reach, 2 * count + 2)
        arm = [lattice(np.array([-0.0205, -0.006, 0.006, 0.0205]), edges, filled, top - thick, top)]
        arm += [box((thick, length, s), (q * (0.0205 - thick / 2), y, mid)) for q in BOTH]
        arm += [box((0.009, length, thick), (q * 0.016, y, top - s + thick / 2)) for q in BOTH]
        spots = [(0.0, mid + q * (tall / 2 - 0.02)) if wide < 0.1 else (q * 0.045, mid) for q in BOTH]
        slot = rounded_rectangle(0.012, 0.028, 0.0059, 3)
        slots = tuple(slot + np.array(spot) for spot in spots) if self.holes else ()
        plate = rounded_rectangle(wide, tall, 0.005, 1) + np.array([0.0, mid])
        t.add(_B, *arm, upright(plate, reach, reach + 0.008, slots), of="clamp")
        if self.ribbed:
            rib = outline(reach, top - s, reach - 0.1, top - s, reach, mid - tall / 2)
            t.add("gusset plate", slab_yz(rib, -0.003, 0.003), of="clamp")
        for x, z in spots:
            add_bolt(t.at(x, reach + 0.008, z).spun("x", np.pi / 2), 0.01, 0.008, "none")
        if self.capped:
            t.add(_B, box((0.043, 0.004, s + 0.002), (0, -tip - 0.002, mid)), of="rubber", fine=True)
        self.tie.build(t, thick)
        self.backing.build(t, reach + 0.008, -self.height, 0.4, wide)
        return t.model()


class Folded(Bracket, name="bracket/folded"):
    """A support folded of sheet: a hat, a Z, a C or an inverted U with a notch, screwed on what is below."""

    thick: float = among((0.002, 0.003, 0.005), "of the sheet", "m")
    wide: float = between(0, 0.04, "width over the usual one", "m")
    tall: float = between(0.03, 0.15, "height of the support", "m")
    half: float = between(0.02, 0.05, "half the width across the line - its radius", "m")
    form: str = among(("hat", "Z", "C", "U"), "how it is folded")
    lean: float = among(
        (0.0, 0.015), "how far a hat's sides lean out", "m", when=lambda p: p.form == "hat", otherwise=0.0
    )
    heads: tuple[str, ...] = several(
        one_of("none", "socket"),
        lambda p: (2 if p.form == "hat" else 1) * (2 if Folded.width(p) > 0.05 else 1),
        "heads of the screws; none is a hexagon",
    )
    ribbed: bool = chance(0.4, "ribs in its corner")
    tie: Tie = nested(Tie, "tie")
    below: Below = standing(lambda p: radius(p) + p.thick + p.tall)

    @staticmethod
    def width(p: Any) -> float:
        """Along the line [m]."""
        return 0.03 + 0.4 * radius(p) + p.wide  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, thick, wide, tall, lip = t.pipe.radius, self.thick, self.width(self), self.tall, 0.03
        half, top, low, toe = r + self.half, -r - thick / 2, -r - thick - tall, r + self.half + self.lean
        base = low + thick / 2
        rest = [(-half, top), (half, top)]
        path, feet = {
            "hat": (
                [(-toe - lip, base), (-toe, base), *rest, (toe, base), (toe + lip, base)],
                [-toe - 0.6 * lip, toe + 0.6 * lip],
            ),
            "Z": ([(-half - lip, base), (-half, base), *rest], [-half - 0.6 * lip]),
            "C": ([(half, base), (-half, base), *rest], [0.3 * half]),
            "U": ([(half, base), (-half, base), *rest, (half, base + 0.4 * tall)], [-0.5 * half]),
        }[self.form]
        t.add(_B, strap([(0, y, z) for y, z in path], wide, thick), of="clamp")
        spots = [(x, y) for y in feet for x in ((-0.3 * wide, 0.3 * wide) if wide > 0.05 else (0.0,))]
        for (x, y), head in zip(spots, self.heads, strict=True):
            add_bolt(t.at(x, y, low), 0.006, thick, head)
        if self.ribbed:
            y, z = -half + thick / 2, top - thick / 2
            rib = outline(y, z, -half + 0.7 * tall, z, y, top - 0.7 * tall)
            for x in (-0.35 * wide, 0.35 * wide):
                t.add("gusset plate", slab_yz(rib, x - thick / 2, x + thick / 2), of="clamp")
        self.tie.build(t, thick)
        self.below.build(t, low, half + lip)
        return t.model()


class Tripod(Bracket, name="bracket/tripod"):
    """A pipe stand on three or four splayed legs with a telescopic column and a V head, a roller head or a cradle."""

    vee: float = between(0.6, 0.9, "half the angle of the V", "rad")
    nut: bool = chance(0.5, "a nut holds the column, not a pin")
    legs: int = whole(3, 4, "legs")

    def build(self, t: Table) -> Model:
        r, v, n, floor = t.pipe.radius, self.vee, few(0.02, t.style), -self.height
        thick, vertex, flank = 0.006 + 0.01 * r, -(r / np.sin(v)), r / np.tan(v) + 0.4 * r + 0.01
        x, z, low = flank * np.sin(v), vertex + flank * np.cos(v), vertex - thick / np.sin(v)
        side = [(x, z), (x + thick * np.cos(v), z - thick * np.sin(v))]
        head = [(0, vertex), *side, (0, low), *((-a, b) for a, b in side[::-1])]
        t.add(_B, slab_yz(head, -0.025, 0.025))
        free, inner, outer = low + self.height, 0.012 + 0.05 * r, 0.018 + 0.06 * r
        knee, leg_r, spread = floor + 0.7 * free, 0.45 * outer + 0.004, max(0.15, 0.35 * free)
        t.add("post", cylinder(inner, knee - 0.1 * free, low + 0.002, n))
        t.add("post", ring(0.9 * outer if t.style.hollow else 0, outer, floor + 0.25 * free, knee, max(n, 8)))
        if self.nut:
            t.add("nut", hexagon(3 * outer, knee, knee + 0.02), fine=False)
        else:
            t.at(0, 0, knee - 0.02).along("y").add("screw", cylinder(0.005, -1.6 * outer, 1.6 * outer, 8))
        hip = knee - 0.15 * free
        leg = rod((outer * 0.9, 0, hip), (spread, 0, floor + 0.006), leg_r, few(leg_r, t.style))
        end = (spread * 0.75, 0, floor + 0.006 + (hip - floor) * 0.25)
        brace = rod((outer * 0.9, 0, floor + 0.27 * free), end, 0.6 * leg_r, 6)
        for k in range(self.legs):
            turn = t.spun("z", 2 * np.pi * k / self.legs + 0.4)
            turn.add("brace", leg)
            turn.add("brace", brace)
            turn.at(spread, 0, floor).add("base plate", cylinder(2.2 * leg_r, 0, 0.008, n))
        return t.model()


class SpringBase(Bracket, name="bracket/spring base", sizes=SIZES[3:]):
    """A variable spring base (MSS SP-58 type F): a can on a flange, a load column, a shoe on it."""

    tall: float = between(0, 0.1, "height of the can over the usual one", "m")
    shod: bool = chance(0.75, "a shoe under the line")
    shoe: float = between(0.02, 0.08, "height of the shoe", "m", when=lambda p: p.shod)
    round: bool = chance(0.5, "the load plate is round")
    out: float = between(0.02, 0.08, "how far the load column stands out of the can", "m")
    slot: bool = chance(0.6, "a scale in the can")
    square: bool = chance(0.6, "the flange is square, not round")
    below: Below = standing(lambda p: SpringBase.depth(p))

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's axis to the foot of the can [m]."""
        r, plate = radius(p), 0.012
        return r + p.shoe + plate + p.out + 0.1 + 0.6 * r + p.tall  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, shoe, plate, foot = t.pipe.radius, self.shoe, 0.012, -self.depth(self)
        can, tall = 0.045 + 0.4 * r, 0.1 + 0.6 * r + self.tall
        n, top, lid = t.n(can, 12), -r, foot + tall
        if self.shod:
            top -= shoe
            web = box((1.2 * can, 0.008, shoe - 0.006), (0, 0, -r - shoe / 2 + 0.004))
            t.add(_B, web, box((1.4 * can, 1.4 * can, 0.008), (0, 0, top + 0.004)))
        square = box((1.7 * can, 1.7 * can, plate), (0, 0, top - plate / 2))
        t.add(_B, cylinder(0.9 * can, top - plate, top, n) if self.round else square)
        t.add(_B, cylinder(0.4 * can, lid - 0.02, top - plate, few(0.02, t.style)), of="trim")
        rim = 1.05 * can
        shell = [turned(outline(can, foot + 0.01, can, lid - 0.008, rim, lid - 0.008, rim, lid), n)]
        if self.slot:
            shell.append(box((0.006, 0.02, 0.5 * tall), (can, 0, foot + 0.5 * tall)))
        t.add(_B, *shell, of="motor")
        side = 2 * can + 0.08
        base = rounded_rectangle(side, side, 0.008, 2) if self.square else circle(0.6 * side, n)
        t.add("base plate", extrude(base, foot, foot + 0.01))
        q = 0.9 * (side / 2 - 0.022)
        for sx, sy in CORNERS:
            add_bolt(t.at(sx * q, sy * q, foot), 0.01, 0.01, "none")
        self.below.build(t, foot, side / 2)
        return t.model()


class Cradle(Bracket, name="bracket/cradle"):
    """A welded cradle: a wrapper plate on a web with ribs and a sole, a strap on studs over it."""

    open: float = between(0.28, 0.45, "how far it goes round the line on either side / half a turn")
    tall: float = between(0, 0.08, "height of the web over the usual one", "m")
    foot: float = between(-0.2, 0.3, "how much wider the web is below / its width above")
    gussets: bool = chance(0.6, "the ribs are taken for gusset plates, not for brackets")
    strapped: bool = chance(0.5, "a strap on studs over the line")
    below: Below = standing(lambda p: 1.4 * radius(p) + 0.006 + 0.05 + p.tall + (0.008 if p.strapped else 0.0))

    def build(self, t: Table) -> Model:
        r, opened, thick = t.pipe.radius, self.open * np.pi, 0.006
        wide, low = 0.06 + 0.5 * r, -r - thick - (0.05 + 0.4 * r + self.tall)
        a = np.linspace(1.5 * np.pi - opened, 1.5 * np.pi + opened, 11)
        unit, floor = np.column_stack([np.cos(a), np.sin(a)]), low + 0.008
        wrap = slab_yz(np.vstack([(r + thick) * unit, (r * unit)[::-1]]), -wide / 2, wide / 2)
        rim = (r + 0.5 * thick) * unit
        half = float(rim[-1][0])
        foot = half + self.foot * half
        web = slab_yz([*rim, (foot, floor), (-foot, floor)], -0.004, 0.004)
        t.add(_B, wrap, web, box((wide, 2 * foot + 0.05, 0.008), (0, 0, low + 0.004)))
        for y in (0.0,) if r < 0.04 else (-0.5 * half, 0.5 * half):
            z = -np.sqrt((r + 0.5 * thick) ** 2 - y**2)
            rib = outline(-wide / 2, floor, wide / 2, floor, 0.45 * wide, z, -0.45 * wide, z)
            t.add("gusset plate" if self.gussets else _B, upright(rib, y - 0.003, y + 0.003))
        if self.strapped:
            self._strap(t, wide, low)
            low -= 0.008
        else:
            for s in BOTH:
                for x in (-0.3, 0.3):
                    add_bolt(t.at(x * wide, s * (foot + 0.012), low), 0.01, 0.008, "none")
        self.below.build(t, low, foot + 0.04)
        return t.model()

    @staticmethod
    def _strap(t: Table, wide: float, low: float) -> None:
        r, thick, ear = t.pipe.radius, 0.005, 0.04
        spots = [(0, s * (r + thick + 0.55 * ear)) for s in BOTH]
        t.add("clamp", half_band(r, thick, 0.5 * wide, ear, t.style, 0.01))
        for x, y in spots:
            t.at(x, y).add("stud", cylinder(0.005, low + 0.008, 0.03, 8), fine=False)
            add_nuts(t.spun("x", np.pi), [(0, -y, -0.011)], 0.01)
        t.add("plate", box((0.5 * wide, 2 * (r + ear) + 0.05, 0.008), (0, 0, low - 0.004)))
        for x, y in spots:
            t.add("nut", box((0.02, 0.02, 0.008), (x, y, low + 0.004)), fine=False)


class Gallows(Bracket, name="bracket/gallows", grain="fitting", bundle=""):
    """An L or goal post of one bent or mitred profile on the floor with corner gussets, or a gallows over the line."""

    # Its hanger and its gusset are far apart: one mesh of both would be no bracket.

    size: float = among((0.05, 0.06, 0.08), "height of the profile", "m")
    out: float = between(0.08, 0.3, "from the line's side to the post", "m")
    section: Section = section_of("section of the profile", flat=True)
    over: bool = chance(0.4, "over the line, not under it")
    rise: float = between(0.14, 0.35, "height of the arm over 1.3 radii of the line", "m", when=lambda p: p.over)
    foot: Footing = foot_of()
    leg: float = between(0.06, 0.14, "of the gusset, where there is room", "m")
    clipped: bool = chance(0.5, "the gusset's corners are cut")
    tie: Tie = nested(Tie, "tie", when=lambda p: not p.over)

    def build(self, t: Table) -> Model:
        r, size, out, floor = t.pipe.radius, self.size, t.pipe.radius + self.out, -self.height
        section = self.section.outline(size, t.style)
        z, inner = 1.3 * r + self.rise if self.over else -r - size / 2, out - float(section[0][:, 1].max())
        post = t.at(0, out)
        post.add("post", extrude(section[0], self.foot.top + floor, z + size / 2, section[1]))
        t.add("beam", bar((0, -r - 0.06, z), (0, inner, z), *section))
        self.foot.build(post.at(0, 0, floor), size + 0.12, size)
        leg, under = min(self.leg, 0.9 * inner), z - size / 2
        cut = outline(inner - leg, under - 0.012, inner - 0.012, under - leg) if self.clipped else []
        corner = [(inner, under), (inner - leg, under), *cut, (inner, under - leg)]
        t.add("gusset plate", slab_yz(corner, -0.004, 0.004))
        if not self.over:
            self.tie.build(t, 0.006)
            return t.model()
        low = 1.25 * r + 0.01
        knee = low + 0.02
        lean = float(np.arcsin((r + 0.002) / knee))  # where the legs leave the line as tangents
        sling = arc_yz(r + 0.002, np.pi - lean, 2 * np.pi + lean, 16)
        t.add("pipe hanger", strap(np.vstack([[[0, -0.006, knee]], sling, [[0, 0.006, knee]]]), 0.03, 0.004))
        t.add("stud", cylinder(0.005, low, under, 8), fine=False)
        t.add("nut", hexagon(0.018, low + 0.022, low + 0.03))
        t.add("nut", hexagon(0.018, under - 0.009, under))
        return t.model()


ARMS = families_of(StrutArm, Folded, Tripod, SpringBase, Cradle, Gallows)
