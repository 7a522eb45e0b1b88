"""Further isolating and control valves: gate, globe, ball, butterfly, plug, diaphragm, pinch."""

from __future__ import annotations

from cadplants.families.valves.ball import BALLS
from cadplants.families.valves.control import CONTROLS
from cadplants.families.valves.disc import DISCS
from cadplants.families.valves.gate import GATES
from cadplants.families.valves.globe import GLOBES
from cadplants.families.valves.lining import LININGS
from cadplants.families.valves.plug import PLUGS
from cadplants.families.valves.sluice import SLUICES
from cadplants.families.valves.union import UNIONS
from cadplants.model.family import Family

__all__ = ["ISOLATING"]

ISOLATING: tuple[Family, ...] = (*GATES, *SLUICES, *GLOBES, *CONTROLS, *BALLS, *UNIONS, *DISCS, *LININGS, *PLUGS)
