"""Boilers: fire-tube, water-tube, vertical, on a wall."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.heatware import equipment_family, equipment_mouth
from cadplants.families.vessels.vesselware import head, sides
from cadplants.families.vessels.warmware import wall_behind
from cadplants.family import Family, Model, Part, Port
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["BOILERWARE"]

_FRAME, _PIPE, _BOIL = "Structural element", "Pipe assembly", "boiler"


def _walkway(r: float, length: float, z: float) -> list[Part]:
    """A walkway along a drum on arms, with a railing outside."""
    y = 0.75 * r + 0.58
    deck = box((0.8 * length, 0.6, 0.03), (0, 0.75 * r + 0.3, z))
    arms = [box((0.05, 0.3 * r + 0.55, 0.06), (x, 0.6 * r + 0.25, z - 0.045)) for x in (-0.3 * length, 0.3 * length)]
    rails = [rod((-0.4 * length, y, z + h), (0.4 * length, y, z + h), 0.018, 6) for h in (0.5, 1.0)]
    rails += [rod((x, y, z), (x, y, z + 1.0), 0.018, 6) for x in (-0.4 * length, 0.0, 0.4 * length)]
    grate = Part(merge([deck, *arms]), "grating", "steel", "", _FRAME)
    return [grate, Part(merge(rails), "railing", "safety", "", _FRAME)]


def _fire_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A shell boiler (EN 12953): a clad drum on a base frame, front door with peephole, smoke box, stack, walkway."""
    r = float(rng.uniform(0.5, 1.0))
    n, length = sides(style, r), r * float(rng.uniform(2.4, 3.6))
    axis, name = r + float(rng.uniform(0.2, 0.35)), _BOIL
    drum = along("x", cylinder(r, -length / 2, length / 2, n), 0, 0, axis)
    bands = [
        along("x", ring(r - 0.01, 1.008 * r + 0.002, x - 0.03, x + 0.03, n), 0, 0, axis)
        for x in np.linspace(-0.35, 0.35, 3) * length
    ]
    front = along(
        "-x",
        turned([(0.92 * r, length / 2), (0.92 * r, length / 2 + 0.18), (0.86 * r, length / 2 + 0.22)], n),
        0,
        0,
        axis,
    )
    x0 = -length / 2 - 0.22
    hinges = [box((0.05, 0.12, 0.1), (x0 + 0.12, 0.95 * r, axis + s * 0.4 * r)) for s in (-1, 1)]
    burner_hole = along("-x", cylinder(0.3 * r, -x0 - 0.02, -x0 + 0.05, n), 0, 0, axis - 0.25 * r)
    back = along("x", turned([(0.95 * r, length / 2 - 0.01), (0.95 * r, length / 2 + 0.2 * r)], n), 0, 0, axis)
    door = along(
        "x",
        ring(0.18 * r, 0.24 * r, length / 2 + 0.2 * r - 0.01, length / 2 + 0.2 * r + 0.03, 20),
        0,
        0,
        axis - 0.4 * r,
    )
    stack_r = 0.2 * r
    stack = moved(
        cylinder(stack_r, axis, axis + r + float(rng.uniform(0.5, 1.6)), style.round(stack_r)),
        at(length / 2 + 0.02 - 0.1 * r),
    )
    parts = [
        Part(merge([drum, *bands]), name, "tank", name),
        Part(merge([front, *hinges, burner_hole]), name, "electrical", name),
        Part(merge([back, door]), name, "electrical", name),
        Part(stack, name, "clamp", name),
    ]
    base = [box((length + 0.1, 0.1, 0.16), (0, s * 0.6 * r, 0.08)) for s in (-1, 1)]
    base += [box((0.1, 1.2 * r, 0.12), (x, 0, 0.06)) for x in (-0.45 * length, 0.45 * length)]
    props = [
        box((0.12, 0.02, axis - 0.8 * r), (x, s * 0.6 * r, (axis - 0.8 * r) / 2 + 0.05))
        for x in (-0.35 * length, 0.0, 0.35 * length)
        for s in (-1, 1)
    ]
    parts.append(Part(merge([*base, *props]), "skid frame", "steel", "", _FRAME))
    ports: list[Port] = []
    for x, dn in ((-0.3, 80), (-0.05, 50), (0.15, 40)):
        some, port = equipment_mouth(name, dn, at(x * length, 0, axis + r), style, r, r * (1 - np.cos(np.pi / n)))
        parts += some
        ports += port
    if rng.random() < 0.6:
        parts += _walkway(r, length, axis + 0.8 * r)
    if rng.random() < 0.6:
        panel = box((0.5, 0.2, 0.7), (-0.25 * length, -r - 0.09, axis + 0.1))
        parts.append(Part(panel, "control panel", "electrical", "", "Electrical and safety"))
    return Model(parts, ports=tuple(ports), kind="fire-tube boiler")


def _wall_hung(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wall-hung boiler: a cabinet with a display, a coaxial flue bent into the wall, five pipes with cocks below."""
    w, h, d = float(rng.uniform(0.38, 0.5)), float(rng.uniform(0.65, 0.9)), float(rng.uniform(0.28, 0.45))
    z, name = float(rng.uniform(1.1, 1.3)), _BOIL
    case = extrude(rounded_rectangle(w, d, float(rng.uniform(0.005, 0.06)), 3), z, z + h)
    panel = box((0.8 * w, 0.012, 0.14), (0, -d / 2 - 0.004, z + 0.12))
    knobs = [along("-y", cylinder(0.02, d / 2, d / 2 + 0.025, 16), x, 0, z + 0.12) for x in (-0.12, 0.12)]
    flue_r, top = 0.05, z + h
    rise = float(rng.uniform(0.1, 0.3))
    flue = rope([(0, 0, top - 0.01), (0, 0, top + rise), (0, d / 2 + 0.1, top + rise)], flue_r, style.round(flue_r))
    rose = along("y", cylinder(1.8 * flue_r, d / 2 - 0.012, d / 2, 20), 0, 0, top + rise)
    parts = [
        Part(case, name, "dial", name),
        Part(merge([panel, *knobs]), name, "electrical", name),
        Part(merge([flue, rose]), name, "dial", name),
        wall_behind(w + 1.0, top + rise + 0.4, d / 2),
    ]
    count = int(rng.integers(3, 6))
    for k in range(count):
        x, r = (k - (count - 1) / 2) * 0.065, float(rng.choice([0.0075, 0.011]))
        drop = float(rng.uniform(0.2, 0.6))
        parts.append(Part(rod((x, 0.25 * d, z - drop), (x, 0.25 * d, z + 0.005), r, 8), "pipe", "pipe", "", _PIPE))
        if rng.random() < 0.6:
            cock = merge([hexagon(0.026, z - 0.12, z - 0.07), rod((0, 0, z - 0.095), (0, -0.05, z - 0.095), 0.005, 6)])
            parts.append(Part(moved(cock, at(x, 0.25 * d)), "valve", "trim", "", "Valve assembly"))
    return Model(parts, kind="wall-hung boiler")


def _vertical(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vertical boiler or bath heater: an upright drum on feet, a fire door and ash door, a hood with the stack."""
    r = float(rng.uniform(0.25, 0.6))
    n, h, low, name = sides(style, r), r * float(rng.uniform(2.6, 4.0)), 0.12, _BOIL
    shell = cylinder(r, low, low + h, n)
    top = (
        dome(r, 0.35 * r, low + h - 0.001, n)
        if rng.random() < 0.6
        else turned([(r, low + h), (0.35 * r, low + h + 0.45 * r)], n)
    )
    stack = cylinder(
        0.26 * r, low + h + 0.2 * r, low + h + 0.35 * r + float(rng.uniform(0.5, 1.3)), style.round(0.26 * r)
    )
    foot = (
        ring(0.8 * r, 1.06 * r, 0.0, low + 0.01, n)
        if rng.random() < 0.5
        else around(box((0.06, 0.06, low + 0.02), (0, 0, (low + 0.02) / 2)), 4, 0.9 * r)
    )
    bands = [ring(r - 0.01, 1.015 * r, z, z + 0.04, n) for z in (low, low + 0.45 * h, low + h - 0.04)]
    doors = []
    for z, w, t in ((low + 0.35 * h, 0.7 * r, 0.5 * r), (low + 0.1 * h, 0.6 * r, 0.25 * r)):
        neck = box((0.35 * r, 1.1 * w, 1.1 * t), (0.92 * r, 0, z))
        leaf = box((0.03, 1.25 * w, 1.25 * t), (1.1 * r, 0, z))
        grip = rod((1.1 * r, -0.5 * w, z), (1.1 * r + 0.06, -0.5 * w, z), 0.01, 6)
        doors.append(merge([neck, leaf, grip]))
    turn = spun("z", -1.2)
    parts = [
        Part(merge([shell, *bands]), name, "tank", name),
        Part(merge([top, stack]), name, "tank", name),
        Part(moved(merge(doors), turn), name, "electrical", name),
        Part(foot, name, "steel", name),
    ]
    ports: list[Port] = []
    for z, a in ((0.85, 1.0), (0.3, 2.6)):
        pose = spun("z", a) @ at(r, 0, low + z * h) @ spun("y", np.pi / 2)
        some, port = equipment_mouth(name, 40 if r > 0.35 else 25, pose, style, r, r * (1 - np.cos(np.pi / n)))
        parts += some
        ports += port
    return Model(parts, ports=tuple(ports), kind="vertical boiler")


def _water_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A water-tube boiler (D type, EN 12952): a steam drum over a mud drum, banks of tubes, a buckstayed casing."""
    w, h, d = float(rng.uniform(1.6, 2.6)), float(rng.uniform(1.4, 2.2)), float(rng.uniform(1.0, 1.6))
    rs, rm, name = 0.2 * h, 0.13 * h, _BOIL
    n = sides(style, rs)
    low, y = 0.25, 0.22 * d
    zm, zs = low + rm, low + h
    drums = []
    for r, z, reach in ((rs, zs, w + 0.3), (rm, zm, w + 0.2)):
        body = along("x", cylinder(r, -reach / 2, reach / 2, n), 0, y, z)
        caps = [moved(head("2:1", r, style, n), at(s * reach / 2, y, z) @ spun("y", s * np.pi / 2)) for s in (-1, 1)]
        drums.append(merge([body, *caps]))
    tubes = []
    for x in np.linspace(-0.46, 0.46, int(rng.integers(10, 18))) * w:
        outer = [(x, y - 0.8 * rs, zs), (x, -d / 2, zs - 0.1 * h), (x, -d / 2, zm + 0.05 * h), (x, y - 0.8 * rm, zm)]
        tubes.append(rope(outer, 0.025, 6))
        tubes += [rod((x, y + s * 0.5 * rm, zm), (x, y + s * 0.5 * rs, zs), 0.022, 6) for s in (-1, 0, 1)]
    parts = [
        Part(drums[0], name, "tank", name),
        Part(drums[1], name, "tank", name),
        Part(merge(tubes), name, "pipe", name),
    ]
    if rng.random() < 0.6:
        case = [box((0.04, d, 0.8 * h), (s * 0.49 * w, 0.0, low + 0.45 * h)) for s in (-1, 1)]
        case.append(box((w, 0.04, 0.8 * h), (0, d / 2, low + 0.45 * h)))
        stays = [box((w + 0.1, 0.08, 0.1), (0, d / 2 + 0.05, low + f * h)) for f in (0.2, 0.6)]
        parts.append(Part(merge([*case, *stays]), name, "clamp", name))
    feet = [box((0.15, 1.4 * rm, low + 0.3 * rm), (x, y, (low + 0.3 * rm) / 2)) for x in (-0.4 * w, 0.4 * w)]
    posts = [box((0.12, 0.12, zs - 0.8 * rs), (s * (0.5 * w + 0.09), y, (zs - 0.8 * rs) / 2)) for s in (-1, 1)]
    parts += [Part(merge(feet), name, "steel", name), *(Part(p, "column", "steel", "", _FRAME) for p in posts)]
    ports: list[Port] = []
    for x, dn in ((-0.25, 80), (0.0, 50), (0.25, 50)):
        some, port = equipment_mouth(name, dn, at(x * w, y, zs + rs), style, rs, 0.02)
        parts += some
        ports += port
    return Model(parts, ports=tuple(ports), kind="water-tube boiler")


BOILERWARE: tuple[Family, ...] = (
    equipment_family("boiler/fire-tube", _fire_tube, 1.0),
    equipment_family("boiler/wall-hung", _wall_hung, 1.0),
    equipment_family("boiler/vertical", _vertical, 1.0),
    equipment_family("boiler/water-tube", _water_tube, 1.0),
)
