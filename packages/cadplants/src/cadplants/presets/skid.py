"""The preset ``skid``: serpentine lines with valves and gauges on a wheeled frame (structure S1 of the paper)."""

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
from cadplants.parts.flange import GASKET, flange_length
from cadplants.parts.structure import CASTER_HEIGHT, CHANNEL_WIDTH, DECK_HEIGHT, DECK_INSET
from cadplants.parts.valve import valve_length
from cadplants.presets.site import Placed, Site
from cadplants.solids.transforms import at, looking
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_skid"]

_TOP = CASTER_HEIGHT + DECK_HEIGHT  # m, the plate's top over the ground
_USUAL = {"fasteners": "none", "valve": "few", "gauge": "few"}


@dataclass(frozen=True)
class _Plan:
    """The proportions of one skid [m].

    Args:
        levels: of the lines over the plate.
        sizes: nominal size of each line.
        tails: how each line ends at the left: it turns ``in``, drops by a little, or goes ``down`` to the plate.
        joints: whether there is a joint of two flanges, for each row.
        per_row: valves in a row, and gauges.
        post_x: where the posts stand.
        post_y: likewise.
        post: their side.
        width: of the plate.
        side: 1 where the bends are at the right, -1 at the left.
        bent: which lines have bent pipe instead of elbows.
    """

    levels: tuple[float, ...] = (0.30, 0.70, 1.10)
    sizes: tuple[int, ...] = (50, 40, 50)
    tails: tuple[str, ...] = ("in", "drop", "down")
    joints: tuple[bool, ...] = (True, False, False, True, False, True)
    per_row: int = 2
    post_x: float = 0.68
    post_y: float = 0.25
    post: float = 0.05
    width: float = 0.86
    side: int = 1
    bent: tuple[bool, ...] = (True, False, True)

    @property
    def reach(self) -> float:
        """From the middle to the axis of the bends."""
        return self.post_x + 0.32

    @property
    def left(self) -> float:
        """Where the lines end or turn at the left, negative."""
        return -self.post_x - 0.48

    @property
    def length(self) -> float:
        """Of the plate."""
        return 2 * self.post_x + 0.74

    def row(self, level: int) -> float:
        """Distance of a row's axis from the middle plane: the pipe hangs on the outer face of the posts."""
        return self.post_y + self.post / 2 + SUPPORT_REACH + PIPES[self.sizes[level]].radius


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random: two long levels of three valves a row, or three of two."""
    count = int(rng.choice([2, 3, 3]))
    step = float(rng.uniform(0.34, 0.46)) * (1.25 if count == 2 else 1.0)
    low = float(rng.uniform(0.24, 0.36))
    post = float(rng.choice([0.04, 0.05, 0.06]))
    middle = [str(rng.choice(["in", "drop"])) for _ in range(count - 1)]
    return _Plan(
        levels=tuple(low + k * step for k in range(count)),
        sizes=tuple(int(rng.choice([40, 50, 50, 65])) for _ in range(count)),
        tails=(*middle, str(rng.choice(["down", "down", "drop"]))),
        joints=tuple(bool(rng.random() < 0.5) for _ in range(2 * count)),
        per_row=6 // count,
        post_x=float(rng.uniform(0.66, 0.78)) if count == 3 else float(rng.uniform(1.06, 1.22)),
        post_y=float(rng.uniform(0.20, 0.32)),
        post=post,
        width=float(rng.uniform(0.86, 1.05)),
        side=int(rng.choice([-1, 1])),
        bent=tuple(bool(rng.random() < 0.6) for _ in range(count)),
    )


def make_skid(seed: int = 0, style: ModelingStyle | None = None, marks: Marks | None = None) -> Plant:
    """Builds a wheeled skid with 12 valves and 12 gauges; stands on z = 0, long side along x.

    Args:
        seed: chooses proportions, levels, sizes, the side of the bends, places of devices, spokes, levers, needles.
        style: how it is modelled; plant-design CAD by default.
        marks: what is modelled on the dials; by the seed by default. With all of it posts carry number plates.

    Returns:
        The plant with its truth; one cluster.
    """
    rng = np.random.default_rng([seed, 1])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks)
    plan = _draw(rng) if seed else _Plan()
    site = Site("skid")
    posts = _frame(site, style, plan, rng)
    for level in range(len(plan.levels)):
        placed = site.lay(_run(level, plan, style, choice, rng), style)
        _hang(site, placed, style, plan, level, posts)
    if marks == "all":
        _number(site, style, plan, posts)
    return site.plant("skid", seed, style)


def _frame(site: Site, style: ModelingStyle, plan: _Plan, rng: np.random.Generator) -> dict[tuple[int, int], int]:
    """Deck, casters and posts; returns the index of the post at each corner (signs of x and y)."""
    bed = site.add(Deck(length=plan.length, width=plan.width).as_assembly(style).placed(at(0, 0, _TOP)))
    rail = plan.width / 2 - DECK_INSET - CHANNEL_WIDTH / 2
    upright = Post(height=plan.levels[-1] + 0.10, side=plan.post, capped=False)
    posts = {}
    for sx in (-1, 1):
        for sy in (-1, 1):
            place = at(sx * (plan.length / 2 - 0.20), sy * rail, CASTER_HEIGHT)
            wheel = Caster(turn=float(rng.uniform(0, 2 * np.pi))).as_assembly(style)
            site.add(wheel.placed(place), bed + (1 if sy < 0 else 2))
            foot = at(sx * plan.post_x, sy * plan.post_y, _TOP)
            posts[(sx, sy)] = site.add(upright.as_assembly(style).placed(foot), bed) + 1
    return posts


def _route(level: int, plan: _Plan) -> tuple[Route, float]:
    """Front row, round the end of the frame, back row, and a tail; and the chainage where the front row begins."""
    y, z, left, reach = plan.row(level), _TOP + plan.levels[level], plan.left, plan.reach
    points = [(left, -y, z), (reach, -y, z), (reach, y, z), (left, y, z)]
    first = 2
    if plan.tails[level] == "in":
        # It turns in under the others before it ends.
        points = [(-0.30, 0.0, z), (left, 0.0, z), *points]
    elif plan.tails[level] == "drop":
        drop = 0.24
        points = [(left - 0.22, -y, z - drop), (left, -y, z - drop), *points]
    else:
        points = [(left, 0.02, z), *points[:3], (left - 0.16, y, z), (left - 0.16, y, _TOP + 0.04)]
        first = 1
    route = Route(np.array(points) * (plan.side, 1.0, 1.0))
    return route, float(route.starts[first])


def _run(level: int, plan: _Plan, style: ModelingStyle, choice: Choice, rng: np.random.Generator) -> Run:
    """A line with its valves and gauges in two rows."""
    dn = plan.sizes[level]
    route, front = _route(level, plan)
    back = front + 2 * (plan.reach - plan.left) + 2 * plan.row(level)
    inline: list[Inline] = []
    taps: list[Tap] = []
    for row, (origin, sign) in enumerate(((front, 1.0), (back, -1.0))):
        joint = plan.joints[2 * level + row]
        number = 100 * (level + 1) + 10 * row
        places, gauges, kinds = _places(plan, dn, style, joint, rng)
        if joint:
            inline.append(Inline(origin + sign * (places[0] - plan.left)))
        for k, (x, kind) in enumerate(zip(places[1:], kinds, strict=True)):
            turn = float(rng.choice([0.0, np.pi])) if kind == "ball" else float(rng.uniform(0, 2 * np.pi))
            unit = f"V-{number + k + 1}"
            inline.append(choice.valve(origin + sign * (x - plan.left), kind, unit, dn, turn=turn))
        # All dials look to the front, whichever way the run goes.
        turn = 0.0 if (row == 0) == (plan.side > 0) else np.pi
        for k, x in enumerate(gauges):
            s = origin + sign * (x - plan.left)
            taps.append(choice.gauge(s, f"G-{number + k + 1}", 63, float(rng.uniform(0.6, 2.6)), turn))
    ends = {"in": ("open", "flange"), "drop": ("flange", "flange"), "down": ("flange", "open")}[plan.tails[level]]
    room = min(0.115 if plan.tails[level] == "drop" else 1.0, 0.46 * plan.row(level))
    bend = min(2.0 if dn > 50 else 2.5, room / PIPES[dn].outer)
    return Run(
        f"L{level + 1}",
        dn,
        route,
        tuple(inline),
        tuple(taps),
        bent=plan.bent[level],
        bend=bend,
        ends=(ends[0], ends[1]),
    )


def _places(
    plan: _Plan, dn: int, style: ModelingStyle, joint: bool, rng: np.random.Generator
) -> tuple[list[float], list[float], list[str]]:
    """Where along x the joint and the valves of a row stand, and its gauges; and the kinds of the valves."""
    neck = flange_length(dn, style) + GASKET
    kinds = ["ball", "globe"] if rng.random() < 0.5 else ["globe", "ball"]
    if plan.per_row == 3:
        # Six of each kind in all: rows take turns with two of one kind.
        kinds = [*kinds, "ball" if rng.random() < 0.5 else "globe"]
    halves = [valve_length(kind, dn) / 2 + neck for kind in kinds]
    at_joint = -plan.post_x + 0.18 + float(rng.uniform(-0.01, 0.01))
    low = at_joint + neck if joint else -plan.post_x + 0.07
    high = plan.post_x - 0.06
    # Between the first two of three valves stands a gauge and wants pipe.
    least = 0.10 if len(kinds) == 3 else 0.0
    spare = high - low - 2 * sum(halves) - least
    shares = rng.dirichlet([6.0] * (len(kinds) + 1)) * spare
    places, x = [], low
    gauges = [-plan.post_x - 0.14 + float(rng.uniform(-0.02, 0.01))]
    for k, half in enumerate(halves):
        gap = float(shares[k]) + (least if k == 1 else 0.0)
        if least and k == 1:
            gauges.append(x + gap / 2)
        x += gap
        places.append(x + half)
        x += 2 * half
    gauges.append(plan.post_x + 0.095 + float(rng.uniform(-0.02, 0.01)))
    return [at_joint, *places], gauges, kinds


def _hang(
    site: Site, placed: Placed, style: ModelingStyle, plan: _Plan, level: int, posts: dict[tuple[int, int], int]
) -> None:
    """Holds a line by a U-bolt on a bracket where a row passes a post."""
    route = placed.laid.run.route
    for leg in range(len(route.points) - 1):
        p, direction = route.points[leg], route.directions[leg]
        if abs(direction[0]) < 0.999 or abs(abs(p[1]) - plan.row(level)) > 1e-6:
            continue
        side = 1 if p[1] > 0 else -1
        for sx in (-1, 1):
            s = float(route.starts[leg] + (sx * plan.post_x - p[0]) * direction[0])
            if route.starts[leg] < s < route.starts[leg + 1]:
                # The post stands towards the middle plane: to the run's left where it goes to +x in front.
                left = -side * direction[0] > 0
                site.support(placed, s, posts[(sx, side)], style, np.pi / 2 if left else -np.pi / 2)


def _number(site: Site, style: ModelingStyle, plan: _Plan, posts: dict[tuple[int, int], int]) -> None:
    """Number plates on the outer faces of the posts, one for each level and row."""
    for (sx, sy), index in posts.items():
        for level, height in enumerate(plan.levels):
            text = f"V-{100 * (level + 1) + 10 * (sy > 0) + (sx > 0) + 1}"
            z = _TOP + height - 0.13
            face = looking((sx * (plan.post_x + plan.post / 2), sy * plan.post_y, z), (0.0, sx, 0.0), (sx, 0.0, 0.0))
            site.add(NamePlate(text=text, letter=0.0052, rivets=2).as_assembly(style).placed(face), index)
