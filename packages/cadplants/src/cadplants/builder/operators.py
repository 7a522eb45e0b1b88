"""What moves a valve, upon its stem at the origin of the table's frame: wheels, levers, gears, chains, actuators.

Sizes go with the radius of the valve's pipe.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cadplants.builder.params import Params, Source, among, between, chance, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.mesh_ops import Solid, extrude, merge, moved, sweep
from cadplants.operator import actuator_solids, handwheel, lever_solid, plate_wheel, solid_wheel
from cadplants.plant import Turning
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, rod, rope, torus, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["OPERATORS", "QUARTER_TURN", "DiaphragmHead", "Operator", "Wheel", "operator", "stem"]

QUARTER_TURN = ("lever", "lever", "lever", "wing", "gear", "chain", "pneumatic", "electric")
"""The usual operators of valves that turn by a quarter."""

_QUARTER = np.pi / 2


def stem(t: Table, low: float, high: float, radius: float) -> None:
    """A stem about z between two heights [m]."""
    t.add("valve stem", cylinder(radius, low, high, t.n(radius, 6, 16) if t.n(radius) >= 6 else 6))


class Operator(Params):
    """What moves a valve."""

    def build(self, t: Table, radius: float) -> None:
        """Puts it down.

        Args:
            t: its frame upon the stem's collar, x along the valve.
            radius: of the pipe [m].
        """
        raise NotImplementedError


class Wheel(Params):
    """A handwheel about z, its hub on z = 0: round rim, pressed plate, dished disc, or cast lobes."""

    spokes: int = whole(2, 6, "spokes, windows or lobes; at least 3 where it is round or pressed")
    form: str = weighted("how it is made", round=0.55, plate=0.15, dished=0.15, lobed=0.15)
    rim: float = between(0.04, 0.10, "rim's radius / wheel's radius", when=lambda p: p.form == "round")
    angle: float = between(0, 6, "turned about its stem", "rad")

    def solid(self, t: Table, radius: float) -> Solid:
        """The wheel of a radius [m], before it is turned."""
        hub, thick = 0.13 * radius + 0.008, 0.012 + 0.06 * radius
        r, h, d, bore = (round(x, 6) for x in (radius, hub, thick, 0.3 * hub))
        sides, spokes = t.n(radius, 12), max(3, self.spokes)
        if self.form == "round":
            return handwheel(r, round(radius * self.rim + 0.002, 6), spokes, h, d, bore, sides)
        if self.form == "plate":
            return plate_wheel(r, spokes, h, d, bore, sides)
        if self.form == "dished":
            return solid_wheel(r, h, d, bore, sides)
        return merge([_lobes(radius, max(4, self.spokes + 2), thick), cylinder(hub, 0, 1.4 * thick, 12)])

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, about z of the frame, of a radius [m]."""
        t.spun("z", self.angle).add("handwheel", self.solid(t, radius), turns=Turning("handwheel"))


def _lobes(radius: float, count: int, thick: float) -> Solid:
    """A knob with a wavy edge, as on small valves."""
    angles = np.linspace(0, 2 * np.pi, 6 * count, endpoint=False)
    reach = radius * (0.92 + 0.08 * np.cos(count * angles))
    return extrude(np.column_stack([reach * np.cos(angles), reach * np.sin(angles)]), 0.2 * thick, thick)


class Lever(Operator):
    """A flat lever, cranked or straight; a sheet with a dipped grip; or a tilted rod with a knob."""

    kind = "lever"
    length: float = between(0.9, 1.3, "length / 0.10 m + 2.2 pipe radii")
    quarters: float = among((0.0, 0.0, 0.5, 1.0), "where it points, 0 along the pipe", "pi rad")
    form: str = weighted("how it is made", flat=0.35, sheet=0.35, rod=0.30)
    straight: bool = among((False, True), "level rather than cranked", when=lambda p: p.form == "flat", otherwise=False)
    rise: float = between(0.1, 0.3, "height of the grip / length", when=lambda p: p.form == "sheet")
    tilt: float = between(0.1, 0.5, "upwards", "rad", when=lambda p: p.form == "rod")
    notched: bool = chance(0.3, "a plate with notches lies under it")

    def build(self, t: Table, radius: float) -> None:
        length, half, thick = self.length * (0.10 + 2.2 * radius), 0.008 + 0.22 * radius, 0.004 + 0.02 * radius
        t = t.spun("z", self.quarters * np.pi)
        t.add("lever", *self._solids(length, half, thick), turns=Turning("lever"))
        if self.notched:
            angles, reach = np.linspace(-0.3, 1.9, 12), 0.035 + 1.1 * radius
            corners = [(-0.4 * reach, 0.3 * reach), (-0.4 * reach, -0.3 * reach)]
            sector = np.vstack([np.column_stack([np.cos(angles), np.sin(angles)]) * reach, corners])
            t.add("position indicator", extrude(sector, -0.004, -0.0005))

    def _solids(self, length: float, half: float, thick: float) -> Sequence[Solid]:
        if self.form == "flat":
            return [lever_solid(length, half, thick, self.straight)]
        if self.form == "sheet":
            rise = self.rise * length
            way = [(-half, 0, thick / 2), (0.25 * length, 0, thick / 2), (0.4 * length, 0, rise), (length, 0, rise)]
            grip = _strip([(0.55 * length, 0, rise), (1.02 * length, 0, rise)], 1.15 * half, 2.4 * thick)
            return [_strip(way, half, thick), grip]
        way = np.array([np.cos(self.tilt), 0, np.sin(self.tilt)]) * length
        knob = moved(ball(0.8 * half, 10), at(*way) @ at(0, 0, 0.5 * half))
        bar = rod((0, 0, 0.5 * half), tuple(way + (0, 0, 0.5 * half)), 0.45 * half, 8)
        return [cylinder(1.1 * half, 0, 1.2 * half, 12), bar, knob]


def _strip(path: Sequence[tuple[float, float, float]], half: float, thick: float) -> Solid:
    """A flat bar in the plane y = 0."""
    section = np.array([[half, -thick / 2], [half, thick / 2], [-half, thick / 2], [-half, -thick / 2]])
    return sweep(np.asarray(path, float), section, up=(0.0, 1.0, 0.0))


class Wing(Operator):
    """A butterfly handle: two wings, as on small ball valves."""

    kind = "wing"
    across: bool = among((False, True), "across the pipe, closed")

    def build(self, t: Table, radius: float) -> None:
        reach, wide = 0.018 + 0.9 * radius, 0.006 + 0.12 * radius
        right = np.array([(0.4 * reach, -wide), (reach, -0.6 * wide), (reach, 0.6 * wide), (0.4 * reach, wide)])
        left = -right[[3, 2, 1, 0]] * (1, -1)
        loop = np.vstack([left[1:3][::-1][1:], left[3:], right, left[:1], left[1:2]])
        bar = moved(extrude(loop, -0.003, 0.003), at(0, 0, wide) @ spun("x", _QUARTER))
        hub = cylinder(0.8 * wide, 0, 1.6 * wide, 12)
        t.spun("z", _QUARTER * self.across).add("lever", bar, hub, turns=Turning("lever"))


class TBar(Operator):
    """A T bar through the stem's head, as on needle valves."""

    kind = "bar"
    angle: float = between(0, 3, "turned about the stem", "rad")

    def build(self, t: Table, radius: float) -> None:
        reach, thick = 0.02 + 1.1 * radius, 0.003 + 0.06 * radius
        knobs = [moved(ball(1.5 * thick, 8), at(sign * reach, 0, thick)) for sign in (-1, 1)]
        bar = rod((-reach, 0, thick), (reach, 0, thick), thick, 8)
        t.spun("z", self.angle).add("lever", bar, *knobs, turns=Turning("lever"))


class Gear(Operator):
    """A worm gear, its shaft to the side with a handwheel."""

    kind = "gear"
    wheel: Wheel = nested(Wheel, "handwheel")
    pointer: bool = chance(0.4, "a position indicator on its lid")

    def build(self, t: Table, radius: float) -> None:
        half, size = 0.035 + 0.3 * radius, 0.05 + 0.9 * radius
        place = (0.55 * half, 0, 0.4 * half)
        case = extrude(rounded_rectangle(2 * half, 1.7 * half, 0.35 * half, 4), 0.0, 0.8 * half)
        lid = cylinder(0.7 * half, 0.8 * half, 0.95 * half, t.n(half))
        t = t.bundled("gearbox")
        t.add("gearbox", case, lid, along("y", cylinder(0.32 * half, -0.9 * half, 0.9 * half, 12), *place), own=True)
        t.add("valve stem", along("-y", cylinder(0.14 * half, 0.0, 2.0 * half, 10), *place))
        side = t.at(0.55 * half, -1.9 * half, 0.4 * half).spun("x", _QUARTER)
        side.add("handwheel", *self._rim(t, size), turns=Turning("gear operator"))
        if self.pointer:
            t.add("position indicator", cylinder(0.25 * half, 0.95 * half, 1.05 * half, 12), own=True)

    def _rim(self, t: Table, size: float) -> Sequence[Solid]:
        return [moved(self.wheel.solid(t, size), spun("z", self.wheel.angle))]


class Chain(Gear):
    """A worm gear with a sheave and a loop of chain, for valves out of reach."""

    kind = "chain"

    def _rim(self, t: Table, size: float) -> Sequence[Solid]:
        teeth = around(box((0.3 * size, 0.02, 0.012), (0.1 * size, 0, 0)), 12, size)
        loop = [
            ((size + 0.01) * s, -d, 0) for s, d in ((-1, 0), (-1, 0.7), (-0.6, 0.76), (0.6, 0.76), (1, 0.7), (1, 0))
        ]
        hub = handwheel(round(size, 6), 0.01, 4, 0.02, 0.02, 0.006, 24)
        return [torus(size, 0.012, t.n(size, 16)), teeth, hub, rope(loop, 0.004, 6)]
