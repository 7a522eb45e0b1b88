"""How far what turns a valve goes, and where it is open and shut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.stages.mechanisms.lever import Lever
from cadgraph.stages.mechanisms.valve import Valve

__all__ = ["Stroke", "stroke_of_lever", "stroke_of_wheel"]

# A valve with a wheel and no gear: its disc rises by this share of the nominal size with so much a turn [m] (ours).
_LIFT = {"gate": (1.0, 0.006), "globe": (0.25, 0.004)}
_TURNS = 10.0  # of gears, and of wheels of other valves
_AT_STOP = 20.0  # degrees; a lever that is turned by less is drawn at a stop


@dataclass(frozen=True)
class Stroke:
    """Angles from as drawn [deg], anticlockwise as seen from outside; and how they were found.

    Args:
        open: where the valve is open.
        shut: where it is shut.
        sources: of ``open`` and ``limits``.
    """

    open: float
    shut: float
    sources: dict[str, str]

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the greatest angle [deg]."""
        return min(self.open, self.shut), max(self.open, self.shut)


def stroke_of_wheel(valve: Valve, geared: bool) -> Stroke:
    """How far a handwheel goes; it is drawn open, and clockwise shuts."""
    turns, why = _TURNS, "a gear" if geared else "a wheel on a valve of unknown kind or size"
    for kind, (lift, pitch) in _LIFT.items():
        if not geared and valve.size is not None and kind in (valve.unit.kind or ""):
            turns = max(1.0, round(2 * lift * valve.size / 1000 / pitch) / 2)
            share = "" if lift == 1.0 else f" {lift:g} x"
            why = f"{kind} valve:{share} DN {valve.size} by {1000 * pitch:g} mm a turn"
    sources = {"open": "assumed: drawn open", "limits": f"assumed: {turns:g} turns, {why}; clockwise shuts"}
    return Stroke(0.0, -360.0 * turns, sources)


def stroke_of_lever(lever: Lever, valve: Valve) -> Stroke:
    """Where a lever opens: along the line. Clockwise shuts, unless it is drawn between stops the other way."""
    limits = "assumed: a quarter turn, clockwise shuts"
    if valve.line is None:
        return Stroke(0.0, -90.0, {"open": "assumed: drawn open, no line is known to join it", "limits": limits})
    axis = lever.frame.axis
    bore = valve.line.way - (valve.line.way @ axis) * axis
    if float(np.linalg.norm(bore)) < 0.3:
        return Stroke(0.0, -90.0, {"open": "assumed: drawn open, its axis lies along its line", "limits": limits})
    # Anticlockwise to the line, whichever of its ways: 0 to 180 degrees.
    angle = float(np.degrees(np.arctan2(np.cross(lever.way, bore) @ axis, lever.way @ bore))) % 180.0
    angle = angle - 180.0 if angle > 180.0 - _AT_STOP else angle
    why = "the lever along the line" if valve.line.straight else "the lever along its one line: its axis is unproven"
    if angle <= 90.0 + _AT_STOP:
        # Beyond a stop by no more than it is off the line: it is drawn at that stop, which its stroke must reach.
        angle = min(max(angle, 0.0), 90.0)
        return Stroke(_exact(angle), _exact(angle - 90.0), {"open": why, "limits": limits})
    sources = {"open": why, "limits": "assumed: a quarter turn, anticlockwise shuts, as it is drawn between the stops"}
    return Stroke(_exact(angle - 180.0), _exact(angle - 90.0), sources)


def _exact(angle: float) -> float:
    # Rounded, so that rounding noise makes no stop of 1e-14 degrees.
    return round(angle, 6) + 0.0
