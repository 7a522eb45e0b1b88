"""The process that runs queries: it holds the tables in memory and reads requests from its standard input, a line each.

It is run as a file by a bare interpreter, so it imports nothing but the standard library, and only ``guard.py`` starts
it. The first line brings the tables, each other one a query; it answers each with a line. What it could do with files,
it gives up before the first query: it may open none and write none.
"""

from __future__ import annotations

import json
import math
import signal
import sqlite3
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

__all__ = ["FUNCTIONS", "MOST_ROWS", "add_mathematics", "limit_process", "main"]

MOST_ROWS = 500  # that a query gives
_MOST_CHARACTERS = 400  # of a cell
_MOST_SIZE = 200_000  # characters of all cells of an answer
_OFTEN = 10_000  # steps of SQLite between two looks at the clock
_HEAP = 128 << 20  # bytes that SQLite may take for a query
_ROOM = 1 << 30  # bytes that this process may take, above ten times what its tables came as

_LIMITS = {
    sqlite3.SQLITE_LIMIT_LENGTH: 1_000_000,
    sqlite3.SQLITE_LIMIT_SQL_LENGTH: 10_000,
    sqlite3.SQLITE_LIMIT_COLUMN: 64,
    sqlite3.SQLITE_LIMIT_EXPR_DEPTH: 100,
    sqlite3.SQLITE_LIMIT_COMPOUND_SELECT: 20,
    sqlite3.SQLITE_LIMIT_VDBE_OP: 25_000,
    sqlite3.SQLITE_LIMIT_FUNCTION_ARG: 32,
    sqlite3.SQLITE_LIMIT_ATTACHED: 0,
    sqlite3.SQLITE_LIMIT_LIKE_PATTERN_LENGTH: 200,
    sqlite3.SQLITE_LIMIT_VARIABLE_NUMBER: 1,
    sqlite3.SQLITE_LIMIT_TRIGGER_DEPTH: 1,
    sqlite3.SQLITE_LIMIT_WORKER_THREADS: 0,
}

_MATHEMATICS: dict[str, tuple[int, Callable[..., float]]] = {
    "sqrt": (1, math.sqrt),
    "pow": (2, math.pow),
    "power": (2, math.pow),
    "floor": (1, math.floor),
    "ceil": (1, math.ceil),
    "atan2": (2, math.atan2),
    "degrees": (1, math.degrees),
}
"""What an SQLite that was built without mathematics gets from here."""

FUNCTIONS = frozenset(
    {
        *("abs", "ceil", "ceiling", "floor", "round", "sign", "mod", "sqrt", "pow", "power", "atan2", "degrees"),
        *("avg", "count", "group_concat", "max", "min", "sum", "total"),
        *("coalesce", "ifnull", "iif", "nullif", "typeof", "likely", "unlikely", "likelihood"),
        *("format", "glob", "instr", "length", "like", "lower", "ltrim", "printf", "replace", "rtrim", "substr"),
        *("substring", "trim", "unicode", "upper"),
        *("cume_dist", "dense_rank", "first_value", "lag", "last_value", "lead", "nth_value", "ntile"),
        *("percent_rank", "rank", "row_number"),
    }
)
"""Functions that a query may call: none that reads, writes, or makes text out of nothing."""


class _Guard:
    """Decides what a query may do, and notes which columns it reads.

    Args:
        tables: that may be read.
        others: what else SQLite would take for a table: modules, as ``json_each``.
    """

    def __init__(self, tables: set[str], others: set[str]) -> None:
        self._tables = tables | {"sqlite_master", "sqlite_schema"}
        self._others = others
        self.read: set[str] = set()

    def __call__(self, action: int, first: str | None, second: str | None, _base: str | None, _by: str | None) -> int:
        if action == sqlite3.SQLITE_READ:
            allowed = self._may_read((first or "").lower(), (second or "").lower())
        elif action == sqlite3.SQLITE_FUNCTION:
            allowed = (second or "").lower() in FUNCTIONS
        else:
            allowed = action in (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_RECURSIVE)
        return sqlite3.SQLITE_OK if allowed else sqlite3.SQLITE_DENY

    def _may_read(self, table: str, column: str) -> bool:
        if table in self._tables:
            self.read.add(f"{table}.{column}")
            return True
        # The rows of a table that the query makes itself are counted: it has that name there, and no column is read.
        return not column and table not in self._others and not table.startswith("pragma_")


def main() -> None:
    """Takes tables and queries until the caller has gone."""
    # Ctrl-C reaches both processes; the caller decides, and ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    first = sys.stdin.buffer.readline()
    if not first:
        return
    content: dict[str, Any] = json.loads(first)
    seconds: float = content.pop("seconds")
    limit_process(_ROOM + 10 * len(first))
    connection, guard = _opened(content)
    # The rows are in the tables now, and this copy of them is several times as large.
    content.clear()
    del first
    _write({})
    for line in iter(sys.stdin.buffer.readline, b""):
        guard.read.clear()
        _write(_answer(connection, json.loads(line), seconds) | {"read": sorted(guard.read)})


def _opened(content: dict[str, Any]) -> tuple[sqlite3.Connection, _Guard]:
    """The tables in memory, locked up."""
    connection = sqlite3.connect(":memory:", isolation_level=None, cached_statements=0)
    # Nothing is put aside on the disk; the extension loader is off, which is also what SQLite starts with.
    connection.execute("PRAGMA temp_store = MEMORY")
    for statement in content["definitions"]:
        if statement.startswith("CREATE TABLE"):
            connection.execute(statement)
    for table, rows in content["rows"].items():
        if rows:
            connection.executemany(f"INSERT INTO {table} VALUES ({', '.join('?' * len(rows[0]))})", rows)
    for statement in content["definitions"]:
        if not statement.startswith("CREATE TABLE"):
            connection.execute(statement)
    add_mathematics(connection)
    others = {name.lower() for (name,) in connection.execute("SELECT name FROM pragma_module_list")}
    (pages,), (size,) = (connection.execute(f"PRAGMA {what}").fetchone() for what in ("page_count", "page_size"))
    connection.execute(f"PRAGMA hard_heap_limit = {2 * pages * size + _HEAP}")
    connection.execute("PRAGMA query_only = ON")
    for limit, most in _LIMITS.items():
        connection.setlimit(limit, most)
    guard = _Guard(set(content["rows"]), others)
    connection.set_authorizer(guard)
    return connection, guard


def add_mathematics(connection: sqlite3.Connection) -> None:
    """Adds the functions of mathematics that this SQLite lacks."""
    for name, (count, function) in _MATHEMATICS.items():
        try:
            connection.execute(f"SELECT {name}({', '.join('1' * count)})")
        except sqlite3.OperationalError:
            connection.create_function(name, count, _of_numbers(function), deterministic=True)


def _of_numbers(function: Callable[..., float]) -> Callable[..., float | None]:
    """The function as SQL has it: null of null, and where there is no such number."""

    def called(*values: object) -> float | None:
        numbers = [value for value in values if isinstance(value, int | float)]
        try:
            return function(*numbers) if len(numbers) == len(values) else None
        except (ValueError, OverflowError):
            return None

    return called


def _answer(connection: sqlite3.Connection, sql: str, seconds: float) -> dict[str, Any]:
    """Rows of a query, or what is wrong."""
    end = time.monotonic() + seconds
    connection.set_progress_handler(lambda: time.monotonic() > end, _OFTEN)
    try:
        cursor = connection.execute(sql)
        if cursor.description is None:
            return {"error": "there is no statement"}
        try:
            rows, more = _fetched(cursor)
        finally:
            cursor.close()
        return {"columns": [column[0] for column in cursor.description], "rows": rows, "more": more}
    except MemoryError:
        return {"error": "memory"}
    except (sqlite3.Error, sqlite3.Warning, ValueError, OverflowError) as error:
        return {"error": "time" if time.monotonic() > end else str(error)[:300] or type(error).__name__}


def _fetched(cursor: Iterator[tuple[Any, ...]]) -> tuple[list[list[Any]], bool]:
    """The first rows, their cells cut, and whether there are more."""
    rows: list[list[Any]] = []
    size = 0
    for row in cursor:
        if len(rows) == MOST_ROWS or size > _MOST_SIZE:
            return rows, True
        rows.append([_cell(value) for value in row])
        size += sum(len(value) if isinstance(value, str) else 8 for value in rows[-1])
    return rows, False


def _cell(value: Any) -> Any:
    if isinstance(value, bytes):
        return f"({len(value)} bytes)"
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, str) and len(value) > _MOST_CHARACTERS:
        return value[: _MOST_CHARACTERS - 1] + "…"
    return value


def limit_process(memory: int) -> None:
    """Lets the system refuse what no query needs: files, other processes' worth of memory, a core."""
    try:
        import resource
    except ImportError:  # Windows has no such limits: there SQLite's own and the caller's clock remain
        return
    limits = {resource.RLIMIT_CORE: 0, resource.RLIMIT_FSIZE: 0, resource.RLIMIT_NOFILE: 3, resource.RLIMIT_AS: memory}
    for what, most in limits.items():
        try:
            resource.setrlimit(what, (most, most))
        except (OSError, ValueError):  # the system has a lower one, or none of the kind
            continue


def _write(message: dict[str, Any]) -> None:
    sys.stdout.buffer.write(json.dumps(message).encode() + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
