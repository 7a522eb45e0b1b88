"""Braced frames, racks and gantries, and loose plates: rods with turnbuckles, K and X braces, back-to-back angles."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, of_form, one_of, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.caster import Casters
from cadplants.families.steel.shape import (
    RUNWAYS,
    Base,
    Section,
    Structure,
    bar,
    bases,
    bolts,
    few_sides,
    flat,
    lug,
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    span_of,
    trolley,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, box, cylinder, rod
from cadplants.solids.transforms import at, looking, spun

__all__ = ["BRACES"]

Line = tuple[Floats, Floats]
Corner = tuple[float, float, int, int]


class _Bay(Params):
    """Two columns on base plates and a beam between or on them."""

    column_size: float = between(0.1, 0.2, "height of a column's section", "m")
    column: str = among(("H", "SHS", "I", "CHS"), "section of the columns")
    beam_size: float = between(0.1, 0.22, "height of the beam's section", "m")
    beam: str = among(("I", "H", "RHS", "U"), "section of the beam")
    bases: tuple[Base, ...] = bases(2)
    over: bool = chance(0.5, "the beam is on the columns, not between them")

    def build(self, t: Table, w: float, h: float) -> tuple[float, float]:
        """Puts it down, of a width and height; half a column's width and the beam's underside [m]."""
        column, beam = section(self.column, self.column_size, t.style), section(self.beam, self.beam_size, t.style)
        half, (_x0, _x1, y0, y1) = float(column[0][:, 0].max()), span_of(beam)
        for x, base in zip((0.0, w), self.bases, strict=True):
            low = base.build(t.at(x), 2 * half + 0.14, 2 * half + 0.14)
            t.add("column", bar((x, 0, low), (x, 0, h), column, (0, 1, 0)))
        if self.over:
            t.add("beam", bar((-0.15, 0, h - y0), (w + 0.15, 0, h - y0), beam))
            return half, h
        t.add("beam", bar((half, 0, h - y1), (w - half, 0, h - y1), beam))
        return half, h - (y1 - y0)


class _Member(Params):
    """One of the braces."""

    form: str = given("tube", "rod, angles, tube, flat or angle")
    radius: float = between(0.008, 0.014, "of a rod", "m", when=of_form("rod"))
    leg: float = between(0.05, 0.07, "of an angle of two", "m", when=of_form("angles"))
    joined: bool = chance(0.4, "both angles are one mesh", when=of_form("angles"))

    def build(self, t: Table, line: Line, one: Section, way: int, spread_by: float, knee: bool) -> None:
        """Puts it down along a line, towards one side or the other; crossed ones are spread [m]."""
        a, b = line
        if self.form == "rod":
            self._rod(t, a + np.array([0, spread_by * way, 0]), b + np.array([0, spread_by * way, 0]))
        elif self.form == "angles":
            t.add_each("brace", self._angles(t, a, b), joined=self.joined)
        elif self.form == "flat":
            t.at(0, 0.009 * way).add("brace", flat(a, b, 0.06, 0.008))
        else:
            shift = -0.005 - span_of(one)[1] if self.form == "angle" and not knee else 0.0
            t.at(0, shift * way).add("brace", bar(a, b, one))

    def _rod(self, t: Table, a: Floats, b: Floats) -> None:
        """A tie rod with forks at its ends and a turnbuckle (EN 1090 practice)."""
        r, x = self.radius, (b - a) / np.linalg.norm(b - a)
        frame = [moved(box((1.6 * r, 1.2 * r, 12 * r)), at(s * 2.0 * r)) for s in BOTH]
        frame += [moved(cylinder(2.2 * r, -2 * r, 2 * r, 8), at(0, 0, s * 6 * r)) for s in BOTH]
        t.add("brace", pipe(np.array([a + 3 * r * x, b - 3 * r * x]), r, t.style))
        t.moved(looking((a + b) / 2, x)).spun("y", np.pi / 2).add("brace", *frame, of="clamp")
        for end, s in ((a, 1), (b, -1)):
            fork = t.moved(looking(end + s * 3 * r * x, x)).spun("y", np.pi / 2)
            fork.add("bracket", cylinder(2 * r, -4 * r, 4 * r, 8), of="clamp")

    def _angles(self, t: Table, a: Floats, b: Floats) -> list[Solid]:
        """Two angles back to back with a gusset's thickness and packs between them."""
        leg = self.leg
        one = section("L", leg, t.style)[0] + np.array([0.28 * leg + 0.006, 0.0])
        left = np.column_stack([-one[:, 0], one[:, 1]])[::-1]
        packs = [looking(a + f * (b - a), b - a) for f in (0.3, 0.7)]
        return [*(bar(a, b, (s, ())) for s in (one, left)), *(moved(box((0.05, 0.012, 0.8 * leg)), p) for p in packs)]


def _gussets(count: int) -> tuple[str, ...]:
    """The forms of this many gusset plates."""
    forms = "triangle", "chamfered", "rectangle"
    return several(one_of(*forms), count, "form of a gusset plate")


def _members(count: int) -> tuple[_Member, ...]:
    return several(made(_Member, lambda p: {"form": p.brace}), count, "one of the braces")


class _Braced(Structure, grain="fitting"):
    """A braced bay (EN 1993-1-8 details): X, K, V, single or knee braces on gusset plates with bolts."""

    width: float = between(1.2, 3.2, "of the bay", "m")
    height: float = between(1.6, 3.4, "of the bay", "m")
    bay: _Bay = nested(_Bay, "columns and beam")
    gussets: tuple[str, ...] = _gussets(2)
    gusset: float = between(0.14, 0.26, "side of a gusset plate", "m", when=lambda p: len(p.gussets) > 0)
    brace: str = among(("rod", "angles", "tube", "flat", "angle"), "what the braces are")
    tube: str = among(("CHS", "SHS"), "section of tubes", when=lambda p: p.brace == "tube", otherwise="L")
    size: float = between(0.05, 0.09, "height of a tube or an angle", "m", when=lambda p: p.brace in ("tube", "angle"))
    members: tuple[_Member, ...] = _members(2)

    def build(self, t: Table) -> Model:
        half, top = self.bay.build(t, self.width, self.height)
        lines, corners, g = self._lines(t, half, top), self._corners(half, top), self.gusset
        for corner, form in zip(corners, self.gussets, strict=True):
            self._gusset(t, corner, form)
        one = section(self.tube, self.size or 0.06, t.style)
        by = 0.0144 if len(corners) == 4 else 0.0
        for k, (line, member) in enumerate(zip(lines, self.members, strict=True)):
            member.build(t, line, one, (-1) ** k, by, knee=not corners)
        if self.brace != "rod":
            spots = [(x + sx * 0.3 * g, z + sz * 0.3 * g) for x, z, sx, sz in corners]
            bolts(t, [at(x, -0.005, z) @ spun("x", np.pi / 2) for x, z in spots], 0.014, 0.012, True)
        return t.model()

    def _gusset(self, t: Table, corner: Corner, form: str) -> None:
        """A gusset plate in a corner about y = 0."""
        (x, z, sx, sz), g = corner, self.gusset
        shape = {
            "triangle": [(0, 0), (g, 0), (0, g)],
            "chamfered": [(0, 0), (g, 0), (g, 0.35 * g), (0.35 * g, g), (0, g)],
            "rectangle": [(0, 0), (g, 0), (g, 0.8 * g), (0, 0.8 * g)],
        }[form]
        t.at(x, 0, z).moved(np.diag([float(sx), 1.0, float(sz), 1.0])).add("gusset plate", slab_xz(shape, 0.01))

    def _ends(self, half: float, top: float) -> list[Floats]:
        """Where braces end at the corners."""
        return [
            np.array([x + sx * 0.35 * self.gusset, 0.0, z + sz * 0.35 * self.gusset])
            for x, z, sx, sz in self._corners(half, top)
        ]

    def _corners(self, half: float, top: float) -> list[Corner]:
        """Corners with gusset plates: place in x and z, ways into the bay."""
        return [(half, 0.05, 1, 1), (self.width - half, top, -1, -1)]

    def _lines(self, t: Table, half: float, top: float) -> list[Line]:
        """Axes of the braces."""
        ends = self._ends(half, top)
        return list(zip(ends[::2], ends[1::2], strict=True))


class Crossed(_Braced, name="brace/crossed", weight=1.3):
    """A braced bay with two braces that cross on gusset plates with bolts (EN 1993-1-8 details)."""

    gussets: tuple[str, ...] = _gussets(4)

    def _corners(self, half: float, top: float) -> list[Corner]:
        other = [(self.width - half, 0.05, -1, 1), (half, top, 1, -1)]
        return [*super()._corners(half, top), *other]


class Chevron(_Braced, name="brace/chevron", weight=1.2):
    """A braced bay with two braces from the feet to the beam's middle (EN 1993-1-8 details)."""

    def _corners(self, half: float, top: float) -> list[Corner]:
        return [(half, 0.05, 1, 1), (self.width - half, 0.05, -1, 1)]

    def _lines(self, t: Table, half: float, top: float) -> list[Line]:
        x, g = self.width / 2, self.gusset
        t.add(
            "gusset plate", slab_xz([(x - g, top - 0.7 * g), (x + g, top - 0.7 * g), (x + g, top), (x - g, top)], 0.01)
        )
        apex = [np.array([x + s * 0.3 * g, 0.0, top - 0.4 * g]) for s in BOTH]
        return list(zip(self._ends(half, top), apex, strict=True))


class Diagonal(_Braced, name="brace/diagonal"):
    """A braced bay with one brace from corner to corner (EN 1993-1-8 details)."""

    members: tuple[_Member, ...] = _members(1)


class Knee(_Braced, name="brace/knee"):
    """A bay with knee braces under its beam (EN 1993-1-8 details)."""

    gussets: tuple[str, ...] = _gussets(0)
    brace: str = among(("tube", "angle", "flat"), "what the braces are")

    def _corners(self, half: float, top: float) -> list[Corner]:
        return []

    def _lines(self, t: Table, half: float, top: float) -> list[Line]:
        w, d = self.width, min(0.8, 0.3 * self.width, 0.3 * self.height)
        ends = ((half, half + d), (w - half, w - half - d))
        return [(np.array([a, 0, top - d]), np.array([b, 0, top])) for a, b in ends]


class _Side(Params):
    """What is between the frames of a rack."""

    braced: bool = chance(0.6, "with a brace")
    brace: str = among(("L", "CHS", "flat"), "section of the brace", when=lambda p: p.braced)


class _Pipe(Params):
    """A place for a pipe on a tier."""

    there: bool = chance(0.5, "there is a pipe")
    radius: float = among((0.03, 0.057, 0.084), "of the pipe", "m", when=lambda p: p.there)


class Rack(Structure, name="frame/pipe rack", label="beam", weight=1.2, grain="fitting"):
    """A bay of a pipe rack: two frames with tiers, cantilevers, struts, braces; some pipes on the tiers."""

    width: float = between(1.2, 3.0, "along a tier", "m")
    depth: float = between(1.2, 3.0, "from frame to frame", "m")
    height: float = between(1.8, 3.8, "of the highest tier", "m")
    column_size: float = between(0.12, 0.2, "height of a column's section", "m")
    column: str = among(("H", "SHS"), "section of the columns")
    beam_size: float = between(0.1, 0.2, "height of a tier's section", "m")
    beam: str = among(("H", "I", "U"), "section of the tiers")
    strut_size: float = between(0.08, 0.14, "height of a strut's section", "m")
    strut: str = among(("SHS", "U", "I"), "section of the struts")
    tiers: int = whole(1, 3, "one above the other")
    armed: bool = among((False, True), "with cantilevers")
    arm: float = between(0.4, 0.8, "length of a cantilever", "m", when=lambda p: p.armed)
    bases: tuple[Base, ...] = bases(4)
    sides: tuple[_Side, ...] = several(made(_Side), 2, "between the frames")
    pipes: tuple[_Pipe, ...] = several(
        made(_Pipe), lambda p: p.tiers * len(np.arange(0.3, p.width - 0.2, 0.4)), "place for a pipe, tier by tier"
    )

    def build(self, t: Table) -> Model:
        w, d, h, style = self.width, self.depth, self.height, t.style
        column, beam = section(self.column, self.column_size, style), section(self.beam, self.beam_size, style)
        strut, half, y1 = section(self.strut, self.strut_size, style), span_of(column)[1], span_of(beam)[3]
        levels = np.linspace(h, 0.45 * h, self.tiers)
        for k, y in enumerate((0.0, d)):
            for x, base in zip((0.0, w), self.bases[2 * k :], strict=False):
                low = base.build(t.at(x, y), 0.3, 0.3)
                t.add("column", bar((x, y, low), (x, y, h), column, (0, 1, 0)))
            ends = [(half, w - half), (w + half, w + half + self.arm)][: 1 + self.armed]
            t.add_each("beam", [bar((a, y, z - y1), (b, y, z - y1), beam) for z in levels for a, b in ends])
        back, z = span_of(column)[3], 0.7 * h
        for x, side in zip((0.0, w), self.sides, strict=True):
            t.add("beam", bar((x, back, z), (x, d - back, z), strut))
            if side.braced:
                t.add("brace", bar((x, back, 0.15), (x, d - back, z - 0.06), section(side.brace, 0.05, style)))
        spots = [(x, z) for z in levels for x in np.arange(0.3, w - 0.2, 0.4)]
        for (x, z), one in zip(spots, self.pipes, strict=True):
            if one.there:
                path = [(x, -0.4, z + one.radius), (x, d + 0.4, z + one.radius)]
                t.add("pipe", pipe(path, one.radius, style, 0.0, 0.004))
        return t.model()


def _is_portal(p: Any) -> bool:
    return not p.tripod


def _on_casters(p: Any) -> bool:
    return bool(p.wheeled)


class Gantry(Structure, name="frame/gantry", label="beam", grain="fitting"):
    """A lifting gantry or tripod: splayed legs with ties, a runway beam with an eye or trolley, on casters or feet."""

    tripod: bool = chance(0.3, "three legs that meet")
    width: float = between(1.2, 3.0, "along the runway", "m", when=_is_portal)
    height: float = between(1.6, 3.0, "of the legs", "m")
    depth: float = between(0.8, 1.4, "of the feet's spread", "m", when=_is_portal)
    leg_size: float = between(0.06, 0.1, "height of a leg's section", "m")
    leg: str = among(("SHS", "CHS", "U", "L"), "section of the legs")
    ties: tuple[bool, ...] = several(
        yes(0.8), 3, "whether a tie is between two legs of a tripod", when=lambda p: p.tripod
    )
    wheeled: bool = chance(0.6, "on casters", when=_is_portal)
    make: str = among(("swivel", "heavy", "braked"), "of the casters", when=_on_casters)
    radius: float = between(0.05, 0.09, "of a caster's wheel", "m", when=_on_casters)
    casters: Casters = nested(Casters, "casters", fixed=lambda p: {"makes": (p.make,)}, when=_on_casters)
    called: tuple[str, ...] = several(one_of("brace", "beam"), 2, "what a tie is called", when=_is_portal)
    runway_size: float = between(0.12, 0.24, "height of the runway's section", "m", when=_is_portal)
    runway: str = among(RUNWAYS, "section of the runway", when=_is_portal)
    eyed: bool = chance(0.5, "a lifting eye under the runway, not a trolley on it", when=_is_portal)
    braced: bool = chance(0.5, "knee braces to the runway", when=_is_portal)

    def build(self, t: Table) -> Model:
        leg = section(self.leg, self.leg_size, t.style)
        return self._three(t, leg) if self.tripod else self._portal(t, leg)

    def _three(self, t: Table, leg: Section) -> Model:
        h, r = self.height, 0.4 * self.height
        for k, tied in enumerate(self.ties):
            (x, y), (x2, y2) = ((r * np.cos(2.0944 * j), r * np.sin(2.0944 * j)) for j in (k, k + 1))
            t.add("column", bar((x, y, 0.01), (0.08 * x / r, 0.08 * y / r, h), leg))
            t.at(x, y).add("base plate", cylinder(0.09, 0, 0.01, 14))
            if tied:
                t.add("brace", rod((0.6 * x, 0.6 * y, 0.4 * h), (0.6 * x2, 0.6 * y2, 0.4 * h), 0.015, 10))
        t.add("plate", cylinder(0.16, h, h + 0.02, 20))
        t.at(0, 0, h).spun("x", np.pi).add("lifting lug", lug(t.style, 0.08, 0.015), of="steel")
        return t.model()

    def _portal(self, t: Table, leg: Section) -> Model:
        w, h, d, low = self.width, self.height, self.depth, 0.01
        spots = [(x, s * d / 2) for x in (0.0, w) for s in BOTH]
        if self.wheeled:
            low = self.casters.build(t, spots, self.radius)
        else:
            t.add_each("base plate", [box((0.2, 0.2, 0.01), (x, y, 0.005)) for x, y in spots])
        deep, knee = float(np.ptp(leg[0][:, 1])) / 2, min(0.5, 0.28 * w)
        tie = h - knee if self.braced else 0.45 * h  # knee braces end on it
        reach = 0.06 + (d / 2 - 0.06) * (h - tie) / (h - low - 2 * deep)
        for x, name in zip((0.0, w), self.called, strict=True):
            t.add("beam", bar((x, -d / 2 - 0.1, low + deep), (x, d / 2 + 0.1, low + deep), leg))
            t.add_each("column", [bar((x, s * d / 2, low + 2 * deep), (x, s * 0.06, h), leg) for s in BOTH])
            t.add(name, bar((x, -reach, tie), (x, reach, tie), leg))
            t.add("plate", box((0.2, 0.3, 0.015), (x, 0, h + 0.0075)))
        one, top = section(self.runway, self.runway_size, t.style), h + 0.015
        z = top - span_of(one)[2]
        t.add("beam", bar((-0.3, 0, z), (w + 0.3, 0, z), one))
        if self.eyed:
            t.at(w / 2, 0, top).spun("x", np.pi).add("lifting lug", lug(t.style, 0.08, 0.02), of="steel")
        else:
            trolley(t.at(w / 2, 0, z), self.runway_size, self.runway)
        if self.braced:
            thin, ends = section("SHS", 0.05, t.style), ((w, w - knee), (0.0, knee))
            t.add_each("brace", [bar((a, 0, tie), (b, 0, top), thin) for a, b in ends])
        return t.model()


class _Leg(Params):
    """One of a support's posts."""

    base: Base = nested(Base, "base plate")
    called: str = among(("column", "post"), "what it is called")


class Small(Structure, name="frame/small support", label="beam", weight=1.2, grain="fitting"):
    """Small supports: T-posts, goalposts, wall brackets with braces, trapeze of strut channel on threaded rods."""

    form: str = among(("T-post", "goalpost", "bracket", "trapeze"), "what it is")
    height: float = between(0.4, 1.6, "of what it carries", "m")
    width: float = between(0.4, 1.4, "of it, or reach of a bracket", "m")
    size: float = between(0.05, 0.12, "height of the section", "m")
    shape: str = among(("SHS", "U", "L", "strut", "H", "CHS"), "section")
    legs: tuple[_Leg, ...] = several(
        made(_Leg), lambda p: 1 if p.form == "T-post" else 2, "post", when=of_form("T-post", "goalpost")
    )
    braced: bool = chance(0.6, "braces under a T", when=of_form("T-post"))
    knees: tuple[str, ...] = several(
        one_of("L", "flat", "SHS"), 2, "section of a bracket's brace", when=of_form("bracket")
    )
    over: str = among(("H", "I"), "section of the beam over a trapeze", when=of_form("trapeze"))
    called: str = among(("beam", "bracket"), "what a trapeze is called", when=of_form("trapeze"))

    def build(self, t: Table) -> Model:
        one: Section = section(self.shape, self.size, t.style)
        make = {"bracket": self._bracket, "trapeze": self._trapeze}.get(self.form, self._posts)
        make(t, one, span_of(one)[2])
        return t.model()

    def _posts(self, t: Table, one: Section, y0: float) -> None:
        h, w = self.height, self.width
        for x, leg in zip((0.0,) if self.form == "T-post" else (-0.42 * w, 0.42 * w), self.legs, strict=True):
            low = leg.base.build(t.at(x), 0.16, 0.16)
            t.add(leg.called, bar((x, 0, low), (x, 0, h), one, (0, 1, 0)))
        t.add("beam", bar((-w / 2, 0, h - y0), (w / 2, 0, h - y0), one))
        if self.braced:
            thin = section("L", 0.035, t.style)
            t.add_each("brace", [bar((0, 0, h - 0.3 * w), (s * 0.35 * w, 0, h), thin) for s in BOTH])

    def _bracket(self, t: Table, one: Section, y0: float) -> None:
        h, w, drop = self.height, self.width, min(0.6 * self.width, 0.7 * self.height)
        t.add("wall", box((1.2, 0.2, h + 0.8), (0, 0.1, (h + 0.8) / 2)))
        for x, knee in zip((-0.3, 0.3), self.knees, strict=True):
            t.add("plate", box((0.12, 0.01, 0.22), (x, -0.005, h - 0.05)))
            t.add("beam", bar((x, -0.01, h), (x, -w, h), one))
            t.add("brace", bar((x, 0, h - drop), (x, -0.75 * w, h + y0), section(knee, 0.04, t.style)))
            spots = [(x + s * 0.045, h + z) for s in BOTH for z in (-0.13, 0.03)]
            bolts(t, [at(x_, -0.01, z) @ spun("x", np.pi / 2) for x_, z in spots], 0.01, 0.01)

    def _trapeze(self, t: Table, one: Section, y0: float) -> None:
        h, w, top, post = self.height, self.width, self.height + 1.0, section("SHS", 0.08, t.style)
        over = section(self.over, 0.14, t.style)
        _x0, _x1, low, high = span_of(over)
        t.add_each("column", [bar((s * w, 0, 0), (s * w, 0, top - high), post) for s in BOTH])
        t.add("beam", bar((-w, 0, top), (w, 0, top), over))
        end, x = h + 2 * y0 - 0.04, 0.4 * w
        rods = [rod((s * x, 0, end), (s * x, 0, top + low), 0.006, 8) for s in BOTH]
        t.add_each("stud", rods, fine=False)
        t.add(self.called, bar((-w / 2, 0, h + y0), (w / 2, 0, h + y0), one))


def _flat(p: Any) -> bool:
    return p.form not in ("bent", "channel")


class _Plate(Params):
    """A loose plate."""

    form: str = among(("plain", "clipped", "round", "cut off", "bent", "channel"), "how it is made")
    length: float = between(0.1, 0.9, "along x", "m", when=lambda p: p.form != "round")
    width: float = between(0.08, 0.6, "along y, or diameter of a round one", "m")
    thick: float = among((0.004, 0.008, 0.012, 0.02), "thickness", "m")
    rounded: bool = among((False, True), "its corners are round", when=of_form("plain"))
    called: str = among(
        ("plate", "plate", "bracket"), "what it is called", when=lambda p: not _flat(p), otherwise="plate"
    )
    drilled: bool = chance(0.6, "with holes", when=of_form("plain", "clipped", "round"))
    lies: str = among(
        lambda p: ("on a wall", "stacked", "plain", "ribbed")[: 4 if p.form in ("plain", "clipped") else 3],
        "how it lies",
        when=_flat,
    )
    count: int = whole(2, 5, "plates of a stack", when=lambda p: p.lies == "stacked")
    shifts: tuple[float, ...] = several(number(-0.02, 0.02), lambda p: p.count, "how far one is out of line", "m")

    def build(self, t: Table) -> None:
        """Puts it down about z."""
        a, b, thick = self.length or self.width, self.width, self.thick
        c, half = 0.2 * min(a, b), (a / 2, b / 2)
        if not _flat(self):
            line = [(-a / 2, 0.5 * c), (-a / 2, 0.0), (a / 2, 0.0), (a / 2, c)]
            line = [(-a / 2, 0.0), (a / 4, 0.0), (a / 2, 0.4 * a)] if self.form == "bent" else line
            solid = slab_xz(ribbon(np.array(line), thick, 2 * thick, 3), b)
            t.at(0, 0, thick / 2).add(self.called, solid, of="clamp")
            return
        x, y = half
        # Its holes stay within it, however few sides it has.
        sides = max(8 if self.drilled else 3, few_sides(t.style, y, 40))
        shape = {
            "plain": rounded_rectangle(a, b, 0.3 * c if self.rounded else 0.0, 3),
            "clipped": np.array([[-x, -y], [x - c, -y], [x, c - y], [x, y], [c - x, y], [-x, y - c]]),
            "round": circle(y, sides),
            "cut off": np.array([[-x, -y], [x, -y], [x, -0.1 * b], [-0.1 * a, y], [-x, y]]),
        }[self.form]
        spots = [(sx * 0.28 * a, sy * 0.28 * b) for sx, sy in CORNERS]
        holes = tuple(circle(0.06 * min(a, b), 10, spot) for spot in spots) if self.drilled else ()
        solid = slab_xy(shape, 0, thick, holes)
        if self.lies == "on a wall":
            t.add("wall", box((a + 0.3, 0.15, b + 0.3), (0, 0.175, (b + 0.3) / 2)))
            t.at(0, 0.1, y).spun("x", np.pi / 2).add("plate", solid)
        elif self.lies == "stacked":
            t.add_each("plate", [moved(solid, at(shift, 0, k * thick)) for k, shift in enumerate(self.shifts)])
        else:
            t.add("plate", solid)
            if self.lies == "ribbed":
                ribs = [box((0.7 * a, 0.008, 0.06), (0, s * 0.18 * b, thick + 0.03)) for s in BOTH]
                t.add_each("plate", ribs)


class LoosePlates(Structure, name="plate/loose", weight=1.2, grain="fitting"):
    """Loose plates: blank, drilled, clipped, round, ribbed or bent; lying, stacked or on a wall."""

    count: int = whole(3, 6, "plates or stacks")
    plates: tuple[_Plate, ...] = several(made(_Plate), lambda p: p.count, "plate or stack")

    def build(self, t: Table) -> Model:
        for k, plate in enumerate(self.plates):
            plate.build(t.at(0, 0.9 * k))
        return t.model()


BRACES = families_of(Crossed, Chevron, Diagonal, Knee, Rack, Gantry, Small, LoosePlates)
