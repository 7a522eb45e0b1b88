"""Labels from outside laid over those of a labeler."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph.config import LabelConfig
from cadgraph.errors import LabelError
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.labels import GivenEvidence, Label
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Scene

__all__ = ["apply_given"]


def apply_given(
    labels: Sequence[Label | None],
    given: Sequence[GivenLabel],
    scene: Scene,
    parts: Parts,
    config: LabelConfig,
) -> tuple[tuple[Label | None, ...], tuple[Diagnostic, ...]]:
    """Lays labels from outside over those of the labeler; a part takes that of its largest labelled mesh.

    Args:
        labels: of each part so far.
        given: labels of source meshes.
        scene: the source meshes.
        parts: made from them, each part's meshes the largest first.
        config: whether given labels overrule.

    Returns:
        The labels of each part, and what is to be reported.

    Raises:
        LabelError: a label names a mesh that is not in the scene.
    """
    rank = {path: i for i, path in enumerate(scene.paths)}
    by_mesh: dict[int, GivenLabel] = {}
    for label in given:
        if label.mesh not in rank:
            raise LabelError(
                f"{label.file or 'labels'}: {label.mesh!r} is not a mesh of {scene.source.path or 'the scene'}; "
                "remove the row or correct its path"
            )
        by_mesh[rank[label.mesh]] = label
    result = list(labels)
    outvoted: list[str] = []
    for part, meshes in enumerate(parts.meshes):
        found = [by_mesh[mesh] for mesh in meshes if mesh in by_mesh]
        if not found or (result[part] is not None and not config.overrule):
            continue
        first = found[0]
        result[part] = Label(first.group, first.name, 1.0, "author", GivenEvidence(mesh=first.mesh))
        outvoted += [label.mesh for label in found if (label.group, label.name) != (first.group, first.name)]
    if not outvoted:
        return tuple(result), ()
    message = "meshes with another given label than the largest mesh of their part, whose label counts"
    return tuple(result), (Diagnostic("label-outvoted", message, tuple(outvoted)),)
