"""Pumps, tanks and equipment of primitives: boxes, cylinders, cones and dishes with nozzles."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import (
    FRAME,
    cone,
    disc,
    dish,
    family,
    lying,
    part,
    pipe_piece,
    sized,
    snout,
    vessel,
)
from cadplants.family import Family, Model, Part, Port
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, cylinder
from cadplants.standards import FLANGES, PIPES, smaller
from cadplants.transforms import at, looking, spun

__all__ = ["PRIMITIVE_MACHINES"]

_PUMP, _TANK, _EQUIPMENT = "Pump unit", "Tank", "Equipment"


def _turned(pose: Floats, parts: list[Part]) -> list[Part]:
    return [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]


def _foundation(size: tuple[float, float], high: float) -> Part:
    """A block under something, below z = 0 [m]."""
    return part("foundation", box((*size, high), (0, 0, -high / 2)), color="concrete", group=FRAME)


def _motor(r: float, length: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """A motor about z from 0 up: a cylinder, with a narrower end, a box on its side or neither [m]."""
    solids = [disc(r, 0.0, length, style)]
    if chance(rng, 0.4):
        solids.append(disc(0.85 * r, length, 1.12 * length, style))
    if chance(rng, 0.35):
        solids.append(dish(r, 0.3 * r, length, style))
    return solids


def _end_suction(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pump along x on a base: a flat cylinder or a box with two snouts, a motor, something between them."""
    out, volute = smaller(dn), PIPES[dn].radius * num(rng, 1.8, 2.6) + 0.03
    axis, reach, rise = volute + num(rng, 0.12, 0.3), volute * num(rng, 0.8, 1.4) + 0.05, volute + num(rng, 0.1, 0.2)
    radius, length = volute * num(rng, 0.6, 1.0), volute * num(rng, 1.8, 3.0)
    thick = volute * num(rng, 0.35, 0.6)
    level = at(0, 0, axis)
    casing = [lying(disc(volute, -thick, thick, style))]
    if chance(rng, 0.25):
        casing = [box((2 * thick, 1.8 * volute, 1.8 * volute))]
    elif chance(rng, 0.3):
        casing.append(lying(cone(volute, 0.4 * volute, thick, 2.2 * thick, style)))
    suction = moved(snout(dn, 0.0, reach, style, rng), spun("y", -np.pi / 2))
    discharge = snout(out, 0.0, rise, style, rng)
    parts = [part("pump casing", *casing, suction, discharge, color="pump", bundle="pump casing")]
    start = thick + length * num(rng, 0.2, 0.5)
    shaft = lying(disc(radius * num(rng, 0.15, 0.35), 0.5 * thick, start, style))
    parts.append(part("shaft", shaft, color="trim", bundle="pump casing"))
    if chance(rng, 0.4):
        guard = box((0.7 * (start - thick), 0.9 * radius, 0.9 * radius), ((start + thick) / 2, 0, 0))
        parts.append(part("coupling guard", guard, color="safety", bundle="pump casing"))
    motor = [lying(one, start) for one in _motor(radius, length, style, rng)]
    parts.append(part("motor", *motor, color="motor", bundle="motor"))
    if chance(rng, 0.4):
        side = box((0.3 * length, 0.5 * radius, 0.5 * radius), (start + 0.5 * length, 0, 1.1 * radius))
        parts.append(part("terminal box", side, color="motor", bundle="motor"))
    parts = _turned(level, parts)
    left, right = -1.2 * thick, start + length
    low = num(rng, 0.05, 0.12)
    feet = [box((1.6 * thick, volute, axis - low), (0, 0, (axis + low) / 2))]
    feet.append(box((0.6 * length, 1.4 * radius, axis - low), (start + 0.5 * length, 0, (axis + low) / 2)))
    base = [box((right - left + 0.1, 2.2 * radius + 0.1, low), ((left + right) / 2, 0, low / 2)), *feet]
    parts.append(part("pump base", *base, color="steel", bundle="pump base"))
    if chance(rng, 0.5):
        block = _foundation((right - left + 0.3, 2.4 * radius + 0.3), num(rng, 0.1, 0.4))
        parts.append(Part(moved(block.solid, at((left + right) / 2)), "foundation", "concrete", "", FRAME))
    ports = (
        Port(looking((-reach, 0, axis), (-1, 0, 0)), dn),
        Port(looking((0, 0, axis + rise), (0, 0, 1)), out),
    )
    return Model(parts, ports=ports, kind="centrifugal pump")


def _inline_pump(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cylinder or ball-like cone in the line with a motor upright or level on it."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 1.2, 2.0), 6)
    wide = r * num(rng, 1.3, 2.0)
    casing = [lying(disc(r, 0.0, length, style)), moved(disc(wide, -0.8 * r, 1.1 * r, style), at(length / 2))]
    motor = _motor(wide * num(rng, 0.6, 0.95), wide * num(rng, 1.5, 3.0) + 0.05, style, rng)
    pose = at(length / 2, 0, r) @ spun("x", pick(rng, 0.0, 0.0, 0.5) * np.pi)
    parts = [part("pump casing", *casing, color="pump", bundle="pump casing")]
    parts.append(part("motor", *(moved(one, pose) for one in motor), color="motor", bundle="motor"))
    return Model(parts, length, pick(rng, "flanged", "welded") if dn <= 50 else "flanged", "circulator")


def _small_pump(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A box with a cylinder on or beside it: a dosing or gear pump."""
    a, b, c = num(rng, 0.15, 0.4), num(rng, 0.12, 0.3), num(rng, 0.15, 0.4)
    body = box((a, b, c), (0, 0, c / 2))
    r = 0.35 * b
    side = lying(disc(r, a / 2, a / 2 + num(rng, 0.1, 0.3), style), 0, 0, 0.5 * c)
    top = moved(disc(r, 0.0, num(rng, 0.1, 0.3), style), at(0, 0, c))
    parts = [part("pump casing", body, side, color="pump", bundle="pump casing")]
    parts.append(part("motor", top, color="motor", bundle="motor"))
    base = box((a + 0.1, b + 0.1, 0.04), (0, 0, -0.02))
    return Model([*parts, part("pump base", base, color="steel", bundle="pump base")], kind="dosing pump")


def _nozzle(dn: int, pose: Floats, low: float, face: float, style: ModelingStyle, rng: np.random.Generator) -> Part:
    """A nozzle of a vessel: a snout along the x axis of a frame from ``low`` to ``face`` [m]."""
    solid = moved(lying(snout(dn, low, face, style, rng)), pose)
    return part("nozzle", solid, color="tank", bundle="nozzle")


def _manway(radius: float, rise: float, style: ModelingStyle, rng: np.random.Generator) -> Part:
    """A wide short neck with a lid about z on z = 0; a davit or a handle on it, or neither [m]."""
    rim, thick = 1.25 * radius, 0.1 * radius
    solids = [disc(radius, -0.3 * rise, rise, style), disc(rim, rise - thick, rise, style)]
    gap = pick(rng, 0.0, 0.0, 0.003)
    solids.append(disc(rim, rise + gap, rise + gap + thick, style))
    kind = int(rng.integers(3))
    if kind == 1:
        solids.append(cylinder(0.06 * radius, rise, rise + radius, 8))
        solids[-1] = moved(solids[-1], at(1.3 * radius))
        solids.append(box((1.4 * radius, 0.1 * radius, 0.1 * radius), (0.65 * radius, 0, rise + radius)))
    elif kind == 2:
        solids.append(box((0.8 * radius, 0.08 * radius, 0.2 * radius), (0, 0, rise + gap + 1.5 * thick)))
    return part("manway", *solids, color="tank", bundle="manway")


def _upright(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str = "tank") -> Model:
    """A vessel about z with dishes, on a skirt, legs or a block, with nozzles and at times a manway."""
    thin = kind != "tank"
    radius = num(rng, 0.12, 0.4) if thin else num(rng, 0.35, 1.3)
    high, depth = radius * num(rng, 1.6, 4.0), radius * pick(rng, 0.25, 0.5, 1.0, 0.0)
    if kind == "separator":
        high, depth = radius * num(rng, 4.0, 8.0), max(depth, 0.25 * radius)
    low = depth + num(rng, 0.2, 0.7)
    name = kind if thin else "shell"
    group = _EQUIPMENT if thin else _TANK
    if depth and chance(rng, 0.4) and not thin:
        heads = [dish(radius, depth, 0.0, style)]
        parts = [part(name, disc(radius, low, low + high, style), color="tank", bundle=name)]
        for pose in (at(0, 0, low + high), at(0, 0, low) @ spun("x", np.pi)):
            parts.append(part("dished head", moved(heads[0], pose), color="tank", bundle=name))
    else:
        solid = vessel(radius, low, low + high, depth, style) if depth else disc(radius, low, low + high, style)
        parts = [part(name, solid, color="tank", bundle=name)]
    if kind == "filter":
        lids = [disc(1.3 * radius, z, z + 0.12 * radius, style) for z in (low + 0.8 * high, low + 0.93 * high)]
        parts = [part(name, *(p.solid for p in parts), *lids, color="tank", bundle=name)]
    parts += _stands(radius, low, style, rng, thin)
    ports = []
    for k in range(int(rng.integers(1, 4))):
        dn = pick(rng, 25, 40, 50, 80) if radius > 0.3 else pick(rng, 15, 25, 40)
        turn, z = 2.1 * k + num(rng, 0, 1.5), low + high * num(rng, 0.1, 0.9)
        pose = at(0, 0, z) @ spun("z", turn)
        face = radius + num(rng, 0.08, 0.2)
        one = _nozzle(dn, pose, 0.8 * radius, face, style, rng)
        parts.append(part(name, one.solid, color="tank", bundle=name) if thin else one)
        ports.append(Port(pose @ at(face), dn, len(parts) - 1))
    if not thin and chance(rng, 0.5):
        lid = _manway(min(0.3, 0.45 * radius), 0.15, style, rng)
        pose = at(0, 0, low + high + 0.7 * depth)
        if chance(rng, 0.5):
            pose = at(0, 0, low + 0.3 * high) @ spun("z", num(rng, 4, 6)) @ at(0.97 * radius) @ spun("y", np.pi / 2)
        parts.append(Part(moved(lid.solid, pose), lid.name, lid.color, lid.bundle))
    return Model(parts, ports=tuple(ports[: 1 if group == _EQUIPMENT else 3]), kind=kind)


def _stands(radius: float, low: float, style: ModelingStyle, rng: np.random.Generator, thin: bool) -> list[Part]:
    """What an upright vessel stands on: a skirt, three or four legs, or a block [m]."""
    kind = int(rng.integers(3))
    if kind == 0 and not thin:
        foot = radius * pick(rng, 1.0, 1.15)
        solids = [cone(foot, radius, 0.0, low, style), disc(1.15 * foot, 0.0, 0.02, style)]
        return [part("skirt", *solids, color="tank", bundle="skirt")]
    if kind == 2:
        return [
            part(
                "foundation",
                box((2.2 * radius, 2.2 * radius, 0.95 * low), (0, 0, 0.475 * low)),
                color="concrete",
                group=FRAME,
            )
        ]
    count, parts = int(rng.integers(3, 5)), []
    size = max(0.03, 0.09 * radius)
    for k in range(count):
        pose = spun("z", 2 * np.pi * k / count) @ at(0.92 * radius)
        leg = (
            box((size, size, 1.2 * low), (0, 0, 0.6 * low))
            if chance(rng, 0.6)
            else disc(0.6 * size, 0, 1.2 * low, style)
        )
        name, group = ("tank leg", _TANK) if not thin else ("column", FRAME)
        parts.append(
            part(name, moved(leg, pose), color="steel", bundle=name if not thin else "", group=group if thin else "")
        )
        if chance(rng, 0.3):
            plate = moved(box((2 * size, 2 * size, 0.012), (0, 0, 0.006)), pose)
            parts.append(part("base plate", plate, color="steel", group=FRAME))
    return parts


def _lying_tank(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str = "tank") -> Model:
    """A vessel about x with dishes on two saddles, with nozzles; an exchanger also has discs round its channel."""
    exchanger = kind != "tank"
    radius = num(rng, 0.12, 0.35) if exchanger else num(rng, 0.3, 1.2)
    half, depth = radius * num(rng, 1.4, 4.0), radius * pick(rng, 0.25, 0.5, 1.0)
    axis = radius + num(rng, 0.2, 0.8)
    level = at(0, 0, axis)
    body: list[Solid] = [lying(vessel(radius, -half, half, depth, style))]
    if exchanger:
        for x in (-0.75 * half, -0.7 * half, *((0.8 * half,) if chance(rng, 0.4) else ())):
            body.append(lying(disc(1.25 * radius, x, x + 0.03 * half, style)))
    elif chance(rng, 0.3):
        body += [lying(disc(1.02 * radius, x, x + 0.05, style)) for x in (-half, half - 0.05)]
    name = kind if exchanger else "shell"
    parts = [part(name, *(moved(one, level) for one in body), color="tank", bundle=name)]
    for x in (-0.6 * half, 0.6 * half):
        plates = [box((0.12 * half, 1.6 * radius, axis - 0.6 * radius), (x, 0, (axis - 0.6 * radius) / 2))]
        plates.append(box((0.2 * half, 1.8 * radius, 0.02), (x, 0, 0.01)))
        if exchanger:
            parts.append(part("foundation", plates[0], color="concrete", group=FRAME))
        else:
            parts.append(part("saddle", *plates[: pick(rng, 1, 2)], color="steel", bundle="saddle"))
    ports = []
    places = np.linspace(-0.85, 0.85, int(rng.integers(2, 5))) * half
    for k, x in enumerate(places):
        dn, down = pick(rng, 25, 40, 50, 80), exchanger and k % 2 == 1
        pose = at(float(x), 0, axis) @ spun("y", (0.5 if down else -0.5) * np.pi)
        face = radius + num(rng, 0.08, 0.2)
        one = _nozzle(dn, pose, 0.8 * radius, face, style, rng)
        parts.append(part(name, one.solid, color="tank", bundle=name) if exchanger else one)
        if not down:
            ports.append(Port(pose @ at(face), dn, len(parts) - 1))
    if not exchanger and chance(rng, 0.5):
        lid = _manway(min(0.3, 0.5 * radius), 0.2, style, rng)
        pose = at(half + 0.8 * depth, 0, axis) @ spun("y", np.pi / 2)
        parts.append(Part(moved(lid.solid, pose), lid.name, lid.color, lid.bundle))
    return Model(parts, ports=tuple(ports), kind=kind)


def _box_tank(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rectangular tank, closed or open at the top, on the floor or on legs."""
    a, b, c = num(rng, 0.5, 2.0), num(rng, 0.4, 1.5), num(rng, 0.4, 1.5)
    low, t = pick(rng, 0.0, 0.3, num(rng, 0.5, 2.0)), 0.01
    solids = [box((a, b, c), (0, 0, low + c / 2))]
    if chance(rng, 0.5):
        solids = [box((a, b, t), (0, 0, low + t / 2))]
        for s in (-1, 1):
            solids.append(box((t, b, c - t), (s * (a - t) / 2, 0, low + t + (c - t) / 2)))
            solids.append(box((a - 2 * t, t, c - t), (0, s * (b - t) / 2, low + t + (c - t) / 2)))
    parts = [part("shell", *solids, color="tank", bundle="shell")]
    if low:
        for x in (-1, 1):
            for y in (-1, 1):
                leg = box((0.06, 0.06, low), (x * (a / 2 - 0.03), y * (b / 2 - 0.03), low / 2))
                parts.append(part("tank leg", leg, color="steel", bundle="tank leg"))
    dn = pick(rng, 25, 40, 50)
    pose = at(0, 0, low + 0.3 * c)
    parts.append(_nozzle(dn, pose, a / 2 - t, a / 2 + 0.12, style, rng))
    return Model(parts, ports=(Port(pose @ at(a / 2 + 0.12), dn, len(parts) - 1),), kind="tank")


def _cased(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str) -> Model:
    """A boiler, compressor, radiator or the like as a box, at times with cylinders on it."""
    a, b, c = num(rng, 0.5, 1.8), num(rng, 0.4, 1.0), num(rng, 0.6, 1.8)
    if kind == "radiator":
        a, b, c = num(rng, 0.4, 2.0), num(rng, 0.05, 0.2), num(rng, 0.3, 0.9)
    low = 0.12 if kind == "radiator" else pick(rng, 0.0, 0.1)
    solids = [box((a, b, c), (0, 0, low + c / 2))]
    if kind == "radiator" and chance(rng, 0.5):
        solids = [box((0.8 * a / 10, b, c), (x, 0, low + c / 2)) for x in np.linspace(-0.45, 0.45, 10) * a] + [
            box((a, 0.3 * b, 0.1 * c), (0, 0, low + z * c)) for z in (0.1, 0.9)
        ]
    if kind == "burner":
        r = 0.25 * c
        solids = [lying(disc(r, -0.3 * a, 0.3 * a, style), 0, 0, low + 2 * r)]
        solids.append(lying(disc(0.55 * r, 0.3 * a, 0.7 * a, style), 0, 0, low + 2 * r))
        solids += [
            box((0.35 * a, 1.2 * r, r), (0, 0, low + 3.2 * r)),
            box((0.1 * a, 0.1 * a, 1.2 * r), (0, 0, low + 0.6 * r)),
        ]
    elif kind == "boiler":
        solids.append(disc(0.2 * b, low + 0.9 * c, low + c + num(rng, 0.1, 0.5), style))
        if chance(rng, 0.4):
            solids.append(lying(disc(0.25 * b, a / 2, a / 2 + 0.3, style), 0, 0, low + 0.4 * c))
    elif kind in ("compressor", "blower"):
        solids = _compressor(a, b, c, low, style) if kind == "compressor" else _blower(a, b, c, low, style)
    parts = [part(kind, *solids, color="tank", bundle=kind)]
    if low and kind != "radiator":
        parts.append(part("foundation", box((a + 0.2, b + 0.2, low), (0, 0, low / 2)), color="concrete", group=FRAME))
    dn = pick(rng, 15, 20, 25)
    ports = []
    for y in (-0.2, 0.2) if kind == "boiler" else (0.0,):
        pose = looking((-a / 2 - 0.06, y * b, low + 0.2 * c), (-1, 0, 0))
        stub = moved(lying(pipe_piece(dn, -0.08, 0.0, style)), pose)
        parts[0] = part(kind, parts[0].solid, stub, color="tank", bundle=kind)
        ports.append(Port(pose, dn, 0))
    return Model(parts, ports=tuple(ports), kind=kind)


def _compressor(a: float, b: float, c: float, low: float, style: ModelingStyle) -> list[Solid]:
    """A lying vessel on two feet with a box, a drum and a motor on it [m]."""
    r = 0.4 * b
    axis = low + 0.15 + r
    solids = [lying(vessel(r, -0.45 * a, 0.45 * a, 0.4 * r, style), 0, 0, axis)]
    solids += [box((0.08 * a, 1.2 * r, axis - low), (x, 0, (axis + low) / 2)) for x in (-0.3 * a, 0.3 * a)]
    top = axis + 0.95 * r
    solids += [
        box((0.8 * a, 1.4 * r, 0.04), (0, 0, top)),
        box((0.25 * a, 0.9 * r, 0.4 * c), (-0.2 * a, 0, top + 0.2 * c)),
    ]
    solids.append(lying(disc(0.45 * r, 0.0, 0.35 * a, style), 0, 0, top + 0.5 * r))
    return solids


def _blower(a: float, b: float, c: float, low: float, style: ModelingStyle) -> list[Solid]:
    """A flat drum across, its square mouth upward, with a motor and a cone for its inlet [m]."""
    r = 0.4 * c
    axis = low + 1.2 * r
    return [
        box((a, b, 0.1 * c), (0, 0, low + 0.05 * c)),
        lying(disc(r, -0.3 * b, 0.3 * b, style), 0, 0, axis),
        box((0.6 * b, 0.6 * r, 1.4 * r), (0, 0.7 * r, axis + 0.7 * r)),
        lying(cone(0.5 * r, 0.7 * r, 0.3 * b, 0.6 * b, style), 0, 0, axis),
        lying(disc(0.4 * r, -0.9 * b, -0.3 * b, style), 0, 0, axis),
        box((0.5 * b, 0.7 * r, axis - low), (-0.6 * b, 0, (axis + low) / 2)),
    ]


def _inline_pot(dn: int, style: ModelingStyle, rng: np.random.Generator, kind: str = "filter") -> Model:
    """An upright vessel that a line runs through."""
    r, length = PIPES[dn].radius, round(FLANGES[dn].outer * num(rng, 1.3, 2.2), 6)
    wide = min(0.45 * length, r * num(rng, 1.4, 2.5))
    pot = vessel(wide, -wide * num(rng, 1.0, 3.0), wide * num(rng, 0.8, 1.5), 0.4 * wide, style)
    solid = merge([lying(disc(r, 0.0, length, style)), moved(pot, at(length / 2))])
    return Model([part(kind, solid, color="tank", bundle=kind)], length, kind=kind)


_MACHINES = sized(40, 150)

PRIMITIVE_MACHINES: tuple[Family, ...] = (
    family("pump/cylinders and boxes", "floor", _PUMP, _end_suction, "pump", _MACHINES, 4),
    family("pump/motor on line", "inline", _PUMP, _inline_pump, "pump", sized(15, 150), 0.8),
    family("pump/box and cylinder", "floor", _PUMP, _small_pump, "pump"),
    family("tank/upright of primitives", "floor", _TANK, _upright, "tank", weight=3),
    family("tank/lying of primitives", "floor", _TANK, _lying_tank, "tank", weight=3),
    family("tank/plain box", "floor", _TANK, _box_tank, "tank", weight=1.5),
    family(
        "heat exchanger/lying of primitives", "floor", _EQUIPMENT, partial(_lying_tank, kind="heat exchanger"), weight=2
    ),
    family("filter/upright of primitives", "floor", _EQUIPMENT, partial(_upright, kind="filter")),
    family("separator/upright of primitives", "floor", _EQUIPMENT, partial(_upright, kind="separator")),
    family("filter/pot on line", "inline", _EQUIPMENT, _inline_pot, weight=0.5),
    *(
        family(f"{kind}/of boxes and cylinders", "floor", _EQUIPMENT, partial(_cased, kind=kind), weight=0.7)
        for kind in ("boiler", "compressor", "blower", "radiator", "burner")
    ),
)
