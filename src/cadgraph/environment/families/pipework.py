"""Further pipe fittings, flanges, couplings, joints and strainers."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["PIPEWORK"]

PIPEWORK: tuple[Family, ...] = ()
