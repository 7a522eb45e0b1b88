"""The preset ``pumps``: parallel centrifugal pumps between a suction and a discharge header."""

from __future__ import annotations

import numpy as np

from cadgraph.environment.fastener import SUPPORT_REACH
from cadgraph.environment.frame import at
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.instrument import gauge_tap, side_gauge_tap, strainer_at, tee_at, valve_at
from cadgraph.environment.layout import Inline, Run
from cadgraph.environment.make import Make, draw_make, painted
from cadgraph.environment.plant import Plant
from cadgraph.environment.pump import pump
from cadgraph.environment.route import Route
from cadgraph.environment.site import Placed, Site
from cadgraph.environment.standard import PIPES, TEE_CENTER_TO_END
from cadgraph.environment.structure import post

__all__ = ["make_pumps"]

_PITCH = 1.10  # m, from pump to pump
_SUCTION_X = -1.75  # m
_DISCHARGE_Z = 2.15  # m


def make_pumps(seed: int = 0, hand: Hand | None = None, n_pumps: int = 0) -> Plant:
    """Builds two to four pumps with check, gate and globe valves between two headers; stands on z = 0.

    Args:
        seed: chooses sizes, how many pumps, valves.
        hand: how it is modelled; plant-design CAD by default.
        n_pumps: how many; chosen by the seed where 0.
    """
    style = hand or HANDS["plant-design"]
    rng = np.random.default_rng([seed, 4])
    style, make = painted(style, rng, seed), draw_make(rng) if seed else Make()
    site = Site("pumps")
    count = n_pumps or int(rng.integers(2, 5))
    suction_dn, pump_in, pump_out, discharge_dn = ((100, 80, 50, 80), (150, 100, 65, 100), (80, 50, 32, 65))[
        int(rng.integers(3))
    ]
    ys = [(k - (count - 1) / 2) * _PITCH for k in range(count)]
    pumps = [pump(f"P-{k + 1}", pump_in, pump_out, style) for k in range(count)]
    axis = float(pumps[0].suction[2, 3])
    suction = _header(site, style, rng, make, "S", suction_dn, pump_in, ys, (_SUCTION_X, axis), np.pi / 2, count)
    discharge = _header(site, style, rng, make, "D", discharge_dn, pump_out, ys, (0.0, _DISCHARGE_Z), np.pi, count)
    for k, (y, one) in enumerate(zip(ys, pumps, strict=True)):
        base = site.add(one.assembly.placed(at(0, y, 0)))
        number = 10 * (k + 1)
        _suction(
            site, style, rng, make, suction, number, base, y, (float(one.suction[0, 3]), axis), (suction_dn, pump_in)
        )
        face = (float(one.discharge[0, 3]), float(one.discharge[2, 3]))
        _discharge(site, style, rng, make, discharge, number, base, y, face, (discharge_dn, pump_out))
    return site.plant("pumps", seed, style)


def _header(
    site: Site,
    hand: Hand,
    rng: np.random.Generator,
    make: Make,
    tag: str,
    dn: int,
    branch: int,
    ys: list[float],
    place: tuple[float, float],
    roll: float,
    count: int,
) -> Placed:
    """A header along y at x, z with a tee for each pump, a valve before its open end and a lid on the other."""
    x, z = place
    low, high = ys[0] - 0.62, ys[-1] + 1.55
    # The suction header is fed at its far end, which the discharge header leaves by: both runs start at the lid.
    route = Route(np.array([(x, low, z), (x, high, z)]))
    tees = [tee_at(y - low, f"J-{tag}{k + 1}", dn, branch, roll) for k, y in enumerate(ys)]
    kind = "butterfly" if rng.random() < 0.6 else "gate"
    unit = f"V-{tag}"
    valve = valve_at(high - low - 0.50, kind, unit, dn, make=make)
    tap = gauge_tap(high - low - 0.86, f"G-{tag}", rng, 100, np.pi / 2)
    flow, reason = ("backward", "feeds the pumps") if tag == "S" else ("forward", "leaves the pumps")
    run = Run(tag, dn, route, (*tees, valve), (tap,), ends=("blind", "flange"), flow=flow, reason=reason)
    placed = site.lay(run, hand)
    height = z - PIPES[dn].radius - SUPPORT_REACH
    side = 0.05 if height < 1 else 0.08
    for k in range(count + 1):
        y = ys[0] - 0.36 if k == 0 else ys[k - 1] + 0.5 * _PITCH - 0.12 * (k == count)
        stand = site.add(post(height, hand, side, capped=True).placed(at(x, y, 0)))
        site.support(placed, y - low, stand + 2, hand)
    return placed


def _suction(
    site: Site,
    hand: Hand,
    rng: np.random.Generator,
    make: Make,
    header: Placed,
    number: int,
    base: int,
    y: float,
    face: tuple[float, float],
    sizes: tuple[int, int],
) -> None:
    """From the header's tee to the pump."""
    x, z = face
    start = _SUCTION_X + TEE_CENTER_TO_END[sizes[0]]
    route = Route(np.array([(start, y, z), (x, y, z)]))
    node = f"J-S{number // 10}"
    unit, gauge = f"V-{number + 1}", f"G-{number + 1}"
    kind = "gate" if rng.random() < 0.6 else "ball"
    strained = bool(rng.random() < 0.5)
    middle = (0.21 if strained else 0.40) * route.length
    inline = [valve_at(middle, kind, unit, sizes[1], make=make)]
    if strained:
        inline.append(strainer_at(0.585 * route.length, sizes[1]))
    run = Run(
        f"S{number // 10}",
        sizes[1],
        route,
        tuple(inline),
        (gauge_tap((0.85 if strained else 0.80) * route.length, gauge, rng),),
        ends=("open", "joint"),
        nodes=(node, f"P-{number // 10}"),
        arms=(TEE_CENTER_TO_END[sizes[0]], 0.0),
        flow="forward",
        reason="into the suction of a pump",
    )
    site.lay(run, hand, [header.device(node)], [base])


def _discharge(
    site: Site,
    hand: Hand,
    rng: np.random.Generator,
    make: Make,
    header: Placed,
    number: int,
    base: int,
    y: float,
    face: tuple[float, float],
    sizes: tuple[int, int],
) -> None:
    """From the pump up through a check valve and a block valve to the header's tee."""
    x, z = face
    dn = sizes[1]
    end = _DISCHARGE_Z - TEE_CENTER_TO_END[sizes[0]]
    route = Route(np.array([(x, y, z), (x, y, end)]))
    node = f"J-D{number // 10}"
    check, block, gauge = f"V-{number + 2}", f"V-{number + 3}", f"G-{number + 2}"
    kind = str(rng.choice(["gate", "globe"]))
    space = route.length
    inline: tuple[Inline, ...] = (
        valve_at(0.40 * space, "check", check, dn, make=make),
        valve_at(0.77 * space, kind, block, dn, make=make),
    )
    run = Run(
        f"D{number // 10}",
        dn,
        route,
        inline,
        (side_gauge_tap(0.125 * space, gauge, rng, roll=np.pi),),
        ends=("joint", "open"),
        nodes=(f"P-{number // 10}", node),
        arms=(0.0, TEE_CENTER_TO_END[sizes[0]]),
        flow="forward",
        reason="check valve behind a pump",
    )
    site.lay(run, hand, [base], [header.device(node)])
