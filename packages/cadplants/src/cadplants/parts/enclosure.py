"""Fences, gates and concrete posts round a yard."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadplants.model.plant import Assembly, Component, gather
from cadplants.parts.detail import screw
from cadplants.solids.mesh_ops import Solid, box, extrude, shared
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import IDENTITY, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["fence", "pillar"]

_GROUP = "Structural element"
_POST = 0.06  # m
_RAIL = (0.03, 0.04)  # m, width and height of a rail


@shared
def _bar_solid(height: float, round_bar: bool, sides: int) -> Solid:
    outline = circle(0.010, sides) if round_bar else rounded_rectangle(0.018, 0.018, 0.0)
    return extrude(outline, 0.0, height)


@shared
def _post_solid(height: float) -> Solid:
    return extrude(rounded_rectangle(_POST, _POST, 0.006, 2), 0.0, height)


def fence(
    length: float, style: ModelingStyle, height: float = 1.10, pitch: float = 0.14, gate: bool = False
) -> Assembly:
    """A panel along x about the origin, on z = 0: two posts, two rails, upright bars.

    Args:
        length: over the posts [m].
        style: that models it.
        height: of the posts [m].
        pitch: least distance of the bars [m].
        gate: whether it is a leaf of square bars.

    Returns:
        Posts, rails and bars; and the screw at each end of each bar through the rail where this style models fasteners.
    """
    color = style.color("gate" if gate else "fence")
    name = "gate" if gate else "fence"
    post = _post_solid(round(height, 6))
    reach = length / 2 - _POST / 2
    parts = [Component(post, _GROUP, "post", style.color("fence"), at(sign * reach)) for sign in (-1, 1)]
    inner = length - 2 * _POST
    width, deep = _RAIL
    low, high = 0.12, height - 0.08
    rail = _rail_solid(round(inner, 6), width, deep)
    for z in (low, high):
        parts.append(Component(rail, _GROUP, name, color, at(0, 0, z)))
    contacts = [(0, 2), (1, 2), (0, 3), (1, 3)]
    count = max(2, int(inner / pitch))
    bar = _bar_solid(round(high - low - deep, 6), not gate, min(style.round(0.010), 12))
    for k in range(count):
        x = -inner / 2 + (k + 0.5) * inner / count
        parts.append(Component(bar, _GROUP, name, color, at(x, 0, low + deep / 2)))
        contacts += [(2, len(parts) - 1), (3, len(parts) - 1)]
    if style.fasteners not in ("none", "set") and style.sides[1] > 16:
        heads = ((2, low - deep / 2, spun("x", np.pi)), (3, high + deep / 2, IDENTITY))
        for part in parts[4 : 4 + count]:
            for rail_index, z, turn in heads:
                head = screw(style).components[0]
                parts.append(replace(head, pose=at(float(part.pose[0, 3]), 0, z) @ turn))
                contacts.append((rail_index, len(parts) - 1))
    return Assembly(tuple(parts), tuple(contacts))


@shared
def _rail_solid(length: float, width: float, deep: float) -> Solid:
    return box((length, width, deep))


def pillar(style: ModelingStyle, side: float = 0.45, height: float = 1.7) -> Assembly:
    """A concrete post on z = 0 with a capping slab."""
    shaft, slab = _pillar_solids(round(side, 6), round(height, 6))
    color = style.color("concrete")
    components = (
        Component(shaft, _GROUP, "column", color),
        Component(slab, _GROUP, "column", color, at(0, 0, height)),
    )
    return gather([Assembly(components, ((0, 1),))])


@shared
def _pillar_solids(side: float, height: float) -> tuple[Solid, Solid]:
    chamfer = 0.02
    outline = rounded_rectangle(side, side, chamfer, 1)
    return extrude(outline, 0.0, height), extrude(rounded_rectangle(side + 0.08, side + 0.08, 0.0), 0.0, 0.06)
