"""How much of each kind of file is read at most, all limits in one place, and the readers that keep them.

Files come from anywhere. What is larger than anything real of its kind is refused before it fills the memory, with its
size and the limit. A limit is some ten to a thousand times the largest real file that is known to us; JSON, YAML and
XML take about ten times their size in memory while they are parsed.
"""

from __future__ import annotations

import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

__all__ = [
    "ACCURACIES",
    "ANSWER",
    "BATCH",
    "CATALOG",
    "CHECK_PATH",
    "CONFIG",
    "CORRECTIONS",
    "DEXPI",
    "EXCHANGE_HEAD",
    "FLOWS",
    "GRAPH",
    "INDEX",
    "LABELS",
    "MAPPING",
    "MODEL",
    "NOTE",
    "PLAN",
    "PRICES",
    "PROFILES",
    "PROPOSALS",
    "QUESTIONS",
    "REPLY",
    "SCENARIO",
    "TASKS",
    "TRUTH",
    "VOCABULARY",
    "WORDS",
    "Limit",
    "decoded",
    "lines_within",
    "most_unpacked",
    "read_bytes_within",
    "read_text_within",
    "size_text",
]

_KB, _MB = 1 << 10, 1 << 20

CHECK_PATH = "check the path"
"""What to do where a file that somebody named isn't there."""


@dataclass(frozen=True)
class Limit:
    """What is read at most of one kind of file.

    Args:
        most: the greatest size [bytes].
        what: name of such a file, for messages.
    """

    most: int
    what: str


GRAPH = Limit(1024 * _MB, "a graph")
"""A part takes about 1 kB with its contacts: a million parts."""
TRUTH = Limit(1024 * _MB, "a truth file")
"""A mesh takes about 300 bytes: three million meshes."""
LABELS = Limit(256 * _MB, "a file of labels")
"""A row takes about 100 bytes: two million meshes."""
CORRECTIONS = Limit(64 * _MB, "a file of corrections")
"""A row takes about 400 bytes, and a hundred thousand rows are the most that is read."""
VOCABULARY = Limit(4 * _MB, "a vocabulary")
"""The built-in one takes 4 kB."""
WORDS = Limit(4 * _MB, "a list of words")
"""The built-in one takes 20 kB."""
CATALOG = Limit(1024 * _MB, "a catalogue")
"""Of the file, and of what it holds unpacked: a thousand times what a maker's catalogue takes."""
MODEL = Limit(256 * _MB, "a labeler's model")
"""Of the file, and of what it holds unpacked: the built-in one takes 6 MB."""
CONFIG = Limit(_MB, "a file of settings")
"""All settings with their comments take 10 kB."""
FLOWS = Limit(16 * _MB, "a file of flows")
"""A line takes 20 bytes."""
MAPPING = Limit(16 * _MB, "a table of tags")
"""A line takes 20 bytes."""
ACCURACIES = Limit(_MB, "a table of accuracies")
"""The built-in one takes 2 kB."""
PLAN = Limit(16 * _MB, "a round")
"""A step takes 500 bytes as it is printed: thirty thousand steps."""
SCENARIO = Limit(64 * _MB, "a scenario")
"""A valve takes 600 bytes with the reasons for its values: a hundred thousand valves."""
TASKS = Limit(256 * _MB, "a list of tasks")
"""A task of a plant with forty valves takes 6 kB: forty thousand tasks."""
PRICES = Limit(_MB, "a price table")
"""The built-in one takes 2 kB."""
PROFILES = Limit(_MB, "a table of profiles")
"""The built-in one takes 4 kB."""
INDEX = Limit(256 * _MB, "an index of questions")
"""A question takes 40 bytes and about 60 for each part that it stands for: four million parts."""
PROPOSALS = Limit(4 * _MB, "a list of proposals")
"""A proposal takes about 300 bytes."""
QUESTIONS = Limit(256 * _MB, "a file of questions or answers")
"""A question with its answers takes 400 bytes."""
ANSWER = Limit(200 * _KB, "an answer")
"""An answer takes 1 kB; what a model writes at most is some 10 kB."""
REPLY = Limit(4 * _MB, "a reply of a server")
"""An answer with all that a server tells beside it."""
BATCH = Limit(1024 * _MB, "a file of batch results")
"""A provider takes 50,000 requests in a file, and a result takes 2 kB; one line is at most a ``REPLY``."""
DEXPI = Limit(128 * _MB, "a Proteus XML file")
"""A sheet of a real plant takes 1 to 10 MB with its symbols."""
EXCHANGE_HEAD = Limit(1024 * _MB, "what the reading process tells of a scene")
"""A mesh takes about 200 bytes: five million meshes."""
NOTE = Limit(_MB, "a note between processes")
"""A request or an error takes 1 kB."""


def most_unpacked(packed: int, most: int) -> int:
    """To how many bytes an archive of some bytes may unpack: texts of CAD files shrink to a tenth, at best a thirtieth.

    Args:
        packed: size of the archive [bytes].
        most: whatever its size.
    """
    return min(most, 16 * _MB + 40 * packed)


def read_bytes_within(
    path: str | Path, limit: Limit, error: type[Exception], remedy: str, missing: str = CHECK_PATH
) -> bytes:
    """The content of a file, if it isn't larger than its kind can be.

    A file that grows while it is read, or a pipe, is read no further than the limit.

    Args:
        path: the file.
        limit: of its kind.
        error: class of the error where it can't be read.
        remedy: what to do then, as the end of a message.
        missing: likewise where no such file is there.

    Raises:
        error: it is missing, a device, can't be read, or is too large; the message names the file, its size and the
            limit.
    """
    source = Path(path)
    try:
        if source.is_char_device() or source.is_block_device():
            raise error(f"{path}: a device; {remedy}")
        with source.open("rb") as file:
            status = source.stat()
            size = status.st_size if stat.S_ISREG(status.st_mode) else 0
            content = file.read(limit.most + 1) if size <= limit.most else b""
    except FileNotFoundError as failure:
        raise error(f"{path}: no such file; {missing}") from failure
    except OSError as failure:
        raise error(f"{path}: can't be read ({failure.strerror}); {remedy}") from failure
    except ValueError as failure:
        # A path with a null character.
        raise error(f"{path!r}: can't be read ({failure}); {remedy}") from failure
    if max(size, len(content)) > limit.most:
        shown = size_text(size) if size > limit.most else f"over {size_text(limit.most)}"
        raise error(f"{path}: {shown} large, and at most {size_text(limit.most)} are read of {limit.what}; {remedy}")
    return content


def read_text_within(
    path: str | Path, limit: Limit, error: type[Exception], remedy: str, missing: str = CHECK_PATH
) -> str:
    """The text of a file in UTF-8, with or without a byte order mark, lines ending in line feeds.

    Args and errors are those of :func:`read_bytes_within`; what is no UTF-8 is an error, too.
    """
    return decoded(read_bytes_within(path, limit, error, remedy, missing), path, error, remedy)


def decoded(content: bytes, path: str | Path, error: type[Exception], remedy: str) -> str:
    """The text of a file's content, as :func:`read_text_within` gives it; the other arguments are for its error."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as failure:
        raise error(f"{path}: not UTF-8 text; {remedy}") from failure
    return text.replace("\r\n", "\n").replace("\r", "\n")


def lines_within(file: IO[str], most: int) -> Iterator[str]:
    """The lines of an open text, as an iterator; one of more than ``most`` characters comes in pieces."""
    return iter(lambda: file.readline(most), "")


def size_text(n: int) -> str:
    """A number of bytes in the unit that people read it in."""
    if n >= _MB:
        return f"{n / _MB:,.0f} MB" if n >= 10 * _MB else f"{n / _MB:.3g} MB"
    return f"{n / _KB:.3g} kB" if n >= _KB else f"{n} bytes"
