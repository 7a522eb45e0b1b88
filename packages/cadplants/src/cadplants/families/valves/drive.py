"""What moves a valve, standing on its stem: levers, wheels, gears, chains, actuators."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.family import Part
from cadplants.mesh_ops import Solid, extrude, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.operator import actuator_solids, handwheel, lever_solid, plate_wheel, solid_wheel
from cadplants.plant import Turning
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["QUARTER", "diaphragm_head", "drive", "quarter", "stem", "wheel"]

BODY = "valve body"


def stem(low: float, high: float, radius: float, style: ModelingStyle, x: float = 0.0) -> Part:
    """A stem about z at ``x`` [m]."""
    return Part(cylinder_at(radius, low, high, max(6, min(style.round(radius), 16)), x), "valve stem", "trim", BODY)


def cylinder_at(radius: float, low: float, high: float, sides: int, x: float = 0.0) -> Solid:
    """An upright cylinder at ``x`` [m]."""
    return moved(cylinder(radius, low, high, sides), at(x))


def wheel(radius: float, x: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> Part:
    """A handwheel about z with its hub on the height ``z``: round rim, pressed plate, dished disc, or cast lobes."""
    spokes, hub, thick = int(rng.integers(2, 7)), 0.13 * radius + 0.008, 0.012 + 0.06 * radius
    bore, sides = 0.3 * hub, max(12, style.round(radius))
    kind = rng.random()
    if kind < 0.55:
        rim = radius * float(rng.uniform(0.04, 0.10)) + 0.002
        solid = handwheel(
            round(radius, 6), round(rim, 6), max(3, spokes), round(hub, 6), round(thick, 6), round(bore, 6), sides
        )
    elif kind < 0.7:
        solid = plate_wheel(round(radius, 6), max(3, spokes), round(hub, 6), round(thick, 6), round(bore, 6), sides)
    elif kind < 0.85:
        solid = solid_wheel(round(radius, 6), round(hub, 6), round(thick, 6), round(bore, 6), sides)
    else:
        solid = merge([_lobes(radius, max(4, spokes + 2), thick, style), cylinder(hub, 0, 1.4 * thick, 12)])
    pose = at(x, 0, z) @ spun("z", float(rng.uniform(0, 6)))
    return Part(moved(solid, pose), "handwheel", "handle", turns=Turning("handwheel").placed(pose))


def _lobes(radius: float, count: int, thick: float, style: ModelingStyle) -> Solid:
    """A knob with a wavy edge, as on small valves."""
    angles = np.linspace(0, 2 * np.pi, 6 * count, endpoint=False)
    reach = radius * (0.92 + 0.08 * np.cos(count * angles))
    return extrude(np.column_stack([reach * np.cos(angles), reach * np.sin(angles)]), 0.2 * thick, thick)


def _lever(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A flat lever: cranked, straight, or a sheet with a dipped grip; with or without a notch plate."""
    length = float(rng.uniform(0.9, 1.3)) * (0.10 + 2.2 * radius)
    turn = spun("z", float(rng.choice([0.0, 0.0, 0.5, 1.0])) * np.pi)
    half, thick = 0.008 + 0.22 * radius, 0.004 + 0.02 * radius
    pose = at(x, 0, z) @ turn
    kind = rng.random()
    if kind < 0.35:
        solid = lever_solid(length, half, thick, bool(rng.integers(2)))
    elif kind < 0.7:
        rise = float(rng.uniform(0.1, 0.3)) * length
        path = [(-half, 0, thick / 2), (0.25 * length, 0, thick / 2), (0.4 * length, 0, rise), (length, 0, rise)]
        bar = _strip(path, half, thick)
        grip = _strip([(0.55 * length, 0, rise), (1.02 * length, 0, rise)], 1.15 * half, 2.4 * thick)
        solid = merge([bar, grip])
    else:
        tilt = float(rng.uniform(0.1, 0.5))
        way = np.array([np.cos(tilt), 0, np.sin(tilt)])
        bar = rod((0, 0, 0.5 * half), tuple(way * length + (0, 0, 0.5 * half)), 0.45 * half, 8)
        solid = merge(
            [
                cylinder(1.1 * half, 0, 1.2 * half, 12),
                bar,
                moved(ball(0.8 * half, 10), at(*(way * length)) @ at(0, 0, 0.5 * half)),
            ]
        )
    parts = [Part(moved(solid, pose), "lever", "handle", turns=Turning("lever").placed(pose))]
    if rng.random() < 0.3:
        angles = np.linspace(-0.3, 1.9, 12)
        reach = 0.035 + 1.1 * radius
        sector = np.vstack(
            [
                np.column_stack([np.cos(angles), np.sin(angles)]) * reach,
                [(-0.4 * reach, 0.3 * reach), (-0.4 * reach, -0.3 * reach)],
            ]
        )
        plate = extrude(sector, -0.004, -0.0005)
        parts.append(Part(moved(plate, pose), "position indicator", "trim", BODY))
    return parts


def _strip(path: Sequence[tuple[float, float, float]], half: float, thick: float) -> Solid:
    """A flat bar in the plane y = 0."""
    section = np.array([[half, -thick / 2], [half, thick / 2], [-half, thick / 2], [-half, -thick / 2]])
    return sweep(np.asarray(path, float), section, up=(0.0, 1.0, 0.0))


def _wing(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A butterfly handle: two wings, as on small ball valves."""
    reach, wide = 0.018 + 0.9 * radius, 0.006 + 0.12 * radius
    outline = np.array(
        [
            [-reach, -0.6 * wide],
            [-0.4 * reach, -wide],
            [0.4 * reach, -wide],
            [reach, -0.6 * wide],
            [reach, 0.6 * wide],
            [0.4 * reach, wide],
            [-0.4 * reach, wide],
            [-reach, 0.6 * wide],
        ]
    )
    bar = moved(extrude(outline, -0.003, 0.003), spun("x", np.pi / 2))
    solid = merge([moved(bar, at(0, 0, wide)), cylinder(0.8 * wide, 0, 1.6 * wide, 12)])
    pose = at(x, 0, z) @ spun("z", float(rng.choice([0, 1.5708])))
    return [Part(moved(solid, pose), "lever", "handle", turns=Turning("lever").placed(pose))]


def _bar(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A T bar through the stem's head, as on needle valves."""
    reach, thick = 0.02 + 1.1 * radius, 0.003 + 0.06 * radius
    cross = rod((-reach, 0, thick), (reach, 0, thick), thick, 8)
    knobs = [moved(ball(1.5 * thick, 8), at(sign * reach, 0, thick)) for sign in (-1, 1)]
    pose = at(x, 0, z) @ spun("z", float(rng.uniform(0, 3)))
    return [Part(moved(merge([cross, *knobs]), pose), "lever", "handle", turns=Turning("lever").placed(pose))]


def _gear(
    x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator, chain: bool = False
) -> list[Part]:
    """A worm gear with its shaft to the side and a handwheel or a chain wheel."""
    half = 0.035 + 0.3 * radius
    case = extrude(rounded_rectangle(2 * half, 1.7 * half, 0.35 * half, 4), 0.0, 0.8 * half)
    lid = moved(cylinder(0.7 * half, 0.8 * half, 0.95 * half, style.round(half)), at(0, 0, 0))
    tunnel = along("y", cylinder(0.32 * half, -0.9 * half, 0.9 * half, 12), 0.55 * half, 0, 0.4 * half)
    shaft = along("-y", cylinder(0.14 * half, 0.0, 2.0 * half, 10), 0.55 * half, 0, 0.4 * half)
    pose = at(x, 0, z)
    size = 0.05 + 0.9 * radius
    rim = wheel(size, 0, 0, style, rng).solid
    side = at(0.55 * half, -1.9 * half, 0.4 * half) @ spun("x", np.pi / 2)
    rim = moved(rim, side)
    turns = Turning("gear operator").placed(side).placed(pose)
    parts = [
        Part(moved(merge([case, lid, tunnel]), pose), "gearbox", "valve", "gearbox"),
        Part(moved(shaft, pose), "valve stem", "trim", "gearbox"),
    ]
    if chain:
        outer = moved(around(box((0.3 * size, 0.02, 0.012), (0.1 * size, 0, 0)), 12, size), at(0, 0, 0))
        sheave = moved(
            merge(
                [
                    torus(size, 0.012, max(16, style.round(size))),
                    outer,
                    handwheel(round(size, 6), 0.01, 4, 0.02, 0.02, 0.006, 24),
                ]
            ),
            at(0.55 * half, -1.9 * half, 0.4 * half) @ spun("x", np.pi / 2),
        )
        loop = [
            (0.55 * half + s * (size + 0.01), -1.9 * half, 0.4 * half - d)
            for s, d in ((-1, 0.0), (-1, 0.7), (-0.6, 0.76), (0.6, 0.76), (1, 0.7), (1, 0.0))
        ]
        links = rope(loop, 0.004, 6)
        parts.append(Part(moved(merge([sheave, links]), pose), "handwheel", "handle", turns=turns))
    else:
        parts.append(Part(moved(rim, pose), "handwheel", "handle", turns=turns))
    if rng.random() < 0.4:
        parts.append(
            Part(
                moved(cylinder(0.25 * half, 0.95 * half, 1.05 * half, 12), pose),
                "position indicator",
                "trim",
                "gearbox",
            )
        )
    return parts


def _pneumatic(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A rack-and-pinion actuator, or a scotch yoke between a cylinder and a spring can; with a switch box."""
    half = 0.028 + 0.45 * radius
    pose = at(x, 0, z + 0.5 * half) @ spun("z", float(rng.choice([0, 1.5708])))
    mount = merge([box((1.6 * half, 0.005, 0.6 * half), (0, s * 0.5 * half, -0.25 * half)) for s in (-1, 1)])
    parts = [Part(moved(mount, pose), "yoke", "steel", BODY)]
    if rng.random() < 0.65:
        block, _ = actuator_solids(round(radius, 6))
        top = 2 * half
        parts.append(Part(moved(block, pose), "actuator", "trim", "actuator"))
    else:
        n, reach, top = style.round(half), 0.08 + 2.0 * radius, 1.8 * half
        housing = box((2.2 * half, 1.6 * half, 1.8 * half), (0, 0, 0.9 * half))
        can = along(
            "x",
            turned(
                [
                    (0.9 * half, 0),
                    (0.9 * half, 0.02),
                    (0.8 * half, 0.02),
                    (0.8 * half, 1.3 * reach),
                    (0.9 * half, 1.3 * reach),
                    (0.9 * half, 1.3 * reach + 0.02),
                ],
                n,
            ),
            1.1 * half,
            0,
            0.9 * half,
        )
        spring = along(
            "-x",
            turned([(0.7 * half, 0), (0.7 * half, reach), (0.5 * half, reach + 0.01)], n),
            -1.1 * half,
            0,
            0.9 * half,
        )
        parts.append(Part(moved(merge([housing, can, spring]), pose), "actuator", "motor", "actuator"))
    if rng.random() < 0.5:
        switch = merge([box((0.09, 0.07, 0.06), (0, 0, top + 0.045)), cylinder(0.008, top, top + 0.02, 8)])
        parts.append(Part(moved(switch, pose), "position indicator", "electrical", "actuator"))
    else:
        parts.append(
            Part(moved(cylinder(0.015, top, top + 0.02, 12), pose), "position indicator", "handle", "actuator")
        )
    return parts


def _electric(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """An electric actuator: housing with a round lid, a motor can aside, a hand wheel, a cable gland."""
    half = 0.04 + 0.35 * radius
    n = style.round(half)
    pose = at(x, 0, z) @ spun("z", float(rng.choice([0, 1.5708, 3.1416])))
    foot = cylinder(0.5 * half, 0.0, 0.5 * half, n)
    case = extrude(rounded_rectangle(2.6 * half, 1.8 * half, 0.4 * half, 3), 0.45 * half, 1.9 * half)
    lid = turned([(0.8 * half, 1.9 * half), (0.8 * half, 2.2 * half), (0.6 * half, 2.35 * half)], n)
    can = along(
        "x", turned([(0.6 * half, 0), (0.6 * half, 1.4 * half), (0.5 * half, 1.5 * half)], n), 1.3 * half, 0, 1.2 * half
    )
    gland = along("-y", hexagon(0.022, 0, 0.025), -0.5 * half, -0.9 * half, half)
    parts = [Part(moved(merge([foot, case, lid, can, gland]), pose), "actuator", "motor", "actuator")]
    if rng.random() < 0.6:
        rim = moved(
            handwheel(
                round(0.7 * half, 6),
                round(0.07 * half, 6),
                3,
                round(0.15 * half, 6),
                round(0.15 * half, 6),
                0.003,
                max(12, n),
            ),
            at(0, 0.95 * half, 1.2 * half) @ spun("x", -np.pi / 2),
        )
        shaft = along("y", cylinder(0.1 * half, 0.85 * half, 1.05 * half, 8), 0, 0, 1.2 * half)
        parts.append(Part(moved(merge([rim, shaft]), pose), "handwheel", "handle"))
    return parts


def diaphragm_head(x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A diaphragm actuator on a yoke (IEC 60534 control valves), maybe with a positioner and its air pipe."""
    head = float(rng.uniform(0.9, 1.3)) * (0.08 + 1.3 * radius)
    tall = 0.08 + 1.4 * radius
    n, pose = style.round(head), at(x, 0, z)
    low = tall
    pan = turned(
        [(0.3 * head, low), (0.75 * head, low + 0.12 * head), (head, low + 0.2 * head), (head, low + 0.26 * head)], n
    )
    cap_ = turned(
        [
            (head, low + 0.265 * head),
            (head, low + 0.32 * head),
            (0.8 * head, low + 0.42 * head),
            (0.3 * head, low + 0.55 * head),
            (0.12 * head, low + 0.6 * head),
        ],
        n,
    )
    arms = [
        box((0.02 + 0.1 * radius, 0.012 + 0.1 * radius, tall), (0, s * (0.02 + 0.45 * radius), tall / 2))
        for s in (-1, 1)
    ]
    collar = cylinder(0.03 + 0.6 * radius, 0, 0.012 + 0.1 * radius, n)
    crown = cylinder(0.03 + 0.6 * radius, tall - 0.012, tall + 0.003, n)
    parts = [
        Part(moved(merge([*arms, collar, crown]), pose), "yoke", "valve", "actuator"),
        Part(moved(merge([pan, cap_]), pose), "actuator", "valve", "actuator"),
        Part(moved(cylinder(0.004 + 0.08 * radius, -0.01, tall, 10), pose), "valve stem", "trim", BODY),
    ]
    screws = max(6, min(16, int(60 * head)))
    bolt = merge(
        [
            cylinder(0.006, low + 0.18 * head, low + 0.34 * head, 6),
            hexagon(0.016, low + 0.32 * head, low + 0.34 * head + 0.006),
        ]
    )
    parts.append(
        Part(
            moved(around(bolt, screws, 0.93 * head), pose), "bolt", "fastener", "actuator", "Connection assembly", True
        )
    )
    if rng.random() < 0.6:
        side = 0.06 + 0.55 * radius
        case = merge(
            [
                box((0.10, 0.07, 0.13), (0, side + 0.04, 0.55 * tall)),
                box((0.08, 0.02, 0.10), (0, side + 0.085, 0.55 * tall)),
            ]
        )
        tube = rope(
            [
                (0, side + 0.04, 0.55 * tall + 0.06),
                (0, side + 0.04, low + 0.1 * head),
                (0, 0.5 * head, low + 0.14 * head),
            ],
            0.004,
            6,
        )
        parts.append(Part(moved(merge([case, tube]), pose), "actuator", "electrical", "actuator"))
    if rng.random() < 0.25:
        top = low + 0.6 * head
        parts += [
            stem(z + top - 0.01, z + top + 0.05, 0.006, style, x),
            wheel(0.5 * head, x, z + top + 0.04, style, rng),
        ]
    return parts


QUARTER = ("lever", "lever", "lever", "wing", "gear", "chain", "pneumatic", "electric")


def quarter(kind: str, x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What turns a valve by a quarter: ``lever``, ``wing``, ``bar``, ``gear``, ``chain``, ``pneumatic``, ``electric``.

    Args:
        kind: of the drive.
        x: of the stem [m].
        z: of the top of the stem's collar [m].
        radius: of the pipe, which everything is scaled by [m].
        style: that models it.
        rng: of its proportions.
    """
    if kind == "gear":
        return _gear(x, z, radius, style, rng)
    if kind == "chain":
        return _gear(x, z, radius, style, rng, chain=True)
    makers = {"lever": _lever, "wing": _wing, "bar": _bar, "pneumatic": _pneumatic, "electric": _electric}
    return makers[kind](x, z, radius, style, rng)


def drive(
    x: float, z: float, radius: float, style: ModelingStyle, rng: np.random.Generator, kinds: tuple[str, ...] = QUARTER
) -> list[Part]:
    """One of some drives at random; small pipes have no gears."""
    kind = str(rng.choice(kinds))
    if radius < 0.02 and kind in ("gear", "chain"):
        kind = "lever"
    if radius > 0.05 and kind == "wing":
        kind = "lever"
    return quarter(kind, x, z, radius, style, rng)
