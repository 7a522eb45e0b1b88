"""Queries of anybody, run where they can do no harm.

SQLite alone does not stop in time: a sort of millions of rows, a comparison of long texts and the planning of nested
queries look at no clock. So queries run in a process of their own, which is ended when its time is over, and which
holds nothing but the tables: see ``child.py`` for what it may do.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cadgraph.agents.answer import cell
from cadgraph.agents.child_process import ChildProcess
from cadgraph.agents.sql import child
from cadgraph.agents.sql.schema import definitions
from cadgraph.errors import AskError

__all__ = ["SECONDS", "Database", "Found", "Stopped"]

_GRACE = 0.15  # s; above the time that the process keeps to by itself, where SQLite lets it
_START = 60.0  # s; to start it and to load the tables
_WAIT = 10.0  # s; for the queries of others
SECONDS = 3.0
"""What a query may take by default."""
_LONGEST = 9_000  # characters of a query

Value = str | float | int | None


class Stopped(AskError):
    """A query took too much time or memory, or the process that ran it is gone."""


@dataclass(frozen=True)
class Found:
    """What a query gave.

    Args:
        columns: their names.
        rows: at most 500; texts are cut to 400 characters.
        complete: whether these are all rows.
        read: what it read, as ``table.column``.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Value, ...], ...]
    complete: bool
    read: frozenset[str]


class Database:
    """Tables that can only be read, for queries of anybody from any thread; one query runs at a time.

    The process that runs them is started by the first query, and ended with this.

    Args:
        rows: of the tables of :data:`~cadgraph.agents.sql.schema.TABLES`, by name.
        seconds: that a query may take.
    """

    def __init__(self, rows: Mapping[str, Sequence[Sequence[Value]]], seconds: float = SECONDS) -> None:
        self.seconds = seconds
        content = {"definitions": definitions(), "rows": rows, "seconds": seconds}
        self._content = (json.dumps(content) + "\n").encode()
        self._lock = threading.Lock()
        self._worker: _Worker | None = None
        self._last: tuple[str, Found] | None = None

    def ask(self, sql: str) -> Found:
        """Runs one statement; the pages of its answer cost no second run.

        Args:
            sql: one SELECT, of at most 9,000 characters.

        Raises:
            Stopped: it took longer than it may, or too much memory.
            AskError: it is no SQL, or does something else than to read the tables.
        """
        if len(sql) > _LONGEST:
            raise AskError(f"the query has {len(sql):,} characters; at most {_LONGEST:,} can be")
        if not self._lock.acquire(timeout=_WAIT):
            raise Stopped("other queries are still running; ask again")
        try:
            if self._last is None or self._last[0] != sql:
                self._last = sql, _found(self._exchanged(sql), self.seconds)
            return self._last[1]
        finally:
            self._lock.release()

    def close(self) -> None:
        """Ends the process; the next query starts another."""
        with self._lock:
            self._discard()

    def _exchanged(self, sql: str) -> dict[str, Any]:
        if self._worker is not None and self._worker.gone:
            self._discard()
        if self._worker is None:
            self._worker = _Worker()
            if self._worker.exchange(self._content, _START) is None:
                self._discard()
                raise Stopped("the tables could not be loaded; there may be too little memory for so large a graph")
        answer = self._worker.exchange(json.dumps(sql).encode() + b"\n", self.seconds + _GRACE)
        if answer is None or answer.get("error") == "memory":
            late = self._worker.late
            self._discard()
            # Without a word before its time was over, it was ended for want of memory, or crashed.
            return {"error": "time" if late else "memory"} if answer is None else answer
        return answer

    def _discard(self) -> None:
        if self._worker is not None:
            self._worker.end()
            self._worker = None


class _Worker:
    """The process."""

    def __init__(self) -> None:
        # -I: neither variables nor the folder that one happens to be in decide what is imported there.
        try:
            self._process = ChildProcess(["-I", "-S", str(Path(child.__file__))], quiet=True)
        except OSError as error:
            raise Stopped(f"can't start a process to run queries in ({error.strerror})") from error
        self.end = self._process.end
        self.late = False

    @property
    def gone(self) -> bool:
        """Whether it has ended."""
        return self._process.gone

    def exchange(self, message: bytes, seconds: float) -> dict[str, Any] | None:
        """Sends a line and waits for the answer to it; None where there is none in time, which ends the process."""
        late = threading.Event()
        # The timer holds the process alone: a thread that is about to end must not keep this from its end.
        timer = threading.Timer(seconds, _give_up, (self._process.kill, late))
        timer.daemon = True
        timer.start()
        try:
            answer = self._process.talk(message)
        finally:
            timer.cancel()
            self.late = late.is_set()
        if self.late or not answer.endswith(b"\n"):
            return None
        told: dict[str, Any] = json.loads(answer)
        return told


def _give_up(kill: Callable[[], None], late: threading.Event) -> None:
    late.set()
    kill()


def _found(answer: Mapping[str, Any], seconds: float) -> Found:
    error = answer.get("error")
    if error == "time":
        raise Stopped(f"stopped after {seconds:g} s; filter before you join, and leave walks to the other tools")
    if error == "memory":
        raise Stopped("stopped, as it takes too much memory; ask for fewer rows, or for sums")
    if error is not None:
        raise AskError(cell(error, 300))
    rows = tuple(tuple(row) for row in answer["rows"])
    columns = tuple(cell(name) for name in answer["columns"])
    return Found(columns, rows, not answer["more"], frozenset(answer["read"]))
