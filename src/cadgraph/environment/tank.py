"""The preset ``tank``: an upright tank with lines on supports (structure S3 of the paper)."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.environment.fastener import SUPPORT_REACH
from cadgraph.environment.frame import at
from cadgraph.environment.gauge import pressure_gauge, side_gauge
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.layout import Inline, Run, Tap
from cadgraph.environment.make import Make, draw_make, painted
from cadgraph.environment.piping import tee
from cadgraph.environment.plant import Assembly, Device, Plant
from cadgraph.environment.route import Route
from cadgraph.environment.site import Placed, Site
from cadgraph.environment.standard import PIPES, SECTIONS, TEE_CENTER_TO_END
from cadgraph.environment.structure import beam, column, post
from cadgraph.environment.valve import VALVES
from cadgraph.environment.vessel import Nozzle, Tank, tank
from cadgraph.scene import Floats

__all__ = ["make_tank"]

_FAR = -4.2  # m, x of the portal that carries the lines' far ends


def make_tank(seed: int = 0, hand: Hand | None = None) -> Plant:
    """Builds a tank with five lines: 4 valves, 5 gauges, one branch; stands on z = 0.

    Args:
        seed: chooses sizes, heights and places.
        hand: how it is modelled; plant-design CAD by default.
    """
    style = hand or HANDS["plant-design"]
    rng = np.random.default_rng([seed, 3])
    style, make = painted(style, rng, seed), draw_make(rng) if seed else Make()
    site = Site("tank")
    main = int(rng.choice([100, 150, 150]))
    vent = int(rng.choice([40, 50, 50]))
    radius, height = float(rng.uniform(0.68, 0.80)), float(rng.uniform(1.45, 1.75))
    low_angle = 0.42
    nozzles = [
        Nozzle(main, "top", (0.0, 0.0)),
        Nozzle(vent, "top", (-0.30, 0.34)),
        Nozzle(vent, "top", (0.22, 0.34)),
        Nozzle(25, "side", (-low_angle, 0.16), 0.16),
        Nozzle(25, "side", (low_angle, 0.16), 0.16),
        Nozzle(300, "side", (-2.0, 0.75), 0.20, manway=True),
    ]
    vessel = tank("T-1", style, radius, height, 0.35, nozzles)
    first = site.add(vessel.assembly)
    level = vessel.top + float(rng.uniform(1.5, 1.8))
    overhead = _overhead(site, style, vessel, first, main, level, make, rng)
    second = _vents(site, style, vessel, first, vent, level - 0.42, make, rng)
    _portal(site, style, overhead, second)
    for number, side in enumerate((-1, 1)):
        _drain(site, style, vessel, first, number, side, radius, make, rng)
    return site.plant("tank", seed, style)


def _ends(vessel: Tank, first: int, nozzle: int) -> tuple[Floats, list[int]]:
    """Where a run begins at a nozzle, and what it touches there."""
    return vessel.faces[nozzle][:3, 3], [first + vessel.flanges[nozzle]]


def _overhead(
    site: Site, hand: Hand, vessel: Tank, first: int, dn: int, level: float, make: Make, rng: np.random.Generator
) -> Placed:
    """From the top nozzle up, over to the portal, and round into a gate valve with a lid behind it."""
    start, touching = _ends(vessel, first, 0)
    far = (_FAR, 0.0, level)
    end = (_FAR, -1.75, level)
    route = Route(np.array([start, (0.0, 0.0, level), far, end]))
    s = route.starts
    inline = [
        Inline(float(s[1]) - 0.55),
        Inline(float(s[1]) + 0.62),
        Inline(float(s[2]) - 0.75),
        Inline(float(s[2]) + 1.05, partial(_valve, kind="gate", unit="V-1", dn=dn, make=make), "V-1", np.pi / 2),
    ]
    taps = [
        Tap(0.45 + float(rng.uniform(0, 0.1)), partial(_side, unit="G-1"), "G-1", np.pi / 2),
        Tap(float(s[2]) - 1.5, partial(_gauge, unit="G-2"), "G-2"),
    ]
    run = Run(
        "L1",
        dn,
        route,
        tuple(inline),
        tuple(taps),
        bent=bool(rng.random() < 0.5),
        bend=1.5,
        ends=("joint", "blind"),
        nodes=("T-1", ""),
    )
    return site.lay(run, hand, touching)


def _vents(
    site: Site, hand: Hand, vessel: Tank, first: int, dn: int, level: float, make: Make, rng: np.random.Generator
) -> Placed:
    """Two lines from the top that meet in a tee and go to the portal."""
    start, touching = _ends(vessel, first, 1)
    other, touching_other = _ends(vessel, first, 2)
    y = float(start[1])
    route = Route(np.array([other, (other[0], y, level), (_FAR - 0.4, y, level)]))
    s = route.starts
    meet = float(s[1] + other[0] - start[0])
    inline = [
        Inline(0.5 * float(s[1]) - 0.02, partial(_valve, kind="ball", unit="V-2", dn=dn, make=make), "V-2", np.pi),
        Inline(meet, partial(_tee, dn=dn), roll=np.pi, welded=True, junction="J-1"),
        Inline(meet + 0.85),
    ]
    taps = [Tap(float(s[2]) - 1.1, partial(_gauge, unit="G-3"), "G-3")]
    trunk = site.lay(
        Run("L2", dn, route, tuple(inline), tuple(taps), ends=("joint", "flange"), nodes=("T-1", "")),
        hand,
        touching_other,
    )
    up = (start[0], y, level - TEE_CENTER_TO_END[dn])
    arm = TEE_CENTER_TO_END[dn]
    branch = Run("L3", dn, Route(np.array([start, up])), ends=("joint", "open"), nodes=("T-1", "J-1"), arms=(0.0, arm))
    site.lay(branch, hand, touching, [trunk.device("J-1")])
    return trunk


def _portal(site: Site, hand: Hand, overhead: Placed, vents: Placed) -> None:
    """Two columns with two beams that carry the far ends, and a post in the middle."""
    run, other = overhead.laid.run, vents.laid.run
    level, lower = float(run.route.points[2][2]), float(other.route.points[1][2])
    size = "HEA 120"
    depth, _, web, _ = SECTIONS[size]
    x = _FAR + 0.95
    seats = [
        z - PIPES[placed.laid.run.dn].radius - SUPPORT_REACH - SECTIONS[section][0] / 2
        for placed, z, section in ((overhead, level, size), (vents, lower, "IPE 100"))
    ]
    columns = []
    ys = (-0.55, 0.95)
    top = seats[0] + depth / 2
    for y in ys:
        columns.append(site.add(column(top - depth, hand, size).placed(at(x, y, 0))))
    head = site.add(beam(np.array([x, ys[0] - 0.10, seats[0]]), np.array([x, ys[1] + 0.10, seats[0]]), hand, size))
    for base in columns:
        site.join(base + 1, head)
    # The lower beam reaches between the flanges of the columns to their webs.
    near, far = np.array([x, ys[0] + web / 2, seats[1]]), np.array([x, ys[1] - web / 2, seats[1]])
    shelf = site.add(beam(near, far, hand, "IPE 100"))
    for base in columns:
        site.join(base + 1, shelf)
    for placed, carrier in ((overhead, head), (vents, shelf)):
        route = placed.laid.run.route
        s = float(route.starts[2] - abs(route.points[2][0] - x))
        site.support(placed, s, carrier, hand)


def _drain(
    site: Site,
    hand: Hand,
    vessel: Tank,
    first: int,
    number: int,
    side: int,
    radius: float,
    make: Make,
    rng: np.random.Generator,
) -> None:
    """A small line from the bottom of the shell, round the tank and along the ground on short posts."""
    nozzle = 3 + number
    start, touching = _ends(vessel, first, nozzle)
    out = vessel.faces[nozzle][:3, 0]
    dn = 25
    z = float(start[2])
    away = 0.78 + 0.20 * (number == 0)
    corner = start + away * out
    y = -(radius + 0.42 + 0.16 * (number == 0))
    points = [start, corner, (float(corner[0]), y, z), (_FAR - 1.0, y, z), (_FAR - 1.0, y, z - 0.24)]
    if side > 0:
        y = radius + 0.42
        points = [start, corner, (float(corner[0]), y, z), (_FAR - 1.0, y, z), (_FAR - 1.0, y, z - 0.24)]
    route = Route(np.array(points))
    s = route.starts
    unit, gauge = f"V-{3 + number}", f"G-{4 + number}"
    inline = [
        Inline(0.38, partial(_valve, kind="ball", unit=unit, dn=dn, make=make), unit),
        Inline(float(s[2]) + float(rng.uniform(0.42, 0.50)) * float(s[3] - s[2])),
    ]
    taps = [Tap(float(s[2]) + 0.9, partial(_gauge, unit=gauge), gauge)]
    run = Run(
        f"L{4 + number}",
        dn,
        route,
        tuple(inline),
        tuple(taps),
        ends=("joint", "open"),
        nodes=("T-1", ""),
        flow="forward",
        reason="drains the tank by gravity",
    )
    placed = site.lay(run, hand, touching)
    height = z - PIPES[dn].radius - SUPPORT_REACH
    for share in (0.30, 0.62, 0.92):
        at_s = float(s[2] + share * (s[3] - s[2]))
        x, stand_y, _ = route.point(at_s)
        base = site.add(post(height, hand, capped=True).placed(at(float(x), float(stand_y), 0)))
        site.support(placed, at_s, base + 2, hand)


def _valve(hand: Hand, kind: str, unit: str, dn: int, make: Make) -> Device:
    return VALVES[kind](unit, dn, hand, **make.options(kind))


def _tee(hand: Hand, dn: int) -> Device:
    return tee(dn, dn, hand)


def _gauge(hand: Hand, unit: str) -> Assembly:
    return pressure_gauge(unit, hand, 100, 0.09)


def _side(hand: Hand, unit: str) -> Assembly:
    return side_gauge(unit, hand, 100, 0.11, 0.06, turn=np.pi / 2)
