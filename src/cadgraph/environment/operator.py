"""What turns a valve: handwheels, levers and yokes."""

from __future__ import annotations

from functools import cache

import numpy as np

from cadgraph.environment.polygon import circle
from cadgraph.environment.solid import Solid, extrude, loft, merge, revolve, sweep, weld

__all__ = ["handwheel", "lever_solid", "yoke_solid"]


@cache
def handwheel(radius: float, rim: float, spokes: int, hub: float, thick: float, bore: float, sides: int) -> Solid:
    """A handwheel about z with a round rim and straight spokes, its hub from 0 to ``thick`` [m]."""
    angles = np.arange(12) * 2 * np.pi / 12
    middle = thick / 2
    profile = np.column_stack([radius - rim + rim * np.cos(angles), middle + rim * np.sin(angles)])
    solids = [weld([revolve(profile, sides, closed=True)])]
    solids.append(weld([revolve([(bore, 0), (hub, 0), (hub, thick), (bore, thick)], 24, closed=True)]))
    for k in range(spokes):
        angle = 2 * np.pi * k / spokes
        way = np.array([np.cos(angle), np.sin(angle), 0.0])
        lift = np.array([0.0, 0.0, middle])
        path = np.array([way * (hub - 0.002) + lift, way * (radius - 2 * rim + 0.15 * rim) + lift])
        solids.append(sweep(path, 0.62 * rim * circle(1.0, 8)))
    return merge(solids)


def lever_solid(length: float, half: float, thick: float) -> Solid:
    """A flat lever along x with a round eye about the origin, a step up and a round tip; its underside at 0."""
    rise = 0.16 * length
    stations = [(-half * np.cos(a), half * max(np.sin(a), 0.15), 0.0) for a in np.linspace(0, np.pi / 2, 5)]
    stations += [
        (0.12 * length, half * 0.9, 0.0),
        (0.30 * length, half * 0.72, rise),
        (0.45 * length, half * 0.72, rise),
    ]
    stations += [(length - half * 0.8, half * 0.8, rise)]
    stations += [
        (length - half * 0.8 * (1 - np.sin(a)), half * 0.8 * max(np.cos(a), 0.15), rise)
        for a in np.linspace(0.4, np.pi / 2, 4)
    ]
    loops = [np.array([[x, w, z], [x, w, z + thick], [x, -w, z + thick], [x, -w, z]]) for x, w, z in stations]
    ends = [loop.mean(axis=0, keepdims=True) for loop in (loops[0], loops[-1])]
    return weld([loft([ends[0], *loops, ends[1]])])


def yoke_solid(spread: float, foot: float, top: float, crown: float, bush: float, bore: float, sides: int) -> Solid:
    """Two arms from a bonnet at ``foot`` up to a bush about the stem."""
    sleeve = extrude(circle(bush, 24), top - crown, top, (circle(bore, sides),))
    solids = [sleeve]
    wide, thin = 0.42 * bush + 0.004, 0.22 * bush + 0.002
    section = np.array([[wide, -thin], [wide, thin], [-wide, thin], [-wide, -thin]])
    for sign in (1, -1):
        shoulder = top - crown / 2
        path = np.array(
            [
                [0, sign * (spread - thin), foot],
                [0, sign * (spread - thin), foot + 0.45 * (shoulder - foot)],
                [0, sign * (0.45 * spread + 0.55 * bush), shoulder - 0.10 * (shoulder - foot)],
                [0, sign * (bush * 0.85), shoulder],
            ]
        )
        solids.append(sweep(path, section, up=(1.0, 0.0, 0.0)))
    return merge(solids)
