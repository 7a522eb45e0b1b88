"""Labelling a finished graph anew: the same scene, settings and vocabulary, with another labeler."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config
from cadgraph.errors import FormatError, LabelError
from cadgraph.labelers.base import Labeler
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import GivenLabel
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.run import Outcome, run

__all__ = ["config_of", "find_source", "relabel"]


def relabel(
    folder: str | Path,
    config: Config,
    labeler: Labeler | None,
    *,
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Outcome:
    """Builds the graph in a folder again with another labeler; labels that were given from outside are kept.

    Args:
        folder: what ``cadgraph build`` wrote; written over.
        config: all settings, :func:`config_of` the folder with changes.
        labeler: the new one; the embedded one if None.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: told how far it is.

    Raises:
        LabelError: the source isn't there, or has changed.
        FormatError: the folder holds no graph.
    """
    graph = SceneGraph.load(folder)
    source = find_source(graph, Path(folder), scene)
    tree = Vocabulary.from_json(graph.document.vocabulary, f"{folder}: vocabulary of the graph")
    given = [
        GivenLabel(str(part.label.evidence.get("mesh", part.meshes[0])), part.label.group, part.label.name)
        for part in graph.parts()
        if part.label is not None and part.label.source == "author"
    ]
    return run(source, folder, config, labels=given, vocabulary=tree, labeler=labeler, report=report, progress=progress)


def config_of(folder: str | Path) -> Config:
    """The settings that the graph in a folder was built with.

    Raises:
        FormatError: the folder holds no graph, or one with settings that aren't known any more.
    """
    flat: dict[str, Any] = {}
    for name, value in SceneGraph.load(folder).document.config.items():
        if isinstance(value, dict):
            flat.update({f"{name}.{inner}": each for inner, each in value.items()})
        else:
            flat[name] = value
    try:
        return Config().replace(flat)
    except ValueError as error:
        raise FormatError(f"{folder}: its settings can't be used any more ({error}); build the graph anew") from error


def find_source(graph: SceneGraph, folder: Path, scene: str | Path | None) -> Path:
    """The file that a graph was built from, unchanged since.

    Args:
        graph: says where it was and what was in it.
        folder: that holds the graph; the file may lie there, too.
        scene: where it is now, if somebody knows better.

    Raises:
        LabelError: it isn't there, or has changed.
    """
    tried = [Path(scene)] if scene is not None else [Path(graph.source.path), folder / Path(graph.source.path).name]
    found = next((path for path in tried if path.is_file()), None)
    if found is None:
        raise LabelError(f"{tried[0]}: the scene isn't there; name it with --scene")
    if graph.source.sha256 and hashlib.sha256(found.read_bytes()).hexdigest() != graph.source.sha256:
        raise LabelError(f"{found}: changed since the graph was built; run 'cadgraph build' on it instead")
    return found
