"""The preset ``riser``: a vertical serpentine on a wheeled plate (structure S2 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import Caster, Deck, NamePlate, Post
from cadplants.lines.choice import Choice, draw_choice
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run, Tap
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES
from cadplants.parts.brand import dressed
from cadplants.parts.detail import Marks
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.parts.structure import (
    CASTER_HEIGHT,
    CHANNEL_WIDTH,
    DECK_HEIGHT,
    DECK_INSET,
)
from cadplants.presets.site import Site
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_riser"]

_TOP = CASTER_HEIGHT + DECK_HEIGHT
_USUAL = {"fasteners": "none", "valve": "few", "gauge": "few", "gaskets": False}


@dataclass(frozen=True)
class _Plan:
    """The proportions of one riser [m].

    Args:
        rows: x of the loops.
        half: half the distance of a loop's legs.
        crown: of the loops' axes over the plate.
        dn: nominal size.
        chained: whether the loops are one serpentine, joined by bends over the plate, instead of loops that each
            stand on it.
        link: height of these bends' axes over the plate.
        joint: from the crown down to the joint of each leg.
        valve: height of the valves.
        gauge: height of the gauges.
        margin: from the outer legs to the ends of the plate, and to its long sides.
        turned: whether the stems look along the plate instead of outward.
    """

    rows: tuple[float, ...] = (-0.36, 0.0, 0.36)
    half: float = 0.28
    crown: float = 2.05
    dn: int = 65
    chained: bool = False
    link: float = 0.24
    joint: float = 0.34
    valve: float = 1.17
    gauge: float = 0.62
    margin: tuple[float, float] = (0.24, 0.17)
    turned: bool = False


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random: close or wide, low or high, loops or one serpentine."""
    turned = bool(rng.random() < 0.3)
    # Stems that look along the plate need room before the next loop.
    pitch = float(rng.uniform(0.55, 0.66) if turned else rng.uniform(0.34, 0.52))
    crown = float(rng.uniform(1.75, 2.45))
    valve = float(rng.uniform(0.52, 0.60)) * crown
    chained = bool(rng.random() < 0.45)
    return _Plan(
        rows=(-pitch, 0.0, pitch),
        half=float(rng.uniform(0.24, 0.44)),
        crown=crown,
        dn=int(rng.choice([50, 65, 80], p=[0.4, 0.35, 0.25])),
        chained=chained,
        valve=valve,
        gauge=max(0.52, valve - float(rng.uniform(0.42, 0.55))),
        margin=(float(rng.uniform(0.20, 0.45)), float(rng.uniform(0.15, 0.35))),
        turned=turned,
    )


def make_riser(seed: int = 0, style: ModelingStyle | None = None, marks: Marks | None = None) -> Plant:
    """Builds three upright loops on a wheeled plate: 6 valves, 6 gauges; stands on z = 0.

    Args:
        seed: chooses proportions, whether the loops are one serpentine, sizes, heights, sides of levers and wheels.
        style: how it is modelled; plant-design CAD by default.
        marks: what is modelled on the dials; by the seed by default. With all of it the plate carries a name plate.
    """
    rng = np.random.default_rng([seed, 2])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks, "none")
    plan = _draw(rng) if seed else _Plan()
    site = Site("riser")
    bed = _bed(site, style, plan, rng)
    if plan.chained:
        _chain(site, style, plan, bed, choice, rng)
    else:
        for number, x in enumerate(plan.rows):
            points = [
                (x, -plan.half, 0.0),
                (x, -plan.half, plan.crown),
                (x, plan.half, plan.crown),
                (x, plan.half, 0.0),
            ]
            lift = float(rng.uniform(-0.05, 0.05)) if seed else 0.0
            points = [(a, b, c + lift * (c > 0)) for a, b, c in points]
            run = _run(f"R{number + 1}", points, plan, number, choice, rng)
            site.lay(run, style, [bed], [bed])
    if marks == "all":
        text = NamePlate(text=f"S-2 RISER|DN{plan.dn} PN16", letter=0.010, rivets=4)
        site.add(text.as_assembly(style).placed(at(0, -plan.half - plan.margin[1] / 2, _TOP)), bed)
    return site.plant("riser", seed, style)


def _bed(site: Site, style: ModelingStyle, plan: _Plan, rng: np.random.Generator) -> int:
    """Plate and casters; returns the index of the plate."""
    length = 2 * (plan.rows[-1] + plan.margin[0])
    width = 2 * (plan.half + plan.margin[1])
    bed = site.add(Deck(length=length, width=width).as_assembly(style).placed(at(0, 0, _TOP)))
    rail = width / 2 - DECK_INSET - CHANNEL_WIDTH / 2
    for sx in (-1, 1):
        for sy in (-1, 1):
            place = at(sx * (length / 2 - 0.16), sy * rail, CASTER_HEIGHT)
            wheel = Caster(turn=float(rng.uniform(0, 2 * np.pi))).as_assembly(style)
            site.add(wheel.placed(place), bed + (1 if sy < 0 else 2))
    return bed


def _chain(site: Site, style: ModelingStyle, plan: _Plan, bed: int, choice: Choice, rng: np.random.Generator) -> None:
    """All loops as one serpentine; each bend between two of them rests on a post."""
    low, top, h = plan.link, plan.crown, plan.half
    first, second, third = plan.rows
    points = [
        (first, -h, 0.0), (first, -h, top), (first, h, top), (first, h, low),
        (second, h, low), (second, h, top), (second, -h, top), (second, -h, low),
        (third, -h, low), (third, -h, top), (third, h, top), (third, h, 0.0),
    ]  # fmt: skip
    placed = site.lay(_run("R1", points, plan, 0, choice, rng), style, [bed], [bed])
    starts = placed.laid.run.route.starts
    height = low - PIPES[plan.dn].radius - SUPPORT_REACH
    for corner, (a, b, y) in ((3, (first, second, h)), (7, (second, third, -h))):
        upright = Post(height=height, side=0.04, capped=True).as_assembly(style)
        stand = site.add(upright.placed(at((a + b) / 2, y, _TOP)), bed)
        site.support(placed, float(starts[corner] + starts[corner + 1]) / 2, stand + 2, style)


def _run(
    tag: str,
    points: list[tuple[float, float, float]],
    plan: _Plan,
    number: int,
    choice: Choice,
    rng: np.random.Generator,
) -> Run:
    """A run of upright legs: a ball valve on one leg of a loop, a globe valve on the other; gauge and joint on each."""
    route = Route(np.add(points, (0.0, 0.0, _TOP)))
    inline: list[Inline] = []
    taps: list[Tap] = []
    uprights = [k for k, way in enumerate(route.directions) if abs(way[2]) > 0.5]
    kinds: list[str] = []
    for leg, k in enumerate(uprights):
        if leg % 2 == 0:
            kinds = ["ball", "globe"] if rng.random() < 0.5 else ["globe", "ball"]
        up = route.directions[k][2] > 0
        floor = float(min(route.points[k][2], route.points[k + 1][2]) - _TOP)
        crown = float(max(route.points[k][2], route.points[k + 1][2]) - _TOP)

        def along(height: float, k: int = k, up: bool = up, floor: float = floor, crown: float = crown) -> float:
            return float(route.starts[k] + (height - floor if up else crown - height))

        # Stems look outward, or along the plate; gauges always outward. A leg's frame follows its way.
        front = route.points[k][1] < 0
        outward = np.pi / 2 if front == up else -np.pi / 2
        tag_number = 10 * (number + 1 + leg // 2) + 1 + leg % 2
        roll = outward + (np.pi / 2 if plan.turned else 0.0)
        height = plan.valve + float(rng.uniform(-0.06, 0.06))
        inline.append(choice.valve(along(height), kinds[leg % 2], f"V-{tag_number}", plan.dn, roll))
        inline.append(Inline(along(crown - plan.joint)))
        gauge = plan.gauge + float(rng.uniform(-0.04, 0.04))
        taps.append(
            choice.side_gauge(along(gauge), f"G-{tag_number}", 63, float(rng.uniform(0.6, 2.6)), not up, outward)
        )
    ends = ("plate", "plate")
    return Run(tag, plan.dn, route, tuple(inline), tuple(taps), bent=True, bend=1.5, ends=ends)
