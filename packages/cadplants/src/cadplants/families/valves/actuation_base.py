"""What all operators of valves have: stems, wheels, levers, indicators."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.actuation_hand import lever_of, slab, wheel_of
from cadplants.families.valves.drive import BODY
from cadplants.family import Part
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.plant import Turning
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import along, box, cylinder, dome, hexagon, turned
from cadplants.transforms import at, spun

__all__ = ["bolted", "hand_lever", "hand_wheel", "indicator", "quarter", "shaft"]

Rng = np.random.Generator


def bolted(solid: Solid, bundle: str = BODY) -> Part:
    """Bolts as one part, which styles without fasteners leave out."""
    return Part(solid, "bolt", "fastener", bundle, "Connection assembly", True)


def shaft(low: float, high: float, radius: float, style: ModelingStyle, rng: Rng | None = None) -> Part:
    """A stem: plain, threaded (rings) or with two flats at its top [m]."""
    n = max(8, min(style.round(radius), 16))
    kind = 0 if rng is None else int(rng.integers(4))
    if kind == 1 and high - low > 4 * radius:
        pitch = max(0.5 * radius, (high - low) / 24)
        count = max(2, int((high - low) / pitch))
        steps = np.linspace(low, high, 2 * count + 1)
        solid = turned([(radius * (0.85 if k % 2 else 1.0), float(z)) for k, z in enumerate(steps)], n)
    elif kind == 2 and high - low > 2 * radius:
        top = high - 1.5 * radius
        solid = merge(
            [cylinder(radius, low, top, n), box((1.3 * radius, 1.3 * radius, high - top), (0, 0, (high + top) / 2))]
        )
    else:
        solid = cylinder(radius, low, high, n)
    return Part(solid, "valve stem", "trim", BODY)


def hand_wheel(radius: float, z: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = ()) -> Part:
    """A handwheel with its hub on the height ``z`` [m]."""
    solid = wheel_of(radius, style, rng, kinds) if kinds else wheel_of(radius, style, rng)
    return Part(moved(solid, at(0, 0, z)), "handwheel", "handle", turns=Turning("handwheel", point=(0.0, 0.0, z)))


def hand_lever(length: float, z: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = ()) -> Part:
    """A lever with its eye on the height ``z`` [m]."""
    solid = lever_of(length, style, rng, kinds) if kinds else lever_of(length, style, rng)
    return Part(moved(solid, at(0, 0, z)), "lever", "handle", turns=Turning("lever", point=(0.0, 0.0, z)))


def quarter(rng: Rng) -> Floats:
    """One of four ways to look."""
    return spun("z", float(rng.choice([0.0, 0.5, 1.0, 1.5])) * np.pi)


def indicator(size: float, style: ModelingStyle, rng: Rng, kinds: int = 5) -> Part:
    """What shows the position on top of a turning shaft: puck, dome, pointer over a scale, or a switch box."""
    n, kind = max(12, style.round(size)), int(rng.integers(kinds))
    if kind == 0:
        solid = turned([(size, 0.0), (size, 0.5 * size), (0.8 * size, 0.7 * size)], n)
        solid = merge([solid, box((1.7 * size, 0.3 * size, 0.15 * size), (0, 0, 0.75 * size))])
    elif kind == 1:
        solid = merge([cylinder(size, 0.0, 0.25 * size, n), dome(0.8 * size, 0.8 * size, 0.25 * size, n)])
    elif kind == 2:
        arrow = np.array([(-0.8, -0.15), (0.6, -0.15), (0.6, -0.4), (1.3, 0.0), (0.6, 0.4), (0.6, 0.15), (-0.8, 0.15)])
        solid = merge([cylinder(1.2 * size, 0.0, 0.08 * size, n), slab(arrow * size, 0.1 * size, 0.25 * size)])
    else:
        wide, tall = 0.045 + 0.4 * size, 0.05 + 0.5 * size
        case = slab(rounded_rectangle(2.4 * wide, 1.8 * wide, 0.3 * wide, 3), 0.02, 0.02 + tall)
        lid = slab(rounded_rectangle(2.6 * wide, 2.0 * wide, 0.35 * wide, 3), 0.02 + 0.5 * tall, 0.02 + 0.6 * tall)
        glands = [
            along("-y", hexagon(0.02, 0.8 * wide, 0.9 * wide + 0.02), s * 0.6 * wide, 0, 0.02 + 0.25 * tall)
            for s in (-1, 1)
        ]
        beacon = (
            dome(0.5 * wide, 0.35 * wide, 0.02 + tall, n)
            if kind == 3
            else cylinder(0.45 * wide, 0.02 + tall, 0.02 + 1.4 * tall, n)
        )
        legs = [box((0.003, 1.4 * wide, 0.025), (s * wide, 0, 0.0125)) for s in (-1, 1)]
        solid = merge([case, lid, beacon, *glands, *legs, cylinder(0.012, 0.0, 0.025, 8)])
    return Part(solid, "position indicator", "electrical" if kind > 2 else "handle", "actuator")
