"""The preset ``field``: all other presets in a fenced yard, with a platform, cabinets and lamps."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.environment.access import platform, stairs
from cadgraph.environment.electrical import cabinet, lamp, sign
from cadgraph.environment.enclosure import fence, pillar
from cadgraph.environment.frame import at, spun
from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.plant import Assembly, Component, Plant, gather
from cadgraph.environment.pumps import make_pumps
from cadgraph.environment.rack import make_rack
from cadgraph.environment.riser import make_riser
from cadgraph.environment.skid import make_skid
from cadgraph.environment.solid import box
from cadgraph.environment.tank import make_tank
from cadgraph.scene import Floats

__all__ = ["make_field"]

_Make = Callable[[int, Hand | None], Plant]

# Where the structures stand: maker, name, place [m], quarter turns.
_PLACES: tuple[tuple[_Make, str, tuple[float, float], int], ...] = (
    (make_rack, "A", (-8.0, 6.2), 0),
    (make_pumps, "B", (-8.2, 0.0), 0),
    (make_pumps, "C", (-3.4, 0.0), 0),
    (make_tank, "D", (9.0, 2.6), 0),
    (make_tank, "E", (9.0, -5.0), 0),
    (make_skid, "F", (-7.8, -6.2), 0),
    (make_skid, "G", (-3.6, -6.2), 0),
    (make_skid, "H", (0.4, -6.2), 0),
    (make_riser, "I", (1.6, -3.0), 1),
    (make_riser, "J", (3.2, -6.4), 0),
    (make_riser, "K", (-0.6, -3.0), 1),
)
_HALF = (12.0, 9.0)  # m, half of the yard
_PANEL = 3.60  # m


def make_field(seed: int = 0, hand: Hand | None = None) -> Plant:
    """Builds a yard of 24 by 18 m; every structure in it is a cluster, as is every panel of the fence.

    Args:
        seed: of everything that varies.
        hand: how it is modelled; by default plant-design and mechanical CAD take turns.
    """
    rng = np.random.default_rng([seed, 6])
    parts: list[Assembly] = []
    used: list[Hand] = []
    for k, (build, name, (x, y), turns) in enumerate(_PLACES):
        style = hand or HANDS[("plant-design", "mechanical")[int(rng.random() < 0.75)]]
        used.append(style)
        one = build(1000 * seed + k, style).prefixed(name)
        pose = at(x + float(rng.uniform(-0.1, 0.1)), y + float(rng.uniform(-0.1, 0.1)), 0) @ spun(
            "z", turns * np.pi / 2
        )
        parts.append(one.placed(pose))
    style = hand or HANDS["plant-design"]
    parts.append(_platform(style))
    for k, (x, y) in enumerate(((11.2, -0.6), (11.2, 0.4), (-11.3, 3.4))):
        parts.append(cabinet(style).placed(at(x, y, 0) @ spun("z", -np.pi / 2)).marked(cluster=f"cabinet-{k}"))
    for k, (x, y) in enumerate(((-10.8, 7.8), (10.8, 7.8), (-10.8, -7.8), (6.4, -7.9))):
        parts.append(lamp(style).placed(at(x, y, 0)).marked(cluster=f"lamp-{k}"))
    parts.append(sign(style).placed(at(-1.2, -8.2, 0)).marked(cluster="sign"))
    parts += _yard(style)
    whole = gather(parts)
    standing = [i for i, c in enumerate(whole.components) if abs(float(c.vertices[:, 2].min())) < 1e-9]
    slab = Component(
        box((2 * _HALF[0] + 6, 2 * _HALF[1] + 6, 0.2), (0, 0, -0.1)),
        "Structural element",
        "ground",
        style.color("ground"),
        cluster="",
    )
    count = len(whole.components)
    whole = gather([whole, Assembly((slab,))], [(i, count) for i in standing])
    hands = tuple(dict.fromkeys([*used, style]))
    return Plant(
        whole.components,
        whole.contacts,
        whole.units,
        whole.points,
        whole.connections,
        whole.lines,
        name="field",
        seed=seed,
        hands=tuple(one.name for one in hands),
        looseness=max(one.looseness for one in hands),
    )


def _platform(hand: Hand) -> Assembly:
    """A platform with stairs up its side."""
    length, width, height, gap = 4.0, 1.6, 2.1, 0.9
    floor = platform(length, width, height, hand, gap)
    steps = stairs(height, hand)
    up = steps.placed(at(gap, -width / 2, 0) @ spun("z", np.pi / 2))
    front = next(i for i, c in enumerate(floor.components) if c.name == "beam")
    gratings = [i for i, c in enumerate(floor.components) if c.name == "grating"]
    n = len(floor.components)
    joints = []
    for stringer in (0, 1):
        low, high = _span(up.components[stringer].vertices)
        joints.append((front, n + stringer))
        for i in gratings:
            g_low, g_high = _span(floor.components[i].vertices)
            if high >= g_low - 1e-9 and low <= g_high + 1e-9:
                joints.append((i, n + stringer))
    return gather([floor, up], joints).placed(at(4.2, 0.0, 0)).marked(cluster="platform")


def _span(vertices: Floats) -> tuple[float, float]:
    return float(vertices[:, 0].min()), float(vertices[:, 0].max())


def _yard(hand: Hand) -> list[Assembly]:
    """Panels round the yard, a gate in its front, and pillars at its corners; all apart from each other."""
    parts = []
    for axis, turn in ((0, 0.0), (1, np.pi / 2)):
        along, across = _HALF[axis], _HALF[1 - axis]
        clear = along - 0.45
        count = int(2 * clear / (_PANEL + 0.05))
        pitch = 2 * clear / count
        for side in (-1, 1):
            for k in range(count):
                where = -clear + (k + 0.5) * pitch
                gate = axis == 0 and side < 0 and k == count // 2
                panel = fence(pitch - 0.05, hand, gate=gate)
                place = (where, side * across) if axis == 0 else (side * across, where)
                parts.append(panel.placed(at(*place) @ spun("z", turn)).marked(cluster=f"fence-{axis}-{side}-{k}"))
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts.append(pillar(hand).placed(at(sx * _HALF[0], sy * _HALF[1])).marked(cluster=f"pillar-{sx}-{sy}"))
    return parts
