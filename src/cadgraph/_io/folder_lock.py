"""A folder that one process works in while others leave it alone."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cadgraph.errors import OutputError

__all__ = ["folder_identity", "holding"]

_LOCK = ".cadgraph.lock"  # only where a folder itself can't be locked


@contextmanager
def holding(folder: str | Path) -> Iterator[None]:
    """Within the block no other process, and no other block, holds this folder.

    The system releases the lock when the process ends, however it ends. Where the file system has no locks (some
    network shares), nobody is kept out.

    Args:
        folder: it exists.

    Raises:
        OutputError: another one holds it.
    """
    lock = _take(Path(folder))
    try:
        yield
    finally:
        if lock is not None:
            os.close(lock)
            if sys.platform == "win32":
                # Fails where the next one holds it already, who then removes it.
                with suppress(OSError):
                    (Path(folder) / _LOCK).unlink()


def _take(folder: Path) -> int | None:
    """An open file that carries the lock; None where there are no locks."""
    try:
        if sys.platform == "win32":
            import msvcrt

            file = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT)
        else:
            import fcntl

            # The folder itself: nothing is left in it, and it may be on a disk that can't be written.
            file = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    try:
        if sys.platform == "win32":
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(file)
        if isinstance(error, BlockingIOError | PermissionError):
            raise OutputError(
                f"{folder}: another cadgraph is at work in it ('cadgraph view', or a build); end that one first"
            ) from None
        return None
    return file


def folder_identity(folder: str | Path) -> tuple[int, int] | None:
    """What tells a folder from another one under the same name, as an empty one where a disk was; None: no folder."""
    try:
        status = os.stat(folder)
    except OSError:
        return None
    return status.st_dev, status.st_ino
