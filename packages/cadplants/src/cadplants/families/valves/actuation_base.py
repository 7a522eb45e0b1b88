"""What all operators of valves have: stems, wheels, levers, indicators."""

from __future__ import annotations

import numpy as np

from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_hand import scaled, slab
from cadplants.families.valves.drive import BODY
from cadplants.model.family import Part
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, box, cylinder, dome, hexagon, turned

__all__ = [
    "INDICATORS", "QUARTERS", "STEMS", "bolted", "put_indicator", "put_stem",
]  # fmt: skip


STEMS = ("plain", "threaded", "with flats", "plain")
"""How a stem is made."""
QUARTERS = (0.0, np.pi / 2, np.pi, 1.5 * np.pi)
"""Four ways to look [rad]."""
INDICATORS = ("puck", "dome", "pointer", "domed switch box", "switch box with a beacon")
"""What shows the position on top of a turning shaft."""


def bolted(solid: Solid, bundle: str = BODY) -> Part:
    """Bolts as one part, which styles without fasteners leave out."""
    return Part(solid, "bolt", "fastener", bundle, "Connection assembly", True)


def put_stem(t: Table, low: float, high: float, radius: float, form: str = "plain") -> None:
    """Puts down a stem, one of ``STEMS``: plain, threaded (rings) or with two flats at its top [m]."""
    n = t.n(radius, 8, 16)
    if form == "threaded" and high - low > 4 * radius:
        pitch = max(0.5 * radius, (high - low) / 24)
        steps = np.linspace(low, high, 2 * max(2, int((high - low) / pitch)) + 1)
        solids = [turned([(radius * (0.85 if k % 2 else 1.0), float(z)) for k, z in enumerate(steps)], n)]
    elif form == "with flats" and high - low > 2 * radius:
        top, wide = high - 1.5 * radius, 1.3 * radius
        solids = [cylinder(radius, low, top, n), box((wide, wide, high - top), (0, 0, (high + top) / 2))]
    else:
        solids = [cylinder(radius, low, high, n)]
    t.bundled(BODY).add("valve stem", *solids)


def put_indicator(t: Table, size: float, form: str, bundle: str = "actuator") -> None:
    """Puts down what shows the position, one of ``INDICATORS``, on z = 0 [m]."""
    n, boxed = t.n(size, 12), "box" in form
    if form == "puck":
        bar = box((1.7 * size, 0.3 * size, 0.15 * size), (0, 0, 0.75 * size))
        solids = [turned(scaled(size, 1, 0, 1, 0.5, 0.8, 0.7), n), bar]
    elif form == "dome":
        solids = [cylinder(size, 0.0, 0.25 * size, n), dome(0.8 * size, 0.8 * size, 0.25 * size, n)]
    elif form == "pointer":
        arrow = outline(-0.8, -0.15, 0.6, -0.15, 0.6, -0.4, 1.3, 0, 0.6, 0.4, 0.6, 0.15, -0.8, 0.15)
        solids = [cylinder(1.2 * size, 0.0, 0.08 * size, n), slab(np.array(arrow) * size, 0.1 * size, 0.25 * size)]
    else:
        wide, tall = 0.045 + 0.4 * size, 0.05 + 0.5 * size
        case = slab(rounded_rectangle(2.4 * wide, 1.8 * wide, 0.3 * wide, 3), 0.02, 0.02 + tall)
        lid = slab(rounded_rectangle(2.6 * wide, 2.0 * wide, 0.35 * wide, 3), 0.02 + 0.5 * tall, 0.02 + 0.6 * tall)
        gland = hexagon(0.02, 0.8 * wide, 0.9 * wide + 0.02)
        glands = [along("-y", gland, s * 0.6 * wide, 0, 0.02 + 0.25 * tall) for s in (-1, 1)]
        if form == "domed switch box":
            beacon = dome(0.5 * wide, 0.35 * wide, 0.02 + tall, n)
        else:
            beacon = cylinder(0.45 * wide, 0.02 + tall, 0.02 + 1.4 * tall, n)
        legs = [box((0.003, 1.4 * wide, 0.025), (s * wide, 0, 0.0125)) for s in (-1, 1)]
        solids = [case, lid, beacon, *glands, *legs, cylinder(0.012, 0.0, 0.025, 8)]
    t.bundled(bundle).add("position indicator", *solids, of="electrical" if boxed else "handle")


# --- the same as finished parts ---
