"""Gauges and manometers on panels, walls, stands and ducts."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import (
    CASE,
    FRAME,
    JOINT,
    STEM,
    bent,
    board,
    dial,
    fine_sides,
    gauge_family,
    indicator,
    piece,
    screws,
    shank,
    stand,
    standing,
    t_handle,
    upright,
)
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, fronted, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import extrude, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, rope
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["PANEL_BUILDS"]

_LOOK = spun("x", np.pi / 2)  # what looks to +z looks to -y
_KIND = "pressure gauge"


def _panel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Gauges let into a panel: front flange, U-clamp with knurled nuts and connection behind (EN 837-1, 40 to 160)."""
    size, count = float(rng.choice([0.063, 0.1, 0.1, 0.16])), int(rng.integers(1, 5))
    middle, pitch = float(rng.uniform(1.1, 1.6)), 1.6 * size
    parts = board(pitch * count + 0.15, middle - size, middle + size, style, rng)
    n, shape = style.round(size / 2), int(rng.integers(3))
    behind = max(float(p.solid.vertices[:, 1].max()) for p in parts if p.name in ("plate", "wall"))
    for k in range(count):
        pose = at((k - (count - 1) / 2) * pitch, 0, middle) @ _LOOK
        if shape == 2:
            head = indicator(size, size, 0.05, style, rng)
        else:
            head = dial(size, style, rng, "plain", 0.4 * size)
            flat = ring(0.49 * size, 0.66 * size, 0.0, 0.004, n)
            head.append(piece(flat, CASE, "gauge"))
            if shape:
                head.append(screws(3, 0.6 * size, 0.004, 0.0, 0.004, CASE))
        can = cylinder(0.4 * size, -behind - 0.35 * size, 0.0, n)
        head.append(piece(can, CASE, "gauge"))
        low = -behind - 0.35 * size
        stem = [hexagon(0.02, low - 0.02, low), cylinder(0.0065, low - 0.035, low, 10)]
        tube = bent([(0, 0, low - 0.03), (0, 0, low - 0.07), (0, -0.6 * middle, low - 0.07)], 0.003, style)
        head.append(piece([*stem, tube], STEM, "trim"))
        span = 0.44 * size
        path = np.array([(-span, 0, -behind), (-span, 0, low - 0.004), (span, 0, low - 0.004), (span, 0, -behind)])
        strap = sweep(
            path, np.array([[-0.008, -0.0015], [0.008, -0.0015], [0.008, 0.0015], [-0.008, 0.0015]]), up=(0, 1, 0)
        )
        nuts = [moved(cylinder(0.006, low - 0.012, low - 0.0055, 10), at(x)) for x in (-0.27 * size, 0.27 * size)]
        head.append(Part(merge([strap, *nuts]), "bracket", "clamp", "", JOINT))
        parts += placed(head, pose)
    return Model(parts, kind=_KIND)


def _wall(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Gauges on a wall or board by their rear flanges, a tube to each from below (EN 837-1, form with rear flange)."""
    size, count = float(rng.choice([0.08, 0.1, 0.16, 0.25])), int(rng.integers(1, 4))
    middle, pitch = float(rng.uniform(1.2, 1.7)), 1.7 * size
    parts = board(pitch * count + 0.2, middle - 1.2 * size, middle + size, style, rng)
    n = style.round(size / 2)
    for k in range(count):
        x = (k - (count - 1) / 2) * pitch
        head = placed(dial(size, style, rng, str(rng.choice(["plain", "safety", "cast"]))), at(0, 0, 0.006))
        if rng.random() < 0.6:
            flat = cylinder(0.68 * size, 0.0, 0.005, n)
        else:
            flat = merge([box((0.2 * size, 1.35 * size, 0.004), (0, 0, 0.002)), cylinder(0.47 * size, 0.0, 0.006, n)])
        head.append(piece(flat, CASE, "gauge"))
        head.append(screws(3, 0.61 * size, 0.005, -0.002, 0.005, CASE))
        parts += placed(head, at(x, 0, middle) @ _LOOK)
        y, low = -0.25 * size, middle - 0.5 * size
        foot = placed([shank(-0.04, 0.004, style, rng, size)], at(x, y, low))
        drop = [(x, y, low - 0.036), (x, y, low - 0.12), (x, -0.012, low - 0.2), (x, -0.012, 0.25)]
        parts += [*foot, piece(bent(drop, 0.004, style), STEM, "trim")]
        if rng.random() < 0.6:
            clip = box((0.04, 0.014, 0.012), (x, -0.007, 0.75 * low))
            parts.append(Part(clip, "clamp", "clamp", "", JOINT))
    return Model(parts, kind=_KIND)


def _remote(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge on a post bracket with an armoured capillary to a diaphragm seal on a standpipe with a flange."""
    height, size = float(rng.uniform(0.9, 1.5)), float(rng.choice([0.1, 0.16]))
    dn = int(rng.choice([50, 80]))
    pole = stand(height, style, rng)
    out, thick = float(rng.uniform(0.3, 0.7)), plate_thickness(dn)
    low = float(rng.uniform(0.3, 0.6))
    pipe = cylinder(PIPES[dn].radius, 0.0, low - 0.06, style.round(PIPES[dn].radius))
    under = moved(disc_flange(dn, style, 0.061), spun("x", np.pi))
    column = [Part(moved(pipe, at(out)), "pipe", "pipe", "", "Pipe assembly")]
    column.append(Part(moved(under, at(out, 0, low)), "flange", "flange", "", "Pipe assembly"))
    seal = merge(
        [
            disc_flange(dn, style, thick + 0.012),
            along("x", hexagon(0.02, 0.0, 0.05), 0.3 * PIPES[dn].outer, 0, thick + 0.006),
        ]
    )
    column.append(piece(moved(seal, at(out, 0, low)), STEM, "trim"))
    z = height - 0.15
    arm = box((0.05, 0.05, 0.006), (0, -0.05, z - 0.003))
    back = box((0.08, 0.006, 0.09), (0, -0.0332, z - 0.04))
    head = upright(dial(size, style, rng), size, z + 0.04)
    foot = placed([shank(z - 0.02, z + 0.042, style, rng, size)], at())
    hang = out + 0.3 * PIPES[dn].outer + 0.05
    line = [(0, 0, z - 0.018), (0, 0, z - 0.12), (0.4 * out, 0.02, 0.45 * low), (hang + 0.12, 0.01, 0.7 * low)]
    line += [(hang + 0.1, 0, low + thick + 0.006), (hang - 0.002, 0, low + thick + 0.006)]
    shift = at(0, -0.052, 0)
    tube = bent([(a, b - 0.052 * (1 - a / (hang + 0.12)), c) for a, b, c in line], 0.0035, style)
    parts = [*pole, Part(merge([arm, back]), "bracket", "clamp", "", JOINT), *column, *placed([foot[0], *head], shift)]
    return Model([*parts, piece(tube, STEM, "rubber")], kind=_KIND)


def _sector(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A profile gauge: an upright or fan-shaped scale in a narrow case, in a panel front (DIN 43700 edgewise)."""
    tall = float(rng.choice([0.144, 0.192]))
    wide, middle, count = 0.5 * tall, float(rng.uniform(1.1, 1.6)), int(rng.integers(1, 5))
    parts = board(1.5 * wide * count + 0.15, middle - tall, middle + tall, style, rng)
    fan = rng.random() < 0.5
    turns = np.linspace(np.pi / 2 + 0.5, np.pi / 2 - 0.5, 9)
    for k in range(count):
        if fan:
            reach = 0.9 * tall
            outer = np.array([(reach * np.cos(a), reach * np.sin(a) - 0.5 * tall) for a in turns[::-1]])
            outline = np.vstack([[(-0.1 * tall, -0.4 * tall), (0.1 * tall, -0.4 * tall)], outer])
        else:
            outline = rounded_rectangle(wide, tall, 0.06 * tall, 3)
        deep = float(rng.uniform(0.03, 0.06))
        case = [extrude(0.9 * outline, 0.0, 0.8 * deep), extrude(outline, 0.78 * deep, deep, (0.82 * outline,))]
        face = extrude(0.81 * outline, 0.8 * deep, 0.8 * deep + 0.0015)
        swing = spun("z", float(rng.uniform(-0.35, 0.35)))
        needle = moved(box((0.004, 0.7 * tall, 0.001), (0, 0.35 * tall, 0)), at(0, -0.35 * tall) @ swing)
        if not fan:
            needle = box((0.5 * wide, 0.006, 0.001), (0.1 * wide, float(rng.uniform(-0.3, 0.3)) * tall, 0))
        head = [piece(case, CASE, "gauge"), piece(face, "gauge face", "dial", CASE)]
        head.append(piece(moved(needle, at(0, 0, 0.8 * deep + 0.002)), "gauge needle", "needle", CASE))
        if rng.random() < 0.5:
            head.append(piece(extrude(0.815 * outline, 0.94 * deep, 0.96 * deep), "gauge glass", "dial", CASE))
        parts += placed(fronted(head), at((k - (count - 1) / 2) * 1.5 * wide, 0, middle) @ _LOOK)
    return Model(parts, kind=_KIND)


def _differential(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A differential gauge: a cell of two flanges behind the dial, a three-valve manifold, two tubes, on a stand."""
    height, size = float(rng.uniform(1.0, 1.5)), float(rng.choice([0.1, 0.115, 0.16]))
    parts = stand(height, style, rng)
    n, r = style.round(0.05), float(rng.uniform(0.045, 0.07))
    cell = [cylinder(r, -0.032, -0.002, n), cylinder(r, 0.002, 0.032, n), cylinder(0.8 * r, -0.003, 0.003, n)]
    z, y = height - 0.1, -0.2
    lie = at(0, y, z) @ spun("y", np.pi / 2)
    parts.append(piece(moved(merge(cell), lie), CASE, "gauge"))
    parts += placed([screws(int(rng.choice([6, 8])), 0.85 * r, 0.008, -0.032, 0.032, CASE)], lie)
    parts += placed(dial(size, style, rng), at(0, y - 0.9 * r, z) @ _LOOK)
    block = box((0.09, 0.04, 0.05), (0, y, z - r - 0.022))
    tees = [along(a, t_handle(0.05, 0.04), s * 0.044, y, z - r - 0.022) for a, s in (("x", 1), ("-x", -1))]
    tees.append(along("-y", t_handle(0.05, 0.04), 0, y - 0.019, z - r - 0.03))
    parts.append(piece([block, *tees], STEM, "trim"))
    for x in (-0.027, 0.027):
        way = [(x, y, z - r - 0.04), (x, y, z - r - 0.15), (2 * x, y + 0.05, 0.5 * z), (2 * x, y + 0.05, 0.1)]
        parts.append(piece(bent(way, 0.005, style), STEM, "trim"))
    arm = [box((0.06, 0.006, 0.08), (0, -0.0332, z)), box((0.04, -y - 0.035, 0.006), (0, y / 2 - 0.017, z + r - 0.01))]
    parts.append(Part(merge(arm), "bracket", "clamp", "", JOINT))
    return Model(parts, kind="differential pressure gauge")


def _u_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A U-tube manometer: a bent glass tube with a scale on a board, its ends with nipples or hose (to 1.5 m)."""
    span, low = float(rng.uniform(0.3, 1.1)), float(rng.uniform(0.5, 0.9))
    apart = float(rng.uniform(0.02, 0.04))
    parts = board(float(rng.uniform(0.25, 0.6)), low - 0.1, low + span + 0.15, style, rng)
    plank = box((4.5 * apart, 0.012, span + 0.08), (0, -0.006, low + span / 2))
    parts.append(piece(plank, CASE, str(rng.choice(["gauge", "handle", "dial"]))))
    y = -0.012 - 0.006
    turn = np.linspace(np.pi, 2 * np.pi, 9)
    foot = [(apart * np.cos(a), y, low + apart * (1 + np.sin(a))) for a in turn]
    path = np.array([(-apart, y, low + span), *foot, (apart, y, low + span)])
    parts.append(piece(rope(path, 0.0055, fine_sides(0.0055, style, 10)), "gauge glass", "dial", CASE))
    scale = box((1.1 * apart, 0.002, 0.9 * span), (0, -0.013, low + 0.52 * span))
    ticks = [box((0.8 * apart, 0.001, 0.0015), (0, -0.0145, low + s * span)) for s in np.linspace(0.12, 0.9, 14)]
    parts.append(piece([scale, *ticks], "gauge face", "dial", CASE))
    for x in (-apart, apart):
        cap = merge([cylinder(0.009, 0.0, 0.03, 12), hexagon(0.022, 0.02, 0.035)])
        parts.append(piece(moved(cap, at(x, y, low + span - 0.005)), STEM, "trim"))
        way = [(x, y, low + span + 0.025), (x, y, low + span + 0.09), (3.5 * x, y, low + span + 0.07), (4 * x, y, low)]
        parts.append(piece(bent(way, 0.005, style), STEM, "rubber"))
    clips = [box((2.6 * apart, 0.01, 0.008), (0, y + 0.001, low + s * span)) for s in (0.25, 0.75)]
    parts.append(piece(clips, CASE, "clamp"))
    return Model(parts, kind="manometer")


def _inclined(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An inclined-tube manometer for draught: a moulded plate, a slanting glass, a well with a knob, two ports."""
    wide, tall = float(rng.uniform(0.22, 0.4)), float(rng.uniform(0.1, 0.18))
    z, deep = float(rng.uniform(1.1, 1.6)), float(rng.uniform(0.012, 0.025))
    parts = board(wide + 0.2, z - tall, z + tall, style, rng)
    head = [piece(extrude(rounded_rectangle(wide, tall, 0.1 * tall, 3), 0.0, deep), CASE, "gauge")]
    glass = rod((-0.4 * wide, -0.25 * tall, deep + 0.003), (0.42 * wide, 0.3 * tall, deep + 0.003), 0.004, 8)
    head.append(piece(glass, "gauge glass", "dial", CASE))
    scale = moved(
        box((0.75 * wide, 0.1 * tall, 0.002), (0, 0, deep + 0.001)), at(0.02 * wide, -0.12 * tall) @ spun("z", 0.27)
    )
    head.append(piece(scale, "gauge face", "dial", CASE))
    well = [along("y", cylinder(0.012, -0.3 * tall, 0.1 * tall, 12), -0.42 * wide, -0.05 * tall, deep + 0.008)]
    well.append(along("-y", cylinder(0.016, 0.0, 0.018, 12), -0.42 * wide, -0.34 * tall, deep + 0.008))
    head.append(piece(well, CASE, "trim"))
    for x in (-0.42 * wide, 0.44 * wide):
        tube = bent(
            [(x, 0.35 * tall, deep - 0.001), (x, 0.35 * tall, deep + 0.03), (x, -tall, deep + 0.03)], 0.004, style
        )
        head.append(piece(tube, STEM, "rubber"))
    return Model([*parts, *placed(fronted(head), at(0, 0, z) @ _LOOK)], kind="manometer")


def _draught(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A low-pressure dial on a filter duct's wall: a shallow case with a wide flange, two hoses to probes (4 in)."""
    size, z = float(rng.choice([0.08, 0.12])), float(rng.uniform(1.0, 1.5))
    wide, deep = float(rng.uniform(0.5, 0.9)), float(rng.uniform(0.3, 0.6))
    duct = box((wide, deep, z + 0.4), (0, deep / 2, (z + 0.4) / 2))
    n = style.round(size / 2)
    head = dial(size, style, rng, "plain", 0.45 * size)
    head.append(piece(cylinder(0.6 * size, 0.0, 0.006, n), CASE, "gauge"))
    parts = [Part(duct, "filter", "tank", "", "Equipment"), *placed(head, at(0, 0, z) @ _LOOK)]
    for s in (-1, 1):
        x = s * 0.3 * wide
        port = along("-y", merge([cylinder(0.018, 0.0, 0.004, 12), cylinder(0.006, 0.0, 0.02, 10)]), x, 0, z + s * 0.15)
        way = [(x, -0.018, z + s * 0.15), (x, -0.06, z + s * 0.15), (0.5 * x, -0.07, z - 0.1)]
        way += [(s * 0.55 * size, -0.06, z), (s * 0.48 * size, -0.03, z)]
        parts += [piece(port, STEM, "trim"), piece(bent(way, 0.004, style), STEM, "rubber")]
    return Model(parts, kind="differential pressure gauge")


def _guarded(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gauge with its tube on a bracket that a short post carries: a tubed compound on a skid's edge."""
    height, size = float(rng.uniform(0.6, 1.3)), float(rng.choice([0.063, 0.1]))
    w = 0.04
    leg = box((w, w, height - 0.008), (0, 0, 0.008 + (height - 0.008) / 2))
    foot = box((0.12, 0.12, 0.008), (0, 0, 0.004))
    parts = [Part(leg, "post", "steel", "", FRAME), Part(foot, "base plate", "steel", "", FRAME)]
    y = -w / 2 - 0.05
    slot = extrude(circle(0.011, 12), -0.0031, 0.0031)
    ledge = box((0.05, 0.078, 0.006), (0, -w / 2 - 0.039, height - 0.06))
    lip = box((0.05, 0.005, 0.06), (0, -w / 2 - 0.0025, height - 0.09))
    parts.append(Part(merge([ledge, lip]), "bracket", "clamp", "", JOINT))
    nut = merge([moved(slot, at(0, y, height - 0.06)), moved(hexagon(0.027, 0.0, 0.014), at(0, y, height - 0.057))])
    parts.append(piece(nut, STEM, "trim"))
    parts += placed(standing(height - 0.045, style, rng, "", size), at(0, y))
    way = [(0, y, height - 0.062), (0, y, height - 0.12), (0, y - 0.02, 0.4 * height), (0.3, y - 0.02, 0.12)]
    return Model([*parts, piece(bent(way, 0.004, style), STEM, "trim")], kind=_KIND)


PANEL_BUILDS: tuple[Family, ...] = (
    gauge_family("gauge/panel", _panel, "floor"),
    gauge_family("gauge/wall", _wall, "floor"),
    gauge_family("gauge/capillary seal", _remote, "floor"),
    gauge_family("gauge/sector", _sector, "floor"),
    gauge_family("gauge/differential", _differential, "floor"),
    gauge_family("gauge/u-tube", _u_tube, "floor"),
    gauge_family("gauge/inclined tube", _inclined, "floor"),
    gauge_family("gauge/draught", _draught, "floor"),
    gauge_family("gauge/post", _guarded, "floor"),
)
