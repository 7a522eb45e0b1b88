"""Structures of primitives: sections as sharp prisms, plates and treads as boxes, rails and rungs as plain bars."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import FRAME, disc, family, lying, part, torus_piece
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import bar, box, cylinder, rod, torus
from cadplants.transforms import at, spun

__all__ = ["PRIMITIVE_STEEL"]


def _outline(h: float, kind: str) -> tuple[Floats, tuple[Floats, ...]]:
    """A sharp section of a height [m], its outline and holes."""
    if kind == "I":
        return section_i(h, 0.8 * h, 0.06 * h, 0.09 * h), ()
    if kind == "U":
        return section_channel(h, 0.45 * h, 0.07 * h, 0.1 * h) - (0.2 * h, 0.0), ()
    if kind == "L":
        return section_angle(h, 0.1 * h) - (0.3 * h, 0.3 * h), ()
    if kind == "tube":
        return rounded_rectangle(h, h, 0.0), (rounded_rectangle(0.88 * h, 0.88 * h, 0.0),)
    return rounded_rectangle(0.6 * h, h, 0.0), ()


def _section(rng: np.random.Generator, low: float = 0.06, high: float = 0.25) -> tuple[Floats, tuple[Floats, ...]]:
    return _outline(num(rng, low, high), pick(rng, "I", "I", "U", "L", "tube", "flat"))


def _steel(name: str, *solids: Solid, bundle: str = "") -> Part:
    return part(name, *solids, color="steel", bundle=bundle)


def _foot(x: float, y: float, size: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A plate and a block under a column, or one of them, or neither; plates are square or round [m]."""
    parts = []
    if chance(rng, 0.6):
        thick = num(rng, 0.01, 0.03)
        plate = box((2 * size, 2 * size, thick), (x, y, thick / 2))
        if chance(rng, 0.3):
            plate = moved(disc(1.2 * size, 0.0, thick, style), at(x, y))
        parts.append(_steel("base plate", plate))
    if chance(rng, 0.4):
        deep = num(rng, 0.2, 0.5)
        block = box((3 * size, 3 * size, deep), (x, y, -deep / 2))
        parts.append(part("foundation", block, color="concrete"))
    return parts


def _portal(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Columns and beams of one section, with braces at times: a frame of one or more bays."""
    outline, holes = _section(rng, 0.08, 0.25)
    size = float(np.ptp(outline[:, 1]))
    bays, wide, deep, high = (
        int(rng.integers(1, 4)),
        num(rng, 1.2, 3.0),
        pick(rng, 0.0, num(rng, 1.0, 2.0)),
        num(rng, 1.2, 4),
    )
    parts: list[Part] = []
    sides = (0.0, deep) if deep else (0.0,)
    for y in sides:
        for k in range(bays + 1):
            parts.append(_steel("column", bar((k * wide, y, 0), (k * wide, y, high), outline, holes)))
            parts += _foot(k * wide, y, size, style, rng)
        top = high - size / 2 if chance(rng, 0.5) else high + size / 2
        for k in range(bays):
            parts.append(_steel("beam", bar((k * wide, y, top), ((k + 1) * wide, y, top), outline, holes)))
    if deep:
        for k in range(bays + 1):
            parts.append(_steel("beam", bar((k * wide, 0, 0.98 * high), (k * wide, deep, 0.98 * high), outline, holes)))
    if chance(rng, 0.5):
        thin = _outline(0.5 * size, pick(rng, "L", "flat", "tube"))
        parts.append(_steel("brace", bar((0, 0, 0.1), (wide, 0, 0.95 * high), *thin)))
    return Model(parts)


def _loose_beam(_: int, style: ModelingStyle, rng: np.random.Generator, name: str = "beam") -> Model:
    """A beam on two posts or a lone column."""
    outline, holes = _section(rng)
    size, length = float(np.ptp(outline[:, 1])), num(rng, 1.0, 6.0)
    if name == "column":
        return Model([_steel("column", bar((0, 0, 0), (0, 0, length), outline, holes)), *_foot(0, 0, size, style, rng)])
    high = num(rng, 0.3, 3.0)
    parts = [_steel("beam", bar((0, 0, high), (length, 0, high), outline, holes))]
    for x in (0.15 * length, 0.85 * length):
        post = extrude(rounded_rectangle(0.8 * size, 0.8 * size, 0.0), 0.0, high - size / 2)
        parts.append(_steel(pick(rng, "column", "post"), moved(post, at(x))))
    return Model(parts)


def _deck(_: int, style: ModelingStyle, rng: np.random.Generator, name: str = "platform") -> Model:
    """A flat box as a platform, or crossed bars as a grating, on beams and columns, with single bars as a railing."""
    a, b, high, thick = num(rng, 1.0, 4.0), num(rng, 0.8, 2.0), num(rng, 0.4, 3.0), num(rng, 0.02, 0.06)
    slabs = [box((a, b, thick), (a / 2, 0, high + thick / 2))]
    if name == "grating":
        gap = pick(rng, 0.04, 0.06, 0.1)
        slabs = [box((a, 0.006, thick), (a / 2, float(y), high + thick / 2)) for y in np.arange(-b / 2, b / 2, gap)]
        slabs += [
            box((0.008, b, 0.4 * thick), (float(x), 0, high + 0.8 * thick)) for x in np.arange(0.05, a, 2.5 * gap)
        ]
    parts = [_steel(name, *slabs, bundle=name)]
    size = num(rng, 0.05, 0.14)
    for y in (-b / 2 + size, b / 2 - size):
        parts.append(_steel("beam", box((a, 0.6 * size, size), (a / 2, y, high - size / 2))))
        for x in (size, a - size):
            parts.append(_steel("column", box((size, size, high - size), (x, y, (high - size) / 2))))
    if chance(rng, 0.6):
        parts += _bars(a, -b / 2 + 0.03, high + thick, style, rng)
    return Model(parts)


def _bars(length: float, y: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A railing along x of single posts and rails, round or square, each a piece of its own [m]."""
    high, r = num(rng, 0.9, 1.15), num(rng, 0.012, 0.026)
    square, n = chance(rng, 0.3), min(style.round(r), 16)

    def one(start: tuple[float, float, float], end: tuple[float, float, float]) -> Solid:
        return bar(start, end, rounded_rectangle(2 * r, 2 * r, 0.0)) if square else rod(start, end, r, n)

    xs = np.linspace(0.03, length - 0.03, max(2, int(length / num(rng, 0.7, 1.5)) + 1))
    named = pick(rng, "post", "railing")
    parts = [part(named, one((float(x), y, z), (float(x), y, z + high)), color="safety", bundle="railing") for x in xs]
    for share in (1.0, *((0.5,) if chance(rng, 0.8) else ()), *((0.1,) if chance(rng, 0.3) else ())):
        level = z + share * high
        parts.append(part("railing", one((0, y, level), (length, y, level)), color="safety", bundle="railing"))
    if chance(rng, 0.4):
        parts.append(
            part("railing", box((length, 0.006, 0.1), (length / 2, y, z + 0.06)), color="safety", bundle="railing")
        )
    return parts


def _railing(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A railing of single bars on the floor."""
    return Model(_bars(num(rng, 1.0, 5.0), 0.0, 0.0, style, rng))


def _stairs(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Boxes as treads between two slanted boxes, or blocks on each other."""
    count, wide, rise, going = int(rng.integers(3, 12)), num(rng, 0.6, 1.2), num(rng, 0.15, 0.22), num(rng, 0.2, 0.3)
    solid = chance(rng, 0.3)
    parts = []
    for k in range(count):
        high = (k + 1) * rise if solid else pick(rng, 0.03, 0.03, 0.05)
        center = (k * going, 0, (k + 1) * rise - high / 2)
        parts.append(_steel("stair tread", box((going, wide, high), center), bundle="stair tread"))
    if not solid:
        end = (count * going, count * rise)
        for y in (-wide / 2 - 0.02, wide / 2 + 0.02):
            outline = rounded_rectangle(0.03, num(rng, 0.15, 0.25), 0.0)
            parts.append(_steel("beam", bar((-going / 2, y, 0.1), (end[0], y, end[1]), outline)))
            if chance(rng, 0.6):
                rail = rod((-going / 2, y, 1.0), (end[0], y, end[1] + 0.95), 0.02, min(style.round(0.02), 16))
                parts.append(part("railing", rail, color="safety", bundle="railing"))
                for share in (0.1, 0.9):
                    foot = (share * end[0], y, share * end[1] + 0.1)
                    upright = rod(foot, (foot[0], y, foot[2] + 0.9), 0.018, min(style.round(0.018), 16))
                    parts.append(part("post", upright, color="safety", bundle="railing"))
    return Model(parts)


def _ladder(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two bars and rungs, upright, in one mesh or in single bars; hoops at times."""
    high, wide, r = num(rng, 1.5, 5.0), num(rng, 0.35, 0.5), num(rng, 0.008, 0.016)
    n, flat = min(style.round(r), 12), chance(rng, 0.5)
    solids = []
    for y in (-wide / 2, wide / 2):
        solids.append(box((0.06, 0.012, high), (0, y, high / 2)) if flat else cylinder(1.5 * r, 0, high, n))
        if not flat:
            solids[-1] = moved(solids[-1], at(0, y))
    solids += [rod((0, -wide / 2, z), (0, wide / 2, z), r, n) for z in np.arange(0.25, high - 0.1, 0.28)]
    if high > 2.5 and chance(rng, 0.5):
        for z in np.arange(2.2, high, 0.8):
            solids.append(moved(torus(0.36, 0.015, 16, 4), at(0.36, 0, float(z))))
    if chance(rng, 0.5):
        return Model([_steel("ladder", *solids, bundle="ladder")])
    return Model([_steel("ladder", one, bundle="ladder") for one in solids])


def _post(_: int, style: ModelingStyle, rng: np.random.Generator, name: str = "post") -> Model:
    """An upright of closed round or square section, from knee high to several metres, on a plate or bare.

    Called pipe it runs on as pipes do: with an elbow's start, a flange or a cap on top.
    """
    high = float(np.exp(rng.uniform(np.log(0.3), np.log(5.0))))
    r = num(rng, 0.02, 0.09)
    if name == "post":
        solid = disc(r, 0.0, high, style)
        if chance(rng, 0.4):
            solid = extrude(rounded_rectangle(2 * r, 2 * r, 0.0), 0.0, high)
        parts = [_steel("post", solid), *_foot(0, 0, 1.6 * r, style, rng)]
        if chance(rng, 0.3):
            parts.append(_steel("plate", box((4 * r, 4 * r, 0.01), (0, 0, high + 0.005))))
        return Model(parts)
    pipe = "Pipe assembly"
    bore = 0.88 * r if style.hollow else 0.0
    path = [(0.0, 0.0, 0.0), (0.0, 0.0, high)]
    parts = [part("pipe", torus_piece(path, r, style.round(r), bore), color="pipe", bundle="pipe")]
    kind = int(rng.integers(4))
    if kind == 0:
        parts.append(part("pipe cap", disc(1.1 * r, high, high + 0.8 * r, style), color="pipe"))
    elif kind == 1:
        parts.append(part("flange", disc(2 * r, high - 0.02, high, style), color="flange"))
        parts.append(part("blind flange", disc(2 * r, high + 0.002, high + 0.02, style), color="flange"))
    elif kind == 2:
        steps = np.linspace(0, np.pi / 2, max(3, style.round(r) // 4) + 1)
        bend = np.column_stack([3 * r * (1 - np.cos(steps)), np.zeros(len(steps)), high + 3 * r * np.sin(steps)])
        parts.append(part("elbow", torus_piece(bend, r, style.round(r), bore), color="pipe"))
        arm = [(3 * r, 0.0, high + 3 * r), (3 * r + num(rng, 0.1, 1.0), 0.0, high + 3 * r)]
        parts.append(part("pipe", torus_piece(arm, r, style.round(r), bore), color="pipe"))
    return Model([Part(p.solid, p.name, p.color, p.bundle, pipe if p.name != "pipe" else "") for p in parts])


def _fence(_: int, style: ModelingStyle, rng: np.random.Generator, gate: bool = False) -> Model:
    """Posts with panels of bars, wires or sheet between them; a gate has a leaf with hinges and a latch that stands
    off its posts, at times half open.
    """
    wide, high, r = num(rng, 0.9, 2.5), num(rng, 0.9, 2.2), num(rng, 0.015, 0.035)
    n = min(style.round(r), 12)
    bays = 1 if gate else int(rng.integers(1, 4))
    parts = []
    for k in range(bays + 1):
        upright = moved(
            extrude(circle(r, n) if chance(rng, 0.5) else rounded_rectangle(2 * r, 2 * r, 0), 0, 1.05 * high),
            at(k * wide),
        )
        parts.append(part("post", upright, color="fence", bundle=""))
    gap, name = (num(rng, 0.02, 0.06), "gate") if gate else (0.0, "fence")
    for k in range(bays):
        solids = _panel(wide - 2 * r - 2 * gap, high - 0.1, style, rng)
        pose = at(k * wide + r + gap, 0, 0.08)
        if gate:
            solids.append(box((gap + r, r, 0.05), (-gap / 2, 0, 0.2 * high)))
            solids.append(box((gap + r, r, 0.05), (-gap / 2, 0, 0.75 * high)))
            solids.append(box((0.12, 2.5 * r, 0.03), (wide - 2 * r - 2 * gap, 0, 0.55 * high)))
            pose = pose @ spun("z", pick(rng, 0.0, 0.0, num(rng, 0.2, 1.4)))
        if chance(rng, 0.6):
            parts.append(part(name, *(moved(one, pose) for one in solids), color=name, bundle=name))
        else:
            parts += [part(name, moved(one, pose), color=name, bundle=name) for one in solids]
    return Model(parts)


def _panel(w: float, h: float, style: ModelingStyle, rng: np.random.Generator) -> list[Solid]:
    """A frame with bars, a sheet or slats in it, from the origin in x and z [m]."""
    t = num(rng, 0.015, 0.03)
    frame = [box((w, t, t), (w / 2, 0, z)) for z in (t / 2, h - t / 2)]
    frame += [box((t, t, h), (x, 0, h / 2)) for x in (t / 2, w - t / 2)]
    kind = int(rng.integers(4))
    if kind == 0:
        return [*frame, box((w, 0.2 * t, h), (w / 2, 0, h / 2))]
    if kind == 1:
        return [*frame, *(box((w, 0.4 * t, 0.08), (w / 2, 0, z)) for z in np.arange(0.1, h - 0.1, 0.14))]
    bars = [cylinder(0.35 * t, 0.0, h, 6) for _ in np.arange(0.1, w - 0.05, 0.12)]
    upright = [moved(one, at(0.1 + 0.12 * k)) for k, one in enumerate(bars)]
    if kind == 2:
        return [*frame, *upright]
    return [*frame, *upright, *(lying(cylinder(0.3 * t, 0.0, w, 6), 0, 0, z) for z in np.arange(0.2, h - 0.1, 0.25))]


def _block(_: int, style: ModelingStyle, rng: np.random.Generator, name: str = "foundation") -> Model:
    """A box on the floor: a foundation; an upright one: a wall."""
    if name == "wall":
        size = (num(rng, 1.0, 5.0), num(rng, 0.08, 0.3), num(rng, 0.8, 3.0))
    else:
        size = (num(rng, 0.3, 2.5), num(rng, 0.3, 1.5), num(rng, 0.1, 0.6))
    parts = [part(name, box(size, (0, 0, size[2] / 2)), color="concrete", bundle=name)]
    if name == "foundation" and chance(rng, 0.4):
        parts.append(_steel("base plate", box((0.3, 0.3, 0.02), (0, 0, size[2] + 0.01))))
        outline, holes = _section(rng, 0.08, 0.2)
        parts.append(
            _steel("column", bar((0, 0, size[2] + 0.02), (0, 0, size[2] + num(rng, 0.4, 2.0)), outline, holes))
        )
    return Model(parts)


def _caster(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wheel in a fork of two plates under a top plate or on a stem, with a stop over it at times; four to a frame."""
    r = num(rng, 0.03, 0.1)
    wide, plate, n = 0.6 * r, 0.06 * r + 0.002, style.round(r)
    top = 2.5 * r
    wheel = moved(cylinder(r, -wide / 2, wide / 2, n), at(0, 0, r) @ spun("x", np.pi / 2))
    fork = [
        box((0.9 * r, plate, 1.7 * r), (0.1 * r, s * (wide / 2 + 1.2 * plate), 0.8 * r + 0.85 * r)) for s in (-1, 1)
    ]
    fork.append(box((1.1 * r, wide + 3.4 * plate, plate), (0.1 * r, 0, top)))
    axle = moved(cylinder(0.15 * r, -0.7 * wide, 0.7 * wide, 8), at(0, 0, r) @ spun("x", np.pi / 2))
    stem = chance(rng, 0.4)
    head = (
        moved(cylinder(0.25 * r, 0, 0.9 * r, n), at(0, 0, top))
        if stem
        else box((2 * r, 1.7 * r, plate), (0, 0, top + 1.3 * plate))
    )
    split, places = chance(rng, 0.6), [(0.0, 0.0)]
    if chance(rng, 0.6):
        places = [(x, y) for x in (0.0, 0.8) for y in (0.0, 0.5)]
    parts = []
    for x, y in places:
        turn = at(x, y) @ spun("z", num(rng, 0, 6))
        solids = [wheel, *fork, axle, head]
        groups = [[wheel], fork, [axle], [head]] if split else [solids]
        parts += [
            part("caster", *(moved(one, turn) for one in some), color="rubber", bundle="caster") for some in groups
        ]
    if len(places) > 1:
        high = top + (0.9 * r if stem else 1.8 * plate)
        for y in (0.0, 0.5):
            parts.append(_steel("skid frame", box((1.0, 0.06, 0.06), (0.4, y, high + 0.03)), bundle=""))
    return Model(parts)


_NAMES = ("platform", "grating")

PRIMITIVE_STEEL: tuple[Family, ...] = (
    family("frame/sharp sections", "floor", FRAME, _portal, "beam", (15,), 2.5),
    family("beam/on posts", "floor", FRAME, _loose_beam, "beam", (15,)),
    family("column/sharp section", "floor", FRAME, partial(_loose_beam, name="column"), "column", (15,)),
    *(
        family(f"{name}/on columns", "floor", FRAME, partial(_deck, name=name), name, (15,), grain="fitting")
        for name in _NAMES
    ),
    family("railing/single bars", "floor", FRAME, _railing, "railing", (15,), 1.5),
    family("stairs/boxes", "floor", FRAME, _stairs, "stair tread", (15,), 1.5, "fitting"),
    family("ladder/plain bars", "floor", FRAME, _ladder, "ladder", (15,)),
    family("post/plain upright", "floor", FRAME, _post, "post", (15,), 1.5, "fitting"),
    family("pipe/plain upright", "floor", "Pipe assembly", partial(_post, name="pipe"), "pipe", (15,), 1.5, "fitting"),
    family("fence/framed panel", "floor", FRAME, _fence, "fence", (15,), grain="fitting"),
    family("gate/framed leaf", "floor", FRAME, partial(_fence, gate=True), "gate", (15,), grain="fitting"),
    family("foundation/box", "floor", FRAME, _block, "foundation", (15,), grain="fitting"),
    family("wall/box", "floor", FRAME, partial(_block, name="wall"), "wall", (15,)),
    family("caster/fork of plates", "floor", FRAME, _caster, "caster", (15,), 0.7, "fitting"),
)
