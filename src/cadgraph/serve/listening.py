"""Listening at an address, and a server that leaves the signals to who called it."""

from __future__ import annotations

import asyncio
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Literal

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

__all__ = ["Server", "listen"]

_MOST_CONNECTIONS = 64
_SILENCE = 8.0  # s within which the first request on a connection must have come


@contextmanager
def listen(host: str, port: int) -> Iterator[socket.socket]:
    """A socket that listens at an address within the block.

    Args:
        host: address, a name or numbers.
        port: 0 for any that is free.

    Raises:
        OSError: the address can't be listened at.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        listener = socket.create_server((host, port), family=family)
    except OSError as error:
        reason = error.strerror or str(error)
        remedy = f"can't listen there ({reason}); give another --port or --host"
        raise OSError(error.errno, remedy, f"{host}:{port}") from None
    with listener:
        yield listener


class _Connection(H11Protocol):
    """A connection that is closed where nobody asks anything, so that silent ones don't use up all there may be."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self.loop.call_later(_SILENCE, self._close_if_silent)

    def _close_if_silent(self) -> None:
        if not self.cycle:  # no request has come with all of its head
            self.transport.close()


class Server(uvicorn.Server):
    """A server that tells when it is ended, and leaves the signals to who called it.

    Args:
        app: an ASGI application.
        stop: called when it is told to end, before it waits for answers that are under way.
        lifespan: whether the application wants to be told of the start and the end.

    Attributes:
        ended_by: the signal that ended it; None where there was none.
    """

    def __init__(self, app: Any, stop: Callable[[], None], lifespan: Literal["on", "off"] = "off") -> None:
        config = uvicorn.Config(
            app,
            log_level="error",
            access_log=False,
            lifespan=lifespan,
            ws="none",
            loop="asyncio",
            http=_Connection,
            server_header=False,
            limit_concurrency=_MOST_CONNECTIONS,
            timeout_graceful_shutdown=1,
        )
        super().__init__(config)
        self._stop = stop
        self.ended_by: int | None = None

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Within the block, Ctrl-C and a polite kill end the server; they aren't raised again after it."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.signal(number, self.handle_exit) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Notes that the server is to end."""
        self.ended_by = sig
        self.should_exit = True

    async def on_tick(self, counter: int) -> bool:
        """Whether it is to end now; then first what follows the state, as the server waits for that."""
        ending = await super().on_tick(counter)
        if ending:
            self._stop()
        return ending
