"""Elbows, bends and return bends of further makes: as loops and humps in a line, or on a pipe's end."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    SMALL,
    bend_path,
    counter,
    family,
    grooved,
    lathe,
    mouth,
    pipe_x,
    prism,
    tail,
)
from cadplants.family import Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import ball, box, cylinder, lofted
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import IDENTITY, at, looking, spun
from cadplants.valve_body import bore_of

__all__ = ["BENDS"]

# A bend from the origin along +x towards +y by an angle: its pieces, and its centre to end.
Bend = Callable[[float], tuple[list[Part], float]]
Maker = Callable[[int, ModelingStyle, np.random.Generator], Bend]


def _far(turn: float, reach: float) -> Floats:
    """The frame of a bend's far end, x outward."""
    if turn > 3.0:
        raise ValueError("a return bend has no corner")
    return at(reach) @ spun("z", turn) @ at(reach)


def _mitred(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Cut and welded of pipe: one to four mitres, with or without beads of weld."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), bore_of(dn, style)
    cuts, radius, beads = int(rng.integers(1, 5)), float(rng.uniform(2.0, 3.4)) * r, bool(rng.random() < 0.4)

    def bend(turn: float) -> tuple[list[Part], float]:
        steps = min(cuts, max(1, round(cuts * turn / 1.5)))
        between = (np.arange(steps) + 0.5) * turn / steps
        far = radius / np.cos(turn / steps / 2)
        corners = np.column_stack([far * np.sin(between), radius - far * np.cos(between), np.zeros(steps)])
        end = np.array([[radius * np.sin(turn), radius * (1 - np.cos(turn)), 0.0]])
        path = np.vstack([[[0.0, 0.0, 0.0]], corners, end])
        pieces = [tube(path, r, bore, n)]
        reach = radius * float(np.tan(turn / 2))
        if beads:
            wide = 0.1 * r
            for place in (IDENTITY, _far(turn, reach)):
                way = -1.0 if place is not IDENTITY else 1.0
                low, high = sorted((0.0, way * wide))
                pieces.append(moved(lathe([(1.03 * r, low), (1.03 * r, high)], n, 0.99 * r), place))
        return [Part(merge(pieces), "elbow", "pipe")], reach

    return bend


def _beaded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Short or long radius for butt welding (ASME B16.9), its welds standing out as beads."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), bore_of(dn, style)
    radius, lead = pick(rng, 1.0, 1.0, 1.5) * dn / 1000 + 0.3 * r, pick(rng, 0.0, 0.3) * r

    def bend(turn: float) -> tuple[list[Part], float]:
        path, reach = bend_path(radius, turn, style.bend(radius + r, turn), lead)
        wide = 0.05 * r + 0.003
        bead = lathe([(1.0 * r, 0.0), (1.04 * r, 0.3 * wide), (1.04 * r, 0.7 * wide), (1.0 * r, wide)], n, 0.985 * r)
        ends = [bead, moved(bead, _far(turn, reach) @ at(-wide))]
        return [Part(merge([tube(path, r, bore, n), *ends]), "elbow", "pipe")], reach

    return bend


def _pulled(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Pulled cold or hot over three to five diameters, with straight ends of its own (ASME B16.49)."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), bore_of(dn, style)
    radius, lead = float(rng.uniform(2.5, 5.0)) * 2 * r, float(rng.uniform(1.0, 3.0)) * r

    def bend(turn: float) -> tuple[list[Part], float]:
        path, reach = bend_path(radius, turn, style.bend(radius + r, turn), lead)
        return [Part(tube(path, r, bore, n), "elbow", "pipe")], reach

    return bend


def _mouthed(dn: int, style: ModelingStyle, rng: np.random.Generator, design: str) -> Bend:
    """A thick bend between two mouths of a kind: threads with bands, forged sockets, glued sockets, grooves."""
    r, n, bore = PIPES[dn].radius, style.round(1.15 * PIPES[dn].radius), bore_of(dn, style)
    body = {"grooved": 1.0, "glued": 1.15}.get(design, 1.14) * r + (0.0 if design == "grooved" else 0.0015)
    radius = float(rng.uniform(1.15, 1.9)) * body * (1.5 if design == "grooved" else 1.0)
    deep = {"glued": 1.5 * r + 0.01, "grooved": 0.03, "socket": 0.8 * r + 0.014}.get(design, 0.7 * r + 0.011)
    heel = design == "socket" and bool(rng.random() < 0.6)
    web = design == "glued" and bool(rng.random() < 0.3)
    ribbed = bool(rng.random() < 0.5)

    def bend(turn: float) -> tuple[list[Part], float]:
        path, inner = bend_path(radius, turn, style.bend(radius + body, turn), 0.6 * deep)
        start, reach = 0.4 * deep, inner + 0.4 * deep
        end = mouth(design, dn, style, 0.0, deep)
        pieces = [
            moved(tube(path, body, bore, n), at(start)),
            moved(end, at(deep) @ spun("z", np.pi)),
            moved(end, _far(turn, reach) @ at(-deep)),
        ]
        if heel:
            middle = at(reach)
            pieces.append(moved(ball(1.3 * body, n), middle @ at(-0.2 * body, 0.2 * body)))
        if web:
            pieces.append(box((1.2 * reach, 0.25 * reach, 0.12 * r), (0.75 * reach, 0.5 * reach, 0)))
        parts = [Part(merge(pieces), "elbow", "handle" if design == "glued" else "pipe")]
        if design == "grooved":
            parts += grooved(dn, style, IDENTITY, ribbed) + grooved(dn, style, _far(turn, reach), ribbed)
        return parts, reach

    return bend


def _banded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Malleable iron, threaded, with a band round each mouth (EN 10242 A1)."""
    return _mouthed(dn, style, rng, "banded")


def _socket(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Forged steel for socket welding with a thick heel (ASME B16.11)."""
    return _mouthed(dn, style, rng, "socket")


def _glued(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """Plastic with long glued sockets (EN ISO 1452-3)."""
    return _mouthed(dn, style, rng, "glued")


def _grooved(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """A grooved elbow between its two couplings (AWWA C606)."""
    return _mouthed(dn, style, rng, "grooved")


def _cast(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """A cast elbow with flanges (ASME B16.5 class 150), sometimes on a foot, between its counter-flanges."""
    n, bore = style.round(PIPES[dn].radius), bore_of(dn, style)
    body = 0.485 * FLANGES[dn].hub
    room = plate_thickness(dn) + 0.3 * body
    radius = float(rng.uniform(1.1, 2.0)) * body + max(0.0, 0.5 * FLANGES[dn].outer - room - body)
    foot = bool(rng.random() < 0.4)

    def bend(turn: float) -> tuple[list[Part], float]:
        path, inner = bend_path(radius, turn, style.bend(radius + body, turn), 0.5 * room)
        first, more = counter(dn, style, spun("z", np.pi))
        shift, reach = 0.5 * room, inner + 0.5 * room
        face = mouth("flanged", dn, style, 0.0, room)
        far = _far(turn, reach)
        pieces = [
            moved(tube(path, body, bore, n), at(shift)),
            moved(face, at(room) @ spun("z", np.pi)),
            moved(face, far @ at(-room)),
        ]
        if foot and turn > 1.0:
            side = 0.45 * FLANGES[dn].outer
            low = -0.55 * FLANGES[dn].outer
            pieces.append(box((0.3 * body, -low, 1.2 * body), (reach, 0.5 * low, 0)))
            pieces.append(box((2 * side, 0.02 + 0.05 * body, 2 * side), (reach, low, 0)))
        counters = first + counter(dn, style, far)[0]
        parts = [Part(merge(pieces), "elbow", "valve"), *counters]
        return [Part(moved(p.solid, at(more)), p.name, p.color, p.bundle, p.group, p.fine) for p in parts], reach + more

    return bend


def _compression(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Bend:
    """A tube fitting: a square forged corner with a hexagon nut on each leg (ISO 8434-1)."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    half, nut = 1.25 * r + 0.002, 1.1 * r + 0.008
    long = float(rng.uniform(1.8, 2.4)) * r + 0.006

    def bend(turn: float) -> tuple[list[Part], float]:
        reach = long + nut
        leg = merge([lathe([(1.1 * r, 0.0), (1.1 * r, long)], n), prism(2 * half, 4, 0.0, 0.55 * long)])
        far = _far(turn, reach)
        body = merge([moved(leg, at(reach) @ spun("z", np.pi)), moved(leg, far @ at(-reach))])
        bored = 0.99 * r if style.hollow else 0.0
        nuts = [
            prism(2.55 * r + 0.006, 6, 0.15 * nut, nut, bored, n),
            lathe([(1.15 * r, 0.0), (1.15 * r, nut)], n, bored),
        ]
        cap_ = merge([nuts[0], moved(nuts[1], at(0.0))])
        parts = [Part(body, "elbow", "trim")]
        parts.append(Part(moved(cap_, at(nut) @ spun("z", np.pi)), "nut", "trim", "", "Connection assembly"))
        parts.append(Part(moved(cap_, far @ at(-nut)), "nut", "trim", "", "Connection assembly"))
        return parts, reach

    return bend


def _routed(points: Floats, dn: int, style: ModelingStyle, bend: Bend) -> list[Part]:
    """Bends in the corners of a way and pipe between them."""
    parts: list[Part] = []
    begin = points[0]
    for k in range(1, len(points)):
        leg = points[k] - points[k - 1]
        before = leg / np.linalg.norm(leg)
        stop, reach = points[k], 0.0
        if k < len(points) - 1:
            after = (points[k + 1] - points[k]) / np.linalg.norm(points[k + 1] - points[k])
            pieces, reach = bend(float(np.arccos(np.clip(before @ after, -1, 1))))
            stop = points[k] - reach * before
            pose = looking(stop, before, np.cross(before, after))
            parts += [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in pieces]
        length = float(np.linalg.norm(stop - begin))
        if length > 0.002:
            parts.append(Part(moved(pipe_x(dn, 0.0, length, style), looking(begin, before)), "pipe", "pipe"))
        if reach:
            begin = points[k] + reach * after
    return parts


def _looped(dn: int, style: ModelingStyle, rng: np.random.Generator, maker: Maker) -> Model:
    """An expansion loop or a hump over an obstacle: four bends of 90 or 45 degrees, maybe in two planes."""
    bend = maker(dn, style, rng)
    turn = pick(rng, 0.5, 0.5, 0.25) * np.pi
    reach = bend(turn)[1]
    lead = reach + pick(rng, 0.0, 0.05, 0.15)
    slant = 2 * reach + float(rng.uniform(0.02, 0.5))
    wide = 2 * reach + float(rng.uniform(0.02, 0.6))
    dx, dz = slant * np.cos(turn), slant * np.sin(turn)
    xs = np.cumsum([0.0, lead, dx, wide, dx, lead])
    points = np.column_stack([xs, np.zeros(6), [0, 0, dz, dz, 0, 0]])
    points[np.abs(points) < 1e-12] = 0.0
    parts = _routed(points, dn, style, bend)
    return Model([p for p in parts if p.solid.faces.size], round(float(xs[-1]), 9), "welded")


def _ended(dn: int, style: ModelingStyle, rng: np.random.Generator, maker: Maker) -> Model:
    """One or two bends on a pipe's end, then whatever goes on from there."""
    bend = maker(dn, style, rng)
    pose = spun("x", float(rng.choice([0.0, 0.5, 1.0, 1.5])) * np.pi)
    parts: list[Part] = []
    for k in range(int(rng.integers(1, 3))):
        turn = pick(rng, 0.5, 0.5, 0.25) * np.pi
        pieces, reach = bend(turn)
        if k:
            length = float(rng.uniform(0.03, 0.3))
            parts.append(Part(moved(pipe_x(dn, 0.0, length, style), pose), "pipe", "pipe"))
            pose = pose @ at(length) @ spun("x", pick(rng, 0.0, 0.5, 1.0, 1.5) * np.pi)
        parts += [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in pieces]
        pose = pose @ _far(turn, reach)
    return Model([*parts, *tail(dn, style, rng, pose, "oocf")])


def _loop_of(maker: Maker) -> Callable[[int, ModelingStyle, np.random.Generator], Model]:
    return lambda dn, style, rng: _looped(dn, style, rng, maker)


def _end_of(maker: Maker) -> Callable[[int, ModelingStyle, np.random.Generator], Model]:
    return lambda dn, style, rng: _ended(dn, style, rng, maker)


def _street(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A street elbow (EN 10242 A4): a banded mouth on the pipe, the other end a bare thread into a coupling."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), bore_of(dn, style)
    turn, body, deep = pick(rng, 0.5, 0.25) * np.pi, 1.14 * r + 0.0015, 0.7 * r + 0.011
    radius = float(rng.uniform(1.2, 1.7)) * body
    path, reach = bend_path(radius, turn, style.bend(radius + r, turn), 0.6 * deep)
    far = at(0.4 * deep) @ at(reach) @ spun("z", turn) @ at(reach)
    thread = 0.8 * r + 0.01
    ends = [
        moved(mouth("banded", dn, style, 0.0, deep), at(deep) @ spun("z", np.pi)),
        moved(lathe([(r, -0.2 * r), (0.97 * r, thread)], n, bore), far),
    ]
    solid = merge([moved(tube(path, body, bore, n), at(0.4 * deep)), *ends])
    sleeve = thread + 0.6 * r + 0.01
    coupling = lathe(
        [(1.25 * r + 0.002, 0.4 * thread), (1.25 * r + 0.002, sleeve)], n, 0.96 * r if style.hollow else 0.0
    )
    roll = spun("x", pick(rng, 0.0, 0.5, 1.0, 1.5) * np.pi)
    parts = [Part(solid, "elbow", "pipe"), Part(moved(coupling, far), "coupling", "pipe")]
    parts += tail(dn, style, rng, far @ at(sleeve), "oc")
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


def _reducing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A reducing elbow (ASME B16.9): round a long radius from one size to a smaller one."""
    other = int(rng.choice([size for size in SIZES if size < dn][-3:]))
    a, b, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    radius, steps = float(rng.uniform(2.0, 3.2)) * a, max(4, style.bend(3 * a))
    loops = []
    ring_ = circle(1.0, n)
    for share in np.linspace(0, 1, steps + 1):
        turn, r = share * np.pi / 2, a + share * (b - a)
        section = np.column_stack([np.zeros(n), r * ring_[:, 0], r * ring_[:, 1], np.ones(n)])
        pose = at(radius * np.sin(turn), radius * (1 - np.cos(turn))) @ spun("z", turn)
        loops.append((section @ pose.T)[:, :3])
    far = at(radius, radius) @ spun("z", np.pi / 2)
    roll = spun("x", pick(rng, 0.0, 0.5, 1.0, 1.5) * np.pi)
    parts = [Part(lofted(loops), "elbow", "pipe"), *tail(other, style, rng, far)]
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


def _returning(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A coil of pipes side by side joined by return bends of 180 degrees (ASME B16.9), held by flat bars."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), bore_of(dn, style)
    radius, lead = float(rng.uniform(1.5, 3.2)) * r, pick(rng, 0.0, 1.0) * r
    length, passes = float(rng.uniform(0.3, 1.0)) + 6 * r, int(rng.integers(1, 5))
    path, _ = bend_path(radius, np.pi, style.bend(radius + r), lead)
    one = tube(path, r, bore, n)
    pose, parts = IDENTITY, []
    for k in range(passes):
        turned = pose @ np.diag([1.0, 1.0 if k % 2 == 0 else -1.0, 1.0, 1.0])
        parts.append(Part(moved(one, turned), "elbow", "pipe"))
        pose = pose @ at(0, (2 if k % 2 == 0 else -2) * radius) @ spun("z", np.pi)
        parts.append(Part(moved(pipe_x(dn, 0.0, length, style), pose), "pipe", "pipe"))
        pose = pose @ at(length)
    wide = 2 * radius * passes
    if rng.random() < 0.6:
        for x in (-0.25 * length, -0.75 * length):
            bar = box((0.04, wide + 2 * r, 0.006), (x, 0.5 * wide + radius, -r - 0.003))
            parts.append(Part(bar, "bracket", "steel", "", "Connection assembly"))
    roll = spun("x", pick(rng, 0.0, 0.5, 1.0, 1.5) * np.pi)
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


def _duckfoot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A base elbow on a pipe's end: it turns up from a welded leg, a trunnion, with a foot plate."""
    bend = _beaded(dn, style, rng)
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    pieces, reach = bend(np.pi / 2)
    low = -float(rng.uniform(2.5, 6.0)) * r - 0.1
    leg = moved(cylinder(0.7 * r, low, 0.0, n), at(reach - 0.35 * r))
    foot: Solid = box((3.2 * r, 3.2 * r, 0.012), (reach - 0.35 * r, 0, low - 0.006))
    up = spun("x", np.pi / 2)
    parts = [Part(moved(p.solid, up), p.name, p.color) for p in pieces]
    parts += [Part(leg, "pipe", "pipe"), Part(foot, "base plate", "steel", "", "Structural element")]
    return Model([*parts, *tail(dn, style, rng, up @ _far(np.pi / 2, reach), "ofb")])


_MIDDLE = tuple(dn for dn in SIZES if dn <= 150)

BENDS: tuple[Family, ...] = (
    family("elbow/mitred", _loop_of(_mitred), tuple(dn for dn in SIZES if dn <= 250)),
    family("elbow/beaded", _loop_of(_beaded), tuple(dn for dn in SIZES if dn <= 250)),
    family("elbow/pulled", _loop_of(_pulled), tuple(dn for dn in SIZES if dn <= 80)),
    family("elbow/cast flanged", _end_of(_cast), _MIDDLE, "end"),
    family("elbow/grooved", _loop_of(_grooved), tuple(dn for dn in SIZES if 25 <= dn <= 200)),
    family("elbow/malleable banded", _loop_of(_banded), SMALL),
    family("elbow/socket weld", _end_of(_socket), SMALL, "end"),
    family("elbow/glued plastic", _loop_of(_glued), tuple(dn for dn in SIZES if dn <= 200)),
    family("elbow/compression", _end_of(_compression), SMALL[:4], "end"),
    family("elbow/mitred turn", _end_of(_mitred), SIZES, "end"),
    family("elbow/malleable turn", _end_of(_banded), SMALL, "end"),
    family("elbow/street", _street, SMALL, "end"),
    family("elbow/reducing", _reducing, SIZES[2:], "end"),
    family("elbow/return bend", _returning, _MIDDLE, "end", 1.0),
    family("elbow/duckfoot", _duckfoot, tuple(dn for dn in SIZES if dn >= 50), "end"),
)
