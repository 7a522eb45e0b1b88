"""What plain machines are put together from: ports, motors, coupling guards and beds of a few simple shapes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device
from cadplants.builder.params import Params, When, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, PUMP, slab
from cadplants.model.family import Port
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle, section_channel
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, turned
from cadplants.solids.transforms import at, looking, spun

__all__ = [
    "BOLTED", "Faceted", "Ferrule", "PlainBed", "PlainGuard", "PlainMotor", "PlainPort", "PlainPump", "Threaded",
    "arched", "built_ports", "faced", "port_of",
]  # fmt: skip

BOLTED = ("flange", "flange", "disc", "hub")
_CLAMP = 0.0064  # m: thickness of a clamp's ferrule (DIN 32676)


class Faceted(Device):
    """A device whose circles may have fewer sides than the style gives them."""

    facets: int = among((0, 0, 0, 6, 8, 12, 16, 24), "most sides of its circles; 0: as the style has them")

    def n(self, t: Table, r: float) -> int:
        """Sides of a circle of this radius [m]."""
        return min(self.facets or 10_000, t.n(r))


class PlainPump(Faceted, group=PUMP, label="pump", bundle=CASING):
    """A pump of plain shapes."""


def faced(spot: Sequence[float], way: Sequence[float]) -> Floats:
    """The pose of what was built about z with its face at 0, at a point and looking some way [m]."""
    pose: Floats = looking(spot, way) @ spun("y", np.pi / 2)
    return pose


class PlainPort(Params):
    """A mouth of a machine: a neck with a flange, a plain disc, a hub, a hexagon, a clamp's ferrule, or nothing."""

    dn: int = given(0, "nominal size", "mm")
    form: str = among((*BOLTED, "stub", "thread"), "what is at its end")
    wide: float = between(1.0, 1.25, "radius of the neck / of the pipe")
    rim: float = between(0.9, 1.1, "radius of what is at its end / of a flange or ferrule")

    def build(self, t: Table, spot: Sequence[float], way: Sequence[float], reach: float, n: int) -> tuple[Solid, Port]:
        """Its solid and the port.

        Args:
            t: with the style.
            spot: middle of its face.
            way: where it looks.
            reach: length of the neck behind its face [m].
            n: sides of a circle.
        """
        solid = moved(merge(self._solids(reach, n, t.style.hollow)), faced(spot, way))
        return solid, Port(looking(spot, way), self.dn)

    def _solids(self, reach: float, n: int, hollow: bool) -> list[Solid]:
        pipe = PIPES[self.dn]
        r, bore, outer = pipe.radius * self.wide, pipe.bore if hollow else 0.0, 0.5 * FLANGES[self.dn].outer * self.rim
        thick = min(plate_thickness(self.dn), 0.6 * reach)
        neck = ring(bore, r, -reach, 0.0, n)
        if self.form == "thread":
            return [neck, hexagon(2.5 * r, -min(1.1 * r, 0.6 * reach), 0.0, bore, n)]
        if self.form == "clamp":
            rim = max(1.15, 1.45 * self.rim) * pipe.radius + 0.004
            return [neck, ring(bore, max(rim, 1.05 * r), -_CLAMP, 0.0, n)]
        if self.form == "flange":
            return [neck, ring(bore, outer, -thick, 0.0, n)]
        if self.form == "disc":
            return [neck, ring(bore, outer, -0.5 * thick, 0.0, n)]
        if self.form == "hub":
            cone = [(r, -min(reach, 2.2 * thick)), (0.62 * outer + 0.38 * r, -0.95 * thick)]
            return [neck, turned(cone, n, bore=bore), ring(bore, outer, -thick, 0.0, n)]
        return [neck]


def built_ports(
    t: Table, mouths: Sequence[PlainPort], spots: Sequence[Sequence[float]], way: Sequence[float], reach: float, n: int
) -> tuple[list[Solid], list[Port]]:
    """The solids and ports of mouths at some places that look one way; see ``PlainPort.build``."""
    made = [mouth.build(t, spot, way, reach, n) for mouth, spot in zip(mouths, spots, strict=True)]
    return [solid for solid, _ in made], [port for _, port in made]


class Threaded(PlainPort):
    """A mouth of a small machine: a hexagon or a stub."""

    form: str = among(("thread", "thread", "stub"), "what is at its end")


class Ferrule(PlainPort):
    """A clamp's ferrule on a neck (DIN 32676)."""

    form: str = given("clamp", "what is at its end")
    wide: float = given(1.0, "radius of the neck / of the pipe")


def port_of(
    dn: Callable[[Any], int], about: str, *, kind: type[PlainPort] = PlainPort, when: When | None = None
) -> PlainPort:
    """A mouth of a nominal size [mm] that follows from the other parameters; a parameter."""
    return nested(kind, about, fixed=lambda p: {"dn": dn(p)}, when=when)


# --- motors ---


class PlainMotor(Params):
    """An electric motor of a few shapes: a can with or without fins, a cap over its fan, a box for its cable."""

    frame: str = among(("can", "can", "fins", "ribs", "shields", "square"), "form of its frame")
    fins: int = whole(8, 32, "fins round it", when=lambda p: p.frame == "fins")
    tall: float = between(0.06, 0.16, "height of a fin / radius", when=lambda p: p.frame == "fins")
    cover: str = among(("cap", "cap", "taper", "dome", "step", "none"), "what is over its fan")
    covered: float = between(0.1, 0.3, "length of that cover / of the motor", when=lambda p: p.cover != "none")
    wide: float = between(0.93, 1.06, "radius of that cover / of the motor", when=lambda p: p.cover != "none")
    wired: bool = chance(0.8, "a terminal box")
    turn: int = among((0, 0, 1, -1), "quarter turns of the terminal box", when=lambda p: p.wired)
    place: float = between(0.2, 0.6, "middle of the terminal box / length", when=lambda p: p.wired)
    boxed: float = between(0.6, 1.3, "width of the terminal box / radius", when=lambda p: p.wired)
    deep: float = between(0.25, 0.6, "depth of the terminal box / radius", when=lambda p: p.wired)
    stretch: float = between(0.7, 1.5, "length of the terminal box / its width", when=lambda p: p.wired)
    drum: bool = chance(0.12, "the terminal box is round", when=lambda p: p.wired)
    feet: str = among(("blocks", "rails", "block", "sheets"), "what it stands on, where it stands")

    def build(self, t: Table, r: float, length: float, n: int, feet: float = 0.0) -> None:
        """Puts it down about z from 0, its fan end up, its top towards +x.

        Args:
            t: with the frame.
            r: radius [m].
            length: with the cover [m].
            n: sides of a circle.
            feet: height of the axis over its seat; 0 where it hangs on its flange [m].
        """
        t, end = t.bundled("motor"), length * (1 - self.covered)
        t.add("motor", *self._frame(r, end, n), *(self._feet(r, end, feet) if feet else []), own=True)
        if self.cover != "none":
            t.add("motor fan cover", self._cover(self.wide * r, end - 0.005, length, n), own=True)
        if self.wired:
            self._terminals(t.spun("z", self.turn * np.pi / 2), r, end, n)

    def _frame(self, r: float, end: float, n: int) -> list[Solid]:
        if self.frame == "can":
            return [cylinder(r, 0, end, n)]
        if self.frame == "square":
            return [extrude(rounded_rectangle(1.8 * r, 1.8 * r, 0.2 * r, 2), 0, end)]
        if self.frame == "fins":
            core = (1 - self.tall) * r
            fin = box((2 * self.tall * r, 0.05 * r, 0.86 * end), ((1 - self.tall) * r, 0, 0.5 * end))
            return [cylinder(core, 0, end, n), around(fin, self.fins)]
        rims = [cylinder(r, low * end, high * end, n) for low, high in ((0, 0.12), (0.88, 1))]
        if self.frame == "shields":
            return [cylinder(0.9 * r, 0, end, n), *rims]
        rings = [cylinder(r, z * end, (z + 0.05) * end, n) for z in (0.15, 0.3, 0.45, 0.6, 0.75)]
        return [cylinder(0.9 * r, 0, end, n), *rims, *rings]

    def _cover(self, r: float, low: float, high: float, n: int) -> Solid:
        mid = (low + high) / 2
        if self.cover == "dome":
            return merge([cylinder(r, low, mid, n), dome(r, high - mid, mid - 0.001, n)])
        shapes = {
            "cap": outline(r, low, r, high),
            "taper": outline(r, low, r, mid, 0.72 * r, high),
            "step": outline(r, low, r, mid, 0.8 * r, mid, 0.8 * r, high),
        }
        return turned(shapes[self.cover], n)

    def _terminals(self, t: Table, r: float, end: float, n: int) -> None:
        wide, z, top = self.boxed * r, self.place * end, (0.85 + self.deep) * r
        if self.drum:
            t.add("terminal box", along("x", cylinder(0.5 * wide, 0.8 * r, top, n), 0, 0, z), own=True)
            return
        size = (top - 0.8 * r, wide, min(self.stretch * wide, 0.8 * end))
        t.add("terminal box", box(size, ((top + 0.8 * r) / 2, 0, z)), own=True)

    def _feet(self, r: float, end: float, feet: float) -> list[Solid]:
        tall = feet - 0.6 * r
        mid, thin = -feet + tall / 2, 0.1 * r
        if self.feet == "block":
            return [box((tall, 1.3 * r, 0.6 * end), (mid, 0, 0.5 * end))]
        if self.feet == "sheets":
            return [box((tall, 1.7 * r, 0.06 * end), (mid, 0, z * end)) for z in (0.2, 0.8)]
        if self.feet == "rails":
            return [box((tall, 0.3 * r, 0.7 * end), (mid, s * 0.62 * r, 0.5 * end)) for s in BOTH]
        spots = [(s * 0.68 * r, z * end) for s in BOTH for z in (0.2, 0.78)]
        pads = [box((thin, 0.6 * r, 0.2 * end), (thin / 2 - feet, y * 1.2, z)) for y, z in spots]
        return [*pads, *(box((tall, 0.25 * r, 0.16 * end), (mid, y, z)) for y, z in spots)]


# --- over the coupling ---


def arched(r: float, below: float, steps: int) -> Floats:
    """An arch over the axis with its legs down, in (y, z) [m]."""
    a = np.linspace(0, np.pi, steps)
    legs = [(r, -below)], [(-r, -below)]
    return np.vstack([legs[0], r * np.column_stack([np.cos(a), np.sin(a)]), legs[1]])


class PlainGuard(Params):
    """A coupling guard of one simple shape, full or of sheet (EN ISO 14120)."""

    form: str = among(
        ("cylinder", "cylinder", "tube", "half drum", "hood", "hood", "sheet", "box", "open box", "shell", "roof"),
        "its shape",
    )
    wide: float = between(0.3, 0.95, "radius / of the motor")
    share: float = between(0.62, 1.1, "length / of the gap")
    legs: float = between(0.15, 1.0, "how far its legs come down / height of the axis over the seat")
    footed: bool = chance(0.3, "a foot below it", when=lambda p: p.form in ("cylinder", "tube", "half drum"))
    flanged: bool = chance(0.25, "lips along its legs", when=lambda p: p.form in ("hood", "sheet", "open box"))
    rimmed: bool = chance(0.2, "rims at both ends", when=lambda p: p.form in ("cylinder", "tube"))

    def build(self, t: Table, x0: float, x1: float, axis: float, seat: float, r: float, n: int) -> None:
        """Puts it down over a shaft along x between two places.

        Args:
            t: with the frame.
            x0: where the gap begins [m].
            x1: where it ends [m].
            axis: height of the shaft [m].
            seat: height of what it stands on [m].
            r: radius of the motor [m].
            n: sides of a circle.
        """
        mid, half = (x0 + x1) / 2, self.share * (x1 - x0) / 2
        wide = min(self.wide * r, 0.95 * (axis - seat))
        solids = [moved(one, at(0, 0, axis)) for one in self._solids(mid - half, mid + half, wide, axis - seat, n)]
        if self.footed and axis - wide > seat:
            tall = axis - (0.0 if self.form == "half drum" else 0.9 * wide) - seat
            solids.append(box((0.6 * half, 0.8 * wide, tall), (mid, 0, seat + tall / 2)))
        t.add("coupling guard", *solids, own=False)

    def _solids(self, x0: float, x1: float, r: float, high: float, n: int) -> list[Solid]:
        """About the axis along x."""
        length, mid = x1 - x0, (x0 + x1) / 2
        thin, below, steps = max(0.0015, 0.05 * r), self.legs * high, max(4, n // 2 + 1)
        if self.form in ("cylinder", "tube"):
            inner = r - thin if self.form == "tube" else 0.0
            rims = [ring(inner, 1.12 * r, z, z + 0.08 * length, n) for z in (0.0, 0.92 * length)]
            drum = [ring(inner, r, 0.0, length, n), *(rims if self.rimmed else [])]
            return [along("x", one, x0) for one in drum]
        if self.form == "half drum":
            return [slab(arched(r, 0.0, steps)[1:-1], x0, x1)]
        if self.form == "box":
            return [box((length, 2 * r, r + below), (mid, 0, (r - below) / 2))]
        if self.form == "hood":
            return [slab(arched(r, below, steps), x0, x1), *self._lips(mid, length, r, below, thin)]
        if self.form == "roof":
            line = outline(r, -below, r, 0.25 * r, 0.45 * r, r, -0.45 * r, r, -r, 0.25 * r, -r, -below)
            return [slab(np.array(line), x0, x1)]
        square = np.array(outline(r, -below, r, r, -r, r, -r, -below))
        outer = square if self.form == "open box" else arched(r, 0.0 if self.form == "shell" else below, steps)
        outer = outer[1:-1] if self.form == "shell" else outer
        inner_line = outer * (1 - thin / r)
        inner_line[[0, -1], 1] = outer[[0, -1], 1]
        sheet = slab(np.vstack([outer, inner_line[::-1]]), x0, x1)
        return [sheet, *self._lips(mid, length, r, below, thin)]

    def _lips(self, mid: float, length: float, r: float, below: float, thin: float) -> list[Solid]:
        if not self.flanged:
            return []
        return [box((length, 0.35 * r, thin), (mid, s * 1.15 * r, thin / 2 - below)) for s in BOTH]


# --- below it ---


class PlainBed(Params):
    """What a machine stands on: a slab, two channels, a frame, a tray, a block of concrete, or nothing."""

    form: str = among(("slab", "slab", "channels", "frame", "tray", "beams", "block", "pads"), "its form")
    high: float = between(0.02, 0.16, "height", "m")
    more: float = between(0.0, 0.12, "how far it stands out on each side", "m")
    block: float = among((0.0, 0.0, 0.0, 0.0, 0.08, 0.15, 0.3, 0.5), "height of concrete below", "m")

    @property
    def seat(self) -> float:
        """Height of its top [m]."""
        return self.block + self.high

    def build(self, t: Table, x0: float, x1: float, wide: float) -> None:
        """Puts it down below what reaches from one place along x to another and is this wide [m]."""
        mid, length, wide = (x0 + x1) / 2, x1 - x0 + 2 * self.more, wide + 2 * self.more
        solids = self._solids(length, wide, self.high)
        name = "foundation" if self.form == "block" else "pump base"
        t.at(mid, 0, self.block).add(name, *solids, own=False)
        if self.block:
            size = (length + 0.15, wide + 0.15, self.block)
            t.at(mid).add("foundation", box(size, (0, 0, self.block / 2)))

    def _solids(self, length: float, wide: float, high: float) -> list[Solid]:
        if self.form in ("slab", "block"):
            return [box((length, wide, high), (0, 0, high / 2))]
        if self.form == "pads":
            size = (0.16 * length, wide, high)
            return [box(size, (x * length, 0, high / 2)) for x in (-0.4, 0.0, 0.4)]
        thin = min(0.012, 0.3 * high)
        lid = box((length, wide, thin), (0, 0, high - thin / 2))
        side = [box((length, thin, high), (0, s * (wide - thin) / 2, high / 2)) for s in BOTH]
        if self.form == "tray":
            return [lid, *side]
        if self.form == "frame":
            bar = 0.12 * wide
            long = [box((length, bar, high), (0, s * (wide - bar) / 2, high / 2)) for s in BOTH]
            return [*long, *(box((bar, wide - 2 * bar, high), (x * length, 0, high / 2)) for x in (-0.42, 0.0, 0.42))]
        if self.form == "beams":
            return [box((length, 0.2 * wide, high), (0, s * 0.32 * wide, high / 2)) for s in BOTH]
        rail = slab(section_channel(high - thin, 0.35 * high + 0.01, thin, thin), -length / 2, length / 2)
        rails = [moved(rail, at(0, s * wide / 2, (high - thin) / 2) @ spun("z", a)) for s, a in ((-1, 0.0), (1, np.pi))]
        return [lid, *rails]
