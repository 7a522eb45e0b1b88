"""The server over the standard streams of a client that started it."""

from __future__ import annotations

import anyio
from mcp.server.stdio import stdio_server

from cadgraph.agents.mcp.server import make_server
from cadgraph.agents.plants import Plants

__all__ = ["serve_stdio"]


def serve_stdio(plants: Plants) -> None:
    """Answers over standard input and output until the client closes them; nothing else is written there."""

    async def serve() -> None:
        server = make_server(plants)
        async with stdio_server() as (incoming, outgoing):
            await server.run(incoming, outgoing, server.create_initialization_options())

    anyio.run(serve)
