"""The container of glTF 2.0: JSON, buffers and accessors, each checked against what is really there.

Numbers in brackets are sections of the Khronos glTF 2.0 specification.
"""

from __future__ import annotations

import base64
import binascii
import json
import mmap
import struct
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.load.beside import file_beside

__all__ = ["BROKEN", "MESHOPT", "Gltf", "open_gltf", "parse_glb"]

BROKEN = (AttributeError, KeyError, IndexError, OverflowError, TypeError, ValueError)
"""What reading a tree whose members have other types or lie elsewhere than they should ends in."""

Bytes = bytes | mmap.mmap

_JSON, _BIN = 0x4E4F534A, 0x004E4942  # types of chunks [4.4.3]
_COMPONENT = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}  # [3.6.2.2]
_WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_MOST_SPARSE = 10_000_000  # values of an accessor that no bytes stand for; ours
_MOST_JSON = 1 << 30  # bytes; a node takes about 200: five million nodes
MESHOPT = frozenset(("EXT_meshopt_compression", "KHR_meshopt_compression"))
"""Extensions that compress buffers in a way that is not read."""


class Gltf:
    """An opened file.

    Args:
        tree: its JSON.
        path: of the file, for messages and for buffers beside it.
        own: its binary chunk, if any.
        size: of the file [bytes].
    """

    def __init__(self, tree: Mapping[str, Any], path: Path, own: memoryview | None, size: int = 0) -> None:
        self.tree = tree
        self._path = path
        self._own = own
        self._size = size
        self._sparse: dict[int, npt.NDArray[Any]] = {}

    def rows(self, name: str) -> Sequence[Any]:
        """One of the lists at the top of the tree (``"nodes"``), empty where it isn't there."""
        found = self.tree.get(name, [])
        return found if isinstance(found, list) else []

    def item(self, name: str, number: Any) -> Mapping[str, Any]:
        """One row of such a list.

        Raises:
            IndexError, TypeError: there is none of this number.
        """
        rows = self.rows(name)
        if not isinstance(number, int) or not 0 <= number < len(rows):
            raise IndexError(f"there are {len(rows)} {name}, but number {number!r:.20} is asked for")
        row = rows[number]
        if not isinstance(row, dict):
            raise TypeError(f"number {number} of {name} is no object")
        return row

    @cached_property
    def _buffers(self) -> tuple[memoryview | None, ...]:
        return tuple(self._buffer(i, row) for i, row in enumerate(self.rows("buffers")))

    def load_buffers(self) -> None:
        """Opens all buffers.

        Raises:
            LoadError: one is missing, too short or lies where nothing is opened.
        """
        _ = self._buffers

    def _buffer(self, number: int, row: Any) -> memoryview | None:
        if not isinstance(row, dict) or not isinstance(row.get("byteLength", 0), int):
            raise LoadError(f"{self._path}: buffer {number} is no object with a length; export the file again")
        uri, length = row.get("uri"), row.get("byteLength", 0)
        if not isinstance(uri, str):
            extensions = row.get("extensions")
            if isinstance(extensions, dict) and not MESHOPT.isdisjoint(extensions):
                raise LoadError(f"{self._path}: {MESHOPT_REMEDY}")
            data = self._own if number == 0 else None
        elif uri.startswith("data:"):
            data = memoryview(_decoded(uri, f"{self._path}: buffer {number}"))
        else:
            data = memoryview(_mapped(file_beside(self._path, unquote(uri))))
        if data is not None and len(data) < length:
            raise LoadError(
                f"{self._path}: buffer {number} has {len(data)} of {length} bytes, cut short; copy or export it again"
            )
        return data

    @property
    def size(self) -> int:
        """Bytes of the file with all its buffers; those that it holds itself count once."""
        return self._size + sum(
            len(buffer) for buffer in self._buffers if buffer is not None and buffer is not self._own
        )

    def view(self, number: Any) -> memoryview:
        """The bytes of a buffer view [3.6.1].

        Raises:
            IndexError, TypeError, ValueError: they aren't there.
        """
        row = self.item("bufferViews", number)
        buffer = self._buffers[_count(row["buffer"])]
        if buffer is None:
            raise ValueError(f"buffer {row['buffer']} holds no bytes")
        start, length = _count(row.get("byteOffset", 0)), _count(row["byteLength"])
        if start + length > len(buffer):
            raise ValueError(f"buffer view {number} reaches beyond its buffer")
        return buffer[start : start + length]

    def accessor(self, number: Any) -> npt.NDArray[Any]:
        """The values of an accessor [3.6.2], as they are stored, not normalized.

        Returns:
            ``(count, width)``, often a view of the file.

        Raises:
            IndexError, KeyError, TypeError, ValueError: they aren't there.
        """
        row = self.item("accessors", number)
        if "sparse" not in row:
            return self._dense(row)
        if number not in self._sparse:
            # The last one only: primitives that share it follow each other.
            self._sparse = {number: self._with_sparse(row)}
        return self._sparse[number]

    def _dense(self, row: Mapping[str, Any]) -> npt.NDArray[Any]:
        dtype, width, count = np.dtype(_COMPONENT[row["componentType"]]), _WIDTH[row["type"]], _count(row["count"])
        if "bufferView" not in row:
            if count > _MOST_SPARSE:
                raise ValueError(f"an accessor of {count} values without any bytes")
            return np.zeros((count, width), dtype)
        stride = self.item("bufferViews", row["bufferView"]).get("byteStride", width * dtype.itemsize)
        return _strided(self.view(row["bufferView"]), row.get("byteOffset", 0), count, width, dtype, stride)

    def _with_sparse(self, row: Mapping[str, Any]) -> npt.NDArray[Any]:
        values, sparse = self._dense(row).copy(), row["sparse"]
        count, at, new = _count(sparse["count"]), sparse["indices"], sparse["values"]
        kind = np.dtype(_COMPONENT[at["componentType"]])
        where = _strided(self.view(at["bufferView"]), at.get("byteOffset", 0), count, 1, kind, kind.itemsize)
        size = values.shape[1] * values.itemsize
        values[where[:, 0]] = _strided(
            self.view(new["bufferView"]), new.get("byteOffset", 0), count, values.shape[1], values.dtype, size
        )
        return values


MESHOPT_REMEDY = (
    "its geometry is compressed with meshopt, which is not read; write it without: 'gltf-transform copy' or "
    "gltfpack without -c"
)
"""What is wrong with such a file, and what to do."""


def open_gltf(path: Path) -> Gltf:
    """Opens a ``.glb`` or ``.gltf`` file, told apart by content; its buffers are opened when asked for.

    Raises:
        LoadError: it is neither, cut short, or of glTF 1.
    """
    data = _mapped(path)
    if data[:4] == b"glTF":
        try:
            gltf = parse_glb(data, path)
        except BROKEN as error:
            raise LoadError(f"{path}: not readable as binary glTF ({error}); copy or export it again") from None
    else:
        try:
            gltf = Gltf(_tree(data[:]), path, None, len(data))
        except BROKEN as error:
            raise LoadError(f"{path}: not readable as glTF ({error}); copy or export it again") from None
    asset = gltf.tree.get("asset")
    version = asset.get("version", "2.0") if isinstance(asset, dict) else "2.0"
    if not str(version).startswith("2"):
        raise LoadError(f"{path}: glTF version {version!r:.20} is not read; convert it to glTF 2.0")
    return gltf


def parse_glb(data: Bytes, path: Path = Path("scene.glb")) -> Gltf:
    """Takes a binary glTF file apart [4.4].

    Raises:
        ValueError, KeyError, TypeError: it is none.
    """
    if len(data) < 20 or data[:4] != b"glTF":
        raise ValueError("no binary glTF")
    version = int.from_bytes(data[4:8], "little")
    if version != 2:
        raise ValueError(f"container version {version}, not 2")
    whole, at = memoryview(data), 12
    found: dict[int, memoryview] = {}
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        if at + 8 + length > len(data):
            raise ValueError(f"a part of {length} bytes at byte {at} is cut short")
        found.setdefault(kind, whole[at + 8 : at + 8 + length])
        at += 8 + length
    return Gltf(_tree(bytes(found[_JSON])), path, found.get(_BIN), len(data))


def _tree(text: bytes) -> Mapping[str, Any]:
    if len(text) > _MOST_JSON:
        raise ValueError(f"its JSON takes {len(text) >> 20} MB, more than the 1,024 MB that are read")
    try:
        tree = json.loads(text)
    except RecursionError:
        raise ValueError("its JSON is nested too deep") from None
    if not isinstance(tree, dict):
        raise TypeError("its JSON is no object")
    return tree


def _mapped(path: Path) -> Bytes:
    try:
        with path.open("rb") as file:
            return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except ValueError:  # an empty file
        return b""
    except OSError as error:
        raise LoadError(f"{path}: can't be read ({error.strerror}); check its permissions") from None


def _decoded(uri: str, place: str) -> bytes:
    head, comma, text = uri.partition(",")
    if not comma or not head.endswith(";base64"):
        raise LoadError(f"{place} is data that is not in base64; export the file with its buffer beside it")
    try:
        return base64.b64decode(unquote(text), validate=False)
    except (binascii.Error, ValueError) as error:
        raise LoadError(f"{place} is damaged ({error}); export the file again") from None


def _strided(
    data: memoryview, start: Any, count: int, width: int, dtype: np.dtype[Any], stride: Any
) -> npt.NDArray[Any]:
    start, stride, size = _count(start), _count(stride), width * dtype.itemsize
    if stride < size:
        raise ValueError(f"values of {size} bytes every {stride} bytes")
    if count and start + (count - 1) * stride + size > len(data):
        raise ValueError(f"{count} values of {size} bytes reach beyond the {len(data)} bytes there are")
    if not count:
        return np.zeros((0, width), dtype)
    return np.ndarray((count, width), dtype, data, start, (stride, dtype.itemsize))


def _count(value: Any) -> int:
    """A number of bytes or values, checked to be one; some exporters write ``12.0``."""
    number = int(value)
    if isinstance(value, str | bool) or number != value or number < 0:
        raise ValueError(f"{value!r:.20} is no count")
    return number
