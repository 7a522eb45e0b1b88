"""Tanks of plates and panels, hoppers, drums, fuel tanks, buried tanks."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.vessels.exchangers import frame_of
from cadplants.families.vessels.vessel_fittings import head, head_height, lug, manway, mouth, sides
from cadplants.families.vessels.vesselbuild import outlet, tank_family
from cadplants.families.vessels.vesselfeet import bar, ladder_parts
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved, weld
from cadplants.mesh_ops import loft as skin
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import along, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["PLATE_TANKS"]

_FRAME, _JOINT = "Structural element", "Connection assembly"
_SQUARE = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


def _loop(w: float, d: float, z: float) -> Floats:
    """A rectangle on a height [m]."""
    return np.column_stack([_SQUARE * (w, d), np.full(4, z)])


def _bucket(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bin or bucket hopper: a box or none over a pyramid, open or lidded, on a frame, a gate below."""
    w, d = float(rng.uniform(0.7, 1.8)), float(rng.uniform(0.7, 1.5))
    out, cone, tall = float(rng.uniform(0.2, 0.35)), float(rng.uniform(0.6, 1.2)), float(rng.choice([0.06, 0.4, 0.8]))
    low, t = float(rng.uniform(0.6, 1.1)), 0.012
    z, top = low + cone, low + cone + tall
    loops = [_loop(out, out, low), _loop(w, d, z), _loop(w, d, top)]
    inner = [_loop(out - 2 * t, out - 2 * t, low), _loop(w - 2 * t, d - 2 * t, z), _loop(w - 2 * t, d - 2 * t, top)]
    body = weld([skin([*loops, *inner[::-1]], closed=True)])
    parts = [Part(body, "shell", "tank", "tank")]
    rim = extrude(_SQUARE * (w + 0.1, d + 0.1), top - 0.012, top, (_SQUARE * (w - 0.001, d - 0.001),))
    stiff = [extrude(_SQUARE * (w + 0.07, d + 0.07), z - 0.03, z + 0.03, (_SQUARE * (w - 0.004, d - 0.004),))]
    parts.append(Part(merge([rim, *stiff]), "shell", "tank", "tank"))
    if rng.random() < 0.5:
        lid = box((w + 0.1, d + 0.1, 0.006), (0, 0, top + 0.003))
        parts.append(Part(lid, "shell", "tank", "tank"))
        parts += placed(manway("hatch", 0.2, style, rng), at(0.2 * w, 0, top + 0.006))
    flange = extrude(_SQUARE * (out + 0.12, out + 0.12), low - 0.012, low, (_SQUARE * (out - 2 * t, out - 2 * t),))
    gate = merge(
        [
            box((out + 0.5, out + 0.06, 0.012), (0.2, 0, low - 0.018)),
            rod((out / 2 + 0.4, -0.1, low - 0.018), (out / 2 + 0.4, 0.1, low - 0.018), 0.012, 8),
        ]
    )
    parts.append(Part(flange, "nozzle", "flange", "nozzle"))
    parts.append(Part(gate, "valve", "steel", "", "Valve assembly"))
    side = 0.08
    frame = frame_of(w + 0.07 + 2 * side, d + 0.07 + 2 * side, z + 0.03, side, rails=False)
    parts.append(Part(frame, "tank leg", "steel", "tank leg"))
    beams = [box((w + 0.07, side, side), (0, s * (d + 0.07 + side) / 2, z - 0.01)) for s in (-1, 1)]
    beams += [box((side, d + 0.07, side), (s * (w + 0.07 + side) / 2, 0, z - 0.01)) for s in (-1, 1)]
    parts.append(Part(merge(beams), "beam", "steel", "", _FRAME))
    if rng.random() < 0.5:
        x, y = (w + 0.07 + side) / 2, (d + 0.07 + side) / 2
        flat = rounded_rectangle(0.05, 0.01, 0.0)
        for s in (-1, 1):
            parts.append(Part(bar((-x, s * y, 0.1), (x, s * y, z - 0.1), flat), "brace", "steel", "", _FRAME))
    return Model(parts, kind="hopper")


def _braced(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rectangular tank of corrugated or stiffened plate: wall ribs or waves, a rim, tie bars."""
    w, d, h = (float(rng.uniform(*span)) for span in ((1.2, 3.2), (0.9, 1.8), (0.8, 1.8)))
    base, t = float(rng.choice([0.12, 0.2])), 0.01
    waves = bool(rng.random() < 0.5)
    outer = _SQUARE * (w, d)
    if waves:
        count = int(w / 0.3)
        xs = np.linspace(-w / 2, w / 2, 4 * count + 1)
        dent = np.tile([0.0, 0.0, 0.04, 0.04], count)
        near = np.column_stack([xs[:-1], -d / 2 - dent])
        outer = np.vstack([near, [(w / 2, -d / 2)], -near, [(-w / 2, d / 2)]])
    shell = extrude(outer, base, base + h, (_SQUARE * (w - 2 * t, d - 2 * t),))
    floor = box((w - 2 * t + 0.002, d - 2 * t + 0.002, 0.01), (0, 0, base + 0.005))
    parts = [Part(merge([shell, floor]), "shell", "tank", "tank")]
    rim = extrude(_SQUARE * (w + 0.16, d + 0.16), base + h - 0.01, base + h + 0.01, (_SQUARE * (w - 2 * t, d - 2 * t),))
    parts.append(Part(rim, "shell", "tank", "tank"))
    if not waves:
        section = section_angle(0.06, 0.006) if rng.random() < 0.5 else section_channel(0.08, 0.05, 0.006, 0.006)
        section = section - section.mean(axis=0)
        rib = moved(extrude(section, base, base + h - 0.01), at(0, -d / 2 - 0.025))
        for x in np.linspace(-0.44, 0.44, max(3, int(w / 0.5))) * w:
            parts += [
                Part(moved(rib, at(x) if s else at(x) @ spun("z", np.pi)), "shell", "tank", "tank") for s in (0, 1)
            ]
    ties = [
        rod((x, -d / 2, base + 0.8 * h), (x, d / 2, base + 0.8 * h), 0.015, 8) for x in np.linspace(-0.25, 0.25, 2) * w
    ]
    parts.append(Part(merge(ties), "shell", "steel", "tank"))
    skids = [box((0.12, d, base), (x, 0, base / 2)) for x in np.linspace(-0.42, 0.42, 3) * w]
    parts.append(Part(merge(skids), "tank leg", "steel", "tank leg"))
    if rng.random() < 0.5:
        lid = box((w + 0.1, d + 0.1, 0.005), (0, 0, base + h + 0.0125))
        parts.append(Part(lid, "shell", "tank", "tank"))
        parts += placed(manway("hatch", 0.25, style, rng), at(0.25 * w, 0, base + h + 0.015))
    ports: list[Port] = []
    for s, f in ((-1, 0.2), (1, 0.75)):
        some, port = outlet(
            "plain",
            int(rng.choice([40, 50, 80])),
            at(s * w / 2, 0, base + max(0.13, f * h)) @ spun("y", s * np.pi / 2),
            style,
        )
        parts += some
        ports += port
    if base + h > 1.5:
        parts += placed(
            ladder_parts(0.0, 0.0, base + h + 0.6, style, False, 0.12), at(-0.2 * w, -d / 2 - 0.17, 0) @ spun("z", -np.pi / 2)
        )
    return Model(parts, ports=tuple(ports), kind="rectangular tank")


def _panel(w: float, h: float) -> Solid:
    """A pressed panel in the plane x-z, its boss towards -y."""
    loops = [(w, h, 0.0), (w, h, 0.012), (0.9 * w, 0.9 * h, 0.014), (0.6 * w, 0.6 * h, 0.05), (0.2 * w, 0.2 * h, 0.055)]
    solid = lofted([_loop(a, b, z) for a, b, z in loops])
    return moved(solid, spun("x", np.pi / 2))


def _sectional(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sectional water tank of pressed panels (BS 7491): bolted seams, a roof of panels, beams on dwarf walls."""
    cols, deep, rows = int(rng.integers(2, 5)), int(rng.integers(1, 4)), int(rng.integers(1, 3))
    p = float(rng.choice([0.5, 1.0])) if cols + deep > 5 else 1.0
    p = min(p, 0.75) if rng.random() < 0.4 else p
    w, d, h = cols * p, deep * p, rows * p
    base = float(rng.uniform(0.35, 0.6))
    one = _panel(p, p)
    panels = []
    for k in range(rows):
        z = base + (k + 0.5) * p
        for i in range(cols):
            x = -w / 2 + (i + 0.5) * p
            panels += [moved(one, at(x, -d / 2, z)), moved(one, at(x, d / 2, z) @ spun("z", np.pi))]
        for j in range(deep):
            y = -d / 2 + (j + 0.5) * p
            panels += [
                moved(one, at(-w / 2, y, z) @ spun("z", -np.pi / 2)),
                moved(one, at(w / 2, y, z) @ spun("z", np.pi / 2)),
            ]
    roof = [
        moved(one, at(-w / 2 + (i + 0.5) * p, -d / 2 + (j + 0.5) * p, base + h) @ spun("x", -np.pi / 2))
        for i in range(cols)
        for j in range(deep)
    ]
    floor = box((w + 0.02, d + 0.02, 0.02), (0, 0, base - 0.0))
    posts = [box((0.06, 0.06, h), (sx * w / 2, sy * d / 2, base + h / 2)) for sx in (-1, 1) for sy in (-1, 1)]
    single = bool(rng.random() < 0.5)
    walls = [merge(panels)] if single else panels
    parts = [*(Part(s, "shell", "dial", "tank") for s in walls), Part(merge(roof), "shell", "dial", "tank")]
    parts.append(Part(merge([floor, *posts]), "shell", "steel", "tank"))
    beam = section_i(0.12, 0.1, 0.006, 0.009)
    dwarf = base - 0.01 - 0.12
    for x in np.linspace(-w / 2 + 0.06, w / 2 - 0.06, cols + 1):
        solid = moved(extrude(beam, -d / 2 - 0.1, d / 2 + 0.1), at(x, 0, base - 0.07) @ spun("x", -np.pi / 2))
        parts.append(Part(solid, "beam", "steel", "", _FRAME))
    piers = np.linspace(-d / 2, d / 2, max(2, deep))
    parts += [Part(box((w + 0.2, 0.2, dwarf), (0, y, dwarf / 2)), "foundation", "concrete", "", _FRAME) for y in piers]
    parts += placed(manway("hatch", 0.25, style, rng), at(w / 2 - p / 2, d / 2 - p / 2, base + h + 0.05))
    some, ports = outlet("plain", 80, at(w / 2 + 0.05, -d / 2 + p / 2, base + 0.5 * p) @ spun("y", np.pi / 2), style)
    gap = 0.15
    parts += placed(
        ladder_parts(0.0, 0.0, base + h + 0.7, style, False, gap),
        at(-w / 2 + p / 2, -d / 2 - gap - 0.02, 0) @ spun("z", -np.pi / 2),
    )
    return Model([*parts, *some], ports=tuple(ports), kind="sectional tank")


def _drum(style: ModelingStyle, rng: np.random.Generator, kind: int) -> list[Part]:
    """A 200 l drum (ISO 15750): steel with rolling hoops and bungs, open-head with a ring, or of plastic."""
    r, h = 0.292, 0.88
    n = sides(style, r)
    if kind == 2:
        outline = [
            (0.9 * r, 0.0),
            (r, 0.05),
            (r, 0.24),
            (1.03 * r, 0.27),
            (r, 0.3),
            (r, 0.66),
            (1.03 * r, 0.69),
            (r, 0.72),
        ]
        outline += [(0.96 * r, h - 0.06), (0.8 * r, h - 0.03), (0.82 * r, h), (0.7 * r, h), (0.68 * r, h - 0.02)]
    else:
        outline = [(0.95 * r, 0.0), (1.02 * r, 0.0), (1.02 * r, 0.018), (r, 0.022)]
        for z in (0.3, 0.58):
            outline += [(r, z - 0.02), (1.035 * r, z - 0.008), (1.035 * r, z + 0.008), (r, z + 0.02)]
        outline += [(r, h - 0.022), (1.02 * r, h - 0.018), (1.02 * r, h), (0.97 * r, h), (0.965 * r, h - 0.015)]
    parts = [Part(turned(outline, n), "shell", "handle" if kind == 0 else "motor", "tank")]
    top = outline[-1][1]
    if kind == 1:
        lock = ring(1.0 * r, 1.06 * r, h - 0.025, h + 0.004, n)
        lever = box((0.03, 0.14, 0.02), (1.07 * r, 0, h - 0.01))
        parts.append(Part(merge([lock, lever]), "clamp", "steel", "", _JOINT))
    else:
        bungs = [
            moved(merge([cylinder(c, top - 0.005, top + 0.018, 16), hexagon(1.2 * c, top + 0.017, top + 0.026)]), at(x))
            for c, x in ((0.033, 0.62 * r), (0.02, -0.62 * r))
        ]
        parts.append(Part(merge(bungs), "nozzle", "trim", "nozzle"))
    del rng
    return parts


def _drums(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """One to four drums on a pallet or a bunded pallet, or on the bare floor; one with a tap lies on a cradle."""
    kind = int(rng.integers(3))
    parts: list[Part] = []
    if rng.random() < 0.25:
        axis = 0.65
        parts += placed(_drum(style, rng, kind), at(-0.44, 0, axis) @ spun("y", np.pi / 2))
        for x in (-0.25, 0.25):
            rails = [
                bar((x, s * 0.3, 0.01), (x, s * 0.16, axis - 0.245), rounded_rectangle(0.04, 0.04, 0.0), (1, 0, 0))
                for s in (-1, 1)
            ]
            cross = [box((0.04, 0.5, 0.04), (x, 0, 0.15))]
            parts.append(Part(merge([*rails, *cross]), "saddle", "steel", "saddle"))
        tap = merge(
            [
                along("x", cylinder(0.014, 0.42, 0.53, 10), 0, 0, axis + 0.18),
                rod((0.51, 0, axis + 0.14), (0.51, 0, axis + 0.22), 0.012, 8),
            ]
        )
        parts.append(Part(tap, "valve", "trim", "", "Valve assembly"))
        return Model(parts, kind="drum")
    count = int(rng.integers(1, 5))
    base = float(rng.choice([0.0, 0.144, 0.3]))
    spots = [(-0.31, -0.31), (0.31, 0.31), (0.31, -0.31), (-0.31, 0.31)][:count]
    for x, y in spots:
        parts += placed(_drum(style, rng, kind), at(x, y, base) @ spun("z", float(rng.uniform(0, 6))))
    if base == 0.3:
        w = 1.3
        tub = box((w, w, 0.26), (0, 0, 0.15))
        grate = box((w - 0.04, w - 0.04, 0.02), (0, 0, 0.29))
        feet = [box((w, 0.12, 0.021), (0, y, 0.0105)) for y in (-0.5, 0, 0.5)]
        parts += [
            Part(merge([tub, *feet]), "skid frame", "safety", "", _FRAME),
            Part(grate, "grating", "steel", "", _FRAME),
        ]
    elif base:
        boards = [box((1.24, 0.14, 0.022), (0, y, base - 0.011)) for y in np.linspace(-0.55, 0.55, 6)]
        blocks = [box((0.1, 1.24, base - 0.022), (x, 0, (base - 0.022) / 2)) for x in (-0.55, 0.0, 0.55)]
        parts.append(Part(merge([*boards, *blocks]), "skid frame", "safety", "", _FRAME))
    return Model(parts, kind="drum")


def _fuel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fuel tank with flat flanged ends (DIN 6608 in small): in a bund tray or not, fill cap, vent, gauge."""
    r = float(rng.uniform(0.35, 0.7))
    n, length = sides(style, r), r * float(rng.uniform(2.2, 4.0))
    tray = bool(rng.random() < 0.5)
    axis = r + (0.22 if tray else 0.12)
    body = along("x", ring(0.985 * r if style.hollow else 0.0, r, -length / 2, length / 2, n), 0, 0, axis)
    ends = [
        along(
            "x" if s > 0 else "-x",
            turned([(r, length / 2 - 0.001), (r, length / 2 + 0.008), (0.9 * r, length / 2 + 0.02)], n),
            0,
            0,
            axis,
        )
        for s in (-1, 1)
    ]
    parts = [Part(body, "shell", "tank", "tank"), *(Part(e, "dished head", "tank", "tank") for e in ends)]
    floor = 0.1 if tray else 0.0
    a = np.linspace(np.pi + 0.7, 2 * np.pi - 0.7, 9)
    seat = (r - 0.002) * np.column_stack([np.cos(a), np.sin(a)])
    x1, z1 = seat[-1][0], floor - axis
    outline = np.vstack([[(-x1, z1), (x1, z1)], seat[::-1]])
    plate = moved(extrude(outline, -0.04, 0.04), at(0, 0, axis) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2))
    parts += [Part(moved(plate, at(x)), "saddle", "steel", "saddle") for x in (-0.3 * length, 0.3 * length)]
    if tray:
        w, d, h = length + 0.3, 2 * r + 0.3, float(rng.uniform(0.3, 0.8)) * r + 0.1
        sheet = [
            box((w, d, 0.01), (0, 0, floor - 0.005)),
            *(box((w, 0.006, h), (0, s * d / 2, floor - 0.01 + h / 2)) for s in (-1, 1)),
        ]
        sheet += [box((0.006, d, h), (s * w / 2, 0, floor - 0.01 + h / 2)) for s in (-1, 1)]
        runners = [box((w, 0.08, floor - 0.01), (0, s * 0.35 * d, (floor - 0.01) / 2)) for s in (-1, 1)]
        parts.append(Part(merge([*sheet, *runners]), "tank", "tank", "tank"))
    top = axis + r - 0.01
    fill = [merge([cylinder(0.04, top - 0.02, top + 0.1, 14), cylinder(0.055, top + 0.09, top + 0.12, 14)])]
    vent = rope(
        [
            (-0.18 * length, 0, top - 0.02),
            (-0.18 * length, 0, top + 0.5),
            (-0.18 * length + 0.06, 0, top + 0.56),
            (-0.18 * length + 0.12, 0, top + 0.5),
        ],
        0.02,
        10,
    )
    parts.append(Part(moved(fill[0], at(-0.3 * length)), "nozzle", "trim", "nozzle"))
    parts.append(Part(vent, "pipe", "pipe", "", "Pipe assembly"))
    dial = cylinder(0.05, top - 0.005, top + 0.06, 16)
    parts.append(Part(moved(dial, at(-0.05 * length)), "level gauge", "dial", "", "Gauge assembly"))
    if r > 0.5:
        parts += placed(
            manway("hinged", 0.24, style, rng, r, 0.02),
            at(0.02 * length + 0.3, 0, axis + r) @ spun("z", np.pi / 2) @ spun("z", -np.pi / 2),
        )
    for s in (-1, 1):
        pose = at(s * 0.42 * length, 0, axis + r)
        parts += placed(lug("plate", 0.09, style, r, 0.01), pose)
    return Model(parts, kind="fuel tank")


def _buried(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An underground tank as delivered: a ribbed shell on a bed or with strap anchors, a manhole tower with its lid."""
    r = float(rng.uniform(0.5, 1.1))
    n, length = sides(style, r), min(r * float(rng.uniform(2.4, 4.5)), 4.0)
    bed = float(rng.uniform(0.12, 0.3))
    axis = bed + r - 0.02
    ribs = int(rng.integers(4, 10))
    pitch = length / ribs
    outline = [(0.99 * r, 0.0)]
    for k in range(ribs):
        z = k * pitch
        outline += [
            (0.96 * r, z + 0.15 * pitch),
            (0.96 * r, z + 0.45 * pitch),
            (r, z + 0.55 * pitch),
            (r, z + 0.9 * pitch),
        ]
    outline.append((0.97 * r, length))
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    kind = str(rng.choice(["torispherical", "shallow", "2:1"]))
    ends = [
        moved(head(kind, 0.97 * r, style, n), at(0, 0, length - 0.002)),
        moved(head(kind, 0.97 * r, style, n), at(0, 0, 0.002) @ spun("x", np.pi)),
    ]
    parts = [Part(moved(turned(outline, n), lay), "shell", "dial", "tank")]
    parts += [Part(moved(e, lay), "dished head", "dial", "tank") for e in ends]
    wide = length + 2 * head_height(kind, r) + 0.2
    parts.append(Part(box((wide, 2.2 * r, bed), (0, 0, bed / 2)), "foundation", "concrete", "", _FRAME))
    for x in np.linspace(-0.3, 0.3, int(rng.integers(2, 4))) * length:
        strap = along("x", ring(0.985 * r, 1.012 * r, -0.03, 0.03, n), x, 0, axis)
        anchors = [rod((x, s * r, bed - 0.01), (x, s * r, axis), 0.012, 8) for s in (-1, 1)]
        parts.append(Part(merge([strap, *anchors]), "clamp", "clamp", "", _JOINT))
    for x in ((0.0,), (-0.28, 0.28))[int(rng.integers(2)) if length > 2 else 0]:
        neck, tall = float(rng.uniform(0.3, 0.36)), float(rng.uniform(0.3, 0.9))
        k = style.round(neck)
        tower = merge(
            [
                ring(0.94 * neck, neck, axis + 0.8 * r, axis + r + tall, k),
                *(
                    ring(0.99 * neck, 1.07 * neck, z, z + 0.04, k)
                    for z in np.linspace(axis + r + 0.08, axis + r + tall - 0.1, 3)
                ),
            ]
        )
        lid = turned(
            [
                (1.1 * neck, axis + r + tall),
                (1.12 * neck, axis + r + tall + 0.05),
                (0.9 * neck, axis + r + tall + 0.07),
            ],
            k,
        )
        parts.append(Part(moved(tower, at(x * length)), "manway", "dial", "manway"))
        parts.append(Part(moved(lid, at(x * length)), "manway", "rubber", "manway"))
    apex = head_height(kind, 0.97 * r)
    for s in (-1, 1):
        pose = at(s * (length / 2 + 0.75 * apex), 0, axis + 0.55 * r) @ spun("y", s * np.pi / 2)
        parts += placed(mouth("fitting", 100, 0.2, style, 0.0, 0.3 * r), pose)
    return Model(parts, kind="buried tank")


PLATE_TANKS: tuple[Family, ...] = (
    tank_family("tank/bucket hopper", _bucket, 0.9),
    tank_family("tank/braced plates", _braced, 0.9),
    tank_family("tank/sectional panels", _sectional),
    tank_family("tank/drums", _drums, 0.9),
    tank_family("tank/fuel", _fuel, 0.9),
    tank_family("tank/buried", _buried),
)
