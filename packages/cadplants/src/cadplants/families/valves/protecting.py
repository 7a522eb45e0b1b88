"""Further check, relief, vent and small valves."""

from __future__ import annotations

from cadplants.families.valves.block import BLOCKS
from cadplants.families.valves.check import CHECKS
from cadplants.families.valves.cock import COCKS
from cadplants.families.valves.heating import HEATING
from cadplants.families.valves.lid import LIDDED
from cadplants.families.valves.regulate import REGULATORS
from cadplants.families.valves.relief import RELIEFS
from cadplants.families.valves.service import SERVICE
from cadplants.families.valves.station import STATIONS
from cadplants.families.valves.tap import TAPS
from cadplants.families.valves.vent import VENTS
from cadplants.model.family import Family

__all__ = ["PROTECTING"]

PROTECTING: tuple[Family, ...] = (
    *CHECKS,
    *RELIEFS,
    *VENTS,
    *REGULATORS,
    *COCKS,
    *STATIONS,
    *BLOCKS,
    *HEATING,
    *LIDDED,
    *TAPS,
    *SERVICE,
)
