"""Further pumps, blowers, compressors and their drives."""

from __future__ import annotations

from cadgraph.environment.families.machines.air import AIR
from cadgraph.environment.families.machines.compressor import COMPRESSORS
from cadgraph.environment.families.machines.displacing import DISPLACING
from cadgraph.environment.families.machines.fired import FIRED
from cadgraph.environment.families.machines.rotary import ROTARY
from cadgraph.environment.families.machines.small import SMALL
from cadgraph.environment.families.machines.special import SPECIAL
from cadgraph.environment.families.machines.wheels import WHEELS
from cadgraph.environment.family import Family

__all__ = ["MACHINES"]

MACHINES: tuple[Family, ...] = (*ROTARY, *SPECIAL, *WHEELS, *DISPLACING, *SMALL, *AIR, *COMPRESSORS, *FIRED)
