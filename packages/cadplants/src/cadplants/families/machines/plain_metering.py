"""Metering pumps and pumps without a coupling as asset packs have them: plain solids, in pieces or in one mesh."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.melting import Melting
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, LYING, PUMP, dead_room
from cadplants.families.machines.plain_parts import PlainBed, PlainMotor, PlainPort, port_of
from cadplants.model.family import Model, Port
from cadplants.model.standards import PIPES, smaller
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, along, box, cylinder, dome, hexagon, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_METERING"]


class _MeltedPump(Melting, group=PUMP, label="pump", bundle=CASING):
    """A pump of few solids that may be one mesh."""

    melted: bool = chance(0.6, "all of it is one mesh")

    def melt(self, t: Table) -> None:
        """Makes one mesh of what was put down, if asked for."""
        if self.melted:
            solids = [part.solid for part in t.parts]
            t.parts.clear()
            t.add("pump", *solids, of="pump")


def _motored(p: Any) -> bool:
    return bool(p.drive != "solenoid")


def _knobbed(p: Any) -> bool:
    return bool(p.knob != "none")


def _spaced(p: Any) -> bool:
    return bool(p.lantern > 0)


def _raised(p: Any) -> bool:
    return bool(p.stands in ("bracket", "table", "post"))


class PlainMetering(_MeltedPump, name="pump/plain metering", sizes=(15, 20, 25, 32), weight=1.5):
    """A metering pump: a gear case with a motor, or a solenoid's box; a liquid head with valves, a stroke knob."""

    size: float = between(0.05, 0.15, "half the length of the gear case", "m")
    drive: str = among(("upright", "upright", "upright", "behind", "aside", "solenoid", "solenoid"), "what drives it")
    case: str = among(("box", "box", "rounded", "drum", "lying drum", "stepped", "wedge"), "form of the gear case")
    tall: float = between(1.2, 2.8, "height of the gear case / size")
    wide: float = between(1.0, 2.2, "width of the gear case / size")
    motor: PlainMotor = nested(PlainMotor, "motor", when=_motored)
    motor_size: float = between(0.45, 1.0, "radius of the motor / size", when=_motored)
    slender: float = between(1.9, 3.8, "length of the motor / its radius", when=_motored)
    neck: float = among((0.0, 0.15, 0.5, 0.9), "length of what carries the motor / size", when=_motored)
    turn: int = among((0, 1, 2, 3), "quarter turns of the motor", when=_motored)
    paneled: bool = chance(0.6, "a panel on the box", when=lambda p: not _motored(p))
    heads: int = among(lambda p: (1, 1, 1, 1, 2, 3) if _motored(p) else (1,), "liquid heads side by side")
    head: str = among(("disc", "disc", "double", "block", "square", "dome", "plunger"), "form of the liquid head")
    head_size: float = between(0.4, 1.05, "radius of the liquid head / size")
    deep: float = between(0.25, 0.9, "depth of the liquid head / its radius")
    lantern: float = among((0.0, 0.2, 0.6, 1.2), "from the case to the liquid head / size")
    carrier: str = among(("tube", "cone", "arms"), "what is between them", when=_spaced)
    valve: str = among(("pipe", "hexagon", "stepped", "block"), "form of the valves")
    valve_size: float = between(0.18, 0.4, "radius of a valve / of the head")
    valve_long: float = between(0.3, 1.0, "how far a valve stands out / radius of the head")
    ported: bool = chance(0.6, "lines come to it", when=_motored)
    discharge: PlainPort = port_of(lambda p: p.dn, "discharge", when=lambda p: p.ported)
    knob: str = among(("back", "back", "aside", "aside", "top", "none"), "where its stroke knob is")
    knob_form: str = among(("drum", "stepped", "cone", "wheel"), "form of the knob", when=_knobbed)
    knob_size: float = between(0.18, 0.45, "radius of the knob / size", when=_knobbed)
    knob_long: float = between(0.25, 1.0, "length of the knob / size", when=_knobbed)
    stands: str = among(("floor", "sole", "sole", "bed", "bracket", "table", "post"), "what it stands on")
    bed: PlainBed = nested(PlainBed, "bed", when=lambda p: p.stands == "bed")
    high: float = between(0.3, 1.0, "height of bracket, table or post", "m", when=_raised)

    def build(self, t: Table) -> Model:
        s, r = self.size, self.head_size * self.size
        pitch = 2.2 * r
        wide = max(self.wide * s, (self.heads - 1) * pitch + 1.2 * s)
        low = {"floor": 0.0, "sole": 0.03}.get(self.stands, self.high)
        low = self.bed.seat if self.stands == "bed" else low
        high = low + self.tall * s
        below = (1.0 + self.valve_long) * r + 0.01
        axis = max(low + 0.5 * self.tall * s, below) if self.heads == 1 else max(low + 0.45 * self.tall * s, below)
        high = max(high, axis + 0.5 * s)
        n = self.n(t, s)
        t.add(CASING, *self._case(s, wide, low, high, n))
        ports = [
            port
            for k in range(self.heads)
            for port in self._head(t.at(s, (k - (self.heads - 1) / 2) * pitch, axis), r, self.n(t, r))
        ]
        if _motored(self):
            self._drive(t, s, wide, low, high, n)
        elif self.paneled:
            t.add(CASING, box((1.2 * s, 0.012, 0.4 * (high - low)), (0, -wide / 2, 0.62 * high + 0.38 * low)))
        if self.knob != "none":
            self._knob(t, s, wide, low, high)
        self._stand(t, s, wide, low)
        self.melt(t)
        return t.model(ports=ports, kind="dosing pump" if self.drive == "solenoid" else "metering pump")

    def _case(self, s: float, wide: float, low: float, high: float, n: int) -> list[Solid]:
        tall, mid = high - low, (low + high) / 2
        plain = box((2 * s, wide, tall), (0, 0, mid))
        if self.case == "rounded":
            return [extrude(rounded_rectangle(2 * s, wide, 0.3 * min(wide, 2 * s), 3), low, high)]
        if self.case == "drum" and self.heads == 1:
            return [cylinder(s, low, high, n), box((s, 0.9 * s, 0.6 * tall), (0.5 * s, 0, mid))]
        if self.case == "lying drum" and self.heads == 1:
            r = 0.5 * tall
            return [
                along("y", cylinder(r, -wide / 2, wide / 2, n), 0, 0, mid),
                box((2 * s, 0.7 * wide, 0.5 * tall), (0, 0, low + 0.25 * tall)),
                box((2 * s, 0.7 * wide, 0.3 * tall), (0, 0, mid)),
            ]
        if self.case == "stepped":
            lower = box((2 * s, wide, 0.65 * tall), (0, 0, low + 0.325 * tall))
            return [lower, box((1.5 * s, 0.75 * wide, 0.5 * tall), (-0.2 * s, 0, high - 0.25 * tall))]
        if self.case == "wedge":
            side = outline(-s, low, s, low, s, high - 0.35 * tall, 0.2 * s, high, -s, high)
            return [along("-y", extrude(np.array(side), -wide / 2, wide / 2))]
        return [plain]

    def _head(self, t: Table, r: float, n: int) -> list[Port]:
        """Puts a liquid head down before the origin along x; its port, if it has one."""
        gap, deep, line = self.lantern * self.size, self.deep * r, t.along("x")
        if gap:
            inner, back = 0.65 * r, -0.3 * self.size
            if self.carrier == "arms":
                bars = [box((gap + 0.02 - back, 0.25 * r, 0.5 * r), ((gap + back) / 2, y * 0.5 * r, 0)) for y in BOTH]
                t.add(CASING, *bars, along("x", cylinder(0.15 * r, back, gap + 0.01, n)))
            else:
                near = inner if self.carrier == "tube" else 0.4 * r
                line.add(CASING, turned(outline(near, back, near, 0, inner, gap + 0.002), n))
        else:
            line.add(CASING, cylinder(0.6 * r, -0.5 * self.size, 0.002, n))
        x = gap + 0.5 * deep
        line.add(CASING, *self._liquid(r, gap, deep, n), of="trim")
        v, end = self.valve_size * r, (1 + self.valve_long) * r
        valves = [self._valve(v, r, end, n), moved(self._valve(v, r, end, n), spun("x", np.pi))]
        t.at(x).add(CASING, *valves, of="trim")
        if not self.ported:
            return []
        face = end + dead_room(self.dn) + 0.005
        solid, port = self.discharge.build(t, (x, 0, face), (0, 0, 1), face - end + 0.3 * r, n)
        t.add(CASING, solid, of="trim")
        where = t.frame @ port.frame
        return [Port(where, port.dn)]

    def _liquid(self, r: float, low: float, deep: float, n: int) -> list[Solid]:
        """A head about z."""
        high = low + deep
        return {
            "disc": lambda: [cylinder(r, low, high, n)],
            "double": lambda: [
                cylinder(r, low, low + 0.4 * deep, n),
                cylinder(0.7 * r, low, high, n),
                cylinder(r, high - 0.4 * deep, high, n),
            ],
            "block": lambda: [box((1.5 * r, 1.2 * r, deep), (0, 0, (low + high) / 2))],
            "square": lambda: [extrude(rounded_rectangle(1.9 * r, 1.9 * r, 0.2 * r, 2), low, high)],
            "dome": lambda: [cylinder(r, low, low + 0.3 * deep, n), dome(0.8 * r, 0.7 * deep, low + 0.28 * deep, n)],
            "plunger": lambda: [
                cylinder(0.75 * r, low, low + 0.3 * deep, n),
                cylinder(0.45 * r, low, high + 0.5 * r, n),
                cylinder(0.6 * r, high + 0.4 * r, high + 0.7 * r, 6),
                box((1.6 * r, 0.9 * r, 0.9 * r), (0, 0, (low + high) / 2)),
            ],
        }[self.head]()

    def _valve(self, v: float, r: float, end: float, n: int) -> Solid:
        low = 0.3 * r
        if self.valve == "hexagon":
            return hexagon(2 * v, low, end)
        if self.valve == "block":
            return box((1.8 * v, 1.8 * v, end - low), (0, 0, (end + low) / 2))
        if self.valve == "stepped":
            mid = 0.5 * (r + end)
            return turned(outline(v, low, v, mid, 1.4 * v, mid, 1.4 * v, 0.4 * mid + 0.6 * end, v, end), n)
        return cylinder(v, low, end, n)

    def _drive(self, t: Table, s: float, wide: float, low: float, high: float, n: int) -> None:
        m, gap, mid = self.motor_size * s, self.neck * s, (low + high) / 2
        level = max(mid, low + 1.02 * m)
        if self.drive == "upright":
            x, depth = (0.0 if m > 0.7 * s else -0.3 * s), high - low
            root = t.at(x, 0, high).spun("z", self.turn * np.pi / 2)
        elif self.drive == "behind":
            depth, root = 2 * s, t.at(-s, 0, level).spun("z", np.pi).moved(LYING)
        else:
            depth, root = wide, t.at(0, wide / 2, level).spun("z", np.pi / 2).moved(LYING)
        inside = -0.5 * depth
        root.add(CASING, cylinder(0.8 * m, inside if level > mid else 0.6 * inside, gap + 0.002, n))
        if gap:
            root.add(CASING, cylinder(1.05 * m, 0.7 * gap, gap + 0.001, n))
        self.motor.build(root.at(0, 0, gap), m, self.slender * m, max(12, self.n(t, m)))

    def _knob(self, t: Table, s: float, wide: float, low: float, high: float) -> None:
        r, long, mid = self.knob_size * s, self.knob_long * s, (low + high) / 2
        n = max(6, self.n(t, r))
        shapes = {
            "drum": outline(r, 0, r, long),
            "stepped": outline(0.6 * r, 0, 0.6 * r, 0.5 * long, r, 0.5 * long, r, long),
            "cone": outline(r, 0, 0.7 * r, long),
            "wheel": outline(0.3 * r, 0, 0.3 * r, 0.8 * long, 1.5 * r, 0.8 * long, 1.5 * r, long),
        }
        back = self.drive == "behind" and self.knob == "back"
        side = self.knob == "aside" or back or (self.knob == "top" and self.drive == "upright")
        core = cylinder(0.3 * r, -0.5 * min(s, wide), 0.01, n)
        knob = [turned(shapes[self.knob_form], n), core]
        if side:
            t.at(0, -wide / 2, mid).along("-y").add(CASING, *knob, of="rubber")
        elif self.knob == "back":
            t.at(-s, 0, mid).along("-x").add(CASING, *knob, of="rubber")
        else:
            t.at(-0.4 * s, 0, high).add(CASING, *knob, of="rubber")

    def _stand(self, t: Table, s: float, wide: float, low: float) -> None:
        long, broad = 2.6 * s, 1.3 * wide
        if self.stands == "sole":
            t.add("pump base", box((long, broad, low + 0.002), (0, 0, low / 2 + 0.001)), own=False)
        elif self.stands == "bed":
            self.bed.build(t, -1.2 * s, 1.5 * s, broad)
        elif self.stands == "bracket":
            plate = box((long, broad, 0.008), (0, 0, low - 0.003))
            side = box((0.008, broad, 0.6 * long), (-long / 2, 0, low - 0.3 * long))
            t.add("bracket", plate, side, own=False)
            t.add("post", box((0.06, 0.06, low + 0.1), (-long / 2 - 0.03, 0, (low + 0.1) / 2)))
        elif self.stands == "table":
            bar = 0.03 + 0.1 * s
            spots = [(x * (long - bar) / 2, y * (broad - bar) / 2) for x, y in CORNERS]
            legs = [box((bar, bar, low - 0.005), (x, y, (low - 0.005) / 2)) for x, y in spots]
            t.add("pump base", box((long, broad, 0.01), (0, 0, low - 0.004)), *legs, own=False)
        elif self.stands == "post":
            post = [cylinder(0.3 * s + 0.02, 0, low, self.n(t, 0.05)), box((long, broad, 0.01), (0, 0, low - 0.004))]
            t.add("pump base", *post, box((long, long, 0.012), (0, 0, 0.006)), own=False)


def _lying(p: Any) -> bool:
    return bool(p.pose == "lying")


def _canned(p: Any) -> bool:
    return bool(p.drive == "can")


class PlainCanned(_MeltedPump, name="pump/plain canned", sizes=(15, 20, 25, 32, 40, 50, 65, 80, 100), weight=1.5):
    """A canned-motor or magnetic-drive pump: a casing, a smooth can with an end cap and a connection box, no shaft."""

    pose: str = among(("lying", "lying", "lying", "upright"), "how it stands: on feet, or upright with mouths in line")
    drive: str = among(("can", "can", "magnet"), "what drives it: a canned motor, a motor over a magnetic coupling")
    wide: float = between(1.6, 3.0, "(radius of the casing - 40 mm) / of the suction pipe")
    thick: float = between(0.25, 0.6, "half the width of the casing / its radius")
    casing: str = among(("drum", "drum", "bevelled", "stepped", "double"), "form of the casing")
    rim: float = among((0.0, 1.05, 1.2), "radius of a flange behind the casing / its own; 0: none")
    aside: float = among((0.0, 0.0, 0.5, -0.5), "of the discharge from the axis / radius", when=_lying)
    reach: float = between(0.0, 0.9, "further reach of the mouths / radius of the casing")
    can: float = between(0.45, 1.05, "radius of the can / of the casing")
    long: float = between(1.6, 5.5, "length of the can / its radius")
    bell: str = among(("none", "none", "cone", "drum"), "what is between casing and can")
    bell_long: float = between(0.3, 1.1, "length of that / radius of the casing", when=lambda p: p.bell != "none")
    end: str = among(("flat", "flange", "dome", "step", "cone", "double"), "form of the can's end", when=_canned)
    bands: int = whole(0, 3, "rings round the can", when=_canned)
    wired: str = among(("top", "top", "side", "tower", "end", "none"), "where its connection box is", when=_canned)
    box_form: str = among(("box", "box", "drum", "tall"), "form of that", when=lambda p: p.wired not in ("", "none"))
    box_at: float = between(0.3, 0.85, "where that is / length of the can", when=_canned)
    box_size: float = between(0.35, 0.9, "width of that / radius of the can", when=_canned)
    piped: bool = chance(0.3, "a pipe from the casing to the can's end", when=_canned)
    motor: PlainMotor = nested(PlainMotor, "motor", when=lambda p: not _canned(p))
    lift: float = between(1.1, 2.0, "height of the axis over its seat / radius of the casing")
    feet: str = among(("block", "saddles", "plates", "casing", "casing"), "what it stands on", when=_lying)
    bedded: bool = chance(0.6, "a bed")
    bed: PlainBed = nested(PlainBed, "bed", when=lambda p: p.bedded)
    suction: PlainPort = port_of(lambda p: p.dn, "suction")
    discharge: PlainPort = port_of(lambda p: smaller(p.dn) if _lying(p) else p.dn, "discharge")

    def build(self, t: Table) -> Model:
        r, seat = self.wide * t.pipe.radius + 0.04, self.bed.seat if self.bedded else 0.0
        half, n, lying = self.thick * r, self.n(t, r), _lying(self)
        half = half if lying else max(half, 1.3 * t.pipe.radius)
        c = self.can * r
        base = max(self.lift * r, 1.1 * c) if lying else half + 0.5 * (self.lift - 0.8) * r
        base = max(base, 0.56 * t.flange.outer - seat, 1.3 * self.suction.wide * t.pipe.radius)
        axis = seat + base
        root = t.at(0, 0, axis)
        line = root.moved(LYING) if lying else root
        solids, ports = self._mouths(root, r, half, n)
        t.add(CASING, *(moved(one, line.frame) for one in self._body(r, half, n)), *solids)
        end, length = self._bell(line, r, half, c, n), self.long * c
        if _canned(self):
            self._can(line.at(0, 0, end), r, c, length, end - half, self.n(t, c))
        else:
            self.motor.build(
                line.at(0, 0, end), c, length, max(12, self.n(t, c)), base if lying and self.feet != "casing" else 0.0
            )
        x1 = end + 0.85 * length
        if lying:
            self._feet(t, r, half, c, x1, axis, seat)
        else:
            foot = box((1.6 * r, 1.6 * r, 0.02), (0, 0, seat + 0.01))
            t.add(CASING, cylinder(0.6 * r, seat, axis, n), foot)
        if self.bedded:
            x0, x1, wide = (-half, x1, 1.8 * max(r, c)) if lying else (-r, r, 2 * r)
            self.bed.build(t, x0, x1, wide)
            if self.bed.form in ("beams", "frame", "pads"):
                plate = box((x1 - x0, wide + 2 * self.bed.more, 0.012), ((x0 + x1) / 2, 0, seat + 0.005))
                t.add("pump base", plate, own=False)
        self.melt(t)
        return t.model(ports=ports, kind="centrifugal pump")

    def _mouths(self, t: Table, r: float, half: float, n: int) -> tuple[list[Solid], list[Port]]:
        more = dead_room(self.dn) + self.reach * r
        spots: Sequence[tuple[tuple[float, float, float], tuple[float, float, float], float]]
        if _lying(self):
            back = PIPES[self.discharge.dn].radius * self.discharge.wide
            aside = float(np.clip(self.aside * r, min(0.0, back - r), max(0.0, r - back)))
            spots = ((-half - more, 0, 0), (-1, 0, 0), more + half), ((0, aside, r + more), (0, 0, 1), r + more)
        else:
            spots = ((-r - more, 0, 0), (-1, 0, 0), r + more), ((r + more, 0, 0), (1, 0, 0), r + more)
        solids, ports = [], []
        for mouth, (spot, way, reach) in zip((self.suction, self.discharge), spots, strict=True):
            solid, port = mouth.build(t, spot, way, reach, n)
            solids.append(moved(solid, t.frame))
            ports.append(Port(t.frame @ port.frame, port.dn))
        return solids, ports

    def _body(self, r: float, half: float, n: int) -> list[Solid]:
        """The casing about z, its front down."""
        rim = [cylinder(self.rim * r, 0.75 * half, half + 0.06 * r, n)] if self.rim else []
        if self.casing == "double":
            return [cylinder(r, -0.5 * half, half, n), cylinder(0.75 * r, -half, 1.1 * half, n), *rim]
        shapes = {
            "drum": outline(r, -half, r, half),
            "bevelled": outline(0.7 * r, -half, r, -0.5 * half, r, 0.5 * half, 0.8 * r, half),
            "stepped": outline(0.6 * r, -half, 0.6 * r, -0.5 * half, r, -0.5 * half, r, half),
        }
        return [turned(shapes[self.casing], n), *rim]

    def _bell(self, t: Table, r: float, half: float, c: float, n: int) -> float:
        """Puts down what is between the casing and the can; where the can begins."""
        if self.bell == "none":
            return half - 0.002
        end = half + self.bell_long * r
        shape = (
            outline(0.95 * r, half - 0.004, 0.9 * c, end) if self.bell == "cone" else outline(0.8 * r, 0, 0.8 * r, end)
        )
        t.add(CASING, turned(shape, n), cylinder(1.08 * max(c, 0.8 * r), end - 0.08 * r, end, n))
        return end - 0.002

    def _can(self, t: Table, r: float, c: float, length: float, back: float, n: int) -> None:
        """Puts the can down about z from 0, its top towards +x."""
        thin, motor = 0.12 * c, t.bundled("motor")
        ends = {
            "flat": [],
            "flange": [cylinder(1.2 * c, length - thin, length + thin, n)],
            "dome": [dome(c, 0.45 * c, length - 0.001, n)],
            "step": [cylinder(0.65 * c, length - 0.001, length + 0.3 * c, n)],
            "cone": [turned(outline(c, length - 0.001, 0.5 * c, length + 0.4 * c), n)],
            "double": [cylinder(1.18 * c, z, z + thin, n) for z in (length - 1.2 * thin, length + 0.2 * thin)],
        }[self.end]
        if self.end == "double":
            ends.append(cylinder(c, length - thin, length + thin, n))
        rings = [cylinder(1.1 * c, z, z + thin, n) for z in np.linspace(0, 0.7 * length, self.bands, endpoint=False)]
        motor.add("motor", cylinder(c, 0, length, n), *ends, *rings, own=True)
        if self.wired != "none":
            self._terminals(motor, c, length, n)
        if self.piped:
            y, far, q = 1.0, 1.25 * c + 0.02, 0.05 * c + 0.004
            path = [(0, y * 0.8 * c, 0.95 * length), (0, y * far, 0.95 * length)]
            start = -back - 0.4 * self.thick * r
            path += [(0, y * max(far, 1.1 * r), start), (0, y * 0.6 * r, start)]
            motor.add("pipe", rope(path, q, 8), own=False)

    def _terminals(self, t: Table, c: float, length: float, n: int) -> None:
        w, z = self.box_size * c, self.box_at * length
        stub = [cylinder(0.3 * w, 0.5 * c, 1.0 * c + (0.8 * w if self.wired == "tower" else 0.1 * w), max(6, n // 2))]
        low = 0.9 * c + (0.8 * w if self.wired == "tower" else 0.0)
        case = {
            "box": box((1.2 * w, w, 0.7 * w), (0, 0, low + 0.35 * w)),
            "tall": box((0.9 * w, 0.8 * w, 1.4 * w), (0, 0, low + 0.7 * w)),
            "drum": cylinder(0.55 * w, low, low + 0.7 * w, n),
        }[self.box_form]
        if self.wired == "end":
            pose = at(0, 0, length - 0.85 * c)
        else:
            pose = at(0, 0, z) @ spun("z", np.pi / 2 if self.wired == "side" else 0.0) @ spun("y", np.pi / 2)
        far = [cylinder(0.5 * c, 0, 0.9 * c + 0.45 * c, n)] if self.wired == "end" else []
        shift = at(0, 0, 0.42 * c) if self.wired == "end" else at()
        t.add("terminal box", *(moved(one, pose) for one in far), *(moved(one, pose @ shift) for one in (*stub, case)))

    def _feet(self, t: Table, r: float, half: float, c: float, x1: float, axis: float, seat: float) -> None:
        """Puts feet down under a can that ends about ``x1``, or under the casing alone."""
        x0, tall = half, axis - seat - 0.5 * c
        mid = seat + tall / 2
        if self.feet == "casing":
            high = axis - seat - 0.5 * r
            t.add(CASING, box((1.2 * half, 1.3 * r, high), (0, 0, seat + high / 2)), own=True)
        elif self.feet == "block":
            t.add("pump base", box((0.7 * (x1 - x0), 1.1 * c, tall), ((x0 + x1) / 2, 0, mid)), own=False)
        elif self.feet == "saddles":
            spots = (0.8 * x0 + 0.2 * x1, 0.2 * x0 + 0.8 * x1)
            t.add("pump base", *(box((0.25 * c, 1.6 * c, tall), (x, 0, mid)) for x in spots), own=False)
        else:
            plates = [box((0.08 * c, 1.7 * c, tall), (x, 0, mid)) for x in (x0 + 0.1 * c, 0.25 * x0 + 0.75 * x1)]
            sole = box((x1 - x0, 1.7 * c, 0.012), ((x0 + x1) / 2, 0, seat + 0.006))
            t.add("pump base", *plates, sole, own=False)


PLAIN_METERING = families_of(PlainMetering, PlainCanned)
