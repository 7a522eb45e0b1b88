"""Instruments of primitives: rods with discs, cylinders and boxes, siphons as bent bars."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import disc, lying, sized, torus_piece
from cadplants.family import Model
from cadplants.mesh_ops import moved
from cadplants.primitives import along, box, cylinder, ring
from cadplants.standards import SIZES
from cadplants.transforms import at, spun

__all__ = ["PRIMITIVE_INSTRUMENTS"]

_STEM, _CASE = "gauge stem", "gauge case"
_FRONT = (0.0, 0.0, 1.0)


class _Instrument(Device, place="tap", group="Gauge assembly", label="gauge", bundle=_CASE, sizes=SIZES):
    """An instrument of primitives."""


class _Case(Params):
    """A round case about z: solid or a ring, with a face, a needle and a glass or without."""

    ringed: bool = given(False, "the case is an open ring, with a back or without")
    detailed: bool = given(True, "may have more than its case")
    deep: float = between(0.35, 0.9, "depth / radius")
    wall: float = between(0.06, 0.2, "thickness of the ring / radius")
    back: bool = chance(0.6, "a back in the ring", when=lambda p: p.ringed)
    lip: bool = chance(0.4, "a bezel on the ring", when=lambda p: p.ringed)
    faced: bool = chance(0.5, "a face", when=lambda p: p.detailed and not p.ringed, otherwise=True)
    needled: bool = chance(0.6, "a needle", when=lambda p: p.detailed)
    reading: float = between(0, 2 * np.pi, "where it points", "rad", when=lambda p: p.needled)
    glazed: bool = chance(0.6, "a glass", when=lambda p: p.detailed)

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, its back on z = 0, its front towards +z, of a radius [m]."""
        deep, wall, n, t = radius * self.deep, radius * self.wall, t.n(radius), t.bundled(_CASE)
        inner, thin, floor = radius - wall if self.ringed else 0.92 * radius, max(0.0008, 0.02 * radius), deep
        if self.ringed:
            floor, solids = 0.2 * deep if self.back else 0.0, [ring(radius - wall, radius, 0.0, deep, n)]
            solids += [cylinder(radius - 0.5 * wall, 0.0, floor, n)] if self.back else []
            solids += [ring(radius - wall, 1.06 * radius, 0.85 * deep, 1.04 * deep, n)] if self.lip else []
            t.add(_CASE, *solids)
        else:
            t.add(_CASE, cylinder(radius, 0.0, deep, n))
        if self.detailed and self.faced:
            t.add("gauge face", cylinder(inner, floor, floor + thin, n), front=_FRONT)
        if self.needled:
            bar = moved(box((0.9 * inner, 0.06 * inner, thin), (0.3 * inner, 0, 0)), spun("z", self.reading))
            hub = cylinder(0.09 * inner, -0.5 * thin, 1.5 * thin, 8)
            t.at(0, 0, floor + 2 * thin).add("gauge needle", bar, hub, front=_FRONT)
        if self.glazed:
            low = max(0.85 * deep if self.ringed else floor, floor + 3.6 * thin)
            t.add("gauge glass", cylinder(inner, low, low + 1.5 * thin, n), front=_FRONT)


class _Stem(Params):
    """A rod up from z = 0, at times with a square or a six-sided piece."""

    radius: float = between(0.005, 0.011, "of the rod", "m")
    form: int = whole(0, 3, "1: a six-sided piece on it, 2: a square one")

    def build(self, t: Table, height: float) -> None:
        """Puts it down, this high [m]."""
        r = self.radius
        more = {1: [cylinder(1.8 * r, 0.1 * height, 0.35 * height, 6)]}
        more[2] = [box((2.6 * r, 2.6 * r, 0.35 * height), (0, 0, 0.6 * height))]
        t.bundled(_STEM).add(_STEM, cylinder(r, 0.0, height, t.n(r, most=12)), *more.get(self.form, ()))


class _Upright(Params):
    """A rod and a round case upright on it."""

    ringed: bool = given(False, "the case is an open ring")
    radius: float = among((0.025, 0.0315, 0.05, 0.05, 0.08), "of the case", "m")
    rise: float = between(0.02, 0.1, "height of the rod", "m")
    detailed: bool = chance(0.5, "may have more than its case", when=lambda p: not p.ringed, otherwise=True)
    case: _Case = nested(lambda s, p: _Case.draw(s, {"ringed": p.ringed, "detailed": p.detailed}), "case")
    turn: float = between(0, 2 * np.pi, "which way it looks", "rad")
    stem: _Stem = nested(_Stem, "rod")

    def build(self, t: Table) -> Model:
        """Puts it down."""
        self.stem.build(t, self.rise + 0.1 * self.radius)
        up = t.spun("z", self.turn).at(0, 0.3 * self.radius, self.rise + self.radius).along("-y")
        self.case.build(up, self.radius)
        return t.model(kind="pressure gauge")


class RodAndDisc(_Instrument, name="gauge/rod and disc", weight=3):
    """A rod and a round case upright on it."""

    gauge: _Upright = nested(_Upright, "gauge")

    def build(self, t: Table) -> Model:
        return self.gauge.build(t)


class RingCase(_Instrument, name="gauge/ring case", weight=2):
    """A rod and an open ring as a case upright on it."""

    gauge: _Upright = nested(lambda s, _: _Upright.draw(s, {"ringed": True}), "gauge")

    def build(self, t: Table) -> Model:
        return self.gauge.build(t)


class _Siphon(_Instrument):
    """A bent bar as a siphon, with a gauge of a rod and a case on its end, or only a screwed end."""

    radius: float = between(0.005, 0.0105, "of the bar", "m")
    reach: float = between(3.0, 5.5, "radius of its bends / of the bar")
    high: float = between(0.08, 0.2, "height of its first bend", "m")
    ended: bool = chance(0.5, "a six-sided end")
    ringed: bool = chance(0.5, "the gauge's case is an open ring")
    gauge: _Upright = nested(lambda s, p: _Upright.draw(s, {"ringed": p.ringed}), "gauge")
    # A hair of air or of overlap, as screwed pieces are drawn.
    gap: float = among((0.0, 0.0, -0.004), "between siphon and gauge", "m")

    def build(self, t: Table) -> Model:
        r, path = self.radius, self.path(self.radius * self.reach, self.high)
        bar = torus_piece(path, r, min(t.style.round(r), 16), 0.7 * r if t.style.hollow else 0.0)
        x, y, z = (float(v) for v in path[-1])
        end = [moved(cylinder(1.7 * r, -0.02, 0.0, 6), at(x, y, z))] if self.ended else []
        t.bundled("siphon").add("siphon", bar, *end)
        return self.gauge.build(t.at(x, y, z + self.gap))

    def path(self, reach: float, high: float) -> Floats:
        """The middle line of the siphon from the origin up [m]."""
        raise NotImplementedError


class BentBar(_Siphon, name="siphon/bent bar"):
    """A bent bar as a U siphon, with a gauge of a rod and a case on its end."""

    def path(self, reach: float, high: float) -> Floats:
        first, second, flat = np.linspace(np.pi, 0.0, 7), np.linspace(np.pi, 2 * np.pi, 7), np.zeros(7)
        over = np.column_stack([reach + reach * np.cos(first), flat, high + reach * np.sin(first)])
        under = np.column_stack([3 * reach + reach * np.cos(second), flat, 0.4 * high + reach * np.sin(second)])
        return np.vstack([[(0.0, 0.0, 0.0)], over, under, [(4 * reach, 0.0, 1.3 * high)]])


class LoopedBar(_Siphon, name="siphon/looped bar"):
    """A bar with a loop as a siphon, with a gauge of a rod and a case on its end."""

    def path(self, reach: float, high: float) -> Floats:
        turns, low, aside = np.linspace(np.pi, -np.pi, 17), 0.3 * high + reach, np.linspace(0, 0.8 * reach, 17)
        loop = np.column_stack([reach + reach * np.cos(turns), aside, low + reach * np.sin(turns)])
        return np.vstack([[(0.0, 0.0, 0.0)], loop, [(0.0, 0.8 * reach, low + reach + 0.4 * high)]])


class Transmitter(
    _Instrument, name="transmitter/cylinder or box", label="transmitter", bundle="transmitter", weight=1.5
):
    """A rod with a level cylinder or a box on it."""

    rise: float = between(0.03, 0.12, "height of the rod", "m")
    size: float = between(0.03, 0.06, "radius of the head", "m")
    disc: bool = chance(0.6, "its head is a cylinder, not a box")
    based: bool = chance(0.4, "a box under the head")
    stem: _Stem = nested(_Stem, "rod")

    def build(self, t: Table) -> Model:
        rise, size = self.rise, self.size
        self.stem.build(t, rise + 0.2 * size)
        if self.disc:
            head = lying(disc(size, -1.1 * size, 1.1 * size, t.style), 0, 0, rise + size)
        else:
            head = box((2 * size, 1.4 * size, 2 * size), (0, 0, rise + size))
        base = [box((1.6 * size, 1.2 * size, 0.5 * rise), (0, 0, 0.6 * rise))] if self.based else []
        t.add("transmitter", head, *base, of="gauge")
        return t.model(kind="pressure transmitter")


class Thermowell(_Instrument, name="thermowell/rod", label="thermowell", bundle="thermowell"):
    """A rod with a short wide cylinder or a dome-less head across it."""

    rise: float = between(0.05, 0.18, "height of the rod", "m")
    size: float = between(0.025, 0.045, "radius of the head", "m")
    radius: float = between(0.006, 0.012, "of the rod", "m")
    lean: float = among((0.0, 0.3, 0.5), "of the head, in half turns")

    def build(self, t: Table) -> Model:
        size, low, high, z = self.size, 0.0, 1.4 * self.size, self.rise
        if self.lean:
            low, high, z = -0.7 * size, 0.7 * size, z + 0.5 * size
        t.add("thermowell", disc(self.radius, 0.0, self.rise, t.style), of="gauge")
        t.at(0, 0, z).spun("y", self.lean * np.pi).add("transmitter", disc(size, low, high, t.style), of="gauge")
        return t.model()


class Meter(
    _Instrument, name="flow meter/cylinder", place="inline", label="flow meter", bundle="flow meter",
    sizes=sized(15, 300), weight=2,
):  # fmt: skip
    """A cylinder along the line with a box or a cylinder on a neck."""

    long: float = between(0.8, 1.6, "its length less 40 mm / diameter of a flange")
    wide: float = between(1.0, 1.5, "its radius / of the pipe")
    size: float = between(0.04, 0.09, "half width of the head", "m")
    disc: bool = chance(0.5, "its head is a cylinder, not a box")

    def build(self, t: Table) -> Model:
        size, wide, length = self.size, t.pipe.radius * self.wide, round(t.flange.outer * self.long + 0.04, 6)
        head = box((2 * size, 1.5 * size, 1.6 * size), (0, 0, wide + 1.6 * size))
        if self.disc:
            head = lying(disc(0.8 * size, -size, size, t.style), 0, 0, wide + 1.6 * size)
        t.add("flow meter", lying(disc(wide, 0.0, length, t.style)))
        t.at(length / 2).add("transmitter", disc(0.35 * size, 0.0, wide + size, t.style), head, of="gauge")
        return t.model(length, kind="flow meter")


class Sight(
    _Instrument, name="sight glass/crossed cylinders", place="inline", label="sight glass", bundle="sight glass",
    weight=0.6,
):  # fmt: skip
    """A cylinder along the line with a short one across."""

    long: float = between(0.8, 1.3, "its length / diameter of a flange")
    wide: float = between(1.0, 1.3, "its radius / of the pipe")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(t.flange.outer * self.long, 6)
        across = along("-y", disc(0.9 * r, -1.5 * r, 1.5 * r, t.style), length / 2)
        t.add("sight glass", lying(disc(r * self.wide, 0.0, length, t.style)), across, of="gauge")
        return t.model(length, kind="sight glass")


class Level(_Instrument, name="level gauge/rod", place="floor", label="level gauge", bundle="level gauge"):
    """An upright rod or box beside two level stubs, on a plate or a post."""

    high: float = between(0.4, 1.5, "height of the column", "m")
    radius: float = between(0.012, 0.03, "of the column", "m")
    low: float = between(0.2, 0.8, "of the column over the floor", "m")
    disc: bool = chance(0.6, "its column is round")

    def build(self, t: Table) -> Model:
        high, r, low = self.high, self.radius, self.low
        column = box((2 * r, 3 * r, high), (0, 0, low + high / 2))
        if self.disc:
            column = disc(r, low, low + high, t.style)
        arms = [lying(disc(0.6 * r, -0.2, 0.0, t.style), 0, 0, low + share * high) for share in (0.1, 0.9)]
        t.add("level gauge", column, *arms, of="gauge")
        t.add("post", box((0.05, 0.05, low + high + 0.1), (-0.225, 0, (low + high + 0.1) / 2)))
        return t.model(kind="level gauge")


PRIMITIVE_INSTRUMENTS = families_of(
    RodAndDisc, RingCase, BentBar, LoopedBar, Transmitter, Thermowell, Meter, Sight, Level
)
