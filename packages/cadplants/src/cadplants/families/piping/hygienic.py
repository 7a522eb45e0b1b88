"""Hygienic joints with band clamps of further makes: hinged on one pin or two, bolted, or drawn with few sides."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.coupling import half_band
from cadplants.families.piping.shape import BACK, Fitting, barrel, lathe, sized
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import Solid, about_x, moved
from cadplants.solids.primitives import BOTH, ball, box, cylinder, hexagon
from cadplants.solids.transforms import at, spun

__all__ = ["HYGIENIC", "Band"]

_SIZES = sizes_between(most=150)


class Band(Params):
    """A clamp round two ferrules: a ring or two halves, a hinge, and a bolt with a nut that draws two lugs together."""

    form: str = among(("one pin", "one pin", "two pins", "bolted", "ring"), "how it opens")
    thick: float = between(0.08, 0.3, "(thickness - 2 mm) / radius of the pipe")
    broad: float = between(1.2, 2.6, "width / that of the two rims, at least 8 mm")
    sloped: bool = chance(0.5, "its sides slope", when=lambda p: p.form == "ring")
    lug: float = between(0.2, 0.55, "(height of its lugs - 4 mm) / radius of the pipe")
    nut: str = among(("wing", "wing", "wing", "hexagon", "box", "knob"), "what draws it together")
    wing: float = between(0.3, 1.0, "(span of the wings - 16 mm) / radius of the pipe", when=lambda p: p.nut == "wing")
    sides: int = among((0, 0, 0, 8, 12, 16), "sides of its ring; 0: as the style has them")
    roll: float = between(0, 6, "where its nut is, about the pipe", "rad")
    loose: bool = chance(0.3, "its halves and its nut are pieces of their own", when=lambda p: p.form != "ring")

    def build(self, t: Table, middle: float, rim: float, wide: float, r: float = 0.0, sides: int = 0) -> None:
        """Puts it down.

        Args:
            t: with the pipe along x.
            middle: where the ferrules meet [m].
            rim: their radius [m].
            wide: how wide the two rims are [m].
            r: radius of the pipe [m]; the table's if 0.
            sides: of its ring, where it has no number of its own; 0: as the style has them.
        """
        t, r = t.at(middle).spun("x", self.roll), r or t.pipe.radius
        width, outer = max(self.broad * wide, 0.008), rim + self.thick * r + 0.002
        upper, lower = self._halves((rim, outer, r), width, self.sides or sides or t.n(outer))
        nut = self._nut(outer, width, r)
        pieces = [upper, lower, nut] if self.loose else [[*upper, *lower, *nut]]
        for solids in pieces:
            t.add("clamp", *solids, of="trim", own=False, fine=False)

    def _halves(self, radii: tuple[float, float, float], width: float, n: int) -> tuple[list[Solid], list[Solid]]:
        """Its ring or its halves between two radii, on a pipe of a third: lugs on the side of +y, a hinge opposite."""
        (rim, outer, r), half = radii, 0.5 * width
        high, gap, thick = self.lug * r + 0.004, 0.12 * r + 0.003, 0.14 * r + 0.003
        lugs = [
            box((0.9 * width, high + 0.3 * (outer - rim), thick), (0, outer + 0.4 * high, s * (gap + thick) / 2))
            for s in BOTH
        ]
        pin = cylinder(0.1 * r + 0.0025, -0.55 * width, 0.55 * width, 8)
        if self.form == "ring":
            edge = 0.25 * width if self.sloped else 0.0
            shape = outline(
                0.4 * rim + 0.6 * outer, -half, outer, edge - half, outer, half - edge, 0.4 * rim + 0.6 * outer, half
            )
            return [lathe(shape, n, 0.998 * rim), *lugs], []
        if self.form == "bolted":
            back = [moved(one, spun("x", np.pi)) for one in lugs]
            bolt = [moved(one, spun("x", np.pi)) for one in self._bolt(outer, r)]
            upper, lower = [lugs[1], back[0], *bolt], [lugs[0], back[1]]
        elif self.form == "two pins":
            link = box((0.5 * width, 0.16 * r + 0.004, 0.5 * r + 0.008), (0, -outer - 0.06 * r - 0.001, 0))
            pins = [moved(about_x(pin), at(0, -outer - 0.04 * r, s * (0.2 * r + 0.003))) for s in BOTH]
            upper, lower = [lugs[1], pins[1]], [lugs[0], pins[0], link]
        else:
            upper, lower = [lugs[1]], [lugs[0], moved(about_x(pin), at(0, -outer - 0.06 * r - 0.001))]
        one = half_band(0.998 * rim, outer, -half, half, n)
        return [one, *upper], [moved(one, spun("x", np.pi)), *lower]

    def _bolt(self, outer: float, r: float) -> list[Solid]:
        """A bolt through the lugs, its head below them."""
        y, far = outer + 0.55 * (self.lug * r + 0.004), 0.2 * r + 0.0045
        rod, head = 0.06 * r + 0.002, 0.12 * r + 0.0035
        pieces = [cylinder(rod, -1.3 * far, 2.0 * far, 8), hexagon(2 * head, -1.3 * far - head, -1.2 * far)]
        return [moved(one, at(0, y)) for one in pieces]

    def _nut(self, outer: float, width: float, r: float) -> list[Solid]:
        """The bolt with the nut that draws it together."""
        y, far, size = outer + 0.55 * (self.lug * r + 0.004), 0.2 * r + 0.0045, 0.14 * r + 0.005
        low, span = 0.95 * far, self.wing * r + 0.016
        if self.nut == "wing":
            wings = [box((0.5 * span, 0.25 * size, 1.1 * size), (0, 0, 0)) for _ in BOTH]
            tilted = [
                moved(one, at(s * 0.3 * span, 0, low + 1.2 * size) @ spun("y", -s * 0.5))
                for s, one in zip(BOTH, wings, strict=True)
            ]
            pieces = [cylinder(0.8 * size, low, low + 1.2 * size, 10), *tilted]
        elif self.nut == "knob":
            pieces = [cylinder(0.6 * size, low, low + size, 8), moved(ball(0.9 * size, 10), at(0, 0, low + 1.5 * size))]
        elif self.nut == "box":
            pieces = [box((min(width, 3 * size), 1.6 * size, 1.4 * size), (0, 0, low + 0.6 * size))]
        else:
            pieces = [hexagon(1.9 * size, low, low + 0.9 * size)]
        return [*self._bolt(outer, r), *(moved(one, at(0, y)) for one in pieces)]


class Ferrule(Params):
    """A ferrule: a piece of tube with a thin rim whose back slopes (ISO 2852, ASME BPE)."""

    rim: float = between(0.2, 0.6, "(radius of its rim - that of the pipe - 3 mm) / radius of the pipe")
    lip: float = between(0.0012, 0.0035, "thickness of its rim at the edge", "m")
    slope: float = between(0.2, 0.7, "how far its back slopes / height of the rim")
    long: float = between(0.3, 3.0, "(length - 10 mm) / radius of the pipe")

    def radius(self, r: float) -> float:
        """Of its rim on a pipe of a radius [m]."""
        return (1 + self.rim) * r + 0.003

    def solid(self, t: Table) -> tuple[Solid, float]:
        """It along x, its rim's face at its length, and that [m]."""
        r, n, bore = sized(t.dn, t.style, 1.4)
        rim, deep = self.radius(r), self.lip + self.slope * (self.radius(r) - r)
        length = max(self.long * r + 0.01, 1.5 * deep)
        return lathe(outline(r, 0.0, r, length - deep, rim, length - self.lip, rim, length), n, bore), length


class _Hygienic(Fitting, sizes=_SIZES):
    """What a band clamps."""

    ferrule: Ferrule = nested(Ferrule, "its ferrules")
    band: Band = nested(Band, "its clamp")
    seal: float = among((0.0, 0.0015, 0.003), "thickness of its seal; 0: none", "m")

    def sealed(self, t: Table, face: float) -> float:
        """The seal and the band on a face; where what meets it begins [m]."""
        r, n, bore = sized(t.dn, t.style, 1.4)
        seal, rim = self.seal if t.style.gaskets else 0.0, self.ferrule.radius(r)
        if seal:
            t.add("gasket", barrel(0.98 * rim, face, face + seal, n, bore))
        self.band.build(t, face + 0.5 * seal, rim, seal + 2 * self.ferrule.lip)
        return face + seal


class ClampedFerrules(_Hygienic, name="coupling/clamped ferrules", weight=1.5):
    """One or two hygienic joints: two ferrules each, at times a seal, and a clamp that is a mesh of its own."""

    count: int = whole(1, 2, "joints")

    def build(self, t: Table) -> Model:
        one, long = self.ferrule.solid(t)
        x = 0.0
        for _ in range(self.count):
            t.at(x).add("coupling", one, of="trim")
            x = self.sealed(t, x + long) + long
            t.at(x).moved(BACK).add("coupling", one, of="trim")
        return t.model(round(x, 9), "welded", split=True)


class ClampedBlank(_Hygienic, name="pipe cap/clamped blank", place="end", weight=1.2):
    """A hygienic blank on a ferrule: flat or dished, at times with a knob or a small spigot, and its clamp."""

    thick: float = between(0.003, 0.01, "of the blank", "m")
    form: str = among(("flat", "flat", "raised", "dished", "spigot"), "of the blank")

    def build(self, t: Table) -> Model:
        (r, n, _), (one, long) = sized(t.dn, t.style, 1.4), self.ferrule.solid(t)
        t.add("coupling", one, of="trim")
        low = self.sealed(t, long)
        rim, top = self.ferrule.radius(r), low + self.thick
        shape = outline(rim, low, rim, low + self.ferrule.lip, 1.02 * r, top)
        if self.form == "raised":
            shape += outline(0.8 * r, top, 0.75 * r, top + 0.2 * r)
        elif self.form == "dished":
            angles = np.linspace(0.15, 0.5 * np.pi, 5)
            shape += [(r * float(np.cos(a)) + 1e-4, top + 0.35 * r * float(np.sin(a))) for a in angles[:-1]]
        elif self.form == "spigot":
            shape += outline(0.25 * r, top, 0.25 * r, top + 0.8 * r)
        t.add("pipe cap", lathe(shape, n), of="trim")
        return t.model()


HYGIENIC = families_of(ClampedFerrules, ClampedBlank)
