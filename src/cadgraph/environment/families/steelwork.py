"""Further structures: frames, access, fences, foundations."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["STEELWORK"]

STEELWORK: tuple[Family, ...] = ()
