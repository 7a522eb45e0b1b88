"""The preset ``skid``: three serpentine lines with valves and gauges on a wheeled frame (structure S1 of the paper)."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from cadgraph.environment.fastener import SUPPORT_REACH
from cadgraph.environment.flange import GASKET, flange_length
from cadgraph.environment.frame import at
from cadgraph.environment.gauge import pressure_gauge
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.instrument import valve_at
from cadgraph.environment.layout import Inline, Run, Tap
from cadgraph.environment.make import Make, draw_make, painted
from cadgraph.environment.plant import Assembly, Device, Plant
from cadgraph.environment.route import Route
from cadgraph.environment.site import Placed, Site
from cadgraph.environment.standard import PIPES
from cadgraph.environment.structure import CASTER_HEIGHT, CHANNEL_WIDTH, DECK_HEIGHT, DECK_INSET, caster, deck, post
from cadgraph.environment.valve import valve_length

__all__ = ["make_skid"]

_LENGTH, _WIDTH = 2.10, 0.86  # m, of the plate
_POST_X, _POST_Y, _POST = 0.68, 0.25, 0.05  # m, where the posts stand, and their side

_TOP = CASTER_HEIGHT + DECK_HEIGHT  # m, the plate's top over the ground
_LEVELS = (0.30, 0.70, 1.10)  # m, of the lines over the plate
_REACH = 1.00  # m, from the middle to the axis of the bends at the right
_LEFT = -1.16  # m, where the lines end or turn at the left


def make_skid(seed: int = 0, hand: Hand | None = None) -> Plant:
    """Builds a wheeled skid: three lines, 12 valves, 12 gauges; stands on z = 0, long side along x.

    Args:
        seed: chooses sizes, places of devices, spokes, levers and needles.
        hand: how it is modelled; plant-design CAD by default.

    Returns:
        The plant with its truth; one cluster.
    """
    style = hand or HANDS["plant-design"]
    rng = np.random.default_rng([seed, 1])
    style, make = painted(style, rng, seed), draw_make(rng) if seed else Make()
    site = Site("skid")
    posts = _frame(site, style, rng)
    for level in range(len(_LEVELS)):
        placed = site.lay(_run(level, style, make, rng), style)
        _hang(site, placed, style, posts)
    return site.plant("skid", seed, style)


def _frame(site: Site, hand: Hand, rng: np.random.Generator) -> dict[tuple[int, int], int]:
    """Deck, casters and posts; returns the index of the post at each corner (signs of x and y)."""
    plate = site.add(deck(_LENGTH, _WIDTH, hand).placed(at(0, 0, _TOP)))
    rail = _WIDTH / 2 - DECK_INSET - CHANNEL_WIDTH / 2
    posts = {}
    for sx in (-1, 1):
        for sy in (-1, 1):
            one = caster(hand, float(rng.uniform(0, 2 * np.pi))).placed(at(sx * 0.85, sy * rail, CASTER_HEIGHT))
            site.add(one, plate + (1 if sy < 0 else 2))
            upright = post(_LEVELS[-1] + 0.10, hand, _POST).placed(at(sx * _POST_X, sy * _POST_Y, _TOP))
            posts[(sx, sy)] = site.add(upright, plate) + 1
    return posts


def _row(dn: int) -> float:
    """Distance of a row's axis from the middle plane: the pipe hangs on the outer face of the posts [m]."""
    return _POST_Y + _POST / 2 + SUPPORT_REACH + PIPES[dn].radius


def _route(level: int, dn: int) -> Route:
    """Front row to the right, round the end of the frame, back row to the left, and a tail of its own."""
    y, z = _row(dn), _TOP + _LEVELS[level]
    points = [(_LEFT, -y, z), (_REACH, -y, z), (_REACH, y, z), (_LEFT, y, z)]
    if level == 0:
        # The lowest line turns in under the others before it ends.
        points = [(-0.30, 0.0, z), (_LEFT, 0.0, z), *points]
    elif level == 1:
        drop = 0.20
        points = [(_LEFT - 0.22, -y, z - drop), (_LEFT, -y, z - drop), *points]
    else:
        points = [(_LEFT, 0.02, z), *points, (_LEFT - 0.16, y, z), (_LEFT - 0.16, y, _TOP + 0.04)]
        del points[4]
    return Route(np.array(points))


def _run(level: int, hand: Hand, make: Make, rng: np.random.Generator) -> Run:
    """A line with two valves and two gauges in each of its two rows."""
    dn = (50, 40, 50)[level] if rng.random() < 0.7 else int(rng.choice([40, 50, 65]))
    route = _route(level, dn)
    tag = f"L{level + 1}"
    first_x = [
        i
        for i, p in enumerate(route.points)
        if np.allclose(p[:2], (_LEFT, -_row(dn))) and p[2] > _TOP + _LEVELS[level] - 1e-9
    ]
    front = float(route.starts[first_x[0]])
    back = front + 2 * (_REACH - _LEFT) + 2 * _row(dn)
    inline: list[Inline] = []
    taps: list[Tap] = []
    for row, (origin, sign) in enumerate(((front, 1.0), (back, -1.0))):
        items, instruments = _row_items(dn, hand, make, rng, 100 * (level + 1) + 10 * row)
        inline += [Inline(origin + sign * (x - _LEFT), build, unit) for x, build, unit in items]
        taps += [Tap(origin + sign * (x - _LEFT), build, unit) for x, build, unit in instruments]
    ends = (("open", "flange"), ("flange", "flange"), ("flange", "open"))[level]
    return Run(tag, dn, route, tuple(inline), tuple(taps), bent=level != 1, bend=2.0 if dn > 50 else 2.5, ends=ends)


_Item = tuple[float, "Callable[[Hand], Device] | None", str]
_Instrument = tuple[float, Callable[[Hand], Assembly], str]


def _row_items(
    dn: int, hand: Hand, make: Make, rng: np.random.Generator, number: int
) -> tuple[list[_Item], list[_Instrument]]:
    """The devices of one row by their place along x [m]: joint, two valves in either order; gauge at each end."""
    neck = flange_length(dn, hand) + GASKET
    kinds = ["ball", "globe"] if rng.random() < 0.5 else ["globe", "ball"]
    halves = [valve_length(kind, dn) / 2 + neck for kind in kinds]
    joint = -0.50 + float(rng.uniform(-0.01, 0.01))
    low, high = joint + neck, _POST_X - 0.06
    spare = high - low - 2 * sum(halves)
    shares = rng.dirichlet([6, 6, 6]) * spare
    first = low + shares[0] + halves[0]
    second = first + halves[0] + shares[1] + halves[1]
    items: list[_Item] = [(joint, None, "")]
    for x, kind, tag in zip((first, second), kinds, (number + 1, number + 2), strict=True):
        unit = f"V-{tag}"
        turn = float(rng.choice([0.0, np.pi])) if kind == "ball" else float(rng.uniform(0, 2 * np.pi))
        items.append((float(x), valve_at(0.0, kind, unit, dn, make=make, turn=turn).build, unit))
    instruments: list[_Instrument] = []
    for x, tag in ((-0.82, number + 1), (0.775, number + 2)):
        unit = f"G-{tag}"
        size = 63
        build = partial(
            _gauge, unit=unit, size=size, turn=0.0 if number % 100 < 10 else np.pi, needle=float(rng.uniform(0.6, 2.6))
        )
        instruments.append((x + float(rng.uniform(-0.02, 0.01)), build, unit))
    return items, instruments


def _gauge(hand: Hand, unit: str, size: int, turn: float, needle: float) -> Assembly:
    return pressure_gauge(unit, hand, size, turn=turn, needle=needle)


def _hang(site: Site, placed: Placed, hand: Hand, posts: dict[tuple[int, int], int]) -> None:
    """Holds a line by a U-bolt on a bracket where a row passes a post."""
    route, dn = placed.laid.run.route, placed.laid.run.dn
    for leg in range(len(route.points) - 1):
        p, direction = route.points[leg], route.directions[leg]
        if abs(direction[0]) < 0.999 or abs(abs(p[1]) - _row(dn)) > 1e-6:
            continue
        side = 1 if p[1] > 0 else -1
        for sx in (-1, 1):
            s = float(route.starts[leg] + (sx * _POST_X - p[0]) * direction[0])
            if route.starts[leg] < s < route.starts[leg + 1]:
                # The post stands towards the middle plane: to the run's left where it goes to +x in front.
                left = -side * direction[0] > 0
                site.support(placed, s, posts[(sx, side)], hand, np.pi / 2 if left else -np.pi / 2)
