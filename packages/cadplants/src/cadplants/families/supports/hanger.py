"""Hangers under beams: clevis, swivel ring, three-bolt clamp, roller, trapeze, spring can."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import among, between, chance, given, several
from cadplants.builder.table import Table, outline
from cadplants.families.supports.clamp import half_band
from cadplants.families.supports.shape import (
    Feet,
    Overhead,
    Section,
    Standing,
    add_bolt,
    add_nuts,
    arc_yz,
    eye,
    few,
    hung,
    piece_of,
    radius,
    section_of,
    slab_yz,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import section_channel, section_i
from cadplants.solids.primitives import BOTH, along, around, bar, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["HANGERS", "Hanger", "add_eye", "add_nut", "add_rod", "add_upright_clamp", "roller"]

_NAME = "pipe hanger"
_QUARTER = spun("x", np.pi / 2)


def _rod_of(p: Any) -> float:
    """Diameter of the rod for a line (MSS SP-58 table 3) [m]."""
    r = radius(p)
    return 0.010 if r < 0.035 else 0.012 if r < 0.06 else 0.016 if r < 0.1 else 0.022


def add_rod(t: Table, d: float, low: float, high: float) -> None:
    """A threaded rod along z [m]."""
    t.add("stud", cylinder(d / 2, low, high, few(d / 2, t.style)), fine=False)


def add_nut(t: Table, d: float, z: float, up: bool = True) -> None:
    """A nut on a rod; it sits on ``z`` or hangs under it [m]."""
    low, high = (z, z + 0.85 * d) if up else (z - 0.85 * d, z)
    t.add("nut", hexagon(1.6 * d, low, high, d / 2, few(d / 2, t.style)))


def add_eye(t: Table, inner: float, thick: float, name: str = "nut") -> None:
    """An eye of round bar about the origin [m]."""
    t.add(name, eye(inner, thick, t.style), fine=False)


def add_upright_clamp(t: Table, d: float, ear: float, bolt: float) -> None:
    """A clamp whose halves stand left and right, bolted below and above round what is ``d`` thick [m]."""
    r = t.pipe.radius
    thick, wide, lying = 0.005 + 0.02 * r, 0.03 + 0.2 * r, t.moved(_QUARTER)
    half = half_band(r, thick, wide, ear, t.style, d)
    lying.add("clamp", half)
    lying.spun("x", np.pi).add("clamp", half)
    for s in BOTH:
        add_bolt(t.at(0, d / 2 + thick, s * (r + thick + 0.55 * ear)).moved(_QUARTER), bolt, d + 2 * thick)


class _Attached(Feet):
    """How a rod holds on above: a plate, a welded lug, a beam clamp, a channel."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    form: str = among(("plate", "lug", "beam clamp", "channel"), "how it holds on")
    taken: str = among((_NAME, "bracket"), "what the lug is taken for", when=lambda p: p.form == "lug")
    flange: float = among(
        (0.08, 0.1, 0.14), "width of the beam that is clamped", "m", when=lambda p: p.form == "beam clamp"
    )
    over: Overhead = hung(when=lambda p: p.form in ("plate", "lug"))

    def build(self, t: Table, d: float, z: float) -> None:
        """Puts it down, on a rod of diameter ``d`` that ends at ``z`` [m]."""
        if self.form == "plate":  # and nuts under a beam
            add_nut(t, d, z, up=False)
            t.add("plate", box((0.06 + d, 0.06 + d, 0.008), (0, 0, z + 0.004)))
            self.over.build(t, z + 0.008)
        elif self.form == "lug":  # an eye nut on a lug that is welded to a beam
            thick, w, top = 0.5 * d + 0.004, 2.2 * d, z + 5.5 * d
            half = [[0.5 * w, z + 1.7 * d], [w, z + 2.9 * d], [w, top]]
            lug = upright([*half, *([-a, b] for a, b in half[::-1])], -thick / 2, thick / 2)
            add_eye(t.at(0, 0, z + 1.3 * d).spun("z", np.pi / 2), 1.5 * d, 0.45 * d)
            t.add(self.taken, lug, of="steel")
            t.at(0, 0, z + 2.35 * d).along("y").add("bolt", cylinder(0.5 * d, -1.3 * d, 1.3 * d, few(d, t.style)))
            self.over.build(t, top)
        elif self.form == "beam clamp":  # a C that bites on the flange of a beam
            flange, bite = 0.01, z + 0.021
            top = bite + flange
            jaw = outline(-0.02, z - 0.004, 0.02, z - 0.004, 0.02, z + 0.012, 0, z + 0.02, 0, top, 0.02, top)
            t.add("clamp", slab_yz([*jaw, (0.02, top + 0.019), (-0.02, top + 0.019)], -0.015, 0.015))
            screw = [cylinder(0.005, top - 0.006, top + 0.029, 8), hexagon(0.015, top + 0.029, top + 0.039)]
            t.at(0, 0.012).add("screw", *screw)
            add_nut(t, d, z - 0.004, up=False)
            section = section_i(0.14, self.flange, 0.006, flange) + np.array([0.0, 0.07])
            t.at(0, self.flange / 2 - 0.012, bite).add("beam", bar((-0.6, 0, 0), (0.6, 0, 0), section))
        else:  # on edge, the rod goes through its flange
            section = section_channel(0.1, 0.05, 0.006, 0.008) - np.array([0.025, -0.05])
            add_nut(t, d, z - 0.004)
            add_nut(t, d, z - 0.012, up=False)
            t.add("beam", bar((0, -0.5, z - 0.012), (0, 0.5, z - 0.012), section))


def _attached(when: Any = None) -> _Attached:
    """A field: how the rod holds on."""
    return piece_of(_Attached, "how the rod holds on above", "height", "holes", "structure", when=when)


class Hanger(Standing, bundle=_NAME, label=_NAME):
    """What a line hangs from."""


class Clevis(Hanger, name="pipe hanger/clevis"):
    """An adjustable clevis of one bent strap with a cross bolt and a yoke (MSS SP-58 type 1)."""

    shield: bool = chance(0.4, "a shield under the line")
    up: float = between(1.2, 1.9, "height of the strap over the line's axis - 25 mm / radius of the line")
    top: float = between(0.02, 0.06, "from the strap to the yoke's top - a rod", "m")
    neck: float = between(0.25, 0.6, "width of the yoke's top / of the strap")
    drop: float = between(0.15, 0.7, "from the yoke to the end of the rod", "m")
    above: _Attached = _attached()

    def build(self, t: Table) -> Model:
        r, d = t.pipe.radius, _rod_of(self)
        rim, wide, thick = r + (0.002 if self.shield else 0.0), 0.022 + 0.12 * r, 0.003 + 0.01 * r
        up, middle, half, steps = self.up * r + 0.025, rim + thick / 2, rim - 0.001, max(6, few(r, t.style, 28) // 2)
        top, pin = up + self.top + d, up - 0.012
        bent = arc_yz(middle, np.pi, 2 * np.pi, steps)
        t.add(_NAME, strap(np.vstack([[[0, -middle, up]], bent, [[0, middle, up]]]), wide, thick))
        side = outline(half - thick / 2, pin - 0.012, half - thick / 2, pin + 0.01, self.neck * half, top)
        t.add(_NAME, strap([*([0, -y, z] for y, z in side), *([0, y, z] for y, z in side[::-1])], wide, thick))
        reach = rim + thick
        add_bolt(t.at(0, -reach, pin).spun("x", -np.pi / 2), 0.8 * d, 2 * reach)
        if self.shield:
            t.add(_NAME, strap(arc_yz(r + 0.001, 1.1 * np.pi, 1.9 * np.pi, steps), 4 * wide, 0.002), of="pipe")
        add_rod(t, d, top - 0.6 * d - thick, top + self.drop)
        add_nut(t, d, top + thick / 2)
        add_nut(t, d, top - thick / 2, up=False)
        self.above.build(t, d, top + self.drop)
        return t.model()


class SwivelRing(Hanger, name="pipe hanger/swivel ring", sizes=SIZES[:10]):
    """A swivel ring band: a pear-shaped strap with a knurled or hexagonal insert nut on top (MSS SP-58 type 10)."""

    lean: float = between(0.15, 0.3, "how far the band leaves the line above its middle / half a turn")
    knurled: bool = chance(0.6, "the insert nut is knurled")
    drop: float = between(0.15, 0.8, "from the band to the end of the rod", "m")
    above: _Attached = _attached()

    def build(self, t: Table) -> Model:
        r, d, lean = t.pipe.radius, _rod_of(self), self.lean * np.pi
        wide, thick, top, flat = 0.016 + 0.1 * r, 0.0015 + 0.008 * r, 1.55 * r + 0.02, 1.1 * d
        bent = arc_yz(r + thick / 2, np.pi - lean, 2 * np.pi + lean, max(8, few(r, t.style, 30)))
        ends = np.array([[0, flat * 0.9, top], [0, flat, top - 0.3 * d]])
        band = strap(np.vstack([ends * (1, -1, 1), bent, ends[::-1]]), wide, thick)
        t.add(_NAME, band, ring(0.52 * d, flat + 0.001, top - 0.002, top + thick, max(8, few(d, t.style))))
        insert = hexagon(1.6 * d, top - 0.8 * d, top + 0.6 * d)
        if self.knurled:
            side = outline(0.9 * d, top - 0.9 * d, 0.9 * d, top - 0.3 * d, 0.7 * d, top, 0.7 * d, top + 0.7 * d)
            insert = turned(side, few(d, t.style))
        t.add("nut", insert, fine=False)
        add_rod(t, d, top, top + self.drop)
        add_nut(t, d, top + 0.75 * d)
        self.above.build(t, d, top + self.drop)
        return t.model()


class ThreeBolt(Hanger, name="pipe hanger/three-bolt"):
    """A three-bolt clamp (MSS SP-58 type 3): long upper ears, their load bolt carries an eye rod."""

    hanger: bool = chance(0.5, "the clamp is taken for a hanger")
    arm: float = between(0.02, 0.08, "length of the upper ears - 4 rods", "m")
    drop: float = between(0.2, 0.7, "from the eye to the end of the rod", "m")
    above: _Attached = _attached()

    def build(self, t: Table) -> Model:
        r, d = t.pipe.radius, _rod_of(self)
        thick, wide, blade, ear = 0.005 + 0.02 * r, 0.03 + 0.22 * r, d, 2.6 * d
        start, end = r + thick + 0.8 * ear, r + thick + ear + 4.0 * d + self.arm
        half, tip = half_band(r, thick, wide, ear, t.style, blade), end + 0.2 * ear
        name = _NAME if self.hanger else "clamp"
        for s in BOTH:
            link = box((wide, thick, tip - start), (0, s * (blade + thick) / 2, (start + tip) / 2))
            t.add(name, moved(half, spun("x", -s * np.pi / 2)), link)
        for z in (-r - thick - 0.55 * ear, r + thick + 0.5 * ear, end - 0.5 * d):
            add_bolt(t.at(0, blade / 2 + thick, z).moved(_QUARTER), 0.85 * d, blade + 2 * thick)
        loop = end + 0.1 * d
        add_eye(t.at(0, 0, loop), d, 0.5 * d)
        add_rod(t, d, loop + 0.8 * d, loop + self.drop)
        add_nut(t, d, loop + 1.4 * d)
        self.above.build(t, d, loop + self.drop)
        return t.model()


def roller(half: float, r: float, waist: float, style: ModelingStyle) -> Solid:
    """A roller along y: an hourglass for a pipe of radius ``r``, this thin at its waist [m]."""
    steps = np.linspace(-1, 1, 9)
    reach = np.minimum(np.abs(steps) * half, 0.9 * r)
    rim = waist + r - np.sqrt(r**2 - reach**2)
    shape = [(float(q), float(s * half)) for q, s in zip(rim, steps, strict=True)]
    return along("y", turned(shape, max(8, style.round(waist))))


class Roller(Hanger, name="pipe hanger/roller", sizes=SIZES[4:]):
    """A roller hanger: a yoke on one rod (MSS SP-58 type 43) or an axle between two rods (type 41)."""

    drop: float = between(0.15, 0.6, "from the line or the yoke to the end of the rod", "m")
    two: bool = chance(0.5, "two rods")
    eyes: tuple[bool, ...] = several(yes(0.8), 2, "an eye round the axle at either end", when=lambda p: p.two)
    over: Overhead = hung(lambda p: Roller.out(p), when=lambda p: p.two)
    above: _Attached = _attached(when=lambda p: not p.two)

    @staticmethod
    def out(p: Any) -> float:
        """From the line's axis to a rod or a side of the yoke [m]."""
        r = radius(p)
        return max(r + 0.008, 0.72 * r + 0.01) + (_rod_of(p) if p.two else 0.004)

    def build(self, t: Table) -> Model:
        r, d, out = t.pipe.radius, _rod_of(self), self.out(self)
        waist, half, axle, drop = 0.012 + 0.22 * r, 0.72 * r + 0.006, 0.5 * d, r + self.drop
        z = -r - waist
        t.at(0, 0, z).add(_NAME, roller(half, r, waist, t.style), of="trim")
        t.at(0, 0, z).along("y").add("bolt", cylinder(axle, -out - d, out + d, few(axle, t.style)), fine=False)
        if self.two:
            for s, has_eye in zip(BOTH, self.eyes, strict=True):
                end = t.at(0, s * out)
                if has_eye:
                    add_eye(end.at(0, 0, z), 0.9 * d, 0.4 * d)
                add_rod(end, d, z + axle, drop)
                add_nut(end, d, drop, up=False)
            self.over.build(t, drop)
            return t.model()
        thick, wide, top = 0.004 + 0.015 * r, 0.03 + 0.15 * r, r + 0.02 + 0.3 * r
        side = outline(out, z - 0.015, out, 0.5 * r, 0.5 * out, top)
        t.add(_NAME, strap([*([0, -y, q] for y, q in side), *([0, y, q] for y, q in side[::-1])], wide, thick))
        add_rod(t, d, top - 1.4 * d, top + drop)
        add_nut(t, d, top + thick / 2)
        add_nut(t, d, top - thick / 2, up=False)
        self.above.build(t, d, top + drop)
        return t.model()


class Trapeze(Hanger, name="pipe hanger/trapeze", weight=1.5):
    """A trapeze: strut, angle, channel or tube on two rods (MSS SP-58 type 59), the line on it under a strap or a U."""

    size: float = among((0.041, 0.041, 0.05, 0.06, 0.08), "height of the bar", "m")
    out: float = between(0.06, 0.4, "from the line's side to a rod", "m")
    section: Section = section_of("section of the bar")
    hanger: bool = chance(0.4, "the bar is taken for a pipe hanger, not a beam")
    drop: float = between(0.1, 0.7, "from the top of the line to the end of the rods", "m")
    double: bool = chance(0.25, "a second bar below")
    gap: float = between(0.1, 0.3, "from the bar to the second - radius of the line", "m", when=lambda p: p.double)
    hold: str = among(("strap", "u-bolt", "none"), "what holds the line on it")
    over: Overhead = hung(lambda p: radius(p) + p.out)

    def build(self, t: Table) -> Model:
        r, d, size = t.pipe.radius, _rod_of(self), self.size
        out, low, drop = r + self.out, -r - size, r + self.drop
        section = self.section.outline(size, t.style)
        reach, z = out + 0.04, -r - size / 2
        t.add(_NAME if self.hanger else "beam", bar((0, -reach, z), (0, reach, z), *section), own=False)
        for s in BOTH:
            side = t.at(0, s * out)
            add_rod(side, d, low - 2 * d, drop)
            side.add("washer", box((0.041, 0.041, 0.005), (0, 0, low - 0.0025)))
            add_nut(side, d, low - 0.005, up=False)
            add_nut(side, d, -r)
            add_nut(side, d, drop, up=False)
        if self.double:
            z = low - r - self.gap
            t.add("beam", bar((0, -reach, z), (0, reach, z), *section))
            for s in BOTH:
                add_rod(t.at(0, s * out), d, z - 0.03, low - 2 * d)
        self._hold(t.bundled(""), d, low)
        self.over.build(t, drop)
        return t.model()

    def _hold(self, t: Table, d: float, low: float) -> None:
        r, thick, u = t.pipe.radius, 0.003, 0.4 * d
        if self.hold == "strap":
            middle, z = r + thick / 2, -r + thick / 2
            ends = np.array([[0, r + 0.03, z], [0, middle, z]])
            path = np.vstack([ends, arc_yz(middle, 0, np.pi, 10), (ends * (1, -1, 1))[::-1]])
            t.add("clamp", strap(path, 0.03, thick))
        elif self.hold == "u-bolt":
            leg = r + u
            path = np.vstack([[[0, leg, low - 0.02]], arc_yz(leg, 0, np.pi, 10), [[0, -leg, low - 0.02]]])
            t.add("u-bolt", rope(path, u, few(u, t.style)))
            add_nuts(t, [(0, s * leg, low) for s in BOTH], 2 * u)


class SpringCan(Hanger, name="pipe hanger/spring can", sizes=SIZES[4:]):
    """A variable spring hanger (MSS SP-58 type 51): a can or a caged coil, a turnbuckle, a clamp."""

    turn: float = between(0.05, 0.2, "from the eye to the turnbuckle", "m")
    low: float = between(0.04, 0.15, "from the turnbuckle to the can", "m")
    can: float = between(0, 0.03, "radius of the can over the usual one", "m")
    tall: float = between(0, 0.2, "height of the can over the usual one", "m")
    closed: bool = chance(0.6, "a can, not a coil between plates")
    plated: bool = chance(0.5, "a name plate")
    top: str = among(("beam", "lugs", "rod"), "what it hangs by")
    over: Overhead = hung(lambda p: SpringCan.wide(p), when=lambda p: p.top != "rod")
    up: float = between(0.1, 0.4, "length of the rod over it", "m", when=lambda p: p.top == "rod")
    above: _Attached = _attached(when=lambda p: p.top == "rod")

    @staticmethod
    def wide(p: Any) -> float:
        """Radius of the can [m]."""
        return 0.035 + 0.4 * radius(p) + p.can  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, d, can = t.pipe.radius, _rod_of(self), self.wide(self)
        tall, ear = 0.14 + r + self.tall, 2.6 * d
        add_upright_clamp(t, d, ear, 0.85 * d)
        z = r + 0.005 + 0.02 * r + 0.9 * ear
        add_eye(t.at(0, 0, z), d, 0.5 * d)
        turn = z + self.turn
        low = turn + 7 * d + self.low
        add_rod(t, d, z + 0.7 * d, turn + 1.5 * d)
        t.add(_NAME, _turnbuckle(d, turn, turn + 7 * d, t.style), of="fastener")
        add_rod(t, d, turn + 5.5 * d, low + 0.02)
        t.add(_NAME, *self._body(t, can, low, low + tall), of="motor")
        if self.plated:
            t.add(_NAME, box((0.002, 0.03, 0.05), (can + 0.004, 0, low + 0.85 * tall)), of="dial", fine=True)
        top = low + tall + 0.008
        if self.top == "rod":
            add_rod(t, d, top - 0.01, top + self.up)
            add_nut(t, d, top)
            self.above.build(t, d, top + self.up)
            return t.model()
        if self.top == "lugs":
            t.add(_NAME, *(box((0.05, 0.008, 0.06), (0, s * 0.014, top + 0.03)) for s in BOTH))
            t.add("bracket", box((0.05, 0.02, 0.07), (0, 0, top + 0.06)))
            t.at(0, 0, top + 0.04).along("y").add("bolt", cylinder(0.008, -0.03, 0.03, 10), fine=False)
        self.over.build(t, top + (0.095 if self.top == "lugs" else 0.0))
        return t.model()

    def _body(self, t: Table, can: float, low: float, high: float) -> list[Solid]:
        n, tall = t.n(can, 12), high - low
        lid = 1.08 if self.closed else 1.2
        lids = [cylinder(lid * can, q, q + 0.008, n) for q in (low, high)]
        if self.closed:
            slot = box((0.006, 0.022, 0.55 * tall), (can, 0, low + 0.45 * tall))
            return [turned([(can, low + 0.004), (can, high)], n), *lids, slot]
        a, z = np.linspace(0, 2 * np.pi * 6, 96), np.linspace(low + 0.02, high - 0.02, 96)
        coil = np.column_stack([0.72 * can * np.cos(a), 0.72 * can * np.sin(a), z])
        return [rope(coil, 0.09 * can, 6), around(cylinder(0.006, low, high, 6), 3, can), *lids]


def _turnbuckle(d: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A turnbuckle: two flanks between two threaded bosses (MSS SP-58 type 13)."""
    n, m, y = few(d, style), few(0.4 * d, style, 8), 0.85 * d
    bosses = [cylinder(0.95 * d, low, low + 1.4 * d, n), cylinder(0.95 * d, high - 1.4 * d, high, n)]
    flanks = [rod((0, s * y, low + 0.6 * d), (0, s * y, high - 0.6 * d), 0.36 * d, m) for s in BOTH]
    return merge([*bosses, *flanks])


HANGERS = families_of(Clevis, SwivelRing, ThreeBolt, Roller, Trapeze, SpringCan)
