"""Faults within containers: a member of a zip archive or the head of a GLB is spoilt and put back where it is found."""

from __future__ import annotations

import io
import random
import struct
import zipfile
from collections.abc import Callable

__all__ = ["spoil_glb", "spoil_zip"]

Spoil = Callable[[bytes, bytes, random.Random], bytes]
_ALIGNED = 64  # bytes that the members of a usdz package start at multiples of (OpenUSD, usdzFileFormat)
_OLDEST = (1980, 1, 1, 0, 0, 0)
_JSON, _BIN = 0x4E4F534A, 0x004E4942
_NAMES = ("", "../a", "/a", "a" * 300, "a\\b", "3D/3dmodel.model", "a.usdc", "a.usda", "head.npy", "é")


def spoil_zip(data: bytes, other: bytes, rng: random.Random, spoil: dict[str, Spoil]) -> bytes:
    """A fault in one member, its name, or the list of members.

    Args:
        data: of the archive.
        other: another one, that bytes are taken from.
        rng: draws what and where.
        spoil: by the suffix of a member what spoils it; others get faults of bytes from the entry ``""``.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = [(info.filename, archive.read(info), info.compress_type) for info in archive.infolist()]
    except Exception:  # noqa: BLE001 - a fault before this one may have left anything
        return spoil[""](data, other, rng)
    if not members:
        return other
    at = rng.randrange(len(members))
    name, content, how = members[at]
    kind = rng.randrange(12)
    if kind == 0:
        del members[at]
    elif kind == 1:
        members[at] = rng.choice(_NAMES), content, how
    elif kind == 2:
        members.insert(rng.randrange(len(members) + 1), members[at])
    elif kind == 3:
        members[at] = name, content, zipfile.ZIP_STORED if how else zipfile.ZIP_DEFLATED
    else:
        suffix = name[name.rfind(".") :].lower()
        members[at] = name, spoil.get(suffix, spoil[""])(content, content, rng), how
    return _packed(members)


def _packed(members: list[tuple[str, bytes, int]]) -> bytes:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w") as archive:
        for name, content, how in members:
            info = zipfile.ZipInfo(name or "_", _OLDEST)
            info.compress_type = how
            head = target.tell() + 30 + len(info.filename.encode()) + 4
            if how == zipfile.ZIP_STORED:
                gap = -head % _ALIGNED
                info.extra = struct.pack("<HH", 0x1986, gap) + bytes(gap)
            _write(archive, info, content)
    return target.getvalue()


def _write(archive: zipfile.ZipFile, info: zipfile.ZipInfo, content: bytes) -> None:
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that a name is there twice is what is wanted
        archive.writestr(info, content)


def spoil_glb(data: bytes, other: bytes, rng: random.Random, spoil_head: Spoil) -> bytes:
    """A fault in the JSON of a GLB, whose lengths then still fit."""
    if len(data) < 20 or data[:4] != b"glTF":
        return data
    length = min(int.from_bytes(data[12:16], "little"), len(data) - 20)
    head = spoil_head(data[20 : 20 + length], data[20 : 20 + length], rng)
    head += b" " * (-len(head) % 4)
    rest = data[20 + length :]
    whole = struct.pack("<II", len(head), _JSON) + head + rest
    return b"glTF" + struct.pack("<II", 2, 12 + len(whole)) + whole
