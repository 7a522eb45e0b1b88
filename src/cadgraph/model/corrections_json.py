"""How ``corrections.json`` is written and read: every field is checked, and a bad one is told in one line."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from cadgraph._io import limits
from cadgraph.errors import LabelError
from cadgraph.model.anchors import Anchor, Fingerprint
from cadgraph.model.edits import (
    LONGEST_TAG,
    Correction,
    Cut,
    Device,
    Direction,
    Edit,
    Forget,
    Ground,
    Join,
    Merge,
    Split,
    Tag,
    check_tag,
    describe,
)

__all__ = ["FORMAT", "MOST", "VERSION", "check_row", "event_row", "read_document"]

FORMAT, VERSION = "cadgraph-corrections", 2
MOST = 100_000
"""Actions, and edits of one action, that are read at most."""

_MOST_TEXT = 4096  # characters
_FAR = 1e12  # m; beyond lies no plant

# --- writing ---


def event_row(event: Mapping[str, Any]) -> dict[str, Any]:
    """An action, given by its fields, as it stands in the file."""
    row: dict[str, Any] = {"event": event["kind"], "id": event["id"]}
    # What was done is in the edits; these words may leave out the end of a long name.
    row |= {key: event[key][:_MOST_TEXT] for key in ("when", "who", "why", "what")}
    return row | ({"edits": [_edit_row(e) for e in event["edits"]]} if event["kind"] == "do" else {"of": event["of"]})


def check_row(row: Mapping[str, Any], place: str) -> None:
    """Makes sure that a row that is to be written will be read again.

    Args:
        row: as ``event_row`` makes it.
        place: what to call it in a message.

    Raises:
        LabelError: it would not be.
    """
    _event(row, place)


def _edit_row(edit: Edit) -> dict[str, Any]:
    match edit:
        case Correction():
            part = _anchor_row(edit.anchor)
            return {"kind": "label", "part": part, "group": edit.group, "name": edit.name, "this_only": edit.this_only}
        case Forget():
            return {"kind": "forget", "part": _anchor_row(edit.part)}
        case Merge() | Split():
            return {"kind": "merge" if isinstance(edit, Merge) else "split", "parts": _anchor_rows(edit.parts)}
        case Join() | Cut():
            kind = "join" if isinstance(edit, Join) else "cut"
            return {"kind": kind, "first": _anchor_row(edit.first), "second": _anchor_row(edit.second)}
        case Direction():
            row = {key: _anchor_rows(getattr(edit, key)) for key in ("source", "target", "via")}
            return {"kind": "direction", **row, "ends": [list(end) for end in edit.ends], "flow": edit.flow}
        case Tag():
            return {"kind": "tag", "parts": _anchor_rows(edit.parts), "tag": edit.tag}
        case Device():
            return {"kind": "device", "parts": _anchor_rows(edit.parts), "device": edit.device}
        case Ground():
            return {"kind": "ground", "mesh": _anchor_row(edit.mesh), "ground": edit.ground}


def _anchor_row(anchor: Anchor) -> dict[str, Any]:
    lengths, centroid = list(anchor.fingerprint.lengths), list(anchor.centroid)
    return {
        "mesh": anchor.mesh,
        "n_triangles": anchor.fingerprint.n_triangles,
        "lengths": lengths,
        "centroid": centroid,
    }


def _anchor_rows(anchors: tuple[Anchor, ...]) -> list[dict[str, Any]]:
    return [_anchor_row(anchor) for anchor in anchors]


# --- reading ---


def read_document(content: bytes, file: Path) -> list[dict[str, Any]]:
    """The fields of each action of a file, in order.

    Args:
        content: of the file.
        file: its path, for messages.

    Raises:
        LabelError: it is damaged; the message names the row and the field.
    """
    try:
        document = json.loads(content.decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise LabelError(f"{file}: not JSON ({error}); correct it, or remove it to build without") from error
    if not isinstance(document, Mapping) or document.get("format") != FORMAT:
        raise LabelError(f"{file}: no corrections of cadgraph; move it elsewhere, or choose another folder")
    version = document.get("version")
    if version not in (1, VERSION) or isinstance(version, bool):
        raise LabelError(
            f"{file}: corrections of version {str(version)[:20]}, but this cadgraph reads version {VERSION}; update it"
        )
    key = "corrections" if version == 1 else "events"
    rows = document.get(key)
    if not isinstance(rows, list) or len(rows) > MOST:
        raise LabelError(f"{file}: {key!r} is no list of at most {MOST:,}; remove the file to build without")
    if version == 1:
        return [_first_version(row, k, f"{file}: correction {k}") for k, row in enumerate(rows, 1)]
    events = [_event(row, f"{file}: correction {k}") for k, row in enumerate(rows, 1)]
    for k, event in enumerate(events):
        if event["id"] <= (events[k - 1]["id"] if k else 0):
            raise LabelError(f"{file}: correction {k + 1}: 'id' must grow from row to row")
    return events


def _first_version(row: Any, number: int, place: str) -> dict[str, Any]:
    """A label of version 1, which knew nothing else."""
    edit = _label(row, _anchor(row, place), place)
    told = {"when": "", "who": "", "why": "", "what": describe(edit)}
    return {"id": number, **told, "edits": (edit,), "kind": "do", "of": None}


def _event(row: Any, place: str) -> dict[str, Any]:
    if not isinstance(row, Mapping):
        raise LabelError(f"{place}: not an object with event, id, what; take it out")
    kind = _one_of(row, "event", ("do", "undo", "redo"), place)
    told = {key: _text(row, key, place, empty=True) for key in ("when", "who", "why", "what")}
    edits: tuple[Edit, ...] = ()
    if kind == "do":
        rows = row.get("edits")
        if not isinstance(rows, list) or not 0 < len(rows) <= MOST:
            raise LabelError(f"{place}: 'edits' must be a list of at least one and at most {MOST:,}")
        edits = tuple(_edit(each, f"{place}: edit {k}") for k, each in enumerate(rows, 1))
    of = None if kind == "do" else _count(row, "of", place)
    return {"id": _count(row, "id", place), **told, "edits": edits, "kind": kind, "of": of}


def _edit(row: Any, place: str) -> Edit:
    if not isinstance(row, Mapping):
        raise LabelError(f"{place}: not an object with a kind; take it out")
    return _READERS[_one_of(row, "kind", tuple(_READERS), place)](row, place)


def _label(row: Mapping[str, Any], part: Anchor, place: str) -> Correction:
    group = _text(row, "group", place)
    name = None if row.get("name") is None else _text(row, "name", place)
    this_only = _flag(row, "this_only", place) if "this_only" in row else False
    return Correction(part.mesh, group, name, part.fingerprint, part.centroid, this_only)


def _direction(row: Mapping[str, Any], place: str) -> Direction:
    ends = row.get("ends")
    if not isinstance(ends, list) or len(ends) != 2:
        raise LabelError(f"{place}: 'ends' must be two points")
    first, last = (_numbers({"ends": end}, "ends", 3, place) for end in ends)
    return Direction(
        _anchors(row, "source", place),
        _anchors(row, "target", place),
        _anchors(row, "via", place),
        ((first[0], first[1], first[2]), (last[0], last[1], last[2])),
        _one_of(row, "flow", ("forward", "backward", "unknown"), place),  # type: ignore[arg-type]
    )


def _tag(row: Mapping[str, Any], place: str) -> Tag:
    return Tag(_anchors(row, "parts", place, least=1), _called(row, "tag", place))


def _device(row: Mapping[str, Any], place: str) -> Device:
    return Device(_anchors(row, "parts", place, least=1), _called(row, "device", place))


def _called(row: Mapping[str, Any], key: str, place: str) -> str:
    text = _text(row, key, place)
    try:
        return check_tag(text)
    except ValueError as error:
        raise LabelError(f"{place}: {key!r}: {error} (at most {LONGEST_TAG} printable characters)") from None


def _part(row: Mapping[str, Any], key: str, place: str) -> Anchor:
    return _anchor(row.get(key), f"{place}: {key!r}")


_READERS: Mapping[str, Callable[[Mapping[str, Any], str], Edit]] = {
    "label": lambda row, place: _label(row, _part(row, "part", place), place),
    "forget": lambda row, place: Forget(_part(row, "part", place)),
    "merge": lambda row, place: Merge(_anchors(row, "parts", place, least=2)),
    "split": lambda row, place: Split(_anchors(row, "parts", place, least=1)),
    "join": lambda row, place: Join(_part(row, "first", place), _part(row, "second", place)),
    "cut": lambda row, place: Cut(_part(row, "first", place), _part(row, "second", place)),
    "direction": _direction,
    "tag": _tag,
    "device": _device,
    "ground": lambda row, place: Ground(_part(row, "mesh", place), _flag(row, "ground", place)),
}


def _anchor(row: Any, place: str) -> Anchor:
    if not isinstance(row, Mapping):
        raise LabelError(f"{place}: not an object with mesh, n_triangles, lengths, centroid; take it out")
    # As long as the paths of the source are.
    mesh = _text(row, "mesh", place, most=limits.CORRECTIONS.most)
    count = _count(row, "n_triangles", place)
    lengths, centroid = _numbers(row, "lengths", 4, place), _numbers(row, "centroid", 3, place)
    fingerprint = Fingerprint(count, (lengths[0], lengths[1], lengths[2], lengths[3]))
    return Anchor(mesh, fingerprint, (centroid[0], centroid[1], centroid[2]))


def _anchors(row: Mapping[str, Any], key: str, place: str, least: int = 0) -> tuple[Anchor, ...]:
    rows = row.get(key)
    if not isinstance(rows, list) or not least <= len(rows) <= MOST:
        raise LabelError(f"{place}: {key!r} must be a list of at least {least} and at most {MOST:,} parts")
    return tuple(_anchor(each, f"{place}: {key!r} {k}") for k, each in enumerate(rows, 1))


def _text(row: Mapping[str, Any], key: str, place: str, empty: bool = False, most: int = _MOST_TEXT) -> str:
    text = row.get(key)
    if not isinstance(text, str) or not (0 if empty else 1) <= len(text) <= most:
        raise LabelError(f"{place}: {key!r} must be text of at most {most:,} characters, not {str(text)[:60]!r}")
    return text


def _one_of(row: Mapping[str, Any], key: str, allowed: tuple[str, ...], place: str) -> str:
    value = row.get(key)
    if not isinstance(value, str) or value not in allowed:
        raise LabelError(f"{place}: {key!r} must be one of {', '.join(allowed)}, not {str(value)[:60]!r}")
    return value


def _flag(row: Mapping[str, Any], key: str, place: str) -> bool:
    value = row.get(key)
    if not isinstance(value, bool):
        raise LabelError(f"{place}: {key!r} must be true or false")
    return value


def _count(row: Mapping[str, Any], key: str, place: str) -> int:
    count = row.get(key)
    if not isinstance(count, int) or isinstance(count, bool) or not 0 <= count < _FAR:
        raise LabelError(f"{place}: {key!r} must be a whole number")
    return count


def _numbers(row: Mapping[str, Any], key: str, n: int, place: str) -> list[float]:
    values = row.get(key)
    if (
        not isinstance(values, list)
        or len(values) != n
        or not all(isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < _FAR for v in values)
    ):
        raise LabelError(f"{place}: {key!r} must be {n} finite numbers")
    return [float(v) for v in values]
