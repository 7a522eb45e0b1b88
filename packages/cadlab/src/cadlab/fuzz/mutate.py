"""A case: a kind of file and a number, which give the same spoilt bytes each time."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from functools import partial

from cadlab.fuzz.archives import spoil_glb, spoil_zip
from cadlab.fuzz.bytewise import spoil_bytes
from cadlab.fuzz.tokens import spoil_text
from cadlab.fuzz.trees import spoil_json

__all__ = ["spoilt"]

Spoil = Callable[[bytes, bytes, random.Random], bytes]
_BY_BYTES = 0.25  # share of faults that are of bytes, where the layout of the kind is known


def spoilt(kind: str, layout: str, seeds: Sequence[bytes], number: int) -> bytes:
    """The file of a case.

    Args:
        kind: of file, which the number is drawn for.
        layout: a key of the table below.
        seeds: sound files of the kind.
        number: of the case.
    """
    rng = random.Random(f"{kind}:{number}")
    data, other = rng.choice(seeds), rng.choice(seeds)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 5))):
        spoil = spoil_bytes if rng.random() < _BY_BYTES else _LAYOUTS[layout]
        data = spoil(data, other, rng)
    return data


def _text(data: bytes, other: bytes, rng: random.Random) -> bytes:
    text = data.decode("utf-8", "surrogateescape")
    spoilt_text = spoil_text(text, other.decode("utf-8", "surrogateescape"), rng)
    return spoilt_text.encode("utf-8", "surrogatepass" if "\ud800" in spoilt_text else "surrogateescape")


def _json(data: bytes, other: bytes, rng: random.Random) -> bytes:
    if rng.random() < 0.2:
        return _text(data, other, rng)
    text = spoil_json(data.decode("utf-8", "replace"), other.decode("utf-8", "replace"), rng)
    return text.encode("utf-8", "surrogatepass")


def _crate(data: bytes, other: bytes, rng: random.Random) -> bytes:
    """Half of them bytes of the crate, half of them a sound crate of a layer with a fault in its text."""
    if rng.random() < 0.5:
        return spoil_bytes(data, other, rng)
    from pxr import Sdf, Tf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    try:
        if not layer.ImportFromString(_text(_as_text(data), _as_text(other), rng).decode("utf-8", "replace")):
            return spoil_bytes(data, other, rng)
        return _as_crate(layer)
    except (Tf.ErrorException, ValueError, TypeError):
        return spoil_bytes(data, other, rng)


def _as_text(crate: bytes) -> bytes:
    import tempfile
    from pathlib import Path

    from pxr import Sdf

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.usdc"
        file.write_bytes(crate)
        layer = Sdf.Layer.OpenAsAnonymous(str(file))
        return bytes(layer.ExportToString().encode("utf-8", "replace")) if layer else b""


def _as_crate(layer: object) -> bytes:
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.usdc"
        layer.Export(str(file))  # type: ignore[attr-defined]
        return file.read_bytes()


_IN_ARCHIVE: dict[str, Spoil] = {
    ".usda": _text, ".usdc": _crate, ".model": _text, ".rels": _text, ".ifc": _text, "": spoil_bytes,
}  # fmt: skip


def _array(data: bytes, _: bytes, rng: random.Random) -> bytes:
    """An array of a catalogue: of its head, which is JSON as bytes, the text; of others a word."""
    start = data.find(b"{", 128) if data[:6] == b"\x93NUMPY" else -1
    if start < 0 or not data.rstrip().endswith(b"}"):
        return spoil_bytes(data, data, rng)
    import io

    import numpy as np

    target = io.BytesIO()
    np.save(target, np.frombuffer(_json(data[start:], data[start:], rng), np.uint8), allow_pickle=False)
    return target.getvalue()


_LAYOUTS: dict[str, Spoil] = {
    "bytes": spoil_bytes,
    "text": _text,
    "json": _json,
    "crate": _crate,
    "zip": partial(spoil_zip, spoil=_IN_ARCHIVE),
    "arrays": partial(spoil_zip, spoil=_IN_ARCHIVE | {".npy": _array}),
    "glb": partial(spoil_glb, spoil_head=_json),
}
