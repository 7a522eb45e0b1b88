"""Files that belong together come into a folder together: whatever ends the process, all of them are there or none.

They are written into the folder ``.cadgraph-next`` within the folder. Once all are complete, with ``manifest.json``,
that one is renamed to ``.cadgraph-ready``: from this moment on they count. Then each is moved to its place, the
manifest last. Where a process is ended in between, whoever opens the folder next completes the move, or reads from
``.cadgraph-ready`` what is not moved yet.

The manifest names each file with its digest and the graph that it was made of, so that a reader knows what was changed
by others, or shows an earlier graph.
"""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from cadgraph._io.atomic import flush, flush_folder
from cadgraph._io.digest import sha256_of
from cadgraph._io.folder_lock import holding
from cadgraph._io.manifest import CORRECTIONS, GRAPH_FILE, MANIFEST, RESULTS, Entry, Manifest, manifest_in
from cadgraph._io.shard_files import sweep_shards
from cadgraph._io.staging import NEXT, READY, redirecting
from cadgraph.errors import FormatError, OutputError

__all__ = ["NewResults", "new_results", "settle", "settle_if_free", "sweep_next"]

_TRIES, _PAUSE = 20, 0.05  # renames on Windows, where a scanner may hold a file for a moment; s


class NewResults:
    """Files of one folder that are written and will come together; made by :func:`new_results`.

    Args:
        folder: where they go.
        dropped: names of results that go with it unless they are written anew.
        graph: digest of the ``graph.json`` that they are made of; None: that which stands in the folder then. Where it
            is the one before, a ``graph.json`` among them is the same graph in another layout.
        corrections: digest of the corrections that the graph shows; None: those in the folder.
    """

    def __init__(
        self, folder: Path, dropped: Collection[str] = (), graph: str | None = None, corrections: str | None = None
    ) -> None:
        self._folder, self._dropped, self._of = folder, frozenset(dropped), graph
        self._corrections = corrections
        self._next = folder / NEXT
        self._earlier: dict[str, str] = {}
        self._known: tuple[tuple[int, int, int], str] | None = None
        self._former = _manifest_if_whole(folder)
        self._former_graph = self._former.graph if self._former is not None else _digest(folder / GRAPH_FILE)

    def is_earlier(self, name: str) -> bool:
        """Whether a result in the folder was made of another graph than the one that is there now, or is to come."""
        there = self._staged_graph or self._former_graph
        return self._graph_of(name) != there

    def keep(self, name: str) -> None:
        """Says that a result, although it is written anew, still shows the graph that it showed before."""
        self._earlier[name] = self._graph_of(name)

    def commit(self) -> None:
        """Lets what was written so far count, and moves it to its places; without it nothing of it ever does.

        Raises:
            OutputError: something stands in a place, or can't be replaced; in the latter case the rest follows when
                the folder is opened next.
        """
        staged = _files_in(self._next)
        if not staged:
            self.discard()
            return
        for name in staged:
            _check_place(self._folder / name)
        manifest = self._manifest(staged)
        try:
            if manifest is not None:
                (self._next / MANIFEST).write_bytes(manifest.to_bytes())
            _flush(self._next, [*staged, *([MANIFEST] if manifest is not None else [])])
            _patiently(self._next, self._folder / READY)
        except OSError as error:
            raise OutputError(f"{self._folder}: can't be written ({error.strerror}); nothing was changed") from error
        flush_folder(self._folder / READY)
        _move_in(self._folder)
        _flush_names(self._folder, staged)
        self._former = _manifest_if_whole(self._folder)
        self._former_graph = self._former.graph if self._former is not None else _digest(self._folder / GRAPH_FILE)
        self._earlier.clear()

    def discard(self) -> None:
        """Removes what was written and doesn't count yet."""
        sweep_next(self._folder)

    @property
    def _staged_graph(self) -> str:
        """Digest of the graph that is to come; empty where none is. It is asked for again and again."""
        try:
            status = (self._next / GRAPH_FILE).stat()
        except OSError:
            return ""
        known = (status.st_ino, status.st_mtime_ns, status.st_size)
        if self._known is None or self._known[0] != known:
            self._known = known, _digest(self._next / GRAPH_FILE)
        return self._known[1]

    def _graph_of(self, name: str) -> str:
        entry = self._former.files.get(name) if self._former is not None else None
        return entry.graph if entry is not None else self._former_graph

    def _manifest(self, staged: Collection[str]) -> Manifest | None:
        """What belongs together once all files are in place; None where that stays, or without a graph."""
        graph = self._staged_graph or self._former_graph
        if not graph or not {*RESULTS, CORRECTIONS} & set(staged):
            return None
        listed = (name for name in RESULTS if name in staged or name not in self._dropped)
        entries = ((name, self._entry(name, graph, name in staged)) for name in listed)
        files = {name: entry for name, entry in entries if entry is not None}
        return Manifest(graph, self._shown_corrections(staged), files)

    def _entry(self, name: str, graph: str, is_staged: bool) -> Entry | None:
        """What the manifest says of a result; None where it isn't there."""
        if is_staged and name == GRAPH_FILE:
            return Entry((self._next / name).stat().st_size, graph, graph)
        if is_staged:
            return self._laid_out(Entry.of(self._next / name, self._earlier.get(name, self._of or graph)), graph)
        if not (self._folder / name).is_file():
            return None
        former = self._former.files.get(name) if self._former is not None else None
        return self._laid_out(former or Entry.of(self._folder / name, self._former_graph), graph)

    def _laid_out(self, entry: Entry, graph: str) -> Entry:
        """What is made of a graph is made of that in another layout, too."""
        is_same = self._keeps_graph and entry.graph == self._former_graph
        return replace(entry, graph=graph) if is_same else entry

    @property
    def _keeps_graph(self) -> bool:
        """Whether the graph that stands in the folder stays, maybe in another layout."""
        return not self._staged_graph or self._of == self._former_graph

    def _shown_corrections(self, staged: Collection[str]) -> str:
        """Digest of the corrections that the graph shows."""
        if self._former is not None and self._keeps_graph and CORRECTIONS not in staged:
            return self._former.corrections
        if self._corrections is not None:
            return self._corrections
        return _digest((self._next if CORRECTIONS in staged else self._folder) / CORRECTIONS)


@contextmanager
def new_results(
    folder: Path, dropped: Collection[str] = (), graph: str | None = None, corrections: str | None = None
) -> Iterator[NewResults]:
    """What this thread writes into a folder within the block comes into it when the block ends well, else nothing does.

    The caller holds the folder (``cadgraph._io.run_folder``). Arguments are those of :class:`NewResults`.

    Raises:
        OutputError: something can't be put in its place.
    """
    new = NewResults(folder, dropped, graph, corrections)
    new.discard()
    try:
        with redirecting(folder):
            yield new
        new.commit()
    finally:
        new.discard()


def settle(folder: Path) -> None:
    """Moves what is complete to its places, where a process was ended before it had done so.

    Args:
        folder: that nobody else is at work in.

    Raises:
        OutputError: something can't be replaced.
    """
    ready = folder / READY
    if ready.is_dir() and not ready.is_symlink():
        _move_in(folder)


def settle_if_free(folder: Path) -> None:
    """As :func:`settle`, for those who only read: where somebody else is at work, or nothing can be written, all stays.

    What is not moved yet is found by ``cadgraph._io.staging.result_path``.
    """
    if (folder / READY).is_dir():
        with suppress(OutputError, OSError), holding(folder):
            settle(folder)


def sweep_next(folder: Path) -> None:
    """Removes what a process left that was ended before its files were complete.

    Args:
        folder: that nobody else is at work in.
    """
    if (folder / NEXT).is_dir():
        shutil.rmtree(folder / NEXT, ignore_errors=True)


def _move_in(folder: Path) -> None:
    """Moves what is complete to its places. It may have been begun before, and somebody else may do the same."""
    ready = folder / READY
    try:
        for name in _files_in(ready):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            _replace(ready / name, folder / name)
            if name == GRAPH_FILE:
                sweep_shards(folder / name, of_whole=True)
        if (ready / MANIFEST).is_file():
            manifest = _manifest_if_whole(folder)
            gone = () if manifest is None else (name for name in RESULTS if name not in manifest.files)
            for name in gone:
                (folder / name).unlink(missing_ok=True)
            _replace(ready / MANIFEST, folder / MANIFEST)
        shutil.rmtree(ready, ignore_errors=True)
    except OSError as error:
        raise OutputError(
            f"{error.filename2 or error.filename or folder}: can't be replaced ({error.strerror}); close what holds "
            "it: the new files are complete, and come to their places when the folder is opened next"
        ) from error


def _files_in(folder: Path) -> list[str]:
    """All files in a folder and those below but for the manifest, by their paths in it; the graph last."""
    found = [Path(here, name).relative_to(folder).as_posix() for here, _, names in os.walk(folder) for name in names]
    return sorted((name for name in found if name != MANIFEST), key=lambda name: (name == GRAPH_FILE, name))


def _check_place(place: Path) -> None:
    """Makes sure that a file can be moved to its place."""
    if place.is_dir():
        raise OutputError(f"{place}: a folder stands where a result goes; choose another output folder")
    above = next(path for path in place.parents if path.exists())
    if not above.is_dir():
        raise OutputError(f"{above}: not a folder but a file; choose another output folder")
    if not os.access(above, os.W_OK):
        raise OutputError(f"{above}: can't write there (Permission denied); choose another output folder")


def _flush(folder: Path, names: Sequence[str]) -> None:
    """Waits until files and their names are on the disk, so that no loss of power takes them once they count."""
    for name in names:
        flush(folder / name)
    _flush_names(folder, names)


def _flush_names(folder: Path, names: Sequence[str]) -> None:
    for file in {path.parent: path for path in (folder / name for name in names)}.values():
        flush_folder(file)


def _replace(source: Path, target: Path) -> None:
    with suppress(FileNotFoundError):  # somebody else was quicker
        _patiently(source, target)


def _patiently(source: Path, target: Path) -> None:
    """Renames; on Windows again and again for a second where something holds the file for a moment."""
    for _ in range(_TRIES - 1 if sys.platform == "win32" else 0):
        try:
            os.replace(source, target)
        except PermissionError:
            time.sleep(_PAUSE)
        else:
            return
    os.replace(source, target)


def _manifest_if_whole(folder: Path) -> Manifest | None:
    """The manifest of a folder; None where it is damaged, too, as it is written anew."""
    try:
        return manifest_in(folder)
    except FormatError:
        return None


def _digest(path: Path) -> str:
    """The digest of a file; empty where there is none."""
    try:
        return sha256_of(path)
    except OSError:
        return ""
