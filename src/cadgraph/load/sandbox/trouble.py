"""What a reading process may lack that the machine has to give, so that nobody looks for the fault in the file."""

from __future__ import annotations

import errno
import re
from enum import IntEnum
from pathlib import Path

__all__ = ["Trouble", "in_words", "trouble_in", "trouble_of"]


class Trouble(IntEnum):
    """What there is not enough of. Its number is the code that the process ends with: a full disk takes no words."""

    SPACE = 101
    FILE_SIZE = 102
    MEMORY = 103


_OF_ERRORS = {
    errno.ENOSPC: Trouble.SPACE,
    errno.EFBIG: Trouble.FILE_SIZE,
    errno.ENOMEM: Trouble.MEMORY,
    getattr(errno, "EDQUOT", errno.ENOSPC): Trouble.SPACE,
}
_WORDS = {
    Trouble.SPACE: re.compile(r"No space left on device|[Dd]isk quota exceeded"),
    Trouble.FILE_SIZE: re.compile(r"File too large|SIGXFSZ|File size limit exceeded"),
    Trouble.MEMORY: re.compile(
        r"MemoryError|bad_alloc|[Cc]annot allocate memory|[Oo]ut of memory|unable to allocate"
        # Of OpenBLAS when its threads start, and of the system when it takes in a library (which it may also forbid).
        r"|Memory allocation still failed|failed to map segment from shared object(?!: Operation not permitted)"
    ),
}
_LAST = 4_000  # characters of what a process said last


def trouble_of(error: BaseException) -> Trouble | None:
    """The trouble that an error tells of; None where it is another one."""
    if isinstance(error, MemoryError):
        return Trouble.MEMORY
    return _OF_ERRORS.get(error.errno) if isinstance(error, OSError) and error.errno is not None else None


def trouble_in(said: str) -> Trouble | None:
    """The trouble that the last words of a process tell of; None where they tell of none.

    Args:
        said: what it wrote to its standard error.
    """
    return next((trouble for trouble, words in _WORDS.items() if words.search(said[-_LAST:])), None)


def in_words(trouble: Trouble, scratch: str | Path, memory: int | None) -> str:
    """The trouble and its remedy, in words.

    Args:
        trouble: what it is.
        scratch: the folder for temporary files.
        memory: that reading may take [bytes]; None: all that there is.
    """
    if trouble is Trouble.SPACE:
        return (
            f"no space left in {scratch} for what is read of it; make room, or set TMPDIR to a folder on another disk"
        )
    if trouble is Trouble.FILE_SIZE:
        return "what is read of it is larger than a file may be here; raise that limit ('ulimit -f unlimited')"
    within = "" if memory is None else f" within {memory / 1e9:.3g} GB"
    return f"there is not enough memory to read it{within}; close other programs, split the scene or raise load.memory"
