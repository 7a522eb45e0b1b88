"""Further check valves: along x from 0 in a line, or bolted on the last flange of one."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, styled, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.base import (
    HOLLOW,
    lying,
)
from cadplants.families.valves.parts import BIG, MID, SMALL, cage, cover, hub_radius, spring, thread_nut, threaded_run
from cadplants.families.valves.valve import Valve, bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, FLANGES, SIZES
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, lofted, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["CHECKS"]


class _Check(Valve):
    """A check valve."""

    def done(self, t: Table, length: float, joint: str = "flanged") -> Model:
        """What was put down, as a valve in a line."""
        return t.model(round(length, 6), joint, "check valve")


class WeightedLever(_Check, name="check valve/weighted lever", sizes=BIG, weight=1.5):
    """A swing check valve (EN 12334) with its shaft led out to a lever: cast, disc or bar weights on it."""

    throat: float = between(0.8, 0.95, "radius of the chest / of the bulge")
    square: bool = among((False, True), "its cover is square")
    hood: float = among((0.0, 0.3), "rise of the cover / radius of the pipe")
    side: int = among(BOTH, "side of the lever")
    tilt: float = between(-0.7, 0.5, "of the lever, downwards", "rad")
    load: str = weighted("what loads the lever", cast_weight=0.4, two_discs=0.2, two_bars=0.2, disc=0.2)

    def build(self, t: Table) -> Model:
        length, r, side = FACE_TO_FACE["check"][t.dn], t.pipe.radius, self.side
        neck, thick = hub_radius(t.dn), plate_thickness(t.dn)
        bulge = max(1.15 * neck, 1.35 * r + 0.008)
        x, n = 0.48 * length, t.n(bulge)
        seat, throat = max(1.25 * bulge, 0.48 * t.flange.outer), self.throat * bulge
        run = flanged_body(
            t.dn, t.style, length, outline(bulge, thick + 0.2 * length, bulge, length - thick - 0.12 * length)
        )
        t.add("valve body", run, moved(cylinder(throat, 0.3 * bulge, seat - 0.004, n), at(x)))
        lid = cover(1.2 * throat + 0.006, seat, 0.01 + 0.08 * r, 8, t.style, self.square, self.hood * r)
        t.at(x).extend(lid)
        px, pz = x - 0.45 * throat, 0.72 * seat
        reach = max(1.25 * throat + 0.02, 0.5 * t.flange.outer + 0.2 * r)
        out = t.at(px, 0, pz).along("y" if side > 0 else "-y")
        out.add("valve body", cylinder(0.2 * throat + 0.006, 0.5 * throat, reach, 12))
        pin = rod((px, side * 0.4 * throat, pz), (px, side * (reach + 0.035 + 0.1 * r), pz), 0.005 + 0.09 * r, 10)
        t.add("valve stem", pin)
        out.add("gland", hexagon(0.3 * throat + 0.012, reach, reach + 0.012))
        far, half = 0.07 + 2.6 * r, 0.006 + 0.08 * r
        arm = t.at(px, side * (reach + 0.02 + 0.05 * r), pz).spun("y", self.tilt)
        eye = along("y", cylinder(2 * half, -0.9 * half, 0.9 * half, 12))
        arm.add("lever", box((far, 0.4 * half + 0.004, 2 * half), (far / 2 - half, 0, 0)), eye)
        arm.add("lever", *self._load(t, far, r))
        if t.style.hollow:
            disc = cylinder(0.93 * t.pipe.bore, -0.004, 0.004 + 0.03 * r, n)
            t.at(px).along("x").add("valve disc", disc)
        return self.done(t, length)

    def _load(self, t: Table, far: float, r: float) -> list[Solid]:
        """What loads a lever along x."""
        size = 0.02 + 0.5 * r
        if self.load == "cast weight":
            return [box((1.3 * size, size, 1.6 * size), (0.85 * far, 0, 0))]
        if self.load == "two bars":
            return [box((0.5 * size, 0.8 * size, 2.4 * size), (k * far, 0, 0)) for k in (0.6, 0.95)]
        discs = [(size, 0.012 + 0.2 * r), (0.7 * size, 0.02 + 0.4 * r)][: 2 if self.load == "two discs" else 1]
        return [along("y", cylinder(wide, -half, half, t.n(size)), 0.85 * far) for wide, half in discs]


class TiltingDisc(_Check, name="check valve/tilting disc", sizes=BIG):
    """A tilting-disc check valve (API 594 type): two halves in a slanting joint, short body, inspection cap aside."""

    long: float = between(1.0, 1.3, "length / that of a gate valve")
    tilt: float = between(0.15, 0.35, "of the joint from upright", "rad")
    finger: bool = chance(0.5, "a finger shows where the disc is")

    def build(self, t: Table) -> Model:
        length, r = FACE_TO_FACE["gate"][t.dn] * self.long, t.pipe.radius
        neck, thick, n = hub_radius(t.dn), plate_thickness(t.dn), t.n(1.5 * r)
        bulge, end = 1.3 * neck + 0.004, thick + 0.05 * length
        middle = outline(neck, end, bulge, 0.42 * length, bulge, 0.58 * length, neck, length - end)
        collar, plate = 1.0 * bulge + 0.018 + 0.1 * r, 0.008 + 0.05 * r
        joint = t.at(length / 2).spun("y", np.pi / 2 + self.tilt)
        t.add("valve body", flanged_body(t.dn, t.style, length, middle))
        for z in (-plate, 0.0):
            joint.add("valve body", cylinder(collar, z, z + plate, n))
        bolts = bolt_circle(max(6, 2 * int(collar / 0.03)), collar - 0.008, 0.007 + 0.02 * r, -plate, plate)
        joint.add("bolt", bolts)
        aside = t.at(0.5 * length + 0.2 * r, 0, 0.3 * r)
        aside.along("y").add("valve body", cylinder(0.3 * r + 0.006, 0.5 * bulge, collar + 0.012, 12))
        aside.along("y").add("valve bonnet", hexagon(0.6 * r + 0.02, collar + 0.012, collar + 0.022))
        if self.finger:
            finger = rod((0, 0, 0), (0.6 * r + 0.02, 0, 0.5 * r), 0.004, 6)
            aside.at(0, collar + 0.02).add("position indicator", finger, of="trim")
        if t.style.hollow:
            edge = 0.93 * t.pipe.bore
            joint.add(
                "valve disc", turned(outline(0.4 * r, -0.06 * r, edge, -0.01 * r, edge, 0.03 * r, 0.3 * r, 0.2 * r), n)
            )
        return self.done(t, length)


class DualPlate(_Check, name="check valve/dual plate", sizes=BIG):
    """A dual-plate check valve (API 594): lugs, or short with flanges; two half discs, pins, springs, plugs."""

    hollow: bool = styled(True, HOLLOW)
    lugged: bool = chance(0.6, "lugs between flanges rather than flanges of its own")
    full: bool = chance(0.5, "the lugs are as long as the body", when=lambda p: p.lugged)
    eye: bool = chance(0.4, "an eye to lift it by, from DN 80")
    swing: float = among((0.0, 0.3, 1.1), "how far the plates are open", "rad", when=lambda p: p.hollow, otherwise=0.0)

    def build(self, t: Table) -> Model:
        size, bore, r = t.flange, t.pipe.bore, t.pipe.radius
        length = (1.0 if t.dn < 100 else 1.5) * 0.6 * t.pipe.outer + 0.025
        outer, edge = 0.49 * (size.circle - size.bolt), 1.1 * hub_radius(t.dn)
        if self.lugged:
            low, high = (0.0, length) if self.full else (0.2 * length, 0.8 * length)
            lug = ring(0.52 * size.bolt, 1.05 * size.bolt, low, high, 10)
            lugs = around(lug, size.n_bolts, size.circle / 2, np.pi / size.n_bolts)
            solid, edge = about_x(merge([ring(bore, outer, 0.0, length, t.n(size.outer / 2)), lugs])), outer
        else:
            solid = flanged_body(t.dn, t.style, length, [(1.15 * hub_radius(t.dn), 0.5 * length)])
        t.add("valve body", solid)
        for x in (0.4 * length, 0.62 * length):
            t.at(x).add("valve bonnet", hexagon(0.12 * r + 0.012, 0.96 * edge, edge + 0.01), of="trim")
        if self.eye and t.dn >= 80:
            eye = t.at(0.5 * length, 0, edge + 0.012).along("y")
            eye.add("lifting lug", ring(0.008, 0.014, -0.004, 0.004, 12), of="fastener", own=True, fine=True)
        if self.hollow:
            a = np.linspace(0.02, np.pi - 0.02, 10)
            half = extrude(0.96 * bore * np.column_stack([np.cos(a), np.sin(a)]), 0.0, 0.004 + 0.04 * r)
            for k in (0, 1):
                wing = t.at(0.4 * length).along("x").spun("z", k * np.pi).spun("x", self.swing)
                wing.at(0, 0.01 * r).add("valve disc", half)
            t.at(0.4 * length).add("valve stem", cylinder(0.05 * bore + 0.002, -bore - 0.002, bore + 0.002, 8))
        return self.done(t, length, "wafer" if self.lugged else "flanged")


class PistonCheck(_Check, name="check valve/piston", sizes=MID):
    """A forged piston check valve (API 602): a straight round chest with a bolted or welded flat cover."""

    flanged: bool = chance(0.5, "has flanges")
    cover: str = among(("round", "square", "screwed"), "its cover")
    count: int = among((4, 6), "bolts of a round cover", when=lambda p: p.cover != "screwed", otherwise=0)
    stem: bool = chance(0.3, "a stem stands out of the cover")

    def build(self, t: Table) -> Model:
        r, flanged = t.pipe.radius, self.flanged
        length = FACE_TO_FACE["check"][t.dn] if flanged else 4.2 * r + 0.045
        chest, plate = 1.35 * r + 0.008, 0.008 + 0.1 * r
        seat, n = max(2.0 * r + 0.02, 0.5 * t.flange.outer + 0.006 if flanged else 0.0), t.n(chest)
        if flanged:
            run = flanged_body(t.dn, t.style, length, [(hub_radius(t.dn), 0.5 * length)])
        else:
            end, slim = 1.5 * r + 0.003, 1.2 * r
            marks = ((end, 0), (end, 0.3), (slim, 0.36), (slim, 0.64), (end, 0.7), (end, 1))
            run = along("x", turned([(wide, f * length) for wide, f in marks], n, bore=bore_of(t.dn, t.style)))
        tower = turned(outline(0.8 * chest, -1.1 * chest, chest, -0.7 * chest, chest, seat - 0.003), n)
        t.add("valve body", run, moved(tower, at(length / 2)))
        up, top = t.at(length / 2), seat + plate
        if self.cover == "screwed":
            top = seat + 0.6 * chest
            cap = cylinder(1.05 * chest, seat - 0.003, seat + 0.01, n)
            up.add("valve bonnet", cap, hexagon(1.7 * chest, seat, top))
        else:
            up.extend(cover(1.25 * chest + 0.008, seat, plate, self.count, t.style, self.cover == "square"))
        if self.stem:
            up.add("valve stem", cylinder(0.004 + 0.05 * r, top - 0.002, top + 0.02, 8))
        return self.done(t, length, "flanged" if flanged else "welded")


class NozzleCheck(_Check, name="check valve/nozzle", sizes=BIG):
    """An axial nozzle check valve: a venturi body, ribs before a torpedo, a sliding disc on a guide with its spring."""

    hollow: bool = styled(True, HOLLOW)
    long: float = between(1.8, 2.6, "length / diameter of the pipe")
    ribbed: bool = chance(0.5, "ribs along its body")
    vanes: int = whole(3, 5, "ribs that hold the torpedo", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        r, bore = t.pipe.radius, t.pipe.bore
        length, neck = self.long * t.pipe.outer + 0.06, hub_radius(t.dn)
        wide, end = max(1.35 * r, 1.12 * neck), plate_thickness(t.dn) + 0.1 * length
        middle, run = outline(neck, end, wide, 0.45 * length, wide, 0.6 * length, neck, length - end), t.along("x")
        t.add("valve body", flanged_body(t.dn, t.style, length, middle))
        if self.ribbed:
            rib = box((0.3 * wide, 0.02 + 0.03 * r, 0.5 * length), (0.97 * wide, 0, 0.5 * length))
            run.add("valve body", around(rib, 6))
        if self.hollow:
            n = t.n(0.6 * r)
            nose = outline(0.08 * r, 0.15 * length, 0.45 * bore, 0.35 * length, 0.5 * bore, 0.45 * length)
            vane = box((0.6 * bore, 0.05 * r, 0.2 * length), (0.72 * bore, 0, 0.33 * length))
            run.add("valve body", turned(nose, n), around(vane, self.vanes))
            plate = outline(0.88 * bore, 0.5 * length, 0.88 * bore, 0.53 * length, 0.2 * bore, 0.62 * length)
            run.add("valve disc", turned(plate, n))
            run.add("valve stem", cylinder(0.12 * bore, 0.4 * length, 0.78 * length, 10))
        return self.done(t, length)


class DiscCheck(_Check, name="check valve/disc", sizes=tuple(dn for dn in SIZES if FLANGES[dn].n_bolts == 4)):
    """A stainless disc check valve between flanges (EN 558 series 49): short ring, cams, disc, a cross behind."""

    outer: float = between(0.72, 0.9, "radius / that of the circle within the bolts")
    cams: int = among((3, 4), "cams that centre it")
    stop: bool = chance(0.4, "a pin with a knob stands on it")

    def build(self, t: Table) -> Model:
        size, bore = t.flange, t.pipe.bore
        length, edge, n = 0.012 + 0.3 * t.pipe.outer, 0.49 * (size.circle - size.bolt), t.n(size.outer / 2)
        outer, run = max(1.12 * t.pipe.radius, self.outer * edge), t.along("x")
        rings = ((0.9 * bore, outer, 0.0, 0.35), (bore, 0.5 * (outer + bore), 0.0, 1.0), (bore, outer, 0.85, 1.0))
        shell = [ring(inner, wide, low * length, high * length, n) for inner, wide, low, high in rings]
        cam = box((1.05 * (edge - outer) + 0.004, 0.2 * outer, 0.25 * length), ((edge - outer) / 2, 0, 0.14 * length))
        run.add("valve body", *shell, around(cam, self.cams, outer - 0.002, np.pi / self.cams))
        if self.stop:
            stop = rod((0, 0, outer), (0, 0, edge + 0.012), 0.003, 6)
            t.at(0.3 * length).add("valve stem", stop, moved(ball(0.006, 8), at(0, 0, edge + 0.012)))
        plate = outline(0.95 * bore, 0.36 * length, 0.95 * bore, 0.44 * length, 0.2 * bore, 0.5 * length)
        run.add("valve disc", turned(plate, n))
        long, slim = 2.1 * bore, 0.14 * bore
        cross = [box((a, b, 0.1 * length), (0, 0, 0.9 * length)) for a, b in ((long, slim), (slim, long))]
        coil = spring(0.25 * bore, 0.0012, 0.46 * length, 0.87 * length, 3, t.style)
        run.add("valve stem", *cross, coil)
        return self.done(t, length, "wafer")


class FootValve(Valve, name="foot valve/strainer", place="head", sizes=MID):
    """A foot valve at a suction pipe's end: body with a guided disc, strainer basket of bars, sheet or cast slots."""

    wide: float = between(1.4, 1.9, "radius of the body / of the pipe")
    tall: float = between(1.2, 2.2, "length of the body / radius of the pipe")
    deep: float = between(1.0, 2.6, "length of the basket / radius of the body")
    basket: str = among(("bars", "rings", "cone"), "how the basket is made")
    bolted: bool = chance(0.6, "the basket is bolted on")
    arm: bool = chance(0.3, "a lever to lift the disc")

    def build(self, t: Table) -> Model:
        r, thick = t.pipe.radius, plate_thickness(t.dn)
        wide, start = self.wide * r + 0.008, thick + 0.02 + 0.3 * r
        low, lip, n, deep = start + 0.4 * r, 1.12 * wide, t.n(wide), self.deep * wide
        high = low + self.tall * r + 0.02
        shell = turned(outline(1.05 * r, thick + 0.005, wide, low, wide, high), n)
        t.add("valve body", disc_flange(t.dn, t.style, start), shell)
        t.add("valve body", cylinder(lip, high - 0.012, high, n))
        basket = self._basket(t.at(0, 0, high), wide, deep, n)
        strainer = [moved(solid, at(0, 0, high)) for solid in (cylinder(lip, 0, 0.01, n), *basket)]
        t.add("strainer", *strainer, of="trim", own=True)
        if self.bolted:
            t.add("bolt", bolt_circle(6, 1.04 * wide, 0.006, high - 0.012, high + 0.01))
        if self.arm:
            t.add("lever", rod((0.8 * wide, 0, low), (1.9 * wide, 0, start + 0.2 * r), 0.006, 8))
        return lying(t, "foot valve")

    def _basket(self, t: Table, wide: float, deep: float, n: int) -> list[Solid]:
        """The basket from 0 up, of a body's radius."""
        if self.basket == "bars":
            return [cage(0.95 * wide, 0.005, deep, 16, 4, t.style)]
        if self.basket == "rings":
            rings = [ring(0.75 * wide, 0.92 * wide, z, z + 0.05 * deep, n) for z in np.linspace(0.1, 0.9, 7) * deep]
            posts = around(box((0.1 * wide, 0.12 * wide, 0.95 * deep), (0, 0, 0.48 * deep)), 4, 0.83 * wide)
            return [*rings, posts, cylinder(0.92 * wide, 0.95 * deep, deep, n)]
        cone = turned(outline(0.95 * wide, 0.005, 0.9 * wide, 0.3 * deep, 0.5 * wide, 0.7 * deep), n)
        return [cone, around(box((0.1 * wide, 0.06 * wide, 0.3 * deep), (0.92 * wide, 0, 0.16 * deep)), 12)]


class Flap(Valve, name="flap valve/hinged", place="head", sizes=BIG):
    """A flap valve at an outfall (EN 12334 practice): a slanting round or square flap, hinge, arms, weight."""

    tilt: float = between(0.05, 0.3, "of the flap from upright", "rad")
    is_round: bool = among((False, True), "the flap is round, not square")
    domed: bool = chance(0.5, "a boss in the middle of the flap")
    load: bool = chance(0.35, "a weight on an arm")

    def build(self, t: Table) -> Model:
        r, thick, plate = t.pipe.radius, plate_thickness(t.dn), 0.008 + 0.04 * t.pipe.radius
        reach, n, w = 0.02 + 0.5 * r, t.n(1.3 * r), 1.25 * r + 0.01

        def leaf(half: float, low: float, high: float) -> Solid:
            corners = rounded_rectangle(2 * half, 2 * half, 0.15 * half, 3)
            return cylinder(half, low, high, n) if self.is_round else extrude(corners, low, high)

        pose = at(0, 0, thick + reach) @ spun("x", self.tilt)
        upper = np.column_stack([circle(1.1 * r, 16), np.zeros(16)]) @ pose[:3, :3].T + pose[:3, 3]
        throat = lofted([np.column_stack([circle(1.05 * r, 16), np.full(16, thick)]), upper])
        neck, hinge = disc_flange(t.dn, t.style, thick + 0.7 * reach), t.moved(pose)
        t.add("valve body", neck, throat, moved(leaf(w, -plate, 0.0), pose))
        ribs = [box((0.12 * w, 1.7 * w, 0.6 * plate), (s * 0.4 * w, 0.1 * w, 1.2 * plate)) for s in BOTH]
        boss = [turned(outline(0.6 * w, 0.8 * plate, 0.3 * w, 2.2 * plate), n)] if self.domed else []
        hinge.add("valve disc", leaf(0.97 * w, 0.0, plate), *ribs, *boss, of="valve")
        ears = [box((0.1 * w, 0.35 * w, 3.4 * plate), (s * 0.6 * w, 0.98 * w, 0.6 * plate)) for s in BOTH]
        arms = [box((0.12 * w, 0.4 * w, 0.8 * plate), (s * 0.4 * w, 0.96 * w, 1.2 * plate)) for s in BOTH]
        hinge.add("valve body", *ears)
        pin = hinge.at(0, 1.12 * w - 0.02 * w, 1.2 * plate).along("x")
        pin.add("valve stem", cylinder(0.45 * plate, -0.75 * w, 0.75 * w, 8))
        hinge.add("lever", *arms, of="valve", own=True)
        if self.load:
            end = (0, 1.5 * w, 1.5 * w)
            hinge.add("lever", rod((0, 0.4 * w, plate), end, 0.5 * plate, 8), moved(ball(0.22 * w, 12), at(*end)))
        return lying(t, "flap valve")


class Duckbill(Valve, name="duckbill valve/cuff", place="head", sizes=BIG, weight=0.7):
    """A duckbill check valve: a rubber cuff with its own flange or clamped on a spigot, flattening to a slit."""

    long: float = between(2.5, 4.5, "length of the bill / radius of the pipe")
    finned: bool = chance(0.5, "ribs along the bill")
    clamps: int = whole(1, 2, "clamps round the cuff")

    def build(self, t: Table) -> Model:
        r, low, start = t.pipe.radius, plate_thickness(t.dn), 0.03 + 0.5 * t.pipe.radius
        long, k, wide, n = self.long * r + 0.03, 24, 1.12 * r, t.n(r)
        high, loops = low + start, []
        for f in np.linspace(0, 1, 9):
            half = (wide * (1 + 0.42 * f**1.5), wide * (1 - f) ** 0.8 + 0.008 + 0.03 * r)
            loops.append(np.column_stack([circle(1.0, k) * half, np.full(k, high + f * long)]))
        cuff = cylinder(wide + 0.004, low, high, n)
        fins = [box((0.16 * r, 0.3 * r, 0.6 * long), (0, s * 0.5 * r, high + 0.3 * long)) for s in BOTH]
        t.add("valve body", disc_flange(t.dn, t.style, low + 0.3 * start))
        t.add("valve disc", cuff, lofted(loops), *(fins if self.finned else []), of="rubber")
        for f in (0.4, 0.75)[: self.clamps]:
            band = ring(wide + 0.0035, wide + 0.006, -0.007, 0.007, n)
            t.at(0, 0, low + f * start).add("clamp", band, box((0.02, 0.03, 0.012), (wide + 0.012, 0, 0)), own=True)
        return lying(t, "duckbill valve")


class BallCheck(_Check, name="check valve/ball threaded", sizes=SMALL):
    """A threaded ball check valve in Y pattern (sewage type): slanting bolted or screwed cap, rubber ball."""

    long: float = between(4.4, 5.4, "length / radius of the pipe")
    # Flow pushes the ball off its seat into the branch, which leans downstream therefore.
    lean: float = between(-0.75, -0.5, "of the branch from upright, upstream", "rad")
    bolted: bool = chance(0.6, "its cap is bolted, not screwed")
    square: bool = among((False, True), "the bolted cap is square", when=lambda p: p.bolted, otherwise=False)

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.035
        marks = ((1.05 * r, 0.15), (1.35 * r, 0.35), (1.35 * r, 0.65), (1.05 * r, 0.85))
        run = threaded_run(t, length, *marks)
        wide, plate, n, lean = 1.5 * r + 0.003, 0.007 + 0.05 * r, t.n(1.5 * r), -self.lean
        rim = 1.25 * wide + 0.006
        # Its cap passes the pipe.
        reach = max(2.7 * r + 0.008, plate + float((1.3 * r + 0.004 + rim * np.sin(lean)) / np.cos(lean)))
        pose = at(0.4 * length) @ spun("y", lean)
        arm = turned(outline(0.9 * wide, 0.0, wide, 0.4 * reach, wide, reach - 0.003), n)
        t.add("valve body", run, moved(arm, pose))
        branch = t.moved(pose)
        if self.bolted:
            branch.extend(cover(rim, reach, plate, 4, t.style, self.square, 0.3 * r))
        else:
            cap = cylinder(1.12 * wide, reach - 0.01, reach + 0.3 * r, n)
            branch.add("valve bonnet", cap, hexagon(wide, reach, reach + 0.7 * r))
        if t.style.hollow:
            t.at(0.45 * length).add("valve ball", ball(0.95 * r, n), of="rubber")
        return self.done(t, length, "welded")


class PlasticCheck(_Check, name="check valve/plastic union", sizes=SMALL):
    """A plastic non-return valve (EN ISO 16137): a clear or grey cylinder between two ribbed union nuts."""

    long: float = between(4.5, 6.5, "length / radius of the pipe")
    ribs: int = among((0, 12, 16), "ribs of a round nut; hexagonal nuts have none")
    ringed: bool = chance(0.5, "a ring round its middle")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.long * t.pipe.radius + 0.03
        n, wide, run = t.n(1.6 * r), 1.5 * r + 0.003, t.along("x")
        shell = [ring(0.9 * r if t.style.hollow else 0.0, 1.22 * r, 0.0, length, n)]
        shell.append(cylinder(wide, 0.3 * length, 0.7 * length, n))
        shell += [cylinder(1.1 * wide, 0.48 * length, 0.52 * length, n)] if self.ringed else []
        run.add("valve body", *shell)
        for low in (0.1 * length, 0.68 * length):
            nut = thread_nut(3.1 * r + 0.006, low, low + 0.22 * length, t.style, self.ribs)
            run.add("union", nut, of="valve", own=True)
        return self.done(t, length, "welded")


CHECKS = families_of(
    WeightedLever, TiltingDisc, DualPlate, PistonCheck, NozzleCheck, DiscCheck, FootValve, Flap, Duckbill, BallCheck,
    PlasticCheck,
)  # fmt: skip
