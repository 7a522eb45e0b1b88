"""Further separators: knock-out drums, plate packs, air and dirt separators, oil boxes, centrifuges, hydrocyclones."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.valve import bolt_circle, flanged_body
from cadplants.families.vessels.exchangers import equipment_family, equipment_mouth, feet_of, frame_of
from cadplants.families.vessels.vessel_fittings import Drum, head, head_height, manway, mouth, renamed, sides
from cadplants.families.vessels.vesselfeet import legs, saddle, skirt
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, lofted, ring, rod, rope, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["SEPARATORS"]

_NAME, _FRAME, _JOINT = "separator", "Structural element", "Connection assembly"


def _knock_out(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vertical knock-out drum: a girth flange at its demister, a side inlet, gas out on top, liquid out below."""
    r = float(rng.uniform(0.18, 0.55))
    n, height = sides(style, r), r * float(rng.uniform(2.6, 5.0))
    low = head_height("2:1", r) + 0.35 + 0.3 * r
    drum = Drum(r, low, low + height, n)
    seam, thick, wide = low + height * float(rng.uniform(0.65, 0.85)), 0.02 + 0.03 * r, 1.14 * r + 0.03
    solids = [
        drum.solid(style),
        moved(head("2:1", r, style, n), at(0, 0, drum.high)),
        moved(head("2:1", r, style, n), at(0, 0, low) @ spun("x", np.pi)),
    ]
    rims = [ring(0.98 * r, wide, seam - thick, seam, n), ring(0.98 * r, wide, seam + 0.003, seam + thick, n)]
    bolts = bolt_circle(int(np.clip(45 * r, 12, 28)), 0.5 * (r + wide) + 0.003, 0.014, seam - thick, seam + thick)
    parts = [
        Part(merge(solids), _NAME, "tank", _NAME),
        Part(merge(rims), _NAME, "flange", _NAME),
        Part(bolts, "bolt", "fastener", _NAME, _JOINT, True),
    ]
    feet = str(rng.choice(["chairs", "open", "angle", "beam"]))
    parts += feet_of((skirt if feet in ("chairs", "open") else legs)(feet, drum, style, rng), _NAME)
    ports: list[Port] = []
    dn = int(rng.choice([dn for dn in (40, 50, 80, 100, 150) if FLANGES[dn].outer < 0.9 * r] or [25]))
    for pose, curve in (
        (drum.side(0.4, low + 0.45 * height), r),
        (at(0, 0, drum.high + head_height("2:1", r)), 0.0),
        (drum.side(2.4, low + 0.12 * height), r),
    ):
        some, port = equipment_mouth(_NAME, dn, pose, style, curve, drum.dip + 0.02 * r)
        parts += some
        ports += port
    if r > 0.3:
        pose = drum.side(4.6, low + 0.3 * height)
        parts += renamed(placed(manway("oval", 0.12, style, rng, r, drum.dip), pose), _NAME)
    return Model(parts, ports=tuple(ports), kind="knock-out drum")


def _three_phase(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lying separator: dished ends, an inlet at one end, a gas dome, a water boot below, two saddles."""
    r = float(rng.uniform(0.25, 0.7))
    n, length = sides(style, r), r * float(rng.uniform(3.4, 5.5))
    boot, deep = 0.4 * r, r * float(rng.uniform(0.7, 1.1))
    axis = r + deep + 0.25
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    body = [
        cylinder(r, 0.0, length, n),
        moved(head("2:1", r, style, n), at(0, 0, length)),
        moved(head("2:1", r, style, n), spun("x", np.pi)),
    ]
    k = sides(style, boot)
    pot = turned([(0.3 * boot, axis - r - deep), (boot, axis - r - deep + 0.4 * boot), (boot, axis - 0.8 * r)], k)
    parts = [
        Part(moved(merge(body), lay), _NAME, "tank", _NAME),
        Part(moved(pot, at(0.2 * length)), _NAME, "tank", _NAME),
    ]
    if rng.random() < 0.6:
        crown = turned([(0.45 * r, axis + 0.8 * r), (0.45 * r, axis + 1.4 * r), (0.3 * r, axis + 1.55 * r)], k)
        parts.append(Part(moved(crown, at(0.25 * length)), _NAME, "tank", _NAME))
        top = axis + 1.55 * r
    else:
        top = axis + r
    for x in (-0.3 * length, 0.38 * length):
        parts += feet_of(placed(saddle("ribbed", r, axis, style, rng), at(x)), _NAME)
    dn = int(rng.choice([dn for dn in (40, 50, 80, 100) if FLANGES[dn].outer < 0.8 * r] or [25]))
    ports: list[Port] = []
    dip = r * (1 - np.cos(np.pi / n))
    apex = head_height("2:1", r)
    for pose in (
        at(-length / 2 - apex, 0, axis) @ spun("y", -np.pi / 2),
        at(0.25 * length, 0, top),
        at(-0.3 * length, 0, axis + r),
    ):
        some, port = equipment_mouth(_NAME, dn, pose, style, 0.0, dip + 0.03 * r)
        parts += some
        ports += port
    drain = renamed(mouth("plain", 25, 0.13, style, 0.0, 0.02), _NAME)
    parts += placed(drain, at(0.2 * length, 0, axis - r - deep) @ spun("x", np.pi))
    return Model(parts, ports=tuple(ports), kind="three-phase separator")


def _plate_pack(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lamella separator: a box over a hopper, an inclined pack of plates between its walls, weirs, braced legs."""
    w, d, h = (float(rng.uniform(*span)) for span in ((1.2, 2.2), (0.7, 1.2), (0.8, 1.4)))
    low, cone, t = float(rng.uniform(0.35, 0.6)), float(rng.uniform(0.4, 0.8)), 0.008
    z = low + cone
    walls = [box((w, t, h), (0, s * (d - t) / 2, z + h / 2)) for s in (-1, 1)]
    walls += [box((t, d - 2 * t, h), (s * (w - t) / 2, 0, z + h / 2)) for s in (-1, 1)]
    hems = [box((w + 0.1, 0.05, 0.05), (0, s * (d / 2 + 0.025), z + h - 0.025)) for s in (-1, 1)]
    hems += [box((0.05, d, 0.05), (s * (w / 2 + 0.025), 0, z + h - 0.025)) for s in (-1, 1)]
    plate = moved(box((0.006, d - 2 * t, 0.75 * h)), spun("y", float(rng.uniform(0.5, 0.65))))
    pack = [moved(plate, at(x, 0, z + 0.45 * h)) for x in np.arange(-0.2 * w, 0.24 * w, float(rng.uniform(0.05, 0.09)))]
    square = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    loops = [
        np.column_stack([square * size, np.full(4, level)])
        for size, level in (((0.2, 0.2), low), ((w, d), z), ((w, d), z + 0.01))
    ]
    hopper = lofted(loops)
    weir = box((t, d - 2 * t, 0.6 * h), (0.38 * w, 0, z + 0.6 * h))
    parts = [
        Part(merge([*walls, *hems]), _NAME, "tank", _NAME),
        Part(hopper, _NAME, "tank", _NAME),
        Part(merge(pack), _NAME, "dial", _NAME),
        Part(weir, _NAME, "trim", _NAME),
        Part(frame_of(w + 0.1, d + 0.1, z + 0.3 * h, 0.08, rails=False), "column", "steel", "", _FRAME),
    ]
    ring_beam = [box((w + 0.1, 0.06, 0.1), (0, s * (d / 2 + 0.03), z + 0.05)) for s in (-1, 1)]
    parts.append(Part(merge(ring_beam), "beam", "steel", "", _FRAME))
    ports: list[Port] = []
    dn = int(rng.choice([65, 80, 100]))
    for s, level in ((-1, 0.35), (1, 0.75)):
        pose = at(s * w / 2, 0, z + level * h) @ spun("y", s * np.pi / 2)
        some, port = equipment_mouth(_NAME, dn, pose, style)
        parts += some
        ports += port
    sludge = renamed(mouth("plain", 80, min(0.25, 0.8 * low), style, 0.0, 0.01), _NAME)
    parts += placed(sludge, at(0, 0, low) @ spun("x", np.pi))
    return Model(parts, ports=tuple(ports), kind="lamella separator")


def _oil_box(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An oil-water box: a rectangular tank with chambers, lids with handles, a skimmer pipe, two mouths."""
    w, d, h = (float(rng.uniform(*span)) for span in ((0.8, 2.0), (0.5, 1.0), (0.5, 1.0)))
    base, r = 0.1, float(rng.uniform(0.005, 0.05))
    body = extrude(rounded_rectangle(w, d, r, 2), base, base + h)
    count = int(rng.integers(2, 5))
    lids = []
    for k in range(count):
        x, wide = -w / 2 + (k + 0.5) * w / count, 0.96 * w / count
        lid = box((wide, d + 0.04, 0.025), (x, 0, base + h + 0.0125))
        grip = [
            (x, -0.06, base + h + 0.02),
            (x, -0.06, base + h + 0.06),
            (x, 0.06, base + h + 0.06),
            (x, 0.06, base + h + 0.02),
        ]
        lids.append(merge([lid, rope(grip, 0.006, 6)]))
    ribs = [box((0.03, d + 0.06, 0.8 * h), (-w / 2 + k * w / count, 0, base + 0.45 * h)) for k in range(1, count)]
    pads = [box((w, 0.08, base), (0, s * 0.38 * d, base / 2)) for s in (-1, 1)]
    parts = [
        Part(merge([body, *ribs]), _NAME, "tank", _NAME),
        *(Part(lid, _NAME, "dial", _NAME) for lid in lids),
        Part(merge(pads), "skid frame", "steel", "", _FRAME),
    ]
    ports: list[Port] = []
    dn = int(rng.choice([50, 80, 100])) if h > 0.6 else 40
    for s, f in ((-1, 0.78), (1, 0.7)):
        some, port = equipment_mouth(_NAME, dn, at(s * w / 2, 0, base + f * h) @ spun("y", s * np.pi / 2), style)
        parts += some
        ports += port
    oil = [
        (0.3 * w, -d / 2 + 0.01, base + 0.8 * h),
        (0.3 * w, -d / 2 - 0.1, base + 0.8 * h),
        (0.3 * w, -d / 2 - 0.1, base),
    ]
    parts.append(Part(rope(oil, 0.025, 12), "pipe", "pipe", "", "Pipe assembly"))
    if rng.random() < 0.5:
        vent = rope([(-0.3 * w, 0.2 * d, base + h), (-0.3 * w, 0.2 * d, base + h + 0.4)], 0.025, 12)
        parts.append(Part(vent, "pipe", "pipe", "", "Pipe assembly"))
    return Model(parts, ports=tuple(ports), kind="oil separator")


def _centrifuge(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A disc-stack centrifuge: a bowl hood with clamps over a cast frame, a motor on its side, feed on top."""
    r = float(rng.uniform(0.2, 0.4))
    n, low = sides(style, r), 0.08
    mid = low + 1.9 * r
    frame = turned(
        [
            (1.05 * r, low),
            (1.1 * r, low + 0.1),
            (0.95 * r, low + 0.5 * r),
            (1.0 * r, mid - 0.3 * r),
            (1.2 * r, mid - 0.25 * r),
            (1.2 * r, mid),
        ],
        n,
    )
    hood = turned(
        [
            (1.2 * r, mid),
            (1.2 * r, mid + 0.04),
            (1.1 * r, mid + 0.3 * r),
            (0.7 * r, mid + 0.75 * r),
            (0.3 * r, mid + 0.9 * r),
            (0.3 * r, mid + 1.25 * r),
            (0.18 * r, mid + 1.3 * r),
        ],
        n,
    )
    claw = merge([box((0.06, 0.05, 0.1), (0, 0, mid)), rod((0.02, 0, mid - 0.05), (0.02, 0, mid + 0.12), 0.01, 8)])
    shaft = 0.42 * r
    z = low + 0.95 * r
    motor = along(
        "x",
        merge(
            [
                cylinder(shaft, 1.1 * r, 2.2 * r, n),
                around(box((0.03 * r, 0.02 * r, 0.95 * r), (0, 0, 1.65 * r)), 16, shaft),
            ]
        ),
        0,
        0,
        z,
    )
    cover = along("x", turned([(1.08 * shaft, 2.15 * r), (1.08 * shaft, 2.5 * r), (0.8 * shaft, 2.55 * r)], n), 0, 0, z)
    flange = along("x", cylinder(1.25 * shaft, 0.85 * r, 1.12 * r, n), 0, 0, z)
    parts = [
        Part(frame, _NAME, "valve", _NAME),
        Part(hood, _NAME, "trim", _NAME),
        Part(around(claw, int(rng.choice([3, 4, 6])), 1.22 * r, 0.5), "clamp", "steel", _NAME, _JOINT),
        Part(flange, _NAME, "valve", _NAME),
        Part(motor, "motor", "motor", _NAME, "Pump unit"),
        Part(cover, "motor fan cover", "motor", _NAME, "Pump unit"),
    ]
    foot = merge([cylinder(0.05, 0, 0.03, 14), cylinder(0.02, 0.02, low + 0.06, 10)])
    parts.append(Part(around(foot, int(rng.choice([3, 4])), 0.9 * r, 0.8), "tank leg", "rubber", _NAME, "Tank"))
    lid = mid + 1.3 * r
    feed = [(0, 0, lid - 0.03), (0, 0, lid + 0.12), (-0.8 * r, 0, lid + 0.12), (-0.8 * r, 0, lid + 0.3)]
    parts.append(Part(rope(feed, 0.024, 12), _NAME, "trim", _NAME))
    for a, f in ((2.2, 1.1), (-2.2, 1.1)):
        way = (np.cos(a), np.sin(a))
        out = [(0.2 * r * way[0], 0.2 * r * way[1], mid + f * r), (1.3 * r * way[0], 1.3 * r * way[1], mid + f * r)]
        parts.append(Part(rope(out, 0.02, 10), _NAME, "trim", _NAME))
    spout = box((0.35 * r, 0.5 * r, 0.45 * r), (-1.1 * r, 0.0, mid - 0.5 * r))
    parts.append(Part(spout, _NAME, "trim", _NAME))
    return Model(parts, kind="centrifuge")


def _decanter(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A decanter centrifuge: a long casing with a split flange over a base, bearings, belt guard, a motor alongside."""
    r, length = float(rng.uniform(0.16, 0.3)), float(rng.uniform(1.4, 2.4))
    n, z = sides(style, r), 0.35 + r
    lower = box((length, 2 * r, r), (0, 0, z - r / 2))
    upper = along("x", cylinder(r, -length / 2, length / 2, n), 0, 0, z)
    flange = box((length + 0.04, 2 * r + 0.12, 0.03), (0, 0, z))
    bearings = [box((0.16, 1.1 * r, 1.3 * r), (s * (length / 2 + 0.1), 0, z - 0.1 * r)) for s in (-1, 1)]
    base = [box((length + 0.9, 0.14, 0.2), (0.1, s * 0.8 * r, 0.15)) for s in (-1, 1)]
    base += [box((0.14, 1.6 * r, 0.2), (x, 0, 0.15)) for x in (-length / 2, 0.0, length / 2)]
    props = [
        box((0.12, 1.5 * r, z - 0.75 * r - 0.24), (s * (length / 2 + 0.1), 0, (z - 0.75 * r + 0.24) / 2))
        for s in (-1, 1)
    ]
    pads = [
        box((0.16, 0.16, 0.05), (x, s * 0.8 * r, 0.025)) for x in (-length / 2 - 0.2, length / 2 + 0.3) for s in (-1, 1)
    ]
    chutes = [box((0.22, 0.9 * r, z - r - 0.02), (x, 0, (z - r) / 2 + 0.01)) for x in (-0.38 * length, 0.38 * length)]
    guard = box((0.14, 0.6 * r, 2.2 * r), (length / 2 + 0.25, 0, z - 0.3 * r))
    motor = along("-x", cylinder(0.55 * r, -length / 2 - 0.19, -length / 2 + 0.3, n), 0, 1.75 * r, z - 0.6 * r)
    seat = box((0.45, 0.9 * r, z - 1.15 * r - 0.24), (length / 2 - 0.05, 1.5 * r, (z - 1.15 * r + 0.24) / 2))
    belt = box((0.14, 2.2 * r, 0.5 * r), (length / 2 + 0.25, 0.9 * r, z - 0.6 * r))
    parts = [
        Part(merge([lower, flange]), _NAME, "valve", _NAME),
        Part(upper, _NAME, "trim", _NAME),
        Part(merge(bearings), _NAME, "valve", _NAME),
        Part(merge(chutes), _NAME, "trim", _NAME),
        Part(merge([guard, belt]), "coupling guard", "safety", _NAME, "Pump unit"),
        Part(motor, "motor", "motor", _NAME, "Pump unit"),
        Part(merge([*base, *props, seat]), "skid frame", "steel", "", _FRAME),
        Part(merge(pads), "base plate", "rubber", "", _FRAME),
    ]
    feed = rod((-length / 2 - 0.5, 0, z), (-length / 2 - 0.1, 0, z), 0.03, 12)
    parts.append(Part(feed, _NAME, "pipe", _NAME))
    return Model(parts, kind="decanter centrifuge")


def _hydrocyclones(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Hydrocyclones or multicyclones: slim cones round a distributor or in a row over a trough, on a frame."""
    count, r = int(rng.integers(2, 7)), float(rng.uniform(0.05, 0.12))
    tall, n = r * float(rng.uniform(6, 10)), sides(style, r)
    low = float(rng.uniform(0.4, 0.7))
    cone = turned([(0.25 * r, low), (0.3 * r, low + 0.06), (r, low + 0.75 * tall), (r, low + tall)], n)
    cap = merge(
        [
            cylinder(1.3 * r, low + 0.75 * tall - 0.012, low + 0.75 * tall + 0.012, n),
            cylinder(1.25 * r, low + tall, low + tall + 0.03, n),
        ]
    )
    k = max(8, min(12, n))
    out = [(0, 0, low + tall + 0.02), (0, 0, low + tall + 0.16), (0, 1.6 * r, low + tall + 0.16)]
    inlet = [(0.7 * r, 0, low + 0.9 * tall), (0.7 * r, 3.0 * r, low + 0.9 * tall)]
    one = [
        Part(merge([cone, cap]), _NAME, "rubber", _NAME),
        Part(merge([rope(out, 0.4 * r, k), rope(inlet, 0.35 * r, k)]), _NAME, "pipe", _NAME),
    ]
    pitch, parts = 3.2 * r, []
    for x in (np.arange(count) - (count - 1) / 2) * pitch:
        parts += placed(one, at(float(x)))
    span = (count - 1) * pitch + 4 * r
    mains = [
        along("x", cylinder(0.8 * r, -span / 2, span / 2, n), 0, y, z)
        for y, z in ((3.0 * r + 0.5 * r, low + 0.9 * tall), (2.0 * r, low + tall + 0.16))
    ]
    parts += [Part(main, _NAME, "pipe", _NAME) for main in mains]
    trough = [box((span, 0.006, 0.2), (0, s * 2 * r, low - 0.07)) for s in (-1, 1)]
    trough += [
        box((span, 4 * r, 0.006), (0, 0, low - 0.17)),
        *(box((0.006, 4 * r, 0.2), (s * span / 2, 0, low - 0.07)) for s in (-1, 1)),
    ]
    parts.append(Part(merge(trough), _NAME, "clamp", _NAME))
    deep = 8 * r
    frame = frame_of(span + 0.12, deep, low + 0.8 * tall, 0.06, rails=False)
    shelf = [box((span, 0.05, 0.05), (0, s * 1.1 * r, low + 0.72 * tall)) for s in (-1, 1)]
    shelf += [
        box((0.06, deep, 0.05), (s * (span / 2 + 0.03), 0, z))
        for s in (-1, 1)
        for z in (low + 0.72 * tall, low - 0.198)
    ]
    shelf += [box((span, 4 * r, 0.05), (0, 0, low - 0.198))]
    parts.append(Part(merge([frame, *shelf]), "skid frame", "steel", "", _FRAME))
    return Model(parts, kind="hydrocyclone")


def _air_pot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An air and dirt separator in a line: a pot offset up or down from it with a vent valve, a drain cock, a split."""
    radius = PIPES[dn].radius
    r = 1.8 * radius + float(rng.uniform(0.02, 0.05))
    n, name = style.round(r), _NAME
    length = round(2 * (r + plate_thickness(dn) + nut_room(dn) + 0.02), 6)
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.25 * length), (neck, 0.75 * length)])
    up, down = float(rng.uniform(1.0, 3.0)) * r, float(rng.uniform(0.9, 3.5)) * r
    pot = turned(
        [
            (0.5 * r, -down - 0.35 * r),
            (0.85 * r, -down - 0.2 * r),
            (r, -down),
            (r, up),
            (0.85 * r, up + 0.2 * r),
            (0.3 * r, up + 0.35 * r),
        ],
        n,
    )
    solids = [body, moved(pot, at(length / 2))]
    parts = []
    if rng.random() < 0.5:
        seam = -0.5 * down - 0.3 * r
        rims = merge(
            [cylinder(1.25 * r + 0.01, seam - 0.016, seam, n), cylinder(1.25 * r + 0.01, seam + 0.002, seam + 0.018, n)]
        )
        bolts = bolt_circle(8, 1.13 * r + 0.005, 0.012, seam - 0.016, seam + 0.018)
        solids.append(moved(rims, at(length / 2)))
        parts.append(Part(moved(bolts, at(length / 2)), "bolt", "fastener", name, _JOINT, True))
    top = up + 0.35 * r
    vent = merge(
        [
            hexagon(0.034, top - 0.01, top + 0.02),
            cylinder(0.026, top + 0.015, top + 0.09, 14),
            dome(0.026, 0.015, top + 0.089, 14),
        ]
    )
    spout = rod((0.02, 0, top + 0.07), (0.045, 0, top + 0.075), 0.006, 8)
    low = -down - 0.35 * r
    cock = merge(
        [
            cylinder(0.012, low - 0.07, low + 0.01, 10),
            hexagon(0.028, low - 0.05, low - 0.02),
            box((0.012, 0.07, 0.006), (0.018, -0.02, low - 0.035)),
        ]
    )
    parts = [
        Part(merge(solids), name, "tank", name),
        Part(moved(merge([vent, spout]), at(length / 2)), "valve", "trim", "", "Valve assembly"),
        Part(moved(cock, at(length / 2)), "valve", "trim", "", "Valve assembly"),
        *parts,
    ]
    return Model(parts, length, kind="air separator")


def _vane(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A steam or gas separator in a line: a barrel of one size more under it, with a flanged lid and drip leg."""
    radius = PIPES[dn].radius
    r = 1.5 * radius + 0.02
    n, name = style.round(r), _NAME
    length = round(2 * (1.6 * r + plate_thickness(dn) + nut_room(dn) + 0.02), 6)
    neck = 0.485 * FLANGES[dn].hub
    body = flanged_body(dn, style, length, [(neck, 0.2 * length), (neck, 0.8 * length)])
    lying = along("x", turned([(neck, -1.6 * r), (r, -1.1 * r), (r, 1.1 * r), (neck, 1.6 * r)], n), length / 2)
    leg, deep = 0.7 * r, float(rng.uniform(1.6, 3.2)) * r
    pot = turned([(0.4 * leg, -deep - 0.25 * leg), (leg, -deep), (leg, -0.5 * r)], n)
    lid = merge([cylinder(0.75 * r, 0.3 * r, 1.25 * r, n), cylinder(0.95 * r, 1.25 * r, 1.25 * r + 0.03, n)])
    bolts = bolt_circle(6, 0.85 * r, 0.01, 1.25 * r, 1.25 * r + 0.03)
    drip = cylinder(0.0134, -deep - 0.25 * leg - 0.08, -deep - 0.2 * leg, 10)
    parts = [
        Part(merge([body, lying, moved(pot, at(length / 2))]), name, "valve", name),
        Part(moved(lid, at(length / 2)), name, "valve", name),
        Part(moved(bolts, at(length / 2)), "bolt", "fastener", name, _JOINT, True),
        Part(moved(drip, at(length / 2)), name, "trim", name),
    ]
    return Model(parts, length, kind="steam separator")


def _line_family(name: str, build: object, least: int, most: int) -> Family:
    some = tuple(dn for dn in SIZES if least <= dn <= most)
    return Family(name, "inline", "Equipment", _NAME, build, some, weight=0.8)  # type: ignore[arg-type]


SEPARATORS: tuple[Family, ...] = (
    equipment_family("separator/knock-out drum", _knock_out, 1.0),
    equipment_family("separator/three-phase", _three_phase, 1.0),
    equipment_family("separator/lamella", _plate_pack, 1.0),
    equipment_family("separator/oil box", _oil_box, 1.0),
    equipment_family("separator/disc stack", _centrifuge, 1.0),
    equipment_family("separator/decanter", _decanter, 0.8),
    equipment_family("separator/hydrocyclones", _hydrocyclones, 0.9),
    _line_family("separator/air pot", _air_pot, 32, 200),
    _line_family("separator/steam baffle", _vane, 25, 150),
)
