"""The preset ``loop``: two pumps in parallel in a closed loop, with drain and vent, and a line that only passes by."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import EndSuction, Post
from cadplants.lines.choice import Choice
from cadplants.lines.instrument import eccentric_at, reducer_at, tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Run
from cadplants.model.plant import Assembly, Component, Plant
from cadplants.model.standards import PIPES, REDUCER_LENGTH, TEE_CENTER_TO_END
from cadplants.parts.brand import Brand, draw_brand, dressed
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.parts.pump import Pump
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.mesh_ops import Solid, box
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_loop"]

_USUAL = {"fasteners": "set", "valve": "few", "gauge": "few"}
_PASSING = 0.012
"""Between the skins of two lines that have nothing to do with each other [m]: more than the contact distance of 10 mm
(paper, section III-B), less than any joint is wide."""


@dataclass(frozen=True)
class _Sizes:
    """Nominal sizes of one loop.

    Args:
        supply: of the header above the pumps and of the line that it feeds.
        back: of the header in front of them.
        suction: before a pump.
        inlet: of a pump.
        outlet: of a pump.
        discharge: behind a pump.
        consumer: of the ways from supply to return.
    """

    supply: int = 80
    back: int = 100
    suction: int = 80
    inlet: int = 50
    outlet: int = 32
    discharge: int = 65
    consumer: int = 50


_SIZES = (_Sizes(), _Sizes(65, 80, 65, 40, 25, 50, 40), _Sizes(100, 125, 100, 65, 40, 80, 65))
_DRAIN, _VENT, _STRANGER = 25, 20, 50  # nominal sizes


@dataclass(frozen=True)
class _Plan:
    """The proportions of one loop [m].

    Args:
        sizes: nominal.
        pitch: from pump to pump, along y.
        back_x: where the return lies; negative.
        supply_z: height of the supply.
        reach: from the second pump to where the supply turns back.
        consumers: how many ways lead from supply to return besides its end.
    """

    sizes: _Sizes = _SIZES[0]
    pitch: float = 1.25
    back_x: float = -2.25
    supply_z: float = 2.35
    reach: float = 4.0
    consumers: int = 2

    @property
    def pumps(self) -> tuple[float, float]:
        """Where the pumps stand along y."""
        return -self.pitch / 2, self.pitch / 2

    @property
    def start(self) -> float:
        """Where both headers have their lids along y."""
        return self.pumps[0] - 0.75

    @property
    def turn(self) -> float:
        """Where the supply turns back, along y."""
        return self.pumps[1] + self.reach

    def consumer(self, k: int) -> float:
        """Where a way from supply to return lies along y."""
        return self.pumps[1] + 1.75 + 0.75 * k


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random."""
    consumers = int(rng.integers(1, 4))
    return _Plan(
        sizes=_SIZES[int(rng.integers(3))],
        pitch=float(rng.uniform(1.15, 1.5)),
        back_x=-float(rng.uniform(2.2, 2.6)),
        supply_z=float(rng.uniform(2.3, 2.7)),
        reach=float(rng.uniform(3.2, 3.6)) + 0.75 * (consumers - 1),
        consumers=consumers,
    )


@dataclass(frozen=True)
class _Work(Work[_Plan]):
    """What every piece of the loop is built with.

    Args:
        back_z: height of the return's axis [m].
    """

    back_z: float


def make_loop(seed: int = 0, style: ModelingStyle | None = None) -> Plant:
    """Builds two pumps in parallel that drive a closed loop through one to three consumers' ways; stands on z = 0.

    Return header, gate valves, eccentric reducers, pumps, reducers, check and gate valves, supply header, ways with
    globe valves from supply to return; a drain at the return's lid, a vent on the supply. A line of its own passes
    12 mm beside the supply, a duct lies against the ways.

    Args:
        seed: chooses proportions, sizes, how many ways, paint, looks of the devices.
        style: how it is modelled; plant-design CAD by default.
    """
    rng = np.random.default_rng([seed, 15])
    style = dressed(style, rng, seed, _USUAL)
    choice = Choice(draw_brand(rng) if seed else Brand(), "few")
    plan = _draw(rng) if seed else _Plan()
    sizes = plan.sizes
    pumps = [EndSuction(dn=sizes.inlet, out=sizes.outlet).pump(f"P-{k + 1}", style) for k in range(2)]
    rise = PIPES[sizes.suction].radius - PIPES[sizes.inlet].radius
    work = _Work(Site("loop"), style, choice, plan, rng, float(pumps[0].suction[2, 3]) - rise)
    line = _line(work)
    for k, (y, one) in enumerate(zip(plan.pumps, pumps, strict=True)):
        base = work.site.add(one.assembly.placed(at(0, y, 0)))
        _suction(work, k + 1, line, base, one)
        _discharge(work, k + 1, line, base, one)
    ways = [_consumer(work, k, line) for k in range(plan.consumers)]
    _drain(work, line)
    _vent(work, line)
    _duct(work, ways)
    _passing(work, line)
    return work.site.plant("loop", seed, style)


def _line(work: _Work) -> Placed:
    """Supply and return as one run: from the lid over the pumps there and back to the lid before them."""
    plan, sizes, z = work.plan, work.plan.sizes, work.plan.supply_z
    first, far, back, low = plan.start, plan.turn, plan.back_x, work.back_z
    route = Route(np.array([(0, first, z), (0, far, z), (back, far, z), (back, far, low), (back, first, low)]))
    turned = float(route.starts[3])

    def there(y: float) -> float:
        return y - first

    def again(y: float) -> float:
        return turned + far - y

    fall = float(route.starts[2])
    inline = [
        *(tee_at(there(y), f"J-D{k + 1}", sizes.supply, sizes.discharge, np.pi) for k, y in enumerate(plan.pumps)),
        work.choice.valve(there(plan.pumps[1] + 0.70), "gate", "V-H", sizes.supply),
        *(
            tee_at(there(plan.consumer(k)), f"J-A{k + 1}", sizes.supply, sizes.consumer, -np.pi / 2)
            for k in range(plan.consumers)
        ),
        tee_at(there(far) - 0.75, "J-V", sizes.supply, _VENT),
        work.choice.valve(fall + 0.45 * (z - low), "globe", "V-B", sizes.supply),
        reducer_at(fall + 0.75 * (z - low), sizes.supply, sizes.back),
        *(
            tee_at(again(plan.consumer(k)), f"J-B{k + 1}", sizes.back, sizes.consumer)
            for k in reversed(range(plan.consumers))
        ),
        *(
            tee_at(again(plan.pumps[k]), f"J-S{k + 1}", sizes.back, sizes.suction, -np.pi / 2)
            for k in reversed(range(2))
        ),
        tee_at(again(first + 0.38), "J-W", sizes.back, _DRAIN, np.pi / 2),
    ]
    taps = (
        work.choice.gauge(there(plan.pumps[1] + 1.20), "G-H", 100, work.needle(), np.pi / 2),
        work.choice.relief_valve(there(plan.pumps[1] + 0.30), "V-R", int(work.rng.integers(1000))),
        work.choice.gauge(again(plan.pumps[1] + 0.80), "G-B", 100, work.needle()),
    )
    ends, reason = ("blind", "blind"), "driven by the pumps"
    run = Run("H", sizes.supply, route, tuple(inline), taps, ends=ends, flow="forward", reason=reason)
    placed = work.site.lay(run, work.style)
    for y in (0.0, plan.pumps[1] + 1.45):
        work.site.stand(placed, there(y), work.style, 0.08)
    for y in (0.0, plan.pumps[1] + 0.45, plan.consumer(plan.consumers - 1) + 0.40):
        work.site.stand(placed, again(y), work.style)
    return placed


def _suction(work: _Work, number: int, line: Placed, base: int, one: Pump) -> None:
    """From the return's tee through a gate valve and an eccentric reducer to a pump."""
    sizes, y = work.plan.sizes, work.plan.pumps[number - 1]
    arm, z = TEE_CENTER_TO_END[sizes.back], work.back_z
    start, end = work.plan.back_x + arm, float(one.suction[0, 3])
    length, cone = end - start, REDUCER_LENGTH[sizes.suction]
    middle = length - 0.32
    rise = PIPES[sizes.suction].radius - PIPES[sizes.inlet].radius
    route = Route(np.array([(start, y, z), (end, y, z)]), (middle - cone / 2, middle + cone / 2, (0.0, 0.0, rise)))
    run = Run(
        f"S{number}",
        sizes.suction,
        route,
        (
            work.choice.valve(0.33 * length, "gate", f"V-{number}1", sizes.suction),
            eccentric_at(middle, sizes.suction, sizes.inlet),
        ),
        (work.choice.gauge(middle - 0.22, f"G-{number}1", 63, work.needle()),),
        ends=("open", "joint"),
        nodes=(f"J-S{number}", f"P-{number}"),
        arms=(arm, 0.0),
        flow="forward",
        reason="into the suction of a pump",
    )
    work.site.lay(run, work.style, [line.device(f"J-S{number}")], [base])


def _discharge(work: _Work, number: int, line: Placed, base: int, one: Pump) -> None:
    """From a pump up through a reducer, a check and a gate valve to the supply's tee."""
    sizes, y = work.plan.sizes, work.plan.pumps[number - 1]
    x, z = float(one.discharge[0, 3]), float(one.discharge[2, 3])
    arm = TEE_CENTER_TO_END[sizes.supply]
    route = Route(np.array([(x, y, z), (x, y, work.plan.supply_z - arm)]))
    run = Run(
        f"D{number}",
        sizes.outlet,
        route,
        (
            reducer_at(0.18, sizes.outlet, sizes.discharge),
            work.choice.valve(0.60 * route.length - 0.14, "check", f"V-{number}2", sizes.discharge),
            work.choice.valve(route.length - 0.28, "gate", f"V-{number}3", sizes.discharge),
        ),
        ends=("joint", "open"),
        nodes=(f"P-{number}", f"J-D{number}"),
        arms=(0.0, arm),
        flow="forward",
        reason="check valve behind a pump",
    )
    work.site.lay(run, work.style, [base], [line.device(f"J-D{number}")])


def _consumer(work: _Work, k: int, line: Placed) -> Placed:
    """A way from supply to return: through a globe valve, down, past a gauge."""
    plan, dn = work.plan, work.plan.sizes.consumer
    y, z = plan.consumer(k), plan.supply_z
    before, after = TEE_CENTER_TO_END[plan.sizes.supply], TEE_CENTER_TO_END[plan.sizes.back]
    route = Route(np.array([(-before, y, z), (plan.back_x, y, z), (plan.back_x, y, work.back_z + after)]))
    down = float(route.starts[1])
    run = Run(
        f"C{k + 1}",
        dn,
        route,
        (
            work.choice.valve(0.75, "globe", f"V-C{k + 1}", dn),
            work.choice.valve(down + 0.85, "ball", f"V-E{k + 1}", dn),
        ),
        (work.choice.gauge(1.35, f"G-C{k + 1}", 63, work.needle()),),
        ends=("open", "open"),
        nodes=(f"J-A{k + 1}", f"J-B{k + 1}"),
        arms=(before, after),
        flow="forward",
        reason="from supply to return of a loop",
    )
    return work.site.lay(run, work.style, [line.device(f"J-A{k + 1}")], [line.device(f"J-B{k + 1}")])


def _drain(work: _Work, line: Placed) -> None:
    """From the return's lowest end aside through a ball valve, down into the open."""
    arm, y, z = TEE_CENTER_TO_END[work.plan.sizes.back], work.plan.start + 0.38, work.back_z
    x = work.plan.back_x - arm
    route = Route(np.array([(x, y, z), (x - 0.48, y, z), (x - 0.48, y, 0.06)]))
    valve = work.choice.valve(0.20, "ball", "V-W", _DRAIN)
    run = Run("W", _DRAIN, route, (valve,), ends=("open", "open"), nodes=("J-W", ""), arms=(arm, 0.0))
    work.site.lay(run, work.style, [line.device("J-W")])


def _vent(work: _Work, line: Placed) -> None:
    """From the supply up through a ball valve to a lid."""
    arm, y = TEE_CENTER_TO_END[work.plan.sizes.supply], work.plan.turn - 0.75
    z = work.plan.supply_z + arm
    route = Route(np.array([(0.0, y, z), (0.0, y, z + 0.46)]))
    valve = work.choice.valve(0.20, "ball", "V-V", _VENT)
    run = Run("V", _VENT, route, (valve,), ends=("open", "blind"), nodes=("J-V", ""), arms=(arm, 0.0))
    work.site.lay(run, work.style, [line.device("J-V")])


def _duct(work: _Work, ways: list[Placed]) -> None:
    """A closed cable duct along y against the undersides of the ways from supply to return."""
    plan, dn = work.plan, work.plan.sizes.consumer
    radius = PIPES[dn].radius
    # It bites as deep as the flats of a coarse pipe lie behind its corners.
    top = plan.supply_z - radius * np.cos(np.pi / work.style.round(radius)) + 0.0005
    low, high = plan.consumer(0) - 0.30, plan.consumer(plan.consumers - 1) + 0.30
    x = 0.62 * plan.back_x
    solid = box((0.20, high - low, 0.06), (x, (low + high) / 2, top - 0.03))
    duct = work.site.add(_body(solid, "Electrical and safety", "cable tray", work.style.color("clamp")))
    for way in ways:
        work.site.join(duct, way.at(-TEE_CENTER_TO_END[plan.sizes.supply] - x))


def _passing(work: _Work, line: Placed) -> None:
    """A line of its own beside the far end of the supply, on one beam with it."""
    plan, z = work.plan, work.plan.supply_z
    wide, narrow = PIPES[plan.sizes.supply].radius, PIPES[_STRANGER].radius
    top = z - wide - SUPPORT_REACH
    # At one height, so that the U-bolts of both have room in between.
    y, middle = plan.turn + wide + narrow + _PASSING, plan.turn + (wide + narrow + _PASSING) / 2
    route = Route(np.array([(1.15, y, z), (plan.back_x - 0.55, y, z)]))
    valve = work.choice.valve(0.55, "ball", "V-N", _STRANGER)
    gauge = work.choice.gauge(1.40, "G-N", 63, work.needle())
    stranger = work.site.lay(Run("N", _STRANGER, route, (valve,), (gauge,), ends=("flange", "flange")), work.style)
    left, right = 0.60 * plan.back_x, 0.30
    solid = box((right - left, 0.18, 0.10), ((left + right) / 2, middle, top - 0.05))
    beam = work.site.add(_body(solid, "Structural element", "beam", work.style.color("steel")))
    for x in (left + 0.10, right - 0.10):
        upright = Post(height=top - 0.10, side=0.08, capped=True).as_assembly(work.style)
        stand = work.site.add(upright.placed(at(x, middle, 0)))
        work.site.join(stand + 2, beam)
    # Beside the supply there is no room for a bracket; past its bend there is.
    near, far = 0.22, 0.40 * plan.back_x
    packing = box((0.08, 0.07, wide - narrow), (near, y, top + (wide - narrow) / 2))
    block = work.site.add(_body(packing, "Structural element", "plate", work.style.color("steel")), beam)
    work.site.support(line, float(line.laid.run.route.starts[1]) - far, beam, work.style)
    work.site.support(stranger, 1.15 - near, block, work.style)


def _body(solid: Solid, group: str, name: str, color: tuple[float, float, float]) -> Assembly:
    return Assembly((Component(solid, group, name, color),))
