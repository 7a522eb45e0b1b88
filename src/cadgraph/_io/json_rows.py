"""JSON documents that people can read and compare, a line for each key and each row of a list; and JSON read fast."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticSerializationError, from_json

from cadgraph._io.atomic import replacing

__all__ = ["json_row", "json_rows", "read_json", "write_json_rows"]


def read_json(text: str | bytes) -> Any:
    """What a JSON document says, as ``json.loads`` gives it, only faster as a rule.

    Raises:
        ValueError: it isn't JSON.
        RecursionError: it holds values in too many levels.
    """
    try:
        return from_json(text)
    except ValueError:
        # Some things are refused that the slower reader takes, as lone surrogates; and its messages are known better.
        return json.loads(text)


def write_json_rows(target: str | Path, document: Mapping[str, Any], rows: Collection[str]) -> None:
    """Writes a JSON object, whole or not at all; the same object gives the same bytes.

    Args:
        target: the file.
        document: what to write.
        rows: the keys whose values are lists or tuples with a line for each item: plain values, or records of pydantic,
            whose lines have no spaces between values.

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
            before = b"  "
            for item in value:
                yield before
                yield json_row(item)
                before = b",\n  "
            yield b"\n ]"
        else:
            yield _encoded(f"{between} {_dumps(key)}: {_dumps(value)}")
        between = ",\n"
    yield b"\n}\n" if between != "{\n" else b"{\n\n}\n"


def json_row(row: Any) -> bytes:
    """One row as it stands in such a document: of plain values, or a record of pydantic.

    Raises:
        ValueError: a number is infinite or NaN.
    """
    if not isinstance(row, BaseModel):
        return _encoded(_dumps(row))
    try:
        line = row.__pydantic_serializer__.to_json(row)
    except PydanticSerializationError:
        line = b""  # a lone surrogate
    # A number that JSON lacks comes out by its name (or as null, as a record is set); strings may hold the same.
    if not line or b"NaN" in line or b"Infinity" in line:
        return _encoded(_dumps(row.model_dump(mode="json")))
    return line


def _encoded(text: str) -> bytes:
    # A lone surrogate has no UTF-8, but its backslash form is what JSON calls it.
    return text.encode("utf-8", "backslashreplace")


_dumps = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode
