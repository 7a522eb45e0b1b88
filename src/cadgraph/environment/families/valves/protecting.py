"""Further check, relief, vent and small valves."""

from __future__ import annotations

from cadgraph.environment.families.valves.block import BLOCKS
from cadgraph.environment.families.valves.check import CHECKS
from cadgraph.environment.families.valves.cock import COCKS
from cadgraph.environment.families.valves.heating import HEATING
from cadgraph.environment.families.valves.regulate import REGULATORS
from cadgraph.environment.families.valves.relief import RELIEFS
from cadgraph.environment.families.valves.station import STATIONS
from cadgraph.environment.families.valves.vent import VENTS
from cadgraph.environment.family import Family

__all__ = ["PROTECTING"]

PROTECTING: tuple[Family, ...] = (*CHECKS, *RELIEFS, *VENTS, *REGULATORS, *COCKS, *STATIONS, *BLOCKS, *HEATING)
