"""Further tanks, exchangers, boilers, filters and separators."""

from __future__ import annotations

from cadgraph.environment.families.vessels.airware import AIRWARE
from cadgraph.environment.families.vessels.boilerware import BOILERWARE
from cadgraph.environment.families.vessels.boxware import BOXWARE
from cadgraph.environment.families.vessels.filterware import FILTERWARE
from cadgraph.environment.families.vessels.heatware import HEATWARE
from cadgraph.environment.families.vessels.pressware import PRESSWARE
from cadgraph.environment.families.vessels.separateware import SEPARATEWARE
from cadgraph.environment.families.vessels.smallware import SMALLWARE
from cadgraph.environment.families.vessels.storage import STORAGE
from cadgraph.environment.families.vessels.vesselbuild import VESSEL_BUILDS
from cadgraph.environment.families.vessels.warmware import WARMWARE
from cadgraph.environment.family import Family

__all__ = ["PLANTWARE"]

PLANTWARE: tuple[Family, ...] = (
    *VESSEL_BUILDS,
    *STORAGE,
    *PRESSWARE,
    *SMALLWARE,
    *HEATWARE,
    *WARMWARE,
    *BOILERWARE,
    *FILTERWARE,
    *AIRWARE,
    *SEPARATEWARE,
    *BOXWARE,
)
