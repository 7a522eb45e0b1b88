"""``manifest.json``: which files of a folder belong together, by their digests, and which show an earlier graph."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cadgraph._io.digest import sha256_of
from cadgraph._io.json_rows import json_rows
from cadgraph._io.limits import CHECK_PATH, Limit, read_bytes_within
from cadgraph._io.staging import result_path
from cadgraph._io.text import natural_key
from cadgraph.errors import CadGraphError, FormatError

__all__ = [
    "CORRECTIONS",
    "GRAPH_FILE",
    "LACKING",
    "MANIFEST",
    "MARK",
    "RESULTS",
    "Entry",
    "Manifest",
    "behind",
    "changed_by_others",
    "graphs_in",
    "manifest_in",
    "no_graph",
    "of_an_earlier_graph",
    "read_checked",
]

MANIFEST, GRAPH_FILE, CORRECTIONS = "manifest.json", "graph.json", "corrections.json"
MARK = "cadgraph-manifest"
"""What tells our manifest from any other file of this name."""

LACKING = "corrections were made that this graph lacks; they may change this: wait for the viewer, or build it again"
"""What a reader of a graph that is behind is told."""

RESULTS = (
    *("scene.usdc", "semantics.usda", "report.html", "picture.png", "timings.json"),
    *("simulation.usda", "devices.json", GRAPH_FILE),
)
"""All files that a run may write, and what is written of its graph later. The graph vouches for those without a mark
of their own, so it goes last."""

_OF_A_RUN = ("timings.json",)  # shows no graph at all
_VERSION = 1
_MOST = Limit(1 << 20, "a manifest")
"""An entry takes 250 bytes."""
_TRIES, _PAUSE = 3, 0.05  # looks at a file that is being replaced; s between two
_HEAD = 200  # bytes in which the mark stands
_REMEDY = "build the graph anew"
_MOST_NAMES = 12  # plants that a message names


@dataclass(frozen=True)
class Entry:
    """One file.

    Args:
        size: of it [bytes].
        sha256: of its content, hexadecimal.
        graph: SHA-256 of the ``graph.json`` that it was made of.
    """

    size: int
    sha256: str
    graph: str

    @classmethod
    def of(cls, file: Path, graph: str) -> Entry:
        """The entry of a file as it is now."""
        return cls(file.stat().st_size, sha256_of(file), graph)


@dataclass(frozen=True)
class Manifest:
    """What belongs together in a folder.

    Args:
        graph: SHA-256 of ``graph.json``.
        corrections: SHA-256 of the ``corrections.json`` that the graph shows; empty where there were none. That file
            alone may be changed by others.
        files: by name.
    """

    graph: str
    corrections: str = ""
    files: Mapping[str, Entry] = field(default_factory=dict)

    def to_bytes(self) -> bytes:
        """The content of the file."""
        rows = [
            {"name": name, "size": entry.size, "sha256": entry.sha256, "graph": entry.graph}
            for name, entry in sorted(self.files.items())
        ]
        document = {"format": MARK, "version": _VERSION, "graph": self.graph, "corrections": self.corrections}
        return json_rows({**document, "files": rows}, ("files",))

    @property
    def earlier(self) -> tuple[str, ...]:
        """The files that were made of another graph than the one in the folder."""
        shown = ((name, entry) for name, entry in sorted(self.files.items()) if name not in _OF_A_RUN)
        return tuple(name for name, entry in shown if entry.graph != self.graph)


def manifest_in(folder: Path) -> Manifest | None:
    """The manifest of a folder; None where there is none of ours.

    Raises:
        FormatError: it is damaged.
    """
    place = folder / MANIFEST
    if not _is_ours(place) or (content := _through(place)) is None:
        return None
    try:
        data = json.loads(content)
        if data["version"] > _VERSION:
            raise FormatError(f"{place}: of a newer cadgraph; update this one")
        rows = {row["name"]: row for row in data["files"]}
        # What else it names was put there by others.
        files = {name: _entry(rows[name]) for name in RESULTS if name in rows}
        return Manifest(_text(data["graph"]), _text(data["corrections"]), files)
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise FormatError(f"{place}: damaged ({type(error).__name__}); {_REMEDY}, or remove it") from None


def read_checked(path: Path, limit: Limit, error: type[CadGraphError], remedy: str) -> bytes:
    """The content of a file that must be the one that its folder's manifest names, where that names it.

    Args:
        path: its place.
        limit: of its kind.
        error: class of the error where it can't be read.
        remedy: what to do then, as the end of a message.

    Raises:
        error: it can't be read, or is too large.
        FormatError: it is another file than the one that was written with the others.
    """
    for attempt in range(_TRIES):
        if attempt:
            time.sleep(_PAUSE)  # somebody was just replacing both
        content = _through(path, limit)
        if content is None:
            content = read_bytes_within(path, limit, error, remedy)
        manifest = manifest_in(path.parent)
        entry = manifest.files.get(path.name) if manifest is not None else None
        if entry is None or hashlib.sha256(content).hexdigest() == entry.sha256:
            return content
    raise FormatError(
        f"{path}: not what cadgraph wrote with the other files here, as {MANIFEST} says; {_REMEDY}, or remove "
        f"{MANIFEST} to take it as it is"
    )


def graphs_in(folder: Path) -> list[str]:
    """The names of the folders in a folder that hold a graph each, as a build of many scenes makes them, in order."""
    found = (graph.parent.name for graph in folder.glob(f"*/{GRAPH_FILE}") if graph.is_file())
    return sorted((name for name in found if not name.startswith(".")), key=natural_key)


def no_graph(file: Path) -> str:
    """What to say where a ``graph.json`` is missing: which plants its folder holds instead, or what makes one.

    Args:
        file: its place, or what was named instead and isn't there.
    """
    if file.name != GRAPH_FILE:
        return f"{file}: no such file or folder; {CHECK_PATH}"
    folder = file.parent
    names = graphs_in(folder)
    if not names:
        return f"{file}: no such file; 'cadgraph build' makes it"
    more = f" and {len(names) - _MOST_NAMES:,} more" if len(names) > _MOST_NAMES else ""
    which = f"{len(names):,} plants" if len(names) > 1 else "1 plant"
    shown = ", ".join(names[:_MOST_NAMES]) + more
    return f"{folder} holds {which}: {shown}; name {'one' if len(names) > 1 else 'it'}, as {folder / names[0]}"


def of_an_earlier_graph(folder: Path) -> tuple[str, ...]:
    """The files in a folder that show another graph than the one that is there.

    Raises:
        FormatError: the manifest is damaged.
    """
    manifest = manifest_in(folder)
    return () if manifest is None else tuple(name for name in manifest.earlier if (folder / name).exists())


def changed_by_others(folder: Path) -> tuple[str, ...]:
    """The files that a folder's manifest names and that are gone, or others than were written; each is read whole.

    Raises:
        FormatError: the manifest is damaged.
    """
    manifest = manifest_in(folder)
    entries = () if manifest is None else sorted(manifest.files.items())
    return tuple(name for name, entry in entries if not _is(result_path(folder / name), entry))


def behind(folder: Path) -> bool:
    """Whether a folder holds corrections that its graph doesn't show, or lacks those that it shows.

    Without a manifest: whether they are younger than the graph, which then may not show them.

    Raises:
        FormatError: the manifest is damaged.
    """
    manifest = manifest_in(folder)
    if manifest is None:
        return _is_younger(folder / CORRECTIONS, folder / GRAPH_FILE)
    try:
        return sha256_of(result_path(folder / CORRECTIONS)) != manifest.corrections
    except OSError:
        return bool(manifest.corrections)


def _is_younger(file: Path, other: Path) -> bool:
    try:
        return file.stat().st_mtime_ns > other.stat().st_mtime_ns
    except OSError:
        return False


def _entry(row: Mapping[str, Any]) -> Entry:
    return Entry(int(row["size"]), _text(row["sha256"]), _text(row["graph"]))


def _is_ours(place: Path) -> bool:
    """Whether a manifest is one of cadgraph, and not of another program, which may be of any size."""
    with suppress(OSError):
        path = result_path(place)
        if path.is_file():
            with path.open("rb") as file:
                return MARK.encode() in file.read(_HEAD)
    return False


def _is(path: Path, entry: Entry) -> bool:
    try:
        return path.stat().st_size == entry.size and sha256_of(path) == entry.sha256
    except OSError:
        return False


def _through(place: Path, limit: Limit = _MOST) -> bytes | None:
    """The content of a file that may be moved to its place at this moment; None where there is none."""
    for _ in range(2):
        try:
            return read_bytes_within(result_path(place), limit, FormatError, _REMEDY)
        except FormatError as error:
            if not isinstance(error.__cause__, FileNotFoundError):
                raise
    return None


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(value)
    return value
