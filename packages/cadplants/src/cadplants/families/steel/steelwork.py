"""Further structures: frames, access, fences, foundations."""

from __future__ import annotations

from cadplants.families.steel.beam import BEAMS
from cadplants.families.steel.brace import BRACES
from cadplants.families.steel.caster import CASTERS
from cadplants.families.steel.civil import CIVIL
from cadplants.families.steel.climb import CLIMBS
from cadplants.families.steel.column import COLUMNS
from cadplants.families.steel.fence import FENCES
from cadplants.families.steel.floor import FLOORS
from cadplants.families.steel.ground import GROUNDS
from cadplants.families.steel.rail import RAILS
from cadplants.families.steel.skid import SKIDS
from cadplants.families.steel.stair import STAIRS
from cadplants.model.family import Family

__all__ = ["STEELWORK"]

STEELWORK: tuple[Family, ...] = (
    *BEAMS,
    *COLUMNS,
    *BRACES,
    *CASTERS,
    *SKIDS,
    *RAILS,
    *CLIMBS,
    *STAIRS,
    *FLOORS,
    *FENCES,
    *CIVIL,
    *GROUNDS,
)
