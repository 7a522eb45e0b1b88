"""All machines of plain shapes, as packs of models have them."""

from __future__ import annotations

from cadplants.families.machines.plain_circulators import PLAIN_SMALL
from cadplants.families.machines.plain_compressors import PLAIN_COMPRESSORS
from cadplants.families.machines.plain_hygienic import PLAIN_HYGIENIC
from cadplants.families.machines.plain_pumps import PLAIN_PUMPS
from cadplants.families.machines.plain_upright import PLAIN_UPRIGHT
from cadplants.model.family import Family

__all__ = ["PLAIN_MACHINES"]

PLAIN_MACHINES: tuple[Family, ...] = (*PLAIN_PUMPS, *PLAIN_UPRIGHT, *PLAIN_HYGIENIC, *PLAIN_SMALL, *PLAIN_COMPRESSORS)
