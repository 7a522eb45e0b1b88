"""What the first bytes of a file tell, before any library touches it."""

from __future__ import annotations

import re
import stat
import zipfile
from pathlib import Path

from cadgraph._io.spf import HEAD, find_ifc_damage, is_spf, schema_of

__all__ = ["find_damage", "kind_of", "name_content", "stl_is_binary"]

_CRATE = b"PXR-USDC"
_RVM = b"\0\0\0H\0\0\0E\0\0\0A\0\0\0D"
_CRATE_HEADER = 88  # identifier 8, version 8, offset of the table of contents 8, reserved 64 (OpenUSD crateFile.cpp)

_ZIP = b"PK\x03\x04"
_STL_HEADER = 84  # 80 bytes of text and the number of triangles, 50 bytes each


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
    if head.startswith(b"glTF"):
        return "gltf"
    if head.startswith(_RVM) or re.match(rb"HEAD\s*\r?\n", head):
        return "rvm"
    if head.startswith((b"ply\n", b"ply\r")):
        return "ply"
    if b"<COLLADA" in head:
        return "collada"
    if head.lstrip()[:6].lower() == b"solid " and b"facet" in head.lower():
        return "stl"
    if head.lstrip().startswith(b"{") and b'"asset"' in head:
        return "gltf"
    return "3mf" if head.startswith(_ZIP) and _is_3mf(path) else None


def find_damage(path: Path, form: str) -> str | None:
    """Damage that shows without a full reading: a cut-off binary, a package that is none, text in place of a model.

    Args:
        path: of the file.
        form: the format that its suffix names.

    Returns:
        What is wrong and what to do, in one clause, or None.
    """
    find = _FIND.get(form)
    return find(path) if find else None


def _step_damage(path: Path) -> str | None:
    head = _head(path, HEAD)
    if b"ISO-10303-21" not in head[:4096]:
        return "no STEP file (ISO-10303-21 is missing at its start); export it again"
    schema = schema_of(head)
    if schema is not None and schema.startswith("IFC"):
        return f"an IFC file by its schema ({schema}); rename it to end in .ifc"
    return None


def stl_is_binary(path: Path) -> bool:
    """Whether an STL file is binary: by its size, as the header of a binary one may begin with ``solid``, too."""
    head = _head(path, 512)
    if len(head) >= _STL_HEADER and path.stat().st_size == _stl_size(head):
        return True
    return head.lstrip()[:5].lower() != b"solid" or b"\0" in head


def _stl_size(head: bytes) -> int:
    return _STL_HEADER + 50 * int.from_bytes(head[80:84], "little")


def _stl_damage(path: Path) -> str | None:
    size, head = path.stat().st_size, _head(path, 512)
    if not stl_is_binary(path):
        return None
    if size < _STL_HEADER:
        return f"no STL file (only {size} bytes are there); copy or export it again"
    other = name_content(path)
    if other not in (None, "stl"):
        return f"no STL file (its content looks like {other}); give it the suffix of that format"
    if size < _stl_size(head):
        promised = int.from_bytes(head[80:84], "little")
        return (
            f"no STL file, or cut short (it promises {promised:,} triangles, and {(size - _STL_HEADER) // 50:,} are "
            "there); copy or export it again"
        )
    return None


def _gltf_damage(path: Path) -> str | None:
    head = _head(path, 64)
    if head.startswith(b"glTF"):
        size, promised = path.stat().st_size, int.from_bytes(head[8:12], "little")
        if size < promised:
            return f"the file is cut short ({size} of {promised} bytes are there); copy or export it again"
        return None
    if not head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{"):
        return "no glTF file (it starts neither with glTF nor with a brace); export it again"
    return None


def _ply_damage(path: Path) -> str | None:
    if not _head(path, 4).startswith((b"ply\n", b"ply\r")):
        return "no PLY file (it doesn't start with ply); export it again"
    return None


def _obj_damage(path: Path) -> str | None:
    head = _head(path, 512)
    other = name_content(path)
    if other or b"\0" in head:
        looks = f" (its content looks like {other})" if other else ""
        return f"no OBJ file but a binary or other one{looks}; give it the suffix of its format"
    return None


def _collada_damage(path: Path) -> str | None:
    if not re.search(rb"<(\w+:)?COLLADA[\s>]", _head(path, 4096)):
        return "no COLLADA file (<COLLADA is missing at its start); export it again"
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 512))
        if not re.search(rb"</(\w+:)?COLLADA\s*>", file.read()):
            return "the file is cut short (</COLLADA> is missing at its end); copy or export it again"
    return None


def _3mf_damage(path: Path) -> str | None:
    if not zipfile.is_zipfile(path):
        return "no 3MF package (not a zip archive, or cut short); copy or export it again"
    if not _is_3mf(path):
        return "no 3MF package (it holds no 3dmodel.model); export it again"
    return None


def _is_3mf(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as package:
            return any(name.lower().endswith("3d/3dmodel.model") for name in package.namelist())
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError):
        return False


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


_FIND = {
    "usd": _usd_damage,
    "step": _step_damage,
    "ifc": find_ifc_damage,
    "gltf": _gltf_damage,
    "obj": _obj_damage,
    "stl": _stl_damage,
    "ply": _ply_damage,
    "3mf": _3mf_damage,
    "collada": _collada_damage,
}


def _head(path: Path, length: int) -> bytes:
    with path.open("rb") as file:
        return file.read(length)
