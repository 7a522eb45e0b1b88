"""What instruments are put together from: dials with their cases, connections, heads of transmitters, cable glands.

Each is built in the frame of a table: a dial about z with its front towards +z, what stands on something about z.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.params import Params, among, between, chance, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.model.plant import Turning
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, rope, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "CASE", "CASES", "STEM", "Dial", "DialFace", "Gland", "Housing", "Indicator", "Needle", "Shank", "StandingGauge",
    "case_of", "fine_sides", "upright",
]  # fmt: skip

CASE, STEM = "gauge case", "gauge stem"
CASES = ("plain", "safety", "crimped", "cast", "bayonet", "turret")
"""How round cases are made (EN 837-1)."""

_UPRIGHT = spun("x", np.pi / 2)  # what looks to +z then looks to -y, its y axis up


def fine_sides(radius: float, style: ModelingStyle, most: int = 16) -> int:
    """Sides of a small round thing."""
    return max(6, min(most, style.round(radius)))


# The outside of each case, from its back to its front, as radius / case radius and height / depth.
_OUTSIDES: dict[str, list[tuple[float, float]]] = {
    "plain": outline(0.9, 0, 1, 0.06, 1, 0.76, 1.06, 0.78, 1.06, 0.97, 1.03, 1),
    "safety": outline(0.96, 0, 1, 0.03, 1, 0.86, 1.07, 0.87, 1.07, 1),
    "crimped": outline(0.8, 0, 0.94, 0.05, 1, 0.2, 1, 0.62, 1.05, 0.74, 1.06, 0.9, 1, 1),
    "cast": outline(0.72, 0, 0.78, 0.12, 1, 0.26, 1, 0.58, 1.13, 0.6, 1.13, 0.97, 1.09, 1),
    "bayonet": outline(0.94, 0, 1, 0.06, 1, 0.7, 1.05, 0.71, 1.05, 0.98, 1.02, 1),
    "turret": outline(1.2, 0, 1.2, 0.06, 1, 0.08, 0.97, 0.62, 1.06, 0.64, 1.1, 0.95, 1.02, 1),
}


def case_of(size: float, deep: float, design: str, style: ModelingStyle) -> tuple[Solid, float]:
    """A round case about z, its back on 0 and its front towards +z, and the radius of its opening [m].

    Args:
        size: diameter [m].
        deep: depth [m].
        design: one of ``CASES``.
        style: that models it.
    """
    r, d, n = size / 2, deep, style.round(size / 2)
    extra: list[Solid] = []
    if design == "safety":  # a solid front, and a disc at the back that blows out
        extra = [cylinder(0.86 * r, -0.003, 0.0005, n), around(box((0.12 * r, 0.2 * r, 0.005)), 3, 0.8 * r)]
    elif design == "cast":  # screws in its ring, which hangs on a hinge
        extra = [around(cylinder(0.05 * r, 0.9 * d, 1.05 * d, 8), 4, 1.03 * r, np.pi / 4)]
        extra.append(moved(along("y", cylinder(0.06 * r, -0.2 * r, 0.2 * r, 8)), at(1.16 * r, 0, 0.75 * d)))
    elif design == "bayonet":
        extra = [around(box((0.1 * r, 0.22 * r, 0.2 * d), (0, 0, 0.84 * d)), 4, 1.06 * r, 0.3)]
    elif design == "turret":  # a ring screwed on, a flange at the back
        extra = [around(box((0.06 * r, 0.1 * r, 0.26 * d), (0, 0, 0.8 * d)), 12, 1.08 * r)]
    wall = 0.9 * r
    outside = [(x * r, z * d) for x, z in _OUTSIDES[design]]
    return merge([turned([*outside, (wall, d), (wall, 0.82 * d)], n), *extra]), wall


class DialFace(Params):
    """A round dial plate, its scale raised, or bare."""

    bare: bool = chance(0.5, "without raised scale")
    marks: int = among((7, 11, 13), "marks of the scale", when=lambda p: not p.bare, otherwise=0)
    long: float = between(0.1, 0.2, "length of a mark / radius", when=lambda p: not p.bare)

    def solid(self, radius: float, low: float, style: ModelingStyle) -> Solid:
        """The plate of a radius on a height [m]."""
        plate = cylinder(0.985 * radius, low, low + 0.001, style.round(radius))
        if self.bare:
            return plate
        long = self.long * radius
        tick = box((long, 0.03 * radius, 0.0006), (0.85 * radius - long / 2, 0, low + 0.0012))
        ticks = [moved(tick, spun("z", float(a))) for a in np.linspace(-np.pi / 4, 1.25 * np.pi, self.marks)]
        return merge([plate, *ticks])


# Corners of pointers as place / radius and half their width / width, on one side, from the tail to the tip.
_POINTERS = (
    outline(-0.25, 1, 0.78, 0.2),
    outline(-0.1, 0.6, 0.82, 0.6),
    outline(-0.3, 3, -0.18, 3, -0.12, 0.7, 0.8, 0.15),
    outline(-0.2, 0.7, 0.6, 0.5, 0.6, 2.2, 0.84, 0),
)


class Needle(Params):
    """A pointer about z: tapered, straight, with a weight or an arrow, at some reading."""

    form: int = whole(0, 3, "tapered, straight, with a weight, an arrow")
    wide: float = between(0.025, 0.05, "width / radius of the dial")
    hub: float = between(0.06, 0.12, "radius of its hub / radius of the dial")
    reading: float = between(-0.7, 3.9, "where it points", "rad")

    def solid(self, radius: float, low: float) -> Solid:
        """The needle for a dial of a radius, on a height [m]."""
        wide, side = self.wide * radius, _POINTERS[self.form]
        back = [(x, y) for x, y in side[::-1] if y]
        corners = np.array([*((x * radius, -y * wide) for x, y in side), *((x * radius, y * wide) for x, y in back)])
        hub = cylinder(self.hub * radius, low, low + 0.0035, 10)
        flat = extrude(corners, low + 0.0005, low + 0.0015)
        return moved(merge([flat, hub]), spun("z", self.reading))


class Dial(Params):
    """Case, face, needle and maybe glass of an instrument with a round dial (EN 837-1)."""

    design: str = among(CASES, "how its case is made")
    deep: float = between(
        lambda p: 0.5 if p.design == "safety" else 0.28,
        lambda p: 0.8 if p.design == "safety" else 0.55,
        "depth of its case / diameter",
    )
    face: DialFace = nested(DialFace, "dial plate")
    needle: Needle = nested(Needle, "needle")
    drag: bool = chance(0.15, "a second needle that the first drags along")
    dragged: Needle = nested(Needle, "that second needle", when=lambda p: p.drag)
    glazed: bool = chance(0.6, "has a window")
    flat: bool = chance(0.7, "its window is flat, not domed", when=lambda p: p.glazed)

    def reach(self, size: float) -> float:
        """How far it reaches from its back, for a case of a diameter [m]."""
        # The screws of a cast ring stand out.
        return self.deep * size * (1.05 if self.design == "cast" else 1.0)

    def build(self, t: Table, size: float) -> None:
        """Puts it down: about z, its back on z = 0, its front towards +z.

        Args:
            t: with the frame.
            size: diameter of the case [m].
        """
        deep, t = self.deep * size, t.bundled(CASE)
        case, wall = case_of(size, deep, self.design, t.style)
        front = (0.0, 0.0, 1.0)
        t.add(CASE, case)
        t.add("gauge face", self.face.solid(wall, 0.82 * deep, t.style), front=front)
        t.add("gauge needle", self.needle.solid(wall, 0.82 * deep + 0.001), turns=Turning("needle"), front=front)
        if self.drag:
            t.add("gauge needle", self.dragged.solid(0.9 * wall, 0.82 * deep + 0.0035), of="handle", front=front)
        if self.glazed:
            n, low = t.n(wall), 0.93 * deep
            glass = cylinder(wall, low, low + 0.002, n)
            t.add("gauge glass", glass if self.flat else dome(wall, 0.12 * wall, 0.95 * deep, n), front=front)


class Shank(Params):
    """Thread, wrench flats and maybe a collar of a connection about z (G 1/4 or G 1/2)."""

    square: bool = chance(0.6, "its wrench flats are square, not hexagonal")
    collared: bool = chance(0.3, "a collar round its thread")

    def build(self, t: Table, low: float, high: float, size: float = 0.1) -> None:
        """Puts it down between two heights, for a case of a diameter [m]."""
        wide, span = (0.014 if size < 0.08 else 0.022), high - low
        n = fine_sides(0.4 * wide, t.style)
        solids = [cylinder(0.45 * wide, low, low + 0.6 * span, n)]
        if self.square:
            solids.append(box((wide, wide, 0.5 * span), (0, 0, high - 0.25 * span)))
        else:
            flats = hexagon(wide, high - 0.6 * span, high - 0.25 * span)
            solids += [flats, cylinder(0.42 * wide, high - 0.3 * span, high, n)]
        if self.collared:
            solids.append(cylinder(0.62 * wide, low + 0.3 * span, low + 0.4 * span, n))
        t.bundled(STEM).add(STEM, *solids)


class StandingGauge(Params):
    """A gauge with its connection below."""

    size: float = among((0.05, 0.063, 0.08, 0.1, 0.1, 0.16), "diameter of its case", "m")
    foot: Shank = nested(Shank, "connection")
    turn: float = between(0, 6.28, "which way its dial looks", "rad")
    dial: Dial = nested(Dial, "case with its dial")

    def build(self, t: Table, top: float) -> None:
        """Puts it down, on what ends at the height ``top`` [m]."""
        t, span = t.spun("z", self.turn), 0.03 + 0.12 * self.size
        self.foot.build(t, top - 0.004, top + span, self.size)
        self.dial.build(upright(t, self.size, top + span - 0.002, self.dial.reach(self.size)), self.size)


def upright(t: Table, size: float, top: float, deep: float, turn: float = 0.0) -> Table:
    """Where a dial stands upright on the height ``top``, its front to -y.

    Args:
        t: with the frame.
        size: diameter of the dial's case [m].
        top: [m].
        deep: depth of its case [m].
        turn: about z [rad].
    """
    return t.spun("z", turn).at(0, deep / 2, top + size / 2).moved(_UPRIGHT)


class Gland(Params):
    """A cable gland or plug about z from 0 up (EN 62444), maybe with a stub of cable."""

    form: str = weighted("what it is", gland=0.4, plug=0.2, cable=0.4)
    long: float = between(2, 8, "length of the cable / thread", when=lambda p: p.form == "cable")

    def solid(self, style: ModelingStyle, thread: float = 0.02) -> Solid:
        """The gland of a thread [m]."""
        n, r = fine_sides(thread / 2, style, 12), thread / 2
        if self.form == "plug":
            return merge([cylinder(1.1 * r, 0.0, 0.4 * r, n), hexagon(0.9 * r, 0.3 * r, 0.8 * r)])
        nut = [hexagon(2.5 * r, 0.0, 0.5 * r), hexagon(2.4 * r, 0.9 * r, 1.7 * r), cylinder(r, 0.0, 2.2 * r, n)]
        if self.form == "gland":
            return merge(nut)
        long, high = self.long * thread, 2 * r
        way = [(0, 0, high), (0, 0, high + 0.4 * long), (0, -0.1 * long, high + 0.7 * long), (0, -0.3 * long, long)]
        return merge([*nut, rope(way, 0.45 * r, 8)])


def _of_shape(*shapes: str) -> Any:
    return lambda p: p.shape in shapes


class Housing(Params):
    """A transmitter's electronics on z = 0: a drum with one or two chambers, a pot, a rectangular or slanted head."""

    shape: str = among(("single", "double", "pot", "rectangle", "slant"), "how it is made")
    radius: float = between(0.034, 0.052, "of its drum or pot", "m")
    wide: float = between(0.09, 0.15, "width of a rectangular one", "m", when=_of_shape("rectangle"))
    deep: float = between(0.06, 0.1, "its depth", "m", when=_of_shape("rectangle"))
    tall: float = between(0.08, 0.14, "its height", "m", when=_of_shape("rectangle"))
    both: bool = chance(0.5, "a cable gland on either side of a drum", when=_of_shape("single", "double"))
    gland: Gland = nested(Gland, "cable gland")
    other: Gland = nested(Gland, "second cable gland", when=lambda p: p.both or p.shape == "rectangle")
    turn: float = between(0, 6, "where the gland of a pot is", "rad", when=_of_shape("pot"))

    def solid(self, style: ModelingStyle) -> Solid:
        """All of it as one mesh, its neck down to 0."""
        r, shape = self.radius, self.shape
        n, neck = style.round(r), cylinder(0.45 * r, 0.0, 0.5 * r, 12)
        if shape == "pot":  # a can about z with a screwed lid
            body = turned([(x * r, z * r) for x, z in outline(0.5, 0.2, 1, 0.45, 1, 1.7, 1.1, 1.7, 1.1, 2.2)], n)
            ribs = around(box((0.14 * r, 0.2 * r, 0.4 * r), (0, 0, 1.95 * r)), 8, 1.1 * r)
            out = moved(along("x", self.gland.solid(style), 0.9 * r, 0, r), spun("z", self.turn))
            return merge([neck, body, ribs, out])
        if shape == "rectangle":
            return merge([neck, self._rectangle(style)])
        if shape == "slant":  # a pot whose window leans to the reader
            body = turned([(x * r, z * r) for x, z in outline(0.5, 0.2, 0.9, 0.4, 0.9, 1.5, 0.5, 1.9)], n)
            lid = turned([(x * r, z * r) for x, z in outline(1, 0, 1.08, 0.1, 1.08, 0.5, 0.9, 0.6)], n)
            lean = moved(lid, at(0, -0.2 * r, 1.3 * r) @ spun("x", np.pi / 4))
            return merge([neck, body, lean, along("y", self.gland.solid(style), 0, 0.8 * r, 0.9 * r)])
        # A drum about x with screwed covers at one end or both.
        low, high = (-1.3 * r, 0.9 * r) if shape == "single" else (-1.0 * r, 1.0 * r)
        body = along("x", turned(outline(0.8 * r, low, r, low + 0.15 * r, r, high, 0.8 * r, high + 0.05 * r), n))
        cover = turned([(x * r, z * r) for x, z in outline(1.12, 0, 1.15, 0.1, 1.15, 0.55, 1, 0.65)], n)
        solids = [body, along("x", cover, high - 0.1 * r)]
        if shape == "double":
            solids.append(along("-x", cover, low + 0.1 * r))
        solids.append(along("y", self.gland.solid(style), 0, 0.9 * r, 0.1 * r))
        if self.both:
            solids.append(along("-y", self.other.solid(style), 0, -0.9 * r, 0.1 * r))
        return merge([neck, moved(merge(solids), at(0, 0, 1.35 * r))])

    def _rectangle(self, style: ModelingStyle) -> Solid:
        wide, deep, tall = self.wide, self.deep, self.tall
        block = extrude(rounded_rectangle(wide, tall, 0.12 * tall, 3), 0.0, deep)
        lid = extrude(rounded_rectangle(0.96 * wide, 0.96 * tall, 0.1 * tall, 3), deep + 0.001, deep + 0.012)
        view = box((0.5 * wide, 0.3 * tall, 0.002), (0, 0.15 * tall, deep + 0.0128))
        outs = [
            along("-y", gland.solid(style), x * wide, -0.5 * tall + 0.001, 0.4 * deep)
            for gland, x in ((self.gland, -0.3), (self.other, 0.3))
        ]
        return moved(merge([block, lid, view, *outs]), at(0, 0.5 * deep, 0.4 * self.radius + 0.5 * tall) @ _UPRIGHT)


class Indicator(Params):
    """A square or rectangular case about z with its back on 0: bezel, face, a needle, maybe a window."""

    round_by: float = between(0, 0.15, "radius of its corners / height")
    needle: Needle = nested(Needle, "needle")
    glazed: bool = chance(0.5, "has a window")

    def build(self, t: Table, wide: float, tall: float, deep: float, of: str = "gauge") -> None:
        """Puts it down [m]; ``of``: material of the case."""
        shape, t = rounded_rectangle(wide, tall, self.round_by * tall, 3), t.bundled(CASE)
        front = (0.0, 0.0, 1.0)
        t.add(CASE, extrude(0.94 * shape, 0.0, 0.7 * deep), extrude(shape, 0.68 * deep, deep, (0.86 * shape,)), of=of)
        t.add("gauge face", extrude(0.855 * shape, 0.7 * deep, 0.7 * deep + 0.0015), front=front)
        needle = self.needle.solid(0.4 * min(wide, tall), 0.7 * deep + 0.0015)
        t.add("gauge needle", needle, turns=Turning("needle"), front=front)
        if self.glazed:
            t.add("gauge glass", extrude(0.855 * shape, 0.92 * deep, 0.96 * deep), front=front)
