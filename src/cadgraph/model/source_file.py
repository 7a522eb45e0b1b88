"""The file that a graph was made from, where it lies now."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from cadgraph._io.digest import sha256_of
from cadgraph.errors import LoadError
from cadgraph.model.records import SourceRecord

__all__ = ["changed_since", "changed_source", "find_source", "source_at_head"]

_HEAD = 1 << 20  # bytes at the beginning of a graph.json that its source is looked for in


def find_source(
    source: SourceRecord, folder: Path | None, given: str | Path | None = None, option: str = "--source"
) -> Path:
    """The file that a graph was made from, once it is known to be the very one.

    Args:
        source: of the graph; says where it was, as it was named then, and which bytes it had.
        folder: that holds the graph, if any. The file may lie there or beside that folder, too, and a path that was
            relative may start beside that folder.
        given: where it is now, if somebody knows better; it is looked for there alone.
        option: of the command line, that says so.

    Raises:
        LoadError: it is missing, is another file, or can't be read; the message says how to name the right one.
    """
    if given is None and not source.path:
        raise LoadError(f"the graph doesn't say which file it was made from; give it with {option} FILE")
    tried = [Path(given)] if given is not None else list(dict.fromkeys(_places(Path(source.path), folder)))
    there = [path for path in tried if _is_there(path, option)]
    if not there:
        raise LoadError(f"{tried[0]}: the file that the graph was made from is not there; give it with {option} FILE")
    told = ""
    for path in there:
        difference = _difference(path, source, option)
        if not difference:
            return path
        told = told or difference
    raise LoadError(f"{told}; give that one with {option} FILE, or build the graph anew")


def changed_source(source: SourceRecord, folder: Path) -> str:
    """How the file that a graph was made from has changed since; empty where it hasn't, or can't be found or read.

    Args:
        source: of the graph.
        folder: that holds the graph; the file is looked for as by :func:`find_source`.
    """
    if not source.path:
        return ""
    with suppress(LoadError):
        places = dict.fromkeys(_places(Path(source.path), folder))
        differences = [_difference(path, source, "") for path in places if _is_there(path, "")]
        return differences[0] if all(differences) and differences else ""
    return ""


def changed_since(source: SourceRecord, graph: Path) -> str:
    """Likewise, at the cost of looking at the times of files: one that is no younger than the graph isn't read.

    It is asked with every answer, so that a graph of anybody must not make this machine call another one: what lies on
    another machine (``//host/share``) is not looked at.

    Args:
        source: of the graph.
        graph: its file.
    """
    if any(name.replace("\\", "/").startswith("//") for name in (source.path, *(name for name, _ in source.referred))):
        return ""
    with suppress(OSError, ValueError, LoadError):
        born = graph.stat().st_mtime_ns
        places = dict.fromkeys(_places(Path(source.path), graph.parent)) if source.path else ()
        for path in (path for path in places if _is_there(path, "")):
            if any(
                _is_younger(path.parent / name, born) for name in (path.name, *(name for name, _ in source.referred))
            ):
                return changed_source(source, graph.parent)
    return ""


def source_at_head(graph: Path) -> SourceRecord | None:
    """What a ``graph.json`` says of its source, read from its first lines alone; None where it doesn't stand there."""
    with suppress(OSError, ValueError, RecursionError):
        with graph.open("rb") as opened:
            head = opened.read(_HEAD).decode(errors="replace")
        found = re.search(r'"source"\s*:\s*', head)
        if found is not None:
            return SourceRecord.model_validate(json.JSONDecoder().raw_decode(head, found.end())[0])
    return None


def _is_younger(path: Path, born: int) -> bool:
    """Whether a file was written, or put in its place, after a graph [ns]; also where it isn't there any more."""
    try:
        times = path.stat()
    except OSError:
        return True
    return max(times.st_mtime_ns, times.st_ctime_ns) > born


def _difference(path: Path, source: SourceRecord, option: str) -> str:
    """How a file differs from the one that a graph was made from; empty where it doesn't."""
    digest = _digest(path, option) if source.sha256 else ""
    if digest != source.sha256:
        return (
            f"{path}: changed since the graph was built, or another file (sha256 {digest[:12]}..., but "
            f"{source.sha256[:12]}... in the graph)"
        )
    for name, known in source.referred:
        file = path.parent / name
        if not _is_there(file, option):
            return f"{file}: is not there any more, and {path.name} refers to it"
        if _digest(file, option) != known:
            return f"{file}: changed since the graph was built, and {path.name} refers to it"
    return ""


def _is_there(path: Path, option: str) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError) as error:
        raise _unreadable(path, error, option) from error


def _digest(path: Path, option: str) -> str:
    try:
        times = path.stat()
        return _digest_of(path, times.st_mtime_ns, times.st_ctime_ns, times.st_size)
    except OSError as error:
        raise _unreadable(path, error, option) from error


@lru_cache(maxsize=64)
def _digest_of(path: Path, *_: int) -> str:
    """The digest of a file of these times and this size: whoever asks many things of a graph has it read once."""
    return sha256_of(path)


def _unreadable(path: Path, error: Exception, option: str) -> LoadError:
    reason = getattr(error, "strerror", None) or error
    return LoadError(f"{path}: can't be read ({reason}); give the graph's source with {option} FILE")


def _places(path: Path, folder: Path | None) -> Iterator[Path]:
    """Where the file may lie, the likeliest first."""
    yield path
    if folder is not None:
        yield folder / path.name
        # A run writes its folder beside where it was started as a rule.
        beside = folder.resolve().parent
        yield beside / path
        yield beside / path.name
