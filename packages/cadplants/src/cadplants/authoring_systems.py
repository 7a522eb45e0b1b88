"""Systems that draw plants: what each makes of shapes and joints, what it leaves out, what it draws often.

A system is a range: each plant drawn in it has a modelling style, defects and omissions of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from cadplants.assortment import make_assortment
from cadplants.defects import Defects, degrade
from cadplants.drawn_styles import draw_modeling_style
from cadplants.modeling_style import ModelingStyle
from cadplants.omissions import OMISSIONS, omitted
from cadplants.plant import Plant
from cadplants.taste import Taste

__all__ = ["SYSTEMS", "Authoring", "System", "draw_system", "make_in_system"]

_Changes = dict[str, Any]


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
    style: Callable[[np.random.Generator], _Changes]
    defects: Callable[[np.random.Generator, ModelingStyle], _Changes]
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
    given = {"soup": 0.0, "cracks": 0.0, "wobble": 0.0, "gap": (0.0, 0.0), "rows": 0.0, "merged": False}
    base = draw_modeling_style(rng)
    changes = given | {"name": f"{name} system", "palette": base.palette, "fans": base.fans} | system.style(rng)
    style = ModelingStyle(**changes)
    defects = Defects(**({"shuffled": _chance(rng, 0.3)} | system.defects(rng, style)))
    missing = [kind for kind in OMISSIONS if _chance(rng, system.omissions.get(kind, _SELDOM))]
    pools = np.array(system.pools) * rng.uniform(0.5, 1.5, 3)
    shares = (float(pools[0]), float(pools[1]), float(pools[2]))
    most = int(rng.choice(system.sizes))
    taste = Taste(shares, system.factors, (15, most), system.foreign, system.mixed, system.meshes)
    return Authoring(name, style, defects, frozenset(missing), taste)


def make_in_system(seed: int, system: str, without: frozenset[str] = frozenset()) -> Plant:
    """Builds an assortment as a system draws plants.

    Args:
        seed: of everything.
        system: a key of ``SYSTEMS``.
        without: names of families that are left out, or what comes before their slash.

    Returns:
        The plant with its labels and families. Contacts that were meant are recorded along the lines only; where its
        joints were spoilt, also all that its surfaces have.

    Raises:
        ValueError: an unknown system, or an unknown family.
    """
    rng = np.random.default_rng([seed, 26])
    drawn = draw_system(rng, system)
    plant = make_assortment(seed, drawn.style, without, drawn.taste)
    return degrade(omitted(plant, drawn.omissions), drawn.defects, seed)


# --- what several systems share ---

_SELDOM = 0.04  # how likely any class of parts is missing where a system says nothing


def _chance(rng: np.random.Generator, share: float) -> bool:
    return bool(rng.random() < share)


def _num(rng: np.random.Generator, low: float, high: float) -> float:
    return float(rng.uniform(low, high))


def _one_of(rng: np.random.Generator, **shares: float) -> str:
    """One of some names, each as likely as its share says."""
    total = sum(shares.values())
    return str(rng.choice(list(shares), p=[share / total for share in shares.values()]))


def _span(rng: np.random.Generator, low: float, high: float) -> tuple[float, float]:
    """A range within another, at least a tenth of it wide."""
    first = _num(rng, low, high - 0.1 * (high - low))
    return first, _num(rng, first + 0.1 * (high - low), high)


def _round(rng: np.random.Generator, *counts: int, by_size: float = 0.3) -> _Changes:
    """One number of sides for all circles out of some, or, at times, more of them the larger a circle is."""
    count = int(rng.choice(counts))
    if not _chance(rng, by_size):
        return {"sides": (count, count), "sag": 0.001}
    return {"sides": (count, min(96, 2 * count)), "sag": float(10 ** rng.uniform(-4.0, -2.7))}


def _grains(rng: np.random.Generator, one: float, few: float, pieces: float) -> _Changes:
    """A granularity for each kind of device: mostly one for all, at times each its own."""
    kinds = ("valve", "gauge", "pump", "tank", "equipment", "structure")
    whole = _one_of(rng, one=one, few=few, pieces=pieces)
    alone = _chance(rng, 0.3)
    return {kind: _one_of(rng, one=one, few=few, pieces=pieces) if alone else whole for kind in kinds}


def _bare() -> _Changes:
    """Without fasteners, gaskets and bolt holes."""
    return {"fasteners": "none", "gaskets": False, "holes": False}


# --- plant design: primitives of a catalogue, exported as they are ---


def _plant_design_style(rng: np.random.Generator) -> _Changes:
    return {
        **_round(rng, 8, 8, 10, 12, 12, 16, 16, 24, 36),
        **_bare(),
        **_grains(rng, 0.5, 0.1, 0.4),
        "hollow": _chance(rng, 0.12),
        "flange": _one_of(rng, ring=0.35, neck=0.5, slip=0.15),
        "fasteners": _one_of(rng, none=0.94, set=0.06),
        "capped": _chance(rng, 0.92),
        "devices": _one_of(rng, primitives=0.92, built=0.08),
    }


def _plant_design_defects(rng: np.random.Generator, _: ModelingStyle) -> _Changes:
    return {
        "faces": _span(rng, 0.0015, 0.0045) if _chance(rng, 0.85) else None,
        "joints": _span(rng, 0.0, 0.002) if _chance(rng, 0.25) else None,
        "insulation": _num(rng, 0.1, 0.6) if _chance(rng, 0.25) else 0.0,
        "doubled": _num(rng, 0.05, 0.5) if _chance(rng, 0.3) else 0.0,
        "cut": _num(rng, 0.1, 0.5) if _chance(rng, 0.2) else 0.0,
        "flipped": _num(rng, 0.1, 1.0) if _chance(rng, 0.1) else 0.0,
        "mirrored": _chance(rng, 0.1),
    }


# --- building: one mesh a device, small pipes, loose joints ---


def _building_style(rng: np.random.Generator) -> _Changes:
    gap = (0.0, _num(rng, 0.001, 0.0045)) if _chance(rng, 0.5) else (-_num(rng, 0.0005, 0.003), _num(rng, 0.0, 0.002))
    return {
        **_round(rng, 8, 8, 10, 12, 12, 16, by_size=0.15),
        **_bare(),
        **_grains(rng, 0.8, 0.15, 0.05),
        "hollow": _chance(rng, 0.2),
        "flange": _one_of(rng, ring=0.6, slip=0.3, neck=0.1),
        "gap": gap if _chance(rng, 0.75) else (0.0, 0.0),
        "merged": _chance(rng, 0.12),
        "capped": _chance(rng, 0.85),
        "soup": float(rng.choice([0.0, 0.0, 0.0, 1.0])),
        "devices": _one_of(rng, primitives=0.4, built=0.6),
    }


def _building_defects(rng: np.random.Generator, _: ModelingStyle) -> _Changes:
    return {
        "joints": _span(rng, -0.003, 0.0045) if _chance(rng, 0.35) else None,
        "insulation": _num(rng, 0.1, 0.6) if _chance(rng, 0.3) else 0.0,
        "cut": _num(rng, 0.1, 0.4) if _chance(rng, 0.15) else 0.0,
        "duplicates": _num(rng, 0.0, 0.05) if _chance(rng, 0.15) else 0.0,
    }


# --- mechanical: every piece, finely, with clearances ---


def _mechanical_style(rng: np.random.Generator) -> _Changes:
    least = int(rng.choice([16, 20, 24, 24, 32]))
    return {
        "sag": float(10 ** rng.uniform(-4.3, -3.4)),
        "sides": (least, int(rng.choice([40, 48, 64]))),
        **_grains(rng, 0.03, 0.12, 0.85),
        "hollow": _chance(rng, 0.94),
        "flange": _one_of(rng, slip=0.55, neck=0.4, ring=0.05),
        "holes": _chance(rng, 0.9),
        "fasteners": _one_of(rng, pieces=0.6, bolt=0.25, none=0.15),
        "gaskets": _chance(rng, 0.7),
        "fittings": _one_of(rng, long=0.6, smooth=0.4),
        "spool": _one_of(rng, segments=0.7, bent=0.3),
        "gap": (0.0, _num(rng, 0.0001, 0.0006)) if _chance(rng, 0.3) else (0.0, 0.0),
    }


def _mechanical_defects(rng: np.random.Generator, style: ModelingStyle) -> _Changes:
    return {
        "setback": _span(rng, 0.003, 0.008) if style.hollow and _chance(rng, 0.6) else None,
        "screwed": _span(rng, 0.0001, 0.0006) if _chance(rng, 0.6) else None,
        "faces": _span(rng, 0.0015, 0.0025) if _chance(rng, 0.15) else None,
        "incomplete": _num(rng, 0.05, 0.3) if _chance(rng, 0.3) else 0.0,
        "hidden": _num(rng, 0.0, 0.05) if _chance(rng, 0.2) else 0.0,
        "mirrored": _chance(rng, 0.2),
    }


# --- skid: standard parts along a diagram ---


def _skid_style(rng: np.random.Generator) -> _Changes:
    return {
        **_round(rng, 12, 16, 16, 20, 24, 32, by_size=0.4),
        **_grains(rng, 0.35, 0.45, 0.2),
        "hollow": _chance(rng, 0.5),
        "flange": _one_of(rng, neck=0.6, slip=0.2, ring=0.2),
        "holes": _chance(rng, 0.4),
        "fasteners": _one_of(rng, none=0.55, set=0.25, bolt=0.15, flange=0.05),
        "gaskets": _chance(rng, 0.35),
        "spool": _one_of(rng, segments=0.75, bent=0.25),
        "merged": _chance(rng, 0.15),
        "fittings": _one_of(rng, long=0.25, smooth=0.75),
        "gap": (0.0, _num(rng, 0.0003, 0.002)) if _chance(rng, 0.25) else (0.0, 0.0),
        "devices": _one_of(rng, primitives=0.25, built=0.75),
    }


def _skid_defects(rng: np.random.Generator, style: ModelingStyle) -> _Changes:
    return {
        "faces": _span(rng, 0.0005, 0.0035) if not style.gaskets and _chance(rng, 0.4) else None,
        "joints": _span(rng, -0.001, 0.002) if _chance(rng, 0.3) else None,
        "cut": _num(rng, 0.1, 0.5) if _chance(rng, 0.3) else 0.0,
        "insulation": _num(rng, 0.1, 0.4) if _chance(rng, 0.15) else 0.0,
        "duplicates": _num(rng, 0.0, 0.05) if _chance(rng, 0.15) else 0.0,
    }


# --- robot world: what a robot sees, of bars and cylinders ---


def _robot_world_style(rng: np.random.Generator) -> _Changes:
    gap = (-_num(rng, 0.0005, 0.003), _num(rng, 0.0, 0.002)) if _chance(rng, 0.35) else (0.0, 0.0)
    return {
        **_round(rng, 8, 12, 12, 16, 20, 24, 32),
        **_bare(),
        **_grains(rng, 0.12, 0.13, 0.75),
        "hollow": _chance(rng, 0.35),
        "flange": _one_of(rng, ring=0.8, slip=0.2),
        "fasteners": _one_of(rng, none=0.85, set=0.1, bolt=0.05),
        "spool": _one_of(rng, segments=0.7, bent=0.3),
        "soup": float(rng.choice([0.0, 0.0, 1.0])),
        "gap": gap,
        "devices": _one_of(rng, primitives=0.65, built=0.35),
    }


def _robot_world_defects(rng: np.random.Generator, _: ModelingStyle) -> _Changes:
    return {
        "joints": _span(rng, -0.004, 0.002) if _chance(rng, 0.4) else None,
        "flipped": _num(rng, 0.05, 0.5) if _chance(rng, 0.15) else 0.0,
        "degenerate": _num(rng, 0.05, 0.3) if _chance(rng, 0.15) else 0.0,
    }


# --- game: few triangles, few meshes ---


def _game_style(rng: np.random.Generator) -> _Changes:
    return {
        **_round(rng, 6, 6, 8, 8, 10, 12, 16, by_size=0.2),
        **_bare(),
        **_grains(rng, 0.55, 0.35, 0.1),
        "hollow": _chance(rng, 0.06),
        "flange": _one_of(rng, ring=0.55, slip=0.4, neck=0.05),
        "fasteners": _one_of(rng, none=0.6, set=0.25, flange=0.15),
        "spool": _one_of(rng, segments=0.5, bent=0.5),
        "merged": _chance(rng, 0.45),
        "capped": _chance(rng, 0.5),
        "soup": float(rng.choice([0.0, 0.0, 0.5, 1.0])),
        "cracks": float(rng.choice([0.0, 0.0, 0.1, 0.3])),
        "gap": (-_num(rng, 0.0005, 0.004), 0.0) if _chance(rng, 0.4) else (0.0, 0.0),
        "devices": _one_of(rng, primitives=0.55, built=0.45),
    }


def _game_defects(rng: np.random.Generator, _: ModelingStyle) -> _Changes:
    return {
        "joints": _span(rng, -0.005, 0.001) if _chance(rng, 0.4) else None,
        "flipped": _num(rng, 0.02, 0.2) if _chance(rng, 0.2) else 0.0,
        "duplicates": _num(rng, 0.0, 0.05) if _chance(rng, 0.15) else 0.0,
        "mirrored": _chance(rng, 0.3),
    }


# --- scan: what was measured, fitted with shapes by eye ---


def _scan_style(rng: np.random.Generator) -> _Changes:
    return {
        **_round(rng, 8, 10, 12, 12, 16, 20),
        **_bare(),
        **_grains(rng, 0.5, 0.35, 0.15),
        "hollow": False,
        "flange": _one_of(rng, ring=0.6, slip=0.3, neck=0.1),
        "wobble": _num(rng, 0.0003, 0.002) if _chance(rng, 0.8) else 0.0,
        "gap": (-_num(rng, 0.0005, 0.004), _num(rng, 0.0, 0.003)),
        "merged": _chance(rng, 0.15),
        "rows": _num(rng, 0.03, 0.2) if _chance(rng, 0.2) else 0.0,
        "cracks": float(rng.choice([0.0, 0.0, 0.1])),
        "devices": _one_of(rng, primitives=0.45, built=0.55),
    }


def _scan_defects(rng: np.random.Generator, _: ModelingStyle) -> _Changes:
    return {
        "cut": _num(rng, 0.1, 0.5) if _chance(rng, 0.4) else 0.0,
        "incomplete": _num(rng, 0.05, 0.3) if _chance(rng, 0.4) else 0.0,
        "insulation": _num(rng, 0.1, 0.4) if _chance(rng, 0.2) else 0.0,
    }


# --- hobby: simple solids, exactly placed ---


def _hobby_style(rng: np.random.Generator) -> _Changes:
    coarse = _chance(rng, 0.3)
    return {
        **(_round(rng, 6, 6, 8, by_size=0.0) if coarse else _round(rng, 16, 20, 24, 30, 32, 48, 72, 96, by_size=0.2)),
        **_grains(rng, 0.35, 0.25, 0.4),
        "hollow": _chance(rng, 0.85),
        "flange": _one_of(rng, slip=0.55, ring=0.35, neck=0.1),
        "holes": not coarse and _chance(rng, 0.6),
        "fasteners": _one_of(rng, none=0.55, bolt=0.2, pieces=0.15, set=0.1),
        "gaskets": _chance(rng, 0.3),
        "spool": _one_of(rng, segments=0.75, bent=0.25),
        "fittings": _one_of(rng, long=0.35, smooth=0.65),
        "rows": _num(rng, 0.04, 0.15) if _chance(rng, 0.08) else 0.0,
        "devices": _one_of(rng, primitives=0.4, built=0.6),
    }


def _hobby_defects(rng: np.random.Generator, style: ModelingStyle) -> _Changes:
    return {
        "setback": _span(rng, 0.003, 0.008) if style.hollow and _chance(rng, 0.4) else None,
        "screwed": _span(rng, 0.0001, 0.0006) if _chance(rng, 0.15) else None,
        "faces": _span(rng, 0.001, 0.003) if _chance(rng, 0.15) else None,
        "mirrored": _chance(rng, 0.2),
    }


_WAYS = {"cable tray": 3.0, "conduit": 1.5}
_STEEL = {"frame": 2.0, "beam": 1.5, "column": 1.5, "foundation": 2.0, "stairs": 1.5, "platform": 1.5, "ladder": 1.5}

SYSTEMS: dict[str, System] = {
    system.name: system
    for system in (
        System(
            "plant-design",
            _plant_design_style,
            _plant_design_defects,
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
            _building_style,
            _building_defects,
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
            _mechanical_style,
            _mechanical_defects,
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
            _skid_style,
            _skid_defects,
            (0.6, 0.25, 0.15),
            {**_STEEL, "skid frame": 4.0, "pump": 2.0, "tank": 1.5, "control panel": 1.5},
            (50, 80, 150, 200),
            0.12,
            0.15,
            omissions={"fasteners": 0.25, "gaskets": 0.3, "supports": 0.25, "gauge glasses": 0.3, "gauge needles": 0.2},
        ),
        System(
            "robot-world",
            _robot_world_style,
            _robot_world_defects,
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
            _game_style,
            _game_defects,
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
            _scan_style,
            _scan_defects,
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
            _hobby_style,
            _hobby_defects,
            (0.4, 0.3, 0.3),
            {"railing": 2.0, "stairs": 1.5, "frame": 1.5, "caster": 1.5},
            (50, 80, 100, 150),
            0.1,
            0.15,
            (70, 200),
            {"fasteners": 0.35, "gaskets": 0.5, "supports": 0.3, "gauge glasses": 0.4, "glands": 0.3, "structure": 0.15},
        ),
    )
}
"""By name."""
