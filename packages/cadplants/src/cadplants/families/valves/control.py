"""Control valves with cage trim, of heating plants, and angle valves with pistons."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import INDICATORS, STEMS, put_indicator, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, wheels
from cadplants.families.valves.actuation_stroke import STROKES, Yoke, linear_of
from cadplants.families.valves.base import (
    HOLLOW,
    lying,
)
from cadplants.families.valves.body import Packing, ended, lid_joint, neck_of, room
from cadplants.families.valves.globe import GlobeBody, globe_plug
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import Valve, disc_flange
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, sizes_between
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import AXES, along, ball, cylinder, hexagon, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["CONTROLS"]

_ENDS = "how it is joined to the pipe"
_JOINT = "outline of the bonnet's joint"


class _Control(Valve):
    """A control valve in a line."""

    def done(self, t: Table, length: float, ends: str, kind: str = "control valve") -> Model:
        """What was put down, as a valve in a line."""
        return t.model(round(length, 6), "flanged" if ends == "flanged" else "welded", kind)


class _Neck(Params):
    """An extended bonnet: plain for cold service, finned for hot, or ringed."""

    form: str = among(("plain", "finned", "ringed"), "how it is made")
    count: int = whole(4, 8, "fins", when=lambda p: p.form != "plain")
    wide: float = between(0.85, 1.05, "radius of the fins / of the throat", when=lambda p: p.form != "plain")

    def solids(self, throat: float, low: float, high: float, n: int) -> list[Solid]:
        """The bonnet about z between two heights [m]."""
        slim, tall = 0.6 * throat, high - low
        spots = np.linspace(low + 0.08 * tall, 0.88 * high + 0.12 * low, self.count)
        fins = [ring(0.9 * slim, throat * self.wide, z, z + 0.35 * tall / self.count, n) for z in spots]
        return [cylinder(slim, low - 0.002, high, n), *fins]


class Cage(_Control, name="control valve/cage", weight=2):
    """A cage-guided control valve: heavy body, studded bonnet plain, finned or extended, any actuator (IEC 60534)."""

    hollow: bool = styled(True, HOLLOW)
    ends: str = among(("flanged", "flanged", "flanged", "butt"), _ENDS)
    long: float = among((1.0, 1.1), "length / that of a globe valve")
    throat: float = between(1.25, 1.5, "radius of the neck / of the pipe")
    joint: str = among(("round", "round", "octagon"), _JOINT)
    high: float = among((0.6, 0.8, 2.5, 4.0), "height of the bonnet / radius of the pipe")
    neck: _Neck = nested(_Neck, "bonnet")
    body: GlobeBody = nested(GlobeBody, "body")
    gland: Packing = nested(Packing, "gland of the stem")
    actuator: Any = linear_of()
    lift: float = between(0, 0.7, "of the plug / radius of the bore", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        r, length, throat = t.pipe.radius, FACE_TO_FACE["globe"][t.dn] * self.long, self.throat * t.pipe.radius + 0.008
        seat, plate, half = max(room(t.dn) * 0.9, 1.8 * r + 0.02), 0.012 + 0.12 * r, throat * 1.35 + 0.01
        collar, lid, bolts = lid_joint(self.joint, half, half, seat, plate, t.style)
        n, slim, top, up = t.n(throat, 16), 0.006 + 0.08 * r, seat + plate, t.at(length / 2)
        high = top + self.high * r + 0.015
        run = self.body.solid(t.dn, t.style, length, self.ends, seat, throat)
        t.add("valve body", run, moved(collar, at(length / 2)))
        crown = cylinder(2.8 * slim, high - 0.004, high + 0.02, n)
        up.add("valve bonnet", lid, *self.neck.solids(throat, top, high, n), crown)
        up.extend([bolts])
        self.gland.build(up.at(0, 0, high + 0.02), slim)
        self.actuator.build(up.at(0, 0, high))
        if self.hollow:
            bore = t.pipe.bore
            up.add("valve body", ring(0.95 * bore, 1.1 * bore, 0.0, 1.4 * bore, n), of="trim")
            up.add("valve disc", globe_plug(0.9 * bore, 2, t.style, self.lift * bore))
            up.add("valve stem", cylinder(slim, 0.5 * bore, high, 10))
        return self.done(t, length, self.ends)


class Angle(Valve, name="control valve/angle", place="head", sizes=sizes_between(15, 200)):
    """An angle control valve: inlet from below, outlet to the side, bonnet with any linear actuator above."""

    belly: float = between(1.3, 1.6, "radius of the body / of the pipe")
    joint: str = among(("round", "square", "octagon"), _JOINT)
    tapered: bool = chance(0.5, "the body tapers, rather than being a ball")
    high: float = between(0.5, 2.5, "height of the bonnet / radius of the pipe")
    neck: _Neck = nested(_Neck, "bonnet")
    actuator: Any = linear_of()

    def build(self, t: Table) -> Model:
        r, size, big = t.pipe.radius, t.flange.outer, self.belly * t.pipe.radius + 0.008
        n, axis, throat, plate = t.n(big, 16), 0.55 * size + 0.05, 1.2 * r + 0.006, 0.01 + 0.1 * r
        seat, half = axis + max(0.52 * size, 1.6 * r), 1.4 * throat + 0.008
        collar, lid, bolts = lid_joint(self.joint, half, half, seat, plate, t.style)
        flange = disc_flange(t.dn, t.style, axis)
        if self.tapered:
            marks = ((0.9 * r, -1.3 * big), (big, -0.7 * big), (big, 0.9 * big), (throat, 1.2 * big))
            middle = [turned([*((a, axis + z) for a, z in marks), (throat, seat)], n)]
        else:
            middle = [moved(ball(big, n), at(0, 0, axis)), cylinder(throat, axis, seat, n)]
        outlet = moved(flange, at(0, 0, axis) @ AXES["x"] @ spun("z", np.pi) @ at(0, 0, -axis))
        t.add("valve body", flange, *middle, collar, outlet)
        top = seat + plate
        high = top + self.high * r + 0.01
        t.add("valve bonnet", lid, *self.neck.solids(throat, top, high, n))
        t.extend([bolts])
        self.actuator.build(t.at(0, 0, high))
        return lying(t, "control valve")


class AngleSeat(_Control, name="angle seat valve/handwheel", sizes=sizes_between(15, 65)):
    """An angle-seat valve that is turned by hand: an oblique bonnet that carries a wheel."""

    ends: str = among(("hex", "octagon", "butt", "flanged"), _ENDS)
    long: float = between(0.95, 1.15, "length / what is usual")
    tilt: float = between(0.55, 0.85, "of the bonnet", "rad")
    way: float = among((1.0, 1.0, -1.0), "which way the bonnet leans: 1 downstream, -1 upstream")
    nut: bool = chance(0.6, "the bonnet is held by a nut")
    stem: str = among(STEMS, "how the stem is made")
    wheel: Handwheel = nested(wheels("spoked", "lobed", "disc", "star"), "handwheel")

    def build(self, t: Table) -> Model:
        r, flanged, tilt = t.pipe.radius, self.ends == "flanged", self.tilt * self.way
        length = (FACE_TO_FACE["globe"][t.dn] if flanged else 0.045 + 4.2 * r) * self.long
        neck, back = neck_of(t.dn) if flanged else (1.1 * r, 0.2 * length)
        end, wide = back + 0.1 * length, 1.2 * r + 0.002
        barrel = outline(neck, back, wide, end, wide, length - end, neck, length - back)
        pose = at(0.5 * length - 0.15 * length * self.way) @ spun("y", tilt)
        n, throat = t.n(1.5 * r, 16), 1.1 * r + 0.003
        reach = max(2.2 * r, 0.75 * t.flange.outer) if flanged else 2.1 * r + 0.012
        edge, low = 1.15 * throat, reach + 0.004
        arm = turned(outline(throat, 0.0, throat, reach, edge, reach, edge, low), n)
        t.add("valve body", ended(t.dn, t.style, length, barrel, self.ends), moved(arm, pose))
        up, top, slim = t.moved(pose), reach + 0.01 + 0.45 * r, 0.004 + 0.09 * r
        nut = cylinder(1.2 * throat, low, reach + 0.01 + 0.2 * r, n)
        if self.nut:
            nut = hexagon(2.3 * throat, low, low + 0.45 * r)
        z = top + 0.5 * r
        up.add("valve bonnet", nut, turned(outline(0.7 * throat, top - 0.012, 0.5 * throat, z), n))
        put_stem(up, reach, z + 0.05 + 0.5 * r, slim, self.stem)
        self.wheel.build(up, 0.025 + 1.2 * r, z + 0.01 + 0.3 * r)
        if t.style.hollow:
            up.add("valve disc", globe_plug(0.85 * t.pipe.bore, 0, t.style, 0.2 * r))
        return self.done(t, length, self.ends, "globe valve")


class Heating(_Control, name="control valve/heating", sizes=sizes_between(15, 100)):
    """A two-way or mixing valve of heating plants: compact iron or brass body, a small linear motor on a clamp yoke."""

    ends: str = among(("flanged", "hex", "octagon"), _ENDS, when=lambda p: p.dn <= 50, otherwise="flanged")
    body: GlobeBody = nested(GlobeBody, "body")
    mixing: bool = chance(0.5, "a third way below")
    yoke: Yoke = nested(Yoke, "yoke")
    motor: Any = nested(STROKES["motor"], "what lifts the stem")
    shown: bool = chance(0.4, "shows the position aside")
    indicator: str = among(INDICATORS[:3], "what shows the position", when=lambda p: p.shown)

    def build(self, t: Table) -> Model:
        r, flanged, throat = t.pipe.radius, self.ends == "flanged", 0.9 * t.pipe.radius + 0.008
        length = FACE_TO_FACE["globe"][t.dn] * 0.9 if flanged else 0.05 + 3.4 * r
        seat = max(room(t.dn) * 0.7, 1.8 * r + 0.012) if flanged else 1.9 * r + 0.01
        x, reach, n, half = length / 2, 0.5 * length, t.n(throat, 16), 0.018 + 0.35 * r
        solids = [self.body.solid(t.dn, t.style, length, self.ends, seat, throat)]
        if self.mixing and flanged:
            solids.append(moved(disc_flange(t.dn, t.style, reach - 0.6 * r), at(x, 0, -reach)))
        elif self.mixing:
            solids.append(moved(hex_end(t.dn, 0.0, 0.3 * length, t.style), at(x, 0, -0.9 * r) @ spun("y", np.pi / 2)))
        t.add("valve body", *solids)
        up = t.at(x, 0, seat)
        up.add("valve bonnet", cylinder(1.15 * throat, -0.003, 0.012, n), hexagon(1.4 * throat, 0.012, 0.03))
        up, tall = up.at(0, 0, 0.03), 0.05 + 0.6 * r
        self.yoke.build(up.bundled("actuator"), half, tall)
        put_stem(up, -0.01, tall, 0.004 + 0.03 * r)
        self.motor.build(up, r, tall)
        if self.shown:
            arm = along("y", cylinder(0.004, -half - 0.001, 0.0, 8), 0, 0, 0.5 * tall)
            up.add("bracket", arm, own=True)
            put_indicator(up.at(0, -half, 0.5 * tall).spun("x", np.pi / 2), 0.015, self.indicator)
        return self.done(t, length, self.ends)


CONTROLS = families_of(Cage, Angle, Heating, AngleSeat)
