"""Globe and control valves of further makes: bellows, cage trim, angle, oblique, needle, cryogenic, cut open."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled, weighted
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import STEMS, put_stem
from cadplants.families.valves.actuation_hand import Handlever, Handwheel, levers, scaled, slab, wheels
from cadplants.families.valves.actuation_stroke import screw_of
from cadplants.families.valves.body import Packing, bolts_on, ended, lid_joint, neck_of, oval, part_turned, room
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import MID, Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, PIPES, sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, along, ball, box, cylinder, hexagon, lofted, ring, turned, waves
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["GLOBES", "GlobeBody", "globe_plug"]

_ABOUT_STEM = "form of its stem"
_PLUGS = ("disc", "cone", "piston")


class GlobeBody(Params):
    """A globe's body: a bowl, a barrel or a box with a waist below its collar."""

    belly: float = between(1.3, 1.6, "radius of its belly / of the pipe")
    form: str = among(("bowl", "barrel", "drum", "box"), "form of its belly")
    stretch: float = between(0.9, 1.2, "height of a bowl / width", when=lambda p: p.form == "bowl")
    lift: float = between(-0.25, 0.1, "of a bowl / its radius", when=lambda p: p.form == "bowl")
    drained: bool = chance(0.25, "a drain below it")

    def solid(self, dn: int, style: ModelingStyle, length: float, ends: str, seat: float, throat: float) -> Solid:
        """The body of a length between ends of a kind, up to the height ``seat`` [m]."""
        radius = PIPES[dn].radius
        neck, low = neck_of(dn) if ends == "flanged" else (1.1 * radius, 0.12 * length)
        b, run = self.belly * radius + 0.006, 1.15 * radius + 0.003
        middle = outline(neck, low, run, 0.28 * length, run, 0.72 * length, neck, length - low)
        n = max(16, style.round(b))
        if self.form == "bowl":
            solids = [moved(ball(b, n, self.stretch), at(0, 0, self.lift * b))]
        elif self.form == "barrel":
            solids = [turned(scaled(b, 0.5, -1.2, 0.9, -1, 1, -0.5, 1, 0.6, 0.8, 1), n)]
        elif self.form == "drum":
            solids = [along("y", cylinder(1.05 * b, -0.9 * b, 0.9 * b, n))]
        else:
            loops = outline(0.8, -1.15, 1, -0.9, 1, 0.6, 0.75, 1.05)
            solids = [lofted([np.column_stack([oval(1.35 * b * s, b * s, n), np.full(n, z * b)]) for s, z in loops])]
        if self.drained:
            solids += [cylinder(0.25 * b, -1.4 * b, 0.0, 10), hexagon(0.4 * b, -1.6 * b, -1.4 * b)]
        solids.append(turned(outline(throat, 0, throat, seat - 0.002), n))
        return merge([ended(dn, style, length, middle, ends), moved(merge(solids), at(length / 2))])


_PROFILES = {
    "disc": (0.7, 0, 1, 0.1, 1, 0.35, 0.4, 0.5, 0.4, 0.9),
    "cone": (0.05, -0.9, 0.5, -0.35, 0.95, 0, 1, 0.2, 0.4, 0.4, 0.4, 1),
    "piston": (0.2, -0.8, 0.7, -0.6, 0.9, 0, 1, 0.05, 1, 0.9),
}


def globe_plug(radius: float, shape: int, style: ModelingStyle, lift: float) -> Solid:
    """A globe's plug on its seat at z = 0: flat disc, cone, or a cage's piston [m]."""
    side = scaled(radius, *_PROFILES[_PLUGS[shape]])
    return moved(turned(side, max(12, style.round(radius))), at(0, 0, lift))


class Bellows(Valve, name="globe valve/bellows seal", sizes=MID):
    """A bellows-sealed globe valve: long bonnet or open bellows in a yoke (EN 13709, EN 558 series 1)."""

    hollow: bool = styled(True, "whether insides are modelled")
    standard: bool = chance(0.6, "of the usual length, not short")
    plate: str = among(("round", "round", "square"), "outline of its bonnet's flange")
    high: float = between(1.6, 3.0, "height of its bonnet / radius of the pipe")
    open: bool = chance(0.4, "its bellows are in sight")
    body: GlobeBody = nested(GlobeBody, "body")
    gland: Packing = nested(Packing, "gland")
    screwed: bool = chance(0.5, "an outside screw and yoke")
    screw: Any = screw_of(lambda p: 0.04 + 1.25 * PIPES[p.dn].radius, when=lambda p: p.screwed)
    stem: str = among(STEMS, _ABOUT_STEM, when=lambda p: not p.screwed)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: not p.screwed)
    plug: str = among(_PLUGS, "form of its plug", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        radius = self.radius
        length = FACE_TO_FACE["globe"][self.dn] if self.standard else 0.12 + 2.2 * radius * 2
        throat, seat = 1.25 * radius + 0.006, max(room(self.dn) + 0.005, 2.0 * radius + 0.02)
        plate, half, n, slim = 0.009 + 0.08 * radius, throat * 1.4 + 0.006, t.n(throat, 16), 0.005 + 0.085 * radius
        collar, lid, bolts = lid_joint(self.plate, half, half, seat, plate, t.style)
        top, high = seat + plate, seat + plate + self.high * radius + 0.04
        if self.open:
            arm = (0.25 * throat, 0.16 * throat, high - top + 0.006)
            hood = [box(arm, (0, s * 0.82 * throat, (top + high) / 2)) for s in BOTH]
            hood.append(cylinder(throat, high - 0.012, high + 0.004, n))
        else:
            side = outline(throat, top - 0.002, 0.75 * throat, top + 0.25 * (high - top), 0.72 * throat, high - 0.012)
            hood = [turned([*side, (0.9 * throat, high - 0.01), (0.9 * throat, high + 0.004)], n)]
        body = self.body.solid(self.dn, t.style, length, "flanged", seat, throat)
        t.add("valve body", body, moved(collar, at(length / 2)))
        t = t.at(length / 2)
        t.add("valve bonnet", lid, *hood)
        t.extend([bolts])
        if self.open or self.hollow:
            bell = waves(top - 0.001, high - 0.011, 0.45 * throat, 0.62 * throat, 7)
            t.add("valve stem", turned(bell, max(12, n // 2)))
        above, tall = t.at(0, 0, high + 0.004), self.gland.high(slim)
        self.gland.build(above, slim)
        if self.screwed:
            self.screw.build(above, max(0.8 * throat, 3.5 * slim), tall + 0.04 + radius, slim)
        else:
            put_stem(above, -0.02, tall + 0.05, slim, self.stem)
            self.wheel.build(above, 0.04 + 1.25 * radius, tall + 0.008)
            pointer = cylinder(2.6 * slim, tall + 0.06, tall + 0.066, 14)
            above.add("position indicator", cylinder(0.8 * slim, tall + 0.05, tall + 0.1, 10), pointer)
        if self.hollow:
            t.add("valve disc", globe_plug(0.9 * PIPES[self.dn].bore, _PLUGS.index(self.plug), t.style, 0.1 * radius))
        return t.model(round(length, 6), kind="globe valve")


class Needle(Valve, name="needle valve/bar stock", sizes=sizes_between(most=40)):
    """A needle valve from bar stock: a hexagon, square, round or forged tee body, screwed bonnet, tee bar or knob."""

    form: str = among(("hexagon", "square", "round", "tee"), "form of its body")
    stem: str = among(STEMS, _ABOUT_STEM)
    make: str = weighted("what turns it", tee_bar=0.4, knob=0.45, wheel=0.15)
    bar: Handlever = nested(levers("tee"), "tee bar", when=lambda p: p.make == "tee bar")
    knob: Handwheel = nested(
        wheels("lobed", "lobed", "star", "disc", "cross", "spoked"), "knob", when=lambda p: p.make == "knob"
    )
    wheel: Handwheel = nested(wheels("spoked"), "handwheel", when=lambda p: p.make == "wheel")
    bracketed: bool = chance(0.3, "stands on a bracket")

    def build(self, t: Table) -> Model:
        radius, style, n = self.radius, t.style, 16
        length, big, bore = 0.03 + 3.2 * radius, 1.25 * radius + 0.003, bore_of(self.dn, style)
        x, top, mid = length / 2, 1.1 * big, (0.9 * length, 2 * big, 2.1 * big)
        if self.form == "hexagon":
            edge, holes = circle(1.15 * big, 6, phase=np.pi / 6), (circle(bore, n),) if bore else ()
            solids = [along("x", slab(edge, 0.0, length, holes))]
        elif self.form == "square":
            solids = [box(mid, (x, 0, 0.05 * big)), along("x", ring(bore, 1.05 * radius, 0.0, length, n))]
        elif self.form == "round":
            solids = [along("x", ring(bore, big, 0.0, length, n))]
            solids.append(box((1.6 * big, 1.9 * big, 1.6 * big), (x, 0, 0.3 * big)))
        else:
            solids = [hex_end(self.dn, low, low + 0.3 * length, style) for low in (0.0, 0.7 * length)]
            solids.append(along("x", cylinder(0.85 * big, 0.25 * length, 0.75 * length, n)))
            solids.append(along("z", cylinder(0.9 * big, -0.6 * big, 1.3 * big, n), x))
        t.add("valve body", *solids)
        t, slim, z = t.at(x), 0.0025 + 0.1 * radius, top + 1.7 * big
        t.add("valve bonnet", hexagon(1.5 * big, 0.9 * big, top + 0.6 * big), cylinder(0.5 * big, top, z, 12))
        t.add("gland", hexagon(1.15 * big, top + 0.75 * big, top + 1.15 * big))
        above = t.at(0, 0, z)
        put_stem(above, -0.6 * big, 0.03 + radius, slim, self.stem)
        if self.make == "tee bar":
            self.bar.build(above, 0.03 + 2.0 * radius, 0.01)
        elif self.make == "knob":
            self.knob.build(above, 0.011 + 0.8 * radius, 0.008)
        else:
            self.wheel.build(above, 0.02 + radius, 0.015)
        if self.bracketed:
            t.add("bracket", box((0.5 * length, 3.2 * big, 0.004), (0, 0, -1.0 * big - 0.002)), own=True)
        return t.model(round(length, 6), "welded", "needle valve")


class Cryogenic(Valve, name="globe valve/cryogenic", sizes=sizes_between(most=65)):
    """A cryogenic globe valve: a slender body, a very long bonnet pipe with a drip plate, a yoke far above."""

    ends: str = among(("butt", "socket"), "its ends, welded in")
    body: GlobeBody = nested(GlobeBody, "body")
    reach: float = between(0.2, 0.45, "height of its bonnet", "m")
    plated: bool = chance(0.6, "a drip plate round its bonnet")
    plate: float = between(2.0, 3.5, "radius of that plate / of the body's throat", when=lambda p: p.plated)
    gland: Packing = nested(Packing, "gland")
    screw: Any = screw_of(lambda p: 0.035 + 1.2 * PIPES[p.dn].radius)

    def build(self, t: Table) -> Model:
        radius = self.radius
        length, throat, slim = 0.07 + 4.2 * radius, 0.95 * radius + 0.004, 0.004 + 0.08 * radius
        n, seat, wide, slender, crown = t.n(throat, 16), 1.7 * radius + 0.02, 1.25 * throat, 0.7 * throat, 1.1 * throat
        reach = seat + self.reach
        tube = outline(wide, seat, wide, seat + 0.012, slender, seat + 0.03, slender, reach)
        hood = [turned([*tube, (crown, reach + 0.003), (crown, reach + 0.016)], n)]
        if self.plated:
            low = seat + 0.4 * (reach - seat)
            hood.append(cylinder(self.plate * throat, low, low + 0.003, n))
        body = self.body.solid(self.dn, t.style, length, self.ends, seat, throat)
        t.add("valve body", body, along("z", cylinder(wide, seat - 0.01, seat, n), length / 2))
        t = t.at(length / 2)
        t.add("valve bonnet", *hood)
        t.extend([bolts_on(circle(1.2 * throat, n), 6, seat - 0.008, seat + 0.012, 0.006)])
        above = t.at(0, 0, reach + 0.016)
        self.gland.build(above, slim)
        self.screw.build(above, 1.1 * throat, self.gland.high(slim) + 0.04 + 1.2 * radius, slim)
        return t.model(round(length, 6), "welded", "globe valve")


class CutOpen(Valve, name="globe valve/cut open", sizes=MID, weight=0.6):
    """A globe valve cut open for show: a quarter of body and bonnet away, plug, seat ring and stem in sight."""

    gap: float = between(0.25 * np.pi, 0.5 * np.pi, "angle that is cut away", "rad")
    plug: str = among(_PLUGS, "form of its plug")
    stem: str = among(STEMS, _ABOUT_STEM)
    gland: Packing = nested(Packing, "gland")
    wheel: Handwheel = nested(Handwheel, "handwheel")

    def build(self, t: Table) -> Model:
        radius, bore, rim, length = self.radius, t.pipe.bore, t.flange.outer / 2, FACE_TO_FACE["globe"][self.dn]
        big, (neck, back) = 1.6 * radius + 0.008, neck_of(self.dn)
        n, wall, end = max(6, t.style.round(big) * 3 // 4), 0.86 * big, length - back
        side = outline(rim, 0, rim, back, neck, back, big, 0.3 * length, big, 0.7 * length, neck, end)
        side += outline(rim, end, rim, length, bore, length, bore, 0.65 * length, wall, 0.6 * length)
        side += outline(wall, 0.4 * length, bore, 0.35 * length, bore, 0)
        # About x angles go from +y over +z: the gap opens towards -y and up.
        start, stop = 0.8 * np.pi + 0.5 * self.gap, 2.8 * np.pi - 0.5 * self.gap
        t.add("valve body", about_x(part_turned(np.array(side), start, stop, n)))
        seat, slim, t = max(room(self.dn), 1.9 * radius), 0.005 + 0.08 * radius, t.at(length / 2)
        high, inner, outer, lip, hole = seat + 0.06 + radius, 0.5 * big, 0.8 * big, 1.3 * big, 0.28 * big
        hood = outline(inner, big * 0.7, outer, big * 0.7, outer, seat, lip, seat, lip, seat + 0.02, inner, seat + 0.05)
        hood += outline(inner, high, hole, high, hole, seat, inner, seat)
        t.add("valve bonnet", part_turned(np.array(hood), -0.3 * np.pi, 1.3 * np.pi, n))
        t.add("valve disc", globe_plug(0.9 * bore, _PLUGS.index(self.plug), t.style, 0.05 * radius))
        t.add("valve body", ring(0.6 * bore, 1.0 * bore, -0.25 * bore, 0.0, n), of="trim")
        put_stem(t, 0.3 * bore, high + 0.06 + radius, slim, self.stem)
        self.gland.build(t.at(0, 0, high), slim)
        self.wheel.build(t, 0.04 + 1.2 * radius, high + 0.03 + 0.6 * radius)
        return t.model(length, kind="globe valve")


# --- the same at random ---


GLOBES = families_of(Bellows, Needle, Cryogenic, CutOpen)
