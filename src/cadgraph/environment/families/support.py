"""Further pipe supports, brackets, clamps and fasteners."""

from __future__ import annotations

from cadgraph.environment.families.support_arm import ARMS
from cadgraph.environment.families.support_bracket import BRACKETS
from cadgraph.environment.families.support_clamp import CLAMPS
from cadgraph.environment.families.support_couple import COUPLES
from cadgraph.environment.families.support_fastener import FASTENERS
from cadgraph.environment.families.support_gusset import GUSSETS
from cadgraph.environment.families.support_hanger import HANGERS
from cadgraph.environment.families.support_joint import JOINTS
from cadgraph.environment.families.support_mount import MOUNTS
from cadgraph.environment.families.support_sling import SLINGS
from cadgraph.environment.families.support_stand import STANDS
from cadgraph.environment.families.support_ubolt import U_BOLTS
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
