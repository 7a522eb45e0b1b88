"""Further pipe fittings, flanges, couplings, joints and strainers."""

from __future__ import annotations

from cadplants.families.piping.bar_stock import SPECIALS
from cadplants.families.piping.bend import BENDS
from cadplants.families.piping.branch import BRANCHES
from cadplants.families.piping.clamp_saddle import CLAMP_SADDLES
from cadplants.families.piping.coupling import COUPLINGS
from cadplants.families.piping.flange import FLANGINGS
from cadplants.families.piping.flexible import FLEXIBLES
from cadplants.families.piping.hose import HOSES
from cadplants.families.piping.hose_coupling import HOSE_COUPLINGS
from cadplants.families.piping.hygienic import HYGIENIC
from cadplants.families.piping.reducer import REDUCERS
from cadplants.families.piping.strainer import STRAINERS
from cadplants.families.piping.union import UNIONS
from cadplants.model.family import Family

__all__ = ["PIPEWORK"]

PIPEWORK: tuple[Family, ...] = (
    *BENDS,
    *BRANCHES,
    *STRAINERS,
    *COUPLINGS,
    *UNIONS,
    *SPECIALS,
    *FLANGINGS,
    *FLEXIBLES,
    *HOSES,
    *REDUCERS,
    *HYGIENIC,
    *HOSE_COUPLINGS,
    *CLAMP_SADDLES,
)
