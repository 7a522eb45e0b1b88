"""Cocks, taps and needle valves of real plants: drains, sampling points, hose taps, gas cocks, small ball valves."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, styled, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.drive import Wheel, drive_of
from cadplants.families.valves.parts import MID, SMALL, bend, chain, cover, hub_radius, screwed, square
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import Valve, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import FACE_TO_FACE
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import extrude, moved, tube
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["COCKS"]

_ABOUT_LONG = "length / radius of the pipe, of a large one"


class AngleSeat(Valve, name="angle seat valve/piston", sizes=SMALL):
    """An angle seat valve: a threaded or welded run, a slanting neck, a round piston actuator with a sight cap."""

    long: float = between(4.6, 6.5, _ABOUT_LONG)
    threaded: bool = chance(0.6, "its ends are threaded, not welded")
    corners: int = among((6, 8), "corners of its wrench ends", when=lambda p: p.threaded, otherwise=0)
    tilt: float = among((-0.785, 0.785, 0.65), "of its neck", "rad")
    nutted: bool = chance(0.6, "a union nut on its neck")
    rim: float = between(1.6, 2.4, "radius of its actuator / of the pipe, of a large one")
    high: float = between(2.6, 4.0, "height of its actuator / radius of the pipe, of a large one")

    def build(self, t: Table) -> Model:
        r, style, whole_table = self.radius, t.style, t
        length = self.long * r + 0.035
        core = [(s * r, x * length) for s, x in outline(1.05, 0.12, 1.3, 0.35, 1.3, 0.65, 1.05, 0.88)]
        if self.threaded:
            run = screwed(self.dn, style, length, core, self.corners)
        else:
            side = [(r, 0.0), *core, (r, length)]
            run = along("x", turned(side, style.round(1.3 * r), bore=bore_of(self.dn, style)))
        pose = at(0.5 * length) @ spun("y", self.tilt)
        n, wide, tall = style.round(1.6 * r), 1.15 * r + 0.002, 0.4 * r if self.nutted else 1.4 * r
        rim, high, tilt = self.rim * r + 0.012, self.high * r + 0.03, abs(self.tilt)
        # The actuator's lower edge clears the run.
        clear = (1.3 * r + 0.005) / np.cos(tilt) + rim * np.tan(tilt) - 0.12 * high
        low = max(2.4 * r, clear - 0.8 * tall)
        t.add("valve body", run, moved(turned(outline(wide, 0, wide, low - 0.2 * r, 0.85 * wide, low), n), pose))
        t = t.moved(pose)
        nut = hexagon(2.1 * wide, low - 0.5 * r, low + 0.3 * r)
        t.add("valve bonnet", nut if self.nutted else cylinder(0.6 * wide, low - 0.001, low + 1.4 * r, n))
        base = low + 0.8 * tall
        can = outline(0.7, 0, 1, 0.12, 1, 0.5, 1.04, 0.5, 1.04, 0.58, 1, 0.58, 0.95, 0.9, 0.55, 1)
        solids = [turned([(s * rim, base + z * high) for s, z in can], style.round(rim))]
        port = cylinder(0.008, 0.8 * rim, 1.05 * rim + 0.004, 10), hexagon(0.014, rim, rim + 0.012)
        solids += [along("y", one, 0, 0, base + k * high) for k in (0.22, 0.75) for one in port]
        act = t.bundled("actuator")
        act.add("actuator", *solids, of="rubber")
        cap = outline(0.3 * rim, base + high - 0.002, 0.28 * rim, base + 1.12 * high, 0.15 * rim, base + 1.17 * high)
        act.add("position indicator", turned(cap, 12), of="dial")
        t.add("valve stem", cylinder(0.25 * r, 0.0, base + 0.01, 8))
        return whole_table.model(round(length, 6), "welded", "angle seat valve")


class Solenoid(Valve, name="solenoid valve/flanged", sizes=tuple(dn for dn in MID if dn <= 100)):
    """A flanged solenoid valve: globe body, square or round piston cover, coil with cable plug on or beside it."""

    square: bool = among((False, True), "its cover is square, not round")
    size: float = between(0.018, 0.03, "radius of its coil, of a small pipe", "m")
    middle: bool = chance(0.6, "the coil stands on its middle, not beside it")
    round: bool = chance(0.5, "its coil is round, not square")
    wired: bool = chance(0.5, "a cable comes to it")

    def build(self, t: Table) -> Model:
        length, r, style, whole_table = FACE_TO_FACE["globe"][self.dn], self.radius, t.style, t
        wide, x = max(1.3 * r + 0.008, 1.03 * hub_radius(self.dn)), length / 2
        shell = flanged_body(self.dn, style, length, [(wide, 0.35 * length), (wide, 0.65 * length)])
        seat, plate = max(1.15 * wide, 0.45 * t.flange.outer), 0.012 + 0.15 * r
        t.add("valve body", shell, along("z", cylinder(0.9 * wide, 0.3 * wide, seat - 0.003, style.round(wide)), x))
        t.at(x).extend(cover(1.15 * wide + 0.006, seat, plate, 6, style, self.square))
        top, s, t = seat + plate, self.size + 0.1 * r, t.at(x if self.middle else x + 0.5 * wide)
        z, far, act = top + 1.2 * s, top + 4 * s, t.bundled("actuator")
        t.add("valve stem", cylinder(0.3 * s, top - 0.001, top + 2.4 * s, 12))
        coil = square(0.95 * s, top + 0.4 * s, top + 2.0 * s)
        if self.round:
            coil = cylinder(s, top + 0.4 * s, top + 2.1 * s, style.round(s))
        plug = box((0.8 * s, 0.8 * s, 0.8 * s), (1.3 * s, 0, z))
        act.add("actuator", coil, plug, along("x", hexagon(0.5 * s, 1.6 * s, 2.1 * s), 0, 0, z), of="rubber")
        if self.wired:
            t.add("cable", rope(bend([(2.05 * s, 0, z), (3.5 * s, 0, z), (3.5 * s, 0, far)], s), 0.004, 8))
        act.add("nut", hexagon(0.9 * s, top + 2.0 * s, top + 2.25 * s))
        return whole_table.model(length, kind="solenoid valve")


class Mini(Valve, name="ball valve/mini", sizes=tuple(dn for dn in SMALL if dn <= 25)):
    """A mini ball valve of hexagon or square bar with a one-sided plastic key, a screwdriver slot or a T key."""

    long: float = between(3.0, 4.2, _ABOUT_LONG)
    form: str = among(("hexagon", "square", "round"), "form of its body")
    turn: float = among((0.0, 1.5708, 3.1416), "where its key points, from along the run", "rad")
    key: str = among(("one-sided", "T", "slot"), "what turns it")

    def build(self, t: Table) -> Model:
        r, style, hollow, whole_table = self.radius, t.style, t.style.hollow, t
        length, half, n = self.long * r + 0.018, 1.25 * r + 0.002, t.style.round(r)
        x, holes, inner = length / 2, (circle(0.98 * r, max(8, n)),) if hollow else (), 0.98 * r if hollow else 0.0
        low = 0.9 * half
        if self.form == "hexagon":
            edge = circle(half / np.cos(np.pi / 6), 6, phase=np.pi / 6)
            solids = [along("x", extrude(edge, 0.0, length, holes))]
        elif self.form == "square":
            edge = rounded_rectangle(2 * half, 2 * half, 0.25 * half, 2)
            solids = [along("x", extrude(edge, 0.0, length, holes))]
        else:
            solids = [hex_end(self.dn, 0.0, 0.5 * length, style)]
            solids.append(along("x", ring(inner, 1.2 * half, 0.35 * length, 0.6 * length, n)))
            solids.append(along("x", ring(inner, 1.1 * r, 0.6 * length, length, n)))
            x, low = 0.46 * length, half
        neck, top = 0.5 * r + 0.002, 1.25 * half + 0.003
        t.add("valve body", *solids, along("z", cylinder(neck, low, top, 12), x))
        t, long, k = t.at(x, 0, top).spun("z", self.turn), 1.8 * half + 0.012, 0.45 * half + 0.003
        if self.key == "one-sided":
            grip = [cylinder(1.1 * k, 0, 0.8 * k, 12), box((long, 1.3 * k, 0.7 * k), (0.4 * long, 0, 0.45 * k))]
            grip.append(box((0.3 * long, 1.7 * k, 0.8 * k), (0.75 * long, 0, 0.45 * k)))
        elif self.key == "T":
            grip = [cylinder(0.8 * k, 0, k, 12), box((0.5 * k, 1.6 * long, 1.8 * k), (0, 0, 1.6 * k))]
        else:
            grip = [cylinder(1.3 * k, 0, 0.5 * k, 12), box((0.3 * k, 2.2 * k, 0.7 * k), (0, 0, 0.5 * k))]
        t.add("valve stem", cylinder(0.5 * neck, -0.003, 0.4 * k, 8))
        t.add("lever", *grip, turns=Turning("lever"))
        return whole_table.model(round(length, 6), "welded", "ball valve")


class GasCock(Valve, name="plug valve/gas cock", sizes=SMALL):
    """A taper plug cock for gas (EN 331 forerunner): waisted body, plug through it, wing or square head, nut below."""

    long: float = between(4.2, 5.4, _ABOUT_LONG)
    turn: float = among((0.0, 1.5708), "where its key points, from along the run", "rad")
    key: str = among(("wings", "square", "bar"), "what turns it")
    reach: float = between(1.6, 2.4, "of a wing / radius of its chest", when=lambda p: p.key == "wings")

    def build(self, t: Table) -> Model:
        r, whole_table = self.radius, t
        length, n, w = self.long * r + 0.025, t.style.round(1.3 * r), 1.25 * r + 0.003
        core = [(s * r, x * length) for s, x in outline(1.1, 0.15, 0.95, 0.3, 0.95, 0.7, 1.1, 0.85)]
        chest = turned(outline(0.9 * w, -1.35 * w, 1.12 * w, 1.35 * w), n)
        t.add("valve body", screwed(self.dn, t.style, length, core), moved(chest, at(length / 2)))
        t, top = t.at(length / 2), 1.34 * w
        below = [cylinder(0.7 * w, -1.45 * w, -1.34 * w, n), hexagon(0.9 * w, -1.8 * w, -1.44 * w)]
        t.add("nut", *below, cylinder(0.25 * w, -2.0 * w, -1.7 * w, 8), own=True, fine=False)
        t.add("valve disc", turned(outline(0.85 * w, top, 0.75 * w, top + 0.3 * w, 0.4 * w, top + 0.5 * w), n))
        t = t.at(0, 0, top + 0.45 * w).spun("z", self.turn)
        if self.key == "wings":
            right = outline(0.35, 0, 0.45, 0.3, self.reach, 0.55, self.reach, 1.2, 0.3, 0.95)
            edge = np.array([(-0.35, 0), *right, *((-x, z) for x, z in right[:0:-1])]) * w
            t.add("lever", moved(extrude(edge, -0.13 * w, 0.13 * w), spun("x", np.pi / 2)), turns=Turning("lever"))
        elif self.key == "square":
            t.add("valve stem", box((0.7 * w, 0.7 * w, 0.9 * w), (0, 0, 0.44 * w)))
        else:
            bar = rod((-0.5 * w, 0, 0.35 * w), (4.5 * w, 0, 0.6 * w), 0.22 * w, 8)
            t.add("lever", bar, cylinder(0.6 * w, -0.002, 0.7 * w, 12), turns=Turning("lever"))
        return whole_table.model(round(length, 6), "welded", "plug valve")


class StopCock(Valve, name="globe valve/stop cock", sizes=SMALL):
    """A stop cock (EN 1213): round body with compression nuts or wrench ends, headwork with crutch or cross head."""

    long: float = between(4.6, 6.0, _ABOUT_LONG)
    nutted: bool = chance(0.5, "compression nuts at its ends")
    tilt: float = among((0.0, 0.0, 0.7), "of its head", "rad")
    reach: float = between(1.2, 1.7, "radius of what turns it / of its body")
    key: str = among(("crutch", "cross", "knob"), "what turns it")
    turn: float = between(0, 3, "how far that is turned", "rad")

    def build(self, t: Table) -> Model:
        r, whole_table = self.radius, t
        length, n, w = self.long * r + 0.03, t.style.round(1.4 * r), 1.4 * r + 0.003
        end = 1.05 * r
        core = outline(end, 0.12 * length, w, 0.4 * length, w, 0.6 * length, end, 0.88 * length)
        t.add("valve body", screwed(self.dn, t.style, length, core, end=0.16 * length))
        for x in (0.02 * length, 0.86 * length) if self.nutted else ():
            t.add("union", along("x", hexagon(3.0 * r + 0.004, x, x + 0.12 * length)), of="valve", own=True)
        t, low, top = t.at(length / 2).spun("y", self.tilt), 1.4 * w, 1.4 * w + 1.5 * w
        t.add("valve body", cylinder(0.75 * w, 0.0, 1.4 * w, n))
        head = hexagon(1.5 * w, low - 0.1 * w, low + 0.5 * w)
        t.add("valve bonnet", head, cylinder(0.5 * w, low, low + 1.1 * w, n))
        t.add("gland", hexagon(0.9 * w, low + 1.05 * w, low + 1.5 * w))
        t.add("valve stem", cylinder(0.2 * w, top - 0.001, top + 1.0 * w, 8))
        reach, z = self.reach * w, top + 0.9 * w
        if self.key == "crutch":
            grip = [rod((-reach, 0, z), (reach, 0, z), 0.2 * w, 8), cylinder(0.35 * w, z - 0.4 * w, z + 0.1 * w, 10)]
        elif self.key == "cross":
            ways = [(reach * np.cos(a), reach * np.sin(a), z) for a in np.arange(4) * np.pi / 2]
            grip = [rod((0, 0, z), way, 0.16 * w, 8) for way in ways]
            grip.append(moved(around(ball(0.26 * w, 10), 4, reach), at(0, 0, z)))
            grip.append(turned(outline(0.4 * w, z - 0.4 * w, 0.5 * w, z + 0.1 * w, 0.3 * w, z + 0.3 * w), 12))
        else:
            a = np.linspace(0, 2 * np.pi, 24, endpoint=False)
            edge = (reach * (0.85 + 0.15 * np.cos(3 * a)))[:, None] * np.column_stack([np.cos(a), np.sin(a)])
            grip = [extrude(edge, z - 0.2 * w, z + 0.4 * w), cylinder(0.4 * w, z - 0.5 * w, z - 0.15 * w, 12)]
        t.spun("z", self.turn).add("handwheel", *grip, turns=Turning("handwheel"))
        return whole_table.model(round(length, 6), "welded", "globe valve")


class Drain(Valve, name="drain valve/hose tail", place="tap"):
    """A boiler drain cock on an outlet: squat body, square key or lever, ribbed hose tail with a cap on a chain."""

    size: float = between(0.009, 0.014, "half its width", "m")
    tilt: float = between(-0.5, 0.15, "of its hose tail, upward", "rad")
    ribs: int = whole(3, 5, "ribs of its hose tail")
    key: str = among(("square", "lever", "wing"), "what turns it")
    lever: Any = drive_of("lever", "bar", radius=lambda p: 0.8 * p.size, when=lambda p: p.key == "lever")
    wing: Any = drive_of("wing", radius=lambda p: 0.8 * p.size, when=lambda p: p.key == "wing")
    capped: bool = chance(0.6, "a cap on a chain on its hose tail")

    def build(self, t: Table) -> Model:
        r, n, low = self.size, 12, 0.014
        z, top, chest = low + 2.6 * r, low + 3.8 * r, outline(1.1 * r, low + r, 1.6 * r, low + 2.0 * r)
        tail = outline(r, 1.2 * r, r, 2.2 * r)
        for k in range(self.ribs):
            tail += outline(1.15 * r, 2.2 * r + 0.8 * k * r, 0.85 * r, 3.0 * r + 0.8 * k * r - 0.02 * r)
        far, pose = tail[-1][1], at(0, 0, z) @ spun("x", self.tilt)
        solids = [cylinder(0.85 * r, 0.0, 0.02, n), hexagon(2.5 * r, low, low + 1.1 * r)]
        solids.append(turned([*chest, (1.6 * r, low + 3.2 * r), (1.1 * r, top)], n))
        t.add("valve body", *solids, moved(along("y", turned(tail, n)), pose))
        if self.key == "square":
            t.add("valve stem", box((1.1 * r, 1.1 * r, 1.6 * r), (0, 0, top + 0.78 * r)))
        else:
            t.add("gland", hexagon(1.6 * r, top - 0.001, top + 0.8 * r))
            (self.lever or self.wing).build(t.at(0, 0, top + 0.8 * r))
        if self.capped:
            cap = moved(along("y", cylinder(1.25 * r, far - 0.3 * r, far + 1.2 * r, n)), pose)
            end = tuple(map(float, (pose @ (0.0, far, 1.2 * r, 1.0))[:3]))
            t.add("valve bonnet", cap, chain((0, 1.5 * r, low + 2.4 * r), end, 1.6 * r, 0.0009))
        return t.model(kind="drain valve")


class MultiportRoot(Valve, name="needle valve/multiport", place="tap"):
    """A gauge root valve on an outlet: a tall multiport bar with plugs, its bonnet aside with a T bar, a capped top."""

    size: float = between(0.010, 0.015, "half its width", "m")
    tall: float = between(7.0, 11.0, "height of its bar / half its width")
    square: bool = among((False, True), "its bar is square, not hexagonal")
    plugs: int = whole(1, 4, "plugs in its ports")
    tilt: float = among((0.5 * np.pi, 0.32 * np.pi), "of its bonnet, from upright", "rad")
    barred: bool = chance(0.6, "a T bar turns it, not a handwheel")
    bar: Any = drive_of("bar", radius=lambda p: p.size, when=lambda p: p.barred)
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: not p.barred)

    def build(self, t: Table) -> Model:
        r, tall = self.size, self.tall * self.size
        top = 0.014 + tall
        bar = square(1.25 * r, 0.014, top) if self.square else hexagon(2.5 * r, 0.014, top)
        t.add("valve body", bar, cylinder(0.85 * r, 0.0, 0.016, 12))
        for way, share in (("x", 0.62), ("-x", 0.62), ("y", 0.85), ("-y", 0.85))[: self.plugs]:
            plug = hexagon(1.4 * r, 1.05 * r, 1.7 * r), cylinder(0.6 * r, r, 1.2 * r, 10)
            t.at(0, 0, 0.014 + share * tall).along(way).add("valve bonnet", *plug)
        side = t.at(0, 0, 0.014 + 0.3 * tall).spun("y", self.tilt)
        side.add("valve bonnet", hexagon(1.9 * r, 1.1 * r, 2.6 * r), cylinder(0.7 * r, 2.5 * r, 4.2 * r, 12))
        side.add("gland", hexagon(1.1 * r, 3.9 * r, 4.5 * r))
        side.add("valve stem", cylinder(0.32 * r, 4.1 * r, 6.4 * r, 8))
        if self.barred:
            self.bar.build(side.at(0, 0, 5.8 * r))
        else:
            self.wheel.build(side, 0.012 + 1.4 * r, 5.6 * r)
        t.add("valve bonnet", hexagon(2.0 * r, top - 0.001, top + 0.9 * r), cylinder(1.0 * r, top, top + 1.2 * r, 12))
        return t.model(kind="needle valve")


class NeedleAngle(Valve, name="needle valve/angle", place="tap"):
    """An angle needle valve on an outlet: a forged or bar elbow, bonnet upright, a tube from its side."""

    hollow: bool = styled(True, "whether insides are modelled")
    size: float = between(0.008, 0.013, "half its width", "m")
    square: bool = chance(0.5, "its body is of square bar, not forged")
    wheeled: bool = chance(0.5, "a handwheel turns it, not a T bar")
    rim: float = between(1.4, 2.2, "radius of its handwheel / half its width", when=lambda p: p.wheeled)
    wheel: Wheel = nested(Wheel, "handwheel", when=lambda p: p.wheeled)
    bar: Any = drive_of("bar", radius=lambda p: p.size, when=lambda p: not p.wheeled)
    far: float = between(0.08, 0.2, "reach of its tube", "m")
    rise: float = among((-0.15, 0.15, 0.25), "of its tube", "m")

    def build(self, t: Table) -> Model:
        r, n, z = self.size, 12, 0.012 + 2.2 * self.size
        core = [box((2.4 * r, 2.4 * r, 3.6 * r), (0, 0, z))]
        if not self.square:
            core = [cylinder(1.35 * r, 0.012, z + 1.8 * r, t.style.round(1.35 * r))]
            core.append(moved(ball(1.6 * r, 12), at(0, 0, z)))
        side = [cylinder(0.9 * r, 0.8 * r, 2.2 * r, n), hexagon(2.1 * r, 2.0 * r, 3.4 * r)]
        t.add("valve body", cylinder(0.85 * r, 0, 0.02, n), *core, *(along("y", one, 0, 0, z) for one in side))
        top = z + 1.8 * r
        head = cylinder(0.75 * r, top + 1.1 * r, top + 2.6 * r, n)
        t.add("valve bonnet", hexagon(2.0 * r, top - 0.001, top + 1.2 * r), head)
        t.add("gland", hexagon(1.4 * r, top + 2.5 * r, top + 3.2 * r))
        t.add("valve stem", cylinder(0.33 * r, top + 3.1 * r, top + 5.4 * r, 8))
        if self.wheeled:
            self.wheel.build(t, 0.012 + self.rim * r, top + 4.6 * r)
        else:
            self.bar.build(t.at(0, 0, top + 5.0 * r))
        far, up = self.far, z + self.rise
        path = bend([(0, 3.2 * r, z), (0, far, z), (0, far, up), (far, far, up)], 0.02)
        t.add("pipe", tube(path, 0.5 * r, 0.35 * r if self.hollow else 0.0, n))
        return t.model(kind="needle valve")


COCKS = families_of(AngleSeat, Solenoid, Mini, GasCock, StopCock, Drain, MultiportRoot, NeedleAngle)
