"""Compressors of plain shapes: cabinets with louvres, piston compressors on a receiver."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table
from cadplants.families.machines.plain_parts import Faceted, PlainMotor, PlainPort, port_of
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, ring, rod
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_COMPRESSORS", "louvres"]

_NAME = "compressor"


class _Compressor(Faceted, place="floor", group="Equipment", label=_NAME, bundle=_NAME):
    """A compressor of plain shapes."""


def louvres(wide: float, tall: float, count: int, deep: float = 0.008) -> list[Solid]:
    """Level strips on a sheet that looks to -y, about the origin [m]."""
    return [
        box((wide, deep, 0.4 * tall / count), (0, -deep / 2, float(z))) for z in np.linspace(-0.5, 0.5, count) * tall
    ]


class _Cabinet(_Compressor, sizes=(20, 25, 32, 40, 50)):
    """A screw compressor in a cabinet of plain shapes."""

    wide: float = between(0.6, 2.4, "width", "m")
    deep: float = between(0.5, 1.3, "depth", "m")
    tall: float = between(0.8, 1.9, "height", "m")
    corner: float = among((0.0, 0.0, 0.03, 0.08), "radius of its corners", "m")
    sole: str = among(("plinth", "runners", "feet", "none"), "what it stands on")
    doors: int = whole(0, 3, "doors in front")
    slats: int = among((0, 5, 8, 12), "strips of a louvre")
    sides: bool = chance(0.5, "a louvre at its side too", when=lambda p: p.slats)
    roof: str = among(("none", "cowl", "fan", "duct"), "what is on the roof")
    panel: bool = chance(0.7, "a panel in front")
    stub: PlainPort = port_of(lambda p: p.dn, "mouth")
    level: float = between(0.5, 0.9, "height of the mouth / of the cabinet")

    def build(self, t: Table) -> Model:
        w, d, h, low = self.wide, self.deep, self.tall, 0.0 if self.sole == "none" else 0.1
        n, reach = self.n(t, t.pipe.radius), 0.1
        face = (w / 2 + reach, 0.25 * d, low + self.level * (h - 0.2))
        mouth, port = self.stub.build(t, face, (1, 0, 0), reach + 0.02, n)
        t.add(_NAME, extrude(rounded_rectangle(w, d, self.corner, 3), low, low + h), mouth, of="motor")
        if self.sole != "none":
            t.add(_NAME, *self._sole(low), of="steel")
        self._front(t.at(0, -d / 2, low))
        if self.sides:
            side = t.at(-w / 2, 0, low + 0.6 * h).spun("z", -np.pi / 2)
            side.add(_NAME, *louvres(0.6 * d, 0.3 * h, self.slats), of="rubber")
        self._roof(t.at(0.15 * w, 0, low + h), n)
        return t.model(kind="screw compressor", ports=(port,))

    def _sole(self, low: float) -> list[Solid]:
        w, d = self.wide, self.deep
        if self.sole == "plinth":
            return [box((0.96 * w, 0.94 * d, low), (0, 0, low / 2))]
        if self.sole == "runners":
            return [box((w, 0.12 * d, low), (0, s * 0.4 * d, low / 2)) for s in BOTH]
        return [box((0.08, 0.08, low), (x * 0.42 * w, y * 0.42 * d, low / 2)) for x in BOTH for y in BOTH]

    def _front(self, t: Table) -> None:
        """Doors, louvres and a panel on the front about its lower edge."""
        w, h, count = self.wide, self.tall, max(1, self.doors)
        step = w / count
        for k in range(self.doors):
            x = (k + 0.5) * step - w / 2
            t.add(_NAME, box((0.93 * step, 0.014, 0.9 * h), (x, -0.005, 0.5 * h)), of="electrical")
            t.add(_NAME, box((0.025, 0.03, 0.14), (x + 0.38 * step, -0.026, 0.5 * h)), of="rubber")
        out = -0.01 if self.doors else 0.002
        if self.slats:
            x = (count - 0.5) * step - w / 2
            t.at(x, out, 0.3 * h).add(_NAME, *louvres(0.7 * step, 0.25 * h, self.slats), of="rubber")
        if self.panel:
            x = 0.5 * step - w / 2
            size = (min(0.35, 0.5 * step), 0.03, 0.16)
            t.add("control panel", box(size, (x, out - 0.012, 0.78 * h)), own=True)

    def _roof(self, t: Table, n: int) -> None:
        w, d = self.wide, self.deep
        if self.roof == "cowl":
            t.add(_NAME, box((0.4 * w, 0.6 * d, 0.16), (0, 0, 0.078)), of="motor")
        elif self.roof == "duct":
            t.add(_NAME, box((0.35 * w, 0.45 * d, 0.5), (0, 0, 0.248)), of="clamp")
        elif self.roof == "fan":
            r = 0.3 * min(w, d)
            t.add(_NAME, ring(0.92 * r, r, -0.002, 0.08, n), cylinder(0.93 * r, -0.002, 0.03, n), of="rubber")


class Cabinet(_Cabinet, name="compressor/plain cabinet", weight=1.2):
    """A screw compressor in a cabinet of plain shapes, as finely as the style has equipment."""


class CabinetInPieces(_Cabinet, name="compressor/cabinet in pieces", weight=1.0, grain="fitting"):
    """A screw compressor in a cabinet of plain shapes, each a piece of its own."""


class _OnReceiver(_Compressor, sizes=(15, 20, 25)):
    """A piston compressor on a receiver, of plain shapes."""

    radius: float = between(0.14, 0.42, "of the receiver", "m")
    slender: float = between(2.4, 5.5, "length of the receiver / its radius")
    upright: bool = chance(0.3, "the receiver stands")
    dished: float = between(0.15, 0.5, "depth of the receiver's ends / radius")
    split: bool = chance(0.5, "the receiver's ends are pieces of their own")
    legs: str = among(("sheets", "angles", "blocks"), "what a lying receiver stands on")
    block: float = between(0.35, 0.65, "half the size of the crankcase / radius of the receiver")
    round_: bool = chance(0.4, "the crankcase is a drum")
    heads: str = among(("one", "two", "vee", "vee"), "its cylinders")
    fins: int = whole(0, 6, "fins round a cylinder")
    capped: bool = chance(0.7, "a head on each cylinder")
    filters: bool = chance(0.6, "a filter at each head")
    wheel: float = between(0.85, 1.45, "radius of the flywheel / half the size of the crankcase")
    spokes: int = among((0, 0, 4, 5, 6), "spokes of the flywheel; 0: a disc")
    guard: str = among(("oval", "box", "oval", "half", "none"), "form of the belt guard")
    size: float = between(0.3, 0.55, "radius of the motor / of the receiver")
    long: float = between(1.8, 3.2, "length of the motor / its radius")
    motor: PlainMotor = nested(PlainMotor, "motor")
    piped: bool = chance(0.7, "a pipe from the head down to the receiver")
    stub: PlainPort = port_of(lambda p: p.dn, "mouth")

    def build(self, t: Table) -> Model:
        r, n = self.radius, self.n(t, self.radius)
        port, deck = self._receiver(t, r, n)
        half = r * self.slender / 2 if not self.upright else 1.5 * r
        length = min(1.7 * half, 3.2 * r)
        t.add(_NAME, box((length, 1.3 * r, 0.02), (0, 0, deck - 0.01)), of="steel")
        c, m = self.block * r, self.size * r
        left, x = -0.3 * length, 0.3 * length
        axis, wheel = deck + 1.0 * c, self.wheel * c
        self._block(t.at(left, 0, deck), c, n)
        y, stand = -0.75 * c - 0.05 * r, max(1.15 * m, 1.12 * wheel)
        high, hub = deck + stand, max(axis, deck + 1.12 * wheel)
        t.at(left, 0, hub).along("y").add("shaft", cylinder(0.12 * c, y - 0.1 * r, 0, 8), own=True)
        solids = [cylinder(wheel, y - 0.12 * c, y + 0.1 * c, n)]
        if self.spokes:
            spoke = box((0.8 * wheel, 0.16 * wheel, 0.16 * c), (0.45 * wheel, 0, y))
            solids = [ring(0.8 * wheel, wheel, y - 0.12 * c, y + 0.1 * c, n), around(spoke, self.spokes)]
        t.at(left, 0, hub).along("y").add(_NAME, *solids, of="trim")
        drive = t.at(x, y + 0.1 * c, high).spun("x", -np.pi / 2).spun("z", -np.pi / 2)
        self.motor.build(drive, m, min(self.long * m, 1.5 * r), self.n(t, m), stand)
        t.at(x, 0, high).along("y").add("shaft", cylinder(0.15 * m, y - 0.1 * c, y + 0.12 * c, 8), own=True)
        self._guard(t, (left, hub), (x, high), wheel, y)
        if self.piped:
            path = [(left + c, 0.4 * c, deck + 2.2 * c), (left + 1.7 * c, 0.4 * c, deck + 2.2 * c)]
            path.append((left + 1.7 * c, 0.4 * c, deck - 0.03))
            for a, b in zip(path, path[1:], strict=False):
                t.add("pipe", rod(a, b, 0.06 * c, 6), own=True)
        return t.model(kind="piston compressor", ports=(port,))

    def _receiver(self, t: Table, r: float, n: int) -> tuple[Port, float]:
        """The receiver on its feet; its port, and the height of the deck on it."""
        tall = r * self.slender
        low = 0.35 * r + 0.12 if self.upright else r + 0.12
        cap = dome(r, self.dished * r, 0.0, n)
        ends = [moved(cap, at(0, 0, tall - 0.001)), moved(cap, spun("x", np.pi))]
        shell = cylinder(r, 0, tall, n)
        where = t.at(0, 0, low) if self.upright else t.at(-tall / 2, 0, low).along("x")
        # The mouth sits on the shell, which comes first.
        spot, way = ((r + 0.06, 0, low + 0.7 * tall), (1, 0, 0)) if self.upright else ((0, r + 0.06, low), (0, 1, 0))
        mouth, port = self.stub.build(t, spot, way, 0.06 + 0.2 * r, self.n(t, t.pipe.radius))
        body = moved(shell, where.frame)
        caps = [moved(one, where.frame) for one in ends]
        t.add("shell", body, mouth, *([] if self.split else caps), own=True)
        if self.split:
            t.add_each("dished head", caps, own=True)
        t.add("tank leg", *self._legs(r, tall, low, n), own=True)
        deck = low + tall + 0.5 * r if self.upright else low + r + 0.05
        under = low + tall if self.upright else low + 0.9 * r
        props = [box((0.05, 0.9 * r, deck - under), (s * 0.5 * r, 0, (deck + under) / 2)) for s in BOTH]
        t.add(_NAME, *props, of="steel")
        return port, deck

    def _legs(self, r: float, tall: float, low: float, n: int) -> list[Solid]:
        if self.upright:
            return [around(box((0.05, 0.05, low + 0.1), (0, 0, (low + 0.1) / 2)), 3, 0.97 * r)]
        high = low - 0.75 * r
        xs = (-0.38 * tall, 0.38 * tall)
        if self.legs == "sheets":
            return [box((0.012, 1.4 * r, high), (x, 0, high / 2)) for x in xs]
        if self.legs == "blocks":
            return [box((0.25 * r, 1.0 * r, high), (x, 0, high / 2)) for x in xs]
        return [box((0.04, 0.04, low - 0.5 * r), (x, s * 0.7 * r, (low - 0.5 * r) / 2)) for x in xs for s in BOTH]

    def _block(self, t: Table, c: float, n: int) -> None:
        """Crankcase, cylinders with fins, heads, filters, each a piece, on z = 0."""
        case = (
            along("y", cylinder(c, -0.7 * c, 0.7 * c, n), 0, 0, c) if self.round_ else box((1.6 * c, 1.4 * c, 1.7 * c))
        )
        case = case if self.round_ else moved(case, at(0, 0, 0.85 * c))
        t.add(_NAME, case, of="pump")
        tilts = {"one": (0.0,), "two": (0.0, 0.0), "vee": (-0.65, 0.65)}[self.heads]
        for k, tilt in enumerate(tilts):
            y = 0.55 * c * (2 * k - 1) * (self.heads == "two")
            up, b = t.at(0, y, c).spun("y", tilt), 0.42 * c
            disc = [cylinder(1.4 * b, f * c, (f + 0.06) * c, n) for f in np.linspace(0.95, 1.5, self.fins)]
            up.add(_NAME, cylinder(b, 0.5 * c, 1.65 * c, n), *disc, of="pump")
            if self.capped:
                up.add(_NAME, box((2.2 * b, 2.2 * b, 0.4 * c), (0, 0, 1.8 * c)), of="pump")
            if self.filters:
                can = cylinder(0.3 * c, 0.9 * b, 0.9 * b + 0.4 * c, n)
                up.at(0, 0, 1.75 * c).along("-y").add("filter", can, of="rubber", own=True)

    def _guard(self, t: Table, one: tuple[float, float], two: tuple[float, float], r: float, y: float) -> None:
        """A belt guard over the wheel and the motor's pulley, in the plane of the belt."""
        if self.guard == "none":
            return
        (x0, z0), (x1, z1) = one, two
        reach, tilt = float(np.hypot(x1 - x0, z1 - z0)), float(np.arctan2(z1 - z0, x1 - x0))
        sheet = rounded_rectangle(reach + 2.2 * r, 2.2 * r, 1.05 * r if self.guard == "oval" else 0.0, 4)
        if self.guard == "half":
            sheet = np.array([(-reach / 2 - 1.1 * r, -1.1 * r), (reach / 2 + 0.7 * r, -0.6 * r)])
            sheet = np.vstack([sheet, [(reach / 2 + 0.7 * r, 0.6 * r), (-reach / 2 - 1.1 * r, 1.1 * r)]])
        flat = moved(extrude(sheet, -0.2 * r, 0.2 * r), spun("x", np.pi / 2) @ spun("z", tilt))
        t.at((x0 + x1) / 2, y, (z0 + z1) / 2).add("coupling guard", flat)


class OnReceiver(_OnReceiver, name="compressor/plain piston", weight=1.2):
    """A piston compressor on its receiver of plain shapes, as finely as the style has equipment."""


class PistonInPieces(_OnReceiver, name="compressor/piston in pieces", weight=1.5, grain="fitting"):
    """A piston compressor on its receiver of plain shapes, each a piece of its own."""


PLAIN_COMPRESSORS = families_of(Cabinet, CabinetInPieces, OnReceiver, PistonInPieces)
