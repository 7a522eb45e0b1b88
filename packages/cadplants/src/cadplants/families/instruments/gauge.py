"""Further pressure gauges: with seals and contacts, square, filled, twin and digital."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import (
    CASE,
    STEM,
    Dial,
    DialFace,
    Gland,
    Indicator,
    Needle,
    Shank,
    StandingGauge,
    case_of,
    fine_sides,
    upright,
)  # fmt: skip
from cadplants.builder.draws import made, yes
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import FRONT, Gauge, put, t_handle
from cadplants.families.valves.valve import disc_flange
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, box, cylinder, dome, hexagon, ring, rod, torus, turned
from cadplants.solids.transforms import at

__all__ = ["GAUGE_BUILDS"]

_KIND = "pressure gauge"
_NIPPLE, _SIZE = "height of the nipple", "diameter of its case"


def _nipple(t: Table, tall: float) -> None:
    """A nipple from the outlet up."""
    put(t, STEM, cylinder(0.0068, 0.0, tall, fine_sides(0.0068, t.style)), hexagon(0.022, 0.3 * tall, 0.6 * tall))


def _standing(design: str) -> StandingGauge:
    """The field of a gauge whose case is made so."""
    return nested(StandingGauge, "gauge", fixed=lambda _: {"dial.design": design})


def _on_nipple(t: Table, tall: float, gauge: StandingGauge) -> Model:
    _nipple(t, tall)
    gauge.build(t, tall)
    return t.model(kind=_KIND)


class SafetyPattern(Gauge, name="gauge/safety pattern"):
    """A safety-pattern gauge (EN 837-1 S3): deep case, solid front, blow-out back on spacers."""

    tall: float = between(0.02, 0.09, _NIPPLE, "m")
    gauge: StandingGauge = _standing("safety")

    def build(self, t: Table) -> Model:
        return _on_nipple(t, self.tall, self.gauge)


class Bayonet(Gauge, name="gauge/bayonet"):
    """A process gauge in stainless steel with a bayonet ring (EN 837-1, 100 and 160 mm as a rule)."""

    tall: float = between(0.02, 0.09, _NIPPLE, "m")
    gauge: StandingGauge = _standing("bayonet")

    def build(self, t: Table) -> Model:
        return _on_nipple(t, self.tall, self.gauge)


class OnCock(Gauge, name="gauge/cock"):
    """A heavy brass or iron gauge with a screwed, hinged ring, on a gauge cock with a lever (DIN 16262)."""

    tall: float = between(0.05, 0.08, "height of the cock", "m")
    gauge: StandingGauge = _standing("cast")

    def build(self, t: Table) -> Model:
        tall, n = self.tall, fine_sides(0.012, t.style)
        plug = along("x", turned(outline(0.014, -0.022, 0.01, 0.022), n), 0, 0, 0.5 * tall)
        lever = rod((-0.026, 0, 0.5 * tall), (-0.026, 0.05, 0.5 * tall - 0.02), 0.004, 8)
        put(t, STEM, cylinder(0.0068, 0.0, tall, n), plug, hexagon(0.026, 0.7 * tall, tall), lever)
        self.gauge.build(t, tall)
        return t.model(kind=_KIND)


class Turret(Gauge, name="gauge/turret"):
    """A phenolic turret-case gauge with a screwed ring and a flange at its back (ASME B40.100, 4 1/2 in)."""

    tall: float = between(0.02, 0.09, _NIPPLE, "m")
    size: float = among((0.1, 0.115), _SIZE, "m")
    gauge: StandingGauge = nested(StandingGauge, "gauge", fixed=lambda p: {"size": p.size, "dial.design": "turret"})

    def build(self, t: Table) -> Model:
        return _on_nipple(t, self.tall, self.gauge)


class Filled(Gauge, name="gauge/filled"):
    """A liquid-filled gauge: crimped ring, domed window, a rubber plug on top, often in a rubber boot."""

    size: float = among((0.04, 0.05, 0.063, 0.1), _SIZE, "m")
    tall: float = between(0.015, 0.05, _NIPPLE, "m")
    face: DialFace = nested(DialFace, "dial plate")
    needle: Needle = nested(Needle, "needle")
    plugged: bool = chance(0.5, "a plug on top in place of a boot round it")
    foot: Shank = nested(Shank, "connection")

    def build(self, t: Table) -> Model:
        size, tall, deep, n = self.size, self.tall, 0.5 * self.size, t.n(self.size / 2)
        case, wall = case_of(size, deep, "crimped", t.style)
        _nipple(t, tall)
        self.foot.build(t, tall - 0.004, tall + 0.03, size)
        t = upright(t, size, tall + 0.028, deep)
        t.add(CASE, case)
        t.add("gauge face", self.face.solid(wall, 0.82 * deep, t.style), front=FRONT)
        t.add("gauge needle", self.needle.solid(wall, 0.82 * deep + 0.001), turns=Turning("needle"), front=FRONT)
        t.add("gauge glass", dome(0.98 * wall, 0.2 * wall, 0.94 * deep, n), front=FRONT)
        if self.plugged:
            plug = cylinder(0.12 * size, -0.02 * size, 0.08 * size, 12)
            t.at(0, 0.5 * size, 0.4 * deep).along("y").add(CASE, plug, of="rubber")
        else:  # a boot with two fat rims
            boot = ring(0.51 * size, 0.58 * size, 0.05 * deep, 0.9 * deep, n)
            rim = torus(0.57 * size, 0.05 * size, n, 6)
            t.add(CASE, boot, *(moved(rim, at(0, 0, z * deep)) for z in (0.12, 0.85)), of="rubber")
        return t.model(kind=_KIND)


class Contact(Gauge, name="gauge/contact"):
    """A contact gauge: a deep ring, a setting lock in the middle of its window, a junction box at its side."""

    size: float = among((0.1, 0.16), _SIZE, "m")
    tall: float = between(0.02, 0.08, _NIPPLE, "m")
    design: str = among(("plain", "bayonet", "safety"), "how its case is made")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda p: {"design": p.design, "deep": 0.6, "glazed": False})
    wide: float = between(0.35, 0.55, "width of the junction box / diameter")
    gland: Gland = nested(Gland, "cable gland of the junction box")
    foot: Shank = nested(Shank, "connection")
    turn: float = between(0, 6, "which way its dial looks", "rad")

    def build(self, t: Table) -> Model:
        size, deep, wide = self.size, 0.6 * self.size, self.wide * self.size
        _nipple(t, self.tall)
        self.foot.build(t.spun("z", self.turn), self.tall - 0.004, self.tall + 0.04, size)
        t = upright(t, size, self.tall + 0.038, deep, self.turn)
        self.dial.build(t, size)
        glass = cylinder(0.445 * size, 0.93 * deep, 0.95 * deep, t.n(size / 2))
        t.add("gauge glass", glass, front=FRONT)
        lock = cylinder(0.09 * size, 0.94 * deep, 1.06 * deep, 12)
        t.add(CASE, lock, box((0.1 * size, 0.02 * size, 0.02), (0, 0, 1.06 * deep)), of="trim")
        crate = extrude(rounded_rectangle(wide, 0.5 * size, 0.06 * size, 3), 0.12 * deep, 0.7 * deep)
        cable = along("-y", self.gland.solid(t.style, 0.016), 0.0, -0.25 * size, 0.4 * deep)
        aside = t.at(0.48 * size + 0.5 * wide)
        aside.add(CASE, crate, moved(cable, at(0.02 * size)), of="electrical")
        return t.model(kind=_KIND)


class Square(Gauge, name="gauge/square"):
    """A gauge in a square case (96 or 72 mm, DIN 43700), its connection below."""

    side: float = among((0.072, 0.096, 0.144), "of its case", "m")
    tall: float = between(0.02, 0.08, _NIPPLE, "m")
    deep: float = between(0.35, 0.6, "depth of its case / side")
    case: Indicator = nested(Indicator, "case")
    foot: Shank = nested(Shank, "connection")

    def build(self, t: Table) -> Model:
        side, deep = self.side, self.deep * self.side
        _nipple(t, self.tall)
        self.foot.build(t, self.tall - 0.004, self.tall + 0.04, side)
        self.case.build(upright(t, side, self.tall + 0.037, deep), side, side, deep)
        return t.model(kind=_KIND)


class Screen(Gauge, name="gauge/screen"):
    """A digital gauge with a rectangular head: a screen, keys, a bumper, on a hexagon."""

    wide: float = between(0.07, 0.12, "width of its case", "m")
    tall: float = between(0.09, 0.16, "height of its case", "m")
    deep: float = between(0.03, 0.05, "depth of its case", "m")
    low: float = between(0.03, 0.07, "height of its stem", "m")
    columns: int = whole(2, 4, "keys side by side")
    single: tuple[bool, ...] = several(yes(0.5), lambda p: p.columns, "whether a column has one key, not two")
    bumper: bool = chance(0.5, "a bumper round it")

    def build(self, t: Table) -> Model:
        wide, tall, deep, low = self.wide, self.tall, self.deep, self.low
        put(t, STEM, cylinder(0.0068, 0, low, 12), hexagon(0.027, 0.5 * low, low + 0.002))
        t, shape = upright(t, tall, low + 0.001, deep), rounded_rectangle(wide, tall, 0.12 * wide, 3)
        t.add(CASE, extrude(shape, 0, deep), of="electrical")
        t.add("gauge glass", box((0.75 * wide, 0.4 * tall, 0.0015), (0, 0.2 * tall, deep + 0.00075)), front=FRONT)
        key = cylinder(0.07 * wide, deep, deep + 0.003, 10)
        places = [
            (x * wide, -y * tall)
            for x, single in zip(np.linspace(-0.3, 0.3, self.columns), self.single, strict=True)
            for y in ((0.25,) if single else (0.15, 0.33))
        ]
        t.add(CASE, *(moved(key, at(*place)) for place in places), of="rubber")
        if self.bumper:
            t.add(CASE, extrude(1.08 * shape, 0.2 * deep, 0.8 * deep, (0.995 * shape,)), of="safety")
        return t.model(kind=_KIND)


class FlangedSeal(Gauge, name="gauge/flanged seal", place="head", sizes=(25, 40, 50, 80, 100)):
    """A gauge on a flanged diaphragm seal, maybe with a finned cooling tower (ASME B16.5 flange, EN 837-1 gauge)."""

    seal: float = between(0.01, 0.025, "thickness of the seal on its flange", "m")
    finned: bool = chance(0.5, "a finned cooling tower")
    fins: int = whole(4, 8, "of the cooling tower", when=lambda p: p.finned)
    rise: float = between(0.02, 0.05, "from the seal to the gauge", "m", when=lambda p: not p.finned)
    gauge: StandingGauge = nested(StandingGauge, "gauge")

    def build(self, t: Table) -> Model:
        t, thick, n = t.along("x"), plate_thickness(self.dn), t.n(0.03)
        r, top = 0.47 * PIPES[self.dn].outer + 0.012, thick + self.seal
        cup = turned(outline(1.1 * r, thick, r, top, 0.012, top + 0.008), n)
        if self.finned:
            first, high = top + 0.015, top + 0.015 + 0.008 * self.fins
            more = [cylinder(0.016, first + 0.008 * k, first + 0.003 + 0.008 * k, n) for k in range(self.fins)]
        else:
            high, more = top + self.rise, [along("x", hexagon(0.008, 0.0, 0.012), 0.8 * r, 0, thick + 0.006)]
        put(t, STEM, disc_flange(self.dn, t.style, thick + 0.002), cup, *more, cylinder(0.008, top, high, n))
        self.gauge.build(t, high)
        return t.model(kind=_KIND)


class Duplex(Gauge, name="gauge/duplex"):
    """A duplex gauge: two connections side by side, two needles on one dial, on a twin nipple with two cocks."""

    size: float = among((0.1, 0.15, 0.2), _SIZE, "m")
    tall: float = between(0.05, 0.1, "height of the cocks", "m")
    design: str = among(("plain", "cast"), "how its case is made")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda p: {"design": p.design, "deep": 0.4})
    second: Needle = nested(Needle, "second needle")
    feet: tuple[Shank, ...] = several(made(Shank), 2, "connections")

    def build(self, t: Table) -> Model:
        size, tall, apart = self.size, self.tall, 0.22 * self.size
        span = (1 - np.sqrt(1 - 0.44**2)) * size / 2  # up to the case, beside its middle
        put(t, STEM, cylinder(0.0068, 0, 0.03, 12), box((2 * apart + 0.03, 0.024, 0.022), (0, 0, 0.035)))
        for axis, s, foot in zip(("-x", "x"), (-1, 1), self.feet, strict=True):
            cock = t.at(s * apart)
            handle = along(axis, t_handle(0.04, 0.03), s * 0.009, 0, tall - 0.01)
            put(
                cock, STEM, cylinder(0.006, 0.04, tall + 0.01, 10), box((0.02, 0.02, 0.03), (0, 0, tall - 0.01)), handle
            )
            foot.build(cock, tall, tall + 0.034 + span, size)
        t = upright(t, size, tall + 0.03, self.dial.reach(size))
        self.dial.build(t, size)
        second = self.second.solid(0.4 * size, 0.82 * 0.4 * size + 0.0045)
        t.add("gauge needle", second, of="handle", turns=Turning("needle"), front=FRONT)
        return t.model(kind=_KIND)


class BlockAndBleed(Gauge, name="gauge/block and bleed"):
    """A gauge on a block-and-bleed valve: a bar with one or two needle valves and a bleed plug (ASME B1.20.1 ends)."""

    side: float = between(0.025, 0.034, "of the bar", "m")
    tall: float = between(0.08, 0.14, "height of the bar", "m")
    wheel: bool = chance(0.4, "a wheel on its valve in place of a cross bar")
    second: bool = chance(0.6, "a second needle valve")
    gauge: StandingGauge = nested(StandingGauge, "gauge")

    def build(self, t: Table) -> Model:
        side, tall = self.side, self.tall
        body = [cylinder(0.01, 0.0, 0.03, 12), box((side, side, tall - 0.02), (0, 0, 0.01 + tall / 2))]
        valve = [
            cylinder(0.012, 0.04, 0.052, 8) if self.wheel else t_handle(0.055, 0.05),
            cylinder(0.006, 0.0, 0.045, 8),
        ]
        body += [along("x", solid, 0.48 * side, 0, 0.35 * tall) for solid in valve]
        if self.second:
            body.append(along("-x", t_handle(0.05, 0.04), -0.48 * side, 0, 0.65 * tall))
        put(t, STEM, *body, along("-y", hexagon(0.012, 0.0, 0.018), 0, -0.48 * side, 0.7 * tall))
        self.gauge.build(t, tall)
        return t.model(kind=_KIND)


GAUGE_BUILDS = families_of(
    SafetyPattern, Bayonet, OnCock, Turret, Filled, Contact, Square, Screen, FlangedSeal, Duplex, BlockAndBleed
)
