"""Arrays from files of anybody: as large as they say, not too large, and nothing that could run."""

from __future__ import annotations

import warnings
import zipfile
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from cadgraph._io.limits import Limit, size_text

__all__ = ["check_array", "read_arrays", "write_array"]


def read_arrays(content: bytes, limit: Limit) -> dict[str, npt.NDArray[Any]]:
    """The arrays of an npz file, once it is known that they are as large as the file says and together not too large.

    Args:
        content: of the file.
        limit: of all arrays together, unpacked.

    Raises:
        ValueError: they are too large, an array claims another size than it has, or it holds objects.
        zipfile.BadZipFile, KeyError, EOFError, OSError, zlib.error, RuntimeError: the file is damaged.
    """
    with zipfile.ZipFile(BytesIO(content)) as archive:
        infos = archive.infolist()
        size = sum(info.file_size for info in infos)
        if size > limit.most:
            raise ValueError(f"holds {size_text(size)}, and at most {size_text(limit.most)} are read of {limit.what}")
        for info in infos:
            with archive.open(info) as file:
                check_array(file, info.file_size, info.filename)
    with np.load(BytesIO(content), allow_pickle=False) as loaded:
        return {name: loaded[name] for name in loaded.files}


def check_array(file: IO[bytes], size: int, name: str) -> tuple[tuple[int, ...], np.dtype[Any], bool]:
    """Makes sure that an npy array is as large as its head says, before memory is taken for it.

    Args:
        file: open at its start; left behind its head.
        size: of the whole array with its head [bytes].
        name: of the array, for messages.

    Returns:
        Its shape, its type, and whether its columns come first.

    Raises:
        ValueError: it isn't, or it holds objects.
    """
    version = np.lib.format.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise ValueError(f"unknown kind of array {name}")
    read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    try:
        with warnings.catch_warnings():
            # The library would mend a head of Python 2 with a warning; none of our files has one.
            warnings.simplefilter("error")
            shape, fortran, dtype = read(file)
    except (ValueError, EOFError, OSError):
        raise
    except Exception as error:  # the head is a text of Python, and parsing it ends in whatever it may
        raise ValueError(f"the head of {name} can't be read ({type(error).__name__})") from error
    if dtype.hasobject:
        raise ValueError(f"{name} holds objects")
    claimed = dtype.itemsize
    for length in shape:
        claimed *= length
    if file.tell() + claimed != size:
        raise ValueError(f"{name} is cut short or too long")
    return shape, dtype, fortran


def write_array(path: Path, array: npt.NDArray[Any]) -> None:
    """Writes an array into an npy file.

    Raises:
        OSError: it can't be written; with the reason, which numpy loses where it writes to the file itself.
    """
    with path.open("wb") as file:
        # What numpy doesn't take for a file gets the same bytes from it, piece by piece.
        np.save(SimpleNamespace(write=file.write), array, allow_pickle=False)
