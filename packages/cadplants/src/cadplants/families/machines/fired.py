"""Burners with what they stand on."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.machines.machinery import foreign, motor
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["FIRED"]

_EQ = "Equipment"


def _monobloc(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A monobloc gas burner (EN 676) on a boiler front: oval fan housing with hinge, air inlet, motor, train, panel."""
    eq, r = "burner", float(rng.uniform(0.09, 0.25))
    n, z = style.round(r), float(rng.uniform(0.6, 1.1)) + 1.5 * r
    wall = box((0.12, 5 * r + 0.2, z + 3 * r), (-0.06 - 0.02, 0, (z + 3 * r) / 2))
    plate = along("x", extrude(rounded_rectangle(1.9 * r, 1.9 * r, 0.3 * r, 3), -0.02, 0.02), 0, 0, z)
    tube_ = along("x", cylinder(0.62 * r, -0.1, 0.3 * r, n), 0, 0, z)
    outline = rounded_rectangle(2.3 * r, 1.8 * r, float(rng.uniform(0.3, 0.85)) * r, 4)
    house = along("x", extrude(outline, 0.25 * r, 1.3 * r), 0, 0, z - 0.15 * r)
    hood = along("x", extrude(0.85 * outline, 1.3 * r, float(rng.uniform(1.5, 2.0)) * r), 0, 0, z - 0.15 * r)
    damper = box((0.8 * r, 1.1 * r, 0.8 * r), (0.8 * r, 0, z - 1.5 * r))
    slats = [box((0.84 * r, 1.14 * r, 0.03 * r), (0.8 * r, 0, z + q * r)) for q in (-1.85, -1.7, -1.55)]
    pegs = [along("x", cylinder(0.06 * r, 0.0, 0.4 * r, 8), 0, s * 0.75 * r, z + 0.75 * r) for s in (-1, 1)]
    parts = [
        Part(merge([plate, tube_, house, *pegs]), eq, "handle", eq),
        Part(hood, eq, "rubber", eq),
        Part(merge([damper, *slats]), eq, "handle", eq),
    ]
    m = 0.5 * r
    side = -1 if rng.random() < 0.5 else 1
    pose = at(0.8 * r, side * 0.89 * r, z - 0.15 * r) @ spun("x", -side * np.pi / 2) @ spun("z", -side * np.pi / 2)
    parts += foreign(placed(motor(m, 2.3 * m, style, rng, 0.0, pick(rng, "cast", "smooth", "square")), pose))
    dn_r = 0.02 + 0.06 * r
    zt = z - 0.2 * r
    y0 = -side * 0.85 * r
    far = -side * (2.4 * r + 0.5)
    line = [(0.8 * r, y0, zt), (0.8 * r, far, zt)]
    train_ = rod(line[0], line[1], dn_r, 12)
    w = 3.2 * dn_r
    mid = (y0 + far) / 2
    valves = [box((w, 1.3 * w, w), (0.8 * r, mid + q * w, zt)) for q in (-0.9, 0.9)]
    coils = [box((0.7 * w, 0.7 * w, 0.9 * w), (0.8 * r, mid + q * w, zt + 0.95 * w)) for q in (-0.9, 0.9)]
    parts += [
        Part(train_, "pipe", "pipe", eq, "Pipe assembly"),
        Part(merge([*valves, *coils]), "valve", "trim", eq, "Valve assembly"),
        Part(
            box((0.9 * r, 0.12 * r, 0.7 * r), (0.8 * r, -side * 0.96 * r, z + 0.55 * r)),
            "control panel",
            "electrical",
            eq,
            "Electrical and safety",
        ),
        Part(wall, "wall", "concrete", "", "Structural element"),
        Part(along("x", rope([(0.0, 0, 0), (0.0, 0, 0.05)], 0.02, 8), 0.02, 0.7 * r, z - 0.7 * r), eq, "dial", eq),
    ]
    return Model(parts, kind="monobloc burner")


def _in_duct(eq: str, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Runners with mixing wings across a flanged rectangular duct."""
    w, h, z = float(rng.uniform(0.6, 1.2)), float(rng.uniform(0.5, 1.0)), float(rng.uniform(0.5, 1.0))
    t, long = 0.004, 0.5
    sides = [box((long, t, h), (0, s * w / 2, z + h / 2)) for s in (-1, 1)] + [
        box((long, w + t, t), (0, 0, z + h / 2 + s * h / 2)) for s in (-1, 1)
    ]
    rims = [
        merge(
            [
                *(box((0.03, 0.05, h + 0.1), (x, s * (w / 2 + 0.02), z + h / 2)) for s in (-1, 1)),
                *(box((0.03, w + 0.09, 0.05), (x, 0, z + h / 2 + s * (h / 2 + 0.02))) for s in (-1, 1)),
            ]
        )
        for x in (-long / 2, long / 2)
    ]
    rows = [box((0.08, w - 0.006, 0.06), (0, 0, z + q * h)) for q in (0.25, 0.5, 0.75)]
    wings = [
        moved(box((0.18, w - 0.02, 0.003)), at(0.1, 0, z + q * h + s * 0.07) @ spun("y", -0.5 * s))
        for q in (0.25, 0.5, 0.75)
        for s in (-1, 1)
    ]
    head = rod((0, -w / 2 - 0.12, z + 0.1 * h), (0, -w / 2 - 0.12, z + 0.95 * h), 0.03, 12)
    feeds = [rod((0, -w / 2 - 0.12, z + q * h), (0, -w / 2 + 0.01, z + q * h), 0.018, 10) for q in (0.25, 0.5, 0.75)]
    legs = [box((0.05, 0.05, z), (x * 0.4 * long, y * (w / 2 + 0.02), z / 2)) for x in (-1, 1) for y in (-1, 1)]
    pilot = along(
        "-y", merge([cylinder(0.03, 0, 0.15, 12), cylinder(0.045, 0.15, 0.24, 12)]), 0.12, -w / 2, z + 0.6 * h
    )
    parts = [
        Part(merge([*sides, *rims]), eq, "clamp", eq),
        Part(merge([*rows, *wings]), eq, "trim", eq),
        Part(merge([head, *feeds]), "pipe", "pipe", eq, "Pipe assembly"),
        Part(pilot, eq, "handle", eq),
        Part(merge(legs), "bracket", "steel", "", "Connection assembly"),
    ]
    return Model(parts, kind="duct burner")


def _row(eq: str, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Slotted tubes with their injectors on one gas bar."""
    count, long, z = int(rng.integers(4, 12)), float(rng.uniform(0.3, 0.8)), float(rng.uniform(0.25, 0.7))
    pitch = 0.07
    tubes = [
        merge(
            [
                along("x", extrude(rounded_rectangle(0.05, 0.03, 0.014, 3), 0.05, long), 0, k * pitch, z),
                along("x", turned([(0.022, -0.03), (0.012, 0.01), (0.018, 0.08)], 12), 0, k * pitch, z),
            ]
        )
        for k in range(count)
    ]
    mid = (count - 1) * pitch / 2
    bar = merge(
        [
            rod((-0.06, -0.08, z), (-0.06, 2 * mid + 0.08, z), 0.014, 10),
            *(along("x", hexagon(0.016, -0.06, -0.02), 0, k * pitch, z) for k in range(count)),
        ]
    )
    frame = [box((0.03, 2 * mid + 0.14, 0.03), (x, mid, z - 0.04)) for x in (0.08, long - 0.03)]
    posts = [
        box((0.03, 0.03, z - 0.05), (x, y, (z - 0.05) / 2))
        for x in (0.08, long - 0.03)
        for y in (-0.05, 2 * mid + 0.05)
    ]
    block = box((0.08, 0.1, 0.09), (-0.06, -0.12, z))
    return Model(
        [
            Part(merge(tubes), eq, "trim", eq),
            Part(bar, "pipe", "pipe", eq, "Pipe assembly"),
            Part(block, "valve", "trim", eq, "Valve assembly"),
            Part(merge([*frame, *posts]), "bracket", "steel", "", "Connection assembly"),
        ],
        kind="atmospheric burner",
    )


def _nozzle_mix(eq: str, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A nozzle mixing burner on a furnace wall with pilot and scanner."""
    r, z = float(rng.uniform(0.05, 0.12)), float(rng.uniform(0.7, 1.3))
    n = style.round(r)
    wall = box((0.15, 8 * r + 0.2, z + 5 * r), (-0.075, 0, (z + 5 * r) / 2))
    body = along(
        "x",
        turned(
            [
                (1.6 * r, 0.0),
                (1.6 * r, 0.02),
                (r, 0.02),
                (r, 2.2 * r),
                (1.4 * r, 2.25 * r),
                (1.4 * r, 2.6 * r),
                (0.5 * r, 2.7 * r),
                (0.5 * r, 3.4 * r),
            ],
            n,
        ),
        0,
        0,
        z,
    )
    bolts = along("x", around(hexagon(0.018, 0.02, 0.032), 8, 1.4 * r), 0, 0, z)
    air = [
        along("y", cylinder(0.55 * r, 0.9 * r, 3 * r, n), 1.2 * r, 0, z),
        along("y", cylinder(0.85 * r, 2.9 * r, 3.0 * r + 0.02, n), 1.2 * r, 0, z),
    ]
    pilot = moved(
        merge(
            [
                cylinder(0.18 * r, 0, 3.6 * r, 12),
                cylinder(0.28 * r, 2.4 * r, 3.2 * r, 12),
                hexagon(0.5 * r, 1.8 * r, 2.1 * r),
            ]
        ),
        at(0.02, 0, z + 1.2 * r) @ spun("y", 1.1),
    )
    eye = moved(
        merge([cylinder(0.14 * r, 0, 2.6 * r, 10), cylinder(0.3 * r, 2.6 * r, 3.6 * r, 12)]),
        at(0.02, 0.6 * r, z - 1.1 * r) @ spun("y", 1.9),
    )
    gas = [(3.35 * r, 0, z), (4.4 * r, 0, z), (4.6 * r, 0, z - 0.2 * r), (4.6 * r, 0, z - 3 * r)]
    return Model(
        [
            Part(merge([body, *air]), eq, "handle", eq),
            Part(pilot, eq, "trim", eq),
            Part(eye, eq, "rubber", eq),
            Part(bolts, "bolt", "fastener", eq, "Connection assembly", True),
            Part(rope(gas, 0.35 * r, 10), "hose", "trim", "", "Pipe assembly"),
            Part(wall, "wall", "concrete", "", "Structural element"),
        ],
        kind="nozzle burner",
    )


def _duct(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Burners without a fan of their own: a duct burner in a rectangular duct, a row of them, or pilots."""
    eq, kind = "burner", int(rng.integers(3))
    if kind == 0:
        return _in_duct(eq, style, rng)
    if kind == 1:
        return _row(eq, style, rng)
    return _nozzle_mix(eq, style, rng)


FIRED: tuple[Family, ...] = (
    Family("burner/monobloc", "floor", _EQ, "burner", _monobloc, (15,), weight=1.5),
    Family("burner/without fan", "floor", _EQ, "burner", _duct, (15,), weight=1.5),
)
