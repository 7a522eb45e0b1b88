"""The preset ``gallery``: lines overhead, of which some are reached from platforms with stairs or a ladder, one not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import Ladder, Platform, PlatformWithStairs, Post
from cadplants.lines.choice import Choice
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run, Tap
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES
from cadplants.parts.brand import Brand, draw_brand, dressed
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.presets.site import Site
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_gallery"]

_USUAL = {"fasteners": "none", "valve": "few", "gauge": "few", "gaskets": False}
_KINDS = ("ball", "globe", "gate")
_PITCH = 6.0  # m from line to line
_BESIDE = 0.30  # m from the axis of a line to the platform beside it


@dataclass(frozen=True)
class _Plan:
    """The proportions of a gallery [m].

    Args:
        dn: nominal size of its lines.
        half: half the length of the lines overhead.
        floor: height of the platforms.
        above: of the lines over the platforms.
        width: of the platforms.
        low: height of the valves in the risers, and of the gauges there.
    """

    dn: int = 65
    half: float = 2.4
    floor: float = 2.2
    above: float = 1.0
    width: float = 1.2
    low: tuple[float, float] = (1.0, 1.6)


def _draw(rng: np.random.Generator) -> _Plan:
    return _Plan(
        dn=int(rng.choice([50, 65, 80])),
        half=float(rng.uniform(2.2, 2.8)),
        floor=float(rng.uniform(2.1, 2.6)),
        above=float(rng.uniform(0.8, 1.1)),
        width=float(rng.uniform(1.1, 1.5)),
        low=(float(rng.uniform(0.9, 1.1)), float(rng.uniform(1.5, 1.6))),
    )


def make_gallery(seed: int = 0, style: ModelingStyle | None = None) -> Plant:
    """Builds three lines that rise from the floor and run overhead; stands on z = 0.

    What is tagged ``...-A`` is reached over stairs, ``...-B`` over a ladder, ``...-C`` from nowhere; tags that end in
    ``1`` are in the risers and are reached from the floor.

    Args:
        seed: chooses proportions, sizes, kinds of valves.
        style: how it is modelled; plant-design CAD by default.
    """
    rng = np.random.default_rng([seed, 11])
    style = dressed(style, rng, seed, _USUAL)
    make = draw_brand(rng)
    plan = _draw(rng) if seed else _Plan()
    choice = Choice(make if seed else Brand(), "none")
    site = Site()
    for number, name in enumerate("ABC"):
        y = (number - 1) * _PITCH
        site.cluster = f"line-{name}"
        _line(site, style, plan, name, y, choice, rng)
        middle = y - PIPES[plan.dn].radius - _BESIDE - plan.width / 2
        site.cluster = f"platform-{name}"
        long = 2 * plan.half - 1.2
        if name == "A":
            steps = PlatformWithStairs(length=long, width=plan.width, floor=plan.floor, opening=0.5 * long - 0.8)
            site.add(steps.as_assembly(style).placed(at(0, middle)))
        elif name == "B":
            floor = Platform(length=long, width=plan.width, floor=plan.floor, opened=True, opening=0.0)
            site.add(floor.as_assembly(style).placed(at(0, middle)))
            site.cluster = "ladder"
            rungs = Ladder(floor=plan.floor).as_assembly(style)
            site.add(rungs.placed(at(0, middle - plan.width / 2 - 0.12)))
    return site.plant("gallery", seed, style)


def _line(
    site: Site, style: ModelingStyle, plan: _Plan, name: str, y: float, choice: Choice, rng: np.random.Generator
) -> None:
    """A line up from the floor, overhead and down again: valves and gauges in its risers and overhead."""
    high, half, foot = plan.floor + plan.above, plan.half, 0.25
    route = Route(np.array([(-half, y, foot), (-half, y, high), (half, y, high), (half, y, foot)]))
    over = float(route.starts[1])
    kinds = [str(rng.choice(_KINDS)) for _ in range(2)]
    inline: tuple[Inline, ...] = (
        choice.valve(plan.low[0] - foot, kinds[0], f"V-{name}1", plan.dn, np.pi / 2),
        choice.valve(over + half - 0.5, kinds[1], f"V-{name}2", plan.dn),
    )
    taps: tuple[Tap, ...] = (
        choice.side_gauge(plan.low[1] - foot, f"G-{name}1", 63, float(rng.uniform(0.6, 2.6)), False, np.pi / 2),
        choice.gauge(over + half + 0.6, f"G-{name}2", 100, float(rng.uniform(0.6, 2.6)), 0.0),
    )
    placed = site.lay(Run(f"L-{name}", plan.dn, route, inline, taps, ends=("blind", "blind")), style)
    height = high - PIPES[plan.dn].radius - SUPPORT_REACH
    for x in (-half + 0.45, half - 0.45):
        upright = Post(height=height, side=0.06, capped=True).as_assembly(style)
        stand = site.add(upright.placed(at(x, y, 0)))
        site.support(placed, float(over + half + x), stand + 2, style)
