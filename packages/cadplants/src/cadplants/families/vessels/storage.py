"""Storage tanks without pressure: roofs, open tops, silos and hoppers, plastic, boxes, drums."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, spread, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.vessel import Tank, apart
from cadplants.families.vessels.vessel_fittings import (
    MANWAYS,
    Drum,
    Manway,
    capped,
    fall,
    head,
    head_height,
    mouth,
    sides,
)
from cadplants.families.vessels.vesselbuild import branch
from cadplants.families.vessels.vesselfeet import FEET, Feet, foot_plate, ladder, ringed_rail
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, merge, moved, revolve, sweep, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, lofted, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["STORAGE"]


class _Courses(Params):
    """A shell of one sheet or of courses that get thinner upward, with its bottom plate and maybe a plinth."""

    base: float = given(0.0, "height of the plinth", "m")
    count: int = among((1, 2, 3, 4), "courses")
    together: bool = chance(0.5, "the shell is one mesh")
    round_plinth: bool = chance(0.6, "its plinth is round", when=lambda p: p.base > 0.01)

    def build(self, t: Table, drum: Drum) -> None:
        edges, n, inner = np.linspace(drum.low, drum.high, self.count + 1), drum.n, 0.985 * drum.r
        plates = [
            ring(inner if t.style.hollow else 0.0, drum.r - 0.003 * k, edges[k], edges[k + 1], n)
            for k in range(self.count)
        ]
        plates.append(cylinder(1.02 * drum.r + 0.01, drum.low - 0.008 * (drum.low > 0), drum.low + 0.006, n))
        for solid in [merge(plates)] if self.together else plates:
            t.add("shell", solid)
        if drum.low > 0.01:
            wide, top = 2.3 * drum.r + 0.2, drum.low - 0.008
            slab = cylinder(1.08 * drum.r + 0.05, 0.0, top, n) if self.round_plinth else box((wide, wide, top))
            t.at(0, 0, 0 if self.round_plinth else top / 2).add("foundation", slab)


class _High(Params):
    """A nozzle near the upper rim."""

    size: int = among((50, 80, 100, 150), "nominal size", "mm")
    form: str = among(("plain", "pad"), "how it is built")


class _Low(Params):
    """A nozzle near the bottom."""

    size: int = among((50, 80, 100, 150), "nominal size", "mm")
    height: float = between(0.25, 0.5, "over the bottom", "m")
    form: str = among(("plain", "pad"), "how it is built")


class _Fittings(Params):
    """Nozzles and a manway near the bottom of a shell (API 650 figure 5-7)."""

    manned: bool = given(True, "whether it has a manway")
    count: int = whole(1, 3, "nozzles")
    low: tuple[_Low, ...] = several(made(_Low), lambda p: min(p.count, 2), "nozzles")
    high: _High = nested(_High, "a nozzle near the upper rim", when=lambda p: p.count == 3)
    closure: str = among(("hinged", "davit"), "what holds the manway's cover", when=lambda p: p.manned, otherwise="")
    manway: Manway = nested(lambda _, p: MANWAYS[p.closure], "manway", when=lambda p: p.manned)

    def build(self, t: Table, drum: Drum) -> list[Port]:
        spots = [(one.form, one.size, drum.low + one.height) for one in self.low]
        spots += [(self.high.form, self.high.size, drum.high - 0.3)] if self.count == 3 else []
        ports: list[Port] = []
        for k, (form, dn, z) in enumerate(spots):
            ports += branch(t, form, dn, drum.side(0.9 * k + 2.6, z), drum.r, drum.dip, 0.08)
        if self.manned:
            pose = drum.side(5.1, drum.low + 0.75) @ spun("z", np.pi)
            t.moved(pose).extend(self.manway.parts(t.style, 0.28, drum.r, drum.dip))
        return ports


class _Access(Params):
    """A ladder or stairs up the shell, and a railing round the roof."""

    high: float = given(2.0, "height of the shell's upper rim", "m")
    ladder: bool = chance(0.5, "a ladder rather than stairs", when=lambda p: p.high >= 2.0, otherwise=True)
    caged: bool = chance(0.5, "whether the ladder is caged", when=lambda p: p.high > 1.8 and p.ladder)
    railed: bool = chance(0.6, "a railing round the roof")

    def build(self, t: Table, drum: Drum, rise: float) -> None:
        if drum.high > 1.6:
            if self.ladder:
                gap, high = 0.18, drum.high + 1.0
                up = ladder(drum.r + gap, 0.0, high, t.style, self.caged, gap + drum.dip + fall(drum.r, 0.22))
                t.spun("z", 0.5).add("ladder", up)
            else:
                _stairs(t, drum)
        if self.railed:
            t.add("railing", ringed_rail(drum.r - 0.05, drum.high + rise, drum.n))


def _stairs(t: Table, drum: Drum) -> None:
    """Stairs that wind up the shell on brackets, with a handrail outside (API 650 table 5-18)."""
    wide, reach = 0.7, drum.r - drum.dip - 0.01
    count, turn, out = int(drum.high / 0.2), 0.24 / (drum.r + wide / 2), drum.r + wide - 0.04
    treads, posts, rail = [], [], []
    for k in range(count):
        a, z = k * turn, 0.2 * (k + 1)
        treads.append(moved(box((wide, 0.25, 0.03), (reach + wide / 2, 0, z)), spun("z", a)))
        x, y = out * np.cos(a), out * np.sin(a)
        if k % 3 == 0 or k == count - 1:
            posts.append(rod((x, y, z), (x, y, z + 1.0), 0.017, 6))
        rail.append((x, y, z + 1.0))
    t.add("stair tread", *treads)
    t.add("railing", *posts, rope(rail, 0.02, 6))


class _Girders(Params):
    """Stiffening rings round a shell, one near the rim."""

    section: str = among(("flat", "angle", "tube"), "of the rings")

    def build(self, t: Table, drum: Drum, count: int) -> None:
        wide, r = 0.05 + 0.04 * drum.r, drum.r + 0.05 + 0.04 * drum.r
        for z in np.linspace(drum.high - 0.02, drum.low + 0.4 * (drum.high - drum.low), count):
            if self.section == "flat":
                solid = ring(drum.r - drum.dip, r, z - 0.012, z, drum.n)
            elif self.section == "angle":
                low, out = z - wide, r + 0.01
                corners = outline(drum.r, z - 0.01, r, z - 0.01, r, low, out, low, out, z, drum.r, z)
                solid = weld([revolve(corners, drum.n, closed=True)])
            else:
                solid = moved(torus(drum.r + 0.01, 0.025, drum.n, 8), at(0, 0, z - 0.02))
            t.add("shell", solid)


class _Big(Tank, weight=0.7):
    """A tank straight on its base, as wide as tank farms in small plants have."""

    radius: float = spread(0.9, 2.3, "of the shell", "m")
    base: float = among((0.0, 0.0, 0.15, 0.3), "height of its plinth", "m")
    slender: float = between(0.8, 2.2, "height of the shell / its radius")

    def drum(self, t: Table) -> Drum:
        """Its shell."""
        return Drum(self.radius, self.base, self.base + self.slender * self.radius, sides(t.style, self.radius))


class _Roofed(_Big):
    """A tank with a fixed roof."""

    rise: float = between(0.2, 0.4, "height of the roof / radius of the shell")
    courses: _Courses = nested(_Courses, "shell", fixed=lambda p: {"base": p.base})


def _fittings(manned: bool = True) -> _Fittings:
    """Nozzles and a manway of whoever has a radius."""
    return nested(
        _Fittings, "nozzles and manway near the bottom", fixed=lambda p: {"manned": manned and p.radius > 0.8}
    )


def _access() -> _Access:
    """Ladder or stairs of whoever has a radius and a height."""
    return nested(_Access, "ladder or stairs, and railing", fixed=lambda p: {"high": p.base + p.slender * p.radius})


class ConeRoof(_Roofed, name="tank/cone roof", weight=1.0):
    """A cone-roof tank (API 650): slope 1:6 and up, top angle, vent, roof hatch, shell manway, stairs or ladder."""

    rise: float = between(0.16, 0.45, "height of the roof / radius of the shell")
    fittings: _Fittings = _fittings()
    top: str = among(("vent", "blind", "plain"), "how the nozzle on top is built")
    top_size: int = among((80, 100, 150), "nominal size of the nozzle on top", "mm")
    hatch: str = among(("hatch", "hinged"), "what closes the manway in the roof")
    roof_manway: Manway = nested(lambda _, p: MANWAYS[p.hatch], "manway in the roof")
    access: _Access = _access()

    def build(self, t: Table) -> Model:
        drum, r = self.drum(t), self.radius
        rise, roof = r * self.rise, t.at(0, 0, drum.high)
        self.courses.build(t, drum)
        corners = outline(r + 0.03, 0.0, r + 0.03, 0.01, 0.06 * r, rise, 0.0, rise)
        roof.add("dished head", capped(corners, t.style, drum.n))
        t.add("shell", ring(0.99 * r, r + 0.06, drum.high - 0.06, drum.high, drum.n))
        ports = self.fittings.build(t, drum)
        ports += branch(t, self.top, self.top_size, at(0, 0, drum.high + rise), 0.0, 0.03)
        x = 0.62 * r
        tilted = roof.at(0, x, rise * (1 - x / r)).spun("x", -float(np.arctan2(rise, r)))
        tilted.extend(self.roof_manway.parts(t.style, 0.26, 0.0, 0.05))
        self.access.build(t, drum, 0.0)
        return t.model(kind="cone roof tank", ports=ports)


class DomeRoof(_Roofed, name="tank/dome roof", weight=0.7):
    """A dome-roof tank (API 650 annex G): a cap of one sphere with ribs, a finial with a vent."""

    ribbed: bool = chance(0.7, "ribs on the roof")
    ribs: int = among((8, 12), "ribs", when=lambda p: p.ribbed, otherwise=0)
    fittings: _Fittings = _fittings()
    top: str = among(("vent", "blind"), "how the nozzle on top is built")
    access: _Access = _access()

    def build(self, t: Table) -> Model:
        drum, r = self.drum(t), self.radius
        rise, roof = r * self.rise, t.at(0, 0, drum.high)
        ball = (r**2 + rise**2) / (2 * rise)
        angles = np.linspace(np.arcsin(min(1.0, r / ball)), 0, 6)[:-1]
        crown = [(float(ball * np.sin(a)), float(rise - ball * (1 - np.cos(a)))) for a in angles] + [(0.0, rise)]
        self.courses.build(t, drum)
        corners = [(r, 0.0), *((x, z + 0.02) for x, z in crown)]
        roof.add("dished head", capped(corners, t.style, drum.n))
        if self.ribbed:
            path = np.array([(x + 0.01, 0.0, z + 0.02) for x, z in crown])
            rib = sweep(path, rounded_rectangle(0.05, 0.06, 0.0), up=(0.0, 1.0, 0.0))
            roof.add("dished head", around(rib, self.ribs))
        ports = self.fittings.build(t, drum)
        roof.at(0, 0, rise).extend(mouth(self.top, 100, 0.15, t.style, 0.0, 0.03))
        self.access.build(t, drum, 0.02)
        return t.model(kind="dome roof tank", ports=ports)


class OpenTop(_Big, name="tank/open top"):
    """An open tank: a sheet shell with wind girders, nozzles, an overflow, maybe a bridge across."""

    slender: float = between(0.6, 1.6, "height of the shell / its radius")
    rings: int = whole(1, 3, "stiffening rings")
    girders: _Girders = nested(_Girders, "stiffening rings")
    fittings: _Fittings = _fittings(False)
    bridged: bool = chance(0.5, "a bridge across")

    def build(self, t: Table) -> Model:
        drum, r = self.drum(t), self.radius
        t.add("shell", ring(0.985 * r, r, drum.low, drum.high, drum.n))
        t.add("shell", cylinder(1.02 * r, drum.low, drum.low + 0.012, drum.n))
        if drum.low > 0.01:
            t.add("foundation", cylinder(1.1 * r, 0.0, drum.low, drum.n))
        self.girders.build(t, drum, self.rings)
        ports = self.fittings.build(t, drum)
        if self.bridged:
            for y in (-0.4, 0.4):
                t.add("beam", box((2 * r + 0.1, 0.06, 0.14), (0, y, drum.high + 0.07)))
            t.add("grating", box((2 * r, 0.85, 0.03), (0, 0, drum.high + 0.155)))
        if drum.high > 1.6:
            gap = 0.2
            up = ladder(r + gap, 0.0, drum.high + 0.9, t.style, False, gap + drum.dip + fall(r, 0.22))
            t.spun("z", 0.7).add("ladder", up)
        return t.model(kind="open tank", ports=ports)


class FloatingRoof(_Big, name="tank/floating roof"):
    """A floating-roof tank (API 650 annex C): a deck with a pontoon inside an open shell, legs, a rolling ladder."""

    slender: float = between(0.7, 1.3, "height of the shell / its radius")
    level: float = between(0.5, 0.9, "height of the deck / of the shell")
    rings: int = whole(1, 2, "stiffening rings")
    girders: _Girders = nested(_Girders, "stiffening rings")
    fittings: _Fittings = _fittings()

    def build(self, t: Table) -> Model:
        drum, wide, n = self.drum(t), self.radius, self.drum(t).n
        r, level = 0.985 * wide, drum.low + self.level * (drum.high - drum.low)
        floor = cylinder(1.02 * wide, drum.low - 0.01 * (drum.low > 0), drum.low + 0.006, n)
        t.add("shell", ring(r, wide, drum.low, drum.high, n), floor)
        deck = cylinder(0.8 * wide, level - 0.02, level, n)
        t.add("dished head", deck, ring(0.79 * wide, 0.955 * wide, level - 0.15, level + 0.1, n))
        seal = ring(0.95 * wide, r * np.cos(np.pi / n) + 0.01, level, level + 0.12, n)
        t.add("gasket", seal, of="rubber", own=True)
        leg = cylinder(0.04, level - 0.4, level + 0.35, 8)
        spots = [
            (x * np.cos(a), x * np.sin(a))
            for x, count in ((0.87 * wide, 6), (0.4 * wide, 3))
            for a in np.arange(count) * 2 * np.pi / count
        ]
        apart(t, "tank leg", *(moved(leg, at(x, y)) for x, y in spots))
        if drum.low > 0.02:
            t.add("foundation", cylinder(1.15 * wide, 0.0, drum.low - 0.01, n))
        self.girders.build(t, drum, self.rings)
        start, end = np.array([-wide - 0.02, 0, drum.high]), np.array([0.2 * wide, 0, level + 0.03])
        aside = [np.array([0.0, y, 0.0]) for y in (-0.3, 0.3)]
        stiles = [rope(np.array([start + y, end + y]), 0.03, 6) for y in aside]
        steps = [start + s * (end - start) for s in np.linspace(0.03, 0.97, 12)]
        rungs = [rope(np.array([step + aside[0], step + aside[1]]), 0.015, 6) for step in steps]
        t.add("ladder", *stiles, *rungs)
        ports = self.fittings.build(t, drum)
        if drum.high > 1.8:
            _stairs(t, drum)
        return t.model(kind="floating roof tank", ports=ports)


class Silo(Tank, name="tank/silo"):
    """A silo: a slim shell (plain, hooped or of corrugated sheet), a steep cone, columns with braces, a roof filter."""

    radius: float = between(0.6, 1.4, "of the shell", "m")
    cone: float = between(1.2, 1.9, "height of the cone / radius of the shell")
    clear: float = between(0.6, 1.2, "from the floor to the cone", "m")
    slender: float = between(2.0, 4.0, "height of the shell / its radius")
    shell: str = among(("plain", "hooped", "corrugated"), "how its shell is built")
    rise: float = between(0.15, 0.5, "height of the roof / radius of the shell")
    legs: Feet = nested(FEET["beam"], "columns with braces", fixed=lambda p: {"clear": p.radius * p.cone + p.clear})
    filtered: bool = chance(0.6, "a filter on the roof")

    def build(self, t: Table) -> Model:
        r, cone, n = self.radius, self.radius * self.cone, sides(t.style, self.radius)
        low = cone + self.clear
        drum = Drum(r, low, low + self.slender * r, n)
        high, rise, mouth_r = drum.high, r * self.rise, max(0.1, 0.15 * r)
        if self.shell == "corrugated":
            zs = np.linspace(low, high, 2 * int((high - low) / 0.12) + 1)
            t.add("shell", turned([(r + (0.0 if k % 2 else 0.025), float(z)) for k, z in enumerate(zs)], n))
        else:
            t.add("shell", drum.solid(t.style))
        if self.shell == "hooped":
            for z in np.linspace(low + 0.3, high - 0.3, 4):
                t.add("shell", ring(0.99 * r, 1.02 * r + 0.01, z, z + 0.05, n))
        funnel = capped(outline(r, 0.0, r, 0.02, mouth_r, cone, 0.0, cone), t.style, n)
        t.at(0, 0, low).along("-z").add("dished head", funnel)
        eave = 1.02 * r + 0.02
        roof = capped(outline(eave, 0.0, eave, 0.01, 0.12 * r, rise, 0.0, rise), t.style, n)
        t.at(0, 0, high).add("dished head", roof)
        t.add("shell", ring(0.985 * r, eave, high - 0.03, high, n))
        end = low - cone
        gate = cylinder(mouth_r, end - 0.12, end, n)
        apart(t, "nozzle", ring(mouth_r, 1.5 * mouth_r, end - 0.02, end, n), gate, of="flange")
        t.extend(self.legs.parts(drum, t.style))
        top = high + rise
        if self.filtered:
            case = [cylinder(0.25, high + 0.4 * rise, top + 0.6, 16), cylinder(0.27, top + 0.6, top + 0.65, 16)]
            t.at(0.35 * r).add("filter", *case, of="tank")
        fill = [(r + 0.06, 0, 0.8), (r + 0.06, 0, top), (r - 0.15, 0, top + 0.15), (0.5 * r, 0, high + 0.45 * rise)]
        t.spun("z", 2.0).add("pipe", rope(fill, 0.057, 12))
        t.spun("z", 4.3).add("ladder", ladder(r + 0.2, 0.3, high + 0.9, t.style, True, 0.21 + drum.dip + fall(r, 0.22)))
        return t.model(kind="silo")


class ConeBottom(Tank, name="tank/cone bottom"):
    """A cone-bottom tank of plastic or sheet in a steel frame: ring, legs, braces, a bottom outlet, a screw lid."""

    radius: float = between(0.35, 0.9, "of the shell", "m")
    cone: float = between(0.5, 1.2, "height of the cone / radius of the shell")
    clear: float = between(0.35, 0.7, "from the floor to the cone", "m")
    slender: float = between(0.8, 2.0, "height of the shell / its radius")
    upper: str = among(("shallow", "flat", "torispherical"), "upper head")
    legs: int = among((3, 4, 6), "legs")
    outlet: int = among((40, 50, 80), "nominal size of the outlet", "mm")
    form: str = among(("plain", "fitting"), "how the outlet is built")
    lid: Manway = nested(MANWAYS["lid"], "screw lid")

    def build(self, t: Table) -> Model:
        r, cone, n = self.radius, self.radius * self.cone, sides(t.style, self.radius)
        low, side = cone + self.clear, 0.05
        drum = Drum(r, low, low + self.slender * r, n)
        t.add("shell", drum.solid(t.style))
        funnel = capped(outline(r, 0.0, r, 0.02, 0.12 * r, cone, 0.0, cone), t.style, n)
        t.at(0, 0, low).along("-z").add("dished head", funnel)
        t.at(0, 0, drum.high).add("dished head", head(self.upper, r, t.style, n))
        leg = merge([box((side, side, low), (r + 0.03, 0, low / 2)), foot_plate(r + 0.03, 0, 0.12)])
        apart(t, "tank leg", ring(r - drum.dip, r + 0.07, low - 0.02, low + 0.03, n), around(leg, self.legs))
        apart(t.at(0, 0, 0.3 * low), "tank leg", torus(r + 0.03, 0.02, max(n, 4 * self.legs), 8))
        reach = min(0.9 * (low - cone) - 0.05, 0.2)
        t.at(0, 0, low - cone).along("-z").extend(mouth(self.form, self.outlet, reach, t.style, 0.0, 0.02))
        apex = drum.high + head_height(self.upper, r)
        t.at(0, 0, apex - 0.01).extend(self.lid.parts(t.style, min(0.25, 0.5 * r), 0.0, 0.15 * r))
        return t.model(kind="cone bottom tank")


class _Bulkhead(Params):
    """A nozzle in a moulded shell."""

    size: int = among((25, 40, 50), "nominal size", "mm")
    form: str = among(("fitting", "half", "plain"), "how it is built")


class Moulded(Tank, name="tank/moulded plastic"):
    """A rotationally moulded tank: a ribbed shell, rounded shoulders, a screw lid, bulkhead fittings."""

    radius: float = between(0.35, 1.2, "of the shell", "m")
    slender: float = between(1.2, 2.6, "height of the shell / its radius")
    ribs: int = whole(3, 8, "ribs round the shell")
    deep: float = between(0.01, 0.04, "how far the ribs stand out", "m")
    shoulder: float = between(0.1, 0.4, "height of the shoulder / radius of the shell")
    lid: Manway = nested(MANWAYS["lid"], "screw lid")
    count: int = whole(1, 2, "nozzles, the first below")
    nozzles: tuple[_Bulkhead, ...] = several(made(_Bulkhead), lambda p: p.count, "nozzles, the first below")
    tied: bool = chance(0.4, "eyes to tie it down")
    bunded: bool = chance(0.3, "it stands in a bund")

    def build(self, t: Table) -> Model:
        r, tall, n, wide = self.radius, self.radius * self.slender, sides(t.style, self.radius), self.radius + self.deep
        pitch, shoulder, foot = 0.85 * tall / self.ribs, self.shoulder * r, 0.02 + 0.05 * tall
        wall = outline(0.97 * r, 0.0, r, 0.02)
        for z in foot + pitch * np.arange(self.ribs):
            wall += outline(r, z, wide, z + 0.2 * pitch, wide, z + 0.6 * pitch, r, z + 0.8 * pitch)
        top = wall[-1][1] + 0.3 * pitch
        wall += [(f * r, top + g * shoulder) for f, g in ((1, 0), (0.96, 0.4), (0.8, 0.75), (0.4, 1))]
        t = t.at(0, 0, 0.01) if self.bunded else t
        t.add("shell", turned(wall, n))
        t.at(0, 0, top + shoulder).extend(self.lid.parts(t.style, min(0.25, 0.38 * r), 0.0, 0.02))
        drum = Drum(r, 0.0, top, n)
        for k, (z, one) in enumerate(zip((foot, top), self.nozzles, strict=False)):
            branch(t, one.form, one.size, drum.side(4.6 + k, max(z, 0.14) - 0.04), r, drum.dip + 0.01)
        if self.tied:
            eyes = around(along("x", torus(0.05, 0.012, 12, 6)), 3, 0.72 * r, 0.5)
            apart(t.at(0, 0, top + 0.8 * shoulder), "lifting lug", eyes, of="tank")
        if self.bunded:
            t.add("tank", _bund(1.3 * r, 0.6 * tall, n))
        return t.model(kind="plastic tank")


def _bund(r: float, tall: float, n: int) -> Solid:
    """An open tub that catches what a tank loses; its floor is as thick as a sheet [m]."""
    edge = outline(0, -0.01, r, -0.01, 1.03 * r, tall, 1.03 * r - 0.02, tall, r - 0.02, 0.001, 0, 0.001)
    return weld([revolve(edge, n)])


class BulkContainer(Tank, name="tank/bulk container"):
    """An intermediate bulk container (1000 l, 1.2 x 1.0 x 1.16 m): a moulded bottle in a tube cage on a pallet."""

    height: float = among((0.72, 1.0, 1.1), "of the bottle", "m")
    lid: Manway = nested(MANWAYS["lid"], "screw lid")
    along_bars: int = whole(6, 9, "upright bars on a long side")
    across_bars: int = whole(5, 7, "upright bars on a short side")
    hoops: int = whole(4, 5, "hoops round it")
    blocks: bool = chance(0.6, "the pallet has blocks rather than runners")

    def build(self, t: Table) -> Model:
        w, d, h, base, n = 1.2, 1.0, self.height, 0.16, t.n(0.01, 6, 10)
        top, loops = base + h, []
        for z, share in ((0.0, 0.9), (0.05, 0.98), (0.12, 1.0), (h - 0.1, 1.0), (h - 0.03, 0.96), (h, 0.85)):
            flat = rounded_rectangle(share * (w - 0.06), share * (d - 0.06), 0.12, 3)
            loops.append(np.column_stack([flat, np.full(len(flat), base + z)]))
        t.add("shell", lofted(loops), of="dial")
        t.at(0, 0, top).extend(self.lid.parts(t.style, 0.115, 0.0, 0.02))
        xs, ys = np.linspace(-w / 2, w / 2, self.along_bars), np.linspace(-d / 2, d / 2, self.across_bars)[1:-1]
        spots = [(x, s * d / 2) for x in xs for s in BOTH] + [(s * w / 2, y) for y in ys for s in BOTH]
        bars = [rod((x, y, base), (x, y, top + 0.02), 0.009, n) for x, y in spots]
        hoop = rounded_rectangle(w, d, 0.05, 2)
        for z in np.linspace(base + 0.08, top + 0.02, self.hoops):
            bars.append(sweep(np.column_stack([hoop, np.full(len(hoop), z)]), circle(0.01, n), closed=True))
        for x in (-0.25 * w, 0.25 * w):
            bars.append(rod((x, -d / 2, top + 0.025), (x, d / 2, top + 0.025), 0.01, n))
        t.add("tank", *bars, of="clamp")
        self._pallet(t, w, d, base)
        cock = [cylinder(0.03, 0.42, 0.58, 12), cylinder(0.045, 0.58, 0.61, 12)]
        tap = [*(along("-y", one) for one in cock), box((0.02, 0.06, 0.1), (0, -0.53, 0.06))]
        t.at(0, 0, base + 0.09).add("valve", *tap, of="rubber")
        return t.model(kind="intermediate bulk container")

    def _pallet(self, t: Table, w: float, d: float, base: float) -> None:
        """A pallet: boards on blocks or runners of steel tube."""
        xs, ys, edge = (-w / 2 + 0.06, 0, w / 2 - 0.06), (-d / 2 + 0.065, 0, d / 2 - 0.065), d / 2 - 0.065
        solids = [box((w, 0.13, 0.022), (0, y, base - 0.011)) for y in np.linspace(-edge, edge, 5)]
        if self.blocks:
            solids += [box((0.12, 0.1, base - 0.044), (x, y, base / 2)) for x in xs for y in ys]
            solids += [box((0.12, d, 0.022), (x, 0, 0.011)) for x in xs]
        else:
            solids += [box((0.06, d, base - 0.022), (x, 0, (base - 0.022) / 2)) for x in xs]
        t.add("skid frame", *solids, of="safety")


STORAGE = families_of(ConeRoof, DomeRoof, OpenTop, FloatingRoof, Silo, ConeBottom, Moulded, BulkContainer)
