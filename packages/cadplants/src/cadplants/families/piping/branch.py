"""Tees, laterals, crosses and branch outlets of further makes, with what goes on from their mouths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    bend_path,
    bolting,
    counter,
    family,
    grooved,
    lathe,
    mouth,
    pipe_x,
    prism,
    seated,
    tail,
)
from cadplants.family import Build, Family, Model, Part
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, loft, merge, moved, tube, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import ball, cylinder, hexagon, ring, rope
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["BRANCHES"]

_UP = spun("y", -np.pi / 2)


def _way(x: float, turn: float) -> Floats:
    """Out of the line's axis at ``x`` towards an angle from +x in the plane of x and z."""
    return at(x) @ spun("y", -turn)


def _smaller(dn: int, rng: np.random.Generator, most: int = 3) -> int:
    """The same size or one of the next smaller ones."""
    return int(rng.choice([size for size in SIZES if size <= dn][-most:]))


def _reach(design: str, dn: int, slant: float = 0.0) -> float:
    """From the middle of a fitting to its mouth [m]; longer where branches lean."""
    r = PIPES[dn].radius
    if design == "flanged":
        return 0.5 * FLANGES[dn].outer + plate_thickness(dn) + nut_room(dn) + 0.01 + 1.6 * slant * r
    base = {"banded": 2.0 * r + 0.014, "socket": 1.9 * r + 0.016, "glued": 2.7 * r + 0.012, "grooved": 2.4 * r + 0.04}
    return base.get(design, 2.1 * r + 0.012) + 1.4 * slant * r


def _junction(
    design: str,
    dn: int,
    style: ModelingStyle,
    rng: np.random.Generator,
    turns: Sequence[float],
    name: str,
    other: int = 0,
) -> Model:
    """A fitting with two mouths in the line and some branches, and pipes, lids or nothing on those.

    Args:
        design: of all mouths, see ``mouth``.
        dn: of the line.
        style: that models it.
        rng: of what is left open.
        turns: directions of the branches from +x [rad].
        name: ``tee`` or ``cross``.
        other: size of the branches; 0 as the line.
    """
    other = other or dn
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    slant = 1.0 if any(abs(abs(turn) - np.pi / 2) > 0.1 for turn in turns) else 0.0
    reach = _reach(design, dn)
    behind = reach + (0.0 if not slant else 1.2 * r + (0.3 * FLANGES[dn].outer if design == "flanged" else 0.0))
    heights = [_reach(design, other, slant) + (r - PIPES[other].radius) + (1.1 * r if slant else 0.0) for _ in turns]
    if slant and design == "flanged":
        heights = [h + 0.35 * FLANGES[dn].outer for h in heights]
    x = reach
    ends = [
        (x, np.pi, dn, reach),
        (x, 0.0, dn, behind),
        *((x, t, other, h) for t, h in zip(turns, heights, strict=True)),
    ]
    pieces = [moved(mouth(design, size, style, 0.0, far), _way(x, turn)) for x, turn, size, far in ends]
    if design not in ("grooved", "plain"):
        swell = 0.485 * FLANGES[dn].hub if design == "flanged" else 1.15 * r + 0.0015
        pieces.append(moved(ball(1.02 * swell, n), at(x)))
        if design == "flanged" and rng.random() < 0.5:
            pieces[-1] = moved(ball(1.35 * swell, n), at(x))
    color = {"glued": "handle", "flanged": "valve"}.get(design, "pipe")
    parts = [Part(merge(pieces), name, color)]
    if design == "grooved":
        parts += grooved(dn, style, at(0)) + grooved(dn, style, at(x + behind))
    for turn, far in zip(turns, heights, strict=True):
        parts += _goes_on(design, other, style, rng, _way(x, turn) @ at(far))
    return Model(parts, round(x + behind, 9), "flanged" if design == "flanged" else "welded")


def _goes_on(design: str, dn: int, style: ModelingStyle, rng: np.random.Generator, pose: Floats) -> list[Part]:
    """What is on a branch's mouth: nothing, a plug, or a joint of its kind and a pipe."""
    r = PIPES[dn].radius
    if design == "flanged":
        if rng.random() < 0.3:
            return []
        parts, length = counter(dn, style, pose)
        return parts + tail(dn, style, rng, pose @ at(length), "ocfb")
    if design == "grooved":
        return grooved(dn, style, pose) + tail(dn, style, rng, pose, "ocb")
    if design in ("banded", "socket", "hex") and rng.random() < 0.3:
        corners, flats = (4, 1.1 * r) if rng.random() < 0.5 else (6, 2.0 * r)
        long = 0.5 * r + 0.006
        head = merge(
            [prism(flats, corners, 0.0, long), lathe([(0.95 * r, -0.6 * r), (0.95 * r, 0.001)], style.round(r))]
        )
        return [Part(moved(head, pose), "pipe cap", "pipe")]
    return tail(dn, style, rng, pose, "oocf") if rng.random() < 0.9 else []


def _tee_of(design: str, reduced: bool = False) -> Build:
    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """A tee with mouths of one kind (EN 10242, ASME B16.11, EN ISO 1452-3, AWWA C606)."""
        return _junction(design, dn, style, rng, (np.pi / 2,), "tee", _smaller(dn, rng) if reduced else 0)

    return build


def _lateral_of(design: str) -> Build:
    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """A lateral of 45 or 60 degrees, welded, glued or cast with flanges (ASME B16.1, EN 545)."""
        return _junction(design, dn, style, rng, (pick(rng, 0.25, 0.25, 1 / 3) * np.pi,), "tee", _smaller(dn, rng))

    return build


def _cross_of(design: str, slant: bool = False) -> Build:
    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """A cross with mouths of one kind, straight across or as a double lateral."""
        turn = 0.25 * np.pi if slant else 0.5 * np.pi
        return _junction(design, dn, style, rng, (turn, -turn), "cross", _smaller(dn, rng, 2))

    return build


def _sweep_tee(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sweep tee: its branch leaves the line in a curve (EN 10242 E1 or fabricated)."""
    other = _smaller(dn, rng)
    r, small, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    radius = float(rng.uniform(1.6, 3.0)) * 2 * small + 0.5 * r
    path, reach = bend_path(radius, np.pi / 2, style.bend(radius + small))
    length = reach + 2.0 * r + 0.02
    begin = 0.6 * r + 0.01
    branch = moved(tube(path, 0.985 * small, bore_of(other, style), n), at(begin) @ spun("x", np.pi / 2))
    thick = bool(rng.random() < 0.4)
    run = pipe_x(dn, 0.0, length, style)
    pieces = [run, branch]
    if thick:
        band = 0.35 * r + 0.004
        for low in (0.0, length - band):
            pieces.append(lathe([(1.25 * r, low), (1.25 * r, low + band)], n, 0.99 * r))
    far = at(begin + reach, 0, reach) @ _UP
    return Model(
        [Part(merge(pieces), "tee", "pipe"), *tail(other, style, rng, far, "ocfb")], round(length, 9), "welded"
    )


def _pulled_tee(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A collar pulled out of the pipe itself, the branch welded on it; one to three in a row as in a header."""
    others = [size for size in SIZES if PIPES[size].radius < 0.72 * PIPES[dn].radius]
    other = int(rng.choice(others[-4:]))
    r, small, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    count, pitch = int(rng.integers(1, 4)), 4.0 * small + float(rng.uniform(0.04, 0.25))
    length = pitch * count
    top = r + 0.35 * small + 0.006
    rise = [(1.3 * small, 0.0), (1.12 * small, r + 0.08 * small), (1.0 * small, 0.5 * (r + top)), (small, top)]
    pieces = [pipe_x(dn, 0.0, length, style)]
    parts: list[Part] = []
    for k in range(count):
        place = at(pitch * (k + 0.5))
        pieces.append(moved(seated(rise, r, n, bore_of(other, style), 0.001), place))
        parts += tail(other, style, rng, place @ at(0, 0, top) @ _UP, "ocfb")
    return Model([Part(merge(pieces), "tee", "pipe"), *parts], round(length, 9), "welded")


def _bull_head(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tee on a pipe's end: the line runs into its branch and leaves to both sides."""
    design = str(rng.choice(["plain", "banded", "socket", "flanged", "glued", "grooved"]))
    r, n, far = PIPES[dn].radius, style.round(PIPES[dn].radius), _reach(design, dn)
    begin = 0.0
    parts: list[Part] = []
    if design == "flanged":
        counted, begin = counter(dn, style, spun("z", np.pi))
        parts = [Part(moved(p.solid, at(begin)), p.name, p.color, p.bundle, p.group, p.fine) for p in counted]
    x = begin + far
    ways = [at(x) @ spun("z", turn) for turn in (np.pi, 0.5 * np.pi, -0.5 * np.pi)]
    pieces = [moved(mouth(design, dn, style, 0.0, far), way) for way in ways]
    pieces.append(moved(ball(1.0 * r if design in ("plain", "grooved") else 1.2 * r, n), at(x)))
    parts.insert(0, Part(merge(pieces), "tee", "pipe"))
    for way in ways[1:]:
        parts += _goes_on(design, dn, style, rng, way @ at(far))
    if design == "grooved":
        parts += grooved(dn, style, at(0))
    roll = spun("x", pick(rng, 0.0, 0.5) * np.pi)
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


def _breeches(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wye on a pipe's end: two legs of a smaller size that part at an angle, straight or bent back to parallel."""
    other = int(rng.choice([size for size in SIZES if size < dn][-2:]))
    r, small, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    turn = float(rng.uniform(0.35, 0.8))
    begin, length = 1.2 * r, 2.2 * small / np.sin(turn) + 0.05
    pieces = [lathe([(r, 0.0), (r, begin), (0.8 * r, begin + 0.5 * r)], n)]
    parts: list[Part] = []
    back = bool(rng.random() < 0.5)
    for side in (-1, 1):
        way = at(0.7 * begin) @ spun("z", side * turn)
        if back:
            path, reach = bend_path(2.2 * small, turn, style.bend(3 * small, turn), 0.4 * length)
            flip = np.diag([1.0, -side, 1.0, 1.0])
            pieces.append(moved(tube(path, small, 0.0, n), way @ flip))
            far = way @ at(reach) @ spun("z", -side * turn) @ at(reach)
        else:
            pieces.append(moved(lathe([(small, 0.0), (small, length)], n), way))
            far = way @ at(length)
        parts += tail(other, style, rng, far, "ocfb")
    roll = spun("x", pick(rng, 0.0, 0.5) * np.pi)
    parts = [Part(merge(pieces), "tee", "pipe"), *parts]
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


# --- branch outlets: a piece of the line and what is welded or clamped on it ---


def _olet(kind: str, small: int, r: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[Solid, float]:
    """A forged outlet (MSS SP-97) over the line's axis, and where its mouth is [m]."""
    q, bore = PIPES[small].radius, 0.9 * PIPES[small].radius if style.hollow else 0.0
    n = style.round(1.5 * q)
    if kind == "weld":
        top = r + 0.9 * q + 0.012
        outline = [(1.75 * q, 0.002), (1.7 * q, r + 0.15 * q), (1.12 * q, top - 0.25 * q), (q, top)]
    elif kind == "socket":
        top = r + 1.3 * q + 0.014
        outline = [(1.55 * q, 0.004), (1.45 * q, r + 0.4 * q), (1.45 * q, top)]
    elif kind == "thread":
        top = r + 1.2 * q + 0.016
        mid = 0.5 * (r + top)
        outline = [(1.3 * q, 0.002), (1.3 * q, mid), (1.55 * q, mid + 0.1 * q), (1.55 * q, top)]
    elif kind == "nipple":
        top = r + float(rng.uniform(3.0, 6.0)) * q + 0.05
        outline = [(1.6 * q, 0.003), (1.5 * q, r + 0.5 * q), (1.05 * q, r + 1.3 * q), (1.0 * q, top)]
    else:
        top = r + 1.0 * q + 0.018
        outline = [(1.3 * q + 0.001, 0.0), (1.3 * q + 0.001, top)]
    wide = min(1.0, 0.95 * r / outline[0][0])
    outline = [(max(p * wide, 1.03 * q if bore else p * wide), z) for p, z in outline]
    return seated(outline, r, n, min(bore, 0.85 * outline[-1][0]), 0.0008), top


def _outlet_of(kind: str) -> Build:
    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """A piece of the line with one to three forged outlets (MSS SP-97 or half couplings, ASME B16.11) on it."""
        small = int(rng.choice([size for size in SIZES if PIPES[size].radius < 0.6 * PIPES[dn].radius][-4:]))
        r, q = PIPES[dn].radius, PIPES[small].radius
        count, pitch = int(rng.integers(1, 4)), 4 * q + float(rng.uniform(0.04, 0.3))
        length = pitch * count + 0.04
        parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe")]
        for k in range(count):
            solid, top = _olet(kind, small, r, style, rng)
            place = at(0.02 + pitch * (k + 0.5)) @ spun("x", pick(rng, 0.0, 0.0, 0.0, 0.5) * np.pi)
            parts.append(Part(moved(solid, place), "branch outlet", "pipe"))
            way = place @ at(0, 0, top) @ _UP
            if kind in ("thread", "half") and rng.random() < 0.5:
                plug = merge(
                    [prism(1.9 * q, 6, 0.0, 0.5 * q + 0.005), lathe([(0.85 * q, -0.002), (0.85 * q, 0.001)], 12)]
                )
                parts.append(Part(moved(plug, way), "pipe cap", "pipe"))
            else:
                parts += tail(small, style, rng, way, "ocfb")
        return Model(parts, round(length, 9), "welded")

    return build


def _latrolet(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A slanting outlet of 45 degrees (MSS SP-97): a thick sleeve grown into the line, its nipple leaning."""
    small = int(rng.choice([size for size in SIZES if PIPES[size].radius < 0.5 * PIPES[dn].radius][-3:]))
    r, q = PIPES[dn].radius, PIPES[small].radius
    n, length = style.round(1.5 * q), 4.5 * r + 0.1
    way = _way(0.35 * length, 0.25 * np.pi)
    # It begins inside the wall of the line, where the whole of its slanting end is buried.
    low, top = 1.05 * r, 1.414 * r + 2.4 * q + 0.015
    sleeve = lathe([(1.4 * q, low), (1.4 * q, top - 0.3 * q), (1.15 * q, top)], n, 0.9 * q if style.hollow else 0.0)
    toe = ball(1.45 * q, n)
    root = moved(toe, way @ at(1.414 * r + 0.1 * q))
    parts = [
        Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe"),
        Part(merge([moved(sleeve, way), root]), "branch outlet", "pipe"),
    ]
    return Model([*parts, *tail(small, style, rng, way @ at(top), "ocfb")], round(length, 9), "welded")


def _padded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A branch set on the line with a reinforcing pad (ASME B31.3, 304.3.3): a curved collar with a tell-tale hole."""
    small = int(rng.choice([size for size in SIZES if PIPES[size].radius < 0.62 * PIPES[dn].radius][-3:]))
    r, q, n = PIPES[dn].radius, PIPES[small].radius, style.round(PIPES[small].radius)
    thick, wide = 0.004 + 0.05 * r, min(float(rng.uniform(1.5, 2.0)) * q, 0.96 * r)
    length = 2 * wide + float(rng.uniform(0.1, 0.4))
    place = at(0.5 * length)
    angles = np.arange(max(16, n)) * 2 * np.pi / max(16, n)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    loops = []
    for radius, over in ((wide, 0.0), (wide, thick), (1.005 * q, thick), (1.005 * q, 0.0)):
        flat = radius * unit
        loops.append(np.column_stack([flat, np.sqrt(np.maximum(r**2 - flat[:, 1] ** 2, 0)) + over - 0.0005]))
    pad = weld([loft(loops, closed=True)])
    top = r + 1.2 * q + 0.02
    weld_bead = seated([(1.12 * q, thick), (1.0 * q + 0.001, r + thick + 0.25 * q)], r, n)
    parts = [
        Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe"),
        Part(moved(merge([pad, weld_bead]), place), "branch outlet", "pipe"),
        Part(moved(seated([(q, 0.0), (q, top)], r, n, bore_of(small, style)), place), "pipe", "pipe"),
    ]
    return Model([*parts, *tail(small, style, rng, place @ at(0, 0, top) @ _UP, "ocfb")], round(length, 9), "welded")


def _half_shell(inner: float, outer: float, width: float, sides: int) -> Solid:
    angles = np.linspace(0.02, np.pi - 0.02, max(8, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return about_x(extrude(np.concatenate([outer * unit, inner * unit[::-1]]), -width / 2, width / 2))


def _saddle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tapping saddle: a boss on a half shell, held by a second shell with bolts (plastic) or by U-bolts (cast)."""
    small = int(rng.choice([size for size in SIZES if PIPES[size].radius < 0.62 * PIPES[dn].radius][-3:]))
    r, q, n = PIPES[dn].radius, PIPES[small].radius, style.round(PIPES[dn].radius)
    thick, width = 0.006 + 0.08 * r, 3.2 * q + 0.03
    length = width + float(rng.uniform(0.1, 0.3))
    place, outer = at(0.5 * length), r + thick
    top = outer + 1.1 * q + 0.008
    boss = _upright([(1.45 * q, 0.8 * outer), (1.45 * q, top)], style.round(1.5 * q), 0.0)
    ring_ = hexagon(3.1 * q, top - 0.4 * q, top) if rng.random() < 0.5 else cylinder(1.6 * q, top - 0.4 * q, top, n)
    upper = [_half_shell(r, outer, width, n), boss, ring_]
    color = str(rng.choice(["rubber", "handle", "valve", "trim"]))
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe")]
    if rng.random() < 0.5:
        ears = [moved(extrude(_rect(width, 0.03), 0.0005, 0.011), at(0, s * (outer + 0.012))) for s in (-1, 1)]
        lower = merge([_half_shell(r, outer, width, n), *ears])
        parts.append(Part(moved(merge([*upper, *ears]), place), "branch outlet", color, "branch outlet"))
        parts.append(Part(moved(lower, place @ spun("x", np.pi)), "branch outlet", color, "branch outlet"))
        for side in (-1, 1):
            for x in (-0.35 * width, 0.35 * width):
                way = place @ at(x, side * (outer + 0.016)) @ _UP
                parts += bolting(1, 0.0, 0.008, -0.011, 0.011, style, "branch outlet", way)
    else:
        ears = [moved(extrude(_rect(width, 0.03), 0.0, 0.012), at(0, s * (outer + 0.01))) for s in (-1, 1)]
        parts.append(Part(moved(merge([*upper, *ears]), place), "branch outlet", color, "branch outlet"))
        a = np.linspace(np.pi, 2 * np.pi, 13)
        leg = r + 0.006
        bow = np.column_stack([np.zeros(13), leg * np.cos(a), leg * np.sin(a)])
        for x in (-0.36 * width, 0.36 * width):
            path = np.vstack([[0, -leg, 0.034], bow, [0, leg, 0.034]])
            parts.append(Part(moved(rope(path, 0.006, 8), place @ at(x)), "u-bolt", "fastener", "", BOLTED))
            nuts = merge([moved(hexagon(0.019, 0.012, 0.022), at(0, s * leg)) for s in (-1, 1)])
            parts.append(Part(moved(nuts, place @ at(x)), "nut", "fastener", "", BOLTED, True))
    return Model([*parts, *tail(small, style, rng, place @ at(0, 0, top) @ _UP, "ocf")], round(length, 9), "welded")


def _upright(outline: list[tuple[float, float]], sides: int, bore: float) -> Solid:
    """What is turned about z [m]."""
    return ring(bore, outline[0][0], outline[0][1], outline[-1][1], sides)


def _rect(x: float, y: float) -> Floats:
    return np.array([[x / 2, -y / 2], [x / 2, y / 2], [-x / 2, y / 2], [-x / 2, -y / 2]])


_LARGE = tuple(dn for dn in SIZES if dn >= 40)
_MIDDLE = tuple(dn for dn in SIZES if dn <= 200)

BRANCHES: tuple[Family, ...] = (
    family("tee/malleable banded", _tee_of("banded", True), SMALL),
    family("tee/socket block", _tee_of("socket"), SMALL),
    family("tee/glued plastic", _tee_of("glued", True), _MIDDLE),
    family("tee/grooved", _tee_of("grooved"), tuple(dn for dn in SIZES if 25 <= dn <= 200)),
    family("tee/cast reducing", _tee_of("flanged", True), _MIDDLE),
    family("tee/lateral welded", _lateral_of("plain")),
    family("tee/lateral cast", _lateral_of("flanged"), _MIDDLE),
    family("tee/lateral plastic", _lateral_of("glued"), _MIDDLE),
    family("tee/sweep", _sweep_tee),
    family("tee/pulled collar", _pulled_tee, _LARGE),
    family("tee/bull head", _bull_head, _MIDDLE, "end", 1.0),
    family("tee/breeches", _breeches, _LARGE, "end"),
    family("cross/malleable banded", _cross_of("banded"), SMALL),
    family("cross/cast flanged", _cross_of("flanged"), _MIDDLE),
    family("cross/glued plastic", _cross_of("glued"), _MIDDLE),
    family("cross/grooved", _cross_of("grooved"), tuple(dn for dn in SIZES if 25 <= dn <= 200)),
    family("cross/double lateral", _cross_of("plain", True)),
    family("branch outlet/weldolet", _outlet_of("weld"), _LARGE, weight=1.0),
    family("branch outlet/sockolet", _outlet_of("socket"), _LARGE),
    family("branch outlet/threadolet", _outlet_of("thread"), _LARGE),
    family("branch outlet/nipolet", _outlet_of("nipple"), _LARGE),
    family("branch outlet/half coupling", _outlet_of("half"), _LARGE),
    family("branch outlet/latrolet", _latrolet, _LARGE),
    family("branch outlet/pad", _padded, _LARGE, weight=1.0),
    family("branch outlet/saddle", _saddle, _LARGE, weight=1.0),
)
