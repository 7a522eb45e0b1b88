"""Radiators, duct coils and cooling towers."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.exchangers import equipment_family, equipment_mouth
from cadplants.families.vessels.vessel_fittings import sides
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["RADIATORS", "wall_behind"]

_FRAME, _JOINT, _PIPE = "Structural element", "Connection assembly", "Pipe assembly"
_HEX, _RAD = "heat exchanger", "radiator"


def wall_behind(w: float, h: float, y: float) -> Part:
    """A piece of wall whose face is at ``y``, looking to -y."""
    return Part(box((w, 0.12, h), (0, y + 0.06, h / 2)), "wall", "concrete", "", _FRAME)


def _valve(x: float, y: float, z: float, s: int) -> list[Part]:
    """A thermostatic or lockshield radiator valve with its pipe from the floor."""
    body = merge(
        [rod((x - s * 0.045, y, z), (x, y, z), 0.011, 10), rod((x, y, z - 0.03), (x, y, z + 0.012), 0.013, 10)]
    )
    knob = along("x" if s > 0 else "-x", turned([(0.02, 0.01), (0.023, 0.06), (0.015, 0.07)], 16), x, y, z)
    pipe = rod((x, y, 0), (x, y, z - 0.03), 0.0075, 8)
    return [
        Part(merge([body, knob]), "valve", "trim", "", "Valve assembly"),
        Part(pipe, "pipe", "pipe", "", _PIPE),
    ]


def _towel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A towel rail (EN 442): round, D or flat bars in groups between two rails, on wall brackets, valves below."""
    w, h, low = float(rng.choice([0.4, 0.5, 0.6])), float(rng.choice([0.8, 1.2, 1.5, 1.8])), 0.25
    n, groups, kind = max(6, min(12, style.round(0.015))), int(rng.integers(2, 5)), int(rng.integers(3))
    rails = [rod((x, 0, low), (x, 0, low + h), 0.019, n) for x in (-w / 2, w / 2)]
    if rng.random() < 0.4:
        rails = [box((0.04, 0.03, h), (x, 0, low + h / 2)) for x in (-w / 2, w / 2)]
    bow = float(rng.choice([0.0, 0.05, 0.08]))
    bars = []
    edges = np.linspace(low + 0.03, low + h - 0.03, groups + 1)
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        for z in np.linspace(a, b - 0.09, max(2, int((b - a - 0.09) / 0.042))):
            if kind == 2:
                bars.append(box((w, 0.012, 0.03), (0, -0.016, z)))
                continue
            t = np.linspace(-1, 1, 7 if bow else 2)
            path = np.column_stack([t * w / 2, -bow * (1 - t * t) - (0.012 if kind else 0.0), np.full(len(t), z)])
            bars.append(rope(path, 0.011, n))
    stand = 0.09
    holders = [
        rod((s * w / 2, 0, z), (s * w / 2, stand, z), 0.009, 8)
        for s in (-1, 1)
        for z in (bars[0].vertices[:, 2].mean(), bars[-1].vertices[:, 2].mean())
    ]
    parts = [*(Part(r, _RAD, "dial", _RAD) for r in rails), Part(merge(bars), _RAD, "dial", _RAD)]
    parts += [Part(merge(holders), "bracket", "trim", "", _JOINT), wall_behind(w + 0.8, low + h + 0.4, stand)]
    for x in (-w / 2, w / 2):
        body = merge([cylinder(0.012, low - 0.09, low + 0.002, 10), hexagon(0.026, low - 0.04, low - 0.015)])
        parts.append(Part(moved(body, at(x)), "valve", "trim", "", "Valve assembly"))
        parts.append(Part(rod((x, 0, 0), (x, 0, low - 0.09), 0.0075, 8), "pipe", "pipe", "", _PIPE))
    return Model(parts, kind="towel radiator")


def _convector(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A convector: a sheet case with a louvred outlet above, a finned tube inside, on feet or a wall."""
    w, h, d = float(rng.uniform(0.6, 1.8)), float(rng.uniform(0.2, 0.7)), float(rng.uniform(0.08, 0.2))
    low, t = float(rng.uniform(0.06, 0.12)), 0.003
    case = merge(
        [box((w, t, h), (0, s * (d / 2 - t / 2), low + h / 2)) for s in (-1, 1)]
        + [box((t, d, h), (s * (w / 2 - t / 2), 0, low + h / 2)) for s in (-1, 1)]
    )
    bars = [
        box((w - 2 * t, 0.003, 0.02), (0, y, low + h - 0.01))
        for y in np.linspace(-d / 2 + 0.012, d / 2 - 0.012, max(4, int(d / 0.014)))
    ]
    bars += [box((0.004, d - 0.004, 0.018), (x, 0, low + h - 0.011)) for x in np.linspace(-0.4, 0.4, 5) * w]
    fins = [box((0.001, 0.85 * d, 0.1), (x, 0, low + 0.08)) for x in np.linspace(-0.44, 0.44, 40) * w]
    tubes = [
        rod((-w / 2 - 0.05, y, low + 0.08), (w / 2 - 0.02, y, low + 0.08), 0.0107, 10) for y in (-0.2 * d, 0.2 * d)
    ]
    parts = [
        Part(case, _RAD, "dial", _RAD),
        Part(merge(bars), _RAD, "clamp", _RAD),
        Part(merge([*fins, *tubes]), _RAD, "trim", _RAD),
    ]
    for k, y in enumerate((-0.2 * d, 0.2 * d)):
        parts += _valve(-w / 2 - 0.06, y, low + 0.08, -1) if k == 0 else []
    if rng.random() < 0.6:
        feet = [box((0.04, 0.9 * d, low + 0.01), (s * 0.35 * w, 0, (low + 0.01) / 2)) for s in (-1, 1)]
        parts.append(Part(merge(feet), "bracket", "steel", "", _JOINT))
    else:
        parts.append(wall_behind(w + 0.6, 1.2, d / 2))
        lift = at(0, 0, float(rng.uniform(0.0, 0.2)))
        parts = [*placed(parts[:3], lift), *parts[5:]]
    return Model(parts, kind="convector")


def _finned_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Finned tubes as heaters of halls: one to four rows with round or square fins, return bends, on wall brackets."""
    length, rows = float(rng.uniform(1.0, 3.0)), int(rng.integers(1, 5))
    r, fin = float(rng.choice([0.017, 0.024, 0.03])), float(rng.uniform(0.045, 0.075))
    pitch, low, n = 2.5 * fin, float(rng.uniform(0.25, 0.5)), style.round(fin)
    square, count = bool(rng.random() < 0.5), int(np.clip(length / 0.02, 30, 90))
    zs = low + pitch * np.arange(rows)
    one = box((0.0015, 1.9 * fin, 1.9 * fin)) if square else along("x", cylinder(fin, -0.001, 0.001, min(n, 16)))
    row = merge([moved(one, at(x)) for x in np.linspace(-0.46, 0.46, count) * length])
    parts = []
    for z in zs:
        tube = rod((-length / 2 - 0.02, 0, z), (length / 2 + 0.02, 0, z), r, style.round(r))
        parts.append(Part(merge([moved(row, at(0, 0, z)), tube]), _RAD, "steel", _RAD))
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    for k in range(rows - 1):
        path = np.column_stack(
            [length / 2 + 0.02 + pitch / 2 * np.cos(a), np.zeros(9), (zs[k] + zs[k + 1]) / 2 + pitch / 2 * np.sin(a)]
        )
        path[:, 0] *= (1, -1)[k % 2]
        parts.append(Part(rope(path, r, style.round(r)), "elbow", "pipe", "", _PIPE))
    wall, holders = fin + 0.05, []
    for x in (-0.485 * length, 0.485 * length):
        holders.append(box((0.03, 0.006, zs[-1] - zs[0] + 0.16), (x, wall - 0.003, (zs[0] + zs[-1]) / 2)))
        holders += [box((0.03, wall, 0.006), (x, wall / 2, z - r - 0.002)) for z in zs]
    parts += [Part(merge(holders), "bracket", "steel", "", _JOINT), wall_behind(length + 0.6, zs[-1] + 0.5, wall)]
    return Model(parts, kind="finned tube heater")


def _cast(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cast-iron radiator: rounded sections of two to six columns with waists, cast feet on the end ones, plugs."""
    count, columns = int(rng.integers(4, 14)), int(rng.choice([2, 3, 4, 6]))
    h, pitch, gap = (
        float(rng.choice([0.36, 0.5, 0.7, 0.9])),
        float(rng.uniform(0.05, 0.07)),
        float(rng.uniform(0.036, 0.05)),
    )
    n, low, deep = max(8, min(12, style.round(0.02))), 0.09, (columns - 1) * gap
    wide = 0.42 * pitch
    shaft = turned(
        [
            (0.55 * wide, 0.0),
            (wide, 0.05),
            (0.8 * wide, 0.12 * h),
            (0.8 * wide, 0.88 * h),
            (wide, h - 0.05),
            (0.55 * wide, h),
        ],
        n,
    )
    squeeze = np.diag([1.0, 0.8 * gap / (2 * wide) * 1.2, 1.0, 1.0])
    section = [moved(shaft, at(0, c * gap, low) @ squeeze) for c in range(columns)]
    for z in (low + 0.05, low + h - 0.05):
        section.append(
            moved(extrude(rounded_rectangle(pitch, deep + gap, 0.4 * gap, 3), -0.022, 0.022), at(0, deep / 2, z))
        )
    if columns > 2:
        section.append(box((0.5 * wide, deep, 0.02), (0, deep / 2, low + h / 2)))
    one = merge(section)
    parts = [Part(moved(one, at(k * pitch)), _RAD, "dial", _RAD) for k in range(count)]
    foot = lofted(
        [
            np.array([(x * s, y * s, z) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])
            for s, z in ((0.05, 0.0), (0.035, 0.03), (0.03, low + 0.04))
        ]
    )
    feet = [moved(foot, at(k * pitch, y)) for k in (0, count - 1) for y in (0.0, deep)]
    parts.append(Part(merge(feet), _RAD, "dial", _RAD))
    plugs = [
        along(
            "x" if s > 0 else "-x",
            merge([cylinder(0.024, 0.0, pitch / 2 + 0.012, 12), hexagon(0.036, pitch / 2 + 0.01, pitch / 2 + 0.03)]),
            x,
            deep / 2,
            z,
        )
        for s, x in ((-1, 0.0), (1, (count - 1) * pitch))
        for z in (low + 0.05, low + h - 0.05)
    ]
    parts.append(Part(merge(plugs), _RAD, "trim", _RAD))
    s = int(rng.choice([-1, 1]))
    end = 0.0 if s < 0 else (count - 1) * pitch
    parts += _valve(end + s * (pitch / 2 + 0.075), deep / 2, low + 0.05, s)
    return Model(parts, kind="cast radiator")


def _plinth(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A skirting or bench radiator: long flat or round tubes on edge, on consoles, maybe a grille."""
    w, rows, cols = float(rng.uniform(0.8, 2.4)), int(rng.choice([1, 2, 3])), int(rng.integers(2, 5))
    low, gap = 0.1, 0.035
    flat = bool(rng.random() < 0.6)
    tubes: list[Solid] = []
    for i in range(rows):
        for j in range(cols):
            y, z = j * gap, low + 0.04 + i * 0.075
            tubes.append(box((w, 0.011, 0.07), (0, y, z)) if flat else rod((-w / 2, y, z), (w / 2, y, z), 0.0125, 10))
    tall, deep = rows * 0.075, (cols - 1) * gap
    ends = [box((0.035, deep + 0.03, tall), (s * (w / 2 + 0.012), deep / 2, low + tall / 2)) for s in (-1, 1)]
    fins = [
        box((0.001, 0.7 * gap, 0.06), (x, (j + 0.5) * gap, low + 0.04))
        for x in np.linspace(-0.45, 0.45, 30) * w
        for j in range(cols - 1)
    ]
    parts = [
        *(Part(t, _RAD, "dial", _RAD) for t in ([merge(tubes)] if rng.random() < 0.6 else tubes)),
        Part(merge(ends), _RAD, "dial", _RAD),
    ]
    if rng.random() < 0.6:
        parts.append(Part(merge(fins), _RAD, "dial", _RAD))
    if rng.random() < 0.4:
        slats = [
            box((0.018, deep + 0.03, 0.006), (x, deep / 2, low + tall + 0.003))
            for x in np.arange(-w / 2 + 0.02, w / 2, 0.03)
        ]
        parts.append(
            Part(
                merge([*slats, *(box((w, 0.012, 0.006), (0, y, low + tall + 0.003)) for y in (0.0, deep))]),
                _RAD,
                "clamp",
                _RAD,
            )
        )
    feet = [
        merge(
            [
                box((0.03, deep + 0.02, low + 0.006), (s * 0.36 * w, deep / 2, (low + 0.006) / 2)),
                box((0.08, deep + 0.08, 0.005), (s * 0.36 * w, deep / 2, 0.0025)),
            ]
        )
        for s in (-1, 1)
    ]
    parts.append(Part(merge(feet), "bracket", "steel", "", _JOINT))
    parts += _valve(w / 2 + 0.074, deep / 2, low + 0.04, 1)
    return Model(parts, kind="plinth radiator")


# --- air and water ---


def _duct_coil(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A finned coil for a duct: a flanged sheet frame, fins across many rows, return bends at one end, two headers."""
    w, h, rows = float(rng.uniform(0.5, 1.4)), float(rng.uniform(0.4, 1.0)), int(rng.choice([2, 3, 4, 6]))
    deep, low = 0.05 + 0.033 * rows, float(rng.uniform(0.08, 0.4))
    plates = [box((w, deep, 0.003), (0, 0, low + z)) for z in (0.0, h)] + [
        box((0.003, deep, h), (s * w / 2, 0, low + h / 2)) for s in (-1, 1)
    ]
    hems = [box((w + 0.06, 0.003, 0.03), (0, s * deep / 2, low + z)) for s in (-1, 1) for z in (-0.013, h + 0.013)]
    hems += [box((0.03, 0.003, h), (t * (w / 2 + 0.015), s * deep / 2, low + h / 2)) for s in (-1, 1) for t in (-1, 1)]
    fins = [box((0.001, 0.8 * deep, h - 0.004), (x, 0, low + h / 2)) for x in np.linspace(-0.48, 0.48, 60) * w]
    bends = []
    a = np.linspace(-np.pi / 2, np.pi / 2, 5)
    for y in (np.arange(rows) - (rows - 1) / 2) * 0.033:
        for z in np.arange(low + 0.05, low + h - 0.04, 0.075):
            path = np.column_stack([w / 2 + 0.02 * np.cos(a), np.full(5, y), z + 0.019 * np.sin(a)])
            bends.append(rope(path, 0.0065, 6))
    r = 0.017 + 0.01 * h
    heads, stubs = [], []
    for s in (-1, 1):
        y = s * (deep / 2 + r + 0.005)
        heads.append(rod((-w / 2 - 0.05, y, low + 0.04), (-w / 2 - 0.05, y, low + h - 0.04), r, style.round(r)))
        z = low + (0.1 if s > 0 else h - 0.1)
        stubs.append(rod((-w / 2 - 0.05, y, z), (-w / 2 - 0.2, y, z), 0.8 * r, style.round(r)))
        stubs += [
            rod((-w / 2 + 0.002, s * 0.3 * deep, z), (-w / 2 - 0.05, y, z), 0.006, 6)
            for z in np.arange(low + 0.06, low + h - 0.05, 0.08)
        ]
    legs = [box((0.05, deep, low - 0.0015), (s * 0.4 * w, 0, (low - 0.0015) / 2)) for s in (-1, 1)]
    return Model(
        [
            Part(merge([*plates, *hems]), _HEX, "clamp", _HEX),
            Part(merge(fins), _HEX, "trim", _HEX),
            Part(merge(bends), _HEX, "pipe", _HEX),
            Part(merge([*heads, *stubs]), _HEX, "pipe", _HEX),
            Part(merge(legs), "bracket", "steel", "", _JOINT),
        ],
        kind="duct coil",
    )


def _cooling_tower(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cooling tower: round (bottle) or square, a basin, louvres, a casing, a fan ring on top, an inlet."""
    r, name = float(rng.uniform(0.6, 1.3)), _HEX
    h, low, n = r * float(rng.uniform(1.4, 2.2)), float(rng.uniform(0.2, 0.5)), sides(style, r)
    round_one = bool(rng.random() < 0.5)
    fan = 0.5 * r
    solids: list[Solid] = []
    if round_one:
        basin = turned([(0.8 * r, low), (1.05 * r, low + 0.15), (1.05 * r, low + 0.35)], n)
        casing = turned([(r, low + 0.6), (1.02 * r, low + 0.65), (0.95 * r, low + 0.75 * h), (fan + 0.02, low + h)], n)
        louvres = around(box((0.02, 0.05, 0.3), (0, 0, low + 0.475)), 24, 0.97 * r)
        feet = around(box((0.1, 0.1, low + 0.12), (0, 0, (low + 0.12) / 2)), 6, 0.85 * r)
    else:
        basin = box((2.1 * r, 2.1 * r, 0.35), (0, 0, low + 0.175))
        casing = merge(
            [
                box((2 * r, 2 * r, 0.45 * h), (0, 0, low + 0.765 * h)),
                *(
                    box((0.06, 0.06, h - 0.34), (sx * (r - 0.03), sy * (r - 0.03), low + 0.34 + (h - 0.35) / 2))
                    for sx in (-1, 1)
                    for sy in (-1, 1)
                ),
            ]
        )
        slat = moved(box((1.9 * r, 0.12, 0.01)), spun("x", 0.8))
        rows = np.linspace(low + 0.42, low + 0.52 * h, 6)
        louvres = merge(
            [moved(slat, spun("z", q * np.pi / 2) @ at(0, -r + 0.06, float(z))) for q in range(4) for z in rows]
        )
        feet = merge(
            [
                box((0.15, 0.15, low + 0.001), (sx * 0.95 * r, sy * 0.95 * r, low / 2))
                for sx in (-1, 1)
                for sy in (-1, 1)
            ]
        )
    top = low + h
    if not round_one:
        top = low + 0.99 * h
    solids += [casing, ring(fan, fan + 0.03, top - 0.02, top + 0.25, n)]
    blades = around(
        moved(box((0.85 * fan, 0.2 * fan, 0.01), (0.45 * fan, 0, 0)), spun("x", 0.4)), int(rng.choice([4, 6]))
    )
    hub = merge(
        [
            cylinder(0.15 * fan, top - 0.01, top + 0.17, 16),
            moved(blades, at(0, 0, top + 0.12)),
            box((2.05 * fan, 0.05, 0.04), (0, 0, top)),
        ]
    )
    motor = cylinder(0.13 * fan + 0.05, top + 0.16, top + 0.42, 16)
    parts = [
        Part(merge(solids), name, "dial", name),
        Part(basin, name, "dial", name),
        Part(louvres, name, "dial", name),
        Part(feet, "tank leg", "steel", name, "Tank"),
        Part(hub, "blower", "clamp", name),
        Part(motor, "motor", "motor", name, "Pump unit"),
    ]
    ports: list[Port] = []
    for z, a in ((low + 0.7 * h, 0.0), (low + 0.2, np.pi / 2)):
        reach = (0.93 * r if round_one else r) if z > low + 0.5 else (1.04 if round_one else 1.05) * r
        pose = spun("z", a) @ at(reach, 0, z) @ spun("y", np.pi / 2)
        some, port = equipment_mouth(
            name, int(rng.choice([50, 65, 80])), pose, style, r if round_one else 0.0, 0.05 * r
        )
        parts += some
        ports += port
    return Model(parts, ports=tuple(ports), kind="cooling tower")


RADIATORS: tuple[Family, ...] = (
    equipment_family("heat exchanger/duct coil", _duct_coil),
    equipment_family("heat exchanger/cooling tower", _cooling_tower),
    equipment_family("radiator/towel rail", _towel, 0.9),
    equipment_family("radiator/convector", _convector, 0.9),
    equipment_family("radiator/finned tube", _finned_tube, 0.9),
    equipment_family("radiator/cast", _cast, 1.0),
    equipment_family("radiator/plinth", _plinth, 0.8),
)
