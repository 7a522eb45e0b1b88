"""A process that belongs to this one: it is sent lines, answers each with a line, and never outlives what holds it."""

from __future__ import annotations

import subprocess
import sys
import weakref
from collections.abc import Mapping, Sequence

__all__ = ["ChildProcess"]


class ChildProcess:
    """A process that answers lines; one thread talks to it at a time.

    It is ended with this object. Should this process be killed, the child learns so from the end of its input.

    Args:
        arguments: of the Python interpreter that runs it.
        environment: its variables; those of this process by default.
        quiet: whether what it prints to its standard error is thrown away.

    Attributes:
        kill: ends it, from any thread; who talks to it then gets no answer.
        end: ends it and lets go of all that belongs to it.

    Raises:
        OSError: it can't be started.
    """

    def __init__(
        self, arguments: Sequence[str], environment: Mapping[str, str] | None = None, *, quiet: bool = False
    ) -> None:
        if not sys.executable:
            raise OSError(0, "no Python executable is known")
        self._process = subprocess.Popen(
            [sys.executable, *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL if quiet else None,
            env=environment,
            # Ctrl-C is for the caller, which ends this one; nor does a window open where the caller has none.
            process_group=None if sys.platform == "win32" else 0,
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        # It holds the process alone, so that a thread that may call it doesn't keep this object.
        self.kill = self._process.kill
        self.end = weakref.finalize(self, _end, self._process)

    @property
    def gone(self) -> bool:
        """Whether it has ended."""
        return self._process.poll() is not None

    def talk(self, line: bytes) -> bytes:
        """Sends a line and waits for the one that answers it.

        Args:
            line: ends in a line break.

        Returns:
            A line with its line break; without one, the process has ended before the answer was there.
        """
        reading, writing = self._process.stdout, self._process.stdin
        if reading is None or writing is None:
            return b""
        try:
            writing.write(line)
            writing.flush()
            return reading.readline()
        except (OSError, ValueError):  # it is gone, or was ended by another thread, which closes the streams
            return b""


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        try:
            if stream is not None:
                stream.close()
        except OSError:  # what was not sent is not needed any more
            continue
