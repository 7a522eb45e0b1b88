"""A folder that one process works in while others leave it alone."""

from __future__ import annotations

import json
import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from cadgraph._io.text import printable
from cadgraph.errors import OutputError

__all__ = ["LOCK", "folder_identity", "holding"]

LOCK = ".cadgraph.lock"
"""Says who is at work in a folder, while somebody is. On Windows, where no folder can be locked, it is the
lock, too."""

_FAR = 1 << 30  # the byte of it that is locked on Windows, behind all that others read
_LONGEST = 4096  # bytes of it that are read
_PROC_LOCKS = Path("/proc/locks")


@contextmanager
def holding(folder: str | Path) -> Iterator[None]:
    """Within the block no other process, and no other block, holds this folder.

    The system releases the lock when the process ends, however it ends; what a killed one left is taken over. Where
    the file system has no locks (some network shares), nobody is kept out.

    Args:
        folder: it exists.

    Raises:
        OutputError: another one holds it; the message names the process, where that can be known.
    """
    lock = _take(Path(folder))
    try:
        yield
    finally:
        if lock is not None:
            if sys.platform != "win32":
                _remove_note(Path(folder))
            os.close(lock)
            if sys.platform == "win32":
                # Fails where the next one holds it already, who then removes it.
                with suppress(OSError):
                    (Path(folder) / LOCK).unlink()


def _take(folder: Path) -> int | None:
    """An open file that carries the lock; None where there are no locks."""
    try:
        if sys.platform == "win32":
            import msvcrt

            file = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT)
        else:
            import fcntl

            # The folder itself, as it may be on a disk that can't be written.
            file = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    try:
        if sys.platform == "win32":
            os.lseek(file, _FAR, os.SEEK_SET)
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
            os.lseek(file, 0, os.SEEK_SET)
            os.ftruncate(file, 0)
            os.write(file, _note())
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            _leave_note(folder)
    except OSError as error:
        holder = _holder(folder)
        os.close(file)
        if isinstance(error, BlockingIOError | PermissionError):
            raise OutputError(
                f"{folder}: another cadgraph is at work in it ({holder or 'a build, or cadgraph view'}); end that one "
                "first"
            ) from None
        return None
    return file


def _note() -> bytes:
    """Who this process is. What follows the command may be nobody's business, and is left out."""
    program = Path(sys.argv[0]) if sys.argv and sys.argv[0] else Path("python")
    name = program.parent.name if program.name == "__main__.py" else program.name
    verb = next((word for word in sys.argv[1:2] if word.isalpha()), "")
    return json.dumps({"pid": os.getpid(), "command": f"{name} {verb}".strip(), "host": socket.gethostname()}).encode()


def _leave_note(folder: Path) -> None:
    """Writes who is at work here; a file of this name was left by somebody who is no more."""
    with suppress(OSError):
        (folder / LOCK).unlink(missing_ok=True)
        # Never through a link that somebody put there.
        file = os.open(folder / LOCK, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            os.write(file, _note())
        finally:
            os.close(file)


def _remove_note(folder: Path) -> None:
    # Another folder may stand in the place of this one by now.
    if _noted(folder).get("pid") == os.getpid():
        with suppress(OSError):
            (folder / LOCK).unlink(missing_ok=True)


def _noted(folder: Path) -> dict[str, Any]:
    """What the note in a folder says; nothing where there is none that can be read."""
    try:
        with (folder / LOCK).open("rb") as file:
            said = json.loads(file.read(_LONGEST))
    except (OSError, ValueError, RecursionError):
        return {}
    return said if isinstance(said, dict) and isinstance(said.get("pid"), int) else {}


def _holder(folder: Path) -> str:
    """The process that holds a folder, in words; empty where it can't be known."""
    said = _noted(folder) if not (folder / LOCK).is_symlink() else {}
    here = said.get("host") in (None, socket.gethostname())
    known = _locked_by(folder)
    if known is not None and (known != said.get("pid") or not here):
        # The system knows better than a note that somebody left who was killed.
        return _named(known, _command_of(known))
    if not said or (here and not _runs(said["pid"])):
        return ""
    return _named(said["pid"], str(said.get("command", "")), "" if here else f" on {said['host']}")


def _named(pid: int, command: str, where: str = "") -> str:
    if pid == os.getpid() and not where:
        return "this very process"
    shown = printable(f"process {pid}{where}{f', {command}' if command else ''}")
    return shown[:200]


def _locked_by(folder: Path) -> int | None:
    """The process that holds the lock of a folder, where the system tells: on Linux."""
    try:
        status = folder.stat()
        rows = _PROC_LOCKS.read_text(encoding="ascii").splitlines()
        place = f"{os.major(status.st_dev):02x}:{os.minor(status.st_dev):02x}:{status.st_ino}"
    except (OSError, ValueError, AttributeError):
        return None
    for row in rows:
        words = row.split()
        # "3: FLOCK ADVISORY WRITE 4711 fe:00:2155035 0 EOF"; one who waits has "->" after the number.
        if len(words) == 8 and words[1] == "FLOCK" and words[5] == place and words[4].isdigit() and int(words[4]) > 0:
            return int(words[4])
    return None


def _command_of(pid: int) -> str:
    """The program that a process runs, and its verb."""
    try:
        words = Path(f"/proc/{pid}/cmdline").read_text(encoding="utf-8", errors="replace").split("\0")
    except OSError:
        return ""
    names = [Path(word).name for word in words if word and not word.startswith("-")]
    start = 1 if len(names) > 1 and names[0].startswith("python") else 0
    return " ".join(names[start : start + 2] if names[start : start + 1] == ["cadgraph"] else names[start : start + 1])


def _runs(pid: int) -> bool:
    """Whether there is such a process on this machine; on Windows, where asking would end it, whoever is noted does."""
    if sys.platform == "win32":
        return True
    try:
        os.kill(pid, 0)
    except PermissionError:
        return True
    except (OSError, OverflowError):
        return False
    return True


def folder_identity(folder: str | Path) -> tuple[int, int] | None:
    """What tells a folder from another one under the same name, as an empty one where a disk was; None: no folder."""
    try:
        status = os.stat(folder)
    except OSError:
        return None
    return status.st_dev, status.st_ino
