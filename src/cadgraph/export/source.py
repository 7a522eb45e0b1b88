"""The file that a graph was made from, for exports that write a copy of it."""

from __future__ import annotations

import os
from pathlib import Path

from cadgraph._io.digest import sha256_of
from cadgraph.config import LoadConfig, restore_config
from cadgraph.errors import FormatError, LoadError, OutputError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene

__all__ = ["find_source", "refuse_source", "scene_of", "settings_of"]


def find_source(graph: SceneGraph, given: str | Path | None = None) -> Path:
    """The source file of a graph, once it is known to be the very one.

    Args:
        graph: says where it was and which bytes it had.
        given: where it is now; None: where it was.

    Raises:
        LoadError: it is missing or another one; the message says how to name the right one.
    """
    if given is None and not graph.source.path:
        raise LoadError("the graph doesn't say which file it was made from; give it with --source FILE")
    path = Path(given if given is not None else graph.source.path)
    try:
        if not path.is_file():
            raise LoadError(f"{path}: the file that the graph was made from is not there; give it with --source FILE")
        found = sha256_of(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise LoadError(f"{path}: can't be read ({reason}); give the graph's source with --source FILE") from error
    if graph.source.sha256 and found != graph.source.sha256:
        raise LoadError(
            f"{path}: not the file that the graph was made from (sha256 {found[:12]}..., but "
            f"{graph.source.sha256[:12]}... in the graph); give that one with --source FILE, or build the graph anew"
        )
    return path


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
