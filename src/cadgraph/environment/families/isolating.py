"""Further isolating and control valves: gate, globe, ball, butterfly, plug, diaphragm, pinch."""

from __future__ import annotations

from cadgraph.environment.families.isolating_ball import BALLS
from cadgraph.environment.families.isolating_control import CONTROLS
from cadgraph.environment.families.isolating_disc import DISCS
from cadgraph.environment.families.isolating_gate import GATES
from cadgraph.environment.families.isolating_globe import GLOBES
from cadgraph.environment.families.isolating_lining import LININGS
from cadgraph.environment.families.isolating_plug import PLUGS
from cadgraph.environment.families.isolating_sluice import SLUICES
from cadgraph.environment.families.isolating_union import UNIONS
from cadgraph.environment.family import Family

__all__ = ["ISOLATING"]

ISOLATING: tuple[Family, ...] = (*GATES, *SLUICES, *GLOBES, *CONTROLS, *BALLS, *UNIONS, *DISCS, *LININGS, *PLUGS)
