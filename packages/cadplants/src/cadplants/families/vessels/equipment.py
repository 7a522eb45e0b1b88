"""Heat exchangers, radiators, boilers, burners, filters, separators; mostly one mesh or few."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.vessel import head_profile, nozzle
from cadplants.family import Family, Model, Part, Port
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, looking, spun
from cadplants.valve_body import bore_of

__all__ = ["EQUIPMENT"]

_GROUP = "Equipment"


def _shell_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A shell-and-tube exchanger (TEMA): a shell with two nozzles, channel and cover flanges, saddles."""
    name, r = "heat exchanger", float(rng.uniform(0.12, 0.4))
    n, length = style.round(r), float(rng.uniform(5, 10)) * r
    axis = r + float(rng.uniform(0.25, 0.5))
    collar, plate = 1.2 * r + 0.02, 0.03 + 0.05 * r
    half = length / 2
    body = along("x", cylinder(r, -half, half, n), 0, 0, axis)
    girths = []
    for x in (-half, half):
        girths += [
            along("x", cylinder(collar, x - plate, x, n), 0, 0, axis),
            along("x", cylinder(collar, x + 0.004, x + plate + 0.004, n), 0, 0, axis),
        ]
    bolts = [
        along("x", bolt_circle(max(8, int(30 * r)), 1.1 * r + 0.01, 0.016, x - plate, x + plate + 0.004), 0, 0, axis)
        for x in (-half, half)
    ]
    channel = 0.9 * r + 0.1
    front = along("-x", cylinder(r, half, half + channel, n), 0, 0, axis)
    ends: list[Solid] = [front]
    if rng.random() < 0.5:
        ends.append(along("-x", cylinder(collar, half + channel, half + channel + plate, n), 0, 0, axis))
    else:
        ends.append(
            moved(
                turned([(x, z) for x, z in head_profile("2:1", r)], n),
                at(-half - channel, 0, axis) @ spun("y", -np.pi / 2),
            )
        )
    ends.append(
        moved(
            turned([(x, z) for x, z in head_profile(str(rng.choice(["2:1", "torispherical", "flat"])), r)], n),
            at(half + plate, 0, axis) @ spun("y", np.pi / 2),
        )
    )
    dn = int(rng.choice([50, 80, 100])) if r > 0.2 else 40
    reach = 0.1 + 0.5 * FLANGES[dn].outer * 0.4
    spots = ((-0.7 * half, 1), (0.7 * half, -1), (-half - 0.5 * channel, 1), (-half - 0.5 * channel, -1))
    mouths, ports = [], []
    for x, s in spots:
        pose = at(x, 0, axis + s * r) @ spun("x", 0.0 if s > 0 else np.pi)
        mouths += [moved(p.solid, pose) for p in nozzle(dn, reach, style)]
        if s > 0:
            ports.append(Port(looking((x, 0, axis + r + reach), (0, 0, 1)), dn))
    feet = [
        merge(
            [
                box((0.02, 1.6 * r, axis - 0.6 * r), (x, 0, (axis - 0.6 * r) / 2)),
                box((0.2, 1.7 * r, 0.015), (x, 0, 0.0075)),
            ]
        )
        for x in (-0.45 * half, 0.45 * half)
    ]
    parts = [
        Part(merge([body, *girths, *mouths]), name, "tank", name),
        Part(merge(ends), name, "tank", name),
        Part(merge(feet), "saddle", "steel", name, "Tank"),
        Part(merge(bolts), "bolt", "fastener", name, "Connection assembly", True),
    ]
    return Model(parts, ports=tuple(ports), kind="shell-and-tube heat exchanger")


def _plate(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gasketed plate exchanger: a fixed plate, a stack of thin ones, a pressure plate, carrying bars, tie bolts."""
    name = "heat exchanger"
    wide, tall = float(rng.uniform(0.25, 0.6)), float(rng.uniform(0.7, 1.6))
    stack, thick = float(rng.uniform(0.2, 0.8)), 0.035
    low = 0.05
    outline = rounded_rectangle(tall, wide, 0.02, 2)
    fixed = box((thick, wide * 1.15, tall + low), (0, 0, (tall + low) / 2))
    follow = box((thick, wide * 1.15, tall), (thick + stack, 0, low + tall / 2))
    count = int(np.clip(stack / 0.02, 8, 40))
    plates = merge(
        [
            box((0.6 * stack / count, wide, 0.95 * tall), (thick / 2 + (k + 0.5) * stack / count, 0, low + tall / 2))
            for k in range(count)
        ]
    )
    rails = [rod((0, 0, z), (stack + 0.45, 0, z), 0.02, 10) for z in (low + tall + 0.02, low - 0.005)]
    post = box((0.06, 0.12, tall + low + 0.06), (stack + 0.45, 0, (tall + low + 0.06) / 2))
    ties = [
        rod((-0.05, s * 0.54 * wide, low + f * tall), (stack + thick + 0.08, s * 0.54 * wide, low + f * tall), 0.012, 8)
        for s in (-1, 1)
        for f in (0.15, 0.5, 0.85)
    ]
    nuts = [
        along("x", hexagon(0.035, -0.045, -0.02), 0, s * 0.54 * wide, low + f * tall)
        for s in (-1, 1)
        for f in (0.15, 0.5, 0.85)
    ]
    dn = int(rng.choice([40, 50, 65, 80]))
    mouths, ports = [], []
    for s in (-1, 1):
        for f in (0.14, 0.86):
            pose = at(-thick / 2, s * 0.28 * wide, low + f * tall) @ spun("y", -np.pi / 2)
            mouths += [moved(p.solid, pose) for p in nozzle(dn if FLANGES[dn].outer < 0.55 * wide else 25, 0.12, style)]
        ports.append(
            Port(
                looking((-thick / 2 - 0.12, s * 0.28 * wide, low + 0.86 * tall), (-1, 0, 0)),
                dn if FLANGES[dn].outer < 0.55 * wide else 25,
            )
        )
    parts = [
        Part(merge([fixed, follow, *mouths]), name, "valve", name),
        Part(plates, name, "trim", name),
        Part(merge([*rails, post]), name, "steel", name),
        Part(merge([*ties, *nuts]), "stud", "fastener", name, "Connection assembly", True),
    ]
    del outline
    return Model(parts, ports=tuple(ports), kind="plate heat exchanger")


def _brazed(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A brazed plate exchanger: a small ribbed brick with four threaded stubs, on a bracket."""
    name, wide, tall = "heat exchanger", float(rng.uniform(0.08, 0.2)), float(rng.uniform(0.2, 0.5))
    deep = float(rng.uniform(0.05, 0.25))
    outline = rounded_rectangle(wide, tall, 0.25 * wide, 4)
    lift = 0.15
    count = max(4, int(deep / 0.01))
    ribs = merge(
        [extrude((1.0 if k % 2 else 0.96) * outline, k * deep / count, (k + 1) * deep / count) for k in range(count)]
    )
    stubs = [
        moved(
            merge([cylinder(0.017, 0, 0.04, 12), hexagon(0.042, 0.0, 0.008)]),
            at(sx * 0.28 * wide, sy * 0.36 * tall, deep - 0.001),
        )
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    stand = at(0, 0, lift + tall / 2) @ spun("x", np.pi / 2)
    foot = merge(
        [
            box((wide, 0.004, lift + 0.3 * tall), (0, 0.002, (lift + 0.3 * tall) / 2)),
            box((wide, 0.12, 0.006), (0, 0, 0.003)),
        ]
    )
    return Model(
        [
            Part(moved(merge([ribs, *stubs]), stand), name, "trim", name),
            Part(foot, "bracket", "steel", "", "Connection assembly"),
        ],
        kind="plate heat exchanger",
    )


def _air_cooled(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A finned cooler: a bundle of thin fins between headers, a round fan shroud on top or in front, legs."""
    name = "heat exchanger"
    w, d, h = float(rng.uniform(0.8, 1.8)), float(rng.uniform(0.6, 1.2)), float(rng.uniform(0.12, 0.25))
    low = float(rng.uniform(0.5, 1.0))
    fins = merge([box((0.004, d, h), (x, 0, low + h / 2)) for x in np.linspace(-0.45 * w, 0.45 * w, 36)])
    heads = merge([box((0.08, d + 0.04, h + 0.06), (s * (w / 2 + 0.02), 0, low + h / 2)) for s in (-1, 1)])
    hood = merge(
        [
            box((w, d, 0.1), (0, 0, low + h + 0.05)),
            moved(ring(0.38 * min(w, d), 0.42 * min(w, d), low + h + 0.1, low + h + 0.25, style.round(0.4)), at()),
        ]
    )
    blades = moved(around(box((0.3 * min(w, d), 0.08, 0.006), (0.2 * min(w, d), 0, 0)), 5), at(0, 0, low + h + 0.2))
    legs = merge(
        [
            box((0.06, 0.06, low + h), (sx * (w / 2 + 0.02), sy * d / 2, (low + h) / 2))
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
    )
    mouths = [
        moved(p.solid, at(-w / 2 - 0.06, y, low + h / 2) @ spun("y", -np.pi / 2))
        for y in (-0.3 * d, 0.3 * d)
        for p in nozzle(40, 0.1, style)
    ]
    return Model(
        [
            Part(merge([heads, *mouths]), name, "tank", name),
            Part(fins, name, "trim", name),
            Part(merge([hood, blades]), "blower", "clamp", name),
            Part(legs, "column", "steel", "", "Structural element"),
        ],
        kind="air cooler",
    )


def _panel_radiator(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A panel radiator (EN 442): one or two ribbed plates with convector fins between, a grille and side covers."""
    name = "radiator"
    w, h = float(rng.choice([0.6, 0.8, 1.0, 1.4, 1.8])), float(rng.choice([0.3, 0.5, 0.6, 0.9]))
    count = int(rng.choice([1, 2, 2, 3]))
    low, gap = 0.12, 0.05
    pitch = 0.0333
    solids = []
    for k in range(count):
        y = k * gap
        steps = int(w / pitch)
        xs = np.linspace(-w / 2, w / 2, 4 * steps + 1)
        wave = np.tile([0.0, 0.0, 0.006, 0.006], steps)
        front = np.column_stack([xs, y - 0.004 - np.append(wave, 0.0)])
        back = np.column_stack([[w / 2, -w / 2], [y + 0.004, y + 0.004]])
        plate = np.vstack([front, back])
        solids.append(extrude(plate, low, low + h))
    panels = merge(solids)
    parts = [Part(panels, name, "dial", name)]
    if count > 1:
        fins = merge(
            [
                box((0.001, 0.6 * gap, 0.85 * h), (x, gap / 2 + j * gap, low + h / 2))
                for x in np.linspace(-0.48 * w, 0.48 * w, 24)
                for j in range(count - 1)
            ]
        )
        parts.append(Part(fins, name, "dial", name))
    deep = (count - 1) * gap + 0.02
    if rng.random() < 0.6:
        parts.append(Part(box((w, deep, 0.012), (0, (count - 1) * gap / 2, low + h + 0.006)), name, "dial", name))
        parts.append(
            Part(
                merge([box((0.004, deep, h), (s * w / 2, (count - 1) * gap / 2, low + h / 2)) for s in (-1, 1)]),
                name,
                "dial",
                name,
            )
        )
    stubs = merge(
        [
            rod((s * w / 2, 0, low + f * h), (s * (w / 2 + 0.03), 0, low + f * h), 0.011, 10)
            for s in (-1, 1)
            for f in (0.06, 0.94)
        ]
    )
    parts.append(Part(stubs, name, "trim", name))
    legs = merge([box((0.03, 0.06, low), (s * 0.35 * w, deep / 2, low / 2)) for s in (-1, 1)])
    parts.append(Part(legs, "bracket", "steel", "", "Connection assembly"))
    return Model(parts, kind="radiator")


def _column_radiator(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A column radiator: sections of two to four upright tubes between hubs, with feet; or a towel ladder."""
    name = "radiator"
    n = max(6, min(12, style.round(0.0125)))
    h = float(rng.choice([0.5, 0.6, 0.9, 1.5, 1.8]))
    low = 0.1
    if rng.random() < 0.7:
        count, columns = int(rng.integers(5, 14)), int(rng.integers(2, 5))
        pitch, gap = 0.046, 0.036
        section = []
        for c in range(columns):
            section.append(rod((0, c * gap, low + 0.03), (0, c * gap, low + h - 0.03), 0.0125, n))
        for z in (low + 0.02, low + h - 0.02):
            section.append(box((0.036, (columns - 1) * gap + 0.05, 0.05), (0, (columns - 1) * gap / 2, z)))
        one = merge(section)
        solids = [moved(one, at(k * pitch)) for k in range(count)]
        for z in (low + 0.02, low + h - 0.02):
            solids.append(
                rod((-0.04, (columns - 1) * gap / 2, z), (count * pitch, (columns - 1) * gap / 2, z), 0.017, n)
            )
        feet = [
            box((0.02, (columns - 1) * gap + 0.04, low), (k * pitch, (columns - 1) * gap / 2, low / 2))
            for k in (0, count - 1)
        ]
        return Model(
            [*(Part(s, name, "dial", name) for s in solids), Part(merge(feet), name, "dial", name)], kind="radiator"
        )
    w = float(rng.choice([0.45, 0.6]))
    rails = [rod((x, 0, low), (x, 0, low + h), 0.018, n) for x in (-w / 2, w / 2)]
    rungs = [
        rod((-w / 2, -0.01, z), (w / 2, -0.01, z), 0.011, n)
        for z in np.linspace(low + 0.05, low + h - 0.05, int(h / 0.06))
        if (z * 7) % 1.0 > 0.2
    ]
    return Model(
        [*(Part(s, name, "dial", name) for s in rails), Part(merge(rungs), name, "dial", name)], kind="radiator"
    )


def _boiler(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire-tube boiler with a burner, or a cabinet boiler with a flue."""
    name = "boiler"
    if rng.random() < 0.5:
        r = float(rng.uniform(0.4, 0.8))
        n, length = style.round(r), float(rng.uniform(2.2, 3.2)) * r
        axis = r + 0.25
        drum = along("x", cylinder(r, -length / 2, length / 2, n), 0, 0, axis)
        fronts = [along("x", cylinder(1.06 * r, x - 0.06, x + 0.06, n), 0, 0, axis) for x in (-length / 2, length / 2)]
        door = along("-x", ring(0.5 * r, 0.8 * r, length / 2 + 0.05, length / 2 + 0.1, n), 0, 0, axis)
        flue = moved(cylinder(0.22 * r, 0.0, 1.4 * r, n), at(0.35 * length, 0, axis + 0.9 * r))
        skid = [box((0.9 * length, 0.12, 0.26 + 0.3 * r), (0, s * 0.5 * r, (0.26 + 0.3 * r) / 2)) for s in (-1, 1)]
        deck = box((0.7 * length, 0.5 * r, 0.02), (0, 0, axis + 1.02 * r))
        mouths = [
            moved(p.solid, at(x, 0, axis + r)) for x in (-0.2 * length, 0.05 * length) for p in nozzle(80, 0.2, style)
        ]
        parts = [
            Part(merge([drum, *fronts, door, flue, *mouths]), name, "tank", name),
            Part(merge([*skid, deck]), name, "steel", name),
        ]
        for p in _burner_parts(0.32 * r, style, rng):
            parts.append(
                Part(
                    moved(p.solid, at(-length / 2 - 0.05, 0, axis) @ spun("z", np.pi)),
                    p.name,
                    p.color,
                    "burner",
                    p.group,
                    p.fine,
                )
            )
        ports = (Port(looking((-0.2 * length, 0, axis + r + 0.2), (0, 0, 1)), 80),)
        return Model(parts, ports=ports, kind="boiler")
    w, d, h = (float(rng.uniform(*span)) for span in ((0.45, 0.9), (0.4, 1.0), (0.8, 1.6)))
    case = moved(extrude(rounded_rectangle(w, d, 0.03, 3), 0.06, h), at())
    plinth = box((0.9 * w, 0.9 * d, 0.06), (0, 0, 0.03))
    door = box((0.85 * w, 0.02, 0.5 * h), (0, -d / 2 - 0.01, 0.4 * h))
    panel = box((0.8 * w, 0.03, 0.15 * h), (0, -d / 2 - 0.015, 0.82 * h))
    flue = moved(cylinder(0.07, h - 0.01, h + 0.6, style.round(0.07)), at(0.2 * w, 0.2 * d))
    stubs = [moved(cylinder(0.021, h - 0.01, h + 0.08, 12), at(x * w, 0.25 * d)) for x in (-0.35, -0.2, -0.05)]
    return Model(
        [
            Part(merge([case, plinth, flue, *stubs]), name, "dial", name),
            Part(merge([door, panel]), name, "electrical", name),
        ],
        kind="boiler",
    )


def _burner_parts(r: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A forced-draught burner about x, its flange at 0 and its head towards -x... the fan housing towards +x."""
    name, n = "burner", style.round(r)
    flange = along("x", cylinder(1.1 * r, 0.0, 0.02, n))
    snout = along("-x", cylinder(0.6 * r, 0.0, 0.8 * r, n))
    house = box((1.6 * r, 1.5 * r, 1.7 * r), (0.85 * r, 0, 0))
    scroll = along("y", cylinder(1.15 * r, -0.55 * r, 0.55 * r, n), 0.9 * r, 0, 0.15 * r)
    motor = along("y", turned([(0.45 * r, 0.5 * r), (0.45 * r, 1.6 * r), (0.35 * r, 1.7 * r)], n), 0.9 * r, 0, 0.15 * r)
    control = box((0.8 * r, 0.5 * r, 0.6 * r), (1.1 * r, -0.9 * r, 0.4 * r))
    train = rope(
        [(0.5 * r, -0.3 * r, -0.8 * r), (0.5 * r, -0.3 * r, -1.5 * r), (0.5 * r, -2.5 * r, -1.5 * r)], 0.16 * r, 10
    )
    return [
        Part(merge([flange, snout, house, scroll]), name, "handle", name),
        Part(merge([motor, control]), name, "motor", name),
        Part(train, name, "pipe", name),
    ]


def _burner(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    r = float(rng.uniform(0.1, 0.25))
    parts = _burner_parts(r, style, rng)
    lift = 1.8 * r + 0.3
    stand = merge(
        [
            box((0.06, 1.2 * r, lift - 0.8 * r), (0.8 * r, 0, (lift - 0.8 * r) / 2)),
            box((0.5, 1.4 * r, 0.02), (0.8 * r, 0, 0.01)),
        ]
    )
    moved_ = [Part(moved(p.solid, at(0, 0, lift)), p.name, p.color, p.bundle) for p in parts]
    return Model([*moved_, Part(stand, "bracket", "steel", "", "Connection assembly")], kind="burner")


def _housing(style: ModelingStyle, rng: np.random.Generator, r: float, tall: float, bag: bool) -> list[Part]:
    """A filter housing about z from its legs up: bowl, swing-bolt or band closure, lid with a vent."""
    name, n = "filter", style.round(r)
    low = 0.3 + 0.5 * r
    bowl = turned(
        [
            *((x, low + 0.5 * r - z) for x, z in head_profile("2:1", r)[::-1]),
            (r, low + tall),
            (1.2 * r, low + tall),
            (1.2 * r, low + tall + 0.03),
        ],
        n,
    )
    lid_profile = [
        (1.2 * r, low + tall + 0.033),
        (1.2 * r, low + tall + 0.06),
        *((x, z + low + tall + 0.06) for x, z in head_profile("flat" if bag else "2:1", 1.0 * r)),
    ]
    lid = turned([(x, z) for x, z in lid_profile if x > 0] + [(0.0, lid_profile[-1][1])], n)
    swing = around(
        merge(
            [
                rod((0, 0, low + tall - 0.06), (0, 0, low + tall + 0.1), 0.008, 8),
                moved(torus(0.02, 0.005, 10, 6), at(0, 0, low + tall + 0.11) @ spun("x", np.pi / 2)),
            ]
        ),
        4,
        1.2 * r,
    )
    legs = around(
        merge(
            [box((0.05, 0.05, low + 0.3 * tall), (0, 0, (low + 0.3 * tall) / 2)), box((0.1, 0.1, 0.01), (0, 0, 0.005))]
        ),
        3,
        r + 0.02,
    )
    vent = moved(
        merge([cylinder(0.01, 0, 0.06, 10), hexagon(0.024, 0.03, 0.05)]), at(0.3 * r, 0, lid_profile[-1][1] - 0.005)
    )
    return [
        Part(bowl, name, "trim", name),
        Part(merge([lid, vent]), name, "trim", name),
        Part(swing, "bolt", "fastener", name, "Connection assembly", True),
        Part(legs, "tank leg", "steel", name, "Tank"),
    ]


def _bag_filter(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    r, tall = float(rng.uniform(0.1, 0.3)), float(rng.uniform(0.4, 1.0))
    bag = bool(rng.random() < 0.6)
    parts = _housing(style, rng, r, tall, bag)
    dn = 50 if r > 0.15 else 25
    low = 0.3 + 0.5 * r
    reach, ports = 0.12, []
    for angle, z in ((0.0, low + 0.85 * tall), (np.pi, low + 0.2 * tall)):
        pose = spun("z", angle) @ at(r, 0, z) @ spun("y", np.pi / 2)
        parts += [Part(moved(p.solid, pose), "filter", "trim", "filter") for p in nozzle(dn, reach, style)]
        way = np.array([np.cos(angle), np.sin(angle), 0])
        ports.append(Port(looking(way * (r + reach) + (0, 0, z), way), dn))
    return Model(parts, ports=tuple(ports), kind="bag filter" if bag else "cartridge filter")


def _small_filter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small cartridge or air filter in a line: a head with two ends and a bowl below, maybe a gauge cap above."""
    radius = PIPES[dn].radius
    length, r = 0.09 + 3 * radius, 0.035 + 1.1 * radius
    n, x, name = style.round(r), 0.0, "filter"
    x = length / 2
    head = merge(
        [
            along("x", ring(bore_of(dn, style), 1.3 * radius, 0, length, style.round(radius))),
            moved(turned([(r, -0.4 * r), (1.08 * r, -0.3 * r), (1.08 * r, 0.7 * r), (0.9 * r, 0.9 * r)], n), at(x)),
        ]
    )
    deep = float(rng.choice([2.0, 4.0, 6.0])) * r
    bowl = turned([(0.6 * r, -deep), (0.9 * r, -0.93 * deep), (0.98 * r, -0.4 * r)], n)
    drain = moved(hexagon(0.3 * r + 0.006, -deep - 0.015, -deep + 0.01), at(x))
    return Model(
        [
            Part(head, name, "rubber", name),
            Part(moved(bowl, at(x)), name, "dial", name),
            Part(drain, name, "trim", name),
        ],
        round(length, 6),
        "welded",
        "cartridge filter",
    )


def _cyclone(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cyclone: a cylinder over a long cone, a tangential inlet, a pipe out of the top, legs."""
    name, r = "separator", float(rng.uniform(0.15, 0.5))
    n, low = style.round(r), float(rng.uniform(0.3, 0.6))
    cone, tall = 2.4 * r, 1.4 * r
    body = turned([(0.2 * r, low), (0.25 * r, low + 0.05), (r, low + cone), (r, low + cone + tall)], n)
    top = turned(
        [
            (0.45 * r, low + cone + tall - 0.01),
            (0.45 * r, low + cone + tall + 0.6 * r),
            (0.6 * r, low + cone + tall + 0.6 * r),
            (0.6 * r, low + cone + tall + 0.63 * r),
        ],
        n,
    )
    inlet = merge(
        [
            box((1.4 * r, 0.4 * r, 0.8 * r), (-0.8 * r, 0.78 * r, low + cone + 0.85 * tall - 0.3 * r)),
            box((0.03, 0.55 * r, 0.95 * r), (-1.5 * r, 0.78 * r, low + cone + 0.85 * tall - 0.3 * r)),
        ]
    )
    pot = turned([(0.32 * r, low - 0.25), (0.32 * r, low + 0.02)], n)
    legs = [
        rod(
            (1.05 * r * np.cos(a), 1.05 * r * np.sin(a), 0),
            (1.05 * r * np.cos(a), 1.05 * r * np.sin(a), low + cone + 0.2 * tall),
            0.03,
            8,
        )
        for a in (0.6, 2.7, 4.7)
    ]
    return Model(
        [
            Part(merge([body, top, inlet]), name, "tank", name),
            Part(pot, name, "tank", name),
            Part(merge(legs), "tank leg", "steel", "", "Tank"),
        ],
        kind="cyclone separator",
    )


def _separator(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An in-line air or steam separator: an upright bulb across the line with a vent above and a drain below."""
    name, radius = "separator", PIPES[dn].radius
    r = 1.7 * radius + 0.03
    n = style.round(r)
    from cadplants.families.valves.valve import flanged_body
    from cadplants.flange import nut_room, plate_thickness

    length = 2 * (r + plate_thickness(dn) + nut_room(dn) + 0.01)
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
    up, down = float(rng.uniform(1.2, 2.5)) * r, float(rng.uniform(1.2, 3.0)) * r
    bulb = turned(
        [
            (0.2 * r, -down - 0.5 * r),
            (0.7 * r, -down - 0.3 * r),
            (r, -down),
            (r, up),
            (0.7 * r, up + 0.3 * r),
            (0.2 * r, up + 0.5 * r),
        ],
        n,
    )
    ends = merge(
        [
            hexagon(0.05, up + 0.45 * r, up + 0.45 * r + 0.04),
            cylinder(0.014, -down - 0.5 * r - 0.06, -down - 0.4 * r, 10),
        ]
    )
    return Model(
        [
            Part(merge([body, moved(bulb, at(length / 2))]), name, "tank", name),
            Part(moved(ends, at(length / 2)), name, "trim", name),
        ],
        round(length, 6),
        kind="separator",
    )


def _family(
    name: str, build: object, place: str = "floor", sizes: tuple[int, ...] = (15,), weight: float = 1.0
) -> Family:
    return Family(name, place, _GROUP, name.split("/")[0], build, sizes, weight=weight)  # type: ignore[arg-type]


EQUIPMENT: tuple[Family, ...] = (
    _family("heat exchanger/shell-and-tube", _shell_tube, weight=2),
    _family("heat exchanger/plate", _plate, weight=1.5),
    _family("heat exchanger/brazed", _brazed),
    _family("heat exchanger/air cooled", _air_cooled),
    _family("radiator/panel", _panel_radiator, weight=1.2),
    _family("radiator/column", _column_radiator, weight=1.2),
    _family("boiler/packaged", _boiler, weight=1.8),
    _family("burner/forced draught", _burner, weight=1.5),
    _family("filter/housing", _bag_filter, weight=1.5),
    _family("filter/bowl", _small_filter, "inline", (15, 20, 25, 32, 40), 1.2),
    _family("separator/cyclone", _cyclone, weight=1.5),
    _family("separator/inline", _separator, "inline", tuple(dn for dn in SIZES if 25 <= dn <= 150)),
)
