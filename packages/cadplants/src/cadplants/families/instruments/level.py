"""Level gauges beside small vessels, and level instruments on a flange."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, Dial, Gland, Housing, fine_sides
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import BEFORE, FRONT, Gauge, Vessel, put, t_handle
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["LEVEL_BUILDS"]

_NAME, _HEAD, _PAD = "level gauge", "transmitter", 0.002
_LOW, _SPAN, _MOUTH = "height of the lower nozzle", "from nozzle to nozzle", "nominal size of the nozzles"
_ASIDE, _VESSEL, _WHEEL = "from the nozzles to the gauge's axis", "vessel beside it", "wheels on its cocks, not levers"
_ELECTRONICS = "electronics"


class _Beside(Gauge, place="floor", label=_NAME, bundle=_NAME):
    """A level gauge beside what it belongs to."""


class _OnFlange(Gauge, place="head", label=_NAME, bundle=_NAME, sizes=(50, 65, 80, 100, 150)):
    """A level instrument on a flange."""


def _arms(low: float, high: float, dn: int, x: float, style: ModelingStyle) -> list[Solid]:
    """Two flanges in x = 2 mm with necks out to ``x``, their bores as open as the style has pipes."""
    return [along("x", disc_flange(dn, style, x - _PAD, bore_of(dn, style)), _PAD, 0, z) for z in (low, high)]


def _cocks(low: float, high: float, wheel: bool, style: ModelingStyle) -> list[Solid]:
    """Gauge cocks or offset valves about the z axis, their spindles away from the glass [m]."""
    if wheel:
        grip = merge([cylinder(0.03, 0.05, 0.06, fine_sides(0.03, style)), hexagon(0.012, 0.058, 0.068)])
    else:
        grip = rod((0, 0, 0.05), (0.0, 0.06, 0.05), 0.005, 8)
    spindle = along("x", merge([cylinder(0.008, 0.015, 0.055, 10), grip]))
    return [
        moved(merge([box((0.04, 0.036, 0.036)), hexagon(0.034, a, b), spindle]), at(0, 0, z))
        for z, a, b in ((low, 0.015, 0.045), (high, -0.045, -0.015))
    ]


class Magnetic(_Beside, name="level gauge/magnetic", weight=1.5):
    """A magnetic bypass indicator: a chamber with two arms, capped or flanged, a column of flags strapped to it."""

    low: float = between(0.35, 0.6, _LOW, "m")
    span: float = between(0.35, 1.1, _SPAN, "m")
    mouth: int = among((15, 20, 25), _MOUTH, "mm")
    aside: float = between(0.1, 0.15, _ASIDE, "m")
    below: float = between(0.12, 0.2, "of the chamber below the lower nozzle", "m")
    above: float = between(0.1, 0.2, "of the chamber above the upper nozzle", "m")
    flanged: bool = chance(0.6, "its ends are flanged, not capped")
    wide: float = between(0.028, 0.05, "width of the column of flags", "m")
    sending: bool = chance(0.4, "a transmitter's rod along its other side")
    housing: Housing = nested(Housing, _ELECTRONICS, fixed=lambda _: {"shape": "pot"}, when=lambda p: p.sending)
    vessel: Vessel = nested(Vessel, _VESSEL)

    def build(self, t: Table) -> Model:
        low, high, r, x, wide = self.low, self.low + self.span, 0.0302, self.aside, self.wide
        bottom, top, n = low - self.below, high + self.above, t.n(r)
        self.vessel.build(t, low, high, self.mouth)
        cap = outline(r, 0.0, 0.7 * r, 0.018, 0.2 * r, 0.022)
        if self.flanged:  # a blind flange on one round the chamber
            cap = outline(0.065, -0.036, 0.065, -0.019, 0.055, -0.019, 0.055, -0.017, 0.065, -0.017, 0.065, 0.0)
        places = ((bottom, "-z"), (top, "z"))
        # Closed by two caps; between them it is as hollow as the style has pipes.
        chamber = [ring(0.88 * r if t.style.hollow else 0.0, r, bottom, top, n)]
        chamber += [along(axis, turned(cap, n), 0, 0, z) for z, axis in places]
        plug = [cylinder(0.0107, bottom - 0.06, bottom + 0.003, 12), hexagon(0.03, bottom - 0.07, bottom - 0.05)]
        arms, aside = [moved(arm, at(-x)) for arm in _arms(low, high, self.mouth, x - 0.94 * r, t.style)], t.at(x)
        aside.add(_NAME, *chamber, *arms, *plug)
        if self.flanged:
            bolts = bolt_circle(4, 0.05, 0.012, -0.036, 0.0)
            aside.add("bolt", *(along(axis, bolts, 0, 0, z) for z, axis in places))
        y, mid, long = -r - 0.012, (low + high) / 2, high - low
        count = min(28, max(8, int(long / 0.04)))
        aside.add(CASE, box((wide, 0.024, long + 0.06), (0, y, mid)))
        size = (0.5 * wide, 0.004, 0.6 * long / count)
        flags = [box(size, (0, y - 0.0139, low + (k + 0.5) * long / count)) for k in range(count)]
        aside.add("gauge face", *flags, of="handle", front=BEFORE)
        straps = (low + 0.15 * long, mid, low + 0.85 * long)
        aside.add("clamp", *(ring(r, r + 0.002, z, z + 0.01, n) for z in straps), own=True)
        if self.sending:
            head = along("x", self.housing.solid(t.style), 0, 0, high - 0.03)
            put(aside.at(r + 0.007), _HEAD, cylinder(0.007, low, high - 0.01, 10), head)
        return t.model(kind=_NAME)


class Reflex(_Beside, name="level gauge/reflex", weight=1.5):
    """A reflex or transparent gauge: steel frames with long glasses bolted in sections, two cocks (DIN 7081 glass)."""

    sections: int = whole(1, 4, "frames one on the other")
    each: float = among((0.19, 0.25, 0.32), "height of a frame with its gap", "m")
    low: float = between(0.35, 0.6, _LOW, "m")
    mouth: int = among((15, 20, 25), _MOUTH, "mm")
    wide: float = between(0.045, 0.065, "width of a frame", "m")
    deep: float = between(0.04, 0.06, "depth of a frame", "m")
    wheel: bool = chance(0.6, _WHEEL)
    both: bool = chance(0.4, "glasses on both sides")
    drained: bool = chance(0.5, "a drain below")
    vessel: Vessel = nested(Vessel, _VESSEL)

    def build(self, t: Table) -> Model:
        low, each, wide, deep = self.low, self.each, self.wide, self.deep
        high, x = low + self.sections * each + 0.14, 0.1
        self.vessel.build(t, low, high, self.mouth)
        metal = [moved(arm, at(-x)) for arm in _arms(low, high, self.mouth, x, t.style)]
        metal += _cocks(low, high, self.wheel, t.style)
        front, back, hollow = deep / 2, -deep / 2, t.style.hollow
        frames, glasses = self._frames(hollow)
        nut = merge([cylinder(0.005, back - 0.006, front + 0.01, 8), hexagon(0.016, front, front + 0.008)])
        ys = np.linspace(-0.42, 0.42, max(3, int(each / 0.06))) * each
        nuts = [moved(nut, at(s * 0.37 * wide, y)) for s in (-1, 1) for y in ys]
        places = [low + 0.07 + (k + 0.5) * each for k in range(self.sections)]
        metal += [along("-y", one, 0, 0, z) for z in places for one in frames]
        reach = 0.48 * each  # from a frame's middle into its end
        starts, ends = [low, *(z + reach for z in places)], [*(z - reach for z in places), high]
        metal += [ring(0.006 if hollow else 0.0, 0.01, *span, 10) for span in zip(starts, ends, strict=True)]
        drain = [cylinder(0.008, low - 0.06, low, 10), hexagon(0.024, low - 0.065, low - 0.04)]
        t = t.at(x)
        t.add(_NAME, *metal, *drain[: 2 * self.drained])
        t.add("gauge glass", *(along("-y", glass, 0, 0, z) for z in places for glass in glasses), front=BEFORE)
        t.add("bolt", *(along("-y", one, 0, 0, z) for z in places for one in nuts))
        return t.model(kind=_NAME)

    def _frames(self, hollow: bool) -> tuple[list[Solid], list[Solid]]:
        """Chamber and covers of one section, and its glasses, upright in x and y about the origin."""
        wide, front, mid = self.wide, self.deep / 2, 0.2 * self.deep
        frame = rounded_rectangle(wide, 0.97 * self.each, 0.3 * wide, 3)
        slot = rounded_rectangle(0.4 * wide, 0.85 * self.each, 0.18 * wide, 3)
        frames = [extrude(frame, -mid, mid, (slot,) if hollow else ())]
        frames += [extrude(frame, -front, -mid, (slot,) if self.both else ()), extrude(frame, mid, front, (slot,))]
        glasses = [extrude(0.99 * slot, mid, front - 0.006)]
        return frames, [*glasses, *([extrude(0.99 * slot, -front + 0.006, -mid)] if self.both else [])]


class Tubular(_Beside, name="level gauge/tubular", weight=1.5):
    """A tubular gauge glass between two screwed cocks, with guard rods (13 to 20 mm)."""

    low: float = between(0.35, 0.6, _LOW, "m")
    span: float = between(0.2, 0.8, _SPAN, "m")
    vessel: Vessel = nested(Vessel, _VESSEL)
    aside: float = between(0.05, 0.09, _ASIDE, "m")
    radius: float = between(0.0065, 0.01, "of the glass", "m")
    wheel: bool = chance(0.5, _WHEEL)
    guarded: bool = chance(0.75, "guard rods")
    bars: int = among((2, 3, 4), "guard rods", when=lambda p: p.guarded, otherwise=0)

    def build(self, t: Table) -> Model:
        low, high, x, r = self.low, self.low + self.span, self.aside, self.radius
        self.vessel.build(t, low, high, 15, False)
        t = t.at(x)
        metal = [along("x", cylinder(0.0095, 0.0, x, 12), -x, 0, z) for z in (low, high)]
        metal += [along("x", hexagon(0.028, 0.004, 0.02), -x, 0, z) for z in (low, high)]
        metal += [*_cocks(low, high, self.wheel, t.style), hexagon(0.02, high + 0.016, high + 0.036)]
        metal.append(along("-y", t_handle(0.05, 0.04), 0, -0.017, low - 0.006))
        t.add(_NAME, *metal, cylinder(0.006, low - 0.06, low - 0.01, 10))
        glass = ring(0.7 * r if t.style.hollow else 0.0, r, low + 0.03, high - 0.03, fine_sides(r, t.style))
        t.add("gauge glass", glass, front=BEFORE)
        if self.guarded:
            bars = around(cylinder(0.0035, low + 0.024, high - 0.024, 8), self.bars, 0.02, np.pi / 4)
            rings = [ring(r + 0.006, 0.026, z, z + 0.006, 12) for z in (low + 0.026, high - 0.032)]
            t.add(_NAME, bars, *rings, of="clamp")
        return t.model(kind=_NAME)


class FloatBoard(_Beside, name="level gauge/board"):
    """A float-and-board gauge on a tank: a rope over two pulleys on the roof, a pointer before a long scale."""

    radius: float = between(0.6, 1.2, "of the tank", "m")
    tall: float = between(1.6, 3.0, "height of the tank", "m")
    wide: float = between(0.1, 0.25, "width of the scale", "m")
    level: float = between(0.15, 0.75, "where the pointer is / height of the tank")

    def build(self, t: Table) -> Model:
        radius, tall, wide, stop, n = self.radius, self.tall, self.wide, self.level * self.tall, t.n(self.radius)
        t.add("shell", cylinder(radius, 0.0, tall, n))
        t.add("dished head", cylinder(1.03 * radius, tall, tall + 0.012, n))
        y = -radius - 0.08
        t.add("bracket", *(box((0.5 * wide, 0.09, 0.03), (0, y + 0.05, s * tall)) for s in (0.12, 0.48, 0.84)))
        size, x = (0.5 * wide, 0.001, 0.008), -0.2 * wide
        ticks = [box(size, (x, y - 0.0064, s * tall)) for s in np.linspace(0.08, 0.88, 15)]
        t.add("gauge face", box((wide, 0.012, 0.88 * tall), (0, y, 0.48 * tall)), *ticks, front=BEFORE)
        pulley = along("x", merge([cylinder(0.035, -0.004, 0.004, 16), cylinder(0.008, -0.02, 0.02, 8)]))
        z, inner, y = tall + 0.09, -0.6 * radius, y - 0.024
        metal = [box((0.05, 0.04, 0.1), (0, place, tall + 0.06)) for place in (inner, -0.93 * radius)]
        metal.append(box((0.03, 0.13 * radius + 0.06, 0.012), (0, -radius - 0.02, tall + 0.08)))
        metal += [moved(pulley, at(0, place, z)) for place in (inner + 0.03, y + 0.035)]
        # The rope runs on top of the pulleys and down before the board.
        way = [(0, inner, tall + 0.01), (0, inner, z + 0.035), (0, y + 0.035, z + 0.035), (0, y, z), (0, y, stop)]
        t.add(_NAME, *metal, rope(way, 0.003, 8))
        pointer = box((0.7 * wide, 0.01, 0.03), (0.05 * wide, y + 0.008, stop))
        t.add("gauge needle", pointer, box((0.06, 0.03, 0.05), (0, y, stop)), of="handle", front=BEFORE)
        return t.model(kind=_NAME)


class Displacer(_Beside, name="level gauge/displacer"):
    """A displacer or float chamber beside a vessel: two flanged arms, a bolted top, a torque arm and transmitter."""

    low: float = between(0.35, 0.6, _LOW, "m")
    span: float = between(0.3, 0.8, _SPAN, "m")
    mouth: int = among((25, 40, 50), _MOUTH, "mm")
    radius: float = between(0.05, 0.085, "of the chamber", "m")
    clear: float = between(0.08, 0.13, "from the nozzles to the chamber", "m")
    bolts: int = among((8, 12), "of its top")
    side: str = among(("y", "-y", "x"), "where the torque arm points")
    boxed: bool = chance(0.5, "its electronics are in a plain box")
    housing: Housing = nested(Housing, _ELECTRONICS, when=lambda p: not p.boxed)
    gland: Gland = nested(Gland, "cable gland of the box", when=lambda p: p.boxed)
    vessel: Vessel = nested(Vessel, _VESSEL)

    def build(self, t: Table) -> Model:
        low, high, r, n = self.low, self.low + self.span, self.radius, t.n(self.radius)
        x, bottom, top = r + self.clear, low - 0.06, high + 0.05
        self.vessel.build(t, low, high, self.mouth)
        arms = [moved(arm, at(-x)) for arm in _arms(low, high, self.mouth, self.clear + 0.04 * r, t.style)]
        t, lid = t.at(x), top + 0.024
        # Where the style has pipes hollow, it is too, from its drain up to its lid.
        can = outline(0, lid, 0.9 * r, lid, 0.9 * r, bottom, 0.008, bottom - 0.3 * r) if t.style.hollow else []
        can += [(0.008, bottom - 0.4 * r)] if can else []
        can += outline(0.3 * r, bottom - 0.4 * r, r, bottom, r, top, 1.7 * r, top, 1.7 * r, lid)
        can += outline(1.7 * r, lid + 0.024, 0.8 * r, lid + 0.024, 0.8 * r, lid + 0.1, 0.4 * r, lid + 0.12)
        inner = 0.008 if t.style.hollow else 0.0
        drain = ring(inner, 0.0107, bottom - 0.4 * r - 0.05, bottom - 0.35 * r, 12)
        t.add(_NAME, turned(can, n), *arms, drain, of="valve")
        t.add("bolt", bolt_circle(self.bolts, 1.45 * r, 0.016, top, lid + 0.024))
        arm, end = t.at(0, 0, lid + 0.065).along(self.side), 0.8 * r + 0.1
        arm.add(_NAME, cylinder(0.022, 0.0, end, 14), cylinder(0.036, end - 0.01, end + 0.01, 14), of="valve")
        if self.boxed:
            cable = along("x", self.gland.solid(t.style), 0.069, 0, 0.05)
            put(arm.at(0, 0, end + 0.008), _HEAD, box((0.14, 0.14, 0.1), (0, 0, 0.05)), cable, of="electrical")
        else:
            put(arm.at(0, 0, end + 0.005), _HEAD, self.housing.solid(t.style), of="electrical")
        return t.model(kind="level transmitter")


class Column(_Beside, name="level gauge/column"):
    """An oil-level column on a machine's reservoir: two banjo bolts, a clear bar with a guard, maybe a thermometer."""

    long: float = between(0.08, 0.3, "from bolt to bolt", "m")
    wide: float = between(0.025, 0.04, "width of the column", "m")
    length: float = between(0.4, 0.8, "of the reservoir", "m")
    deep: float = between(0.3, 0.5, "depth of the reservoir", "m")
    over: float = between(0.15, 0.3, "what the reservoir is higher than the column", "m")
    spot: float = between(-0.25, 0.25, "from the reservoir's middle to the column / its length")

    def build(self, t: Table) -> Model:
        long, wide, tall = self.long, self.wide, self.long + self.over
        t.add("tank", box((self.length, self.deep, tall), (0, self.deep / 2, tall / 2)))
        t = t.at(self.spot * self.length, 0, 0.5 * tall).along("-y")
        back = extrude(rounded_rectangle(wide, long + 0.05, 0.3 * wide, 3), 0.0, 0.008)
        walls = [box((0.004, long + 0.02, 0.02), (s * 0.45 * wide, 0, 0.016)) for s in (-1, 1)]
        ends, bolts = (
            [moved(solid, at(0, s * long / 2)) for s in (-1, 1)]
            for solid in (cylinder(0.42 * wide, 0.0, 0.022, 14), hexagon(0.017, 0.022, 0.03))
        )
        t.add(_NAME, back, *walls, *ends, of="electrical")
        pane = extrude(rounded_rectangle(0.6 * wide, long - 0.03, 0.25 * wide, 3), 0.008, 0.024)
        t.add("gauge glass", pane, front=FRONT)
        t.add("screw", *bolts)
        return t.model(kind=_NAME)


class Radar(_OnFlange, name="level gauge/radar"):
    """A radar gauge on a flange: a neck with cooling ribs or a wave guide, a housing, a horn or rod below the face."""

    tall: float = between(0.04, 0.15, "height of the neck", "m")
    radius: float = between(0.015, 0.03, "of the neck", "m")
    ribbed: bool = chance(0.4, "cooling ribs on the neck")
    horn: bool = chance(0.6, "a horn below the face, not a rod")
    housing: Housing = nested(Housing, _ELECTRONICS)
    turn: float = between(0, 6, "which way they look", "rad")

    def build(self, t: Table) -> Model:
        t, thick, tall, r, wide = t.along("x"), plate_thickness(self.dn), self.tall, self.radius, 0.45 * t.pipe.bore
        solids = [disc_flange(self.dn, t.style, thick + 0.001), cylinder(r, thick, thick + tall, t.n(r))]
        if self.ribbed:
            steps = (0.2, 0.4, 0.6, 0.8)
            solids += [cylinder(1.5 * r, thick + s * tall, thick + (s + 0.08) * tall, 16) for s in steps]
        if self.horn:
            below = outline(wide, -0.12, 0.4 * wide, -0.03, 0.4 * wide, 0.001)
        else:
            below = outline(0.2 * wide, -0.1, 0.6 * wide, -0.02, 0.6 * wide, 0.001)
        t.add(_NAME, *solids, turned(below, 16))
        put(t.at(0, 0, thick + tall - 0.002).spun("z", self.turn), _HEAD, self.housing.solid(t.style))
        return t.model(kind="level transmitter")


class UltrasonicLevel(_OnFlange, name="level gauge/ultrasonic"):
    """An ultrasonic gauge: a fat plastic body, cone or stepped can screwed in a flange, its lid flat or slanting."""

    radius: float = between(0.03, 0.048, "of the body", "m")
    tall: float = between(0.08, 0.16, "height of the body", "m")
    form: int = whole(0, 2, "a cone, a stepped can, a rectangular case")
    gland: Gland = nested(Gland, "cable gland")

    def build(self, t: Table) -> Model:
        t, z, r, tall, n = t.along("x"), plate_thickness(self.dn), self.radius, self.tall, t.n(self.radius)
        top = z + tall
        if self.form == 0:
            body = [turned(outline(0.7 * r, z, 0.7 * r, z + 0.02, 1.3 * r, z + 0.6 * tall, 1.3 * r, top), n)]
        elif self.form == 1:
            can = outline(
                0.8 * r, z, 0.8 * r, z + 0.3 * tall, 1.2 * r, z + 0.35 * tall, 1.2 * r, top, r, z + 1.1 * tall
            )
            body = [turned(can, n)]
        else:
            case = extrude(rounded_rectangle(2.6 * r, 2.0 * r, 0.4 * r, 3), z + 0.35 * tall, top)
            body = [cylinder(0.8 * r, z, z + 0.4 * tall, n), case]
        plate = [disc_flange(self.dn, t.style, z + 0.001), cylinder(0.42 * t.pipe.bore, -0.03, 0.001, n)]
        t.add(_NAME, *plate, hexagon(2.2 * r, z - 0.001, z + 0.014))
        cable = along("x", self.gland.solid(t.style), 1.1 * r, 0, z + 0.75 * tall)
        put(t, _HEAD, *body, cable, of="electrical")
        view = z + 1.1 * tall if self.form == 1 else top + 0.001
        t.bundled(CASE).add(CASE, box((1.0 * r, 0.6 * r, 0.003), (0, 0, view)), of="dial", front=FRONT)
        return t.model(kind="level transmitter")


class Fork(_OnFlange, name="level gauge/fork", sizes=(25, 40, 50, 80)):
    """A vibrating-fork or rod switch on a flange: an extension, tines or a capacitance rod below, a small head."""

    tall: float = between(0.03, 0.1, "height of the extension", "m")
    forked: bool = chance(0.7, "tines below, not a rod")
    shape: str = among(("pot", "slant", "single"), "how its electronics are made")
    housing: Housing = nested(Housing, _ELECTRONICS, fixed=lambda p: {"shape": p.shape})

    def build(self, t: Table) -> Model:
        t, thick, tall, r = t.along("x"), plate_thickness(self.dn), self.tall, min(0.0107, 0.3 * t.pipe.bore)
        solids = [disc_flange(self.dn, t.style, thick + 0.001), cylinder(0.012, thick, thick + tall, t.n(0.012))]
        solids += [hexagon(0.036, thick, thick + 0.018), cylinder(r, -0.08, 0.001, 12)]
        if self.forked:
            solids += [box((0.004, 0.7 * r, 0.05), (s * 0.6 * r, 0, -0.1)) for s in (-1, 1)]
        else:
            solids.append(cylinder(0.5 * r, -0.14, -0.078, 10))
        t.add(_NAME, *solids)
        put(t.at(0, 0, thick + tall - 0.002), _HEAD, self.housing.solid(t.style))
        return t.model(kind="level switch")


class SwingDial(_OnFlange, name="level gauge/swing dial", sizes=(40, 50, 80)):
    """A dial gauge of a tank's float arm: a flange, a dial that lies on it, the arm below."""

    size: float = among((0.05, 0.08, 0.1), "diameter of its case", "m")
    rise: float = between(0.008, 0.03, "height of the dial over the flange", "m")
    design: str = among(("plain", "turret", "crimped"), "how its case is made")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda p: {"design": p.design, "deep": 0.025 / p.size})

    def build(self, t: Table) -> Model:
        t, thick, size = t.along("x"), plate_thickness(self.dn), self.size
        high = thick + self.rise
        plate = [disc_flange(self.dn, t.style, thick + 0.001), cylinder(0.3 * size, thick, high + 0.001, 14)]
        arm = rod((0, 0, -0.048), (0.3 * t.pipe.bore, 0, -0.09), 0.004, 8)
        t.add(_NAME, *plate, cylinder(0.005, -0.05, 0.001, 8), arm)
        self.dial.build(t.at(0, 0, high), size)
        return t.model(kind=_NAME)


class SideFloat(_OnFlange, name="level gauge/side float", sizes=(65, 80, 100)):
    """A float switch for a side flange: a switch box behind it, a float on an arm in front."""

    wide: float = between(0.08, 0.12, "width of the box", "m")
    tall: float = between(0.09, 0.15, "height of the box", "m")
    deep: float = between(0.06, 0.1, "depth of the box", "m")
    neck: float = between(0.02, 0.05, "from the flange to the box", "m")
    gland: Gland = nested(Gland, "cable gland")

    def build(self, t: Table) -> Model:
        t, thick, wide, tall, deep = t.along("x"), plate_thickness(self.dn), self.wide, self.tall, self.deep
        low = thick + self.neck
        plate = [disc_flange(self.dn, t.style, thick + 0.001), cylinder(0.025, thick, low + 0.001, 14)]
        ball = cylinder(0.36 * t.pipe.bore, -0.14, -0.065, 14)
        t.add(_NAME, *plate, cylinder(0.006, -0.07, 0.001, 8), ball, of="valve")
        case = extrude(rounded_rectangle(wide, tall, 0.1 * wide, 3), low, low + deep)
        lid = rounded_rectangle(1.04 * wide, 1.04 * tall, 0.1 * wide, 3)
        cable = along("-y", self.gland.solid(t.style), 0, -0.5 * tall + 0.001, low + 0.4 * deep)
        put(t, _HEAD, case, extrude(lid, low + 0.75 * deep, low + deep + 0.008), cable, of="electrical")
        return t.model(kind="level switch")


LEVEL_BUILDS = families_of(
    Magnetic, Reflex, Tubular, FloatBoard, Displacer, Column, Radar, UltrasonicLevel, Fork, SwingDial, SideFloat
)
