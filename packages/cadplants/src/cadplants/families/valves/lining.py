"""Plug, diaphragm and pinch valves of further makes."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import STEMS, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, slab, wheels
from cadplants.families.valves.actuation_stroke import STROKES, Yoke
from cadplants.families.valves.ball import ClampedEnds, ferrule, part_ring
from cadplants.families.valves.body import bolts_on, ended, lid_joint, neck_of, oval, plate_outline
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, lofted, ring, rod, turned, waves
from cadplants.solids.transforms import at

__all__ = ["LININGS"]

_ABOUT_STEM = "how the stem is made"
_ABOUT_WHEELED = "a wheel rather than an actuator"


def _ovals(a: float, b: float, n: int, *marks: tuple[float, float, float]) -> Solid:
    """A solid through ovals, each as shares of two half widths and a height [m]."""
    return lofted([np.column_stack([oval(a * s, b * f, n), np.full(n, z)]) for s, f, z in marks])


class StraightDiaphragm(Valve, name="diaphragm valve/straight through", sizes=sizes_between(15, 200)):
    """A straight-through diaphragm valve: full bore, a long oval joint, a tall bonnet (EN 13397)."""

    joint: str = among(("oval", "square", "oval", "octagon"), "outline of the joint")
    tall: float = between(1.2, 2.0, "height of the bonnet / radius of the pipe")
    wheeled: bool = chance(0.65, _ABOUT_WHEELED)
    stem: str = among(STEMS, _ABOUT_STEM, when=lambda p: p.wheeled, otherwise="plain")
    wheel: Handwheel = nested(
        wheels("spoked", "spoked", "lobed", "dished", "disc"), "handwheel", when=lambda p: p.wheeled
    )
    make: str = among(("piston", "diaphragm"), "what the actuator is", when=lambda p: not p.wheeled, otherwise="")
    actuator: Any = nested(lambda _, p: STROKES[p.make], "actuator", when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        r, length, (neck, back) = t.pipe.radius, FACE_TO_FACE["gate"][t.dn] * 1.1, neck_of(t.dn)
        x, n, a, b = length / 2, t.n(1.6 * r, 16), min(0.42 * length, 1.7 * r + 0.012), 1.25 * r + 0.014
        seat, plate, up, wide = 1.25 * r + 0.006, 0.009 + 0.07 * r, t.at(length / 2), 1.08 * r + 0.004
        collar, lid, bolts = lid_joint(self.joint, a, b, seat, plate, t.style)
        tray = _ovals(a, b, n, (0.5, 0.4, -1.1 * r), (0.7, 0.8, -0.3 * r), (0.85, 0.85, seat - 0.5 * plate))
        rise = seat + 0.004 + plate
        high = rise + self.tall * r + 0.02
        tall = high - rise
        marks = ((0.75, 0.8, rise + 0.4 * tall), (0.4, 0.5, rise + 0.75 * tall), (0.3, 0.45, high))
        hood = _ovals(a, b, n, (0.85, 0.85, rise - 0.3 * plate), *marks)
        middle = outline(neck, back, wide, 0.3 * length, wide, 0.7 * length, neck, length - back)
        run = ended(t.dn, t.style, length, middle, "flanged")
        t.add("valve body", run, *(moved(solid, at(x)) for solid in (tray, collar)))
        seal = slab(plate_outline(self.joint, 0.99 * a, 0.99 * b, n), seat, seat + 0.004)
        up.add("gasket", seal, of="rubber", own=True)
        up.add("valve bonnet", moved(lid, at(0, 0, 0.004)), hood)
        up.extend([bolts])
        if self.wheeled:
            slim = 0.005 + 0.08 * r
            put_stem(up.at(0, 0, high), -0.01, 0.05 + r, slim, self.stem)
            self.wheel.build(up.at(0, 0, high), 0.04 + 1.2 * r, 0.012)
            finger = cylinder(0.8 * slim, high + 0.04 + r, high + 0.08 + 1.3 * r, 10)
            up.add("position indicator", finger, of="trim")
        else:
            self.actuator.build(up, r, high - 0.002)
        return t.model(length, kind="diaphragm valve")


class Aseptic(Valve, name="diaphragm valve/aseptic", sizes=sizes_between(15, 100), weight=1.5):
    """An aseptic or plastic diaphragm valve: block body, square joint, clamp, weld or socket ends (EN 13397)."""

    ends: str = among(("clamp", "butt", "socket"), "how it is joined to the pipe")
    corner: float = between(0.15, 0.6, "radius of the joint's corners / half its width")
    tall: float = between(1.0, 2.2, "height of the bonnet / radius of the pipe")
    is_round: bool = chance(0.5, "the bonnet is round")
    clamps: ClampedEnds = nested(ClampedEnds, "clamps at both ends", when=lambda p: p.ends == "clamp")
    wheeled: bool = chance(0.65, _ABOUT_WHEELED)
    wheel: Handwheel = nested(wheels("lobed", "lobed", "spoked", "dished"), "handwheel", when=lambda p: p.wheeled)
    upright: bool = chance(0.5, "the actuator is an upright cylinder", when=lambda p: not p.wheeled)
    operator: Any = operator("vertical", when=lambda p: p.upright)
    actuator: Any = nested(STROKES["piston"], "what lifts the stem", when=lambda p: not p.wheeled and not p.upright)

    def build(self, t: Table) -> Model:
        r, clamped, bore = t.pipe.radius, self.ends == "clamp", t.pipe.bore if t.style.hollow else 0.0
        stub, half, n = 0.025 if clamped else 0.0, 1.55 * r + 0.010, t.n(1.5 * r, 16)
        length = 0.06 + 3.2 * r + 2 * stub
        x = (0.06 + 3.2 * r) / 2 + stub
        up, thick, seat = t.at(x), 0.008 + 0.1 * r, 1.1 * r + 0.006
        if clamped:
            arms = [ferrule(t.dn, stub, x, t.style, True), ferrule(t.dn, x, length - stub, t.style, False)]
        else:
            arms = [along("x", ring(bore, r if self.ends == "butt" else 1.3 * r, 0.0, length, n))]
        flat = rounded_rectangle(2 * half, 2 * half, self.corner * half, 4)
        marks = ((0.45, -1.05 * r), (0.75, -0.2 * r), (0.9, seat - 0.007 - 0.1 * r))
        bottom = lofted([np.column_stack([flat * s, np.full(len(flat), z)]) for s, z in marks])
        block = [slab(flat, seat - thick, seat), bottom]
        t.add("valve body", *arms, *(moved(solid, at(x)) for solid in block), of="clamp")
        up.add("gasket", slab(flat * 0.995, seat, seat + 0.003), of="rubber", own=True)
        low = seat + 0.003
        step = low + 0.007 + 0.12 * r
        high = step + self.tall * r + 0.015
        if self.is_round:
            lid = [turned(outline(0.95 * half, step, 0.9 * half, 0.5 * (step + high), 0.55 * half, high), n)]
        else:
            lid = [slab(flat * 0.85, step, high - 0.004), cylinder(0.6 * half, high - 0.005, high, n)]
        up.add("valve bonnet", slab(flat, low, low + 0.008 + 0.12 * r), *lid, of="trim")
        up.extend([bolts_on(flat, 4, seat - 0.008, low + 0.009 + 0.12 * r, 0.005 + 0.04 * r)])
        if clamped:
            self.clamps.build(t, t.dn, stub, length)
        if self.wheeled:
            put_stem(up.at(0, 0, high), -0.004, 0.02 + r, 0.15 * half)
            self.wheel.build(up.at(0, 0, high), 0.85 * half + 0.008, 0.001)
            sight = cylinder(0.1 * half, high + 0.02 + r, high + 0.03 + 1.4 * r, 10)
            up.add("position indicator", sight, of="safety")
        elif self.upright:
            self.operator.build(up.at(0, 0, high))
        else:
            self.actuator.build(up, r, high - 0.001)
        return t.model(round(length, 6), "welded", "diaphragm valve")


def _sleeve(length: float, thick: float, size: float, flat: float, n: int) -> Solid:
    """A rubber sleeve that is pressed flat in its middle and gives way to the sides [m]."""
    half = ((thick, 1.0), (0.25 * length, 1.0), (0.42 * length, flat))
    turns, loops = np.arange(n) * 2 * np.pi / n, []
    for z, s in (*half, *((length - z, s) for z, s in half[::-1])):
        wide = size * (1 + 0.45 * (1 - s))
        loops.append(np.column_stack([np.full(n, z), wide * np.cos(turns), size * s * np.sin(turns)]))
    return lofted(loops)


class OpenPinch(Valve, name="pinch valve/open frame", sizes=sizes_between(25)):
    """An open-frame pinch valve: a rubber sleeve between two flanges, squeezed by bars in an open yoke."""

    flat: float = between(0.3, 1.0, "height of the squeezed sleeve / of the open one")
    pillars: bool = chance(0.5, "round pillars rather than flat ones")
    tied: bool = chance(0.6, "tie rods between the flanges")
    wheeled: bool = chance(0.6, _ABOUT_WHEELED)
    stem: str = among(STEMS, _ABOUT_STEM, when=lambda p: p.wheeled, otherwise="plain")
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.wheeled)
    make: str = among(("piston", "ram", "turning"), "what the actuator is", when=lambda p: not p.wheeled, otherwise="")
    actuator: Any = nested(lambda _, p: STROKES[p.make], "actuator", when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        r, size, thick, length = t.pipe.radius, t.flange.outer, plate_thickness(t.dn), 0.12 + 4.4 * t.pipe.radius
        n, out, inner, up = t.n(r, 16), 1.25 * r + 0.006, t.pipe.bore if t.style.hollow else 0.0, t.at(length / 2)
        solids = [along("x", ring(inner, size / 2, z, z + thick, n)) for z in (0.0, length - thick)]
        if self.tied:
            for y in (-0.46 * size, 0.46 * size):
                solids.append(rod((0.5 * thick, y, 0.1 * size), (length - 0.5 * thick, y, 0.1 * size), 0.008, 8))
        t.add("valve body", *solids)
        t.add("valve body", _sleeve(length, thick, out, self.flat, n), of="rubber")
        bar, reach, high, edge = (
            0.05 * length + 0.01,
            1.7 * out + 0.01,
            max(out + 0.06, 0.5 * size + 0.02),
            out * self.flat,
        )
        bars = [box((2 * bar, 2 * reach * 0.8, 0.6 * bar), (0, 0, s * (edge + 0.3 * bar))) for s in BOTH]
        up.add("valve disc", *bars)
        low, high = -out - 0.7 * bar, max(out + 0.06, 0.5 * size + 0.02)
        if self.pillars:
            posts = [moved(cylinder(0.008 + 0.05 * r, low, high, 10), at(0, s * reach)) for s in BOTH]
            beam = (2 * bar, 2.3 * reach, 0.02)
        else:
            posts = [box((1.6 * bar, 0.014, high - low), (0, s * reach, (high + low) / 2)) for s in BOTH]
            beam = (1.8 * bar, 2.1 * reach, 0.016)
        up.add("yoke", *posts, *(box(beam, (0, 0, z)) for z in (high, low)), of="steel")
        slim, foot = 0.007 + 0.06 * r, edge + 0.5 * bar
        put_stem(up, foot, high + (0.08 + r if self.wheeled else 0.012), slim, self.stem)
        if self.wheeled:
            self.wheel.build(up, 0.06 + 1.2 * r, high + 0.02 + 0.12 * r)
        else:
            self.actuator.build(up, r, high + 0.009)
        return t.model(round(length, 6), kind="pinch valve")


class _Squeezer(Params):
    """What presses an enclosed sleeve together: a wheel on a yoke, a piston or a ram."""

    powered: bool = chance(0.4, "a piston or ram rather than a wheel")
    make: str = among(("piston", "ram"), "what the actuator is", when=lambda p: p.powered, otherwise="")
    actuator: Any = nested(lambda _, p: STROKES[p.make], "actuator", when=lambda p: p.powered)
    yoke: Yoke = nested(Yoke, "yoke", when=lambda p: not p.powered)
    stem: str = among(STEMS, _ABOUT_STEM, when=lambda p: not p.powered, otherwise="plain")
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: not p.powered)

    def build(self, t: Table, half: float) -> None:
        """Puts it down on z = 0, on a tower of a half width [m]."""
        r = t.pipe.radius
        if self.powered:
            self.actuator.build(t, r, 0.0)
            return
        tall = 0.05 + 0.9 * r
        self.yoke.build(t, 1.3 * half, tall)
        put_stem(t, -0.02, tall + 0.06 + 0.5 * r, 0.006 + 0.06 * r, self.stem)
        self.wheel.build(t, 0.05 + 1.2 * r, tall + 0.002)


class EnclosedPinch(Valve, name="pinch valve/enclosed", sizes=sizes_between(25)):
    """An enclosed pinch valve: two cast halves bolted along the middle, air-operated or with a wheel above."""

    shape: str = among(("drum", "barrel", "ringed"), "shape of the casing")
    split: bool = chance(0.7, "the halves have a flange along the middle")
    bolts: int = whole(3, 5, "of that flange on a side", when=lambda p: p.split)
    by_air: bool = chance(0.45, "air squeezes the sleeve, through a port above")
    squeezer: _Squeezer = nested(_Squeezer, "what squeezes the sleeve", when=lambda p: not p.by_air)

    def build(self, t: Table) -> Model:
        r, length, (neck, back) = t.pipe.radius, 0.08 + 3.6 * t.pipe.radius, neck_of(t.dn)
        x, big = length / 2, 1.55 * r + 0.012
        n, up, high, long = t.n(big, 16), t.at(x), big + 0.02, length - 2 * back - 0.012
        solids = [ended(t.dn, t.style, length, self._casing(length, neck, back, big), "flanged")]
        if self.split:
            solids.append(moved(slab(rounded_rectangle(long, 2 * big + 0.05, 0.02, 3), -0.010, 0.010), at(x)))
        seat, half = max(high, 0.5 * t.flange.outer), 0.55 * big
        if self.by_air:
            port = [cylinder(0.016, 0.9 * big, high, 12), hexagon(0.026, high, high + 0.014)]
            port.append(cylinder(0.007, high + 0.01, high + 0.04, 8))
        else:
            port = [cylinder(half, 0.7 * big, seat, n), cylinder(1.4 * half, seat - 0.012, seat, n)]
        t.add("valve body", *solids, *(moved(solid, at(x)) for solid in port))
        if self.split:
            bolt = merge(
                [cylinder(0.005, -0.016, 0.016, 8), hexagon(0.016, 0.010, 0.018), hexagon(0.016, -0.018, -0.010)]
            )
            spots = [(float(p), s * (big + 0.014)) for p in np.linspace(-0.4, 0.4, self.bolts) * long for s in BOTH]
            up.add("bolt", *(moved(bolt, at(*spot)) for spot in spots))
        if not self.by_air:
            self.squeezer.build(up.at(0, 0, seat), half)
        if t.style.hollow:
            bore = t.pipe.bore
            liner = part_ring(outline(0.86 * bore, 0, 1.002 * bore, 0, 1.002 * bore, length, 0.86 * bore, length), n)
            t.add("valve body", about_x(liner), of="rubber")
        return t.model(round(length, 6), kind="pinch valve")

    def _casing(self, length: float, neck: float, back: float, big: float) -> list[tuple[float, float]]:
        """The outline of the casing between its flanges."""
        if self.shape == "drum":
            middle = [(big, back + 0.12 * length), (big, length - back - 0.12 * length)]
        elif self.shape == "barrel":
            shares, long = np.linspace(0.08, 0.92, 9), length - 2 * back
            middle = [(big * (0.8 + 0.2 * np.sin(np.pi * s)), float(back + s * long)) for s in shares]
        else:
            middle = sorted(waves(back + 0.01, length - back - 0.01, 0.92 * big, big, 4), key=lambda mark: mark[1])
        return [(neck, back), *middle, (neck, length - back)]


LININGS = families_of(StraightDiaphragm, Aseptic, OpenPinch, EnclosedPinch)
