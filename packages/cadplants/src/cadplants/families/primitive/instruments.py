"""Instruments of primitives: rods with discs, cylinders and boxes, siphons as bent bars."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, given, nested
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    Plates,
    disc,
    lying,
    plated,
    rods,
    torus_piece,
)
from cadplants.model.family import Family, Model
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import box, cylinder, ring
from cadplants.solids.transforms import at, spun

__all__ = ["PRIMITIVE_INSTRUMENTS"]

_STEM, _CASE = "gauge stem", "gauge case"
_FRONT = (0.0, 0.0, 1.0)


class _Case(Params):
    """A round case: solid or a ring, with a face, a needle and a glass or without."""

    ringed: bool = given(False, "an open ring, not solid")
    detailed: bool = chance(0.5, "it may have more than its case", when=lambda p: not p.ringed, otherwise=True)
    deep: float = between(0.35, 0.9, "depth / radius")
    wall: float = between(0.06, 0.2, "thickness of the ring / radius", when=lambda p: p.ringed)
    backed: bool = chance(0.6, "the ring has a back", when=lambda p: p.ringed)
    lipped: bool = chance(0.4, "the ring has a lip", when=lambda p: p.ringed)
    faced: bool = chance(0.5, "it has a face", when=lambda p: p.detailed and not p.ringed, otherwise=True)
    pointed: bool = chance(0.6, "it has a needle", when=lambda p: p.detailed)
    reading: float = between(0, 2 * np.pi, "where that points", "rad", when=lambda p: p.pointed)
    glazed: bool = chance(0.6, "it has a glass", when=lambda p: p.detailed)
    turn: float = between(0, 2 * np.pi, "which way it looks", "rad")

    def build(self, t: Table, radius: float, height: float) -> None:
        """Puts it down upright, its axis at a height [m]."""
        t = t.bundled(_CASE).spun("z", self.turn).at(0, 0.3 * radius, height).spun("x", np.pi / 2)
        deep, wall, n = radius * self.deep, radius * self.wall, t.n(radius)
        floor = 0.0 if self.ringed else deep
        solids = [ring(radius - wall, radius, 0.0, deep, n) if self.ringed else cylinder(radius, 0.0, deep, n)]
        if self.backed:
            floor = 0.2 * deep
            solids.append(cylinder(radius - 0.5 * wall, 0.0, floor, n))
        if self.lipped:
            solids.append(ring(radius - wall, 1.06 * radius, 0.85 * deep, 1.04 * deep, n))
        t.add(_CASE, *solids)
        if not self.detailed:
            return
        inner, thin = radius - wall if self.ringed else 0.92 * radius, max(0.0008, 0.02 * radius)
        if self.faced:
            t.add("gauge face", cylinder(inner, floor, floor + thin, n), front=_FRONT)
        if self.pointed:
            bar = moved(box((0.9 * inner, 0.06 * inner, thin), (0.3 * inner, 0, 0)), spun("z", self.reading))
            hub = cylinder(0.09 * inner, -0.5 * thin, 1.5 * thin, 8)
            t.at(0, 0, floor + 2 * thin).add("gauge needle", bar, hub, front=_FRONT)
        if self.glazed:
            low = max(0.85 * deep if self.ringed else floor, floor + 3.6 * thin)
            t.add("gauge glass", cylinder(inner, low, low + 1.5 * thin, n), of="dial", front=_FRONT)


class _Rod(Params):
    """A rod up from z = 0, at times with a square or a six-sided piece."""

    radius: float = between(0.005, 0.011, "of the rod", "m")
    form: str = among(("plain", "six-sided", "square", "plain"), "piece on it")

    def build(self, t: Table, height: float) -> None:
        """Puts it down up to a height [m]."""
        r = self.radius
        solids = [cylinder(r, 0.0, height, min(t.n(r), 12))]
        if self.form == "six-sided":
            solids.append(cylinder(1.8 * r, 0.1 * height, 0.35 * height, 6))
        elif self.form == "square":
            solids.append(box((2.6 * r, 2.6 * r, 0.35 * height), (0, 0, 0.6 * height)))
        t.bundled(_STEM).add(_STEM, *solids, of="trim")


class _OnRod(Params):
    """A rod and a round case upright on it."""

    ringed: bool = given(False, "its case is an open ring")
    radius: float = among((0.025, 0.0315, 0.05, 0.05, 0.08), "of the case", "m")
    rise: float = between(0.02, 0.1, "height of the case's underside", "m")
    case: _Case = nested(_Case, "case", fixed=lambda p: {"ringed": p.ringed})
    rod: _Rod = nested(_Rod, "rod")

    def build(self, t: Table) -> None:
        """Puts it down on z = 0."""
        self.rod.build(t, self.rise + 0.1 * self.radius)
        self.case.build(t, self.radius, self.rise + self.radius)


class _Instrument(Device, place="tap", group="Gauge assembly", label="gauge"):
    """An instrument of primitives."""


class RodAndDisc(_Instrument, name="gauge/rod and disc", weight=3):
    """A rod and a round case upright on it."""

    gauge: _OnRod = nested(_OnRod, "gauge", fixed=lambda _: {"ringed": False})

    def build(self, t: Table) -> Model:
        self.gauge.build(t)
        return t.model(kind="pressure gauge")


class RingCase(RodAndDisc, name="gauge/ring case", weight=2):
    """A rod and a ring upright on it."""

    gauge: _OnRod = nested(_OnRod, "gauge", fixed=lambda _: {"ringed": True})


class BentBar(_Instrument, name="siphon/bent bar"):
    """A bent bar as a U siphon, with a gauge of a rod and a case on its end, or only a screwed end."""

    looped: ClassVar[bool] = False

    radius: float = between(0.005, 0.0105, "of the bar", "m")
    bend: float = between(3.0, 5.5, "radius of its bends / of the bar")
    high: float = between(0.08, 0.2, "height of its bends", "m")
    nut: bool = chance(0.5, "a nut at its end")
    ringed: bool = chance(0.5, "the gauge's case is an open ring")
    gauge: _OnRod = nested(_OnRod, "gauge", fixed=lambda p: {"ringed": p.ringed})
    # A hair of air or of overlap, as screwed pieces are drawn.
    gap: float = among((0.0, 0.0, -0.004), "between the bar and the gauge", "m")

    def build(self, t: Table) -> Model:
        r, path = self.radius, self._path()
        solids = [torus_piece(path, r, min(t.n(r), 16), 0.7 * r if t.style.hollow else 0.0)]
        x, y, z = (float(v) for v in path[-1])
        if self.nut:
            solids.append(moved(cylinder(1.7 * r, -0.02, 0.0, 6), at(x, y, z)))
        t.bundled("siphon").add("siphon", *solids)
        self.gauge.build(t.at(x, y, z + self.gap))
        return t.model(kind="pressure gauge")

    def _path(self) -> Floats:
        """The middle line from the origin up [m]."""
        reach, high = self.radius * self.bend, self.high
        if self.looped:
            turns = np.linspace(np.pi, -np.pi, 17)
            low = 0.3 * high + reach
            aside = np.linspace(0, 0.8 * reach, 17)
            loop = np.column_stack([reach + reach * np.cos(turns), aside, low + reach * np.sin(turns)])
            return np.vstack([[(0.0, 0.0, 0.0)], loop, [(0.0, 0.8 * reach, low + reach + 0.4 * high)]])
        first, second = np.linspace(np.pi, 0.0, 7), np.linspace(np.pi, 2 * np.pi, 7)
        over = np.column_stack([reach + reach * np.cos(first), np.zeros(7), high + reach * np.sin(first)])
        under = np.column_stack([3 * reach + reach * np.cos(second), np.zeros(7), 0.4 * high + reach * np.sin(second)])
        return np.vstack([[(0.0, 0.0, 0.0)], over, under, [(4 * reach, 0.0, 1.3 * high)]])


class LoopedBar(BentBar, name="siphon/looped bar"):
    """A bent bar as a pigtail, with a gauge of a rod and a case on its end, or only a screwed end."""

    looped = True


class Transmitter(_Instrument, name="transmitter/cylinder or box", label="transmitter", weight=1.5):
    """A rod with a level cylinder or a box on it."""

    rise: float = between(0.03, 0.12, "height of the head's underside", "m")
    size: float = between(0.03, 0.06, "half the height of the head", "m")
    round_: bool = chance(0.6, "the head is a cylinder")
    boxed: bool = chance(0.4, "a box under the head")
    rod: _Rod = nested(_Rod, "rod")

    def build(self, t: Table) -> Model:
        rise, size = self.rise, self.size
        if self.round_:
            solids = [lying(disc(size, -1.1 * size, 1.1 * size, t.style), 0, 0, rise + size)]
        else:
            solids = [box((2 * size, 1.4 * size, 2 * size), (0, 0, rise + size))]
        if self.boxed:
            solids.append(box((1.6 * size, 1.2 * size, 0.5 * rise), (0, 0, 0.6 * rise)))
        self.rod.build(t, rise + 0.2 * size)
        t.bundled("transmitter").add("transmitter", *solids, of="gauge")
        return t.model(kind="pressure transmitter")


class Thermowell(_Instrument, name="thermowell/rod", label="thermowell", bundle="thermowell"):
    """A rod with a short wide cylinder or a dome-less head across it."""

    rise: float = between(0.05, 0.18, "height of the rod", "m")
    size: float = between(0.025, 0.045, "radius of the head", "m")
    rod: float = between(0.006, 0.012, "radius of the rod", "m")
    turn: float = among((0.0, 0.3, 0.5), "of the head from upright / half a turn")

    def build(self, t: Table) -> Model:
        size = self.size
        t.add("thermowell", disc(self.rod, 0.0, self.rise, t.style), of="gauge")
        head, lift = (disc(size, -0.7 * size, 0.7 * size, t.style), 0.5 * size) if self.turn else (None, 0.0)
        head = head or disc(size, 0.0, 1.4 * size, t.style)
        t.at(0, 0, self.rise + lift).spun("y", self.turn * np.pi).add("transmitter", head, of="gauge")
        return t.model()


class MeterCylinder(
    _Instrument,
    name="flow meter/cylinder",
    place="inline",
    label="flow meter",
    bundle="flow meter",
    sizes=sizes_between(15, 300),
    weight=3,
):
    """A cylinder along the line, at times with discs at its ends or a housing round it, a box or cylinder on a neck."""

    length: float = between(0.8, 1.6, "(face to face - 40 mm) / outside of the flange")
    wide: float = between(1.0, 1.5, "radius / of the pipe")
    size: float = between(0.04, 0.09, "half the width of the head", "m")
    round_: bool = chance(0.5, "the head is a cylinder")
    plates: Plates = plated()
    housed: bool = chance(0.5, "a wider housing round its middle")
    housing: float = between(1.35, 2.2, "radius of the housing / of the pipe", when=lambda p: p.housed, otherwise=0.0)
    share: float = between(0.4, 0.75, "length of the housing / face to face", when=lambda p: p.housed, otherwise=0.0)
    turn: float = among((0.0, 0.5, 1.0), "of a cylinder for its head from along the line / half a turn")

    def build(self, t: Table) -> Model:
        length, size, style = round(t.flange.outer * self.length + 0.04, 6), self.size, t.style
        wide = t.pipe.radius * self.wide
        housing = max(wide, t.pipe.radius * self.housing)
        top = housing + 1.6 * size
        solids = [lying(disc(wide, 0.0, length, style)), *self.plates.solids(t, length)]
        if self.housed:
            low = 0.5 * length * (1 - self.share)
            solids.append(lying(disc(housing, low, length - low, style)))
        t.add("flow meter", *solids)
        neck = disc(0.35 * size, 0.0, housing + size, style)
        t.at(length / 2).add("transmitter", neck, self._head(t, top), of="gauge")
        return t.model(length, kind="flow meter")

    def _head(self, t: Table, z: float) -> Solid:
        """A box, or a cylinder upright or level, about a height [m]."""
        size = self.size
        if not self.round_:
            return box((2 * size, 1.5 * size, 1.6 * size), (0, 0, z))
        if self.turn == 1.0:
            return disc(size, z - 0.8 * size, z + 0.8 * size, t.style)
        return moved(lying(disc(0.8 * size, -size, size, t.style), 0, 0, z), spun("z", self.turn * np.pi))


class _Sight(_Instrument, place="inline", label="sight glass", bundle="sight glass", weight=0.8):
    """A sight glass of primitives."""


class CrossedSight(_Sight, name="sight glass/crossed cylinders"):
    """A cylinder along the line with a short one across."""

    length: float = between(0.8, 1.3, "face to face / outside of the flange")
    wide: float = between(1.0, 1.3, "radius / of the pipe")
    plates: Plates = plated()

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(t.flange.outer * self.length, 6)
        across = moved(disc(0.9 * r, -1.5 * r, 1.5 * r, t.style), at(length / 2) @ spun("x", np.pi / 2))
        run = [lying(disc(r * self.wide, 0.0, length, t.style)), across, *self.plates.solids(t, length)]
        t.add("sight glass", merge(run), of="gauge")
        return t.model(length, kind="sight glass")


class RoddedSight(_Sight, name="sight glass/cylinder between rods"):
    """A cylinder of glass between two thick rings, held by rods all round."""

    length: float = between(0.8, 1.6, "face to face / outside of the flange")
    wide: float = between(1.0, 1.3, "radius of the glass / of the pipe")
    ring: float = between(1.5, 2.2, "radius of the rings / of the pipe")
    thick: float = between(0.06, 0.14, "of a ring / face to face")
    inset: float = among((0.0, 0.0, 0.14), "of the rings from the ends / face to face")
    rods: int = among((3, 4, 4, 6), "rods")

    def build(self, t: Table) -> Model:
        r, length, style = t.pipe.radius, round(t.flange.outer * self.length, 6), t.style
        ring, thick, low = r * self.ring, length * self.thick, length * self.inset
        solids = [disc(r * self.wide, low, length - low, style)]
        solids += [disc(ring, z, z + thick, style) for z in (low, length - low - thick)]
        if low:
            solids.append(disc(r, 0.0, length, style))
        solids += rods(self.rods, 0.86 * ring, 0.07 * ring + 0.002, low, length - low, style)
        t.add("sight glass", merge([lying(one) for one in solids]), of="gauge")
        return t.model(length, kind="sight glass")


class LevelRod(_Instrument, name="level gauge/rod", place="floor", label="level gauge", bundle="level gauge"):
    """An upright rod or box beside two level stubs, on a plate or a post."""

    high: float = between(0.4, 1.5, "height of the rod", "m")
    radius: float = between(0.012, 0.03, "of the rod", "m")
    low: float = between(0.2, 0.8, "height of its foot", "m")
    round_: bool = chance(0.6, "it is no box")

    def build(self, t: Table) -> Model:
        high, r, low = self.high, self.radius, self.low
        upright = box((2 * r, 3 * r, high), (0, 0, low + high / 2))
        if self.round_:
            upright = disc(r, low, low + high, t.style)
        arms = [lying(disc(0.6 * r, -0.2, 0.0, t.style), 0, 0, low + share * high) for share in (0.1, 0.9)]
        t.add("level gauge", upright, *arms, of="gauge")
        t.add("post", box((0.05, 0.05, low + high + 0.1), (-0.225, 0, (low + high + 0.1) / 2)))
        return t.model(kind="level gauge")


PRIMITIVE_INSTRUMENTS: tuple[Family, ...] = families_of(
    RodAndDisc,
    RingCase,
    BentBar,
    LoopedBar,
    Transmitter,
    Thermowell,
    MeterCylinder,
    CrossedSight,
    RoddedSight,
    LevelRod,
)
