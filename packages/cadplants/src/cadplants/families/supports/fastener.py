"""Fasteners of unusual kinds in use: anchors, T-bolts, eyes and shackles, nuts, screws, washers, swing bolts, studs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.supports.shape import GROUP, eye, few, framed, piece, upright
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.primitives import around, bar, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.transforms import arc, at, spun

__all__ = ["FASTENERS", "head_solid", "nut_solid"]

_D = (0.008, 0.01, 0.012, 0.016, 0.02, 0.024, 0.03)  # m, ISO 261 coarse threads
_Named = tuple[str, Solid]


def _shank(d: float, low: float, high: float, style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A plain shank, or one with ridges for a thread on its lower part where the style models every piece."""
    n = few(d / 2, style)
    ridged = style.fasteners == "pieces" and rng.random() < 0.5
    if not ridged or high - low < 1.2 * d:
        return cylinder(d / 2, low, high, n)
    pitch, end = 0.16 * d, low + 0.7 * (high - low)
    count = int(np.clip((end - low) / pitch, 3, 18))
    step = (end - low) / count
    profile = [p for k in range(count) for p in ((0.43 * d, low + k * step), (0.5 * d, low + (k + 0.5) * step))]
    return turned([*profile, (0.43 * d, end), (0.5 * d, end), (0.5 * d, high)], n)


def _wings(d: float, low: float, span: float, high: float) -> Solid:
    """Two thin ears of a wing nut or screw, standing in the plane y = 0 [m]."""
    half = [[0.45 * d, low], [0.6 * span, low + 0.25 * (high - low)], [span, low + 0.7 * (high - low)]]
    half += [[0.95 * span, high], [0.7 * span, high], [0.45 * d, low + 0.55 * (high - low)]]
    ears = [upright([[s * x, z] for x, z in half], -0.11 * d, 0.11 * d) for s in (-1, 1)]
    return merge(ears)


def nut_solid(kind: str, d: float, style: ModelingStyle) -> Solid:
    """A nut on z = 0 with its thread about z [m]; proportions of ISO 4032, DIN 1587, 315, 557, 935, 6334, 466."""
    n, bore = few(d / 2, style), d / 2
    if kind == "square":
        return extrude(rounded_rectangle(1.6 * d, 1.6 * d, 0), 0, 0.75 * d, (circle(bore, n),))
    if kind == "cap":
        return merge([hexagon(1.6 * d, 0, 0.7 * d), dome(0.72 * d, 0.8 * d, 0.68 * d, max(8, n))])
    if kind == "wing":
        return merge([turned([(0.8 * d, 0), (0.62 * d, 0.9 * d)], max(8, n)), _wings(d, 0.05 * d, 2.0 * d, 2.0 * d)])
    if kind == "castle":
        tooth = box((0.3 * d, 0.5 * d, 0.4 * d), (0.62 * d, 0, 1.0 * d))
        return merge([hexagon(1.6 * d, 0, 0.8 * d, bore, n), around(tooth, 6)])
    if kind == "lock":
        return merge([hexagon(1.6 * d, 0, 0.8 * d, bore, n), ring(0.5 * d, 0.72 * d, 0.8 * d, 1.1 * d, max(8, n))])
    if kind == "jam":
        return merge([hexagon(1.6 * d, 0, 0.5 * d, bore, n), hexagon(1.6 * d, 0.52 * d, 1.02 * d, bore, n)])
    if kind == "flange":
        skirt = turned([(1.15 * d, 0), (1.1 * d, 0.12 * d), (0.75 * d, 0.3 * d)], max(8, n))
        return merge([skirt, hexagon(1.5 * d, 0.2 * d, 0.95 * d)])
    if kind == "coupling":
        return hexagon(1.5 * d, 0, 3.0 * d, bore, n)
    if kind == "knurled":
        return merge([extrude(circle(1.3 * d, 20), 0.45 * d, 1.1 * d), cylinder(0.75 * d, 0, 0.5 * d, max(8, n))])
    if kind == "eye":
        loop = moved(eye(1.1 * d, 0.35 * d, style), at(0, 0, 1.9 * d))
        return merge([turned([(1.0 * d, 0), (0.9 * d, 0.5 * d), (0.6 * d, 0.9 * d)], max(8, n)), loop])
    if kind == "star":
        lobes = around(cylinder(0.55 * d, 0.5 * d, 1.4 * d, 8), 5, 1.1 * d)
        return merge([cylinder(1.2 * d, 0.45 * d, 1.45 * d, max(10, n)), lobes, cylinder(0.7 * d, 0, 0.5 * d, 8)])
    return hexagon(1.6 * d, 0, 0.85 * d, bore, n)


_NUTS = ("hex", "square", "cap", "wing", "castle", "lock", "jam", "flange", "coupling", "knurled", "eye", "star")


def head_solid(kind: str, d: float, style: ModelingStyle) -> Solid:
    """A head on z = 0 over its shank [m] (ISO 4014, 4762, 7380, 10642, EN 1665, DIN 603, 261, 464, 444)."""
    n = max(8, few(d / 2, style))
    if kind == "square":
        return box((1.5 * d, 1.5 * d, 0.7 * d), (0, 0, 0.35 * d))
    if kind == "carriage":
        return merge([dome(1.15 * d, 0.55 * d, 0, n), box((d, d, 0.5 * d), (0, 0, -0.25 * d))])
    if kind == "socket":
        return merge(
            [cylinder(0.75 * d, 0, 0.5 * d, n), extrude(circle(0.75 * d, n), 0.5 * d, d, (circle(0.45 * d, 6),))]
        )
    if kind == "button":
        return turned([(0.9 * d, 0), (0.85 * d, 0.2 * d), (0.6 * d, 0.45 * d), (0.3 * d, 0.52 * d)], n)
    if kind == "flat":
        return turned([(0.5 * d, -0.5 * d), (1.0 * d, 0.0), (1.0 * d, 0.03 * d)], n)
    if kind == "pan":
        slot = 0.14 * d
        caps = [turned([(0.9 * d, 0), (0.9 * d, 0.35 * d), (0.7 * d, 0.5 * d)], n)]
        return merge(
            [*caps, box((1.2 * d, slot, 0.04 * d), (0, 0, 0.51 * d)), box((slot, 1.2 * d, 0.04 * d), (0, 0, 0.512 * d))]
        )
    if kind == "flange":
        return merge(
            [turned([(1.15 * d, 0), (1.1 * d, 0.12 * d), (0.75 * d, 0.3 * d)], n), hexagon(1.5 * d, 0.2 * d, 0.9 * d)]
        )
    if kind == "washer hex":
        return merge([cylinder(1.0 * d, 0, 0.12 * d, n), hexagon(1.4 * d, 0.1 * d, 0.75 * d)])
    if kind == "wing":
        return merge([turned([(0.8 * d, 0), (0.62 * d, 0.9 * d)], n), _wings(d, 0.05 * d, 2.0 * d, 2.0 * d)])
    if kind == "thumb":
        return merge([cylinder(0.75 * d, 0, 0.5 * d, n), extrude(circle(1.25 * d, 20), 0.45 * d, 0.95 * d)])
    if kind == "tee":
        return box((3.0 * d, 1.1 * d, 0.7 * d), (0, 0, 0.35 * d))
    if kind == "eye":
        return merge([cylinder(0.9 * d, 0, 0.25 * d, n), moved(eye(1.0 * d, 0.35 * d, style), at(0, 0, 1.45 * d))])
    if kind == "ring":
        hole = circle(0.5 * d, n, (0, 1.0 * d))
        plate = upright(circle(1.0 * d, 2 * n, (0, 1.0 * d)), -0.45 * d, 0.45 * d, (hole,))
        return plate
    return hexagon(1.6 * d, 0, 0.65 * d)


_BOLTS = ("hex", "square", "carriage", "flange", "tee", "eye", "ring")
_SCREWS = ("socket", "button", "flat", "pan", "washer hex", "wing", "thumb")


def _emit(named: Sequence[_Named], pose: Floats) -> list[Part]:
    return [piece(moved(solid, pose), name, "", "fastener") for name, solid in named]


def _nuts(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Studs through a plate, a flat bar or a cover with all kinds of nuts on them, with washers or without."""
    d = float(rng.choice(_D))
    kinds = [str(k) for k in rng.permutation(_NUTS)[: int(rng.integers(4, 9))]]
    pitch, t = 4.6 * d, float(rng.uniform(0.5, 1.5)) * d
    rows = int(rng.integers(1, 3))
    columns = (len(kinds) + rows - 1) // rows
    up = 1.5 * d if rng.random() < 0.5 else 0.0
    parts: list[Part] = []
    for k, kind in enumerate(kinds):
        pose = at((k % columns) * pitch, (k // columns) * pitch, t + up) @ spun("z", float(rng.uniform(0, 6)))
        flat = 0.16 * d if rng.random() < 0.6 else 0.0
        named: list[_Named] = [("nut", moved(nut_solid(kind, d, style), at(0, 0, flat)))]
        if flat:
            named.append(("washer", ring(0.54 * d, d * float(rng.uniform(1.0, 1.6)), 0, flat, max(8, few(d, style)))))
        over = {"coupling": 2.5 * d, "cap": 0.7 * d, "eye": 0.6 * d}.get(kind, d * float(rng.uniform(1.2, 3.5)))
        named.append(("stud", _shank(d, -t - (0.9 * up), flat + over, style, rng)))
        parts += _emit(named, pose)
    size = ((columns + 0.0) * pitch, rows * pitch, t)
    middle = ((columns - 1) * pitch / 2, (rows - 1) * pitch / 2, up + t / 2)
    parts.append(framed(box(size, middle), "plate"))
    if up:
        feet = [
            box((d, rows * pitch, up), (x, middle[1], up / 2))
            for x in (middle[0] - 0.45 * size[0], middle[0] + 0.45 * size[0])
        ]
        parts.append(framed(merge(feet), "plate"))
    return Model(parts)


def _screws(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Screws and bolts with all kinds of heads in two plates that they join, some half screwed in, some lying by."""
    d = float(rng.choice(_D))
    heads = [*_SCREWS, *_BOLTS]
    kinds = [str(k) for k in rng.permutation(heads)[: int(rng.integers(5, 10))]]
    pitch, t = 4.0 * d, float(rng.uniform(0.4, 1.2)) * d
    parts: list[Part] = []
    low = 4.2 * d
    for k, kind in enumerate(kinds):
        name = "screw" if kind in _SCREWS else "bolt"
        out = float(rng.choice([0.0, 0.0, 1.2])) * d
        grip = float(rng.uniform(2.2, 4.0)) * d
        shank = _shank(d, -grip, 0.0, style, rng)
        solid = merge([head_solid(kind, d, style), shank])
        if rng.random() < 0.25:  # lies on the floor before the plates
            reach = max(1.5 * d, float(-solid.vertices[:, 0].min()))
            lying = moved(solid, at(k * pitch, -4.2 * d, reach) @ spun("x", 0.5 * np.pi))
            lying = moved(lying, at(0, 0, -float(lying.vertices[:, 2].min())))
            parts.append(piece(lying, name, "", "fastener"))
        else:
            pose = at(k * pitch, 0, low + 2 * t + out) @ spun("z", float(rng.uniform(0, 6)))
            parts += _emit([(name, solid)], pose)
            if rng.random() < 0.4 and name == "bolt" and not out:
                nut = moved(nut_solid(str(rng.choice(["hex", "square", "lock", "flange"])), d, style), spun("x", np.pi))
                parts += _emit([("nut", nut)], at(k * pitch, 0, low))
    n = len(kinds)
    for z in (low, low + t):
        parts.append(framed(box((n * pitch, 3.4 * d, t), ((n - 1) * pitch / 2, 0, z + t / 2)), "plate"))
    legs = [box((2 * d, 3.0 * d, low), (x, 0, low / 2)) for x in (-0.5 * pitch + d, (n - 0.5) * pitch - d)]
    parts.append(framed(merge(legs), "plate"))
    return Model(parts)


def _washers(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Bolts in the flange of a beam or channel over washers: flat, square, tapered, spring, toothed, cup, stacks."""
    d = float(rng.choice(_D[:5]))
    h = float(rng.uniform(7, 12)) * d
    n = max(10, few(d, style))
    t = 0.8 * d
    span = 0.0
    parts: list[Part] = []
    kinds = [str(k) for k in rng.permutation(["flat", "wide", "square", "taper", "spring", "tooth", "cup", "pack"])]
    for kind in kinds[: int(rng.integers(4, 8))]:
        w = 0.2 * d
        hole = circle(0.54 * d, n)
        high = w
        if kind == "flat":
            solids = [ring(0.54 * d, d, 0, w, n)]
        elif kind == "wide":
            solids = [ring(0.54 * d, 1.5 * d, 0, w, n)]
        elif kind == "square":
            high = 0.3 * d
            solids = [extrude(rounded_rectangle(2.6 * d, 2.6 * d, 0), 0, high, (hole,))]
        elif kind == "taper":
            high = 0.32 * d
            plate = extrude(rounded_rectangle(2.2 * d, 2.2 * d, 0), 0, high, (hole,))
            lean = plate.vertices.copy()
            lean[:, 2] *= 1 - 0.2 * lean[:, 0] / d
            solids = [Solid(lean, plate.faces)]
        elif kind == "spring":
            turn = np.linspace(0.1, 2 * np.pi - 0.1, 16)
            path = np.column_stack(
                [0.72 * d * np.cos(turn), 0.72 * d * np.sin(turn), np.linspace(0.15 * d, 0.3 * d, 16)]
            )
            solids, high = [rope(path, 0.15 * d, 6)], 0.42 * d
        elif kind == "tooth":
            tooth = box((0.35 * d, 0.2 * d, w), (1.05 * d, 0, w / 2))
            solids = [ring(0.54 * d, 0.95 * d, 0, w, n), around(tooth, 10)]
        elif kind == "cup":
            high = 0.45 * d
            solids = [turned([(1.5 * d, 0), (1.4 * d, 0.15 * d), (0.8 * d, high)], n)]
        else:
            solids = [ring(0.54 * d, d * (1 + 0.25 * (k % 2)), k * w, (k + 1) * w, n) for k in range(4)]
            high = 4 * w
        pose = at(span, -1.6 * d, h + 0.0)
        parts += _emit([("washer", merge(solids))] if kind != "pack" else [("washer", s) for s in solids], pose)
        head = str(rng.choice(["hex", "hex", "square", "flange", "socket"]))
        name = "screw" if head == "socket" else "bolt"
        shank = _shank(d, -t - 2.2 * d, high, style, rng)
        parts += _emit([(name, merge([shank, moved(head_solid(head, d, style), at(0, 0, high))]))], pose)
        nut = moved(
            nut_solid(str(rng.choice(["hex", "square", "lock", "jam"])), d, style), at(0, 0, -t - w) @ spun("x", np.pi)
        )
        parts += _emit([("nut", nut), ("washer", ring(0.54 * d, d, -t - w, -t, n))], pose)
        span += 4.2 * d
    web = 0.6 * d
    outline = section_channel(h, 4.2 * d, web, t) if rng.random() < 0.6 else section_i(h, 7 * d, web, t)
    shift = at(0, 0.6 * d) if len(outline) == 8 else at()
    beam = moved(bar((-3 * d, 0, h / 2), (span, 0, h / 2), outline), shift)
    if len(outline) == 8:
        ys = beam.vertices[:, 1]
        beam = moved(beam, at(0, -float(ys.min()) - 3.9 * d))
    parts.append(framed(beam, "beam"))
    return Model(parts)


def _anchor(
    kind: int, d: float, deep: float, out: float, style: ModelingStyle, rng: np.random.Generator
) -> list[_Named]:
    """An anchor about z: bent to a J or an L, with an end plate, glued in a sleeve, with a head at its foot [m]."""
    n = few(d / 2, style)
    bend = 2 * d
    if kind < 2:
        corner = arc((0, 0, bend), (0, 0, 0), (bend, 0, 0), 4)
        tail = (
            [[2.5 * d + bend, 0, 0]]
            if kind == 0
            else [[2 * bend, 0, 0], [2.7 * bend, 0, 0.4 * bend], [2.9 * bend, 0, 1.8 * bend]]
        )
        path = np.vstack([[[0, 0, deep + out]], corner, tail])
        solids: list[_Named] = [("bolt", rope(path, d / 2, n))]
    elif kind == 2:
        plate = box((4 * d, 4 * d, 0.5 * d), (0, 0, 0.25 * d))
        solids = [
            ("bolt", cylinder(d / 2, 0, deep + out, n)),
            ("plate", plate),
            ("nut", moved(nut_solid("hex", d, style), at(0, 0, 0.5 * d))),
        ]
    elif kind == 3:
        solids = [
            ("stud", _shank(d, 0.3 * deep, deep + out, style, rng)),
            ("washer", ring(0.5 * d, 0.75 * d, 0.45 * deep, deep + 0.01 * d, n)),
        ]
    else:
        solids = [("bolt", merge([hexagon(1.6 * d, 0, 0.65 * d), cylinder(d / 2, 0.6 * d, deep + out, n)]))]
    return solids


def _anchors(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Anchors in concrete: J, L, plate and U anchors, sleeve and chemical ones, with their nuts; some not yet cast."""
    d = float(rng.choice(_D[1:]))
    count, pitch = int(rng.integers(3, 6)), 9 * d
    deep, out = float(rng.uniform(10, 16)) * d, float(rng.uniform(4, 7)) * d
    top = deep + 3 * d
    cast = bool(rng.random() < 0.55)
    parts: list[Part] = []
    n = few(d / 2, style)
    for k in range(count):
        kind = int(rng.integers(5))
        x = k * pitch
        solids = _anchor(kind, d, deep, out, style, rng)
        t = 0.2 * d
        flat = (
            box((2.6 * d, 2.6 * d, 0.4 * d), (0, 0, deep + t))
            if rng.random() < 0.4
            else ring(0.54 * d, 1.1 * d, deep, deep + 2 * t, n)
        )
        solids += [
            ("washer", flat),
            (
                "nut",
                moved(
                    nut_solid(str(rng.choice(["hex", "hex", "square", "jam", "cap"])), d, style), at(0, 0, deep + 2 * t)
                ),
            ),
        ]
        lift = top - deep if cast else 0.0
        pose = at(x, 0, lift) @ spun("z", float(rng.choice([0.5, 1.0, 1.5])) * np.pi)
        parts += [
            framed(moved(s, pose), "plate") if name == "plate" else piece(moved(s, pose), name, "", "fastener")
            for name, s in solids
        ]
    length = (count - 1) * pitch
    if cast:
        parts.append(framed(box((length + 14 * d, 14 * d, top), (length / 2, 0, top / 2)), "foundation", "concrete"))
    else:  # a setting template keeps them upright before they are cast in
        parts.append(framed(box((length + 6 * d, 4 * d, 0.5 * d), (length / 2, 0, deep - 0.25 * d)), "plate"))
        legs = [box((d, 4 * d, deep - 0.5 * d), (x, 0, (deep - 0.5 * d) / 2)) for x in (-2.4 * d, length + 2.4 * d)]
        parts.append(framed(merge(legs), "plate"))
    # A bar bent at the foot lies on the floor with its skin, not with its axis.
    lowest = min(float(p.solid.vertices[:, 2].min()) for p in parts)
    return Model(placed(parts, at(0, 0, max(0.0, -lowest))))


FASTENERS: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "fitting", 0.8)
    for name, build in (
        ("nut/kinds", _nuts),
        ("screw/kinds", _screws),
        ("washer/kinds", _washers),
        ("bolt/anchor", _anchors),
    )
)
