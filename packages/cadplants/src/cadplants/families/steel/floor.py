"""Gratings and platforms: floor panels of every kind, trench covers, round and mobile platforms, mezzanines."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import number, yes
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.caster import Casters
from cadplants.families.steel.shape import (
    Base,
    Structure,
    bar,
    bases,
    few_sides,
    grid,
    pipe,
    rect,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    slab_yz,
    span_of,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, CORNERS, box, cylinder, ring
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FLOORS", "panel"]

PANELS = ("bar", "bar", "pressed", "expanded", "perforated", "sheet", "planks")


def _bars(
    w: float, d: float, thick: float, pitch: tuple[float, float], bars: tuple[float, float], most: int = 18
) -> Solid:
    """A lattice of bars about the origin, its underside at z = 0."""
    x, y = (int(np.clip(round(span / step), 2, most)) for span, step in zip((w, d), pitch, strict=True))
    return grid(w, d, thick, (x, y), bars)


def panel(kind: str, w: float, d: float, thick: float, style: ModelingStyle, most: int = 18) -> Solid:
    """A floor panel ``w`` by ``d`` about the origin on z = 0, with at most so many bars each way.

    Bars after DIN 24537 (33 mm pitch), planks after DIN 24539; ``fold`` is a tread of folded sheet.
    """
    coarse = 2.0 if style.sides[1] <= 12 else 1.0
    if kind == "bar":
        return _bars(w, d, thick, (0.04 * coarse, 0.1 * coarse), (0.004, 0.006), most)
    if kind == "pressed":
        return _bars(w, d, thick, (0.06 * coarse, 0.06 * coarse), (0.004, 0.004), most)
    if kind == "perforated":
        holes = _bars(w, d, 0.2 * thick, (0.06 * coarse, 0.06 * coarse), (0.03, 0.03), most)
        rims = [box((w, 0.004, thick), (0, s * (d / 2 - 0.002), thick / 2)) for s in (-1, 1)]
        return merge([moved(holes, at(0, 0, 0.8 * thick)), *rims])
    if kind == "expanded":
        return _expanded(w, d, thick, coarse)
    if kind == "planks":
        count = max(1, round(d / 0.2))
        wide = d / count
        y = wide / 2 - 0.003
        line = ribbon([(y, 0.0015), (y, thick - 0.0015), (-y, thick - 0.0015), (-y, 0.0015)], 0.003)
        return merge([moved(slab_yz(line, w), at(0, (k + 0.5) * wide - d / 2)) for k in range(count)])
    if kind == "fold":
        x = w / 2
        line = ribbon([(x, 0.0), (x, thick - 0.002), (-x, thick - 0.002), (-x, 0.0)], 0.004)
        return slab_xz(line, d)
    studs = [
        moved(box((0.03, 0.006, 0.003), (0, 0, thick)), at(x, y) @ spun("z", 0.7854 * (-1) ** (i + j)))
        for i, x in enumerate(np.linspace(-0.42 * w, 0.42 * w, int(np.clip(w / 0.08, 2, 9))))
        for j, y in enumerate(np.linspace(-0.42 * d, 0.42 * d, int(np.clip(d / 0.08, 2, 9))))
    ]
    plate = box((w, d, 0.2 * thick), (0, 0, 0.9 * thick))
    rims = [box((w, 0.004, 0.8 * thick), (0, s * (d / 2 - 0.002), 0.4 * thick)) for s in (-1, 1)]
    return merge([plate, *rims, *studs]) if coarse < 2 else merge([plate, *rims])


def _expanded(w: float, d: float, thick: float, coarse: float) -> Solid:
    """Expanded metal in a frame of flats: two sets of crossed strands."""
    strands = []
    slope, pitch = 0.5, 0.07 * coarse
    for way in (-1, 1):
        for c in np.arange(-w / 2 - slope * d / 2, w / 2 + slope * d / 2, max(pitch, (w + d) / 30)):
            ys = np.array([-d / 2, d / 2])
            lo, hi = sorted(((-w / 2 - c) / (way * slope), (w / 2 - c) / (way * slope)))
            ys = np.clip(ys, lo, hi)
            if ys[1] - ys[0] < 0.03:
                continue
            a, b = (c + way * slope * ys[0], ys[0], 0.6 * thick), (c + way * slope * ys[1], ys[1], 0.6 * thick)
            strands.append(_strand(np.array(a), np.array(b), 0.3 * thick, 0.004))
    rims = [box((w, 0.005, thick), (0, s * (d / 2 - 0.0025), thick / 2)) for s in (-1, 1)]
    rims += [box((0.005, d - 0.01, thick), (s * (w / 2 - 0.0025), 0, thick / 2)) for s in (-1, 1)]
    return merge([*strands, *rims])


def _strand(a: Floats, b: Floats, tall: float, thick: float) -> Solid:
    turn = float(np.arctan2(b[1] - a[1], b[0] - a[0]))
    middle = (a + b) / 2
    return moved(box((float(np.linalg.norm(b - a)), thick, tall)), at(*middle) @ spun("z", turn))


def _called(kind: str) -> str:
    return "plate" if kind == "sheet" else "grating"


class Panels(Structure, name="grating/panels", weight=1.5, grain="fitting"):
    """Floor panels side by side on bearers, with clips; or a stack of them on battens."""

    form: str = among(PANELS, "of the panels")
    width: float = between(0.4, 1.2, "of a panel", "m")
    depth: float = between(0.4, 1.2, "of a panel", "m")
    thick: float = among((0.025, 0.03, 0.04), "thickness of a panel", "m")
    stacked: bool = chance(0.3, "a stack on battens")
    count: int = among(lambda p: (2, 3, 4) if p.stacked else (1, 2, 3), "panels")
    turns: tuple[float, ...] = several(
        number(-0.03, 0.03),
        lambda p: p.count,
        "how far a panel of the stack is turned",
        "rad",
        when=lambda p: p.stacked,
    )
    size: float = between(0.06, 0.12, "height of a bearer's section", "m", when=lambda p: not p.stacked)
    bearer: str = among(("L", "U", "SHS", "I", "T"), "section of the bearers", when=lambda p: not p.stacked)
    clipped: bool = chance(0.5, "with clips", when=lambda p: not p.stacked and p.form in ("bar", "pressed"))

    def build(self, t: Table) -> Model:
        w, d, thick, called = self.width, self.depth, self.thick, _called(self.form)
        solid = panel(self.form, w, d, thick, t.style, 12)
        if self.stacked:
            t.add_each("beam", [box((0.08, d, 0.08), (s * 0.3 * w, 0, 0.04)) for s in BOTH], of="safety")
            step = thick + (0.003 if self.form == "sheet" else 0.0)
            for k, a in enumerate(self.turns):
                t.at(0, 0, 0.08 + k * step).spun("z", a).add(called, solid, of="clamp")
            return t.model()
        one, pitch, ys = section(self.bearer, self.size, t.style), w + 0.005, (-0.4 * d, 0.4 * d)
        _x0, _x1, low, high = span_of(one)
        for k in range(self.count):
            t.at((k + 0.5) * pitch, 0, high - low).add(called, solid, of="clamp")
        t.add_each("beam", [bar((0, y, -low), (self.count * pitch, y, -low), one) for y in ys])
        if self.clipped:
            clip = box((0.05, 0.02, 0.003), (0, 0, high - low + thick + 0.0015))
            xs = [(k + f) * pitch for k in range(self.count) for f in (0.15, 0.85)]
            t.add_each("clamp", [moved(clip, at(x, y)) for x in xs for y in ys], of="trim")
        return t.model()


def _rect(a: float, b: float) -> Floats:
    """A rectangle about the origin, from its lower left corner."""
    return np.roll(rect(a, b), 1, axis=0)


class Trench(Structure, name="grating/trench", grain="fitting"):
    """A floor with a trench or sump under gratings in an angle frame, or a round cover; slab, walls of the trench."""

    round: bool = chance(0.3, "a round cover in place of a trench")
    form: str = among(("bar", "pressed", "perforated", "sheet"), "of the gratings", when=lambda p: not p.round)
    length: float = between(0.8, 2.4, "of the trench", "m")
    width: float = between(0.2, 0.6, "of the trench", "m")
    slab: float = between(0.1, 0.2, "thickness of the floor's slab", "m")
    deep: float = between(0.2, 0.5, "depth of the trench", "m", when=lambda p: not p.round)
    count: int = whole(1, 3, "gratings", when=lambda p: not p.round)

    def build(self, t: Table) -> Model:
        a, b, slab, deep, thick = self.length, self.width, self.slab, self.deep, 0.03
        if self.round:
            return self._cover(t, thick)
        t.add("ground", slab_xy(_rect(a + 0.8, b + 0.8), -slab, 0, (_rect(a, b),)), of="concrete")
        walls = [box((a, 0.08, deep), (0, s * (b / 2 + 0.04), -slab - deep / 2)) for s in BOTH]
        walls += [box((0.08, b + 0.16, deep), (s * (a / 2 + 0.04), 0, -slab - deep / 2)) for s in BOTH]
        t.add("foundation", *walls, box((a + 0.16, b + 0.16, 0.08), (0, 0, -slab - deep - 0.04)))
        for s in BOTH:
            upright = box((a, 0.004, thick), (0, s * (b / 2 - 0.002), -thick / 2))
            t.add("beam", upright, box((a, 0.03, 0.004), (0, s * (b / 2 - 0.015), -thick - 0.002)))
        wide = a / self.count
        cover = panel(self.form, wide - 0.006, b - 0.012, thick, t.style)
        for k in range(self.count):
            t.at(-a / 2 + (k + 0.5) * wide, 0, -thick).add(_called(self.form), cover, of="clamp")
        return t.model()

    def _cover(self, t: Table, thick: float) -> Model:
        """A round cover in a ring."""
        r = 0.5 * self.width + 0.15
        n, big = few_sides(t.style, r, 32), _rect(self.length + 1.0, self.width + 1.0)
        t.add("ground", slab_xy(big, -self.slab, 0, (circle(r, n),)), of="concrete")
        t.add("beam", ring(r - 0.05, r, -self.slab, -thick, n))
        bars = [
            box((0.006, 2 * np.sqrt(max((r - 0.01) ** 2 - x * x, 0.0001)), thick), (x, 0, -thick / 2))
            for x in np.linspace(-0.85 * r, 0.85 * r, 12)
        ]
        t.add("grating", *bars, ring(r - 0.012, r - 0.004, -thick, 0, n), of="clamp")
        return t.model()


def _bow(t: Table, xs: tuple[float, float]) -> None:
    """A railing along x over a floor on z = 0: two posts, a handrail and a knee rail."""
    own, style = t.bundled("platform"), t.style
    own.add_each("post", [pipe([(x, 0, 0), (x, 0, 1.05)], 0.019, style) for x in xs], of="safety")
    rails = ((1.05, 0.021), (0.55, 0.015))
    own.add_each("railing", [pipe([(xs[0], 0, h), (xs[1], 0, h)], r, style) for h, r in rails])


class Round(Structure, name="platform/ring", weight=1.2):
    """A platform round a silo, tank or chimney: sectors of plate or one ring on brackets, railing outside."""

    radius: float = between(0.4, 1.2, "of what it goes round", "m")
    width: float = between(0.6, 0.9, "of the floor", "m")
    height: float = between(1.0, 2.5, "of the floor", "m")
    full: bool = among((True, False), "all the way round")
    turn: float = between(1.5, 4.0, "how far it goes round", "rad", when=lambda p: not p.full, otherwise=2 * np.pi)
    above: float = between(0.2, 1.5, "height of what it goes round, over the floor", "m")
    core: str = among(("wall", "column"), "what that is called")
    joined: bool = chance(0.4, "the floor is one ring", when=lambda p: p.full)
    called: str = among(("platform", "plate", "grating"), "what a sector is called", when=lambda p: not p.joined)

    def build(self, t: Table) -> Model:
        r, w, h, own = self.radius, self.width, self.height, t.bundled("platform")
        n, count = few_sides(t.style, r, 40), max(2, int(self.turn / 0.8))
        step, edge = self.turn / count, r + w - 0.03
        t.add(self.core, cylinder(r, 0, h + self.above, n), of="concrete")
        if self.called:
            a = np.linspace(0.003, step - 0.003, 5)
            unit = np.column_stack([np.cos(a), np.sin(a)])
            sector = extrude(np.vstack([(r + 0.01) * unit[::-1], (r + w) * unit]), h - 0.03, h)
            own.add_each(self.called, [moved(sector, spun("z", k * step)) for k in range(count)], of="clamp")
        else:
            own.add("platform", ring(r + 0.005, r + w, h - 0.03, h, n))
        shape = [(r - 0.02, h - 0.03), (r - 0.02, h - 0.35), (r + 0.05, h - 0.35), (r + w, h - 0.1), (r + w, h - 0.03)]
        for k in range(count + (0 if self.full else 1)):
            t.spun("z", k * step).add("bracket", slab_xz(shape, 0.012))
            x, y = edge * np.cos(k * step), edge * np.sin(k * step)
            own.add("post", pipe([(x, y, h - 0.03), (x, y, h + 1.05)], 0.019, t.style), of="safety")
        a = np.linspace(0, self.turn, 6 * count + 1)[: -2 if self.full else None]
        for z, thick in ((1.05, 0.021), (0.55, 0.015)):
            path = np.column_stack([edge * np.cos(a), edge * np.sin(a), np.full(len(a), h + z)])
            own.add("railing", pipe(path, thick, t.style))
        return t.model()


def _under(p: Any) -> float:
    """Height of a solid platform's underside [m]."""
    return float(p.height - 0.008 - (p.deep - 0.008 if p.form == "slab" else p.deep))


def _legged(p: Any) -> bool:
    return bool(p.foot == "legs")


class SolidPlatform(Structure, name="platform/solid", weight=1.3):
    """A platform of one piece: folded plate, ribbed plate or slab; on legs, brackets or blocks."""

    width: float = between(0.8, 2.8, "along x", "m")
    depth: float = between(0.6, 1.6, "along y", "m")
    height: float = between(0.15, 2.2, "of the floor", "m")
    form: str = among(("folded", "ribbed", "slab"), "how it is made")
    deep: float = between(0.06, 0.15, "height of its edge", "m")
    material: str = among(("clamp", "steel", "concrete"), "kind of material")
    foot: str = among(
        ("blocks", "legs", "brackets"), "what it stands on", when=lambda p: _under(p) >= 0.15, otherwise="blocks"
    )
    leg: str = among(("SHS", "CHS", "L", "U"), "section of the legs", when=_legged)
    bases: tuple[Base, ...] = bases(4, when=_legged)
    railed: bool = chance(0.7, "a railing", when=lambda p: p.height > 0.5)

    def build(self, t: Table) -> Model:
        w, d, h, deep, low = self.width, self.depth, self.height, self.deep, _under(self)
        z = h - 0.008 - deep / 2
        solids = [box((w, d, 0.008), (0, 0, h - 0.004))]
        solids += [box((w, 0.006, deep), (0, s * (d / 2 - 0.003), z)) for s in BOTH]
        solids += [box((0.006, d - 0.012, deep), (s * (w / 2 - 0.003), 0, z)) for s in BOTH]
        if self.form == "ribbed":
            size = (0.008, d - 0.012, 0.7 * deep)
            solids += [box(size, (x, 0, h - 0.008 - 0.35 * deep)) for x in np.linspace(-0.3 * w, 0.3 * w, 4)]
        solids = [box((w, d, deep), (0, 0, h - deep / 2))] if self.form == "slab" else solids
        t.bundled("platform").add("platform", *solids, of=self.material)
        if self.foot == "blocks":
            t.add_each("foundation", [box((0.2, d, low), (s * 0.35 * w, 0, low / 2)) for s in BOTH])
        elif self.foot == "legs":
            one = section(self.leg, 0.07, t.style)
            for (sx, sy), base in zip(CORNERS, self.bases, strict=True):
                here = t.at(sx * (w / 2 - 0.08), sy * (d / 2 - 0.08))
                here.add("column", bar((0, 0, base.build(here, 0.15, 0.15)), (0, 0, low), one))
        else:
            t.add("wall", box((w + 0.4, 0.2, h + 0.8), (0, d / 2 + 0.1, (h + 0.8) / 2)))
            shape = [(d / 2, low), (-d / 2 + 0.1, low), (-d / 2 + 0.1, low - 0.04), (d / 2, low - min(0.5, 0.8 * low))]
            t.add_each("bracket", [moved(slab_yz(shape, 0.012), at(s * 0.35 * w)) for s in BOTH])
        if self.railed:
            _bow(t.at(0, -d / 2 + 0.05, h), (-w / 2 + 0.05, w / 2 - 0.05))
        return t.model()


class Mezzanine(Structure, name="platform/mezzanine", grain="fitting"):
    """A mezzanine bay: columns, girders, joists on or between them, panels or one floor, kick plate and railing."""

    width: float = between(2.0, 4.5, "along the girders", "m")
    depth: float = between(1.5, 3.0, "from girder to girder", "m")
    height: float = between(2.0, 3.2, "of a column", "m")
    column_size: float = between(0.1, 0.2, "height of a column's section", "m")
    column: str = among(("H", "SHS", "CHS"), "section of the columns")
    girder_size: float = between(0.16, 0.28, "height of a girder's section", "m")
    girder: str = among(("I", "H", "U", "RHS"), "section of the girders")
    joist_size: float = between(0.1, 0.16, "height of a joist's section", "m")
    joist: str = among(("C", "Z", "I", "U"), "section of the joists")
    columns: int = whole(2, 3, "under a girder")
    bases: tuple[Base, ...] = bases(lambda p: 2 * p.columns)
    joists: int = whole(4, 7, "on the girders")
    plain: bool = chance(0.5, "its floor is one slab")
    form: str = among(("bar", "sheet", "planks", "pressed"), "of the panels", when=lambda p: not p.plain)
    count: int = whole(2, 3, "panels", when=lambda p: not p.plain)
    braced: bool = chance(0.5, "with knee braces")
    knee: str = among(("L", "SHS"), "section of the knee braces", when=lambda p: p.braced)

    def build(self, t: Table) -> Model:
        w, d, h, ys = self.width, self.depth, self.height, (0.0, self.depth)
        column, girder, joist = (
            section(kind, size, t.style)
            for kind, size in (
                (self.column, self.column_size),
                (self.girder, self.girder_size),
                (self.joist, self.joist_size),
            )
        )
        spots = [(float(x), y) for x in np.linspace(0, w, self.columns) for y in ys]
        for (x, y), base in zip(spots, self.bases, strict=True):
            low = base.build(t.at(x, y), 0.3, 0.3)
            t.add("column", bar((x, y, low), (x, y, h), column))
        (_, _, g0, g1), (_, _, j0, j1) = span_of(girder), span_of(joist)
        t.add_each("beam", [bar((-0.15, y, h - g0), (w + 0.15, y, h - g0), girder) for y in ys])
        z, floor = h + g1 - g0 - j0, h + g1 - g0 + j1 - j0
        joists = [bar((x, -0.1, z), (x, d + 0.1, z), joist) for x in np.linspace(0, w, self.joists)]
        t.add_each("beam", joists, of="clamp")
        if self.plain:
            t.add("platform", box((w + 0.3, d + 0.2, 0.03), (w / 2, d / 2, floor + 0.015)), of="ground")
        else:
            wide = (w + 0.3) / self.count
            tile = panel(self.form, wide - 0.004, d + 0.2, 0.03, t.style, 11)
            for k in range(self.count):
                t.at(-0.15 + (k + 0.5) * wide, d / 2, floor).add(_called(self.form), tile, of="clamp")
        _bow(t.at(0, -0.05, floor + 0.03), (0.0, w))
        if self.braced:
            knee = section(self.knee, 0.06, t.style)
            t.add_each("brace", [bar((0, y, h - 0.6), (0.6, y, h), knee) for y in ys])
        return t.model()


class Scaffold(Structure, name="platform/scaffold", weight=0.8, grain="fitting"):
    """A mobile scaffold tower (EN 1004): ladder frames, diagonal braces, a deck with a rail, casters or foot plates."""

    length: float = between(1.2, 2.2, "of the tower", "m")
    width: float = between(0.7, 1.3, "of the tower", "m")
    height: float = between(1.6, 3.2, "of the deck", "m")
    radius: float = between(0.06, 0.09, "of a caster's wheel", "m")
    wheeled: bool = chance(0.7, "on casters")
    casters: Casters = Casters.of("stem", when=lambda p: p.wheeled)
    joined: tuple[bool, ...] = several(yes(0.5), 2, "whether the rungs of a frame are one mesh")

    def build(self, t: Table) -> Model:
        a, b, h, low, style = self.length, self.width, self.height, 0.012, t.style
        spots = [(x, y) for x in (0.0, a) for y in (0.0, b)]
        if self.wheeled:
            low = self.casters.build(t, spots, self.radius)
        else:
            t.add_each("base plate", [box((0.15, 0.15, 0.012), (x, y, 0.006)) for x, y in spots])
        for x, joined in zip((0.0, a), self.joined, strict=True):
            posts = [pipe([(x, y, low), (x, y, h + 1.0)], 0.024, style, 0, 0.003) for y in (0.0, b)]
            t.add_each("column", posts, of="clamp")
            rungs = [pipe([(x, 0, z), (x, b, z)], 0.019, style) for z in np.arange(low + 0.3, h + 1.0, 0.5)]
            t.add_each("ladder", rungs, of="clamp", joined=joined)
        for y, (z0, z1) in ((-0.03, (low + 0.2, h - 0.2)), (b + 0.03, (h - 0.2, low + 0.2))):
            t.add("brace", pipe([(0, y, z0), (a, y, z1)], 0.017, style), of="clamp")
            rails = [pipe([(0, y, h + z), (a, y, h + z)], 0.017, style) for z in (0.5, 0.98)]
            t.add_each("railing", rails, of="clamp")
        t.add("platform", box((a, b - 0.05, 0.05), (a / 2, b / 2, h)), of="safety")
        return t.model()


FLOORS = families_of(Panels, Trench, Round, SolidPlatform, Mezzanine, Scaffold)
