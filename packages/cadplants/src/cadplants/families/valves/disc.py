"""Butterfly valves of further makes: triple offset, waterworks, mono-flange, hygienic, plastic, high performance."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_lever, shaft
from cadplants.families.valves.actuation_hand import slab, span
from cadplants.families.valves.ball import clamped_ends, ferrule, part_ring
from cadplants.families.valves.body import (
    blade,
    bolts_on,
    ended,
    metal,
    neck_of,
    packing,
    plate_outline,
    trim,
    turned_blade,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["DISCS"]

Rng = np.random.Generator


def _neck(low: float, high: float, slim: float, style: ModelingStyle, rng: Rng) -> tuple[Solid, Part]:
    """A neck up to a mounting pad on ``high`` and the pad's bolts: slim, stout, oval or a two-storey yoke [m]."""
    n = max(12, style.round(slim))
    kind, t = int(rng.integers(3)), 0.008 + 0.1 * slim
    outline = plate_outline(str(rng.choice(["square", "round", "octagon"])), 2.2 * slim, 2.2 * slim, n)
    if kind == 0:
        solids = [turned([(1.3 * slim, low), (slim, low + 0.3 * (high - low)), (slim, high - t)], n)]
    elif kind == 1:
        solids = [slab(rounded_rectangle(1.8 * slim, 2.6 * slim, 0.6 * slim, 3), low, high - t)]
    else:
        step = low + 0.45 * (high - low)
        posts = [
            box((0.5 * slim, 0.7 * slim, high - step), (0, s * 1.4 * slim, (high + step - t) / 2)) for s in (-1, 1)
        ]
        solids = [
            turned([(1.3 * slim, low), (1.1 * slim, step), (1.9 * slim, step), (1.9 * slim, step + t)], n),
            *posts,
        ]
    return merge([*solids, slab(outline, high - t, high)]), bolts_on(
        outline, 4, high - t, high + 0.004, 0.006 + 0.08 * slim
    )


def _triple(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A triple-offset butterfly valve: long double-flanged body (EN 558 series 14), bearing cover, gland, gear."""
    radius, size, bore = PIPES[dn].radius, FLANGES[dn], PIPES[dn].bore
    thick = plate_thickness(dn)
    length = float(rng.choice([0.127 + 0.2 * radius * 2, 0.15 + 0.9 * radius]))
    x, n = 0.45 * length, max(16, style.round(size.outer / 2))
    wall = float(rng.uniform(1.12, 1.3)) * bore + 0.006
    neck, _ = neck_of(dn)
    wall = min(wall, 0.95 * neck + 0.01)
    body = ended(
        dn,
        style,
        length,
        [(neck, thick), (wall, thick + 0.12 * length), (wall, length - thick - 0.12 * length), (neck, length - thick)],
        "flanged",
    )
    slim, high = 0.16 * radius + 0.012, 0.5 * size.outer + float(rng.uniform(0.03, 0.1)) + 0.2 * radius
    tower, bolts = _neck(0.9 * wall, high, slim, style, rng)
    bottom = 0.5 * size.outer * float(rng.uniform(0.85, 1.05))
    foot = [cylinder(1.2 * slim, -bottom, -0.9 * bore, 16), cylinder(1.8 * slim, -bottom - 0.012, -bottom, 16)]
    cover = merge(
        [
            cylinder(1.8 * slim, -bottom - 0.026, -bottom - 0.012, 16),
            around(hexagon(0.012, -bottom - 0.034, -bottom - 0.026), 4, 1.35 * slim),
        ]
    )
    parts = [
        metal(merge([body, moved(merge([tower, *foot]), at(x))])),
        trim(cover, "valve bonnet", x, "valve"),
        *placed([bolts], at(x)),
    ]
    gland, _ = packing(0.4 * slim, style, rng)
    parts += placed([*gland, shaft(0.0, 0.05 + 0.2 * radius, 0.4 * slim, style)], at(x, 0, high))
    if style.hollow:
        parts += turned_blade(bore, x, style, rng)
        parts.append(trim(about_x(ring(0.94 * bore, 0.999 * bore, x - 0.06 * bore, x + 0.06 * bore, n)), "valve body"))
    if rng.random() < 0.4:
        parts.append(
            metal(
                merge(
                    [
                        box((0.5 * length, 0.02, 0.35 * bottom), (length / 2, s * 0.6 * wall, -0.82 * bottom))
                        for s in (-1, 1)
                    ]
                )
            )
        )
    parts += quarter_turn(
        x, high + 0.012, radius, style, rng, ("worm", "worm", "scotch", "multi-turn", "electrohydraulic", "rack")
    )
    return Model(parts, round(length, 6), kind="butterfly valve")


def _waterworks(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A waterworks butterfly valve: ribbed double-flanged shell with bosses and feet, dished disc, gear (EN 593)."""
    radius, size, bore = PIPES[dn].radius, FLANGES[dn], PIPES[dn].bore
    length, thick = 0.13 + 0.45 * radius, plate_thickness(dn)
    x, n = length / 2, max(16, style.round(size.outer / 2))
    wall = 1.06 * bore + 0.008
    neck, _ = neck_of(dn)
    body = [
        ended(
            dn,
            style,
            length,
            [(min(neck, 1.02 * wall), thick), (wall, 0.5 * length), (min(neck, 1.02 * wall), length - thick)],
            "flanged",
        )
    ]
    count, reach = int(rng.choice([4, 6, 8])), 0.44 * size.outer
    rib = box(
        (length - 1.6 * thick, 0.008 + 0.04 * radius, reach - 0.95 * wall), (length / 2, 0, (reach + 0.95 * wall) / 2)
    )
    body += [moved(rib, spun("x", (k + 0.5) * 2 * np.pi / count)) for k in range(count)]
    if rng.random() < 0.5:
        body.append(about_x(ring(0.96 * wall, 1.1 * wall, 0.42 * length, 0.58 * length, n)))
    slim, side = 0.2 * radius + 0.014, float(rng.choice([0.0, 0.5, -0.5])) * np.pi
    high = 0.52 * size.outer + 0.02
    tower = [
        turned(
            [(1.6 * slim, 0.95 * wall), (1.3 * slim, high - 0.03), (2.0 * slim, high - 0.018), (2.0 * slim, high)], 20
        )
    ]
    tower.append(
        turned([(1.2 * slim, -0.48 * size.outer), (1.5 * slim, -0.46 * size.outer), (1.6 * slim, -0.95 * wall)], 20)
    )
    body.append(moved(merge(tower), at(x) @ spun("x", side)))
    if rng.random() < 0.6:
        body += [
            box((0.02, 0.8 * size.outer * 0.7, 0.02), (sx, 0, -0.5 * size.outer + 0.01))
            for sx in (thick / 2 + 0.006, length - thick / 2 - 0.006)
        ]
    rest = [shaft(0.0, 0.02, 0.5 * slim, style), bolted(around(hexagon(0.016, 0.0, 0.01), 4, 1.6 * slim, 0.7))]
    upright = placed(
        [
            *rest,
            *quarter_turn(0, 0.005, radius, style, rng, ("worm", "worm", "bevel", "multi-turn", "scotch", "lever")),
        ],
        at(0, 0, high),
    )
    parts = [metal(merge(body)), *placed(upright, at(x) @ spun("x", side))]
    if style.hollow:
        disc = moved(blade(bore, style, rng), spun("z", float(rng.choice([0.0, 0.4, 0.5])) * np.pi))
        parts.append(trim(moved(disc, at(x) @ spun("x", side)), "valve disc"))
    return Model(parts, round(length, 6), kind="butterfly valve")


def _mono(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A mono-flange or U-section butterfly valve: one wide drilled plate round a rubber-lined ring (EN 593)."""
    radius, size, bore = PIPES[dn].radius, FLANGES[dn], PIPES[dn].bore
    length = FACE_TO_FACE["butterfly"][dn]
    x, n = length / 2, max(16, style.round(size.outer / 2))
    hole = (
        ()
        if not style.holes
        else tuple(
            circle(0.55 * size.bolt, 8, (size.circle / 2 * np.cos(t), size.circle / 2 * np.sin(t)))
            for t in np.pi / size.n_bolts + np.arange(size.n_bolts) * 2 * np.pi / size.n_bolts
        )
    )
    holes = (circle(1.1 * bore, n), *hole)
    if rng.random() < 0.5:
        plates = [along("x", slab(circle(size.outer / 2, n), 0.32 * length, 0.68 * length, holes))]
    else:
        thin = 0.22 * length
        plates = [
            along("x", slab(circle(size.outer / 2, n), z, z + thin, holes))
            for z in (0.06 * length, 0.94 * length - thin)
        ]
    hub = about_x(ring(1.05 * bore, 0.47 * (size.circle - size.bolt), 0.04 * length, 0.96 * length, n))
    liner = about_x(
        part_ring(
            [
                (bore, 0.0),
                (1.22 * bore, 0.0),
                (1.22 * bore, 0.05 * length),
                (1.06 * bore, 0.06 * length),
                (1.06 * bore, 0.94 * length),
                (1.22 * bore, 0.95 * length),
                (1.22 * bore, length),
                (bore, length),
            ],
            n,
        )
    )
    slim, high = min(0.32 * length, 0.16 * radius + 0.012), 0.5 * size.outer + 0.035 + 0.3 * radius
    tower, bolts = _neck(0.48 * size.outer, high, slim, style, rng)
    parts = [
        metal(merge([*plates, hub, moved(tower, at(x))])),
        trim(liner, "valve body", 0.0, "rubber"),
        *placed([bolts], at(x)),
        *turned_blade(bore, x, style, rng),
        *placed([shaft(0.0, 0.012, 0.45 * slim, style)], at(x, 0, high)),
        *quarter_turn(x, high + 0.006, radius, style, rng, ("worm", "rack", "lever", "motor box", "scotch")),
    ]
    return Model(parts, length, "wafer", "butterfly valve")


def _hygienic_drive(x: float, high: float, boss: float, radius: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """A squeeze lever over its index plate, or an actuator [m]."""
    parts: list[Part] = []
    pick = rng.random()
    if pick < 0.6:
        reach = 0.09 + 1.3 * radius
        index = trim(
            merge(
                [
                    slab(circle(2.2 * boss, 16), high + 0.001, high + 0.004),
                    *(
                        box((0.004, 0.004, 0.006), (2.0 * boss * np.cos(t), 2.0 * boss * np.sin(t), high + 0.005))
                        for t in np.linspace(0, 1.57, 4)
                    ),
                ]
            ),
            "position indicator",
            x,
        )
        parts += [
            index,
            *placed([hand_lever(reach, high + 0.008, style, rng, ("notched", "notched", "sheet", "bar"))], at(x)),
        ]
    else:
        parts += quarter_turn(x, high + 0.002, radius, style, rng, ("vertical", "vertical", "rack"))
    return parts


def _hygienic(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A hygienic butterfly valve: two polished halves, weld or clamp ends, a squeeze lever or a cylinder."""
    radius, bore = PIPES[dn].radius, PIPES[dn].bore
    clamped = rng.random() < 0.5
    stub = 0.03 if clamped else 0.0
    core = float(rng.choice([0.05, 0.075])) + 0.5 * radius
    length, x = core + 2 * stub, core / 2 + stub
    half, n = 0.012 + 0.08 * radius, max(16, style.round(1.4 * radius))
    big = 1.3 * radius + 0.009
    tube_ = []
    for low, high, face in ((stub, x, True), (x, length - stub, False)):
        if clamped:
            tube_.append(ferrule(dn, low, high, style, face))
        else:
            tube_.append(along("x", ring(bore if style.hollow else 0.0, radius, low, high, n)))
    waist = about_x(
        part_ring(
            [
                (0.98 * radius, x - half),
                (0.85 * big, x - half),
                (big, x - 0.7 * half),
                (big, x - 0.08 * half),
                (0.97 * big, x - 0.06 * half),
                (0.97 * big, x + 0.06 * half),
                (big, x + 0.08 * half),
                (big, x + 0.7 * half),
                (0.85 * big, x + half),
                (0.98 * radius, x + half),
            ],
            n,
        )
    )
    lugs = about_x(
        around(
            merge([cylinder(0.007, x - 1.0 * half, x + 1.0 * half, 12), hexagon(0.011, x + half, x + half + 0.005)]),
            int(rng.choice([2, 4])),
            1.02 * big,
            np.pi / 4,
        )
    )
    boss, high = 0.2 * radius + 0.007, big + 0.014
    tower = cylinder(boss, 0.95 * radius, high, 16)
    parts = [
        metal(merge([*tube_, waist, moved(tower, at(x))]), 0.0, "clamp"),
        bolted(lugs),
        *placed([shaft(high - 0.004, high + 0.012, 0.6 * boss, style)], at(x)),
    ]
    if style.hollow:
        parts += turned_blade(bore, x, style, rng)
    if clamped:
        parts += clamped_ends(dn, stub, length, style, rng)
    parts += _hygienic_drive(x, high, boss, radius, style, rng)
    return Model(parts, round(length, 6), "welded", "butterfly valve")


def _plastic(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A plastic wafer butterfly valve: a moulded ribbed body, a notched handle over a ratchet plate."""
    radius, size, bore = PIPES[dn].radius, FLANGES[dn], PIPES[dn].bore
    length = FACE_TO_FACE["butterfly"][dn]
    x, n = length / 2, max(16, style.round(size.outer / 2))
    outer = 0.5 * size.outer
    skin = about_x(
        part_ring(
            [
                (bore, 0.0),
                (0.47 * (size.circle - size.bolt), 0.0),
                (0.47 * (size.circle - size.bolt), length),
                (bore, length),
            ],
            n,
        )
    )
    web = about_x(ring(0.4 * (size.circle - size.bolt), outer, 0.4 * length, 0.6 * length, n))
    rim = about_x(ring(0.95 * outer, outer, 0.1 * length, 0.9 * length, n))
    ribs = [
        moved(
            box(
                (0.8 * length, 0.006, outer - 0.45 * (size.circle - size.bolt)),
                (x, 0, (outer + 0.45 * (size.circle - size.bolt)) / 2),
            ),
            spun("x", t),
        )
        for t in np.arange(2 * size.n_bolts) * np.pi / size.n_bolts
    ]
    slim, high = 0.18 * radius + 0.011, outer + 0.03 + 0.35 * radius
    tower = merge(
        [
            slab(rounded_rectangle(1.7 * slim, 2.4 * slim, 0.4 * slim, 3), 0.97 * outer, high),
            *(
                box((0.8 * slim, 0.005, high - 0.98 * outer), (0, s * 1.5 * slim, (high + 0.98 * outer) / 2))
                for s in (-1, 1)
            ),
            box((2.2 * slim, 3.6 * slim, 0.01), (0, 0, high - 0.005)),
        ]
    )
    angles = np.linspace(-0.2, 1.8, 21)
    reach = 0.04 + 0.9 * radius
    teeth = [
        (reach * (1.0 if k % 2 else 0.93) * np.cos(a), reach * (1.0 if k % 2 else 0.93) * np.sin(a))
        for k, a in enumerate(angles)
    ]
    ratchet = slab(np.array([*teeth, (-1.6 * slim, 0.8 * slim), (-1.6 * slim, -1.2 * slim)]), high, high + 0.006)
    parts = [
        metal(merge([skin, web, rim, *ribs, moved(tower, at(x))])),
        trim(ratchet, "position indicator", x),
        *turned_blade(bore, x, style, rng),
    ]
    parts += placed([shaft(high - 0.01, high + 0.02, 0.4 * slim, style)], at(x))
    if rng.random() < 0.75:
        parts += placed(
            [hand_lever(0.12 + 1.6 * radius, high + 0.01, style, rng, ("notched", "notched", "cast"))], at(x)
        )
    else:
        parts += quarter_turn(x, high + 0.006, radius, style, rng, ("worm", "rack", "motor box"))
    return Model(parts, length, "wafer", "butterfly valve")


def _damper(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A single-blade damper in a short duct piece: bead ends, shaft right through, quadrant lever."""
    radius, bore = PIPES[dn].radius, PIPES[dn].bore
    length, n = float(rng.uniform(1.2, 2.4)) * radius + 0.05, max(16, style.round(radius))
    x = length / 2
    body = [about_x(ring(bore, radius, 0.0, length, n))]
    if rng.random() < 0.6:
        body += [about_x(ring(0.995 * radius, radius + 0.012, z, z + 0.004, n)) for z in (0.02, length - 0.024)]
    body += [cylinder(0.012 + 0.05 * radius, *span(s * 0.98 * radius, s * (radius + 0.02)), 12) for s in (-1, 1)]
    body[-2:] = [moved(one, at(x)) for one in body[-2:]]
    high, slim = radius + 0.02, 0.005 + 0.03 * radius
    angles = np.linspace(-0.3, 2.0, 14)
    reach = 0.04 + 0.5 * radius
    plate = np.array(
        [(reach * np.cos(a), reach * np.sin(a)) for a in angles]
        + [(-0.6 * reach, 0.3 * reach), (-0.4 * reach, -0.4 * reach), (0.6 * reach, -0.5 * reach)]
    )
    slot = np.array(
        [(0.85 * reach * np.cos(a), 0.85 * reach * np.sin(a)) for a in angles[2:-2]]
        + [(0.72 * reach * np.cos(a), 0.72 * reach * np.sin(a)) for a in angles[-3:1:-1]]
    )
    parts = [
        metal(merge(body)),
        *turned_blade(bore, x, style, rng),
        trim(slab(plate, high, high + 0.003, (slot,)), "position indicator", x),
        *placed([shaft(-radius - 0.03, high + 0.02, slim, style)], at(x)),
    ]
    if rng.random() < 0.65:
        wing = merge([cylinder(0.004, high - 0.004, high + 0.02, 8), box((0.025, 0.004, 0.012), (0, 0, high + 0.02))])
        parts += placed(
            [
                hand_lever(1.5 * reach + 0.03, high + 0.006, style, rng, ("sheet", "bar", "sheet")),
                bolted(moved(wing, at(0.78 * reach))),
            ],
            at(x),
        )
    else:
        parts += quarter_turn(x, high + 0.006, 0.8 * radius, style, rng, ("motor box", "rack"))
    return Model(parts, round(length, 6), "welded", "butterfly valve")


_BIG = tuple(dn for dn in SIZES if dn >= 50)
_WAFER = tuple(dn for dn in SIZES if dn >= 40)


def _family(name: str, build: object, sizes: tuple[int, ...]) -> Family:
    return Family(name, "inline", "Valve assembly", "valve", build, sizes)  # type: ignore[arg-type]


DISCS: tuple[Family, ...] = (
    _family("butterfly valve/triple offset", _triple, _BIG),
    _family("butterfly valve/waterworks", _waterworks, _BIG),
    _family("butterfly valve/mono-flange", _mono, _WAFER),
    _family("butterfly valve/hygienic", _hygienic, tuple(dn for dn in SIZES if 25 <= dn <= 150)),
    _family("butterfly valve/plastic", _plastic, _WAFER),
    _family("butterfly valve/duct damper", _damper, tuple(dn for dn in SIZES if dn >= 80)),
)
