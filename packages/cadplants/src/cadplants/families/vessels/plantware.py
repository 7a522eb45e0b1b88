"""Further tanks, exchangers, boilers, filters and separators."""

from __future__ import annotations

from cadplants.families.vessels.boilers import BOILERS
from cadplants.families.vessels.boxware import BOXWARE
from cadplants.families.vessels.dry_filters import DRY_FILTERS
from cadplants.families.vessels.filterware import FILTERWARE
from cadplants.families.vessels.heatware import HEATWARE
from cadplants.families.vessels.pressware import PRESSWARE
from cadplants.families.vessels.separateware import SEPARATEWARE
from cadplants.families.vessels.smallware import SMALLWARE
from cadplants.families.vessels.storage import STORAGE
from cadplants.families.vessels.vesselbuild import VESSEL_BUILDS
from cadplants.families.vessels.warmware import WARMWARE
from cadplants.family import Family

__all__ = ["PLANTWARE"]

PLANTWARE: tuple[Family, ...] = (
    *VESSEL_BUILDS,
    *STORAGE,
    *PRESSWARE,
    *SMALLWARE,
    *HEATWARE,
    *WARMWARE,
    *BOILERS,
    *FILTERWARE,
    *DRY_FILTERS,
    *SEPARATEWARE,
    *BOXWARE,
)
