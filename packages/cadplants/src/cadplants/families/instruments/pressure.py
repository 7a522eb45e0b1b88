"""Pressure transmitters, switches and probes, and sight glasses."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import (
    JOINT,
    STEM,
    bent,
    gland,
    headed,
    housing,
    piece,
    screws,
    stand,
    t_handle,
)
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["PRESSURE_BUILDS", "differential_cell"]

_NAME, _KIND, _GLASS = "transmitter", "pressure transmitter", "sight glass"


def _single(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A single-compartment transmitter: hexagon, slim or fat cell, maybe cooling fins, a pot or drum with one cover."""
    r, tall = float(rng.uniform(0.013, 0.028)), float(rng.uniform(0.03, 0.08))
    n = style.round(r)
    cell = [
        cylinder(0.0095, 0.0, 0.02, 12),
        hexagon(max(0.027, 1.7 * r), 0.018, 0.036),
        cylinder(r, 0.034, 0.036 + tall, n),
    ]
    if rng.random() < 0.3:
        cell += [cylinder(1.3 * r, 0.04 + k * tall / 5, 0.04 + (k + 0.4) * tall / 5, n) for k in range(5)]
    shape = str(rng.choice(["single", "pot", "slant", "rectangle"]))
    head = moved(housing(style, rng, shape), at(0, 0, 0.034 + tall) @ spun("z", float(rng.uniform(0, 6))))
    return Model([piece(cell, _NAME, "trim"), piece(head, _NAME, "valve")], kind=_KIND)


def _pencil(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pencil transmitter: a slim steel tube between a hexagon and a plug or a moulded cable."""
    r, tall, n = float(rng.uniform(0.008, 0.013)), float(rng.uniform(0.06, 0.16)), 14
    flats = 2.2 * r + 0.003
    body = [cylinder(0.0066, 0, 0.014, n), hexagon(flats, 0.012, 0.026), cylinder(r, 0.025, 0.025 + tall, n)]
    body.append(cylinder(1.04 * r, 0.3 * tall + 0.025, 0.34 * tall + 0.025, n))
    z = 0.025 + tall
    nut = [turned([(0.7 * r, z - 0.001), (0.85 * r, z + 0.01), (0.85 * r, z + 0.03), (0.4 * r, z + 0.045)], n)]
    way = [(0, 0, z + 0.04), (0, 0, z + 0.09), (0.03, 0.01, z + 0.14), (0.1, 0.02, z + 0.05), (0.11, 0.02, z - 0.1)]
    nut.append(bent(way, 0.0028, style))
    return Model([piece(body, _NAME, "trim"), piece(nut, _NAME, "rubber")], kind=_KIND)


def _turning(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A compact switch with a turning display: hexagon, can, a slanting face with keys, a round plug behind."""
    r, low = float(rng.uniform(0.015, 0.021)), float(rng.uniform(0.03, 0.05))
    n, tall = style.round(r), float(rng.uniform(0.05, 0.08))
    body = [cylinder(0.0066, 0, 0.02, 12), hexagon(0.027, 0.016, low), cylinder(r, low - 0.001, low + tall, n)]
    outline = np.array([(-r, 0.0), (r, 0.0), (r, 0.02), (-0.2 * r, 0.03), (-r, 0.012)])
    wedge = extrude(outline[:, ::1], -0.9 * r, 0.9 * r)
    # The outline lies in (y, z) and runs along x.
    top = moved(Solid(wedge.vertices[:, [2, 0, 1]], wedge.faces), at(0, 0, low + tall - 0.001))
    view = box((1.3 * r, 0.6 * r, 0.003), (0, -0.55 * r, low + tall + 0.022))
    plug = along(
        "y", merge([cylinder(0.006, 0.0, 0.02, 10), cylinder(0.0075, 0.01, 0.04, 10)]), 0, 0.95 * r, low + 0.7 * tall
    )
    parts = [piece(body, _NAME, "trim"), piece(top, _NAME, "rubber"), piece(view, "gauge face", "dial", _NAME)]
    return Model(placed([*parts, piece(plug, _NAME, "trim")], spun("z", float(rng.uniform(0, 6)))), kind=_KIND)


def _hygienic(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hygienic transmitter: a ferrule, a two-piece clamp with a wing nut (ISO 2852), a polished can with a lid."""
    r = float(rng.choice([0.0253, 0.032]))
    n, low = style.round(r), float(rng.uniform(0.015, 0.03))
    foot = [cylinder(0.4 * r, 0.0, low + 0.002, n), turned([(0.5 * r, low - 0.01), (r, low), (r, low + 0.003)], n)]
    lid = turned([(r, low + 0.0031), (r, low + 0.006), (0.5 * r, low + 0.016)], n)
    band = ring(0.88 * r, 1.22 * r, low - 0.005, low + 0.011, n)
    ears = box((0.024, 0.03, 0.014), (1.3 * r, 0, low + 0.003))
    wing = [
        along("y", cylinder(0.004, -0.03, 0.035, 8), 1.35 * r, 0, low + 0.003),
        box((0.03, 0.008, 0.01), (1.35 * r, 0.034, low + 0.003)),
    ]
    clamp = Part(merge([band, ears, *wing]), "clamp", "clamp", _NAME, JOINT)
    tall, wide = float(rng.uniform(0.05, 0.1)), float(rng.uniform(0.022, 0.042))
    m = style.round(wide)
    z = low + 0.015 + float(rng.uniform(0.02, 0.05))
    can = [cylinder(0.009, low + 0.01, z + 0.001, 12), turned([(0.6 * wide, z), (wide, z + 0.01), (wide, z + tall)], m)]
    can.append(cylinder(1.08 * wide, z + tall - 0.001, z + tall + 0.02, m))
    can.append(dome(1.02 * wide, 0.25 * wide, z + tall + 0.02, m))
    can.append(along("y", gland(style, rng, 0.016), 0, 0.97 * wide, z + 0.6 * tall))
    return Model([piece([*foot], _NAME, "pipe"), clamp, piece([lid, *can], _NAME, "trim")], kind=_KIND)


def _switch(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure switch: a bellows or diaphragm housing under a rectangular box with a scale window and a knob."""
    r, tall = float(rng.uniform(0.018, 0.035)), float(rng.uniform(0.02, 0.05))
    n = style.round(r)
    low = 0.03 + tall
    cell = [
        cylinder(0.0068, 0.0, 0.032, 12),
        hexagon(0.022, 0.012, 0.026),
        turned([(0.6 * r, 0.03), (r, 0.036), (r, low)], n),
    ]
    wide, deep, high = (float(rng.uniform(a, b)) for a, b in ((0.045, 0.09), (0.045, 0.07), (0.08, 0.14)))
    case = [
        box((wide, deep, high), (0, 0, low + high / 2 - 0.001)),
        box((1.03 * wide, 0.006, 0.96 * high), (0, -deep / 2, low + high / 2)),
    ]
    case.append(cylinder(0.012, low + high - 0.002, low + high + 0.014, 12))
    side = "x" if rng.random() < 0.5 else "-x"
    case.append(along(side, gland(style, rng), (0.5 if side == "x" else -0.5) * wide, 0, low + 0.25 * high))
    view = box((0.4 * wide, 0.003, 0.55 * high), (0, -deep / 2 - 0.0042, low + 0.55 * high))
    mark = box(
        (0.2 * wide, 0.002, 0.004), (0.05 * wide, -deep / 2 - 0.0065, low + float(rng.uniform(0.35, 0.75)) * high)
    )
    parts = [piece(cell, STEM, "trim"), piece(case, _NAME, str(rng.choice(["electrical", "valve", "rubber"])))]
    parts += [piece(view, "gauge face", "dial", _NAME), piece(mark, "gauge needle", "needle", _NAME)]
    return Model(placed(parts, spun("z", float(rng.uniform(0, 6)))), kind="pressure switch")


def differential_cell(style: ModelingStyle, rng: np.random.Generator, coplanar: bool) -> tuple[list[Part], float]:
    """A differential cell on z = 0 over a manifold, its process side below, and where its electronics begin."""
    if coplanar:
        wide = 0.09
        base = [
            box((wide, 0.075, 0.03), (0, 0, 0.015)),
            turned([(0.043, 0.03), (0.043, 0.06), (0.025, 0.085)], style.round(0.04)),
        ]
        bolts = [
            moved(merge([cylinder(0.005, -0.02, 0.034, 8), hexagon(0.017, 0.03, 0.04)]), at(x, y))
            for x in (-0.035, 0.035)
            for y in (-0.028, 0.028)
        ]
        return [piece(base, _NAME, "trim"), Part(merge(bolts), "bolt", "fastener", _NAME, JOINT, True)], 0.083
    flats = [box((0.022, 0.095, 0.08), (s * 0.027, 0, 0.04)) for s in (-1, 1)]
    body = [along("x", cylinder(0.042, -0.017, 0.017, style.round(0.042)), 0, 0, 0.042), cylinder(0.025, 0.06, 0.1, 14)]
    rods = along("x", around(cylinder(0.005, -0.048, 0.048, 8), 4, 0.045, np.pi / 4), 0, 0, 0.04)
    return [piece([*flats, *body], _NAME, "trim"), Part(rods, "bolt", "fastener", _NAME, JOINT, True)], 0.098


def _piped(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A differential transmitter on a manifold on a two-inch stand: bracket, U-bolt, needle valves, two tubes down."""
    height = float(rng.uniform(1.1, 1.5))
    parts, z, y = stand(height, style, rng), height - 0.3, -0.16
    wide, tall = 0.1, float(rng.choice([0.03, 0.06]))
    block = [box((wide, 0.07, tall), (0, y, z - tall / 2))]
    count = int(rng.choice([2, 3, 5]))
    for k, x in enumerate(np.linspace(-0.04, 0.04, count)):
        side, sign = ("x", 1) if k == count - 1 else ("-x", -1) if k == 0 else ("-y", 0)
        place = (sign * 0.5 * wide, y, z - tall / 2) if sign else (float(x), y - 0.035, z - tall / 2)
        block.append(along(side, t_handle(0.06, 0.05), *place))
    parts.append(piece(block, STEM, "trim"))
    cell, top = differential_cell(style, rng, bool(rng.random() < 0.6))
    head = piece(moved(housing(style, rng, str(rng.choice(["double", "single"]))), at(0, 0, top)), _NAME, "valve")
    parts += placed([*cell, head], at(0, y, z))
    for x in (-0.027, 0.027):
        nut = moved(hexagon(0.018, -0.02, 0.001), at(x, y, z - tall))
        way = [(x, y, z - tall - 0.01), (x, y, z - tall - 0.12), (x, y - 0.12, 0.4 * z), (1.5 * x, y - 0.12, 0.08)]
        parts.append(piece([nut, bent(way, 0.005, style)], STEM, "trim"))
    arm = [
        box((0.08, 0.006, 0.11), (0, -0.0335, z - 0.02)),
        box((0.08, -y - 0.073, 0.006), (0, (y + 0.001) / 2, z - tall - 0.003)),
    ]
    arm.append(box((0.08, 0.075, 0.006), (0, y, z - tall - 0.0031)))
    parts.append(Part(merge(arm), "bracket", "clamp", "", JOINT))
    a = np.linspace(0, np.pi, 9)
    bow = np.column_stack([0.034 * np.cos(a), 0.034 * np.sin(a), np.full(9, z)])
    path = np.vstack([[0.034, -0.05, z], bow, [-0.034, -0.05, z]])
    parts.append(Part(rope(path, 0.0035, 8), "u-bolt", "clamp", "", JOINT))
    return Model(parts, kind="differential pressure transmitter")


def _seal(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A remote-seal transmitter on its flange: a seal, an upright or bent link, the cell and its electronics."""
    thick, out = plate_thickness(dn), float(rng.uniform(0.05, 0.14))
    solids = [
        disc_flange(dn, style, thick + 0.001),
        cylinder(0.024, thick, thick + 0.02, 16),
        cylinder(0.012, thick, thick + out + 0.01, 12),
    ]
    cell, top = differential_cell(style, rng, bool(rng.random() < 0.5))
    head = piece(
        moved(housing(style, rng, str(rng.choice(["double", "single", "pot"]))), at(0, 0, top)), _NAME, "valve"
    )
    parts = [piece(solids, _NAME, "trim"), *placed([*cell, head], at(0, 0, thick + out))]
    if rng.random() < 0.4:  # the other capillary comes off sideways in a loop
        z = thick + out + 0.03
        way = [(0.034, 0, z), (0.14, 0, z), (0.2, 0.1, z - 0.03), (0.1, 0.22, z), (0.05, 0.3, z - 0.06)]
        parts.append(piece(bent(way, 0.004, style), _NAME, "rubber"))
    return Model(headed(parts), kind=_KIND)


def _probe(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A retractable analyser probe (pH, conductivity): a ball valve, a guide with rods, a shaft and head."""
    r, n = float(rng.uniform(0.012, 0.018)), 14
    valve = [
        cylinder(1.3 * r, 0.0, 0.11, n),
        hexagon(3.4 * r, 0.015, 0.035),
        hexagon(3.4 * r, 0.08, 0.1),
        box((3 * r, 3 * r, 0.04), (0, 0, 0.057)),
    ]
    lever = [
        along("y", cylinder(0.006, 1.4 * r, 2.6 * r, 8), 0, 0, 0.057),
        box((0.12, 0.006, 0.02), (0.05, 2.5 * r, 0.057)),
    ]
    parts = [
        Part(merge(valve), "valve body", "valve", _NAME, "Valve assembly"),
        Part(merge(lever), "lever", "handle", _NAME, "Valve assembly"),
    ]
    long = float(rng.uniform(0.2, 0.4))
    shaft = [
        cylinder(r, 0.1, 0.12 + long, n),
        cylinder(2.2 * r, 0.11, 0.125, n),
        cylinder(2.2 * r, 0.1 + 0.6 * long, 0.112 + 0.6 * long, n),
    ]
    shaft.append(around(cylinder(0.004, 0.12, 0.105 + 0.6 * long, 8), int(rng.choice([2, 3])), 1.8 * r))
    parts.append(piece(shaft, _NAME, "trim"))
    if rng.random() < 0.5:
        head = moved(housing(style, rng, "pot"), at(0, 0, 0.115 + long))
    else:
        z = 0.12 + long
        head = merge(
            [
                cylinder(0.7 * r, z - 0.001, z + 0.05, n),
                bent([(0, 0, z + 0.045), (0, 0, z + 0.1), (0.1, 0, z + 0.08), (0.12, 0, z - 0.15)], 0.004, style),
            ]
        )
    return Model([*parts, piece(head, _NAME, "rubber")], kind="analyser")


# --- sight glasses ---


def _body(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[Solid, float, float, float]:
    """A flanged body with two opposite window pads along y: solid, length, reach of its pads, radius of a pane."""
    radius, neck = PIPES[dn].radius, 0.485 * FLANGES[dn].hub
    length = 0.14 + 4 * radius
    body = flanged_body(
        dn,
        style,
        length,
        [(neck, 0.32 * length), (1.15 * neck, 0.4 * length), (1.15 * neck, 0.6 * length), (neck, 0.68 * length)],
    )
    return body, round(length, 6), 1.15 * neck + 0.012, 0.9 * radius + 0.012


def _windows(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sight glass with two bolted covers, square or round, and inside a flap, a rotor or nothing (DIN 3237)."""
    body, length, reach, pane = _body(dn, style, rng)
    square, half = bool(rng.random() < 0.5), 1.65 * pane
    n, x = style.round(pane), length / 2
    thick = 0.01 + 0.06 * pane
    core, covers, bolts = cylinder(1.2 * pane, -reach, reach, n), [], []
    for s in ("y", "-y"):
        outline = rounded_rectangle(2 * half, 2 * half, 0.25 * half, 3)
        cover = (
            extrude(outline, reach - 0.001, reach + thick, (n_circle(pane, n),))
            if square
            else ring(pane, half, reach - 0.001, reach + thick, n)
        )
        covers.append(along(s, cover, x))
        count, far = (4, 1.15 * half) if square else (int(rng.choice([4, 6, 8])), 0.82 * half)
        bolts.append(along(s, bolt_circle(count, far, 0.006 + 0.1 * pane, reach - 0.002, reach + thick), x))
    panes = merge([along(s, cylinder(0.99 * pane, reach + 0.0005, reach + 0.6 * thick, n), x) for s in ("y", "-y")])
    parts = [piece([body, along("y", core, x), *covers], _GLASS, "valve"), piece(panes, "gauge glass", "dial", _GLASS)]
    parts.append(Part(merge(bolts), "bolt", "fastener", _GLASS, JOINT, True))
    if rng.random() < 0.5:  # the spindle of a flap with its pointer before the window
        pin = along("y", cylinder(0.004, reach + 0.6 * thick, reach + thick + 0.02, 8), x, 0, 0)
        arrow = moved(
            box((1.2 * pane, 0.003, 0.008), (0.3 * pane, 0, 0)),
            at(x, reach + thick + 0.012, 0) @ spun("y", float(rng.uniform(0, 6))),
        )
        parts.append(piece([pin, arrow], "gauge needle", "handle", _GLASS))
    return Model(parts, length, kind=_GLASS)


def n_circle(radius: float, sides: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """A round hole."""
    a = np.arange(sides) * 2 * np.pi / sides
    return radius * np.column_stack([np.cos(a), np.sin(a)])


def _threaded(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A screwed bronze flow sight: two hexagon ends, a bowl with one or two screwed window rings, maybe a rotor."""
    radius = PIPES[dn].radius
    length, r = round(0.07 + 4.4 * radius, 6), 0.016 + 1.1 * radius
    n, x = style.round(r), length / 2
    deep = 1.1 * radius + 0.012
    bowl = along("y", turned([(0.8 * r, -deep), (r, -0.8 * deep), (r, deep)], n), x)
    body = [hex_end(dn, 0, 0.2 * length, style), hex_end(dn, 0.8 * length, length, style), bowl]
    body.append(along("x", cylinder(1.05 * radius, 0.15 * length, 0.85 * length, n)))
    fronts = ("-y",) if rng.random() < 0.5 else ("-y", "y")
    nut = turned(
        [(1.15 * r, deep - 0.006), (1.15 * r, deep + 0.008), (1.0 * r, deep + 0.012)], 8 if rng.random() < 0.5 else n
    )
    panes = []
    for s in fronts:
        body.append(along(s, nut, x))
        panes.append(along(s, dome(0.8 * r, 0.25 * r, deep + 0.012, n), x))
    parts = [
        piece(body, _GLASS, "handle" if rng.random() < 0.2 else "trim"),
        piece(panes, "gauge glass", "dial", _GLASS),
    ]
    return Model(parts, length, "welded", _GLASS)


def _full(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A full-view sight glass with screwed ends: a glass tube between two caps, tie rods outside, maybe a spinner."""
    radius = PIPES[dn].radius
    length, r = round(0.1 + float(rng.uniform(5, 8)) * radius, 6), 1.5 * radius + 0.008
    n, side = style.round(r), float(rng.uniform(2.6, 3.2)) * radius + 0.03
    low, thick = 0.17 * length, 0.012
    caps = [hex_end(dn, 0, low, style), hex_end(dn, length - low, length, style)]
    plate = (
        extrude(rounded_rectangle(side, side, 0.2 * side, 3), low - thick, low)
        if rng.random() < 0.6
        else cylinder(0.6 * side, low - thick, low, n)
    )
    caps += [along("x", plate), along("x", moved(plate, at(0, 0, length - 2 * low + thick)))]
    pane = along("x", ring(0.85 * r, r, low, length - low, n))
    far = 0.36 * side * np.sqrt(2) if side * 0.36 * np.sqrt(2) > r + 0.006 else r + 0.006
    rods = along("x", around(cylinder(0.004, low - thick - 0.008, length - low + thick + 0.008, 8), 4, far, np.pi / 4))
    parts = [piece(caps, _GLASS, "trim"), piece(pane, "gauge glass", "dial", _GLASS)]
    parts.append(Part(rods, "stud", "fastener", _GLASS, JOINT, True))
    if rng.random() < 0.4:
        vanes = along(
            "x",
            merge(
                [
                    around(box((0.5 * r, 0.003, 0.02), (0.3 * r, 0, 0)), 4),
                    cylinder(0.1 * r, low - length / 2, length / 2 - low, 8),
                ]
            ),
            length / 2,
        )
        parts.append(piece(vanes, "gauge needle", "handle", _GLASS))
    return Model(parts, length, "welded", _GLASS)


def _port(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A round sight port on a vessel's nozzle (DIN 28120): a pane under a bolted ring, maybe a wiper or a lamp."""
    size, thick, n = FLANGES[dn], plate_thickness(dn), style.round(FLANGES[dn].raised / 2)
    pane, inner = 0.42 * size.raised, 0.36 * size.raised
    block = disc_flange(dn, style, thick + 0.002)
    cover = [
        ring(inner, 0.55 * size.raised, thick, thick + 0.012, n),
        ring(0.9 * pane, 1.05 * pane, thick + 0.01, thick + 0.018, n),
    ]
    parts = [
        piece([block, *cover], _GLASS, "trim"),
        piece(cylinder(0.99 * inner, thick + 0.002, thick + 0.009, n), "gauge glass", "dial", _GLASS),
    ]
    parts.append(screws(int(rng.choice([4, 6, 8])), 0.5 * size.raised, 0.006, thick + 0.001, thick + 0.012, _GLASS))
    if rng.random() < 0.5:
        post = rod((0.48 * size.raised, 0, thick + 0.011), (0.48 * size.raised, 0, thick + 0.08), 0.005, 8)
        lean = at(0.4 * size.raised, 0, thick + 0.08) @ spun("y", -0.5)
        torch = turned([(0.5 * inner, -0.02), (0.5 * inner, 0.07), (0.35 * inner, 0.09)], 14)
        parts.append(Part(merge([post, moved(torch, lean)]), "lamp", "electrical", _GLASS, "Electrical and safety"))
    return Model(headed(parts), kind=_GLASS)


def _moisture(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A refrigerant sight glass: a brass block on copper stubs, a bull's eye on top, maybe its cap on a strap."""
    radius = PIPES[dn].radius
    length, r = round(0.09 + 3 * radius, 6), 0.012 + 0.75 * radius
    n, x = style.round(r), length / 2
    body = [
        along("x", ring(bore_of(dn, style), 1.12 * radius, 0.0, length, style.round(radius))),
        moved(cylinder(r, -1.1 * radius, 1.15 * radius + 0.012, n), at(x)),
    ]
    top = 1.15 * radius + 0.012
    body.append(moved(hexagon(2.1 * r, top - 0.012, top), at(x)))
    pane = moved(dome(0.8 * r, 0.3 * r, top, n), at(x))
    parts = [piece(body, _GLASS, "trim"), piece(pane, "gauge glass", "dial", _GLASS)]
    if rng.random() < 0.5:
        strap = rod((x, 0.9 * r, top - 0.004), (x, 1.9 * r, top + 0.01), 0.002, 6)
        cap = moved(cylinder(0.9 * r, 0.0, 0.008, n), at(x, 2.7 * r, top + 0.01) @ spun("x", 0.7))
        parts.append(piece([strap, cap], _GLASS, "rubber"))
    return Model(parts, length, "welded", _GLASS)


def _family(name: str, build: object, place: str = "tap", sizes: tuple[int, ...] = (15,), whole: str = _NAME) -> Family:
    return Family(name, place, "Gauge assembly", whole, build, sizes)  # type: ignore[arg-type]


_SMALL = tuple(dn for dn in SIZES if dn <= 50)
PRESSURE_BUILDS: tuple[Family, ...] = (
    _family("transmitter/single chamber", _single),
    _family("transmitter/pencil", _pencil),
    _family("transmitter/turning display", _turning),
    _family("transmitter/hygienic", _hygienic),
    _family("transmitter/switch box", _switch),
    _family("transmitter/pipe stand", _piped, "floor"),
    _family("transmitter/flange seal", _seal, "head", (40, 50, 80, 100)),
    _family("transmitter/probe", _probe),
    _family("sight glass/bolted windows", _windows, "inline", tuple(dn for dn in SIZES if dn <= 150), _GLASS),
    _family("sight glass/threaded", _threaded, "inline", _SMALL, _GLASS),
    _family("sight glass/full view", _full, "inline", _SMALL, _GLASS),
    _family("sight glass/port", _port, "head", (50, 80, 100, 150, 200), _GLASS),
    _family("sight glass/refrigerant", _moisture, "inline", tuple(dn for dn in SIZES if dn <= 40), _GLASS),
)
