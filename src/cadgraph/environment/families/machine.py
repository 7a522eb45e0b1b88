"""Further pumps, blowers, compressors and their drives."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["MACHINES"]

MACHINES: tuple[Family, ...] = ()
