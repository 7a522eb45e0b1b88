"""Further pipe supports, brackets, clamps and fasteners."""

from __future__ import annotations

from cadplants.families.supports.arm import ARMS
from cadplants.families.supports.bracket import BRACKETS
from cadplants.families.supports.clamp import CLAMPS
from cadplants.families.supports.couple import COUPLES
from cadplants.families.supports.fastener import FASTENERS
from cadplants.families.supports.gusset import GUSSETS
from cadplants.families.supports.hanger import HANGERS
from cadplants.families.supports.joint import JOINTS
from cadplants.families.supports.mount import MOUNTS
from cadplants.families.supports.sling import SLINGS
from cadplants.families.supports.stand import STANDS
from cadplants.families.supports.ubolt import U_BOLTS
from cadplants.model.family import Family

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
