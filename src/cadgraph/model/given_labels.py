"""Labels from outside: reading them from JSON, CSV or a truth file."""

from __future__ import annotations

import csv
import difflib
import json
import reprlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from cadgraph._io.limits import LABELS, read_text_within
from cadgraph._io.text import quoted
from cadgraph.errors import LabelError
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["GivenLabel", "read_labels", "split_label"]

_OF_PARTS = "largest_mesh"  # a column of our own table of parts, which has no meshes
_MAX_LENGTH = 4096  # of a path or label; longer is no label but damage


@dataclass(frozen=True)
class GivenLabel:
    """What somebody says a mesh is.

    Args:
        mesh: its source path.
        group: a group of the vocabulary.
        name: a name in that group, or None.
        file: where that is written, or "".
    """

    mesh: str
    group: str
    name: str | None
    file: str = field(default="", compare=False)


def read_labels(path: str | Path, vocabulary: Vocabulary) -> tuple[GivenLabel, ...]:
    """Reads labels.

    Args:
        path: a JSON list of ``{"mesh": path, "group": ..., "name": ...}``; an object with such a list under
            ``meshes`` (a truth file); or a CSV with these columns. An empty name leaves it open.
        vocabulary: groups and names must be in it.

    Raises:
        LabelError: the file can't be read, or a row is malformed, repeated, or not in the vocabulary.
    """
    source = Path(path)
    text = read_text_within(source, LABELS, LabelError, "give a JSON or CSV file of labels")
    rows = _csv_rows(text, source) if source.suffix.lower() == ".csv" else _json_rows(text, source)
    labels = tuple(replace(_checked(row, f"{path}: {place}", vocabulary), file=str(path)) for place, row in rows)
    seen: set[str] = set()
    for label in labels:
        if label.mesh in seen:
            raise LabelError(f"{path}: mesh {quoted(label.mesh)} is labelled twice; keep one row")
        seen.add(label.mesh)
    return labels


def _json_rows(text: str, source: Path) -> Iterable[tuple[str, Any]]:
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise LabelError(f"{source}: not JSON ({error}); give a list of {{mesh, group, name}}") from error
    if isinstance(content, Mapping):
        content = content.get("meshes")
    if not isinstance(content, Sequence) or isinstance(content, str):
        raise LabelError(f"{source}: no list of {{mesh, group, name}}, nor an object that holds one under 'meshes'")
    return ((f"entry {i}", row) for i, row in enumerate(content))


def _csv_rows(text: str, source: Path) -> Iterable[tuple[str, Any]]:
    reader = csv.DictReader(text.splitlines())
    missing = {"mesh", "group"} - set(reader.fieldnames or ())
    if _OF_PARTS in (reader.fieldnames or ()):
        raise LabelError(
            f"{source}: a table of parts, and labels are given to meshes; 'cadgraph export FOLDER --to labels-csv' "
            "writes the labels of a graph"
        )
    if missing:
        raise LabelError(f"{source}: no column {sorted(missing)[0]!r}; the first line must name mesh, group, name")
    try:
        rows = [(f"line {reader.line_num}", row) for row in reader]
    except csv.Error as error:
        raise LabelError(f"{source}: line {reader.line_num}: not CSV ({error}); is a quote left open?") from error
    for place, row in rows:
        if None in row:
            raise LabelError(f"{source}: {place}: more values than columns; put what holds a comma in quotes")
    return rows


def _checked(row: Any, place: str, vocabulary: Vocabulary) -> GivenLabel:
    if not isinstance(row, Mapping):
        raise LabelError(f"{place}: not an object with mesh, group and name")
    mesh, group, name = row.get("mesh"), row.get("group"), row.get("name") or None
    for key, value in (("mesh", mesh), ("group", group), ("name", name)):
        if value is None and key != "name":
            raise LabelError(f"{place}: {key!r} is missing")
        if not isinstance(value, str | None) or len(value or "") > _MAX_LENGTH:
            raise LabelError(f"{place}: {key!r} must be text, not {str(value)[:60]!r}")
    if not vocabulary.holds(str(group)):
        raise LabelError(
            f"{place}: group {quoted(str(group))} is not in the vocabulary ({', '.join(vocabulary.groups)}); "
            "add it with --vocabulary"
        )
    if not vocabulary.holds(str(group), name):
        raise LabelError(f"{place}: {quoted(str(name))} is no name of group {group!r}; add it with --vocabulary")
    return GivenLabel(str(mesh), str(group), name)


def split_label(text: str, vocabulary: Vocabulary | None) -> tuple[str, str | None]:
    """The group and name that somebody means.

    Args:
        text: ``group/name``, a group alone, or a name that only one group has.
        vocabulary: must hold it; None takes any ``group/name``.

    Raises:
        LabelError: it is no label, or the vocabulary lacks it.
    """
    group, slash, name = (piece.strip() for piece in text.partition("/"))
    if vocabulary is None:
        # Whatever is no label there is none here.
        Vocabulary.from_json({group: {"names": [name] if name else []}}, reprlib.repr(text))
        return group, name or None
    if vocabulary.holds(group, name or None) and (name or not slash):
        return group, name or None
    owners = [owner for owner, content in vocabulary.groups.items() if not slash and group in content.names]
    if len(owners) == 1:
        return owners[0], group
    if owners:
        raise LabelError(f"{reprlib.repr(text)}: several groups have this name; say group/name ({', '.join(owners)})")
    close = _closest(text, vocabulary)
    hint = f"; did you mean {' or '.join(map(repr, close))}?" if close else "; 'cadgraph vocabulary show' lists them"
    raise LabelError(f"{reprlib.repr(text)} is not in the vocabulary{hint}")


def _closest(text: str, vocabulary: Vocabulary) -> list[str]:
    """The labels that are spelt most like what is none, at most three."""
    _, slash, name = (piece.strip() for piece in text.casefold().partition("/"))
    spelt = [f"{one}/{each}" for one, content in vocabulary.groups.items() for each in content.names]
    folded = {each.casefold(): each for each in spelt}
    close = difflib.get_close_matches(text.casefold(), folded, 3) or difflib.get_close_matches(name, folded, 3, 0.4)
    if close or slash:
        return [folded[each] for each in close]
    # A name alone is compared with names alone; the group before them would make all of them unlike it.
    near = {each.rpartition("/")[2].casefold(): each for each in (*vocabulary.groups, *spelt)}
    return [near[each] for each in difflib.get_close_matches(text.strip().casefold(), near, 3)]
