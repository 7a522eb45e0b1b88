"""Further structures: frames, access, fences, foundations."""

from __future__ import annotations

from cadgraph.environment.families.steel_beam import BEAMS
from cadgraph.environment.families.steel_brace import BRACES
from cadgraph.environment.families.steel_caster import CASTERS
from cadgraph.environment.families.steel_civil import CIVIL
from cadgraph.environment.families.steel_climb import CLIMBS
from cadgraph.environment.families.steel_column import COLUMNS
from cadgraph.environment.families.steel_fence import FENCES
from cadgraph.environment.families.steel_floor import FLOORS
from cadgraph.environment.families.steel_ground import GROUNDS
from cadgraph.environment.families.steel_rail import RAILS
from cadgraph.environment.families.steel_skid import SKIDS
from cadgraph.environment.families.steel_stair import STAIRS
from cadgraph.environment.family import Family

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
