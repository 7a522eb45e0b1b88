"""Further pumps, blowers, compressors and their drives."""

from __future__ import annotations

from cadgraph.environment.families.machine_air import AIR
from cadgraph.environment.families.machine_compressor import COMPRESSORS
from cadgraph.environment.families.machine_displacing import DISPLACING
from cadgraph.environment.families.machine_fired import FIRED
from cadgraph.environment.families.machine_rotary import ROTARY
from cadgraph.environment.families.machine_small import SMALL
from cadgraph.environment.families.machine_special import SPECIAL
from cadgraph.environment.families.machine_wheels import WHEELS
from cadgraph.environment.family import Family

__all__ = ["MACHINES"]

MACHINES: tuple[Family, ...] = (*ROTARY, *SPECIAL, *WHEELS, *DISPLACING, *SMALL, *AIR, *COMPRESSORS, *FIRED)
