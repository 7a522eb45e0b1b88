"""Structures of primitives: sections as sharp prisms, plates and treads as boxes, rails and rungs as plain bars."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made, number, one_of, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, spread, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    FRAME,
    disc,
    lying,
    torus_piece,
)
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, bar, box, cylinder, rod, torus
from cadplants.solids.transforms import at, spun

__all__ = ["PRIMITIVE_STEEL"]

Outline = tuple[Floats, tuple[Floats, ...]]


def _outline(h: float, form: str) -> Outline:
    """A sharp section of a height [m], its outline and holes."""
    if form == "I":
        return section_i(h, 0.8 * h, 0.06 * h, 0.09 * h), ()
    if form == "U":
        return section_channel(h, 0.45 * h, 0.07 * h, 0.1 * h) - (0.2 * h, 0.0), ()
    if form == "L":
        return section_angle(h, 0.1 * h) - (0.3 * h, 0.3 * h), ()
    if form == "tube":
        return rounded_rectangle(h, h, 0.0), (rounded_rectangle(0.88 * h, 0.88 * h, 0.0),)
    return rounded_rectangle(0.6 * h, h, 0.0), ()


class _Section(Params):
    """A sharp section."""

    least: float = given(0.06, "its least height", "m")
    most: float = given(0.25, "its greatest height", "m")
    high: float = between(lambda p: p.least, lambda p: p.most, "height", "m")
    form: str = among(("I", "I", "U", "L", "tube", "flat"), "shape")

    @property
    def outline(self) -> Outline:
        """Its outline and holes."""
        return _outline(self.high, self.form)

    @property
    def size(self) -> float:
        """Its extent [m]."""
        return float(np.ptp(self.outline[0][:, 1]))


def _section(least: float = 0.06, most: float = 0.25, when: Callable[[Any], bool] | None = None) -> _Section:
    return nested(_Section, "rolled section", fixed=lambda _: {"least": least, "most": most}, when=when)


class _Foot(Params):
    """A plate and a block under a column, or one of them, or neither; plates are square or round."""

    plated: bool = chance(0.6, "a plate")
    thick: float = between(0.01, 0.03, "of the plate", "m", when=lambda p: p.plated)
    round_: bool = chance(0.3, "the plate is round", when=lambda p: p.plated)
    block: bool = chance(0.4, "a block")
    deep: float = between(0.2, 0.5, "depth of the block", "m", when=lambda p: p.block)

    def build(self, t: Table, size: float) -> None:
        """Puts it down under a column of a width [m]."""
        thick, deep = self.thick, self.deep
        if self.plated:
            square = box((2 * size, 2 * size, thick), (0, 0, thick / 2))
            t.add("base plate", disc(1.2 * size, 0.0, thick, t.style) if self.round_ else square)
        if self.block:
            t.add("foundation", box((3 * size, 3 * size, deep), (0, 0, -deep / 2)))


class _Steel(Device, group=FRAME, sizes=(15,)):
    """A structure of primitives."""


class _Side(Params):
    """One side of a frame."""

    bays: int = given(1, "bays")
    feet: tuple[_Foot, ...] = several(made(_Foot), lambda p: p.bays + 1, "feet of the columns")
    flush: bool = chance(0.5, "its beams lie between the columns, not on them")


class SharpFrame(_Steel, name="frame/sharp sections", label="beam", weight=2.5):
    """Columns and beams of one section, with braces at times: a frame of one or more bays."""

    section: _Section = _section(0.08, 0.25)
    bays: int = whole(1, 3, "bays")
    wide: float = between(1.2, 3.0, "width of a bay", "m")
    two: bool = among((False, True), "it has two sides")
    deep: float = between(1.0, 2.0, "between the two sides", "m", when=lambda p: p.two)
    high: float = between(1.2, 4, "height of the columns", "m")
    sides: tuple[_Side, ...] = several(
        made(_Side, lambda p: {"bays": p.bays}), lambda p: 2 if p.two else 1, "its sides"
    )
    braced: bool = chance(0.5, "a brace in the first bay")
    brace: str = among(("L", "flat", "tube"), "section of the brace", when=lambda p: p.braced, otherwise="")

    def build(self, t: Table) -> Model:
        section, size, wide, high = self.section.outline, self.section.size, self.wide, self.high
        for y, side in zip((0.0, self.deep), self.sides, strict=False):
            for k, foot in enumerate(side.feet):
                t.add("column", bar((k * wide, y, 0), (k * wide, y, high), *section))
                foot.build(t.at(k * wide, y), size)
            top = high - size / 2 if side.flush else high + size / 2
            for k in range(self.bays):
                t.add("beam", bar((k * wide, y, top), ((k + 1) * wide, y, top), *section))
        for k in range(self.bays + 1) if self.two else ():
            t.add("beam", bar((k * wide, 0, 0.98 * high), (k * wide, self.deep, 0.98 * high), *section))
        if self.braced:
            t.add("brace", bar((0, 0, 0.1), (wide, 0, 0.95 * high), *_outline(0.5 * size, self.brace)))
        return t.model()


class BeamOnPosts(_Steel, name="beam/on posts", label="beam"):
    """A beam on two posts."""

    section: _Section = _section()
    length: float = between(1.0, 6.0, "of the beam", "m")
    high: float = between(0.3, 3.0, "height of the beam", "m")
    under: tuple[str, ...] = several(one_of("column", "post"), 2, "what each post is taken for")

    def build(self, t: Table) -> Model:
        size, length, high = self.section.size, self.length, self.high
        t.add("beam", bar((0, 0, high), (length, 0, high), *self.section.outline))
        post = extrude(rounded_rectangle(0.8 * size, 0.8 * size, 0.0), 0.0, high - size / 2)
        for x, name in zip((0.15 * length, 0.85 * length), self.under, strict=True):
            t.at(x).add(name, post)
        return t.model()


class SharpColumn(_Steel, name="column/sharp section", label="column"):
    """A lone column."""

    section: _Section = _section()
    length: float = between(1.0, 6.0, "height", "m")
    foot: _Foot = nested(_Foot, "foot")

    def build(self, t: Table) -> Model:
        t.add("column", bar((0, 0, 0), (0, 0, self.length), *self.section.outline))
        self.foot.build(t, self.section.size)
        return t.model()


class _SingleBars(Params):
    """A railing along x of single posts and rails, round or square, each a piece of its own."""

    high: float = between(0.9, 1.15, "height", "m")
    radius: float = between(0.012, 0.026, "of a bar", "m")
    square: bool = chance(0.3, "its bars are square")
    pitch: float = between(0.7, 1.5, "least distance of the posts", "m")
    named: str = among(("post", "railing"), "what its posts are taken for")
    knee: bool = chance(0.8, "a knee rail")
    low: bool = chance(0.3, "a rail near the floor")
    toe: bool = chance(0.4, "a toe plate")

    def build(self, t: Table, length: float) -> None:
        """Puts it down over a length [m]."""
        high, r, n, t = self.high, self.radius, min(t.n(self.radius), 16), t.bundled("railing")

        def one(start: tuple[float, float, float], end: tuple[float, float, float]) -> Solid:
            return bar(start, end, rounded_rectangle(2 * r, 2 * r, 0.0)) if self.square else rod(start, end, r, n)

        for x in np.linspace(0.03, length - 0.03, max(2, int(length / self.pitch) + 1)):
            t.add(self.named, one((float(x), 0, 0), (float(x), 0, high)), of="safety")
        for share, there in ((1.0, True), (0.5, self.knee), (0.1, self.low)):
            if there:
                t.add("railing", one((0, 0, share * high), (length, 0, share * high)))
        if self.toe:
            t.add("railing", box((length, 0.006, 0.1), (length / 2, 0, 0.06)))


class DeckOnColumns(_Steel, name="platform/on columns", label="platform", grain="fitting"):
    """A flat box as a platform on beams and columns, with single bars as a railing."""

    length: float = between(1.0, 4.0, "length", "m")
    wide: float = between(0.8, 2.0, "width", "m")
    high: float = between(0.4, 3.0, "height of its underside", "m")
    thick: float = between(0.02, 0.06, "thickness", "m")
    gap: float = given(0.0, "between the bars of a grating", "m")
    size: float = between(0.05, 0.14, "of beams and columns", "m")
    railed: bool = chance(0.6, "a railing along one side")
    railing: _SingleBars = nested(_SingleBars, "railing", when=lambda p: p.railed)

    def build(self, t: Table) -> Model:
        a, b, high, thick, size = self.length, self.wide, self.high, self.thick, self.size
        slabs = [box((a, b, thick), (a / 2, 0, high + thick / 2))]
        if self.gap:
            ys, xs = np.arange(-b / 2, b / 2, self.gap), np.arange(0.05, a, 2.5 * self.gap)
            slabs = [box((a, 0.006, thick), (a / 2, float(y), high + thick / 2)) for y in ys]
            slabs += [box((0.008, b, 0.4 * thick), (float(x), 0, high + 0.8 * thick)) for x in xs]
        t.bundled(self.label).add(self.label, *slabs, of="steel")
        for y in (-b / 2 + size, b / 2 - size):
            t.add("beam", box((a, 0.6 * size, size), (a / 2, y, high - size / 2)))
            for x in (size, a - size):
                t.add("column", box((size, size, high - size), (x, y, (high - size) / 2)))
        if self.railed:
            self.railing.build(t.at(0, -b / 2 + 0.03, high + thick), a)
        return t.model()


class GratingOnColumns(DeckOnColumns, name="grating/on columns", label="grating"):
    """Crossed bars as a grating on beams and columns, with single bars as a railing."""

    gap: float = among((0.04, 0.06, 0.1), "between its bars", "m")


class SingleBars(_Steel, name="railing/single bars", label="railing", weight=1.5):
    """A railing of single bars on the floor."""

    length: float = between(1.0, 5.0, "length", "m")
    railing: _SingleBars = nested(_SingleBars, "railing")

    def build(self, t: Table) -> Model:
        self.railing.build(t, self.length)
        return t.model()


class _Stringer(Params):
    """One side of a flight."""

    deep: float = between(0.15, 0.25, "depth", "m")
    railed: bool = chance(0.6, "a rail over it")


class Boxes(_Steel, name="stairs/boxes", label="stair tread", weight=1.5, grain="fitting"):
    """Boxes as treads between two slanted boxes, or blocks on each other."""

    count: int = whole(3, 11, "treads")
    wide: float = between(0.6, 1.2, "width", "m")
    rise: float = between(0.15, 0.22, "of a step", "m")
    going: float = between(0.2, 0.3, "of a step", "m")
    blocks: bool = chance(0.3, "blocks that stand on the floor")
    thick: tuple[float, ...] = several(
        one_of(0.03, 0.03, 0.05),
        lambda p: p.count,
        "thickness of each tread",
        "m",
        when=lambda p: not p.blocks,
    )
    sides: tuple[_Stringer, ...] = several(made(_Stringer), 2, "its sides", when=lambda p: not p.blocks)

    def build(self, t: Table) -> Model:
        rise, going, wide, count = self.rise, self.going, self.wide, self.count
        for k in range(count):
            high = (k + 1) * rise if self.blocks else self.thick[k]
            tread = box((going, wide, high), (k * going, 0, (k + 1) * rise - high / 2))
            t.bundled("stair tread").add("stair tread", tread)
        end, far, rails = count * going, count * rise, t.bundled("railing")
        for y, side in zip((-wide / 2 - 0.02, wide / 2 + 0.02), self.sides, strict=False):
            stringer = rounded_rectangle(0.03, side.deep, 0.0)
            t.add("beam", bar((-going / 2, y, 0.1), (end, y, far), stringer))
            if side.railed:
                rail = rod((-going / 2, y, 1.0), (end, y, far + 0.95), 0.02, min(t.n(0.02), 16))
                rails.add("railing", rail)
                for share in (0.1, 0.9):
                    x, z = share * end, share * far + 0.1
                    upright = rod((x, y, z), (x, y, z + 0.9), 0.018, min(t.n(0.018), 16))
                    rails.add("post", upright, of="safety")
        return t.model()


class PlainBars(_Steel, name="ladder/plain bars", label="ladder", bundle="ladder"):
    """Two bars and rungs, upright, in one mesh or in single bars; hoops at times."""

    high: float = between(1.5, 5.0, "height", "m")
    wide: float = between(0.35, 0.5, "between the bars", "m")
    radius: float = between(0.008, 0.016, "of a rung", "m")
    flat: bool = chance(0.5, "its bars are flat")
    hooped: bool = chance(0.5, "hoops round it", when=lambda p: p.high > 2.5)
    one: bool = chance(0.5, "all is one mesh")

    def build(self, t: Table) -> Model:
        high, half, r, n = self.high, self.wide / 2, self.radius, min(t.n(self.radius), 12)
        solids = []
        for y in (-half, half):
            flat, round_ = box((0.06, 0.012, high), (0, y, high / 2)), moved(cylinder(1.5 * r, 0, high, n), at(0, y))
            solids.append(flat if self.flat else round_)
        solids += [rod((0, -half, z), (0, half, z), r, n) for z in np.arange(0.25, high - 0.1, 0.28)]
        if self.hooped:
            solids += [moved(torus(0.36, 0.015, 16, 4), at(0.36, 0, float(z))) for z in np.arange(2.2, high, 0.8)]
        t.add_each("ladder", solids, joined=self.one, of="steel")
        return t.model()


class PlainUpright(_Steel, name="post/plain upright", label="post", weight=1.5, grain="fitting"):
    """An upright of closed round or square section, from knee high to several metres, on a plate or bare."""

    high: float = spread(0.3, 5.0, "height", "m")
    radius: float = between(0.02, 0.09, "half its width", "m")
    square: bool = chance(0.4, "its section is square")
    foot: _Foot = nested(_Foot, "foot")
    topped: bool = chance(0.3, "a plate on top")

    def build(self, t: Table) -> Model:
        high, r = self.high, self.radius
        square = extrude(rounded_rectangle(2 * r, 2 * r, 0.0), 0.0, high)
        t.add("post", square if self.square else disc(r, 0.0, high, t.style))
        self.foot.build(t, 1.6 * r)
        if self.topped:
            t.add("plate", box((4 * r, 4 * r, 0.01), (0, 0, high + 0.005)))
        return t.model()


class PipeUpright(
    Device, name="pipe/plain upright", group="Pipe assembly", label="pipe", sizes=(15,), weight=1.5, grain="fitting"
):
    """An upright pipe, from knee high to several metres: with an elbow's start, a flange or a cap on top, or bare."""

    high: float = spread(0.3, 5.0, "height", "m")
    radius: float = between(0.02, 0.09, "radius", "m")
    end: str = among(("cap", "flange", "elbow", "bare"), "what is on top")
    arm: float = between(0.1, 1.0, "length of the pipe behind the elbow", "m", when=lambda p: p.end == "elbow")

    def build(self, t: Table) -> Model:
        high, r, n, style = self.high, self.radius, t.n(self.radius), t.style
        bore = 0.88 * r if style.hollow else 0.0
        t.bundled("pipe").add("pipe", torus_piece([(0.0, 0.0, 0.0), (0.0, 0.0, high)], r, n, bore))
        if self.end == "cap":
            t.add("pipe cap", disc(1.1 * r, high, high + 0.8 * r, style))
        elif self.end == "flange":
            t.add("flange", disc(2 * r, high - 0.02, high, style))
            t.add("blind flange", disc(2 * r, high + 0.002, high + 0.02, style))
        elif self.end == "elbow":
            steps = np.linspace(0, np.pi / 2, max(3, n // 4) + 1)
            bend = np.column_stack([3 * r * (1 - np.cos(steps)), np.zeros(len(steps)), high + 3 * r * np.sin(steps)])
            t.add("elbow", torus_piece(bend, r, n, bore))
            arm = [(3 * r, 0.0, high + 3 * r), (3 * r + self.arm, 0.0, high + 3 * r)]
            t.add("pipe", torus_piece(arm, r, n, bore))
        return t.model()


class _Panel(Params):
    """A frame with bars, a sheet or slats in it."""

    bar: float = between(0.015, 0.03, "width of the frame's bars", "m")
    form: str = among(("sheet", "slats", "bars", "mesh"), "what is in it")

    def solids(self, w: float, h: float) -> list[Solid]:
        """Its solids, from the origin in x and z, of a width and a height [m]."""
        b = self.bar
        frame = [box((w, b, b), (w / 2, 0, z)) for z in (b / 2, h - b / 2)]
        frame += [box((b, b, h), (x, 0, h / 2)) for x in (b / 2, w - b / 2)]
        if self.form == "sheet":
            return [*frame, box((w, 0.2 * b, h), (w / 2, 0, h / 2))]
        if self.form == "slats":
            return [*frame, *(box((w, 0.4 * b, 0.08), (w / 2, 0, z)) for z in np.arange(0.1, h - 0.1, 0.14))]
        count = len(np.arange(0.1, w - 0.05, 0.12))
        frame += [moved(cylinder(0.35 * b, 0.0, h, 6), at(0.1 + 0.12 * k)) for k in range(count)]
        if self.form == "bars":
            return frame
        return [*frame, *(lying(cylinder(0.3 * b, 0.0, w, 6), 0, 0, z) for z in np.arange(0.2, h - 0.1, 0.25))]


class _Bay(Params):
    """A panel between two posts."""

    leaf: bool = given(False, "it is the leaf of a gate")
    panel: _Panel = nested(_Panel, "panel")
    ajar: float = between(0.2, 1.4, "how far a leaf is open", "rad", when=lambda p: p.leaf)
    open_: bool = among((False, False, True), "the leaf is open", when=lambda p: p.leaf, otherwise=False)
    one: bool = chance(0.6, "it is one mesh")


class FramedPanel(_Steel, name="fence/framed panel", label="fence", grain="fitting"):
    """Posts with panels of bars, wires or sheet between them."""

    leaf: ClassVar[bool] = False

    wide: float = between(0.9, 2.5, "from post to post", "m")
    high: float = between(0.9, 2.2, "height of a panel", "m")
    radius: float = between(0.015, 0.035, "half the width of a post", "m")
    count: int = whole(1, 3, "panels")
    round_: tuple[bool, ...] = several(yes(0.5), lambda p: p.count + 1, "whether each post is round")
    gap: float = given(0.0, "between a leaf and its posts", "m")
    bays: tuple[_Bay, ...] = several(
        made(_Bay, lambda _: {"leaf": False}), lambda p: p.count, "what is between the posts"
    )

    def build(self, t: Table) -> Model:
        wide, high, r, gap, n = self.wide, self.high, self.radius, self.gap, min(t.n(self.radius), 12)
        for k, is_round in enumerate(self.round_):
            edge = circle(r, n) if is_round else rounded_rectangle(2 * r, 2 * r, 0)
            t.at(k * wide).add("post", extrude(edge, 0, 1.05 * high), of="fence")
        across = wide - 2 * r - 2 * gap
        for k, bay in enumerate(self.bays):
            solids, pose = bay.panel.solids(across, high - 0.1), at(k * wide + r + gap, 0, 0.08)
            if self.leaf:
                hinge = (gap + r, r, 0.05)
                solids += [box(hinge, (-gap / 2, 0, share * high)) for share in (0.2, 0.75)]
                solids.append(box((0.12, 2.5 * r, 0.03), (across, 0, 0.55 * high)))
                pose = pose @ spun("z", bay.ajar if bay.open_ else 0.0)
            t.moved(pose).bundled(self.label).add_each(self.label, solids, joined=bay.one)
        return t.model()


class FramedLeaf(FramedPanel, name="gate/framed leaf", label="gate"):
    """A gate: a leaf with hinges and a latch that stands off its two posts, at times half open."""

    leaf = True

    count: int = among((1,), "leaves")
    gap: float = between(0.02, 0.06, "between the leaf and its posts", "m")
    bays: tuple[_Bay, ...] = several(
        made(_Bay, lambda _: {"leaf": True}), lambda p: p.count, "what is between the posts"
    )


class FoundationBox(_Steel, name="foundation/box", label="foundation", grain="fitting"):
    """A box on the floor, at times with a column on it."""

    length: float = between(0.3, 2.5, "length", "m")
    wide: float = between(0.3, 1.5, "width", "m")
    high: float = between(0.1, 0.6, "height", "m")
    column: bool = chance(0.4, "a column on a plate on it")
    section: _Section = _section(0.08, 0.2, when=lambda p: p.column)
    tall: float = between(0.4, 2.0, "height of the column", "m", when=lambda p: p.column)

    def build(self, t: Table) -> Model:
        high = self.high
        block = box((self.length, self.wide, high), (0, 0, high / 2))
        t.bundled("foundation").add("foundation", block)
        if self.column:
            t.add("base plate", box((0.3, 0.3, 0.02), (0, 0, high + 0.01)))
            t.add("column", bar((0, 0, high + 0.02), (0, 0, high + self.tall), *self.section.outline))
        return t.model()


class WallBox(_Steel, name="wall/box", label="wall", bundle="wall"):
    """An upright box on the floor: a wall."""

    length: float = between(1.0, 5.0, "length", "m")
    thick: float = between(0.08, 0.3, "thickness", "m")
    high: float = between(0.8, 3.0, "height", "m")

    def build(self, t: Table) -> Model:
        t.add("wall", box((self.length, self.thick, self.high), (0, 0, self.high / 2)))
        return t.model()


class ForkOfPlates(_Steel, name="caster/fork of plates", label="caster", weight=0.7, grain="fitting"):
    """A wheel in a fork of two plates under a top plate or on a stem, with a stop over it at times; four to a frame."""

    radius: float = between(0.03, 0.1, "of the wheel", "m")
    stemmed: bool = chance(0.4, "a stem, not a top plate")
    split: bool = chance(0.6, "wheel, fork, axle and head are meshes of their own")
    framed: bool = chance(0.6, "four under a frame")
    turns: tuple[float, ...] = several(number(0, 6), lambda p: 4 if p.framed else 1, "which way each looks", "rad")

    def build(self, t: Table) -> Model:
        r = self.radius
        wide, plate, n, top = 0.6 * r, 0.06 * r + 0.002, t.n(r), 2.5 * r
        on_axle = at(0, 0, r) @ spun("x", np.pi / 2)
        wheel = moved(cylinder(r, -wide / 2, wide / 2, n), on_axle)
        cheeks = [box((0.9 * r, plate, 1.7 * r), (0.1 * r, s * (wide / 2 + 1.2 * plate), 1.65 * r)) for s in BOTH]
        fork = [*cheeks, box((1.1 * r, wide + 3.4 * plate, plate), (0.1 * r, 0, top))]
        axle = moved(cylinder(0.15 * r, -0.7 * wide, 0.7 * wide, 8), on_axle)
        head = box((2 * r, 1.7 * r, plate), (0, 0, top + 1.3 * plate))
        if self.stemmed:
            head = moved(cylinder(0.25 * r, 0, 0.9 * r, n), at(0, 0, top))
        places = [(x, y) for x in (0.0, 0.8) for y in (0.0, 0.5)] if self.framed else [(0.0, 0.0)]
        for (x, y), turn in zip(places, self.turns, strict=True):
            there = t.at(x, y).spun("z", turn).bundled("caster")
            for some in [[wheel], fork, [axle], [head]] if self.split else [[wheel, *fork, axle, head]]:
                there.add("caster", *some)
        high = top + (0.9 * r if self.stemmed else 1.8 * plate)
        for y in (0.0, 0.5) if self.framed else ():
            t.add("skid frame", box((1.0, 0.06, 0.06), (0.4, y, high + 0.03)))
        return t.model()


PRIMITIVE_STEEL: tuple[Family, ...] = families_of(
    SharpFrame,
    BeamOnPosts,
    SharpColumn,
    DeckOnColumns,
    GratingOnColumns,
    SingleBars,
    Boxes,
    PlainBars,
    PlainUpright,
    PipeUpright,
    FramedPanel,
    FramedLeaf,
    FoundationBox,
    WallBox,
    ForkOfPlates,
)
