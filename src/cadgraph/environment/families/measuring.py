"""Further gauges, thermometers, level and flow instruments."""

from __future__ import annotations

from cadgraph.environment.families.measuring_counter import COUNTER_BUILDS
from cadgraph.environment.families.measuring_flow import FLOW_BUILDS
from cadgraph.environment.families.measuring_gauge import GAUGE_BUILDS
from cadgraph.environment.families.measuring_heat import HEAT_BUILDS
from cadgraph.environment.families.measuring_level import LEVEL_BUILDS
from cadgraph.environment.families.measuring_panel import PANEL_BUILDS
from cadgraph.environment.families.measuring_pressure import PRESSURE_BUILDS
from cadgraph.environment.families.measuring_sight import SIGHT_BUILDS
from cadgraph.environment.families.measuring_siphon import SIPHON_BUILDS
from cadgraph.environment.family import Family

__all__ = ["MEASURING"]

MEASURING: tuple[Family, ...] = (
    *GAUGE_BUILDS,
    *PANEL_BUILDS,
    *SIPHON_BUILDS,
    *HEAT_BUILDS,
    *LEVEL_BUILDS,
    *PRESSURE_BUILDS,
    *FLOW_BUILDS,
    *COUNTER_BUILDS,
    *SIGHT_BUILDS,
)
"""The families of devices and structures that an assortment draws from."""
