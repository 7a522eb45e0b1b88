"""Further pipe fittings, flanges, couplings, joints and strainers."""

from __future__ import annotations

from cadgraph.environment.families.piping_bend import BENDS
from cadgraph.environment.families.piping_branch import BRANCHES
from cadgraph.environment.families.piping_coupling import COUPLINGS
from cadgraph.environment.families.piping_flange import FLANGINGS
from cadgraph.environment.families.piping_flexible import FLEXIBLES
from cadgraph.environment.families.piping_hose import HOSES
from cadgraph.environment.families.piping_reducer import REDUCERS
from cadgraph.environment.families.piping_special import SPECIALS
from cadgraph.environment.families.piping_strainer import STRAINERS
from cadgraph.environment.families.piping_union import UNIONS
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
