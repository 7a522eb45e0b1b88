"""What the text of a STEP physical file (ISO 10303-21) tells without a parser: its schema, and whether it is whole.

STEP and IFC files are both of this kind and differ by their schema alone.
"""

from __future__ import annotations

import re
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cadgraph._io.limits import most_unpacked, size_text
from cadgraph.errors import LoadError

__all__ = ["HEAD", "IFC_MARK", "find_ifc_damage", "is_spf", "renamed_schema", "schema_of", "unzipped"]

HEAD = 1 << 16
"""So many bytes of a file surely hold its header [bytes]; those of real files take some hundred."""

IFC_MARK = "cadgraph"
"""Marks what cadgraph itself added to an IFC file, so that a reader does not take its labels for the author's words."""

_TAIL = 1 << 16  # [bytes] programs that transfer files pad their end with spaces or zeros
_START, _END = b"ISO-10303-21", b"END-ISO-10303-21"
_SCHEMA = re.compile(rb"FILE_SCHEMA\s*\(\s*\(\s*'([^']{1,200})'", re.IGNORECASE)
_MOST_UNPACKED = 4 << 30  # [bytes] the largest known IFC files take about one
_CHUNK = 1 << 20


def is_spf(head: bytes) -> bool:
    """Whether a file that begins so is a STEP physical file."""
    return head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(_START)


def schema_of(head: bytes) -> str | None:
    """The first schema that the header names, in capitals (``"IFC4"``, ``"AUTOMOTIVE_DESIGN"``), or None."""
    found = _SCHEMA.search(head)
    return _short(found[1].decode("ascii", "replace").strip().upper()) if found else None


def find_ifc_damage(path: Path) -> str | None:
    """What shows at both ends of a file that should be IFC, without a full reading.

    A file cut in half opens as a sound one with half of its elements, so that its end is looked at.

    Args:
        path: a file that ends in ``.ifc`` or ``.ifczip``.

    Returns:
        What is wrong and what to do, in one clause, or None. What a zip archive holds is not looked at.
    """
    with path.open("rb") as file:
        head = file.read(HEAD)
        size = file.seek(0, 2)
        file.seek(max(0, size - _TAIL))
        tail = file.read(_TAIL)
    zipped = path.suffix.lower() == ".ifczip"
    if zipped:
        return None if zipfile.is_zipfile(path) else "no zip archive, or cut short; copy or export it again"
    if head.startswith(b"PK\x03\x04"):
        return "a zip archive, no plain IFC file; rename it to end in .ifczip"
    if head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
        return "IFC as XML is not read; export it as a STEP physical file (.ifc)"
    if not is_spf(head):
        return f"no IFC file ({_START.decode()} is missing at its start); export it again"
    schema = schema_of(head)
    if schema is not None and not schema.startswith("IFC"):
        return f"a STEP file by its schema ({schema}), no IFC file; rename it to end in .stp"
    if _END not in tail:
        return f"the file is cut short ({_END.decode()} is missing at its end); copy or export it again"
    return None


def _short(text: str) -> str:
    return "".join(letter if letter.isprintable() else " " for letter in text)[:60]


@contextmanager
def unzipped(path: Path, given: str) -> Iterator[Path]:
    """The IFC file itself, or in a temporary folder the one that an ``.ifczip`` archive holds.

    Args:
        path: of the file.
        given: its path for messages.

    Raises:
        LoadError: the archive can't be read, holds no IFC file or several, is damaged, or unpacks to more than 4 GiB or
            more than such archives do.
    """
    if path.suffix.lower() != ".ifczip":
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="cadgraph-ifc-", ignore_cleanup_errors=True) as folder:
        # The name in the archive is not used: it could lead anywhere.
        plain = Path(folder) / "model.ifc"
        try:
            _unpack(path, plain, given)
        except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError, EOFError) as error:
            raise LoadError(f"{given}: the zip archive can't be unpacked ({error}); export it again as .ifc") from None
        damage = find_ifc_damage(plain)
        if damage:
            raise LoadError(f"{given}: in the archive: {damage}")
        yield plain


def _unpack(path: Path, plain: Path, given: str) -> None:
    with zipfile.ZipFile(path) as archive:
        members = [each for each in archive.infolist() if each.filename.lower().endswith(".ifc")]
        if not members:
            others = any(each.filename.lower().endswith(".ifcxml") for each in archive.infolist())
            why = "IFC as XML alone, which is not read" if others else "no .ifc file"
            raise LoadError(f"{given}: the zip archive holds {why}; export it as .ifc")
        if len(members) > 1:
            raise LoadError(f"{given}: the zip archive holds {len(members)} IFC files; unpack it and give one of them")
        with archive.open(members[0]) as packed, plain.open("wb") as file:
            # What the archive says of its sizes may be wrong, so that what comes is counted.
            most = left = most_unpacked(path.stat().st_size, _MOST_UNPACKED)
            while left > 0 and (chunk := packed.read(min(_CHUNK, left))):
                file.write(chunk)
                left -= len(chunk)
            if left <= 0:
                limit = size_text(most)
                raise LoadError(f"{given}: the zip archive unpacks to more than {limit}; split the model")


def renamed_schema(path: Path, schema: str, copy: Path) -> None:
    """Writes a copy of a STEP physical file whose header names another schema."""
    with path.open("rb") as source, copy.open("wb") as target:
        head = source.read(HEAD)
        target.write(_SCHEMA.sub(b"FILE_SCHEMA(('" + schema.encode("ascii") + b"'", head, count=1))
        shutil.copyfileobj(source, target, _CHUNK)
