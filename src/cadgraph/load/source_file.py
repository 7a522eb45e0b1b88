"""The file that a graph was made from, where it lies now."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from cadgraph._io.digest import sha256_of
from cadgraph.errors import LoadError
from cadgraph.model.records import SourceRecord

__all__ = ["changed_source", "find_source"]


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
        return sha256_of(path)
    except OSError as error:
        raise _unreadable(path, error, option) from error


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
