"""Machines and ways of primitives that stay apart: each cone, disc, plate and bend is a piece of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made, number, one_of, yes
from cadplants.builder.params import Params, among, between, chance, each, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    FRAME,
    cone,
    disc,
    dish,
    lying,
    sleeve,
    torus_piece,
)
from cadplants.model.family import Family, Model, Port
from cadplants.model.standards import FLANGES, PIPES, smaller
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.primitives import box
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["PRIMITIVE_PIECES"]


def _each(t: Table, name: str, *solids: Solid) -> None:
    """Puts solids down, each as a part of its own in the bundle of its name."""
    t.bundled(name).add_each(name, solids, own=True)


def _sector(inner: float, outer: float, first: float, last: float, steps: int) -> Floats:
    """The outline of a piece of a ring between two angles ``(n, 2)`` [m]."""
    angles = np.linspace(first, last, steps + 1)
    out = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.concatenate([outer * out, inner * out[::-1]])


class _Mouth(Params):
    """A nozzle in pieces: a neck, a hub and a disc, some of them left out."""

    dn: int = given(0, "nominal size", "mm")
    thick: float = among(lambda p: (0.02, FLANGES[p.dn].thickness), "of the disc", "m")
    hub: str = among(("none", "short", "by the pipe"), "its hub")
    wide: str = among(("by the disc", "by the pipe"), "what the hub widens to", when=lambda p: p.hub != "none")

    def solids(self, high: float, style: ModelingStyle) -> list[Solid]:
        """About z from below 0 up to its face [m]."""
        pipe, rim, thick = PIPES[self.dn], FLANGES[self.dn].outer / 2, self.thick
        r = pipe.radius
        hub = min({"none": 0.0, "short": 0.05, "by the pipe": 1.2 * r}[self.hub], 0.6 * (high - thick))
        solids = [sleeve(pipe.bore, r, -0.5 * high, high - thick - hub, style)]
        if hub:
            wide = 0.5 * (r + rim) if self.wide == "by the disc" else 1.3 * r
            solids.append(cone(r, min(wide, 0.95 * rim), high - thick - hub, high - thick, style))
        return [*solids, sleeve(pipe.bore, rim, high - thick, high, style)]


def _mouth(dn: Callable[[Any], int], about: str) -> _Mouth:
    return nested(_Mouth, about, fixed=lambda p: {"dn": dn(p)})


class _Volute(Params):
    """The casing of a pump whose shaft is the y axis."""

    form: str = among(("two bends", "four quarters", "drum"), "what it is put together of")
    count: int = whole(1, 2, "discs on it")
    discs: tuple[float, ...] = several(
        number(0.1, 0.4), lambda p: p.count, "half the thickness of each / of the casing"
    )

    def solids(self, r: float, thick: float, style: ModelingStyle) -> list[Solid]:
        """Its solids about the origin [m]."""
        flat, turn, steps = spun("x", np.pi / 2), np.pi, 9
        if self.form == "four quarters":
            turn, steps = np.pi / 2, 6
        solids = [moved(disc(1.3 * r, -thick, thick, style), flat)]
        if self.form != "drum":
            path = [(r * float(np.cos(a)), 0.0, r * float(np.sin(a))) for a in np.linspace(0, turn, steps)]
            bend = torus_piece(path, thick, style.round(thick))
            solids = [bend, moved(bend, spun("x", np.pi))]
            if self.form == "four quarters":
                solids = [moved(bend, spun("y", k * np.pi / 2)) for k in range(4)]
        for share, low in zip((0.7, 0.8), self.discs, strict=False):
            solids.append(moved(disc(share * r, thick - low * thick, thick + low * thick, style), flat))
        return solids


class _Coupling(Params):
    """A disc on a shaft."""

    wide: float = between(1.8, 3.0, "radius / of the shaft")
    long: float = between(0.015, 0.04, "length", "m")


class _Frame(Params):
    """What a pump and its motor stand on: plates and blocks, at times on a foundation."""

    low: float = between(0.03, 0.08, "thickness of a plate", "m")
    one: bool = chance(0.7, "one plate under all, not one for each")
    single: bool = chance(0.3, "one block under the motor, not two")
    blocks: tuple[float, ...] = several(
        one_of(0.02, 0.03, 0.1),
        lambda p: 1 if p.single else 2,
        "length of each of these",
        "m",
    )
    founded: bool = chance(0.4, "a foundation")

    def build(self, t: Table, pump: tuple[float, float], motor: tuple[float, float, float], axis: float) -> None:
        """Puts it down.

        Args:
            t: with the frame on the floor.
            pump: radius and half the thickness of the casing [m].
            motor: radius of the motor, where it starts, its length [m].
            axis: height of the shaft [m].
        """
        (r, thick), (motor_radius, start, length), low = pump, motor, self.low
        wide, middle = 2.2 * max(r, motor_radius), 0.5 * (start + length)
        if self.one:
            solids = [box((wide, start + length + 2 * thick, low), (0, middle - 0.2 * thick, 0.5 * low))]
        else:
            solids = [box((wide, 2.4 * thick + 0.1, low), (0, 0, 0.5 * low))]
            solids.append(box((wide, length, low), (0, start + 0.5 * length, 0.5 * low)))
        high, stand = axis - r - 0.5 * thick, axis - 0.75 * motor_radius
        solids.append(box((1.6 * r, 1.2 * thick, high - low), (0, 0, 0.5 * (high + low))))
        for share, long in zip((0.5,) if self.single else (0.2, 0.8), self.blocks, strict=True):
            block = (1.6 * motor_radius, long, stand - low)
            solids.append(box(block, (0, start + share * length, 0.5 * (stand + low))))
        _each(t, "pump base", *solids)
        if self.founded:
            t.add("foundation", box((wide + 0.3, start + length + 2 * thick + 0.3, 0.2), (0, middle, -0.1)))


class PumpInPieces(Device, name="pump/in pieces", group="Pump unit", label="pump", weight=2.5, grain="fitting"):
    """An end suction pump along y on a frame of plates: casing, nozzles, shaft, couplings, motor, cover."""

    thick: float = between(1.0, 1.6, "(half the thickness of the casing - 10 mm) / radius of the discharge pipe")
    ring: float = between(1.4, 2.6, "radius of the casing's middle / half its thickness")
    lift: float = between(0.1, 0.3, "of the casing over the floor", "m")
    rise: float = between(0.06, 0.2, "of the discharge's face over the casing", "m")
    reach: float = between(0.06, 0.2, "of the suction's face before the casing", "m")
    volute: _Volute = nested(_Volute, "casing")
    suction: _Mouth = _mouth(lambda p: p.dn, "suction")
    side: float = among((-1.0, 0.0, 1.0), "where the discharge is: left, over the shaft, right")
    discharge: _Mouth = _mouth(lambda p: smaller(p.dn), "discharge")
    motor: float = between(0.5, 1.1, "radius of the motor / of the casing")
    length: float = between(1.4, 2.6, "length of the motor / radius of the casing")
    apart: float = between(0.12, 0.4, "from casing to motor", "m")
    shaft: float = between(0.12, 0.3, "radius of the shaft / of the motor")
    through: float = among((0.1, 1.05), "how far the shaft reaches into the motor / its length")
    count: int = whole(0, 3, "discs on the shaft")
    couplings: tuple[_Coupling, ...] = several(made(_Coupling), lambda p: p.count, "these")
    covered: bool = chance(0.6, "a cover over the fan")
    gap: float = among((0.0, 0.0, 0.01), "before the cover", "m", when=lambda p: p.covered, otherwise=0.0)
    cover: float = among((0.9, 1.0, 1.0), "radius of the cover / of the motor", when=lambda p: p.covered, otherwise=0.0)
    long: float = between(0.15, 0.35, "(length of the cover - 30 mm) / radius of the motor", when=lambda p: p.covered)
    wired: bool = chance(0.35, "a terminal box")
    frame: _Frame = nested(_Frame, "what it stands on")

    def build(self, t: Table) -> Model:
        style, out = t.style, self.discharge.dn
        thick = PIPES[out].radius * self.thick + 0.01
        r = thick * self.ring
        outer, back = r + thick, spun("x", -np.pi / 2)  # lays z along y
        axis, rise, reach, side = outer + self.lift, outer + self.rise, thick + self.reach, self.side * r
        level = t.at(0, 0, axis)
        _each(level, "pump casing", *self.volute.solids(r, thick, style))
        _each(level.spun("x", np.pi / 2), "pump casing", *self.suction.solids(reach, style))
        _each(level.at(side), "pump casing", *self.discharge.solids(rise, style))
        motor, length, start = self.motor * outer, outer * self.length, thick + self.apart
        rod, level_back = motor * self.shaft, level.moved(back)
        shaft = [disc(rod, 0.0, start + self.through * length, style)]
        places = np.linspace(thick + 0.04, start - 0.05, self.count)
        for y, one in zip(map(float, places), self.couplings, strict=True):
            shaft.append(disc(rod * one.wide, y, y + one.long, style))
        _each(level_back, "shaft", *shaft)
        _each(level_back, "motor", disc(motor, start, start + length, style))
        if self.covered:
            end = start + length + self.gap
            cover = disc(motor * self.cover, end, end + self.long * motor + 0.03, style)
            _each(level_back, "motor fan cover", cover)
        if self.wired:
            top = box((0.8 * motor, 0.4 * length, 0.4 * motor), (0, start + 0.5 * length, 1.1 * motor))
            _each(level, "terminal box", top)
        self.frame.build(t, (r, thick), (motor, start, length), axis)
        ports = (
            Port(looking((0, -reach, axis), (0, -1, 0)), self.dn),
            Port(looking((side, 0, axis + rise), (0, 0, 1)), out),
        )
        return t.model(kind="centrifugal pump", ports=ports)


class _Saddle(Params):
    """A saddle under a drum: a web, ribs, a foot and a curved pad, each a plate, some left out."""

    thick: float = among((0.015, 0.03), "of a plate", "m")
    deep: float = between(0.12, 0.35, "along the drum", "m")
    fitted: bool = chance(0.6, "its web fits the drum")
    ribbed: bool = chance(0.8, "it has ribs")
    count: int = whole(0, 3, "ribs", when=lambda p: p.ribbed)
    footed: bool = chance(0.7, "a plate at its foot")
    padded: bool = chance(0.5, "a pad under the drum")

    def build(self, t: Table, radius: float, axis: float) -> None:
        """Puts it down across x [m]."""
        thick, deep, wide, low = self.thick, self.deep, 1.9 * radius, axis - 0.6 * radius
        across = spun("z", np.pi / 2) @ spun("x", np.pi / 2)
        web = box((thick, wide, low), (0, 0, low / 2))
        if self.fitted:
            angles = np.linspace(np.radians(215), np.radians(325), 9)
            seat = np.column_stack([radius * np.cos(angles), axis + radius * np.sin(angles)])
            outline = np.concatenate([[[-0.95 * radius, 0.0], [0.95 * radius, 0.0]], seat[::-1]])
            web = moved(extrude(outline, -thick / 2, thick / 2), across)
        solids = [web]
        for y in map(float, np.linspace(-0.5, 0.5, self.count) * wide):
            high = axis - float(np.sqrt(max(radius**2 - min(abs(y), 0.9 * radius) ** 2, 0.0)))
            solids.append(box((deep, thick, high), (0, y, high / 2)))
        if self.footed:
            solids.append(box((deep, wide, thick), (0, 0, thick / 2)))
        if self.padded:
            sector = _sector(radius, radius + thick, np.radians(205), np.radians(335), 12)
            solids.append(moved(moved(extrude(sector, -0.6 * deep, 0.6 * deep), across), at(0, 0, axis)))
        _each(t, "saddle", *solids)


class _Nozzle(Params):
    """A nozzle of a drum."""

    dn: int = among((25, 50, 80, 100), "nominal size", "mm")
    reach: float = between(0.1, 0.25, "of its face beyond the shell", "m")
    below: bool = among((False, False, True), "it is below")
    mouth: _Mouth = _mouth(lambda p: p.dn, "its pieces")


class TankInPieces(Device, name="tank/in pieces", group="Tank", label="tank", weight=2.5, grain="fitting"):
    """A drum along x of a cylinder and two dishes on saddles of plates, its nozzles and manway in pieces."""

    radius: float = between(0.3, 1.2, "radius", "m")
    half: float = between(1.2, 3.5, "half the length of the shell / radius")
    depth: float = among((0.25, 0.5, 0.9), "depth of a dish / radius")
    lift: float = between(0.15, 0.6, "of the shell over the floor", "m")
    saddles: tuple[_Saddle, ...] = several(made(_Saddle), 2, "its saddles")
    count: int = whole(2, 4, "nozzles")
    nozzles: tuple[_Nozzle, ...] = several(made(_Nozzle), lambda p: p.count, "its nozzles")
    manned: bool = chance(0.6, "a manway")
    at_end: bool = chance(0.6, "it is in one end, not on top", when=lambda p: p.manned)

    def build(self, t: Table) -> Model:
        radius, style = self.radius, t.style
        half, depth, axis = radius * self.half, radius * self.depth, radius + self.lift
        head, level = lying(dish(radius, depth, half, style)), t.at(0, 0, axis)
        _each(level, "shell", lying(disc(radius, -half, half, style)))
        _each(level, "dished head", head, moved(head, spun("z", np.pi)))
        for x, saddle in zip((-0.55 * half, 0.55 * half), self.saddles, strict=True):
            saddle.build(t.at(x), radius, axis)
        ports = []
        for x, one in zip(np.linspace(-0.8, 0.8, self.count) * half, self.nozzles, strict=True):
            there = t.at(float(x), 0, axis).spun("x", np.pi if one.below else 0.0).at(0, 0, radius)
            _each(there, "nozzle", *one.mouth.solids(one.reach, style))
            ports.append(Port(there.frame @ spun("y", -np.pi / 2) @ at(one.reach), one.dn, len(t.parts) - 1))
        if self.manned:
            wide = min(0.3, 0.5 * radius)
            on_top = at(0, 0, axis + radius) @ spun("y", -np.pi / 2)
            there = t.moved(at(half + 0.85 * depth, 0, axis) if self.at_end else on_top)
            neck = [sleeve(0.95 * wide, wide, -0.5 * depth, 0.15, style), sleeve(wide, 1.25 * wide, 0.13, 0.16, style)]
            _each(there, "manway", *(lying(one) for one in (*neck, disc(1.25 * wide, 0.162, 0.19, style))))
        return t.model(kind="tank", ports=ports)


# --- ways for cables with their fittings ---


def _walls(outline: Floats, high: float, t: float, open_: tuple[int, ...], bottom: bool = True) -> Solid:
    """A bottom over an outline and walls along those of its sides that are not open [m].

    Args:
        outline: ``(n, 2)`` counter-clockwise.
        high: of the walls.
        t: how thick all is.
        open_: numbers of the sides where the way goes on.
        bottom: whether there is one.
    """
    solids = [extrude(outline, 0.0, t)] if bottom else []
    for k in range(len(outline)):
        if k in open_:
            continue
        a, b = outline[k], outline[(k + 1) % len(outline)]
        way = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
        inside = np.array([-way[1], way[0]]) * t
        solids.append(extrude(np.array([a, b, b + inside, a + inside]), t if bottom else 0.0, high))
    return merge(solids)


def _flat_piece(form: str, wide: float, high: float, other: float, t: float) -> Solid:
    """A fitting on its back, its mouth on x = 0 [m]: a straight, a bend, a tee, a cross, a reducer."""
    w, n = wide / 2, 6
    if form in ("bend", "half bend"):
        turn, inner = (np.pi / 2 if form == "bend" else np.pi / 4), 0.5 * wide
        outline = _sector(inner, inner + wide, -np.pi / 2, -np.pi / 2 + turn, n)
        outline = outline + np.array([0.0, inner + w])
        return _walls(outline, high, t, (n, len(outline) - 1))
    if form == "reducer":
        o = other / 2
        outline = np.array([[0, -w], [wide, -o], [wide, o], [0, w]], float)
        return _walls(outline, high, t, (1, 3))
    if form in ("tee", "cross"):
        a = wide / 4 + wide
        outline = np.array([[0, -w], [a / 2, -w], [a / 2, -a], [a / 2 + wide, -a], [a / 2 + wide, -w], [a + wide, -w]])
        upper = outline * np.array([1.0, -1.0]) if form == "cross" else np.array([[0, w], [a + wide, w]], float)
        return _walls(np.concatenate([outline, upper[::-1]]), high, t, (2, 5, 8, 11) if form == "cross" else (2, 5, 7))
    outline = np.array([[0, -w], [other, -w], [other, w], [0, w]], float)
    return _walls(outline, high, t, (1, 3))


def _upright_bend(wide: float, high: float, t: float, outside: bool, turn: float) -> Solid:
    """A bend upward or downward: two curved cheeks and a curved bottom [m]."""
    inner = 0.3 * wide
    first, last = -np.pi / 2, -np.pi / 2 + turn
    back = (
        _sector(inner + high - t, inner + high, first, last, 6)
        if outside
        else _sector(inner, inner + t, first, last, 6)
    )
    cheek = _sector(inner, inner + high, first, last, 6)
    solids = [extrude(back, 0.0, wide), extrude(cheek, 0.0, t), extrude(cheek, wide - t, wide)]
    return moved(merge(solids), at(0, wide / 2, inner + high) @ spun("x", np.pi / 2))


_MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])
_BENDS = {"bend": np.pi / 2, "half bend": np.pi / 4}


class _Channel(Params):
    """A piece of a cable way."""

    level: bool = given(True, "the way is level before it")
    form: str = among(("straight", "bend", "half bend", "tee", "cross", "reducer", "up", "down"), "what it is")
    mirrored: bool = among(
        (False, False, True), "it bends to the right", when=lambda p: p.form in _BENDS, otherwise=False
    )
    length: float = between(0.2, 3.5, "of a straight piece", "m")
    turn: float = among((0.25, 0.5), "up or down / half a turn", when=lambda p: p.form in ("up", "down"), otherwise=0.0)
    held: bool = chance(0.4, "a post under it", when=lambda p: p.form == "straight" and p.length > 0.8 and p.level)

    def solid(self, wide: float, high: float, thick: float) -> Solid:
        """The piece from its mouth on x = 0 on [m]."""
        if self.form in ("up", "down"):
            return _upright_bend(wide, high, thick, self.form == "up", self.turn * np.pi)
        piece = _flat_piece(self.form, wide, high, self.length if self.form == "straight" else 0.5 * wide, thick)
        # Mirrored, so that its bottom stays below.
        return moved(piece, _MIRROR) if self.mirrored else piece

    def end(self, wide: float, high: float) -> Floats:
        """``(4, 4)`` where the next piece begins [m]."""
        if self.form in ("up", "down"):
            reach, turn = 0.3 * wide + high, self.turn * np.pi
            return at(reach * float(np.sin(turn)), 0, reach * (1 - float(np.cos(turn)))) @ spun("y", -turn)
        if self.form in _BENDS:
            turn = _BENDS[self.form]
            end = at(wide * float(np.sin(turn)), wide * (1 - float(np.cos(turn)))) @ spun("z", turn)
            return _MIRROR @ end @ _MIRROR if self.mirrored else end
        return at({"straight": self.length, "reducer": wide}.get(self.form, 2.25 * wide))


def _next_channel(rng: np.random.Generator, p: Any, so_far: tuple[_Channel, ...]) -> _Channel:
    """The next piece of a way: every second one is straight."""
    pose = np.eye(4)
    for one in so_far:
        pose = pose @ one.end(p.wide, p.high)
    straight = {"form": "straight"} if len(so_far) % 2 == 0 else {}
    return _Channel.draw(rng, {"level": bool(abs(pose[2, 0]) < 0.1), **straight})


class ChannelFittings(
    Device,
    name="cable tray/channel fittings",
    group="Electrical and safety",
    label="cable tray",
    sizes=(15,),
    weight=2.5,
    grain="fitting",
):
    """A cable way of channels: straight pieces, bends to the side and upward, tees, crosses and reducers, in a row."""

    wide: float = among((0.1, 0.2, 0.3, 0.5), "width", "m")
    high: float = among((0.05, 0.1, 0.1, 0.15), "height", "m")
    thick: float = among((0.002, 0.005, 0.01), "of its sheet", "m")
    lift: float = between(0.6, 3.0, "over the floor", "m")
    count: int = whole(4, 8, "pieces")
    row: tuple[_Channel, ...] = each(_next_channel, lambda p: p.count, "its pieces")

    def build(self, t: Table) -> Model:
        wide, pose = self.wide, at(0, 0, self.lift)
        for one in self.row:
            _each(t.moved(pose), "cable tray", one.solid(wide, self.high, self.thick))
            if one.held:
                x, y, z = (pose @ at(one.length / 2))[:3, 3]
                t.add("post", box((0.05, 0.05, z), (x, y, z / 2)))
            end = one.end(wide, self.high)
            wide = 0.5 * wide if one.form == "reducer" else wide
            pose = pose @ end
        return t.model()


# --- handrails of tubes and bends ---


class _RailEnd(Params):
    """How a rail ends: a bend down onto a post, a return to the knee rail, a hook, or just so."""

    form: str = among(("post", "return", "hook", "plain"), "how it ends")
    bend: float = among((2.0, 3.0, 4.0), "radius of the bend / of the rail")

    def solids(self, end: Floats, ahead: Floats, r: float, n: int, bore: float, high: float) -> list[Solid]:
        """What is behind an end of a rail that looks ahead, on a height [m]."""
        if self.form == "plain":
            return []
        bend, down = r * self.bend, np.array([0.0, 0.0, -1.0])
        span = (0.5 if self.form == "hook" else 1.0) * np.pi
        # Round an axis across the way: from straight ahead to straight down, and on to straight back.
        side = down - (down @ ahead) * ahead
        side = side / float(np.linalg.norm(side))
        if self.form == "post":
            span = float(np.arccos(np.clip(ahead @ down, -1, 1)))
        angles = np.linspace(0, span, 9)
        path = end + bend * (np.sin(angles)[:, None] * ahead + (1 - np.cos(angles))[:, None] * side)
        solids = [torus_piece(path, r, n, bore)]
        if self.form == "post":
            solids.append(torus_piece(np.array([path[-1], path[-1] + (high - bend) * down]), r, n, bore))
        elif self.form == "return":
            solids.append(torus_piece(np.array([path[-1], path[-1] - 0.3 * ahead]), r, n, bore))
        return solids


class _RailSide(Params):
    """The rails on one side of a flight or a walk."""

    length: float = given(0.0, "of the flight", "m")
    knees: tuple[float, ...] = among(((), (0.5,), (0.5,), (0.35, 0.7)), "heights of its knee rails / of the rail")
    thin: tuple[float, ...] = several(one_of(0.7, 0.9, 1.0), lambda p: len(p.knees), "radius of each / of the rail")
    ends: tuple[_RailEnd, ...] = several(made(_RailEnd), 2, "ends of the rail")
    posts: tuple[bool, ...] = several(yes(0.85), lambda p: int(p.length / 1.3) + 2, "whether each post is there")


class TubesAndBends(
    Device,
    name="railing/tubes and bends",
    group=FRAME,
    label="railing",
    bundle="railing",
    sizes=(15,),
    weight=1.5,
    grain="fitting",
):
    """Handrails of straight tubes, each bend, return and post a piece, on both sides of a walk."""

    slope: ClassVar[float] = 0.0

    length: float = between(0.8, 3.0, "length", "m")
    high: float = between(0.85, 1.1, "height of the rail", "m")
    radius: float = among((0.0169, 0.021, 0.024, 0.03), "of a tube", "m")
    wide: float = between(0.7, 1.5, "between the sides", "m")
    gap: float = among((0.0, 0.0, 0.001), "before the bends", "m")
    count: int = whole(1, 2, "sides with a rail")
    sides: tuple[_RailSide, ...] = several(
        made(_RailSide, lambda p: {"length": p.length}), lambda p: p.count, "its sides"
    )
    treads: tuple[float, ...] = given((), "thickness of each tread", "m")
    floored: bool = chance(0.7, "a floor")
    floor: str = among(
        ("platform", "grating", "plate"), "what the floor is taken for", when=lambda p: p.floored, otherwise=""
    )

    def build(self, t: Table) -> Model:
        length, wide, slope = self.length, self.wide, self.slope
        for y, side in zip((0.0, wide), self.sides, strict=False):
            for solid in self._side(t.style, side, y):
                t.add("railing", solid)
        for k, thick in enumerate(self.treads, 1):
            tread = box((0.25, wide, thick), (length * k / 7, wide / 2, slope * length * k / 7))
            t.add("stair tread", tread, own=False)
        if self.floored:
            floor = box((length + 0.1, wide + 0.1, 0.04), (length / 2, wide / 2, -0.02))
            t.add(self.floor, floor, of="steel", own=False)
        return t.model()

    def _side(self, style: ModelingStyle, side: _RailSide, y: float) -> list[Solid]:
        """The pieces of one side."""
        length, high, r, slope = self.length, self.high, self.radius, self.slope
        n, bore = min(style.round(r), 24), 0.88 * r if style.hollow else 0.0
        way = np.array([1.0, 0.0, slope]) / float(np.hypot(1.0, slope))
        low, top = np.array([0.0, y, high]), np.array([length, y, high + slope * length])
        solids = [torus_piece(np.array([low, top]), r, n, bore)]
        for share, thin in zip(side.knees, side.thin, strict=True):
            drop = np.array([0.0, 0.0, -high * (1 - share)])
            solids.append(torus_piece(np.array([low + drop, top + drop]), r * thin, n, bore * thin))
        for one, end, ahead in zip(side.ends, (low, top), (-way, way), strict=True):
            solids += one.solids(end + self.gap * ahead, ahead, r, n, bore, high)
        for x, there in zip(np.linspace(0, length, len(side.posts)), side.posts, strict=True):
            if there:
                foot = np.array([x, y, slope * x])
                solids.append(torus_piece(np.array([foot, foot + np.array([0.0, 0.0, high - r])]), r, n, bore))
        return solids


class FlightOfTubes(TubesAndBends, name="railing/flight of tubes"):
    """Handrails of straight tubes, each bend, return and post a piece, on both sides of a flight."""

    slope = 0.7

    treads: tuple[float, ...] = several(one_of(0.03, 0.05), 6, "thickness of each tread", "m")
    floored: bool = chance(0.7, "a floor", when=lambda _: False)


PRIMITIVE_PIECES: tuple[Family, ...] = families_of(
    PumpInPieces, TankInPieces, ChannelFittings, TubesAndBends, FlightOfTubes
)
