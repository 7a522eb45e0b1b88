"""The server over HTTP, on this machine alone unless somebody says otherwise."""

from __future__ import annotations

import socket
from collections.abc import Callable

from mcp.server.transport_security import TransportSecuritySettings
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from cadgraph.agents.mcp.server import make_server
from cadgraph.agents.plants import Plants
from cadgraph.serve.guard import Doors, is_loopback
from cadgraph.serve.listening import Server, listen

__all__ = ["PATH", "make_app", "serve_http"]

PATH = "/mcp"

Say = Callable[[str], None]


def serve_http(plants: Plants, host: str, port: int, say: Say) -> None:
    """Answers over HTTP until it is told to end by Ctrl-C or a polite kill.

    Args:
        plants: that it answers about.
        host: address to listen at.
        port: 0 for any that is free.
        say: prints a line for the person at the terminal.

    Raises:
        ValueError: others than this machine could correct a plant.
        OSError: the address can't be listened at.
    """
    if plants.writable and not is_loopback(host):
        raise ValueError(
            f"--write --host {host}: everybody who reaches this machine could correct the plant; leave one of them out"
        )
    with listen(host, port) as listener:
        doors = Doors(host, _port_of(listener))
        near = "127.0.0.1" if doors.anywhere else host
        say(f"http://{f'[{near}]' if ':' in near else near}:{doors.port}{PATH}")
        if not is_loopback(host):
            say(f"mind: --host {host} lets everybody who reaches this machine ask about the plant, without a password")
        Server(make_app(plants, doors), lambda: None, "on").run(sockets=[listener])


def make_app(plants: Plants, doors: Doors) -> ASGIApp:
    """The server as an ASGI application, guarded against pages of other sites.

    Args:
        plants: that it answers about.
        doors: the names under which it answers.
    """
    # Its own checks take any port of this machine, and can't be told that of all addresses.
    unchecked = TransportSecuritySettings(enable_dns_rebinding_protection=False)
    app = make_server(plants).streamable_http_app(
        streamable_http_path=PATH, stateless_http=True, transport_security=unchecked
    )
    return _Guard(app, doors)


class _Guard:
    """Lets requests through that were sent to this server's own name, by no page of another site."""

    def __init__(self, app: ASGIApp, doors: Doors) -> None:
        self._app, self._doors = app, doors

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            hosts, origins = (
                [value.decode("latin-1") for key, value in scope["headers"] if key == wanted]
                for wanted in (b"host", b"origin")
            )
            if len(hosts) != 1 or not self._doors.lets_in(hosts[0]):
                await PlainTextResponse("asked under another name than this server's\n", 421)(scope, receive, send)
                return
            if not all(self._doors.lets_in_from(origin) for origin in origins):
                await PlainTextResponse("asked by a page of another site\n", 403)(scope, receive, send)
                return
        await self._app(scope, receive, send)


def _port_of(listener: socket.socket) -> int:
    return int(listener.getsockname()[1])
