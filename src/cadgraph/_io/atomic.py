"""Writing whole files or none: beside the target first, then renamed over it."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cadgraph.errors import OutputError

__all__ = ["ensure_writable", "replacing", "write_atomically"]


@contextmanager
def replacing(target: str | Path) -> Iterator[Path]:
    """A path beside the target to write to; it takes the target's place when the block ends well, else it is removed.

    The path keeps the target's suffix, which some libraries choose the format by.

    Raises:
        OutputError: the folder can't be made or written to.
    """
    final = Path(target)
    try:
        final.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=final.parent, prefix=f".{final.stem}-", suffix=final.suffix)
        os.close(handle)
    except OSError as error:
        raise OutputError(f"{final}: can't be written ({error.strerror}); choose another output folder") from error
    beside = Path(name)
    try:
        yield beside
        beside.chmod(0o666 & ~_umask())
        beside.replace(final)
    except OSError as error:
        raise OutputError(f"{final}: can't be written ({error.strerror}); choose another output folder") from error
    finally:
        beside.unlink(missing_ok=True)


def write_atomically(target: str | Path, content: str | bytes) -> None:
    """Writes a file whole or not at all; text as UTF-8 with line feeds on every system.

    Raises:
        OutputError: it can't be written.
    """
    with replacing(target) as beside:
        beside.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def ensure_writable(folder: str | Path) -> Path:
    """Makes a folder if needed and tries to write to it, so that a long run doesn't end in vain.

    Raises:
        OutputError: it can't be made or written to.
    """
    path = Path(folder)
    if path.exists() and not path.is_dir():
        raise OutputError(f"{path}: not a folder but a file; choose another output folder")
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        raise OutputError(f"{path}: can't write there ({error.strerror}); choose another output folder") from error
    return path
