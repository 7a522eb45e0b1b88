"""Cable trays with bends, tees, drops and covers, hung, on arms or on stands."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, beam_over, h_column, hanger, several, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, lattice, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, rod, rope
from cadplants.transforms import at, spun

__all__ = ["TRAYS"]

_KINDS = ("solid", "perforated", "ladder", "wire")


def _straight(kind: str, length: float, w: float, side: float) -> Solid:
    """A straight piece along x from 0, its underside on z = 0."""
    half, mid = w / 2, length / 2
    if kind == "wire":
        wires = [
            rod((0, y, z), (length, y, z), 0.0025, 5)
            for y, z in [
                (-half, side),
                (-half, side / 2),
                (half, side / 2),
                (half, side),
                *((y, 0.0025) for y in np.linspace(-half, half, 4)),
            ]
        ]
        hoops = [
            rope([(x, -half, side), (x, -half, 0.0025), (x, half, 0.0025), (x, half, side)], 0.0025, 5)
            for x in np.arange(0.05, length, 0.1)
        ]
        return merge([*wires, *hoops])
    if kind == "ladder":
        rails = [box((length, 0.012, side), (mid, s * half, side / 2)) for s in (-1, 1)]
        lips = [
            box((length, 0.03, 0.003), (mid, s * (half - 0.012), z)) for s in (-1, 1) for z in (0.0015, side - 0.0015)
        ]
        return merge([*rails, *lips, *(box((0.035, w, 0.014), (x, 0, 0.022)) for x in np.arange(0.12, length, 0.25))])
    walls = [box((length, 0.0015, side), (mid, s * half, side / 2)) for s in (-1, 1)]
    lips = [box((length, 0.012, 0.002), (mid, s * (half - 0.006), side - 0.001)) for s in (-1, 1)]
    if kind == "solid":
        return merge([box((length, w, 0.0015), (mid, 0, 0.00075)), *walls, *lips])
    nx, ny = int(np.clip(length / 0.12, 3, 16)), int(np.clip(w / 0.07, 2, 5))
    xs = np.sort(
        np.concatenate(
            [
                np.linspace(0, length, nx + 1)[:-1],
                np.linspace(0, length, nx + 1)[:-1] + 0.06 * length / nx / 0.12,
                [length],
            ]
        )
    )
    ys = np.sort(
        np.concatenate(
            [np.linspace(-half, half, ny + 1)[:-1], np.linspace(-half, half, ny + 1)[:-1] + 0.6 * w / ny, [half]]
        )
    )
    filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
    filled[::2], filled[:, ::2], filled[-1], filled[:, -1] = True, True, True, True
    return merge([lattice(xs, ys, filled, 0.0, 0.0015), *walls, *lips])


def _sector(low: float, high: float, turn: float, steps: int) -> Floats:
    """A quarter ring or part of it about the origin, from -y on."""
    a = np.linspace(0, turn, steps)
    unit = np.column_stack([np.sin(a), -np.cos(a)])
    return np.vstack([high * unit, low * unit[::-1]])


def _bend(kind: str, w: float, side: float, radius: float, steps: int) -> Solid:
    """A level quarter bend to the left from the origin along x; its inner side has this radius."""
    low, high, t = radius, radius + w, 0.0015 if kind != "ladder" else 0.01
    centre = at(0, radius + w / 2)
    if kind == "wire":
        walls = [
            rope(
                np.column_stack([_sector(r, r + 1, np.pi / 2, steps)[:steps] * (r / (r + 1)), np.full(steps, z)]),
                0.0025,
                5,
            )
            for r in np.linspace(low, high, 4)
            for z in ((0.0025, side) if r in (low, high) else (0.0025,))
        ]
        bars = [
            rope(
                [
                    (r0 * np.sin(a), -r0 * np.cos(a), z)
                    for r0, z in ((low, side), (low, 0.0025), (high, 0.0025), (high, side))
                ],
                0.0025,
                5,
            )
            for a in np.linspace(0.05, np.pi / 2 - 0.05, 5)
        ]
        return moved(merge([*walls, *bars]), centre)
    sides = [extrude(_sector(r - t / 2, r + t / 2, np.pi / 2, steps), 0.0, side) for r in (low, high)]
    if kind == "ladder":
        rungs = [
            moved(box((0.035, w, 0.014), (0, -(low + high) / 2, 0.022)), spun("z", a))
            for a in np.linspace(0.15, np.pi / 2 - 0.15, 4)
        ]
        return moved(merge([*sides, *rungs]), centre)
    return moved(merge([extrude(_sector(low, high, np.pi / 2, steps), 0.0, 0.0015), *sides]), centre)


def _tee(w: float, side: float, room: float) -> Solid:
    """A level tee of sheet along x from 0 to ``w + 2 room``, its branch to -y."""
    long, half = w + 2 * room, w / 2
    plan = np.array(
        [
            (0, -half),
            (room * 0.4, -half),
            (room, -half - room * 0.6),
            (room, -half - room),
            (room + w, -half - room),
            (room + w, -half - 0.6 * room),
            (long - 0.4 * room, -half),
            (long, -half),
            (long, half),
            (0, half),
        ]
    )
    t = 0.0015
    walls = [box((long, t, side), (long / 2, half - t / 2, side / 2))]
    for k in (0, 1, 2, 4, 5, 6):
        p, q = plan[k], plan[k + 1]
        length, turn = float(np.hypot(*(q - p))), float(np.arctan2(*(q - p)[::-1]))
        walls.append(
            moved(box((length + 0.002, t, side), (length / 2, t / 2, side / 2)), at(p[0], p[1]) @ spun("z", turn))
        )
    return merge([extrude(plan, 0.0, t), *walls])


def _cables(path: list[tuple[float, float, float]], w: float, rng: np.random.Generator) -> list[Part]:
    """Some cables side by side along a path in the middle of a tray, level legs only."""
    parts = []
    points = np.array(path)
    legs = np.diff(points, axis=0)
    across = np.array([np.cross(leg / np.linalg.norm(leg), (0, 0, 1.0)) for leg in legs])
    normal = np.vstack(
        [
            across[:1],
            (across[:-1] + across[1:]) / (1 + (across[:-1] * across[1:]).sum(axis=1, keepdims=True)),
            across[-1:],
        ]
    )
    count = int(rng.integers(0, 6))
    for y in (np.arange(count) + 0.5) / max(count, 1) * 0.8 * w - 0.4 * w:
        r = float(rng.uniform(0.005, min(0.018, 0.06 * w + 0.004)))
        parts.append(Part(rope(points + y * normal + (0, 0, r), r, 8), "cable", "rubber"))
    return parts


def _turning(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A level run with a quarter bend, maybe a tee (IEC 61537), on trapezes under beams, couplers at the joints."""
    kind, w, side = (
        pick(rng, *_KINDS),
        float(rng.choice([0.1, 0.15, 0.2, 0.3, 0.4, 0.6])),
        float(rng.choice([0.035, 0.05, 0.06, 0.085, 0.11])),
    )
    a, b, z = float(rng.uniform(1.0, 2.5)), float(rng.uniform(0.8, 2.0)), float(rng.uniform(1.8, 2.8))
    radius, steps = float(rng.choice([0.1, 0.3])), max(4, style.round(0.3) // 4 + 1)
    floor = 0.024 if kind == "ladder" else 0.005 if kind == "wire" else 0.0015
    pieces = [moved(_straight(kind, a, w, side), at(-a, 0, z)), moved(_bend(kind, w, side, radius, steps), at(0, 0, z))]
    turn = at(radius + w / 2, radius + w / 2, z) @ spun("z", np.pi / 2)
    pieces.append(moved(_straight(kind, b, w, side), turn))
    start = -a
    if kind in ("solid", "perforated") and rng.random() < 0.6:
        room = 0.15
        pieces.append(moved(_tee(w, side, room), at(-a - w - 2 * room, 0, z)))
        pieces.append(
            moved(_straight(kind, 0.6, w, side), at(-a - room - w / 2, -w / 2 - room, z) @ spun("z", -np.pi / 2))
        )
        start -= w + 2 * room
    corner = radius + w / 2
    bow = [(corner * np.sin(t), corner * (1 - np.cos(t)), z + floor) for t in np.linspace(0, np.pi / 2, 6)]
    parts = [
        *several(pieces, "cable tray", "clamp"),
        *_cables(
            [(start - 0.1, 0, z + floor), (-0.05, 0, z + floor), *bow, (corner, corner + b + 0.1, z + floor)], w, rng
        ),
    ]
    if kind != "wire":
        plates = [
            box((0.12, 0.003, 0.7 * side), (0, s * (w / 2 + (0.0075 if kind == "ladder" else 0.0022)), z + side / 2))
            for s in (-1, 1)
        ]
        parts.append(Part(merge(plates), "plate", "clamp", "", FRAME))
    for x in (start + 0.25, -0.2):
        parts += _trapeze(x, w, z, rng)
    parts += beam_over(start - 0.35, radius + w + 0.35, z + 0.8)
    y = corner + 0.7 * b
    bracket = box((w + 0.2, 0.05, 0.04), (corner, y, z - 0.02))
    parts += [
        Part(bracket, "bracket", "steel", "", JOINT),
        Part(box((0.06, 0.06, z - 0.04), (corner, y, (z - 0.04) / 2)), "post", "steel", "", FRAME),
    ]
    return Model(parts)


def _trapeze(x: float, w: float, z: float, rng: np.random.Generator) -> list[Part]:
    """A strut under a tray on two threaded rods from the beam 0.8 m above; the rods meet in a plate there."""
    bar = box((0.041, w + 0.16, 0.03), (x, 0, z - 0.015))
    rods = [hanger(x, s * (w / 2 + 0.05), z - 0.05, z + 0.79) for s in (-1, 1)]
    clip = box((0.05, w + 0.2, 0.012), (x, 0, z + 0.794))
    return [
        Part(bar, "bracket", "clamp", "", JOINT),
        *(Part(r, "stud", "fastener", "", JOINT) for r in rods),
        Part(clip, "bracket", "clamp", "", JOINT),
    ]


def _tiers(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Trays one over the other on cantilever arms from a wall, columns or stands, each with its cables."""
    length, count = float(rng.uniform(1.6, 3.5)), int(rng.integers(2, 5))
    w, pitch, low = (
        float(rng.choice([0.15, 0.2, 0.3, 0.45])),
        float(rng.uniform(0.25, 0.4)),
        float(rng.uniform(0.5, 1.4)),
    )
    parts, top = [], low + (count - 1) * pitch + 0.4
    back = pick(rng, "wall", "column", "stand")
    xs = [0.2 * length, 0.8 * length]
    for k in range(count):
        kind, side, z = pick(rng, *_KINDS), float(rng.choice([0.05, 0.06, 0.1])), low + k * pitch
        parts.append(Part(moved(_straight(kind, length, w, side), at(0, -w / 2 - 0.06, z)), "cable tray", "clamp"))
        floor = 0.03 if kind == "ladder" else 0.005 if kind == "wire" else 0.0015
        parts += _cables(
            [
                (-0.1, -w / 2 - 0.06, z + floor),
                (length / 2, -w / 2 - 0.06, z + floor),
                (length + 0.1, -w / 2 - 0.06, z + floor),
            ],
            w,
            rng,
        )
        if rng.random() < 0.25 and kind in ("solid", "perforated"):
            parts.append(
                Part(
                    box((0.9 * length, w + 0.006, 0.002), (length / 2, -w / 2 - 0.06, z + side + 0.001)),
                    "cable tray",
                    "clamp",
                )
            )
        for x in xs:
            arm = np.array([(0, -0.06), (0, 0), (-w - 0.1, 0), (-w - 0.1, -0.02)])
            solid = moved(
                extrude(arm, -0.015, 0.015),
                at(x, 0, z) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2),
            )
            parts.append(Part(solid, "bracket", "steel", "", JOINT))
    if back == "wall":
        parts.append(wall(-0.2, length + 0.2, top))
    elif back == "column":
        parts += [Part(moved(h_column(top).solid, at(x)), "column", "steel", "", FRAME) for x in xs]
    else:
        for x in xs:
            parts.append(Part(box((0.06, 0.06, top), (x, 0.03, top / 2)), "post", "clamp", "", FRAME))
            parts.append(Part(box((0.2, w + 0.3, 0.01), (x, -0.1, 0.005)), "base plate", "clamp", "", FRAME))
    return Model(parts)


def _trunking(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Covered trunking: a square sheet duct along a wall with a drop into a wall box, covers, straps."""
    s, z, length = (
        float(rng.choice([0.05, 0.075, 0.1, 0.15])),
        float(rng.uniform(1.6, 2.4)),
        float(rng.uniform(1.5, 3.0)),
    )
    y = -s / 2
    run = [box((length, s, s), (length / 2, y, z)), box((length - 0.01, 0.004, 0.9 * s), (length / 2, -s - 0.002, z))]
    x = float(rng.uniform(0.3, 0.7)) * length
    h = float(rng.uniform(0.4, 0.8))
    drop = [
        box((s, s, z - s / 2 - h), (x, y, (z - s / 2 + h) / 2)),
        box((0.9 * s, 0.004, z - s / 2 - h - 0.01), (x, -s - 0.002, (z - s / 2 + h) / 2)),
    ]
    straps = [box((0.02, s + 0.008, s + 0.008), (q * length, y - 0.002, z)) for q in (0.15, 0.85)]
    straps += [box((s + 0.008, s + 0.008, 0.02), (x, y - 0.002, (z + h) / 2))]
    end = [box((s, s, s + 0.5), (length + s / 2, y, z + 0.25))]
    b = float(rng.uniform(0.2, 0.4))
    case = [
        box((b, max(0.12, 1.2 * s), 1.2 * b), (x, -max(0.12, 1.2 * s) / 2, h - 0.6 * b)),
        box((0.96 * b, 0.01, 1.16 * b), (x, -max(0.12, 1.2 * s) - 0.005, h - 0.6 * b)),
    ]
    return Model(
        [
            *several([merge(run), merge(drop), *([merge(end)] if rng.random() < 0.6 else [])], "cable tray", "clamp"),
            Part(merge(straps), "clamp", "clamp", "", JOINT),
            Part(merge(case), "junction box", "electrical"),
            wall(-0.2, length + 0.3, z + 0.8),
        ]
    )


def _riser(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A level tray that turns up a wall in an inside bend, cables tied to the upright leg."""
    kind, w, side = (
        pick(rng, "solid", "perforated", "ladder"),
        float(rng.choice([0.1, 0.2, 0.3])),
        float(rng.choice([0.05, 0.06, 0.1])),
    )
    tall, out = float(rng.uniform(1.4, 2.6)), float(rng.uniform(0.7, 1.5))
    low, gap, r = float(rng.uniform(0.1, 0.4)), 0.041, 0.25
    up = moved(
        _straight(kind, tall, w, side),
        at(0, -gap, low) @ spun("z", -np.pi / 2) @ spun("y", -np.pi / 2) @ spun("x", 0.0),
    )
    z = low + tall + r
    a = np.linspace(0, np.pi / 2, 6)
    inner = np.column_stack([-gap - r + r * np.cos(a), low + tall + r * np.sin(a)])
    flat = [
        extrude(
            np.vstack([inner, (inner - (-gap - r, low + tall))[::-1] * ((r - q) / r) + (-gap - r, low + tall)]),
            0,
            thick,
        )
        for q, thick in ((0.002, w), (side, 0.0015), (side, 0.0015))
    ]
    turn = spun("z", np.pi / 2) @ spun("x", np.pi / 2)
    curve = merge(
        [
            moved(flat[0], at(-w / 2) @ turn),
            moved(flat[1], at(-w / 2) @ turn),
            moved(flat[2], at(w / 2 - 0.0015) @ turn),
        ]
    )
    level = moved(_straight(kind, out, w, side), at(0, -gap - r, z) @ spun("z", -np.pi / 2) @ spun("x", np.pi))
    parts = several([up, curve, level], "cable tray", "clamp")
    count = int(rng.integers(1, 5))
    for k in range(count):
        x = (k + 0.5) / count * 0.8 * w - 0.4 * w
        q = 0.01
        d = 0.029 if kind == "ladder" else 0.0015
        path = [
            (x, -gap - d - q, 0.02),
            (x, -gap - d - q, low + tall),
            *((x, -gap - r + (r - d - q) * np.cos(t), low + tall + (r - d - q) * np.sin(t)) for t in a[1:-1]),
            (x, -gap - r, z - d - q),
            (x, -gap - r - out - 0.1, z - d - q),
        ]
        parts.append(Part(rope(path, q, 8), "cable", "rubber"))
    bars = [box((w + 0.1, 0.041, 0.041), (0, -0.0205, low + f * tall)) for f in (0.15, 0.55, 0.9)]
    parts += [Part(b, "bracket", "clamp", "", JOINT) for b in bars]
    level_z = float(rng.uniform(0.3, 1.2))
    flip = at(0, 0, z + level_z) @ spun("y", np.pi)
    parts = [replace(p, solid=moved(p.solid, flip)) for p in parts]
    y = -gap - r - 0.8 * out
    return Model(
        [
            *parts,
            Part(box((w + 0.1, 0.05, 0.03), (0, y, level_z - 0.015)), "bracket", "steel", "", JOINT),
            Part(box((0.05, 0.05, level_z - 0.03), (0, y, (level_z - 0.03) / 2)), "post", "steel", "", FRAME),
            wall(-0.5 * w - 0.3, 0.5 * w + 0.3, z + level_z + 0.2),
        ]
    )


TRAYS: tuple[Family, ...] = tuple(
    Family(f"cable tray/{name}", "floor", GROUP, "cable tray", build, (15,), "fitting", 1.2)
    for name, build in (("turning", _turning), ("tiers", _tiers), ("trunking", _trunking), ("riser", _riser))
)
