"""Further tanks, exchangers, boilers, filters and separators."""

from __future__ import annotations

from cadgraph.environment.families.airware import AIRWARE
from cadgraph.environment.families.boilerware import BOILERWARE
from cadgraph.environment.families.boxware import BOXWARE
from cadgraph.environment.families.filterware import FILTERWARE
from cadgraph.environment.families.heatware import HEATWARE
from cadgraph.environment.families.pressware import PRESSWARE
from cadgraph.environment.families.separateware import SEPARATEWARE
from cadgraph.environment.families.smallware import SMALLWARE
from cadgraph.environment.families.storage import STORAGE
from cadgraph.environment.families.vesselbuild import VESSEL_BUILDS
from cadgraph.environment.families.warmware import WARMWARE
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
