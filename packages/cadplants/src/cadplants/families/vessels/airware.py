"""Filters for air and oil, filter presses."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.heatware import equipment_family, equipment_mouth, frame_of
from cadplants.families.vessels.vesselware import sides
from cadplants.family import Family, Model, Part, Port
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import (
    along,
    around,
    box,
    cylinder,
    hexagon,
    lofted,
    rod,
    turned,
)
from cadplants.standards import FLANGES
from cadplants.transforms import at, spun

__all__ = ["AIRWARE"]

_NAME, _FRAME, _JOINT, _PIPE, _VALVE = (
    "filter",
    "Structural element",
    "Connection assembly",
    "Pipe assembly",
    "Valve assembly",
)


def _air_box(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An air filter box in a duct: a sheet case with a door and clasps, a pleated face, round or square collars."""
    w, h, d = (float(rng.uniform(*span)) for span in ((0.4, 1.0), (0.4, 1.0), (0.3, 0.7)))
    low, name = float(rng.uniform(0.1, 0.8)), _NAME
    case = box((d, w, h), (0, 0, low + h / 2))
    door = box((0.75 * d, 0.02, 0.85 * h), (0, -w / 2 - 0.01, low + h / 2))
    clasps = [box((0.03, 0.03, 0.06), (0.36 * d, -w / 2 - 0.025, low + f * h)) for f in (0.25, 0.75)]
    parts = [Part(case, name, "clamp", name), Part(merge([door, *clasps]), name, "clamp", name)]
    if rng.random() < 0.5:
        pleats = int(w / 0.05)
        ys = np.linspace(-0.44 * w, 0.44 * w, 2 * pleats + 1)
        xs = -d / 2 - 0.002 - 0.04 * (np.arange(len(ys)) % 2)
        front = np.column_stack([xs, ys])
        outline = np.vstack([front[::-1], [(-d / 2 + 0.01, ys[0]), (-d / 2 + 0.01, ys[-1])]])
        parts.append(Part(extrude(outline[::1], low + 0.06 * h, low + 0.94 * h), name, "dial", name))
        frame = [box((0.05, w, 0.06 * h), (-d / 2 - 0.025, 0, low + f * h)) for f in (0.03, 0.97)]
        parts.append(Part(merge(frame), name, "clamp", name))
    sides_ = (1,) if len(parts) > 2 else (-1, 1)
    for s in sides_:
        if rng.random() < 0.5:
            r = 0.32 * min(w, h)
            collar = along(
                "x" if s > 0 else "-x",
                merge(
                    [
                        cylinder(r, d / 2 - 0.005, d / 2 + 0.12, style.round(r)),
                        cylinder(1.08 * r, d / 2 + 0.05, d / 2 + 0.06, style.round(r)),
                    ]
                ),
                0,
                0,
                low + h / 2,
            )
            parts.append(Part(collar, name, "clamp", name))
        else:
            square = np.array([(x, y) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])
            loops = [
                np.column_stack([square * f * (h, w) * (1, 1), np.full(4, x)])
                for f, x in ((1.0, d / 2 - 0.002), (0.6, d / 2 + 0.25))
            ]
            hood = moved(lofted(loops), at(0, 0, low + h / 2) @ spun("y", s * np.pi / 2))
            parts.append(Part(hood, name, "clamp", name))
    legs_ = (
        frame_of(d, w, low + 0.01, 0.04, rails=False)
        if low > 0.2
        else merge([box((d, 0.06, low), (0, s * 0.4 * w, low / 2)) for s in (-1, 1)])
    )
    parts.append(Part(legs_, "skid frame", "steel", "", _FRAME))
    gauge = along("-y", cylinder(0.03, w / 2 - 0.005, w / 2 + 0.02, 14), -0.43 * d, 0, low + 0.9 * h)
    parts.append(Part(gauge, "gauge", "dial", "", "Gauge assembly"))
    return Model(parts, kind="air filter")


def _oil_can(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Spin-on oil or fuel filters: one to three cans with a fluted end under a cast head, on a bracket on a post."""
    count, r = int(rng.integers(1, 4)), float(rng.uniform(0.035, 0.065))
    tall, n, z, pitch = r * float(rng.uniform(2.4, 4.5)), sides(style, r), float(rng.uniform(0.7, 1.2)), 2.4 * r
    xs = (np.arange(count) - (count - 1) / 2) * pitch
    can = turned(
        [
            (0.8 * r, z - tall),
            (0.92 * r, z - tall + 0.12 * r),
            (0.92 * r, z - tall + 0.4 * r),
            (r, z - tall + 0.5 * r),
            (r, z - 0.012),
            (1.04 * r, z - 0.01),
            (1.04 * r, z),
        ],
        n,
    )
    flutes = around(rod((0, 0, z - tall + 0.05 * r), (0, 0, z - tall + 0.42 * r), 0.08 * r, 6), 12, 0.9 * r)
    block = box(((count - 1) * pitch + 2 * r, 1.8 * r, 0.9 * r), (0, 0, z + 0.45 * r))
    caps = [moved(cylinder(0.98 * r, z - 0.001, z + 0.3 * r, n), at(x)) for x in xs]
    half = (count - 1) * pitch / 2 + r
    stubs = [
        rod((s * (half - 0.01), 0, z + 0.45 * r), (s * (half + 0.12), 0, z + 0.45 * r), 0.013, 10) for s in (-1, 1)
    ]
    nuts = [
        along("x", hexagon(0.034, s * (half + 0.02) - 0.012, s * (half + 0.02) + 0.012), 0, 0, z + 0.45 * r)
        for s in (-1, 1)
    ]
    parts = [Part(moved(merge([can, flutes]), at(x)), _NAME, "handle", _NAME) for x in xs]
    parts.append(Part(merge([block, *caps]), _NAME, "trim", _NAME))
    parts.append(Part(merge(nuts), "nut", "fastener", "", _JOINT))
    parts += [Part(s, "pipe", "pipe", "", _PIPE) for s in stubs]
    back = 0.9 * r
    plate = box((1.6 * half, 0.008, 2.2 * r), (0, back + 0.004, z + 0.3 * r))
    post = box((0.06, 0.06, z + 1.4 * r), (0, back + 0.038, (z + 1.4 * r) / 2))
    parts.append(Part(plate, "bracket", "steel", "", _JOINT))
    parts.append(Part(post, "post", "steel", "", _FRAME))
    parts.append(Part(box((0.2, 0.2, 0.01), (0, back + 0.038, 0.005)), "base plate", "steel", "", _FRAME))
    return Model(parts, kind="oil filter")


def _press(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A filter press: a stack of square plates with handles between two heads on side bars, a hydraulic ram, legs."""
    w, z = float(rng.uniform(0.35, 0.7)), float(rng.uniform(0.6, 0.8))
    count = int(rng.integers(8, 24))
    step = float(rng.uniform(0.035, 0.06))
    stack, extra = count * step, float(rng.uniform(0.3, 0.6))
    plates = []
    for k in range(count):
        x = 0.06 + (k + 0.5) * step
        plates.append(
            merge(
                [
                    box((0.85 * step, w, w), (x, 0, z)),
                    *(box((0.5 * step, 0.1, 0.03), (x, s * (w / 2 + 0.04), z + 0.02)) for s in (-1, 1)),
                ]
            )
        )
    head_plate = box((0.06, w + 0.2, 1.05 * w), (0.03, 0, z))
    follow = box((0.06, w + 0.2, 1.05 * w), (0.06 + stack + 0.03, 0, z))
    end = 0.12 + stack + extra
    yoke = box((0.08, w + 0.2, 0.9 * w), (end + 0.04, 0, z))
    bars = [box((end, 0.03, 0.08), (end / 2, s * (w / 2 + 0.075), z - 0.035)) for s in (-1, 1)]
    ram = merge(
        [
            along("x", cylinder(0.04, 0.12 + stack - 0.001, end, 14), 0, 0, z),
            along("x", cylinder(0.09, end + 0.07, end + 0.5, 18), 0, 0, z),
        ]
    )
    legs_ = [
        box((0.08, 0.08, z - 0.4 * w), (x, s * (w / 2 + 0.04), (z - 0.4 * w) / 2))
        for x in (0.04, end + 0.04)
        for s in (-1, 1)
    ]
    tray = box((stack, w, 0.03), (0.06 + stack / 2, 0, z - 0.5 * w - 0.016))
    parts = [
        Part(merge([head_plate, follow, yoke, *bars]), _NAME, "steel", _NAME),
        *(Part(p, _NAME, "dial", _NAME) for p in ([merge(plates)] if rng.random() < 0.6 else plates)),
        Part(ram, _NAME, "motor", _NAME),
        Part(tray, _NAME, "clamp", _NAME),
        Part(merge(legs_), "tank leg", "steel", _NAME, "Tank"),
    ]
    ports: list[Port] = []
    for y, f in ((0.0, 0.0), (0.3 * w, 0.3 * w)):
        dn = 25 if FLANGES[40].outer > 0.4 * w else 40
        some, port = equipment_mouth(_NAME, dn, at(0, y, z + f) @ spun("y", -np.pi / 2), style)
        parts += some
        ports += port
    return Model(parts, ports=tuple(ports), kind="filter press")


AIRWARE: tuple[Family, ...] = (
    equipment_family("filter/air box", _air_box, 1.0),
    equipment_family("filter/spin-on", _oil_can, 1.0),
    equipment_family("filter/press", _press, 0.8),
)
