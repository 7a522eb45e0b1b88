"""The files that hold the rows of a large graph: how they are called, and which of them no graph needs any more."""

from __future__ import annotations

import re
from pathlib import Path

__all__ = ["FOLDER", "NAME", "sweep_shards"]

FOLDER = "graph-shards"
"""The folder beside ``graph.json`` that holds the shards."""
NAME = re.compile(r"[a-z_-]{1,40}-[0-9]{5,7}-[0-9a-f]{16}\.jsonl\.gz")
"""How a shard is called."""


def sweep_shards(graph: Path, *, of_whole: bool = False) -> None:
    """Removes the shards that a ``graph.json`` does not name: those of graphs before it.

    Args:
        graph: the file. Where it can't be read, all stay.
        of_whole: only beside a graph that names none. Beside one in shards those of the graph before it stay until the
            next one, for whoever has that open.
    """
    folder = graph.parent / FOLDER
    if not folder.is_dir() or folder.is_symlink():
        return
    try:
        text = graph.read_text(encoding="utf-8") if graph.is_file() else ""
    except (OSError, UnicodeDecodeError):
        return
    shards = [file for file in folder.iterdir() if NAME.fullmatch(file.name)]
    unnamed = [file for file in shards if file.name not in text]
    if of_whole and len(unnamed) < len(shards):
        return
    for file in unnamed:
        file.unlink(missing_ok=True)
    if not any(folder.iterdir()):
        folder.rmdir()
