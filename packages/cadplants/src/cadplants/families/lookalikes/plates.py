"""Round and square plates: under posts, on necks, as lids and between pipes."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.params import among, between, chance, given
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    FRAME,
    disc,
    lying,
    vessel,
)
from cadplants.model.family import Family, Model
from cadplants.model.standards import FLANGES, PIPES
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import box, cylinder, hexagon, ring
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["PLATES_ALIKE"]

_LEAST_DRILLED = 12  # sides; the holes of a coarser plate would cut its rim


def _ring_of_holes(size: float, inner: float, round_: bool) -> tuple[float, float]:
    """How far out the holes of a plate sit, and their radius [m]."""
    if not round_:
        return 1.05 * size, 0.08 * size
    least = max(inner, 0.6 * size)
    return (size + least) / 2, min(0.08 * size, 0.22 * (size - least))


def _plate(
    size: float, thick: float, round_: bool, count: int, style: ModelingStyle, inner: float = 0.0, bored: bool = False
) -> Solid:
    """A plate about z from 0 up, with holes in a ring and one in its middle where the style drills [m].

    Args:
        size: its radius, or half its side [m].
        thick: how thick it is [m].
        round_: whether it is round.
        count: of holes; a square plate has four.
        style: that models it.
        inner: radius of the pipe at its back; the holes lie outside that [m].
        bored: whether it has a hole of that radius where the style models bores.
    """
    n = style.round(size)
    outline = circle(size, n) if round_ else rounded_rectangle(2 * size, 2 * size, 0.0)
    holes: list[Floats] = [circle(inner, n)] if bored and style.hollow else []
    if style.holes and n >= _LEAST_DRILLED:
        number = count if round_ else 4
        far, radius = _ring_of_holes(size, inner, round_)
        turns = (np.arange(number) + 0.5) * 2 * np.pi / number
        holes += [circle(radius, 8, (far * float(np.cos(turn)), far * float(np.sin(turn)))) for turn in turns]
    return extrude(outline, 0.0, thick, tuple(holes))


def _bolt(t: Table, size: float, count: int, low: float, high: float, round_: bool = True, inner: float = 0.0) -> None:
    """Puts bolts down in a ring through a plate about z [m]."""
    if t.style.fasteners in ("none", "flange"):
        return
    number = count if round_ else 4
    far, radius = _ring_of_holes(size, inner, round_)
    d = 0.85 * radius
    for k in range(number):
        bolt = merge([cylinder(d, low, high, 8), hexagon(3.4 * d, high - 1.6 * d, high)])
        t.spun("z", (k + 0.5) * 2 * np.pi / number).at(far).add("bolt", bolt, own=False)


_GAPS = (0.0, 0.002, 0.004)
_GAP = "between the flange and its lid"


class Based(
    Device, name="post/plate like a flange", group=FRAME, label="post", sizes=(15,), weight=1.5, grain="fitting"
):
    """A post on a round or square plate like a flange, drilled, with anchors."""

    radius: float = between(0.02, 0.08, "of the post", "m")
    height: float = between(0.3, 3.0, "of the post", "m")
    round_: bool = chance(0.5, "its plate is round")
    anchors: int = among((4, 4, 6, 8), "holes of a round plate", when=lambda p: p.round_, otherwise=4)
    thick: float = between(0.008, 0.025, "of the plate", "m")
    size: float = between(1.7, 2.6, "half the width of the plate / radius of the post")
    topped: bool = chance(0.4, "a plate on top too")

    def build(self, t: Table) -> Model:
        r, thick, size = self.radius, self.thick, self.radius * self.size
        plate = _plate(size, thick, self.round_, self.anchors, t.style)
        t.add("base plate", plate)
        bore = 0.88 * r if t.style.hollow else 0.0
        t.at(0, 0, thick).add("post", ring(bore, r, 0.0, self.height, t.n(r)))
        if self.topped:
            t.at(0, 0, thick + self.height).add("plate", plate)
        _bolt(t, size, self.anchors, -0.05, thick + 0.02, self.round_)
        return t.model()


class UprightPipe(
    Device,
    name="pipe/upright between flanges",
    group="Pipe assembly",
    label="pipe",
    sizes=(15,),
    grain="fitting",
):
    """An upright piece of pipe with a flange or a blind flange on top and one below: like a post on its plates."""

    nominal: int = among((40, 50, 80, 100, 150), "nominal size of the pipe", "mm")
    height: float = between(0.3, 2.0, "of the pipe", "m")
    gap: float = among(_GAPS, _GAP, "m")
    lidded: bool = chance(0.7, "a blind flange on top")

    def build(self, t: Table) -> Model:
        pipe, size, high = PIPES[self.nominal], FLANGES[self.nominal], self.height
        rim, thick, count = size.outer / 2, size.thickness, size.n_bolts
        low = _plate(rim, thick, True, count, t.style, pipe.bore, True)
        bore = pipe.bore if t.style.hollow else 0.0
        t.at(0, 0, thick).add("pipe", ring(bore, pipe.radius, 0.0, high, t.n(pipe.radius)))
        t.add("flange", low)
        t.at(0, 0, thick + high).add("flange", low)
        top = 2 * thick + high
        if self.lidded:
            lid = _plate(rim, thick, True, count, t.style, pipe.bore)
            t.at(0, 0, top + self.gap).add("blind flange", lid)
            _bolt(t, rim, count, top - 1.8 * thick, top + self.gap + 1.8 * thick, inner=pipe.bore)
        return t.model()


class Manway(Device, name="manway/neck and lid", group="Tank", label="tank", sizes=(15,), weight=1.2):
    """A vessel or a wide pipe's end with a manway: a wide short neck, its flange and its lid, bolted or not."""

    radius: float = between(0.2, 0.32, "of the neck", "m")
    rise: float = between(0.1, 0.3, "of the neck", "m")
    thick: float = between(0.015, 0.03, "of flange and lid", "m")
    rim: float = between(1.2, 1.35, "radius of the flange / of the neck")
    wide: float = between(1.6, 3.0, "radius of the vessel / of the neck")
    gap: float = among(_GAPS, _GAP, "m")
    gripped: bool = chance(0.5, "a grip on the lid")
    hung: bool = chance(0.4, "a davit for the lid")
    side: bool = chance(0.6, "it is at the vessel's side, not on top")
    apart: bool = chance(0.6, "neck and lid are two meshes")

    def build(self, t: Table) -> Model:
        radius, rise, thick, gap, style = self.radius, self.rise, self.thick, self.gap, t.style
        wide, rim, bore = radius * self.wide, radius * self.rim, 0.94 * radius
        body = moved(vessel(wide, -wide, wide, 0.5 * wide, style), at(0, 0, 1.6 * wide))
        neck = ring(bore if style.hollow else 0.0, radius, -0.3 * wide, rise, t.n(radius))
        plate = moved(_plate(rim, thick, True, 12, style, bore, True), at(0, 0, rise - thick))
        lid = [moved(_plate(rim, thick, True, 12, style, bore), at(0, 0, rise + gap))]
        if self.gripped:
            lid.append(box((0.2, 0.015, 0.05), (0, 0, rise + gap + thick + 0.02)))
        if self.hung:
            lid.append(moved(cylinder(0.015, rise - 0.2, rise + 0.25, 8), at(1.15 * rim)))
            lid.append(box((1.2 * rim, 0.02, 0.02), (0.6 * rim, 0, rise + 0.24)))
        t.bundled("shell").add("shell", body)
        at_side = at(wide * 0.98, 0, 1.6 * wide) @ spun("y", np.pi / 2)
        there = t.bundled("manway").moved(at_side if self.side else at(0, 0, 3.05 * wide))
        for some in [[neck, plate], lid] if self.apart else [[neck, plate, *lid]]:
            there.add("manway", *some)
        _bolt(there, rim, 12, rise - 2 * thick, rise + gap + 2 * thick, inner=bore)
        for x in (-0.55, 0.55):
            for y in (-0.55, 0.55):
                leg = box((0.1, 0.1, 1.2 * wide), (x * wide, y * wide, 0.6 * wide))
                t.bundled("tank leg").add("tank leg", leg, own=True)
        return t.model(kind="tank")


class PlateOnEnd(
    Device,
    name="flange/plate on end",
    place="end",
    group="Pipe assembly",
    label="flange",
    weight=1.5,
    grain="fitting",
):
    """A plate welded to the end of a pipe: a flange with a bore, or a lid, or a base plate of a dummy leg."""

    lidded: bool = chance(0.5, "a blind flange before it")
    gap: float = among(_GAPS, _GAP, "m", when=lambda p: p.lidded, otherwise=0.0)

    def build(self, t: Table) -> Model:
        rim, thick, count, bore = t.flange.outer / 2, t.flange.thickness, t.flange.n_bolts, t.pipe.bore
        t.bundled("flange").add("flange", lying(_plate(rim, thick, True, count, t.style, bore, True)))
        if self.lidded:
            lid = lying(_plate(rim, thick, True, count, t.style, bore), thick + self.gap)
            t.bundled("blind flange").add("blind flange", lid)
        return t.model()


class DummyLeg(
    Device, name="bracket/pipe on plate", place="carrier", group="Connection assembly", label="bracket", grain="fitting"
):
    """A dummy leg: a piece of pipe welded under a line, on a round or square plate."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    leg: float = between(0.5, 0.9, "radius of the leg / of the line")
    thick: float = between(0.008, 0.02, "of the plate", "m")
    round_: bool = chance(0.4, "its plate is round")
    size: float = between(1.6, 2.4, "half the width of the plate / radius of the leg")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        leg, size = r * self.leg, r * self.leg * self.size
        t.add("bracket", disc(leg, -self.height + self.thick, -0.8 * r, t.style), of="pipe")
        t = t.at(0, 0, -self.height)
        t.add("base plate", _plate(size, self.thick, self.round_, 4, t.style))
        _bolt(t, size, 4, -0.04, self.thick + 0.02, self.round_)
        return t.model()


PLATES_ALIKE: tuple[Family, ...] = families_of(Based, UprightPipe, Manway, PlateOnEnd, DummyLeg)
