"""The folder that a run writes its results to: what in it is ours, and what must stay."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cadgraph._io.atomic import ensure_writable
from cadgraph._io.folder_lock import holding
from cadgraph._io.manifest import CORRECTIONS, GRAPH_FILE, MANIFEST, MARK, RESULTS
from cadgraph._io.results import new_results, settle, sweep_next
from cadgraph._io.staging import result_path, staged_path
from cadgraph.errors import OutputError

__all__ = [
    "RESULTS",
    "at_work_in",
    "coming_into",
    "one_of_results",
    "refuse_foreign",
    "refuse_to_overwrite",
    "results_folder",
    "sweep",
    "tidy",
]

_MARKS = {
    GRAPH_FILE: b'"cadgraph"',
    MANIFEST: MARK.encode(),
    "semantics.usda": b"cadgraph",
    "report.html": b"cadgraph",
    "simulation.usda": b"cadgraph",
}
_HEAD = 100_000  # bytes in which a mark stands; the styles of a report come before its first words


@contextmanager
def at_work_in(folder: str | Path) -> Iterator[Path]:
    """A folder that can be written to and that nobody else writes to; what a killed process began is ended first.

    When the block fails and the folder didn't exist before, it is gone again unless something was written.

    Raises:
        OutputError: it can't be made or written to, or another process is at work in it.
    """
    target = Path(folder)
    made = [path for path in (target, *target.parents) if not path.exists()]
    try:
        ensure_writable(target)
        with holding(target):
            tidy(target)
            yield target
    except BaseException:
        for path in made:
            with suppress(OSError):
                path.rmdir()
        raise


@contextmanager
def results_folder(folder: str | Path) -> Iterator[Path]:
    """As :func:`at_work_in`; nothing of others lies in the folder that a run would write over.

    Raises:
        OutputError: likewise, or it holds a file of somebody else under the name of a result.
    """
    with at_work_in(folder) as target:
        refuse_foreign(target)
        yield target


@contextmanager
def coming_into(folder: str | Path, graph: str | None = None) -> Iterator[Path]:
    """What the block writes into a folder comes into it together, when the block ends well; nobody else writes there.

    Within a block on the same folder it is part of that one.

    Args:
        folder: made if missing.
        graph: digest of the ``graph.json`` that the files are made of; None: of that which stands in the folder.

    Raises:
        OutputError: it can't be made or written to, or another process is at work in it.
    """
    target = Path(folder)
    if staged_path(target / GRAPH_FILE) != target / GRAPH_FILE:
        yield target
        return
    with at_work_in(target), new_results(target, graph=graph):
        yield target


@contextmanager
def one_of_results(path: Path, graph: str | None = None) -> Iterator[None]:
    """What the block writes to a path renews the manifest of its folder, if that is one of results; else it is a file.

    Args:
        path: of the file.
        graph: as of :func:`coming_into`.

    Raises:
        OutputError: another process is at work in the folder of results, or it can't be written.
    """
    if staged_path(path) != path or not (result_path(path.parent / MANIFEST)).is_file() or path.name not in RESULTS:
        yield
        return
    with at_work_in(path.parent) as folder, new_results(folder, graph=graph):
        yield


def tidy(folder: Path) -> None:
    """Ends what a process began that was killed: what was complete comes to its places, all else goes.

    Args:
        folder: that nobody else is at work in.

    Raises:
        OutputError: a file can't be replaced.
    """
    settle(folder)
    sweep_next(folder)
    sweep(folder)


def sweep(folder: Path) -> None:
    """Removes what a run left that was killed while it wrote a file; see ``cadgraph._io.atomic``.

    Args:
        folder: that nobody else is at work in.
    """
    for name in (*RESULTS, CORRECTIONS):
        stem, suffix = os.path.splitext(name)
        for stale in folder.glob(f".{stem}-????????{suffix}"):
            with suppress(OSError):
                stale.unlink()


def refuse_to_overwrite(folder: Path, files: Iterable[str | Path], what: str) -> None:
    """Makes sure that no result takes the place of one of these files.

    Args:
        folder: where the results go.
        files: paths that must stay as they are.
        what: they are, for the message.

    Raises:
        OutputError: a result would replace one of them.
    """
    kept = {os.path.realpath(file) for file in files}
    for name in RESULTS:
        if os.path.realpath(folder / name) in kept:
            raise OutputError(f"{folder / name}: this is {what}, which stays untouched; choose another output folder")


def refuse_foreign(folder: Path) -> None:
    """Makes sure that nothing of others stands in a folder where a result goes.

    What bears our mark is ours. In a folder that holds any such file, what has no mark of its own is ours, too, and a
    file of nothing is what a loss of power left of a result; beside a manifest the graph is ours whatever it holds.

    Raises:
        OutputError: a file of somebody else has the name of a result.
    """
    there = [folder / name for name in (MANIFEST, *RESULTS) if (folder / name).exists()]
    for path in there:
        if path.is_dir():
            raise OutputError(f"{path}: a folder stands where a result goes; choose another output folder")
    marked = {path.name for path in there if path.name in _MARKS and _MARKS[path.name] in _head_of(path)}
    vouched = marked | ({GRAPH_FILE} if MANIFEST in marked else set())
    for path in there:
        # Some file systems leave zeros in place of what had not reached the disk.
        is_rest = path.name not in _MARKS or not _head_of(path).strip(b"\0")
        if path.name not in vouched and not (marked and is_rest):
            raise OutputError(f"{path}: not written by cadgraph, so it is left alone; choose another output folder")


def _head_of(path: Path) -> bytes:
    """The start of a file; of a pipe or a device words that bear no mark."""
    try:
        if not path.is_file():
            return b"never read"
        with path.open("rb") as file:
            return file.read(_HEAD)
    except OSError as error:
        raise OutputError(f"{path}: can't be read ({error.strerror}); choose another output folder") from error
