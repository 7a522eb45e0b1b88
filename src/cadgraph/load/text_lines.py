"""Large texts of numbers, read in blocks of whole lines: every line of a block is looked at at once."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.model.scene import Floats, Ints

__all__ = ["Lines", "blocks_of"]

_BLOCK = 1 << 24  # bytes read at once; some forty times as much is held meanwhile
_LONGEST_LINE = 1 << 26  # bytes; ours, a polygon of millions of corners
_LONGEST_TAIL = 64  # bytes that may follow a slash: two numbers of twenty digits and a slash
_MARGIN = 16  # blanks behind the text, so that a word can be compared anywhere
_BLANK, _NEWLINE, _RETURN, _SLASH, _BACKSLASH = 32, 10, 13, 47, 92


def blocks_of(path: Path) -> Iterator[Lines]:
    """The lines of a file, block after block; a backslash at its end joins a line with the next.

    Raises:
        LoadError: it can't be read, or a line is longer than 64 MB.
    """
    try:
        with path.open("rb") as file:
            rest = b""
            while data := file.read(_BLOCK):
                rest += data
                end = rest.rfind(b"\n")
                while end > 0 and rest[max(0, end - 2) : end].endswith((b"\\", b"\\\r")):
                    end = rest.rfind(b"\n", 0, end)
                if end >= 0:
                    yield Lines(rest[: end + 1])
                    rest = rest[end + 1 :]
                if len(rest) > _LONGEST_LINE:
                    raise LoadError(f"{path}: holds a line of more than {_LONGEST_LINE >> 20} MB; export it again")
            if rest:
                yield Lines(rest)
    except OSError as error:
        raise LoadError(f"{path}: can't be read ({error.strerror}); check its permissions") from None


class Lines:
    """Whole lines of a text.

    Args:
        text: its bytes, lines ending in line feeds, carriage returns or both.
    """

    def __init__(self, text: bytes) -> None:
        data = np.full(len(text) + _MARGIN, _BLANK, np.uint8)
        data[: len(text)] = np.frombuffer(text, np.uint8)
        if _BACKSLASH in text:
            for ending in (b"\\\r\n", b"\\\n"):
                at = text.find(ending)
                while at >= 0:
                    data[at : at + len(ending)] = _BLANK
                    at = text.find(ending, at + len(ending))
        ends = np.flatnonzero(data == _NEWLINE)
        if not len(ends):
            ends = np.flatnonzero(data == _RETURN)  # as old Macintoshes end lines
        self._data = data
        self._begins = np.concatenate([[0], ends + 1])
        self._ends = np.concatenate([ends, [len(text)]])
        blank = data <= _BLANK
        starts = ~blank
        starts[1:] &= blank[:-1]
        self._words = np.flatnonzero(starts)
        # The number of the first word of each line, and past the last line.
        self._first = np.searchsorted(self._words, np.concatenate([self._begins, [len(data)]]))
        self._full = np.flatnonzero(self._first[:-1] < self._first[1:])

    def beginning(self, word: str) -> Ints:
        """Numbers of the lines whose first word this is, in any case."""
        at = self._words[self._first[self._full]]
        found = self._data[at + len(word)] <= _BLANK
        for i, letter in enumerate(word.encode()):
            here = self._data[at + i]
            found &= (here | _BLANK if word[i].isalpha() else here) == letter
        return self._full[found]

    def filled(self, besides: Sequence[str] = ()) -> Ints:
        """Numbers of the lines that hold a word, and begin with none of these."""
        left = np.zeros(len(self._begins), bool)
        left[self._full] = True
        for word in besides:
            left[self.beginning(word)] = False
        return np.flatnonzero(left)

    def text(self, line: int) -> str:
        """One line without the blanks around it; UTF-8, else Windows' western letters."""
        raw = self._data[self._begins[line] : self._ends[line]].tobytes().strip()
        try:
            return raw.decode("utf-8")
        except UnicodeDecodeError:
            return raw.decode("cp1252", "replace")

    def rows(self, lines: Ints, width: int) -> Floats:
        """``(len(lines), width)`` first numbers behind the first word of lines; NaN in a row that has fewer or others.

        Args:
            lines: numbers of lines that begin with one and the same word, ascending.
            width: how many numbers.
        """
        counts = self._first[lines + 1] - self._first[lines] - 1
        values = _parsed(self._behind_first(lines), np.float64, int(counts.sum()))
        if values is not None and (counts == counts[:1]).all() and (counts >= width).all() and len(lines):
            whole: Floats = values.reshape(len(lines), -1)[:, :width]
            return whole
        table = np.full((len(lines), width), np.nan)
        if values is not None:
            enough = counts >= width
            starts = (np.cumsum(counts) - counts)[enough]
            table[enough] = values[starts[:, None] + np.arange(width)]
            return table
        for i, line in enumerate(lines.tolist()):
            try:
                row = [float(word) for word in self.text(line).split("#")[0].split()[1 : width + 1]]
            except ValueError:
                continue
            if len(row) == width:
                table[i] = row
        return table

    def integers(self, lines: Ints) -> tuple[Ints, Ints]:
        """The whole numbers behind the first word of lines; of ``12/7/3`` the 12.

        Args:
            lines: likewise.

        Returns:
            ``(len(lines),)`` how many each has, 0 where one is no whole number; and all of them.
        """
        counts = self._first[lines + 1] - self._first[lines] - 1
        values = _parsed(_without_slashes(self._behind_first(lines)), np.int64, int(counts.sum()))
        if values is not None:
            return counts, values
        counts, gathered = np.zeros(len(lines), np.int64), []
        for i, line in enumerate(lines.tolist()):
            try:
                row = [int(word.split("/")[0]) for word in self.text(line).split("#")[0].split()[1:]]
                found = np.array(row, np.int64)
            except (ValueError, OverflowError):
                continue
            counts[i] = len(found)
            gathered.append(found)
        return counts, np.concatenate(gathered) if gathered else np.zeros(0, np.int64)

    def _behind_first(self, lines: Ints) -> npt.NDArray[np.uint8]:
        """The bytes of lines that begin with one and the same word, with blanks in place of it."""
        chosen = np.zeros(len(self._begins), bool)
        chosen[lines] = True
        text = self._data.copy()
        first = self._words[self._first[lines]]
        length = int(np.argmax(text[first[0] :] <= _BLANK)) if len(first) else 0
        for i in range(length):
            text[first + i] = _BLANK
        behind: npt.NDArray[np.uint8] = text[np.repeat(chosen, np.diff(self._begins, append=len(text)))]
        return behind


def _parsed(text: npt.NDArray[np.uint8], dtype: type[np.generic], n: int) -> npt.NDArray[Any] | None:
    """As many numbers as are expected, or None where some are none."""
    if not n:
        return np.zeros(0, dtype)
    with warnings.catch_warnings():
        # Numpy warns, and later versions raise, where it comes to what is no number.
        warnings.simplefilter("error", DeprecationWarning)
        try:
            values = np.fromstring(text.tobytes(), dtype, sep=" ")
        except (DeprecationWarning, ValueError):
            return None
    return values if len(values) == n else None


def _without_slashes(text: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """With blanks in place of what follows a slash, up to the end of the word; changes the text."""
    at = np.flatnonzero(text == _SLASH)
    for _ in range(_LONGEST_TAIL):
        text[at] = _BLANK
        at = at[at + 1 < len(text)] + 1
        at = at[text[at] > _BLANK]
        if not len(at):
            break
    # Where it is longer, the number that can't be read is met later on.
    return text
