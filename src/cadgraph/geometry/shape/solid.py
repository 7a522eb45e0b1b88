"""Which simple solid a shape is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.model.shapes import Facts

__all__ = ["Solid", "name_solid"]

Solid = Literal[
    "sheet", "wheel", "hexagon", "bent tube", "cylinder", "sphere", "torus", "cone", "revolved", "box", "extrusion"
]

_SHEET = 1e-3  # thickness over breadth: a gasket of 1 mm is no sheet
_STEADY = 0.04  # profiles agree with that of a solid within this share of the radius: chamfers and coarse facets do
_FULL = 0.95  # share of its box that a box fills


def name_solid(facts: Facts) -> Solid | None:
    """The simplest solid that a shape is; a wheel has spokes between rim and hub, an extrusion one cross-section.

    Args:
        facts: of the shape.

    Returns:
        None where no simple solid comes near.
    """
    if not facts.section[0] > 0 or not facts.section[1] > 0:
        return None
    if facts.section[2] <= _SHEET * facts.section[1]:
        return "sheet"
    return _along_a_line(facts) or _turned(facts) or _angular(facts)


def _along_a_line(facts: Facts) -> Solid | None:
    short = not facts.tube or facts.length < 4 * facts.radius
    if facts.sides == 6 and facts.turned > 0.7 and short:
        return "hexagon"
    if facts.tube:
        return "bent tube" if facts.bent else "cylinder"
    return "wheel" if facts.sides >= 8 and 3 <= facts.spokes <= 8 and facts.rim > 0.4 else None


def _turned(facts: Facts) -> Solid | None:
    if not facts.round:
        return None
    fits: tuple[tuple[Solid, Callable[[Facts, Floats], bool]], ...] = (
        ("cylinder", _is_cylinder), ("sphere", _is_sphere), ("torus", _is_torus), ("cone", _is_cone),
    )  # fmt: skip
    n = len(facts.outer)
    height = ((np.arange(n) + 0.5) / n - 0.5) * facts.length
    return next((solid for solid, fit in fits if fit(facts, height)), "revolved")


def _angular(facts: Facts) -> Solid | None:
    if facts.fill > _FULL:
        return "box"
    return "extrusion" if facts.extruded >= 0 else None


def _near(values: Floats, wanted: Floats, facts: Facts) -> bool:
    return bool(np.abs(values - wanted).max() <= _STEADY * facts.radius)


def _is_cylinder(facts: Facts, height: Floats) -> bool:
    return _near(facts.outer, np.full(len(height), facts.radius), facts)


def _is_sphere(facts: Facts, height: Floats) -> bool:
    return _near(np.hypot(facts.outer, height), np.full(len(height), facts.radius), facts)


def _is_torus(facts: Facts, height: Floats) -> bool:
    minor = facts.length / 2
    major = facts.radius - minor
    width = np.sqrt(np.maximum(minor**2 - height**2, 0))
    return major > minor and _near(facts.outer, major + width, facts) and _near(facts.inner, major - width, facts)


def _is_cone(facts: Facts, height: Floats) -> bool:
    slope, middle = np.polyfit(height, facts.outer, 1) if facts.length > 0 else (0.0, 0.0)
    fall = abs(float(slope)) * facts.length
    # The greatest radius is that of one end: a spool's flanges are too thin for the slices, but not its ends.
    ends_there = abs(float(middle) + fall / 2 - facts.radius) <= _STEADY * facts.radius
    return fall > 2 * _STEADY * facts.radius and ends_there and _near(facts.outer, middle + slope * height, facts)
