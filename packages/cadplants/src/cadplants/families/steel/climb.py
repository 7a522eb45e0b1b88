"""Ladders: fixed, hooped, ship's, leaning, step ladders, rung irons, mobile steps."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form, one_of
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.caster import Casters
from cadplants.families.steel.floor import panel
from cadplants.families.steel.shape import (
    Structure,
    bar,
    few_sides,
    filleted,
    pipe,
    section,
    span_of,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, merge, moved, sweep
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, box, cylinder, ring
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["CLIMBS"]

_SIDES = ("flat", "CHS", "L", "RHS", "U")


def _rung(kind: str, wide: float, z: float, style: ModelingStyle) -> Solid:
    """A rung about x = 0 at a height: round, square on its edge or flat, a U with teeth, a flat step."""
    a, b = (-wide / 2, 0, z), (wide / 2, 0, z)
    if kind == "round":
        return pipe([a, b], 0.0125, style)
    if kind == "square":
        return bar(a, b, section("square", 0.022, style), (0, 1, 1))
    if kind == "serrated":
        teeth = [box((0.012, 0.026, 0.006), (x, 0, z + 0.012)) for x in np.linspace(-0.4 * wide, 0.4 * wide, 7)]
        return merge([bar(a, b, section("U", 0.026, style), (0, 1, 0)), *teeth])
    return box((wide, 0.08, 0.02), (0, 0, z))


def _side_rails(kind: str, wide: float, h: float, style: ModelingStyle) -> list[Solid]:
    one = section(kind, 0.065 if kind in ("flat", "RHS") else 0.048, style)
    return [bar((s * wide / 2, 0, 0.0), (s * wide / 2, 0, h), one, (0, 1, 0)) for s in BOTH]


class _Back(Params):
    """What a fixed ladder is held by: a wall, a round tower, a pair of columns; and its stand-off brackets."""

    gap: float = between(0.15, 0.25, "from the ladder to it", "m")
    form: str = among(("wall", "tower", "columns"), "what it is")
    radius: float = between(0.2, 0.6, "of the tower", "m", when=of_form("tower"))
    column: str = among(("H", "SHS", "U"), "section of the columns", when=of_form("columns"))

    def build(self, t: Table, h: float, wide: float) -> None:
        """Puts it down behind a ladder of a height and width [m]."""
        y, r = self.gap, self.radius
        if self.form == "wall":
            t.add("wall", box((wide + 1.0, 0.2, h), (0, y + 0.1, h / 2)))
        elif self.form == "tower":
            t.at(0, y + r).add("column", cylinder(r, 0, h, few_sides(t.style, r, 32)), of="concrete")
            y += r - float(np.sqrt(max(r * r - wide * wide / 4, 0.0)))
        else:
            one = section(self.column, 0.14, t.style)
            back = y + span_of(one)[3]
            t.add_each("column", [bar((s * wide / 2, back, 0), (s * wide / 2, back, h), one, (0, 1, 0)) for s in BOTH])
        for z in np.linspace(0.35, h - 0.3, max(2, int(h / 1.6))):
            x = wide / 2 - 0.02
            t.add_each("bracket", [box((0.01, y + 0.02, 0.05), (s * x, y / 2 - 0.01, z)) for s in BOTH])


class Fixed(Structure, name="ladder/fixed", weight=1.2):
    """A fixed ladder (EN ISO 14122-4): rungs of any kind, walk-through top, on a wall, tower or columns, no cage."""

    height: float = between(1.2, 4.5, "of the ladder", "m")
    width: float = between(0.35, 0.55, "of the ladder", "m")
    pitch: float = between(0.25, 0.3, "from rung to rung", "m")
    rung: str = among(("round", "square", "serrated", "step"), "how the rungs are made")
    side: str = among(_SIDES, "section of the stiles")
    top: str = among(("plain", "bows", "splayed"), "of the stiles")
    fall_rail: bool = chance(0.4, "a rail for a fall arrester", when=lambda p: p.top == "plain")
    joined: bool = chance(0.45, "the ladder is one mesh")
    back: _Back = nested(_Back, "what holds it")

    def build(self, t: Table) -> Model:
        h, wide, style = self.height, self.width, t.style
        solids = _side_rails(self.side, wide, h, style)
        solids += [_rung(self.rung, wide, float(z), style) for z in np.arange(self.pitch, h - 0.05, self.pitch)]
        for s in BOTH:
            x = s * wide / 2
            if self.top == "bows":
                bow = [(x, 0, h), (x, 0, h + 0.9), (x, 0.35, h + 0.9), (x, 0.35, h)]
                solids.append(pipe(bow, 0.021, style, 0.15))
            elif self.top == "splayed":
                solids.append(pipe([(x, 0, h), (s * 0.32, 0, h + 0.2), (s * 0.32, 0, h + 1.0)], 0.019, style, 0.08))
        if self.fall_rail:
            solids.append(box((0.05, 0.03, h - 0.2), (0, -0.025, h / 2)))
        t.bundled("ladder").add_each("ladder", solids, joined=self.joined)
        self.back.build(t, h, wide)
        return t.model()


class Hooped(Structure, name="ladder/hoops"):
    """A ladder with round, square or open hoops of flat bar or tube and three to seven straps (EN ISO 14122-4)."""

    height: float = between(2.6, 5.0, "of the ladder", "m")
    width: float = between(0.38, 0.5, "of the ladder", "m")
    side: str = among(_SIDES, "section of the stiles")
    rung: str = among(("round", "square", "serrated"), "how the rungs are made")
    reach: float = between(0.6, 0.75, "of a hoop", "m")
    hoop: str = among(("round", "square", "faceted"), "how the hoops are bent")
    tubes: bool = chance(0.3, "the hoops are of tube, not flat bar")
    straps: int = whole(3, 7, "that join the hoops")
    joined: bool = chance(0.45, "the ladder is one mesh")
    back: _Back = nested(_Back, "what holds it")

    def build(self, t: Table) -> Model:
        h, wide, reach, style = self.height, self.width, self.reach, t.style
        solids = _side_rails(self.side, wide, h, style)
        solids += [_rung(self.rung, wide, float(z), style) for z in np.arange(0.28, h - 0.05, 0.28)]
        half = [(0.35, -reach), (0.35, -0.15), (wide / 2, 0)]
        radius, steps = {"round": (0.34, 6), "square": (0.1, 2), "faceted": (0.25, 1)}[self.hoop]
        corners = filleted([*half[::-1], *((-x, y) for x, y in half)], radius, steps, closed=False)
        path = np.column_stack([corners, np.zeros(len(corners))])
        flat = rounded_rectangle(0.04, 0.006, 0.0)
        hoop = pipe(path, 0.012, style) if self.tubes else sweep(path, flat, up=(0, 0, 1))
        levels = np.linspace(2.2, h, max(2, int((h - 2.2) / 0.8) + 1))
        solids += [moved(hoop, at(0, 0, float(z))) for z in levels]
        s = np.cumsum([0, *np.linalg.norm(np.diff(corners, axis=0), axis=1)])
        size = (0.03, 0.03, h - 2.2) if self.tubes else (0.025, 0.012, h - 2.2)
        for f in np.linspace(0.2, 0.8, self.straps) * s[-1]:
            solids.append(box(size, (*(float(np.interp(f, s, corners[:, k])) for k in (0, 1)), (h + 2.2) / 2)))
        t.bundled("ladder").add_each("ladder", solids, joined=self.joined)
        self.back.build(t, h, wide)
        return t.model()


class Ship(Structure, name="ladder/ship"):
    """A ship's or step ladder at 60 to 75 degrees: flat steps between strings, a handrail each side, a landing beam."""

    height: float = between(1.0, 3.0, "of the ladder", "m")
    width: float = between(0.45, 0.7, "of the ladder", "m")
    slope: float = between(60, 75, "of the ladder", "degrees")
    string: str = among(("flat", "U", "RHS"), "section of the strings")
    size: float = between(0.1, 0.16, "height of a string", "m")
    deep: float = between(0.08, 0.18, "depth of a step", "m")
    step: str = among(("sheet", "bar", "fold"), "how the steps are made")
    both: bool = chance(0.7, "a handrail on both sides, not on one")
    landing: str = among(("U", "H", "I"), "section of the landing's beam")

    def build(self, t: Table) -> Model:
        h, wide, angle, own = self.height, self.width, np.radians(self.slope), t.bundled("ladder")
        run = h / np.tan(angle)
        one = section(self.string, self.size, t.style)
        own.add_each("ladder", [bar((0, s * wide / 2, 0), (run, s * wide / 2, h), one) for s in BOTH])
        step = panel(self.step, self.deep, wide, 0.025, t.style)
        for z in np.arange(0.22, h - 0.1, 0.22):
            own.at(z / np.tan(angle), 0, z - 0.025).add("stair tread", step, of="clamp")
        off = np.array([-0.25 * np.sin(angle), 0, 0.25 * np.cos(angle)])
        for s in BOTH if self.both else (1,):
            ends = [np.array([f * run, s * (wide / 2 + 0.02), f * h]) for f in (0.1, 1.0)]
            path = [ends[0], ends[0] + off, ends[1] + off, ends[1]]
            t.add("railing", pipe(path, 0.017, t.style, 0.1), of="handle")
        edge, x, z = section(self.landing, 0.14, t.style), run + 0.05, h - 0.07
        t.add("beam", bar((x, -wide, z), (x, wide, z), edge))
        t.add_each("column", [box((0.1, 0.1, h - 0.14), (run + 0.07, s * 0.8 * wide, (h - 0.14) / 2)) for s in BOTH])
        return t.model()


class _Portable(Params):
    """A section of a portable ladder."""

    long: float = given(3.0, "length", "m")
    low: float = given(0.0, "where it begins", "m")
    rungs: tuple[str, ...] = several(
        one_of("round", "square"), lambda p: len(_levels(p.low, p.long)), "how a rung is made"
    )
    joined: bool = chance(0.45, "in one mesh")


def _levels(low: float, long: float) -> Floats:
    return np.arange(low + 0.2, low + long - 0.1, 0.28)


class Leaning(Structure, name="ladder/leaning", weight=0.7, grain="fitting"):
    """A portable ladder leaning on a wall, single or two overlapped sections (EN 131), with feet; or hung up level."""

    length: float = between(1.8, 4.2, "of a section", "m")
    width: float = between(0.32, 0.45, "of the ladder", "m")
    side: str = among(("RHS", "timber", "U"), "section of the stiles")
    hung: bool = chance(0.25, "hung up level")
    tilt: float = between(0.2, 0.35, "from upright", "rad", when=lambda p: not p.hung)
    count: int = whole(1, 2, "sections", when=lambda p: not p.hung, otherwise=1)
    lower: _Portable = nested(_Portable, "lower section", fixed=lambda p: {"long": p.length})
    upper: _Portable = nested(
        _Portable,
        "upper section",
        fixed=lambda p: {"long": p.length, "low": 0.4 * p.length},
        when=lambda p: p.count == 2,
    )

    def build(self, t: Table) -> Model:
        long, wide, hung, tilt = self.length, self.width, self.hung, self.tilt
        one = section(self.side, 0.06, t.style)
        leant = t.spun("x", -tilt).bundled("ladder")
        for k, part in enumerate((self.lower, self.upper)[: self.count]):
            low, x = part.low, wide / 2
            solids = [bar((s * x, 0, low), (s * x, 0, low + long), one, (0, 1, 0)) for s in BOTH]
            levels = zip(part.rungs, _levels(low, long), strict=True)
            solids += [_rung(kind, wide, float(z), t.style) for kind, z in levels]
            if k == 0 and not hung:
                solids += [box((0.04, 0.08, 0.03), (s * x, 0, 0.01)) for s in BOTH]
            here = leant.at(-long / 2, 0, 1.2).spun("y", np.pi / 2) if hung else leant.at(0, -0.06 * k, 0)
            here.add_each("ladder", solids, of="clamp", joined=part.joined)
        high = 2.0 if hung else long * np.cos(tilt)
        y = 0.035 if hung else long * np.sin(tilt) + 0.03 * np.cos(tilt)
        t.add("wall", box((long + 0.4 if hung else 1.6, 0.15, high), (0, y + 0.075, high / 2)))
        if hung:
            z = 1.2 - wide / 2 - 0.03
            t.add_each("bracket", [box((0.04, 0.1, 0.03), (s * 0.3 * long, -0.015, z)) for s in BOTH])
        return t.model()


class Steps(Structure, name="ladder/steps", weight=0.8, grain="fitting"):
    """A free-standing step ladder (EN 131): steps between two front stiles, rear struts, a top platform or cap."""

    count: int = whole(2, 7, "steps")
    width: float = between(0.35, 0.55, "of the top", "m")
    lean: float = between(0.25, 0.35, "run / height of the front stiles")
    side: str = among(("U", "RHS", "timber", "CHS"), "section of the stiles")
    joined: bool = chance(0.4, "in one mesh")
    cap: float = between(0.15, 0.35, "depth of the top", "m")
    bowed: bool = chance(0.4, "a bow to hold on to")

    def build(self, t: Table) -> Model:
        wide, lean, h, n = self.width, self.lean, 0.23 * self.count, self.count
        one, run = section(self.side, 0.05, t.style), lean * h
        solids = []
        for s in BOTH:
            y = s * wide / 2
            solids.append(bar((0, s * (wide / 2 + 0.05), 0), (run, y, h), one))
            solids.append(bar((2.1 * run + 0.1, s * (wide / 2 + 0.03), 0), (run + 0.1, y, h), one))
        solids += [box((0.02, wide, 0.03), (run * (2.1 - 1.1 * f) + 0.1, 0, f * h)) for f in (0.2, 0.6)]
        treads = [box((0.09, wide + 0.06 * (1 - k / n), 0.025), (run * k / n, 0, h * k / n)) for k in range(1, n)]
        treads.append(box((self.cap, wide + 0.05, 0.03), (run + 0.05, 0, h + 0.01)))
        if self.bowed:
            half = [(run, h), (run + 0.15, h + 0.6)]
            path = [(x, -wide / 2, z) for x, z in half] + [(x, wide / 2, z) for x, z in half[::-1]]
            solids.append(pipe(path, 0.014, t.style, 0.08))
        if self.joined:
            t.add("ladder", *solids, *treads, of="clamp")
        else:
            t.bundled("ladder").add_each("ladder", solids, of="clamp")
            t.bundled("ladder").add_each("stair tread", treads, of="clamp")
        return t.model()


class RungIrons(Structure, name="ladder/rung irons", weight=0.7, grain="fitting"):
    """Rung irons cast into a wall, pit or shaft ring (EN 13101): bows one above the other, in one row or staggered."""

    count: int = whole(3, 10, "irons")
    width: float = between(0.25, 0.4, "of an iron", "m")
    reach: float = between(0.12, 0.2, "of an iron", "m")
    radius: float = between(0.009, 0.014, "of an iron's bar", "m")
    stagger: float = among((0.0, 0.0, 0.14), "how far an iron is out of line", "m")
    wall: bool = chance(0.6, "in a wall, not a shaft")
    bend: float = between(0.45, 0.7, "radius of the shaft", "m", when=lambda p: not p.wall)
    dip: float = among((0.0, 0.03), "how far an iron's middle is down", "m")

    def build(self, t: Table) -> Model:
        wide, h, bend = self.width, 0.3 * self.count + 0.4, self.bend
        if self.wall:
            t.add("wall", box((1.4, 0.2, h), (0, 0.1, h / 2)))
        else:
            shaft = ring(bend, bend + 0.1, 0, h, few_sides(t.style, bend, 32))
            t.at(0, -float(np.sqrt(bend * bend - wide * wide / 4))).add("wall", shaft)
        half = [(wide / 2 - 0.05, -self.reach, -self.dip), (wide / 2, -self.reach, 0.0), (wide / 2, 0.02, 0.0)]
        path = [*((-x, y, z) for x, y, z in half[::-1]), *half]
        iron = pipe(path, self.radius, t.style, 0.03)
        for k in range(self.count):
            t.at(self.stagger * (-1) ** k, 0, 0.3 + 0.3 * k).add("ladder", iron, of="steel")
        return t.model()


class Mobile(Structure, name="ladder/mobile", weight=0.9, grain="fitting"):
    """Mobile steps (EN 131-7): a tube frame on casters with treads, a platform and a railing round it."""

    count: int = whole(2, 6, "steps with the platform")
    width: float = between(0.5, 0.8, "of the steps", "m")
    radius: float = between(0.04, 0.07, "of a caster's wheel", "m")
    going: float = between(0.19, 0.25, "of a step", "m")
    land: float = between(0.4, 0.7, "length of the platform", "m")
    make: str = among(("swivel", "stem", "fixed"), "of the casters")
    casters: Casters = nested(Casters, "casters", fixed=lambda p: {"makes": (p.make,)})
    railed: bool = chance(0.8, "a railing on either side")
    step: str = among(("bar", "sheet", "fold", "perforated"), "how steps and platform are made")

    def build(self, t: Table) -> Model:
        n, wide, go, land, d, style = self.count, self.width, self.going, self.land, 0.02, t.style
        run, own = go * n, t.bundled("ladder")
        low = self.casters.build(t, [(x, s * wide / 2) for x in (0.05, run + land) for s in BOTH], self.radius)
        rise, z = 0.04 + 0.21 * n, low + d
        h = low + rise
        for y in (-wide / 2, wide / 2):
            own.add("ladder", pipe([(0, y, z), (run + land, y, z)], d, style))
            own.add("ladder", pipe([(0.0, y, z), (run, y, h)], d, style))
            posts = [pipe([(x, y, z), (x, y, h)], d, style) for x in (run, run + land)]
            own.add_each("post", posts, of="safety")
            if self.railed:
                foot, far = low + 0.4 * rise, run + land
                ways = ((0.4 * run, foot), (0.4 * run, foot + 0.8), (run, h + 0.95), (far, h + 0.95), (far, h))
                own.add("railing", pipe([(x, y, z) for x, z in ways], 0.8 * d, style, 0.1))
        step = panel(self.step, go, wide - 2 * d, 0.025, style)
        for k in range(1, n):
            own.at(run * k / n, 0, low + rise * k / n).add("stair tread", step, of="clamp")
        own.at(run + land / 2, 0, h).add("platform", panel(self.step, land, wide + 2 * d, 0.03, style))
        return t.model()


CLIMBS = families_of(Fixed, Hooped, Ship, Leaning, Steps, RungIrons, Mobile)
