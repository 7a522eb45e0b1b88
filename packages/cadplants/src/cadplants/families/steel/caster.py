"""Casters and wheels, with the frames, carts and rails that they roll under and on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, yes
from cadplants.builder.params import Params, Source, When, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.steel.shape import (
    Structure,
    bar,
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
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, along, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["CASTERS", "Casters", "wheel"]

Rng = np.random.Generator
Colored = tuple[Solid, str]


def _mirrored(*numbers: float) -> list[tuple[float, float]]:
    half = outline(*numbers)
    return [*half, *((r, -y) for r, y in reversed(half))]


# Outlines of wheels and of their cores as radius / the wheel's and place along the axle / half the wheel's width.
_WHEELS = {
    "plain": outline(0.92, -1, 1, -0.7, 1, 0.7, 0.92, 1),
    "solid": _mirrored(0.3, -1.15, 0.3, -0.6, 0.68, -0.5, 0.7, -1, 0.95, -1, 1, -0.6),
    "tread": _mirrored(0.3, -1.15, 0.34, -0.7, 0.76, -0.8),
    "tyre": _mirrored(0.2, -1.2, 0.2, -0.3, 0.5, -0.25, 0.56, -0.75, 0.6, -0.75),
    "groove": _mirrored(0.4, -1.1, 0.4, -1, 1, -1, 1, -0.7, 0.75, -0.05),
    "flanged": outline(0.4, -1.2, 0.4, -1, 1, -1, 1, -0.6, 0.85, -0.5, 0.82, 1, 0.4, 1),
}


def wheel(kind: str, r: float, w: float, style: ModelingStyle) -> list[Colored]:
    """A wheel about the y axis: of one piece, with a tread, spoked, with a tyre on a rim, with a groove or flange."""
    n, h = few_sides(style, r, 28), w / 2
    if kind == "spoked":
        spoke = box((0.65 * r, 0.12 * r, 0.7 * h), (0.53 * r, 0, 0))
        spokes = [moved(spoke, spun("z", a)) for a in np.arange(5) * 2 * np.pi / 5]
        rim = [ring(0.82 * r, r, -h, h, n), cylinder(0.25 * r, -1.1 * h, 1.1 * h, max(8, n // 2))]
        made = [(merge([*rim, *spokes]), "trim")]
    else:
        of = {"plain": "rubber", "tyre": "clamp"}.get(kind, "trim")
        made = [(turned([(x * r, y * h) for x, y in _WHEELS[kind]], n), of)]
    if kind == "tread":
        made.append((ring(0.76 * r, r, -h, h, n), "rubber"))
    if kind == "tyre":
        a = np.linspace(-np.pi * 0.8, np.pi * 0.8, 9)[1:-1]
        tyre = [(0.8 * r + 0.2 * r * float(np.cos(t)), h * float(np.sin(t))) for t in a]
        made.append((turned([(0.6 * r, -0.55 * h), *tyre, (0.6 * r, 0.55 * h)], n), "rubber"))
    return [(along("y", one), color) for one, color in made]


def _plate(a: float, b: float, thick: float, style: ModelingStyle) -> Solid:
    """A mounting plate under z = 0 with four slots or holes."""
    holes = tuple(circle(0.055 * b, 8, (sx * 0.38 * a, sy * 0.36 * b)) for sx in (-1, 1) for sy in (-1, 1))
    return slab_xy(rounded_rectangle(a, b, 0.1 * b, 2), -thick, 0.0, holes if style.holes else ())


def _sheet_fork(r: float, w: float, trail: float, high: float, t: float) -> Solid:
    """The two cheeks of a swivel fork and their crown, from z = -0.2 r down to the axle."""
    z, top, g = -high + r, -0.3 * r, w / 2 + 0.1 * w
    cheek = [(trail + 0.22 * r, z), (trail + 0.15 * r, z + 0.2 * r), (0.5 * r, top), (-0.5 * r, top)]
    cheek += [(trail - 0.22 * r, z), (trail - 0.12 * r, z - 0.18 * r), (trail + 0.12 * r, z - 0.18 * r)]
    sides = [slab_xz(np.array(cheek), t, s * (g + t / 2)) for s in (-1, 1)]
    return merge([*sides, box((r, 2 * g + 2 * t, t), (0, 0, top + t / 2))])


def _axle(r: float, w: float, trail: float, high: float, style: ModelingStyle) -> Solid:
    reach, d = 0.6 * w + 0.12 * r, 0.1 * r
    n = few_sides(style, d, 10)
    pin = merge([cylinder(d, -reach, reach, n), hexagon(3.4 * d, reach - 0.02 * r, reach + 0.1 * r)])
    return along("y", pin, trail, 0, -high + r)


def _brake(r: float, w: float, high: float) -> Solid:
    """A pedal behind the fork, bent down over the wheel."""
    z = -high + 1.95 * r
    line = [(-0.2 * r, z + 0.02 * r), (-0.75 * r, z + 0.05 * r), (-1.15 * r, z - 0.35 * r)]
    return slab_xz(ribbon(line[::-1], 0.05 * r), 1.22 * w)


def _extruded(outline: Floats, long: float) -> Solid:
    """A prism about z = 0 whose outline's x and y come to lie along y and z once it lies along x."""
    turn = np.column_stack([-outline[:, 1], outline[:, 0]])
    return slab_xy(turn, -long / 2, long / 2)


class Caster(Params):
    """A caster that hangs from z = 0 (EN 12532, EN 12533)."""

    make: str = given("swivel", "swivel, braked, fixed, heavy, stem, twin or levelling")
    wide: float = between(0.45, 0.8, "width of its wheel / radius", when=lambda p: p.make != "twin")
    trail: float = between(
        0.3, 0.7, "from the axis that it swivels about to the wheel's / radius", when=lambda p: p.make != "fixed"
    )
    high: float = between(2.45, 2.9, "height / radius of its wheel")
    wheel: str = among(
        lambda p: ("solid", "spoked", "tread") if p.make == "heavy" else ("solid", "tread", "plain", "tread"),
        "how its wheel is made",
        when=lambda p: p.make != "twin",
    )
    joined: bool = chance(0.45, "in one mesh")

    def build(self, t: Table, r: float, make: str) -> None:
        """Puts it down, its wheel of a radius [m], of a make that is drawn like its own."""
        w, high, trail, twin = self.wide * r, self.high * r, self.trail * r, make == "twin"
        metal, rest = self._frame(t.style, r, make)
        for y, wide in [(-0.42 * r, 0.6 * r), (0.42 * r, 0.6 * r)] if twin else [(0.0, w)]:
            made = wheel("plain" if twin else self.wheel, r, wide, t.style)
            rest += [(moved(one, at(trail, y, -high + r)), of) for one, of in made]
        axle = _axle(r, 1.4 * r if twin else w, trail, high, t.style)
        if self.joined:
            t.add("caster", *metal, *(one for one, _ in rest), axle, of="clamp")
            return
        t.add("caster", *metal, of="clamp")
        for one, of in rest:
            t.add("caster", one, of=of)
        t.add("bolt", axle)

    def _frame(self, style: ModelingStyle, r: float, make: str) -> tuple[list[Solid], list[Colored]]:
        """Its fork, what that hangs on, and what else is on it."""
        w, t, high, n = self.wide * r, 0.06 * r, self.high * r, few_sides(style, 0.6 * r)
        if make == "twin":
            core = box((0.3 * r, 0.2 * r, 1.4 * r), (0.1 * r, 0, -high + 1.5 * r))
            return [core, cylinder(0.3 * r, -high + 2.05 * r, 0.0, n), cylinder(0.15 * r, 0.0, 0.7 * r, 6)], []
        if make == "fixed":
            g = w / 2 + 0.1 * w + t / 2
            line = [(-g, -high + 0.82 * r), (-g, -t / 2), (g, -t / 2), (g, -high + 0.82 * r)]
            bow = along("x", _extruded(ribbon(line, t), 0.7 * r), 0, 0, -t)
            return [_plate(2.1 * r, 1.7 * r, t, style), bow], []
        fork = _sheet_fork(r, w, self.trail * r, high, 2 * t if make == "heavy" else t)
        if make == "heavy":
            ribs = [box((0.1 * r, w * 1.2 + 4 * t, 0.25 * r), (s * 0.35 * r, 0, -0.42 * r)) for s in BOTH]
            return [_plate(2.4 * r, 2.0 * r, 2 * t, style), fork, cylinder(0.7 * r, -0.3 * r, -2 * t, n), *ribs], []
        if make == "stem":
            stem = outline(0.34 * r, -0.1 * r, 0.34 * r, 0.0, 0.17 * r, 0.0, 0.17 * r, 0.7 * r)
            return [fork, cylinder(0.3 * r, -0.3 * r, -0.1 * r, n), turned(stem, max(6, n // 2))], []
        head = outline(0.5 * r, -0.3 * r, 0.62 * r, -0.2 * r, 0.62 * r, -0.12 * r, 0.4 * r, -t)
        metal = [_plate(2.1 * r, 1.7 * r, t, style), fork, turned(head, n)]
        if make == "braked":
            return metal, [(_brake(r, w, high), "handle")]
        if make == "levelling":
            foot = outline(0.5 * r, -high, 0.5 * r, -high + 0.15 * r, 0.16 * r, -high + 0.25 * r, 0.16 * r, -t)
            metal.append(box((1.0 * r, 0.8 * r, 0.12 * r), (-0.9 * r, 0, -t - 0.06 * r)))
            return metal, [(moved(turned(foot, n), at(-1.2 * r)), "safety")]
        return metal, []


class _Turn(Params):
    """How a caster is turned and held."""

    swivels: bool = given(True, "whether it swivels")
    plated: bool = given(True, "whether it has a plate")
    turn: float = between(0, 6.28, "which way it points", "rad", when=lambda p: p.swivels)
    bolted: bool = chance(0.5, "with bolts", when=lambda p: p.plated)


def _turns(fixed: bool) -> Callable[[Rng, Any], _Turn]:
    return made(_Turn, lambda p: {"swivels": not fixed, "plated": p.makes[0] not in ("stem", "twin")})


def _alike(_: Source, p: Any) -> Rng:
    """Each is made from the same draws, so that the wheels of one cart are alike."""
    return np.random.default_rng(p.seed)


def _fixed(p: Any) -> int:
    """How many of the casters don't swivel; these are first."""
    return sum(p.makes[k % len(p.makes)] == "fixed" for k in range(p.count))


class Casters(Params):
    """Casters of one make, some of which may not swivel, under some points."""

    makes: tuple[str, ...] = given(("swivel",), "makes, one after the other and again")
    count: int = given(4, "casters")
    seed: int = whole(0, (1 << 30) - 1, "number that all of them are drawn from, which makes them alike")
    fixed: Caster = nested(
        Caster,
        "one that doesn't swivel",
        fixed=lambda p: {"make": p.makes[0]},
        stream=_alike,
        when=lambda p: _fixed(p) > 0,
    )
    swivel: Caster = nested(
        Caster,
        "one that swivels",
        fixed=lambda p: {"make": p.makes[-1]},
        stream=_alike,
        when=lambda p: _fixed(p) < p.count,
    )
    still: tuple[_Turn, ...] = several(_turns(True), _fixed, "how those that don't swivel are held")
    turned: tuple[_Turn, ...] = several(_turns(False), lambda p: p.count - _fixed(p), "how the others are")

    @classmethod
    def of(cls, *makes: str, count: int = 4, when: When | None = None) -> Casters:
        """The field of casters of these makes."""
        return nested(cls, "casters", fixed=lambda _: {"makes": makes, "count": count}, when=when)

    def height(self, r: float) -> float:
        """Of what they carry, with wheels of a radius [m]."""
        return (self.fixed if self.makes[0] == "fixed" else self.swivel).high * r

    def build(self, t: Table, spots: Sequence[tuple[float, float]], r: float) -> float:
        """Puts them down under some points, with wheels of a radius; the height of what they carry [m]."""
        high = self.height(r)
        for k, ((x, y), how) in enumerate(zip(spots, (*self.still, *self.turned), strict=True)):
            make, here = self.makes[k % len(self.makes)], t.at(x, y, high).spun("z", how.turn)
            (self.fixed if make == "fixed" else self.swivel).build(here, r, make)
            if how.bolted:
                down = spun("x", np.pi)  # from below, through the caster's plate into what it carries
                bolts(here, [at(sx * 0.8 * r, sy * 0.6 * r, -0.06 * r) @ down for sx, sy in CORNERS], 0.1 * r, 0.006)
        return high


class _Dolly(Structure, grain="fitting"):
    """A low dolly or a corner of a frame on plate casters: plate, tube or angle frame, maybe loaded."""

    radius: float = between(0.03, 0.1, "of a wheel", "m")
    length: float = between(0.4, 1.2, "of its deck, but for 4 radii of a wheel", "m")
    width: float = between(0.35, 0.8, "of its deck, but for 3 radii of a wheel", "m")
    casters: Casters = Casters.of()
    deck: str = among(("plate", "frame", "pan"), "what it carries things on")
    corner: float = between(0, 0.06, "radius of a plate's corners", "m", when=lambda p: p.deck == "plate")
    plate: str = among(("plate", "skid frame"), "what a plate is called", when=lambda p: p.deck == "plate")
    tube: str = among(("SHS", "U"), "section of a frame", when=lambda p: p.deck == "frame")

    def build(self, t: Table) -> Model:
        r, a, b = self.radius, self.length + 4 * self.radius, self.width + 3 * self.radius
        x, y = a / 2 - 1.3 * r, b / 2 - 1.2 * r
        z = self.casters.build(t, [(sx * x, sy * y) for sx, sy in CORNERS], r)
        if self.deck == "plate":
            t.add(self.plate, slab_xy(rounded_rectangle(a, b, self.corner, 3), z, z + 0.01))
        elif self.deck == "frame":
            one, h = section(self.tube, 2.0 * r, t.style), z + r
            t.add_each("skid frame", [bar((-a / 2, s * y, h), (a / 2, s * y, h), one) for s in BOTH])
            t.add_each("skid frame", [bar((s * 0.4 * a, -y, h), (s * 0.4 * a, y, h), one) for s in BOTH])
        else:
            pan = [box((a, b, 0.004), (0, 0, z + 0.002))]
            pan += [box((a, 0.004, 0.06), (0, s * (b / 2 + 0.002), z + 0.03)) for s in BOTH]
            pan += [box((0.004, b + 0.008, 0.06), (s * (a / 2 + 0.002), 0, z + 0.03)) for s in BOTH]
            t.add("skid frame", *pan)
        return t.model()


class Swivel(_Dolly, name="caster/swivel plate", weight=1.5):
    """A low dolly on swivel casters, half of them with brakes."""

    casters: Casters = Casters.of("swivel", "braked")


class FixedAndSwivel(_Dolly, name="caster/fixed and swivel", weight=1.2):
    """A low dolly on fixed casters at one end and swivel casters at the other."""

    casters: Casters = Casters.of("fixed", "fixed", "swivel", "braked")


class HeavyDuty(_Dolly, name="caster/heavy"):
    """A low dolly on heavy casters."""

    casters: Casters = Casters.of("heavy")


class Levelling(_Dolly, name="caster/levelling", weight=0.7):
    """A low dolly on casters with levelling feet."""

    casters: Casters = Casters.of("levelling")


class Trolley(Structure, name="caster/stem", weight=1.2, grain="fitting"):
    """A tube trolley on stem or twin-wheel casters: uprights with casters in their ends, shelves, a push handle."""

    radius: float = between(0.025, 0.06, "of a wheel", "m")
    length: float = between(0.5, 1.1, "from upright to upright", "m")
    width: float = between(0.4, 0.7, "from upright to upright", "m")
    height: float = between(0.5, 1.0, "of an upright", "m")
    make: str = among(("stem", "twin"), "of the casters")
    casters: Casters = nested(Casters, "casters", fixed=lambda p: {"makes": (p.make,)})
    shelves: int = whole(2, 3, "one above the other")
    handle: bool = chance(0.6, "a push handle")

    def build(self, t: Table) -> Model:
        r, a, b, h, d = self.radius, self.length, self.width, self.height, max(0.014, 0.4 * self.radius)
        spots = [(sx * a / 2, sy * b / 2) for sx, sy in CORNERS]
        z = self.casters.build(t, spots, r)
        t.add_each("post", [pipe([(x, y, z), (x, y, z + h)], d, t.style) for x, y in spots])
        for level in z + np.linspace(0.1, 1.0, self.shelves) * h:
            shelf = slab_xy(rounded_rectangle(a + 2 * d, b + 2 * d, 2 * d, 3), level - 0.012, level + 0.012)
            t.add("plate", shelf, of="clamp")
        if self.handle:
            x, y = a / 2, b / 2
            path = [(x, -y, z + h), (x + 0.15, -y, z + h + 0.12), (x + 0.15, y, z + h + 0.12), (x, y, z + h)]
            t.add("railing", pipe(path, d, t.style, 0.05), of="handle")
        return t.model()


class Cart(Structure, name="caster/cart wheels", weight=1.2, grain="fitting"):
    """A cart on big wheels: an axle with two or four rubber-tyred or spoked wheels, a frame, a drawbar or handles."""

    radius: float = between(0.1, 0.25, "of a wheel", "m")
    length: float = between(0.8, 1.8, "of the frame", "m")
    width: float = between(0.5, 0.9, "of the frame", "m")
    wide: float = between(0.25, 0.45, "width of a wheel / radius")
    wheel: str = among(("tyre", "tyre", "spoked", "tread"), "how the wheels are made")
    size: float = between(0.04, 0.08, "height of the frame's section", "m")
    shape: str = among(("SHS", "U", "CHS", "RHS"), "section of the frame")
    axles: int = whole(1, 2, "axles: of one it has handles and feet, of two a drawbar")
    decked: bool = chance(0.7, "a plate on it")

    def build(self, t: Table) -> Model:
        r, a, b, one = self.radius, self.length, self.width, section(self.shape, self.size, t.style)
        h, w = float(np.ptp(one[0][:, 1])) / 2, self.wide * r
        z = r + 0.15 * r + h
        t.add_each("skid frame", [bar((-a / 2, s * b / 2, z), (a / 2, s * b / 2, z), one) for s in BOTH])
        xs = np.linspace(-0.45 * a, 0.45 * a, 3)
        t.add_each("skid frame", [bar((x, -b / 2, z), (x, b / 2, z), one) for x in xs])
        for x in (-0.3 * a,) if self.axles == 1 else (-0.32 * a, 0.32 * a):
            y, thick = b / 2 + 0.04 + 0.6 * w, 0.14 * r
            t.add("caster", rod((x, -y - w, r), (x, y + w, r), thick, few_sides(t.style, thick, 12)), of="trim")
            for s in BOTH:
                for solid, of in wheel(self.wheel, r, w, t.style):
                    t.at(x, s * y, r).add("caster", solid, of=of)
                t.add("bracket", box((0.3 * r, 0.02, 0.3 * r), (x, s * b / 2, r + 0.1 * r)))
        if self.axles == 1:
            t.add_each("post", [box((0.04, 0.04, z - h), (0.4 * a, s * b / 2, (z - h) / 2)) for s in BOTH])
            ways = ((-0.1, z + h), (0.35, z + 0.2), (0.55, z + 0.2))
            grips = [pipe([(a / 2 + x, s * b / 2, up) for x, up in ways], 0.016, t.style, 0.08) for s in BOTH]
            t.add_each("railing", grips, of="handle")
        else:
            t.add("brace", pipe([(0.45 * a, 0, z), (a / 2 + 0.7, 0, 0.1)], 0.02, t.style), of="handle")
            eye = along("x", ring(0.025, 0.04, -0.012, 0.012, 12), a / 2 + 0.705, 0, 0.09)
            t.add("lifting lug", eye, of="handle")
        if self.decked:
            t.add("plate", box((a, b, 0.006), (0, 0, z + h + 0.003)), of="clamp")
        return t.model()


class RailWheels(Structure, name="caster/rail wheels", grain="fitting"):
    """A bogie or transfer car on grooved or flanged wheels that stand on angle, tube or flat-bottomed rails."""

    radius: float = between(0.05, 0.14, "of a wheel", "m")
    length: float = between(0.6, 1.6, "of the car", "m")
    gauge: float = between(0.5, 1.2, "from rail to rail", "m")
    wheel: str = among(("groove", "flanged"), "how the wheels are made")
    wide: float = between(0.5, 0.9, "width of a wheel / radius")
    rail: str = among(("rail", "square"), "section of the rails", when=lambda p: p.wheel == "flanged", otherwise="CHS")
    box_height: float = between(1.2, 1.6, "height of the wheels' boxes / radius")
    size: float = between(0.08, 0.16, "height of the car's section", "m")
    shape: str = among(("U", "H", "RHS", "I"), "section of the car")
    decked: bool = chance(0.5, "a plate on it")

    def build(self, t: Table) -> Model:
        r, a, b, w = self.radius, self.length, self.gauge, self.wide * self.radius
        grooved, box_h = self.wheel == "groove", self.box_height * self.radius
        rail = section(self.rail, 0.5 * w if grooved else 0.7 * r, t.style)
        _x0, _x1, y0, y1 = span_of(rail)
        z = y1 - y0 + (0.75 * r if grooved else 0.83 * r) - (0.12 * w if grooved else 0.0)
        t.add_each("beam", [bar((-a, s * b / 2, -y0), (a, s * b / 2, -y0), rail) for s in BOTH])
        sleepers = [box((0.1, b + 0.4, 0.06), (x, 0, -0.03)) for x in np.linspace(-0.9 * a, 0.9 * a, 4)]
        t.add_each("beam", sleepers, of="safety")
        made, deep = wheel(self.wheel, r, w, t.style), box_h + 0.3 * r
        for sx, sy in CORNERS:
            here = t.at(sx * 0.38 * a, sy * b / 2, z)
            for solid, of in made:
                here.spun("z", 0.0 if sy > 0 else np.pi).add("caster", solid, of=of)
            cheeks = [box((0.7 * r, 0.01, deep), (0, q * (0.62 * w + 0.005), box_h / 2 - 0.15 * r)) for q in BOTH]
            cheeks.append(box((0.7 * r, 1.24 * w + 0.02, 0.01), (0, 0, box_h - 0.005)))
            here.add("bracket", *cheeks, of="clamp")
            here.along("y").add("bolt", cylinder(0.12 * r, -0.8 * w, 0.8 * w, 8))
        one = section(self.shape, self.size, t.style)
        h = float(np.ptp(one[0][:, 1])) / 2
        level = z + box_h + h
        t.add_each("skid frame", [bar((-a / 2, s * b / 2, level), (a / 2, s * b / 2, level), one) for s in BOTH])
        t.add_each("skid frame", [bar((s * 0.45 * a, -b / 2, level), (s * 0.45 * a, b / 2, level), one) for s in BOTH])
        if self.decked:
            t.add("plate", box((a, b + 0.1, 0.008), (0, 0, level + h + 0.004)), of="clamp")
        return t.model()


class Skates(Structure, name="caster/skates", weight=0.6, grain="fitting"):
    """Machinery skates: boxes with rows of rollers and a swivel pad, under two beams of a load."""

    radius: float = between(0.03, 0.06, "of a roller", "m")
    rollers: int = whole(2, 4, "one after the other")
    wide: float = between(3.0, 5.0, "width of a skate / radius of a roller")
    length: float = between(0.8, 1.8, "from skate to skate, along the beams", "m")
    width: float = between(0.5, 1.0, "from beam to beam", "m")
    joined: tuple[bool, ...] = several(yes(0.5), 4, "whether a skate is one mesh")
    size: float = between(0.1, 0.2, "height of a beam", "m")
    shape: str = among(("H", "RHS", "U"), "section of the beams")

    def build(self, t: Table) -> Model:
        r, a, b, wide, high = self.radius, self.length, self.width, self.wide * self.radius, 2.9 * self.radius
        long, n = (2.2 * self.rollers + 0.6) * r, few_sides(t.style, r, 16)
        frame = [box((long, 0.3 * r, 1.6 * r), (0, s * wide / 2, 1.6 * r)) for s in BOTH]
        frame.append(box((long, wide + 0.3 * r, 0.3 * r), (0, 0, 2.55 * r)))
        pad, xs = cylinder(1.4 * r, 2.7 * r, high, n), (np.arange(self.rollers) - (self.rollers - 1) / 2) * 2.2 * r
        rollers = [along("y", cylinder(r, -0.48 * wide, 0.48 * wide, n), x, 0, r) for x in xs]
        for (sx, sy), joined in zip(CORNERS, self.joined, strict=True):
            here = t.at(sx * a / 2, sy * b / 2)
            if joined:
                here.add("caster", *frame, *rollers, pad, of="handle")
            else:
                here.add("caster", *frame, pad, of="handle")
                here.add_each("caster", rollers)
        one = section(self.shape, self.size, t.style)
        z = high + float(np.ptp(one[0][:, 1])) / 2
        t.add_each("beam", [bar((-a / 2 - 0.2, s * b / 2, z), (a / 2 + 0.2, s * b / 2, z), one) for s in BOTH])
        return t.model()


CASTERS = families_of(Swivel, FixedAndSwivel, HeavyDuty, Levelling, Trolley, Cart, RailWheels, Skates)
