"""All families of vessels, exchangers, boilers, filters and separators but the common ones."""

from __future__ import annotations

from cadplants.families.vessels.boilers import BOILERS
from cadplants.families.vessels.building_vessels import BUILDING_VESSELS
from cadplants.families.vessels.dosing_tanks import DOSING_TANKS
from cadplants.families.vessels.dry_filters import DRY_FILTERS
from cadplants.families.vessels.exchangers import EXCHANGERS
from cadplants.families.vessels.filters import FILTERS
from cadplants.families.vessels.plain_boilers import PLAIN_BOILERS
from cadplants.families.vessels.plain_dryers import PLAIN_DRYERS
from cadplants.families.vessels.plate_stack import PLATE_STACKS
from cadplants.families.vessels.plate_tanks import PLATE_TANKS
from cadplants.families.vessels.pressure_vessels import PRESSURE_VESSELS
from cadplants.families.vessels.radiators import RADIATORS
from cadplants.families.vessels.separators import SEPARATORS
from cadplants.families.vessels.storage import STORAGE
from cadplants.families.vessels.vesselbuild import VESSEL_BUILDS
from cadplants.model.family import Family

__all__ = ["KINDS_OF_VESSELS"]

KINDS_OF_VESSELS: tuple[Family, ...] = (
    *VESSEL_BUILDS,
    *STORAGE,
    *PRESSURE_VESSELS,
    *BUILDING_VESSELS,
    *EXCHANGERS,
    *RADIATORS,
    *BOILERS,
    *FILTERS,
    *DRY_FILTERS,
    *SEPARATORS,
    *PLATE_TANKS,
    *PLATE_STACKS,
    *PLAIN_DRYERS,
    *PLAIN_BOILERS,
    *DOSING_TANKS,
)
