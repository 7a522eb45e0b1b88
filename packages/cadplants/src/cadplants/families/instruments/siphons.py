"""Siphons under gauges and switches (DIN 16282 forms and others), each in one construction, on an outlet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.dials import STEM, Housing, Indicator, Shank, StandingGauge, fine_sides, upright
from cadplants.builder.params import Params, among, between, chance, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import bent, t_handle
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, rope, turned
from cadplants.solids.transforms import at

__all__ = ["SIPHONS"]

_TUBES = (0.0053, 0.0068, 0.0086, 0.0107)  # m, radii of steam siphon pipes, 1/4 to 1/2 in
_ABOUT_TUBE = "radius of its pipe"


def _arc(center: tuple[float, float], radius: float, first: float, last: float, drift: float = 0.0) -> Floats:
    """Points round an axis along y from one angle to another, moving on along it by ``drift`` [m, rad]."""
    count = max(5, int(np.ceil(abs(last - first) / (np.pi / 8))) + 1)
    t = np.linspace(first, last, count)
    x, z = center[0] + radius * np.cos(t), center[1] + radius * np.sin(t)
    return np.column_stack([x, drift * np.linspace(0, 1, count), z])


def _joined(*pieces: Floats | list[tuple[float, float, float]]) -> Floats:
    path = np.vstack([np.asarray(p, float) for p in pieces])
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-5])
    return np.asarray(path[keep])


class _Top(Params):
    """What is at the foot of a siphon, and what its end carries."""

    foot: str = among(("hexagon", "sleeve", "valve", "bare"), "what is at its foot")
    metal: str = among(("trim", "pipe", "gauge"), "kind of material")
    head: str = weighted("what its end carries", gauge=0.72, transmitter=0.14, switch=0.14)
    gauge: StandingGauge = nested(StandingGauge, "gauge", when=lambda p: p.head == "gauge")
    housing: Housing = nested(Housing, "electronics", when=lambda p: p.head == "transmitter")
    indicator: Indicator = nested(Indicator, "case of a switch", when=lambda p: p.head == "switch")

    def build(self, t: Table, path: Floats, r: float, more: Sequence[Solid] = ()) -> Model:
        """Puts a siphon down along a path that ends upwards, with what its end carries."""
        x, y, z = (float(v) for v in path[-1])
        n = fine_sides(r, t.style)
        feet = {
            "hexagon": [hexagon(3.2 * r, 0.002, 0.018)],
            "sleeve": [cylinder(1.4 * r, 0.002, 0.024, n)],
            "valve": [
                box((3.4 * r, 3.4 * r, 0.03), (0, 0, 0.018)),
                along("-y", t_handle(0.05, 0.045), 0, -1.6 * r, 0.018),
            ],
        }
        nut = [hexagon(2 * r + 0.013, z - 0.022, z), cylinder(1.25 * r, z - 0.034, z - 0.02, n)]
        pipe = rope(path, r, fine_sides(r, t.style, 12))
        t.add("siphon", pipe, *feet.get(self.foot, ()), moved(merge(nut), at(x, y)), *more, of=self.metal)
        t = t.at(x, y)
        if self.head == "gauge":
            self.gauge.build(t, z)
            return t.model(kind="pressure gauge")
        neck = cylinder(0.011, z - 0.002, z + 0.05, 12)
        if self.head == "transmitter":
            electronics = moved(self.housing.solid(t.style), at(0, 0, z + 0.046))
            t.bundled("transmitter").add("transmitter", neck, hexagon(0.027, z + 0.004, z + 0.018), electronics)
            return t.model(kind="pressure transmitter")
        t.bundled(STEM).add(STEM, neck)
        self.indicator.build(upright(t, 0.1, z + 0.048, 0.06), 0.08, 0.1, 0.06)
        return t.model(kind="pressure switch")


class _Siphon(Device, place="tap", group="Gauge assembly", label="gauge", bundle="siphon", sizes=(15,), weight=1.5):
    """A siphon."""


class Pigtail(_Siphon, name="siphon/pigtail"):
    """A pigtail: the pipe goes up, makes a ring or two about a level axis and goes on upwards (DIN 16282 form C)."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    rings: int = among((1, 1, 2), "rings")
    reach: float = between(3.6, 6.5, "radius of the ring / of the pipe")
    foot: float = between(0.015, 0.05, "height of the ring over the outlet", "m")
    rise: float = between(0.04, 0.12, "from the ring to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, turns, reach = self.tube, self.rings, self.reach * self.tube
        low, aside = reach + r + self.foot, 2.3 * r * turns
        loop = _arc((reach, low), reach, np.pi, np.pi - 2 * np.pi * turns, aside)
        return self.top.build(t, _joined([(0, 0, 0)], loop, [(0.0, aside, low + reach + self.rise)]), r)


class UShaped(_Siphon, name="siphon/u"):
    """A U siphon: up, over, down and up again in one plane (DIN 16282 form A or B)."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    first: float = between(3, 5, "radius of the bend over / of the pipe")
    second: float = between(3, 7, "radius of the bend below / of the pipe")
    high: float = between(0.08, 0.2, "height of the first bend", "m")
    low: float = between(-0.02, 0.3, "depth of the second / height of the first")
    over: float = between(-0.02, 0.12, "how far the end stands over the first bend", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, first, second, high = self.tube, self.first * self.tube, self.second * self.tube, self.high
        low = self.low * high + second + r
        over = _arc((first, high), first, np.pi, 0.0)
        under = _arc((2 * first + second, low), second, np.pi, 2 * np.pi)
        end = [(2 * (first + second), 0.0, max(high + self.over, low + 0.07))]
        return self.top.build(t, _joined([(0, 0, 0)], over, under, end), r)


class Trumpet(_Siphon, name="siphon/trumpet"):
    """A trumpet: the pipe leaves sideways, makes one and a quarter rings and ends upwards (DIN 16282 form D)."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    reach: float = between(3.6, 6, "radius of the ring / of the pipe")
    low: float = between(0.03, 0.07, "height of the first bend", "m")
    out: float = between(0.5, 2.0, "level part / radius of the ring")
    rise: float = between(0.06, 0.12, "from the middle of the ring to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, reach, bend, low = self.tube, self.reach * self.tube, 3.2 * self.tube, self.low
        turn = _arc((bend, low), bend, np.pi, np.pi / 2)
        x, z = bend + self.out * reach + reach * 0.2, low + bend + reach
        loop = _arc((x, z), reach, -np.pi / 2, 2 * np.pi, 2.6 * r)
        return self.top.build(t, _joined([(0, 0, 0)], turn, loop, [(x + reach, 2.6 * r, z + self.rise)]), r)


class Coil(_Siphon, name="siphon/coil"):
    """A straight siphon with a cooling coil of several turns about its own upright axis."""

    tube: float = among(_TUBES[:3], _ABOUT_TUBE, "m")
    turns: int = whole(3, 6, "turns of the coil")
    reach: float = between(3.0, 5.5, "radius of the coil / of the pipe")
    pitch: float = between(2.1, 3.0, "pitch of the coil / radius of the pipe")
    low: float = between(0.03, 0.07, "height of the coil", "m")
    rise: float = between(0.04, 0.09, "from the coil to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, reach, low = self.tube, self.reach * self.tube, self.low
        a = np.linspace(0, 2 * np.pi * self.turns, 12 * self.turns + 1)
        z = low + 0.012 + self.pitch * r * a / (2 * np.pi)
        helix, high = np.column_stack([reach * np.cos(a), reach * np.sin(a), z]), float(z[-1])
        end = high + 0.02 + r
        start = [(0, 0, 0), (0, 0, low - 2 * r), (0.25 * reach, -0.3 * reach, low)]
        start.append((0.8 * reach, -0.55 * reach, low + 0.006))
        last = [(0.8 * reach, 0.55 * reach, high + 0.006), (0.25 * reach, 0.3 * reach, high + 0.012)]
        return self.top.build(t, _joined(start, helix, last, [(0, 0, end), (0.0, 0.0, end + self.rise)]), r)


class Finned(_Siphon, name="siphon/finned"):
    """A cooling element: a straight pipe with round or square fins, or a finned sleeve, under a gauge."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    fins: int = whole(5, 13, "fins")
    low: float = between(0.025, 0.05, "height of the first fin", "m")
    pitch: float = between(0.005, 0.009, "from fin to fin", "m")
    wide: float = between(1.8, 3.2, "radius of a fin / of the pipe")
    square: bool = chance(0.3, "fins are square")
    rise: float = between(0.03, 0.07, "from the last fin to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, low, pitch, wide = self.tube, self.low, self.pitch, self.wide * self.tube
        heights = [low + k * pitch for k in range(self.fins)]
        if self.square:
            fins = [box((2 * wide, 2 * wide, 0.4 * pitch), (0, 0, z + 0.5 * pitch)) for z in heights]
        else:
            steps = [(1.3 * r, z, wide, z, wide, z + 0.45 * pitch, 1.3 * r, z + 0.45 * pitch) for z in heights]
            fins = [turned([point for step in steps for point in outline(*step)], t.n(wide, most=24))]
        return self.top.build(t, np.array([(0, 0, 0), (0, 0, low + self.fins * pitch + self.rise)]), r, fins)


class Bent(_Siphon, name="siphon/bent"):
    """A bent pipe: two elbows that set a gauge off to the side, or a swan neck with a small drop."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    out: float = between(0.06, 0.2, "how far aside", "m")
    low: float = between(0.05, 0.1, "height of the first bend", "m")
    rise: float = between(0.05, 0.14, "from the second bend to the end", "m")
    elbows: bool = chance(0.6, "two bends, not a swan neck")
    screwed: bool = chance(0.4, "screwed elbows in place of bends", when=lambda p: p.elbows)
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, out, low, rise, bend = self.tube, self.out, self.low, self.rise, 3.0 * self.tube
        if not self.elbows:
            x, high = 1.6 * out, low + rise
            neck = [(0, 0, 0), (0, 0, high), (out, 0, high), (out, 0, low), (x, 0, low), (x, 0, high + 0.05)]
            return self.top.build(t, np.array([(x, 0, high), (x, 0, high + 0.05)]), r, [bent(neck, r, t.style)])
        first = _arc((bend, low), bend, np.pi, np.pi / 2)
        second = _arc((out, low + 2 * bend), bend, -np.pi / 2, 0.0)
        path = _joined([(0, 0, 0)], first, second, [(out + bend, 0, low + 2 * bend + rise)])
        places = ((0, low), (out + bend, low + 2 * bend)) if self.screwed else ()
        return self.top.build(t, path, r, [moved(hexagon(3.4 * r, z - 0.01, z + 0.004), at(x)) for x, z in places])


class Capsule(_Siphon, name="siphon/capsule"):
    """A compact siphon: a closed chamber with an inner pipe, a can, a ball or two welded cups between two nipples."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    wide: float = between(0.018, 0.034, "radius of the chamber", "m")
    low: float = between(0.025, 0.045, "height of the chamber over the outlet", "m")
    tall: float = between(0.05, 0.12, "height of the chamber itself", "m")
    form: int = whole(0, 2, "a can, a ball, two cups bolted together")
    rise: float = between(0.035, 0.06, "from the chamber to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, wide, low, tall, n = self.tube, self.wide, self.low, self.tall, t.n(self.wide)
        half, end = low + tall / 2, low + tall + 0.3 * wide
        if self.form == 0:
            can = turned(outline(r, low, wide, low + 0.3 * wide, wide, low + tall, r, end), n)
        elif self.form == 1:
            a = np.linspace(-1.2, 1.2, 9)
            can = turned(list(zip(wide * np.cos(a), half + tall * 0.55 * np.sin(a), strict=True)), n)
        else:
            can = merge([cylinder(wide, low, low + tall, n), cylinder(1.15 * wide, half - 0.004, half + 0.004, n)])
            can = merge([can, around(hexagon(0.01, half - 0.008, half + 0.008), 6, 1.02 * wide)])
        return self.top.build(t, np.array([(0, 0, 0), (0, 0, end + self.rise)]), r, [can])


class LevelRing(_Siphon, name="siphon/level ring"):
    """A pigtail that lies on its side behind an elbow: its ring is level, the gauge rises from its far end."""

    tube: float = among(_TUBES[:3], _ABOUT_TUBE, "m")
    reach: float = between(4, 6, "radius of the ring / of the pipe")
    low: float = between(0.05, 0.09, "height of the elbow", "m")
    out: float = between(0.02, 0.06, "from the elbow to the ring", "m")
    rise: float = between(0.05, 0.1, "from the ring to the end", "m")
    top: _Top = nested(_Top, "foot and head")

    def build(self, t: Table) -> Model:
        r, reach, bend = self.tube, self.reach * self.tube, 3 * self.tube
        first = _arc((bend, self.low), bend, np.pi, np.pi / 2)
        a = np.linspace(-np.pi / 2, 1.5 * np.pi, 17)
        far, z = bend + self.out, self.low + bend
        rise = z + 2.3 * r * (a - a[0]) / (2 * np.pi)
        ring = np.column_stack([far + reach * np.cos(a), reach + reach * np.sin(a), rise])
        x, z = far + 0.03 + reach, z + 2.3 * r + bend
        last = _arc((x, z), bend, -np.pi / 2, 0.0)
        return self.top.build(t, _joined([(0, 0, 0)], first, ring, last, [(x + bend, 0.0, z + self.rise)]), r)


class Tee(_Siphon, name="siphon/tee"):
    """A U siphon with a tee on top that carries a gauge and a test cock or a switch beside it."""

    tube: float = among(_TUBES, _ABOUT_TUBE, "m")
    reach: float = between(3.5, 5, "radius of its bends / of the pipe")
    high: float = between(0.1, 0.16, "height of the first bend", "m")
    arm: float = between(0.04, 0.08, "from the gauge's case to the middle of what is beside it", "m")
    gauge: StandingGauge = nested(StandingGauge, "gauge")
    cock: bool = chance(0.5, "a test cock beside the gauge, not a switch")
    shank: Shank = nested(Shank, "connection of the switch", when=lambda p: not p.cock)
    switch: Indicator = nested(Indicator, "case of the switch", when=lambda p: not p.cock)

    def build(self, t: Table) -> Model:
        r, reach, high, n = self.tube, self.reach * self.tube, self.high, fine_sides(0.012, t.style)
        over, under = (
            _arc((reach, high), reach, np.pi, 0.0),
            _arc((3 * reach, reach + 2 * r), reach, np.pi, 2 * np.pi),
        )
        x, z = 4 * reach, high + 0.04
        arm = self.arm + 0.6 * self.gauge.size
        run = along("x", cylinder(0.011, -0.03, arm + 0.013, n), 0, 0, z + 0.02)
        tee = merge([cylinder(0.014, z - 0.01, z + 0.05, n), run])
        path = _joined([(0, 0, 0)], over, under, [(x, 0, z)])
        t.add("siphon", rope(path, r, fine_sides(r, t.style, 12)), moved(tee, at(x)), of="trim")
        self.gauge.build(t.at(x), z + 0.05)
        t = t.at(x + arm, 0, z + 0.028)
        if self.cock:
            key = along("-y", t_handle(0.045, 0.04), 0, -0.01, 0.02)
            t.bundled(STEM).add(STEM, hexagon(0.024, 0.0, 0.03), key, hexagon(0.02, 0.03, 0.05))
        else:
            self.shank.build(t, -0.002, 0.05)
            self.switch.build(upright(t, 0.09, 0.048, 0.05), 0.06, 0.09, 0.05, of="valve")
        return t.model(kind="pressure gauge")


SIPHONS = families_of(Pigtail, UShaped, Trumpet, Coil, Finned, Bent, Capsule, LevelRing, Tee)
