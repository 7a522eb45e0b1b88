"""Systems that draw plants: what each makes of shapes and joints, what it leaves out, what it draws often.

A system is a range: each plant drawn in it has a modelling style, defects and omissions of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from cadplants.faults.defects import Defects, degrade
from cadplants.faults.omissions import OMISSIONS, omitted
from cadplants.model.contacts import measured
from cadplants.model.plant import Plant
from cadplants.presets.assortment import make_assortment
from cadplants.presets.taste import FEW_KITS, Taste
from cadplants.styles.authoring_styles import (
    Changes,
    asset_pack_defects,
    asset_pack_style,
    building_defects,
    building_style,
    game_defects,
    game_style,
    hobby_defects,
    hobby_style,
    mechanical_defects,
    mechanical_style,
    plant_design_defects,
    plant_design_style,
    robot_world_defects,
    robot_world_style,
    scan_defects,
    scan_style,
    skid_defects,
    skid_style,
)
from cadplants.styles.chance import chance
from cadplants.styles.drawn_styles import draw_modeling_style
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["SYSTEMS", "Authoring", "System", "draw_system", "make_in_system"]

_APART = 10_000_000  # between the seeds of the layouts of two systems
_SELDOM = 0.04  # how likely any class of parts is missing where a system says nothing


@dataclass(frozen=True)
class Authoring:
    """How one plant is drawn.

    Args:
        system: name of the system that draws it, a key of ``SYSTEMS``.
        style: how its shapes are modelled.
        defects: how its joints and bodies are spoilt.
        omissions: classes of parts that it lacks, keys of ``OMISSIONS``.
        taste: what is in it how often, and how much of that comes from another style.
    """

    system: str
    style: ModelingStyle
    defects: Defects
    omissions: frozenset[str]
    taste: Taste


@dataclass(frozen=True)
class System:
    """A kind of program that plants are drawn with.

    Args:
        name: a key of ``SYSTEMS``.
        style: draws what this system changes about a modelling style, as arguments of ``ModelingStyle``.
        defects: draws the defects of a plant in such a style, as arguments of ``Defects``.
        pools: shares of the usual families, of those of primitives and of look-alikes.
        factors: how much oftener than usual families are drawn, see ``Taste``.
        sizes: nominal sizes of lines: the greatest of a plant is one of these.
        foreign: share of the devices that come from another style.
        mixed: share of the devices with a granularity of their own.
        meshes: least and greatest number of meshes without fasteners at which a plant is full.
        omissions: how likely each class of parts is missing from a plant.
    """

    name: str
    style: Callable[[np.random.Generator], Changes]
    defects: Callable[[np.random.Generator, ModelingStyle], Changes]
    pools: tuple[float, float, float]
    factors: Mapping[str, float] = field(default_factory=dict)
    sizes: tuple[int, ...] = (300,)
    foreign: float = 0.0
    mixed: float = 0.0
    meshes: tuple[int, int] = (90, 280)
    omissions: Mapping[str, float] = field(default_factory=dict)


def draw_system(rng: np.random.Generator, name: str | None = None) -> Authoring:
    """How one plant is drawn, at random.

    Args:
        rng: of everything.
        name: of the system, a key of ``SYSTEMS``; else any of them, all as likely.

    Raises:
        ValueError: an unknown system.
    """
    if name is None:
        name = list(SYSTEMS)[int(rng.integers(len(SYSTEMS)))]
    if name not in SYSTEMS:
        raise ValueError(f"unknown system {name!r}; there are {', '.join(SYSTEMS)}")
    system = SYSTEMS[name]
    # The colours, and whatever the system leaves open, are as of any drawn style.
    given: Changes = {"soup": 0.0, "cracks": 0.0, "wobble": 0.0, "gap": (0.0, 0.0), "rows": 0.0, "merged": False}
    base = draw_modeling_style(rng)
    changes: Changes = given | {"name": f"{name} system", "palette": base.palette, "fans": base.fans}
    style = ModelingStyle(**(changes | system.style(rng)))
    spoilt: Changes = {"shuffled": chance(rng, 0.3)}
    defects = Defects(**(spoilt | system.defects(rng, style)))
    missing = [kind for kind in OMISSIONS if chance(rng, system.omissions.get(kind, _SELDOM))]
    pools = np.array(system.pools) * rng.uniform(0.5, 1.5, 3)
    shares = (float(pools[0]), float(pools[1]), float(pools[2]))
    most = int(rng.choice(system.sizes))
    taste = Taste(shares, {**FEW_KITS, **system.factors}, (15, most), system.foreign, system.mixed, system.meshes)
    return Authoring(name, style, defects, frozenset(missing), taste)


def make_in_system(seed: int, system: str, without: frozenset[str] = frozenset()) -> Plant:
    """Builds an assortment as a system draws plants.

    Args:
        seed: of everything.
        system: a key of ``SYSTEMS``.
        without: names of families that are left out, or what comes before their slash.

    Returns:
        The plant with its labels and families; contacts and clusters are those that its surfaces have.

    Raises:
        ValueError: an unknown system, or an unknown family.
    """
    if system not in SYSTEMS:
        raise ValueError(f"unknown system {system!r}; there are {', '.join(SYSTEMS)}")
    number = 1 + list(SYSTEMS).index(system)
    drawn = draw_system(np.random.default_rng([seed, 26, number]), system)
    plant = make_assortment(_APART * number + seed, drawn.style, without, drawn.taste)
    return replace(measured(degrade(omitted(plant, drawn.omissions), drawn.defects, seed)), seed=seed)


_WAYS = {"cable tray": 3.0, "conduit": 1.5}
_STEEL = {"frame": 2.0, "beam": 1.5, "column": 1.5, "foundation": 2.0, "stairs": 1.5, "platform": 1.5, "ladder": 1.5}

SYSTEMS: dict[str, System] = {
    system.name: system
    for system in (
        System(
            "plant-design",
            plant_design_style,
            plant_design_defects,
            (0.08, 0.8, 0.12),
            {**_STEEL, **_WAYS, "tank": 2.0, "pump": 2.0, "heat exchanger": 1.5, "union": 0.2, "coupling": 0.5},
            (80, 150, 300, 300),
            0.06,
            0.1,
            omissions={
                "fasteners": 0.5,
                "gaskets": 0.9,
                "structure": 0.15,
                "supports": 0.3,
                "access": 0.15,
                "electrical": 0.15,
                "gauge faces": 0.5,
                "glands": 0.6,
                "handwheels": 0.2,
                "base plates": 0.3,
            },
        ),
        System(
            "building",
            building_style,
            building_defects,
            (0.55, 0.35, 0.1),
            {"radiator": 4.0, "boiler": 4.0, "Pump unit": 1.5, "heat exchanger": 1.5, **_WAYS, "control panel": 1.5},
            (25, 32, 50, 50, 100),
            0.12,
            0.05,
            omissions={
                "fasteners": 0.8,
                "gaskets": 0.9,
                "structure": 0.3,
                "supports": 0.5,
                "access": 0.3,
                "gauge faces": 0.4,
                "glands": 0.5,
                "base plates": 0.4,
            },
        ),
        System(
            "mechanical",
            mechanical_style,
            mechanical_defects,
            (0.72, 0.05, 0.23),
            {"siphon": 2.0, "gauge": 1.5, "fence": 0.3, "wall": 0.2, "stairs": 0.4, "caster": 2.0},
            (50, 80, 100, 150),
            0.08,
            0.05,
            (70, 170),
            {"gaskets": 0.2, "nuts and washers": 0.15, "fasteners": 0.1, "gauge glasses": 0.2, "structure": 0.2},
        ),
        System(
            "skid",
            skid_style,
            skid_defects,
            (0.6, 0.25, 0.15),
            {**_STEEL, "skid frame": 4.0, "pump": 2.0, "tank": 1.5, "control panel": 1.5},
            (50, 80, 150, 200),
            0.12,
            0.15,
            omissions={"fasteners": 0.25, "gaskets": 0.3, "supports": 0.25, "gauge glasses": 0.3, "gauge needles": 0.2},
        ),
        System(
            "robot-world",
            robot_world_style,
            robot_world_defects,
            (0.3, 0.4, 0.3),
            {"railing": 4.0, "fence": 2.5, "gate": 2.0, "stairs": 3.0, "ladder": 2.0, "gauge": 2.0, "caster": 1.5},
            (50, 80, 150, 200),
            0.15,
            0.1,
            omissions={
                "fasteners": 0.6,
                "gaskets": 0.9,
                "gauge glasses": 0.5,
                "supports": 0.3,
                "glands": 0.5,
                "base plates": 0.3,
            },
        ),
        System(
            "game",
            game_style,
            game_defects,
            (0.4, 0.4, 0.2),
            {"railing": 2.0, "fence": 2.0, "tank": 1.5, "lamp": 2.0, "sign": 1.5, **_WAYS},
            (100, 200, 300),
            0.1,
            0.15,
            omissions={
                "fasteners": 0.7,
                "gaskets": 0.9,
                "supports": 0.35,
                "gauge glasses": 0.6,
                "gauge needles": 0.4,
                "glands": 0.7,
                "motor parts": 0.4,
                "base plates": 0.3,
            },
        ),
        System(
            "scan",
            scan_style,
            scan_defects,
            (0.5, 0.35, 0.15),
            {**_STEEL, **_WAYS},
            (100, 150, 300),
            0.05,
            0.1,
            omissions={
                "fasteners": 0.9,
                "gaskets": 0.95,
                "gauge faces": 0.8,
                "glands": 0.9,
                "motor parts": 0.6,
                "electrical": 0.25,
                "supports": 0.3,
                "access": 0.15,
                "base plates": 0.4,
            },
        ),
        System(
            "hobby",
            hobby_style,
            hobby_defects,
            (0.4, 0.3, 0.3),
            {"railing": 2.0, "stairs": 1.5, "frame": 1.5, "caster": 1.5},
            (50, 80, 100, 150),
            0.1,
            0.15,
            (70, 200),
            {
                "fasteners": 0.35,
                "gaskets": 0.5,
                "supports": 0.3,
                "gauge glasses": 0.4,
                "glands": 0.3,
                "structure": 0.15,
            },
        ),
        System(
            "asset-pack",
            asset_pack_style,
            asset_pack_defects,
            (0.15, 0.8, 0.05),
            {**dict.fromkeys(FEW_KITS, 6.0), "pump": 1.5, "gauge": 1.5, "railing": 1.5, **_WAYS},
            (50, 80, 150, 200, 300),
            0.1,
            0.1,
            (60, 200),
            omissions={
                "fasteners": 0.8,
                "gaskets": 0.95,
                "supports": 0.35,
                "gauge glasses": 0.6,
                "gauge needles": 0.4,
                "glands": 0.7,
                "motor parts": 0.3,
                "base plates": 0.3,
            },
        ),
    )
}
"""By name."""
