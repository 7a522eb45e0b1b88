"""The preset ``riser``: a vertical serpentine on a wheeled plate (structure S2 of the paper)."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.environment.frame import at
from cadgraph.environment.gauge import side_gauge
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.layout import Inline, Run, Tap
from cadgraph.environment.make import Make, draw_make, painted
from cadgraph.environment.plant import Assembly, Device, Plant
from cadgraph.environment.route import Route
from cadgraph.environment.site import Site
from cadgraph.environment.structure import CASTER_HEIGHT, CHANNEL_WIDTH, DECK_HEIGHT, DECK_INSET, caster, deck
from cadgraph.environment.valve import VALVES

__all__ = ["make_riser"]

_LENGTH, _WIDTH = 1.20, 0.90  # m, of the plate
_TOP = CASTER_HEIGHT + DECK_HEIGHT
_ROWS = (-0.36, 0.0, 0.36)  # m, x of the three loops
_HALF = 0.28  # m, half the distance of a loop's legs
_CROWN = 2.05  # m, of the loops' axes over the plate


def make_riser(seed: int = 0, hand: Hand | None = None) -> Plant:
    """Builds three upright loops on a wheeled plate: 6 valves, 6 gauges; stands on z = 0.

    Args:
        seed: chooses sizes, heights, sides of levers and wheels.
        hand: how it is modelled; plant-design CAD by default.
    """
    style = hand or HANDS["plant-design"]
    rng = np.random.default_rng([seed, 2])
    style, make = painted(style, rng, seed), draw_make(rng) if seed else Make()
    site = Site("riser")
    plate = site.add(deck(_LENGTH, _WIDTH, style).placed(at(0, 0, _TOP)))
    rail = _WIDTH / 2 - DECK_INSET - CHANNEL_WIDTH / 2
    for sx in (-1, 1):
        for sy in (-1, 1):
            one = caster(style, float(rng.uniform(0, 2 * np.pi))).placed(at(sx * 0.44, sy * rail, CASTER_HEIGHT))
            site.add(one, plate + (1 if sy < 0 else 2))
    dn = int(rng.choice([50, 65, 80], p=[0.3, 0.4, 0.3]))
    for number, x in enumerate(_ROWS):
        site.lay(_loop(number, x, dn, make, rng), style, [plate], [plate])
    return site.plant("riser", seed, style)


def _loop(number: int, x: float, dn: int, make: Make, rng: np.random.Generator) -> Run:
    """Up at the front, over, and down at the back: a ball valve on one leg, a globe valve on the other."""
    top = _TOP + _CROWN + float(rng.uniform(-0.05, 0.05))
    points = [(x, -_HALF, _TOP), (x, -_HALF, top), (x, _HALF, top), (x, _HALF, _TOP)]
    route = Route(np.array(points))
    rise = top - _TOP
    length = route.length
    tag = 10 * (number + 1)
    kinds = ["ball", "globe"] if rng.random() < 0.5 else ["globe", "ball"]
    inline, taps = [], []
    for leg, kind in enumerate(kinds):
        height = float(rng.uniform(1.10, 1.24))
        joint = rise - 0.34
        unit = f"V-{tag + leg + 1}"
        # Stems look outward: towards -y on the front legs, where the run goes up, +y on the back ones.
        outward = np.pi / 2
        valve = partial(_valve, kind=kind, unit=unit, dn=dn, make=make)
        s = height if leg == 0 else length - height
        inline.append(Inline(s, valve, unit, outward))
        inline.append(Inline(joint if leg == 0 else length - joint))
        gauge = f"G-{tag + leg + 1}"
        s = 0.62 + float(rng.uniform(-0.05, 0.05))
        build = partial(_gauge, unit=gauge, down=leg == 1, needle=float(rng.uniform(0.6, 2.6)))
        taps.append(Tap(s if leg == 0 else length - s, build, gauge, outward))
    return Run(f"R{number + 1}", dn, route, tuple(inline), tuple(taps), bent=True, bend=1.5, ends=("plate", "plate"))


def _valve(hand: Hand, kind: str, unit: str, dn: int, make: Make) -> Device:
    return VALVES[kind](unit, dn, hand, **make.options(kind))


def _gauge(hand: Hand, unit: str, down: bool, needle: float) -> Assembly:
    gauge = side_gauge(unit, hand, needle=needle, turn=np.pi / 2 if not down else -np.pi / 2)
    if not down:
        return gauge
    # On a leg that runs down, up is against the run.
    return gauge.placed(np.diag([-1.0, -1.0, 1.0, 1.0]))
