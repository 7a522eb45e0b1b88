"""The server over the standard streams of a client that started it."""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

import anyio
from mcp.server.stdio import stdio_server

from cadgraph.agents.mcp.server import make_server
from cadgraph.agents.plants import Plants

__all__ = ["serve_stdio"]


def serve_stdio(plants: Plants, end: Callable[[], NoReturn]) -> None:
    """Answers over standard input and output until the client closes them; nothing else is written there.

    Args:
        plants: that are asked about.
        end: ends the process when a signal says so: a thread waits for a line of the client, which can't be ended.
    """

    async def serve() -> None:
        loop = asyncio.get_running_loop()
        loop.set_exception_handler(_tell_faults)
        server = make_server(plants)
        with _ended_by_signals(loop, end):
            async with stdio_server() as (incoming, outgoing):
                await server.run(incoming, outgoing, server.create_initialization_options())

    anyio.run(serve)


@contextmanager
def _ended_by_signals(loop: asyncio.AbstractEventLoop, end: Callable[[], NoReturn]) -> Iterator[None]:
    """Within the block, Ctrl-C and a polite kill wake the loop, which ends the process between two of its steps.

    An exception that is raised inside such a step leaves the tasks of the server half undone, or is lost.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    spoken_to = signal.set_wakeup_fd(-1)

    def restore() -> None:
        for number, handler in before.items():
            loop.remove_signal_handler(number)
            signal.signal(number, handler)
        signal.set_wakeup_fd(spoken_to, warn_on_full_buffer=False)

    def heard() -> None:
        # A second signal interrupts what is still written.
        restore()
        end()

    try:
        for number in before:
            loop.add_signal_handler(number, heard)
    except NotImplementedError:  # Windows: as everywhere else they raise an exception
        signal.set_wakeup_fd(spoken_to, warn_on_full_buffer=False)
        yield
        return
    try:
        yield
    finally:
        restore()


def _tell_faults(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Tells what went wrong beside the answers; the wish to end the process, which met a task at work, is no fault."""
    error = context.get("exception")
    rest = error.split(_is_wish)[1] if isinstance(error, BaseExceptionGroup) else error
    if (rest is None and error is not None) or (error is not None and _is_wish(error)):
        return
    loop.default_exception_handler(context)


def _is_wish(error: BaseException) -> bool:
    """Whether it asks for the end: neither a fault nor a group, which may hold both."""
    return not isinstance(error, Exception | BaseExceptionGroup)
