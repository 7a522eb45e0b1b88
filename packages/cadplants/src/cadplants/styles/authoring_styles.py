"""How systems that draw plants model shapes and spoil joints: drawn anew for each plant, in each system's range."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.styles.chance import chance, num
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "Changes",
    "asset_pack_defects",
    "asset_pack_style",
    "building_defects",
    "building_style",
    "game_defects",
    "game_style",
    "hobby_defects",
    "hobby_style",
    "mechanical_defects",
    "mechanical_style",
    "plant_design_defects",
    "plant_design_style",
    "robot_world_defects",
    "robot_world_style",
    "scan_defects",
    "scan_style",
    "skid_defects",
    "skid_style",
]

Changes = dict[str, Any]
"""Arguments of ``ModelingStyle`` or of ``Defects``."""


def _one_of(rng: np.random.Generator, **shares: float) -> str:
    """One of some names, each as likely as its share says."""
    total = sum(shares.values())
    return str(rng.choice(list(shares), p=[share / total for share in shares.values()]))


def _span(rng: np.random.Generator, low: float, high: float) -> tuple[float, float]:
    """A range within another, at least a tenth of it wide."""
    first = num(rng, low, high - 0.1 * (high - low))
    return first, num(rng, first + 0.1 * (high - low), high)


def _round(rng: np.random.Generator, *counts: int, by_size: float = 0.3) -> Changes:
    """One number of sides for all circles out of some, or, at times, more of them the larger a circle is."""
    count = int(rng.choice(counts))
    if not chance(rng, by_size):
        return {"sides": (count, count), "sag": 0.001}
    return {"sides": (count, min(96, 2 * count)), "sag": float(10 ** rng.uniform(-4.0, -2.7))}


def _grains(rng: np.random.Generator, one: float, few: float, pieces: float) -> Changes:
    """A granularity for each kind of device: mostly one for all, at times each its own."""
    kinds = ("valve", "gauge", "pump", "tank", "equipment", "structure")
    whole = _one_of(rng, one=one, few=few, pieces=pieces)
    alone = chance(rng, 0.3)
    return {kind: _one_of(rng, one=one, few=few, pieces=pieces) if alone else whole for kind in kinds}


def _bare() -> Changes:
    """Without fasteners, gaskets and bolt holes."""
    return {"fasteners": "none", "gaskets": False, "holes": False}


# --- plant design: primitives of a catalogue, exported as they are ---


def plant_design_style(rng: np.random.Generator) -> Changes:
    """What plant design systems change about a modelling style."""
    return {
        **_round(rng, 8, 8, 10, 12, 12, 16, 16, 24, 36),
        **_bare(),
        **_grains(rng, 0.5, 0.1, 0.4),
        "hollow": chance(rng, 0.12),
        "flange": _one_of(rng, ring=0.35, neck=0.5, slip=0.15),
        "fasteners": _one_of(rng, none=0.94, set=0.06),
        "capped": chance(rng, 0.92),
        "devices": _one_of(rng, primitives=0.92, built=0.08),
    }


def plant_design_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that plant design systems draw in a style."""
    return {
        "faces": _span(rng, 0.0015, 0.0045) if chance(rng, 0.85) else None,
        "joints": _span(rng, 0.0, 0.002) if chance(rng, 0.25) else None,
        "insulation": num(rng, 0.1, 0.6) if chance(rng, 0.25) else 0.0,
        "doubled": num(rng, 0.05, 0.5) if chance(rng, 0.3) else 0.0,
        "cut": num(rng, 0.1, 0.5) if chance(rng, 0.2) else 0.0,
        "flipped": num(rng, 0.1, 1.0) if chance(rng, 0.1) else 0.0,
        "mirrored": chance(rng, 0.1),
    }


# --- building: one mesh a device, small pipes, loose joints ---


def building_style(rng: np.random.Generator) -> Changes:
    """What building systems change about a modelling style."""
    gap = (0.0, num(rng, 0.001, 0.0045)) if chance(rng, 0.5) else (-num(rng, 0.0005, 0.003), num(rng, 0.0, 0.002))
    return {
        **_round(rng, 8, 8, 10, 12, 12, 16, by_size=0.15),
        **_bare(),
        **_grains(rng, 0.8, 0.15, 0.05),
        "hollow": chance(rng, 0.2),
        "flange": _one_of(rng, ring=0.6, slip=0.3, neck=0.1),
        "gap": gap if chance(rng, 0.75) else (0.0, 0.0),
        "merged": chance(rng, 0.12),
        "capped": chance(rng, 0.85),
        "soup": float(rng.choice([0.0, 0.0, 0.0, 1.0])),
        "devices": _one_of(rng, primitives=0.4, built=0.6),
    }


def building_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that building systems draw in a style."""
    return {
        "joints": _span(rng, -0.003, 0.0045) if chance(rng, 0.35) else None,
        "insulation": num(rng, 0.1, 0.6) if chance(rng, 0.3) else 0.0,
        "cut": num(rng, 0.1, 0.4) if chance(rng, 0.15) else 0.0,
        "duplicates": num(rng, 0.0, 0.05) if chance(rng, 0.15) else 0.0,
    }


# --- mechanical: every piece, finely, with clearances ---


def mechanical_style(rng: np.random.Generator) -> Changes:
    """What mechanical systems change about a modelling style."""
    least = int(rng.choice([16, 20, 24, 24, 32]))
    return {
        "sag": float(10 ** rng.uniform(-4.3, -3.4)),
        "sides": (least, int(rng.choice([40, 48, 64]))),
        **_grains(rng, 0.03, 0.12, 0.85),
        "hollow": chance(rng, 0.94),
        "flange": _one_of(rng, slip=0.55, neck=0.4, ring=0.05),
        "holes": chance(rng, 0.9),
        "fasteners": _one_of(rng, pieces=0.6, bolt=0.25, none=0.15),
        "gaskets": chance(rng, 0.7),
        "fittings": _one_of(rng, long=0.6, smooth=0.4),
        "spool": _one_of(rng, segments=0.7, bent=0.3),
        "gap": (0.0, num(rng, 0.0001, 0.0006)) if chance(rng, 0.3) else (0.0, 0.0),
    }


def mechanical_defects(rng: np.random.Generator, style: ModelingStyle) -> Changes:
    """The defects of a plant that mechanical systems draw in a style."""
    return {
        "setback": _span(rng, 0.003, 0.008) if style.hollow and chance(rng, 0.6) else None,
        "screwed": _span(rng, 0.0001, 0.0006) if chance(rng, 0.6) else None,
        "faces": _span(rng, 0.0015, 0.0025) if chance(rng, 0.15) else None,
        "incomplete": num(rng, 0.05, 0.3) if chance(rng, 0.3) else 0.0,
        "hidden": num(rng, 0.0, 0.05) if chance(rng, 0.2) else 0.0,
        "mirrored": chance(rng, 0.2),
    }


# --- skid: standard parts along a diagram ---


def skid_style(rng: np.random.Generator) -> Changes:
    """What skid systems change about a modelling style."""
    return {
        **_round(rng, 12, 16, 16, 20, 24, 32, by_size=0.4),
        **_grains(rng, 0.35, 0.45, 0.2),
        "hollow": chance(rng, 0.5),
        "flange": _one_of(rng, neck=0.6, slip=0.2, ring=0.2),
        "holes": chance(rng, 0.4),
        "fasteners": _one_of(rng, none=0.55, set=0.25, bolt=0.15, flange=0.05),
        "gaskets": chance(rng, 0.35),
        "spool": _one_of(rng, segments=0.75, bent=0.25),
        "merged": chance(rng, 0.15),
        "fittings": _one_of(rng, long=0.25, smooth=0.75),
        "gap": (0.0, num(rng, 0.0003, 0.002)) if chance(rng, 0.25) else (0.0, 0.0),
        "devices": _one_of(rng, primitives=0.25, built=0.75),
    }


def skid_defects(rng: np.random.Generator, style: ModelingStyle) -> Changes:
    """The defects of a plant that skid systems draw in a style."""
    return {
        "faces": _span(rng, 0.0005, 0.0035) if not style.gaskets and chance(rng, 0.4) else None,
        "joints": _span(rng, -0.001, 0.002) if chance(rng, 0.3) else None,
        "cut": num(rng, 0.1, 0.5) if chance(rng, 0.3) else 0.0,
        "insulation": num(rng, 0.1, 0.4) if chance(rng, 0.15) else 0.0,
        "duplicates": num(rng, 0.0, 0.05) if chance(rng, 0.15) else 0.0,
    }


# --- robot world: what a robot sees, of bars and cylinders ---


def robot_world_style(rng: np.random.Generator) -> Changes:
    """What robot world systems change about a modelling style."""
    gap = (-num(rng, 0.0005, 0.003), num(rng, 0.0, 0.002)) if chance(rng, 0.35) else (0.0, 0.0)
    return {
        **_round(rng, 8, 12, 12, 16, 20, 24, 32),
        **_bare(),
        **_grains(rng, 0.12, 0.13, 0.75),
        "hollow": chance(rng, 0.35),
        "flange": _one_of(rng, ring=0.8, slip=0.2),
        "fasteners": _one_of(rng, none=0.85, set=0.1, bolt=0.05),
        "spool": _one_of(rng, segments=0.7, bent=0.3),
        "soup": float(rng.choice([0.0, 0.0, 1.0])),
        "gap": gap,
        "devices": _one_of(rng, primitives=0.65, built=0.35),
    }


def robot_world_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that robot world systems draw in a style."""
    return {
        "joints": _span(rng, -0.004, 0.002) if chance(rng, 0.4) else None,
        "flipped": num(rng, 0.05, 0.5) if chance(rng, 0.15) else 0.0,
        "degenerate": num(rng, 0.05, 0.3) if chance(rng, 0.15) else 0.0,
    }


# --- game: few triangles, few meshes ---


def game_style(rng: np.random.Generator) -> Changes:
    """What game systems change about a modelling style."""
    return {
        **_round(rng, 6, 6, 8, 8, 10, 12, 16, by_size=0.2),
        **_bare(),
        **_grains(rng, 0.55, 0.35, 0.1),
        "hollow": chance(rng, 0.06),
        "flange": _one_of(rng, ring=0.55, slip=0.4, neck=0.05),
        "fasteners": _one_of(rng, none=0.6, set=0.25, flange=0.15),
        "spool": _one_of(rng, segments=0.5, bent=0.5),
        "merged": chance(rng, 0.45),
        "capped": chance(rng, 0.5),
        "soup": float(rng.choice([0.0, 0.0, 0.5, 1.0])),
        "cracks": float(rng.choice([0.0, 0.0, 0.1, 0.3])),
        "gap": (-num(rng, 0.0005, 0.004), 0.0) if chance(rng, 0.4) else (0.0, 0.0),
        "devices": _one_of(rng, primitives=0.55, built=0.45),
    }


def game_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that game systems draw in a style."""
    return {
        "joints": _span(rng, -0.005, 0.001) if chance(rng, 0.4) else None,
        "flipped": num(rng, 0.02, 0.2) if chance(rng, 0.2) else 0.0,
        "duplicates": num(rng, 0.0, 0.05) if chance(rng, 0.15) else 0.0,
        "mirrored": chance(rng, 0.3),
    }


# --- asset pack: a kit of pieces of one mesh each, put together ---


def asset_pack_style(rng: np.random.Generator) -> Changes:
    """What asset packs change about a modelling style."""
    return {
        **_round(rng, 8, 8, 10, 12, 12, 16, 20, 24, by_size=0.1),
        **_bare(),
        **_grains(rng, 0.7, 0.25, 0.05),
        "hollow": chance(rng, 0.3),
        "flange": _one_of(rng, ring=0.6, slip=0.3, neck=0.1),
        "fasteners": _one_of(rng, none=0.75, flange=0.25),
        "spool": "segments",
        "merged": chance(rng, 0.25),
        "capped": chance(rng, 0.5),
        "soup": float(rng.choice([0.0, 0.0, 0.5, 1.0])),
        "cracks": float(rng.choice([0.0, 0.0, 0.1])),
        "gap": (-num(rng, 0.0005, 0.004), 0.0) if chance(rng, 0.3) else (0.0, 0.0),
        "devices": _one_of(rng, primitives=0.85, built=0.15),
    }


def asset_pack_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that is put together from an asset pack in a style."""
    return {
        "joints": _span(rng, -0.008, 0.002) if chance(rng, 0.4) else None,
        "flipped": num(rng, 0.02, 0.2) if chance(rng, 0.1) else 0.0,
        "mirrored": chance(rng, 0.4),
    }


# --- scan: what was measured, fitted with shapes by eye ---


def scan_style(rng: np.random.Generator) -> Changes:
    """What scan systems change about a modelling style."""
    return {
        **_round(rng, 8, 10, 12, 12, 16, 20),
        **_bare(),
        **_grains(rng, 0.5, 0.35, 0.15),
        "hollow": False,
        "flange": _one_of(rng, ring=0.6, slip=0.3, neck=0.1),
        "wobble": num(rng, 0.0003, 0.002) if chance(rng, 0.8) else 0.0,
        "gap": (-num(rng, 0.0005, 0.004), num(rng, 0.0, 0.003)),
        "merged": chance(rng, 0.15),
        "rows": num(rng, 0.03, 0.2) if chance(rng, 0.2) else 0.0,
        "cracks": float(rng.choice([0.0, 0.0, 0.1])),
        "devices": _one_of(rng, primitives=0.45, built=0.55),
    }


def scan_defects(rng: np.random.Generator, _: ModelingStyle) -> Changes:
    """The defects of a plant that scan systems draw in a style."""
    return {
        "cut": num(rng, 0.1, 0.5) if chance(rng, 0.4) else 0.0,
        "incomplete": num(rng, 0.05, 0.3) if chance(rng, 0.4) else 0.0,
        "insulation": num(rng, 0.1, 0.4) if chance(rng, 0.2) else 0.0,
    }


# --- hobby: simple solids, exactly placed ---


def hobby_style(rng: np.random.Generator) -> Changes:
    """What hobby systems change about a modelling style."""
    coarse = chance(rng, 0.3)
    return {
        **(_round(rng, 6, 6, 8, by_size=0.0) if coarse else _round(rng, 16, 20, 24, 30, 32, 48, 72, 96, by_size=0.2)),
        **_grains(rng, 0.35, 0.25, 0.4),
        "hollow": chance(rng, 0.85),
        "flange": _one_of(rng, slip=0.55, ring=0.35, neck=0.1),
        "holes": not coarse and chance(rng, 0.6),
        "fasteners": _one_of(rng, none=0.55, bolt=0.2, pieces=0.15, set=0.1),
        "gaskets": chance(rng, 0.3),
        "spool": _one_of(rng, segments=0.75, bent=0.25),
        "fittings": _one_of(rng, long=0.35, smooth=0.65),
        "rows": num(rng, 0.04, 0.15) if chance(rng, 0.08) else 0.0,
        "devices": _one_of(rng, primitives=0.4, built=0.6),
    }


def hobby_defects(rng: np.random.Generator, style: ModelingStyle) -> Changes:
    """The defects of a plant that hobby systems draw in a style."""
    return {
        "setback": _span(rng, 0.003, 0.008) if style.hollow and chance(rng, 0.4) else None,
        "screwed": _span(rng, 0.0001, 0.0006) if chance(rng, 0.15) else None,
        "faces": _span(rng, 0.001, 0.003) if chance(rng, 0.15) else None,
        "mirrored": chance(rng, 0.2),
    }
