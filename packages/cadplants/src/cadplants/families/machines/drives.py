"""What machines are placed together from: motors and their covers, couplings, guards, bases, volutes, mouths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device
from cadplants.builder.params import P, Params, When, among, between, chance, given, nested, styled
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import disc_flange
from cadplants.model.family import Port
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle, section_channel, section_i
from cadplants.solids.primitives import (
    BOTH,
    along,
    around,
    box,
    cylinder,
    hexagon,
    lofted,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "BASES", "CASING", "GUARDS", "LYING", "MOTORS", "PUMP", "Driven", "Motor", "Pump", "Train",
    "anchors", "base", "corners", "dead_room", "driven", "mouth", "slab", "volute",
]  # fmt: skip

CASING = "pump casing"
PUMP = "Pump unit"
LYING: Floats = spun("y", np.pi / 2) @ spun("z", np.pi)  # a motor's z to x, its x up
MOTORS = ("cast", "cast", "square", "smooth", "drip", "ex")
GUARDS = ("hood", "roof", "box", "tube", "mesh", "halves")
BASES = ("grid", "beams", "plinth", "sheet", "rim")

_COVERS = ("domed", "mesh", "flat", "stepped", "hat")
_FINE = 12  # sides of a circle, from which motors have all their fins; each is large enough for them


class Driven(Device):
    """A machine with a motor."""

    sides: tuple[int, int] = styled((16, 48), "least and most sides of a circle")


class Pump(Driven, group=PUMP, label="pump", bundle=CASING):
    """A pump with its motor."""


def _frame_of(machine: Any) -> dict[str, str]:
    """What is set of the motor's frame: nothing where a machine has no field ``frame``, or an ``"other"``."""
    frame = getattr(machine, "frame", "other")
    return {} if frame == "other" else {"frame": frame}


def driven(kind: type[P], about: str, *, when: When | None = None, **said: Any) -> P:
    """The field of a machine that has a motor, made as the machine's field ``frame`` says, if it has one.

    Args:
        kind: the class of a motor or of what has one.
        about: what it is.
        when: whether the machine has it.
        said: what else is set of it.
    """
    return nested(kind, about, fixed=lambda p: {"fine": p.sides[1] >= _FINE, **said, **_frame_of(p)}, when=when)


def corners(x: float, y: float) -> list[tuple[float, float]]:
    """The corners of a rectangle about the origin, by half its sides [m]."""
    return [(sx * x, sy * y) for sx in BOTH for sy in BOTH]


def dead_room(dn: int) -> float:
    """Least length of a mouth behind whose flange nuts have room [m]."""
    return plate_thickness(dn) + nut_room(dn) + 0.01


def mouth(
    dn: int, style: ModelingStyle, face: Sequence[float], way: Sequence[float], reach: float
) -> tuple[Solid, Port]:
    """A flange at a point that looks some way, its neck ``reach`` [m] long behind it; and the port."""
    frame = looking(face, way)
    return moved(disc_flange(dn, style, reach), frame @ spun("y", -np.pi / 2)), Port(frame, dn)


def slab(sheet: Floats, low: float, high: float) -> Solid:
    """A prism along x over an outline in (y, z)."""
    return about_x(extrude(sheet, low, high))


def volute(r: float, half: float, style: ModelingStyle, growth: float = 0.35, hub: float = 0.6) -> Solid:
    """A spiral housing about z that widens by ``growth``, ``half`` of its width to each side [m]."""
    a = np.linspace(0, 2 * np.pi, max(16, style.round(r)), endpoint=False)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    rim = (r * (1 + growth * a / (2 * np.pi)))[:, None]
    loops = []
    for share, z in outline(0, -1, 0.55, -0.92, 1, -0.45, 1, 0.45, 0.55, 0.92, 0, 1):
        radius = hub * r + share * (rim - hub * r)
        loops.append(np.column_stack([radius * unit, np.full(len(a), z * half)]))
    return lofted(loops)


# --- motors ---


def _crossed(wide: float, thick: float, places: Floats, low: float, high: float) -> list[Solid]:
    """Pairs of plates along z between two heights, upright and level, each as wide as fits."""
    mid, long = (low + high) / 2, high - low
    return [
        box(size, (x, y, mid))
        for p in places
        for size, x, y in (((wide, thick, long), 0, p), ((thick, wide, long), p, 0))
    ]


class TerminalBox(Params):
    """A terminal box on a motor: with lid, inclined, round-lidded, or with glands."""

    place: float = between(0.25, 0.5, "place along the motor / the motor's length")
    wide: float = between(0.55, 1.0, "width / the motor's radius")
    deep: float = between(0.3, 0.6, "depth / the motor's radius")
    long: float = between(0.8, 1.3, "length / width")

    def solid(self, lid: str, r: float, length: float, style: ModelingStyle) -> Solid:
        """The box on the +x side of a motor about z [m]."""
        z, wide, deep = self.place * length, self.wide * r, self.deep * r
        long, top = self.long * wide, 0.8 * r + deep
        case = extrude(rounded_rectangle(wide, long, 0.12 * wide, 2), 0.0, deep)
        case = moved(case, at(0.8 * r, 0, z) @ LYING)
        gland = merge([hexagon(0.22 * r, 0, 0.07 * r), cylinder(0.08 * r, 0, 0.2 * r, 8)])
        glands = [along("y", gland, 0.8 * r + 0.55 * deep, long / 2, z + s * 0.22 * wide) for s in BOTH]
        if lid == "round":
            cap = turned(outline(0.42 * wide, 0, 0.45 * wide, 0.04 * r, 0.4 * wide, 0.22 * r), style.round(wide))
            return merge([case, along("x", cap, top, 0, z), *glands])
        plate = box((0.1 * r, 1.06 * long, 1.06 * wide), (top + 0.05 * r, 0, z))
        if lid == "inclined":
            return merge([case, moved(plate, at(top, 0, z) @ spun("z", 0.25) @ at(-top, 0, -z)), *glands[:1]])
        screw = hexagon(0.08 * r, 0, 0.04 * r)
        screws = [along("x", screw, top + 0.1 * r, y, z + dz) for y, dz in corners(0.45 * long, 0.45 * wide)]
        return merge([case, plate, *screws, *(glands if lid == "glands" else [])])


def _air_cooled(p: Any) -> bool:
    return bool(p.frame != "cooled")


def _fitted(p: Any) -> bool:
    return _air_cooled(p) and not p.bare


class Motor(Params):
    """An electric motor (IEC 60072 and NEMA MG 1 proportions)."""

    standing: bool = given(False, "whether it stands on feet rather than hangs on its flange")
    bare: bool = given(False, "whether it is without its terminal box and what else is on it")
    fine: bool = given(True, "whether it is modelled with all its fins")
    frame: str = among(MOTORS, "how its frame is made")
    cooler: float = between(0.5, 0.9, "height of the cooler on it / radius", when=lambda p: p.frame == "cooled")
    cover: str = among(
        lambda p: _COVERS[:4] if p.standing else _COVERS, "form of its fan cover", when=_air_cooled, otherwise=""
    )
    turn: int = among((0, 0, 0, 1, -1), "quarter turns of its terminal box", when=_fitted, otherwise=0)
    lid: str = among(
        ("plain", "inclined", "glands", "round"),
        "form of its terminal box",
        when=lambda p: _fitted(p) and p.frame != "ex",
        otherwise="round",
    )
    fins: int = among(
        lambda p: (12, 16, 24) if p.frame == "ex" else (5, 7, 9),
        "fins round it, or on each side",
        when=lambda p: p.frame == "ex" or (p.frame == "cast" and p.fine),
        otherwise=3,
    )
    terminals: TerminalBox = nested(TerminalBox, "terminal box", when=_fitted)
    pads: bool = chance(0.5, "its feet are pads with webs", when=lambda p: p.standing and _air_cooled(p))
    eye: bool = chance(0.35, "a lifting eye sits on it", when=_fitted)

    def build(self, t: Table, r: float, length: float, feet: float = 0.0) -> None:
        """Puts it down about z from 0, its fan end up, its top towards +x.

        Args:
            t: with the frame.
            r: radius over the fins [m].
            length: with the fan cover [m].
            feet: height of the axis over its seat; 0 for one mounted by its flange [m].
        """
        t = t.bundled("motor")
        if self.frame == "cooled":
            self._cooled(t, r, length, feet)
        else:
            frame = [self._frame(r, length, t.style), *(self._feet(r, length, feet) if feet else [])]
            t.add("motor", *frame, own=True)
            t.add("motor fan cover", self._hood(r, length, t.style), of="motor", own=True)
            if self.bare:
                return
            terminals = self.terminals.solid(self.lid, r, length, t.style)
            t.spun("z", self.turn * np.pi / 2).add("terminal box", terminals, own=True)
        t.add("shaft", cylinder(0.15 * r, -0.3 * r, 0.04 * length, 12), own=True)
        if self.eye:
            eye = moved(torus(0.15 * r, 0.04 * r, 12, 6), at(1.12 * r, 0, 0.7 * length) @ spun("x", np.pi / 2))
            stud = along("x", cylinder(0.06 * r, 0.8 * r, 0.97 * r, 8), 0, 0, 0.7 * length)
            t.add("lifting lug", eye, stud, of="fastener", own=True, fine=True)

    def _frame(self, r: float, length: float, style: ModelingStyle) -> Solid:
        """The motor without cover and boxes, from 0 to 0.8 of its length."""
        n, low, high = style.round(r), 0.08 * length, 0.8 * length
        nose = turned(outline(0.45 * r, 0, 0.88 * r, 0.04 * length, 0.97 * r, 0.05 * length, 0.97 * r, low + 0.02), n)
        if self.frame == "cast":  # fins upright above and below, level at the sides
            thick, fins = max(0.002, 0.035 * r), []
            for y in np.linspace(-0.62, 0.62, self.fins) * r:
                fins += _crossed(2 * float(np.sqrt(r * r - y * y)), thick, np.array([y]), low, 0.95 * high)
            return merge([nose, cylinder(0.84 * r, low, high, n), *fins, cylinder(0.97 * r, 0.95 * high, high, n)])
        if self.frame == "square":
            core = extrude(rounded_rectangle(1.66 * r, 1.66 * r, 0.3 * r, 3), low, high)
            pitch, mid, half = (
                np.linspace(-0.55, 0.55, 7 if n >= _FINE else 4) * r,
                (low + high) / 2,
                0.45 * (high - low),
            )
            fins = _crossed(1.86 * r, 0.04 * r, pitch, mid - half, mid + half)
            plate = extrude(rounded_rectangle(1.86 * r, 1.86 * r, 0.25 * r, 3), 0.02 * length, low)
            return merge([plate, core, *fins[::2], *fins[1::2], cylinder(0.5 * r, 0, 0.03 * length, n)])
        if self.frame == "smooth":
            ends = [cylinder(1.0 * r, low, low + 0.05 * length, n), cylinder(1.0 * r, high - 0.05 * length, high, n)]
            return merge([nose, cylinder(0.94 * r, low, high, n), *ends])
        if self.frame == "drip":
            bell = turned(outline(0.93 * r, 0.72 * length, 0.93 * r, high, 0.5 * r, high), n)
            bars = [
                moved(around(box((0.06 * r, 0.2 * r, 0.12 * length), (0.93 * r, 0, z * length)), 10), spun("z", 0.3))
                for z in (0.13, 0.7)
            ]
            drums = [cylinder(r, 0.18 * length, 0.68 * length, n), cylinder(0.8 * r, 0.05 * length, 0.75 * length, n)]
            return merge([nose, *drums, bell, *bars])
        ribs = around(box((0.2 * r, 0.06 * r, high - low), (0.92 * r, 0, (low + high) / 2)), self.fins)
        lips = [cylinder(1.06 * r, z * length, (z + 0.035) * length, n) for z in (0.09, 0.125, 0.75)]
        heads = around(hexagon(0.12 * r, 0.07 * length, 0.092 * length), 8, 0.96 * r)
        return merge([nose, cylinder(0.86 * r, low, high, n), ribs, *lips, heads])

    def _hood(self, r: float, length: float, style: ModelingStyle) -> Solid:
        """The fan cover: domed, meshed, slotted, stepped or under a rain hat."""
        if self.frame == "square" and self.cover == "flat":
            hood = extrude(rounded_rectangle(1.9 * r, 1.9 * r, 0.3 * r, 3), 0.8 * length, 0.97 * length)
            grill = [cylinder(k * r, 0.97 * length, (0.99 - 0.004 * k) * length, style.round(r)) for k in (0.8, 0.5)]
            return merge([hood, *grill])
        r, low, high = (1.02 if self.frame == "cast" else 1.0) * r, 0.8 * length, length
        n = style.round(r)
        if self.cover == "domed":
            dome = outline(r, low, r, high - 0.35 * r, 0.93 * r, high - 0.15 * r, 0.7 * r, high - 0.03 * r)
            return turned([*dome, (0.45 * r, high)], n)
        if self.cover == "hat":
            posts = around(box((0.05 * r, 0.05 * r, 0.3 * r), (0.85 * r, 0, high + 0.1 * r)), 4)
            lid = outline(1.1 * r, high + 0.2 * r, 1.1 * r, high + 0.23 * r, 0.3 * r, high + 0.4 * r)
            return merge([turned(outline(r, low, r, high - 0.1 * r, 0.9 * r, high), n), posts, turned(lid, n)])
        if self.cover == "stepped":
            ribs = around(box((0.5 * r, 0.06 * r, 0.05 * r), (0.5 * r, 0, high)), 8)
            steps = outline(r, low, r, high - 0.4 * r, 0.82 * r, high - 0.35 * r, 0.82 * r, high)
            return merge([turned(steps, n), ribs])
        cup, floor = ring(0.96 * r, r, low, high, n), cylinder(0.97 * r, low, low + 0.01, n)
        if self.cover == "mesh":
            hoops = [moved(torus(k * r, 0.018 * r, n, 4), at(0, 0, high)) for k in (0.22, 0.4, 0.58, 0.76, 0.93)]
            bar = box((1.94 * r, 0.05 * r, 0.03 * r), (0, 0, high))
            return merge([cup, floor, *hoops, *(moved(bar, spun("z", a)) for a in (0.0, np.pi / 3, -np.pi / 3))])
        slots = [
            box((2 * float(np.sqrt(0.95 * r * r - y * y)), 0.06 * r, 0.02 * r), (0, y, high - 0.01 * r))
            for y in np.linspace(-0.8, 0.8, 9) * r
        ]
        return merge([cup, floor, *slots, box((0.08 * r, 1.9 * r, 0.02 * r), (0, 0, high - 0.01 * r))])

    def _feet(self, r: float, length: float, feet: float) -> list[Solid]:
        """Feet from below the frame down to the seat: pads with webs, or two rails under a cradle."""
        low, wide = -feet, 0.85 * r
        if self.pads:
            spots = [(s, z * length) for s in BOTH for z in (0.2, 0.66)]
            pads = [box((0.1 * r, 0.5 * r, 0.16 * length), (low + 0.05 * r, s * wide, z)) for s, z in spots]
            web = (feet - 0.4 * r, 0.12 * r, 0.12 * length)
            return [*pads, *(box(web, ((low - 0.4 * r) / 2, s * 0.7 * r, z)) for s, z in spots)]
        rails = [box((0.12 * r, 0.45 * r, 0.6 * length), (low + 0.06 * r, s * wide, 0.44 * length)) for s in BOTH]
        cradle = (feet - 0.55 * r, 1.5 * r, 0.06 * length)
        return [*rails, *(box(cradle, ((low - 0.55 * r) / 2, 0, z * length)) for z in (0.25, 0.62))]

    def _cooled(self, t: Table, r: float, length: float, feet: float) -> None:
        """A large motor (IC 611): a boxed frame with an air-to-air cooler on top, a big terminal box at its side."""
        n, tall = t.n(r), self.cooler * r
        frame = box((2 * r, 1.9 * r, 0.86 * length), (0, 0, 0.47 * length))
        shields = [cylinder(0.8 * r, z, z + 0.05 * length, n) for z in (0.0, 0.9 * length)]
        ribs = [box((1.6 * r, 1.94 * r, 0.02 * length), (-0.1 * r, 0, z * length)) for z in (0.2, 0.47, 0.74)]
        foot = (feet - r, 0.4 * r, 0.8 * length)
        legs = [box(foot, (-(feet + r) / 2, s * 0.85 * r, 0.47 * length)) for s in BOTH] if feet > r else []
        t.add("motor", frame, *shields, *ribs, *legs, own=True)
        cooler = box((tall, 1.7 * r, 0.8 * length), (r + tall / 2, 0, 0.48 * length))
        ends = [box((tall, 1.6 * r, 0.06 * length), (r + tall / 2, 0, z * length)) for z in (0.05, 0.91)]
        t.add("motor", cooler, *ends, own=True)
        hood = outline(0.75 * r, 0.92 * length, 0.75 * r, length, 0.6 * r, 1.03 * length)
        t.add("motor fan cover", turned(hood, n), own=True)
        side = box((0.9 * r, 0.6 * r, 0.35 * length), (0.1 * r, 1.25 * r, 0.45 * length))
        lid = box((0.96 * r, 0.05 * r, 0.38 * length), (0.1 * r, 1.57 * r, 0.45 * length))
        t.add("terminal box", side, lid, of="electrical", own=True)


# --- between motor and machine ---


class Train(Params):
    """Coupling, guard and motor behind a machine's shaft."""

    fine: bool = given(True, "whether its motor is modelled with all its fins")
    frame: str = given("other", "how the motor's frame is made, where that is said")
    gap: float = between(0.7, 1.4, "from shaft to shaft / radius of the motor")
    slender: float = between(2.5, 3.6, "length of the motor / its radius")
    guarded: bool = chance(0.85, "a guard over the coupling")
    guard: str = among(GUARDS, "form of the guard", when=lambda p: p.guarded, otherwise="")
    motor: Motor = nested(
        Motor,
        "motor",
        fixed=lambda p: {"standing": True, "fine": p.fine, **_frame_of(p)},
    )

    def build(self, t: Table, x: float, axis: float, seat: float, r: float) -> tuple[float, list[float]]:
        """Puts it down behind a shaft along x.

        Args:
            t: with the frame.
            x: where the shaft ends [m].
            axis: height of the shaft [m].
            seat: height of what the motor stands on [m].
            r: radius of the motor [m].

        Returns:
            Where the motor ends, and where along x something stands.
        """
        gap, length = self.gap * r, self.slender * r
        far = x + gap
        shaft = _coupling(0.42 * r, far - 0.05 * gap - (x + 0.02 * gap), t.style)
        t.at(x + 0.02 * gap, 0, axis).along("x").bundled(CASING).add("shaft", shaft, own=True)
        if self.guarded:
            hood = _guard(self.guard, 0.56 * r, x + 0.04 * gap, far - 0.04 * gap, axis, seat, t.style)
            t.add("coupling guard", *hood, own=False)
        self.motor.build(t.at(far, 0, axis).moved(LYING), r, length, axis - seat)
        return far + length, [x + gap / 2, far + 0.2 * length, far + 0.66 * length]


def _coupling(r: float, length: float, style: ModelingStyle) -> Solid:
    """A spacer coupling about z from 0: two hubs with flanges, a tube between [m]."""
    hubs = outline(0.45, 0, 0.45, 0.2, 1, 0.2, 1, 0.34, 0.5, 0.34)
    whole = [*hubs, *((a, 1 - b) for a, b in hubs[::-1])]
    return turned([(a * r, b * length) for a, b in whole], style.round(r))


def _arch(r: float, below: float, steps: int) -> Floats:
    """An arch over a shaft and its legs down, in (y, z)."""
    a = np.linspace(0, np.pi, steps)
    return np.vstack([[(r, -below)], r * np.column_stack([np.cos(a), np.sin(a)]), [(-r, -below)]])


def _guard(kind: str, r: float, x0: float, x1: float, axis: float, seat: float, style: ModelingStyle) -> list[Solid]:
    """A coupling guard (EN ISO 14120) from its seat over the shaft: hood, roof, box, mesh, slotted or tube."""
    below, thin, length, mid = axis - seat, max(0.0015, 0.02 * r), x1 - x0, (x0 + x1) / 2
    n = max(8, style.round(r))
    if kind == "hood":
        sheet = np.vstack([_arch(r, below, n), _arch(r - thin, below, n)[::-1]])
        feet = [box((length, 0.25 * r, thin), (mid, s * 1.12 * r, seat + thin / 2)) for s in BOTH]
        return [moved(slab(sheet, x0, x1), at(0, 0, axis)), *feet]
    if kind == "roof":
        line = np.array([(r, -below), (r, 0.3 * r), (0.5 * r, r), (-0.5 * r, r), (-r, 0.3 * r), (-r, -below)])
        inner = line * (1 - thin / r)
        inner[[0, -1], 1] = -below
        return [moved(slab(np.vstack([line, inner[::-1]]), x0, x1), at(0, 0, axis))]
    if kind == "box":
        walls = [box((length, thin, below + r), (mid, s * (r - thin / 2), (seat + axis + r) / 2)) for s in BOTH]
        ends = [box((thin, 2 * r, r - 0.45 * r), (x, 0, axis + 0.725 * r)) for x in (x0 + thin / 2, x1 - thin / 2)]
        slots = [box((0.7 * length, 2 * r + 0.006, 0.06 * r), (mid, 0, axis + z * r)) for z in (-0.4, -0.1, 0.2, 0.5)]
        lid = box((length, 2 * r, thin), (mid, 0, axis + r - thin / 2))
        return [*walls, *ends, lid, *slots[: 2 + n % 3]]
    if kind == "tube":
        hoops = [ring(r - thin, 1.12 * r, z, z + 0.06 * length, n) for z in (0.0, 0.94 * length)]
        stay = box((0.1 * length, 0.5 * r, below - 0.95 * r), (mid, 0, (seat + axis - 0.95 * r) / 2))
        shell = along("x", merge([ring(r - thin, r, 0, length, n), *hoops]), x0, 0, axis)
        return [shell, stay] if below > 1.1 * r else [shell]
    return _caged(kind == "halves", r, (x0, x1), axis, seat)


def _caged(halved: bool, r: float, ends: tuple[float, float], axis: float, seat: float) -> list[Solid]:
    """A guard of wires, maybe in two halves with a rib where they meet."""
    (x0, x1), below, thin = ends, axis - seat, max(0.0015, 0.02 * r)
    length, mid, wire = x1 - x0, (x0 + x1) / 2, max(0.0015, 0.03 * r)
    solids = [
        rope([(x, y, axis + z) for y, z in _arch(r, below, 9)], wire, 5)
        for x in np.linspace(x0 + wire, x1 - wire, int(np.clip(length / (0.22 * r), 4, 10)))
    ]
    for a in np.linspace(0, np.pi, 9):
        y, z = r * np.cos(a), axis + r * np.sin(a)
        solids.append(rod((x0, y, z), (x1, y, z), wire, 5))
    solids += [box((length, 0.12 * r, thin + 0.003), (mid, s * r, seat + (thin + 0.003) / 2)) for s in BOTH]
    if halved:
        solids.append(box((length, 0.02 * r + 0.002, 0.2 * r), (mid, 0, axis + r)))
    return solids


# --- below them ---


def _rails(kind: str, x0: float, x1: float, width: float, height: float, stations: Sequence[float]) -> list[Solid]:
    """An open grid of channels or two beams, with members at stations."""
    if kind == "grid":
        long = slab(section_channel(height, 0.45 * height + 0.01, 0.006, 0.009), x0, x1)
        left = moved(long, at(0, -width / 2, height / 2))
        right = moved(long, at(x0 + x1, width / 2, height / 2) @ spun("z", np.pi))
        return [left, right, *(box((0.09, width - 0.014, 0.8 * height), (x, 0, 0.6 * height)) for x in stations)]
    beam = slab(section_i(height - 0.014, 0.6 * height + 0.02, 0.006, 0.009), x0, x1)
    beams = [moved(beam, at(0, s * 0.42 * width, (height - 0.014) / 2)) for s in BOTH]
    return [*beams, *(box((0.16, width, 0.014), (x, 0, height - 0.007)) for x in stations)]


def _sheet(x0: float, x1: float, width: float, height: float) -> list[Solid]:
    """A bent sheet with end plates."""
    w, thin, lip = width / 2, 0.006, min(0.04, 0.3 * width)
    left = outline(-w, height, -w, 0, lip - w, 0, lip - w, thin, thin - w, thin, thin - w, height - thin)
    fold = slab(np.array([*left, *((-y, z) for y, z in left[::-1])]), x0, x1)
    ends = [box((thin, 2 * w - 2.2 * thin, 0.7 * height), (x, 0, 0.63 * height)) for x in (x0 + 0.02, x1 - 0.02)]
    return [fold, *ends]


def base(
    t: Table,
    kind: str,
    x0: float,
    x1: float,
    width: float,
    height: float,
    stations: Sequence[float],
    name: str = "pump base",
) -> None:
    """Puts down a base frame: open grid, beams, plinth, bent sheet, drip rim.

    Args:
        t: with the frame.
        kind: one of ``BASES``.
        x0: where it begins [m].
        x1: where it ends [m].
        width: [m].
        height: of its top [m].
        stations: where along x members go across [m].
        name: what it is.
    """
    mid, length = (x0 + x1) / 2, x1 - x0
    if kind in ("grid", "beams"):
        t.add(name, *_rails(kind, x0, x1, width, height, stations), own=False)
    elif kind == "plinth":
        plate = extrude(rounded_rectangle(length, width, 0.03, 3), height - 0.03, height)
        t.at(mid).add(name, plate, own=False)
        block = box((length + 0.2, width + 0.2, height - 0.03), (mid, 0, (height - 0.03) / 2))
        t.add("foundation", block)
    elif kind == "sheet":
        t.add(name, *_sheet(x0, x1, width, height), own=False)
    else:
        inner = rounded_rectangle(length, width, 0.05 * width, 3)
        outer = rounded_rectangle(length + 0.06, width + 0.06, 0.05 * width + 0.03, 3)
        rim = extrude(outer, 0.6 * height, height + 0.012, (inner,))
        t.at(mid).add(name, extrude(inner, 0.0, height), rim, own=False)


def anchors(t: Table, places: Sequence[tuple[float, float]], seat: float, size: float = 0.014) -> None:
    """Foundation bolts through what lies on a seat, washers and nuts at a height [m]."""
    one = merge([cylinder(size / 2, seat - 0.03, seat + 2.2 * size, 8), hexagon(1.7 * size, seat, seat + 0.8 * size)])
    for x, y in places:
        t.at(x, y).add("bolt", one, own=False)
