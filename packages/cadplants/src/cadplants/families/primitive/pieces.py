"""Machines and ways of primitives that stay apart: each cone, disc, plate and bend is a piece of its own."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import FRAME, cone, disc, dish, family, lying, part, sleeve, torus_piece
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box
from cadplants.standards import FLANGES, PIPES, smaller
from cadplants.transforms import at, looking, spun

__all__ = ["PRIMITIVE_PIECES"]

_PUMP, _TANK, _SAFETY = "Pump unit", "Tank", "Electrical and safety"


def _each(name: str, *solids: Solid, color: str = "pump") -> list[Part]:
    return [part(name, solid, color=color, bundle=name) for solid in solids]


def _sector(inner: float, outer: float, first: float, last: float, steps: int) -> Floats:
    """The outline of a piece of a ring between two angles ``(n, 2)`` [m]."""
    angles = np.linspace(first, last, steps + 1)
    out = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.concatenate([outer * out, inner * out[::-1]])


def _nozzle(dn: int, high: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """A nozzle about z from below 0 up to its face: a neck, a hub and a disc, some of them left out [m]."""
    r, rim = PIPES[dn].radius, FLANGES[dn].outer / 2
    thick = pick(rng, 0.02, FLANGES[dn].thickness)
    hub = min(pick(rng, 0.0, 0.05, 1.2 * r), 0.6 * (high - thick))
    solids = [sleeve(PIPES[dn].bore, r, -0.5 * high, high - thick - hub, style)]
    if hub:
        wide = pick(rng, 0.5 * (r + rim), 1.3 * r)
        solids.append(cone(r, min(wide, 0.95 * rim), high - thick - hub, high - thick, style))
    return [*solids, sleeve(PIPES[dn].bore, rim, high - thick, high, style)]


def _volute(r: float, thick: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """The casing of a pump whose shaft is the y axis, its middle in the origin [m]."""
    kind = int(rng.integers(3))
    if kind == 0:  # two bends round the shaft
        path = [(r * float(np.cos(a)), 0.0, r * float(np.sin(a))) for a in np.linspace(0, np.pi, 9)]
        upper = torus_piece(path, thick, style.round(thick))
        solids = [upper, moved(upper, spun("x", np.pi))]
    elif kind == 1:  # a ring in four quarters
        path = [(r * float(np.cos(a)), 0.0, r * float(np.sin(a))) for a in np.linspace(0, np.pi / 2, 6)]
        quarter = torus_piece(path, thick, style.round(thick))
        solids = [moved(quarter, spun("y", k * np.pi / 2)) for k in range(4)]
    else:
        flat = spun("x", np.pi / 2)
        solids = [moved(disc(1.3 * r, -thick, thick, style), flat)]
    flat = spun("x", np.pi / 2)
    for share in (0.7, 0.8)[: int(rng.integers(1, 3))]:
        low = num(rng, 0.1, 0.4) * thick
        solids.append(moved(disc(share * r, thick - low, thick + low, style), flat))
    return solids


def _pump(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An end suction pump along y on a frame of plates: casing, nozzles, shaft, couplings, motor, cover."""
    out = smaller(dn)
    thick = PIPES[out].radius * num(rng, 1.0, 1.6) + 0.01
    r = thick * num(rng, 1.4, 2.6)
    axis, back = r + thick + num(rng, 0.1, 0.3), spun("x", -np.pi / 2)  # lays z along y
    rise, reach = r + thick + num(rng, 0.06, 0.2), thick + num(rng, 0.06, 0.2)
    parts = _each("pump casing", *_volute(r, thick, style, rng))
    suction = spun("x", np.pi / 2)
    for solid in _nozzle(dn, reach, style, rng):
        parts += _each("pump casing", moved(solid, suction))
    side = pick(rng, -1.0, 0.0, 1.0) * r
    for solid in _nozzle(out, rise, style, rng):
        parts += _each("pump casing", moved(solid, at(side)))
    motor, length = num(rng, 0.5, 1.1) * (r + thick), (r + thick) * num(rng, 1.4, 2.6)
    start = thick + num(rng, 0.12, 0.4)
    rod = motor * num(rng, 0.12, 0.3)
    shaft = [moved(disc(rod, 0.0, start + pick(rng, 0.1, 1.05) * length, style), back)]
    for y in np.linspace(thick + 0.04, start - 0.05, int(rng.integers(0, 4))):
        shaft.append(moved(disc(rod * num(rng, 1.8, 3.0), float(y), float(y) + num(rng, 0.015, 0.04), style), back))
    parts += _each("shaft", *shaft, color="trim")
    parts += _each("motor", moved(disc(motor, start, start + length, style), back), color="motor")
    if chance(rng, 0.6):
        gap = pick(rng, 0.0, 0.0, 0.01)
        end = start + length + gap
        cover = disc(motor * pick(rng, 0.9, 1.0, 1.0), end, end + num(rng, 0.15, 0.35) * motor + 0.03, style)
        parts += _each("motor fan cover", moved(cover, back), color="motor")
    if chance(rng, 0.35):
        top = box((0.8 * motor, 0.4 * length, 0.4 * motor), (0, start + 0.5 * length, 1.1 * motor))
        parts += _each("terminal box", top, color="motor")
    parts = [*placed(parts, at(0, 0, axis)), *_frame(r, thick, motor, start, length, axis, rng)]
    ports = (
        Port(looking((0, -reach, axis), (0, -1, 0)), dn),
        Port(looking((side, 0, axis + rise), (0, 0, 1)), out),
    )
    return Model(parts, ports=ports, kind="centrifugal pump")


def _frame(
    r: float, thick: float, motor: float, start: float, length: float, axis: float, rng: np.random.Generator
) -> list[Part]:
    """What a pump and its motor stand on: plates and blocks, at times on a foundation [m]."""
    wide, low = 2.2 * max(r, motor), num(rng, 0.03, 0.08)
    solids = []
    if chance(rng, 0.7):  # one plate under all, or one for each
        deep = start + length + 2 * thick
        solids.append(box((wide, deep, low), (0, 0.5 * (start + length) - 0.2 * thick, 0.5 * low)))
    else:
        solids.append(box((wide, 2.4 * thick + 0.1, low), (0, 0, 0.5 * low)))
        solids.append(box((wide, length, low), (0, start + 0.5 * length, 0.5 * low)))
    high = axis - r - 0.5 * thick
    if high > low:
        solids.append(box((1.6 * r, 1.2 * thick, high - low), (0, 0, 0.5 * (high + low))))
    stand = axis - 0.75 * motor
    if stand > low:
        for share in (0.5,) if chance(rng, 0.3) else (0.2, 0.8):
            y = start + share * length
            solids.append(box((1.6 * motor, pick(rng, 0.02, 0.03, 0.1), stand - low), (0, y, 0.5 * (stand + low))))
    parts = _each("pump base", *solids, color="steel")
    if chance(rng, 0.4):
        deep = start + length + 2 * thick + 0.3
        block = box((wide + 0.3, deep, 0.2), (0, 0.5 * (start + length), -0.1))
        parts.append(part("foundation", block, color="concrete", group=FRAME))
    return parts


def _tank(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A drum along x of a cylinder and two dishes on saddles of plates, its nozzles and manway in pieces."""
    radius = num(rng, 0.3, 1.2)
    half, depth = radius * num(rng, 1.2, 3.5), radius * pick(rng, 0.25, 0.5, 0.9)
    axis = radius + num(rng, 0.15, 0.6)
    head = dish(radius, depth, half, style)
    parts = _each("shell", lying(disc(radius, -half, half, style)), color="tank")
    parts += _each("dished head", lying(head), moved(lying(head), spun("z", np.pi)), color="tank")
    parts = placed(parts, at(0, 0, axis))
    for x in (-0.55 * half, 0.55 * half):
        parts += placed(_saddle(radius, axis, rng), at(x))
    ports = []
    for x in np.linspace(-0.8, 0.8, int(rng.integers(2, 5))) * half:
        dn, face = pick(rng, 25, 50, 80, 100), num(rng, 0.1, 0.25)
        pose = at(float(x), 0, axis) @ spun("x", pick(rng, 0.0, 0.0, 1.0) * np.pi) @ at(0, 0, radius)
        for solid in _nozzle(dn, face, style, rng):
            parts += _each("nozzle", moved(solid, pose), color="tank")
        ports.append(Port(pose @ spun("y", -np.pi / 2) @ at(face), dn, len(parts) - 1))
    if chance(rng, 0.6):
        wide = min(0.3, 0.5 * radius)
        pose = at(half + 0.85 * depth, 0, axis) if chance(rng, 0.6) else at(0, 0, axis + radius) @ spun("y", -np.pi / 2)
        neck = [sleeve(0.95 * wide, wide, -0.5 * depth, 0.15, style), sleeve(wide, 1.25 * wide, 0.13, 0.16, style)]
        lid = [disc(1.25 * wide, 0.162, 0.19, style)]
        parts += _each("manway", *(moved(lying(one), pose) for one in (*neck, *lid)), color="tank")
    return Model(parts, ports=tuple(ports), kind="tank")


def _saddle(radius: float, axis: float, rng: np.random.Generator) -> list[Part]:
    """A saddle across x under a drum: a web, ribs, a foot and a curved pad, each a plate, some left out [m]."""
    t, wide = pick(rng, 0.015, 0.03), 1.9 * radius
    deep = num(rng, 0.12, 0.35)
    low = axis - 0.6 * radius
    solids = []
    if chance(rng, 0.6):  # a web that fits the drum
        angles = np.linspace(np.radians(215), np.radians(325), 9)
        seat = np.column_stack([radius * np.cos(angles), axis + radius * np.sin(angles)])
        outline = np.concatenate([[[-0.95 * radius, 0.0], [0.95 * radius, 0.0]], seat[::-1]])
        web = moved(extrude(outline, -t / 2, t / 2), spun("z", np.pi / 2) @ spun("x", np.pi / 2))
    else:
        web = box((t, wide, low), (0, 0, low / 2))
    solids.append(web)
    for y in np.linspace(-0.5, 0.5, int(rng.integers(0, 4))) * wide if chance(rng, 0.8) else ():
        high = axis - float(np.sqrt(max(radius**2 - min(abs(float(y)), 0.9 * radius) ** 2, 0.0)))
        solids.append(box((deep, t, high), (0, float(y), high / 2)))
    if chance(rng, 0.7):
        solids.append(box((deep, wide, t), (0, 0, t / 2)))
    if chance(rng, 0.5):
        pad = extrude(_sector(radius, radius + t, np.radians(205), np.radians(335), 12), -0.6 * deep, 0.6 * deep)
        solids.append(moved(moved(pad, spun("z", np.pi / 2) @ spun("x", np.pi / 2)), at(0, 0, axis)))
    return _each("saddle", *solids, color="steel")


# --- ways for cables with their fittings ---


def _walls(outline: Floats, high: float, t: float, open_: tuple[int, ...], bottom: bool = True) -> Solid:
    """A bottom over an outline and walls along those of its sides that are not open [m].

    Args:
        outline: ``(n, 2)`` counter-clockwise.
        high: of the walls.
        t: how thick all is.
        open_: numbers of the sides where the way goes on.
        bottom: whether there is one.
    """
    solids = [extrude(outline, 0.0, t)] if bottom else []
    for k in range(len(outline)):
        if k in open_:
            continue
        a, b = outline[k], outline[(k + 1) % len(outline)]
        way = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
        inside = np.array([-way[1], way[0]]) * t
        solids.append(extrude(np.array([a, b, b + inside, a + inside]), t if bottom else 0.0, high))
    return merge(solids)


def _flat_piece(kind: str, wide: float, high: float, other: float, t: float) -> Solid:
    """A fitting on its back, its mouth on x = 0 [m]: a straight, a bend, a tee, a cross, a reducer."""
    w, n = wide / 2, 6
    if kind in ("bend", "half bend"):
        turn, inner = (np.pi / 2 if kind == "bend" else np.pi / 4), 0.5 * wide
        outline = _sector(inner, inner + wide, -np.pi / 2, -np.pi / 2 + turn, n)
        outline = outline + np.array([0.0, inner + w])
        return _walls(outline, high, t, (n, len(outline) - 1))
    if kind == "reducer":
        o = other / 2
        outline = np.array([[0, -w], [wide, -o], [wide, o], [0, w]], float)
        return _walls(outline, high, t, (1, 3))
    if kind in ("tee", "cross"):
        a = wide / 4 + wide
        outline = np.array([[0, -w], [a / 2, -w], [a / 2, -a], [a / 2 + wide, -a], [a / 2 + wide, -w], [a + wide, -w]])
        upper = outline * np.array([1.0, -1.0]) if kind == "cross" else np.array([[0, w], [a + wide, w]], float)
        return _walls(np.concatenate([outline, upper[::-1]]), high, t, (2, 5, 8, 11) if kind == "cross" else (2, 5, 7))
    outline = np.array([[0, -w], [other, -w], [other, w], [0, w]], float)
    return _walls(outline, high, t, (1, 3))


def _upright_bend(wide: float, high: float, t: float, outside: bool, turn: float) -> Solid:
    """A bend upward or downward: two curved cheeks and a curved bottom [m]."""
    inner = 0.3 * wide
    first, last = -np.pi / 2, -np.pi / 2 + turn
    back = (
        _sector(inner + high - t, inner + high, first, last, 6)
        if outside
        else _sector(inner, inner + t, first, last, 6)
    )
    cheek = _sector(inner, inner + high, first, last, 6)
    solids = [extrude(back, 0.0, wide), extrude(cheek, 0.0, t), extrude(cheek, wide - t, wide)]
    return moved(merge(solids), at(0, wide / 2, inner + high) @ spun("x", np.pi / 2))


def _way(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cable way of channels: straight pieces, bends to the side and upward, tees, crosses and reducers, in a row."""
    wide, high = pick(rng, 0.1, 0.2, 0.3, 0.5), pick(rng, 0.05, 0.1, 0.1, 0.15)
    t, level = pick(rng, 0.002, 0.005, 0.01), num(rng, 0.6, 3.0)
    kinds = ("straight", "bend", "half bend", "tee", "cross", "reducer", "up", "down")
    parts, pose = [], at(0, 0, level)
    for k in range(int(rng.integers(4, 9))):
        kind = "straight" if k % 2 == 0 else str(rng.choice(kinds))
        flip = spun("x", pick(rng, 0.0, 0.0, 1.0) * np.pi) if kind in ("bend", "half bend") else np.eye(4)
        length = num(rng, 0.2, 3.5)
        if kind in ("up", "down"):
            turn = pick(rng, 0.25, 0.5) * np.pi
            solid = _upright_bend(wide, high, t, kind == "up", turn)
            reach = 0.3 * wide + high
            end = at(reach * float(np.sin(turn)), 0, reach * (1 - float(np.cos(turn)))) @ spun("y", -turn)
        else:
            other = length if kind == "straight" else 0.5 * wide
            solid = _flat_piece(kind, wide, high, other, t)
            way = {"straight": length, "reducer": wide, "tee": 2.25 * wide, "cross": 2.25 * wide}.get(kind, 0.0)
            end = at(way)
            if kind in ("bend", "half bend"):
                turn = np.pi / 2 if kind == "bend" else np.pi / 4
                end = at(wide * float(np.sin(turn)), wide * (1 - float(np.cos(turn)))) @ spun("z", turn)
        if flip[1, 1] < 0:  # to the other side: mirrored, so that its bottom stays below
            solid = moved(solid, np.diag([1.0, -1.0, 1.0, 1.0]))
            end = np.diag([1.0, -1.0, 1.0, 1.0]) @ end @ np.diag([1.0, -1.0, 1.0, 1.0])
        parts += _each("cable tray", moved(solid, pose), color="electrical")
        if kind == "straight" and length > 0.8 and abs(pose[2, 0]) < 0.1 and chance(rng, 0.4):
            foot = (pose @ at(length / 2))[:3, 3]
            post = box((0.05, 0.05, foot[2]), (foot[0], foot[1], foot[2] / 2))
            parts.append(part("post", post, color="steel", group=FRAME))
        if kind == "reducer":
            wide *= 0.5
        pose = pose @ end
    return Model(parts)


# --- handrails of tubes and bends ---


def _handrail(_: int, style: ModelingStyle, rng: np.random.Generator, slope: float = 0.0) -> Model:
    """Handrails of straight tubes, each bend, return and post a piece, on both sides of a flight or a walk."""
    length, high = num(rng, 0.8, 3.0), num(rng, 0.85, 1.1)
    r, wide = pick(rng, 0.0169, 0.021, 0.024, 0.03), num(rng, 0.7, 1.5)
    n, bore = min(style.round(r), 24), 0.88 * r if style.hollow else 0.0
    way = np.array([1.0, 0.0, slope]) / float(np.hypot(1.0, slope))
    gap = pick(rng, 0.0, 0.0, 0.001)
    parts: list[Part] = []
    for y in (0.0, wide)[: int(rng.integers(1, 3))]:
        solids: list[Solid] = []
        low, top = np.array([0.0, y, high]), np.array([length, y, high + slope * length])
        solids.append(torus_piece(np.array([low, top]), r, n, bore))
        for share in pick(rng, (), (0.5,), (0.5,), (0.35, 0.7)):
            thin = r * pick(rng, 0.7, 0.9, 1.0)
            drop = np.array([0.0, 0.0, -high * (1 - share)])
            solids.append(torus_piece(np.array([low + drop, top + drop]), thin, n, 0.88 * thin if bore else 0.0))
        for end, ahead in ((low, -way), (top, way)):
            solids += _rail_end(end + gap * ahead, ahead, r, n, bore, high, rng)
        for x in np.linspace(0, length, int(length / 1.3) + 2):
            if chance(rng, 0.85):
                foot = np.array([x, y, slope * x])
                solids.append(torus_piece(np.array([foot, foot + np.array([0.0, 0.0, high - r])]), r, n, bore))
        parts += [part("railing", solid, color="safety", bundle="railing") for solid in solids]
    if slope:
        for k in range(1, 7):
            tread = box((0.25, wide, pick(rng, 0.03, 0.05)), (length * k / 7, wide / 2, slope * length * k / 7))
            parts.append(part("stair tread", tread, color="steel"))
    elif chance(rng, 0.7):
        floor = box((length + 0.1, wide + 0.1, 0.04), (length / 2, wide / 2, -0.02))
        parts.append(part(pick(rng, "platform", "grating", "plate"), floor, color="steel"))
    return Model(parts)


def _rail_end(
    end: Floats, ahead: Floats, r: float, n: int, bore: float, high: float, rng: np.random.Generator
) -> list[Solid]:
    """How a rail ends: a bend down onto a post, a return to the knee rail, a hook, or just so [m]."""
    kind, bend = pick(rng, "post", "return", "hook", "plain"), r * pick(rng, 2.0, 3.0, 4.0)
    down = np.array([0.0, 0.0, -1.0])
    if kind == "plain":
        return []
    span = {"post": 1.0, "return": 1.0, "hook": 0.5}[kind] * np.pi
    # Round an axis across the way: from straight ahead to straight down, and on to straight back.
    side = down - (down @ ahead) * ahead
    side = side / float(np.linalg.norm(side))
    if kind == "post":
        span = float(np.arccos(np.clip(ahead @ down, -1, 1)))
    angles = np.linspace(0, span, 9)
    path = end + bend * (np.sin(angles)[:, None] * ahead + (1 - np.cos(angles))[:, None] * side)
    solids = [torus_piece(path, r, n, bore)]
    if kind == "post":
        length = high - bend
        solids.append(torus_piece(np.array([path[-1], path[-1] + length * down]), r, n, bore))
    elif kind == "return":
        solids.append(torus_piece(np.array([path[-1], path[-1] - 0.3 * ahead]), r, n, bore))
    return solids


PRIMITIVE_PIECES: tuple[Family, ...] = (
    family("pump/in pieces", "floor", _PUMP, _pump, "pump", weight=2.5, grain="fitting"),
    family("tank/in pieces", "floor", _TANK, _tank, "tank", weight=2.5, grain="fitting"),
    family("cable tray/channel fittings", "floor", _SAFETY, _way, "cable tray", (15,), 2.5, "fitting"),
    family("railing/tubes and bends", "floor", FRAME, _handrail, "railing", (15,), 1.5, "fitting"),
    family("railing/flight of tubes", "floor", FRAME, partial(_handrail, slope=0.7), "railing", (15,), 1.5, "fitting"),
)
