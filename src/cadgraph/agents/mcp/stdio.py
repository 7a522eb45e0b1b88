"""The server over the standard streams of a client that started it."""

from __future__ import annotations

import asyncio
from typing import Any

import anyio
from mcp.server.stdio import stdio_server

from cadgraph.agents.mcp.server import make_server
from cadgraph.agents.plants import Plants

__all__ = ["serve_stdio"]


def serve_stdio(plants: Plants) -> None:
    """Answers over standard input and output until the client closes them; nothing else is written there."""

    async def serve() -> None:
        asyncio.get_running_loop().set_exception_handler(_tell_faults)
        server = make_server(plants)
        async with stdio_server() as (incoming, outgoing):
            await server.run(incoming, outgoing, server.create_initialization_options())

    anyio.run(serve)


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
