"""The preset ``pumps``: parallel centrifugal pumps between a suction and a discharge header."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import EndSuction, NamePlate, Post
from cadplants.lines.choice import draw_choice
from cadplants.lines.instrument import strainer_at, tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES, TEE_CENTER_TO_END
from cadplants.parts.brand import dressed
from cadplants.parts.detail import Marks
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.parts.pump import Pump
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_pumps"]

_USUAL = {"fasteners": "set"}
_SIZES = ((100, 80, 50, 80), (150, 100, 65, 100), (80, 50, 32, 65))
"""Nominal sizes of suction header, suction, discharge, discharge header."""


@dataclass(frozen=True)
class _Plan:
    """The proportions of one pump station [m].

    Args:
        count: of pumps.
        sizes: one of ``_SIZES``.
        pitch: from pump to pump.
        suction_x: where the suction header lies; negative.
        discharge_z: height of the discharge header.
        side: 1 where the headers go on towards +y, -1 towards -y.
    """

    count: int = 3
    sizes: tuple[int, int, int, int] = _SIZES[0]
    pitch: float = 1.10
    suction_x: float = -1.75
    discharge_z: float = 2.15
    side: int = 1

    @property
    def ys(self) -> list[float]:
        """Where the pumps stand, along the headers."""
        return [self.side * (k - (self.count - 1) / 2) * self.pitch for k in range(self.count)]


_Work = Work[_Plan]


def make_pumps(
    seed: int = 0, style: ModelingStyle | None = None, n_pumps: int = 0, marks: Marks | None = None
) -> Plant:
    """Builds two to four pumps with check, gate and globe valves between two headers; stands on z = 0.

    Args:
        seed: chooses sizes, how many pumps, distances, the side that the headers leave by, valves.
        style: how it is modelled; plant-design CAD by default.
        n_pumps: how many; chosen by the seed where 0.
        marks: what is modelled on the dials; by the seed by default. With all of it motors carry name plates.
    """
    rng = np.random.default_rng([seed, 4])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks)
    site = Site("pumps")
    plan = _Plan(
        count=n_pumps or (int(rng.integers(2, 5)) if seed else 3),
        sizes=_SIZES[int(rng.integers(3))],
        pitch=float(rng.uniform(1.05, 1.45)),
        suction_x=-float(rng.uniform(1.70, 2.15)),
        discharge_z=float(rng.uniform(2.10, 2.60)),
        side=int(rng.choice([-1, 1])),
    )
    work = _Work(site, style, choice, plan, rng)
    count, ys = plan.count, plan.ys
    suction_dn, pump_in, pump_out, discharge_dn = plan.sizes
    pumps = [EndSuction(dn=pump_in, out=pump_out).pump(f"P-{k + 1}", style) for k in range(count)]
    axis = float(pumps[0].suction[2, 3])
    to_pumps = np.pi / 2 * plan.side
    suction = _header(work, "S", (suction_dn, pump_in), (plan.suction_x, axis), to_pumps)
    discharge = _header(work, "D", (discharge_dn, pump_out), (0.0, plan.discharge_z), np.pi)
    for k, (y, one) in enumerate(zip(ys, pumps, strict=True)):
        base = site.add(one.assembly.placed(at(0, y, 0)))
        number = 10 * (k + 1)
        start = (float(one.suction[0, 3]), axis)
        _suction(work, suction, number, base, y, start)
        face = (float(one.discharge[0, 3]), float(one.discharge[2, 3]))
        _discharge(work, discharge, number, base, y, face)
        if marks == "all":
            _name(site, style, k + 1, base, one, y)
    return site.plant("pumps", seed, style)


def _header(work: _Work, tag: str, sizes: tuple[int, int], place: tuple[float, float], roll: float) -> Placed:
    """A header along y at x, z with a tee for each pump, a valve before its open end and a lid on the other."""
    plan, rng = work.plan, work.rng
    x, z = place
    dn, branch = sizes
    count = plan.count
    ys = [plan.side * y for y in plan.ys]
    low, high = ys[0] - 0.62, ys[-1] + 1.55
    # The suction header is fed at its far end, which the discharge header leaves by: both runs start at the lid.
    route = Route(np.array([(x, plan.side * low, z), (x, plan.side * high, z)]))
    tees = [tee_at(y - low, f"J-{tag}{k + 1}", dn, branch, roll) for k, y in enumerate(ys)]
    kind = "butterfly" if rng.random() < 0.6 else "gate"
    unit = f"V-{tag}"
    valve = work.choice.valve(high - low - 0.50, kind, unit, dn)
    # The dial looks across the header, to where the pumps stand.
    dial = 0.0 if plan.side > 0 else np.pi
    tap = work.choice.gauge(high - low - 0.86, f"G-{tag}", 100, work.needle(), dial)
    # Behind the pumps a relief valve guards the header.
    taps = (
        (tap,) if tag == "S" else (tap, work.choice.relief_valve(ys[-1] - low + 0.33, "V-R", int(rng.integers(1000))))
    )
    flow, reason = ("backward", "feeds the pumps") if tag == "S" else ("forward", "leaves the pumps")
    run = Run(tag, dn, route, (*tees, valve), tuple(taps), ends=("blind", "flange"), flow=flow, reason=reason)
    placed = work.site.lay(run, work.style)
    height = z - PIPES[dn].radius - SUPPORT_REACH
    upright = Post(height=height, side=0.05 if height < 1 else 0.08, capped=True)
    for k in range(count + 1):
        y = ys[0] - 0.36 if k == 0 else ys[k - 1] + (0.5 * plan.pitch if k < count else 0.43)
        stand = work.site.add(upright.as_assembly(work.style).placed(at(x, plan.side * y, 0)))
        work.site.support(placed, y - low, stand + 2, work.style)
    return placed


def _suction(work: _Work, header: Placed, number: int, base: int, y: float, face: tuple[float, float]) -> None:
    """From the header's tee to the pump."""
    x, z = face
    sizes = work.plan.sizes[:2]
    start = work.plan.suction_x + TEE_CENTER_TO_END[sizes[0]]
    route = Route(np.array([(start, y, z), (x, y, z)]))
    node = f"J-S{number // 10}"
    unit, gauge = f"V-{number + 1}", f"G-{number + 1}"
    kind = "gate" if work.rng.random() < 0.6 else "ball"
    strained = bool(work.rng.random() < 0.5)
    middle = (0.21 if strained else 0.40) * route.length
    inline = [work.choice.valve(middle, kind, unit, sizes[1])]
    if strained:
        inline.append(strainer_at(0.585 * route.length, sizes[1]))
    run = Run(
        f"S{number // 10}",
        sizes[1],
        route,
        tuple(inline),
        (work.choice.gauge((0.85 if strained else 0.80) * route.length, gauge, 63, work.needle()),),
        ends=("open", "joint"),
        nodes=(node, f"P-{number // 10}"),
        arms=(TEE_CENTER_TO_END[sizes[0]], 0.0),
        flow="forward",
        reason="into the suction of a pump",
    )
    work.site.lay(run, work.style, [header.device(node)], [base])


def _discharge(work: _Work, header: Placed, number: int, base: int, y: float, face: tuple[float, float]) -> None:
    """From the pump up through a check valve and a block valve to the header's tee."""
    x, z = face
    dn, header_dn = work.plan.sizes[2:]
    end = work.plan.discharge_z - TEE_CENTER_TO_END[header_dn]
    route = Route(np.array([(x, y, z), (x, y, end)]))
    node = f"J-D{number // 10}"
    check, block, gauge = f"V-{number + 2}", f"V-{number + 3}", f"G-{number + 2}"
    kind = str(work.rng.choice(["gate", "globe"]))
    space = route.length
    inline: tuple[Inline, ...] = (
        work.choice.valve(0.40 * space, "check", check, dn),
        work.choice.valve(0.77 * space, kind, block, dn),
    )
    run = Run(
        f"D{number // 10}",
        dn,
        route,
        inline,
        (work.choice.side_gauge(0.125 * space, gauge, 63, work.needle(), roll=np.pi),),
        ends=("joint", "open"),
        nodes=(f"P-{number // 10}", node),
        arms=(0.0, TEE_CENTER_TO_END[header_dn]),
        flow="forward",
        reason="check valve behind a pump",
    )
    work.site.lay(run, work.style, [base], [header.device(node)])


def _name(site: Site, style: ModelingStyle, number: int, base: int, one: Pump, y: float) -> None:
    """A name plate on the side of a baseplate that looks to -y; none where the pump is one mesh with its baseplate."""
    index = next((i for i, c in enumerate(one.assembly.components) if c.name == "pump base"), None)
    if index is None:
        return
    bed = one.assembly.components[index].vertices
    low, high = bed.min(axis=0), bed.max(axis=0)
    place = at(float(low[0] + high[0]) / 2, y + float(low[1]), float(low[2] + high[2]) / 2) @ spun("x", np.pi / 2)
    text = NamePlate(text=f"PUMP P-{number}|Q 42 H 38|5.5 KW 2900", letter=0.007, rivets=4)
    site.add(text.as_assembly(style).placed(place), base + index)
