"""Replies that end: a body is read no further than a limit and no longer than a time, however it comes."""

from __future__ import annotations

import sys
import time
import zlib
from collections.abc import Iterator
from typing import Any

from cadgraph._io.limits import REPLY, size_text

__all__ = ["ENCODINGS", "TooMuch", "capped"]

ENCODINGS = "gzip"
"""What a server may pack a reply in: it can be unpacked piece by piece within a limit."""

_PIECE = 1 << 16  # of what is unpacked at a time


class TooMuch(ValueError):
    """A reply of more than is read."""


def capped(response: Any, seconds: float, most: int = REPLY.most) -> None:
    """Makes sure that reading a response ends. For the response hook of the client's HTTP library.

    What is counted are the bytes of the reply as they arrive and as they are unpacked, whatever length it claims, since
    a few kilobytes may unpack to gigabytes.

    Args:
        response: whose body was not read.
        seconds: that all of its body may take.
        most: bytes that are read of it.

    Raises:
        TooMuch: it says itself that it is longer, or is packed in another way. Reading it raises this as well, and the
            library's own timeout.
    """
    length = str(response.headers.get("content-length", "0"))
    if length.isdigit() and int(length) > most:
        raise TooMuch(f"the reply is {size_text(int(length))} long, and at most {size_text(most)} are read")
    packed = str(response.headers.get("content-encoding", "identity")).strip().lower()
    if packed not in ("identity", "", "gzip", "deflate", "x-gzip"):
        raise TooMuch(f"the reply is packed as {packed[:20]!r}, which can't be read within a limit")
    if "content-encoding" in response.headers:
        del response.headers["content-encoding"]
    library = sys.modules[type(response).__module__.partition(".")[0]]
    pieces = _pieces(response.stream, packed, most, time.monotonic() + seconds, library.ReadTimeout)
    response.stream = _stream_class(library)(pieces, response.stream)


def _pieces(stream: Any, packed: str, most: int, until: float, late: type[Exception]) -> Iterator[bytes]:
    unpack = zlib.decompressobj(zlib.MAX_WBITS | 32) if "gzip" in packed or packed == "deflate" else None
    raw = plain = 0
    for piece in stream:
        raw += len(piece)
        if time.monotonic() > until:
            raise late("the reply did not end in time")
        for part in [piece] if unpack is None else _unpacked(unpack, piece):
            plain += len(part)
            if max(raw, plain) > most:
                raise TooMuch(f"the reply did not end within {size_text(most)}; no more was read of it")
            yield part


def _unpacked(unpack: Any, piece: bytes) -> Iterator[bytes]:
    """What a piece unpacks to, never more than a little at a time."""
    try:
        while piece:
            part = unpack.decompress(piece, _PIECE)
            piece = unpack.unconsumed_tail
            if part:
                yield part
            elif unpack.eof:
                return
    except zlib.error as error:
        raise ValueError(f"the reply can't be unpacked ({error})") from error


def _stream_class(library: Any) -> Any:
    base: Any = library.SyncByteStream

    class Capped(base):  # type: ignore[misc]
        """A body that ends."""

        def __init__(self, pieces: Iterator[bytes], inner: Any) -> None:
            self._pieces, self._inner = pieces, inner

        def __iter__(self) -> Iterator[bytes]:
            return self._pieces

        def close(self) -> None:
            self._inner.close()

    return Capped
