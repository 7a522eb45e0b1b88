"""Further pipe supports, brackets, clamps and fasteners."""

from __future__ import annotations

from cadgraph.environment.family import Family

__all__ = ["SUPPORTS"]

SUPPORTS: tuple[Family, ...] = ()
