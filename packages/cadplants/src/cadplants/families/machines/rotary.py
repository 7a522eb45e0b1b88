"""Centrifugal pumps in further constructions, with their drives."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    BASES,
    CASING,
    LYING,
    Motor,
    Pump,
    Train,
    anchors,
    base,
    dead_room,
    driven,
    mouth,
    volute,
)
from cadplants.families.valves.valve import bolt_circle, flanged_body
from cadplants.model.family import Model
from cadplants.model.standards import FLANGES, PIPES, smaller
from cadplants.solids.mesh_ops import extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["ROTARY"]


class SplitCase(Pump, name="pump/split case", sizes=(65, 80, 100, 125, 150, 200, 250)):
    """A double-suction pump with axially split casing (API 610 BB1): mouths to both sides, a bearing at each end."""

    wide: float = between(1.0, 1.25, "radius of the casing / that by its nominal size")
    seat: float = between(0.1, 0.22, "height of the base frame", "m")
    drop: float = among((0.0, 0.25), "mouths below the shaft / radius")
    motor: float = between(0.8, 1.14, "radius of the motor / of the casing")
    frame: str = weighted(
        "how the motor's frame is made", when=lambda p: p.dn > 150, otherwise="other", cooled=0.5, other=0.5
    )
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, s = self.dn, self.seat, 0.07 + 1.5 * t.pipe.radius
        r, half, n = s * self.wide, 0.9 * s, t.n(s)
        axis = seat + 1.35 * r
        lying = t.at(0, 0, axis).along("x")
        half_case = outline(1, 0.35, 0.8, 0.45, 0.8, 1.1, 0.4, 1.35)
        case = [(a * r, b * half) for a, b in [*((a, -b) for a, b in half_case[::-1]), *half_case]]
        split = extrude(rounded_rectangle(2.7 * half, 2.25 * r, 0.5 * r, 4), -0.09 * r, 0.09 * r)
        drop, reach = axis - self.drop * r, r + dead_room(dn) + 0.06
        suction, first = mouth(dn, t.style, (0, -reach, drop), (0, -1, 0), reach - 0.35 * r)
        discharge, second = mouth(smaller(dn), t.style, (0, reach, drop), (0, 1, 0), reach - 0.35 * r)
        foot = (0.4 * half, 1.5 * r, axis - seat - 0.5 * r)
        feet = [box(foot, (x * 0.7 * half, 0, (seat + axis - 0.5 * r) / 2)) for x in BOTH]
        chambers = along("x", turned(case, n), 0, 0, axis)
        t.add(CASING, chambers, moved(split, at(0, 0, axis)), suction, discharge, *feet)
        nut = hexagon(0.13 * r, 0.09 * r, 0.2 * r)
        spots = [(x * half, y * 1.02 * r) for x in (-0.9, -0.3, 0.3, 0.9) for y in BOTH]
        t.at(0, 0, axis).add("nut", *(moved(nut, at(x, y)) for x, y in spots))
        house = outline(0.3 * r, 1.3 * half, 0.3 * r, 1.7 * half, 0.45 * r, 1.75 * half, 0.45 * r, 2.2 * half)
        bearing = turned([*house, (0.25 * r, 2.25 * half)], n)
        arms = [box((0.5 * half, 0.5 * r, 0.2 * r), (x * 1.5 * half, 0, -0.35 * r)) for x in BOTH]
        t.at(0, 0, axis).add(CASING, along("x", bearing), along("-x", bearing), *arms)
        end = 2.5 * half
        lying.add("shaft", cylinder(0.12 * r, -2.28 * half, end, 12))
        m = self.motor * r
        far, seats = self.drive.build(t, end, axis, seat, m)
        wide = 2.5 * max(m, 0.8 * r)
        base(t, self.bed, -2.0 * half, far, wide, seat, [-0.7 * half, 0.7 * half, *seats])
        anchors(t, [(x, y * 0.46 * wide) for x in (-1.7 * half, far - 0.1) for y in BOTH], seat)
        return t.model(ports=(first, second), kind="double-suction pump")


class BackPullOut(Pump, name="pump/back pull-out", sizes=(40, 50, 65, 80, 100, 125, 150)):
    """A standard pump (EN ISO 2858): spiral casing on feet, bearing bracket with oiler and foot, spacer, base frame."""

    steps: int = whole(1, 2, "sizes that the discharge is smaller than the suction")
    wide: float = between(1.0, 1.5, "radius of the casing / that by its nominal size")
    seat: float = between(0.08, 0.2, "height of the base frame", "m")
    growth: float = between(0.2, 0.4, "of the spiral's radius in one turn / radius")
    turned: bool = among((False, True), "the spiral ends on the other side")
    upright: bool = chance(0.5, "the discharge is over the shaft, not aside")
    long: float = between(1.6, 2.4, "length of the bearing bracket / radius")
    smooth: bool = chance(0.5, "the bearing bracket has no ribs")
    motor: float = between(0.8, lambda p: min(1.3, 0.85 * (1.08 + p.growth)), "radius of the motor / of the casing")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(("grid", "grid", *BASES), "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, out, seat, s = self.dn, smaller(self.dn, self.steps), self.seat, 0.06 + 1.3 * t.pipe.radius
        r, half, n = s * self.wide, 0.5 * s + 0.3 * PIPES[out].outer, t.n(s)
        axis = seat + (1.08 + self.growth) * r + 0.02
        house = moved(volute(r, half, t.style, self.growth), spun("z", np.pi if self.turned else 0.0))
        side = 0.0 if self.upright else (0.75 * r if self.turned else -0.75 * r)
        rise, front = axis + (1 + self.growth) * r + dead_room(out) + 0.03, half + dead_room(dn) + 0.03
        suction, first = mouth(dn, t.style, (-front, 0, axis), (-1, 0, 0), front - 0.4 * half)
        top, second = mouth(out, t.style, (0, side, rise), (0, 0, 1), rise - axis - 0.5 * r)
        bolts = bolt_circle(8, 0.92 * r, 0.03 * r + 0.004, 0.8 * half, 0.95 * half)
        cover = along("x", merge([cylinder(1.02 * r, 0.8 * half, 0.95 * half, n), bolts]), 0, 0, axis)
        foot, mid = axis - seat - 0.3 * r, (seat + axis - 0.3 * r) / 2
        feet = [box((0.7 * half, 0.3 * r, foot), (0, y * 0.75 * r, mid)) for y in BOTH]
        t.add(CASING, along("x", house, 0, 0, axis), suction, top, cover, *feet)
        back, long = 0.95 * half, self.long * r
        shape = [(a * r, back + b * long) for a, b in outline(0.8, 0, 0.55, 0.15, 0.32, 0.3, 0.32, 0.4)]
        bearing = [(a * r, back + b * long) for a, b in outline(0.42, 0.4, 0.42, 0.9, 0.3, 0.95)]
        ribs = [around(box((0.95 * r, 0.03 * r, 0.4 * long), (0.2 * r, 0, back + 0.7 * long)), 6)]
        bracket = merge([turned(shape, n), turned(bearing, n), *(ribs if not self.smooth else [])])
        stay = box((0.08 * long, 0.5 * r, foot), (back + 0.85 * long, 0, mid))
        cup = turned(outline(0.08 * r, 0.3 * r, 0.1 * r, 0.5 * r, 0.05 * r, 0.55 * r), 12)
        oiler = merge([cylinder(0.03 * r + 0.004, 0, 0.3 * r, 8), cup])
        oiler = moved(oiler, at(back + 0.65 * long, 0, axis + 0.4 * r))
        t.add(CASING, along("x", bracket, 0, 0, axis), stay, oiler)
        shaft = cylinder(0.12 * r, back + 0.1 * long, back + 1.15 * long, 12)
        t.at(0, 0, axis).along("x").add("shaft", shaft)
        m = self.motor * r
        far, seats = self.drive.build(t, back + 1.12 * long, axis, seat, m)
        base(t, self.bed, -0.6 * half, far, 2.6 * max(m, 0.8 * r), seat, [0.0, back + 0.85 * long, *seats])
        return t.model(ports=(first, second), kind="centrifugal pump")


class Block(Pump, name="pump/block", sizes=(32, 40, 50, 65, 80, 100)):
    """A close-coupled block pump (EN 733): motor on the casing's lantern, feet below."""

    wide: float = between(1.0, 1.3, "radius of the casing / that by its nominal size")
    high: float = between(1.35, 1.6, "height of the shaft / radius")
    pressed: bool = chance(0.4, "the casing is pressed of sheet, not cast")
    motor_size: float = between(0.75, 1.05, "radius of the motor / of the casing")
    slender: float = between(2.3, 3.2, "length of the motor / its radius")
    motor: Motor = driven(Motor, "motor")
    footed: bool = chance(0.5, "casing and motor have feet, there is no bow under the lantern")

    def build(self, t: Table) -> Model:
        dn, out, s = self.dn, smaller(self.dn), 0.05 + 1.2 * t.pipe.radius
        r, half, n = s * self.wide, 0.35 * s + 0.35 * PIPES[out].outer, t.n(s)
        axis = self.high * r + 0.02
        lying = t.at(0, 0, axis).along("x")
        if self.pressed:
            shape = outline(0.75, -1, 0.95, -0.85, 1, -0.6, 1, 0.75, 1.12, 0.76, 1.12, 1)
            house = turned([(a * r, b * half) for a, b in shape], n)
        else:
            house = volute(0.95 * r, half, t.style, 0.3)
        front, rise = half + dead_room(dn) + 0.02, axis + 1.3 * r + dead_room(out)
        suction, first = mouth(dn, t.style, (-front, 0, axis), (-1, 0, 0), front - 0.3 * half)
        top, second = mouth(out, t.style, (0, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
        t.add(CASING, along("x", house, 0, 0, axis), suction, top)
        m, back = self.motor_size * r, half + 0.5 * r
        lantern = [cylinder(0.95 * r, 0.8 * half, half + 0.04 * r, n), cylinder(1.0 * m, back - 0.08 * r, back, n)]
        posts = around(box((0.22 * r, 0.4 * r, 0.5 * r), (0, 0, half + 0.22 * r)), 4, 0.66 * min(r, m), np.pi / 4)
        lying.add(CASING, *lantern, posts)
        lying.add("shaft", cylinder(0.14 * r, half - 0.05, back, 12))
        length = self.slender * m
        self.motor.build(t.at(back, 0, axis).moved(LYING), m, length)
        if self.footed:
            leg = box((0.3 * half + 0.03, 1.2 * r, axis - 0.75 * r), (0, 0, (axis - 0.75 * r) / 2))
            t.add(CASING, leg, box((0.8 * half + 0.05, 1.7 * r, 0.015), (0, 0, 0.0075)))
            foot = box((0.12 * length, 1.3 * m, axis - 0.75 * m), (back + 0.6 * length, 0, (axis - 0.75 * m) / 2))
            t.bundled("motor").add("motor", foot)
        else:
            x, tall = back - 0.04 * r, axis - 0.6 * r
            bow = [box((0.05, 0.05, tall), (x, y * 0.7 * m, tall / 2)) for y in BOTH]
            t.add("pump base", *bow, box((0.3 * r, 1.9 * m, 0.02), (x, 0, 0.01)), own=False)
        return t.model(ports=(first, second), kind="block pump")


class VerticalInline(Pump, name="pump/vertical in-line", place="inline", sizes=(40, 50, 65, 80, 100, 125, 150)):
    """A vertical in-line pump (API 610 OH3/OH4): volute in the line, lantern with windows, coupling, motor on top."""

    wide: float = between(1.8, 2.4, "radius of the casing, less 5 cm / of the pipe")
    motor_size: float = between(0.75, 1.1, "radius of the motor / of the casing")
    tall: float = between(1.0, 1.9, "height of the lantern / radius of the casing")
    plated: bool = chance(0.5, "the lantern is of two plates, not of posts")
    guarded: bool = chance(0.7, "a slotted guard round the coupling")
    slender: float = between(2.4, 3.4, "length of the motor / its radius")
    motor: Motor = driven(Motor, "motor")
    turn: int = whole(0, 3, "quarter turns of the motor")

    def build(self, t: Table) -> Model:
        dn, radius = self.dn, t.pipe.radius
        r = self.wide * radius + 0.05
        length = round(2 * (0.8 * r + dead_room(dn) + 0.04), 6)
        n, x, neck = t.n(r), length / 2, 0.485 * t.flange.hub
        body = flanged_body(dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        t.add(CASING, body, moved(volute(0.85 * r, radius + 0.02, t.style, 0.3), at(x)))
        low, up = 1.05 * radius + 0.02, t.at(x)
        bolts = bolt_circle(8, 0.78 * r, 0.04 * radius + 0.006, low - 0.02, low + 0.02)
        up.add(CASING, cylinder(0.9 * r, low - 0.02, low + 0.02, n), bolts)
        m, tall = self.motor_size * r, self.tall * r
        z0, z1 = low + 0.02, low + 0.02 + tall
        if self.plated:
            sides = [box((0.06 * r, 1.1 * r, tall), (s * 0.62 * r, 0, (z0 + z1) / 2)) for s in BOTH]
            ring_r, thick = 0.75 * r, 0.02
        else:
            sides = [around(cylinder(0.08 * r, z0, z1, 8), 4, 0.66 * r, np.pi / 4)]
            ring_r, thick = 0.8 * r, 0.015
        up.add(CASING, *sides, cylinder(1.05 * m, z1 - 0.02, z1, n), cylinder(ring_r, z0, z0 + thick, n))
        hub = outline(0.25, 0.3, 0.25, 0.5, 0.2, 0.52, 0.25, 0.54, 0.25, 0.75)
        coupling = turned([(a * r, z0 + b * tall) for a, b in hub], n)
        up.add("shaft", cylinder(0.1 * r, z0 - 0.01, z1, 10), coupling)
        if self.guarded:
            slots = around(box((0.02 * r, 0.1 * r, 0.6 * tall), (0.42 * r, 0, (z0 + z1) / 2)), 8)
            up.add("coupling guard", ring(0.4 * r, 0.42 * r, z0 + 0.015, z1 - 0.02, n), slots, own=False)
        self.motor.build(up.at(0, 0, z1).spun("z", self.turn * np.pi / 2), m, self.slender * m)
        return t.model(length, kind="in-line pump")


class Barrel(Pump, name="pump/barrel", sizes=(50, 65, 80, 100, 125)):
    """A barrel pump (API 610 BB5): a thick cylinder hung at its centreline, a studded end cover, both mouths up."""

    long: float = between(1.8, 2.8, "half the length of the barrel, less its mouths' / radius")
    seat: float = between(0.15, 0.3, "height of the base frame", "m")
    studs: int = among((10, 12, 16), "studs of the end cover")
    frame: str = among(("cast", "cooled", "ex"), "how the motor's frame is made")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(("beams", "grid", "plinth", "rim"), "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, r = self.dn, self.seat, 0.1 + 1.6 * t.pipe.radius
        half, n = self.long * r + t.flange.outer * 0.6, t.n(r)
        axis, cover = seat + 1.5 * r, 1.3 * r
        lying = t.at(0, 0, axis).along("x")
        shape = outline(0.95 * r, -half, r, -0.95 * half, r, 0.8 * half, cover, 0.82 * half, cover, half)
        rise = axis + r + dead_room(dn) + 0.03
        suction, first = mouth(dn, t.style, (-0.55 * half, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
        discharge, second = mouth(smaller(dn), t.style, (0.45 * half, 0, rise), (0, 0, 1), rise - axis - 0.5 * r)
        ears = [box((0.35 * half, 2.7 * r, 0.25 * r), (x * half, 0, axis - 0.12 * r)) for x in (-0.6, 0.5)]
        t.add(CASING, along("x", turned(shape, n), 0, 0, axis), suction, discharge, *ears)
        lid = outline(cover, half + 0.002, cover, half + 0.35 * r, 0.7 * r, half + 0.36 * r, 0.7 * r, half + 0.5 * r)
        lying.add(CASING, turned(lid, n))
        lying.add("stud", bolt_circle(self.studs, 1.14 * r, 0.13 * r, 0.82 * half, half + 0.35 * r))
        house = turned([(a * r, b * r) for a, b in outline(0.45, 0, 0.45, 0.3, 0.6, 0.32, 0.6, 1, 0.3, 1.1)], n)
        t.at(0, 0, axis).add(CASING, along("x", house, half + 0.48 * r), along("-x", house, -half + 0.02))
        start = half + 1.9 * r
        lying.add("shaft", cylinder(0.16 * r, half + 1.4 * r, start, 12))
        stand, mid = (0.3 * half, 0.35 * r, axis - seat - 0.24 * r), (seat + axis - 0.24 * r) / 2
        stands = [box(stand, (x * half, y * 1.15 * r, mid)) for x in (-0.6, 0.5) for y in BOTH]
        t.add("pump base", *stands, own=False)
        far, seats = self.drive.build(t, start, axis, seat, 0.95 * r + 0.02)
        base(t, self.bed, -half, far, 3.0 * r, seat, [-0.6 * half, 0.5 * half, *seats])
        return t.model(ports=(first, second), kind="barrel pump")


class RingSection(Pump, name="pump/ring section", sizes=(40, 50, 65, 80, 100)):
    """A ring-section multistage pump (ISO 5199): stages between two end casings under tie bolts, bearings outside."""

    seat: float = between(0.08, 0.2, "height of the base frame", "m")
    stages: int = whole(3, 8, "stages")
    step: float = between(0.3, 0.5, "length of a stage / radius")
    level: bool = chance(0.5, "the suction looks aside, not up")
    motor: float = between(1.0, 1.35, "radius of the motor / of the stages")
    drive: Train = driven(Train, "coupling, guard and motor")
    bed: str = among(BASES, "form of the base frame")

    def build(self, t: Table) -> Model:
        dn, seat, r = self.dn, self.seat, 0.06 + 1.5 * t.pipe.radius
        n, axis = t.n(r), seat + 1.5 * r
        lying = t.at(0, 0, axis).along("x")
        step, end = self.step * r, 0.55 * FLANGES[dn].outer + 0.02
        half = self.stages * step / 2
        rise, mid = 1.12 * r + dead_room(dn) + 0.02, half + end / 2
        drum = turned(outline(1.12 * r, half, 1.12 * r, half + end, 0.6 * r, half + end + 0.2 * r), n)
        drums = []
        for sign, end_axis in ((-1, "-x"), (1, "x")):
            drums.append(along(end_axis, drum, 0, 0, axis))
            foot = (0.7 * end, 1.9 * r, axis - seat - 0.7 * r)
            drums.append(box(foot, (sign * mid, 0, (seat + axis - 0.7 * r) / 2)))
        face, way = ((-mid, -rise, axis), (0, -1, 0)) if self.level else ((-mid, 0, axis + rise), (0, 0, 1))
        one, first = mouth(dn, t.style, face, way, rise - 0.5 * r)
        two, second = mouth(smaller(dn), t.style, (mid, 0, axis + rise), (0, 0, 1), rise - 0.5 * r)
        t.add(CASING, *drums, one, two)
        lows = [-half + k * step for k in range(self.stages)]
        stages = [ring(0.3 * r, 1.02 * r, low, low + 0.8 * step, n) for low in lows]
        lying.add(CASING, cylinder(0.92 * r, -half, half, n), *stages)
        tie = rod((0, 0, -half - end - 0.03), (0, 0, half + end + 0.03), 0.045 * r + 0.003, 8)
        lying.add("stud", around(tie, 8, 1.07 * r, np.pi / 8))
        house = turned([(a * r, b * r) for a, b in outline(0.3, 0, 0.3, 0.35, 0.48, 0.37, 0.48, 0.9, 0.3, 0.95)], n)
        where = half + end + 0.18 * r
        start = where + 1.3 * r
        t.at(0, 0, axis).add(CASING, along("x", house, where), along("-x", house, -where))
        lying.add("shaft", cylinder(0.13 * r, where, start, 12))
        m = self.motor * r
        far, seats = self.drive.build(t, start, axis, seat, m)
        base(t, self.bed, -where - 0.5 * r, far, 2.5 * m, seat, [-mid, mid, *seats])
        return t.model(ports=(first, second), kind="multistage pump")


ROTARY = families_of(SplitCase, BackPullOut, Block, VerticalInline, Barrel, RingSection)
