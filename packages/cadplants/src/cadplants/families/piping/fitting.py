"""Pipe fittings: couplings, unions, bellows, strainers, crosses, reducers, outlets, ends; along x from 0."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.family import Family, Model, Part
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import (
    Branch,
    Solid,
    about_x,
    branched,
    extrude,
    loft,
    merge,
    moved,
    revolve,
    tube,
    weld,
)
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import along, around, box, cylinder, hexagon, lofted, ring, torus, turned, waves
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, REDUCER_LENGTH, SIZES, TEE_CENTER_TO_END
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["FITTINGS"]

_GROUP = "Pipe assembly"


def _single(solid: Solid, name: str, length: float, dn: int = 0, joint: str = "welded", color: str = "pipe") -> Model:
    return Model([Part(solid, name, color)], round(length, 6), joint, dn=dn)


def _coupling(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded or socket coupling (ASME B16.11), plain or hexagonal; or a grooved one of two halves with bolts."""
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    length = 1.5 * radius + 0.025
    kind = int(rng.integers(4))
    bore = bore_of(dn, style)
    if kind == 0:
        return _single(along("x", ring(bore, 1.25 * radius + 0.002, 0, length, n)), "coupling", length)
    if kind == 1:
        return _single(hex_end(dn, 0, length, style, int(rng.choice([6, 8]))), "coupling", length)
    if kind == 2:
        big, wall = 1.25 * radius + 0.002, 0.15 * length
        shape = [
            (big, 0.0),
            (big, wall),
            (1.12 * radius, 1.5 * wall),
            (1.12 * radius, length - 1.5 * wall),
            (big, length - wall),
            (big, length),
        ]
        inner = [(bore, length), (bore, 0.0)] if bore else [(0.0, length)]
        shell = revolve([*shape, *inner], n, closed=True) if bore else revolve([(0.0, 0.0), *shape, (0.0, length)], n)
        return _single(along("x", weld([shell])), "coupling", length)
    # A grooved coupling clamps the two pipes, which meet inside it.
    width, outer = 0.045 + 0.1 * radius, 1.18 * radius + 0.008
    half = _half_ring(radius, outer, width, n)
    lug = box((0.35 * outer, 0.4 * outer, 0.8 * width), (1.1 * outer, 0.22 * outer, width / 2))
    lugs = [lug, moved(lug, at() @ spun("z", np.pi) @ np.diag([1.0, -1.0, 1.0, 1.0]))]
    one = merge([half, *lugs])
    bolt = along(
        "y",
        merge(
            [cylinder(0.08 * outer, -0.55 * outer, 0.55 * outer, 8), hexagon(0.22 * outer, 0.42 * outer, 0.55 * outer)]
        ),
        1.1 * outer,
        0,
        width / 2,
    )
    pieces = [
        Part(along("x", one), "coupling", "handle", "coupling"),
        Part(along("x", moved(one, spun("z", np.pi))), "coupling", "handle", "coupling"),
    ]
    pieces += [
        Part(along("x", moved(bolt, spun("z", a))), "bolt", "fastener", "coupling", "Connection assembly", True)
        for a in (0.0, np.pi)
    ]
    pieces.append(Part(along("x", ring(bore, radius, 0, width, n)), "pipe", "pipe"))
    return Model(pieces, round(width, 6), "welded")


def _half_ring(inner: float, outer: float, width: float, sides: int) -> Solid:
    angles = np.linspace(0.0, np.pi, max(6, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return extrude(np.concatenate([outer * unit, inner * unit[::-1]]), 0.0, width)


def _union(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A union (ASME B16.11, EN 10242): two wrench ends and a big nut over the joint."""
    radius = PIPES[dn].radius
    length = 2.0 * radius + 0.035
    ends = merge(
        [hex_end(dn, 0, 0.45 * length, style, 8), hex_end(dn, 0.45 * length, length, style, int(rng.choice([6, 8])))]
    )
    flats = 3.1 * radius + 0.008
    nut = along("x", hexagon(flats, 0.3 * length, 0.66 * length, 1.2 * radius, 12))
    return Model(
        [Part(ends, "union", "trim", "union"), Part(nut, "union", "trim", "union")], round(length, 6), "welded"
    )


def _nipple(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hexagon nipple, or a barrel nipple between two couplings."""
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    length, bore = 2.0 * radius + 0.03, bore_of(dn, style)
    if rng.random() < 0.5:
        tube_ = ring(bore, 0.96 * radius, 0, length, n)
        hexa = hexagon(2.4 * radius + 0.004, 0.42 * length, 0.58 * length, 0.5 * radius)
        return _single(along("x", merge([tube_, hexa])), "nipple", length, color="trim")
    socket = 1.2 * radius + 0.012
    whole = 2 * socket + length
    ends = [
        Part(along("x", ring(bore, 1.25 * radius + 0.002, a, a + socket, n)), "coupling", "trim")
        for a in (0.0, whole - socket)
    ]
    return Model(
        [ends[0], Part(along("x", ring(bore, radius, socket, whole - socket, n)), "nipple", "trim"), ends[1]],
        round(whole, 6),
        "welded",
    )


def _bellows(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An expansion joint (EN 14917): waves between two flanges, plain or with tie rods; or one rubber arch."""
    size, radius = FLANGES[dn], PIPES[dn].radius
    thick, room = plate_thickness(dn), nut_room(dn)
    rubber = bool(rng.random() < 0.35)
    count = 1 if rubber else int(rng.integers(3, 9))
    length = 2 * (thick + room) + (0.9 if rubber else 0.22 * count) * max(radius, 0.03)
    low, high = thick + room, length - thick - room
    top = radius * (1.6 if rubber else 1.35) + 0.004
    profile = [(z, x) for z, x in waves(low, high, 1.02 * radius, top, count)]
    body = flanged_body(
        dn, style, length, [(1.02 * radius, low * 0.999), *profile[1:-1], (1.02 * radius, high * 1.001)]
    )
    parts = [Part(body, "expansion joint", "rubber" if rubber else "trim", "expansion joint")]
    if rng.random() < 0.4:
        lug, count = 0.5 * size.outer + 0.02, int(rng.choice([2, 3, 4]))
        bars = around(
            merge(
                [
                    cylinder(0.006 + 0.03 * radius, -0.02, length + 0.02, 8),
                    hexagon(0.03, -0.02, -0.005),
                    hexagon(0.03, length + 0.005, length + 0.02),
                ]
            ),
            count,
            lug,
        )
        places = (0.3 * thick, length - 0.3 * thick)
        ears = [around(box((0.08, 0.05, 0.012), (-0.01, 0, z)), count, lug - 0.01) for z in places]
        parts.append(
            Part(about_x(merge([bars, *ears])), "stud", "fastener", "expansion joint", "Connection assembly", True)
        )
    return Model(parts, round(length, 6))


def _bellows_welded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Metal bellows or braided hose with plain ends for welding."""
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    count = int(rng.integers(4, 12))
    length = 0.3 * count * radius + 0.06
    swing = waves(0.03, length - 0.03, 1.0 * radius, 1.3 * radius + 0.003, count)
    outline = [(radius, 0.0), *swing, (radius, length)]
    bore = bore_of(dn, style)
    shell = weld([revolve([*outline, (bore, length), (bore, 0.0)], n, closed=True)]) if bore else turned(outline, n)
    return _single(about_x(shell), "expansion joint", length, color="trim")


def _y_strainer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Y strainer, flanged: a slanting branch downward with a bolted or screwed cap."""
    length, radius = FACE_TO_FACE["globe"][dn], PIPES[dn].radius
    low, neck = plate_thickness(dn) + 0.1 * length, 0.485 * FLANGES[dn].hub
    bulge, n = max(neck, 1.2 * radius + 0.004), style.round(1.3 * radius)
    body = flanged_body(
        dn,
        style,
        length,
        [(neck, low), (bulge, low + 0.1 * length), (bulge, length - low - 0.1 * length), (neck, length - low)],
    )
    reach = max(2.6 * bulge, 0.72 * FLANGES[dn].outer)
    arm = turned([(0.95 * bulge, 0.0), (0.95 * bulge, reach), (1.25 * bulge, reach), (1.25 * bulge, reach + 0.014)], n)
    lid = merge(
        [cylinder(1.25 * bulge, reach + 0.014, reach + 0.03, n), hexagon(0.5 * bulge, reach + 0.03, reach + 0.045)]
    )
    way = at(0.4 * length) @ spun("y", np.pi - 0.8)
    return Model(
        [
            Part(body, "strainer", "valve", "strainer"),
            Part(moved(arm, way), "strainer", "valve", "strainer"),
            Part(moved(lid, way), "strainer", "valve", "strainer"),
            Part(
                moved(bolt_circle(4, 1.1 * bulge, 0.01, reach, reach + 0.03), way),
                "bolt",
                "fastener",
                "strainer",
                "Connection assembly",
                True,
            ),
        ],
        length,
    )


def _y_strainer_threaded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small Y strainer with hexagon ends and a hexagon plug."""
    radius, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    length, bulge = 4.2 * radius + 0.03, 1.25 * radius + 0.003
    body = merge(
        [
            hex_end(dn, 0, 0.22 * length, style),
            along("x", cylinder(bulge, 0.2 * length, 0.8 * length, n)),
            hex_end(dn, 0.78 * length, length, style),
        ]
    )
    way = at(0.42 * length) @ spun("y", np.pi - 0.8)
    arm = merge([cylinder(0.95 * bulge, 0.0, 2.9 * bulge, n), hexagon(1.6 * bulge, 2.85 * bulge, 3.4 * bulge)])
    return Model(
        [Part(body, "strainer", "valve", "strainer"), Part(moved(arm, way), "strainer", "valve", "strainer")],
        round(length, 6),
        "welded",
    )


def _basket(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A basket strainer: an upright pot across the line, a lid on top with bolts or a clamp bar (T type)."""
    radius = PIPES[dn].radius
    pot, n = 1.9 * radius + 0.02, style.round(1.9 * radius)
    length = 2 * (pot + plate_thickness(dn) + nut_room(dn) + 0.01)
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
    low, high = -2.2 * pot, max(1.1 * pot, 0.5 * FLANGES[dn].outer + 0.01)
    shell = turned(
        [
            (0.3 * pot, low - 0.3 * pot),
            (0.85 * pot, low - 0.15 * pot),
            (pot, low),
            (pot, high),
            (1.25 * pot, high),
            (1.25 * pot, high + 0.02),
        ],
        n,
    )
    lid = turned([(1.25 * pot, high + 0.021), (1.25 * pot, high + 0.04), (0.5 * pot, high + 0.06)], n)
    x = length / 2
    parts = [
        Part(merge([body, moved(shell, at(x))]), "strainer", "valve", "strainer"),
        Part(moved(lid, at(x)), "strainer", "valve", "strainer"),
    ]
    parts.append(
        Part(
            moved(bolt_circle(8, 1.13 * pot, 0.012, high, high + 0.04), at(x)),
            "bolt",
            "fastener",
            "strainer",
            "Connection assembly",
            True,
        )
    )
    return Model(parts, round(length, 6))


def _cross(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A butt-welding cross (ASME B16.9), its side mouths of the same or a smaller size, closed by caps or open."""
    size, reach = PIPES[dn], TEE_CENTER_TO_END[dn]
    n = style.round(size.radius)
    foot = 0.93 * size.radius
    out = ((foot, size.radius + 0.5 * (reach - size.radius)), (foot, reach), (0.0, reach))
    if n >= 16 and n % 4 == 0:
        shell, _ = branched(
            [(size.radius, 0.0), (size.radius, 2 * reach)],
            n,
            [Branch(reach, a, 0.9 * size.radius, out) for a in (np.pi / 2, 3 * np.pi / 2)],
        )
        bore = bore_of(dn, style)
        if bore:
            inside = [revolve([(size.radius, 2 * reach), (bore, 2 * reach), (bore, 0.0), (size.radius, 0.0)], n)]
        else:
            inside = [
                revolve([(0.0, 0.0), (size.radius, 0.0)], n),
                revolve([(size.radius, 2 * reach), (0.0, 2 * reach)], n),
            ]
        return _single(about_x(weld([shell, *inside])), "cross", 2 * reach)
    side = along("z", cylinder(foot, -reach, reach, n), reach)
    return _single(merge([along("x", cylinder(size.radius, 0, 2 * reach, n)), side]), "cross", 2 * reach)


def _arm(dn: int, style: ModelingStyle, low: float, reach: float, n: int) -> Solid:
    """A forged mouth about z from ``low`` to ``reach`` with a band at its end, bored where the style models hollow."""
    radius, bore = PIPES[dn].radius, bore_of(dn, style)
    outline = [(1.15 * radius, low), (1.15 * radius, 0.6 * reach), (1.3 * radius, 0.65 * reach), (1.3 * radius, reach)]
    if low < 0:
        outline = [(1.3 * radius, low), (1.3 * radius, 0.65 * low), (1.15 * radius, 0.6 * low), *outline[1:]]
    if not bore:
        return turned(outline, n)
    return weld([revolve([*outline, (bore, reach), (bore, low)], n, closed=True)])


def _cross_forged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded or socket cross: a round body with bands at its four mouths (ASME B16.11)."""
    radius, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    reach = 1.6 * radius + 0.015
    arm = _arm(dn, style, -reach, reach, n)
    solid = merge([along("x", arm, reach), moved(arm, at(reach))])
    return _single(solid, "cross", 2 * reach)


def _tee_forged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded or socket tee: three banded mouths."""
    radius, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    reach = 1.6 * radius + 0.015
    arm = _arm(dn, style, -reach, reach, n)
    up = _arm(dn, style, 0.0, reach, n)
    return _single(merge([along("x", arm, reach), moved(up, at(reach))]), "tee", 2 * reach)


def _tee_flanged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cast tee with flanges at all three mouths, the third closed by a blind flange or open."""
    reach = 0.5 * FLANGES[dn].outer + plate_thickness(dn) + nut_room(dn) + 0.02
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, 2 * reach, [(neck, 0.4 * reach), (neck, 1.6 * reach)])
    branch = moved(moved(disc_flange(dn, style, reach - 0.6 * neck), spun("x", np.pi)), at(reach, 0, reach))
    return Model([Part(merge([body, branch]), "tee", "pipe")], round(2 * reach, 6))


def _eccentric(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An eccentric reducer (ASME B16.9): flat on one side; the run goes on in its first size behind a second one."""
    other = int(rng.choice([size for size in SIZES if size < dn][-3:]))
    first, last = PIPES[dn], PIPES[other]
    length, n = REDUCER_LENGTH[dn], style.round(first.radius)
    down = -(first.radius - last.radius)
    shares = np.array([0.0, 0.15, 0.4, 0.6, 0.85, 1.0])
    ease = 0.5 - 0.5 * np.cos(np.pi * shares)
    stations = [(s * length, e) for s, e in zip(shares, ease, strict=True)]
    stations += [(length + 0.06 + (1 - s) * length, e) for s, e in list(zip(shares, ease, strict=True))[::-1]]
    path = np.array([[x, 0.0, down * e] for x, e in stations])
    radii = [first.radius + (last.radius - first.radius) * e for _, e in stations]
    bores = [bore_of(dn, style) + (bore_of(other, style) - bore_of(dn, style)) * e for _, e in stations]
    half = len(stations) // 2
    pieces = [
        _loft_rounds(path[cut], radii[cut], bores[cut], n)
        for cut in (slice(half), slice(half - 1, half + 1), slice(half, None))
    ]
    names = ("reducer", "pipe", "reducer")
    return Model(
        [Part(solid, name, "pipe") for solid, name in zip(pieces, names, strict=True)],
        round(2 * length + 0.06, 6),
        "welded",
    )


def _loft_rounds(path: Floats, radii: list[float], bores: list[float], sides: int) -> Solid:
    """Rounds on a path joined to a skin, hollow where there are bores [m]."""
    outline = circle(1.0, sides)

    def skin(sizes: list[float]) -> list[Floats]:
        return [
            np.column_stack([np.full(sides, p[0]), p[1] + r * outline[:, 0], p[2] + r * outline[:, 1]])
            for p, r in zip(path, sizes, strict=True)
        ]

    return weld([loft([*skin(radii), *skin(bores)[::-1]], closed=True)]) if min(bores) > 0 else lofted(skin(radii))


def _swage(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A conical reducer to a smaller size, a nipple, and a second cone back."""
    other = int(rng.choice([size for size in SIZES if size < dn][-3:]))
    a, b, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    length = REDUCER_LENGTH[dn]
    places = (0.0, 0.15 * length, 0.85 * length, length)
    skin = list(zip((a, a, b, b), places, strict=True))
    wide, thin = bore_of(dn, style), bore_of(other, style)
    inside = list(zip((wide, wide, thin, thin), places, strict=True))[::-1] if thin else []
    cone = weld([revolve([*skin, *inside], n, closed=True)]) if inside else turned(skin, n)
    whole = 2 * length + 0.08
    back = moved(along("-x", cone), at(whole))
    return Model(
        [
            Part(along("x", cone), "reducer", "pipe"),
            Part(along("x", ring(thin, b, length, length + 0.08, n)), "pipe", "pipe"),
            Part(back, "reducer", "pipe"),
        ],
        whole,
        "welded",
    )


def _spectacle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spectacle blind (ASME B16.48): a ring and a disc on one plate, or a spacer with a handle."""
    size, pipe = FLANGES[dn], PIPES[dn]
    outer, thick, n = 0.49 * (size.circle - size.bolt), 0.006 + 0.06 * pipe.radius, style.round(size.circle / 2)
    shift = size.circle + 0.01
    ring_ = ring(pipe.bore if rng.random() < 0.5 else 0.0, outer, 0, thick, n)
    web = box((shift, 0.5 * outer, thick), (shift / 2, 0, thick / 2))
    if rng.random() < 0.6:
        solid = merge(
            [ring_, _clipped(web, outer, shift - outer), moved(ring(pipe.bore, outer, 0, thick, n), at(shift))]
        )
    else:
        solid = merge([ring_, box((0.10, 0.03, thick), (outer + 0.04, 0, thick / 2))])
    return Model(
        [Part(about_x(moved(solid, spun("z", np.pi / 2))), "blind flange", "flange")], round(thick, 6), "wafer"
    )


def _clipped(_: Solid, low: float, high: float) -> Solid:
    """The web between the two halves of a spectacle [m]."""
    thick = 0.9 * low
    return box((max(high - low, 0.0) + 0.02, 0.4 * thick, 0.008), ((low + high) / 2, 0, 0.006))


def _hose(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hose hanging from a pipe's end: a collar, then a curve to the ground; smooth or corrugated."""
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    reach = float(rng.uniform(6, 14)) * radius + 0.1
    t = np.linspace(0, 1, 22)
    path = np.column_stack([0.03 + reach * t, 0.3 * reach * np.sin(2.5 * t) * t, -0.5 * reach * t**2])
    path = np.vstack([[0.0, 0.0, 0.0], path])
    collar = along(
        "x",
        merge(
            [ring(bore_of(dn, style), 1.3 * radius, 0.0, 0.02, n), hexagon(2.7 * radius, 0.02, 0.035 + 0.2 * radius)]
        ),
    )
    return Model(
        [
            Part(tube(path, 1.1 * radius, 0.85 * radius if style.hollow else 0.0, n), "hose", "rubber"),
            Part(collar, "coupling", "trim"),
        ]
    )


def _turn(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An elbow on a pipe's end: 45, 90 or 180 degrees, short or long or 3D radius, or mitred; then a piece of pipe."""
    size, n = PIPES[dn], style.round(PIPES[dn].radius)
    radius = float(rng.choice([1.0, 1.0, 1.5, 3.0])) * size.outer
    turn = float(rng.choice([0.25, 0.5, 0.5, 1.0])) * np.pi
    roll = spun("x", float(rng.choice([0.0, 0.5, 1.0, 1.5])) * np.pi)
    mitred = bool(rng.random() < 0.3)
    steps = int(rng.integers(2, 5)) if mitred else max(4, round(n * turn / 6))
    angles = np.linspace(0, turn, steps + 1)
    if mitred:
        between = (angles[:-1] + angles[1:]) / 2
        far = radius / np.cos(turn / steps / 2)
        path = np.vstack(
            [
                [0, 0],
                np.column_stack([far * np.sin(between), radius - far * np.cos(between)]),
                [radius * np.sin(turn), radius * (1 - np.cos(turn))],
            ]
        )
    else:
        path = np.column_stack([radius * np.sin(angles), radius * (1 - np.cos(angles))])
    points = np.column_stack([path, np.zeros(len(path))])
    out = np.array([np.cos(turn), np.sin(turn), 0.0])
    tail = points[-1] + out * float(rng.uniform(1, 5)) * size.outer
    bore = bore_of(dn, style)
    parts = [
        Part(moved(tube(points, size.radius, bore, n), roll), "elbow", "pipe"),
        Part(moved(tube(np.vstack([points[-1], tail]), size.radius, bore, n), roll), "pipe", "pipe"),
    ]
    return Model(parts)


def _elbow_forged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded or socket elbow with banded mouths on a pipe's end (ASME B16.11), and a plug or a nipple in it."""
    radius, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    reach = 1.6 * radius + 0.015
    arm = turned(
        [
            (1.3 * radius, -reach),
            (1.3 * radius, -0.6 * reach),
            (1.15 * radius, -0.55 * reach),
            (1.15 * radius, 0.4 * radius),
        ],
        n,
    )
    body = merge(
        [
            along("x", arm, reach),
            moved(along("-y", arm), at(reach)),
            moved(
                turned(
                    [
                        (0.4 * radius, -1.1 * radius),
                        (1.0 * radius, -0.6 * radius),
                        (1.15 * radius, 0.0),
                        (1.0 * radius, 0.6 * radius),
                        (0.4 * radius, 1.1 * radius),
                    ],
                    n,
                ),
                at(reach),
            ),
        ]
    )
    roll = spun("x", float(rng.choice([0.0, 0.5, 1.0, 1.5])) * np.pi)
    tail = along("y", ring(bore_of(dn, style), radius, reach, reach + 0.1 + 2 * radius, n), reach)
    return Model([Part(moved(body, roll), "elbow", "pipe"), Part(moved(tail, roll), "nipple", "pipe")])


def _plug(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded cap: a round or hexagonal cup over a pipe's end."""
    radius, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    length = 1.0 * radius + 0.014
    if rng.random() < 0.5:
        return Model([Part(along("x", hexagon(2.5 * radius + 0.004, 0, length)), "pipe cap", "pipe")])
    outline = [(1.25 * radius + 0.002, 0.0), (1.25 * radius + 0.002, 0.8 * length), (0.9 * radius, length)]
    return Model([Part(along("x", turned(outline, n)), "pipe cap", "pipe")])


def _weldolet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A branch outlet with a pipe: a forged olet's cone or a half coupling, a nipple, and a cap or flange on it."""
    dn = int(rng.choice([15, 20, 25]))
    radius, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    rise = 1.0 * radius + 0.012
    cone = turned([(1.5 * radius, -0.004), (1.5 * radius, 0.25 * rise), (1.05 * radius, rise)], n)
    tall = rise + float(rng.uniform(0.05, 0.2))
    parts = [
        Part(cone, "branch outlet", "pipe"),
        Part(ring(bore_of(dn, style), radius, rise, tall, n), "nipple", "pipe"),
    ]
    kind = int(rng.integers(3))
    if kind == 0:
        parts.append(Part(hexagon(2.6 * radius, tall, tall + radius + 0.01), "pipe cap", "pipe"))
    elif kind == 1:
        parts.append(
            Part(
                moved(
                    disc_flange(dn, style, plate_thickness(dn) + 0.002),
                    at(0, 0, tall + plate_thickness(dn) + 0.002) @ spun("x", np.pi),
                ),
                "flange",
                "flange",
            )
        )
    return Model(parts)


def _blind(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A blind flange: plain disc or drilled, sometimes with a lifting eye, on a flanged end."""
    size, thick = FLANGES[dn], plate_thickness(dn)
    n = style.round(size.outer / 2)
    kind = rng.random()
    solid = (
        disc_flange(dn, style, thick)
        if kind < 0.5
        else cylinder(size.outer / 2, 0.0, float(rng.uniform(0.8, 1.4)) * thick, n)
    )
    parts = [Part(about_x(solid), "blind flange", "flange", "blind flange")]
    if rng.random() < 0.3:
        eye = moved(torus(0.03, 0.006, 14), at(thick + 0.03) @ spun("x", np.pi / 2))
        parts.append(Part(eye, "lifting lug", "fastener", "blind flange", "Tank", True))
    return Model(parts)


_SMALL = tuple(dn for dn in SIZES if dn <= 50)
_SOME = tuple(dn for dn in SIZES if dn <= 200)


def _family(
    name: str, build: object, sizes: tuple[int, ...] = SIZES, place: str = "inline", weight: float = 1.0
) -> Family:
    whole = name.split("/")[0]
    grain = "structure" if whole in ("union", "strainer", "blind flange") else "fitting"
    return Family(name, place, _GROUP, whole, build, sizes, grain, weight)  # type: ignore[arg-type]


FITTINGS: tuple[Family, ...] = (
    _family("coupling/sleeve", _coupling, weight=2),
    _family("union/hexagon", _union, _SMALL, weight=2),
    _family("nipple/hexagon", _nipple, _SMALL),
    _family("expansion joint/flanged", _bellows, weight=1.5),
    _family("expansion joint/welded", _bellows_welded),
    _family("strainer/Y flanged", _y_strainer, _SOME),
    _family("strainer/Y threaded", _y_strainer_threaded, _SMALL),
    _family("strainer/pot", _basket),
    _family("cross/butt weld", _cross, weight=1.5),
    _family("cross/forged", _cross_forged, _SMALL),
    _family("tee/forged", _tee_forged, _SMALL, weight=1.5),
    _family("tee/flanged", _tee_flanged),
    _family("reducer/eccentric", _eccentric, SIZES[2:]),
    _family("reducer/conical", _swage, SIZES[2:]),
    _family("blind flange/spectacle", _spectacle),
    _family("hose/hanging", _hose, _SOME, "end"),
    _family("elbow/end", _turn, SIZES, "end", 4),
    _family("elbow/forged", _elbow_forged, _SMALL, "end", 2),
    _family("pipe cap/threaded", _plug, _SMALL, "end"),
    _family("branch outlet/olet", _weldolet, SIZES, "tap"),
    _family("blind flange/disc", _blind, SIZES, "head"),
)
