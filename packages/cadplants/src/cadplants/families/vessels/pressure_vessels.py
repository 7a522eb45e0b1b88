"""Vessels under pressure and process vessels: reactors, mixers, bullets, spheres, receivers."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.vessel_fittings import Drum, head, head_height, lug, manway, mouth, sides, wrapped
from cadplants.families.vessels.vesselbuild import closed_vessel, outlet, tank_family
from cadplants.families.vessels.vesselfeet import bar, foot_plate, ladder_parts, legs, saddle
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import section_channel
from cadplants.primitives import along, around, ball, box, cylinder, ring, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = [
    "PRESSURE_VESSELS",
    "agitator",
]

_FRAME, _JOINT = "Structural element", "Connection assembly"


def agitator(z: float, size: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """An agitator drive on a flange at a height: lantern, gear unit, flanged motor with its fan cover (IEC 60072)."""
    r, n = 0.5 * size, style.round(0.5 * size)
    lantern = [ring(0.8 * r, 1.4 * r, z, z + 0.12 * size, n), ring(0.7 * r, 1.1 * r, z + 0.8 * size, z + 0.9 * size, n)]
    lantern.append(
        around(box((0.12 * size, 0.2 * size, 0.75 * size), (0.93 * r, 0, z + 0.45 * size)), int(rng.choice([2, 3, 4])))
    )
    shaft = cylinder(0.14 * size, z - 0.3 * size, z + 1.0 * size, 12)
    top = z + 0.9 * size
    parts = [
        Part(merge(lantern), "bracket", "steel", "agitator", _JOINT),
        Part(shaft, "shaft", "trim", "agitator", "Pump unit"),
    ]
    lying = bool(rng.random() < 0.35)
    high = 0.8 * size if lying else 0.6 * size
    gear = turned([(0.9 * r, top), (0.9 * r, top + 0.5 * high), (0.75 * r, top + high)], n)
    if lying:
        gear = box((1.5 * r, 1.4 * r, high), (0, 0, top + high / 2))
    parts.append(Part(gear, "gearbox", "motor", "agitator", "Valve assembly"))
    fins = around(box((0.1 * r, 0.04 * r, 1.1 * size), (0, 0, 0.6 * size)), 16, 0.72 * r)
    body = merge(
        [turned([(0.95 * r, 0), (0.95 * r, 0.06 * size), (0.72 * r, 0.06 * size), (0.72 * r, 1.2 * size)], n), fins]
    )
    cover = turned([(0.8 * r, 1.15 * size), (0.8 * r, 1.45 * size), (0.6 * r, 1.5 * size)], n)
    case = box((0.3 * size, 0.35 * size, 0.35 * size), (0.85 * r + 0.08 * size, 0, 0.55 * size))
    pose = at(0, 0, top + high) if not lying else at(0.75 * r, 0, top + high / 2) @ spun("y", np.pi / 2)
    for solid, name in ((body, "motor"), (cover, "motor fan cover"), (case, "terminal box")):
        parts.append(Part(moved(solid, pose), name, "motor", "agitator", "Pump unit"))
    return parts


def _reactor(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A stirred reactor (DIN 28136): a jacket of half-pipe coils or a smooth or dimpled one, agitator, many nozzles."""
    r = float(rng.uniform(0.35, 0.95))
    n, height = sides(style, r), r * float(rng.uniform(1.1, 2.4))
    low = head_height("torispherical", r) + 0.4 + 0.3 * r
    drum = Drum(r, low, low + height, n)
    parts = closed_vessel(drum, "torispherical", "torispherical", style)
    kind, top = int(rng.integers(3)), low + 0.75 * height
    if kind == 0:
        coils = int(rng.integers(4, 8))
        zs = np.linspace(low + 0.06, top, coils)
        parts.append(
            Part(merge([moved(torus(r, 0.03 + 0.015 * r, n, 6), at(0, 0, z)) for z in zs]), "shell", "trim", "tank")
        )
    else:
        r2 = 1.07 * r
        outline = [(r, low - 0.01), (r2, low + 0.05), (r2, top), (r, top + 0.06)]
        parts.append(Part(turned(outline, n), "shell", "trim", "tank"))
        if kind == 2:
            dots = [
                spun("z", float(a)) @ at(r2, 0, z)
                for a in np.arange(12) * np.pi / 6
                for z in np.linspace(low + 0.12, top - 0.06, 4)
            ]
            parts.append(
                Part(
                    merge([moved(along("x", cylinder(0.02, -0.02, 0.008, 8)), p) for p in dots]),
                    "shell",
                    "trim",
                    "tank",
                )
            )
    for z, a in ((low + 0.1, 0.4), (top - 0.08, 3.5)):
        parts += placed(mouth("plain", 25, 0.16, style, r, drum.dip), drum.side(a, z))
    apex = drum.high + head_height("torispherical", r)
    size = float(rng.uniform(0.22, 0.32)) * (0.6 + 0.5 * r)
    pad = cylinder(0.75 * size, apex - 0.05 * r - 0.02, apex + 0.05, style.round(size))
    parts.append(Part(pad, "nozzle", "flange", "nozzle"))
    parts += agitator(apex + 0.05, size, style, rng)
    ports: list[Port] = []
    crown, x = apex - 0.12 * r, 0.62 * r
    for k in range(int(rng.integers(2, 5))):
        a = 0.4 + 2 * np.pi * k / 6
        some, port = outlet(
            "plain", int(rng.choice([25, 40, 50])), at(x * np.cos(a), x * np.sin(a), crown), style, 0.0, 0.15 * r, 0.06
        )
        parts += some
        ports += port[:1] if k < 2 else []
    if r > 0.55:
        a = 0.4 + 2 * np.pi * 5 / 6
        parts += placed(manway("swing", 0.2, style, rng, 0.0, 0.2 * r), at(x * np.cos(a), x * np.sin(a), crown))
    drain = at(0, 0, low - head_height("torispherical", r)) @ spun("x", np.pi)
    parts += placed(mouth("plain", 50, 0.16, style, 0.0, 0.02), drain)
    feet = str(rng.choice(["pipe", "bracket", "beam"]))
    parts += legs(feet, Drum(1.07 * r if feet == "bracket" else r, low, drum.high, n), style, rng)
    return Model(parts, ports=tuple(ports), kind="stirred reactor")


def _mixer(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An open mixing tank: a flat or dished bottom, a bridge of two channels, an agitator with its impeller."""
    r = float(rng.uniform(0.4, 1.1))
    n, height = sides(style, r), r * float(rng.uniform(1.2, 2.2))
    low = 0.35 + 0.35 * r
    drum = Drum(r, low, low + height, n)
    rim = merge([ring(0.985 * r, r, low, drum.high, n), moved(torus(r + 0.004, 0.02, n, 8), at(0, 0, drum.high))])
    lower = str(rng.choice(["torispherical", "conical", "flat"]))
    parts = [
        Part(rim, "shell", "tank", "tank"),
        Part(moved(head(lower, r, style, n), at(0, 0, low) @ spun("x", np.pi)), "dished head", "tank", "tank"),
    ]
    feet_drum = Drum(r, max(low, head_height(lower, r) + 0.2), drum.high, n)
    lift = feet_drum.low - low
    size = 0.16 + 0.1 * r
    z = drum.high + 0.02
    section = section_channel(0.12, 0.06, 0.007, 0.009)
    for s in (-1, 1):
        pose = (-r - 0.05, s * 0.6 * size, z + 0.06), (r + 0.05, s * 0.6 * size, z + 0.06)
        solid = bar(*pose, section, (0.0, float(s), 0.0))
        parts.append(Part(solid, "beam", "steel", "", _FRAME))
    plate = box((1.9 * size, 1.6 * size, 0.015), (0, 0, z + 0.1275))
    parts.append(Part(plate, "plate", "steel", "", _FRAME))
    parts += agitator(z + 0.135, size, style, rng)
    deep = low + 0.25 * height
    parts.append(Part(cylinder(0.02 + 0.01 * r, deep, z + 0.1, 10), "shaft", "trim", "agitator", "Pump unit"))
    blade = moved(box((0.45 * r, 0.12 * r, 0.012), (0.22 * r, 0, 0)), spun("x", 0.6))
    parts.append(
        Part(
            moved(around(blade, int(rng.integers(2, 5))), at(0, 0, deep + 0.05 * r)),
            "impeller",
            "trim",
            "agitator",
            "Pump unit",
        )
    )
    parts += placed(mouth("plain", 40, 0.15, style, r, drum.dip), drum.side(0.9, low + 0.12))
    parts = placed(parts, at(0, 0, lift))
    kind = str(rng.choice(["pipe", "angle"]))
    parts += legs(kind, Drum(r, feet_drum.low, feet_drum.high, n), style, rng)
    return Model(parts, kind="mixing tank")


def _bullet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bullet for liquefied gas: hemispherical ends, saddles on piers, a platform beside its back, a ladder."""
    r = float(rng.uniform(0.5, 0.95))
    length, n = float(rng.uniform(3.0, 4.4)) * r, sides(style, r)
    axis = r + float(rng.uniform(0.5, 0.9))
    drum = Drum(r, 0.0, length, n)
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    parts = placed(closed_vessel(drum, "hemispherical", "hemispherical", style), lay)
    pier = axis - r - 0.15
    for x in (-0.3 * length, 0.3 * length):
        parts += placed(saddle("ribbed", r, axis - pier, style, rng), at(x, 0, pier))
        parts.append(Part(box((0.35, 2.3 * r, pier), (x, 0, pier / 2)), "foundation", "concrete", "", _FRAME))
    ports: list[Port] = []
    for k, z in enumerate((0.25, 0.5, 0.75)):
        some, port = outlet(
            "plain", int(rng.choice([40, 50])), lay @ drum.side(np.pi, z * length), style, r, drum.dip, 0.06
        )
        parts += some
        ports += port[: 1 - k % 2]
    wide, high, side = 0.8, axis + r + 0.02, r + 0.45
    deck = box((0.9 * length, wide, 0.03), (0, side, high))
    parts.append(Part(deck, "grating", "steel", "", _FRAME))
    for x in (-0.4 * length, 0.4 * length):
        for y in (side - wide / 2 + 0.05, side + wide / 2 - 0.05):
            parts.append(
                Part(box((0.08, 0.08, high - 0.015), (x, y, (high - 0.015) / 2)), "column", "steel", "", _FRAME)
            )
    rail = [
        rod((-0.45 * length, side + wide / 2, high + z), (0.45 * length, side + wide / 2, high + z), 0.02, 6)
        for z in (0.55, 1.1)
    ]
    rail += [
        rod((x, side + wide / 2, high), (x, side + wide / 2, high + 1.1), 0.02, 6)
        for x in np.linspace(-0.45, 0.45, 4) * length
    ]
    parts.append(Part(merge(rail), "railing", "safety", "", _FRAME))
    parts += placed(
        ladder_parts(0.0, 0.0, high + 1.0, style, False, 0.01), at(-0.45 * length - 0.02, side, 0) @ spun("z", np.pi)
    )
    return Model(parts, ports=tuple(ports), kind="gas tank")


def _sphere(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure sphere (Horton): petals' seams, columns tangent at the equator, crossed tie rods, a top platform."""
    r = float(rng.uniform(0.7, 1.7))
    n, z = max(16, style.round(r)), r * float(rng.uniform(1.25, 1.5)) + 0.2
    count, leg = int(rng.choice([4, 6, 8])), 0.06 * r + 0.02
    parts = [Part(moved(ball(r, n), at(0, 0, z)), "shell", "tank", "tank")]
    if rng.random() < 0.5:
        parts.append(Part(moved(torus(r * np.cos(np.pi / n), 0.02, n, 6), at(0, 0, z)), "shell", "tank", "tank"))
    for k in range(count):
        turn = spun("z", 2 * np.pi * k / count)
        post = merge(
            [cylinder(leg, 0.015, z + 0.15 * r, style.round(leg)), cylinder(1.1 * leg, z + 0.14 * r, z + 0.16 * r, 12)]
        )
        parts.append(Part(moved(post, turn @ at(r * np.cos(np.pi / n))), "tank leg", "tank", "tank leg"))
        parts.append(Part(moved(foot_plate(r, 0, 3.2 * leg, 0.015), turn), "base plate", "steel", "", _FRAME))
        a, b = (2 * np.pi * j / count for j in (k, k + 1))
        for s, t in ((a, b), (b, a)):
            ends = (r * np.cos(s), r * np.sin(s), 0.12 * z), (r * np.cos(t), r * np.sin(t), 0.75 * z)
            parts.append(Part(rod(*ends, 0.012 + 0.006 * r, 6), "brace", "steel", "", _FRAME))
    parts += placed(mouth("plain", 80, 0.2, style, 0.0, 0.05 * r), at(0, 0, z - r) @ spun("x", np.pi))
    some, ports = outlet("plain", 80, at(0, 0, z + r), style, 0.0, 0.05 * r, 0.1)
    parts += [
        *some,
        *placed(manway("hinged", 0.22, style, rng, 0.0, 0.1 * r), at(0.4 * r, 0, z + 0.916 * r) @ spun("y", 0.41)),
    ]
    return Model(parts, ports=tuple(ports), kind="pressure sphere")


def _receiver(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A compressed-air receiver (EN 286-1): weld bands, a ring foot or legs, handhole, sockets, a name plate, gauge."""
    r = float(rng.uniform(0.18, 0.5))
    n, height = sides(style, r), r * float(rng.uniform(2.2, 4.5))
    low = head_height("torispherical", r) + 0.15
    drum = Drum(r, low, low + height, n)
    parts = closed_vessel(drum, "torispherical", "torispherical", style)
    bands = [ring(r - 0.004, r + 0.003, z - 0.006, z + 0.006, n) for z in (drum.low, low + 0.5 * height, drum.high)]
    parts.append(Part(merge(bands), "shell", "tank", "tank"))
    if rng.random() < 0.5:
        cut = ring(0.8 * r, 0.83 * r, 0.0, low - 0.3 * r + 0.05, n)
        parts.append(Part(cut, "skirt", "tank", "skirt"))
    else:
        parts += legs(str(rng.choice(["tripod", "angle"])), drum, style, rng)
    parts += placed(manway("oval", min(0.11, 0.45 * r), style, rng, r, drum.dip), drum.side(5.0, low + 0.3 * height))
    for k in range(int(rng.integers(3, 6))):
        pose = drum.side(4.2 + 0.6 * k, low + height * float(rng.uniform(0.2, 0.9)))
        parts += placed(mouth("half", int(rng.choice([20, 25, 32, 40])), 0.05, style, r, drum.dip), pose)
    plate = wrapped(r - drum.dip, 3.6, 0.3 / r * 0.3, low + 0.62 * height, low + 0.7 * height, drum.dip + 0.004, style)
    parts.append(Part(plate, "sign", "trim", "", "Electrical and safety"))
    apex = drum.high + head_height("torispherical", r)
    parts += placed(mouth("half", 32, 0.05, style, 0.0, 0.01), at(0, 0, apex))
    return Model(parts, kind="air receiver")


def _cryogenic(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vacuum-insulated tank for liquid gas (EN ISO 21009): a slim jacket on three broad legs, pipes below."""
    r = float(rng.uniform(0.5, 0.95))
    n, height = sides(style, r), r * float(rng.uniform(3.0, 5.0))
    low = head_height("torispherical", r) + float(rng.uniform(0.5, 0.8))
    drum = Drum(r, low, low + height, n)
    parts = closed_vessel(drum, "torispherical", "torispherical", style)
    wide = 0.55 * r
    for k in range(3):
        turn = spun("z", 2.0944 * k + 0.5)
        leg = wrapped(0.97 * r, -wide / r / 2, wide / r, 0.012, low + 0.2 * r, 0.03 * r + drum.dip, style)
        parts.append(Part(moved(leg, turn), "tank leg", "tank", "tank leg"))
        parts.append(Part(moved(box((0.25, wide, 0.012), (r, 0, 0.006)), turn), "base plate", "steel", "", _FRAME))
    x, bottom = 0.55 * r, low - head_height("torispherical", r)
    for k in range(4):
        y = (k - 1.5) * 0.22 * r
        path = [(x, y, bottom + 0.3 * r), (x, y, 0.45), (1.25 * r, y, 0.45), (1.25 * r, y, 0.6 + 0.1 * k)]
        parts.append(Part(rope(path, 0.017, 8), "pipe", "pipe", "", "Pipe assembly"))
    cover = cylinder(
        0.16 * r,
        drum.high + 0.8 * head_height("torispherical", r),
        drum.high + head_height("torispherical", r) + 0.05,
        16,
    )
    parts.append(Part(cover, "manway", "tank", "manway"))
    for k in range(2):
        pose = drum.side(np.pi * k + 0.3, drum.high - 0.25)
        parts += placed(lug("pad", 0.16, style, r, drum.dip), pose)
    return Model(parts, kind="cryogenic tank")


PRESSURE_VESSELS: tuple[Family, ...] = (
    tank_family("tank/stirred reactor", _reactor, 1.2),
    tank_family("tank/open mixer", _mixer),
    tank_family("tank/bullet", _bullet),
    tank_family("tank/pressure sphere", _sphere),
    tank_family("tank/air receiver", _receiver, 1.0),
    tank_family("tank/cryogenic", _cryogenic),
)
