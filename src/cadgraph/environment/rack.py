"""The preset ``rack``: a long pipe rack with branches that drop from it."""

from __future__ import annotations

import numpy as np

from cadgraph.environment.electrical import cable_tray
from cadgraph.environment.fastener import SUPPORT_REACH
from cadgraph.environment.frame import at
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.instrument import gauge_tap, meter_at, side_gauge_tap, tee_at, valve_at
from cadgraph.environment.layout import Inline, Run
from cadgraph.environment.make import Make, draw_make, painted
from cadgraph.environment.plant import Plant
from cadgraph.environment.route import Route
from cadgraph.environment.site import Placed, Site
from cadgraph.environment.standard import PIPES, SECTIONS, TEE_CENTER_TO_END
from cadgraph.environment.structure import beam, column

__all__ = ["make_rack"]

_BAY = 3.0  # m
_HALF = 1.10  # m, half the distance of a frame's columns
_LOWER, _UPPER = 2.60, 3.35  # m, tops of the beams
_COLUMN = "HEA 160"
_BEAM = "HEA 120"


def make_rack(seed: int = 0, hand: Hand | None = None, n_bays: int = 0) -> Plant:
    """Builds a rack with five lines on two levels, branches with valves, and a cable tray; stands on z = 0.

    Args:
        seed: chooses bays, sizes, branches and devices.
        hand: how it is modelled; plant-design CAD by default.
        n_bays: how many bays; chosen by the seed where 0.
    """
    style = hand or HANDS["plant-design"]
    rng = np.random.default_rng([seed, 5])
    style, make = painted(style, rng, seed), draw_make(rng) if seed else Make()
    site = Site("rack")
    bays = n_bays or int(rng.integers(3, 6))
    beams = [_frame(site, style, k * _BAY) for k in range(bays + 1)]
    for k in range(bays):
        for side, shaft in ((-1, 0), (1, 1)):
            _tie(site, style, k * _BAY, side * _HALF, beams[k][2][shaft], beams[k + 1][2][shaft])
    ys = (-0.78, -0.40, 0.0, 0.42, 0.80)
    levels = (0, 0, 1, 0, 1)
    sizes = [int(rng.choice(choice)) for choice in ((50, 80), (100, 150), (80, 100), (65, 80), (40, 50))]
    for k, (y, level, dn) in enumerate(zip(ys, levels, sizes, strict=True)):
        drops = {0: -1, 3: 1}.get(k, 0)
        _line(site, style, rng, make, k + 1, dn, y, level, drops, bays, [frame[:2][level] for frame in beams])
    tray = site.add(cable_tray(bays * _BAY, style, pieces=bays).placed(at(0, -0.55, _UPPER)))
    for k in range(bays):
        site.join(tray + k, beams[k][1])
        site.join(tray + k, beams[k + 1][1])
    return site.plant("rack", seed, style)


def _frame(site: Site, hand: Hand, x: float) -> tuple[int, int, tuple[int, int]]:
    """Two columns with a beam on each level: the beams, and the columns' shafts."""
    depth, _, web, _ = SECTIONS[_COLUMN]
    height, _, _, _ = SECTIONS[_BEAM]
    shafts = []
    for y in (-_HALF, _HALF):
        shafts.append(site.add(column(_UPPER - height, hand, _COLUMN).placed(at(x, y, 0))) + 1)
    z = _LOWER - height / 2
    # The lower beam reaches between the columns' flanges to their webs, the upper one lies on their heads.
    inner, outer = _HALF - web / 2, _HALF + depth / 2
    lower = site.add(beam(np.array([x, -inner, z]), np.array([x, inner, z]), hand, _BEAM))
    z = _UPPER - height / 2
    upper = site.add(beam(np.array([x, -outer, z]), np.array([x, outer, z]), hand, _BEAM))
    for shaft in shafts:
        site.join(shaft, lower)
        site.join(shaft, upper)
    return lower, upper, (shafts[0], shafts[1])


def _tie(site: Site, hand: Hand, x: float, y: float, near: int, far: int) -> None:
    """A beam along x between the flanges of two columns."""
    half = SECTIONS[_COLUMN][0] / 2
    z = _UPPER - 0.45
    tie = site.add(beam(np.array([x + half, y, z]), np.array([x + _BAY - half, y, z]), hand, "IPE 160"))
    site.join(near, tie)
    site.join(far, tie)


def _line(
    site: Site,
    hand: Hand,
    rng: np.random.Generator,
    make: Make,
    number: int,
    dn: int,
    y: float,
    level: int,
    side: int,
    bays: int,
    beams: list[int],
) -> None:
    """A line along the rack: over the frames, down at its far end; with branches where ``side`` is not 0."""
    z = (_LOWER, _UPPER)[level] + SUPPORT_REACH + PIPES[dn].radius
    low, high = -0.75 - 0.12 * (number % 3), bays * _BAY + 0.55 + 0.28 * number
    points = [(low, y, z), (high, y, z)]
    if number in (2, 3):
        points.append((high, y, 0.70))
    route = Route(np.array(points))
    tag = f"L{number}"
    inline: list[Inline] = []
    taps = []
    branches = []
    for bay in range(bays):
        middle = (bay + 0.5) * _BAY - low
        if side and rng.random() < 0.75:
            inline.append(tee_at(middle, f"J-{number}{bay + 1}", dn, min(dn, 50), np.pi))
            branches.append((bay, middle))
        elif rng.random() < 0.25:
            inline.append(meter_at(middle, f"F-{number}{bay + 1}", dn))
        elif rng.random() < 0.5:
            inline.append(Inline(middle))
        if rng.random() < 0.5 and level == 1:
            unit = f"V-{number}{bay + 1}"
            kind = str(rng.choice(["gate", "globe", "ball", "butterfly"]))
            inline.append(valve_at(middle - 0.75, kind, unit, dn, make=make))
            taps.append(gauge_tap(middle + 0.70, f"G-{number}{bay + 1}", rng, 100))
    if number in (2, 3):
        drop = float(route.starts[1])
        inline.append(
            valve_at(drop + 1.15, "gate" if number == 2 else "globe", f"V-{number}9", dn, np.pi / 2, make=make)
        )
        taps.append(side_gauge_tap(drop + 0.62, f"G-{number}9", rng, down=True))
    ends = ("flange", "flange") if number != 5 else ("blind", "flange")
    placed = site.lay(Run(tag, dn, route, tuple(inline), tuple(taps), ends=ends), hand)
    for k, carrier in enumerate(beams):
        site.support(placed, k * _BAY - low, carrier, hand)
    for bay, middle in branches:
        _branch(site, hand, rng, make, placed, number, bay, middle, side)


def _branch(
    site: Site,
    hand: Hand,
    rng: np.random.Generator,
    make: Make,
    trunk: Placed,
    number: int,
    bay: int,
    s: float,
    side: int,
) -> None:
    """From a tee down, with a valve at hand height, and out to the side."""
    run = trunk.laid.run
    dn = min(run.dn, 50)
    x, y, z = (float(value) for value in run.route.point(s))
    top = z - TEE_CENTER_TO_END[run.dn]
    low = 0.62
    route = Route(np.array([(x, y, top), (x, y, low), (x, y + side * 0.75, low)]))
    node, unit, gauge = f"J-{number}{bay + 1}", f"V-{number}{bay + 1}", f"G-{number}{bay + 1}"
    kind = str(rng.choice(["ball", "ball", "globe", "gate"]))
    roll = float(rng.choice([0.0, np.pi]))
    actuated = bool(rng.random() < 0.4)
    inline = (valve_at(top - 1.25, kind, unit, dn, roll, make=make, actuated=actuated),)
    taps = (side_gauge_tap(top - 1.75, gauge, rng, down=True, roll=roll + np.pi / 2),)
    branch = Run(
        f"L{number}B{bay + 1}",
        dn,
        route,
        inline,
        taps,
        ends=("open", "flange"),
        nodes=(node, ""),
        arms=(TEE_CENTER_TO_END[run.dn], 0.0),
    )
    site.lay(branch, hand, [trunk.device(node)])
