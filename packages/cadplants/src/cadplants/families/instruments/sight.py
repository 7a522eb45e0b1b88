"""Further sight glasses: hygienic, caged, on machines, above funnels."""

from __future__ import annotations

import numpy as np

from cadplants.families.instruments.pieces import JOINT, fine_sides, piece, screws
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["SIGHT_BUILDS"]

_GLASS = "sight glass"


def _hygienic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hygienic sight glass: a bare or caged tube between two ferrules with clamps (DIN 32676), weld ends."""
    radius = PIPES[dn].radius
    length, end = round(0.13 + float(rng.uniform(2.5, 5)) * radius, 6), 0.035
    r, n = 1.15 * radius, style.round(radius)
    lip = 1.25 * radius + 0.008
    bore = bore_of(dn, style)
    stub = turned([(radius, 0.0), (radius, end - 0.008), (lip, end - 0.003), (lip, end)], n, bore=bore)
    cap = turned([(lip, end), (lip, end + 0.003), (1.1 * r, end + 0.01), (1.1 * r, end + 0.02)], n, bore=bore)
    band = [
        ring(0.95 * lip, lip + 0.006, end - 0.007, end + 0.008, n),
        box((0.022, 0.03, 0.013), (lip + 0.012, 0, end)),
    ]
    band.append(along("y", cylinder(0.004, -0.028, 0.03, 8), lip + 0.014, 0, end))
    flip = at(length) @ spun("z", np.pi)
    metal = [along("x", cap), along("x", stub)]
    parts = [piece([*metal, *(moved(m, flip) for m in metal)], _GLASS, "trim")]
    hoop = along("x", merge(band))
    parts.append(Part(merge([hoop, moved(hoop, flip)]), "clamp", "clamp", _GLASS, JOINT))
    tube = along("x", ring(0.9 * r, r, end + 0.012, length - end - 0.012, n))
    parts.append(piece(tube, "gauge glass", "dial", _GLASS))
    if rng.random() < 0.6:  # a cage of bars
        count = int(rng.choice([3, 4, 6]))
        bars = around(cylinder(0.004, end + 0.014, length - end - 0.014, 8), count, 1.1 * r + 0.003)
        parts.append(piece(along("x", bars), _GLASS, "trim"))
    return Model(parts, length, "welded", _GLASS)


def _cage(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A tubular sight glass whose two flanges are one casting: long ribs between them leave windows for the tube."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    length, low = round(0.14 + float(rng.uniform(2.5, 4.5)) * radius, 6), plate_thickness(dn)
    n, r = style.round(1.2 * radius), 1.2 * radius + 0.004
    plates = [
        along("x", disc_flange(dn, style, low + 0.012, bore_of(dn, style))),
        moved(along("-x", disc_flange(dn, style, low + 0.012, bore_of(dn, style))), at(length)),
    ]
    outer = min(1.25 * r + 0.006, size.circle / 2 - 0.6 * size.hole)
    count, wide = int(rng.choice([2, 3, 4])), float(rng.uniform(0.4, 0.9)) * r
    rib = box((0.01, wide, length - 2 * low), (0, 0, length / 2))
    ribs = along("x", around(rib, count, outer + 0.004, np.pi / 4))
    rings = [
        along("x", ring(0.98 * r, outer + 0.009, z - 0.008, z + 0.008, n)) for z in (low + 0.02, length - low - 0.02)
    ]
    pane = along("x", ring(0.86 * r, r, low + 0.011, length - low - 0.011, n))
    parts = [piece([*plates, ribs, *rings], _GLASS, "valve"), piece(pane, "gauge glass", "dial", _GLASS)]
    return Model(parts, length, kind=_GLASS)


def _eye(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Oil sight glasses on a machine's housing: bull's eyes with a hexagon or a screwed ring, and a breather."""
    size = (float(rng.uniform(0.4, 0.9)), float(rng.uniform(0.25, 0.5)), float(rng.uniform(0.3, 0.6)))
    parts = [Part(box(size, (0, size[1] / 2, size[2] / 2)), "tank", "tank", "", "Tank")]
    count = int(rng.integers(1, 4))
    for k in range(count):
        r = float(rng.uniform(0.012, 0.03))
        n = style.round(r)
        if rng.random() < 0.5:
            eye = [
                piece(hexagon(2.6 * r, 0.0, 0.35 * r), _GLASS, "trim"),
                piece(cylinder(1.1 * r, 0.35 * r, 0.5 * r, n), _GLASS, "trim"),
            ]
            eye.append(piece(dome(0.85 * r, 0.3 * r, 0.5 * r, n), "gauge glass", "dial", _GLASS))
        else:
            eye = [
                piece(
                    [cylinder(1.6 * r, 0.0, 0.2 * r, n), ring(0.85 * r, 1.15 * r, 0.2 * r, 0.5 * r, n)], _GLASS, "trim"
                )
            ]
            eye.append(piece(cylinder(0.84 * r, 0.2 * r, 0.35 * r, n), "gauge glass", "dial", _GLASS))
            eye.append(screws(int(rng.choice([3, 4, 6])), 1.38 * r, 0.12 * r + 0.002, 0.1 * r, 0.2 * r, _GLASS))
        x = (k - (count - 1) / 2) * 0.12
        parts += placed(eye, at(x, 0, float(rng.uniform(0.3, 0.7)) * size[2]) @ spun("x", np.pi / 2))
    plug = merge([cylinder(0.018, 0.0, 0.02, 14), turned([(0.03, 0.02), (0.034, 0.05), (0.025, 0.06)], 16)])
    cap = moved(plug, at(0.3 * size[0], 0.5 * size[1], size[2]))
    return Model([*parts, Part(cap, "pipe cap", "rubber", "", "Pipe assembly")], kind=_GLASS)


def _funnel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A drip sight: a spout over a funnel on a drain pipe, a glass cylinder and maybe two stays between them."""
    dn, high = int(rng.choice([25, 40, 50])), float(rng.uniform(0.4, 0.9))
    r = PIPES[dn].radius
    wide, n = float(rng.uniform(1.8, 2.6)) * r, style.round(2 * r)
    drain = cylinder(r, 0.0, high, style.round(r))
    funnel = turned(
        [
            (1.15 * r, high - 0.03),
            (1.15 * r, high),
            (wide, high + 1.2 * wide),
            (0.93 * wide, high + 1.2 * wide),
            (0.5 * r, high + 0.01),
        ],
        n,
    )
    gap, top = float(rng.uniform(0.05, 0.1)), high + 1.2 * wide
    head = turned(
        [(wide, top + gap), (wide, top + gap + 0.01), (1.15 * r, top + gap + 0.03), (1.15 * r, top + gap + 0.06)], n
    )
    spout = cylinder(0.6 * r, top + 0.3 * gap, top + gap + 0.001, fine_sides(r, style))
    feed = cylinder(r, top + gap + 0.058, top + gap + float(rng.uniform(0.3, 0.8)), style.round(r))
    parts = [Part(drain, "pipe", "pipe", "", "Pipe assembly"), Part(feed, "pipe", "pipe", "", "Pipe assembly")]
    x = 1.02 * wide + 0.002
    stays = [rod((s * x, 0, top - 0.03), (s * x, 0, top + gap + 0.012), 0.003, 8) for s in (-1, 1)]
    ears = [box((0.014, 0.014, 0.01), (s * wide, 0, z)) for s in (-1, 1) for z in (top - 0.006, top + gap + 0.005)]
    metal = [funnel, head, spout, *([*stays, *ears] if rng.random() < 0.5 else [])]
    parts.append(piece(metal, _GLASS, str(rng.choice(["trim", "handle"]))))
    parts.append(piece(ring(0.94 * wide, 0.99 * wide, top, top + gap, n), "gauge glass", "dial", _GLASS))
    return Model(parts, kind=_GLASS)


def _family(name: str, build: object, place: str, sizes: tuple[int, ...]) -> Family:
    return Family(name, place, "Gauge assembly", _GLASS, build, sizes)  # type: ignore[arg-type]


SIGHT_BUILDS: tuple[Family, ...] = (
    _family("sight glass/hygienic", _hygienic, "inline", tuple(dn for dn in SIZES if 20 <= dn <= 100)),
    _family("sight glass/ribbed", _cage, "inline", tuple(dn for dn in SIZES if dn <= 150)),
    _family("sight glass/oil eye", _eye, "floor", (15,)),
    _family("sight glass/drip", _funnel, "floor", (15,)),
)
