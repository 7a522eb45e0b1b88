"""The file that a graph was made from, for exports that write a copy of it."""

from __future__ import annotations

import os
from pathlib import Path

from cadgraph.config import LoadConfig, restore_config
from cadgraph.errors import FormatError, OutputError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene

__all__ = ["refuse_source", "scene_of", "settings_of"]


def refuse_source(source: Path, target: Path) -> None:
    """Makes sure that a copy doesn't take the place of what it is made from.

    Raises:
        OutputError: it would.
    """
    if os.path.realpath(source) == os.path.realpath(target):
        raise OutputError(f"{target}: this is the source, which stays untouched; choose another output file")


def settings_of(graph: SceneGraph) -> LoadConfig:
    """How the source of a graph was read.

    Raises:
        FormatError: with settings that aren't known any more.
    """
    try:
        return restore_config(graph.config).load
    except ValueError as error:
        raise FormatError(f"the graph's settings can't be used any more ({error}); build the graph anew") from error


def scene_of(graph: SceneGraph, source: str | Path) -> Scene:
    """Reads the source of a graph again, as it was read when the graph was made.

    Raises:
        FormatError: it was read with settings that aren't known any more.
        LoadError: it can't be read.
    """
    from cadgraph.load import load

    return load(source, settings_of(graph))
