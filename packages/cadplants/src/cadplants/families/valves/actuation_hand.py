"""Handwheels and levers of many makes, standing on z = 0 about the z axis of a stem."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.draws import of_makes
from cadplants.builder.params import Params, among, between, chance, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.model.plant import Turning
from cadplants.solids.mesh_ops import Solid, extrude, loft, merge, moved, revolve, sweep, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Handlever", "Handwheel", "cylinder_at", "levers", "scaled", "slab", "span", "wheels"]


def slab(edge: Floats, low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A prism over an outline whichever way round it is given [m]."""
    x, y = edge[:, 0], edge[:, 1]
    turned_round = float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) < 0
    return extrude(edge[::-1] if turned_round else edge, low, high, holes)


def span(a: float, b: float) -> tuple[float, float]:
    """Two heights, the lower first [m]."""
    return min(a, b), max(a, b)


def scaled(size: float, *numbers: float) -> list[tuple[float, float]]:
    """The points of an outline from their numbers one after the other, all this many times as large [m]."""
    return [(size * x, size * z) for x, z in outline(*numbers)]


def cylinder_at(radius: float, low: float, high: float, x: float) -> Solid:
    """A grip that stands on a rim [m]."""
    return moved(cylinder(radius, low, high, 10), at(x))


# --- handwheels ---


class _Hub(Params):
    """A wheel's hub: round, square or six-sided, maybe with the nut that holds it."""

    form: str = among(("square", "round", "octagon", "hexagon"), "its outline")
    nut: bool = chance(0.4, "the nut that holds the wheel is on it")

    def solid(self, radius: float, tall: float) -> Solid:
        """The hub of a radius and height [m]."""
        if self.form == "square":
            hub = box((1.7 * radius,) * 2 + (tall,), (0, 0, tall / 2))
        else:
            hub = cylinder(radius, 0.0, tall, {"round": 14, "octagon": 8, "hexagon": 6}[self.form])
        return merge([hub, hexagon(1.1 * radius, tall, tall + 0.5 * radius)]) if self.nut else hub


_RIMS = ("round", "tall", "flat", "square")
_ABOUT_RIM = "section of its rim"


def _sides(radius: float, style: ModelingStyle) -> int:
    return max(16, style.round(radius))


def _rim(radius: float, thick: float, n: int, kind: str) -> Solid:
    """A rim about z = 0: round, oval flat, oval tall or square."""
    if kind == "round":
        return torus(radius - thick, thick, n, 8)
    turns = np.arange(8) * np.pi / 4
    a, b = (1.5, 0.7) if kind == "flat" else (0.7, 1.4)
    section = [(radius - a * thick + a * thick * float(np.cos(t)), b * thick * float(np.sin(t))) for t in turns]
    if kind == "square":
        section = outline(radius - 2 * thick, -thick, radius, -thick, radius, thick, radius - 2 * thick, thick)
    return weld([revolve(section, n, closed=True)])


class _Wheel(Params):
    """A handwheel of some make."""

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        """The wheel of a radius [m]."""
        raise NotImplementedError(type(self).__name__)


class _Spoked(_Wheel):
    """A cast wheel: two to six flat, round, tapered or bowed spokes to a rim above or level with its hub."""

    count: int = whole(2, 6, "spokes")
    thick: float = between(0.035, 0.10, "of its rim / radius")
    hub: float = between(0.12, 0.24, "radius of its hub / radius")
    tall: float = between(0.10, 0.3, "height of its hub / radius")
    rise: float = among((0.0, 0.0, 0.15, 0.35, -0.1), "of its rim over its hub / radius")
    spokes: str = among(("round", "flat", "bowed", "cranked"), "form of its spokes")
    wide: float = between(0.5, 1.1, "radius of a spoke / of the rim")
    bow: float = between(0.1, 0.3, "of a bowed spoke / radius", when=lambda p: p.spokes == "bowed")
    rim: str = among(_RIMS, _ABOUT_RIM)
    boss: _Hub = nested(_Hub, "hub")
    grip: bool = chance(0.12, "a grip stands on its rim")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        thick, hub, tall = radius * self.thick + 0.001, radius * self.hub + 0.003, 0.01 + radius * self.tall
        rise, wide = self.rise * radius + 0.5 * tall, self.wide * thick
        start, end = (0.6 * hub, 0.0, 0.5 * tall), (radius - thick, 0.0, rise)
        if self.spokes == "round":
            spoke = rod(start, end, wide, 6)
        elif self.spokes == "flat":
            flat = np.array([[-1.6, -0.6], [1.6, -0.6], [1.6, 0.6], [-1.6, 0.6]]) * wide
            spoke = sweep(np.array([start, end]), flat, up=(0.0, 1.0, 0.0))
        elif self.spokes == "bowed":
            way = np.linspace(0, 1, 6)[:, None]
            path = np.array(start) * (1 - way) + np.array(end) * way
            path[:, 1] = self.bow * radius * np.sin(np.pi * way[:, 0])
            spoke = rope(path, wide, 6)
        else:
            mid = (0.55 * radius, 0.0, 0.15 * start[2] + 0.85 * rise)
            spoke = rope([start, (1.3 * hub, 0, start[2]), mid, end], wide, 6)
        rim = moved(_rim(radius, thick, _sides(radius, style), self.rim), at(0, 0, rise))
        solids = [rim, around(spoke, self.count), self.boss.solid(hub, tall)]
        if self.grip:
            solids.append(cylinder_at(0.08 * radius + 0.004, rise, rise + 0.5 * radius, 0.93 * radius))
        return merge(solids)


class _Wire(_Wheel):
    """A wheel of bent wire: a thin rim, pairs of thin spokes, a pressed hub plate."""

    count: int = whole(2, 4, "pairs of spokes")
    rise: float = between(0.0, 0.3, "of its rim over its hub / radius")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        thick, hub, tall = 0.002 + 0.025 * radius, 0.22 * radius, 0.012 + 0.06 * radius
        low, high = 0.5 * tall, 0.5 * tall + self.rise * radius
        pair = [rod((0, s * 0.6 * hub, low), (0.93 * radius, s * 0.12 * radius, high), 0.8 * thick, 6) for s in (-1, 1)]
        rim = moved(torus(radius - thick, thick, _sides(radius, style), 8), at(0, 0, high))
        return merge([rim, around(merge(pair), self.count), cylinder(hub, 0, tall, 16)])


class _Disc(_Wheel):
    """A solid disc with round, slotted or no holes and a thick edge."""

    holes: str = among(("round", "slotted", "none"), "form of its holes")
    count: int = whole(3, 8, "holes", when=lambda p: p.holes != "none")
    rim: str = among(_RIMS, _ABOUT_RIM)
    boss: _Hub = nested(_Hub, "hub")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        n, thick, count = _sides(radius, style), 0.004 + 0.05 * radius, self.count
        turns = np.arange(count) * 2 * np.pi / max(1, count) + 0.1
        holes: tuple[Floats, ...] = ()
        if self.holes == "round":
            size = min(0.2, 0.9 / count) * radius
            holes = tuple(circle(size, 12, (0.62 * radius * np.cos(t), 0.62 * radius * np.sin(t))) for t in turns)
        elif self.holes == "slotted":
            for t in turns:
                a = np.linspace(t - 2.2 / count, t + 2.2 / count, 5)
                arc = np.column_stack([np.cos(a), np.sin(a)]) * radius
                holes += (np.vstack([0.8 * arc, 0.42 * arc[::-1]]),)
        plate = extrude(circle(0.93 * radius, n), 0.3 * thick, 0.9 * thick, holes)
        edge = moved(_rim(radius, 0.07 * radius, n, self.rim), at(0, 0, 0.6 * thick))
        return merge([plate, edge, self.boss.solid(0.22 * radius + 0.002, 1.8 * thick + 0.15 * radius)])


class _Dished(_Wheel):
    """A pressed sheet wheel: a cone or bowl with a rolled edge."""

    deep: float = between(0.15, 0.45, "depth of its bowl / radius")
    roll: float = between(0.05, 0.10, "radius of its rolled edge / radius")
    knee: float = between(0.2, 0.9, "height halfway out / depth")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        n, t = _sides(radius, style), 0.0015 + 0.015 * radius
        deep, roll = self.deep * radius, self.roll * radius
        line = outline(0, 0, 0.25 * radius, 0, 0.55 * radius, self.knee * deep, radius - roll, deep)
        under = [(0.002 * radius, -t), *[(r + 0.3 * t, z - t) for r, z in line[1:]]]
        edge = moved(torus(radius - roll, roll, n, 8), at(0, 0, deep))
        return merge([turned([*under, *line[:0:-1]], n), edge, cylinder(0.14 * radius, -t, 0.1 * radius + t, 12)])


class _Lobed(_Wheel):
    """A knob with a wavy, fluted or knurled edge, flat, domed or conical."""

    count: int = whole(3, 12, "lobes")
    wave: float = between(
        lambda p: 0.04 if p.count > 4 else 0.12, lambda p: 0.16 if p.count > 4 else 0.2, "half a lobe's depth / radius"
    )
    wavy: bool = chance(0.6, "its edge is wavy, not fluted")
    tall: float = between(0.35, 1.1, "height / radius")
    conical: bool = chance(0.4, "it narrows upward, rather than both ways")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        turns, tall = np.linspace(0, 2 * np.pi, 6 * self.count, endpoint=False), self.tall * radius
        swing = np.cos(self.count * turns)
        reach = 1 - self.wave + self.wave * swing * (1 if self.wavy else np.abs(swing))
        levels = outline(0.45, 0, 0.7, 0.25, 1, 0.4, 1, 0.85, 0.8, 1)
        if self.conical:
            levels = outline(1, 0, 0.97, 0.8, 0.85, 1)
        edge = np.column_stack([reach * np.cos(turns), reach * np.sin(turns)]) * radius
        loops = [np.column_stack([s * edge, np.full(len(turns), h * tall)]) for s, h in levels]
        return weld([loft([np.zeros((1, 3)), *loops, np.array([[0.0, 0.0, tall]])])])


class _Star(_Wheel):
    """A star grip: three to six short arms that end in balls or rounds; a cross handle where there are four."""

    count: int = whole(3, 6, "arms")
    knob: float = between(0.12, 0.2, "radius of an arm's end / radius")
    slim: float = between(0.5, 0.9, "radius of an arm / of its end")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        knob = radius * self.knob
        arm = [rod((0, 0, knob), (radius - knob, 0, knob), knob * self.slim, 8)]
        arm.append(moved(ball(knob, 10), at(radius - knob, 0, knob)))
        middle = outline(0.3 * radius, 0, 0.32 * radius, 1.6 * knob, 0.15 * radius, 2.2 * knob)
        return merge([around(merge(arm), self.count), turned(middle, 14)])


class _Cross(_Wheel):
    """A cross handle, as of taps and capstans: four long tapered or square arms, maybe within a ring."""

    tapered: bool = chance(0.5, "its arms are round and tapered, not square")
    boss: _Hub = nested(_Hub, "hub")
    ringed: bool = chance(0.25, "a ring holds its arms together")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        slim = 0.07 * radius + 0.002
        if self.tapered:
            side = outline(0.7 * slim, 0, slim, 0.8 * radius, 1.3 * slim, 0.92 * radius, 0.6 * slim, radius)
            arm = along("x", turned(side, 8), 0, 0, 1.6 * slim)
        else:
            arm = box((radius, 1.8 * slim, 1.8 * slim), (radius / 2, 0, 1.6 * slim))
        solids = [around(arm, 4), self.boss.solid(0.22 * radius, 3.2 * slim)]
        if self.ringed:
            solids.append(moved(torus(0.75 * radius, 0.7 * slim, _sides(radius, style), 6), at(0, 0, 1.6 * slim)))
        return merge(solids)


class _Tubular(_Wheel):
    """A wheel of bent pipe on two to four flat bars, the rim well above the hub."""

    count: int = whole(2, 4, "bars")
    deep: float = between(0.2, 0.5, "height of its rim / radius")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        thick, deep, low = 0.004 + 0.05 * radius, self.deep * radius, 0.08 * radius
        flat = np.array([[-1.5, -0.35], [1.5, -0.35], [1.5, 0.35], [-1.5, 0.35]]) * thick
        path = np.array([(0.05 * radius, 0, low), (0.45 * radius, 0, low), (0.97 * radius - thick, 0, deep)])
        bars = around(sweep(path, flat, up=(0.0, 1.0, 0.0)), self.count)
        rim = moved(torus(radius - thick, thick, _sides(radius, style), 8), at(0, 0, deep))
        return merge([rim, bars, cylinder(0.16 * radius + 0.003, 0.0, 0.16 * radius + 0.01, 12)])


_WHEELS: dict[str, type[_Wheel]] = {
    "spoked": _Spoked, "wire": _Wire, "disc": _Disc, "dished": _Dished, "lobed": _Lobed, "star": _Star,
    "cross": _Cross, "tubular": _Tubular,
}  # fmt: skip


class Handwheel(Params):
    """A handwheel of one of some makes about z, its hub standing on z = 0."""

    make: str = among(("spoked", "spoked", "spoked", "disc", "dished", "tubular", "wire"), "how it is made")
    form: Any = nested(lambda _, p: _WHEELS[p.make], "its proportions")
    turn: float = between(0, 6, "how far it is turned", "rad")

    def build(self, t: Table, radius: float, z: float = 0.0, turns: str = "handwheel") -> None:
        """Puts it down on a height [m]; ``turns``: what it is turned as."""
        solid = moved(self.form.solid(radius, t.style), spun("z", self.turn))
        t.at(0, 0, z).add("handwheel", solid, turns=Turning(turns))


def wheels(*makes: str) -> type[Handwheel]:
    """Handwheels of these makes."""
    return of_makes(Handwheel, makes)


# --- levers, pointing along +x ---


def _strip(path: Floats, half: float, thick: float) -> Solid:
    section = np.array([[half, -thick / 2], [half, thick / 2], [-half, thick / 2], [-half, -thick / 2]])
    return sweep(path, section, up=(0.0, 1.0, 0.0))


class _Lever(Params):
    """A lever of some make."""

    def solid(self, length: float) -> Solid:
        """The lever of a length [m]."""
        raise NotImplementedError(type(self).__name__)


class _Sheet(_Lever):
    """A flat lever of sheet, bent up once or twice, with or without a plastic sleeve."""

    rise: float = between(-0.02, 0.28, "of its grip / length")
    knee: float = between(0.15, 0.4, "where it is bent / length")
    sleeved: bool = chance(0.6, "a plastic sleeve is its grip")
    share: float = between(0.4, 0.6, "length of that sleeve / length", when=lambda p: p.sleeved)

    def solid(self, length: float) -> Solid:
        half, thick = 0.05 * length + 0.004, 0.002 + 0.012 * length
        rise, knee = self.rise * length, self.knee * length
        steps = outline(-1.4 * half, 0, knee, 0, knee + abs(rise) + 0.02 * length, rise, length, rise)
        solids = [_strip(np.array([(x, 0, thick + z) for x, z in steps]), half, thick)]
        solids.append(cylinder(1.1 * half, 0.0, 1.2 * thick, 12))
        solids.append(hexagon(1.2 * half, 1.5 * thick, 1.5 * thick + 0.4 * half))
        if self.sleeved:
            edge = rounded_rectangle(self.share * length, 2.3 * half, 0.9 * half, 3)
            place = at(length * (1 - self.share / 2), 0, thick + rise)
            solids.append(moved(slab(edge, -1.6 * thick, 1.6 * thick), place))
        return merge(solids)


class _Cast(_Lever):
    """A cast lever: an eye on the stem, a web that narrows, a round end."""

    end: float = between(0.04, 0.07, "radius of its end / length")

    def solid(self, length: float) -> Solid:
        eye, neck, end, thick = 0.11 * length, 0.04 * length, self.end * length, 0.035 * length + 0.002
        turns = np.linspace(-np.pi / 2, np.pi / 2, 6)
        tip = [(length - end + end * float(np.cos(t)), end * float(np.sin(t))) for t in turns]
        web = extrude(np.array([(0.7 * eye, -neck), *tip, (0.7 * eye, neck)]), 0.4 * thick, 1.3 * thick)
        rib = box((0.75 * length, 0.5 * neck, 2.0 * thick), (0.5 * length, 0, thick))
        square = box((eye, eye, 0.8 * thick), (0, 0, 2.6 * thick))
        return merge([web, rib, cylinder(eye, 0.0, 2.4 * thick, 16), square])


class _Bar(_Lever):
    """A round bar through a socket on the stem: sloping, cranked or straight, with a ball, a grip or a bare end."""

    tilt: float = among((0.0, 0.25, 0.6), "slope of the bar", "rad")
    cranked: bool = chance(0.5, "it starts level")
    end: str = weighted("its end", ball=0.4, grip=0.4, bare=0.2)

    def solid(self, length: float) -> Solid:
        slim, socket, tilt = 0.022 * length + 0.003, 0.06 * length + 0.005, self.tilt
        tip = np.array([length * np.cos(tilt), 0.0, socket + length * np.sin(tilt)])
        path = (
            [(-1.3 * socket, 0, socket), (0.3 * length, 0, socket), tuple(tip)]
            if self.cranked
            else [(-socket, 0, socket - 0.9 * np.tan(tilt) * socket), tuple(tip)]
        )
        solids = [rope(path, slim, 8), cylinder(socket, 0.0, 2 * socket, 12)]
        if self.end == "ball":
            solids.append(moved(ball(2.2 * slim, 10), at(*tip)))
        elif self.end == "grip":
            way = (tip - np.array(path[-2])) / np.linalg.norm(tip - np.array(path[-2]))
            solids.append(rod(tuple(tip - 0.35 * length * way), tuple(tip + 0.02 * length * way), 1.6 * slim, 10))
        return merge(solids)


class _Loop(_Lever):
    """An oval ring of bent wire, flat or rising: the stem sits in one end or in its middle."""

    wide: float = between(0.14, 0.3, "half its width / length")
    middle: float = among((0.0, 0.42), "of the ring from the stem / length")

    def solid(self, length: float) -> Solid:
        slim, wide = 0.015 * length + 0.002, self.wide * length
        turns, middle = np.arange(16) * np.pi / 8, self.middle * length
        path = np.column_stack([middle + 0.55 * length * np.cos(turns), wide * np.sin(turns), np.full(16, 2 * slim)])
        plate = box((0.16 * length, 2 * wide, 1.4 * slim), (0, 0, 2 * slim))
        wire = sweep(path, circle(slim, 6), closed=True)
        return merge([wire, plate, cylinder(0.06 * length + 0.002, 0.0, 3.5 * slim, 12)])


class _Wing(_Lever):
    """A butterfly handle: two wings up from the hub, plain or pierced."""

    droop: float = between(0.5, 1.1, "height of a wing's tip, below / width")
    pierced: bool = chance(0.4, "its wings are pierced")

    def solid(self, length: float) -> Solid:
        reach, wide = 0.4 * length, 0.14 * length
        right = outline(0, 0, 0.4, 0.1, 0.9, self.droop, 1, 2, 0.85, 2.3, 0.4, 1.5, 0, 1.2)
        edge = np.array([*right, *((-x, z) for x, z in right[-2:0:-1])]) * (reach, wide)
        holes: tuple[Floats, ...] = ()
        if self.pierced:
            holes = tuple(circle(0.3 * wide, 8, (s * 0.68 * reach, 1.25 * wide)) for s in (-1, 1))
        thick = 0.02 * length + 0.0015
        blade = moved(slab(edge, -thick, thick, holes), spun("x", np.pi / 2))
        return merge([blade, cylinder(0.6 * wide, 0.0, 1.3 * wide, 12)])


class _Tee(_Lever):
    """A tee key: a socket and a cross bar, round, flat or moulded with fingers' hollows."""

    tall: float = between(0.12, 0.6, "height of its cross bar / length")
    bar: str = among(("round", "flat", "moulded"), "form of its cross bar")

    def solid(self, length: float) -> Solid:
        tall, slim = self.tall * length, 0.035 * length + 0.002
        if self.bar == "round":
            side = outline(slim, -0.5 * length, 0.8 * slim, 0, slim, 0.5 * length)
            top = along("x", turned(side, 8), 0, 0, tall)
        elif self.bar == "flat":
            top = box((length, 1.2 * slim, 2.4 * slim), (0, 0, tall))
        else:
            xs = np.linspace(-0.5, 0.5, 13)
            wide = 2.4 * slim * (1 + 0.25 * np.cos(6 * np.pi * xs))
            edge = np.vstack([np.column_stack([xs * length, -wide]), np.column_stack([xs[::-1] * length, wide[::-1]])])
            top = moved(slab(edge, -1.3 * slim, 1.3 * slim), at(0, 0, tall))
        return merge([top, cylinder(1.5 * slim, 0.0, tall, 12), cylinder(2.2 * slim, 0.0, 0.3 * tall, 12)])


class _Notched(_Lever):
    """A ten-position lever of wafer butterfly valves: a grip with a spring trigger below it."""

    def solid(self, length: float) -> Solid:
        half, thick, rise = 0.045 * length + 0.005, 0.02 * length + 0.003, 0.1 * length
        path = np.array([(-half, 0, thick), (0.25 * length, 0, thick), (0.4 * length, 0, rise), (length, 0, rise)])
        below = outline(0.22 * length, -0.2 * thick, 0.45 * length, 0.3 * rise, 0.85 * length, 0.25 * rise)
        trigger = _strip(np.array([(x, 0, z) for x, z in below]), 0.6 * half, 0.7 * thick)
        pivot = along("y", cylinder(0.6 * thick, -1.3 * half, 1.3 * half, 8), 0.4 * length, 0, 0.6 * rise)
        cheek = (0.2 * length, 0.15 * half, 0.9 * rise)
        sides = [box(cheek, (0.4 * length, s * 0.9 * half, 0.55 * rise)) for s in (-1, 1)]
        hub = cylinder(1.3 * half, -0.2 * thick, 2 * thick, 14)
        return merge([_strip(path, half, thick), trigger, pivot, *sides, hub])


class _Spanner(_Lever):
    """A box wrench on the stem's square: a ring, a long I-shaped shank, a round or hollow end."""

    def solid(self, length: float) -> Solid:
        eye, thick, middle, along_ = 0.09 * length + 0.004, 0.02 * length + 0.003, 0.5 * length, 0.85 * length
        shank = box((along_, 0.07 * length, thick), (middle, 0, thick))
        ribs = [box((along_, 0.014 * length, 1.6 * thick), (middle, s * 0.03 * length, thick)) for s in (-1, 1)]
        end = moved(ring(0.02 * length, 0.05 * length, 0.5 * thick, 1.5 * thick, 14), at(0.95 * length))
        square = box((1.1 * eye, 1.1 * eye, 2.4 * thick), (0, 0, 1.2 * thick))
        return merge([shank, *ribs, end, ring(0.5 * eye, eye, 0.0, 2 * thick, 16), square])


_LEVERS: dict[str, type[_Lever]] = {
    "sheet": _Sheet, "cast": _Cast, "bar": _Bar, "loop": _Loop, "wing": _Wing, "tee": _Tee, "notched": _Notched,
    "spanner": _Spanner,
}  # fmt: skip


class Handlever(Params):
    """A lever of one of some makes on z = 0, along, across or against the run."""

    make: str = among(("sheet", "sheet", "cast", "bar", "loop", "spanner"), "how it is made")
    form: Any = nested(lambda _, p: _LEVERS[p.make], "its proportions")
    turn: float = among((0.0, 0.0, np.pi / 2, np.pi, -np.pi / 2), "where it points, from along the run", "rad")

    def build(self, t: Table, length: float, z: float = 0.0) -> None:
        """Puts it down with its eye on a height [m]."""
        solid = moved(self.form.solid(length), spun("z", self.turn))
        t.at(0, 0, z).add("lever", solid, turns=Turning("lever"))


def levers(*makes: str) -> type[Handlever]:
    """Levers of these makes."""
    return of_makes(Handlever, makes)
