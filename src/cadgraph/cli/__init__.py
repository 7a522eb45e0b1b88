"""The command line: one command per verb, no logic; each module registers a few commands, in the order of the help."""

from __future__ import annotations

# isort: off
from cadgraph.cli import building as _building  # noqa: F401
from cadgraph.cli import viewing as _viewing  # noqa: F401
from cadgraph.cli import lvlm as _lvlm  # noqa: F401
from cadgraph.cli import labeling as _labeling  # noqa: F401
from cadgraph.cli import correcting as _correcting  # noqa: F401
from cadgraph.cli import reading as _reading  # noqa: F401
from cadgraph.cli import facts as _facts  # noqa: F401
from cadgraph.cli import functional as _functional  # noqa: F401
from cadgraph.cli import planning as _planning  # noqa: F401
from cadgraph.cli import simulating as _simulating  # noqa: F401
from cadgraph.cli import tasks as _tasks  # noqa: F401
from cadgraph.cli import agents as _agents  # noqa: F401
from cadgraph.cli import serving as _serving  # noqa: F401
from cadgraph.cli import ask as _ask  # noqa: F401

# isort: on
from cadgraph.cli.application import app, main

__all__ = ["app", "main"]
