"""Gate valves beyond bronze and rising stem: cast, pressure seal, waterworks, conduit, forged, sluices and slides."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import STEMS, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, scaled, slab, wheels
from cadplants.families.valves.actuation_stroke import linear_of, screw_of
from cadplants.families.valves.body import (
    Packing,
    bolts_on,
    chest,
    ended,
    lid_joint,
    neck_of,
    oval,
    packings,
    room,
    wedge,
)
from cadplants.families.valves.valve import BIG, Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, PIPES, sizes_between
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, lofted, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["GATES", "Gate", "Resilient"]


class Gate(Valve):
    """A gate valve."""

    hollow: bool = styled(True, "whether insides are modelled")


def _hood(a: float, b: float, throat: float, low: float, high: float, n: int) -> Solid:
    """A bonnet that narrows from an oval to a round stuffing box [m]."""
    mid, end = low + 0.35 * (high - low), low + 0.65 * (high - low)
    loops = [(a, b, low), (0.85 * a, 0.8 * b, mid), (throat, throat, end), (throat, throat, high)]
    return lofted([np.column_stack([oval(p, q, n), np.full(n, z)]) for p, q, z in loops])


class CastWedge(Gate, name="gate valve/cast wedge", weight=1.5):
    """A cast wedge gate valve, bolted bonnet round, oval or square, ribs, outside screw and yoke (API 600, EN 1984)."""

    ends: str = among(("flanged", "flanged", "butt"), "its ends, butts welded in")
    thin: float = between(0.62, 0.95, "half its chest's thickness / radius of the pipe")
    wide: float = between(1.35, 1.6, "half its chest's width / radius of the pipe")
    seat: float = between(1.0, 1.15, "height of its bonnet's joint / least")
    plate: str = among(("round", "oval", "oval", "square"), "outline of its bonnet's flange")
    swell: float = between(0.9, 1.05, "of its chest")
    top: float = between(0.5, 1.1, "height of its bonnet / radius of the pipe")
    ribbed: bool = chance(0.5, "ribs on its bonnet")
    ribs: float = among((0.0, np.pi / 4), "where the first rib is", "rad", when=lambda p: p.ribbed, otherwise=0.0)
    webbed: bool = chance(0.4, "webs beside its chest")
    gland: Packing = nested(Packing, "gland")
    rise: float = among((0.0, 1.1, 2.1), "how far its wedge is lifted / bore")
    yoke: float = between(1.5, 2.4, "height of its yoke / radius of the pipe")
    wheel: float = between(0.9, 1.3, "radius of its handwheel / what the pipe asks for")
    screwed: bool = chance(0.75, "an outside screw and yoke")
    screw: Any = screw_of(lambda p: p.wheel * (0.05 + 1.15 * PIPES[p.dn].radius), when=lambda p: p.screwed)
    stem: str = among(STEMS, "form of its stem", when=lambda p: not p.screwed)
    rim: Handwheel = nested(Handwheel, "handwheel", when=lambda p: not p.screwed)

    def build(self, t: Table) -> Model:
        radius, flanged = self.radius, self.ends == "flanged"
        length = FACE_TO_FACE["gate"][self.dn] * (1.0 if flanged else 1.15)
        neck, back = neck_of(self.dn)
        x, n, slim, run = length / 2, t.n(1.5 * radius, 16), 0.006 + 0.075 * radius, 1.05 * radius + 0.008
        a, b = min(self.thin * radius + 0.012, 0.4 * length), self.wide * radius + 0.012
        barrel = outline(neck, back + 0.05 * length, run, 0.3 * length, run, 0.7 * length, neck, 0.95 * length - back)
        seat, plate = self.seat * max(room(self.dn) + 0.01, 1.75 * radius + 0.03), 0.009 + 0.09 * radius
        pa, pb = (b * 1.25,) * 2 if self.plate == "round" else (a + 0.014 + 0.25 * radius, b * 1.22 + 0.008)
        collar, lid, bolts = lid_joint(self.plate, pa, pb, seat, plate, t.style)
        hollow = chest(-1.35 * radius - 0.01, seat - 0.5 * plate, a, b, n, 1.6 * radius, self.swell)
        top = seat + plate + self.top * radius + 0.02
        hood = [lid, _hood(0.9 * a, 0.85 * b, 2.6 * slim, seat + 0.5 * plate, top, n)]
        if self.ribbed:
            thick, low, inner = 0.006 + 0.05 * radius, seat + plate, 1.5 * slim
            rib = slab(np.array([(inner, low), (0.9 * pa, low), (inner, top - 0.01)]), -thick / 2, thick / 2)
            hood.append(around(moved(rib, spun("x", np.pi / 2)), 4, 0.0, self.ribs))
        web = (2 * a + 0.01, 0.012, 2.2 * radius)
        webs = [box(web, (0, s * 0.4 * b, 0.2 * radius)) for s in BOTH] if self.webbed else []
        body = ended(self.dn, t.style, length, barrel, self.ends)
        t.add("valve body", body, *(moved(one, at(x)) for one in (hollow, collar, *webs)))
        t = t.at(x)
        t.add("valve bonnet", *hood)
        t.extend([bolts])
        if self.hollow:
            t.extend([wedge(self.dn, 0.0, 0.5 * length - back, self.rise * t.pipe.bore, t.style)])
        up, tall = t.at(0, 0, top), self.gland.high(slim)
        if self.screwed:
            self.screw.build(up, max(3.4 * slim, 0.6 * b), self.yoke * radius + 0.06 + tall, slim)
            self.gland.build(up.at(0, 0, 0.004), slim)
        else:
            self.gland.build(up, slim)
            put_stem(up, -0.3 * radius, tall + 0.06, slim, self.stem)
            self.rim.build(up, self.wheel * (0.05 + 1.15 * radius), tall + 0.02)
        return t.model(length, "flanged" if flanged else "welded", "gate valve")


class PressureSeal(Gate, name="gate valve/pressure seal", sizes=BIG):
    """A high-pressure gate valve with a pressure-seal bonnet: a thick round bottle, welded ends, a yoke clamped on."""

    long: float = between(1.2, 1.5, "length / of globe valves")
    high: float = between(2.6, 3.4, "height of its bottle / radius of the pipe")
    gland: Packing = nested(packings("oval follower", "round follower", "lantern"), "gland")
    screw: Any = screw_of(lambda p: 0.07 + 1.5 * PIPES[p.dn].radius)
    rise: float = among((0.0, 1.8), "how far its wedge is lifted / bore", when=lambda p: p.hollow, otherwise=0.0)

    def build(self, t: Table) -> Model:
        radius, length = self.radius, FACE_TO_FACE["globe"][self.dn] * self.long
        x, big = length / 2, 1.55 * radius + 0.015
        n, run, end, mid = t.style.round(big), 1.35 * radius + 0.004, 1.1 * radius, 0.88 * big
        barrel = outline(end, 0.12 * length, run, 0.25 * length, run, 0.75 * length, end, 0.88 * length)
        high, rim = self.high * radius + 0.04, 1.12 * big
        bottle = outline(0.4 * big, -1.5 * radius - 0.01, 0.85 * big, -1.35 * radius, big, -0.9 * radius)
        bottle += outline(big, 0.8 * radius, mid, 1.2 * radius, mid, high - 0.5 * radius, rim, high - 0.45 * radius)
        body = ended(self.dn, t.style, length, barrel, "butt")
        t.add("valve body", body, moved(turned([*bottle, (rim, high)], n), at(x)))
        slim, top, t = 0.007 + 0.09 * radius, high + 0.9 * radius, t.at(x)
        cap = outline(0.7 * big, high - 0.01, 0.7 * big, high + 0.02, 0.35 * big, high + 0.25 * radius, 0.33 * big, top)
        cover = ring(0.72 * big, 0.95 * big, high, high + 0.012 + 0.06 * radius, n)
        t.add("valve bonnet", turned(cap, n), cover)
        edge = circle(0.95 * big, n)
        t.extend([bolts_on(edge, 6, high, high + 0.014 + 0.06 * radius, 0.008 + 0.05 * radius)])
        self.gland.build(t.at(0, 0, top), slim)
        clamp = [cylinder(1.2 * big, high - 0.3 * radius, high - 0.08 * radius, n)]
        clamp += [box((0.02, 0.4 * big, 0.2 * radius), (s * 1.22 * big, 0, high - 0.19 * radius)) for s in BOTH]
        t.add("yoke", *clamp)
        yoke = top - high + self.gland.high(slim) + 1.6 * radius + 0.08
        self.screw.build(t.at(0, 0, high), 1.12 * big, yoke, slim)
        if self.hollow:
            t.extend([wedge(self.dn, 0.0, 0.3 * length, self.rise * t.pipe.bore, t.style)])
        return t.model(round(length, 6), "welded", "gate valve")


class _Spindle(Params):
    """What works a waterworks valve: a square cap, a handwheel or an extension with its cap."""

    make: str = weighted("what works it", cap=0.4, wheel=0.4, extension=0.2)
    wheel: Handwheel = nested(
        wheels("spoked", "spoked", "dished", "disc"), "handwheel", when=lambda p: p.make == "wheel"
    )
    reach: float = between(0.4, 0.9, "of the extension", "m", when=lambda p: p.make == "extension")

    def build(self, t: Table, radius: float, slim: float) -> None:
        """Puts it down, for a pipe of a radius, on a stem of another [m]."""
        put_stem(t, -slim, 4.0 * slim, slim)
        if self.make == "wheel":
            self.wheel.build(t, 0.06 + 1.1 * radius, 1.5 * slim)
            return
        if self.make == "extension":
            tube = [cylinder(1.8 * slim, slim, slim + self.reach, 12), cylinder(2.6 * slim, 0.5 * slim, 6 * slim, 12)]
            sleeve = outline(4.0 * slim, 3 * slim, 3.0 * slim, 9 * slim, 3.0 * slim, self.reach - 0.05)
            t.add("valve stem", *tube, turned(sleeve, 14))
            t = t.at(0, 0, self.reach)
        sides = [
            np.column_stack([rounded_rectangle(2 * h, 2 * h, 0.3 * h, 2), np.full(12, z)])
            for h, z in ((2.0 * slim, slim), (1.6 * slim, 5 * slim))
        ]
        t.add("valve stem", lofted(sides), cylinder(2.4 * slim, 0.8 * slim, 1.2 * slim, 14))


class Resilient(Gate, name="gate valve/resilient seated", sizes=BIG):
    """A resilient-seated waterworks gate valve: smooth body, oval bonnet, square cap, wheel or spindle (EN 1171)."""

    long: float = among((1.0, 1.9), "length over a small valve's / of series 14; 1.9 is series 15 (EN 558)")
    plate: str = among(("oval", "square", "octagon"), "outline of its bonnet's flange")
    footed: bool = chance(0.5, "a foot below it")
    ringed: bool = chance(0.5, "a ring round its stuffing box")
    spindle: _Spindle = nested(_Spindle, "what works it")
    rise: float = among((0.0, 1.0), "of its wedge / radius of the pipe", when=lambda p: p.hollow, otherwise=0.0)

    def build(self, t: Table) -> Model:
        """Puts it down along x."""
        radius, slim = self.radius, 0.008 + 0.06 * self.radius
        length = max(0.15 + 0.0008 * self.dn * self.long, 0.14 + 0.1 * radius)
        neck, back = neck_of(self.dn)
        x, n, run = length / 2, t.n(1.5 * radius, 16), 1.12 * radius + 0.006
        a, b = min(0.30 * length, 0.8 * radius + 0.02), 1.3 * radius + 0.016
        seat, plate = max(room(self.dn), 1.45 * radius + 0.03), 0.010 + 0.07 * radius
        barrel = outline(neck, back, run, 0.35 * length, run, 0.65 * length, neck, length - back)
        hollow = chest(-1.2 * radius - 0.008, seat, a, b, n, 1.4 * radius)
        wide = (a + 0.012 + 0.12 * radius, b + 0.012 + 0.1 * radius)
        collar, lid, bolts = lid_joint(self.plate, *wide, seat, plate, t.style)
        high = seat + plate + 0.9 * radius + 0.02
        top = high + 3.0 * slim
        loops = [
            (0.95 * a, 0.95 * b, seat + 0.5 * plate), (0.9 * a, 0.85 * b, seat + 0.55 * (high - seat)),
            (0.6 * a, 0.5 * b, high - 0.1 * radius), (0.45 * a, 0.4 * a, high),
        ]  # fmt: skip
        hood = lofted([np.column_stack([oval(p, q, n), np.full(n, z)]) for p, q, z in loops])
        chamber = outline(3 * slim, high - 0.02, 3 * slim, high + 1.2 * slim, 2.2 * slim, high + 1.6 * slim)
        solids = [ended(self.dn, t.style, length, barrel, "flanged"), moved(merge([hollow, collar]), at(x))]
        if self.footed:
            solids.append(box((0.8 * length - 2 * back, 0.8 * radius, 0.02), (x, 0, -1.25 * radius)))
        t.add("valve body", *solids)
        t = t.at(x)
        t.add("valve bonnet", lid, hood, turned([*chamber, (2 * slim, top)], n))
        t.extend([bolts])
        if self.ringed:
            t.add("gland", cylinder(2.6 * slim, top, top + 0.8 * slim, n))
        self.spindle.build(t.at(0, 0, top), radius, slim)
        if self.hollow:
            t.extend([wedge(self.dn, 0.0, 0.9 * a, self.rise * radius, t.style)])
        return t.model(round(length, 6), kind="gate valve")


class Conduit(Gate, name="gate valve/through conduit", sizes=BIG):
    """A slab or through-conduit gate valve: a tall flat chest above and below the bore, covers bolted on (API 6D)."""

    down: float = among((1.3, 2.4, 2.6), "depth of its chest / radius of the pipe")
    square: bool = chance(0.6, "its chest is rectangular, not oval")
    ribbed: bool = chance(0.6, "ribs round its chest")
    ribs: int = whole(3, 6, "these", when=lambda p: p.ribbed)
    drained: bool = chance(0.5, "a drain below and vents beside it")
    gland: Packing = nested(Packing, "gland")
    screwed: bool = chance(0.7, "an outside screw and yoke, not an actuator")
    screw: Any = screw_of(lambda p: 0.08 + 1.4 * PIPES[p.dn].radius, when=lambda p: p.screwed)
    actuator: Any = linear_of("piston", "ram", "turning", when=lambda p: not p.screwed)
    rise: float = among((0.0, 1.0), "of its slab / its travel", when=lambda p: p.hollow, otherwise=0.0)

    def build(self, t: Table) -> Model:
        radius, length = self.radius, FACE_TO_FACE["gate"][self.dn] * 1.2
        neck, back = neck_of(self.dn)
        x, a, b = length / 2, 0.45 * radius + 0.02, 1.3 * radius + 0.012
        up, down = max(2.5 * radius + 0.03, room(self.dn) + 0.01), self.down * radius + 0.02
        edge = rounded_rectangle(2 * a, 2 * b, 0.25 * a, 2) if self.square else oval(a * 1.15, b, 20)
        plate, run = 0.010 + 0.1 * radius, 1.15 * radius + 0.006
        wide = (a + 0.014 + 0.2 * radius, b + 0.014 + 0.18 * radius)
        collar, lid, bolts = lid_joint("square" if self.square else "oval", *wide, up, plate, t.style)
        middle = outline(neck, back, run, 0.3 * length, run, 0.7 * length, neck, length - back)
        tower = [slab(edge, -down, up), collar]
        if self.ribbed:
            levels = np.linspace(-0.85 * down, 0.8 * up, self.ribs)
            tower += [box((2 * a + 0.016, 2 * b + 0.016, 0.012), (0, 0, float(z))) for z in levels]
        if self.drained:
            drain = turned(outline(0.3 * radius, 0, 0.3 * radius, 0.02, 0.12 * radius, 0.03), 12)
            tower.append(along("-z", drain, 0, 0, -down))
            tower += [along("y", hexagon(0.03, b - 0.002, b + 0.03), 0, 0, s * 0.6 * up) for s in BOTH]
        body = ended(self.dn, t.style, length, middle, "flanged")
        t.add("valve body", body, *(moved(one, at(x)) for one in tower))
        slim, top, t = 0.008 + 0.08 * radius, up + plate, t.at(x)
        high = top + 0.6 * radius + 0.01
        t.add(
            "valve bonnet",
            lid,
            turned(outline(0.5 * b, top - 0.002, 0.35 * b, top + 0.3 * radius, 2.6 * slim, high), 20),
        )
        t.extend([bolts])
        above = t.at(0, 0, high)
        if self.screwed:
            self.gland.build(above, slim)
            tall = self.gland.high(slim) + 2.0 * radius + 0.08
            self.screw.build(above, 3.6 * slim + 0.3 * radius, tall, slim)
        else:
            self.actuator.build(above)
        if self.hollow:
            t.add("valve disc", box((0.5 * a, 1.8 * b, 2.4 * radius), (0, 0, self.rise * 1.1 * radius)))
        return t.model(round(length, 6), kind="gate valve")


class Forged(Gate, name="gate valve/forged", sizes=sizes_between(most=50)):
    """A compact forged gate or globe valve, bolted or welded bonnet, socket, threaded or butt ends (API 602)."""

    ends: str = among(("socket", "socket", "hex", "octagon", "butt"), "its ends")
    square: bool = chance(0.5, "its chest is rectangular, not round")
    bolted: bool = chance(0.6, "its bonnet is bolted, not welded")
    plate: str = among(("round", "square"), "outline of its bonnet's flange", when=lambda p: p.bolted)
    hexed: bool = chance(0.5, "a hexagon on its welded bonnet", when=lambda p: not p.bolted)
    gland: Packing = nested(Packing, "gland")
    wheel: float = between(0.85, 1.2, "radius of its handwheel / what the pipe asks for")
    screw: Any = screw_of(lambda p: min(p.wheel * (0.035 + 1.6 * PIPES[p.dn].radius), 0.079))
    wedged: bool = chance(0.5, "a wedge inside, where its ends are welded", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        radius = self.radius
        length, big, seat = 0.055 + 3.2 * radius, 1.35 * radius + 0.006, 1.9 * radius + 0.02
        x, n, end = length / 2, t.style.round(big), 1.2 * radius
        barrel = outline(end, 0.2 * length, big, 0.36 * length, big, 0.64 * length, end, 0.8 * length)
        edge = rounded_rectangle(1.9 * big, 2.1 * big, 0.5 * big, 3) if self.square else circle(big, n)
        tower, bolts = [slab(edge, -1.2 * radius - 0.004, seat)], []
        slim, plate = 0.004 + 0.09 * radius, 0.008 + 0.1 * radius
        if self.bolted:
            collar, lid, studs = lid_joint(self.plate, 1.55 * big, 1.55 * big, seat, plate, t.style)
            tower, bolts, top = [*tower, collar], [studs], seat + plate
            high = top + 0.5 * radius + 0.006
            hood = outline(big, seat + 0.5 * plate, 0.9 * big, top + 0.3 * radius, 2.4 * slim, high)
            cap = [lid, turned(hood, n)]
        else:
            high = seat + 1.3 * radius + 0.012
            hood = outline(0.95 * big, seat, 1.05 * big, seat + 0.1 * radius, 0.9 * big, seat + 0.7 * radius)
            cap = [turned([*hood, (0.6 * big, high - 0.004), (0.55 * big, high)], n)]
            if self.hexed:
                cap.append(hexagon(2.1 * big, seat + 0.002, seat + 0.5 * radius))
        body = ended(self.dn, t.style, length, barrel, self.ends)
        t.add("valve body", body, *(moved(one, at(x)) for one in tower))
        t = t.at(x)
        t.add("valve bonnet", *cap)
        t.extend(bolts)
        self.gland.build(t.at(0, 0, high), slim)
        yoke = self.gland.high(slim) + 0.05 + 1.3 * radius
        self.screw.build(t.at(0, 0, high), max(3.6 * slim, 0.8 * big), yoke, slim)
        if self.hollow and self.wedged and self.ends in ("socket", "butt"):
            t.extend([wedge(self.dn, 0.0, 0.8 * radius, 0.0, t.style)])
        elif self.hollow:
            plug = scaled(radius, 0.5, 0.1, 0.75, 0.3, 0.75, 0.6, 0.3, 1)
            t.add("valve disc", turned([*plug, (0.3 * radius, seat + 0.004)], 16))
        return t.model(round(length, 6), "welded", "gate valve")


GATES = families_of(CastWedge, PressureSeal, Resilient, Conduit, Forged)
