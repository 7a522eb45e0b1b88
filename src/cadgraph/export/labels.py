"""What each source mesh is said to be, for exports that go back to the source; and the same as a table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from cadgraph._io.atomic import write_atomically
from cadgraph.export.tables import Row, table_bytes, table_cell
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part

__all__ = ["MeshLabel", "mesh_labels", "write_labels"]


class MeshLabel(NamedTuple):
    """What one source mesh is.

    Args:
        mesh: its source path.
        group: of the vocabulary.
        name: in that group, or None.
        confidence: 0..1.
        state: ``sure`` or ``likely``.
        source: who says so.
        part: id of the part that it belongs to.
        unit: id of the unit of that part, or None.
        tag: what people call that unit, or None.
    """

    mesh: str
    group: str
    name: str | None
    confidence: float
    state: str
    source: str
    part: str
    unit: str | None
    tag: str | None


def mesh_labels(graph: SceneGraph) -> Iterator[MeshLabel]:
    """The meshes of all labelled parts, in the order of the file."""
    for part in graph.of_layer(Part):
        label, unit = part.label, graph.unit_of(part)
        if label is None:
            continue
        for mesh in part.meshes:
            yield MeshLabel(
                mesh,
                label.group,
                label.name,
                label.confidence,
                label.state,
                label.source,
                part.id,
                unit.id if unit else None,
                unit.tag if unit else None,
            )


def write_labels(graph: SceneGraph, path: str | Path) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes the labels by source path as CSV, which ``cadgraph build --labels`` reads again.

    Columns are those of :class:`MeshLabel`. As in all tables, text that a spreadsheet would run as a formula gets an
    apostrophe in front.

    Args:
        graph: the finished graph.
        path: the file.

    Returns:
        The file, and notes: ``unlabelled`` names the meshes without a label, which have no row; ``changed-path`` those
        whose path can't stand in a table as it is, so that the row won't be found again.

    Raises:
        OutputError: it can't be written.
    """
    rows: list[Row] = [MeshLabel._fields, *mesh_labels(graph)]
    write_atomically(path, table_bytes(rows))
    bare = tuple(mesh for part in graph.of_layer(Part) if part.label is None for mesh in part.meshes)
    changed = tuple(
        str(row[0]) for row in rows[1:] if table_cell(row[0]) != row[0] or len(str(row[0]).splitlines()) > 1
    )
    notes = []
    if bare:
        notes.append(Diagnostic("unlabelled", "meshes without a label have no row", bare))
    if changed:
        notes.append(Diagnostic("changed-path", "meshes whose path can't stand in a table unchanged", changed))
    return Path(path), tuple(notes)
