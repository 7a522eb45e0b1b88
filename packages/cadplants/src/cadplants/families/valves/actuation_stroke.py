"""What lifts a valve's stem, standing on z = 0: yokes, wheels, diaphragms, pistons, rams, motors, magnets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cadplants.builder.draws import of_makes
from cadplants.builder.params import Params, among, between, chance, given, nested, weighted
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import OPERATORS, operator
from cadplants.families.valves.actuation_base import STEMS, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, scaled, slab
from cadplants.families.valves.drive import BODY, driven
from cadplants.solids.mesh_ops import Solid, merge, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = [
    "STROKES",
    "Linear",
    "OutsideScrew",
    "Yoke",
    "linear_of",
    "screw_of",
]

_ABOUT_STEM = "form of the stem"
_YOKES = ("arched", "waisted", "pillars", "window frame", "flat bars", "slotted tube")


class Yoke(Params):
    """A yoke: arched, straight or waisted arms, pillars, a window frame, a slotted tube."""

    form: str = among(_YOKES, "how it is made")
    crown: float = between(
        0.45,
        0.8,
        "radius of its top / of its foot",
        when=lambda p: p.form in ("arched", "waisted", "window frame"),
        otherwise=1.0,
    )
    wide: float = between(0.18, 0.35, "half an arm's width / radius of its foot", when=lambda p: p.form in _YOKES[:2])
    thick: float = between(0.1, 0.2, "half an arm's thickness / radius", when=lambda p: p.form in _YOKES[:2])
    waist: float = between(0.55, 0.8, "of a waisted one / radius of its foot", when=lambda p: p.form == "waisted")
    count: int = among((2, 3, 4), "pillars", when=lambda p: p.form == "pillars", otherwise=0)

    def build(self, t: Table, half: float, tall: float) -> None:
        """Puts it down, from z = 0 to a height, its foot of a radius [m]."""
        n, plate, crown = t.n(half, 12), max(0.006, 0.10 * half), self.crown * half
        top, foot = cylinder(crown, tall - 1.6 * plate, tall, n), cylinder(half, 0.0, plate, n)
        if self.form in ("arched", "waisted"):
            wide, thick = self.wide * half, self.thick * half
            bulge = half * (1.0 if self.form == "arched" else self.waist)
            side = outline(0.75 * half, 0.5 * plate, bulge, 0.3 * tall, bulge, 0.65 * tall)
            path = np.array([(0, y, z) for y, z in (*side, (0.6 * crown, tall - 0.8 * plate))])
            section = np.array([[-wide, -thick], [wide, -thick], [wide, thick], [-wide, thick]])
            arm = sweep(path, section, up=(1.0, 0.0, 0.0))
            solids = [arm, moved(arm, spun("z", np.pi)), top, foot]
        elif self.form == "pillars":
            pillar = [cylinder(0.09 * half + 0.002, 0.0, tall + plate, 10)]
            pillar.append(hexagon(0.3 * half + 0.006, tall, tall + plate))
            solids = [around(one, self.count, 0.8 * half, np.pi / 2) for one in pillar]
            solids += [top, foot]
        elif self.form == "window frame":
            edge = np.array([(-1, 0), (1, 0), (0.75, 1), (-0.75, 1)]) * (half, tall)
            window = np.array([(-0.7, 0.16), (0.7, 0.16), (0.5, 0.86), (-0.5, 0.86)]) * (half, tall)
            deep = 0.22 * half + 0.003
            frame = moved(slab(edge, -deep, deep, (window,)), spun("z", np.pi / 2) @ spun("x", np.pi / 2))
            solids = [frame, foot, top]
        elif self.form == "flat bars":
            leg = (0.08 * half + 0.004, 0.5 * half, tall)
            solids = [moved(box(leg, (s * 0.72 * half, 0, tall / 2)), spun("z", np.pi / 2)) for s in BOTH]
            solids.append(box((0.6 * half, 1.6 * half, 1.5 * plate), (0, 0, tall - 0.75 * plate)))
            solids.append(box((0.9 * half, 1.7 * half, plate), (0, 0, plate / 2)))
        else:
            solids = []
            for s in BOTH:
                a = np.linspace(-0.8, 0.8, 7) + s * np.pi / 2
                arc = np.column_stack([np.cos(a), np.sin(a)]) * half
                solids.append(slab(np.vstack([0.85 * arc, 0.7 * arc[::-1]]), 0.5 * plate, tall - plate))
            solids += [cylinder(0.88 * half, tall - 1.6 * plate, tall, n), foot]
        t.add("yoke", *solids)


class OutsideScrew(Params):
    """An outside screw and yoke: yoke, rising stem, yoke nut, and a wheel, a gear or a motor on top."""

    radius: float = given(0.2, "of its handwheel", "m")
    yoke: Yoke = nested(Yoke, "yoke")
    top: str = weighted(
        "what turns it", when=lambda p: p.radius >= 0.08, otherwise="wheel", wheel=0.72, bevel=0.15, motor=0.13
    )
    lift: float = between(0.0, 1.0, "how far it is open", when=lambda p: p.top == "wheel")
    stem: str = among(STEMS, _ABOUT_STEM)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.top == "wheel")
    cover: bool = chance(
        0.3, "a pipe covers the rising stem", when=lambda p: p.top == "wheel" and 0.8 * p.lift > 0.3, otherwise=False
    )
    gear: Any = operator("bevel", radius=lambda p: 0.6 * p.radius, when=lambda p: p.top == "bevel")
    motor: Any = operator("multi-turn", radius=lambda p: 0.6 * p.radius, when=lambda p: p.top == "motor")

    def build(self, t: Table, half: float, tall: float, slim: float) -> None:
        """Puts it down: half the yoke's width, its height, the stem's radius [m]."""
        t = t.bundled(BODY)
        self.yoke.build(t, half, tall)
        # A wheel turns over the nuts of pillars.
        rise = max(1.2 * slim, 0.12 * half + 0.1 * self.radius) if self.yoke.form == "pillars" else 1.2 * slim
        nut = [cylinder(2.2 * slim, tall - 0.01, tall + rise + 0.3 * slim, 12), hexagon(3.6 * slim, tall, tall + slim)]
        t.add("nut", *nut, of="trim", own=True, fine=False)
        if self.top != "wheel":
            put_stem(t, -0.01, tall + 2 * slim, slim, self.stem)
            (self.gear or self.motor).build(t.at(0, 0, tall + 0.5 * slim))
            return
        lift = self.lift * 0.8 * tall
        put_stem(t, -0.01, tall + rise + 1.8 * slim + lift + 0.02, slim, self.stem)
        self.wheel.build(t, self.radius, tall + rise)
        if self.cover:
            low = tall + rise + 1.8 * slim
            t.add("valve stem", cylinder(1.8 * slim, low + 0.01, low + 2 * slim + lift + 0.04, 12))


class _Diaphragm(Params):
    """A spring diaphragm: dished pans, flat pans, a deep spring case above, or two storeys; with a vent and an eye."""

    kind = "diaphragm"

    head: float = between(0.8, 1.4, "radius of its diaphragm / what the pipe asks for")
    form: str = among(("dished", "flat", "deep", "two storeys"), "form of its pans")
    vented: bool = chance(0.5, "a vent on top")
    wheeled: bool = chance(0.2, "has a handwheel on top")
    stem: str = among(STEMS, _ABOUT_STEM, when=lambda p: p.wheeled)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.wheeled)

    def build(self, t: Table, radius: float, tall: float) -> None:
        """Puts it down on a height, for a pipe of a radius [m]."""
        head = self.head * (0.08 + 1.2 * radius)
        n, lip, t = t.n(head, 16), 0.012 + 0.03 * head, t.at(0, 0, tall).bundled("actuator")
        rim, seam = lip / head, 0.18 * head + lip
        lower = scaled(head, 0.25, 0, 0.6, 0.06, 0.86, 0.18, 1, 0.18, 1, 0.18 + rim)
        if self.form == "flat":
            low = 0.2 * head - 0.01
            lower = [*outline(0.85 * head, 0, 0.88 * head, low, head, low), (head, seam)]
        upper = {
            "dished": (0.86, rim, 0.6, 0.2, 0.2, 0.26),
            "flat": (0.88, rim, 0.86, 0.35, 0.8, 0.4),
            "deep": (0.8, rim + 0.05, 0.45, 0.3, 0.42, 1.1, 0.3, 1.25, 0.1, 1.28),
            "two storeys": (0.9, 2 * rim, 0.9, 0.5, 0.8, 0.62, 0.1, 0.66),
        }[self.form]
        high = seam + upper[-1] * head
        case = scaled(head, 1, 0, 1, rim, *upper)
        solids = [turned(lower, n), moved(turned(case, n), at(0, 0, seam + 0.001))]
        if self.vented:
            solids.append(cylinder(0.04 * head + 0.004, high - 0.01, high + 0.05 * head, 8))
            solids.append(hexagon(0.1 * head + 0.01, high - 0.003, high + 0.03 * head))
        t.add("actuator", *solids, of="valve")
        low, up = 0.18 * head, seam + lip + 0.001
        bolt = [cylinder(0.005, low, up, 6), hexagon(0.014, up, up + 0.006), hexagon(0.014, low - 0.006, low)]
        t.add("bolt", around(merge(bolt), int(np.clip(60 * head, 6, 18)), 0.93 * head))
        if self.wheeled:
            put_stem(t, high - 0.01, high + 0.25 * head, 0.05 * head, self.stem)
            self.wheel.build(t, 0.5 * head, high + 0.15 * head)


class _Piston(Params):
    """A piston cylinder: end plates held by tie rods, or a smooth barrel with rolled covers, ports on one side."""

    kind = "piston"

    half: float = between(0.8, 1.2, "radius of its cylinder / what the pipe asks for")
    long: float = between(1.6, 3.0, "length of its cylinder / what the pipe asks for")
    form: str = among(("tie rods", "rolled", "domed"), "how it is made")
    square: bool = chance(0.6, "its end plates are square, not round", when=lambda p: p.form == "tie rods")
    eyed: bool = chance(0.5, "a cap on top shows the position")

    def build(self, t: Table, radius: float, tall: float) -> None:
        """Puts it down on a height, for a pipe of a radius [m]."""
        asked, t = 0.03 + 0.7 * radius, t.at(0, 0, tall).bundled("actuator")
        half, long = self.half * asked, self.long * asked
        n = t.n(half, 16)
        if self.form == "tie rods":
            plate = rounded_rectangle(2.3 * half, 2.3 * half, 0.2 * half, 2) if self.square else circle(1.25 * half, n)
            solids = [slab(plate, z, z + 0.2 * half) for z in (0.0, long)]
            tie = [cylinder(0.07 * half + 0.001, -0.02 * half, long + 0.3 * half, 8)]
            tie.append(hexagon(0.24 * half, long + 0.2 * half, long + 0.34 * half))
            solids.append(cylinder(half, 0.1 * half, long + 0.1 * half, n))
            solids.append(around(merge(tie), 4, (1.372 if self.square else 1.12) * half, np.pi / 4))
            high = long + 0.2 * half
        elif self.form == "rolled":
            high = long + 0.3 * half
            side = outline(
                0.8 * half, 0, half, 0.1 * half, half, long, 0.85 * half, long + 0.2 * half, 0.3 * half, high
            )
            solids = [turned(side, n)]
            solids += [ring(0.9 * half, 1.08 * half, z, z + 0.12 * half, n) for z in (0.2 * half, long - 0.2 * half)]
        else:
            side = scaled(half, 0.6, 0, 0.95, 0.25, 1, 0.25)
            side += outline(half, 0.8 * long, 1.06 * half, 0.82 * long, 1.06 * half, 0.95 * long)
            solids = [turned(side, n), dome(1.0 * half, 0.45 * half, 0.95 * long, n)]
            high = 0.95 * long + 0.44 * half
        port = hexagon(0.022, 0.7 * half, 1.12 * half + 0.012)
        solids += [along("y", port, 0, 0, z) for z in (0.3 * long, 0.8 * long)]
        t.add("actuator", *solids, of="clamp" if self.form == "rolled" else "motor")
        if self.eyed:
            cap = dome(0.12 * half, 0.12 * half, high + 0.3 * half, 12)
            t.add("position indicator", cylinder(0.13 * half, high - 0.01, high + 0.3 * half, 12), cap, of="safety")


class _Ram(Params):
    """A hydraulic cylinder: a thick tube between square heads, elbowed oil ports and their pipe."""

    kind = "ram"

    long: float = between(3.0, 5.0, "length of its cylinder / half a head's width")

    def build(self, t: Table, radius: float, tall: float) -> None:
        """Puts it down on a height, for a pipe of a radius [m]."""
        half = 0.025 + 0.4 * radius
        long, low, out = self.long * half, 0.3 * half, 1.6 * half
        solids = [box((2.2 * half, 2.2 * half, 0.6 * half), (0, 0, z)) for z in (low, long)]
        solids.append(cylinder(0.9 * half, 0.5 * half, long, t.n(half, 16)))
        solids.append(around(cylinder(0.1 * half, 0.0, long + 0.45 * half, 8), 4, 1.3 * half, np.pi / 4))
        solids.append(rope([(0, half, low), (0, out, low), (0, out, long), (0, half, long)], 0.08 * half + 0.002, 8))
        t.at(0, 0, tall).bundled("actuator").add("actuator", *solids)


class _Motor(Params):
    """A linear electric actuator, as on heating valves: a moulded case, round or boxy, a cable gland, a knob."""

    kind = "linear electric"

    high: float = between(1.6, 3.0, "height / half its width")
    boxy: bool = chance(0.5, "its case is a box, not round")
    knob: bool = chance(0.5, "a knob for the hand")

    def build(self, t: Table, radius: float, tall: float) -> None:
        """Puts it down on a height, for a pipe of a radius [m]."""
        half, n, t = 0.035 + 0.4 * radius, t.n(0.05, 16), t.at(0, 0, tall).bundled("actuator")
        high = self.high * half
        if self.boxy:
            solids = [slab(rounded_rectangle(2.4 * half, 1.7 * half, 0.4 * half, 3), 0.0, high)]
            solids.append(slab(rounded_rectangle(2.2 * half, 1.5 * half, 0.4 * half, 3), high, high + 0.25 * half))
        else:
            side = outline(0.6 * half, 0, half, 0.4 * half, half, 0.8 * high, 0.8 * half, high)
            solids = [turned(side, n), dome(0.8 * half, 0.3 * half, high, n)]
        solids.append(along("x", hexagon(0.022, 0.8 * half, 1.2 * half + 0.022), 0, 0, 0.35 * high))
        t.add("actuator", *solids, of="electrical")
        if self.knob:
            knob = along("-y", cylinder(0.25 * half, 0.75 * half, 1.15 * half, 12), 0, 0, 0.7 * high)
            t.add("position indicator", knob, of="safety")


class _Turning(Params):
    """A multi-turn or electrohydraulic actuator, or a bevel gear."""

    kind = "turning"

    make: str = among(("multi-turn", "electrohydraulic", "bevel"), "what it is")
    form: Any = nested(lambda _, p: OPERATORS[p.make], "its proportions")

    def build(self, t: Table, radius: float, tall: float) -> None:
        """Puts it down on a height, for a pipe of a radius [m]."""
        self.form.build(t.at(0, 0, tall), max(radius, 0.024))


STROKES: dict[str, Any] = {
    "diaphragm": _Diaphragm, "piston": _Piston, "ram": _Ram, "motor": _Motor, "turning": _Turning,
}  # fmt: skip
"""Actuators that lift a stem, by their make; each is built on a table for a pipe's radius, on a height."""


class Linear(Params):
    """A yoke with one of some linear actuators on it, maybe a positioner and a travel scale."""

    radius: float = given(0.05, "of the pipe, which it is scaled by", "m")
    make: str = among(tuple(STROKES), "what lifts the stem")
    tall: float = between(0.8, 1.3, "height of its yoke / what the pipe asks for")
    yoke: Yoke = nested(Yoke, "yoke")
    form: Any = nested(lambda _, p: STROKES[p.make], "proportions of what lifts the stem")
    positioned: bool = chance(0.55, "has a positioner", when=lambda p: p.make in ("diaphragm", "piston"))
    boxy: bool = chance(0.5, "its positioner is a box, not round", when=lambda p: p.positioned)
    scaled: bool = chance(0.6, "a travel scale on an arm of its yoke")
    turn: float = among((0.0, np.pi / 2, np.pi), "which way it looks", "rad")

    def build(self, t: Table) -> None:
        """Puts it down on a bonnet's top on z = 0."""
        radius, t = self.radius, t.spun("z", self.turn).bundled("actuator")
        half, tall, slim = 0.025 + 0.55 * radius, self.tall * (0.07 + 1.3 * radius), 0.004 + 0.07 * radius
        body, middle = t.bundled(BODY), 0.5 * tall
        self.yoke.build(t, half, tall)
        put_stem(t, -0.01, tall + 0.01, slim)
        coupling = box((3.0 * slim, 5.0 * slim, 4 * slim), (0, 0, middle))
        body.add("valve stem", coupling, hexagon(3.5 * slim, middle - 3.5 * slim, middle - 2 * slim))
        self.form.build(t, radius, tall)
        if self.positioned:
            self._positioner(t, half, tall)
        if self.scaled:  # with its pointer on the stem
            lines = [box((0.003, 0.022, 0.0015), (0.004, 0.6 * half, z)) for z in np.linspace(0.35, 0.65, 6) * tall]
            plate = box((0.002, 0.025, 0.4 * tall), (0.003, 0.6 * half, middle))
            pointer = box((0.004, 0.6 * half, 0.004), (0.006, 0.3 * half, middle))
            body.add("position indicator", plate, pointer, *lines, of="dial")

    def _positioner(self, t: Table, half: float, tall: float) -> None:
        """Puts down a positioner on a bracket beside the yoke, with its feedback arm and gauges' pads."""
        y, z = half + 0.06, 0.55 * tall
        plate = [box((0.06, 0.004, 0.08), (0, y - 0.004, z)), box((0.004, 0.08, 0.05), (0.028, y - 0.045, z))]
        t.add("bracket", *plate, own=True)
        case: list[Solid]
        if self.boxy:
            case = [box((0.12, 0.08, 0.11), (0, y + 0.038, z)), box((0.10, 0.02, 0.09), (0, y + 0.085, z))]
        else:
            case = [along("y", turned(outline(0.055, 0, 0.06, 0.02, 0.06, 0.075, 0.045, 0.09), 20), 0, y - 0.003, z)]
        arm = rod((0, 0.01, z + 0.01), (0, y, z + 0.01), 0.004, 6)
        way = [(-0.04, y + 0.03, z + 0.04), (-0.04, y + 0.03, tall + 0.02), (-0.02, 0.5 * half, tall + 0.03)]
        t.add("actuator", *case, arm, rope(way, 0.003, 6), of="electrical")


def linear_of(
    *makes: str, radius: Callable[[Any], float] | None = None, when: Callable[[Any], bool] | None = None
) -> Any:
    """A field for what lifts a stem.

    Args:
        makes: of ``STROKES`` to draw from; all by default.
        radius: that it is scaled by, from the fields before [m]; the pipe's if None.
        when: whether there is one, by the fields before.
    """
    return driven(of_makes(Linear, makes or tuple(STROKES)), "what lifts its stem", radius, when)


def screw_of(radius: Callable[[Any], float], when: Callable[[Any], bool] | None = None) -> Any:
    """A field for an outside screw and yoke whose handwheel has a radius, by the fields before [m]."""
    return driven(OutsideScrew, "outside screw and yoke", radius, when)
