"""Where files are written that are to come into a folder together: beside their places, until all of them are there."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

__all__ = ["NEXT", "READY", "redirecting", "result_path", "staged_path"]

NEXT = ".cadgraph-next"
"""The folder within a folder that holds what is being written; worth nothing until it is complete."""
READY = ".cadgraph-ready"
"""The same folder once it is complete: what is in it counts, and not what it takes the place of."""

_FOLDER: ContextVar[str | None] = ContextVar("cadgraph_staged_folder", default=None)


@contextmanager
def redirecting(folder: Path) -> Iterator[None]:
    """Within the block, what this thread writes into a folder goes into the folder ``NEXT`` in it instead.

    Args:
        folder: it exists. A block within a block takes the place of the outer one.
    """
    token = _FOLDER.set(os.path.realpath(folder))
    try:
        yield
    finally:
        _FOLDER.reset(token)


def staged_path(path: Path) -> Path:
    """Where a file is to be written now: the path itself, or its place in the folder ``NEXT``."""
    folder = _FOLDER.get()
    if folder is None:
        return path
    place = Path(os.path.realpath(path.parent)) / path.name
    if not place.is_relative_to(folder):
        return path
    return Path(folder, NEXT, place.relative_to(folder))


def result_path(path: str | Path) -> Path:
    """Where a file lies that is read now, which may not have been moved to its place yet.

    Args:
        path: its place. The file need not be there.

    Returns:
        What this thread wrote last, if it is still to come with other files; else what is complete and only not moved
        yet; else the path itself.
    """
    place = Path(path)
    staged = staged_path(place)
    if staged != place and staged.exists():
        return staged
    ready = place.parent / READY / place.name
    # Never through a link that somebody put there.
    return ready if ready.is_file() and not ready.parent.is_symlink() else place
