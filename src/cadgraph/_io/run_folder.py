"""The folder that a run writes its results to: what in it is ours, and what must stay."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cadgraph._io.atomic import ensure_writable
from cadgraph._io.folder_lock import holding
from cadgraph.errors import OutputError

__all__ = ["RESULTS", "clear_results", "refuse_foreign", "refuse_to_overwrite", "results_folder", "sweep"]

RESULTS = (
    *("scene.usdc", "semantics.usda", "report.html", "picture.png", "timings.json"),
    *("simulation.usda", "devices.json", "graph.json"),
)
"""All files that a run may write, and what is written of its graph later. The graph vouches for those without a mark
of their own, so it goes last."""

_CORRECTIONS = "corrections.json"
_MARKS = {
    "graph.json": b'"cadgraph"',
    "semantics.usda": b"cadgraph",
    "report.html": b"cadgraph",
    "simulation.usda": b"cadgraph",
}
_HEAD = 100_000  # bytes in which a mark stands; the styles of a report come before its first words


@contextmanager
def results_folder(folder: str | Path) -> Iterator[Path]:
    """A folder that can be written to and holds nothing of others that a run would write over; nobody else writes.

    When the block fails and the folder didn't exist before, it is gone again unless something was written.

    Raises:
        OutputError: it can't be made or written to, holds a file of somebody else under the name of a result, or
            another process is at work in it.
    """
    target = Path(folder)
    made = [path for path in (target, *target.parents) if not path.exists()]
    try:
        ensure_writable(target)
        with holding(target):
            refuse_foreign(target)
            sweep(target)
            yield target
    except BaseException:
        for path in made:
            with suppress(OSError):
                path.rmdir()
        raise


def clear_results(folder: Path, names: Iterable[str] = RESULTS) -> None:
    """Removes the results of earlier runs, so that the folder never mixes two scenes, even if this run is killed.

    Args:
        folder: that holds them.
        names: of the files to remove.

    Raises:
        OutputError: a file can't be removed.
    """
    for name in names:
        path = folder / name
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise OutputError(
                f"{path}: can't be replaced ({error.strerror}); close what holds it or choose another folder"
            ) from error


def sweep(folder: Path) -> None:
    """Removes what a run left that was killed while it wrote a file; see ``cadgraph._io.atomic``.

    Args:
        folder: that nobody else is at work in.
    """
    for name in (*RESULTS, _CORRECTIONS):
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

    Raises:
        OutputError: a file of somebody else has the name of a result.
    """
    ours = _is_marked(folder / "graph.json", _MARKS["graph.json"])
    for name in RESULTS:
        path = folder / name
        if path.is_dir():
            raise OutputError(f"{path}: a folder stands where a result goes; choose another output folder")
        if path.exists() and not (_is_marked(path, _MARKS[name]) if name in _MARKS else ours):
            raise OutputError(f"{path}: not written by cadgraph, so it is left alone; choose another output folder")


def _is_marked(path: Path, mark: bytes) -> bool:
    try:
        if not path.is_file():
            return False
        with path.open("rb") as file:
            return mark in file.read(_HEAD)
    except OSError as error:
        raise OutputError(f"{path}: can't be read ({error.strerror}); choose another output folder") from error
