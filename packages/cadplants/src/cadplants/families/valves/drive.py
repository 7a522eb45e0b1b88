"""What moves a valve, standing on its stem: levers, wheels, gears, chains, actuators."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cadplants.builder.draws import of_makes
from cadplants.builder.params import Params, among, between, chance, given, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES
from cadplants.parts.operator import actuator_solids, handwheel, lever_solid, plate_wheel, solid_wheel
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, sweep
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, around, ball, box, cylinder, hexagon, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "BODY", "DiaphragmHead", "Drive", "Scaled", "Wheel", "drive_of", "driven", "put_spindle",
]  # fmt: skip

BODY = "valve body"


def put_spindle(t: Table, low: float, high: float, radius: float) -> None:
    """Puts down a plain stem about z [m]."""
    t.bundled(BODY).add("valve stem", cylinder(radius, low, high, max(6, min(t.style.round(radius), 16))))


class Wheel(Params):
    """A handwheel about z: round rim, pressed plate, dished disc, or cast lobes."""

    spokes: int = whole(2, 6, "spokes, at least three")
    make: str = weighted("how it is made", round_rim=0.55, plate=0.15, solid=0.15, lobed=0.15)
    rim: float = between(0.04, 0.10, "radius of its round rim / radius", when=lambda p: p.make == "round rim")
    turn: float = between(0, 6, "how far it is turned", "rad")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        """The wheel of a radius, its hub on z = 0, before it is turned [m]."""
        hub, thick, sides = 0.13 * radius + 0.008, 0.012 + 0.06 * radius, max(12, style.round(radius))
        r, spokes, *more = round(radius, 6), max(3, self.spokes), round(hub, 6), round(thick, 6), round(0.12 * hub, 6)
        if self.make == "round rim":
            return handwheel(r, round(radius * self.rim + 0.002, 6), spokes, *more, sides)
        if self.make == "plate":
            return plate_wheel(r, spokes, *more, sides)
        if self.make == "solid":
            return solid_wheel(r, *more, sides)
        # A knob with a wavy edge, as on small valves.
        count = max(4, self.spokes + 2)
        angles = np.linspace(0, 2 * np.pi, 6 * count, endpoint=False)
        reach = radius * (0.92 + 0.08 * np.cos(count * angles))
        lobes = extrude(np.column_stack([reach * np.cos(angles), reach * np.sin(angles)]), 0.2 * thick, thick)
        return merge([lobes, cylinder(hub, 0, 1.4 * thick, 12)])

    def build(self, t: Table, radius: float, z: float = 0.0, turns: str = "handwheel") -> None:
        """Puts it down with its hub on a height [m]; ``turns``: what it is turned as."""
        solid = moved(self.solid(radius, t.style), spun("z", self.turn))
        t.at(0, 0, z).add("handwheel", solid, turns=Turning(turns))


def _strip(path: list[tuple[float, float]], half: float, thick: float) -> Solid:
    """A flat bar in the plane y = 0."""
    section = np.array([[half, -thick / 2], [half, thick / 2], [-half, thick / 2], [-half, -thick / 2]])
    return sweep(np.array([(x, 0, z) for x, z in path], float), section, up=(0.0, 1.0, 0.0))


class _Lever(Params):
    """A flat lever: cranked, straight, or a sheet with a dipped grip; with or without a notch plate."""

    kind = "lever"

    length: float = between(0.9, 1.3, "of the lever / what the pipe asks for")
    turn: float = among((0.0, 0.0, np.pi / 2, np.pi), "where it points, from along the run", "rad")
    make: str = weighted("how it is made", flat=0.35, sheet=0.35, bar=0.3)
    straight: bool = among((False, True), "a flat one stays level", when=lambda p: p.make == "flat", otherwise=False)
    rise: float = between(0.1, 0.3, "of its grip / length", when=lambda p: p.make == "sheet")
    tilt: float = between(0.1, 0.5, "slope of its bar", "rad", when=lambda p: p.make == "bar")
    notched: bool = chance(0.3, "a notch plate below it")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        length, half, thick = self.length * (0.10 + 2.2 * radius), 0.008 + 0.22 * radius, 0.004 + 0.02 * radius
        t = t.spun("z", self.turn)
        if self.make == "flat":
            solids = [lever_solid(length, half, thick, self.straight)]
        elif self.make == "sheet":
            rise = self.rise * length
            path = outline(-half, thick / 2, 0.25 * length, thick / 2, 0.4 * length, rise, length, rise)
            grip = _strip(outline(0.55 * length, rise, 1.02 * length, rise), 1.15 * half, 2.4 * thick)
            solids = [_strip(path, half, thick), grip]
        else:
            start = np.array([0, 0, 0.5 * half])
            end = start + length * np.array([np.cos(self.tilt), 0, np.sin(self.tilt)])
            solids = [cylinder(1.1 * half, 0, 1.2 * half, 12), rod(tuple(start), tuple(end), 0.45 * half, 8)]
            solids.append(moved(ball(0.8 * half, 10), at(*end)))
        t.add("lever", *solids, turns=Turning("lever"))
        if self.notched:
            angles, reach = np.linspace(-0.3, 1.9, 12), 0.035 + 1.1 * radius
            sector = np.vstack([np.column_stack([np.cos(angles), np.sin(angles)]), [(-0.4, 0.3), (-0.4, -0.3)]])
            t.bundled(BODY).add("position indicator", extrude(reach * sector, -0.004, -0.0005))


class _Wing(Params):
    """A butterfly handle: two wings, as on small ball valves."""

    kind = "wing"

    turn: float = among((0.0, 1.5708), "where it points, from along the run", "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        reach, wide = 0.018 + 0.9 * radius, 0.006 + 0.12 * radius
        half = np.array([(-1, -0.6), (-0.4, -1), (0.4, -1), (1, -0.6)])
        bar = moved(extrude(np.vstack([half, -half]) * (reach, wide), -0.003, 0.003), spun("x", np.pi / 2))
        solids = [moved(bar, at(0, 0, wide)), cylinder(0.8 * wide, 0, 1.6 * wide, 12)]
        t.spun("z", self.turn).add("lever", *solids, turns=Turning("lever"))


class _Bar(Params):
    """A T bar through the stem's head, as on needle valves."""

    kind = "bar"

    turn: float = between(0, 3, "where it points, from along the run", "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        reach, thick = 0.02 + 1.1 * radius, 0.003 + 0.06 * radius
        knobs = [moved(ball(1.5 * thick, 8), at(s * reach, 0, thick)) for s in (-1, 1)]
        cross = rod((-reach, 0, thick), (reach, 0, thick), thick, 8)
        t.spun("z", self.turn).add("lever", cross, *knobs, turns=Turning("lever"))


class _Gear(Params):
    """A worm gear with its shaft to the side and a handwheel."""

    kind = "gear"

    wheel: Wheel = nested(Wheel, "handwheel")
    indicated: bool = chance(0.4, "a cap shows the position")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, t = 0.035 + 0.3 * radius, t.bundled("gearbox")
        x, z = 0.55 * half, 0.4 * half
        case = extrude(rounded_rectangle(2 * half, 1.7 * half, 0.35 * half, 4), 0.0, 0.8 * half)
        lid = cylinder(0.7 * half, 0.8 * half, 0.95 * half, t.style.round(half))
        t.add("gearbox", case, lid, along("y", cylinder(0.32 * half, -0.9 * half, 0.9 * half, 12), x, 0, z))
        t.add("valve stem", along("-y", cylinder(0.14 * half, 0.0, 2.7 * half, 10), x, 0, z))
        self._turned_by(t, (x, -2.6 * half, z), 0.05 + 0.9 * radius)
        if self.indicated:
            t.add("position indicator", cylinder(0.25 * half, 0.95 * half, 1.05 * half, 12))

    def _turned_by(self, t: Table, middle: tuple[float, float, float], size: float) -> None:
        """Puts down its wheel about -y, of a radius [m]."""
        self.wheel.build(t.at(*middle).along("-y"), size, 0.0, "gear operator")


class _Chain(_Gear):
    """A worm gear with its shaft to the side and a chain wheel."""

    kind = "chain"

    def _turned_by(self, t: Table, middle: tuple[float, float, float], size: float) -> None:
        """Puts down its chain wheel about -y, of a radius [m]."""
        lugs = around(box((0.3 * size, 0.02, 0.012), (0.1 * size, 0, 0)), 12, size)
        rim = torus(size, 0.012, max(16, t.style.round(size)))
        spokes = handwheel(round(size, 6), 0.01, 4, 0.02, 0.02, 0.006, 24)
        way = outline(-1, 0, -1, 0.7, -0.6, 0.76, 0.6, 0.76, 1, 0.7, 1, 0)
        x, y, z = middle
        links = rope([(x + s * (size + 0.01), y, z - down) for s, down in way], 0.004, 6)
        turning = Turning("gear operator", (0.0, -1.0, 0.0), middle)
        t.add("handwheel", along("-y", merge([rim, lugs, spokes]), x, y, z), links, turns=turning)


class _Pneumatic(Params):
    """A rack-and-pinion actuator, or a scotch yoke between a cylinder and a spring can; with a switch box."""

    kind = "pneumatic"

    turn: float = among((0.0, 1.5708), "where it points, from along the run", "rad")
    rack: bool = chance(0.65, "rack and pinion, not a scotch yoke")
    switched: bool = chance(0.5, "a switch box on top")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half = 0.028 + 0.45 * radius
        t = t.at(0, 0, 0.5 * half).spun("z", self.turn)
        plate = (1.6 * half, 0.005, 0.6 * half)
        cheeks = [box(plate, (0, s * 0.5 * half, -0.25 * half)) for s in (-1, 1)]
        foot = box((1.6 * half, 1.05 * half, 0.005), (0, 0, -0.5 * half + 0.0005))
        t.bundled(BODY).add("yoke", *cheeks, foot, of="steel")
        t, top = t.bundled("actuator"), (2.0 if self.rack else 1.8) * half
        if self.rack:
            t.add("actuator", actuator_solids(round(radius, 6))[0], of="trim")
        else:
            n, reach, z = t.style.round(half), 0.08 + 2.0 * radius, 0.9 * half
            long, a, b = 1.3 * reach, 0.9 * half, 0.8 * half
            can = turned(outline(a, 0, a, 0.02, b, 0.02, b, long, a, long, a, long + 0.02), n)
            spring = turned(outline(0.7 * half, 0, 0.7 * half, reach, 0.5 * half, reach + 0.01), n)
            housing = box((2.2 * half, 1.6 * half, 1.8 * half), (0, 0, z))
            t.add("actuator", housing, along("x", can, 1.1 * half, 0, z), along("-x", spring, -1.1 * half, 0, z))
        if self.switched:
            case = box((0.09, 0.07, 0.06), (0, 0, top + 0.045))
            t.add("position indicator", case, cylinder(0.008, top, top + 0.02, 8), of="electrical")
        else:
            t.add("position indicator", cylinder(0.015, top, top + 0.02, 12), of="handle")


class _Electric(Params):
    """An electric actuator: housing with a round lid, a motor can aside, a hand wheel, a cable gland."""

    kind = "electric"

    turn: float = among((0.0, 1.5708, 3.1416), "where it points, from along the run", "rad")
    wheeled: bool = chance(0.6, "has a handwheel")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, t = 0.04 + 0.35 * radius, t.spun("z", self.turn).bundled("actuator")
        n = t.style.round(half)
        case = extrude(rounded_rectangle(2.6 * half, 1.8 * half, 0.4 * half, 3), 0.45 * half, 1.9 * half)
        lid = turned(outline(0.8 * half, 1.9 * half, 0.8 * half, 2.2 * half, 0.6 * half, 2.35 * half), n)
        can = turned(outline(0.6 * half, 0, 0.6 * half, 1.4 * half, 0.5 * half, 1.5 * half), n)
        gland = along("-y", hexagon(0.022, 0, 0.025), -0.5 * half, -0.9 * half, half)
        foot = cylinder(0.5 * half, 0.0, 0.5 * half, n)
        t.add("actuator", foot, case, lid, along("x", can, 1.3 * half, 0, 1.2 * half), gland)
        if self.wheeled:
            size, rim, eye = round(0.7 * half, 6), round(0.07 * half, 6), round(0.15 * half, 6)
            wheel_ = along("y", handwheel(size, rim, 3, eye, eye, 0.003, max(12, n)), 0, 0.95 * half, 1.2 * half)
            hub = along("y", cylinder(0.1 * half, 0.85 * half, 1.05 * half, 8), 0, 0, 1.2 * half)
            turning = Turning("gear operator", (0.0, 1.0, 0.0), (0.0, 0.0, 1.2 * half))
            t.add("handwheel", wheel_, hub, turns=turning)


class DiaphragmHead(Params):
    """A diaphragm actuator on a yoke (IEC 60534 control valves), maybe with a positioner and its air pipe."""

    head: float = between(0.9, 1.3, "radius of its diaphragm / what the pipe asks for")
    positioned: bool = chance(0.6, "has a positioner")
    wheeled: bool = chance(0.25, "has a handwheel on top")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.wheeled)

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        head, tall, t = self.head * (0.08 + 1.3 * radius), 0.08 + 1.4 * radius, t.bundled("actuator")
        n, wide, collar = t.style.round(head), 0.012 + 0.1 * radius, 0.03 + 0.6 * radius
        arm = (0.02 + 0.1 * radius, wide, tall)
        arms = [box(arm, (0, s * (0.02 + 0.45 * radius), tall / 2)) for s in (-1, 1)]
        t.add("yoke", *arms, cylinder(collar, 0, wide, n), cylinder(collar, tall - 0.012, tall + 0.003, n))
        pan, cap = (
            turned([(x * head, tall + z * head) for x, z in side], n)
            for side in (
                outline(0.3, 0, 0.75, 0.12, 1, 0.2, 1, 0.26),
                outline(1, 0.265, 1, 0.32, 0.8, 0.42, 0.3, 0.55, 0.12, 0.6),
            )
        )
        t.add("actuator", pan, cap, of="valve")
        t.bundled(BODY).add("valve stem", cylinder(0.004 + 0.08 * radius, -0.01, tall, 10))
        high = tall + 0.34 * head
        bolt = [cylinder(0.006, tall + 0.18 * head, high, 6), hexagon(0.016, tall + 0.32 * head, high + 0.006)]
        t.add("bolt", around(merge(bolt), max(6, min(16, int(60 * head))), 0.93 * head))
        if self.positioned:
            y, z = 0.1 + 0.55 * radius, 0.55 * tall
            case = [box((0.10, 0.07, 0.13), (0, y, z)), box((0.08, 0.02, 0.10), (0, y + 0.045, z))]
            way = [(0, y, z + 0.06), (0, y, tall + 0.1 * head), (0, 0.5 * head, tall + 0.14 * head)]
            t.add("actuator", *case, rope(way, 0.004, 6), of="electrical")
        if self.wheeled:
            top = tall + 0.6 * head
            put_spindle(t, top - 0.01, top + 0.05, 0.006)
            self.wheel.build(t, 0.5 * head, top + 0.04)


_DRIVES: dict[str, Any] = {
    "lever": _Lever, "wing": _Wing, "bar": _Bar, "gear": _Gear, "chain": _Chain, "pneumatic": _Pneumatic,
    "electric": _Electric,
}  # fmt: skip
_QUARTER = ("lever", "lever", "lever", "wing", "gear", "chain", "pneumatic", "electric")


def _fit(makes: tuple[str, ...], radius: float) -> list[str]:
    """The makes that a pipe of a radius has in their place: small ones have no gears, large ones no levers."""
    if radius > 0.12 and "gear" in makes:
        return ["gear" if make in ("lever", "wing") else make for make in makes]
    unfit = ("gear", "chain") if radius < 0.02 else ("wing",) if radius > 0.05 else ()
    return ["lever" if make in unfit else make for make in makes]


class Scaled(Params):
    """What turns a stem, of one of some makes, as large as a pipe asks for."""

    radius: float = given(0.05, "of the pipe, which it is scaled by", "m")
    make: str
    form: Any

    def build(self, t: Table) -> None:
        """Puts it down on its seat on z = 0."""
        self.form.build(t, self.radius)


class Drive(Scaled):
    """What moves a valve, on the stem's collar on z = 0."""

    make: str = among(lambda p: _fit(_QUARTER, p.radius), "what it is")
    form: Any = nested(lambda _, p: _DRIVES[p.make], "its proportions")


def driven(
    kind: type[Any], about: str, radius: Callable[[Any], float] | None, when: Callable[[Any], bool] | None
) -> Any:
    """A field for a piece that is scaled by a radius, the pipe's if None."""
    of = radius or (lambda p: PIPES[p.dn].radius)
    return nested(kind, about, fixed=lambda p: {"radius": of(p)}, when=when)


def drive_of(
    *makes: str, radius: Callable[[Any], float] | None = None, when: Callable[[Any], bool] | None = None
) -> Any:
    """A field for what moves a valve.

    Args:
        makes: to draw from: ``lever``, ``wing``, ``bar``, ``gear``, ``chain``, ``pneumatic``, ``electric``; those of
            quarter turns by default.
        radius: that it is scaled by, from the fields before [m]; the pipe's if None.
        when: whether there is one, by the fields before.
    """
    return driven(of_makes(Drive, makes or _QUARTER, _fit), "what moves it", radius, when)
