"""Further check, relief, vent and small valves."""

from __future__ import annotations

from cadgraph.environment.families.protecting_block import BLOCKS
from cadgraph.environment.families.protecting_check import CHECKS
from cadgraph.environment.families.protecting_cock import COCKS
from cadgraph.environment.families.protecting_heating import HEATING
from cadgraph.environment.families.protecting_regulate import REGULATORS
from cadgraph.environment.families.protecting_relief import RELIEFS
from cadgraph.environment.families.protecting_station import STATIONS
from cadgraph.environment.families.protecting_vent import VENTS
from cadgraph.environment.family import Family

__all__ = ["PROTECTING"]

PROTECTING: tuple[Family, ...] = (*CHECKS, *RELIEFS, *VENTS, *REGULATORS, *COCKS, *STATIONS, *BLOCKS, *HEATING)
