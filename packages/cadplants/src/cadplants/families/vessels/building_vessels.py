"""Small vessels of buildings and workshops: expansion vessels, hydrophores, buffers, gas bottles."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.vessel_fittings import Drum, head_height, sides
from cadplants.families.vessels.vesselbuild import closed_vessel, tank_family
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.transforms import at, spun

__all__ = ["BUILDING_VESSELS"]

_FRAME, _JOINT = "Structural element", "Connection assembly"


def _bladder(r: float, tall: float, n: int, z: float) -> Solid:
    """A membrane vessel: two deep-drawn halves with a seam round the middle."""
    a = np.linspace(0, np.pi / 2, 7)
    deep, half = 0.6 * r, max(0.01, tall / 2 - 0.6 * r)
    outline = [(r * np.sin(t), -half - deep * np.cos(t)) for t in a]
    outline += [(r, -0.02), (1.035 * r, -0.015), (1.035 * r, 0.015), (r, 0.02)]
    outline += [(r * np.cos(t), half + deep * np.sin(t)) for t in a]
    outline[0], outline[-1] = (0.0, outline[0][1]), (0.0, outline[-1][1])
    return moved(turned(outline, n), at(0, 0, z))


def _expansion_feet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A membrane expansion vessel (EN 13831) on three bent feet or a ring, its connection below, gas valve on top."""
    r = float(rng.uniform(0.18, 0.5))
    tall, n = r * float(rng.uniform(1.8, 4.0)), sides(style, r)
    clear = float(rng.uniform(0.12, 0.25))
    z = clear + tall / 2
    parts = [Part(_bladder(r, tall, n, z), "shell", "handle" if rng.random() < 0.5 else "tank", "tank")]
    if rng.random() < 0.6:
        sheet = box((0.006, 0.35 * r, clear + 0.5 * r), (0.93 * r, 0, (clear + 0.5 * r) / 2))
        foot = box((0.12, 0.35 * r, 0.006), (0.93 * r + 0.04, 0, 0.003))
        for k in range(3):
            parts.append(Part(moved(merge([sheet, foot]), spun("z", 2.1 * k)), "tank leg", "tank", "tank leg"))
    else:
        parts.append(Part(ring(0.86 * r, 0.9 * r, 0.0, clear + 0.35 * r, n), "skirt", "tank", "skirt"))
    bottom = merge([cylinder(0.017, clear - 0.06, clear + 0.05, 10), hexagon(0.045, clear - 0.06, clear - 0.03)])
    parts.append(Part(bottom, "nozzle", "trim", "nozzle"))
    path = [(0, 0, clear - 0.05), (0, 0, 0.05), (1.5 * r, 0, 0.05)]
    parts.append(Part(moved(rope(path, 0.0134, 10), spun("z", 1.05)), "pipe", "pipe", "", "Pipe assembly"))
    cap = merge(
        [
            cylinder(0.03, z + tall / 2 - 0.01, z + tall / 2 + 0.025, 12),
            cylinder(0.008, z + tall / 2, z + tall / 2 + 0.04, 8),
        ]
    )
    parts.append(Part(cap, "nozzle", "rubber", "nozzle"))
    if rng.random() < 0.4:
        parts.append(
            Part(cylinder(0.3 * r, z + tall / 2 - 0.01, z + tall / 2 + 0.012, n), "manway", "flange", "manway")
        )
    return Model(parts, kind="expansion vessel")


def _expansion_wall(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small expansion vessel on a wall: upright or flat, held by a bracket with a strap, a hose or pipe below."""
    r = float(rng.uniform(0.12, 0.24))
    flat = bool(rng.random() < 0.35)
    tall, n = (0.7 * r if flat else r * float(rng.uniform(1.6, 2.6))), sides(style, r)
    z, gap = float(rng.uniform(1.2, 1.7)), 0.05
    wall = box((1.4, 0.12, 2.2), (0, r + gap + 0.06, 1.1))
    if flat:
        vessel = moved(_bladder(r, tall, n, 0.0), at(0, 0, z) @ spun("x", np.pi / 2))
        half = max(0.01, tall / 2 - 0.6 * r) + 0.6 * r
        wall = box((1.4, 0.12, 2.2), (0, half + 0.06 - 0.002, 1.1))
        straps = [
            box((0.05, half, 0.004), (0, half / 2, z + r + 0.001)),
            box((0.05, 0.004, 0.1), (0, half - 0.002, z + r + 0.04)),
        ]
        bottom = z - r
    else:
        vessel = _bladder(r, tall, n, z)
        sheet = [
            box((0.06, gap + 0.02, 0.16), (0, r + gap / 2, z + 0.05)),
            box((0.16, 0.008, 0.22), (0, r + gap - 0.004, z + 0.05)),
        ]
        straps = [*sheet, ring(0.97 * r, 1.015 * r, z + 0.04, z + 0.07, n)]
        bottom = z - max(0.01, tall / 2 - 0.6 * r) - 0.6 * r
    stub = merge(
        [
            moved(cylinder(0.012, bottom - 0.05, bottom + 0.02, 10), at()),
            moved(hexagon(0.03, bottom - 0.05, bottom - 0.02), at()),
        ]
    )
    path = [(0, 0, bottom - 0.04), (0, 0, bottom - 0.2), (0.3, 0, bottom - 0.2), (0.3, 0, 0.0)]
    hose = bool(rng.random() < 0.5)
    return Model(
        [
            Part(vessel, "shell", "handle" if rng.random() < 0.5 else "dial", "tank"),
            Part(stub, "nozzle", "trim", "nozzle"),
            Part(merge(straps), "bracket", "steel", "", _JOINT),
            Part(rope(path, 0.012, 10), "hose" if hose else "pipe", "rubber" if hose else "pipe", "", "Pipe assembly"),
            Part(wall, "wall", "concrete", "", _FRAME),
        ],
        kind="expansion vessel",
    )


def _hydrophore(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A domestic pressure tank lying on two bent feet, with a jet pump on a bracket on its back and a hose."""
    r = float(rng.uniform(0.15, 0.27))
    length, n = r * float(rng.uniform(1.6, 3.0)), sides(style, r)
    axis = r + 0.09
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    drum = Drum(r, 0.0, length, n)
    parts = placed(closed_vessel(drum, "torispherical", "torispherical", style), lay)
    for x in (-0.28 * length, 0.28 * length):
        foot = [
            (x, -0.9 * r, 0.003),
            (x, -0.75 * r, 0.003),
            (x, -0.55 * r, axis - 0.8 * r),
            (x, 0.55 * r, axis - 0.8 * r),
            (x, 0.75 * r, 0.003),
            (x, 0.9 * r, 0.003),
        ]
        parts.append(
            Part(
                sweep(np.array(foot), rounded_rectangle(0.05, 0.005, 0.0), up=(1.0, 0.0, 0.0)),
                "saddle",
                "tank",
                "saddle",
            )
        )
    flange = along("x", cylinder(0.4 * r, -0.02, 0.012, n), length / 2 + head_height("torispherical", r), 0, axis)
    stub = along("x", cylinder(0.016, 0.0, 0.06, 10), length / 2 + head_height("torispherical", r), 0, axis)
    parts.append(Part(merge([flange, stub]), "nozzle", "flange", "nozzle"))
    deck = axis + r + 0.05
    table = [
        box((0.6 * length, 0.16, 0.004), (0, 0, deck - 0.002)),
        *(box((0.004, 0.16, 0.07), (s * 0.25 * length, 0, deck - 0.037)) for s in (-1, 1)),
    ]
    parts.append(Part(merge(table), "bracket", "tank", "", _JOINT))
    high = deck + 0.085
    casing = along("x", turned([(0.05, -0.13), (0.085, -0.11), (0.085, -0.02), (0.06, 0.0)], 20), 0, 0, high)
    motor = along(
        "x",
        merge([cylinder(0.062, -0.005, 0.14, 20), around(box((0.012, 0.004, 0.12), (0.066, 0, 0.07)), 14)]),
        0,
        0,
        high,
    )
    cover = along("x", turned([(0.07, 0.13), (0.07, 0.19), (0.055, 0.2)], 20), 0, 0, high)
    foot_box = box((0.1, 0.1, 0.05), (0.05, 0, deck + 0.024))
    for solid, name in ((casing, "pump casing"), (merge([motor, foot_box]), "motor"), (cover, "motor fan cover")):
        parts.append(Part(solid, name, "pump", "pump", "Pump unit"))
    end = length / 2 + head_height("torispherical", r) + 0.05
    path = [
        (-0.08, 0, high + 0.07),
        (-0.08, 0, high + 0.16),
        (end + 0.1, 0, high + 0.16),
        (end + 0.1, 0, axis),
        (end, 0, axis),
    ]
    parts.append(Part(rope(path, 0.016, 10), "hose", "rubber", "", "Pipe assembly"))
    return Model(parts, kind="pressure tank")


def _buffer(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An insulated buffer or hot-water cylinder: a foam jacket with a seam strip, a lid, rosettes, sleeves, a hatch."""
    r = float(rng.uniform(0.28, 0.6))
    tall, n = float(rng.uniform(1.1, 2.1)), sides(style, r)
    foot = float(rng.choice([0.0, 0.05, 0.1]))
    jacket = [Part(cylinder(r, foot, foot + tall, n), "shell", "dial", "tank")]
    lid = (
        turned([(1.02 * r, 0), (1.02 * r, 0.04), (0.97 * r, 0.06)], n)
        if rng.random() < 0.6
        else dome(1.01 * r, 0.12, 0.0, n)
    )
    jacket.append(
        Part(moved(lid, at(0, 0, foot + tall)), "dished head", "rubber" if rng.random() < 0.5 else "dial", "tank")
    )
    strip = box((0.012, 0.06, tall), (r + 0.004, 0, foot + tall / 2))
    jacket.append(Part(moved(strip, spun("z", 2.4)), "shell", "electrical", "tank"))
    drum, ports = Drum(r, foot, foot + tall, n), []
    side = float(rng.choice([0.0, np.pi]))
    for k, z in enumerate(np.linspace(0.15, 0.9, int(rng.integers(3, 6))) * tall + foot):
        for a in (side, side + 0.5)[: int(rng.integers(1, 3))]:
            pose = drum.side(a, float(z))
            stub = merge([cylinder(0.021, -0.05, 0.06, 12), ring(0.021, 0.045, -drum.dip, 0.006, 16)])
            jacket.append(Part(moved(stub, pose), "nozzle", "trim", "nozzle"))
            ports += [Port(pose @ at(0, 0, 0.06) @ spun("y", -np.pi / 2), 32)] if k < 0 else []
    if rng.random() < 0.6:
        hatch = merge([cylinder(0.11, -drum.dip - 0.02, 0.03, 24), around(hexagon(0.024, 0.03, 0.045), 8, 0.09)])
        jacket.append(Part(moved(hatch, drum.side(4.7, foot + 0.25 * tall)), "manway", "flange", "manway"))
    for z in (0.4, 0.75)[: int(rng.integers(0, 3))]:
        face = merge([cylinder(0.035, -0.01, 0.02, 16)])
        jacket.append(Part(moved(face, drum.side(4.7, foot + z * tall)), "gauge", "dial", "", "Gauge assembly"))
    if foot:
        feet = around(cylinder(0.035, 0.0, foot + 0.002, 10), 3, 0.75 * r)
        base = ring(0.85 * r, 0.93 * r, 0.0, foot + 0.002, n)
        jacket.append(
            Part(feet, "tank leg", "rubber", "tank leg")
            if rng.random() < 0.6
            else Part(base, "skirt", "steel", "skirt")
        )
    return Model(jacket, ports=tuple(ports), kind="buffer tank")


def _bottle(r: float, tall: float, style: ModelingStyle, cap: bool) -> list[Part]:
    """A gas bottle (EN ISO 9809) about z: round shoulder, collar, a valve or a valve cap, a concave foot."""
    n, neck = max(12, style.round(r)), 0.028 + 0.06 * r
    a = np.linspace(0, np.pi / 2, 6)
    body = [(0.94 * r, 0.0), (r, 0.03)] + [(neck + (r - neck) * np.cos(t), tall - r + 0.8 * r * np.sin(t)) for t in a]
    top = tall - 0.2 * r
    collar = cylinder(1.25 * neck, top - 0.01, top + 0.03, 16)
    parts = [Part(merge([turned([*body, (neck, top + 0.01)], n), collar]), "shell", "handle", "tank")]
    if cap:
        parts.append(
            Part(
                turned([(0.04, top + 0.02), (0.045, top + 0.1), (0.03, top + 0.16), (0.0, top + 0.165)], 16),
                "tank",
                "trim",
                "tank",
            )
        )
    else:
        body_ = merge(
            [cylinder(0.014, top + 0.02, top + 0.09, 10), along("x", cylinder(0.012, 0.0, 0.045, 10), 0, 0, top + 0.05)]
        )
        wheel = merge([cylinder(0.028, top + 0.1, top + 0.12, 12), cylinder(0.006, top + 0.08, top + 0.11, 8)])
        parts.append(Part(merge([body_, wheel]), "valve", "trim", "", "Valve assembly"))
    return parts


def _bottles(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Gas bottles (10 to 50 l) in a rack: a frame with chains, or on a wall with clamps; a manifold above some."""
    r, tall = ((0.115, 1.6), (0.102, 1.0), (0.07, 0.9), (0.15, 0.6))[int(rng.integers(4))]
    count, rows = int(rng.integers(1, 6)), int(rng.choice([1, 1, 2]))
    pitch, cap = 2 * r + float(rng.uniform(0.02, 0.12)), bool(rng.random() < 0.4)
    parts: list[Part] = []
    xs = (np.arange(count) - (count - 1) / 2) * pitch
    base = float(rng.choice([0.0, 0.06]))
    one = _bottle(r, tall, style, cap)
    for row in range(rows):
        for x in xs:
            parts += placed(one, at(float(x), -row * pitch, base) @ spun("z", -np.pi / 2))
    w, back = count * pitch + 0.1, r
    if base:
        plate = box((w, rows * pitch + 0.1, base), (0, -(rows - 1) * pitch / 2, base / 2))
        parts.append(Part(plate, "skid frame", "steel", "", _FRAME))
    side = 0.04
    posts = [box((side, side, 1.1 * tall), (s * (w / 2 - side / 2), back + side / 2, 0.55 * tall)) for s in (-1, 1)]
    rails = [box((w, 0.02, 0.05), (0, back + 0.01, base + f * tall)) for f in (0.3, 0.65)]
    parts += [Part(post, "post", "steel", "", _FRAME) for post in posts]
    parts.append(Part(merge(rails), "beam", "steel", "", _FRAME))
    front = -(rows - 1) * pitch - r - 0.006
    for f in (0.3, 0.65):
        loop = [
            (-w / 2, back, base + f * tall),
            (-w / 2, front, base + f * tall),
            (w / 2, front, base + f * tall),
            (w / 2, back, base + f * tall),
        ]
        parts.append(Part(rope(loop, 0.006, 6), "clamp", "clamp", "", _JOINT))
    return Model(parts, kind="gas bottle")


BUILDING_VESSELS: tuple[Family, ...] = (
    tank_family("tank/expansion on feet", _expansion_feet, 1.0),
    tank_family("tank/expansion on wall", _expansion_wall, 0.8),
    tank_family("tank/hydrophore", _hydrophore, 0.8),
    tank_family("tank/insulated buffer", _buffer, 1.0),
    tank_family("tank/gas bottles", _bottles, 0.8),
)
