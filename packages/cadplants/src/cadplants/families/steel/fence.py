"""Fences and gates: palisade, mesh, chain-link, sheet, timber, guards; swing, sliding, boom, turnstile."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, one_of, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.caster import wheel
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
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.primitives import BOTH, along, box, cylinder, dome, ring, rod
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FENCES"]

_JOINED = "in one mesh"


def _whole(t: Table, name: str, solids: Iterable[Solid], joined: bool, of: str) -> None:
    """One mesh, or as many as there are pieces."""
    t.bundled(name).add_each(name, solids, of=of, joined=joined)


class _Post(Params):
    """One of a fence's posts."""

    plated: bool = given(False, "whether it stands on a base plate")
    base: Base = nested(Base, "base plate", when=lambda p: p.plated)
    capped: bool = chance(0.3, "a cap plate")


class Posts(Params):
    """Posts in the ground, on plates or in concrete."""

    count: int = given(2, "posts")
    shapes: tuple[str, ...] = given(("SHS",), "sections that they can have")
    shape: str = among(lambda p: p.shapes, "section")
    size: float = between(0.045, 0.09, "height of the section", "m")
    foot: str = among(("plates", "concrete", "ground"), "what they stand in")
    members: tuple[_Post, ...] = several(
        made(_Post, lambda p: {"plated": p.foot == "plates"}), lambda p: p.count, "post"
    )

    @staticmethod
    def of(*shapes: str) -> Posts:
        """Of a fence, one more than it has bays."""
        return nested(Posts, "of the fence", fixed=lambda p: {"count": p.count + 1, "shapes": shapes})

    def build(self, t: Table, xs: Sequence[float], h: float) -> float:
        """Puts them down at some places along x; half their width [m]."""
        one, own = section(self.shape, self.size, t.style), t.bundled("fence")
        for x, how in zip(xs, self.members, strict=True):
            low = how.base.build(t.at(x), 0.16, 0.16) if how.plated else 0.0
            if self.foot == "concrete":
                t.at(x).add("foundation", cylinder(0.15, -0.3, 0.0, 10))
            own.add("post", bar((x, 0, low), (x, 0, h), one, (0, 1, 0)), of="fence")
            if how.capped:
                own.add("plate", box((0.1, 0.1, 0.01), (x, 0, h + 0.005)), of="fence")
        return max(-float(one[0][:, 0].min()), float(one[0][:, 0].max()))


def _mesh(w: float, low: float, high: float, pitch: tuple[float, float], r: float = 0.0025) -> list[Solid]:
    """Welded wires over x from 0 to ``w`` between two heights; at most some dozens each way."""
    up = np.linspace(0.01, w - 0.01, int(np.clip(w / pitch[0], 4, 36)))
    wires = [box((2 * r, 2 * r, high - low), (x, 0, (low + high) / 2)) for x in up]
    levels = np.linspace(low + 0.02, high - 0.02, int(np.clip((high - low) / pitch[1], 3, 24)))
    return [*wires, *(box((w, 2 * r, 2 * r), (w / 2, 2 * r, z)) for z in levels)]


class Palisade(Structure, name="fence/palisade"):
    """Palisade (BS 1722-12): pressed pales with pointed, notched or round heads on two angle rails between posts."""

    count: int = whole(1, 2, "bays")
    width: float = between(1.5, 2.75, "of a bay", "m")
    height: float = between(1.5, 2.6, "of a pale", "m")
    posts: Posts = Posts.of("I", "H", "SHS")
    head: str = among(("point", "notch", "bevel"), "of a pale")
    joined: tuple[bool, ...] = several(yes(0.65), lambda p: p.count, "whether a bay is one mesh")

    def build(self, t: Table) -> Model:
        w, h, x = self.width, self.height, 0.065 / 2
        half = self.posts.build(t, [k * w for k in range(self.count + 1)], h - 0.1)
        top = {
            "point": [(x, h - 0.08), (0, h), (-x, h - 0.08)],
            "notch": [(x, h), (0, h - 0.06), (-x, h)],
            "bevel": [(x, h - 0.03), (0.01, h), (-0.01, h), (-x, h - 0.03)],
        }[self.head]
        pale, y, rail = slab_xz([(-x, 0.05), (x, 0.05), *top], 0.003), 0.0115 - half, section("L", 0.05, t.style)
        for k, joined in enumerate(self.joined):
            a, b = k * w, (k + 1) * w
            solids = [bar((a, y, z), (b, y, z), rail) for z in (0.3, h - 0.35)]
            solids += [moved(pale, at(x, -0.004 - half)) for x in np.arange(a + 0.1, b - 0.05, 0.15)]
            _whole(t, "fence", solids, joined, "fence")
        return t.model()


class _MeshPanel(Params):
    """A panel of welded mesh."""

    folded: bool = chance(0.6, "with double wires")
    folds: int = whole(2, 4, "double wires", when=lambda p: p.folded)
    joined: bool = chance(0.85, _JOINED)


class WeldedMesh(Structure, name="fence/welded mesh", weight=1.2):
    """Welded mesh panels with single or double wires, clamped to square posts (EN 10223-7)."""

    count: int = whole(1, 3, "panels")
    width: float = between(1.2, 2.5, "of a panel", "m")
    height: float = between(0.8, 2.4, "of a panel", "m")
    posts: Posts = Posts.of("SHS", "RHS", "CHS")
    panels: tuple[_MeshPanel, ...] = several(made(_MeshPanel), lambda p: p.count, "panel")

    def build(self, t: Table) -> Model:
        w, h, xs = self.width, self.height, [k * self.width for k in range(self.count + 1)]
        y = -self.posts.build(t, xs, h + 0.05) - 0.008
        for x, panel in zip(xs, self.panels, strict=False):
            solids = [moved(one, at(x + 0.005, y)) for one in _mesh(w - 0.01, 0.05, h, (0.06, 0.2))]
            levels = np.linspace(0.25, h - 0.2, panel.folds)
            solids += [box((w - 0.02, 0.006, 0.006), (x + w / 2, y - 0.005, z)) for z in levels]
            _whole(t, "fence", solids, panel.joined, "fence")
        for x in xs:
            t.add_each("clamp", [box((0.05, 0.02, 0.03), (x, y, z)) for z in (0.25, h - 0.2)], of="trim")
        return t.model()


class ChainLink(Structure, name="fence/chain link"):
    """Chain-link on round posts with line wires, raking stays and arms with barbed wire (BS 1722-1)."""

    count: int = whole(1, 2, "bays")
    width: float = between(1.5, 2.5, "of a bay", "m")
    height: float = between(1.2, 2.4, "of the mesh", "m")
    pitch: float = between(0.12, 0.2, "from strand to strand", "m")
    posts: Posts = Posts.of("CHS", "L", "SHS")
    stayed: bool = chance(0.6, "raking stays at its ends")
    barbed: bool = chance(0.5, "arms with barbed wire")

    def build(self, t: Table) -> Model:
        w, h, xs, own = self.width, self.height, [k * self.width for k in range(self.count + 1)], t.bundled("fence")
        half, long, strands = self.posts.build(t, xs, h + 0.1), self.count * w, []
        y = -half - 0.002
        for way in BOTH:
            for c in np.arange(-h, long + h, self.pitch):
                lo, hi = (max(0.0, c), min(long, c + h)) if way > 0 else (max(0.0, c - h), min(long, c))
                if hi - lo > 0.05:
                    a, b = ((x, 0.04 + way * (x - c)) for x in (lo, hi))
                    strands.append(rod((a[0], y, a[1]), (b[0], y + 0.003 * way, b[1]), 0.002, 4))
        own.add("fence", *strands, *(rod((0, y, z), (long, y, z), 0.003, 5) for z in (0.06, h / 2, h)))
        for x, s in ((0.0, 1), (long, -1)) if self.stayed else ():
            stay = pipe([(x + s * half, 0, 0.75 * h), (x + s * 0.6 * h, 0, 0)], 0.019, t.style)
            own.add("brace", stay, of="fence")
        if self.barbed:
            lines = [(-0.12 * k, h + 0.1 + 0.1 * k) for k in (1, 2, 3)]
            own.add("fence", *(rod((0, y, z), (long, y, z), 0.003, 5) for y, z in lines))
            own.add_each("post", [rod((x, 0, h + 0.06), (x, -0.37, h + 0.41), 0.018, 8) for x in xs], of="fence")
        return t.model()


_SCREEN_POSTS = {"precast": ("H",), "upright": ("timber", "SHS"), "level": ("timber", "H")}


class Screen(Structure, name="fence/screen"):
    """A screen of trapezoidal sheet, boards, slats or precast planks between posts."""

    count: int = whole(1, 3, "bays")
    width: float = between(1.2, 2.4, "of a bay", "m")
    height: float = between(1.0, 2.4, "of the screen", "m")
    fill: str = among(
        ("trapeze", "upright", "level", "louvre", "precast"),
        "trapezoidal sheet, upright boards, level boards, slats or precast planks",
    )
    posts: Posts = nested(
        Posts,
        "of the screen",
        fixed=lambda p: {"count": p.count + 1, "shapes": _SCREEN_POSTS.get(p.fill, ("SHS", "H", "U"))},
    )
    joined: tuple[bool, ...] = several(yes(0.65), lambda p: p.count, "whether a bay is one mesh")

    def build(self, t: Table) -> Model:
        w = self.width
        half = self.posts.build(t, [k * w for k in range(self.count + 1)], self.height + 0.05)
        of = {"precast": "concrete", "upright": "safety", "level": "safety"}.get(self.fill, "fence")
        for k, joined in enumerate(self.joined):
            _whole(t, "fence", self._bay(k * w, (k + 1) * w, half), joined, of)
        return t.model()

    def _bay(self, a: float, b: float, half: float) -> list[Solid]:
        """What is between two posts."""
        w, h, x = self.width, self.height, (a + b) / 2
        if self.fill == "trapeze":
            xs = np.arange(a, b + 0.001, w / max(6, int(w / 0.06)))
            line = np.column_stack([xs, -half - 0.02 - 0.035 * ((np.arange(len(xs)) // 2) % 2)])
            rails = [box((w, 0.03, 0.04), (x, -half - 0.003, z)) for z in (0.3, h - 0.2)]
            return [extrude(ribbon(line, 0.0015), 0.05, h), *rails]
        if self.fill == "upright":
            boards = [
                box((0.1, 0.022, h - 0.1), (x_, -half - 0.041, h / 2)) for x_ in np.arange(a + 0.06, b - 0.03, 0.12)
            ]
            return boards + [box((w, 0.05, 0.08), (x, -half - 0.01, z)) for z in (0.3, h - 0.3)]
        if self.fill == "level":
            return [box((w, 0.03, 0.14), (x, -half - 0.015, z)) for z in np.arange(0.15, h, 0.16)]
        if self.fill == "louvre":
            blade = box((w - 2 * half, 0.09, 0.003))
            return [moved(blade, at(x, 0, z) @ spun("x", 0.7)) for z in np.arange(0.12, h, 0.09)]
        return [box((w - 0.02, 0.04, 0.3), (x, 0, z + 0.15)) for z in np.arange(0.0, h - 0.25, 0.301)]


class Guard(Structure, name="fence/guard", weight=1.2, grain="fitting"):
    """A machine guard (EN ISO 14120): framed panels of mesh, sheet or clear plate off the floor, maybe with a door."""

    count: int = whole(1, 4, "panels")
    height: float = between(1.2, 2.2, "of a panel's top", "m")
    low: float = between(0.1, 0.2, "height of a panel's underside", "m")
    widths: tuple[float, ...] = several(number(0.5, 1.5), lambda p: p.count, "of a panel", "m")
    posts: Posts = Posts.of("SHS", "RHS")
    tube: str = among(("SHS", "L", "CHS"), "section of a panel's frame")
    fill: str = among(("mesh", "mesh", "sheet", "clear"), "of a panel")
    doored: bool = chance(0.5, "one of the panels is a door")
    door: int = among(lambda p: range(p.count), "which one, from 0", when=lambda p: p.doored, otherwise=-1)
    joined: tuple[bool, ...] = several(yes(0.85), lambda p: p.count, "whether a panel is one mesh")

    def build(self, t: Table) -> Model:
        h, low, tube = self.height, self.low, section(self.tube, 0.025, t.style)
        xs = [0.0, *(float(x) for x in np.cumsum(self.widths))]
        half = self.posts.build(t, xs, h)
        for k, w in enumerate(self.widths):
            a, b = xs[k] + half, xs[k + 1] - half
            solids = [bar((a, 0, z), (b, 0, z), tube) for z in (low, h - 0.03)]
            solids += [bar((x, 0, low), (x, 0, h - 0.03), tube, (0, 1, 0)) for x in (a + 0.013, b - 0.013)]
            if self.fill == "mesh":
                solids += [moved(one, at(a)) for one in _mesh(w - 2 * half, low, h - 0.03, (0.05, 0.1), 0.0015)]
            else:
                thick = 0.002 if self.fill == "sheet" else 0.006
                solids.append(box((b - a, thick, h - low - 0.03), ((a + b) / 2, 0, (h + low) / 2)))
            of = "dial" if self.fill == "clear" else "safety"
            _whole(t, "gate" if k == self.door else "fence", solids, self.joined[k], of)
            if k == self.door:
                t.add("bracket", box((0.03, 0.06, 0.12), (b - 0.02, -0.04, 1.0)), of="handle")
                hinge = cylinder(0.012, 0, 0.07, 8)
                t.add_each("bracket", [moved(hinge, at(a, -0.03, z)) for z in (low + 0.2, h - 0.3)])
        return t.model()


class _Hurdle(Params):
    """A movable barrier."""

    site: bool = given(False, "whether it stands in feet")
    joined: bool = chance(0.9, _JOINED)
    feet: tuple[str, ...] = several(
        one_of("base plate", "foundation"), 2, "what a foot is called", when=lambda p: p.site
    )


class Movable(Structure, name="fence/movable", weight=0.8, grain="fitting"):
    """Movable barriers: crowd control hoops with bars, or site fence panels in rubber or concrete feet."""

    site: bool = chance(0.5, "site fence panels, not hoops")
    count: int = whole(1, 3, "barriers")
    width: float = between(lambda p: 2.0 if p.site else 1.5, lambda p: 3.0 if p.site else 2.3, "of a barrier", "m")
    height: float = between(1.8, 2.1, "of a panel", "m", when=lambda p: p.site, otherwise=1.1)
    radius: float = between(0.014, 0.021, "of its tubes", "m")
    barriers: tuple[_Hurdle, ...] = several(made(_Hurdle, lambda p: {"site": p.site}), lambda p: p.count, "barrier")

    def build(self, t: Table) -> Model:
        site, w, h, r = self.site, self.width, self.height, self.radius
        low = 0.1 if site else 0.18
        foot = 0.02 if site else low
        solids = [pipe([(0, 0, foot), (0, 0, h), (w, 0, h), (w, 0, foot)], r, t.style, 0.0 if site else 0.15)]
        solids.append(pipe([(0, 0, low), (w, 0, low)], r, t.style))
        if site:
            solids += _mesh(w, low, h, (0.1, 0.25))
        else:
            solids += [rod((x, 0, low), (x, 0, h), 0.006, 6) for x in np.arange(0.12, w - 0.05, 0.12)]
            bow = ((-0.25, 0.01), (-0.2, 0.1), (0, low), (0.2, 0.1), (0.25, 0.01))
            solids += [pipe([(x, y, z) for y, z in bow], 0.012, t.style) for x in (0.3, w - 0.3)]
        for k, how in enumerate(self.barriers):
            here = t.at(k * (w + 0.06))
            _whole(here, "fence", solids, how.joined, "fence")
            for x, name in zip((0, w), how.feet, strict=False):
                here.add(name, box((0.25, 0.6, 0.12), (x, 0, 0.06)), of="rubber")
        return t.model()


# --- gates ---


class Leaf(Params):
    """A framed leaf along x: tubes or angles, filled with bars, mesh, sheet, slats or a diagonal."""

    frame: str = among(("SHS", "CHS", "RHS", "L"), "section of its frame")
    size: float = between(0.035, 0.06, "height of that section", "m")
    fill: str = among(("bars", "mesh", "sheet", "tubes", "diagonal"), "what it is filled with")

    def solids(self, a: float, b: float, low: float, high: float, style: ModelingStyle) -> list[Solid]:
        """The leaf between two x and two heights [m]."""
        w, h, one, fill = b - a, high - low, section(self.frame, self.size, style), self.fill
        solids = [bar((a, 0, z), (b, 0, z), one) for z in (low, high)]
        solids += [bar((x, 0, low), (x, 0, high), one, (0, 1, 0)) for x in (a, b)]
        thin = section("CHS", 0.03, style)
        if fill == "bars":
            solids += [rod((x, 0, low), (x, 0, high), 0.008, 6) for x in np.arange(a + 0.12, b - 0.05, 0.12)]
        elif fill == "mesh":
            solids += [moved(m, at(a)) for m in _mesh(w, low, high, (0.06, 0.15))]
        elif fill == "sheet":
            solids.append(box((w, 0.003, h), ((a + b) / 2, 0.01, (low + high) / 2)))
        elif fill == "tubes":
            solids += [bar((a, 0, z), (b, 0, z), thin) for z in np.linspace(low, high, 6)[1:-1]]
        if fill not in ("bars", "sheet"):
            solids.append(bar((a, 0, low), (b, 0, high), section("flat", 0.03, style) if fill == "mesh" else thin))
        return solids


class _Swung(Params):
    """A leaf of a swing gate."""

    opened: bool = among((False, False, True), "it stands open")
    angle: float = between(0.2, 1.5, "how far it stands open", "rad", when=lambda p: p.opened)
    leaf: Leaf = nested(Leaf, "leaf")
    joined: bool = chance(0.65, _JOINED)
    latched: bool = chance(0.6, "with a latch")
    dropped: bool = chance(0.4, "with a drop bolt")


class Swing(Structure, name="gate/swing", weight=1.3, grain="fitting"):
    """A swing gate of one or two leaves, open or shut, with stout posts, hinges, drop bolt and latch."""

    count: int = whole(1, 2, "leaves")
    width: float = between(0.8, 2.0, "of a leaf", "m")
    height: float = between(0.9, 2.2, "of a leaf's top", "m")
    low: float = between(0.04, 0.12, "height of a leaf's underside", "m")
    posts: Posts = nested(Posts, "of the gate", fixed=lambda _: {"shapes": ("SHS", "SHS", "H", "CHS")})
    leaves: tuple[_Swung, ...] = several(made(_Swung), lambda p: p.count, "leaf")

    def build(self, t: Table) -> Model:
        w, h, low = self.width, self.height, self.low
        total = self.count * w + 0.02 * (self.count - 1)
        half = self.posts.build(t, [0.0, total + 0.18], h + 0.1)
        levels = (low + 0.2, h - 0.25)
        pins = [moved(cylinder(0.012, -0.05, 0.07, 8), at(0.02, 0, z)) for z in levels]
        pins += [box((0.06, 0.012, 0.03), (0.02, 0, z)) for z in levels]
        for k, one in enumerate(self.leaves):
            here = t.at(half - 0.01) if k == 0 else t.at(total + 0.18 - half + 0.01).moved(np.diag([-1.0, 1, 1, 1]))
            here = here.spun("z", one.angle)
            _whole(here, "gate", one.leaf.solids(0.06, w, low, h, t.style), one.joined, "gate")
            here.add("bracket", *pins)
            if one.latched:
                z = 1.0 if h > 1.2 else 0.6 * h
                here.add("bracket", box((0.12, 0.05, 0.16), (w - 0.05, 0, z)), of="handle")
            if one.dropped:
                here.add("bolt", rod((w - 0.04, -0.04, 0.0), (w - 0.04, -0.04, 0.5), 0.008, 6), fine=False)
        return t.model()


class Sliding(Structure, name="gate/sliding", grain="fitting"):
    """A sliding gate: a leaf on grooved wheels and a floor rail, or cantilevered on roller boxes, with guide portal."""

    width: float = between(1.8, 4.0, "of the leaf", "m")
    height: float = between(1.0, 2.0, "of the leaf's top", "m")
    radius: float = between(0.04, 0.07, "of a wheel", "m")
    leaf: Leaf = nested(Leaf, "leaf")
    joined: bool = chance(0.65, _JOINED)
    wheeled: bool = chance(0.6, "on wheels, not cantilevered")

    def build(self, t: Table) -> Model:
        w, h, r, style = self.width, self.height, self.radius, t.style
        low = 1.9 * r + 0.03
        _whole(t, "gate", self.leaf.solids(0, w, low + 0.03, h, style), self.joined, "gate")
        if self.wheeled:
            t.add("beam", bar((-0.5, 0, 0.01), (w + 0.8 * w, 0, 0.01), section("CHS", 0.02, style)))
            for x in (0.15, w - 0.15):
                for solid, of in wheel("groove", r, 0.6 * r, style):
                    t.at(x, 0, 0.02 + 0.78 * r).add("caster", solid, of=of)
                fork = box((1.6 * r, 0.5 * r + 0.02, 0.3 * r + 0.04), (x, 0, low + 0.01 - 0.15 * r))
                t.add("bracket", fork)
        else:
            tail = bar((-0.3 * w, 0, low - 0.02), (w, 0, low - 0.02), section("RHS", 0.08, style))
            t.bundled("gate").add("gate", tail)
            tall = low - 0.06
            t.add_each("foundation", [box((0.3, 0.16, tall), (x, 0, tall / 2)) for x in (-0.25 * w, 0.2)])
        post = section("SHS", 0.08, style)
        for s in BOTH:
            t.add("post", bar((0.3, s * 0.14, 0), (0.3, s * 0.14, h + 0.12), post), of="fence")
            t.at(0.3, s * 0.065).add("caster", cylinder(0.03, h - 0.05, h + 0.12, 12))
        t.add("beam", box((0.08, 0.36, 0.08), (0.3, 0, h + 0.16)), of="fence")
        t.add("post", bar((w + 0.09, 0, 0), (w + 0.09, 0, h + 0.1), section("SHS", 0.12, style)), of="fence")
        return t.model()


class Boom(Structure, name="gate/boom", weight=0.8, grain="fitting"):
    """A boom barrier: a housing on a plinth, an arm with or without skirt, a fork post to rest on; up or down."""

    length: float = between(2.0, 4.5, "of the arm", "m")
    height: float = between(0.85, 1.05, "of the arm", "m")
    lifted: bool = among((False, False, True), "the arm is up")
    angle: float = between(0.3, 1.4, "how far the arm is up", "rad", when=lambda p: p.lifted)
    housing: str = among(("control panel", "post"), "what the housing is called")
    arm: str = among(("CHS", "RHS", "SHS"), "section of the arm")
    skirted: bool = chance(0.4, "a skirt of bars below the arm")
    weighted: bool = chance(0.4, "a counterweight")
    joined: bool = chance(0.65, _JOINED)

    def build(self, t: Table) -> Model:
        long, h = self.length, self.height
        t.add("foundation", box((0.45, 0.45, 0.1), (0, 0, 0.05)))
        t.add(self.housing, box((0.32, 0.28, h + 0.1), (0, 0, 0.1 + (h + 0.1) / 2)), of="safety")
        solids = [bar((-0.3, 0, 0), (long, 0, 0), section(self.arm, 0.08, t.style))]
        solids.append(along("y", cylinder(0.1, -0.04, 0.04, few_sides(t.style, 0.1))))
        if self.skirted:
            solids += [rod((x, 0, -0.03), (x, 0, -0.6), 0.006, 6) for x in np.arange(0.3, long, 0.15)]
            solids.append(rod((0.3, 0, -0.6), (long - 0.05, 0, -0.6), 0.008, 6))
        if self.weighted:
            solids.append(box((0.2, 0.12, 0.2), (-0.35, 0, 0)))
        _whole(t.at(0.05, -0.18, h).spun("y", -self.angle), "gate", solids, self.joined, "gate")
        if not self.lifted:
            tall = h - 0.045
            t.add("post", box((0.08, 0.08, tall), (long - 0.1, -0.18, tall / 2)), of="safety")
        return t.model()


def _tall(p: Any) -> bool:
    return bool(p.tall)


class Turnstile(Structure, name="gate/turnstile", weight=0.7, grain="fitting"):
    """A turnstile: full height with combs in a cage, waist high with three arms, or a kissing gate of tubes."""

    tall: bool = chance(0.6, "of full height, not waist high")
    height: float = between(1.9, 2.3, "of a tall one", "m", when=_tall)
    radius: float = between(0.55, 0.7, "of the combs", "m", when=_tall)
    wings: int = whole(3, 4, "combs", when=_tall)
    cabinet: str = among(("post", "gate"), "what the cabinet is called", when=lambda p: not p.tall)
    joined: bool = chance(0.65, "what turns is one mesh")
    caged: bool = chance(0.65, "the cage is one mesh", when=_tall)

    def build(self, t: Table) -> Model:
        if self.tall:
            return self._full(t)
        t.add(self.cabinet, box((0.25, 0.9, 0.98), (0, 0, 0.49)), of="clamp")
        solids = [along("x", dome(0.08, 0.06, 0.0, few_sides(t.style, 0.08, 16)), 0.125, 0, 0.85)]
        ends = [(0.25, 0.5 * np.cos(a), 0.85 + 0.45 * np.sin(a)) for a in (np.pi / 2 + 2.094, np.pi / 2 + 4.189)]
        solids += [pipe([(0.15, 0, 0.85), end], 0.019, t.style) for end in (*ends, (0.65, 0, 0.87))]
        _whole(t, "gate", solids, self.joined, "trim")
        t.add("fence", box((0.04, 0.9, 0.98), (0.8, 0, 0.49)), of="clamp")
        return t.model()

    def _full(self, t: Table) -> Model:
        h, r = self.height, self.radius
        bars = [rod((0.04, 0, z), (r, 0, z), 0.018, 8) for z in np.linspace(0.25, h - 0.2, 9)]
        turns = [spun("z", 2 * np.pi * k / self.wings) for k in range(self.wings)]
        combs = [moved(one, turn) for turn in turns for one in bars]
        _whole(t, "gate", [cylinder(0.05, 0.0, h, few_sides(t.style, 0.05, 14)), *combs], self.joined, "gate")
        spots = [(1.06 * r * float(np.cos(a)), 1.06 * r * float(np.sin(a))) for a in np.linspace(0.5, 2.6, 9)]
        _whole(t, "fence", [rod((x, y, 0), (x, y, h), 0.014, 8) for x, y in spots], self.caged, "fence")
        roof = [(-1.1 * r, -0.2), (1.1 * r, -0.2), (1.1 * r, 1.15 * r), (-1.1 * r, 1.15 * r)]
        t.add("plate", slab_xy(roof, h, h + 0.08), of="fence")
        t.add_each("post", [box((0.08, 0.08, h), (s * 1.05 * r, -0.15, h / 2)) for s in BOTH], of="fence")
        return t.model()


class RailingGate(Structure, name="gate/railing", grain="fitting"):
    """A self-closing gate in a railing (ISO 14122-3): a bow of tube or a framed leaf on spring hinges between posts."""

    width: float = between(0.6, 1.1, "of the gate", "m")
    height: float = between(0.95, 1.1, "of the railing", "m")
    left: float = between(0.5, 1.2, "length of railing before the hinges", "m")
    right: float = between(0.5, 1.2, "length of railing beyond the gate", "m")
    bases: tuple[Base, ...] = bases(4)
    sheeted: bool = chance(0.3, "a sheet in the gate")
    opened: bool = among((False, True), "it stands open")
    angle: float = between(0.3, 1.4, "how far it stands open", "rad", when=lambda p: p.opened)
    joined: bool = chance(0.65, _JOINED)

    def build(self, t: Table) -> Model:
        w, h, r, style = self.width, self.height, 0.021, t.style
        xs = [-self.left, 0.0, w + 0.08, w + 0.08 + self.right]
        for x, base in zip(xs, self.bases, strict=True):
            low = base.build(t.at(x), 0.1, 0.1)
            t.add("post", pipe([(x, 0, low), (x, 0, h)], r, style), of="safety")
        for a, b in (xs[:2], xs[2:]):
            t.add_each("railing", [pipe([(a, 0, z), (b, 0, z)], r, style) for z in (0.5 * h, h)])
        bow = [(0.07, 0, h - 0.02), (w, 0, h - 0.02), (w, 0, 0.45 * h), (0.07, 0, 0.45 * h), (0.07, 0, h - 0.036)]
        solids = [pipe(bow, 0.016, style), pipe([(0.07, 0, 0.7 * h), (w, 0, 0.7 * h)], 0.012, style)]
        if self.sheeted:
            solids.append(box((w - 0.1, 0.004, 0.4 * h), (w / 2 + 0.03, 0, 0.7 * h)))
        pose = spun("z", self.angle)
        _whole(t.moved(pose), "gate", solids, self.joined, "gate")
        for z in (0.5 * h, h - 0.06):
            lug = moved(box((0.06, 0.012, 0.05), (0.05, 0, z)), pose)
            t.add("bracket", merge([ring(r, 1.5 * r, z - 0.03, z + 0.03, 12), lug]), of="clamp")
        bolts(t, [at(w + 0.08 - r - 0.001, -0.012, 0.7 * h) @ spun("y", -np.pi / 2)], 0.008, 0.005)
        return t.model()


FENCES = families_of(
    Palisade, WeldedMesh, ChainLink, Screen, Guard, Movable, Swing, Sliding, Boom, Turnstile, RailingGate
)
