"""Further electrical and safety equipment."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["UTILITIES"]

UTILITIES: tuple[Family, ...] = ()
