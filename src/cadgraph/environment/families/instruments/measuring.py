"""Further gauges, thermometers, level and flow instruments."""

from __future__ import annotations

from cadgraph.environment.families.instruments.counter import COUNTER_BUILDS
from cadgraph.environment.families.instruments.flow import FLOW_BUILDS
from cadgraph.environment.families.instruments.gauge import GAUGE_BUILDS
from cadgraph.environment.families.instruments.heat import HEAT_BUILDS
from cadgraph.environment.families.instruments.level import LEVEL_BUILDS
from cadgraph.environment.families.instruments.panel import PANEL_BUILDS
from cadgraph.environment.families.instruments.pressure import PRESSURE_BUILDS
from cadgraph.environment.families.instruments.sight import SIGHT_BUILDS
from cadgraph.environment.families.instruments.siphon import SIPHON_BUILDS
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
