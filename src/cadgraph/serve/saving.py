"""Writing the graph a moment after it changed, beside the work: corrections are on disk by then."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

from cadgraph.errors import CadGraphError

__all__ = ["Saver"]

Content = TypeVar("Content")


class Saver(Generic[Content]):
    """Writes the last of the graphs that it is given, with what belongs to each, when none has come for a while.

    Args:
        write: writes one.
        failed: is told why the last one could not be written, or None once one could.
        delay: how long to wait for another graph [s].
    """

    def __init__(
        self, write: Callable[[Content], None], failed: Callable[[str | None], None], delay: float = 2.0
    ) -> None:
        self._write, self._failed, self._delay = write, failed, delay
        self._changed = threading.Condition()
        self._waiting: Content | None = None
        self._due = 0.0
        self._busy = self._closing = False
        # A process that is ended must not wait for it: what it writes follows from what is on disk.
        self._thread = threading.Thread(target=self._run, name="cadgraph-saver", daemon=True)
        self._thread.start()

    def give(self, graph: Content) -> None:
        """Has a graph written in place of those before it."""
        with self._changed:
            self._waiting, self._due = graph, time.monotonic() + self._delay
            self._changed.notify_all()

    @property
    def pending(self) -> bool:
        """Whether a graph is not written yet."""
        with self._changed:
            return self._busy or self._waiting is not None

    def close(self) -> None:
        """Writes what is left at once, and ends."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        self._thread.join()

    def _run(self) -> None:
        while (graph := self._next()) is not None:
            try:
                self._write(graph)
                told = None
            except (CadGraphError, OSError, ValueError) as error:
                told = str(error)
            with self._changed:
                self._busy = False
                self._changed.notify_all()
            self._failed(told)

    def _next(self) -> Content | None:
        with self._changed:
            while True:
                left = self._due - time.monotonic() if self._waiting is not None else None
                if self._closing or (left is not None and left <= 0):
                    break
                self._changed.wait(left)
            graph, self._waiting = self._waiting, None
            self._busy = graph is not None
            return graph
