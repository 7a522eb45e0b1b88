"""Writing whole files or none: beside the target first, then renamed over it."""

from __future__ import annotations

import errno
import os
import secrets
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cadgraph._io.staging import staged_path
from cadgraph.errors import OutputError

__all__ = ["ensure_writable", "flush", "flush_folder", "replacing", "write_atomically"]

_TRIED = 1 << 16  # bytes: more than a file system keeps beside a name


@contextmanager
def replacing(target: str | Path, durable: bool = False) -> Iterator[Path]:
    """A path beside the target to write to; it takes the target's place when the block ends well, else it is removed.

    The path keeps the target's suffix, which some libraries choose the format by. A new file gets the modes that any
    new file gets, one that takes the place of another those of the other. Where files are to come into a folder
    together (``cadgraph._io.results``), the file waits for the others.

    Raises:
        OutputError: the folder can't be made or written to.
    """
    final = Path(target)
    there = staged_path(final)
    try:
        there.parent.mkdir(parents=True, exist_ok=True)
        beside = _make_beside(there, final)
    except OSError as error:
        raise OutputError(
            f"{final}: can't be written ({error.strerror or error}); choose another output folder"
        ) from error
    try:
        yield beside
        with suppress(FileNotFoundError):
            beside.chmod(stat.S_IMODE(final.stat().st_mode))
        if durable:
            flush(beside)
        beside.replace(there)
    except OSError as error:
        raise OutputError(
            f"{final}: can't be written ({error.strerror or error}); choose another output folder"
        ) from error
    finally:
        beside.unlink(missing_ok=True)
    if durable:
        flush_folder(there)


def write_atomically(target: str | Path, content: str | bytes, durable: bool = False) -> None:
    """Writes a file whole or not at all; text as UTF-8 with line feeds on every system.

    Args:
        target: the file.
        content: of it.
        durable: whether it is to be on the disk when this returns, so that no loss of power takes it back.

    Raises:
        OutputError: it can't be written.
    """
    with replacing(target, durable) as beside:
        beside.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


def flush(file: Path) -> None:
    """Waits until what was written to a file is on the disk.

    Raises:
        OSError: the disk reports that it couldn't.
    """
    # Windows flushes only what may be written to; elsewhere the file may be one that must not.
    with file.open("rb+" if sys.platform == "win32" else "rb") as opened:
        os.fsync(opened.fileno())


def flush_folder(file: Path) -> None:
    """Waits until the name of a file is on the disk, on systems and disks that can be asked for that.

    Raises:
        OutputError: the disk reports that it couldn't.
    """
    if not hasattr(os, "O_DIRECTORY"):
        return
    try:
        number = os.open(file.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(number)
        finally:
            os.close(number)
    except OSError as error:
        # Some shares flush files, but no folders; there is nothing better to be had.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.ENOSYS, errno.EACCES):
            raise OutputError(
                f"{file}: whether it stays written is not sure ({error.strerror or error}); look after the disk"
            ) from error


def _make_beside(there: Path, final: Path) -> Path:
    """An empty file of a new name beside ``there``, with the modes of the final file, else those of any new file.

    ``tempfile`` would make it private, and what the umask is can only be asked by changing it, for all threads.
    """
    # What is to be private is so from the first byte.
    modes = stat.S_IMODE(final.stat().st_mode) & 0o666 | 0o600 if final.exists() else 0o666
    while True:
        beside = there.with_name(f".{there.stem}-{secrets.token_hex(4)}{there.suffix}")
        with suppress(FileExistsError):
            os.close(os.open(beside, os.O_CREAT | os.O_EXCL | os.O_WRONLY, modes))
            return beside


def ensure_writable(folder: str | Path) -> Path:
    """Makes a folder if needed and tries to write to it, so that a long run doesn't end in vain.

    Raises:
        OutputError: it can't be made or written to, or the disk is full.
    """
    path = Path(folder)
    if path.exists() and not path.is_dir():
        raise OutputError(f"{path}: not a folder but a file; choose another output folder")
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path) as file:
            # A full disk takes names, but no bytes.
            file.write(bytes(_TRIED))
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise OutputError(
            f"{path}: can't write there ({error.strerror or error}); choose another output folder"
        ) from error
    return path
