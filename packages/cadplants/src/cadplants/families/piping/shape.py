"""Shapes that further pipe fittings are put together from; along x unless said otherwise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, given, nested
from cadplants.builder.table import Table
from cadplants.model.family import Part
from cadplants.model.plant import Assembly
from cadplants.model.standards import FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import bolts, flange, flange_length, gasket, nut_room, plate_thickness
from cadplants.parts.piping import cap
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import (
    Branch,
    Shell,
    Solid,
    about_x,
    branched,
    extrude,
    loft,
    merge,
    moved,
    reverse,
    revolve,
    weld,
)
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import cylinder, hexagon, ring, turned
from cadplants.solids.transforms import IDENTITY, arc, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "BACK",
    "BOLTED",
    "ENDS",
    "QUARTERS",
    "ROLL",
    "SMALL",
    "UP",
    "Fitting",
    "Outline",
    "Tail",
    "barrel",
    "below",
    "bend_path",
    "bolting",
    "counter",
    "crossing",
    "drilled",
    "flat_flange",
    "grooved",
    "joint",
    "knurled",
    "lathe",
    "mouth",
    "necks",
    "notched",
    "parts_of",
    "pipe_x",
    "prism",
    "seated",
    "sized",
    "swell_room",
    "tail_of",
    "tails",
]

Outline = Sequence[tuple[float, float]]
BOLTED = "Connection assembly"
SMALL = sizes_between(most=50)

ENDS = ("open", "cap", "flange", "lid")
"""What the end of a piece of pipe can be."""
QUARTERS, ROLL = (0.0, 0.5, 1.0, 1.5), "how it is turned about the pipe / half a turn"
UP, BACK = spun("y", -np.pi / 2), spun("z", np.pi)

_COLORS = {"flange": "flange", "blind flange": "flange", "gasket": "gasket", "pipe": "pipe", "pipe cap": "pipe"}


class Fitting(Device, place="inline", group="Pipe assembly", weight=0.5, grain="fitting"):
    """A fitting; by default its pieces stay apart, since neighbours of other names come with them."""

    def __init_subclass__(cls, **said: Any) -> None:
        super().__init_subclass__(**said)
        cls.label = cls.name.split("/")[0]


def below(dn: int, count: int) -> Sequence[int]:
    """The next smaller nominal sizes [mm], as many as there are of a count."""
    return [size for size in SIZES if size < dn][-count:]


def sized(dn: int, style: ModelingStyle, wide: float = 1.0) -> tuple[float, int, float]:
    """Radius of a pipe, sides of a circle that is wider by a factor, and the pipe's inside radius [m]."""
    r = PIPES[dn].radius
    return r, style.round(wide * r), bore_of(dn, style)


def lathe(outline: Outline, sides: int, bore: float = 0.0) -> Solid:
    """What is turned about x: ``(radius, x)`` along its outside, with a round bore right through [m]."""
    return about_x(turned(list(outline), sides, bore=bore))


def barrel(radius: float, low: float, high: float, sides: int, bore: float = 0.0) -> Solid:
    """A cylinder along x with a round bore right through [m]."""
    return lathe([(radius, low), (radius, high)], sides, bore)


def pipe_x(dn: int, low: float, high: float, style: ModelingStyle) -> Solid:
    """A piece of pipe along x [m]."""
    return about_x(ring(bore_of(dn, style), PIPES[dn].radius, low, high, style.round(PIPES[dn].radius)))


def prism(flats: float, corners: int, low: float, high: float, bore: float = 0.0, sides: int = 12) -> Solid:
    """A prism along x, this wide across its flats, with a round hole where ``bore`` is a radius [m]."""
    outline = circle(flats / 2 / np.cos(np.pi / corners), corners, phase=np.pi / corners)
    return about_x(extrude(outline, low, high, (circle(bore, sides),) if bore else ()))


def knurled(radius: float, count: int, depth: float, low: float, high: float, bore: float, sides: int) -> Solid:
    """A nut along x with a wavy rim for the style [m]."""
    angles = np.linspace(0, 2 * np.pi, 4 * count, endpoint=False)
    reach = radius - depth / 2 + depth / 2 * np.cos(count * angles)
    outline = np.column_stack([reach * np.cos(angles), reach * np.sin(angles)])
    return about_x(extrude(outline, low, high, (circle(bore, sides),) if bore else ()))


def notched(
    radius: float, count: int, depth: float, share: float, low: float, high: float, bore: float, sides: int
) -> Solid:
    """A nut along x with slots across its rim; they take this share of it [m]."""
    step = 2 * np.pi / count
    half = step * (1 - share) / 2
    points = []
    for k in range(count):
        for turn in np.linspace(-half, half, 4):
            points.append((radius, k * step + turn))
        points += [(radius - depth, k * step + half), (radius - depth, (k + 1) * step - half)]
    outline = np.array([(r * np.cos(a), r * np.sin(a)) for r, a in points])
    return about_x(extrude(outline, low, high, (circle(bore, sides),) if bore else ()))


def drilled(
    outline: Floats, low: float, high: float, bore: float, spots: Floats, hole: float, style: ModelingStyle, sides: int
) -> Solid:
    """A plate across x with a bore and bolt holes of radius ``hole`` at some spots, where the style drills any [m]."""
    holes = [circle(bore, sides)] if bore else []
    if style.holes:
        holes += [circle(hole, 8, (float(x), float(y))) for x, y in spots]
    return about_x(extrude(outline, low, high, tuple(holes)))


def flat_flange(dn: int, style: ModelingStyle, low: float, thick: float, bore: float) -> Solid:
    """A flat drilled disc with the rim and the bolt circle of a class 150 flange (ASME B16.5)."""
    size = FLANGES[dn]
    n = style.round(size.outer / 2)
    turns = (2 * np.arange(size.n_bolts) + 1) * np.pi / size.n_bolts
    spots = size.circle / 2 * np.column_stack([np.cos(turns), np.sin(turns)])
    return drilled(circle(size.outer / 2, n), low, low + thick, bore, spots, size.hole / 2, style, n)


def bolting(
    count: int,
    radius: float,
    thread: float,
    low: float,
    high: float,
    style: ModelingStyle,
    bundle: str = "",
    pose: Floats = IDENTITY,
    start: float | None = None,
) -> list[Part]:
    """Bolts along x on a circle, clamping what lies between two places, in as many pieces as the style makes [m]."""
    thick, turn = 0.8 * thread, np.pi / count if start is None else start
    poses = [pose @ spun("x", turn + 2 * np.pi * k / count) @ at(0, radius, 0) for k in range(count)]
    nuts = [about_x(hexagon(1.6 * thread, a, b)) for a, b in ((low - thick, low), (high, high + thick))]
    shank = about_x(cylinder(thread / 2, low - 1.2 * thick, high + 1.4 * thick, 8))
    if style.fasteners == "pieces":
        named = [(shank, "stud"), (nuts[0], "nut"), (nuts[1], "nut")]
    else:
        named = [(merge([shank, *nuts]), "bolt")]
    if style.fasteners in ("set", "flange"):
        whole = merge([moved(named[0][0], one) for one in poses])
        return [Part(whole, "bolt", "fastener", bundle, BOLTED, True)]
    return [Part(moved(solid, one), name, "fastener", bundle, BOLTED, True) for one in poses for solid, name in named]


def parts_of(assembly: Assembly, pose: Floats = IDENTITY) -> list[Part]:
    """Finished components as parts."""
    parts = []
    for c in assembly.components:
        bolted = c.group == BOLTED
        solid = moved(c.solid, pose @ c.pose)
        parts.append(Part(solid, c.name, _COLORS.get(c.name, "fastener"), "", BOLTED if bolted else "", bolted))
    return parts


def joint(
    dn: int, style: ModelingStyle, pose: Floats, blind: bool = False, open_: bool = False
) -> tuple[list[Part], float]:
    """Two flanges with gasket and bolts from the pose's origin along its x, and how long they are [m].

    Args:
        dn: nominal size.
        style: that models them.
        pose: of the end of the pipe before them.
        blind: whether the second one is a lid.
        open_: whether there is no second one.
    """
    neck, plate = flange_length(dn, style), plate_thickness(dn)
    back = at(neck) @ spun("z", np.pi)
    pad = 0.002 if style.gaskets else 0.0
    parts = parts_of(flange(dn, style, grip=0.0 if open_ else 2 * plate + pad), pose @ back)
    if open_:
        return parts, neck
    parts += parts_of(gasket(dn, style), pose @ at(neck))
    parts += parts_of(flange(dn, style, blind=blind), pose @ at(neck + pad))
    parts += parts_of(bolts(dn, 2 * plate + pad, style), pose @ at(neck - plate))
    return parts, neck + pad + (plate if blind else neck)


def counter(dn: int, style: ModelingStyle, pose: Floats, blind: bool = False) -> tuple[list[Part], float]:
    """Gasket, counter-flange or lid, and bolts at a flat face, outward along x of the pose; and their length."""
    neck, plate = flange_length(dn, style), plate_thickness(dn)
    pad = 0.002 if style.gaskets else 0.0
    parts = parts_of(gasket(dn, style), pose)
    parts += parts_of(flange(dn, style, blind=blind, grip=2 * plate + pad), pose @ at(pad))
    parts += parts_of(bolts(dn, 2 * plate + pad, style), pose @ at(-plate))
    return parts, pad + (plate if blind else neck)


def mouth(design: str, dn: int, style: ModelingStyle, low: float, high: float) -> Solid:
    """The end of a fitting along x, its face at ``high``: for a thread, a socket, glue, a groove, bolts or a weld [m].

    Args:
        design: ``banded``, ``socket``, ``glued``, ``grooved``, ``flanged``, ``hex`` or ``plain``.
        dn: of the pipe in it.
        style: that models it.
        low: where it begins inside the fitting.
        high: its face.
    """
    r, bore, room = PIPES[dn].radius, bore_of(dn, style), high - low
    n = style.round(1.2 * r)
    if design == "banded":
        band, far = min(0.3 * r + 0.004, 0.4 * room), 1.32 * r + 0.003
        body = [(1.14 * r + 0.0015, low), (1.14 * r + 0.0015, high - 1.25 * band)]
        return lathe([*body, (far, high - band), (1.02 * far, high - 0.5 * band), (far, high)], n, bore)
    if design == "socket":
        neck = low + 0.45 * room
        return lathe([(1.15 * r, low), (1.15 * r, neck), (1.36 * r + 0.002, neck), (1.36 * r + 0.002, high)], n, bore)
    if design == "glued":
        lip = high - 0.12 * room - 0.002
        return lathe([(1.15 * r, low), (1.18 * r, lip), (1.26 * r, lip), (1.26 * r, high)], n, bore)
    if design == "grooved":
        a, b, deep = high - 0.024, high - 0.015, 0.965 * r
        return lathe([(r, low), (r, a), (deep, a), (deep, b), (r, b), (r, high)], n, min(bore, 0.93 * r))
    if design == "hex":
        return prism(2.3 * r + 0.006, 6, low, high, 0.98 * r if style.hollow else 0.0, max(8, n))
    if design == "flanged":
        thick, neck = plate_thickness(dn), 0.485 * FLANGES[dn].hub
        plate = flat_flange(dn, style, high - thick, thick, bore)
        return merge([plate, lathe([(neck, low), (neck, high - thick)], n, bore)])
    return lathe([(r, low), (r, high)], n, bore)


def crossing(
    ends: tuple[float, float], branch: tuple[float, float], reach: float, sides: int, turns: Sequence[float]
) -> Solid:
    """A pipe along x with branches out of its middle, open inside where there are bores; all its mouths are open [m].

    Args:
        ends: radius and bore of the pipe; a bore of 0 makes it solid.
        branch: radius and bore of a branch.
        reach: from the middle to each mouth.
        sides: of the pipe, a multiple of 4.
        turns: where its branches point, about the pipe [rad]: quarters of a turn.
    """
    shells: list[Shell] = []
    rims: list[list[Floats]] = []
    # Both skins are cut alike, so that their mouths have as many corners; a branch's foot stays on its own side.
    share, high = min(branch[0] / ends[0], 0.93), 0.6 * reach + 0.4 * ends[0]
    for radius, end in zip(ends, branch, strict=True):
        if radius:
            arms = [Branch(reach, turn, share * radius, ((end, high), (end, reach))) for turn in turns]
            shell, loops = branched([(radius, 0.0), (radius, 2 * reach)], sides, arms)
            shells.append(reverse(shell) if rims else shell)
            rims.append(loops)
    outer, bore = ends
    shells += [revolve([(bore, 0.0), (outer, 0.0)], sides), revolve([(outer, 2 * reach), (bore, 2 * reach)], sides)]
    inside = rims[1] if bore else [loop.mean(axis=0, keepdims=True) for loop in rims[0]]
    return about_x(weld([*shells, *(loft([one, two]) for one, two in zip(rims[0], inside, strict=True))]))


def _half_ring(inner: float, outer: float, width: float, sides: int) -> Solid:
    """The half of a ring about x on the side of +z, from -width / 2 [m]."""
    angles = np.linspace(0.015, np.pi - 0.015, max(6, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return about_x(extrude(np.concatenate([outer * unit, inner * unit[::-1]]), -width / 2, width / 2))


def grooved(dn: int, style: ModelingStyle, pose: Floats, ribbed: bool = False) -> list[Part]:
    """A grooved coupling of two housings with bolts (AWWA C606) round the ends of two pipes, which meet in the pose."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    width, thick = 0.044 + 0.12 * r, 0.008 + 0.1 * r
    outer, lug = r + thick, 0.012 + 0.2 * r
    pieces = [_half_ring(r, outer, width, n)]
    if ribbed:
        pieces += [
            moved(_half_ring(outer - 0.001, outer + 0.005, 0.15 * width, n), at(s * 0.3 * width)) for s in (-1, 1)
        ]
    high = 0.5 * r + 0.006
    for side in (-1, 1):
        block = extrude(rounded_rectangle(0.6 * width, lug, 0.2 * lug, 2), 0.001, high)
        pieces.append(moved(block, at(0, side * (outer + 0.3 * lug))))
    half = merge(pieces)
    parts = [Part(moved(half, pose @ spun("x", turn)), "coupling", "handle", "coupling") for turn in (0.0, np.pi)]
    for side in (-1, 1):
        way = pose @ at(0, side * (outer + 0.35 * lug)) @ spun("y", -np.pi / 2)
        parts += bolting(1, 0.0, 0.3 * lug + 0.004, -high, high, style, "coupling", way)
    return parts


class Tail(Params):
    """What goes on from a mouth: a piece of pipe, open or with a cap, a flange or a lid on it."""

    ends: tuple[str, ...] = given(ENDS, "what its end can be")
    long: float = between(0.04, 0.25, "length of its pipe beyond one and a half diameters", "m")
    end: str = among(lambda p: p.ends, "what its end is")

    def build(self, t: Table, dn: int = 0) -> None:
        """Puts it down along x, of a nominal size or the table's."""
        dn = dn or t.dn
        length = self.long + 1.5 * PIPES[dn].outer
        t.add("pipe", pipe_x(dn, 0.0, length, t.style), own=False)
        if self.end == "cap":
            t.at(length).extend(parts_of(cap(dn, t.style)))
        elif self.end != "open":
            blind = self.end == "lid"
            t.extend(joint(dn, t.style, at(length), blind=blind, open_=not blind)[0])


def tails(*ends: str) -> Callable[[Any, Any], Tail]:
    """Draws what goes on from a mouth, its end one of some; what stands twice is twice as likely."""
    return made(Tail, lambda _: {"ends": ends})


def tail_of(*ends: str) -> Tail:
    """The field of what goes on from a mouth: see ``tails``."""
    return nested(Tail, "what goes on from it", fixed=lambda _: {"ends": ends})


def bend_path(radius: float, turn: float, steps: int, lead: float = 0.0) -> tuple[Floats, float]:
    """A round bend from the origin along +x towards +y with straight ends, and its centre to end [m]."""
    tangent = radius * float(np.tan(turn / 2)) if turn < 3.0 else 0.0
    reach = tangent + lead
    way = np.array([np.cos(turn), np.sin(turn), 0.0])
    if turn >= 3.0:
        angles = np.linspace(0, turn, 2 * steps + 1)
        far = np.column_stack([lead + radius * np.sin(angles), radius * (1 - np.cos(angles)), np.zeros(len(angles))])
        path = np.vstack([[0, 0, 0], far, far[-1] + way * lead])
        reach = lead + radius
    else:
        corner = np.array([reach, 0.0, 0.0])
        curve = arc(corner - (tangent, 0, 0), corner, corner + tangent * way, steps)
        path = np.vstack([[0, 0, 0], curve, corner + reach * way])
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-6])
    return path[keep], reach


def seated(outline: Outline, run: float, sides: int, bore: float = 0.0, sunk: float = 0.0006) -> Solid:
    """A branch turned about z whose foot follows a pipe of radius ``run`` along x through the origin.

    Args:
        outline: radius and height over the pipe's axis; the height of the first point is that of the foot over the
            pipe's surface.
        run: radius of the pipe [m].
        sides: of the branch.
        bore: its inside radius [m].
        sunk: how deep it bites [m].
    """
    angles = np.arange(sides) * 2 * np.pi / sides
    unit = np.column_stack([np.cos(angles), np.sin(angles)])

    def foot(radius: float, over: float) -> Floats:
        flat = radius * unit
        height = np.sqrt(np.maximum(run**2 - flat[:, 1] ** 2, 0.0)) - sunk + over
        return np.column_stack([flat, height])

    loops = [foot(outline[0][0], 0.0)]
    if outline[0][1] > 0:
        loops.append(foot(outline[0][0], outline[0][1]))
    loops += [np.column_stack([r * unit, np.full(sides, z)]) for r, z in outline[1:]]
    if bore > 0:
        top = outline[-1][1]
        inner = [np.column_stack([bore * unit, np.full(sides, top)]), foot(bore, 0.0)]
        return weld([loft([*loops, *inner], closed=True)])
    return weld([loft([loops[0].mean(axis=0)[None], *loops, loops[-1].mean(axis=0)[None]])])


def swell_room(dn: int) -> float:
    """How far from a face the body may swell beyond the neck [m]."""
    return plate_thickness(dn) + nut_room(dn)


def necks(dn: int, style: ModelingStyle, length: float) -> list[Solid]:
    """The two flanged mouths of a body, up to its middle."""
    one = mouth("flanged", dn, style, 0.0, 0.5 * length)
    return [moved(one, at(0.5 * length)), moved(one, at(0.5 * length) @ spun("z", np.pi))]
