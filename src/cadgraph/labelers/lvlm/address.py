"""Addresses of servers: whether one is an address at all, and whether it is of a server of one's own."""

from __future__ import annotations

import ipaddress
import re
import unicodedata
from urllib.parse import urlsplit

from cadgraph.errors import LabelError

__all__ = ["check_address", "is_local"]

# Nobody bills what is asked there: this machine (RFC 1122, RFC 4291), private networks (RFC 1918, RFC 4193) and what
# hangs at the same cable (RFC 3927, RFC 4291). 0.0.0.0 and :: are how a server says 'any of mine'.
_OWN = tuple(
    ipaddress.ip_network(text)
    for text in (
        "127.0.0.0/8", "10.0.0.0/8", "172.16.0.0/12", "192.168.0.0/16", "169.254.0.0/16", "0.0.0.0/32",
        "::1/128", "fc00::/7", "fe80::/10", "::/128",
    )
)  # fmt: skip
# Names that never leave a machine (RFC 6761) or the own cable (RFC 6762). Others, .lan and .internal among them, are
# whatever the nearest name server says, be it a company's gateway that bills.
_OWN_NAMES = (".localhost", ".local")
# What ends in a number is no name (WHATWG URL, 3.5); some libraries take 2130706433, 0x7f.1 or 127.1 for 127.0.0.1.
_NUMBER = re.compile(r"(?:[0-9]+|0[xX][0-9a-fA-F]*)\Z")
# Libraries disagree about where a host ends before one of these.
_AMBIGUOUS = re.compile(r"[\s\\\x00-\x20\x7f]")


def check_address(address: str) -> None:
    """Makes sure that an address is one, is read alike by everybody, and carries no secret into the graph's settings.

    Args:
        address: of a server, as ``http://localhost:11434/v1``; an empty one is the provider's own.

    Raises:
        LabelError: it isn't.
    """
    if not address:
        return
    shown = f"base_url {address[:80]!r}"
    host = _host(address)
    if host is None:
        raise LabelError(f"{shown} is no address; give one like http://localhost:11434/v1")
    parts = urlsplit(address)
    if parts.username is not None or parts.password is not None or parts.query or "@" in parts.netloc:
        raise LabelError("base_url must hold no user, password or query; keys come from the environment only")
    if _ip(host) is None and _NUMBER.match(host.rstrip(".").rpartition(".")[2]):
        raise LabelError(f"{shown} has a number for a host; write it as four decimal numbers, as in 127.0.0.1")


def is_local(address: str) -> bool:
    """Whether an address is of a server of one's own, on this machine or in a private network.

    Args:
        address: as :func:`check_address` takes it; what that refuses is not local.
    """
    try:
        check_address(address)
    except LabelError:
        return False
    host = _host(address) if address else None
    if host is None:
        return False
    ip = _ip(host)
    if ip is not None:
        return any(ip in network for network in _OWN if network.version == ip.version)
    name = host.removesuffix(".")
    return name == "localhost" or name.endswith(_OWN_NAMES)


def _host(address: str) -> str | None:
    """The host of an address in small letters and plain digits; None where it has none or is ambiguous."""
    if _AMBIGUOUS.search(address):
        return None
    try:
        parts = urlsplit(address)
        host, _ = parts.hostname, parts.port
    except ValueError:
        return None
    if parts.scheme not in ("http", "https") or not host:
        return None
    host = unicodedata.normalize("NFKC", host).casefold()
    # A per cent sign belongs to the zone of a link-local address only.
    return None if "%" in host and ":" not in host else host


def _ip(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    """The address that a host is, that of IPv4 where one of IPv6 only wraps it."""
    try:
        ip = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return None
    return (ip.ipv4_mapped or ip) if isinstance(ip, ipaddress.IPv6Address) else ip
