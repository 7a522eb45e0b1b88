"""The preset ``station``: a feed tank, two pumps in parallel and a receiving drum on a slab; cadgraph's demo scene."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.preset_devices import Drum, EndSuction, ManwayTank, Opening
from cadplants.lines.choice import draw_choice
from cadplants.lines.instrument import tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run
from cadplants.model.contacts import on_ground
from cadplants.model.plant import Component, Plant
from cadplants.model.standards import TEE_CENTER_TO_END
from cadplants.parts.brand import dressed
from cadplants.parts.detail import Marks
from cadplants.parts.pump import Pump
from cadplants.parts.vessel import Nozzle, Tank
from cadplants.presets.gauged_tank import with_level_gauge
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.mesh_ops import box
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_station"]

_USUAL = {"fasteners": "set", "valve": "few", "gauge": "few"}
_SUCTION, _PUMP_IN, _PUMP_OUT, _DISCHARGE, _DRAIN, _MANWAY = 100, 80, 50, 80, 25, 300  # nominal sizes
_CLEAR = 0.35  # m, from the ground to both vessels


@dataclass(frozen=True)
class _Plan:
    """The proportions of one station [m]: the tank, the pumps and the drum stand one behind the other along y.

    Args:
        pitch: from pump to pump.
        suction_x: place of the suction header and of the tank; negative.
        discharge_z: height of the discharge header.
        radius: of the tank.
        height: of its shell.
        drum_radius: of the drum.
        drum_length: of its shell.
    """

    pitch: float = 1.20
    suction_x: float = -1.75
    discharge_z: float = 2.15
    radius: float = 0.65
    height: float = 1.50
    drum_radius: float = 0.50
    drum_length: float = 1.50

    @property
    def pumps(self) -> tuple[float, float]:
        """Where the pumps stand along y."""
        return -self.pitch / 2, self.pitch / 2

    @property
    def tank(self) -> float:
        """Where the tank stands along y."""
        return self.pumps[0] - 2.05 - self.radius

    @property
    def drum(self) -> float:
        """Where the drum lies along y."""
        return self.pumps[1] + 2.35


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random."""
    return _Plan(
        pitch=float(rng.uniform(1.10, 1.40)),
        suction_x=-float(rng.uniform(1.70, 2.00)),
        discharge_z=float(rng.uniform(2.10, 2.40)),
        radius=float(rng.uniform(0.60, 0.75)),
        height=float(rng.uniform(1.30, 1.80)),
        drum_radius=float(rng.uniform(0.45, 0.55)),
        drum_length=float(rng.uniform(1.40, 1.80)),
    )


_Work = Work[_Plan]


def make_station(seed: int = 0, style: ModelingStyle | None = None, marks: Marks | None = None) -> Plant:
    """Builds a tank that feeds two pumps, which deliver through a globe valve into a drum; stands on a slab at z = 0.

    Args:
        seed: of everything that varies: proportions, paint, looks of the devices; 0 makes the demo.
        style: how it is modelled; plant-design CAD by default.
        marks: what is modelled on the dials; by the seed by default.
    """
    rng = np.random.default_rng([seed, 12])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks)
    work = _Work(Site("station"), style, choice, _draw(rng) if seed else _Plan(), rng)
    feed, first = _feed_tank(work)
    _drain(work, feed, first)
    pumps = [EndSuction(dn=_PUMP_IN, out=_PUMP_OUT).pump(f"P-{k + 1}", style) for k in range(2)]
    suction = _suction_header(work, feed, first, float(pumps[0].suction[2, 3]))
    receiver, lowest = _receiver(work)
    discharge = _discharge_header(work, receiver, lowest)
    for k, (y, one) in enumerate(zip(work.plan.pumps, pumps, strict=True)):
        base = work.site.add(one.assembly.placed(at(0, y, 0)))
        _into_pump(work, k + 1, suction, base, one)
        _out_of_pump(work, k + 1, discharge, base, one)
    _outlet(work, receiver, lowest)
    _fill(work, feed, first)
    _vent(work, receiver, lowest)
    return _on_slab(work.site.plant("station", seed, style), style)


def _feed_tank(work: _Work) -> tuple[Tank, int]:
    """An upright tank: nozzles of outlet, drain and filling, a manway, a level gauge; and its first component."""
    nozzles = [
        Nozzle(_SUCTION, "side", (np.pi / 2, 0.16), 0.16),
        Nozzle(_DRAIN, "side", (np.pi, 0.14), 0.14),
        Nozzle(_DISCHARGE, "top", (0.0, 0.0)),
        Nozzle(_MANWAY, "side", (-0.42 * np.pi, 0.70), 0.20, manway=True),
    ]
    openings, plan = tuple(map(Opening.of, nozzles)), work.plan
    upright = ManwayTank(radius=plan.radius, height=plan.height, clearance=_CLEAR, legs=4, nozzles=openings)
    vessel = upright.tank("T-1", work.style)
    low = _CLEAR + work.plan.radius / 2 + 0.04
    span = low + 0.28, low + work.plan.height - 0.25
    whole = with_level_gauge(vessel.assembly, "T-1", "L-1", work.plan.radius, 0.06 * np.pi, span, work.style, work.rng)
    pose = at(work.plan.suction_x, work.plan.tank, 0.0)
    first = work.site.add(whole.placed(pose))
    return replace(vessel, faces=tuple(pose @ face for face in vessel.faces)), first


def _receiver(work: _Work) -> tuple[Tank, int]:
    """A lying drum: nozzles of inlet, outlet and vent, a manway; and its first component."""
    nozzles = [
        Nozzle(_DISCHARGE, "top", (0.0, -0.25 * work.plan.drum_length)),
        Nozzle(_DISCHARGE, "right", (0.18 * work.plan.drum_length, -0.55 * work.plan.drum_radius), 0.16),
        Nozzle(_PUMP_OUT, "top", (0.0, 0.25 * work.plan.drum_length)),
        Nozzle(_MANWAY, "left", (0.0, 0.0), 0.20, manway=True),
    ]
    openings, plan = tuple(map(Opening.of, nozzles)), work.plan
    lying = Drum(radius=plan.drum_radius, length=plan.drum_length, clearance=_CLEAR, nozzles=openings)
    vessel = lying.tank("T-2", work.style)
    pose = at(0.0, work.plan.drum + 0.25 * work.plan.drum_length, 0.0)
    first = work.site.add(vessel.assembly.placed(pose))
    return replace(vessel, faces=tuple(pose @ face for face in vessel.faces)), first


def _start(vessel: Tank, first: int, nozzle: int) -> tuple[Floats, list[int]]:
    """Where a run begins at a nozzle, and the component that it touches there."""
    return vessel.faces[nozzle][:3, 3], [first + vessel.flanges[nozzle]]


def _suction_header(work: _Work, feed: Tank, first: int, level: float) -> Placed:
    """From the tank through a valve down to the height of the pumps, past both of them."""
    face, touching = _start(feed, first, 0)
    x, y, z = (float(v) for v in face)
    down = y + 1.00
    corners = [(x, y, z), (x, down, z), (x, down, level), (x, work.plan.pumps[1] + 0.62, level)]
    route = Route(np.array(corners))
    behind = float(route.starts[2]) - down
    tees = [
        tee_at(behind + place, f"J-S{k + 1}", _SUCTION, _PUMP_IN, np.pi / 2) for k, place in enumerate(work.plan.pumps)
    ]
    run = Run(
        "S",
        _SUCTION,
        route,
        (work.choice.valve(0.42, "gate", "V-S", _SUCTION), *tees),
        ends=("joint", "blind"),
        nodes=("T-1", ""),
        flow="forward",
        reason="feeds the pumps",
    )
    placed = work.site.lay(run, work.style, touching)
    for place in (work.plan.pumps[0] - 0.30, (work.plan.pumps[0] + work.plan.pumps[1]) / 2, work.plan.pumps[1] + 0.30):
        work.site.stand(placed, behind + place, work.style)
    return placed


def _discharge_header(work: _Work, receiver: Tank, first: int) -> Placed:
    """Over both pumps, through a globe valve and down into the drum; a relief valve guards it."""
    face, touching = _start(receiver, first, 0)
    start, z = work.plan.pumps[0] - 0.50, work.plan.discharge_z
    corners = [(0.0, start, z), (0.0, float(face[1]), z), tuple(float(v) for v in face)]
    tees = [tee_at(y - start, f"J-D{k + 1}", _DISCHARGE, _PUMP_OUT, np.pi) for k, y in enumerate(work.plan.pumps)]
    last = work.plan.pumps[1] - start
    run = Run(
        "D",
        _DISCHARGE,
        Route(np.array(corners)),
        (
            *tees,
            work.choice.valve(last + 1.00, "globe", "V-C", _DISCHARGE),
            work.choice.valve(last + 1.72, "gate", "V-D", _DISCHARGE),
        ),
        (
            work.choice.relief_valve(last + 0.24, "V-R", int(work.rng.integers(1000))),
            work.choice.gauge(last + 0.48, "G-D", 100, work.needle()),
        ),
        ends=("blind", "joint"),
        nodes=("", "T-2"),
        flow="forward",
        reason="leaves the pumps",
    )
    placed = work.site.lay(run, work.style, (), touching)
    for place in (work.plan.pumps[0] - 0.25, (work.plan.pumps[0] + work.plan.pumps[1]) / 2, work.plan.pumps[1] + 0.62):
        work.site.stand(placed, place - start, work.style, 0.08)
    return placed


def _into_pump(work: _Work, number: int, header: Placed, base: int, one: Pump) -> None:
    """From the suction header's tee through a gate valve to a pump."""
    arm, y = TEE_CENTER_TO_END[_SUCTION], work.plan.pumps[number - 1]
    x, _, z = (float(v) for v in one.suction[:3, 3])
    route = Route(np.array([(work.plan.suction_x + arm, y, z), (x, y, z)]))
    node = f"J-S{number}"
    run = Run(
        f"S{number}",
        _PUMP_IN,
        route,
        (work.choice.valve(0.40 * route.length, "gate", f"V-{number}1", _PUMP_IN),),
        (work.choice.gauge(0.80 * route.length, f"G-{number}1", 63, work.needle()),),
        ends=("open", "joint"),
        nodes=(node, f"P-{number}"),
        arms=(arm, 0.0),
        flow="forward",
        reason="into the suction of a pump",
    )
    work.site.lay(run, work.style, [header.device(node)], [base])


def _out_of_pump(work: _Work, number: int, header: Placed, base: int, one: Pump) -> None:
    """From a pump up through a check valve and a gate valve to the discharge header's tee."""
    arm, y = TEE_CENTER_TO_END[_DISCHARGE], work.plan.pumps[number - 1]
    x, _, z = (float(v) for v in one.discharge[:3, 3])
    route = Route(np.array([(x, y, z), (x, y, work.plan.discharge_z - arm)]))
    node, length = f"J-D{number}", route.length
    run = Run(
        f"D{number}",
        _PUMP_OUT,
        route,
        (
            _in_pieces(work.choice.of_family("check valve/axial", 0.42 * length, f"V-{number}2", _PUMP_OUT, 2)),
            work.choice.valve(0.77 * length, "gate", f"V-{number}3", _PUMP_OUT),
        ),
        (work.choice.side_gauge(0.14 * length, f"G-{number}2", 63, work.needle(), roll=np.pi),),
        ends=("joint", "open"),
        nodes=(f"P-{number}", node),
        arms=(0.0, arm),
        flow="forward",
        reason="check valve behind a pump",
    )
    work.site.lay(run, work.style, [base], [header.device(node)])


def _in_pieces(item: Inline) -> Inline:
    """The device as somebody models it who takes more pains with it than with others."""
    build = item.build
    if build is None:
        return item
    return replace(item, build=lambda style: build(replace(style, valve="pieces")))


def _drain(work: _Work, feed: Tank, first: int) -> None:
    """From the bottom of the tank's shell through a ball valve down to the slab."""
    face, touching = _start(feed, first, 1)
    x, y, z = (float(v) for v in face)
    route = Route(np.array([(x, y, z), (x - 0.62, y, z), (x - 0.62, y, 0.12)]))
    run = Run(
        "W",
        _DRAIN,
        route,
        (work.choice.valve(0.30, "ball", "V-W", _DRAIN),),
        ends=("joint", "open"),
        nodes=("T-1", ""),
        flow="forward",
        reason="drains the tank by gravity",
    )
    work.site.lay(run, work.style, touching)


def _outlet(work: _Work, receiver: Tank, first: int) -> None:
    """From low on the drum through a gate valve to a flange, where the next plant begins."""
    face, touching = _start(receiver, first, 1)
    x, y, z = (float(v) for v in face)
    run = Run(
        "E",
        _DISCHARGE,
        Route(np.array([(x, y, z), (x + 1.50, y, z)])),
        (work.choice.valve(0.45, "gate", "V-E", _DISCHARGE),),
        (work.choice.gauge(0.85, "G-E", 100, work.needle()),),
        ends=("joint", "flange"),
        nodes=("T-2", ""),
        flow="forward",
        reason="leaves the drum by gravity",
    )
    placed = work.site.lay(run, work.style, touching)
    work.site.stand(placed, 1.15, work.style)


def _fill(work: _Work, feed: Tank, first: int) -> None:
    """From a flange, where the plant before ends, through a gate valve to the top of the tank."""
    face, touching = _start(feed, first, 2)
    x, y, z = (float(v) for v in face)
    rise, reach = 0.34, 1.00
    route = Route(np.array([(x, y, z), (x, y, z + rise), (x - reach, y, z + rise)]))
    run = Run(
        "F",
        _DISCHARGE,
        route,
        (work.choice.valve(rise + 0.55, "gate", "V-F", _DISCHARGE),),
        ends=("joint", "flange"),
        nodes=("T-1", ""),
    )
    work.site.lay(run, work.style, touching)


def _vent(work: _Work, receiver: Tank, first: int) -> None:
    """From the top of the drum round a gooseneck into the open."""
    face, touching = _start(receiver, first, 2)
    x, y, z = (float(v) for v in face)
    corners = [(x, y, z), (x, y, z + 0.28), (x, y + 0.26, z + 0.28), (x, y + 0.26, z + 0.12)]
    work.site.lay(
        Run("B", _PUMP_OUT, Route(np.array(corners)), ends=("joint", "open"), nodes=("T-2", "")), work.style, touching
    )


def _on_slab(plant: Plant, style: ModelingStyle) -> Plant:
    """The plant with a slab under it, which is no part of its structure."""
    corners = np.concatenate([c.vertices for c in plant.components])
    low, high = corners.min(axis=0) - 0.6, corners.max(axis=0) + 0.6
    middle = (low + high) / 2
    solid = box((float(high[0] - low[0]), float(high[1] - low[1]), 0.2), (float(middle[0]), float(middle[1]), -0.1))
    slab = Component(solid, "Structural element", "ground", style.color("ground"), style=style.name)
    return on_ground(plant, slab)
