"""Who may ask: pages of this very address with the token, and nobody that another site sends."""

from __future__ import annotations

import ipaddress
import secrets
import socket
from collections.abc import Collection
from dataclasses import dataclass
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from cadgraph.draw.web.content import as_bytes

__all__ = ["POLICY", "Doors", "Guard", "is_loopback", "refuse"]

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""What the page may load: its own files, and pictures that it makes itself."""

_HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    # A page and a server of two versions must not meet in a cache.
    "cache-control": "no-store",
}
_ANYWHERE = ("0.0.0.0", "::", "")


def is_loopback(host: str) -> bool:
    """Whether an address is reached from this machine alone."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


@dataclass(frozen=True)
class Doors:
    """The names under which the server answers.

    A page of another site can have its own name lead to this machine (DNS rebinding), so that its requests count as
    those of one origin; but it can't have them sent under a name that isn't its own.

    Args:
        host: that is listened at.
        port: likewise.
    """

    host: str
    port: int

    @property
    def anywhere(self) -> bool:
        """Whether it is listened at all addresses of this machine."""
        return self.host in _ANYWHERE

    def lets_in(self, host: str) -> bool:
        """Whether a ``Host`` header names this server."""
        name, port = _split(host.lower())
        if port != (str(self.port) if port else "") or (not port and self.port != 80):
            return False
        if name in ("localhost", "127.0.0.1", "[::1]") and (is_loopback(self.host) or self.anywhere):
            return True
        if self.anywhere:
            # No site has a bare address as its name.
            return _is_address(name) or name == socket.gethostname().lower()
        return name.strip("[]") == self.host.lower()

    def lets_in_from(self, origin: str) -> bool:
        """Whether an ``Origin`` header is that of a page of this server."""
        scheme, _, host = origin.partition("://")
        return scheme == "http" and self.lets_in(host)


def _split(host: str) -> tuple[str, str]:
    if host.startswith("["):
        name, bracket, rest = host.partition("]")
        return name + bracket, rest.removeprefix(":")
    name, _, port = host.partition(":")
    return name, port


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True


def refuse(path: str, status: int, reason: str) -> Response:
    """An answer that says in one line why there is none: JSON for the page's calls, else plain text."""
    if path.startswith("/api/"):
        return Response(as_bytes({"error": reason}), status, media_type="application/json")
    return PlainTextResponse(f"{reason}\n", status)


class Guard:
    """Lets requests through that come from the server's own page and carry the token.

    Args:
        app: what is guarded.
        token: secret of this run.
        doors: the names under which the server answers.
        free: paths of files that need no token: scripts and styles hold nothing of the plant.
    """

    def __init__(self, app: ASGIApp, token: str, doors: Doors, free: Collection[str]) -> None:
        self._app, self._token, self._doors, self._free = app, token.encode(), doors, frozenset(free)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request; see ASGI."""
        if scope["type"] != "http":
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(_HEADERS)
            await send(message)

        refusal = self._refusal(scope)
        app = self._app if refusal is None else refusal
        await app(scope, receive, send_guarded)

    def _refusal(self, scope: Scope) -> Response | None:
        headers, path, method = Headers(scope=scope), scope["path"], scope["method"]
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or not self._doors.lets_in(hosts[0]):
            return refuse(path, 403, "asked under another name than the address that 'cadgraph view' printed; use that")
        if not all(self._doors.lets_in_from(origin) for origin in origins):
            return refuse(path, 403, "asked by a page of another site")
        if method not in ("GET", "HEAD", "POST"):
            return refuse(path, 405, "only GET and POST are answered")
        if path not in self._free and not self._knows_token(scope, headers):
            return refuse(
                path,
                403,
                "the token is missing or is that of an earlier run; open the address that 'cadgraph view' printed",
            )
        if method == "POST" and headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
            return refuse(path, 415, "what is posted must be application/json")
        return None

    def _knows_token(self, scope: Scope, headers: Headers) -> bool:
        if scope["path"] == "/":
            given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        else:
            scheme, _, given = headers.get("authorization", "").partition(" ")
            given = given if scheme.lower() == "bearer" else ""
        return secrets.compare_digest(given.encode("utf-8", "replace"), self._token)
