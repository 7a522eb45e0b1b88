"""Small valves with threaded or socket ends: the pipe reaches their hexagons; along x from 0, stem towards +z."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.drive import Wheel, drive_of, put_spindle
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES, sizes_between
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["THREADED", "hex_end"]

_LONG = "length / radius of the pipe"
_SQUARE = tuple((a, b) for a in BOTH for b in BOTH)


def hex_end(dn: int, low: float, high: float, style: ModelingStyle, corners: int = 6) -> Solid:
    """The wrench end of a threaded fitting along x: six or eight flats (ISO 7-1 thread inside where it is hollow)."""
    radius = PIPES[dn].radius
    flats = 2 * (1.12 * radius + 0.003)
    outline = circle(flats / 2 / np.cos(np.pi / corners), corners, phase=np.pi / corners)
    holes = (circle(radius * 0.98, max(8, style.round(radius))),) if style.hollow else ()
    return along("x", extrude(outline, low, high, holes))


class _Threaded(Valve, sizes=sizes_between(15, 50)):
    """A threaded valve in a line."""

    def done(self, t: Table, length: float, kind: str) -> Model:
        """What was put down, as a valve in a line."""
        return t.model(round(length, 6), "welded", kind)


class _Run(Params):
    """Two wrench ends and a middle between them."""

    flats: int = among((6, 6, 8), "of its ends")
    shape: str = among(("tapered", "round", "stepped"), "shape of its middle")

    def build(self, t: Table, length: float, swell: float) -> float:
        """Puts it down along x; returns the radius of the middle, about ``swell`` times the pipe's [m]."""
        r, end, bulge = t.pipe.radius, 0.24 * length, swell * t.pipe.radius + 0.004
        if self.shape == "tapered":
            half = ((1.1 * r, 0.8 * end), (bulge, 1.3 * end))
            profile = [*half, *((a, length - z) for a, z in half[::-1])]
        elif self.shape == "round":
            reach = length / 2 - 0.7 * end
            shares = np.linspace(-1, 1, 9)
            profile = [(max(0.3, np.sqrt(1 - s * s)) * bulge, length / 2 + s * reach) for s in shares]
        else:
            profile = outline(bulge, 0.9 * end, bulge, 0.62 * length, 1.12 * bulge, 0.62 * length)
            profile += outline(1.12 * bulge, 0.7 * length, 0.95 * bulge, length - 0.9 * end)
        ends = [hex_end(t.dn, *span, t.style, self.flats) for span in ((0.0, end), (length - end, length))]
        t.add("valve body", ends[0], along("x", turned(profile, t.n(bulge))), ends[1])
        return bulge


class ThreadedBall(_Threaded, name="ball valve/threaded", weight=3):
    """A two-piece threaded ball valve with a lever, a wing or a small actuator, maybe a mounting pad (ISO 5211)."""

    long: float = between(3.4, 4.6, _LONG)
    run: _Run = nested(_Run, "body")
    padded: bool = chance(0.4, "a mounting pad")
    drive: Any = drive_of("lever", "lever", "lever", "wing", "wing", "pneumatic", "electric")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.025
        bulge, up = self.run.build(t, length, 1.3), t.at(length / 2)
        boss, top = 0.45 * r + 0.003, bulge + 0.25 * r + 0.004
        up.add("valve body", cylinder(boss, 0.6 * bulge, top, t.n(boss)))
        if self.padded:
            half = 1.5 * boss
            holes = tuple(circle(0.15 * half, 8, (a * 0.7 * half, b * 0.7 * half)) for a, b in _SQUARE)
            pad = extrude(rounded_rectangle(2 * half, 2 * half, 0.3 * half, 3), top - 0.004, top, holes)
            up.add("valve body", pad)
        up = up.at(0, 0, top)
        put_spindle(up, 0, 0.008, 0.5 * boss)
        up.add("nut", hexagon(1.3 * boss, 0.008, 0.013))
        self.drive.build(up.at(0, 0, 0.006))
        return self.done(t, length, "ball valve")


class ThreePiece(_Threaded, name="ball valve/three-piece", weight=1.5):
    """A three-piece ball valve: two ends and a middle block between square plates held by four bolts."""

    drive: Any = drive_of("lever", "lever", "pneumatic", "electric")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        x, half, plate, mid, n = (5.0 * r + 0.03) / 2, 1.55 * r + 0.006, 0.2 * r + 0.006, 0.7 * r + 0.006, t.n(r)
        bore, flow = 0.9 * r if t.style.hollow else 0.0, t.at(x).along("x")
        holes = (circle(bore, n),) if bore else ()
        flow.add("valve body", ring(bore, 1.35 * r, -mid, mid, n))
        for low, high, far, end in ((-mid - plate, -mid, -x, -mid - plate), (mid, mid + plate, mid + plate, x)):
            flat = extrude(rounded_rectangle(2 * half, 2 * half, 0.35 * half, 3), low, high, holes)
            flow.add("valve body", flat, ring(bore, 1.25 * r, far, end, n))
        boss, top, reach = 0.5 * r + 0.003, 1.35 * r + 0.3 * r + 0.004, mid + plate
        up = t.at(x)
        up.add("valve body", cylinder(boss, 1.1 * r, top, 12))
        shank = cylinder(0.1 * r + 0.002, -reach - 0.008, reach + 0.008, 8)
        bolt = merge([shank, hexagon(0.4 * r + 0.006, reach, reach + 0.005)])
        flow.add("bolt", *(moved(bolt, at(a * 0.75 * half, b * 0.75 * half)) for a, b in _SQUARE))
        up = up.at(0, 0, top)
        put_spindle(up, 0, 0.01, 0.5 * boss)
        self.drive.build(up.at(0, 0, 0.008))
        return self.done(t, 2 * x, "ball valve")


class _Bronze(_Threaded, weight=1.5):
    """A threaded bronze gate or globe valve: union bonnet, packing nut, wheel."""

    tall: ClassVar[float] = 0.0  # height of the neck / radius of the pipe
    said: ClassVar[str] = ""

    long: float = between(3.2, 4.4, _LONG)
    run: _Run = nested(_Run, "body")
    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.025
        bulge, up = self.run.build(t, length, 1.35), t.at(length / 2)
        n, rise = t.n(bulge), bulge + self.tall * r
        up.add("valve body", turned(outline(0.85 * bulge, 0.4 * bulge, 0.8 * bulge, rise), n))
        up = up.at(0, 0, rise)
        up.add("valve bonnet", hexagon(1.9 * bulge, 0, 0.35 * r + 0.004), cylinder(0.5 * bulge, 0, 1.2 * r, n))
        up.add("gland", hexagon(0.9 * bulge, 1.1 * r, 1.5 * r + 0.004))
        up, slim = up.at(0, 0, 1.5 * r + 0.004), 0.003 + 0.12 * r
        put_spindle(up, 0, 0.02 + 1.2 * r, slim)
        self.wheel.build(up, 0.02 + 1.3 * r, 0.01 + 0.8 * r)
        return self.done(t, length, self.said)


class ThreadedGate(_Bronze, name="gate valve/threaded"):
    """A threaded bronze gate valve."""

    tall: ClassVar[float] = 1.2
    said: ClassVar[str] = "gate valve"


class ThreadedGlobe(_Bronze, name="globe valve/threaded"):
    """A threaded bronze globe valve."""

    tall: ClassVar[float] = 0.3
    said: ClassVar[str] = "globe valve"


class ThreadedCheck(_Threaded, name="check valve/threaded", weight=1.5):
    """A threaded check valve: spring type in a cylinder, or swing type with a screwed cap."""

    run: _Run = nested(_Run, "body")
    capped: bool = chance(0.5, "a screwed cap over a swinging disc")
    tilt: float = among((0.0, 0.5), "of the cap, downstream", "rad", when=lambda p: p.capped, otherwise=0.0)

    def build(self, t: Table) -> Model:
        length = 3.6 * t.pipe.radius + 0.03
        bulge = self.run.build(t, length, 1.3)
        if self.capped:
            cap = cylinder(0.8 * bulge, 0.3 * bulge, 1.35 * bulge, t.n(bulge))
            nut = hexagon(1.2 * bulge, 1.35 * bulge, 1.65 * bulge)
            t.at(length / 2).spun("y", self.tilt).add("valve bonnet", cap, nut)
        return self.done(t, length, "check valve")


class Solenoid(_Threaded, name="solenoid valve/threaded"):
    """A solenoid valve: a threaded body with a coil on a tube and a plug with its cable gland."""

    run: _Run = nested(_Run, "body")

    def build(self, t: Table) -> Model:
        length, side = 3.6 * t.pipe.radius + 0.03, 0.03 + 0.35 * t.pipe.radius
        bulge, up = self.run.build(t, length, 1.3), t.at(length / 2)
        up.add("valve bonnet", box((1.9 * bulge, 1.9 * bulge, 0.25 * bulge), (0, 0, 1.0 * bulge)))
        up = up.at(0, 0, 1.1 * bulge)
        up.add("valve stem", cylinder(0.25 * side, 0, 1.7 * side, 12))
        coil = extrude(rounded_rectangle(1.1 * side, side, 0.15 * side, 3), 0.2 * side, 1.4 * side)
        plug = box((0.6 * side, 0.5 * side, 0.5 * side), (0.8 * side, 0, 0.8 * side))
        gland, head = along("x", hexagon(0.35 * side, 0, 0.3 * side), 1.1 * side, 0, 0.8 * side), up.bundled("actuator")
        head.add("actuator", coil, plug, gland, of="rubber", own=True)
        head.add("nut", hexagon(0.6 * side, 1.4 * side, 1.55 * side))
        return self.done(t, length, "solenoid valve")


class Balancing(_Threaded, name="globe valve/balancing"):
    """A balancing valve: threaded, slanting bonnet, a big plastic knob, two test points."""

    run: _Run = nested(_Run, "body")

    def build(self, t: Table) -> Model:
        length = 4.6 * t.pipe.radius + 0.035
        b = self.run.build(t, length, 1.25)
        n, way = t.n(b), t.at(0.5 * length).spun("y", 0.78)
        way.add("valve bonnet", turned(outline(0.8 * b, 0.0, 0.75 * b, 2.8 * b, 0.6 * b, 2.9 * b), n))
        knob = outline(1.1 * b, 2.9 * b, 1.2 * b, 3.0 * b, 1.2 * b, 4.0 * b, 1.0 * b, 4.2 * b)
        way.add("handwheel", turned(knob, max(10, n)), turns=Turning("handwheel"))
        for f in (0.3, 0.7):
            test = rod((0, 0.3 * b, 0.5 * b), (0, 1.6 * b, 1.2 * b), 0.16 * b, 8)
            t.at(length * f).add("valve body", test, of="trim")
        return self.done(t, length, "globe valve")


class ThreadedRelief(Valve, name="relief valve/threaded", place="tap"):
    """A threaded safety valve upright on a tap or a pipe's end: along x from its inlet, outlet aside, cap or knob."""

    size: int = among((15, 20, 25), "nominal size of its inlet", "mm")
    tall: float = between(2.0, 4.0, "height of the bonnet / radius of the chest")
    knob: bool = chance(0.5, "a knob rather than a lever")

    def build(self, t: Table) -> Model:
        r = PIPES[self.size].radius
        n, b, low, tall = t.n(1.4 * r), 1.4 * r + 0.004, 0.024 + 0.3 * r, self.tall * (1.4 * r + 0.004)
        inlet = [cylinder(0.9 * r, 0.0, 0.015, n), hexagon(2.3 * r + 0.004, 0.012, 0.026 + 0.3 * r)]
        inlet.append(turned(outline(0.9 * b, low, b, low + 0.5 * b, b, low + 2.0 * b), n))
        out = merge([cylinder(1.0 * r, 0.0, 1.6 * b, n), hexagon(2.4 * r + 0.004, 1.4 * b, 2.1 * b)])
        t.add("valve body", *inlet, along("y", out, 0, 0, low + b))
        up = t.at(0, 0, low + 2.0 * b)
        up.add("valve bonnet", turned(outline(0.85 * b, 0, 0.75 * b, tall), n), hexagon(1.7 * b, 0, 0.4 * b))
        if self.knob:
            knob = outline(0.9 * b, tall, 1.0 * b, tall + 0.3 * b, 0.95 * b, tall + b)
            up.add("handwheel", turned(knob, max(8, n)))
        else:
            arm = rod((0, -0.2 * b, tall), (0, 2.4 * b, 0.8 * tall), 0.15 * b, 8)
            up.add("lever", arm, cylinder(0.4 * b, tall, tall + 0.5 * b, n))
        return t.model(kind="relief valve")


class AirVent(Valve, name="air vent/float", place="tap"):
    """An automatic air vent: a float chamber on a nipple with a small cap."""

    chamber: float = between(0.018, 0.04, "radius of the chamber", "m")

    def build(self, t: Table) -> Model:
        r, marks = self.chamber, ((1, 0), (1, 2.4), (0.5, 2.9), (0.3, 3.0))
        shape = [(0.009, 0.0), (0.009, 0.02), *((a * r, 0.03 + z * r) for a, z in marks)]
        t.add("valve body", turned(shape, t.n(0.03)))
        t.at(0.4 * r, 0, 0.03 + 2.8 * r).add("valve bonnet", cylinder(0.3 * r, 0.0, 0.5 * r, 10), of="trim")
        return t.model(kind="air vent")


class Cock(Valve, name="sampling valve/cock", place="tap"):
    """A drain or sampling cock on an outlet: hexagon body, spout aside, a wing or lever."""

    body: float = between(0.008, 0.014, "radius of its body", "m")
    drive: Any = drive_of("wing", "lever", "bar", radius=lambda p: p.body)

    def build(self, t: Table) -> Model:
        r, n, top = self.body, 12, 0.03 + 4 * self.body
        solids = [cylinder(0.8 * r, 0.0, 0.02, n), hexagon(2.4 * r, 0.015, 0.015 + 1.6 * r), cylinder(r, 0.015, top, n)]
        spout = rod((0, 0, 0.02 + 2.2 * r), (0, 4 * r, 0.02 + 1.4 * r), 0.7 * r, n)
        t.add("valve body", *solids, spout, of="trim")
        self.drive.build(t.at(0, 0, top))
        return t.model(kind="sampling valve")


THREADED = families_of(
    ThreadedBall, ThreePiece, ThreadedGate, ThreadedGlobe, ThreadedCheck, Solenoid, Balancing, ThreadedRelief,
    AirVent, Cock,
)  # fmt: skip
