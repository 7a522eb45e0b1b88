"""Fire extinguishers on walls, stands and carts, in cabinets."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, h_column, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["FIRE"]

_E = "fire extinguisher"


def _bottle(r: float, h: float, style: ModelingStyle) -> Solid:
    """A pressure bottle about z from 0: round foot, shoulder, neck up to ``h + 0.9 r``."""
    a = (0.4, 0.8, 1.2)
    shoulder = [(r * np.cos(t), h + 0.75 * r * np.sin(t)) for t in a]
    return turned(
        [(0.85 * r, 0.0), (r, 0.12 * r), (r, h), *shoulder, (0.3 * r, h + 0.75 * r), (0.3 * r, h + 0.9 * r)],
        style.round(r),
    )


def _horned(r: float, h: float, style: ModelingStyle, rng: np.random.Generator, kind: str) -> list[Part]:
    """A style extinguisher about z from 0: with a horn (CO2), a side cartridge, or a gauge."""
    top = h + 0.88 * r
    levers = [
        box((1.6 * r, 0.28 * r, 0.08 * r), (0.5 * r, 0, top + 0.55 * r)),
        moved(box((1.6 * r, 0.25 * r, 0.08 * r)), at(0.65 * r, 0, top + 0.85 * r) @ spun("y", -0.2)),
    ]
    valve = merge(
        [
            cylinder(0.3 * r, top, top + 0.3 * r, 12),
            hexagon(0.6 * r, top + 0.1 * r, top + 0.4 * r),
            cylinder(0.22 * r, top + 0.3 * r, top + 0.85 * r, 10),
            *levers,
        ]
    )
    parts = [Part(_bottle(r, h, style), _E, "handle", _E), Part(valve, _E, "trim", _E)]
    if kind == "horn":
        arm = rope(
            [(-0.2 * r, 0, top + 0.3 * r), (-1.0 * r, 0, top + 0.35 * r), (-1.5 * r, 0, top - 0.4 * r)], 0.12 * r, 8
        )
        horn = moved(
            turned([(0.75 * r, -3.2 * r), (0.3 * r, -0.6 * r), (0.3 * r, 0.0), (0.15 * r, 0.02 * r)], style.round(r)),
            at(-1.75 * r, 0, top - 0.3 * r),
        )
        horn = moved(horn, at(-1.75 * r, 0, top) @ spun("y", 0.12) @ at(1.75 * r, 0, -top))
        return [*parts, Part(merge([arm, horn]), _E, "rubber", _E)]
    if kind == "cartridge":
        side = moved(_bottle(0.3 * r, 0.45 * h, style), at(1.28 * r, 0, 0.3 * h))
        band = [box((0.5 * r, 0.3 * r, 0.06 * r), (1.05 * r, 0, 0.35 * h + q * 0.3 * h)) for q in (0, 1)]
        parts.append(Part(merge([side, *band]), _E, "trim", _E))
    else:
        parts.append(Part(along("-y", cylinder(0.25 * r, 0.2 * r, 0.4 * r, 12), 0, 0, top + 0.3 * r), _E, "gauge", _E))
    hose = rope(
        [(-0.2 * r, 0, top + 0.3 * r), (-1.1 * r, 0, top + 0.2 * r), (-1.4 * r, 0, 0.75 * h), (-1.25 * r, 0, 0.3 * h)],
        0.13 * r,
        8,
    )
    tip = rod((-1.25 * r, 0, 0.32 * h), (-1.22 * r, 0, 0.12 * h), 0.2 * r, 8)
    clip = box((0.6 * r, 0.3 * r, 0.08 * r), (-1.1 * r, 0, 0.28 * h))
    return [*parts, Part(merge([hose, tip, clip]), _E, "rubber", _E)]


def _kept(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Hand extinguishers (EN 3): on a wall bracket, on a stand with a sign, in a cabinet, on the floor."""
    kind, place = pick(rng, "horn", "cartridge", "gauge"), pick(rng, "wall", "stand", "cabinet", "floor")
    r, h = float(rng.uniform(0.055, 0.09)), 0.0
    h = float(rng.uniform(3.8, 6.5)) * r
    unit = _horned(r, h, style, rng, kind)
    full = h + 2.0 * r

    def lifted(x: float, y: float, z: float) -> list[Part]:
        """The unit put somewhere."""
        return [Part(moved(p.solid, at(x, y, z)), p.name, p.color, p.bundle) for p in unit]

    if place == "floor":
        return Model([p for k in range(int(rng.integers(1, 3))) for p in lifted(4.5 * r * k, 0.0, 0.0)])
    if place == "wall":
        z = float(rng.uniform(0.4, 0.9))
        strap = merge(
            [
                moved(ring(r, r + 0.003, 0, 0.02, style.round(r)), at(0, -r - 0.02, z + 0.6 * h)),
                box((0.06, 0.022, 0.2), (0, -0.011, z + 0.6 * h)),
            ]
        )
        shelf = merge(
            [
                box((1.2 * r, 2 * r, 0.006), (0, -r - 0.015, z - 0.003)),
                box((1.2 * r, 0.006, 0.1), (0, -0.003, z - 0.03)),
            ]
        )
        sign = box((0.2, 0.003, 0.2), (0, -0.0015, z + full + 0.35))
        back = wall(-0.5, 0.5, z + full + 0.7) if rng.random() < 0.6 else h_column(z + full + 0.7, 0.24)
        return Model(
            [
                *lifted(0, -r - 0.02, z),
                Part(strap, "clamp", "clamp", "", JOINT),
                Part(shelf, "bracket", "clamp", "", JOINT),
                Part(sign, "sign", "safety"),
                back,
            ]
        )
    if place == "stand":
        foot, n = 0.18, style.round(0.18)
        post = box((0.05, 0.02, full + 0.7), (0, r + 0.035, (full + 0.7) / 2 + 0.01))
        plate = moved(
            extrude(rounded_rectangle(0.3, 0.3, 0.02, 2), 0, 0.003),
            at(0, r + 0.025, full + 0.55) @ spun("x", np.pi / 2),
        )
        tray = merge([cylinder(foot, 0, 0.012, n), box((0.08, r + 0.06, 0.012), (0, (r + 0.06) / 2, 0.006))])
        hook = box((0.04, 0.03, 0.02), (0, r + 0.012, 0.7 * h))
        return Model(
            [
                *lifted(0, 0, 0.012),
                Part(post, "post", "clamp", "", FRAME),
                Part(tray, "base plate", "clamp", "", FRAME),
                Part(hook, "bracket", "clamp", "", JOINT),
                Part(plate, "sign", "safety"),
            ]
        )
    w, d, z = max(0.3, 4.2 * r), 2 * r + 0.1, float(rng.uniform(0.5, 0.9))
    tall = full + 0.1
    y = -d / 2
    walls = [box((0.01, d, tall), (q * (w / 2 - 0.005), y, z + tall / 2)) for q in (-1, 1)]
    walls += [box((w, d, 0.01), (0, y, z + q)) for q in (0.005, tall - 0.005)] + [
        box((w, 0.01, tall), (0, -0.005, z + tall / 2))
    ]
    rim = [box((0.04, 0.02, tall), (q * (w / 2 - 0.02), -d - 0.01, z + tall / 2)) for q in (-1, 1)] + [
        box((w, 0.02, 0.04), (0, -d - 0.01, z + q)) for q in (0.02, tall - 0.02)
    ]
    pane = box((w - 0.07, 0.006, tall - 0.07), (0, -d - 0.006, z + tall / 2))
    grip = box((0.02, 0.03, 0.1), (0.42 * w, -d - 0.035, z + tall / 2))
    closed = rng.random() < 0.5
    inner = lifted(0.6 * r, y, z + 0.01)
    case = Part(merge([*walls, *rim, grip]), _E, "handle", _E)
    return Model([*inner, case, *([Part(pane, _E, "dial", _E)] if closed else []), wall(-0.6, 0.6, z + tall + 0.4)])


def _wheeled(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wheeled extinguisher (EN 1866): one big bottle or two slim ones on a cart, a coiled hose."""
    r, two = float(rng.uniform(0.11, 0.17)), bool(rng.random() < 0.35)
    if two:
        r *= 0.75
    h, low = float(rng.uniform(4.0, 6.0)) * r, 0.06
    spots = (-1.15 * r, 1.15 * r) if two else (0.0,)
    bottles = [moved(_bottle(r, h, style), at(0, y, low)) for y in spots]
    top = low + h + 0.88 * r
    valves = [
        moved(
            merge(
                [
                    cylinder(0.25 * r, 0, 0.4 * r, 10),
                    hexagon(0.5 * r, 0.1 * r, 0.3 * r),
                    moved(torus(0.35 * r, 0.05 * r, 14, 6), at(0, 0, 0.45 * r)),
                    box((0.7 * r, 0.08 * r, 0.06 * r), (0, 0, 0.45 * r)),
                ]
            ),
            at(0, y, top),
        )
        for y in spots
    ]
    wide = (2.3 if two else 1.3) * r + 0.06
    wheel_r, n = float(rng.uniform(0.12, 0.2)), 20
    x = -r - 0.06
    axle = rod((x, -wide - 0.06, wheel_r), (x, wide + 0.06, wheel_r), 0.012, 8)
    wheels = [
        along(
            "y",
            merge(
                [
                    ring(0.75 * wheel_r, wheel_r, -0.02, 0.02, n),
                    cylinder(0.2 * wheel_r, -0.025, 0.025, 12),
                    around(box((0.62 * wheel_r, 0.02, 0.012), (0.48 * wheel_r, 0, 0)), 5),
                ]
            ),
            x,
            q * (wide + 0.03),
            wheel_r,
        )
        for q in (-1, 1)
    ]
    rails = [
        rope(
            [
                (0.0, q * wide * 0.8, low - 0.02),
                (x, q * wide * 0.8, low - 0.02),
                (x, q * wide * 0.8, 0.9 * top),
                (x - 0.15, q * wide * 0.8, top + 0.12),
            ],
            0.014,
            8,
        )
        for q in (-1, 1)
    ]
    bars = [rod((x - 0.15, -0.8 * wide, top + 0.12), (x - 0.15, 0.8 * wide, top + 0.12), 0.014, 8)]
    bars += [box((0.06 + 0.01, 1.7 * wide, 0.03), (x + 0.03, 0, low + q * h)) for q in (0.25, 0.75)]
    tray = box((2 * r, 1.6 * wide, 0.02), (0, 0, low - 0.01))
    feet = [box((0.04, 0.04, low - 0.015), (0.7 * r, q * 0.6 * wide, (low - 0.015) / 2)) for q in (-1, 1)]
    coils = [
        moved(torus(0.75 * r + 0.03, 0.014, 20, 6), at(r + 0.015 + 0.028 * k, 0, low + 0.62 * h) @ spun("y", np.pi / 2))
        for k in range(int(rng.integers(2, 5)))
    ]
    hook = rod((0.8 * r, 0, low + 0.62 * h + 0.75 * r), (r + 0.1, 0, low + 0.62 * h + 0.75 * r), 0.01, 8)
    lead = rope(
        [(0.2 * r, spots[-1], top + 0.2 * r), (1.0 * r, 0, top), (r + 0.02, 0.5 * r, low + 0.62 * h + 0.6 * r)],
        0.014,
        8,
    )
    return Model(
        [
            Part(merge(bottles), _E, "handle", _E),
            Part(merge(valves), _E, "trim", _E),
            Part(merge([axle, *rails, *bars, tray, *feet, hook]), _E, "rubber", _E),
            Part(merge(wheels), "caster", "rubber", "", FRAME),
            Part(merge([*coils, lead]), "hose", "rubber", "", "Pipe assembly"),
        ]
    )


FIRE: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "structure", weight)
    for name, build, weight in (
        ("fire extinguisher/kept", _kept, 1.5),
        ("fire extinguisher/wheeled", _wheeled, 1.0),
    )
)
