"""Further electrical and safety equipment."""

from __future__ import annotations

from cadplants.families.utilities.fire import FIRE
from cadplants.families.utilities.hydrant import HYDRANTS
from cadplants.families.utilities.light import LIGHTS
from cadplants.families.utilities.panel import PANELS
from cadplants.families.utilities.tray import TRAYS
from cadplants.families.utilities.view import VIEWS
from cadplants.families.utilities.wiring import WIRING
from cadplants.model.family import Family

__all__ = ["UTILITIES"]

UTILITIES: tuple[Family, ...] = (*TRAYS, *WIRING, *PANELS, *LIGHTS, *VIEWS, *FIRE, *HYDRANTS)
