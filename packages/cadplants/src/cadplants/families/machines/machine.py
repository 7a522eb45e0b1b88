"""Further pumps, blowers, compressors and their drives."""

from __future__ import annotations

from cadplants.families.machines.air import AIR
from cadplants.families.machines.column_pumps import SPECIAL
from cadplants.families.machines.compressor import COMPRESSORS
from cadplants.families.machines.displacing import DISPLACING
from cadplants.families.machines.fired import FIRED
from cadplants.families.machines.metering import SMALL
from cadplants.families.machines.plain import PLAIN_MACHINES
from cadplants.families.machines.rotary import ROTARY
from cadplants.families.machines.wheels import WHEELS
from cadplants.model.family import Family

__all__ = ["MACHINES"]

MACHINES: tuple[Family, ...] = (
    *ROTARY,
    *SPECIAL,
    *WHEELS,
    *DISPLACING,
    *SMALL,
    *AIR,
    *COMPRESSORS,
    *FIRED,
    *PLAIN_MACHINES,
)
