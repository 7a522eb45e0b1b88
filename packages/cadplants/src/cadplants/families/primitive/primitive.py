"""All families of devices and structures of primitives."""

from __future__ import annotations

from cadplants.families.primitive.asset_fittings import KIT_FITTINGS
from cadplants.families.primitive.asset_tank import KIT_TANKS
from cadplants.families.primitive.asset_valves import KIT_VALVES
from cadplants.families.primitive.fittings import PRIMITIVE_FITTINGS
from cadplants.families.primitive.instruments import PRIMITIVE_INSTRUMENTS
from cadplants.families.primitive.machines import PRIMITIVE_MACHINES
from cadplants.families.primitive.pieces import PRIMITIVE_PIECES
from cadplants.families.primitive.pumps import PRIMITIVE_PUMPS
from cadplants.families.primitive.steel import PRIMITIVE_STEEL
from cadplants.families.primitive.utilities import PRIMITIVE_UTILITIES
from cadplants.families.primitive.valves import PRIMITIVE_VALVES
from cadplants.model.family import Family

__all__ = ["KITS", "PRIMITIVES"]

KITS: tuple[Family, ...] = (*KIT_FITTINGS, *KIT_TANKS, *KIT_VALVES)
"""Pieces of asset packs, each of one mesh with its flanges, collars or ferrules: whole plants are made of them, and
other systems know them as strangers only."""

PRIMITIVES: dict[str, Family] = {
    family.name: family
    for family in (
        *PRIMITIVE_VALVES,
        *KIT_VALVES,
        *PRIMITIVE_FITTINGS,
        *KIT_FITTINGS,
        *KIT_TANKS,
        *PRIMITIVE_INSTRUMENTS,
        *PRIMITIVE_PUMPS,
        *PRIMITIVE_MACHINES,
        *PRIMITIVE_PIECES,
        *PRIMITIVE_STEEL,
        *PRIMITIVE_UTILITIES,
    )
}
"""By name, none of which is one of the other families'."""
