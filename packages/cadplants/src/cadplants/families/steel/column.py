"""Columns: laced, built up, stiffened, of concrete and timber, poles."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table
from cadplants.families.steel.shape import (
    Base,
    Structure,
    bar,
    few_sides,
    flat,
    pipe,
    section,
    slab_xy,
    slab_xz,
    span_of,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, box, cylinder, turned
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["COLUMNS"]


class _Cap(Params):
    """A cap plate with its bolts or a short beam on it, or nothing."""

    form: str = among(("nothing", "plate", "beam"), "what it is")
    size: float = between(0.1, 0.2, "height of the beam's section", "m", when=of_form("beam"))
    shape: str = among(("H", "I", "U"), "section of the beam", when=of_form("beam"))

    def build(self, t: Table, size: float) -> None:
        """Puts it down on z = 0, with a plate of a side [m]."""
        if self.form != "nothing":
            t.add("plate", box((size, size, 0.015), (0, 0, 0.0075)))
        if self.form == "beam":
            one = section(self.shape, self.size, t.style)
            z = 0.015 - span_of(one)[2]
            t.add("beam", bar((-0.6, 0, z), (0.6, 0, z), one))


class Laced(Structure, name="column/laced"):
    """A built-up column: two channels or four angles with lacing bars or batten plates (EN 1993-1-1, 6.4)."""

    height: float = between(1.5, 4.5, "of the column", "m")
    width: float = between(0.18, 0.4, "of the column", "m")
    four: bool = chance(0.4, "of four angles, not two channels")
    battens: bool = chance(0.5, "with batten plates, not lacing bars")
    channel: float = between(0.1, 0.2, "height of a channel", "m", when=lambda p: not p.four)
    base: Base = nested(Base, "base plate")
    cap: _Cap = nested(_Cap, "what is on top")

    def build(self, t: Table) -> Model:
        h, w, own = self.height, self.width, t.bundled("column")
        d = w if self.four else self.channel
        low = self.base.build(t, w + 0.15, d + 0.15)
        if self.four:
            leg = extrude(section("L", 0.25 * w, t.style)[0] + (0.28 * 0.25 * w, 0.125 * w), low, h)
            for k, (sx, sy) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
                own.at(sx * w / 2, sy * d / 2).spun("z", k * np.pi / 2).add("column", leg)
        else:
            leg = extrude(section("U", d, t.style)[0] + (0.16 * d, 0), low, h)
            for s in BOTH:
                own.at(s * w / 2).spun("z", 0.0 if s < 0 else np.pi).add("column", leg)
        zs = np.linspace(low + 0.05, h - 0.05, int(np.clip(h / (0.9 * w), 3, 10)) + 1)
        for k, (za, zb) in enumerate(zip(zs[:-1], zs[1:], strict=True)):
            for s in BOTH:
                y, x = s * (d / 2 + 0.004), w / 2 - 0.02
                if self.battens:
                    own.add("plate", box((w, 0.008, 0.35 * (zb - za)), (0, y, (za + zb) / 2)))
                else:
                    flip = x if (k + (s > 0)) % 2 else -x
                    own.add("brace", flat((-flip, y, za), (flip, y, zb), 0.008, 0.04, (0, 1, 0)))
        self.cap.build(t.at(0, 0, h), max(w, d) + 0.08)
        return t.model()


class Stiffened(Structure, name="column/stiffened base", weight=1.2):
    """A steel column on a stiffened base: gussets between shaft and plate, grout and a concrete pedestal."""

    height: float = between(0.8, 4.0, "of the shaft", "m")
    size: float = between(0.1, 0.3, "height of the section", "m")
    shape: str = among(("H", "SHS", "CHS", "I"), "section")
    raised: bool = chance(0.6, "on a pedestal")
    pedestal: float = between(0.15, 0.6, "height of the pedestal", "m", when=lambda p: p.raised)
    grouted: bool = chance(0.5, "with grout on the pedestal", when=lambda p: p.raised)
    base: Base = nested(Base, "base plate")
    tall: float = between(0.6, 1.4, "height of a gusset / of the section")
    cap: _Cap = nested(_Cap, "what is on top")

    def build(self, t: Table) -> Model:
        size, low, side = self.size, self.pedestal, 2.0 * self.size
        one, own = section(self.shape, size, t.style), t.bundled("column")
        if self.raised:
            t.add("foundation", slab_xy(rounded_rectangle(side + 0.2, side + 0.2, 0.03, 1), 0, low))
        if self.grouted:
            t.add("foundation", box((side + 0.04, side + 0.04, 0.03), (0, 0, low + 0.015)), of="ground")
            low += 0.03
        low += self.base.build(t.at(0, 0, low), side, side)
        top = self.height + low
        own.add("column", bar((0, 0, low), (0, 0, top), one, (1, 0, 0)))
        x0, x1, y0, y1 = span_of(one)
        reach, tall = 0.45 * size, self.tall * size
        gusset = slab_xz([(0, 0), (reach, 0), (reach, 0.2 * tall), (0.25 * reach, tall), (0, tall)], 0.01)
        for turn, edge in enumerate((y1, x1, -y0, -x0)):
            own.spun("z", turn * np.pi / 2).at(edge, 0, low).add("gusset plate", gusset, own=True)
        self.cap.build(t.at(0, 0, top), size + 0.1)
        return t.model()


class Concrete(Structure, name="column/concrete", weight=0.8, grain="fitting"):
    """A concrete column: square with chamfers, round, octagonal, with a corbel, a mushroom head or a steel shoe."""

    height: float = between(1.2, 4.0, "of the column", "m")
    width: float = between(0.2, 0.6, "of the column", "m")
    form: str = among(("square", "round", "octagonal", "mushroom"), "how it is made")
    longer: float = among((1.0, 1.5), "one side / the other", when=of_form("square"), otherwise=1.0)
    corbelled: bool = chance(0.6, "a corbel with a beam", when=of_form("square"))
    beam: str = among(("H", "I"), "section of that beam", when=lambda p: p.corbelled)
    footed: bool = chance(0.5, "on a foundation")

    def build(self, t: Table) -> Model:
        h, a, own = self.height, self.width, t.bundled("column")
        n = few_sides(t.style, a / 2, 32)
        shape = {
            "square": rounded_rectangle(a, a * self.longer, 0.02, 1),
            "octagonal": circle(a / 2, 8),
        }.get(self.form, circle(a / 2, n))
        head = turned([(a / 2, 0), (a / 2, h - 0.3), (a, h), (a, h + 0.1)], n)
        own.add("column", head if self.form == "mushroom" else extrude(shape, 0, h), of="concrete")
        if self.corbelled:
            x, z = a / 2, h - 0.25
            corbel = slab_xz([(x, h - 0.7), (x + 0.3, h - 0.45), (x + 0.3, z), (x, z)], 0.8 * a)
            own.add("column", corbel, of="concrete")
            one = section(self.beam, 0.2, t.style)
            t.add("beam", bar((x + 0.15, -1.0, z + 0.1), (x + 0.15, 1.0, z + 0.1), one))
        if self.footed:
            t.add("foundation", box((2 * a + 0.3, 2 * a + 0.3, 0.25), (0, 0, -0.125)))
        return t.model()


def _tapered(p: Any) -> bool:
    return bool(p.form == "tapered")


class Pole(Structure, name="column/pole", grain="fitting"):
    """A tapered or stepped pole column (EN 40), pipe column with flanges, or a telescopic shoring prop (EN 1065)."""

    height: float = between(1.5, 4.5, "of the pole", "m")
    radius: float = between(0.05, 0.12, "of the pole, of a prop / 0.45", "m")
    form: str = among(("tapered", "stepped", "prop"), "how it is made")
    base: Base = nested(Base, "base plate")
    octagonal: bool = among((True, False), "its section is an octagon", when=_tapered)
    cap: _Cap = nested(_Cap, "what is on top", when=_tapered)

    def build(self, t: Table) -> Model:
        h, r, own = self.height, self.radius, t.bundled("column")
        n, low = few_sides(t.style, r, 24), self.base.build(t, 5 * r, 5 * r)
        if self.form == "tapered":
            own.add("column", turned([(1.4 * r, low), (0.6 * r, h)], 8 if self.octagonal else n))
            self.cap.build(t.at(0, 0, h), 2 * r + 0.1)
        elif self.form == "stepped":
            own.add("column", turned([(r, low), (r, h / 2), (0.7 * r, h / 2 + 0.1), (0.7 * r, h)], n))
            t.add("plate", cylinder(1.8 * r, h, h + 0.015, n))
        else:
            r, z = 0.45 * r, 0.6 * h
            own.add_each("column", [cylinder(r, low, z, n), cylinder(0.8 * r, z, h, n)])
            t.add("nut", cylinder(1.5 * r, z - 0.05, z + 0.01, n), of="handle", fine=False)
            t.add("bolt", pipe([(-0.08, 0, z + 0.1), (0.08, 0, z + 0.1)], 0.007, t.style), fine=False)
            t.add("plate", box((0.13, 0.13, 0.006), (0, 0, h + 0.003)))
        return t.model()


class BuiltUp(Structure, name="column/built up", grain="fitting"):
    """A welded column: cruciform, double I, box of plates, a T pair; or a tapered portal leg with a haunch."""

    height: float = between(1.5, 4.0, "of the column", "m")
    width: float = between(0.15, 0.35, "of the column", "m")
    base: Base = nested(Base, "base plate")
    form: str = among(("cruciform", "double I", "box", "portal leg"), "how it is made")
    joined: bool = chance(0.5, "in one mesh", when=lambda p: p.form != "cruciform")
    cap: _Cap = nested(_Cap, "what is on top")

    def build(self, t: Table) -> Model:
        low = self.base.build(t, self.width + 0.14, self.width + 0.14)
        t.bundled("column").add_each("column", self._shaft(low, t.style), joined=self.joined)
        self.cap.build(t.at(0, 0, self.height), self.width + 0.1)
        return t.model()

    def _shaft(self, low: float, style: ModelingStyle) -> list[Solid]:
        """Its plates or sections."""
        h, a, thick, tall, mid = self.height, self.width, 0.012, self.height - low, (self.height + low) / 2
        if self.form == "cruciform":
            half = [(a / 2, -0.01), (a / 2, 0.01), (0.01, 0.01), (0.01, a / 2), (-0.01, a / 2), (-0.01, 0.01)]
            return [extrude(np.array(half + [(-x, -y) for x, y in half]), low, h)]
        if self.form == "double I":
            one = extrude(section("I", a, style)[0], low, h)
            return [moved(one, at(s * 0.25 * a)) for s in BOTH]
        if self.form == "box":
            solids = [box((a, thick, tall), (0, s * (a - thick) / 2, mid)) for s in BOTH]
            return solids + [box((thick, a - 2 * thick, tall), (s * 0.3 * a, 0, mid)) for s in BOTH]
        top, x = 1.3 * a, a / 2
        return [
            slab_xz([(-x, low), (x, low), (top, h), (-x, h)], thick),
            box((thick, 0.8 * a, tall), (-x - thick / 2, 0, mid)),
            slab_xz([(x, low), (x + thick, low), (top + thick, h), (top, h)], 0.8 * a),
        ]


class Timber(Structure, name="column/timber", weight=0.6, grain="fitting"):
    """Timber columns in steel shoes with a beam, knee braces and dowels."""

    width: float = between(1.2, 3.0, "from column to column", "m")
    height: float = between(1.6, 2.6, "of a column", "m")
    side: float = among((0.1, 0.14, 0.2), "of a column's section", "m")

    def build(self, t: Table) -> Model:
        w, h, a, wood = self.width, self.height, self.side, "safety"
        square, thin = section("square", a, t.style), section("timber", 0.7 * a, t.style)
        for x in (0.0, w):
            t.add("base plate", box((a + 0.08, a + 0.04, 0.008), (x, 0, 0.004)))
            t.add_each("bracket", [box((a, 0.006, 0.25), (x, s * (a / 2 + 0.003), 0.133)) for s in BOTH])
            t.add("column", bar((x, 0, 0.008), (x, 0, h), square), of=wood)
        t.add("beam", bar((-0.3, 0, h + a / 2), (w + 0.3, 0, h + a / 2), square), of=wood)
        for x, s in ((0.0, 1), (w, -1)):
            t.add("brace", bar((x + s * a / 2, 0, h - 0.5), (x + s * (a / 2 + 0.5), 0, h), thin), of=wood)
        return t.model()


COLUMNS = families_of(Laced, Stiffened, Concrete, Pole, BuiltUp, Timber)
