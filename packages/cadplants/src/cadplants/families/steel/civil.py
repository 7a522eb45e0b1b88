"""Foundations and walls: blocks, rings, pile caps, plinths; masonry, clad walls, bunds, retaining walls."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form, one_of, yes
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.shape import (
    Base,
    Structure,
    bar,
    bases,
    bolts,
    few_sides,
    rect,
    ribbon,
    section,
    slab_xy,
    slab_xz,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, loft, merge, moved, weld
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import CORNERS, box, cylinder, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["CIVIL"]


def _frustum(low: Floats, high: Floats, z: tuple[float, float]) -> Solid:
    """A solid between two outlines of as many corners at two heights."""
    loops = [np.column_stack([one, np.full(len(one), h)]) for one, h in zip((low, high), z, strict=True)]
    ends = [loops[0].mean(axis=0, keepdims=True), loops[1].mean(axis=0, keepdims=True)]
    return weld([loft([ends[0], *loops, ends[1]])])


_ON_TOP = ("anchors", "bare", "sole plates", "grout")
_ON_TOP_OF = {"chamfered": 4, "battered": 4, "recessed": 2}


class Plinth(Structure, name="foundation/plinth", weight=1.4, grain="fitting"):
    """Equipment plinths: chamfered, battered, with a step or recess, round; with grout, sole plates and anchors."""

    form: str = among(("chamfered", "battered", "stepped", "round", "recessed"), "how it is made")
    length: float = between(0.4, 2.4, "of the plinth, or diameter", "m")
    width: float = between(0.3, 1.4, "of the plinth", "m", when=lambda p: p.form != "round")
    height: float = between(0.08, 0.8, "of the plinth", "m")
    slabbed: bool = chance(0.4, "a slab under it")
    slab: str = among(("ground", "foundation"), "what the slab is called", when=lambda p: p.slabbed)
    top: str = among(lambda p: _ON_TOP[: _ON_TOP_OF.get(p.form, 3)], "what is on it")
    anchor: float = among((0.012, 0.016, 0.02), "diameter of an anchor", "m", when=lambda p: p.top == "anchors")

    def build(self, t: Table) -> Model:
        a, b, h, form = self.length, self.width, self.height, self.form
        t.add("foundation", self._block(t))
        b = b or a
        if self.slabbed:
            t.add(self.slab, box((a + 0.8, b + 0.8, 0.15), (0, 0, -0.075)), of="concrete")
        shift, reach = (0.25 * a, 0.14 * a) if form == "stepped" else (0.0, 0.3 * a if form == "recessed" else 0.26 * a)
        deep = (0.32 if form == "recessed" else 0.26) * b
        spots = [(shift + sx * reach, sy * deep) for sx, sy in CORNERS]
        if self.top == "anchors":
            bolts(t, [at(x, y, h) for x, y in spots], self.anchor, 0.03)
        elif self.top == "sole plates":
            size = (min(0.16, 1.2 * reach), min(0.12, 1.2 * deep), 0.02)
            t.add_each("base plate", [box(size, (x, y, h + 0.01)) for x, y in spots])
            bolts(t, [at(x, y, h + 0.02) for x, y in spots], 0.014, 0.02)
        elif self.top == "grout":
            t.add("foundation", box((0.8 * a, 0.8 * b, 0.03), (0, 0, h + 0.015)), of="ground")
            t.add("base plate", box((0.74 * a, 0.74 * b, 0.015), (0, 0, h + 0.0375)))
        return t.model()

    def _block(self, t: Table) -> Solid:
        """The plinth itself."""
        a, b, h, chamfer = self.length, self.width, self.height, min(0.03, 0.3 * self.height)
        if self.form == "chamfered":
            top = _frustum(rect(a, b), rect(a - 2 * chamfer, b - 2 * chamfer), (h - chamfer, h))
            return merge([extrude(rect(a, b), 0, h - chamfer), top])
        if self.form == "battered":
            return _frustum(rect(a + 0.4 * h, b + 0.4 * h), rect(a, b), (0, h))
        if self.form == "stepped":
            return slab_xz([(-a / 2, 0), (a / 2, 0), (a / 2, h), (0, h), (0, 0.6 * h), (-a / 2, 0.6 * h)], b)
        if self.form == "round":
            return turned([(a / 2, 0), (a / 2, h - chamfer), (a / 2 - chamfer, h)], few_sides(t.style, a / 2, 40))
        return extrude(rect(a, b), 0, h, (rect(0.5 * a, 0.4 * b),))


def _stub(p: Any) -> bool:
    return bool(p.form != "socket")


class Footing(Structure, name="foundation/footing", weight=1.2, grain="fitting"):
    """Footings of columns: pad with pedestal, sloped pad, socket, pile cap on piles; a stub column with its plate."""

    side: float = between(0.8, 2.0, "of the pad", "m")
    form: str = among(("pad", "sloped", "socket", "piles"), "how it is made")
    pedestal: float = between(0.3, 0.5, "side of the pedestal", "m")
    deep: float = between(0.25, 0.5, "height of the pad", "m")
    tall: float = between(0.2, 0.7, "height of the pedestal", "m")
    column: float = between(1.0, 2.5, "height of a column in the socket", "m", when=of_form("socket"))
    round: bool = among((False, True), "the pedestal is round", when=_stub)
    stub: str = among(("H", "SHS", "CHS", "I"), "section of the stub column", when=_stub)
    base: Base = nested(Base, "its base plate", when=_stub)
    long: float = between(0.3, 1.5, "length of the stub column", "m", when=_stub)
    joined: bool = chance(0.5, "the concrete is one mesh")

    def build(self, t: Table) -> Model:
        a, p, deep = self.side, self.pedestal, self.deep
        h, n = deep + self.tall, few_sides(t.style, self.pedestal / 2, 32)
        solids = [box((a, a, deep), (0, 0, deep / 2))]
        if self.form == "sloped":
            slope = _frustum(rect(a, a), rect(1.2 * p, 1.2 * p), (0.6 * deep, deep))
            solids = [box((a, a, 0.6 * deep), (0, 0, 0.3 * deep)), slope]
        if self.form == "socket":
            solids.append(extrude(rect(1.6 * p, 1.6 * p), deep, h, (rect(1.05 * p, 1.05 * p),)))
        else:
            solids.append(extrude(circle(p / 2, n) if self.round else rect(p, p), deep, h))
        t.add_each("foundation", solids, joined=self.joined)
        if self.form == "piles":
            pile = cylinder(0.15, -1.0, 0.0, few_sides(t.style, 0.15, 24))
            t.add_each("foundation", [moved(pile, at(sx * 0.3 * a, sy * 0.3 * a)) for sx, sy in CORNERS])
        if self.form == "socket":
            size = (0.95 * p, 0.95 * p, self.column)
            t.add("column", box(size, (0, 0, deep + self.column / 2)), of="concrete")
        else:
            z = h + self.base.build(t.at(0, 0, h), 0.8 * p, 0.8 * p)
            one = section(self.stub, 0.5 * p, t.style)
            t.add("column", bar((0, 0, z), (0, 0, z + self.long), one, (0, 1, 0)))
        return t.model()


class RingBase(Structure, name="foundation/ring", weight=0.8, grain="fitting"):
    """A tank's base: a ring wall with sand, an octagon or round slab, chairs and anchors round it (API 650)."""

    radius: float = between(0.6, 2.0, "of the tank", "m")
    height: float = between(0.15, 0.6, "of the base", "m")
    form: str = among(("ring", "octagon", "step"), "how it is made")
    wide: float = between(0.2, 0.4, "width of the ring", "m")
    chaired: bool = chance(0.6, "with chairs and anchors")
    chairs: int = whole(6, 12, "round it", when=lambda p: p.chaired)

    def build(self, t: Table) -> Model:
        r, h, w, n = self.radius, self.height, self.wide, few_sides(t.style, self.radius, 48)
        if self.form == "ring":
            t.add("foundation", ring(r - w / 2, r + w / 2, 0, h, n))
            t.add("ground", cylinder(r - w / 2, 0, h - 0.02, n))
        elif self.form == "octagon":
            t.add("foundation", cylinder(r + w, 0, h, 8))
        else:
            step = [(r + w, 0), (r + w, 0.5 * h), (r + 0.3 * w, 0.5 * h), (r + 0.3 * w, h)]
            t.add("foundation", turned(step, n))
        poses = [spun("z", 2 * np.pi * k / self.chairs) @ at(r, 0, h) for k in range(self.chairs)]
        t.add_each("base plate", [moved(box((0.12, 0.12, 0.012), (0, 0, 0.006)), pose) for pose in poses])
        if poses:
            bolts(t, [pose @ at(0, 0, 0.012) for pose in poses], 0.02, 0.012)
        return t.model()


def _carrying(p: Any) -> bool:
    return p.form in ("raft", "blocks")


class Strip(Structure, name="foundation/strip", grain="fitting"):
    """Sleepers and strips: a row of sleepers, an upturned T strip, a raft with ribs, precast blocks under a beam."""

    form: str = among(("sleepers", "T strips", "raft", "blocks"), "how they are made")
    long: float = between(0.6, 2.0, "length of a strip", "m", when=lambda p: p.form != "blocks")
    count: int = whole(2, 4, "strips")
    wide: float = between(0.15, 0.5, "width of a strip", "m")
    height: float = between(0.15, 0.5, "of a strip", "m")
    gap: float = between(0.8, 1.6, "from strip to strip", "m")
    plated: tuple[bool, ...] = several(
        yes(0.6), lambda p: p.count, "whether a plate is on a sleeper", when=of_form("sleepers")
    )
    size: float = between(0.1, 0.2, "height of the section on it", "m", when=_carrying)
    shape: str = among(("H", "U", "RHS"), "section on it", when=_carrying)
    called: str = among(("beam", "skid frame"), "what that is called", when=_carrying)

    def build(self, t: Table) -> Model:
        long, w, h, last = self.long, self.wide, self.height, (self.count - 1) * self.gap
        half = [(w, 0), (w, 0.4 * h), (0.4 * w, 0.4 * h), (0.4 * w, h)]
        solid = {
            "sleepers": slab_xz([(-w / 2, 0), (w / 2, 0), (0.4 * w, h), (-0.4 * w, h)], long),
            "T strips": slab_xz([(-w, 0), *half, *((-x, z) for x, z in half[:0:-1])], long),
            "raft": box((w, long, h), (0, 0, h / 2)),
            "blocks": _frustum(rect(1.4 * w, 1.4 * w), rect(w, w), (0, h)),
        }[self.form]
        for k in range(self.count):
            here = t.at(k * self.gap)
            here.add("foundation", solid)
            if any(self.plated[k : k + 1]):
                here.add("plate", box((0.1, 0.8 * long, 0.01), (0, 0, h + 0.005)))
        if self.form == "raft":
            t.add("foundation", box((self.count * self.gap, long + 0.2, 0.2), (last / 2, 0, -0.1)))
        if _carrying(self):
            one = section(self.shape, self.size, t.style)
            z = h - float(one[0][:, 1].min())
            t.add(self.called, bar((-0.2, 0, z), (last + 0.2, 0, z), one))
        return t.model()


# --- walls ---


class Masonry(Structure, name="wall/masonry"):
    """Masonry: courses of blocks (one mesh or block by block) with pilasters and coping."""

    length: float = between(1.0, 3.5, "of the wall", "m")
    height: float = between(0.5, 2.6, "of the wall", "m")
    thick: float = among((0.115, 0.175, 0.24), "thickness of the wall", "m")
    big: bool = chance(0.7, "of blocks, not bricks")
    block: float = among((0.4, 0.5), "length of a block", "m", when=lambda p: p.big, otherwise=0.25)
    joined: bool = chance(0.8, "the courses are one mesh")
    pilasters: int = whole(0, 3, "before it")
    labels: tuple[str, ...] = several(one_of("wall", "column"), lambda p: p.pilasters, "what a pilaster is called")
    coped: bool = chance(0.6, "with coping")

    def build(self, t: Table) -> Model:
        long, thick, own = self.length, self.thick, t.bundled("wall")
        wide, high = self.block, 0.2 if self.big else 0.125
        rows = max(2, int(self.height / high))
        if rows * long / wide > 90:
            wide, high = wide * 2, high * 2
            rows = max(2, int(self.height / high))
        solids = []
        for k in range(rows):
            edges = [0.0, *np.arange(wide * (0.5 if k % 2 else 1.0), long - 0.02, wide), long]
            for a, b in zip(edges[:-1], edges[1:], strict=True):
                solids.append(box((b - a - 0.002, thick, high - 0.001), ((a + b) / 2, 0, (k + 0.5) * high)))
        top = rows * high
        own.add_each("wall", solids, joined=self.joined)
        for x, name in zip(np.linspace(0.15, long - 0.15, self.pilasters), self.labels, strict=True):
            t.add(name, box((0.3, thick + 0.2, top), (x, 0, top / 2)), of="concrete")
        if self.coped:
            own.add("wall", slab_xy(rect(long + 0.06, thick + 0.1, long / 2), top, top + 0.05), of="ground")
        t.add("foundation", box((long + 0.3, thick + 0.3, 0.2), (long / 2, 0, -0.1)))
        return t.model()


class Clad(Structure, name="wall/clad", grain="fitting"):
    """A hall's wall: posts and rails clad with trapezoidal or sandwich sheet, upright or level, with door or window."""

    count: int = whole(1, 3, "bays")
    width: float = between(1.2, 2.4, "of a bay", "m")
    height: float = between(2.0, 3.5, "of the wall", "m")
    size: float = between(0.1, 0.2, "height of a post's section", "m")
    post: str = among(("H", "I", "SHS", "C"), "section of the posts")
    bases: tuple[Base, ...] = bases(lambda p: p.count + 1)
    rail: str = among(("C", "Z", "U"), "section of the rails")
    face: str = among(("trapezoidal", "sandwich", "plain"), "what it is clad with")
    glazed: bool = chance(0.6, "a pane in the window", when=lambda p: p.face == "plain" and p.count * p.width > 1.4)

    def build(self, t: Table) -> Model:
        w, h, long = self.width, self.height, self.count * self.width
        post, rail = section(self.post, self.size, t.style), section(self.rail, 0.12, t.style)
        y = float(post[0][:, 1].min()) - 0.06
        for k, base in enumerate(self.bases):
            low = base.build(t.at(k * w), 0.25, 0.28)
            t.add("column", bar((k * w, 0, low), (k * w, 0, h), post, (0, 1, 0)))
        rails = [bar((0, y, z), (long, y, z), rail, (0, 1, 0)) for z in (0.3, h / 2, h - 0.15)]
        t.add_each("beam", rails, of="clamp")
        y -= 0.06
        if self.face == "trapezoidal":
            xs = np.linspace(0, long, 2 * max(8, int(long / 0.12)) + 1)
            line = np.column_stack([xs, y - 0.022 - 0.018 * np.where(np.arange(len(xs)) % 4 < 2, 1, -1)])
            t.add("wall", extrude(ribbon(line, 0.001), 0.05, h), of="fence")
        elif self.face == "sandwich":
            n = max(2, int(long / 0.6))
            panel = box((long / n - 0.004, 0.08, h - 0.05), (0, y - 0.04, h / 2))
            t.bundled("wall").add_each("wall", [moved(panel, at((k + 0.5) * long / n)) for k in range(n)], of="fence")
        else:
            hole = rect(0.9, 0.8, long / 2, 0.6 * h)
            t.add("wall", slab_xz(rect(long, h, long / 2, h / 2), 0.1, y - 0.05, (hole,) if long > 1.4 else ()))
            if self.glazed:
                t.add("plate", slab_xz(hole, 0.02, y - 0.05), of="dial")
        return t.model()


class Bund(Structure, name="wall/bund", grain="fitting"):
    """A bund: low walls round a slab with a sump and a kerb or ramp, rectangular, L-shaped or round."""

    form: str = among(("rectangle", "L", "round"), "of its plan")
    length: float = between(1.2, 4.0, "of the bund", "m")
    width: float = between(1.0, 3.0, "of the bund", "m", when=lambda p: p.form != "round")
    height: float = between(0.15, 1.0, "of the walls", "m")
    thick: float = between(0.1, 0.25, "thickness of the walls", "m")
    joined: bool = chance(0.5, "the walls are one mesh", when=lambda p: p.form != "round")
    plated: bool = chance(0.5, "a plate on its front", when=lambda p: p.form != "round")

    def build(self, t: Table) -> Model:
        a, b, h, w, own = self.length, self.width, self.height, self.thick, t.bundled("wall")
        if self.form == "round":
            n = few_sides(t.style, a / 2, 48)
            t.add("wall", ring(a / 2 - w, a / 2, 0, h, n))
            t.add("ground", cylinder(a / 2 + 0.1, -0.15, 0, n), of="concrete")
            return t.model()
        outside, inside = rect(a, b), rect(a - 2 * w, b - 2 * w)
        if self.form == "L":
            outside, inside = (
                np.array(
                    [[d, d], [a - d, d], [a - d, b / 2 - d], [a / 2 - d, b / 2 - d], [a / 2 - d, b - d], [d, b - d]]
                )
                - np.array([a / 2, b / 2])
                for d in (0.0, w)
            )
        if self.joined:
            t.add("wall", extrude(outside, 0, h, (inside,)))
        else:
            sides = zip(outside, np.roll(outside, -1, axis=0), np.roll(inside, -1, axis=0), inside, strict=True)
            own.add_each("wall", [extrude(np.array(side), 0, h) for side in sides])
        t.add("ground", box((a + 0.3, b + 0.3, 0.15), (0, 0, -0.075)), of="concrete")
        if self.plated:
            t.add("plate", box((0.7, 0.06, 0.02), (-a / 4, -b / 2 - 0.03, h - 0.01)))
        return t.model()


class Retaining(Structure, name="wall/retaining"):
    """Concrete walls: L elements, battered, with buttresses, a corner, a pipe opening, a curved stretch."""

    length: float = between(1.0, 3.0, "of the wall", "m")
    height: float = between(0.6, 2.6, "of the wall", "m")
    thick: float = between(0.12, 0.3, "thickness of the wall", "m")
    form: str = among(("L elements", "buttresses", "curved", "corner"), "how it is made")
    foot: float = between(0.4, 0.9, "length of an element's foot / height", when=of_form("L elements"))
    joined: bool = chance(0.5, "wall and buttresses are one mesh", when=of_form("buttresses"))
    bend: float = between(1.0, 3.0, "radius of the curve", "m", when=of_form("curved"))
    closed: bool = chance(0.5, "without an opening for a pipe", when=of_form("corner"))

    def build(self, t: Table) -> Model:
        long, h, w = self.length, self.height, self.thick
        plain = rect(long, h, long / 2, h / 2)
        if self.form == "L elements":
            foot, count = self.foot * h, max(1, int(long))
            shape = np.array([(0, 0), (foot, 0), (foot, w), (w, w), (0.8 * w, h), (0, h)])
            solid = slab_xz(shape, long / count - 0.006)
            t.add_each("wall", [moved(solid, at(0, (k + 0.5) * long / count)) for k in range(count)])
        elif self.form == "buttresses":
            rib = slab_xz([(0, 0), (0.5 * h, 0), (0.05, h), (0, h)], 0.15)
            ribs = [moved(rib, at(x, w / 2) @ spun("z", np.pi / 2)) for x in np.linspace(0.2, long - 0.2, 3)]
            t.bundled("wall").add_each("wall", [slab_xz(plain, w), *ribs], joined=self.joined)
        elif self.form == "curved":
            a = np.linspace(0, min(long / self.bend, 2.5), 13)
            unit = np.column_stack([np.cos(a), np.sin(a)])
            t.add("wall", slab_xy(np.vstack([(self.bend + w) * unit, self.bend * unit[::-1]]), 0, h))
        elif self.closed:
            corner = np.array([[0, 0], [long, 0], [long, w], [w, w], [w, 0.7 * long], [0, 0.7 * long]])
            t.add("wall", slab_xy(corner, 0, h))
        else:
            hole = (circle(0.15, few_sides(t.style, 0.15, 24), (0.5 * long, 0.5 * h)),)
            t.add("wall", slab_xz(plain, w, w / 2, hole))
            t.add("wall", box((w, 0.7 * long - w, h), (w / 2, 0.35 * long + w / 2, h / 2)))
        return t.model()


CIVIL = families_of(Plinth, Footing, RingBase, Strip, Masonry, Clad, Bund, Retaining)
