"""Further isolating and control valves: gate, globe, ball, butterfly, plug, diaphragm, pinch."""

from __future__ import annotations

from cadgraph.environment.families.valves.ball import BALLS
from cadgraph.environment.families.valves.control import CONTROLS
from cadgraph.environment.families.valves.disc import DISCS
from cadgraph.environment.families.valves.gate import GATES
from cadgraph.environment.families.valves.globe import GLOBES
from cadgraph.environment.families.valves.lining import LININGS
from cadgraph.environment.families.valves.plug import PLUGS
from cadgraph.environment.families.valves.sluice import SLUICES
from cadgraph.environment.families.valves.union import UNIONS
from cadgraph.environment.family import Family

__all__ = ["ISOLATING"]

ISOLATING: tuple[Family, ...] = (*GATES, *SLUICES, *GLOBES, *CONTROLS, *BALLS, *UNIONS, *DISCS, *LININGS, *PLUGS)
