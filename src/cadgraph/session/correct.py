"""Amending a finished graph: one part gets another label, others like it follow, and everything is built again."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cadgraph._io.progress import Progress, quiet
from cadgraph.errors import LabelError
from cadgraph.model.corrections import (
    CORRECTIONS,
    Correction,
    Fingerprint,
    read_corrections,
    with_correction,
    write_corrections,
)
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import split_label
from cadgraph.model.parts import Contacts, Guess, Label, Parts
from cadgraph.model.records import Part
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.relabel import config_of, relabel

__all__ = ["Amendment", "amend"]


@dataclass(frozen=True)
class Amendment:
    """What a correction changed.

    Args:
        outcome: of building anew, see ``cadgraph.session.run.Outcome``.
        part: that was corrected, as it is now.
        changed: all parts with another label than before, itself included, as they are now.
    """

    outcome: Any
    part: Part
    changed: tuple[Part, ...]


def amend(
    folder: str | Path,
    part: str,
    label: str | None,
    *,
    this_only: bool = False,
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Amendment:
    """Corrects the label of one part of a graph, and of others like it; the folder's results are written anew.

    The correction is kept in ``corrections.json`` beside the graph; a later build into the folder applies it again.

    Args:
        folder: what ``cadgraph build`` wrote.
        part: id of the part, or source path of one of its meshes.
        label: ``group/name``, a group, or a name that only one group has; None takes an earlier correction back.
        this_only: whether others keep their labels.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: told how far it is.

    Raises:
        ValueError: the graph has no such part, or there is no correction of it to take back.
        LabelError: the label is not in the graph's vocabulary; the source isn't there or has changed.
        FormatError: the folder holds no graph.
    """
    before = SceneGraph.load(folder)
    try:
        node = before.part(part)
    except KeyError:
        raise ValueError(
            f"{part}: no part of {folder} has this id or holds a mesh of this path; "
            "'cadgraph export --to csv' lists them"
        ) from None
    tree = Vocabulary.from_json(before.document.vocabulary, f"{folder}: vocabulary of the graph")
    file = (Path(folder) if Path(folder).is_dir() else Path(folder).parent) / CORRECTIONS
    old = read_corrections(file, tree)
    if label is not None:
        new = with_correction(old, _correction(node, split_label(label, tree), this_only))
    else:
        new = tuple(one for one in old if one.mesh not in node.meshes)
        if len(new) == len(old):
            raise ValueError(f"{part}: nobody corrected this part itself; 'cadgraph explain' names the one that was")
    config = config_of(folder)
    former = _Former(before) if config.lvlm.ask != "never" else None
    write_corrections(new, file)
    try:
        outcome = relabel(file.parent, config, former, scene=scene, report=report, progress=progress)
    except BaseException:
        # A correction that the graph does not show must not wait for a later build.
        if old:
            write_corrections(old, file)
        else:
            file.unlink(missing_ok=True)
        raise
    now = outcome.graph
    changed = tuple(p for p in now.parts() if _said(p) != _said_before(before, p))
    return Amendment(outcome, now.part(node.meshes[0]), changed)


def _correction(part: Part, label: tuple[str, str | None], this_only: bool) -> Correction:
    extents = part.obb.extents
    fingerprint = Fingerprint(part.n_triangles, (math.sqrt(part.area), extents[0], extents[1], extents[2]))
    return Correction(part.meshes[0], *label, fingerprint, part.centroid, this_only)


def _said(part: Part | None) -> tuple[str, str | None] | None:
    return (part.label.group, part.label.name) if part is not None and part.label is not None else None


def _said_before(graph: SceneGraph, part: Part) -> tuple[str, str | None] | None:
    try:
        return _said(graph.part(part.meshes[0]))
    except KeyError:
        return None


class _Former:
    """Labels that a vision-language model gave cost money: those of the graph are taken again, asking nobody."""

    least_confidence = 0.0
    """What was sure enough is so again."""

    def __init__(self, graph: SceneGraph) -> None:
        self._graph = graph

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Sequence[Label | None]:
        """Labels parts; see ``cadgraph.labelers.base.Labeler``."""
        return [self._former(parts.scene.paths[i]) for i in range(parts.n_parts)]

    def _former(self, mesh: str) -> Label | None:
        try:
            part = self._graph.part(mesh)
        except KeyError:
            return None
        label = part.label
        if label is not None and (label.source == "human" or "corrected" in label.evidence):
            old = label.evidence.get("before")
            if not isinstance(old, dict):
                return None
            try:
                evidence = {"why": old["why"]} if "why" in old else {}
                return Label(str(old["group"]), old["name"], float(old["confidence"]), str(old["source"]), evidence)
            except (KeyError, TypeError, ValueError) as error:
                raise LabelError(f"{mesh}: its former label is damaged; build the graph anew") from error
        if label is not None:
            if label.source in ("author", "catalog"):
                return None
            return Label(label.group, label.name, label.confidence, label.source, label.evidence)
        if not part.guesses:
            return None
        guesses = tuple(Guess(g.group, g.name, g.confidence) for g in part.guesses)
        # Less than any limit: it was no label, only a guess, and stays so.
        return Label(guesses[0].group, guesses[0].name, -1.0, "geometry", {}, guesses)
