"""Safety and relief valves, and rupture discs: along x from 0, or on the last flange or an outlet of a line."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    lying,
)
from cadplants.families.valves.parts import MID, bend, branch, cover, hub_radius, spring
from cadplants.families.valves.valve import Valve, disc_flange
from cadplants.model.family import Model
from cadplants.model.standards import FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, merge, moved, tube
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["RELIEFS"]


class Cap(Params):
    """A safety valve's cap: closed, with an open lever in a fork, or with a packed lever on a shaft."""

    form: str = among(("closed", "open lever", "packed lever"), "how it is made")
    side: int = among(BOTH, "where the lever points", when=lambda p: p.form != "closed", otherwise=1)
    long: float = between(2.5, 4.5, "length of the lever / radius of the chest", when=lambda p: p.form != "closed")

    def build(self, t: Table, w: float) -> None:
        """Puts it down on z = 0, for a chest of this radius [m]."""
        n, tall, side, long = t.n(0.5 * w), 1.1 * w, self.side, self.long * w
        if self.form == "closed":
            t.add("valve bonnet", cylinder(0.55 * w, -0.001, tall, n), hexagon(0.7 * w, tall, 1.3 * tall))
            return
        stout = turned(outline(0.6 * w, -0.001, 0.6 * w, 0.25 * tall, 0.5 * w, 0.3 * tall, 0.5 * w, tall), n)
        if self.form == "open lever":
            fork = [box((0.1 * w, 0.5 * w, 0.6 * tall), (s * 0.25 * w, -side * 0.3 * w, 1.15 * tall)) for s in BOTH]
            t.add("valve bonnet", stout, *fork)
            pin = t.at(0, -side * 0.35 * w, 1.3 * tall).along("x")
            pin.add("valve stem", cylinder(0.07 * w, -0.34 * w, 0.34 * w, 8))
            ways = ((-0.5 * w, 1.3 * tall), (0.5 * long, 1.2 * tall), (0.7 * long, -0.3 * long))
            t.add("lever", rope(bend([(0, side * y, z) for y, z in ways], 0.12 * long), 0.13 * w, 8))
            return
        z = 0.65 * tall
        t.add("valve bonnet", stout, along("x", cylinder(0.3 * w, 0.2 * w, 0.7 * w, 12), 0, 0, z))
        shaft = t.at(0, 0, z).along("x")
        shaft.add("valve stem", cylinder(0.1 * w, 0.4 * w, 1.05 * w, 8))
        shaft.add("gland", hexagon(0.4 * w, 0.7 * w, 0.82 * w))
        t.add("lever", box((0.12 * w, long, 0.35 * w), (0.95 * w, side * 0.44 * long, z)))


class _Safety(Valve, place="head", sizes=MID):
    """A safety valve upon its inlet flange, its outlet to +y."""

    larger: int = whole(1, 2, "sizes by which the outlet is larger than the inlet")
    reach: float = between(0.85, 1.05, "of the outlet / height of its axis")
    rise: float = between(0.95, 1.25, "of the bonnet's seat over the axis / radius of the chest")
    conical: bool = chance(0.5, "the chest widens from the inlet, rather than bulging")
    ribbed: bool = chance(0.5, "a rib under the outlet")
    plugged: bool = chance(0.3, "a plug opposite the outlet")

    def chest(self, t: Table) -> tuple[float, float]:
        """Puts the body down; returns the height of the bonnet's seat and the chest's radius [m]."""
        r, out = t.pipe.radius, SIZES[min(SIZES.index(t.dn) + self.larger, len(SIZES) - 1)]
        n, w = t.n(1.7 * PIPES[out].radius), max(1.05 * PIPES[out].radius, 1.4 * r) + 0.006
        axis = 0.5 * FLANGES[out].outer + plate_thickness(t.dn) + 0.015 + 0.3 * r
        reach, seat = axis * self.reach + 0.3 * w, axis + w * self.rise
        if self.conical:
            shell = outline(0.9 * hub_radius(t.dn), axis - 1.15 * w, w, axis - 0.5 * w, w, seat - 0.003)
        else:
            shell = outline(0.7 * w, axis - w, 1.1 * w, axis - 0.2 * w, 1.1 * w, axis + 0.2 * w, 0.8 * w, seat - 0.003)
        solids = [disc_flange(t.dn, t.style, axis - 0.7 * w), turned(shell, n)]
        solids.append(branch(out, t.style, reach, "y", (0, 0, axis)))
        if self.ribbed:
            solids.append(box((0.012 + 0.1 * r, 0.6 * reach, 0.7 * w), (0, 0.45 * reach, axis - 0.95 * w)))
        if self.plugged:
            solids.append(along("-y", hexagon(0.3 * r + 0.014, 0.8 * w, 1.1 * w + 0.012), 0, 0, axis - 0.3 * w))
        t.add("valve body", *solids)
        return seat, w


class FullLift(_Safety, name="relief valve/full lift", weight=1.5):
    """A full-lift safety valve (EN ISO 4126-1) with a closed bonnet, ribbed body and a cap of three kinds."""

    bolts: int = among((4, 6, 8), "of a round cover")
    square: bool = chance(0.3, "its cover is square, with four bolts")
    tall: float = between(2.2, 4.2, "height of the bonnet / radius of the chest")
    slim: float = between(0.62, 0.9, "radius of the bonnet / of the chest")
    finned: bool = chance(0.35, "ribs along the bonnet")
    cap: Cap = nested(Cap, "cap")

    def build(self, t: Table) -> Model:
        seat, w = self.chest(t)
        plate, tall, slim = 0.01 + 0.1 * w, self.tall * w, self.slim * w
        t.extend(cover(1.35 * w + 0.008, seat, plate, self.bolts, t.style, self.square))
        up, neck = t.at(0, 0, seat + plate), 0.55 * w
        hood = outline(w, -0.001, slim, 0.35 * w, slim, 0.75 * tall, neck, 0.92 * tall, neck, tall)
        fin = box((0.5 * slim, 0.12 * slim, 0.5 * tall), (slim, 0, 0.45 * tall))
        up.add("valve bonnet", turned(hood, t.n(w)), *([around(fin, 4)] if self.finned else []))
        self.cap.build(up.at(0, 0, tall), w)
        return lying(t, "relief valve")


class OpenBonnet(_Safety, name="relief valve/open bonnet"):
    """A steam safety valve with an open bonnet: a frame of two or four arms about its visible spring, lever."""

    tall: float = between(2.4, 3.8, "height of the frame / radius of the chest")
    arms: int = among((2, 4), "of the frame")
    start: float = among((0.0, 0.785), "where the first arm is", "rad")
    coils: int = whole(4, 6, "turns of the spring")
    cap: Cap = nested(Cap, "cap")

    def build(self, t: Table) -> Model:
        seat, w = self.chest(t)
        plate, n, tall, slim = 0.01 + 0.1 * w, t.n(w), self.tall * w, 0.95 * w
        t.extend(cover(1.3 * w + 0.008, seat, plate, 4, t.style))
        up = t.at(0, 0, seat + plate)
        arm = box((0.16 * w, 0.34 * w, tall), (slim, 0, tall / 2))
        head = turned(outline(1.1 * slim, tall - 0.2 * w, 1.1 * slim, tall, 0.6 * w, tall + 0.2 * w), n)
        up.add("yoke", around(arm, self.arms, 0.0, self.start), head)
        coil = spring(0.55 * w, 0.1 * w, 0.15 * w, tall - 0.3 * w, self.coils, t.style)
        washers = [cylinder(0.7 * w, z, z + 0.12 * w, n) for z in (0.05 * w, tall - 0.32 * w)]
        up.add("valve stem", coil, *washers, cylinder(0.14 * w, -plate, tall + 0.5 * w, 10))
        self.cap.build(up.at(0, 0, tall + 0.2 * w), w)
        return lying(t, "relief valve")


class Pilot(_Safety, name="relief valve/pilot", sizes=sizes_between(25, 200)):
    """A pilot-operated safety valve (API 526 ends): flat cap, a pilot with its own spring case aside, sense lines."""

    bolts: int = among((6, 8, 12), "of its cover")
    side: int = among(BOTH, "side of the pilot")
    above: bool = chance(0.5, "the pilot stands on the cover, not beside it")

    def build(self, t: Table) -> Model:
        seat, w = self.chest(t)
        plate, rim, size, wire = 0.02 + 0.2 * w, 1.3 * w + 0.008, 0.018 + 0.16 * w, 0.004 + 0.02 * w
        t.extend(cover(rim, seat, plate, self.bolts, t.style))
        if self.above:
            x, z = 0.0, seat + plate
            post = cylinder(0.4 * size, z - 0.001, z + size, 12)
        else:
            x, z, way = self.side * (rim + 1.2 * size), seat - size, "x" if self.side > 0 else "-x"
            post = along(way, cylinder(0.4 * size, rim - 0.004, rim + 0.6 * size, 12), 0, 0, seat + plate / 2)
        up = t.at(x, 0, z)
        up.add("valve body", box((2 * size, 1.8 * size, 2.4 * size), (0, 0, 2.0 * size)))
        t.add("valve body", post)
        marks = ((0.9, 3.2), (0.9, 3.6), (0.6, 3.9), (0.55, 6.5))
        up.add("valve bonnet", turned([(a * size, b * size) for a, b in marks], t.n(size)))
        screw = cylinder(0.3 * size, 6.4 * size, 7.6 * size, 10)
        up.add("valve bonnet", screw, hexagon(0.9 * size, 6.5 * size, 6.9 * size))
        foot, back, level = plate_thickness(t.dn) + 0.012, -rim - 2.2 * size, z + 1.4 * size
        line = [(x, -0.9 * size, level), (x, back, level), (x, back, foot)]
        line += [] if self.above else [(0.0, back, foot)]
        line.append((0.0, -0.7 * t.pipe.radius, foot))
        t.add("pipe", rope(bend(line, 1.0 * size, 3), wire, 8), own=True)
        t.at(x, -0.88 * size, level).along("-y").add("gland", hexagon(4 * wire, 0, 4 * wire))
        return lying(t, "relief valve")


class WeightLoaded(_Safety, name="relief valve/weight loaded", weight=0.7):
    """A weight-loaded safety valve as on old boilers: a long lever across the seat with a sliding weight, a guide."""

    long: float = between(7.0, 11.0, "length of the lever / radius of the chest")
    turn: float = among((0.0, 1.5708, 3.1416), "which way the lever points", "rad")
    spot: float = between(0.55, 0.8, "where the weight is / length of the lever")
    size: float = between(0.9, 1.4, "radius of the weight / of the chest")
    hung: bool = chance(0.5, "the weight hangs from a strap rather than sitting on the lever")

    def build(self, t: Table) -> Model:
        seat, w = self.chest(t)
        plate, long, high, size = 0.01 + 0.08 * w, self.long * w, 1.1 * w, self.size * w
        t.extend(cover(1.3 * w + 0.006, seat, plate, 4, t.style))
        up, place = t.at(0, 0, seat + plate).spun("z", self.turn), long * self.spot - 1.2 * w
        pivot = [box((0.4 * w, 0.12 * w, 1.5 * w), (-0.9 * w, s * 0.2 * w, 0.74 * w)) for s in BOTH]
        guide = [box((0.3 * w, 0.1 * w, 2.0 * w), (1.0 * w, s * 0.2 * w, 0.99 * w)) for s in BOTH]
        up.add("valve bonnet", *pivot, *guide)
        pin = along("y", cylinder(0.1 * w, -0.4 * w, 0.4 * w, 8), -0.9 * w, 0, high)
        up.add("valve stem", cylinder(0.14 * w, -0.001, high, 10), pin)
        up.add("lever", box((long, 0.26 * w, 0.4 * w), (long / 2 - 1.2 * w, 0, high)))
        load, n = up.at(place, 0, high), t.n(size)
        if self.hung:
            bell = turned(outline(0.4 * size, 0.0, size, 0.4 * size, size, 1.8 * size), n)
            strap = box((0.2 * w, 0.5 * w, 0.6 * w))
            load.add("lever", strap, moved(bell, at(0, 0, -0.2 * w) @ spun("x", np.pi)))
        else:
            load.at(0, 0, -0.3 * w).along("y").add("lever", cylinder(size, -0.5 * w, 0.5 * w, n))
        return lying(t, "relief valve")


class Thermal(Valve, name="relief valve/thermal", place="tap"):
    """A thermal relief valve on an outlet: hexagon body, threaded side outlet with a bent tail pipe, sealed cap."""

    thread: float = between(0.009, 0.014, "radius of its thread", "m")
    tall: float = between(3.0, 6.0, "height of the bonnet / radius of the thread")
    piped: bool = chance(0.6, "a pipe leads away from its outlet")
    drop: float = between(0.1, 0.35, "how far that pipe comes down", "m", when=lambda p: p.piped)
    sealed: bool = chance(0.4, "a lead seal on a wire")

    def build(self, t: Table) -> Model:
        r, tall, low = self.thread, self.tall * self.thread, 0.012 + 1.2 * self.thread
        n, axis, top = t.n(1.4 * r), low + 1.4 * r, low + 2.8 * r
        out = along("y", hexagon(2.6 * r, 1.0 * r, 2.6 * r), 0, 0, axis)
        chest = [hexagon(2.6 * r, 0.012, 0.012 + 1.3 * r), cylinder(1.35 * r, low, top, n), out]
        t.add("valve body", cylinder(0.85 * r, 0.0, 0.02, n), *chest)
        up = t.at(0, 0, top)
        up.add("valve bonnet", hexagon(2.7 * r, -0.001, 0.8 * r), cylinder(1.1 * r, 0, tall, n))
        crown = cylinder(0.7 * r, tall - 0.002, tall + 2 * r, n)
        up.add("valve bonnet", hexagon(1.7 * r, tall, tall + 1.2 * r), crown)
        if self.piped:
            path = [(0, 2.5 * r, axis), (0, 5 * r, axis), (0, 5 * r, low - self.drop)]
            t.add("pipe", tube(bend(path, 1.6 * r), 0.9 * r, 0.75 * r if t.style.hollow else 0.0, n))
        if self.sealed:
            tag = (2.0 * r, 0, 0.3 * tall)
            wire = rope([(1.0 * r, 0, 0.5 * tall), tag, (1.1 * r, 0, 0)], 0.0012, 5)
            lead = moved(cylinder(0.5 * r, -0.001, 0.001, 10), at(*tag))
            up.add("position indicator", wire, lead, of="trim")
        return t.model(kind="relief valve")


class WaterHeater(Valve, name="relief valve/water heater", place="tap"):
    """A temperature-and-pressure valve of a water heater: brass body, spout aside, spring dome, test flap on top."""

    thread: float = between(0.010, 0.015, "radius of its thread", "m")
    domed: bool = chance(0.5, "a low dome rather than a tall cone over the spring")
    tilt: float = between(-0.4, 0.1, "of the test flap", "rad")

    def build(self, t: Table) -> Model:
        r, low = self.thread, 0.018 + 1.1 * self.thread
        n, top = t.n(1.5 * r), low + 3.1 * r
        marks = ((1.2, 0), (1.6, 0.8), (1.6, 2.6), (1.9, 2.7), (1.9, 3.1))
        solids = [cylinder(0.9 * r, 0.0, 0.022, n), hexagon(2.7 * r, 0.018, 0.018 + 1.2 * r)]
        solids.append(turned([(a * r, low + z * r) for a, z in marks], n))
        spout: list[Solid] = [cylinder(1.15 * r, 1.2 * r, 2.8 * r, n), ring(0.8 * r, 1.4 * r, 2.6 * r, 3.8 * r, n)]
        t.add("valve body", *solids, along("y", merge(spout), 0, 0, low + 1.5 * r))
        up = t.at(0, 0, top)
        if self.domed:
            dome, high = outline(1.8 * r, -0.001, 1.8 * r, 0.4 * r, 1.2 * r, 1.6 * r, 0.5 * r, 2.0 * r), 2.0 * r
        else:
            dome, high = outline(1.5 * r, -0.001, 1.3 * r, 3 * r, 0.9 * r, 3.2 * r), 3.2 * r
        up.add("valve bonnet", turned(dome, n))
        up.add("valve stem", cylinder(0.25 * r, high - 0.002, high + 1.0 * r, 8))
        flap = up.at(0, 0, high + 0.7 * r).spun("x", self.tilt)
        flap.add("lever", box((0.9 * r, 4.2 * r, 0.16 * r), (0, 1.3 * r, 0)))
        return t.model(kind="relief valve")


class RuptureDisc(Valve, name="rupture disc/holder", sizes=sizes_between(25)):
    """A rupture disc in its holder (EN ISO 4126-2): two rings between flanges, domed disc, hook, tag, cap screws."""

    tilt: float = between(-0.3, 0.3, "of the tag about the pipe", "rad")
    hooked: bool = chance(0.6, "a hook over a flange")

    def build(self, t: Table) -> Model:
        size, bore, d = t.flange, t.pipe.bore, t.pipe.outer
        outer, n, rim = 0.5 * (size.circle - size.bolt) - 0.0005, t.n(size.outer / 2), size.outer / 2 + 0.01
        low, high = 0.02 + 0.08 * d, 0.016 + 0.06 * d
        length, run = round(low + high + 0.001, 6), t.along("x")
        run.add("valve body", ring(bore, outer, 0.0, low, n))
        run.add("valve body", ring(bore, outer, low + 0.001, length, n))
        turns = np.linspace(0, np.pi / 2, 4)[:-1]
        swell = [(0.98 * bore * np.cos(a), low + 0.0005 + 0.35 * bore * np.sin(a)) for a in turns]
        edge = outline(outer - 0.001, low, outer - 0.001, low + 0.001)
        run.add("valve disc", turned([*edge, *swell, (0.08 * bore, low + 0.35 * bore)], n))
        tag = box((0.001, 0.03 + 0.1 * bore, 0.04 + 0.1 * bore), (low + 0.0005, 0, outer + 0.019 + 0.05 * bore))
        t.spun("x", self.tilt).add("position indicator", tag, of="dial")
        if self.hooked:
            path = [(0.4 * low, 0, 0.9 * outer), (0.4 * low, 0, rim), (-0.03, 0, rim), (-0.03, 0, rim - 0.02)]
            t.spun("x", 2.4).add("valve body", rope(path, 0.004, 8), of="trim")
        screws = [box((length * 0.9, 0.012, 0.004), (length / 2, s * (outer + 0.001), 0)) for s in BOTH]
        t.add("screw", *screws)
        return t.model(length, "wafer", "rupture disc")


RELIEFS = families_of(FullLift, OpenBonnet, Pilot, WeightLoaded, Thermal, WaterHeater, RuptureDisc)
