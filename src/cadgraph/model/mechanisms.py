"""What moves at the units of a plant, and what is read there: what the stage of mechanisms finds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

__all__ = ["NOT_MOVABLE", "FoundDial", "FoundMechanism", "MechanismKind", "UnitMotion"]

NOT_MOVABLE = "valve-not-movable"
"""Code of the diagnostic that says of a valve why nothing of it moves; the message is its tag, a colon, the reason."""

MechanismKind = Literal["handwheel", "lever", "gear operator", "needle"]
_Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class FoundMechanism:
    """What moves at a unit; see ``records.Mechanism``. Meshes are numbers, positions relative to the scene's origin."""

    kind: MechanismKind
    meshes: tuple[int, ...]
    axis: _Point
    pivot: _Point
    radius: float
    thickness: float | None
    limits: tuple[float, float]
    open: float | None = None
    shut: float | None = None
    pieces: tuple[int, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class FoundDial:
    """The face of a gauge; see ``records.Dial``. Positions are relative to the scene's origin."""

    center: _Point
    normal: _Point
    radius: float
    up: _Point


@dataclass(frozen=True, eq=False)
class UnitMotion:
    """What moves or is read at one unit.

    Args:
        mechanism: what moves; None where nothing does, or nothing was found.
        dial: of a gauge; None where none was found.
        why_not: of a valve that would be moved by hand: why it can't be; empty where it can, or where it is no such.
    """

    mechanism: FoundMechanism | None = None
    dial: FoundDial | None = None
    why_not: str = ""
