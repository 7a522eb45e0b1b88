"""Very small pieces that detailed CAD is full of: marks of dials, screws, rivets, plates with raised letters.

Each is a mesh of its own and, but for the larger plates, below the 1 cm3 of the paper's grouping (section III-B).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, gather
from cadplants.model.standards import GAUGES
from cadplants.solids.lettering import letters
from cadplants.solids.mesh_ops import Solid, box, extrude, shared, stack
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Marks", "marked_gauge", "plate", "screw"]

Marks = Literal["none", "few", "all"]
"""What is modelled on a dial: nothing, its main marks, or all marks with figures and unit."""

_PAINT = 0.0002  # m; how far marks stand out of a dial
_PLATE = 0.0005  # m; a name plate of sheet
_STEPS = 10  # main marks of a scale over 270 degrees, EN 837-1


def marked_gauge(gauge: Assembly, size: int, marks: Marks, style: ModelingStyle) -> Assembly:
    """A pressure gauge of ``gauge.py`` with the marks of its dial, and the screws of its bezel.

    Args:
        gauge: with a case of its own; one that is a single mesh stays as it is.
        size: nominal size of its case.
        marks: how many.
        style: that models it.
    """
    names = [c.name for c in gauge.components]
    if marks == "none" or "gauge case" not in names:
        return gauge
    around = names.index("gauge case")
    case = gauge.components[around]
    ground = names.index("gauge face") if "gauge face" in names else around
    turn = _turn(gauge.components[names.index("gauge needle")].solid) if "gauge needle" in names else None
    pieces = [(solid, pose, "gauge face", "needle") for solid, pose in _scale(size, marks, turn)]
    n_marks = len(pieces)
    rim = GAUGES[size].bezel / 2
    if marks == "all":
        flat = GAUGES[size].depth
        lip = (rim - 0.0015 + GAUGES[size].case / 2 - 0.002) / 2
        for k in range(3):
            where = spun("z", 2 * np.pi * (k + 0.5) / 3) @ at(lip, 0, flat)
            pieces.append((_head(0.0010, 0.0008), where, "gauge case", "trim"))
    extra = tuple(
        Component(
            solid, "Gauge assembly", name, style.color(color), case.pose @ pose, case.unit, granularity=case.granularity
        )
        for solid, pose, name, color in pieces
    )
    first = len(gauge.components)
    contacts = [(ground, first + k) for k in range(n_marks)]
    contacts += [(around, first + k) for k in range(n_marks, len(pieces))]
    return replace(gauge, components=(*gauge.components, *extra), contacts=(*gauge.contacts, *contacts))


def _turn(needle: Solid) -> float:
    """Where a needle about z points [rad]."""
    tip = needle.vertices[np.linalg.norm(needle.vertices[:, :2], axis=1).argmax()]
    return float(np.arctan2(tip[1], tip[0]))


def _scale(size: int, marks: Marks, turn: float | None) -> list[tuple[Solid, Floats]]:
    """Marks over 270 degrees and figures, on the dial's face in the frame of the case."""
    gauge = GAUGES[size]
    inner = gauge.case / 2 - 0.003
    face = gauge.depth - 0.009 + 0.001
    pieces: list[tuple[Solid, Floats]] = []
    # Scales of EN 837-1: 0.2 of 10 bar from mark to mark on small dials, 0.1 from nominal size 100 on.
    fine = (5 if size < 100 else 10) if marks == "all" else 1
    for k in range(_STEPS * fine + 1):
        angle = np.radians(225 - 270 * k / (_STEPS * fine))
        main = k % fine == 0
        low, high = (0.82 * inner, 0.95 * inner) if main else (0.88 * inner, 0.95 * inner)
        wide = (0.030 if main else 0.012) * inner
        bar = _mark_solid(round(high - low, 7), round(wide, 7))
        pieces.append((bar, spun("z", angle) @ at((low + high) / 2, 0, face)))
    if marks == "all":
        height = 0.15 * inner
        for k in range(0, _STEPS + 1, 2):
            angle = np.radians(225 - 270 * k / _STEPS)
            if turn is not None and np.cos(angle - turn) > 0.90:
                continue
            middle = at(0.64 * inner * np.cos(angle), 0.64 * inner * np.sin(angle), face)
            pieces += [(solid, middle @ pose) for solid, pose in letters(str(k), round(height, 6), _PAINT)]
        if turn is None or np.cos(np.radians(-90) - turn) < 0.80:
            # Unit, class and standard as EN 837-1, section 10, asks for them.
            for text, height, y in (("BAR", 0.13, -0.60), ("CL 16", 0.09, -0.38), ("EN 837-1", 0.075, -0.80)):
                words = letters(text, round(height * inner, 6), _PAINT)
                pieces += [(solid, at(0, y * inner, face) @ pose) for solid, pose in words]
    return pieces


@shared
def _mark_solid(length: float, width: float) -> Solid:
    return box((length, width, _PAINT), (0, 0, _PAINT / 2))


@shared
def _head(radius: float, height: float) -> Solid:
    """The round head of a screw or rivet on z = 0."""
    return stack([(0.0, 0.6 * height, circle(radius, 10)), (0.6 * height, height, circle(0.75 * radius, 10))])


def screw(style: ModelingStyle, radius: float = 0.004, height: float = 0.0025) -> Assembly:
    """The visible head of a countersunk screw or blind rivet on z = 0 (heads after ISO 7045, ISO 15977)."""
    solid = _head(round(radius, 6), round(height, 6))
    return Assembly((Component(solid, "Connection assembly", "screw", style.color("fastener"), family="screw"),))


@shared
def _plate_solid(width: float, height: float, thick: float) -> Solid:
    return extrude(rounded_rectangle(width, height, 0.12 * height, 3), 0.0, thick)


def plate(lines: tuple[str, ...], style: ModelingStyle, size: float = 0.008, rivets: int = 4) -> Assembly:
    """A sheet with raised letters and rivets in the plane z = 0, towards +z, its text along x.

    Args:
        lines: of text, from above.
        style: that models it; a coarse one leaves letters and rivets out.
        size: height of the letters [m].
        rivets: 0, 2 or 4.

    Returns:
        The sheet first.
    """
    width = (max(map(len, lines)) * 0.78 + 2.6) * size
    height = (1.45 * len(lines) + 0.75) * size
    thick = _PLATE if size < 0.02 else 0.002
    group, name = "Electrical and safety", "sign"
    sheet = _plate_solid(round(width, 6), round(height, 6), thick)
    parts = [Assembly((Component(sheet, group, name, style.color("safety"), family="plate"),))]
    if style.sides[1] <= 16:
        return parts[0]
    for k, text in enumerate(lines):
        y = ((len(lines) - 1) / 2 - k) * 1.45 * size
        for solid, pose in letters(text, round(size, 6), 0.0003 if size < 0.02 else 0.001):
            placed = at(0, y, thick) @ pose
            parts.append(Assembly((Component(solid, group, name, style.color("rubber"), placed, family="plate"),)))
    x, y = width / 2 - 0.5 * size, height / 2 - 0.32 * size if rivets == 4 else 0.0
    for sx in (-1, 1):
        for sy in (-1, 1) if rivets == 4 else (1,) if rivets else ():
            parts.append(screw(style, 0.22 * size, 0.12 * size).placed(at(sx * x, sy * y, thick)))
    return gather(parts, [(0, k) for k in range(1, len(parts))])
