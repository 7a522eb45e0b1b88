"""Text RVM (mostly ``.rev``): the same chunks with their fields as lines, turned into the words of a binary file."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from cadgraph._io.limits import lines_within
from cadgraph.errors import LoadError
from cadgraph.load.packing import Notes
from cadgraph.load.rvm.chunks import PARAMETERS, Words
from cadgraph.load.rvm.primitives import FACETS

__all__ = ["TEXT_SKEW", "is_text", "read_words"]

TEXT_SKEW = 0.05
"""Five decimals of a scale of 0.001 leave the directions of a placement wrong by up to half a percent each."""

_TAGS = frozenset(("HEAD", "MODL", "CNTB", "CNTE", "PRIM", "OBST", "INSU", "COLR", "END:"))
_MOST_BYTES = 1 << 30  # ours: few programs write it, and the same model takes twice the bytes
_MOST_LINE = 10_000
_HEADER = struct.Struct(">6I")


def is_text(path: Path) -> bool:
    """Whether a file is text RVM: its first line says HEAD, where a binary one has zeros between the letters."""
    with path.open("rb") as file:
        return file.read(64).removeprefix(b"\xef\xbb\xbf").lstrip()[:4] == b"HEAD"


def read_words(path: Path, notes: Notes) -> Words:
    """Reads a text file as the words that the same model has as a binary one.

    Args:
        path: of the file.
        notes: gets chunks that make no sense (``broken-chunk``).

    Raises:
        LoadError: it is too large.
    """
    if path.stat().st_size > _MOST_BYTES:
        raise LoadError(f"{path}: a text model of more than 1 GB; export it as binary RVM")
    binary = bytearray()
    with path.open(encoding="utf-8-sig", errors="surrogateescape", newline=None) as file:
        for number, tag, lines in _parts(lines_within(file, _MOST_LINE)):
            try:
                payload = _payload(tag, lines)
            except (ValueError, IndexError, struct.error, OverflowError):
                notes.add("broken-chunk", f"left out: line {number}, a {tag} that makes no sense")
                continue
            end = len(binary) + _HEADER.size + len(payload)
            binary += _HEADER.pack(*tag.encode("ascii"), end, 1) + payload
    return np.frombuffer(bytes(binary), ">u4")


def _parts(lines: Iterator[str]) -> Iterator[tuple[int, str, list[str]]]:
    """Every chunk: the number of its first line, its tag, and the lines that follow up to the next one."""
    tag, first, own = "", 0, list[str]()
    for number, line in enumerate(lines, start=1):
        text = line.strip()
        # The third line of a node or a model is a name, whatever it says.
        if text in _TAGS and not (tag in ("CNTB", "MODL") and len(own) in (1, 2)):
            if tag:
                yield first, tag, own
            tag, first, own = text, number, []
        else:
            own.append(text)
    if tag:
        yield first, tag, own


def _payload(tag: str, lines: list[str]) -> bytes:
    numbers = lines[0].split()
    version = int(numbers[1]) if len(numbers) > 1 else 1
    if tag in ("HEAD", "MODL"):
        count = 4 if tag == "HEAD" else 2
        # A fifth line, the encoding, came with version 2.
        texts = (lines[1:] + [""] * count)[: count + (tag == "HEAD" and len(lines) > 5)]
        return _ints(2 if len(texts) == 5 else 1) + b"".join(map(_text, texts))
    if tag == "CNTB":
        place = [float(value) for value in lines[2].split()]
        return _ints(version) + _text(lines[1]) + _floats(place[:3]) + _ints(int(lines[3].split()[0]))
    if tag == "COLR":
        color = [int(value) for line in lines[1:] for value in line.split()]
        return _ints(version, color[0]) + bytes(color[1:4]) + b"\0"
    if tag in ("CNTE", "END:"):
        return _ints(version)
    values = [value for line in lines[1:] for value in line.split()]
    return _ints(version) + _primitive(values, volume=tag != "PRIM")


def _primitive(values: list[str], volume: bool) -> bytes:
    kind = int(values[0])
    # Three rows of four: the matrix for column vectors.
    rows = [float(value) for value in values[1:13]]
    matrix = [rows[4 * row + column] for column in range(4) for row in range(3)]
    head = _ints(kind) + _floats(matrix) + _floats([float(value) for value in values[13:19]])
    rest = values[19:]
    if volume:
        # One number more, the translucency [%].
        head, rest = head + _ints(int(rest[0])), rest[1:]
    if kind == FACETS:
        return head + _facets(rest)
    n = PARAMETERS.get(kind, len(rest))
    if len(rest) < n:
        raise ValueError("too few numbers")
    return head + _floats([float(value) for value in rest[:n]])


def _facets(values: list[str]) -> bytes:
    at = 0
    out = []

    def count() -> int:
        nonlocal at
        n, at = int(values[at]), at + 1
        if not 0 <= n <= len(values):
            raise ValueError("a count beyond what follows")
        out.append(_ints(n))
        return n

    for _ in range(count()):
        for _ in range(count()):
            n = 6 * count()
            if at + n > len(values):
                raise ValueError("too few numbers")
            out.append(_floats([float(value) for value in values[at : at + n]]))
            at += n
    return b"".join(out)


def _ints(*values: int) -> bytes:
    return struct.pack(f">{len(values)}I", *values)


def _floats(values: list[float]) -> bytes:
    return np.array(values, ">f4").tobytes()


def _text(text: str) -> bytes:
    raw = text.encode("utf-8", "surrogateescape")
    n = len(raw) // 4 + 1
    return _ints(n) + raw.ljust(4 * n, b"\0")
