"""What a run of pipe is made of: its centreline, its devices and instruments, its ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from cadplants.lines.route import Route
from cadplants.model.plant import Assembly, Device
from cadplants.model.standards import ELBOW_LONG_RADIUS, PIPES
from cadplants.parts.piping import bend_tangent
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Inline", "Run", "Tap"]


@dataclass(frozen=True)
class Inline:
    """Something flanged or welded into a run.

    Args:
        s: chainage of its middle [m].
        build: makes the device for a style; None for a plain joint of two flanges.
        unit: id of the device, "" for a joint.
        roll: of its stem about the run [rad]; 0 is upright.
        reverse: whether it is built against the run (check valves).
        welded: whether it is butt-welded (tees, reducers) instead of flanged.
        junction: id of the junction that it makes (tees), or "".
        dn: nominal size of the run behind it (reducers); 0 as before.
    """

    s: float
    build: Callable[[ModelingStyle], Device] | None = None
    unit: str = ""
    roll: float = 0.0
    reverse: bool = False
    welded: bool = False
    junction: str = ""
    dn: int = 0


@dataclass(frozen=True)
class Tap:
    """An instrument on a branch outlet.

    Args:
        s: chainage [m], on a straight piece of pipe.
        build: makes the instrument for a style, standing on z = 0.
        unit: its id.
        roll: of the outlet about the run [rad]; 0 is upright.
    """

    s: float
    build: Callable[[ModelingStyle], Assembly]
    unit: str
    roll: float = 0.0


@dataclass(frozen=True)
class Run:
    """One line.

    Args:
        tag: unique in the plant.
        dn: nominal size.
        route: its centreline.
        inline: flanged devices and joints.
        taps: instruments.
        bent: whether corners are bent pipe (one mesh from flange to flange) rather than elbows.
        bend: bend radius of bent pipe, in outside diameters.
        ends: how it begins and ends: ``open`` (a pipe), ``flange``, ``blind``, ``plate`` (a pipe welded to a plate
            that closes it), or ``joint`` (a flange bolted with its gasket to a face at that point: a nozzle).
        nodes: ids of the units or junctions that it begins and ends at; "" for a terminal.
        arms: how far these nodes lie beyond its ends: the arm of a tee that it is welded to [m].
        flow: ``forward`` or ``backward`` along the route where physics fixes it, else ``unknown``.
        reason: what fixes it.
    """

    tag: str
    dn: int
    route: Route
    inline: tuple[Inline, ...] = ()
    taps: tuple[Tap, ...] = ()
    bent: bool = False
    bend: float = 2.5
    ends: tuple[str, str] = ("open", "open")
    nodes: tuple[str, str] = ("", "")
    arms: tuple[float, float] = (0.0, 0.0)
    flow: str = "unknown"
    reason: str = ""

    def dn_at(self, s: float) -> int:
        """The nominal size at a chainage."""
        dn = self.dn
        for item in sorted(self.inline, key=lambda item: item.s):
            if item.dn and item.s <= s:
                dn = item.dn
        return dn

    def tangent(self, corner: int) -> float:
        """How far before and behind a corner its bend reaches [m]."""
        dn = self.dn_at(self.route.starts[corner])
        radius = self.bend * PIPES[dn].outer if self.bent else ELBOW_LONG_RADIUS[dn]
        directions = self.route.directions
        return bend_tangent(radius, directions[corner - 1], directions[corner])
