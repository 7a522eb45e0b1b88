"""Hydrants above and below the ground and in walls, standpipes, monitors."""

from __future__ import annotations

import numpy as np

from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, dome, hexagon, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["HYDRANTS"]

_H = "hydrant"


def _us_pillar(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dry barrel hydrant (AWWA C502): break flange, barrel, bonnet with its nut, capped nozzles, chains."""
    r = float(rng.uniform(0.08, 0.12))
    n, h, low = style.round(r), float(rng.uniform(0.5, 0.8)), 0.08
    foot = merge([cylinder(1.15 * r, 0, low, n), cylinder(1.75 * r, low, low + 0.025, n)])
    flutes = (
        around(box((0.1 * r, 0.18 * r, 0.55 * h), (r, 0, low + 0.05 + 0.3 * h)), int(rng.choice([8, 12])))
        if rng.random() < 0.4
        else None
    )
    body = turned(
        [
            (1.75 * r, low + 0.026),
            (1.75 * r, low + 0.05),
            (r, low + 0.055),
            (r, low + 0.62 * h),
            (1.25 * r, low + 0.68 * h),
            (1.25 * r, low + h),
            (1.6 * r, low + h),
            (1.6 * r, low + h + 0.02),
        ],
        n,
    )
    z = low + h + 0.021
    cap = [
        (1.6 * r, z),
        (1.6 * r, z + 0.02),
        (1.2 * r, z + 0.025),
        *((1.2 * r * np.cos(t), z + 0.025 + 1.1 * r * np.sin(t)) for t in (0.3, 0.6, 0.9, 1.2)),
        (0.35 * r, z + 0.025 + 1.1 * r),
        (0.35 * r, z + 0.03 + 1.2 * r),
    ]
    nut = moved(cylinder(0.22 * r, 0, 0.5 * r, 5), at(0, 0, z + 0.025 + 1.2 * r))
    outs, caps, chains = [], [], []
    for angle, size in ((-np.pi / 2, 0.85), (0.0, 0.5), (np.pi, 0.5))[: int(rng.integers(2, 4))]:
        pose = spun("z", angle) @ at(0, 0, low + 0.84 * h)
        outs.append(
            moved(
                along(
                    "x",
                    merge([cylinder(1.1 * size * r, r, 1.5 * r, n), cylinder(1.25 * size * r, 1.3 * r, 1.42 * r, n)]),
                ),
                pose,
            )
        )
        lid = [
            cylinder(1.3 * size * r, 1.5 * r, 1.85 * r, n),
            cylinder(0.3 * size * r, 1.8 * r, 2.15 * r, 5),
            around(box((0.12 * size * r, 0.2 * size * r, 0.3 * r), (1.3 * size * r, 0, 1.67 * r)), 6),
        ]
        caps.append(moved(along("x", merge(lid)), pose))
        if rng.random() < 0.6:
            line = np.array(
                [
                    (1.75 * r, 1.0 * size * r, -0.6 * size * r),
                    (1.6 * r, 1.2 * size * r, -1.6 * size * r),
                    (1.1 * r, 0.6 * r, -1.2 * size * r),
                    (0.98 * r, 0.3 * r, -0.9 * size * r),
                ]
            )
            chains.append(moved(rope(line, 0.004, 5), pose))
    bolts = [
        around(hexagon(0.022, q, q + 0.014), 8, 1.48 * r + w) for q, w in ((low + 0.05, 0.12 * r), (z + 0.02, 0.0))
    ]
    parts = [
        Part(merge([body, *([flutes] if flutes else []), *outs]), _H, "handle", _H),
        Part(foot, _H, "handle", _H),
        Part(merge([turned(cap, n), nut]), _H, "dial", _H),
        Part(merge(caps), _H, "dial", _H),
    ]
    if chains:
        parts.append(Part(merge(chains), _H, "clamp", _H))
    parts.append(Part(merge(bolts), "bolt", "fastener", _H, "Connection assembly", True))
    if rng.random() < 0.4:
        parts += [Part(merge([cylinder(0.06, 0, 0.9, 14), dome(0.06, 0.05, 0.9, 14)]), "post", "safety", "", FRAME)]
        parts[-1] = Part(moved(parts[-1].solid, at(0.6, 0.3)), "post", "safety", "", FRAME)
    return Model(parts)


def _standpipe(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A standpipe with a double head, handwheels and claw caps, in a street box or on a flange."""
    r = float(rng.uniform(0.035, 0.055))
    n, h = style.round(r), float(rng.uniform(0.8, 1.2))
    tube = merge(
        [
            cylinder(r, 0.03, h, n),
            cylinder(1.5 * r, h - 0.05, h + 0.02, n),
            cylinder(1.25 * r, 0.3 * h, 0.3 * h + 0.02, n),
        ]
    )
    arms, wheels, caps = [], [], []
    for angle in (0.4, np.pi - 0.4)[: int(rng.integers(1, 3))]:
        pose = at(0, 0, h) @ spun("z", angle)
        arms.append(
            moved(
                rope(
                    [(0, 0, -0.02), (1.2 * r, 0, 0.05), (3.2 * r, 0, 0.05), (4.2 * r, 0, 0.0), (4.6 * r, 0, -0.06)],
                    0.85 * r,
                    n,
                ),
                pose,
            )
        )
        wheels.append(
            moved(
                merge(
                    [
                        cylinder(0.35 * r, 0.05, 0.05 + 2.0 * r, 8),
                        moved(torus(1.2 * r, 0.14 * r, 16, 6), at(0, 0, 0.05 + 2.0 * r)),
                        box((2.4 * r, 0.2 * r, 0.1 * r), (0, 0, 0.05 + 2.0 * r)),
                    ]
                ),
                pose @ at(2.2 * r),
            )
        )
        claw = merge(
            [
                cylinder(1.15 * r, 0, 0.5 * r, n),
                cylinder(1.3 * r, 0.4 * r, 1.0 * r, n),
                around(box((0.3 * r, 0.4 * r, 0.3 * r), (1.3 * r, 0, 0.8 * r)), 2),
            ]
        )
        caps.append(moved(claw, pose @ at(4.6 * r, 0, -0.05) @ spun("y", np.pi + 0.3)))
    bar = rod((-3 * r, 0, 0.45 * h), (3 * r, 0, 0.45 * h), 0.4 * r, 8)
    foot = merge([cylinder(1.9 * r, 0.0, 0.02, n), cylinder(1.5 * r, 0.015, 0.06, n)])
    parts = [
        Part(merge([tube, *arms, bar, foot]), _H, "handle", _H),
        Part(merge(wheels), "handwheel", "rubber", _H, "Valve assembly"),
        Part(merge(caps), _H, "trim", _H),
    ]
    if rng.random() < 0.6:
        outer, inner = rounded_rectangle(0.5, 0.36, 0.04, 3), rounded_rectangle(0.4, 0.26, 0.02, 3)
        rim = extrude(outer, 0.0, 0.03, (inner,))
        lid = moved(box((0.4, 0.02, 0.26)), at(0, 0.188, 0.155))
        tags = [Part(rim, _H, "rubber", _H), Part(lid, _H, "rubber", _H)]
        stub = box((0.42, 0.28, 0.004), (0, 0, 0.002))
        parts += [*tags, Part(stub, _H, "rubber", _H)]
    return Model(parts)


def _cabinet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wall hydrant (EN 671): a cabinet with a reel or a flaked hose, an angle valve."""
    w, h, d, z = (
        float(rng.uniform(0.55, 0.8)),
        float(rng.uniform(0.6, 1.0)),
        float(rng.uniform(0.18, 0.28)),
        float(rng.uniform(0.5, 0.9)),
    )
    y, mid = -d / 2, z + h / 2
    walls = (
        [box((0.006, d, h), (q * w / 2, y, mid)) for q in (-1, 1)]
        + [box((w, d, 0.006), (0, y, z + q)) for q in (0.003, h - 0.003)]
        + [box((w, 0.006, h), (0, -0.003, mid))]
    )
    door = box((w, 0.02, h), (0, 0, 0))
    door = moved(door, at(-w / 2, -d + 0.001, mid) @ spun("z", -float(rng.uniform(1.2, 2.0))) @ at(w / 2))
    r, n = 0.36 * min(w, h), 24
    parts = [Part(merge(walls), _H, "handle", _H), Part(door, _H, "handle", _H)]
    if rng.random() < 0.6:
        reel = [
            moved(cylinder(r, q, q + 0.008, n), at(0.04 * w, 0, mid - 0.04) @ spun("x", np.pi / 2))
            for q in (0.03, d - 0.03)
        ]
        hub = moved(cylinder(0.06, 0.0, d - 0.02, 14), at(0.04 * w, 0, mid - 0.04) @ spun("x", np.pi / 2))
        count = max(2, int((d - 0.08) / 0.035))
        coils = [
            moved(torus(0.72 * r, 0.02, n, 6), at(0.04 * w, -0.055 - 0.035 * k, mid - 0.04) @ spun("x", np.pi / 2))
            for k in range(count)
        ]
        parts += [
            Part(merge([*reel, hub]), _H, "handle", _H),
            Part(
                merge([*coils, rod((0.04 * w, -0.06, mid - 0.04 - 0.7 * r), (0.04 * w, -0.06, mid - 0.04), 0.015, 8)]),
                "hose",
                "dial",
                "",
                "Pipe assembly",
            ),
        ]
    else:
        folds = [box((0.02, 0.06, 0.6 * h), (x, y, z + 0.4 * h)) for x in np.linspace(-0.3 * w, 0.1 * w, 7)]
        rack = rod((-0.4 * w, y, z + 0.7 * h), (0.2 * w, y, z + 0.7 * h), 0.012, 8)
        post = rod((-0.4 * w, y, z + 0.7 * h), (-0.4 * w, -0.003, z + 0.7 * h), 0.012, 8)
        loops = [box((0.4 * w + 0.02, 0.06, 0.02), (-0.1 * w, y, z + 0.1 * h))]
        parts += [
            Part(merge([*folds, *loops]), "hose", "dial", "", "Pipe assembly"),
            Part(merge([rack, post]), _H, "clamp", _H),
        ]
    x = 0.38 * w
    body = merge(
        [
            moved(ball(0.045, 14), at(x, y, z + 0.82 * h)),
            moved(cylinder(0.03, -0.09, 0.0, 14), at(x, y, z + 0.82 * h)),
            along("-y", cylinder(0.012, 0, min(0.08, d / 2), 8), x, y, z + 0.82 * h),
        ]
    )
    wheel = moved(
        merge([torus(0.045, 0.007, 16, 6), box((0.09, 0.01, 0.006)), box((0.01, 0.09, 0.006))]),
        at(x, y - min(0.075, d / 2 - 0.01), z + 0.82 * h) @ spun("x", np.pi / 2),
    )
    pipe = rod((x, y, z + 0.82 * h + 0.03), (x, y, z + h + 0.5), 0.027, 12)
    parts += [
        Part(body, "valve body", "trim", "", "Valve assembly"),
        Part(wheel, "handwheel", "handle", "", "Valve assembly"),
        Part(pipe, "pipe", "pipe", "", "Pipe assembly"),
        wall(-w, w, z + h + 0.6),
    ]
    return Model(parts)


def _monitor(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire monitor on its hydrant riser: swivels, bends, water or foam barrel, tiller or wheel."""
    r = float(rng.uniform(0.04, 0.07))
    n, h = style.round(r), float(rng.uniform(0.6, 1.1))
    stem = merge(
        [
            cylinder(2.0 * r, 0, 0.022, n),
            cylinder(r, 0.02, h, n),
            cylinder(1.9 * r, h - 0.05, h - 0.026, n),
            cylinder(1.9 * r, h - 0.025, h, n),
        ]
    )
    bolts = around(hexagon(0.022, 0.022, 0.036), 6, 1.6 * r)
    tilt = float(rng.uniform(0.2, 0.8))
    swivel = cylinder(1.35 * r, h, h + 0.09, n)
    s = 2.6 * r
    bends = [
        rope(
            [
                (0, 0, h + 0.08),
                (0, 0, h + 0.12),
                (0, 0.35 * s, h + 0.12 + 0.3 * s),
                (0, s, h + 0.12 + 0.5 * s),
                (0, 1.2 * s, h + 0.12 + s),
                (0, s, h + 0.12 + 1.5 * s),
                (0, 0.2 * s, h + 0.12 + 1.6 * s),
                (0, 0.0, h + 0.12 + 1.6 * s),
            ],
            r,
            n,
        )
    ]
    top = h + 0.12 + 1.6 * s
    joint = along("y", cylinder(1.35 * r, -0.05, 0.06, n), 0, 0, top)
    long = float(rng.uniform(0.5, 1.0))
    foam = rng.random() < 0.4
    tip = [
        (r, -0.02),
        (0.95 * r, 0.2 * long),
        (0.7 * r, 0.7 * long),
        (0.75 * r, 0.72 * long),
        (1.1 * r, 0.9 * long),
        (1.1 * r, long),
    ]
    if foam:
        tip = [(r, -0.02), (0.9 * r, 0.15 * long), (1.5 * r, 0.2 * long), (1.5 * r, long), (1.3 * r, long)]
    barrel = moved(turned(tip, n), at(0, -0.02, top) @ spun("y", np.pi / 2 - tilt))
    hub = moved(ball(1.3 * r, n), at(0, -0.02, top))
    tiller = rope([(-0.6 * r, -0.02, top - 0.2 * r), (-0.25, -0.02, top - 0.15), (-0.5, -0.02, top - 0.12)], 0.012, 8)
    cross = rod((-0.48, -0.15, top - 0.12), (-0.48, 0.11, top - 0.12), 0.012, 8)
    wheel = moved(
        merge([torus(0.09, 0.009, 18, 6), box((0.18, 0.014, 0.008)), cylinder(0.012, -0.1, 0.0, 8)]),
        at(-1.35 * r - 0.09, 0, h + 0.045) @ spun("y", -np.pi / 2),
    )
    parts = [
        Part(stem, _H, "handle", _H),
        Part(merge([swivel, *bends, joint, hub]), _H, "handle", _H),
        Part(barrel, _H, "rubber", _H),
        Part(bolts, "bolt", "fastener", _H, JOINT, True),
    ]
    parts.append(
        Part(merge([tiller, cross]), _H, "clamp", _H)
        if rng.random() < 0.6
        else Part(wheel, "handwheel", "rubber", _H, "Valve assembly")
    )
    outs = []
    for q in (-1, 1)[: int(rng.integers(0, 3))]:
        outs.append(
            along(
                "x" if q > 0 else "-x",
                merge([cylinder(0.7 * r, 0.8 * r, 2.2 * r, n), cylinder(0.95 * r, 2.0 * r, 2.6 * r, n)]),
                0,
                0,
                0.55 * h,
            )
        )
    if outs:
        parts.append(Part(merge(outs), _H, "trim", _H))
    return Model(parts)


HYDRANTS: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, "hydrant", build, (15,), "structure", weight)
    for name, build, weight in (
        ("hydrant/dry barrel", _us_pillar, 1.2),
        ("hydrant/standpipe", _standpipe, 1.0),
        ("hydrant/wall", _cabinet, 1.2),
        ("hydrant/monitor", _monitor, 1.0),
    )
)
