"""Filling a catalogue: with the parts of CAD files, or with parts of finished graphs that somebody has labelled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from cadgraph.config import Config
from cadgraph.errors import LabelError, LoadError
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.load import load
from cadgraph.model.catalog import Catalog, Entry
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.source_file import find_source
from cadgraph.pipeline import analyse
from cadgraph.session.reopen import config_of
from cadgraph.stages.preprocess import prepare_scene

__all__ = ["EMPTY", "Intake", "take_file", "take_graph"]

EMPTY = Catalog((), Scene.from_meshes([]))
"""A catalogue without entries."""

_SURE = ("human", "author")
"""Sources of the labels in a graph that are taken without being asked for."""


@dataclass(frozen=True)
class Intake:
    """What became of a file's parts.

    Args:
        catalog: with the new entries.
        n_parts: that were looked at.
        added: new entries.
        known: how many shapes the catalogue had under the same label, or were repeats of each other.
        replaced: entries whose shape has another label now.
        torn: how many shapes have several labels there, so that none was taken.
    """

    catalog: Catalog
    n_parts: int
    added: tuple[Entry, ...]
    known: int
    replaced: tuple[Entry, ...]
    torn: int = 0


def take_file(
    catalog: Catalog, file: str | Path, group: str, name: str | None, merge: bool = False, config: Config | None = None
) -> Intake:
    """Adds the parts of a CAD file under one label, each distinct shape once.

    Args:
        catalog: to add to.
        file: anything that ``load`` reads. Its meshes are grouped into parts as ``build`` does it.
        group: of the label.
        name: of the label, or None.
        merge: one entry of the whole file instead, for a device that plants hold as one mesh.
        config: how the file is read and grouped.

    Raises:
        LoadError: the file can't be read, or holds no surface.
    """
    config = (config or Config()).replace({"ground.find": "none"})
    analysis = analyse(load(file, config.load), config)
    area = analysis.properties.area
    if not analysis.scene.n_meshes or not float(np.nansum(area)) > 0:
        raise LoadError(f"{file}: holds no surface that could be a part; look at it in a viewer")
    shapes = analysis.parts.scene
    if merge:
        scene = analysis.scene
        shapes = scene.merge(np.zeros(scene.n_meshes, np.int64), [int(np.nan_to_num(area).argmax())])
    rows = [Entry("", group, name, Path(file).name, path) for path in shapes.paths]
    return _taken(catalog, shapes, rows)


def take_graph(
    catalog: Catalog,
    folder: str | Path,
    only: tuple[str, str | None] | None = None,
    label: tuple[str, str | None] | None = None,
    scene: str | Path | None = None,
) -> Intake:
    """Adds parts of a finished graph with their labels; their shapes are read from the source again.

    Args:
        catalog: to add to.
        folder: what ``cadgraph build`` wrote.
        only: parts with this label, whoever gave it (a group without a name: all of the group); else all parts
            labelled from outside or corrected by hand.
        label: another label for all of them.
        scene: the source, where it isn't where the graph says.

    Raises:
        LabelError: no part has such a label.
        LoadError: the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    graph = SceneGraph.load(folder)
    chosen = [part for part in graph.parts() if _is_wanted(part, only)]
    if not chosen:
        what = "is labelled so" if only else "has a label from outside or a correction"
        raise LabelError(f"{folder}: no part {what}; name a label that its parts have with --only 'group/name'")
    torn = _torn_shapes(graph, chosen) if label is None else frozenset()
    kept = [part for part in chosen if part.shape not in torn]
    if not kept:
        return Intake(catalog, len(chosen), (), 0, (), len(torn))
    source = find_source(graph.source, Path(folder), scene, "--scene")
    shapes = _shapes_of(kept, source, config_of(folder))
    taken = _taken(catalog, shapes, [_entry(part, source, label) for part in kept])
    return replace(taken, n_parts=len(chosen), torn=taken.torn + len(torn))


def _torn_shapes(graph: SceneGraph, chosen: Sequence[Part]) -> frozenset[str]:
    """The shapes of chosen parts that other parts have under another label, of which the labeler is sure."""
    said: dict[str, set[tuple[str, str | None]]] = {}
    for part in chosen:
        said.setdefault(part.shape, set()).update([part.label.said] if part.label is not None else [])
    for part in graph.parts():
        if part.shape in said and part.label is not None and not part.label.likely:
            said[part.shape].add(part.label.said)
    return frozenset(shape for shape, labels in said.items() if len(labels) > 1)


def _shapes_of(parts: Sequence[Part], source: Path, config: Config) -> Scene:
    """The shapes of parts of a graph, read from its source again."""
    whole, _ = prepare_scene(load(source, config.load))
    rank = {path: i for i, path in enumerate(whole.paths)}
    lost = next((part.meshes[0] for part in parts if not rank.keys() >= set(part.meshes)), None)
    if lost is not None:
        raise LabelError(f"{source}: has no mesh {lost!r} any more; build the graph anew")
    counts = [len(part.meshes) for part in parts]
    meshes = [rank[mesh] for part in parts for mesh in part.meshes]
    return whole.select(meshes).merge(np.repeat(np.arange(len(parts)), counts), np.cumsum([0, *counts[:-1]]))


def _entry(part: Part, source: Path, label: tuple[str, str | None] | None) -> Entry:
    """What the catalogue says of a part: the label that is given for all, else its own."""
    said = label or (part.label.said if part.label is not None else ("", None))
    said_by = "user" if label or part.label is None else part.label.source
    return Entry("", *said, source.name, part.meshes[0], said_by)


def _is_wanted(part: Part, only: tuple[str, str | None] | None) -> bool:
    if part.label is None:
        return False
    if only is None:
        return part.label.source in _SURE
    return part.label.group == only[0] and only[1] in (None, part.label.name)


def _taken(catalog: Catalog, shapes: Scene, rows: Sequence[Entry]) -> Intake:
    """The catalogue with one entry for each new shape; the latest label of a shape counts."""
    fresh = Catalog.of(shapes, rows)
    whole = catalog.joined(fresh)
    properties = measure(whole.shapes)
    shape = find_shapes(whole.shapes, properties).shape.tolist()
    n = len(catalog.entries)
    first = {k: i for i, k in reversed(list(enumerate(shape[:n])))}
    kept = dict.fromkeys(range(n))
    added: dict[int, int] = {}
    known, replaced = 0, []
    said: dict[int, set[tuple[str, str | None]]] = {}
    for i in range(n, len(whole.entries)):
        said.setdefault(shape[i], set()).add(_label_of(whole.entries[i]))
    torn = {k for k, labels in said.items() if len(labels) > 1}
    for i in range(n, len(whole.entries)):
        usable = properties.area[i] > 0 and np.isfinite(properties.centroid[i]).all()
        if not usable or shape[i] in torn:
            continue
        old = first.get(shape[i])
        repeated = old is not None and _label_of(whole.entries[old]) == _label_of(whole.entries[i])
        if shape[i] in added or repeated:
            known += 1
        else:
            if old is not None:
                replaced.append(whole.entries[old])
                del kept[old]
                del first[shape[i]]
            added[shape[i]] = i
    chosen = [*kept, *sorted(added.values())]
    new = tuple(whole.entries[i] for i in sorted(added.values()))
    return Intake(whole.select(chosen), len(rows), new, known, tuple(replaced), len(torn))


def _label_of(entry: Entry) -> tuple[str, str | None]:
    return entry.group, entry.name
