"""Further electrical and safety equipment."""

from __future__ import annotations

from cadgraph.environment.families.utility_fire import FIRE
from cadgraph.environment.families.utility_hydrant import HYDRANTS
from cadgraph.environment.families.utility_light import LIGHTS
from cadgraph.environment.families.utility_panel import PANELS
from cadgraph.environment.families.utility_tray import TRAYS
from cadgraph.environment.families.utility_view import VIEWS
from cadgraph.environment.families.utility_wiring import WIRING
from cadgraph.environment.family import Family

__all__ = ["UTILITIES"]

UTILITIES: tuple[Family, ...] = (*TRAYS, *WIRING, *PANELS, *LIGHTS, *VIEWS, *FIRE, *HYDRANTS)
