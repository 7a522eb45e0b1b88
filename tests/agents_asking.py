"""Calls of the server for agents within the process."""

import anyio
from mcp import Client

from cadgraph.agents.mcp.server import make_server


def ask(plants, *calls, **more):
    """The results of calls of a server within the process, one after another."""

    async def run():
        async with Client(make_server(plants)) as client:
            return [await client.call_tool(name, arguments, **more) for name, arguments in calls]

    return anyio.run(run)


def text(result):
    return result.content[0].text
