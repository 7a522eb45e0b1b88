"""Further check, relief, vent and small valves."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["PROTECTING"]

PROTECTING: tuple[Family, ...] = ()
