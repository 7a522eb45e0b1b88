"""Reading in a process of its own, so that a library that crashes on a damaged file takes nobody down."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.limits import NOTE, read_text_within
from cadgraph._io.search_path import search_path
from cadgraph._io.text import printable
from cadgraph.errors import LoadError, MissingExtra
from cadgraph.load.sandbox.exchange import read_scene
from cadgraph.load.sandbox.memory import allowed_bytes
from cadgraph.load.sandbox.trouble import Trouble, in_words, trouble_in, trouble_of
from cadgraph.model.scene import Scene

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read_isolated"]

_STDERR_LIMIT = 100_000  # bytes of the child's messages that are looked at
_PREFIX = "cadgraph-"
_LOCK = "lock"


def read_isolated(module: str, file: Path, given: str, config: LoadConfig) -> Scene:
    """Runs ``module.read(file, config)`` in a new Python process.

    The process gets this one's module search path, and a temporary folder for its results that is gone afterwards,
    also when reading is interrupted. It ends by itself, and clears that folder, when this process is killed.

    Args:
        module: the name of a loader module.
        file: what to read.
        given: its path as the user gave it, for messages.
        config: how to read it.

    Returns:
        The scene.

    Raises:
        LoadError: the file can't be read, the process crashed, or it took longer than ``config.timeout``.
        MissingExtra: what the file holds needs a package that isn't installed.
    """
    memory = allowed_bytes(config.memory)
    try:
        with _exchange_folder() as folder:
            return _read_in(folder, module, file, given, config, memory)
    except OSError as error:
        trouble = trouble_of(error)
        reason = f"can't write to a temporary folder ({error.strerror or error}); set TMPDIR to one that takes files"
        if trouble is not None:
            reason = in_words(trouble, tempfile.gettempdir(), memory)
        raise LoadError(f"{given}: {reason}") from error


def _read_in(folder: Path, module: str, file: Path, given: str, config: LoadConfig, memory: int | None) -> Scene:
    """As :func:`read_isolated`, by way of a folder.

    Raises:
        OSError: something can't be written to the folder.
    """
    request = {
        "module": module,
        "path": str(file.absolute()),
        "config": config.model_dump(),
        "memory": memory,
    }
    (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
    code = _run(folder, given, config.timeout)
    if (folder / "error.json").exists() and code not in list(Trouble):
        said = _told(folder, given)
        if isinstance(said, list):
            raise MissingExtra(*said)
        raise LoadError(_with_given_path(said, file, given))
    if code != 0:
        raise LoadError(f"{given}: {_reason(code, folder / 'stderr.txt', memory)}")
    try:
        return read_scene(folder)
    except (OSError, EOFError, ValueError, KeyError, TypeError) as error:
        raise LoadError(f"{given}: the reading process left no whole result ({error})") from error


def _told(folder: Path, given: str) -> str | list[str]:
    """The error that the reading process left: its text, or purpose and name of an extra that is missing."""
    try:
        said = json.loads(read_text_within(folder / "error.json", NOTE, LoadError, "export the file again"))
        return [str(word) for word in said[:2]] if isinstance(said, list) and len(said) == 2 else str(said)
    except ValueError:
        raise LoadError(f"{given}: reading it failed; the file is likely damaged, export it again") from None


def _run(folder: Path, given: str, timeout: float) -> int:
    if not sys.executable:
        raise LoadError(f"{given}: no Python executable is known to read it in; set load.isolate = false")
    # -P: a file called numpy.py beside the user's CAD files must not be imported.
    command = [sys.executable, "-P", "-m", "cadgraph.load.sandbox.child", str(folder)]
    with (folder / "stderr.txt").open("wb") as stderr:
        try:
            process = subprocess.Popen(
                command,
                # Nothing is ever written there: the child learns from its end that this process is gone.
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=stderr,
                env=_environment(folder),
            )
        except OSError as error:
            raise LoadError(
                f"{given}: can't start a process to read it in ({error.strerror}); set load.isolate = false"
            ) from error
        # A timer, because to wait with a time limit means to look every 50 ms.
        late = threading.Event()

        def give_up() -> None:
            late.set()
            process.kill()

        timer = threading.Timer(timeout, give_up)
        timer.daemon = True
        try:
            timer.start()
            code = process.wait()
        finally:
            timer.cancel()
            process.kill()
            process.wait()
            if process.stdin is not None:
                process.stdin.close()
    if late.is_set():
        raise LoadError(f"{given}: reading took longer than {timeout:g} s; raise load.timeout if the file is sound")
    return code


@contextmanager
def _exchange_folder() -> Iterator[Path]:
    """A temporary folder that is locked as long as this process lives, after those of killed processes are cleared."""
    _clear_abandoned(Path(tempfile.gettempdir()))
    with (
        tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True) as name,
        (Path(name) / f"{_LOCK}.part").open("wb") as lock,
    ):
        # It gets its name when it is locked: another process that clears up would take one that is not for abandoned.
        if _try_to_lock(lock.fileno()):
            os.rename(lock.name, Path(name) / _LOCK)
        yield Path(name)


def _clear_abandoned(scratch: Path) -> None:
    """Removes our own folders whose lock nobody holds; where the system has no such locks, none."""
    if sys.platform == "win32":
        return
    with suppress(OSError), os.scandir(scratch) as found:
        for entry in found:
            if not entry.name.startswith(_PREFIX):
                continue
            with suppress(OSError):
                if not entry.is_dir(follow_symlinks=False) or entry.stat(follow_symlinks=False).st_uid != os.getuid():
                    continue
                lock = os.open(Path(entry.path) / _LOCK, os.O_RDWR | os.O_NOFOLLOW)
                try:
                    if _try_to_lock(lock):
                        shutil.rmtree(entry.path, ignore_errors=True)
                finally:
                    os.close(lock)


def _try_to_lock(file: int) -> bool:
    """Takes a lock that ends with the process; False where another one holds it or there are none."""
    try:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (ImportError, OSError):
        return False
    return True


def _environment(folder: Path) -> dict[str, str]:
    # USD writes a stack trace into the temporary folder when it dies; ours is cleaned up.
    scratch = dict.fromkeys(("TMPDIR", "TMP", "TEMP"), str(folder))
    return os.environ | scratch | {"PYTHONPATH": search_path(), "PYTHONUTF8": "1"}


def _with_given_path(message: str, file: Path, given: str) -> str:
    return message.replace(str(file.absolute()), given)


def _reason(code: int, stderr: Path, memory: int | None) -> str:
    with stderr.open("rb") as file:
        file.seek(max(0, stderr.stat().st_size - _STDERR_LIMIT))
        said = file.read().decode("utf-8", "replace").strip()
    trouble = Trouble(code) if code in list(Trouble) else trouble_in(said)
    if trouble is not None:
        return in_words(trouble, tempfile.gettempdir(), memory)
    if code < 0:
        try:
            what = signal.Signals(-code).name
        except ValueError:
            what = f"signal {-code}"
        if what == "SIGKILL":
            return "reading it was ended by the system, likely for want of memory; close other programs or split it"
        return f"reading it crashed ({what}); the file is likely damaged, export it again"
    lines = said.splitlines()
    last = printable(lines[-1])[:300].strip() if lines else f"exit code {code}"
    return f"reading it failed ({last}); the file is likely damaged, export it again"
