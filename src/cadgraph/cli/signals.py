"""Ctrl-C and a polite kill end a command the same way: everything is cleared away, then the process ends."""

from __future__ import annotations

import _thread
import select
import signal
import socket
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

__all__ = ["Stopped", "stoppable"]

_PATIENCE = 2.0  # [s] after which a signal that didn't get through is raised again
_SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Stopped(BaseException):
    """The user or the system wants the command to end; no ``KeyboardInterrupt``, which libraries like to catch.

    Args:
        number: of the signal.
        got_through: called by who heeds the wish and goes on to clear away at length.
    """

    def __init__(self, number: int, got_through: Callable[[], None] = lambda: None) -> None:
        super().__init__(number)
        self.code = 128 + number
        """The exit code that shells expect: 130 for Ctrl-C, 143 for a kill."""
        self.got_through = got_through
        """Says that the wish is heeded: it isn't raised again, so that clearing away may take its time."""


@contextmanager
def stoppable() -> Iterator[None]:
    """Within the block, SIGINT and SIGTERM raise ``Stopped``; elsewhere than in the main thread nothing changes.

    A signal may fail to end the block: an exception that is raised in a destructor or in a callback of a library is
    lost, and one that arrives between the last line of Python and the system's call that waits wakes nobody. So a
    thread hears of each signal from the system, and sends it once more while the block goes on.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    ears, mouth = socket.socketpair()
    ears.setblocking(False)
    mouth.setblocking(False)
    heeded = threading.Event()

    def stop(number: int, frame: FrameType | None) -> None:
        # An event loop may have put its own ears where the system speaks to.
        _say(mouth, number)
        raise Stopped(number, heeded.set)

    def ours(number: int) -> bool:
        # A server takes the signals over while it runs.
        return number in _SIGNALS and signal.getsignal(number) is stop

    watch = threading.Thread(target=_raise_again, args=(ears, ours, heeded), name="cadgraph-signals", daemon=True)
    watch.start()
    spoken_to = signal.set_wakeup_fd(mouth.fileno(), warn_on_full_buffer=False)
    before = {number: signal.signal(number, stop) for number in _SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(spoken_to)
        heeded.set()
        mouth.close()
        watch.join()
        ears.close()


def _say(mouth: socket.socket, number: int) -> None:
    with suppress(OSError):  # there is enough to hear already
        mouth.send(bytes([number]))


def _raise_again(ears: socket.socket, ours: Callable[[int], bool], heeded: threading.Event) -> None:
    while not heeded.is_set():
        select.select([ears], [], [])
        heard = [number for number in _heard(ears) if ours(number)]
        if heard and not heeded.wait(_PATIENCE):
            _heard(ears)
            _raise_in_main_thread(heard[-1])


def _heard(ears: socket.socket) -> bytes:
    try:
        return ears.recv(4096)
    except BlockingIOError:
        return b""


def _raise_in_main_thread(number: int) -> None:
    thread = threading.main_thread().ident
    if sys.platform != "win32" and thread is not None:
        # Wakes the main thread from what it waits for, too.
        signal.pthread_kill(thread, number)
    else:
        _thread.interrupt_main(signal.Signals(number))
