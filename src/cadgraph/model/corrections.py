"""A user's corrections beside a graph (``corrections.json``): which part is what, whatever a labeler says.

A correction is kept under the source path of the part's largest mesh together with numbers that no motion changes, so
that it finds its part again when the source is exported anew, and is not laid on another part by mistake.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cadgraph._io import limits
from cadgraph._io.json_rows import write_json_rows
from cadgraph._io.limits import read_text_within
from cadgraph.errors import LabelError
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = ["CORRECTIONS", "Correction", "Fingerprint", "read_corrections", "with_correction", "write_corrections"]

CORRECTIONS = "corrections.json"
"""Name of the file beside the graph."""

_FORMAT, _VERSION = "cadgraph-corrections", 1
_MOST, _MOST_TEXT = 100_000, 4096
_SLACK = 1e-3  # of a length; ours: another writer rounds to single precision, another tessellation differs by more
_LEAST = 1e-5  # m
_FAR = 1e12  # m; beyond lies no plant


@dataclass(frozen=True)
class Fingerprint:
    """What of a shape stays in any pose.

    Args:
        n_triangles: of the part.
        lengths: square root of the area, then the extents of the oriented box, descending [m].
    """

    n_triangles: int
    lengths: tuple[float, float, float, float]

    def agrees(self, other: Fingerprint) -> bool:
        """Whether both may be of one shape."""
        return self.n_triangles == other.n_triangles and all(
            abs(a - b) <= _LEAST + _SLACK * max(a, b) for a, b in zip(self.lengths, other.lengths, strict=True)
        )


@dataclass(frozen=True)
class Correction:
    """What a user says about one part.

    Args:
        mesh: source path of its largest mesh.
        group: of the vocabulary.
        name: in that group, or None.
        fingerprint: of the part.
        centroid: of the part, world coordinates [m].
        this_only: whether it says nothing about others.
    """

    mesh: str
    group: str
    name: str | None
    fingerprint: Fingerprint
    centroid: tuple[float, float, float]
    this_only: bool = False


def with_correction(corrections: Sequence[Correction], new: Correction) -> tuple[Correction, ...]:
    """The corrections with a new one; an earlier one of the same mesh is replaced."""
    return (*(old for old in corrections if old.mesh != new.mesh), new)


def write_corrections(corrections: Sequence[Correction], path: str | Path) -> Path:
    """Writes corrections, whole or not at all; the same corrections give the same bytes.

    Args:
        corrections: in the order in which they were made.
        path: the file.

    Raises:
        OutputError: it can't be written.
    """
    rows = [
        {
            "mesh": c.mesh,
            "group": c.group,
            "name": c.name,
            "this_only": c.this_only,
            "n_triangles": c.fingerprint.n_triangles,
            "lengths": list(c.fingerprint.lengths),
            "centroid": list(c.centroid),
        }
        for c in corrections
    ]
    document = {"format": _FORMAT, "version": _VERSION, "corrections": rows}
    write_json_rows(path, document, rows=("corrections",))
    return Path(path)


def read_corrections(path: str | Path, vocabulary: Vocabulary | None = None) -> tuple[Correction, ...]:
    """Reads corrections; none if the file isn't there.

    Args:
        path: the file, or the folder that holds it.
        vocabulary: must hold their labels; None asks nothing.

    Raises:
        LabelError: the file can't be read, is damaged, or names labels that the vocabulary lacks.
    """
    file = Path(path) / CORRECTIONS if Path(path).is_dir() else Path(path)
    if not file.exists():
        return ()
    text = read_text_within(file, limits.CORRECTIONS, LabelError, "take rows out, or remove it to build without")
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise LabelError(f"{file}: not JSON ({error}); correct it, or remove it to build without") from error
    if not isinstance(content, Mapping) or content.get("format") != _FORMAT:
        raise LabelError(f"{file}: no corrections of cadgraph; move it elsewhere, or choose another folder")
    if content.get("version") != _VERSION:
        raise LabelError(
            f"{file}: corrections of version {str(content.get('version'))[:20]}, but this cadgraph reads version "
            f"{_VERSION}; update it"
        )
    rows = content.get("corrections")
    if not isinstance(rows, list) or len(rows) > _MOST:
        raise LabelError(f"{file}: no list of at most {_MOST:,} corrections; remove the file to build without")
    found = []
    for i, row in enumerate(rows):
        correction = _correction(row, f"{file}: correction {i}")
        if vocabulary is not None and not vocabulary.holds(correction.group, correction.name):
            label = spell_label(correction.group, correction.name)
            raise LabelError(
                f"{file}: correction {i}: {label!r} is not in the vocabulary; build with the --vocabulary that has it, "
                "or take the row out"
            )
        found.append(correction)
    return tuple(found)


def _correction(row: Any, place: str) -> Correction:
    if not isinstance(row, Mapping):
        raise LabelError(f"{place}: not an object with mesh, group, name; take it out")
    texts = {key: row.get(key) for key in ("mesh", "group", "name")}
    for key, text in texts.items():
        if not (isinstance(text, str) and 0 < len(text) <= _MOST_TEXT) and not (key == "name" and text is None):
            raise LabelError(f"{place}: {key!r} must be text, not {str(text)[:60]!r}")
    if not isinstance(row.get("this_only", False), bool):
        raise LabelError(f"{place}: 'this_only' must be true or false")
    count = row.get("n_triangles")
    if not isinstance(count, int) or isinstance(count, bool) or count < 0:
        raise LabelError(f"{place}: 'n_triangles' must be a number of triangles")
    lengths, centroid = _numbers(row, "lengths", 4, place), _numbers(row, "centroid", 3, place)
    return Correction(
        str(texts["mesh"]),
        str(texts["group"]),
        texts["name"],
        Fingerprint(count, (lengths[0], lengths[1], lengths[2], lengths[3])),
        (centroid[0], centroid[1], centroid[2]),
        row.get("this_only", False),
    )


def _numbers(row: Mapping[str, Any], key: str, n: int, place: str) -> list[float]:
    values = row.get(key)
    if (
        not isinstance(values, list)
        or len(values) != n
        or not all(isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < _FAR for v in values)
    ):
        raise LabelError(f"{place}: {key!r} must be {n} finite numbers")
    return [float(v) for v in values]
