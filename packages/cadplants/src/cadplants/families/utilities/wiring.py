"""Conduits, cables, junction boxes and outlets in their places."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, beam_over, h_column, pole, strut, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, rope, torus
from cadplants.transforms import at, spun

__all__ = ["WIRING"]

_SIZES = (0.0107, 0.0134, 0.0168, 0.0213, 0.0302)  # m, radii of steel conduit (EN 61386, ANSI C80.1)


def _bent(points: list[tuple[float, float, float]], radius: float, steps: int = 4) -> Floats:
    """A polyline whose corners are rounded."""
    corners = np.array(points, float)
    path = [corners[0]]
    for before, here, after in zip(corners[:-2], corners[1:-1], corners[2:], strict=True):
        u, v = before - here, after - here
        reach = min(radius, 0.45 * float(np.linalg.norm(u)), 0.45 * float(np.linalg.norm(v)))
        a, b = here + reach * u / np.linalg.norm(u), here + reach * v / np.linalg.norm(v)
        for t in np.linspace(0, 1, steps + 1):
            path.append((1 - t) ** 2 * a + 2 * t * (1 - t) * here + t * t * b)
    return np.array([*path, corners[-1]])


def _coupling(r: float, x: float, y: float, z: float, axis: str) -> Solid:
    """A conduit coupling with its two nuts along an axis."""
    return along(
        axis,
        merge(
            [
                cylinder(1.25 * r, -1.6 * r, 1.6 * r, 10),
                hexagon(2.9 * r, -2.2 * r, -1.5 * r),
                hexagon(2.9 * r, 1.5 * r, 2.2 * r),
            ]
        ),
        x,
        y,
        z,
    )


def _on_struts(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Parallel steel conduits clamped to strut channels on a wall or on columns, turning down in nested bends."""
    count, length, z = int(rng.integers(2, 7)), float(rng.uniform(1.4, 3.0)), float(rng.uniform(1.6, 2.4))
    n = max(6, min(12, style.round(0.02)))
    y, pitch, parts = -0.041, 0.085, []
    turn_down = rng.random() < 0.7
    xs = (0.2 * length, 0.6 * length)
    for k in range(count):
        r = float(rng.choice(_SIZES[:4] if count > 4 else _SIZES))
        zk = z - k * pitch
        end = length - k * pitch
        points = [(-0.1, y - r, zk), (end, y - r, zk)]
        if turn_down:
            points.append((end, y - r, float(rng.uniform(0.15, 0.5))))
        elif rng.random() < 0.3:
            points = [
                (-0.1, y - r, zk),
                (0.7 * length, y - r, zk),
                (0.85 * length, y - r - 0.08, zk),
                (length + 0.1, y - r - 0.08, zk),
            ]
        parts.append(Part(rope(_bent(points, 0.2 + 4 * r), r, n), "conduit", "clamp"))
        for x in xs:
            half = np.pi * np.linspace(0, 1, 8)
            strap = rope([(x, y - r + (r + 0.002) * -np.sin(a), zk + (r + 0.002) * np.cos(a)) for a in half], 0.003, 5)
            ears = [box((0.03, 0.004, 0.012), (x, y - 0.002, zk + s * (r + 0.008))) for s in (-1, 1)]
            parts.append(Part(merge([strap, *ears]), "clamp", "clamp", "", JOINT))
        if rng.random() < 0.4:
            parts.append(Part(_coupling(r, 0.4 * length, y - r, zk, "x"), "coupling", "clamp", "", "Pipe assembly"))
    low = z - (count - 1) * pitch
    for x in xs:
        bar = moved(strut(-0.08 - (z - low) / 2, 0.08 + (z - low) / 2), at(x, 0, (z + low) / 2) @ spun("y", np.pi / 2))
        parts.append(Part(bar, "bracket", "clamp", "", JOINT))
    if rng.random() < 0.5:
        parts.append(wall(-0.2, length + 0.3, z + 0.4))
    else:
        parts += [Part(moved(h_column(z + 0.4).solid, at(x)), "column", "steel", "", FRAME) for x in xs]
    return Model(parts)


def _flexible(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rigid conduit up from the floor into a box, and corrugated conduits in loops to devices on posts."""
    r, h = float(rng.choice(_SIZES[:4])), float(rng.uniform(0.5, 1.2))
    n, s = max(6, min(12, style.round(0.02))), float(rng.uniform(0.1, 0.2))
    case = [
        box((s, 0.6 * s, 1.3 * s), (0, 0, h + 0.65 * s)),
        box((0.95 * s, 0.08 * s, 1.22 * s), (0, -0.34 * s, h + 0.65 * s)),
    ]
    parts = [
        Part(cylinder(r, 0.0, h - 0.02, n), "conduit", "clamp"),
        Part(merge([hexagon(2.8 * r, h - 0.03, h), *case]), "junction box", "electrical"),
    ]
    for sign in (-1, 1)[: int(rng.integers(1, 3))]:
        x, z = sign * float(rng.uniform(0.5, 0.9)), float(rng.uniform(0.4, 1.4))
        q = float(rng.choice([0.008, 0.011, 0.015]))
        start = h + 0.4 * s
        a = along(
            "x" if sign > 0 else "-x",
            merge([hexagon(3.2 * q, 0, 1.2 * q), cylinder(1.35 * q, 1.0 * q, 3 * q, 10)]),
            sign * s / 2,
            0,
            start,
        )
        w = float(rng.uniform(0.08, 0.16))
        b = moved(merge([hexagon(3.2 * q, -1.2 * q, 0), cylinder(1.35 * q, -3 * q, -1.0 * q, 10)]), at(x, 0, z))
        path = _bent(
            [
                (sign * (s / 2 + 2 * q), 0, start),
                (sign * (s / 2 + 0.2), 0, start - 0.02),
                (x - 0.1 * sign, 0.0, z - 0.35),
                (x, 0, z - 0.3),
                (x, 0, z - 2 * q),
            ],
            0.2,
            7,
        )
        dense = np.vstack(
            [path[i] + (path[i + 1] - path[i]) * t for i in range(len(path) - 1) for t in np.linspace(0, 1, 3)[:-1]]
            + [path[-1]]
        )
        keep = np.r_[True, np.linalg.norm(np.diff(dense, axis=0), axis=1) > 1e-4]
        hose = [rope(dense[keep], q, n)]
        if rng.random() < 0.6:
            points = dense[keep]
            for i in range(1, len(points) - 1, 2):
                d = points[i + 1] - points[i - 1]
                d = d / np.linalg.norm(d)
                hose.append(rod(points[i] - 0.3 * q * d, points[i] + 0.3 * q * d, 1.14 * q, n))
        parts += [Part(merge(hose), "conduit", "rubber"), Part(merge([a, b]), "nut", "clamp", "", JOINT)]
        device = box((w, w, w), (x, 0, z + w / 2))
        parts.append(
            Part(merge([device, moved(cylinder(0.4 * w, 0, 0.02, 12), at(x, 0, z + w))]), "junction box", "electrical")
        )
        stand = box((0.05, 0.05, z + 0.5 * w), (x, w / 2 + 0.025, (z + 0.5 * w) / 2))
        parts.append(Part(stand, "post", "steel", "", FRAME))
    return Model(parts)


def _bodies(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Thin conduit (EMT) over a wall through conduit bodies (LB, T, C), square boxes and a ceiling box with a lamp."""
    r, length, z = float(rng.choice(_SIZES[:3])), float(rng.uniform(1.6, 3.2)), float(rng.uniform(1.8, 2.6))
    n, y = max(6, min(12, style.round(0.02))), -0.02 - r
    body = moved(extrude(rounded_rectangle(7 * r, 2.8 * r, 1.3 * r, 3), -1.3 * r, 1.3 * r), spun("x", np.pi / 2))
    lid = moved(extrude(rounded_rectangle(6.4 * r, 2.5 * r, 1.2 * r, 3), 1.3 * r, 1.6 * r), spun("x", np.pi / 2))
    one = merge([body, lid])
    parts = []
    spots = [0.3 * length, 0.65 * length]
    last = -0.1
    for x in spots:
        kind = pick(rng, "body", "square", "round")
        reach = 3.4 * r
        if kind == "body":
            parts.append(Part(moved(one, at(x, y, z)), "junction box", "clamp"))
        elif kind == "square":
            reach = 0.05
            parts.append(
                Part(
                    merge([box((0.1, 0.05, 0.1), (x, y, z)), box((0.102, 0.006, 0.102), (x, y - 0.028, z))]),
                    "junction box",
                    "clamp",
                )
            )
        else:
            reach = 0.043
            drum = merge(
                [cylinder(0.045, -0.025, 0.025, style.round(0.05)), cylinder(0.048, 0.025, 0.031, style.round(0.05))]
            )
            parts.append(Part(along("-y", drum, x, y, z), "junction box", "clamp"))
        parts.append(Part(rod((last, y, z), (x - reach + 0.003, y, z), r, n), "conduit", "clamp"))
        last = x + reach - 0.003
        if rng.random() < 0.7:
            low, drop = (
                float(rng.uniform(0.9, 1.4)),
                0.049 if kind == "square" else 1.3 * r if kind == "body" else 0.043,
            )
            parts.append(Part(rod((x, y, z - drop), (x, y, low), r, n), "conduit", "clamp"))
            parts.append(_outlet(x, low, y, style, rng))
    parts.append(
        Part(rope(_bent([(last, y, z), (length, y, z), (length, y, z + 0.5)], 0.12), r, n), "conduit", "clamp")
    )
    straps = []
    for x in (0.08 * length, 0.48 * length, 0.85 * length):
        straps.append(
            merge(
                [
                    along("x", ring(r, r + 0.002, -0.008, 0.008, 12), x, y, z),
                    box((0.016, 0.003 - y - r, 0.012), (x, (y + r) / 2, z)),
                    box((0.016, 0.003, 4 * r + 0.03), (x, -0.0015, z)),
                ]
            )
        )
    parts += [Part(s, "clamp", "clamp", "", JOINT) for s in straps]
    parts.append(wall(-0.2, length + 0.2, z + 0.6))
    return Model(parts)


def _outlet(x: float, top: float, y: float, style: ModelingStyle, rng: np.random.Generator) -> Part:
    """A surface box under a conduit's end: a switch, a flap socket or a round industrial socket (IEC 60309)."""
    kind, w = int(rng.integers(3)), 0.075
    back = 0.0
    deep = 0.05 - y
    case = box((w, deep, 0.1), (x, back - deep / 2, top - 0.05))
    front = back - deep
    if kind == 0:
        extra = [
            box((0.06, 0.006, 0.08), (x, front - 0.003, top - 0.05)),
            box((0.02, 0.014, 0.035), (x, front - 0.008, top - 0.05)),
        ]
    elif kind == 1:
        extra = [
            box((0.07, 0.02, 0.07), (x, front - 0.01, top - 0.055)),
            box((0.074, 0.004, 0.08), (x, front - 0.022, top - 0.055)),
        ]
    else:
        plug = merge(
            [
                cylinder(0.03, -0.02, 0.04, style.round(0.03)),
                cylinder(0.036, 0.04, 0.05, style.round(0.03)),
                box((0.03, 0.015, 0.02), (0, 0.036, 0.04)),
            ]
        )
        extra = [moved(plug, at(x, front, top - 0.06) @ spun("x", np.pi / 2 + 0.45))]
    return Part(merge([case, *extra]), "junction box", "electrical")


def _catenary(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cables that hang: sagging from pole to pole on insulators, in loops from a rail's trolleys, or to a drop."""
    length, h, n = float(rng.uniform(2.0, 4.0)), float(rng.uniform(2.0, 3.5)), 8
    if rng.random() < 0.5:
        parts = []
        for x in (0.0, length):
            for p in pole(h, 0.05, style, bool(rng.random() < 0.3)):
                parts.append(Part(moved(p.solid, at(x)), p.name, p.color, "", p.group, p.fine))
            parts.append(Part(box((0.06, 0.7, 0.06), (x, 0, h + 0.03)), "bracket", "steel", "", JOINT))
        for y in (-0.28, 0.0, 0.28)[: int(rng.integers(2, 4))]:
            sag, r = float(rng.uniform(0.1, 0.35)), float(rng.uniform(0.006, 0.014))
            t = np.linspace(0, 1, 13)
            line = np.column_stack([t * length, np.full(13, y), h + 0.13 + r - 4 * sag * t * (1 - t)])
            parts.append(Part(rope(line, r, n), "cable", "rubber"))
            knob = merge(
                [cylinder(0.015, 0, 0.07, 10), cylinder(0.03, 0.02, 0.03, 12), cylinder(0.03, 0.045, 0.055, 12)]
            )
            parts += [Part(moved(knob, at(x, y, h + 0.06)), "bracket", "dial", "", JOINT) for x in (0.0, length)]
        return Model(parts)
    count = int(rng.integers(3, 7))
    rail = beam_over(-0.3, length + 0.3, h)
    parts = [*rail]
    xs = np.linspace(0, length, count)
    r = float(rng.uniform(0.008, 0.016))
    path = []
    for a, b in zip(xs[:-1], xs[1:], strict=True):
        t = np.linspace(0, 1, 9)[:-1]
        depth = float(rng.uniform(0.5, 0.8)) * (b - a)
        path += [(float(a + (b - a) * q), 0.0, float(h - 0.1 - depth * np.sin(np.pi * q) ** 0.7)) for q in t]
    path.append((float(xs[-1]), 0.0, h - 0.1))
    for y in (-0.025, 0.025)[: int(rng.integers(1, 3))]:
        parts.append(Part(rope(np.array(path) + np.array((0.0, y, 0.0)), r, n), "cable", "rubber"))
    for x in xs:
        saddle = merge([box((0.05, 0.09, 0.02), (x, 0, h - 0.09)), box((0.04, 0.05, 0.09), (x, 0, h - 0.045))])
        parts.append(Part(saddle, "pipe hanger", "clamp", "", JOINT))
    return Model(parts)


def _coiled(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cable that waits: a coil on a wall hook or on the floor, or wound on a wooden or steel drum."""
    kind, r = int(rng.integers(3)), float(rng.uniform(0.006, 0.016))
    if kind == 2:
        big, wide = float(rng.uniform(0.3, 0.6)), float(rng.uniform(0.3, 0.6))
        n, core = style.round(big), 0.45 * big
        cheek = [cylinder(big, z, z + 0.03, n) for z in (-wide / 2 - 0.03, wide / 2)]
        hub = [cylinder(core, -wide / 2, wide / 2, n), cylinder(0.05, -wide / 2 - 0.035, wide / 2 + 0.035, 12)]
        cheek += [
            moved(box((0.06, 1.6 * big, 0.012), (0, 0, s * (wide / 2 + 0.036))), spun("z", q))
            for s in (-1, 1)
            for q in (0.0, np.pi / 2)
        ]
        turns = int(np.clip(wide / (2.2 * r), 4, 14))
        step = wide / turns
        q = step / 2
        rings = [
            moved(torus(core + q + k % 2 * 0.3 * q, q, min(n, 24), 6), at(0, 0, -wide / 2 + (k + 0.5) * step))
            for k in range(turns)
        ]
        lay = at(0, 0, big) @ spun("x", np.pi / 2)
        out = core + q
        tail = rope(
            np.array(
                [(out * np.cos(a), 0.0, big + out * np.sin(a)) for a in (0.6, 0.2, -0.1)]
                + [(out + 0.05, -0.1, 0.35 * big), (big + 0.3, -0.3, q), (big + 0.9, -0.35, q)]
            ),
            0.9 * q,
            8,
        )
        return Model(
            [
                Part(moved(merge([*rings]), lay), "cable", "rubber"),
                Part(tail, "cable", "rubber"),
                Part(moved(merge([*cheek, *hub]), lay), "cable", "steel"),
            ]
        )
    big = float(rng.uniform(0.15, 0.35))
    n = max(12, min(28, style.round(big)))
    rings = [torus(big + float(rng.uniform(-1.5, 1.5)) * r, r, n, 6) for _ in range(int(rng.integers(4, 9)))]
    if kind == 0:
        pile = [
            moved(s, at(0, 0, r + 1.6 * r * k) @ spun("x", float(rng.uniform(-0.02, 0.02)) if k else 0.0))
            for k, s in enumerate(rings)
        ]
        tail = rope([(big, 0, r), (big + 0.02, 0.3, r), (big + 0.3, 0.5, r), (big + 0.8, 0.45, r)], r, 8)
        ties = [
            moved(
                torus(0.9 * r * len(rings), 0.003, 10, 4),
                at(big * np.cos(a), big * np.sin(a), 0.9 * r * len(rings)) @ spun("z", a) @ spun("x", np.pi / 2),
            )
            for a in (2.0, 4.4)
        ]
        return Model(
            [
                Part(merge([*pile]), "cable", "rubber"),
                Part(tail, "cable", "rubber"),
                *(Part(moved(t, at(0, 0, 0.003)), "clamp", "dial", "", JOINT) for t in ties),
            ]
        )
    z = float(rng.uniform(1.2, 1.8))
    hang = [moved(s, at(0, -0.03 - 1.7 * r * k, z - big) @ spun("x", np.pi / 2)) for k, s in enumerate(rings)]
    deep = 0.06 + 1.7 * r * len(rings)
    hook = rope([(0, 0, z - r - 0.012), (0, -deep, z - r - 0.012), (0, -deep - 0.01, z + 0.03)], 0.01, 8)
    plate = box((0.08, 0.008, 0.12), (0, -0.004, z))
    return Model(
        [
            Part(merge(hang), "cable", "rubber"),
            Part(merge([hook, plate]), "bracket", "steel", "", JOINT),
            wall(-0.6, 0.6, z + 0.5),
        ]
    )


def _cleated(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cables in cleats up a column or along a wall: in trefoil, in a row, or strapped in a bundle, into a gland box."""
    h, r = float(rng.uniform(1.6, 2.8)), float(rng.uniform(0.009, 0.022))
    kind = pick(rng, "trefoil", "row", "bundle")
    spots = {
        "trefoil": [(-r, -r), (r, -r), (0.0, -r - 1.732 * r)],
        "row": [((k - 1.5) * 3.0 * r, -r) for k in range(4)],
        "bundle": [(-r, -r), (r, -r), (0.0, -2.732 * r), (-2 * r, -2.732 * r), (2 * r, -2.732 * r)],
    }[kind]
    gap = 0.02
    low = float(rng.uniform(0.4, 0.7))
    wide = max(abs(x) for x, _ in spots) + r
    deep = -min(y for _, y in spots) + r
    parts = []
    for x, y in spots:
        parts.append(
            Part(
                rope([(x, y - gap, h), (x, y - gap, low + 0.02)], r, max(8, min(12, style.round(r)))), "cable", "rubber"
            )
        )
    for z in np.linspace(low + 0.3, h - 0.15, int(rng.integers(2, 5))):
        base_ = box((2 * wide + 0.05, gap, 0.04), (0, -gap / 2, z))
        sides = [box((0.02, deep, 0.04), (s * (wide + 0.012), -gap - deep / 2, z)) for s in (-1, 1)]
        front = box((2 * wide + 0.05, 0.006, 0.04), (0, -gap - deep - 0.003, z))
        parts.append(Part(merge([base_, *sides, front]), "clamp", "rubber", "", JOINT))
    w = 2 * wide + 0.12
    case = merge(
        [
            box((w, deep + 2 * gap + 0.04, 0.3), (0, -(deep + 2 * gap + 0.04) / 2, low - 0.15)),
            box((0.94 * w, 0.01, 0.28), (0, -(deep + 2 * gap + 0.045), low - 0.15)),
        ]
    )
    nuts = [moved(_standing(r), at(x, y - gap, low)) for x, y in spots]
    parts += [Part(merge([case, *nuts]), "junction box", "electrical")]
    back = wall(-0.5, 0.5, h + 0.2) if rng.random() < 0.5 else h_column(h + 0.2, 0.2)
    return Model([*parts, back])


def _standing(r: float) -> Solid:
    """A gland that stands up from z = 0."""
    return moved(merge([hexagon(2.6 * r, 0.0, 0.8 * r), cylinder(1.2 * r, 0.7 * r, 1.6 * r, 10)]), at())


WIRING: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "fitting", weight)
    for name, build, weight in (
        ("conduit/strut", _on_struts, 1.5),
        ("conduit/flexible", _flexible, 1.2),
        ("conduit/bodies", _bodies, 1.5),
        ("cable/hanging", _catenary, 1.2),
        ("cable/coiled", _coiled, 1.2),
        ("cable/cleated", _cleated, 1.0),
    )
)
