"""What machines are placed together from: motors and their covers, couplings, guards, bases, volutes, mouths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.valves.valve import disc_flange
from cadplants.family import Part, Port, placed
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle, section_channel, section_i
from cadplants.primitives import (
    along,
    around,
    box,
    cylinder,
    hexagon,
    lofted,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.transforms import at, looking, spun

__all__ = [
    "BASES",
    "CASING",
    "GUARDS",
    "LYING",
    "MOTORS",
    "PUMP",
    "anchors",
    "base",
    "coupling",
    "dead_room",
    "foreign",
    "guard",
    "motor",
    "mouth",
    "slab",
    "train",
    "volute",
]

CASING = "pump casing"
PUMP = "Pump unit"
LYING: Floats = spun("y", np.pi / 2) @ spun("z", np.pi)  # a motor's z to x, its x up
MOTORS = ("cast", "cast", "square", "smooth", "drip", "ex")


def foreign(parts: Sequence[Part]) -> list[Part]:
    """Parts of a pump unit in a device of another group."""
    return [replace(p, group=p.group or PUMP) for p in parts]


def dead_room(dn: int) -> float:
    """Least length of a mouth behind whose flange nuts have room [m]."""
    return plate_thickness(dn) + nut_room(dn) + 0.01


def mouth(
    dn: int, style: ModelingStyle, face: Sequence[float], way: Sequence[float], reach: float
) -> tuple[Solid, Port]:
    """A flange at a point that looks some way, its neck ``reach`` [m] long behind it; and the port."""
    frame = looking(face, way)
    return moved(disc_flange(dn, style, reach), frame @ spun("y", -np.pi / 2)), Port(frame, dn)


def slab(outline: Floats, low: float, high: float) -> Solid:
    """A prism along x over an outline in (y, z)."""
    return about_x(extrude(outline, low, high))


def volute(r: float, half: float, style: ModelingStyle, growth: float = 0.35, hub: float = 0.6) -> Solid:
    """A spiral housing about z that widens by ``growth``, ``half`` of its width to each side [m]."""
    a = np.linspace(0, 2 * np.pi, max(16, style.round(r)), endpoint=False)
    unit = np.column_stack([np.cos(a), np.sin(a)])
    rim = (r * (1 + growth * a / (2 * np.pi)))[:, None]
    levels = [
        (0.0, -half),
        (0.55, -0.92 * half),
        (1.0, -0.45 * half),
        (1.0, 0.45 * half),
        (0.55, 0.92 * half),
        (0, half),
    ]
    loops = []
    for share, z in levels:
        radius = hub * r + share * (rim - hub * r)
        loops.append(np.column_stack([radius * unit, np.full(len(a), z)]))
    return lofted(loops)


# --- motors ---


def _parallel_fins(r: float, low: float, high: float, count: int) -> list[Solid]:
    """Fins as cast frames have them: upright above and below, level at the sides."""
    thick, fins = max(0.002, 0.035 * r), []
    for y in np.linspace(-0.62, 0.62, count) * r:
        reach = 2 * float(np.sqrt(r * r - y * y))
        fins.append(box((reach, thick, high - low), (0, y, (low + high) / 2)))
        fins.append(box((thick, reach, high - low), (y, 0, (low + high) / 2)))
    return fins


def _frame(kind: str, r: float, length: float, style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """The motor without cover and boxes, about z from 0 to 0.8 of its length."""
    n, low, high = style.round(r), 0.08 * length, 0.8 * length
    nose = turned([(0.45 * r, 0.0), (0.88 * r, 0.04 * length), (0.97 * r, 0.05 * length), (0.97 * r, low + 0.02)], n)
    if kind == "cast":
        fins = _parallel_fins(r, low, 0.95 * high, int(rng.choice([5, 7, 9])) if n >= 12 else 3)
        rear = cylinder(0.97 * r, 0.95 * high, high, n)
        return merge([nose, cylinder(0.84 * r, low, high, n), *fins, rear])
    if kind == "square":
        core = extrude(rounded_rectangle(1.66 * r, 1.66 * r, 0.3 * r, 3), low, high)
        pitch = np.linspace(-0.55, 0.55, 7 if n >= 12 else 4) * r
        fins = [box((1.86 * r, 0.04 * r, 0.9 * (high - low)), (0, y, (low + high) / 2)) for y in pitch]
        fins += [box((0.04 * r, 1.86 * r, 0.9 * (high - low)), (y, 0, (low + high) / 2)) for y in pitch]
        plate = extrude(rounded_rectangle(1.86 * r, 1.86 * r, 0.25 * r, 3), 0.02 * length, low)
        return merge([plate, core, *fins, cylinder(0.5 * r, 0, 0.03 * length, n)])
    if kind == "smooth":
        ends = [cylinder(1.0 * r, low, low + 0.05 * length, n), cylinder(1.0 * r, high - 0.05 * length, high, n)]
        return merge([nose, cylinder(0.94 * r, low, high, n), *ends])
    if kind == "drip":
        bell = [(0.5 * r, high), (0.93 * r, high), (0.93 * r, 0.72 * length)]
        bars = [
            moved(around(box((0.06 * r, 0.2 * r, 0.08 * length), (0.93 * r, 0, z * length)), 10), spun("z", 0.3))
            for z in (0.13, 0.75)
        ]
        return merge([nose, cylinder(r, 0.18 * length, 0.68 * length, n), turned(bell[::-1], n), *bars])
    ribs = around(box((0.2 * r, 0.06 * r, high - low), (0.92 * r, 0, (low + high) / 2)), int(rng.choice([12, 16, 24])))
    lips = [cylinder(1.06 * r, z * length, (z + 0.035) * length, n) for z in (0.09, 0.125, 0.75)]
    heads = around(hexagon(0.12 * r, 0.07 * length, 0.092 * length), 8, 0.96 * r)
    return merge([nose, cylinder(0.86 * r, low, high, n), ribs, *lips, heads])


def _cover(kind: str, r: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A fan cover about z: domed, meshed, slotted, stepped or under a rain hat."""
    n = style.round(r)
    if kind == "domed":
        return turned(
            [(r, low), (r, high - 0.35 * r), (0.93 * r, high - 0.15 * r), (0.7 * r, high - 0.03 * r), (0.45 * r, high)],
            n,
        )
    if kind == "hat":
        posts = around(box((0.05 * r, 0.05 * r, 0.3 * r), (0.85 * r, 0, high + 0.1 * r)), 4)
        lid = turned([(1.1 * r, high + 0.2 * r), (1.1 * r, high + 0.23 * r), (0.3 * r, high + 0.4 * r)], n)
        return merge([turned([(r, low), (r, high - 0.1 * r), (0.9 * r, high)], n), posts, lid])
    if kind == "stepped":
        ribs = around(box((0.5 * r, 0.06 * r, 0.05 * r), (0.5 * r, 0, high)), 8)
        steps = [(r, low), (r, high - 0.4 * r), (0.82 * r, high - 0.35 * r), (0.82 * r, high)]
        return merge([turned(steps, n), ribs])
    cup = ring(0.96 * r, r, low, high, n)
    floor = cylinder(0.97 * r, low, low + 0.01, n)
    if kind == "mesh":
        hoops = [moved(torus(k * r, 0.018 * r, n, 4), at(0, 0, high)) for k in (0.22, 0.4, 0.58, 0.76, 0.93)]
        bars = [
            moved(box((1.94 * r, 0.05 * r, 0.03 * r), (0, 0, high)), spun("z", t)) for t in (0.0, np.pi / 3, -np.pi / 3)
        ]
        return merge([cup, floor, *hoops, *bars])
    slots = [
        box((2 * float(np.sqrt(0.95 * r * r - y * y)), 0.06 * r, 0.02 * r), (0, y, high - 0.01 * r))
        for y in np.linspace(-0.8, 0.8, 9) * r
    ]
    return merge([cup, floor, *slots, box((0.08 * r, 1.9 * r, 0.02 * r), (0, 0, high - 0.01 * r))])


def _terminal(kind: str, r: float, length: float, style: ModelingStyle, rng: np.random.Generator) -> Solid:
    """A terminal box on the +x side of a motor: with lid, inclined, round-lidded, or with glands."""
    z, wide, deep = (
        float(rng.uniform(0.25, 0.5)) * length,
        float(rng.uniform(0.55, 1.0)) * r,
        float(rng.uniform(0.3, 0.6)) * r,
    )
    long = float(rng.uniform(0.8, 1.3)) * wide
    case = moved(
        extrude(rounded_rectangle(wide, long, 0.12 * wide, 2), 0.0, deep),
        at(0.8 * r, 0, z) @ LYING @ spun("z", np.pi / 2),
    )
    top = 0.8 * r + deep
    gland = merge([hexagon(0.22 * r, 0, 0.07 * r), cylinder(0.08 * r, 0, 0.2 * r, 8)])
    glands = [along("y", gland, 0.8 * r + 0.55 * deep, long / 2, z + s * 0.22 * wide) for s in (-1, 1)]
    if kind == "round":
        lid = along(
            "x",
            turned([(0.42 * wide, 0), (0.45 * wide, 0.04 * r), (0.4 * wide, 0.22 * r)], style.round(wide)),
            top,
            0,
            z,
        )
        return merge([case, lid, *glands])
    lid = box((0.1 * r, 1.06 * long, 1.06 * wide), (top + 0.05 * r, 0, z))
    if kind == "inclined":
        return merge([case, moved(lid, at(top, 0, z) @ spun("z", 0.25) @ at(-top, 0, -z)), *glands[:1]])
    screws = [
        along("x", hexagon(0.08 * r, 0, 0.04 * r), top + 0.1 * r, sy * 0.45 * long, z + sz * 0.45 * wide)
        for sy in (-1, 1)
        for sz in (-1, 1)
    ]
    return merge([case, lid, *screws, *(glands if kind == "glands" else [])])


def _servo(r: float, length: float, style: ModelingStyle) -> list[Part]:
    """A servo motor: a smooth square housing on a square flange, an encoder cap, two angle connectors."""
    body = extrude(rounded_rectangle(1.8 * r, 1.8 * r, 0.15 * r, 2), 0.06 * length, 0.8 * length)
    plate = extrude(rounded_rectangle(2.0 * r, 2.0 * r, 0.1 * r, 2), 0.0, 0.06 * length)
    cap = extrude(rounded_rectangle(1.5 * r, 1.5 * r, 0.2 * r, 2), 0.8 * length, length)
    plug = merge([cylinder(0.24 * r, 0, 0.25 * r, 12), cylinder(0.3 * r, 0.22 * r, 0.6 * r, 12)])
    plugs = [along("x", plug, 0.88 * r, s * 0.35 * r, z * length) for s, z in ((-1, 0.68), (1, 0.68))]
    return [Part(merge([plate, body, *plugs]), "motor", "rubber", "motor"), Part(cap, "motor", "electrical", "motor")]


def _cooled(r: float, length: float, rng: np.random.Generator, style: ModelingStyle, feet: float) -> list[Part]:
    """A large motor (IC 611): a boxed frame with an air-to-air cooler on top and a big terminal box at its side."""
    frame = box((2 * r, 1.9 * r, 0.86 * length), (0, 0, 0.47 * length))
    shields = [cylinder(0.8 * r, z, z + 0.05 * length, style.round(r)) for z in (0.0, 0.9 * length)]
    tall = float(rng.uniform(0.5, 0.9)) * r
    cooler = box((tall, 1.7 * r, 0.8 * length), (r + tall / 2, 0, 0.48 * length))
    ends = [box((tall, 1.6 * r, 0.06 * length), (r + tall / 2, 0, z * length)) for z in (0.05, 0.91)]
    ribs = [box((1.6 * r, 1.94 * r, 0.02 * length), (-0.1 * r, 0, z * length)) for z in (0.2, 0.47, 0.74)]
    hood = merge([turned([(0.75 * r, 0.92 * length), (0.75 * r, length), (0.6 * r, 1.03 * length)], style.round(r))])
    side = box((0.9 * r, 0.6 * r, 0.35 * length), (0.1 * r, 1.25 * r, 0.45 * length))
    lid = box((0.96 * r, 0.05 * r, 0.38 * length), (0.1 * r, 1.57 * r, 0.45 * length))
    feet_ = [box((feet - r, 0.4 * r, 0.8 * length), (-(feet + r) / 2, s * 0.85 * r, 0.47 * length)) for s in (-1, 1)]
    return [
        Part(merge([frame, *shields, *ribs, *(feet_ if feet > r else [])]), "motor", "motor", "motor"),
        Part(merge([cooler, *ends]), "motor", "motor", "motor"),
        Part(hood, "motor fan cover", "motor", "motor"),
        Part(merge([side, lid]), "terminal box", "electrical", "motor"),
    ]


def motor(
    r: float, length: float, style: ModelingStyle, rng: np.random.Generator, feet: float = 0.0, kind: str = ""
) -> list[Part]:
    """An electric motor (IEC 60072 and NEMA MG 1 proportions) about z from 0, its fan end up, its top towards +x.

    Args:
        r: radius over the fins [m].
        length: with the fan cover [m].
        style: that models it.
        rng: frame, cover, terminal box.
        feet: height of the axis over its seat; 0 for one mounted by its flange [m].
        kind: of the frame; ``servo`` and ``cooled`` besides those of ``MOTORS``.
    """
    kind = kind or pick(rng, *MOTORS)
    shaft = Part(cylinder(0.15 * r, -0.3 * r, 0.04 * length, 12), "shaft", "trim", "motor")
    if kind == "servo":
        return [*_servo(r, length, style), shaft]
    if kind == "cooled":
        return [*_cooled(r, length, rng, style, feet), shaft]
    cover = (
        pick(rng, "domed", "mesh", "flat", "stepped", "hat")
        if not feet
        else pick(rng, "domed", "mesh", "flat", "stepped")
    )
    hood = _cover(cover, (1.02 if kind == "cast" else 1.0) * r, 0.8 * length, length, style)
    if kind == "square" and cover == "flat":
        hood = extrude(rounded_rectangle(1.9 * r, 1.9 * r, 0.3 * r, 3), 0.8 * length, 0.97 * length)
        grill = [cylinder(k * r, 0.97 * length, (0.99 - 0.004 * k) * length, style.round(r)) for k in (0.8, 0.5)]
        hood = merge([hood, *grill])
    turn = spun("z", float(rng.choice([0.0, 0.0, 0.0, 0.5, -0.5])) * np.pi)
    lid = "round" if kind == "ex" else pick(rng, "plain", "inclined", "glands", "round")
    parts = [
        Part(_frame(kind, r, length, style, rng), "motor", "motor", "motor"),
        Part(hood, "motor fan cover", "motor", "motor"),
        Part(moved(_terminal(lid, r, length, style, rng), turn), "terminal box", "motor", "motor"),
        shaft,
    ]
    if feet:
        parts[0] = replace(parts[0], solid=merge([parts[0].solid, *_feet(r, length, feet, rng)]))
    if rng.random() < 0.35:
        eye = moved(torus(0.15 * r, 0.04 * r, 12, 6), at(1.12 * r, 0, 0.7 * length) @ spun("x", np.pi / 2))
        parts.append(Part(eye, "lifting lug", "fastener", "motor", "Tank", True))
    return parts


def _feet(r: float, length: float, feet: float, rng: np.random.Generator) -> list[Solid]:
    """Feet from below the frame down to the seat: two rails with webs, or a cradle."""
    low, wide = -feet, 0.85 * r
    if rng.random() < 0.5:
        pads = [
            box((0.1 * r, 0.5 * r, 0.16 * length), (low + 0.05 * r, s * wide, z * length))
            for s in (-1, 1)
            for z in (0.2, 0.66)
        ]
        webs = [
            box((feet - 0.4 * r, 0.12 * r, 0.12 * length), ((low - 0.4 * r) / 2, s * 0.7 * r, z * length))
            for s in (-1, 1)
            for z in (0.2, 0.66)
        ]
        return [*pads, *webs]
    rails = [box((0.12 * r, 0.45 * r, 0.6 * length), (low + 0.06 * r, s * wide, 0.44 * length)) for s in (-1, 1)]
    cradle = [
        box((feet - 0.55 * r, 1.5 * r, 0.06 * length), ((low - 0.55 * r) / 2, 0, z * length)) for z in (0.25, 0.62)
    ]
    return [*rails, *cradle]


# --- between motor and machine ---


def coupling(r: float, x0: float, x1: float, axis: float, style: ModelingStyle) -> Part:
    """A spacer coupling about the axis: two hubs with flanges, a tube between, bolts [m]."""
    n, length = style.round(r), x1 - x0
    hubs = [(0.45 * r, 0.0), (0.45 * r, 0.2 * length), (r, 0.2 * length), (r, 0.34 * length), (0.5 * r, 0.34 * length)]
    whole = [*hubs, *[(a, length - b) for a, b in hubs[::-1]]]
    return Part(along("x", turned(whole, n), x0, 0, axis), "shaft", "trim", CASING)


def _arch(r: float, below: float, steps: int) -> Floats:
    """An arch over a shaft and its legs down, in (y, z)."""
    a = np.linspace(0, np.pi, steps)
    return np.vstack([[(r, -below)], r * np.column_stack([np.cos(a), np.sin(a)]), [(-r, -below)]])


def guard(kind: str, r: float, x0: float, x1: float, axis: float, seat: float, style: ModelingStyle) -> Part:
    """A coupling guard (EN ISO 14120) from its seat over the shaft: hood, roof, box, mesh, slotted or tube."""
    below, thin, length = axis - seat, max(0.0015, 0.02 * r), x1 - x0
    n = max(8, style.round(r))
    if kind == "hood":
        solid = moved(slab(np.vstack([_arch(r, below, n), _arch(r - thin, below, n)[::-1]]), x0, x1), at(0, 0, axis))
        feet = [box((length, 0.25 * r, thin), ((x0 + x1) / 2, s * 1.12 * r, seat + thin / 2)) for s in (-1, 1)]
        return Part(merge([solid, *feet]), "coupling guard", "safety")
    if kind == "roof":
        line = np.array([(r, -below), (r, 0.3 * r), (0.5 * r, r), (-0.5 * r, r), (-r, 0.3 * r), (-r, -below)])
        inner = line * (1 - thin / r)
        inner[[0, -1], 1] = -below
        return Part(moved(slab(np.vstack([line, inner[::-1]]), x0, x1), at(0, 0, axis)), "coupling guard", "safety")
    if kind == "box":
        mid = (x0 + x1) / 2
        walls = [box((length, thin, below + r), (mid, s * (r - thin / 2), (seat + axis + r) / 2)) for s in (-1, 1)]
        ends = [box((thin, 2 * r, r - 0.45 * r), (x, 0, axis + 0.725 * r)) for x in (x0 + thin / 2, x1 - thin / 2)]
        slots = [box((0.7 * length, 2 * r + 0.006, 0.06 * r), (mid, 0, axis + z * r)) for z in (-0.4, -0.1, 0.2, 0.5)]
        return Part(
            merge([*walls, *ends, box((length, 2 * r, thin), (mid, 0, axis + r - thin / 2)), *slots[: 2 + n % 3]]),
            "coupling guard",
            "safety",
        )
    if kind == "tube":
        tube_ = [
            ring(r - thin, r, 0, length, n),
            *(ring(r - thin, 1.12 * r, z, z + 0.06 * length, n) for z in (0.0, 0.94 * length)),
        ]
        stay = box((0.1 * length, 0.5 * r, below - 0.95 * r), ((x0 + x1) / 2, 0, (seat + axis - 0.95 * r) / 2))
        return Part(
            merge([along("x", merge(tube_), x0, 0, axis), *([stay] if below > 1.1 * r else [])]),
            "coupling guard",
            "safety",
        )
    wire = max(0.0015, 0.03 * r)
    hoops = [
        rope([(x, y, axis + z) for y, z in _arch(r, below, 9)], wire, 5)
        for x in np.linspace(x0 + wire, x1 - wire, int(np.clip(length / (0.22 * r), 4, 10)))
    ]
    lines = [
        rod((x0, r * np.cos(t), axis + r * np.sin(t)), (x1, r * np.cos(t), axis + r * np.sin(t)), wire, 5)
        for t in np.linspace(0, np.pi, 9)
    ]
    lips = [box((length, 0.12 * r, thin + 0.003), ((x0 + x1) / 2, s * r, seat + (thin + 0.003) / 2)) for s in (-1, 1)]
    joint = [box((length, 0.02 * r + 0.002, 0.2 * r), ((x0 + x1) / 2, 0, axis + r))] if kind == "halves" else []
    return Part(merge([*hoops, *lines, *lips, *joint]), "coupling guard", "safety")


GUARDS = ("hood", "roof", "box", "tube", "mesh", "halves")


def base(
    kind: str, x0: float, x1: float, width: float, height: float, stations: Sequence[float], rng: np.random.Generator
) -> list[Part]:
    """A base frame with its top at a height: open grid, beams, plinth, bent sheet, drip rim; members at stations."""
    mid, length = (x0 + x1) / 2, x1 - x0
    if kind == "grid":
        long = slab(section_channel(height, 0.45 * height + 0.01, 0.006, 0.009), x0, x1)
        rails = [
            moved(long, at(0, -width / 2, height / 2)),
            moved(long, at(2 * mid, width / 2, height / 2) @ spun("z", np.pi)),
        ]
        across = [box((0.09, width - 0.014, 0.8 * height), (x, 0, 0.6 * height)) for x in stations]
        return [Part(merge([*rails, *across]), "pump base", "steel")]
    if kind == "beams":
        beam = slab(section_i(height - 0.014, 0.6 * height + 0.02, 0.006, 0.009), x0, x1)
        rails = [moved(beam, at(0, s * 0.42 * width, (height - 0.014) / 2)) for s in (-1, 1)]
        pads = [box((0.16, width, 0.014), (x, 0, height - 0.007)) for x in stations]
        return [Part(merge([*rails, *pads]), "pump base", "steel")]
    if kind == "plinth":
        block = box((length + 0.2, width + 0.2, height - 0.03), (mid, 0, (height - 0.03) / 2))
        plate = extrude(rounded_rectangle(length, width, 0.03, 3), height - 0.03, height)
        return [
            Part(moved(plate, at(mid)), "pump base", "steel"),
            Part(block, "foundation", "concrete", "", "Structural element"),
        ]
    if kind == "sheet":
        t, lip = 0.006, min(0.04, 0.3 * width)
        w = width / 2
        left = [(-w, height), (-w, 0), (-w + lip, 0), (-w + lip, t), (-w + t, t), (-w + t, height - t)]
        right = [(w - t, height - t), (w - t, t), (w - lip, t), (w - lip, 0), (w, 0), (w, height)]
        fold = slab(np.array([*left, *right])[::1], x0, x1)
        ends = [box((t, 2 * w - 2.2 * t, 0.7 * height), (x, 0, 0.63 * height)) for x in (x0 + 0.02, x1 - 0.02)]
        return [Part(merge([fold, *ends]), "pump base", "steel")]
    plate = extrude(rounded_rectangle(length, width, 0.05 * width, 3), 0.0, height)
    rim = extrude(
        rounded_rectangle(length + 0.06, width + 0.06, 0.05 * width + 0.03, 3),
        0.6 * height, height + 0.012, (rounded_rectangle(length, width, 0.05 * width, 3),),
    )  # fmt: skip
    return [Part(moved(merge([plate, rim]), at(mid)), "pump base", "steel")]


BASES = ("grid", "beams", "plinth", "sheet", "rim")


def anchors(places: Sequence[tuple[float, float]], seat: float, size: float = 0.014) -> list[Part]:
    """Foundation bolts through what lies on a seat, washers and nuts at a height [m]."""
    one = merge([cylinder(size / 2, seat - 0.03, seat + 2.2 * size, 8), hexagon(1.7 * size, seat, seat + 0.8 * size)])
    return [Part(moved(one, at(x, y)), "bolt", "fastener", "", "Connection assembly", True) for x, y in places]


def train(
    x: float, axis: float, seat: float, r: float, style: ModelingStyle, rng: np.random.Generator, kind: str = ""
) -> tuple[list[Part], float, list[float]]:
    """Coupling, guard and motor behind a machine's shaft that ends at ``x``; where the motor ends; seats along x."""
    gap = float(rng.uniform(0.7, 1.4)) * r
    far, length = x + gap, float(rng.uniform(2.5, 3.6)) * r
    parts = [coupling(0.42 * r, x + 0.02 * gap, far - 0.05 * gap, axis, style)]
    if rng.random() < 0.85:
        parts.append(guard(pick(rng, *GUARDS), 0.56 * r, x + 0.04 * gap, far - 0.04 * gap, axis, seat, style))
    parts += placed(motor(r, length, style, rng, axis - seat, kind), at(far, 0, axis) @ LYING)
    return parts, far + length, [x + gap / 2, far + 0.2 * length, far + 0.66 * length]
