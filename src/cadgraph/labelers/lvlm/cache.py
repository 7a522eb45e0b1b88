"""Answers that were given, kept on disk: what was answered once is never asked again."""

from __future__ import annotations

import sqlite3
import threading
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from cadgraph._io.limits import REPLY
from cadgraph.errors import LabelError, OutputError
from cadgraph.labelers.lvlm.reply import Reply

__all__ = ["Cache"]

_SCHEMA = 1
_TABLE = """
CREATE TABLE IF NOT EXISTS answers (
    key TEXT PRIMARY KEY, model TEXT NOT NULL, text TEXT, refusal TEXT, prompt_tokens INTEGER NOT NULL,
    answer_tokens INTEGER NOT NULL, batch INTEGER NOT NULL, stored REAL NOT NULL
) WITHOUT ROWID
"""

# Questions on their way. A file of an older version gets the table as well; older versions don't mind it.
_SENT = "CREATE TABLE IF NOT EXISTS sent (key TEXT PRIMARY KEY, model TEXT NOT NULL, since REAL NOT NULL) WITHOUT ROWID"

_FORGET = "DELETE FROM sent WHERE key = ?"


class Cache:
    """Answers by the content of their questions. Safe for threads, for several processes, and for being killed.

    Each answer is committed as it comes. In write-ahead mode a process that is killed loses nothing committed. A
    question is noted as sent before it is: what a killed process had on its way can be told afterwards.

    Args:
        path: of the file; made if missing. ``":memory:"`` keeps nothing.

    Raises:
        LabelError: the file is something else.
        OutputError: it can't be written.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = path
        self._lock = threading.Lock()
        try:
            if str(path) != ":memory:":
                Path(path).parent.mkdir(parents=True, exist_ok=True)
            self._base = sqlite3.connect(str(path), timeout=30.0, check_same_thread=False, isolation_level=None)
            # The file may be anybody's: a text beyond this is never brought into memory.
            self._base.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, REPLY.most)
            self._base.execute("PRAGMA journal_mode=WAL")
            self._base.execute("PRAGMA synchronous=NORMAL")
            version = int(self._base.execute("PRAGMA user_version").fetchone()[0])
            tables = self._base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
            if version != _SCHEMA and (version or tables):
                raise LabelError(f"{path}: not a cache of answers of this version; name another with lvlm.cache")
            self._base.execute(_TABLE)
            self._base.execute(_SENT)
            self._base.execute(f"PRAGMA user_version={_SCHEMA}")
        except sqlite3.DatabaseError as error:
            if isinstance(error, sqlite3.OperationalError):
                raise OutputError(f"{path}: the cache of answers can't be opened ({error})") from error
            raise LabelError(f"{path}: not a cache of answers ({error}); name another with lvlm.cache") from error
        except OSError as error:
            raise OutputError(f"{path}: the cache of answers can't be written ({error.strerror})") from error

    def get(self, key: str) -> Reply | None:
        """The answer to a question; None where there is none, or one that is larger than any answer can be."""
        row = None
        with self._lock, suppress(sqlite3.DataError):
            row = self._base.execute(
                "SELECT text, refusal, prompt_tokens, answer_tokens, batch FROM answers WHERE key = ?", (key,)
            ).fetchone()
        return None if row is None else Reply(row[0], row[1], int(row[2]), int(row[3]), batch=bool(row[4]))

    def known(self, keys: Iterable[str]) -> set[str]:
        """Which of these questions have an answer."""
        return {key for key in keys if self.get(key) is not None}

    def put(self, key: str, model: str, reply: Reply) -> None:
        """Keeps an answer; a first one stays."""
        used = reply.prompt_tokens, reply.answer_tokens, int(reply.batch)
        row = key, model, reply.text, reply.refusal, *used, time.time()
        self._write(("INSERT OR IGNORE INTO answers VALUES (?, ?, ?, ?, ?, ?, ?, ?)", row), (_FORGET, (key,)))

    def sending(self, key: str, model: str) -> None:
        """Notes that a question is about to be sent; :meth:`put` or :meth:`settled` take that back."""
        self._write(("INSERT OR REPLACE INTO sent VALUES (?, ?, ?)", (key, model, time.time())))

    def settled(self, key: str) -> None:
        """Notes that a question that was sent is known to have brought no answer."""
        self._write((_FORGET, (key,)))

    def on_the_way(self, keys: Iterable[str]) -> set[str]:
        """Which of these questions were sent and never heard of again: the process was killed, or the line broke."""
        with self._lock:
            sent = {row[0] for row in self._base.execute("SELECT key FROM sent")}
        return sent.intersection(keys)

    def _write(self, *changes: tuple[str, tuple[object, ...]]) -> None:
        """Makes all changes or none."""
        try:
            with self._lock:
                self._base.execute("BEGIN IMMEDIATE")
                try:
                    for change, values in changes:
                        self._base.execute(change, values)
                except BaseException:
                    self._base.execute("ROLLBACK")
                    raise
                self._base.execute("COMMIT")
        except sqlite3.OperationalError as error:
            raise OutputError(f"{self.path}: the answer can't be kept ({error}); is the disk full?") from error

    def __len__(self) -> int:
        with self._lock:
            return int(self._base.execute("SELECT count(*) FROM answers").fetchone()[0])

    def __del__(self) -> None:
        if hasattr(self, "_base"):
            self._base.close()

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._base.close()
