"""JSON documents that people can read and compare: a line for each key, and for each row of a list of objects."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import replacing

__all__ = ["json_rows", "write_json_rows"]


def write_json_rows(target: str | Path, document: Mapping[str, Any], rows: Collection[str]) -> None:
    """Writes a JSON object, whole or not at all; the same object gives the same bytes.

    Args:
        target: the file.
        document: what to write.
        rows: the keys whose values are lists with a line for each item, or iterators over at least one.

    Raises:
        OutputError: it can't be written.
        ValueError: a number is infinite or NaN.
    """
    with replacing(target) as beside, beside.open("wb") as file:
        for piece in _pieces(document, rows):
            file.write(piece)


def json_rows(document: Mapping[str, Any], rows: Collection[str]) -> bytes:
    """The bytes that ``write_json_rows`` writes of a JSON object."""
    return b"".join(_pieces(document, rows))


def _pieces(document: Mapping[str, Any], rows: Collection[str]) -> Iterator[bytes]:
    """The bytes of a JSON object, row by row, so that no more than one row need be in memory."""
    between = "{\n"
    for key, value in document.items():
        if key in rows and value:
            yield _encoded(f"{between} {_dumps(key)}: [\n")
            before = "  "
            for item in value:
                yield _encoded(before + _dumps(item))
                before = ",\n  "
            yield b"\n ]"
        else:
            yield _encoded(f"{between} {_dumps(key)}: {_dumps(value)}")
        between = ",\n"
    yield b"\n}\n" if between != "{\n" else b"{\n\n}\n"


def _encoded(text: str) -> bytes:
    # A lone surrogate has no UTF-8, but its backslash form is what JSON calls it.
    return text.encode("utf-8", "backslashreplace")


_dumps = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode
