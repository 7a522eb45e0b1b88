"""JSON documents that people can read and compare: a line for each key, and for each row of a list of objects."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import write_atomically

__all__ = ["json_rows", "write_json_rows"]


def write_json_rows(target: str | Path, document: Mapping[str, Any], rows: Collection[str]) -> None:
    """Writes a JSON object, whole or not at all; the same object gives the same bytes.

    Args:
        target: the file.
        document: what to write.
        rows: the keys whose values are lists with a line for each item.

    Raises:
        OutputError: it can't be written.
        ValueError: a number is infinite or NaN.
    """
    write_atomically(target, json_rows(document, rows))


def json_rows(document: Mapping[str, Any], rows: Collection[str]) -> bytes:
    """The bytes that ``write_json_rows`` writes of a JSON object."""
    lines = []
    for key, value in document.items():
        if key in rows and value:
            items = ",\n".join("  " + _dumps(item) for item in value)
            lines.append(f" {_dumps(key)}: [\n{items}\n ]")
        else:
            lines.append(f" {_dumps(key)}: {_dumps(value)}")
    # A lone surrogate has no UTF-8, but its backslash form is what JSON calls it.
    return ("{\n" + ",\n".join(lines) + "\n}\n").encode("utf-8", "backslashreplace")


def _dumps(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
