"""Vessels under pressure and process vessels: reactors, mixers, bullets, spheres, receivers."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, one_of
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.vessel import Tank, apart
from cadplants.families.vessels.vessel_fittings import (
    MANWAYS,
    Drum,
    Manway,
    head,
    head_height,
    lug,
    mouth,
    sides,
    wrapped,
)
from cadplants.families.vessels.vesselbuild import branch, put_vessel
from cadplants.families.vessels.vesselfeet import FEET, SADDLES, Feet, Saddle, bar, foot_plate, ladder
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import moved
from cadplants.solids.polygon import section_channel
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PRESSURE_VESSELS"]

_DISHED = "torispherical"
_SLENDER = "height of the shell / its radius"


class _Agitator(Params):
    """An agitator drive on a flange: lantern, gear unit, flanged motor with its fan cover (IEC 60072)."""

    posts: int = among((2, 3, 4), "posts of the lantern")
    lying: bool = chance(0.35, "its motor lies")

    def build(self, t: Table, z: float, size: float) -> None:
        """Puts it down on a height, for a flange of about a size [m]."""
        t, r, n = t.bundled("agitator").at(0, 0, z), 0.5 * size, t.n(0.5 * size)
        post = box((0.12 * size, 0.2 * size, 0.75 * size), (0.93 * r, 0, 0.45 * size))
        plates = [ring(0.8 * r, 1.4 * r, 0, 0.12 * size, n), ring(0.7 * r, 1.1 * r, 0.8 * size, 0.9 * size, n)]
        t.add("bracket", *plates, around(post, self.posts), own=True)
        t.add("shaft", cylinder(0.14 * size, -0.3 * size, 1.0 * size, 12), own=True)
        t, high = t.at(0, 0, 0.9 * size), (0.8 if self.lying else 0.6) * size
        gear = turned(outline(0.9 * r, 0, 0.9 * r, 0.5 * high, 0.75 * r, high), n)
        gear = box((1.5 * r, 1.4 * r, high), (0, 0, high / 2)) if self.lying else gear
        t.add("gearbox", gear, of="motor", own=True)
        t = t.at(0.75 * r, 0, high / 2).along("x") if self.lying else t.at(0, 0, high)
        fins = around(box((0.1 * r, 0.04 * r, 1.1 * size), (0, 0, 0.6 * size)), 16, 0.72 * r)
        body = outline(0.95 * r, 0, 0.95 * r, 0.06 * size, 0.72 * r, 0.06 * size, 0.72 * r, 1.2 * size)
        cover = outline(0.8 * r, 1.15 * size, 0.8 * r, 1.45 * size, 0.6 * r, 1.5 * size)
        t.add("motor", turned(body, n), fins, own=True)
        t.add("motor fan cover", turned(cover, n), own=True)
        case = box((0.3 * size, 0.35 * size, 0.35 * size), (0.85 * r + 0.08 * size, 0, 0.55 * size))
        t.add("terminal box", case, own=True)


class Reactor(Tank, name="tank/stirred reactor", weight=1.2):
    """A stirred reactor (DIN 28136): a jacket of half-pipe coils or a smooth or dimpled one, agitator, many nozzles."""

    radius: float = between(0.35, 0.95, "of the shell", "m")
    slender: float = between(1.1, 2.4, _SLENDER)
    jacket: str = among(("coils", "smooth", "dimpled"), "how its jacket is built")
    coils: int = whole(4, 7, "turns of the jacket's pipe", when=lambda p: p.jacket == "coils")
    drive: float = between(0.22, 0.32, "size of the agitator for a radius of 0.8 m", "m")
    agitator: _Agitator = nested(_Agitator, "agitator")
    count: int = whole(2, 4, "nozzles on top")
    nozzles: tuple[int, ...] = several(
        one_of(25, 40, 50), lambda p: p.count, "nominal sizes of the nozzles on top", "mm"
    )
    manway: Manway = nested(MANWAYS["swing"], "manway on top", when=lambda p: p.radius > 0.55)
    feet: str = among(("pipe", "bracket", "beam"), "what it stands on")
    stand: Feet = nested(
        lambda _, p: FEET[p.feet],
        "what it stands on",
        fixed=lambda p: {"clear": head_height(_DISHED, p.radius) + 0.4 + 0.3 * p.radius},
    )

    def build(self, t: Table) -> Model:
        r, n, deep = self.radius, sides(t.style, self.radius), head_height(_DISHED, self.radius)
        low, height = deep + 0.4 + 0.3 * r, r * self.slender
        drum, top = Drum(r, low, low + height, n), low + 0.75 * height
        put_vessel(t, drum, _DISHED, _DISHED)
        self._jacket(t, low, top, n)
        for z, a in ((low + 0.1, 1.05), (top - 0.08, 3.5)):
            t.moved(drum.side(a, z)).extend(mouth("plain", 25, 0.16, t.style, r, drum.dip))
        apex, size = drum.high + deep, self.drive * (0.6 + 0.5 * r)
        pad = cylinder(0.75 * size, apex - 0.05 * r - 0.02, apex + 0.05, t.n(size))
        apart(t, "nozzle", pad, of="flange")
        self.agitator.build(t, apex + 0.05, size)
        crown = [
            at(0.62 * r * np.cos(a), 0.62 * r * np.sin(a), apex - 0.12 * r) for a in 0.4 + np.arange(6) * np.pi / 3
        ]
        ports: list[Port] = []
        for k, dn in enumerate(self.nozzles):
            port = branch(t, "plain", dn, crown[k], 0.0, 0.15 * r, 0.06)
            ports += port if k < 2 else []
        if r > 0.55:
            t.moved(crown[5]).extend(self.manway.parts(t.style, min(0.2, 0.27 * r - 0.045), 0.0, 0.2 * r))
        t.at(0, 0, low - deep).along("-z").extend(mouth("plain", 50, 0.16, t.style, 0.0, 0.02))
        t.extend(self.stand.parts(Drum(1.07 * r if self.feet == "bracket" else r, low, drum.high, n), t.style))
        return t.model(kind="stirred reactor", ports=ports)

    def _jacket(self, t: Table, low: float, top: float, n: int) -> None:
        """The jacket between two heights [m]."""
        r, r2 = self.radius, 1.07 * self.radius
        if self.jacket == "coils":
            coil = torus(r, 0.03 + 0.015 * r, n, 6)
            t.add("shell", *(moved(coil, at(0, 0, z)) for z in np.linspace(low + 0.06, top, self.coils)), of="trim")
            return
        t.add("shell", turned(outline(r, low - 0.01, r2, low + 0.05, r2, top, r, top + 0.06), n), of="trim")
        if self.jacket == "dimpled":
            dot, zs = along("x", cylinder(0.02, -0.02, 0.008, 8), r2), np.linspace(low + 0.12, top - 0.06, 4)
            dots = [moved(dot, spun("z", float(a)) @ at(0, 0, z)) for a in np.arange(12) * np.pi / 6 for z in zs]
            t.add("shell", *dots, of="trim")


class Mixer(Tank, name="tank/open mixer", weight=0.7):
    """An open mixing tank: a flat or dished bottom, a bridge of two channels, an agitator with its impeller."""

    radius: float = between(0.4, 1.1, "of the shell", "m")
    slender: float = between(1.2, 2.2, _SLENDER)
    lower: str = among((_DISHED, "conical", "flat"), "lower head")
    agitator: _Agitator = nested(_Agitator, "agitator")
    blades: int = whole(2, 4, "blades of the impeller")
    feet: str = among(("pipe", "angle"), "legs")
    legs: Feet = nested(
        lambda _, p: FEET[p.feet],
        "legs",
        fixed=lambda p: {"clear": max(0.35 + 0.35 * p.radius, head_height(p.lower, p.radius) + 0.2)},
    )

    def build(self, t: Table) -> Model:
        r, n, height = self.radius, sides(t.style, self.radius), self.radius * self.slender
        low = max(0.35 + 0.35 * r, head_height(self.lower, r) + 0.2)
        drum, lying = Drum(r, 0.0, height, n), Drum(r, low, 0.35 + 0.35 * r + height, n)
        up, size, z = t.at(0, 0, low), 0.16 + 0.1 * r, height + 0.02
        up.add("shell", ring(0.985 * r, r, 0.0, height, n), moved(torus(r + 0.004, 0.02, n, 8), at(0, 0, height)))
        up.along("-z").add("dished head", head(self.lower, r, t.style, n))
        section = section_channel(0.12, 0.06, 0.007, 0.009)
        for s in BOTH:
            ends = (-r - 0.05, s * 0.6 * size, z + 0.06), (r + 0.05, s * 0.6 * size, z + 0.06)
            up.add("beam", bar(*ends, section, (0.0, float(s), 0.0)))
        up.add("plate", box((1.9 * size, 1.6 * size, 0.015), (0, 0, z + 0.1275)))
        self.agitator.build(up, z + 0.135, size)
        up, deep = up.bundled("agitator"), 0.25 * height
        up.add("shaft", cylinder(0.02 + 0.01 * r, deep, z + 0.1, 10), own=True)
        blade = moved(box((0.45 * r, 0.12 * r, 0.012), (0.22 * r, 0, 0)), spun("x", 0.6))
        up.at(0, 0, deep + 0.05 * r).add("impeller", around(blade, self.blades), own=True)
        ports = branch(t, "plain", 40, lying.side(0.9, low + 0.12), r, drum.dip)
        t.extend(self.legs.parts(lying, t.style))
        return t.model(kind="mixing tank", ports=ports if low > 0.5 else ())


class Bullet(Tank, name="tank/bullet", weight=0.7):
    """A bullet for liquefied gas: hemispherical ends, saddles on piers, a platform beside its back, a ladder."""

    radius: float = between(0.5, 0.95, "of the shell", "m")
    slender: float = between(3.0, 4.4, "length of the shell / its radius")
    clear: float = between(0.5, 0.9, "from the floor to the shell", "m")
    saddles: tuple[Saddle, ...] = several(made(SADDLES["ribbed"]), 2, "saddles")
    nozzles: tuple[int, ...] = several(one_of(40, 50), 3, "nominal sizes of the nozzles on top", "mm")

    def build(self, t: Table) -> Model:
        r, length = self.radius, self.slender * self.radius
        axis, pier = r + self.clear, self.clear - 0.15
        drum, lay = Drum(r, 0.0, length, sides(t.style, r)), at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
        put_vessel(t.moved(lay), drum, "hemispherical", "hemispherical")
        for x, saddle in zip((-0.3 * length, 0.3 * length), self.saddles, strict=True):
            t.at(x, 0, pier).extend(saddle.parts(r, axis - pier, t.style))
            t.add("foundation", box((0.35, 2.3 * r, pier), (x, 0, pier / 2)))
        ports: list[Port] = []
        for k, (z, dn) in enumerate(zip((0.25, 0.5, 0.75), self.nozzles, strict=True)):
            port = branch(t, "plain", dn, lay @ drum.side(np.pi, z * length), r, drum.dip, 0.06)
            ports += port[: 1 - k % 2]
        wide, high, side = 0.8, axis + r + 0.02, r + 0.45
        edge = side + wide / 2
        t.add("grating", box((0.9 * length, wide, 0.03), (0, side, high)))
        for x in (-0.4 * length, 0.4 * length):
            for y in (side - wide / 2 + 0.05, edge - 0.05):
                t.add("column", box((0.08, 0.08, high - 0.015), (x, y, (high - 0.015) / 2)))
        rails = [rod((-0.45 * length, edge, high + z), (0.45 * length, edge, high + z), 0.02, 6) for z in (0.55, 1.1)]
        posts = np.linspace(-0.45, 0.45, 4) * length
        t.add("railing", *rails, *(rod((x, edge, high), (x, edge, high + 1.1), 0.02, 6) for x in posts))
        up = t.at(-0.45 * length - 0.02, side).spun("z", np.pi)
        up.add("ladder", ladder(0.0, 0.0, high + 1.0, t.style, False, 0.01))
        return t.model(kind="gas tank", ports=ports)


class Sphere(Tank, name="tank/pressure sphere", weight=0.7):
    """A pressure sphere (Horton): petals' seams, columns tangent at the equator, crossed tie rods, a manway on top."""

    radius: float = between(0.7, 1.7, "of the sphere", "m")
    height: float = between(1.25, 1.5, "of its middle, but for 0.2 m / its radius")
    columns: int = among((4, 6, 8), "columns")
    seamed: bool = chance(0.5, "a seam round its middle")
    manway: Manway = nested(MANWAYS["hinged"], "manway")

    def build(self, t: Table) -> Model:
        r, n, z = self.radius, t.n(self.radius, 16), self.radius * self.height + 0.2
        leg, flat = 0.06 * r + 0.02, r * np.cos(np.pi / n)
        middle = t.at(0, 0, z)
        middle.add("shell", ball(r, n))
        if self.seamed:
            middle.add("shell", torus(flat, 0.02, n, 6))
        shaft, cap = cylinder(leg, 0.015, z + 0.15 * r, t.n(leg)), cylinder(1.1 * leg, z + 0.14 * r, z + 0.16 * r, 12)
        angles = 2 * np.pi * np.arange(self.columns + 1) / self.columns
        for a, b in zip(angles[:-1], angles[1:], strict=True):
            apart(t.spun("z", a).at(flat), "tank leg", shaft, cap, of="tank")
            t.spun("z", a).add("base plate", foot_plate(r, 0, 3.2 * leg, 0.015))
            for s, e in ((a, b), (b, a)):
                ends = (r * np.cos(s), r * np.sin(s), 0.12 * z), (r * np.cos(e), r * np.sin(e), 0.75 * z)
                t.add("brace", rod(*ends, 0.012 + 0.006 * r, 6))
        t.at(0, 0, z - r).along("-z").extend(mouth("plain", 80, 0.2, t.style, 0.0, 0.05 * r))
        ports = branch(t, "plain", 80, at(0, 0, z + r), 0.0, 0.05 * r, 0.1)
        tilt = max(0.41, float(np.arcsin(0.45 / r)))
        tilted = middle.spun("y", tilt).at(0, 0, r)
        tilted.extend(self.manway.parts(t.style, min(0.22, 0.2 * r), 0.0, 0.1 * r))
        return t.model(kind="pressure sphere", ports=ports)


class _Socket(Params):
    """A threaded socket on the shell."""

    height: float = between(0.2, 0.9, "over the shell's lower rim / height of the shell")
    size: int = among((20, 25, 32, 40), "nominal size", "mm")


class Receiver(Tank, name="tank/air receiver"):
    """A compressed-air receiver (EN 286-1): weld bands, a ring foot or legs, handhole, sockets, a name plate."""

    radius: float = between(0.18, 0.5, "of the shell", "m")
    slender: float = between(2.2, 4.5, _SLENDER)
    ringed: bool = chance(0.5, "a ring under it rather than legs")
    feet: str = among(("tripod", "angle"), "legs", when=lambda p: not p.ringed, otherwise="")
    legs: Feet = nested(
        lambda _, p: FEET[p.feet],
        "legs",
        fixed=lambda p: {"clear": head_height(_DISHED, p.radius) + 0.15},
        when=lambda p: not p.ringed,
    )
    handhole: Manway = nested(MANWAYS["oval"], "handhole")
    count: int = whole(3, 5, "sockets on the side")
    sockets: tuple[_Socket, ...] = several(made(_Socket), lambda p: p.count, "sockets on the side")

    def build(self, t: Table) -> Model:
        r, n, height = self.radius, sides(t.style, self.radius), self.radius * self.slender
        low = head_height(_DISHED, r) + 0.15
        drum = Drum(r, low, low + height, n)
        dip = drum.dip
        put_vessel(t, drum, _DISHED, _DISHED)
        seams = (low, low + 0.5 * height, drum.high)
        t.add("shell", *(ring(r - 0.004, r + 0.003, z - 0.006, z + 0.006, n) for z in seams))
        if self.ringed:
            apart(t, "skirt", ring(0.8 * r, 0.83 * r, 0.0, low - 0.3 * r + 0.05, n))
        else:
            t.extend(self.legs.parts(drum, t.style))
        hole = self.handhole.parts(t.style, min(0.11, 0.45 * r), r, dip)
        t.moved(drum.side(1.35, low + 0.3 * height)).extend(hole)
        for k, one in enumerate(self.sockets):
            pose = drum.side(4.2 + 0.6 * k, low + height * one.height)
            t.moved(pose).extend(mouth("half", one.size, 0.05, t.style, r, dip))
        plate = wrapped(r - dip, 3.6, 0.3 / r * 0.3, low + 0.62 * height, low + 0.7 * height, dip + 0.004, t.style)
        t.add("sign", plate, of="trim")
        t.at(0, 0, drum.high + low - 0.15).extend(mouth("half", 32, 0.05, t.style, 0.0, 0.01))
        return t.model(kind="air receiver")


class Cryogenic(Tank, name="tank/cryogenic", weight=0.7):
    """A vacuum-insulated tank for liquid gas (EN ISO 21009): a slim jacket on three broad legs, pipes below."""

    radius: float = between(0.5, 0.95, "of the jacket", "m")
    slender: float = between(3.0, 5.0, "height of the jacket's shell / its radius")
    clear: float = between(0.5, 0.8, "from the floor to the jacket", "m")

    def build(self, t: Table) -> Model:
        r, deep = self.radius, head_height(_DISHED, self.radius)
        low, wide, x = deep + self.clear, 0.55 * r, 0.55 * r
        drum = Drum(r, low, low + r * self.slender, sides(t.style, r))
        put_vessel(t, drum, _DISHED, _DISHED)
        leg = wrapped(0.97 * r, -wide / r / 2, wide / r, 0.012, low + 0.2 * r, 0.03 * r + drum.dip, t.style)
        for k in range(3):
            under = t.spun("z", 2.0944 * k + 0.5)
            apart(under, "tank leg", leg, of="tank")
            under.add("base plate", box((0.25, wide, 0.012), (r, 0, 0.006)))
        for k in range(4):
            path = [(x, 0, self.clear + 0.3 * r), (x, 0, 0.45), (1.25 * r, 0, 0.45), (1.25 * r, 0, 0.6 + 0.1 * k)]
            t.at(0, (k - 1.5) * 0.22 * r).add("pipe", rope(path, 0.017, 8))
        apart(t, "manway", cylinder(0.16 * r, drum.high + 0.8 * deep, drum.high + deep + 0.05, 16))
        for k in range(2):
            pose = drum.side(np.pi * k + 0.3, drum.high - 0.25)
            t.moved(pose).extend(lug("pad", 0.16, t.style, r, drum.dip))
        return t.model(kind="cryogenic tank")


PRESSURE_VESSELS = families_of(Reactor, Mixer, Bullet, Sphere, Receiver, Cryogenic)
