"""What holds things: supports, clamps and hangers of lines, brackets, gussets, loose fasteners."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import (
    Carrier,
    Fitting,
    radius,
    shuffled,
    slab_yz,
    strap,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, about_x, extrude, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, CORNERS, along, box, cylinder, hexagon, ring, rod, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["CONNECTIONS"]

_PALM = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def _across(section: Floats, low: float, high: float) -> Solid:
    """A bar along y between two places [m]."""
    return moved(extrude(section, low, high), _PALM)


class _Below(Params):
    """What a support stands on: a post or column with a head plate, a beam on posts, a pillar."""

    free: float = given(1.0, "height of the support over the floor", "m")
    form: str = among(("post", "column", "beam", "pillar"), "what it is; a sleeper where it is low")
    side: float = among((0.06, 0.08, 0.1), "width of the post", "m", when=lambda p: _is(p, "post"))
    channel: bool = chance(0.5, "the beam is a channel", when=lambda p: _is(p, "beam"))

    def build(self, t: Table, top: float, half: float) -> None:
        """Puts it down.

        Args:
            t: with the frame.
            top: height of the level face on it [m].
            half: half the support's width across the line [m].
        """
        low = top - self.free
        if self.free < 0.12:
            t.add("foundation", box((0.25, 2 * half + 0.3, self.free), (0, 0, (low + top) / 2)))
        elif self.form == "pillar":
            t.add("foundation", extrude(rounded_rectangle(0.22, 2 * half + 0.12, 0.02, 2), low, top))
        elif self.form == "beam":
            span = half + 0.25
            section = section_i(0.08, 0.08, 0.006, 0.008)
            if self.channel:
                section = section_channel(0.08, 0.045, 0.006, 0.008)
            t.at(0, 0, top - 0.04).add("beam", _across(section, -span, span))
            post = extrude(rounded_rectangle(0.06, 0.06, 0.006, 2), low, top - 0.08)
            for s in BOTH:
                t.at(0, s * (span - 0.05)).add("post", post)
        else:
            square = self.form == "post"
            thick, wide, side = (0.012, 2.2 * self.side, 0.2) if square else (0.015, 0.2, 0.16)
            section = section_i(0.1, 0.1, 0.006, 0.008)
            if square:
                section = rounded_rectangle(self.side, self.side, 0.1 * self.side, 2)
            t.add(self.form, extrude(section, low + thick, top - 0.01))
            t.add("base plate", box((wide, wide, thick), (0, 0, low + thick / 2)))
            t.add("plate", box((side, 2 * half + 0.06, 0.01), (0, 0, top - 0.005)))


def _is(p: Any, form: str) -> bool:
    return bool(p.free >= 0.12 and p.form == form)


def _standing(depth: Callable[[Any], float], when: Any = None) -> _Below:
    """A field: what a carrier stands on, whose underside is this far below the line's axis [m]."""
    return nested(_Below, "what it stands on", fixed=lambda p: {"free": p.height - depth(p)}, when=when)


class UBolt(Carrier, name="u-bolt/support", label="u-bolt", bundle="u-bolt", weight=2):
    """A line on a beam or post, held by a U-bolt with nuts (DIN 3570)."""

    below: _Below = _standing(radius)

    def build(self, t: Table) -> Model:
        r, top = t.pipe.radius, -t.pipe.radius
        bar, a = 0.004 + 0.03 * r, np.linspace(0, np.pi, 11)
        leg = r + bar
        bow = np.column_stack([np.zeros(11), leg * np.cos(a), leg * np.sin(a)])
        path = np.vstack([[0, leg, top - 0.03], bow, [0, -leg, top - 0.03]])
        t.add("u-bolt", sweep(path, circle(bar, 10), up=(1.0, 0.0, 0.0)))
        for s in BOTH:
            t.at(0, s * leg).add("nut", hexagon(3.4 * bar, top - 0.0125 - 1.6 * bar, top - 0.0125))
        self.below.build(t, top, leg + bar)
        return t.model()


def _half_clamp(inner: float, outer: float, width: float, n: int, ear: float) -> Solid:
    """The upper half of a band round a pipe along x with two flat ears [m]."""
    a = np.linspace(0.02, np.pi - 0.02, max(9, n // 2 + 1))
    unit, tip, thick = np.column_stack([np.cos(a), np.sin(a)])[1:-1], outer + ear, outer - inner
    left = outline(-tip, thick, -tip, 0.001, -inner, 0.001)
    shape = np.vstack([[(tip, thick)], outer * unit, left, inner * unit[::-1], [(inner, 0.001), (tip, 0.001)]])
    return slab_yz(shape, -width / 2, width / 2)


class TwoHalf(Carrier, name="clamp/two-half", label="clamp", bundle="clamp", weight=2):
    """A two-half pipe clamp (DIN 3567), with a rubber lining or without, bolted on a support or on a rod."""

    lined: bool = chance(0.5, "lined with rubber")
    supported: bool = chance(0.5, "on a support, not on a rod")
    below: _Below = _standing(
        lambda p: radius(p) + (0.004 if p.lined else 0.0) + 0.003 + 0.02 * radius(p), when=lambda p: p.supported
    )

    def build(self, t: Table) -> Model:
        r, n = t.pipe.radius, t.n(t.pipe.radius)
        inner = r + (0.004 if self.lined else 0.0)
        thick, width, ear = 0.003 + 0.02 * r, 0.025 + 0.15 * r, 0.02 + 0.15 * r
        half = _half_clamp(inner, inner + thick, width, n, ear)
        t.add("clamp", half)
        t.spun("x", np.pi).add("clamp", half)
        if self.lined:
            t.along("x").add("clamp", ring(r, inner, -0.55 * width, 0.55 * width, n), of="rubber")
        shank, flats = cylinder(0.003 + 0.01 * r, -0.02, 0.02, 8), 0.012 + 0.03 * r
        hexagons = [hexagon(flats, z, z + 0.006) for z in (thick, -thick - 0.006)]
        for s in BOTH:
            t.at(0, s * (inner + thick + 0.55 * ear)).add("bolt", shank, *hexagons)
        top, low = -inner - thick, -self.height
        if self.supported:
            self.below.build(t, top, inner + thick + ear)
        else:
            t.add("stud", cylinder(0.006, low + 0.008, top + 0.001, 8), own=False, fine=False)
            foot = box((0.1, 0.06, 0.008), (0, 0, low + 0.004))
            t.add("bracket", foot, hexagon(0.02, low + 0.008, low + 0.02), own=False)
        return t.model()


class _Bracket(Carrier, label="bracket", bundle="bracket"):
    """What carries a line."""


class Shoe(_Bracket, name="bracket/shoe"):
    """A pipe shoe: a T or a saddle under the pipe, sliding on a beam; with gussets."""

    ribbed: bool = chance(0.6, "gussets")
    below: _Below = _standing(lambda p: 1.3 * radius(p) + 0.06)

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        tall, length = 0.06 + 0.3 * r, 0.15 + 0.8 * r
        top = -r - tall
        web = box((length, 0.008, tall + 0.02), (0, 0, -r - tall / 2 + 0.006))
        t.add("bracket", web, box((length, 0.08 + 0.8 * r, 0.008), (0, 0, top + 0.004)))
        if self.ribbed:
            rib = extrude(np.array([[0, 0], [0.03 + 0.3 * r, 0], [0, tall - 0.01]]), -0.004, 0.004)
            for x in (-0.35 * length, 0.35 * length):
                for turn in (0.5, -0.5):
                    foot = t.at(x, 0, top + 0.008).spun("z", turn * np.pi).spun("x", np.pi / 2)
                    foot.at(0.004).add("gusset plate", rib)
        self.below.build(t, top, 0.05 + 0.5 * r)
        return t.model()


class Stand(_Bracket, name="bracket/stand"):
    """An adjustable pipe stand: a cradle on a threaded rod in a tube with a foot plate (MSS SP-58 type 38)."""

    def build(self, t: Table) -> Model:
        r, n, low = t.pipe.radius, t.n(t.pipe.radius), -self.height
        a, thick = np.linspace(1.15 * np.pi, 1.85 * np.pi, 9), 0.004 + 0.02 * r
        unit = np.column_stack([np.cos(a), np.sin(a)])
        shell = extrude(np.vstack([(r + thick) * unit, r * unit[::-1]]), -0.6 * r - 0.03, 0.6 * r + 0.03)
        t.add("bracket", about_x(shell))
        top = -r - 0.5 * thick
        middle = (top + low) / 2
        nut = hexagon(0.04 + 0.25 * r, middle + 0.03, middle + 0.05 + 0.1 * r)
        t.add("stud", cylinder(0.01 + 0.08 * r, middle, top, 10), nut, fine=False)
        t.add("post", cylinder(0.018 + 0.16 * r, low + 0.01, middle + 0.03, max(8, n)))
        t.add("base plate", box((0.16 + r, 0.16 + r, 0.01), (0, 0, low + 0.005)))
        return t.model()


class RodHanger(Carrier, name="pipe hanger/rod", label="pipe hanger", bundle="pipe hanger", weight=1.5):
    """A clevis or ring hanger on a rod from a beam above (MSS SP-58 types 1 and 10)."""

    drop: float = between(0.25, 0.8, "from the hanger to the beam", "m")
    clevis: bool = chance(0.5, "a clevis, not a ring")
    legs: bool = chance(0.5, "the beam is on legs")

    def build(self, t: Table) -> Model:
        r, n = t.pipe.radius, t.n(t.pipe.radius)
        wide, thick, top = 0.02 + 0.1 * r, 0.003 + 0.01 * r, 1.5 * r + 0.03
        high = top + self.drop
        if self.clevis:
            a, out, knee = np.linspace(np.pi, 2 * np.pi, 11), r + thick / 2, 0.7 * r + 0.01
            low = np.column_stack([np.zeros(11), out * np.cos(a), out * np.sin(a)])
            t.add("pipe hanger", strap(np.vstack([[0, -out, knee], low, [0, out, knee]]), wide, thick))
            out = r + 1.6 * thick
            side = outline(out, 0.4 * r, out, 0.9 * r + 0.01, 0.3 * r, top)
            over = [*([0, -y, z] for y, z in side), *([0, y, z] for y, z in side[::-1])]
            t.add("pipe hanger", strap(over, wide, thick))
            pin = cylinder(0.004 + 0.01 * r, -r - 0.02, r + 0.02, 8)
            t.at(0, 0, 0.55 * r + 0.005).along("y").add("bolt", pin)
        else:
            knob = [cylinder(0.008, r + thick * 0.5, top, 8), hexagon(0.02, top - 0.012, top)]
            t.add("pipe hanger", along("x", ring(r, r + thick, -wide / 2, wide / 2, n)), *knob)
        t.add("stud", cylinder(0.005 + 0.01 * r, top - 0.02, high, 8), fine=False)
        flats = 0.018 + 0.02 * r
        t.add("nut", hexagon(flats, top + 0.002, top + 0.012), hexagon(flats, high - 0.012, high))
        t.at(0, 0, high + 0.06).add("beam", _across(section_i(0.12, 0.08, 0.005, 0.008), -0.5, 0.5))
        if self.legs:
            leg = extrude(rounded_rectangle(0.08, 0.08, 0.006, 2), -self.height, high)
            for s in BOTH:
                t.at(0, s * 0.45).add("column", leg)
        return t.model()


class WallBracket(_Bracket, name="bracket/wall"):
    """A cantilever bracket with a brace on a wall or column beside the line."""

    reach: float = between(0.15, 0.35, "from the line's side to the wall or column", "m")
    wall: bool = chance(0.5, "on a wall, not a column")

    def build(self, t: Table) -> Model:
        r, low = t.pipe.radius, -self.height
        reach, middle = r + self.reach, -r - 0.13 - 0.15 * r
        angle = extrude(section_angle(0.05, 0.005), 0.0, reach + r + 0.05)
        arm = moved(angle, at(-0.02, reach, -r - 0.05) @ spun("x", np.pi / 2))
        t.add("bracket", arm, box((0.12, 0.01, 0.35 + 0.4 * r), (0, reach + 0.003, middle)))
        t.add("bracket", strap([[0, reach - 0.01, -r - 0.25 - 0.3 * r], [0, -r * 0.3, -r - 0.045]], 0.04, 0.008))
        head, y = hexagon(0.02, 0.0, 0.01), reach - 0.002
        t.add("bolt", *(along("-y", head, sx * 0.04, y, middle + sz * 0.12) for sx, sz in CORNERS), own=False)
        if self.wall:
            t.add("wall", box((0.3, 0.2, 0.5 - low), (0, reach + 0.108, (0.5 + low) / 2)))
        else:
            t.at(0, reach + 0.088).add("column", extrude(section_i(0.16, 0.15, 0.006, 0.009), low, 0.5))
        return t.model()


_M = (0.006, 0.008, 0.01, 0.012, 0.016, 0.02, 0.024, 0.03)  # m, ISO 261 coarse threads
_LOOSE = ("hex", "socket", "nut", "washer", "stud", "countersunk", "eye", "set", "flange nut")


def _thread(d: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A shank, with ridges for a thread where the style models every piece."""
    if style.fasteners != "pieces" or high - low < 3 * d * 0.3:
        return cylinder(d / 2, low, high, max(6, min(16, style.round(d))))
    count = int(min(24, (high - low) / (0.15 * d)))
    step = (high - low) / count
    ridges = [p for k in range(count) for p in ((0.43 * d, low + k * step), (0.5 * d, low + (k + 0.5) * step))]
    return turned([*ridges, (0.43 * d, high)], 12)


class Loose(Fitting, name="fastener/loose", label="bolt", weight=1.5):
    """Fasteners on a plate: bolts (ISO 4014), socket screws (ISO 4762), nuts (ISO 4032), washers, studs, eye bolts."""

    size: float = among(_M, "diameter of the threads", "m")
    long: float = between(2.0, 5.0, "length of a bolt / diameter")
    kinds: tuple[str, ...] = shuffled(_LOOSE, "fasteners; the first are there")
    count: int = whole(4, 7, "fasteners that are there")

    def build(self, t: Table) -> Model:
        d, top = self.size, 0.02
        for k, kind in enumerate(self.kinds[: self.count]):
            name, solids = self._piece(kind, d, self.long * d, t)
            t.at(k * 3.2 * d, 0, top).add(name, *solids, fine=False)
        x = self.count * 3.2 * d
        t.add("plate", box((x + 0.05, 8 * d, top), (x / 2 - 1.6 * d, 0, top / 2)))
        return t.model()

    @staticmethod
    def _piece(kind: str, d: float, length: float, t: Table) -> tuple[str, list[Solid]]:
        """Its name and its solids, upright on z = 0."""
        n, style = t.n(d, 8, 24), t.style
        if kind == "hex":
            low = 0.6 * d + 0.4 * length
            shank = [cylinder(0.5 * d, 0.6 * d, low, n), _thread(d, low, 0.6 * d + length, style)]
            return "bolt", [hexagon(1.5 * d, 0.0, 0.65 * d), *shank]
        if kind == "socket":
            head = extrude(circle(0.75 * d, n), 0.5 * d, 1.0 * d, (circle(0.45 * d, 6),))
            return "screw", [head, cylinder(0.75 * d, 0.0, 0.5 * d, n), _thread(d, 0.95 * d, d + length, style)]
        if kind == "nut":
            return "nut", [hexagon(1.5 * d, 0.0, 0.85 * d, 0.5 * d, n)]
        if kind == "flange nut":
            return "nut", [hexagon(1.5 * d, 0.1 * d, 0.95 * d, 0.5 * d, n), ring(0.5 * d, 1.05 * d, 0.0, 0.15 * d, n)]
        if kind == "washer":
            return "washer", [ring(0.54 * d, 1.0 * d, 0.0, 0.16 * d, n)]
        if kind == "stud":
            return "stud", [_thread(d, 0.0, 1.6 * length, style)]
        if kind == "countersunk":
            return "screw", [turned(outline(0.95 * d, 0, 0.5 * d, 0.5 * d), n), _thread(d, 0.45 * d, length, style)]
        if kind == "eye":
            loop = moved(torus(0.8 * d, 0.3 * d, n, 8), at(0, 0, length + 0.9 * d) @ spun("x", np.pi / 2))
            return "bolt", [loop, _thread(d, 0.0, length, style), cylinder(0.8 * d, length - 0.2 * d, length, n)]
        return "screw", [_thread(0.9 * d, 0.0, length, style)]


class Joint(Fitting, name="joint/steel", label="bolt", bundle="bolt", weight=1.5):
    """A bolted or welded steel joint: a column with a beam, an end plate or cleats, bolts, a gusset with a brace."""

    profile: str = among(("HEA 160", "HEA 200", "IPE 200"), "section of the column and the beam")
    tall: float = between(1.2, 2.2, "height of the column", "m")
    reach: float = between(0.8, 1.8, "length of the beam", "m")
    size: float = among((0.012, 0.016, 0.02), "diameter of the bolts", "m")
    side: float = between(0.15, 0.3, "of the gusset", "m")
    braced: bool = chance(0.6, "a brace")
    angle: bool = chance(0.5, "the brace is an angle, not a tube", when=lambda p: p.braced)

    def build(self, t: Table) -> Model:
        h, b, web, f = {
            "HEA 160": (0.152, 0.160, 0.006, 0.009),
            "HEA 200": (0.19, 0.2, 0.0065, 0.01),
            "IPE 200": (0.2, 0.1, 0.0056, 0.0085),
        }[self.profile]
        section, z, half, d, side = section_i(h, b, web, f), 0.7 * self.tall, h / 2, self.size, self.side
        t.add("column", extrude(section, 0.02, self.tall))
        t.add("base plate", box((b + 0.15, h + 0.15, 0.02), (0, 0, 0.01)))
        t.at(0, 0, z).add("beam", _across(section, half + 0.012, half + self.reach))
        t.add("plate", box((b + 0.02, 0.012, h + 0.1), (0, half + 0.006, z)))
        bolt = [cylinder(d / 2, -f - 0.6 * d, 0.012 + 0.9 * d, 10), hexagon(1.5 * d, 0.012, 0.012 + 0.65 * d)]
        bolt.append(hexagon(1.5 * d, -f - 0.7 * d, -f))
        for sx in BOTH:
            for sz in (-0.6, 0.0, 0.6):
                t.at(sx * 0.3 * b, half, z + sz * 0.5 * h).spun("x", -np.pi / 2).add("bolt", *bolt, fine=False)
        corner = outline(0, 0, side, 0, side, 0.25 * side, 0.25 * side, side, 0, side)
        under = t.at(0, half, z - half).spun("z", np.pi / 2).spun("x", np.pi / 2).moved(np.diag([1.0, -1.0, 1.0, 1.0]))
        under.add("gusset plate", extrude(np.array(corner), -0.005, 0.005), own=False)
        if self.braced:
            start, end = (0.005, half + 0.4 * side, z - half - 0.4 * side), (0.005, half + 0.75 * self.reach, 0.05)
            brace = rod(start, end, 0.03, t.n(0.03, 8))
            if self.angle:
                brace = sweep(np.array([start, end]), section_angle(0.06, 0.006), up=(1.0, 0.0, 0.0))
            t.add("brace", brace)
        anchor = [cylinder(0.008, -0.02, 0.06, 8), hexagon(0.024, 0.02, 0.033), ring(0.009, 0.02, 0.018, 0.021, 10)]
        for sx, sy in CORNERS:
            t.at(sx * 0.5 * (b + 0.09), sy * 0.5 * (h + 0.09)).add("bolt", *anchor)
        return t.model()


CONNECTIONS = families_of(UBolt, TwoHalf, Shoe, Stand, RodHanger, WallBracket, Loose, Joint)
