"""What a reader notes where geometry of a file is lost, and the refusal of such a file."""

from __future__ import annotations

from cadgraph.errors import LoadError
from cadgraph.model.scene import Scene

__all__ = ["LOST_GEOMETRY", "refuse_losses"]

LOST_GEOMETRY = frozenset({
    "broken-chunk", "broken-element", "broken-facet", "broken-mesh", "broken-node", "broken-object", "broken-primitive",
    "cut-short", "damaged-entity", "damaged-source", "empty-mesh", "flat-transform", "invalid-face-counts",
    "invalid-indices", "invalid-instancer", "invalid-points", "invalid-size", "invalid-transform",
    "missing-layer", "missing-object", "missing-payload", "missing-prototype", "missing-reference",
    "outside-asset", "projective-transform", "too-deep", "too-far",
    "trailing-bytes", "unbalanced-tree", "unknown-chunk",
    "unreadable", "unsupported-geometry",
})  # fmt: skip
"""Codes of notes by which something that a file draws, or refers to, is not in the scene as it is drawn.

What is left out by a setting (hidden meshes, other purposes, lines, volumes of insulation) is not lost, nor is what is
nothing that is built (the volumes of rooms, drawn frames, marks of welds), nor a mesh without any area.
"""

_MOST_TOLD = 3


def refuse_losses(scene: Scene, given: str) -> None:
    """Refuses a scene that lacks some of its file.

    Args:
        scene: as it was read.
        given: the file's path, for the message.

    Raises:
        LoadError: something is lost.
    """
    lost = [note for note in scene.diagnostics if note.code in LOST_GEOMETRY]
    if not lost:
        return
    told = "; ".join(
        f"{note.code}: {note.message}{f' ({note.meshes[0]})' if note.meshes else ''}" for note in lost[:_MOST_TOLD]
    )
    more = f"; and {len(lost) - _MOST_TOLD} more kinds" if len(lost) > _MOST_TOLD else ""
    raise LoadError(f"{given}: not all of it can be read, and --strict refuses that: {told}{more}")
