"""The preset ``rack``: a long pipe rack with branches that drop from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import Column, NamePlate, Tray, beam_between
from cadplants.lines.choice import draw_choice
from cadplants.lines.instrument import meter_at, tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Inline, Run
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES, SECTIONS, TEE_CENTER_TO_END
from cadplants.parts.brand import dressed
from cadplants.parts.detail import Marks
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.transforms import at, looking
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_rack"]

_COLUMN = "HEA 160"
_BEAM = "HEA 120"
_USUAL = {"fasteners": "set"}


@dataclass(frozen=True)
class _Plan:
    """The proportions of one rack [m].

    Args:
        bays: how many.
        bay: length of one.
        half: half the distance of a frame's columns.
        tops: of the lower and the upper beams.
        ys: of the lines.
        levels: 0 or 1 for each line.
        sizes: nominal size of each line.
        drops: for each line -1 or 1 where branches drop from it to that side, else 0.
        downs: which lines turn down at their far end.
        tray: y of the cable tray.
    """

    bays: int = 4
    bay: float = 3.0
    half: float = 1.10
    tops: tuple[float, float] = (2.60, 3.35)
    ys: tuple[float, ...] = (-0.78, -0.40, 0.0, 0.42, 0.80)
    levels: tuple[int, ...] = (0, 0, 1, 0, 1)
    sizes: tuple[int, ...] = (80, 150, 100, 65, 50)
    drops: tuple[int, ...] = (-1, 0, 0, 1, 0)
    downs: tuple[int, ...] = (1, 2)
    tray: float = -0.55


def _draw(rng: np.random.Generator, n_bays: int) -> _Plan:
    """Proportions at random: long or short, wide or narrow, four to six lines on two levels."""
    half = float(rng.uniform(1.05, 1.45))
    lower = float(rng.uniform(2.45, 2.85))
    count = int(rng.integers(4, 7))
    # The lines of both levels stand side by side in plan, so that none hits another's branch.
    pitch = 2 * (half - 0.30) / (count - 1)
    levels = tuple(int(k % 2) if rng.random() < 0.7 else 0 for k in range(count))
    choices = ((50, 80), (100, 150), (80, 100), (65, 80), (40, 50), (50, 65))
    drops = [0] * count
    drops[0] = -1 if levels[0] == 0 else 0
    drops[-1] = 1 if levels[-1] == 0 else 0
    if not any(drops):
        drops[0], levels = -1, (0, *levels[1:])
    room = max((b - a, (a + b) / 2) for a, b in _gaps(half, [-half + 0.30 + k * pitch for k in range(count)], levels))
    return _Plan(
        bays=n_bays or int(rng.integers(3, 6)),
        bay=float(rng.uniform(2.7, 3.5)),
        half=half,
        tops=(lower, lower + float(rng.uniform(0.65, 0.95))),
        ys=tuple(-half + 0.30 + k * pitch for k in range(count)),
        levels=levels,
        sizes=tuple(int(rng.choice(choices[k])) if pitch > 0.36 or k != 1 else 80 for k in range(count)),
        drops=tuple(drops),
        downs=tuple(k for k in range(1, count - 1) if rng.random() < 0.5)[:2],
        tray=room[1],
    )


def _gaps(half: float, ys: list[float], levels: tuple[int, ...]) -> list[tuple[float, float]]:
    """The stretches along y between the lines of the upper level, where a tray may lie."""
    edges = [-half, *(y for y, level in zip(ys, levels, strict=True) if level), half]
    return list(zip(edges[:-1], edges[1:], strict=True))


_Work = Work[_Plan]


def make_rack(seed: int = 0, style: ModelingStyle | None = None, n_bays: int = 0, marks: Marks | None = None) -> Plant:
    """Builds a rack with five lines on two levels, branches with valves, and a cable tray; stands on z = 0.

    Args:
        seed: chooses bays, proportions, lines, sizes, branches and devices.
        style: how it is modelled; plant-design CAD by default.
        n_bays: how many bays; chosen by the seed where 0.
        marks: what is modelled on the dials; by the seed by default. With all of it columns carry number plates.
    """
    rng = np.random.default_rng([seed, 5])
    style = dressed(style, rng, seed, _USUAL)
    choice = draw_choice(rng, seed, marks)
    site = Site("rack")
    plan = _draw(rng, n_bays) if seed else _Plan(bays=n_bays or 4)
    beams = [_frame(site, style, plan, k * plan.bay) for k in range(plan.bays + 1)]
    for k in range(plan.bays):
        for side, shaft in ((-1, 0), (1, 1)):
            _tie(site, style, plan, k * plan.bay, side * plan.half, beams[k][2][shaft], beams[k + 1][2][shaft])
    work = _Work(site, style, choice, plan, rng)
    for k, level in enumerate(plan.levels):
        _line(work, k, [frame[:2][level] for frame in beams])
    trough = Tray(width=0.3, length=plan.bays * plan.bay, cables=3, pieces=plan.bays).as_assembly(style)
    tray = site.add(trough.placed(at(0, plan.tray, plan.tops[1])))
    for k in range(plan.bays):
        site.join(tray + k, beams[k][1])
        site.join(tray + k, beams[k + 1][1])
    if marks == "all":
        _number(site, style, plan, beams)
    return site.plant("rack", seed, style)


def _frame(site: Site, style: ModelingStyle, plan: _Plan, x: float) -> tuple[int, int, tuple[int, int]]:
    """Two columns with a beam on each level: the beams, and the columns' shafts."""
    depth, _, web, _ = SECTIONS[_COLUMN]
    height, _, _, _ = SECTIONS[_BEAM]
    shafts = []
    low, high = plan.tops
    for y in (-plan.half, plan.half):
        upright = Column(height=high - height, section=_COLUMN).as_assembly(style)
        shafts.append(site.add(upright.placed(at(x, y, 0))) + 1)
    z = low - height / 2
    # The lower beam reaches between the columns' flanges to their webs, the upper one lies on their heads.
    inner, outer = plan.half - web / 2, plan.half + depth / 2
    lower = site.add(beam_between((x, -inner, z), (x, inner, z), _BEAM, style))
    z = high - height / 2
    upper = site.add(beam_between((x, -outer, z), (x, outer, z), _BEAM, style))
    for shaft in shafts:
        site.join(shaft, lower)
        site.join(shaft, upper)
    return lower, upper, (shafts[0], shafts[1])


def _tie(site: Site, style: ModelingStyle, plan: _Plan, x: float, y: float, near: int, far: int) -> None:
    """A beam along x between the flanges of two columns."""
    half = SECTIONS[_COLUMN][0] / 2
    z = plan.tops[1] - 0.45
    tie = site.add(beam_between((x + half, y, z), (x + plan.bay - half, y, z), "IPE 160", style))
    site.join(near, tie)
    site.join(far, tie)


def _line(work: _Work, index: int, beams: list[int]) -> None:
    """A line along the rack: over the frames, maybe down at its far end, maybe with branches that drop from it."""
    plan, rng = work.plan, work.rng
    number, dn, y, level = index + 1, plan.sizes[index], plan.ys[index], plan.levels[index]
    side, down = plan.drops[index], index in plan.downs
    z = plan.tops[level] + SUPPORT_REACH + PIPES[dn].radius
    low, high = -0.75 - 0.12 * (number % 3), plan.bays * plan.bay + 0.55 + 0.28 * number
    points = [(low, y, z), (high, y, z)]
    if down:
        points.append((high, y, 0.70))
    route = Route(np.array(points))
    tag = f"L{number}"
    inline: list[Inline] = []
    taps = []
    branches = []
    for bay in range(plan.bays):
        middle = (bay + 0.5) * plan.bay - low
        if side and rng.random() < 0.75:
            inline.append(tee_at(middle, f"J-{number}{bay + 1}", dn, min(dn, 50), np.pi))
            branches.append((bay, middle))
        elif rng.random() < 0.25:
            inline.append(meter_at(middle, f"F-{number}{bay + 1}", dn))
        elif rng.random() < 0.5:
            inline.append(Inline(middle))
        if rng.random() < 0.5 and level == 1:
            unit = f"V-{number}{bay + 1}"
            kind = str(rng.choice(["gate", "globe", "ball", "butterfly", "control"]))
            if kind == "control":
                inline.append(work.choice.control_valve(middle - 0.75, unit, dn, int(rng.integers(1000))))
            else:
                inline.append(work.choice.valve(middle - 0.75, kind, unit, dn))
            taps.append(work.choice.gauge(middle + 0.70, f"G-{number}{bay + 1}", 100, work.needle()))
    if down:
        drop = float(route.starts[1])
        inline.append(
            work.choice.valve(route.length - 0.86, "gate" if number == 2 else "globe", f"V-{number}9", dn, np.pi / 2)
        )
        taps.append(work.choice.side_gauge(drop + 0.62, f"G-{number}9", 63, work.needle(), True))
    ends = ("flange", "flange") if index < len(plan.ys) - 1 else ("blind", "flange")
    placed = work.site.lay(Run(tag, dn, route, tuple(inline), tuple(taps), ends=ends), work.style)
    for k, carrier in enumerate(beams):
        work.site.support(placed, k * plan.bay - low, carrier, work.style)
    for bay, middle in branches:
        _branch(work, placed, number, bay, middle, side)


def _branch(work: _Work, trunk: Placed, number: int, bay: int, s: float, side: int) -> None:
    """From a tee down, with a valve at hand height, and out to the side."""
    run = trunk.laid.run
    dn = min(run.dn, 50)
    x, y, z = (float(value) for value in run.route.point(s))
    top = z - TEE_CENTER_TO_END[run.dn]
    low = 0.62
    route = Route(np.array([(x, y, top), (x, y, low), (x, y + side * 0.75, low)]))
    node, unit, gauge = f"J-{number}{bay + 1}", f"V-{number}{bay + 1}", f"G-{number}{bay + 1}"
    kind = str(work.rng.choice(["ball", "ball", "globe", "gate"]))
    roll = float(work.rng.choice([0.0, np.pi]))
    actuated = bool(work.rng.random() < 0.4)
    inline = (work.choice.valve(top - 1.25, kind, unit, dn, roll, actuated=actuated),)
    taps = (work.choice.side_gauge(top - 1.75, gauge, 63, work.needle(), True, roll + np.pi / 2),)
    branch = Run(
        f"L{number}B{bay + 1}",
        dn,
        route,
        inline,
        taps,
        ends=("open", "flange"),
        nodes=(node, ""),
        arms=(TEE_CENTER_TO_END[run.dn], 0.0),
    )
    work.site.lay(branch, work.style, [trunk.device(node)])


def _number(site: Site, style: ModelingStyle, plan: _Plan, beams: list[tuple[int, int, tuple[int, int]]]) -> None:
    """A number plate on the flange of each column, at the height of the eyes."""
    depth = SECTIONS[_COLUMN][0]
    for k, (_, _, shafts) in enumerate(beams):
        for side, shaft, row in ((-1, shafts[0], "A"), (1, shafts[1], "B")):
            x = looking((k * plan.bay - depth / 2, side * plan.half, 1.6), (0, -1, 0), (-1, 0, 0))
            text = NamePlate(text=f"{row}{k + 1}|MAX 2 T", letter=0.008, rivets=4)
            site.add(text.as_assembly(style).placed(x), shaft)
