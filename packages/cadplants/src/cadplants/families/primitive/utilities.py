"""Cable ways, boxes, lamps and supports of primitives."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import FRAME, cone, disc, family, lying, part, torus_piece
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import ball, bar, box, cylinder, ring, rod
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["PRIMITIVE_UTILITIES"]

_SAFETY, _HELD = "Electrical and safety", "Connection assembly"


def _duct_piece(length: float, wide: float, high: float, kind: str, rng: np.random.Generator) -> list[Solid]:
    """A straight piece of a cable way along x from 0, its underside on z = 0 [m]."""
    t = max(0.002, 0.02 * wide)
    if kind == "solid":
        return [box((length, wide, high), (length / 2, 0, high / 2))]
    if kind == "duct":
        outer = rounded_rectangle(wide, high, 0.0)
        hole = rounded_rectangle(wide - 2 * t, high - 2 * t, 0.0)
        return [bar((0, 0, high / 2), (length, 0, high / 2), outer, (hole,))]
    if kind == "tray":
        solids = [box((length, wide, t), (length / 2, 0, t / 2))]
        return solids + [box((length, t, high), (length / 2, s * (wide - t) / 2, high / 2)) for s in (-1, 1)]
    rails = [box((length, 2 * t, high), (length / 2, s * (wide / 2 - t), high / 2)) for s in (-1, 1)]
    gap = pick(rng, 0.2, 0.25, 0.3)
    rungs = [box((0.03, wide - 4 * t, 0.4 * high), (x, 0, 0.3 * high)) for x in np.arange(0.1, length, gap)]
    return [*rails, *rungs]


def _tray(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str = "duct") -> Model:
    """A cable way of many metres, in one or more pieces with flanged collars and a turn at times, on posts or hung."""
    wide, high = pick(rng, 0.1, 0.2, 0.3, 0.4, 0.6), pick(rng, 0.05, 0.1, 0.1, 0.2, 0.3)
    level, count = num(rng, 0.4, 3.0), int(rng.integers(1, 4))
    collars = kind in ("duct", "solid") and chance(rng, 0.4)
    parts: list[Part] = []
    pose = at(0, 0, level)
    for k in range(count):
        length = num(rng, 1.0, 6.0 if kind != "rungs" else 3.0)
        pieces = [moved(one, pose) for one in _duct_piece(length, wide, high, kind, rng)]
        whole = kind != "rungs" or chance(rng, 0.5)
        shapes = [merge(pieces)] if whole else pieces
        if collars:
            edge = box((0.02, 1.25 * wide, high + 0.25 * wide), (0.01, 0, high / 2))
            shapes.append(moved(edge, pose))
        parts += [part("cable tray", one, color="electrical", bundle="cable tray") for one in shapes]
        foot = pose @ at(0.5 * length)
        x, y = float(foot[0, 3]), float(foot[1, 3])
        if chance(rng, 0.6) and abs(foot[2, 3] - level) < 1e-9 and abs(pose[2, 0]) < 0.1:
            parts.append(part("post", box((0.05, 0.05, level), (x, y, level / 2)), color="steel", group=FRAME))
        pose = pose @ at(length)
        if k < count - 1 and chance(rng, 0.6):
            corner = moved(box((wide, wide, high), (wide / 2, 0, high / 2)), pose)
            if kind in ("duct", "solid"):
                parts.append(part("cable tray", corner, color="electrical", bundle="cable tray"))
                pose = pose @ at(wide / 2) @ spun("z", pick(rng, -0.5, 0.5) * np.pi) @ at(wide / 2)
    return Model(parts)


def _conduit(_: int, style: ModelingStyle, rng: np.random.Generator, name: str = "conduit") -> Model:
    """Round bars side by side up and along, with sleeves on them at times; thin and uneven ones as cables."""
    cable = name == "cable"
    r, count = (
        (num(rng, 0.003, 0.009), int(rng.integers(2, 8))) if cable else (num(rng, 0.01, 0.025), int(rng.integers(1, 5)))
    )
    length, rise = num(rng, 0.8, 5.0), num(rng, 0.4, 2.5)
    n = min(style.round(r), 12)
    parts = []
    for k in range(count):
        y = 3 * r * k
        path = [(0.0, y, 0.0), (0.0, y, rise), (length, y, rise)]
        if cable:
            x = np.linspace(0.2, length, 8)
            loose = [(float(one), y + num(rng, -2, 2) * r, rise + num(rng, 0, 1) * r) for one in x]
            path = [(0.0, y, 0.0), (0.0, y, rise - 0.2), (0.06, y, rise - 0.05), *loose]
        solids = [torus_piece(path, r, n)]
        if not cable and chance(rng, 0.5):
            solids += [lying(cylinder(1.25 * r, 0.0, 4 * r, n), s * length, y, rise) for s in (0.3, 0.7)]
        parts.append(part(name, *solids, color="electrical", bundle=name))
    if chance(rng, 0.6):
        deep = 3 * r * count + 0.08
        cabinet = box((0.12, deep, 0.2), (0, 1.5 * r * (count - 1), -0.1))
        parts.append(part("junction box", cabinet, color="electrical"))
    return Model(parts)


def _boxed(_: int, style: ModelingStyle, rng: np.random.Generator, name: str) -> Model:
    """A box on the floor or on a post: a panel, a junction box, a sign, a camera."""
    size = {
        "control panel": (num(rng, 0.4, 1.2), num(rng, 0.2, 0.6), num(rng, 0.8, 2.1)),
        "junction box": (num(rng, 0.1, 0.3), num(rng, 0.06, 0.15), num(rng, 0.1, 0.4)),
        "sign": (num(rng, 0.2, 0.6), 0.004, num(rng, 0.2, 0.5)),
        "camera": (num(rng, 0.1, 0.2), 0.08, 0.08),
    }[name]
    low = 0.0 if name == "control panel" and chance(rng, 0.7) else num(rng, 0.9, 2.2)
    solids = [box(size, (0, 0, low + size[2] / 2))]
    if name == "camera":
        solids.append(lying(disc(0.03, size[0] / 2, size[0] / 2 + 0.04, style), 0, 0, low + 0.04))
    parts = [part(name, *solids, color="electrical", bundle=name)]
    if low:
        r = num(rng, 0.02, 0.04)
        post = (
            cylinder(r, 0, low, min(style.round(r), 16))
            if chance(rng, 0.5)
            else box((2 * r, 2 * r, low), (0, 0, low / 2))
        )
        parts.append(part("post", post, color="steel", group=FRAME))
    return Model(parts)


def _lamp(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pole with a box, a cone or a ball on it."""
    high, r = num(rng, 2.0, 6.0), num(rng, 0.03, 0.08)
    head = pick(rng, 0, 1, 2)
    solids = [
        box((0.5, 0.2, 0.08), (0.2, 0, high)),
        cone(0.1, 0.25, high, high + 0.15, style),
        ball(0.15, style.round(0.15)),
    ]
    top = moved(solids[2], at(0, 0, high)) if head == 2 else solids[head]
    pole = part("post", disc(r, 0.0, high, style), color="steel", group=FRAME)
    return Model([part("lamp", top, color="electrical", bundle="lamp"), pole])


def _bottle(_: int, style: ModelingStyle, rng: np.random.Generator, name: str) -> Model:
    """A cylinder with a small one on top: an extinguisher; with two to the side: a hydrant."""
    r, high = (
        (num(rng, 0.06, 0.1), num(rng, 0.35, 0.6))
        if name == "fire extinguisher"
        else (num(rng, 0.06, 0.12), num(rng, 0.6, 1.1))
    )
    solids = [disc(r, 0.0, high, style), disc(0.4 * r, high, high + 0.6 * r, style)]
    if name == "hydrant":
        side = disc(0.5 * r, -1.8 * r, 1.8 * r, style)
        solids += [moved(side, at(0, 0, 0.75 * high) @ spun("x", np.pi / 2)), disc(1.6 * r, 0.0, 0.03, style)]
    else:
        solids.append(box((1.6 * r, 0.02, 0.02), (0.4 * r, 0, high + 0.6 * r)))
    return Model([part(name, *solids, color="safety", bundle=name)])


def _ring_round(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[Solid, float]:
    """A ring round a line and its outer radius [m]."""
    inner = PIPES[dn].radius
    outer = inner + max(0.004, 0.12 * inner)
    half = num(rng, 0.015, 0.05)
    return lying(ring(inner, outer, -half, half, style.round(outer))), outer


def _shoe(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A plate, a T or a box under a line, on a beam, a post or a block that stands on the ground."""
    r, length = PIPES[dn].radius, num(rng, 0.08, 0.25)
    shoe = num(rng, 0.05, 0.1)
    foot = -r - shoe
    solids = [
        box((length, 0.008, shoe + 0.1 * r), (0, 0, -r - shoe / 2 + 0.05 * r)),
        box((length, 1.2 * r + 0.04, 0.008), (0, 0, foot + 0.004)),
    ]
    if chance(rng, 0.3):
        solids = [box((length, 1.2 * r + 0.02, shoe + 0.15 * r), (0, 0, -r - shoe / 2 + 0.075 * r))]
    parts = [part("bracket", *solids, color="clamp", bundle="bracket")]
    if foot > -height + 0.05:
        size, name = num(rng, 0.06, 0.14), pick(rng, "post", "column", "beam", "foundation")
        if name == "beam":
            beam = box((size, num(rng, 0.4, 1.2), size), (0, 0, foot - size / 2))
            parts.append(part("beam", beam, color="steel", group=FRAME))
            foot -= size
            name = "post"
        if foot > -height + 0.02:
            upright = moved(extrude(rounded_rectangle(size, size, 0.0), -height, foot), at(0, 0))
            parts.append(part(name, upright, color="steel", group=FRAME))
    return Model(parts)


def _stanchion(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An upright cylinder under a line, with or without a plate at its foot."""
    r = PIPES[dn].radius
    post = disc(max(0.012, r * num(rng, 0.4, 0.8)), -height, -0.9 * r, style)
    parts = [part("bracket", post, color="clamp", bundle="bracket")]
    if chance(rng, 0.6):
        parts.append(
            part(
                "base plate",
                box((2 * r + 0.06, 2 * r + 0.06, 0.012), (0, 0, -height + 0.006)),
                color="steel",
                group=FRAME,
            )
        )
    return Model(parts)


def _band(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float, name: str = "clamp") -> Model:
    """A ring round a line on a post, or under a thin rod from above."""
    solid, outer = _ring_round(dn, style, rng)
    parts = [part(name, solid, color="clamp", bundle=name)]
    if name == "pipe hanger":
        top = num(rng, 0.4, 1.2)
        hung = cylinder(max(0.004, 0.08 * outer), 0.98 * outer, top, 8)
        parts[0] = part(name, solid, hung, color="clamp", bundle=name)
        size = num(rng, 0.05, 0.12)
        parts.append(
            part("beam", box((size, num(rng, 0.3, 1.0), size), (0, 0, top + size / 2)), color="steel", group=FRAME)
        )
    elif height > outer + 0.1:
        size = num(rng, 0.02, 0.06)
        parts.append(part("post", disc(size, -height, -0.98 * outer, style), color="steel", group=FRAME))
    return Model(parts)


def _bow(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A bent bar over a line on a flat or square beam, without nuts, on one or two posts."""
    r = PIPES[dn].radius
    d = max(0.004, 0.07 * r)
    leg, low = r + d, -r - num(rng, 0.03, 0.06)
    turns = np.linspace(0, np.pi, 9)
    over = np.column_stack([np.zeros(9), leg * np.cos(turns), leg * np.sin(turns)])
    path = np.vstack([[(0.0, leg, low)], over, [(0.0, -leg, low)]])
    parts = [part("u-bolt", torus_piece(path, d, 8), color="clamp", bundle="u-bolt")]
    size = num(rng, 0.04, 0.1)
    beam = box((size, 2 * leg + 0.15, size), (0, 0, -r - size / 2))
    parts.append(part("beam", beam, color="steel", group=FRAME))
    if height > r + size + 0.05:
        for y in (-leg, leg) if chance(rng, 0.5) else (0.0,):
            post = box((size, size, height - r - size), (0, y, (-height - r - size) / 2))
            parts.append(part("post", post, color="steel", group=FRAME))
    return Model(parts)


_KINDS = ("control panel", "junction box", "sign", "camera")
_WAYS = {"duct": 2.0, "solid": 2.0, "tray": 1.0, "rungs": 1.0}


def _hanging(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cable between two points that sags."""
    length, sag, r = num(rng, 1.0, 4.0), num(rng, 0.02, 0.4), num(rng, 0.004, 0.02)
    x = np.linspace(0, 1, 9)
    path = np.column_stack([length * x, np.zeros(9), 2.0 - 4 * sag * x * (1 - x)])
    hold = rod((0, 0, 0), (0, 0, 2.0), 0.03, 8)
    cable = torus_piece(path, r, 8)
    return Model(
        [part("cable", cable, color="electrical", bundle="cable"), part("post", hold, color="steel", group=FRAME)]
    )


PRIMITIVE_UTILITIES: tuple[Family, ...] = (
    *(
        family(
            f"cable tray/plain {kind}",
            "floor",
            _SAFETY,
            partial(_tray, kind=kind),
            "cable tray",
            (15,),
            weight,
            "structure",
        )
        for kind, weight in _WAYS.items()
    ),
    family("conduit/bent bars", "floor", _SAFETY, _conduit, "conduit", (15,), grain="fitting"),
    family("cable/bent bars", "floor", _SAFETY, partial(_conduit, name="cable"), "cable", (15,), 0.5, "fitting"),
    family("cable/sagging bar", "floor", _SAFETY, _hanging, "cable", (15,), 0.5, "fitting"),
    *(
        family(f"{name}/box", "floor", _SAFETY, partial(_boxed, name=name), name, (15,), 0.6, "fitting")
        for name in _KINDS
    ),
    family("lamp/pole and box", "floor", _SAFETY, _lamp, "lamp", (15,), 0.6, "fitting"),
    *(
        family(f"{name}/cylinders", "floor", _SAFETY, partial(_bottle, name=name), name, (15,), 0.5, "fitting")
        for name in ("fire extinguisher", "hydrant")
    ),
    family("bracket/plain shoe", "carrier", _HELD, _shoe, weight=3, grain="structure"),
    family("bracket/upright cylinder", "carrier", _HELD, _stanchion, weight=1.5, grain="structure"),
    family("clamp/ring on post", "carrier", _HELD, _band, weight=2, grain="structure"),
    family("pipe hanger/ring on rod", "carrier", _HELD, partial(_band, name="pipe hanger"), grain="structure"),
    family("u-bolt/bent bar", "carrier", _HELD, _bow, weight=2, grain="structure"),
)
