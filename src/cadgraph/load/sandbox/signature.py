"""What the first bytes of a file tell, before any library touches it."""

from __future__ import annotations

import stat
import zipfile
from pathlib import Path

from cadgraph._io.spf import HEAD, find_ifc_damage, is_spf, schema_of

__all__ = ["find_damage", "kind_of", "name_content"]

_CRATE = b"PXR-USDC"
_CRATE_HEADER = 88  # identifier 8, version 8, offset of the table of contents 8, reserved 64 (OpenUSD crateFile.cpp)


def kind_of(mode: int) -> str:
    """What a file that isn't regular is, from its ``st_mode``; to open one may wait for ever."""
    kinds = ((stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a named pipe"), (stat.S_ISSOCK, "a socket"))
    return next((name for is_kind, name in kinds if is_kind(mode)), "a device")


def name_content(path: Path) -> str | None:
    """The format that a file's content shows (``"usd"``, ``"step"``, ``"ifc"``), or None."""
    head = _head(path, 512)
    if head.startswith((_CRATE, b"#usda ")):
        return "usd"
    if is_spf(head):
        return "ifc" if (schema_of(_head(path, HEAD)) or "").startswith("IFC") else "step"
    return None


def find_damage(path: Path, form: str) -> str | None:
    """Damage that shows without a full reading: a cut-off binary, a package that is none, text in place of a model.

    Args:
        path: of the file.
        form: the format that its suffix names.

    Returns:
        What is wrong and what to do, in one clause, or None.
    """
    if form == "usd":
        return _usd_damage(path)
    if form == "ifc":
        return find_ifc_damage(path)
    if form == "step":
        return _step_damage(path)
    return None


def _step_damage(path: Path) -> str | None:
    head = _head(path, HEAD)
    if b"ISO-10303-21" not in head[:4096]:
        return "no STEP file (ISO-10303-21 is missing at its start); export it again"
    schema = schema_of(head)
    if schema is not None and schema.startswith("IFC"):
        return f"an IFC file by its schema ({schema}); rename it to end in .ifc"
    return None


def _usd_damage(path: Path) -> str | None:
    suffix = path.suffix.lower()
    head = _head(path, _CRATE_HEADER)
    if suffix == ".usdz":
        if not zipfile.is_zipfile(path):
            return "no usdz package (not a zip archive, or cut short); copy or export it again"
        return None
    if head.startswith(_CRATE):
        size = path.stat().st_size
        table = int.from_bytes(head[16:24], "little")
        if len(head) < _CRATE_HEADER or table >= size:
            return f"the file is cut short (only {size} bytes are there); copy or export it again"
        return None
    if suffix == ".usdc":
        return "no binary USD file (it doesn't start with PXR-USDC); rename it to .usd or export it again"
    if not head.lstrip(b"\xef\xbb\xbf").startswith(b"#usda"):
        return "no USD file (it starts neither with #usda nor with PXR-USDC); export it again"
    return None


def _head(path: Path, length: int) -> bytes:
    with path.open("rb") as file:
        return file.read(length)
