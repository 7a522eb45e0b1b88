"""Sluice and slide gates, and gate valves worked from a floor above."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, hand_wheel, shaft
from cadplants.families.valves.actuation_hand import slab
from cadplants.families.valves.body import (
    metal,
    trim,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.gate import resilient
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, turned
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["SLUICES"]

Rng = np.random.Generator


def _slide(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A slide gate for bulk solids: a flat frame between round flanges, its blade drawn out to the side."""
    size, radius = FLANGES[dn], PIPES[dn].radius
    length = 0.06 + 0.1 * radius
    half, thick = 0.5 * size.outer, 0.012
    n = style.round(half)
    plates = [ring(PIPES[dn].bore, half, z, z + thick, n) for z in (0.0, length - thick)]
    throat = ring(PIPES[dn].bore, radius * 1.06, 0.0, length, n)
    reach = 2.4 * half
    frame = [
        box((length - 2 * thick, 0.03, half + reach), (length / 2, s * 0.96 * half, (reach - half) / 2))
        for s in (-1, 1)
    ]
    frame += [box((length - 2 * thick, 2 * half, 0.02), (length / 2, 0, z)) for z in (-half + 0.01, half + 0.02)]
    cross = box((length - 2 * thick + 0.01, 2 * half + 0.02, 0.03), (length / 2, 0, reach))
    open_ = float(rng.choice([0.0, 0.5, 0.95])) * 1.9 * radius
    blade = box((0.008, 1.84 * half, 2 * radius + half), (length / 2, 0, open_ + 0.5 * half))
    slim, x = 0.008 + 0.05 * radius, length / 2
    clevis = box((0.03, 0.05, 0.06), (x, 0, open_ + half + radius))
    parts = [
        metal(merge([along("x", merge([*plates, throat])), *frame])),
        trim(blade, "valve disc"),
        trim(cross, "yoke", 0.0, "steel"),
    ]
    parts.append(trim(clevis, "valve disc"))
    rest = [shaft(open_ + half + radius - reach, 0.12, slim, style, rng)]
    kind = rng.random()
    if kind < 0.4:
        rest.append(hand_wheel(0.06 + 0.8 * radius, 0.03, style, rng))
        rest.append(Part(ring(slim, 2.5 * slim, 0.014, 0.032, 12), "gland", "trim", BODY))
        parts += placed(rest, at(x, 0, reach))
    elif kind < 0.75:
        bore, long = 0.03 + 0.25 * radius, 2.2 * radius + 0.08
        ends = [
            slab(rounded_rectangle(2.3 * bore, 2.3 * bore, 0.2 * bore, 2), z, z + 0.3 * bore) for z in (0.015, long)
        ]
        rods = around(cylinder(0.1 * bore, 0.0, long + 0.35 * bore, 8), 4, 1.35 * bore, np.pi / 4)
        can = merge(
            [
                *ends,
                rods,
                cylinder(0.95 * bore, 0.02, long, style.round(bore)),
                *(
                    along("y", hexagon(0.02, bore, 1.3 * bore), 0, 0, z)
                    for z in (0.12 * bore + 0.02, long + 0.1 * bore)
                ),
            ]
        )
        parts += placed([rest[0], Part(can, "actuator", "clamp", "actuator")], at(x, 0, reach))
    else:
        parts += placed(
            [rest[0], *quarter_turn(0, 0.015, radius, style, rng, ("bevel", "multi-turn"))], at(x, 0, reach)
        )
    return Model(parts, round(length, 6), "wafer", "slide gate valve")


def _sluice(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A sluice gate on a wall: a frame of channels round an opening, a ribbed door, a spindle up to a headstock."""
    wide = float(rng.uniform(0.4, 0.9))
    high, lift = wide * float(rng.uniform(0.8, 1.4)), float(rng.uniform(0.2, 1.0)) * wide
    round_ = rng.random() < 0.4
    outline = (
        circle(0.5 * wide, 24, (0.0, 0.75 * wide))
        if round_
        else np.array([(-wide / 2, 0.2), (wide / 2, 0.2), (wide / 2, 0.2 + high), (-wide / 2, 0.2 + high)])
    )
    bottom, head = (0.25 * wide, 1.25 * wide) if round_ else (0.2, 0.2 + high)
    rim = head + 0.3
    wall_outline = np.array([(-1.2 * wide, 0.0), (1.2 * wide, 0.0), (1.2 * wide, rim), (-1.2 * wide, rim)])
    up = spun("z", np.pi / 2) @ spun("x", np.pi / 2)  # outline's x along y, its y up, thickness along x
    wall = moved(slab(wall_outline, -0.25, 0.0, (outline,)), up)
    tall = 2 * head - bottom + 0.35
    rails = [
        box((0.06, 0.06, tall - bottom + 0.1), (0.03, s * 0.58 * wide, (tall + bottom - 0.1) / 2)) for s in (-1, 1)
    ]
    frame = merge(
        [
            *rails,
            box((0.05, 1.22 * wide, 0.06), (0.025, 0, bottom - 0.05)),
            box((0.08, 1.24 * wide, 0.08), (0.04, 0, tall)),
        ]
    )
    mid = (bottom + head) / 2 + lift
    door = [box((0.012, 1.1 * wide, head - bottom + 0.06), (0.014, 0, mid))]
    door += [
        box((0.04, 1.04 * wide, 0.012), (0.036, 0, float(mid + z)))
        for z in np.linspace(-0.4, 0.4, int(rng.integers(2, 6))) * (head - bottom)
    ]
    door += [box((0.04, 0.012, 0.9 * (head - bottom)), (0.036, s * 0.3 * wide, mid)) for s in (-1, 1)]
    slim = float(rng.uniform(0.014, 0.022))
    low = mid + 0.4 * (head - bottom)
    parts = [
        Part(frame, BODY, "steel", BODY),
        trim(merge(door), "valve disc"),
        Part(wall, "wall", "concrete", "", "Structural element"),
        *placed([shaft(low, tall + 0.35 + lift, slim, style, rng)], at(0.045)),
    ]
    anchors = merge(
        [
            along("x", hexagon(0.03, 0.06, 0.078), 0, s * 0.58 * wide, float(z))
            for s in (-1, 1)
            for z in np.linspace(bottom, rim - 0.1, 5)
        ]
    )
    parts.append(bolted(anchors))
    if rng.random() < 0.55:
        stand = turned([(0.13, 0.0), (0.13, 0.02), (0.06, 0.06), (0.05, 0.2), (0.08, 0.25), (0.08, 0.28)], 20)
        parts += placed(
            [Part(stand, "yoke", "valve", BODY), hand_wheel(float(rng.uniform(0.18, 0.32)), 0.28, style, rng)],
            at(0.045, 0, tall + 0.04),
        )
    else:
        # On a foot, so that the wheel on its side clears the frame's head.
        foot = moved(cylinder(0.09, 0.0, 0.04, 20), at(0.045, 0, tall + 0.04))
        parts.append(Part(foot, "yoke", "valve", BODY))
        parts += quarter_turn(0.045, tall + 0.08, 0.12, style, rng, ("bevel", "bevel", "multi-turn"))
    return Model(parts, kind="sluice gate")


def _pillar(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A gate valve whose spindle goes up by an extension to a pedestal on the floor above (EN 1074 fittings)."""
    model = resilient(dn, style, np.random.default_rng(int(rng.integers(1 << 30))))
    kept = [p for p in model.parts if p.name not in ("handwheel",)]
    top = max(float(p.solid.vertices[:, 2].max()) for p in kept if p.name in ("valve bonnet", "gland", "valve stem"))
    x, reach, slim = model.length / 2, float(rng.uniform(0.35, 0.8)), 0.012
    half = float(rng.uniform(0.08, 0.13))
    n = style.round(half)
    joint = merge([cylinder(2.2 * slim, -0.03, 0.06, 12), cylinder(1.3 * slim, 0.05, reach + 0.05, 12)])
    deck = box((6 * half, 6 * half, 0.012), (0, 0, reach - 0.006))
    tall = float(rng.uniform(0.5, 0.8))
    column = [
        (1.5 * half, 0.0),
        (1.5 * half, 0.018),
        (0.8 * half, 0.05),
        (0.55 * half, 0.9 * tall),
        (0.8 * half, 0.95 * tall),
        (0.8 * half, tall),
    ]
    if rng.random() < 0.4:
        column = [(1.4 * half, 0.0), (1.4 * half, 0.015), (0.7 * half, 0.015), (0.7 * half, tall)]
    pedestal = turned(column, n)
    scale = box((0.006, 0.3 * half, 0.5 * tall), (0.72 * half, 0, 0.5 * tall))
    bolts = around(hexagon(0.026, 0.018, 0.034), 4, 1.2 * half, np.pi / 4)
    stand = [Part(pedestal, "yoke", "valve", BODY), trim(scale, "position indicator"), bolted(bolts)]
    if rng.random() < 0.7:
        stand += [
            shaft(tall - 0.02, tall + 0.1, slim, style),
            hand_wheel(0.11 + 0.8 * PIPES[dn].radius, tall + 0.01, style, rng),
        ]
    else:
        stand += quarter_turn(0, tall, 0.08, style, rng, ("bevel", "multi-turn"))
    rest = [
        Part(joint, "valve stem", "trim", BODY),
        Part(deck, "plate", "steel", "", "Structural element"),
        *placed(stand, at(0, 0, reach)),
    ]
    return Model([*kept, *placed(rest, at(x, 0, top))], model.length, kind="gate valve")


_MID = tuple(dn for dn in SIZES if dn >= 40)


SLUICES: tuple[Family, ...] = (
    valve_family("gate valve/pedestal", _pillar, _MID, weight=0.7),
    valve_family("slide gate valve/frame", _slide, _MID),
    valve_family("sluice gate/wall", _sluice, (100,), "floor"),
)
