"""Valves of primitives: cones, hourglasses, cylinders, balls and boxes with a spindle and what turns it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import cone, disc, dish, family, lying, part, sized, spoked
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.plant import Turning
from cadplants.primitives import ball, box, cylinder, torus, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["PRIMITIVE_VALVES"]

_VALVE, _BODY = "Valve assembly", "valve body"
_TURNS = {name: Turning(name) for name in ("handwheel", "lever")}
_KINDS = ("gate valve", "globe valve", "ball valve", "valve")


def _length(dn: int, rng: np.random.Generator) -> float:
    """Face to face [m]."""
    return round(FLANGES[dn].outer * num(rng, 0.8, 1.5) + num(rng, 0.0, 0.08), 6)


def _wide(dn: int, rng: np.random.Generator, small: bool) -> float:
    """Radius of a body at its ends [m]."""
    least = PIPES[dn].radius
    if small:
        return least * pick(rng, 1.0, 1.0, 1.15, 1.4)
    return least + (FLANGES[dn].outer / 2 - least) * pick(rng, 0.1, 0.4, 0.6, 0.8, 1.0)


def _plates(dn: int, length: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """Discs that stand for its own flanges, or none."""
    if chance(rng, 0.55):
        return []
    thick = min(pick(rng, 0.01, 0.016, FLANGES[dn].thickness), 0.2 * length)
    radius = FLANGES[dn].outer / 2
    return [lying(disc(radius, 0.0, thick, style)), lying(disc(radius, length - thick, length, style))]


def _top(dn: int, x: float, style: ModelingStyle, rng: np.random.Generator, low: float = 0.0) -> list[Part]:
    """A spindle over the middle of a body and what turns it: nothing, a wheel, a bar, a drive."""
    r = PIPES[dn].radius
    rise = low + r * num(rng, 0.8, 2.2) + num(rng, 0.03, 0.16)
    stem = r * num(rng, 0.12, 0.4) + 0.003
    spindle = disc(stem, low, rise, style)
    if chance(rng, 0.25):
        hood = cone(r * num(rng, 0.6, 1.0), stem, low, low + 0.5 * (rise - low), style)
        parts = [part("valve bonnet", hood, bundle=_BODY), part("valve stem", spindle, color="trim", bundle=_BODY)]
    else:
        parts = [part("valve stem", spindle, color="trim", bundle=_BODY)]
    parts += _turner(dn, rise, style, rng)
    return placed([replace(p, turns=_TURNS.get(p.name)) for p in parts], at(x))


def _turner(dn: int, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What stands on a spindle about z that ends at a height [m]."""
    r = PIPES[dn].radius
    wheel = r * num(rng, 0.9, 1.9) + num(rng, 0.02, 0.06)
    thick = max(0.005, 0.09 * wheel)
    kind = int(rng.integers(9))
    if kind < 2:
        return []
    if kind == 2:
        return [part("handwheel", disc(wheel, z - thick, z + thick, style), color="handle", bundle="handwheel")]
    if kind == 3:
        rim = moved(torus(wheel, thick, int(min(style.round(wheel), 24)), 6), at(0, 0, z))
        bars = [moved(box((2 * wheel, thick, thick)), at(0, 0, z) @ spun("z", turn)) for turn in (0.0, np.pi / 2)]
        return [part("handwheel", rim, *bars, color="handle", bundle="handwheel")]
    if kind == 4:
        rim, *bars = spoked(wheel, thick, int(rng.integers(3, 6)), style)
        lifted = [moved(one, at(0, 0, z - thick)) for one in (rim, *bars)]
        if chance(rng, 0.5):
            return [part("handwheel", *lifted, color="handle", bundle="handwheel")]
        return [part("handwheel", one, color="handle", bundle="handwheel") for one in lifted]
    if kind == 5:
        reach, turn = 2.2 * r + num(rng, 0.08, 0.2), pick(rng, 0.0, np.pi / 2, np.pi)
        bar = box((reach, max(0.012, 0.2 * r), max(0.005, 0.08 * r)), (0.45 * reach, 0, z))
        return [part("lever", moved(bar, spun("z", turn)), color="handle", bundle="lever")]
    wide, high = r * num(rng, 0.9, 1.7) + 0.03, r * num(rng, 0.8, 2.4) + 0.05
    if kind == 6:
        drive = merge([disc(wide, z, z + 0.3 * high, style), dish(wide, 0.5 * high, z + 0.3 * high, style)])
    elif kind == 7:
        drive = box((2 * wide, num(rng, 1.0, 2.0) * wide, high), (0, 0, z + high / 2))
    else:
        drive = disc(0.6 * wide, z, z + high, style)
        if chance(rng, 0.5):
            drive = merge([drive, lying(disc(0.4 * wide, -1.4 * wide, 1.4 * wide, style), 0, 0, z + 0.5 * high)])
    return [part("actuator", drive, bundle="actuator")]


def _model(
    parts: list[Part], length: float, rng: np.random.Generator, small: bool, kind: str = "", split: bool = False
) -> Model:
    joint = "welded" if small else "flanged"
    return Model(parts, length, joint, kind or pick(rng, *_KINDS), split=split)


def _two_cones(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """Two cones point to point or nearly so, each a piece of its own, and a spindle."""
    length, wide = _length(dn, rng), _wide(dn, rng, small)
    waist = wide * pick(rng, 0.0, 0.12, 0.3, 0.5)
    plates = [] if small else _plates(dn, length, style, rng)
    first = merge([lying(cone(wide, waist, 0.0, length / 2, style)), *plates[:1]])
    last = merge([lying(cone(waist, wide, length / 2, length, style)), *plates[1:]])
    parts = [part(_BODY, first, bundle=_BODY), part(_BODY, last, bundle=_BODY)]
    return _model(parts + _top(dn, length / 2, style, rng), length, rng, small, split=True)


def _hourglass(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """A body with a waist as one surface of revolution."""
    length, wide = _length(dn, rng), _wide(dn, rng, small)
    waist, flat = wide * num(rng, 0.15, 0.6), length * pick(rng, 0.0, 0.06, 0.15)
    outline = [(wide, 0.0), (waist, length / 2), (wide, length)]
    if flat:
        outline[0:1] = [(wide, 0.0), (wide, flat)]
        outline[-1:] = [(wide, length - flat), (wide, length)]
    solid = lying(turned(outline, style.round(wide)))
    plates = [] if small else _plates(dn, length, style, rng)
    return _model([part(_BODY, solid, *plates, bundle=_BODY), *_top(dn, length / 2, style, rng)], length, rng, small)


def _barrel(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """A cylinder along the line; at times nothing else."""
    length, wide = _length(dn, rng) * num(rng, 0.5, 1.0), _wide(dn, rng, small)
    solid = lying(disc(wide, 0.0, length, style))
    top = [] if chance(rng, 0.3) else _top(dn, length / 2, style, rng, 0.0 if chance(rng, 0.5) else 0.9 * wide)
    return _model([part(_BODY, solid, bundle=_BODY), *top], length, rng, small)


def _ball(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """A ball on a cylinder along the line, between two discs or none."""
    length, r = _length(dn, rng), PIPES[dn].radius
    neck = lying(disc(r * pick(rng, 1.0, 1.1, 1.3), 0.0, length, style))
    wide = min(0.48 * length, r * num(rng, 1.3, 1.9))
    middle = moved(ball(wide, style.round(wide)), at(length / 2))
    plates = [] if small else _plates(dn, length, style, rng)
    parts = [part(_BODY, neck, middle, *plates, bundle=_BODY), *_top(dn, length / 2, style, rng, 0.5 * wide)]
    return _model(parts, length, rng, small, "ball valve")


def _block(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """A box with a spindle, between ends of pipe."""
    length, r = _length(dn, rng), PIPES[dn].radius
    size = (length * num(rng, 0.35, 0.8), r * num(rng, 2.2, 3.2), r * num(rng, 2.2, 3.4))
    ends = lying(disc(r * pick(rng, 1.0, 1.2), 0.0, length, style))
    solid = merge([ends, box(size, (length / 2, 0, 0))])
    return _model(
        [part(_BODY, solid, bundle=_BODY), *_top(dn, length / 2, style, rng, 0.45 * size[2])], length, rng, small
    )


def _globe(dn: int, style: ModelingStyle, rng: np.random.Generator, small: bool = False) -> Model:
    """Two cones with an upright cylinder or a third cone where they meet."""
    length, wide = _length(dn, rng), _wide(dn, rng, small)
    waist = 0.5 * wide
    cones = [lying(cone(wide, waist, 0.0, length / 2, style)), lying(cone(waist, wide, length / 2, length, style))]
    high = wide * num(rng, 0.9, 1.6)
    hood = (
        cone(waist, wide * pick(rng, 0.5, 0.9), 0.0, high, style) if chance(rng, 0.6) else disc(waist, 0, high, style)
    )
    parts = [part(_BODY, *cones, bundle=_BODY), part("valve bonnet", hood, bundle=_BODY)]
    return _model(parts + _top(dn, length / 2, style, rng, 0.9 * high), length, rng, small, "globe valve")


def _control(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two cones, a spindle and a dish or a barrel over it."""
    made = _hourglass(dn, style, rng)
    r = PIPES[dn].radius
    rise, wide = 2.2 * r + num(rng, 0.1, 0.25), 1.6 * r + num(rng, 0.04, 0.12)
    middle = made.length / 2
    rod = moved(disc(0.2 * r + 0.004, 0.0, rise, style), at(middle))
    drive = moved(merge([disc(wide, rise, rise + 0.02, style), dish(wide, 0.5 * wide, rise + 0.02, style)]), at(middle))
    parts = [made.parts[0], part("valve stem", rod, color="trim", bundle=_BODY)]
    return _model([*parts, part("actuator", drive, bundle="actuator")], made.length, rng, False, "control valve")


def _check(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A body without a spindle: an hourglass with a bar across, a cylinder or a ball, maybe a flat lid."""
    length, wide = _length(dn, rng), _wide(dn, rng, False)
    r = PIPES[dn].radius
    kind = int(rng.integers(3))
    if kind == 0:
        solids = [lying(turned([(wide, 0.0), (0.4 * wide, length / 2), (wide, length)], style.round(wide)))]
        if chance(rng, 0.5):
            solids.append(disc(0.15 * r, -wide, wide, style))
            solids[-1] = moved(solids[-1], at(length / 2))
    elif kind == 1:
        solids = [lying(cone(wide, 0.6 * wide, 0.0, length, style))]
    else:
        solids = [lying(disc(r, 0.0, length, style)), moved(ball(1.4 * r, style.round(1.4 * r)), at(length / 2))]
    parts = [part(_BODY, *solids, *_plates(dn, length, style, rng), bundle=_BODY)]
    if chance(rng, 0.4):
        lid = moved(disc(0.8 * r, 0.6 * r, 1.4 * r + 0.01, style), at(length / 2))
        parts.append(part("valve bonnet", lid, bundle=_BODY))
    return _model(parts, length, rng, False, "check valve")


def _butterfly(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thin cylinder between the flanges, a spindle on it, a box, wheel or bar on top."""
    length = round(0.03 + 0.25 * PIPES[dn].outer * num(rng, 0.6, 1.2), 6)
    wide = FLANGES[dn].raised / 2 * num(rng, 0.92, 1.0)
    parts = [part(_BODY, lying(disc(wide, 0.0, length, style)), bundle=_BODY)]
    neck = disc(min(0.3 * length, 0.012 + 0.1 * wide), 0.8 * wide, wide + num(rng, 0.05, 0.12), style)
    parts.append(part("valve stem", moved(neck, at(length / 2)), color="trim", bundle=_BODY))
    top = wide + 0.04
    if chance(rng, 0.4):
        gear = box((0.9 * wide, 0.6 * wide + 0.02, 0.06), (length / 2, 0.2 * wide, top + 0.03))
        wheel = moved(
            disc(0.6 * wide + 0.03, 0, 0.015, style), at(length / 2, 0.6 * wide, top + 0.03) @ spun("x", -np.pi / 2)
        )
        parts += [
            part("gearbox", gear, bundle="gearbox"),
            part("handwheel", wheel, color="handle", bundle="handwheel"),
        ]
    elif chance(rng, 0.7):
        reach = wide + num(rng, 0.1, 0.25)
        bar = moved(box((reach, 0.025, 0.008), (0.45 * reach, 0, top + 0.04)), at(length / 2))
        parts.append(part("lever", bar, color="handle", bundle="lever"))
    return Model(parts, length, "wafer", "butterfly valve")


def _three_way(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Three cones point to point, the third upright, and a spindle or none."""
    length, wide = _length(dn, rng), _wide(dn, rng, False)
    waist = 0.25 * wide
    down = pick(rng, 0.0, np.pi)
    third = moved(cone(waist, wide, 0.0, length / 2, style), at(length / 2) @ spun("x", down))
    cones = [
        lying(cone(wide, waist, 0.0, length / 2, style)),
        lying(cone(waist, wide, length / 2, length, style)),
        third,
    ]
    parts = [part(_BODY, *cones, bundle=_BODY)]
    return _model(parts + (_top(dn, length / 2, style, rng) if down else []), length, rng, False, "three-way valve")


def _angle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two cones at a right angle and a tall cylinder over them: a relief valve on a flange."""
    wide, reach = _wide(dn, rng, False), FLANGES[dn].outer * num(rng, 0.7, 1.1)
    waist = 0.3 * wide
    inlet = lying(cone(wide, waist, 0.0, reach, style))
    side = moved(cone(waist, 1.2 * wide, 0.0, reach, style), at(reach) @ spun("y", 0.0))
    tower = lying(disc(0.7 * wide, 0.0, num(rng, 2.0, 4.0) * wide, style), reach)
    parts = [
        part(_BODY, inlet, bundle=_BODY),
        part(_BODY, side, bundle=_BODY),
        part("valve bonnet", tower, bundle=_BODY),
    ]
    return Model(parts, kind="relief valve")


def _tap(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small valve upright on an outlet: two cones or a cylinder, a spindle to the side, a stub or a plug on top."""
    high, wide = num(rng, 0.05, 0.12), num(rng, 0.012, 0.024)
    if chance(rng, 0.5):
        body = turned([(wide, 0.0), (0.3 * wide, high / 2), (wide, high)], style.round(wide))
    else:
        body = disc(wide, 0.0, high, style)
    parts = [part(_BODY, body, bundle=_BODY)]
    spindle = moved(
        disc(0.35 * wide, 0.0, 3 * wide, style), at(0, 0, high / 2) @ spun("x", pick(rng, 1.0, -1.0) * np.pi / 2)
    )
    parts.append(part("valve stem", spindle, color="trim", bundle=_BODY))
    if chance(rng, 0.6):
        stub = disc(0.6 * wide, high, high + num(rng, 0.02, 0.15), style)
        parts.append(part("pipe", stub, color="pipe", group="Pipe assembly"))
    return Model(parts, kind=pick(rng, "drain valve", "vent valve"))


def _melted(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Body, bonnet and wheel or bar as one closed surface about the spindle, with screwed ends: never in pieces."""
    length, r = round(PIPES[dn].outer * num(rng, 1.8, 2.8) + 0.02, 6), PIPES[dn].radius
    end = pick(rng, 6, 8, style.round(1.3 * r))
    across = [cylinder(r * num(rng, 1.2, 1.5), 0.0, length, end)]
    hub, stem = r * num(rng, 0.9, 1.3), 0.25 * r + 0.002
    rise, wheel = r * num(rng, 1.8, 3.0), r * num(rng, 1.2, 2.2) + 0.01
    thick = 0.15 * wheel
    outline = [(hub, -hub), (hub, 0.55 * rise), (stem, 0.7 * rise), (stem, rise), (wheel, rise), (wheel, rise + thick)]
    if chance(rng, 0.5):
        upright = moved(turned(outline, style.round(wheel)), at(length / 2))
    else:
        reach = 2.5 * r + num(rng, 0.04, 0.1)
        bar = box((reach, 0.6 * r, 0.2 * r), (0.4 * reach, 0, rise))
        upright = moved(merge([turned(outline[:4], style.round(hub)), bar]), at(length / 2))
    solid = merge([lying(across[0]), upright])
    kind = pick(rng, "ball valve", "gate valve", "globe valve")
    return Model([Part(solid, "valve", "valve", "valve")], length, "welded", kind)


_BIG, _SMALL = sized(25, 400), sized(15, 50)

PRIMITIVE_VALVES: tuple[Family, ...] = (
    family("valve/two cones", "inline", _VALVE, _two_cones, weight=4),
    family("valve/hourglass", "inline", _VALVE, _hourglass, weight=3),
    family("valve/cylinder", "inline", _VALVE, _barrel, weight=2),
    family("valve/ball of primitives", "inline", _VALVE, _ball, weight=2),
    family("valve/block", "inline", _VALVE, _block),
    family("valve/three cones", "inline", _VALVE, _globe, weight=2),
    family("valve/cones and dish", "inline", _VALVE, _control, "valve", _BIG, 1.5),
    family("valve/no spindle", "inline", _VALVE, _check, weight=1.5),
    family("valve/thin cylinder", "inline", _VALVE, _butterfly, "valve", sized(40, 400), 1.5),
    family("valve/tripod of cones", "inline", _VALVE, _three_way, weight=0.7),
    family("valve/small two cones", "inline", _VALVE, partial(_two_cones, small=True), "valve", _SMALL, 1.5),
    family("valve/small hourglass", "inline", _VALVE, partial(_hourglass, small=True), "valve", _SMALL, 1.5),
    family("valve/small cylinder", "inline", _VALVE, partial(_barrel, small=True), "valve", _SMALL),
    family("valve/small ball", "inline", _VALVE, partial(_ball, small=True), "valve", _SMALL),
    family("valve/melted", "inline", _VALVE, _melted, "valve", _SMALL, 1.5),
    family("valve/angle cones", "head", _VALVE, _angle, weight=1.5),
    family("valve/on outlet", "tap", _VALVE, _tap, weight=1.5),
)
