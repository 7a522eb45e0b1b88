"""Flanged and wafer valves beyond those of the presets; along x from 0, stem towards +z."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import LAID
from cadplants.families.valves.drive import BODY, DiaphragmHead, Wheel, drive_of, put_spindle
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import face_shell, nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of, flipped
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved, revolve, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, ball, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "VALVE_FAMILIES",
    "Valve",
    "bolt_circle",
    "disc_flange",
    "flanged_body",
]

Middle = Sequence[tuple[float, float]]

BIG = sizes_between(40)
MID = sizes_between(most=200)


def flanged_body(dn: int, style: ModelingStyle, length: float, middle: Middle, throat: Middle = ()) -> Solid:
    """A body of revolution along x with a flange at each end.

    Args:
        dn: nominal size.
        style: decides on bore and bolt holes.
        length: face to face [m].
        middle: radius and place of what lies between the flanges' backs [m]; ends get the flanges' thickness added.
        throat: radius and place of what the bore narrows to between the faces [m].
    """
    size, thick, bore = FLANGES[dn], plate_thickness(dn), bore_of(dn, style)
    sides, neck = style.round(size.outer / 2), 0.485 * size.hub
    head = face_shell(dn, sides, neck, bore, style.holes)
    outside = [(neck, thick), *middle, (neck, length - thick)]
    shells = [head, flipped(head, length), revolve(outside, sides)]
    if bore:
        shells.append(revolve([(bore, length), *reversed(throat), (bore, 0.0)], sides))
    return about_x(weld(shells))


def disc_flange(dn: int, style: ModelingStyle, reach: float, bore: float = 0.0) -> Solid:
    """A flange about z with its face at 0 looking down, on a neck up to ``reach``; bored through if asked for [m]."""
    size, thick = FLANGES[dn], plate_thickness(dn)
    sides, neck = style.round(size.outer / 2), 0.485 * size.hub
    head = face_shell(dn, sides, neck, bore, style.holes)
    inside = [(bore, reach), (bore, 0.0)] if bore else [(0.0, reach)]
    return weld([head, revolve([(neck, thick), (neck, reach), *inside], sides)])


def bolt_circle(count: int, radius: float, thread: float, low: float, high: float) -> Solid:
    """Hexagon bolts about z through what lies between two heights, as one mesh [m]."""
    head = 0.65 * thread
    heads = [hexagon(1.6 * thread, *ends) for ends in ((high, high + head), (low - head, low))]
    one = merge([cylinder(thread / 2, low, high, 8), *heads])
    return around(one, count, radius, np.pi / count)


def _clear(t: Table, rim: float, tilt: float) -> float:
    """How far from the axis a cover of a radius, tilted towards an end, passes the flange there [m, rad]."""
    return float((0.5 * t.flange.outer + 0.012 + rim * np.sin(tilt)) / np.cos(tilt))


class Valve(Device, place="inline", group="Valve assembly", label="valve", bundle=BODY):
    """A valve along x from 0, its stem towards +z."""

    @property
    def radius(self) -> float:
        """Of its pipe [m]."""
        return PIPES[self.dn].radius


class _Swollen(Valve):
    """A valve with a flanged body that swells between its flanges: round, barrel, tapered or with sharp shoulders."""

    swell: ClassVar[float] = 1.5

    bulge: float = between(0.92, 1.1, "radius of its swelling / what the pipe asks for")
    form: str = among(("round", "barrel", "tapered", "shouldered"), "form of its body")

    def put_body(self, t: Table, length: float) -> float:
        """Puts its body down, of a length, and tells the radius of its swelling [m]."""
        neck, size = 0.485 * t.flange.hub, self.bulge * (self.swell * self.radius + 0.007)
        bulge, low = max(size, 0.5 * t.flange.hub), plate_thickness(self.dn)
        low += min(0.7 * nut_room(self.dn), 0.12 * length)
        x, reach, end = length / 2, length / 2 - low, length - low
        if self.form == "round":
            shares = np.linspace(-1, 1, 11)
            middle = [(neck + (bulge - neck) * float(np.sqrt(max(0.0, 1 - s * s))), x + s * reach) for s in shares]
        elif self.form == "barrel":
            middle = outline(neck, low, bulge, low + 0.3 * reach, bulge, end - 0.3 * reach, neck, end)
        elif self.form == "tapered":
            middle = outline(neck, low, bulge, x - 0.1 * reach, bulge, x + 0.1 * reach, neck, end)
        else:
            middle = outline(neck, low, bulge, low, bulge, end, neck, end)
        t.add("valve body", flanged_body(self.dn, t.style, length, middle))
        return bulge


class _Control(_Swollen):
    """A control valve: a globe body, a bolted bonnet, an actuator."""

    def put_bonnet(self, t: Table, length: float) -> Table:
        """Puts down its body and bonnet: a neck with a flange, the bonnet's on it, its bolts; and tells its top."""
        bulge, radius = self.put_body(t, length), self.radius
        collar, plate, t = 0.9 * bulge + 0.01, 0.010 + 0.08 * radius, t.at(length / 2)
        seat, throat, n = max(bulge + 0.6 * radius, 0.5 * t.flange.outer + plate), 0.7 * bulge, t.style.round(collar)
        side = outline(throat, 0.75 * bulge, throat, seat - plate, collar, seat - plate, collar, seat)
        t.add("valve body", turned(side, n))
        t.add("valve bonnet", cylinder(collar, seat, seat + plate, n))
        count, thread = max(4, 2 * int(collar / 0.03)), max(0.006, 0.12 * collar)
        t.add("bolt", bolt_circle(count, 0.86 * collar, thread, seat - plate, seat + plate))
        top = seat + plate
        z = top + 0.5 * radius + 0.01
        t.add("valve bonnet", turned(outline(0.45 * bulge, top, 0.35 * bulge, z), t.style.round(bulge)))
        return t.at(0, 0, z)


class ControlDiaphragm(_Control, name="control valve/diaphragm", weight=1.5):
    """A control valve with a diaphragm actuator."""

    head: DiaphragmHead = nested(DiaphragmHead, "actuator")

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["globe"][self.dn]
        self.head.build(self.put_bonnet(t, length), self.radius)
        return t.model(length, kind="control valve")


class ControlElectric(_Control, name="control valve/electric"):
    """A control valve with an electric actuator."""

    drive: Any = drive_of("electric")

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["globe"][self.dn]
        top = self.put_bonnet(t, length)
        put_spindle(top, 0.0, 0.02, 0.005 + 0.1 * self.radius)
        self.drive.build(top.at(0, 0, 0.02))
        return t.model(length, kind="control valve")


class BallDriven(_Swollen, name="ball valve/driven", weight=2):
    """A flanged ball valve of any body with any drive."""

    middle: float = among((0.5, 0.5, 0.42), "where its stem is / length")
    split: bool = chance(0.5, "its body is of two pieces")
    drive: Any = drive_of()

    def build(self, t: Table) -> Model:
        length, radius = FACE_TO_FACE["ball"][self.dn], self.radius
        bulge, x = self.put_body(t, length), length * self.middle
        boss, top = 0.45 * radius + 0.008, bulge + 0.2 * radius + 0.008
        neck = cylinder(boss, 0.7 * bulge, top, t.style.round(boss))
        t.at(x).add("valve body", neck, box((2.2 * boss, 2.2 * boss, 0.006), (0, 0, top)))
        if self.split:
            joint = cylinder(bulge * 1.12, 0.60 * length, 0.60 * length + 0.02 + 0.1 * radius, t.style.round(bulge))
            t.add("valve body", along("x", joint))
        t = t.at(x)
        if t.style.hollow:  # the bored ball, open: a belt of a sphere along the run
            bore, angles = 0.85 * t.pipe.bore, np.linspace(-0.9, 0.9, 9)
            reach = bore / np.cos(0.9) * 0.97
            belt = [(max(reach * float(np.cos(a)), bore * 1.01), reach * float(np.sin(a))) for a in angles]
            belt += [(bore, belt[-1][1]), (bore, belt[0][1])]
            t.add("valve ball", about_x(weld([revolve(belt, t.style.round(reach), closed=True)])))
        high = top + 0.012 + 0.2 * radius
        put_spindle(t, top, high, 0.004 + 0.14 * radius)
        self.drive.build(t.at(0, 0, high))
        return t.model(length, kind="ball valve")


class BallCompact(Valve, name="ball valve/compact", sizes=tuple(dn for dn in SIZES if FLANGES[dn].n_bolts == 4)):
    """A compact flanged ball valve: a square block with four lobes for its bolts, its lever up one side."""

    drive: Any = drive_of("lever", "lever", "pneumatic", "electric")

    def build(self, t: Table) -> Model:
        size, radius = t.flange, self.radius
        length, half = max(0.055, 1.9 * radius), 0.36 * size.circle
        lobe = around(ring(0.5 * size.bolt, 0.95 * size.bolt, 0.0, length, 12), 4, size.circle / 2, np.pi / 4)
        hole = circle(radius * 0.9, t.style.round(radius))
        block = extrude(rounded_rectangle(2 * half, 2 * half, 0.35 * half, 4), 0.0, length, (hole,))
        top = 0.5 * size.outer + 0.01
        boss = along("z", cylinder(0.4 * radius + 0.006, 0.9 * half, top, 12), length / 2)
        t.add("valve body", along("x", block), along("x", lobe), boss)
        put_spindle(t.at(length / 2), top, top + 0.012, 0.006 + 0.1 * radius)
        self.drive.build(t.at(length / 2, 0, top + 0.012))
        return t.model(length, "wafer", "ball valve")


class PlugTapered(_Swollen, name="plug valve/tapered", sizes=MID):
    """A lubricated or lined plug valve: a tapered chest through the body, a wrench square on top."""

    swell = 1.2

    driven: bool = chance(0.8, "something turns it")
    drive: Any = drive_of("lever", "gear", "pneumatic", "bar", when=lambda p: p.driven)

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["ball"][self.dn]
        bulge, t = self.put_body(t, length), t.at(length / 2)
        n = t.style.round(bulge)
        chest, cover = (
            turned([(r * bulge, z * bulge) for r, z in side], n)
            for side in (
                outline(0.8, -1.25, 1, -1.2, 1.12, 1.2, 1.12, 1.3),
                outline(1.15, 1.3, 1.15, 1.45, 0.5, 1.6),
            )
        )
        t.add("valve body", chest)
        t.add("valve bonnet", cover)
        # A gear's wheel turns above the cover.
        top = (2.5 if self.driven and self.drive.make == "gear" else 1.95) * bulge
        square = 0.5 * bulge, 0.5 * bulge, top - 1.55 * bulge
        t.add("valve stem", box(square, (0, 0, 0.5 * (top + 1.55 * bulge))))
        t.add("bolt", bolt_circle(6, 1.0 * bulge, 0.1 * bulge + 0.004, 1.2 * bulge, 1.45 * bulge))
        if self.driven:
            self.drive.build(t.at(0, 0, top))
        return t.model(length, kind="plug valve")


class Weir(Valve, name="diaphragm valve/weir", sizes=MID):
    """A weir diaphragm valve: a waisted body with a wide square or round collar, a domed bonnet, a wheel (EN 13397)."""

    square: bool = chance(0.5, "its collar is square, not round")
    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        length, radius, neck = FACE_TO_FACE["gate"][self.dn] * 1.1, self.radius, 0.485 * t.flange.hub
        low, x, z = plate_thickness(self.dn) + 0.1 * length, length / 2, max(1.0 * neck, 0.42 * t.flange.outer)
        waist, end, reach = 1.05 * neck, 0.95 * neck, 0.15 * length
        middle = outline(end, low, waist, x - reach, waist, x + reach, end, length - low)
        half = min(0.42 * (length - 2 * low) + 0.01, 2.2 * radius + 0.01)
        n = t.style.round(half)
        if self.square:
            edge = rounded_rectangle(2 * half, 2.2 * half, 0.3 * half, 4)
            collar, lid = extrude(edge, 0.55 * neck, z), extrude(edge, z + 0.003, z + 0.014)
        else:
            collar = turned(outline(0.6 * half, 0.55 * neck, half, 0.8 * z, half, z), n)
            lid = cylinder(half, z + 0.003, z + 0.014, n)
        t.add("valve body", flanged_body(self.dn, t.style, length, middle))
        t = t.at(x)
        t.add("valve body", collar)
        t.add("gasket", cylinder(0.95 * half, z, z + 0.003, n), of="rubber", own=True)
        t.add("valve bonnet", lid, dome(0.85 * half, 0.8 * half, z + 0.014, n))
        spread = (1.15 if self.square else 0.86) * half
        t.add("bolt", bolt_circle(4, spread, min(0.008 + 0.06 * radius, 0.14 * half), z - 0.01, z + 0.014))
        top = z + 0.014 + 0.75 * half
        put_spindle(t, top, top + 0.03 + 0.5 * radius, 0.004 + 0.1 * radius)
        self.wheel.build(t, 0.03 + 1.2 * radius, top + 0.015 + 0.3 * radius)
        return t.model(length, kind="diaphragm valve")


class _Butterfly(Valve, sizes=BIG):
    """A butterfly valve: a ring, its disc, a long neck with a mounting pad."""

    long: ClassVar[float] = 1.0
    joint: ClassVar[str] = "wafer"

    turn: float = among((0.0, np.pi / 2, np.pi / 4), "of its disc, from shut", "rad")
    drive: Any = drive_of("lever", "lever", "gear", "pneumatic", "electric", "chain")

    def shell(self, t: Table, length: float, outer: float) -> list[Solid]:
        """Its ring about z, of a length and a radius [m]."""
        return [ring(t.pipe.bore, outer, 0.0, length, t.style.round(outer))]

    def build(self, t: Table) -> Model:
        size, bore, radius = t.flange, t.pipe.bore, self.radius
        length = FACE_TO_FACE["butterfly"][self.dn] * self.long
        outer = 0.49 * (size.circle - size.bolt)
        neck, top = min(0.38 * length, 0.3 * outer) + 0.004, 0.5 * size.outer + 0.02 + 0.3 * radius
        n, x = max(8, t.style.round(neck)), length / 2
        post = cylinder(neck, 0.95 * bore + 0.03 * outer, top - 0.008, n)
        pad = extrude(rounded_rectangle(3.2 * neck, 3.2 * neck, 0.4 * neck, 3), top - 0.01, top)
        boss = along("-z", cylinder(0.8 * neck, 0.99 * bore, outer + 0.3 * neck, n))
        tower = moved(merge([post, pad, boss]), at(x))
        t.add("valve body", *map(about_x, self.shell(t, length, outer)), tower)
        t, rim = t.at(x), 0.985 * bore
        blade = turned(
            outline(0.3 * bore, -0.1 * bore, rim, -0.004, rim, 0.004, 0.3 * bore, 0.1 * bore), t.style.round(outer)
        )
        t.spun("z", self.turn).add("valve disc", along("x", blade))
        put_spindle(t, -1.01 * bore, top + 0.02, 0.35 * neck + 0.003)
        self.drive.build(t.at(0, 0, top + 0.02))
        return t.model(length, self.joint, "butterfly valve")


class ButterflyWafer(_Butterfly, name="butterfly valve/wafer", weight=1.5):
    """A butterfly valve between flanges: a wafer ring."""


class ButterflyLug(_Butterfly, name="butterfly valve/lug"):
    """A butterfly valve between flanges: a ring with lugs."""

    def shell(self, t: Table, length: float, outer: float) -> list[Solid]:
        size, lug = t.flange, ring(0.5 * t.flange.bolt, t.flange.bolt, 0.0, length, 10)
        lugs = around(lug, size.n_bolts, size.circle / 2, np.pi / size.n_bolts)
        return [*super().shell(t, length, outer), lugs]


class ButterflyFlanged(_Butterfly, name="butterfly valve/flanged"):
    """A butterfly valve with two flanges of its own."""

    long = 2.2
    joint = "flanged"

    def shell(self, t: Table, length: float, outer: float) -> list[Solid]:
        size, thick, bore, n = t.flange, plate_thickness(self.dn), t.pipe.bore, t.style.round(outer)
        plates = [ring(bore, size.outer / 2, z, z + thick, n) for z in (0.0, length - thick)]
        return [ring(bore, 0.55 * size.hub, 0.0, length, n), *plates]


class Knife(Valve, name="knife gate valve/wafer", sizes=BIG):
    """A knife gate valve: a thin body with lugs, a flat chest, a blade, a tall frame (MSS SP-81)."""

    wheeled: bool = chance(0.75, "a handwheel, not a cylinder")
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.wheeled)

    def build(self, t: Table) -> Model:
        radius, bore, outer = self.radius, t.pipe.bore, 0.49 * t.flange.outer
        length, n = FACE_TO_FACE["butterfly"][self.dn] * 1.05, t.style.round(t.flange.outer / 2)
        x, chest, rise = length / 2, 1.25 * radius + 0.01, outer + 1.6 * radius + 0.03
        tall = rise + 2.3 * radius + 0.06
        t.add(
            "valve body", about_x(ring(bore, outer, 0.0, length, n)),
            box((0.8 * length, 2 * chest, rise - 0.9 * bore), (x, 0, (rise + 0.9 * bore) / 2)),
        )  # fmt: skip
        t = t.at(x)
        t.add("gland", box((1.3 * length, 2.3 * chest, 0.02), (0, 0, rise - 0.01)))
        t.add("valve disc", box((0.006, 1.8 * chest, 1.5 * radius + 0.05), (0, 0, rise + 0.7 * radius)))
        bar = (0.5 * length, 0.012, tall - rise)
        frame = [box(bar, (0, s * 1.05 * chest, (tall + rise) / 2)) for s in (-1, 1)]
        t.add("yoke", *frame, box((0.7 * length, 2.2 * chest, 0.014), (0, 0, tall)), of="steel")
        put_spindle(t, rise + 1.4 * radius, tall + 0.05, 0.008 + 0.06 * radius)
        if self.wheeled:
            self.wheel.build(t, 0.05 + 1.1 * radius, tall + 0.015)
        else:
            rim, can, end = 0.9 * radius, 0.75 * radius, tall + 3 * radius
            side = outline(rim, tall, rim, tall + 0.02, can, tall + 0.02, can, end, rim, end, rim, end + 0.02)
            t.add("actuator", turned(side, n), of="trim", own=False)
        return t.model(length, "wafer", "knife gate valve")


class WaferCheck(Valve, name="check valve/wafer", sizes=BIG, weight=1.5):
    """A wafer check valve: a short ring with a shoulder, a disc or two plates inside (API 594)."""

    long: float = among((0.25, 0.4, 0.8), "length / the pipe's diameter")
    shouldered: bool = chance(0.5, "a ring with a shoulder and a disc, not two plates")
    waist: float = between(0.75, 0.98, "radius behind the shoulder / of it", when=lambda p: p.shouldered)

    def build(self, t: Table) -> Model:
        size, bore = t.flange, t.pipe.bore
        outer = 0.49 * (size.circle - size.bolt)
        n, length = t.style.round(outer), max(0.02, self.long * t.pipe.outer)
        if self.shouldered:
            inner, lip = 1.02 * bore, 0.18 * length
            waist = max(self.waist * outer, 1.08 * inner)
            side = outline(inner * 0.8, 0, outer, 0, outer, lip, waist, 1.2 * lip, waist, length, inner, length)
            t.add("valve body", about_x(weld([revolve(side, n, closed=True)])))
            lid = outline(0.78, 0.3, 0.95, 0.35, 0.95, 0.5, 0.3, 0.7)
            t.add("valve disc", about_x(turned([(r * bore, z * length) for r, z in lid], n)))
        else:
            t.add("valve body", about_x(ring(bore, outer, 0.0, length, n)))
            a = np.linspace(0.05, np.pi - 0.05, 12)
            plate = extrude(0.97 * bore * np.column_stack([np.cos(a), np.sin(a)]), 0.35 * length, 0.35 * length + 0.006)
            for turn in (0.0, np.pi):
                t.add("valve disc", along("x", moved(plate, spun("z", turn))))
            t.add("valve stem", along("y", cylinder(0.05 * bore + 0.002, -bore, bore, 8), 0.35 * length))
        return t.model(round(length, 6), "wafer", "check valve")


class BallCheck(_Swollen, name="check valve/ball", sizes=MID):
    """A ball check valve: a body with a slanting chamber and a bolted cap."""

    swell = 1.3

    tilt: float = between(0.4, 0.62, "of its chamber", "rad")

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["check"][self.dn]
        bulge, whole_table = self.put_body(t, length), t
        n, arm, thread = t.style.round(bulge), 0.95 * bulge, 0.004 + 0.06 * bulge
        rim = arm + 2.2 * thread
        reach = max(2.4 * bulge, _clear(t, rim, self.tilt) - 0.2 * bulge)
        # Its chamber passes the outlet's flange, too.
        aside = (0.5 * t.flange.outer + 0.01 - 0.2 * bulge) * np.tan(self.tilt) + arm / np.cos(self.tilt)
        x = min(0.55 * length, length - plate_thickness(self.dn) - float(aside))
        t = t.at(x, 0, 0.2 * bulge).spun("y", self.tilt)
        t.add("valve body", turned(outline(arm, 0, arm, reach, rim, reach, rim, reach + 0.012), n))
        lid = outline(rim, reach + 0.012, rim, reach + 0.026, 0.6 * bulge, reach + 0.036)
        t.add("valve bonnet", turned(lid, n))
        t.add("bolt", bolt_circle(4, arm + 1.1 * thread, thread, reach, reach + 0.026))
        return whole_table.model(length, kind="check valve")


class NozzleCheck(_Swollen, name="check valve/axial"):
    """An axial check valve: nothing but a swollen body; or a lift check with a screwed cap."""

    swell = 1.6

    capped: bool = chance(0.5, "a lift check with a screwed cap")

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["check"][self.dn]
        bulge = self.put_body(t, length)
        if self.capped:
            cap = cylinder(0.7 * bulge, 0.6 * bulge, 1.35 * bulge, t.style.round(bulge))
            t.at(length / 2).add("valve bonnet", cap, hexagon(0.9 * bulge, 1.35 * bulge, 1.6 * bulge))
        return t.model(length, kind="check valve")


class ThreeWay(_Swollen, name="three-way valve/flanged", sizes=MID):
    """A three-way valve: a third flange downward or to the side, closed by a blind flange or open."""

    side: str = among(("-z", "y", "-y"), "where its third flange is")
    diaphragm: bool = chance(0.35, "a diaphragm actuator")
    head: DiaphragmHead = nested(DiaphragmHead, "that actuator", when=lambda p: p.diaphragm)
    drive: Any = drive_of("lever", "pneumatic", "electric", when=lambda p: not p.diaphragm)

    def build(self, t: Table) -> Model:
        length, radius = FACE_TO_FACE["globe"][self.dn], self.radius
        bulge, x = self.put_body(t, length), length / 2
        branch = moved(disc_flange(self.dn, t.style, x - 0.6 * bulge), at(0, 0, -x))
        t, top = t.at(x), bulge + 0.3 * radius + 0.01
        t.add("valve body", along({"-z": "z", "y": "-y", "-y": "y"}[self.side], branch))
        t.add("valve bonnet", turned(outline(0.6 * bulge, 0.7 * bulge, 0.6 * bulge, top), t.style.round(bulge)))
        put_spindle(t, top, top + 0.03, 0.005 + 0.1 * radius)
        if self.diaphragm:
            self.head.build(t.at(0, 0, top + 0.01), radius)
        else:
            self.drive.build(t.at(0, 0, top + 0.03))
        return t.model(length, kind="three-way valve")


class GlobeY(_Swollen, name="globe valve/Y pattern", sizes=MID):
    """A Y-pattern globe valve, its bonnet slanting; a wheel on its stem."""

    swell = 1.2

    tilt: float = between(0.6, 0.85, "of its bonnet", "rad")
    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        length, radius = FACE_TO_FACE["globe"][self.dn], self.radius
        bulge = self.put_body(t, length)
        n, neck, rim = t.style.round(bulge), 0.85 * bulge, 1.15 * bulge
        reach = max(2.2 * bulge, _clear(t, rim, self.tilt))
        high = reach + 0.06 + radius
        t = t.at(0.48 * length, 0, 0.1 * bulge).spun("y", self.tilt)
        t.add("valve body", turned(outline(neck, 0, neck, reach, rim, reach, rim, reach + 0.012), n))
        cap = outline(rim, reach + 0.012, rim, reach + 0.026, 0.5 * bulge, reach + 0.04, 0.4 * bulge, high)
        t.add("valve bonnet", turned(cap, n))
        put_spindle(t, high, high + 0.04 + 0.8 * radius, 0.005 + 0.1 * radius)
        self.wheel.build(t, 0.04 + 1.3 * radius, high + 0.02 + 0.6 * radius)
        return t.model(length, kind="globe valve")


class Reducing(_Swollen, name="pressure reducing valve/spring", sizes=MID):
    """A pressure reducing valve: a globe body with a spring or pilot housing above and maybe a closed can below."""

    swell = 1.4

    canned: bool = chance(0.4, "a closed can below it")

    def build(self, t: Table) -> Model:
        length = FACE_TO_FACE["globe"][self.dn]
        b, t = self.put_body(t, length), t.at(length / 2)
        n, z = t.style.round(2 * b), max(1.2 * b, 0.5 * t.flange.outer)
        pan = outline(0.7, 0.6 - z / b, 0.7, 0, 1.3, 0.2, 1.7, 0.2, 1.7, 0.35)
        hood = outline(1.7, 0.35, 1.7, 0.5, 1.3, 0.5, 0.75, 0.9, 0.7, 2.6, 0.4, 2.8)
        for name, side in (("valve body", pan), ("valve bonnet", hood)):
            t.add(name, turned([(r * b, z + h * b) for r, h in side], n))
        screw = cylinder(0.1 * b + 0.003, z + 2.75 * b, z + 3.3 * b, 8)
        t.add("valve stem", screw, hexagon(0.4 * b, z + 2.8 * b, z + 3.0 * b))
        t.add("bolt", bolt_circle(8, 1.5 * b, min(0.016, 0.2 * b), z + 0.2 * b, z + 0.5 * b))
        if self.canned:
            t.at(0, 0, -1.35 * b).add("valve body", cylinder(0.9 * b, 0.0, 0.5 * b, n))
        return t.model(length, kind="pressure reducing valve")


class Relief(Valve, name="relief valve/spring", sizes=MID, place="head", weight=2):
    """A spring relief valve: inlet below (x = 0), outlet to the side, a tall bonnet with a cap or a lifting lever."""

    tall: float = between(3.5, 5.0, "height of its bonnet / radius of its body")
    levered: bool = chance(0.5, "a lifting lever")

    def build(self, t: Table) -> Model:
        radius, size = self.radius, t.flange
        out = SIZES[min(SIZES.index(self.dn) + 1, len(SIZES) - 1)]
        centre = 0.6 * size.outer + 0.03  # API 526 proportions: centre to inlet face about the flange's radius and more
        b, n, reach = 1.6 * radius + 0.010, t.style.round(size.outer / 2), 0.6 * FLANGES[out].outer + 0.03
        chest = [(r * b, centre + z * b) for r, z in outline(0.8, -1, 1, -0.5, 1, 0.7, 1.35, 0.8, 1.35, 0.95)]
        outlet = along("y", moved(disc_flange(out, t.style, reach), at(0, 0, -reach)), centre)
        t.add("valve body", about_x(disc_flange(self.dn, t.style, centre)), about_x(turned(chest, n)), outlet)
        tall, low = self.tall * b, centre + 0.95 * b
        rim, top = outline(1.35 * b, low, 1.35 * b, low + 0.15 * b, 0.75 * b, low + 0.35 * b), low + tall
        t.add("valve bonnet", about_x(turned([*rim, (0.7 * b, low + 0.8 * tall), (0.5 * b, top)], n)))
        cap = [cylinder(0.38 * b, low + 0.95 * tall, low + 1.3 * tall, n), hexagon(0.9 * b, top, low + 1.1 * tall)]
        t.add("valve bonnet", *map(about_x, cap), of="trim")
        bolts = bolt_circle(4, 1.17 * b, min(0.024, 0.16 * b), low - 0.15 * b, low + 0.15 * b)
        t.add("bolt", about_x(bolts))
        if self.levered:
            t.add("lever", rod((low + 1.2 * tall, 0.0, 0.3 * b), (low + 0.75 * tall, 0.0, 1.6 * b), 0.1 * b, 8))
        return t.model(kind="relief valve")


class GlobeAngle(Valve, name="globe valve/angle", sizes=MID, place="head"):
    """An angle globe valve: inlet from below, outlet to the side, wheel on top."""

    wheel: Wheel = nested(Wheel, "handwheel")

    def build(self, t: Table) -> Model:
        radius, size = self.radius, t.flange
        centre, b, n = 0.6 * size.outer + 0.04, 1.5 * radius + 0.01, t.style.round(size.outer / 2)
        outlet = along("y", moved(disc_flange(self.dn, t.style, centre), at(0, 0, -centre)), centre)
        high = centre + max(b, 0.52 * size.outer)
        top = high + 0.05 + 1.2 * radius
        inlet = about_x(disc_flange(self.dn, t.style, centre))
        t.add("valve body", inlet, moved(ball(b, n), at(centre)), outlet)
        neck = outline(0.85 * b, centre, 0.85 * b, high, 1.1 * b, high, 1.1 * b, high + 0.03, 0.5 * b, high + 0.05)
        t.add("valve bonnet", about_x(turned([*neck, (0.4 * b, top)], n)))
        t = t.moved(LAID)
        put_spindle(t, top, top + 0.05 + radius, 0.005 + 0.1 * radius)
        self.wheel.build(t, 0.04 + 1.3 * radius, top + 0.03 + 0.7 * radius)
        return t.model(kind="globe valve")


VALVE_FAMILIES = families_of(
    ControlDiaphragm, ControlElectric, BallDriven, BallCompact, PlugTapered, Weir, ButterflyWafer, ButterflyLug,
    ButterflyFlanged, Knife, WaferCheck, BallCheck, NozzleCheck, ThreeWay, GlobeY, Reducing, Relief, GlobeAngle,
)  # fmt: skip
