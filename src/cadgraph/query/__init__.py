"""Questions to the functional graph: the line list, what lies along the pipes, what isolates a unit, what closing does.

All functions are pure: a finished :class:`~cadgraph.model.graph.SceneGraph` in, frozen values out.
"""

from __future__ import annotations

from cadgraph.query.compare import Comparison, compare
from cadgraph.query.doubt import Doubt
from cadgraph.query.explain_connection import ConnectionExplanation, explain_connection
from cadgraph.query.explain_unit import UnitExplanation, explain_unit
from cadgraph.query.isolate import Closing, Isolation, Opening, Passed, find_isolation
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.network import Arc, Network
from cadgraph.query.trace import Halt, Return, Step, Trace, find_way, trace
from cadgraph.query.what_if import Consequence, WhatIf, what_if

__all__ = [
    "Arc",
    "Closing",
    "Comparison",
    "ConnectionExplanation",
    "Consequence",
    "Doubt",
    "Halt",
    "Isolation",
    "Line",
    "Network",
    "Opening",
    "Passed",
    "Return",
    "Step",
    "Trace",
    "UnitExplanation",
    "WhatIf",
    "compare",
    "explain_connection",
    "explain_unit",
    "find_isolation",
    "find_lines",
    "find_way",
    "trace",
    "what_if",
]
