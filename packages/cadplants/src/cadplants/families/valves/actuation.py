"""What moves a valve, standing on z = 0 about its stem: gearboxes, cylinders, diaphragms, motors, indicators."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cadplants.builder.draws import of_makes
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import INDICATORS, QUARTERS, put_indicator, put_stem
from cadplants.families.valves.actuation_gear import Bevel, Worm
from cadplants.families.valves.actuation_hand import Handlever, Handwheel, cylinder_at, scaled, slab, span
from cadplants.families.valves.drive import BODY, Scaled, driven
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = [
    "OPERATORS",
    "Operator",
    "operator",
]

_MOUNTS = ("bent deep", "bent", "plates", "pillars")
_ABOUT_MOUNT = "bracket between valve and actuator"
_ABOUT_TURN = "which way it looks"
_ABOUT_INDICATOR = "what shows the position"


def _put_mount(t: Table, half: float, tall: float, form: str) -> None:
    """Puts down the bracket between valve and actuator (ISO 5211): a bent U, two plates or four pillars."""
    thick = 0.004 + 0.05 * half
    solids = [box((2 * half, 1.6 * half, thick), (0, 0, z)) for z in (thick / 2, tall - thick / 2)]
    if form == "pillars":
        pillar = cylinder(0.16 * half, 0.0, tall, 10)
        solids += [moved(pillar, at(a * 0.75 * half, b * 0.6 * half)) for a in BOTH for b in BOTH]
    elif form == "plates":
        solids += [box((thick, 1.6 * half, tall), (s * 0.95 * half, 0, tall / 2)) for s in BOTH]
    else:
        deep = (1.6 if form == "bent deep" else 1.0) * half
        solids += [box((2 * half, thick, tall), (0, s * 0.5 * deep, tall / 2)) for s in BOTH]
    t.bundled(BODY).add("yoke", *solids, of="steel")


class _Lever(Params):
    """A lever on the stem."""

    kind = "lever"

    length: float = between(0.9, 1.4, "of the lever / what the pipe asks for")
    lever: Handlever = nested(Handlever, "lever")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        self.lever.build(t, self.length * (0.09 + 2.2 * radius))


class _Rack(Params):
    """A rack-and-pinion actuator: an extruded profile with end caps, an air pad, stop screws, an indicator."""

    kind = "rack and pinion"

    half: float = between(0.85, 1.2, "half its width / what the pipe asks for")
    reach: float = between(1.6, 3.0, "half its length / half its width")
    section: str = among(("rounded", "octagon", "round"), "section of its profile")
    bright: bool = chance(0.5, "its profile is bare, not painted")
    indicated: bool = chance(0.85, "shows the position")
    indicator: str = among(INDICATORS, _ABOUT_INDICATOR, when=lambda p: p.indicated)
    coil: bool = chance(0.4, "a solenoid valve on its air pad")
    tall: float = between(0.5, 1.6, "height of its bracket / half its width")
    mount: str = among(_MOUNTS, _ABOUT_MOUNT)
    turn: float = among(QUARTERS, _ABOUT_TURN, "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half = self.half * (0.028 + 0.36 * radius)
        tall, reach, t = self.tall * half + 0.01, self.reach * half, t.spun("z", self.turn)
        _put_mount(t, 0.9 * half, tall, self.mount)
        put_stem(t, 0.0, tall, 0.2 * half)
        t = t.at(0, 0, tall).bundled("actuator")
        if self.section == "rounded":
            section = rounded_rectangle(2 * half, 2.2 * half, 0.5 * half, 3)
        elif self.section == "octagon":
            section = circle(1.15 * half, 8, phase=np.pi / 8)
        else:
            section = circle(1.1 * half, t.n(half, 16))
        solids = [along("x", slab(section, -reach, reach), 0, 0, half)]
        caps = [(s, f, w) for s in BOTH for f, w in ((1.04, 0.3 * half), (0.75, 0.45 * half))]
        solids += [along("x", slab(section * f, *span(s * reach, s * (reach + w))), 0, 0, half) for s, f, w in caps]
        solids.append(box((0.9 * half, 0.3 * half, 0.7 * half), (0, 1.2 * half, half)))
        solids.append(cylinder(0.7 * half, -0.02 * half, 0.3 * half, 16))
        for x in (-0.3 * half, 0.3 * half):
            solids.append(rod((x, -1.1 * half, half), (x, -1.6 * half, half), 0.1 * half, 8))
        color = "clamp" if self.bright else "motor"
        t.add("actuator", *solids, of=color)
        t.add("actuator", cylinder(0.3 * half, 1.9 * half, 2.25 * half, 12), of=color)
        if self.indicated:
            put_indicator(t.at(0, 0, 2.25 * half), 0.5 * half, self.indicator)
        if self.coil:
            coil = box((0.05, 0.05, 0.07), (0, 1.35 * half + 0.025, half))
            t.add("actuator", coil, cylinder_at(0.014, half + 0.03, half + 0.09, 0.0), of="electrical")


class _Scotch(Params):
    """A scotch yoke actuator: a housing with a lid, a long pressure cylinder with tie rods, a spring can or none."""

    kind = "scotch yoke"

    reach: float = between(2.0, 3.6, "length of its cylinder / half the housing's width")
    wide: float = between(0.6, 0.95, "radius of its cylinder / half the housing's width")
    other: str = among(("spring", "cylinder", "plug"), "what is on its other side")
    spring: float = between(1.5, 3.0, "length of its spring can / half its width", when=lambda p: p.other == "spring")
    indicator: str = among(INDICATORS, _ABOUT_INDICATOR)
    mount: str = among(_MOUNTS, _ABOUT_MOUNT)
    turn: float = among(QUARTERS, _ABOUT_TURN, "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, t = 0.05 + 0.55 * radius, t.spun("z", self.turn)
        n, reach, wide, x, z = t.n(half, 16), self.reach * half, self.wide * half, 1.2 * half, 0.65 * half
        solids = [slab(rounded_rectangle(2.4 * half, 1.9 * half, 0.15 * half, 2), 0.0, 1.2 * half)]
        solids.append(slab(rounded_rectangle(2.6 * half, 2.1 * half, 0.2 * half, 2), 1.1 * half, 1.3 * half))
        square = rounded_rectangle(2.2 * wide, 2.2 * wide, 0.2 * wide, 2)
        cylinder_ = [along("x", turned(outline(wide, 0, wide, reach), n), x, 0, z)]
        cylinder_ += [along("x", slab(square, low, low + 0.12 * half), x, 0, z) for low in (0.0, reach)]
        for y, up in ((a * 0.95 * wide, z + b * 0.95 * wide) for a in BOTH for b in BOTH):
            cylinder_.append(rod((x, y, up), (1.4 * half + reach, y, up), 0.06 * half, 6))
        solids += cylinder_
        if self.other == "cylinder":
            solids += [moved(one, spun("z", np.pi)) for one in cylinder_]
        elif self.other == "spring":
            long = self.spring * half
            can = outline(0.85 * wide, 0, 0.85 * wide, 0.9 * long, 0.4 * wide, long, 0.12 * wide, long)
            solids.append(along("-x", turned([*can, (0.12 * wide, 1.2 * long)], n), -x, 0, z))
        else:
            solids.append(along("-x", turned(scaled(half, 0.4, 0, 0.3, 0.3), n), -x, 0, z))
        tall = 0.5 * half
        _put_mount(t, 0.9 * half, tall, self.mount)
        put_stem(t, 0.0, tall, 0.22 * half)
        t.at(0, 0, tall).bundled("actuator").add("actuator", *solids)
        put_indicator(t.at(0, 0, tall + 1.3 * half), 0.3 * half, self.indicator)


class _Vertical(Params):
    """A slim upright pneumatic cylinder, as on sanitary valves: polished, waisted, with an indicator on top."""

    kind = "upright cylinder"

    waist: float = between(0.85, 1.0, "radius of its middle / of its ends")
    indicator: str = among(INDICATORS, _ABOUT_INDICATOR)

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, tall, low = 0.022 + 0.45 * radius, 0.11 + 1.6 * radius, 0.03 + 0.3 * radius
        n, w = t.n(half, 16), self.waist
        side = outline(0.5, 0, 1, 0.08, 1, 0.18, w, 0.2, w, 0.8, 1, 0.82, 1, 0.93, 0.5, 1)
        ports = [rod((0, 0.8 * w * half, z * tall), (0, 1.4 * half, z * tall), 0.007, 8) for z in (0.3, 0.7)]
        can = turned([(x * half, z * tall) for x, z in side], n)
        t.bundled("actuator").add("actuator", moved(merge([can, *ports]), at(0, 0, low)), of="clamp")
        legs = [box((0.25 * half, 1.2 * half, low), (s * 0.6 * half, 0, low / 2)) for s in BOTH]
        plates = [cylinder(0.85 * half, low - 0.004, low + 0.003, n), cylinder(0.8 * half, 0.0, 0.004, n)]
        t.bundled(BODY).add("yoke", *legs, *plates, of="clamp")
        put_stem(t, 0.0, low, 0.16 * half)
        put_indicator(t.at(0, 0, low + tall), 0.45 * half, self.indicator)


class _MotorBox(Params):
    """A quarter-turn electric actuator: a compact box with ribbed lid, glands, indicator glass, hand crank or wheel."""

    kind = "electric box"

    half: float = between(0.85, 1.2, "half its width / what the pipe asks for")
    deep: float = between(0.7, 1.0, "half its depth / half its width")
    tall: float = between(1.2, 2.0, "height / half its width")
    corner: float = between(0.1, 0.6, "radius of its corners / half its depth")
    ribbed: bool = chance(0.4, "has ribs")
    indicator: str = among(INDICATORS[:3], _ABOUT_INDICATOR)
    wheeled: bool = chance(0.6, "has a handwheel")
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.wheeled)
    turn: float = among(QUARTERS, _ABOUT_TURN, "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half = self.half * (0.05 + 0.32 * radius)
        deep, tall, t = self.deep * half, self.tall * half, t.spun("z", self.turn)
        corner = self.corner * deep
        solids = [slab(rounded_rectangle(2.2 * half, 2 * deep, corner, 3), 0.25 * half, tall)]
        solids.append(slab(rounded_rectangle(2.35 * half, 2.15 * deep, corner, 3), 0.55 * tall, 0.62 * tall))
        solids.append(slab(rounded_rectangle(1.6 * half, 1.5 * deep, corner, 3), tall, tall + 0.15 * half))
        solids.append(cylinder(0.6 * half, 0.0, 0.3 * half, 16))
        if self.ribbed:
            rib = (0.06 * half, 2.3 * deep, 0.35 * tall)
            solids += [box(rib, (s * half, 0, 0.4 * tall)) for s in np.linspace(-0.8, 0.8, 5)]
        gland = hexagon(0.022, 1.05 * half, 1.1 * half + 0.025)
        solids += [along("-x", gland, 0, s * 0.4 * deep, 0.45 * tall) for s in BOTH]
        t.bundled("actuator").add("actuator", *solids)
        put_indicator(t.at(0.3 * half, 0, tall + 0.15 * half), 0.4 * half, self.indicator)
        if self.wheeled:
            side = t.at(-0.3 * half, -1.0 * deep, 0.55 * tall).spun("x", np.pi / 2)
            put_stem(side, 0.0, 0.45 * half, 0.08 * half)
            self.wheel.build(side, 0.6 * half, 0.4 * half, "gear operator")


class _MultiTurn(Params):
    """A multi-turn electric actuator shaped like an elbow: gear case, motor to one side, controls to the other."""

    kind = "multi-turn electric"

    half: float = between(0.9, 1.15, "half its case's width / what the pipe asks for")
    square: bool = chance(0.5, "its controls' case is square, not round")
    cover: float = between(1.9, 4.0, "height of the stem's cover pipe / half the case's width")
    wheel: Handwheel = nested(Handwheel, "handwheel")
    turn: float = among(QUARTERS, _ABOUT_TURN, "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, t = self.half * (0.06 + 0.4 * radius), t.spun("z", self.turn)
        n, z, x = t.n(half, 16), 0.9 * half, 0.4 * half
        solids = [turned(scaled(half, 0.95, 0, 0.95, 0.15, 0.7, 0.3, 0.75, 1.5, 0.5, 1.7), n)]
        motor = scaled(half, 0.62, 0, 0.62, 1.6, 0.56, 1.65, 0.56, 2.4, 0.4, 2.5)
        solids.append(along("x", turned(motor, n), x, 0, z))
        fin = circle(0.66 * half, n)
        solids += [along("x", slab(fin, f * half, (f + 0.06) * half), x, 0, z) for f in (0.5, 0.75, 1.0, 1.25)]
        if self.square:
            panel = rounded_rectangle(1.5 * half, 1.5 * half, 0.5 * half, 3)
            solids.append(along("-x", slab(panel, 0.5 * half, 1.5 * half), 0.1 * half, 0, z))
        else:
            solids.append(along("-x", turned(scaled(half, 0.8, 0.6, 0.8, 1.3, 0.7, 1.5), n), 0, 0, z))
        solids.append(turned(scaled(half, 0.2, 1.65, 0.2, self.cover, 0.1, 4.1), 10))
        t = t.bundled("actuator")
        t.add("actuator", *solids)
        glass = along("-x", cylinder(0.35 * half, 1.35 * half, 1.6 * half, 16), 0, 0, z + 0.1 * half)
        t.add("position indicator", glass, of="dial")
        side = t.at(0, -0.6 * half, z).spun("x", np.pi / 2)
        put_stem(side, 0.0, 0.55 * half, 0.12 * half)
        self.wheel.build(side, 0.75 * half, 0.5 * half, "gear operator")


class _Electrohydraulic(Params):
    """An electrohydraulic actuator: a box with a cylinder below, a motor and an oil bottle on it."""

    kind = "electrohydraulic"

    mount: str = among(_MOUNTS, _ABOUT_MOUNT)
    turn: float = among(QUARTERS, _ABOUT_TURN, "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half, t = 0.06 + 0.4 * radius, t.spun("z", self.turn)
        n, tall = t.n(half, 16), 0.4 * half
        base = turned(scaled(half, 0.5, -1.8, 0.55, -1.7, 0.55, 1.7, 0.5, 1.8), n)
        solids = [
            along("x", base, 0, 0, 0.55 * half),
            box((1.4 * half, 1.3 * half, 1.1 * half), (0, 0, 0.55 * half)),
            box((2.0 * half, 1.3 * half, 1.2 * half), (0.3 * half, 0, 1.7 * half)),
            box((0.02 * half, 1.0 * half, 0.9 * half), (1.31 * half, 0, 1.7 * half)),
            along("z", turned(scaled(half, 0.25, 1.1, 0.25, 2.4, 0.1, 2.6), 12), -1.0 * half, 0, -0.2 * half),
            box((0.7 * half, 0.6 * half, 0.3 * half), (-1.0 * half, 0, 0.95 * half)),
        ]
        _put_mount(t, 0.7 * half, tall, self.mount)
        put_stem(t, 0.0, tall, 0.2 * half)
        t.at(0, 0, tall).bundled("actuator").add("actuator", *solids)


OPERATORS: dict[str, Any] = {
    "worm": Worm, "bevel": Bevel, "rack": _Rack, "scotch": _Scotch, "vertical": _Vertical, "motor box": _MotorBox,
    "multi-turn": _MultiTurn, "electrohydraulic": _Electrohydraulic, "lever": _Lever,
}  # fmt: skip
"""Operators by their make; each is built on a table for a pipe's radius."""
_LARGE = ("worm", "bevel", "scotch", "multi-turn", "electrohydraulic")  # on pipes over 22 mm radius only
_ALL = ("lever", "lever", *list(OPERATORS)[:-1])


def _fit(makes: tuple[str, ...], radius: float) -> list[str]:
    """The makes that a pipe of a radius has in their place: small ones have no gears, large ones no levers."""
    if radius < 0.03:
        return ["lever" if make in _LARGE else make for make in makes]
    heavy = next((make for make in makes if make in _LARGE), "lever")
    return [heavy if radius > 0.12 and make == "lever" else make for make in makes]


class Operator(Scaled):
    """What turns a stem, on its pad on z = 0: a lever, a gear or an actuator."""

    make: str = among(lambda p: _fit(_ALL, p.radius), "what it is")
    form: Any = nested(lambda _, p: OPERATORS[p.make], "its proportions")


def operator(
    *makes: str, radius: Callable[[Any], float] | None = None, when: Callable[[Any], bool] | None = None
) -> Any:
    """A field for what turns a stem.

    Args:
        makes: to draw from: ``lever`` or those of actuators and gears; all by default.
        radius: that it is scaled by, from the fields before [m]; the pipe's if None.
        when: whether there is one, by the fields before.
    """
    return driven(of_makes(Operator, makes or _ALL, _fit), "what turns its stem", radius, when)
