"""Small valves at their places: hose taps, panels, manifolds, radiators, hydrant valves; and operators of their own."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    standing,
)
from cadplants.families.valves.drive import Wheel, drive_of, put_spindle
from cadplants.families.valves.parts import SMALL, bend, chain, square
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import merge, moved, tube
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["STATIONS"]

_KNOBS = ("bar", "knob", "wheel")
_ABOUT_KNOB = "what turns a needle"
_SQUARE_POST = "the post is square"


class _Station(Valve, place="floor", sizes=SMALL):
    """A valve with what it is fixed to."""


def _foot(t: Table, high: float, angular: bool) -> None:
    """A post on a base plate from the floor up to a height [m]."""
    half = 0.02
    pole = box((2 * half, 2 * half, high - 0.01), (0, 0, (high + 0.01) / 2))
    t.add("post", pole if angular else cylinder(half, 0.01, high, 12))
    t.add("base plate", box((5 * half, 5 * half, 0.01), (0, 0, 0.005)))


class _Riser(Params):
    """A wall with a rosette, or a pipe clamped to a post."""

    walled: bool = chance(0.4, "out of a wall, not on a pipe at a post")
    angular: bool = chance(0.5, _SQUARE_POST, when=lambda p: not p.walled)

    def build(self, t: Table, size: int, high: float) -> float:
        """Puts it down, for a nominal size; returns where a tap upon it begins along y [m]."""
        r, inner = PIPES[size].radius, PIPES[size].bore if t.style.hollow else 0.0
        n = t.n(r)
        if self.walled:
            t.add("wall", box((0.8, 0.12, high + 0.5), (0, -0.06, (high + 0.5) / 2)))
            rosette = turned(outline(2.2 * r, 0.0, 2.0 * r, 0.006, 1.2 * r, 0.01), n)
            t.at(0, 0, high).along("y").add("flange", rosette, of="trim")
            return 0.0095
        t.add("pipe", tube(bend([(0, 0, 0.0), (0, 0, high), (0, 2.2 * r, high)], 1.8 * r, 6), r, inner, n))
        _foot(t.at(0, -r - 0.021), high - 0.1, self.angular)
        strap = box((2 * r + 0.03, 0.003, 0.024), (0, -r - 0.0005, 0))
        for f in (0.35, 0.75):
            t.at(0, 0, f * high).add("clamp", ring(r, r + 0.003, -0.012, 0.012, n), strap)
        return 2.2 * r - 0.001


class HoseTap(_Station, name="hose tap/bent spout"):
    """A hose tap (EN 200) with a bent spout on a riser clamped to a post or led through a wall; wheel, lever or T."""

    size: int = among((15, 20, 25), "nominal size of its pipe", "mm")
    high: float = between(0.5, 1.1, "height of the tap", "m")
    riser: _Riser = nested(_Riser, "what it is fixed to")
    spout: float = between(2.5, 4.5, "reach of the spout / radius of the pipe")
    barbed: bool = chance(0.6, "a barbed nozzle for a hose")
    wheeled: bool = chance(0.6, "a wheel on a stem rather than a lever")
    wide: float = between(1.2, 2.0, "radius of the wheel / of the pipe", when=lambda p: p.wheeled)
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.wheeled)
    lever: Any = drive_of("lever", "wing", "bar", radius=lambda p: PIPES[p.size].radius, when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        r, high = PIPES[self.size].radius, self.high
        n, start = t.n(r), self.riser.build(t, self.size, high)
        y, far = start + 2.6 * r, start + 2.6 * r + self.spout * r
        shank = [cylinder(0.95 * r, start, y, n), hexagon(2.6 * r, start + 0.2 * r, start + 1.4 * r)]
        chest = turned(outline(0.9 * r, -1.2 * r, 1.35 * r, -0.6 * r, 1.35 * r, 0.9 * r, 1.0 * r, 1.5 * r), n)
        path = [(0, y, 0), (0, far, 0), (0, far, -4 * r)]
        tip = [ring(0.6 * r, 1.15 * r, -5.2 * r, -3.9 * r, n)]
        if self.barbed:
            marks = ((0.7, -7.5), (0.9, -6.6), (0.75, -6.5), (0.9, -5.8), (0.8, -5.1))
            tip.append(turned([(a * r, z * r) for a, z in marks], n))
        up = t.at(0, 0, high)
        tap = [along("y", merge(shank)), moved(chest, at(0, y)), rope(bend(path, 2.2 * r, 6), 0.85 * r, n)]
        up.add("valve body", *tap, *(moved(solid, at(0, far)) for solid in tip))
        up = up.at(0, y, 1.5 * r)
        if self.wheeled:
            up.add("valve bonnet", hexagon(2.2 * r, -0.001, 1.0 * r), cylinder(0.8 * r, 0, 1.8 * r, n))
            up.add("gland", hexagon(1.3 * r, 1.7 * r, 2.4 * r))
            put_spindle(up, 2.3 * r, 4.2 * r, 0.3 * r)
            self.wheel.build(up, 0.012 + self.wide * r, 3.4 * r)
        else:
            up.add("valve stem", cylinder(0.5 * r, -0.002, 0.6 * r, 10))
            self.lever.build(up.at(0, 0, 0.5 * r))
        return standing(t, "ball valve")


class _Needle(Params):
    """A valve's headwork on a block: bonnet, gland, stem, T bar, knob or wheel."""

    knob: str = given("bar", _ABOUT_KNOB)
    radius: float = given(0.01, "that it is scaled by", "m")
    bar: Any = drive_of("bar", radius=lambda p: p.radius, when=lambda p: p.knob == "bar")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.knob == "wheel")

    def build(self, t: Table) -> None:
        """Puts it down on z = 0."""
        r = self.radius
        t.add("valve bonnet", hexagon(2.2 * r, -0.001, 1.6 * r), cylinder(0.8 * r, 1.5 * r, 3.2 * r, 12))
        t.add("gland", hexagon(1.5 * r, 3.1 * r, 4.0 * r))
        t.add("valve stem", cylinder(0.35 * r, 3.9 * r, 6.6 * r, 8))
        if self.knob == "bar":
            self.bar.build(t.at(0, 0, 6.0 * r))
        elif self.knob == "knob":
            knob = outline(1.2 * r, 5.4 * r, 1.6 * r, 5.8 * r, 1.6 * r, 7.2 * r, 1.2 * r, 7.5 * r)
            t.add("handwheel", turned(knob, 10), turns=Turning("handwheel"))
        else:
            self.wheel.build(t, 0.012 + 1.5 * r, 5.8 * r)


# Where the valves of manifolds are, as places / width and heights / height of the block.
_SPOTS = {
    2: ((-0.25, 0.0), (0.25, 0.0)),
    3: ((-0.33, 0.0), (0.0, 0.0), (0.33, 0.0)),
    5: ((-0.36, 0.2), (0.0, 0.2), (0.36, 0.2), (-0.18, -0.28), (0.18, -0.28)),
}


class Manifold(_Station, name="needle valve/manifold"):
    """An instrument manifold (IEC 61518 spacing) of two, three or five valves on a pipe post, with impulse tubes."""

    count: int = among((2, 3, 5), "valves")
    core: float = between(0.008, 0.011, "radius of a valve", "m")
    high: float = between(0.9, 1.5, "height of the block's middle", "m")
    knob: str = among(_KNOBS, _ABOUT_KNOB + ", but for five valves, which have knobs")
    tall: float = between(0.05, 0.09, "height of the block", "m")
    flanged: bool = chance(0.5, "square flanges for the instrument")
    ends: bool = chance(0.5, "the outer valves are on the block's ends", when=lambda p: p.count < 5)
    needles: tuple[_Needle, ...] = several(
        made(_Needle, lambda p: {"knob": "knob" if p.count == 5 else p.knob, "radius": p.core}),
        lambda p: p.count,
        "headworks of the valves",
    )
    post: float = among((0.0302, 0.024), "radius of the pipe post", "m")
    feet: tuple[float, ...] = several(number(0.1, 0.5), 2, "heights at which the tubes lead away", "m")

    def build(self, t: Table) -> Model:
        wide, tall, deep, up = 0.054 + 0.03 * self.count, self.tall, 0.032, t.at(0, 0, self.high)
        block = [box((wide, deep, tall))]
        if self.flanged:
            block += [along("y", square(0.024, deep / 2 - 0.001, deep / 2 + 0.012), x) for x in (-0.027, 0.027)]
        up.add("valve body", *block)
        for (f, h), needle in zip(_SPOTS[self.count], self.needles, strict=True):
            side = float(np.sign(f))
            if self.ends and side:
                needle.build(up.at(side * wide / 2, 0, h * tall).spun("y", side * np.pi / 2))
            else:
                needle.build(up.at(f * wide, -deep / 2, h * tall).spun("x", np.pi / 2))
        self._post(t, min(wide, 0.09), deep)
        for x, foot in zip((-0.027, 0.027), self.feet, strict=True):
            nuts = [hexagon(0.019, -0.001, 0.018), hexagon(0.016, 0.02, 0.034)]
            up.at(x, 0, -tall / 2).along("-z").add("valve body", *nuts, cylinder(0.008, 0.0, 0.03, 10))
            path = bend([(x, 0, self.high - tall / 2 - 0.03), (x, 0, foot), (x, -0.5, foot)], 0.04)
            t.add("pipe", tube(path, 0.006, 0.0045 if t.style.hollow else 0.0, 8))
        return standing(t, "needle valve")

    def _post(self, t: Table, wide: float, deep: float) -> None:
        """A pipe post behind the block, with a bracket between them held by u-bolts."""
        pipe, high, tall = self.post, self.high, self.tall
        t.at(0, 0.12).add("post", cylinder(pipe, 0.01, high + 0.2, t.n(pipe)))
        t.at(0, 0.12).add("base plate", box((0.2, 0.2, 0.01), (0, 0, 0.005)))
        back = 0.12 - pipe
        gap, up = back - deep / 2, t.at(0, 0, high)
        arms = [box((0.05, gap, 0.006), (0, deep / 2 + gap / 2, s * (tall / 2 - 0.004))) for s in (1, -1)]
        up.add("bracket", box((wide, 0.005, tall + 0.04), (0, back - 0.0025, 0)), *arms, of="steel")
        out, front, far = pipe + 0.006, back - 0.012, 0.12 + pipe + 0.006
        bow = rope(bend([(out, front, 0), (out, far, 0), (-out, far, 0), (-out, front, 0)], pipe, 4), 0.004, 6)
        for s in (1, -1):
            up.at(0, 0, s * (tall / 2 + 0.008)).add("u-bolt", bow, of="fastener")


class Panel(_Station, name="needle valve/panel", weight=0.7):
    """Needle valves in a panel: a sheet between posts, nuts and knobs before it, bodies and tubes behind."""

    count: int = whole(1, 3, "places for valves")
    high: float = between(1.0, 1.4, "height of the panel's middle", "m")
    tall: float = between(0.25, 0.5, "height of the panel", "m")
    angular: tuple[bool, ...] = several(yes(0.5), 2, _SQUARE_POST)
    core: float = between(0.008, 0.012, "radius of a valve", "m")
    knob: str = among(_KNOBS, _ABOUT_KNOB)
    spot: int = among(lambda p: tuple(range(p.count)), "which place has the valve")
    needle: _Needle = nested(_Needle, "headwork of the valve", fixed=lambda p: {"knob": p.knob, "radius": p.core})

    def build(self, t: Table) -> Model:
        r, high, tall, wide = self.core, self.high, self.tall, 0.16 * self.count + 0.1
        t.at(0, 0, high).add("plate", box((wide, 0.004, tall)))
        for s, angular in zip(BOTH, self.angular, strict=True):
            _foot(t.at(s * (wide / 2 - 0.02), 0.022), high + tall / 2, angular)
        mid = t.at(0.16 * (self.spot - (self.count - 1) / 2), 0, high)
        through = along("-y", cylinder(0.9 * r, -0.01, 0.0085, 12))  # the sheet
        end = merge([hexagon(1.8 * r, 0.0, 3.0 * r), cylinder(0.8 * r, 0, 4 * r, 10)])
        ends = [along(way, end, 0, 0.024) for way in ("z", "-z")]
        mid.add("valve body", box((2.6 * r, 0.04, 2.6 * r), (0, 0.022, 0)), through, *ends)
        mid.along("-y").add("gland", hexagon(3.0 * r, 0.0018, 0.009))
        self.needle.build(mid.at(0, -0.0085).spun("x", np.pi / 2))
        for s in (1, -1):
            far = s * (tall / 2 + 0.03)
            path = bend([(0, 0.024, s * 3.8 * r), (0, 0.024, far), (0, 0.3, far)], 0.02)
            mid.add("pipe", tube(path, 0.6 * r, 0.45 * r if t.style.hollow else 0.0, 8))
        mid.add("sign", box((0.08, 0.001, 0.025), (0, -0.0025, 0.07)), of="dial")
        return standing(t, "needle valve")


class RadiatorValve(_Station, name="thermostatic valve/radiator"):
    """A thermostatic valve (EN 215) at a radiator on feet: angle body, union, ribbed head, pipe to the floor."""

    width: float = between(0.5, 1.4, "of the radiator", "m")
    height: float = between(0.35, 0.75, "of the radiator", "m")
    depth: float = between(0.05, 0.11, "of the radiator", "m")
    low: float = between(0.1, 0.18, "height of the radiator's underside", "m")
    upper: bool = among((False, True), "the valve is above, not below")
    level: bool = chance(0.6, "its head points along the radiator, not upwards")
    forward: bool = chance(0.25, "its head points forward instead")
    tip: float = between(0.016, 0.024, "radius of the head's tip", "m")
    long: float = between(0.045, 0.075, "length of the head", "m")
    ribs: int = among((0, 8, 14), "ribs of the head")

    def build(self, t: Table) -> Model:
        wide, tall, deep, low, inner = self.width, self.height, self.depth, self.low, 0.0075 * t.style.hollow
        panels = [box((wide, 0.012, tall), (0, s * (deep / 2 - 0.006), low + tall / 2)) for s in BOTH]
        spots = np.linspace(-wide / 2 + 0.03, wide / 2 - 0.03, int(wide / 0.06))
        fins = [box((0.035, deep - 0.02, tall - 0.06), (x, 0, low + tall / 2)) for x in spots]
        t.add("radiator", *panels, *fins, box((wide, deep, 0.01), (0, 0, low + tall + 0.004)), of="tank")
        feet = [box((0.04, deep, low + 0.01), (s * 0.35 * wide, 0, (low + 0.01) / 2)) for s in BOTH]
        t.add("bracket", *feet, of="steel")
        n, z = t.n(1.5 * 0.0107), low + tall - 0.05 if self.upper else low + 0.05
        side, mid = t.at(wide / 2, 0, z), t.at(wide / 2 + 0.05, 0, z)
        side.along("x").add("union", hexagon(0.030, 0.012, 0.030), cylinder(0.011, -0.02, 0.03, n), own=True)
        under = merge([cylinder(0.012, 0.0, 0.034, n), hexagon(0.027, 0.022, 0.040)])
        mid.add("valve body", along("x", cylinder(0.012, -0.021, 0, n)), ball(0.0155, 12), along("-z", under))
        head = mid.spun("x", np.pi / 2) if self.forward else mid.along("x") if self.level else mid
        tip, long = self.tip, self.long
        grip = outline(0.016, 0.026, 0.021, 0.034, tip, 0.034 + 0.6 * long, 0.8 * tip, 0.034 + long)
        solids = [turned([*grip, (0.3 * tip, 0.036 + long)], n)]
        if self.ribs:
            rib = box((0.004, 0.003, 0.6 * long), (0, 0, 0.036 + 0.4 * long))
            solids.append(around(rib, self.ribs, 0.9 * tip + 0.002))
        head.add("gland", cylinder(0.011, 0.008, 0.02, n), hexagon(0.030, 0.0165, 0.027))
        head.bundled("actuator").add("actuator", *solids, of="dial", own=True)
        mid.add("pipe", tube(np.array([[0, 0, -0.038], [0, 0, -z]]), 0.009, inner, n))
        back = bend([(0.025, 0, low + 0.05), (-0.05, 0, low + 0.05), (-0.05, 0, 0.0)], 0.015)
        t.at(-wide / 2).add("pipe", tube(back, 0.009, inner, n))
        return standing(t, "thermostatic valve")


class HoseValve(_Station, name="hose valve/standpipe"):
    """A fire hose valve (BS 5041 or NFPA practice) on a standpipe: square or oblique, wheel, cap on a chain."""

    size: int = among((50, 65), "nominal size of the valve", "mm")
    high: float = between(0.8, 1.2, "height of the valve", "m")
    main: int = among((80, 100), "nominal size of the standpipe", "mm")
    rise: float = between(0.4, 1.2, "of the standpipe over the valve", "m")
    tilt: float = among((0.0, 0.75), "of the mouth, forward", "rad")
    lugs: int = among((2, 3), "lugs of the cap")
    chained: bool = chance(0.6, "the cap hangs on a chain")
    wide: float = between(1.5, 2.2, "radius of the wheel / of the chest")
    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        r, main, high, hollow = PIPES[self.size].radius, PIPES[self.main].radius, self.high, t.style.hollow
        n, w = t.n(1.4 * r), 1.35 * r
        t.add("pipe", ring(main - 0.006 if hollow else 0.0, main, 0.0, high + self.rise, t.n(main)))
        up = t.at(0, 0, high)
        up.along("-y").add("nipple", ring(0.8 * r if hollow else 0.0, r, 0.97 * main, main + 0.1, n))
        mid = up.at(0, -main - 0.09 - 1.8 * w)
        mouth = mid.spun("x", self.tilt)
        inlet = along("y", merge([cylinder(1.1 * r, 0.0, 1.8 * w, n), hexagon(2.7 * r, 1.0 * w, 1.8 * w)]))
        chest = turned(outline(0.9 * w, -1.0 * w, 1.1 * w, -0.3 * w, 1.1 * w, 0.7 * w, 0.8 * w, 1.2 * w), n)
        marks = ((1.0, 0.0), (1.0, 2.2), (1.2, 2.2), (1.2, 2.6), (1.0, 2.7))
        out = along("-z", turned([(a * r, z * w) for a, z in marks], n))
        turn = spun("x", self.tilt)
        mid.add("valve body", inlet, chest, moved(out, turn))
        lug = box((0.25 * r, 0.3 * r, 0.4 * w), (0, 0, 2.8 * w))
        cap = [cylinder(1.3 * r, 2.55 * w, 3.1 * w, n), around(lug, self.lugs, 1.35 * r)]
        mouth.along("-z").add("pipe cap", *cap, of="trim", own=True)
        if self.chained:
            spots = ((1.28 * r, 0, -2.8 * w, 1), (1.08 * w, 0, 0.1 * w, 1))
            start, end = ((turn @ spot)[:3] for spot in spots)
            mid.add("pipe cap", chain(start, end, 0.03, 0.0018), of="trim", own=True)
        head = mid.at(0, 0, 1.2 * w)
        head.add("valve bonnet", hexagon(1.8 * w, -0.002, 0.5 * w), cylinder(0.5 * w, 0, 1.2 * w, n))
        head.add("gland", hexagon(0.8 * w, 1.15 * w, 1.5 * w))
        put_spindle(head, 1.45 * w, 2.6 * w, 0.16 * w)
        self.wheel.build(head, self.wide * w, 2.1 * w)
        return standing(t, "globe valve")


STATIONS = families_of(HoseTap, Manifold, Panel, RadiatorValve, HoseValve)
