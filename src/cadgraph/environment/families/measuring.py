"""Further gauges, thermometers, level and flow instruments."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["MEASURING"]

MEASURING: tuple[Family, ...] = ()
