"""Tanks and equipment of primitives: boxes, cylinders, cones and dishes with nozzles."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made, one_of
from cadplants.builder.params import Params, Source, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    Snout,
    cone,
    disc,
    dish,
    lying,
    pipe_piece,
    snout_of,
    vessel,
)
from cadplants.model.family import Family, Model, Port
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import box, cylinder
from cadplants.solids.transforms import at, looking, spun

__all__ = ["PRIMITIVE_MACHINES"]


class _Manway(Params):
    """A wide short neck with a lid; a davit or a handle on it, or neither."""

    gap: float = among((0.0, 0.0, 0.003), "under the lid", "m")
    form: str = among(("plain", "davit", "handle"), "what is on the lid")

    def build(self, t: Table, radius: float, rise: float) -> None:
        """Puts it down about z on z = 0 [m]."""
        rim, thick, style = 1.25 * radius, 0.1 * radius, t.style
        top = rise + self.gap
        solids = [disc(radius, -0.3 * rise, rise, style), disc(rim, rise - thick, rise, style)]
        solids.append(disc(rim, top, top + thick, style))
        if self.form == "davit":
            solids.append(moved(cylinder(0.06 * radius, rise, rise + radius, 8), at(1.3 * radius)))
            solids.append(box((1.4 * radius, 0.1 * radius, 0.1 * radius), (0.65 * radius, 0, rise + radius)))
        elif self.form == "handle":
            solids.append(box((0.8 * radius, 0.08 * radius, 0.2 * radius), (0, 0, top + 1.5 * thick)))
        t.bundled("manway").add("manway", *solids)


class _Leg(Params):
    """A leg of an upright vessel."""

    square: bool = chance(0.6, "it is square")
    plated: bool = chance(0.3, "a plate at its foot")


class _Stand(Params):
    """What an upright vessel stands on: a skirt, three or four legs, or a block."""

    thin: bool = given(False, "the vessel is an apparatus")
    form: str = among(lambda p: ("legs" if p.thin else "skirt", "legs", "block"), "what it stands on")
    flare: float = among((1.0, 1.15), "foot of the skirt / vessel", when=lambda p: p.form == "skirt", otherwise=0.0)
    count: int = whole(3, 4, "legs", when=lambda p: p.form == "legs")
    legs: tuple[_Leg, ...] = several(made(_Leg), lambda p: p.count, "its legs", when=lambda p: p.form == "legs")

    def build(self, t: Table, radius: float, low: float) -> None:
        """Puts it down under a vessel whose shell begins at a height [m]."""
        style, size = t.style, max(0.03, 0.09 * radius)
        if self.form == "skirt":
            foot = radius * self.flare
            t.bundled("skirt").add("skirt", cone(foot, radius, 0.0, low, style), disc(1.15 * foot, 0.0, 0.02, style))
        elif self.form == "block":
            t.add("foundation", box((2.2 * radius, 2.2 * radius, 0.95 * low), (0, 0, 0.475 * low)))
        name = "column" if self.thin else "tank leg"
        for k, leg in enumerate(self.legs):
            there = t.spun("z", 2 * np.pi * k / self.count).at(0.92 * radius)
            square = box((size, size, 1.2 * low), (0, 0, 0.6 * low))
            upright = square if leg.square else disc(0.6 * size, 0, 1.2 * low, style)
            there.bundled(name).add(name, upright, own=not self.thin)
            if leg.plated:
                there.add("base plate", box((2 * size, 2 * size, 0.012), (0, 0, 0.006)))


class _SideNozzle(Params):
    """A nozzle at the side of an upright vessel."""

    wide: bool = given(False, "the vessel is a wide one")
    dn: int = among(lambda p: (25, 40, 50, 80) if p.wide else (15, 25, 40), "nominal size", "mm")
    turn: float = between(0, 1.5, "where it is, besides 2.1 rad from one to the next", "rad")
    high: float = between(0.1, 0.9, "its height / of the shell")
    reach: float = between(0.08, 0.2, "of its face beyond the shell", "m")
    snout: Snout = snout_of(lambda p: p.dn, "nozzle")


class _Vessel(Device):
    """A vessel of primitives."""

    def nozzle(self, t: Table, snout: Snout, low: float, face: float) -> Port:
        """Puts a nozzle down along x; the port at its face [m]."""
        name = "nozzle" if self.label == "tank" else self.label
        t.bundled(name).add(name, lying(snout.solid(low, face, t.style)), of="tank")
        return Port(t.frame @ at(face), snout.dn, len(t.parts) - 1)


class _Upright(_Vessel):
    """A vessel about z with dishes, on a skirt, legs or a block, with nozzles and at times a manway."""

    radius: float
    high: float = between(1.6, 4.0, "height of the shell / radius")
    depth: float = among((0.25, 0.5, 1.0, 0.0), "depth of a dish / radius")
    low: float = between(0.2, 0.7, "height of the lower dish over the floor", "m")
    apart: bool = chance(0.4, "its heads are meshes of their own", when=lambda p: p.depth, otherwise=False)
    stand: _Stand
    count: int = whole(1, 3, "nozzles")
    nozzles: tuple[_SideNozzle, ...] = several(
        made(_SideNozzle, lambda p: {"wide": p.radius > 0.3}), lambda p: p.count, "its nozzles"
    )

    def put(self, t: Table) -> tuple[float, float, float, list[Port]]:
        """Puts all but a manway down: height of the shell's foot, of the shell, depth of a dish [m]; the ports."""
        radius, tank, style = self.radius, self.label == "tank", t.style
        name = "shell" if tank else self.label
        high, depth = radius * self.high, radius * self.depth
        low, own = depth + self.low, t.bundled(name)
        whole = depth and not self.apart
        solid = vessel(radius, low, low + high, depth, style) if whole else disc(radius, low, low + high, style)
        heights = [low + 0.8 * high, low + 0.93 * high] if self.label == "filter" else []
        lids = [disc(1.3 * radius, z, z + 0.12 * radius, style) for z in heights]
        own.add(name, solid, *lids, of="tank")
        if self.apart:
            head = dish(radius, depth, 0.0, style)
            for pose in (at(0, 0, low + high), at(0, 0, low) @ spun("x", np.pi)):
                own.add("dished head" if tank else name, moved(head, pose), of="tank")
        self.stand.build(t, radius, low)
        ports = []
        for k, one in enumerate(self.nozzles):
            there = t.at(0, 0, low + high * one.high).spun("z", 2.1 * k + one.turn)
            ports.append(self.nozzle(there, one.snout, 0.8 * radius, radius + one.reach))
        return low, high, depth, ports


def _stand(thin: bool) -> _Stand:
    return nested(_Stand, "what it stands on", fixed=lambda _: {"thin": thin})


class UprightTank(_Upright, name="tank/upright of primitives", group="Tank", label="tank", weight=3):
    """A tank about z with dishes, on a skirt, legs or a block, with nozzles and at times a manway."""

    radius: float = between(0.35, 1.3, "radius", "m")
    stand: _Stand = _stand(False)
    manned: bool = chance(0.5, "a manway")
    manway: _Manway = nested(_Manway, "manway", when=lambda p: p.manned)
    aside: bool = chance(0.5, "it is at the side, not on top", when=lambda p: p.manned)
    turn: float = between(4, 6, "where it is at the side", "rad", when=lambda p: p.aside)

    def build(self, t: Table) -> Model:
        low, high, depth, ports = self.put(t)
        if self.manned:
            there = t.at(0, 0, low + high + 0.7 * depth)
            if self.aside:
                there = t.at(0, 0, low + 0.3 * high).spun("z", self.turn).at(0.97 * self.radius).spun("y", np.pi / 2)
            self.manway.build(there, min(0.3, 0.45 * self.radius), 0.15)
        return t.model(kind="tank", ports=ports[:3])


class UprightFilter(_Upright, name="filter/upright of primitives", group="Equipment", label="filter"):
    """A filter about z with dishes and a bolted lid, on legs or a block, with nozzles."""

    radius: float = between(0.12, 0.4, "radius", "m")
    stand: _Stand = _stand(True)

    def build(self, t: Table) -> Model:
        return t.model(kind=self.label, ports=self.put(t)[3][:1])


class UprightSeparator(UprightFilter, name="separator/upright of primitives", label="separator"):
    """A slender separator about z with dishes, on legs or a block, with nozzles."""

    high: float = between(4.0, 8.0, "height of the shell / radius")
    depth: float = among((0.25, 0.25, 0.5, 1.0), "depth of a dish / radius")


class _TopNozzle(Params):
    """A nozzle of a lying vessel."""

    dn: int = among((25, 40, 50, 80), "nominal size", "mm")
    reach: float = between(0.08, 0.2, "of its face beyond the shell", "m")
    snout: Snout = snout_of(lambda p: p.dn, "nozzle")


class _Lying(_Vessel):
    """A vessel about x with dishes on two saddles, with nozzles."""

    radius: float
    half: float = between(1.4, 4.0, "half the length of the shell / radius")
    depth: float = among((0.25, 0.5, 1.0), "depth of a dish / radius")
    lift: float = between(0.2, 0.8, "height of the shell over the floor", "m")

    def shell(self, t: Table, *discs: tuple[float, float, float]) -> tuple[float, float]:
        """Puts the shell down with discs round it (radius, from, to), half its length and its axis' height [m]."""
        half, axis = self.radius * self.half, self.radius + self.lift
        name = "shell" if self.label == "tank" else self.label
        body = vessel(self.radius, -half, half, self.radius * self.depth, t.style)
        solids = [lying(body), *(lying(disc(*one, t.style)) for one in discs)]
        t.at(0, 0, axis).bundled(name).add(name, *solids, of="tank")
        return half, axis

    def saddle(self, half: float, axis: float) -> list[Solid]:
        """A web and a foot about the origin [m]."""
        tall = axis - 0.6 * self.radius
        web = box((0.12 * half, 1.6 * self.radius, tall), (0, 0, tall / 2))
        return [web, box((0.2 * half, 1.8 * self.radius, 0.02), (0, 0, 0.01))]

    def ports(self, t: Table, nozzles: tuple[_TopNozzle, ...], half: float, axis: float, both: bool) -> list[Port]:
        """Puts the nozzles down along the top, every second one below where ``both``; the ports on top [m]."""
        ports = []
        for k, (x, one) in enumerate(zip(np.linspace(-0.85, 0.85, len(nozzles)) * half, nozzles, strict=True)):
            down = both and k % 2 == 1
            there = t.at(float(x), 0, axis).spun("y", (0.5 if down else -0.5) * np.pi)
            port = self.nozzle(there, one.snout, 0.8 * self.radius, self.radius + one.reach)
            ports += [] if down else [port]
        return ports


def _nozzles() -> tuple[_TopNozzle, ...]:
    return several(made(_TopNozzle), lambda p: p.count, "its nozzles")


class LyingTank(_Lying, name="tank/lying of primitives", group="Tank", label="tank", weight=3):
    """A tank about x with dishes on two saddles, with nozzles and at times a manway."""

    radius: float = between(0.3, 1.2, "radius", "m")
    belted: bool = chance(0.3, "a belt at either end of the shell")
    plates: tuple[int, ...] = several(one_of(1, 2), 2, "plates of each saddle")
    count: int = whole(2, 4, "nozzles")
    nozzles: tuple[_TopNozzle, ...] = _nozzles()
    manned: bool = chance(0.5, "a manway in one end")
    manway: _Manway = nested(_Manway, "manway", when=lambda p: p.manned)

    def build(self, t: Table) -> Model:
        radius, end = self.radius, self.radius * self.half
        belts = [(1.02 * radius, x, x + 0.05) for x in (-end, end - 0.05)] if self.belted else []
        half, axis = self.shell(t, *belts)
        for x, count in zip((-0.6 * half, 0.6 * half), self.plates, strict=True):
            t.at(x).bundled("saddle").add("saddle", *self.saddle(half, axis)[:count], own=True)
        ports = self.ports(t, self.nozzles, half, axis, False)
        if self.manned:
            there = t.at(half + 0.8 * radius * self.depth, 0, axis).spun("y", np.pi / 2)
            self.manway.build(there, min(0.3, 0.5 * radius), 0.2)
        return t.model(kind="tank", ports=ports)


class LyingExchanger(
    _Lying, name="heat exchanger/lying of primitives", group="Equipment", label="heat exchanger", weight=2
):
    """A heat exchanger about x with dishes on two saddles, with nozzles and discs round its channel."""

    radius: float = between(0.12, 0.35, "radius", "m")
    third: bool = chance(0.4, "a disc at the far end too")
    count: int = whole(2, 4, "nozzles")
    nozzles: tuple[_TopNozzle, ...] = _nozzles()

    def build(self, t: Table) -> Model:
        end = self.radius * self.half
        places = (-0.75 * end, -0.7 * end, *((0.8 * end,) if self.third else ()))
        half, axis = self.shell(t, *((1.25 * self.radius, x, x + 0.03 * end) for x in places))
        for x in (-0.6 * half, 0.6 * half):
            t.at(x).add("foundation", self.saddle(half, axis)[0])
        return t.model(kind=self.label, ports=self.ports(t, self.nozzles, half, axis, True))


class PlainBox(_Vessel, name="tank/plain box", group="Tank", label="tank", weight=1.5):
    """A rectangular tank, closed or open at the top, on the floor or on legs."""

    length: float = between(0.5, 2.0, "length", "m")
    wide: float = between(0.4, 1.5, "width", "m")
    high: float = between(0.4, 1.5, "height", "m")
    stands: str = among(("floor", "low legs", "high legs"), "what it stands on")
    tall: float = between(0.5, 2.0, "height of high legs", "m", when=lambda p: p.stands == "high legs")
    open_: bool = chance(0.5, "it is open at the top")
    nozzle_dn: int = among((25, 40, 50), "nominal size of its nozzle", "mm")
    snout: Snout = snout_of(lambda p: p.nozzle_dn, "nozzle")

    def build(self, t: Table) -> Model:
        a, b, c, wall = self.length, self.wide, self.high, 0.01
        low = {"floor": 0.0, "low legs": 0.3, "high legs": self.tall}[self.stands]
        solids = [box((a, b, c), (0, 0, low + c / 2))]
        if self.open_:
            solids = [box((a, b, wall), (0, 0, low + wall / 2))]
            for s in (-1, 1):
                middle = low + wall + (c - wall) / 2
                solids.append(box((wall, b, c - wall), (s * (a - wall) / 2, 0, middle)))
                solids.append(box((a - 2 * wall, wall, c - wall), (0, s * (b - wall) / 2, middle)))
        t.bundled("shell").add("shell", *solids)
        for x in (-1, 1) if low else ():
            for y in (-1, 1):
                leg = box((0.06, 0.06, low), (x * (a / 2 - 0.03), y * (b / 2 - 0.03), low / 2))
                t.bundled("tank leg").add("tank leg", leg, own=True)
        port = self.nozzle(t.at(0, 0, low + 0.3 * c), self.snout, a / 2 - wall, a / 2 + 0.12)
        return t.model(kind="tank", ports=(port,))


# --- equipment ---


class _Cased(Device, group="Equipment", weight=0.7):
    """An apparatus as a box, at times with cylinders on it."""

    mouths: ClassVar[tuple[float, ...]] = (0.0,)

    def put(self, t: Table, solids: list[Solid], stub: int, size: tuple[float, float, float], low: float) -> Model:
        """Puts it down with its stubs of pipe, of a length, width and height [m]."""
        a, b, c = size
        poses = [looking((-a / 2 - 0.06, y * b, low + 0.2 * c), (-1, 0, 0)) for y in self.mouths]
        stubs = [moved(lying(pipe_piece(stub, -0.08, 0.0, t.style)), pose) for pose in poses]
        t.bundled(self.label).add(self.label, *solids, *stubs, of="tank")
        if low and self.label != "radiator":
            t.add("foundation", box((a + 0.2, b + 0.2, low), (0, 0, low / 2)))
        return t.model(kind=self.label, ports=[Port(pose, stub, 0) for pose in poses])


class _OnFloor(_Cased):
    """One that stands on the floor or on a foundation."""

    length: float = between(0.5, 1.8, "length", "m")
    wide: float = between(0.4, 1.0, "width", "m")
    high: float = between(0.6, 1.8, "height", "m")
    low: float = among((0.0, 0.1), "height of the foundation", "m")


def _stub() -> int:
    return among((15, 20, 25), "nominal size of its pipe", "mm")


class BoxBoiler(_OnFloor, name="boiler/of boxes and cylinders", label="boiler"):
    """A boiler as a box with a flue and maybe a burner."""

    mouths = (-0.2, 0.2)

    flue: float = between(0.1, 0.5, "height of the flue", "m")
    fired: bool = chance(0.4, "a burner at its front")
    stub: int = _stub()

    def build(self, t: Table) -> Model:
        a, b, c, low, style = self.length, self.wide, self.high, self.low, t.style
        solids = [box((a, b, c), (0, 0, low + c / 2)), disc(0.2 * b, low + 0.9 * c, low + c + self.flue, style)]
        if self.fired:
            solids.append(lying(disc(0.25 * b, a / 2, a / 2 + 0.3, style), 0, 0, low + 0.4 * c))
        return self.put(t, solids, self.stub, (a, b, c), low)


class VesselCompressor(_OnFloor, name="compressor/of boxes and cylinders", label="compressor"):
    """A lying vessel on two feet with a box, a drum and a motor on it."""

    stub: int = _stub()

    def build(self, t: Table) -> Model:
        a, b, c, low, style = self.length, self.wide, self.high, self.low, t.style
        r = 0.4 * b
        axis = low + 0.15 + r
        top = axis + 0.95 * r
        solids = [lying(vessel(r, -0.45 * a, 0.45 * a, 0.4 * r, style), 0, 0, axis)]
        solids += [box((0.08 * a, 1.2 * r, axis - low), (x, 0, (axis + low) / 2)) for x in (-0.3 * a, 0.3 * a)]
        solids.append(box((0.8 * a, 1.4 * r, 0.04), (0, 0, top)))
        solids.append(box((0.25 * a, 0.9 * r, 0.4 * c), (-0.2 * a, 0, top + 0.2 * c)))
        solids.append(lying(disc(0.45 * r, 0.0, 0.35 * a, style), 0, 0, top + 0.5 * r))
        return self.put(t, solids, self.stub, (a, b, c), low)


class DrumBlower(_OnFloor, name="blower/of boxes and cylinders", label="blower"):
    """A flat drum across, its square mouth upward, with a motor and a cone for its inlet."""

    stub: int = _stub()

    def build(self, t: Table) -> Model:
        a, b, c, low, style = self.length, self.wide, self.high, self.low, t.style
        r = 0.4 * c
        axis = low + 1.2 * r
        solids = [
            box((a, b, 0.1 * c), (0, 0, low + 0.05 * c)),
            lying(disc(r, -0.3 * b, 0.3 * b, style), 0, 0, axis),
            box((0.6 * b, 0.6 * r, 1.4 * r), (0, 0.7 * r, axis + 0.7 * r)),
            lying(cone(0.5 * r, 0.7 * r, 0.3 * b, 0.6 * b, style), 0, 0, axis),
            lying(disc(0.4 * r, -0.9 * b, -0.3 * b, style), 0, 0, axis),
            box((0.5 * b, 0.7 * r, axis - low), (-0.6 * b, 0, (axis + low) / 2)),
        ]
        return self.put(t, solids, self.stub, (a, b, c), low)


class _Slab(Params):
    """The size of a radiator."""

    length: float = between(0.4, 2.0, "length", "m")
    wide: float = between(0.05, 0.2, "depth", "m")
    high: float = between(0.3, 0.9, "height", "m")


def _behind(source: Source, _: object) -> Source:
    # As many numbers as the size of what stands on the floor takes are drawn first and given up.
    source.rng.random(3)
    return source


class BoxRadiator(_Cased, name="radiator/of boxes and cylinders", label="radiator"):
    """A radiator as a box or as ten sections on two headers."""

    size: _Slab = nested(_Slab, "size", stream=_behind)
    ribbed: bool = chance(0.5, "ten sections on two headers")
    stub: int = _stub()

    def build(self, t: Table) -> Model:
        a, b, c, low = self.size.length, self.size.wide, self.size.high, 0.12
        solids = [box((a, b, c), (0, 0, low + c / 2))]
        if self.ribbed:
            solids = [box((0.8 * a / 10, b, c), (x, 0, low + c / 2)) for x in np.linspace(-0.45, 0.45, 10) * a]
            solids += [box((a, 0.3 * b, 0.1 * c), (0, 0, low + z * c)) for z in (0.1, 0.9)]
        return self.put(t, solids, self.stub, (a, b, c), low)


class DrumBurner(_OnFloor, name="burner/of boxes and cylinders", label="burner"):
    """A burner: a drum with a narrower one, a box on top, a foot."""

    stub: int = _stub()

    def build(self, t: Table) -> Model:
        a, b, c, low, style = self.length, self.wide, self.high, self.low, t.style
        r = 0.25 * c
        solids = [
            lying(disc(r, -0.3 * a, 0.3 * a, style), 0, 0, low + 2 * r),
            lying(disc(0.55 * r, 0.3 * a, 0.7 * a, style), 0, 0, low + 2 * r),
            box((0.35 * a, 1.2 * r, r), (0, 0, low + 3.2 * r)),
            box((0.1 * a, 0.3 * b, 1.2 * r), (0, 0, low + 0.6 * r)),
        ]
        return self.put(t, solids, self.stub, (a, b, c), low)


class PotOnLine(Device, name="filter/pot on line", place="inline", group="Equipment", label="filter", weight=0.5):
    """An upright vessel that a line runs through."""

    length: float = between(1.3, 2.2, "face to face / outside of the flange")
    wide: float = between(1.4, 2.5, "radius / of the pipe")
    low: float = between(1.0, 3.0, "what is below the axis / radius")
    high: float = between(0.8, 1.5, "what is above the axis / radius")

    def build(self, t: Table) -> Model:
        r, length = PIPES[self.dn].radius, round(t.flange.outer * self.length, 6)
        wide = min(0.45 * length, r * self.wide)
        pot = vessel(wide, -wide * self.low, wide * self.high, 0.4 * wide, t.style)
        run = lying(disc(r, 0.0, length, t.style))
        t.bundled("filter").add("filter", run, moved(pot, at(length / 2)), of="tank")
        return t.model(length, kind="filter")


PRIMITIVE_MACHINES: tuple[Family, ...] = families_of(
    UprightTank,
    LyingTank,
    PlainBox,
    LyingExchanger,
    UprightFilter,
    UprightSeparator,
    PotOnLine,
    BoxBoiler,
    VesselCompressor,
    DrumBlower,
    BoxRadiator,
    DrumBurner,
)
