"""The levels of a plant, the ways up to them, and how people get at its units: what the stage of places finds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from cadgraph.model.grid import Grid
from cadgraph.model.parts import Bools

__all__ = ["FoundPlace", "FoundPlaces", "PlaceKind", "Reach", "UnitAccess"]

PlaceKind = Literal["ground", "platform", "stairs", "ladder"]
Reach = Literal["floor", "platform", "out of reach"]
_Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class FoundPlace:
    """A level, or a way up; all positions are relative to the scene's origin.

    Args:
        kind: what it is.
        name: as people call it.
        height: of the surface to stand on, or a way's top [m].
        low: of a way up, the height that it starts from [m].
        area: to stand on [m2].
        box: its least and greatest corner [m].
        parts: that it is made of, ascending.
        grid: of a level, the squares of its floor.
        free: ``(rows, columns)`` the squares on which one can stand and that one gets to.
        landings: of a way up, where one stands at its foot and at each level that it leads to.
        reached_from: places one step before it: of a level its ways up, of a way the level that it starts on.
    """

    kind: PlaceKind
    name: str
    height: float
    box: tuple[_Point, _Point]
    low: float | None = None
    area: float = 0.0
    parts: tuple[int, ...] = ()
    grid: Grid | None = None
    free: Bools | None = None
    landings: tuple[_Point, ...] = ()
    reached_from: tuple[int, ...] = ()


@dataclass(frozen=True)
class UnitAccess:
    """How people get at a unit; see ``records.Access``. Places are numbers, positions relative to the origin.

    ``face`` is the middle of a gauge's face, ``face_radius`` how far it reaches from there [m]; None where it has none.
    """

    place: int | None
    stand: _Point | None
    height: float
    reach: Reach
    facing: _Point | None = None
    facing_confidence: float | None = None
    viewpoint: _Point | None = None
    face: _Point | None = None
    face_radius: float | None = None


@dataclass(frozen=True)
class FoundPlaces:
    """What was found.

    Args:
        places: by height, then position.
        access: of each unit of the network.
    """

    places: tuple[FoundPlace, ...] = ()
    access: tuple[UnitAccess, ...] = ()
