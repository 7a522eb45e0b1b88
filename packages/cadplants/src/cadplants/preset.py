"""The plants that can be asked for by name."""

from __future__ import annotations

from collections.abc import Callable

from cadplants.assortment import make_assortment
from cadplants.defects import Sins, spoil
from cadplants.field import make_field
from cadplants.modeling_style import HANDS, Hand
from cadplants.plant import Plant
from cadplants.pumps import make_pumps
from cadplants.rack import make_rack
from cadplants.riser import make_riser
from cadplants.skid import make_skid
from cadplants.station import make_station
from cadplants.tank import make_tank

__all__ = ["PRESETS", "make"]

PRESETS: dict[str, Callable[[int, Hand | None], Plant]] = {
    "assortment": make_assortment,
    "field": make_field,
    "pumps": make_pumps,
    "rack": make_rack,
    "riser": make_riser,
    "skid": make_skid,
    "station": make_station,
    "tank": make_tank,
}


def make(preset: str, seed: int = 0, hand: str | None = None, sins: Sins | None = None) -> Plant:
    """Builds a plant.

    Args:
        preset: a key of ``PRESETS``.
        seed: of everything that varies.
        hand: a key of ``HANDS``; the preset's own choice by default.
        sins: what is spoilt; nothing by default.

    Raises:
        ValueError: an unknown preset or hand.
    """
    if preset not in PRESETS:
        raise ValueError(f"unknown preset {preset!r}; there are {', '.join(PRESETS)}")
    if hand is not None and hand not in HANDS:
        raise ValueError(f"unknown hand {hand!r}; there are {', '.join(HANDS)}")
    plant = PRESETS[preset](seed, HANDS[hand] if hand is not None else None)
    return spoil(plant, sins, seed) if sins is not None else plant
