"""Valves of primitives: cones, hourglasses, cylinders, balls and boxes with a spindle and what turns it."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import of_form
from cadplants.builder.params import Params, When, among, between, chance, nested, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    Plates,
    cone,
    disc,
    dish,
    lying,
    plated,
    sleeve,
    spoked,
)
from cadplants.model.family import Family, Model
from cadplants.model.plant import Turning
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import ball, box, cylinder, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PRIMITIVE_VALVES"]

_BODY = "valve body"
_BIG, _SMALL = sizes_between(25, 400), sizes_between(15, 50)
_WAIST = "radius of the waist / of the ends"


_WHEELS = ("disc", "crossed bars", "spokes")
_TURNERS = ("nothing", "nothing", *_WHEELS, "bar", "diaphragm", "box", "barrel")


class _Turner(Params):
    """What turns a spindle: nothing, a wheel, a bar, a drive."""

    form: str = among(_TURNERS, "what it is")
    wheel: float = between(0.9, 1.9, "(radius of a wheel - the next) / of the pipe", when=of_form(*_WHEELS))
    rim: float = between(0.02, 0.06, "what that is wider by", "m", when=of_form(*_WHEELS))
    spokes: int = whole(3, 5, "spokes of a wheel", when=of_form("spokes"))
    one: bool = chance(0.5, "rim and spokes are one mesh", when=of_form("spokes"))
    reach: float = between(0.08, 0.2, "length of a bar - 2.2 radii of the pipe", "m", when=of_form("bar"))
    turn: float = among((0.0, np.pi / 2, np.pi), "which way it points", "rad", when=of_form("bar"), otherwise=0.0)
    wide: float = between(0.9, 1.7, "(radius of a drive - 30 mm) / of the pipe", when=of_form(*_TURNERS[6:]))
    high: float = between(0.8, 2.4, "(height of a drive - 50 mm) / radius of the pipe", when=of_form(*_TURNERS[6:]))
    deep: float = between(1.0, 2.0, "depth of a box / half its width", when=of_form("box"))
    crossed: bool = chance(0.5, "a level cylinder on the barrel", when=of_form("barrel"))

    def build(self, t: Table, z: float) -> None:
        """Puts it on a spindle about z that ends at a height [m]."""
        r = t.pipe.radius
        if self.form == "bar":
            reach = 2.2 * r + self.reach
            bar = box((reach, max(0.012, 0.2 * r), max(0.005, 0.08 * r)), (0.45 * reach, 0, z))
            bar = moved(bar, spun("z", self.turn))
            t.bundled("lever").add("lever", bar, own=True, turns=Turning("lever"))
        elif self.form in _TURNERS[6:]:
            t.bundled("actuator").add("actuator", self._drive(t, z), of="valve")
        for some in self._wheels(t, z, r * self.wheel + self.rim):
            t.bundled("handwheel").add("handwheel", *some, own=True, turns=Turning("handwheel"))

    def _wheels(self, t: Table, z: float, wheel: float) -> list[list[Solid]]:
        """The meshes of a wheel, each of its solids."""
        thick = max(0.005, 0.09 * wheel)
        if self.form == "disc":
            return [[disc(wheel, z - thick, z + thick, t.style)]]
        if self.form == "crossed bars":
            rim = moved(torus(wheel, thick, int(min(t.n(wheel), 24)), 6), at(0, 0, z))
            bars = [moved(box((2 * wheel, thick, thick)), at(0, 0, z) @ spun("z", turn)) for turn in (0.0, np.pi / 2)]
            return [[rim, *bars]]
        if self.form == "spokes":
            lifted = [moved(one, at(0, 0, z - thick)) for one in spoked(wheel, thick, self.spokes, t.style)]
            return [lifted] if self.one else [[one] for one in lifted]
        return []

    def _drive(self, t: Table, z: float) -> Solid:
        r, style = t.pipe.radius, t.style
        wide, high = r * self.wide + 0.03, r * self.high + 0.05
        if self.form == "diaphragm":
            return merge([disc(wide, z, z + 0.3 * high, style), dish(wide, 0.5 * high, z + 0.3 * high, style)])
        if self.form == "box":
            return box((2 * wide, self.deep * wide, high), (0, 0, z + high / 2))
        barrel = disc(0.6 * wide, z, z + high, style)
        if not self.crossed:
            return barrel
        return merge([barrel, lying(disc(0.4 * wide, -1.4 * wide, 1.4 * wide, style), 0, 0, z + 0.5 * high)])


class _Top(Params):
    """A spindle over the middle of a body and what turns it."""

    rise: float = between(0.8, 2.2, "(height of the spindle - the next) / radius of the pipe")
    over: float = between(0.03, 0.16, "what it is higher by", "m")
    stem: float = between(0.12, 0.4, "(radius of the spindle - 3 mm) / of the pipe")
    hooded: bool = chance(0.25, "a cone round its foot")
    hood: float = between(0.6, 1.0, "radius of that cone / of the pipe", when=lambda p: p.hooded)
    turner: _Turner = nested(_Turner, "what turns it")

    def build(self, t: Table, x: float, low: float = 0.0) -> None:
        """Puts it down at a place along the line, from a height up [m]."""
        r, t = t.pipe.radius, t.at(x)
        rise, stem = low + r * self.rise + self.over, r * self.stem + 0.003
        if self.hooded:
            t.add("valve bonnet", cone(r * self.hood, stem, low, low + 0.5 * (rise - low), t.style))
        t.add("valve stem", disc(stem, low, rise, t.style))
        self.turner.build(t, rise)


def _flanged(when: When | None = None) -> float:
    said = "radius of its ends: 0 of the pipe, 1 of the flange"
    return among((0.1, 0.4, 0.6, 0.8, 1.0), said, when=when, otherwise=0.0)


def _screwed() -> float:
    return among((1.0, 1.0, 1.15, 1.4), "radius of its ends / of the pipe")


def _no_plates() -> Plates:
    return plated(lambda _: False)


def _top() -> _Top:
    return nested(_Top, "spindle")


def _called() -> str:
    return among(("gate valve", "globe valve", "ball valve", "valve"), "what it is taken for")


class _Valve(Device, place="inline", group="Valve assembly", label="valve", bundle=_BODY):
    """A valve of primitives."""

    joint: ClassVar[str] = "flanged"

    length: float = between(0.8, 1.5, "(face to face - the next) / outside of the flange")
    more: float = between(0.0, 0.08, "what that is longer by", "m")

    def face_to_face(self, t: Table) -> float:
        """Its length [m]."""
        return round(t.flange.outer * self.length + self.more, 6)

    def radius(self, t: Table, wide: float) -> float:
        """Radius of its ends [m]."""
        r = t.pipe.radius
        return r * wide if self.joint == "welded" else r + (t.flange.outer / 2 - r) * wide


class TwoCones(_Valve, name="valve/two cones", weight=4):
    """Two cones point to point or nearly so, each a piece of its own, and a spindle."""

    wide: float = _flanged()
    waist: float = among((0.0, 0.12, 0.3, 0.5), _WAIST)
    plates: Plates = plated()
    top: _Top = _top()
    called: str = _called()

    def build(self, t: Table) -> Model:
        length = self.face_to_face(t)
        wide = self.radius(t, self.wide)
        waist, plates = wide * self.waist, self.plates.solids(t, length) if self.plates else []
        t.add(_BODY, lying(cone(wide, waist, 0.0, length / 2, t.style)), *plates[:1])
        t.add(_BODY, lying(cone(waist, wide, length / 2, length, t.style)), *plates[1:])
        self.top.build(t, length / 2)
        return t.model(length, self.joint, self.called, split=True)


class SmallTwoCones(TwoCones, name="valve/small two cones", sizes=_SMALL, weight=1.5):
    """Likewise, to be screwed or welded in."""

    joint = "welded"

    wide: float = _screwed()
    plates: Plates = _no_plates()


class _Waisted(_Valve):
    """A body with a waist as one surface of revolution."""

    wide: float = _flanged()
    waist: float = between(0.15, 0.6, _WAIST)
    flat: float = among((0.0, 0.06, 0.15), "length of a straight end / face to face")
    plates: Plates = plated()

    def body(self, t: Table) -> list[Solid]:
        """The solids of its body."""
        length, wide = self.face_to_face(t), self.radius(t, self.wide)
        flat = length * self.flat
        ends = [(wide, 0.0), (wide, flat)][: 2 if flat else 1]
        outline = [*ends, (wide * self.waist, length / 2), *((r, length - x) for r, x in ends[::-1])]
        return [lying(turned(outline, t.n(wide))), *(self.plates.solids(t, length) if self.plates else [])]


class Hourglass(_Waisted, name="valve/hourglass", weight=3):
    """A body with a waist as one surface of revolution, and a spindle."""

    top: _Top = _top()
    called: str = _called()

    def build(self, t: Table) -> Model:
        length = self.face_to_face(t)
        t.add(_BODY, *self.body(t))
        self.top.build(t, length / 2)
        return t.model(length, self.joint, self.called)


class SmallHourglass(Hourglass, name="valve/small hourglass", sizes=_SMALL, weight=1.5):
    """Likewise, to be screwed or welded in."""

    joint = "welded"

    wide: float = _screwed()
    plates: Plates = _no_plates()


class Barrel(_Valve, name="valve/cylinder", weight=2):
    """A cylinder along the line; at times nothing else."""

    share: float = between(0.5, 1.0, "its length / that face to face")
    wide: float = _flanged()
    bare: bool = chance(0.3, "no spindle")
    inside: bool = chance(0.5, "the spindle begins at the axis", when=lambda p: not p.bare)
    top: _Top = nested(_Top, "spindle", when=lambda p: not p.bare)
    called: str = _called()

    def build(self, t: Table) -> Model:
        length, wide = self.face_to_face(t) * self.share, self.radius(t, self.wide)
        t.add(_BODY, lying(disc(wide, 0.0, length, t.style)))
        if not self.bare:
            self.top.build(t, length / 2, 0.0 if self.inside else 0.9 * wide)
        return t.model(length, self.joint, self.called)


class SmallBarrel(Barrel, name="valve/small cylinder", sizes=_SMALL, weight=1.0):
    """Likewise, to be screwed or welded in."""

    joint = "welded"

    wide: float = _screwed()


class Ball(_Valve, name="valve/ball of primitives", weight=2):
    """A ball on a cylinder along the line, between two discs or none."""

    neck: float = among((1.0, 1.1, 1.3), "radius of the cylinder / of the pipe")
    wide: float = between(1.3, 1.9, "radius of the ball / of the pipe")
    plates: Plates = plated()
    top: _Top = _top()

    def build(self, t: Table) -> Model:
        length, r = self.face_to_face(t), t.pipe.radius
        wide = min(0.48 * length, r * self.wide)
        plates = self.plates.solids(t, length) if self.plates else []
        middle = moved(ball(wide, t.n(wide)), at(length / 2))
        t.add(_BODY, lying(disc(r * self.neck, 0.0, length, t.style)), middle, *plates)
        self.top.build(t, length / 2, 0.5 * wide)
        return t.model(length, self.joint, "ball valve")


class SmallBall(Ball, name="valve/small ball", sizes=_SMALL, weight=1.0):
    """Likewise, to be screwed or welded in."""

    joint = "welded"

    plates: Plates = _no_plates()


class Block(_Valve, name="valve/block"):
    """A box with a spindle, between ends of pipe."""

    long: float = between(0.35, 0.8, "length of the box / face to face")
    wide: float = between(2.2, 3.2, "its width / radius of the pipe")
    high: float = between(2.2, 3.4, "its height / radius of the pipe")
    ends: float = among((1.0, 1.2), "radius of its ends / of the pipe")
    top: _Top = _top()
    called: str = _called()

    def build(self, t: Table) -> Model:
        length, r = self.face_to_face(t), t.pipe.radius
        size = (length * self.long, r * self.wide, r * self.high)
        t.add(_BODY, lying(disc(r * self.ends, 0.0, length, t.style)), box(size, (length / 2, 0, 0)))
        self.top.build(t, length / 2, 0.45 * size[2])
        return t.model(length, self.joint, self.called)


class ThreeCones(_Valve, name="valve/three cones", weight=2):
    """Two cones with an upright cylinder or a third cone where they meet."""

    wide: float = _flanged()
    high: float = between(0.9, 1.6, "height of what stands on them / radius of the ends")
    flared: bool = chance(0.6, "that is a cone")
    hood: float = among((0.5, 0.9), "its radius at the top / of the ends", when=lambda p: p.flared, otherwise=0.0)
    top: _Top = _top()

    def build(self, t: Table) -> Model:
        length, wide, style = self.face_to_face(t), self.radius(t, self.wide), t.style
        waist, high = 0.5 * wide, wide * self.high
        cones = [(wide, waist, 0.0, length / 2), (waist, wide, length / 2, length)]
        t.add(_BODY, *(lying(cone(*one, style)) for one in cones))
        hood = cone(waist, wide * self.hood, 0.0, high, style) if self.flared else disc(waist, 0, high, style)
        t.at(length / 2).add("valve bonnet", hood)
        self.top.build(t, length / 2, 0.9 * high)
        return t.model(length, self.joint, "globe valve")


class ConesAndDish(
    Device,
    name="valve/cones and dish",
    place="inline",
    group="Valve assembly",
    label="valve",
    bundle=_BODY,
    sizes=_BIG,
    weight=1.5,
):
    """Two cones, a spindle and a dish or a barrel over it."""

    body: _Waisted = nested(_Waisted, "body", fixed=lambda p: {"dn": p.dn})
    rise: float = between(0.1, 0.25, "height of the spindle - 2.2 radii of the pipe", "m")
    wide: float = between(0.04, 0.12, "radius of the dish - 1.6 of the pipe", "m")

    def build(self, t: Table) -> Model:
        r, length, style = t.pipe.radius, self.body.face_to_face(t), t.style
        rise, wide = 2.2 * r + self.rise, 1.6 * r + self.wide
        t.add(_BODY, *self.body.body(t))
        top = t.at(length / 2)
        top.add("valve stem", disc(0.2 * r + 0.004, 0.0, rise, style))
        drive = [disc(wide, rise, rise + 0.02, style), dish(wide, 0.5 * wide, rise + 0.02, style)]
        top.bundled("actuator").add("actuator", *drive, of="valve")
        return t.model(length, kind="control valve")


class Tower(_Valve, name="valve/tower on yoke", sizes=sizes_between(15, 100), weight=1.5):
    """A process valve in one mesh: one or two turned chambers, a yoke of two bars, a cylinder drive as tall as wide."""

    joint = "welded"

    chambers: int = whole(1, 2, "chambers over each other; the upper one stands on the line's own")
    wide: float = between(1.3, 2.0, "radius of a chamber / of the pipe")
    round_: bool = chance(0.5, "the chambers swell in the middle")
    yoke: float = between(0.03, 0.1, "height of the yoke", "m")
    bars: bool = chance(0.6, "two flat bars; else a ring of its width")
    drive: float = between(1.4, 2.4, "(radius of the drive - 15 mm) / of the pipe")
    tall: float = between(1.5, 3.2, "height of the drive / its radius")
    stepped: float = among((0.0, 0.6, 0.85), "radius of a second step of the drive / of the first; 0: none")
    headed: bool = chance(0.4, "a short control head on the drive")
    called: str = among(("valve", "globe valve", "control valve"), "what it is taken for")

    def build(self, t: Table) -> Model:
        r, style, length = t.pipe.radius, t.style, self.face_to_face(t)
        wide = min(r * self.wide, 0.42 * length)
        low, top = -1.3 * r, 1.3 * r + (self.chambers - 1) * 2.4 * r
        swell = 1.15 * wide if self.round_ else wide
        outline = [(wide, low), (swell, 0.5 * (low + top)), (wide, top)]
        drive, foot = r * self.drive + 0.015, top + self.yoke
        solids = [turned(outline, t.n(wide)), disc(0.3 * r + 0.002, top, foot, style)]
        if self.bars:
            thick = 0.35 * wide
            bar = (thick, 0.3 * thick, self.yoke)
            solids += [box(bar, (0, side * wide, top + self.yoke / 2)) for side in (0.8, -0.8)]
        else:
            solids.append(sleeve(0.7 * wide, 0.8 * wide, top, foot, style))
        tall = drive * self.tall
        solids.append(disc(drive, foot, foot + tall, style))
        high = foot + tall
        if self.stepped:
            solids.append(disc(drive * self.stepped, high, high + 0.4 * tall, style))
            high += 0.4 * tall
        if self.headed:
            solids.append(disc(0.5 * drive, high, high + 0.6 * drive, style))
        ends = sleeve(t.pipe.bore, r, 0.0, length, style)
        t.add(_BODY, lying(ends), *(moved(one, at(length / 2)) for one in solids), of="valve")
        return t.model(length, self.joint, self.called)


class NoSpindle(_Valve, name="valve/no spindle", weight=1.5):
    """A body without a spindle: an hourglass with a bar across, a cylinder or a ball, maybe a flat lid."""

    form: str = among(("hourglass", "cone", "ball"), "its body")
    wide: float = _flanged(lambda p: p.form != "ball")
    barred: bool = chance(0.5, "a bar across the waist", when=of_form("hourglass"))
    plates: Plates = plated()
    lidded: bool = chance(0.4, "a flat lid")

    def build(self, t: Table) -> Model:
        length, wide, r, style = self.face_to_face(t), self.radius(t, self.wide), t.pipe.radius, t.style
        if self.form == "hourglass":
            solids = [lying(turned([(wide, 0.0), (0.4 * wide, length / 2), (wide, length)], t.n(wide)))]
            if self.barred:
                solids.append(moved(disc(0.15 * r, -wide, wide, style), at(length / 2)))
        elif self.form == "cone":
            solids = [lying(cone(wide, 0.6 * wide, 0.0, length, style))]
        else:
            solids = [lying(disc(r, 0.0, length, style)), moved(ball(1.4 * r, t.n(1.4 * r)), at(length / 2))]
        t.add(_BODY, *solids, *self.plates.solids(t, length))
        if self.lidded:
            t.at(length / 2).add("valve bonnet", disc(0.8 * r, 0.6 * r, 1.4 * r + 0.01, style))
        return t.model(length, kind="check valve")


class ThinCylinder(
    Device,
    name="valve/thin cylinder",
    place="inline",
    group="Valve assembly",
    label="valve",
    bundle=_BODY,
    sizes=sizes_between(40, 400),
    weight=1.5,
):
    """A thin cylinder between the flanges, a spindle on it, a box, wheel or bar on top."""

    length: float = between(0.6, 1.2, "4 (face to face - 30 mm) / outside of the pipe")
    wide: float = between(0.92, 1.0, "its radius / of the raised face")
    neck: float = between(0.05, 0.12, "of the spindle over the body", "m")
    geared: bool = chance(0.4, "a box with a wheel on top")
    levered: bool = chance(0.7, "a bar on top", when=lambda p: not p.geared)
    reach: float = between(0.1, 0.25, "length of the bar - radius of the body", "m", when=lambda p: p.levered)

    def build(self, t: Table) -> Model:
        length, style = round(0.03 + 0.25 * t.pipe.outer * self.length, 6), t.style
        wide = t.flange.raised / 2 * self.wide
        t.add(_BODY, lying(disc(wide, 0.0, length, style)))
        above, top = t.at(length / 2), wide + 0.04
        above.add("valve stem", disc(min(0.3 * length, 0.012 + 0.1 * wide), 0.8 * wide, wide + self.neck, style))
        if self.geared:
            gear = box((0.9 * wide, 0.6 * wide + 0.02, 0.06), (0, 0.2 * wide, top + 0.03))
            above.bundled("gearbox").add("gearbox", gear)
            wheel = above.at(0, 0.6 * wide, top + 0.03).spun("x", -np.pi / 2).bundled("handwheel")
            wheel.add("handwheel", disc(0.6 * wide + 0.03, 0, 0.015, style), own=True)
        elif self.levered:
            reach = wide + self.reach
            bar = box((reach, 0.025, 0.008), (0.45 * reach, 0, top + 0.04))
            above.bundled("lever").add("lever", bar, own=True)
        return t.model(length, "wafer", "butterfly valve")


class Tripod(_Valve, name="valve/tripod of cones", weight=0.7):
    """Three cones point to point, the third upright, and a spindle or none."""

    wide: float = _flanged()
    down: float = among((0.0, np.pi), "which way the third looks: up, or down under a spindle", "rad")
    top: _Top = nested(_Top, "spindle", when=lambda p: p.down)

    def build(self, t: Table) -> Model:
        length, wide, style = self.face_to_face(t), self.radius(t, self.wide), t.style
        waist = 0.25 * wide
        third = moved(cone(waist, wide, 0.0, length / 2, style), at(length / 2) @ spun("x", self.down))
        cones = [(wide, waist, 0.0, length / 2), (waist, wide, length / 2, length)]
        t.add(_BODY, *(lying(cone(*one, style)) for one in cones), third)
        if self.down:
            self.top.build(t, length / 2)
        return t.model(length, kind="three-way valve")


class AngleCones(
    Device,
    name="valve/angle cones",
    place="head",
    group="Valve assembly",
    label="valve",
    bundle=_BODY,
    weight=1.5,
):
    """Two cones at a right angle and a tall cylinder over them: a relief valve on a flange."""

    wide: float = _flanged()
    reach: float = between(0.7, 1.1, "from the face to the axis / outside of the flange")
    tower: float = between(2.0, 4.0, "height of the cylinder / radius of the ends")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        wide, reach = r + (t.flange.outer / 2 - r) * self.wide, t.flange.outer * self.reach
        waist = 0.3 * wide
        t.add(_BODY, lying(cone(wide, waist, 0.0, reach, style)))
        t.at(reach).add(_BODY, cone(waist, 1.2 * wide, 0.0, reach, style))
        t.add("valve bonnet", lying(disc(0.7 * wide, 0.0, self.tower * wide, style), reach))
        return t.model(kind="relief valve")


class OnOutlet(
    Device, name="valve/on outlet", place="tap", group="Valve assembly", label="valve", bundle=_BODY, weight=1.5
):
    """A small valve upright on an outlet: two cones or a cylinder, a spindle to the side, a stub or a plug on top."""

    high: float = between(0.05, 0.12, "height", "m")
    wide: float = between(0.012, 0.024, "radius of its ends", "m")
    waisted: bool = chance(0.5, "two cones, not a cylinder")
    side: float = among((1.0, -1.0), "which side its spindle is on")
    stubbed: bool = chance(0.6, "a piece of pipe on top")
    stub: float = between(0.02, 0.15, "length of that", "m", when=lambda p: p.stubbed)
    called: str = among(("drain valve", "vent valve"), "what it is taken for")

    def build(self, t: Table) -> Model:
        high, wide, style = self.high, self.wide, t.style
        outline = [(wide, 0.0), (0.3 * wide, high / 2), (wide, high)]
        t.add(_BODY, turned(outline, t.n(wide)) if self.waisted else disc(wide, 0.0, high, style))
        aside = t.at(0, 0, high / 2).spun("x", self.side * np.pi / 2)
        aside.add("valve stem", disc(0.35 * wide, 0.0, 3 * wide, style))
        if self.stubbed:
            t.add("pipe", disc(0.6 * wide, high, high + self.stub, style))
        return t.model(kind=self.called)


class Melted(
    Device,
    name="valve/melted",
    place="inline",
    group="Valve assembly",
    label="valve",
    bundle="valve",
    sizes=_SMALL,
    weight=1.5,
):
    """Body, bonnet and wheel or bar as one closed surface about the spindle, with screwed ends: never in pieces."""

    length: float = between(1.8, 2.8, "(length - 20 mm) / outside of the pipe")
    sides: int = among((6, 8, 0), "sides of its ends; 0: round")
    wide: float = between(1.2, 1.5, "radius of its ends / of the pipe")
    hub: float = between(0.9, 1.3, "radius of its bonnet / of the pipe")
    rise: float = between(1.8, 3.0, "height of its spindle / radius of the pipe")
    wheeled: bool = chance(0.5, "a wheel, not a bar")
    wheel: float = between(1.2, 2.2, "(radius of its wheel - 10 mm) / of the pipe", when=lambda p: p.wheeled)
    reach: float = between(0.04, 0.1, "length of the bar - 2.5 radii of the pipe", "m", when=lambda p: not p.wheeled)
    called: str = among(("ball valve", "gate valve", "globe valve"), "what it is taken for")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        length, hub, stem = round(t.pipe.outer * self.length + 0.02, 6), r * self.hub, 0.25 * r + 0.002
        rise, wheel = r * self.rise, r * self.wheel + 0.01
        outline = [(hub, -hub), (hub, 0.55 * rise), (stem, 0.7 * rise), (stem, rise)]
        if self.wheeled:
            upright = turned([*outline, (wheel, rise), (wheel, rise + 0.15 * wheel)], t.n(wheel))
        else:
            reach = 2.5 * r + self.reach
            bar = box((reach, 0.6 * r, 0.2 * r), (0.4 * reach, 0, rise))
            upright = merge([turned(outline, t.n(hub)), bar])
        across = cylinder(r * self.wide, 0.0, length, self.sides or t.n(1.3 * r))
        t.add("valve", lying(across), moved(upright, at(length / 2)), of="valve")
        return t.model(length, "welded", self.called)


PRIMITIVE_VALVES: tuple[Family, ...] = families_of(
    TwoCones,
    Hourglass,
    Barrel,
    Ball,
    Block,
    ThreeCones,
    ConesAndDish,
    Tower,
    NoSpindle,
    ThinCylinder,
    Tripod,
    SmallTwoCones,
    SmallHourglass,
    SmallBarrel,
    SmallBall,
    Melted,
    AngleCones,
    OnOutlet,
)
