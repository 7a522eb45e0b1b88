"""The preset ``tank``: a tank with lines on supports (structure S3 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.preset_devices import Column, Drum, ManwayTank, NamePlate, Opening, beam_between
from cadplants.lines.choice import draw_choice
from cadplants.lines.instrument import tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES, SECTIONS, TEE_CENTER_TO_END
from cadplants.parts.brand import dressed
from cadplants.parts.detail import Marks
from cadplants.parts.drum import drum_reach
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.parts.flange import GASKET, plate_thickness
from cadplants.parts.vessel import Nozzle, Tank
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_tank"]

_USUAL = {"fasteners": "set"}
_MANWAY = 300


@dataclass(frozen=True)
class _Plan:
    """The proportions of one tank and its lines [m].

    Args:
        lying: whether the tank lies on saddles instead of standing on legs.
        radius: of the tank.
        height: of its shell; its length where it lies.
        legs: of a standing tank.
        far: x of the portal's far side, where the lines end; negative.
        rise: from the tank's top to the upper line.
        main: nominal size of that line.
        vent: of the vents.
        drain: of the drains.
        side: 1 where the gate valve is towards -y, -1 towards +y.
    """

    lying: bool = False
    radius: float = 0.74
    height: float = 1.60
    legs: int = 4
    far: float = -4.2
    rise: float = 1.65
    main: int = 150
    vent: int = 50
    drain: int = 25
    side: int = 1


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random: standing or lying, slim or wide, lines near or far."""
    lying = bool(rng.random() < 0.45)
    return _Plan(
        lying=lying,
        radius=float(rng.uniform(0.56, 0.74) if lying else rng.uniform(0.60, 0.86)),
        height=float(rng.uniform(1.5, 2.4) if lying else rng.uniform(1.1, 2.1)),
        legs=int(rng.choice([3, 4, 4])),
        far=-float(rng.uniform(3.7, 5.2)),
        rise=float(rng.uniform(1.45, 1.95)),
        main=int(rng.choice([100, 150, 150])),
        vent=int(rng.choice([40, 50, 50])),
        drain=int(rng.choice([25, 25, 32])),
        side=int(rng.choice([-1, 1])),
    )


_Work = Work[_Plan]


def make_tank(seed: int = 0, style: ModelingStyle | None = None, marks: Marks | None = None) -> Plant:
    """Builds a tank with five lines: 4 valves, 5 gauges, one branch; stands on z = 0.

    Args:
        seed: chooses whether it stands or lies, proportions, sizes, sides and places.
        style: how it is modelled; plant-design CAD by default.
        marks: what is modelled on the dials; by the seed by default. With all of it the tank carries a name plate.
    """
    rng = np.random.default_rng([seed, 3])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks)
    plan = _draw(rng) if seed else _Plan()
    site = Site("tank")
    vessel, reach = _vessel(style, plan)
    first = site.add(vessel.assembly)
    level = vessel.top + plan.rise
    work = _Work(site, style, choice, plan, rng)
    overhead = _overhead(work, vessel, first, level)
    second = _vents(work, vessel, first, level - 0.42)
    _portal(site, style, plan, overhead, second)
    for number, side in enumerate((-1, 1)):
        _drain(work, vessel, first, number, side * plan.side, reach)
    if marks == "all":
        _name(site, style, vessel, first)
    return site.plant("tank", seed, style)


def _name(site: Site, style: ModelingStyle, vessel: Tank, first: int) -> None:
    """A name plate on the lid of the manway."""
    face, pad = vessel.faces[-1], GASKET if style.gaskets else 0.0
    out = face[:3, 0]
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = np.cross((0.0, 0.0, 1.0), out), (0.0, 0.0, 1.0), out
    pose[:3, 3] = face[:3, 3] + (pad + plate_thickness(_MANWAY)) * out
    text = NamePlate(text="TANK T-1|PS 6 BAR|TS 95 C|V 2400 L", letter=0.014, rivets=4)
    site.add(text.as_assembly(style).placed(pose), first + vessel.flanges[-1] + (2 if style.gaskets else 1))


def _vessel(style: ModelingStyle, plan: _Plan) -> tuple[Tank, float]:
    """The tank with its nozzles: main, two vents, two drains, manway; and how far it reaches along y."""
    m, radius = plan.side, plan.radius
    vents = [Nozzle(plan.vent, "top", (x, 0.34 * m)) for x in (-0.30, 0.22)]
    if plan.lying:
        low = -0.62 * radius
        nozzles = [
            Nozzle(plan.main, "top", (0.0, 0.0)),
            *vents,
            *(Nozzle(plan.drain, "right", (-0.13 * plan.height * sign * m, low), 0.16) for sign in (1, -1)),
            Nozzle(_MANWAY, "left", (-0.2 * plan.height * m, 0.0), 0.20, manway=True),
        ]
        lying = Drum(radius=radius, length=plan.height, clearance=0.32, nozzles=tuple(map(Opening.of, nozzles)))
        return lying.tank("T-1", style), drum_reach(radius, plan.height)
    angle = 0.42 * m
    nozzles = [
        Nozzle(plan.main, "top", (0.0, 0.0)),
        *vents,
        Nozzle(plan.drain, "side", (-angle, 0.16), 0.16),
        Nozzle(plan.drain, "side", (angle, 0.16), 0.16),
        Nozzle(_MANWAY, "side", (-2.0 * m, 0.75), 0.20, manway=True),
    ]
    openings = tuple(map(Opening.of, nozzles))
    upright = ManwayTank(radius=radius, height=plan.height, clearance=0.35, legs=plan.legs, nozzles=openings)
    return upright.tank("T-1", style), radius


def _ends(vessel: Tank, first: int, nozzle: int) -> tuple[Floats, list[int]]:
    """Where a run begins at a nozzle, and what it touches there."""
    return vessel.faces[nozzle][:3, 3], [first + vessel.flanges[nozzle]]


def _overhead(work: _Work, vessel: Tank, first: int, level: float) -> Placed:
    """From the top nozzle up, over to the portal, and round into a gate valve with a lid behind it."""
    start, touching = _ends(vessel, first, 0)
    far = (work.plan.far, 0.0, level)
    end = (work.plan.far, -1.75 * work.plan.side, level)
    route = Route(np.array([start, (0.0, 0.0, level), far, end]))
    s = route.starts
    # The stem looks away from the tank.
    roll = np.pi / 2 * work.plan.side
    inline = [
        Inline(float(s[1]) - 0.55),
        Inline(float(s[1]) + 0.62),
        Inline(float(s[2]) - 0.75),
        work.choice.valve(float(s[2]) + 1.05, "gate", "V-1", work.plan.main, roll),
    ]
    taps = [
        work.choice.side_gauge(0.45 + float(work.rng.uniform(0, 0.1)), "G-1", 100, work.needle()),
        work.choice.gauge(float(s[2]) - 1.5, "G-2", 100, work.needle()),
    ]
    run = Run(
        "L1",
        work.plan.main,
        route,
        tuple(inline),
        tuple(taps),
        bent=bool(work.rng.random() < 0.5),
        bend=1.5,
        ends=("joint", "blind"),
        nodes=("T-1", ""),
    )
    return work.site.lay(run, work.style, touching)


def _vents(work: _Work, vessel: Tank, first: int, level: float) -> Placed:
    """Two lines from the top that meet in a tee and go to the portal."""
    dn = work.plan.vent
    start, touching = _ends(vessel, first, 1)
    other, touching_other = _ends(vessel, first, 2)
    y = float(start[1])
    route = Route(np.array([other, (other[0], y, level), (work.plan.far - 0.4, y, level)]))
    s = route.starts
    meet = float(s[1] + other[0] - start[0])
    inline = [
        work.choice.valve(0.5 * float(s[1]) - 0.02, "ball", "V-2", dn, np.pi),
        tee_at(meet, "J-1", dn, dn, np.pi),
        Inline(meet + 0.85),
    ]
    taps = [work.choice.gauge(float(s[2]) - 1.1, "G-3", 100, work.needle())]
    trunk = work.site.lay(
        Run("L2", dn, route, tuple(inline), tuple(taps), ends=("joint", "flange"), nodes=("T-1", "")),
        work.style,
        touching_other,
    )
    arm = TEE_CENTER_TO_END[dn]
    up = (start[0], y, level - arm)
    branch = Run("L3", dn, Route(np.array([start, up])), ends=("joint", "open"), nodes=("T-1", "J-1"), arms=(0.0, arm))
    work.site.lay(branch, work.style, touching, [trunk.device("J-1")])
    return trunk


def _portal(site: Site, style: ModelingStyle, plan: _Plan, overhead: Placed, vents: Placed) -> None:
    """Two columns with two beams that carry the far ends, and a post in the middle."""
    run, other = overhead.laid.run, vents.laid.run
    level, lower = float(run.route.points[2][2]), float(other.route.points[1][2])
    size = "HEA 120"
    depth, _, web, _ = SECTIONS[size]
    x = plan.far + 0.95
    seats = [
        z - PIPES[placed.laid.run.dn].radius - SUPPORT_REACH - SECTIONS[section][0] / 2
        for placed, z, section in ((overhead, level, size), (vents, lower, "IPE 100"))
    ]
    columns = []
    ys = (-0.55, 0.95) if plan.side > 0 else (-0.95, 0.55)
    top = seats[0] + depth / 2
    for y in ys:
        columns.append(site.add(Column(height=top - depth, section=size).as_assembly(style).placed(at(x, y, 0))))
    head = site.add(beam_between((x, ys[0] - 0.10, seats[0]), (x, ys[1] + 0.10, seats[0]), size, style))
    for base in columns:
        site.join(base + 1, head)
    # The lower beam reaches between the flanges of the columns to their webs.
    near, far = (x, ys[0] + web / 2, seats[1]), (x, ys[1] - web / 2, seats[1])
    shelf = site.add(beam_between(near, far, "IPE 100", style))
    for base in columns:
        site.join(base + 1, shelf)
    for placed, carrier in ((overhead, head), (vents, shelf)):
        route = placed.laid.run.route
        s = float(route.starts[2] - abs(route.points[2][0] - x))
        site.support(placed, s, carrier, style)


def _drain(work: _Work, vessel: Tank, first: int, number: int, side: int, reach: float) -> None:
    """A small line from the bottom of the shell, round the tank and along the ground on short posts."""
    nozzle = 3 + number
    start, touching = _ends(vessel, first, nozzle)
    out = vessel.faces[nozzle][:3, 0]
    dn = work.plan.drain
    z = float(start[2])
    corner = start + (0.78 + 0.20 * (number == 0)) * out
    # Past the columns of the portal.
    y = side * (max(reach + 0.42, 1.17) + 0.16 * (number == 0))
    end = work.plan.far - 1.0
    route = Route(np.array([start, corner, (float(corner[0]), y, z), (end, y, z), (end, y, z - 0.24)]))
    s = route.starts
    unit, gauge = f"V-{3 + number}", f"G-{4 + number}"
    inline = [
        work.choice.valve(0.38, "ball", unit, dn),
        Inline(float(s[2]) + float(work.rng.uniform(0.42, 0.50)) * float(s[3] - s[2])),
    ]
    taps = [work.choice.gauge(float(s[2]) + 0.9, gauge, 100, work.needle())]
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
    placed = work.site.lay(run, work.style, touching)
    for share in (0.30, 0.62, 0.92):
        work.site.stand(placed, float(s[2] + share * (s[3] - s[2])), work.style)
