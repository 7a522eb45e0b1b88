"""The file that a graph was built from, where it lies now."""

from __future__ import annotations

from pathlib import Path

from cadgraph._io.digest import sha256_of
from cadgraph.errors import LabelError
from cadgraph.model.records import SourceRecord

__all__ = ["find_source"]


def find_source(source: SourceRecord, folder: Path, scene: str | Path | None) -> Path:
    """The file that a graph was built from, unchanged since.

    Args:
        source: of the graph; says where it was and what was in it.
        folder: that holds the graph; the file may lie there, too.
        scene: where it is now, if somebody knows better.

    Raises:
        LabelError: it isn't there, or has changed.
    """
    tried = [Path(scene)] if scene is not None else [Path(source.path), folder / Path(source.path).name]
    found = next((path for path in tried if path.is_file()), None)
    if found is None:
        raise LabelError(f"{tried[0]}: the scene isn't there; name it with --scene")
    if source.sha256 and sha256_of(found) != source.sha256:
        raise LabelError(f"{found}: changed since the graph was built; run 'cadgraph build' on it instead")
    return found
