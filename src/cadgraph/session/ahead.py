"""Modules that a run needs later, imported while another process reads its file."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

__all__ = ["imported_meanwhile"]


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
