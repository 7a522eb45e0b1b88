"""Ctrl-C and a polite kill end a command the same way: everything is cleared away, then the process ends."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["Stopped", "stoppable"]

_PATIENCE = 2.0  # [s] after which a signal that didn't get through is raised again


class Stopped(BaseException):
    """The user or the system wants the command to end; no ``KeyboardInterrupt``, which libraries like to catch.

    Args:
        number: of the signal.
    """

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.code = 128 + number
        """The exit code that shells expect: 130 for Ctrl-C, 143 for a kill."""


@contextmanager
def stoppable() -> Iterator[None]:
    """Within the block, SIGINT and SIGTERM raise ``Stopped``; elsewhere than in the main thread nothing changes."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    again: list[threading.Timer] = []

    def stop(number: int, frame: FrameType | None) -> None:
        # An exception that happens to be raised in a destructor or a callback of a library is lost: so once more.
        timer = threading.Timer(_PATIENCE, _raise_in_main_thread, (number,))
        timer.daemon = True
        again.append(timer)
        timer.start()
        raise Stopped(number)

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for timer in again:
            timer.cancel()


def _raise_in_main_thread(number: int) -> None:
    thread = threading.main_thread().ident
    if sys.platform != "win32" and thread is not None:
        # Wakes the main thread from what it waits for, too.
        signal.pthread_kill(thread, number)
    else:
        _thread.interrupt_main(signal.Signals(number))
