"""Files that a file names: buffers, material libraries. Only what lies in its own folder or below is opened."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath, PureWindowsPath

from cadgraph.errors import LoadError
from cadgraph.load.sandbox.signature import kind_of

__all__ = ["file_beside"]


def file_beside(path: Path, name: str) -> Path:
    """The file that another one names, if it may be opened.

    Args:
        path: of the file that names it.
        name: relative to the folder of ``path``, with either slash.

    Returns:
        A regular file within the folder of ``path``; links are followed first.

    Raises:
        LoadError: it is an address on the net, an absolute path, lies outside, is missing or no regular file.
    """
    shown = f"{name:.80}" + ("..." if len(name) > 80 else "")
    if re.match(r"[A-Za-z][A-Za-z0-9+.-]+:", name):
        raise LoadError(f"{path}: refers to {shown!r}; only files beside it are read, so put that file there")
    relative = PurePosixPath(name.replace("\\", "/"))
    if relative.is_absolute() or PureWindowsPath(name).drive or ".." in relative.parts:
        raise LoadError(f"{path}: refers to {shown!r} outside its folder, which is not opened; put that file beside it")
    try:
        found = (path.parent / relative).resolve()
        if not found.is_relative_to(path.parent.resolve()):
            raise LoadError(f"{path}: refers to {shown!r}, a link to outside its folder; put that file beside it")
        status = found.stat()
    except (OSError, ValueError, RuntimeError):
        raise LoadError(f"{path}: refers to {shown!r}, which is not there; put that file beside it") from None
    if not found.is_file():
        raise LoadError(f"{path}: refers to {shown!r}, which is {kind_of(status.st_mode)}; put a file there")
    return found
