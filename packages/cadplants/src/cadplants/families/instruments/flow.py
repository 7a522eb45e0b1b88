"""Flow meters in a line, on an outlet, on a pipe's outside and on the floor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import STEM, Gland, Housing
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import Gauge, bent, put, t_handle
from cadplants.families.instruments.pressure import COPLANAR, DifferentialHead
from cadplants.families.valves.valve import flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES, SIZES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FLOW_BUILDS", "NAME", "FlowMeter", "measuring_tube"]

NAME = "flow meter"
Outline = Sequence[tuple[float, float]]


class FlowMeter(Gauge, place="inline", label=NAME, bundle=NAME, sizes=SIZES):
    """A flow meter."""


def measuring_tube(
    dn: int, style: ModelingStyle, length: float, middle: Outline | None = None, throat: Outline = ()
) -> Solid:
    """A measuring tube between flanges; its middle as wide as a pipe and its bore straight unless given [m]."""
    r = 1.02 * PIPES[dn].radius
    low = plate_thickness(dn) + min(0.7 * nut_room(dn), 0.15 * length)
    return flanged_body(dn, style, length, middle or [(r, low), (r, length - low)], throat)


class _Electronics(Params):
    """A post out of a body with a transmitter's housing."""

    shape: str = given("", "how the housing is made, any way if empty")
    rise: float = between(0.03, 0.12, "height of the post over the body", "m")
    radius: float = between(0.011, 0.02, "of the post", "m")
    collared: bool = chance(0.4, "a collar round the post")
    housing: Housing = nested(Housing, "housing", fixed=lambda p: {"shape": p.shape} if p.shape else {})
    turn: float = among((0.0, np.pi / 2, np.pi), "which way the housing looks", "rad")

    def build(self, t: Table, top: float, clear: float = 0.0) -> None:
        """Puts it down about z, on a body this high that needs this much more room [m]."""
        rise, r = top + clear + self.rise, self.radius
        collar = [cylinder(1.7 * r, rise - 0.01, rise, 14)] if self.collared else []
        t.add(NAME, cylinder(r, 0.8 * top, rise, 14), *collar)
        put(t.at(0, 0, rise - 0.002).spun("z", self.turn), "transmitter", self.housing.solid(t.style))


_ELECTRONICS, _CELL = "post with a housing", "cell with its electronics"


class _Impulse(Params):
    """Two tappings on top of a tube, their valves, and a differential transmitter over them."""

    high: float = between(0.09, 0.16, "height of the transmitter over the tube", "m")
    coplanar: bool = chance(0.5, COPLANAR)
    head: DifferentialHead = nested(DifferentialHead, _CELL, fixed=lambda p: {"coplanar": p.coplanar})

    def build(self, t: Table, half: float, r: float) -> None:
        """Puts it down over the origin, the tappings this far to either side, on a tube of a radius [m]."""
        high, ends = r + self.high, []
        for s in (-1, 1):
            boss = [cylinder(0.016, 0.7 * r, r + 0.014, 12), cylinder(0.0068, r, r + 0.05, 10)]
            boss.append(box((0.024, 0.024, 0.03), (0, 0, r + 0.045)))
            put(t.at(s * half), STEM, *boss, along("-y", t_handle(0.045, 0.04), 0, -0.011, r + 0.045))
            way = [(s * half, 0, r + 0.058), (s * half, 0, high - 0.02)]
            way += [(0.02 * s, 0, high - 0.005), (0.02 * s, 0, high + 0.02)]
            ends.append(bent(way, 0.0065, t.style))
        put(t, STEM, *ends)
        self.head.build(t.at(0, 0, high + 0.015))


class Ultrasonic(FlowMeter, name="flow meter/ultrasonic"):
    """An inline ultrasonic meter: slanting transducer pockets on both sides of a spool, a box on a neck."""

    long: float = between(3.5, 6, "its length over 0.22 m / radius of the pipe")
    lean: float = between(0.6, 0.9, "of the pockets", "rad")
    paths: int = whole(1, 3, "pairs of pockets", when=lambda p: p.dn >= 80, otherwise=1)
    shape: str = among(("rectangle", "double", "pot"), "how its electronics are made")
    electronics: _Electronics = nested(_Electronics, _ELECTRONICS, fixed=lambda p: {"shape": p.shape})

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r, far = round(0.22 + self.long * radius, 6), 0.012 + 0.1 * radius, 1.5 * radius
        t.add(NAME, measuring_tube(self.dn, t.style, length))
        middle, solids = (
            t.at(length / 2),
            (cylinder(r, 0.5 * radius, far + 0.04, 14), hexagon(2.3 * r, far + 0.035, far + 0.055)),
        )
        for k in range(self.paths):
            for s in (-1, 1):
                pocket = middle.at(s * 0.25 * radius, 0, (k - (self.paths - 1) / 2) * 0.5 * radius)
                pocket = pocket.spun("z", 0.0 if s < 0 else np.pi).along("y").spun("y", -self.lean)
                pocket.add(NAME, *solids, of="trim")
        self.electronics.build(middle, radius)
        return t.model(length, kind=NAME)


class ClampOn(FlowMeter, name="flow meter/clamp-on", place="carrier"):
    """A clamp-on ultrasonic meter: two transducers on a rail or apart, bands round the pipe, cables to a small box."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    tall: float = between(0.02, 0.04, "height of a transducer", "m")
    wide: float = between(0.018, 0.03, "width of a transducer", "m")
    long: float = between(0.035, 0.06, "length of a transducer", "m")
    apart: float = between(0.045, 0.07, "from the middle to a transducer", "m")
    opposite: bool = chance(0.4, "the second transducer is below the pipe")
    metal: str = among(("gauge", "electrical", "rubber"), "kind of material of the transducers")
    railed: bool = chance(0.6, "both on a rail", when=lambda p: not p.opposite)
    housing: Housing = nested(Housing, "box", fixed=lambda _: {"shape": "rectangle"})

    def build(self, t: Table) -> Model:
        r, n, tall, wide, long = t.pipe.radius, t.n(t.pipe.radius), self.tall, self.wide, self.long
        apart, top = self.apart, r + tall + 0.002
        # Feet that fit the round pipe: a block let into its skin by a hair would do, so its foot is a saddle.
        foot = box((0.8 * long, min(wide, 0.6 * r), 0.004), (0, 0, r + 0.0015))
        body = merge([box((long, wide, tall), (0, 0, r + 0.003 + tall / 2)), foot])
        turns = (0.0, np.pi if self.opposite else 0.0)
        pods = [moved(body, at(s * apart) @ spun("x", turn)) for s, turn in zip((-1, 1), turns, strict=True)]
        t.add(NAME, *pods, of=self.metal)
        bands = [along("x", ring(r, r + 0.0012, -0.006, 0.006, n), s * apart) for s in (-1, 1)]
        t.add("clamp", *bands, *(box((0.014, 0.012, 0.02), (s * apart, r + 0.006, 0)) for s in (-1, 1)), own=True)
        if self.railed:
            size = (2 * apart + long + 0.02, 0.004, 0.02)
            t.add(NAME, *(box(size, (0, s * (wide / 2 + 0.002), r + 0.012)) for s in (-1, 1)), of="steel")
        lead: list[tuple[float, float, float]] = [
            (-apart, 0, top),
            (-apart, 0, top + 0.05),
            (-0.2 * apart, 0, top + 0.07),
            (0, 0, top + 0.14),
        ]
        other = [(-x, y, z) for x, y, z in lead]
        if self.opposite:  # it comes up before the pipe
            far = top + 0.03
            other = [(apart, 0, -top), (apart, 0, -far), (apart, -far, -far), (apart, -far, top)]
            other += [(0.2 * apart, -0.02, top + 0.1), (0, 0, top + 0.14)]
        t.add(NAME, *(bent(way, 0.003, t.style) for way in (lead, other)), of="rubber")
        # The box stands on a strip that a third band holds behind it.
        strip = box((0.025, 0.004, top + 0.19), (0, r + 0.0022, (top + 0.19) / 2))
        arm = box((0.025, r + 0.004, 0.004), (0, (r + 0.004) / 2, top + 0.137))
        t.add("bracket", strip, arm, along("x", ring(r, r + 0.0012, -0.008, 0.008, n)), of="clamp")
        put(t.at(0, 0, top + 0.135), "transmitter", self.housing.solid(t.style), of="electrical")
        return t.model(kind=NAME)


class Wedge(FlowMeter, name="flow meter/wedge"):
    """A wedge meter: a tube with a V let into its top, a tapping on either side of it, a differential transmitter."""

    impulse: _Impulse = nested(_Impulse, "tappings and transmitter")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, a = round(0.34 + 5 * radius, 6), 0.8 * radius
        corners = np.array(outline(-a, 1.15 * radius, 0.0, 0.3 * radius, a, 1.15 * radius))
        v = along("-y", extrude(corners, -0.6 * radius, 0.6 * radius), length / 2)
        t.add(NAME, measuring_tube(self.dn, t.style, length), v)
        self.impulse.build(t.at(length / 2), 0.05 + 1.2 * radius, 1.15 * radius)
        return t.model(length, kind=NAME)


class Cone(FlowMeter, name="flow meter/cone"):
    """A cone meter: a plain spool with a tapping before the cone and one at it, a differential transmitter above."""

    impulse: _Impulse = nested(_Impulse, "tappings and transmitter")

    def build(self, t: Table) -> Model:
        radius, low = t.pipe.radius, plate_thickness(self.dn) + 0.03
        length = round(0.3 + 4.5 * radius, 6)
        t.add(NAME, measuring_tube(self.dn, t.style, length))
        t.along("x").add(NAME, ring(1.0 * radius, 1.12 * radius, low, low + 0.02, t.n(radius)), of="trim")
        self.impulse.build(t.at(length / 2), 0.035, radius)
        return t.model(length, kind=NAME)


class Venturi(FlowMeter, name="flow meter/venturi"):
    """A Venturi tube (ISO 5167-4): 21 degree inlet cone, throat, long 7 to 15 degree outlet, maybe annular chambers."""

    throat: float = between(0.45, 0.7, "radius of its throat less 3 mm / of the pipe")
    slope: float = between(5, 7.5, "half angle of its outlet", "degrees")
    chambers: bool = chance(0.6, "annular chambers round its tappings")

    def build(self, t: Table) -> Model:
        radius, bore, low = t.pipe.radius, t.pipe.bore, plate_thickness(self.dn) + 0.04
        throat, r = self.throat * radius + 0.003, 1.02 * radius
        inlet, outlet = ((radius - throat) / float(np.tan(np.radians(angle))) for angle in (10.5, self.slope))
        a, b = low + radius, low + radius + inlet
        c = b + 2 * throat + 0.02
        length, neck = round(c + outlet + low + 0.01, 6), 0.85 * throat
        middle = [(r, low), (r, a), (1.1 * throat, b), (1.1 * throat, c), (r, length - low)]
        # Its bore narrows with it, so that a straight one would break through.
        narrow = [(bore, a), (neck, b), (neck, c), (bore, length - low)]
        t.add(NAME, measuring_tube(self.dn, t.style, length, middle, narrow))
        places, half, high = (((low + a) / 2, r), ((b + c) / 2, 1.1 * throat)), 0.3 * throat + 0.008, 1.3 * radius
        for x, q in places if self.chambers else ():
            t.along("x").add(NAME, ring(0.98 * q, 1.25 * q + 0.006, x - half, x + half, t.n(q)))
        for x, q in places:
            tap = [cylinder(0.012, 0.9 * q, high + 0.03, 12), hexagon(0.03, high + 0.02, high + 0.045)]
            put(t.at(x), STEM, *tap, along("-y", t_handle(0.05, 0.045), 0, -0.01, high + 0.034))
        return t.model(length, kind=NAME)


class Nozzle(FlowMeter, name="flow meter/nozzle", sizes=sizes_between(25)):
    """A flow nozzle or carrier ring between flanges (ISO 5167-3): a thick ring with two tappings and a cell above."""

    thick: float = between(0.04, 0.08, "thickness of the ring", "m")
    rise: float = between(0.03, 0.09, "from the flanges up to the valves", "m")
    coplanar: bool = chance(0.6, COPLANAR)
    head: DifferentialHead = nested(
        DifferentialHead, _CELL, fixed=lambda p: {"coplanar": p.coplanar, "shape": "double"}
    )

    def build(self, t: Table) -> Model:
        size, bore, thick, n = t.flange, t.pipe.bore, self.thick, t.n(t.flange.circle / 2)
        outer, rise = 0.49 * (size.circle - size.bolt), size.outer / 2 + self.rise
        body = ring(0.8 * bore, outer, 0.0, thick, n)
        t.along("x").add(NAME, body, ring(0.5 * bore, 0.85 * bore, 0.2 * thick, 0.6 * thick, n), of="trim")
        lines = [rod((x * thick, 0, outer - 0.004), (x * thick, 0, rise), 0.0055, 10) for x in (0.22, 0.78)]
        block = box((thick + 0.03, 0.05, 0.05), (thick / 2, 0, rise + 0.02))
        handles = [along("-y", t_handle(0.05, 0.045), x * thick, -0.024, rise + 0.02) for x in (0.1, 0.9)]
        put(t, STEM, *lines, block, *handles)
        self.head.build(t.at(thick / 2, 0, rise + 0.0445))
        return t.model(round(thick, 6), "wafer", NAME)


class PitotBar(FlowMeter, name="flow meter/pitot bar", place="tap", sizes=(15,)):
    """An averaging pitot bar: a weld boss, a nut or a flange pair, a head with two valves and a cell."""

    out: float = between(0.06, 0.14, "length of the bar outside", "m")
    screwed: bool = chance(0.5, "nuts, not a pair of flanges")
    coplanar: bool = chance(0.7, COPLANAR)
    head: DifferentialHead = nested(DifferentialHead, _CELL, fixed=lambda p: {"coplanar": p.coplanar})
    turn: float = among((0.0, np.pi / 2), "which way it stands", "rad")

    def build(self, t: Table) -> Model:
        t, high, n = t.spun("z", self.turn), self.out + 0.02, 14
        body = [turned(outline(0.026, 0.0, 0.02, 0.02, 0.016, 0.024), n), cylinder(0.009, -0.04, self.out, n)]
        if self.screwed:
            body += [hexagon(0.036, 0.022, 0.045), hexagon(0.032, 0.048, 0.065)]
        else:
            body += [extrude(rounded_rectangle(0.09, 0.09, 0.01, 2), z, z + 0.012) for z in (0.024, 0.05)]
            rod_ = cylinder(0.005, 0.015, 0.075, 8)
            body += [moved(rod_, at(x, y)) for x in (-0.033, 0.033) for y in (-0.033, 0.033)]
        handles = [along(a, t_handle(0.05, 0.045), s * 0.039, 0, high) for a, s in (("x", 1), ("-x", -1))]
        t.add(NAME, *body, box((0.08, 0.03, 0.045), (0, 0, high)), *handles, of="trim")
        self.head.build(t.at(0, 0, high + 0.022))
        return t.model(kind=NAME)


class ThermalInsertion(FlowMeter, name="flow meter/thermal insertion", place="tap", sizes=(15,)):
    """A thermal mass meter to push in: a ball valve, a compression fitting, a long graduated rod, a housing."""

    long: float = between(0.12, 0.35, "length of the rod outside", "m")
    radius: float = between(0.006, 0.0105, "of the rod", "m")
    valved: bool = chance(0.6, "goes through a ball valve")
    housing: Housing = nested(Housing, "electronics")
    turn: float = between(0, 6, "which way they look", "rad")

    def build(self, t: Table) -> Model:
        r, n, low = self.radius, 12, 0.073 if self.valved else 0.01
        if self.valved:
            nuts = [hexagon(0.034, 0.006, 0.02), hexagon(0.034, 0.056, 0.07)]
            valve = [cylinder(0.013, 0.0, 0.075, n), *nuts, cylinder(0.021, 0.02, 0.056, n)]
            t.add("valve body", *valve, own=True)
            lever = box((0.11, 0.018, 0.005), (0.045, 0, 0.036))
            spindle = cylinder(0.005, 0.018, 0.036, 8)
            t.at(0, 0, 0.038).along("y").add("lever", spindle, lever, own=True, turns=Turning("lever"))
        fitting = [hexagon(3.6 * r, low - 0.001, low + 0.016), hexagon(3.2 * r, low + 0.018, low + 0.034)]
        t.add(NAME, cylinder(r, 0.0, low + self.long, n), *fitting, of="trim")
        put(t.at(0, 0, low + self.long - 0.003).spun("z", self.turn), "transmitter", self.housing.solid(t.style))
        return t.model(kind=NAME)


class Wafer(FlowMeter, name="flow meter/wafer"):
    """A magnetic or vortex meter as a wafer between the flanges: a short drum inside the bolts, a neck, a housing."""

    long: float = between(0.06, 0.1, "its length, less half the radius of the pipe", "m")
    plain: bool = chance(0.5, "its drum has no waist")
    electronics: _Electronics = nested(_Electronics, _ELECTRONICS)

    def build(self, t: Table) -> Model:
        size, bore = t.flange, 0.95 * t.pipe.bore
        outer, length = 0.485 * (size.circle - size.bolt), round(self.long + 0.5 * t.pipe.radius, 6)
        steps, n = [(outer, 0.0, 1.0)], t.n(outer)
        if not self.plain:
            steps = [(outer, 0.0, 0.14), (0.88 * outer, 0.13, 0.87), (outer, 0.86, 1.0)]
        t.add(NAME, *(about_x(ring(bore, q, a * length, b * length, n)) for q, a, b in steps))
        self.electronics.build(t.at(length / 2), outer, size.outer / 2 - outer)
        return t.model(length, "wafer", NAME)


class BoxyRemote(FlowMeter, name="flow meter/boxy remote"):
    """A magnetic meter in a boxy or eight-sided casing with a seam, a terminal box on its top."""

    long: float = between(2.2, 3.2, "its length over 60 mm / diameter of the pipe")
    boxy: bool = chance(0.5, "its casing is square, not eight-sided")
    wide: float = between(0.07, 0.12, "width of the terminal box", "m")
    tall: float = between(0.04, 0.07, "height of the terminal box", "m")
    glands: tuple[Gland, ...] = several(made(Gland), 2, "cable glands")

    def build(self, t: Table) -> Model:
        length = round(max(0.2, self.long * t.pipe.outer + 0.06), 6)
        low, reach = plate_thickness(self.dn) + min(nut_room(self.dn), 0.2 * length), 1.45 * t.pipe.radius + 0.01
        if self.boxy:
            casing = extrude(rounded_rectangle(2 * reach, 2 * reach, 0.3 * reach, 3), low, length - low)
        else:
            casing = turned(outline(1.08 * reach, low, 1.08 * reach, length - low), 8, np.pi / 8)
        seam = box((length - 2 * low, 2.36 * reach, 0.006), (length / 2, 0, 0))
        t.add(NAME, measuring_tube(self.dn, t.style, length), along("x", casing), seam)
        wide, tall, z = self.wide, self.tall, 0.95 * reach
        crate = [cylinder(0.02, 0.8 * z, z + 0.03, 12), box((wide, wide, tall), (0, 0, z + 0.028 + tall / 2))]
        crate.append(box((1.04 * wide, 1.04 * wide, 0.006), (0, 0, z + 0.03 + tall)))
        for x, gland in zip((-0.25, 0.25), self.glands, strict=True):
            crate.append(along("-y", gland.solid(t.style), x * wide, -0.5 * wide + 0.001, z + 0.028 + 0.4 * tall))
        put(t.at(length / 2), "transmitter", *crate, of="electrical")
        return t.model(length, kind=NAME)


class StraightCoriolis(FlowMeter, name="flow meter/straight coriolis", sizes=sizes_between(most=150)):
    """A straight-tube or slim Coriolis meter: a long case with end cones or a belly, a housing on a neck."""

    long: float = between(8, 12, "its length over 0.35 m / radius of the pipe")
    bellied: bool = chance(0.4, "its case has a belly")
    banded: bool = chance(0.5, "two bands round its case")
    electronics: _Electronics = nested(_Electronics, _ELECTRONICS)

    def build(self, t: Table) -> Model:
        length = round(0.35 + self.long * t.pipe.radius, 6)
        low, neck, r = plate_thickness(self.dn) + 0.05, 0.9 * (0.485 * t.flange.hub), 1.7 * t.pipe.radius + 0.015
        far = length - low
        middle = outline(neck, low, r, low + 0.8 * r, r, far - 0.8 * r, neck, far)
        if self.bellied:
            belly = (0.9 * r, low + 0.5 * r, 1.15 * r, length / 2, 0.9 * r, far - 0.5 * r)
            middle = outline(neck, low, *belly, neck, far)
        t.add(NAME, measuring_tube(self.dn, t.style, length, middle), of="trim")
        if self.banded:
            bands = [ring(0.95 * r, 1.06 * r, s * length, s * length + 0.012, t.n(r)) for s in (0.4, 0.6)]
            t.along("x").add(NAME, *bands, of="trim")
        self.electronics.build(t.at(length / 2), 1.1 * r)
        return t.model(length, kind=NAME)


FLOW_BUILDS = families_of(
    Ultrasonic, ClampOn, Wedge, Cone, Venturi, Nozzle, PitotBar, ThermalInsertion, Wafer, BoxyRemote, StraightCoriolis
)
