"""Further structures: frames, access, fences, foundations."""

from __future__ import annotations

from cadgraph.environment.families.steel.beam import BEAMS
from cadgraph.environment.families.steel.brace import BRACES
from cadgraph.environment.families.steel.caster import CASTERS
from cadgraph.environment.families.steel.civil import CIVIL
from cadgraph.environment.families.steel.climb import CLIMBS
from cadgraph.environment.families.steel.column import COLUMNS
from cadgraph.environment.families.steel.fence import FENCES
from cadgraph.environment.families.steel.floor import FLOORS
from cadgraph.environment.families.steel.ground import GROUNDS
from cadgraph.environment.families.steel.rail import RAILS
from cadgraph.environment.families.steel.skid import SKIDS
from cadgraph.environment.families.steel.stair import STAIRS
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
