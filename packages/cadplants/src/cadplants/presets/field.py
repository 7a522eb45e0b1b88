"""The preset ``field``: the other presets in a fenced yard, with platforms, a storage tank, cabinets and lamps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from cadplants.builder.params import Apart
from cadplants.families import FAMILIES
from cadplants.families.preset_devices import (
    Cabinet,
    Fence,
    Gate,
    Lamp,
    ManwayTank,
    Opening,
    Pillar,
    Platform,
    PlatformWithStairs,
    Sign,
)
from cadplants.model.contacts import on_ground, whole
from cadplants.model.family import as_assembly
from cadplants.model.plant import Assembly, Component, Plant, gather
from cadplants.parts.vessel import Nozzle
from cadplants.presets.gauged_tank import with_level_gauge
from cadplants.presets.pumps import make_pumps
from cadplants.presets.rack import make_rack
from cadplants.presets.riser import make_riser
from cadplants.presets.skid import make_skid
from cadplants.presets.tank import make_tank
from cadplants.solids.mesh_ops import box
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import STYLES, ModelingStyle

__all__ = ["make_field"]

_Make = Callable[..., Plant]

# Where the structures stand: maker, what it is asked for, name, place [m], quarter turns, and how their bolts are
# modelled. In a yard that is mirrored left to right they are turned round.
_PLACES: tuple[tuple[_Make, dict[str, Any], str, tuple[float, float], int, str], ...] = (
    (make_rack, {"n_bays": 4}, "A", (-8.6, 5.6), 0, "none"),
    (make_pumps, {"n_pumps": 3}, "B", (-7.9, 0.0), 0, "set"),
    (make_tank, {}, "C", (7.3, -5.0), 0, "set"),
    (make_skid, {}, "D", (-7.4, -6.3), 0, "none"),
    (make_riser, {}, "E", (-3.7, -5.9), 1, "flange"),
    (make_riser, {}, "F", (-1.3, -5.9), 1, "none"),
)
_HALF = (11.2, 8.6)  # m, half of the yard
_PANEL = 3.35  # m
_BARS = 0.094  # m, least distance of the bars of the fence: no child's head fits through
_FINE: dict[str, Any] = {"fasteners": "flange", "valve": "few", "gauge": "few", "pump": "few"}


def make_field(seed: int = 0, style: ModelingStyle | None = None) -> Plant:
    """Builds a yard of 22 by 17 m; every structure in it is a cluster, as is every panel of the fence.

    Args:
        seed: of everything that varies; also which way round the yard is laid out.
        style: how it is modelled; by default plant-design and mechanical CAD take turns, with all marks and letters and
            so many parts as the paper's plant has.
    """
    rng = np.random.default_rng([seed, 6])
    flips = (1, 1) if seed == 0 else (int(rng.choice([-1, 1])), int(rng.choice([-1, 1])))
    parts: list[Assembly] = []
    used: list[ModelingStyle] = []
    for k, (build, wishes, name, (x, y), turns, bolts) in enumerate(_PLACES):
        modeller = STYLES[("plant-design", "mechanical")[int(rng.random() < 0.35)]]
        own = style or replace(modeller, **{**_FINE, "fasteners": bolts})
        used.append(own)
        one = build(1000 * seed + k + 1, own, marks="all", **wishes).prefixed(name)
        turned = turns + (2 if flips[0] < 0 else 0)
        shift = rng.uniform(-0.1, 0.1, 2)
        pose = at(flips[0] * x + float(shift[0]), flips[1] * y + float(shift[1]), 0) @ spun("z", turned * np.pi / 2)
        parts.append(one.placed(pose))
    main = style or replace(STYLES["plant-design"], **_FINE)
    parts += [part.marked(style=main.name) for part in (*_inside(main, flips, rng), *_yard(main, flips))]
    slab = Component(
        box((2 * _HALF[0] + 6, 2 * _HALF[1] + 6, 0.2), (0, 0, -0.1)),
        "Structural element",
        "ground",
        main.color("ground"),
        cluster="",
        style=main.name,
    )
    return on_ground(Plant.of(gather(parts), "field", seed, [*used, main]), slab)


def _inside(style: ModelingStyle, flips: tuple[int, int], rng: np.random.Generator) -> list[Assembly]:
    """What stands in the yard without lines: platforms, a storage tank, cabinets, lamps, a sign."""

    def placed(part: Assembly, x: float, y: float, turn: float, cluster: str) -> Assembly:
        return part.placed(at(flips[0] * x, flips[1] * y, 0) @ spun("z", turn)).marked(cluster=cluster)

    round_y = np.pi if flips[1] < 0 else 0.0
    to_side = -np.pi / 2 * flips[0]
    deck = Platform(length=2.4, width=1.2, floor=float(rng.uniform(1.0, 1.4)), opened=False, opening=0.0)
    stepped = PlatformWithStairs(length=4.0, width=1.6, floor=2.1, opening=0.9)
    found = [
        placed(stepped.as_assembly(style), 0.2, 1.1, round_y, "platform"),
        placed(deck.as_assembly(style), -3.6, 1.3, 0.0, "deck"),
        placed(_storage(style, rng).prefixed("S"), 6.0, 0.4, 0.0, "storage"),
        placed(_ladder(style, rng), 7.9, 0.6, 0.0, "ladder"),
    ]
    for k, (x, y) in enumerate(((9.9, -1.2), (9.9, 0.2))):
        text = f"PANEL LP-{k + 1}|400 V 50 HZ||DANGER|HIGH VOLTAGE||MAIN SWITCH"
        panel = Cabinet(width=0.8, depth=0.4, height=1.9, text=text).as_assembly(style)
        found.append(placed(panel, x, y, to_side, f"cabinet-{k}"))
    for k, (x, y) in enumerate(((-10.2, 3.0), (10.2, 7.4))):
        found.append(placed(Lamp(height=4.0).as_assembly(style), x, y, 0.0, f"lamp-{k}"))
    warning = Sign(text="TEST FIELD|HELMETS ON|NO SMOKING").as_assembly(style)
    found.append(placed(warning, -9.9, -4.3, 0.0, "sign"))
    return found


def _storage(style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    """A tall tank without lines, with a level gauge between two cocks on its shell."""
    radius, height = round(float(rng.uniform(0.6, 0.75)), 3), round(float(rng.uniform(2.0, 2.6)), 3)
    nozzles = [
        Nozzle(100, "top", (0.0, 0.3)),
        Nozzle(80, "top", (0.0, -0.3)),
        Nozzle(80, "side", (np.pi, 0.25), 0.16),
        Nozzle(300, "side", (np.pi / 2, 0.7), 0.2, manway=True),
    ]
    upright = ManwayTank(radius=radius, height=height, clearance=0.35, legs=4, nozzles=tuple(map(Opening.of, nozzles)))
    vessel = upright.as_assembly(style, "T-9")
    low = 0.35 + radius / 2 + 0.04
    span = low + 0.3, low + height - 0.3
    return with_level_gauge(vessel, "T-9", "G-9", radius, -0.3 * np.pi, span, style, rng)


def _ladder(style: ModelingStyle, rng: np.random.Generator) -> Assembly:
    """A caged ladder that stands by itself beside the tank."""
    family = FAMILIES["ladder/cage"]
    seed = int(rng.integers(1000))
    return whole(lambda number: as_assembly(family, family.build(family.sizes[0], style, Apart(seed, number)), style))


def _yard(style: ModelingStyle, flips: tuple[int, int]) -> list[Assembly]:
    """Panels round the yard, a gate in its front side, and pillars at its corners; all apart from each other."""
    parts = []
    corner = Pillar(side=0.45, height=1.7)
    for axis, turn in ((0, 0.0), (1, np.pi / 2)):
        along, across = _HALF[axis], _HALF[1 - axis]
        clear = along - 0.45
        count = int(2 * clear / (_PANEL + 0.05))
        pitch = 2 * clear / count
        for side in (-1, 1):
            for k in range(count):
                where = -clear + (k + 0.5) * pitch
                gate = axis == 0 and side * flips[1] < 0 and k == count // 2
                kind = Gate if gate else Fence
                panel = kind(length=pitch - 0.05, height=1.10, pitch=_BARS).as_assembly(style)
                place = (where, side * across) if axis == 0 else (side * across, where)
                parts.append(panel.placed(at(*place) @ spun("z", turn)).marked(cluster=f"fence-{axis}-{side}-{k}"))
    for sx in (-1, 1):
        for sy in (-1, 1):
            pillar = corner.as_assembly(style).placed(at(sx * _HALF[0], sy * _HALF[1]))
            parts.append(pillar.marked(cluster=f"pillar-{sx}-{sy}"))
    return parts
