"""Functional relations: units, what follows what along the pipes, and in which direction it flows."""

from cadgraph.stages.relate.algorithm import find_units, pipe_systems, relate_units

__all__ = ["find_units", "pipe_systems", "relate_units"]
