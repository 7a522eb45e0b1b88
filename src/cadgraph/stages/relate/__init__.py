"""Functional relations: units, what follows what along the pipes, and in which direction it flows."""

from cadgraph.stages.relate.algorithm import find_units, pipe_systems, relate_units
from cadgraph.stages.relate.connect import connect_units
from cadgraph.stages.relate.edit_joints import FARTHEST
from cadgraph.stages.relate.edits import NetworkEdits, place_edits
from cadgraph.stages.relate.piping import RelateInput

__all__ = [
    "FARTHEST",
    "NetworkEdits",
    "RelateInput",
    "connect_units",
    "find_units",
    "pipe_systems",
    "place_edits",
    "relate_units",
]
