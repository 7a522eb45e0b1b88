"""Railings and posts: welded bays, side-fixed, with infill, chains, curved, of clamps, on walls, crash barriers."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, of_form, one_of
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.steel.shape import (
    Base,
    Structure,
    bar,
    bases,
    bolts,
    few_sides,
    pipe,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    span_of,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, merge, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, ball, box, cylinder, dome, ring, rod, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["RAILS"]


class _Ground(Params):
    """What a railing along x from 0 stands on."""

    form: str = among(("floor", "kerb", "slab", "edge beam"), "what it is")

    def build(self, t: Table, length: float) -> float:
        """Puts it down; the height of its top [m]."""
        if self.form == "kerb":
            t.add("foundation", box((length + 0.2, 0.2, 0.15), (length / 2, 0, 0.075)))
        elif self.form == "slab":
            t.add("ground", box((length + 0.3, 1.2, 0.2), (length / 2, 0.5, 0.1)), of="concrete")
        elif self.form == "edge beam":
            t.add("beam", box((length + 0.1, 0.1, 0.2), (length / 2, 0, 0.1)))
        return {"floor": 0.0, "kerb": 0.15}.get(self.form, 0.2)


class _Kick(Params):
    """A toe plate 10 mm over the floor (ISO 14122-3), plain or folded, or none."""

    without: bool = chance(0.4, "there is none")
    high: float = among((0.1, 0.12, 0.15), "height", "m", when=lambda p: not p.without)
    thick: float = among((0.003, 0.005), "thickness", "m", when=lambda p: not p.without)

    def build(self, t: Table, length: float) -> None:
        """Puts it down on z = 0."""
        if not self.without:
            solid = box((length, self.thick, self.high), (length / 2, 0.025, 0.01 + self.high / 2))
            t.bundled("railing").add("railing", solid)


class BentBays(Structure, name="railing/bent bays", weight=1.2):
    """Welded bays of bent tube: bows from foot to foot with rails in them, on base plates (ISO 14122-3)."""

    count: int = whole(1, 3, "bays")
    width: float = between(0.8, 2.0, "of a bay", "m")
    height: float = between(0.9, 1.2, "of a bow", "m")
    radius: float = among((0.017, 0.021, 0.024), "of the tube", "m")
    ground: _Ground = nested(_Ground, "what it stands on")
    rails: int = whole(1, 3, "rails in a bow")
    joined: bool = chance(0.5, "a bay is one mesh")
    bend: float = among((0.0, 0.1, 0.2), "radius of a bow's bends", "m")
    bases: tuple[Base, ...] = bases(lambda p: p.count)
    kick: _Kick = nested(_Kick, "toe plate")

    def build(self, t: Table) -> Model:
        w, h, r, style = self.width, self.height, self.radius, t.style
        up = t.at(0, 0, self.ground.build(t, self.count * w))
        for k, base in enumerate(self.bases):
            a, b = k * w + 0.04, (k + 1) * w - 0.04
            low = base.build(up.at(a), 0.1, 0.08)
            up.add("base plate", box((0.1, 0.08, low), (b, 0, low / 2)))
            solids = [pipe([(a, 0, low), (a, 0, h), (b, 0, h), (b, 0, low)], r, style, self.bend, 0.003)]
            levels = [h * (j + 1) / (self.rails + 1) for j in range(self.rails)]
            solids += [pipe([(a + r, 0, z), (b - r, 0, z)], 0.8 * r, style) for z in levels]
            up.bundled("railing").add_each("railing", solids, joined=self.joined)
        self.kick.build(up, self.count * w)
        return t.model()


class SideFixed(Structure, name="railing/side fixed"):
    """Posts of flat, angle, tube or channel bolted to the side of an edge beam, with rails through or before them."""

    length: float = between(1.2, 4.0, "of the railing", "m")
    height: float = between(0.95, 1.15, "over the edge beam", "m")
    edge_size: float = between(0.14, 0.24, "height of the edge beam's section", "m")
    edge: str = among(("U", "RHS", "U", "H"), "section of the edge beam")
    lift: float = between(0.0, 1.0, "height of the edge beam over 0.15 m", "m")
    feet: tuple[str, ...] = several(one_of("column", "foundation"), 2, "what the edge beam stands on")
    post: str = among(("flat", "L", "SHS", "CHS", "U"), "section of the posts")
    rail: str = among(("CHS", "SHS", "L", "flat"), "section of the rails")
    rails: int = whole(3, 4, "levels with the edge beam's")
    behind: tuple[float, ...] = several(
        one_of(0.03, 0.0), lambda p: p.rails - 2, "how far a lower rail is behind the posts' axis", "m"
    )
    kicked: bool = chance(0.6, "a toe plate")

    def build(self, t: Table) -> Model:
        long, z, own, size = self.length, self.lift + 0.15, t.bundled("railing"), 0.03
        edge, one, rail = (
            section(kind, high, t.style)
            for kind, high in ((self.edge, self.edge_size), (self.post, 0.06), (self.rail, 0.045))
        )
        x0, _x1, y0, y1 = span_of(edge)
        deep, y = y1 - y0, x0 - size - 0.008
        t.add("beam", bar((0, 0, z + deep / 2), (long, 0, z + deep / 2), edge))
        for x, name in zip((0.1, long - 0.1), self.feet, strict=True):
            t.add(name, box((0.12, 0.12, z), (x, 0, z / 2)), of="steel")
        for x in np.linspace(0.06, long - 0.06, max(2, int(long / 1.1) + 1)):
            post = bar((x, y, z + 0.03), (x, y, z + deep + self.height), one, (0, 1, 0))
            own.add("post", post, of="safety")
            t.add("plate", box((0.08, 0.008, deep), (x, x0 - 0.004, z + 0.5 * deep)))
            turn = spun("x", np.pi / 2)
            bolts(t, [at(x + s * 0.025, x0 - 0.008, z + 0.5 * deep) @ turn for s in BOTH], 0.012, 0.01)
        levels = np.linspace(z + deep, z + deep + self.height, self.rails)
        for level, shift in zip((levels[-1], *levels[1:-1]), (0.0, *self.behind), strict=True):
            own.add("railing", bar((0, y + shift, level), (long, y + shift, level), rail))
        if self.kicked:
            own.add("railing", box((long, 0.005, 0.1), (long / 2, y + size + 0.0025, z + deep + 0.06)))
        return t.model()


def _mesh(w: float, h: float) -> Solid:
    """Wires across each other."""
    wires = [rod((x, 0, 0), (x, 0, h), 0.002, 4) for x in np.linspace(0, w, int(w / 0.07) + 2)[1:-1]]
    wires += [rod((0, 0.003, z), (w, 0.003, z), 0.002, 4) for z in np.linspace(0, h, int(h / 0.07) + 2)[1:-1]]
    return merge(wires)


def _fill(kind: str, w: float, h: float, style: ModelingStyle) -> list[Solid]:
    """What fills a frame of this width and height from the origin in x and z: bars, wires, sheet, glass, slats."""
    if kind == "bars":
        return [rod((x, 0, 0), (x, 0, h), 0.006, few_sides(style, 0.006, 8)) for x in np.arange(0.1, w - 0.05, 0.11)]
    if kind == "wires":
        return [rod((0, 0, z), (w, 0, z), 0.003, 6) for z in np.arange(0.1, h, 0.1)]
    if kind == "mesh":
        return [_mesh(w, h)]
    if kind == "sheet":
        spots = [(x, z) for x in np.arange(0.1, w - 0.08, 0.12) for z in np.arange(0.1, h - 0.08, 0.12)]
        holes = tuple(circle(0.012, 6, spot) for spot in spots) if style.holes else ()
        return [slab_xz([(0, 0), (w, 0), (w, h), (0, h)], 0.002, 0.0, holes)]
    if kind == "glass":
        return [box((w - 0.04, 0.012, h - 0.02), (w / 2, 0, h / 2))]
    if kind == "cross":
        return [rod((0, 0, 0), (w, 0, h), 0.01, 8), rod((0, 0.015, h), (w, 0.015, 0), 0.01, 8)]
    return [box((w, 0.02, 0.09), (w / 2, 0, z)) for z in np.arange(0.08, h, 0.13)]


class Infill(Structure, name="railing/infill", weight=1.5):
    """A balustrade: posts, top and bottom rail, filled with bars, wires, mesh, sheet, glass, slats or a cross."""

    count: int = whole(1, 3, "bays")
    width: float = between(0.8, 1.6, "of a bay", "m")
    height: float = between(0.9, 1.2, "of a post", "m")
    ground: _Ground = nested(_Ground, "what it stands on")
    fill: str = among(("bars", "bars", "wires", "mesh", "sheet", "glass", "slats", "cross"), "of a bay")
    size: float = between(0.035, 0.06, "height of a post's section", "m")
    post: str = among(("SHS", "CHS", "flat", "square"), "section of the posts")
    rail: str = among(("CHS", "SHS", "flat", "timber"), "section of the top rail")
    bases: tuple[Base, ...] = bases(lambda p: p.count + 1)
    joined: bool = chance(0.5, "a bay is one mesh")

    def build(self, t: Table) -> Model:
        w, h, style, glass = self.width, self.height, t.style, self.fill == "glass"
        post, top = section(self.post, self.size, style), section(self.rail, 0.045, style)
        up = t.at(0, 0, self.ground.build(t, self.count * w))
        own, half = up.bundled("railing"), float(np.ptp(post[0][:, 0])) / 2
        for k, base in enumerate(self.bases):
            low = base.build(up.at(k * w), 0.11, 0.09)
            own.add("post", bar((k * w, 0, low), (k * w, 0, h), post, (0, 1, 0)), of="safety")
        high, wide = h + float(np.ptp(top[0][:, 1])) / 2, w - 2 * half
        own.add("railing", bar((-half, 0, high), (self.count * w + half, 0, high), top))
        solids = _fill(self.fill, wide, h - 0.1, style)
        if self.fill not in ("glass", "wires", "slats"):
            solids = [bar((0, 0, 0), (wide, 0, 0), section("SHS", 0.03, style)), *solids]
        for k in range(self.count):
            a = k * w + half
            own.at(a, 0, 0.1).add_each("railing", solids, of="dial" if glass else "safety", joined=self.joined)
            spots = [(x, f) for x in (a + 0.01, a + wide - 0.01) for f in (0.3, 0.8) if glass]
            up.add_each("clamp", [box((0.05, 0.03, 0.04), (x, 0, f * h)) for x, f in spots], of="steel")
        return t.model()


def _links(a: Floats, b: Floats, sag: float) -> Solid:
    """A chain that hangs between two points, its links long rings turned by quarters."""
    count = max(8, int(np.linalg.norm(b - a) / 0.07))
    s = np.linspace(0, 1, count + 1)
    path = a + s[:, None] * (b - a) - np.outer(4 * sag * s * (1 - s), [0, 0, 1])
    links = []
    for k in range(count):
        p, q = path[k], path[k + 1]
        x = (q - p) / np.linalg.norm(q - p)
        z = np.cross(x, [0.0, 1.0, 0.0])
        pose = np.eye(4)
        pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, (0, 1, 0), z, (p + q) / 2
        long = float(np.linalg.norm(q - p)) / 2
        link = moved(torus(1.0, 0.16, 8, 5), np.diag([long * 1.05, 0.022, 0.022, 1.0]))
        links.append(moved(link, pose @ spun("x", np.pi / 2 * (k % 2))))
    return merge(links)


class Chained(Structure, name="railing/chain", weight=0.8, grain="fitting"):
    """Posts with ball or flat tops on plates or weighted feet, joined by chains, ropes or a belt."""

    count: int = whole(2, 4, "posts")
    width: float = between(0.9, 1.8, "from post to post", "m")
    height: float = between(0.8, 1.1, "of a post", "m")
    radius: float = between(0.02, 0.045, "of a post", "m")
    line: str = among(("chain", "chain", "rope", "belt"), "what joins the posts")
    top: str = among(("ball", "dome", "flat"), "of a post")
    loose: bool = chance(0.5, "its posts have weighted feet, no base plates")
    bases: tuple[Base, ...] = bases(lambda p: p.count, when=lambda p: not p.loose)
    double: bool = chance(0.5, "a second line below the first")

    def build(self, t: Table) -> Model:
        w, h, r, n = self.width, self.height, self.radius, few_sides(t.style, self.radius, 16)
        foot = turned(outline(5 * r, 0, 5 * r, 0.02, 2 * r, 0.05, r, 0.06), n)
        top = {
            "ball": moved(ball(1.4 * r, n), at(0, 0, h + 0.8 * r)),
            "dome": dome(r, 0.6 * r, h, n),
            "flat": cylinder(1.3 * r, h, h + 0.01, n),
        }[self.top]
        for k in range(self.count):
            here, low = t.at(k * w), 0.06
            if self.loose:
                here.add("base plate", foot, of="rubber")
            else:
                low = self.bases[k].build(here, 6 * r, 6 * r)
            here.add("post", cylinder(r, low, h, n), top, of="safety")
        s = np.linspace(0, 1, 9)
        for level in (0.9 * h, 0.5 * h)[: 1 + self.double]:
            for k in range(self.count - 1):
                a, b = np.array([k * w + r, 0, level]), np.array([(k + 1) * w - r, 0, level])
                if self.line == "chain":
                    solid = _links(a, b, 0.1 * w)
                elif self.line == "rope":
                    path = a + s[:, None] * (b - a) - np.outer(0.4 * w * s * (1 - s), [0, 0, 1])
                    solid = pipe(path, 0.012, t.style)
                else:
                    solid = box((w - 2 * r, 0.002, 0.05), ((a[0] + b[0]) / 2, 0, level))
                t.add("railing", solid)
        return t.model()


class Curved(Structure, name="railing/curved"):
    """A railing on an arc, as round a tank's roof or a pit: rails swept round, posts radial, a bent toe plate."""

    bend: float = between(0.8, 2.5, "radius of the arc", "m")
    turn: float = between(0.8, 4.5, "of the arc", "rad")
    height: float = between(0.95, 1.15, "of the top rail", "m")
    radius: float = among((0.017, 0.021, 0.024), "of the top rail's tube", "m")
    rails: int = whole(3, 4, "levels with the floor's")
    post: str = among(("CHS", "flat", "L"), "section of the posts")
    kicked: bool = chance(0.6, "a toe plate")
    floored: bool = chance(0.5, "a strip of floor under it")
    floor: str = among(("platform", "foundation"), "what the floor is called", when=lambda p: p.floored and p.turn < 6)

    def build(self, t: Table) -> Model:
        bend, h, r, own = self.bend, self.height, self.radius, t.bundled("railing")
        a = np.linspace(0, self.turn, max(8, int(self.turn * 8)) + 1)

        def round_at(z: float, reach: float) -> Floats:
            return np.column_stack([reach * np.cos(a), reach * np.sin(a), np.full(len(a), z)])

        own.add("railing", pipe(round_at(h, bend), r, t.style, 0.0, 0.003))
        levels = np.linspace(0, h, self.rails)[1:-1]
        own.add_each("railing", [pipe(round_at(float(z), bend), 0.75 * r, t.style) for z in levels])
        n, one = few_sides(t.style, r, 14), section(self.post, 2 * r, t.style)
        for angle in np.linspace(0, self.turn, max(3, int(bend * self.turn / 1.0) + 1)):
            x, y = bend * np.cos(angle), bend * np.sin(angle)
            own.add("post", bar((x, y, 0.008), (x, y, h - 0.5 * r), one, (-y, x, 0)), of="safety")
            t.at(x, y).add("base plate", cylinder(0.05, 0, 0.008, n))
        if self.kicked:
            flat = rounded_rectangle(0.1, 0.004, 0.0)
            own.add("railing", sweep(round_at(0.06, bend - r - 0.002), flat, up=(0, 0, 1)))
        if self.floor:
            rim = np.vstack([round_at(0, bend + 0.15)[:, :2], round_at(0, bend - 0.3)[::-1, :2]])
            t.add(self.floor, slab_xy(rim, -0.05, 0.0), of="concrete")
        return t.model()


class Clamped(Structure, name="railing/clamped tubes", weight=0.8, grain="fitting"):
    """A railing of tubes in cast clamps (key clamps): tees, crosses and feet with grub screws; corner or straight."""

    count: int = whole(1, 3, "bays")
    width: float = between(0.9, 1.6, "of a bay", "m")
    height: float = between(0.9, 1.1, "of the top rail", "m")
    radius: float = among((0.017, 0.0212, 0.0242), "of the tubes", "m")
    joined: bool = chance(0.4, "the tubes are one mesh")

    def build(self, t: Table) -> Model:
        w, h, r, count = self.width, self.height, self.radius, self.count
        n, levels = few_sides(t.style, r, 14), (0.5 * h, h)
        for k in range(count + 1):
            here = t.at(k * w)
            here.add("base plate", cylinder(2.6 * r, 0, 0.008, n), cylinder(1.35 * r, 0.008, 0.06, n), of="clamp")
            arm = along("x", cylinder(1.3 * r, -2.4 * r * (k > 0), 2.4 * r * (k < count), n))
            for z in levels:
                here.at(0, 0, z).add("clamp", cylinder(1.35 * r, -1.5 * r, 1.5 * r, n), arm)
        posts = [rod((k * w, 0, 0.06), (k * w, 0, h + 0.7 * r), r, n) for k in range(count + 1)]
        ends = [(k * w + 1.2 * r, (k + 1) * w - 1.2 * r, z) for z in levels for k in range(count)]
        rails = [rod((a, 0, z), (b, 0, z), r, n) for a, b, z in ends]
        if self.joined:
            t.add("railing", *posts, *rails, of="clamp")
        else:
            for name, solids in (("post", posts), ("railing", rails)):
                t.bundled("railing").add_each(name, solids, of="clamp")
        return t.model()


class OnWall(Structure, name="railing/wall", weight=0.8, grain="fitting"):
    """A handrail on brackets on a wall, level or rising, its ends bent to the wall."""

    length: float = between(1.0, 3.5, "of the handrail, level", "m")
    slope: float = among((0.0, 0.0, 0.4), "rise / length, but for the next factor")
    steep: float = between(0.8, 1.2, "factor of the slope", when=lambda p: p.slope > 0)
    radius: float = among((0.017, 0.021, 0.025), "of the tube", "m")
    height: float = between(0.85, 1.0, "of its lower end", "m")
    above: float = between(0.2, 1.5, "height of the wall over its upper end", "m")
    bent: bool = chance(0.6, "its ends are bent to the wall")

    def build(self, t: Table) -> Model:
        long, rise, r, y, z = self.length, self.slope * self.steep, self.radius, -0.09, self.height
        tall = z + rise * long + self.above
        t.add("wall", box((long + 0.4, 0.15, tall), (long / 2, 0.075, tall / 2)))
        path = [(x, y_, z + rise * x) for x, y_ in ((0.0, 0.0), (0.0, y), (long, y), (long, 0.0))]
        rail = pipe(path if self.bent else path[1:3], r, t.style, 0.06, 0.003)
        t.add("railing", rail, of="handle")
        rose = along("y", cylinder(0.03, -0.006, 0.0, few_sides(t.style, 0.03, 14)), 0, 0, -0.06)
        arm = pipe([(0, 0, -0.06), (0, y, -0.06), (0, y, 0.3 * r)], 0.007, t.style, 0.04)
        for x in np.linspace(0.15, long - 0.15, max(2, int(long / 0.9) + 1)):
            t.at(x, 0, z + rise * x - r).add("bracket", arm, rose)
        return t.model()


# The lower half of a W-beam's section, from its edge to its middle.
_WAVE = outline(0, -0.155, 0, -0.13, 0.08, -0.1, 0.08, -0.06, 0, -0.02)


class _Hoop(Params):
    """A floor hoop of thick tube."""

    bases: tuple[Base, ...] = bases(2)
    railed: bool = chance(0.5, "with a cross tube")


class Barrier(Structure, name="railing/barrier", grain="fitting"):
    """Impact protection: floor hoops of thick tube, a W-beam on posts (EN 1317), or plank rails between stout posts."""

    form: str = among(("hoops", "W-beam", "planks"), "what it is")
    count: int = whole(1, 3, "bays")
    width: float = between(0.8, 2.0, "of a bay", "m")
    radius: float = between(0.03, 0.06, "of a hoop's tube", "m", when=of_form("hoops"))
    height: float = between(
        lambda p: 0.35 if p.form == "hoops" else 0.6,
        lambda p: 1.0 if p.form == "hoops" else 0.9,
        "of hoops or posts",
        "m",
    )
    hoops: tuple[_Hoop, ...] = several(made(_Hoop), lambda p: p.count, "hoop", when=of_form("hoops"))
    size: float = between(0.08, 0.14, "height of a post's section", "m", when=lambda p: p.form != "hoops")
    post: str = among(("U", "H", "SHS", "C"), "section of the posts", when=lambda p: p.form != "hoops")
    bases: tuple[Base, ...] = bases(lambda p: p.count + 1, when=lambda p: p.form != "hoops")
    plank: str = among(("U", "RHS", "timber", "flat"), "section of the planks", when=of_form("planks"))
    plank_size: float = between(0.12, 0.25, "height of a plank", "m", when=of_form("planks"))
    planks: int = whole(1, 3, "one above the other", when=of_form("planks"))

    def build(self, t: Table) -> Model:
        w, h, r = self.width, self.height, self.radius
        for k, hoop in enumerate(self.hoops):
            here = t.at(k * (w + 0.3))
            for x, base in zip((0.0, w), hoop.bases, strict=True):
                base.build(here.at(x), 5 * r, 5 * r)
            path = [(0, 0, 0.008), (0, 0, h), (w, 0, h), (w, 0, 0.008)]
            tubes = [pipe(path, r, t.style, 3 * r, 0.004)]
            tubes += [pipe([(0, 0, 0.5 * h), (w, 0, 0.5 * h)], 0.8 * r, t.style)] if hoop.railed else []
            here.add("railing", *tubes)
        if not self.hoops:
            self._posted(t)
        return t.model()

    def _posted(self, t: Table) -> None:
        """With posts."""
        h, length, stout = self.height, self.count * self.width, section(self.post, self.size, t.style)
        for k, base in enumerate(self.bases):
            low = base.build(t.at(k * self.width), 0.25, 0.25)
            post = bar((k * self.width, 0, low), (k * self.width, 0, h), stout, (0, 1, 0))
            t.add("post", post, of="safety")
        face = float(stout[0][:, 1].min())
        if self.form == "W-beam":
            line = ribbon([*_WAVE, *((x, -z) for x, z in _WAVE[::-1])], 0.003, 0.01, 2)
            rail = along("x", slab_xy(np.column_stack([-line[:, 1], line[:, 0]]), -0.3, length + 0.3))
            t.at(0, face - 0.0015, h - 0.16).spun("x", np.pi).add("railing", rail, of="clamp")
            return
        plank = section(self.plank, self.plank_size, t.style)
        y = face - float(plank[0][:, 0].max())
        levels = np.linspace(0.2, h - 0.1, self.planks)
        t.add_each("railing", [bar((-0.1, y, z), (length + 0.1, y, z), plank) for z in levels])


class Bollards(Structure, name="post/bollard", weight=0.8, grain="fitting"):
    """Bollards: steel tubes with dome, cap or concrete fill, on plates or cast in, with bands or hoops."""

    count: int = whole(1, 4, "bollards")
    width: float = between(0.6, 1.5, "from one to the next", "m", when=lambda p: p.count > 1)
    height: float = between(0.5, 1.3, "of a bollard", "m")
    radius: float = between(0.045, 0.11, "of a bollard", "m")
    top: str = among(("dome", "flat", "cap", "groove"), "of a bollard")
    cast: bool = chance(0.4, "cast in concrete, not on base plates")
    banded: bool = chance(0.4, "with a reflecting band")
    bases: tuple[Base, ...] = bases(lambda p: p.count, when=lambda p: not p.cast)

    def build(self, t: Table) -> Model:
        h, r, n = self.height, self.radius, few_sides(t.style, self.radius, 24)
        end = {
            "dome": outline(r, h - r, 0.7 * r, h - 0.3 * r, 0, h),
            "flat": outline(r, h),
            "cap": outline(r, h - 0.03, 1.1 * r, h - 0.03, 1.1 * r, h),
            "groove": outline(r, h - 0.1, 0.85 * r, h - 0.1, 0.85 * r, h - 0.07, r, h - 0.07, r, h),
        }[self.top]
        for k in range(self.count):
            here, low = t.at(k * self.width), 0.0
            if self.cast:
                here.add("foundation", box((5 * r, 5 * r, 0.2), (0, 0, -0.1)))
            else:
                low = self.bases[k].build(here, 3.4 * r, 3.4 * r)
            here.add("post", turned([(r, low), *end], n), of="safety")
            if self.banded:
                here.add("sign", ring(r, r + 0.002, 0.6 * h, 0.6 * h + 0.1, n), of="dial")
        return t.model()


_SHAPES = ("SHS", "RHS", "CHS", "L", "U", "flat", "strut", "round", "T", "timber")


class _Stand(Params):
    """A lone post."""

    size: float = between(0.03, 0.1, "height of its section", "m")
    height: float = between(0.4, 2.2, "of the post", "m")
    shape: str = among(_SHAPES, "section")
    foot: str = among(("plate", "socket", "plinth"), "what it stands on, in or beside")
    base: Base = nested(Base, "base plate", when=lambda p: p.foot == "plate")
    top: str = among(("cap", "panel", "arm", "bare"), "what it carries")
    panel: str = among(("sign", "plate"), "what the panel is called", when=lambda p: p.top == "panel")

    def build(self, t: Table) -> None:
        """Puts it down about z."""
        size, h, one, low = self.size, self.height, section(self.shape, self.size, t.style), 0.0
        y0 = float(one[0][:, 1].min())
        if self.foot == "plate":
            low = self.base.build(t, size + 0.08, size + 0.08)
        elif self.foot == "socket":
            t.add("foundation", box((4 * size, 4 * size, 0.12), (0, 0, -0.06)))
        else:
            t.add("foundation", box((0.4, 0.3, 0.5), (0, 0.15 - y0, 0.25)))
        t.add("post", bar((0, 0, low), (0, 0, h), one, (0, 1, 0)))
        if self.top == "cap":
            t.add("plate", box((size + 0.06, size + 0.06, 0.008), (0, 0, h + 0.004)))
        elif self.top == "panel":
            t.add(self.panel, box((0.25, 0.003, 0.2), (0, y0 - 0.0015, h - 0.12)), of="dial")
        elif self.top == "arm":
            t.add("bracket", box((0.3, 0.04, 0.006), (0, 0, h + 0.003)))


class Stands(Structure, name="post/stand", weight=1.2, grain="fitting"):
    """Lone posts of any section on plates, in sockets or on the side of a plinth, with caps, arms or a small panel."""

    count: int = whole(1, 3, "posts")
    posts: tuple[_Stand, ...] = several(made(_Stand), lambda p: p.count, "post")

    def build(self, t: Table) -> Model:
        for k, one in enumerate(self.posts):
            one.build(t.at(0.9 * k))
        return t.model()


RAILS = families_of(BentBays, SideFixed, Infill, Chained, Curved, Clamped, OnWall, Barrier, Bollards, Stands)
