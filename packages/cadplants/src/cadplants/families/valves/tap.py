"""Taps, cocks, vents and small safety valves at the end of a short branch, in a few pieces or melted into one mesh."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.melting import Melting, Piece, put_pieces
from cadplants.builder.params import Params, among, between, chance, given, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.asset_parts import Grip, Rim
from cadplants.families.valves.parts import bend
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES, sizes_between
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import along, around, ball, box, cylinder, hexagon, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["TAPS"]

_BODY = "valve body"


class _Small(Melting, place="tap", group="Valve assembly", label="valve", bundle=_BODY, sizes=(15, 20, 25)):
    """A small valve upright on an outlet."""

    melted: bool = chance(0.45, "all of it is one mesh")
    corners: int = among((6, 6, 8, 0), "sides of its wrench end; 0: round")

    def end(self, wide: float, low: float, high: float, n: int) -> Solid:
        """Its wrench end about z, this wide across, between two heights [m]."""
        return cylinder(wide, low, high, self.corners or n)


class _Handle(Params):
    """What turns a small stem: a wheel, a lever, a square for a key."""

    radius: float = given(0.01, "that it is scaled by", "m")
    form: str = among(("wheel", "lever", "lever", "key"), "what it is")
    stem: float = between(0.3, 1.6, "height of the stem / radius")
    rim: Rim = nested(Rim, "handwheel", when=of_form("wheel"))
    grip: Grip = nested(Grip, "lever", when=of_form("lever"))

    def pieces(self, n: int) -> list[Piece]:
        """Its pieces about z from 0 up, of so many sides."""
        r = self.radius
        if self.form == "wheel":
            z = self.stem * r + self.rim.below(r) + 0.004
            wheel = Piece("handwheel", self.rim.solids(r, z, n), Turning("handwheel"))
            return [Piece("valve stem", [cylinder(0.3 * r, -0.002, z + 0.2 * r, min(n, 8))]), wheel]
        z = 0.4 * self.stem * r + 0.002
        if self.form == "lever":
            lever = Piece("lever", self.grip.solids(r, z, n), Turning("lever"))
            return [Piece("valve stem", [cylinder(0.35 * r, -0.002, z + 0.002, min(n, 8))]), lever]
        return [
            Piece(
                "valve stem", [cylinder(0.4 * r, -0.002, z, min(n, 8)), box((0.5 * r, 0.5 * r, r), (0, 0, z + 0.5 * r))]
            )
        ]


def _handle_of(about: str = "what turns it") -> _Handle:
    return nested(_Handle, about, fixed=lambda p: {"radius": PIPES[p.dn].radius})


def _moved(pieces: list[Piece], x: float, z: float, axis: str = "", lean: float = 0.0) -> list[Piece]:
    """Pieces about z put at a place: laid along an axis, then leaning about y [m, rad]."""
    pose = at(x, 0, z) @ spun("y", lean)
    found = []
    for piece in pieces:
        laid = [along(axis, one) if axis else one for one in piece.solids]
        turns = None
        if piece.turns is not None:
            ways = {"": (0.0, 0.0, 1.0), "y": (0.0, 1.0, 0.0), "-y": (0.0, -1.0, 0.0), "x": (1.0, 0.0, 0.0)}
            turns = Turning(piece.turns.kind, ways[axis]).placed(pose)
        found.append(Piece(piece.name, [moved(one, pose) for one in laid], turns))
    return found


def _tip(form: str, r: float, n: int) -> list[Solid]:
    """What a mouth about z, from 0 up, ends in: a thread, a barbed tail, a cap with a lug, a plug."""
    if form == "barbed":
        marks = outline(1.2, -0.2, 1.2, 0.8, 0.9, 0.8, 0.7, 2.2, 0.95, 2.2, 0.7, 3.2, 0.95, 3.2, 0.65, 4.4)
        return [turned([(a * r, z * r) for a, z in marks], n)]
    if form == "cap":
        lug = box((0.4 * r, 0.5 * r, 0.8 * r), (1.25 * r, 0, 0.9 * r))
        return [cylinder(1.1 * r, -0.2 * r, 0.5 * r, n), cylinder(1.4 * r, 0.4 * r, 1.6 * r, n), around(lug, 2)]
    if form == "plug":
        return [cylinder(1.15 * r, -0.2 * r, 0.7 * r, n), hexagon(1.4 * r, 0.6 * r, 1.3 * r)]
    if form == "thread":
        return [cylinder(1.25 * r, -0.2 * r, 0.3 * r, n), cylinder(1.05 * r, 0.2 * r, 1.3 * r, n)]
    return []


class HoseBib(_Small, name="bib tap/hose bib", place="end", sizes=sizes_between(15, 32), weight=1.5):
    """A hose bib on a pipe's end: a wrench end, a bonnet upright or aslant, a bent spout with a thread or tail."""

    reach: float = between(2.2, 5.0, "(from the pipe to the spout's bend - 10 mm) / radius of the pipe")
    body: float = between(1.1, 1.6, "radius of the body / of the pipe")
    round_: bool = chance(0.4, "the body is a ball")
    spout: float = between(0.7, 1.0, "radius of the spout / of the pipe")
    out: float = between(0.8, 2.2, "reach of the spout beyond its bend / radius of the pipe")
    drop: float = between(1.6, 4.0, "of the spout / radius of the pipe")
    slant: float = among((0.0, 0.0, 0.35, 0.7), "of its mouth, outward", "rad")
    tip: str = among(("none", "thread", "thread", "barbed", "cap"), "what the mouth ends in")
    lean: float = among((0.0, 0.0, 0.4, -0.4), "of the bonnet", "rad")
    high: float = between(0.6, 1.8, "height of the bonnet / radius of the pipe")
    handle: _Handle = _handle_of()

    def build(self, t: Table) -> Model:
        r, n = t.pipe.radius, self.n(t, t.pipe.radius)
        reach, b, mid = self.reach * r + 0.01, self.body * r, 0.6 * (self.reach * r + 0.01)
        shank = [self.end(1.35 * r, 0.0, 0.9 * r, n), cylinder(1.0 * r, 0.5 * r, reach, n)]
        chest = (
            ball(1.1 * b, n) if self.round_ else turned(outline(0.9 * b, -b, b, -0.4 * b, b, 0.6 * b, 0.8 * b, b), n)
        )
        down = np.array([np.sin(self.slant), 0.0, -np.cos(self.slant)])
        corner = np.array([reach + self.out * r, 0.0, 0.0])
        last = corner + (self.drop + 1.0) * r * down
        path = bend([(reach - 0.5 * r, 0, 0), tuple(corner), tuple(last)], 0.8 * min(self.out, 1.0) * r + 0.3 * r, 5)
        spout = rope(path, self.spout * r, n)
        mouth = at(*last) @ spun("y", np.pi - self.slant)
        tips = [moved(one, mouth) for one in _tip(self.tip, 0.95 * self.spout * r, n)]
        body = Piece(_BODY, [*(along("x", one) for one in shank), moved(chest, at(mid)), spout, *tips])
        top = b + self.high * r
        hood = [cylinder(0.75 * b, 0.5 * b, top, n), self.end(0.95 * b, b + 0.1 * r, b + 0.5 * self.high * r, n)]
        head = [Piece("valve bonnet", hood), *_moved(self.handle.pieces(n), 0.0, top)]
        put_pieces(t, [body, *_moved(head, mid, 0.0, "", self.lean)], self.melted)
        return t.model(kind="tap")


class DrainTip(_Small, name="drain valve/cap or tail", weight=1):
    """A drain valve on an outlet: a wrench end, a lever, wheel or square aside, its mouth capped or with a tail."""

    long: float = between(3.0, 6.0, "(length - 12 mm) / radius of the pipe")
    wide: float = between(1.15, 1.6, "radius of the body / of the pipe")
    form: str = among(("ball", "can", "cones"), "its body")
    tip: str = among(("none", "thread", "barbed", "barbed", "cap", "cap", "plug"), "what the mouth ends in")
    neck: float = between(0.3, 1.4, "reach of the neck / radius of the pipe")
    side: float = between(0, 6, "which way its handle looks", "rad")
    handle: _Handle = _handle_of()

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        n, long, b = self.n(t, r), self.long * r + 0.012, self.wide * r
        mid = 0.5 * long
        shape = outline(b, mid - 1.2 * b, b, mid + 1.2 * b)
        if self.form == "cones":
            shape = outline(0.8 * r, mid - 1.4 * b, b, mid - 0.4 * b, b, mid + 0.4 * b, 0.8 * r, mid + 1.4 * b)
        core = moved(ball(1.15 * b, n), at(0, 0, mid)) if self.form == "ball" else turned(shape, n)
        body: list[Solid] = [cylinder(0.9 * r, 0.0, long, n), self.end(1.4 * r, 0.0, 0.22 * long, n), core]
        body += [moved(one, at(0, 0, long)) for one in _tip(self.tip, 0.9 * r, n)]
        out = b + self.neck * r + 0.2 * r
        aside = [Piece("gland", [cylinder(0.6 * r, 0.5 * b, out, n), self.end(0.85 * r, out - 0.4 * r, out, n)])]
        aside += _moved(self.handle.pieces(n), 0.0, out)
        put_pieces(t.spun("z", self.side), [Piece(_BODY, body), *_moved(aside, 0.0, mid, "y")], self.melted)
        return t.model(kind="drain valve")


class PetCock(_Small, name="sampling valve/pet cock", weight=1):
    """A pet or sampling cock: a taper body, a spout bent down or aside, a tee, wing or lever on top."""

    core: float = between(0.006, 0.013, "radius of its shank", "m")
    tall: float = between(3.0, 6.0, "height of the body / radius of the shank")
    wide: float = between(1.3, 2.0, "radius of the body / of the shank")
    spout: float = between(0.5, 0.85, "radius of the spout / of the shank")
    reach: float = between(2.5, 7.0, "of the spout / radius of the shank")
    turn_down: float = between(-0.4, 1.5, "of the spout's end, down from level", "rad")
    lip: bool = chance(0.4, "a lip at the spout's end")
    grip: Grip = nested(Grip, "lever", fixed=lambda _: {"rise": 0.2})
    side: float = between(0, 6, "which way its spout looks", "rad")

    def build(self, t: Table) -> Model:
        r, top = self.core, (self.tall + 2.0) * self.core
        n, b = self.n(t, r), self.wide * r
        body: list[Solid] = [cylinder(r, 0.0, 2.2 * r, n), self.end(1.5 * r, 0.8 * r, 2.0 * r, n)]
        body.append(turned(outline(b, 1.9 * r, 0.8 * b, top), n))
        z, half = 2.0 * r + 0.5 * self.tall * r, 0.55 * self.reach * r
        corner = np.array([b + half, 0.0, z])
        last = corner + 0.9 * half * np.array([np.cos(self.turn_down), 0.0, -np.sin(self.turn_down)])
        path = bend([(0.3 * b, 0, z), tuple(corner), tuple(last)], 0.6 * half, 4)
        body.append(rope(path, self.spout * r, min(n, 12)))
        if self.lip:
            way = at(*last) @ spun("y", np.pi / 2 + self.turn_down)
            body.append(moved(cylinder(1.4 * self.spout * r, -0.6 * r, 0.01 * r, n), way))
        pieces = [Piece(_BODY, body), Piece("valve stem", [cylinder(0.45 * r, top - 0.002, top + 0.8 * r, 8)])]
        pieces.append(Piece("lever", self.grip.solids(0.6 * r, top + 0.4 * r, n), Turning("lever")))
        put_pieces(t.spun("z", self.side), pieces, self.melted)
        return t.model(kind="sampling valve")


class BottleVent(_Small, name="air vent/bottle", weight=1.25):
    """An automatic air vent: a bottle on a wrench end, a cap, maybe a vent at its side or a square below."""

    wide: float = between(0.014, 0.04, "radius of the bottle", "m")
    tall: float = between(1.4, 3.6, "height of the bottle / its radius")
    form: str = among(("bottle", "can", "cone", "stepped", "domed"), "its shape")
    stub: float = between(0.008, 0.03, "length of its nipple", "m")
    flange: bool = chance(0.35, "a collar with screws round it")
    cap: float = between(0.18, 0.4, "radius of the cap / of the bottle")
    aside: str = among(("none", "stub", "stub", "bent"), "what is at its side")
    side: float = between(0, 6, "which way that looks", "rad")
    keyed: bool = chance(0.3, "a square for a key on its nipple")

    def _shape(self, r: float, low: float, tall: float) -> list[tuple[float, float]]:
        high = low + tall
        if self.form == "can":
            return outline(r, low, r, high)
        if self.form == "cone":
            return outline(0.7 * r, low, r, low + 0.75 * tall, 0.85 * r, high)
        if self.form == "stepped":
            return outline(0.75 * r, low, 0.75 * r, low + 0.4 * tall, r, low + 0.4 * tall, r, high)
        if self.form == "domed":
            dome = outline(0.92 * r, high - 0.2 * r, 0.6 * r, high)
            return [*outline(0.5 * r, low, r, low + 0.3 * r, r, high - 0.6 * r), *dome]
        return outline(0.6 * r, low, r, low + 0.2 * tall, r, low + 0.65 * tall, 0.35 * r, high)

    def build(self, t: Table) -> Model:
        r, stub = self.wide, self.stub
        n, tall, pipe = self.n(t, self.wide), self.tall * self.wide, 0.009
        low = stub + 0.012
        body: list[Solid] = [cylinder(pipe, 0.0, low + 0.002, n), self.end(1.6 * pipe, stub, low + 0.001, n)]
        body.append(turned(self._shape(r, low, tall), n))
        if self.keyed:
            body.append(along("x", box((0.006, 0.006, 0.01), (0, 0, 0.0)), 1.0 * pipe, 0, 0.5 * stub))
        if self.flange:
            z = low + 0.5 * tall
            screw = cylinder(0.07 * r + 0.0008, z - 0.1 * r, z + 0.12 * r, 6)
            body += [cylinder(1.2 * r, z - 0.06 * r, z + 0.06 * r, n), around(screw, 6, 1.1 * r)]
        z = low + 0.8 * tall
        if self.aside == "stub":
            body.append(rod((0.1 * r, 0, z), (1.25 * r, 0, z), 0.16 * r, min(n, 8)))
        elif self.aside == "bent":
            path = bend([(0.1 * r, 0, z), (1.4 * r, 0, z), (1.4 * r, 0, z - 0.9 * r)], 0.3 * r, 3)
            body.append(rope(path, 0.13 * r, min(n, 8)))
        cap, top = self.cap * r, low + tall
        lid = turned(outline(cap, top - 0.05 * r, cap, top + 1.2 * cap, 0.7 * cap, top + 1.5 * cap), min(n, 12))
        put_pieces(t.spun("z", self.side), [Piece(_BODY, body), Piece("valve bonnet", [lid])], self.melted)
        return t.model(kind="air vent")


class SafetyLever(_Small, name="relief valve/screwed with lever", sizes=(15, 20, 25, 32, 40, 50), weight=1.25):
    """A screwed safety valve, angle pattern: a tall bonnet over the body, a lifting lever, ring or knob on its cap."""

    body: float = between(1.2, 1.7, "radius of the body / of the pipe")
    high: float = between(1.8, 3.2, "height of the body / radius of the pipe")
    out: float = between(1.4, 2.6, "(reach of the outlet - 2 mm) / radius of the pipe")
    wider: float = between(1.0, 1.45, "size of the outlet / of the inlet")
    tower: float = between(1.4, 4.0, "height of the bonnet / radius of the body")
    slim: float = between(0.55, 0.95, "radius of the bonnet's top / of the body")
    windows: bool = chance(0.25, "an open spring between two bars")
    form: str = among(("lever", "lever", "ring", "knob", "cap"), "what lifts it")
    tilt: float = between(-0.5, 0.7, "of the lever", "rad", when=of_form("lever"))
    side: float = between(0, 6, "which way its outlet looks", "rad")

    def build(self, t: Table) -> Model:
        r, b = t.pipe.radius, self.body * t.pipe.radius
        n, foot = self.n(t, b), 1.2 * r + 0.006
        seat, z = foot + self.high * r, foot + 0.45 * self.high * r
        inlet = [cylinder(0.95 * r, 0.0, foot, n), self.end(1.4 * r, 0.3 * foot, foot, n)]
        chest = turned(outline(0.85 * b, 0.9 * foot, b, foot + 0.3 * r, b, seat), n)
        far, wide = b + self.out * r + 0.002, self.wider * r
        branch = [cylinder(wide, 0.2 * b, far, n), self.end(1.35 * wide, far - 1.1 * r, far, n)]
        body = Piece(_BODY, [*inlet, chest, *(along("x", one, 0, 0, z) for one in branch)])
        top = seat + self.tower * b
        hood: list[Solid] = [self.end(1.1 * b, seat - 0.05 * r, seat + 0.3 * b, n)]
        if self.windows:
            bar = box((0.25 * b, 0.35 * b, top - seat), (0.6 * b, 0, (top + seat) / 2))
            hood += [around(bar, 2, 0.1 * b), cylinder(0.4 * b, seat, top, n), cylinder(0.8 * b, top - 0.3 * b, top, n)]
        else:
            hood.append(turned(outline(0.95 * b, seat, self.slim * b, top), n))
        pieces = [body, Piece("valve bonnet", hood), self._lift(0.75 * self.slim * b, top, n)]
        put_pieces(t.spun("z", self.side), pieces, self.melted)
        return t.model(kind="relief valve")

    def _lift(self, r: float, top: float, n: int) -> Piece:
        cap = cylinder(r, top - 0.002, top + 1.2 * r, n)
        if self.form == "knob":
            knob = outline(1.3 * r, top - 0.001, 1.4 * r, top + 0.5 * r, 1.3 * r, top + 1.6 * r)
            return Piece("handwheel", [turned(knob, n)])
        if self.form == "ring":
            ring = moved(torus(0.9 * r, 0.14 * r, 12, 6), at(0, 0, top + 2.0 * r) @ spun("x", np.pi / 2))
            return Piece("lever", [cap, ring])
        if self.form == "cap":
            return Piece("valve bonnet", [cap, hexagon(0.9 * r, top + 1.1 * r, top + 1.7 * r)])
        bar = merge([box((5.0 * r, 0.35 * r, 0.25 * r), (2.0 * r, 0, 0)), box((0.6 * r, 0.8 * r, 1.2 * r))])
        return Piece("lever", [cap, moved(bar, at(0, 0, top + 1.2 * r) @ spun("y", self.tilt))])


TAPS = families_of(HoseBib, DrainTip, PetCock, BottleVent, SafetyLever)
