"""Further electrical and safety equipment."""

from __future__ import annotations

from cadgraph.environment.families.utilities.fire import FIRE
from cadgraph.environment.families.utilities.hydrant import HYDRANTS
from cadgraph.environment.families.utilities.light import LIGHTS
from cadgraph.environment.families.utilities.panel import PANELS
from cadgraph.environment.families.utilities.tray import TRAYS
from cadgraph.environment.families.utilities.view import VIEWS
from cadgraph.environment.families.utilities.wiring import WIRING
from cadgraph.environment.family import Family

__all__ = ["UTILITIES"]

UTILITIES: tuple[Family, ...] = (*TRAYS, *WIRING, *PANELS, *LIGHTS, *VIEWS, *FIRE, *HYDRANTS)
