"""What moves at the units of a plant, and what is read there: what the stage of mechanisms finds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from cadgraph.model.records import Affordance, Dial, Mechanism, Point, points
from cadgraph.model.scene import Floats, Scene

__all__ = ["NOT_MOVABLE", "FoundDial", "FoundMechanism", "MechanismKind", "UnitMotion", "records_of"]

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

    def record(self, paths: Sequence[str], origin: Floats) -> Mechanism:
        """As it stands in the graph; ``paths`` are those of all source meshes."""
        return Mechanism(
            kind=self.kind,
            meshes=tuple(paths[mesh] for mesh in self.meshes),
            pieces=self.pieces,
            axis=points(self.axis)[0],
            pivot=_placed(self.pivot, origin),
            radius=round(self.radius, 9),
            thickness=None if self.thickness is None else round(self.thickness, 9),
            limits=self.limits,
            open=self.open,
            shut=self.shut,
            sources=dict(self.sources),
        )


@dataclass(frozen=True, eq=False)
class FoundDial:
    """The face of a gauge; see ``records.Dial``. Positions are relative to the scene's origin."""

    center: _Point
    normal: _Point
    radius: float
    up: _Point

    def record(self, origin: Floats) -> Dial:
        """As it stands in the graph."""
        return Dial(
            center=_placed(self.center, origin),
            normal=points(self.normal)[0],
            radius=round(self.radius, 9),
            up=points(self.up)[0],
        )


@dataclass(frozen=True, eq=False)
class UnitMotion:
    """What moves or is read at one unit.

    Args:
        mechanism: what moves; None where nothing does, or nothing was found.
        dial: of a gauge; None where none was found.
        readable: whether it has a face that looks some way.
        why_not: of a valve that would be moved by hand: why it can't be; empty where it can, or where it is no such.
    """

    mechanism: FoundMechanism | None = None
    dial: FoundDial | None = None
    readable: bool = False
    why_not: str = ""

    @property
    def affordances(self) -> tuple[Affordance, ...]:
        """What can be done at it by hand or eye."""
        if self.readable:
            return ("read",)
        if self.mechanism is None or self.mechanism.kind == "needle":
            return ()
        return ("pull",) if self.mechanism.kind == "lever" else ("turn",)


def records_of(motions: Sequence[UnitMotion], number: int, scene: Scene) -> dict[str, Any]:
    """What stands of the motion of a unit in its record; nothing where motions were not looked for.

    Args:
        motions: of all units.
        number: of the unit.
        scene: of source meshes.
    """
    if not motions:
        return {}
    moves, dial = motions[number].mechanism, motions[number].dial
    return {
        "affordances": motions[number].affordances,
        "mechanism": None if moves is None else moves.record(scene.paths, scene.origin),
        "dial": None if dial is None else dial.record(scene.origin),
    }


def _placed(point: _Point, origin: Floats) -> Point:
    return points(np.asarray(point) + origin)[0]
