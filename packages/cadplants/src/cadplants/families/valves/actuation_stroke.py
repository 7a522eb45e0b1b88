"""What lifts a valve's stem, standing on z = 0: yokes, wheels, diaphragms, pistons, rams, motors, magnets."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.drive import BODY
from cadplants.family import Part, placed
from cadplants.mesh_ops import Solid, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["LINEAR", "linear", "screwed_up", "yoke_arms"]

Rng = np.random.Generator
Maker = Callable[[float, float, ModelingStyle, Rng], list[Part]]


def yoke_arms(half: float, tall: float, style: ModelingStyle, rng: Rng, bundle: str = BODY) -> Part:
    """A yoke from z = 0 to ``tall``: arched, straight or waisted arms, pillars, a window frame, a slotted tube [m]."""
    n, kind = max(12, style.round(half)), int(rng.integers(6))
    plate = max(0.006, 0.10 * half)
    crown = float(rng.uniform(0.45, 0.8)) * half
    top = cylinder(crown, tall - 1.6 * plate, tall, n)
    foot = cylinder(half, 0.0, plate, n)
    if kind <= 1:
        wide, thick = float(rng.uniform(0.18, 0.35)) * half, float(rng.uniform(0.1, 0.2)) * half
        bulge = half * (1.0 if kind == 0 else float(rng.uniform(0.55, 0.8)))
        path = np.array(
            [
                (0, 0.75 * half, 0.5 * plate),
                (0, bulge, 0.3 * tall),
                (0, bulge, 0.65 * tall),
                (0, 0.6 * crown, tall - 0.8 * plate),
            ]
        )
        arm = sweep(
            path, np.array([[-wide, -thick], [wide, -thick], [wide, thick], [-wide, thick]]), up=(1.0, 0.0, 0.0)
        )
        solids = [arm, moved(arm, spun("z", np.pi)), top, foot]
    elif kind == 2:
        count = int(rng.choice([2, 3, 4]))
        posts = around(cylinder(0.09 * half + 0.002, 0.0, tall + plate, 10), count, 0.8 * half, np.pi / 2)
        nuts = around(hexagon(0.3 * half + 0.006, tall, tall + plate), count, 0.8 * half, np.pi / 2)
        solids = [posts, nuts, cylinder(half, tall - 1.6 * plate, tall, n), foot]
    elif kind == 3:
        outline = np.array([(-half, 0.0), (half, 0.0), (0.75 * half, tall), (-0.75 * half, tall)])
        window = np.array(
            [
                (-0.7 * half, 0.16 * tall),
                (0.7 * half, 0.16 * tall),
                (0.5 * half, 0.86 * tall),
                (-0.5 * half, 0.86 * tall),
            ]
        )
        deep = 0.22 * half + 0.003
        frame = moved(slab(outline, -deep, deep, (window,)), spun("z", np.pi / 2) @ spun("x", np.pi / 2))
        solids = [frame, foot, top]
    elif kind == 4:
        legs = [box((0.08 * half + 0.004, 0.5 * half, tall), (s * 0.72 * half, 0, tall / 2)) for s in (-1, 1)]
        legs = [moved(leg, spun("z", np.pi / 2)) for leg in legs]
        solids = [
            *legs,
            box((0.6 * half, 1.6 * half, 1.5 * plate), (0, 0, tall - 0.75 * plate)),
            box((0.9 * half, 1.7 * half, plate), (0, 0, plate / 2)),
        ]
    else:
        turns = [np.linspace(-0.8, 0.8, 7) + s * np.pi / 2 for s in (-1, 1)]
        shells = [
            slab(
                np.array(
                    [(r * np.cos(a), r * np.sin(a)) for r, t in ((0.85 * half, w), (0.7 * half, w[::-1])) for a in t]
                ),
                0.5 * plate,
                tall - plate,
            )
            for w in turns
        ]
        solids = [*shells, cylinder(0.88 * half, tall - 1.6 * plate, tall, n), foot]
    return Part(merge(solids), "yoke", "valve", bundle)


def screwed_up(half: float, tall: float, wheel: float, slim: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """An outside screw and yoke: yoke, rising stem, yoke nut, and a wheel, a gear or a motor on top [m]."""
    nut = merge([cylinder(2.2 * slim, tall - 0.01, tall + 1.5 * slim, 12), hexagon(3.6 * slim, tall, tall + slim)])
    parts = [yoke_arms(half, tall, style, rng), Part(nut, "nut", "trim", BODY, "Connection assembly")]
    kind = rng.random()
    if kind < 0.72 or wheel < 0.08:
        open_ = float(rng.uniform(0.0, 1.0)) * 0.8 * tall
        parts += [
            shaft(-0.01, tall + 3 * slim + open_ + 0.02, slim, style, rng),
            hand_wheel(wheel, tall + 1.2 * slim, style, rng),
        ]
        if open_ > 0.3 * tall and rng.random() < 0.3:
            parts.append(
                Part(
                    cylinder(1.8 * slim, tall + 3 * slim + 0.01, tall + 5 * slim + open_ + 0.04, 12),
                    "valve stem",
                    "trim",
                    BODY,
                )
            )
        return parts
    parts.append(shaft(-0.01, tall + 2 * slim, slim, style, rng))
    driver = ("bevel",) if kind < 0.87 else ("multi-turn",)
    return parts + quarter_turn(0.0, tall + 0.5 * slim, 0.6 * wheel, style, rng, driver)


def _rim_bolts(head: float, low: float, high: float, rng: Rng) -> Part:
    count = int(np.clip(60 * head, 6, 18))
    one = merge([cylinder(0.005, low, high, 6), hexagon(0.014, high, high + 0.006), hexagon(0.014, low - 0.006, low)])
    return bolted(around(one, count, 0.93 * head), "actuator")


def _diaphragm(radius: float, tall: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A spring diaphragm: dished pans, flat pans, a deep spring case above, or two storeys; with a vent and an eye."""
    head = float(rng.uniform(0.8, 1.4)) * (0.08 + 1.2 * radius)
    n, kind = max(16, style.round(head)), int(rng.integers(4))
    lip = 0.012 + 0.03 * head
    lower = [
        (0.25 * head, 0.0),
        (0.6 * head, 0.06 * head),
        (0.86 * head, 0.18 * head),
        (head, 0.18 * head),
        (head, 0.18 * head + lip),
    ]
    if kind == 0:
        upper = [(head, 0.0), (head, lip), (0.86 * head, lip), (0.6 * head, 0.2 * head), (0.2 * head, 0.26 * head)]
    elif kind == 1:
        lower = [
            (0.85 * head, 0.0),
            (0.88 * head, 0.2 * head - 0.01),
            (head, 0.2 * head - 0.01),
            (head, 0.18 * head + lip),
        ]
        upper = [(head, 0.0), (head, lip), (0.88 * head, lip), (0.86 * head, 0.35 * head), (0.8 * head, 0.4 * head)]
    elif kind == 2:
        upper = [
            (head, 0.0),
            (head, lip),
            (0.8 * head, lip + 0.05 * head),
            (0.45 * head, 0.3 * head),
            (0.42 * head, 1.1 * head),
            (0.3 * head, 1.25 * head),
            (0.1 * head, 1.28 * head),
        ]
    else:
        upper = [
            (head, 0.0),
            (head, lip),
            (0.9 * head, 2 * lip),
            (0.9 * head, 0.5 * head),
            (0.8 * head, 0.62 * head),
            (0.1 * head, 0.66 * head),
        ]
    seam = 0.18 * head + lip
    pans = [turned(lower, n), turned([(r, z + seam + 0.001) for r, z in upper], n)]
    high = seam + upper[-1][1]
    if rng.random() < 0.5:
        pans.append(
            merge(
                [
                    cylinder(0.04 * head + 0.004, high - 0.01, high + 0.05 * head, 8),
                    hexagon(0.1 * head + 0.01, high - 0.003, high + 0.03 * head),
                ]
            )
        )
    parts = [Part(merge(pans), "actuator", "valve", "actuator"), _rim_bolts(head, 0.18 * head, seam + lip + 0.001, rng)]
    if rng.random() < 0.2:
        parts += [
            shaft(high - 0.01, high + 0.25 * head, 0.05 * head, style, rng),
            hand_wheel(0.5 * head, high + 0.15 * head, style, rng),
        ]
    return placed(parts, at(0, 0, tall))


def _piston(radius: float, tall: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A piston cylinder: end plates held by tie rods, or a smooth barrel with rolled covers, ports on one side."""
    half, long = (
        float(rng.uniform(0.8, 1.2)) * (0.03 + 0.7 * radius),
        float(rng.uniform(1.6, 3.0)) * (0.03 + 0.7 * radius),
    )
    n = max(16, style.round(half))
    kind = int(rng.integers(3))
    if kind == 0:
        plate = (
            rounded_rectangle(2.3 * half, 2.3 * half, 0.2 * half, 2) if rng.random() < 0.6 else circle(1.25 * half, n)
        )
        solids = [slab(plate, z, z + 0.2 * half) for z in (0.0, long)]
        rods = cylinder(0.07 * half + 0.001, -0.02 * half, long + 0.3 * half, 8)
        nuts = hexagon(0.24 * half, long + 0.2 * half, long + 0.34 * half)
        solids += [
            cylinder(half, 0.1 * half, long + 0.1 * half, n),
            around(merge([rods, nuts]), 4, 1.4 * half * 0.98 if len(plate) < 14 else 1.12 * half, np.pi / 4),
        ]
        high = long + 0.2 * half
    elif kind == 1:
        solids = [
            turned(
                [
                    (0.8 * half, 0.0),
                    (half, 0.1 * half),
                    (half, long),
                    (0.85 * half, long + 0.2 * half),
                    (0.3 * half, long + 0.3 * half),
                ],
                n,
            )
        ]
        solids += [ring(0.9 * half, 1.08 * half, z, z + 0.12 * half, n) for z in (0.2 * half, long - 0.2 * half)]
        high = long + 0.3 * half
    else:
        solids = [
            turned(
                [
                    (0.6 * half, 0.0),
                    (0.95 * half, 0.25 * half),
                    (half, 0.25 * half),
                    (half, 0.8 * long),
                    (1.06 * half, 0.82 * long),
                    (1.06 * half, 0.95 * long),
                ],
                n,
            ),
            dome(1.0 * half, 0.45 * half, 0.95 * long, n),
        ]
        high = 0.95 * long + 0.44 * half
    solids += [along("y", hexagon(0.022, 0.7 * half, 1.12 * half + 0.012), 0, 0, z) for z in (0.3 * long, 0.8 * long)]
    parts = [Part(merge(solids), "actuator", "clamp" if kind == 1 else "motor", "actuator")]
    if rng.random() < 0.5:
        eye = merge(
            [
                cylinder(0.13 * half, high - 0.01, high + 0.3 * half, 12),
                dome(0.12 * half, 0.12 * half, high + 0.3 * half, 12),
            ]
        )
        parts.append(Part(eye, "position indicator", "safety", "actuator"))
    return placed(parts, at(0, 0, tall))


def _ram(radius: float, tall: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A hydraulic cylinder: a thick tube between square heads, elbowed oil ports and their pipe."""
    half, long = 0.025 + 0.4 * radius, float(rng.uniform(3.0, 5.0)) * (0.025 + 0.4 * radius)
    n = max(16, style.round(half))
    heads = [box((2.2 * half, 2.2 * half, 0.6 * half), (0, 0, z)) for z in (0.3 * half, long)]
    tube_ = cylinder(0.9 * half, 0.5 * half, long, n)
    ties = around(cylinder(0.1 * half, 0.0, long + 0.45 * half, 8), 4, 1.3 * half, np.pi / 4)
    pipe = rope(
        [(0, 1.0 * half, 0.3 * half), (0, 1.6 * half, 0.3 * half), (0, 1.6 * half, long), (0, 1.0 * half, long)],
        0.08 * half + 0.002,
        8,
    )
    return placed([Part(merge([*heads, tube_, ties, pipe]), "actuator", "motor", "actuator")], at(0, 0, tall))


def _motor(radius: float, tall: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A linear electric actuator, as on heating valves: a moulded case, round or boxy, a cable gland, a knob."""
    half, n = 0.035 + 0.4 * radius, max(16, style.round(0.05))
    high = float(rng.uniform(1.6, 3.0)) * half
    if rng.random() < 0.5:
        case = slab(rounded_rectangle(2.4 * half, 1.7 * half, 0.4 * half, 3), 0.0, high)
        lid = slab(rounded_rectangle(2.2 * half, 1.5 * half, 0.4 * half, 3), high, high + 0.25 * half)
    else:
        case = turned([(0.6 * half, 0.0), (half, 0.4 * half), (half, 0.8 * high), (0.8 * half, high)], n)
        lid = dome(0.8 * half, 0.3 * half, high, n)
    gland = along("x", hexagon(0.022, 0.8 * half, 1.2 * half + 0.022), 0, 0, 0.35 * high)
    parts = [Part(merge([case, lid, gland]), "actuator", "electrical", "actuator")]
    if rng.random() < 0.5:
        parts.append(
            Part(
                along("-y", cylinder(0.25 * half, 0.75 * half, 1.15 * half, 12), 0, 0, 0.7 * high),
                "position indicator",
                "safety",
                "actuator",
            )
        )
    return placed(parts, at(0, 0, tall))


def _turning(radius: float, tall: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    return quarter_turn(0.0, tall, max(radius, 0.024), style, rng, ("multi-turn", "electrohydraulic", "bevel"))


LINEAR: dict[str, Maker] = {
    "diaphragm": _diaphragm, "piston": _piston, "ram": _ram, "motor": _motor, "turning": _turning,
}  # fmt: skip


def _positioner(half: float, tall: float, rng: Rng) -> list[Part]:
    """A positioner on a bracket beside the yoke, with its feedback arm and gauges' pads."""
    way = half + 0.06
    z = 0.55 * tall
    plate = merge([box((0.06, 0.004, 0.08), (0, way - 0.004, z)), box((0.004, 0.08, 0.05), (0.028, way - 0.045, z))])
    if rng.random() < 0.5:
        case = merge([box((0.12, 0.08, 0.11), (0, way + 0.038, z)), box((0.10, 0.02, 0.09), (0, way + 0.085, z))])
    else:
        case = along("y", turned([(0.055, 0.0), (0.06, 0.02), (0.06, 0.075), (0.045, 0.09)], 20), 0, way - 0.003, z)
    arm = rod((0, 0.01, z + 0.01), (0, way, z + 0.01), 0.004, 6)
    tube_ = rope(
        [(-0.04, way + 0.03, z + 0.04), (-0.04, way + 0.03, tall + 0.02), (-0.02, 0.5 * half, tall + 0.03)], 0.003, 6
    )
    return [
        Part(plate, "bracket", "steel", "actuator", "Connection assembly"),
        Part(merge([case, arm, tube_]), "actuator", "electrical", "actuator"),
    ]


def _scale(half: float, tall: float) -> Part:
    """The travel scale on a yoke's arm with its pointer on the stem."""
    lines = [box((0.003, 0.022, 0.0015), (0, 0.6 * half, z)) for z in np.linspace(0.35, 0.65, 6) * tall]
    plate = box((0.002, 0.025, 0.4 * tall), (0.003, 0.6 * half, 0.5 * tall))
    pointer: Solid = box((0.004, 0.6 * half, 0.004), (0.006, 0.3 * half, 0.5 * tall))
    return Part(
        merge([plate, pointer, *[moved(line, at(0.004)) for line in lines]]), "position indicator", "dial", BODY
    )


def linear(
    x: float, z: float, radius: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = ()
) -> list[Part]:
    """A yoke with one of some linear actuators on it, maybe a positioner and a travel scale.

    Args:
        x: of the stem [m].
        z: of the bonnet's top [m].
        radius: of the pipe, which everything is scaled by [m].
        style: that models it.
        rng: of its proportions.
        kinds: of ``LINEAR`` to draw from; all by default.
    """
    kind = str(rng.choice(kinds or tuple(LINEAR)))
    half, tall = 0.025 + 0.55 * radius, float(rng.uniform(0.8, 1.3)) * (0.07 + 1.3 * radius)
    slim = 0.004 + 0.07 * radius
    middle = 0.5 * tall
    parts = [yoke_arms(half, tall, style, rng, "actuator"), shaft(-0.01, tall + 0.01, slim, style)]
    coupling = merge(
        [
            box((3.0 * slim, 5.0 * slim, 4 * slim), (0, 0, middle)),
            hexagon(3.5 * slim, middle - 3.5 * slim, middle - 2 * slim),
        ]
    )
    parts.append(Part(coupling, "valve stem", "trim", BODY))
    parts += LINEAR[kind](radius, tall, style, rng)
    if kind in ("diaphragm", "piston") and rng.random() < 0.55:
        parts += _positioner(half, tall, rng)
    if rng.random() < 0.6:
        parts.append(_scale(half, tall))
    return placed(parts, at(x, 0, z) @ spun("z", float(rng.choice([0.0, 0.5, 1.0])) * np.pi))
