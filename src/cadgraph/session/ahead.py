"""What a run needs later, got ready while it waits for another process, or for the interpreter."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from typing import TypeVar

__all__ = ["imported_meanwhile", "worked_out_meanwhile"]

_Found = TypeVar("_Found")


@contextmanager
def imported_meanwhile(*names: str) -> Iterator[None]:
    """Imports modules in a thread beside the block, which should wait for something and import nothing itself.

    It ends when all of them are there, so that no two threads import at a time. A module that can't be imported is
    passed over: who needs it gets the error.

    Args:
        names: of the modules, in the order in which they are needed.
    """

    def bring() -> None:
        for name in names:
            with suppress(Exception):
                importlib.import_module(name)

    thread = threading.Thread(target=bring, daemon=True)
    thread.start()
    try:
        yield
    finally:
        thread.join()


class _Unwanted(Exception):
    """Nobody waits for it any more."""


@contextmanager
def worked_out_meanwhile(act: Callable[[Callable[[], None]], _Found]) -> Iterator[Callable[[], _Found]]:
    """Works something out in a thread beside the block.

    At the end of the block the thread has ended: at its next checkpoint, where nobody asked for what it makes.

    Args:
        act: does the work, most of it outside the interpreter; it gets a function to call between its steps, which
            raises once the block is left.

    Yields:
        A function that waits for the outcome and hands it over, once; it raises what the work raised.
    """
    left = threading.Event()

    def checkpoint() -> None:
        if left.is_set():
            raise _Unwanted

    with ThreadPoolExecutor(1) as pool:
        outcome = [pool.submit(act, checkpoint)]
        try:
            yield lambda: outcome.pop().result()
        finally:
            left.set()
