"""Service units of compressed air: filters, regulators and lubricators on blocks, alone or in a row."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.dials import CASE, STEM, Dial
from cadplants.builder.draws import of_form
from cadplants.builder.melting import FACETS, FACETS_TEXT, Melting, sides_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES, sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.solids.transforms import at

__all__ = ["SERVICE"]

_FILTER, _BODY = "filter", "valve body"
_SIZES = sizes_between(15, 50)


class _Block(Params):
    """A block along x with two ports: square, round or eight-sided from above."""

    dn: int = given(0, "nominal size", "mm")
    facets: int = given(0, FACETS_TEXT)
    form: str = among(("box", "box", "rounded", "round", "octagon"), "its outline from above")
    wide: float = between(1.8, 2.8, "(half its length - 12 mm) / radius of the pipe")
    deep: float = between(0.8, 1.25, "depth / length")
    low: float = between(1.2, 1.7, "what is below the axis / radius of the pipe")
    high: float = between(1.2, 1.9, "what is above the axis / radius of the pipe")
    ends: str = among(("hexagons", "rings", "rings"), "its ports")
    reach: float = between(0.25, 1.2, "(reach of a port - 4 mm) / radius of the pipe")

    @property
    def half(self) -> float:
        """Half the length of the block [m]."""
        return self.wide * PIPES[self.dn].radius + 0.012

    @property
    def end(self) -> float:
        """How far a port stands out [m]."""
        return self.reach * PIPES[self.dn].radius + 0.004

    @property
    def top(self) -> float:
        """Height of its upper side [m]."""
        return self.high * PIPES[self.dn].radius + 0.004

    @property
    def bottom(self) -> float:
        """Depth of its underside below the axis [m]."""
        return self.low * PIPES[self.dn].radius + 0.004

    @property
    def before(self) -> float:
        """How far its front is from the axis [m]."""
        if self.form in ("round", "octagon"):
            return self.half * (0.92 if self.form == "octagon" else 0.99)
        return self.deep * self.half

    def solid(self, t: Table) -> Solid:
        """The block about the origin."""
        a, b, n = self.half, self.deep * self.half, sides_of(t, self.half, self.facets)
        shapes = {
            "box": np.array([(-a, -b), (a, -b), (a, b), (-a, b)]),
            "rounded": rounded_rectangle(2 * a, 2 * b, 0.35 * min(a, b), 3),
            "round": circle(a, n),
            "octagon": circle(a / np.cos(np.pi / 8), 8, phase=np.pi / 8),
        }
        return extrude(shapes[self.form], -self.bottom, self.top)

    def port(self, t: Table, low: float, high: float) -> Solid:
        """A port along x from one place to another [m]."""
        if self.ends == "hexagons":
            return hex_end(self.dn, low, high, t.style)
        r = PIPES[self.dn].radius
        return along("x", ring(bore_of(self.dn, t.style), 1.25 * r, low, high, sides_of(t, 1.25 * r, self.facets)))


class _Bowl(Params):
    """A bowl below a block: plain, with a collar, in a guard; a drain at its end."""

    form: str = among(("dished", "flat", "cone", "stepped"), "its shape")
    wide: float = between(0.68, 0.98, "radius / of the block")
    deep: float = between(1.6, 4.2, "depth / radius")
    collar: bool = chance(0.6, "a collar under the block")
    guard: int = among((0, 0, 0, 4, 6), "bars of a guard round it; 0: none")
    drain: str = among(("nipple", "nipple", "hexagon", "cock", "none"), "what is at its end")

    def solids(self, half: float, low: float, n: int) -> tuple[list[Solid], list[Solid]]:
        """The bowl and what is on it, below a depth, for a block of half a length [m]."""
        r = self.wide * half
        end = low + self.deep * r
        shapes = {
            "dished": outline(r, low, 0.97 * r, end - 0.5 * r, 0.75 * r, end - 0.15 * r, 0.35 * r, end),
            "flat": outline(r, low, 0.93 * r, end),
            "cone": outline(r, low, r, low + 0.5 * (end - low), 0.45 * r, end),
            "stepped": outline(r, low, r, low + 0.6 * (end - low), 0.8 * r, low + 0.62 * (end - low), 0.8 * r, end),
        }
        bowl, more = [turned([(a, z) for a, z in shapes[self.form]], n)], []
        if self.collar:
            more.append(cylinder(1.08 * r, low - 0.002, low + 0.3 * r, n))
        if self.guard:
            bar = box((0.1 * r, 0.3 * r, end - low - 0.3 * r), (0, 0, (end + low) / 2))
            more += [around(bar, self.guard, 1.03 * r), ring(0.9 * r, 1.09 * r, end - 0.35 * r, end - 0.15 * r, n)]
        tip = 0.16 * r + 0.002
        if self.drain == "nipple":
            more.append(cylinder(tip, end - 0.01 * r, end + 2.5 * tip, min(n, 12)))
        elif self.drain == "hexagon":
            more.append(hexagon(2.4 * tip, end - 0.01 * r, end + 1.4 * tip))
        elif self.drain == "cock":
            more += [cylinder(tip, end - 0.01 * r, end + 3 * tip, min(n, 12))]
            more.append(rod((-2.5 * tip, 0, end + 1.8 * tip), (2.5 * tip, 0, end + 1.8 * tip), 0.5 * tip, 6))
        # What was turned upwards hangs.
        hang = np.diag([1.0, -1.0, -1.0, 1.0])
        return [moved(one, hang) for one in bowl], [moved(one, hang) for one in more]


class _Knob(Params):
    """A regulator's hood and what sets it: a knob, plain or ribbed, a mushroom, a screw with a cross bar."""

    hood: float = between(0.3, 1.3, "height of the hood / half the block")
    wide: float = between(0.6, 0.95, "radius of the hood / half the block")
    taper: float = between(0.6, 1.0, "radius of its top / of its foot")
    form: str = among(("ribbed", "ribbed", "plain", "mushroom", "tee"), "what sets it")
    size: float = between(0.75, 1.15, "radius of the knob / of the hood's top")
    tall: float = between(0.7, 1.6, "height of the knob / its radius")
    ribs: int = whole(8, 16, "ribs", when=of_form("ribbed"))
    collar: bool = chance(0.4, "a ring under the knob")

    def build(self, t: Table, half: float, n: int) -> None:
        """Puts it on a block's upper side on z = 0, of half a length [m]."""
        foot, high = self.wide * half, self.hood * half
        neck = self.taper * foot
        r = self.size * neck
        hood = [turned(outline(foot, -0.002, foot, 0.2 * high, neck, high), n)]
        if self.collar:
            hood.append(cylinder(1.05 * max(neck, 0.9 * r), high - 0.002, high + 0.12 * r, n))
        t.add("valve bonnet", *hood)
        low, tall = high + 0.004 + (0.12 * r if self.collar else 0.0), self.tall * r
        t.add("valve stem", cylinder(0.4 * r, high - 0.002, low + 0.3 * tall, min(n, 12)))
        top = low + tall
        knob: list[Solid] = [turned(outline(r, low, r, top - 0.12 * r, 0.85 * r, top), n)]
        if self.form == "ribbed":
            knob.append(around(box((0.08 * r, 0.14 * r, 0.75 * tall), (0, 0, low + 0.45 * tall)), self.ribs, r))
        elif self.form == "mushroom":
            knob = [
                turned(
                    outline(
                        0.6 * r, low, 0.7 * r, low + 0.5 * tall, r, low + 0.6 * tall, r, top, 0.5 * r, top + 0.1 * r
                    ),
                    n,
                )
            ]
        elif self.form == "tee":
            bar = rod((-r, 0, top), (r, 0, top), 0.12 * r, 8)
            knob = [cylinder(0.22 * r, low, top + 0.1 * r, min(n, 8)), bar]
        t.add("handwheel", *knob, turns=Turning("handwheel"))


class _Manometer(Params):
    """A small gauge on a block's front: a plain disc with a face, or a case with a dial."""

    size: float = among((0.03, 0.04, 0.04, 0.05, 0.063), "diameter of its case", "m")
    neck: float = between(0.004, 0.02, "from the block to its case", "m")
    plain: bool = chance(0.5, "its case is a plain disc")
    deep: float = between(0.3, 0.7, "depth of a plain case / diameter", when=lambda p: p.plain)
    dial: Dial = nested(Dial, "case with its dial", when=lambda p: not p.plain)

    def build(self, t: Table, n: int) -> None:
        """Puts it down about z, the block's front in z = 0, its own towards +z."""
        t.add(STEM, hexagon(0.011, -0.002, 0.6 * self.neck), cylinder(0.0045, 0.0, self.neck + 0.001, min(n, 10)))
        t = t.at(0, 0, self.neck)
        if not self.plain:
            self.dial.build(t, self.size)
            return
        r, deep = self.size / 2, self.deep * self.size
        t.add(CASE, cylinder(r, 0.0, deep, n))
        t.add("gauge face", cylinder(0.9 * r, deep - 0.0002, deep + 0.0006, n), front=(0.0, 0.0, 1.0))


def _block() -> _Block:
    return nested(_Block, "block", fixed=lambda p: {"dn": p.dn, "facets": p.facets})


class AirRegulator(Melting, Valve, name="pressure reducing valve/air regulator", sizes=_SIZES, weight=1.5):
    """A regulator of compressed air: a block, a hood with a knob, a plug below, a small gauge in front."""

    melted: bool = chance(0.25, "all of it, its gauge too, is one mesh")
    block: _Block = _block()
    knob: _Knob = nested(_Knob, "hood and knob")
    under: float = between(0.2, 1.2, "depth of the plug below / half the block")
    gauged: bool = chance(0.75, "a small gauge")
    gauge: _Manometer = nested(_Manometer, "gauge", when=lambda p: p.gauged)

    def build(self, t: Table) -> Model:
        length = round(2 * (self.block.half + self.block.end), 6)
        if self.melted:
            apart = replace(t, parts=[])
            self._put(apart, length)
            t.bundled("valve").add("valve", *(part.solid for part in apart.parts), of="valve")
        else:
            self._put(t, length)
        return t.model(length, "welded", "pressure reducing valve")

    def _put(self, t: Table, length: float) -> None:
        """Puts its pieces down, of a length [m]."""
        block = self.block
        half, end, n = block.half, block.end, self.n(t, block.half)
        mid, ends = t.at(length / 2), (block.port(t, 0.0, 1.2 * end), block.port(t, length - 1.2 * end, length))
        plug = turned(outline(0.5 * half, -block.bottom - self.under * half, 0.65 * half, -block.bottom + 0.002), n)
        t.add(_BODY, *ends, *(moved(one, at(length / 2)) for one in (block.solid(t), plug)))
        self.knob.build(mid.at(0, 0, block.top), half, n)
        if self.gauged:
            self.gauge.build(mid.at(0, -block.before).along("-y"), n)


class _Unit(Device, place="inline", group="Equipment", label=_FILTER, bundle=_FILTER, sizes=_SIZES):
    """A unit with a filter."""

    facets: int = among(FACETS, FACETS_TEXT)
    block: _Block = _block()
    bowl: _Bowl = nested(_Bowl, "bowl")


class AirFilter(_Unit, name="filter/air bowl", weight=1.5):
    """A filter or lubricator of compressed air: a block with two ports, a bowl below, a lid or a sight dome on it."""

    melted: bool = chance(0.4, "all of it is one mesh")
    top: str = among(("flat", "lid", "screw", "sight dome"), "what is on the block")

    def build(self, t: Table) -> Model:
        block = self.block
        half, end, n = block.half, block.end, sides_of(t, block.half, self.facets)
        length = round(2 * (half + end), 6)
        head = [block.port(t, 0.0, 1.2 * end), block.port(t, length - 1.2 * end, length)]
        on = [block.solid(t), *_crown(self.top, block, n)]
        bowl, more = self.bowl.solids(half, block.bottom, n)
        head += [moved(one, at(length / 2)) for one in on]
        bowl, more = ([moved(one, at(length / 2)) for one in some] for some in (bowl, more))
        if self.melted:
            t.add(_FILTER, *head, *bowl, *more, of="valve")
        else:
            t.add(_FILTER, *head, of="valve")
            t.add(_FILTER, *bowl)
            t.add(_FILTER, *more, of="valve")
        return t.model(length, "welded", "air filter")


def _crown(form: str, block: _Block, n: int) -> list[Solid]:
    """What is on a block without a knob, about its axis."""
    half, top = block.half, block.top
    if form == "lid":
        return [
            turned(outline(0.8 * half, top - 0.002, 0.8 * half, top + 0.2 * half, 0.6 * half, top + 0.35 * half), n)
        ]
    if form == "screw":
        return [hexagon(0.7 * half, top - 0.002, top + 0.35 * half)]
    if form == "sight dome":
        dome_ = dome(0.4 * half, 0.5 * half, top + 0.2 * half, n)
        return [cylinder(0.45 * half, top - 0.002, top + 0.22 * half, n), dome_]
    return []


class AirUnit(_Unit, name="filter/air service unit", weight=1.5):
    """A row of a filter, a regulator with a gauge and maybe a lubricator, with clamps or gaps of nipples between."""

    oiled: bool = chance(0.6, "a lubricator at its end")
    gap: float = between(0.1, 0.5, "between blocks / half a block")
    clamped: bool = chance(0.5, "plates clamp the blocks")
    knob: _Knob = nested(_Knob, "hood and knob of the regulator")
    under: float = between(0.2, 1.2, "depth of the plug below / half the block")
    gauge: _Manometer = nested(_Manometer, "gauge")
    over: bool = chance(0.35, "the regulator stands on the filter")
    oiler: _Bowl = nested(_Bowl, "bowl of the lubricator", when=lambda p: p.oiled)

    def build(self, t: Table) -> Model:
        block = self.block
        half, end, n = block.half, block.end, sides_of(t, block.half, self.facets)
        step = (2 + self.gap) * half
        blocks = (1 if self.over else 2) + self.oiled
        first, length = half + end, round(2 * (half + end) + (blocks - 1) * step, 6)
        spots = [first + k * step for k in range(blocks)]
        ports = block.port(t, 0.0, 1.2 * end), block.port(t, length - 1.2 * end, length)
        core = block.solid(t)
        bowl, more = self.bowl.solids(half, block.bottom, n)
        last = [ports[1]]
        t.add(_FILTER, ports[0], moved(core, at(first)), *([] if blocks > 1 else last), of="valve")
        self._hung(t.at(first), bowl, more)
        regulator = t.at(first if self.over else spots[1])
        if not self.over:
            plug = turned(outline(0.5 * half, -block.bottom - self.under * half, 0.65 * half, -block.bottom + 0.002), n)
            out = [] if self.oiled else [moved(last[0], at(-spots[1]))]
            regulator.add(_BODY, core, plug, *out)
        self.knob.build(regulator.at(0, 0, block.top), half, n)
        self.gauge.build(regulator.at(0, -block.before).along("-y"), n)
        if self.oiled:
            oiler = t.at(spots[-1])
            crown = _crown("sight dome", block, n)
            oiler.add(_FILTER, core, *crown, moved(last[0], at(-spots[-1])), of="valve")
            self._hung(oiler, *self.oiler.solids(half, block.bottom, n))
        for near in spots[:-1]:
            self._joint(t.at(near + step / 2), (0.5 * self.gap + 0.02) * half, n)
        return t.model(length, "welded", "air service unit", split=True)

    def _hung(self, t: Table, bowl: list[Solid], more: list[Solid]) -> None:
        t.add(_FILTER, *bowl)
        t.add(_FILTER, *more, of="valve")

    def _joint(self, t: Table, half: float, n: int) -> None:
        """What joins two blocks about the origin: a nipple, maybe between clamped plates [m]."""
        r = PIPES[self.dn].radius
        solids = [cylinder(1.1 * r, -half, half, n)]
        if self.clamped:
            tall = 0.9 * (self.block.top + self.block.bottom)
            solids.append(box((tall, 1.7 * self.block.before, 1.3 * half)))
        t.add(_FILTER, *(along("x", one) for one in solids), of="valve")


SERVICE = families_of(AirRegulator, AirFilter, AirUnit)
