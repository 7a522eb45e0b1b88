"""Further pipe fittings, flanges, couplings, joints and strainers."""

from __future__ import annotations

from cadgraph.environment.families.piping.bend import BENDS
from cadgraph.environment.families.piping.branch import BRANCHES
from cadgraph.environment.families.piping.coupling import COUPLINGS
from cadgraph.environment.families.piping.flange import FLANGINGS
from cadgraph.environment.families.piping.flexible import FLEXIBLES
from cadgraph.environment.families.piping.hose import HOSES
from cadgraph.environment.families.piping.reducer import REDUCERS
from cadgraph.environment.families.piping.special import SPECIALS
from cadgraph.environment.families.piping.strainer import STRAINERS
from cadgraph.environment.families.piping.union import UNIONS
from cadgraph.environment.family import Family

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
)
