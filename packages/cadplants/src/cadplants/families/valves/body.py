"""Pieces that bodies of valves are put together from, along x from 0, stem towards +z."""

from __future__ import annotations

from functools import cache

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.params import Params, among, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import bolted
from cadplants.families.valves.actuation_hand import scaled, slab, span
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import flanged_body
from cadplants.model.family import Part
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, loft, merge, moved, reverse, revolve, volume, weld
from cadplants.solids.polygon import circle, rounded_rectangle, triangulate
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, lofted, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "Blade", "Packing", "TurnedBlade", "bolts_on", "chest", "ended", "lid_joint", "neck_of", "oval",
    "packings", "part_turned", "plate_outline", "room", "trim", "valve_ball", "wedge",
]  # fmt: skip

Rng = np.random.Generator
Middle = list[tuple[float, float]]


def trim(solid: Solid, name: str, x: float = 0.0, color: str = "trim") -> Part:
    """Another piece of the valve that goes with its body [m]."""
    return Part(moved(solid, at(x)) if x else solid, name, color, BODY)


def oval(a: float, b: float, n: int) -> Floats:
    """An ellipse of half widths ``a`` along the run and ``b`` across it [m]."""
    return circle(1.0, n) * (a, b)


def plate_outline(kind: str, a: float, b: float, n: int) -> Floats:
    """The outline of a bonnet's flange: ``round``, ``oval``, ``square`` or ``octagon``, of two half widths [m]."""
    if kind == "square":
        return rounded_rectangle(2 * a, 2 * b, 0.35 * min(a, b), 3)
    if kind == "octagon":
        return circle(1.06, 8, phase=np.pi / 8) * (a, b)
    return oval(max(a, b), max(a, b), n) if kind == "round" else oval(a, b, n)


def room(dn: int) -> float:
    """How high above the axis a collar of the body must lie to clear the flanges and their bolts [m]."""
    return 0.5 * FLANGES[dn].outer + 0.004


def ended(dn: int, style: ModelingStyle, length: float, middle: Middle, ends: str) -> Solid:
    """A body of revolution along x between ``flanged``, ``butt`` (welded), ``socket``, ``hex`` or ``octagon`` ends.

    Args:
        dn: nominal size.
        style: decides on bore and roundness.
        length: face to face [m].
        middle: radius and place between the ends [m].
        ends: their kind.
    """
    if ends == "flanged":
        return flanged_body(dn, style, length, middle)
    radius, bore = PIPES[dn].radius, bore_of(dn, style)
    n = style.round(max(r for r, _ in middle))
    if ends in ("hex", "octagon"):
        end = min(middle[0][1], length - middle[-1][1]) + 0.002
        solids = [along("x", turned(middle, n))]
        solids += [hex_end(dn, low, low + end, style, 6 if ends == "hex" else 8) for low in (0.0, length - end)]
        return merge(solids)
    end = 1.3 * radius + 0.003 if ends == "socket" else radius
    deep = 0.9 * middle[0][1]
    outside = [(end, 0.0), (end, deep), *middle, (end, length - 0.9 * (length - middle[-1][1])), (end, length)]
    if bore:
        return about_x(weld([revolve([*outside, (bore, length), (bore, 0.0)], n, closed=True)]))
    return about_x(turned(outside, n))


def part_turned(edge: Floats, start: float, end: float, steps: int) -> Solid:
    """A closed outline ``(radius, height)`` turned about z by less than a whole turn: a cut-away [m, rad]."""
    loops = [
        np.column_stack([edge[:, 0] * np.cos(a), edge[:, 0] * np.sin(a), edge[:, 1]])
        for a in np.linspace(start, end, steps + 1)
    ]
    x, y = edge[:, 0], edge[:, 1]
    if float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) < 0:
        loops = [loop[::-1] for loop in loops]
        edge = edge[::-1]
    fill = triangulate(edge)
    caps = [Solid(loops[0], fill.astype(np.int32)), Solid(loops[-1], fill[:, ::-1].astype(np.int32))]
    skin = loft(loops)
    solid = weld([reverse(skin), *caps])
    if not _matched(solid):
        solid = weld([skin, *caps])
    return solid if volume(solid) > 0 else reverse(solid)


def _matched(solid: Solid) -> bool:
    """Whether every edge is walked once each way."""
    edges = np.concatenate([solid.faces[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
    return len(np.unique(edges, axis=0)) == len(edges)


def chest(low: float, high: float, a: float, b: float, n: int, bottom: float, swell: float = 1.0) -> Solid:
    """The upright hollow of a gate valve from a round bottom up to its collar, oval in plan [m]."""
    loops = []
    for share, size in ((0.0, 0.35), (0.06, 0.7), (0.16, 0.92), (0.3, 1.0)):
        loops.append((low + share * bottom, size * swell))
    loops += [(low + 0.55 * (high - low), swell), (high, 1.0)]
    outlines = [np.column_stack([oval(a * s, b * s, n), np.full(n, z)]) for z, s in loops]
    return lofted(outlines)


def bolts_on(edge: Floats, count: int, low: float, high: float, thread: float) -> Part:
    """Bolts with their nuts set in from an outline, through what lies between two heights [m]."""
    inset = float(np.abs(edge).max())
    share = 1 - 1.1 * thread / inset
    step = np.vstack([edge, edge[:1]]) * share
    walked = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(step, axis=0), axis=1))])
    where = (np.arange(count) + 0.5) * walked[-1] / count
    heads = [hexagon(1.5 * thread, *ends) for ends in ((high, high + 0.7 * thread), (low - 0.7 * thread, low))]
    one = merge([cylinder(thread / 2, low, high, 8), *heads])
    spots = np.column_stack([np.interp(where, walked, step[:, k]) for k in (0, 1)])
    return bolted(merge([moved(one, at(float(x), float(y))) for x, y in spots]))


def lid_joint(
    kind: str, a: float, b: float, seat: float, plate: float, style: ModelingStyle, rng: Rng | None = None
) -> tuple[Solid, Solid, Part]:
    """The body's collar below ``seat``, the lid's plate above it, and the bolts through both [m]."""
    edge = plate_outline(kind, a, b, style.round(b))
    thread = float(np.clip(0.14 * min(a, b), 0.006, 0.02))
    count = max(4, 2 * int((a + b) / (3.2 * thread) / 2))
    bolts = bolts_on(edge, min(count, 16), seat - plate, seat + plate, thread)
    return slab(edge, seat - plate, seat), slab(edge, seat, seat + plate), bolts


_FORMS = ("oval follower", "nut", "round follower", "lantern")


class Packing(Params):
    """A gland on z = 0 about a stem: an oval or round follower with its bolts, a nut, or a lantern."""

    form: str = among(_FORMS, "how it is made")
    turn: float = among(
        (0.0, np.pi / 2), "of its bolts", "rad", when=lambda p: p.form == "oval follower", otherwise=0.0
    )

    def high(self, slim: float) -> float:
        """Its height about a stem of a radius [m]."""
        return {"oval follower": 2.1, "nut": 2.8, "round follower": 2.4, "lantern": 2.9}[self.form] * slim

    def build(self, t: Table, slim: float) -> None:
        """Puts it down about a stem of a radius [m]."""
        n, t, both = max(12, t.style.round(2 * slim)), t.bundled(BODY), (-1, 1)
        if self.form == "oval follower":
            flat, t = slab(oval(4.6 * slim, 2.0 * slim, 16), 0.9 * slim, 1.7 * slim), t.spun("z", self.turn)
            t.add("gland", flat, cylinder(1.5 * slim, 0.0, 2.1 * slim, n))
            one = merge([cylinder(0.5 * slim, -1.5 * slim, 3.0 * slim, 8), hexagon(1.5 * slim, 1.7 * slim, 2.4 * slim)])
            t.add("bolt", *(moved(one, at(s * 3.5 * slim)) for s in both))
        elif self.form == "nut":
            t.add("gland", hexagon(4.0 * slim, 0.0, 2.2 * slim), turned(scaled(slim, 1.9, 2.2, 1.4, 2.8), n))
        elif self.form == "round follower":
            t.add("gland", turned(scaled(slim, 3.4, 0.3, 3.4, 1.1, 1.6, 1.4, 1.5, 2.4), n))
            t.add("bolt", around(hexagon(1.3 * slim, 1.0 * slim, 1.8 * slim), 4, 2.7 * slim))
        else:
            bar, x = box((8.0 * slim, 2.4 * slim, 0.9 * slim), (0, 0, 2.4 * slim)), 3.4 * slim
            t.add("gland", bar, cylinder(1.6 * slim, 0.0, 2.0 * slim, n))
            eyes = [rod((s * x, 0, -1.5 * slim), (s * x, 0, 3.6 * slim), 0.5 * slim, 8) for s in both]
            t.add("bolt", *eyes, *(moved(hexagon(1.5 * slim, 2.85 * slim, 3.5 * slim), at(s * x)) for s in both))


@cache
def packings(*forms: str) -> type[Packing]:
    """Glands of these forms."""

    class Packings(Packing):
        """A gland of some forms."""

        form: str = among(forms, "how it is made")

    return Packings


def wedge(dn: int, x: float, thick: float, rise: float, style: ModelingStyle) -> Part:
    """A gate, maybe with its guides, standing across the bore at ``x``, lifted by ``rise`` [m]."""
    bore = PIPES[dn].bore
    n = style.round(bore)
    slim = 0.42 * thick
    side = outline(0.5, -1, 0.9, -1, 0.95, -0.9, 1.12, -0.55, 1.12, 0.55, 0.95, 0.9, 0.5, 1)
    disc = turned([(r * bore, y * slim) for r, y in side], n)
    head = box((0.7 * thick, 0.5 * bore, 0.4 * bore), (0, 0, 1.2 * bore))
    return trim(moved(merge([along("x", disc), head]), at(x, 0, rise)), "valve disc")


def valve_ball(radius: float, bore: float, style: ModelingStyle, turn: float, trunnions: float = 0.0) -> Solid:
    """A bored ball about the origin, turned about z, with a slot or stubs for its stem [m, rad]."""
    n = max(16, style.round(radius))
    edge = float(np.arccos(min(0.99, bore / radius)))
    angles = np.linspace(-edge, edge, max(7, n // 3))
    belt = [(radius * float(np.cos(a)), radius * float(np.sin(a))) for a in angles]
    belt[0], belt[-1] = (bore, belt[0][1]), (bore, belt[-1][1])
    solids = [moved(about_x(weld([revolve(belt, n, closed=True)])), spun("z", turn))]
    if trunnions:
        solids += [cylinder(0.3 * radius, *span(s * 0.9 * radius, s * trunnions), 16) for s in (-1, 1)]
    return merge(solids)


def neck_of(dn: int) -> tuple[float, float]:
    """Radius of a flange's neck and where it leaves the flange's back [m]."""
    return 0.485 * FLANGES[dn].hub, plate_thickness(dn)


class Blade(Params):
    """A butterfly's disc across x at the origin, its shaft along z: lens, ribbed dish, offset plate or lattice."""

    form: str = among(("lens", "ribbed dish", "offset", "plate", "domed"), "how it is made")

    def solid(self, radius: float, style: ModelingStyle) -> Solid:
        """The disc of a radius [m]."""
        n, rim, thin = max(16, style.round(radius)), 0.985 * radius, 0.03 * radius
        if self.form == "lens":
            side = outline(0.3 * radius, -0.11 * radius, 0.8 * radius, -0.05 * radius, rim, -0.004)
            solids = [along("x", turned([*side, *((r, -x) for r, x in side[::-1])], n))]
        elif self.form == "ribbed dish":
            side = outline(0.9 * rim, -0.06 * radius, rim, -0.02 * radius, rim, 0.05 * radius, 0.6 * radius, 2 * thin)
            solids = [along("x", turned(side, n))]
            for y, wide in ((-0.45, 0.9), (0.0, 1.1), (0.45, 0.9)):
                rib = (0.16 * radius, 0.05 * radius, 1.5 * radius * wide)
                solids.append(box(rib, (0.1 * radius, y * radius, 0)))
        elif self.form == "offset":
            side = outline(0.94 * rim, -0.09 * radius, rim, -0.05 * radius, 0.93 * rim, 0.04 * radius)
            solids = [along("x", turned(side, n))]
            for z in (-0.5 * radius, 0.5 * radius):
                eye = cylinder(0.17 * radius, z - 0.14 * radius, z + 0.14 * radius, 12)
                solids.append(moved(eye, at(0.12 * radius)))
        elif self.form == "plate":
            solids = [along("x", slab(circle(rim, n), -thin - 0.001, thin + 0.001))]
            clip = (0.05 * radius, 0.18 * radius, 0.18 * radius)
            solids += [box(clip, (0.15 * radius, 0, s * 0.5 * radius)) for s in (-1, 0, 1)]
        else:
            solids = [along("x", turned(outline(0.97 * rim, -thin, rim, 0, 0.97 * rim, thin), n))]
            solids.append(along("x", dome(0.7 * radius, 0.18 * radius, 0.02 * radius, n)))
        return merge([*solids, cylinder(0.1 * radius + 0.002, -1.02 * radius, 1.02 * radius, 12)])


class TurnedBlade(Params):
    """A butterfly's disc, open, half open or shut."""

    turn: float = among((0.0, 0.0, np.pi / 2, 0.3 * np.pi, 0.15 * np.pi), "from shut", "rad")
    blade: Blade = nested(Blade, "disc")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, of a radius [m]."""
        t.spun("z", self.turn).bundled(BODY).add("valve disc", self.blade.solid(radius, t.style))
