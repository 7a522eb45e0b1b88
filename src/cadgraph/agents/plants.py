"""The plants that a server answers about: one folder of results, or a folder of such folders."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.staging import result_path
from cadgraph.agents.answer import Answer, AskError, cell, did_you_mean, page_of, row
from cadgraph.agents.drawing.messages import Request
from cadgraph.agents.drawing.order import Picture
from cadgraph.agents.drawing.process import DrawingProcess
from cadgraph.agents.picture import order_of
from cadgraph.agents.plant import Plant
from cadgraph.errors import FormatError

if TYPE_CHECKING:
    from cadgraph.agents.correcting import Desk

__all__ = ["Plants"]

_GRAPH = "graph.json"
_MOST_OPEN = 8  # plants that are kept open; the one that wasn't asked about for longest is closed

Stamp = tuple[int, int, int]


@dataclass
class _Opened:
    """One plant, as far as it is open."""

    folder: Path
    lock: threading.Lock = field(default_factory=threading.Lock)
    plant: Plant | None = None
    stamp: Stamp | None = None
    desk: Desk | None = None

    def now(self) -> Plant:
        """The plant as it is now; for the holder of the lock.

        Raises:
            FormatError: its graph can't be read.
        """
        graph = None if self.desk is None else self.desk.graph
        if graph is not None:
            # Nobody else writes it meanwhile, and what the folder holds follows a moment later.
            if self.plant is None or self.plant.graph is not graph:
                self.plant = Plant(graph, self.folder)
            return self.plant
        stamp = _stamp(result_path(self.folder / _GRAPH))
        if self.plant is None or stamp != self.stamp:
            self.plant, self.stamp = Plant.open(self.folder), stamp
        return self.plant


class Plants:
    """Opens plants when they are asked about, and again when their graph was written anew. Safe for threads.

    A plant is chosen by the name of its folder among those that are there; what a caller names is never a path.

    Args:
        where: a folder that ``cadgraph build`` wrote, its ``graph.json``, or a folder that holds such folders.
        who: name under which corrections are kept; None allows none.

    Raises:
        FormatError: there is no graph.
    """

    def __init__(self, where: Path, who: str | None = None) -> None:
        self._who = who
        self._lock = threading.Lock()
        self._opened: dict[str, _Opened] = {}
        self._drawing = DrawingProcess()
        if not where.is_dir() and not (where.name == _GRAPH and result_path(where).is_file()):
            # Its neighbours must never answer for a folder that is gone.
            raise FormatError(f"{where}: no such folder; give what 'cadgraph build' wrote, or a folder of such folders")
        self._root = where if where.is_dir() else where.parent
        self.several = not (where.name == _GRAPH or result_path(where / _GRAPH).is_file())
        if self.several and not self._folders():
            raise FormatError(f"{where}: holds no graph.json, nor do folders in it; give what 'cadgraph build' wrote")
        if not self.several:
            # What can't be read is told at once, and so is a folder that can't be corrected.
            self.get("")
            if who is not None:
                self.desk("")

    @property
    def writable(self) -> bool:
        """Whether plants can be corrected."""
        return self._who is not None

    def names(self) -> tuple[str, ...]:
        """The names of all plants, sorted."""
        return tuple(sorted(self._folders()))

    def get(self, name: str) -> Plant:
        """A plant as it is now.

        Args:
            name: of its folder; ``""`` where there is only one.

        Raises:
            AskError: there is none of this name.
            FormatError: its graph can't be read.
        """
        opened = self._find(name)
        with opened.lock:
            return opened.now()

    def picture(self, name: str, target: str) -> Picture:
        """Draws one thing of a plant, in a process of its own that all plants share; the others wait for one picture.

        Args:
            name: see :meth:`get`.
            target: see :func:`~cadgraph.agents.picture.picture`.

        Raises:
            AskError: there is no such plant, nothing in it is called so, or its scene isn't there.
            LoadError: the scene can't be read.
        """
        opened = self._find(name)
        with opened.lock:
            plant, stamp = opened.now(), opened.stamp
        order, document = order_of(plant, target), plant.graph.document
        # Corrections change the graph, not the scene.
        key = f"{stamp} {opened.folder}"
        return self._drawing.draw(Request(key, str(opened.folder), document.source, document.config, order))

    def desk(self, name: str) -> Desk:
        """Where a plant is corrected; opened at the first call, and then until the end.

        Args:
            name: see :meth:`get`.

        Raises:
            AskError: there is no such plant, or nothing may be corrected.
            OutputError: another process is at work in its folder, or it can't be written.
        """
        from cadgraph.agents.correcting import Desk

        if self._who is None:
            raise AskError("nothing can be corrected here: the server was started without --write")
        plant, opened = self.get(name), self._find(name)
        with opened.lock:
            if opened.desk is None:
                opened.desk = Desk(opened.folder, plant.graph, self._who)
            return opened.desk

    def listing(self, page: int = 1) -> Answer:
        """The plants: name, and what each was built from, where it is open.

        Args:
            page: counted from 1.
        """
        names = self.names()
        with self._lock:
            known = {name: opened.plant for name, opened in self._opened.items()}
        rows = [row(name, _size_of(known.get(name))) for name in names]
        head = [f"{len(names)} plant{'s' * (len(names) != 1)}; give one's name as 'plant' to the other tools"]
        return Answer(page_of(head, rows, [], page), {"plants": list(names)})

    def close(self) -> list[str]:
        """Closes all that is open; what could not be written, in words."""
        self._drawing.close()
        with self._lock:
            desks = [opened.desk for opened in self._opened.values() if opened.desk is not None]
            self._opened.clear()
        return [failed for desk in desks if (failed := desk.close()) is not None]

    def _folders(self) -> Mapping[str, Path]:
        """The folders of all plants, by name."""
        if not self.several:
            return {self._root.resolve().name: self._root}
        found: dict[str, Path] = {}
        for folder in self._root.iterdir():
            with suppress(OSError):
                if result_path(folder / _GRAPH).is_file():
                    found[folder.name] = folder
        return found

    def _find(self, name: str) -> _Opened:
        folders = self._folders()
        if not self.several or (not name and len(folders) == 1):
            name = next(iter(folders))
        shown = [each for each in folders if cell(each) == cell(name)]
        if len(shown) != 1:
            what = f"no plant {cell(name)!r} here" if name else "say which plant"
            raise AskError(f"{what}; {did_you_mean(name, sorted(folders))}")
        with self._lock:
            opened = self._opened.pop(shown[0], None) or _Opened(folders[shown[0]])
            self._opened[shown[0]] = opened
            idle = [each for each, other in self._opened.items() if other.desk is None and other is not opened]
            for each in idle[: max(0, len(self._opened) - _MOST_OPEN)]:
                del self._opened[each]
        return opened


def _stamp(file: Path) -> Stamp:
    """What tells a file from the one that took its place.

    Raises:
        FormatError: it isn't there any more.
    """
    try:
        status = file.stat()
    except OSError as error:
        raise FormatError(
            f"{file.name} of {file.parent.name}: can't be read ({error.strerror}); build it again"
        ) from None
    # The last one can't be set back, as copies do with the first.
    return status.st_mtime_ns, status.st_size, status.st_ctime_ns


def _size_of(plant: Plant | None) -> str:
    return "" if plant is None else f"{len(plant.graph.units())} units"
