"""Further gauges, thermometers, level and flow instruments."""

from __future__ import annotations

from cadplants.families.instruments.counter import COUNTER_BUILDS
from cadplants.families.instruments.flow import FLOW_BUILDS
from cadplants.families.instruments.gauge import GAUGE_BUILDS
from cadplants.families.instruments.heat import HEAT_BUILDS
from cadplants.families.instruments.level import LEVEL_BUILDS
from cadplants.families.instruments.panel import PANEL_BUILDS
from cadplants.families.instruments.plain import PLAIN_INSTRUMENTS
from cadplants.families.instruments.pressure import PRESSURE_BUILDS
from cadplants.families.instruments.sight import SIGHT_BUILDS
from cadplants.families.instruments.siphons import SIPHONS
from cadplants.model.family import Family

__all__ = ["MEASURING"]

MEASURING: tuple[Family, ...] = (
    *GAUGE_BUILDS,
    *PANEL_BUILDS,
    *SIPHONS,
    *HEAT_BUILDS,
    *LEVEL_BUILDS,
    *PRESSURE_BUILDS,
    *FLOW_BUILDS,
    *COUNTER_BUILDS,
    *SIGHT_BUILDS,
    *PLAIN_INSTRUMENTS,
)
"""The families of devices and structures that an assortment draws from."""
