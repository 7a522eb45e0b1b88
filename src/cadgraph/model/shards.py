"""The graph of a large plant on disk: ``graph.json`` as an index, and beside it its rows in shards.

A million nodes as one JSON document are of no use to anybody. Above a number of rows, each kind of row (parts,
contacts, what contains what...) goes into shards of some thousand rows, gzipped lines of JSON, in the folder
``graph-shards``; ``graph.json`` keeps everything else, and says what is in which shard. The name of a shard holds the
digest of its content, so that a new graph never writes over what an old one is read from.

Two more kinds of rows are there to be looked up: ``mesh`` (the part that holds a mesh) and ``around`` (cluster, unit
and neighbours of a part).
"""

from __future__ import annotations

import bisect
import gzip
import hashlib
import zlib
from collections import Counter, OrderedDict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import groupby
from operator import attrgetter
from pathlib import Path
from typing import Any

from pydantic import Field, ValidationError

from cadgraph._io.json_rows import json_row, read_json
from cadgraph._io.shard_files import FOLDER, NAME
from cadgraph._io.staging import READY
from cadgraph._io.text import natural_key
from cadgraph.errors import FormatError
from cadgraph.model.record import Record
from cadgraph.model.records import ROWS_OF

__all__ = ["ABOVE", "ROWS", "SHARDED", "Index", "Run", "Shard", "Shards", "cut", "is_cut"]

ABOVE = 200_000
"""Kinds of more rows than that go into shards: as one document they would take some hundred megabytes."""
ROWS = 5_000
"""Rows of a shard: of parts, some megabytes of text."""
SHARDED = 2
"""``version`` of a ``graph.json`` whose rows are in shards; one that is whole has 1."""

_CUT = ("part", "contains", "adjacent")  # kinds of nodes and edges that grow with the number of meshes
_KIND_OF = {"nodes": "layer", "edges": "kind"}  # the key that says of what kind a row is
_MOST = 1 << 29  # [bytes] of a shard as text
_KEPT = 8  # shards that are kept in memory
_AT_ONCE = 2  # shards that are gzipped at a time


class Shard(Record):
    """One file of rows.

    Args:
        file: its name in ``graph-shards``.
        rows: how many.
        sha256: of its text, unpacked.
        first: name of its first row: the id of a part, the path of a mesh; empty where rows have none.
        last: of its last one.
    """

    file: str = Field(pattern=f"^{NAME.pattern}$")
    rows: int = Field(ge=1)
    sha256: str
    first: str = ""
    last: str = ""


class Run(Record):
    """Rows of one kind that follow each other, in shards.

    Args:
        key: of ``graph.json`` that they belong to (``"nodes"``), or ``"lookup"``.
        kind: their layer or kind (``"part"``), else empty.
        at: how many rows of that key stand before them, among those that are not in shards.
        shards: in order.
    """

    key: str
    kind: str = ""
    at: int = Field(default=0, ge=0)
    shards: tuple[Shard, ...]

    @property
    def rows(self) -> int:
        """How many."""
        return sum(shard.rows for shard in self.shards)


class Index(Record):
    """What ``graph.json`` says of its shards, under ``shards``.

    Args:
        runs: all rows that are in shards.
        labels: of parts: group, name (or null) and how many there are.
    """

    runs: tuple[Run, ...]
    labels: tuple[tuple[str, str | None, int], ...] = ()


def is_cut(data: object) -> bool:
    """Whether the content of a ``graph.json`` is that of an index."""
    return isinstance(data, Mapping) and data.get("version") == SHARDED and "shards" in data


def cut(
    document: Mapping[str, Any], above: int, rows: int = ROWS
) -> tuple[dict[str, Any], Iterator[tuple[str, bytes]]] | None:
    """Cuts the content of a graph into an index and shards.

    Args:
        document: as :meth:`GraphDocument.content` gives it.
        above: kinds of more rows than that are cut.
        rows: of a shard.

    Returns:
        The index, complete once all shards are taken, and the shards: name and content of each. None where no kind
        has so many rows, or parts are in no order by which one of them can be found.
    """
    runs: list[tuple[str, str, int, list[Any]]] = []
    whole: dict[str, list[Any]] = {}
    for key in ROWS_OF:
        whole[key] = []
        by = _KIND_OF.get(key)
        for kind, group in groupby(document.get(key, ()), key=attrgetter(by) if by else lambda _: ""):
            members = list(group)
            if len(members) > above and (by is None or kind in _CUT):
                runs.append((key, kind, len(whole[key]), members))
            else:
                whole[key] += members
    parts = [members for key, kind, _, members in runs if (key, kind) == ("nodes", "part")]
    if not runs or len(parts) > 1 or (parts and not _ascending([row.id for row in parts[0]])):
        return None
    for members in parts:
        runs += [("lookup", "mesh", 0, _meshes(members)), ("lookup", "around", 0, _around(document, members))]
    listed: list[dict[str, Any]] = []
    index = {key: value for key, value in document.items() if key not in ROWS_OF}
    index |= {"version": SHARDED, "shards": {"labels": _labels(document), "runs": listed}}
    index |= {key: rows_left for key, rows_left in whole.items() if rows_left or key in ("nodes", "edges")}

    def shards() -> Iterator[tuple[str, bytes]]:
        for key, kind, at, members in runs:
            run: dict[str, Any] = {"key": key, "kind": kind, "at": at, "shards": []}
            listed.append(run)
            for number, start in enumerate(range(0, len(members), rows)):
                some = members[start : start + rows]
                text = b"".join(json_row(row) + b"\n" for row in some)
                digest = hashlib.sha256(text).hexdigest()
                name = f"{'-'.join(filter(None, (key, kind)))}-{number:05d}-{digest[:16]}.jsonl.gz"
                first, last = (_called(key, row) for row in (some[0], some[-1]))
                run["shards"].append({"file": name, "rows": len(some), "sha256": digest, "first": first, "last": last})
                yield name, text

    return index, _packed(shards())


def _packed(shards: Iterable[tuple[str, bytes]]) -> Iterator[tuple[str, bytes]]:
    """Shards gzipped, a few at a time, while those that follow are made."""
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        waiting: deque[tuple[str, Future[bytes]]] = deque()
        for name, text in shards:
            waiting.append((name, pool.submit(gzip.compress, text, 6, mtime=0)))
            if len(waiting) > _AT_ONCE:
                ready, packed = waiting.popleft()
                yield ready, packed.result()
        for ready, packed in waiting:
            yield ready, packed.result()


def _called(key: str, row: Any) -> str:
    """What a row is looked up by: a record, or what was read of one; empty where rows have no names."""
    if key == "lookup":
        return str(row[0])
    if key != "nodes":
        return ""
    return str(row["id"] if isinstance(row, dict) else row.id)


def _ascending(ids: Sequence[str]) -> bool:
    keys = [natural_key(name) for name in ids]
    return all(one < other for one, other in zip(keys, keys[1:], strict=False))


def _meshes(parts: Iterable[Any]) -> list[list[str]]:
    return sorted([mesh, part.id] for part in parts for mesh in part.meshes)


def _around(document: Mapping[str, Any], parts: Iterable[Any]) -> list[list[Any]]:
    """Of each part: its id, its cluster, its unit, and the parts that it touches in the order of the file."""
    ids = [part.id for part in parts]
    touching: dict[str, list[str]] = {name: [] for name in ids}
    home: dict[str, str] = {}
    layers = {node.id: node.layer for node in document["nodes"] if node.layer != "part"}
    for edge in document["edges"]:
        if edge.kind == "adjacent":
            touching[edge.source].append(edge.target)
            touching[edge.target].append(edge.source)
        elif edge.kind == "contains" and layers.get(edge.source) == "cluster":
            home[edge.target] = edge.source
    unit = {part: node.id for node in document["nodes"] if node.layer == "unit" for part in node.parts}
    return [[name, home.get(name), unit.get(name), sorted(touching[name], key=natural_key)] for name in ids]


def _labels(document: Mapping[str, Any]) -> list[list[Any]]:
    labels = (node.label for node in document["nodes"] if node.layer == "part")
    counted = Counter(label.said for label in labels if label is not None)
    return [
        [group, name, n]
        for (group, name), n in sorted(counted.items(), key=lambda item: (item[0][0], item[0][1] or ""))
    ]


class Shards:
    """The rows of a graph that are in shards, read when they are asked for; the last few shards stay in memory.

    Args:
        folder: that holds ``graph.json``.
        index: what that says of its shards.
    """

    def __init__(self, folder: Path, index: Index) -> None:
        self._folder = folder
        self.index = index
        self._kept: OrderedDict[str, list[bytes]] = OrderedDict()
        self._runs = {(run.key, run.kind): run for run in index.runs}

    @classmethod
    def of(cls, folder: Path, data: Mapping[str, Any], where: str) -> Shards:
        """The shards of an index.

        Args:
            folder: that holds it.
            data: its content.
            where: its path, for messages.

        Raises:
            FormatError: what it says of them is damaged.
        """
        try:
            return cls(folder, Index.model_validate(data["shards"]))
        except ValidationError as error:
            steps = ".".join(str(step) for step in error.errors()[0]["loc"])
            raise FormatError(f"{where}: shards.{steps} is damaged; build the graph anew") from None

    def spoilt(self) -> tuple[str, ...]:
        """The shards that are gone, or not what the index was written with, by their paths; each is read whole."""
        return tuple(
            f"{FOLDER}/{shard.file}" for run in self.index.runs for shard in run.shards if self._is_spoilt(shard)
        )

    def _is_spoilt(self, shard: Shard) -> bool:
        try:
            self._lines(shard)
        except FormatError:
            return True
        return False

    def count(self, key: str, kind: str) -> int:
        """How many rows of a kind are in shards."""
        return sum(run.rows for run in self.index.runs if (run.key, run.kind) == (key, kind))

    def holds(self, key: str, kind: str = "") -> bool:
        """Whether rows of a kind are in shards."""
        return (key, kind) in self._runs

    def rows(self, key: str, kind: str | None = None) -> Iterator[Any]:
        """All rows of a key, or of one kind of it, in order.

        Raises:
            FormatError: a shard is missing or damaged.
        """
        for run in self.index.runs:
            if run.key == key and kind in (None, run.kind):
                for shard in run.shards:
                    yield from self._read(shard)

    def joined(self, key: str, others: Sequence[Any]) -> list[Any]:
        """All rows of a key: those that are not in shards with those that are, in the order of the graph."""
        found: list[Any] = []
        begun = 0
        for run in (run for run in self.index.runs if run.key == key):
            found += others[begun : run.at]
            begun = max(begun, run.at)
            for shard in run.shards:
                found += self._read(shard)
        return [*found, *others[begun:]]

    def row(self, key: str, kind: str, name: str) -> Any:
        """The row that is called so; None where there is none.

        Raises:
            FormatError: a shard is missing or damaged.
        """
        run = self._runs.get((key, kind))
        if run is None:
            return None
        wanted = _order(key, kind)(name)
        place = bisect.bisect_left(run.shards, wanted, key=lambda shard: _order(key, kind)(shard.last))
        if place == len(run.shards):
            return None
        lines = self._some(run.shards[place])
        # Of all lines, only those that are looked at are taken apart.
        at = bisect.bisect_left(lines, wanted, key=lambda line: _order(key, kind)(_called(key, self._row(line))))
        found = self._row(lines[at]) if at < len(lines) else None
        return found if found is not None and _called(key, found) == name else None

    def _some(self, shard: Shard) -> list[bytes]:
        if shard.file not in self._kept:
            self._kept[shard.file] = self._lines(shard)
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(shard.file)
        return self._kept[shard.file]

    def _read(self, shard: Shard) -> list[Any]:
        # Not kept: whoever reads all of them would drive out what others look up.
        return [self._row(line) for line in self._kept.get(shard.file) or self._lines(shard)]

    def _row(self, line: bytes) -> Any:
        try:
            return read_json(line)
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{self._folder / FOLDER}: a row is not JSON ({error}); build the graph anew") from None

    def _lines(self, shard: Shard) -> list[bytes]:
        # Where a run was ended before its files came to their places, they lie one folder off.
        places = (self._folder / READY / FOLDER / shard.file, self._folder / FOLDER / shard.file)
        path = next((place for place in places if place.is_file()), places[1])
        try:
            with gzip.open(path) as file:
                text = file.read(_MOST + 1)
        except FileNotFoundError:
            raise FormatError(
                f"{path}: missing, though graph.json names it; copy the whole folder, or build anew"
            ) from None
        except (OSError, EOFError, zlib.error) as error:
            raise FormatError(f"{path}: damaged ({error}); copy the whole folder again, or build anew") from None
        if len(text) > _MOST or hashlib.sha256(text).hexdigest() != shard.sha256:
            raise FormatError(
                f"{path}: not what graph.json was written with; copy the whole folder again, or build anew"
            )
        return text.splitlines()


def _order(key: str, kind: str) -> Any:
    """By what rows that can be looked up are sorted."""
    return (lambda name: name) if (key, kind) == ("lookup", "mesh") else natural_key
