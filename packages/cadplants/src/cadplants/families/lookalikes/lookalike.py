"""All families whose parts are easily taken for those of others."""

from __future__ import annotations

from cadplants.families.lookalikes.plates import PLATES_ALIKE
from cadplants.families.lookalikes.rails import RAILS_ALIKE
from cadplants.families.lookalikes.spindles import SPINDLES_ALIKE
from cadplants.model.family import Family

__all__ = ["LOOKALIKES"]

LOOKALIKES: dict[str, Family] = {family.name: family for family in (*RAILS_ALIKE, *SPINDLES_ALIKE, *PLATES_ALIKE)}
"""By name, none of which is one of the other families'."""
