"""Further pipe supports, brackets, clamps and fasteners."""

from __future__ import annotations

from cadgraph.environment.families.supports.arm import ARMS
from cadgraph.environment.families.supports.bracket import BRACKETS
from cadgraph.environment.families.supports.clamp import CLAMPS
from cadgraph.environment.families.supports.couple import COUPLES
from cadgraph.environment.families.supports.fastener import FASTENERS
from cadgraph.environment.families.supports.gusset import GUSSETS
from cadgraph.environment.families.supports.hanger import HANGERS
from cadgraph.environment.families.supports.joint import JOINTS
from cadgraph.environment.families.supports.mount import MOUNTS
from cadgraph.environment.families.supports.sling import SLINGS
from cadgraph.environment.families.supports.stand import STANDS
from cadgraph.environment.families.supports.ubolt import U_BOLTS
from cadgraph.environment.family import Family

__all__ = ["SUPPORTS"]

SUPPORTS: tuple[Family, ...] = (
    *U_BOLTS,
    *CLAMPS,
    *HANGERS,
    *STANDS,
    *GUSSETS,
    *FASTENERS,
    *BRACKETS,
    *MOUNTS,
    *ARMS,
    *SLINGS,
    *COUPLES,
    *JOINTS,
)
