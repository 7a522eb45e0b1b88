"""Pumps, compressors and blowers with their motors, on the floor or in a line."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.valve import disc_flange, flanged_body
from cadplants.family import Family, Model, Part, Port
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle, section_channel
from cadplants.primitives import along, around, ball, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import FLANGES, PIPES, smaller
from cadplants.transforms import at, looking, spun
from cadplants.valve_body import bore_of

__all__ = ["ROTATING", "motor_parts"]

_GROUP = "Pump unit"
CASING = "pump casing"


def motor_parts(
    r: float, length: float, style: ModelingStyle, rng: np.random.Generator, pose: Floats, feet: float = 0.0
) -> list[Part]:
    """An electric motor (IEC 60072 proportions) about z from 0, its fan end up, laid by a pose.

    Args:
        r: radius over the fins [m].
        length: with the fan cover [m].
        style: that models it.
        rng: fins or smooth, where the terminal box sits, lifting eye.
        pose: of the shaft's end, z along the motor; its x axis is up where the motor lies.
        feet: height of the axis over the floor; 0 for a flange-mounted motor [m].
    """
    n = style.round(r)
    fins = int(rng.choice([0, 16, 24, 36])) if style.round(r) >= 12 else int(rng.choice([0, 0, 16]))
    body_low, body_high = 0.10 * length, 0.78 * length
    core = cylinder(0.86 * r if fins else r, body_low, body_high, n)
    solids = [core, turned([(0.45 * r, 0.0), (0.95 * r, 0.03 * length), (0.95 * r, 0.11 * length)], n)]
    if fins:
        fin = box(
            (0.16 * r, max(0.002, 0.03 * r), 0.92 * (body_high - body_low)), (0.92 * r, 0, (body_low + body_high) / 2)
        )
        solids.append(around(fin, fins, 0.0, np.pi / fins))
    body = merge(solids)
    hood = turned([(1.0 * r, 0.765 * length), (1.0 * r, 0.95 * length), (0.85 * r, length)], n)
    if rng.random() < 0.3 and style.round(r) >= 12:
        hood = merge([hood, *(torus(0.2 * k * r, 0.006 * r + 0.001, n, 4) for k in (1, 2, 3))])
        hood = merge(
            [
                turned([(1.0 * r, 0.765 * length), (1.0 * r, 0.97 * length)], n),
                *(moved(torus(0.25 * k * r, 0.02 * r, n, 4), at(0, 0, 0.985 * length)) for k in (1, 2, 3)),
            ]
        )
    side = (0.95 * r, 0.7 * r, 0.30 * length)
    turn = spun("z", float(rng.choice([0.0, 0.0, 0.5, -0.5])) * np.pi)
    terminal = moved(
        merge(
            [
                box((0.45 * r, side[1], side[2]), (1.08 * r, 0, 0.36 * length)),
                box((0.08 * r, 1.1 * side[1], 1.08 * side[2]), (1.32 * r, 0, 0.36 * length)),
            ]
        ),
        turn,
    )
    parts = [
        Part(body, "motor", "motor", "motor"),
        Part(hood, "motor fan cover", "motor", "motor"),
        Part(terminal, "terminal box", "motor", "motor"),
        Part(cylinder(0.16 * r, -0.3 * length, 0.02 * length, 12), "shaft", "trim", "motor"),
    ]
    if feet:
        foot = [
            box((feet - 0.6 * r, 1.9 * r, 0.1 * length), (-(feet + 0.6 * r) / 2, 0, z * length)) for z in (0.2, 0.66)
        ]
        parts.append(Part(merge(foot), "motor", "motor", "motor"))
    if rng.random() < 0.4:
        eye = moved(torus(0.14 * r, 0.035 * r, 12, 6), at(1.1 * r, 0, 0.62 * length) @ spun("x", np.pi / 2))
        parts.append(Part(eye, "lifting lug", "fastener", "motor", "Tank", True))
    return [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]


def _base(length: float, width: float, height: float, x: float, rng: np.random.Generator) -> Part:
    """A base plate: a block, a tray, or two channels under a plate."""
    kind = int(rng.integers(3)) if height > 0.05 else 0
    if kind == 0:
        solid = moved(extrude(rounded_rectangle(length, width, 0.02, 3), 0.0, height), at(x))
    elif kind == 1:
        solid = merge(
            [
                box((length, width, 0.012), (x, 0, height - 0.006)),
                *(box((length, 0.012, height), (x, s * (width / 2 - 0.006), height / 2)) for s in (-1, 1)),
            ]
        )
    else:
        rail = extrude(section_channel(height - 0.012, 0.4 * height + 0.01, 0.006, 0.008), -length / 2, length / 2)
        rail = Solid(rail.vertices[:, [2, 0, 1]], rail.faces)
        rails = [
            moved(rail, at(x, -width / 2, (height - 0.012) / 2)),
            moved(rail, at(x, width / 2, (height - 0.012) / 2) @ spun("z", np.pi)),
        ]
        solid = merge([box((length, width, 0.012), (x, 0, height - 0.006)), *rails])
    return Part(solid, "pump base", "steel")


def _ports(
    suction: tuple[float, float, float],
    way: tuple[float, float, float],
    dn: int,
    discharge: tuple[float, float, float],
    up: tuple[float, float, float],
    out: int,
) -> tuple[Port, Port]:
    return Port(looking(suction, way), dn), Port(looking(discharge, up), out)


def _end_suction(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A close-coupled or frame-mounted end-suction pump (EN 733): volute, discharge up, motor behind, guard."""
    out = smaller(dn)
    s = (PIPES[dn].outer / 0.0889) ** 0.6
    r, half = 0.13 * s * float(rng.uniform(0.85, 1.2)), 0.045 * s
    base = float(rng.choice([0.02, 0.08, 0.12]))
    axis = base + 0.17 * s
    n = style.round(r)
    shape = [(0.7 * r, -half), (r, -0.6 * half), (r, 0.6 * half), (0.75 * r, half), (0.6 * r, 1.5 * half)]
    volute = along("x", turned(shape, n), 0, 0, axis)
    reach, rise = 0.11 * s + 0.03, 0.2 * s + 0.03
    suction = moved(along("x", disc_flange(dn, style, reach)), at(-reach, 0, axis))
    offset = float(rng.choice([0.0, 0.55])) * r
    discharge = moved(along("-z", disc_flange(out, style, rise - 0.3 * r)), at(0, offset, axis + rise))
    parts = [Part(merge([volute, suction, discharge]), CASING, "pump", CASING)]
    motor, length = 0.1 * s, 0.34 * s
    close = bool(rng.random() < 0.4)
    start = 1.5 * half
    if close:
        lantern = along(
            "x",
            turned([(0.75 * r, 0.0), (0.8 * motor, 0.25 * length), (0.95 * motor, 0.3 * length)], n),
            start,
            0,
            axis,
        )
        parts.append(Part(lantern, CASING, "pump", CASING))
        far = start + 0.3 * length
    else:
        bracket = along(
            "x",
            turned(
                [
                    (0.55 * r, 0),
                    (0.4 * r, 0.1 * length),
                    (0.35 * r, 0.6 * length),
                    (0.42 * r, 0.62 * length),
                    (0.42 * r, 0.7 * length),
                ],
                n,
            ),
            start,
            0,
            axis,
        )
        parts.append(Part(bracket, CASING, "pump", CASING))
        mid = start + 0.7 * length
        hub = along(
            "x",
            merge(
                [cylinder(0.3 * motor, 0, 0.15 * length, n), cylinder(0.42 * motor, 0.04 * length, 0.11 * length, n)]
            ),
            mid + 0.05 * length,
            0,
            axis,
        )
        parts.append(Part(hub, "shaft", "trim", CASING))
        if rng.random() < 0.75:
            g = 0.62 * motor
            a = np.linspace(0, np.pi, 13)
            outer = np.vstack(
                [[(g, -(axis - base))], g * np.column_stack([np.cos(a), np.sin(a)]), [(-g, -(axis - base))]]
            )
            outline = np.vstack([outer, outer[::-1] * np.array([0.97, 1.0]) - (0, 0.0)])
            inner = np.vstack(
                [
                    [(0.96 * g, -(axis - base))],
                    0.96 * g * np.column_stack([np.cos(a), np.sin(a)]),
                    [(-0.96 * g, -(axis - base))],
                ]
            )
            outline = np.vstack([outer, inner[::-1]])
            guard = Solid(*(lambda e: (e.vertices[:, [2, 0, 1]], e.faces))(extrude(outline, 0.0, 0.22 * length)))
            parts.append(Part(moved(guard, at(mid + 0.01 * length, 0, axis)), "coupling guard", "safety"))
        far = mid + 0.27 * length
    feet = axis - base
    pose = at(far, 0, axis) @ spun("y", np.pi / 2) @ spun("z", np.pi)
    parts += motor_parts(motor, length, style, rng, pose, feet)
    foot = box((1.2 * half, 1.1 * r, axis - base - 0.7 * r), (0, 0, base + (axis - base - 0.7 * r) / 2))
    if axis - base > 0.75 * r:
        parts.append(Part(foot, CASING, "pump", CASING))
    end = far + length
    parts.append(_base(end + 0.7 * r, 2.3 * max(motor, 0.8 * r), base, (end - 0.5 * r) / 2, rng))
    if rng.random() < 0.5:
        bolt = merge([cylinder(0.008, base - 0.01, base + 0.03, 8), hexagon(0.024, base, base + 0.014)])
        for sx, sy in ((0.1, 1), (0.1, -1), (0.9, 1), (0.9, -1)):
            parts.append(
                Part(
                    moved(bolt, at(sx * end, sy * 0.95 * max(motor, 0.8 * r))),
                    "bolt",
                    "fastener",
                    "",
                    "Connection assembly",
                    True,
                )
            )
    return Model(
        parts,
        ports=_ports((-reach, 0, axis), (-1, 0, 0), dn, (0, offset, axis + rise), (0, 0, 1), out),
        kind="centrifugal pump",
    )


def _inline(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An inline pump: flanges in one axis, the volute between them, the motor upright on a lantern."""
    radius = PIPES[dn].radius
    length = max(0.24, 5.0 * radius + 0.1)
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
    x, r = length / 2, float(rng.uniform(1.5, 2.0)) * radius + 0.03
    n = style.round(r)
    volute = turned(
        [
            (0.7 * r, -0.8 * radius - 0.01),
            (r, -0.5 * radius),
            (r, 0.7 * radius),
            (0.85 * r, radius + 0.01),
            (0.85 * r, radius + 0.03),
        ],
        n,
    )
    parts = [Part(merge([body, moved(volute, at(x, 0.15 * r))]), CASING, "pump", CASING)]
    z = radius + 0.03
    motor = 0.8 * r + 0.01
    lantern = turned([(0.85 * r, z), (0.55 * r, z + 0.4 * r), (0.9 * motor, z + 0.9 * r)], n)
    parts.append(Part(moved(lantern, at(x, 0.15 * r)), CASING, "pump", CASING))
    parts += motor_parts(motor, float(rng.uniform(2.4, 3.2)) * motor, style, rng, at(x, 0.15 * r, z + 0.9 * r))
    return Model(parts, round(length, 6), kind="inline pump")


def _circulator(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wet-rotor circulator: a small volute in the line, a round motor can to the side with a square control box."""
    radius = PIPES[dn].radius
    length = 0.13 + 2.5 * radius
    r = 0.035 + 1.1 * radius
    n, x = style.round(r), length / 2
    pipe_ = along(
        "x",
        turned(
            [
                (1.5 * radius, 0.0),
                (1.5 * radius, 0.12 * length),
                (1.1 * radius, 0.14 * length),
                (1.1 * radius, 0.86 * length),
                (1.5 * radius, 0.88 * length),
                (1.5 * radius, length),
            ],
            n,
            bore=bore_of(dn, style),
        ),
    )
    volute = along("y", turned([(0.8 * r, -0.5 * r), (r, -0.3 * r), (r, 0.35 * r)], n), x)
    can = along("y", turned([(0.95 * r, 0.35 * r), (0.85 * r, 0.5 * r), (0.8 * r, 1.8 * r), (0.7 * r, 1.95 * r)], n), x)
    control = (
        box((1.4 * r, 0.8 * r, 1.3 * r), (x, 1.9 * r, 0.1 * r))
        if rng.random() < 0.6
        else box((r, 0.9 * r, 0.7 * r), (x, r, 1.1 * r))
    )
    return Model(
        [
            Part(merge([pipe_, volute]), CASING, "pump", CASING),
            Part(can, "motor", "handle", "motor"),
            Part(control, "terminal box", "rubber", "motor"),
        ],
        round(length, 6),
        "welded",
        "circulator",
    )


def _multistage(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vertical multistage pump: a foot with two flanges in line, a slim barrel with tie rods, lantern, motor."""
    radius = PIPES[dn].radius
    r = 1.9 * radius + 0.04
    n = style.round(r)
    tall = float(rng.uniform(0.3, 0.9))
    centre, reach = 0.06 + 1.2 * radius + 0.3 * FLANGES[dn].outer, 0.12 + 2.4 * radius
    body = moved(
        flanged_body(
            dn, style, 2 * reach, [(0.485 * FLANGES[dn].hub, 0.5 * reach), (0.485 * FLANGES[dn].hub, 1.5 * reach)]
        ),
        at(-reach, 0, centre),
    )
    foot = turned([(1.5 * r, 0.0), (1.5 * r, 0.02), (1.05 * r, 0.04), (1.05 * r, centre + 0.06)], n)
    low = centre + 0.06
    barrel = cylinder(0.85 * r, low, low + tall, n)
    rods = around(cylinder(0.006, low - 0.02, low + tall + 0.02, 8), 4, 0.97 * r, np.pi / 4)
    head = turned([(1.1 * r, low + tall), (1.1 * r, low + tall + 0.04)], n)
    z = low + tall + 0.04
    motor = 1.15 * r
    posts = [box((0.25 * r, 0.9 * r, 0.9 * r), (s * 0.75 * r, 0, z + 0.45 * r)) for s in (-1, 1)]
    plate = cylinder(motor, z + 0.9 * r, z + 0.9 * r + 0.015, n)
    parts = [
        Part(merge([body, foot]), CASING, "pump", CASING),
        Part(barrel, CASING, "trim", CASING),
        Part(rods, "stud", "fastener", CASING, "Connection assembly", True),
        Part(merge([head, *posts, plate]), CASING, "pump", CASING),
        Part(cylinder(0.2 * r, z, z + 0.9 * r, 10), "shaft", "trim", CASING),
    ]
    if rng.random() < 0.6:
        a = np.linspace(0.3, np.pi - 0.3, 9)
        sheet = np.vstack(
            [
                0.7 * r * np.column_stack([np.cos(a), np.sin(a)]),
                0.67 * r * np.column_stack([np.cos(a), np.sin(a)])[::-1],
            ]
        )
        parts.append(Part(moved(extrude(sheet, z + 0.1 * r, z + 0.8 * r), spun("z", 0.0)), "coupling guard", "safety"))
    parts += motor_parts(motor, float(rng.uniform(2.2, 3.0)) * motor, style, rng, at(0, 0, z + 0.9 * r + 0.013))
    return Model(
        parts,
        ports=_ports((-reach, 0, centre), (-1, 0, 0), dn, (reach, 0, centre), (1, 0, 0), dn),
        kind="multistage pump",
    )


def _gear(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gear or lobe pump: an oblong block with ports on both sides, a shaft to a geared motor on a base."""
    radius = PIPES[dn].radius
    s, base = 1.6 * radius + 0.05, 0.08
    axis = base + 1.5 * s
    oval = rounded_rectangle(1.6 * s, 2.6 * s, 0.75 * s, 6)
    block = along("x", extrude(oval, -0.8 * s, 0.8 * s), 0, 0, axis)
    cover = along("x", extrude(0.9 * oval, -1.1 * s, 1.05 * s), 0, 0, axis)
    reach = 1.5 * s + 0.05
    heads = [
        moved(along("y", disc_flange(dn, style, reach)), at(0, -reach, axis)),
        moved(along("-y", disc_flange(dn, style, reach)), at(0, reach, axis)),
    ]
    bolts = along(
        "x",
        merge(
            [
                moved(hexagon(0.3 * s, 1.05 * s, 1.15 * s), at(sx * 0.55 * s, sy * s))
                for sx in (-1, 1)
                for sy in (-1, 0, 1)
            ]
        ),
        0,
        0,
        axis,
    )
    shaft = along("x", cylinder(0.2 * s, 1.0 * s, 2.4 * s, 12), 0, 0, axis)
    coupling = along(
        "x", merge([cylinder(0.5 * s, 1.6 * s, 1.95 * s, 14), cylinder(0.5 * s, 2.0 * s, 2.35 * s, 14)]), 0, 0, axis
    )
    gearbox = merge(
        [
            box((1.4 * s, 1.6 * s, 2.0 * s), (3.3 * s, 0, axis)),
            along("x", cylinder(0.7 * s, 2.4 * s, 2.7 * s, 14), 0, 0, axis),
        ]
    )
    motor, length = 0.9 * s, 3.0 * s
    parts = [
        Part(merge([block, cover, *heads]), CASING, "pump", CASING),
        Part(bolts, "bolt", "fastener", CASING, "Connection assembly", True),
        Part(merge([shaft, coupling]), "shaft", "trim", CASING),
        Part(gearbox, "motor", "motor", "motor"),
        *motor_parts(
            motor, length, style, rng, at(3.95 * s, 0, axis) @ spun("y", np.pi / 2) @ spun("z", np.pi), axis - base
        ),
        Part(box((1.2 * s, 1.2 * s, axis - base - s), (0, 0, base + (axis - base - s) / 2)), "pump base", "steel"),
        Part(
            box((1.2 * s, 1.2 * s, axis - base - 0.95 * s), (3.3 * s, 0, base + (axis - base - 0.95 * s) / 2)),
            "pump base",
            "steel",
        ),
        _base(8.5 * s, 2.6 * s, base, 3.0 * s, rng),
    ]
    return Model(
        parts, ports=_ports((0, -reach, axis), (0, -1, 0), dn, (0, reach, axis), (0, 1, 0), dn), kind="gear pump"
    )


def _diaphragm(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An air-operated double-diaphragm pump: two round chambers, manifolds above and below, feet."""
    radius = PIPES[dn].radius
    r = 2.4 * radius + 0.06
    n, gap = style.round(r), 0.45 * r
    axis = 1.35 * r + 0.04
    chamber = turned([(0.25 * r, 0.55 * r), (0.75 * r, 0.35 * r), (r, 0.12 * r), (r, 0.0)][::-1], n)
    sides = [along(a, moved(chamber, at(0, 0, gap)), 0, 0, axis) for a in ("x", "-x")]
    middle = merge([box((2 * gap, 0.9 * r, 0.9 * r), (0, 0, axis)), box((0.6 * gap, 1.3 * r, 0.4 * r), (0, 0, axis))])
    rims = [along(a, cylinder(1.08 * r, gap - 0.06 * r, gap + 0.06 * r, n), 0, 0, axis) for a in ("x", "-x")]
    pipes = []
    for z in (axis - 1.15 * r, axis + 1.15 * r):
        reach = gap + 0.4 * r
        pipes.append(along("x", cylinder(1.1 * radius, -reach, reach, n), 0, 0, z))
        pipes += [
            rod((s * reach, 0, z), (s * reach, 0, axis + (0.6 * r if z > axis else -0.6 * r)), 1.1 * radius, n)
            for s in (-1, 1)
        ]
        pipes += [moved(ball(1.15 * radius, n), at(s * reach, 0, z)) for s in (-1, 1)]
    front = 0.6 * r + 0.05
    heads = [
        moved(along("y", disc_flange(dn, style, front)), at(0, -front, z)) for z in (axis - 1.15 * r, axis + 1.15 * r)
    ]
    feet = [box((0.25 * r, 0.9 * r, 0.03), (s * (gap + 0.2 * r), 0, 0.015)) for s in (-1, 1)]
    legs = [box((0.15 * r, 0.15 * r, axis - r), (s * (gap + 0.2 * r), 0, (axis - r) / 2)) for s in (-1, 1)]
    clamps = [
        along(a, around(hexagon(0.12 * r, gap - 0.1 * r, gap + 0.1 * r), 8, 1.04 * r), 0, 0, axis) for a in ("x", "-x")
    ]
    parts = [
        Part(merge([*sides, *rims]), CASING, "pump", CASING),
        Part(middle, CASING, "steel", CASING),
        Part(merge([*pipes, *heads]), CASING, "trim", CASING),
        Part(merge([*feet, *legs]), "pump base", "steel"),
        Part(merge(clamps), "bolt", "fastener", CASING, "Connection assembly", True),
    ]
    return Model(
        parts,
        ports=_ports((0, -front, axis - 1.15 * r), (0, -1, 0), dn, (0, -front, axis + 1.15 * r), (0, -1, 0), dn),
        kind="diaphragm pump",
    )


def _dosing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dosing pump: a box with a keypad, a round head aside with small valves above and below, thin tubes."""
    s = float(rng.uniform(0.8, 1.3))
    case = extrude(rounded_rectangle(0.2 * s, 0.12 * s, 0.02, 3), 0.02, 0.17 * s)
    foot = box((0.22 * s, 0.14 * s, 0.02), (0, 0, 0.01))
    head = along(
        "x",
        merge(
            [
                cylinder(0.045 * s, 0.1 * s, 0.145 * s, style.round(0.045)),
                around(hexagon(0.012, 0.14 * s, 0.15 * s), 4, 0.035 * s, 0.78),
            ]
        ),
        0,
        0,
        0.09 * s,
    )
    valves = merge([hexagon(0.025 * s, 0.01 * s, 0.045 * s), hexagon(0.025 * s, 0.135 * s, 0.17 * s)])
    tubes = rope([(0.122 * s, 0, 0.16 * s), (0.122 * s, 0, 0.24 * s), (0.2 * s, 0, 0.3 * s)], 0.005, 8)
    knob = moved(cylinder(0.02 * s, 0.17 * s, 0.19 * s, 14), at(-0.04 * s))
    panel = box((0.1 * s, 0.004, 0.06 * s), (-0.01, -0.061 * s, 0.1 * s))
    return Model(
        [
            Part(merge([case, knob, panel]), "motor", "pump", "motor"),
            Part(merge([head, moved(valves, at(0.122 * s)), tubes]), CASING, "trim", CASING),
            Part(foot, "pump base", "rubber"),
        ],
        kind="dosing pump",
    )


def _submersible(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A submersible pump: a volute on feet, the motor upright above, discharge elbow, handle, cable."""
    radius = PIPES[dn].radius
    r = 2.0 * radius + 0.05
    n, tall = style.round(r), float(rng.uniform(1.8, 3.0)) * r
    feet = around(box((0.15 * r, 0.15 * r, 0.12 * r), (0, 0, 0.06 * r)), 3, 0.8 * r)
    volute = turned([(1.0 * r, 0.1 * r), (1.25 * r, 0.2 * r), (1.25 * r, 0.7 * r), (0.85 * r, 0.85 * r)], n)
    can = turned(
        [(0.8 * r, 0.8 * r), (0.8 * r, 0.8 * r + tall), (0.65 * r, 0.95 * r + tall), (0.3 * r, 1.0 * r + tall)], n
    )
    reach = 1.3 * r + 0.25 * r
    elbow = rope(
        [(1.0 * r, 0, 0.45 * r), (reach, 0, 0.45 * r), (reach + 0.3 * r, 0, 0.75 * r), (reach + 0.3 * r, 0, 1.3 * r)],
        1.05 * radius,
        n,
    )
    top = 1.3 * r + plate_thickness(dn)
    head = moved(disc_flange(dn, style, plate_thickness(dn)), at(reach + 0.3 * r, 0, top) @ spun("x", np.pi))
    handle = rope(
        [
            (-0.4 * r, 0, 0.95 * r + tall),
            (-0.4 * r, 0, 1.25 * r + tall),
            (0.4 * r, 0, 1.25 * r + tall),
            (0.4 * r, 0, 0.95 * r + tall),
        ],
        0.05 * r,
        8,
    )
    cable = rope(
        [(0, 0.3 * r, r + tall - 0.05 * r), (0, 0.4 * r, 1.5 * r + tall), (0.2 * r, 1.2 * r, 2.2 * r + tall)], 0.008, 8
    )
    parts = [
        Part(merge([feet, volute, elbow, head]), CASING, "pump", CASING),
        Part(merge([can, handle]), "motor", "motor", "motor"),
        Part(cable, "cable", "rubber", "", "Electrical and safety"),
    ]
    return Model(parts, ports=(Port(looking((reach + 0.3 * r, 0, top), (0, 0, 1)), dn),), kind="submersible pump")


def _impeller(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An impeller laid out beside a pump: two shrouds or one, curved vanes, a hub; on a shaft."""
    r = float(rng.uniform(0.05, 0.2))
    n = style.round(r)
    disc = ring(0.12 * r, r, 0.0, 0.05 * r, n)
    a = np.linspace(0, 1.2, 7)
    line = np.column_stack([(0.3 + 0.68 * a / 1.2) * r * np.cos(a), (0.3 + 0.68 * a / 1.2) * r * np.sin(a)])
    vane = extrude(
        np.vstack([line, line[::-1] @ np.array([[np.cos(0.08), np.sin(0.08)], [-np.sin(0.08), np.cos(0.08)]])]),
        0.045 * r,
        0.25 * r,
    )
    wheel_ = merge([disc, around(vane, int(rng.integers(4, 8))), ring(0.12 * r, 0.28 * r, 0.0, 0.35 * r, n)])
    if rng.random() < 0.4:
        wheel_ = merge([wheel_, ring(0.45 * r, r, 0.25 * r, 0.3 * r, n)])
    shaft = turned([(0.11 * r, -0.9 * r), (0.11 * r, 0.4 * r), (0.08 * r, 0.4 * r), (0.08 * r, 0.5 * r)], max(8, n))
    step = turned([(0.16 * r, -2.5 * r), (0.16 * r, -0.9 * r), (0.13 * r, -0.9 * r), (0.13 * r, -0.1 * r)], max(8, n))
    lift = at(0, 0, r) @ spun("y", np.pi / 2)
    rest = box((0.3 * r, 0.6 * r, 0.84 * r), (-1.8 * r, 0, 0.42 * r))
    return Model(
        [
            Part(moved(wheel_, lift), "impeller", "trim"),
            Part(moved(merge([shaft, step]), lift), "shaft", "trim"),
            Part(rest, "pump base", "steel"),
        ],
        kind="centrifugal pump",
    )


def _compressor(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A piston compressor on its air receiver, or a screw compressor's cabinet with grilles."""
    eq = "compressor"
    if rng.random() < 0.55:
        r = float(rng.uniform(0.18, 0.32))
        length, n = float(rng.uniform(3.0, 4.5)) * r, style.round(r)
        axis = r + 0.14
        vessel = along(
            "x",
            merge(
                [
                    cylinder(r, -length / 2, length / 2, n),
                    moved(dome(r, 0.35 * r, 0.0, n), at(0, 0, length / 2)),
                    moved(dome(r, 0.35 * r, 0.0, n), at(0, 0, -length / 2) @ spun("x", np.pi)),
                ]
            ),
            0,
            0,
            axis,
        )
        legs = [
            box((0.05, 0.25 * r, 0.16 + 0.2 * r), (sx * 0.4 * length, sy * 0.6 * r, (0.16 + 0.2 * r) / 2))
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
        deck = box((0.8 * length, 1.2 * r, 0.02), (0, 0, axis + r + 0.02))
        z = axis + r + 0.03
        crank = box((0.5 * r, 0.6 * r, 0.7 * r), (-0.25 * length, 0, z + 0.35 * r))
        heads = [
            moved(
                merge(
                    [
                        cylinder(0.25 * r, 0, 0.8 * r, 14),
                        *(cylinder(0.34 * r, 0.15 * r * k, 0.15 * r * k + 0.05 * r, 14) for k in range(1, 6)),
                    ]
                ),
                at(-0.25 * length, 0, z + 0.6 * r) @ spun("x", t),
            )
            for t in (-0.5, 0.5)
        ]
        fly = along("y", ring(0.3 * r, 0.75 * r, 0.0, 0.12 * r, n), -0.25 * length, 0.35 * r, z + 0.45 * r)
        parts = [
            Part(vessel, eq, "tank", eq),
            Part(merge([*legs, deck]), eq, "steel", eq),
            Part(merge([crank, *heads]), eq, "pump", eq),
            Part(fly, eq, "trim", eq),
        ]
        parts += [
            Part(p.solid, p.name, p.color, "motor", _GROUP if p.name != "lifting lug" else "Tank", p.fine)
            for p in motor_parts(
                0.4 * r,
                1.1 * r,
                style,
                rng,
                at(0.25 * length, 0.3 * r, z + 0.4 * r) @ spun("x", np.pi / 2) @ spun("z", np.pi / 2),
            )
        ]
        return Model(parts, kind="compressor")
    w, d, h = (float(rng.uniform(*span)) for span in ((1.0, 2.2), (0.7, 1.1), (1.0, 1.8)))
    case = box((w, d, h - 0.1), (0, 0, 0.1 + (h - 0.1) / 2))
    skid = [box((w, 0.1, 0.1), (0, s * (d / 2 - 0.05), 0.05)) for s in (-1, 1)]
    slots = merge([box((0.35 * w, 0.01, 0.012), (0.25 * w, -d / 2 - 0.004, 0.5 * h + 0.03 * k)) for k in range(8)])
    door = box((0.45 * w, 0.015, 0.8 * h), (-0.24 * w, -d / 2 - 0.007, 0.1 + 0.42 * h))
    panel = box((0.2, 0.03, 0.15), (-0.24 * w, -d / 2 - 0.02, 0.75 * h))
    hood = box((0.4 * w, 0.5 * d, 0.12), (0.2 * w, 0, h + 0.06))
    return Model(
        [
            Part(merge([case, hood]), eq, "motor", eq),
            Part(merge(skid), eq, "steel", eq),
            Part(merge([slots, door]), eq, "electrical", eq),
            Part(panel, "control panel", "rubber", "", "Electrical and safety"),
        ],
        kind="compressor",
    )


def _blower(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A radial fan: a spiral housing with an inlet cone and a square outlet, its motor on a frame; or an axial fan."""
    eq, r = "blower", float(rng.uniform(0.2, 0.45))
    n = style.round(r)
    wide = float(rng.uniform(0.35, 0.7)) * r
    axis = 1.45 * r + 0.05
    a = np.linspace(0, 2 * np.pi, max(14, n), endpoint=False)
    spiral = (0.85 + 0.5 * a / (2 * np.pi))[:, None] * r * np.column_stack([np.cos(a), np.sin(a)])
    scroll = np.vstack([spiral, [(1.4 * r, -0.9 * r)]])
    scroll = np.vstack([spiral, [(1.35 * r, 0.0)]]) if False else spiral
    house = extrude(scroll, -wide / 2, wide / 2)
    outlet = box((0.5 * r, 0.9 * r, wide), (1.08 * r, 0.42 * r, 0))
    lip = box((0.6 * r, 0.03, 1.12 * wide), (1.08 * r, 0.88 * r, 0))
    cone = moved(
        turned([(0.5 * r, 0), (0.62 * r, 0.25 * r), (0.66 * r, 0.25 * r), (0.66 * r, 0.28 * r)], n),
        at(0, 0, wide / 2 - 0.01),
    )
    stand = at(0, 0, axis) @ spun("x", np.pi / 2)
    frame = merge(
        [box((0.08, 1.2 * r + wide, 0.06), (s * 0.6 * r, 0.4 * r, 0.03)) for s in (-1, 1)]
        + [box((0.06, 0.06, axis - 0.3 * r), (s * 0.6 * r, 0.5 * wide + 0.1, (axis - 0.3 * r) / 2)) for s in (-1, 1)]
    )
    plate = box((1.3 * r, 0.8 * r, 0.02), (0, 0.5 * wide + 0.45 * r, axis - 0.3 * r))
    parts = [
        Part(moved(merge([house, outlet, lip, cone]), stand), eq, "motor", eq),
        Part(merge([frame, plate]), eq, "steel", eq),
    ]
    pose = at(0, 0.5 * wide + 0.02, axis) @ spun("x", -np.pi / 2) @ spun("z", -np.pi / 2)
    parts += [
        Part(p.solid, p.name, p.color, "motor", _GROUP if p.name != "lifting lug" else "Tank", p.fine)
        for p in motor_parts(0.28 * r, 0.8 * r, style, rng, pose)
    ]
    return Model(parts, kind="blower")


def _family(
    name: str,
    build: object,
    sizes: tuple[int, ...],
    place: str = "floor",
    group: str = _GROUP,
    whole: str = "pump",
    weight: float = 1.0,
) -> Family:
    return Family(name, place, group, whole, build, sizes, weight=weight)  # type: ignore[arg-type]


_MID = (40, 50, 65, 80, 100)

ROTATING: tuple[Family, ...] = (
    _family("pump/end suction frame", _end_suction, (40, 50, 65, 80, 100, 125, 150), weight=3),
    _family("pump/inline", _inline, (32, 40, 50, 65, 80, 100), "inline", weight=1.2),
    _family("pump/circulator", _circulator, (20, 25, 32, 40, 50), "inline"),
    _family("pump/multistage", _multistage, _MID, weight=1.5),
    _family("pump/gear", _gear, (25, 32, 40, 50, 65)),
    _family("pump/diaphragm", _diaphragm, (15, 20, 25, 40, 50)),
    _family("pump/dosing", _dosing, (15,)),
    _family("pump/submersible", _submersible, _MID),
    _family("pump/impeller", _impeller, (15,), weight=1.2),
    _family("compressor/packaged", _compressor, (15,), group="Equipment", whole="compressor", weight=1.6),
    _family("blower/radial", _blower, (15,), group="Equipment", whole="blower", weight=1.6),
)
