"""The attribute file beside an RVM file: what PDMS and E3D say of each element.

A line of tokens, then elements within each other: ``NEW`` and the name that the element has in the RVM file,
``key:= value`` (several on a line with ``&end&`` between), ``END``.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from cadgraph._io.limits import lines_within
from cadgraph.load.packing import Notes

__all__ = ["Attributes", "find_attributes", "read_attributes"]

Attributes = dict[str, dict[str, str]]

_KEPT = frozenset(
    ("NAME", "TYPE", "REF", "REFNO", "SPREF", "DESC", "DESCRIPTION", "DTXR", "BORE", "HBOR", "HBORE", "ABOR", "ABORE",
     "LBOR", "LBORE", "HREF", "TREF", "CREF", "GTYP", "GTYPE", "STYP", "STYPE", "FUNC", "FUNCTION")
)  # fmt: skip
_UNSET = frozenset(("", "unset", "=0/0", "nulref", "none"))
_TOKENS = {"start": "NEW", "end": "END", "name_end": ":=", "sep": "&end&"}
_MOST_LINE = 100_000  # characters; ours: real ones have some hundreds
_MOST_VALUE = 2_000  # characters of a value that is kept
_MOST_BYTES = 4 << 30  # ours: a site of two million elements has 2 GB
_MOST_KEPT = 5_000_000  # elements


def find_attributes(path: Path, notes: Notes | None = None) -> Path | None:
    """The attribute file beside a model: the same name with .att, .ATT or .txt.

    Args:
        path: of the model.
        notes: gets what is called so and is none.
    """
    for suffix in (".att", ".ATT", ".Att", ".txt", ".TXT"):
        beside = path.with_suffix(suffix)
        if beside == path or not beside.is_file():
            continue
        if _starts_right(beside):
            return beside
        if notes is not None and suffix.casefold() == ".att":
            notes.add("attributes-unread", f"{beside.name} is no attribute file (it begins with no header); not read")
            break
    return None


def read_attributes(path: Path, notes: Notes) -> Attributes:
    """Reads what tells something of an element, by the element's name in the model.

    Args:
        path: of the attribute file.
        notes: gets what is wrong with it (``attributes-damaged``, ``attributes-unread``).

    Returns:
        For each element its attributes that are known here and set, keys in capitals.
    """
    found: Attributes = {}
    try:
        if path.stat().st_size > _MOST_BYTES:
            notes.add("attributes-unread", f"{path.name} is larger than any attribute file; not read")
            return {}
        encoding = _encoding(path)
        if encoding != "utf-8-sig":
            notes.add("encoding-guessed", f"{path.name} is no UTF-8; read as Windows-1252")
        with path.open(encoding=encoding, errors="replace", newline=None) as file:
            depth = _read(file, found)
    except OSError as error:
        notes.add("attributes-unread", f"{path.name} can't be read ({error.strerror or error})")
        return {}
    if depth:
        notes.add("attributes-damaged", f"{path.name} is cut short: {depth} elements have no end")
    return found


def _read(file: IO[str], found: Attributes) -> int:
    """Fills in the elements; returns how many are left open."""
    lines = lines_within(file, _MOST_LINE)
    tokens = _tokens(next(lines, ""))
    start, end, name_end, sep = (tokens[key] for key in _TOKENS)
    start += " "
    depth = 0
    own: dict[str, str] = {}
    for line in lines:
        text = line.strip()
        if text.startswith(start):
            depth += 1
            name = _bare(text[len(start) :])
            own = {}
            # The first one counts: names are unique where an element is exported once.
            if len(found) < _MOST_KEPT:
                own = found.setdefault(name, own)
        elif text == end:
            depth = max(depth - 1, 0)
            # What follows belongs to the element around, which has said all of itself before.
            own = {}
        else:
            for piece in text.split(sep) if sep in text else (text,):
                key, found_end, value = piece.partition(name_end)
                key = key.strip().upper()
                if found_end and key in _KEPT and key not in own:
                    value = _bare(value)
                    if value.casefold() not in _UNSET:
                        own[key] = value[:_MOST_VALUE]
    return depth


def _bare(value: str) -> str:
    value = value.strip()
    return value[1:-1].strip() if len(value) > 1 and value[0] == value[-1] and value[0] in "'\"" else value


def _tokens(line: str) -> dict[str, str]:
    told = dict(re.findall(r"(\w+):\s*(\S+?)\s*(?:,|$)", line.strip()))
    return {key: told.get(key) or usual for key, usual in _TOKENS.items()}


def _starts_right(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return b"CADC_Attributes_File" in file.read(200)
    except OSError:
        return False


def _encoding(path: Path) -> str:
    with path.open("rb") as file:
        try:
            for _ in _decoded(file):
                pass
        except UnicodeDecodeError:
            return "cp1252"
    return "utf-8-sig"


def _decoded(file: IO[bytes]) -> Iterator[str]:
    decoder = codecs.getincrementaldecoder("utf-8")()
    while block := file.read(1 << 20):
        yield decoder.decode(block)
    yield decoder.decode(b"", final=True)
